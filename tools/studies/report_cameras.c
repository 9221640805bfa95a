/// What cameras see together, in a report.
#include "studies/report_cameras.h"

#include <stdio.h>

static sl_status survey(sl_context *context, const report_cameras_scene *scene,
                        report_cameras *out) {
    const sl_viewpoint like = {.fov = 360};
    sl_viewpoint *viewpoints;
    SL_TRY(sl_cameras_read(context, scene->table, &like, &out->cameras));
    SL_TRY(cover_check_places(context, scene->table, &scene->baked->space, &out->cameras));
    cover_note_headings(context, scene->table, &out->cameras, "a column fov");
    SL_TRY(cover_viewpoints(context, &out->cameras, &viewpoints));
    const sl_status status =
        sl_coverage_make(context, scene->query, viewpoints, out->cameras.count, &out->coverage);
    sl_free(context, viewpoints);
    return status;
}

static const char *area_text(report_blocks *b, const cover_report *r, double area) {
    char text[AREA_TEXT];
    return blocks_keep(b, cover_area_text(r, area, text));
}

static const char *percent_text(report_blocks *b, double percent) {
    return blocks_say(b, "%.1f %%", percent);
}

static void add_classes(report_blocks *b, const cover_report *r) {
    static const char *const head[] = {"class", "area", "share of the inside"};
    text_list t = {0};
    blocks_add_head(b, &t, head, 3);
    for (uint32_t k = 0; k < SL_COVERAGE_CLASSES; k++) {
        const double area = sl_coverage_class_area(r->coverage, k);
        blocks_add_cell(b, &t, cover_classes[k]);
        blocks_add_cell(b, &t, area_text(b, r, area));
        blocks_add_cell(b, &t, percent_text(b, 100 * area / r->coverage->overlay.areas[0]));
    }
    blocks_add_table(b, &t, 3);
}

static void add_viewpoints(report_blocks *b, const cover_report *r) {
    static const char *const head[] = {"camera", "x",     "y",    "heading",
                                       "fov",    "range", "sees", "alone sees"};
    const int digits = sl_map_digits(&r->baked->map);
    text_list t = {0};
    blocks_add_head(b, &t, head, 8);
    for (size_t i = 0; i < r->coverage->count; i++) {
        const sl_camera *camera = &r->cameras->items[i];
        const sl_viewpoint *v = &camera->view;
        const bool all_round = v->fov >= 360;
        blocks_add_cell(b, &t, camera->name ? camera->name : blocks_say(b, "%zu", i + 1));
        blocks_add_cell(b, &t, blocks_say(b, "%.*g", digits, v->at.x));
        blocks_add_cell(b, &t, blocks_say(b, "%.*g", digits, v->at.y));
        blocks_add_cell(b, &t, all_round ? "" : blocks_number(b, v->heading));
        blocks_add_cell(b, &t, blocks_number(b, v->fov));
        blocks_add_cell(b, &t, v->range > 0 ? blocks_number(b, v->range) : "no limit");
        blocks_add_cell(b, &t, area_text(b, r, r->coverage->seen[i]));
        blocks_add_cell(b, &t,
                        sl_coverage_is_spare(r->coverage, i)
                            ? "nothing: it is spare"
                            : area_text(b, r, r->coverage->alone[i]));
    }
    blocks_add_table(b, &t, 8);
}

static void add_rooms(report_blocks *b, const cover_report *r, const zone_covers *rooms) {
    static const char *const head[] = {"room", "inside",       "not seen", "by 1",
                                       "by 2", "by 3 or more", "cameras"};
    text_list t = {0};
    if (!rooms->count) return;
    blocks_add_text(b, SL_BLOCK_TEXT, "What share of each room they see:");
    blocks_add_head(b, &t, head, 7);
    for (size_t i = 0; i < rooms->count; i++) {
        const zone_cover *c = &rooms->items[i];
        blocks_add_cell(b, &t, c->name);
        blocks_add_cell(b, &t, area_text(b, r, c->by[0]));
        for (uint32_t k = 0; k < SL_COVERAGE_CLASSES; k++)
            blocks_add_cell(b, &t, percent_text(b, cover_zone_percent(c, k)));
        blocks_add_cell(b, &t, blocks_say(b, "%u", (unsigned)c->viewpoints));
    }
    blocks_add_table(b, &t, 7);
}

static void add_blind(report_blocks *b, const cover_report *r, const sl_rooms *rooms) {
    static const char *const head[] = {"blind spot", "area", "x", "y", "room"};
    const sl_coverage *c = r->coverage;
    const int digits = sl_map_digits(&r->baked->map);
    text_list t = {0};
    if (!c->blind_count) return;
    blocks_add_text(b, SL_BLOCK_TEXT,
                    blocks_say(b, "%u blind spot%s%s. The picture has their numbers:",
                               (unsigned)c->blind_count, c->blind_count == 1 ? "" : "s",
                               c->blind_count > COVER_BLIND_MOST ? "; these are the largest" : ""));
    blocks_add_head(b, &t, head, 5);
    for (uint32_t i = 0; i < c->blind_count && i < COVER_BLIND_MOST; i++) {
        const uint32_t room = sl_rooms_at(rooms, c->blind[i].at);
        blocks_add_cell(b, &t, blocks_say(b, "%u", (unsigned)i + 1));
        blocks_add_cell(b, &t, area_text(b, r, c->blind[i].area));
        blocks_add_cell(b, &t, blocks_say(b, "%.*g", digits, c->blind[i].at.x));
        blocks_add_cell(b, &t, blocks_say(b, "%.*g", digits, c->blind[i].at.y));
        blocks_add_cell(b, &t, room == SL_NO_ROOM ? "in no room" : rooms->items[room].name);
    }
    blocks_add_table(b, &t, 5);
}

sl_status report_cameras_add(sl_context *context, const report_cameras_scene *scene,
                             report_blocks *b, report_cameras *out) {
    const cover_report r = {.input = scene->input,
                            .baked = scene->baked,
                            .cameras = &out->cameras,
                            .coverage = &out->coverage};
    char sentence[256];
    SL_TRY(survey(context, scene, out));
    cover_note_blind(context, scene->table, &r);
    SL_TRY(cover_rooms_make(context, &r, scene->rooms, &out->rooms));
    SL_TRY(cover_drawn_make(context, &r, &out->drawn));
    cover_sentence(&r, sentence, sizeof sentence);
    blocks_add_text(b, SL_BLOCK_HEADING, "Cameras");
    blocks_add_text(b, SL_BLOCK_TEXT, blocks_say(b, "%s.", sentence));
    blocks_add(b, (sl_document_block){.kind = SL_BLOCK_PICTURE,
                                      .baked = scene->baked,
                                      .coverage = &out->drawn.drawn});
    add_classes(b, &r);
    add_viewpoints(b, &r);
    add_rooms(b, &r, &out->rooms);
    add_blind(b, &r, scene->rooms);
    return b->status;
}

void report_cameras_destroy(sl_context *context, report_cameras *c) {
    cover_drawn_destroy(context, &c->drawn);
    cover_zones_destroy(context, &c->rooms);
    sl_coverage_destroy(context, &c->coverage);
    sl_cameras_destroy(context, &c->cameras);
}
