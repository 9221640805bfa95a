/// Beams of sight, walked from room to room.
///
///      +-----+-------.-+
///      |     b   . '   |    A beam from the eye meets the sides of a room one after the other.
///      | eye * - - - - |    At each side, it becomes the part between the side's ends. Through
///      |     a   ' .   |    a portal this part goes on as a beam of the room behind.
///      +-----+-------'-+
///
/// Invariant: rooms are convex and beams are narrower than half a turn. Beams that start at one eye
/// do not overlap, so a walk meets each direction once.
#include "analysis/set_sight/beams.h"

#include "geometry/orient.h"
#include "sightline/region.h"

#include <stdlib.h>

// --- rooms

typedef struct start {
    sl_point at;
    uint32_t side;
} start;

static int compare_starts(const void *left, const void *right) {
    const start *a = left, *b = right;
    const int order = sli_compare_points(a->at, b->at);
    return order ? order : a->side < b->side ? -1 : 1;
}

static sl_status sort_starts(sl_context *context, sli_beam_rooms *r) {
    const sl_outline *o = r->outline;
    start *starts = sl_alloc_array(context, (size_t)o->side_count + 1, sizeof *starts);
    if (!starts) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < o->side_count; i++) starts[i] = (start){o->sides[i].start, i};
    qsort(starts, o->side_count, sizeof *starts, compare_starts);
    for (uint32_t i = 0; i < o->side_count; i++) r->by_start[i] = starts[i].side;
    sl_free(context, starts);
    return SL_OK;
}

sl_status sli_beam_rooms_make(sl_context *context, const sl_outline *outline, sli_beam_rooms *out) {
    const size_t sides = (size_t)outline->side_count + 1;
    const sl_space *space = outline->space;
    *out = (sli_beam_rooms){.outline = outline};
    out->before = sl_alloc_array(context, sides, sizeof *out->before);
    out->room_of = sl_alloc_array(context, sides, sizeof *out->room_of);
    out->by_start = sl_alloc_array(context, sides, sizeof *out->by_start);
    out->solid = sl_alloc_array(context, (size_t)outline->room_count + 1, sizeof *out->solid);
    sl_status status =
        out->before && out->room_of && out->by_start && out->solid ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = sort_starts(context, out);
    if (status != SL_OK) {
        sli_beam_rooms_destroy(context, out);
        return status;
    }
    for (uint32_t i = 0; i < outline->side_count; i++) out->before[outline->sides[i].next] = i;
    for (uint32_t room = 0; room < outline->room_count; room++)
        for (uint32_t i = outline->first[room]; i < outline->first[room + 1]; i++)
            out->room_of[i] = room;
    for (uint32_t c = 0; c < space->cell_count; c++)
        for (uint32_t i = outline->first_part[c]; i < outline->first_part[c + 1]; i++)
            if (space->cells[c].solid) out->solid[outline->parts[i]] = true;
    return SL_OK;
}

void sli_beam_rooms_destroy(sl_context *context, sli_beam_rooms *rooms) {
    sl_free(context, rooms->before);
    sl_free(context, rooms->room_of);
    sl_free(context, rooms->by_start);
    sl_free(context, rooms->solid);
    *rooms = (sli_beam_rooms){0};
}

uint32_t sli_side_across(const sli_beam_rooms *rooms, uint32_t side) {
    const sl_outline *o = rooms->outline;
    const sl_side *s = &o->sides[side];
    if (sl_side_is_portal(s)) return s->neighbour;
    return sl_side_is_dark(o, s) ? o->lit[s->neighbour - SL_SIDE_WALL - o->first_dark] : SL_NO_WALL;
}

bool sli_side_passes(const sli_beam_rooms *rooms, uint32_t side, bool backwards) {
    if (!backwards) return sl_side_is_portal(sli_side(rooms, side));
    const uint32_t across = sli_side_across(rooms, side);
    return across != SL_NO_WALL && sl_side_is_portal(sli_side(rooms, across));
}

// --- beams

int sli_ray_turn(sl_point eye, const sli_ray *from, const sli_ray *to) {
    const int turn = sli_orient(eye, from->through, to->through);
    return from->away == to->away ? turn : -turn;
}

/// Whether a ray is in a beam, at its right border but not at its left one.
static bool starts_in(sl_point eye, const sli_beam *beam, const sli_ray *ray) {
    return sli_ray_turn(eye, &beam->right, ray) >= 0 && sli_ray_turn(eye, ray, &beam->left) > 0;
}

/// What two beams share, if that is more than a ray.
static bool clip_beam(sl_point eye, const sli_beam *a, const sli_beam *b, sli_beam *out) {
    sli_ray right;
    if (starts_in(eye, a, &b->right))
        right = b->right;
    else if (starts_in(eye, b, &a->right))
        right = a->right;
    else
        return false;
    const sli_ray left = sli_ray_turn(eye, &a->left, &b->left) > 0 ? a->left : b->left;
    *out = (sli_beam){right, left};
    return true;
}

// --- walks

/// Looks at one side of a room: within `within`, or whole. Enters what is behind it.
static sl_status look(sli_walk *w, uint32_t side, const sli_beam *within) {
    const sl_point a = sli_side(w->rooms, side)->start, b = sli_side_end(w->rooms, side);
    w->sides++;
    if (sli_orient(a, b, w->eye) <= 0) return SL_OK;
    sli_beam beam = {{a, false}, {b, false}};
    const sli_beam whole = beam;
    if (within && !clip_beam(w->eye, within, &whole, &beam)) return SL_OK;
    const bool passes = sli_side_passes(w->rooms, side, w->backwards);
    bool enter = passes;
    SL_TRY(w->at_side(w, side, &beam, &enter));
    if (!passes || !enter) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(w->context, &w->frames, 1));
    const uint32_t entry = sli_side_across(w->rooms, side);
    w->frames.items[w->frames.count++] =
        (sli_walk_frame){entry, sli_side(w->rooms, entry)->next, beam};
    return SL_OK;
}

sl_status sli_walk_from(sli_walk *walk, uint32_t first, const sli_beam *within) {
    uint32_t side = first;
    do {
        walk->frames.count = 0;
        SL_TRY(look(walk, side, within));
        while (walk->frames.count) {
            sli_walk_frame *top = &walk->frames.items[walk->frames.count - 1];
            if (top->at == top->entry) {
                walk->frames.count--;
                continue;
            }
            const uint32_t at = top->at;
            const sli_beam beam = top->beam;
            top->at = sli_side(walk->rooms, at)->next;
            SL_TRY(look(walk, at, &beam));
        }
        side = sli_side(walk->rooms, side)->next;
    } while (side != first);
    return SL_OK;
}
