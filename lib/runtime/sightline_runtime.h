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

#if defined(SIGHTLINE_RUNTIME_IMPLEMENTATION) && !defined(SIGHTLINE_RUNTIME_IMPLEMENTED)
#define SIGHTLINE_RUNTIME_IMPLEMENTED

#include <float.h>
#include <string.h>

#if FLT_EVAL_METHOD == 2 || FLT_EVAL_METHOD < 0
#error "this compiler computes doubles with more bits, so signs are wrong: use -msse2 -mfpmath=sse"
#endif

#ifdef __cplusplus
extern "C" {
#endif

// --- Numbers in the file: copied, so that alignment and aliasing do not matter; little endian

#if defined(__BYTE_ORDER__) && defined(__ORDER_BIG_ENDIAN__)
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define SLRT_BIG_ENDIAN
#endif
#endif

static uint32_t slrt_u32(const unsigned char *at) {
    uint32_t value;
#ifdef SLRT_BIG_ENDIAN
    int i;
    for (i = 3, value = 0; i >= 0; i--) value = value << 8 | at[i];
#else
    memcpy(&value, at, sizeof value);
#endif
    return value;
}

static int32_t slrt_i32(const unsigned char *at) {
    const uint32_t bits = slrt_u32(at);
    int32_t value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint64_t slrt_u64(const unsigned char *at) {
    uint64_t value;
#ifdef SLRT_BIG_ENDIAN
    int i;
    for (i = 7, value = 0; i >= 0; i--) value = value << 8 | at[i];
#else
    memcpy(&value, at, sizeof value);
#endif
    return value;
}

static double slrt_f64(const unsigned char *at) {
    const uint64_t bits = slrt_u64(at);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// What checks the file runs once: the npm package has it as small as clang can make it.
#ifdef SL_RUNTIME_SMALL_OPEN
#pragma clang attribute push(__attribute__((minsize)), apply_to = function)
#endif

// --- The file: its header, its checksum and its sections. Layout as in lib/bake/slv.h

enum {
    SLRT_HEADER_BYTES = 32,
    SLRT_ENTRY_BYTES = 24, ///< of the table of sections
    SLRT_NODE_BYTES = 24,
    SLRT_CELL_BYTES = 24,
    SLRT_VERTEX_BYTES = 16,
    SLRT_PORTAL_BYTES = 40,
    SLRT_DIRECTED_BYTES = 40,
    SLRT_DOOR_BYTES = 12,
    SLRT_START_BYTES = 24,
    SLRT_OBJECT_BYTES = 40,
    SLRT_PATH_BYTES = 16,
    SLRT_MIRROR_BYTES = 40,
    SLRT_PASSAGE_BYTES = 16
};

enum slrt_tag {
    SLRT_INFO,
    SLRT_NODE,
    SLRT_CELL,
    SLRT_VERT,
    SLRT_PORT,
    SLRT_PORTAL,
    SLRT_PVSO,
    SLRT_PVSB,
    SLRT_PART,
    SLRT_VCIN,
    SLRT_VCEL,
    SLRT_VCPA,
    SLRT_VCRO,
    SLRT_VCRB,
    SLRT_SEAM,
    SLRT_DORO,
    SLRT_DORB,
    SLRT_BEYO,
    SLRT_SEPO,
    SLRT_MAPT,
    SLRT_MIRO,
    SLRT_MIRB,
    SLRT_MDOO,
    SLRT_MDOB,
    SLRT_WALL,
    SLRT_MAPI, ///< of files since 2.0, as those up to MIRR: what the map holds, in items
    SLRT_MAPN,
    SLRT_DOOR,
    SLRT_STRT,
    SLRT_OBJE,
    SLRT_PATH,
    SLRT_PAPO,
    SLRT_MIRR,
    SLRT_STOP, ///< with CHAN and PASS: what walls stop that do not stop all
    SLRT_CHAN,
    SLRT_PASS,
    SLRT_PVSP,
    SLRT_NODG,
    SLRT_NODS,
    SLRT_GRIO, ///< of version 2, as what follows
    SLRT_GRIC,
    SLRT_TAGS
};

typedef struct slrt_section {
    const unsigned char *items; ///< NULL if the file has none
    uint64_t count;
} slrt_section;

static uint32_t slrt_crc_on(const uint32_t *table, uint32_t sum, const unsigned char *at,
                            size_t count) {
    size_t i;
    for (i = 0; i < count; i++) sum = table[(sum ^ at[i]) & 255] ^ sum >> 8;
    return sum;
}

/// CRC-32 of the file, as in zlib. The four bytes of the checksum itself count as 0.
static uint32_t slrt_checksum(const unsigned char *bytes, size_t size) {
    static const unsigned char zeros[4] = {0, 0, 0, 0};
    uint32_t table[256], sum = UINT32_MAX, i;
    for (i = 0; i < 256; i++) {
        uint32_t value = i;
        int bit;
        for (bit = 0; bit < 8; bit++) value = value >> 1 ^ (value & 1 ? 0xedb88320u : 0);
        table[i] = value;
    }
    sum = slrt_crc_on(table, sum, bytes, SLRT_HEADER_BYTES - 4);
    sum = slrt_crc_on(table, sum, zeros, 4);
    sum = slrt_crc_on(table, sum, bytes + SLRT_HEADER_BYTES, size - SLRT_HEADER_BYTES);
    return ~sum;
}

static sl_runtime_status slrt_check_header(const unsigned char *bytes, size_t size) {
    static const unsigned char magic[8] = {0x89, 'S', 'L', 'V', '\r', '\n', 0x1a, '\n'};
    if (!bytes || size < 8 || memcmp(bytes, magic, 8) != 0) return SL_RUNTIME_NOT_BAKED;
    if (size < SLRT_HEADER_BYTES) return SL_RUNTIME_SIZE;
    if (slrt_u32(bytes + 12) != 0x01020304u) return SL_RUNTIME_BYTE_ORDER;
    if (slrt_u32(bytes + 8) != 1 && slrt_u32(bytes + 8) != 2) return SL_RUNTIME_VERSION;
    if (slrt_u64(bytes + 16) != size) return SL_RUNTIME_SIZE;
    if (slrt_checksum(bytes, size) != slrt_u32(bytes + 28)) return SL_RUNTIME_CHECKSUM;
    if (slrt_u32(bytes + 24) > (size - SLRT_HEADER_BYTES) / SLRT_ENTRY_BYTES)
        return SL_RUNTIME_SECTION;
    return SL_RUNTIME_OK;
}

/// Finds the sections that the runtime knows, and skips others.
static sl_runtime_status slrt_find_sections(const unsigned char *bytes, size_t size,
                                            slrt_section *found) {
    static const struct {
        char tag[5];
        unsigned char item_bytes;
    } known[SLRT_TAGS] = {{"INFO", 128},
                          {"NODE", SLRT_NODE_BYTES},
                          {"CELL", SLRT_CELL_BYTES},
                          {"VERT", SLRT_VERTEX_BYTES},
                          {"PORT", SLRT_PORTAL_BYTES},
                          {"EXIT", SLRT_DIRECTED_BYTES},
                          {"PVSO", 8},
                          {"PVSB", 1},
                          {"PART", 16},
                          {"VCIN", 8},
                          {"VCEL", 4},
                          {"VCPA", 4},
                          {"VCRO", 8},
                          {"VCRB", 1},
                          {"SEAM", 40},
                          {"DORO", 8},
                          {"DORB", 1},
                          {"BEYO", 4},
                          {"SEPO", 12},
                          {"MAPT", 1},
                          {"MIRO", 8},
                          {"MIRB", 1},
                          {"MDOO", 8},
                          {"MDOB", 1},
                          {"WALL", 32},
                          {"MAPI", 40},
                          {"MAPN", 1},
                          {"DOOR", SLRT_DOOR_BYTES},
                          {"STRT", SLRT_START_BYTES},
                          {"OBJE", SLRT_OBJECT_BYTES},
                          {"PATH", SLRT_PATH_BYTES},
                          {"PAPO", SLRT_VERTEX_BYTES},
                          {"MIRR", SLRT_MIRROR_BYTES},
                          {"STOP", 4},
                          {"CHAN", 4},
                          {"PASS", SLRT_PASSAGE_BYTES},
                          {"PVSP", 8},
                          {"NODG", 8},
                          {"NODS", 4},
                          {"GRIO", 4},
                          {"GRIC", 4}};
    const uint32_t count = slrt_u32(bytes + 24);
    uint32_t i;
    const int tags = slrt_u32(bytes + 8) == 1 ? SLRT_GRIO : SLRT_TAGS;
    int tag;
    for (i = 0; i < count; i++) {
        const unsigned char *entry =
            bytes + SLRT_HEADER_BYTES + (size_t)i * (size_t)SLRT_ENTRY_BYTES;
        const uint64_t offset = slrt_u64(entry + 8), items = slrt_u64(entry + 16);
        for (tag = 0; tag < tags && memcmp(entry, known[tag].tag, 4) != 0;) tag++;
        if (tag == tags) continue;
        if (found[tag].items || slrt_u32(entry + 4) != known[tag].item_bytes || offset > size ||
            items > (size - offset) / known[tag].item_bytes)
            return SL_RUNTIME_SECTION;
        found[tag].items = bytes + offset;
        found[tag].count = items;
    }
    if (found[SLRT_PART].items && found[SLRT_PART].count != 1) return SL_RUNTIME_SECTION;
    if (found[SLRT_PART].items && slrt_u32(found[SLRT_PART].items + 4)) return SL_RUNTIME_SHARD;
    if (found[SLRT_VCIN].items && !found[SLRT_PVSO].items && !found[SLRT_PVSB].items)
        found[SLRT_PVSO].count = found[SLRT_CELL].count + 1; // rows are the view cells'
    else if (!found[SLRT_PVSO].items || !found[SLRT_PVSB].items)
        return SL_RUNTIME_SECTION;
    for (tag = 0; tag < SLRT_PVSO; tag++)
        if (!found[tag].items) return SL_RUNTIME_SECTION;
    return SL_RUNTIME_OK;
}

// --- What is checked of the space when a file is opened

/// Whether a coordinate is sound: a number of at most 2e150, so that products stay finite. They are
/// compared as integers, which no fast-math option changes.
static bool slrt_is_coordinate(double value) {
    const double most = 2e150;
    uint64_t bits, limit;
    memcpy(&bits, &value, sizeof bits);
    memcpy(&limit, &most, sizeof limit);
    return (bits & UINT64_MAX >> 1) <= limit;
}

static bool slrt_usable(const unsigned char *at, int count) {
    int i;
    for (i = 0; i < count; i++)
        if (!slrt_is_coordinate(slrt_f64(at + 8 * i))) return false;
    return true;
}

static sl_runtime_status slrt_check_sizes(const slrt_section *found, sl_runtime *rt) {
    const unsigned char *info = found[SLRT_INFO].items;
    if (found[SLRT_INFO].count != 1 || found[SLRT_PVSO].count != found[SLRT_CELL].count + 1)
        return SL_RUNTIME_SECTION;
    // A cell is stored as ~cell in 32 bits with sign; the search numbers ends of directed portals.
    if (!found[SLRT_CELL].count || found[SLRT_CELL].count > INT32_MAX ||
        found[SLRT_NODE].count > INT32_MAX || found[SLRT_PORTAL].count > INT32_MAX / 2 - 4 ||
        found[SLRT_VERT].count > UINT32_MAX || found[SLRT_PORT].count > UINT32_MAX)
        return SL_RUNTIME_SPACE;
    rt->cell_count = (uint32_t)found[SLRT_CELL].count;
    rt->directed_count = (uint32_t)found[SLRT_PORTAL].count;
    rt->vertex_count = (uint32_t)found[SLRT_VERT].count;
    rt->portal_count = (uint32_t)found[SLRT_PORT].count;
    rt->cells = found[SLRT_CELL].items;
    rt->vertices = found[SLRT_VERT].items;
    rt->directed = found[SLRT_PORTAL].items;
    rt->portals = found[SLRT_PORT].items;
    rt->row_offsets = found[SLRT_PVSO].items;
    rt->row_bytes = found[SLRT_PVSB].items;
    rt->unfinished = found[SLRT_PART].items != NULL;
    if (!slrt_usable(info, 4)) return SL_RUNTIME_SPACE;
    rt->min_x = slrt_f64(info);
    rt->min_y = slrt_f64(info + 8);
    rt->max_x = slrt_f64(info + 16);
    rt->max_y = slrt_f64(info + 24);
    return rt->min_x < rt->max_x && rt->min_y < rt->max_y ? SL_RUNTIME_OK : SL_RUNTIME_SPACE;
}

/// A child comes after its parent, so every way down ends.
static bool slrt_child_is_sound(const sl_runtime *rt, int64_t parent, int32_t child) {
    return child < 0 ? (uint32_t)~child < rt->cell_count
                     : child > parent && (uint32_t)child < rt->node_count;
}

/// Where in the tree the search for the points of a bucket starts, if the file tells.
static bool slrt_take_starts(sl_runtime *rt, const slrt_section *found) {
    const unsigned char *size = found[SLRT_NODG].items;
    uint64_t i;
    if (!size || !found[SLRT_NODS].items) return !size && !found[SLRT_NODS].items;
    if (found[SLRT_NODG].count != 1) return false;
    rt->tree_starts = found[SLRT_NODS].items;
    rt->tree_columns = slrt_u32(size);
    rt->tree_rows = slrt_u32(size + 4);
    for (i = 0; i < found[SLRT_NODS].count; i++)
        if (!slrt_child_is_sound(rt, -1, slrt_i32(rt->tree_starts + (size_t)i * 4))) return false;
    return i && (uint64_t)rt->tree_columns * rt->tree_rows == i;
}

/// A node splits at x (axis 0) or y (axis 1) = its position.
static bool slrt_take_tree(sl_runtime *rt, const slrt_section *found) {
    uint32_t i;
    rt->root = slrt_i32(found[SLRT_INFO].items + 32);
    rt->nodes = found[SLRT_NODE].items;
    rt->node_count = (uint32_t)found[SLRT_NODE].count;
    if (!slrt_child_is_sound(rt, -1, rt->root)) return false;
    for (i = 0; i < rt->node_count; i++) {
        const unsigned char *node = rt->nodes + (size_t)i * SLRT_NODE_BYTES;
        const int32_t axis = slrt_i32(node + 8);
        if (!slrt_usable(node, 1) || axis < 0 || axis > 1 ||
            !slrt_child_is_sound(rt, i, slrt_i32(node + 12)) ||
            !slrt_child_is_sound(rt, i, slrt_i32(node + 16)))
            return false;
    }
    return slrt_take_starts(rt, found);
}

/// The cells of a bucket ascend.
static bool slrt_bucket_is_sound(const sl_runtime *rt, uint32_t first, uint32_t end) {
    uint32_t i, before = 0;
    for (i = first; i < end; i++) {
        const uint32_t cell = slrt_u32(rt->grid_cells + (size_t)i * 4);
        if (cell >= rt->cell_count || (i > first && cell <= before)) return false;
        before = cell;
    }
    return true;
}

static bool slrt_take_grid(sl_runtime *rt, const slrt_section *found) {
    const unsigned char *info = found[SLRT_INFO].items;
    const uint64_t entries = found[SLRT_GRIC].count;
    uint64_t buckets, i;
    uint32_t before = 0;
    rt->loose = slrt_u32(info + 60) != 0;
    rt->grid_columns = slrt_u32(info + 64);
    rt->grid_rows = slrt_u32(info + 68);
    rt->grid_offsets = found[SLRT_GRIO].items;
    rt->grid_cells = found[SLRT_GRIC].items;
    buckets = (uint64_t)rt->grid_columns * rt->grid_rows;
    rt->neighbours = found[SLRT_BEYO].items;
    if (!rt->neighbours || found[SLRT_BEYO].count != rt->vertex_count || !rt->grid_offsets ||
        !rt->grid_cells || !buckets || found[SLRT_GRIO].count != buckets + 1 ||
        entries > UINT32_MAX || slrt_u32(rt->grid_offsets) != 0)
        return false;
    for (i = 1; i <= buckets; i++) {
        const uint32_t end = slrt_u32(rt->grid_offsets + (size_t)i * 4);
        if (end < before || end > entries || !slrt_bucket_is_sound(rt, before, end)) return false;
        before = end;
    }
    return before == entries;
}

/// The index that locates points: a tree if all walls are axial, else a grid. Files of version 1
/// with oblique walls have a tree along oblique lines. It is ignored, and all cells are tested.
static bool slrt_take_location(sl_runtime *rt, const slrt_section *found, uint32_t version) {
    rt->loose = version == 1 && found[SLRT_BEYO].items;
    if (version != 1) return slrt_take_grid(rt, found);
    return rt->loose || slrt_take_tree(rt, found);
}

static bool slrt_cells_are_sound(const sl_runtime *rt) {
    uint32_t i, directed = 0;
    for (i = 0; i < rt->cell_count; i++) {
        const sl_runtime_cell cell = sl_runtime_get_cell(rt, i);
        if (cell.vertex_count < 3 || cell.first_vertex > rt->vertex_count ||
            cell.vertex_count > rt->vertex_count - cell.first_vertex ||
            cell.first_directed != directed || cell.directed_count > rt->directed_count - directed)
            return false;
        directed += cell.directed_count;
    }
    if (directed != rt->directed_count) return false;
    for (i = 0; i < rt->vertex_count; i++)
        if (!slrt_usable(rt->vertices + (size_t)i * SLRT_VERTEX_BYTES, 2)) return false;
    for (i = 0; i < rt->directed_count; i++) {
        const unsigned char *at = rt->directed + (size_t)i * SLRT_DIRECTED_BYTES;
        if (slrt_u32(at) >= rt->portal_count || slrt_u32(at + 4) >= rt->cell_count ||
            !slrt_usable(at + 8, 4))
            return false;
    }
    return true;
}

// --- What is checked of the rows when a file is opened: of cells, view cells, doors and mirrors

/// A number of a checked row in LEB128: seven bits in a byte, low bits first, the high bit set in
/// all bytes but the last.
static uint32_t slrt_number(const unsigned char **next) {
    uint32_t number = *(*next)++;
    if (number & 0x80) {
        unsigned shift = 0;
        uint32_t byte;
        number &= 0x7f;
        do {
            shift += 7;
            byte = *(*next)++;
            number |= (byte & 0x7f) << shift;
        } while (byte & 0x80);
    }
    return number;
}

/// Skips a number of an unchecked row. False if the row ends within it, or it has more than 32
/// bits.
static bool slrt_pass_number(const unsigned char **next, const unsigned char *stop) {
    int i;
    for (i = 0; i < 5 && *next < stop; i++) {
        const unsigned char byte = *(*next)++;
        if (!(byte & 0x80)) return i < 4 || byte < 16;
    }
    return false;
}

/// The parts of the cells that a run reaches into, as bits.
static uint64_t slrt_parts_of(const sl_runtime *rt, uint64_t first, uint64_t end) {
    return (UINT64_C(2) << ((end - 1) >> rt->part_shift)) -
           (UINT64_C(1) << (first >> rt->part_shift));
}

/// A row: runs of cells, ascending, with gaps between them. The row of a cell has the cell itself.
/// A row may be empty. It reaches into the parts that are told of it.
static bool slrt_row_is_sound(const sl_runtime *rt, uint32_t cell, bool of_cell) {
    const unsigned char *next = rt->row_bytes + slrt_u64(rt->row_offsets + (size_t)cell * 8);
    const unsigned char *stop = rt->row_bytes + slrt_u64(rt->row_offsets + (size_t)cell * 8 + 8);
    const bool empty = next == stop;
    uint64_t end = 0, parts = 0;
    bool has_own = false;
    while (next < stop) {
        const unsigned char *at = next;
        uint64_t first;
        uint32_t skip, length;
        if (!slrt_pass_number(&next, stop) || !slrt_pass_number(&next, stop)) return false;
        skip = slrt_number(&at);
        length = slrt_number(&at);
        if ((!skip && end) || !length) return false;
        first = end + skip;
        end = first + length;
        if (end > rt->cell_count) return false;
        if (rt->row_parts) parts |= slrt_parts_of(rt, first, end);
        has_own = has_own || (cell >= first && cell < end);
    }
    if (rt->row_parts && parts != slrt_u64(rt->row_parts + (size_t)cell * 8)) return false;
    return has_own || empty || !of_cell;
}

static bool slrt_rows_are_sound(const sl_runtime *rt, uint64_t byte_count, bool of_cells) {
    uint64_t before = 0;
    uint32_t i;
    if (slrt_u64(rt->row_offsets) != 0) return false;
    for (i = 0; i < rt->cell_count; i++) {
        const uint64_t end = slrt_u64(rt->row_offsets + (size_t)i * 8 + 8);
        if (end < before || end > byte_count || (end != byte_count && i + 1 == rt->cell_count))
            return false;
        before = end;
        if (!slrt_row_is_sound(rt, i, of_cells)) return false;
    }
    return true;
}

/// Which parts of the cells each row reaches into, if the file tells. There are 64 parts at most.
static bool slrt_take_parts(sl_runtime *rt, const slrt_section *parts) {
    if (!parts->items || !rt->row_offsets) return true;
    rt->row_parts = parts->items;
    while ((rt->cell_count - 1) >> rt->part_shift > 63) rt->part_shift++;
    return parts->count == rt->cell_count;
}

/// The rows of view cells, to be read like rows of cells.
static sl_runtime slrt_view_rows(const sl_runtime *rt) {
    sl_runtime rows = *rt;
    rows.row_offsets = rt->view_offsets;
    rows.row_bytes = rt->view_bytes;
    rows.row_parts = NULL;
    return rows;
}

/// A node's parent comes after it, so every way up ends.
static bool slrt_view_nodes_are_sound(const sl_runtime *rt) {
    uint32_t i;
    for (i = 0; i < rt->cell_count; i++) {
        const uint32_t view = slrt_u32(rt->views + (size_t)i * 4);
        if (view != SL_RUNTIME_NO_CELL && view >= rt->view_cell_count) return false;
    }
    for (i = 0; i < rt->view_node_count; i++) {
        const uint32_t parent = slrt_u32(rt->view_parents + (size_t)i * 4);
        if (parent != SL_RUNTIME_NO_CELL && (parent <= i || parent >= rt->view_node_count))
            return false;
    }
    return true;
}

/// If cells have no rows, each view cell has all that it sees in one row, its own cells among it.
static bool slrt_stands_for_cells(const sl_runtime *rt) {
    uint32_t i;
    for (i = 0; i < rt->view_node_count; i++)
        if (slrt_u32(rt->view_parents + (size_t)i * 4) != SL_RUNTIME_NO_CELL) return false;
    for (i = 0; i < rt->cell_count; i++)
        if (slrt_u32(rt->views + (size_t)i * 4) != SL_RUNTIME_NO_CELL &&
            !sl_runtime_can_see(rt, i, i))
            return false;
    return true;
}

/// View cells, if the file has any.
static bool slrt_open_views(const slrt_section *found, sl_runtime *rt) {
    sl_runtime rows;
    int tag;
    if (!found[SLRT_VCIN].items) return true;
    for (tag = SLRT_VCIN; tag <= SLRT_VCRB; tag++)
        if (!found[tag].items) return false;
    if (found[SLRT_VCIN].count != 1) return false;
    rt->view_cell_count = slrt_u32(found[SLRT_VCIN].items);
    rt->view_node_count = slrt_u32(found[SLRT_VCIN].items + 4);
    if (found[SLRT_VCEL].count != rt->cell_count || found[SLRT_VCPA].count != rt->view_node_count ||
        found[SLRT_VCRO].count != (uint64_t)rt->cell_count + 1 ||
        rt->view_cell_count > rt->view_node_count || rt->view_node_count > rt->cell_count)
        return false;
    rt->views = found[SLRT_VCEL].items;
    rt->view_parents = found[SLRT_VCPA].items;
    rt->view_offsets = found[SLRT_VCRO].items;
    rt->view_bytes = found[SLRT_VCRB].items;
    rows = slrt_view_rows(rt);
    return slrt_view_nodes_are_sound(rt) &&
           slrt_rows_are_sound(&rows, found[SLRT_VCRB].count, false) &&
           (rt->row_offsets || slrt_stands_for_cells(rt));
}

/// An alternative of a pair: doors in ascending order.
static bool slrt_doors_are_sound(const sl_runtime *rt, const unsigned char **next,
                                 const unsigned char *stop) {
    const unsigned char *at = *next;
    uint64_t door = 0;
    uint32_t count, i;
    if (!slrt_pass_number(next, stop)) return false;
    count = slrt_number(&at);
    for (i = 0; i < count; i++) {
        if (!slrt_pass_number(next, stop)) return false;
        door += slrt_number(&at) + (uint64_t)(i > 0);
        if (door >= rt->door_count) return false;
    }
    return count > 0;
}

static bool slrt_door_row_is_sound(const sl_runtime *rt, uint32_t row) {
    const unsigned char *next = rt->door_bytes + slrt_u64(rt->door_offsets + (size_t)row * 8);
    const unsigned char *stop = rt->door_bytes + slrt_u64(rt->door_offsets + (size_t)row * 8 + 8);
    uint64_t cell = 0;
    bool first = true;
    for (; next < stop; first = false) {
        const unsigned char *at = next;
        uint32_t count, i;
        if (!slrt_pass_number(&next, stop) || !slrt_pass_number(&next, stop)) return false;
        cell += slrt_number(&at) + (uint64_t)!first;
        count = slrt_number(&at);
        if (cell >= rt->cell_count || !count) return false;
        for (i = 0; i < count; i++)
            if (!slrt_doors_are_sound(rt, &next, stop)) return false;
    }
    return true;
}

/// The portals on seams, by portal, so that they can be searched. There are as many doors as seams
/// name, or more.
static bool slrt_take_seams(sl_runtime *rt, const slrt_section *found) {
    const uint64_t count = found[SLRT_SEPO].items ? found[SLRT_SEPO].count : 0;
    uint64_t i;
    uint32_t before = 0;
    rt->seams = found[SLRT_SEAM].items;
    rt->seam_portals = found[SLRT_SEPO].items;
    if (found[SLRT_SEAM].count > UINT32_MAX) return false;
    if (rt->seams) rt->seam_count = (uint32_t)found[SLRT_SEAM].count;
    if (count > UINT32_MAX || (count && !rt->seams)) return false;
    for (i = 0; i < rt->seam_count; i++) {
        const unsigned char *seam = rt->seams + i * 40;
        const uint32_t number = slrt_u32(seam + 36);
        if (!slrt_usable(seam, 4)) return false;
        if (slrt_u32(seam + 32) != 1) continue;
        if (number >= INT32_MAX) return false;
        if (number >= rt->door_count) rt->door_count = number + 1;
    }
    rt->seam_portal_count = (uint32_t)count;
    for (i = 0; i < count; i++) {
        const unsigned char *on = rt->seam_portals + i * 12;
        const uint32_t portal = slrt_u32(on);
        if (portal < before || portal >= rt->portal_count) return false;
        if (slrt_u32(on + 4) >= found[SLRT_SEAM].count) return false;
        before = portal;
        rt->has_glass =
            rt->has_glass || slrt_u32(rt->seams + slrt_u32(on + 4) * (size_t)40 + 32) == 2;
    }
    return true;
}

static bool slrt_take_walls(sl_runtime *rt, const slrt_section *found) {
    uint32_t i;
    rt->walls = found[SLRT_WALL].items;
    if (found[SLRT_WALL].count > UINT32_MAX) return false;
    rt->wall_count = (uint32_t)found[SLRT_WALL].count;
    for (i = 0; i < rt->wall_count; i++)
        if (!slrt_usable(rt->walls + (size_t)i * 32, 4)) return false;
    return true;
}

/// The rows of door sets of `rt`, whose doors are counted.
static bool slrt_door_rows_are_sound(const sl_runtime *rt, const slrt_section *offsets,
                                     const slrt_section *bytes) {
    uint64_t i, before = 0;
    if (!rt->door_offsets && !rt->door_bytes) return true;
    if (!rt->door_offsets || !rt->door_bytes || offsets->count != (uint64_t)rt->cell_count + 1)
        return false;
    for (i = 0; i <= rt->cell_count; i++) {
        const uint64_t end = slrt_u64(rt->door_offsets + i * 8);
        if (end < before || end > bytes->count || (!i && end)) return false;
        before = end;
    }
    for (i = 0; i < rt->cell_count; i++)
        if (!slrt_door_row_is_sound(rt, (uint32_t)i)) return false;
    return true;
}

/// The doors are known.
static bool slrt_take_doors(sl_runtime *rt, const slrt_section *found) {
    rt->door_offsets = found[SLRT_DORO].items;
    rt->door_bytes = found[SLRT_DORB].items;
    return slrt_door_rows_are_sound(rt, &found[SLRT_DORO], &found[SLRT_DORB]);
}

/// What is seen by mirror, to be read like what is seen directly.
static sl_runtime slrt_mirrored(const sl_runtime *rt) {
    sl_runtime rows = *rt;
    rows.row_offsets = rt->mirror_offsets;
    rows.row_bytes = rt->mirror_bytes;
    rows.row_parts = NULL;
    rows.door_offsets = rt->mirror_door_offsets;
    rows.door_bytes = rt->mirror_door_bytes;
    return rows;
}

/// Rows of what is seen by mirror, if the file has any.
static bool slrt_take_mirrors(sl_runtime *rt, const slrt_section *found) {
    sl_runtime rows;
    rt->mirror_offsets = found[SLRT_MIRO].items;
    rt->mirror_bytes = found[SLRT_MIRB].items;
    rt->mirror_door_offsets = found[SLRT_MDOO].items;
    rt->mirror_door_bytes = found[SLRT_MDOB].items;
    if (!rt->mirror_offsets)
        return !rt->mirror_bytes && !rt->mirror_door_offsets && !rt->mirror_door_bytes;
    if (!rt->mirror_bytes || found[SLRT_MIRO].count != (uint64_t)rt->cell_count + 1) return false;
    rt->mirrors = SL_RUNTIME_MIRRORS_BAKED;
    rows = slrt_mirrored(rt);
    return slrt_rows_are_sound(&rows, found[SLRT_MIRB].count, false) &&
           slrt_door_rows_are_sound(&rows, &found[SLRT_MDOO], &found[SLRT_MDOB]);
}

// --- What is checked of the walls that do not stop all when a file is opened

static bool slrt_passage_is_sound(const sl_runtime *rt, const unsigned char *at) {
    const uint32_t stops = slrt_u32(at + 12);
    return slrt_u32(at) < rt->cell_count && slrt_u32(at + 8) < rt->cell_count &&
           (slrt_u32(at + 4) & INT32_MAX) < rt->wall_count && stops && stops < SL_RUNTIME_STOPS_ALL;
}

/// Whether some seam limits sight, in a file for sight.
static bool slrt_has_limits(const sl_runtime *rt) {
    uint32_t i;
    if (!rt->stops || !(rt->channel & SL_RUNTIME_STOPS_SIGHT)) return false;
    for (i = 0; i < rt->seam_count; i++)
        if (slrt_u32(rt->stops + (size_t)i * 4) & SL_RUNTIME_STOPS_LIMITED) return true;
    return false;
}

/// Passages go by cell, so that they can be searched.
static bool slrt_take_stops(sl_runtime *rt, const slrt_section *found) {
    uint32_t i;
    rt->stops = found[SLRT_STOP].items;
    rt->passages = found[SLRT_PASS].items;
    rt->passage_count = 0;
    rt->channel = SL_RUNTIME_STOPS_SIGHT;
    if (found[SLRT_CHAN].items) {
        rt->channel = found[SLRT_CHAN].count == 1 ? slrt_u32(found[SLRT_CHAN].items) : 0;
        if (!rt->channel || rt->channel > SL_RUNTIME_STOPS_ALL) return false;
    }
    if (rt->stops && found[SLRT_STOP].count != rt->seam_count) return false;
    rt->has_limits = slrt_has_limits(rt);
    if (!rt->passages) return true;
    if (!rt->walls || found[SLRT_PASS].count > UINT32_MAX) return false;
    rt->passage_count = (uint32_t)found[SLRT_PASS].count;
    for (i = 0; i < rt->passage_count; i++) {
        const unsigned char *at = rt->passages + (size_t)i * SLRT_PASSAGE_BYTES;
        if (!slrt_passage_is_sound(rt, at)) return false;
        if (i && slrt_u32(at) < slrt_u32(at - SLRT_PASSAGE_BYTES)) return false;
    }
    return true;
}

/// The map text of files before 2.0, which have doors and starts nowhere else: statements in lines,
/// words between blanks, comments after '#'. SL_RUNTIME_WITHOUT_OLD_FILES leaves this part out.

#ifndef SL_RUNTIME_WITHOUT_OLD_FILES

/// A place in the map text: the rest of a line, or of the text.
typedef struct slrt_text {
    const unsigned char *at, *end;
} slrt_text;

/// Takes the next line off a text; false at its end.
static bool slrt_take_line(slrt_text *text, slrt_text *line) {
    if (text->at == text->end) return false;
    line->at = line->end = text->at;
    while (line->end < text->end && *line->end != '\n') line->end++;
    text->at = line->end < text->end ? line->end + 1 : line->end;
    if (line->end > line->at && line->end[-1] == '\r') line->end--;
    return true;
}

/// Takes the next word off a line; it is empty at the line's end.
static slrt_text slrt_take_word(slrt_text *line) {
    slrt_text word;
    while (line->at < line->end && (*line->at == ' ' || *line->at == '\t')) line->at++;
    word.at = word.end = line->at;
    while (word.end < line->end && *word.end != ' ' && *word.end != '\t' && *word.end != '#')
        word.end++;
    line->at = word.end < line->end && *word.end == '#' ? line->end : word.end;
    return word;
}

static bool slrt_word_is(const slrt_text *word, const char *text) {
    const unsigned char *at = word->at;
    for (; at < word->end && *text && *at == (unsigned char)*text; at++) text++;
    return at == word->end && !*text;
}

/// What follows the first word of the `number`-th statement with this word, which exists.
static slrt_text slrt_find_statement(const sl_runtime *rt, const char *first, uint32_t number) {
    slrt_text text, line;
    text.at = line.at = line.end = rt->text;
    text.end = rt->text + rt->text_bytes;
    while (slrt_take_line(&text, &line)) {
        const slrt_text word = slrt_take_word(&line);
        if (slrt_word_is(&word, first) && !number--) break;
    }
    return line;
}

/// A decimal: digits, of which the last `fraction` are behind the point, and a power of ten.
typedef struct slrt_decimal {
    slrt_text digits; ///< among them the point
    uint32_t digit_count, fraction;
    int32_t exponent;
    bool negative;
} slrt_decimal;

/// Reads digits, which may have a point among them. Returns how many there are.
static uint32_t slrt_take_digits(slrt_text *word, uint32_t *fraction) {
    uint32_t count = 0;
    bool point = false;
    *fraction = 0;
    for (; word->at < word->end; word->at++) {
        if (*word->at == '.' && !point) {
            point = true;
            continue;
        }
        if (*word->at < '0' || *word->at > '9') break;
        count++;
        if (point) ++*fraction;
    }
    return count;
}

/// Splits a word into the parts of a decimal; false if it is none, or has 512 characters or
/// more, as no file has that `sightline bake` writes.
static bool slrt_parse_decimal(slrt_text word, slrt_decimal *out) {
    int32_t exponent = 0;
    bool down = false;
    memset(out, 0, sizeof *out);
    if (word.end - word.at >= 512) return false;
    if (word.at < word.end && (*word.at == '-' || *word.at == '+'))
        out->negative = *word.at++ == '-';
    out->digits.at = word.at;
    out->digit_count = slrt_take_digits(&word, &out->fraction);
    out->digits.end = word.at;
    if (!out->digit_count) return false;
    if (word.at == word.end) return true;
    if (*word.at != 'e' && *word.at != 'E') return false;
    word.at++;
    if (word.at < word.end && (*word.at == '-' || *word.at == '+')) down = *word.at++ == '-';
    if (word.at == word.end) return false;
    for (; word.at < word.end; word.at++) {
        if (*word.at < '0' || *word.at > '9') return false;
        if (exponent < 100000) exponent = 10 * exponent + (*word.at - '0');
    }
    out->exponent = down ? -exponent : exponent;
    return true;
}

/// A fixed-point number in words of 32 bits, least first. Half of the words are behind the point,
/// which is more than the smallest double needs.
enum { SLRT_FIXED_WORDS = 128, SLRT_FIXED_POINT = 64 };

/// Multiplies the words from `from` on by 10 and adds a digit there. False if the number becomes
/// too large.
static bool slrt_times_ten(uint32_t *fixed, uint32_t from, uint32_t digit) {
    uint64_t carry = digit;
    uint32_t i;
    for (i = from; i < SLRT_FIXED_WORDS; i++) {
        carry += (uint64_t)fixed[i] * 10;
        fixed[i] = (uint32_t)(carry & UINT32_MAX);
        carry >>= 32;
    }
    return !carry;
}

/// Divides by 10 to the `power`, at most 9, rounding down. Returns whether there was a remainder.
static bool slrt_over_tens(uint32_t *fixed, int32_t power) {
    uint64_t rest = 0, divisor = 1;
    uint32_t i = SLRT_FIXED_WORDS;
    for (; power; power--) divisor *= 10;
    while (i && !fixed[i - 1]) i--;
    while (i-- > 0) {
        rest = rest << 32 | fixed[i];
        fixed[i] = (uint32_t)(rest / divisor);
        rest %= divisor;
    }
    return rest != 0;
}

static bool slrt_bit(const uint32_t *fixed, int bit) {
    return fixed[bit / 32] >> bit % 32 & 1;
}

/// Rounds a fixed-point number to the nearest double, a tie to the even one. `rest`: a little is
/// missing. As bits; all ones in the exponent if it is too large.
static uint64_t slrt_round_fixed(const uint32_t *fixed, bool rest) {
    const int lowest = 32 * SLRT_FIXED_POINT - 1074; // the bit of the smallest double
    int top = 32 * SLRT_FIXED_WORDS - 1, low, i;
    uint64_t bits = 0;
    while (top >= 0 && !fixed[top / 32]) top -= 32;
    while (top >= 0 && !slrt_bit(fixed, top)) top--;
    low = top - 52 > lowest ? top - 52 : lowest;
    for (i = top; i >= low; i--) bits = bits << 1 | slrt_bit(fixed, i);
    for (i = 0; i < (low - 1) / 32 && !rest; i++) rest = fixed[i] != 0;
    if (fixed[i] & ((UINT32_C(1) << (low - 1) % 32) - 1)) rest = true;
    if (slrt_bit(fixed, low - 1) && (rest || (bits & 1))) bits++;
    // The leading bit adds 1 to the exponent, also where rounding carries into it.
    if (low - lowest > 2045) return UINT64_C(0x7ff) << 52;
    return bits + ((uint64_t)(low - lowest) << 52);
}

/// The nearest double; false if it is not finite. In integers alone, so no option for arithmetic
/// changes it. Below 1e-480 it is 0, as that is less than half the smallest double.
static bool slrt_decimal_value(const slrt_decimal *decimal, double *out) {
    uint32_t fixed[SLRT_FIXED_WORDS];
    int32_t power = decimal->exponent - (int32_t)decimal->fraction;
    const unsigned char *at;
    uint64_t bits;
    bool rest = false, any = false;
    memset(fixed, 0, sizeof fixed);
    for (at = decimal->digits.at; at < decimal->digits.end; at++) {
        if (*at == '.') continue;
        any = any || *at != '0';
        if (!slrt_times_ten(fixed, SLRT_FIXED_POINT, (uint32_t)*at - '0')) return false;
    }
    if (!any || power < -1000) {
        memset(fixed, 0, sizeof fixed);
        power = 0;
    }
    for (; power > 0; power--)
        if (!slrt_times_ten(fixed, SLRT_FIXED_POINT, 0)) return false;
    for (; power < -9; power += 9) rest = slrt_over_tens(fixed, 9) || rest;
    if (power < 0) rest = slrt_over_tens(fixed, -power) || rest;
    bits = slrt_round_fixed(fixed, rest);
    if (bits >> 52 == 0x7ff) return false;
    bits |= (uint64_t)decimal->negative << 63;
    memcpy(out, &bits, sizeof *out);
    return true;
}

/// Reads the next word of a line as a number. Coordinates are in the range of
/// slrt_is_coordinate.
static bool slrt_take_number(slrt_text *line, bool coordinate, double *out) {
    slrt_decimal decimal;
    if (!slrt_parse_decimal(slrt_take_word(line), &decimal) || !slrt_decimal_value(&decimal, out))
        return false;
    return !coordinate || slrt_is_coordinate(*out);
}

static bool slrt_read_start(slrt_text line, sl_runtime_viewpoint *out) {
    return slrt_take_number(&line, true, &out->x) && slrt_take_number(&line, true, &out->y) &&
           slrt_take_number(&line, false, &out->heading);
}

/// Each door that a seam is of has a name, each start three numbers, and a range one above 0.
static bool slrt_take_text(sl_runtime *rt, const slrt_section *section) {
    const uint32_t seam_doors = rt->door_count;
    slrt_text text, line;
    rt->door_count = 0;
    rt->text = section->items ? section->items : (const unsigned char *)"";
    rt->text_bytes = (size_t)section->count;
    text.at = rt->text;
    text.end = rt->text + rt->text_bytes;
    while (slrt_take_line(&text, &line)) {
        const slrt_text first = slrt_take_word(&line);
        sl_runtime_viewpoint start;
        if (slrt_word_is(&first, "range") &&
            (!slrt_take_number(&line, false, &rt->range) || !(rt->range > 0)))
            return false;
        if (slrt_word_is(&first, "start")) {
            if (!slrt_read_start(line, &start)) return false;
            rt->start_count++;
        }
        if (slrt_word_is(&first, "door")) {
            const slrt_text name = slrt_take_word(&line);
            if (name.at == name.end || name.end - name.at > INT32_MAX) return false;
            if (rt->door_count++ == INT32_MAX) return false;
        }
        if (slrt_word_is(&first, "mirror")) rt->mirrors = SL_RUNTIME_MIRRORS_NOT_BAKED;
    }
    return rt->door_count >= seam_doors;
}

/// A door of the text: its name, and whether it is open.
static sl_runtime_name slrt_text_door(const sl_runtime *rt, uint32_t door, bool *open) {
    sl_runtime_name name;
    slrt_text line = slrt_find_statement(rt, "door", door), word = slrt_take_word(&line);
    int i;
    name.text = (const char *)word.at;
    name.length = (uint32_t)(word.end - word.at);
    for (i = 0; i < 5; i++) word = slrt_take_word(&line); // four coordinates, and the state
    *open = !slrt_word_is(&word, "shut");
    return name;
}

static bool slrt_text_start(const sl_runtime *rt, uint32_t start, sl_runtime_viewpoint *out) {
    return slrt_read_start(slrt_find_statement(rt, "start", start), out);
}

#endif

/// What is checked of the map's things when a file is opened: doors, starts, objects, paths,
/// mirrors.

/// As bits, which no fast-math option changes.
static bool slrt_is_finite(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return (bits >> 52 & 0x7ff) != 0x7ff;
}

/// The items of a section: at most INT32_MAX, each of them, if it is `named`, begins with a name
/// that is not empty, in the section of names; then come `numbers` coordinates.
static bool slrt_items_are_sound(const slrt_section *found, int tag, uint32_t item_bytes,
                                 bool named, int numbers) {
    const unsigned char *item = found[tag].items;
    const uint64_t count = found[tag].count, names = found[SLRT_MAPN].count;
    uint64_t i;
    for (i = 0; i < count; i++, item += item_bytes) {
        if (named && (!slrt_u32(item + 4) || slrt_u32(item) > names ||
                      slrt_u32(item + 4) > names - slrt_u32(item)))
            return false;
        if (!slrt_usable(item + (named ? 8 : 0), numbers)) return false;
    }
    return count <= INT32_MAX;
}

static bool slrt_take_map_info(sl_runtime *rt, const slrt_section *section) {
    const unsigned char *info = section->items;
    double scale;
    if (section->count != 1 || !slrt_usable(info + 8, 3) || slrt_u64(info + 32) > 1) return false;
    rt->range = slrt_f64(info);
    rt->transform.origin_x = slrt_f64(info + 8);
    rt->transform.origin_y = slrt_f64(info + 16);
    rt->transform.scale = scale = slrt_f64(info + 24);
    rt->transform.y_down = slrt_u64(info + 32) != 0;
    return slrt_is_finite(rt->range) && rt->range >= 0 && (scale == 0 || scale >= 1e-150);
}

/// The map's things in a file that has them in sections.
static bool slrt_take_things(sl_runtime *rt, const slrt_section *found) {
    uint32_t i;
    if (!slrt_take_map_info(rt, &found[SLRT_MAPI]) || found[SLRT_DOOR].count < rt->door_count ||
        !slrt_items_are_sound(found, SLRT_DOOR, SLRT_DOOR_BYTES, true, 0) ||
        !slrt_items_are_sound(found, SLRT_STRT, SLRT_START_BYTES, false, 2) ||
        !slrt_items_are_sound(found, SLRT_OBJE, SLRT_OBJECT_BYTES, true, 4) ||
        !slrt_items_are_sound(found, SLRT_PATH, SLRT_PATH_BYTES, true, 0) ||
        !slrt_items_are_sound(found, SLRT_PAPO, SLRT_VERTEX_BYTES, false, 2) ||
        !slrt_items_are_sound(found, SLRT_MIRR, SLRT_MIRROR_BYTES, false, 4))
        return false;
    rt->names = found[SLRT_MAPN].items;
    rt->doors = found[SLRT_DOOR].items;
    rt->door_count = (uint32_t)found[SLRT_DOOR].count;
    rt->starts = found[SLRT_STRT].items;
    rt->start_count = (uint32_t)found[SLRT_STRT].count;
    rt->objects = found[SLRT_OBJE].items;
    rt->object_count = (uint32_t)found[SLRT_OBJE].count;
    rt->paths = found[SLRT_PATH].items;
    rt->path_count = (uint32_t)found[SLRT_PATH].count;
    rt->path_points = found[SLRT_PAPO].items;
    rt->mirror_lines = found[SLRT_MIRR].items;
    rt->mirror_count = (uint32_t)found[SLRT_MIRR].count;
    if (rt->mirror_count) rt->mirrors = SL_RUNTIME_MIRRORS_NOT_BAKED;
    for (i = 0; i < rt->start_count; i++)
        if (!slrt_is_finite(slrt_f64(rt->starts + (size_t)i * SLRT_START_BYTES + 16))) return false;
    for (i = 0; i < rt->path_count; i++) {
        const unsigned char *path = rt->paths + (size_t)i * SLRT_PATH_BYTES;
        if ((uint64_t)slrt_u32(path + 8) + slrt_u32(path + 12) > found[SLRT_PAPO].count)
            return false;
    }
    return true;
}

/// What the map holds beside walls. Files before 2.0 have it as text alone.
static sl_runtime_status slrt_take_map(sl_runtime *rt, const slrt_section *found) {
    if (!found[SLRT_MAPI].items)
#ifdef SL_RUNTIME_WITHOUT_OLD_FILES
        return SL_RUNTIME_OLD;
#else
        return slrt_take_text(rt, &found[SLRT_MAPT]) ? SL_RUNTIME_OK : SL_RUNTIME_TEXT;
#endif
    return slrt_take_things(rt, found) ? SL_RUNTIME_OK : SL_RUNTIME_TEXT;
}

// --- Opening a file

SL_RUNTIME_API sl_runtime_status sl_runtime_open(const void *bytes, size_t size, sl_runtime *out) {
    const unsigned char *file = (const unsigned char *)bytes;
    slrt_section found[SLRT_TAGS];
    sl_runtime rt;
    sl_runtime_status status = slrt_check_header(file, size);
    if (status != SL_RUNTIME_OK) return status;
    memset(found, 0, sizeof found);
    memset(&rt, 0, sizeof rt);
    status = slrt_find_sections(file, size, found);
    if (status == SL_RUNTIME_OK) status = slrt_check_sizes(found, &rt);
    if (status != SL_RUNTIME_OK) return status;
    if (!slrt_take_location(&rt, found, slrt_u32(file + 8)) || !slrt_cells_are_sound(&rt))
        return SL_RUNTIME_SPACE;
    if (!slrt_take_seams(&rt, found) || !slrt_take_walls(&rt, found)) return SL_RUNTIME_SPACE;
    if (!slrt_take_stops(&rt, found)) return SL_RUNTIME_SPACE;
    status = slrt_take_map(&rt, found);
    if (status != SL_RUNTIME_OK) return status;
    if (!slrt_take_doors(&rt, found) || !slrt_take_mirrors(&rt, found)) return SL_RUNTIME_ROW;
    if (!slrt_take_parts(&rt, &found[SLRT_PVSP])) return SL_RUNTIME_ROW;
    if (rt.row_offsets && !slrt_rows_are_sound(&rt, found[SLRT_PVSB].count, true))
        return SL_RUNTIME_ROW;
    if (!slrt_open_views(found, &rt)) return SL_RUNTIME_ROW;
    *out = rt;
    return SL_RUNTIME_OK;
}

SL_RUNTIME_API const char *sl_runtime_status_text(sl_runtime_status status) {
    switch (status) {
    case SL_RUNTIME_OK:
        return "no fault";
    case SL_RUNTIME_NOT_BAKED:
        return "not a baked file (.slv)";
    case SL_RUNTIME_BYTE_ORDER:
        return "its byte order is not that of baked files: bake the map again";
    case SL_RUNTIME_VERSION:
        return "of another version of the baked format";
    case SL_RUNTIME_SIZE:
        return "cut short, or longer than it says";
    case SL_RUNTIME_CHECKSUM:
        return "damaged: the checksum does not match";
    case SL_RUNTIME_SECTION:
        return "damaged: a section is missing, there twice, or does not fit";
    case SL_RUNTIME_SPACE:
        return "damaged: a number of the bounds, tree, grid, cells or portals is out of range";
    case SL_RUNTIME_ROW:
        return "damaged: a row of the visible sets";
    case SL_RUNTIME_SHARD:
        return "one shard of a bake, not all of it: sightline merge puts shards together";
    case SL_RUNTIME_TEXT:
        return "damaged: a door, a start or another thing of the map";
    case SL_RUNTIME_OLD:
        return "made before 2.0, and this program leaves that out: bake the map again";
    }
    return "unknown status";
}

#ifdef SL_RUNTIME_SMALL_OPEN
#pragma clang attribute pop
#endif

// --- Cells, directed portals and vertices, as they stand in the file

SL_RUNTIME_API sl_runtime_cell sl_runtime_get_cell(const sl_runtime *runtime, uint32_t cell) {
    sl_runtime_cell out;
    const unsigned char *at = runtime->cells + (size_t)cell * SLRT_CELL_BYTES;
#ifdef SLRT_BIG_ENDIAN
    out.first_vertex = slrt_u32(at);
    out.vertex_count = slrt_u32(at + 4);
    out.first_directed = slrt_u32(at + 8);
    out.directed_count = slrt_u32(at + 12);
#else
    memcpy(&out, at, sizeof out);
#endif
    return out;
}

SL_RUNTIME_API sl_runtime_directed_portal sl_runtime_get_directed_portal(const sl_runtime *runtime,
                                                                         uint32_t directed) {
    sl_runtime_directed_portal out;
    const unsigned char *at = runtime->directed + (size_t)directed * SLRT_DIRECTED_BYTES;
#ifdef SLRT_BIG_ENDIAN
    out.portal = slrt_u32(at);
    out.cell = slrt_u32(at + 4);
    out.left[0] = slrt_f64(at + 8);
    out.left[1] = slrt_f64(at + 16);
    out.right[0] = slrt_f64(at + 24);
    out.right[1] = slrt_f64(at + 32);
#else
    memcpy(&out, at, sizeof out);
#endif
    return out;
}

SL_RUNTIME_API void sl_runtime_get_vertex(const sl_runtime *runtime, uint32_t vertex, double *x,
                                          double *y) {
    const unsigned char *at = runtime->vertices + (size_t)vertex * SLRT_VERTEX_BYTES;
    *x = slrt_f64(at);
    *y = slrt_f64(at + 8);
}

// --- The map's things: doors, starts, objects, paths and mirrors

/// The name that a door, an object or a path begins with.
static sl_runtime_name slrt_name(const sl_runtime *rt, const unsigned char *item) {
    sl_runtime_name name;
    name.text = (const char *)rt->names + slrt_u32(item);
    name.length = slrt_u32(item + 4);
    return name;
}

static sl_runtime_segment slrt_segment(const unsigned char *at) {
    sl_runtime_segment segment;
    segment.x0 = slrt_f64(at);
    segment.y0 = slrt_f64(at + 8);
    segment.x1 = slrt_f64(at + 16);
    segment.y1 = slrt_f64(at + 24);
    return segment;
}

static sl_runtime_name slrt_door(const sl_runtime *rt, uint32_t door, bool *open) {
    const unsigned char *item;
#ifndef SL_RUNTIME_WITHOUT_OLD_FILES
    if (rt->text) return slrt_text_door(rt, door, open);
#endif
    item = rt->doors + (size_t)door * SLRT_DOOR_BYTES;
    *open = slrt_u32(item + 8) & 1;
    return slrt_name(rt, item);
}

SL_RUNTIME_API sl_runtime_name sl_runtime_door_name(const sl_runtime *runtime, uint32_t door) {
    sl_runtime_name none;
    bool open;
    none.text = "";
    none.length = 0;
    return door < runtime->door_count ? slrt_door(runtime, door, &open) : none;
}

SL_RUNTIME_API uint32_t sl_runtime_find_door(const sl_runtime *runtime, const char *name) {
    uint32_t door, i;
    for (door = 0; door < runtime->door_count; door++) {
        const sl_runtime_name own = sl_runtime_door_name(runtime, door);
        for (i = 0; i < own.length && name[i] && name[i] == own.text[i];) i++;
        if (i == own.length && !name[i]) return door;
    }
    return SL_RUNTIME_NO_DOOR;
}

SL_RUNTIME_API bool sl_runtime_door_open(const sl_runtime *runtime, uint32_t door) {
    bool open = false;
    if (door < runtime->door_count) slrt_door(runtime, door, &open);
    return open;
}

SL_RUNTIME_API sl_runtime_door_kind sl_runtime_get_door_kind(const sl_runtime *runtime,
                                                             uint32_t door) {
    uint32_t bits;
    if (door >= runtime->door_count || !runtime->doors) return SL_RUNTIME_DOOR;
    bits = slrt_u32(runtime->doors + (size_t)door * SLRT_DOOR_BYTES + 8);
    return bits & 2 ? SL_RUNTIME_BREAKABLE : bits & 4 ? SL_RUNTIME_SITE : SL_RUNTIME_DOOR;
}

SL_RUNTIME_API uint32_t sl_runtime_door_segments(const sl_runtime *runtime, uint32_t door,
                                                 sl_runtime_segment *segments, uint32_t room) {
    uint32_t i, count = 0;
    for (i = 0; i < runtime->seam_count; i++) {
        const unsigned char *seam = runtime->seams + (size_t)i * 40;
        if (slrt_u32(seam + 32) != 1 || slrt_u32(seam + 36) != door) continue;
        if (count < room) segments[count] = slrt_segment(seam);
        count++;
    }
    return count;
}

SL_RUNTIME_API bool sl_runtime_wall(const sl_runtime *runtime, uint32_t wall,
                                    sl_runtime_segment *out) {
    if (!runtime->walls || wall >= runtime->wall_count) return false;
    *out = slrt_segment(runtime->walls + (size_t)wall * 32);
    return true;
}

SL_RUNTIME_API uint32_t sl_runtime_start_count(const sl_runtime *runtime) {
    return runtime->start_count;
}

SL_RUNTIME_API bool sl_runtime_start(const sl_runtime *runtime, uint32_t start,
                                     sl_runtime_viewpoint *out) {
    const unsigned char *item;
    if (start >= runtime->start_count) return false;
#ifndef SL_RUNTIME_WITHOUT_OLD_FILES
    if (runtime->text) return slrt_text_start(runtime, start, out);
#endif
    item = runtime->starts + (size_t)start * SLRT_START_BYTES;
    out->x = slrt_f64(item);
    out->y = slrt_f64(item + 8);
    out->heading = slrt_f64(item + 16);
    return true;
}

SL_RUNTIME_API bool sl_runtime_object(const sl_runtime *runtime, uint32_t object,
                                      sl_runtime_name *name, sl_runtime_segment *box) {
    const unsigned char *item;
    if (object >= runtime->object_count) return false;
    item = runtime->objects + (size_t)object * SLRT_OBJECT_BYTES;
    *name = slrt_name(runtime, item);
    *box = slrt_segment(item + 8);
    return true;
}

SL_RUNTIME_API bool sl_runtime_path(const sl_runtime *runtime, uint32_t path, sl_runtime_name *name,
                                    uint32_t *point_count) {
    const unsigned char *item;
    if (path >= runtime->path_count) return false;
    item = runtime->paths + (size_t)path * SLRT_PATH_BYTES;
    *name = slrt_name(runtime, item);
    *point_count = slrt_u32(item + 12);
    return true;
}

SL_RUNTIME_API void sl_runtime_path_points(const sl_runtime *runtime, uint32_t path,
                                           double *points) {
    const unsigned char *item, *at;
    uint32_t i;
    if (path >= runtime->path_count) return;
    item = runtime->paths + (size_t)path * SLRT_PATH_BYTES;
    at = runtime->path_points + (size_t)slrt_u32(item + 8) * SLRT_VERTEX_BYTES;
    for (i = 0; i < 2 * slrt_u32(item + 12); i++) points[i] = slrt_f64(at + (size_t)i * 8);
}

SL_RUNTIME_API bool sl_runtime_mirror(const sl_runtime *runtime, uint32_t mirror,
                                      sl_runtime_segment *segment, bool *one_sided) {
    const unsigned char *item;
    if (mirror >= runtime->mirror_count) return false;
    item = runtime->mirror_lines + (size_t)mirror * SLRT_MIRROR_BYTES;
    *segment = slrt_segment(item);
    *one_sided = slrt_u64(item + 32) != 0;
    return true;
}

// --- Points of a map in other coordinates, such as those of a screen with y down

SL_RUNTIME_API bool sl_runtime_map_transform(const sl_runtime *runtime, sl_runtime_transform *out) {
    *out = runtime->transform;
    if (out->scale > 0) return true;
    out->scale = 1;
    return false;
}

SL_RUNTIME_API void sl_runtime_to_map(const sl_runtime_transform *transform, double *points,
                                      uint32_t count) {
    uint32_t i;
    for (i = 0; i < count; i++, points += 2) {
        const double y = points[1] / transform->scale;
        points[0] = transform->origin_x + points[0] / transform->scale;
        points[1] = transform->y_down ? transform->origin_y - y : transform->origin_y + y;
    }
}

SL_RUNTIME_API void sl_runtime_from_map(const sl_runtime_transform *transform, double *points,
                                        uint32_t count) {
    uint32_t i;
    for (i = 0; i < count; i++, points += 2) {
        points[0] = transform->scale * (points[0] - transform->origin_x);
        points[1] = transform->scale * (transform->y_down ? transform->origin_y - points[1]
                                                          : points[1] - transform->origin_y);
    }
}

// --- Rows: which cells see which, with doors as they stand, by mirror, and from view cells

SL_RUNTIME_API sl_runtime_run sl_runtime_row(const sl_runtime *runtime, uint32_t cell) {
    sl_runtime_run run;
    run.first = run.end = 0;
    run.next = run.stop = NULL;
    if (cell < runtime->cell_count) {
        const bool own = runtime->row_offsets != NULL;
        const unsigned char *offsets = own ? runtime->row_offsets : runtime->view_offsets;
        const unsigned char *bytes = own ? runtime->row_bytes : runtime->view_bytes;
        const uint32_t row = own ? cell : slrt_u32(runtime->views + (size_t)cell * 4);
        if (row == SL_RUNTIME_NO_CELL) return run;
        run.next = bytes + slrt_u64(offsets + (size_t)row * 8);
        run.stop = bytes + slrt_u64(offsets + (size_t)row * 8 + 8);
    }
    return run;
}

SL_RUNTIME_API bool sl_runtime_next(sl_runtime_run *run) {
    if (run->next == run->stop) return false;
    run->first = run->end + slrt_number(&run->next);
    run->end = run->first + slrt_number(&run->next);
    return true;
}

/// Whether the row of a cell reaches into the part of the cells that another one is in. Most rows
/// do not, and are not read.
static bool slrt_may_see(const sl_runtime *rt, uint32_t from, uint32_t to) {
    if (!rt->row_parts) return true;
    return from < rt->cell_count && to < rt->cell_count &&
           (slrt_u64(rt->row_parts + (size_t)from * 8) >> (to >> rt->part_shift) & 1) != 0;
}

SL_RUNTIME_API bool sl_runtime_can_see(const sl_runtime *runtime, uint32_t from, uint32_t to) {
    sl_runtime_run run;
    if (!slrt_may_see(runtime, from, to)) return false;
    run = sl_runtime_row(runtime, from);
    while (sl_runtime_next(&run))
        if (to < run.end) return to >= run.first;
    return false;
}

/// Reads the alternatives of a pair. Whether one of them has no shut door.
static bool slrt_is_open(const unsigned char **next, const unsigned char *shut) {
    uint32_t alternatives = slrt_number(next);
    bool any = false;
    for (; alternatives; alternatives--) {
        uint32_t doors = slrt_number(next), door = UINT32_MAX;
        bool open = true;
        for (; doors; doors--) {
            door += 1 + slrt_number(next);
            open = open && !shut[door];
        }
        any = any || open;
    }
    return any;
}

/// The pairs of a cell that depend on doors, by the second cell, ascending.
typedef struct slrt_door_pairs {
    const unsigned char *next, *stop;
    uint32_t cell; ///< of the last pair that was read
    bool open;     ///< whether that pair is seen
} slrt_door_pairs;

static slrt_door_pairs slrt_door_pairs_of(const sl_runtime *rt, uint32_t from) {
    slrt_door_pairs pairs;
    pairs.next = pairs.stop = NULL;
    pairs.cell = UINT32_MAX;
    pairs.open = true;
    if (rt->door_offsets) {
        pairs.next = rt->door_bytes + slrt_u64(rt->door_offsets + (size_t)from * 8);
        pairs.stop = rt->door_bytes + slrt_u64(rt->door_offsets + (size_t)from * 8 + 8);
    }
    return pairs;
}

/// Whether a pair of the row is seen. The second cell never goes down from one call to the next.
static bool slrt_pair_is_open(slrt_door_pairs *pairs, uint32_t to, const unsigned char *shut) {
    while ((pairs->cell == UINT32_MAX || pairs->cell < to) && pairs->next != pairs->stop) {
        pairs->cell += 1 + slrt_number(&pairs->next);
        pairs->open = slrt_is_open(&pairs->next, shut);
    }
    return pairs->cell != to || pairs->open;
}

SL_RUNTIME_API bool sl_runtime_can_see_past(const sl_runtime *runtime, uint32_t from, uint32_t to,
                                            const unsigned char *shut) {
    slrt_door_pairs pairs;
    if (!sl_runtime_can_see(runtime, from, to)) return false;
    if (!shut) return true;
    pairs = slrt_door_pairs_of(runtime, from);
    return slrt_pair_is_open(&pairs, to, shut);
}

SL_RUNTIME_API bool sl_runtime_has_row(const sl_runtime *runtime, uint32_t cell) {
    const sl_runtime_run run = sl_runtime_row(runtime, cell);
    return run.next != run.stop;
}

SL_RUNTIME_API bool sl_runtime_is_inside(const sl_runtime *runtime, uint32_t cell) {
    return cell < runtime->cell_count &&
           slrt_u32(runtime->cells + (size_t)cell * SLRT_CELL_BYTES + 16) != 0;
}

SL_RUNTIME_API bool sl_runtime_is_solid(const sl_runtime *runtime, uint32_t cell) {
    return cell < runtime->cell_count &&
           slrt_u32(runtime->cells + (size_t)cell * SLRT_CELL_BYTES + 20) != 0;
}

SL_RUNTIME_API uint32_t sl_runtime_row_count(const sl_runtime *runtime, uint32_t cell) {
    sl_runtime_run run = sl_runtime_row(runtime, cell);
    uint32_t count = 0;
    while (sl_runtime_next(&run)) count += run.end - run.first;
    return count;
}

/// Adds a row to bits.
static void slrt_unpack(const sl_runtime *rows, uint32_t row, unsigned char *bits) {
    sl_runtime_run run = sl_runtime_row(rows, row);
    uint32_t i;
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++) bits[i / 8] |= (unsigned char)(1 << i % 8);
}

SL_RUNTIME_API void sl_runtime_row_bits(const sl_runtime *runtime, uint32_t cell,
                                        unsigned char *bits) {
    memset(bits, 0, ((size_t)runtime->cell_count + 7) / 8);
    slrt_unpack(runtime, cell, bits);
}

/// Adds the row of a cell. Returns how many cells are new.
static uint32_t slrt_add_row(const sl_runtime *rt, uint32_t from, const unsigned char *shut,
                             unsigned char *bits) {
    sl_runtime_run run = sl_runtime_row(rt, from);
    slrt_door_pairs pairs;
    uint32_t added = 0, i;
    if (run.next == run.stop) return 0;
    pairs = slrt_door_pairs_of(rt, from);
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++) {
            if (bits[i / 8] >> i % 8 & 1) continue;
            if (shut && !slrt_pair_is_open(&pairs, i, shut)) continue;
            bits[i / 8] |= (unsigned char)(1 << i % 8);
            added++;
        }
    return added;
}

SL_RUNTIME_API uint32_t sl_runtime_seen_from(const sl_runtime *runtime, const uint32_t *cells,
                                             uint32_t count, const unsigned char *shut,
                                             unsigned char *bits) {
    uint32_t i, seen = 0;
    memset(bits, 0, ((size_t)runtime->cell_count + 7) / 8);
    for (i = 0; i < count; i++) seen += slrt_add_row(runtime, cells[i], shut, bits);
    return seen;
}

// --- what is seen by mirror

SL_RUNTIME_API sl_runtime_run sl_runtime_mirrored_row(const sl_runtime *runtime, uint32_t cell) {
    const sl_runtime rows = slrt_mirrored(runtime);
    return sl_runtime_row(&rows, rows.row_offsets ? cell : SL_RUNTIME_NO_CELL);
}

SL_RUNTIME_API bool sl_runtime_can_see_mirrored(const sl_runtime *runtime, uint32_t from,
                                                uint32_t to, const unsigned char *shut) {
    sl_runtime rows;
    if (runtime->mirrors == SL_RUNTIME_MIRRORS_NOT_BAKED)
        return from < runtime->cell_count && to < runtime->cell_count;
    if (sl_runtime_can_see_past(runtime, from, to, shut)) return true;
    if (!runtime->mirrors) return false;
    rows = slrt_mirrored(runtime);
    return sl_runtime_can_see_past(&rows, from, to, shut);
}

SL_RUNTIME_API uint32_t sl_runtime_seen_from_mirrored(const sl_runtime *runtime,
                                                      const uint32_t *cells, uint32_t count,
                                                      const unsigned char *shut,
                                                      unsigned char *bits) {
    const sl_runtime rows = slrt_mirrored(runtime);
    uint32_t i, seen = 0;
    memset(bits, 0, ((size_t)runtime->cell_count + 7) / 8);
    if (runtime->mirrors == SL_RUNTIME_MIRRORS_NOT_BAKED && count) {
        for (i = 0; i < runtime->cell_count; i++) bits[i / 8] |= (unsigned char)(1 << i % 8);
        return runtime->cell_count;
    }
    for (i = 0; i < count; i++) {
        seen += slrt_add_row(runtime, cells[i], shut, bits);
        if (rows.row_offsets) seen += slrt_add_row(&rows, cells[i], shut, bits);
    }
    return seen;
}

// --- view cells

SL_RUNTIME_API uint32_t sl_runtime_view_cell(const sl_runtime *runtime, uint32_t cell) {
    if (!runtime->view_cell_count || cell >= runtime->cell_count) return SL_RUNTIME_NO_CELL;
    return slrt_u32(runtime->views + (size_t)cell * 4);
}

SL_RUNTIME_API bool sl_runtime_view_can_see(const sl_runtime *runtime, uint32_t view_cell,
                                            uint32_t to) {
    uint32_t node = view_cell < runtime->view_cell_count ? view_cell : SL_RUNTIME_NO_CELL;
    const sl_runtime rows = slrt_view_rows(runtime);
    while (node != SL_RUNTIME_NO_CELL) {
        if (sl_runtime_can_see(&rows, node, to)) return true;
        node = slrt_u32(runtime->view_parents + (size_t)node * 4);
    }
    return false;
}

SL_RUNTIME_API void sl_runtime_view_bits(const sl_runtime *runtime, uint32_t view_cell,
                                         unsigned char *bits) {
    uint32_t node = view_cell < runtime->view_cell_count ? view_cell : SL_RUNTIME_NO_CELL;
    const sl_runtime rows = slrt_view_rows(runtime);
    memset(bits, 0, ((size_t)runtime->cell_count + 7) / 8);
    while (node != SL_RUNTIME_NO_CELL) {
        slrt_unpack(&rows, node, bits);
        node = slrt_u32(runtime->view_parents + (size_t)node * 4);
    }
}

// --- Numbers as sums of two doubles: for lines that meet at a sharp angle

// The header and the library have this part in common. Products of halves of numbers are exact, so
// that it does not matter which steps a compiler fuses.

/// The number high + low.
typedef struct slrt_pair {
    double high, low;
} slrt_pair;

/// The upper half of a number's bits, rounded. The rest has no more bits than that.
static double slrt_upper(double number) {
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    bits = (bits + (UINT64_C(1) << 26)) & ~((UINT64_C(1) << 27) - 1);
    memcpy(&number, &bits, sizeof number);
    return number;
}

/// The sum of a number and a smaller one: exact.
static slrt_pair slrt_quick_sum(double a, double b) {
    slrt_pair sum;
    sum.high = a + b;
    sum.low = b - (sum.high - a);
    return sum;
}

/// Exact (Shewchuk 1997, theorem 7).
static slrt_pair slrt_difference(double a, double b) {
    slrt_pair difference;
    double part;
    difference.high = a - b;
    part = a - difference.high;
    difference.low = (a - (difference.high + part)) + (part - b);
    return difference;
}

/// Good to about 2^-104 of it.
static slrt_pair slrt_product(slrt_pair a, slrt_pair b) {
    const double a_upper = slrt_upper(a.high), a_lower = a.high - a_upper;
    const double b_upper = slrt_upper(b.high), b_lower = b.high - b_upper;
    const double middle = a_upper * b_lower + a_lower * b_upper; // exact
    const slrt_pair sum = slrt_quick_sum(a_upper * b_upper, middle);
    const double rest = a_lower * b_lower + (a.high * b.low + a.low * b.high);
    return slrt_quick_sum(sum.high, sum.low + rest);
}

/// The cross product (u_x, u_y) x (v_x, v_y), off by no more than a unit in the last place and
/// 2^-100 of the two products.
static double slrt_cross(slrt_pair u_x, slrt_pair u_y, slrt_pair v_x, slrt_pair v_y) {
    const slrt_pair left = slrt_product(u_x, v_y), right = slrt_product(u_y, v_x);
    const slrt_pair sum = slrt_difference(left.high, right.high);
    return sum.high + (sum.low + (left.low - right.low));
}

// --- Signs of determinants: exact

/// A vector between two points: rounded, and the two points.
typedef struct slrt_arm {
    double x, y;
    double to_x, to_y, from_x, from_y;
} slrt_arm;

static slrt_arm slrt_make_arm(double from_x, double from_y, double to_x, double to_y) {
    slrt_arm arm;
    arm.x = to_x - from_x;
    arm.y = to_y - from_y;
    arm.to_x = to_x;
    arm.to_y = to_y;
    arm.from_x = from_x;
    arm.from_y = from_y;
    return arm;
}

/// Adds a number to an exact sum of parts that do not overlap, least first (Shewchuk 1997,
/// Grow-Expansion with zero elimination). Returns the new number of parts.
static int slrt_add(double *parts, int count, double number) {
    int i, kept = 0;
    for (i = 0; i < count; i++) {
        const double sum = number + parts[i], added = sum - number;
        const double lost = (number - (sum - added)) + (parts[i] - added);
        if (lost != 0) parts[kept++] = lost;
        number = sum;
    }
    if (number != 0) parts[kept++] = number;
    return kept;
}

/// Adds a product as two parts (Dekker's). Numbers are cut by their bits, so each step is exact,
/// also where a compiler fuses it with the next one.
static int slrt_add_product(double *parts, int count, double a, double b) {
    const double product = a * b;
    const double a_upper = slrt_upper(a), a_lower = a - a_upper;
    const double b_upper = slrt_upper(b), b_lower = b - b_upper;
    const double lost = a_lower * b_lower -
                        (((product - a_upper * b_upper) - a_lower * b_upper) - a_upper * b_lower);
    return slrt_add(parts, slrt_add(parts, count, lost), product);
}

static double slrt_larger(double a, double b) {
    if (a < 0) a = -a;
    if (b < 0) b = -b;
    return a > b ? a : b;
}

/// The points of an arm, scaled so that no product comes near underflow.
static void slrt_scaled(const slrt_arm *arm, double *to_x, double *to_y, double *from_x,
                        double *from_y) {
    const double largest =
        slrt_larger(slrt_larger(arm->to_x, arm->to_y), slrt_larger(arm->from_x, arm->from_y));
    const double scale = largest < 1e50 ? 8.749002899132048e+99 : 1; // 2^332
    *to_x = scale * arm->to_x;
    *to_y = scale * arm->to_y;
    *from_x = scale * arm->from_x;
    *from_y = scale * arm->from_y;
}

/// As slrt_side, without rounding.
static int slrt_side_exact(const slrt_arm *u, const slrt_arm *v) {
    double a_x, a_y, b_x, b_y, c_x, c_y, d_x, d_y, parts[16], sum;
    int count = 0;
    // Frequent: one point, and points on one axial line.
    if (u->to_x == v->to_x && u->to_y == v->to_y && u->from_x == v->from_x &&
        u->from_y == v->from_y)
        return 0;
    if (u->to_x == u->from_x && v->to_x == v->from_x) return 0;
    if (u->to_y == u->from_y && v->to_y == v->from_y) return 0;
    slrt_scaled(u, &a_x, &a_y, &b_x, &b_y);
    slrt_scaled(v, &c_x, &c_y, &d_x, &d_y);
    count = slrt_add_product(parts, count, a_x, c_y);
    count = slrt_add_product(parts, count, a_x, -d_y);
    count = slrt_add_product(parts, count, -b_x, c_y);
    count = slrt_add_product(parts, count, b_x, d_y);
    count = slrt_add_product(parts, count, -a_y, c_x);
    count = slrt_add_product(parts, count, a_y, d_x);
    count = slrt_add_product(parts, count, b_y, c_x);
    count = slrt_add_product(parts, count, -b_y, d_x);
    sum = count ? parts[count - 1] : 0;
    return (sum > 0) - (sum < 0);
}

/// The sign of u x v: 1 if v points to the left of u. The rounded product decides if it is large
/// enough (Shewchuk 1997, section 4.1: (3 + 16e)e of the sum of its parts, e = 2^-53).
static int slrt_side(const slrt_arm *u, const slrt_arm *v) {
    const double left = u->x * v->y, right = u->y * v->x;
    const double product = left - right;
    const double sum = (left < 0 ? -left : left) + (right < 0 ? -right : right);
    const double bound = 4e-16 * sum + 1e-300;
    if (product > bound) return 1;
    if (-product > bound) return -1;
    return slrt_side_exact(u, v);
}

/// Whether two vectors in one line point the same way; false if either is 0.
static bool slrt_same_way(const slrt_arm *u, const slrt_arm *v) {
    return (u->to_x > u->from_x && v->to_x > v->from_x) ||
           (u->to_x < u->from_x && v->to_x < v->from_x) ||
           (u->to_y > u->from_y && v->to_y > v->from_y) ||
           (u->to_y < u->from_y && v->to_y < v->from_y);
}

/// A power of two that brings a number to between 1 and 2.
static double slrt_scale_of(double number) {
    uint64_t bits;
    double scale;
    memcpy(&bits, &number, sizeof bits);
    bits = bits >> 52 & 0x7ff;
    if (bits < 1) bits = 1;
    if (bits > 2045) bits = 2045;
    bits = (2046 - bits) << 52;
    memcpy(&scale, &bits, sizeof scale);
    return scale;
}

/// Multiplies an exact sum by a number, and adds that to another one.
static int slrt_add_times(double *parts, int count, const double *factor, int factor_count,
                          double number) {
    int i;
    for (i = 0; i < factor_count; i++) count = slrt_add_product(parts, count, factor[i], number);
    return count;
}

// --- From points and boxes to cells

/// As slrt_side, for the ways from a to b and from a to (x, y).
static int slrt_side_of_line(const unsigned char *a, const unsigned char *b, double x, double y) {
    const double a_x = slrt_f64(a), a_y = slrt_f64(a + 8);
    const slrt_arm along = slrt_make_arm(a_x, a_y, slrt_f64(b), slrt_f64(b + 8));
    const slrt_arm to = slrt_make_arm(a_x, a_y, x, y);
    return slrt_side(&along, &to);
}

/// Where a point is: 1 in a cell, 0 on its border, -1 outside.
static int slrt_place_in(const sl_runtime *rt, uint32_t number, double x, double y) {
    const sl_runtime_cell cell = sl_runtime_get_cell(rt, number);
    const unsigned char *corner = rt->vertices + (size_t)cell.first_vertex * SLRT_VERTEX_BYTES;
    const unsigned char *stop = corner + (size_t)cell.vertex_count * SLRT_VERTEX_BYTES;
    const unsigned char *before = stop - SLRT_VERTEX_BYTES;
    int place = 1;
    for (; corner < stop && place >= 0; before = corner, corner += SLRT_VERTEX_BYTES) {
        const int side = slrt_side_of_line(before, corner, x, y);
        if (side < place) place = side;
    }
    return place;
}

static bool slrt_holds(const sl_runtime *rt, uint32_t number, double x, double y) {
    return slrt_place_in(rt, number, x, y) >= 0;
}

/// The column or row of a coordinate within the bounds, as in lib/space/index.h. Buckets are made
/// for places that only come near, too, so rounding changes no answer.
static uint32_t slrt_step(double value, double low, double high, uint32_t count) {
    const double step = (value - low) / (high - low) * count;
    const uint32_t whole = step < count ? (uint32_t)step : count - 1;
    return whole < count ? whole : count - 1; // whatever -ffast-math makes of the line above
}

/// The bucket of a point within the bounds.
static size_t slrt_bucket(const sl_runtime *rt, uint32_t columns, uint32_t rows, double x,
                          double y) {
    return (size_t)slrt_step(y, rt->min_y, rt->max_y, rows) * columns +
           slrt_step(x, rt->min_x, rt->max_x, columns);
}

/// Of the cells that hold a point, the one with the highest number here counts.
static int slrt_claim(const sl_runtime *rt, uint32_t cell) {
    return sl_runtime_is_inside(rt, cell) ? 2 : !sl_runtime_is_solid(rt, cell);
}

/// The first cell that holds a point and is inside, else the first that is not solid, else the
/// first. It is among those of the point's bucket, or among all without a grid. Cells tile the
/// bounds, so the last one holds the point if no other does.
static uint32_t slrt_locate_by_grid(const sl_runtime *rt, double x, double y) {
    uint32_t at = 0, end = rt->cell_count, found = SL_RUNTIME_NO_CELL;
    int best = -1;
    if (rt->grid_cells) {
        const unsigned char *bucket =
            rt->grid_offsets + slrt_bucket(rt, rt->grid_columns, rt->grid_rows, x, y) * 4;
        at = slrt_u32(bucket);
        end = slrt_u32(bucket + 4);
    }
    for (; at < end && best < 2; at++) {
        const uint32_t cell = rt->grid_cells ? slrt_u32(rt->grid_cells + (size_t)at * 4) : at;
        const int claim = slrt_claim(rt, cell);
        if (claim <= best) continue;
        if (!(best < 0 && at + 1 == end && !rt->loose) && !slrt_holds(rt, cell, x, y)) continue;
        found = cell;
        best = claim;
    }
    return found;
}

/// The cell below a node of the tree that a point is in, or that is right of it and over it.
static uint32_t slrt_descend(const sl_runtime *rt, int32_t at, double x, double y) {
    while (at >= 0) {
        const unsigned char *node = rt->nodes + (size_t)at * SLRT_NODE_BYTES;
        at = slrt_i32(node + ((slrt_i32(node + 8) ? y : x) >= slrt_f64(node) ? 16 : 12));
    }
    return (uint32_t)~at;
}

/// Where in the tree the search for a point starts.
static int32_t slrt_start(const sl_runtime *rt, double x, double y) {
    if (!rt->tree_starts) return rt->root;
    return slrt_i32(rt->tree_starts + slrt_bucket(rt, rt->tree_columns, rt->tree_rows, x, y) * 4);
}

/// The next smaller number: it is below the same split lines, and below one through the number.
static double slrt_before(double number) {
    int64_t bits;
    if (number == 0) return -4.9406564584124654e-324;
    memcpy(&bits, &number, sizeof bits);
    bits += number > 0 ? -1 : 1;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static bool slrt_in_bounds(const sl_runtime *rt, double x, double y) {
    return x >= rt->min_x && x <= rt->max_x && y >= rt->min_y && y <= rt->max_y;
}

SL_RUNTIME_API uint32_t sl_runtime_locate(const sl_runtime *runtime, double x, double y) {
    uint32_t found;
    int side;
    if (!slrt_in_bounds(runtime, x, y)) return SL_RUNTIME_NO_CELL;
    if (!runtime->nodes) return slrt_locate_by_grid(runtime, x, y);
    found = slrt_descend(runtime, slrt_start(runtime, x, y), x, y);
    for (side = 1; side < 4 && !sl_runtime_is_inside(runtime, found); side++) {
        const uint32_t cell = slrt_descend(runtime, runtime->root, side & 1 ? slrt_before(x) : x,
                                           side & 2 ? slrt_before(y) : y);
        if (slrt_claim(runtime, cell) > slrt_claim(runtime, found)) found = cell;
    }
    return found;
}

// --- from box to cells

/// The lower left and the upper right of a cell's corners.
static void slrt_bounds_of(const sl_runtime *rt, const sl_runtime_cell *cell, double bounds[4]) {
    const unsigned char *corner = rt->vertices + (size_t)cell->first_vertex * SLRT_VERTEX_BYTES;
    const unsigned char *stop = corner + (size_t)cell->vertex_count * SLRT_VERTEX_BYTES;
    double low_x = slrt_f64(corner), low_y = slrt_f64(corner + 8), high_x = low_x, high_y = low_y;
    while ((corner += SLRT_VERTEX_BYTES) < stop) {
        const double x = slrt_f64(corner), y = slrt_f64(corner + 8);
        low_x = x < low_x ? x : low_x;
        low_y = y < low_y ? y : low_y;
        high_x = x > high_x ? x : high_x;
        high_y = y > high_y ? y : high_y;
    }
    bounds[0] = low_x, bounds[1] = low_y, bounds[2] = high_x, bounds[3] = high_y;
}

/// Whether a cell lies on one side of a box.
static bool slrt_is_beside_box(const sl_runtime *rt, const sl_runtime_cell *cell,
                               const double box[4]) {
    double bounds[4];
    slrt_bounds_of(rt, cell, bounds);
    return bounds[2] < box[0] || bounds[3] < box[1] || bounds[0] > box[2] || bounds[1] > box[3];
}

/// A cell and a box are convex: if they are apart, a side of one of them separates them.
static bool slrt_meets_box(const sl_runtime *rt, uint32_t number, const double box[4]) {
    const sl_runtime_cell cell = sl_runtime_get_cell(rt, number);
    const unsigned char *corner = rt->vertices + (size_t)cell.first_vertex * SLRT_VERTEX_BYTES;
    const unsigned char *stop = corner + (size_t)cell.vertex_count * SLRT_VERTEX_BYTES;
    const unsigned char *before = stop - SLRT_VERTEX_BYTES;
    if (slrt_is_beside_box(rt, &cell, box)) return false;
    for (; corner < stop; before = corner, corner += SLRT_VERTEX_BYTES) {
        // The corner of the box that is farthest to the left of the side.
        const double x = box[slrt_f64(corner + 8) > slrt_f64(before + 8) ? 0 : 2];
        const double y = box[slrt_f64(corner) > slrt_f64(before) ? 3 : 1];
        if (slrt_side_of_line(before, corner, x, y) < 0) return false;
    }
    return true;
}

/// What is done with a cell near a box; false to stop.
typedef bool slrt_visit(void *context, uint32_t cell);

static bool slrt_visit_all(const sl_runtime *rt, slrt_visit *visit, void *context) {
    uint32_t i;
    for (i = 0; i < rt->cell_count; i++)
        if (!visit(context, i)) return false;
    return true;
}

/// The cells of all buckets that a box meets; a cell may come more than once.
static bool slrt_visit_by_grid(const sl_runtime *rt, const double box[4], slrt_visit *visit,
                               void *context) {
    const uint32_t columns = rt->grid_columns, rows = rt->grid_rows;
    const double low_x = box[0] > rt->min_x ? box[0] : rt->min_x;
    const double low_y = box[1] > rt->min_y ? box[1] : rt->min_y;
    const double high_x = box[2] < rt->max_x ? box[2] : rt->max_x;
    const double high_y = box[3] < rt->max_y ? box[3] : rt->max_y;
    const uint32_t right = slrt_step(high_x, rt->min_x, rt->max_x, columns);
    const uint32_t top = slrt_step(high_y, rt->min_y, rt->max_y, rows);
    uint32_t y, x, i;
    for (y = slrt_step(low_y, rt->min_y, rt->max_y, rows); y <= top; y++)
        for (x = slrt_step(low_x, rt->min_x, rt->max_x, columns); x <= right; x++) {
            const unsigned char *bucket = rt->grid_offsets + ((size_t)y * columns + x) * 4;
            for (i = slrt_u32(bucket); i < slrt_u32(bucket + 4); i++)
                if (!visit(context, slrt_u32(rt->grid_cells + (size_t)i * 4))) return false;
        }
    return true;
}

static bool slrt_visit_by_tree(const sl_runtime *rt, const double box[4], slrt_visit *visit,
                               void *context) {
    enum { MOST = 128 };
    int32_t stack[MOST];
    uint32_t count = 1, steps = 2 * rt->node_count + 1; // no more than a tree has
    stack[0] = rt->root;
    while (count && count < MOST - 1 && steps--) {
        const int32_t child = stack[--count];
        const unsigned char *node;
        int axis;
        if (child < 0) {
            if (!visit(context, (uint32_t)~child)) return false;
            continue;
        }
        node = rt->nodes + (size_t)child * SLRT_NODE_BYTES;
        axis = slrt_i32(node + 8) ? 1 : 0;
        if (box[axis] <= slrt_f64(node)) stack[count++] = slrt_i32(node + 12);
        if (box[2 + axis] >= slrt_f64(node)) stack[count++] = slrt_i32(node + 16);
    }
    return !count || slrt_visit_all(rt, visit, context); // too deep, or no tree
}

/// Visits all cells that a box touches, and some that are near: by the grid or the tree, or all if
/// there is neither. False if a visit stopped it.
static bool slrt_visit_near(const sl_runtime *rt, const double box[4], slrt_visit *visit,
                            void *context) {
    if (box[2] < rt->min_x || box[3] < rt->min_y || box[0] > rt->max_x || box[1] > rt->max_y)
        return true;
    if (rt->grid_cells) return slrt_visit_by_grid(rt, box, visit, context);
    if (rt->nodes) return slrt_visit_by_tree(rt, box, visit, context);
    return slrt_visit_all(rt, visit, context);
}

/// So many cells are noted at a time: a number that 32 divides.
#ifndef SLRT_WINDOW
#define SLRT_WINDOW 8192
#endif

/// Cells by number, from `first` on, as bits.
typedef struct slrt_window {
    uint32_t first, next; ///< next: the first one behind the bits
    uint32_t bits[SLRT_WINDOW / 32];
} slrt_window;

static bool slrt_note(void *context, uint32_t cell) {
    slrt_window *w = (slrt_window *)context;
    const uint32_t at = cell - w->first;
    if (cell < w->first) return true;
    if (at < SLRT_WINDOW)
        w->bits[at / 32] |= UINT32_C(1) << at % 32;
    else if (cell < w->next)
        w->next = cell;
    return true;
}

SL_RUNTIME_API uint32_t sl_runtime_box_cells(const sl_runtime *runtime, double min_x, double min_y,
                                             double max_x, double max_y, uint32_t *cells,
                                             uint32_t room) {
    double box[4];
    uint32_t i, bits, cell, count = 0;
    slrt_window w;
    if (!(min_x <= max_x && min_y <= max_y)) return 0;
    box[0] = min_x, box[1] = min_y, box[2] = max_x, box[3] = max_y;
    for (w.first = 0; w.first != SL_RUNTIME_NO_CELL; w.first = w.next) {
        w.next = SL_RUNTIME_NO_CELL;
        memset(w.bits, 0, sizeof w.bits);
        slrt_visit_near(runtime, box, slrt_note, &w);
        for (i = 0; i < SLRT_WINDOW / 32; i++)
            for (bits = w.bits[i], cell = w.first + 32 * i; bits; bits >>= 1, cell++) {
                if (!(bits & 1) || !slrt_meets_box(runtime, cell, box)) continue;
                if (count < room) cells[count] = cell;
                count++;
            }
    }
    return count;
}

// --- Portals on seams, and what walls stop that do not stop all

/// The first of items whose first number, by which they ascend, is not below `number`.
static uint32_t slrt_first_item(const unsigned char *items, uint32_t count, size_t item_bytes,
                                uint32_t number) {
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (slrt_u32(items + middle * item_bytes) < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// The first entry of a portal among the portals on seams, or where it would be.
static uint32_t slrt_first_seam(const sl_runtime *rt, uint32_t portal) {
    return slrt_first_item(rt->seam_portals, rt->seam_portal_count, 12, portal);
}

/// What a seam stops; 0 for most.
static uint32_t slrt_seam_stops(const sl_runtime *rt, uint32_t seam) {
    return rt->stops ? slrt_u32(rt->stops + (size_t)seam * 4) &
                           (SL_RUNTIME_STOPS_ALL | SL_RUNTIME_STOPS_LIMITED)
                     : 0;
}

/// The first passage of a cell, or where it would be.
static uint32_t slrt_first_passage(const sl_runtime *rt, uint32_t cell) {
    return slrt_first_item(rt->passages, rt->passage_count, SLRT_PASSAGE_BYTES, cell);
}

/// The next passage of a cell that steps take, from a number on; passage_count for none.
static uint32_t slrt_next_way(const sl_runtime *rt, uint32_t cell, uint32_t from) {
    for (; from < rt->passage_count; from++) {
        const unsigned char *at = rt->passages + (size_t)from * SLRT_PASSAGE_BYTES;
        if (slrt_u32(at) != cell) break;
        if (!(slrt_u32(at + 12) & SL_RUNTIME_STOPS_STEPS)) return from;
    }
    return rt->passage_count;
}

/// The right (0) or left (1) end of a passage as its cell crosses it: two numbers of the file.
static const unsigned char *slrt_passage_end(const sl_runtime *rt, uint32_t passage, int left) {
    const uint32_t wall = slrt_u32(rt->passages + (size_t)passage * SLRT_PASSAGE_BYTES + 4);
    const unsigned char *ends = rt->walls + (size_t)(wall & INT32_MAX) * 32;
    return (wall > INT32_MAX) == (left != 0) ? ends
                                             : ends + 16; // the cell is at its right, or left
}

static void slrt_read_passage(const sl_runtime *rt, uint32_t passage, double *right, double *left) {
    const unsigned char *ends[2];
    int i;
    ends[0] = slrt_passage_end(rt, passage, 0);
    ends[1] = slrt_passage_end(rt, passage, 1);
    for (i = 0; i < 2; i++) {
        right[i] = slrt_f64(ends[0] + 8 * i);
        left[i] = slrt_f64(ends[1] + 8 * i);
    }
}

/// Whether steps pass a wall beside a cell.
static bool slrt_has_way(const sl_runtime *rt, uint32_t cell) {
    return slrt_next_way(rt, cell, slrt_first_passage(rt, cell)) < rt->passage_count;
}

/// Whether a wall stops steps. Time: the passages.
static bool slrt_wall_stops_steps(const sl_runtime *rt, uint32_t wall) {
    uint32_t i;
    for (i = 0; i < rt->passage_count; i++) {
        const unsigned char *at = rt->passages + (size_t)i * SLRT_PASSAGE_BYTES;
        if (slrt_u32(at + 4) == wall) return (slrt_u32(at + 12) & SL_RUNTIME_STOPS_STEPS) != 0;
    }
    return true;
}

SL_RUNTIME_API uint32_t sl_runtime_portal_stops(const sl_runtime *runtime, uint32_t portal) {
    uint32_t i, stops = 0;
    if (!runtime->stops) return 0;
    for (i = slrt_first_seam(runtime, portal); i < runtime->seam_portal_count; i++) {
        const unsigned char *on = runtime->seam_portals + (size_t)i * 12;
        if (slrt_u32(on) != portal) break;
        stops |= slrt_seam_stops(runtime, slrt_u32(on + 4));
    }
    return stops;
}

/// Whether a directed portal is on a limited wall, in a file for sight.
static bool slrt_is_limited(const sl_runtime *rt, uint32_t directed) {
    uint32_t portal;
    if (!rt->has_limits) return false;
    portal = slrt_u32(rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES);
    return (sl_runtime_portal_stops(rt, portal) & SL_RUNTIME_STOPS_LIMITED) != 0;
}

SL_RUNTIME_API uint32_t sl_runtime_passages(const sl_runtime *runtime, uint32_t cell,
                                            sl_runtime_passage *passages, uint32_t room) {
    uint32_t i = slrt_first_passage(runtime, cell), count = 0;
    for (; i < runtime->passage_count; i++, count++) {
        const unsigned char *at = runtime->passages + (size_t)i * SLRT_PASSAGE_BYTES;
        if (slrt_u32(at) != cell) break;
        if (count >= room) continue;
        passages[count].cell = slrt_u32(at + 8);
        passages[count].stops = slrt_u32(at + 12);
        slrt_read_passage(runtime, i, passages[count].right, passages[count].left);
    }
    return count;
}

// --- Boxes that move: the cells that they lie in

// Memory: the first free entry, the first entry of each cell, the first entry of each box, and the
// entries. An entry is four numbers: a cell, a box in it, the cell's next entry, the box's next.

#define SLRT_NO_ENTRY   UINT32_MAX
#define SLRT_EVERYWHERE (UINT32_MAX - 1) ///< in place of a box's first entry: there was no room

enum { SLRT_ENTRY_CELL, SLRT_ENTRY_BOX, SLRT_ENTRY_IN_CELL, SLRT_ENTRY_OF_BOX, SLRT_ENTRY };

static uint32_t *slrt_first_entry(const sl_runtime_boxes *boxes, uint32_t cell) {
    return boxes->memory + 1 + cell;
}

static uint32_t *slrt_own_entry(const sl_runtime_boxes *boxes, uint32_t box) {
    return boxes->memory + 1 + (size_t)boxes->runtime->cell_count + box;
}

static uint32_t *slrt_entry(const sl_runtime_boxes *boxes, uint32_t entry) {
    return boxes->memory + 1 + (size_t)boxes->runtime->cell_count + boxes->count +
           (size_t)SLRT_ENTRY * entry;
}

SL_RUNTIME_API size_t sl_runtime_boxes_count(const sl_runtime *runtime, uint32_t count,
                                             uint32_t room) {
    return 1 + (size_t)runtime->cell_count + count + (size_t)SLRT_ENTRY * room;
}

SL_RUNTIME_API void sl_runtime_boxes_start(sl_runtime_boxes *out, const sl_runtime *runtime,
                                           sl_runtime_box *list, uint32_t count, uint32_t room,
                                           uint32_t *memory) {
    uint32_t i;
    if (room >= SLRT_EVERYWHERE) room = SLRT_EVERYWHERE - 1;
    out->runtime = runtime;
    out->count = count;
    out->room = room;
    out->boxes = list;
    out->memory = memory;
    memset(memory, 0xff, (1 + (size_t)runtime->cell_count + count) * sizeof *memory);
    memory[0] = room ? 0 : SLRT_NO_ENTRY;
    for (i = 0; i < room; i++)
        slrt_entry(out, i)[SLRT_ENTRY_OF_BOX] = i + 1 < room ? i + 1 : SLRT_NO_ENTRY;
    for (i = 0; i < count; i++) {
        memset(&list[i], 0, sizeof list[i]);
        list[i].min_x = list[i].min_y = 1; // it is nowhere
    }
}

/// Takes a box out of its cells.
static void slrt_take_out(sl_runtime_boxes *boxes, uint32_t box) {
    uint32_t *own = slrt_own_entry(boxes, box);
    uint32_t at = *own == SLRT_EVERYWHERE ? SLRT_NO_ENTRY : *own;
    *own = SLRT_NO_ENTRY;
    while (at != SLRT_NO_ENTRY) {
        uint32_t *entry = slrt_entry(boxes, at);
        uint32_t *link = slrt_first_entry(boxes, entry[SLRT_ENTRY_CELL]);
        const uint32_t next = entry[SLRT_ENTRY_OF_BOX];
        while (*link != at) link = &slrt_entry(boxes, *link)[SLRT_ENTRY_IN_CELL];
        *link = entry[SLRT_ENTRY_IN_CELL];
        entry[SLRT_ENTRY_OF_BOX] = boxes->memory[0];
        boxes->memory[0] = at;
        at = next;
    }
}

/// Whether a box without width or height lies along the segment from a to b: not just on an end.
static bool slrt_lies_along(const double box[4], const double *a, const double *b) {
    const int axis = box[0] == box[2] ? 0 : 1; // which coordinate is the same in all of the box
    const double low = a[!axis] < b[!axis] ? a[!axis] : b[!axis];
    const double high = a[!axis] < b[!axis] ? b[!axis] : a[!axis];
    return a[axis] == box[axis] && b[axis] == box[axis] && low < box[2 + !axis] &&
           box[!axis] < high;
}

/// Whether a box without width or height lies on a portal of a cell, or on a wall that steps pass.
static bool slrt_lies_on_way(const sl_runtime *rt, uint32_t number, const sl_runtime_cell *cell,
                             const double box[4]) {
    uint32_t i;
    if (box[0] == box[2] && box[1] == box[3]) return true;
    for (i = cell->first_directed; i < cell->first_directed + cell->directed_count; i++) {
        const sl_runtime_directed_portal portal = sl_runtime_get_directed_portal(rt, i);
        if (slrt_lies_along(box, portal.left, portal.right)) return true;
    }
    i = slrt_next_way(rt, number, slrt_first_passage(rt, number));
    for (; i < rt->passage_count; i = slrt_next_way(rt, number, i + 1)) {
        double right[2], left[2];
        slrt_read_passage(rt, i, right, left);
        if (slrt_lies_along(box, right, left)) return true;
    }
    return false;
}

/// Whether a box has points within a cell, or lies on one of its portals. To touch a cell is not
/// enough: a box at a wall is not seen from the wall's other side.
static bool slrt_reaches_into(const sl_runtime *rt, uint32_t number, const double box[4]) {
    const sl_runtime_cell cell = sl_runtime_get_cell(rt, number);
    const unsigned char *corner = rt->vertices + (size_t)cell.first_vertex * SLRT_VERTEX_BYTES;
    const unsigned char *stop = corner + (size_t)cell.vertex_count * SLRT_VERTEX_BYTES;
    const unsigned char *before = stop - SLRT_VERTEX_BYTES;
    bool left = true, right = true, under = true, over = true, touches = false;
    if (slrt_is_beside_box(rt, &cell, box)) return false;
    for (; corner < stop; before = corner, corner += SLRT_VERTEX_BYTES) {
        const double x = slrt_f64(corner), y = slrt_f64(corner + 8);
        int k, most = -1;
        for (k = 0; k < 4 && most <= 0; k++) {
            const int side =
                slrt_side_of_line(before, corner, box[k & 1 ? 2 : 0], box[k & 2 ? 3 : 1]);
            if (side > most) most = side;
        }
        if (most < 0) return false;
        touches = touches || !most;
        left = left && x <= box[0];
        under = under && y <= box[1];
        right = right && x >= box[2];
        over = over && y >= box[3];
    }
    if (!touches && !left && !right && !under && !over) return true;
    return (box[0] == box[2] || box[1] == box[3]) && slrt_lies_on_way(rt, number, &cell, box);
}

/// A box that is put into its cells.
typedef struct slrt_placing {
    sl_runtime_boxes *boxes;
    uint32_t box;
    double at[4];
} slrt_placing;

/// Puts a box into a cell, if it reaches into it. False if there is no room.
static bool slrt_put_in_cell(void *context, uint32_t cell) {
    const slrt_placing *placing = (const slrt_placing *)context;
    sl_runtime_boxes *boxes = placing->boxes;
    uint32_t *first = slrt_first_entry(boxes, cell), *own = slrt_own_entry(boxes, placing->box);
    const uint32_t free = boxes->memory[0];
    uint32_t *entry;
    // The last box that came to a cell is the first in its list: a second bucket has the cell too.
    if (*first != SLRT_NO_ENTRY && slrt_entry(boxes, *first)[SLRT_ENTRY_BOX] == placing->box)
        return true;
    if (!slrt_reaches_into(boxes->runtime, cell, placing->at)) return true;
    if (free == SLRT_NO_ENTRY) return false;
    entry = slrt_entry(boxes, free);
    boxes->memory[0] = entry[SLRT_ENTRY_OF_BOX];
    entry[SLRT_ENTRY_CELL] = cell;
    entry[SLRT_ENTRY_BOX] = placing->box;
    entry[SLRT_ENTRY_IN_CELL] = *first;
    entry[SLRT_ENTRY_OF_BOX] = *own;
    *first = *own = free;
    return true;
}

/// Whether a box may be somewhere: its numbers are sound, and in order.
static bool slrt_is_sound_box(const sl_runtime_box *box) {
    return slrt_is_coordinate(box->min_x) && slrt_is_coordinate(box->min_y) &&
           slrt_is_coordinate(box->max_x) && slrt_is_coordinate(box->max_y) &&
           box->min_x <= box->max_x && box->min_y <= box->max_y;
}

SL_RUNTIME_API bool sl_runtime_boxes_move(sl_runtime_boxes *boxes, uint32_t box,
                                          const sl_runtime_box *to) {
    slrt_placing placing;
    placing.boxes = boxes;
    placing.box = box;
    placing.at[0] = to->min_x, placing.at[1] = to->min_y;
    placing.at[2] = to->max_x, placing.at[3] = to->max_y;
    boxes->boxes[box] = *to;
    slrt_take_out(boxes, box);
    if (!slrt_is_sound_box(to) ||
        slrt_visit_near(boxes->runtime, placing.at, slrt_put_in_cell, &placing))
        return true;
    slrt_take_out(boxes, box);
    *slrt_own_entry(boxes, box) = SLRT_EVERYWHERE;
    return false;
}

// --- Eye-to-cell: sectors of directions, and how a portal narrows them

SL_RUNTIME_API sl_runtime_view sl_runtime_view_all_round(double x, double y) {
    sl_runtime_view view;
    memset(&view, 0, sizeof view);
    view.x = x;
    view.y = y;
    view.all_round = true;
    return view;
}

SL_RUNTIME_API sl_runtime_view sl_runtime_view_toward(double x, double y, double direction_x,
                                                      double direction_y, double tan_half) {
    sl_runtime_view view = sl_runtime_view_all_round(x, y);
    view.all_round = false;
    view.right[0] = direction_x + direction_y * tan_half;
    view.right[1] = direction_y - direction_x * tan_half;
    view.left[0] = direction_x - direction_y * tan_half;
    view.left[1] = direction_y + direction_x * tan_half;
    return view;
}

/// A border of a sector is a number: 2e for the left end of directed portal e, 2e + 1 for the right
/// end; or one of the cone's arms.
#define SLRT_ARM       (UINT32_MAX - 6)
#define SLRT_ALL_ROUND UINT32_MAX                 ///< no borders: the eye is in the cell
enum { SLRT_MOST_ARMS = 6, SLRT_MIRROR_ARM = 4 }; ///< the last two: the ends of a mirror

/// The limit of steps for each directed portal of the map. In sound maps few need more than one;
/// four is the most seen.
#ifndef SLRT_PATIENCE
#define SLRT_PATIENCE 256
#endif

enum {
    SLRT_SEEN = 1,
    SLRT_ENTERED = 2,
    SLRT_ON_PATH = 4,
    SLRT_IN_ROW = 8,
    // Of the last visit: which borders of the sector run along a portal that was crossed. A line on
    // the right border has crossed it to the left, one on the left border to the right.
    SLRT_ALONG_RIGHT = 16,
    SLRT_ALONG_LEFT = 32,
    SLRT_ALONG = SLRT_ALONG_RIGHT | SLRT_ALONG_LEFT,
    SLRT_OWN = 64,     ///< one of the eye's cells, or on the way to a point
    SLRT_LIMITED = 128 ///< of the last visit: the way there crosses a limited wall
};

/// What of a cell's surroundings the eye sees through the portals passed: a sector, and which of
/// its borders run along portals (of SLRT_ALONG).
typedef struct slrt_sector {
    uint32_t right, left;
    unsigned along;
    unsigned limited; ///< SLRT_LIMITED if a limited wall is among the portals, else 0
} slrt_sector;

/// A depth-first search. The path is a stack of four numbers for each cell: the cell, the number of
/// its directed portals that are done, and the right and left border of the sector through which
/// the eye sees it.
typedef struct slrt_search {
    const sl_runtime *rt;
    const sl_runtime_view *view;
    const unsigned char *shut; ///< NULL for none
    double range;              ///< 0 for no limit
    double x, y;               ///< the eye
    uint32_t eye_cell;         ///< that sl_runtime_locate gives
    uint32_t own_count;        ///< of the cells listed: the eye's, or those on a way
    bool has_marks;            ///< the marks of these say so
    slrt_arm cone[SLRT_MOST_ARMS];
    uint32_t *path, depth;
    uint32_t *sectors; ///< by cell: the borders of the sector of its last visit
    unsigned char *marks;
    bool has_row;
    bool on_foot; ///< glass is a wall from both sides, and steps count in place of sight
    uint32_t *cells, room, count;
    uint64_t patience;
    bool in_mirrors; ///< `meet` looks into mirrors
    bool is_image;   ///< the eye is an image, which stands in no cell
    /// NULL for a search without boxes and mirrors, and till boxes hide. By these a program that
    /// asks for none is built without what is only for them.
    void (*meet)(struct slrt_search *s, uint32_t cell, const slrt_sector *sector);
    bool (*is_hidden)(const struct slrt_search *s, uint32_t directed, const slrt_sector *sector);
    bool (*stops)(const struct slrt_search *s, const slrt_arm *way, uint32_t cell);
    const sl_runtime_boxes *boxes;     ///< the rest is about them
    uint32_t except;                   ///< a box that stops nothing
    unsigned char *box_marks;          ///< by box, of SLRT_BOX_*
    uint32_t *blockers, blocker_count; ///< those that hide something
    uint32_t *chosen;                  ///< room for as many as there are boxes
    bool gave_up;                      ///< the search took too long
} slrt_search;

static slrt_arm slrt_border(const slrt_search *s, uint32_t border) {
    const unsigned char *end;
    if (border >= SLRT_ARM) return s->cone[border - SLRT_ARM];
    end = s->rt->directed + (size_t)(border / 2) * SLRT_DIRECTED_BYTES + 8 + 16 * (border % 2);
    return slrt_make_arm(s->x, s->y, slrt_f64(end), slrt_f64(end + 8));
}

static bool slrt_is_zero(const slrt_arm *arm) {
    return arm->to_x == arm->from_x && arm->to_y == arm->from_y;
}

/// Whether v is in the sector from a counter-clockwise to b, of at most 180 degrees, borders
/// included. The signs of a x v and v x b are given.
static bool slrt_within(const slrt_arm *v, const slrt_arm *a, const slrt_arm *b, int from_a,
                        int to_b) {
    if (from_a < 0 || to_b < 0) return false;
    return (from_a && to_b) || slrt_same_way(a, v) || slrt_same_way(b, v);
}

static bool slrt_same_ray(const slrt_arm *u, const slrt_arm *v) {
    return !slrt_side(u, v) && slrt_same_way(u, v);
}

/// Whether a portal with the ends p and q has a direction of the sector from a to b.
static bool slrt_is_ahead(const slrt_arm *p, const slrt_arm *q, const slrt_arm *a,
                          const slrt_arm *b) {
    return slrt_within(p, a, b, slrt_side(a, p), slrt_side(p, b)) ||
           slrt_within(a, p, q, slrt_side(p, a), slrt_side(a, q));
}

/// Narrows a sector to its part that leaves the last cell on the path through a directed portal,
/// which the eye is not on; false for none. The first cell is one of the eye's. What a sector
/// reaches of any other one is ahead, within less than 180 degrees. (sli_arc_narrow in the
/// library.)
static bool slrt_narrow(const slrt_search *s, uint32_t directed, slrt_sector *sector) {
    const uint32_t portal_right = 2 * directed + 1, portal_left = 2 * directed;
    const slrt_arm p = slrt_border(s, portal_right), q = slrt_border(s, portal_left);
    slrt_arm right = p, left = q, to_left;
    int turn;
    if (sector->right == SLRT_ALL_ROUND) {
        sector->right = portal_right;
        sector->left = portal_left;
    } else {
        right = slrt_border(s, sector->right);
        left = slrt_border(s, sector->left);
        if (s->depth == 1 && !slrt_is_ahead(&p, &q, &right, &left)) return false;
        if (slrt_side(&right, &p) > 0) {
            right = p;
            sector->right = portal_right;
            sector->along &= ~(unsigned)SLRT_ALONG_RIGHT;
        }
        if (slrt_side(&left, &q) < 0) {
            left = q;
            sector->left = portal_left;
            sector->along &= ~(unsigned)SLRT_ALONG_LEFT;
        }
    }
    turn = slrt_side(&right, &left);
    if (turn) return turn > 0;
    if (!slrt_side(&p, &q)) {
        // Who goes from its right end to its left end crosses it to the right.
        to_left = slrt_make_arm(p.to_x, p.to_y, q.to_x, q.to_y);
        sector->along |= slrt_same_way(&to_left, &right) ? (unsigned)SLRT_ALONG_LEFT
                                                         : (unsigned)SLRT_ALONG_RIGHT;
    }
    return sector->along != SLRT_ALONG; // no line beside it passes all portals along it
}

/// Whether a directed portal, from its right end to its left, goes as the glass that it is on: it
/// leads to the dark.
static bool slrt_leads_along(const sl_runtime *rt, uint32_t directed, const unsigned char *glass) {
    const unsigned char *ends = rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 8;
    const slrt_arm to_left =
        slrt_make_arm(slrt_f64(ends + 16), slrt_f64(ends + 24), slrt_f64(ends), slrt_f64(ends + 8));
    const slrt_arm along = slrt_make_arm(slrt_f64(glass), slrt_f64(glass + 8), slrt_f64(glass + 16),
                                         slrt_f64(glass + 24));
    return slrt_same_way(&to_left, &along);
}

/// Whether one-way glass keeps sight from the eye. From its a to its b, it is seen through from the
/// right to the left. For an eye on its line, the eye's cell decides; for an image there, which way
/// the portal leads.
static bool slrt_is_dark(const slrt_search *s, const unsigned char *glass, uint32_t directed) {
    const sl_runtime_cell cell = sl_runtime_get_cell(s->rt, s->eye_cell);
    const unsigned char *corner = s->rt->vertices + (size_t)cell.first_vertex * SLRT_VERTEX_BYTES;
    const int side = slrt_side_of_line(glass, glass + 16, s->x, s->y);
    uint32_t i;
    if (side) return side > 0;
    if (s->is_image) return slrt_leads_along(s->rt, directed, glass);
    for (i = 0; i < cell.vertex_count; i++, corner += SLRT_VERTEX_BYTES)
        if (slrt_side_of_line(glass, glass + 16, slrt_f64(corner), slrt_f64(corner + 8)) > 0)
            return true;
    return false;
}

/// Whether a directed portal is on a shut door or dark glass, and so a wall; on foot, also on a
/// wall that stops steps alone.
static bool slrt_is_blocked(const slrt_search *s, uint32_t directed) {
    const sl_runtime *rt = s->rt;
    const uint32_t portal = slrt_u32(rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES);
    uint32_t i;
    if (!rt->seam_portal_count) return false;
    for (i = slrt_first_seam(rt, portal); i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12, *seam;
        if (slrt_u32(on) != portal) return false;
        seam = rt->seams + (size_t)slrt_u32(on + 4) * 40;
        if (slrt_u32(seam + 32) == 1 && s->shut && s->shut[slrt_u32(seam + 36)]) return true;
        if (slrt_u32(seam + 32) == 2 && (s->on_foot || slrt_is_dark(s, seam, directed)))
            return true;
        if (s->on_foot && slrt_seam_stops(rt, slrt_u32(on + 4)) & SL_RUNTIME_STOPS_STEPS)
            return true;
    }
    return false;
}

static double slrt_size(double x, double y) {
    return (x < 0 ? -x : x) + (y < 0 ? -y : y);
}

/// Where, from 0 to 1, a ray from the eye meets the way from p to q. p and q are given relative to
/// the eye. Also gives a bound for rounding; false if the place is unknown.
static bool slrt_meet(const slrt_arm *ray, const slrt_arm *p, const slrt_arm *q, double *at,
                      double *error) {
    const double size = slrt_size(ray->x, ray->y);
    const double at_p = ray->x * p->y - ray->y * p->x, at_q = ray->x * q->y - ray->y * q->x;
    const double error_p = 1e-15 * size * slrt_size(p->x, p->y);
    const double error_q = 1e-15 * size * slrt_size(q->x, q->y);
    const double width = at_q - at_p;
    if (!(width > 4 * (error_p + error_q))) return false;
    *at = -at_p / width;
    *error = 2 * (error_p + (*at < 0 ? -*at : *at) * (error_p + error_q)) / width + 1e-15;
    return true;
}

/// Whether the part of a segment from p to q between two borders is within range; NULL for its end.
static inline bool slrt_is_part_in_range(const slrt_search *s, const slrt_arm *p, const slrt_arm *q,
                                         const slrt_arm *right, const slrt_arm *left) {
    const double x = q->x - p->x, y = q->y - p->y, square = x * x + y * y;
    const double ends = slrt_size(p->x, p->y) + slrt_size(q->x, q->y);
    const double limit = s->range * (1 + 1e-12) + 1e-14 * ends;
    double from = 0, to = 1, at, error, near_x, near_y;
    if (right && slrt_meet(right, p, q, &at, &error) && at - error > from) from = at - error;
    if (left && slrt_meet(left, p, q, &at, &error) && at + error < to) to = at + error;
    at = square > 0 ? -(p->x * x + p->y * y) / square : 0;
    if (at > to) at = to;
    if (!(at >= from)) at = from;
    near_x = p->x + at * x;
    near_y = p->y + at * y;
    return !(near_x * near_x + near_y * near_y > limit * limit);
}

/// The same for the part of a directed portal between two borders of a sector, or all of it.
static bool slrt_in_range(const slrt_search *s, uint32_t directed, uint32_t right, uint32_t left) {
    const slrt_arm p = slrt_border(s, 2 * directed + 1), q = slrt_border(s, 2 * directed);
    slrt_arm a, b;
    if (right / 2 != directed) a = slrt_border(s, right);
    if (left / 2 != directed) b = slrt_border(s, left);
    return slrt_is_part_in_range(s, &p, &q, right / 2 != directed ? &a : NULL,
                                 left / 2 != directed ? &b : NULL);
}

/// Whether a cell's last visit has seen all that a visit through another sector would.
static bool slrt_covered(const slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    const uint32_t was_right = s->sectors[2 * (size_t)cell];
    const uint32_t was_left = s->sectors[2 * (size_t)cell + 1];
    const unsigned more = s->marks[cell] & SLRT_ALONG & ~sector->along;
    slrt_arm a, b, v, w;
    int a_v, w_b;
    if (s->marks[cell] & SLRT_LIMITED && !sector->limited) return false;
    if (was_right == sector->right && was_left == sector->left) return !more;
    a = slrt_border(s, was_right);
    b = slrt_border(s, was_left);
    v = slrt_border(s, sector->right);
    w = slrt_border(s, sector->left);
    a_v = slrt_side(&a, &v);
    w_b = slrt_side(&w, &b);
    if ((!a_v && more & SLRT_ALONG_RIGHT) || (!w_b && more & SLRT_ALONG_LEFT)) return false;
    return slrt_within(&v, &a, &b, a_v, slrt_side(&v, &b)) &&
           slrt_within(&w, &a, &b, slrt_side(&a, &w), w_b);
}

static void slrt_see(slrt_search *s, uint32_t cell) {
    if (s->marks[cell] & SLRT_SEEN) return;
    s->marks[cell] |= SLRT_SEEN;
    if (s->count < s->room) s->cells[s->count] = cell;
    s->count++;
}

// --- What the parts need that the library has in common with this header: box_envelope.h says what

typedef struct slrt_point {
    double x, y;
} slrt_point;
typedef slrt_search slrt_eye;
typedef slrt_arm slrt_ray;
typedef struct slrt_polygon slrt_sight;
typedef sl_runtime_box slrt_box_list;

static slrt_point slrt_eye_at(const slrt_eye *eye) {
    slrt_point at;
    at.x = eye->x;
    at.y = eye->y;
    return at;
}

static slrt_arm slrt_ray_to(const slrt_eye *eye, slrt_point at) {
    return slrt_make_arm(eye->x, eye->y, at.x, at.y);
}

static int slrt_turn_to(const slrt_eye *eye, const slrt_arm *ray, slrt_point at) {
    const slrt_arm to = slrt_ray_to(eye, at);
    return slrt_side(ray, &to);
}

static int slrt_point_turn(const slrt_eye *eye, slrt_point a, slrt_point b) {
    const slrt_arm ray = slrt_ray_to(eye, a);
    return slrt_turn_to(eye, &ray, b);
}

static int slrt_ray_sign(const slrt_eye *eye, const slrt_arm *ray, int axis) {
    const double from = axis ? ray->from_y : ray->from_x, to = axis ? ray->to_y : ray->to_x;
    (void)eye;
    return (to > from) - (to < from);
}

static int slrt_way_turn(const slrt_eye *eye, const slrt_arm *ray, slrt_point a, slrt_point b) {
    const slrt_arm way = slrt_make_arm(a.x, a.y, b.x, b.y);
    (void)eye;
    return slrt_side(&way, ray);
}

static slrt_point slrt_vertex(const slrt_eye *eye, uint32_t number) {
    slrt_point at;
    sl_runtime_get_vertex(eye->rt, number, &at.x, &at.y);
    return at;
}

static void slrt_read_box(const sl_runtime_box *boxes, uint32_t number, double *box) {
    box[0] = boxes[number].min_x;
    box[1] = boxes[number].min_y;
    box[2] = boxes[number].max_x;
    box[3] = boxes[number].max_y;
}

/// As slrt_side_meets, without rounding.
static int slrt_side_meets_exact(const slrt_eye *eye, const slrt_arm *u, slrt_point a, slrt_point b,
                                 int axis, double value) {
    const double place =
        slrt_scale_of(slrt_larger(slrt_larger(slrt_larger(a.x, a.y), slrt_larger(b.x, b.y)),
                                  slrt_larger(value, slrt_larger(eye->x, eye->y))));
    const double length = slrt_scale_of(
        slrt_larger(slrt_larger(u->to_x, u->to_y), slrt_larger(u->from_x, u->from_y)));
    const double a_x = place * a.x, a_y = place * a.y, b_x = place * b.x, b_y = place * b.y;
    const double e_x = place * eye->x, e_y = place * eye->y;
    const double t_x = length * u->to_x, t_y = length * u->to_y;
    const double f_x = length * u->from_x, f_y = length * u->from_y;
    double turn[16], cross[16], parts[128];
    int turns = 0, crosses = 0, count = 0;
    turns = slrt_add_product(turn, turns, b_x, a_y);
    turns = slrt_add_product(turn, turns, b_x, -e_y);
    turns = slrt_add_product(turn, turns, a_x, e_y);
    turns = slrt_add_product(turn, turns, b_y, -a_x);
    turns = slrt_add_product(turn, turns, b_y, e_x);
    turns = slrt_add_product(turn, turns, a_y, -e_x);
    crosses = slrt_add_product(cross, crosses, b_x, t_y);
    crosses = slrt_add_product(cross, crosses, b_x, -f_y);
    crosses = slrt_add_product(cross, crosses, a_x, -t_y);
    crosses = slrt_add_product(cross, crosses, a_x, f_y);
    crosses = slrt_add_product(cross, crosses, b_y, -t_x);
    crosses = slrt_add_product(cross, crosses, b_y, f_x);
    crosses = slrt_add_product(cross, crosses, a_y, t_x);
    crosses = slrt_add_product(cross, crosses, a_y, -f_x);
    count = slrt_add_times(parts, count, turn, turns, axis ? t_y : t_x);
    count = slrt_add_times(parts, count, turn, turns, axis ? -f_y : -f_x);
    count = slrt_add_times(parts, count, cross, crosses, place * -value);
    count = slrt_add_times(parts, count, cross, crosses, axis ? e_y : e_x);
    return count ? (parts[count - 1] > 0) - (parts[count - 1] < 0) : 0;
}

/// The rounded number decides if it is large enough.
static int slrt_side_meets(const slrt_eye *eye, const slrt_arm *u, slrt_point a, slrt_point b,
                           int axis, double value) {
    const double s_x = b.x - a.x, s_y = b.y - a.y;
    const double one = s_x * (a.y - eye->y), two = s_y * (a.x - eye->x);
    const double three = s_x * u->y, four = s_y * u->x;
    const double part = axis ? u->y : u->x, away = value - (axis ? eye->y : eye->x);
    const double sum = part * (one - two) - (three - four) * away;
    const double bound = 4e-15 * slrt_larger(part, 0) * slrt_size(one, two) +
                         4e-15 * slrt_size(three, four) * (away < 0 ? -away : away) + 1e-150;
    if (sum > bound) return 1;
    if (-sum > bound) return -1;
    return slrt_side_meets_exact(eye, u, a, b, axis, value);
}

// --- A box, a cell and a sector of directions about an eye: whether they have a point in common

// All three are convex. So, by Helly's theorem, if any two of them meet, then all three meet unless
// a side of the cell, a border of the sector and a side of the box keep them apart:
//
//        side of the cell
//       -----.------------     The three half-planes have no point in common. The sign of one
//             .  empty  /      determinant says so, of the third degree as a box's sides are
//       box    .      /        axial.
//      --------.-.--/-----
//               ./  border
//
// The header and the library have this part in common. Beside slrt_point, slrt_eye and slrt_eye_at
// (box_envelope.h), slrt_ray, slrt_turn_to, slrt_ray_sign and slrt_side_meets (box_sieve.h), they
// say before it what these are:
//
//     slrt_vertex        a corner of a cell, by its number in the map
//     slrt_way_turn      which way a ray goes across the way from a to b: 1 to its left, -1 to its
//                        right, 0 along it; exact
//
// A box is min x, min y, max x, max y. A sector goes counter-clockwise from the ray u to the ray v,
// at most 180 degrees.

/// Whether a sector has a direction with a part upward along an axis (`up` 1), or downward (-1).
static bool slrt_sector_goes(const slrt_eye *eye, const slrt_ray *u, const slrt_ray *v, int axis,
                             int up) {
    const int of_u = up * slrt_ray_sign(eye, u, axis), of_v = up * slrt_ray_sign(eye, v, axis);
    const int turn = axis ? up : -up;
    if (of_u > 0 || of_v > 0) return true;
    return !of_u && !of_v && turn * slrt_ray_sign(eye, u, !axis) > 0 &&
           turn * slrt_ray_sign(eye, v, !axis) < 0;
}

/// Whether a box meets a sector. If not, a side of one of them lies between them.
static bool slrt_box_meets_sector(const slrt_eye *eye, const double box[4], const slrt_ray *u,
                                  const slrt_ray *v) {
    const slrt_point at = slrt_eye_at(eye);
    bool right = true, left = true;
    int k;
    if ((at.x < box[0] && !slrt_sector_goes(eye, u, v, 0, 1)) ||
        (at.x > box[2] && !slrt_sector_goes(eye, u, v, 0, -1)) ||
        (at.y < box[1] && !slrt_sector_goes(eye, u, v, 1, 1)) ||
        (at.y > box[3] && !slrt_sector_goes(eye, u, v, 1, -1)))
        return false;
    for (k = 0; k < 4 && (right || left); k++) {
        slrt_point corner;
        corner.x = box[k & 1 ? 2 : 0];
        corner.y = box[k & 2 ? 3 : 1];
        right = right && slrt_turn_to(eye, u, corner) < 0;
        left = left && slrt_turn_to(eye, v, corner) > 0;
    }
    return !right && !left;
}

/// Whether three half-planes have no point in common, any two of which have: left or right of a
/// ray (`of_ray` 1 or -1), left of a cell's side from a to b, and above or below a value along an
/// axis (`up` 1 or -1). By Farkas' lemma: the normals leave no direction free, and the corners
/// between the lines go around the wrong way.
static bool slrt_keep_apart(const slrt_eye *eye, const slrt_ray *ray, int of_ray, slrt_point a,
                            slrt_point b, int axis, int up, double value) {
    const int part = slrt_ray_sign(eye, ray, axis);
    const double from = axis ? a.y : a.x, to = axis ? b.y : b.x;
    return part && (to > from) - (to < from) == -of_ray * part &&
           slrt_way_turn(eye, ray, a, b) == -up * part &&
           part * slrt_side_meets(eye, ray, a, b, axis, value) > 0;
}

/// Whether a box has a point in common with a sector and with a cell that it meets, into which the
/// eye sees in the sector. The cell's corners are numbers from `first` on.
static bool slrt_box_meets_within(const slrt_eye *eye, const double box[4], uint32_t first,
                                  uint32_t count, const slrt_ray *u, const slrt_ray *v) {
    slrt_point a = slrt_vertex(eye, first + count - 1);
    uint32_t i;
    if (!slrt_box_meets_sector(eye, box, u, v)) return false;
    for (i = 0; i < count; i++) {
        const slrt_point b = slrt_vertex(eye, first + i);
        int axis;
        for (axis = 0; axis < 2; axis++)
            if (slrt_keep_apart(eye, u, 1, a, b, axis, 1, box[axis]) ||
                slrt_keep_apart(eye, u, 1, a, b, axis, -1, box[2 + axis]) ||
                slrt_keep_apart(eye, v, -1, a, b, axis, 1, box[axis]) ||
                slrt_keep_apart(eye, v, -1, a, b, axis, -1, box[2 + axis]))
                return false;
        a = b;
    }
    return true;
}

// --- Boxes: what of them is seen

// A search enters a cell with a sector of directions. A box in that cell is seen there if box,
// sector and cell have a point in common (box_sector.h).
//
// A box that blocks takes an open arc from the sectors of what is behind it: the directions that
// pass its inside. What of a sector is left is tested the same way. Cost: for each visit of a cell,
// the cell's boxes, times the blocking boxes that are seen past walls.

enum { SLRT_BOX_PAST_WALLS = 1, SLRT_BOX_SEEN = 2, SLRT_BOX_HIDDEN = 4 };

static bool slrt_box_holds(const sl_runtime_box *box, double x, double y) {
    return box->min_x <= x && x <= box->max_x && box->min_y <= y && y <= box->max_y;
}

static slrt_arm slrt_arm_to_corner(const slrt_search *s, const sl_runtime_box *box, int right,
                                   int top) {
    return slrt_make_arm(s->x, s->y, right ? box->max_x : box->min_x,
                         top ? box->max_y : box->min_y);
}

/// Whether a box, which reaches into a cell, has a point in that cell and in a sector in which the
/// eye sees into it.
static bool slrt_sees_box_in(const slrt_search *s, const sl_runtime_box *box, uint32_t cell,
                             const slrt_arm *u, const slrt_arm *v) {
    const sl_runtime_cell c = sl_runtime_get_cell(s->rt, cell);
    double at[4];
    slrt_read_box(box, 0, at);
    return slrt_box_meets_within(s, at, c.first_vertex, c.vertex_count, u, v);
}

/// Where the lines of sight are that a box stops.
typedef enum slrt_shadow { SLRT_NOWHERE, SLRT_IN_ARC, SLRT_ALL_ROUND_IT } slrt_shadow;

/// The directions from `right` to `left` in which a box lies, for an eye that is not within it.
/// Those between them pass its inside. Where the eye is on a side, they go along that side.
static slrt_shadow slrt_shadow_of(const slrt_search *s, const sl_runtime_box *box, slrt_arm *right,
                                  slrt_arm *left) {
    // By column and row of the eye about the box: the corners (1 right, 2 top) of the borders.
    static const unsigned char corners[3][3][2] = {
        {{1, 2}, {0, 2}, {0, 3}}, {{1, 0}, {0, 0}, {2, 3}}, {{3, 0}, {3, 1}, {2, 1}}};
    const int column = s->x <= box->min_x ? 0 : s->x >= box->max_x ? 2 : 1;
    const int row = s->y <= box->min_y ? 0 : s->y >= box->max_y ? 2 : 1;
    const unsigned char *at = corners[column][row];
    if (column == 1 && row == 1) return SLRT_ALL_ROUND_IT;
    if (slrt_box_holds(box, s->x, s->y) && (box->min_x == box->max_x || box->min_y == box->max_y))
        return SLRT_NOWHERE;
    *right = slrt_arm_to_corner(s, box, at[0] & 1, at[0] & 2);
    *left = slrt_arm_to_corner(s, box, at[1] & 1, at[1] & 2);
    return SLRT_IN_ARC;
}

/// Whether a box lies before another one, so that a line through both passes it first. Where a flat
/// box touches the other one, or the eye is within the box (`strictly`), a line comes to both in
/// one point. Then it does not hide the other one.
static bool slrt_is_before(const slrt_search *s, const sl_runtime_box *near_box,
                           const sl_runtime_box *far_box, bool strictly) {
    const bool flat_x = strictly || near_box->min_x == near_box->max_x;
    const bool flat_y = strictly || near_box->min_y == near_box->max_y;
    const double right = far_box->min_x - near_box->max_x, left = near_box->min_x - far_box->max_x;
    const double over = far_box->min_y - near_box->max_y, under = near_box->min_y - far_box->max_y;
    return ((flat_x ? right > 0 : right >= 0) && s->x <= far_box->min_x) ||
           ((flat_x ? left > 0 : left >= 0) && s->x >= far_box->max_x) ||
           ((flat_y ? over > 0 : over >= 0) && s->y <= far_box->min_y) ||
           ((flat_y ? under > 0 : under >= 0) && s->y >= far_box->max_y);
}

/// Whether all of a box is on the eye's side of a directed portal's line.
static bool slrt_is_before_portal(const slrt_search *s, const sl_runtime_box *box,
                                  uint32_t directed, bool within) {
    const unsigned char *left = s->rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 8;
    int k;
    for (k = 0; k < 4; k++)
        if (slrt_side_of_line(left + 16, left, k & 1 ? box->max_x : box->min_x,
                              k & 2 ? box->max_y : box->min_y) < (within ? 1 : 0))
            return false;
    return true;
}

/// What boxes may hide: a box, or what is behind a directed portal.
typedef struct slrt_target {
    uint32_t box; ///< SLRT_NO_ENTRY for none
    uint32_t directed;
    const uint32_t *blockers; ///< the boxes that may hide it
    uint32_t blocker_count;
} slrt_target;

/// The arc that a blocking box may take from what is seen of a target. (Of a portal that is so only
/// if slrt_is_before_portal; that takes longer to find out than whether the arc counts.)
static slrt_shadow slrt_shadow_on(const slrt_search *s, const slrt_target *target, uint32_t blocker,
                                  slrt_arm *right, slrt_arm *left) {
    const sl_runtime_box *box = &s->boxes->boxes[blocker];
    const bool within =
        box->min_x < s->x && s->x < box->max_x && box->min_y < s->y && s->y < box->max_y;
    if (target->box != SLRT_NO_ENTRY &&
        (blocker == target->box || !slrt_is_before(s, box, &s->boxes->boxes[target->box], within)))
        return SLRT_NOWHERE;
    return slrt_shadow_of(s, box, right, left);
}

static bool slrt_is_inside(const slrt_arm *v, const slrt_arm *right, const slrt_arm *left) {
    return slrt_side(right, v) > 0 && slrt_side(v, left) > 0;
}

/// Whether a box hides a direction of a target.
static slrt_shadow slrt_hides(const slrt_search *s, const slrt_target *target, uint32_t blocker,
                              const slrt_arm *direction, slrt_arm *right, slrt_arm *left) {
    const slrt_shadow shadow = slrt_shadow_on(s, target, blocker, right, left);
    if (shadow == SLRT_NOWHERE ||
        (shadow == SLRT_IN_ARC && !slrt_is_inside(direction, right, left)))
        return SLRT_NOWHERE;
    if (target->box == SLRT_NO_ENTRY &&
        !slrt_is_before_portal(s, &s->boxes->boxes[blocker], target->directed,
                               shadow == SLRT_ALL_ROUND_IT))
        return SLRT_NOWHERE;
    return shadow;
}

/// Turns `from` to the left until no box hides that direction; false if all up to `to` is hidden.
static bool slrt_skip_hidden(const slrt_search *s, const slrt_target *target, slrt_arm *from,
                             const slrt_arm *to) {
    bool moved = true;
    while (moved) {
        uint32_t i;
        moved = false;
        for (i = 0; i < target->blocker_count; i++) {
            slrt_arm right, left;
            const slrt_shadow shadow =
                slrt_hides(s, target, target->blockers[i], from, &right, &left);
            if (shadow == SLRT_NOWHERE) continue;
            if (shadow == SLRT_ALL_ROUND_IT || slrt_is_inside(to, &right, &left)) return false;
            *from = left;
            moved = true;
        }
    }
    return true;
}

/// The first shadow between two directions, borders included: moves `to` to where it starts, and
/// `next` to where it ends. False for none.
static bool slrt_find_shadow(const slrt_search *s, const slrt_target *target, const slrt_arm *from,
                             slrt_arm *to, slrt_arm *next) {
    bool found = false;
    uint32_t i;
    for (i = 0; i < target->blocker_count; i++) {
        slrt_arm right, left;
        if (slrt_shadow_on(s, target, target->blockers[i], &right, &left) != SLRT_IN_ARC ||
            slrt_same_ray(&right, &left) ||
            !slrt_within(&right, from, to, slrt_side(from, &right), slrt_side(&right, to)))
            continue;
        *to = right;
        *next = left;
        found = true;
    }
    return found;
}

/// Leaves out blockers that hide nothing between two directions.
static void slrt_choose_blockers(const slrt_search *s, slrt_target *target, const slrt_arm *from,
                                 const slrt_arm *to) {
    uint32_t *chosen = s->chosen;
    uint32_t i, count = 0;
    for (i = 0; i < target->blocker_count; i++) {
        slrt_arm right, left;
        const uint32_t blocker = target->blockers[i];
        const slrt_shadow shadow = slrt_shadow_on(s, target, blocker, &right, &left);
        if (shadow == SLRT_NOWHERE) continue;
        if (shadow == SLRT_IN_ARC && !slrt_is_inside(from, &right, &left) &&
            !slrt_within(&right, from, to, slrt_side(from, &right), slrt_side(&right, to)))
            continue;
        chosen[count++] = blocker;
    }
    target->blockers = chosen;
    target->blocker_count = count;
}

/// Whether the eye sees a box in a cell past the boxes that block, within the sector from u to v.
static bool slrt_sees_box_past(const slrt_search *s, uint32_t box, uint32_t cell, slrt_arm u,
                               const slrt_arm *v) {
    slrt_target target;
    target.box = box;
    target.directed = 0;
    target.blockers = s->blockers;
    target.blocker_count = s->blocker_count;
    if (!slrt_sees_box_in(s, &s->boxes->boxes[box], cell, &u, v)) return false;
    slrt_choose_blockers(s, &target, &u, v);
    while (slrt_skip_hidden(s, &target, &u, v)) {
        slrt_arm to = *v, next;
        const bool more = slrt_find_shadow(s, &target, &u, &to, &next);
        if (slrt_sees_box_in(s, &s->boxes->boxes[box], cell, &u, &to)) return true;
        if (!more || slrt_same_ray(&to, v) || slrt_is_inside(v, &to, &next)) return false;
        u = next;
    }
    return false;
}

/// Whether others hide all of a box, walls aside.
static bool slrt_is_hidden_box(const slrt_search *s, uint32_t box) {
    slrt_arm from, to;
    slrt_target target;
    target.box = box;
    target.directed = 0;
    target.blockers = s->blockers;
    target.blocker_count = s->blocker_count;
    if (slrt_shadow_of(s, &s->boxes->boxes[box], &from, &to) != SLRT_IN_ARC) return false;
    slrt_choose_blockers(s, &target, &from, &to);
    return !slrt_skip_hidden(s, &target, &from, &to);
}

/// Whether boxes hide all that a sector shows behind a directed portal.
static bool slrt_is_hidden_portal(const slrt_search *s, uint32_t directed,
                                  const slrt_sector *sector) {
    slrt_arm from = slrt_border(s, sector->right);
    const slrt_arm to = slrt_border(s, sector->left);
    slrt_target target;
    target.box = SLRT_NO_ENTRY;
    target.directed = directed;
    target.blockers = s->blockers;
    target.blocker_count = s->blocker_count;
    return !slrt_skip_hidden(s, &target, &from, &to);
}

/// Whether some of a box is within range.
static bool slrt_box_in_range(const slrt_search *s, const sl_runtime_box *box) {
    const double x = s->x < box->min_x   ? box->min_x - s->x
                     : s->x > box->max_x ? s->x - box->max_x
                                         : 0;
    const double y = s->y < box->min_y   ? box->min_y - s->y
                     : s->y > box->max_y ? s->y - box->max_y
                                         : 0;
    const double limit = s->range * (1 + 1e-12);
    return !(s->range > 0) || !(x * x + y * y > limit * limit);
}

/// For an eye on a wall that bounds a cell behind it: a line along that wall comes into the cell by
/// a portal farther on. Whether it meets a box from there on.
static bool slrt_meets_behind_wall(const slrt_search *s, const sl_runtime_box *box, uint32_t cell,
                                   const slrt_arm *ray) {
    const sl_runtime_cell c = sl_runtime_get_cell(s->rt, cell);
    slrt_search from = *s;
    double at[4];
    uint32_t i;
    slrt_read_box(box, 0, at);
    for (i = c.first_directed; i < c.first_directed + c.directed_count; i++) {
        const slrt_arm p = slrt_border(s, 2 * i + 1), q = slrt_border(s, 2 * i);
        const slrt_arm along = slrt_make_arm(p.to_x, p.to_y, q.to_x, q.to_y);
        const bool p_is_near = slrt_same_way(&along, ray);
        if (slrt_side(&p, &q) || !slrt_same_way(&p, &q) || slrt_is_blocked(s, i)) continue;
        if (!slrt_same_ray(&p, ray)) continue;
        from.x = p_is_near ? p.to_x : q.to_x;
        from.y = p_is_near ? p.to_y : q.to_y;
        if (slrt_box_meets_sector(&from, at, ray, ray)) return true;
    }
    return false;
}

static bool slrt_sees_box(const slrt_search *s, uint32_t box, uint32_t cell,
                          const slrt_sector *sector) {
    const sl_runtime_box *at = &s->boxes->boxes[box];
    slrt_arm u, v;
    if (!slrt_box_in_range(s, at)) return false;
    if (sector->right != SLRT_ALL_ROUND) {
        u = slrt_border(s, sector->right);
        v = slrt_border(s, sector->left);
    } else if (!s->is_hidden || slrt_box_holds(at, s->x, s->y)) {
        return true;
    } else {
        slrt_shadow_of(s, at, &u, &v);
    }
    if (!(s->marks[cell] & SLRT_OWN) && slrt_same_ray(&u, &v) &&
        slrt_holds(s->rt, cell, s->x, s->y) && !slrt_meets_behind_wall(s, at, cell, &u))
        return false;
    return s->is_hidden ? slrt_sees_box_past(s, box, cell, u, &v)
                        : slrt_sees_box_in(s, at, cell, &u, &v);
}

/// Marks the boxes that are seen in a cell, through a sector.
static void slrt_meet_boxes(slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    const unsigned char wanted = s->is_hidden ? SLRT_BOX_PAST_WALLS : 0;
    const unsigned char found = s->is_hidden ? SLRT_BOX_SEEN : SLRT_BOX_PAST_WALLS;
    uint32_t at = *slrt_first_entry(s->boxes, cell);
    while (at != SLRT_NO_ENTRY) {
        const uint32_t *entry = slrt_entry(s->boxes, at);
        unsigned char *mark = s->box_marks + entry[SLRT_ENTRY_BOX];
        if (*mark == wanted && slrt_sees_box(s, entry[SLRT_ENTRY_BOX], cell, sector)) *mark = found;
        at = entry[SLRT_ENTRY_IN_CELL];
    }
}

// --- The boundary of a cell, piece by piece

/// No directed portal: a wall, or the border of the map. Also: no border, but a piece's own end.
#define SLRT_NONE UINT32_MAX

/// A piece of a cell's boundary, counter-clockwise from a to b.
typedef struct slrt_piece {
    double a[2], b[2];
    uint32_t directed; ///< the portal, if it is one
} slrt_piece;

/// A walk around a cell, counter-clockwise, some times from a portal's left end to there again.
typedef struct slrt_walk {
    sl_runtime_cell cell;
    uint32_t stop;       ///< the portal at which a lap ends; SLRT_NONE in a cell without portals
    uint32_t next;       ///< the next portal
    bool is_here;        ///< it is on this side, ahead
    uint32_t side, laps; ///< the side that `at` lies on, and the laps to do
    uint32_t corners;    ///< to pass at most: a bound for files that are not sound
    double at[2], a[2], b[2]; ///< the side goes from a to b
} slrt_walk;

/// A polygon as it grows, and the part of the view about the eye that is being looked at.
typedef struct slrt_polygon {
    slrt_search s;
    bool broken; ///< the file is not sound, or the search takes too long
    double *points;
    uint32_t room, written;
    uint32_t count;           ///< of points, before a range cuts the polygon
    double first[2], last[2]; ///< of these
    double second[2];         ///< with a range: the edge to it waits until the polygon closes
    bool second_is_radial, waits;
    bool has_arc; ///< an arc is begun, from `arc` to `arc_end`
    double arc[2], arc_end[2];
    bool pending;           ///< the end of the last piece is not added yet
    slrt_piece piece;       ///< that piece
    uint32_t piece_left;    ///< the border where it ends, or SLRT_NONE for
    double piece_end[2];    ///< this place
    slrt_piece first_piece; ///< that starts at the first point
    bool first_is_short;    ///< it is shorter than a step of doubles
    bool inside;            ///< the eye lies within its cell
    uint32_t fan_first;     ///< the cell where the way around the eye starts
    bool fan_is_closed;     ///< it leads back to that cell
    bool gap;               ///< the eye lies on a wall, which hides some directions
    double fan_right[2];    ///< if it is not closed: where walls end it, and may be one wall
    double fan_left[2];
    bool in_sector;       ///< only what is between these borders is looked at
    uint32_t right, left; ///< borders of the sector
    bool second_lap, started, done;
    uint32_t fan_at, fan_last; ///< the number of the piece of the fan, and of the last one seen
    uint32_t fan_cell;         ///< its cell
    /// For cells that are entered, and in place of adding a wall; NULL for none. By these a program
    /// that asks for no boxes and mirrors is built without what is only for them.
    void (*meet)(struct slrt_polygon *p, uint32_t cell);
    void (*see_wall)(struct slrt_polygon *p, uint32_t cell, const slrt_piece *piece, uint32_t right,
                     uint32_t left);
    void *job; ///< theirs
} slrt_polygon;

static void slrt_read_vertex(const sl_runtime *rt, const sl_runtime_cell *cell, uint32_t corner,
                             double *out) {
    sl_runtime_get_vertex(rt, cell->first_vertex + corner, &out[0], &out[1]);
}

/// Reads the left (0) or right (1) end of a directed portal.
static void slrt_read_end(const sl_runtime *rt, uint32_t directed, int right, double *out) {
    const unsigned char *at =
        rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 8 + 16 * right;
    out[0] = slrt_f64(at);
    out[1] = slrt_f64(at + 8);
}

static bool slrt_same_place(const double *a, const double *b) {
    return a[0] == b[0] && a[1] == b[1];
}

static bool slrt_is_between(double a, double value, double b) {
    return (a <= value && value <= b) || (b <= value && value <= a);
}

static int slrt_turn(const double *a, const double *b, const double *c) {
    const slrt_arm along = slrt_make_arm(a[0], a[1], b[0], b[1]);
    const slrt_arm to = slrt_make_arm(a[0], a[1], c[0], c[1]);
    return slrt_side(&along, &to);
}

/// Whether a point is in the box of the segment from a to b: on it, if that is axial.
static bool slrt_is_on(const double *a, const double *b, const double *point) {
    return slrt_is_between(a[0], point[0], b[0]) && slrt_is_between(a[1], point[1], b[1]);
}

/// Whether a seam is along all of the way from p to q. Files say on which seams portals are, but
/// not walls.
static bool slrt_seam_covers(const sl_runtime *rt, uint32_t number, const double *p,
                             const double *q) {
    const unsigned char *seam = rt->seams + (size_t)number * 40;
    double a[2], b[2];
    int i;
    for (i = 0; i < 2; i++) {
        a[i] = slrt_f64(seam + 8 * i);
        b[i] = slrt_f64(seam + 16 + 8 * i);
    }
    return slrt_is_on(a, b, p) && slrt_is_on(a, b, q) && !slrt_turn(a, b, p) && !slrt_turn(a, b, q);
}

/// Whether a seam is a shut door, glass, or a wall that stops steps.
static bool slrt_seam_stops_steps(const slrt_search *s, uint32_t number) {
    const unsigned char *seam = s->rt->seams + (size_t)number * 40;
    const uint32_t kind = slrt_u32(seam + 32);
    return kind == 2 || (kind == 1 && s->shut && s->shut[slrt_u32(seam + 36)]) ||
           (slrt_seam_stops(s->rt, number) & SL_RUNTIME_STOPS_STEPS) != 0;
}

/// Whether something along a passage stops steps, which pass its wall. Time: the seams.
static bool slrt_is_passage_barred(const slrt_search *s, uint32_t passage) {
    double right[2], left[2];
    uint32_t i;
    slrt_read_passage(s->rt, passage, right, left);
    for (i = 0; i < s->rt->seam_count; i++)
        if (slrt_seam_stops_steps(s, i) && slrt_seam_covers(s->rt, i, right, left)) return true;
    return false;
}

static uint32_t slrt_next_corner(const sl_runtime_cell *cell, uint32_t corner) {
    return corner + 1 < cell->vertex_count ? corner + 1 : 0;
}

/// Whether a side of a cell is a portal, in a file with a grid: a portal is a whole side there.
static bool slrt_is_portal_side(const sl_runtime *rt, const sl_runtime_cell *cell, uint32_t side) {
    return slrt_u32(rt->neighbours + ((size_t)cell->first_vertex + side) * 4) == UINT32_MAX;
}

/// The side of a cell that a portal is on. Without a grid, all walls are axial.
static uint32_t slrt_side_of_portal(slrt_polygon *p, const sl_runtime_cell *cell,
                                    uint32_t directed) {
    const sl_runtime *rt = p->s.rt;
    uint32_t before = directed - cell->first_directed, side;
    double left[2], right[2], a[2], b[2];
    slrt_read_end(rt, directed, 0, left);
    slrt_read_end(rt, directed, 1, right);
    for (side = 0; side < cell->vertex_count; side++) {
        if (rt->neighbours) {
            if (slrt_is_portal_side(rt, cell, side) && !before--) return side;
            continue;
        }
        slrt_read_vertex(rt, cell, side, a);
        slrt_read_vertex(rt, cell, slrt_next_corner(cell, side), b);
        if (slrt_is_on(a, b, right) && slrt_is_on(a, b, left)) return side;
    }
    p->broken = true;
    return 0;
}

/// Whether the next portal of a walk is on this side, and not before its place.
static bool slrt_walk_is_at_portal(const slrt_polygon *p, const slrt_walk *w) {
    const int axis = w->a[0] == w->b[0];
    double left[2], right[2];
    if (w->stop == SLRT_NONE) return false;
    if (p->s.rt->neighbours)
        return slrt_same_place(w->at, w->a) && slrt_is_portal_side(p->s.rt, &w->cell, w->side);
    slrt_read_end(p->s.rt, w->next, 1, right);
    if (w->a[axis] < w->b[axis] ? right[axis] < w->at[axis] : right[axis] > w->at[axis])
        return false;
    slrt_read_end(p->s.rt, w->next, 0, left);
    return slrt_is_on(w->a, w->b, right) && slrt_is_on(w->a, w->b, left);
}

/// Goes on to the next side.
static void slrt_walk_turn(slrt_polygon *p, slrt_walk *w) {
    if (!w->corners) p->broken = true;
    w->corners--;
    w->side = slrt_next_corner(&w->cell, w->side);
    memcpy(w->a, w->b, sizeof w->a);
    slrt_read_vertex(p->s.rt, &w->cell, slrt_next_corner(&w->cell, w->side), w->b);
    w->is_here = slrt_walk_is_at_portal(p, w);
}

/// Goes on with a walk behind a portal.
static void slrt_walk_pass(slrt_polygon *p, slrt_walk *w, uint32_t portal) {
    const uint32_t first = w->cell.first_directed;
    w->next = portal + 1 < first + w->cell.directed_count ? portal + 1 : first;
    slrt_read_end(p->s.rt, portal, 0, w->at);
    if (slrt_same_place(w->at, w->b))
        slrt_walk_turn(p, w);
    else
        w->is_here = slrt_walk_is_at_portal(p, w);
}

/// Starts a walk behind a portal on a known side. In a cell without portals it starts at a corner.
static void slrt_walk_start(slrt_polygon *p, slrt_walk *w, uint32_t stop, uint32_t passed,
                            uint32_t side, uint32_t laps) {
    w->stop = stop;
    w->side = side;
    w->laps = laps;
    w->corners = (laps + 1) * w->cell.vertex_count;
    slrt_read_vertex(p->s.rt, &w->cell, side, w->a);
    slrt_read_vertex(p->s.rt, &w->cell, slrt_next_corner(&w->cell, side), w->b);
    if (stop != SLRT_NONE) {
        slrt_walk_pass(p, w, passed);
        return;
    }
    memcpy(w->at, w->a, sizeof w->at);
    w->is_here = false;
}

/// Starts a walk all around a cell, from its first portal on.
static void slrt_walk_around(slrt_polygon *p, slrt_walk *w, uint32_t cell, uint32_t laps) {
    w->cell = sl_runtime_get_cell(p->s.rt, cell);
    if (w->cell.directed_count) {
        const uint32_t first = w->cell.first_directed;
        slrt_walk_start(p, w, first, first, slrt_side_of_portal(p, &w->cell, first), laps);
    } else {
        slrt_walk_start(p, w, SLRT_NONE, SLRT_NONE, 0, laps);
    }
}

static void slrt_end_piece_at(slrt_walk *w, const double *end, slrt_piece *piece) {
    memcpy(piece->a, w->at, sizeof piece->a);
    memcpy(piece->b, end, sizeof piece->b);
    memcpy(w->at, end, sizeof w->at);
    piece->directed = SLRT_NONE;
}

/// Takes the next piece of the boundary, to a corner, to a portal, or of a portal.
static void slrt_walk_step(slrt_polygon *p, slrt_walk *w, slrt_piece *piece) {
    double end[2];
    if (!w->is_here) {
        slrt_end_piece_at(w, w->b, piece);
        slrt_walk_turn(p, w);
        if (w->stop == SLRT_NONE && !w->side) w->laps--;
        return;
    }
    slrt_read_end(p->s.rt, w->next, 1, end);
    if (!slrt_same_place(w->at, end)) {
        slrt_end_piece_at(w, end, piece);
        return;
    }
    slrt_read_end(p->s.rt, w->next, 0, end);
    slrt_end_piece_at(w, end, piece);
    piece->directed = w->next;
    if (w->next == w->stop) w->laps--;
    if (w->laps) slrt_walk_pass(p, w, w->next);
}

/// Takes the next piece that is not just a point; false at the end.
static bool slrt_walk_next(slrt_polygon *p, slrt_walk *w, slrt_piece *piece) {
    do {
        if (!p->s.patience) p->broken = true;
        if (!w->laps || p->broken) return false;
        p->s.patience--;
        slrt_walk_step(p, w, piece);
    } while (slrt_same_place(piece->a, piece->b));
    return true;
}

// --- A line from cell to cell

// Nearly always the line from an eye to a point leaves each cell within one portal, until it comes
// to the cell of the point, or to a wall:
//
//     +--------+---------+     The portal by which the line leaves a cell, and then on which side
//     | eye *--|----* .. |     of that portal the point is: before it, the line arrives; behind
//     +--------+---------+     it, the line goes on.
//
// Where the line touches an end of a portal, or an end of the line is on a side, it may go on in
// several cells. Then all cells are followed that it comes to by portals that it meets.
//
// Of all these ways the one counts that passes the fewest limited walls. Those that the eye is on
// do not count for the cells about it.

/// Replaces a number that is too small for a map by 0, as its products would underflow.
static double slrt_no_dust(double number) {
    return number > -1e-200 && number < 1e-200 ? 0 : number;
}

/// Puts an eye, or who walks, at a place. False outside and in solid ground.
static bool slrt_place_eye(slrt_search *s, const sl_runtime *rt, double x, double y,
                           const unsigned char *shut) {
    memset(s, 0, sizeof *s);
    s->rt = rt;
    s->shut = shut;
    s->x = slrt_no_dust(x);
    s->y = slrt_no_dust(y);
    s->eye_cell = sl_runtime_locate(rt, s->x, s->y);
    return s->eye_cell != SL_RUNTIME_NO_CELL && !sl_runtime_is_solid(rt, s->eye_cell);
}

/// Where the line from the eye to a point leads.
typedef enum slrt_finding { SLRT_STOPS, SLRT_ARRIVES, SLRT_TOUCHES } slrt_finding;

static uint32_t slrt_cell_across(const sl_runtime *rt, uint32_t directed) {
    return slrt_u32(rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 4);
}

/// The sign of a turn from a directed portal to a point: 1 for the side that its cell is on.
static int slrt_side_of_portal_line(const sl_runtime *rt, uint32_t directed, double x, double y) {
    const unsigned char *left = rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 8;
    return slrt_side_of_line(left + 16, left, x, y);
}

/// Whether a line passes between two places of the file (SLRT_ARRIVES), or touches one of them.
static slrt_finding slrt_passes(const slrt_search *s, const slrt_arm *way,
                                const unsigned char *right, const unsigned char *left) {
    const slrt_arm p = slrt_make_arm(s->x, s->y, slrt_f64(right), slrt_f64(right + 8));
    const int side = slrt_side(way, &p);
    slrt_arm q;
    int other;
    if (side > 0) return SLRT_STOPS;
    q = slrt_make_arm(s->x, s->y, slrt_f64(left), slrt_f64(left + 8));
    other = slrt_side(way, &q);
    if (other < 0) return SLRT_STOPS;
    return side && other ? SLRT_ARRIVES : SLRT_TOUCHES;
}

/// The directed portal between whose ends a line leaves a cell, which it has entered likewise;
/// SLRT_NONE for none. `touches` is set if it then leaves at the end of one.
static uint32_t slrt_way_out(const slrt_search *s, const slrt_arm *way, uint32_t cell,
                             bool *touches) {
    const sl_runtime_cell c = sl_runtime_get_cell(s->rt, cell);
    uint32_t i;
    *touches = false;
    for (i = c.first_directed; i < c.first_directed + c.directed_count; i++) {
        const unsigned char *portal = s->rt->directed + (size_t)i * SLRT_DIRECTED_BYTES;
        const slrt_finding found = slrt_passes(s, way, portal + 24, portal + 8);
        if (found == SLRT_ARRIVES) return i;
        if (found == SLRT_TOUCHES) *touches = true;
    }
    return SLRT_NONE;
}

/// A way out of a cell: the cell that it leads to, and its ends as crossed.
typedef struct slrt_exit {
    uint32_t cell; ///< SLRT_NONE for no way out
    bool is_blocked, is_limited;
    const unsigned char *right, *left;
} slrt_exit;

/// As slrt_way_out, for walls that steps pass. A shut door on one bars it.
static void slrt_passage_out(const slrt_search *s, const slrt_arm *way, uint32_t cell,
                             slrt_exit *out, bool *touches) {
    const sl_runtime *rt = s->rt;
    uint32_t i = slrt_next_way(rt, cell, slrt_first_passage(rt, cell));
    for (; i < rt->passage_count; i = slrt_next_way(rt, cell, i + 1)) {
        const unsigned char *at = rt->passages + (size_t)i * SLRT_PASSAGE_BYTES;
        slrt_finding found;
        out->right = slrt_passage_end(rt, i, 0);
        out->left = slrt_passage_end(rt, i, 1);
        found = slrt_passes(s, way, out->right, out->left);
        if (found == SLRT_ARRIVES) {
            out->cell = slrt_u32(at + 8);
            out->is_blocked = slrt_is_passage_barred(s, i);
            return;
        }
        if (found == SLRT_TOUCHES) *touches = true;
    }
}

/// The way by which a line leaves a cell.
static slrt_exit slrt_exit_of(const slrt_search *s, const slrt_arm *way, uint32_t cell,
                              bool *touches) {
    const uint32_t directed = slrt_way_out(s, way, cell, touches);
    const unsigned char *portal;
    slrt_exit out;
    out.cell = SLRT_NONE;
    out.is_blocked = out.is_limited = false;
    if (directed == SLRT_NONE) {
        if (s->on_foot && s->rt->passage_count && !*touches)
            slrt_passage_out(s, way, cell, &out, touches);
        return out;
    }
    portal = s->rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES;
    out.cell = slrt_cell_across(s->rt, directed);
    out.is_blocked = slrt_is_blocked(s, directed);
    out.is_limited = !s->on_foot && slrt_is_limited(s->rt, directed);
    out.right = portal + 24;
    out.left = portal + 8;
    return out;
}

/// Follows a line as long as it passes between ends of portals. A wall or a shut door that it comes
/// to, or a box, stops it.
static slrt_finding slrt_follow_within(const slrt_search *s, const slrt_arm *way) {
    uint32_t cell = s->eye_cell, steps = s->rt->loose ? 0 : s->rt->cell_count;
    bool limited = false;
    if (slrt_place_in(s->rt, cell, s->x, s->y) <= 0) return SLRT_TOUCHES;
    for (; steps; steps--) {
        bool touches;
        const slrt_exit out = slrt_exit_of(s, way, cell, &touches);
        int place;
        if (s->stops && s->stops(s, way, cell)) return SLRT_STOPS;
        if (touches) return SLRT_TOUCHES;
        place = out.cell == SLRT_NONE
                    ? slrt_place_in(s->rt, cell, way->to_x, way->to_y)
                    : slrt_side_of_line(out.right, out.left, way->to_x, way->to_y);
        if (place > 0) return SLRT_ARRIVES;
        if (!place) return SLRT_TOUCHES;
        if (out.cell == SLRT_NONE || out.is_blocked || (limited && out.is_limited))
            return SLRT_STOPS;
        limited = limited || out.is_limited;
        cell = out.cell;
    }
    return SLRT_TOUCHES;
}

/// Whether the eye is on a directed portal, ends included.
static bool slrt_is_on_portal(const slrt_search *s, uint32_t directed) {
    const slrt_arm p = slrt_border(s, 2 * directed + 1), q = slrt_border(s, 2 * directed);
    return !slrt_same_way(&p, &q) && !slrt_side(&p, &q);
}

/// Adds the row of a cell to the cells that the search may enter.
static void slrt_allow_row(slrt_search *s, uint32_t cell) {
    sl_runtime_run run = sl_runtime_row(s->rt, cell);
    uint32_t i;
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++) s->marks[i] |= SLRT_IN_ROW;
}

/// Allows the rows of the cells at glass that the eye is in line with. A line along it may cross it
/// as rows do not know it; after the last such portal, they know all of it.
static void slrt_allow_rows_in_line(slrt_search *s) {
    const sl_runtime *rt = s->rt;
    uint32_t i;
    for (i = 0; i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12;
        const unsigned char *seam = rt->seams + (size_t)slrt_u32(on + 4) * 40;
        const unsigned char *portal = rt->portals + (size_t)slrt_u32(on) * SLRT_PORTAL_BYTES;
        if (slrt_u32(seam + 32) != 2 || slrt_side_of_line(seam, seam + 16, s->x, s->y)) continue;
        slrt_allow_row(s, slrt_u32(portal)); // empty for what is no cell
        slrt_allow_row(s, slrt_u32(portal + 4));
    }
}

/// Whether two ranges of numbers, each with its ends in any order, have a number in common.
static bool slrt_overlap(double a, double b, double c, double d) {
    return (a < b ? b : a) >= (c < d ? c : d) && (c < d ? d : c) >= (a < b ? a : b);
}

/// Whether the way from the eye to a point meets a directed portal, ends included.
static bool slrt_way_meets(const slrt_search *s, const slrt_arm *way, uint32_t directed) {
    const slrt_arm p = slrt_border(s, 2 * directed + 1), q = slrt_border(s, 2 * directed);
    const int right = slrt_side(way, &p), left = slrt_side(way, &q);
    if (right * left > 0) return false;
    if (!right && !left)
        return slrt_overlap(s->x, way->to_x, p.to_x, q.to_x) &&
               slrt_overlap(s->y, way->to_y, p.to_y, q.to_y);
    return slrt_side(&p, &q) * slrt_side_of_portal_line(s->rt, directed, way->to_x, way->to_y) <= 0;
}

/// Of so many cells, a list is faster than marks, which have to be cleared first.
enum { SLRT_FEW_CELLS = 32 };

static bool slrt_is_listed(const slrt_search *s, uint32_t cell) {
    uint32_t i;
    if (s->has_marks) return (s->marks[cell] & SLRT_OWN) != 0;
    for (i = 0; i < s->own_count && s->path[i] != cell; i++) {
    }
    return i < s->own_count;
}

/// Until the search starts, the path is the list.
static void slrt_list(slrt_search *s, uint32_t cell) {
    uint32_t i = s->own_count;
    s->path[s->own_count++] = cell;
    if (!s->has_marks && s->own_count < SLRT_FEW_CELLS) return;
    if (!s->has_marks) {
        memset(s->marks, 0, s->rt->cell_count);
        s->has_marks = true;
        i = 0;
    }
    for (; i < s->own_count; i++) s->marks[s->path[i]] |= SLRT_OWN;
}

/// Which portals are gone through.
enum { SLRT_NOT_LIMITED = 1, SLRT_ONLY_LIMITED = 2, SLRT_ANY = 3 };

/// Lists the cells behind the open portals of a cell that a way meets, NULL for the way that is the
/// eye alone.
static void slrt_list_behind(slrt_search *s, const slrt_arm *way, uint32_t cell, int which) {
    const sl_runtime_cell c = sl_runtime_get_cell(s->rt, cell);
    uint32_t i;
    for (i = c.first_directed; i < c.first_directed + c.directed_count; i++) {
        const uint32_t to = slrt_cell_across(s->rt, i);
        if (!(way ? slrt_way_meets(s, way, i) : slrt_is_on_portal(s, i)) || slrt_is_listed(s, to) ||
            slrt_is_blocked(s, i))
            continue;
        if (which != SLRT_ANY && (which == SLRT_ONLY_LIMITED) != slrt_is_limited(s->rt, i))
            continue;
        slrt_list(s, to);
        if (s->has_row) slrt_allow_row(s, to);
    }
}

/// As slrt_follow, in a file with limited walls: first the cells about the eye, then those that the
/// way leads to, then those behind a limited wall.
static bool slrt_follow_limited(slrt_search *s, const slrt_arm *way) {
    uint32_t at, first;
    int passed;
    slrt_list(s, s->eye_cell);
    for (at = 0; at < s->own_count; at++) slrt_list_behind(s, NULL, s->path[at], SLRT_ANY);
    for (passed = 0, first = 0; passed < 2; passed++) {
        for (at = first; at < s->own_count; at++) {
            if (s->stops && s->stops(s, way, s->path[at])) return false;
            if (slrt_holds(s->rt, s->path[at], way->to_x, way->to_y)) return true;
            slrt_list_behind(s, way, s->path[at], SLRT_NOT_LIMITED);
        }
        first = s->own_count;
        for (at = 0; at < first && !passed; at++)
            slrt_list_behind(s, way, s->path[at], SLRT_ONLY_LIMITED);
    }
    return false;
}

/// Lists the eye's cell and those that it leads to through all open portals that a way meets, until
/// a cell touches the end of the way: then true. NULL for the way that is the eye alone: the cells
/// are the eye's, and their rows count.
static bool slrt_follow(slrt_search *s, const slrt_arm *way) {
    uint32_t at;
    if (way && s->rt->has_limits) return slrt_follow_limited(s, way);
    slrt_list(s, s->eye_cell);
    for (at = 0; at < s->own_count; at++) {
        if (s->stops && s->stops(s, way, s->path[at])) return false;
        if (way && slrt_holds(s->rt, s->path[at], way->to_x, way->to_y)) return true;
        slrt_list_behind(s, way, s->path[at], SLRT_ANY);
    }
    return false;
}

// --- Eye-to-cell: the search through portals

/// Enters a cell, unless that gives nothing new. A line passes a convex cell once. So a cell on the
/// path was seen through a wider sector, and a cell that was entered with a wider one needs no
/// second visit.
static void slrt_enter(slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    uint32_t *top = s->path + 4 * (size_t)s->depth;
    unsigned char *marks = s->marks + cell;
    if (s->has_row && !(*marks & SLRT_IN_ROW)) return;
    if (*marks & SLRT_ON_PATH) return;
    if (*marks & SLRT_ENTERED && slrt_covered(s, cell, sector)) return;
    slrt_see(s, cell);
    if (s->meet) s->meet(s, cell, sector);
    *marks = (unsigned char)((*marks & ~(unsigned)(SLRT_ALONG | SLRT_LIMITED)) | SLRT_ENTERED |
                             SLRT_ON_PATH | sector->along | sector->limited);
    s->sectors[2 * (size_t)cell] = sector->right;
    s->sectors[2 * (size_t)cell + 1] = sector->left;
    top[0] = cell;
    top[1] = 0;
    top[2] = sector->right;
    top[3] = sector->left;
    s->depth++;
}

static void slrt_see_row(slrt_search *s) {
    uint32_t i;
    s->gave_up = true;
    for (i = 0; i < s->rt->cell_count; i++)
        if (!s->has_row || s->marks[i] & SLRT_IN_ROW) slrt_see(s, i);
}

/// Takes the next directed portal of the cell on top of the path. Each of the eye's cells is the
/// start of a search: none leads there.
static void slrt_search_on(slrt_search *s, uint32_t *top, uint32_t directed) {
    const uint32_t to = slrt_cell_across(s->rt, directed);
    slrt_sector sector;
    if (s->marks[to] & SLRT_OWN) return;
    sector.right = top[2];
    sector.left = top[3];
    sector.along = s->marks[top[0]] & SLRT_ALONG;
    sector.limited = 0;
    if (s->rt->has_limits) {
        const bool limited = slrt_is_limited(s->rt, directed);
        sector.limited = s->marks[top[0]] & SLRT_LIMITED;
        if (limited && sector.limited) return;
        if (limited) sector.limited = SLRT_LIMITED;
    }
    if (slrt_is_blocked(s, directed) || !slrt_narrow(s, directed, &sector)) return;
    if (s->range > 0 && !slrt_in_range(s, directed, sector.right, sector.left)) return;
    if (s->is_hidden && s->is_hidden(s, directed, &sector)) return;
    slrt_enter(s, to, &sector);
}

/// Whether a sector leads into a cell of the eye's: some of its directions enter the cell, or run
/// along its border. Either the first direction of the sector does, or the sector has the first one
/// of the cell, which is along a side at the eye.
static bool slrt_leads_into(const slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    const sl_runtime_cell c = sl_runtime_get_cell(s->rt, cell);
    const unsigned char *a = s->rt->vertices + (size_t)c.first_vertex * SLRT_VERTEX_BYTES;
    const unsigned char *b = a + (size_t)(c.vertex_count - 1) * SLRT_VERTEX_BYTES;
    slrt_arm u, v, p, side;
    bool enters = true;
    uint32_t i;
    if (sector->right == SLRT_ALL_ROUND) return true;
    u = slrt_border(s, sector->right);
    v = slrt_border(s, sector->left);
    for (i = 0; i < c.vertex_count; i++, b = a, a += SLRT_VERTEX_BYTES) {
        if (slrt_side_of_line(b, a, s->x, s->y)) continue;
        p = slrt_make_arm(s->x, s->y, slrt_f64(a), slrt_f64(a + 8));
        if (slrt_within(&p, &u, &v, slrt_side(&u, &p), slrt_side(&p, &v))) return true;
        side = slrt_make_arm(slrt_f64(b), slrt_f64(b + 8), slrt_f64(a), slrt_f64(a + 8));
        if (slrt_side(&side, &u) < 0) enters = false;
    }
    return enters;
}

static void slrt_search_from(slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    if (s->is_image || slrt_leads_into(s, cell, sector))
        slrt_enter(s, cell, sector);
    else if (s->in_mirrors)
        s->meet(s, cell, sector); // an eye on a mirror looks into it
    while (s->depth) {
        uint32_t *top = s->path + 4 * (size_t)(s->depth - 1);
        const sl_runtime_cell c = sl_runtime_get_cell(s->rt, top[0]);
        if (top[1] == c.directed_count) {
            s->marks[top[0]] &= (unsigned char)~SLRT_ON_PATH;
            s->depth--;
        } else if (!s->patience) {
            slrt_see_row(s);
            s->depth = 0;
        } else {
            s->patience--;
            slrt_search_on(s, top, c.first_directed + top[1]++);
        }
    }
}

static bool slrt_is_direction(const double *d) {
    const double larger = slrt_larger(d[0], d[1]);
    return d[0] == d[0] && d[1] == d[1] && larger >= 1e-150 && larger <= 1e150;
}

static slrt_arm slrt_direction(double x, double y) {
    return slrt_make_arm(0, 0, slrt_no_dust(x), slrt_no_dust(y));
}

SL_RUNTIME_API size_t sl_runtime_scratch_count(const sl_runtime *runtime) {
    return (size_t)runtime->cell_count * 6 + ((size_t)runtime->cell_count + 3) / 4;
}

/// Cuts the view cone into pieces of less than 180 degrees between the arms of `cone`. 0 for a view
/// all round; `last` is the arm where the last piece ends.
static uint32_t slrt_cut_cone(slrt_search *s, uint32_t *last) {
    const double *right = s->view->right, *left = s->view->left;
    if (s->view->all_round || !slrt_is_direction(right) || !slrt_is_direction(left)) return 0;
    s->cone[0] = slrt_direction(right[0], right[1]);
    s->cone[1] = slrt_direction(-right[1], right[0]);
    s->cone[2] = slrt_direction(-right[0], -right[1]);
    s->cone[3] = slrt_direction(left[0], left[1]);
    *last = 3;
    return slrt_side(&s->cone[0], &s->cone[3]) > 0 || slrt_same_ray(&s->cone[0], &s->cone[3]) ? 1
                                                                                              : 3;
}

/// Looks within the view cone, in pieces. The part of a piece that leaves through a directed portal
/// is one sector. All round, each directed portal is such a piece.
static void slrt_search_cone(slrt_search *s, uint32_t cell) {
    uint32_t i, last = 0;
    const uint32_t pieces = slrt_cut_cone(s, &last);
    slrt_sector sector;
    sector.right = sector.left = SLRT_ALL_ROUND;
    sector.along = 0;
    sector.limited = 0;
    if (!pieces) slrt_search_from(s, cell, &sector);
    for (i = 0; i < pieces; i++) {
        sector.right = SLRT_ARM + i;
        sector.left = SLRT_ARM + (i + 1 < pieces ? i + 1 : last);
        slrt_search_from(s, cell, &sector);
    }
}

/// The smaller one of a caller's range and the map's own; 0 for no limit.
static double slrt_range(const sl_runtime *rt, double range) {
    return range > 0 && !(rt->range > 0 && rt->range < range) ? range : rt->range;
}

SL_RUNTIME_API uint32_t sl_runtime_look(const sl_runtime *runtime, const sl_runtime_view *view,
                                        uint32_t *scratch, uint32_t *cells, uint32_t room) {
    return sl_runtime_look_past(runtime, view, NULL, 0, scratch, cells, room);
}

/// Prepares a search. False if the eye sees nothing.
static bool slrt_start_search(slrt_search *s, const sl_runtime *rt, const sl_runtime_view *view,
                              const unsigned char *shut, double range, uint32_t *scratch) {
    const size_t count = rt->cell_count;
    const bool sees = slrt_place_eye(s, rt, view->x, view->y, shut);
    s->view = view;
    s->range = slrt_range(rt, range);
    s->path = scratch;
    s->sectors = scratch + 4 * count;
    s->marks = (unsigned char *)(scratch + 6 * count);
    return sees;
}

/// The cells that the eye stands in, once they are found. If there are more than one, none of these
/// is entered from another cell. So the path has room for them behind it.
static uint32_t *slrt_own_cells(const slrt_search *s) {
    return s->path + 4 * (size_t)s->rt->cell_count - s->own_count;
}

static void slrt_run_search(slrt_search *s) {
    sl_runtime_run run = sl_runtime_row(s->rt, s->eye_cell);
    uint32_t i;
    s->count = s->own_count = 0;
    s->patience = SLRT_PATIENCE * ((uint64_t)s->rt->directed_count + 16);
    memset(s->marks, 0, s->rt->cell_count);
    s->has_marks = true;
    s->has_row = run.next != run.stop;
    while (sl_runtime_next(&run)) memset(s->marks + run.first, SLRT_IN_ROW, run.end - run.first);
    slrt_follow(s, NULL);
    if (s->has_row && s->rt->has_glass) slrt_allow_rows_in_line(s);
    for (i = s->own_count; i-- > 0;) slrt_own_cells(s)[i] = s->path[i]; // upwards: from the last on
    slrt_search_cone(s, s->eye_cell);
    for (i = 1; i < s->own_count; i++) slrt_search_cone(s, slrt_own_cells(s)[i]);
}

SL_RUNTIME_API uint32_t sl_runtime_look_past(const sl_runtime *runtime, const sl_runtime_view *view,
                                             const unsigned char *shut, double range,
                                             uint32_t *scratch, uint32_t *cells, uint32_t room) {
    slrt_search s;
    if (!slrt_start_search(&s, runtime, view, shut, range, scratch)) return 0;
    s.cells = cells;
    s.room = room;
    slrt_run_search(&s);
    return s.count;
}

/// Adds to a search that has run what is seen by mirror from somewhere in a cell.
static void slrt_see_mirrored_from(slrt_search *s, const sl_runtime *rows, uint32_t cell) {
    sl_runtime_run run = sl_runtime_row(rows, cell);
    slrt_door_pairs pairs = slrt_door_pairs_of(rows, cell);
    uint32_t i;
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++)
            if (!s->shut || slrt_pair_is_open(&pairs, i, s->shut)) slrt_see(s, i);
}

/// Adds to a search that has run what the eye may see by mirror.
static void slrt_see_mirrored(slrt_search *s) {
    const sl_runtime rows = slrt_mirrored(s->rt);
    uint32_t i;
    if (s->rt->mirrors == SL_RUNTIME_MIRRORS_BAKED && s->has_row) {
        slrt_see_mirrored_from(s, &rows, s->eye_cell);
        for (i = 1; i < s->own_count; i++) slrt_see_mirrored_from(s, &rows, slrt_own_cells(s)[i]);
        return;
    }
    for (i = 0; i < s->rt->cell_count; i++)
        if (!sl_runtime_is_solid(s->rt, i)) slrt_see(s, i);
}

SL_RUNTIME_API uint32_t sl_runtime_look_mirrored(const sl_runtime *runtime,
                                                 const sl_runtime_view *view,
                                                 const unsigned char *shut, double range,
                                                 uint32_t *scratch, uint32_t *cells, uint32_t room,
                                                 uint32_t *direct) {
    slrt_search s;
    *direct = 0;
    if (!slrt_start_search(&s, runtime, view, shut, range, scratch)) return 0;
    s.cells = cells;
    s.room = room;
    slrt_run_search(&s);
    *direct = s.count;
    if (runtime->mirrors) slrt_see_mirrored(&s);
    return s.count;
}

// --- Boxes: what is asked

/// Twice the distance from the eye to a box's middle, squared.
static double slrt_away(const slrt_search *s, uint32_t box) {
    const sl_runtime_box *at = &s->boxes->boxes[box];
    const double x = at->min_x + at->max_x - 2 * s->x, y = at->min_y + at->max_y - 2 * s->y;
    return x * x + y * y;
}

/// Sorts boxes, the nearest first (Shell 1959).
static void slrt_sort_by_distance(const slrt_search *s, uint32_t *boxes, uint32_t count) {
    uint32_t gap, i, k;
    for (gap = count / 2; gap; gap = gap == 2 ? 1 : (uint32_t)(gap / 2.2))
        for (i = gap; i < count; i++) {
            const uint32_t box = boxes[i];
            const double away = slrt_away(s, box);
            for (k = i; k >= gap && slrt_away(s, boxes[k - gap]) > away; k -= gap)
                boxes[k] = boxes[k - gap];
            boxes[k] = box;
        }
}

/// Whether boxes hide all of another one: the first `front` blockers, or all of them.
static bool slrt_is_hidden_by(slrt_search *s, uint32_t box, uint32_t front) {
    const uint32_t all = s->blocker_count;
    bool hidden;
    if (s->box_marks[box] != SLRT_BOX_PAST_WALLS) return false;
    s->blocker_count = front;
    hidden = slrt_is_hidden_box(s, box);
    s->blocker_count = all;
    return hidden || slrt_is_hidden_box(s, box);
}

/// Marks the boxes that others hide wholly, walls aside. Few boxes near the eye hide most of a
/// crowd. So boxes are asked the nearest first, against those that are not hidden themselves, and
/// only then against all. Blockers that are not hidden gather at the front of the list, and are
/// what is left: what hides a box wholly also hides what is behind that box.
static void slrt_hide_boxes(slrt_search *s) {
    uint32_t i, front = 0;
    slrt_sort_by_distance(s, s->blockers, s->blocker_count);
    for (i = 0; i < s->blocker_count; i++) {
        const uint32_t box = s->blockers[i];
        if (slrt_is_hidden_by(s, box, front)) {
            s->box_marks[box] = SLRT_BOX_HIDDEN;
        } else {
            s->blockers[i] = s->blockers[front];
            s->blockers[front++] = box;
        }
    }
    for (i = 0; i < s->boxes->count; i++)
        if (!s->boxes->boxes[i].blocks && slrt_is_hidden_by(s, i, front))
            s->box_marks[i] = SLRT_BOX_HIDDEN;
    s->blocker_count = front;
}

/// The first search finds the boxes that are seen past walls. If some of them block, a second one
/// asks which of these are seen past the others, and leaves out cells that are hidden.
static void slrt_look_at_boxes(slrt_search *s) {
    const sl_runtime_boxes *boxes = s->boxes;
    uint32_t i;
    for (i = 0; i < boxes->count; i++)
        if (slrt_box_holds(&boxes->boxes[i], s->x, s->y) && slrt_is_sound_box(&boxes->boxes[i]))
            s->box_marks[i] = SLRT_BOX_SEEN;
    slrt_run_search(s);
    for (i = 0; i < boxes->count && !s->gave_up; i++)
        if (s->box_marks[i] && boxes->boxes[i].blocks) s->blockers[s->blocker_count++] = i;
    if (!s->blocker_count) return;
    s->is_hidden = slrt_is_hidden_portal;
    slrt_hide_boxes(s);
    slrt_run_search(s);
}

SL_RUNTIME_API uint32_t sl_runtime_look_past_boxes(const sl_runtime_boxes *boxes,
                                                   const sl_runtime_view *view,
                                                   const unsigned char *shut, double range,
                                                   uint32_t *boxes_scratch, unsigned char *seen,
                                                   uint32_t *cells, uint32_t room) {
    slrt_search s;
    uint32_t i;
    unsigned char wanted;
    if (boxes->count) memset(seen, 0, boxes->count);
    if (!slrt_start_search(&s, boxes->runtime, view, shut, range, boxes_scratch)) return 0;
    s.cells = cells;
    s.room = room;
    s.meet = slrt_meet_boxes;
    s.boxes = boxes;
    s.box_marks = seen;
    s.blockers = boxes_scratch + sl_runtime_scratch_count(boxes->runtime);
    s.chosen = s.blockers + boxes->count;
    slrt_look_at_boxes(&s);
    wanted = s.is_hidden ? SLRT_BOX_SEEN : SLRT_BOX_SEEN | SLRT_BOX_PAST_WALLS;
    for (i = 0; i < boxes->count; i++) {
        const uint32_t own = *slrt_own_entry(boxes, i);
        seen[i] = seen[i] & wanted || own == SLRT_EVERYWHERE || (s.gave_up && own != SLRT_NO_ENTRY);
    }
    return s.count;
}

SL_RUNTIME_API uint32_t sl_runtime_boxes_seen(const sl_runtime_boxes *boxes,
                                              const sl_runtime_view *view,
                                              const unsigned char *shut, double range,
                                              uint32_t *boxes_scratch, unsigned char *seen) {
    uint32_t i, count = 0;
    sl_runtime_look_past_boxes(boxes, view, shut, range, boxes_scratch, seen, NULL, 0);
    for (i = 0; i < boxes->count; i++) count += seen[i];
    return count;
}

// --- Point to point

/// Whether a point is within the range of the eye: the sign of an exact sum. Numbers are scaled, so
/// that no product overflows, and the range is more than any distance where it is left out.
static bool slrt_is_within(const slrt_search *s, double x, double y) {
    const double largest = slrt_larger(slrt_larger(s->x, s->y), slrt_larger(x, y));
    const double scale = slrt_scale_of(largest), range = scale * s->range;
    const double from[2] = {scale * s->x, scale * s->y}, to[2] = {scale * x, scale * y};
    double parts[14];
    int count = 0, i;
    if (range > 8) return true;
    for (i = 0; i < 2; i++) {
        count = slrt_add_product(parts, count, to[i], to[i]);
        count = slrt_add_product(parts, count, -2 * to[i], from[i]);
        count = slrt_add_product(parts, count, from[i], from[i]);
    }
    count = slrt_add_product(parts, count, -range, range);
    return !count || parts[count - 1] <= 0;
}

/// Whether a search's eye sees a point.
static bool slrt_sees_point(slrt_search *s, double point_x, double point_y) {
    const double x = slrt_no_dust(point_x), y = slrt_no_dust(point_y);
    const slrt_arm way = slrt_make_arm(s->x, s->y, x, y);
    slrt_finding found;
    if (!slrt_in_bounds(s->rt, x, y) || (s->range > 0 && !slrt_is_within(s, x, y))) return false;
    found = slrt_follow_within(s, &way);
    return found == SLRT_TOUCHES ? slrt_follow(s, &way) : found == SLRT_ARRIVES;
}

SL_RUNTIME_API bool sl_runtime_sees(const sl_runtime *runtime, double x0, double y0, double x1,
                                    double y1, const unsigned char *shut, double range,
                                    uint32_t *scratch) {
    const sl_runtime_view view = sl_runtime_view_all_round(x0, y0);
    slrt_search s;
    return slrt_start_search(&s, runtime, &view, shut, range, scratch) &&
           slrt_sees_point(&s, x1, y1);
}

// --- Whether a step passes no wall and no shut door

/// Whether the segments from a to b and from c to d have a point in common.
static bool slrt_meets(const double *a, const double *b, const double *c, const double *d) {
    int i;
    for (i = 0; i < 2; i++) {
        if (a[i] < c[i] && a[i] < d[i] && b[i] < c[i] && b[i] < d[i]) return false;
        if (a[i] > c[i] && a[i] > d[i] && b[i] > c[i] && b[i] > d[i]) return false;
    }
    return slrt_turn(a, b, c) * slrt_turn(a, b, d) <= 0 &&
           slrt_turn(c, d, a) * slrt_turn(c, d, b) <= 0;
}

/// The same for a segment of the file.
static bool slrt_touches(const double *a, const double *b, const unsigned char *segment) {
    double c[2], d[2];
    int i;
    for (i = 0; i < 2; i++) {
        c[i] = slrt_f64(segment + 8 * i);
        d[i] = slrt_f64(segment + 16 + 8 * i);
    }
    return slrt_meets(a, b, c, d);
}

static bool slrt_is_on_border(const sl_runtime *rt, const slrt_piece *piece) {
    const double *a = piece->a, *b = piece->b;
    return (a[0] == b[0] && (a[0] == rt->min_x || a[0] == rt->max_x)) ||
           (a[1] == b[1] && (a[1] == rt->min_y || a[1] == rt->max_y));
}

/// So many cells of a step that touches something are gone through.
enum { SLRT_STEP_CELLS = 32 };

/// Whether a step that touches portals' ends or sides of cells is free. All cells that it touches
/// are found through portals that it touches, up to its first wall: the cells about a point are
/// joined by portals that end there, but for walls that do. SLRT_TOUCHES where that is not known:
/// on the map's border, which may be wall in part, beside walls that steps pass, and for many
/// cells.
static slrt_finding slrt_step_by_cells(const slrt_search *s, const slrt_arm *way,
                                       const double *from, const double *to) {
    uint32_t cells[SLRT_STEP_CELLS], count = 1, i, k;
    slrt_polygon p;
    if (s->rt->loose) return SLRT_TOUCHES;
    memset(&p, 0, sizeof p);
    p.s = *s;
    p.s.patience = (uint64_t)16 * ((uint64_t)s->rt->directed_count + s->rt->vertex_count + 16);
    cells[0] = s->eye_cell;
    for (i = 0; i < count; i++) {
        slrt_walk w;
        slrt_piece piece;
        if (s->stops && s->stops(s, way, cells[i])) return SLRT_STOPS;
        slrt_walk_around(&p, &w, cells[i], 1);
        while (slrt_walk_next(&p, &w, &piece)) {
            uint32_t next;
            if (!slrt_meets(from, to, piece.a, piece.b)) continue;
            if (piece.directed == SLRT_NONE)
                return slrt_is_on_border(s->rt, &piece) || slrt_has_way(s->rt, cells[i])
                           ? SLRT_TOUCHES
                           : SLRT_STOPS;
            if (slrt_is_blocked(s, piece.directed)) return SLRT_STOPS;
            next = slrt_cell_across(s->rt, piece.directed);
            for (k = 0; k < count && cells[k] != next; k++) {
            }
            if (k < count) continue;
            if (count == SLRT_STEP_CELLS) return SLRT_TOUCHES;
            cells[count++] = next;
        }
    }
    return p.broken ? SLRT_TOUCHES : SLRT_ARRIVES;
}

/// Whether a step touches no wall, shut door, glass or box of all there are.
static bool slrt_step_by_walls(const slrt_search *s, const slrt_arm *way, const double *from,
                               const double *to) {
    const sl_runtime *rt = s->rt;
    uint32_t i;
    for (i = 0; i < rt->wall_count; i++)
        if (slrt_touches(from, to, rt->walls + (size_t)i * 32) && slrt_wall_stops_steps(rt, i))
            return false;
    for (i = 0; i < rt->seam_count; i++)
        if (slrt_seam_stops_steps(s, i) && slrt_touches(from, to, rt->seams + (size_t)i * 40))
            return false;
    for (i = 0; s->stops && i < rt->cell_count; i++)
        if (s->stops(s, way, i)) return false;
    return true;
}

/// Whether who stands at a search's eye can step to a point.
static bool slrt_can_step(slrt_search *s, double x, double y) {
    const double from[2] = {s->x, s->y}, to[2] = {slrt_no_dust(x), slrt_no_dust(y)};
    const slrt_arm way = slrt_make_arm(from[0], from[1], to[0], to[1]);
    slrt_finding found;
    if (!s->rt->walls || !slrt_in_bounds(s->rt, to[0], to[1])) return false;
    s->on_foot = true;
    found = slrt_follow_within(s, &way);
    if (found == SLRT_TOUCHES) found = slrt_step_by_cells(s, &way, from, to);
    if (found != SLRT_TOUCHES) return found == SLRT_ARRIVES;
    return sl_runtime_locate(s->rt, to[0], to[1]) != SL_RUNTIME_NO_CELL &&
           slrt_step_by_walls(s, &way, from, to);
}

SL_RUNTIME_API bool sl_runtime_can_walk(const sl_runtime *runtime, double x0, double y0, double x1,
                                        double y1, const unsigned char *shut) {
    slrt_search s;
    return slrt_place_eye(&s, runtime, x0, y0, shut) && slrt_can_step(&s, x1, y1);
}

// --- Boxes that block: points and steps past them

// A line meets a box in a cell that both have points in, so only the lists of the cells along the
// line are asked.

static bool slrt_is_in_box(const sl_runtime_box *box, double x, double y) {
    return box->min_x < x && x < box->max_x && box->min_y < y && y < box->max_y;
}

/// Whether ranges of numbers have none in common, `touch`: or just an end.
static bool slrt_is_apart(double a, double b, double low, double high, bool touch) {
    const double least = a < b ? a : b, most = a < b ? b : a;
    return touch ? most < low || least > high : most <= low || least >= high;
}

/// Whether a line passes the inside of a box; `touch`: or touches it. The inside of a flat box is
/// what lies between its ends. A line and a box are convex: if they are apart, a side of the box or
/// the line itself separates them.
static bool slrt_passes_box(const slrt_arm *way, const sl_runtime_box *box, bool touch) {
    bool left = false, right = false;
    int k;
    if (slrt_is_apart(way->from_x, way->to_x, box->min_x, box->max_x, touch) ||
        slrt_is_apart(way->from_y, way->to_y, box->min_y, box->max_y, touch))
        return false;
    for (k = 0; k < 4; k++) {
        const slrt_arm corner =
            slrt_make_arm(way->from_x, way->from_y, k & 1 ? box->max_x : box->min_x,
                          k & 2 ? box->max_y : box->min_y);
        const int side = slrt_side(way, &corner);
        left = left || side > 0 || (touch && !side);
        right = right || side < 0 || (touch && !side);
    }
    return left && right;
}

/// Whether a box in a cell stops a line of sight, or a step.
static bool slrt_is_stopped(const slrt_search *s, const slrt_arm *way, uint32_t cell) {
    uint32_t at = *slrt_first_entry(s->boxes, cell);
    for (; at != SLRT_NO_ENTRY; at = slrt_entry(s->boxes, at)[SLRT_ENTRY_IN_CELL]) {
        const uint32_t number = slrt_entry(s->boxes, at)[SLRT_ENTRY_BOX];
        const sl_runtime_box *box = &s->boxes->boxes[number];
        if (!box->blocks || number == s->except || !slrt_passes_box(way, box, s->on_foot)) continue;
        if (s->on_foot ||
            !((slrt_is_in_box(box, s->x, s->y) && slrt_box_holds(box, way->to_x, way->to_y)) ||
              (slrt_is_in_box(box, way->to_x, way->to_y) && slrt_box_holds(box, s->x, s->y))))
            return true;
    }
    return false;
}

static void slrt_heed_boxes(slrt_search *s, const sl_runtime_boxes *boxes, uint32_t except) {
    s->boxes = boxes;
    s->except = except;
    s->stops = slrt_is_stopped;
}

SL_RUNTIME_API bool sl_runtime_sees_past_boxes(const sl_runtime_boxes *boxes, double x0, double y0,
                                               double x1, double y1, const unsigned char *shut,
                                               double range, uint32_t *boxes_scratch) {
    const sl_runtime_view view = sl_runtime_view_all_round(x0, y0);
    slrt_search s;
    if (!slrt_start_search(&s, boxes->runtime, &view, shut, range, boxes_scratch)) return false;
    slrt_heed_boxes(&s, boxes, SL_RUNTIME_NO_BOX);
    return slrt_sees_point(&s, x1, y1);
}

SL_RUNTIME_API bool sl_runtime_can_walk_past_boxes(const sl_runtime_boxes *boxes, double x0,
                                                   double y0, double x1, double y1,
                                                   const unsigned char *shut, uint32_t except) {
    slrt_search s;
    if (!slrt_place_eye(&s, boxes->runtime, x0, y0, shut)) return false;
    slrt_heed_boxes(&s, boxes, except);
    return slrt_can_step(&s, x1, y1);
}

// --- The points of the polygon: where pieces join, and how a range cuts them

static slrt_arm slrt_arm_to(const slrt_polygon *p, const double *point) {
    return slrt_make_arm(p->s.x, p->s.y, point[0], point[1]);
}

/// If a damaged file has corners far outside its bounds, a point may be no number: then there is no
/// polygon.
static void slrt_put(slrt_polygon *p, const double *point) {
    p->broken = p->broken || !slrt_is_finite(point[0]) || !slrt_is_finite(point[1]);
    if (p->written < p->room) memcpy(p->points + 2 * (size_t)p->written, point, 2 * sizeof *point);
    p->written++;
}

/// Limits a number to those between a and b.
static double slrt_limited(double a, double value, double b) {
    const double low = a < b ? a : b, high = a < b ? b : a;
    return !(value >= low) ? low : value > high ? high : value;
}

// The range cuts the polygon, edge by edge, by a circle about the eye:
//
//          q____
//     p'  /      An edge on a wall, from p to q, keeps what is inside. Before and after it stand
//      .-+--.    arcs between the directions of its ends. Radial edges end at the circle. Arcs in a
//     (  |   )   row join, and become chords. All that is in doubles, in units of the range and
//      `-*--'    relative to the eye. Every edge and arc adds the point where it starts.

static double slrt_dot(const double *u, const double *v) {
    return u[0] * v[0] + u[1] * v[1];
}

static double slrt_turned(const double *u, const double *v) {
    return u[0] * v[1] - u[1] * v[0];
}

/// The square root, by Newton's steps; 0 for what has none.
static double slrt_root(double square) {
    uint64_t bits;
    double root;
    int i;
    if (!(square > 0)) return 0;
    memcpy(&bits, &square, sizeof bits);
    bits = (bits >> 1) + (UINT64_C(1023) << 51); // halves the exponent
    memcpy(&root, &bits, sizeof root);
    for (i = 0; i < 5; i++) root = (root + square / root) / 2;
    return root;
}

/// Makes a vector's length 1.
static void slrt_make_unit(double *u) {
    const double larger = slrt_larger(u[0], u[1]);
    double length;
    u[0] /= larger;
    u[1] /= larger;
    length = slrt_root(slrt_dot(u, u));
    u[0] /= length;
    u[1] /= length;
}

/// Adds a point that is given in units of the range.
static void slrt_put_unit(slrt_polygon *p, const double *u) {
    double point[2];
    point[0] = p->s.x + u[0] * p->s.range;
    point[1] = p->s.y + u[1] * p->s.range;
    slrt_put(p, point);
}

/// Adds the chords of an arc that is begun: it is halved until a part is at most 1/128 of the
/// circle.
static void slrt_end_arc(slrt_polygon *p) {
    const double most = 0.0024090935; // the square of such a chord
    double part[2], at[2];
    int i, count = 1;
    if (!p->has_arc) return;
    p->has_arc = false;
    slrt_put_unit(p, p->arc);
    memcpy(part, p->arc_end, sizeof part);
    for (; count < 256; count *= 2) {
        const double x = part[0] - p->arc[0], y = part[1] - p->arc[1];
        if (!(x * x + y * y > most)) break;
        part[0] = y, part[1] = -x; // the direction of the middle
        slrt_make_unit(part);
    }
    memcpy(at, p->arc, sizeof at);
    for (i = 1; i < count; i++) {
        const double cosine = slrt_dot(p->arc, part), sine = slrt_turned(p->arc, part);
        const double x = at[0];
        at[0] = cosine * x - sine * at[1];
        at[1] = cosine * at[1] + sine * x;
        slrt_put_unit(p, at);
    }
}

/// Goes on with the arc, or begins one. One that is shorter than rounding is left out.
static void slrt_add_arc(slrt_polygon *p, const double *from, const double *to) {
    if (!(slrt_turned(from, to) > 1e-15) && slrt_dot(from, to) > 0) return;
    if (!p->has_arc || slrt_turned(p->arc, to) <= 0) {
        slrt_end_arc(p);
        memcpy(p->arc, from, sizeof p->arc);
    }
    memcpy(p->arc_end, to, sizeof p->arc_end);
    p->has_arc = true;
}

/// An edge in units of the range: its ends, the directions to them, and what of it, in shares from
/// 0 to 1, is inside.
typedef struct slrt_chord {
    double a[2], along[2], from[2], to[2];
    bool a_inside, b_inside;
    double enter, leave;
} slrt_chord;

static slrt_chord slrt_chord_of(const slrt_polygon *p, const double *a, const double *b) {
    slrt_chord c;
    double length, distance, foot, half;
    c.a[0] = c.from[0] = (a[0] - p->s.x) / p->s.range;
    c.a[1] = c.from[1] = (a[1] - p->s.y) / p->s.range;
    c.to[0] = (b[0] - p->s.x) / p->s.range;
    c.to[1] = (b[1] - p->s.y) / p->s.range;
    c.along[0] = c.to[0] - c.a[0];
    c.along[1] = c.to[1] - c.a[1];
    c.a_inside = slrt_dot(c.from, c.from) <= 1;
    c.b_inside = slrt_dot(c.to, c.to) <= 1;
    if (!c.a_inside) slrt_make_unit(c.from);
    if (!c.b_inside) slrt_make_unit(c.to);
    length = slrt_root(slrt_dot(c.along, c.along));
    distance = slrt_turned(c.a, c.along) / length;
    foot = -slrt_dot(c.a, c.along) / length;
    half = slrt_root((1 - distance) * (1 + distance));
    c.enter = (foot - half) / length;
    c.leave = (foot + half) / length;
    return c;
}

/// Where an edge crosses the circle: as a point, and in units of the range.
static void slrt_cross_circle(const slrt_polygon *p, const slrt_chord *c, double share,
                              const double *a, const double *b, double *point, double *unit) {
    unit[0] = c->a[0] + share * c->along[0];
    unit[1] = c->a[1] + share * c->along[1];
    point[0] = slrt_limited(a[0], p->s.x + unit[0] * p->s.range, b[0]);
    point[1] = slrt_limited(a[1], p->s.y + unit[1] * p->s.range, b[1]);
}

/// Adds what a range leaves of an edge.
static void slrt_cut_edge(slrt_polygon *p, const double *a, const double *b, bool radial) {
    const slrt_chord c = slrt_chord_of(p, a, b);
    double point[2], unit[2];
    if (c.a_inside) {
        slrt_end_arc(p);
        slrt_put(p, a);
    } else if (radial) {
        if (!c.b_inside) return;
        slrt_end_arc(p);
        slrt_put_unit(p, c.from);
    } else if (c.b_inside || (c.enter < c.leave && c.enter < 1 && c.leave > 0)) {
        slrt_cross_circle(p, &c, c.enter, a, b, point, unit);
        slrt_add_arc(p, c.from, unit);
        slrt_end_arc(p);
        slrt_put(p, point);
    } else {
        slrt_add_arc(p, c.from, c.to);
        return;
    }
    if (c.b_inside || radial) return;
    slrt_cross_circle(p, &c, c.leave, a, b, point, unit);
    slrt_add_arc(p, unit, c.to);
}

// The points of the polygon.

/// Adds a point, unless it is the last one. `radial`: the edge to it leads from or to the eye.
static void slrt_add_point(slrt_polygon *p, const double *point, bool radial) {
    if (p->count && slrt_same_place(p->last, point)) {
        p->first_is_short = p->first_is_short || p->count == 1;
        return;
    }
    if (!(p->s.range > 0)) {
        slrt_put(p, point);
    } else if (p->count == 1 && p->waits) {
        memcpy(p->second, point, sizeof p->second);
        p->second_is_radial = radial;
    } else if (p->count) {
        slrt_cut_edge(p, p->last, point, radial);
    }
    memcpy(p->last, point, sizeof p->last);
    if (!p->count) memcpy(p->first, point, sizeof p->first);
    p->count++;
}

/// Where a ray meets the line of a piece.
static void slrt_meet_line(const slrt_polygon *p, const slrt_arm *ray, const slrt_piece *piece,
                           double *out) {
    const double *a = piece->a, *b = piece->b;
    double share;
    if (a[0] == b[0]) {
        share = (a[0] - p->s.x) / ray->x;
    } else if (a[1] == b[1]) {
        share = (a[1] - p->s.y) / ray->y;
    } else {
        const slrt_pair x = slrt_difference(b[0], a[0]), y = slrt_difference(b[1], a[1]);
        share = slrt_cross(slrt_difference(a[0], p->s.x), slrt_difference(a[1], p->s.y), x, y) /
                slrt_cross(slrt_difference(ray->to_x, ray->from_x),
                           slrt_difference(ray->to_y, ray->from_y), x, y);
    }
    out[0] = slrt_limited(a[0], p->s.x + ray->x * share, b[0]);
    out[1] = slrt_limited(a[1], p->s.y + ray->y * share, b[1]);
}

/// The end of a piece: its own, or where a border meets its line.
static void slrt_place(const slrt_polygon *p, uint32_t border, const double *own,
                       const slrt_piece *piece, double *out) {
    if (border == SLRT_NONE) {
        memcpy(out, own, 2 * sizeof *out);
    } else {
        const slrt_arm ray = slrt_border(&p->s, border);
        slrt_meet_line(p, &ray, piece, out);
    }
}

/// Whether two pieces lie in one line.
static bool slrt_in_line(const slrt_piece *piece, const slrt_piece *other) {
    const double *a = piece->a, *b = piece->b;
    if (a[0] == b[0]) return other->a[0] == a[0] && other->b[0] == a[0];
    if (a[1] == b[1]) return other->a[1] == a[1] && other->b[1] == a[1];
    return !slrt_turn(a, b, other->a) && !slrt_turn(a, b, other->b);
}

/// Adds the end of the pending piece.
static void slrt_end_pending(slrt_polygon *p) {
    double end[2];
    if (!p->pending) return;
    slrt_place(p, p->piece_left, p->piece_end, &p->piece, end);
    slrt_add_point(p, end, false);
    p->pending = false;
}

static bool slrt_joins(const slrt_polygon *p, const slrt_piece *piece) {
    return p->pending && slrt_in_line(&p->piece, piece);
}

/// Adds the start of a piece that does not join the pending one.
static void slrt_start_piece(slrt_polygon *p, const slrt_piece *piece, const double *start) {
    slrt_end_pending(p);
    if (!p->count) p->first_piece = *piece;
    slrt_add_point(p, start, true);
}

/// Goes on with a piece up to a border, or to a place for SLRT_NONE.
static void slrt_extend_piece(slrt_polygon *p, const slrt_piece *piece, uint32_t left,
                              const double *end) {
    p->pending = true;
    p->piece = *piece;
    p->piece_left = left;
    memcpy(p->piece_end, end, sizeof p->piece_end);
}

/// Adds a wall, from the border `right` to the border `left` or, for SLRT_NONE, its own ends.
static void slrt_add_wall(slrt_polygon *p, const slrt_piece *piece, uint32_t right, uint32_t left) {
    if (!slrt_joins(p, piece)) {
        double start[2];
        slrt_place(p, right, piece->a, piece, start);
        slrt_start_piece(p, piece, start);
    }
    slrt_extend_piece(p, piece, left, piece->b);
}

/// Adds the eye, where the polygon has it as a corner.
static void slrt_add_eye(slrt_polygon *p) {
    double eye[2];
    eye[0] = p->s.x;
    eye[1] = p->s.y;
    slrt_end_pending(p);
    if (!p->count) p->first_is_short = true; // no piece starts there
    slrt_add_point(p, eye, true);
}

/// Ends the polygon. All round, the last piece may go on as the first one. Then that one's start
/// goes, unless rounding made it the end too.
static void slrt_close(slrt_polygon *p, bool all_round) {
    const bool goes_on = all_round && p->pending && p->count > 1 && !p->first_is_short &&
                         slrt_in_line(&p->first_piece, &p->piece);
    bool meets;
    if (!goes_on) slrt_end_pending(p);
    meets = p->count > 1 && slrt_same_place(p->first, p->last);
    if (goes_on || meets) p->count--;
    if (!(p->s.range > 0)) {
        if (goes_on && p->room) memcpy(p->points, p->last, sizeof p->last);
        p->written = p->count;
        return;
    }
    if (p->count < 2) return;
    if (goes_on) {
        slrt_cut_edge(p, p->last, p->second, false);
    } else {
        if (!meets) slrt_cut_edge(p, p->last, p->first, true);
        if (p->waits) slrt_cut_edge(p, p->first, p->second, p->second_is_radial);
    }
    slrt_end_arc(p);
}

// --- The visible polygon

// The view spreads from the cells at the eye through open portals, as sectors between two borders:
//
//      +---------+--------.-+
//      |         |    .  left     On the way around the next cell, counter-clockwise from the
//      |         b .        |     portal ab, pieces of its boundary come that are right of the
//      |  eye *  |   seen   |     sector, then those within it, then those left of it. A wall is
//      |         a .        |     added to the polygon; a portal is entered with the sector
//      |         |    .  right    between its ends.
//      +---------+--------.-+
//
// Invariant: cells are convex and a sector is narrower than half a circle. So pieces within come in
// counter-clockwise order, depth first, and the polygon needs no sorting. A sector that has passed
// a limited wall takes the next one for a wall; those that the eye is on do not count. Signs are
// exact. Pieces
// in one line join; where one ends is computed only when the next one is known not to join. Cost:
// the sides and portals of the cells that are seen, counted once for each sector. (Teller 1992;
// with triangles for cells: Bungiu et al. 2014, Efficient Computation of Visibility Polygons.)

/// The other cell's directed portal of the same portal; SLRT_NONE in a file that is not sound.
static uint32_t slrt_twin(const slrt_polygon *p, uint32_t directed) {
    const unsigned char *at = p->s.rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES;
    const uint32_t portal = slrt_u32(at);
    const sl_runtime_cell cell = sl_runtime_get_cell(p->s.rt, slrt_u32(at + 4));
    uint32_t i;
    for (i = cell.first_directed; i < cell.first_directed + cell.directed_count; i++)
        if (i != directed &&
            slrt_u32(p->s.rt->directed + (size_t)i * SLRT_DIRECTED_BYTES) == portal)
            return i;
    return SLRT_NONE;
}

/// The borders of what is seen through a portal: those given, or its own ends for SLRT_NONE. False
/// if it is blocked or out of range, and for no portal.
static bool slrt_pass(const slrt_polygon *p, uint32_t portal, uint32_t *right, uint32_t *left) {
    if (portal == SLRT_NONE || slrt_is_blocked(&p->s, portal)) return false;
    if (*right == SLRT_NONE) *right = 2 * portal + 1;
    if (*left == SLRT_NONE) *left = 2 * portal;
    return !(p->s.range > 0) || slrt_in_range(&p->s, portal, *right, *left);
}

static void slrt_see_wall(slrt_polygon *p, uint32_t cell, const slrt_piece *piece, uint32_t right,
                          uint32_t left) {
    if (p->see_wall)
        p->see_wall(p, cell, piece, right, left);
    else
        slrt_add_wall(p, piece, right, left);
}

// The search. The path is a stack of six numbers for each cell: the cell, the portal through which
// it was entered, the portal passed last and its side, and the borders of the sector. With the side
// is SLRT_PAST_LIMIT, if the sector has passed a limited wall.

enum { SLRT_FRAME = 6 };
#define SLRT_PAST_LIMIT 0x80000000u

static void slrt_push(slrt_polygon *p, uint32_t directed, uint32_t right, uint32_t left,
                      uint32_t past) {
    uint32_t *top = p->s.path + (size_t)SLRT_FRAME * p->s.depth;
    const uint32_t twin = slrt_twin(p, directed);
    sl_runtime_cell cell;
    if (twin == SLRT_NONE || p->s.depth == p->s.rt->cell_count) {
        p->broken = true;
        return;
    }
    top[0] = slrt_u32(p->s.rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 4);
    cell = sl_runtime_get_cell(p->s.rt, top[0]);
    top[1] = top[2] = twin;
    top[3] = slrt_side_of_portal(p, &cell, twin) | past;
    if (slrt_is_limited(p->s.rt, directed)) top[3] |= SLRT_PAST_LIMIT;
    top[4] = right;
    top[5] = left;
    p->s.depth++;
    if (p->meet) p->meet(p, top[0]);
}

/// Goes on around the cell on top of the path: adds walls up to the next open portal and enters
/// that, or leaves the cell.
static void slrt_spread_on(slrt_polygon *p) {
    uint32_t *top = p->s.path + (size_t)SLRT_FRAME * (p->s.depth - 1);
    const slrt_arm a = slrt_border(&p->s, top[4]), b = slrt_border(&p->s, top[5]);
    const uint32_t past = top[3] & SLRT_PAST_LIMIT;
    bool within = top[2] != top[1]; // what is right of the sector is passed
    slrt_walk w;
    slrt_piece piece;
    w.cell = sl_runtime_get_cell(p->s.rt, top[0]);
    slrt_walk_start(p, &w, top[1], top[2], top[3] & ~SLRT_PAST_LIMIT, 1);
    while (slrt_walk_next(p, &w, &piece)) {
        const uint32_t portal = piece.directed;
        const slrt_arm to = slrt_arm_to(p, piece.b);
        uint32_t right = SLRT_NONE, left = SLRT_NONE;
        int end;
        if (!within) {
            const slrt_arm from = slrt_arm_to(p, piece.a);
            if (slrt_side(&a, &to) <= 0) continue;
            if (slrt_side(&from, &a) > 0) right = top[4];
            within = true;
        }
        end = slrt_side(&to, &b);
        if (end < 0) left = top[5];
        if (!(past && portal != SLRT_NONE && slrt_is_limited(p->s.rt, portal)) &&
            slrt_pass(p, portal, &right, &left)) {
            top[2] = portal;
            top[3] = w.side | past;
            if (end <= 0) p->s.depth--; // nothing is left to see of this cell
            slrt_push(p, portal, right, left, past);
            return;
        }
        slrt_see_wall(p, top[0], &piece, right, left);
        if (end <= 0) break;
    }
    p->s.depth--;
}

/// Adds what is seen of a piece, or through it.
static void slrt_see_piece(slrt_polygon *p, const slrt_piece *piece, uint32_t right,
                           uint32_t left) {
    const uint32_t portal = piece->directed;
    if (!slrt_pass(p, portal, &right, &left)) {
        slrt_see_wall(p, p->fan_cell, piece, right, left);
        return;
    }
    slrt_push(p, portal, right, left, 0);
    while (p->s.depth && !p->broken) slrt_spread_on(p);
}

// The fan: the pieces about the eye, of all cells that touch it.

/// Sees a piece of the fan, as far as it is in the sector. The fan may start anywhere. So the first
/// lap begins with the piece that the sector starts in, and the second lap ends before that piece.
static void slrt_see_fan_piece(slrt_polygon *p, const slrt_piece *piece, const slrt_arm *from,
                               const slrt_arm *to) {
    uint32_t right = SLRT_NONE, left = SLRT_NONE;
    if (p->in_sector) {
        const slrt_arm a = slrt_border(&p->s, p->right), b = slrt_border(&p->s, p->left);
        const int from_a = slrt_side(from, &a), a_to = slrt_side(&a, to);
        const bool starts = from_a >= 0 && a_to > 0;
        if (starts) p->done = p->second_lap && p->started;
        if (starts && !p->second_lap) p->started = true;
        if (p->done || (!p->second_lap && !p->started)) return;
        if (!starts && (from_a > 0 || slrt_side(from, &b) <= 0)) return;
        if (from_a > 0) right = p->right;
        if (a_to <= 0 || slrt_side(to, &b) < 0) left = p->left;
    }
    // The fan starts behind the gap: who comes to an earlier piece has passed it.
    if (p->gap && (p->fan_at < p->fan_last || (p->fan_at == p->fan_last && right == SLRT_NONE)))
        slrt_add_eye(p);
    p->fan_last = p->fan_at;
    slrt_see_piece(p, piece, right, left);
}

/// Goes around a cell of the fan. On its border, the eye sees a run of pieces: it begins behind one
/// that does not face the eye.
static void slrt_see_fan_cell(slrt_polygon *p, uint32_t cell) {
    bool run = p->inside, ready = p->inside;
    slrt_walk w;
    slrt_piece piece;
    p->fan_cell = cell;
    if (p->meet) p->meet(p, cell);
    slrt_walk_around(p, &w, cell, p->inside ? 1 : 2);
    while (slrt_walk_next(p, &w, &piece)) {
        const slrt_arm from = slrt_arm_to(p, piece.a), to = slrt_arm_to(p, piece.b);
        const bool faces = slrt_side(&from, &to) > 0;
        if (faces && ready) {
            run = true;
            slrt_see_fan_piece(p, &piece, &from, &to);
            p->fan_at++;
        } else if (!faces && run && !p->inside) {
            return;
        }
        ready = ready || !faces;
    }
}

/// What of a cell's boundary is at the eye: counter-clockwise behind it and before it.
typedef struct slrt_touch {
    bool any;
    uint32_t behind, before; ///< open portals, or SLRT_NONE
    double behind_end[2], before_end[2];
} slrt_touch;

static slrt_touch slrt_touch_of(slrt_polygon *p, uint32_t cell) {
    slrt_touch touch;
    slrt_walk w;
    slrt_piece piece;
    memset(&touch, 0, sizeof touch);
    touch.behind = touch.before = SLRT_NONE;
    slrt_walk_around(p, &w, cell, 1);
    while (slrt_walk_next(p, &w, &piece)) {
        const slrt_arm from = slrt_arm_to(p, piece.a), to = slrt_arm_to(p, piece.b);
        uint32_t open;
        if (slrt_side(&from, &to) || slrt_same_way(&from, &to)) continue;
        open = piece.directed != SLRT_NONE && slrt_is_blocked(&p->s, piece.directed)
                   ? SLRT_NONE
                   : piece.directed;
        touch.any = true;
        if (!slrt_is_zero(&to)) {
            touch.behind = open;
            memcpy(touch.behind_end, piece.b, sizeof piece.b);
        }
        if (!slrt_is_zero(&from)) {
            touch.before = open;
            memcpy(touch.before_end, piece.a, sizeof piece.a);
        }
    }
    return touch;
}

/// Finds where the way around the eye starts: clockwise as far as portals lead, or once around. A
/// wall that ends at the eye is seen edge-on, and hides nothing.
static void slrt_find_fan(slrt_polygon *p) {
    slrt_touch touch = slrt_touch_of(p, p->s.eye_cell), last = touch;
    p->fan_first = p->s.eye_cell;
    p->inside = !touch.any;
    p->fan_is_closed = p->inside;
    if (p->inside) return;
    while (touch.behind != SLRT_NONE && !p->broken) {
        p->fan_first = slrt_cell_across(p->s.rt, touch.behind);
        p->fan_is_closed = p->fan_first == p->s.eye_cell;
        if (p->fan_is_closed) return;
        touch = slrt_touch_of(p, p->fan_first);
    }
    while (last.before != SLRT_NONE && !p->broken)
        last = slrt_touch_of(p, slrt_cell_across(p->s.rt, last.before));
    memcpy(p->fan_right, touch.behind_end, sizeof p->fan_right);
    memcpy(p->fan_left, last.before_end, sizeof p->fan_left);
    {
        const slrt_arm right = slrt_arm_to(p, p->fan_right), left = slrt_arm_to(p, p->fan_left);
        p->gap = !slrt_same_ray(&right, &left);
    }
}

/// Sees the whole fan, once around.
static void slrt_see_fan(slrt_polygon *p) {
    uint32_t cell = p->fan_first;
    p->fan_at = 0;
    slrt_see_fan_cell(p, cell);
    while (!p->inside && !p->broken) {
        const uint32_t before = slrt_touch_of(p, cell).before;
        if (before == SLRT_NONE) return;
        cell = slrt_cell_across(p->s.rt, before);
        if (p->fan_is_closed && cell == p->fan_first) return;
        slrt_see_fan_cell(p, cell);
    }
}

/// Sees what is in a sector of less than 180 degrees.
static void slrt_see_sector(slrt_polygon *p, uint32_t right, uint32_t left) {
    const slrt_arm a = slrt_border(&p->s, right), b = slrt_border(&p->s, left);
    if (slrt_side(&a, &b) <= 0) return;
    p->in_sector = true;
    p->right = right;
    p->left = left;
    p->second_lap = p->started = p->done = false;
    slrt_see_fan(p);
    p->second_lap = true;
    slrt_see_fan(p);
}

/// Prepares a polygon. False if the eye sees nothing.
static bool slrt_start_polygon(slrt_polygon *p, const sl_runtime *rt, const sl_runtime_view *view,
                               const unsigned char *shut, double range, uint32_t *scratch,
                               double *points, uint32_t room) {
    // So that no number in units of the range overflows.
    const double least = 1e-100 * (rt->max_x - rt->min_x) + 1e-100 * (rt->max_y - rt->min_y);
    bool sees;
    memset(p, 0, sizeof *p);
    sees = slrt_start_search(&p->s, rt, view, shut, range, scratch);
    if (p->s.range > 0 && p->s.range < least) p->s.range = least;
    p->s.patience =
        (uint64_t)SLRT_PATIENCE * 16 * ((uint64_t)rt->directed_count + rt->vertex_count + 16);
    p->fan_last = UINT32_MAX;
    p->points = points;
    p->room = room;
    return sees && !rt->loose;
}

/// Makes the polygon, after slrt_find_fan. Returns the number of its points.
static uint32_t slrt_see_polygon(slrt_polygon *p) {
    uint32_t last, i;
    const uint32_t pieces = slrt_cut_cone(&p->s, &last);
    p->waits = !pieces && !p->gap;
    if (!pieces) {
        slrt_see_fan(p);
    } else {
        slrt_add_eye(p);
        for (i = 0; i < pieces; i++)
            slrt_see_sector(p, SLRT_ARM + i, SLRT_ARM + (i + 1 < pieces ? i + 1 : last));
    }
    slrt_close(p, !pieces && !p->gap);
    return p->broken || p->count < 3 || p->written < 3 ? 0 : p->written;
}

SL_RUNTIME_API uint32_t sl_runtime_visible_polygon(const sl_runtime *runtime,
                                                   const sl_runtime_view *view,
                                                   const unsigned char *shut, double range,
                                                   uint32_t *scratch, double *points,
                                                   uint32_t room) {
    slrt_polygon p;
    if (!slrt_start_polygon(&p, runtime, view, shut, range, scratch, points, room)) return 0;
    slrt_find_fan(&p);
    return slrt_see_polygon(&p);
}

// --- Discs that move: how far, and along what

// A disc of radius r moves as its middle does, if walls and all else that stops it have grown by r.
// The distance to a segment changes along a straight way as a convex function does. So Newton's
// steps from the start come to the first place where the distance is r, and never behind it:
//
//      .--___                 The disc then slides: what is left of the way, without its part
//     | o ---> ''--.          toward the nearest place of the segment. It ends in a corner, where
//      '--....--____|_        it would go back.
//      =================
//
// All that is within reach of the way is in the cells that open portals within reach lead to: the
// nearest of it has no other before it.
//
// Distances are rounded. So three limits lie apart by more than rounding can do (`slack`): r
// itself; r + 2 slack, from where a way is free; r + 3 slack, where a disc comes to rest. No rest
// is therefore nearer than r, and none is stuck to what it rests at. Whether a way crosses
// something is exact.

/// A disc on a straight way.
typedef struct slrt_disc {
    slrt_polygon p; ///< its search is from where the disc is
    double radius, slack, from[2], to[2];
    double along[2], length; ///< the way's direction and length
    bool is_near;            ///< something is nearer to the way than it may
    double stop;             ///< how far along the way the disc comes
    double normal[2];        ///< if that is not all of it: away from what stops it
    double push;             ///< how far the disc is nearer to that than at rest
} slrt_disc;

/// The square of the distance from a point to the segment from a to b. `away` leads to the point
/// from the nearest place: right across the segment, but at its ends. Its direction is exact but
/// for rounding even where it is short, so that small discs slide along walls and not into them.
static double slrt_away_from(const double *point, const double *a, const double *b, double *away) {
    const double side[2] = {b[0] - a[0], b[1] - a[1]};
    const double to[2] = {point[0] - a[0], point[1] - a[1]};
    const double square = slrt_dot(side, side), part = slrt_dot(to, side);
    double at = part > 0 ? part / square : 0;
    if (!(at < 1)) at = 1;
    if (!(square > 0)) at = 0;
    away[0] = to[0] - at * side[0];
    away[1] = to[1] - at * side[1];
    if (at > 0 && at < 1) {
        const double across = (side[0] * to[1] - side[1] * to[0]) / square;
        away[0] = -across * side[1];
        away[1] = across * side[0];
    }
    return slrt_dot(away, away);
}

/// Whether a segment is nearer to the way than a limit, or crosses it.
static bool slrt_is_near(const slrt_disc *d, const double *a, const double *b, double limit) {
    const double square = limit * limit;
    double away[2];
    int i;
    for (i = 0; i < 2; i++) {
        const double *low = d->from[i] < d->to[i] ? d->from : d->to;
        const double *high = d->from[i] < d->to[i] ? d->to : d->from;
        if (low[i] - a[i] >= limit && low[i] - b[i] >= limit) return false;
        if (a[i] - high[i] >= limit && b[i] - high[i] >= limit) return false;
    }
    return !(slrt_away_from(d->from, a, b, away) >= square &&
             slrt_away_from(d->to, a, b, away) >= square &&
             slrt_away_from(a, d->from, d->to, away) >= square &&
             slrt_away_from(b, d->from, d->to, away) >= square) ||
           slrt_meets(d->from, d->to, a, b);
}

/// Has a segment stop the disc. One that the disc is nearer to than it may, but moves away from,
/// does not.
static void slrt_stop_at(slrt_disc *d, const double *a, const double *b) {
    const double rest = d->radius + 3 * d->slack;
    double at = 0, gap = 0, rate = 0, distance = 0;
    double place[2], away[2] = {0, 0};
    int i;
    if (!slrt_is_near(d, a, b, d->radius + 2 * d->slack)) return;
    d->is_near = true;
    for (i = 0; i < 40; i++) { // slow where the way grazes an end
        place[0] = d->from[0] + at * d->along[0];
        place[1] = d->from[1] + at * d->along[1];
        distance = slrt_root(slrt_away_from(place, a, b, away));
        gap = distance - rest;
        rate = -slrt_dot(away, d->along) / distance;
        if (!(gap > 0 && rate > 0)) break;
        at += gap / rate;
    }
    if (!(at < d->stop) ||
        (!(rate > 0) && (at > 0 || slrt_away_from(d->to, a, b, place) >= distance * distance)))
        return;
    d->stop = at;
    d->normal[0] = away[0] / distance;
    d->normal[1] = away[1] / distance;
    d->push = gap < 0 ? -gap : 0;
}

/// Has the sides of the boxes in a cell stop the disc.
static void slrt_stop_at_boxes(slrt_disc *d, uint32_t cell) {
    const sl_runtime_boxes *boxes = d->p.s.boxes;
    uint32_t at = boxes ? *slrt_first_entry(boxes, cell) : SLRT_NO_ENTRY;
    for (; at != SLRT_NO_ENTRY; at = slrt_entry(boxes, at)[SLRT_ENTRY_IN_CELL]) {
        const uint32_t number = slrt_entry(boxes, at)[SLRT_ENTRY_BOX];
        const sl_runtime_box *box = &boxes->boxes[number];
        const double corners[5][2] = {{box->min_x, box->min_y},
                                      {box->max_x, box->min_y},
                                      {box->max_x, box->max_y},
                                      {box->min_x, box->max_y},
                                      {box->min_x, box->min_y}};
        int k;
        for (k = 0; k < 4 && box->blocks && number != d->p.s.except; k++)
            slrt_stop_at(d, corners[k], corners[k + 1]);
    }
}

/// Notes that a disc may get to the cell behind a way out of a cell.
static void slrt_reach_across(slrt_disc *d, const double *a, const double *b, uint32_t to) {
    if (slrt_is_near(d, a, b, d->radius + 4 * d->slack) && !slrt_is_listed(&d->p.s, to))
        slrt_list(&d->p.s, to);
}

/// The next wall along a piece of a cell's boundary that steps pass, from a place on: passage_count
/// for none. A piece is one wall, or axial.
static uint32_t slrt_next_gap(const sl_runtime *rt, uint32_t cell, const double *from,
                              const slrt_piece *piece, slrt_piece *gap) {
    uint32_t i = slrt_next_way(rt, cell, slrt_first_passage(rt, cell)), found = rt->passage_count;
    for (; i < rt->passage_count; i = slrt_next_way(rt, cell, i + 1)) {
        slrt_piece at;
        slrt_read_passage(rt, i, at.a, at.b);
        if (rt->neighbours ? !slrt_same_place(at.a, piece->a) || !slrt_same_place(at.b, piece->b)
                           : !slrt_is_on(from, piece->b, at.a) || !slrt_is_on(from, piece->b, at.b))
            continue;
        if (found < rt->passage_count && !slrt_is_on(from, gap->a, at.a)) continue;
        found = i;
        *gap = at;
    }
    return found;
}

/// Has the walls of a piece that stop steps, and shut doors on others, stop the disc; the rest
/// leads on.
static void slrt_stop_at_walls(slrt_disc *d, uint32_t cell, const slrt_piece *piece) {
    const sl_runtime *rt = d->p.s.rt;
    double from[2] = {piece->a[0], piece->a[1]};
    uint32_t left = rt->passage_count;
    for (; left; left--) {
        slrt_piece gap;
        const uint32_t passage = slrt_next_gap(rt, cell, from, piece, &gap);
        if (passage == rt->passage_count) break;
        if (!slrt_same_place(from, gap.a)) slrt_stop_at(d, from, gap.a);
        if (slrt_is_passage_barred(&d->p.s, passage))
            slrt_stop_at(d, gap.a, gap.b);
        else
            slrt_reach_across(d, gap.a, gap.b,
                              slrt_u32(rt->passages + (size_t)passage * SLRT_PASSAGE_BYTES + 8));
        from[0] = gap.b[0], from[1] = gap.b[1];
        if (slrt_same_place(from, piece->b)) return;
    }
    slrt_stop_at(d, from, piece->b);
}

/// Goes through the cells within reach of the disc's way, and has what is there stop it.
static void slrt_stop_within(slrt_disc *d) {
    slrt_search *s = &d->p.s;
    uint32_t at;
    slrt_list(s, s->eye_cell);
    for (at = 0; at < s->own_count; at++) {
        slrt_walk w;
        slrt_piece piece;
        slrt_stop_at_boxes(d, s->path[at]);
        slrt_walk_around(&d->p, &w, s->path[at], 1);
        while (slrt_walk_next(&d->p, &w, &piece)) {
            if (piece.directed == SLRT_NONE)
                slrt_stop_at_walls(d, s->path[at], &piece);
            else if (slrt_is_blocked(s, piece.directed))
                slrt_stop_at(d, piece.a, piece.b);
            else
                slrt_reach_across(d, piece.a, piece.b, slrt_cell_across(s->rt, piece.directed));
        }
    }
}

/// Puts a disc at the start of a way, and finds how far it comes. False for nowhere.
static bool slrt_move_disc(slrt_disc *d, const sl_runtime *rt, const sl_runtime_walker *walker,
                           const double *from, const double *to, uint32_t *scratch) {
    slrt_search *s = &d->p.s;
    memset(d, 0, sizeof *d);
    if (rt->loose || !slrt_place_eye(s, rt, from[0], from[1], walker->shut) ||
        !slrt_is_coordinate(to[0]) || !slrt_is_coordinate(to[1]))
        return false;
    if (walker->boxes) slrt_heed_boxes(s, walker->boxes, walker->own_box);
    s->on_foot = true;
    s->path = scratch;
    s->marks = (unsigned char *)(scratch + 6 * (size_t)rt->cell_count);
    s->patience = (uint64_t)16 * ((uint64_t)rt->directed_count + rt->vertex_count + 16);
    d->radius = walker->radius > 0 ? walker->radius : 0;
    d->slack =
        1e-14 * (slrt_larger(rt->min_x, rt->max_x) + slrt_larger(rt->min_y, rt->max_y) + d->radius);
    d->from[0] = s->x, d->from[1] = s->y;
    d->to[0] = slrt_no_dust(to[0]), d->to[1] = slrt_no_dust(to[1]);
    d->along[0] = d->to[0] - d->from[0];
    d->along[1] = d->to[1] - d->from[1];
    d->length = d->stop = slrt_root(slrt_dot(d->along, d->along));
    if (d->length > 0) d->along[0] /= d->length, d->along[1] /= d->length;
    slrt_stop_within(d);
    return !d->p.broken;
}

SL_RUNTIME_API bool sl_runtime_can_walk_wide(const sl_runtime *runtime,
                                             const sl_runtime_walker *walker, double x0, double y0,
                                             double x1, double y1, uint32_t *scratch) {
    const double from[2] = {x0, y0}, to[2] = {x1, y1};
    slrt_disc d;
    return slrt_move_disc(&d, runtime, walker, from, to, scratch) &&
           (!d.is_near || !(walker->radius > 0)) && slrt_can_step(&d.p.s, x1, y1);
}

/// Turns a way along what stops a disc, which is `at` that. False if nothing is left of the way, or
/// if it would go back.
static bool slrt_turn_along(const slrt_disc *d, const double *at, const double *first,
                            double *goal) {
    const double into = slrt_dot(d->along, d->normal), left = d->length - d->stop;
    const double most = 4 * d->slack, push = d->push < most ? d->push : most;
    double rest[2];
    int i;
    for (i = 0; i < 2; i++) {
        rest[i] = left * (d->along[i] - into * d->normal[i]);
        goal[i] = at[i] + rest[i] + push * d->normal[i];
    }
    return slrt_dot(rest, rest) > most * most && slrt_dot(rest, first) > 0;
}

SL_RUNTIME_API bool sl_runtime_walk(const sl_runtime *runtime, const sl_runtime_walker *walker,
                                    double x0, double y0, double x1, double y1, uint32_t *scratch,
                                    double *x, double *y) {
    enum { TURNS = 4 };
    double at[2] = {x0, y0}, goal[2] = {x1, y1}, first[2];
    int turn;
    for (turn = 0; turn < TURNS; turn++) {
        slrt_disc d;
        double next[2];
        bool all;
        if (!slrt_move_disc(&d, runtime, walker, at, goal, scratch)) break;
        if (!turn) memcpy(first, d.along, sizeof first);
        all = !(d.stop < d.length) || (!turn && !(d.radius > 0) && slrt_can_step(&d.p.s, x1, y1));
        next[0] = all ? goal[0] : at[0] + d.stop * d.along[0];
        next[1] = all ? goal[1] : at[1] + d.stop * d.along[1];
        if (!slrt_can_step(&d.p.s, next[0], next[1])) break;
        memcpy(at, next, sizeof at);
        if (all || !slrt_turn_along(&d, at, first, goal)) break;
    }
    *x = at[0], *y = at[1];
    return *x == x1 && *y == y1;
}

// --- Boxes about an eye: in each direction, the nearest side of all

// Of each box the sides that face the eye count. They are merged, box by box, to their lower
// envelope about the eye: arcs, each with the one side that is nearest there.
//
//       wall ----------------------      arcs, counter-clockwise: side 1, side 2, a gap, side 3
//                  .--------.
//                  |   2  .-|--.         Where two sides cross, the upright one is nearer on the
//                 1|      |3|  |         side of the x axis, the level one on that of the y axis.
//                  '------|-'  |
//             eye *       '----'
//
// Invariant: arcs start and end at rays through exact points: corners of boxes, places where their
// sides cross. So all signs are exact. An arc is less than half a turn, and none passes +x. Cost:
// O(n log n) for n boxes (Hershberger 1989, Finding the upper envelope of n line segments in
// O(n log n) time: merging; here about an eye).
//
// The header and the library have this part and box_sieve.h in common. Each says before them what
// these are:
//
//     slrt_point         x, y
//     slrt_eye           an eye, which slrt_eye_at gives as a point
//     slrt_point_turn    which side of the ray from the eye through a point another point is on: 1
//                        left, -1 right, 0 in one line; exact
//     slrt_box_list      an array of boxes, of which slrt_read_box gives one: min x, min y, max x,
//                        max y

/// The directions from `right` to `left` in which one side of a box is the nearest of all. Side k
/// of box i is number 4 * i + k: its left, right, lower and upper side.
typedef struct slrt_arc {
    slrt_point right, left; ///< on its rays
    uint32_t side;
} slrt_arc;

/// In place of a side, for all numbers from here on: what the eye itself hides, as it stands where
/// sides of boxes part what is around it.
#define SLRT_AT_EYE (UINT32_MAX - 8)
/// No side, but what stands behind all of them.
#define SLRT_NO_SIDE UINT32_MAX

enum { SLRT_ARC_WORDS = (sizeof(slrt_arc) + 3) / 4 };

/// The envelope. Its memory is the caller's, of any alignment: see slrt_arcs_room.
typedef struct slrt_envelope {
    const slrt_eye *eye;
    const slrt_box_list *boxes;
    uint32_t *memory;
    size_t count; ///< of arcs
} slrt_envelope;

/// An envelope as it is made.
typedef struct slrt_envelope_maker {
    slrt_envelope e;
    int toward[2];   ///< a quadrant that is seen, by its signs: if the eye is on a box's border, it
                     ///< says whether the eye is in it
    size_t room;     ///< of arcs
    size_t floor;    ///< those from here on are being merged
    uint32_t last;   ///< the side of the last one
    size_t runs[64]; ///< where each run starts that waits to be merged
    unsigned char ranks[64]; ///< of these: a run of rank r has 2^r boxes
    unsigned run_count;
    bool is_full; ///< there were more, which slrt_arcs_room rules out where signs are right
} slrt_envelope_maker;

/// Room for the arcs of so many boxes. Corners of a box end three arcs. Counter-clockwise from the
/// x axis two sides cross from an upright one to a level one, so that each crossing needs a corner
/// or an end at which a level side gives way to an upright one: one for each box. So there are up
/// to 4n + 6 arcs. Runs that wait have up to 5n + 8, and merging them takes room for the result.
static size_t slrt_arcs_room(size_t boxes) {
    return 9 * boxes + 40;
}

/// A side of a box, as the eye sees it from right to left.
typedef struct slrt_box_side {
    slrt_point a, b;
    double at; ///< its x (axis 0) or y (axis 1)
    int axis;
} slrt_box_side;

static slrt_box_side slrt_side_of(const slrt_envelope *e, uint32_t number) {
    const int k = (int)(number % 4), axis = k >= 2;
    const slrt_point eye = slrt_eye_at(e->eye);
    slrt_box_side side;
    slrt_point low, high;
    double box[4];
    slrt_read_box(e->boxes, number / 4, box);
    side.axis = axis;
    side.at = box[axis + 2 * (k % 2)];
    low.x = axis ? box[0] : side.at;
    high.x = axis ? box[2] : side.at;
    low.y = axis ? side.at : box[1];
    high.y = axis ? side.at : box[3];
    if (axis ? side.at < eye.y : side.at > eye.x) {
        side.a = low, side.b = high;
    } else {
        side.a = high, side.b = low;
    }
    return side;
}

static double slrt_across(const slrt_box_side *side, slrt_point p) {
    return side->axis ? p.y : p.x;
}

/// Where a direction lies, given the signs of its x and y: 0 from +x on, 1 from -x on, 2 for an end
/// at +x, once around.
static int slrt_half_of(int x, int y, bool is_end) {
    if (y) return y < 0;
    return x < 0 ? 1 : is_end ? 2 : 0;
}

static int slrt_half_at(slrt_point eye, slrt_point p, bool is_end) {
    if (p.y != eye.y) return p.y < eye.y;
    return slrt_half_of(p.x < eye.x ? -1 : 1, 0, is_end);
}

/// The order of the directions of two points, counter-clockwise from +x.
static int slrt_point_order(const slrt_eye *eye, slrt_point p, bool p_ends, slrt_point q,
                            bool q_ends) {
    const slrt_point at = slrt_eye_at(eye);
    const int a = slrt_half_at(at, p, p_ends), b = slrt_half_at(at, q, q_ends);
    return a != b ? a - b : -slrt_point_turn(eye, p, q);
}

static slrt_arc slrt_get_arc(const slrt_envelope *e, size_t i) {
    slrt_arc arc;
    memcpy(&arc, e->memory + SLRT_ARC_WORDS * i, sizeof arc);
    return arc;
}

/// Adds an arc. One that goes on along the side of the last one becomes one with it.
static void slrt_push_arc(slrt_envelope_maker *m, uint32_t side, slrt_point right,
                          slrt_point left) {
    slrt_arc arc;
    if (m->e.count > m->floor && m->last == side) {
        arc = slrt_get_arc(&m->e, m->e.count - 1);
        if (arc.left.x == right.x && arc.left.y == right.y) {
            right = arc.right;
            m->e.count--;
        }
    }
    if (m->e.count == m->room) {
        m->is_full = true;
        return;
    }
    arc.right = right;
    arc.left = left;
    arc.side = m->last = side;
    memcpy(m->e.memory + SLRT_ARC_WORDS * m->e.count++, &arc, sizeof arc);
}

/// Adds the nearer one of two sides for all directions from `right` to `left`. At one distance it
/// is the first one.
static void slrt_push_nearer(slrt_envelope_maker *m, uint32_t a, uint32_t b, slrt_point right,
                             slrt_point left) {
    const slrt_point eye = slrt_eye_at(m->e.eye);
    slrt_box_side side_a, side_b;
    slrt_point cross;
    uint32_t first, then;
    if (a >= SLRT_AT_EYE || b >= SLRT_AT_EYE) {
        slrt_push_arc(m, a >= SLRT_AT_EYE ? a : b, right, left);
        return;
    }
    side_a = slrt_side_of(&m->e, a);
    side_b = slrt_side_of(&m->e, b);
    if (side_a.axis == side_b.axis) {
        const bool before = side_a.at<side_b.at, ahead = side_a.at> slrt_across(&side_a, eye);
        slrt_push_arc(m, side_a.at == side_b.at || before == ahead ? a : b, right, left);
        return;
    }
    cross.x = side_a.axis ? side_b.at : side_a.at;
    cross.y = side_a.axis ? side_a.at : side_b.at;
    // Closer to the x axis than the crossing, the upright side is nearer.
    first = ((cross.x > eye.x) == (cross.y > eye.y)) == (side_a.axis == 0) ? a : b;
    then = first == a ? b : a;
    if (slrt_point_turn(m->e.eye, left, cross) >= 0) {
        slrt_push_arc(m, first, right, left);
    } else if (slrt_point_turn(m->e.eye, right, cross) <= 0) {
        slrt_push_arc(m, then, right, left);
    } else {
        slrt_push_arc(m, first, right, cross);
        slrt_push_arc(m, then, cross, left);
    }
}

/// A run of arcs that is used up from its start.
typedef struct slrt_run {
    slrt_arc arc; ///< what is left of the first one
    size_t at, end;
} slrt_run;

static slrt_run slrt_start_run(const slrt_envelope_maker *m, size_t at, size_t end) {
    slrt_run run;
    run.arc = slrt_get_arc(&m->e, at);
    run.at = at;
    run.end = end;
    return run;
}

static void slrt_next_arc(const slrt_envelope_maker *m, slrt_run *run) {
    if (++run->at < run->end) run->arc = slrt_get_arc(&m->e, run->at);
}

static void slrt_push_rest(slrt_envelope_maker *m, slrt_run *run) {
    for (; run->at < run->end; slrt_next_arc(m, run))
        slrt_push_arc(m, run->arc.side, run->arc.right, run->arc.left);
}

/// Merges two runs, with what comes first of them.
static void slrt_merge_next(slrt_envelope_maker *m, slrt_run *a, slrt_run *b) {
    const int order = slrt_point_order(m->e.eye, a->arc.right, false, b->arc.right, false);
    if (order) {
        // The one that starts first goes up to its end, or to where the other one starts.
        slrt_run *first = order < 0 ? a : b;
        const slrt_point stop = order < 0 ? b->arc.right : a->arc.right;
        const bool apart = slrt_point_order(m->e.eye, first->arc.left, true, stop, false) <= 0;
        slrt_push_arc(m, first->arc.side, first->arc.right, apart ? first->arc.left : stop);
        first->arc.right = stop;
        if (apart) slrt_next_arc(m, first);
    } else {
        const int ends = slrt_point_order(m->e.eye, a->arc.left, true, b->arc.left, true);
        const slrt_point stop = ends <= 0 ? a->arc.left : b->arc.left;
        slrt_push_nearer(m, a->arc.side, b->arc.side, a->arc.right, stop);
        a->arc.right = b->arc.right = stop;
        if (ends <= 0) slrt_next_arc(m, a);
        if (ends >= 0) slrt_next_arc(m, b);
    }
}

/// Merges the last two runs.
static void slrt_merge_last(slrt_envelope_maker *m) {
    const size_t to = m->runs[m->run_count - 2], stop = m->e.count;
    slrt_run a, b;
    size_t i;
    m->run_count--;
    m->ranks[m->run_count - 1]++;
    a = slrt_start_run(m, to, m->runs[m->run_count]);
    b = slrt_start_run(m, m->runs[m->run_count], stop);
    m->floor = stop;
    while (a.at < a.end && b.at < b.end) slrt_merge_next(m, &a, &b);
    slrt_push_rest(m, &a);
    slrt_push_rest(m, &b);
    m->e.count -= stop - to;
    for (i = to; i < m->e.count; i++)
        memcpy(m->e.memory + SLRT_ARC_WORDS * i, m->e.memory + SLRT_ARC_WORDS * (i + stop - to),
               sizeof(slrt_arc));
}

static void slrt_start_envelope(slrt_envelope_maker *m, const slrt_eye *eye,
                                const slrt_box_list *boxes, uint32_t *memory, size_t room) {
    m->e.eye = eye;
    m->e.boxes = boxes;
    m->e.memory = memory;
    m->e.count = 0;
    m->toward[0] = m->toward[1] = 1;
    m->room = room;
    m->run_count = 0;
    m->is_full = false;
}

/// Starts a run with an arc, in two parts where it passes +x.
static void slrt_push_run(slrt_envelope_maker *m, uint32_t side, slrt_point right,
                          slrt_point left) {
    m->floor = m->runs[m->run_count] = m->e.count;
    m->ranks[m->run_count++] = 0;
    if (slrt_point_order(m->e.eye, right, false, left, true) < 0) {
        slrt_push_arc(m, side, right, left);
    } else {
        slrt_point split;
        split.x = slrt_side_of(&m->e, side).at;
        split.y = slrt_eye_at(m->e.eye).y;
        slrt_push_arc(m, side, split, left);
        slrt_push_arc(m, side, right, split);
    }
}

/// Whether the eye is in a box and the quadrant that it sees too.
static bool slrt_looks_from_within(const slrt_envelope_maker *m, const double *box) {
    const slrt_point eye = slrt_eye_at(m->e.eye);
    return (m->toward[0] > 0 ? box[0] <= eye.x && eye.x < box[2]
                             : box[0] < eye.x && eye.x <= box[2]) &&
           (m->toward[1] > 0 ? box[1] <= eye.y && eye.y < box[3]
                             : box[1] < eye.y && eye.y <= box[3]);
}

/// Whether the eye sees side k of a box, if nothing else is there: one that faces it, or any from
/// within.
static bool slrt_sees_side(const slrt_envelope_maker *m, const double *box, bool is_in, int k) {
    const slrt_point eye = slrt_eye_at(m->e.eye);
    const int axis = k >= 2;
    const double from = axis ? eye.y : eye.x, at = box[axis + 2 * (k % 2)];
    if (!(box[!axis] < box[2 + !axis])) return false;
    if (is_in) return from != at;
    return k % 2 ? from > at : from < at;
}

/// Adds a box. Runs of as many boxes are merged: so each arc takes part in few merges.
static void slrt_add_box(slrt_envelope_maker *m, uint32_t number) {
    const unsigned before = m->run_count;
    bool is_in;
    double box[4];
    int k;
    slrt_read_box(m->e.boxes, number, box);
    is_in = slrt_looks_from_within(m, box);
    for (k = 0; k < 4; k++) {
        slrt_box_side side;
        if (!slrt_sees_side(m, box, is_in, k)) continue;
        side = slrt_side_of(&m->e, 4 * number + (uint32_t)k);
        slrt_push_run(m, 4 * number + (uint32_t)k, side.a, side.b);
        if (m->run_count > before + 1) slrt_merge_last(m);
    }
    if (m->run_count == before) return;
    m->ranks[before] = 0;
    while (m->run_count > 1 && m->ranks[m->run_count - 2] == m->ranks[m->run_count - 1])
        slrt_merge_last(m);
}

static void slrt_finish_envelope(slrt_envelope_maker *m) {
    while (m->run_count > 1) slrt_merge_last(m);
}

// --- What stands before a piece of a wall: the sides of boxes that are nearer

// A piece is compared with the arcs of the envelope that it meets. Within one arc its line and that
// of the side cross once at most. So the order at both ends of an interval says which is nearer:
//
//        1           2        the piece is behind side 1, before the gap and side 2 it is seen,
//     .-----.      .---.      side 3 crosses it. What is seen comes counter-clockwise, part by
//     |  ---+------+---+--*-  part, and one part ends where the next one starts, or straight
//                        / 3  before it or behind it.
//
// Only where a side crosses an oblique wall is a point rounded, and nothing is compared with that.
//
// Beside what box_envelope.h needs, the header and the library say what these are:
//
//     slrt_sight         where parts go
//     slrt_ray           from the eye; slrt_ray_to makes it through a point other than the eye
//     slrt_turn_to       which side of a ray a point is on: 1 left, -1 right, 0 in one line; exact
//     slrt_ray_sign      whether a ray goes up along an axis (0: x) or down: 1, -1, 0
//     slrt_side_meets    on which side of an axial line (axis 0: x = at) a ray with the direction u
//                        meets the line through a and b: the sign of
//                        u_m (s x (a - eye)) - (s x u)(at - eye_m) for s = b - a and the coordinate
//                        m of the axis; exact
//
// and define after it the functions that it declares without a body.

/// Where a part starts or ends: at a ray.
typedef struct slrt_part_end {
    slrt_ray ray;
    bool on;      ///< the ray's point is on the part, and is where it ends
    bool crosses; ///< there the piece and a side cross
} slrt_part_end;

/// A piece from a to b as the eye sees it, of which the part from `start` to `stop` is asked for.
typedef struct slrt_sieve {
    const slrt_envelope *envelope;
    slrt_sight *sight;
    slrt_point a, b;
    slrt_part_end start, stop;
} slrt_sieve;

/// Where the line through a and b crosses a side.
static slrt_point slrt_cross_side(slrt_point a, slrt_point b, const slrt_box_side *side);

/// Takes what is seen between two bounds: of a side of a box, or of the piece (SLRT_NO_SIDE).
static void slrt_see_part(const slrt_sieve *s, uint32_t number, const slrt_box_side *side,
                          const slrt_part_end *from, const slrt_part_end *to);

static slrt_part_end slrt_bound_at(const slrt_sieve *s, slrt_point p, bool on) {
    slrt_part_end bound;
    bound.ray = slrt_ray_to(s->envelope->eye, p);
    bound.on = on;
    bound.crosses = false;
    return bound;
}

/// A bound as one of a side, whose end may be on its ray.
static slrt_part_end slrt_bound_on(const slrt_sieve *s, const slrt_part_end *at, slrt_point end) {
    slrt_part_end bound = *at;
    if (at->crosses) return bound;
    if (!slrt_turn_to(s->envelope->eye, &at->ray, end)) return slrt_bound_at(s, end, true);
    bound.on = false;
    return bound;
}

static void slrt_see_side(const slrt_sieve *s, uint32_t number, const slrt_box_side *side,
                          const slrt_part_end *from, const slrt_part_end *to) {
    slrt_part_end start, stop;
    if (number >= SLRT_AT_EYE) {
        slrt_see_part(s, number, NULL, from, to);
        return;
    }
    start = slrt_bound_on(s, from, side->a);
    stop = slrt_bound_on(s, to, side->b);
    slrt_see_part(s, number, side, &start, &stop);
}

/// Whether the piece is behind a side (1), before it (-1) or at it, on a ray that meets both.
static int slrt_depth_at(const slrt_sieve *s, const slrt_box_side *side, const slrt_ray *ray) {
    const slrt_eye *eye = s->envelope->eye;
    const int sign = slrt_side_meets(eye, ray, s->a, s->b, side->axis, side->at);
    return side->at > slrt_across(side, slrt_eye_at(eye)) ? -sign : sign;
}

/// How far the parts of a piece have come: what is before `at` is added, but for the piece itself
/// from `from` on while it is `open`.
typedef struct slrt_sieving {
    slrt_part_end at, from;
    bool open;
} slrt_sieving;

/// Ends the part of the piece that is open.
static void slrt_shut(const slrt_sieve *s, slrt_sieving *now, const slrt_part_end *at) {
    if (now->open) slrt_see_part(s, SLRT_NO_SIDE, NULL, &now->from, at);
    now->open = false;
}

static void slrt_open(slrt_sieving *now, const slrt_part_end *at) {
    if (!now->open) now->from = *at;
    now->open = true;
}

/// Goes on to a bound, with the side of an arc all the way.
static void slrt_pass_side(const slrt_sieve *s, slrt_sieving *now, uint32_t number,
                           const slrt_part_end *to) {
    slrt_box_side side;
    int first = 1, last = 1;
    if (number < SLRT_AT_EYE) {
        side = slrt_side_of(s->envelope, number);
        first = slrt_depth_at(s, &side, &now->at.ray);
        last = slrt_depth_at(s, &side, &to->ray);
    }
    if (first <= 0 && last <= 0) {
        slrt_open(now, &now->at);
    } else if (first >= 0 && last >= 0) {
        slrt_shut(s, now, &now->at);
        slrt_see_side(s, number, &side, &now->at, to);
    } else {
        slrt_part_end middle = slrt_bound_at(s, slrt_cross_side(s->a, s->b, &side), true);
        middle.crosses = true;
        if (first < 0) {
            slrt_open(now, &now->at);
            slrt_shut(s, now, &middle);
            slrt_see_side(s, number, &side, &middle, to);
        } else {
            slrt_shut(s, now, &now->at);
            slrt_see_side(s, number, &side, &now->at, &middle);
            slrt_open(now, &middle);
        }
    }
    now->at = *to;
}

/// The first arc that ends beyond the start of the piece.
static size_t slrt_first_arc(const slrt_sieve *s) {
    const slrt_envelope *e = s->envelope;
    const slrt_point eye = slrt_eye_at(e->eye);
    const slrt_ray *start = &s->start.ray;
    const int half =
        slrt_half_of(slrt_ray_sign(e->eye, start, 0), slrt_ray_sign(e->eye, start, 1), false);
    size_t low = 0, high = e->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const slrt_point left = slrt_get_arc(e, middle).left;
        const int order = slrt_half_at(eye, left, true) - half;
        if (order ? order < 0 : slrt_turn_to(e->eye, start, left) <= 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < e->count ? low : 0;
}

/// Whether an arc and the piece have directions in common. *held: the piece starts within the arc.
static bool slrt_meets_arc(const slrt_sieve *s, const slrt_arc *arc, bool is_first, bool *held) {
    const slrt_eye *eye = s->envelope->eye;
    const int from = slrt_turn_to(eye, &s->start.ray, arc->right);
    *held = is_first && from <= 0 && slrt_turn_to(eye, &s->start.ray, arc->left) > 0;
    return *held || (from >= 0 && slrt_turn_to(eye, &s->stop.ray, arc->right) < 0);
}

/// Sees a piece past the boxes.
static void slrt_sieve_piece(const slrt_sieve *s) {
    const slrt_envelope *e = s->envelope;
    size_t k = slrt_first_arc(s), i;
    slrt_arc arc = slrt_get_arc(e, k);
    slrt_sieving now;
    bool held, done = false;
    if (!slrt_meets_arc(s, &arc, true, &held)) {
        slrt_see_part(s, SLRT_NO_SIDE, NULL, &s->start, &s->stop);
        return;
    }
    now.at = now.from = s->start;
    now.open = false;
    for (i = 0; i < e->count && !done; i++) {
        slrt_part_end to;
        if (i && !slrt_meets_arc(s, &arc, false, &held)) break;
        if (!held && slrt_turn_to(e->eye, &now.at.ray, arc.right) > 0) {
            slrt_open(&now, &now.at);
            now.at = slrt_bound_at(s, arc.right, false);
        }
        done = slrt_turn_to(e->eye, &s->stop.ray, arc.left) >= 0;
        to = done ? s->stop : slrt_bound_at(s, arc.left, false);
        slrt_pass_side(s, &now, arc.side, &to);
        k = k + 1 < e->count ? k + 1 : 0;
        arc = slrt_get_arc(e, k);
    }
    if (!done) slrt_open(&now, &now.at);
    slrt_shut(s, &now, &s->stop);
}

// --- The visible polygon past boxes

// The polygon is made without boxes, and the boxes of the cells that it comes to are gathered. If
// some of these block, it is made again: each piece of a wall is compared with the envelope of
// their sides (box_envelope.h, box_sieve.h).
//
//         \   |          Sides of boxes that go through the eye hide nothing, but they part what is
//      .---*--+  the     around it, as walls there do. The eye sees the part that begins with its
//      |  / box  eye     own cell. What lies beside that part is hidden: arcs at no distance at
//      all.

SL_RUNTIME_API size_t sl_runtime_boxes_scratch_count(const sl_runtime_boxes *boxes) {
    return sl_runtime_scratch_count(boxes->runtime) + 2 * (size_t)boxes->count +
           SLRT_ARC_WORDS * slrt_arcs_room(boxes->count);
}

static slrt_point slrt_cross_side(slrt_point a, slrt_point b, const slrt_box_side *side) {
    const int axis = side->axis;
    const double from = axis ? a.y : a.x, to = axis ? b.y : b.x;
    const double share = (side->at - from) / (to - from);
    slrt_point cross;
    cross.x = axis ? slrt_limited(a.x, a.x + share * (b.x - a.x), b.x) : side->at;
    cross.y = axis ? side->at : slrt_limited(a.y, a.y + share * (b.y - a.y), b.y);
    return cross;
}

static void slrt_place_bound(const slrt_polygon *p, const slrt_part_end *at,
                             const slrt_piece *piece, double *out) {
    if (at->on) {
        out[0] = at->ray.to_x;
        out[1] = at->ray.to_y;
    } else {
        slrt_meet_line(p, &at->ray, piece, out);
    }
}

static void slrt_see_part(const slrt_sieve *s, uint32_t number, const slrt_box_side *side,
                          const slrt_part_end *from, const slrt_part_end *to) {
    slrt_polygon *p = s->sight;
    const slrt_point a = side ? side->a : s->a, b = side ? side->b : s->b;
    slrt_piece piece;
    double end[2];
    if (!side && number != SLRT_NO_SIDE) {
        slrt_add_eye(p);
        return;
    }
    piece.a[0] = a.x, piece.a[1] = a.y;
    piece.b[0] = b.x, piece.b[1] = b.y;
    piece.directed = SLRT_NONE;
    if (!slrt_joins(p, &piece)) {
        slrt_place_bound(p, from, &piece, end);
        slrt_start_piece(p, &piece, end);
    }
    slrt_place_bound(p, to, &piece, end);
    slrt_extend_piece(p, &piece, SLRT_NONE, end);
}

/// What is done with the boxes of a polygon.
typedef struct slrt_past_boxes {
    const sl_runtime_boxes *boxes;
    uint32_t *blockers, count; ///< boxes that block in the cells that are seen
    uint32_t *marks;           ///< by box: whether it is one
    slrt_envelope_maker maker;
} slrt_past_boxes;

static void slrt_gather_boxes(slrt_polygon *p, uint32_t cell) {
    slrt_past_boxes *past = (slrt_past_boxes *)p->job;
    uint32_t at = *slrt_first_entry(past->boxes, cell);
    while (at != SLRT_NO_ENTRY) {
        const uint32_t *entry = slrt_entry(past->boxes, at);
        const uint32_t box = entry[SLRT_ENTRY_BOX];
        if (past->boxes->boxes[box].blocks && !past->marks[box]) {
            past->marks[box] = 1;
            past->blockers[past->count++] = box;
        }
        at = entry[SLRT_ENTRY_IN_CELL];
    }
}

static void slrt_see_past_boxes(slrt_polygon *p, uint32_t cell, const slrt_piece *piece,
                                uint32_t right, uint32_t left) {
    const slrt_past_boxes *past = (const slrt_past_boxes *)p->job;
    slrt_sieve s;
    (void)cell;
    s.envelope = &past->maker.e;
    s.sight = p;
    s.a.x = piece->a[0], s.a.y = piece->a[1];
    s.b.x = piece->b[0], s.b.y = piece->b[1];
    s.start = slrt_bound_at(&s, s.a, right == SLRT_NONE);
    s.stop = slrt_bound_at(&s, s.b, left == SLRT_NONE);
    if (right != SLRT_NONE) s.start.ray = slrt_border(&p->s, right);
    if (left != SLRT_NONE) s.stop.ray = slrt_border(&p->s, left);
    slrt_sieve_piece(&s);
}

// Where sides of boxes go through the eye.

/// A point straight along an axis from the eye: 0 right, 1 above, 2 left, 3 under.
static slrt_point slrt_axis_point(const slrt_polygon *p, int quarter) {
    const sl_runtime *rt = p->s.rt;
    slrt_point at = slrt_eye_at(&p->s);
    const double x = slrt_larger(at.x, rt->max_x - rt->min_x);
    const double y = slrt_larger(at.y, rt->max_y - rt->min_y);
    at.x += quarter == 0 ? x : quarter == 2 ? -x : 0;
    at.y += quarter == 1 ? y : quarter == 3 ? -y : 0;
    return at;
}

/// The directions, as bits of quarters, in which sides of a box leave the eye.
static unsigned slrt_sides_at_eye(const slrt_polygon *p, const sl_runtime_box *box) {
    const double x = p->s.x, y = p->s.y;
    unsigned found = 0;
    if (!slrt_box_holds(box, x, y)) return 0;
    if (y == box->min_y || y == box->max_y) {
        if (x < box->max_x) found |= 1;
        if (x > box->min_x) found |= 4;
    }
    if (x == box->min_x || x == box->max_x) {
        if (y < box->max_y) found |= 2;
        if (y > box->min_y) found |= 8;
    }
    return found;
}

/// Whether a ray is in the sector from u to v, of at most 180 degrees, but not on v.
static bool slrt_begins_in(const slrt_arm *u, const slrt_arm *v, const slrt_arm *ray) {
    return (slrt_side(u, ray) > 0 && slrt_side(ray, v) > 0) || slrt_same_ray(u, ray);
}

/// Where, counter-clockwise, the quadrant begins that counts for an eye on the border of a box: the
/// part of it that the eye's cell is in. It is the one right of the eye and over it, if the cell
/// reaches into that, else the next one in the order of sl_runtime_locate.
static slrt_point slrt_find_quadrant(slrt_polygon *p, int toward[2]) {
    const slrt_touch touch = slrt_touch_of(p, p->s.eye_cell);
    const slrt_arm u = slrt_arm_to(p, touch.behind_end), v = slrt_arm_to(p, touch.before_end);
    slrt_point at = slrt_axis_point(p, 0);
    int i;
    for (i = 0; i < 4; i++) {
        const int quarter = i == 2 ? 3 : i == 3 ? 2 : i;
        const slrt_point from = slrt_axis_point(p, quarter);
        const slrt_arm a = slrt_ray_to(&p->s, from);
        const slrt_arm b = slrt_ray_to(&p->s, slrt_axis_point(p, (quarter + 1) % 4));
        toward[0] = i & 1 ? -1 : 1;
        toward[1] = i & 2 ? -1 : 1;
        if (!touch.any || slrt_begins_in(&u, &v, &a)) return from;
        at.x = touch.behind_end[0], at.y = touch.behind_end[1];
        if (slrt_begins_in(&a, &b, &u)) return at;
    }
    return at;
}

/// Whether the ray through p comes before the one through q, counter-clockwise from behind `base`
/// once around to it.
static bool slrt_comes_before(const slrt_eye *eye, slrt_point base, slrt_point p, slrt_point q) {
    const slrt_arm b = slrt_ray_to(eye, base), u = slrt_ray_to(eye, p), v = slrt_ray_to(eye, q);
    const int b_u = slrt_side(&b, &u), b_v = slrt_side(&b, &v);
    const int lap_u = b_u > 0 ? 0 : b_u < 0 ? 2 : slrt_same_way(&b, &u) ? 3 : 1;
    const int lap_v = b_v > 0 ? 0 : b_v < 0 ? 2 : slrt_same_way(&b, &v) ? 3 : 1;
    return lap_u != lap_v ? lap_u < lap_v : slrt_side(&u, &v) > 0;
}

/// Hides all directions from one to another one, in parts that end at the axes.
static void slrt_hide_from_eye(slrt_polygon *p, slrt_envelope_maker *m, slrt_point from,
                               slrt_point to) {
    uint32_t i;
    for (i = 0; i < 5; i++) {
        const slrt_arm u = slrt_ray_to(&p->s, from), v = slrt_ray_to(&p->s, to);
        const int x = slrt_ray_sign(&p->s, &u, 0), y = slrt_ray_sign(&p->s, &u, 1);
        const int next = x > 0 && y >= 0 ? 1 : x <= 0 && y > 0 ? 2 : x < 0 ? 3 : 0;
        const slrt_point axis = slrt_axis_point(p, next);
        const bool ends = slrt_side(&u, &v) > 0 && slrt_point_turn(&p->s, to, axis) >= 0;
        slrt_push_run(m, SLRT_AT_EYE + i, from, ends ? to : axis);
        if (m->run_count > 1) slrt_merge_last(m);
        if (ends) return;
        from = axis;
    }
}

/// Hides what the eye does not see as sides of boxes, perhaps with walls, part what is around it.
/// One side alone, or a wall in its direction, is seen edge-on.
static void slrt_part_at_eye(slrt_polygon *p, slrt_past_boxes *past) {
    slrt_point rays[6], base, first, last;
    unsigned sides = 0;
    uint32_t i, count = 0;
    for (i = 0; i < past->count; i++)
        sides |= slrt_sides_at_eye(p, &past->boxes->boxes[past->blockers[i]]);
    if (!sides) return;
    for (i = 0; i < 4; i++)
        if (sides >> i & 1) rays[count++] = slrt_axis_point(p, (int)i);
    if (!p->fan_is_closed) {
        rays[count].x = p->fan_right[0], rays[count++].y = p->fan_right[1];
        rays[count].x = p->fan_left[0], rays[count++].y = p->fan_left[1];
    }
    base = slrt_find_quadrant(p, past->maker.toward);
    first = last = rays[0];
    for (i = 1; i < count; i++) {
        if (slrt_comes_before(&p->s, base, rays[i], first)) first = rays[i];
        if (slrt_comes_before(&p->s, base, last, rays[i])) last = rays[i];
    }
    if (slrt_comes_before(&p->s, base, first, last))
        slrt_hide_from_eye(p, &past->maker, first, last);
}

/// Makes the envelope of the boxes gathered. False if nothing of them hides anything.
static bool slrt_make_envelope(slrt_polygon *p, slrt_past_boxes *past, uint32_t *memory) {
    uint32_t i;
    slrt_start_envelope(&past->maker, &p->s, past->boxes->boxes, memory,
                        slrt_arcs_room(past->boxes->count));
    slrt_part_at_eye(p, past);
    for (i = 0; i < past->count; i++) slrt_add_box(&past->maker, past->blockers[i]);
    slrt_finish_envelope(&past->maker);
    p->broken = p->broken || past->maker.is_full;
    return past->maker.e.count != 0;
}

SL_RUNTIME_API uint32_t sl_runtime_visible_polygon_past_boxes(const sl_runtime_boxes *boxes,
                                                              const sl_runtime_view *view,
                                                              const unsigned char *shut,
                                                              double range, uint32_t *boxes_scratch,
                                                              double *points, uint32_t room) {
    const sl_runtime *rt = boxes->runtime;
    slrt_past_boxes past;
    slrt_polygon p;
    uint32_t count;
    past.boxes = boxes;
    past.blockers = boxes_scratch + sl_runtime_scratch_count(rt);
    past.marks = past.blockers + boxes->count;
    past.count = 0;
    if (boxes->count) memset(past.marks, 0, boxes->count * sizeof *past.marks);
    if (!slrt_start_polygon(&p, rt, view, shut, range, boxes_scratch, points, room)) return 0;
    p.meet = slrt_gather_boxes;
    p.job = &past;
    slrt_find_fan(&p);
    count = slrt_see_polygon(&p);
    if (!count || !past.count) return count;
    slrt_start_polygon(&p, rt, view, shut, range, boxes_scratch, points, room);
    slrt_find_fan(&p);
    if (!slrt_make_envelope(&p, &past, past.marks + boxes->count)) return count;
    p.see_wall = slrt_see_past_boxes;
    p.job = &past;
    return slrt_see_polygon(&p);
}

// --- The visible polygon, and what is seen in mirrors

// The map stays where it is and the eye is reflected. What the eye sees in a mirror is what its
// image sees straight through the mirror, into the cell before it:
//
//       \    eye    /
//        \         /         The image lies behind the mirror. It looks between two borders, those
//     ===[ mirror ]===       of the piece of the mirror that is seen: a sector, as in polygon.h,
//          \     /           about another eye.
//           image
//
// A border is a direction. An axial mirror changes the sign of its x or its y, which is exact. So
// all signs are right as long as the image is one of doubles. The list of parts is also what waits:
// each part adds those that are seen in it to the end. Cost: a polygon for each part, and for each
// wall seen all mirrors.

typedef struct slrt_mirrors_job {
    sl_runtime_mirror_part *parts;
    uint32_t room, count; ///< of parts, those that wait included
    uint32_t missed;      ///< parts for which there is no room
    uint32_t depth;       ///< the most
    uint32_t here;        ///< the part that is made
    bool added;           ///< some part is added that is seen in that one,
    slrt_arm last;        ///< and the last of these ends there
} slrt_mirrors_job;

static slrt_arm slrt_arm_of(const double *border) {
    return slrt_make_arm(border[2], border[3], border[0], border[1]);
}

/// Whether a piece of a cell's boundary is on the line of a mirror. A side on an oblique wall may
/// be rounded, so the wall is asked.
static bool slrt_is_on_line(const sl_runtime *rt, uint32_t cell, const slrt_piece *piece,
                            const double *from, const double *to) {
    const sl_runtime_cell c = sl_runtime_get_cell(rt, cell);
    double a[2], b[2];
    uint32_t i, wall;
    memcpy(a, piece->a, sizeof a);
    memcpy(b, piece->b, sizeof b);
    for (i = 0; rt->neighbours && rt->walls && i < c.vertex_count; i++) {
        const unsigned char *end;
        slrt_read_vertex(rt, &c, slrt_next_corner(&c, i), b);
        if (!slrt_same_place(b, piece->b)) continue;
        wall = slrt_u32(rt->neighbours + ((size_t)c.first_vertex + i) * 4) & 0x7fffffffu;
        if (wall >= rt->wall_count) return false;
        end = rt->walls + (size_t)wall * 32;
        a[0] = slrt_f64(end), a[1] = slrt_f64(end + 8);
        b[0] = slrt_f64(end + 16), b[1] = slrt_f64(end + 24);
        break;
    }
    return !slrt_turn(a, b, from) && !slrt_turn(a, b, to);
}

/// A number that grows from a to b.
static double slrt_along(const slrt_piece *piece, const double *at) {
    const double x = piece->b[0] - piece->a[0], y = piece->b[1] - piece->a[1];
    if ((x < 0 ? -x : x) >= (y < 0 ? -y : y)) return x > 0 ? at[0] : -at[0];
    return y > 0 ? at[1] : -at[1];
}

/// Cuts a piece of a cell's boundary to a mirror's ends. False if nothing of it reflects.
static bool slrt_cut_to_mirror(const sl_runtime *rt, uint32_t cell, const unsigned char *mirror,
                               slrt_piece *piece) {
    double ends[2][2];
    bool turned;
    ends[0][0] = slrt_f64(mirror), ends[0][1] = slrt_f64(mirror + 8);
    ends[1][0] = slrt_f64(mirror + 16), ends[1][1] = slrt_f64(mirror + 24);
    turned = slrt_along(piece, ends[0]) > slrt_along(piece, ends[1]);
    if ((turned && slrt_u64(mirror + 32)) || !slrt_is_on_line(rt, cell, piece, ends[0], ends[1]) ||
        slrt_along(piece, ends[!turned]) <= slrt_along(piece, piece->a) ||
        slrt_along(piece, ends[turned]) >= slrt_along(piece, piece->b))
        return false;
    if (slrt_along(piece, ends[turned]) > slrt_along(piece, piece->a))
        memcpy(piece->a, ends[turned], sizeof piece->a);
    if (slrt_along(piece, ends[!turned]) < slrt_along(piece, piece->b))
        memcpy(piece->b, ends[!turned], sizeof piece->b);
    return true;
}

/// Reflects directions and places in a mirror's line: (x, y) becomes
/// (m[0] x + m[1] y + m[2], m[3] x + m[4] y + m[5]).
static void slrt_reflection(const unsigned char *mirror, double *m) {
    const double x = slrt_f64(mirror), y = slrt_f64(mirror + 8);
    double u[2];
    u[0] = slrt_f64(mirror + 16) - x;
    u[1] = slrt_f64(mirror + 24) - y;
    if (u[0] != 0 && u[1] != 0) slrt_make_unit(u);
    m[0] = u[0] == 0 ? -1 : u[1] == 0 ? 1 : u[0] * u[0] - u[1] * u[1];
    m[4] = -m[0];
    m[1] = m[3] = u[0] != 0 && u[1] != 0 ? 2 * u[0] * u[1] : 0;
    m[2] = m[1] == 0 ? (u[0] == 0 ? 2 * x : 0) : x - m[0] * x - m[1] * y;
    m[5] = m[1] == 0 ? (u[1] == 0 ? 2 * y : 0) : y - m[3] * x - m[4] * y;
}

/// a + b; *rounded is set if that is not exact (Knuth's two-sum).
static double slrt_sum(double a, double b, bool *rounded) {
    const double sum = a + b, added = sum - a;
    if ((a - (sum - added)) + (b - added) != 0) *rounded = true;
    return sum;
}

static void slrt_reflect_place(const double *m, const double *at, double *out, bool *rounded) {
    const double x = at[0], y = at[1];
    if (m[1] != 0) *rounded = true;
    out[0] = m[1] == 0 ? slrt_sum(m[0] * x, m[2], rounded) : m[0] * x + m[1] * y + m[2];
    out[1] = m[1] == 0 ? slrt_sum(m[4] * y, m[5], rounded) : m[3] * x + m[4] * y + m[5];
}

static void slrt_reflect_border(const double *m, const slrt_arm *arm, double *border) {
    if (m[1] == 0) {
        border[0] = m[0] * arm->to_x, border[1] = m[4] * arm->to_y;
        border[2] = m[0] * arm->from_x, border[3] = m[4] * arm->from_y;
    } else {
        border[0] = m[0] * arm->x + m[1] * arm->y;
        border[1] = m[3] * arm->x + m[4] * arm->y;
        border[2] = border[3] = 0;
    }
}

/// The frame in which the map appears behind one more mirror.
static void slrt_reflect_frame(const double *f, const double *m, double *out) {
    int i;
    for (i = 0; i < 6; i += 3) {
        out[i] = f[i] * m[0] + f[i + 1] * m[3];
        out[i + 1] = f[i] * m[1] + f[i + 1] * m[4];
        out[i + 2] = f[i] * m[2] + f[i + 1] * m[5] + f[i + 2];
    }
}

/// Limits a piece of a mirror to what is within range. False if that is nothing.
static bool slrt_limit_to_range(const slrt_polygon *p, slrt_piece *piece) {
    const slrt_chord c = slrt_chord_of(p, piece->a, piece->b);
    double a[2], b[2], unit[2];
    if (!(p->s.range > 0) || (c.a_inside && c.b_inside)) return true;
    if (!c.a_inside && !c.b_inside && !(c.enter < c.leave && c.enter < 1 && c.leave > 0))
        return false;
    memcpy(a, piece->a, sizeof a);
    memcpy(b, piece->b, sizeof b);
    if (!c.a_inside) slrt_cross_circle(p, &c, c.enter, a, b, piece->a, unit);
    if (!c.b_inside) slrt_cross_circle(p, &c, c.leave, a, b, piece->b, unit);
    return !slrt_same_place(piece->a, piece->b);
}

/// Adds the part that is seen in a piece of a mirror, from the border `right` to `left` or, for
/// SLRT_NONE, its ends.
static void slrt_add_part(const slrt_polygon *p, uint32_t cell, uint32_t mirror,
                          const slrt_piece *piece, uint32_t right, uint32_t left) {
    slrt_mirrors_job *job = (slrt_mirrors_job *)p->job;
    const sl_runtime_mirror_part *from = &job->parts[job->here];
    slrt_arm u = slrt_arm_to(p, piece->a), v = slrt_arm_to(p, piece->b);
    const slrt_arm a = right == SLRT_NONE ? u : slrt_border(&p->s, right);
    const slrt_arm b = left == SLRT_NONE ? v : slrt_border(&p->s, left);
    double m[6];
    sl_runtime_mirror_part *to;
    if (slrt_side(&u, &a) > 0) u = a;
    if (slrt_side(&b, &v) > 0) v = b;
    if (slrt_side(&u, &v) <= 0) return;
    if (job->count == job->room) {
        job->missed++;
        return;
    }
    to = &job->parts[job->count];
    memset(to, 0, sizeof *to);
    to->joins = job->added && to[-1].mirror == mirror && slrt_same_ray(&job->last, &u);
    job->added = true;
    job->last = v;
    job->count++;
    slrt_reflection(p->s.rt->mirror_lines + (size_t)mirror * SLRT_MIRROR_BYTES, m);
    to->mirror = mirror;
    to->parent = job->here;
    to->depth = from->depth + 1;
    to->rounded = from->rounded;
    to->cell = cell;
    slrt_reflect_place(m, from->eye, to->eye, &to->rounded);
    slrt_reflect_frame(from->frame, m, to->frame);
    slrt_reflect_border(m, &v, to->right);
    slrt_reflect_border(m, &u, to->left);
    memcpy(to->at, piece->b, sizeof piece->b);
    memcpy(to->at + 2, piece->a, sizeof piece->a);
}

/// Finds the first place on a piece of a cell's boundary, from a on, that is on a mirror, up to
/// where that mirror ends or an earlier one of the map begins. False for none.
static bool slrt_next_mirror(slrt_polygon *p, uint32_t cell, const slrt_piece *piece,
                             slrt_piece *cut, uint32_t *mirror) {
    const sl_runtime *rt = p->s.rt;
    bool found = false;
    uint32_t i;
    if (p->s.patience < rt->mirror_count) p->broken = true;
    for (i = 0; i < rt->mirror_count && !p->broken; i++) {
        slrt_piece on = *piece;
        if (!slrt_cut_to_mirror(rt, cell, rt->mirror_lines + (size_t)i * SLRT_MIRROR_BYTES, &on) ||
            (found && slrt_along(piece, on.a) >= slrt_along(piece, cut->a)))
            continue;
        if (found && slrt_along(piece, cut->a) < slrt_along(piece, on.b))
            memcpy(on.b, cut->a, sizeof on.b);
        *cut = on;
        *mirror = i;
        found = true;
    }
    p->s.patience -= i;
    return found;
}

/// Adds a wall, and what is seen in the mirrors on it.
static void slrt_see_reflecting(slrt_polygon *p, uint32_t cell, const slrt_piece *piece,
                                uint32_t right, uint32_t left) {
    const slrt_mirrors_job *job = (const slrt_mirrors_job *)p->job;
    const sl_runtime_mirror_part *here = &job->parts[job->here];
    slrt_piece rest = *piece, cut;
    uint32_t mirror = 0;
    slrt_add_wall(p, piece, right, left);
    if (here->depth == job->depth || piece->directed != SLRT_NONE) return;
    while (slrt_along(piece, rest.a) < slrt_along(piece, rest.b) &&
           slrt_next_mirror(p, cell, &rest, &cut, &mirror)) {
        memcpy(rest.a, cut.b, sizeof rest.a);
        // Behind a mirror its own side is behind the line of sight, but for rounding.
        if (!(here->depth && mirror == here->mirror) && slrt_limit_to_range(p, &cut))
            slrt_add_part(p, cell, mirror, &cut, right, left);
    }
}

/// Adds the point where a border meets a piece of a mirror.
static void slrt_add_on_mirror(slrt_polygon *p, const double *border, const double *ends,
                               double *at) {
    const slrt_arm ray = slrt_arm_of(border);
    slrt_piece mirror;
    memcpy(mirror.a, ends, sizeof mirror.a);
    memcpy(mirror.b, ends + 2, sizeof mirror.b);
    slrt_meet_line(p, &ray, &mirror, at);
    slrt_add_point(p, at, true);
}

/// Makes the polygon of a part, and of those behind it in the list that join it: from the right end
/// of the mirror, which is that of the last one, counter-clockwise about the image.
static uint32_t slrt_see_in_mirror(slrt_polygon *p, const sl_runtime_mirror_part *part,
                                   const sl_runtime_mirror_part *joined, uint32_t count) {
    const sl_runtime_mirror_part *rightmost = count ? &joined[count - 1] : part;
    double at[2];
    p->s.x = part->eye[0];
    p->s.y = part->eye[1];
    p->in_sector = true;
    p->first_is_short = true;
    p->started = true; // all that faces the image is on one lap
    slrt_add_on_mirror(p, rightmost->right, rightmost->at, at);
    for (;;) {
        const sl_runtime_mirror_part *one = count ? &joined[count - 1] : part;
        const uint32_t slot = 2 * (count % 2); // the end of the last piece is not computed yet
        p->right = SLRT_ARM + slot;
        p->left = SLRT_ARM + slot + 1;
        p->s.cone[slot] = slrt_arm_of(one->right);
        p->s.cone[slot + 1] = slrt_arm_of(one->left);
        slrt_see_fan_cell(p, one->cell);
        if (!count--) break;
    }
    slrt_end_pending(p);
    slrt_add_on_mirror(p, part->left, part->at, at);
    if (p->s.range > 0) {
        slrt_end_arc(p);
        slrt_put(p, at);
    }
    return p->broken || p->count < 3 || p->written < 3 ? 0 : p->written;
}

/// Makes the polygon of the next part that waits. Returns how many of the list it took.
static uint32_t slrt_make_part(slrt_polygon *p, slrt_mirrors_job *job, uint32_t next) {
    sl_runtime_mirror_part *part = &job->parts[job->here];
    const uint32_t waiting = job->count;
    uint32_t taken = 1;
    p->job = job;
    p->see_wall = slrt_see_reflecting;
    job->added = false;
    *part = job->parts[next];
    if (next) {
        for (; next + taken < waiting && job->parts[next + taken].joins; taken++)
            part->rounded = part->rounded || job->parts[next + taken].rounded;
        part->count = slrt_see_in_mirror(p, part, &job->parts[next] + 1, taken - 1);
    } else {
        slrt_find_fan(p);
        part->count = slrt_see_polygon(p);
    }
    if (part->count)
        job->here++;
    else
        job->count = waiting; // what is not seen shows nothing
    return taken;
}

SL_RUNTIME_API uint32_t sl_runtime_visible_polygon_mirrored(
    const sl_runtime *runtime, const sl_runtime_view *view, const unsigned char *shut, double range,
    uint32_t depth, uint32_t *scratch, sl_runtime_mirror_part *parts, uint32_t part_room,
    uint32_t *part_count, double *points, uint32_t room) {
    slrt_mirrors_job job;
    slrt_polygon p;
    uint32_t next, all = 0;
    *part_count = 0;
    if (!part_room || !slrt_start_polygon(&p, runtime, view, shut, range, scratch, points, room))
        return 0;
    memset(&job, 0, sizeof job);
    job.parts = parts;
    job.room = part_room;
    job.count = 1;
    job.depth = depth;
    memset(parts, 0, sizeof *parts);
    parts->eye[0] = p.s.x;
    parts->eye[1] = p.s.y;
    parts->frame[0] = parts->frame[4] = 1;
    for (next = 0; next < job.count;) {
        const uint32_t here = job.here;
        next += slrt_make_part(&p, &job, next);
        if (job.here > here) {
            parts[here].first = all;
            all += parts[here].count;
        }
        slrt_start_polygon(&p, runtime, view, shut, range, scratch,
                           all < room ? points + 2 * (size_t)all : NULL,
                           all < room ? room - all : 0);
    }
    *part_count = job.missed ? part_room + job.missed : job.here;
    return all;
}

// --- Eye-to-cell by mirrors: what is seen in them, exactly

// In a cell that is entered, the sector is narrowed to each mirror that is there, as to a portal.
// What leaves by it goes back into the cell about the eye's image (polygon_mirrors.h): a search of
// its own, with marks of its own, in the next part of the scratch memory.

enum { SLRT_MOST_REFLECTIONS = 16 };

/// A search, and how it is come to. The search comes first: its `meet` is given that alone.
typedef struct slrt_reflected {
    slrt_search s;
    slrt_search *first;       ///< the eye's own
    unsigned char *by_mirror; ///< by cell: seen in a mirror
    bool *rounded;
    uint64_t patience; ///< of the eye's own search, for what is seen in mirrors
    uint32_t depth;    ///< reflections that are left
    uint32_t mirror;   ///< that the eye was reflected in; SLRT_NONE for the eye itself
} slrt_reflected;

/// The steps that are left for what is seen in mirrors.
static uint64_t *slrt_mirrors_patience(slrt_reflected *r) {
    return r->s.is_image ? &r->s.patience : &r->patience;
}

/// Whether some of a mirror is where a cell is, by their boxes.
static bool slrt_is_near_cell(const unsigned char *mirror, const double *low, const double *high) {
    int i;
    for (i = 0; i < 2; i++) {
        const double a = slrt_f64(mirror + 8 * i), b = slrt_f64(mirror + 16 + 8 * i);
        if ((a < low[i] && b < low[i]) || (a > high[i] && b > high[i])) return false;
    }
    return true;
}

static bool slrt_is_ray(const slrt_search *s, const slrt_sector *sector) {
    const slrt_arm a = slrt_border(s, sector->right), b = slrt_border(s, sector->left);
    return slrt_same_ray(&a, &b);
}

/// Adds what a portal in line with the eye says about the borders. `p` and `q` lead to its right
/// and left end. False if only a line is left that crosses portals along it both ways: no line
/// beside it passes them all.
static bool slrt_run_along(const slrt_search *s, const slrt_arm *p, const slrt_arm *q,
                           slrt_sector *sector) {
    const slrt_arm a = slrt_border(s, sector->right), b = slrt_border(s, sector->left);
    const slrt_arm to_left = slrt_make_arm(p->to_x, p->to_y, q->to_x, q->to_y);
    if (!slrt_same_way(p, q)) { // the eye is on it
        if (!slrt_side(&to_left, &a) && !slrt_same_way(&to_left, &a))
            sector->along |= SLRT_ALONG_RIGHT;
        if (!slrt_side(&to_left, &b) && slrt_same_way(&to_left, &b))
            sector->along |= SLRT_ALONG_LEFT;
    } else if (slrt_same_ray(&a, &b)) {
        // Who goes from its right end to its left end crosses it to the right.
        sector->along |=
            slrt_same_way(&to_left, &a) ? (unsigned)SLRT_ALONG_LEFT : (unsigned)SLRT_ALONG_RIGHT;
    }
    return sector->along != SLRT_ALONG || !slrt_same_ray(&a, &b);
}

/// Narrows a sector of at most 180 degrees to what is between two other borders, p and q; false for
/// nothing.
static bool slrt_narrow_to(const slrt_search *s, const slrt_arm *p, const slrt_arm *q,
                           uint32_t right, uint32_t left, slrt_sector *sector) {
    const slrt_arm a = slrt_border(s, sector->right), b = slrt_border(s, sector->left);
    const int a_p = slrt_side(&a, p), a_q = slrt_side(&a, q);
    const int p_b = slrt_side(p, &b), q_b = slrt_side(q, &b);
    const bool right_within = slrt_within(p, &a, &b, a_p, p_b);
    if (!right_within && !slrt_within(&a, p, q, -a_p, a_q)) return false;
    if (slrt_within(q, &a, &b, a_q, q_b)) {
        if (q_b || !slrt_same_way(q, &b)) sector->along &= ~(unsigned)SLRT_ALONG_LEFT;
        sector->left = left;
    }
    if (right_within) {
        if (a_p || !slrt_same_way(&a, p)) sector->along &= ~(unsigned)SLRT_ALONG_RIGHT;
        sector->right = right;
    }
    return true;
}

/// Narrows a sector to a piece of a mirror, with its ends as the last two arms. False for nothing.
static bool slrt_narrow_to_mirror(slrt_search *s, const slrt_piece *piece, slrt_sector *sector) {
    const slrt_arm right = slrt_make_arm(s->x, s->y, piece->a[0], piece->a[1]);
    const slrt_arm left = slrt_make_arm(s->x, s->y, piece->b[0], piece->b[1]);
    const uint32_t to_right = SLRT_ARM + SLRT_MIRROR_ARM, to_left = to_right + 1;
    const int facing = slrt_side(&right, &left);
    slrt_arm *p = &s->cone[SLRT_MIRROR_ARM], *q = p + 1, u, v;
    *p = slrt_is_zero(&right) ? slrt_make_arm(left.to_x, left.to_y, s->x, s->y) : right;
    *q = slrt_is_zero(&left) ? slrt_make_arm(right.to_x, right.to_y, s->x, s->y) : left;
    if (facing < 0) return false;
    if (sector->right == SLRT_ALL_ROUND) {
        sector->right = to_right;
        sector->left = to_left;
    } else if (!slrt_narrow_to(s, p, q, to_right, to_left, sector)) {
        return false;
    }
    if (facing ? sector->along == SLRT_ALONG && slrt_is_ray(s, sector)
               : !slrt_run_along(s, &right, &left, sector))
        return false;
    if (!(s->range > 0)) return true;
    u = slrt_border(s, sector->right);
    v = slrt_border(s, sector->left);
    return slrt_is_part_in_range(s, &right, &left, sector->right == to_right ? NULL : &u,
                                 sector->left == to_left ? NULL : &v);
}

/// Marks for an eye on a mirror, which is its own image, the cells that it stands in.
static void slrt_mark_own_of_image(const slrt_reflected *from, slrt_search *image) {
    const slrt_search *first = from->first;
    uint32_t i;
    // One alone is not marked, and the path may have run over its number.
    if (first->own_count < 2 || image->x != first->x || image->y != first->y) return;
    for (i = 0; i < first->own_count; i++) {
        const uint32_t own = slrt_own_cells(first)[i];
        image->marks[own] = first->marks[own] & SLRT_OWN;
    }
}

/// Looks from the eye's image, through a piece of a mirror, into the cell before it.
static void slrt_look_in_mirror(slrt_reflected *from, uint32_t cell, uint32_t mirror,
                                const slrt_sector *seen) {
    const sl_runtime *rt = from->s.rt;
    const slrt_arm u = slrt_border(&from->s, seen->right), v = slrt_border(&from->s, seen->left);
    const double eye[2] = {from->s.x, from->s.y};
    uint64_t *patience = slrt_mirrors_patience(from);
    double m[6], image[2], border[4];
    bool rounded = false;
    slrt_sector sector;
    slrt_reflected to;
    slrt_reflection(rt->mirror_lines + (size_t)mirror * SLRT_MIRROR_BYTES, m);
    slrt_reflect_place(m, eye, image, &rounded);
    if (rounded || *patience <= rt->cell_count / 16 ||
        (from->s.is_image && image[0] == eye[0] && image[1] == eye[1])) {
        *from->rounded = true;
        return;
    }
    to = *from;
    to.mirror = mirror;
    to.depth--;
    to.s.x = image[0], to.s.y = image[1];
    to.s.is_image = true;
    to.s.has_row = false;
    to.s.depth = to.s.room = 0;
    to.s.patience = *patience - rt->cell_count / 16;
    to.s.path += sl_runtime_scratch_count(rt);
    to.s.sectors = to.s.path + 4 * (size_t)rt->cell_count;
    to.s.marks = (unsigned char *)(to.s.path + 6 * (size_t)rt->cell_count);
    memset(to.s.marks, 0, rt->cell_count);
    slrt_mark_own_of_image(from, &to.s);
    slrt_reflect_border(m, &v, border);
    to.s.cone[0] = slrt_arm_of(border);
    slrt_reflect_border(m, &u, border);
    to.s.cone[1] = slrt_arm_of(border);
    sector.right = SLRT_ARM;
    sector.left = SLRT_ARM + 1;
    sector.along = (seen->along & SLRT_ALONG_RIGHT ? (unsigned)SLRT_ALONG_LEFT : 0u) |
                   (seen->along & SLRT_ALONG_LEFT ? (unsigned)SLRT_ALONG_RIGHT : 0u);
    sector.limited = seen->limited;
    slrt_search_from(&to.s, cell, &sector);
    *patience = to.s.patience;
    if (to.s.gave_up) *from->rounded = true;
}

/// Looks into a mirror from a cell, through a sector.
static void slrt_see_in(slrt_reflected *r, uint32_t cell, uint32_t mirror,
                        const slrt_sector *sector) {
    const sl_runtime_cell c = sl_runtime_get_cell(r->s.rt, cell);
    uint32_t i;
    for (i = 0; i < c.vertex_count; i++) {
        slrt_piece piece;
        slrt_sector part = *sector;
        slrt_read_vertex(r->s.rt, &c, i, piece.a);
        slrt_read_vertex(r->s.rt, &c, slrt_next_corner(&c, i), piece.b);
        if (slrt_cut_to_mirror(r->s.rt, cell,
                               r->s.rt->mirror_lines + (size_t)mirror * SLRT_MIRROR_BYTES,
                               &piece) &&
            slrt_narrow_to_mirror(&r->s, &piece, &part))
            slrt_look_in_mirror(r, cell, mirror, &part);
    }
}

/// Notes a cell that is entered, and looks into its mirrors.
static void slrt_meet_mirrors(slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    slrt_reflected *r = (slrt_reflected *)s;
    const sl_runtime *rt = s->rt;
    const sl_runtime_cell c = sl_runtime_get_cell(rt, cell);
    double low[2], high[2], at[2];
    uint64_t *patience = slrt_mirrors_patience(r);
    uint32_t i;
    int k;
    if (s->is_image) r->by_mirror[cell] = 1;
    if (!r->depth) return;
    slrt_read_vertex(rt, &c, 0, low);
    memcpy(high, low, sizeof high);
    for (i = 1; i < c.vertex_count; i++) {
        slrt_read_vertex(rt, &c, i, at);
        for (k = 0; k < 2; k++) {
            if (at[k] < low[k]) low[k] = at[k];
            if (at[k] > high[k]) high[k] = at[k];
        }
    }
    for (i = 0; i < rt->mirror_count && *patience; i++) {
        --*patience;
        // Behind a mirror its own side is behind the line of sight, but for rounding.
        if (i != r->mirror &&
            slrt_is_near_cell(rt->mirror_lines + (size_t)i * SLRT_MIRROR_BYTES, low, high))
            slrt_see_in(r, cell, i, sector);
    }
    if (i < rt->mirror_count) *r->rounded = true;
}

SL_RUNTIME_API size_t sl_runtime_mirrored_scratch_count(const sl_runtime *runtime, uint32_t depth) {
    const size_t most = SLRT_MOST_REFLECTIONS;
    return sl_runtime_scratch_count(runtime) * (1 + (depth < most ? depth : most)) +
           ((size_t)runtime->cell_count + 3) / 4;
}

SL_RUNTIME_API uint32_t sl_runtime_look_into_mirrors(const sl_runtime *runtime,
                                                     const sl_runtime_view *view,
                                                     const unsigned char *shut, double range,
                                                     uint32_t depth, uint32_t *mirrored_scratch,
                                                     uint32_t *cells, uint32_t room,
                                                     uint32_t *direct, bool *rounded) {
    slrt_reflected r;
    uint32_t i;
    *direct = 0;
    *rounded = false;
    memset(&r, 0, sizeof r);
    if (!slrt_start_search(&r.s, runtime, view, shut, range, mirrored_scratch)) return 0;
    r.first = &r.s;
    r.rounded = rounded;
    r.depth = depth;
    if (r.depth > SLRT_MOST_REFLECTIONS) r.depth = SLRT_MOST_REFLECTIONS;
    r.mirror = SLRT_NONE;
    r.patience = (uint64_t)SLRT_PATIENCE * 16 *
                 ((uint64_t)runtime->directed_count + runtime->vertex_count + 16);
    r.s.cells = cells;
    r.s.room = room;
    r.s.in_mirrors = runtime->mirror_count && r.depth;
    r.by_mirror = (unsigned char *)(mirrored_scratch +
                                    sl_runtime_scratch_count(runtime) * (1 + (size_t)r.depth));
    memset(r.by_mirror, 0, runtime->cell_count);
    if (r.s.in_mirrors) r.s.meet = slrt_meet_mirrors;
    slrt_run_search(&r.s);
    *direct = r.s.count;
    if (runtime->mirrors && depth && (!runtime->mirror_count || runtime->loose || r.s.gave_up))
        *rounded = true;
    for (i = 0; r.s.in_mirrors && i < runtime->cell_count; i++)
        if (r.by_mirror[i]) slrt_see(&r.s, i);
    if (*rounded) slrt_see_mirrored(&r.s);
    return r.s.count;
}

/// Box to box: what is seen from anywhere in a box, by a search through portals.
///
/// A beam is all lines of sight that start in a part of the box and pass some portals in turn. On
/// each side a bound holds it: behind the portals, no line of the beam is to the left of the left
/// bound.
///
///            l2 |                The left bound leads from a right end to a later left end, as
///        l1 |   |                r1 to l2, or from a corner of the box to a left end. A portal
///     box   |   r2               turns it if its left end lies to the right of it. It stays where
///           r1                   it was if no such line is a bound for sure.
///
/// What is left out is so for sure: a sign that rounding may change counts for sight. And any bound
/// through these points leaves out no line of sight, so which of them is the best may be rounded.

/// A bound. Its points are `from` and `to`: ends of portals, numbered as borders of sectors, or
/// corners of boxes. `from` is SLRT_NONE for no bound, as of two points in one place.
typedef struct slrt_bound {
    uint32_t from, to;
    slrt_arm arm; ///< from one to the other
} slrt_bound;

/// Corners of the box's part that the beams start in, then those of the box: 1 right, 2 top.
#define SLRT_PART_CORNER (UINT32_MAX - 8)
#define SLRT_BOX_CORNER  (UINT32_MAX - 4)

enum { SLRT_RIGHT, SLRT_LEFT };

typedef struct slrt_beam {
    slrt_bound bounds[2];
} slrt_beam;

/// A cell on the path: its number, how many of the ways out are done, the points of the bounds.
enum { SLRT_BEAM_CELL, SLRT_BEAM_DONE, SLRT_BEAM_BOUNDS, SLRT_BEAM_STEP = SLRT_BEAM_BOUNDS + 4 };

/// A beam that came into a cell.
typedef struct slrt_past_beam {
    uint32_t cell, entry; ///< the directed portal that it came through
    uint32_t source;      ///< the cell that it started in
    uint32_t line;        ///< 1 if it is all in one line
    uint32_t bounds[4];
} slrt_past_beam;

/// So many past beams are remembered.
#ifndef SLRT_PAST_BEAMS
#define SLRT_PAST_BEAMS 256
#endif

/// The ways out of the first cell through a directed portal.
enum { SLRT_WAYS = 5 };

/// The limit of portals that the beams of a box come to, for each directed portal of the map.
#ifndef SLRT_BEAM_PATIENCE
#define SLRT_BEAM_PATIENCE 16
#endif

typedef struct slrt_beams {
    const sl_runtime *rt;
    const unsigned char *shut; ///< NULL for none
    double range;              ///< 0 for no limit
    double box[4];             ///< within the bounds of the map
    uint32_t source;           ///< the cell that the beams start in
    double part[4];            ///< the part of the box within the bounds of that cell
    const double *target;      ///< beams beside this box are left out; NULL for none
    /// For each cell that a beam comes to, and the first. True ends the search.
    bool (*meet)(struct slrt_beams *b, uint32_t cell, const slrt_beam *beam);
    void *context;
    uint64_t patience;
    uint32_t *path, depth, *on_path; ///< on_path: a bit for each cell
    slrt_beam beam;                  ///< in the cell on top of the path
    sl_runtime_cell cell;            ///< that cell
    uint32_t entry;                  ///< the directed portal to it, or SLRT_NONE
    slrt_past_beam past[SLRT_PAST_BEAMS];
} slrt_beams;

// --- boxes and lines

/// The part of a box within bounds that it meets.
static void slrt_part_in(const double bounds[4], const double box[4], double part[4]) {
    int k;
    for (k = 0; k < 2; k++) {
        part[k] = box[k] > bounds[k] ? box[k] : bounds[k];
        part[2 + k] = box[2 + k] < bounds[2 + k] ? box[2 + k] : bounds[2 + k];
    }
}

/// The side of a line that a point is on, without the exact sign: 1 left, -1 right, 0 if rounding
/// may decide.
static int slrt_surely(const slrt_arm *line, double x, double y) {
    const double left = line->x * (y - line->from_y), right = line->y * (x - line->from_x);
    const double product = left - right;
    const double bound =
        4e-16 * ((left < 0 ? -left : left) + (right < 0 ? -right : right)) + 1e-300;
    return (product > bound) - (-product > bound);
}

/// Whether all of a box is to the left (1) or right (-1) of a line for sure.
static bool slrt_is_box_beside(const slrt_arm *line, const double box[4], int side) {
    const bool up = side * line->y > 0, right = side * line->x > 0;
    return slrt_surely(line, box[up ? 2 : 0], box[right ? 1 : 3]) * side > 0;
}

static bool slrt_is_beam_beside(const slrt_beam *beam, const double box[4]) {
    const slrt_bound *right = &beam->bounds[SLRT_RIGHT], *left = &beam->bounds[SLRT_LEFT];
    return (right->from != SLRT_NONE && slrt_is_box_beside(&right->arm, box, -1)) ||
           (left->from != SLRT_NONE && slrt_is_box_beside(&left->arm, box, 1));
}

/// Whether a box is out of range of all of the box that looks, for sure.
static bool slrt_is_out_of_range(const slrt_beams *b, const double box[4]) {
    double square = 0;
    int k;
    if (!(b->range > 0)) return false;
    for (k = 0; k < 2; k++) {
        const double over = box[k] - b->box[2 + k], under = b->box[k] - box[2 + k];
        const double gap = (over > under ? over : under) / b->range;
        if (gap > 0) square += gap * gap;
    }
    return square > 1 + 1e-12;
}

// --- bounds

static void slrt_point_of(const slrt_beams *b, uint32_t number, double *x, double *y) {
    if (number >= SLRT_PART_CORNER) {
        const double *box = number < SLRT_BOX_CORNER ? b->part : b->box;
        const uint32_t corner = (number - SLRT_PART_CORNER) % 4;
        *x = box[corner & 1 ? 2 : 0];
        *y = box[corner & 2 ? 3 : 1];
    } else {
        double end[2];
        slrt_read_end(b->rt, number / 2, (int)(number % 2), end);
        *x = end[0];
        *y = end[1];
    }
}

static slrt_bound slrt_make_bound(const slrt_beams *b, uint32_t from, uint32_t to) {
    slrt_bound bound;
    double x, y, to_x, to_y;
    memset(&bound, 0, sizeof bound);
    bound.from = from;
    bound.to = to;
    if (from == SLRT_NONE) return bound;
    slrt_point_of(b, from, &x, &y);
    slrt_point_of(b, to, &to_x, &to_y);
    bound.arm = slrt_make_arm(x, y, to_x, to_y);
    if (slrt_is_zero(&bound.arm)) bound.from = SLRT_NONE;
    return bound;
}

/// The corner of the part from which a line to a point has all of the part on its left or right.
/// SLRT_NONE for a point in the part.
static uint32_t slrt_tangent(const double part[4], double x, double y, int side) {
    // By column and row of the point about the part.
    static const unsigned char corners[3][3][2] = {
        {{1, 2}, {0, 2}, {0, 3}}, {{1, 0}, {0, 0}, {2, 3}}, {{3, 0}, {3, 1}, {2, 1}}};
    const int column = x < part[0] ? 0 : x > part[2] ? 2 : 1;
    const int row = y < part[1] ? 0 : y > part[3] ? 2 : 1;
    if (column == 1 && row == 1) return SLRT_NONE;
    return SLRT_PART_CORNER + corners[column][row][side];
}

/// Turns a bound of a beam to the end of a directed portal on its side, if that leaves more out.
/// `across` leads from the portal's right end to its left; `last` is the last point of the other
/// bound, or SLRT_NONE.
static void slrt_turn_bound(const slrt_beams *b, slrt_bound *bound, uint32_t last,
                            uint32_t directed, const slrt_arm *across, int side) {
    const int sign = side == SLRT_LEFT ? 1 : -1;
    const uint32_t end = 2 * directed + (side == SLRT_RIGHT), from = bound->from;
    const double x = side == SLRT_LEFT ? across->to_x : across->from_x;
    const double y = side == SLRT_LEFT ? across->to_y : across->from_y;
    const slrt_arm *arm = &bound->arm;
    // All lines of the beam have these points on the other side, or start where the first one says.
    uint32_t pivots[4];
    int i;
    if (from != SLRT_NONE && sign * (arm->x * (y - arm->from_y) - arm->y * (x - arm->from_x)) >= 0)
        return;
    pivots[0] = slrt_tangent(b->part, x, y, side);
    pivots[1] = from >= SLRT_PART_CORNER && from < SLRT_BOX_CORNER ? SLRT_NONE : from;
    pivots[2] = last;
    pivots[3] = b->entry == SLRT_NONE ? SLRT_NONE : 2 * b->entry + (side == SLRT_LEFT);
    for (i = 0; i < 4; i++) {
        double from_x, from_y;
        if (pivots[i] == SLRT_NONE || (i == 3 && pivots[3] == last)) continue;
        slrt_point_of(b, pivots[i], &from_x, &from_y);
        if (bound->from != SLRT_NONE && bound->to == end &&
            sign * (arm->x * (from_y - arm->from_y) - arm->y * (from_x - arm->from_x)) <= 0)
            continue;
        // Only from before the portal does a line to its end bound what is behind it.
        if (slrt_surely(across, from_x, from_y) <= 0) continue;
        bound->from = pivots[i];
        bound->to = end;
        bound->arm = slrt_make_arm(from_x, from_y, x, y);
    }
}

// --- portals

/// Whether a directed portal is on a shut door, or on glass that is dark from all of the box.
static bool slrt_is_closed(const slrt_beams *b, uint32_t portal) {
    const sl_runtime *rt = b->rt;
    uint32_t i;
    if (!rt->seam_portal_count) return false;
    for (i = slrt_first_seam(rt, portal); i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12, *seam;
        slrt_arm line;
        if (slrt_u32(on) != portal) return false;
        seam = rt->seams + (size_t)slrt_u32(on + 4) * 40;
        if (slrt_u32(seam + 32) == 1 && b->shut && b->shut[slrt_u32(seam + 36)]) return true;
        if (slrt_u32(seam + 32) != 2) continue;
        line = slrt_make_arm(slrt_f64(seam), slrt_f64(seam + 8), slrt_f64(seam + 16),
                             slrt_f64(seam + 24));
        if (slrt_is_box_beside(&line, b->box, 1)) return true;
    }
    return false;
}

/// Whether a point is beyond a side of the box: left, right, bottom, top.
static bool slrt_is_beyond(const double box[4], const double point[2], int side) {
    return side & 1 ? point[side / 2] > box[2 + side / 2] : point[side / 2] < box[side / 2];
}

/// Whether no corner of the part is before a portal: `across` leads from its right end to its left.
static bool slrt_is_part_on(const slrt_beams *b, const slrt_arm *across) {
    const slrt_arm to =
        slrt_make_arm(across->from_x, across->from_y, b->part[across->y > 0 ? 0 : 2],
                      b->part[across->x > 0 ? 3 : 1]);
    return slrt_side(across, &to) <= 0;
}

/// Whether the part is nearer to a portal's right end than to its left.
static bool slrt_is_part_right(const slrt_beams *b, const slrt_arm *across) {
    return slrt_size(b->part[0] - across->from_x, b->part[1] - across->from_y) <
           slrt_size(b->part[0] - across->to_x, b->part[1] - across->to_y);
}

/// The ways out of the first cell through a directed portal. Lines that cross it within the box are
/// those of the part in the next cell, which has its own beams. All others leave the box before,
/// across one of its sides, and stay beyond it. Way 0 is the whole portal, if it is beyond a side
/// or leads to solid ground; else ways 1 to 4 are what is beyond a side.
static bool slrt_is_whole(const slrt_beams *b, const sl_runtime_directed_portal *p) {
    int side;
    for (side = 0; side < 4; side++)
        if (slrt_is_beyond(b->box, p->left, side) && slrt_is_beyond(b->box, p->right, side))
            return true;
    return sl_runtime_is_solid(b->rt, p->cell);
}

/// Bounds a beam by the side of the box that it leaves across; false for no such beam. From a part
/// that is on the portal's line, only that line crosses it.
static bool slrt_leave_box(const slrt_beams *b, const sl_runtime_directed_portal *p,
                           uint32_t directed, const slrt_arm *across, uint32_t way,
                           slrt_beam *beam) {
    // The ends of the sides, clockwise about the box.
    static const unsigned char from[4] = {0, 3, 1, 2}, to[4] = {2, 1, 0, 3};
    const int side = (int)way - 1;
    bool left = way && slrt_is_beyond(b->box, p->left, side);
    if (way && left == slrt_is_beyond(b->box, p->right, side)) return false;
    if (slrt_is_part_on(b, across) && !sl_runtime_is_solid(b->rt, p->cell)) {
        if (!way) left = slrt_is_part_right(b, across);
        beam->bounds[0] = slrt_make_bound(b, 2 * directed + left, 2 * directed + !left);
        beam->bounds[1] = beam->bounds[0];
    } else if (way) {
        const uint32_t first = SLRT_BOX_CORNER + (left ? from : to)[side];
        const uint32_t last = SLRT_BOX_CORNER + (left ? to : from)[side];
        beam->bounds[left ? SLRT_RIGHT : SLRT_LEFT] = slrt_make_bound(b, first, last);
    }
    return true;
}

static uint32_t slrt_last_point(const slrt_bound *bound) {
    return bound->from == SLRT_NONE ? SLRT_NONE : bound->to;
}

/// Whether no line of a beam crosses a portal, for sure: it lies to one side of a bound, or all
/// lines would cross it the other way. That one end is beside a bound does not tell: lines may come
/// to the other end from behind.
static bool slrt_is_portal_beside(const slrt_beam *beam, const slrt_arm *across) {
    const slrt_bound *right = &beam->bounds[SLRT_RIGHT], *left = &beam->bounds[SLRT_LEFT];
    const bool beside_left =
        left->from != SLRT_NONE && slrt_surely(&left->arm, across->from_x, across->from_y) > 0;
    const bool beside_right =
        right->from != SLRT_NONE && slrt_surely(&right->arm, across->to_x, across->to_y) < 0;
    if (!beside_left && !beside_right) return false;
    if ((beside_left && slrt_surely(&left->arm, across->to_x, across->to_y) > 0) ||
        (beside_right && slrt_surely(&right->arm, across->from_x, across->from_y) < 0))
        return true;
    return right->from != SLRT_NONE && left->from != SLRT_NONE &&
           slrt_side(&right->arm, &left->arm) > 0 && slrt_side(&right->arm, across) < 0 &&
           slrt_side(&left->arm, across) < 0;
}

static bool slrt_is_portal_far(const slrt_beams *b, const slrt_arm *across) {
    double box[4];
    box[0] = across->x < 0 ? across->to_x : across->from_x;
    box[1] = across->y < 0 ? across->to_y : across->from_y;
    box[2] = across->x < 0 ? across->from_x : across->to_x;
    box[3] = across->y < 0 ? across->from_y : across->to_y;
    return slrt_is_out_of_range(b, box);
}

/// The part of the beam on top of the path that leaves through a directed portal; false for none.
static bool slrt_pass_portal(const slrt_beams *b, const sl_runtime_directed_portal *p,
                             uint32_t directed, uint32_t way, slrt_beam *out) {
    const slrt_arm across = slrt_make_arm(p->right[0], p->right[1], p->left[0], p->left[1]);
    slrt_bound *right = &out->bounds[SLRT_RIGHT], *left = &out->bounds[SLRT_LEFT];
    uint32_t right_last, left_last;
    if (slrt_is_portal_beside(&b->beam, &across)) return false;
    *out = b->beam;
    if ((b->range > 0 && slrt_is_portal_far(b, &across)) || slrt_is_closed(b, p->portal) ||
        (b->depth == 1 && !slrt_leave_box(b, p, directed, &across, way, out)))
        return false;
    right_last = slrt_last_point(right);
    left_last = slrt_last_point(left);
    slrt_turn_bound(b, right, left_last, directed, &across, SLRT_RIGHT);
    slrt_turn_bound(b, left, right_last, directed, &across, SLRT_LEFT);
    return !b->target || !slrt_is_beam_beside(out, b->target);
}

// --- the search

/// Whether a beam is all in one line.
static bool slrt_is_one_line(const slrt_beam *beam) {
    const slrt_bound *right = &beam->bounds[SLRT_RIGHT], *left = &beam->bounds[SLRT_LEFT];
    const slrt_arm to =
        slrt_make_arm(right->arm.from_x, right->arm.from_y, left->arm.to_x, left->arm.to_y);
    return right->from != SLRT_NONE && left->from != SLRT_NONE &&
           !slrt_side(&right->arm, &left->arm) && !slrt_side(&right->arm, &to) &&
           slrt_same_way(&right->arm, &left->arm);
}

static int slrt_turn_of(const slrt_arm *line, const double point[2]) {
    const slrt_arm to = slrt_make_arm(line->from_x, line->from_y, point[0], point[1]);
    return slrt_side(line, &to);
}

/// Whether a line is that of a past beam, and touches the portal through which that came.
static bool slrt_is_past_line(const slrt_beams *b, const slrt_past_beam *past,
                              const slrt_arm *line) {
    const slrt_bound was = slrt_make_bound(b, past->bounds[0], past->bounds[1]);
    const double from[2] = {line->from_x, line->from_y};
    double right[2], left[2];
    slrt_read_end(b->rt, past->entry, 1, right);
    slrt_read_end(b->rt, past->entry, 0, left);
    return !slrt_side(&was.arm, line) && !slrt_turn_of(&was.arm, from) &&
           slrt_same_way(&was.arm, line) && slrt_turn_of(line, right) <= 0 &&
           slrt_turn_of(line, left) >= 0;
}

/// Whether a beam that came to a cell before had all lines of this one, and bounds that hold for
/// them. If not, this one takes its place. (It is not enough that the other one has shown all that
/// this one does of the cell: behind the next portal it may show less.)
static bool slrt_is_past(slrt_beams *b, uint32_t cell, uint32_t entry, const slrt_beam *beam) {
    const bool line = slrt_is_one_line(beam);
    slrt_past_beam now, *past = &b->past[(line ? cell : entry) % SLRT_PAST_BEAMS];
    int side;
    now.cell = cell;
    now.entry = entry;
    now.source = b->source;
    now.line = line;
    for (side = 0; side < 2; side++) {
        now.bounds[2 * side] = beam->bounds[side].from;
        now.bounds[2 * side + 1] = beam->bounds[side].to;
    }
    if (line && past->line && past->cell == cell && past->source == b->source &&
        slrt_is_past_line(b, past, &beam->bounds[SLRT_RIGHT].arm))
        return true;
    if (!memcmp(past, &now, sizeof now)) return true;
    *past = now;
    return false;
}

/// Puts a cell on top of the path.
static void slrt_come_to(slrt_beams *b, uint32_t cell, uint32_t entry, const slrt_beam *beam) {
    uint32_t *top = b->path + SLRT_BEAM_STEP * (size_t)b->depth++;
    int side;
    top[SLRT_BEAM_CELL] = cell;
    top[SLRT_BEAM_DONE] = 0;
    for (side = 0; side < 2; side++) {
        top[SLRT_BEAM_BOUNDS + 2 * side] = beam->bounds[side].from;
        top[SLRT_BEAM_BOUNDS + 2 * side + 1] = beam->bounds[side].to;
    }
    b->on_path[cell / 32] |= UINT32_C(1) << cell % 32;
    b->cell = sl_runtime_get_cell(b->rt, cell);
    b->entry = entry;
    b->beam = *beam;
}

static void slrt_leave_top(slrt_beams *b) {
    const uint32_t cell = b->path[SLRT_BEAM_STEP * (size_t)--b->depth];
    b->on_path[cell / 32] &= ~(UINT32_C(1) << cell % 32);
}

/// How many ways there are out of the cell on top.
static uint32_t slrt_ways(const slrt_beams *b) {
    return b->cell.directed_count * (b->depth == 1 ? SLRT_WAYS : 1);
}

/// Goes back to a cell with ways that are not done.
static void slrt_go_back(slrt_beams *b) {
    const uint32_t *top;
    do {
        slrt_leave_top(b);
        if (!b->depth) return;
        top = b->path + SLRT_BEAM_STEP * (size_t)(b->depth - 1);
        b->cell = sl_runtime_get_cell(b->rt, top[SLRT_BEAM_CELL]);
    } while (top[SLRT_BEAM_DONE] == slrt_ways(b));
    b->beam.bounds[0] = slrt_make_bound(b, top[SLRT_BEAM_BOUNDS], top[SLRT_BEAM_BOUNDS + 1]);
    b->beam.bounds[1] = slrt_make_bound(b, top[SLRT_BEAM_BOUNDS + 2], top[SLRT_BEAM_BOUNDS + 3]);
    b->entry = SLRT_NONE;
    if (b->depth == 1) return;
    top -= SLRT_BEAM_STEP;
    b->entry = sl_runtime_get_cell(b->rt, top[SLRT_BEAM_CELL]).first_directed +
               (top[SLRT_BEAM_DONE] - 1) / (b->depth == 2 ? SLRT_WAYS : 1);
}

/// Follows the next way out of the cell on top. True if `meet` ends the search.
static bool slrt_go_on(slrt_beams *b) {
    uint32_t *done = b->path + SLRT_BEAM_STEP * (size_t)(b->depth - 1) + SLRT_BEAM_DONE;
    const uint32_t ways = b->depth == 1 ? SLRT_WAYS : 1, way = *done % ways;
    const uint32_t directed = b->cell.first_directed + (*done)++ / ways;
    const sl_runtime_directed_portal p = sl_runtime_get_directed_portal(b->rt, directed);
    slrt_beam beam;
    if (b->depth == 1 && !way) {
        if (!slrt_is_whole(b, &p)) return false;
        *done += SLRT_WAYS - 1;
    }
    // A line passes a convex cell once.
    if (b->on_path[p.cell / 32] >> p.cell % 32 & 1 ||
        !slrt_pass_portal(b, &p, directed, way, &beam) || slrt_is_past(b, p.cell, directed, &beam))
        return false;
    slrt_come_to(b, p.cell, directed, &beam);
    return b->meet(b, p.cell, &beam);
}

/// Sends beams from the part of the box that is in a cell. Returns true if `meet` ended the search,
/// or it took too long.
static bool slrt_send_beams(slrt_beams *b, uint32_t source) {
    slrt_beam beam;
    double bounds[4];
    bool ended;
    memset(&beam, 0, sizeof beam);
    beam.bounds[0].from = beam.bounds[1].from = SLRT_NONE;
    b->source = source;
    b->depth = 0;
    slrt_come_to(b, source, SLRT_NONE, &beam);
    slrt_bounds_of(b->rt, &b->cell, bounds);
    slrt_part_in(bounds, b->box, b->part);
    ended = b->meet(b, source, &beam);
    while (b->depth && !ended) {
        const uint32_t *top = b->path + SLRT_BEAM_STEP * (size_t)(b->depth - 1);
        if (top[SLRT_BEAM_DONE] == slrt_ways(b))
            slrt_go_back(b);
        else if (b->patience--)
            ended = slrt_go_on(b);
        else
            ended = true;
    }
    while (b->depth) slrt_leave_top(b);
    return ended;
}

// --- Whole servers: which players may see which things

/// The part of a box, with a margin around it, within the bounds of the map. False for none. It is
/// where the points of the box are for sl_runtime_sees, too, by slrt_no_dust.
static bool slrt_box_in_map(const sl_runtime *rt, const sl_runtime_box *of, double margin,
                            double box[4]) {
    const double low_x = slrt_no_dust(of->min_x - margin), low_y = slrt_no_dust(of->min_y - margin);
    const double high_x = slrt_no_dust(of->max_x + margin);
    const double high_y = slrt_no_dust(of->max_y + margin);
    box[0] = low_x > rt->min_x ? low_x : rt->min_x;
    box[1] = low_y > rt->min_y ? low_y : rt->min_y;
    box[2] = high_x < rt->max_x ? high_x : rt->max_x;
    box[3] = high_y < rt->max_y ? high_y : rt->max_y;
    return low_x <= high_x && low_y <= high_y && box[0] <= box[2] && box[1] <= box[3];
}

// --- from all of a box

/// A search from the cells of a box.
typedef struct slrt_origin {
    slrt_beams beams;
    uint32_t sources[32], count; ///< the last cells that it came from: a cell may be visited again
} slrt_origin;

static bool slrt_look_from_cell(void *context, uint32_t cell) {
    slrt_origin *o = (slrt_origin *)context;
    enum { MOST = sizeof o->sources / sizeof *o->sources };
    uint32_t i;
    for (i = 0; i < MOST && i < o->count; i++)
        if (o->sources[i] == cell) return true;
    if (sl_runtime_is_solid(o->beams.rt, cell) || !slrt_meets_box(o->beams.rt, cell, o->beams.box))
        return true;
    o->sources[o->count++ % MOST] = cell;
    return !slrt_send_beams(&o->beams, cell);
}

/// Prepares searches. `scratch` has six numbers and a bit for each cell.
static void slrt_start_origin(slrt_origin *o, const sl_runtime *rt, const unsigned char *shut,
                              double range, uint32_t *scratch) {
    memset(&o->beams, 0, sizeof o->beams);
    o->beams.rt = rt;
    o->beams.shut = shut;
    o->beams.range = slrt_range(rt, range);
    o->beams.path = scratch;
    o->beams.on_path = scratch + SLRT_BEAM_STEP * (size_t)rt->cell_count;
    memset(o->beams.on_path, 0, ((size_t)rt->cell_count + 31) / 32 * sizeof *scratch);
}

/// Looks from all of a box. True if `meet` ended the search, or it took too long.
static bool slrt_look_from_box(slrt_origin *o, const sl_runtime_box *box, double margin) {
    if (!slrt_box_in_map(o->beams.rt, box, margin, o->beams.box)) return false;
    memset(o->beams.past, 0xff, sizeof o->beams.past);
    o->beams.patience = SLRT_BEAM_PATIENCE * ((uint64_t)o->beams.rt->directed_count + 1024);
    o->count = 0;
    return !slrt_visit_near(o->beams.rt, o->beams.box, slrt_look_from_cell, o);
}

// --- one box

static bool slrt_meet_target(slrt_beams *b, uint32_t cell, const slrt_beam *beam) {
    double bounds[4], part[4];
    if (!slrt_meets_box(b->rt, cell, b->target)) return false;
    slrt_bounds_of(b->rt, &b->cell, bounds);
    slrt_part_in(bounds, b->target, part);
    return !slrt_is_beam_beside(beam, part) && !slrt_is_out_of_range(b, part);
}

static sl_runtime_box slrt_square(double x, double y, double radius) {
    sl_runtime_box box;
    box.min_x = x - radius;
    box.min_y = y - radius;
    box.max_x = x + radius;
    box.max_y = y + radius;
    box.blocks = false;
    return box;
}

SL_RUNTIME_API bool sl_runtime_sees_within(const sl_runtime *runtime, double x0, double y0,
                                           double radius0, double x1, double y1, double radius1,
                                           const unsigned char *shut, double range,
                                           uint32_t *scratch) {
    const sl_runtime_box from = slrt_square(x0, y0, radius0), to = slrt_square(x1, y1, radius1);
    slrt_origin o;
    double target[4];
    if (!slrt_box_in_map(runtime, &to, 0, target)) return false;
    slrt_start_origin(&o, runtime, shut, range, scratch);
    o.beams.target = target;
    o.beams.meet = slrt_meet_target;
    return slrt_look_from_box(&o, &from, 0);
}

// --- many things

// Memory: that of a search, the first entry of each cell, and the entries. An entry is two numbers:
// a thing that comes near the cell, and the cell's next entry. Most cells are never looked into: of
// which things touch a cell is found when the first beam comes to it. There is room for a thing in
// each cell, and 16 entries for each thing. Then the parts of the things in the map, four doubles
// each.

/// Added to a cell's first entry: some of its things may not touch it.
#define SLRT_UNSORTED UINT32_C(0x80000000)

enum { SLRT_THING_PART = 4 * sizeof(double) / sizeof(uint32_t) };

typedef struct slrt_relevant {
    slrt_origin origin;
    const sl_runtime_box *things;
    uint32_t *first, *entries, *parts, count;
    size_t room;
    uint32_t thing; ///< is being placed
    unsigned char *bits;
    size_t pairs;
} slrt_relevant;

/// The part of a thing that has been placed within the bounds of the map.
static void slrt_thing_in_map(const slrt_relevant *t, uint32_t thing, double box[4]) {
    memcpy(box, t->parts + SLRT_THING_PART * (size_t)thing, SLRT_THING_PART * sizeof *t->parts);
}

static bool slrt_place_thing(void *context, uint32_t cell) {
    slrt_relevant *t = (slrt_relevant *)context;
    uint32_t *first = t->first + cell;
    const size_t at = *first & ~SLRT_UNSORTED;
    if (*first != SLRT_NO_ENTRY && t->entries[2 * at] == t->thing) return true;
    if (t->count == t->room) return false;
    t->entries[2 * (size_t)t->count] = t->thing;
    t->entries[2 * (size_t)t->count + 1] = *first == SLRT_NO_ENTRY ? *first : (uint32_t)at;
    *first = t->count++ | SLRT_UNSORTED;
    return true;
}

/// Keeps of a cell's things those that touch it.
static void slrt_sort_things(slrt_relevant *t, uint32_t cell) {
    uint32_t *link = t->first + cell;
    *link &= ~SLRT_UNSORTED;
    while (*link != SLRT_NO_ENTRY) {
        uint32_t *entry = t->entries + 2 * (size_t)*link;
        double box[4];
        slrt_thing_in_map(t, *entry, box);
        if (slrt_meets_box(t->origin.beams.rt, cell, box))
            link = entry + 1;
        else
            *link = entry[1];
    }
}

static bool slrt_meet_things(slrt_beams *b, uint32_t cell, const slrt_beam *beam) {
    slrt_relevant *t = (slrt_relevant *)b->context;
    double bounds[4];
    uint32_t at = t->first[cell];
    if (at == SLRT_NO_ENTRY) return false;
    if (at & SLRT_UNSORTED) slrt_sort_things(t, cell);
    slrt_bounds_of(b->rt, &b->cell, bounds);
    for (at = t->first[cell]; at != SLRT_NO_ENTRY; at = t->entries[2 * (size_t)at + 1]) {
        const uint32_t thing = t->entries[2 * (size_t)at];
        double box[4], part[4];
        if (t->bits[thing / 8] >> thing % 8 & 1) continue;
        slrt_thing_in_map(t, thing, box);
        slrt_part_in(bounds, box, part);
        if (slrt_is_beam_beside(beam, part) || slrt_is_out_of_range(b, part)) continue;
        t->bits[thing / 8] |= (unsigned char)(1 << thing % 8);
        t->pairs++;
    }
    return false;
}

/// Places things until there is no room. The last one and those that are left have their turn after
/// these.
static void slrt_place_things(slrt_relevant *t, uint32_t thing_count) {
    const sl_runtime *rt = t->origin.beams.rt;
    double box[4];
    memset(t->first, 0xff, rt->cell_count * sizeof *t->first);
    t->count = 0;
    for (; t->thing < thing_count; t->thing++) {
        uint32_t *part = t->parts + SLRT_THING_PART * (size_t)t->thing;
        if (!slrt_box_in_map(rt, &t->things[t->thing], 0, box)) continue;
        memcpy(part, box, sizeof box);
        if (!slrt_visit_near(rt, box, slrt_place_thing, t)) return;
    }
}

/// Takes each thing in the map for relevant.
static void slrt_meet_all(slrt_relevant *t, uint32_t thing_count) {
    double box[4];
    uint32_t i;
    for (i = 0; i < thing_count; i++) {
        if (t->bits[i / 8] >> i % 8 & 1 ||
            !slrt_box_in_map(t->origin.beams.rt, &t->things[i], 0, box))
            continue;
        t->bits[i / 8] |= (unsigned char)(1 << i % 8);
        t->pairs++;
    }
}

SL_RUNTIME_API size_t sl_runtime_relevant_count(const sl_runtime *runtime, uint32_t thing_count) {
    return sl_runtime_scratch_count(runtime) + 3 * (size_t)runtime->cell_count +
           (32 + SLRT_THING_PART) * (size_t)thing_count;
}

SL_RUNTIME_API size_t sl_runtime_relevant(const sl_runtime *runtime, const sl_runtime_box *players,
                                          uint32_t player_count, double margin,
                                          const sl_runtime_box *things, uint32_t thing_count,
                                          const unsigned char *shut, double range,
                                          uint32_t *relevant_scratch, unsigned char *bits) {
    const size_t stride = ((size_t)thing_count + 7) / 8;
    slrt_relevant t;
    uint32_t i;
    memset(bits, 0, stride * player_count);
    memset(&t, 0, sizeof t);
    slrt_start_origin(&t.origin, runtime, shut, range, relevant_scratch);
    t.origin.beams.meet = slrt_meet_things;
    t.origin.beams.context = &t;
    t.things = things;
    t.first = relevant_scratch + sl_runtime_scratch_count(runtime);
    t.entries = t.first + runtime->cell_count;
    t.room = runtime->cell_count + 16 * (size_t)thing_count;
    t.parts = t.entries + 2 * t.room;
    if (t.room >= SLRT_UNSORTED) t.room = SLRT_UNSORTED - 1;
    while (t.thing < thing_count) {
        slrt_place_things(&t, thing_count);
        for (i = 0; i < player_count; i++) {
            t.bits = bits + stride * i;
            if (slrt_look_from_box(&t.origin, &players[i], margin)) slrt_meet_all(&t, thing_count);
        }
    }
    return t.pairs;
}

// --- What was explored: the tiles of a grid

// The triangles of the eye and an edge each cover a visible polygon. In a row of tiles a triangle
// has one run of middles.

SL_RUNTIME_API sl_runtime_grid sl_runtime_grid_over(const sl_runtime *runtime, double tile) {
    const double wide = (runtime->max_x - runtime->min_x) / tile;
    const double high = (runtime->max_y - runtime->min_y) / tile;
    sl_runtime_grid grid;
    memset(&grid, 0, sizeof grid);
    grid.min_x = runtime->min_x;
    grid.min_y = runtime->min_y;
    grid.tile = tile;
    if (!(tile > 0) || !(wide < 2147483647.0) || !((wide + 1) * (high + 1) < 2147483648.0))
        return grid;
    grid.columns = (uint32_t)wide + ((uint32_t)wide < wide);
    grid.rows = (uint32_t)high + ((uint32_t)high < high);
    return grid;
}

/// The first tile of `count` along an axis whose middle is not before a place.
static uint32_t slrt_first_tile(double place, double min, double tile, uint32_t count) {
    const double at = (place - min) / tile - 0.5;
    if (!(at > 0)) return 0;
    if (at >= count) return count;
    return (uint32_t)at + ((uint32_t)at < at);
}

/// Widens a run by where an edge of a triangle crosses a line at a height.
static void slrt_widen_run(const double *a, const double *b, double y, double *low, double *high) {
    double x = a[0];
    if ((a[1] < y && b[1] < y) || (a[1] > y && b[1] > y)) return;
    if (a[1] != b[1]) x += (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    if (x < *low) *low = x;
    if (x > *high) *high = x;
    if (a[1] != b[1]) return;
    if (b[0] < *low) *low = b[0];
    if (b[0] > *high) *high = b[0];
}

static uint32_t slrt_explore_row(const sl_runtime_grid *grid, uint32_t row, double low,
                                 double high) {
    uint32_t i = slrt_first_tile(low, grid->min_x, grid->tile, grid->columns), found = 0;
    for (; i < grid->columns && grid->min_x + (i + 0.5) * grid->tile <= high; i++) {
        const size_t n = (size_t)row * grid->columns + i;
        found += !(grid->bits[n / 8] >> n % 8 & 1);
        grid->bits[n / 8] |= (unsigned char)(1 << n % 8);
    }
    return found;
}

SL_RUNTIME_API uint32_t sl_runtime_explore(const sl_runtime_grid *grid, double x, double y,
                                           const double *points, uint32_t count) {
    double eye[2];
    uint32_t i, row, found = 0;
    eye[0] = x;
    eye[1] = y;
    for (i = 0; i < count; i++) {
        const double *a = points + 2 * (size_t)i, *b = i + 1 < count ? a + 2 : points;
        double bottom = a[1] < b[1] ? a[1] : b[1], top = a[1] < b[1] ? b[1] : a[1];
        if (y < bottom) bottom = y;
        if (y > top) top = y;
        row = slrt_first_tile(bottom, grid->min_y, grid->tile, grid->rows);
        for (; row < grid->rows; row++) {
            const double middle = grid->min_y + (row + 0.5) * grid->tile;
            double low = DBL_MAX, high = -DBL_MAX;
            if (middle > top) break;
            slrt_widen_run(eye, a, middle, &low, &high);
            slrt_widen_run(a, b, middle, &low, &high);
            slrt_widen_run(b, eye, middle, &low, &high);
            if (low <= high) found += slrt_explore_row(grid, row, low, high);
        }
    }
    return found;
}

// --- Cell to cell: the lines through a sequence of portals

// All lines with the left ends of some portals on their left and the right ends on their right form
// a convex polygon in the plane of lines. Its corners are lines through two ends. On an edge a line
// turns about one end, the pivot. One more portal cuts the polygon by two half-planes, and all
// signs are of three ends: exact. (The funnel of the library is the same; stab/funnel.c has more.)
//
// Ends are numbered as borders of sectors: 2 * directed portal for the left one, 1 more for the
// right one.

/// A corner: the line from one end to another, and the end about which it turns to the next one.
typedef struct slrt_corner {
    uint32_t from, to, pivot;
} slrt_corner;

/// A step of a sequence: a cell, how many of its ways out are done, the directed portals that bound
/// the directions of all so far, the first one, and the polygon's corners.
typedef struct slrt_stab_step {
    uint32_t cell, done;
    uint32_t least, most;
    uint32_t line;         ///< the first directed portal; SLRT_NONE before it
    uint32_t first, count; ///< corners; none for one portal
} slrt_stab_step;

/// The corners of all steps of a sequence, one behind the other.
typedef struct slrt_stab {
    const sl_runtime *rt;
    slrt_corner *corners;
    uint32_t room;
    bool full; ///< there was no room: nothing is decided
} slrt_stab;

static void slrt_stab_end(const slrt_stab *s, uint32_t end, double *at) {
    slrt_read_end(s->rt, end / 2, (int)(end % 2), at);
}

static slrt_arm slrt_stab_arm(const slrt_stab *s, uint32_t from, uint32_t to) {
    double a[2], b[2];
    slrt_stab_end(s, from, a);
    slrt_stab_end(s, to, b);
    return slrt_make_arm(a[0], a[1], b[0], b[1]);
}

/// Whether the line of a corner has a new end on the right side: 1, on it: 0.
static int slrt_stab_side(const slrt_stab *s, const slrt_corner *c, uint32_t end) {
    double from[2], to[2], at[2];
    int turn;
    if (end == c->from || end == c->to) return 0;
    slrt_stab_end(s, c->from, from);
    slrt_stab_end(s, c->to, to);
    slrt_stab_end(s, end, at);
    turn = slrt_turn(from, to, at);
    return end % 2 ? -turn : turn;
}

static slrt_corner slrt_make_corner(uint32_t from, uint32_t to, uint32_t pivot) {
    slrt_corner corner;
    corner.from = from;
    corner.to = to;
    corner.pivot = pivot;
    return corner;
}

/// The corner that a new end makes on the edge that turns about `pivot`. `leaving`: going round,
/// the cut starts there. The sense of the turn says which of the two ends comes first.
static slrt_corner slrt_cut_at(uint32_t pivot, uint32_t end, bool leaving) {
    const bool pivot_first = (!(pivot % 2) != leaving) == !(end % 2);
    return slrt_make_corner(pivot_first ? pivot : end, pivot_first ? end : pivot,
                            leaving ? end : pivot);
}

/// Cuts by an end while there is no polygon: the first portal, `line`, is all there is. The next
/// one is on another side of a cell, so one end of it at most is on the same line, and not between
/// the ends of the first.
static void slrt_cut_line(slrt_stab *s, slrt_stab_step *step, uint32_t end) {
    const uint32_t left = 2 * step->line, right = left + 1;
    slrt_corner *to = s->corners + step->first;
    double a[2], b[2], at[2];
    bool upwards;
    int side;
    slrt_stab_end(s, right, a);
    slrt_stab_end(s, left, b);
    slrt_stab_end(s, end, at);
    side = slrt_turn(a, b, at);
    if (!side) return;
    if (step->first + 3 > s->room) {
        s->full = true;
        return;
    }
    // Of the two directions along the line, the end leaves one. Upwards: from right to left.
    upwards = !(end % 2) == (side > 0);
    to[0] = upwards ? slrt_make_corner(right, left, left) : slrt_make_corner(left, right, right);
    to[1] = slrt_cut_at(upwards ? left : right, end, true);
    to[2] = slrt_cut_at(upwards ? right : left, end, false);
    step->count = 3;
}

/// Cuts the polygon `from`, of `count` corners, by an end, into the step's place. False if no line
/// is left. The corners outside follow on each other: behind the last one of them come the corners
/// that are kept.
static bool slrt_cut_polygon(slrt_stab *s, slrt_stab_step *step, const slrt_corner *from,
                             uint32_t count, uint32_t end) {
    slrt_corner *to = s->corners + step->first;
    uint32_t i, out = 0, last_out = 0, kept;
    int before = slrt_stab_side(s, &from[count - 1], end), entering = 0, leaving = 0;
    if (step->first + count + 2 > s->room) {
        s->full = true;
        return true;
    }
    for (i = 0; i < count; i++) {
        const int side = slrt_stab_side(s, &from[i], end);
        if (side >= 0 && before < 0) {
            last_out = i ? i - 1 : count - 1;
            entering = side;
        }
        if (side < 0 && before >= 0) leaving = before;
        if (side < 0) out++;
        before = side;
    }
    if (out == count) return false;
    step->count = 0;
    if (!out) last_out = count - 1;
    for (i = last_out, kept = count - out; kept; kept--) {
        i = i + 1 < count ? i + 1 : 0;
        to[step->count++] = from[i];
    }
    if (!out) return true;
    if (leaving > 0) to[step->count++] = slrt_cut_at(from[i].pivot, end, true);
    to[step->count - 1].pivot = end;
    if (entering > 0) to[step->count++] = slrt_cut_at(from[last_out].pivot, end, false);
    return true;
}

/// Whether some direction crosses a directed portal and all before it strictly forwards. Their
/// directions, from right end to left, span less than half a turn.
static bool slrt_stab_direction(const slrt_stab *s, slrt_stab_step *step, uint32_t directed) {
    const slrt_arm least = slrt_stab_arm(s, 2 * step->least + 1, 2 * step->least);
    const slrt_arm most = slrt_stab_arm(s, 2 * step->most + 1, 2 * step->most);
    const slrt_arm across = slrt_stab_arm(s, 2 * directed + 1, 2 * directed);
    const int from_least = slrt_side(&least, &across), from_most = slrt_side(&most, &across);
    if (!from_least && !from_most) return slrt_same_way(&least, &across);
    if (from_least >= 0 && from_most <= 0) return true;
    if (from_least <= 0 && from_most >= 0) return false;
    if (from_most > 0)
        step->most = directed;
    else
        step->least = directed;
    return true;
}

/// Adds a directed portal to the sequence whose last step is `last`: makes `step`, whose corners
/// come behind those of all others. False if no line passes all portals.
static bool slrt_stab_push(slrt_stab *s, const slrt_stab_step *last, uint32_t directed,
                           slrt_stab_step *step) {
    enum { MOST = 64 };
    slrt_corner between[MOST];
    *step = *last;
    step->done = 0;
    step->first = last->first + last->count;
    if (last->line == SLRT_NONE) {
        step->line = step->least = step->most = directed;
        return true;
    }
    if (!slrt_stab_direction(s, step, directed)) return false;
    if (!last->count)
        slrt_cut_line(s, step, 2 * directed);
    else if (!slrt_cut_polygon(s, step, s->corners + last->first, last->count, 2 * directed))
        return false;
    if (!step->count) {
        slrt_cut_line(s, step, 2 * directed + 1);
        return true;
    }
    if (s->full || step->count > MOST) {
        s->full = true;
        return true;
    }
    memcpy(between, s->corners + step->first, step->count * sizeof *between);
    return slrt_cut_polygon(s, step, between, step->count, 2 * directed + 1);
}

// --- Doors that stand as they do in one game, and rows that follow them

// The row of a cell is searched through portals, depth first. No line enters a cell that the baked
// row, past shut doors, has not. So those cells alone are looked for, and a settled row has a bit
// for each cell of the baked one. A door matters to the rows that have a cell beside it: a line
// that passes the door comes to such a cell before it.

/// The limit of portals that the search of one row comes to, for each directed portal of the map.
#ifndef SLRT_SETTLE_PATIENCE
#define SLRT_SETTLE_PATIENCE 64
#endif

enum {
    SLRT_STEP_WORDS = sizeof(slrt_stab_step) / sizeof(uint32_t),
    SLRT_CORNER_WORDS = sizeof(slrt_corner) / sizeof(uint32_t),
    SLRT_CORNERS_MORE = 1024
};

/// Corners in a state: 4 for each cell that a sequence may pass, and some more.
static uint32_t slrt_corner_room(const sl_runtime *rt) {
    return 4 * rt->cell_count + SLRT_CORNERS_MORE;
}

static size_t slrt_row_words(const sl_runtime *rt, uint32_t cell) {
    return ((size_t)sl_runtime_row_count(rt, cell) + 31) / 32;
}

SL_RUNTIME_API size_t sl_runtime_state_count(const sl_runtime *runtime) {
    const size_t cells = runtime->cell_count;
    size_t words = 2 * cells + 1 + (cells + 31) / 32 + ((size_t)runtime->door_count + 3) / 4;
    uint32_t i;
    for (i = 0; i < runtime->cell_count; i++) words += slrt_row_words(runtime, i);
    return words + SLRT_STEP_WORDS * (cells + 1) +
           (size_t)SLRT_CORNER_WORDS * slrt_corner_room(runtime);
}

SL_RUNTIME_API void sl_runtime_state_start(sl_runtime_state *out, const sl_runtime *runtime,
                                           uint32_t *memory) {
    const size_t cells = runtime->cell_count;
    size_t words = 0;
    uint32_t i;
    memset(out, 0, sizeof *out);
    out->runtime = runtime;
    out->first = memory;
    out->settled = out->first + cells + 1;
    out->ranks = out->settled + (cells + 31) / 32;
    out->steps = out->ranks + cells;
    out->corners = out->steps + SLRT_STEP_WORDS * (cells + 1);
    out->bits = out->corners + (size_t)SLRT_CORNER_WORDS * slrt_corner_room(runtime);
    memset(out->settled, 0, (cells + 31) / 32 * sizeof *memory);
    memset(out->ranks, 0xff, cells * sizeof *memory);
    for (i = 0; i < runtime->cell_count; i++) {
        out->first[i] = (uint32_t)words;
        words += slrt_row_words(runtime, i);
        if (words == out->first[i])
            out->settled[i / 32] |= UINT32_C(1) << i % 32; // without a row
        else
            out->unsettled++;
    }
    out->first[cells] = (uint32_t)words;
    out->shut = (unsigned char *)(out->bits + words);
    out->row = SLRT_NONE;
    for (i = 0; i < runtime->door_count; i++) out->shut[i] = !sl_runtime_door_open(runtime, i);
}

// --- changes

static bool slrt_is_settled(const sl_runtime_state *state, uint32_t cell) {
    return state->settled[cell / 32] >> cell % 32 & 1;
}

/// The place of a cell among those of a row; SLRT_NONE if it is not in the row.
static uint32_t slrt_rank(const sl_runtime *rt, uint32_t from, uint32_t to) {
    sl_runtime_run run;
    uint32_t rank = 0;
    if (!slrt_may_see(rt, from, to)) return SLRT_NONE;
    run = sl_runtime_row(rt, from);
    while (sl_runtime_next(&run)) {
        if (to < run.end) return to >= run.first ? rank + (to - run.first) : SLRT_NONE;
        rank += run.end - run.first;
    }
    return SLRT_NONE;
}

SL_RUNTIME_API bool sl_runtime_state_can_see(const sl_runtime_state *state, uint32_t from,
                                             uint32_t to) {
    uint32_t rank;
    if (from >= state->runtime->cell_count) return false;
    if (!slrt_is_settled(state, from))
        return sl_runtime_can_see_past(state->runtime, from, to, state->shut);
    rank = slrt_rank(state->runtime, from, to);
    return rank != SLRT_NONE && state->bits[state->first[from] + rank / 32] >> rank % 32 & 1;
}

/// Leaves the search of a row: the row is not settled.
static void slrt_leave_row(sl_runtime_state *state) {
    sl_runtime_run run;
    if (state->row == SLRT_NONE) return;
    run = sl_runtime_row(state->runtime, state->row);
    while (sl_runtime_next(&run))
        memset(state->ranks + run.first, 0xff, (run.end - run.first) * sizeof *state->ranks);
    state->row = SLRT_NONE;
    state->depth = 0;
}

/// Unsettles the rows that have a cell. If no glass makes it one-way, these are of cells that are
/// in the row of that cell.
static void slrt_unsettle(sl_runtime_state *state, uint32_t cell) {
    const sl_runtime *rt = state->runtime;
    sl_runtime_run run = sl_runtime_row(rt, cell);
    uint32_t i;
    if (rt->has_glass) {
        run.first = 0;
        run.end = rt->cell_count;
        run.next = run.stop;
    } else if (!sl_runtime_next(&run))
        return;
    do
        for (i = run.first; i < run.end; i++)
            if (slrt_is_settled(state, i) && sl_runtime_state_can_see(state, i, cell)) {
                state->settled[i / 32] &= ~(UINT32_C(1) << i % 32);
                state->unsettled++;
            }
    while (sl_runtime_next(&run));
}

static bool slrt_same_door(const sl_runtime *rt, uint32_t a, uint32_t b) {
    const sl_runtime_name p = sl_runtime_door_name(rt, a), q = sl_runtime_door_name(rt, b);
    return a == b || (p.length == q.length && !memcmp(p.text, q.text, p.length));
}

/// Whether a door may be opened or shut, as it stands.
static bool slrt_may_set(const sl_runtime_state *state, uint32_t door, bool shut) {
    const sl_runtime_door_kind kind = sl_runtime_get_door_kind(state->runtime, door);
    return !state->shut[door] == !shut || kind != (shut ? SL_RUNTIME_BREAKABLE : SL_RUNTIME_SITE);
}

SL_RUNTIME_API bool sl_runtime_state_set_door(sl_runtime_state *state, uint32_t door, bool shut) {
    const sl_runtime *rt = state->runtime;
    bool changes = false;
    uint32_t i;
    if (door >= rt->door_count) return false;
    for (i = 0; i < rt->door_count; i++)
        if (slrt_same_door(rt, i, door) && !slrt_may_set(state, i, shut)) return false;
    for (i = 0; i < rt->door_count; i++) {
        if (!state->shut[i] == !shut || !slrt_same_door(rt, i, door)) continue;
        state->shut[i] = shut;
        changes = true;
    }
    if (!changes) return true;
    slrt_leave_row(state);
    for (i = 0; i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12;
        const unsigned char *seam = rt->seams + (size_t)slrt_u32(on + 4) * 40;
        const unsigned char *portal = rt->portals + (size_t)slrt_u32(on) * SLRT_PORTAL_BYTES;
        if (slrt_u32(seam + 32) != 1 || !slrt_same_door(rt, slrt_u32(seam + 36), door)) continue;
        slrt_unsettle(state, slrt_u32(portal));
        slrt_unsettle(state, slrt_u32(portal + 4));
    }
    return true;
}

// --- the search of a row

/// Whether a directed portal is on a shut door, or on glass that is dark as it leads.
static bool slrt_is_barred(const sl_runtime_state *state, uint32_t directed) {
    const sl_runtime *rt = state->runtime;
    const uint32_t portal = slrt_u32(rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES);
    uint32_t i;
    if (!rt->seam_portal_count) return false;
    for (i = slrt_first_seam(rt, portal); i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12, *seam;
        if (slrt_u32(on) != portal) return false;
        seam = rt->seams + (size_t)slrt_u32(on + 4) * 40;
        if (slrt_u32(seam + 32) == 1 && state->shut[slrt_u32(seam + 36)]) return true;
        if (slrt_u32(seam + 32) == 2 && slrt_leads_along(rt, directed, seam)) return true;
    }
    return false;
}

static void slrt_find(sl_runtime_state *state, uint32_t cell) {
    const uint32_t rank = state->ranks[cell];
    uint32_t *word = state->bits + state->first[state->row] + rank / 32;
    if (*word >> rank % 32 & 1) return;
    *word |= UINT32_C(1) << rank % 32;
    state->missing--;
}

static slrt_stab_step *slrt_steps(const sl_runtime_state *state) {
    return (slrt_stab_step *)state->steps;
}

/// Starts with the next row that is not settled: numbers the cells that are looked for by their
/// places in it. Returns how many there are.
static uint32_t slrt_start_row(sl_runtime_state *state) {
    const sl_runtime *rt = state->runtime;
    slrt_stab_step *step = slrt_steps(state);
    slrt_door_pairs pairs;
    sl_runtime_run run;
    uint32_t cell = state->next, rank = 0, i;
    while (slrt_is_settled(state, cell)) cell = cell + 1 < rt->cell_count ? cell + 1 : 0;
    state->row = cell;
    state->next = cell + 1 < rt->cell_count ? cell + 1 : 0;
    state->missing = 0;
    state->patience = SLRT_SETTLE_PATIENCE * ((uint64_t)rt->directed_count + 1024);
    memset(state->bits + state->first[cell], 0,
           (state->first[cell + 1] - state->first[cell]) * sizeof *state->bits);
    pairs = slrt_door_pairs_of(rt, cell);
    run = sl_runtime_row(rt, cell);
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++, rank++) {
            if (!slrt_pair_is_open(&pairs, i, state->shut)) continue;
            state->ranks[i] = rank;
            state->missing++;
        }
    slrt_find(state, cell);
    memset(step, 0, sizeof *step);
    step->cell = cell;
    step->line = SLRT_NONE;
    state->depth = 1;
    return rank;
}

/// Takes the next way out of the last cell. False if the search has to give up.
static bool slrt_search_row(sl_runtime_state *state) {
    slrt_stab_step *step = slrt_steps(state) + state->depth - 1;
    const sl_runtime_cell cell = sl_runtime_get_cell(state->runtime, step->cell);
    const uint32_t directed = cell.first_directed + step->done;
    uint32_t to;
    slrt_stab stab;
    if (step->done == cell.directed_count) {
        state->depth--;
        return true;
    }
    step->done++;
    to = slrt_cell_across(state->runtime, directed);
    if (state->ranks[to] == SLRT_NONE || slrt_is_barred(state, directed)) return true;
    stab.rt = state->runtime;
    stab.corners = (slrt_corner *)state->corners;
    stab.room = slrt_corner_room(state->runtime);
    stab.full = false;
    if (!slrt_stab_push(&stab, step, directed, step + 1)) return true;
    // No line enters a cell twice: a longer sequence is that of a damaged file.
    if (stab.full || state->depth > state->runtime->cell_count) return false;
    step[1].cell = to;
    slrt_find(state, to);
    state->depth++;
    return true;
}

/// Ends the search of a row. If it gave up, all that was looked for counts as seen.
static void slrt_settle_row(sl_runtime_state *state, bool gave_up) {
    const uint32_t cell = state->row;
    sl_runtime_run run = sl_runtime_row(state->runtime, cell);
    uint32_t i;
    while (gave_up && sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++)
            if (state->ranks[i] != SLRT_NONE) slrt_find(state, i);
    slrt_leave_row(state);
    state->settled[cell / 32] |= UINT32_C(1) << cell % 32;
    state->unsettled--;
}

SL_RUNTIME_API uint32_t sl_runtime_settle(sl_runtime_state *state, uint32_t portals) {
    while (state->unsettled && portals) {
        bool gave_up = false;
        if (state->row == SLRT_NONE) {
            const uint32_t cost = 1 + slrt_start_row(state) / 16;
            portals -= cost < portals ? cost : portals;
        }
        for (; portals && state->depth && state->missing && !gave_up; portals--)
            gave_up = !state->patience-- || !slrt_search_row(state);
        if (!state->depth || !state->missing || gave_up) {
            if (gave_up) state->given_up++;
            slrt_settle_row(state, gave_up);
        }
    }
    return state->unsettled;
}

SL_RUNTIME_API uint32_t sl_runtime_state_row_bits(const sl_runtime_state *state, uint32_t cell,
                                                  unsigned char *bits) {
    const sl_runtime *rt = state->runtime;
    sl_runtime_run run = sl_runtime_row(rt, cell);
    uint32_t rank = 0, count = 0, i;
    if (cell >= rt->cell_count || !slrt_is_settled(state, cell))
        return sl_runtime_seen_from(rt, &cell, 1, state->shut, bits);
    memset(bits, 0, ((size_t)rt->cell_count + 7) / 8);
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++, rank++) {
            if (!(state->bits[state->first[cell] + rank / 32] >> rank % 32 & 1)) continue;
            bits[i / 8] |= (unsigned char)(1 << i % 8);
            count++;
        }
    return count;
}

// --- Gates: the open ways from cell to cell on foot, and the corners that ways turn around

// A corner is what ways turn around: the end of a wall, as it is met from one side. The gates that
// end at a point are in rows: two that are next to each other in a cell are joined. Where walls
// meet, they part what is around the point, and each part has a row and a corner of its own:
//
//       A | B        the gates (dots) around the point: those of A and C in one row, those of B
//     ....+....      and D in another one. No way leads from one row to the other here.
//       C | D
//
// A row that closes to a ring has no wall at its point: nothing is to turn around. (lib/analysis/
// route/corners.c does that for all corners at once; here it is one at a time, as doors stand.)

/// An open portal, or a wall that steps pass, as a cell crosses it.
typedef struct slrt_gate {
    uint32_t number; ///< of the directed portal; passages follow all of them
    uint32_t portal; ///< the same from both sides; walls of passages follow all portals
    uint32_t cell;   ///< beyond it
    double end[2][2];
} slrt_gate;

/// Sides of a gate.
enum { SLRT_GATE_RIGHT, SLRT_GATE_LEFT };

/// The gates of a cell: its directed portals, then its passages.
typedef struct slrt_gates {
    const sl_runtime *rt;
    const unsigned char *shut; ///< NULL for none
    uint32_t cell;
    uint32_t directed, directed_end; ///< those to come
    uint32_t passage;
} slrt_gates;

static slrt_gates slrt_gates_of(const sl_runtime *rt, const unsigned char *shut, uint32_t cell) {
    const sl_runtime_cell c = sl_runtime_get_cell(rt, cell);
    slrt_gates of;
    of.rt = rt;
    of.shut = shut;
    of.cell = cell;
    of.directed = c.first_directed;
    of.directed_end = c.first_directed + c.directed_count;
    of.passage = slrt_next_way(rt, cell, slrt_first_passage(rt, cell));
    return of;
}

/// Whether a seam that a gate is on keeps who walks from passing it: a shut door, glass that leads
/// to the dark, a wall that stops steps.
static bool slrt_seam_bars(const slrt_gates *of, const slrt_gate *gate, uint32_t number) {
    const unsigned char *seam = of->rt->seams + (size_t)number * 40;
    const uint32_t kind = slrt_u32(seam + 32);
    if (kind == 1 && of->shut && of->shut[slrt_u32(seam + 36)]) return true;
    if (kind == 2) {
        const slrt_arm along = slrt_make_arm(slrt_f64(seam), slrt_f64(seam + 8),
                                             slrt_f64(seam + 16), slrt_f64(seam + 24));
        const slrt_arm to_left =
            slrt_make_arm(gate->end[0][0], gate->end[0][1], gate->end[1][0], gate->end[1][1]);
        if (slrt_same_way(&to_left, &along)) return true;
    }
    return (slrt_seam_stops(of->rt, number) & SL_RUNTIME_STOPS_STEPS) != 0;
}

static bool slrt_is_gate_barred(const slrt_gates *of, const slrt_gate *gate) {
    const sl_runtime *rt = of->rt;
    uint32_t i;
    if (gate->number >= rt->directed_count) {
        for (i = 0; i < rt->seam_count; i++)
            if (slrt_seam_bars(of, gate, i) && slrt_seam_covers(rt, i, gate->end[0], gate->end[1]))
                return true;
        return false;
    }
    if (!rt->seam_portal_count) return false;
    for (i = slrt_first_seam(rt, gate->portal); i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12;
        if (slrt_u32(on) != gate->portal) break;
        if (slrt_seam_bars(of, gate, slrt_u32(on + 4))) return true;
    }
    return false;
}

/// Reads a gate, open or not.
static void slrt_read_gate(const sl_runtime *rt, uint32_t number, slrt_gate *out) {
    out->number = number;
    if (number < rt->directed_count) {
        const sl_runtime_directed_portal d = sl_runtime_get_directed_portal(rt, number);
        out->portal = d.portal;
        out->cell = d.cell;
        memcpy(out->end[SLRT_GATE_RIGHT], d.right, sizeof d.right);
        memcpy(out->end[SLRT_GATE_LEFT], d.left, sizeof d.left);
    } else {
        const uint32_t passage = number - rt->directed_count;
        const unsigned char *at = rt->passages + (size_t)passage * SLRT_PASSAGE_BYTES;
        out->portal = rt->portal_count + (slrt_u32(at + 4) & INT32_MAX);
        out->cell = slrt_u32(at + 8);
        slrt_read_passage(rt, passage, out->end[SLRT_GATE_RIGHT], out->end[SLRT_GATE_LEFT]);
    }
}

/// The next gate that is open; false behind the last.
static bool slrt_next_gate(slrt_gates *of, slrt_gate *out) {
    const sl_runtime *rt = of->rt;
    while (of->directed < of->directed_end) {
        slrt_read_gate(rt, of->directed++, out);
        if (!slrt_is_gate_barred(of, out)) return true;
    }
    while (of->passage < rt->passage_count) {
        slrt_read_gate(rt, rt->directed_count + of->passage, out);
        of->passage = slrt_next_way(rt, of->cell, of->passage + 1);
        if (!slrt_is_gate_barred(of, out)) return true;
    }
    return false;
}

/// The number of an end of a gate, the same from both sides.
static uint32_t slrt_gate_end(const slrt_gate *gate, int side) {
    const double *a = gate->end[side], *b = gate->end[!side];
    return 2 * gate->portal + ((a[0] != b[0] ? a[0] > b[0] : a[1] > b[1]) ? 1u : 0u);
}

/// What a cell has at a point where a gate ends.
typedef struct slrt_turnstile {
    bool opens; ///< the gate is open from here
    bool has_next;
    slrt_gate next; ///< the gate that ends there beside it
} slrt_turnstile;

/// Looks for the gate beside a gate, the one whose end at `side` is at a point.
static slrt_turnstile slrt_turnstile_of(slrt_gates of, uint32_t portal, int side, const double *at,
                                        uint64_t *patience) {
    slrt_turnstile found;
    slrt_gate gate;
    memset(&found, 0, sizeof found);
    while (!(found.opens && found.has_next) && *patience && slrt_next_gate(&of, &gate)) {
        --*patience;
        if (gate.portal == portal) {
            found.opens = true;
        } else if (slrt_same_place(gate.end[side], at)) {
            found.has_next = true;
            found.next = gate;
        }
    }
    return found;
}

/// The row that has an end of a gate of a cell, seen from beyond the gate: the least number of its
/// ends. SLRT_NONE for a ring.
static uint32_t slrt_row_at(const sl_runtime *rt, const unsigned char *shut, uint32_t cell,
                            const slrt_gate *gate, int side, uint64_t *patience) {
    const double *at = gate->end[side];
    uint32_t least = slrt_gate_end(gate, side), beyond = gate->cell, portal = gate->portal;
    slrt_turnstile t;
    while (true) {
        uint32_t number;
        t = slrt_turnstile_of(slrt_gates_of(rt, shut, beyond), portal, side, at, patience);
        if (!t.opens || !t.has_next || !*patience) break;
        if (t.next.portal == gate->portal) return SLRT_NONE;
        number = slrt_gate_end(&t.next, side);
        least = number < least ? number : least;
        beyond = t.next.cell;
        portal = t.next.portal;
    }
    t.next = *gate;
    while (true) { // the other way around the point
        uint32_t number;
        t = slrt_turnstile_of(slrt_gates_of(rt, shut, cell), t.next.portal, !side, at, patience);
        if (!t.opens || !t.has_next || !*patience) return least;
        number = slrt_gate_end(&t.next, !side);
        least = number < least ? number : least;
        cell = t.next.cell;
    }
}

// --- The shortest way through convex cells (Cui, Harabor and Grastien 2017: Polyanya)

// As lib/analysis/route/search.c, which explains it, in memory of the caller. A node is a root, the
// last corner of a way, and the directions from it that go on straight into a cell. Limits of the
// directions are rays through corners, so each sign is exact. An A* search takes the node with the
// least bound first; bounds are rounded down. A corner is turned at by the shortest way to it only,
// and of ways of the same length by those from which most can be turned to.
//
// Nodes that turn are what is known of a corner. Two tables find them, by gate and by row; they are
// hash tables, so that no memory has to be cleared for each portal of the level.

/// Lengths count as the same up to this share: 2^-42.
#define SLRT_SAME_LENGTH 2.2737367544323206e-13

/// A limit of directions: none, the ray from the root through `limit`, or the ray that goes on from
/// `limit` through the root.
enum { SLRT_LIMIT_NONE, SLRT_LIMIT_RAY, SLRT_LIMIT_ON };

/// A way to `root` of length `g`, and the directions from there that enter `cell` by gate `entry`.
typedef struct slrt_way_node {
    double root[2], limit[2][2], g;
    uint32_t parent, entry; ///< SLRT_NONE for the first ones
    uint32_t cell;
    uint32_t row, turn; ///< of one that turns: the corner, and 2 * gate + side; else of no meaning
    unsigned char kind[2];
    bool is_last; ///< leads from its root straight to the goal
} slrt_way_node;

enum {
    SLRT_WAY_NODE_WORDS = sizeof(slrt_way_node) / sizeof(uint32_t),
    SLRT_WAY_ROW = offsetof(slrt_way_node, row) / sizeof(uint32_t),
    SLRT_WAY_TURN = offsetof(slrt_way_node, turn) / sizeof(uint32_t)
};

/// A node that is open.
typedef struct slrt_way_open {
    double f;
    uint32_t node, unused;
} slrt_way_open;

enum { SLRT_WAY_OPEN_WORDS = sizeof(slrt_way_open) / sizeof(uint32_t) };

typedef struct slrt_way {
    const sl_runtime *rt;
    const unsigned char *shut;
    double from[2], to[2], scale;                  ///< scale: brings bounds to about 1
    uint32_t *list, *at_start, *at_goal, *reached; ///< cells, and a bit for each
    uint32_t *nodes, node_count, node_room;
    uint32_t *open, open_count;
    uint32_t *turns; ///< of table_size nodes, by gate and side
    uint32_t *rows;  ///< of three times as many: of a corner, the first node, the last by side
    uint32_t table_size;
    uint64_t patience;
    bool full; ///< there was no room for a node
} slrt_way;

// --- memory

static uint32_t slrt_way_table(uint32_t nodes) {
    uint32_t size = 2;
    while (size < 2 * (uint64_t)nodes && size < UINT32_C(1) << 31) size *= 2;
    return size;
}

SL_RUNTIME_API size_t sl_runtime_way_scratch_count(const sl_runtime *runtime, uint32_t nodes) {
    const size_t cells = runtime->cell_count;
    return cells + 3 * ((cells + 31) / 32) +
           (size_t)(SLRT_WAY_NODE_WORDS + SLRT_WAY_OPEN_WORDS) * nodes +
           4 * (size_t)slrt_way_table(nodes);
}

static void slrt_way_start(slrt_way *w, const sl_runtime *rt, const unsigned char *shut,
                           uint32_t *scratch, uint32_t nodes) {
    const size_t cells = rt->cell_count, bits = (cells + 31) / 32;
    const double wide = rt->max_x - rt->min_x, high = rt->max_y - rt->min_y;
    memset(w, 0, sizeof *w);
    w->rt = rt;
    w->shut = shut;
    w->scale = slrt_scale_of(wide > high ? wide : high);
    w->node_room = nodes < UINT32_C(1) << 30 ? nodes : UINT32_C(1) << 30;
    w->table_size = slrt_way_table(nodes);
    w->patience = 256 * ((uint64_t)rt->directed_count + rt->passage_count + w->node_room + 16);
    w->list = scratch;
    w->at_start = w->list + cells;
    w->at_goal = w->at_start + bits;
    w->reached = w->at_goal + bits;
    w->nodes = w->reached + bits;
    w->open = w->nodes + (size_t)SLRT_WAY_NODE_WORDS * nodes;
    w->turns = w->open + (size_t)SLRT_WAY_OPEN_WORDS * nodes;
    w->rows = w->turns + w->table_size;
    memset(w->at_start, 0, 3 * bits * sizeof *scratch);
    memset(w->turns, 0xff, 4 * (size_t)w->table_size * sizeof *scratch);
}

static slrt_way_node slrt_way_node_at(const slrt_way *w, uint32_t number) {
    slrt_way_node node;
    memcpy(&node, w->nodes + SLRT_WAY_NODE_WORDS * (size_t)number, sizeof node);
    return node;
}

static void slrt_way_keep(slrt_way *w, const slrt_way_node *node) {
    w->full = w->full || w->node_count == w->node_room;
    if (w->full) return;
    memcpy(w->nodes + SLRT_WAY_NODE_WORDS * (size_t)w->node_count++, node, sizeof *node);
}

static bool slrt_has_bit(const uint32_t *bits, uint32_t cell) {
    return bits[cell / 32] >> cell % 32 & 1;
}

/// Adds a cell to the list that has no bit yet.
static void slrt_way_list(slrt_way *w, uint32_t *bits, uint32_t cell, uint32_t *count) {
    if (slrt_has_bit(bits, cell)) return;
    bits[cell / 32] |= UINT32_C(1) << cell % 32;
    w->list[(*count)++] = cell;
}

// --- the open nodes: a heap

static slrt_way_open slrt_way_open_at(const slrt_way *w, uint32_t i) {
    slrt_way_open item;
    memcpy(&item, w->open + SLRT_WAY_OPEN_WORDS * (size_t)i, sizeof item);
    return item;
}

static void slrt_way_set_open(slrt_way *w, uint32_t i, const slrt_way_open *item) {
    memcpy(w->open + SLRT_WAY_OPEN_WORDS * (size_t)i, item, sizeof *item);
}

static bool slrt_opens_before(const slrt_way_open *a, const slrt_way_open *b) {
    return a->f != b->f ? a->f < b->f : a->node < b->node;
}

static void slrt_way_push(slrt_way *w, const slrt_way_node *node, double f) {
    slrt_way_open item;
    uint32_t i = w->open_count;
    slrt_way_keep(w, node);
    if (w->full) return;
    item.f = f * (1 - 8.8817841970012523e-16); // 2^-50
    item.node = w->node_count - 1;
    item.unused = 0;
    w->open_count++;
    while (i) {
        const slrt_way_open above = slrt_way_open_at(w, (i - 1) / 2);
        if (!slrt_opens_before(&item, &above)) break;
        slrt_way_set_open(w, i, &above);
        i = (i - 1) / 2;
    }
    slrt_way_set_open(w, i, &item);
}

static uint32_t slrt_way_pop(slrt_way *w) {
    const uint32_t least = slrt_way_open_at(w, 0).node;
    const slrt_way_open last = slrt_way_open_at(w, --w->open_count);
    uint32_t i = 0, child;
    while ((child = 2 * i + 1) < w->open_count) {
        slrt_way_open below = slrt_way_open_at(w, child);
        if (child + 1 < w->open_count) {
            const slrt_way_open other = slrt_way_open_at(w, child + 1);
            if (slrt_opens_before(&other, &below)) {
                below = other;
                child++;
            }
        }
        if (!slrt_opens_before(&below, &last)) break;
        slrt_way_set_open(w, i, &below);
        i = child;
    }
    slrt_way_set_open(w, i, &last);
    return least;
}

// --- lengths and bounds

/// A length, off by a few units in the last place.
static double slrt_length(double x, double y) {
    const double larger = slrt_larger(x, y), scale = slrt_scale_of(larger);
    double u[2];
    if (!(larger > 0)) return 0;
    u[0] = x * scale;
    u[1] = y * scale;
    return slrt_root(slrt_dot(u, u)) / scale;
}

static double slrt_distance(const double *a, const double *b) {
    return slrt_length(b[0] - a[0], b[1] - a[1]);
}

/// The side of a limit that a point lies on: 1 left, -1 right, 0 on it.
static int slrt_limit_side(const slrt_way_node *n, int side, const double *point) {
    return n->kind[side] == SLRT_LIMIT_RAY ? slrt_turn(n->root, n->limit[side], point)
                                           : slrt_turn(n->limit[side], n->root, point);
}

/// Whether a point is out of the directions of a node on one side.
static bool slrt_is_past_limit(const slrt_way_node *n, int side, const double *point) {
    return n->kind[side] != SLRT_LIMIT_NONE &&
           slrt_limit_side(n, side, point) == (side == SLRT_GATE_LEFT ? 1 : -1);
}

/// Whether the way from a through p to b goes straight on or turns left. A way back is neither.
static bool slrt_goes_on(const double *a, const double *p, const double *b) {
    const slrt_arm to = slrt_make_arm(a[0], a[1], p[0], p[1]);
    const slrt_arm on = slrt_make_arm(p[0], p[1], b[0], b[1]);
    const int turn = slrt_side(&to, &on);
    return turn ? turn > 0 : slrt_same_way(&to, &on);
}

static void slrt_offset(const slrt_way *w, const double *from, const double *to, double *out) {
    out[0] = (to[0] - from[0]) * w->scale;
    out[1] = (to[1] - from[1]) * w->scale;
}

/// The end of what a node's directions pass of its gate, as seen from its root: between r and l,
/// the ends of the gate. Where it is rounded, it lies rather too far out than too far in.
static void slrt_passed_end(const slrt_way *w, const slrt_way_node *n, const slrt_gate *gate,
                            int side, const double *r, const double *l, double *out) {
    double ray[2], at_right, sum, slack, share;
    memcpy(out, side == SLRT_GATE_LEFT ? l : r, 2 * sizeof *out);
    if (!slrt_is_past_limit(n, side, gate->end[side])) return;
    if (n->kind[side] == SLRT_LIMIT_RAY)
        slrt_offset(w, n->root, n->limit[side], ray);
    else
        slrt_offset(w, n->limit[side], n->root, ray);
    at_right = -slrt_turned(ray, r);
    sum = at_right + slrt_turned(ray, l);
    slack = 3.5527136788005009e-15 * slrt_size(ray[0], ray[1]) * // 2^-48
            (slrt_size(r[0], r[1]) + slrt_size(l[0], l[1])) / sum;
    share = at_right / sum + (side == SLRT_GATE_LEFT ? slack : -slack);
    if (!(share > 0 && share < 1)) return;
    out[0] = r[0] + share * (l[0] - r[0]);
    out[1] = r[1] + share * (l[1] - r[1]);
}

/// How far it is at least from a node's root to the goal, through its gate.
static double slrt_way_bound(const slrt_way *w, const slrt_way_node *n, const slrt_gate *gate) {
    const double straight = slrt_distance(n->root, w->to);
    double start[2], end[2], along[2], past[2], r[2], l[2], t[2], reach, over, least;
    slrt_offset(w, n->root, gate->end[SLRT_GATE_RIGHT], start);
    slrt_offset(w, n->root, gate->end[SLRT_GATE_LEFT], end);
    slrt_offset(w, gate->end[SLRT_GATE_RIGHT], gate->end[SLRT_GATE_LEFT], along);
    slrt_offset(w, gate->end[SLRT_GATE_RIGHT], w->to, past);
    slrt_offset(w, n->root, w->to, t);
    slrt_passed_end(w, n, gate, SLRT_GATE_RIGHT, start, end, r);
    slrt_passed_end(w, n, gate, SLRT_GATE_LEFT, start, end, l);
    reach = slrt_size(t[0], t[1]) + slrt_size(start[0], start[1]) + slrt_size(along[0], along[1]);
    over = slrt_turned(along, past);
    if (over > 0) { // the goal lies before the gate: its image behind it
        const double twice = 2 * (over / slrt_dot(along, along));
        t[0] += twice * along[1];
        t[1] -= twice * along[0];
    }
    if (slrt_turned(r, t) < 0)
        least = slrt_length(r[0], r[1]) + slrt_distance(r, t);
    else if (slrt_turned(l, t) > 0)
        least = slrt_length(l[0], l[1]) + slrt_distance(l, t);
    else
        least = slrt_length(t[0], t[1]);
    least = (least - 1.4210854715202004e-14 * reach) / w->scale; // 2^-46
    return least > straight ? least : straight;
}

// --- corners

/// Where a table has a number, or where it is to be put. In the first of `step` words is a node, of
/// which `word` is that number.
static uint32_t *slrt_way_find(const slrt_way *w, uint32_t *table, uint32_t step, uint32_t word,
                               uint32_t number) {
    uint32_t at = number * UINT32_C(2654435769);
    at ^= at >> 16;
    while (true) {
        uint32_t *slot = table + step * (size_t)(at & (w->table_size - 1));
        if (*slot == SLRT_NONE || w->nodes[SLRT_WAY_NODE_WORDS * (size_t)*slot + word] == number)
            return slot;
        at++;
    }
}

/// Whether `other` reaches directions beyond those from `known`, turning to one side at `at`.
static bool slrt_turns_more(const double *known, const double *other, const double *at, int side) {
    const slrt_arm a = slrt_make_arm(known[0], known[1], at[0], at[1]);
    const slrt_arm b = slrt_make_arm(other[0], other[1], at[0], at[1]);
    const int turn = slrt_side(&a, &b);
    return side == SLRT_GATE_RIGHT ? turn > 0 : turn < 0;
}

/// Makes the root of a node, in `cell`, the corner at one end of a gate. False if that is no corner
/// or not worth it. The node must be kept next.
static bool slrt_turn_at(slrt_way *w, slrt_way_node *n, uint32_t cell, const slrt_gate *gate,
                         int side) {
    const double *at = gate->end[side];
    const double g = n->g + slrt_distance(n->root, at);
    const uint32_t turn = 2 * gate->number + (uint32_t)side;
    uint32_t *known = slrt_way_find(w, w->turns, 1, SLRT_WAY_TURN, turn), *row, number;
    slrt_way_node first;
    bool searches = true;
    if (*known != SLRT_NONE)
        number = slrt_way_node_at(w, *known).row;
    else
        number = slrt_row_at(w->rt, w->shut, cell, gate, side, &w->patience);
    if (number == SLRT_NONE) return false;
    row = slrt_way_find(w, w->rows, 3, SLRT_WAY_ROW, number);
    if (*row != SLRT_NONE) first = slrt_way_node_at(w, *row);
    if (*row == SLRT_NONE || g < first.g * (1 - SLRT_SAME_LENGTH)) {
        row[0] = w->node_count;
        row[1] = row[2] = SLRT_NONE;
    } else if (g > first.g * (1 + SLRT_SAME_LENGTH)) {
        return false;
    }
    if (row[1 + side] != SLRT_NONE) {
        const slrt_way_node last = slrt_way_node_at(w, row[1 + side]);
        const double *before = last.limit[!side];
        searches = slrt_same_place(before, n->root) || slrt_turns_more(before, n->root, at, side);
        if (!searches && (slrt_turns_more(n->root, before, at, side) ||
                          !slrt_goes_on(before, n->root, at))) // else nearer in line: it is kept
            return false;
    }
    if (*known != SLRT_NONE) {
        const slrt_way_node last = slrt_way_node_at(w, *known);
        if (slrt_same_place(last.limit[!side], n->root) && last.g <= g) {
            row[1 + side] = *known;
            return false;
        }
    }
    *known = row[1 + side] = w->node_count;
    n->row = number;
    n->turn = turn;
    n->kind[side] = SLRT_LIMIT_NONE;
    n->kind[!side] = SLRT_LIMIT_ON;
    memcpy(n->limit[!side], n->root, sizeof n->root);
    memcpy(n->root, at, sizeof n->root);
    n->g = g;
    if (!searches) slrt_way_keep(w, n);
    return searches;
}

// --- the gates of a cell

static void slrt_push_across(slrt_way *w, slrt_way_node *node, const slrt_gate *gate) {
    node->entry = gate->number;
    node->cell = gate->cell;
    slrt_way_push(w, node, node->g + slrt_way_bound(w, node, gate));
}

/// A gate that is seen edge-on: straight to its nearer end, and around that. A root on the gate is
/// the start, which stands in the cell behind it, too.
static void slrt_cross_edge_on(slrt_way *w, const slrt_way_node *from, const slrt_gate *gate) {
    slrt_way_node node = *from;
    const double *right = gate->end[SLRT_GATE_RIGHT], *left = gate->end[SLRT_GATE_LEFT];
    int side = SLRT_GATE_RIGHT;
    if (!slrt_goes_on(node.root, right, left)) {
        side = SLRT_GATE_LEFT;
        if (!slrt_goes_on(node.root, left, right)) return;
    }
    if (slrt_is_past_limit(&node, SLRT_GATE_RIGHT, gate->end[side]) ||
        slrt_is_past_limit(&node, SLRT_GATE_LEFT, gate->end[side]))
        return;
    if (slrt_turn_at(w, &node, from->cell, gate, side)) slrt_push_across(w, &node, gate);
}

/// Whether a gate around the root ends just where the way came from. Nobody needs to pass it: the
/// way came along its other side.
static bool slrt_turns_back(const slrt_way_node *n, int side, const double *end) {
    return n->kind[side] == SLRT_LIMIT_ON && slrt_limit_side(n, side, end) == 0 &&
           !slrt_goes_on(n->limit[side], n->root, end);
}

/// Takes a node through a gate of its cell.
static void slrt_cross_gate(slrt_way *w, const slrt_way_node *from, const slrt_gate *gate) {
    slrt_way_node node = *from;
    int side, facing;
    for (side = 0; side < 2; side++) {
        if (!slrt_same_place(node.root, gate->end[side])) continue; // else around the root
        // Where the start stands, turning around it leads nowhere.
        if (slrt_is_past_limit(from, !side, gate->end[!side]) ||
            slrt_turns_back(from, !side, gate->end[!side]) ||
            (slrt_same_place(node.root, w->from) && slrt_has_bit(w->at_start, gate->cell)))
            return;
        node.kind[side] = SLRT_LIMIT_NONE;
        slrt_push_across(w, &node, gate);
        return;
    }
    facing = slrt_turn(node.root, gate->end[SLRT_GATE_RIGHT], gate->end[SLRT_GATE_LEFT]);
    if (!facing) slrt_cross_edge_on(w, from, gate);
    if (facing <= 0) return;
    for (side = 0; side < 2; side++) {
        const int out = side == SLRT_GATE_LEFT ? 1 : -1;
        if (from->kind[side] != SLRT_LIMIT_NONE) {
            const int near_side = slrt_limit_side(from, side, gate->end[side]) * out;
            const int far_side = slrt_limit_side(from, side, gate->end[!side]) * out;
            if (near_side >= 0 && far_side >= 0) return;
            if (near_side > 0) continue;
        }
        node.kind[side] = SLRT_LIMIT_RAY;
        memcpy(node.limit[side], gate->end[side], sizeof node.limit[side]);
    }
    slrt_push_across(w, &node, gate);
}

/// Straight on from a node's root: to the goal if it is in the cell, and through the gates but the
/// one that it came by.
static void slrt_way_on(slrt_way *w, const slrt_way_node *node, const slrt_gate *entry) {
    slrt_gates of = slrt_gates_of(w->rt, w->shut, node->cell);
    slrt_gate gate;
    if (slrt_has_bit(w->at_goal, node->cell) && !slrt_is_past_limit(node, SLRT_GATE_RIGHT, w->to) &&
        !slrt_is_past_limit(node, SLRT_GATE_LEFT, w->to)) {
        slrt_way_node last = *node;
        last.is_last = true;
        slrt_way_push(w, &last, node->g + slrt_distance(node->root, w->to));
    }
    while (!w->full && w->patience && slrt_next_gate(&of, &gate)) {
        w->patience--;
        if (!entry || gate.portal != entry->portal) slrt_cross_gate(w, node, &gate);
    }
}

static void slrt_way_expand(slrt_way *w, uint32_t number) {
    slrt_way_node node = slrt_way_node_at(w, number);
    const uint32_t came_from = node.parent;
    slrt_gate entry;
    uint32_t before;
    int side;
    node.parent = number;
    if (node.entry == SLRT_NONE) {
        slrt_way_on(w, &node, NULL);
        return;
    }
    before = slrt_way_node_at(w, came_from).cell;
    slrt_read_gate(w->rt, node.entry, &entry);
    slrt_way_on(w, &node, &entry);
    for (side = 0; side < 2 && !w->full; side++) {
        slrt_way_node turned = node;
        if (node.kind[side] != SLRT_LIMIT_RAY ||
            !slrt_same_place(node.limit[side], entry.end[side]) ||
            !slrt_turn_at(w, &turned, before, &entry, side))
            continue;
        slrt_way_keep(w, &turned);
        turned.parent = w->node_count - 1;
        slrt_way_on(w, &turned, &entry);
    }
}

// --- the way

/// Lists the cells that a point stands in, with bits.
static uint32_t slrt_way_stand(slrt_way *w, const double *point, uint32_t first, uint32_t *bits) {
    uint32_t count = 0, i;
    slrt_way_list(w, bits, first, &count);
    for (i = 0; i < count; i++) {
        slrt_gates of = slrt_gates_of(w->rt, w->shut, w->list[i]);
        slrt_gate gate;
        while (slrt_next_gate(&of, &gate))
            if (slrt_is_on(gate.end[0], gate.end[1], point) &&
                !slrt_turn(gate.end[0], gate.end[1], point))
                slrt_way_list(w, bits, gate.cell, &count);
    }
    return count;
}

/// Whether gates lead from the cells of the start to one of the goal. Else a search would go
/// through all that can be reached.
static bool slrt_way_exists(slrt_way *w, uint32_t count) {
    uint32_t i;
    memcpy(w->reached, w->at_start, ((size_t)w->rt->cell_count + 31) / 32 * sizeof *w->reached);
    for (i = 0; i < count; i++) {
        slrt_gates of = slrt_gates_of(w->rt, w->shut, w->list[i]);
        slrt_gate gate;
        if (slrt_has_bit(w->at_goal, w->list[i])) return true;
        while (slrt_next_gate(&of, &gate)) slrt_way_list(w, w->reached, gate.cell, &count);
    }
    return false;
}

/// The order of points around a place: counter-clockwise from the direction of x, the nearest first
/// in each direction. Whether a comes before b.
static bool slrt_is_first_around(const double *at, const double *a, const double *b) {
    const bool upper = a[1] > at[1] || (a[1] == at[1] && a[0] > at[0]);
    const bool other = b[1] > at[1] || (b[1] == at[1] && b[0] > at[0]);
    int turn;
    if (slrt_same_place(a, b) || slrt_same_place(b, at)) return false;
    if (slrt_same_place(a, at)) return true;
    if (upper != other) return upper;
    turn = slrt_turn(at, a, b);
    return turn ? turn > 0 : slrt_goes_on(at, a, b);
}

/// Of two nodes that end at a place, the one whose way comes to it from the point that is first
/// around it. The first node may be SLRT_NONE.
static uint32_t slrt_first_around(const slrt_way *w, const double *at, uint32_t a, uint32_t b) {
    uint32_t nodes[2], i;
    double from[2][2];
    nodes[0] = a;
    nodes[1] = b;
    if (a == SLRT_NONE) return b;
    for (i = 0; i < 2; i++) {
        slrt_way_node node = slrt_way_node_at(w, nodes[i]);
        if (!node.is_last) node = slrt_way_node_at(w, node.parent);
        memcpy(from[i], node.root, sizeof node.root);
    }
    return slrt_is_first_around(at, from[1], from[0]) ? b : a;
}

/// Of the nodes that turn at the same corner by ways of the same length, the one that comes to it
/// from the point that is first around it; for a node that does not turn, itself.
static uint32_t slrt_way_turning(const slrt_way *w, uint32_t number) {
    const slrt_way_node node = slrt_way_node_at(w, number);
    const uint32_t *row;
    uint32_t first = SLRT_NONE, k;
    slrt_way_node from;
    if (node.parent == SLRT_NONE) return number;
    from = slrt_way_node_at(w, node.parent);
    if (slrt_same_place(from.root, node.root)) return number;
    row = slrt_way_find(w, w->rows, 3, SLRT_WAY_ROW, node.row);
    for (k = 1; k < 3; k++) {
        if (row[k] == SLRT_NONE) continue;
        from = slrt_way_node_at(w, slrt_way_node_at(w, row[k]).parent);
        // A piece that is longer than what counts as the same leads nearer to the start.
        if (slrt_distance(from.root, node.root) > 4 * SLRT_SAME_LENGTH * node.g)
            first = slrt_first_around(w, node.root, first, row[k]);
    }
    return first == SLRT_NONE ? number : first;
}

/// The last node of the shortest way; SLRT_NONE for none, or if there is no room. Of ways of the
/// same length it is the one whose last corner is first around the goal.
static uint32_t slrt_way_search(slrt_way *w) {
    uint32_t last = SLRT_NONE;
    double most = 0;
    while (w->open_count && !w->full && w->patience) {
        const slrt_way_open least = slrt_way_open_at(w, 0);
        if (last != SLRT_NONE && least.f > most) break;
        slrt_way_pop(w);
        if (!slrt_way_node_at(w, least.node).is_last) {
            slrt_way_expand(w, least.node);
            continue;
        }
        if (last == SLRT_NONE) most = least.f * (1 + SLRT_SAME_LENGTH);
        last = slrt_first_around(w, w->to, last, least.node);
    }
    return w->full || !w->patience ? SLRT_NONE : last;
}

/// Adds a point to those of a way, which stand where the open nodes were. One in line with its
/// neighbours is no corner.
static uint32_t slrt_way_add(slrt_way *w, uint32_t count, const double *point) {
    double last[2], before[2];
    if (count) {
        memcpy(last, w->open + SLRT_WAY_OPEN_WORDS * (size_t)(count - 1), sizeof last);
        if (slrt_same_place(last, point)) return count;
    }
    for (; count > 1; count--) {
        slrt_arm to, on;
        memcpy(last, w->open + SLRT_WAY_OPEN_WORDS * (size_t)(count - 1), sizeof last);
        memcpy(before, w->open + SLRT_WAY_OPEN_WORDS * (size_t)(count - 2), sizeof before);
        to = slrt_make_arm(before[0], before[1], last[0], last[1]);
        on = slrt_make_arm(last[0], last[1], point[0], point[1]);
        if (!slrt_same_ray(&to, &on)) break;
    }
    memcpy(w->open + SLRT_WAY_OPEN_WORDS * (size_t)count, point, sizeof last);
    return count + 1;
}

/// Reads the way to a last node, from its end. There are at most as many points as nodes, and one.
static void slrt_way_read(slrt_way *w, uint32_t last, double *points, uint32_t room,
                          sl_runtime_way *out) {
    double sum = 0, rest = 0, a[2], b[2];
    uint32_t count = slrt_way_add(w, 0, w->to), i;
    for (i = last; i != SLRT_NONE;) {
        const slrt_way_node node = slrt_way_node_at(w, slrt_way_turning(w, i));
        count = slrt_way_add(w, count, node.root);
        i = node.parent;
    }
    out->count = count > 1 ? count : 2; // the two places are one
    for (i = 0; i < out->count; i++) {
        const uint32_t at = i < count ? count - 1 - i : 0;
        memcpy(b, w->open + SLRT_WAY_OPEN_WORDS * (size_t)at, sizeof b);
        if (out->count <= room) memcpy(points + 2 * (size_t)i, b, sizeof b);
        if (i) { // Knuth's sum
            const double more = slrt_distance(a, b), now = sum + more, part = now - sum;
            rest += (sum - (now - part)) + (more - part);
            sum = now;
        }
        memcpy(a, b, sizeof a);
    }
    out->length = sum + rest;
}

SL_RUNTIME_API sl_runtime_way_status sl_runtime_find_way(const sl_runtime *runtime, double x0,
                                                         double y0, double x1, double y1,
                                                         const unsigned char *shut,
                                                         uint32_t *way_scratch, uint32_t nodes,
                                                         double *points, uint32_t room,
                                                         sl_runtime_way *out) {
    const double from[2] = {slrt_no_dust(x0), slrt_no_dust(y0)};
    const double to[2] = {slrt_no_dust(x1), slrt_no_dust(y1)};
    const uint32_t start = sl_runtime_locate(runtime, from[0], from[1]);
    const uint32_t goal = sl_runtime_locate(runtime, to[0], to[1]);
    slrt_way w;
    slrt_way_node node;
    uint32_t count, last, i;
    out->count = 0;
    out->length = 0;
    if (runtime->loose || start == SL_RUNTIME_NO_CELL || goal == SL_RUNTIME_NO_CELL ||
        sl_runtime_is_solid(runtime, start) || sl_runtime_is_solid(runtime, goal))
        return SL_RUNTIME_WAY_NO_PLACE;
    slrt_way_start(&w, runtime, shut, way_scratch, nodes);
    memcpy(w.from, from, sizeof from);
    memcpy(w.to, to, sizeof to);
    slrt_way_stand(&w, to, goal, w.at_goal);
    count = slrt_way_stand(&w, from, start, w.at_start);
    memset(&node, 0, sizeof node);
    memcpy(node.root, from, sizeof from);
    node.parent = node.entry = node.row = node.turn = SLRT_NONE;
    for (i = 0; i < count; i++) {
        node.cell = w.list[i];
        slrt_way_push(&w, &node, 0);
    }
    if (!slrt_way_exists(&w, count)) return SL_RUNTIME_WAY_NONE;
    last = slrt_way_search(&w);
    if (last == SLRT_NONE)
        return w.full || !w.patience ? SL_RUNTIME_WAY_NODES : SL_RUNTIME_WAY_NONE;
    slrt_way_read(&w, last, points, room, out);
    return out->count > room ? SL_RUNTIME_WAY_ROOM : SL_RUNTIME_WAY_FOUND;
}

#ifdef __cplusplus
}
#endif

#endif
