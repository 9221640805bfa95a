/// The most area that a number of places sees, with a bound.
///
/// A grid of squares parts the area. How much of each square a place sees is a_cj, of square j by
/// place c, of A_j that counts there: exact areas, as fonts are drawn smoothly. No set of n places
/// sees more of a square than A_j, nor than what each sees of it, added up. So for any prices p_j
/// from 0 to 1, no set sees more than
///
///     sum over squares of A_j (1 - p_j) + the n largest sums over squares of p_j a_cj
///
/// Prices move to the least bound by subgradients, as in cover_most.c. The set comes from
/// sl_cover_most, for squares of which a place sees at least half. What it sees is then found
/// exactly. Where zones have weights, a_cj and A_j are what they are worth.
///
/// Of walls to scan and lines there are rows already (area_walls.c, area_lines.c): their lengths
/// are the weights.
#include "analysis/placement/place_area.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SQUARES = 4000, ITERATIONS = 400 };
/// More than all rounding of sums.
#define MARGIN 1e-9

typedef struct share {
    uint32_t square;
    double area;
} share;

typedef struct ranked {
    double worth;
    uint32_t place;
} ranked;

typedef struct counter {
    sli_area *a;
    sl_point origin;
    double step;
    int columns, rows;
    double *cover, *part; ///< by square, scratch: of what is to the right of it, and of itself
    double *areas;        ///< A_j
    sl_shape *zones;      ///< of sl_place_area, as far as they are to be seen; or all of that
    double *density;      ///< by square: what area in it is worth at most
    SL_ARRAY(share) shares;
    size_t *ends; ///< by place
    double *prices, *slopes;
    ranked *order;
    double bound;
} counter;

// --- how much of each square

/// A piece of an edge within one row of squares and one column; column -1: to the left of all.
static void add_piece(counter *k, int row, int column, double x0, double x1, double dy) {
    double *const cover = k->cover + (size_t)row * (size_t)(k->columns + 1);
    double *const part = k->part + (size_t)row * (size_t)(k->columns + 1);
    if (column >= k->columns) return;
    if (column < 0) {
        cover[0] -= dy * k->step;
        return;
    }
    const double right = (column + 1) * k->step;
    part[column] -= dy * (right - (x0 + x1) / 2);
    cover[column + 1] -= dy * k->step;
}

static int floor_to(double value, double step, int most) {
    const double at = floor(value / step);
    return at < -1 ? -1 : at > most ? most : (int)at;
}

/// An edge within one row of squares, cut at the sides of columns.
static void add_in_row(counter *k, int row, sl_point p, sl_point q) {
    const double sign = p.x <= q.x ? 1 : -1;
    const sl_point l = sign > 0 ? p : q, r = sign > 0 ? q : p;
    const int from = floor_to(l.x, k->step, k->columns), to = floor_to(r.x, k->step, k->columns);
    sl_point at = l;
    for (int c = from; c <= to; c++) {
        sl_point next = r;
        if (c < to) {
            const double x = (c + 1) * k->step;
            next = (sl_point){x, l.y + (r.y - l.y) * ((x - l.x) / (r.x - l.x))};
        }
        add_piece(k, row, c, at.x, next.x, sign * (next.y - at.y));
        at = next;
    }
}

static void add_edge(counter *k, sl_point p, sl_point q) {
    const double sign = p.y <= q.y ? 1 : -1;
    const sl_point low = sign > 0 ? p : q, high = sign > 0 ? q : p;
    if (low.y == high.y || high.y <= 0 || low.y >= k->rows * k->step) return;
    const int from = floor_to(low.y, k->step, k->rows), to = floor_to(high.y, k->step, k->rows);
    for (int r = from < 0 ? 0 : from; r <= to && r < k->rows; r++) {
        const double y0 = fmax(low.y, r * k->step), y1 = fmin(high.y, (r + 1) * k->step);
        const double s0 = (y0 - low.y) / (high.y - low.y), s1 = (y1 - low.y) / (high.y - low.y);
        const sl_point a = {low.x + s0 * (high.x - low.x), y0};
        const sl_point b = {low.x + s1 * (high.x - low.x), y1};
        if (sign > 0)
            add_in_row(k, r, a, b);
        else
            add_in_row(k, r, b, a);
    }
}

