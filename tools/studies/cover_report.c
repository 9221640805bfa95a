/// Classes of coverage, viewpoints and blind spots.
#include "studies/cover_report.h"

#include "inputs/inputs.h"
#include "reports/heat_map.h"
#include "sightline/support.h"
#include "studies/cover_path.h"
#include "system/built.h"

#include <math.h>
#include <stdio.h>

sl_status cover_viewpoints(sl_context *context, const sl_cameras *cameras, sl_viewpoint **out) {
    *out = sl_alloc_array(context, cameras->count, sizeof **out);
    if (!*out) return SL_NO_MEMORY;
    for (size_t i = 0; i < cameras->count; i++) (*out)[i] = cameras->items[i].view;
    return SL_OK;
}

const char *cover_area_text(const cover_report *r, double area, char text[AREA_TEXT]) {
    const char *unit = r->baked->map.unit;
    // Four digits, also where %g would write an exponent.
    const double step = area >= 9999.5 && area < 1e15 ? pow(10, floor(log10(area)) - 3) : 0;
    snprintf(text, AREA_TEXT, step > 0 ? "%.0f%s%s%s" : "%.4g%s%s%s",
             step > 0 ? step * round(area / step) : area, *unit ? " " : "", unit,
             *unit ? "\xc2\xb2" : "");
    return text;
}

void cover_sentence(const cover_report *r, char *text, size_t size) {
    const sl_coverage *c = r->coverage;
    char seen[AREA_TEXT], all[AREA_TEXT];
    const double blind = sl_coverage_class_area(c, 0), inside = c->overlay.areas[0];
    size_t signs = 0;
    for (size_t i = 0; i < c->count; i++) signs += r->cameras->items[i].view.sign;
    const bool one = c->count == 1;
    const char *see = signs < c->count ? one ? "viewpoint sees" : "viewpoints see"
                      : one            ? "sign can be read from"
                                       : "signs can be read from";
    if (!(blind > 0))
        snprintf(text, size, "%zu %s all that is inside (%s)", c->count, see,
                 cover_area_text(r, inside, all));
    else
        snprintf(text, size, "%zu %s %s of %s inside (%.3g %%)", c->count, see,
                 cover_area_text(r, inside - blind, seen), cover_area_text(r, inside, all),
                 100 * (inside - blind) / inside);
}

static void name_of(const sl_camera *camera, size_t number, char *text, size_t size) {
    if (camera->name)
        snprintf(text, size, "%s", camera->name);
    else
        snprintf(text, size, "%zu", number + 1);
}

const char *const cover_classes[SL_COVERAGE_CLASSES] = {"not seen", "seen by 1", "seen by 2",
                                                        "seen by 3 or more"};

static void print_classes(const cover_report *r) {
    char text[AREA_TEXT];
    for (uint32_t k = 0; k < SL_COVERAGE_CLASSES; k++) {
        const double area = sl_coverage_class_area(r->coverage, k);
        if (area > 0)
            printf("  %-18s %12s  %5.1f %%\n", cover_classes[k], cover_area_text(r, area, text),
                   100 * area / r->coverage->overlay.areas[0]);
    }
}

static void print_viewpoints(const cover_report *r) {
    size_t spare = 0;
    char name[64], seen[AREA_TEXT], alone[AREA_TEXT];
    const int digits = sl_map_digits(&r->baked->map);
    printf("\n  viewpoint          at                      sees       alone\n");
    for (size_t i = 0; i < r->coverage->count; i++) {
        const sl_camera *camera = &r->cameras->items[i];
        char at[64];
        snprintf(at, sizeof at, "%.*g,%.*g", digits, camera->view.at.x, digits, camera->view.at.y);
        name_of(camera, i, name, sizeof name);
        const bool is_spare = sl_coverage_is_spare(r->coverage, i);
        spare += is_spare;
        printf("  %-18s %-18s %10s  %10s%s\n", name, at,
               cover_area_text(r, r->coverage->seen[i], seen),
               cover_area_text(r, is_spare ? 0 : r->coverage->alone[i], alone),
               is_spare && !r->needs ? "  spare" : "");
    }
    if (spare && r->needs)
        printf("  A viewpoint that sees no area alone may still be needed: %s.\n", r->needs);
    else if (spare > 1)
        printf("  The others see all that a spare one sees, but for slivers up to a billionth of "
               "the inside. Take one away and ask again: two may stand in for each other.\n");
    else if (spare)
        printf("  The others see all that the spare one sees, but for slivers up to a billionth of "
               "the inside.\n");
}

