/// Finds the sightline with the fewest mirrors, and of these one over few portals, to be explained.
///
/// The search runs once for each number of reflections: 1, then 2, and so on. As in explain.c it
/// has a bound on the number of portals and mirrors crossed, which is doubled until a line is found
/// or nothing is left beyond the bound. In mirrored space the line is straight. Its bends in the
/// map are where it crosses the mirrors.
#include "cell_to_cell/explain/explain_line.h"
#include "cell_to_cell/search/directions.h"
#include "cell_to_cell/search/portal_search.h"
#include "effects/mirrors.h"
#include "geometry/length.h"
#include "sightline/explain.h"
#include "sightline/support.h"
#include "stab/funnel.h"

#include <math.h>

typedef struct step {
    sli_portal_step at;
    sli_unfolded place;        ///< where mirrored space has what was crossed last
    sl_directed_portal of_map; ///< where the map has it; ends named as those unfolded
    uint32_t directed;
    bool grazing;
} step;

typedef struct search {
    const sl_map *map;
    const sl_explain_options *options;
    sli_portal_search search; ///< stops where most_tests is reached
    uint32_t *distance;
    sli_mirror_sides sides;
    uint32_t from, to, reflections, bound;
    uint32_t best; ///< crossed by the shortest found; UINT32_MAX for none
    bool cut;
    sl_bent_sightline out;
} search;

// --- what is found

static sl_point between(const sl_directed_portal *directed, double share) {
    return (sl_point){directed->left.x + share * (directed->right.x - directed->left.x),
                      directed->left.y + share * (directed->right.y - directed->left.y)};
}

/// Where the line turns, in the map: a mirror is crossed at the same share of it as its image.
/// `last` stands behind the steps of the way.
static void place_bends(const search *s, const step *last, sl_line line) {
    const sl_space *space = s->search.space;
    const sli_mirror_frame *f = &last->place.frame;
    const double x = line.b.x - line.a.x, y = line.b.y - line.a.y, length = sli_length(x, y);
    const sl_point back = {-x / length, -y / length};
    // Frames keep lengths: back from one is by its transpose.
    const sl_point on = {(f->xx * x + f->yx * y) / length, (f->xy * x + f->yy * y) / length};
    sl_point *bends = s->out.bends;
    uint32_t count = 1;
    for (const step *at = (const step *)s->search.steps + 1; at <= last; at++) {
        const sl_point crossed = between(&at->of_map, sli_share_of_portal(&at->place.ends, line));
        if (at - 1 == (const step *)s->search.steps)
            bends[0] = sli_halfway_into(space, s->from, crossed, back);
        if (at->place.mirror != UINT32_MAX) bends[count++] = crossed;
        if (at == last) bends[count] = sli_halfway_into(space, s->to, crossed, on);
    }
}

static sl_status note_found(sl_context *context, search *s, const step *last) {
    const step *steps = s->search.steps;
    sl_bent_sightline *out = &s->out;
    sl_free(context, out->steps);
    sl_free(context, out->bends);
    out->bends = NULL;
    out->mirrors = last->place.frame.depth;
    out->step_count = (uint32_t)s->search.count;
    out->steps = sl_alloc_array(context, out->step_count, sizeof *out->steps);
    out->bends = sl_alloc_array(context, (size_t)out->mirrors + 2, sizeof *out->bends);
    if (!out->steps || !out->bends) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < out->step_count; i++)
        out->steps[i] =
            (sl_bent_step){steps[i + 1].directed, steps[i + 1].place.mirror, steps[i + 1].at.cell};
    out->verdict = last->grazing ? SL_GRAZING : SL_STABBED;
    if (s->options->range > 0) out->length = sli_funnel_shortest(s->search.solver_state);
    s->best = out->step_count;
    place_bends(s, last, s->search.solver->witness(s->search.solver_state));
    return SL_OK;
}

// --- the search

/// Whether the sequence has been in a cell since the last mirror: no line enters one twice.
static bool has_been_in(const search *s, uint32_t cell) {
    const step *steps = s->search.steps;
    for (size_t i = s->search.count; i-- > 0;) {
        if (steps[i].at.cell == cell) return true;
        if (steps[i].place.mirror != UINT32_MAX) return false;
    }
    return false;
}

static sl_status count_test(sl_context *context, search *s) {
    if (++s->out.tests % 64 == 0) SL_TRY(sl_check_cancelled(context));
    s->search.stop = s->out.tests == s->options->most_tests;
    return SL_OK;
}

/// As in a bake: whether the middle line keeps clear of all rounded ends.
static bool is_certain(const search *s, const step *to) {
    const sl_box b = s->search.space->bounds;
    const double size =
        fmax(fmax(fabs(b.min.x), fabs(b.max.x)), fmax(fabs(b.min.y), fabs(b.max.y)));
    const sl_line line = s->search.solver->witness(s->search.solver_state);
    for (const step *at = (const step *)s->search.steps + 1; at <= to; at++)
        if (at[-1].place.frame.rounded &&
            !sli_unfolded_is_clear(&at[-1].place.frame, &at->place.ends, line.a, line.b, size))
            return false;
    return true;
}

