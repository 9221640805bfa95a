/// What can be said of a portal sequence and of the ends that decide on it.
#include "sightline/explain.h"

#include "cell_to_cell/crossing.h"
#include "geometry/orient.h"

sl_point sl_sequence_end(const sl_space *space, const sl_sequence *sequence, sl_stab_end end) {
    const sl_directed_portal *directed = &space->directed[sequence->directed[end.portal]];
    return end.left ? directed->left : directed->right;
}

/// The places of the ends of one side, each once. Returns how many.
static uint32_t places_of(const sl_space *space, const sl_sequence *sequence, bool left,
                          sl_point places[SL_CONFLICT_MOST]) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < sequence->end_count; i++) {
        if (sequence->ends[i].left != left) continue;
        const sl_point p = sl_sequence_end(space, sequence, sequence->ends[i]);
        bool known = false;
        for (uint32_t k = 0; k < count; k++) known |= places[k].x == p.x && places[k].y == p.y;
        if (!known) places[count++] = p;
    }
    return count;
}

static bool cross(const sl_point a[2], const sl_point b[2]) {
    return sl_orient(a[0], a[1], b[0]) * sl_orient(a[0], a[1], b[1]) < 0 &&
           sl_orient(b[0], b[1], a[0]) * sl_orient(b[0], b[1], a[1]) < 0;
}

const char *sl_sequence_reason(const sl_space *space, const sl_sequence *sequence) {
    sl_point left[SL_CONFLICT_MOST], right[SL_CONFLICT_MOST];
    const uint32_t lefts = places_of(space, sequence, true, left);
    const uint32_t rights = places_of(space, sequence, false, right);
    if (lefts == 1 && rights == 1) return "that left end is the same point as that right end";
    if (lefts == 1 && rights == 2)
        return "that left end lies between those right ends, on one line";
    if (lefts == 2 && rights == 1)
        return "that right end lies between those left ends, on one line";
    if (lefts == 1) return "that left end lies within the triangle of those right ends";
    if (rights == 1) return "that right end lies within the triangle of those left ends";
    if (lefts == 2 && rights == 2 && cross(left, right))
        return "the segment between those left ends crosses the segment between those right ends";
    return "what lies between those left ends overlaps what lies between those right ends";
}
