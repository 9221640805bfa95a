/// The space: convex cells, the portals between them, and what locates a point.
#ifndef SIGHTLINE_SPACE_H
#define SIGHTLINE_SPACE_H

#include "sightline/map.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What sl_space_locate says of a point outside the bounds.
#define SL_NO_CELL UINT32_MAX

/// A node of a kd-tree. A child c >= 0 is node c, a child c < 0 is cell ~c.
typedef struct sl_node {
    double position; ///< the split line: x = position (axis 0) or y = position (axis 1)
    int32_t axis;
    int32_t below;    ///< where the coordinate is less than the position
    int32_t above;    ///< where it is not
    int32_t reserved; ///< 0
} sl_node;

/// A grid of buckets over the bounds: bucket (column, row) has the cells that reach into it, and
/// maybe some that only come near, ascending: cells[first[b]] .. cells[first[b + 1] - 1] with
/// b = row * columns + column. Zeroed, there is none.
typedef struct sl_cell_grid {
    uint32_t columns, rows, entry_count;
    uint32_t *first;
    uint32_t *cells;
} sl_cell_grid;

/// A portal: a longest wall-free piece of the boundary that two cells share, of positive length.
/// Crossed from cell[0] to cell[1], `left` is at the left hand and `right` at the right.
typedef struct sl_portal {
    uint32_t cell[2]; ///< cell[0] < cell[1]
    sl_point left, right;
} sl_portal;

/// A portal as a cell has it: where it leads, and its ends as crossed on the way out.
typedef struct sl_directed_portal {
    uint32_t portal, cell;
    sl_point left, right;
} sl_directed_portal;

/// A cell: a convex polygon, free of walls inside. Its corners are vertices[first_vertex ...],
/// counter-clockwise; its directed portals are directed portals[first_directed ...],
/// counter-clockwise from the first corner.
typedef struct sl_cell {
    uint32_t first_vertex, vertex_count;
    uint32_t first_directed, directed_count;
    uint32_t inside;   ///< 1 where a start, or no way from the map's border, leads to it
    uint32_t reserved; ///< 0
} sl_cell;

/// What a seam is in the map.
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

/// What sl_space.neighbour says of a side that is no wall: the cell's next directed portal, or the
/// map's border. Else it is the wall's number, with SL_NEIGHBOUR_RIGHT or-ed where the cell is at
/// the wall's right, going from its a to its b.
#define SL_NEIGHBOUR_PORTAL UINT32_MAX
/// The side is on the map's border.
#define SL_NEIGHBOUR_BORDER (UINT32_MAX - 1)
/// Or-ed to a wall's number: the cell is at the wall's right.
#define SL_NEIGHBOUR_RIGHT 0x80000000u

