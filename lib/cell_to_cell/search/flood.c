/// Upper bounds on what is seen: by portals in pairs, by mirrors, and by the view range.
///
/// Portals in pairs: from each directed portal on, through all portals that lie ahead of it, at
/// least in part, and have some of it behind them, as Quake's vis does before it looks closer.
/// Signs are exact, so that nothing is missed. Cost: cells times directed portals, at most.
///
/// Mirrors: a line is reflected in a cell with a mirror on its side, and is straight before and
/// after. So a cell sees by mirror no more than what such cells see that it may see itself; with
/// more reflections, what such cells see that these may see, and so on.
///
/// The range: the nearest points of two convex cells that have none in common are a corner of one
/// and a place on a side of the other. The farthest points are corners of both. Boxes are compared
/// first. Rounding goes to the safe side.
#include "base/size.h"
#include "cell_to_cell/search/bounds.h"
#include "geometry/length.h"

#include "cell_to_cell/methods.h"
#include "cell_to_cell/pvs_rows.h"
#include "effects/effects.h"
#include "effects/mirrors.h"
#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

/// Whether some of a portal lies ahead of (`sign` -1) or behind (1) a directed portal; for closed
/// sight its line is enough.
static bool reaches(const sl_directed_portal *directed, sl_point left, sl_point right, int sign,
                    bool closed) {
    const int least = closed ? 0 : 1;
    return sign * sli_orient(directed->right, directed->left, left) >= least ||
           sign * sli_orient(directed->right, directed->left, right) >= least;
}

uint32_t sli_flood_through(const sl_space *space, const sl_see_options *options,
                           const sl_directed_portal *directed, uint32_t most, sl_bits *set,
                           uint32_t *found) {
    const bool closed = options->sight == SL_CLOSED;
    uint32_t count = 0;
    if (options->inside_only && !space->cells[directed->cell].inside) return 0;
    sl_bits_add(set, directed->cell);
    found[count++] = directed->cell;
    for (uint32_t done = 0; done < count && count <= most; done++) {
        const sl_cell *cell = &space->cells[found[done]];
        for (uint32_t i = 0; i < cell->directed_count; i++) {
            const sl_directed_portal *next = &space->directed[cell->first_directed + i];
            if (sl_bits_has(set, next->cell)) continue;
            if (options->inside_only && !space->cells[next->cell].inside) continue;
            if (!reaches(directed, next->left, next->right, -1, closed)) continue;
            if (!reaches(next, directed->left, directed->right, 1, closed)) continue;
            sl_bits_add(set, next->cell);
            found[count++] = next->cell;
        }
    }
    return count;
}

// --- the method

typedef struct flood {
    const sl_space *space;
    const sl_see_options *options;
    bool hurries;      ///< gives up where that is enough
    bool one_way;      ///< pairs are not mutual
    sli_bit_rows rows; ///< each is written by one thread
} flood;

/// One thread's own.
typedef struct flooder {
    uint32_t *found;  ///< through one directed portal
    sl_bits *set;     ///< of them
    sli_word_set row; ///< of them through all directed portals
} flooder;

static void end_flood_worker(sl_context *context, void *job, void *state) {
    (void)job;
    flooder *me = state;
    sl_free(context, me->found);
    sl_free(context, me->set);
    sli_word_set_destroy(context, &me->row);
    sl_free(context, me);
}

static sl_status begin_flood_worker(sl_context *context, void *job, void **state) {
    const flood *all = job;
    flooder *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    me->found = sl_alloc_array(context, all->space->cell_count, sizeof *me->found);
    me->set = sl_alloc_array(context, all->rows.words, sizeof *me->set);
    if (me->found && me->set &&
        sli_word_set_create(context, all->space->cell_count, &me->row) == SL_OK) {
        *state = me;
        return SL_OK;
    }
    end_flood_worker(context, job, me);
    return SL_NO_MEMORY;
}

