/// Lines along portals that an edit makes or takes away.
///
/// With closed sight a line that touches corners on both sides cannot be moved. Whether it joins
/// two cells may then depend on how the plane is cut: where it runs along a portal, rotating it to
/// a side must cross the portal forwards (cell_to_cell/sweep/SWEEP.md), and without that portal
/// nothing is asked. So an edit may change such pairs far from any wall that it changes, but only
/// by lines along portals that came or went. Such a line passes a third corner at least: of general
/// maps there are none.
///
/// For each of these lines, the pairs that it joins are listed before and after the edit. Pairs
/// that came are seen. Those that went are searched for, as another line may join them.
#include "world/reveal.h"

#include "geometry/orient.h"

#include <stdlib.h>

uint8_t sli_reveal_side(const sl_space *s, uint32_t number, sl_segment line) {
    const sl_cell *cell = &s->cells[number];
    uint8_t sides = 0;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const int turn = sli_orient(line.a, line.b, s->vertices[cell->first_vertex + i]);
        if (turn >= 0) sides |= SLI_LEFT_OF_IT;
        if (turn <= 0) sides |= SLI_RIGHT_OF_IT;
    }
    return sides;
}

void sli_reveal_begin(sli_world_rows *r, const sli_numbers *region) {
    for (uint32_t i = 0; i < r->stayed; i++) r->places[r->changed.items[i]] = i + 1;
    for (uint32_t i = 0; i < region->count; i++)
        if (!r->places[region->items[i]]) r->places[region->items[i]] = r->stayed + i + 1;
    r->within_places = true;
    r->most_tests = UINT64_MAX;
    r->tests = 0;
}

void sli_reveal_end(sli_world_rows *r, const sli_numbers *region) {
    for (size_t i = 0; i < r->stayed; i++) r->places[r->changed.items[i]] = 0;
    for (size_t i = 0; i < region->count; i++) r->places[region->items[i]] = 0;
    r->within_places = false;
    r->wanted_count = 0;
}

static int compare_segments(const void *left, const void *right) {
    const sl_segment *s = left, *t = right;
    const int order = sli_compare_points(s->a, t->a);
    return order ? order : sli_compare_points(s->b, t->b);
}

static sl_status note_portal(sl_context *context, sli_world_rows *r, sl_point a, sl_point b) {
    SL_TRY(SL_ARRAY_ROOM(context, &r->portals, 1));
    r->portals.items[r->portals.count++] =
        sli_compare_points(a, b) < 0 ? (sl_segment){a, b} : (sl_segment){b, a};
    return SL_OK;
}

static bool goes(const sli_live *live, uint32_t cell) {
    return live->dissolved[cell] == live->now;
}

/// Notes the portals of cells that go.
static sl_status note_old(sl_context *context, const sli_live *live, sli_world_rows *r) {
    const sl_space *s = &live->space;
    for (size_t i = 0; i < live->old.count; i++) {
        const sl_cell *cell = &s->cells[live->old.items[i]];
        if (!goes(live, live->old.items[i])) continue;
        for (uint32_t k = 0; k < cell->directed_count; k++) {
            const sl_directed_portal *d = &s->directed[cell->first_directed + k];
            SL_TRY(note_portal(context, r, d->left, d->right));
        }
    }
    return SL_OK;
}

/// Notes the portals of cells to come.
static sl_status note_new(sl_context *context, const sli_live *live, sli_world_rows *r) {
    const sli_triangulation *t = &live->triangles;
    for (size_t i = 0; i < live->cells.count; i++) {
        const sli_live_cell *cell = &live->cells.items[i];
        uint32_t half = cell->half;
        if (cell->number != SL_NO_CELL) continue;
        for (uint32_t k = 0; k < cell->corners; k++, half = sli_live_next_side(live, half))
            if (!t->labels[half / 2] && !sli_half_is_outside(t, half ^ 1))
                SL_TRY(
                    note_portal(context, r, sli_live_start(live, half), sli_live_end(live, half)));
    }
    return SL_OK;
}