/// Zeroed, a space is empty.
///
/// The cells tile the bounds: they leave nothing out and do not overlap. A kd-tree's space has
/// `nodes`. The space of a mesh has `neighbour` and `grid`: each side of a cell is one directed
/// portal, one wall from end to end, or border, so that corners may be flat; every corner is the
/// end of a wall or a seam, a corner of the bounds, or of one of the map's own cells. With boxes in
/// it (`cut_walls`) also where their sides cross.
///
/// Cells do not run over seams: each portal lies on a seam wholly or not at all. Where a wall
/// covers a seam there is no portal.
typedef struct sl_space {
    sl_box bounds;
    int32_t root; ///< as a child of a node
    uint32_t node_count, cell_count, vertex_count, portal_count, directed_count, wall_count;
    uint32_t inside_count;
    uint32_t tree_depth; ///< nodes on the longest way down
    uint32_t loose;      ///< 1 for a space read from a file of version 1 that had oblique walls:
                         ///< cells may overlap by rounding, or leave gaps
    uint32_t cut_walls;  ///< 1 for a mesh with boxes (sightline/moving.h): a wall may be several
                         ///< sides of cells, end to end, bent by rounding where they meet
    uint32_t seam_count, seam_portal_count;
    sl_node *nodes; ///< a parent before its children; none for a mesh
    sl_cell *cells;
    sl_point *vertices;
    sl_portal *portals;           ///< by cell[0], then cell[1], then place
    sl_directed_portal *directed; ///< grouped by cell
    sl_wall *walls;               ///< those of the map it was made from
    uint32_t *neighbour; ///< by vertex: the wall on the side from there to the cell's next corner,
                         ///< SL_NEIGHBOUR_PORTAL or SL_NEIGHBOUR_BORDER; NULL for a kd-tree
    sl_cell_grid grid;   ///< none for a kd-tree
    sl_seam *seams;      ///< the map's doors, one-way glass and seams; NULL for none
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

/// The usual rules: all of them, walls that cover 0.2 of a line preferred.
SL_API sl_subdivide_options sl_subdivide_options_default(void);

/// Subdivides by a kd-tree on the walls' own lines until no wall is inside a cell. Walls and seams
/// must be axial (SL_BAD_INPUT names the first that is not), walls clean (sl_map_clean). No
/// coordinate is computed: every one in the space is one of the map's (but for the bounds of a map
/// without height or width, which are padded), so that predicates on it are exact. Reports stage
/// "subdivide".
SL_API sl_status sl_subdivide_kd(sl_context *context, const sl_map *map,
                                 const sl_subdivide_options *options, sl_space *out);

/// Subdivides by a constrained triangulation of walls and seams, of which triangles are merged to
/// convex cells: portals are taken out, the longest first, where both of their ends stay convex
/// corners (Hertel & Mehlhorn 1983). Walls may be oblique.
///
/// No coordinate is computed for a clean map (sl_map_clean): each corner of a cell is the end of a
/// wall or seam, or a corner of the bounds, and both sides of a portal have the same ends. So the
/// cells tile the bounds, all predicates on them are exact, and a door that is shut is as tight as
/// a wall. A map that is not clean is made planar first, without a tolerance, which few maps do not
/// allow (SL_UNSUPPORTED): cleaning does.
///
/// SL_BAD_INPUT where there is no wall. Linear space, time about O(n log n); reports stage
/// "subdivide".
SL_API sl_status sl_subdivide_mesh(sl_context *context, const sl_map *map, sl_space *out);

/// Subdivides by a mesh that keeps to the cells that the map brings along (sl_map.cells): their
/// sides end cells, so that each cell lies in one of the map's cells, or in none. Cells that are
/// bent are cut. What the map's cells leave open is filled with cells too.
///
/// Cells may be as rounded as node builders leave them: where the map is not clean (sl_map_clean),
/// places within twice its `snap` of each other are welded first, walls among them.
///
/// SL_BAD_INPUT, naming the cell, for cells that overlap.
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

/// All of them: "kd", "mesh", "given".
SL_API const sl_subdivision *sl_subdivisions(size_t *count);

/// What a map calls for: its own cells where it has any, the kd-tree where all walls and seams are
/// axial, else the mesh.
SL_API const sl_subdivision *sl_subdivision_for(const sl_map *map);

SL_API void sl_space_destroy(sl_context *context, sl_space *space); ///< and zeroes it

/// The cell that holds a point; SL_NO_CELL outside the bounds and for NaN. Exact. In a kd-tree's
/// space, on a split line the cell above (right of or over) it, on the upper or right border the
/// cell inside; time: the tree's depth. In a mesh's, on a border between cells that of the lowest
/// number; time: the cells in one bucket of the grid. SL_NO_CELL too in gaps of a loose space.
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

/// Checks the whole graph, exactly: cells convex and of positive area; cells that tile the bounds;
/// no wall inside a cell; portals on both their cells and on no wall; every piece of a cell's
/// boundary wall, portal or border; directed portals and portals that say the same; nodes or
/// buckets that lead to the cells; portals on seams known as such. Of a loose space only what
/// memory safety and convexity ask for. SL_BAD_INPUT with the first fault found.
SL_API sl_status sl_space_check(sl_context *context, const sl_space *space);

#ifdef __cplusplus
}
#endif

#endif