static sl_status flood_unit(sl_context *context, void *job, void *state, size_t unit) {
    flood *all = job;
    flooder *me = state;
    const sl_cell *cell = &all->space->cells[unit];
    if (!sli_looks_from(all->space, all->options->inside_only, (uint32_t)unit)) return SL_OK;
    if (all->hurries && sli_is_enough(all->options)) return SL_CANCELLED;
    sli_word_set_add(&me->row, (uint32_t)unit);
    for (uint32_t i = 0; i < cell->directed_count; i++) {
        const uint32_t count = sli_flood_through(all->space, all->options,
                                                 &all->space->directed[cell->first_directed + i],
                                                 all->space->cell_count, me->set, me->found);
        for (uint32_t k = 0; k < count; k++) {
            sli_word_set_add(&me->row, me->found[k]);
            me->set[me->found[k] / 64] = 0;
        }
    }
    SL_TRY(sli_bit_rows_add(context, &all->rows, (uint32_t)unit, &me->row));
    sli_word_set_clear(&me->row);
    return sl_check_cancelled(context);
}

static sl_status flood_all(sl_context *context, flood *all, sl_visibility *out) {
    SL_TRY(sli_bit_rows_create(context, all->space->cell_count, all->options, &all->rows));
    const sl_work work = {.job = all,
                          .begin = begin_flood_worker,
                          .unit = flood_unit,
                          .end = end_flood_worker,
                          .stage = "cell_to_cell",
                          .units = "cells"};
    SL_TRY(sl_work_run(context, &work, all->space->cell_count, all->options->threads));
    if (!all->one_way) SL_TRY(sli_bit_rows_mirror(context, &all->rows, SLI_KEEP_MUTUAL));
    return sli_bit_rows_encode(context, &all->rows, out);
}

/// Cells that are farther apart than the range are left out.
static sl_status hold_against_range(sl_context *context, const flood *all, sl_visibility *out) {
    const double range = all->options->plan ? all->options->plan->range : 0;
    if (!(range > 0)) return SL_OK;
    sl_pvs within;
    SL_TRY(sli_pvs_within(context, all->space, &out->pvs, range, SLI_SOME_WITHIN, &within));
    sl_pvs_destroy(context, &out->pvs);
    out->pvs = within;
    out->account.pairs = sli_pvs_pairs(&within);
    return SL_OK;
}

sl_status sli_see_flood(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_visibility *out) {
    if (options->trees)
        return sl_fail(context, SL_UNSUPPORTED, "the method 'flood' makes no stab trees");
    flood all = {.options = options};
    sl_visibility visibility = {.sight = options->sight, .guarantee = SL_CONSERVATIVE};
    sl_space open = {0};
    SL_TRY(sli_oneway_filtered(context, space, options->plan, &open, &all.space));
    all.one_way = all.space != space;
    sl_status status = flood_all(context, &all, &visibility);
    if (status == SL_OK) status = hold_against_range(context, &all, &visibility);
    if (status == SL_OK && options->plan && options->plan->effects & SL_EFFECT_MIRROR) {
        status = sli_mirrored_bound(context, space, options, &visibility.pvs, &visibility.mirrored);
        visibility.account.mirrored_pairs = sli_pvs_pairs(&visibility.mirrored);
    }
    sl_space_destroy(context, &open);
    sli_bit_rows_destroy(context, &all.rows);
    if (status == SL_OK)
        *out = visibility;
    else
        sl_visibility_destroy(context, &visibility);
    return status;
}

// --- the bound for sets that are not decided

/// Cells that portals join, as rows; and which of them each cell is in.
typedef struct components {
    sli_pvs_maker rows;
    uint32_t *of; ///< by cell; UINT32_MAX for none
    uint32_t *stack;
} components;

