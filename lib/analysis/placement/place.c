/// Placement: rounds that close the bounds (place.h).
///
/// A round asks for the fewest places anywhere that see the active witnesses: the lower bound. Its
/// places become candidates. If they do not see some witness, that becomes active. Else their gaps
/// give new witnesses; and where there is no gap, they are the answer.
///
/// Candidates of all rounds, and corners, together give the upper bound: the fewest of them that
/// see all witnesses, with new witnesses from their gaps, until there is none.
///
///     active witnesses --columns--> fewest places --> lower bound
///            ^                          | candidates
///            +----- witnesses <-- gaps--+--> fewest candidates --> upper bound
///
/// Tozoni, de Rezende and de Souza 2016 (Algorithm 966). Windows in place of an arrangement, and
/// active witnesses, are ours.
#include "sightline/place.h"

#include "analysis/placement/bound_blocks.h"
#include "analysis/placement/cover.h"
#include "analysis/placement/placer.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/overlay.h"

#include <stdio.h>

enum { USUAL_ROUNDS = 400, UPPER_STEPS = 30, COARSE_STEPS = 8, SPLITS = 8 };
/// With so many chosen viewpoints for each gap, gaps wait for the next round.
enum { CHOSEN_PER_GAP = 100 };
/// Bounds above LARGE are of large maps. Bounds are apart from one part of UPPER_PER_WIDE on, and
/// far apart from one of UPPER_PER_FAR.
enum { LARGE = 100, UPPER_PER_WIDE = 100, UPPER_PER_FAR = 5 };
/// A round does little if it adds up to one part of so many of witnesses and of the lower bound.
enum { WHOLE_PER_LITTLE = 100 };

/// Nodes of a coarse set cover of a large map: enough for cuts, and for trees of small parts. Rows
/// of a part from which a linear program of all of it takes too long.
enum { CUT_NODES = 300, MANY_ROWS = 2000 };

/// What the relaxation takes of a column that becomes a candidate.
static const double LEAST_SHARE = 0.02;

sl_place_options sl_place_options_default(void) {
    return (sl_place_options){.nodes = 10000, .many_entries = 1 << 20};
}

static void destroy_lower(sl_context *context, sl_placement *p) {
    sli_cover_proof_destroy(context, &p->proof);
    sl_free(context, p->witnesses);
    sl_free(context, p->places);
    sl_free(context, (void *)(uintptr_t)p->columns.ends);
    sl_free(context, (void *)(uintptr_t)p->columns.entries);
    sl_free(context, (void *)(uintptr_t)p->columns.costs);
    sl_free(context, (void *)(uintptr_t)p->columns.demands);
}

void sl_placement_destroy(sl_context *context, sl_placement *p) {
    destroy_lower(context, p);
    sl_free(context, p->viewpoints);
    *p = (sl_placement){0};
}

void sli_placer_destroy(sli_placer *p) {
    sl_region_destroy(p->context, &p->memory);
    sli_ground_destroy(p->context, &p->ground);
    for (size_t i = 0; i < p->witnesses.count; i++)
        sli_look_destroy(p->context, &p->witnesses.items[i]);
    for (size_t i = 0; i < p->candidates.count; i++) {
        sli_look_destroy(p->context, &p->candidates.items[i].look);
        sl_free(p->context, p->candidates.items[i].sees.items);
        sl_free(p->context, p->candidates.items[i].germs.items);
    }
    sl_free(p->context, p->witnesses.items);
    sl_free(p->context, p->candidates.items);
    sl_free(p->context, p->germs.items);
    sl_free(p->context, p->spans.items);
    sl_free(p->context, p->active.items);
    sl_free(p->context, p->standings.items);
    sl_free(p->context, p->chosen.items);
    sli_nearby_destroy(p->context, &p->witness_points);
    sli_nearby_destroy(p->context, &p->germ_points);
    sli_nearby_destroy(p->context, &p->candidate_bounds);
    sli_nearby_destroy(p->context, &p->chosen_bounds);
    sl_free(p->context, (void *)p->looks.items);
    sl_free(p->context, p->unseen.items);
    sli_crossings_destroy(p->context, &p->crossings);
    sl_free(p->context, p->lines.items);
    sli_nearby_destroy(p->context, &p->line_starts);
    sl_free(p->context, p->gaps.items);
}

