/// Placement among listed places, for listed targets: both are finite, so it is a set cover.
///
/// Who sees whom is asked once for each point of a place: its look holds the targets that are in
/// the region of a full turn. Field of view and range take some of them away, exactly.
#include "sightline/place.h"

#include "analysis/placement/looks.h"
#include "analysis/placement/view_shapes.h"
#include "geometry/orient.h"
#include "sightline/support.h"

typedef struct lister {
    sl_context *context;
    sl_query *query;
    const sl_place_list *list;
    sl_region memory;
    sl_box bounds;
    SL_ARRAY(uint32_t) entries;
    size_t *ends;
    uint32_t *demands, *costs; ///< demands: what the fixed places leave
    bool *fixed;
    SL_ARRAY(uint32_t) around; ///< targets that the point at hand sees all round
    sl_placement *out;
} lister;

static uint32_t demand_of(const sl_place_list *list, uint32_t target) {
    return list->demands ? list->demands[target] : 1;
}

/// The targets that a point sees, all round.
static sl_status look_around(lister *l, sl_point at) {
    sli_look look;
    bool clean;
    l->around.count = 0;
    SL_TRY(sli_look_make(l->context, l->query, &l->memory, at, &look, &clean));
    sl_status status = SL_ARRAY_ROOM(l->context, &l->around, l->list->target_count);
    for (uint32_t t = 0; status == SL_OK && t < l->list->target_count; t++) {
        const sl_point target = l->list->targets[t];
        bool sees = clean && sli_box_holds(&look.bounds, target) && sli_look_holds(&look, target);
        if (!clean) status = sl_query_sees(l->context, l->query, at, target, &sees);
        if (sees) l->around.items[l->around.count++] = t;
    }
    sli_look_destroy(l->context, &look);
    return status;
}

static sl_status add_column(lister *l, uint32_t number) {
    const sl_viewpoint *place = &l->list->places[number];
    const double reach = l->bounds.max.x - l->bounds.min.x + l->bounds.max.y - l->bounds.min.y;
    const sl_view view = place->fov >= 360
                             ? sl_view_all_round(place->at)
                             : sl_view_cone(place->at, place->heading, place->fov, reach);
    const bool moved = number == 0 || !sli_same_point(l->list->places[number - 1].at, place->at);
    if (moved) SL_TRY(look_around(l, place->at));
    SL_TRY(SL_ARRAY_ROOM(l->context, &l->entries, l->around.count));
    for (size_t i = 0; i < l->around.count; i++)
        if (sli_viewpoint_holds(place, &view, l->list->targets[l->around.items[i]]))
            l->entries.items[l->entries.count++] = l->around.items[i];
    l->ends[number] = l->entries.count;
    return SL_OK;
}

static sl_status list_columns(lister *l) {
    const sl_space *space;
    SL_TRY(sl_query_space(l->context, l->query, &space, NULL));
    l->bounds = space->bounds;
    for (uint32_t i = 0; i < l->list->place_count; i++) {
        if (i % 64 == 0) SL_TRY(sl_check_cancelled(l->context));
        SL_TRY(add_column(l, i));
    }
    return SL_OK;
}

/// Fixed places leave other demands; their columns are not to be chosen.
static void take_fixed(lister *l) {
    size_t at = 0, to = 0;
    for (uint32_t t = 0; t < l->list->target_count; t++) l->demands[t] = demand_of(l->list, t);
    for (uint32_t i = 0; i < l->list->fixed_count; i++) l->fixed[l->list->fixed[i]] = true;
    for (uint32_t i = 0; i < l->list->place_count; i++) {
        for (; at < l->ends[i]; at++) {
            const uint32_t target = l->entries.items[at];
            if (!l->fixed[i])
                l->entries.items[to++] = target;
            else if (l->demands[target])
                l->demands[target]--;
        }
        l->ends[i] = to;
        l->costs[i] = l->list->costs ? l->list->costs[i] : 1;
    }
    l->entries.count = to;
}

/// A target that too few places see.
static sl_status check_targets(lister *l) {
    uint32_t *seers = sl_alloc_array(l->context, l->list->target_count, sizeof *seers);
    if (!seers) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (size_t i = 0; i < l->entries.count; i++) seers[l->entries.items[i]]++;
    for (uint32_t t = 0; status == SL_OK && t < l->list->target_count; t++)
        if (seers[t] < l->demands[t]) {
            const sl_point at = l->list->targets[t];
            const int digits = sl_map_digits(sl_query_map(l->query));
            status = sl_fail(
                l->context, SL_BAD_ARGUMENT,
                "target %u at (%.*g, %.*g): %u more must see it, and %u of the other places do",
                t + 1, digits, at.x, digits, at.y, l->demands[t], seers[t]);
        }
    sl_free(l->context, seers);
    return status;
}

static sl_status keep(lister *l, const sl_cover_result *cover) {
    sl_placement *out = l->out;
    const sl_place_list *list = l->list;
    out->viewpoints =
        sl_alloc_array(l->context, cover->count + list->fixed_count, sizeof *out->viewpoints);
    if (!out->viewpoints) return SL_NO_MEMORY;
    uint32_t next = 0;
    out->lower = cover->lower;
    out->upper = cover->cost;
    for (uint32_t i = 0; i < list->place_count; i++) {
        const bool chosen = next < cover->count && cover->columns[next] == i;
        next += chosen;
        if (!chosen && !l->fixed[i]) continue;
        out->viewpoints[out->count++] = list->places[i];
        out->lower += l->fixed[i] ? l->costs[i] : 0;
        out->upper += l->fixed[i] ? l->costs[i] : 0;
    }
    return SL_OK;
}

