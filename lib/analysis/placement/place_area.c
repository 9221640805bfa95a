/// Placement of cameras for an area: the cheapest of the given places that see all of it.
///
/// 1. Witnesses near corners and on a grid. Places are added greedily until they see all of them.
/// 2. What these places leave unseen of the area gives more witnesses (area_check.c), and these
///    more places, until nothing is left: the first upper bound.
/// 3. The cheapest places that see all witnesses, by set cover: the lower bound. What they leave
///    gives more witnesses; more places complete them, maybe to a better upper bound. Again, until
///    they leave nothing.
///
/// For a network, chosen places are joined before they are checked, rows of a set cover that is
/// none are added beside witnesses (area_network.c), and what sees everything is bettered by local
/// search (area_network_search.c).
///
/// While places are completed, local search betters them, so that few witnesses are added by each
/// round. The first set cover goes without a tree. Rows are only added, so each bound holds.
#include "analysis/placement/place_area.h"

#include "analysis/placement/cover.h"
#include "geometry/orient.h"

#include <math.h>
#include <string.h>

/// The share of the area that is rounding.
#define NEGLIGIBLE 1e-9

/// Without a better bound for NETWORK_ROUNDS, no more rows of a network are sought.
enum { NETWORK_ROUNDS = 20 };
/// Longer local searches, at most, while places are completed once.
enum { SEARCHES = 8 };
/// With more than one new witness for so much cost, a set leaves much.
enum { COST_PER_WITNESS = 2 };
enum {
    ROUNDS = 400,
    COARSE_ITERATIONS = 20000,
    SET_ITERATIONS = 200000, // before the first exact bound, which they would keep waiting
    LONG_ITERATIONS = 1000000,
    SEARCH_ITERATIONS = 20000,
    SEARCH_LEAST = 300
};
/// Entries that a local search may touch, about.
#define SEARCH_WORK 2e8
/// Iterations of a local search times places, before the first exact bound.
#define SET_WORK 1.28e9

static sl_status check_task(sl_context *context, const sl_place_area *t) {
    SL_TRY(sli_check_viewpoints(context, t->places, t->place_count));
    SL_TRY(sli_refuse_signs(context, t->places, t->place_count, "placement"));
    if (!t->place_count) return sl_fail(context, SL_BAD_ARGUMENT, "there is no place to choose");
    if (t->place_count >= SLI_WIDE)
        return sl_fail(context, SL_BAD_ARGUMENT, "%u places are too many", t->place_count);
    for (uint32_t i = 0; t->costs && i < t->place_count; i++)
        if (!t->costs[i])
            return sl_fail(context, SL_BAD_ARGUMENT, "place %u: its cost must be 1 or more", i + 1);
    for (uint32_t i = 0; i < t->fixed_count; i++)
        if (t->fixed[i] >= t->place_count || (i && t->fixed[i] <= t->fixed[i - 1]))
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "fixed places must ascend and be among the %u places", t->place_count);
    if (!(t->scan_angle >= 0 && t->scan_angle < 90) || !(t->scan_range >= 0) ||
        !isfinite(t->scan_range))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "walls are seen under 0 to less than 90 degrees, and from 0 or more");
    for (uint32_t i = 0; i < t->zone_count; i++)
        if (!(t->weights[i] > 0) || !isfinite(t->weights[i]))
            return sl_fail(context, SL_BAD_ARGUMENT, "zone %u: its weight must be over 0", i + 1);
    if (t->zone_count && (!t->count || t->scan_angle > 0 || t->scan_range > 0))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "weights are for the most area that a number of places sees");
    for (uint32_t i = 0; t->line_weights && i < t->line_count; i++)
        if (!(t->line_weights[i] > 0) || !isfinite(t->line_weights[i]))
            return sl_fail(context, SL_BAD_ARGUMENT, "line %u: its weight must be over 0", i + 1);
    if (t->line_count && (t->scan_angle > 0 || t->scan_range > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "lines are not seen with scans of walls");
    if (t->line_count && t->count && t->see)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the most that a number of places sees is of an area or of lines, not both");
    if (t->count && t->network)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a network sees everything: not the most that a number of places sees");
    if (t->count && t->cover > 1)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the most that a number of places sees: by one of them, not by several");
    return SL_OK;
}

