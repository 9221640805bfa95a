/// Cones of sight behind the ends of walls.
///
///            p ----------- p'    a segment, and an end u of the wall ub
///              .         .
///                .     .         Rays from the segment that graze u sweep the cone behind it. Its
///                  . .           borders are the rays from the ends of what u sees of the segment.
///         b --------u
///                 .   .          On one side of the ray the wall is in the way, on the other not:
///               .  cone .        so in the cone, sight of p ends or begins at the ray.
///
/// A ray that has walls at u on both sides is stopped, and one that has none changes nothing. What
/// holds turns where the ray gets in line with a wall at u. So a cone is cut there. One-way glass
/// is a wall for the rays that it stops.
#include "analysis/set_sight/set_sight.h"

#include "geometry/crossing.h"
#include "geometry/length.h"
#include "geometry/orient.h"

// --- around a place

static sl_status add_block(sl_context *context, sli_spot *spot, sl_point along, bool from_left) {
    SL_TRY(SL_ARRAY_ROOM(context, &spot->blocks, 1));
    spot->blocks.items[spot->blocks.count++] = (sli_block){along, from_left};
    return SL_OK;
}

static sl_status add_room(sl_context *context, sli_spot *spot, uint32_t side) {
    SL_TRY(SL_ARRAY_ROOM(context, &spot->rooms, 1));
    spot->rooms.items[spot->rooms.count++] = side;
    return SL_OK;
}

static void clear_spot(sli_spot *spot, sl_point at) {
    spot->at = at;
    spot->rooms.count = spot->blocks.count = 0;
}

/// The room of a side that starts at the spot.
static sl_status add_corner(sl_context *context, const sli_beam_rooms *rooms, uint32_t side,
                            sli_spot *spot) {
    const uint32_t before = rooms->before[side];
    if (!sli_side_passes(rooms, side, false))
        SL_TRY(add_block(context, spot, sli_side_end(rooms, side), true));
    if (!sli_side_passes(rooms, before, false))
        SL_TRY(add_block(context, spot, sli_side(rooms, before)->start, false));
    return rooms->solid[rooms->room_of[side]] ? SL_OK : add_room(context, spot, side);
}

/// Finds what is around a corner of rooms, by_start[first ...], `count` of them.
static sl_status spot_of_corner(sl_context *context, struct sl_set_sight *s, uint32_t first,
                                uint32_t count, sli_spot *out) {
    clear_spot(out, sli_side(&s->rooms, s->rooms.by_start[first])->start);
    for (uint32_t i = 0; i < count; i++)
        SL_TRY(add_corner(context, &s->rooms, s->rooms.by_start[first + i], out));
    return SL_OK;
}

/// Adds a room if the spot is in it or on its border.
static sl_status add_touched(sl_context *context, const sli_beam_rooms *rooms, uint32_t room,
                             sli_spot *spot) {
    const sl_outline *o = rooms->outline;
    uint32_t on = SL_NO_WALL;
    for (uint32_t i = o->first[room]; i < o->first[room + 1]; i++) {
        const sl_point a = sli_side(rooms, i)->start, b = sli_side_end(rooms, i);
        if (sli_same_point(a, spot->at)) return add_corner(context, rooms, i, spot);
        const int turn = sli_orient(a, b, spot->at);
        if (turn < 0) return SL_OK;
        const sl_box box = {{sli_lesser(a.x, b.x), sli_lesser(a.y, b.y)},
                            {sli_greater(a.x, b.x), sli_greater(a.y, b.y)}};
        if (turn == 0 && !sli_same_point(b, spot->at) && sli_box_holds(&box, spot->at)) on = i;
    }
    if (rooms->solid[room]) return SL_OK;
    if (on != SL_NO_WALL && !sli_side_passes(rooms, on, false)) {
        SL_TRY(add_block(context, spot, sli_side_end(rooms, on), true));
        SL_TRY(add_block(context, spot, sli_side(rooms, on)->start, false));
    }
    return add_room(context, spot, on == SL_NO_WALL ? o->first[room] : on);
}

static bool has_room(const sli_beam_rooms *rooms, const sli_spot *spot, uint32_t room) {
    for (size_t i = 0; i < spot->rooms.count; i++)
        if (rooms->room_of[spot->rooms.items[i]] == room) return true;
    return false;
}

