/// Placement: rounds that close the bounds (place.h).
///
/// A round asks for the fewest places that see the witnesses there are: the lower bound. Its places
/// become viewpoints. What these leave unseen gives new witnesses; where nothing is left, they are
/// the answer.
#include "sightline/place.h"

#include "analysis/placement/columns.h"
#include "geometry/length.h"
#include "geometry/orient.h"

#include <stdlib.h>

typedef struct placer {
    sl_context *context;
    sl_query *query;
    const sl_place_options *options;
    const sl_space *space;
    sl_region memory;
    SL_ARRAY(sli_look) witnesses; ///< of the lower bound
    SL_ARRAY(sli_look) places;    ///< viewpoints of this round
    sl_random random;
    sl_placement *out;
} placer;

sl_place_options sl_place_options_default(void) {
    return (sl_place_options){.program = NULL, .rounds = 0, .nodes = 10000};
}

void sl_placement_destroy(sl_context *context, sl_placement *p) {
    sl_free(context, p->viewpoints);
    sl_free(context, p->witnesses);
    sl_free(context, p->places);
    sl_free(context, (void *)(uintptr_t)p->columns.ends);
    sl_free(context, (void *)(uintptr_t)p->columns.entries);
    sl_free(context, p->proof.nodes);
    sl_free(context, p->proof.duals);
    *p = (sl_placement){0};
}

// --- witnesses

static sl_point from_to(sl_point from, sl_point to, double share) {
    return (sl_point){from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
}

/// A number between 0.5 and 1, so that points are in no line by chance.
static double some(placer *p) {
    return 0.5 + 0.5 * sl_random_unit(&p->random);
}

/// Adds a witness. False where it is not inside, or not general.
static sl_status add_witness(placer *p, sl_point at, bool *added) {
    sli_look look;
    bool clean = false;
    *added = false;
    at = sli_coordinates(at);
    if (!sl_space_is_inside(p->space, at)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->witnesses, 1));
    SL_TRY(sli_look_make(p->context, p->query, &p->memory, at, &look, &clean));
    *added = clean && look.general;
    if (*added)
        p->witnesses.items[p->witnesses.count++] = look;
    else
        sli_look_destroy(p->context, &look);
    return SL_OK;
}

static sl_status add_near(placer *p, sl_point corner, sl_point before, sl_point after,
                          double share) {
    bool added = false;
    for (int i = 0; i < 6 && !added; i++) {
        const sl_point to = from_to(before, after, some(p) / 1.5);
        SL_TRY(add_witness(p, from_to(corner, to, share * some(p)), &added));
    }
    return SL_OK;
}

static const sl_side *side_of(const sl_outline *o, uint32_t i) {
    return &o->sides[i];
}

/// Whether sides i and the next one are walls and turn: the corner between them is convex.
static bool is_convex(const sl_outline *o, uint32_t i) {
    const sl_side *s = side_of(o, i), *next = side_of(o, s->next);
    return !sl_side_is_portal(s) && !sl_side_is_portal(next) &&
           sli_orient(s->start, next->start, side_of(o, next->next)->start) > 0;
}

static sl_status add_first_witnesses(placer *p, const sl_outline *o) {
    const uint32_t rooms = o->room_count;
    for (uint32_t r = 0; r < rooms; r++)
        for (uint32_t i = o->first[r]; i < o->first[r + 1]; i++) {
            const sl_side *s = side_of(o, i), *next = side_of(o, s->next);
            if (sl_side_is_portal(s)) continue;
            const sl_point end = side_of(o, next->next)->start;
            uint32_t before = i;
            while (side_of(o, before)->next != i) before = side_of(o, before)->next;
            if (is_convex(o, i))
                SL_TRY(add_near(p, next->start, s->start, end, 1e-4));
            else if (!is_convex(o, before)) {
                bool added = false;
                const sl_point a = s->start, b = next->start;
                const sl_point m = from_to(a, b, 0.25 + 0.5 * some(p) / 1.5);
                for (double h = 1e-3; !added && h > 1e-8; h /= 8)
                    SL_TRY(add_witness(p, (sl_point){m.x - h * (b.y - a.y), m.y + h * (b.x - a.x)},
                                       &added));
            }
        }
    return SL_OK;
}