static sl_status check_map(sl_context *context, sl_query *query) {
    const sl_map *map = sl_query_map(query);
    if (map && map->mirror_count)
        return sl_fail(context, SL_UNSUPPORTED, "placement knows no mirrors: leave them out");
    return SL_OK;
}

// --- the area and the places

sl_status sli_shape_common(sl_context *context, const sl_shape *one, const sl_shape *other,
                           sl_shape *out) {
    const sl_shape both[2] = {*one, *other};
    sl_overlay overlay;
    SL_TRY(sl_overlay_make(context, NULL, both, 2, &overlay));
    const sl_status status = sl_overlay_outline(context, &overlay, 2, out);
    sl_overlay_destroy(context, &overlay);
    return status;
}

/// What is inside, or what of it is to be seen.
static sl_status make_target(sli_area *a) {
    SL_TRY(sl_shape_of_inside(a->context, a->space, &a->target));
    sl_overlay overlay;
    if (a->task->see) {
        sl_shape inside = a->target;
        a->target = (sl_shape){0};
        const sl_status status = sli_shape_common(a->context, &inside, a->task->see, &a->target);
        sl_shape_destroy(a->context, &inside);
        SL_TRY(status);
    }
    SL_TRY(sl_overlay_make(a->context, &a->target, NULL, 0, &overlay));
    if (a->target.count) a->out->area = overlay.areas[0];
    sl_overlay_destroy(a->context, &overlay);
    a->negligible = NEGLIGIBLE * a->out->area;
    return a->out->area > 0 ? SL_OK
                            : sl_fail(a->context, SL_BAD_ARGUMENT, "nothing is to be seen inside");
}

/// Whether a point is on a side of its cell, so it may see one side of a wall only.
static bool is_on_edge(const sl_space *space, sl_point at) {
    const uint32_t number = sl_space_locate(space, at);
    if (number == SL_NO_CELL) return true;
    const sl_cell *cell = &space->cells[number];
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point *v = space->vertices + cell->first_vertex;
        if (sli_orient(v[i], v[i + 1 < cell->vertex_count ? i + 1 : 0], at) == 0) return true;
    }
    return false;
}

static sl_status add_place(sli_area *a, uint32_t i) {
    const sl_viewpoint *place = &a->task->places[i];
    SL_TRY(sli_view_shapes_add(a->context, a->query, place, &a->region, &a->shapes));
    a->views[i] = place->fov >= 360
                      ? sl_view_all_round(place->at)
                      : sl_query_view(a->query, place->at, place->heading, place->fov);
    a->ranges[i] = sli_view_range(a->query, place);
    const sl_shape shape = sli_view_shape(&a->shapes, i + 1);
    sl_box box = {place->at, place->at};
    for (size_t k = 0; shape.count && k < shape.ends[shape.count - 1]; k++) {
        const sl_point p = shape.points[k];
        box.min = (sl_point){fmin(box.min.x, p.x), fmin(box.min.y, p.y)};
        box.max = (sl_point){fmax(box.max.x, p.x), fmax(box.max.y, p.y)};
    }
    a->boxes[i] = box;
    if (i && sli_same_point(place->at, a->task->places[i - 1].at) &&
        a->ranges[i] == a->ranges[i - 1]) {
        a->groups[a->group_count] = i + 1;
        return SL_OK;
    }
    a->on_edge[a->group_count] = is_on_edge(a->space, place->at);
    a->groups[a->group_count++] = i;
    a->groups[a->group_count] = i + 1;
    return SL_OK;
}

int sli_blind_spots_compare(const void *left, const void *right) {
    const sl_blind_spot *a = left, *b = right;
    if (a->area != b->area) return a->area > b->area ? -1 : 1;
    return sli_compare_points(a->at, b->at);
}

