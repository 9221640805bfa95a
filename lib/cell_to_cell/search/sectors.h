/// Directions in sectors, and the order in which cells can be done within one (Laine 2005, sections
/// 3 and 4).
///
/// The full turn is cut into four quadrants where all portals are axial. Else portals' own
/// directions cut it further, so that within a sector each portal is crossed one way only. What a
/// cell sees in a sector then depends on the cells behind its portals alone, and that has an order.
#ifndef SL_SECTORS_H
#define SL_SECTORS_H

#include "cell_to_cell/search/directions.h"
#include "sightline/context.h"
#include "sightline/stab.h"

// --- sectors of directions

/// Sector s holds the directions from that of bounds[s] counter-clockwise to that of the next one,
/// both included: a quarter of a turn at most. Sector s + count / 2 has the opposite ones.
typedef struct sli_sectors {
    uint32_t count; ///< even, 4 at least
    sl_line *bounds;
} sli_sectors;

/// Cuts at the axes and at the directions of portals: at those of the longest ones, as far as
/// `most` sectors allow, 4 at least; 0 for all.
sl_status sli_sectors_create(sl_context *context, const sl_space *space, uint32_t most,
                             sli_sectors *out);
void sli_sectors_destroy(sl_context *context, sli_sectors *sectors);

/// Directions strictly between two, less than half a turn.
typedef struct sli_direction_sector {
    sl_line right, left;
} sli_direction_sector;

static inline sli_direction_sector sli_sectors_get(const sli_sectors *sectors, uint32_t sector) {
    return (sli_direction_sector){sectors->bounds[sector],
                                  sectors->bounds[(sector + 1) % sectors->count]};
}

/// Keeps those that cross a directed portal strictly forwards; false where there are none.
static inline bool sli_direction_sector_cut(sli_direction_sector *sector,
                                            const sl_directed_portal *directed) {
    const int of_right =
        sli_turn(sector->right.a, sector->right.b, directed->right, directed->left);
    const int of_left = sli_turn(sector->left.a, sector->left.b, directed->right, directed->left);
    if (of_right >= 0 && of_left >= 0) return true;
    if (of_right <= 0 && of_left <= 0) return false;
    if (of_right > 0)
        sector->left = (sl_line){directed->right, directed->left};
    else
        sector->right = (sl_line){directed->left, directed->right};
    return true;
}

// --- what depends on what

/// Node n depends on to[first[n]] .. to[first[n + 1] - 1].
typedef struct sli_dependence {
    uint32_t count;
    const uint32_t *first; ///< count + 1
    const uint32_t *to;
} sli_dependence;

/// The nodes in components: those that depend on each other round a cycle are in one, all others
/// alone. Component k is nodes[starts[k]] .. nodes[starts[k + 1] - 1]; it depends on components
/// before it only, and its level is one more than the highest of theirs, from 0.
typedef struct sli_order {
    uint32_t count, component_count, level_count;
    uint32_t *nodes;
    uint32_t *starts;    ///< component_count + 1
    uint32_t *component; ///< by node
    uint32_t *level;     ///< by component
} sli_order;

/// Tarjan 1972, Depth-First Search and Linear Graph Algorithms. Time and memory linear.
sl_status sli_order_create(sl_context *context, const sli_dependence *graph, sli_order *out);
void sli_order_destroy(sl_context *context, sli_order *order);

// --- one pass of the multipass method

/// What sli_pass.faces says of a directed portal that no sightline of the sector leaves by.
#define SLI_NO_FACE UINT32_MAX

typedef struct sli_pass {
    sli_direction_sector cone;
    uint32_t *faces; ///< by directed portal: its number among those that face the sector
    uint32_t face_count;
    uint32_t *first, *to; ///< the graph: a cell depends on those behind its faces
    sli_order order;
} sli_pass;

/// `inside_only`: what is not inside has no faces, and is behind none.
sl_status sli_pass_create(sl_context *context, const sl_space *space, bool inside_only,
                          sli_direction_sector cone, sli_pass *out);
void sli_pass_destroy(sl_context *context, sli_pass *pass);

#endif
