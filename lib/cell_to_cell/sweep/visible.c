/// What a point sees: cells, each over one or more intervals of angle.
///
/// A cell is seen over an interval. The interval is cut by the ends of each portal of the cell, and
/// what is left of it enters the cell behind:
///
///         l ____ r      from the point p the cell behind the portal l-r is seen from the right
///          \    /       end (start event) counter-clockwise to the left end (end event), as far as
///           \  /        the interval of the cell before it reaches
///            p
///
/// A portal's end that is no corner of walls splits an interval in two. The two meet again in a
/// cell behind, and are joined there. So a cell should be looked through after everything has come
/// to it. Cells wait in a queue, the nearest first, by rings of distance. No order by distance
/// alone is the order in which rays cross cells. A piece that comes too late waits again, the new
/// part alone. What is found does not depend on the order.
///
/// Invariant: intervals of one cell that touch are joined at the end (visible_events.c). Cost: one
/// cut for each portal of each piece, mostly by two cross products in doubles.
#include "cell_to_cell/sweep/visible.h"

#include <assert.h>
#include <math.h>
#include <string.h>

sl_status sli_visible_finder_create(sl_context *context, const sli_fans *fans, bool closed,
                                    sli_visible_finder *finder) {
    *finder = (sli_visible_finder){.fans = fans, .closed = closed};
    finder->last = sl_alloc_array(context, fans->cell_count, sizeof *finder->last);
    finder->on_rays = sl_alloc_array(context, fans->cell_count, sizeof *finder->on_rays);
    return finder->last && finder->on_rays ? SL_OK : SL_NO_MEMORY;
}

void sli_visible_finder_destroy(sl_context *context, sli_visible_finder *finder) {
    sl_free(context, finder->last);
    sl_free(context, finder->on_rays);
    sl_free(context, finder->slot_of.items);
    sl_free(context, finder->split.items);
    sl_free(context, finder->keys.items);
    sl_free(context, finder->same.items);
    sl_free(context, finder->slots.items);
    *finder = (sli_visible_finder){0};
}

static double farther(double a, double b, double from) {
    return from - a > b - from ? from - a : b - from;
}

sl_status sli_visible_finder_stand(sl_context *context, sli_visible_finder *r, const sli_fans *ends,
                                   sl_point from) {
    const size_t slots = 2 * ends->ends.count, had = r->slot_of.count;
    const sl_box box = ends->bounds;
    const sl_point visible = {farther(box.min.x, box.max.x, from.x),
                              farther(box.min.y, box.max.y, from.y)};
    r->from = from;
    r->limit = sli_turn_limit(visible, visible);
    r->ring_scale = 1 / (visible.x * visible.x + visible.y * visible.y);
    r->ends = ends;
    if (slots <= had) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &r->slot_of, slots - had));
    memset(r->slot_of.items + had, 0, (slots - had) * sizeof *r->slot_of.items);
    r->slot_of.count = slots;
    return SL_OK;
}

void sli_visible_clear(sli_visible *visible) {
    visible->events.count = visible->cells.count = 0;
}

void sli_visible_destroy(sl_context *context, sli_visible *visible) {
    sl_free(context, visible->events.items);
    sl_free(context, visible->cells.items);
    *visible = (sli_visible){0};
}

int sli_ends_turn_exact(const sli_visible_finder *r, uint32_t a, uint32_t b) {
    const sl_point p = sli_end_of(r, a), q = sli_end_of(r, b), from = r->from;
    if ((p.x == from.x && q.x == from.x) || (p.y == from.y && q.y == from.y)) return 0;
    const double scale = r->ends->grid;
    if (scale > 0) return sli_turn_grid(sli_towards(r, a), sli_towards(r, b), scale);
    return sli_orient(p, q, from);
}

// --- what waits