// --- viewpoints

/// The point beside a part of a window, on its seen side (1) or the other one (-1), at a depth.
static sl_point beside(const sli_track *t, double share, int side, double depth) {
    const sl_point at = sli_track_at(t, share), a = t->line.a, b = t->line.b;
    const double length = sli_length(b.x - a.x, b.y - a.y);
    const double step = side * t->seen * depth / length;
    return (sl_point){at.x - step * (b.y - a.y), at.y + step * (b.x - a.x)};
}

static uint32_t count_seers(const placer *p, sl_point at, const uint32_t *entries, size_t count) {
    uint32_t seers = 0;
    for (size_t i = 0; i < count; i++)
        seers += sli_look_holds(&p->witnesses.items[entries[i]], at);
    return seers;
}

/// A point that sees the witnesses of a column, or as many as can be found.
static sl_point place_of(const placer *p, const sli_place_columns *c, uint32_t column) {
    static const double depths[] = {1, 0.5, 0.25, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-6, 1e-8, 1e-11, 0};
    static const double shares[] = {0.5, 0.3, 0.7, 0.1, 0.9, 0, 1};
    const sli_window_part part = c->places.items[column];
    const sli_look *look = &p->witnesses.items[part.look];
    if (part.window == SLI_NO_WINDOW) return look->eye;
    const size_t first = column ? c->ends.items[column - 1] : 0;
    const size_t count = c->ends.items[column] - first;
    const sli_track t = sli_track_of(look, part.window);
    const double length = (part.to - part.from) *
                          sli_length(t.line.b.x - t.line.a.x, t.line.b.y - t.line.a.y);
    sl_point best = t.line.b;
    uint32_t most = count_seers(p, best, c->entries.items + first, count);
    if (most == count) most--; // a corner only if nothing else does
    for (size_t d = 0; d < sizeof depths / sizeof *depths && most < count; d++)
        for (size_t s = 0; s < sizeof shares / sizeof *shares && most < count; s++) {
            const sl_point at = sli_coordinates(
                beside(&t, part.from + shares[s] * (part.to - part.from), 1, depths[d] * length));
            if (!sl_space_is_inside(p->space, at)) continue;
            const uint32_t seers = count_seers(p, at, c->entries.items + first, count);
            if (seers > most) most = seers, best = at;
        }
    return best;
}

static void clear_looks(sl_context *context, sli_look *looks, size_t count) {
    for (size_t i = 0; i < count; i++) sli_look_destroy(context, &looks[i]);
}

static sl_status add_place(placer *p, sl_point at) {
    sli_look look;
    bool clean;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->places, 1));
    SL_TRY(sli_look_make(p->context, p->query, &p->memory, at, &look, &clean));
    if (clean) p->places.items[p->places.count++] = look;
    return SL_OK;
}

static bool is_seen(const placer *p, sl_point at) {
    for (size_t i = 0; i < p->places.count; i++)
        if (sli_box_holds(&p->places.items[i].bounds, at) &&
            sli_look_holds(&p->places.items[i], at))
            return true;
    return false;
}

