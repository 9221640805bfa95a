/// Angular analysis of segments (Turner 2007, From axial to road-centre lines).
///
///      ----->o----->   0        A walk goes on into any other segment at the end of one, at the
///            |                  cost of the turn. A path's key is its turn, then its number of
///            v         256      segments. So keys are exact, ties are ties, and no step is free.
///
/// One search serves all segments of a chain (segment_network.h, segment_search.h): the key from a
/// segment to any other one is the least of four sums, for it leaves its chain by one of two ends,
/// and comes into the other chain by one of two. In the other chain, keys rise from one end and
/// fall from the other, so one place parts the segments that are nearer from one end from the
/// others:
///
///      key  \      /           At most one segment is at equal keys from both ends.
///            \    /
///      -o--o--o--o--o-
///
/// For most pairs of chains one of the four sums is the least for all segments, and all their
/// pairs are counted at once.
///
/// Choice is betweenness (Brandes 2001) on the states: the paths to both states of a segment share
/// its 1 where they tie. Sums are whole numbers, as in axial_measures.c. A path back is as long as
/// the path there. So within chains it is enough to count the paths that begin in them, twice.
///
/// Cost: O(pairs of chains that meet) for each chain, times the logarithm of the states of one turn
/// where streets are straight, and O(1) for each segment and chain where two of the sums are near
/// each other. Within a metric radius each segment is a chain, for it may end anywhere. Threads
/// take chains one by one.
#include "analysis/axial/segment_search.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/axial.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

/// Choice is counted in whole numbers of 2^-24 where paths count 1, for sums to be the same in any
/// order; see find_unit().
#define MOST_UNIT_BITS 24

/// Of one segment at home: an entry for each piece of the chain.
typedef struct root_sums {
    double weight, turns; ///< of segments that paths lead to
    double leaves[2];     ///< paths that leave home by the end that a tree starts from
    uint32_t ahead; ///< pieces behind it that are nearest within the chain, on the way to tree 0
    double share;   ///< of the path to the next one, that is as near another way
} root_sums;

/// A chain, in one line of the cache.
typedef struct chain_sums {
    double depends[4];    ///< by way, in one search: paths through the chain or into it
    uint64_t through[2];  ///< by state, in units: paths of all searches through the chain
    sli_segment_sums all; ///< of its pieces
    uint32_t first, stop; ///< places of its pieces
} chain_sums;

/// Paths within home, from roots on the way to tree 0.
typedef struct open_paths {
    double roots;  ///< their weight
    double pairs;  ///< the same, times the weight of the pieces up to where these end
    double shares; ///< the same, times the share of the next piece
} open_paths;

typedef struct scratch {
    sli_segment_search search;
    chain_sums *chains; ///< and one more, for the starts of trees
    root_sums *roots;   ///< for the chain of the most pieces
    open_paths *opened; ///< for the same, by the last place that their pairs reach
} scratch;

typedef struct job {
    sli_segment_network net;
    const sl_segment_options *options;
    sl_segment_measures *measures;
    uint64_t *within;          ///< by place, in units: paths that begin in its chain
    _Atomic uint64_t *through; ///< by state of a chain, of all threads
    double unit;
    uint32_t most_pieces;
} job;

// --- what a search adds up to

/// Along places of a chain: their key is `key` + their offset, or `key` - their offset if it comes
/// from the other end.
typedef struct walk {
    uint64_t key; ///< SLI_FAR or more if it does not come
    double paths;
} walk;

/// Segments from the first place to `before` are nearer forwards, those from `after` to the last
/// one backwards. If `ties`, the one at `before` is as near both ways.
typedef struct parting {
    uint32_t before, after;
    bool ties;
} parting;

/// Whether a place is nearer forwards.
static bool is_forwards(const sli_segment_network *n, uint32_t place, walk there, walk back,
                        uint64_t most) {
    const uint64_t key = there.key + n->offsets[place];
    return key < most && key < back.key - n->offsets[place];
}