/// The ring of a cell by its distance. The upper bits of a float grow with its logarithm.
static uint32_t ring_of(const sli_visible_finder *r, uint32_t cell) {
    enum { FINE = 18, OCTAVES = SLI_NEAR_RINGS >> (23 - FINE), ONE = 127 };
    const sl_point at = r->fans->middles[cell];
    const double x = at.x - r->from.x, y = at.y - r->from.y;
    const float share = (float)((x * x + y * y) * r->ring_scale);
    uint32_t bits;
    memcpy(&bits, &share, sizeof bits);
    const uint32_t first = (uint32_t)(ONE - OCTAVES) << (23 - FINE);
    const uint32_t ring = bits >> FINE;
    return ring < first ? 0 : ring - first < SLI_NEAR_RINGS ? ring - first : SLI_NEAR_RINGS - 1;
}

static void wait(sli_visible_finder *r, sli_visible_interval *c, uint32_t found) {
    const uint32_t ring = ring_of(r, c->cell);
    uint64_t *word = &r->ringed[ring / 64];
    const uint64_t bit = (uint64_t)1 << (ring % 64);
    c->waiting = true;
    c->next_waiting = *word & bit ? r->rings[ring] : UINT32_MAX;
    *word |= bit;
    r->some_ringed |= (uint64_t)1 << (ring / 64);
    r->rings[ring] = found;
}

/// Takes the nearest interval off the queue; UINT32_MAX for none.
static uint32_t take_nearest(sli_visible_finder *r, sli_visible *visible) {
    if (!r->some_ringed) return UINT32_MAX;
    const uint32_t i = (uint32_t)__builtin_ctzll(r->some_ringed);
    const uint32_t ring = 64 * i + (uint32_t)__builtin_ctzll(r->ringed[i]);
    const uint32_t found = r->rings[ring];
    sli_visible_interval *c = &visible->cells.items[found];
    c->waiting = false;
    r->rings[ring] = c->next_waiting;
    if (c->next_waiting == UINT32_MAX) r->ringed[i] &= r->ringed[i] - 1;
    if (!r->ringed[i]) r->some_ringed &= r->some_ringed - 1;
    return found;
}

// --- coming to a cell

static sl_status add_interval(sl_context *context, sli_visible_finder *r, sli_visible *visible,
                              const sli_visible_interval *interval) {
    SL_TRY(SL_ARRAY_ROOM(context, &visible->cells, 1));
    r->last[interval->cell] = (uint32_t)visible->cells.count;
    if (interval->depth > r->deepest) r->deepest = interval->depth;
    visible->cells.items[visible->cells.count++] = *interval;
    return SL_OK;
}

/// Joins a piece to an interval of the same cell. False if they do not touch. `more`: the interval
/// has grown and does not wait yet.
static bool join(const sli_visible_finder *r, sli_visible_interval *c, sli_bound low,
                 sli_bound high, bool *more) {
    if (sli_is_gap(r, c->high, low) || sli_is_gap(r, high, c->low)) return false;
    const bool lower = sli_is_before(r, low, c->low), upper = sli_is_before(r, c->high, high);
    *more = (lower || upper) && !c->waiting;
    if (*more) {
        c->from = (sli_bound){c->high.end, r->closed ? c->high.rank : SLI_AFTER, c->high.away};
        c->to = (sli_bound){c->low.end, r->closed ? c->low.rank : SLI_BEFORE, c->low.away};
    }
    if (lower) c->low = c->from = low;
    if (upper) c->high = c->to = high;
    return true;
}

/// What is seen of the cell behind a directed portal.
typedef struct piece {
    sli_bound low, high;
} piece;

static sl_status arrive(sl_context *context, sli_visible_finder *r, sli_visible *visible,
                        uint32_t cell, const piece *p, uint32_t depth) {
    if (cell == SL_NO_CELL) return SL_OK;
    const uint32_t last = r->last[cell], count = (uint32_t)visible->cells.count;
    const bool known = last < count && visible->cells.items[last].cell == cell;
    for (uint32_t i = known ? last : UINT32_MAX; i != UINT32_MAX;
         i = visible->cells.items[i].other) {
        bool more;
        if (!join(r, &visible->cells.items[i], p->low, p->high, &more)) continue;
        if (more) wait(r, &visible->cells.items[i], i);
        return SL_OK;
    }
    if (known && visible->cells.items[last].other == UINT32_MAX) {
        SL_TRY(SL_ARRAY_ROOM(context, &r->split, 1));
        r->split.items[r->split.count++] = cell;
    }
    const sli_visible_interval interval = {.cell = cell,
                                           .other = known ? last : UINT32_MAX,
                                           .low = p->low,
                                           .high = p->high,
                                           .from = p->low,
                                           .to = p->high,
                                           .depth = depth};
    SL_TRY(add_interval(context, r, visible, &interval));
    wait(r, &visible->cells.items[count], count);
    return SL_OK;
}