/// The places to choose from as shapes and views, and the area.
static sl_status begin(sli_area *a) {
    const uint32_t count = a->task->place_count;
    SL_TRY(sl_query_space(a->context, a->query, &a->space, NULL));
    a->directed = sl_query_map(a->query) && sl_query_map(a->query)->oneway_count;
    a->cover = a->task->cover ? a->task->cover : 1;
    SL_TRY(make_target(a));
    a->views = sl_alloc_array(a->context, count, sizeof *a->views);
    a->boxes = sl_alloc_array(a->context, count, sizeof *a->boxes);
    a->ranges = sl_alloc_array(a->context, count, sizeof *a->ranges);
    a->groups = sl_alloc_array(a->context, (size_t)count + 1, sizeof *a->groups);
    a->on_edge = sl_alloc_array(a->context, count, sizeof *a->on_edge);
    a->fixed = sl_alloc_array(a->context, count, sizeof *a->fixed);
    if (!a->views || !a->boxes || !a->ranges || !a->groups || !a->on_edge || !a->fixed)
        return SL_NO_MEMORY;
    for (uint32_t i = 0; i < a->task->fixed_count; i++) a->fixed[a->task->fixed[i]] = true;
    SL_TRY(sli_view_shapes_add_walls(a->context, a->space, &a->shapes));
    for (uint32_t i = 0; i < count; i++) {
        if (i % 64 == 0) {
            SL_TRY(sl_check_cancelled(a->context));
            sl_report(a->context, "views", "places", i, count);
        }
        SL_TRY(add_place(a, i));
    }
    return a->task->network ? sli_network_begin(a) : SL_OK;
}

static void end(sli_area *a) {
    sl_shape_destroy(a->context, &a->target);
    sl_region_destroy(a->context, &a->region);
    sli_view_shapes_destroy(a->context, &a->shapes);
    sl_free(a->context, a->views);
    sl_free(a->context, a->boxes);
    sl_free(a->context, a->ranges);
    sl_free(a->context, a->groups);
    sl_free(a->context, a->on_edge);
    sl_free(a->context, a->fixed);
    sl_free(a->context, a->witnesses.items);
    sl_free(a->context, a->row_ends.items);
    sl_free(a->context, a->entries.items);
    sl_free(a->context, a->row.items);
    sl_free(a->context, a->lengths.items);
    sl_free(a->context, a->seers.items);
    sli_network_end(a);
}

// --- the search

typedef struct finder {
    sli_area *a;
    uint8_t *now, *best; ///< by place
    bool complete;       ///< `best` sees all that can be seen
    bool filled;         ///< so does `now`, by the last check of it
    bool fine;           ///< set covers with trees
    uint64_t gap;        ///< between the bounds, when it last closed
    uint32_t since;      ///< rounds since then
} finder;

static uint64_t cost_of(const sli_area *a, const uint8_t *chosen) {
    uint64_t cost = 0;
    for (uint32_t i = 0; i < a->task->place_count; i++)
        if (chosen[i]) cost += a->task->costs ? a->task->costs[i] : 1;
    return cost;
}

static uint64_t fixed_cost(const sli_area *a) {
    uint64_t cost = 0;
    for (uint32_t i = 0; i < a->task->fixed_count; i++)
        cost += a->task->costs ? a->task->costs[a->task->fixed[i]] : 1;
    return cost;
}

/// Iterations of the local search: fewer where each costs more, by the rows of a column and the
/// columns of a row.
static uint64_t iterations_for(const sl_cover_problem *p) {
    const double entries = (double)p->ends[p->column_count - 1];
    const double each = entries * entries / ((double)p->column_count * p->row_count + 1);
    return (uint64_t)fmax(SEARCH_LEAST, fmin(SEARCH_ITERATIONS, SEARCH_WORK / (each + 1)));
}

