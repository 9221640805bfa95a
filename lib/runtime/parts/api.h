/// Sightline's runtime for games: reads a baked file (.slv) and answers which cells are seen.
///
/// One file, C99 or C++. It needs only memcpy, memset and memcmp. It allocates nothing and has no
/// global state. Copy it into your sources and include it where you need it. In exactly one C or
/// C++ file, write before the include
///
///     #define SIGHTLINE_RUNTIME_IMPLEMENTATION
///
/// A baked file holds a map cut into convex cells, numbered from 0. The row of a cell lists the
/// cells that can be seen from anywhere in it. sl_runtime_open checks the whole file once. After
/// that no call fails, reads out of bounds or runs without end, whatever the file holds. The bytes
/// must stay unchanged, and in place, as long as the sl_runtime is used. They may have any
/// alignment: a mapped file, an array in the program, a piece of an archive.
///
/// An open sl_runtime is only read, so any number of threads may use it.
///
/// It needs IEEE doubles. Compiled with -ffast-math it is still safe, but answers are then exact
/// only up to rounding. For x87 it does not compile.
#ifndef SIGHTLINE_RUNTIME_H
#define SIGHTLINE_RUNTIME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Stands before each function. `static` limits them to the file that implements them.
#ifndef SL_RUNTIME_API
#define SL_RUNTIME_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum sl_runtime_status {
    SL_RUNTIME_OK = 0,
    SL_RUNTIME_NOT_BAKED,  ///< not a baked file
    SL_RUNTIME_BYTE_ORDER, ///< not little endian: no baked file, or one of an old version from a
                           ///< machine of other order
    SL_RUNTIME_VERSION,    ///< a version that this header does not know
    SL_RUNTIME_SIZE,       ///< cut short, or longer than it says
    SL_RUNTIME_CHECKSUM,   ///< changed since it was written
    SL_RUNTIME_SECTION,    ///< a section is missing, there twice, or does not fit
    SL_RUNTIME_SPACE,      ///< a number of bounds, tree, grid, cells or portals is out of range
    SL_RUNTIME_ROW,        ///< a row is damaged
    SL_RUNTIME_SHARD,      ///< one shard of a bake, which has no rows yet
    SL_RUNTIME_TEXT,       ///< a door, a start or another thing of the map is damaged
    SL_RUNTIME_OLD         ///< of a version before 2.0, with SL_RUNTIME_WITHOUT_OLD_FILES
} sl_runtime_status;

/// What a file holds of what is seen by mirror. Only the calls with `mirrored` in their names look
/// into mirrors. To all others mirrors are walls.
typedef enum sl_runtime_mirrors {
    SL_RUNTIME_NO_MIRRORS = 0,   ///< the map has no mirrors: all that is seen is seen directly
    SL_RUNTIME_MIRRORS_BAKED,    ///< rows of the cells that are seen by mirror
    SL_RUNTIME_MIRRORS_NOT_BAKED ///< the map has mirrors, and the bake did not look into them
} sl_runtime_mirrors;

/// How the places of a map stand in other coordinates: a file's, or a screen's. The point (x, y) of
/// the map is scale * (x - origin_x), scale * (y - origin_y) there, or scale * (origin_y - y) if y
/// points down there.
typedef struct sl_runtime_transform {
    double origin_x, origin_y; ///< the place in the map that is 0, 0 there
    double scale;              ///< units there in a unit of the map; more than 0
    bool y_down;
} sl_runtime_transform;

/// The cell of a point outside the map.
#define SL_RUNTIME_NO_CELL UINT32_MAX
/// The number of a door that does not exist.
#define SL_RUNTIME_NO_DOOR UINT32_MAX
/// The number of a box that does not exist.
#define SL_RUNTIME_NO_BOX UINT32_MAX

/// What a wall stops, as bits. Light is sight.
enum {
    SL_RUNTIME_STOPS_SIGHT = 1,
    SL_RUNTIME_STOPS_STEPS = 2,
    SL_RUNTIME_STOPS_SOUND = 4,
    SL_RUNTIME_STOPS_ALL = 7,
    SL_RUNTIME_STOPS_LIMITED = 8 ///< a limited wall: sight passes one of them, and not a second one
};

/// An open file. Counts and bounds are for reading; the pointers are for the functions only.
typedef struct sl_runtime {
    double min_x, min_y, max_x, max_y; ///< bounds of the map
    double range; ///< the map's view range; 0 for no limit. All calls about eyes keep to it
    uint32_t cell_count;
    uint32_t portal_count;   ///< portals have numbers too
    uint32_t directed_count; ///< two for each portal
    uint32_t vertex_count;
    uint32_t node_count;              ///< of the tree that locates points, if all walls are axial
    int32_t root;                     ///< as a child of a node
    uint32_t grid_columns, grid_rows; ///< of the grid that locates points in other maps
    bool loose; ///< a file of format version 1 with oblique walls, or made from one: by rounding,
                ///< cells may overlap or leave gaps
    bool unfinished; ///< the bake was stopped: rows miss nothing, but have undecided cells too
    sl_runtime_mirrors mirrors; ///< if not SL_RUNTIME_NO_MIRRORS: more is seen than directly
    uint32_t view_cell_count;   ///< 0 for a bake without view cells
    uint32_t view_node_count;   ///< the rows of view cells and of groups of them
    uint32_t door_count;        ///< doors are numbered in the order of the map
    uint32_t channel;           ///< what the file is for: SL_RUNTIME_STOPS_SIGHT, if not told else
    const unsigned char *nodes, *cells, *vertices, *directed, *row_offsets, *row_bytes;
    const unsigned char *row_parts; ///< which parts of the cells rows reach into; NULL: not told
    uint32_t part_shift;            ///< a part has 2^part_shift cells
    const unsigned char *grid_offsets, *grid_cells; ///< NULL for no grid
    const unsigned char *tree_starts;               ///< of each bucket over the tree; NULL for none
    uint32_t tree_columns, tree_rows;
    const unsigned char *neighbours; ///< across each side of each cell; NULL for no grid
    const unsigned char *door_offsets, *door_bytes;     ///< NULL if no pair depends on doors
    const unsigned char *mirror_offsets, *mirror_bytes; ///< NULL without rows of mirrors
    const unsigned char *mirror_door_offsets, *mirror_door_bytes;
    const unsigned char *seams, *seam_portals; ///< NULL for none
    uint32_t seam_count, seam_portal_count;
    const unsigned char *stops, *passages; ///< NULL where all walls stop all
    uint32_t passage_count;
    bool has_glass;  ///< one-way glass, somewhere
    bool has_limits; ///< in a file for sight: limited walls, somewhere
    const unsigned char *portals;
    const unsigned char *walls; ///< NULL in a file without them
    uint32_t wall_count;
    uint32_t start_count, object_count, path_count, mirror_count;
    const unsigned char *names, *doors, *starts, *objects, *paths, *path_points, *mirror_lines;
    const unsigned char *text; ///< of a file before 2.0: doors and starts as text; else NULL
    size_t text_bytes;
    sl_runtime_transform transform; ///< as sl_runtime_map_transform; scale 0: the file has none
    const unsigned char *views, *view_parents, *view_offsets, *view_bytes;
} sl_runtime;