/// Finds the room of a place that is in it, not on its border: it has no other. Fast.
static bool is_within(const sli_beam_rooms *rooms, sl_point at, uint32_t *room) {
    const sl_outline *o = rooms->outline;
    const uint32_t cell = sl_space_locate(o->space, at);
    if (cell == SL_NO_CELL) return false;
    *room = sl_outline_room(o, cell, at);
    for (uint32_t i = o->first[*room]; i < o->first[*room + 1]; i++)
        if (sli_orient(sli_side(rooms, i)->start, sli_side_end(rooms, i), at) <= 0) return false;
    return true;
}

sl_status sli_spot_find(sl_context *context, struct sl_set_sight *s, sl_point at, sli_spot *out) {
    const sl_outline *o = s->rooms.outline;
    const size_t words = sl_eye_words(o->space);
    uint32_t room;
    clear_spot(out, at);
    if (is_within(&s->rooms, at, &room))
        return s->rooms.solid[room] ? SL_OK : add_room(context, out, o->first[room]);
    for (size_t i = 0; i < words; i++) s->touched[i] = 0;
    sl_cells_of_box(o->space, (sl_box){at, at}, s->touched);
    for (size_t word = 0; word < words; word++)
        for (uint32_t bit = 0; s->touched[word] && bit < 64; bit++) {
            if (!(s->touched[word] >> bit & 1)) continue;
            const size_t cell = 64 * word + bit;
            for (uint32_t i = o->first_part[cell]; i < o->first_part[cell + 1]; i++)
                if (!has_room(&s->rooms, out, o->parts[i]))
                    SL_TRY(add_touched(context, &s->rooms, o->parts[i], out));
        }
    return SL_OK;
}

// --- what is seen of a segment

typedef struct reach {
    struct sl_set_sight *sight;
    sl_segment segment;
    int eye_side;
    bool reached, near, stopped; ///< near: some that is reached is in range
} reach;

/// Where a ray from the eye meets a side: 1 beyond the line of the segment, 0 on it, -1 before it.
static int compare_on_ray(const reach *r, sl_point eye, const sli_ray *ray, sl_point a,
                          sl_point b) {
    const sl_point from = r->segment.a, to = r->segment.b;
    if (sli_orient(eye, ray->through, a) == 0) return -r->eye_side * sli_orient(from, to, a);
    if (sli_orient(eye, ray->through, b) == 0) return -r->eye_side * sli_orient(from, to, b);
    return -r->eye_side *
           sli_crossing_side(from, to, (sl_segment){a, b}, (sl_segment){eye, ray->through});
}

/// Takes a piece of the segment, if some of it is in range.
static sl_status add_seen(sl_context *context, reach *r, sl_point eye, const sli_beam *beam) {
    struct sl_set_sight *s = r->sight;
    const sl_segment turned = {r->segment.b, r->segment.a};
    r->reached = true;
    if (!sli_is_in_range(s, eye, beam, r->eye_side > 0 ? r->segment : turned)) return SL_OK;
    r->near = true;
    sli_beam *last = s->seen.count ? &s->seen.items[s->seen.count - 1] : NULL;
    if (last && sli_ray_turn(eye, &last->left, &beam->right) == 0) {
        last->left = beam->left;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &s->seen, 1));
    s->seen.items[s->seen.count++] = *beam;
    return SL_OK;
}

/// A wall crosses the segment: the part of the beam on one side of the crossing reaches it.
static sl_status add_part_seen(sli_walk *w, reach *r, const sl_segment *side, const sli_beam *beam,
                               bool right) {
    const sli_ray middle = {sli_crossing(*side, r->segment), false};
    sli_beam part = *beam;
    if (right)
        part.left = middle;
    else
        part.right = middle;
    r->reached = r->stopped = true;
    if (sli_same_point(middle.through, w->eye) ||
        sli_ray_turn(w->eye, &part.right, &part.left) <= 0 ||
        sli_ray_turn(w->eye, &beam->right, &part.right) < 0 ||
        sli_ray_turn(w->eye, &part.left, &beam->left) < 0)
        return SL_OK; // thinner than rounding
    return add_seen(w->context, r, w->eye, &part);
}

static sl_status reach_side(sli_walk *w, uint32_t side, const sli_beam *beam, bool *enter) {
    reach *r = w->data;
    const sl_segment at = {sli_side(w->rooms, side)->start, sli_side_end(w->rooms, side)};
    const int right = compare_on_ray(r, w->eye, &beam->right, at.a, at.b);
    const int left = compare_on_ray(r, w->eye, &beam->left, at.a, at.b);
    if (right >= 0 && left >= 0) {
        *enter = false;
        return add_seen(w->context, r, w->eye, beam);
    }
    if (*enter) {
        *enter = sli_is_in_range(r->sight, w->eye, beam, at);
        return SL_OK;
    }
    if (right <= 0 && left <= 0) {
        r->stopped = true;
        return SL_OK;
    }
    return add_part_seen(w, r, &at, beam, right > 0);
}

