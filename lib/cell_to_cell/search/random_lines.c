/// Random lines: an aggressive method, which finds no hidden pair but misses some visible ones.
///
/// From a number of points of each cell a line goes in a random direction, both ways, through all
/// portals that it passes strictly between their ends. All cells on the line see each other, if
/// they are no farther apart on it than the range. Narrow sightlines are missed first. With one-way
/// glass each line is taken one way only.
///
/// Mirrors: a line goes on straight in a reflected copy of the map (effects/mirrors.h). Cells in
/// different copies see each other by mirror. Where places in the copy are rounded, the line ends:
/// so behind oblique mirrors nothing is found.
#include "cell_to_cell/methods.h"
#include "cell_to_cell/rows.h"
#include "cell_to_cell/search/directions.h"
#include "geometry/length.h"

#include "effects/effects.h"
#include "effects/mirrors.h"
#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>
#include <pthread.h>

typedef struct sampling {
    const sl_space *space;
    const sl_see_options *options;
    bool one_way; ///< lines have a direction, and pairs are not mutual
    double range; ///< 0 for none
    pthread_mutex_t lock;
    sli_bit_rows rows;      ///< joined from the threads' forks, under the lock
    sli_bit_rows mirrored;  ///< likewise what is seen by mirror
    const sl_plan *mirrors; ///< NULL for none
    sli_mirror_sides sides; ///< where there are mirrors
} sampling;

/// A cell on a line from a to b. Where there is a range: the part of the line's length after which
/// it is surely entered, and that before which it is surely not left.
typedef struct stretch {
    uint32_t cell;
    bool back;     ///< before the cell in which `a` is
    uint8_t depth; ///< reflections up to here
    double entered, left;
} stretch;

/// One thread's own.
typedef struct sampler {
    sli_bit_rows rows, mirrored;
    SL_ARRAY(stretch) way; ///< the cells of a line
} sampler;

static void end_lines_worker(sl_context *context, void *job, void *state) {
    sampling *all = job;
    sampler *me = state;
    pthread_mutex_lock(&all->lock);
    sli_bit_rows_join(context, &all->rows, &me->rows);
    if (all->mirrors) sli_bit_rows_join(context, &all->mirrored, &me->mirrored);
    pthread_mutex_unlock(&all->lock);
    sl_free(context, me->way.items);
    sl_free(context, me);
}

static sl_status begin_lines_worker(sl_context *context, void *job, void **state) {
    const sampling *all = job;
    sampler *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    sl_status status = sli_bit_rows_fork(context, &all->rows, &me->rows);
    if (status == SL_OK && all->mirrors)
        status = sli_bit_rows_fork(context, &all->mirrored, &me->mirrored);
    if (status == SL_OK)
        *state = me;
    else
        end_lines_worker(context, job, me);
    return status;
}

/// A point of a cell: on the way from one of its corners to a point of its boundary.
static sl_point random_point(const sl_space *space, const sl_cell *cell, sl_random *random) {
    const sl_point *corners = space->vertices + cell->first_vertex;
    const uint32_t edge = (uint32_t)sl_random_below(random, cell->vertex_count);
    const sl_point a = corners[edge], b = corners[(edge + 1) % cell->vertex_count];
    const sl_point c = corners[sl_random_below(random, cell->vertex_count)];
    const double s = sl_random_unit(random), t = sl_random_unit(random);
    const sl_point on = {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)};
    return (sl_point){c.x + t * (on.x - c.x), c.y + t * (on.y - c.y)};
}

/// The directed portal that a line passes strictly; NULL for none.
static const sl_directed_portal *portal_on(const sampling *all, uint32_t cell, sl_line line) {
    const sl_cell *c = &all->space->cells[cell];
    for (uint32_t i = 0; i < c->directed_count; i++) {
        const sl_directed_portal *directed = &all->space->directed[c->first_directed + i];
        if (all->options->inside_only && !all->space->cells[directed->cell].inside) continue;
        if (sli_orient(line.a, line.b, directed->left) > 0 &&
            sli_orient(line.a, line.b, directed->right) < 0)
            return directed;
    }
    return NULL;
}

