/// The visible region (isovist) of an eye, by expansion through portals.
///
/// The view spreads over the sides of the room that the eye is in. A side that is a wall is seen,
/// piece by piece. Through a side that is a portal the view goes on as a cone of two rays into the
/// room behind it:
///
///      +---------+--------.-+
///      |         |    .  left     `left` and `right` bound what is seen through the portal ab.
///      |         b .        |     On the way around the next room, counter-clockwise from the
///      |  eye *  |   seen   |     portal, corners come that are right of the cone, then those
///      |         a .        |     within it, then those left of it.
///      |         |    .  right
///      +---------+--------.-+
///
/// Invariant: rooms are convex and a cone is narrower than half a circle. So on the way around a
/// room the corners pass the right ray once, and then the left ray once: one exact predicate a
/// side. Pieces come in counter-clockwise order, so they are appended to one polygon
/// (region_polygon.c).
///
/// One-way glass is a portal at its lit side and a wall at its dark one. So a view passes it one
/// way, also by mirror. At the eye itself the side that the eye is on decides.
///
/// A cone that has passed a limited wall takes the next one for a wall. The fan about an eye on
/// limited walls spreads through them, so these do not count.
///
/// Cost: O(sides of the rooms that are seen), counted once for each time a room is entered. The
/// expansion is that of triangular expansion (Bungiu et al. 2014, Efficient Computation of
/// Visibility Polygons), with convex rooms in place of triangles.
#include "sight/region.h"
#include "sightline/region.h"

#include "geometry/length.h"
#include "sight/cone.h"
#include "sight/eye_search.h"
#include "sight/past_boxes.h"

#include <math.h>

// --- the fan about the eye

// The eye stands within a room, on a side, or on a corner where several rooms meet. The rooms that
// touch it, joined by portals that touch it, are visited counter-clockwise. The fan is the list of
// their sides that face the eye.

/// The two sides of a room that meet at the eye. The room lies counter-clockwise from `right` to
/// `left`. Both are the same side where the eye is between its ends.
typedef struct corner {
    uint32_t right, left;
} corner;

static const sl_side *side_of(const sl_outline *o, uint32_t i) {
    return &o->sides[i];
}

static sl_point end_of(const sl_outline *o, uint32_t i) {
    return side_of(o, side_of(o, i)->next)->start;
}

static uint32_t previous(const sl_outline *o, uint32_t i) {
    uint32_t before = i;
    while (side_of(o, before)->next != i) before = side_of(o, before)->next;
    return before;
}

static bool between(double a, double value, double b) {
    return (a <= value && value <= b) || (b <= value && value <= a);
}

/// Whether the eye is on a side, whose line it is in, other than at its end.
static bool is_on(const sl_outline *o, uint32_t i, sl_point eye) {
    const sl_point a = side_of(o, i)->start, b = end_of(o, i);
    return !sli_same_point(eye, b) && between(a.x, eye.x, b.x) && between(a.y, eye.y, b.y);
}

/// Makes the fan of an eye within a room: all sides of the room face it. For an eye on a side,
/// finds the sides there (*at) and leaves the fan empty: the caller goes around the eye.
static sl_status gather_room(sl_context *context, const sl_outline *o, uint32_t room, sl_point eye,
                             struct sli_region_memory *m, corner *at, bool *within) {
    const uint32_t first = o->first[room], stop = sl_outline_stop(o, room);
    SL_TRY(SL_ARRAY_ROOM(context, &m->fan, stop - first));
    *within = true;
    for (uint32_t i = first; i < stop; i++) {
        const int turn = sli_orient(side_of(o, i)->start, end_of(o, i), eye);
        if (turn > 0) m->fan.items[m->fan.count++] = i;
        if (turn != 0 || !is_on(o, i, eye)) continue;
        at->right = i;
        at->left = sli_same_point(eye, side_of(o, i)->start) ? previous(o, i) : i;
        m->fan.count = 0;
        *within = false;
        return SL_OK;
    }
    return SL_OK;
}