sl_status sli_reach(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                    sl_segment segment, bool *some, bool *whole) {
    reach r = {s, segment, sli_orient(segment.a, segment.b, spot->at), false, false, false};
    const sli_ray a = {segment.a, false}, b = {segment.b, false};
    const sli_beam triangle = r.eye_side > 0 ? (sli_beam){a, b} : (sli_beam){b, a};
    sli_walk *w = &s->walk;
    w->context = context;
    w->rooms = &s->rooms;
    w->at_side = reach_side;
    w->data = &r;
    w->backwards = true;
    w->eye = spot->at;
    s->seen.count = 0;
    for (size_t i = 0; i < spot->rooms.count; i++)
        SL_TRY(sli_walk_from(w, spot->rooms.items[i], &triangle));
    *some = r.near;
    *whole = r.reached && !r.stopped;
    return SL_OK;
}

// --- parts of a region

sl_status sli_parts_close(sl_context *context, sli_parts *parts) {
    if (parts->points.count < parts->open + 3) {
        parts->points.count = parts->open;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &parts->ends, 1));
    parts->ends.items[parts->ends.count++] = parts->points.count;
    parts->open = parts->points.count;
    return SL_OK;
}

void sli_parts_destroy(sl_context *context, sli_parts *parts) {
    sl_free(context, parts->points.items);
    sl_free(context, parts->ends.items);
    *parts = (sli_parts){0};
}

static sl_status add_point(sl_context *context, sli_parts *parts, sl_point p) {
    const size_t count = parts->points.count;
    if (count > parts->open && sli_same_point(parts->points.items[count - 1], p)) return SL_OK;
    if (count >= SL_SET_REGION_CORNERS)
        return sl_fail(context, SL_UNSUPPORTED,
                       "the region of the set has more than %d corners before its parts are joined",
                       SL_SET_REGION_CORNERS);
    SL_TRY(SL_ARRAY_ROOM(context, &parts->points, 1));
    parts->points.items[parts->points.count++] = p;
    return SL_OK;
}

static int sign(double value) {
    return (value > 0) - (value < 0);
}

static bool same_ray(sl_point eye, const sli_ray *a, const sli_ray *b) {
    const int turn = a->away == b->away ? 1 : -1;
    const sl_point p = a->through, q = b->through;
    return sli_ray_turn(eye, a, b) == 0 && sign(p.x - eye.x) == turn * sign(q.x - eye.x) &&
           sign(p.y - eye.y) == turn * sign(q.y - eye.y);
}

/// Where a ray meets a side, rounded if it is not at an end.
static sl_point meet(sl_point eye, const sli_ray *ray, sl_point a, sl_point b) {
    if (sli_orient(eye, ray->through, a) == 0) return a;
    if (sli_orient(eye, ray->through, b) == 0) return b;
    return sli_crossing((sl_segment){eye, ray->through}, (sl_segment){a, b});
}

/// How far a point is beyond a chord, times the chord's length. Rounded.
static double beyond(const sl_segment *chord, sl_point p) {
    const sl_point way = {chord->b.x - chord->a.x, chord->b.y - chord->a.y};
    return sli_cross((sl_point){p.x - chord->a.x, p.y - chord->a.y}, way);
}

/// Where a ray meets a chord, never off it: a chord may lie nearly along a ray.
static sl_point meet_chord(sl_point eye, const sli_ray *ray, const sl_segment *chord) {
    const sl_point way = {ray->through.x - eye.x, ray->through.y - eye.y};
    const double a = sli_cross(way, (sl_point){chord->a.x - eye.x, chord->a.y - eye.y}),
                 b = sli_cross(way, (sl_point){chord->b.x - eye.x, chord->b.y - eye.y});
    const double share = a / (a - b);
    if (!(share > 0)) return chord->a;
    if (share >= 1) return chord->b;
    return (sl_point){chord->a.x + share * (chord->b.x - chord->a.x),
                      chord->a.y + share * (chord->b.y - chord->a.y)};
}