/// Sorts portals from `first` on. `once`: leaves each once, else those that are there once.
static void sort_portals(sli_world_rows *r, size_t first, bool once) {
    sl_segment *items = r->portals.items;
    const size_t count = r->portals.count;
    r->portals.count = first;
    if (count > first) qsort(items + first, count - first, sizeof *items, compare_segments);
    for (size_t i = first, stop; i < count; i = stop) {
        stop = i + 1;
        while (stop < count && compare_segments(&items[i], &items[stop]) == 0) stop++;
        if (once || stop == i + 1) items[r->portals.count++] = items[i];
    }
}

static bool meets_line(sl_segment line, sl_point a, sl_point b) {
    return sli_orient(line.a, line.b, a) * sli_orient(line.a, line.b, b) <= 0;
}

static sl_status touch(sl_context *context, sli_world_rows *r, uint32_t cell) {
    if (r->marks[cell] == r->now) return SL_OK;
    r->marks[cell] = r->now;
    SL_TRY(SL_ARRAY_ROOM(context, &r->touched, 1));
    r->touched.items[r->touched.count++] = cell;
    return SL_OK;
}

/// Finds the cells that a line meets, from those of the edit on. `lined_up`: it passes a corner
/// that is no end of the portal.
static sl_status find_touched(sl_context *context, const sl_space *s, sli_world_rows *r,
                              const sli_numbers *region, sl_segment line, bool *lined_up) {
    sli_world_rows_next_mark(r);
    r->touched.count = 0;
    *lined_up = false;
    for (size_t i = 0; i < region->count; i++)
        if (r->places[region->items[i]] &&
            sli_reveal_side(s, region->items[i], line) == (SLI_LEFT_OF_IT | SLI_RIGHT_OF_IT))
            SL_TRY(touch(context, r, region->items[i]));
    for (size_t i = 0; i < r->touched.count; i++) {
        const sl_cell *cell = &s->cells[r->touched.items[i]];
        for (uint32_t k = 0; k < cell->vertex_count; k++) {
            const sl_point at = s->vertices[cell->first_vertex + k];
            *lined_up |= !sli_same_point(at, line.a) && !sli_same_point(at, line.b) &&
                         sli_orient(line.a, line.b, at) == 0;
        }
        for (uint32_t k = 0; k < cell->directed_count; k++) {
            const sl_directed_portal *d = &s->directed[cell->first_directed + k];
            if (r->places[d->cell] && meets_line(line, d->left, d->right))
                SL_TRY(touch(context, r, d->cell));
        }
    }
    return SL_OK;
}

/// Lists the pairs of touched cells that stay and that a line itself joins.
static sl_status see_along(sl_context *context, const sli_live *live, sli_world_rows *r,
                           sl_segment line, sli_reveal_pairs *out) {
    for (size_t i = 0; i < r->touched.count; i++) {
        const uint32_t cell = r->touched.items[i];
        if (r->places[cell] > r->stayed) continue;
        SL_TRY(sli_world_rows_search_along(context, live, r, cell, line));
        for (size_t k = 0; k < r->seen.count; k++) {
            const uint32_t other = r->seen.items[k];
            if (r->places[other] <= r->stayed && other != cell)
                SL_TRY(sli_reveal_pair(context, out, r->places[cell] - 1, other));
        }
    }
    return SL_OK;
}

static sl_status note_lines(sl_context *context, const sli_live *live, sli_world_rows *r) {
    SL_TRY(note_old(context, live, r));
    sort_portals(r, 0, true);
    const size_t old = r->portals.count;
    SL_TRY(note_new(context, live, r));
    sort_portals(r, old, true);
    sort_portals(r, 0, false);
    size_t count = 0;
    for (size_t i = 0; i < r->portals.count; i++) {
        const sl_segment line = r->portals.items[i];
        bool lined_up;
        SL_TRY(find_touched(context, &live->space, r, &live->old, line, &lined_up));
        if (!lined_up) continue;
        SL_TRY(see_along(context, live, r, line, &r->joined));
        r->portals.items[count++] = line;
    }
    r->portals.count = count;
    return SL_OK;
}

