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
#include "geometry/orient.h"
#include "sightline/axial.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

/// Choice in whole numbers.
#define SHARE 0x1p24

/// Of one segment at home: an entry for each piece of the chain.
typedef struct root_sums {
    uint64_t nodes, turns;
    double leaves[2]; ///< paths that leave home by the end that a tree starts from
    uint32_t ahead;   ///< pieces behind it that are nearest within the chain, on the way to tree 0
    double share;     ///< of the path to the next one, that is as near another way
} root_sums;

/// A chain, in one line of the cache.
typedef struct chain_sums {
    double depends[4];     ///< by way, in one search: paths through the chain or into it
    uint64_t through[2];   ///< by state, in units: paths of all searches through the chain
    uint64_t turns;        ///< of the offsets of its pieces
    uint32_t first, count; ///< places of its pieces
} chain_sums;

typedef struct scratch {
    sli_segment_search search;
    chain_sums *chains; ///< and one more, for the starts of trees
    root_sums *roots;   ///< for the chain of the most pieces
    uint64_t *opened;   ///< for the same, two each: see add_home()
} scratch;

typedef struct job {
    sli_segment_network net;
    const sl_segment_options *options;
    sl_segment_measures *measures;
    uint64_t *within;          ///< by place, in units: paths that begin in its chain
    _Atomic uint64_t *through; ///< by state of a chain, of all threads
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

static parting part_of(const sli_segment_network *n, uint32_t from, uint32_t to, walk there,
                       walk back, uint64_t most) {
    uint32_t low = from, high = to;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const uint64_t key = there.key + n->offsets[middle];
        if (key < most && key < back.key - n->offsets[middle])
            low = middle + 1;
        else
            high = middle;
    }
    parting p = {.before = low, .after = to};
    while (low < p.after) {
        const uint32_t middle = low + (p.after - low) / 2;
        const uint64_t key = back.key - n->offsets[middle];
        if (key < most && key < there.key + n->offsets[middle])
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

static uint64_t units_of(double paths) {
    return (uint64_t)(paths * SHARE + 0.5);
}

/// The sum of the turns of some places of a chain, of which the first has this key. `sign`: 1 if it
/// rises, -1 if it falls. Sums modulo 2^64.
static uint64_t turns_between(const sli_segment_network *n, uint32_t from, uint32_t to,
                              uint64_t key, int sign) {
    const uint64_t own = n->turns[from + 1] - n->turns[from];
    const uint64_t rise = n->turns[to] - n->turns[from] - (to - from) * own;
    return (to - from) * (key >> SLI_STEP_BITS) + (sign > 0 ? rise : -rise);
}

/// Paths from a root to some places of a chain, by the end that they come from.
typedef struct arrivals {
    uint32_t ahead;
    double share; ///< of the path to the next place
    double there, back;
} arrivals;

static arrivals arrive(const sli_segment_network *n, uint32_t from, uint32_t to, walk there,
                       walk back, uint64_t most, root_sums *root) {
    const parting p = part_of(n, from, to, there, back, most);
    const uint32_t ahead = p.before - from, behind = to - p.after;
    const double share = p.ties ? there.paths / (there.paths + back.paths) : 0;
    const double other = p.ties ? back.paths / (there.paths + back.paths) : 0;
    root->nodes += ahead + behind + p.ties;
    if (ahead + p.ties)
        root->turns += turns_between(n, from, p.before + p.ties, there.key + n->offsets[from], 1);
    if (behind) root->turns += turns_between(n, p.after, to, back.key - n->offsets[p.after], -1);
    return (arrivals){ahead, share, ahead + share, behind + other};
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

/// Paths that end in a chain do not lead through it.
static void add_ends(scratch *s, uint32_t way, double paths) {
    chain_sums *c = &s->chains[way / 4];
    c->depends[way % 4] += paths;
    c->through[way % 2] -= units_of(paths);
}

/// Notes paths that end in a chain: those of nearer(), by tree.
static void end_in(scratch *s, uint32_t way, way_out out, double paths, root_sums *root) {
    if (paths == 0) return;
    const uint64_t keys[] = {sli_way_key(&s->search, way) + out.keys[0],
                             sli_way_key(&s->search, way + 2) + out.keys[1]};
    const double *all = &s->search.paths[way];
    const double first = keys[0] < keys[1]    ? paths
                         : keys[0] == keys[1] ? all[0] / (all[0] + all[2]) * paths
                                              : 0;
    add_ends(s, way, first);
    add_ends(s, way + 2, paths - first);
    root->leaves[0] += first;
    root->leaves[1] += paths - first;
}

/// The way by which all segments at home are nearest to all those of a chain; 4 if there is none.
static uint32_t only_way(const sli_segment_chain *c, uint64_t home, uint64_t most) {
    uint32_t k = 0;
    for (uint32_t i = 1; i < 4; i++)
        if (c->keys[i] < c->keys[k]) k = i;
    const uint64_t key = c->keys[k];
    return c->keys[k ^ 1] > key + c->last && c->keys[k ^ 2] > key + home &&
                   c->keys[k ^ 3] > key + home + c->last && key + home + c->last < most
               ? k
               : 4;
}

/// Adds a chain that is not home to the sums of all roots.
static void end_in_chain(const sli_segment_network *n, scratch *s, uint32_t home, uint32_t chain,
                         root_sums *all) {
    const sli_segment_chain *c = &s->search.chains[chain];
    const chain_sums *sums = &s->chains[chain];
    const uint32_t from = sums->first, to = from + sums->count, way = 4 * chain;
    const uint32_t first = n->first_piece[home], stop = n->first_piece[home + 1];
    const uint32_t only = only_way(c, sli_offset_of_last(n, home), s->search.most);
    if (only < 4) {
        const uint64_t turn = c->keys[only] >> SLI_STEP_BITS, last = c->last >> SLI_STEP_BITS;
        all->nodes += sums->count;
        all->turns +=
            sums->count * turn + (only % 2 ? sums->count * last - sums->turns : sums->turns);
        all->leaves[only / 2] += sums->count;
        add_ends(s, way + only, (double)(stop - first) * sums->count);
        return;
    }
    for (uint32_t place = first; place < stop; place++) {
        const way_out out = way_out_of(n, home, place);
        const walk there = nearer(s, way, out);
        walk back = nearer(s, way + 1, out);
        back.key += c->last;
        root_sums *root = &s->roots[place - first];
        const arrivals a = arrive(n, from, to, there, back, s->search.most, root);
        end_in(s, way, out, a.there, root);
        end_in(s, way + 1, out, a.back, root);
    }
}

/// At home the root itself is one end of each walk.
static void end_at_home(const sli_segment_network *n, scratch *s, uint32_t home) {
    const uint32_t first = n->first_piece[home], stop = n->first_piece[home + 1];
    for (uint32_t place = first; place < stop; place++) {
        const way_out out = way_out_of(n, home, place);
        const walk there = nearer(s, 4 * home, out);
        walk back = nearer(s, 4 * home + 1, out);
        back.key += sli_offset_of_last(n, home);
        root_sums *root = &s->roots[place - first];
        const uint64_t most = s->search.most;
        const arrivals before =
            arrive(n, first, place, there, (walk){n->offsets[place], 1}, most, root);
        const arrivals behind =
            arrive(n, place + 1, stop, (walk){-n->offsets[place], 1}, back, most, root);
        end_in(s, 4 * home, out, before.there, root);
        end_in(s, 4 * home + 1, out, behind.back, root);
        root->ahead = behind.ahead;
        root->share = behind.share;
    }
}

/// Adds up what the chains have in common for all roots.
static void add_all(const sli_segment_network *n, scratch *s, uint32_t home, const root_sums *all) {
    const uint32_t first = n->first_piece[home], stop = n->first_piece[home + 1];
    for (uint32_t place = first; place < stop; place++) {
        const way_out out = way_out_of(n, home, place);
        root_sums *root = &s->roots[place - first];
        root->nodes += all->nodes;
        root->turns += all->turns;
        for (uint32_t tree = 0; tree < 2; tree++) {
            root->turns += (uint64_t)all->leaves[tree] * (out.keys[tree] >> SLI_STEP_BITS);
            root->leaves[tree] += all->leaves[tree];
        }
    }
}

/// From the farthest way back: paths share out among the ways that they come from.
static void add_choice(const sli_segment_network *n, scratch *s, uint32_t home) {
    for (uint32_t k = s->search.count; k-- > 0;) {
        const sli_segment_done *d = &s->search.order[k];
        if (k >= 8) __builtin_prefetch(&s->chains[d[-8].way / 4], 1);
        chain_sums *c = &s->chains[d->way / 4];
        const double depends = c->depends[d->way % 4];
        c->depends[d->way % 4] = 0;
        if (depends == 0) continue;
        c->through[d->way % 2] += units_of(depends);
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
/// tree 0, to a place q passes those between them. So walking back from the last place, the number
/// of paths over a place grows by 1 for each such pair behind it, until the root is behind it.
static void add_home(const job *j, scratch *s, uint32_t home) {
    const sli_segment_network *n = &j->net;
    const uint32_t first = n->first_piece[home], count = n->first_piece[home + 1] - first;
    uint64_t pairs = 0, paths = 0, share = 0, left[2] = {0};
    memset(s->opened, 0, 2 * (size_t)count * sizeof *s->opened);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t last = i + s->roots[i].ahead;
        s->opened[2 * last]++;
        s->opened[2 * last + 1] += units_of(s->roots[i].share);
    }
    for (uint32_t i = count; i-- > 0;) {
        const root_sums *root = &s->roots[i];
        paths += pairs;
        pairs += s->opened[2 * i] - 1;
        share += s->opened[2 * i + 1] - units_of(root->share);
        paths -= root->ahead;
        j->within[first + i] += paths * (uint64_t)SHARE + share + left[1];
        left[1] += units_of(root->leaves[1]);
    }
    for (uint32_t i = 0; i < count; i++) {
        j->within[first + i] += left[0];
        left[0] += units_of(s->roots[i].leaves[0]);
    }
}

static sl_segment_measures measures_of(const sli_segment_network *n, uint32_t segment,
                                       const root_sums *root) {
    uint32_t meets = 0;
    for (int e = 0; e < 2; e++) {
        const uint32_t corner = n->corners[segment][e];
        meets += n->first_at[corner + 1] - n->first_at[corner] - 1;
    }
    const double total = (double)root->turns / SLI_UNITS_OF_RIGHT_ANGLE,
                 count = (double)root->nodes + 1;
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
    const uint32_t first = n->first_piece[home], count = n->first_piece[home + 1] - first;
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
        if (chain != home && s->search.wanted[chain]) end_in_chain(n, s, home, chain, &every);
    }
    end_at_home(n, s, home);
    add_all(n, s, home, &every);
    add_choice(n, s, home);
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
    s->opened = sl_alloc_array(context, 2 * (size_t)j->most_pieces, sizeof *s->opened);
    if (!s->chains || !s->roots || !s->opened ||
        sli_segment_search_make(context, n, j->options, &s->search) != SL_OK) {
        end_segment_worker(context, all, s);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < n->chain_count; i++) {
        const uint32_t first = n->first_piece[i], stop = n->first_piece[i + 1];
        s->chains[i].first = first;
        s->chains[i].count = stop - first;
        s->chains[i].turns = turns_between(n, first, stop, 0, 1);
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
        m->t1024_choice = (double)choice / (2 * SHARE); // seen from both ends
        m->nach = log10(m->t1024_choice + 1) / log10(m->t1024_total_depth + 3);
    }
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
    for (uint32_t i = 0; i < j.net.chain_count && status == SL_OK; i++)
        if (j.net.first_piece[i + 1] - j.net.first_piece[i] > j.most_pieces)
            j.most_pieces = j.net.first_piece[i + 1] - j.net.first_piece[i];
    if (status == SL_OK) {
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
