/// Corners by sorting all ends; chains by walking on from corner to corner.
#include "analysis/axial/segment_network.h"

#include "geometry/length.h"
#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

#define HALF_TURN 3.14159265358979323846
#define NONE      UINT32_MAX

void sli_segment_network_destroy(sl_context *context, sli_segment_network *n) {
    sl_free(context, n->lengths);
    sl_free(context, n->corners);
    sl_free(context, n->first_at);
    sl_free(context, n->at);
    sl_free(context, n->first_piece);
    sl_free(context, n->pieces);
    sl_free(context, n->chain_of);
    sl_free(context, n->place_of);
    sl_free(context, n->offsets);
    sl_free(context, n->sums);
    sl_free(context, n->first);
    sl_free(context, n->arcs);
    sl_free(context, n->straight);
    *n = (sli_segment_network){0};
}

// --- corners

typedef struct tip {
    sl_point point;
    uint32_t end; ///< 2 s or 2 s + 1
} tip;

static int compare_tips(const void *left, const void *right) {
    const tip *a = left, *b = right;
    const int order = sli_compare_points(a->point, b->point);
    return order ? order : (a->end > b->end) - (a->end < b->end);
}

static sl_status find_corners(sl_context *context, sli_segment_network *n) {
    const size_t ends = 2 * (size_t)n->count;
    tip *tips = sl_alloc_array(context, ends + 1, sizeof *tips);
    n->lengths = sl_alloc_array(context, (size_t)n->count + 1, sizeof *n->lengths);
    n->corners = sl_alloc_array(context, (size_t)n->count + 1, sizeof *n->corners);
    n->first_at = sl_alloc_array(context, ends + 2, sizeof *n->first_at);
    n->at = sl_alloc_array(context, ends + 1, sizeof *n->at);
    if (!tips || !n->lengths || !n->corners || !n->first_at || !n->at) {
        sl_free(context, tips);
        return SL_NO_MEMORY;
    }
    for (uint32_t s = 0; s < n->count; s++) {
        const sl_segment *l = &n->segments[s];
        n->lengths[s] = sli_length(l->b.x - l->a.x, l->b.y - l->a.y);
        tips[2 * s] = (tip){l->a, 2 * s};
        tips[2 * s + 1] = (tip){l->b, 2 * s + 1};
    }
    qsort(tips, ends, sizeof *tips, compare_tips);
    for (size_t i = 0; i < ends; i++) {
        if (i == 0 || !sli_same_point(tips[i].point, tips[i - 1].point))
            n->first_at[n->corner_count++] = (uint32_t)i;
        n->at[i] = tips[i].end;
        n->corners[tips[i].end / 2][tips[i].end % 2] = n->corner_count - 1;
    }
    n->first_at[n->corner_count] = (uint32_t)ends;
    sl_free(context, tips);
    return SL_OK;
}

// --- chains

/// The turn from one walk into the next.
static uint16_t turn_of(const sli_segment_network *n, uint32_t from, uint32_t to) {
    const sl_segment *s = &n->segments[from / 2], *t = &n->segments[to / 2];
    const double sx = s->b.x - s->a.x, sy = s->b.y - s->a.y, sign = from % 2 == to % 2 ? 1 : -1;
    const double tx = sign * (t->b.x - t->a.x), ty = sign * (t->b.y - t->a.y);
    const double angle = fabs(atan2(sx * ty - sy * tx, sx * tx + sy * ty));
    return (uint16_t)lround(angle / HALF_TURN * SLI_UNITS_OF_HALF_TURN);
}

/// Where a state of a segment comes to.
static uint32_t end_of(const sli_segment_network *n, uint32_t state) {
    return n->corners[state / 2][1 - state % 2];
}

/// The only state that follows where just one other segment is; NONE elsewhere.
static uint32_t only_next(const sli_segment_network *n, uint32_t state) {
    const uint32_t *at = &n->at[n->first_at[end_of(n, state)]];
    if (n->first_at[end_of(n, state) + 1] - n->first_at[end_of(n, state)] != 2) return NONE;
    return at[0] / 2 == state / 2 ? at[1] : at[0];
}

/// Back to where a row of segments begins, or once round a ring.
static uint32_t row_start(const sli_segment_network *n, uint32_t state) {
    uint32_t back = state ^ 1;
    for (uint32_t next; (next = only_next(n, back)) != NONE && next / 2 != state / 2;) back = next;
    return back ^ 1;
}

static void add_chains(sli_segment_network *n, uint32_t state, bool join, uint32_t *place) {
    uint64_t offset = 0;
    while (state != NONE && n->chain_of[state / 2] == NONE) {
        if (!offset) n->first_piece[n->chain_count++] = *place;
        n->chain_of[state / 2] = n->chain_count - 1;
        n->place_of[state / 2] = *place;
        n->offsets[*place] = offset;
        n->pieces[(*place)++] = state;
        const uint32_t next = join ? only_next(n, state) : NONE;
        if (next != NONE) offset += ((uint64_t)turn_of(n, state, next) << SLI_STEP_BITS) + 1;
        if (offset >> SLI_STEP_BITS > SLI_MOST_OF_CHAIN ||
            (uint32_t)offset > SLI_MOST_STEPS_OF_CHAIN)
            offset = 0;
        state = next;
    }
}