// --- one directed portal

static inline int8_t larger(int8_t a, int8_t b) {
    return a > b ? a : b;
}

static inline int8_t smaller(int8_t a, int8_t b) {
    return a < b ? a : b;
}

/// The start event and the end event that a portal's ends make.
static inline sli_bound from_right(const sli_visible_finder *r, const sli_walk_portal *e) {
    return (sli_bound){.end = e->right, .rank = r->closed ? SLI_CLOCKWISE : SLI_AFTER};
}

static inline sli_bound to_left(const sli_visible_finder *r, const sli_walk_portal *e) {
    return (sli_bound){.end = e->left, .rank = r->closed ? SLI_COUNTER : SLI_BEFORE};
}

// A line that turns counter-clockwise about the point crosses from the right to the left of it.
/// At which rank of its angle a portal on a ray from the point is crossed.
static int8_t rank_along(const sli_visible_finder *r, const sli_walk_portal *e) {
    const sl_point v = r->from, left = sli_end_of(r, e->left), right = sli_end_of(r, e->right);
    bool right_first;
    if (left.x != right.x) {
        const bool rightwards = left.x > v.x || right.x > v.x;
        right_first = rightwards ? right.x < left.x : right.x > left.x;
    } else {
        const bool upwards = left.y > v.y || right.y > v.y;
        right_first = upwards ? right.y < left.y : right.y > left.y;
    }
    return right_first ? SLI_CLOCKWISE : SLI_COUNTER;
}

static bool is_direction(const sli_visible_finder *r, sli_bound bound, uint32_t end) {
    return sli_ends_turn(r, bound.end, end) == 0 && sli_bound_has(r, bound, end);
}

/// Cuts an interval by a directed portal on a line with the point. The portal is at one of the
/// bounds, since it is an edge of a convex cell.
static bool clip_along(const sli_visible_finder *r, const sli_walk_portal *e, sli_bound low,
                       sli_bound high, piece *out) {
    const uint32_t far = sli_same_point(sli_end_of(r, e->left), r->from) ? e->right : e->left;
    const bool is_low = is_direction(r, low, far), is_high = is_direction(r, high, far);
    if (!is_low && !is_high) return false;
    const int8_t rank = rank_along(r, e);
    out->low = out->high = is_low ? low : high;
    out->low.rank = is_low ? larger(rank, low.rank) : rank;
    out->high.rank = is_high ? smaller(rank, high.rank) : rank;
    return out->low.rank <= out->high.rank;
}

/// Cuts an interval by the ends of a directed portal, exactly: also where a bound leads to an end.
static bool clip(const sli_visible_finder *r, const sli_walk_portal *e, sli_bound low,
                 sli_bound high, piece *out) {
    const int facing = sli_ends_turn(r, e->right, e->left);
    if (facing <= 0) return facing == 0 && r->closed && clip_along(r, e, low, high, out);
    const int past_low = sli_bound_side(r, low, e->left);
    const int past_high = sli_bound_side(r, high, e->right);
    if (past_low < 0 || past_high > 0) return false;
    if ((past_low == 0 || past_high == 0) && !r->closed) return false;
    if (past_low == 0 && !sli_bound_has(r, low, e->left)) return false;
    if (past_high == 0 && !sli_bound_has(r, high, e->right)) return false;
    out->low = sli_bound_side(r, low, e->right) > 0 ? from_right(r, e) : low;
    out->high = sli_bound_side(r, high, e->left) < 0 ? to_left(r, e) : high;
    if (past_low != 0 && past_high != 0) return true;
    const bool thin = sli_bounds_turn(r, low, high) == 0;
    out->low = out->high = past_low == 0 ? low : high;
    out->low.rank = past_low == 0 || thin ? larger(low.rank, SLI_CLOCKWISE) : SLI_CLOCKWISE;
    out->high.rank = past_high == 0 || thin ? smaller(high.rank, SLI_COUNTER) : SLI_COUNTER;
    return out->low.rank <= out->high.rank;
}

