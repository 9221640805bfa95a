/// Following a wall's line through the faces that the wall stands in, and what is met on the way:
/// ends of walls, sides, corners. Nothing is changed, and no coordinate computed.
#include "space/bsp.h"

#include <stdlib.h>
#include <string.h>

static int compare_along(const void *left, const void *right) {
    const sl_bsp_along *a = left, *b = right;
    return (a->key > b->key) - (a->key < b->key);
}

/// The wall's ends in the line's order.
static void ends_along(const sl_bsp *bsp, uint32_t wall, sl_point *low, sl_point *high) {
    const sl_wall *w = &bsp->walls[wall];
    const bool forward = sl_bsp_key(bsp, w->a) < sl_bsp_key(bsp, w->b);
    *low = forward ? w->a : w->b;
    *high = forward ? w->b : w->a;
}

static sl_status add_end(sl_bsp *bsp, const sl_bsp_face *face, sl_point end) {
    if (!sl_bsp_holds(&face->sides, end)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->along, 1));
    bsp->along.items[bsp->along.count++] = (sl_bsp_along){sl_bsp_key(bsp, end), end};
    return SL_OK;
}

static sl_status add_wall(sl_bsp *bsp, const sl_bsp_face *face, uint32_t wall) {
    const sl_wall *w = &bsp->walls[wall];
    const bool a = sl_orient(bsp->a, bsp->b, w->a) == 0, b = sl_orient(bsp->a, bsp->b, w->b) == 0;
    if (a) SL_TRY(add_end(bsp, face, w->a));
    if (b) SL_TRY(add_end(bsp, face, w->b));
    if (!a || !b) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->on_line, 1));
    bsp->on_line.items[bsp->on_line.count++] = wall;
    return SL_OK;
}

/// The walls on the line, and all ends of walls on it inside the face. `through` comes in from the
/// face before, and may be unknown here where rounding lets it in.
static sl_status gather(sl_bsp *bsp, const sl_bsp_face *face, uint32_t through) {
    bsp->on_line.count = bsp->along.count = 0;
    for (size_t i = 0; i < face->walls.count; i++) {
        if (face->walls.items[i] == through) through = SL_BEYOND_EXIT;
        SL_TRY(add_wall(bsp, face, face->walls.items[i]));
    }
    if (through != SL_BEYOND_EXIT) SL_TRY(add_wall(bsp, face, through));
    if (bsp->along.count)
        qsort(bsp->along.items, bsp->along.count, sizeof *bsp->along.items, compare_along);
    return SL_OK;
}

/// A wall on the line over all from one key to another.
static uint32_t covering(const sl_bsp *bsp, double from, double to) {
    for (size_t i = 0; i < bsp->on_line.count; i++) {
        sl_point low, high;
        ends_along(bsp, bsp->on_line.items[i], &low, &high);
        if (sl_bsp_key(bsp, low) <= from && sl_bsp_key(bsp, high) >= to)
            return bsp->on_line.items[i];
    }
    return SL_BEYOND_EXIT;
}

static sl_status make_stops(sl_bsp *bsp, sl_bsp_passage *passage) {
    passage->first_stop = bsp->stops.count;
    // One more, so that there is an array to point into where no stop is.
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->stops, bsp->along.count + 1));
    for (size_t i = 0; i < bsp->along.count; i++) {
        if (i && bsp->along.items[i].key == bsp->along.items[i - 1].key) continue;
        bsp->stops.items[bsp->stops.count++] =
            (sl_bsp_stop){.at = bsp->along.items[i].at, .wall = SL_BEYOND_EXIT};
    }
    passage->stop_count = bsp->stops.count - passage->first_stop;
    sl_bsp_stop *stops = bsp->stops.items + passage->first_stop;
    for (size_t i = 0; i + 1 < passage->stop_count; i++)
        stops[i].wall =
            covering(bsp, sl_bsp_key(bsp, stops[i].at), sl_bsp_key(bsp, stops[i + 1].at));
    return SL_OK;
}

static sl_status find_crossings(sl_bsp *bsp, const sl_bsp_face *face, sl_bsp_passage *passage) {
    const size_t count = face->sides.count;
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->signs, count));
    int8_t *signs = bsp->signs.items;
    for (size_t i = 0; i < count; i++)
        signs[i] = (int8_t)sl_orient(bsp->a, bsp->b, face->sides.items[i].from);
    bool in = false, out = false;
    for (size_t i = 0; i < count; i++) {
        const int before = signs[i ? i - 1 : count - 1], at = signs[i];
        const int after = signs[i + 1 == count ? 0 : i + 1];
        if ((at < 0 && after > 0) || (at == 0 && before < 0 && after > 0)) {
            passage->exit = (sl_bsp_crossing){.side = i, .at_corner = at == 0};
            out = true;
        }
        if ((at > 0 && after < 0) || (at == 0 && before > 0 && after < 0)) {
            passage->entry = (sl_bsp_crossing){.side = i, .at_corner = at == 0};
            in = true;
        }
    }
    if (in && out) return SL_OK;
    return sl_fail(bsp->context, SL_UNSUPPORTED, "a wall's line passes a cell by");
}

