/// Planning an edit of a mesh that lives: which cells it takes apart, and what they become.
///
///     written triangles  ->  cells that lost one  ->  all triangles of these: the region
///         ->  merged again, the longest side first (mesh.c)  ->  new cells
///
/// Sides between the region and cells around it are tried, too: a cell around may become part of a
/// new cell. So no two cells are left that could be one, whatever was edited before. New cells that
/// have just the triangles of an old one keep its number.
#include "world/live.h"

#include "geometry/length.h"
#include "geometry/orient.h"

#include <stdlib.h>
#include <string.h>

static bool is_in_region(const sli_live *l, uint32_t half) {
    return l->mark[sli_live_triangle(l, half)] == l->now;
}

static sl_status dissolve(sli_live *l, uint32_t cell) {
    if (cell == SL_NO_CELL || l->dissolved[cell] == l->now) return SL_OK;
    SL_TRY(sli_numbers_push(l->context, &l->old, cell));
    l->dissolved[cell] = l->now;
    return SL_OK;
}

static sl_status unmerge(sli_live *l, uint32_t edge) {
    if (!l->inner[edge]) return SL_OK;
    SL_TRY(sli_numbers_push(l->context, &l->unmerged, edge));
    l->inner[edge] = 0;
    return SL_OK;
}

static sl_status add_triangle(sli_live *l, uint32_t half) {
    const uint32_t triangle = sli_live_triangle(l, half);
    if (l->mark[triangle] == l->now) return SL_OK;
    SL_TRY(sli_numbers_push(l->context, &l->region, triangle));
    l->mark[triangle] = l->now;
    return SL_OK;
}

/// Makes room for what is kept of half-edges.
static sl_status grow(sli_live *l) {
    const size_t old = l->owner ? l->place_room : 0, count = l->triangles.halves.count;
    if (count <= old) return SL_OK;
    SL_TRY(sl_reserve(l->context, &l->owner, &l->half_room, count, sizeof *l->owner));
    SL_TRY(sl_reserve(l->context, &l->wrote, &l->wrote_room, count, sizeof *l->wrote));
    SL_TRY(sl_reserve(l->context, &l->mark, &l->mark_room, count, sizeof *l->mark));
    SL_TRY(sl_reserve(l->context, &l->inner, &l->inner_room, count, sizeof *l->inner));
    SL_TRY(sl_reserve(l->context, &l->place, &l->place_room, count, sizeof *l->place));
    for (size_t i = old; i < l->place_room; i++) {
        if (i < l->half_room) l->owner[i] = SL_NO_CELL;
        if (i < l->wrote_room) l->wrote[i] = 0;
        if (i < l->mark_room) l->mark[i] = 0;
        if (i < l->inner_room) l->inner[i] = 0;
        l->place[i] = 0;
    }
    return SL_OK;
}

// --- the region

/// Notes a half-edge that was written, and takes its cell apart.
static sl_status note_written(sli_live *l, uint32_t half) {
    if (l->wrote[half] == l->now) return SL_OK;
    l->wrote[half] = l->now;
    SL_TRY(unmerge(l, half / 2));
    return dissolve(l, l->owner[half]);
}

static bool is_inside_triangle(const sli_live *l, uint32_t half) {
    return !sli_live_is_free(l, half) && !sli_half_is_outside(&l->triangles, half);
}

static sl_status find_region(sli_live *l) {
    const sli_written *written = l->maker.journal.items;
    const size_t count = l->maker.journal.count;
    for (size_t i = 0; i < count; i++) {
        const uint32_t at = written[i].index;
        if (written[i].kind == SLI_WORD_LABEL) {
            SL_TRY(note_written(l, 2 * at));
            SL_TRY(note_written(l, 2 * at + 1));
        } else if (written[i].kind <= SLI_WORD_NEXT) {
            SL_TRY(note_written(l, at));
        }
    }
    for (size_t i = 0; i < count; i++) {
        const uint32_t at = written[i].index;
        if (written[i].kind > SLI_WORD_LABEL) continue;
        const uint32_t half = written[i].kind == SLI_WORD_LABEL ? 2 * at : at;
        if (is_inside_triangle(l, half)) SL_TRY(add_triangle(l, half));
        if (written[i].kind == SLI_WORD_LABEL && is_inside_triangle(l, half + 1))
            SL_TRY(add_triangle(l, half + 1));
    }
    for (size_t i = 0; i < l->region.count; i++) {
        uint32_t half = l->region.items[i];
        for (int k = 0; k < 3; k++, half = sli_live_next(l, half)) {
            const uint32_t twin = half ^ 1;
            if (sli_half_is_outside(&l->triangles, twin) || l->owner[twin] == SL_NO_CELL ||
                l->dissolved[l->owner[twin]] != l->now)
                continue;
            SL_TRY(add_triangle(l, twin));
        }
    }
    return SL_OK;
}

