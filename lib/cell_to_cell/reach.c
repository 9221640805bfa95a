/// From cell to cell through the portals, each step clipping an interval of directions by the ends
/// of a portal. Exits are tried counter-clockwise, so that directions only grow: turns come sorted
/// without sorting, and a cell that is met again is met where it was left.
#include "cell_to_cell/reach.h"

#include "geometry/orient.h"

sl_status sl_reacher_create(sl_context *context, const sl_fans *fans, bool closed,
                            sl_reacher *reacher) {
    *reacher = (sl_reacher){.fans = fans, .closed = closed};
    reacher->last = sl_alloc_array(context, fans->cell_count, sizeof *reacher->last);
    reacher->on_rays = sl_alloc_array(context, fans->cell_count, sizeof *reacher->on_rays);
    return reacher->last && reacher->on_rays ? SL_OK : SL_NO_MEMORY;
}

void sl_reacher_destroy(sl_context *context, sl_reacher *reacher) {
    sl_free(context, reacher->last);
    sl_free(context, reacher->on_rays);
    sl_free(context, reacher->steps.items);
    *reacher = (sl_reacher){0};
}

void sl_reach_clear(sl_reach *reach) {
    reach->turns.count = reach->cells.count = 0;
}

void sl_reach_destroy(sl_context *context, sl_reach *reach) {
    sl_free(context, reach->turns.items);
    sl_free(context, reach->cells.items);
    *reach = (sl_reach){0};
}

void sl_rays_destroy(sl_context *context, sl_rays *rays) {
    sl_free(context, rays->starts.items);
    sl_free(context, rays->cells.items);
    *rays = (sl_rays){0};
}

// --- directions

/// On which side of a direction a point lies: 1 counter-clockwise of it, -1 clockwise, 0 on its
/// line. For points less than half a turn away.
static inline int side(const sl_reacher *r, const sl_bound *bound, sl_point p) {
    const int sign = sl_orient(*bound->at, p, r->from); // differences from the point, once a bound
    return bound->away ? -sign : sign;
}

/// As side, for a point half a turn away at most; where it is half a turn away, `answer`.
static int side_in_sector(const sl_reacher *r, const sl_bound *bound, sl_point p, int answer) {
    const int sign = side(r, bound, p);
    return sign == 0 && sl_opposite(r->from, *bound->at, p) != bound->away ? answer : sign;
}

static bool same_direction(sl_point from, const sl_point *a, bool away_a, const sl_point *b,
                           bool away_b) {
    if (a == b || sl_same_point(*a, *b)) return away_a == away_b;
    return sl_orient(from, *a, *b) == 0 && sl_opposite(from, *a, *b) == (away_a != away_b);
}

int sl_turns_compare(sl_point from, const sl_point *first, const sl_reach_turn *a,
                     const sl_reach_turn *b) {
    const bool turned = !b->away;
    const int sign = sl_orient(from, *a->at, *b->at);
    if (sign != 0) return (a->away != turned) ? sign : -sign;
    if (sl_opposite(from, *a->at, *b->at) == (a->away != turned)) return 0;
    // Half a turn apart: the one in the first direction comes first.
    return same_direction(from, first, false, a->at, a->away) ? -1 : 1;
}

/// Which level of its direction crosses a portal that lies on the ray: a line that turns
/// counter-clockwise about the point crosses from the right to the left of it.
static int level_along(const sl_reacher *r, const sl_walk_exit *e) {
    const sl_point v = r->from;
    bool right_first;
    if (e->left.x != e->right.x) {
        const bool rightwards = e->left.x > v.x || e->right.x > v.x;
        right_first = rightwards ? e->right.x < e->left.x : e->right.x > e->left.x;
    } else {
        const bool upwards = e->left.y > v.y || e->right.y > v.y;
        right_first = upwards ? e->right.y < e->left.y : e->right.y > e->left.y;
    }
    return right_first ? SL_CLOCKWISE : SL_COUNTER;
}

/// The two bounds that a portal's ends make.
static inline sl_bound from_right(const sl_reacher *r, const sl_walk_exit *e) {
    return (sl_bound){.at = &e->right, .level = r->closed ? SL_CLOCKWISE : SL_AFTER};
}

static inline sl_bound to_left(const sl_reacher *r, const sl_walk_exit *e) {
    return (sl_bound){.at = &e->left, .level = r->closed ? SL_COUNTER : SL_BEFORE};
}

// --- one step

/// What is seen of the cell behind an exit.
typedef struct piece {
    uint32_t exit;
    sl_bound low, high;
    bool thin;
} piece;

static inline int8_t larger(int8_t a, int8_t b) {
    return a > b ? a : b;
}

