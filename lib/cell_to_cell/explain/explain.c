/// Why a cell sees another, or does not: a depth-first search from the one for the other.
///
/// The search has a bound on the number of portals. The bound is doubled until nothing is left
/// beyond it. A sequence that cannot reach the target within the bound, seen or not, is not
/// followed (iterative deepening with an admissible estimate: Korf 1985).
///
/// A pair is stabbed, only grazed, or hidden, whichever sight is asked for: sequences that are
/// grazed are followed as well. For a hidden pair the sequences that came nearest are kept, each
/// with the few portal ends that stop it.
#include "sightline/explain.h"
#include "base/base.h"
#include "cell_to_cell/explain/explain_line.h"
#include "cell_to_cell/search/directions.h"
#include "cell_to_cell/search/portal_search.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/stab.h"
#include "sightline/support.h"
#include "space/index.h"
#include "stab/funnel.h"

#include <math.h>
#include <string.h>

/// A cell on the way from the first.
typedef struct step {
    sli_portal_step at;
    uint32_t directed;         ///< crossed last; none for the first
    sli_directions directions; ///< of the portals so far
    bool grazing;              ///< the sequence is no more than grazed
} step;

typedef struct search {
    const sl_space *space;
    const sl_explain_options *options;
    sli_portal_search search; ///< stops where most_tests is reached
    uint32_t *distance;       ///< by cell: portals to the target, SL_NO_WAY for no way
    uint32_t bound;           ///< sequences of more portals are left for later
    bool cut;                 ///< some were
    uint32_t stabbed, grazed; ///< portals of the shortest sequences found; UINT32_MAX for none
    uint32_t most_misses;
    sl_explanation out;
} search;

sl_explain_options sl_explain_options_default(void) {
    return (sl_explain_options){.sight = SL_CLOSED, .solver = sl_funnel(), .most_misses = 3};
}

void sl_explanation_destroy(sl_context *context, sl_explanation *explanation) {
    sl_free(context, explanation->sequence.directed);
    for (uint32_t i = 0; i < explanation->miss_count; i++)
        sl_free(context, explanation->misses[i].sequence.directed);
    sl_free(context, explanation->misses);
    sl_free(context, explanation->bent.steps);
    sl_free(context, explanation->bent.bends);
    *explanation = (sl_explanation){0};
}

// --- the line that is shown

/// Significant digits, of the size of the map, that are tried for a line's coordinates.
#define MOST_DIGITS 15

static bool is_strict(const sl_space *space, const sl_sequence *sequence, sl_line line) {
    for (uint32_t i = 0; i < sequence->directed_count; i++) {
        const sl_directed_portal *directed = &space->directed[sequence->directed[i]];
        if (sli_orient(line.a, line.b, directed->left) <= 0 ||
            sli_orient(line.a, line.b, directed->right) >= 0)
            return false;
    }
    return true;
}

double sli_share_of_portal(const sl_directed_portal *directed, sl_line line) {
    const double x = line.b.x - line.a.x, y = line.b.y - line.a.y;
    const double left = x * (directed->left.y - line.a.y) - y * (directed->left.x - line.a.x);
    const double right = x * (directed->right.y - line.a.y) - y * (directed->right.x - line.a.x);
    return left > right ? fmin(fmax(left / (left - right), 0), 1) : 0;
}

/// Whether a line keeps half of what distance another one keeps from the portals' ends.
static bool is_near(const sl_space *space, const sl_sequence *sequence, sl_line line,
                    sl_line other) {
    for (uint32_t i = 0; i < sequence->directed_count; i++) {
        const sl_directed_portal *directed = &space->directed[sequence->directed[i]];
        const double share = sli_share_of_portal(directed, line),
                     wanted = sli_share_of_portal(directed, other);
        if (share < wanted / 2 || 1 - share < (1 - wanted) / 2) return false;
    }
    return true;
}