/// Adds what a beam sees of a side, or the part of the chord before it.
static sl_status add_met(sli_walk *w, sli_parts *parts, const sli_beam *beam, sl_point right,
                         sl_point left) {
    const sl_segment *chord = parts->chord;
    const double far_right = chord ? beyond(chord, right) : 0,
                 far_left = chord ? beyond(chord, left) : 0;
    SL_TRY(add_point(w->context, parts,
                     far_right > 0 ? meet_chord(w->eye, &beam->right, chord) : right));
    if ((far_right > 0) != (far_left > 0)) {
        const double share = far_right / (far_right - far_left);
        const sl_point middle = {right.x + share * (left.x - right.x),
                                 right.y + share * (left.y - right.y)};
        SL_TRY(add_point(w->context, parts, middle));
    }
    return add_point(w->context, parts,
                     far_left > 0 ? meet_chord(w->eye, &beam->left, chord) : left);
}

static sl_status add_side(sli_walk *w, uint32_t side, const sli_beam *beam, bool *enter) {
    sli_parts *parts = w->data;
    const sl_point a = sli_side(w->rooms, side)->start, b = sli_side_end(w->rooms, side);
    if (*enter && !parts->chord) return SL_OK;
    const sl_point right = meet(w->eye, &beam->right, a, b), left = meet(w->eye, &beam->left, a, b);
    if (*enter && !(beyond(parts->chord, right) > 0 && beyond(parts->chord, left) > 0))
        return SL_OK;
    *enter = false;
    const bool goes_on = parts->points.count > parts->open &&
                         sli_same_point(parts->points.items[parts->open], w->eye) &&
                         same_ray(w->eye, &parts->last, &beam->right);
    if (!goes_on) {
        SL_TRY(sli_parts_close(w->context, parts));
        SL_TRY(add_point(w->context, parts, w->eye));
    }
    parts->last = beam->left;
    return add_met(w, parts, beam, right, left);
}

/// A walk from a spot that adds what it sees to parts.
static sli_walk *begin_walk(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                            sli_parts *parts) {
    sli_walk *w = &s->walk;
    w->context = context;
    w->rooms = &s->rooms;
    w->at_side = add_side;
    w->data = parts;
    w->backwards = false;
    w->eye = spot->at;
    return w;
}

sl_status sli_add_beam(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                       const sli_beam *beam, const sl_segment *chord, sli_parts *parts) {
    sli_walk *w = begin_walk(context, s, spot, parts);
    sl_status status = SL_OK;
    parts->chord = chord;
    for (size_t i = 0; i < spot->rooms.count && status == SL_OK; i++)
        status = sli_walk_from(w, spot->rooms.items[i], beam);
    parts->chord = NULL;
    return status;
}

// --- beams cut at the walls of a spot

static sl_status add_cut(sl_context *context, struct sl_set_sight *s, sl_point eye,
                         const sli_beam *beam, sli_ray ray) {
    if (sli_ray_turn(eye, &beam->right, &ray) <= 0 || sli_ray_turn(eye, &ray, &beam->left) <= 0)
        return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &s->cuts, 1));
    size_t i = s->cuts.count++;
    for (; i > 1 && sli_ray_turn(eye, &ray, &s->cuts.items[i - 1]) > 0; i--)
        s->cuts.items[i] = s->cuts.items[i - 1];
    s->cuts.items[i] = ray;
    return SL_OK;
}

/// Cuts a beam at the lines of the walls there, and at the line to `towards`: s->cuts has the
/// borders of the pieces, from the right to the left.
static sl_status cut_beam(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                          const sl_point *towards, const sli_beam *beam) {
    s->cuts.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &s->cuts, 1));
    s->cuts.items[s->cuts.count++] = beam->right;
    for (size_t i = 0; i < spot->blocks.count + (towards != NULL); i++) {
        const sl_point at = i < spot->blocks.count ? spot->blocks.items[i].along : *towards;
        SL_TRY(add_cut(context, s, spot->at, beam, (sli_ray){at, false}));
        SL_TRY(add_cut(context, s, spot->at, beam, (sli_ray){at, true}));
    }
    SL_TRY(SL_ARRAY_ROOM(context, &s->cuts, 1));
    s->cuts.items[s->cuts.count++] = beam->left;
    return SL_OK;
}

/// The side of all rays of a beam on which a point lies: 1 left, -1 right. The beam is cut there.
static int side_of_beam(sl_point eye, const sli_beam *beam, sl_point point) {
    const sli_ray ray = {point, false};
    const int sum = sli_ray_turn(eye, &beam->right, &ray) + sli_ray_turn(eye, &beam->left, &ray);
    return (sum > 0) - (sum < 0);
}

