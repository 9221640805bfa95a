/// The space: convex cells, the portals between them, and what locates a point.
#ifndef SIGHTLINE_SPACE_H
#define SIGHTLINE_SPACE_H

#include "sightline/map.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The answer of sl_space_locate for a point outside the bounds.
#define SL_NO_CELL UINT32_MAX

/// A node of a kd-tree. A child c >= 0 is node c, a child c < 0 is cell ~c.
typedef struct sl_node {
    double position; ///< the split line: x = position (axis 0) or y = position (axis 1)
    int32_t axis;
    int32_t below;    ///< the child for coordinates less than the position
    int32_t above;    ///< the child for all others
    int32_t reserved; ///< 0
} sl_node;

/// A grid of buckets over the bounds. Bucket b = row * columns + column has the cells that reach
/// into it, ascending: cells[first[b]] .. cells[first[b + 1] - 1]. It may also have cells that only
/// come near. With boxes in a mesh, parts of a cell come where the cell came. Zeroed, there is
/// none.
typedef struct sl_cell_grid {
    uint32_t columns, rows, entry_count;
    uint32_t *first;
    uint32_t *cells;
    uint32_t *stop; ///< by bucket, of a space that lives: its cells end there and not at
                    ///< first[b + 1]. Else NULL
} sl_cell_grid;

/// A portal: a longest piece without walls of the boundary that two cells share, of positive
/// length. On the way from cell[0] to cell[1], `left` is at the left hand and `right` at the right.
typedef struct sl_portal {
    uint32_t cell[2]; ///< cell[0] < cell[1]
    sl_point left, right;
} sl_portal;

/// A directed portal: a portal as one cell crosses it on the way out. `cell` is the neighbour.
typedef struct sl_directed_portal {
    uint32_t portal, cell;
    sl_point left, right;
} sl_directed_portal;

/// A cell: a convex polygon without walls inside. Its corners are vertices[first_vertex ...],
/// counter-clockwise. Its directed portals are directed[first_directed ...], counter-clockwise from
/// the first corner.
typedef struct sl_cell {
    uint32_t first_vertex, vertex_count;
    uint32_t first_directed, directed_count;
    uint32_t inside; ///< 1 if it is inside, else 0 (see sl_space)
    uint32_t solid;  ///< 1 if it is solid ground, else 0
} sl_cell;

/// What a seam is in the map.
typedef enum sl_seam_kind {
    SL_SEAM_PLAIN,
    SL_SEAM_DOOR,
    SL_SEAM_ONEWAY,
    SL_SEAM_LIMITED, ///< in a space of sight, one of the map's seams that limits it
} sl_seam_kind;

/// A seam: a line that cuts the cells although it is, or may be, seen through.
typedef struct sl_seam {
    sl_segment at;
    uint32_t kind;   ///< of sl_seam_kind
    uint32_t number; ///< its number among the map's seams, doors or oneways
} sl_seam;

/// A portal, and a seam that it lies on.
typedef struct sl_seam_portal {
    uint32_t portal, seam;
    uint32_t forward; ///< 1 if the way from cell[0] to cell[1] crosses the seam (from a to b) from
                      ///< its right to its left; else 0
} sl_seam_portal;

/// A wall that stops only some of sight, steps and sound, and the cells beside it. What it does not
/// stop crosses it from one to the other, all along the wall.
typedef struct sl_passage {
    uint32_t wall;
    uint32_t stops;   ///< bits of SL_STOPS_SIGHT ..., without SL_STOPS_LIMITED
    uint32_t cell[2]; ///< at the wall's left, going from a to b, and at its right
} sl_passage;

/// The values of sl_space.neighbour: the cell's next directed portal, the map's border, or else the
/// number of a wall. SL_NEIGHBOUR_RIGHT is or-ed to it if the cell is at the right of the wall,
/// going from a to b.
#define SL_NEIGHBOUR_PORTAL UINT32_MAX
/// The side is on the map's border.
#define SL_NEIGHBOUR_BORDER (UINT32_MAX - 1)
/// Or-ed to a wall's number: the cell is at the wall's right.
#define SL_NEIGHBOUR_RIGHT 0x80000000u