static sl_point rounded(sl_point p, double decimals) {
    return (sl_point){round(p.x * decimals) / decimals, round(p.y * decimals) / decimals};
}

/// Replaces a line by one near it with as few decimals as possible, strictly between the ends of
/// every portal of the sequence. False, and the line unchanged, if doubles cannot express one.
static bool simplify_line(const sl_space *space, const sl_sequence *sequence, sl_line *line) {
    const sl_box b = space->bounds;
    const double size =
        fmax(fmax(fabs(b.min.x), fabs(b.max.x)), fmax(fabs(b.min.y), fabs(b.max.y)));
    const int first = size > 0 ? 1 - (int)ceil(log10(size)) : 0;
    const bool strict = is_strict(space, sequence, *line);
    for (int digits = 0; digits < MOST_DIGITS; digits++) {
        const double decimals = sli_power_of_ten(first + digits);
        const sl_line simple = {rounded(line->a, decimals), rounded(line->b, decimals)};
        if (!is_strict(space, sequence, simple)) continue;
        if (strict && !is_near(space, sequence, simple, *line)) continue;
        *line = simple;
        return true;
    }
    return strict;
}

/// Where the line crosses a portal; an end of it where it lies along.
static sl_point crossing_point(const sl_directed_portal *directed, sl_line line) {
    const double share = sli_share_of_portal(directed, line);
    return (sl_point){directed->left.x + share * (directed->right.x - directed->left.x),
                      directed->left.y + share * (directed->right.y - directed->left.y)};
}

sl_point sli_halfway_into(const sl_space *space, uint32_t cell, sl_point at, sl_point direction) {
    const double half = sli_ray_length(space, cell, at, direction) / 2;
    return (sl_point){at.x + half * direction.x, at.y + half * direction.y};
}

/// The line's piece from the middle of its way through cell `from` to that through the last cell.
static sl_segment shown_segment(const sl_space *space, const sl_sequence *sequence, uint32_t from,
                                sl_line line) {
    const sl_directed_portal *first = &space->directed[sequence->directed[0]];
    const sl_directed_portal *last =
        &space->directed[sequence->directed[sequence->directed_count - 1]];
    const double x = line.b.x - line.a.x, y = line.b.y - line.a.y, length = sli_length(x, y);
    const sl_point forward = {x / length, y / length}, back = {-x / length, -y / length};
    return (sl_segment){sli_halfway_into(space, from, crossing_point(first, line), back),
                        sli_halfway_into(space, last->cell, crossing_point(last, line), forward)};
}

// --- distances

/// The cells from which a directed portal leads into a cell: from[first[c] .. first[c + 1]).
typedef struct ways_back {
    uint32_t *first, *from;
} ways_back;

static sl_status find_ways_back(sl_context *context, const sl_space *space, ways_back *out) {
    out->first = sl_alloc_array(context, (size_t)space->cell_count + 2, sizeof *out->first);
    out->from = sl_alloc_array(context, space->directed_count, sizeof *out->from);
    if (!out->first || !out->from) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->directed_count; i++) out->first[space->directed[i].cell + 2]++;
    for (uint32_t c = 1; c <= space->cell_count; c++) out->first[c + 1] += out->first[c];
    for (uint32_t c = 0; c < space->cell_count; c++) {
        const sl_cell *cell = &space->cells[c];
        for (uint32_t i = 0; i < cell->directed_count; i++)
            out->from[out->first[space->directed[cell->first_directed + i].cell + 1]++] = c;
    }
    return SL_OK;
}

/// Breadth first from the target, backwards.
static void spread_back(const ways_back *back, uint32_t to, uint32_t *distance, uint32_t *queue) {
    uint32_t end = 0;
    queue[end++] = to;
    distance[to] = 0;
    for (uint32_t begin = 0; begin < end; begin++)
        for (uint32_t i = back->first[queue[begin]]; i < back->first[queue[begin] + 1]; i++) {
            const uint32_t next = back->from[i];
            if (distance[next] != SL_NO_WAY) continue;
            distance[next] = distance[queue[begin]] + 1;
            queue[end++] = next;
        }
}