static void print_blind(const cover_report *r) {
    const sl_coverage *c = r->coverage;
    char text[AREA_TEXT];
    const int digits = sl_map_digits(&r->baked->map);
    if (!c->blind_count) return;
    printf("\n  %u blind spot%s", (unsigned)c->blind_count, c->blind_count == 1 ? "" : "s");
    printf(c->blind_count > COVER_BLIND_MOST ? ", the largest %d (--json lists all):\n" : ":\n",
           COVER_BLIND_MOST);
    for (uint32_t i = 0; i < c->blind_count && i < COVER_BLIND_MOST; i++)
        printf("  %4u %12s  at %.*g,%.*g\n", (unsigned)i + 1,
               cover_area_text(r, c->blind[i].area, text), digits, c->blind[i].at.x, digits,
               c->blind[i].at.y);
}

void cover_print(const cover_report *r) {
    char text[256];
    cover_sentence(r, text, sizeof text);
    printf("%s\n", text);
    print_classes(r);
    print_viewpoints(r);
    print_blind(r);
}

static void add_camera(json_fields *f, const cover_report *r, size_t i) {
    const sl_camera *camera = &r->cameras->items[i];
    json_open_item(f);
    if (camera->name) json_add_text(f, "name", camera->name);
    json_add_real(f, "x", camera->view.at.x);
    json_add_real(f, "y", camera->view.at.y);
    if (camera->view.fov < 360) json_add_real(f, "heading", camera->view.heading);
    if (camera->view.fov < 360) json_add_real(f, "fov", camera->view.fov);
    if (camera->view.range > 0) json_add_real(f, "range", camera->view.range);
    if (camera->view.nearest > 0) json_add_real(f, "nearest", camera->view.nearest);
    if (camera->view.sign) json_add_flag(f, "sign", true);
    json_add_real(f, "seen_area", r->coverage->seen[i]);
    json_add_real(f, "alone_area", r->coverage->alone[i]);
    json_add_flag(f, "spare", !r->needs && sl_coverage_is_spare(r->coverage, i));
    json_close(f);
}

void cover_add_json(json_fields *f, const cover_report *r) {
    static const char *const classes[SL_COVERAGE_CLASSES] = {"0", "1", "2", "3+"};
    const sl_coverage *c = r->coverage;
    json_add_real(f, "inside_area", c->overlay.areas[0]);
    json_add_real(f, "seen_area", c->overlay.areas[0] - sl_coverage_class_area(c, 0));
    json_add_real(f, "unseen_area", sl_coverage_class_area(c, 0));
    json_open(f, "areas");
    for (uint32_t k = 0; k < SL_COVERAGE_CLASSES; k++)
        json_add_real(f, classes[k], sl_coverage_class_area(c, k));
    json_close(f);
    json_open_list(f, "viewpoints");
    for (size_t i = 0; i < c->count; i++) add_camera(f, r, i);
    json_close_list(f);
    json_open_list(f, "blind_spots");
    for (uint32_t i = 0; i < c->blind_count; i++) {
        json_open_item(f);
        json_add_real(f, "area", c->blind[i].area);
        json_add_real(f, "x", c->blind[i].at.x);
        json_add_real(f, "y", c->blind[i].at.y);
        json_add_box(f, "bounds", c->blind[i].bounds);
        json_close(f);
    }
    json_close_list(f);
}

sl_status cover_check_places(sl_context *context, const char *table, const sl_space *space,
                             const sl_cameras *cameras) {
    char nearest[INPUT_NEAREST_TEXT];
    size_t outside = 0, first = 0;
    for (size_t i = 0; i < cameras->count; i++) {
        const sl_camera *camera = &cameras->items[i];
        SL_TRY(input_check_place(context, table, camera->line, space, camera->view.at));
        const uint32_t cell = sl_space_locate(space, camera->view.at);
        if (cell == SL_NO_CELL || space->cells[cell].inside) continue;
        if (!outside++) first = i;
    }
    if (!outside) return SL_OK;
    const sl_camera *camera = &cameras->items[first];
    sl_note(context, "%s: %zu of %zu viewpoints are not inside; the first is on line %u%s", table,
            outside, cameras->count, camera->line,
            input_say_nearest(space, camera->view.at, nearest));
    return SL_OK;
}

