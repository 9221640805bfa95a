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
#include <stdio.h>

typedef struct candidate {
    sli_look look;
    SL_ARRAY(uint32_t) sees; ///< witnesses, ascending
} candidate;

typedef struct unseen {
    double area; ///< of its region
    uint32_t witness;
} unseen;

typedef struct placer {
    sl_context *context;
    sl_query *query;
    const sl_place_options *options;
    const sl_space *space;
    sl_region memory;
    sl_random random;
    SL_ARRAY(sli_look) witnesses;   ///< all that were made
    SL_ARRAY(uint32_t) active;      ///< those of the lower bound
    SL_ARRAY(candidate) candidates; ///< places to look from, for the upper bound
    SL_ARRAY(uint32_t) chosen;      ///< candidates
    SL_ARRAY(unseen) unseen;        ///< scratch
    SL_ARRAY(const sli_look *) looks; ///< scratch
    sli_window_parts gaps;
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

/// Notes a witness where a candidate sees it.
static sl_status try_seeing(placer *p, size_t number, uint32_t witness) {
    candidate *c = &p->candidates.items[number];
    const sl_point at = p->witnesses.items[witness].eye;
    if (!sli_box_holds(&c->look.bounds, at) || !sli_look_holds(&c->look, at)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(p->context, &c->sees, 1));
    c->sees.items[c->sees.count++] = witness;
    return SL_OK;
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
    if (!*added) {
        sli_look_destroy(p->context, &look);
        return SL_OK;
    }
    const uint32_t number = (uint32_t)p->witnesses.count;
    p->witnesses.items[p->witnesses.count++] = look;
    for (size_t i = 0; i < p->candidates.count; i++) SL_TRY(try_seeing(p, i, number));
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
        seers += sli_look_holds(&p->witnesses.items[p->active.items[entries[i]]], at);
    return seers;
}

/// A point that sees the witnesses of a column, or as many as can be found.
static sl_point place_of(const placer *p, const sli_place_columns *c, uint32_t column) {
    static const double depths[] = {1, 0.5, 0.25, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-6, 1e-8, 1e-11, 0};
    static const double shares[] = {0.5, 0.3, 0.7, 0.1, 0.9, 0, 1};
    const sli_window_part part = c->places.items[column];
    const sli_look *look = &p->witnesses.items[p->active.items[part.look]];
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
    if (getenv("PLACE_FAIL") && most < count) { fprintf(stderr,"  FAIL %u of %zu part %.17g %.17g end %.17g eye %.9g %.9g apex %.9g %.9g best %.17g %.17g\n", most,count,part.from,part.to,t.end.at,t.line.a.x,t.line.a.y,t.line.b.x,t.line.b.y,best.x,best.y); }
    return best;
}

/// Adds a candidate, once; UINT32_MAX where nothing can be seen from there.
static sl_status add_candidate(placer *p, sl_point at, uint32_t *number) {
    bool clean;
    for (*number = 0; *number < p->candidates.count; ++*number)
        if (sli_same_point(p->candidates.items[*number].look.eye, at)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->candidates, 1));
    candidate *c = &p->candidates.items[p->candidates.count];
    *c = (candidate){0};
    *number = UINT32_MAX;
    if (!sl_space_is_inside(p->space, at)) return SL_OK;
    SL_TRY(sli_look_make(p->context, p->query, &p->memory, at, &c->look, &clean));
    if (!clean) return SL_OK;
    *number = (uint32_t)p->candidates.count++;
    for (uint32_t i = 0; i < p->witnesses.count; i++) SL_TRY(try_seeing(p, *number, i));
    return SL_OK;
}

static const sli_look *chosen_look(const placer *p, size_t i) {
    return &p->candidates.items[p->chosen.items[i]].look;
}

static bool is_seen(const placer *p, sl_point at) {
    for (size_t i = 0; i < p->chosen.count; i++)
        if (sli_box_holds(&chosen_look(p, i)->bounds, at) && sli_look_holds(chosen_look(p, i), at))
            return true;
    return false;
}