/// The wall on the dark side of glass, given either side of it; SL_NO_WALL for no glass.
static uint32_t dark_wall(const sl_outline *o, uint32_t i) {
    const sl_side *side = side_of(o, i);
    if (!o->lit) return SL_NO_WALL;
    if (sl_side_is_portal(side)) side = side_of(o, side->neighbour);
    return sl_side_is_dark(o, side) ? side->neighbour - SL_SIDE_WALL : SL_NO_WALL;
}

/// Whether glass, by the wall on its dark side, is dark for an eye.
static bool is_dark_for(const sl_outline *o, uint32_t wall, uint32_t eye_cell, sl_point eye) {
    const sl_space *s = o->space;
    const sl_wall *glass = &s->walls[wall];
    const int turn = sli_orient(glass->a, glass->b, eye);
    if (turn) return turn > 0;
    const sl_cell *cell = &s->cells[eye_cell];
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (sli_orient(glass->a, glass->b, s->vertices[cell->first_vertex + i]) > 0) return true;
    return false;
}

bool sli_region_leads_on(const sl_outline *o, uint32_t i, uint32_t eye_cell, sl_point eye) {
    const uint32_t glass = dark_wall(o, i);
    if (glass == SL_NO_WALL) return sl_side_is_portal(side_of(o, i));
    return !is_dark_for(o, glass, eye_cell, eye);
}

uint32_t sli_region_across(const sl_outline *o, uint32_t i) {
    const sl_side *side = side_of(o, i);
    return sl_side_is_dark(o, side) ? o->lit[side->neighbour - SL_SIDE_WALL - o->first_dark]
                                    : side->neighbour;
}

/// What a side is that the fan does not go through: a wall or the border.
static uint32_t stop_at(const sl_outline *o, uint32_t i) {
    const uint32_t glass = dark_wall(o, i);
    return glass == SL_NO_WALL ? side_of(o, i)->neighbour : SL_SIDE_WALL + glass;
}

/// The corner at the eye of the room behind a portal there, clockwise.
static corner neighbour_right(const sl_outline *o, uint32_t portal, sl_point eye) {
    const uint32_t other = sli_region_across(o, portal);
    return (corner){sli_same_point(end_of(o, other), eye) ? side_of(o, other)->next : other, other};
}

/// The same, counter-clockwise.
static corner neighbour_left(const sl_outline *o, uint32_t portal, sl_point eye) {
    const uint32_t other = sli_region_across(o, portal);
    return (corner){other,
                    sli_same_point(side_of(o, other)->start, eye) ? previous(o, other) : other};
}

/// Adds the sides from `first` to before `stop` that face the eye.
static sl_status add_sides(sl_context *context, const sl_outline *o, sl_point eye, uint32_t first,
                           uint32_t stop, struct sli_region_memory *m) {
    uint32_t i = first;
    do {
        if (sli_orient(side_of(o, i)->start, end_of(o, i), eye) > 0) {
            SL_TRY(SL_ARRAY_ROOM(context, &m->fan, 1));
            m->fan.items[m->fan.count++] = i;
        }
        i = side_of(o, i)->next;
    } while (i != stop);
    return SL_OK;
}

/// Whether an open fan starts and ends at one wall, which ends at the eye. Seen edge-on, it hides
/// nothing.
static bool ends_at_eye(const sl_outline *o, sl_point eye, corner at) {
    const sl_point a = end_of(o, at.right), b = side_of(o, at.left)->start;
    return stop_at(o, at.right) == stop_at(o, at.left) && (a.x > eye.x) == (b.x > eye.x) &&
           (a.x < eye.x) == (b.x < eye.x) && (a.y > eye.y) == (b.y > eye.y) &&
           (a.y < eye.y) == (b.y < eye.y);
}