sl_status sli_find_distances(sl_context *context, const sl_space *space, uint32_t to,
                             uint32_t **out) {
    const uint32_t count = space->cell_count;
    ways_back back = {0};
    uint32_t *distance = sl_alloc_array(context, count, sizeof *distance);
    uint32_t *queue = sl_alloc_array(context, count, sizeof *queue);
    sl_status status = distance && queue ? SL_OK : SL_NO_MEMORY;
    *out = distance;
    if (status == SL_OK) status = find_ways_back(context, space, &back);
    for (uint32_t i = 0; i < count && status == SL_OK; i++) distance[i] = SL_NO_WAY;
    if (status == SL_OK) spread_back(&back, to, distance, queue);
    sl_free(context, back.first);
    sl_free(context, back.from);
    sl_free(context, queue);
    return status;
}

// --- sequences to be told

/// A copy of the sequence as it stands with one more directed portal, without ends.
static sl_status copy_sequence(sl_context *context, const search *s, uint32_t last,
                               sl_sequence *out) {
    const step *steps = s->search.steps;
    const uint32_t count = (uint32_t)s->search.count;
    uint32_t *directed = sl_alloc_array(context, count, sizeof *directed);
    if (!directed) return SL_NO_MEMORY;
    for (uint32_t i = 1; i < count; i++) directed[i - 1] = steps[i].directed;
    directed[count - 1] = last;
    sl_free(context, out->directed);
    *out = (sl_sequence){.directed = directed, .directed_count = count};
    return SL_OK;
}

/// The target is reached by the sequence with one more directed portal, which the solver holds.
static sl_status note_found(sl_context *context, search *s, uint32_t last, bool grazing) {
    const sl_solver *solver = s->options->solver;
    sl_explanation *out = &s->out;
    SL_TRY(copy_sequence(context, s, last, &out->sequence));
    out->verdict = grazing ? SL_GRAZING : SL_STABBED;
    out->witness = solver->witness(s->search.solver_state);
    if (s->options->range > 0) out->length = sli_funnel_shortest(s->search.solver_state);
    if (grazing) {
        s->grazed = out->sequence.directed_count;
        return solver->conflict(context, s->search.solver_state, out->sequence.ends,
                                &out->sequence.end_count);
    }
    s->stabbed = out->sequence.directed_count;
    s->grazed = 0;
    return SL_OK;
}

static const step *last_step(const search *s) {
    return (const step *)s->search.steps + s->search.count - 1;
}

/// The last cell before the sequence's last portal.
static uint32_t last_cell(const sl_space *space, uint32_t from, const sl_sequence *sequence) {
    const uint32_t count = sequence->directed_count;
    return count > 1 ? space->directed[sequence->directed[count - 2]].cell : from;
}

static bool is_farther(const sl_miss *a, const sl_miss *b) {
    if (a->missing != b->missing) return a->missing < b->missing;
    if (a->turns != b->turns) return b->turns;
    return a->sequence.directed_count < b->sequence.directed_count;
}

/// The place of a miss in the list, which has the farthest first. A miss takes the place of one
/// with the same last cell, or else the list's end, from where it moves up. UINT32_MAX for no
/// place.
static uint32_t place_of_miss(const search *s, const sl_miss *miss) {
    const sl_explanation *out = &s->out;
    const uint32_t cell = last_step(s)->at.cell;
    for (uint32_t i = 0; i < out->miss_count; i++)
        if (last_cell(s->space, out->from, &out->misses[i].sequence) == cell)
            return is_farther(miss, &out->misses[i]) ? i : UINT32_MAX;
    if (out->miss_count < s->most_misses) return out->miss_count;
    const uint32_t last = out->miss_count - 1;
    return s->most_misses && is_farther(miss, &out->misses[last]) ? last : UINT32_MAX;
}

