/// Compares the visible sets of several runs with an exact one, and finds the best runs.
#include "studies/compare.h"

#include <math.h>

/// Both rows are ascending runs of cells. Walk both at once, and add up what overlaps.
static uint64_t count_common(const sl_pvs *a, const sl_pvs *b, uint32_t cell) {
    uint64_t common = 0;
    sl_pvs_run in_a = sl_pvs_begin(a, cell), in_b = sl_pvs_begin(b, cell);
    bool more = sl_pvs_next(&in_a) && sl_pvs_next(&in_b);
    while (more) {
        const uint32_t first = in_a.first > in_b.first ? in_a.first : in_b.first;
        const uint32_t end = in_a.end < in_b.end ? in_a.end : in_b.end;
        if (first < end) common += end - first;
        more = sl_pvs_next(in_a.end < in_b.end ? &in_a : &in_b);
    }
    return common;
}

uint64_t pvs_pairs_beyond(const sl_pvs *a, const sl_pvs *b) {
    uint64_t neighbour = 0;
    for (uint32_t cell = 0; cell < a->cell_count; cell++)
        neighbour += sl_pvs_count(a, cell) - count_common(a, b, cell);
    return neighbour;
}

static bool is_exact(const compare_run *run) {
    return run->outcome == RUN_DONE && run->guarantee == SL_EXACT;
}

size_t compare_reference(const compare_run *runs, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (is_exact(&runs[i])) return i;
    return NO_RUN;
}

/// Pairs too many and pairs too few are different faults: culling tolerates the first, collecting
/// what is surely seen tolerates the second. Neither makes up for the other.
static bool beats(const compare_run *a, const compare_run *b) {
    return a->judged && a->seconds <= b->seconds && a->too_many <= b->too_many &&
           a->too_few <= b->too_few &&
           (a->seconds < b->seconds || a->too_many < b->too_many || a->too_few < b->too_few);
}

void compare_judge(compare_run *runs, size_t count) {
    const size_t reference = compare_reference(runs, count);
    if (reference == NO_RUN) return;
    const sl_pvs *exact = &runs[reference].visibility.pvs;
    double fastest = INFINITY;
    for (size_t i = 0; i < count; i++)
        if (is_exact(&runs[i])) fastest = fmin(fastest, runs[i].seconds);
    for (size_t i = 0; i < count; i++) {
        if (runs[i].outcome != RUN_DONE) continue;
        runs[i].judged = true;
        runs[i].too_many = pvs_pairs_beyond(&runs[i].visibility.pvs, exact);
        runs[i].too_few = pvs_pairs_beyond(exact, &runs[i].visibility.pvs);
        if (fastest > 0) runs[i].ratio = runs[i].seconds / fastest;
    }
    for (size_t i = 0; i < count; i++) {
        runs[i].frontier = runs[i].judged;
        for (size_t k = 0; k < count; k++)
            if (beats(&runs[k], &runs[i])) runs[i].frontier = false;
    }
}

void compare_order(const compare_run *runs, size_t count, size_t *order) {
    for (size_t i = 0; i < count; i++) {
        const double key = runs[i].outcome == RUN_DONE ? runs[i].seconds : INFINITY;
        size_t at = i;
        for (; at > 0; at--) {
            const compare_run *before = &runs[order[at - 1]];
            if ((before->outcome == RUN_DONE ? before->seconds : INFINITY) <= key) break;
            order[at] = order[at - 1];
        }
        order[at] = i;
    }
}