/// Whether rays that come to the spot and go on in a beam are stopped just beside it on exactly one
/// side.
static bool grazes(const sli_spot *spot, const sli_beam *beam) {
    bool left = false, right = false;
    for (size_t i = 0; i < spot->blocks.count; i++) {
        const sli_block *b = &spot->blocks.items[i];
        const int side = side_of_beam(spot->at, beam, b->along);
        left |= side > 0 && b->from_left;
        right |= side < 0 && !b->from_left;
    }
    return left != right;
}

/// The cones of a spot from what it sees of a segment, at s->seen.items[k].
static sl_status add_cones_of(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                              sl_segment segment, sli_parts *parts) {
    for (size_t k = 0; k < s->seen.count; k++) {
        sli_beam behind = s->seen.items[k];
        behind.right.away = !behind.right.away;
        behind.left.away = !behind.left.away;
        SL_TRY(cut_beam(context, s, spot, NULL, &behind));
        for (size_t i = 1; i < s->cuts.count; i++) {
            const sli_beam cone = {s->cuts.items[i - 1], s->cuts.items[i]};
            if (sli_ray_turn(spot->at, &cone.right, &cone.left) <= 0 || !grazes(spot, &cone))
                continue;
            parts->cones++;
            SL_TRY(s->within > 0 ? sli_add_cone_in_range(context, s, spot, segment, &cone, parts)
                                 : sli_add_beam(context, s, spot, &cone, NULL, parts));
        }
    }
    return SL_OK;
}

sl_status sli_add_cones(sl_context *context, struct sl_set_sight *s, sl_segment segment,
                        sli_parts *parts) {
    const uint32_t sides = s->rooms.outline->side_count;
    uint32_t first = 0;
    while (first < sides) {
        const sl_point at = sli_side(&s->rooms, s->rooms.by_start[first])->start;
        uint32_t count = 1;
        while (first + count < sides &&
               sli_same_point(sli_side(&s->rooms, s->rooms.by_start[first + count])->start, at))
            count++;
        if (first % 64 < count) SL_TRY(sl_check_cancelled(context));
        SL_TRY(spot_of_corner(context, s, first, count, &s->corner));
        first += count;
        if (!s->corner.blocks.count || sli_orient(segment.a, segment.b, at) == 0) continue;
        bool some, whole;
        SL_TRY(sli_reach(context, s, &s->corner, segment, &some, &whole));
        SL_TRY(add_cones_of(context, s, &s->corner, segment, parts));
    }
    return sli_parts_close(context, parts);
}

// --- what one eye sees

/// Whether an eye next to the spot, on the way to a point, sees past the walls at the spot into a
/// beam, which is cut there.
static bool sees_beside(const sli_spot *spot, sl_point towards, const sli_beam *beam) {
    const int side = -side_of_beam(spot->at, beam, towards); // of the beam, from the way
    for (size_t i = 0; i < spot->blocks.count; i++) {
        const sli_block *b = &spot->blocks.items[i];
        if (sli_orient(spot->at, towards, b->along) == side && b->from_left == (side < 0) &&
            -side_of_beam(spot->at, beam, b->along) == side)
            return false;
    }
    return true;
}

static sl_status add_room_beams(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                                uint32_t first, sl_point towards) {
    uint32_t side = first;
    do {
        const sl_point a = sli_side(&s->rooms, side)->start, b = sli_side_end(&s->rooms, side);
        const sli_beam whole = {{a, false}, {b, false}};
        side = sli_side(&s->rooms, side)->next;
        if (sli_orient(a, b, spot->at) <= 0) continue;
        SL_TRY(cut_beam(context, s, spot, &towards, &whole));
        for (size_t i = 1; i < s->cuts.count; i++) {
            const sli_beam beam = {s->cuts.items[i - 1], s->cuts.items[i]};
            if (sli_ray_turn(spot->at, &beam.right, &beam.left) <= 0 ||
                !sees_beside(spot, towards, &beam))
                continue;
            SL_TRY(sli_walk_from(&s->walk, first, &beam));
        }
    } while (side != first);
    return SL_OK;
}

sl_status sli_add_eye(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                      const sl_point *towards, sli_parts *parts) {
    if (!towards)
        SL_TRY(s->within > 0 ? sli_add_eye_in_range(context, s, spot, parts)
                             : sli_add_beam(context, s, spot, NULL, NULL, parts));
    else {
        begin_walk(context, s, spot, parts);
        for (size_t i = 0; i < spot->rooms.count; i++)
            SL_TRY(add_room_beams(context, s, spot, spot->rooms.items[i], *towards));
    }
    return sli_parts_close(context, parts);
}
