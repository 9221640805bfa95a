/// Witnesses: points that are hard to see. They are put a little off all lines through corners, by
/// chance, so that no line of sight touches two corners.
#include "analysis/placement/placer.h"

#include "geometry/length.h"
#include "geometry/orient.h"

#include <stdlib.h>

static sl_point from_to(sl_point from, sl_point to, double share) {
    return (sl_point){from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
}

/// A number between 0.5 and 1, so that points are in no line by chance.
static double some(sli_placer *p) {
    return 0.5 + 0.5 * sl_random_unit(&p->random);
}

static const sl_side *side_of(const sl_outline *o, uint32_t i) {
    return &o->sides[i];
}

/// Whether a point inside is on a wall, maybe by rounding, or is a corner.
static sl_status is_on_wall(sli_placer *p, sl_point at, bool *on_wall) {
    const sl_outline *o;
    const uint32_t cell = sl_space_locate(p->ground.space, at);
    *on_wall = false;
    SL_TRY(sl_query_outline(p->context, p->query, &o));
    for (uint32_t k = o->first_part[cell]; k < o->first_part[cell + 1]; k++)
        for (uint32_t i = o->first[o->parts[k]]; i < o->first[o->parts[k] + 1]; i++) {
            const sl_side *s = side_of(o, i);
            *on_wall |= sli_same_point(s->start, at) ||
                        (!sl_side_is_portal(s) &&
                         sli_orient(s->start, side_of(o, s->next)->start, at) == 0);
        }
    return SL_OK;
}

/// Adds a witness. False where it is not inside, on a wall, or not general.
static sl_status add_witness(sli_placer *p, sl_point at, bool *added) {
    sli_look look;
    bool on_wall;
    bool clean = false;
    *added = false;
    at = sli_coordinates(at);
    if (!sl_space_is_inside(p->ground.space, at)) return SL_OK;
    SL_TRY(is_on_wall(p, at, &on_wall));
    if (on_wall) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->witnesses, 1));
    SL_TRY(sli_look_make(p->context, p->query, &p->memory, at, &look, &clean));
    *added = clean && look.general;
    if (!*added) {
        sli_look_destroy(p->context, &look);
        return SL_OK;
    }
    const uint32_t number = (uint32_t)p->witnesses.count;
    p->witnesses.items[p->witnesses.count++] = look;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->standings, 1));
    p->standings.items[p->standings.count++] = SLI_IDLE;
    SL_TRY(sli_nearby_add(p->context, &p->witness_points, (sl_box){at, at}));
    SL_TRY(sli_nearby_find_at(p->context, &p->candidate_bounds, at));
    for (size_t i = 0; i < p->candidate_bounds.found.count; i++)
        SL_TRY(sli_try_seeing(p, p->candidate_bounds.found.items[i], number));
    return SL_OK;
}

static sl_status add_near(sli_placer *p, sl_point corner, sl_point before, sl_point after,
                          double share) {
    bool added = false;
    for (int i = 0; i < 6 && !added; i++) {
        const sl_point to = from_to(before, after, some(p) / 1.5);
        SL_TRY(add_witness(p, from_to(corner, to, share * some(p)), &added));
    }
    return SL_OK;
}

/// Whether sides i and the next one are walls and turn: the corner between them is convex.
static bool is_convex(const sl_outline *o, uint32_t i) {
    const sl_side *s = side_of(o, i), *next = side_of(o, s->next);
    return !sl_side_is_portal(s) && !sl_side_is_portal(next) &&
           sli_orient(s->start, next->start, side_of(o, next->next)->start) > 0;
}