/// Checks everything. `out` is unchanged on failure.
SL_RUNTIME_API sl_runtime_status sl_runtime_open(const void *bytes, size_t size, sl_runtime *out);

/// A status as text, for a log.
SL_RUNTIME_API const char *sl_runtime_status_text(sl_runtime_status status);

/// The cell that holds a point; SL_RUNTIME_NO_CELL outside the bounds and for NaN. Exact, and the
/// same as sl_space_locate of the library.
///
/// If all walls are axial, a point on a split line is in the cell above it (right of it or over
/// it). A point on the upper or right border is in the cell inside. Time: a few nodes of the tree
/// (files of before 2.0: its depth). In
/// other maps, a point on a border between cells is in the cell of the lowest number. Time: the few
/// cells of one bucket. In a loose file, gaps give SL_RUNTIME_NO_CELL; version 1 takes the time of
/// all cells.
///
/// Of the cells that hold the point, one that is inside comes first, then one that is not solid. So
/// an eye that leans against rock, or against the wall around the map, sees what is inside. Of
/// several, the lowest number counts; if all walls are axial, the first in this order does: the
/// cell right of the point and over it, left and over, right and under, left and under.
SL_RUNTIME_API uint32_t sl_runtime_locate(const sl_runtime *runtime, double x, double y);

/// Finds the cells that a box lies in or touches, ascending. Returns their number, and puts the
/// first `room` of them into `cells`. Draw a moving thing if one of its cells is seen. Exact for
/// coordinates below 1e150. A box whose minimum is above its maximum is in no cell. Time: the cells
/// near the box, once for each 8,192 cells that they have numbers among; all cells in a loose file
/// of version 1. Call it again when the box has moved.
SL_RUNTIME_API uint32_t sl_runtime_box_cells(const sl_runtime *runtime, double min_x, double min_y,
                                             double max_x, double max_y, uint32_t *cells,
                                             uint32_t room);

/// Whether anything in cell `to` can be seen directly from anywhere in cell `from`. False if either
/// is no cell (SL_RUNTIME_NO_CELL), and for a cell without a row. Time: the length of the row;
/// but most pairs of a large map that do not see each other take 8 bytes of the file (of files
/// since 2.0). To test many cells from one, unpack its row (sl_runtime_row_bits).
SL_RUNTIME_API bool sl_runtime_can_see(const sl_runtime *runtime, uint32_t from, uint32_t to);

/// As sl_runtime_can_see while some doors are shut. `shut` has door_count bytes, not 0 for a shut
/// door; NULL if none is shut. The game keeps it, and a change costs nothing. As exact as the bake:
/// a pair is seen if some sightline passes no shut door. (Some pairs need more sets of doors than a
/// bake keeps. The bake reports them, and they always count as seen.) Time: the lengths of the
/// rows.
SL_RUNTIME_API bool sl_runtime_can_see_past(const sl_runtime *runtime, uint32_t from, uint32_t to,
                                            const unsigned char *shut);

// Doors are numbered from 0 to door_count - 1, in the order of the map; so are starts, objects,
// paths and mirrors. In a file before 2.0, doors and starts are read from its map text: each call
// takes the time of that text, and there are no objects, paths and segments of mirrors. A program
// that needs no such files defines SL_RUNTIME_WITHOUT_OLD_FILES where it implements this header.
// It is smaller, and such files do not open (SL_RUNTIME_OLD).

/// A name of `length` bytes of UTF-8. It lies in the file, and no 0 ends it.
typedef struct sl_runtime_name {
    const char *text;
    uint32_t length;
} sl_runtime_name;

/// A segment, in map units.
typedef struct sl_runtime_segment {
    double x0, y0, x1, y1;
} sl_runtime_segment;

/// A start: a viewpoint of the map. The heading is in degrees, counter-clockwise from +x.
typedef struct sl_runtime_viewpoint {
    double x, y, heading;
} sl_runtime_viewpoint;

/// The name of a door; of length 0 if the door does not exist. Several doors may have one name.
SL_RUNTIME_API sl_runtime_name sl_runtime_door_name(const sl_runtime *runtime, uint32_t door);

/// The first door with a name that a 0 ends; SL_RUNTIME_NO_DOOR for none. To open all doors of a
/// name, compare the names of the doors after it too.
SL_RUNTIME_API uint32_t sl_runtime_find_door(const sl_runtime *runtime, const char *name);

/// Whether the map has the door open at the start. False if the door does not exist. A game that
/// begins with the doors of the map sets shut[i] = !sl_runtime_door_open(runtime, i).
SL_RUNTIME_API bool sl_runtime_door_open(const sl_runtime *runtime, uint32_t door);

/// Finds the segments of a door: one, or more if walls cut it. Returns their number, and puts the
/// first `room` of them into `segments`. Coordinates are exact.
SL_RUNTIME_API uint32_t sl_runtime_door_segments(const sl_runtime *runtime, uint32_t door,
                                                 sl_runtime_segment *segments, uint32_t room);

/// Reads a wall, one of `wall_count`; false, and `out` is unchanged, if it does not exist. To draw
/// them: sight goes by cells and portals.
SL_RUNTIME_API bool sl_runtime_wall(const sl_runtime *runtime, uint32_t wall,
                                    sl_runtime_segment *out);

/// The number of starts.
SL_RUNTIME_API uint32_t sl_runtime_start_count(const sl_runtime *runtime);

/// Reads a start, numbered from 0. False if it does not exist; `out` is then unchanged.
SL_RUNTIME_API bool sl_runtime_start(const sl_runtime *runtime, uint32_t start,
                                     sl_runtime_viewpoint *out);

/// Reads an object, one of `object_count`: its name and its box, from the minimum x0, y0 to the
/// maximum x1, y1. False if it does not exist; the results are then unchanged, here and below.
SL_RUNTIME_API bool sl_runtime_object(const sl_runtime *runtime, uint32_t object,
                                      sl_runtime_name *name, sl_runtime_segment *box);

/// Reads a path, one of `path_count`: its name and the number of its points.
SL_RUNTIME_API bool sl_runtime_path(const sl_runtime *runtime, uint32_t path, sl_runtime_name *name,
                                    uint32_t *point_count);

/// Reads the points of a path into `points`, which has room for 2 * point_count numbers.
SL_RUNTIME_API void sl_runtime_path_points(const sl_runtime *runtime, uint32_t path,
                                           double *points);

/// Reads a mirror, one of `mirror_count`. It reflects on both sides, or on its left only, going
/// from its first end to its second. Mirrors are walls too.
SL_RUNTIME_API bool sl_runtime_mirror(const sl_runtime *runtime, uint32_t mirror,
                                      sl_runtime_segment *segment, bool *one_sided);

/// How the map's places stand in the file that was baked: pixels of a Tiled map with y down, say.
/// False if the baked file does not have it, as those before 2.0; `out` is then that of the map's
/// own places. A game may make any other: origin_x, origin_y is the place in the map that is 0, 0
/// on its screen.
SL_RUNTIME_API bool sl_runtime_map_transform(const sl_runtime *runtime, sl_runtime_transform *out);

