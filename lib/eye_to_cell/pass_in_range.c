/// How far an eye sees: of a portal the nearest place between the borders of what is seen through
/// it. All of a cell that is seen through a portal is beyond it.
#include "eye_to_cell/eye_search.h"

#include "geometry/crossing.h"

/// Whether what an arc has of a directed portal's portal, which the eye is not on, is within range
/// of the eye, with open sight more of it than one place. Exact.
static bool reaches(const sl_pivot *pivot, const sl_arc *arc, const sl_directed_portal *directed,
                    double range, sl_sight sight) {
    const sl_glance glance = {.eye = {pivot->eye, pivot->rest},
                              .from = {arc->right.point, arc->right.rest},
                              .to = {arc->left.point, arc->left.rest},
                              .from_away = arc->right.away,
                              .to_away = arc->left.away,
                              .right = directed->right,
                              .left = directed->left};
    const int sign = sl_nearest_compare(&glance, range);
    return sight == SL_OPEN ? sign < 0 : sign <= 0;
}

void sl_eye_search_limit(sl_eye_search *search, double range) {
    search->range = range;
}

bool sl_eye_pass_in_range(sl_eye_query *query, const sl_eye_step *from, bool first,
                          const sl_directed_portal *directed, sl_eye_step *to) {
    const double range = query->search->range;
    if (!sl_eye_pass(query, from, first, directed, to)) return false;
    if (!(range > 0) || to->near) return true;
    unsigned kept = 0;
    for (unsigned i = 0; i < to->arc_count; i++)
        if (reaches(&query->pivot, &to->arcs[i], directed, range, query->search->visibility->sight))
            to->arcs[kept++] = to->arcs[i];
    to->arc_count = kept;
    return kept > 0;
}