/// Tests the sequence with one step more, and goes there.
static sl_status try_step(sl_context *context, search *s, const step *from, step *to) {
    const step *steps = s->search.steps;
    const uint32_t crossed = (uint32_t)s->search.count, cell = to->at.cell;
    if (s->distance[cell] == SL_NO_WAY || crossed + s->distance[cell] >= s->best) return SL_OK;
    if (crossed + s->distance[cell] > s->bound) {
        s->cut = true;
        return SL_OK;
    }
    if (!sli_unfolded_may_cross(&steps[from->place.least].place.ends,
                                &steps[from->place.most].place.ends, &from->place, crossed,
                                &to->place))
        return SL_OK;
    SL_TRY(count_test(context, s));
    sl_stab_verdict verdict;
    SL_TRY(sli_portal_search_push(context, &s->search, to->place.ends.left, to->place.ends.right,
                                  &verdict));
    if (verdict == SL_STABBED && from->place.frame.rounded && s->options->sight == SL_OPEN &&
        !is_certain(s, to))
        verdict = SL_GRAZING;
    to->grazing = from->grazing || verdict == SL_GRAZING;
    const bool hidden = verdict == SL_HIDDEN || (to->grazing && s->options->sight == SL_OPEN) ||
                        !sli_explain_in_range(s->options, s->search.solver_state);
    const bool found = !hidden && to->place.frame.depth && cell == s->to;
    const sl_status status = found ? note_found(context, s, to) : SL_OK;
    if (hidden || found)
        sli_portal_search_pop(&s->search);
    else
        s->search.count++;
    return status;
}

/// A step over a piece of the map, by the frame of the step before.
static step make_step(search *s, const step *from, uint32_t cell, sl_point left, sl_point right) {
    const bool swaps = from->place.frame.depth % 2;
    return (step){.at.cell = cell,
                  .place = {.ends = sli_unfold(&from->place.frame, left, right, &s->out.rounded),
                            .frame = from->place.frame,
                            .mirror = UINT32_MAX},
                  .of_map = {.left = swaps ? right : left, .right = swaps ? left : right},
                  .directed = UINT32_MAX};
}

static sl_status cross(sl_context *context, void *job, const void *last, void *next,
                       uint32_t number) {
    search *s = job;
    step *to = next;
    const sl_directed_portal *directed = &s->search.space->directed[number];
    if (has_been_in(s, directed->cell)) return SL_OK;
    *to = make_step(s, last, directed->cell, directed->left, directed->right);
    to->directed = number;
    return try_step(context, s, last, to);
}

static sl_status reflect(sl_context *context, void *job, const void *last, void *next,
                         uint32_t number) {
    search *s = job;
    const step *from = last;
    step *to = next;
    const sli_mirror_side *side = &s->sides.sides[number];
    const sl_segment mirror = s->map->mirrors[side->mirror].segment;
    if (from->place.mirror == side->mirror || from->place.frame.depth == s->reflections)
        return SL_OK;
    *to = make_step(s, from, side->cell, side->left, side->right);
    to->place.frame = sli_mirror_frame_reflect(&from->place.frame, mirror);
    to->place.mirror = side->mirror;
    return try_step(context, s, from, to);
}

/// All sequences within the bound.
static sl_status search_within(sl_context *context, search *s) {
    static const sli_portal_visitor visitor = {
        .step_size = sizeof(step), .cross = cross, .reflect = reflect};
    SL_TRY(sli_portal_search_start(context, &s->search, sizeof(step)));
    step *first = s->search.steps;
    *first = (step){.at.cell = s->from,
                    .place = {.frame = sli_mirror_frame_of_map(), .mirror = UINT32_MAX}};
    s->search.count++;
    return sli_portal_search_run(context, &s->search, &visitor, s);
}

static sl_status search_all(sl_context *context, search *s, uint32_t depth) {
    if (s->distance[s->from] == SL_NO_WAY) return SL_OK;
    for (s->reflections = 1; s->reflections <= depth && s->best == UINT32_MAX; s->reflections++) {
        s->cut = true;
        for (s->bound = s->distance[s->from] + 1;
             s->cut && !s->search.stop && s->best == UINT32_MAX; s->bound *= 2) {
            s->cut = false;
            SL_TRY(search_within(context, s));
        }
    }
    s->out.complete = !s->search.stop;
    return SL_OK;
}

sl_status sl_explain_by_mirror(sl_context *context, const sl_space *space, const sl_map *map,
                               const sl_explain_options *options, uint32_t depth,
                               sl_explanation *explanation) {
    search s = {.map = map,
                .options = options,
                .search = {.space = space, .solver = options->solver},
                .from = explanation->from,
                .to = explanation->to,
                .best = UINT32_MAX,
                .out = {.asked = true, .complete = true, .verdict = SL_HIDDEN}};
    sl_status status = sli_find_distances(context, space, s.to, &s.distance);
    if (status == SL_OK) status = sli_mirror_sides_find(context, space, map, &s.sides);
    s.search.mirrors = &s.sides;
    if (status == SL_OK)
        status = options->solver->create(context, space->bounds, &s.search.solver_state);
    if (status == SL_OK) status = search_all(context, &s, depth);
    sli_portal_search_end(context, &s.search);
    sli_mirror_sides_destroy(context, &s.sides);
    sl_free(context, s.distance);
    if (status == SL_OK) {
        explanation->bent = s.out;
    } else {
        sl_free(context, s.out.steps);
        sl_free(context, s.out.bends);
    }
    return status;
}
