/// A sightline by mirror, to be told: depth first over sequences of portals and mirrors, with one
/// reflection more each time, and as in explain.c with a bound on what is crossed that is doubled
/// until a line is found or nothing is left beyond it.
#include "cell_to_cell/explain_line.h"
#include "cell_to_cell/unfolded.h"
#include "effects/mirror_sides.h"
#include "sightline/explain.h"
#include "sightline/support.h"

#include <math.h>

typedef struct step {
    sl_unfolded at;
    sl_directed_portal
        place; ///< what was crossed last, where the map has it; ends named as those unfolded
    uint32_t cell, directed, next;
    bool grazing;
} step;

typedef struct search {
    const sl_space *space;
    const sl_map *map;
    const sl_explain_options *options;
    void *solver;
    uint32_t *distance;
    sl_mirror_sides sides;
    SL_ARRAY(step) steps;
    uint32_t from, to, reflections, bound;
    uint32_t best; ///< crossed by the shortest found; UINT32_MAX for none
    bool cut, stopped;
    sl_bent_sightline out;
} search;

static const step *last_step(const search *s) {
    return &s->steps.items[s->steps.count - 1];
}

// --- what is found

static sl_point between(const sl_directed_portal *directed, double share) {
    return (sl_point){directed->left.x + share * (directed->right.x - directed->left.x),
                      directed->left.y + share * (directed->right.y - directed->left.y)};
}

/// Where the line turns, in the map: a mirror is crossed at the same share of it as its image.
static void place_bends(const search *s, const step *last, sl_line line) {
    const sl_frame *f = &last->at.frame;
    const double x = line.b.x - line.a.x, y = line.b.y - line.a.y, length = hypot(x, y);
    const sl_point back = {-x / length, -y / length};
    // Frames keep lengths: back from one is by its transpose.
    const sl_point on = {(f->xx * x + f->yx * y) / length, (f->xy * x + f->yy * y) / length};
    sl_point *bends = s->out.bends;
    uint32_t count = 1;
    for (size_t i = 1; i <= s->steps.count; i++) {
        const step *at = i < s->steps.count ? &s->steps.items[i] : last;
        const sl_point crossed = between(&at->place, sl_share_of_portal(&at->at.ends, line));
        if (i == 1) bends[0] = sl_halfway_into(s->space, s->from, crossed, back);
        if (at->at.mirror != UINT32_MAX) bends[count++] = crossed;
        if (at == last) bends[count] = sl_halfway_into(s->space, s->to, crossed, on);
    }
}

static sl_status note_found(sl_context *context, search *s, const step *last, bool grazing) {
    sl_bent_sightline *out = &s->out;
    sl_free(context, out->steps);
    sl_free(context, out->bends);
    out->bends = NULL;
    out->mirrors = last->at.frame.depth;
    out->step_count = (uint32_t)s->steps.count;
    out->steps = sl_alloc_array(context, out->step_count, sizeof *out->steps);
    out->bends = sl_alloc_array(context, (size_t)out->mirrors + 2, sizeof *out->bends);
    if (!out->steps || !out->bends) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < out->step_count; i++) {
        const step *at = i + 1 < s->steps.count ? &s->steps.items[i + 1] : last;
        out->steps[i] = (sl_bent_step){at->directed, at->at.mirror, at->cell};
    }
    out->verdict = grazing ? SL_GRAZING : SL_STABBED;
    s->best = out->step_count;
    place_bends(s, last, s->options->solver->witness(s->solver));
    return SL_OK;
}

// --- the search

/// Whether the sequence has been in a cell since the last mirror: no line enters one twice.
static bool has_been_in(const search *s, uint32_t cell) {
    for (size_t i = s->steps.count; i-- > 0;) {
        if (s->steps.items[i].cell == cell) return true;
        if (s->steps.items[i].at.mirror != UINT32_MAX) return false;
    }
    return false;
}

static sl_status count_test(sl_context *context, search *s) {
    if (++s->out.tests % 64 == 0) SL_TRY(sl_check_cancelled(context));
    s->stopped = s->out.tests == s->options->most_tests;
    return SL_OK;
}

/// Tests the sequence with one step more, and goes there.
static sl_status try_step(sl_context *context, search *s, step *to) {
    const sl_solver *solver = s->options->solver;
    const step *from = last_step(s), *steps = s->steps.items;
    const uint32_t crossed = (uint32_t)s->steps.count;
    if (s->distance[to->cell] == SL_NO_WAY || crossed + s->distance[to->cell] >= s->best)
        return SL_OK;
    if (crossed + s->distance[to->cell] > s->bound) {
        s->cut = true;
        return SL_OK;
    }
    if (!sl_unfolded_may_cross(&steps[from->at.least].at.ends, &steps[from->at.most].at.ends,
                               &from->at, crossed, &to->at))
        return SL_OK;
    SL_TRY(count_test(context, s));
    sl_stab_verdict verdict;
    SL_TRY(solver->push(context, s->solver, to->at.ends.left, to->at.ends.right, &verdict));
    to->grazing = from->grazing || verdict == SL_GRAZING;
    const bool hidden = verdict == SL_HIDDEN || (to->grazing && s->options->sight == SL_OPEN);
    const bool found = !hidden && to->at.frame.depth && to->cell == s->to;
    const sl_status status = found ? note_found(context, s, to, to->grazing) : SL_OK;
    if (hidden || found) {
        solver->pop(s->solver);
        return status;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &s->steps, 1));
    s->steps.items[s->steps.count++] = *to;
    return SL_OK;
}

