/// The direction space cut into sectors (Laine 2005, section 3): four quadrants where all portals
/// are axial. Else portals' own directions cut it further, so that within a sector each portal is
/// crossed one way only, and what depends on what has an order.
#ifndef SL_SECTORS_H
#define SL_SECTORS_H

#include "cell_to_cell/crossing.h"
#include "sightline/context.h"
#include "sightline/stab.h"

/// Sector s holds the directions from that of bounds[s] counter-clockwise to that of the next one,
/// both included: a quarter of a turn at most. Sector s + count / 2 has the opposite ones.
typedef struct sl_sectors {
    uint32_t count; ///< even, 4 at least
    sl_line *bounds;
} sl_sectors;

/// Cuts at the axes and at the directions of portals: at those of the longest ones, as far as
/// `most` sectors allow, 4 at least; 0 for all.
sl_status sl_sectors_create(sl_context *context, const sl_space *space, uint32_t most,
                            sl_sectors *out);
void sl_sectors_destroy(sl_context *context, sl_sectors *sectors);

/// Directions strictly between two, less than half a turn.
typedef struct sl_cone {
    sl_line right, left;
} sl_cone;

static inline sl_cone sl_sector_cone(const sl_sectors *sectors, uint32_t sector) {
    return (sl_cone){sectors->bounds[sector], sectors->bounds[(sector + 1) % sectors->count]};
}

/// Keeps those that cross a directed portal strictly forwards; false where there are none.
static inline bool sl_cone_cut(sl_cone *cone, const sl_directed_portal *directed) {
    const int of_right = sl_turn(cone->right.a, cone->right.b, directed->right, directed->left);
    const int of_left = sl_turn(cone->left.a, cone->left.b, directed->right, directed->left);
    if (of_right >= 0 && of_left >= 0) return true;
    if (of_right <= 0 && of_left <= 0) return false;
    if (of_right > 0)
        cone->left = (sl_line){directed->right, directed->left};
    else
        cone->right = (sl_line){directed->left, directed->right};
    return true;
}

#endif
