#include "space/mesh_steps.h"

#include <stdlib.h>
#include <string.h>

void sl_mesh_steps_destroy(sl_context *context, sl_mesh_steps *steps) {
    sl_triangulation_destroy(context, &steps->delaunay);
    sl_triangulation_destroy(context, &steps->triangles);
    sl_free(context, steps->fresh);
    sl_free(context, steps->sides.items);
    sl_free(context, steps->taken);
    *steps = (sl_mesh_steps){0};
}

typedef struct recorder {
    sl_context *context;
    sl_mesh_steps *steps;
} recorder;

static sl_status watch(void *user, uint32_t half, uint32_t stuck) {
    const recorder *r = user;
    sl_mesh_steps *s = r->steps;
    SL_TRY(SL_ARRAY_ROOM(r->context, &s->sides, 1));
    if (stuck == SL_OUTSIDE) s->taken[half / 2] = (uint32_t)s->sides.count;
    s->sides.items[s->sides.count++] = (sl_mesh_side){half, stuck};
    return SL_OK;
}

static int compare_keys(const void *left, const void *right) {
    const uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return (a > b) - (a < b);
}

/// An edge by its points, whichever way it goes.
static uint64_t key_of(const sl_triangulation *t, size_t edge) {
    const uint64_t a = t->halves.items[2 * edge].from, b = t->halves.items[2 * edge + 1].from;
    return a < b ? a << 32 | b : b << 32 | a;
}

static sl_status find_fresh(sl_context *context, sl_mesh_steps *s) {
    const size_t count = s->delaunay.halves.count / 2, edges = s->triangles.halves.count / 2;
    uint64_t *keys = sl_alloc_array(context, count, sizeof *keys);
    s->fresh = sl_alloc_array(context, edges, sizeof *s->fresh);
    for (size_t i = 0; keys && i < count; i++) keys[i] = key_of(&s->delaunay, i);
    if (keys) qsort(keys, count, sizeof *keys, compare_keys);
    for (size_t i = 0; keys && s->fresh && i < edges; i++) {
        const uint64_t key = key_of(&s->triangles, i);
        s->fresh[i] = !bsearch(&key, keys, count, sizeof *keys, compare_keys);
    }
    const bool done = keys && s->fresh;
    sl_free(context, keys);
    return done ? SL_OK : SL_NO_MEMORY;
}

/// Records the merging, which is done on triangles of its own.
static sl_status record_sides(sl_context *context, const sl_planar *graph, const sl_box *box,
                              sl_mesh_steps *s) {
    const size_t edges = s->triangles.halves.count / 2;
    s->taken = sl_alloc_array(context, edges, sizeof *s->taken);
    if (!s->taken) return SL_NO_MEMORY;
    memset(s->taken, 0xff, edges * sizeof *s->taken);
    sl_triangulation merged = {0};
    recorder r = {context, s};
    SL_TRY(sl_triangulate(context, graph, box, &merged));
    const sl_status status = sl_mesh_merge(context, &merged, watch, &r, NULL);
    sl_triangulation_destroy(context, &merged);
    return status;
}

static sl_status record(sl_context *context, const sl_planar *graph, const sl_box *box,
                        sl_mesh_steps *s) {
    sl_planar points = *graph;
    points.edge_count = 0;
    SL_TRY(sl_triangulate(context, &points, box, &s->delaunay));
    SL_TRY(sl_triangulate(context, graph, box, &s->triangles));
    SL_TRY(find_fresh(context, s));
    return record_sides(context, graph, box, s);
}

sl_status sl_mesh_steps_record(sl_context *context, const sl_space *space, sl_mesh_steps *out) {
    const size_t count = (size_t)space->wall_count + space->seam_count;
    sl_segment *lines = sl_alloc_array(context, count, sizeof *lines);
    sl_planar graph = {0};
    sl_mesh_steps steps = {0};
    if (!lines) return SL_NO_MEMORY;
    for (size_t i = 0; i < space->wall_count; i++)
        lines[i] = (sl_segment){space->walls[i].a, space->walls[i].b};
    for (size_t i = 0; i < space->seam_count; i++)
        lines[space->wall_count + i] = space->seams[i].at;
    sl_status status = sl_planar_make(context, "the space", lines, count, 0, &graph);
    if (status == SL_OK) status = record(context, &graph, &space->bounds, &steps);
    sl_free(context, lines);
    sl_planar_destroy(context, &graph);
    if (status == SL_OK)
        *out = steps;
    else
        sl_mesh_steps_destroy(context, &steps);
    return status;
}

uint32_t sl_mesh_steps_next(const sl_mesh_steps *steps, size_t place, uint32_t half) {
    const sl_half_edge *halves = steps->triangles.halves.items;
    uint32_t next = halves[half].next;
    // Around the point, past the sides that have been taken out.
    while (steps->taken[next / 2] < place) next = halves[next ^ 1].next;
    return next;
}

void sl_mesh_steps_corner(const sl_mesh_steps *steps, size_t place, sl_point corner[3]) {
    const sl_triangulation *t = &steps->triangles;
    const uint32_t stuck = steps->sides.items[place].stuck;
    uint32_t before = stuck;
    for (uint32_t half; (half = sl_mesh_steps_next(steps, place, before)) != stuck;) before = half;
    const uint32_t after = sl_mesh_steps_next(steps, place, stuck ^ 1);
    corner[0] = t->points.items[t->halves.items[before].from];
    corner[1] = t->points.items[t->halves.items[stuck].from];
    corner[2] = t->points.items[sl_half_end(t, after)];
}