/// One in the corner behind side i, where it is convex; one before the side, where it is between
/// two corners that are not.
static sl_status add_at_side(sli_placer *p, const sl_outline *o, uint32_t i, uint32_t before) {
    const sl_side *s = side_of(o, i), *next = side_of(o, s->next);
    const sl_point a = s->start, b = next->start;
    bool added = false;
    if (is_convex(o, i)) return add_near(p, b, a, side_of(o, next->next)->start, 1e-4);
    if (is_convex(o, before)) return SL_OK;
    const sl_point m = from_to(a, b, 0.25 + 0.5 * some(p) / 1.5);
    for (double h = 1e-3; !added && h > 1e-8; h /= 8)
        SL_TRY(add_witness(p, (sl_point){m.x - h * (b.y - a.y), m.y + h * (b.x - a.x)}, &added));
    return SL_OK;
}

sl_status sli_add_first_witnesses(sli_placer *p) {
    const sl_outline *o;
    SL_TRY(sl_query_outline(p->context, p->query, &o));
    uint32_t *before = sl_alloc_array(p->context, o->side_count, sizeof *before);
    if (!before) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < o->side_count; i++) before[side_of(o, i)->next] = i;
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < o->first[o->room_count] && status == SL_OK; i++)
        if (!sl_side_is_portal(side_of(o, i))) status = add_at_side(p, o, i, before[i]);
    sl_free(p->context, before);
    return status;
}

sl_status sli_add_beyond(sli_placer *p, const sli_window_part *gap, bool *added) {
    static const double depths[] = {0.5,  0.25, 0.1,  0.03, 0.01, 1e-3,
                                    1e-4, 1e-5, 1e-7, 1e-9, 1e-12};
    static const double shares[] = {0.5, 0.25, 0.75, 0.05, 0.95};
    const sli_track t = sli_track_of(sli_chosen_look(p, gap->look), gap->window);
    const double length =
        (gap->to - gap->from) * sli_length(t.line.b.x - t.line.a.x, t.line.b.y - t.line.a.y);
    *added = false;
    for (size_t d = 0; d < sizeof depths / sizeof *depths; d++)
        for (size_t s = 0; s < sizeof shares / sizeof *shares; s++) {
            const double share = shares[s] + 0.04 * (some(p) - 0.75);
            const sl_point at = sli_track_beside(&t, gap->from + share * (gap->to - gap->from), -1,
                                                 depths[d] * length);
            bool seen = true;
            if (sl_space_is_inside(p->ground.space, at)) SL_TRY(sli_is_seen(p, at, &seen));
            if (seen) continue;
            SL_TRY(add_witness(p, at, added));
            if (*added) return SL_OK;
        }
    return SL_OK;
}

static int compare_areas(const void *left, const void *right) {
    const sli_hard_witness *a = left, *b = right;
    if (a->area != b->area) return a->area < b->area ? -1 : 1;
    return (a->witness > b->witness) - (a->witness < b->witness);
}

/// Whether one that has just become active sees a witness; `fresh` has their bounds.
static sl_status is_seen_by_fresh(sli_placer *p, sli_nearby *fresh, size_t before, uint32_t witness,
                                  bool *seen) {
    const sl_point at = p->witnesses.items[witness].eye;
    *seen = false;
    SL_TRY(sli_nearby_find_at(p->context, fresh, at));
    for (size_t i = 0; i < fresh->found.count && !*seen; i++) {
        const uint32_t other = p->active.items[before + fresh->found.items[i]];
        *seen = sli_look_holds(&p->witnesses.items[other], at);
    }
    return SL_OK;
}

static bool is_active(const sli_placer *p, uint32_t witness) {
    const sli_standing standing = p->standings.items[witness];
    return standing == SLI_ACTIVE || standing == SLI_BACK;
}

static sl_status activate(sli_placer *p, sli_nearby *fresh) {
    const size_t before = p->active.count, room = before / 4 + 16;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->active, p->unseen.count));
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < p->unseen.count && (!pass || p->active.count < before + room); i++) {
            const uint32_t witness = p->unseen.items[i].witness;
            bool seen = is_active(p, witness);
            if (!pass) SL_TRY(is_seen_by_fresh(p, fresh, before, witness, &seen));
            if (seen) continue;
            p->active.items[p->active.count++] = witness;
            sli_standing *standing = &p->standings.items[witness];
            *standing = *standing == SLI_DROPPED ? SLI_BACK : SLI_ACTIVE;
            SL_TRY(sli_nearby_add(p->context, fresh, p->witnesses.items[witness].bounds));
        }
    return SL_OK;
}