/// Turns `count` points x, y, x, y ... of other coordinates into places of the map, to ask with.
/// Exact if the numbers are: for whole numbers, with a scale that is a power of 2. Other numbers
/// are rounded: what is asked is then asked of the rounded place.
///
/// With y down, the picture is the same and only the names of places change. So what is left of an
/// eye stays left, a polygon still goes counter-clockwise as it is seen (its area by the formula
/// for y up is then negative), the minimum of y becomes the maximum, the y of a direction changes
/// its sign, and so does a heading: it goes clockwise. Lengths, as a range, are divided by the
/// scale.
SL_RUNTIME_API void sl_runtime_to_map(const sl_runtime_transform *transform, double *points,
                                      uint32_t count);

/// The other way round: places of the map, such as a visible polygon, for drawing. As exact as
/// sl_runtime_to_map.
SL_RUNTIME_API void sl_runtime_from_map(const sl_runtime_transform *transform, double *points,
                                        uint32_t count);

/// Whether a cell has a row. A bake of the inside leaves the cells outside without rows.
SL_RUNTIME_API bool sl_runtime_has_row(const sl_runtime *runtime, uint32_t cell);

/// Whether a cell is inside, if the map says what inside is.
SL_RUNTIME_API bool sl_runtime_is_inside(const sl_runtime *runtime, uint32_t cell);

/// Whether a cell is solid ground, such as rock. Nobody looks from there, and it has no row.
SL_RUNTIME_API bool sl_runtime_is_solid(const sl_runtime *runtime, uint32_t cell);

/// A run of cells of a row: first .. end - 1.
typedef struct sl_runtime_run {
    uint32_t first, end;
    const unsigned char *next, *stop; ///< for the iteration only
} sl_runtime_run;

/// Iterates over the cells seen from a cell, ascending. If the file only has rows of view cells, it
/// is the row of the cell's view cell.
///
///     sl_runtime_run run = sl_runtime_row(&runtime, cell);
///     while (sl_runtime_next(&run))
///         for (uint32_t seen = run.first; seen < run.end; seen++) ...
SL_RUNTIME_API sl_runtime_run sl_runtime_row(const sl_runtime *runtime, uint32_t cell);
/// Goes on to the next run; false behind the last.
SL_RUNTIME_API bool sl_runtime_next(sl_runtime_run *run);

/// The number of cells seen from a cell.
SL_RUNTIME_API uint32_t sl_runtime_row_count(const sl_runtime *runtime, uint32_t cell);

/// Unpacks a row: cell c is seen if bits[c / 8] >> c % 8 & 1. `bits` has (cell_count + 7) / 8
/// bytes.
SL_RUNTIME_API void sl_runtime_row_bits(const sl_runtime *runtime, uint32_t cell,
                                        unsigned char *bits);

/// What can be seen directly from anywhere in some cells: the cells that at least one sees. As
/// bits, as sl_runtime_row_bits does for one cell; returns how many there are. `shut` is as for
/// sl_runtime_can_see_past. Numbers that are no cells are left out.
///
/// Ask it with what an eye sees (sl_runtime_look) to find what to wake up: all that anything in
/// view could see. The set is conservative if the bake is: nothing outside of it is seen from any
/// place in any of these cells, so not from any place in view. It may hold more than what is seen
/// from the places in view, as it counts whole cells. Time: the rows.
///
///     uint32_t count = sl_runtime_look(&runtime, &view, scratch, cells, runtime.cell_count);
///     sl_runtime_seen_from(&runtime, cells, count, shut, bits);
SL_RUNTIME_API uint32_t sl_runtime_seen_from(const sl_runtime *runtime, const uint32_t *cells,
                                             uint32_t count, const unsigned char *shut,
                                             unsigned char *bits);

// A view cell is a group of cells with one visible set. A game that keeps its draw list from frame
// to frame changes it only when the eye enters another view cell.

/// The view cell of a cell; SL_RUNTIME_NO_CELL for none. For a point, use
/// sl_runtime_view_cell(runtime, sl_runtime_locate(runtime, x, y)).
SL_RUNTIME_API uint32_t sl_runtime_view_cell(const sl_runtime *runtime, uint32_t cell);

/// Whether anything in a cell can be seen from anywhere in a view cell. False if either does not
/// exist.
SL_RUNTIME_API bool sl_runtime_view_can_see(const sl_runtime *runtime, uint32_t view_cell,
                                            uint32_t to);

/// Unpacks the visible set of a view cell, as sl_runtime_row_bits does for a cell.
SL_RUNTIME_API void sl_runtime_view_bits(const sl_runtime *runtime, uint32_t view_cell,
                                         unsigned char *bits);

// Walls that break, building sites, and rows that follow the doors. To all calls that take `shut` a
// wall that breaks is a door that is shut until it breaks, and a site a door that is open until a
// wall is built on it. So they are exact at once. Rows are baked once: past shut doors they are
// exact as far as the bake kept sets of doors, and conservative beyond. A state makes them exact
// for the doors as they stand, bit by bit, in the time that a game has left.
//
//     size_t size = sl_runtime_state_count(&runtime);
//     sl_runtime_state_start(&state, &runtime, malloc(size * sizeof(uint32_t)));
//     when a wall breaks: sl_runtime_state_set_door(&state, wall, false);
//     each frame: while (time is left && sl_runtime_settle(&state, 1000)) {}
//     any time: sl_runtime_state_can_see(&state, from, to);
//               sl_runtime_sees(&runtime, x0, y0, x1, y1, state.shut, 0, scratch);

/// What a door is.
typedef enum sl_runtime_door_kind {
    SL_RUNTIME_DOOR = 0,  ///< opens and shuts
    SL_RUNTIME_BREAKABLE, ///< a wall that breaks: once open, it stays open
    SL_RUNTIME_SITE       ///< a place for a wall: once shut, it stays shut
} sl_runtime_door_kind;

/// The kind of a door; SL_RUNTIME_DOOR if the door does not exist.
SL_RUNTIME_API sl_runtime_door_kind sl_runtime_get_door_kind(const sl_runtime *runtime,
                                                             uint32_t door);

/// The doors of a level as they stand in one game, with rows. It has one owner: one thread changes
/// and settles it while no other asks. Any number of states share one level.
typedef struct sl_runtime_state {
    const sl_runtime *runtime;
    unsigned char *shut; ///< for all calls that take it; sl_runtime_state_set_door writes
    uint32_t unsettled;  ///< rows that are not exact yet
    uint32_t given_up;   ///< settled rows whose search took too long: they are conservative
    uint32_t *first, *bits, *settled, *ranks, *steps, *corners; ///< for the functions only, to the
                                                                ///< end
    uint32_t row, next, depth, missing;
    uint64_t patience;
} sl_runtime_state;

/// The size of the memory for a state, in uint32_t: a bit for each pair of the rows, and 100 bytes
/// for each cell.
SL_RUNTIME_API size_t sl_runtime_state_count(const sl_runtime *runtime);

/// Starts with the doors of the map. `memory` may hold anything, and is used as long as `out` is.
SL_RUNTIME_API void sl_runtime_state_start(sl_runtime_state *out, const sl_runtime *runtime,
                                           uint32_t *memory);