void sl_placement_say(const sl_placement *p, const char *noun, bool stopped, char *text,
                      size_t size) {
    const unsigned lower = (unsigned)p->lower, witnesses = (unsigned)p->witness_count;
    const char *const where = p->given ? "if they stand at these places" : "wherever they stand";
    if (!witnesses)
        snprintf(text, size,
                 "The work ended early, before a lower bound was found: give more time.");
    else if (p->lower == p->upper)
        snprintf(text, size, "No fewer can: %u witness%s inside need%s %u %s%s, %s.", witnesses,
                 witnesses == 1 ? "" : "es", witnesses == 1 ? "s" : "", lower, noun,
                 lower == 1 ? "" : "s", where);
    else
        snprintf(text, size, "At least %u are needed: %u witnesses inside need so many, %s.%s",
                 lower, witnesses, where,
                 stopped ? " The work ended early; more time may close the gap." : "");
}

// --- the upper bound

static sl_status keep_viewpoints(sli_placer *p, sl_viewpoint *all, size_t count) {
    sl_free(p->context, p->out->viewpoints);
    p->out->viewpoints = all;
    p->out->count = (uint32_t)count;
    p->out->upper = count;
    return SL_OK;
}

/// The chosen candidates see everything, but for slivers: they are the upper bound if they are
/// fewer.
static sl_status keep_chosen(sli_placer *p, size_t slivers) {
    sl_placement *out = p->out;
    if (!p->chosen.count) return SL_OK; // no viewpoint has no gap, and sees nothing
    if (out->count < p->chosen.count) return SL_OK;
    if (out->count == p->chosen.count && out->slivers <= slivers) return SL_OK;
    sl_viewpoint *all = sl_alloc_array(p->context, p->chosen.count, sizeof *all);
    if (!all) return SL_NO_MEMORY;
    for (size_t i = 0; i < p->chosen.count; i++)
        all[i] = (sl_viewpoint){.at = sli_chosen_look(p, i)->eye, .fov = 360};
    out->slivers = slivers;
    SL_TRY(keep_viewpoints(p, all, p->chosen.count));
    sl_report(p->context, "place", "viewpoints", out->lower, out->upper);
    return SL_OK;
}

/// A set that surely sees everything: one viewpoint in each cell. SL_UNSUPPORTED where a cell is
/// too thin for doubles.
static sl_status start_with_cells(sli_placer *p) {
    const sl_space *space = p->ground.space;
    size_t count = 0;
    if (!space->inside_count) return sl_fail(p->context, SL_BAD_ARGUMENT, "nothing is inside");
    sl_viewpoint *all = sl_alloc_array(p->context, space->inside_count, sizeof *all);
    if (!all) return SL_NO_MEMORY;
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside)
            all[count++] = (sl_viewpoint){.at = sl_space_middle(space, c), .fov = 360};
    return keep_viewpoints(p, all, count);
}

/// Whether the bounds are apart by more than one part of so many.
static bool is_apart(const sli_placer *p, uint64_t parts) {
    return (p->out->upper - p->out->lower) * parts > p->out->upper;
}

static sl_status find_gaps(sli_placer *p) {
    p->looks.count = 0;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->looks, p->chosen.count));
    for (size_t i = 0; i < p->chosen.count; i++)
        p->looks.items[p->looks.count++] = sli_chosen_look(p, i);
    SL_TRY(sli_gaps_find(p->context, &p->ground, p->looks.items, (uint32_t)p->looks.count,
                         &p->chosen_bounds, p->gaps_of, &p->gaps));
    p->gaps_of = (uint32_t)p->chosen.count;
    return SL_OK;
}

/// Finds what the chosen candidates leave unseen, and witnesses there, or germs. *none: there is
/// nothing, or among given places only what none of them sees and no witness fits in.
static sl_status find_unseen(sli_placer *p, bool *none, bool *added) {
    size_t found = 0;
    bool missed, one;
    SL_TRY(find_gaps(p));
    for (size_t i = 0; i < p->gaps.count; i++) {
        SL_TRY(sl_check_cancelled(p->context));
        SL_TRY(sli_add_beyond(p, &p->gaps.items[i], &one));
        if (!one) SL_TRY(sli_add_germ(p, &p->gaps.items[i], &one));
        found += one;
    }
    SL_TRY(sli_add_in_line(p));
    SL_TRY(sli_add_unseen_parts(p, &missed));
    *none = !missed && !found && (p->listed || !p->gaps.count);
    *added = *added || missed || found;
    return SL_OK;
}