static bool is_backwards(const sli_segment_network *n, uint32_t place, walk there, walk back,
                         uint64_t most) {
    const uint64_t key = back.key - n->offsets[place];
    return key < most && key < there.key + n->offsets[place];
}

static parting part_of(const sli_segment_network *n, uint32_t from, uint32_t to, walk there,
                       walk back, uint64_t most) {
    uint32_t low = from, high = to;
    if (from < to && is_forwards(n, to - 1, there, back, most)) return (parting){to, to, false};
    if (from < to && is_backwards(n, from, there, back, most)) return (parting){from, from, false};
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (is_forwards(n, middle, there, back, most))
            low = middle + 1;
        else
            high = middle;
    }
    parting p = {.before = low, .after = to};
    while (low < p.after) {
        const uint32_t middle = low + (p.after - low) / 2;
        if (is_backwards(n, middle, there, back, most))
            p.after = middle;
        else
            low = middle + 1;
    }
    if (p.before < p.after) {
        const uint64_t key = there.key + n->offsets[p.before];
        p.ties = key < most && key == back.key - n->offsets[p.before];
    }
    return p;
}

static uint64_t units_of(const job *j, double paths) {
    return (uint64_t)(paths * j->unit + 0.5);
}

/// Weight, and turns times weight, of some places of a chain, of which the first has this key.
/// `sign`: 1 if keys rise, -1 if they fall.
static sli_segment_sums sum_between(const sli_segment_network *n, uint32_t chain, uint32_t from,
                                    uint32_t to, uint64_t key, int sign) {
    const sli_segment_sums *low = &n->sums[(size_t)from + chain];
    const sli_segment_sums *high = &n->sums[(size_t)to + chain];
    const double weight = high->weight - low->weight;
    const double own = (double)(n->offsets[from] >> SLI_STEP_BITS);
    const double rise = high->turns - low->turns - weight * own;
    return (sli_segment_sums){weight, weight * (double)(key >> SLI_STEP_BITS) + sign * rise};
}

/// Paths from a root to some places of a chain, by the end that they come from.
typedef struct arrivals {
    uint32_t ahead;
    double share; ///< of the path to the next place
    double there, back;
} arrivals;

static arrivals arrive(const sli_segment_network *n, uint32_t chain, uint32_t from, uint32_t to,
                       walk there, walk back, uint64_t most, root_sums *root) {
    const parting p = part_of(n, from, to, there, back, most);
    arrivals a = {.ahead = p.before - from};
    if (p.before > from) {
        const sli_segment_sums sums =
            sum_between(n, chain, from, p.before, there.key + n->offsets[from], 1);
        a.there = sums.weight;
        root->turns += sums.turns;
    }
    if (p.after < to) {
        const sli_segment_sums sums =
            sum_between(n, chain, p.after, to, back.key - n->offsets[p.after], -1);
        a.back = sums.weight;
        root->turns += sums.turns;
    }
    root->weight += a.there + a.back;
    if (!p.ties) return a;
    const double weight = sli_segment_weight(n, p.before);
    a.share = there.paths / (there.paths + back.paths) * weight;
    a.there += a.share;
    a.back += back.paths / (there.paths + back.paths) * weight;
    root->weight += weight;
    root->turns += weight * (double)((there.key + n->offsets[p.before]) >> SLI_STEP_BITS);
    return a;
}

/// The way from a root to each end of its chain.
typedef struct way_out {
    uint64_t keys[2]; ///< by tree
} way_out;

static way_out way_out_of(const sli_segment_network *n, uint32_t home, uint32_t place) {
    return (way_out){{sli_offset_of_last(n, home) - n->offsets[place], n->offsets[place]}};
}

/// To the chain of a way of tree 0, in the same state: by whichever tree is nearer.
static walk nearer(const scratch *s, uint32_t way, way_out out) {
    const uint64_t keys[] = {sli_way_key(&s->search, way) + out.keys[0],
                             sli_way_key(&s->search, way + 2) + out.keys[1]};
    const double *paths = &s->search.paths[way];
    if (keys[0] == keys[1]) return (walk){keys[0], paths[0] + paths[2]};
    return keys[0] < keys[1] ? (walk){keys[0], paths[0]} : (walk){keys[1], paths[2]};
}

