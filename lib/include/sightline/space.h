/// The space: convex cells, the portals between them, and the tree that locates a point.
#ifndef SIGHTLINE_SPACE_H
#define SIGHTLINE_SPACE_H

#include "sightline/map.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What sl_space_locate says of a point outside the bounds.
#define SL_NO_CELL UINT32_MAX

/// A node of the subdivision tree. A child c >= 0 is node c, a child c < 0 is cell ~c. In a BSP
/// several nodes may have one child.
typedef struct sl_node {
    double position; ///< the split line: x = position (axis 0) or y = position (axis 1)
    int32_t axis;    ///< 2: the line through space.lines[line], from its a to its b; position is 0
    int32_t below;   ///< where the coordinate is less than the position; strictly right of the line
    int32_t above;   ///< where it is not
    int32_t line;    ///< 0 but for axis 2
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

typedef enum sl_seam_kind { SL_SEAM_PLAIN, SL_SEAM_DOOR, SL_SEAM_ONEWAY } sl_seam_kind;

/// A seam: what of the map is seen through, or can be, and cuts the cells all the same.
typedef struct sl_seam {
    sl_segment at;
    uint32_t kind;   ///< of sl_seam_kind
    uint32_t number; ///< of the map's seams, doors or oneways
} sl_seam;

/// That a portal lies on a seam.
typedef struct sl_seam_portal {
    uint32_t portal, seam;
    uint32_t forward; ///< 1 where going from cell[0] to cell[1] crosses the seam from its right to
                      ///< its left, going from its a to its b; else 0
} sl_seam_portal;

/// What sl_space.beyond says of a side that is no wall: the cell's next exit, or the map's border.
/// Else it is the wall's number, with SL_BEYOND_RIGHT or-ed where the cell is at the wall's right,
/// going from its a to its b.
#define SL_BEYOND_EXIT   UINT32_MAX
#define SL_BEYOND_BORDER (UINT32_MAX - 1)
#define SL_BEYOND_RIGHT  0x80000000u

/// Zeroed, a space is empty.
///
/// A space made by a BSP has `beyond`. Its cells' corners may then be flat: there is one wherever a
/// portal ends, so that each side is one exit, a piece of one wall, or border.
///
/// Cells do not run over seams: each portal lies on a seam wholly or not at all. Where a wall
/// covers a seam there is no portal.
typedef struct sl_space {
    sl_box bounds;
    int32_t root; ///< as a child of a node
    uint32_t node_count, cell_count, vertex_count, portal_count, exit_count, wall_count;
    uint32_t inside_count;
    uint32_t tree_depth; ///< nodes on the longest way down
    uint32_t line_count; ///< 0 for a kd-tree
    uint32_t partial;    ///< 1 where cells need not fill the bounds: they came with the map
    uint32_t seam_count, seam_portal_count;
    sl_node *nodes; ///< a parent before its children
    sl_cell *cells;
    sl_point *vertices;
    sl_portal *portals; ///< by cell[0], then cell[1], then place
    sl_exit *exits;     ///< grouped by cell
    sl_wall *walls;     ///< those of the map it was made from
    sl_segment *lines;  ///< of two different ends; what nodes of axis 2 split along
    uint32_t *beyond;   ///< by vertex: the wall on the side from there to the cell's next corner,
                        ///< SL_BEYOND_EXIT or SL_BEYOND_BORDER; NULL for a kd-tree
    sl_seam *seams;     ///< the map's doors, one-way glass and seams; NULL for none
    sl_seam_portal *seam_portals; ///< by portal, then seam; NULL for none
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

/// Subdivides by a kd-tree on the walls' own lines until no wall is inside a cell. Walls and seams
/// must be axial (SL_BAD_INPUT names the first that is not), walls clean (sl_map_clean). No
/// coordinate is computed: every one in the space is one of the map's (but for the bounds of a map
/// without height or width, which are padded), so that predicates on it are exact. Reports stage
/// "subdivide".
SL_API sl_status sl_subdivide_kd(sl_context *context, const sl_map *map,
                                 const sl_subdivide_options *options, sl_space *out);

/// The BSP's cost of a split, the least of which is taken: cuts * (share of the walls that it cuts)
/// + imbalance * (difference between the shares left on either side) - obscured * (share of its
/// length that walls cover). Start from sl_bsp_options_default().
typedef struct sl_bsp_options {
    double cuts, imbalance, obscured; ///< finite, not negative
    uint32_t candidates;              ///< walls tried for each split, at least 1
} sl_bsp_options;

SL_API sl_bsp_options sl_bsp_options_default(void);

/// Subdivides by a BSP on the walls' own lines (auto-partition: Teller 1992) until no wall is
/// inside a cell. Walls may be oblique and may cross, touch, overlap and repeat; those of no length
/// count for nothing.
///
/// Cells are convex by exact predicates on the corners as they are stored, both sides of a portal
/// have the same ends, and a wall's ends stay exact: all later stages are exact for the space as it
/// stands. No place sees less than in the map: whatever two points a segment joins that touches no
/// wall, the cells that sl_space_locate names for them see each other. For that, corners that have
/// to be computed (where walls cross each other or a portal) lie on their wall's line or behind it,
/// as seen from the cell: neighbouring cells may overlap along walls, and sight be added through
/// slivers, by the size of rounding. A portal runs along a wall's line only as far as doubles can
/// tell a point exactly on it; where there is none, a wall that ends in the open is joined to two
/// corners instead, a triangle between them. Where walls are a few steps of doubles apart, one may
/// be left out of a cell that has no room for its corners: sight is added there, and sl_space_check
/// names the cell.
///
/// Seams are put in after the walls, and seen through: where a portal on one has to end in a point
/// that is computed, it lies beside the seam's line by the size of rounding, or, where cells are
/// needles, by up to 2^-25 of the map's size. A cell that leaves no room for such a point goes
/// without the seam, and a note says so.
///
/// Time about O(n log n) for n walls with few long ones; reports stage "subdivide".
/// SL_BAD_INPUT where there is no wall, SL_BAD_ARGUMENT for options out of range.
SL_API sl_status sl_subdivide_bsp(sl_context *context, const sl_map *map,
                                  const sl_bsp_options *options, sl_space *out);

/// Takes the cells that the map brings along (sl_map.cells) for a space of the BSP's kind. They may
/// be as rounded as node builders leave them: cells bent by rounding, T-junctions, corners off
/// their walls; places within the map's `snap` of each other are one. Corners on walls are moved
/// onto the wall's line or behind it, and cells that are bent are cut by diagonals: a cell becomes
/// several then, and none is joined; those without area are left out.
///
/// What a BSP's space promises holds here within the cells: whatever two points of cells a segment
/// joins that touches no wall, the cells that sl_space_locate names for them see each other. So the
/// cells may leave gaps only where nobody sees: behind walls, and beyond sides that have all cells
/// on one hand. Points in no cell have none (SL_NO_CELL).
///
/// SL_BAD_INPUT, naming the cell and the place, for cells that cannot be taken: a side that is
/// neither along a wall nor shared with another cell, cells that overlap or are bent beyond repair,
/// a wall within a cell. The whole graph is checked (sl_space_check).
SL_API sl_status sl_subdivide_given(sl_context *context, const sl_map *map, sl_space *out);

/// A way to subdivide: reachable by name, listed everywhere from this table.
typedef struct sl_subdivision {
    const char *name, *what;
    bool takes_rules; ///< the kd-tree's rules are for it; others pass them over
    bool takes_cells; ///< it needs the map's own cells; others pass them over
    /// NULL for the usual rules. Fails as the function does that it stands for.
    sl_status (*subdivide)(sl_context *context, const sl_map *map,
                           const sl_subdivide_options *rules, sl_space *out);
} sl_subdivision;

/// All of them: "kd", "bsp", "given".
SL_API const sl_subdivision *sl_subdivisions(size_t *count);

/// What a map calls for: its own cells where it has any, the kd-tree where all walls and seams are
/// axial, else the BSP.
SL_API const sl_subdivision *sl_subdivision_for(const sl_map *map);

SL_API void sl_space_destroy(sl_context *context, sl_space *space); ///< and zeroes it

/// The cell that holds a point. On a split line the cell above (right of or over) it, left of an
/// oblique one; on the upper or right border the cell inside; SL_NO_CELL outside the bounds and for
/// NaN. Time: the tree's depth. In a BSP's space what the tree finds is left through exits that
/// have the point strictly beyond them, 16 at most; where that leads to no cell that holds the
/// point, all cells are asked; SL_NO_CELL where the cells came with the map and none holds it.
SL_API uint32_t sl_space_locate(const sl_space *space, sl_point point);

/// A box to be put into a space for the time being (sightline/moving.h), which may be without width
/// or height. Boxes may overlap and touch walls, each other and the eye, and lie out of the bounds
/// in part or wholly.
typedef struct sl_moving_box {
    sl_box box;
    bool blocks; ///< its four sides are walls; else it is seen through
} sl_moving_box;

/// The seams that a portal lies on, *count of them; NULL for none.
SL_API const sl_seam_portal *sl_space_seams_of(const sl_space *space, uint32_t portal,
                                               size_t *count);

/// Area of a cell.
SL_API double sl_space_area(const sl_space *space, uint32_t cell);

/// Checks the whole graph: cells convex and of positive area, areas adding up to the bounds', no
/// wall inside a cell, portals on both their cells and on no wall, every piece of a cell's boundary
/// wall, portal or border, exits and portals telling the same, the tree leading to each cell once.
/// Portals on seams are told as such; in a kd-tree's
/// space no seam runs through a cell.
/// All but the sum of areas (relative 1e-9) by comparison of exact coordinates. For a BSP: corners
/// convex by exact predicates, walls' sides on their wall's line or behind it; that areas add up
/// and walls are covered is told within rounding. For cells that came with a map: that, but for the
/// sum of areas, and sides of the border must have all cells on one hand.
/// SL_BAD_INPUT with the first fault found.
SL_API sl_status sl_space_check(sl_context *context, const sl_space *space);

#ifdef __cplusplus
}
#endif

#endif