/// Adds places to `now` until it sees all witnesses, then betters it, but not at first.
static sl_status take_more(finder *f, bool at_first) {
    sli_area *a = f->a;
    sl_cover_problem problem = {0};
    sli_cover cover = {0};
    if (a->task->network) SL_TRY(sli_network_rule_out(a));
    sl_status status = sli_area_problem(a, false, &problem);
    if (status == SL_OK) status = sli_cover_read(a->context, &problem, 1, &cover);
    if (status == SL_OK) status = sli_cover_greedy(a->context, &cover, NULL, NULL, f->now);
    const uint64_t fixed = fixed_cost(a);
    if (status == SL_OK && !at_first)
        status =
            sli_cover_search(a->context, &cover, a->out->lower > fixed ? a->out->lower - fixed : 0,
                             iterations_for(&problem), f->now);
    for (uint32_t i = 0; i < a->task->place_count; i++) f->now[i] |= a->fixed[i];
    sli_cover_destroy(a->context, &cover);
    sli_area_problem_destroy(a->context, &problem);
    return status;
}

/// Keeps `now` if it sees all, and is the best so far.
static sl_status keep(finder *f) {
    sli_area *a = f->a;
    sl_area_placement *out = a->out;
    const uint64_t cost = cost_of(a, f->now);
    if (!f->filled || (f->complete && cost >= out->upper)) return SL_OK;
    uint32_t *chosen = sl_alloc_array(a->context, a->task->place_count, sizeof *chosen);
    if (!chosen) return SL_NO_MEMORY;
    sl_free(a->context, out->chosen);
    out->chosen = chosen;
    out->count = 0;
    for (uint32_t i = 0; i < a->task->place_count; i++)
        if (f->now[i]) chosen[out->count++] = i;
    memcpy(f->best, f->now, a->task->place_count);
    out->upper = cost;
    f->complete = true;
    return SL_OK;
}

/// Keeps the proof of a lower bound that is better than those before it. Takes both.
static sl_status keep_proof(sli_area *a, sl_cover_problem *problem, sl_cover_proof *proof) {
    sl_area_placement *out = a->out;
    const size_t count = a->witnesses.count;
    sl_point *witnesses = sl_alloc_array(a->context, count, sizeof *witnesses);
    if (!witnesses) return SL_NO_MEMORY;
    if (count) memcpy(witnesses, a->witnesses.items, count * sizeof *witnesses);
    sl_free(a->context, out->witnesses);
    sli_area_problem_destroy(a->context, &out->columns);
    sli_cover_proof_destroy(a->context, &out->proof);
    out->witnesses = witnesses;
    out->columns = *problem;
    out->columns.costs = NULL;
    out->proof = *proof;
    *problem = (sl_cover_problem){0};
    *proof = (sl_cover_proof){0};
    return SL_OK;
}

/// What a set cover is for: a set and a bound; a bound with wide entries; a set, by search alone.
typedef enum choice { BOTH, WIDE, SETS } choice;

/// The cheapest places that see all witnesses, into `now`, or with WIDE nowhere; betters the
/// lower bound. Where ranges are not the true ones, they give none.
static sl_status choose(finder *f, choice what) {
    sli_area *a = f->a;
    const bool wide = what == WIDE, fine = f->fine && what != SETS;
    const uint64_t fixed = fixed_cost(a);
    sl_cover_options options = sl_cover_options_default();
    options.program = what == SETS ? NULL : a->options->program;
    options.nodes = fine ? a->options->nodes : 0;
    if (what == SETS)
        options.iterations = f->fine
                                 ? LONG_ITERATIONS
                                 : (uint64_t)fmin(SET_ITERATIONS, SET_WORK / a->task->place_count);
    if (what != SETS && !fine) options.iterations = COARSE_ITERATIONS;
    options.known_lower = a->out->lower > fixed ? a->out->lower - fixed : 0;
    sl_cover_problem problem = {0};
    sl_cover_result cover = {0};
    sl_status status = sli_area_problem(a, wide, &problem);
    uint32_t *start = sl_alloc_array(a->context, a->task->place_count, sizeof *start);
    if (!start) status = SL_NO_MEMORY;
    for (uint32_t i = 0; start && i < a->task->place_count; i++)
        if (f->best[i] && !a->fixed[i]) start[options.start_count++] = i;
    options.start = start;
    if (status == SL_OK) status = sl_cover_solve(a->context, &problem, &options, &cover);
    if ((status == SL_OK || (status == SL_CANCELLED && cover.columns)) &&
        (wide || !a->wide_count) && !a->network.is_rounded && cover.lower + fixed > a->out->lower) {
        a->out->lower = cover.lower + fixed;
        const sl_status kept = keep_proof(a, &problem, &cover.proof);
        if (kept != SL_OK) status = kept;
    }
    if (status == SL_OK && !wide) {
        for (uint32_t i = 0; i < a->task->place_count; i++) f->now[i] = a->fixed[i];
        for (uint32_t i = 0; i < cover.count; i++) f->now[cover.columns[i]] = 1;
    }
    sl_free(a->context, start);
    sl_cover_result_destroy(a->context, &cover);
    sli_area_problem_destroy(a->context, &problem);
    return status;
}

