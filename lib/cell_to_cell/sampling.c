/// Lines at random: from a number of points of each cell in a random direction, both ways, through
/// whatever portals the line passes strictly between their ends. All cells on a line see each
/// other. What no line hits is missed: narrow sightlines first.
#include "cell_to_cell/bit_rows.h"
#include "cell_to_cell/methods.h"

#include "base/random.h"
#include "base/threads.h"
#include "geometry/orient.h"

#include <pthread.h>

typedef struct sampling {
    const sl_space *space;
    const sl_see_options *options;
    pthread_mutex_t lock;
    sl_bit_rows rows; ///< joined from the threads' forks, under the lock
} sampling;

/// One thread's own.
typedef struct sampler {
    sl_bit_rows rows;
    SL_ARRAY(uint32_t) way; ///< the cells of a line
} sampler;

static void end(sl_context *context, void *job, void *state) {
    sampling *all = job;
    sampler *me = state;
    pthread_mutex_lock(&all->lock);
    sl_bit_rows_join(context, &all->rows, &me->rows);
    pthread_mutex_unlock(&all->lock);
    sl_free(context, me->way.items);
    sl_free(context, me);
}

static sl_status begin(sl_context *context, void *job, void **state) {
    const sampling *all = job;
    sampler *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    const sl_status status = sl_bit_rows_fork(context, &all->rows, &me->rows);
    if (status == SL_OK)
        *state = me;
    else
        sl_free(context, me);
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

/// The exit that a line passes strictly; NULL for none.
static const sl_exit *exit_on(const sampling *all, uint32_t cell, sl_line line) {
    const sl_cell *c = &all->space->cells[cell];
    for (uint32_t i = 0; i < c->exit_count; i++) {
        const sl_exit *exit = &all->space->exits[c->first_exit + i];
        if (all->options->inside_only && !all->space->cells[exit->cell].inside) continue;
        if (sl_orient(line.a, line.b, exit->left) > 0 && sl_orient(line.a, line.b, exit->right) < 0)
            return exit;
    }
    return NULL;
}

/// Goes along a line. It passes every portal strictly forwards and so comes to no cell twice.
static sl_status walk(sl_context *context, const sampling *all, sampler *me, uint32_t cell,
                      sl_line line) {
    for (const sl_exit *exit; (exit = exit_on(all, cell, line)); cell = exit->cell) {
        SL_TRY(SL_ARRAY_ROOM(context, &me->way, 1));
        me->way.items[me->way.count++] = exit->cell;
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
    me->way.items[me->way.count++] = cell;
    SL_TRY(walk(context, all, me, cell, (sl_line){a, b}));
    SL_TRY(walk(context, all, me, cell, (sl_line){b, a}));
    for (size_t i = 0; i < me->way.count; i++)
        for (size_t k = i; k < me->way.count; k++)
            SL_TRY(sl_bit_rows_add_one(context, &me->rows, me->way.items[i], me->way.items[k]));
    return SL_OK;
}

static sl_status sample_unit(sl_context *context, void *job, void *state, size_t unit) {
    const sampling *all = job;
    sampler *me = state;
    const sl_cell *cell = &all->space->cells[unit];
    if (all->options->inside_only && !cell->inside) return SL_OK;
    SL_TRY(sl_bit_rows_add_one(context, &me->rows, (uint32_t)unit, (uint32_t)unit));
    for (uint32_t i = 0; i < cell->exit_count; i++) {
        const uint32_t next = all->space->exits[cell->first_exit + i].cell;
        if (!all->options->inside_only || all->space->cells[next].inside)
            SL_TRY(sl_bit_rows_add_one(context, &me->rows, (uint32_t)unit, next));
    }
    sl_random random = {all->options->seed + (uint64_t)unit * 0x9e3779b97f4a7c15u};
    random.state = sl_random_next(&random); // so that neighbours' numbers are not each other's
    for (uint32_t i = 0; i < all->options->samples; i++)
        SL_TRY(sample(context, all, me, (uint32_t)unit, &random));
    return SL_OK;
}

static sl_status sample_all(sl_context *context, sampling *all, sl_visibility *out) {
    SL_TRY(sl_bit_rows_create(context, all->space->cell_count, all->options, &all->rows));
    const sl_work work = {.job = all,
                          .begin = begin,
                          .unit = sample_unit,
                          .end = end,
                          .stage = "cell_to_cell",
                          .units = "cells"};
    SL_TRY(sl_work_run(context, &work, all->space->cell_count, all->options->threads));
    SL_TRY(sl_bit_rows_mirror(context, &all->rows, SL_ADD_MIRRORED));
    return sl_bit_rows_encode(context, &all->rows, out);
}

sl_status sl_see_sampling(sl_context *context, const sl_space *space, const sl_see_options *options,
                          sl_visibility *out) {
    if (options->trees)
        return sl_fail(context, SL_UNSUPPORTED, "the method 'sampling' makes no stab trees");
    sampling all = {.space = space, .options = options};
    sl_visibility visibility = {.sight = options->sight, .guarantee = SL_AGGRESSIVE};
    pthread_mutex_init(&all.lock, NULL);
    const sl_status status = sample_all(context, &all, &visibility);
    pthread_mutex_destroy(&all.lock);
    sl_bit_rows_destroy(context, &all.rows);
    if (status == SL_OK) *out = visibility;
    return status;
}
