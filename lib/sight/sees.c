/// Single lines of sight: do two points see each other, and what does a ray hit?
///
/// sli_sees follows the segment between two points from room to room. Nearly always it leaves each
/// room within one side, and the other point lies before that side or behind it:
///
///     +--------+---------+     first the side by which the segment leaves a room, as for a ray;
///     | eye *--|----* .. |     then on which side of it the point is: before it, it is seen;
///     +--------+---------+     behind it, the segment goes on through a portal or ends at a wall
///
/// Where the segment touches a corner, or an end lies on a side, it may go on in several rooms.
/// Then all rooms are tried that it comes to by portals that it meets. It is seen where one of them
/// holds the point; with open sight it must touch no wall.
///
/// Of all these ways the one counts that passes the fewest limited walls. Those that the eye is on
/// do not count for the rooms about it, and a point on one is seen. So where the line passes the
/// common end of two limited walls, it passes one of them, or none; where two cross, it passes two.
///
/// sli_ray_cast starts at the side of the fan (region.c) that the ray meets and goes from room to
/// room to the first side that is no portal. Both decide by exact predicates alone; only the point
/// where the ray hits is rounded. Cost: O(sides of the rooms on the way).
#include "sight/region.h"

#include "sight/region_parts.h"
#include "sightline/support.h"

#include <math.h>

// --- two points, where nothing is touched

typedef enum finding { HIDDEN, SEEN, TOUCHES } finding;

/// Finds the side by which a ray leaves the room that its eye is in. False where the eye is not
/// within the room, or the ray's line touches a corner of it.
static bool leave_start(const sl_outline *o, const sli_eye_place *eye, const sli_eye_ray *ray,
                        double limit, uint32_t room, uint32_t *at) {
    const sl_side *sides = o->sides;
    uint32_t i = o->first[room];
    sl_point a = sides[i].start;
    int turn = sli_eye_turn_to(eye, ray, a, sli_eye_offset(eye, a), limit);
    bool found = false;
    do {
        const uint32_t next = sides[i].next;
        const sl_point b = sides[next].start;
        const int next_turn = sli_eye_turn_to(eye, ray, b, sli_eye_offset(eye, b), limit);
        if (next_turn == 0 || sli_orient(a, b, eye->point.at) <= 0) return false;
        if (turn < 0 && next_turn > 0) {
            *at = i;
            found = true;
        }
        turn = next_turn;
        a = b;
        i = next;
    } while (i != o->first[room]);
    return found;
}

/// Follows the segment as long as it passes within sides.
static finding follow_within(const sl_outline *o, uint32_t room, sl_point eye, sl_point point) {
    const sl_side *sides = o->sides;
    const sli_eye_place place = sli_eye_place_at(eye);
    const sli_eye_ray ray = sli_eye_ray_through(&place, point);
    const sl_view view = {.eye = eye, .left = point, .right = point};
    const double limit = sli_eye_limit(o->space, &view);
    uint32_t at;
    if (!leave_start(o, &place, &ray, limit, room, &at)) return TOUCHES;
    bool within = true, limited = false;
    for (;;) {
        const int before = sli_orient(sides[at].start, sides[sides[at].next].start, point);
        if (before) {
            if (before > 0) return SEEN;
            if (!sl_side_is_portal(&sides[at])) return HIDDEN;
            if (sli_region_limit(o, at) != SL_NO_SEAM) {
                if (limited) return HIDDEN;
                limited = true;
            }
        }
        if (!before ||
            !sli_region_find_first(o, &place, limit, sides[at].neighbour, &ray, &at, &within) ||
            !within)
            return TOUCHES;
    }
}

// --- two points, all rooms that the segment may go to

typedef struct seer {
    const sl_outline *outline;
    sl_point eye, point;
    uint32_t cell; ///< the eye's
    bool touches;  ///< a wall, somewhere
    SL_ARRAY(uint32_t) waiting;
    SL_ARRAY(uint32_t) later; ///< behind one more limited wall
    unsigned passed;          ///< limited walls on the way; 2 for more
    sl_bits *entered;         ///< by room
} seer;

/// Whether two segments in one line have a point in common.
static bool overlap(sl_point a, sl_point b, sl_point c, sl_point d) {
    return fmax(fmin(a.x, b.x), fmin(c.x, d.x)) <= fmin(fmax(a.x, b.x), fmax(c.x, d.x)) &&
           fmax(fmin(a.y, b.y), fmin(c.y, d.y)) <= fmin(fmax(a.y, b.y), fmax(c.y, d.y));
}