/// Where a line crosses a directed portal, in parts of its length, and how far rounding may be off.
static double place_on(sl_line line, const sl_directed_portal *directed, double *error) {
    const double dx = line.b.x - line.a.x, dy = line.b.y - line.a.y;
    const double ex = directed->left.x - directed->right.x,
                 ey = directed->left.y - directed->right.y;
    const double rx = directed->right.x - line.a.x, ry = directed->right.y - line.a.y;
    const double across = dx * ey - dy * ex, place = (rx * ey - ry * ex) / across;
    const double rounding = 0x1p-49 / fabs(across);
    *error = rounding * (fabs(rx * ey) + fabs(ry * ex)) +
             rounding * (fabs(dx * ey) + fabs(dy * ex)) * fabs(place);
    return place;
}

/// Goes along a line, to one end or (`back`) from it. It passes every portal strictly forwards and
/// so comes to no cell twice.
static sl_status walk(sl_context *context, const sampling *all, sampler *me, sl_line line,
                      bool back) {
    const sl_line towards = back ? (sl_line){line.b, line.a} : line;
    size_t last = 0;
    for (const sl_directed_portal *directed;
         (directed = portal_on(all, me->way.items[last].cell, towards));) {
        SL_TRY(SL_ARRAY_ROOM(context, &me->way, 1));
        stretch *from = &me->way.items[last], next = {.cell = directed->cell, .back = back};
        if (all->range > 0) {
            double error;
            const double place = place_on(line, directed, &error);
            *(back ? &from->entered : &from->left) = back ? place + error : place - error;
            *(back ? &next.left : &next.entered) = back ? place - error : place + error;
        }
        last = me->way.count;
        me->way.items[me->way.count++] = next;
    }
    return SL_OK;
}

/// What a line passes strictly on its way out of a cell in a frame: a portal, or a mirror.
typedef struct crossing {
    sl_directed_portal ends; ///< in the frame; its cell is the one behind
    uint32_t mirror;         ///< UINT32_MAX for a portal
} crossing;

/// Whether a line passes a place of a frame strictly; sets where that is. False where it is
/// rounded.
static bool passes(const sli_mirror_frame *frame, sl_line line, sl_point left, sl_point right,
                   crossing *out) {
    bool rounded = false;
    const uint32_t cell = out->ends.cell;
    out->ends = sli_unfold(frame, left, right, &rounded);
    out->ends.cell = cell;
    return !rounded && sli_orient(line.a, line.b, out->ends.left) > 0 &&
           sli_orient(line.a, line.b, out->ends.right) < 0;
}

static bool leave(const sampling *all, uint32_t cell, const sli_mirror_frame *frame, sl_line line,
                  crossing *out) {
    const sl_cell *c = &all->space->cells[cell];
    for (uint32_t i = 0; i < c->directed_count; i++) {
        const sl_directed_portal *directed = &all->space->directed[c->first_directed + i];
        if (all->options->inside_only && !all->space->cells[directed->cell].inside) continue;
        *out = (crossing){.ends.cell = directed->cell, .mirror = UINT32_MAX};
        if (passes(frame, line, directed->left, directed->right, out)) return true;
    }
    if (frame->depth >= all->mirrors->mirror_depth) return false;
    for (uint32_t i = all->sides.first[cell]; i < all->sides.first[cell + 1]; i++) {
        const sli_mirror_side *side = &all->sides.sides[i];
        *out = (crossing){.ends.cell = cell, .mirror = side->mirror};
        if (passes(frame, line, side->left, side->right, out)) return true;
    }
    return false;
}