/// Opens or shuts a door, breaks a wall (not shut) or builds one (shut): all doors of its name.
/// Returns false, and changes nothing, to shut a broken wall, to open what was built, and for a
/// door that does not exist. Rows of cells that see the door are then unsettled; all others stay
/// exact. Time: the portals on doors, and the rows of the cells beside the door.
SL_RUNTIME_API bool sl_runtime_state_set_door(sl_runtime_state *state, uint32_t door, bool shut);

/// Works on the rows that are not exact, through up to `portals` portals, of about 0.1 microseconds
/// each. Returns how many rows are left. It goes on where it ended.
///
/// A settled row is exact for the doors as they stand, with closed sight: a cell is in it if some
/// line leads there from the row's cell through portals that no shut door is on and no dark glass.
/// So it is as a bake would find it with walls in place of the shut doors. It never has a cell that
/// the baked row has not. A view range and limited walls count as in the baked rows, whatever is
/// shut. A row whose search takes very long stays as sl_runtime_can_see_past says (`given_up`).
SL_RUNTIME_API uint32_t sl_runtime_settle(sl_runtime_state *state, uint32_t portals);

/// As sl_runtime_can_see_past for the doors as they stand; exact if the row of `from` is settled.
SL_RUNTIME_API bool sl_runtime_state_can_see(const sl_runtime_state *state, uint32_t from,
                                             uint32_t to);

/// Unpacks that row, as sl_runtime_row_bits. Returns the number of cells.
SL_RUNTIME_API uint32_t sl_runtime_state_row_bits(const sl_runtime_state *state, uint32_t cell,
                                                  unsigned char *bits);

// Where an eye stands, as in view.h of the library: in the cell that sl_runtime_locate gives, and
// in each cell that open portals at the eye join with it (it is on the portal, or on its end). It
// sees what it sees from any of these cells. So at the end of a wall and at a corner of solid
// ground it sees all around. Within a wall or a shut door it sees one side, that of its cell. Where
// walls meet, it sees the part that has its cell. What is looked at has no side.

/// An eye with its view cone: from the direction `right` counter-clockwise to the direction `left`,
/// borders included. The directions are vectors of any length from 1e-150 to 1e150. If one is not
/// (0, NaN), the view is all round.
typedef struct sl_runtime_view {
    double x, y;
    bool all_round; ///< `right` and `left` are ignored
    double right[2], left[2];
} sl_runtime_view;

/// A view of the full circle.
SL_RUNTIME_API sl_runtime_view sl_runtime_view_all_round(double x, double y);

/// A cone of less than 180 degrees about a direction. `tan_half` is the tangent of half its angle:
/// 1 for 90 degrees. The borders are rounded; make the cone a little wider if the last bit matters.
SL_RUNTIME_API sl_runtime_view sl_runtime_view_toward(double x, double y, double direction_x,
                                                      double direction_y, double tan_half);

/// The size of `scratch`, in uint32_t, for all calls that take it.
SL_RUNTIME_API size_t sl_runtime_scratch_count(const sl_runtime *runtime);

/// Eye-to-cell: finds the cells that some line from the eye, inside the cone, reaches through
/// portals (Teller & Séquin 1991, depth first). Returns their number, and puts the first `room` of
/// them into `cells`. The cell of sl_runtime_locate comes first, if the cone leads into it; each
/// other cell comes after one through which it is seen, or the eye stands in it. Returns 0 if the
/// eye is in no cell or in solid ground, or on a wall and looks into it. `scratch` may hold
/// anything; each thread needs its own.
///
/// Mirrors are walls: sl_runtime_look_mirrored adds what is seen in them.
///
/// Exact for the coordinates in the file, with closed sight: a line may touch corners and run along
/// walls. A line may run along portals and cross them to its left or to its right, but not some to
/// the left and others to the right. One-way glass is a wall for an eye on its dark side. For an
/// eye on its line, it is dark if any of the cell of sl_runtime_locate is on its dark side. The
/// cells that the eye stands in are seen if the cone leads into them: some of its directions enter
/// the cell, or run along its border. All this is as in the library's exact method.
///
/// No sign comes from a rounded number, so no cell is missed and none added. (Coordinates of the
/// eye and of directions below 1e-200 count as 0.) If the eye's cell has a row, only cells of the
/// rows of the cells that it stands in are returned. Nothing beyond the map's own range is, as
/// sl_runtime_look_past explains. A search that takes very long, which a sound file does not cause,
/// returns these whole rows, or all cells if there are none.
SL_RUNTIME_API uint32_t sl_runtime_look(const sl_runtime *runtime, const sl_runtime_view *view,
                                        uint32_t *scratch, uint32_t *cells, uint32_t room);

/// As sl_runtime_look, with shut doors and a view range. `shut` is as for sl_runtime_can_see_past.
/// Of `range` and the map's own, the smaller one holds. 0, less than 0 and NaN stand for the map's.
///
/// Doors are exact: a line must reach a cell through portals that are on no shut door. For the
/// range, the distance to the nearest place that the eye sees of a cell counts. No cell within the
/// range is missed, but one beyond it may be added: distances are compared in doubles, and what
/// rounding could do is taken off. For the portal through which the cell is seen, let d be the sum
/// of the distances to its two ends, and s the sine of the angle at which the seen part of it is
/// cut off (1 if nothing is cut off). Then a cell is added only if it is beyond the range by at
/// most 2e-12 of the range and 3e-14 of d / s. The cells that the eye stands in are within any
/// range. The library's exact method has no such margin; nor has sl_runtime_sees.
SL_RUNTIME_API uint32_t sl_runtime_look_past(const sl_runtime *runtime, const sl_runtime_view *view,
                                             const unsigned char *shut, double range,
                                             uint32_t *scratch, uint32_t *cells, uint32_t room);

/// Point to point: whether an eye at (x0, y0) sees the point (x1, y1). `shut`, `range` and
/// `scratch` are as for sl_runtime_look_past. A guard sees the player by this, and may see him,
/// somewhere in his cell, by sl_runtime_can_see_past.
///
/// Exact, and as sl_query_sees of the library: open portals that the line touches, ends included,
/// lead from a cell that the eye stands in to a cell that touches the point. So it may graze walls
/// on either side. (A line that grazes walls on both sides leads sl_runtime_look to no cell: such a
/// point may be seen though none of its cells is listed.) A point on a wall or on a shut door is
/// seen from both sides, but an eye there sees one. Each of two points sees the other or none does,
/// unless one of them is where walls or shut doors part what is around it, or one-way glass is
/// between them. (The range is exact if no coordinate but 0 is 1e70 times smaller than another
/// one.)
///
/// Of limited walls (SL_RUNTIME_STOPS_LIMITED) the line passes at most one, on the way that passes
/// the fewest: one at the common end of two, two where two cross. Those that the eye is on do not
/// count. sl_runtime_look and the polygons count them too, but behind a mirror from the mirror on:
/// so more may be shown there. All that is from cell to cell or from box to box takes them as open.
///
/// The rows do not say it all: an eye at the end of a wall stands in cells on both sides, and may
/// see a point though sl_runtime_can_see says no of the cells of both points. Time: the portals of
/// the cells along the line. A line that touches ends of portals in more than 32 cells also clears
/// a byte for each cell.
SL_RUNTIME_API bool sl_runtime_sees(const sl_runtime *runtime, double x0, double y0, double x1,
                                    double y1, const unsigned char *shut, double range,
                                    uint32_t *scratch);

