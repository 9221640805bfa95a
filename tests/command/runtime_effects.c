/// What the runtime header answers of a map with effects, against the library: runtime_effects SLV
///
/// Prints a line for each kind of question: its name, then "+" and what the header leaves to the
/// library. Exits with 1, and prints where, if an answer is not what the header promises.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sightline_runtime.h"

#include "sightline/bake.h"
#include "sightline/support.h"

enum { SIDE = 12, BOXES_MOST = 8 };

typedef struct trial {
    sl_context *context;
    sl_baked baked;
    sl_query *query;
    sl_runtime level;
    sl_runtime_boxes boxes;
    sl_runtime_box list[BOXES_MOST], kept[BOXES_MOST];
    uint32_t *memory; ///< of the boxes
    uint32_t box_count;
    uint32_t *scratch, *cells;
    uint64_t *seen, *mirrored;
    unsigned char *shut;
    double *points;
    uint32_t room;
} trial;

static void must(const trial *t, sl_status status) {
    if (status == SL_OK) return;
    fprintf(stderr, "%s\n", sl_context_message(t->context));
    exit(1);
}

static void must_be(bool good, sl_point eye, const char *what) {
    if (good) return;
    fprintf(stderr, "eye %g,%g: %s\n", eye.x, eye.y, what);
    exit(1);
}

static void *room_for(size_t bytes) {
    void *block = calloc(1, bytes ? bytes : 1);
    if (!block) abort();
    return block;
}

static void start(trial *t, const char *path, sl_bytes *file) {
    t->context = sl_context_create(NULL);
    must(t, sl_file_read(t->context, path, file));
    must(t, sl_baked_read(t->context, path, &t->baked));
    must(t, sl_query_create(t->context, &t->baked, &t->query));
    const sl_runtime_status status = sl_runtime_open(file->data, file->size, &t->level);
    if (status != SL_RUNTIME_OK) {
        fprintf(stderr, "%s: %s\n", path, sl_runtime_status_text(status));
        exit(1);
    }
    const sl_runtime *r = &t->level;
    t->room = 4096;
    t->points = room_for(2 * (size_t)t->room * sizeof *t->points);
    t->cells = room_for(r->cell_count * sizeof *t->cells);
    t->seen = room_for(sl_eye_words(&t->baked.space) * sizeof *t->seen);
    t->mirrored = room_for(sl_eye_words(&t->baked.space) * sizeof *t->mirrored);
    t->shut = room_for(r->door_count);
    for (uint32_t i = 0; i < r->door_count; i++) t->shut[i] = !sl_runtime_door_open(r, i);
    for (size_t i = 0; i < t->baked.map.object_count && i < BOXES_MOST; i++) {
        const sl_box b = t->baked.map.objects[i].box;
        t->list[t->box_count++] = (sl_runtime_box){b.min.x, b.min.y, b.max.x, b.max.y, true};
    }
    const uint32_t entries = 64 * BOXES_MOST;
    t->memory = room_for(sl_runtime_boxes_count(r, t->box_count, entries) * sizeof *t->memory);
    sl_runtime_boxes_start(&t->boxes, r, t->kept, t->box_count, entries, t->memory);
    for (uint32_t i = 0; i < t->box_count; i++)
        if (!sl_runtime_boxes_move(&t->boxes, i, &t->list[i])) abort();
    t->scratch = room_for(sl_runtime_boxes_scratch_count(&t->boxes) * sizeof *t->scratch);
}

static void end(trial *t, sl_bytes *file) {
    free(t->points);
    free(t->cells);
    free(t->seen);
    free(t->mirrored);
    free(t->shut);
    free(t->memory);
    free(t->scratch);
    sl_query_destroy(t->context, t->query);
    sl_baked_destroy(t->context, &t->baked);
    sl_free(t->context, file->data);
    sl_context_destroy(t->context);
}