/// Notes paths from a root that end in a chain: those of nearer(), by tree.
static void end_in(scratch *s, uint32_t way, way_out out, double paths, double weight,
                   root_sums *root) {
    if (paths == 0) return;
    const uint64_t keys[] = {sli_way_key(&s->search, way) + out.keys[0],
                             sli_way_key(&s->search, way + 2) + out.keys[1]};
    const double *all = &s->search.paths[way];
    const double first = keys[0] < keys[1]    ? paths
                         : keys[0] == keys[1] ? all[0] / (all[0] + all[2]) * paths
                                              : 0;
    double *depends = &s->chains[way / 4].depends[way % 4];
    depends[0] += first * weight;
    depends[2] += (paths - first) * weight;
    root->leaves[0] += first;
    root->leaves[1] += paths - first;
}

/// Paths that end in a chain do not lead through it. add_choice() adds no less.
static void leave_out_ends(const job *j, chain_sums *c) {
    for (uint32_t way = 0; way < 4; way++)
        if (c->depends[way] > 0) c->through[way % 2] -= units_of(j, c->depends[way]);
}

/// The way by which all segments at home are nearest to all those of a chain; 4 if there is none.
static uint32_t only_way(const sli_segment_chain *c, uint64_t home, uint64_t most) {
    uint32_t k = 0;
    for (uint32_t i = 1; i < 4; i++)
        if (c->keys[i] < c->keys[k]) k = i;
    const uint64_t key = c->keys[k], last = sli_last_of(c);
    return c->keys[k ^ 1] > key + last && c->keys[k ^ 2] > key + home &&
                   c->keys[k ^ 3] > key + home + last && key + home + last < most
               ? k
               : 4;
}

/// Adds a chain that is not home to the sums of all roots.
static void end_in_chain(const job *j, scratch *s, uint32_t home, uint32_t chain, root_sums *all) {
    const sli_segment_network *n = &j->net;
    const sli_segment_chain *c = &s->search.chains[chain];
    const chain_sums *own = &s->chains[home];
    chain_sums *sums = &s->chains[chain];
    const uint32_t way = 4 * chain;
    const uint32_t only = only_way(c, sli_offset_of_last(n, home), s->search.most);
    if (only < 4) {
        const double turn = (double)(c->keys[only] >> SLI_STEP_BITS);
        const double last = (double)c->last_turn;
        const double paths = own->all.weight * sums->all.weight;
        all->weight += sums->all.weight;
        all->turns += sums->all.weight * turn +
                      (only % 2 ? sums->all.weight * last - sums->all.turns : sums->all.turns);
        all->leaves[only / 2] += sums->all.weight;
        sums->depends[only] = paths;
        sums->through[only % 2] -= units_of(j, paths);
        return;
    }
    for (uint32_t place = own->first; place < own->stop; place++) {
        const way_out out = way_out_of(n, home, place);
        const double weight = sli_segment_weight(n, place);
        const walk there = nearer(s, way, out);
        walk back = nearer(s, way + 1, out);
        back.key += sli_last_of(c);
        root_sums *root = &s->roots[place - own->first];
        const arrivals a =
            arrive(n, chain, sums->first, sums->stop, there, back, s->search.most, root);
        end_in(s, way, out, a.there, weight, root);
        end_in(s, way + 1, out, a.back, weight, root);
    }
    leave_out_ends(j, sums);
}