sl_status sli_region_gather_fan(sl_context *context, const sl_outline *o, sl_region *region) {
    struct sli_region_memory *m = region->memory;
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
    while (!around && sli_region_leads_on(o, at.right, region->cell, eye)) {
        at = neighbour_right(o, at.right, eye);
        around = at.right == start;
    }
    m->right = at.right;
    for (;;) {
        SL_TRY(add_sides(context, o, eye, side_of(o, at.right)->next, at.left, m));
        m->left = at.left;
        if (!sli_region_leads_on(o, at.left, region->cell, eye)) break;
        at = neighbour_left(o, at.left, eye);
        if (around && at.right == start) return SL_OK;
    }
    m->open = !ends_at_eye(o, eye, (corner){m->right, m->left});
    return SL_OK;
}

// --- the expansion

typedef struct expansion {
    sl_context *context;
    const sl_outline *outline;
    sl_region *region;
    const uint32_t *limited; ///< that of the outline
} expansion;

static const sl_side *side(const expansion *x, uint32_t i) {
    return &x->outline->sides[i];
}

static sli_eye_ray to_start(const expansion *x, uint32_t i) {
    return sli_eye_ray_through(&x->region->memory->eye, side(x, i)->start);
}

/// Whether a side is out of range, however its distance was rounded.
static bool is_far(const expansion *x, uint32_t i) {
    const sl_point a = side(x, i)->start, b = side(x, side(x, i)->next)->start;
    const sl_point p = sli_eye_offset(&x->region->memory->eye, a), d = {b.x - a.x, b.y - a.y};
    const double along = -sli_dot(p, d) / sli_dot(d, d);
    const double share = along > 0 ? along < 1 ? along : 1 : 0;
    return sli_length(p.x + share * d.x, p.y + share * d.y) > x->region->range * (1 + 1e-9);
}

static bool same_sign(double a, double b) {
    return (a > 0) == (b > 0) && (a < 0) == (b < 0);
}

/// Whether two rays that lie in one line are one.
static bool same_direction(const sli_eye_ray *a, const sli_eye_ray *b) {
    return same_sign(a->offset.x, b->offset.x) && same_sign(a->offset.y, b->offset.y);
}

/// Adds the part between two rays of a wall, or of a portal out of range (SLI_PIECE_FAR).
static inline sl_status see_piece(expansion *x, uint32_t neighbour, const sli_eye_ray *a,
                                  const sli_eye_ray *b, const sli_eye_ray *right,
                                  const sli_eye_ray *left) {
    struct sli_region_memory *m = x->region->memory;
    if (SLI_BOXES && m->envelope.count)
        return sli_region_see_past(x->context, x->region, neighbour, a, b, right, left);
    if (!m->pending || m->piece.neighbour != neighbour || neighbour == SLI_PIECE_FAR)
        SL_TRY(sli_region_start_piece(x->context, x->region, neighbour, a, b, right));
    m->piece.a = a->at;
    m->piece.b = b->at;
    m->piece.left = left ? *left : *b;
    m->piece.to_end = !left;
    return SL_OK;
}

/// Takes reflected views of the mirrors on a side, as far as they lie between two rays.
static sl_status reflect(expansion *x, uint32_t at, const sli_eye_ray *right,
                         const sli_eye_ray *left) {
    struct sli_region_memory *m = x->region->memory;
    const sli_room_mirrors *mirrors = m->mirrors;
    for (uint32_t i = mirrors->first[at]; i < mirrors->first[at + 1]; i++) {
        const sli_room_mirror *mirror = &mirrors->pieces[i];
        sli_reflected_view seen = {.side = at, .mirror = mirror->mirror};
        seen.right = sli_eye_ray_through(&m->eye, mirror->right);
        seen.left = sli_eye_ray_through(&m->eye, mirror->left);
        if (sli_eye_turn(&m->eye, &seen.right, right) > 0) seen.right = *right;
        if (sli_eye_turn(&m->eye, left, &seen.left) > 0) seen.left = *left;
        if (sli_eye_turn(&m->eye, &seen.right, &seen.left) <= 0) continue;
        SL_TRY(SL_ARRAY_ROOM(x->context, &m->reflected_views, 1));
        m->reflected_views.items[m->reflected_views.count++] = seen;
    }
    return SL_OK;
}