/// A witness beyond a gap that none of the viewpoints sees.
static sl_status add_beyond(placer *p, const sli_window_part *gap, bool *added) {
    static const double depths[] = {0.5, 0.25, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9, 1e-12};
    static const double shares[] = {0.5, 0.25, 0.75, 0.05, 0.95};
    const sli_track t = sli_track_of(chosen_look(p, gap->look), gap->window);
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
// --- rounds

/// Finds what the chosen candidates leave unseen, and witnesses there.
static sl_status find_unseen(placer *p, bool *none, bool *added) {
    p->looks.count = 0;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->looks, p->chosen.count));
    for (size_t i = 0; i < p->chosen.count; i++)
        p->looks.items[p->looks.count++] = chosen_look(p, i);
    SL_TRY(sli_gaps_find(p->context, p->space, p->looks.items, (uint32_t)p->looks.count, &p->gaps));
    *none = p->gaps.count == 0;
    *added = false;
    for (size_t i = 0; i < p->gaps.count; i++) {
        if (getenv("PLACE_GAPS")) { const sli_window_part *g=&p->gaps.items[i]; const sli_look *l=chosen_look(p,g->look); sli_track t=sli_track_of(l,g->window); fprintf(stderr,"   gap eye %.9g %.9g apex %.9g %.9g share %g..%g of end %g wall %.9g %.9g %.9g %.9g\n", l->eye.x,l->eye.y,t.line.b.x,t.line.b.y,g->from,g->to,t.end.at,t.end.line.a.x,t.end.line.a.y,t.end.line.b.x,t.end.line.b.y);} 
        bool one;
        SL_TRY(add_beyond(p, &p->gaps.items[i], &one));
        *added = *added || one;
    }
    return SL_OK;
}

/// The chosen candidates see everything: they are the upper bound if they are fewer.
static sl_status keep_best(placer *p) {
    sl_placement *out = p->out;
    if (out->viewpoints && out->count <= p->chosen.count) return SL_OK;
    sl_viewpoint *all = sl_alloc_array(p->context, p->chosen.count, sizeof *all);
    if (!all) return SL_NO_MEMORY;
    for (size_t i = 0; i < p->chosen.count; i++)
        all[i] = (sl_viewpoint){.at = chosen_look(p, i)->eye, .fov = 360};
    sl_free(p->context, out->viewpoints);
    out->viewpoints = all;
    out->count = (uint32_t)p->chosen.count;
    out->upper = out->count;
    return SL_OK;
}

static int compare_areas(const void *left, const void *right) {
    const unseen *a = left, *b = right;
    if (a->area != b->area) return a->area < b->area ? -1 : 1;
    return (a->witness > b->witness) - (a->witness < b->witness);
}

/// Takes witnesses that no chosen candidate sees into the lower bound: those with the smallest
/// regions first, but of those that see each other one.
static sl_status activate(placer *p, bool *added) {
    const size_t before = p->active.count;
    p->unseen.count = 0;
    for (uint32_t i = 0; i < p->witnesses.count; i++) {
        const sli_look *w = &p->witnesses.items[i];
        if (is_seen(p, w->eye)) continue;
        SL_TRY(SL_ARRAY_ROOM(p->context, &p->unseen, 1));
        p->unseen.items[p->unseen.count++] = (unseen){w->area, i};
    }
    if (p->unseen.count)
        qsort(p->unseen.items, p->unseen.count, sizeof *p->unseen.items, compare_areas);
    for (size_t i = 0; i < p->unseen.count; i++) {
        const sl_point at = p->witnesses.items[p->unseen.items[i].witness].eye;
        bool near = false;
        for (size_t k = before; k < p->active.count && !near; k++)
            near = sli_look_holds(&p->witnesses.items[p->active.items[k]], at);
        if (near) continue;
        SL_TRY(SL_ARRAY_ROOM(p->context, &p->active, 1));
        p->active.items[p->active.count++] = p->unseen.items[i].witness;
    }
    *added = p->active.count > before;
    return SL_OK;
}