/// Adds witnesses and places until `now` leaves nothing. *clean: it left nothing at first. Where a
/// set leaves much, local search is slow to close in, so better sets come from linear programs, and
/// the last one is completed in haste.
static sl_status fill(finder *f, bool *clean) {
    uint32_t added;
    bool far = false;
    *clean = true;
    f->filled = false;
    for (int round = 0; round < ROUNDS; round++) {
        if (f->complete)
            sl_report(f->a->context, "place", "viewpoints", f->a->out->lower, f->a->out->upper);
        else
            sl_report(f->a->context, "place", "witnesses", f->a->witnesses.count, 0);
        if (f->a->task->network) SL_TRY(sli_network_join(f->a, f->now));
        SL_TRY(sli_area_check(f->a, f->now, &added));
        f->filled = !added;
        if (!added) break;
        *clean = false;
        const bool many = f->complete && !f->fine && !f->a->task->network &&
                          added > cost_of(f->a, f->now) / COST_PER_WITNESS;
        SL_TRY(many ? choose(f, BOTH) : take_more(f, far || !f->complete));
        far = far || many;
    }
    return far && f->a->wide_count ? choose(f, WIDE) : SL_OK;
}

/// Fills `now`, keeps it and betters it, as long as what is better sees everything in the end.
static sl_status complete(finder *f, bool *clean) {
    bool again;
    SL_TRY(fill(f, clean));
    SL_TRY(keep(f));
    for (int i = 0; i < SEARCHES; i++) {
        const uint64_t cost = cost_of(f->a, f->now);
        SL_TRY(f->a->task->network ? sli_network_search(f->a, f->now) : choose(f, SETS));
        if (cost_of(f->a, f->now) >= cost) return SL_OK;
        SL_TRY(fill(f, &again));
        SL_TRY(keep(f));
    }
    return SL_OK;
}

/// No place sees anything of the area: says where it is, and what could see it.
static sl_status refuse_blind(sli_area *a) {
    const sl_place_area *t = a->task;
    const sl_point at = a->out->blind[0].at;
    const char *const what = sli_area_has_only_lines(a) ? "lines" : "area";
    sl_point nearest;
    bool found;
    SL_TRY(sl_place_nearest(a->context, a->query, t->places, at, t->places, t->place_count,
                            &nearest, &found));
    if (!found)
        return sl_fail(a->context, SL_BAD_ARGUMENT,
                       "none of the %u places sees any of the %s, at (%.9g, %.9g)", t->place_count,
                       what, at.x, at.y);
    return sl_fail(a->context, SL_BAD_ARGUMENT,
                   "none of the %u places sees any of the %s, at (%.9g, %.9g); the nearest place "
                   "that could is at (%.9g, %.9g)",
                   t->place_count, what, at.x, at.y, nearest.x, nearest.y);
}

/// Whether the bounds have not closed in for long.
static bool is_stalled(finder *f) {
    const uint64_t gap = f->a->out->upper - f->a->out->lower;
    if (gap != f->gap) f->since = 0;
    f->gap = gap;
    return ++f->since > NETWORK_ROUNDS;
}

static sl_status add_first_rows(sli_area *a) {
    if (sli_area_scans(a)) return sli_area_walls(a);
    if (a->task->line_count) SL_TRY(sli_area_lines(a));
    return sli_area_has_only_lines(a) ? SL_OK : sli_area_first_witnesses(a);
}