static sl_status find_chains(sl_context *context, sli_segment_network *n, bool join) {
    const size_t count = (size_t)n->count + 1;
    uint32_t place = 0;
    n->first_piece = sl_alloc_array(context, count, sizeof *n->first_piece);
    n->pieces = sl_alloc_array(context, count, sizeof *n->pieces);
    n->chain_of = sl_alloc_array(context, count, sizeof *n->chain_of);
    n->place_of = sl_alloc_array(context, count, sizeof *n->place_of);
    n->offsets = sl_alloc_array(context, count, sizeof *n->offsets);
    if (!n->first_piece || !n->pieces || !n->chain_of || !n->place_of || !n->offsets)
        return SL_NO_MEMORY;
    for (uint32_t s = 0; s < n->count; s++) n->chain_of[s] = NONE;
    for (uint32_t s = 0; s < n->count; s++)
        if (n->chain_of[s] == NONE) add_chains(n, join ? row_start(n, 2 * s) : 2 * s, join, &place);
    n->first_piece[n->chain_count] = place;
    n->sums = sl_alloc_array(context, (size_t)n->count + n->chain_count + 1, sizeof *n->sums);
    if (!n->sums) return SL_NO_MEMORY;
    for (uint32_t chain = 0; chain < n->chain_count; chain++) {
        sli_segment_sums *sums = &n->sums[(size_t)n->first_piece[chain] + chain];
        for (uint32_t i = n->first_piece[chain]; i < n->first_piece[chain + 1]; i++, sums++) {
            const double weight = sli_segment_weight(n, i);
            sums[1] =
                (sli_segment_sums){sums->weight + weight,
                                   sums->turns + weight * (double)(n->offsets[i] >> SLI_STEP_BITS)};
        }
    }
    return SL_OK;
}

// --- arcs

/// The last piece of a chain, walked so that the chain is in this state.
static uint32_t last_piece(const sli_segment_network *n, uint32_t state) {
    const uint32_t chain = state / 2;
    return state % 2 ? n->pieces[n->first_piece[chain]] ^ 1
                     : n->pieces[n->first_piece[chain + 1] - 1];
}

/// The chain that begins with a state of a segment.
static uint32_t chain_from(const sli_segment_network *n, uint32_t state) {
    const uint32_t chain = n->chain_of[state / 2];
    return 2 * chain + (n->pieces[n->first_piece[chain]] != state);
}

/// A walk may turn from one segment into another, or come back along the other: `late` of the arc.
static uint8_t late_of(const sli_segment_network *n, uint32_t from, uint32_t to, uint16_t turn) {
    enum { MOST_ARMS = 8 }; // the time is the number of arms, for each pair of them
    const uint32_t corner = end_of(n, from);
    const uint32_t first = n->first_at[corner], stop = n->first_at[corner + 1];
    int late = 0;
    if (stop - first > MOST_ARMS) return SLI_UNITS_OF_HALF_TURN / SLI_LATE;
    for (uint32_t i = first; i < stop; i++) {
        const uint32_t into = n->at[i];
        if (into / 2 == from / 2 || into / 2 == to / 2) continue;
        const int more = turn_of(n, from, into) - turn_of(n, to ^ 1, into) - turn;
        if (more > late) late = more;
    }
    return (uint8_t)((late + SLI_LATE - 1) / SLI_LATE);
}

static sl_status find_arcs(sl_context *context, sli_segment_network *n) {
    const size_t states = 2 * (size_t)n->chain_count;
    uint64_t count = 0;
    uint32_t next = 0;
    n->first = sl_alloc_array(context, states + 1, sizeof *n->first);
    n->straight = sl_alloc_array(context, states + 1, sizeof *n->straight);
    if (!n->first || !n->straight) return SL_NO_MEMORY;
    for (uint32_t state = 0; state < states; state++) {
        const uint32_t corner = end_of(n, last_piece(n, state));
        count += n->first_at[corner + 1] - n->first_at[corner] - 1;
    }
    if (count >= UINT32_MAX)
        return sl_fail(context, SL_UNSUPPORTED, "too many segments meet in one point");
    n->arc_count = (uint32_t)count;
    n->arcs = sl_alloc_array(context, count + 1, sizeof *n->arcs);
    if (!n->arcs) return SL_NO_MEMORY;
    for (uint32_t state = 0; state < states; state++) {
        const uint32_t last = last_piece(n, state), corner = end_of(n, last), first = next;
        for (uint32_t i = n->first_at[corner]; i < n->first_at[corner + 1]; i++) {
            if (n->at[i] / 2 == last / 2) continue;
            const uint16_t turn = turn_of(n, last, n->at[i]);
            const uint8_t late = late_of(n, last, n->at[i], turn);
            n->arcs[next++] = (sli_segment_arc){chain_from(n, n->at[i]), turn, late, false};
            if (!turn && !(sli_offset_of_last(n, state / 2) >> SLI_STEP_BITS))
                n->straight[state] = true;
        }
        n->first[state] = next > first ? first : n->arc_count;
        if (next > first) n->arcs[next - 1].ends = true;
    }
    return SL_OK;
}

sl_status sli_segment_network_make(sl_context *context, const sl_segment *segments, uint32_t count,
                                   const sl_segment_options *options, sli_segment_network *out) {
    *out = (sli_segment_network){.segments = segments, .weights = options->weights, .count = count};
    SL_TRY(find_corners(context, out));
    SL_TRY(sli_segment_unlink(context, options, out));
    SL_TRY(find_chains(context, out, !(options->metric_radius > 0)));
    return find_arcs(context, out);
}