#include <stdio.h>
static bool debug(void) { return getenv("PLACE_DEBUG") != NULL; }

static sl_status choose_column(placer *p, const sli_place_columns *c, uint32_t column) {
    uint32_t number;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->chosen, 1));
    SL_TRY(add_candidate(p, place_of(p, c, column), &number));
    if (number != UINT32_MAX) p->chosen.items[p->chosen.count++] = number;
    return SL_OK;
}

/// The lower bound, and the viewpoints that it has.
static sl_status bound_below(placer *p, bool *done, bool *added) {
    sli_place_columns c;
    const double t0 = sl_seconds();
    p->looks.count = 0;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->looks, p->active.count));
    for (size_t i = 0; i < p->active.count; i++)
        p->looks.items[p->looks.count++] = &p->witnesses.items[p->active.items[i]];
    SL_TRY(sli_place_columns_make(p->context, p->looks.items, (uint32_t)p->active.count, &c));
    const double t1 = sl_seconds();
    const sl_cover_problem problem = {(uint32_t)p->active.count, (uint32_t)c.ends.count,
                                      c.ends.items, c.entries.items, NULL, NULL};
    sl_cover_options options = sl_cover_options_default();
    options.program = p->options->program;
    sl_cover_result cover = {0};
    SL_TRY(sl_cover_solve(p->context, &problem, &options, &cover));
    const double t2 = sl_seconds();
    p->chosen.count = 0;
    for (uint32_t i = 0; i < cover.count; i++) SL_TRY(choose_column(p, &c, cover.columns[i]));
    if (cover.lower > p->out->lower) p->out->lower = cover.lower;
    const double t3 = sl_seconds();
    *done = false;
    SL_TRY(activate(p, added));
    p->gaps.count = 0;
    if (!*added) {
        SL_TRY(find_unseen(p, done, added));
        if (*done) SL_TRY(keep_best(p));
        SL_TRY(activate(p, added));
    }
    if (debug()) fprintf(stderr, "W %u/%zu cols %u lower %lu (%lu) gaps %zu added %d | col %.3f cover %.3f place %.3f gaps %.3f\n", problem.row_count, p->witnesses.count, problem.column_count, (unsigned long)cover.lower, (unsigned long)cover.cost, p->gaps.count, *added, t1-t0,t2-t1,t3-t2,sl_seconds()-t3);
    sl_cover_result_destroy(p->context, &cover);
    sli_place_columns_destroy(p->context, &c);
    return SL_OK;
}

/// Candidates for witnesses that none of them sees.
static sl_status complete(placer *p) {
    bool *seen = sl_alloc_array(p->context, p->witnesses.count, sizeof *seen);
    sl_status status = seen ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; seen && i < p->candidates.count; i++)
        for (size_t k = 0; k < p->candidates.items[i].sees.count; k++)
            seen[p->candidates.items[i].sees.items[k]] = true;
    const size_t count = p->witnesses.count;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        uint32_t number;
        if (!seen[i]) status = add_candidate(p, p->witnesses.items[i].eye, &number);
    }
    sl_free(p->context, seen);
    return status;
}