/// Whether the segment and a side have a point in common.
static bool meets(const seer *s, sl_point a, sl_point b) {
    const int ea = sli_orient(s->eye, s->point, a), eb = sli_orient(s->eye, s->point, b);
    const int from = sli_orient(a, b, s->eye), to = sli_orient(a, b, s->point);
    if (ea == 0 && eb == 0) return from == 0 && overlap(s->eye, s->point, a, b);
    return ea * eb <= 0 && from * to <= 0;
}

static bool room_holds(const seer *s, uint32_t room, sl_point point) {
    const sl_side *sides = s->outline->sides;
    for (uint32_t i = s->outline->first[room]; i < sl_outline_stop(s->outline, room); i++)
        if (sli_orient(sides[i].start, sides[sides[i].next].start, point) < 0) return false;
    return true;
}

static uint32_t room_of(const sl_outline *o, uint32_t side) {
    uint32_t low = 0, high = o->room_count;
    if (o->room_of) return o->room_of[side];
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (o->first[middle] <= side)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static sl_status enter(sl_context *context, seer *s, uint32_t room) {
    if (sl_bits_has(s->entered, room)) return SL_OK;
    sl_bits_add(s->entered, room);
    SL_TRY(SL_ARRAY_ROOM(context, &s->waiting, 1));
    s->waiting.items[s->waiting.count++] = room;
    return SL_OK;
}

/// Goes through a portal: a limited wall is passed later, unless nothing is counted any more.
static sl_status pass(sl_context *context, seer *s, uint32_t side) {
    const uint32_t room = room_of(s->outline, sli_region_across(s->outline, side));
    if (s->passed == 2 || sli_region_limit(s->outline, side) == SL_NO_SEAM)
        return enter(context, s, room);
    SL_TRY(SL_ARRAY_ROOM(context, &s->later, 1));
    s->later.items[s->later.count++] = room;
    return SL_OK;
}

/// Enters the rooms about the eye.
static sl_status enter_around(sl_context *context, seer *s) {
    const sl_outline *o = s->outline;
    for (size_t k = 0; k < s->waiting.count; k++) {
        const uint32_t room = s->waiting.items[k];
        for (uint32_t i = o->first[room]; i < sl_outline_stop(o, room); i++) {
            const sl_point a = o->sides[i].start, b = o->sides[o->sides[i].next].start;
            if (sli_orient(a, b, s->eye) == 0 && overlap(s->eye, s->eye, a, b) &&
                sli_region_leads_on(o, i, s->cell, s->eye))
                SL_TRY(enter(context, s, room_of(o, sli_region_across(o, i))));
        }
    }
    return SL_OK;
}

/// Enters all rooms that the segment leads to without a further limited wall, and finds whether one
/// of them holds the point.
static sl_status follow(sl_context *context, seer *s, bool *arrives) {
    const sl_outline *o = s->outline;
    while (s->waiting.count) {
        const uint32_t room = s->waiting.items[--s->waiting.count];
        *arrives = *arrives || (s->passed < 2 && room_holds(s, room, s->point));
        for (uint32_t i = o->first[room]; i < sl_outline_stop(o, room); i++) {
            const sl_side *side = &o->sides[i];
            const bool open = sli_region_leads_on(o, i, s->cell, s->eye);
            if (side->neighbour >= SL_SIDE_BORDER || (s->touches && !open) ||
                !meets(s, side->start, o->sides[side->next].start))
                continue;
            if (open)
                SL_TRY(pass(context, s, i));
            else
                s->touches = true;
        }
    }
    return SL_OK;
}

/// The same through all limited walls. Rooms behind the second one tell only what is touched, which
/// open sight asks.
static sl_status follow_all(sl_context *context, seer *s, sl_sight sight, bool *arrives) {
    if (s->outline->limited) SL_TRY(enter_around(context, s));
    for (;;) {
        SL_TRY(follow(context, s, arrives));
        if (!s->later.count || s->passed == (sight == SL_OPEN ? 2 : 1)) return SL_OK;
        s->passed++;
        for (size_t i = 0; i < s->later.count; i++) SL_TRY(enter(context, s, s->later.items[i]));
        s->later.count = 0;
    }
}

sl_status sli_sees(sl_context *context, const sl_outline *outline, sl_point eye, sl_point point,
                   sl_sight sight, bool *out) {
    const sl_space *space = outline->space;
    const uint32_t start = sli_eye_cell(space, eye);
    *out = false;
    if (start == SL_NO_CELL || !sli_box_holds(&space->bounds, point)) return SL_OK;
    const uint32_t room = sl_outline_room(outline, start, eye);
    const finding found = space->loose ? TOUCHES : follow_within(outline, room, eye, point);
    *out = found == SEEN;
    if (found != TOUCHES || sl_space_locate(space, point) == SL_NO_CELL) return SL_OK;
    seer s = {.outline = outline, .eye = eye, .point = point, .cell = start};
    bool arrives = false;
    s.entered = sl_alloc_array(context, sl_bits_words(outline->room_count), sizeof *s.entered);
    sl_status status = s.entered ? enter(context, &s, room) : SL_NO_MEMORY;
    if (status == SL_OK) status = follow_all(context, &s, sight, &arrives);
    sl_free(context, s.entered);
    sl_free(context, s.waiting.items);
    sl_free(context, s.later.items);
    if (status == SL_OK) *out = arrives && (sight == SL_CLOSED || !s.touches);
    return status;
}

// --- rays

/// Finds the wall, second limited wall or border that the ray meets, starting at a side of the fan.
/// False where the boundary of a room is not closed, by rounding.
static bool walk(const sl_outline *o, const sli_eye_place *eye, const sli_eye_ray *ray,
                 uint32_t *at, bool *within) {
    bool limited = false;
    const sl_view view = {.eye = eye->point.at, .left = ray->at, .right = ray->at};
    const double limit = sli_eye_limit(o->space, &view);
    while (sl_side_is_portal(&o->sides[*at])) {
        const uint32_t entry = o->sides[*at].neighbour;
        if (sli_region_limit(o, *at) != SL_NO_SEAM) {
            if (limited) return true;
            limited = true;
        }
        if (!sli_region_find_first(o, eye, limit, entry, ray, at, within)) return false;
    }
    return true;
}

static void write_hit(const sl_outline *o, sl_point eye, const sli_eye_ray *ray, uint32_t at,
                      bool within, sl_hit *out) {
    const sl_side *side = &o->sides[at];
    // An eye on glass may have the lit side there. Else a portal is a limited wall.
    const uint32_t neighbour =
        sl_side_is_portal(side) ? o->sides[side->neighbour].neighbour : side->neighbour;
    out->wall = neighbour >= SL_SIDE_BORDER ? UINT32_MAX : neighbour - SL_SIDE_WALL;
    if (neighbour < SL_SIDE_WALL) out->wall = SL_LIMITED_WALL + sli_region_limit(o, at);
    out->point = side->start;
    if (!within) return;
    const sl_point a = side->start, b = o->sides[side->next].start;
    const sl_point offset = sli_region_meet(eye, ray, a, b);
    out->point.x = fmin(fmax(eye.x + offset.x, fmin(a.x, b.x)), fmax(a.x, b.x));
    out->point.y = fmin(fmax(eye.y + offset.y, fmin(a.y, b.y)), fmax(a.y, b.y));
}

sl_status sli_ray_cast(sl_context *context, const sl_outline *outline, sl_point eye,
                       sl_point through, sl_hit *out) {
    struct sli_region_memory memory = {0};
    sl_region region = {.view = sl_view_all_round(eye), .memory = &memory};
    region.cell = sli_eye_cell(outline->space, eye);
    if (region.cell == SL_NO_CELL)
        return sl_fail(context, SL_BAD_ARGUMENT, "the eye is outside the map or in solid ground");
    if (!isfinite(through.x) || !isfinite(through.y) || (through.x == eye.x && through.y == eye.y))
        return sl_fail(context, SL_BAD_ARGUMENT, "a ray needs a second point");
    const sli_eye_place place = sli_eye_place_at(eye);
    const sli_eye_ray ray = sli_eye_ray_through(&place, through);
    memory.eye = place;
    sl_status status = sli_region_gather_fan(context, outline, &region);
    if (status == SL_OK) {
        const uint32_t k = sli_region_find_side(outline, &region, &ray, true);
        uint32_t at = k == UINT32_MAX ? memory.left : memory.fan.items[k];
        sl_hit hit = {0};
        bool within = true;
        if (k != UINT32_MAX) {
            const sli_eye_ray start = sli_eye_ray_through(&place, outline->sides[at].start);
            within = sli_eye_turn(&place, &ray, &start) != 0;
        }
        if (k != UINT32_MAX && !walk(outline, &place, &ray, &at, &within))
            status = sl_fail(context, SL_BAD_ARGUMENT, "the outline of a room is not closed");
        write_hit(outline, eye, &ray, at, within && k != UINT32_MAX, &hit);
        if (k == UINT32_MAX) hit.point = eye;
        if (status == SL_OK) *out = hit;
    }
    sl_free(context, memory.fan.items);
    return status;
}
