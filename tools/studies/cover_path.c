/// Parts of a path, in its order.
#include "studies/cover_path.h"

#include "inputs/path_points.h"
#include "studies/places.h"

#include <math.h>
#include <stdio.h>

/// So many parts are printed.
enum { PARTS_MOST = 20 };

static sl_status add_piece(sl_context *context, cover_path *path, sl_point a, sl_point b) {
    SL_TRY(SL_ARRAY_ROOM(context, &path->unseen, 1));
    path->unseen.items[path->unseen.count++] = (sl_segment){a, b};
    return SL_OK;
}

/// Cuts a part where the path turns.
static sl_status add_part(sl_context *context, cover_path *path, const sl_path_part *part) {
    double done = 0;
    sl_point from = part->start;
    for (size_t i = 0; i + 1 < path->count; i++) {
        const sl_point turn = path->points[i + 1];
        done += hypot(turn.x - path->points[i].x, turn.y - path->points[i].y);
        if (done <= part->from) continue;
        if (done >= part->to) break;
        SL_TRY(add_piece(context, path, from, turn));
        from = turn;
    }
    return add_piece(context, path, from, part->end);
}

sl_status cover_path_find(sl_context *context, const cover_report *r, sl_query *query,
                          const sl_viewpoint *viewpoints, cover_path *path) {
    SL_TRY(sl_coverage_of_path(context, query, r->coverage, viewpoints, path->points, path->count,
                               &path->found));
    for (size_t i = 0; i < path->found.count; i++)
        SL_TRY(add_part(context, path, &path->found.parts[i]));
    return SL_OK;
}

sl_status cover_path_make(sl_context *context, const cover_report *r, sl_query *query,
                          const sl_viewpoint *viewpoints, const char *name, cover_path *out) {
    char what[128];
    snprintf(what, sizeof what, "--path %s", name);
    SL_TRY(path_points_read(context, "path", name, &r->baked->map, &out->points, &out->count));
    SL_TRY(cover_path_find(context, r, query, viewpoints, out));
    return places_note_path(context, what, r->baked, out->points, out->count);
}

void cover_path_destroy(sl_context *context, cover_path *path) {
    sl_free(context, path->points);
    sl_free(context, path->unseen.items);
    sl_path_parts_destroy(context, &path->found);
    *path = (cover_path){0};
}

void cover_path_print(const cover_report *r, const cover_path *path) {
    const sl_path_parts *p = &path->found;
    const char *unit = r->baked->map.unit, *space = *unit ? " " : "";
    const int digits = sl_map_digits(&r->baked->map);
    if (!p->count) {
        printf("\n  all of the path is seen (%.4g%s%s)\n", p->length, space, unit);
        return;
    }
    printf("\n  %.4g%s%s of the path are not seen (%.3g %% of %.4g%s%s)%s\n", p->total, space, unit,
           100 * p->total / p->length, p->length, space, unit,
           p->count > PARTS_MOST ? ", the first parts:" : ":");
    for (size_t i = 0; i < p->count && i < PARTS_MOST; i++) {
        const sl_path_part *part = &p->parts[i];
        printf("  %10.4g to %-10.4g from %.*g,%.*g to %.*g,%.*g\n", part->from, part->to, digits,
               part->start.x, digits, part->start.y, digits, part->end.x, digits, part->end.y);
    }
}

void cover_path_add_json(json_fields *f, const cover_path *path) {
    json_open(f, "path");
    json_add_real(f, "length", path->found.length);
    json_add_real(f, "unseen_length", path->found.total);
    json_open_list(f, "unseen");
    for (size_t i = 0; i < path->found.count; i++) {
        const sl_path_part *part = &path->found.parts[i];
        const sl_point ends[2] = {part->start, part->end};
        json_open_item(f);
        json_add_real(f, "from", part->from);
        json_add_real(f, "to", part->to);
        json_add_points(f, "points", ends, 2);
        json_close(f);
    }
    json_close_list(f);
    json_close(f);
}

sl_status cover_path_write(sl_context *context, const cover_path *path, const char *name) {
    sl_output output;
    SL_TRY(sl_output_open(context, name, &output));
    fputs("from,to,from_x,from_y,to_x,to_y\n", output.stream);
    for (size_t i = 0; i < path->found.count; i++) {
        const sl_path_part *part = &path->found.parts[i];
        const double row[6] = {part->from,    part->to,    part->start.x,
                               part->start.y, part->end.x, part->end.y};
        for (int k = 0; k < 6; k++) {
            char text[SL_NUMBER_TEXT];
            sl_number_write(row[k], text);
            fprintf(output.stream, "%s%s", text, k < 5 ? "," : "\n");
        }
    }
    return sl_output_close(context, &output, SL_OK);
}