/// The fewest places, or the cheapest.
static sl_status find_fewest(lister *l, const sl_cover_problem *problem,
                             const sl_cover_options *options, sl_cover_result *cover) {
    SL_TRY(check_targets(l));
    const sl_status status = sl_cover_solve(l->context, problem, options, cover);
    if (status != SL_OK && status != SL_CANCELLED) return status;
    if (cover->columns || status == SL_OK) SL_TRY(keep(l, cover));
    return status;
}

/// The most weight that so many places see.
static sl_status find_most(lister *l, sl_cover_problem problem, const sl_cover_options *options,
                           sl_cover_result *cover) {
    const sl_place_list *list = l->list;
    double *weights = sl_alloc_array(l->context, list->target_count, sizeof *weights);
    double seen = 0, covered = 0, bound = 0;
    if (!weights) return SL_NO_MEMORY;
    for (uint32_t t = 0; t < list->target_count; t++) {
        weights[t] = list->weights ? list->weights[t] : 1;
        if (l->demands[t]) continue;
        seen += weights[t];
        weights[t] = 0;
    }
    problem.demands = NULL;
    problem.costs = NULL;
    const sl_status status =
        sl_cover_most(l->context, &problem, weights, list->count, options, cover, &covered, &bound);
    sl_free(l->context, weights);
    if (status != SL_OK && status != SL_CANCELLED) return status;
    SL_TRY(keep(l, cover));
    l->out->lower = l->out->upper = l->out->count;
    l->out->seen = seen + covered;
    l->out->seen_bound = seen + bound;
    return status;
}

static sl_status check_list(sl_context *context, const sl_place_list *list) {
    SL_TRY(sli_refuse_signs(context, list->places, list->place_count, "placement"));
    for (uint32_t i = 0; i < list->place_count; i++) {
        const sl_viewpoint *p = &list->places[i];
        if (!(p->fov > 0) || !isfinite(p->heading) || !(p->range >= 0) || !isfinite(p->range))
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "place %u: its field of view must be more than 0, its range 0 or more",
                           i + 1);
        if (list->costs && !list->costs[i])
            return sl_fail(context, SL_BAD_ARGUMENT, "place %u: its cost must be 1 or more", i + 1);
    }
    for (uint32_t i = 0; i < list->fixed_count; i++)
        if (list->fixed[i] >= list->place_count)
            return sl_fail(context, SL_BAD_ARGUMENT, "fixed place %u of %u places",
                           list->fixed[i] + 1, list->place_count);
    if (list->count && list->demands)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the most that a number of places sees: without demands");
    return SL_OK;
}

static sl_status solve(lister *l, const sl_place_options *options) {
    SL_TRY(list_columns(l));
    take_fixed(l);
    const sl_cover_problem problem = {.row_count = l->list->target_count,
                                      .column_count = l->list->place_count,
                                      .ends = l->ends,
                                      .entries = l->entries.items,
                                      .costs = l->costs,
                                      .demands = l->demands};
    sl_cover_options cover_options = sl_cover_options_default();
    cover_options.program = options->program;
    cover_options.nodes = options->nodes;
    sl_cover_result cover = {0};
    const sl_status status = l->list->count ? find_most(l, problem, &cover_options, &cover)
                                            : find_fewest(l, &problem, &cover_options, &cover);
    if (l->out->viewpoints) {
        l->out->proof = cover.proof;
        l->out->columns = problem;
        cover.proof = (sl_cover_proof){0};
        l->ends = NULL;
        l->entries.items = NULL;
        l->costs = l->demands = NULL;
    }
    sl_cover_result_destroy(l->context, &cover);
    return status;
}

sl_status sl_place_among(sl_context *context, sl_query *query, const sl_place_list *list,
                         const sl_place_options *options, sl_placement *out) {
    const sl_place_options usual = sl_place_options_default();
    sl_placement made = {0};
    SL_TRY(check_list(context, list));
    lister l = {.context = context, .query = query, .list = list, .out = &made};
    l.ends = sl_alloc_array(context, list->place_count, sizeof *l.ends);
    l.costs = sl_alloc_array(context, list->place_count, sizeof *l.costs);
    l.fixed = sl_alloc_array(context, list->place_count, sizeof *l.fixed);
    l.demands = sl_alloc_array(context, list->target_count, sizeof *l.demands);
    sl_status status = l.ends && l.costs && l.fixed && l.demands ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = solve(&l, options ? options : &usual);
    sl_region_destroy(context, &l.memory);
    sl_free(context, l.ends);
    sl_free(context, l.costs);
    sl_free(context, l.fixed);
    sl_free(context, l.demands);
    sl_free(context, l.entries.items);
    sl_free(context, l.around.items);
    if (status == SL_OK || (status == SL_CANCELLED && made.viewpoints))
        *out = made;
    else
        sl_placement_destroy(context, &made);
    return status;
}