/// The rows and columns of squares that a box meets.
static void squares_of(const counter *k, const sl_box *box, int *columns, int *rows) {
    columns[0] = floor_to(box->min.x - k->origin.x, k->step, k->columns);
    columns[1] = floor_to(box->max.x - k->origin.x, k->step, k->columns - 1);
    rows[0] = floor_to(box->min.y - k->origin.y, k->step, k->rows);
    rows[1] = floor_to(box->max.y - k->origin.y, k->step, k->rows - 1);
    if (columns[0] < 0) columns[0] = 0;
    if (rows[0] < 0) rows[0] = 0;
}

/// Adds the squares that a shape has a part of, and clears the scratch.
static sl_status measure(counter *k, const sl_shape *shape, const sl_box *box) {
    size_t first = 0;
    for (size_t l = 0; l < shape->count; first = shape->ends[l++])
        for (size_t i = first; i < shape->ends[l]; i++) {
            const sl_point p = shape->points[i];
            const sl_point q = shape->points[i + 1 < shape->ends[l] ? i + 1 : first];
            add_edge(k, (sl_point){p.x - k->origin.x, p.y - k->origin.y},
                     (sl_point){q.x - k->origin.x, q.y - k->origin.y});
        }
    int columns[2], rows[2];
    squares_of(k, box, columns, rows);
    for (int r = rows[0]; r <= rows[1]; r++) {
        double *const cover = k->cover + (size_t)r * (size_t)(k->columns + 1);
        double *const part = k->part + (size_t)r * (size_t)(k->columns + 1);
        double sum = 0;
        for (int c = columns[0]; c <= columns[1]; c++) {
            sum += cover[c];
            const double area = sum + part[c];
            if (area > MARGIN * k->step * k->step) {
                SL_TRY(SL_ARRAY_ROOM(k->a->context, &k->shares, 1));
                k->shares.items[k->shares.count++] =
                    (share){(uint32_t)r * (uint32_t)k->columns + (uint32_t)c, area};
            }
        }
        memset(cover, 0, (size_t)(k->columns + 1) * sizeof *cover);
        memset(part, 0, (size_t)(k->columns + 1) * sizeof *part);
    }
    return SL_OK;
}

static sl_box box_of(const sl_shape *shape) {
    sl_box box = {shape->points[0], shape->points[0]};
    for (size_t i = 1; i < shape->ends[shape->count - 1]; i++) {
        const sl_point p = shape->points[i];
        box.min = (sl_point){fmin(box.min.x, p.x), fmin(box.min.y, p.y)};
        box.max = (sl_point){fmax(box.max.x, p.x), fmax(box.max.y, p.y)};
    }
    return box;
}

static sl_status make_grid(counter *k, const sl_box *box) {
    const sli_area *a = k->a;
    const double width = box->max.x - box->min.x, height = box->max.y - box->min.y;
    k->step = fmax(sqrt(a->out->area / SQUARES), sqrt(width * height / (16.0 * SQUARES)));
    k->step = fmax(k->step, fmax(width, height) / SQUARES);
    k->origin = box->min;
    k->columns = (int)(width / k->step) + 1;
    k->rows = (int)(height / k->step) + 1;
    const size_t squares = (size_t)(k->columns + 1) * (size_t)k->rows;
    const uint32_t places = a->task->place_count;
    k->cover = sl_alloc_array(a->context, squares, sizeof *k->cover);
    k->part = sl_alloc_array(a->context, squares, sizeof *k->part);
    k->areas = sl_alloc_array(a->context, squares, sizeof *k->areas);
    k->density = sl_alloc_array(a->context, squares, sizeof *k->density);
    k->prices = sl_alloc_array(a->context, squares, sizeof *k->prices);
    k->slopes = sl_alloc_array(a->context, squares, sizeof *k->slopes);
    k->ends = sl_alloc_array(a->context, places, sizeof *k->ends);
    k->order = sl_alloc_array(a->context, places, sizeof *k->order);
    return k->cover && k->part && k->areas && k->density && k->prices && k->slopes && k->ends &&
                   k->order
               ? SL_OK
               : SL_NO_MEMORY;
}

static uint32_t zones_of(const sli_area *a) {
    return a->task->zone_count ? a->task->zone_count : 1;
}