sl_status sli_activate(sli_placer *p, bool *added) {
    const size_t before = p->active.count;
    p->unseen.count = 0;
    for (uint32_t i = 0; i < p->witnesses.count; i++) {
        const sli_look *w = &p->witnesses.items[i];
        bool seen = is_active(p, i);
        if (!seen) SL_TRY(sli_is_seen(p, w->eye, &seen));
        if (seen) continue;
        SL_TRY(SL_ARRAY_ROOM(p->context, &p->unseen, 1));
        p->unseen.items[p->unseen.count++] = (sli_hard_witness){w->area, i};
    }
    if (p->unseen.count)
        qsort(p->unseen.items, p->unseen.count, sizeof *p->unseen.items, compare_areas);
    sli_nearby fresh = {0};
    const sl_status status = activate(p, &fresh);
    sli_nearby_destroy(p->context, &fresh);
    *added = p->active.count > before;
    return status;
}

sl_status sli_drop_implied(sli_placer *p, const sl_cover_proof *proof) {
    const size_t before = p->active.count;
    bool *kept = sl_alloc_array(p->context, before, sizeof *kept);
    if (!kept) return SL_NO_MEMORY;
    for (size_t i = 0; i < before; i++) kept[i] = true;
    for (uint32_t i = 0; i < proof->step_count; i++) {
        const uint32_t row = proof->steps[i].what;
        if (proof->steps[i].kind != SL_COVER_ROW_GOES) continue;
        sli_standing *standing = &p->standings.items[p->active.items[row]];
        kept[row] = *standing == SLI_BACK;
        if (!kept[row]) *standing = SLI_DROPPED;
    }
    const sl_status status = sli_crossings_keep(p->context, &p->crossings, p->looks.items, kept);
    p->active.count = 0;
    for (size_t i = 0; i < before; i++)
        if (kept[i]) p->active.items[p->active.count++] = p->active.items[i];
    sl_free(p->context, kept);
    return status;
}

// --- parts of the plan

sl_status sli_add_unseen_parts(sli_placer *p, bool *added) {
    const sl_space *space = p->ground.space;
    uint32_t *parent = sl_alloc_array(p->context, space->cell_count, sizeof *parent);
    bool *seen = sl_alloc_array(p->context, space->cell_count, sizeof *seen);
    sl_status status = parent && seen ? SL_OK : SL_NO_MEMORY;
    *added = false;
    for (uint32_t c = 0; status == SL_OK && c < space->cell_count; c++) parent[c] = c;
    for (uint32_t i = 0; status == SL_OK && i < space->directed_count; i++) {
        const uint32_t *cell = space->portals[space->directed[i].portal].cell;
        if (space->cells[cell[0]].inside && space->cells[cell[1]].inside)
            parent[sl_root_of(parent, cell[0])] = sl_root_of(parent, cell[1]);
    }
    for (size_t i = 0; status == SL_OK && i < p->chosen.count; i++)
        seen[sl_root_of(parent, sl_space_locate(space, sli_chosen_look(p, i)->eye))] = true;
    for (uint32_t c = 0; status == SL_OK && c < space->cell_count; c++) {
        bool one;
        if (!space->cells[c].inside || seen[sl_root_of(parent, c)]) continue;
        const sl_point m = sl_space_middle(space, c);
        const sl_point corner = space->vertices[space->cells[c].first_vertex];
        for (int i = 0; i < 4 && status == SL_OK && !seen[sl_root_of(parent, c)]; i++) {
            status = add_witness(p, from_to(m, corner, 0.1 * some(p)), &one);
            if (status == SL_OK && one) *added = seen[sl_root_of(parent, c)] = true;
        }
    }
    sl_free(p->context, parent);
    sl_free(p->context, seen);
    return status;
}
