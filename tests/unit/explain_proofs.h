/// Proofs of what an explanation tells, each by other means than the library's.
#ifndef SL_EXPLAIN_PROOFS_H
#define SL_EXPLAIN_PROOFS_H

#include "testing.h"

#include "cell_to_cell/search/directions.h"
#include "geometry/orient.h"

#include <math.h>

/// Whether the directed portals lead from one cell to the next, and on from `from`. Returns the
/// last cell.
static inline uint32_t check_chain(const sl_space *space, uint32_t from,
                                   const sl_sequence *sequence) {
    uint32_t at = from;
    assert_true(sequence->directed_count > 0);
    for (uint32_t i = 0; i < sequence->directed_count; i++) {
        const uint32_t directed = sequence->directed[i];
        assert_true(directed >= space->cells[at].first_directed);
        assert_true(directed < space->cells[at].first_directed + space->cells[at].directed_count);
        at = space->directed[directed].cell;
    }
    return at;
}

/// What a line does to the ends of a side: 1 where all are strictly on it, 0 where some are
/// touched, -1 where some are on the other side.
static inline int keeps(sl_line line, sl_point left, sl_point right) {
    const int l = sli_orient(line.a, line.b, left), r = -sli_orient(line.a, line.b, right);
    return l < r ? l : r;
}

static inline void check_witness(const sl_space *space, const sl_explanation *e) {
    int least = 1;
    assert_true(e->witness.a.x != e->witness.b.x || e->witness.a.y != e->witness.b.y);
    for (uint32_t i = 0; i < e->sequence.directed_count; i++) {
        const sl_directed_portal *directed = &space->directed[e->sequence.directed[i]];
        const int kept = keeps(e->witness, directed->left, directed->right);
        if (kept < least) least = kept;
    }
    assert_int_equal(least, e->touches ? 0 : 1);
    if (e->verdict == SL_GRAZING) assert_true(e->touches);
    for (uint32_t i = 0; i < e->sequence.end_count; i++) {
        const sl_point p = sl_sequence_end(space, &e->sequence, e->sequence.ends[i]);
        assert_int_equal(sli_orient(e->witness.a, e->witness.b, p), 0);
    }
}

static inline bool in_one_place(const sl_point *ends, uint32_t count) {
    for (uint32_t i = 1; i < count; i++)
        if (ends[i].x != ends[0].x || ends[i].y != ends[0].y) return false;
    return true;
}

/// Whether some line keeps the ends on their sides or touches them: if any does, one through two of
/// them does.
static inline bool has_weak_line(const sl_point *ends, const bool *left, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = 0; j < count; j++) {
            if (ends[i].x == ends[j].x && ends[i].y == ends[j].y) continue;
            bool holds = true;
            for (uint32_t k = 0; k < count && holds; k++) {
                const int side = sli_orient(ends[i], ends[j], ends[k]);
                holds = left[k] ? side >= 0 : side <= 0;
            }
            if (holds) return true;
        }
    return in_one_place(ends, count);
}

/// Whether left and right ends, all on one line, can be parted by a point between them.
static inline bool parted_on_line(const sl_point *ends, const bool *left, uint32_t count) {
    // Along the line, by whichever coordinate differs.
    bool by_x = false;
    for (uint32_t i = 1; i < count; i++) by_x |= ends[i].x != ends[0].x;
    double lows[2] = {INFINITY, INFINITY}, highs[2] = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < count; i++) {
        const double value = by_x ? ends[i].x : ends[i].y;
        lows[left[i]] = fmin(lows[left[i]], value);
        highs[left[i]] = fmax(highs[left[i]], value);
    }
    return highs[0] < lows[1] || highs[1] < lows[0];
}

/// Whether some line keeps the ends strictly on their sides: if any does, it can be moved until it
/// touches a left and a right end, and a small turn about a point between them moves it back.
static inline bool has_strict_line(const sl_point *ends, const bool *left, uint32_t count) {
    bool any[2] = {false, false};
    for (uint32_t i = 0; i < count; i++) any[left[i]] = true;
    if (!any[0] || !any[1]) return true;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = 0; j < count; j++) {
            if (left[i] == left[j] || (ends[i].x == ends[j].x && ends[i].y == ends[j].y)) continue;
            sl_point on[SL_CONFLICT_MOST];
            bool on_left[SL_CONFLICT_MOST];
            uint32_t touched = 0;
            bool holds = true;
            for (uint32_t k = 0; k < count && holds; k++) {
                const int side = sli_orient(ends[i], ends[j], ends[k]);
                holds = left[k] ? side >= 0 : side <= 0;
                if (side != 0) continue;
                on[touched] = ends[k];
                on_left[touched++] = left[k];
            }
            if (holds && parted_on_line(on, on_left, touched)) return true;
        }
    return false;
}

static inline bool has_line(const sl_point *ends, const bool *left, uint32_t count, bool strict) {
    return strict ? has_strict_line(ends, left, count) : has_weak_line(ends, left, count);
}