static uint32_t place_of_portal(const sl_sequence *sequence, uint32_t directed) {
    uint32_t at = 0;
    while (sequence->directed[at] != directed) at++;
    return at;
}

/// Adds the ends of the last portal and of the one or two before it that leave it no direction: one
/// portal that it turns back from, or the two that bound the directions so far.
static void tell_turn(const search *s, sl_sequence *sequence) {
    const uint32_t last = sequence->directed_count - 1;
    const uint32_t stop = sequence->directed[last];
    const sli_directions before = last_step(s)->directions;
    uint32_t portals[3] = {place_of_portal(sequence, before.least),
                           place_of_portal(sequence, before.most), last};
    uint32_t first = 0;
    for (uint32_t i = last; i-- > 0 && !first;) {
        sli_directions pair = {stop, stop};
        if (sli_directions_add(s->space, &pair, sequence->directed[i])) continue;
        portals[1] = i;
        first = 1;
    }
    for (uint32_t i = first; i < 3; i++)
        for (int side = 0; side < 2; side++)
            sequence->ends[sequence->end_count++] =
                (sl_stab_end){.portal = portals[i], .left = side == 0};
}

static bool is_visited(const search *s, uint32_t cell) {
    const step *steps = s->search.steps;
    for (size_t i = 0; i < s->search.count; i++)
        if (steps[i].at.cell == cell) return true;
    return false;
}

/// Notes a directed portal that stops the sequence: either its ends leave no line, and the solver
/// holds it, or it turns back. Only portals that lead nearer to the target are noted, and none that
/// lead back to where the sequence has been.
static sl_status note_miss(sl_context *context, search *s, uint32_t directed, bool turns) {
    sl_explanation *out = &s->out;
    const uint32_t missing = s->distance[last_step(s)->at.cell];
    if (out->verdict != SL_HIDDEN || s->distance[s->space->directed[directed].cell] >= missing)
        return SL_OK;
    sl_miss miss = {
        .sequence.directed_count = (uint32_t)s->search.count, .missing = missing, .turns = turns};
    uint32_t at = place_of_miss(s, &miss);
    if (at == UINT32_MAX || is_visited(s, s->space->directed[directed].cell)) return SL_OK;
    SL_TRY(copy_sequence(context, s, directed, &miss.sequence));
    if (turns) {
        tell_turn(s, &miss.sequence);
    } else {
        const sl_status status = s->options->solver->conflict(
            context, s->search.solver_state, miss.sequence.ends, &miss.sequence.end_count);
        if (status != SL_OK) {
            sl_free(context, miss.sequence.directed);
            return status;
        }
    }
    if (at == out->miss_count)
        out->miss_count++;
    else
        sl_free(context, out->misses[at].sequence.directed);
    for (; at > 0 && is_farther(&miss, &out->misses[at - 1]); at--)
        out->misses[at] = out->misses[at - 1];
    out->misses[at] = miss;
    return SL_OK;
}

// --- the search

/// Whether a sequence of at least so many portals in all is left alone: another one is as short, or
/// it goes beyond the bound.
static bool is_neighbour(search *s, bool grazing, uint32_t portals) {
    if (portals >= s->stabbed || (grazing && portals >= s->grazed)) return true;
    if (portals > s->bound) s->cut = true;
    return portals > s->bound;
}

static sl_status count_test(sl_context *context, search *s) {
    sl_explanation *out = &s->out;
    if (++out->tests % 64 == 0) SL_TRY(sl_check_cancelled(context));
    if (out->tests % 1024 == 0) sl_report(context, "explain", "tests", out->tests, 0);
    s->search.stop = out->tests == s->options->most_tests;
    return SL_OK;
}

/// Whether no more than the range lies between the first portal and the last of some line, as in a
/// bake.
bool sli_explain_in_range(const sl_explain_options *options, const void *solver_state) {
    const double range = options->range;
    if (!(range > 0)) return true;
    return sli_funnel_shortest(solver_state) <= range + SLI_SHORTEST_ERROR * range;
}