static inline int8_t smaller(int8_t a, int8_t b) {
    return a < b ? a : b;
}

/// An exit that touches a bound's line with one end, or lies along it: false where it cannot be
/// crossed there. Beside the point itself it may lie on the line's other half.
static bool touch(const sl_reacher *r, const sl_walk_exit *e, const sl_bound *at, bool by_left,
                  int8_t low, int8_t high, piece *out) {
    const int facing = sl_orient(e->right, e->left, r->from);
    if (facing < 0) return false;
    const sl_point end = by_left ? e->left : e->right, other = by_left ? e->right : e->left;
    const bool at_point = sl_same_point(end, r->from);
    const sl_point there = at_point ? other : end;
    if (at_point && side(r, at, other) != 0) return false;
    if (sl_opposite(r->from, *at->at, there) != at->away) return false;
    if (facing == 0) {
        const int8_t level = (int8_t)level_along(r, e);
        low = larger(low, level);
        high = smaller(high, level);
    }
    if (low > high) return false;
    out->low = out->high = *at;
    out->low.level = low;
    out->high.level = high;
    out->thin = true;
    return true;
}

/// An exit whose left end is past `low`. -1: it lies beyond `high`, as do all that follow; 0:
/// nothing is seen through it.
static inline int cut(const sl_reacher *r, const sl_reach_step *s, const sl_walk_exit *e,
                      piece *out) {
    const int past_high = side(r, &s->high, e->right);
    if (past_high > 0) return -1;
    if (past_high == 0) {
        const int8_t low = s->thin ? larger(s->low.level, SL_CLOCKWISE) : SL_CLOCKWISE;
        return r->closed && touch(r, e, &s->high, false, low, s->high.level, out);
    }
    // Behind an exit that was crossed all right ends are past `low` too.
    out->low = s->crossed || side(r, &s->low, e->right) > 0 ? from_right(r, e) : s->low;
    out->high = side(r, &s->high, e->left) < 0 ? to_left(r, e) : s->high;
    out->thin = s->thin;
    return 1;
}

/// The next exit of a step through which something is seen. Exits turn counter-clockwise from the
/// portal by which the cell was entered: first those that turn back towards the point, all at or
/// before `low`, then those on the far side, then those that turn back beyond `high`.
static inline bool next_piece(const sl_reacher *r, sl_reach_step *s, piece *out) {
    while (s->left) {
        const uint32_t number = s->next;
        const sl_walk_exit *e = &r->fans->exits[number];
        s->next = number + 1 < s->end ? number + 1 : s->first;
        s->left--;
        const int past_low = s->crossed ? 1 : side(r, &s->low, e->left);
        if (past_low < 0) continue;
        out->exit = number;
        if (past_low == 0) {
            const int8_t high = s->thin ? smaller(s->high.level, SL_COUNTER) : SL_COUNTER;
            if (r->closed && touch(r, e, &s->low, true, s->low.level, high, out)) return true;
            continue;
        }
        const int found = cut(r, s, e, out);
        if (found < 0) break;
        s->crossed = true;
        if (found) return true;
    }
    s->left = 0;
    return false;
}

static sl_status push_step(sl_context *context, sl_reacher *r, const piece *p, uint32_t found) {
    const sl_walk_exit *e = &r->fans->exits[p->exit];
    SL_TRY(SL_ARRAY_ROOM(context, &r->steps, 1));
    r->steps.items[r->steps.count++] = (sl_reach_step){
        .next = e->twin + 1 < e->end ? e->twin + 1 : e->first,
        .left = e->end - e->first - 1,
        .first = e->first,
        .end = e->end,
        .found = found,
        .low = p->low,
        .high = p->high,
        .thin = p->thin,
    };
    if (r->steps.count > r->deepest) r->deepest = (uint32_t)r->steps.count;
    return ++r->pieces % 4096 ? SL_OK : sl_check_cancelled(context);
}

// --- all that is seen through a cell of a fan

/// The turn of a bound, which is the last one or comes after all.
static sl_status turn_of(sl_context *context, const sl_reacher *r, sl_reach *reach,
                         const sl_bound *bound, uint32_t *turn) {
    const size_t count = reach->turns.count;
    if (count) {
        const sl_reach_turn *last = &reach->turns.items[count - 1];
        if (same_direction(r->from, last->at, last->away, bound->at, bound->away)) {
            *turn = (uint32_t)count - 1;
            return SL_OK;
        }
    }
    SL_TRY(SL_ARRAY_ROOM(context, &reach->turns, 1));
    reach->turns.items[count] = (sl_reach_turn){
        .at = bound->at, .away = bound->away, .ray = UINT32_MAX, .leave = UINT32_MAX};
    reach->turns.count++;
    *turn = (uint32_t)count;
    return SL_OK;
}