static sl_status try_portal(sl_context *context, search *s, uint32_t number) {
    const sl_directed_portal *directed = &s->space->directed[number];
    const sl_frame frame = last_step(s)->at.frame;
    if (has_been_in(s, directed->cell)) return SL_OK;
    const bool swaps = frame.depth % 2;
    step to = {.at = {.ends = sl_unfold(&frame, directed->left, directed->right, &s->out.rounded),
                      .frame = frame,
                      .mirror = UINT32_MAX},
               .place = {.left = swaps ? directed->right : directed->left,
                         .right = swaps ? directed->left : directed->right},
               .cell = directed->cell,
               .directed = number};
    return try_step(context, s, &to);
}

static sl_status try_mirror(sl_context *context, search *s, uint32_t number) {
    const sl_mirror_side *side = &s->sides.sides[number];
    const sl_unfolded from = last_step(s)->at;
    if (from.mirror == side->mirror || from.frame.depth == s->reflections) return SL_OK;
    const bool swaps = from.frame.depth % 2;
    step to = {.at = {.ends = sl_unfold(&from.frame, side->left, side->right, &s->out.rounded),
                      .frame = sl_frame_reflect(&from.frame, s->map->mirrors[side->mirror].segment),
                      .mirror = side->mirror},
               .place = {.left = swaps ? side->right : side->left,
                         .right = swaps ? side->left : side->right},
               .cell = side->cell,
               .directed = UINT32_MAX};
    return try_step(context, s, &to);
}

/// All sequences within the bound.
static sl_status search_within(sl_context *context, search *s) {
    s->steps.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &s->steps, 1));
    s->steps.items[s->steps.count++] =
        (step){.at = {.frame = sl_frame_of_map(), .mirror = UINT32_MAX}, .cell = s->from};
    while (s->steps.count && !s->stopped) {
        step *last = &s->steps.items[s->steps.count - 1];
        const sl_cell *cell = &s->space->cells[last->cell];
        const uint32_t first = s->sides.first[last->cell];
        const uint32_t mirrors = s->sides.first[last->cell + 1] - first, next = last->next++;
        if (next < cell->directed_count)
            SL_TRY(try_portal(context, s, cell->first_directed + next));
        else if (next < cell->directed_count + mirrors)
            SL_TRY(try_mirror(context, s, first + next - cell->directed_count));
        else if (--s->steps.count)
            s->options->solver->pop(s->solver);
    }
    return SL_OK;
}

static sl_status search_all(sl_context *context, search *s, uint32_t depth) {
    if (s->distance[s->from] == SL_NO_WAY) return SL_OK;
    for (s->reflections = 1; s->reflections <= depth && s->best == UINT32_MAX; s->reflections++) {
        s->cut = true;
        for (s->bound = s->distance[s->from] + 1; s->cut && !s->stopped && s->best == UINT32_MAX;
             s->bound *= 2) {
            s->cut = false;
            SL_TRY(search_within(context, s));
        }
    }
    s->out.complete = !s->stopped;
    return SL_OK;
}

sl_status sl_explain_by_mirror(sl_context *context, const sl_space *space, const sl_map *map,
                               const sl_explain_options *options, uint32_t depth,
                               sl_explanation *explanation) {
    search s = {.space = space,
                .map = map,
                .options = options,
                .from = explanation->from,
                .to = explanation->to,
                .best = UINT32_MAX,
                .out = {.asked = true, .complete = true, .verdict = SL_HIDDEN}};
    sl_status status = sl_find_distances(context, space, s.to, &s.distance);
    if (status == SL_OK) status = sl_mirror_sides_find(context, space, map, &s.sides);
    if (status == SL_OK) status = options->solver->create(context, space->bounds, &s.solver);
    if (status == SL_OK) status = search_all(context, &s, depth);
    if (s.solver) options->solver->destroy(context, s.solver);
    sl_mirror_sides_destroy(context, &s.sides);
    sl_free(context, s.distance);
    sl_free(context, s.steps.items);
    if (status == SL_OK) {
        explanation->bent = s.out;
    } else {
        sl_free(context, s.out.steps);
        sl_free(context, s.out.bends);
    }
    return status;
}