/// What an area that is seen is worth: in all zones, by `shapes`; or without them, all of it.
/// *whole: nothing of it is unseen.
static sl_status add_up(const counter *k, const sl_shape *shapes, uint32_t count, double *worth,
                        bool *whole) {
    const sli_area *a = k->a;
    *worth = 0;
    *whole = true;
    for (uint32_t z = 0; z < zones_of(a); z++) {
        sl_overlay overlay;
        if (!k->zones[z].count) continue;
        SL_TRY(sl_overlay_make(a->context, &k->zones[z], shapes, count, &overlay));
        *worth += (a->task->zone_count ? a->task->weights[z] : 1) * overlay.areas[count ? 1 : 0];
        *whole &= sli_area_is_covered(&overlay);
        sl_overlay_destroy(a->context, &overlay);
    }
    return SL_OK;
}

/// How much of each square counts, and for how much.
static sl_status measure_zones(counter *k) {
    sli_area *a = k->a;
    for (uint32_t z = 0; z < zones_of(a); z++) {
        const double weight = a->task->zone_count ? a->task->weights[z] : 1;
        if (!k->zones[z].count) continue;
        const sl_box box = box_of(&k->zones[z]);
        SL_TRY(measure(k, &k->zones[z], &box));
        for (size_t i = 0; i < k->shares.count; i++) {
            k->areas[k->shares.items[i].square] += weight * k->shares.items[i].area;
            k->density[k->shares.items[i].square] += weight;
        }
        k->shares.count = 0;
    }
    bool whole;
    SL_TRY(add_up(k, NULL, 0, &a->out->area, &whole));
    k->bound = a->out->area;
    return a->out->area > 0 ? SL_OK
                            : sl_fail(a->context, SL_BAD_ARGUMENT, "no zone is to be seen inside");
}

static sl_status make_zones(counter *k) {
    sli_area *a = k->a;
    k->zones = sl_alloc_array(a->context, zones_of(a), sizeof *k->zones);
    if (!k->zones) return SL_NO_MEMORY;
    if (!a->task->zone_count) {
        k->zones[0] = a->target;
        a->target = (sl_shape){0};
    }
    for (uint32_t z = 0; z < a->task->zone_count; z++)
        SL_TRY(sli_shape_common(a->context, &a->target, &a->task->zones[z], &k->zones[z]));
    return SL_OK;
}

static sl_status measure_all(counter *k) {
    sli_area *a = k->a;
    const sl_box box = box_of(&a->target);
    SL_TRY(make_grid(k, &box));
    SL_TRY(make_zones(k));
    SL_TRY(measure_zones(k));
    for (uint32_t i = 0; i < a->task->place_count; i++) {
        if (i % 64 == 0) SL_TRY(sl_check_cancelled(a->context));
        const sl_shape shape = sli_view_shape(&a->shapes, i + 1);
        const size_t from = k->shares.count;
        size_t to = from;
        SL_TRY(measure(k, &shape, &a->boxes[i]));
        for (size_t j = from; j < k->shares.count; j++) {
            share s = k->shares.items[j];
            if (!(k->areas[s.square] > 0)) continue;
            s.area *= k->density[s.square];
            k->shares.items[to++] = s;
        }
        k->shares.count = to;
        k->ends[i] = to;
    }
    return SL_OK;
}

// --- the set

/// The set that sees at least half of the squares that are worth most, into `now`.
static sl_status choose(counter *k, uint8_t *now) {
    sli_area *a = k->a;
    const uint32_t squares = (uint32_t)(k->columns * k->rows), places = a->task->place_count;
    size_t *ends = sl_alloc_array(a->context, places, sizeof *ends);
    uint32_t *entries = sl_alloc_array(a->context, k->shares.count, sizeof *entries);
    double *weights = sl_alloc_array(a->context, squares, sizeof *weights);
    sl_cover_result result = {0};
    double covered, bound;
    sl_status status = ends && entries && weights ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        memcpy(weights, k->areas, squares * sizeof *weights);
        size_t count = 0;
        for (uint32_t i = 0; i < places; i++) {
            for (size_t j = i ? k->ends[i - 1] : 0; j < k->ends[i]; j++) {
                const share s = k->shares.items[j];
                if (s.area < k->areas[s.square] / 2) continue;
                if (a->fixed[i])
                    weights[s.square] = 0;
                else
                    entries[count++] = s.square;
            }
            ends[i] = count;
            now[i] = a->fixed[i];
        }
        const sl_cover_problem problem = {
            .row_count = squares, .column_count = places, .ends = ends, .entries = entries};
        status = sl_cover_most(a->context, &problem, weights, a->task->count, NULL, &result,
                               &covered, &bound);
        for (uint32_t i = 0; i < result.count; i++) now[result.columns[i]] = 1;
    }
    sl_free(a->context, ends);
    sl_free(a->context, entries);
    sl_free(a->context, weights);
    sl_cover_result_destroy(a->context, &result);
    return status;
}