static sl_status take_all(sli_live *l) {
    for (uint32_t half = 0; half < l->triangles.halves.count; half++)
        if (is_inside_triangle(l, half)) SL_TRY(add_triangle(l, half));
    return SL_OK;
}

// --- merging

static int compare_sides(const void *left, const void *right) {
    const sli_live_side *a = left, *b = right;
    if (a->length != b->length) return a->length > b->length ? -1 : 1;
    return (a->half > b->half) - (a->half < b->half);
}

static sl_status list_sides(sli_live *l) {
    const sli_triangulation *t = &l->triangles;
    l->sides.count = 0;
    for (size_t i = 0; i < l->region.count; i++) {
        uint32_t half = l->region.items[i];
        for (int k = 0; k < 3; k++, half = sli_live_next(l, half)) {
            SL_TRY(unmerge(l, half / 2));
            if (t->labels[half / 2] || sli_half_is_outside(t, half ^ 1) ||
                (half % 2 && is_in_region(l, half ^ 1)))
                continue;
            const sl_point a = sli_live_start(l, half), b = sli_live_end(l, half);
            SL_TRY(SL_ARRAY_ROOM(l->context, &l->sides, 1));
            l->sides.items[l->sides.count++] =
                (sli_live_side){sli_length(b.x - a.x, b.y - a.y), half};
        }
    }
    if (l->sides.count)
        qsort(l->sides.items, l->sides.count, sizeof *l->sides.items, compare_sides);
    return SL_OK;
}

static uint32_t previous_side(const sli_live *l, uint32_t half) {
    uint32_t at = sli_live_next(l, sli_live_next(l, half));
    while (l->inner[at / 2]) at = sli_live_next(l, sli_live_next(l, at ^ 1));
    return at;
}

/// Whether the corner where a side starts is convex without it.
static bool leaves_convex(const sli_live *l, uint32_t half) {
    return sli_goes_on(sli_live_start(l, previous_side(l, half)), sli_live_start(l, half),
                       sli_live_end(l, sli_live_next_side(l, half ^ 1)));
}

/// Adds the triangles of a cell around the region.
static sl_status absorb(sli_live *l, uint32_t half) {
    if (is_in_region(l, half)) return SL_OK;
    size_t at = l->region.count;
    SL_TRY(dissolve(l, l->owner[half]));
    SL_TRY(add_triangle(l, half));
    for (; at < l->region.count; at++) {
        uint32_t side = l->region.items[at];
        for (int k = 0; k < 3; k++, side = sli_live_next(l, side))
            if (l->inner[side / 2]) SL_TRY(add_triangle(l, side ^ 1));
    }
    return SL_OK;
}

static sl_status merge(sli_live *l) {
    for (size_t i = 0; i < l->sides.count; i++) {
        const uint32_t half = l->sides.items[i].half;
        if (!leaves_convex(l, half) || !leaves_convex(l, half ^ 1)) continue;
        SL_TRY(absorb(l, half));
        SL_TRY(absorb(l, half ^ 1));
        SL_TRY(sli_numbers_push(l->context, &l->merged, half / 2));
        l->inner[half / 2] = 1;
    }
    return SL_OK;
}

// --- new cells