void cover_note_headings(sl_context *context, const char *table, const sl_cameras *cameras,
                         const char *remedy) {
    size_t round = 0;
    for (size_t i = 0; i < cameras->count; i++) {
        const sl_viewpoint *view = &cameras->items[i].view;
        round += view->heading != 0 && view->fov == 360 && !view->sign;
    }
    if (round)
        sl_note(context,
                "%s: rows that look all round, whatever their heading: %zu of %zu; %s gives them a "
                "view cone",
                table, round, cameras->count, remedy);
}

void cover_note_blind(sl_context *context, const char *table, const cover_report *r) {
    const sl_space *space = &r->baked->space;
    const sl_camera *cameras = r->cameras->items;
    size_t blind[2] = {0}, first[2] = {0}, all[2] = {0};
    for (size_t i = 0; i < r->cameras->count; i++) {
        const bool sign = cameras[i].view.sign;
        const uint32_t cell = sl_space_locate(space, cameras[i].view.at);
        all[sign]++;
        // cover_check_places() has told of those outside.
        if (cell != SL_NO_CELL && !space->cells[cell].inside) continue;
        if (r->coverage->seen[i] <= r->coverage->negligible && !blind[sign]++) first[sign] = i;
    }
    if (blind[true])
        sl_note(
            context,
            "%s: %zu of %zu signs can be read from nowhere, the first on line %u: put it on the "
            "wall or before it, and its heading into the room",
            table, blind[true], all[true], cameras[first[true]].line);
    if (blind[false])
        sl_note(context,
                "%s: %zu of %zu viewpoints see nothing, the first on line %u: one that stands on a "
                "wall looks from one side of it; put it a little before the wall",
                table, blind[false], all[false], cameras[first[false]].line);
}

// --- the picture

sl_status cover_drawn_make(sl_context *context, const cover_report *r, cover_drawn *out) {
    const sl_coverage *c = r->coverage;
    out->names = sl_alloc_array(context, c->count, sizeof *out->names);
    if (!out->names) return SL_NO_MEMORY;
    SL_TRY(cover_viewpoints(context, r->cameras, &out->viewpoints));
    out->drawn = (sl_drawn_coverage){.pieces = &c->overlay.pieces,
                                     .counts = c->overlay.counts,
                                     .viewpoints = out->viewpoints,
                                     .names = out->names,
                                     .regions = c->regions,
                                     .count = c->count,
                                     .blind = out->blind};
    for (size_t i = 0; i < c->count; i++) out->names[i] = r->cameras->items[i].name;
    for (size_t i = 0; i < c->blind_count && i < COVER_BLIND_MOST; i++)
        out->blind[out->drawn.blind_count++] = c->blind[i].at;
    return SL_OK;
}

void cover_drawn_destroy(sl_context *context, cover_drawn *drawn) {
    sl_free(context, drawn->viewpoints);
    sl_free(context, drawn->names);
}

sl_status cover_draw(sl_context *context, const cover_report *r, const cover_path *way,
                     const char *caption, const sl_draw_options *drawing, const char *path) {
    cover_drawn made = {0};
    char title[512];
    sl_draw_options options = *drawing;
    heat_map_title(r->input, r->map, "coverage", title, sizeof title);
    if (!options.title) options.title = title;
    sl_status status = cover_drawn_make(context, r, &made);
    if (way) {
        made.drawn.path = way->points;
        made.drawn.path_count = way->count;
        made.drawn.unseen = way->unseen.items;
        made.drawn.unseen_count = way->unseen.count;
    }
    if (status == SL_OK)
        status =
            built_pictures()->coverage(context, r->baked, &made.drawn, caption, &options, path);
    cover_drawn_destroy(context, &made);
    return status;
}