/// The lower bound of all sets, networks or not: it holds for networks, and what these sets leave
/// unseen gives witnesses that networks do not ask for.
static sl_status bound_without_network(finder *f) {
    sli_area *a = f->a;
    const sl_place_area *task = a->task;
    sl_place_area plain = *task;
    uint64_t least = UINT64_MAX;
    sl_status status = SL_OK;
    bool clean = false;
    plain.network = false;
    a->task = &plain;
    for (int round = 0; status == SL_OK && round < ROUNDS && a->out->lower < least; round++) {
        status = choose(f, BOTH);
        if (status == SL_OK) status = fill(f, &clean);
        if (status == SL_OK && cost_of(a, f->now) < least) least = cost_of(a, f->now);
        if (status == SL_OK && f->fine && a->wide_count) status = choose(f, WIDE);
        if (clean && f->fine) break;
        f->fine = true;
    }
    f->fine = false;
    a->task = task;
    return status;
}

static sl_status find(finder *f) {
    sli_area *a = f->a;
    bool clean;
    uint32_t rows = 0;
    for (uint32_t i = 0; i < a->task->place_count; i++) f->now[i] = a->fixed[i];
    SL_TRY(add_first_rows(a));
    SL_TRY(take_more(f, true));
    SL_TRY(fill(f, &clean));
    SL_TRY(keep(f));
    if (!f->complete)
        return sl_fail(a->context, SL_UNSUPPORTED,
                       "no choice of the places was complete after %d rounds", ROUNDS);
    if (!(a->out->seen > a->negligible)) return refuse_blind(a);
    if (a->task->network) SL_TRY(bound_without_network(f));
    const uint64_t most = a->options->rounds ? a->options->rounds : ROUNDS;
    for (a->out->rounds = 1;; a->out->rounds++) {
        rows = 0;
        SL_TRY(choose(f, BOTH));
        if (a->wide_count && !f->fine) SL_TRY(choose(f, WIDE));
        if (a->out->lower == a->out->upper) break;
        if (a->task->network && !is_stalled(f)) SL_TRY(sli_network_cut(a, f->now, &rows));
        SL_TRY(complete(f, &clean));
        if (a->out->lower == a->out->upper || (clean && !rows && f->fine)) break;
        f->fine = true;
        if (a->wide_count) SL_TRY(choose(f, WIDE));
        if (a->out->lower == a->out->upper || a->out->rounds == most) break;
    }
    return SL_OK;
}

static sl_status find_fewest(sli_area *a) {
    finder f = {.a = a};
    f.now = sl_alloc_array(a->context, a->task->place_count, 1);
    f.best = sl_alloc_array(a->context, a->task->place_count, 1);
    const sl_status status = f.now && f.best ? find(&f) : SL_NO_MEMORY;
    sl_free(a->context, f.now);
    sl_free(a->context, f.best);
    return status;
}

sl_status sl_place_area_cover(sl_context *context, sl_query *query, const sl_place_area *area,
                              const sl_place_options *options, sl_area_placement *out) {
    const sl_place_options usual = sl_place_options_default();
    sl_area_placement made = {0};
    SL_TRY(check_task(context, area));
    SL_TRY(check_map(context, query));
    sli_area a = {.context = context,
                  .query = query,
                  .task = area,
                  .options = options ? options : &usual,
                  .out = &made};
    sl_status status = begin(&a);
    if (status == SL_OK) status = area->count ? sli_area_most(&a) : find_fewest(&a);
    made.witness_count = (uint32_t)a.witnesses.count;
    end(&a);
    if (status == SL_OK || (status == SL_CANCELLED && made.chosen))
        *out = made;
    else
        sl_area_placement_destroy(context, &made);
    return status;
}

void sl_area_placement_destroy(sl_context *context, sl_area_placement *p) {
    sl_free(context, p->chosen);
    sl_free(context, p->blind);
    sl_free(context, p->witnesses);
    sl_free(context, p->line_lengths);
    sli_area_problem_destroy(context, &p->columns);
    sli_cover_proof_destroy(context, &p->proof);
    *p = (sl_area_placement){0};
}