/// Whether a new cell is an old one.
static uint32_t kept_number(const sli_live *l, const sli_live_cell *c) {
    const uint32_t number = l->owner[c->half];
    if (number == SL_NO_CELL || l->space.cells[number].vertex_count != c->corners ||
        c->triangle_count != c->corners - 2)
        return SL_NO_CELL;
    for (uint32_t i = 0; i < c->triangle_count; i++) {
        uint32_t half = l->triangles_of.items[c->first_triangle + i];
        for (int k = 0; k < 3; k++, half = sli_live_next(l, half))
            if (l->wrote[half] == l->now || l->owner[half] != number) return SL_NO_CELL;
    }
    return number;
}

/// Collects the triangles of a new cell. Their mark becomes that of the edit + 1.
static sl_status collect_cell(sli_live *l, uint32_t triangle) {
    const uint32_t first = (uint32_t)l->triangles_of.count;
    sli_live_cell cell = {.first_triangle = first, .half = SL_NO_CELL};
    SL_TRY(sli_numbers_push(l->context, &l->triangles_of, triangle));
    l->mark[triangle] = l->now + 1;
    for (size_t at = first; at < l->triangles_of.count; at++) {
        uint32_t half = l->triangles_of.items[at];
        for (int k = 0; k < 3; k++, half = sli_live_next(l, half)) {
            if (!l->inner[half / 2]) {
                cell.half = half;
                continue;
            }
            const uint32_t other = sli_live_triangle(l, half ^ 1);
            if (l->mark[other] == l->now + 1) continue;
            SL_TRY(sli_numbers_push(l->context, &l->triangles_of, other));
            l->mark[other] = l->now + 1;
        }
    }
    cell.triangle_count = (uint32_t)l->triangles_of.count - first;
    uint32_t best = cell.half, half = cell.half;
    do {
        if (sli_compare_points(sli_live_start(l, half), sli_live_start(l, best)) < 0) best = half;
        cell.corners++;
        half = sli_live_next_side(l, half);
    } while (half != cell.half);
    cell.half = best;
    cell.number = kept_number(l, &cell);
    if (cell.number != SL_NO_CELL) l->dissolved[cell.number] = 0;
    SL_TRY(SL_ARRAY_ROOM(l->context, &l->cells, 1));
    l->cells.items[l->cells.count++] = cell;
    return SL_OK;
}

static sl_status collect_cells(sli_live *l) {
    for (size_t i = 0; i < l->region.count; i++)
        if (l->mark[l->region.items[i]] == l->now) SL_TRY(collect_cell(l, l->region.items[i]));
    return SL_OK;
}

/// Finds the buckets of new cells and of old ones.
static sl_status find_buckets(sli_live *l) {
    const sl_space *s = &l->space;
    if (!s->grid.columns) return SL_OK;
    for (size_t i = 0; i < l->cells.count; i++) {
        sli_live_cell *cell = &l->cells.items[i];
        if (cell->number != SL_NO_CELL) continue;
        uint32_t half = cell->half;
        l->loop.count = 0;
        SL_TRY(SL_ARRAY_ROOM(l->context, &l->loop, cell->corners));
        for (uint32_t k = 0; k < cell->corners; k++, half = sli_live_next_side(l, half))
            l->loop.items[l->loop.count++] = sli_live_start(l, half);
        cell->first_bucket = (uint32_t)l->new_buckets.count;
        SL_TRY(sli_cell_grid_reach(l->context, s, l->loop.items, cell->corners, &l->new_buckets));
        cell->bucket_count = (uint32_t)l->new_buckets.count - cell->first_bucket;
    }
    for (size_t i = 0; i < l->old.count; i++) {
        const sl_cell *cell = &s->cells[l->old.items[i]];
        const size_t at = l->old_buckets.count;
        if (l->dissolved[l->old.items[i]] != l->now) continue;
        SL_TRY(SL_ARRAY_ROOM(l->context, &l->old_buckets, 1));
        l->old_buckets.count++;
        SL_TRY(sli_cell_grid_reach(l->context, s, s->vertices + cell->first_vertex,
                                   cell->vertex_count, &l->old_buckets));
        l->old_buckets.items[at] = (uint32_t)(l->old_buckets.count - at - 1);
    }
    return SL_OK;
}

static sl_status plan(sli_live *l, bool all) {
    SL_TRY(grow(l));
    SL_TRY(all ? take_all(l) : find_region(l));
    SL_TRY(list_sides(l));
    SL_TRY(merge(l));
    SL_TRY(collect_cells(l));
    SL_TRY(find_buckets(l));
    return sli_live_room(l);
}

