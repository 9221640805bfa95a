/// The least turns from one segment to the states of all chains, or of those within a radius.
///
/// Turns from one chain to the next are bounded, so states wait in a ring of buckets, one for each
/// turn that may come next (Dial 1969); only the states of the turn at hand are kept in order, by a
/// heap. What a search has touched is set back before the next one, so that a search within a
/// radius costs what it reaches.
#ifndef SL_SEGMENT_SEARCH_H
#define SL_SEGMENT_SEARCH_H

#include "analysis/axial/segment_network.h"
#include "base/heap.h"
#include "sightline/axial.h"

typedef struct sli_segment_entry {
    uint64_t key;
    uint32_t state;
} sli_segment_entry;

static inline bool sli_is_nearer(const sli_segment_entry *a, const sli_segment_entry *b) {
    return a->key < b->key || (a->key == b->key && a->state < b->state);
}

SLI_HEAP(sli_segment_queue, sli_segment_entry, sli_is_nearer)

/// An entry that waits in a bucket.
typedef struct sli_segment_waiting {
    sli_segment_entry entry;
    uint32_t next; ///< of the bucket, from 1; 0 for the last
} sli_segment_waiting;

/// More than there are turns from the first piece of one chain to that of the next.
enum { SLI_BUCKETS = 2048, SLI_BUCKET_WORDS = SLI_BUCKETS / 64 };

#define SLI_FAR     UINT64_MAX
#define SLI_SEVERAL UINT32_MAX

/// A state of a chain, in one search.
typedef struct sli_segment_state {
    uint64_t key; ///< of its first piece; SLI_FAR if it was not reached
    double paths;
    double depends;  ///< for sums: on the walk beyond its last piece; 0 after the search
    uint32_t before; ///< the state that all paths to it come from; SLI_SEVERAL
} sli_segment_state;

typedef struct sli_segment_search {
    sli_segment_state *states; ///< of chains; then the root's two, whose keys are those of the ends
                               ///< of its chain
    bool *met;                 ///< by chain: one of its states is done, and it is not the root's
    bool *wanted;              ///< by chain
    uint32_t *order;           ///< of states that are done: ascending keys
    uint32_t count;
    uint64_t most; ///< states of this key and above are not reached
    // Its own:
    uint32_t *touched; ///< states that have a key
    double *far;       ///< by corner: along the network, from the middle of the root
    uint32_t *corners; ///< those that are not INFINITY far
    uint32_t *chosen;  ///< chains that are wanted, with a metric radius
    uint32_t touched_count, corner_count, chosen_count;
    sli_segment_queue queue; ///< of states of the turn at hand
    SL_ARRAY(sli_segment_waiting) waiting;
    uint32_t buckets[SLI_BUCKETS]; ///< into `waiting`, from 1; by turn modulo SLI_BUCKETS
    uint64_t filled[SLI_BUCKET_WORDS];
    uint64_t turn; ///< at hand
} sli_segment_search;

/// With a metric radius the network's chains must be single segments. Destroy it after failure,
/// too.
sl_status sli_segment_search_make(sl_context *context, const sli_segment_network *network,
                                  const sl_segment_options *options, sli_segment_search *out);
void sli_segment_search_destroy(sl_context *context, sli_segment_search *search);

/// Searches from a segment. A walk that comes back to the root's chain goes no further than to the
/// root.
sl_status sli_segment_search_run(sl_context *context, const sli_segment_network *network,
                                 const sl_segment_options *options, uint32_t root,
                                 sli_segment_search *search);

/// The key of a chain that an arc leads to, from the end of a chain, which has this key.
static inline uint64_t sli_key_after(const sli_segment_arc *arc, uint64_t end) {
    return end + ((uint64_t)arc->turn << SLI_STEP_BITS) + 1;
}

#endif