static sl_status add_reached(sl_context *context, sl_reacher *r, sl_reach *reach,
                             sl_reached reached) {
    SL_TRY(SL_ARRAY_ROOM(context, &reach->cells, 1));
    r->last[reached.cell] = (uint32_t)reach->cells.count;
    reached.leave = UINT32_MAX;
    reach->cells.items[reach->cells.count++] = reached;
    return SL_OK;
}

/// Takes from a piece what its cell was seen through before, up to the same turn. False where
/// nothing is left. Only lines through several ends make a piece start before what is known.
static bool take_known(sl_reached *known, piece *p, uint32_t turn) {
    if (known->enter == turn && p->low.level < known->enter_level) {
        known->enter_level = p->low.level;
        return true;
    }
    if (p->thin && p->high.level <= known->leave_level) return false;
    if (known->leave_level == SL_CLOCKWISE) p->low.level = larger(p->low.level, SL_COUNTER);
    if (known->leave_level >= SL_COUNTER) p->low.level = SL_AFTER;
    return !p->thin || p->low.level <= p->high.level;
}

/// Goes on into the cell of a piece.
static sl_status arrive(sl_context *context, sl_reacher *r, sl_reach *reach, piece *p) {
    const uint32_t cell = r->fans->exits[p->exit].cell;
    if (cell == SL_NO_CELL) return SL_OK;
    uint32_t turn, found = r->last[cell];
    SL_TRY(turn_of(context, r, reach, &p->low, &turn));
    sl_reached *known = found < reach->cells.count ? &reach->cells.items[found] : NULL;
    if (known && known->cell == cell && known->leave == turn) {
        if (!take_known(known, p, turn)) return SL_OK;
    } else {
        found = (uint32_t)reach->cells.count;
        SL_TRY(add_reached(context, r, reach,
                           (sl_reached){.cell = cell, .enter = turn, .enter_level = p->low.level}));
    }
    return push_step(context, r, p, found);
}

static void leave(sl_reached *reached, uint32_t turn, int8_t level) {
    reached->leave_level = reached->leave == turn ? larger(reached->leave_level, level) : level;
    reached->leave = turn;
}

static sl_status run(sl_context *context, sl_reacher *r, sl_reach *reach, piece *p) {
    SL_TRY(arrive(context, r, reach, p));
    while (r->steps.count) {
        sl_reach_step *s = &r->steps.items[r->steps.count - 1];
        if (next_piece(r, s, p)) {
            SL_TRY(arrive(context, r, reach, p));
            continue;
        }
        uint32_t turn;
        SL_TRY(turn_of(context, r, reach, &s->high, &turn));
        leave(&reach->cells.items[s->found], turn, s->high.level);
        r->steps.count--;
    }
    return SL_OK;
}

/// What is seen through an exit on the far side of a cell that the point is a corner of.
static bool first_piece(const sl_reacher *r, const sl_walk_exit *e, const sl_bound *low,
                        const sl_bound *high, bool thin, piece *out) {
    if (sl_orient(e->right, e->left, r->from) <= 0) return false;
    // What faces the point lies past the sector's first edge, and not past its last.
    const int low_to_left = low->away ? side_in_sector(r, low, e->left, 1) : 1;
    const int high_to_right = high->away ? side_in_sector(r, high, e->right, -1) : -1;
    if (low_to_left < 0 || high_to_right > 0) return false;
    const int low_to_right = side_in_sector(r, low, e->right, -1);
    const int high_to_left = side_in_sector(r, high, e->left, 1);
    out->low = low_to_right > 0 ? from_right(r, e) : *low;
    out->high = high_to_left < 0 ? to_left(r, e) : *high;
    if (low_to_right == 0) out->low.level = larger(low->level, from_right(r, e).level);
    if (high_to_left == 0) out->high.level = smaller(high->level, to_left(r, e).level);
    out->thin = thin || low_to_left == 0 || high_to_right == 0;
    if (low_to_left == 0) out->high.level = smaller(out->high.level, to_left(r, e).level);
    if (high_to_right == 0) out->low.level = larger(out->low.level, from_right(r, e).level);
    return !out->thin || out->low.level <= out->high.level;
}

