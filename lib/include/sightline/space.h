/// The space: convex cells, the portals between them, and the tree that locates a point.
#ifndef SIGHTLINE_SPACE_H
#define SIGHTLINE_SPACE_H

#include "sightline/map.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What sl_space_locate says of a point outside the bounds.
#define SL_NO_CELL UINT32_MAX

/// A node of the subdivision tree. A child c >= 0 is node c, a child c < 0 is cell ~c.
typedef struct sl_node {
    double position; ///< the split line: x = position (axis 0) or y = position (axis 1)
    int32_t axis;
    int32_t below;    ///< where the coordinate is less than the position
    int32_t above;    ///< where it is not
    int32_t reserved; ///< 0
} sl_node;

/// A portal: a longest wall-free piece of the boundary that two cells share, of positive length.
/// Crossed from cell[0] to cell[1], `left` is at the left hand and `right` at the right.
typedef struct sl_portal {
    uint32_t cell[2]; ///< cell[0] < cell[1]
    sl_point left, right;
} sl_portal;

/// A portal as a cell has it: where it leads, and its ends as crossed on the way out.
typedef struct sl_exit {
    uint32_t portal, cell;
    sl_point left, right;
} sl_exit;

/// A cell: a convex polygon, free of walls inside. Its corners are vertices[first_vertex ...],
/// counter-clockwise; its exits are exits[first_exit ...], counter-clockwise from the first corner.
typedef struct sl_cell {
    uint32_t first_vertex, vertex_count;
    uint32_t first_exit, exit_count;
    uint32_t inside;   ///< 1 where a start, or no way from the map's border, leads to it
    uint32_t reserved; ///< 0
} sl_cell;

/// Zeroed, a space is empty.
typedef struct sl_space {
    sl_box bounds;
    int32_t root; ///< as a child of a node
    uint32_t node_count, cell_count, vertex_count, portal_count, exit_count, wall_count;
    uint32_t inside_count;
    uint32_t tree_depth; ///< nodes on the longest way down
    sl_node *nodes;      ///< a parent before its children
    sl_cell *cells;
    sl_point *vertices;
    sl_portal *portals; ///< by cell[0], then cell[1], then place
    sl_exit *exits;     ///< grouped by cell
    sl_wall *walls;     ///< those of the map it was made from
} sl_space;

/// The kd-tree's rules (Teller & Séquin 1991, Spatial Subdivision), applied one after the other to
/// the lines that hold a wall inside the cell. Start from sl_subdivide_options_default().
typedef struct sl_subdivide_options {
    bool spanning;   ///< walls that span the cell first, the median one of them
    double obscured; ///< then lines of which walls cover at least this share, if any; 0 for all
    bool cleaving;   ///< then those that cut the fewest walls
    bool median;     ///< then the one nearest to the median; off: the first
} sl_subdivide_options;

SL_API sl_subdivide_options sl_subdivide_options_default(void);

/// Subdivides by a kd-tree on the walls' own lines until no wall is inside a cell. Walls must be
/// axial (SL_BAD_INPUT names the first that is not) and clean (sl_map_clean). No coordinate is
/// computed: every one in the space is one of the map's (but for the bounds of a map without height
/// or width, which are padded), so that predicates on it are exact. Reports stage "subdivide".
SL_API sl_status sl_subdivide_kd(sl_context *context, const sl_map *map,
                                 const sl_subdivide_options *options, sl_space *out);

SL_API void sl_space_destroy(sl_context *context, sl_space *space); ///< and zeroes it

/// The cell that holds a point. On a split line the cell above (right of or over) it; on the upper
/// or right border the cell inside; SL_NO_CELL outside the bounds and for NaN. Time: the tree's
/// depth.
SL_API uint32_t sl_space_locate(const sl_space *space, sl_point point);

/// Area of a cell.
SL_API double sl_space_area(const sl_space *space, uint32_t cell);

/// Checks the whole graph: cells convex and of positive area, areas adding up to the bounds', no
/// wall inside a cell, portals on both their cells and on no wall, every piece of a cell's boundary
/// wall, portal or border, exits and portals telling the same, the tree leading to each cell once.
/// All but the sum of areas (relative 1e-9) by comparison of exact coordinates.
/// SL_BAD_INPUT with the first fault found.
SL_API sl_status sl_space_check(sl_context *context, const sl_space *space);

#ifdef __cplusplus
}
#endif

#endif