/// The fewest candidates that see all witnesses.
static sl_status cover_witnesses(placer *p) {
    SL_TRY(complete(p));
    size_t entries = 0;
    for (size_t i = 0; i < p->candidates.count; i++) entries += p->candidates.items[i].sees.count;
    size_t *ends = sl_alloc_array(p->context, p->candidates.count, sizeof *ends);
    uint32_t *all = sl_alloc_array(p->context, entries, sizeof *all);
    sl_status status = ends && all ? SL_OK : SL_NO_MEMORY;
    entries = 0;
    for (size_t i = 0; status == SL_OK && i < p->candidates.count; i++) {
        for (size_t k = 0; k < p->candidates.items[i].sees.count; k++)
            all[entries++] = p->candidates.items[i].sees.items[k];
        ends[i] = entries;
    }
    const sl_cover_problem problem = {(uint32_t)p->witnesses.count, (uint32_t)p->candidates.count,
                                      ends, all, NULL, NULL};
    sl_cover_options options = sl_cover_options_default();
    options.program = p->options->program;
    sl_cover_result cover = {0};
    if (status == SL_OK) status = sl_cover_solve(p->context, &problem, &options, &cover);
    p->chosen.count = 0;
    if (status == SL_OK) status = SL_ARRAY_ROOM(p->context, &p->chosen, cover.count);
    for (uint32_t i = 0; status == SL_OK && i < cover.count; i++)
        p->chosen.items[p->chosen.count++] = cover.columns[i];
    sl_cover_result_destroy(p->context, &cover);
    sl_free(p->context, ends);
    sl_free(p->context, all);
    return status;
}

static sl_status bound_above(placer *p, bool *added) {
    for (int i = 0; i < 30; i++) {
        bool none, one;
        const double t0 = sl_seconds();
        SL_TRY(cover_witnesses(p));
        const double t1 = sl_seconds();
        if (p->out->viewpoints && p->chosen.count >= p->out->count) return SL_OK;
        SL_TRY(find_unseen(p, &none, &one));
        if (debug()) fprintf(stderr, "  U %zu C %zu upper? %zu gaps %zu added %d | cover %.3f gaps %.3f\n", p->witnesses.count, p->candidates.count, p->chosen.count, p->gaps.count, one, t1-t0, sl_seconds()-t1);
        *added = *added || one;
        if (none) return keep_best(p);
        if (!one) return SL_OK;
    }
    return SL_OK;
}

static sl_status add_corners(placer *p) {
    uint32_t number;
    for (size_t i = 0; i < p->witnesses.count; i++)
        for (uint32_t w = 0; w < p->witnesses.items[i].window_count; w++)
            SL_TRY(add_candidate(p, p->witnesses.items[i].windows[w].apex, &number));
    return SL_OK;
}

static sl_status run(placer *p) {
    bool added;
    int full = 0;
    SL_TRY(activate(p, &added));
    for (;;) {
        bool done;
        p->out->rounds++;
        SL_TRY(bound_below(p, &done, &added));
        if (p->out->upper == p->out->lower) return SL_OK;
        if (p->gaps.count == 0) continue;
        full++;
        if (full == 2) SL_TRY(add_corners(p));
        if (full > 1) SL_TRY(bound_above(p, &added));
        if (p->out->upper == p->out->lower) return SL_OK;
        if (!added || full == 60) return SL_OK;
    }
}

static void clear(placer *p) {
    sl_region_destroy(p->context, &p->memory);
    for (size_t i = 0; i < p->witnesses.count; i++)
        sli_look_destroy(p->context, &p->witnesses.items[i]);
    for (size_t i = 0; i < p->candidates.count; i++) {
        sli_look_destroy(p->context, &p->candidates.items[i].look);
        sl_free(p->context, p->candidates.items[i].sees.items);
    }
    sl_free(p->context, p->witnesses.items);
    sl_free(p->context, p->candidates.items);
    sl_free(p->context, p->active.items);
    sl_free(p->context, p->unseen.items);
    sl_free(p->context, p->chosen.items);
    sl_free(p->context, (void *)p->looks.items);
    sl_free(p->context, p->gaps.items);
}

sl_status sl_place(sl_context *context, sl_query *query, const sl_place_options *options,
                   sl_placement *out) {
    const sl_outline *outline;
    sl_placement made = {0};
    placer p = {.context = context, .query = query, .options = options, .out = &made, .random = {1}};
    SL_TRY(sl_query_space(context, query, &p.space, NULL));
    SL_TRY(sl_query_outline(context, query, &outline));
    sl_status status = add_first_witnesses(&p, outline);
    if (status == SL_OK) status = run(&p);
    clear(&p);
    if (status == SL_OK)
        *out = made;
    else
        sl_placement_destroy(context, &made);
    return status;
}