/// The interval over which a cell is looked through, with its bounds as vectors.
typedef struct view {
    sli_bound low, high;
    sl_point of_low, of_high;
} view;

/// A directed portal that may be crossed, and its ends from the point.
typedef struct sight {
    uint32_t directed;
    bool
        sure; ///< it faces the point, and its left end lies past `low`, its right one before `high`
    sl_point right, left;
} sight;

/// Picks one of two bounds without a branch, since the choice is hard to predict.
static inline sli_bound pick(bool first, sli_bound a, sli_bound b) {
    uint64_t of_a, of_b;
    static_assert(sizeof a == sizeof of_a, "a bound is to be picked as a whole");
    memcpy(&of_a, &a, sizeof of_a);
    memcpy(&of_b, &b, sizeof of_b);
    of_b ^= (of_a ^ of_b) & -(uint64_t)first;
    memcpy(&b, &of_b, sizeof b);
    return b;
}

/// As clip, but by products in doubles where their signs are certain. That is nearly always.
static inline bool clip_fast(const sli_visible_finder *r, const view *v, const sight *s,
                             piece *out) {
    const sli_walk_portal *e = &r->fans->directed[s->directed];
    const double past_right = sli_cross(v->of_low, s->right);
    const double before_left = sli_cross(s->left, v->of_high);
    const bool sure_right = (fabs(past_right) > r->limit) | (v->low.end == e->right);
    const bool sure_left = (fabs(before_left) > r->limit) | (v->high.end == e->left);
    if (!(s->sure & sure_right & sure_left)) return clip(r, e, v->low, v->high, out);
    out->low = pick(past_right > r->limit, from_right(r, e), v->low);
    out->high = pick(before_left > r->limit, to_left(r, e), v->high);
    return true;
}

/// Lists which of a cell's directed portals may be crossed. There is no branch for each, since the
/// choice is hard to predict.
static inline uint32_t see_directed(const sli_visible_finder *r, const view *v, uint32_t first,
                                    uint32_t end, sight *out) {
    uint32_t count = 0;
    for (uint32_t i = first; i < end; i++) {
        const sli_walk_portal *e = &r->fans->directed[i];
        const sl_point right = sli_towards(r, e->right), left = sli_towards(r, e->left);
        const double facing = sli_cross(right, left);
        const double past_low = sli_cross(v->of_low, left),
                     before_high = sli_cross(right, v->of_high);
        const double of_both = past_low < before_high ? past_low : before_high;
        const double least = facing < of_both ? facing : of_both;
        out[count] = (sight){.directed = i, .sure = least > r->limit, .right = right, .left = left};
        count += !(least < -r->limit); // also where it is no number
    }
    return count;
}

static inline sl_point direction(const sli_visible_finder *r, sli_bound bound) {
    const sl_point to = sli_towards(r, bound.end);
    return bound.away ? (sl_point){-to.x, -to.y} : to;
}

static sl_status look_through(sl_context *context, sli_visible_finder *r, sli_visible *visible,
                              uint32_t found) {
    enum { AT_ONCE = 16 };
    sight seen[AT_ONCE];
    const sli_visible_interval *c = &visible->cells.items[found];
    const uint32_t depth = c->depth + 1;
    const view v = {.low = c->from,
                    .high = c->to,
                    .of_low = direction(r, c->from),
                    .of_high = direction(r, c->to)};
    const uint32_t end = r->fans->first_directed[c->cell + 1];
    for (uint32_t i = r->fans->first_directed[c->cell]; i < end; i += AT_ONCE) {
        const uint32_t count = see_directed(r, &v, i, end - i < AT_ONCE ? end : i + AT_ONCE, seen);
        for (uint32_t k = 0; k < count; k++) {
            piece p;
            if (clip_fast(r, &v, &seen[k], &p))
                SL_TRY(arrive(context, r, visible, r->fans->directed[seen[k].directed].cell, &p,
                              depth));
        }
    }
    return ++r->pieces % 4096 ? SL_OK : sl_check_cancelled(context);
}