/// Chooses more candidates, until everything is seen: a set that may be no best one. Then some may
/// be in vain: it goes on without these, as long as there are fewer in the end.
static sl_status complete(sli_placer *p) {
    for (bool more = true; more && p->chosen.count < p->out->count;) {
        SL_TRY(sl_check_cancelled(p->context));
        SL_TRY(find_gaps(p));
        if (p->gaps.count) {
            bool closed;
            SL_TRY(sli_choose_for_gaps(p, &more, &closed));
            if (more) continue;
            if (!closed) return SL_OK;
            // All gaps lie in cells with a viewpoint in the middle: they are none but by rounding.
        }
        SL_TRY(keep_chosen(p, 0));
        SL_TRY(sli_drop_redundant(p, &more));
    }
    return SL_OK;
}

/// Fewer steps while coarse, where one takes long. On a very large map, where each new gap costs
/// viewpoints, twice as many; a set that sees everything is made half way, in case the time ends.
/// On a small one with bounds far apart, so is one after each step with fewer gaps than before: the
/// last step's is rarely the best.
static sl_status bound_above(sli_placer *p, bool *added) {
    const int coarse = p->out->lower > MANY_ROWS / 2 ? 2 * COARSE_STEPS : COARSE_STEPS;
    const bool large = p->out->lower > LARGE;
    const int most = p->coarse && large ? coarse : UPPER_STEPS;
    size_t fewest = SIZE_MAX;
    for (int i = 0; i < most; i++) {
        bool none, one = false;
        sl_cover_problem problem = {0};
        sl_cover_result cover = {0};
        const sl_status status = sli_choose_fewest(p, &problem, &cover);
        sli_choice_destroy(p->context, &problem, &cover);
        SL_TRY(status);
        if (p->chosen.count >= p->out->count) return SL_OK;
        SL_TRY(find_unseen(p, &none, &one));
        *added = *added || one;
        if (none) return keep_chosen(p, p->gaps.count);
        if (!one || (p->coarse && p->gaps.count <= p->chosen.count / CHOSEN_PER_GAP)) break;
        const bool fewer = p->gaps.count < fewest;
        if (fewer) fewest = p->gaps.count;
        const bool half = p->coarse && i + 1 == COARSE_STEPS && i + 1 < most;
        if (half || (fewer && !large && is_apart(p, UPPER_PER_FAR))) SL_TRY(complete(p));
    }
    return complete(p);
}

// --- the lower bound

/// Keeps what proves a better lower bound. Takes the columns and the proof.
static sl_status keep_lower(sli_placer *p, sli_place_columns *c, sl_cover_result *cover) {
    sl_placement *out = p->out;
    const uint32_t count = (uint32_t)p->active.count, columns = (uint32_t)c->ends.count;
    sl_witness *witnesses = sl_alloc_array(p->context, count, sizeof *witnesses);
    sl_point *places = sl_alloc_array(p->context, columns, sizeof *places);
    if (!witnesses || !places) {
        sl_free(p->context, witnesses);
        sl_free(p->context, places);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++)
        witnesses[i] = (sl_witness){p->witnesses.items[p->active.items[i]].eye, true};
    for (uint32_t i = 0; i < columns; i++) {
        const sli_window_part *part = &c->places.items[i];
        const sli_look *look = &p->witnesses.items[p->active.items[part->look]];
        places[i] = look->eye;
        if (part->window == SLI_NO_WINDOW) continue;
        const sli_track track = sli_track_of(look, part->window);
        places[i] = sli_track_at(&track, (part->from + part->to) / 2);
    }
    destroy_lower(p->context, out);
    out->lower = cover->lower;
    out->witnesses = witnesses;
    out->witness_count = count;
    out->places = places;
    out->columns = (sl_cover_problem){count, columns, c->ends.items, c->entries.items, NULL, NULL};
    out->proof = cover->proof;
    c->ends.items = NULL;
    c->entries.items = NULL;
    cover->proof = (sl_cover_proof){0};
    return SL_OK;
}