/// Zeroed, a space is empty.
///
/// The cells tile the bounds: they leave nothing out and do not overlap.
///
/// A kd-tree's space has `nodes`. The space of a mesh has `neighbour` and `grid`. There, each side
/// of a cell is one directed portal, one wall from end to end, or border, so corners may be
/// straight. Every corner is the end of a wall or a seam, a corner of the bounds, or a corner of
/// one of the map's own cells. With boxes in it (`cut_walls`), it may also be a crossing of their
/// sides.
///
/// What is inside is decided in this order, cell by cell: 1. Solid ground is not inside. It is what
/// the ground beside walls says (sl_wall.ground), what
///    solid polygons cover, and all that portals connect with it.
/// 2. With starts, cells that portals connect with a start are inside. 3. Without starts, and if
/// sl_map_find_inside was called, cells are inside that portals connect
///    with one of its places, but not through an entrance.
/// 4. Else, cells that portals do not connect with the border of the bounds are inside.
/// 5. If that leaves none, all cells that are not solid are inside.
/// Whatever the space is for, walls count here that stop steps: who sees through a window is not
/// outside. Ground of solid polygons whose walls stop steps, but not all, is not inside.
///
/// A space is for one of sight, steps and sound (sl_map.channel). Walls that do not stop that are
/// seams with portals.
///
/// Cells do not run over seams: a portal lies on a seam as a whole, or not at all. There is no
/// portal where a wall covers a seam.
typedef struct sl_space {
    sl_box bounds;
    int32_t root; ///< as a child of a node
    uint32_t node_count, cell_count, vertex_count, portal_count, directed_count, wall_count;
    uint32_t inside_count;
    uint32_t tree_depth; ///< nodes on the longest way down
    uint32_t loose;     ///< 1 for a space from a file of version 1 with oblique walls: by rounding,
                        ///< cells may overlap or leave gaps
    uint32_t cut_walls; ///< 1 for a mesh with boxes: a wall may be several sides of cells, end to
                        ///< end, and bent by rounding between them
    uint32_t seam_count, seam_portal_count, passage_count;
    sl_node *nodes; ///< a parent before its children; none for a mesh
    sl_cell *cells;
    sl_point *vertices;
    sl_portal *portals;           ///< by cell[0], then cell[1], then place
    sl_directed_portal *directed; ///< grouped by cell
    sl_wall *walls;               ///< the walls of the map
    uint32_t *neighbour; ///< by vertex: the neighbour across the side that starts there; NULL for a
                         ///< kd-tree
    sl_cell_grid grid;   ///< none for a kd-tree
    sl_seam *seams;      ///< the map's doors, one-way glass and seams; NULL for none
    sl_seam_portal *seam_portals; ///< by portal, then seam; NULL for none
    sl_passage *passages;         ///< by wall; NULL for none
} sl_space;

/// Finds what is inside of a clean map (sl_map_clean) that has no starts: what a disc as wide as an
/// entrance cannot enter from outside. The width is that of channels between ends of walls and
/// walls, compared exactly, up to what cleaning takes for one place. Doors, open or shut, stop the
/// disc.
///
/// How wide entrances are, the map says (sl_map.entrance). Else it is 1.2 m if the map's unit is
/// known, or it is found: the widest openings of rooms before the greatest step in their widths.
/// Then a third of the walls that can be reached must be inside, else nothing is found. Doors that
/// are wider than what is found say it better (sl_map.entrance_by_doors).
///
/// What the disc cannot enter is inside if a disc of half the width fits in it, and, if it has an
/// opening, one that is 4/3 as wide as that. So cores of walls, niches and alleys are not. Where
/// the map says what is solid, all open ground that walls enclose is inside. If an opening of up
/// to 2.5 times the width leads to such a place, `doubtful_width` is that width. Rooms behind it
/// are inside only if the map says the width. In a plan that is drawn (sl_map.entrance_may_be_wide)
/// they are also where that leaves no doubt, or where twice as wide openings change little.
///
/// The map gets `interior`, and a seam (sl_glass.entrance) across each entrance, which cuts cells
/// there. Where their ends are rounded, the map is cleaned again by `clean` (NULL: the default),
/// which the account (NULL for none) takes up. A map with starts only loses what was found before.
/// Time O(n log n) for maps whose entrances are short against the map.
SL_API sl_status sl_map_find_inside(sl_context *context, sl_map *map, const sl_clean_options *clean,
                                    sl_clean_account *account);

