/// Angular analysis of segments (Turner 2007, From axial to road-centre lines).
///
///      ----->o----->   0        A walk goes on into any other segment at the end of one, at the
///            |                  cost of the turn. A path's key is its turn, then its number of
///            v         256      segments. So keys are exact, ties are ties, and no step is free.
///
/// A search from each segment starts in both directions (segment_search.h). It walks chains of
/// segments (segment_network.h), not segments: within a chain, keys are the key of its first piece
/// and a known offset. A segment is as far as the nearer of its states. In a chain that is entered
/// from both ends, keys rise from one end and fall from the other, so one place parts the segments
/// that are nearer from one end from the others:
///
///      key  \      /           At most one segment is at equal keys from both ends.
///            \    /
///      -o--o--o--o--o-
///
/// Choice is betweenness (Brandes 2001) on the states: the paths to both states of a segment share
/// its 1 where they tie. Sums are whole numbers, as in axial_measures.c. What one search adds to
/// all pieces of a chain before a place is kept at that place, and summed up in the end.
///
/// Cost: O(n * pairs of chains that meet) for n segments, times the logarithm of the states of one
/// turn. Within a metric radius each segment is a chain, for it may end anywhere. Threads take
/// segments one by one.
#include "analysis/axial/segment_search.h"
#include "geometry/orient.h"
#include "sightline/axial.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

/// Choice in whole numbers.
#define SHARE 0x1p24

/// What searches add to segments of a chain: see add_ends() and add_through().
typedef struct step {
    uint64_t ends, share;
} step;

typedef struct scratch {
    sli_segment_search search;
    double *ends; ///< by state of a chain: paths that end in it
    step *steps;  ///< by step_of()
} scratch;

typedef struct job {
    sli_segment_network net;
    const sl_segment_options *options;
    sl_segment_measures *measures;
    _Atomic uint64_t *steps; ///< of all threads, two for each
} job;

// --- what a search adds up to

/// Along places of a chain: their key is `key` + their offset, or `key` - their offset if it comes
/// from the other end.
typedef struct walk {
    bool comes;
    uint64_t key;
    double paths;
} walk;

/// Segments from the first place to `before` are nearer forwards, those from `after` to the last
/// one backwards. If `ties`, the one at `before` is as near both ways.
typedef struct parting {
    uint32_t before, after;
    bool ties;
} parting;

static parting part_of(const sli_segment_network *n, uint32_t from, uint32_t to, walk there,
                       walk back, uint64_t most) {
    uint32_t low = from, high = to;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const uint64_t key = there.key + n->offsets[middle];
        if (there.comes && key < most && (!back.comes || key < back.key - n->offsets[middle]))
            low = middle + 1;
        else
            high = middle;
    }
    parting p = {.before = low, .after = to};
    while (low < p.after) {
        const uint32_t middle = low + (p.after - low) / 2;
        const uint64_t key = back.key - n->offsets[middle];
        if (back.comes && key < most && (!there.comes || key < there.key + n->offsets[middle]))
            p.after = middle;
        else
            low = middle + 1;
    }
    if (p.before < p.after && there.comes && back.comes) {
        const uint64_t key = there.key + n->offsets[p.before];
        p.ties = key < most && key == back.key - n->offsets[p.before];
    }
    return p;
}

/// The place of a state in `steps`, before its first piece.
static size_t step_of(const sli_segment_network *n, uint32_t state) {
    const size_t chain = state / 2;
    return 2 * (n->first_piece[chain] + chain) +
           (state % 2 ? n->first_piece[chain + 1] - n->first_piece[chain] + 1 : 0);
}

static uint64_t units_of(double paths) {
    return (uint64_t)(paths * SHARE + 0.5);
}

/// Notes that a walk in this state begins after `from` pieces, ends `count` later, and has `share`
/// of a path to the piece behind these.
static void add_ends(const sli_segment_network *n, scratch *s, uint32_t state, uint32_t from,
                     uint32_t count, double share) {
    const uint64_t units = units_of(share);
    if (count < 2 && !units) return; // no piece of it is before another
    step *first = &s->steps[step_of(n, state) + from];
    first[count].ends++;
    first[count].share += units;
    if (!from) return;
    first->ends--;
    first->share -= count * (uint64_t)SHARE + units;
}

/// Notes that `depends` paths lead through all pieces of a chain in this state, from a place on.
static void add_through(const sli_segment_network *n, scratch *s, uint32_t state, uint32_t from,
                        double depends) {
    const uint64_t units = units_of(depends);
    step *first = &s->steps[step_of(n, state)];
    first[n->first_piece[state / 2 + 1] - n->first_piece[state / 2]].share += units;
    if (from) first[from].share -= units;
}

typedef struct sums {
    uint64_t nodes, turns;
} sums;

/// The sum of the turns of some places of a chain, of which the first has this key. `sign`: 1 if it
/// rises, -1 if it falls. Sums modulo 2^64.
static uint64_t turns_between(const sli_segment_network *n, uint32_t from, uint32_t to,
                              uint64_t key, int sign) {
    const uint64_t own = n->turns[from + 1] - n->turns[from];
    const uint64_t rise = n->turns[to] - n->turns[from] - (to - from) * own;
    return (to - from) * (key >> SLI_STEP_BITS) + (sign > 0 ? rise : -rise);
}