/// Decides on the sequence with the directed portal of `to`, which the solver holds. `enters`: it
/// is followed into the next cell, and the solver keeps it.
static sl_status judge(sl_context *context, search *s, const step *to, sl_stab_verdict verdict,
                       bool *enters) {
    const uint32_t portals = (uint32_t)s->search.count, cell = to->at.cell;
    *enters = false;
    if (verdict == SL_HIDDEN) return note_miss(context, s, to->directed, false);
    if (is_neighbour(s, to->grazing, portals + s->distance[cell])) return SL_OK;
    if (cell == s->out.to) return note_found(context, s, to->directed, to->grazing);
    *enters = true;
    return SL_OK;
}

static sl_status cross(sl_context *context, void *job, const void *last, void *next,
                       uint32_t number) {
    search *s = job;
    const step *from = last;
    step *to = next;
    const sl_directed_portal *directed = &s->space->directed[number];
    const uint32_t portals = (uint32_t)s->search.count + s->distance[directed->cell];
    *to = (step){.at.cell = directed->cell, .directed = number, .directions = from->directions};
    if (!sli_directions_add(s->space, &to->directions, number))
        return note_miss(context, s, number, true);
    if (is_neighbour(s, from->grazing, portals)) return SL_OK;
    SL_TRY(count_test(context, s));
    sl_stab_verdict verdict;
    bool enters = false;
    SL_TRY(sli_portal_search_push(context, &s->search, directed->left, directed->right, &verdict));
    to->grazing = verdict == SL_GRAZING;
    if (verdict == SL_HIDDEN || sli_explain_in_range(s->options, s->search.solver_state))
        SL_TRY(judge(context, s, to, verdict, &enters));
    if (enters)
        s->search.count++;
    else
        sli_portal_search_pop(&s->search);
    return SL_OK;
}

/// All sequences within the bound.
static sl_status search_within(sl_context *context, search *s) {
    static const sli_portal_visitor visitor = {.step_size = sizeof(step), .cross = cross};
    SL_TRY(sli_portal_search_start(context, &s->search, sizeof(step)));
    step *first = s->search.steps;
    *first =
        (step){.at.cell = s->out.from, .directed = UINT32_MAX, .directions = SLI_NO_DIRECTIONS};
    s->search.count++;
    return sli_portal_search_run(context, &s->search, &visitor, s);
}

static sl_status search_all(sl_context *context, search *s) {
    sl_explanation *out = &s->out;
    const uint32_t cells = s->space->cell_count;
    s->most_misses = s->options->most_misses < cells ? s->options->most_misses : cells;
    out->misses = sl_alloc_array(context, s->most_misses, sizeof *out->misses);
    if (!out->misses) return SL_NO_MEMORY;
    for (s->bound = out->distance;; s->bound *= 2) {
        s->cut = false;
        SL_TRY(search_within(context, s));
        if (!s->cut || s->search.stop || out->verdict == SL_STABBED) break;
    }
    out->complete = !s->search.stop;
    return SL_OK;
}

static void drop_misses(sl_context *context, sl_explanation *out) {
    for (uint32_t i = 0; i < out->miss_count; i++)
        sl_free(context, out->misses[i].sequence.directed);
    out->miss_count = 0;
}

static sl_status explain(sl_context *context, search *s) {
    const sl_solver *solver = s->options->solver;
    sl_explanation *out = &s->out;
    SL_TRY(sli_find_distances(context, s->space, out->to, &s->distance));
    out->distance = s->distance[out->from];
    out->complete = true;
    out->verdict = out->distance == 0 ? SL_STABBED : SL_HIDDEN;
    if (out->distance != 0 && out->distance != SL_NO_WAY) {
        SL_TRY(solver->create(context, s->space->bounds, &s->search.solver_state));
        SL_TRY(search_all(context, s));
    }
    out->seen =
        out->verdict == SL_STABBED || (out->verdict == SL_GRAZING && out->sight == SL_CLOSED);
    if (out->verdict != SL_HIDDEN) drop_misses(context, out);
    if (!out->sequence.directed_count) return SL_OK;
    out->touches =
        out->verdict == SL_GRAZING || !simplify_line(s->space, &out->sequence, &out->witness);
    out->shown = shown_segment(s->space, &out->sequence, out->from, out->witness);
    return SL_OK;
}