/// Whether a portal is out of range.
static inline bool is_barred(const expansion *x, uint32_t i) {
    return x->region->range > 0 && is_far(x, i);
}

/// A view cone within a room: from the ray `right`, which meets the side `at` within it or at its
/// start, to the ray `left`.
typedef struct view_cone {
    uint32_t entry, at;
    bool within;
    bool limited; ///< it has passed a limited wall
    sli_eye_ray right, left;
} view_cone;

static sl_status grow_frames(expansion *x) {
    return SL_ARRAY_ROOM(x->context, &x->region->memory->frames, 1);
}

/// Takes the cone through the portal that it is at. `turn`: where the portal's end lies from the
/// left ray. The rest of the room waits as a frame. `limits`, here and below: the outline has
/// limited walls. It is a constant, so that others pay nothing for them.
SLI_VISIT sl_status enter(expansion *x, view_cone *cone, int turn, bool limits) {
    struct sli_region_memory *m = x->region->memory;
    const sl_side *portal = side(x, cone->at);
    if (turn < 0) {
        if (m->frames.count == m->frames.capacity) SL_TRY(grow_frames(x));
        m->frames.items[m->frames.count++] =
            (sli_region_frame){portal->next, cone->entry, cone->left};
        if (limits && cone->limited)
            m->frames.items[m->frames.count - 1].entry |= SLI_REGION_LIMITED;
    }
    if (limits && x->limited[cone->at] != SL_NO_SEAM) cone->limited = true;
    if (turn <= 0) cone->left = to_start(x, portal->next);
    if (!cone->within) cone->right = to_start(x, cone->at);
    cone->entry = portal->neighbour;
    return SL_OK;
}

/// Adds what is seen of a side that the view does not pass: from `right` to `left`, or where these
/// are NULL from and to its ends.
static inline sl_status see_side(expansion *x, uint32_t i, const sli_eye_ray *right,
                                 const sli_eye_ray *left) {
    uint32_t neighbour = side(x, i)->neighbour;
    const sli_eye_ray a = to_start(x, i), b = to_start(x, side(x, i)->next);
    if (neighbour < SL_SIDE_WALL)
        neighbour = is_barred(x, i) ? SLI_PIECE_FAR : sli_region_limit(x->outline, i);
    SL_TRY(see_piece(x, neighbour, &a, &b, right, left));
    if (!x->region->memory->mirrors || sl_side_is_portal(side(x, i))) return SL_OK;
    return reflect(x, i, right ? right : &a, left ? left : &b);
}

/// Goes around a room to the next portal within the cone and enters it (*enters), or to the end.
SLI_VISIT sl_status sweep(expansion *x, view_cone *cone, bool *enters, bool limits) {
    const sli_eye_place *eye = &x->region->memory->eye;
    const double limit = x->region->memory->limit;
    *enters = false;
    while (cone->at != cone->entry) {
        const sl_side *at = side(x, cone->at);
        const sl_point end = side(x, at->next)->start;
        const int turn = sli_eye_turn_to(eye, &cone->left, end, sli_eye_offset(eye, end), limit);
        if (sl_side_is_portal(at) && !is_barred(x, cone->at) &&
            !(limits && cone->limited && x->limited[cone->at] != SL_NO_SEAM)) {
            *enters = true;
            return enter(x, cone, turn, limits);
        }
        SL_TRY(see_side(x, cone->at, cone->within ? &cone->right : NULL,
                        turn > 0 ? &cone->left : NULL));
        if (turn >= 0) return SL_OK;
        cone->within = false;
        cone->at = at->next;
    }
    return SL_OK;
}