/// Keeps the chosen places, and finds what they see.
static sl_status keep(counter *k, const uint8_t *now) {
    sli_area *a = k->a;
    sl_area_placement *out = a->out;
    const uint32_t places = a->task->place_count;
    uint32_t *chosen = sl_alloc_array(a->context, places, sizeof *chosen);
    sl_shape *shapes = sl_alloc_array(a->context, (size_t)places + 1, sizeof *shapes);
    out->chosen = chosen;
    if (!chosen || !shapes) {
        sl_free(a->context, shapes);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < places; i++) {
        if (!now[i]) continue;
        shapes[out->count] = sli_view_shape(&a->shapes, i + 1);
        chosen[out->count++] = i;
    }
    bool whole = false;
    const sl_status status = out->count ? add_up(k, shapes, out->count, &out->seen, &whole) : SL_OK;
    if (whole) out->seen = out->area;
    sl_free(a->context, shapes);
    out->lower = out->upper = out->count;
    return status;
}

// --- the bound

static int compare_ranks(const void *left, const void *right) {
    const ranked *a = left, *b = right;
    if (a->worth != b->worth) return a->worth > b->worth ? -1 : 1;
    return (a->place > b->place) - (a->place < b->place);
}

static void take(counter *k, uint32_t place) {
    for (size_t j = place ? k->ends[place - 1] : 0; j < k->ends[place]; j++)
        k->slopes[k->shares.items[j].square] += k->shares.items[j].area;
}

/// The bound of the prices, and its slopes.
static double bound_of(counter *k) {
    const uint32_t squares = (uint32_t)(k->columns * k->rows);
    double bound = 0;
    uint32_t count = 0;
    for (uint32_t s = 0; s < squares; s++) {
        bound += k->areas[s] * (1 - k->prices[s]);
        k->slopes[s] = -k->areas[s];
    }
    for (uint32_t i = 0; i < k->a->task->place_count; i++) {
        double worth = 0;
        for (size_t j = i ? k->ends[i - 1] : 0; j < k->ends[i]; j++)
            worth += k->prices[k->shares.items[j].square] * k->shares.items[j].area;
        if (k->a->fixed[i]) {
            bound += worth;
            take(k, i);
        } else {
            k->order[count++] = (ranked){worth, i};
        }
    }
    qsort(k->order, count, sizeof *k->order, compare_ranks);
    for (uint32_t i = 0; i < k->a->task->count && i < count; i++) {
        bound += k->order[i].worth;
        take(k, k->order[i].place);
    }
    return bound;
}

static sl_status descend(counter *k) {
    const uint32_t squares = (uint32_t)(k->columns * k->rows);
    const double seen = k->a->out->seen;
    double step = 1;
    int since = 0;
    for (uint32_t s = 0; s < squares; s++) k->prices[s] = 0.5;
    for (int i = 0; i < ITERATIONS && step > 1e-4; i++) {
        SL_TRY(sl_check_cancelled(k->a->context));
        const double bound = bound_of(k);
        const double margin = bound * (1 + MARGIN);
        if (margin < k->bound) {
            if (margin < k->bound * (1 - 1e-5)) since = i;
            k->bound = margin;
        }
        if (i - since >= 12) {
            step *= 0.6;
            since = i;
        }
        double square = 0;
        for (uint32_t s = 0; s < squares; s++) square += k->slopes[s] * k->slopes[s];
        if (!(square > 0) || bound <= seen) break;
        const double length = step * (bound - 0.99 * seen) / square;
        for (uint32_t s = 0; s < squares; s++)
            k->prices[s] = fmin(1, fmax(0, k->prices[s] - length * k->slopes[s]));
    }
    return SL_OK;
}