static sl_status check(sl_context *context, const sl_space *space,
                       const sl_explain_options *options, uint32_t from, uint32_t to) {
    const sl_solver *solver = options->solver;
    if (from >= space->cell_count || to >= space->cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "cell %u: the map has %u cells",
                       from >= space->cell_count ? from : to, space->cell_count);
    SL_TRY(sli_refuse_limited(context, space, "an explanation", ""));
    if (!solver || solver->guarantee != SL_EXACT || !solver->conflict)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "an explanation needs an exact solver that reports conflicts");
    if (options->range > 0 && strcmp(solver->name, sl_funnel()->name) != 0)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "explaining within a range needs the solver 'funnel'");
    return SL_OK;
}

sl_status sl_explain(sl_context *context, const sl_space *space, const sl_explain_options *options,
                     uint32_t from, uint32_t to, sl_explanation *out) {
    SL_TRY(check(context, space, options, from, to));
    search s = {.space = space,
                .options = options,
                .search = {.space = space, .solver = options->solver},
                .stabbed = UINT32_MAX,
                .grazed = UINT32_MAX,
                .out = {.from = from, .to = to, .sight = options->sight}};
    const sl_status status = explain(context, &s);
    sli_portal_search_end(context, &s.search);
    sl_free(context, s.distance);
    if (status == SL_OK)
        *out = s.out;
    else
        sl_explanation_destroy(context, &s.out);
    return status;
}

// --- what is said of a sequence

sl_point sl_sequence_end(const sl_space *space, const sl_sequence *sequence, sl_stab_end end) {
    const sl_directed_portal *directed = &space->directed[sequence->directed[end.portal]];
    return end.left ? directed->left : directed->right;
}

/// Adds a place to those known, each once.
static void add_place(sl_point p, sl_point places[SL_CONFLICT_MOST], uint32_t *count) {
    for (uint32_t k = 0; k < *count; k++)
        if (places[k].x == p.x && places[k].y == p.y) return;
    places[(*count)++] = p;
}

static bool segments_cross(const sl_point a[2], const sl_point b[2]) {
    return sli_orient(a[0], a[1], b[0]) * sli_orient(a[0], a[1], b[1]) < 0 &&
           sli_orient(b[0], b[1], a[0]) * sli_orient(b[0], b[1], a[1]) < 0;
}

static const char *reason(const sl_point *left, uint32_t lefts, const sl_point *right,
                          uint32_t rights) {
    if (lefts == 1 && rights == 1) return "that left end is the same point as that right end";
    if (lefts == 1 && rights == 2)
        return "that left end lies between those right ends, on one line";
    if (lefts == 2 && rights == 1)
        return "that right end lies between those left ends, on one line";
    if (lefts == 1) return "that left end lies within the triangle of those right ends";
    if (rights == 1) return "that right end lies within the triangle of those left ends";
    if (lefts == 2 && rights == 2 && segments_cross(left, right))
        return "the segment between those left ends crosses the segment between those right ends";
    return "what lies between those left ends overlaps what lies between those right ends";
}

const char *sl_sequence_reason(const sl_space *space, const sl_sequence *sequence) {
    sl_point places[2][SL_CONFLICT_MOST];
    uint32_t counts[2] = {0, 0};
    for (uint32_t i = 0; i < sequence->end_count; i++) {
        const int side = sequence->ends[i].left ? 0 : 1;
        add_place(sl_sequence_end(space, sequence, sequence->ends[i]), places[side], &counts[side]);
    }
    return reason(places[0], counts[0], places[1], counts[1]);
}