/// At home the root itself is one end of each walk.
static void end_at_home(const job *j, scratch *s, uint32_t home) {
    const sli_segment_network *n = &j->net;
    const uint32_t first = s->chains[home].first, stop = s->chains[home].stop;
    for (uint32_t place = first; place < stop; place++) {
        const way_out out = way_out_of(n, home, place);
        const double weight = sli_segment_weight(n, place);
        const walk there = nearer(s, 4 * home, out);
        walk back = nearer(s, 4 * home + 1, out);
        back.key += sli_offset_of_last(n, home);
        root_sums *root = &s->roots[place - first];
        const uint64_t most = s->search.most;
        const arrivals before =
            arrive(n, home, first, place, there, (walk){n->offsets[place], 1}, most, root);
        const arrivals behind =
            arrive(n, home, place + 1, stop, (walk){-n->offsets[place], 1}, back, most, root);
        end_in(s, 4 * home, out, before.there, weight, root);
        end_in(s, 4 * home + 1, out, behind.back, weight, root);
        root->ahead = behind.ahead;
        root->share = behind.share;
    }
    leave_out_ends(j, &s->chains[home]);
}

/// Adds up what the chains have in common for all roots.
static void add_all(const sli_segment_network *n, scratch *s, uint32_t home, const root_sums *all) {
    const uint32_t first = s->chains[home].first, stop = s->chains[home].stop;
    for (uint32_t place = first; place < stop; place++) {
        const way_out out = way_out_of(n, home, place);
        root_sums *root = &s->roots[place - first];
        root->weight += all->weight + sli_segment_weight(n, place);
        root->turns += all->turns;
        for (uint32_t tree = 0; tree < 2; tree++) {
            root->turns += all->leaves[tree] * (double)(out.keys[tree] >> SLI_STEP_BITS);
            root->leaves[tree] += all->leaves[tree];
        }
    }
}

/// From the farthest way back: paths share out among the ways that they come from.
static void add_choice(const job *j, scratch *s, uint32_t home) {
    const sli_segment_network *n = &j->net;
    for (uint32_t k = s->search.count; k-- > 0;) {
        const sli_segment_done *d = &s->search.order[k];
        if (k >= 8) __builtin_prefetch(&s->chains[d[-8].way / 4], 1);
        chain_sums *c = &s->chains[d->way / 4];
        const double depends = c->depends[d->way % 4];
        c->depends[d->way % 4] = 0;
        if (depends == 0) continue;
        c->through[d->way % 2] += units_of(j, depends);
        if (d->before != SLI_SEVERAL) {
            s->chains[d->before / 4].depends[d->before % 4] += depends;
            continue;
        }
        sli_segment_origin from = sli_segment_origins(n, &s->search, d->way, home);
        for (uint32_t way; sli_segment_origin_next(&from, &way);)
            s->chains[way / 4].depends[way % 4] +=
                s->search.paths[way] / s->search.paths[d->way] * depends;
    }
    for (uint32_t k = 0; k < 4; k++) s->chains[n->chain_count].depends[k] = 0;
}

/// Counts paths within the chain that they begin in. A path from the root at place p, on the way to
/// tree 0, passes place x to all places behind x, up to the last one that is nearest this way. So
/// walking back from the last place, roots join where that place is, and leave where they are
/// themselves. `before`: the weight of the pieces up to x.
static void add_home(const job *j, scratch *s, uint32_t home) {
    const sli_segment_network *n = &j->net;
    const uint32_t first = s->chains[home].first, count = s->chains[home].stop - first;
    const sli_segment_sums *sums = &n->sums[(size_t)first + home];
    open_paths now = {0};
    uint64_t left[2] = {0};
    memset(s->opened, 0, count * sizeof *s->opened);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t last = i + s->roots[i].ahead;
        const double weight = sli_segment_weight(n, first + i);
        s->opened[last].roots += weight;
        s->opened[last].shares += weight * s->roots[i].share;
    }
    for (uint32_t i = count; i-- > 0;) {
        const root_sums *root = &s->roots[i];
        const double weight = sli_segment_weight(n, first + i), before = sums[i + 1].weight;
        now.pairs += s->opened[i].roots * before - weight * sums[i + root->ahead + 1].weight;
        now.roots += s->opened[i].roots - weight;
        now.shares += s->opened[i].shares - weight * root->share;
        const double paths = now.pairs - now.roots * before + now.shares;
        j->within[first + i] = left[1] + (paths > 0 ? units_of(j, paths) : 0);
        left[1] += units_of(j, root->leaves[1] * weight);
    }
    for (uint32_t i = 0; i < count; i++) {
        j->within[first + i] += left[0];
        left[0] += units_of(j, s->roots[i].leaves[0] * sli_segment_weight(n, first + i));
    }
}