// --- walls to scan, and lines

/// The most length that so many places see: their bytes into `now` unless it is NULL.
static sl_status choose_most(sli_area *a, bool wide, uint8_t *now, double *seen, double *bound) {
    const sl_place_area *task = a->task;
    sl_cover_problem problem = {0};
    sl_cover_result result = {0};
    double covered = 0, most = 0;
    double *weights = sl_alloc_array(a->context, a->lengths.count, sizeof *weights);
    sl_status status = weights ? sli_area_problem(a, wide, &problem) : SL_NO_MEMORY;
    *seen = 0;
    for (size_t r = 0, i = 0; status == SL_OK && r < a->lengths.count; r++) {
        bool fixed = false;
        for (; i < a->row_ends.items[r]; i++)
            fixed |= (wide || !(a->entries.items[i] & SLI_WIDE)) &&
                     a->fixed[a->entries.items[i] & ~SLI_WIDE];
        *seen += fixed ? a->lengths.items[r] : 0;
        weights[r] = fixed ? 0 : a->lengths.items[r];
    }
    sl_cover_problem free = problem;
    free.demands = free.costs = NULL;
    if (status == SL_OK)
        status =
            sl_cover_most(a->context, &free, weights, task->count, NULL, &result, &covered, &most);
    for (uint32_t i = 0; now && i < task->place_count; i++) now[i] = a->fixed[i];
    for (uint32_t i = 0; now && i < result.count; i++) now[result.columns[i]] = 1;
    *bound = *seen + most;
    *seen += covered;
    sl_free(a->context, weights);
    sl_cover_result_destroy(a->context, &result);
    sli_area_problem_destroy(a->context, &problem);
    return status;
}

static sl_status find_most_of_rows(sli_area *a) {
    sl_area_placement *out = a->out;
    double seen, bound;
    SL_TRY(sli_area_scans(a) ? sli_area_walls(a) : sli_area_lines(a));
    uint8_t *now = sl_alloc_array(a->context, a->task->place_count, 1);
    uint32_t *chosen = sl_alloc_array(a->context, a->task->place_count, sizeof *chosen);
    sl_status status =
        now && chosen ? choose_most(a, false, now, &out->seen, &bound) : SL_NO_MEMORY;
    for (uint32_t i = 0; status == SL_OK && i < a->task->place_count; i++)
        if (now[i]) chosen[out->count++] = i;
    if (status == SL_OK && a->wide_count) status = choose_most(a, true, NULL, &seen, &bound);
    if (status == SL_OK) out->seen_most = fmax(fmin(bound, out->area), out->seen);
    out->lower = out->upper = out->count;
    if (status == SL_OK)
        out->chosen = chosen;
    else
        sl_free(a->context, chosen);
    sl_free(a->context, now);
    return status;
}

sl_status sli_area_most(sli_area *a) {
    const sl_place_area *task = a->task;
    if (sli_area_scans(a) || task->line_count) return find_most_of_rows(a);
    counter k = {.a = a};
    uint8_t *now = sl_alloc_array(a->context, task->place_count, 1);
    sl_status status = now ? measure_all(&k) : SL_NO_MEMORY;
    if (status == SL_OK) status = choose(&k, now);
    if (status == SL_OK) status = keep(&k, now);
    if (status == SL_OK) status = descend(&k);
    a->out->seen_most = fmax(fmin(k.bound, a->out->area), a->out->seen);
    sl_free(a->context, now);
    sl_free(a->context, k.cover);
    sl_free(a->context, k.part);
    sl_free(a->context, k.areas);
    sl_free(a->context, k.density);
    for (uint32_t z = 0; k.zones && z < zones_of(a); z++) sl_shape_destroy(a->context, &k.zones[z]);
    sl_free(a->context, k.zones);
    sl_free(a->context, k.shares.items);
    sl_free(a->context, k.ends);
    sl_free(a->context, k.prices);
    sl_free(a->context, k.slopes);
    sl_free(a->context, k.order);
    return status;
}