sl_status sli_visible_run(sl_context *context, sli_visible_finder *r, sli_visible *visible) {
    for (uint32_t found; (found = take_nearest(r, visible)) != UINT32_MAX;)
        SL_TRY(look_through(context, r, visible, found));
    return SL_OK;
}

// --- from the cells of a fan

/// As sli_bound_side, for an end half a turn away at most; where it is half a turn away, `answer`.
static int side_in_sector(const sli_visible_finder *r, sli_bound bound, uint32_t end, int answer) {
    const int sign = sli_bound_side(r, bound, end);
    return sign == 0 && !sli_bound_has(r, bound, end) ? answer : sign;
}

/// Cuts a sector of the fan by a directed portal on the far side of the fan's cell.
static bool first_piece(const sli_visible_finder *r, const sli_walk_portal *e, sli_bound low,
                        sli_bound high, bool thin, piece *out) {
    const sl_point left = sli_end_of(r, e->left), right = sli_end_of(r, e->right);
    if (sli_same_point(left, r->from) || sli_same_point(right, r->from)) return false;
    if (sli_ends_turn(r, e->right, e->left) <= 0) return false;
    // What faces the point lies past the sector's first edge, and not past its last.
    const int low_to_left = side_in_sector(r, low, e->left, 1);
    const int high_to_right = side_in_sector(r, high, e->right, -1);
    if (low_to_left < 0 || high_to_right > 0) return false;
    const int low_to_right = side_in_sector(r, low, e->right, -1);
    const int high_to_left = side_in_sector(r, high, e->left, 1);
    out->low = low_to_right > 0 ? from_right(r, e) : low;
    out->high = high_to_left < 0 ? to_left(r, e) : high;
    if (low_to_right == 0) out->low.rank = larger(low.rank, from_right(r, e).rank);
    if (high_to_left == 0) out->high.rank = smaller(high.rank, to_left(r, e).rank);
    thin |= low_to_left == 0 || high_to_right == 0;
    if (low_to_left == 0) out->high.rank = smaller(out->high.rank, to_left(r, e).rank);
    if (high_to_right == 0) out->low.rank = larger(out->low.rank, from_right(r, e).rank);
    return !thin || out->low.rank <= out->high.rank;
}

sl_status sli_visible_add(sl_context *context, sli_visible_finder *r, uint32_t cell, sli_bound low,
                          sli_bound high, sli_visible *visible) {
    const sli_visible_interval interval = {
        .cell = cell, .other = UINT32_MAX, .low = low, .high = high, .start = true};
    if (!visible->cells.count) r->split.count = 0;
    return add_interval(context, r, visible, &interval);
}

sl_status sli_visible_through(sl_context *context, sli_visible_finder *r, uint32_t cell,
                              sli_bound low, sli_bound high, bool thin, sli_visible *visible) {
    for (uint32_t i = r->fans->first_directed[cell]; i < r->fans->first_directed[cell + 1]; i++) {
        const sli_walk_portal *e = &r->fans->directed[i];
        piece p;
        if (first_piece(r, e, low, high, thin, &p))
            SL_TRY(arrive(context, r, visible, e->cell, &p, 1));
    }
    return SL_OK;
}

// --- along one ray

void sli_rays_destroy(sl_context *context, sli_rays *rays) {
    sl_free(context, rays->starts.items);
    sl_free(context, rays->cells.items);
    *rays = (sli_rays){0};
}

/// A ray, and what is known at its angle.
typedef struct ray {
    sli_bound along;
    const sli_visible *known; ///< NULL for nothing
    uint32_t event;           ///< of `known`
    uint32_t first;           ///< of its cells
} ray;