/// Chooses the places of a cover of the lower bound.
static sl_status choose_columns(sli_placer *p, const sli_place_columns *c,
                                const sl_cover_result *cover) {
    uint32_t number;
    sli_choose_none(p);
    for (uint32_t i = 0; i < cover->count; i++) {
        SL_TRY(sli_add_column(p, c, cover->columns[i], &number));
        if (number != UINT32_MAX) SL_TRY(sli_choose(p, number));
    }
    return SL_OK;
}

/// Columns that the relaxation takes in part become candidates, too: a set that sees everything is
/// made of other columns than one that sees the witnesses of today.
static sl_status add_shared(sli_placer *p, const sli_place_columns *c, const double *values) {
    uint32_t number;
    for (uint32_t i = 0; i < c->ends.count; i++)
        if (values[i] > LEAST_SHARE) SL_TRY(sli_add_column(p, c, i, &number));
    return SL_OK;
}

static sl_status use_columns(sli_placer *p, sli_place_columns *c) {
    const sl_cover_problem problem = {(uint32_t)p->active.count,
                                      (uint32_t)c->ends.count,
                                      c->ends.items,
                                      c->entries.items,
                                      NULL,
                                      NULL};
    const bool drops = p->drops && c->entries.count >= p->options->many_entries;
    sl_cover_options options = sli_cover_options(p);
    // Where the bounds are far apart, a coarse set cover gains by them, too.
    const bool wide = is_apart(p, UPPER_PER_WIDE);
    const bool cuts = p->coarse && p->drops && wide && p->out->upper > LARGE;
    if (!p->coarse || (p->drops && wide)) options.splits = SPLITS;
    if (cuts) options.nodes = p->options->nodes < CUT_NODES ? p->options->nodes : CUT_NODES;
    sl_cover_result cover = {0};
    double *values = sl_alloc_array(p->context, problem.column_count, sizeof *values);
    if (!values) return SL_NO_MEMORY;
    sl_status status = sli_cover_solve(p->context, &problem, &options, values, &cover);
    if (SLI_PROGRAMS && status == SL_OK && (cuts || !p->coarse))
        status = sli_bound_by_blocks(p->context, &problem, options.program, MANY_ROWS, &cover);
    if (status == SL_OK && wide && cover.lower < cover.cost && cover.lower <= LARGE)
        status = add_shared(p, c, values);
    sl_free(p->context, values);
    if (status == SL_OK) status = choose_columns(p, c, &cover);
    const bool better = cover.lower > p->out->lower;
    if ((status == SL_OK || status == SL_CANCELLED) && better) {
        const sl_status kept = keep_lower(p, c, &cover);
        if (kept != SL_OK) status = kept;
    }
    if (status == SL_OK && drops)
        status = sli_drop_implied(p, better ? &p->out->proof : &cover.proof);
    sl_cover_result_destroy(p->context, &cover);
    return status;
}

/// The lower bound, and the viewpoints that it has. *gaps: these see all witnesses, but not
/// everything.
static sl_status bound_below(sli_placer *p, bool *gaps, bool *added) {
    sli_place_columns c;
    bool none = false;
    const uint64_t lower = p->out->lower;
    p->looks.count = 0;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->looks, p->active.count));
    for (size_t i = 0; i < p->active.count; i++)
        p->looks.items[p->looks.count++] = &p->witnesses.items[p->active.items[i]];
    SL_TRY(sli_place_columns_make(p->context, &p->ground, p->looks.items, (uint32_t)p->active.count,
                                  &p->crossings, &c));
    const sl_status status = use_columns(p, &c);
    sli_place_columns_destroy(p->context, &c);
    SL_TRY(status);
    *gaps = p->drops = false;
    const size_t active = p->active.count;
    SL_TRY(sli_activate(p, added));
    // The last few take many steps, and gaps lead to better ones.
    const bool few =
        p->out->lower == lower || (p->active.count - active <= active / WHOLE_PER_LITTLE &&
                                   p->out->lower - lower <= lower / WHOLE_PER_LITTLE);
    if (*added && !few) return SL_OK;
    SL_TRY(find_unseen(p, &none, added));
    if (none) return keep_chosen(p, p->gaps.count);
    *gaps = p->drops = true;
    return sli_activate(p, added);
}