// Windows, fences, curtains: walls that stop only some of sight, steps and sound. A file is for one
// of the three, mostly for sight. A wall that does not stop this is a portal, and one that does is
// a wall, which others may pass from cell to cell: a passage.

/// What the walls on a portal stop, as bits of SL_RUNTIME_STOPS_SIGHT ...; 0 for most.
SL_RUNTIME_API uint32_t sl_runtime_portal_stops(const sl_runtime *runtime, uint32_t portal);

/// A wall of a cell that does not stop all, with its ends as one crosses it.
typedef struct sl_runtime_passage {
    uint32_t cell;  ///< behind it
    uint32_t stops; ///< bits of SL_RUNTIME_STOPS_SIGHT ..., `channel` of the file among them
    double left[2], right[2];
} sl_runtime_passage;

/// Finds the passages of a cell. Returns their number, and puts the first `room` of them into
/// `passages`. With these and with directed portals, a search for ways knows all neighbours of a
/// cell. Time: the passages of the cell.
SL_RUNTIME_API uint32_t sl_runtime_passages(const sl_runtime *runtime, uint32_t cell,
                                            sl_runtime_passage *passages, uint32_t room);

/// Whether one may walk straight from one point to another: no point of the way, ends included, is
/// on a wall that stops steps, a mirror, one-way glass or a shut door, in solid ground or outside
/// the map. `shut` is as for sl_runtime_can_see_past. Exact, and the same both
/// ways. Sight may touch walls, so a step that is only seen could end in a wall and leave it on its
/// other side. Who is put exactly on a wall cannot leave it: put him beside it. False for a file
/// that has no walls. Time: the portals of the cells along the step. A step that touches ends of
/// portals also takes the sides of these cells; in more than 32 cells, or on the map's border, all
/// walls and doors.
SL_RUNTIME_API bool sl_runtime_can_walk(const sl_runtime *runtime, double x0, double y0, double x1,
                                        double y1, const unsigned char *shut);

// Mirrors. What is seen directly is exact, and what rows say of mirrors is conservative: no cell is
// missed, but cells may be added. The rows count whole cells, all directions and the map's range.
// So they hold what some eye in the cell sees by some mirror, with up to as many reflections as the
// bake followed (`bake --mirror-depth`, by default 1). sl_runtime_visible_polygon ends at mirrors;
// sl_runtime_visible_polygon_mirrored goes on behind them, and needs no rows.

/// Iterates over the cells that are seen by mirror from a cell, as sl_runtime_row. A cell may see
/// itself. Empty unless `mirrors` is SL_RUNTIME_MIRRORS_BAKED.
SL_RUNTIME_API sl_runtime_run sl_runtime_mirrored_row(const sl_runtime *runtime, uint32_t cell);

/// Whether anything in cell `to` can be seen from anywhere in cell `from`, directly or by mirror.
/// `shut` is as for sl_runtime_can_see_past. True for all cells if the bake did
/// not look into the map's mirrors.
SL_RUNTIME_API bool sl_runtime_can_see_mirrored(const sl_runtime *runtime, uint32_t from,
                                                uint32_t to, const unsigned char *shut);

/// As sl_runtime_look_past, and after these cells those that are seen by mirror alone. The first
/// `*direct` cells are those of sl_runtime_look_past: exact, but for the margin that it tells of if
/// there is a range, the map's own or `range`. The others are those of the rows of the cells that
/// the eye stands in, whatever the cone and `range` are. If the eye's cell has no row, or the bake
/// did not look into the map's mirrors, they are all other cells but solid ground. Without mirrors
/// it is sl_runtime_look_past.
SL_RUNTIME_API uint32_t sl_runtime_look_mirrored(const sl_runtime *runtime,
                                                 const sl_runtime_view *view,
                                                 const unsigned char *shut, double range,
                                                 uint32_t *scratch, uint32_t *cells, uint32_t room,
                                                 uint32_t *direct);

/// The size of `mirrored_scratch` for sl_runtime_look_into_mirrors, in uint32_t: depth + 1 times
/// that of the other calls.
SL_RUNTIME_API size_t sl_runtime_mirrored_scratch_count(const sl_runtime *runtime, uint32_t depth);

/// As sl_runtime_look_mirrored, but what is seen by mirror is exact: the cells that some line from
/// the eye, inside the cone, reaches by at least one and up to `depth` reflections (16 at most). A
/// line crosses a mirror as it would cross a portal, by the rules of sl_runtime_look, straight on
/// behind it. So an eye on a mirror looks into it. Lines are within range with their reflections;
/// its margin is that of sl_runtime_look_past, about the image of the eye. The first `*direct`
/// cells are those of sl_runtime_look_past; the others ascend. It needs no rows of mirrors.
///
/// Exact behind axial mirrors, as long as the image of the eye is one of doubles: with coordinates
/// of few bits, as floats and those of drawings, it is. If not, if an oblique mirror is seen, if
/// the search takes very long, and in a file before 2.0 or a loose one, `*rounded` is set. Then the
/// other cells of sl_runtime_look_mirrored are added, so that none is missed, up to the reflections
/// of the bake. Time: that of sl_runtime_look_past for each piece of a mirror that is seen, and for
/// each cell seen all mirrors.
SL_RUNTIME_API uint32_t sl_runtime_look_into_mirrors(const sl_runtime *runtime,
                                                     const sl_runtime_view *view,
                                                     const unsigned char *shut, double range,
                                                     uint32_t depth, uint32_t *mirrored_scratch,
                                                     uint32_t *cells, uint32_t room,
                                                     uint32_t *direct, bool *rounded);

/// As sl_runtime_seen_from, directly or by mirror. All cells if the bake did not look into the
/// map's mirrors.
SL_RUNTIME_API uint32_t sl_runtime_seen_from_mirrored(const sl_runtime *runtime,
                                                      const uint32_t *cells, uint32_t count,
                                                      const unsigned char *shut,
                                                      unsigned char *bits);

/// Eye-to-region: the polygon that the eye sees inside the cone, for fog of war. Returns the number
/// of its points, and puts the first `room` of them into `points`, as pairs x, y. If there are more
/// than `room`, ask again with that much room. Returns 0 if nothing is seen: the eye is outside the
/// map or in solid ground, or the cone is one direction. `shut` and `scratch` are as for
/// sl_runtime_look_past.
///
/// Points go counter-clockwise about the eye, so the triangles (eye, point i, point i + 1) cover
/// what is seen. With a cone, the eye is the first point. Shut doors, mirrors and one-way glass
/// that the eye cannot look through count as walls.
///
/// `range` is as for sl_runtime_look_past. It cuts the polygon by a circle about the eye. An arc
/// becomes chords of equal length, of at most 1/128 of the circle. So they lie inside it, by at
/// most 1/3000 of the range. Between arcs, points are where the circle meets a wall or a line of
/// sight.
///
/// As sl_query_region of the library: no sign comes from a rounded number. Points are corners of
/// the map or meets of a ray with a wall, rounded to a few units in the last place. What is seen in
/// a single direction only is not part of it. Where walls part what is around the eye, it is a
/// point of the polygon. Returns 0 for a loose file, and if the search takes very long, which a
/// sound file does not cause. Time: the sides and portals of the cells that are seen.
SL_RUNTIME_API uint32_t sl_runtime_visible_polygon(const sl_runtime *runtime,
                                                   const sl_runtime_view *view,
                                                   const unsigned char *shut, double range,
                                                   uint32_t *scratch, double *points,
                                                   uint32_t room);