/// Whether a cell is seen at the ray's angle anyway, and with it all that lies beyond.
static bool is_known(const sli_visible_finder *r, const ray *of, uint32_t cell) {
    if (!of->known) return false;
    const sli_visible_interval *all = of->known->cells.items;
    const int8_t rank = of->along.rank;
    uint32_t i = r->last[cell];
    if (i >= of->known->cells.count || all[i].cell != cell) return false;
    for (; i != UINT32_MAX; i = all[i].other) {
        const sli_visible_interval *c = &all[i];
        if ((c->enter < of->event || (c->enter == of->event && c->low.rank <= rank)) &&
            (c->leave > of->event || (c->leave == of->event && c->high.rank >= rank)))
            return true;
    }
    return false;
}

static sl_status arrive_on_ray(sl_context *context, sli_visible_finder *r, const ray *of,
                               sli_rays *rays, uint32_t cell) {
    if (cell == SL_NO_CELL) return SL_OK;
    const uint32_t on_ray = r->on_rays[cell];
    if (on_ray >= of->first && on_ray < rays->cells.count && rays->cells.items[on_ray] == cell)
        return SL_OK;
    if (is_known(r, of, cell)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &rays->cells, 1));
    r->on_rays[cell] = (uint32_t)rays->cells.count;
    rays->cells.items[rays->cells.count++] = cell;
    return ++r->pieces % 4096 ? SL_OK : sl_check_cancelled(context);
}

static bool is_along(const sli_visible_finder *r, const ray *of, uint32_t end) {
    return sli_ends_turn(r, of->along.end, end) == 0 && sli_bound_has(r, of->along, end);
}

/// Whether the ray crosses a directed portal on a line with the point.
static bool lies_along(const sli_visible_finder *r, const ray *of, const sli_walk_portal *e) {
    const uint32_t far = sli_same_point(sli_end_of(r, e->left), r->from) ? e->right : e->left;
    return is_along(r, of, far) && rank_along(r, e) == of->along.rank;
}

/// Whether the ray crosses a directed portal of its first cell, of which the point is a corner.
static bool first_crosses(const sli_visible_finder *r, const ray *of, const sli_walk_portal *e) {
    const int facing = sli_ends_turn(r, e->right, e->left);
    if (facing <= 0) return facing == 0 && lies_along(r, of, e);
    return is_along(r, of, of->along.rank == SLI_CLOCKWISE ? e->right : e->left);
}

static bool crosses(const sli_visible_finder *r, const ray *of, const sli_walk_portal *e) {
    const int to_left = sli_ends_turn(r, of->along.end, e->left);
    if (to_left < 0) return false;
    const int to_right = sli_ends_turn(r, of->along.end, e->right);
    if (to_right > 0) return false;
    if (to_left > 0 && to_right < 0) return true;
    const int facing = sli_ends_turn(r, e->right, e->left);
    if (facing <= 0) return facing == 0 && lies_along(r, of, e);
    return sli_bound_has(r, of->along, to_left == 0 ? e->left : e->right);
}

sl_status sli_rays_add(sl_context *context, sli_visible_finder *r, sli_fan_edge edge,
                       const sli_visible *known, uint32_t event, sli_rays *rays) {
    const sli_fans *fans = r->fans;
    const ray of = {.along = {.end = edge.end, .rank = edge.last ? SLI_COUNTER : SLI_CLOCKWISE},
                    .known = known,
                    .event = event,
                    .first = (uint32_t)rays->cells.count};
    SL_TRY(SL_ARRAY_ROOM(context, &rays->starts, 2));
    if (!rays->starts.count) rays->starts.items[rays->starts.count++] = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &rays->cells, 1));
    r->on_rays[edge.cell] = of.first;
    rays->cells.items[rays->cells.count++] = edge.cell;
    for (uint32_t i = of.first; i < rays->cells.count; i++) {
        const uint32_t cell = rays->cells.items[i];
        for (uint32_t k = fans->first_directed[cell]; k < fans->first_directed[cell + 1]; k++) {
            const sli_walk_portal *e = &fans->directed[k];
            if (i == of.first ? first_crosses(r, &of, e) : crosses(r, &of, e))
                SL_TRY(arrive_on_ray(context, r, &of, rays, e->cell));
        }
    }
    rays->starts.items[rays->starts.count++] = (uint32_t)rays->cells.count;
    return SL_OK;
}