// --- among given places

/// Keeps what proves a better lower bound for the given places. Takes columns and proof.
static sl_status keep_listed_lower(sli_placer *p, sl_cover_problem *problem,
                                   sl_cover_result *cover) {
    sl_placement *out = p->out;
    sl_witness *witnesses = sl_alloc_array(p->context, problem->row_count, sizeof *witnesses);
    sl_point *places = sl_alloc_array(p->context, problem->column_count, sizeof *places);
    if (!witnesses || !places) {
        sl_free(p->context, witnesses);
        sl_free(p->context, places);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < problem->row_count; i++)
        witnesses[i] = (sl_witness){p->witnesses.items[i].eye, true};
    for (uint32_t i = 0; i < problem->column_count; i++)
        places[i] = p->candidates.items[i].look.eye;
    destroy_lower(p->context, out);
    out->lower = cover->lower;
    out->witnesses = witnesses;
    out->witness_count = problem->row_count;
    out->places = places;
    out->columns = *problem;
    out->proof = cover->proof;
    *problem = (sl_cover_problem){0};
    cover->proof = (sl_cover_proof){0};
    return SL_OK;
}

/// All places that are given: nothing else can see more.
static sl_status take_listed(sli_placer *p) {
    const sl_place_options *o = p->options;
    bool none = true, added = false;
    for (uint32_t i = 0; i < o->place_count; i++) {
        uint32_t number;
        SL_TRY(sli_add_candidate(p, o->places[i], &number));
        if (number != UINT32_MAX) continue;
        const int digits = sl_map_digits(sl_query_map(p->query));
        return sl_fail(p->context, SL_BAD_ARGUMENT, "place %u at (%.*g, %.*g) is not inside", i + 1,
                       digits, o->places[i].x, digits, o->places[i].y);
    }
    p->listed = true;
    for (uint32_t i = 0; i < p->candidates.count; i++) SL_TRY(sli_choose(p, i));
    SL_TRY(find_unseen(p, &none, &added));
    p->out->count = UINT32_MAX;
    if (!p->witnesses.count) return keep_chosen(p, p->gaps.count);
    return sli_fail_unseen(p, p->witnesses.items[p->witnesses.count - 1].eye);
}

static sl_status step_listed(sli_placer *p, bool *added) {
    sl_cover_problem problem = {0};
    sl_cover_result cover = {0};
    bool none = false;
    sl_status status = sli_choose_fewest(p, &problem, &cover);
    if (status == SL_OK && cover.lower > p->out->lower)
        status = keep_listed_lower(p, &problem, &cover);
    sli_choice_destroy(p->context, &problem, &cover);
    SL_TRY(status);
    SL_TRY(find_unseen(p, &none, added));
    return none ? keep_chosen(p, p->gaps.count) : SL_OK;
}

static sl_status run_listed(sli_placer *p) {
    const uint64_t most = p->options->rounds ? p->options->rounds : UINT64_MAX;
    SL_TRY(take_listed(p));
    SL_TRY(sli_add_first_witnesses(p));
    for (bool added = true; added && p->out->rounds < most; p->out->rounds++) {
        added = false;
        SL_TRY(sl_check_cancelled(p->context));
        SL_TRY(step_listed(p, &added));
        sl_report(p->context, "place", "viewpoints", p->out->lower, p->out->upper);
    }
    return SL_OK;
}

/// Both bounds once more. *gaps as in bound_below().
static sl_status step(sli_placer *p, bool *gaps, bool *added) {
    SL_TRY(sl_check_cancelled(p->context));
    SL_TRY(bound_below(p, gaps, added));
    sl_report(p->context, "place", "viewpoints", p->out->lower, p->out->upper);
    if (!*gaps || p->out->upper == p->out->lower) return SL_OK;
    p->out->rounds++;
    if (p->out->rounds == 2) SL_TRY(sli_add_corners(p));
    SL_TRY(bound_above(p, added));
    sl_report(p->context, "place", "viewpoints", p->out->lower, p->out->upper);
    return SL_OK;
}

