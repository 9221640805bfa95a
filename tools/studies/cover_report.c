/// Classes of coverage, viewpoints and blind spots.
#include "studies/cover_report.h"

#include "reports/heat_map.h"
#include "sightline/support.h"
#include "studies/cover_path.h"
#include "system/built.h"

#include <math.h>
#include <stdio.h>

/// So many blind spots are printed, and numbered in pictures.
enum { BLIND_MOST = 10 };

sl_status cover_viewpoints(sl_context *context, const sl_cameras *cameras, sl_viewpoint **out) {
    *out = sl_alloc_array(context, cameras->count, sizeof **out);
    if (!*out) return SL_NO_MEMORY;
    for (size_t i = 0; i < cameras->count; i++) (*out)[i] = cameras->items[i].view;
    return SL_OK;
}

const char *cover_area_text(const cover_report *r, double area, char text[AREA_TEXT]) {
    const char *unit = r->baked->map.unit;
    // Four digits, also where %g would write an exponent.
    const double step = area >= 1e4 && area < 1e15 ? pow(10, floor(log10(area)) - 3) : 0;
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

static void print_classes(const cover_report *r) {
    static const char *const names[SL_COVERAGE_CLASSES] = {"not seen", "seen by 1", "seen by 2",
                                                           "seen by 3 or more"};
    char text[AREA_TEXT];
    for (uint32_t k = 0; k < SL_COVERAGE_CLASSES; k++) {
        const double area = sl_coverage_class_area(r->coverage, k);
        if (area > 0)
            printf("  %-18s %12s  %5.1f %%\n", names[k], cover_area_text(r, area, text),
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
               is_spare ? "  spare" : "");
    }
    if (spare > 1)
        printf("  The others see all that a spare one sees. Take one away and ask again: two may "
               "stand in for each other.\n");
    else if (spare)
        printf("  The others see all that the spare one sees.\n");
}

static void print_blind(const cover_report *r) {
    const sl_coverage *c = r->coverage;
    char text[AREA_TEXT];
    const int digits = sl_map_digits(&r->baked->map);
    if (!c->blind_count) return;
    printf("\n  %u blind spot%s", (unsigned)c->blind_count, c->blind_count == 1 ? "" : "s");
    printf(c->blind_count > BLIND_MOST ? ", the largest %d:\n" : ":\n", BLIND_MOST);
    for (uint32_t i = 0; i < c->blind_count && i < BLIND_MOST; i++)
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
    json_add_flag(f, "spare", sl_coverage_is_spare(r->coverage, i));
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

sl_status cover_draw(sl_context *context, const cover_report *r, const cover_path *way,
                     const char *caption, const sl_draw_options *drawing, const char *path) {
    const sl_coverage *c = r->coverage;
    sl_viewpoint *viewpoints = NULL;
    const char **names = sl_alloc_array(context, c->count, sizeof *names);
    sl_point blind[BLIND_MOST];
    char title[512];
    sl_draw_options options = *drawing;
    heat_map_title(r->input, r->map, "coverage", title, sizeof title);
    if (!options.title) options.title = title;
    sl_drawn_coverage drawn = {.pieces = &c->overlay.pieces,
                               .counts = c->overlay.counts,
                               .names = names,
                               .regions = c->regions,
                               .count = c->count,
                               .blind = blind};
    if (way) {
        drawn.path = way->points;
        drawn.path_count = way->count;
        drawn.unseen = way->unseen.items;
        drawn.unseen_count = way->unseen.count;
    }
    for (; drawn.blind_count < c->blind_count && drawn.blind_count < BLIND_MOST;
         drawn.blind_count++)
        blind[drawn.blind_count] = c->blind[drawn.blind_count].at;
    sl_status status = names ? cover_viewpoints(context, r->cameras, &viewpoints) : SL_NO_MEMORY;
    for (size_t i = 0; status == SL_OK && i < c->count; i++) names[i] = r->cameras->items[i].name;
    drawn.viewpoints = viewpoints;
    if (status == SL_OK)
        status = built_pictures()->coverage(context, r->baked, &drawn, caption, &options, path);
    sl_free(context, viewpoints);
    sl_free(context, names);
    return status;
}