/// A grid over the map, for what was explored: tile (i, k) is from min_x + i * tile, min_y + k *
/// tile on, and has the bit bits[n / 8] >> n % 8 & 1 for n = k * columns + i. The game keeps and
/// saves the bits, (columns * rows + 7) / 8 bytes that begin as 0.
typedef struct sl_runtime_grid {
    double min_x, min_y, tile;
    uint32_t columns, rows;
    unsigned char *bits;
} sl_runtime_grid;

/// A grid over the map with tiles of a size: bits is NULL. No column and no row if the size is not
/// above 0, or tiles are more than 2^31.
SL_RUNTIME_API sl_runtime_grid sl_runtime_grid_over(const sl_runtime *runtime, double tile);

/// Fog that stays: sets the bits of the tiles whose middles are in a visible polygon about an eye.
/// Returns how many are new. By rounding, a middle nearer to the polygon's border than 1e-12 of the
/// map's largest coordinate may count or not. Time: the tiles in the polygon, and for each edge its
/// rows.
///
///     count = sl_runtime_visible_polygon(&runtime, &view, shut, range, scratch, points, room);
///     if (count <= room) sl_runtime_explore(&grid, view.x, view.y, points, count);
SL_RUNTIME_API uint32_t sl_runtime_explore(const sl_runtime_grid *grid, double x, double y,
                                           const double *points, uint32_t count);

/// What is seen directly, or in a piece of a mirror, that is itself seen directly or in another
/// mirror: a polygon.
typedef struct sl_runtime_mirror_part {
    uint32_t mirror; ///< that it is seen in; none for depth 0, what is seen directly
    uint32_t parent; ///< the part in which the mirror is seen
    uint32_t depth;  ///< reflections
    bool rounded;    ///< the image of the eye is rounded
    double eye[2];   ///< the image of the eye, about which the points go counter-clockwise
    double frame[6]; ///< where the map seems to be, straight on: a place (x, y) of it at
                     ///< (frame[0] x + frame[1] y + frame[2], frame[3] x + frame[4] y + frame[5])
    uint32_t first, count; ///< its points are points[first .. first + count)
    uint32_t cell;         ///< this and the rest is for the function only
    bool joins;
    double right[4], left[4], at[4];
} sl_runtime_mirror_part;

/// As sl_runtime_visible_polygon, and what is seen in mirrors by up to `depth` reflections. Returns
/// the number of points of all parts together, and puts the first `room` of them into `points`. The
/// parts, of which parts[0] is what is seen directly, come each after its parent; *part_count is
/// their number. If that is more than part_room, parts are missing, and so are those that are seen
/// in them: ask again with more room. (A part is not empty. So there are none if nothing is seen.)
///
/// A part is given where it is in the map: it lies before its mirror, and the eye's image behind
/// that sees it. To draw what the mirror shows, draw the part moved by its frame. The points of a
/// part with a mirror begin at the right end of the piece of the mirror that is seen, and end at
/// the left end. Where mirrors lie on each other, the first one of the map counts. An eye on a
/// mirror sees nothing in it.
///
/// Sightlines are within range with their reflections. Behind axial mirrors it is exact which walls
/// are seen, as long as the image of the eye is one of doubles: with coordinates of few bits, as
/// those of drawings and games, it always is. If not, and behind oblique mirrors, `rounded` is set.
/// A part is then exact for an eye and borders that each reflection moves by a few units in the
/// last place of the largest coordinates. What a range cuts off a mirror is rounded.
///
/// 1 part, that seen directly, in a file without mirrors and in one before 2.0, which has not where
/// they are. Time: a polygon for each part, and for each wall seen all mirrors.
SL_RUNTIME_API uint32_t sl_runtime_visible_polygon_mirrored(
    const sl_runtime *runtime, const sl_runtime_view *view, const unsigned char *shut, double range,
    uint32_t depth, uint32_t *scratch, sl_runtime_mirror_part *parts, uint32_t part_room,
    uint32_t *part_count, double *points, uint32_t room);

// Boxes move: things that are drawn, and things that hide what is behind them. The level is baked
// without them, and no bake is made when they move. The header keeps, for each cell, a list of the
// boxes in it. So a box that moves changes the lists of its own cells alone, and an eye asks only
// the boxes in the cells that it sees.
//
//     sl_runtime_box list[1000];
//     size_t size = sl_runtime_boxes_count(&runtime, 1000, 8000);
//     uint32_t *memory = malloc(size * sizeof *memory);
//     sl_runtime_boxes_start(&boxes, &runtime, list, 1000, 8000, memory);
//     size_t most = sl_runtime_boxes_scratch_count(&boxes);
//     uint32_t *boxes_scratch = malloc(most * sizeof *boxes_scratch);
//     each frame, for each box that moved: sl_runtime_boxes_move(&boxes, i, &box);
//     for each eye: sl_runtime_boxes_seen(&boxes, &view, shut, 0, boxes_scratch, seen);

/// A box. It may have no width or height, and lie anywhere.
typedef struct sl_runtime_box {
    double min_x, min_y, max_x, max_y;
    bool blocks; ///< it hides what is behind it
} sl_runtime_box;

/// Many boxes in a level. One thread may move them while no other asks; any number of threads may
/// ask at a time.
typedef struct sl_runtime_boxes {
    const sl_runtime *runtime;
    uint32_t count, room;
    sl_runtime_box *boxes; ///< for reading; sl_runtime_boxes_move writes
    uint32_t *memory;      ///< for the functions only
} sl_runtime_boxes;

/// The size of the memory for boxes, in uint32_t. `room`: how many pairs of a box and a cell that
/// it lies in the memory is to hold. Rooms have several cells: a box of 1 m is in 1.6 of an office
/// on average, and one of 4 m in 3.6. Eight for each box leave room for crowds.
SL_RUNTIME_API size_t sl_runtime_boxes_count(const sl_runtime *runtime, uint32_t count,
                                             uint32_t room);

/// Starts with `count` boxes that are nowhere yet. `list`, of `count` boxes, and `memory` may hold
/// anything, and are used as long as `out` is.
SL_RUNTIME_API void sl_runtime_boxes_start(sl_runtime_boxes *out, const sl_runtime *runtime,
                                           sl_runtime_box *list, uint32_t count, uint32_t room,
                                           uint32_t *memory);