void sli_live_next_mark(sli_live *l) {
    if (l->now > UINT32_MAX - 4) {
        memset(l->mark, 0, l->mark_room * sizeof *l->mark);
        memset(l->wrote, 0, l->wrote_room * sizeof *l->wrote);
        memset(l->dissolved, 0, l->cell_room * sizeof *l->dissolved);
        l->now = 0;
    }
    l->now += 2;
}

sl_status sli_live_plan(sli_live *l) {
    sli_live_next_mark(l);
    l->region.count = l->old.count = l->unmerged.count = l->merged.count = 0;
    l->triangles_of.count = l->cells.count = l->new_buckets.count = l->old_buckets.count = 0;
    l->planned = true;
    return plan(l, false);
}

void sli_live_undo(sli_live *l) {
    sli_triangulator_undo(&l->maker);
    if (!l->planned) return;
    for (size_t i = 0; i < l->merged.count; i++) l->inner[l->merged.items[i]] = 0;
    for (size_t i = 0; i < l->unmerged.count; i++) l->inner[l->unmerged.items[i]] = 1;
    l->planned = false;
}

void sli_live_apply(sli_live *l) {
    sli_live_write(l);
    // Edges that are free now are of no cell.
    for (size_t i = 0; i < l->maker.journal.count; i++) {
        const sli_written *w = &l->maker.journal.items[i];
        if (w->kind == SLI_WORD_FROM && sli_live_is_free(l, w->index))
            l->owner[w->index] = SL_NO_CELL;
    }
    l->maker.journal.count = 0;
    l->maker.keeps_journal = l->planned = false;
}

void sli_live_go_near(sli_live *l, sl_point at) {
    const sl_cell_grid *g = &l->space.grid;
    const uint32_t bucket = sli_cell_grid_bucket(&l->space, at);
    if (g->first[bucket] == sli_cell_grid_stop(g, bucket)) return;
    const uint32_t half = l->half_of[g->cells[g->first[bucket]]];
    if (is_inside_triangle(l, half)) l->maker.last = half;
}

// --- making one

sl_status sli_live_create(sl_context *context, const sli_planar *graph, const sl_box *bounds,
                          sli_live_label *label, sli_live_seams *seams, void *user, sli_live *out) {
    *out = (sli_live){.context = context, .label = label, .seams = seams, .user = user, .now = 2};
    out->space.bounds = *bounds;
    SL_TRY(sli_triangulate(context, graph, bounds, &out->triangles));
    out->triangles.out_room = out->triangles.points.count;
    out->maker = (sli_triangulator){
        .context = context, .t = &out->triangles, .scale = sli_triangulator_scale(bounds)};
    SL_TRY(plan(out, true));
    sli_live_write(out);
    out->gone.count = out->came.count = 0;
    out->maker.last = out->half_of[0];
    return sli_live_start_grid(out);
}

void sli_live_destroy(sl_context *context, sli_live *l) {
    l->maker.context = context;
    sli_triangulator_end(&l->maker);
    sli_triangulation_destroy(context, &l->triangles);
    sl_space *s = &l->space;
    sl_outline *o = &l->outline;
    void *const blocks[] = {l->owner,
                            l->wrote,
                            l->mark,
                            l->inner,
                            l->place,
                            l->half_of,
                            l->dissolved,
                            s->cells,
                            s->vertices,
                            s->portals,
                            s->directed,
                            s->walls,
                            s->neighbour,
                            s->seam_portals,
                            s->grid.first,
                            s->grid.stop,
                            s->grid.cells,
                            l->bucket_class,
                            o->sides,
                            o->limited,
                            o->first,
                            o->first_part,
                            o->parts,
                            l->room_of,
                            l->region.items,
                            l->old.items,
                            l->sides.items,
                            l->unmerged.items,
                            l->merged.items,
                            l->triangles_of.items,
                            l->cells.items,
                            l->new_buckets.items,
                            l->old_buckets.items,
                            l->loop.items,
                            l->gone.items,
                            l->came.items};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) sl_free(context, blocks[i]);
    *l = (sli_live){0};
}