static void gather_component(const sl_space *space, const sl_see_options *options, uint32_t from,
                             components *c) {
    uint32_t count = 0;
    c->of[from] = c->rows.made;
    c->stack[count++] = from;
    while (count) {
        const uint32_t cell = c->stack[--count];
        const sl_directed_portal *directed = space->directed + space->cells[cell].first_directed;
        sli_word_set_add(&c->rows.row, cell);
        for (uint32_t i = 0; i < space->cells[cell].directed_count; i++) {
            const uint32_t next = directed[i].cell;
            if (c->of[next] != UINT32_MAX || !sli_looks_from(space, options->inside_only, next))
                continue;
            c->of[next] = c->rows.made;
            c->stack[count++] = next;
        }
    }
}

static sl_status find_components(sl_context *context, const sl_space *space,
                                 const sl_see_options *options, components *c) {
    const uint32_t count = space->cell_count;
    SL_TRY(sli_pvs_maker_create(context, count, count, &c->rows));
    c->of = sl_alloc_array(context, count, sizeof *c->of);
    c->stack = sl_alloc_array(context, count, sizeof *c->stack);
    if (!c->of || !c->stack) return SL_NO_MEMORY;
    memset(c->of, 0xff, count * sizeof *c->of);
    for (uint32_t cell = 0; cell < count; cell++) {
        if (c->of[cell] != UINT32_MAX || !sli_looks_from(space, options->inside_only, cell))
            continue;
        gather_component(space, options, cell, c);
        SL_TRY(sli_pvs_maker_end_row(context, &c->rows));
    }
    return SL_OK;
}

/// Each cell's row is its component's.
static sl_status spread_rows(sl_context *context, const components *c, uint32_t count,
                             sl_pvs *out) {
    const uint64_t *offsets = c->rows.offsets;
    out->cell_count = count;
    out->offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *out->offsets);
    if (!out->offsets) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t of = c->of[i];
        out->offsets[i + 1] =
            out->offsets[i] + (of == UINT32_MAX ? 0 : offsets[of + 1] - offsets[of]);
    }
    out->bytes = sl_alloc(context, sli_size(out->offsets[count] + 1));
    if (!out->bytes) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        if (c->of[i] != UINT32_MAX)
            memcpy(out->bytes + out->offsets[i], c->rows.bytes.items + offsets[c->of[i]],
                   sli_size(out->offsets[i + 1] - out->offsets[i]));
    return SL_OK;
}

/// The bound that takes no time: all pairs of cells that portals join.
static sl_status pair_components(sl_context *context, const sl_space *space,
                                 const sl_see_options *options, sl_pvs *out) {
    sl_pvs all = {0};
    components c = {0};
    sl_status status = find_components(context, space, options, &c);
    if (status == SL_OK) status = spread_rows(context, &c, space->cell_count, &all);
    sli_pvs_maker_destroy(context, &c.rows);
    sl_free(context, c.of);
    sl_free(context, c.stack);
    if (status == SL_OK)
        *out = all;
    else
        sl_pvs_destroy(context, &all);
    return status;
}

sl_status sli_flood_bound(sl_context *context, const sl_space *space, const sl_see_options *options,
                          sl_pvs *out, bool *bounded) {
    flood all = {.space = space, .options = options, .hurries = true};
    sl_visibility visibility = {0};
    sl_status status = flood_all(context, &all, &visibility);
    sli_bit_rows_destroy(context, &all.rows);
    *bounded = status == SL_OK;
    if (status == SL_CANCELLED && sli_is_enough(options)) {
        SL_TRY(sl_check_cancelled(context));
        return pair_components(context, space, options, out);
    }
    if (status == SL_OK) *out = visibility.pvs;
    return status;
}

// --- by mirrors

typedef struct mirrored_bound {
    const sl_pvs *direct;
    sl_bits *mirrors; ///< cells with a mirror on a side
    sl_bits *found;   ///< seen by mirror, or directly before the first reflection
    sl_bits *before;  ///< those before the last reflection
} mirrored_bound;