const char *sl_conflict_reason(const sl_portal_ends *portals, const sl_conflict *conflict) {
    sl_point places[2][SL_CONFLICT_MOST];
    uint32_t counts[2] = {0, 0};
    if (conflict->turns) return "no direction crosses those portals all forwards";
    for (uint32_t i = 0; i < conflict->end_count; i++) {
        const sl_portal_ends *at = &portals[conflict->ends[i].portal];
        const bool left = conflict->ends[i].left;
        add_place(left ? at->left : at->right, places[!left], &counts[!left]);
    }
    return reason(places[0], counts[0], places[1], counts[1]);
}

// --- a sequence alone

static sl_directed_portal directed_of(const sl_portal_ends *portal) {
    return (sl_directed_portal){.left = portal->left, .right = portal->right};
}

/// Whether some direction crosses two portals forwards.
static bool crosses_both(const sl_portal_ends *a, const sl_portal_ends *b) {
    const sl_directed_portal first = directed_of(a), second = directed_of(b);
    return sli_direction_change_of(&first, &first, true, &second) != SLI_CROSSES_NEVER;
}

/// Tells the ends of the portal that turns and of the one or two before it that it turns against.
static void tell_turns(const sl_portal_ends *portals, uint32_t least, uint32_t most, uint32_t last,
                       sl_conflict *out) {
    uint32_t turned[3] = {least, most, last}, first = 0;
    for (uint32_t i = last; i-- > 0 && !first;) {
        if (crosses_both(&portals[last], &portals[i])) continue;
        turned[1] = i;
        first = 1;
    }
    *out = (sl_conflict){.verdict = SL_HIDDEN, .turns = true};
    for (uint32_t i = first; i < 3; i++)
        for (int side = 0; side < 2; side++)
            out->ends[out->end_count++] = (sl_stab_end){turned[i], side == 0};
}

/// Pushes portal by portal, until one leaves no direction or no line.
static sl_status push_all(sl_context *context, void *state, const sl_portal_ends *portals,
                          uint32_t count, sl_conflict *out) {
    const sl_solver *solver = sl_funnel();
    uint32_t least = 0, most = 0;
    for (uint32_t i = 0; i < count && out->verdict != SL_HIDDEN; i++) {
        const sl_directed_portal low = directed_of(&portals[least]),
                                 high = directed_of(&portals[most]), at = directed_of(&portals[i]);
        const sli_direction_change change =
            i ? sli_direction_change_of(&low, &high, least == most, &at) : SLI_CROSSES_WITHIN;
        if (change == SLI_CROSSES_NEVER) {
            tell_turns(portals, least, most, i, out);
            return SL_OK;
        }
        if (change == SLI_CROSSES_LEAST) least = i;
        if (change == SLI_CROSSES_MOST) most = i;
        SL_TRY(solver->push(context, state, at.left, at.right, &out->verdict));
    }
    if (out->verdict == SL_STABBED) return SL_OK;
    return solver->conflict(context, state, out->ends, &out->end_count);
}

sl_status sl_conflict_find(sl_context *context, const sl_portal_ends *portals, uint32_t count,
                           sl_conflict *out) {
    void *state;
    *out = (sl_conflict){.verdict = SL_STABBED};
    if (!count) return SL_OK;
    sl_box bounds = {portals[0].left, portals[0].left};
    for (uint32_t i = 0; i < 2 * count; i++) {
        const sl_point p = i % 2 ? portals[i / 2].right : portals[i / 2].left;
        bounds.min = (sl_point){fmin(bounds.min.x, p.x), fmin(bounds.min.y, p.y)};
        bounds.max = (sl_point){fmax(bounds.max.x, p.x), fmax(bounds.max.y, p.y)};
    }
    SL_TRY(sl_funnel()->create(context, bounds, &state));
    const sl_status status = push_all(context, state, portals, count, out);
    sl_funnel()->destroy(context, state);
    return status;
}
