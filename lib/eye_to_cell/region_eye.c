/// Where the eye stands: within a room, on a side or on a corner. The rooms that touch it, joined
/// by portals that touch it, are gone round counter-clockwise; what they show it is the fan.
#include "eye_to_cell/region_parts.h"

/// The sides of a room that meet at the eye, or that it is on: the room lies counter-clockwise from
/// `right` to `left`. They are one where the eye is between a side's ends.
typedef struct corner {
    uint32_t right, left;
} corner;

static const sl_side *side(const sl_outline *o, uint32_t i) {
    return &o->sides[i];
}

static sl_point end_of(const sl_outline *o, uint32_t i) {
    return side(o, side(o, i)->next)->start;
}

static uint32_t previous(const sl_outline *o, uint32_t i) {
    uint32_t before = i;
    while (side(o, before)->next != i) before = side(o, before)->next;
    return before;
}

static bool between(double a, double value, double b) {
    return (a <= value && value <= b) || (b <= value && value <= a);
}

/// Whether the eye is on a side, whose line it is in, other than at its end.
static bool is_on(const sl_outline *o, uint32_t i, sl_point eye) {
    const sl_point a = side(o, i)->start, b = end_of(o, i);
    return !sl_same_point(eye, b) && between(a.x, eye.x, b.x) && between(a.y, eye.y, b.y);
}

/// Makes the fan of all sides of the eye's room, where it is within: they all show a face to it.
/// Where it is on a side, *at are the sides there, and the fan is to be made by going around it.
static sl_status gather_room(sl_context *context, const sl_outline *o, uint32_t room, sl_point eye,
                             struct sl_region_memory *m, corner *at, bool *within) {
    const uint32_t first = o->first[room], stop = o->first[room + 1];
    SL_TRY(SL_ARRAY_ROOM(context, &m->fan, stop - first));
    *within = true;
    for (uint32_t i = first; i < stop; i++) {
        const int turn = sl_orient(side(o, i)->start, end_of(o, i), eye);
        if (turn > 0) m->fan.items[m->fan.count++] = i;
        if (turn != 0 || !is_on(o, i, eye)) continue;
        at->right = i;
        at->left = sl_same_point(eye, side(o, i)->start) ? previous(o, i) : i;
        m->fan.count = 0;
        *within = false;
        return SL_OK;
    }
    return SL_OK;
}

/// The corner at the eye of the room beyond a portal there, which is that room's `side`.
static corner beyond_right(const sl_outline *o, uint32_t portal, sl_point eye) {
    const uint32_t other = side(o, portal)->neighbour;
    return (corner){sl_same_point(end_of(o, other), eye) ? side(o, other)->next : other, other};
}

static corner beyond_left(const sl_outline *o, uint32_t portal, sl_point eye) {
    const uint32_t other = side(o, portal)->neighbour;
    return (corner){other, sl_same_point(side(o, other)->start, eye) ? previous(o, other) : other};
}

/// Adds the sides from `first` on and before `stop` that show a face to the eye.
static sl_status add_sides(sl_context *context, const sl_outline *o, sl_point eye, uint32_t first,
                           uint32_t stop, struct sl_region_memory *m) {
    uint32_t i = first;
    do {
        if (sl_orient(side(o, i)->start, end_of(o, i), eye) > 0) {
            SL_TRY(SL_ARRAY_ROOM(context, &m->fan, 1));
            m->fan.items[m->fan.count++] = i;
        }
        i = side(o, i)->next;
    } while (i != stop);
    return SL_OK;
}

/// Whether the walls at which an open fan starts and ends are one that ends at the eye: seen
/// edge-on from there, it hides nothing.
static bool ends_at_eye(const sl_outline *o, sl_point eye, corner at) {
    const sl_point a = end_of(o, at.right), b = side(o, at.left)->start;
    return side(o, at.right)->neighbour == side(o, at.left)->neighbour &&
           (a.x > eye.x) == (b.x > eye.x) && (a.x < eye.x) == (b.x < eye.x) &&
           (a.y > eye.y) == (b.y > eye.y) && (a.y < eye.y) == (b.y < eye.y);
}

sl_status sl_region_gather_fan(sl_context *context, const sl_outline *o, sl_region *region) {
    struct sl_region_memory *m = region->memory;
    const sl_point eye = region->view.eye;
    const uint32_t room = sl_outline_room(o, region->cell, eye);
    m->fan.count = 0;
    m->open = false;
    corner at = {0};
    bool within;
    SL_TRY(gather_room(context, o, room, eye, m, &at, &within));
    if (within) return SL_OK;
    // Clockwise as far as portals lead, or once around.
    const uint32_t start = at.right;
    bool around = false;
    while (!around && sl_side_is_portal(side(o, at.right))) {
        at = beyond_right(o, at.right, eye);
        around = at.right == start;
    }
    m->right = at.right;
    for (;;) {
        SL_TRY(add_sides(context, o, eye, side(o, at.right)->next, at.left, m));
        m->left = at.left;
        if (!sl_side_is_portal(side(o, at.left))) break;
        at = beyond_left(o, at.left, eye);
        if (around && at.right == start) return SL_OK;
    }
    m->open = !ends_at_eye(o, eye, (corner){m->right, m->left});
    return SL_OK;
}
