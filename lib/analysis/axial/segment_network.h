/// A network of segments that meet at common ends, as a search walks it.
///
/// A walk along a segment has a direction, so each segment is two states: 2 s from a to b, and
/// 2 s + 1 back. Where only two segments meet, a walk has no choice:
///
///   o            o
///    \          /   A chain is a row of segments that meet so. A search takes it as one step:
///     o--o--o--o    it has two states as well, 2 c as its pieces are listed, and 2 c + 1 back.
///    /          \   Curved streets have many pieces, and few chains.
///   o            o
///
/// Turns are whole numbers: 1024th parts of a full turn. A key is a turn times 2^32, and a number
/// of steps from segment to segment.
#ifndef SL_SEGMENT_NETWORK_H
#define SL_SEGMENT_NETWORK_H

#include "sightline/axial.h"
#include "sightline/support.h"

enum { SLI_UNITS_OF_HALF_TURN = 512, SLI_UNITS_OF_RIGHT_ANGLE = 256, SLI_STEP_BITS = 32 };

/// No chain turns by more, so that searches know how far a step leads.
enum { SLI_MOST_OF_CHAIN = SLI_UNITS_OF_HALF_TURN };

/// No chain takes more steps.
enum { SLI_MOST_STEPS_OF_CHAIN = UINT16_MAX };

/// `late` of an arc counts in so many units of a turn: it fits a byte.
enum { SLI_LATE = 4 };

typedef struct sli_segment_arc {
    uint32_t to;   ///< a state of a chain
    uint16_t turn; ///< from the last piece of one chain to the first of the next
    uint8_t late; ///< in SLI_LATE turns, rounded up: how much later a walk back along `to` may come
                  ///< to the corner between, and be of use in a third chain that begins there
    bool ends;    ///< the last one from its state
} sli_segment_arc;

typedef struct sli_segment_sums {
    double weight;
    double turns; ///< of offsets, times the weight
} sli_segment_sums;

typedef struct sli_segment_network {
    const sl_segment *segments;
    const double *weights; ///< by segment; NULL: 1
    uint32_t count, corner_count, chain_count, arc_count;
    double *lengths;
    uint32_t (*corners)[2]; ///< by segment: where its a and b are
    uint32_t *first_at;     ///< by corner, and one more: into `at`
    uint32_t *at;           ///< states of segments that leave a corner, ascending
    uint32_t *first_piece;  ///< by chain, and one more: into `pieces`
    uint32_t *pieces;       ///< states of segments
    uint32_t *chain_of;     ///< by segment
    uint32_t *place_of;     ///< by segment: in `pieces`
    uint64_t *offsets;      ///< by place: the key from the chain's first piece to this one
    sli_segment_sums *sums; ///< by place + chain, one more for each chain: of its pieces before
    uint32_t *first;        ///< by state of chains: into `arcs`; `arc_count` if it has none
    sli_segment_arc *arcs;
    bool *straight; ///< by state of chains: a walk may go through it and on without a turn
} sli_segment_network;

/// Segments must have length. With a metric radius, chain c is segment c. Destroy it after failure,
/// too.
sl_status sli_segment_network_make(sl_context *context, const sl_segment *segments, uint32_t count,
                                   const sl_segment_options *options, sli_segment_network *out);
/// Takes the unlinked crossings of the options apart, before there are chains.
sl_status sli_segment_unlink(sl_context *context, const sl_segment_options *options,
                             sli_segment_network *network);
void sli_segment_network_destroy(sl_context *context, sli_segment_network *network);

/// From the first piece of a chain to its last one.
static inline uint64_t sli_offset_of_last(const sli_segment_network *n, uint32_t chain) {
    return n->offsets[n->first_piece[chain + 1] - 1];
}

static inline double sli_segment_weight(const sli_segment_network *n, uint32_t place) {
    return n->weights ? n->weights[n->pieces[place] / 2] : 1;
}

#endif