sl_status sli_world_rows_note_lines(sl_context *context, const sli_live *live, sli_world_rows *r) {
    r->stayed = (uint32_t)r->changed.count;
    r->portals.count = r->joined.count = 0;
    if (r->visibility.sight != SL_CLOSED) return SL_OK;
    sli_reveal_begin(r, &live->old);
    const sl_status status = note_lines(context, live, r);
    sli_reveal_end(r, &live->old);
    return status;
}

static int compare_pairs(const void *left, const void *right) {
    const sli_reveal_pair_of *a = left, *b = right;
    return a->place != b->place ? (a->place > b->place) - (a->place < b->place)
                                : (a->other > b->other) - (a->other < b->other);
}

static void sort_pairs(sli_reveal_pairs *pairs) {
    size_t count = 0;
    if (!pairs->count) return;
    qsort(pairs->items, pairs->count, sizeof *pairs->items, compare_pairs);
    for (size_t i = 0; i < pairs->count; i++)
        if (!count || compare_pairs(&pairs->items[count - 1], &pairs->items[i]) != 0)
            pairs->items[count++] = pairs->items[i];
    pairs->count = count;
}

/// Of the pairs that lines joined before, leaves those that none joins now.
static sl_status see_along_portals(sl_context *context, const sli_live *live, sli_world_rows *r) {
    const size_t first = r->pairs.count;
    for (size_t i = 0; i < r->portals.count; i++) {
        const sl_segment line = r->portals.items[i];
        bool lined_up;
        SL_TRY(find_touched(context, &live->space, r, &live->came, line, &lined_up));
        if (lined_up) SL_TRY(see_along(context, live, r, line, &r->pairs));
    }
    if (!r->joined.count) return SL_OK;
    sort_pairs(&r->joined);
    if (r->pairs.count > first)
        qsort(r->pairs.items + first, r->pairs.count - first, sizeof *r->pairs.items,
              compare_pairs);
    size_t count = 0, at = first;
    for (size_t i = 0; i < r->joined.count; i++) {
        const sli_reveal_pair_of *pair = &r->joined.items[i];
        while (at < r->pairs.count && compare_pairs(&r->pairs.items[at], pair) < 0) at++;
        if (at == r->pairs.count || compare_pairs(&r->pairs.items[at], pair) != 0)
            r->joined.items[count++] = *pair;
    }
    r->joined.count = count;
    return SL_OK;
}

/// Of those, leaves the pairs that no line at all joins.
static sl_status find_lost(sl_context *context, const sli_live *live, sli_world_rows *r) {
    size_t count = 0;
    sli_reveal_pair_of *pairs = r->joined.items;
    r->within_places = false;
    for (size_t i = 0, stop; i < r->joined.count; i = stop) {
        for (size_t k = 0; k < r->changed.count; k++) r->wanted.items[k] = false;
        for (stop = i; stop < r->joined.count && pairs[stop].place == pairs[i].place; stop++)
            r->wanted.items[r->places[pairs[stop].other] - 1] = true;
        r->wanted_count = stop - i;
        SL_TRY(sli_world_rows_search(context, live, r, r->changed.items[pairs[i].place], NULL));
        for (size_t k = i; k < stop; k++)
            if (r->marks[pairs[k].other] != r->now) pairs[count++] = pairs[k];
    }
    r->joined.count = count;
    return SL_OK;
}

sl_status sli_reveal_along(sl_context *context, const sli_live *live, sli_world_rows *r) {
    SL_TRY(see_along_portals(context, live, r));
    return find_lost(context, live, r);
}