SLI_VISIT sl_status look_on(expansion *x, view_cone cone, bool limits) {
    struct sli_region_memory *m = x->region->memory;
    const sli_eye_place *eye = &m->eye;
    const size_t floor = m->frames.count;
    uint64_t passed = 0;
    for (bool enters = true;;) {
        if (enters) {
            passed++;
            enters = sli_region_find_first(x->outline, eye, m->limit, cone.entry, &cone.right,
                                           &cone.at, &cone.within);
        }
        if (!enters) {
            if (m->frames.count == floor) break;
            const sli_region_frame *f = &m->frames.items[--m->frames.count];
            cone.entry = f->entry;
            cone.at = f->side;
            cone.left = f->left;
            cone.within = false;
            if (limits) {
                cone.limited = f->entry & SLI_REGION_LIMITED;
                cone.entry &= ~SLI_REGION_LIMITED;
            }
        }
        SL_TRY(sweep(x, &cone, &enters, limits));
    }
    x->region->portals_passed += passed;
    return SL_OK;
}

/// Adds all that a cone sees through its entry, from the room behind the entry on.
static sl_status look_through(expansion *x, view_cone cone) {
    return x->limited ? look_on(x, cone, true) : look_on(x, cone, false);
}

/// Adds what is seen of a side of the fan and behind it: from `right` to `left`, or where these are
/// NULL from and to its ends.
static sl_status see_fan(expansion *x, uint32_t k, const sli_eye_ray *right,
                         const sli_eye_ray *left) {
    const uint32_t i = x->region->memory->fan.items[k];
    const sli_eye_ray a = to_start(x, i), b = to_start(x, side(x, i)->next);
    const sli_eye_place *eye = &x->region->memory->eye;
    if (right && sli_eye_turn(eye, right, &a) == 0) right = NULL;
    if (left && sli_eye_turn(eye, left, &b) == 0) left = NULL;
    if (!sl_side_is_portal(side(x, i)) || is_barred(x, i)) return see_side(x, i, right, left);
    return look_through(x, (view_cone){.entry = side(x, i)->neighbour,
                                       .within = right,
                                       .limited = sli_region_limit(x->outline, i) != SL_NO_SEAM,
                                       .right = right ? *right : a,
                                       .left = left ? *left : b});
}

/// The end of the wall at the eye that lies on the ray through `toward`.
static sl_point wall_end(const expansion *x, uint32_t neighbour, sl_point toward) {
    const sl_wall *wall = &x->outline->space->walls[neighbour - SL_SIDE_WALL];
    const sli_eye_place *eye = &x->region->memory->eye;
    const sli_eye_ray to_a = sli_eye_ray_through(eye, wall->a);
    const sli_eye_ray to_side = sli_eye_ray_through(eye, toward);
    return same_direction(&to_a, &to_side) ? wall->a : wall->b;
}

/// Adds the wall at the eye, seen edge-on: an edge from the eye to the wall's end, or back.
static sl_status see_wall_at_eye(expansion *x, uint32_t neighbour, sl_point from, sl_point to) {
    const sli_eye_place *eye = &x->region->memory->eye;
    const sli_eye_ray a = sli_eye_ray_through(eye, from), b = sli_eye_ray_through(eye, to);
    return see_piece(x, neighbour, &a, &b, NULL, NULL);
}

/// Starts an open fan: from the eye along the wall or border there.
static sl_status start_open(expansion *x) {
    const uint32_t right = x->region->memory->right, neighbour = stop_at(x->outline, right);
    if (neighbour >= SL_SIDE_BORDER)
        return sli_region_add_eye(x->context, x->region, SL_EDGE_BORDER);
    const sl_point end = wall_end(x, neighbour, side(x, side(x, right)->next)->start);
    return see_wall_at_eye(x, neighbour, x->region->view.eye, end);
}

/// Ends an open fan: along the wall or border there to the eye.
static sl_status end_open(expansion *x) {
    const sl_side *left = side(x, x->region->memory->left);
    const uint32_t neighbour = stop_at(x->outline, x->region->memory->left);
    if (neighbour >= SL_SIDE_BORDER) return sli_region_end_at_eye(x->context, x->region);
    const sl_point end = wall_end(x, neighbour, left->start);
    return see_wall_at_eye(x, neighbour, end, x->region->view.eye);
}

static sl_status see_all_round(expansion *x) {
    const struct sli_region_memory *m = x->region->memory;
    if (m->open) SL_TRY(start_open(x));
    for (uint32_t k = 0; k < m->fan.count; k++) SL_TRY(see_fan(x, k, NULL, NULL));
    if (m->open) SL_TRY(end_open(x));
    return SL_OK;
}