/// Adds the segments of some places of a chain to the sums, and to the choice of those before them.
static void end_at(const job *j, scratch *s, uint32_t chain, uint32_t from, uint32_t to, walk there,
                   walk back, sums *out) {
    const sli_segment_network *n = &j->net;
    const uint32_t first = n->first_piece[chain], stop = n->first_piece[chain + 1];
    const parting p = part_of(n, from, to, there, back, s->search.most);
    const uint32_t ahead = p.before - from, behind = to - p.after;
    const double share = p.ties ? there.paths / (there.paths + back.paths) : 0;
    const double other = p.ties ? back.paths / (there.paths + back.paths) : 0;
    out->nodes += ahead + behind + p.ties;
    if (ahead + p.ties)
        out->turns += turns_between(n, from, p.before + p.ties, there.key + n->offsets[from], 1);
    if (behind) out->turns += turns_between(n, p.after, to, back.key - n->offsets[p.after], -1);
    s->ends[2 * chain] = ahead + share;
    s->ends[2 * chain + 1] = behind + other;
    add_ends(n, s, 2 * chain, from - first, ahead, share);
    add_ends(n, s, 2 * chain + 1, stop - to, behind, other);
}

static walk walk_of(const scratch *s, uint32_t state, uint64_t offset) {
    const sli_segment_state *at = &s->search.states[state];
    return (walk){at->key < s->search.most, at->key + offset, at->paths};
}

/// At home the root itself is one end of each walk.
static void end_at_home(const job *j, scratch *s, uint32_t home, uint32_t place, sums *out) {
    const sli_segment_network *n = &j->net;
    const walk there = {true, -n->offsets[place], 1}, back = {true, n->offsets[place], 1};
    const walk again = walk_of(s, 2 * home + 1, sli_offset_of_last(n, home));
    end_at(j, s, home, n->first_piece[home], place, walk_of(s, 2 * home, 0), back, out);
    const double ends = s->ends[2 * home];
    end_at(j, s, home, place + 1, n->first_piece[home + 1], there, again, out);
    s->ends[2 * home] = ends;
}

/// Shares `depends` among the states that paths to this one come from. Arcs have the same turn both
/// ways, so those back from it, the other way round, lead to it.
static void hand_back(const job *j, scratch *s, uint32_t home, uint32_t state, double depends) {
    const sli_segment_network *n = &j->net;
    const sli_segment_state *at = &s->search.states[state];
    if (at->before != SLI_SEVERAL) {
        s->search.states[at->before].depends += depends;
        return;
    }
    for (size_t i = n->first[state ^ 1]; i < n->first[(state ^ 1) + 1]; i++) {
        const uint32_t to = n->arcs[i].to ^ 1;
        const bool start = to / 2 == home;
        sli_segment_state *before = &s->search.states[start ? 2 * n->chain_count + to % 2 : to];
        if (before->key == SLI_FAR) continue;
        const uint64_t end = before->key + (start ? 0 : sli_offset_of_last(n, to / 2));
        if (sli_key_after(&n->arcs[i], end) == at->key)
            before->depends += before->paths / at->paths * depends;
    }
}

/// From the farthest state back.
static void add_choice(const job *j, scratch *s, uint32_t root, sums *out) {
    const sli_segment_network *n = &j->net;
    const uint32_t home = n->chain_of[root], place = n->place_of[root];
    end_at_home(j, s, home, place, out);
    for (uint32_t k = s->search.count; k-- > 0;) {
        const uint32_t state = s->search.order[k], chain = state / 2;
        if (s->search.met[chain]) { // not yet this way; never at home
            s->search.met[chain] = false;
            if (s->search.wanted[chain])
                end_at(j, s, chain, n->first_piece[chain], n->first_piece[chain + 1],
                       walk_of(s, 2 * chain, 0),
                       walk_of(s, 2 * chain + 1, sli_offset_of_last(n, chain)), out);
            else
                s->ends[2 * chain] = s->ends[2 * chain + 1] = 0;
        }
        const double through = s->search.states[state].depends;
        if (through > 0) add_through(n, s, state, 0, through);
        if (through + s->ends[state] > 0) hand_back(j, s, home, state, through + s->ends[state]);
    }
    const sli_segment_state *starts = &s->search.states[2 * n->chain_count];
    add_through(n, s, 2 * home, place + 1 - n->first_piece[home], starts[0].depends);
    add_through(n, s, 2 * home + 1, n->first_piece[home + 1] - place, starts[1].depends);
}

