/// The least turns from the two ends of one chain to the states of all chains, or of those within a
/// radius.
///
///          home                  Paths from any piece at home leave it by one of its two ends.
///   ...--o--o--o--o--o--...      Each end has a tree of shortest paths, with its own start at the
///   tree 1          tree 0       key 0. So one search serves all pieces: the key from a piece is
///                                the less of two sums, the way to an end and the key from there.
///
/// A way is a state of a chain in a tree. Where the other tree, or the other end of the chain, is
/// so much nearer that no piece at home can gain by a way, it is left out.
///
/// Turns from one chain to the next are bounded, so ways wait in a ring of buckets, one for each
/// turn that may come next (Dial 1969). Only those that may go on without a turn are taken in
/// order, by a heap; the keys of the others of a turn are known when these are done. What a search
/// has touched is set back before the next one, so that a search within a radius costs what it
/// reaches.
#ifndef SL_SEGMENT_SEARCH_H
#define SL_SEGMENT_SEARCH_H

#include "analysis/axial/segment_network.h"
#include "base/heap.h"
#include "sightline/axial.h"

typedef struct sli_segment_entry {
    uint64_t key;
    uint32_t at; ///< a way, or a corner
} sli_segment_entry;

static inline bool sli_is_nearer(const sli_segment_entry *a, const sli_segment_entry *b) {
    return a->key < b->key || (a->key == b->key && a->at < b->at);
}

SLI_HEAP(sli_segment_queue, sli_segment_entry, sli_is_nearer)

/// A way that waits in a bucket.
typedef struct sli_segment_waiting {
    uint32_t way;
    uint32_t next; ///< of the bucket, from 1; 0 for the last
} sli_segment_waiting;

/// More than there are turns from the first piece of one chain to that of the next.
enum { SLI_BUCKETS = 2048, SLI_BUCKET_WORDS = SLI_BUCKETS / 64 };

/// Keys and offsets can be added to it.
#define SLI_FAR     (UINT64_MAX / 4)
#define SLI_SEVERAL UINT32_MAX

/// A chain and its four ways, in one line of the cache.
typedef struct sli_segment_chain {
    uint64_t keys[4];   ///< by way: of the chain's first piece; SLI_FAR if it was not reached
    uint32_t before[4]; ///< by way: the way or start that all paths come from; SLI_SEVERAL
    uint32_t first[2];  ///< as the network's
    uint16_t last_turn, last_steps; ///< the offset of its last piece
    uint8_t late[4];                ///< by way, in SLI_LATE turns, rounded up: see slack_of()
} sli_segment_chain;

static inline uint64_t sli_last_of(const sli_segment_chain *chain) {
    return ((uint64_t)chain->last_turn << SLI_STEP_BITS) + chain->last_steps;
}

/// A way that is done.
typedef struct sli_segment_done {
    uint32_t way, before; ///< as the chain's
} sli_segment_done;

typedef struct sli_segment_search {
    sli_segment_chain *chains;
    double *paths;           ///< by way: how many have its key; all are 1 unless `several`
    bool several;            ///< there are several paths of one key
    bool *met;               ///< by chain: one of its ways is done, and it is not home
    bool *wanted;            ///< by chain
    sli_segment_done *order; ///< no path leads from one to an earlier one
    uint32_t *reached;       ///< chains that have a key
    uint32_t count, reached_count;
    uint64_t most; ///< ways of this key and above are not reached
    // Its own:
    double *far;       ///< by corner: along the network, from the middle of the root
    uint32_t *corners; ///< those that are not INFINITY far
    uint32_t *chosen;  ///< chains that are wanted, with a metric radius
    uint32_t *last;    ///< ways of the turn at hand that do not go on without a turn
    uint32_t last_count, corner_count, chosen_count;
    sli_segment_queue queue; ///< of the other ways of the turn at hand
    SL_ARRAY(sli_segment_waiting) waiting;
    uint32_t unused;               ///< of `waiting`, from 1
    uint32_t buckets[SLI_BUCKETS]; ///< into `waiting`, from 1; by turn modulo SLI_BUCKETS
    uint64_t filled[SLI_BUCKET_WORDS];
    uint64_t turn; ///< at hand
} sli_segment_search;

/// With a metric radius the network's chains must be single segments. Destroy it after failure,
/// too.
sl_status sli_segment_search_make(sl_context *context, const sli_segment_network *network,
                                  const sl_segment_options *options, sli_segment_search *out);
void sli_segment_search_destroy(sl_context *context, sli_segment_search *search);

/// Searches from both ends of a chain. A walk that comes back to it goes no further.
sl_status sli_segment_search_run(sl_context *context, const sli_segment_network *network,
                                 const sl_segment_options *options, uint32_t home,
                                 sli_segment_search *search);

static inline uint64_t sli_way_key(const sli_segment_search *s, uint32_t way) {
    return s->chains[way / 4].keys[way % 4];
}

/// The key of a chain that an arc leads to, from the end of a chain, which has this key.
static inline uint64_t sli_key_after(const sli_segment_arc *arc, uint64_t end) {
    return end + ((uint64_t)arc->turn << SLI_STEP_BITS) + 1;
}

/// Ways of a chain are 4 c to 4 c + 3: its two states in tree 0, then in tree 1.
static inline uint32_t sli_way(uint32_t state, uint32_t tree) {
    return 2 * state - state % 2 + 2 * tree;
}
static inline uint32_t sli_state_of(uint32_t way) {
    return way / 4 * 2 + way % 2;
}
static inline uint32_t sli_tree_of(uint32_t way) {
    return way / 2 % 2;
}

/// Where a tree starts; beyond all ways.
static inline uint32_t sli_tree_start(const sli_segment_network *n, uint32_t tree) {
    return 4 * n->chain_count + tree;
}

/// The ways and starts from which paths with a way's key come to it, one after another. Arcs have
/// the same turn both ways, so those back from it, the other way round, lead to it.
typedef struct sli_segment_origin {
    const sli_segment_network *network;
    const sli_segment_search *search;
    const sli_segment_arc *arc; ///< NULL after the last
    uint32_t tree, home;
    uint64_t key;
} sli_segment_origin;

static inline sli_segment_origin sli_segment_origins(const sli_segment_network *n,
                                                     const sli_segment_search *s, uint32_t way,
                                                     uint32_t home) {
    const sli_segment_arc *first = &n->arcs[n->first[sli_state_of(way) ^ 1]];
    return (sli_segment_origin){n, s, first, sli_tree_of(way), home, sli_way_key(s, way)};
}

static inline bool sli_segment_origin_next(sli_segment_origin *o, uint32_t *origin) {
    while (o->arc) {
        const sli_segment_arc *arc = o->arc;
        const uint32_t to = arc->to ^ 1;
        const bool start = to / 2 == o->home && to % 2 == o->tree;
        *origin = start ? sli_tree_start(o->network, o->tree) : sli_way(to, o->tree);
        o->arc = arc->ends ? NULL : arc + 1;
        if (to / 2 == o->home && !start) continue;
        const uint64_t end =
            start ? 0 : sli_way_key(o->search, *origin) + sli_last_of(&o->search->chains[to / 2]);
        if (sli_key_after(arc, end) == o->key) return true;
    }
    return false;
}

#endif