/// Puts a box at its place, or at a new one. `box` must be less than `count`. A box outside the
/// bounds, one whose minimum is above its maximum and one with NaN or a coordinate above 2e150 or
/// below -2e150 are in no cell, never seen, and stop nothing. Returns false if there is no room for
/// its cells. The box is then seen by every eye that stands in the map and not in solid ground. It
/// hides and stops nothing, until it is moved again. Time: the cells near the box.
SL_RUNTIME_API bool sl_runtime_boxes_move(sl_runtime_boxes *boxes, uint32_t box,
                                          const sl_runtime_box *to);

/// The size of `boxes_scratch` for the calls below, in uint32_t: the scratch memory of the calls
/// without boxes, 1,600 bytes, and 370 bytes for each box.
SL_RUNTIME_API size_t sl_runtime_boxes_scratch_count(const sl_runtime_boxes *boxes);

/// Finds which boxes an eye sees: sets seen[i] to 1 or 0, and returns how many are seen. `view`,
/// `shut` and `range` are as for sl_runtime_look_past.
///
/// If no box blocks, this is exact, with closed sight: a box is seen if a line from the eye, within
/// the cone, comes to one of its points in a cell that sl_runtime_look_past sees by that line. A
/// box that only touches a wall from behind is not seen through it. A flat box that lies along a
/// wall or a shut door in part counts as if it stood before it. (The signs are of the third degree.
/// They are exact if no coordinate but 0 is 1e70 times smaller than another one.) With a range, a
/// seen box counts if any of its points is within range, or beyond it by at most 1e-12 of it.
///
/// Boxes that block hide each other, as a line may touch a box but not pass its inside. That is
/// exact too if no two boxes overlap. No box hides another one that it overlaps, which may then
/// count as seen though it is hidden. A box is never missed. The box that holds the eye
/// is seen. If that one blocks, the eye in it sees no box outside of it.
///
/// Time: that of one sl_runtime_look_past and the boxes in the cells seen; if boxes block, two of
/// them, and for each pair of boxes that are seen past walls.
SL_RUNTIME_API uint32_t sl_runtime_boxes_seen(const sl_runtime_boxes *boxes,
                                              const sl_runtime_view *view,
                                              const unsigned char *shut, double range,
                                              uint32_t *boxes_scratch, unsigned char *seen);

/// As sl_runtime_look_past, past boxes that block: it leaves out cells that are hidden. No cell in
/// sight is missed. A hidden cell may be left in if a box lies across the line of a portal. `seen`,
/// with a byte for each box, is set as by sl_runtime_boxes_seen.
SL_RUNTIME_API uint32_t sl_runtime_look_past_boxes(const sl_runtime_boxes *boxes,
                                                   const sl_runtime_view *view,
                                                   const unsigned char *shut, double range,
                                                   uint32_t *boxes_scratch, unsigned char *seen,
                                                   uint32_t *cells, uint32_t room);

/// As sl_runtime_visible_polygon, past boxes that block: their sides are walls, from outside and
/// for an eye in the box from within. With `boxes_scratch` as for sl_runtime_boxes_seen.
///
/// It is decided exactly which sides are seen and in what order (if no coordinate but 0 is 1e70
/// times smaller than another one). A point where a side crosses an oblique wall is rounded. A box
/// that is a point hides nothing. Boxes may touch walls and each other, and overlap. An eye on a
/// side sees one side of it, as on a wall: what is right of the eye and over it, if its cell is
/// there, else left and over, right and under, left and under. At a corner it sees the part around
/// it that has this one. All this is as sl_query_region of the library says, but in files with
/// oblique walls that takes another side of a box that the eye is on.
///
/// Time: that of sl_runtime_visible_polygon and of the boxes in the cells that are seen. If some of
/// these block, twice that, n log n for n such boxes, and what of their sides is seen.
SL_RUNTIME_API uint32_t sl_runtime_visible_polygon_past_boxes(const sl_runtime_boxes *boxes,
                                                              const sl_runtime_view *view,
                                                              const unsigned char *shut,
                                                              double range, uint32_t *boxes_scratch,
                                                              double *points, uint32_t room);

/// As sl_runtime_sees, past boxes that block: false if the line passes the inside of one of them.
/// Exact. A line may touch boxes and run along their sides, also between two that touch each other.
/// It passes a flat box where it crosses that between its ends, and never one that is a point. An
/// eye or a point on a side is outside, and sees to both sides of it. (The polygon has one.) If one
/// of both is inside a box and the other one in it or on its side, that box does not come between
/// them. Boxes that had no room hide nothing.
///
/// sl_query_sees of the library differs where a line only touches boxes: it sees nothing along a
/// line that boxes and walls touch from both sides, and has the cell of an eye on a side decide
/// whether the eye is inside. Time: as sl_runtime_sees, and the boxes in the cells along the line.
SL_RUNTIME_API bool sl_runtime_sees_past_boxes(const sl_runtime_boxes *boxes, double x0, double y0,
                                               double x1, double y1, const unsigned char *shut,
                                               double range, uint32_t *boxes_scratch);

/// As sl_runtime_can_walk, past boxes that block: no point of the way, ends included, is in such a
/// box or on its side. Box `except` does not count: that of who walks, or SL_RUNTIME_NO_BOX. Exact,
/// and the same both ways. Boxes that had no room, or only touch the map's bounds, stop nothing.
/// Time: as sl_runtime_can_walk, and the boxes in the cells along the step.
SL_RUNTIME_API bool sl_runtime_can_walk_past_boxes(const sl_runtime_boxes *boxes, double x0,
                                                   double y0, double x1, double y1,
                                                   const unsigned char *shut, uint32_t except);

/// A disc that walks, and what stops it beside walls, mirrors and one-way glass.
typedef struct sl_runtime_walker {
    double radius;                 ///< 0, less and NaN for a point
    const unsigned char *shut;     ///< as for sl_runtime_can_see_past
    const sl_runtime_boxes *boxes; ///< those that block stop it; NULL for none
    uint32_t own_box;              ///< one that does not, or SL_RUNTIME_NO_BOX
} sl_runtime_walker;

/// Whether a disc may move straight from one point to another. `scratch`, of
/// sl_runtime_scratch_count, may hold anything.
///
/// Conservative: no point of the way, ends included, is nearer than the radius to anything that
/// stops the disc, or to the map's border. It may say no if something is nearer than the radius
/// plus 6e-14 of the map's largest coordinates, x plus y, and the radius. With radius 0 it is
/// exact, as sl_runtime_can_walk and sl_runtime_can_walk_past_boxes. False for a loose file and one
/// without walls. Time: the sides of the cells within reach of the way, and the boxes in them.
SL_RUNTIME_API bool sl_runtime_can_walk_wide(const sl_runtime *runtime,
                                             const sl_runtime_walker *walker, double x0, double y0,
                                             double x1, double y1, uint32_t *scratch);