sl_status sl_reach_add(sl_context *context, sl_reacher *r, const sl_fan_cell *cell, sl_bound low,
                       sl_bound high, bool thin, sl_reach *reach) {
    const uint32_t first = r->fans->first_exit[cell->cell];
    const uint32_t end = r->fans->first_exit[cell->cell + 1];
    const uint32_t found = (uint32_t)reach->cells.count;
    uint32_t turn, exit = cell->begin;
    SL_TRY(turn_of(context, r, reach, &low, &turn));
    SL_TRY(add_reached(
        context, r, reach,
        (sl_reached){.cell = cell->cell, .enter = turn, .enter_level = low.level, .start = true}));
    r->steps.count = 0;
    for (uint32_t i = first; i < end; i++, exit = exit + 1 < end ? exit + 1 : first) {
        piece p = {.exit = exit};
        if (first_piece(r, &r->fans->exits[exit], &low, &high, thin, &p))
            SL_TRY(run(context, r, reach, &p));
    }
    SL_TRY(turn_of(context, r, reach, &high, &turn));
    leave(&reach->cells.items[found], turn, high.level);
    return SL_OK;
}

// --- along one ray

/// A ray, and what is known of its moment.
typedef struct ray {
    sl_bound along;
    const sl_reach *known; ///< NULL for nothing
    uint32_t turn;         ///< of `known`
    uint32_t first;        ///< of its cells
} ray;

/// Whether a cell is seen at the ray's moment without it, and so all that lies beyond.
static bool is_known(const sl_reacher *r, const ray *of, uint32_t cell) {
    if (!of->known) return false;
    const uint32_t found = r->last[cell];
    if (found >= of->known->cells.count) return false;
    const sl_reached *c = &of->known->cells.items[found];
    const int8_t level = of->along.level;
    return c->cell == cell &&
           (c->enter < of->turn || (c->enter == of->turn && c->enter_level <= level)) &&
           (c->leave > of->turn || (c->leave == of->turn && c->leave_level >= level));
}

/// As arrive, for a ray: each cell once.
static sl_status arrive_along(sl_context *context, sl_reacher *r, const ray *of, sl_rays *rays,
                              const piece *p) {
    const uint32_t cell = r->fans->exits[p->exit].cell;
    if (cell == SL_NO_CELL) return SL_OK;
    const uint32_t on_ray = r->on_rays[cell];
    if (on_ray >= of->first && on_ray < rays->cells.count && rays->cells.items[on_ray] == cell)
        return SL_OK;
    if (is_known(r, of, cell)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &rays->cells, 1));
    r->on_rays[cell] = (uint32_t)rays->cells.count;
    rays->cells.items[rays->cells.count++] = cell;
    return push_step(context, r, p, 0);
}

/// What is seen through an exit of the first cell, exactly along the edge.
static bool first_along(const sl_reacher *r, const sl_walk_exit *e, const sl_bound *along,
                        piece *out) {
    const int facing = sl_orient(e->right, e->left, r->from);
    if (facing < 0) return false;
    const sl_point *far = sl_same_point(e->left, r->from) ? &e->right : &e->left;
    if (facing == 0) {
        if (!same_direction(r->from, along->at, false, far, false)) return false;
        if (level_along(r, e) != along->level) return false;
    } else {
        const sl_point *touching = along->level == SL_CLOCKWISE ? &e->right : &e->left;
        if (!same_direction(r->from, along->at, false, touching, false)) return false;
    }
    out->low = out->high = *along;
    out->thin = true;
    return true;
}

sl_status sl_rays_add(sl_context *context, sl_reacher *r, sl_fan_edge edge, const sl_reach *known,
                      uint32_t turn, sl_rays *rays) {
    const uint32_t cell = edge.cell->cell;
    const ray of = {.along = {.at = edge.edge, .level = edge.last ? SL_COUNTER : SL_CLOCKWISE},
                    .known = known,
                    .turn = turn,
                    .first = (uint32_t)rays->cells.count};
    SL_TRY(SL_ARRAY_ROOM(context, &rays->starts, 2));
    if (!rays->starts.count) rays->starts.items[rays->starts.count++] = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &rays->cells, 1));
    r->on_rays[cell] = of.first;
    rays->cells.items[rays->cells.count++] = cell;
    r->steps.count = 0;
    for (uint32_t e = r->fans->first_exit[cell]; e < r->fans->first_exit[cell + 1]; e++) {
        piece p = {.exit = e};
        if (!first_along(r, &r->fans->exits[e], &of.along, &p)) continue;
        SL_TRY(arrive_along(context, r, &of, rays, &p));
        while (r->steps.count) {
            if (next_piece(r, &r->steps.items[r->steps.count - 1], &p))
                SL_TRY(arrive_along(context, r, &of, rays, &p));
            else
                r->steps.count--;
        }
    }
    rays->starts.items[rays->starts.count++] = (uint32_t)rays->cells.count;
    return SL_OK;
}