/// Goes on along a line, in mirrors too, from the cell in which it starts.
static sl_status walk_mirrors(sl_context *context, const sampling *all, sampler *me, sl_line line) {
    sli_mirror_frame frame = sli_mirror_frame_of_map();
    crossing out;
    while (leave(all, me->way.items[me->way.count - 1].cell, &frame, line, &out)) {
        SL_TRY(SL_ARRAY_ROOM(context, &me->way, 1));
        stretch *from = &me->way.items[me->way.count - 1];
        stretch next = {.cell = out.ends.cell, .depth = (uint8_t)frame.depth};
        if (all->range > 0) {
            double error;
            const double place = place_on(line, &out.ends, &error);
            from->left = place - error;
            next.entered = place + error;
        }
        if (out.mirror != UINT32_MAX) {
            const sl_segment at = all->mirrors->map->mirrors[out.mirror].segment;
            frame = sli_mirror_frame_reflect(&frame, at);
            if (frame.rounded) return SL_OK;
            next.depth = (uint8_t)frame.depth;
        }
        me->way.items[me->way.count++] = next;
    }
    return SL_OK;
}

/// Whether the piece of the line between two of its cells, `b` found after `a`, is surely within
/// the range.
static bool is_in_range(const sampling *all, sl_line line, const stretch *a, const stretch *b) {
    if (!(all->range > 0) || a == b) return true;
    const double length = sli_length(line.b.x - line.a.x, line.b.y - line.a.y);
    const double between = b->back ? a->entered - b->left : b->entered - a->left;
    return between * length * (1 + 0x1p-50) <= all->range;
}

/// Notes what a line finds that goes on in mirrors. Cells with as many reflections before them see
/// each other straight on.
static sl_status sample_mirrors(sl_context *context, const sampling *all, sampler *me,
                                sl_line line) {
    SL_TRY(walk_mirrors(context, all, me, line));
    if (!all->one_way) SL_TRY(walk(context, all, me, line, true));
    const stretch *way = me->way.items;
    for (size_t i = 0; i < me->way.count; i++)
        for (size_t k = i; k < me->way.count; k++) {
            if (!is_in_range(all, line, &way[i], &way[k])) continue;
            sli_bit_rows *rows = way[i].depth == way[k].depth ? &me->rows : &me->mirrored;
            SL_TRY(sli_bit_rows_add_one(context, rows, way[i].cell, way[k].cell));
        }
    return SL_OK;
}

static sl_status sample(sl_context *context, const sampling *all, sampler *me, uint32_t cell,
                        sl_random *random) {
    const sl_cell *c = &all->space->cells[cell];
    const sl_box box = all->space->bounds;
    const sl_point a = random_point(all->space, c, random);
    const sl_point b = {box.min.x + sl_random_unit(random) * (box.max.x - box.min.x),
                        box.min.y + sl_random_unit(random) * (box.max.y - box.min.y)};
    if (a.x == b.x && a.y == b.y) return SL_OK;
    me->way.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &me->way, 1));
    me->way.items[me->way.count++] = (stretch){.cell = cell};
    if (all->mirrors) return sample_mirrors(context, all, me, (sl_line){a, b});
    SL_TRY(walk(context, all, me, (sl_line){a, b}, false));
    if (!all->one_way) SL_TRY(walk(context, all, me, (sl_line){a, b}, true));
    const stretch *way = me->way.items;
    for (size_t i = 0; i < me->way.count; i++)
        for (size_t k = i; k < me->way.count; k++)
            if (is_in_range(all, (sl_line){a, b}, &way[i], &way[k]))
                SL_TRY(sli_bit_rows_add_one(context, &me->rows, way[i].cell, way[k].cell));
    return SL_OK;
}