/// The wall that reaches farthest on the way out, of those that reach past the last stop.
static uint32_t wall_beyond(const sl_bsp *bsp, const sl_bsp_passage *passage, bool out,
                            sl_point *end) {
    const sl_bsp_stop *stops = bsp->stops.items + passage->first_stop;
    uint32_t best = SL_BEYOND_EXIT;
    double farthest = 0;
    for (size_t i = 0; i < bsp->on_line.count; i++) {
        sl_point low, high;
        ends_along(bsp, bsp->on_line.items[i], &low, &high);
        const double sign = out ? 1 : -1;
        const double reach = sign * sl_bsp_key(bsp, out ? high : low);
        if (passage->stop_count) {
            const double last = sl_bsp_key(bsp, stops[out ? passage->stop_count - 1 : 0].at) * sign;
            if (reach <= last || sign * sl_bsp_key(bsp, out ? low : high) > last) continue;
        }
        if (best != SL_BEYOND_EXIT && reach <= farthest) continue;
        best = bsp->on_line.items[i];
        farthest = reach;
        *end = out ? high : low;
    }
    return best;
}

/// A wall on the line that ends in the last stop, where that is on the wall of the side or behind
/// it: rounding alone has left room between the two.
static uint32_t wall_up_to(const sl_bsp *bsp, const sl_bsp_passage *passage,
                           const sl_bsp_side *side, bool out) {
    if (!passage->stop_count || side->what >= SL_BEYOND_BORDER) return SL_BEYOND_EXIT;
    const sl_bsp_stop *stops = bsp->stops.items + passage->first_stop;
    const sl_point last = stops[out ? passage->stop_count - 1 : 0].at;
    if (!sl_bsp_behind(&bsp->walls[side->what], side->reversed, last)) return SL_BEYOND_EXIT;
    for (size_t i = 0; i < bsp->on_line.count; i++) {
        sl_point low, high;
        ends_along(bsp, bsp->on_line.items[i], &low, &high);
        if (sl_bsp_is_wall(bsp, bsp->on_line.items[i]) && sl_same_point(out ? high : low, last))
            return bsp->on_line.items[i];
    }
    return SL_BEYOND_EXIT;
}

/// What of the line reaches the crossing, and whether it goes on.
static uint32_t tell_crossing(const sl_bsp *bsp, const sl_bsp_face *face,
                              const sl_bsp_passage *passage, bool out, sl_bsp_crossing *crossing) {
    sl_point end = {0};
    uint32_t wall = wall_beyond(bsp, passage, out, &end);
    const sl_bsp_side *side = &face->sides.items[crossing->side];
    if (wall != SL_BEYOND_EXIT && !crossing->at_corner) {
        const int sign = sl_orient(side->from, sl_side_end(&face->sides, crossing->side), end);
        crossing->touches = sign == 0;
        crossing->touch = end;
        crossing->passes = sign < 0 && side->what == SL_BEYOND_EXIT;
    }
    if (wall == SL_BEYOND_EXIT && !crossing->at_corner) wall = wall_up_to(bsp, passage, side, out);
    crossing->walled = wall != SL_BEYOND_EXIT;
    return wall;
}

static sl_status make_passage(sl_bsp *bsp, uint32_t number, uint32_t through, sl_bsp_passage *out) {
    const sl_bsp_face *face = &bsp->faces.items[number];
    sl_bsp_passage passage = {.face = number};
    SL_TRY(find_crossings(bsp, face, &passage));
    SL_TRY(gather(bsp, face, through));
    SL_TRY(make_stops(bsp, &passage));
    passage.entry_wall = tell_crossing(bsp, face, &passage, false, &passage.entry);
    passage.exit_wall = tell_crossing(bsp, face, &passage, true, &passage.exit);
    *out = passage;
    return SL_OK;
}

/// Goes on into the face behind the first or the last passage.
static sl_status go_on(sl_bsp *bsp, bool out) {
    const sl_bsp_passage *last = &bsp->passages.items[out ? bsp->passages.count - 1 : 0];
    const sl_bsp_crossing *crossing = out ? &last->exit : &last->entry;
    const uint32_t next = bsp->faces.items[last->face].sides.items[crossing->side].beyond;
    const uint32_t through = out ? last->exit_wall : last->entry_wall;
    sl_bsp_passage passage;
    SL_TRY(make_passage(bsp, next, through, &passage));
    // A wall that just gets in, and touches the border of the face there, has come in all the same.
    sl_bsp_crossing *way_in = out ? &passage.entry : &passage.exit;
    if (!way_in->passes) {
        *way_in = (sl_bsp_crossing){.side = way_in->side, .walled = true, .passes = true};
        *(out ? &passage.entry_wall : &passage.exit_wall) = through;
    }
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->passages, 1));
    sl_bsp_passage *items = bsp->passages.items;
    if (!out) memmove(items + 1, items, bsp->passages.count * sizeof *items);
    items[out ? bsp->passages.count : 0] = passage;
    bsp->passages.count++;
    return SL_OK;
}

sl_status sl_bsp_trace(sl_bsp *bsp, uint32_t face, uint32_t wall) {
    bsp->a = bsp->walls[wall].a;
    bsp->b = bsp->walls[wall].b;
    bsp->passages.count = bsp->stops.count = 0;
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->passages, 1));
    SL_TRY(make_passage(bsp, face, wall, &bsp->passages.items[0]));
    bsp->passages.count = 1;
    while (bsp->passages.items[bsp->passages.count - 1].exit.passes) SL_TRY(go_on(bsp, true));
    while (bsp->passages.items[0].entry.passes) SL_TRY(go_on(bsp, false));
    return SL_OK;
}