static sl_segment_measures measures_of(const sli_segment_network *n, uint32_t segment,
                                       const root_sums *root) {
    uint32_t meets = 0;
    for (int e = 0; e < 2; e++) {
        const uint32_t corner = n->corners[segment][e];
        meets += n->first_at[corner + 1] - n->first_at[corner] - 1;
    }
    const double total = root->turns / SLI_UNITS_OF_RIGHT_ANGLE, count = root->weight;
    return (sl_segment_measures){.connectivity = meets,
                                 .segment_length = n->lengths[segment],
                                 .t1024_node_count = count,
                                 .t1024_total_depth = total,
                                 .t1024_integration = total > 0 ? count * count / total : NAN,
                                 .nain = total > 0 ? pow(count, 1.2) / total : NAN};
}

static sl_status measure_chain(sl_context *context, void *all, void *state, size_t unit) {
    const job *j = all;
    const sli_segment_network *n = &j->net;
    scratch *s = state;
    const uint32_t home = (uint32_t)unit;
    const uint32_t first = s->chains[home].first, count = s->chains[home].stop - first;
    root_sums every = {0};
    SL_TRY(sl_check_cancelled(context));
    SL_TRY(sli_segment_search_run(context, n, j->options, home, &s->search));
    memset(s->roots, 0, count * sizeof *s->roots);
    for (uint32_t i = 0; i < s->search.reached_count; i++) {
        const uint32_t chain = s->search.reached[i];
        if (i + 8 < s->search.reached_count) {
            __builtin_prefetch(&s->search.chains[s->search.reached[i + 8]]);
            __builtin_prefetch(&s->chains[s->search.reached[i + 8]], 1);
        }
        if (chain != home && s->search.wanted[chain]) end_in_chain(j, s, home, chain, &every);
    }
    end_at_home(j, s, home);
    add_all(n, s, home, &every);
    add_choice(j, s, home);
    add_home(j, s, home);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t segment = n->pieces[first + i] / 2;
        j->measures[segment] = measures_of(n, segment, &s->roots[i]);
    }
    return SL_OK;
}

// --- all segments

static void end_segment_worker(sl_context *context, void *all, void *state) {
    const job *j = all;
    scratch *s = state;
    for (size_t i = 0; i < 2 * (size_t)j->net.chain_count && s->chains; i++)
        atomic_fetch_add(&j->through[i], s->chains[i / 2].through[i % 2]);
    sli_segment_search_destroy(context, &s->search);
    sl_free(context, s->chains);
    sl_free(context, s->roots);
    sl_free(context, s->opened);
    sl_free(context, s);
}

static sl_status begin_segment_worker(sl_context *context, void *all, void **state) {
    const job *j = all;
    const sli_segment_network *n = &j->net;
    scratch *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    s->chains = sl_alloc_array(context, (size_t)n->chain_count + 1, sizeof *s->chains);
    s->roots = sl_alloc_array(context, j->most_pieces, sizeof *s->roots);
    s->opened = sl_alloc_array(context, j->most_pieces, sizeof *s->opened);
    if (!s->chains || !s->roots || !s->opened ||
        sli_segment_search_make(context, n, j->options, &s->search) != SL_OK) {
        end_segment_worker(context, all, s);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < n->chain_count; i++) {
        chain_sums *c = &s->chains[i];
        c->first = n->first_piece[i];
        c->stop = n->first_piece[i + 1];
        c->all = n->sums[(size_t)c->stop + i];
    }
    *state = s;
    return SL_OK;
}