/// Makes `found` the cells that are seen after one more reflection; adds them to the row. False if
/// they are no other ones than before.
static bool reflect(mirrored_bound *b, bool first, sli_word_set *row) {
    const size_t words = sl_bits_words(b->direct->cell_count);
    memcpy(b->before, b->found, words * sizeof *b->found);
    if (first) memset(b->found, 0, words * sizeof *b->found);
    for (size_t i = 0; i < words; i++)
        for (sl_bits open = b->before[i] & b->mirrors[i]; open; open &= open - 1) {
            const uint32_t cell = (uint32_t)(64 * i) + (uint32_t)__builtin_ctzll(open);
            sli_row_add_to(b->direct, cell, b->found);
            sli_word_set_add_row(row, b->direct, cell);
        }
    return memcmp(b->before, b->found, words * sizeof *b->found) != 0;
}

static sl_status make_mirrored_rows(sl_context *context, mirrored_bound *b, uint32_t depth,
                                    sli_pvs_maker *maker, sl_pvs *out) {
    const uint32_t count = b->direct->cell_count;
    SL_TRY(sli_pvs_maker_create(context, count, count, maker));
    for (uint32_t cell = 0; cell < count; cell++) {
        memset(b->found, 0, sl_bits_words(count) * sizeof *b->found);
        sli_row_add_to(b->direct, cell, b->found);
        for (uint32_t i = 0; i < depth && reflect(b, i == 0, &maker->row); i++) {
        }
        SL_TRY(sli_pvs_maker_end_row(context, maker));
        SL_TRY(sl_check_cancelled(context));
    }
    return sli_pvs_maker_finish(context, maker, out);
}

static sl_status bound_mirrored(sl_context *context, const sl_space *space, const sl_plan *plan,
                                mirrored_bound *b, sl_pvs *out) {
    const size_t words = sl_bits_words(space->cell_count);
    sli_mirror_sides sides;
    sli_pvs_maker maker = {0};
    b->mirrors = sl_alloc_array(context, words, sizeof *b->mirrors);
    b->found = sl_alloc_array(context, words, sizeof *b->found);
    b->before = sl_alloc_array(context, words, sizeof *b->before);
    if (!b->mirrors || !b->found || !b->before) return SL_NO_MEMORY;
    SL_TRY(sli_mirror_sides_find(context, space, plan->map, &sides));
    for (uint32_t cell = 0; cell < space->cell_count; cell++)
        if (sides.first[cell] < sides.first[cell + 1]) sl_bits_add(b->mirrors, cell);
    sli_mirror_sides_destroy(context, &sides);
    const sl_status status = make_mirrored_rows(context, b, plan->mirror_depth, &maker, out);
    sli_pvs_maker_destroy(context, &maker);
    return status;
}

sl_status sli_mirrored_bound(sl_context *context, const sl_space *space,
                             const sl_see_options *options, const sl_pvs *direct, sl_pvs *out) {
    mirrored_bound b = {.direct = direct};
    const sl_status status = bound_mirrored(context, space, options->plan, &b, out);
    sl_free(context, b.mirrors);
    sl_free(context, b.found);
    sl_free(context, b.before);
    return status;
}

// --- by the view range

/// The error of rounding, as a share of the size of both cells together. Differences, products and
/// roots are each rounded by 2^-53 of themselves.
#define ERROR 0x1p-45

/// Twice the error of the length of a sightline, as a share of the range.
#define RANGE_ERROR 0x1p-39

typedef struct polygon {
    const sl_point *corners;
    uint32_t count;
    sl_box box;
} polygon;

static polygon polygon_of(const sl_space *space, uint32_t cell) {
    const sl_cell *c = &space->cells[cell];
    polygon p = {.corners = space->vertices + c->first_vertex, .count = c->vertex_count};
    p.box = (sl_box){p.corners[0], p.corners[0]};
    for (uint32_t i = 1; i < p.count; i++) {
        p.box.min.x = fmin(p.box.min.x, p.corners[i].x);
        p.box.min.y = fmin(p.box.min.y, p.corners[i].y);
        p.box.max.x = fmax(p.box.max.x, p.corners[i].x);
        p.box.max.y = fmax(p.box.max.y, p.corners[i].y);
    }
    return p;
}