/// Finds a place that is likely to be in a room, after sl_map_find_inside: `interior.roomiest`. In
/// a drawing with solid ground, as a picture is, it is looked for only here: far from walls in the
/// largest closed part, or behind openings where more ground is. NAN where none is known. Time as
/// sl_map_find_inside.
SL_API sl_status sl_map_find_roomiest(sl_context *context, const sl_map *map, sl_point *place);

/// The rules of the kd-tree (Teller & Séquin 1991, Spatial Subdivision). They choose a split among
/// the lines with a wall inside the region, one after the other. Start from
/// sl_subdivide_options_default().
typedef struct sl_subdivide_options {
    bool spanning;   ///< prefer lines that walls cover from side to side
    double obscured; ///< else lines that walls cover for at least this share, 0 to 1 (default 0.2)
    bool cleaving;   ///< of these, lines that cut the fewest walls
    bool median;     ///< of these, the one nearest to the median; false: the first
} sl_subdivide_options;

/// The usual rules: all of them, walls that cover 0.2 of a line preferred.
SL_API sl_subdivide_options sl_subdivide_options_default(void);

/// A way to subdivide, by name.
typedef struct sl_subdivision {
    const char *name, *what;
    bool takes_rules; ///< it uses the kd-tree's rules; others ignore them
    bool takes_cells; ///< it needs the map's own cells; others ignore them
    /// `out` must be empty, and stays so on failure. NULL rules are the default ones. SL_BAD_INPUT,
    /// naming what it is, for a map that the way cannot cut; SL_UNSUPPORTED for a few maps that are
    /// not clean (sl_map_clean). Reports stage "subdivide".
    sl_status (*subdivide)(sl_context *context, const sl_map *map,
                           const sl_subdivide_options *rules, sl_space *out);
} sl_subdivision;

/// All of them. No coordinate is computed for a clean map: predicates on the space are exact.
///
/// - "kd": a kd-tree on the lines of walls, until no wall is inside a cell. Walls and seams must be
///   axial.
/// - "mesh": a constrained triangulation of walls and seams, whose triangles are merged to convex
///   cells (Hertel & Mehlhorn 1983). Walls may be oblique. Both sides of a portal have the same
///   ends. Memory O(n), time about O(n log n).
/// - "given": a mesh that respects the cells that the map brings along (sl_map.cells): each cell
///   lies in one of them, or in none.
SL_API const sl_subdivision *sl_subdivisions(size_t *count);

/// The subdivision for a map: "given" if it has cells, "kd" if all walls and seams are axial, else
/// "mesh".
SL_API const sl_subdivision *sl_subdivision_for(const sl_map *map);

SL_API void sl_space_destroy(sl_context *context, sl_space *space); ///< and zeroes it

/// Makes the guessed ground of a map certain (sl_map.ground_guessed), so that its text says what a
/// space of it has. If the guesses contradict each other, the walls become those of the cleaned
/// map. A map without guesses stays as it is. Fails as sl_map_clean and sli_subdivide_mesh do; the
/// map may then have lost its walls if memory was lacking.
SL_API sl_status sl_map_settle_ground(sl_context *context, sl_map *map);

/// The cell that holds a point; SL_NO_CELL outside the bounds and for NaN. Exact.
///
/// In a kd-tree's space, a point on a split line is in the cell above it (right of it or over it).
/// A point on the upper or right border is in the cell inside. Time: the depth of the tree. In a
/// mesh, a point on a border between cells is in the one of the lowest number. Time: the cells of
/// one bucket. A gap of a loose space gives SL_NO_CELL.
///
/// Of the cells that hold the point, one that is inside comes first, then one that is not solid. So
/// who stands on the border of what is inside stands inside. Of several, in a mesh, the lowest
/// number counts. In a kd-tree's space, the first in this order does: the cell right of the point
/// and over it, left and over, right and under, left and under.
SL_API uint32_t sl_space_locate(const sl_space *space, sl_point point);

/// Whether a point is inside: in a cell that is (sl_space_locate).
SL_API bool sl_space_is_inside(const sl_space *space, sl_point point);

/// A place in a cell that is inside, as near to a point as such places are, but for a thousandth of
/// the way to the middle of the cell. False where nothing is inside. Time O(cells).
SL_API bool sl_space_nearest_inside(const sl_space *space, sl_point point, sl_point *out);

/// A box that is put into a space for a while. It may have no width or height. Boxes may overlap;
/// they may touch walls, each other and the eye; and they may lie outside the bounds.
typedef struct sl_moving_box {
    sl_box box;
    bool blocks; ///< its four sides are walls; if false, it is seen through
} sl_moving_box;