/// Set covers are coarse at first: exact ones take much longer, and what they tell of too few
/// witnesses is soon past. Where a round changes no bound, the next one is exact.
static sl_status run(sli_placer *p) {
    const uint64_t most = p->options->rounds ? p->options->rounds : USUAL_ROUNDS;
    bool added, gaps;
    SL_TRY(start_with_cells(p));
    SL_TRY(sli_add_first_witnesses(p));
    SL_TRY(sli_add_unseen_parts(p, &added));
    SL_TRY(sli_activate(p, &added));
    p->coarse = true;
    uint64_t lower = 0, upper = p->out->upper;
    for (size_t steps = 0; p->out->rounds < most; steps++) {
        const size_t before = p->witnesses.count;
        SL_TRY(step(p, &gaps, &added));
        if (p->out->upper == p->out->lower) return SL_OK;
        if (steps == 2 && !gaps) SL_TRY(complete(p));
        if (!gaps) continue;
        const bool same = p->out->lower == lower && p->out->upper == upper;
        if (p->witnesses.count == before && !p->coarse) return SL_OK;
        p->coarse = !same && p->witnesses.count > before;
        lower = p->out->lower;
        upper = p->out->upper;
    }
    return SL_OK;
}

/// What the viewpoints leave unseen, where that is slivers.
static sl_status measure_unseen(sli_placer *p) {
    sl_placement *out = p->out;
    if (!out->slivers) return SL_OK;
    sl_shape inside = {0}, *seen = sl_alloc_array(p->context, out->count, sizeof *seen);
    sl_region *regions = sl_alloc_array(p->context, out->count, sizeof *regions);
    sl_overlay overlay = {0};
    sl_status status = seen && regions ? SL_OK : SL_NO_MEMORY;
    for (uint32_t i = 0; status == SL_OK && i < out->count; i++) {
        const sl_view view = sl_view_all_round(out->viewpoints[i].at);
        status = sl_query_region(p->context, p->query, &view, &regions[i]);
        seen[i] = (sl_shape){regions[i].points, &regions[i].count, 1};
    }
    if (status == SL_OK) status = sl_shape_of_inside(p->context, p->ground.space, &inside);
    if (status == SL_OK) status = sl_overlay_make(p->context, &inside, seen, out->count, &overlay);
    if (status == SL_OK) out->unseen_area = sli_greater(overlay.areas[0] - overlay.areas[1], 0);
    sl_overlay_destroy(p->context, &overlay);
    sl_shape_destroy(p->context, &inside);
    for (uint32_t i = 0; regions && i < out->count; i++) sl_region_destroy(p->context, &regions[i]);
    sl_free(p->context, regions);
    sl_free(p->context, seen);
    return status;
}

static sl_status check(sl_context *context, sl_query *query) {
    const sl_map *map = sl_query_map(query);
    if (map->mirror_count) return sl_fail(context, SL_UNSUPPORTED, "placement knows no mirrors");
    if (map->oneway_count)
        return sl_fail(context, SL_UNSUPPORTED, "placement knows no one-way glass");
    if (sl_map_limited_walls(map))
        return sl_fail(context, SL_UNSUPPORTED, "placement knows no limited walls");
    return SL_OK;
}

sl_status sl_place(sl_context *context, sl_query *query, const sl_place_options *options,
                   sl_placement *out) {
    const sl_place_options usual = sl_place_options_default();
    const sl_space *space;
    sl_placement made = {.given = options && options->places};
    SL_TRY(check(context, query));
    SL_TRY(sl_query_space(context, query, &space, NULL));
    sli_placer p = {
        .context = context, .query = query, .options = options ? options : &usual, .out = &made};
    sl_status status = sli_ground_make(context, space, sl_query_map(query), &p.ground);
    if (status == SL_OK) status = p.options->places ? run_listed(&p) : run(&p);
    if (status == SL_OK) status = measure_unseen(&p);
    sli_placer_destroy(&p);
    if (status == SL_OK || (status == SL_CANCELLED && made.viewpoints))
        *out = made;
    else
        sl_placement_destroy(context, &made);
    return status;
}