static double distance_to_side(sl_point p, sl_point a, sl_point b) {
    const double length = sli_length(b.x - a.x, b.y - a.y);
    const double ux = (b.x - a.x) / length, uy = (b.y - a.y) / length;
    const double along = ux * (p.x - a.x) + uy * (p.y - a.y);
    if (along <= 0) return sli_length(p.x - a.x, p.y - a.y);
    if (along >= length) return sli_length(p.x - b.x, p.y - b.y);
    return fabs(ux * (p.y - a.y) - uy * (p.x - a.x));
}

/// From the corners of one to the sides of the other.
static double nearest(const polygon *p, const polygon *q) {
    double least = INFINITY;
    for (uint32_t i = 0; i < p->count; i++)
        for (uint32_t k = 0; k < q->count; k++)
            least = fmin(least, distance_to_side(p->corners[i], q->corners[k],
                                                 q->corners[(k + 1) % q->count]));
    return least;
}

static double farthest(const polygon *p, const polygon *q) {
    double most = 0;
    for (uint32_t i = 0; i < p->count; i++)
        for (uint32_t k = 0; k < q->count; k++)
            most = fmax(most, sli_length(p->corners[i].x - q->corners[k].x,
                                         p->corners[i].y - q->corners[k].y));
    return most;
}

/// Rounded to the safe side: SLI_ALL_WITHIN and SLI_NONE_WITHIN are always right.
static sli_cells_apart cells_apart(const sl_space *space, uint32_t a, uint32_t b, double range) {
    const polygon p = polygon_of(space, a), q = polygon_of(space, b);
    const double width = fmax(p.box.max.x, q.box.max.x) - fmin(p.box.min.x, q.box.min.x);
    const double height = fmax(p.box.max.y, q.box.max.y) - fmin(p.box.min.y, q.box.min.y);
    const double size = sli_length(width, height), error = size * ERROR;
    if (size + error <= range) return SLI_ALL_WITHIN;
    const double neighbour = range * (1 + RANGE_ERROR) + error;
    const double x = fmax(p.box.min.x, q.box.min.x) - fmin(p.box.max.x, q.box.max.x);
    const double y = fmax(p.box.min.y, q.box.min.y) - fmin(p.box.max.y, q.box.max.y);
    if (sli_length(fmax(x, 0), fmax(y, 0)) > neighbour) return SLI_NONE_WITHIN;
    if (farthest(&p, &q) + error <= range) return SLI_ALL_WITHIN;
    return fmin(nearest(&p, &q), nearest(&q, &p)) > neighbour ? SLI_NONE_WITHIN : SLI_SOME_WITHIN;
}

static sl_status make_rows_within(sl_context *context, const sl_space *space, const sl_pvs *pvs,
                                  double range, sli_cells_apart most, sli_pvs_maker *maker,
                                  sl_pvs *out) {
    SL_TRY(sli_pvs_maker_create(context, pvs->cell_count, pvs->cell_count, maker));
    for (uint32_t cell = 0; cell < pvs->cell_count; cell++) {
        for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
            for (uint32_t i = run.first; i < run.end; i++)
                if (i == cell || cells_apart(space, cell, i, range) <= most)
                    sli_word_set_add(&maker->row, i);
        SL_TRY(sli_pvs_maker_end_row(context, maker));
        SL_TRY(sl_check_cancelled(context));
    }
    return sli_pvs_maker_finish(context, maker, out);
}

sl_status sli_pvs_within(sl_context *context, const sl_space *space, const sl_pvs *pvs,
                         double range, sli_cells_apart most, sl_pvs *out) {
    sli_pvs_maker maker = {0};
    const sl_status status = make_rows_within(context, space, pvs, range, most, &maker, out);
    sli_pvs_maker_destroy(context, &maker);
    return status;
}