/// Sets the bits of the cells in which a box lies, and of those that it only touches
/// (sl_eye_words() words). Exact. Time: all cells in a kd-tree's space, the cells in nearby buckets
/// in a mesh.
SL_API void sl_cells_of_box(const sl_space *space, sl_box box, uint64_t *cells);

/// The seams that a portal lies on, *count of them; NULL for none.
SL_API const sl_seam_portal *sl_space_seams_of(const sl_space *space, uint32_t portal,
                                               size_t *count);

/// Area of a cell.
SL_API double sl_space_area(const sl_space *space, uint32_t cell);

/// A place in a cell, but for rounding: the mean of its corners.
SL_API sl_point sl_space_middle(const sl_space *space, uint32_t cell);

/// Checks the whole graph, exactly. SL_BAD_INPUT with the first fault found.
///
/// - Cells are convex, of positive area, and tile the bounds. No wall is inside a cell.
/// - Every piece of a cell's boundary is wall, portal or border.
/// - A portal is on both of its cells and on no wall. Directed portals agree with portals.
/// - Nodes or buckets lead to the cells. Portals on seams are listed.
///
/// A loose space is only checked for memory safety and convex cells.
SL_API sl_status sl_space_check(sl_context *context, const sl_space *space);

// --- the outline
//
// The boundaries of all rooms, side by side, for walks through a space. A room is one cell, or
// several that make up a convex polygon. Sight needs no portals within a room.

/// The values of sl_side.neighbour. Below SL_SIDE_WALL: a portal, as the index of its other side.
/// From SL_SIDE_WALL on: a wall, by its number. From SL_SIDE_BORDER on: the map's border without a
/// wall; the lower, right, upper or left one.
#define SL_SIDE_WALL UINT32_C(0x80000000)
/// The map's lower border; the right, upper and left one follow.
#define SL_SIDE_BORDER UINT32_C(0xfffffff0)

/// A piece of a room's boundary: a portal, a piece of one wall, or a piece of the border. A portal
/// may be several of the space's in one line. The piece starts at `start`, and ends where the next
/// one starts, counter-clockwise around the room.
typedef struct sl_side {
    sl_point start;
    uint32_t next, neighbour;
} sl_side;

/// Zeroed, an outline is empty.
typedef struct sl_outline {
    const sl_space *space; ///< the caller's; it must live as long as the outline
    sl_side *sides;        ///< grouped by room, in order
    uint32_t *first;       ///< by room, and one more: sides[first[r] .. first[r + 1])
    uint32_t *first_part;  ///< by cell of the space, and one more
    uint32_t *parts;       ///< rooms; those with a part of cell c: from first_part[c] on
    uint32_t side_count, room_count;
    /// One-way glass: walls from this number on are its dark sides. The other side of wall w is
    /// sides[lit[w - first_dark]], a portal that leads to the wall's side. NULL without glass.
    uint32_t first_dark, *lit;
    /// Limited walls: by side, the seam of the space that limits sight there, SL_NO_SEAM for most.
    /// NULL without them.
    uint32_t *limited;
    /// Of a space that lives (sightline/world.h), whose rooms are its cells: by side, its room.
    /// Rooms then have gaps between them (sl_outline_stop). Else NULL.
    const uint32_t *room_of;
} sl_outline;

/// Where the sides of a room end.
static inline uint32_t sl_outline_stop(const sl_outline *outline, uint32_t room) {
    return outline->room_of ? outline->first[room] + outline->space->cells[room].vertex_count
                            : outline->first[room + 1];
}

/// No seam (sl_outline.limited).
#define SL_NO_SEAM UINT32_MAX

/// The room that holds a point of a cell, among the rooms with a part of that cell. Time: the sides
/// of these rooms.
SL_API uint32_t sl_outline_room(const sl_outline *outline, uint32_t cell, sl_point point);

/// Whether a side is a portal.
static inline bool sl_side_is_portal(const sl_side *side) {
    return side->neighbour < SL_SIDE_WALL;
}

/// Whether a side is the dark side of glass.
static inline bool sl_side_is_dark(const sl_outline *outline, const sl_side *side) {
    return outline->lit && side->neighbour >= SL_SIDE_WALL + outline->first_dark &&
           side->neighbour < SL_SIDE_BORDER;
}

#ifdef __cplusplus
}
#endif

#endif
