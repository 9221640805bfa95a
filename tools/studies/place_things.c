/// What chosen places see of each thing that is to be seen (place_cameras.h).
#include "studies/place_cameras.h"

#include <stdio.h>

/// Refuses a thing that no place sees. `at`: a point of it.
static sl_status refuse_hidden(sl_context *context, const camera_plan *plan, sl_query *query,
                               const camera_work *w, const char *noun, const char *name,
                               sl_point target) {
    const int digits = sl_map_digits(sl_query_map(query));
    sl_point at = {0, 0};
    bool found;
    SL_TRY(sl_place_nearest(context, query, &plan->like, target, w->task.places,
                            w->task.place_count, &at, &found));
    return found ? sl_fail(context, SL_BAD_ARGUMENT,
                           "--see: none of the places sees %s '%s'; the nearest one that could is "
                           "at %.*g,%.*g",
                           noun, name, digits, at.x, digits, at.y)
                 : sl_fail(context, SL_BAD_ARGUMENT, "--see: none of the places sees %s '%s'", noun,
                           name);
}

static sl_status check_zone(sl_context *context, const camera_plan *plan, sl_query *query,
                            const camera_work *w, size_t z) {
    const char *name = w->see.names.items[z];
    size_t end;
    const sl_shape zone = zones_shape_of(&w->see, z, &end);
    if (!(w->covers.items[z].by[0] > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "--see: nothing of zone '%s' is inside", name);
    if (w->covers.items[z].by[1] > 0) return SL_OK;
    for (uint32_t i = 0; i < w->placed.blind_count; i++)
        if (zones_shape_holds(&zone, w->placed.blind[i].at))
            return refuse_hidden(context, plan, query, w, "zone", name, w->placed.blind[i].at);
    return sl_fail(context, SL_BAD_ARGUMENT, "--see: none of the places sees zone '%s'", name);
}

static size_t first_of(const camera_work *w, size_t thing) {
    return thing ? w->lines.ends.items[thing - 1] : 0;
}

static sl_status check_line(sl_context *context, const camera_plan *plan, sl_query *query,
                            const camera_work *w, size_t thing) {
    const char *name = w->lines.names.items[thing];
    if (!(w->line_covers[thing].inside > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "--see: nothing of '%s' is inside", name);
    if (w->line_covers[thing].seen > 0) return SL_OK;
    for (size_t i = first_of(w, thing); i < w->lines.ends.items[thing]; i++) {
        const sl_segment *s = &w->lines.segments.items[i];
        if (w->placed.line_lengths[i] > 0)
            return refuse_hidden(
                context, plan, query, w, "line", name,
                (sl_point){s->a.x + (s->b.x - s->a.x) / 2, s->a.y + (s->b.y - s->a.y) / 2});
    }
    return SL_OK;
}

/// Nothing outside is seen, so what is seen is the length but for what is not.
static sl_status measure_line(sl_context *context, sl_query *query, const cover_report *report,
                              const sl_viewpoint *viewpoints, camera_work *w, size_t thing) {
    line_cover *out = &w->line_covers[thing];
    double length = 0;
    size_t unseen_parts = 0;
    for (size_t i = first_of(w, thing); i < w->lines.ends.items[thing]; i++) {
        const sl_segment *s = &w->lines.segments.items[i];
        const sl_point ends[2] = {s->a, s->b};
        sl_path_parts unseen;
        SL_TRY(sl_coverage_of_path(context, query, report->coverage, viewpoints, ends, 2, &unseen));
        out->inside += w->placed.line_lengths[i];
        length += unseen.length;
        out->seen += unseen.length - unseen.total;
        unseen_parts += unseen.count;
        sl_path_parts_destroy(context, &unseen);
    }
    if (out->inside > 0 && length - out->inside > 1e-6 * length)
        sl_note(context, "%s: %.4g of its %.4g are inside; the rest does not count",
                w->lines.names.items[thing], out->inside, length);
    // Both are rounded sums.
    if (!unseen_parts || out->seen > out->inside) out->seen = out->inside;
    return SL_OK;
}

sl_status camera_work_survey(sl_context *context, const camera_plan *plan, sl_query *query,
                             const cover_report *report, const sl_viewpoint *viewpoints,
                             camera_work *w) {
    const bool all = !w->task.count && !camera_work_scans(w);
    if (w->see.ends.count) SL_TRY(cover_zones_make(context, report, &w->see, &w->covers));
    for (size_t z = 0; z < w->see.ends.count && all; z++)
        SL_TRY(check_zone(context, plan, query, w, z));
    w->line_covers = sl_alloc_array(context, w->lines.ends.count + 1, sizeof *w->line_covers);
    if (!w->line_covers) return SL_NO_MEMORY;
    for (size_t i = 0; i < w->lines.ends.count; i++) {
        SL_TRY(measure_line(context, query, report, viewpoints, w, i));
        if (all) SL_TRY(check_line(context, plan, query, w, i));
    }
    return SL_OK;
}

sl_status camera_work_trace(sl_context *context, const cover_report *report, sl_query *query,
                            const sl_viewpoint *viewpoints, const camera_work *w, cover_path *out) {
    const size_t count = w->lines.segments.count;
    const sl_segment *s = w->lines.segments.items;
    if (w->lines.ends.count != 1) return SL_OK;
    for (size_t i = 1; i < count; i++)
        if (s[i].a.x != s[i - 1].b.x || s[i].a.y != s[i - 1].b.y) return SL_OK;
    out->points = sl_alloc_array(context, count + 1, sizeof *out->points);
    if (!out->points) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) out->points[i] = s[i].a;
    out->points[count] = s[count - 1].b;
    out->count = count + 1;
    return cover_path_find(context, report, query, viewpoints, out);
}

static double percent(const line_cover *c) {
    return c->inside > 0 ? 100 * c->seen / c->inside : 0;
}

void camera_work_print_things(const camera_work *w, const cover_report *report) {
    const char *unit = report->baked->map.unit;
    if (w->covers.what) cover_zones_print(report, &w->covers);
    if (w->lines.ends.count) printf("\n  line                    inside      seen\n");
    for (size_t i = 0; i < w->lines.ends.count; i++) {
        char length[64];
        snprintf(length, sizeof length, "%.4g%s%s", w->line_covers[i].inside, *unit ? " " : "",
                 unit);
        printf("  %-18s %11s  %6.1f %%\n", w->lines.names.items[i], length,
               percent(&w->line_covers[i]));
    }
}

void camera_work_add_things_json(json_fields *f, const camera_work *w) {
    if (w->covers.what) cover_zones_add_json(f, &w->covers);
    if (!w->lines.ends.count) return;
    json_open_list(f, "lines");
    for (size_t i = 0; i < w->lines.ends.count; i++) {
        json_open_item(f);
        json_add_text(f, "name", w->lines.names.items[i]);
        json_add_real(f, "inside_length", w->line_covers[i].inside);
        json_add_real(f, "seen_length", w->line_covers[i].seen);
        json_close(f);
    }
    json_close_list(f);
}