/// The cells that an eye sees, with the boxes away.
static void ask_cells(trial *t, const sl_view *view, const sl_runtime_view *eye) {
    const sl_runtime *r = &t->level;
    uint32_t direct;
    must(t, sl_query_set_boxes(t->context, t->query, NULL, 0));
    must(t, sl_query_look(t->context, t->query, view, NULL, t->seen, NULL));
    must(t, sl_query_look_mirrored(t->context, t->query, view, NULL, t->mirrored, NULL));
    const uint32_t count =
        sl_runtime_look_mirrored(r, eye, t->shut, 0, t->scratch, t->cells, r->cell_count, &direct);
    uint32_t found = 0, found_mirrored = 0, all = 0, all_mirrored = 0;
    for (uint32_t i = 0; i < count; i++) {
        found += i < direct && sl_eye_sees(t->seen, t->cells[i]);
        found_mirrored += sl_eye_sees(t->mirrored, t->cells[i]);
    }
    for (uint32_t cell = 0; cell < r->cell_count; cell++) {
        all += sl_eye_sees(t->seen, cell);
        all_mirrored += sl_eye_sees(t->mirrored, cell);
    }
    must_be(found == direct && found == all, view->eye, "cells differ");
    must_be(found_mirrored == all_mirrored, view->eye, "a cell is missed by mirror");
}

static double area_of(const double *points, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double *p = points + 2 * (size_t)i, *q = points + 2 * (size_t)((i + 1) % count);
        sum += (p[0] - points[0]) * (q[1] - points[1]) - (p[1] - points[1]) * (q[0] - points[0]);
    }
    return sum / 2;
}

/// The polygon that an eye sees directly. Arcs of the range are chords here and in the library.
static void ask_polygon(trial *t, const sl_view *view, const sl_runtime_view *eye) {
    sl_region region = {0};
    must(t, sl_query_region(t->context, t->query, view, &region));
    const uint32_t count =
        sl_runtime_visible_polygon(&t->level, eye, t->shut, 0, t->scratch, t->points, t->room);
    must_be(count <= t->room, view->eye, "the polygon has too many points");
    const double area = area_of(t->points, count), exact = sl_region_area(&region);
    // A chord of 1/128 of a turn leaves out less than 1/2000 of its sector.
    const double slack = t->level.range > 0 ? 5e-4 : 1e-9;
    must_be(fabs(area - exact) <= slack * (1 + exact), view->eye, "polygons differ");
    sl_region_destroy(t->context, &region);
}

static void ask_boxes(trial *t, const sl_view *view, const sl_runtime_view *eye) {
    sl_moving_box boxes[BOXES_MOST] = {0};
    bool seen[BOXES_MOST] = {false};
    unsigned char found[BOXES_MOST] = {0};
    for (uint32_t i = 0; i < t->box_count; i++)
        boxes[i] = (sl_moving_box){t->baked.map.objects[i].box, true};
    must(t, sl_query_set_boxes(t->context, t->query, boxes, t->box_count));
    must(t, sl_query_boxes_seen(t->context, t->query, view, seen, NULL));
    sl_runtime_boxes_seen(&t->boxes, eye, t->shut, 0, t->scratch, found);
    for (uint32_t i = 0; i < t->box_count; i++)
        must_be(found[i] == seen[i], view->eye, "boxes differ");
}

int main(int argc, char **argv) {
    trial t = {0};
    sl_bytes file = {0};
    if (argc != 2) {
        fputs("usage: runtime_effects SLV\n", stderr);
        return 2;
    }
    start(&t, argv[1], &file);
    const sl_runtime *r = &t.level;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double u = (i % SIDE + 0.37) / SIDE, v = (i / SIDE + 0.61) / SIDE;
        const sl_view view = sl_view_all_round(
            (sl_point){r->min_x + u * (r->max_x - r->min_x), r->min_y + v * (r->max_y - r->min_y)});
        const sl_runtime_view eye = sl_runtime_view_all_round(view.eye.x, view.eye.y);
        ask_cells(&t, &view, &eye);
        ask_polygon(&t, &view, &eye);
        ask_boxes(&t, &view, &eye);
    }
    printf("runtime: cells\t+\t%s\n",
           r->mirrors ? "by mirror conservative: what the eye's cell sees by mirror" : "");
    printf("runtime: polygon\t+\t%s%s\n", r->mirrors ? "mirrors are walls in the header" : "",
           t.box_count ? "\tthe polygon knows no boxes" : "");
    printf("runtime: boxes\t+\t%s\n", r->mirrors ? "mirrors are walls in the header" : "");
    end(&t, &file);
    return 0;
}