uint32_t sli_region_find_side(const sl_outline *o, const sl_region *region, const sli_eye_ray *ray,
                              bool onward) {
    const struct sli_region_memory *m = region->memory;
    const sli_eye_place *eye = &m->eye;
    for (uint32_t k = 0; k < m->fan.count; k++) {
        const sl_side *s = &o->sides[m->fan.items[k]];
        const sli_eye_ray a = sli_eye_ray_through(eye, s->start);
        const sli_eye_ray b = sli_eye_ray_through(eye, o->sides[s->next].start);
        const int from = sli_eye_turn(eye, &a, ray), to = sli_eye_turn(eye, ray, &b);
        if (onward ? from >= 0 && to > 0 : from > 0 && to >= 0) return k;
    }
    return UINT32_MAX;
}

/// A cone that starts beside an open fan: its part of the fan starts where the fan does.
static sl_status see_from_gap(expansion *x, const sli_eye_ray *left, uint32_t stop) {
    const struct sli_region_memory *m = x->region->memory;
    const sl_view *view = &x->region->view;
    const sli_eye_ray start = to_start(x, side(x, m->right)->next);
    if (stop == UINT32_MAX) {
        const bool touches =
            sli_eye_turn(&m->eye, &start, left) == 0 && same_direction(&start, left);
        return sli_view_holds(view, start.at) && !touches ? see_all_round(x) : SL_OK;
    }
    SL_TRY(start_open(x));
    for (uint32_t k = 0; k < stop; k++) SL_TRY(see_fan(x, k, NULL, NULL));
    return see_fan(x, stop, NULL, left);
}

static sl_status see_cone(expansion *x) {
    const struct sli_region_memory *m = x->region->memory;
    const sl_view *view = &x->region->view;
    const sli_eye_ray right = sli_eye_ray_through(&m->eye, view->right);
    const sli_eye_ray left = sli_eye_ray_through(&m->eye, view->left);
    const uint32_t start = sli_region_find_side(x->outline, x->region, &right, true);
    const uint32_t stop = sli_region_find_side(x->outline, x->region, &left, false);
    if (start == UINT32_MAX) return see_from_gap(x, &left, stop);
    SL_TRY(sli_region_add_eye(x->context, x->region, SL_EDGE_CONE));
    if (start == stop && sli_eye_turn(&m->eye, &right, &left) > 0)
        return see_fan(x, start, &right, &left);
    SL_TRY(see_fan(x, start, &right, NULL));
    const bool wraps = stop <= start;
    for (uint32_t k = start + 1; k < m->fan.count && (wraps || k < stop); k++)
        SL_TRY(see_fan(x, k, NULL, NULL));
    if (stop != UINT32_MAX && !wraps) return see_fan(x, stop, NULL, &left);
    if (m->open) SL_TRY(end_open(x));
    if (stop == UINT32_MAX) return SL_OK;
    if (m->open) SL_TRY(start_open(x));
    for (uint32_t k = 0; k < stop; k++) SL_TRY(see_fan(x, k, NULL, NULL));
    return see_fan(x, stop, NULL, &left);
}

static bool is_one_ray(const sl_view *cone) {
    const sli_eye_place eye = sli_eye_place_at(cone->eye);
    const sli_eye_ray right = sli_eye_ray_through(&eye, cone->right);
    const sli_eye_ray left = sli_eye_ray_through(&eye, cone->left);
    return sli_eye_turn(&eye, &right, &left) == 0 && same_direction(&right, &left);
}

static bool usable(sl_point eye, sl_point border) {
    return isfinite(border.x) && isfinite(border.y) && (border.x != eye.x || border.y != eye.y);
}

sl_status sli_region_check_view(sl_context *context, const sl_view *view, double range) {
    if (!(range >= 0 && isfinite(range)))
        return sl_fail(context, SL_BAD_ARGUMENT, "range %g: must be finite and not negative",
                       range);
    if (!view->full && (!usable(view->eye, view->left) || !usable(view->eye, view->right)))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the borders of the view cone must be points other than the eye");
    return SL_OK;
}