static sl_status sample_unit(sl_context *context, void *job, void *state, size_t unit) {
    const sampling *all = job;
    sampler *me = state;
    const sl_cell *cell = &all->space->cells[unit];
    if (!sli_looks_from(all->space, all->options->inside_only, (uint32_t)unit)) return SL_OK;
    SL_TRY(sli_bit_rows_add_one(context, &me->rows, (uint32_t)unit, (uint32_t)unit));
    for (uint32_t i = 0; i < cell->directed_count; i++) {
        const uint32_t next = all->space->directed[cell->first_directed + i].cell;
        if (!all->options->inside_only || all->space->cells[next].inside)
            SL_TRY(sli_bit_rows_add_one(context, &me->rows, (uint32_t)unit, next));
    }
    sl_random random = {all->options->seed + (uint64_t)unit * 0x9e3779b97f4a7c15u};
    random.state = sl_random_next(&random); // so that neighbours' numbers are not each other's
    for (uint32_t i = 0; i < all->options->samples; i++)
        SL_TRY(sample(context, all, me, (uint32_t)unit, &random));
    return SL_OK;
}

static sl_status keep_mirrored(sl_context *context, sampling *all, sl_visibility *out) {
    sl_visibility mirrored = {0};
    if (!all->one_way) SL_TRY(sli_bit_rows_mirror(context, &all->mirrored, SLI_ADD_MIRRORED));
    SL_TRY(sli_bit_rows_encode(context, &all->mirrored, &mirrored));
    out->mirrored = mirrored.pvs;
    out->account.mirrored_pairs = mirrored.account.pairs;
    return SL_OK;
}

static sl_status find_mirrors(sl_context *context, sampling *all) {
    if (!all->mirrors) return SL_OK;
    SL_TRY(sli_mirror_sides_find(context, all->space, all->mirrors->map, &all->sides));
    return sli_bit_rows_create(context, all->space->cell_count, all->options, &all->mirrored);
}

static sl_status sample_all(sl_context *context, sampling *all, sl_visibility *out) {
    SL_TRY(sli_bit_rows_create(context, all->space->cell_count, all->options, &all->rows));
    SL_TRY(find_mirrors(context, all));
    const sl_work work = {.job = all,
                          .begin = begin_lines_worker,
                          .unit = sample_unit,
                          .end = end_lines_worker,
                          .stage = "cell_to_cell",
                          .units = "cells"};
    SL_TRY(sl_work_run(context, &work, all->space->cell_count, all->options->threads));
    if (!all->one_way) SL_TRY(sli_bit_rows_mirror(context, &all->rows, SLI_ADD_MIRRORED));
    SL_TRY(sli_bit_rows_encode(context, &all->rows, out));
    return all->mirrors ? keep_mirrored(context, all, out) : SL_OK;
}

static sl_status see(sl_context *context, sampling *all, sl_visibility *out) {
    pthread_mutex_init(&all->lock, NULL);
    const sl_status status = sample_all(context, all, out);
    pthread_mutex_destroy(&all->lock);
    sli_bit_rows_destroy(context, &all->rows);
    sli_bit_rows_destroy(context, &all->mirrored);
    sli_mirror_sides_destroy(context, &all->sides);
    return status;
}

sl_status sli_see_sampling(sl_context *context, const sl_space *space,
                           const sl_see_options *options, sl_visibility *out) {
    if (options->trees)
        return sl_fail(context, SL_UNSUPPORTED, "the method 'sampling' makes no stab trees");
    sampling all = {.options = options};
    sl_visibility visibility = {.sight = options->sight, .guarantee = SL_AGGRESSIVE};
    sl_space open = {0};
    SL_TRY(sli_oneway_filtered(context, space, options->plan, &open, &all.space));
    all.one_way = all.space != space;
    all.range = options->plan ? options->plan->range : 0;
    if (options->plan && options->plan->effects & SL_EFFECT_MIRROR) all.mirrors = options->plan;
    const sl_status status = see(context, &all, &visibility);
    sl_space_destroy(context, &open);
    if (status == SL_OK)
        *out = visibility;
    else
        sl_visibility_destroy(context, &visibility);
    return status;
}