/// A witness beyond a gap that none of the viewpoints sees.
static sl_status add_beyond(placer *p, const sli_window_part *gap, bool *added) {
    static const double depths[] = {0.5, 0.25, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9, 1e-12};
    static const double shares[] = {0.5, 0.25, 0.75, 0.05, 0.95};
    const sli_track t = sli_track_of(&p->places.items[gap->look], gap->window);
    const double length =
        (gap->to - gap->from) * sli_length(t.line.b.x - t.line.a.x, t.line.b.y - t.line.a.y);
    *added = false;
    for (size_t d = 0; d < sizeof depths / sizeof *depths; d++)
        for (size_t s = 0; s < sizeof shares / sizeof *shares; s++) {
            const double share = shares[s] + 0.04 * (some(p) - 0.75);
            const sl_point at =
                beside(&t, gap->from + share * (gap->to - gap->from), -1, depths[d] * length);
            if (!sl_space_is_inside(p->space, at) || is_seen(p, at)) continue;
            SL_TRY(add_witness(p, at, added));
            if (*added) return SL_OK;
        }
    return SL_OK;
}

#include <stdio.h>
static sl_status run_round(placer *p, bool *done) {
    sli_place_columns columns;
    double t0=sl_seconds();
    SL_TRY(sli_place_columns_make(p->context, p->witnesses.items, (uint32_t)p->witnesses.count, &columns));
    double t1=sl_seconds();
    const sl_cover_problem problem = {(uint32_t)p->witnesses.count, (uint32_t)columns.ends.count,
                                      columns.ends.items, columns.entries.items, NULL, NULL};
    sl_cover_result cover = {0};
    SL_TRY(sl_cover_solve(p->context, &problem, NULL, &cover));
    double t2=sl_seconds();
    clear_looks(p->context, p->places.items, p->places.count);
    p->places.count = 0;
    for (uint32_t i = 0; i < cover.count; i++)
        SL_TRY(add_place(p, place_of(p, &columns, cover.columns[i])));
    double t3=sl_seconds();
    sli_window_parts gaps = {0};
    const sli_look **looks = malloc(p->places.count * sizeof *looks);
    for (size_t i = 0; i < p->places.count; i++) looks[i] = &p->places.items[i];
    SL_TRY(sli_gaps_find(p->context, p->space, looks, (uint32_t)p->places.count, &gaps));
    double t4=sl_seconds();
    size_t more = 0, failed = 0;
    for (size_t i = 0; i < gaps.count; i++) {
        bool added;
        SL_TRY(add_beyond(p, &gaps.items[i], &added));
        more += added;
        failed += !added;
    }
    if (getenv("PLACE_DEBUG")) fprintf(stderr, "W %u cols %u lower %lu places %zu gaps %zu new %zu failed %zu | %.3f %.3f %.3f %.3f %.3f\n", problem.row_count, problem.column_count, (unsigned long)cover.lower, p->places.count, gaps.count, more, failed,t1-t0,t2-t1,t3-t2,t4-t3,sl_seconds()-t4);
    p->out->lower = cover.lower;
    *done = gaps.count == 0;
    p->out->upper = *done ? p->places.count : UINT64_MAX;
    if (!*done && !more) { *done = true; }
    sl_cover_result_destroy(p->context, &cover);
    sli_place_columns_destroy(p->context, &columns);
    sl_free(p->context, gaps.items);
    free(looks);
    return SL_OK;
}

sl_status sl_place(sl_context *context, sl_query *query, const sl_place_options *options,
                   sl_placement *out) {
    placer p = {.context = context, .query = query, .options = options, .out = out, .random = {1}};
    *out = (sl_placement){0};
    const sl_outline *outline;
    SL_TRY(sl_query_space(context, query, &p.space, NULL));
    SL_TRY(sl_query_outline(context, query, &outline));
    SL_TRY(add_first_witnesses(&p, outline));
    for (bool done = false; !done; ) { out->rounds++; SL_TRY(run_round(&p, &done)); }
    out->viewpoints = sl_alloc_array(context, p.places.count, sizeof *out->viewpoints);
    for (size_t i = 0; i < p.places.count; i++) out->viewpoints[i] = (sl_viewpoint){p.places.items[i].eye, 0, 360, 0};
    out->count = (uint32_t)p.places.count;
    return SL_OK;
}