static sl_status measure_segment(sl_context *context, void *all, void *state, size_t unit) {
    const job *j = all;
    const sli_segment_network *n = &j->net;
    scratch *s = state;
    const uint32_t root = (uint32_t)unit, *corners = n->corners[root];
    sums found = {.nodes = 1};
    SL_TRY(sl_check_cancelled(context));
    SL_TRY(sli_segment_search_run(context, n, j->options, root, &s->search));
    add_choice(j, s, root, &found);
    uint32_t meets = 0;
    for (int e = 0; e < 2; e++) meets += n->first_at[corners[e] + 1] - n->first_at[corners[e]] - 1;
    const double total = (double)found.turns / SLI_UNITS_OF_RIGHT_ANGLE,
                 count = (double)found.nodes;
    j->measures[root] =
        (sl_segment_measures){.connectivity = meets,
                              .segment_length = n->lengths[root],
                              .t1024_node_count = count,
                              .t1024_total_depth = total,
                              .t1024_integration = total > 0 ? count * count / total : NAN,
                              .nain = total > 0 ? pow(count, 1.2) / total : NAN};
    return SL_OK;
}

// --- all segments

static size_t step_count(const sli_segment_network *n) {
    return 2 * ((size_t)n->count + n->chain_count) + 1;
}

static void end_segment_worker(sl_context *context, void *all, void *state) {
    const job *j = all;
    scratch *s = state;
    for (size_t i = 0; i < step_count(&j->net) && s->steps; i++) {
        if (s->steps[i].ends) atomic_fetch_add(&j->steps[2 * i], s->steps[i].ends);
        if (s->steps[i].share) atomic_fetch_add(&j->steps[2 * i + 1], s->steps[i].share);
    }
    sli_segment_search_destroy(context, &s->search);
    sl_free(context, s->ends);
    sl_free(context, s->steps);
    sl_free(context, s);
}

static sl_status begin_segment_worker(sl_context *context, void *all, void **state) {
    const job *j = all;
    scratch *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    s->ends = sl_alloc_array(context, 2 * (size_t)j->net.chain_count + 1, sizeof *s->ends);
    s->steps = sl_alloc_array(context, step_count(&j->net), sizeof *s->steps);
    if (!s->ends || !s->steps ||
        sli_segment_search_make(context, &j->net, j->options, &s->search) != SL_OK) {
        end_segment_worker(context, all, s);
        return SL_NO_MEMORY;
    }
    *state = s;
    return SL_OK;
}

/// Adds to each piece of a chain in this state what is noted at the places behind it. Choice is
/// summed in `choice` by segment.
static void add_pieces(const job *j, uint32_t state, uint64_t *choice) {
    const sli_segment_network *n = &j->net;
    const uint32_t first = n->first_piece[state / 2], stop = n->first_piece[state / 2 + 1];
    const _Atomic uint64_t *steps = &j->steps[2 * step_of(n, state)];
    uint64_t ends = 0, rise = 0, share = 0;
    for (uint32_t k = stop - first; k-- > 0;) {
        rise += ends; // each walk that ends further on has one segment more
        ends += atomic_load(&steps[2 * (k + 1)]);
        share += atomic_load(&steps[2 * (k + 1) + 1]);
        const uint32_t place = state % 2 ? stop - 1 - k : first + k;
        choice[n->pieces[place] / 2] += rise * (uint64_t)SHARE + share;
    }
}

static sl_status measure_all(sl_context *context, job *j) {
    const sl_work work = {.job = j,
                          .begin = begin_segment_worker,
                          .unit = measure_segment,
                          .end = end_segment_worker,
                          .stage = "segment measures",
                          .units = "segments"};
    SL_TRY(sl_work_run(context, &work, j->net.count, j->options->threads));
    uint64_t *choice = sl_alloc_array(context, (size_t)j->net.count + 1, sizeof *choice);
    if (!choice) return SL_NO_MEMORY;
    for (uint32_t state = 0; state < 2 * j->net.chain_count; state++) add_pieces(j, state, choice);
    for (uint32_t i = 0; i < j->net.count; i++) {
        sl_segment_measures *m = &j->measures[i];
        m->t1024_choice = (double)choice[i] / (2 * SHARE); // seen from both ends
        m->nach = log10(m->t1024_choice + 1) / log10(m->t1024_total_depth + 3);
    }
    sl_free(context, choice);
    return SL_OK;
}

sl_status sl_segment_measure(sl_context *context, const sl_segment *segments, uint32_t count,
                             const sl_segment_options *options, sl_segment_measures *measures) {
    for (uint32_t i = 0; i < count; i++)
        if (sli_same_point(segments[i].a, segments[i].b))
            return sl_fail(context, SL_BAD_ARGUMENT, "segment %u has no length", i);
    if (count > UINT32_MAX / 8) return sl_fail(context, SL_UNSUPPORTED, "too many segments");
    job j = {.options = options, .measures = measures};
    sl_status status =
        sli_segment_network_make(context, segments, count, !(options->metric_radius > 0), &j.net);
    if (status == SL_OK) {
        void *steps = sl_alloc_array(context, 2 * step_count(&j.net), sizeof(_Atomic uint64_t));
        j.steps = steps;
        status = steps ? measure_all(context, &j) : SL_NO_MEMORY;
        sl_free(context, steps);
    }
    sli_segment_network_destroy(context, &j.net);
    return status;
}