/// The ends are a conflict, and none of them can be spared.
static inline void check_conflict(const sl_space *space, const sl_sequence *sequence, bool strict) {
    sl_point ends[SL_CONFLICT_MOST];
    bool left[SL_CONFLICT_MOST];
    const uint32_t count = sequence->end_count;
    assert_true(count >= 2 && count <= SL_CONFLICT_MOST);
    for (uint32_t i = 0; i < count; i++) {
        assert_true(sequence->ends[i].portal < sequence->directed_count);
        ends[i] = sl_sequence_end(space, sequence, sequence->ends[i]);
        left[i] = sequence->ends[i].left;
    }
    assert_false(has_line(ends, left, count, strict));
    for (uint32_t i = 0; i < count; i++) {
        const sl_point spared = ends[i];
        const bool spared_left = left[i];
        ends[i] = ends[count - 1];
        left[i] = left[count - 1];
        assert_true(has_line(ends, left, count - 1, strict));
        ends[i] = spared;
        left[i] = spared_left;
    }
}

/// Portals on the shortest way between two cells, seen or not.
static inline uint32_t distance_between(const sl_space *space, uint32_t from, uint32_t to) {
    uint32_t *distance = malloc(space->cell_count * sizeof *distance);
    assert_non_null(distance);
    for (uint32_t i = 0; i < space->cell_count; i++) distance[i] = i == from ? 0 : SL_NO_WAY;
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t i = 0; i < space->portal_count; i++)
            for (int k = 0; k < 2; k++) {
                const uint32_t a = space->portals[i].cell[k], b = space->portals[i].cell[!k];
                if (distance[a] == SL_NO_WAY || distance[b] <= distance[a] + 1) continue;
                distance[b] = distance[a] + 1;
                changed = true;
            }
    }
    const uint32_t result = distance[to];
    free(distance);
    return result;
}

/// The verdict on the first portals of a sequence.
static inline sl_stab_verdict verdict_on(sl_context *context, const sl_space *space,
                                         const sl_sequence *sequence, uint32_t count) {
    const sl_solver *funnel = sl_funnel();
    void *state;
    sl_stab_verdict verdict = SL_STABBED;
    assert_ok(context, funnel->create(context, space->bounds, &state));
    for (uint32_t i = 0; i < count; i++) {
        const sl_directed_portal *directed = &space->directed[sequence->directed[i]];
        assert_int_not_equal(verdict, SL_HIDDEN);
        assert_ok(context, funnel->push(context, state, directed->left, directed->right, &verdict));
    }
    funnel->destroy(context, state);
    return verdict;
}

static inline void check_turn(const sl_space *space, const sl_sequence *sequence) {
    assert_int_equal(sequence->end_count, 4);
    const uint32_t other = sequence->ends[0].portal, last = sequence->directed_count - 1;
    assert_true(other < last);
    // Axial portals leave no direction where two of them are crossed in opposite ones.
    const sl_directed_portal *a = &space->directed[sequence->directed[other]];
    const sl_directed_portal *b = &space->directed[sequence->directed[last]];
    const double ax = a->left.x - a->right.x, ay = a->left.y - a->right.y;
    const double bx = b->left.x - b->right.x, by = b->left.y - b->right.y;
    assert_true((ax == 0 && bx == 0 && (ay > 0) != (by > 0)) ||
                (ay == 0 && by == 0 && (ax > 0) != (bx > 0)));
    for (uint32_t i = 0; i < 4; i++) {
        assert_int_equal(sequence->ends[i].portal, i < 2 ? other : last);
        assert_int_equal(sequence->ends[i].left, i % 2 == 0);
    }
}

static inline void check_miss(sl_context *context, const sl_space *space, const sl_explanation *e,
                              uint32_t number) {
    const sl_miss *miss = &e->misses[number];
    const sl_sequence *sequence = &miss->sequence;
    const uint32_t count = sequence->directed_count;
    const uint32_t behind = check_chain(space, e->from, sequence);
    assert_int_not_equal(behind, e->from);
    for (uint32_t i = 0; i + 1 < count; i++)
        assert_int_not_equal(behind, space->directed[sequence->directed[i]].cell);
    const uint32_t portal = space->directed[sequence->directed[count - 1]].portal;
    const uint32_t before = space->portals[portal].cell[space->portals[portal].cell[0] == behind];
    assert_int_equal(miss->missing, distance_between(space, before, e->to));
    assert_int_equal(distance_between(space, behind, e->to), miss->missing - 1);
    assert_int_not_equal(verdict_on(context, space, sequence, count - 1), SL_HIDDEN);
    if (miss->turns) {
        check_turn(space, sequence);
    } else {
        assert_int_equal(verdict_on(context, space, sequence, count), SL_HIDDEN);
        check_conflict(space, sequence, false);
    }
    assert_non_null(sl_sequence_reason(space, sequence));
    for (uint32_t i = 0; i < number; i++) {
        const sl_miss *farther = &e->misses[i];
        assert_true(farther->missing <= miss->missing);
        const uint32_t last = farther->sequence.directed_count - 1;
        const sl_sequence head = {farther->sequence.directed, last, 0, {{0, false}}};
        const uint32_t cell = last ? check_chain(space, e->from, &head) : e->from;
        assert_int_not_equal(cell, before);
    }
}

#endif
