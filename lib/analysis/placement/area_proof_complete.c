/// Adds to a choice among given places what the check of its proof misses: regions are laid over
/// the area in doubles, and where borders of several lie on one line but for rounding, a sliver may
/// be left that the search takes for none.
#include "analysis/placement/area_proof.h"

/// More slivers than these are no rounding. Each takes a check.
enum { MOST_ADDED = 16 };

/// Adds a place to the chosen ones, which ascend.
static sl_status add_chosen(sl_context *context, const sl_place_area *area, uint32_t place,
                            sl_area_placement *p) {
    uint32_t *more = sl_alloc_array(context, (size_t)p->count + 1, sizeof *more);
    if (!more) return SL_NO_MEMORY;
    uint32_t at = 0;
    for (; at < p->count && p->chosen[at] < place; at++) more[at] = p->chosen[at];
    more[at] = place;
    for (; at < p->count; at++) more[at + 1] = p->chosen[at];
    sl_free(context, p->chosen);
    p->chosen = more;
    p->count++;
    p->upper += area->costs ? area->costs[place] : 1;
    return SL_OK;
}

sl_status sl_place_area_proof_complete(sl_context *context, sl_query *query,
                                       const sl_place_area *area, sl_area_placement *placement,
                                       uint32_t *added, sl_place_area_verdict *out) {
    for (*added = 0;; ++*added) {
        SL_TRY(sl_place_area_proof_check(context, query, area, placement, out));
        if (out->sees_as_all || *added == MOST_ADDED) return SL_OK;
        SL_TRY(add_chosen(context, area, out->place, placement));
    }
}