sl_status sli_region_spread(sl_context *context, const sl_outline *outline, sl_region *region) {
    expansion x = {context, outline, region, outline->limited};
    if (region->cell == SL_NO_CELL) return SL_OK;
    if (!region->view.full && is_one_ray(&region->view)) return SL_OK;
    SL_TRY(sli_region_gather_fan(context, outline, region));
    SL_TRY(region->view.full ? see_all_round(&x) : see_cone(&x));
    SL_TRY(sli_region_close(context, region));
    return region->range > 0 ? sli_region_cut_range(context, region) : SL_OK;
}

sl_status sli_region_look_in(sl_context *context, const sl_outline *outline, sl_region *region,
                             const sli_reflected_view *reflected) {
    expansion x = {context, outline, region, outline->limited};
    const sl_side *entry = side(&x, reflected->side);
    const sli_eye_ray right_end = to_start(&x, entry->next);
    const bool within = sli_eye_turn(&region->memory->eye, &reflected->right, &right_end) < 0;
    return look_through(&x, (view_cone){.entry = reflected->side,
                                        .within = within,
                                        .right = reflected->right,
                                        .left = reflected->left});
}

sl_status sli_region_start(sl_context *context, const sl_outline *outline, const sl_view *view,
                           double range, sl_region *region) {
    region->count = 0;
    region->portals_passed = 0;
    region->cell = SL_NO_CELL;
    if (!region->memory) {
        region->memory = sl_alloc_array(context, 1, sizeof *region->memory);
        if (!region->memory) return SL_NO_MEMORY;
    }
    struct sli_region_memory *m = region->memory;
    m->pending = false;
    m->first = SLI_PIECE_FAR;
    m->frames.count = m->reflected_views.count = m->envelope.count = 0;
    m->mirrors = NULL;
    m->eye = sli_eye_place_at(view->eye);
    m->limit = sli_eye_limit(outline->space, view);
    region->view = *view;
    region->range = range;
    return SL_OK;
}

sl_status sli_region_make(sl_context *context, const sl_outline *outline, const sl_view *view,
                          double range, sl_region *region) {
    return sli_region_make_past(context, outline, NULL, 0, view, range, region);
}

sl_status sli_region_make_past(sl_context *context, const sl_outline *outline,
                               const sl_moving_box *boxes, size_t count, const sl_view *view,
                               double range, sl_region *region) {
    const bool many = SLI_BOXES && count > SLI_FEW_BOXES;
    sl_box reach = outline->space->bounds;
    if (many) {
        SL_TRY(sli_region_make(context, outline, view, range, region));
        if (!region->count) return SL_OK;
        reach = sli_region_reach(region, &reach);
    }
    region->count = 0;
    SL_TRY(sli_region_check_view(context, view, range));
    SL_TRY(sli_region_start(context, outline, view, range, region));
    if (SLI_BOXES && count)
        SL_TRY(sli_box_envelope_make(context, boxes, count, &region->memory->eye,
                                     many ? &reach : NULL, &region->memory->envelope));
    region->cell = sli_eye_cell(outline->space, view->eye);
    const sl_status status = sli_region_spread(context, outline, region);
    if (status != SL_OK) region->count = 0;
    return status;
}

void sli_region_settle(sl_context *context, sl_region *region) {
    if (region->memory) {
        sl_free(context, region->memory->frames.items);
        sl_free(context, region->memory->fan.items);
        sl_free(context, region->memory->whole.items);
        sl_free(context, region->memory->reflected_views.items);
        sl_free(context, region->memory->envelope.arcs.items);
    }
    sl_free(context, region->memory);
    region->memory = NULL;
}

void sl_region_destroy(sl_context *context, sl_region *region) {
    sl_free(context, region->points);
    sl_free(context, region->offsets);
    sl_free(context, region->edges);
    sli_region_settle(context, region);
    *region = (sl_region){0};
}
