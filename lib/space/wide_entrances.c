/// Openings wider than entrances usually are, in plans that are drawn (begin with entrances.c).
///
/// Where an opening is in doubt, it is tried as an entrance: a pair of doors, a garage, a hall. So
/// are the next wider ones that this leaves in doubt. The answer counts if nothing is doubtful
/// then, and a building is inside.
///
/// Else the opening counts if what is inside hardly depends on the width, from the opening to twice
/// as wide ones. The walls say it then, and not the width:
///
///     share of the area inside
///     1 |             .-----------------.
///       |             |                  \\___
///     0 |_____________|______________________ width
///         usual   the opening     twice as wide
///
/// Else the narrow answer stays, with its doubt.
#include "sightline/space.h"
#include "sightline/support.h"
#include "space/entrances.h"

#include <math.h>

/// Doors of a plan are usually wider than this share of it.
#define DOORS_IN_PLAN 100
/// What a search found, kept while others are tried.
typedef struct answer {
    sl_interior interior; ///< with places of its own
    sl_glass *seams;
    size_t seam_count;
} answer;

static sl_status keep_answer(sl_context *context, const sl_map *map, answer *out) {
    const size_t places = map->interior.place_count;
    *out = (answer){.interior = map->interior, .seam_count = map->seam_count};
    out->interior.places = sl_alloc_array(context, places, sizeof *out->interior.places);
    out->seams = sl_alloc_array(context, map->seam_count, sizeof *out->seams);
    if (!out->interior.places || !out->seams) return SL_NO_MEMORY;
    for (size_t i = 0; i < places; i++) out->interior.places[i] = map->interior.places[i];
    for (size_t i = 0; i < map->seam_count; i++) out->seams[i] = map->seams[i];
    return SL_OK;
}

/// Gives the map an answer that it had before: it has room for the seams.
static void take_answer(sl_context *context, sl_map *map, answer *kept) {
    sl_free(context, map->interior.places);
    map->interior = kept->interior;
    kept->interior.places = NULL;
    for (size_t i = 0; i < kept->seam_count; i++) map->seams[i] = kept->seams[i];
    map->seam_count = kept->seam_count;
}

/// So many openings are tried, each wider than the one before: each takes a search of its own.
enum { MOST_WIDE = 8 };

/// Tries the doubtful opening, then wider ones. *found: nothing is doubtful, and a building is
/// inside.
///
/// A width that is found among openings that are small against the plan is not that of doors, but
/// of walls that nearly meet. Then none but such an opening is tried, and all that are wider are
/// doubtful.
static sl_status try_wider(sl_context *context, sl_map *map, const sl_interior *before,
                           bool *found) {
    const sl_box b = sl_map_bounds(map);
    const double across = b.max.x - b.min.x, up = b.max.y - b.min.y;
    const double widest = fmin(across, up) / 3, least = fmax(across, up) / DOORS_IN_PLAN;
    const bool small = before->by == SL_ENTRANCE_FOUND && before->doubtful_width <= least;
    const double most = small ? widest : SLI_DOUBT_FOUND * before->width;
    double width = 0;
    *found = true;
    for (int i = 0; i < MOST_WIDE && *found; i++) {
        const double next = map->interior.doubtful_width;
        if (!(next > width) || (small && next > least)) break;
        width = next;
        sli_entrances_forget(context, map);
        SL_TRY(sli_entrances_try(context, map, SL_ENTRANCE_WIDE, width, most, found));
    }
    *found &= !(map->interior.doubtful_width > 0);
    return SL_OK;
}

/// Takes the opening, if twice as wide ones would change little.
static sl_status try_steady(sl_context *context, sl_map *map, const sl_interior *before,
                            bool *found) {
    const double width = before->doubtful_width;
    sli_entrances_forget(context, map);
    SL_TRY(sli_entrances_are_steady(context, map, before->width, width, found));
    if (!*found) return SL_OK;
    return sli_entrances_try(context, map, SL_ENTRANCE_WIDE, width, width, found);
}

sl_status sli_entrances_widen(sl_context *context, sl_map *map) {
    const sl_interior before = map->interior;
    if (!map->entrance_may_be_wide || !(before.doubtful_width > 0)) return SL_OK;
    answer kept;
    bool found = false;
    sl_status status = keep_answer(context, map, &kept);
    if (status == SL_OK) status = try_wider(context, map, &before, &found);
    if (status == SL_OK && !found) status = try_steady(context, map, &before, &found);
    if (status == SL_OK && !found) take_answer(context, map, &kept);
    sl_free(context, kept.interior.places);
    sl_free(context, kept.seams);
    return status;
}