static sl_status measure_all(sl_context *context, job *j) {
    const sli_segment_network *n = &j->net;
    const sl_work work = {.job = j,
                          .begin = begin_segment_worker,
                          .unit = measure_chain,
                          .end = end_segment_worker,
                          .stage = "segment measures",
                          .units = "chains of segments"};
    SL_TRY(sl_work_run(context, &work, n->chain_count, j->options->threads));
    for (uint32_t i = 0; i < n->count; i++) {
        sl_segment_measures *m = &j->measures[i];
        const size_t chain = n->chain_of[i];
        const uint64_t choice = 2 * j->within[n->place_of[i]] +
                                atomic_load(&j->through[2 * chain]) +
                                atomic_load(&j->through[2 * chain + 1]);
        m->t1024_choice = (double)choice / (2 * j->unit); // seen from both ends
        m->nach = log10(m->t1024_choice + 1) / log10(m->t1024_total_depth + 3);
    }
    return SL_OK;
}

/// All paths together must fit into 64 bits.
static void find_unit(job *j) {
    double weight = 0;
    int bits;
    for (uint32_t i = 0; i < j->net.count; i++) weight += j->net.weights ? j->net.weights[i] : 1;
    frexp(weight, &bits);
    bits = 61 - 2 * bits;
    j->unit = ldexp(1, j->net.weights || bits < MOST_UNIT_BITS ? bits : MOST_UNIT_BITS);
}

static sl_status check_segments(sl_context *context, const sl_segment *segments, uint32_t count,
                                const double *weights) {
    for (uint32_t i = 0; i < count; i++) {
        if (sli_same_point(segments[i].a, segments[i].b))
            return sl_fail(context, SL_BAD_ARGUMENT, "segment %u has no length", i);
        if (weights && !(weights[i] >= 0 && weights[i] <= SL_SEGMENT_WEIGHT_MAX))
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "the weight of segment %u is %g, and not between 0 and %g", i,
                           weights[i], SL_SEGMENT_WEIGHT_MAX);
    }
    if (count > UINT32_MAX / 8) return sl_fail(context, SL_UNSUPPORTED, "too many segments");
    return SL_OK;
}

sl_status sl_segment_measure(sl_context *context, const sl_segment *segments, uint32_t count,
                             const sl_segment_options *options, sl_segment_measures *measures) {
    SL_TRY(check_segments(context, segments, count, options->weights));
    job j = {.options = options, .measures = measures};
    sl_status status = sli_segment_network_make(context, segments, count, options, &j.net);
    for (uint32_t i = 0; i < j.net.chain_count && status == SL_OK; i++)
        if (j.net.first_piece[i + 1] - j.net.first_piece[i] > j.most_pieces)
            j.most_pieces = j.net.first_piece[i + 1] - j.net.first_piece[i];
    if (status == SL_OK) {
        find_unit(&j);
        void *through = sl_alloc_array(context, 2 * (size_t)j.net.chain_count, sizeof *j.through);
        j.through = through;
        j.within = sl_alloc_array(context, count, sizeof *j.within);
        status = through && j.within ? measure_all(context, &j) : SL_NO_MEMORY;
        sl_free(context, through);
        sl_free(context, j.within);
    }
    sli_segment_network_destroy(context, &j.net);
    return status;
}

sl_status sl_segment_share(sl_context *context, const sl_segment *segments, uint32_t count,
                           const uint32_t *streets, const double *values, uint32_t street_count,
                           double *weights) {
    SL_TRY(check_segments(context, segments, count, NULL));
    for (uint32_t i = 0; i < count; i++)
        if (streets[i] >= street_count)
            return sl_fail(context, SL_BAD_ARGUMENT, "segment %u is of street %u, of %u", i,
                           streets[i], street_count);
    double *lengths = sl_alloc_array(context, street_count, sizeof *lengths);
    if (!lengths) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        const sl_segment *s = &segments[i];
        weights[i] = sli_length(s->b.x - s->a.x, s->b.y - s->a.y);
        lengths[streets[i]] += weights[i];
    }
    for (uint32_t i = 0; i < count; i++)
        weights[i] = values[streets[i]] * (weights[i] / lengths[streets[i]]);
    sl_free(context, lengths);
    return SL_OK;
}