/// Moves a disc from (x0, y0) toward (x1, y1), and puts where it comes to into `x` and `y`. True if
/// it comes to (x1, y1). At what stops it, it slides along: it goes on by what is left of the way,
/// without the part toward the obstacle, up to 3 times. It stays where it may not move, and if it
/// is to go to NaN or farther than 2e150.
///
/// It never passes what stops it, and passes nothing nearer than the radius. It comes to rest at
/// most 6e-14 of the map's largest coordinates, x plus y, and the radius farther off. Who already
/// stands nearer to something may move away from it or along it, not nearer. Who stands on a wall,
/// or on or in a box, stays. A point (radius 0) comes to each place that it can walk to straight,
/// and each comes to where it is. Sliding needs coordinates above 1e-130. Otherwise, as of
/// sl_runtime_can_walk_wide; time: up to 4 times its.
SL_RUNTIME_API bool sl_runtime_walk(const sl_runtime *runtime, const sl_runtime_walker *walker,
                                    double x0, double y0, double x1, double y1, uint32_t *scratch,
                                    double *x, double *y);

// Servers: what each player may see before it hears of the next tick.

/// The size of `relevant_scratch` for sl_runtime_relevant, in uint32_t.
SL_RUNTIME_API size_t sl_runtime_relevant_count(const sl_runtime *runtime, uint32_t thing_count);

/// Box to box, for many: finds which things each player may see. Player p may see thing t if
/// bits[p * ((thing_count + 7) / 8) + t / 8] >> t % 8 & 1. Returns the number of such pairs. `bits`
/// has a row for each player. `shut` and `range` are as for sl_runtime_look_past, but the distance
/// between two places counts. Boxes do not hide each other.
///
/// `margin` is how far a player may come before the next answer. Its box grows by that to each
/// side, through walls too: all of it looks but what is in solid ground or outside the map.
///
/// Conservative: no pair is missed of which one point of the grown box sees one point of the thing
/// by sl_runtime_sees, with closed sight. It needs no rows, so it is that in any file but a loose
/// one. Few pairs are added: on the maps of the tests at most 10 % more than the exact answer from
/// box to box. More are added near the end of the range. A player's box takes everything if its
/// lines of sight come to 16 times as many portals as the map has, which real maps do not cause.
///
/// A box with NaN, or with a minimum above its maximum, sees nothing and is not seen. To give each
/// player a margin of its own, let the boxes have it and `margin` be 0. Time: the cells near each
/// thing; for each player, the portals that it may see, and the things in their cells. It clears 4
/// bytes for each cell. Large things, near far more than 16 cells each, take more than one round.
SL_RUNTIME_API size_t sl_runtime_relevant(const sl_runtime *runtime, const sl_runtime_box *players,
                                          uint32_t player_count, double margin,
                                          const sl_runtime_box *things, uint32_t thing_count,
                                          const unsigned char *shut, double range,
                                          uint32_t *relevant_scratch, unsigned char *bits);

/// The same for two squares: whether some place within `radius0` of (x0, y0) along each axis may
/// see some place within `radius1` of (x1, y1). `scratch` is as for sl_runtime_look. Time: the
/// portals between them, and to clear a bit for each cell.
SL_RUNTIME_API bool sl_runtime_sees_within(const sl_runtime *runtime, double x0, double y0,
                                           double radius0, double x1, double y1, double radius1,
                                           const unsigned char *shut, double range,
                                           uint32_t *scratch);

// Ways: how to walk from one place to another.

/// How a search for a way ended.
typedef enum sl_runtime_way_status {
    SL_RUNTIME_WAY_FOUND = 0,
    SL_RUNTIME_WAY_NONE,     ///< no way leads there
    SL_RUNTIME_WAY_NO_PLACE, ///< an end is outside the map or in solid ground, or the file is loose
    SL_RUNTIME_WAY_NODES,    ///< the search needs more nodes
    SL_RUNTIME_WAY_ROOM      ///< the way has more points than there is room for
} sl_runtime_way_status;

/// A way.
typedef struct sl_runtime_way {
    uint32_t count; ///< its points, 2 or more: both ends, and the corners where it turns
    double length;  ///< in map units
} sl_runtime_way;

/// The size of `way_scratch` for searches with so many nodes, in uint32_t: 5 bytes for each cell,
/// and 128 for each node if their number is a power of two, else up to 160. Begin with 1,024 nodes
/// for a level of 100 cells, with 32,768 for one of 10,000, and double them when they are too few.
SL_RUNTIME_API size_t sl_runtime_way_scratch_count(const sl_runtime *runtime, uint32_t nodes);

/// The shortest way on foot from (x0, y0) to (x1, y1), by a point that may slide along walls and
/// turn at their ends: the same as sl_route_find of the library says. Doors stand as `shut` says
/// (sl_runtime_can_see_past). Shut doors, mirrors and walls that stop steps are not passed, nor is
/// a point where walls meet. One-way glass is passed from where it is seen through: it stops
/// sl_runtime_can_walk, which also takes no step that touches a wall. Boxes stop nothing here. A
/// point on a wall stands on one side of it, that of its cell.
///
/// Puts the points of the way (x, y, x, y ...) into `points`, which has room for `room` points, and
/// their number and the way's length into `out`. Without a way, both are 0, and `points` is
/// unchanged. SL_RUNTIME_WAY_ROOM says what room is needed in out->count: `points` is unchanged.
/// SL_RUNTIME_WAY_NODES: there may be a way; ask again with twice as many nodes. (With a damaged
/// file, a search that takes very long ends so, too.) `way_scratch` may hold anything.
///
/// Signs are exact: the way crosses no wall, and it turns only where a wall is. Lengths are sums of
/// square roots, compared as doubles: the way is longer than the shortest one by at most a relative
/// 2^-40 for each of its corners. Of ways of the same length, one is chosen by the places of its
/// corners: the same question has the same answer, as a rule that of sl_route_find(), too.
///
/// Time: the cells within reach of the start, up to that of the goal, once; and the nodes. It
/// clears 32 to 64 bytes for each node there is room for.
SL_RUNTIME_API sl_runtime_way_status sl_runtime_find_way(const sl_runtime *runtime, double x0,
                                                         double y0, double x1, double y1,
                                                         const unsigned char *shut,
                                                         uint32_t *way_scratch, uint32_t nodes,
                                                         double *points, uint32_t room,
                                                         sl_runtime_way *out);

/// A cell. Its corners, counter-clockwise, are vertex_count vertices from first_vertex on. Its
/// portals are directed_count directed portals from first_directed on.
typedef struct sl_runtime_cell {
    uint32_t first_vertex, vertex_count, first_directed, directed_count;
} sl_runtime_cell;

/// A directed portal: the cell that it leads to, and its ends as crossed on the way out.
typedef struct sl_runtime_directed_portal {
    uint32_t portal, cell;
    double left[2], right[2];
} sl_runtime_directed_portal;

/// For drawing, path finding and doors. The number must be less than the count of its kind.
SL_RUNTIME_API sl_runtime_cell sl_runtime_get_cell(const sl_runtime *runtime, uint32_t cell);
/// A directed portal; the number must be less than directed_count.
SL_RUNTIME_API sl_runtime_directed_portal sl_runtime_get_directed_portal(const sl_runtime *runtime,
                                                                         uint32_t directed);
/// A vertex; the number must be less than vertex_count.
SL_RUNTIME_API void sl_runtime_get_vertex(const sl_runtime *runtime, uint32_t vertex, double *x,
                                          double *y);

#ifdef __cplusplus
}
#endif

#endif
