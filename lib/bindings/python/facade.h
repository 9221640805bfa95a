/// What the Python package calls: plain functions on three kinds of handles: a plan, a level, and a
/// world.
///
/// Arguments are numbers, texts and arrays that the caller owns, so that Python needs to know the
/// layout of no struct. Calls that may give arrays of any length first find the result and keep it
/// in the handle; a second call copies it. A handle serves one thread at a time: Python holds a
/// lock for each. Only slp_cancel may be called beside it.
#ifndef SLP_FACADE_H
#define SLP_FACADE_H

#include "sightline/bake.h"
#include "sightline/coverage.h"
#include "sightline/explain.h"
#include "sightline/explored.h"
#include "sightline/faults.h"
#include "sightline/path.h"
#include "sightline/place.h"
#include "sightline/support.h"
#include "sightline/vga.h"
#include "sightline/world.h"

#include <stdatomic.h>

#define SLP_API __attribute__((visibility("default")))

/// Lines that wait to be copied, and a row of measures for each.
typedef struct slp_lines {
    sl_segment *lines;
    double *values;
    size_t count, columns;
} slp_lines;

/// What both handles begin with.
typedef struct slp_base {
    sl_context *context;
    atomic_bool cancelled;
    double until;         ///< work stops then, by sl_seconds(); 0: no limit
    SL_ARRAY(char) notes; ///< lines, a 0 behind them
    slp_lines lines;
} slp_base;

typedef struct slp_plan {
    slp_base base;
    sl_map map;
} slp_plan;

/// A visible region as a polygon: of an eye, or of what it sees in a mirror.
typedef struct slp_polygon {
    uint32_t depth; ///< reflections
    size_t count;
    sl_point *points;
} slp_polygon;

/// The polygons of one eye, the direct one first.
typedef struct slp_polygons {
    SL_ARRAY(slp_polygon) list;
} slp_polygons;

typedef struct slp_level {
    slp_base base;
    sl_baked baked; ///< without visible sets where only the space was made
    bool has_sets;
    bool *shut;                       ///< by door of the map
    char inside[SL_INSIDE_TEXT + 80]; ///< and advice
    double range;
    uint32_t mirror_depth;
    /// One query a thread, as a query serves one at a time. The first is always there.
    SL_ARRAY(sl_query *) queries;
    // Results that wait to be copied.
    slp_polygons *polygons; ///< by eye
    size_t eye_count;
    sl_vga_grid grid;
    sl_vga_measures *measures;
    sl_vga_interval *intervals; ///< of estimated mean depths
    uint32_t *depths;
    uint32_t *parts, part_count; ///< of the graph (sl_vga_parts)
    sl_effect_explanation explanation;
    sl_route route;     ///< the last way
    sl_cameras cameras; ///< of `coverage`: given, or those of `placement`
    sl_coverage coverage;
    sl_path_parts unseen; ///< of a path, by `coverage`
    sl_placement placement;
    bool placed_late; ///< the time limit ended the placement
    char proof[256];
} slp_level;

/// A world of walls that change, and the last region asked.
typedef struct slp_world {
    slp_base base;
    sl_world *world;
    sl_region region;
} slp_world;

/// An area that was explored, and its text.
typedef struct slp_explored {
    slp_base base;
    sl_explored *area;
    sl_bytes text;
} slp_explored;

/// Makes the context of a new handle; false without memory. slp_base_end undoes it.
bool slp_base_begin(slp_base *base);
void slp_base_end(slp_base *base);
void slp_lines_forget(slp_base *base);

/// Makes the queries that this number of threads needs.
sl_status slp_level_queries(slp_level *level, unsigned threads);
/// Frees the polygons, the measures of a grid and the explanation that wait.
void slp_level_forget(slp_level *level);
/// Frees viewpoints, what they see and their placement.
void slp_level_forget_viewpoints(slp_level *level);

// --- for both handles; `handle` is a plan or a level

SLP_API const char *slp_version(void);
SLP_API const char *slp_message(const void *handle);
SLP_API const char *slp_notes(const void *handle);
SLP_API void slp_cancel(void *handle, int cancelled);
/// Lists of names, one a line: "map_formats", "methods", "eye_methods", "subdivisions", "exports".
/// And "measures", of regions and of visibility graphs: name, group, unit, meaning, part of
/// sl_vga_part, 1 if it is estimated (sl_vga_is_estimated), with tabs between. Returns the length;
/// writes up to `room` bytes, the 0 included.
SLP_API size_t slp_names(const void *handle, const char *list, char *text, size_t room);

// --- plans

SLP_API slp_plan *slp_plan_new(void);
SLP_API void slp_plan_free(slp_plan *plan);

/// As sl_import_options; NAN for no slice, NULL for what is not given.
typedef struct slp_import {
    const char *map, *layers, *start_names, *unit;
    double slice, tolerance, entrance, threshold;
    uint64_t max_squares, max_pixels, max_walls, max_entities, max_depth; ///< as sl_limits
    int doors, sectors, cells, planar, degrees;
    const double *crop; ///< x0, y0, x1, y1; NULL for all
} slp_import;
SLP_API int slp_plan_read(slp_plan *plan, const char *path, const slp_import *options);
SLP_API int slp_plan_parse(slp_plan *plan, const char *name, const char *text, size_t size,
                           const slp_import *options);
SLP_API int slp_plan_write(slp_plan *plan, const char *path, const char *format);
/// Adds `count` segments of one kind: "wall", "door", "mirror", "oneway", "seam". Rows of 4
/// doubles.
SLP_API int slp_plan_add(slp_plan *plan, const char *kind, const char *name, int open,
                         const double *segments, size_t count);
/// Adds a polygon of solid ground, or of open ground in it.
SLP_API int slp_plan_add_ground(slp_plan *plan, int solid, const double *corners, size_t count);
SLP_API int slp_plan_add_start(slp_plan *plan, double x, double y, double heading);
SLP_API int slp_plan_set_range(slp_plan *plan, double range);
SLP_API double slp_plan_entrance(const slp_plan *plan);
SLP_API int slp_plan_set_entrance(slp_plan *plan, double width);
/// Opens or shuts all doors of a name.
SLP_API int slp_plan_set_door(slp_plan *plan, const char *name, int open);

// --- what the map of a handle holds

/// The number of things of a kind, also "start", "object" and "path". Rows of 4 doubles (a start:
/// x, y, heading, 0) are written where `rows` is not NULL.
SLP_API size_t slp_segments(const void *handle, int is_level, const char *kind, double *rows);
/// The name of a door or object, NULL for others.
SLP_API const char *slp_name(const void *handle, int is_level, const char *kind, size_t number);
/// Whether a door is open: of a plan as the map begins, of a level as it stands.
SLP_API int slp_door_open(const void *handle, int is_level, size_t number);
SLP_API double slp_range(const void *handle, int is_level);
SLP_API const char *slp_unit(const void *handle, int is_level);
SLP_API void slp_bounds(const void *handle, int is_level, double box[4]);
/// As sl_map_source.transform: origin, scale, 1 for y down.
SLP_API void slp_transform(const void *handle, int is_level, double values[4]);

// --- levels

/// As sl_bake_options; NULL for what is not given, a weld of NAN for the default.
typedef struct slp_bake {
    const char *method, *subdivision;
    double weld, start_x, start_y; ///< a start is added where start_x is not NAN
    int open_sight, inside_only, sets;
    uint32_t threads, mirror_depth, door_limit, without;
} slp_bake;

SLP_API slp_level *slp_level_new(void);
SLP_API void slp_level_free(slp_level *level);
SLP_API int slp_level_bake(slp_level *level, const slp_plan *plan, const slp_bake *options);
SLP_API int slp_level_open(slp_level *level, const char *path);
SLP_API int slp_level_write(slp_level *level, const char *path);
SLP_API int slp_level_export(slp_level *level, const char *path, const char *format);
/// What is inside, with what to do next, where that is not plain; "" elsewhere.
SLP_API const char *slp_level_inside(slp_level *level);
SLP_API const char *slp_level_word(const slp_level *level, const char *what);
/// cells, vertices, portals, walls, seams, inside cells, loose, has sets.
SLP_API void slp_level_counts(const slp_level *level, uint64_t counts[8]);
SLP_API void slp_level_cells(const slp_level *level, double *vertices, int64_t *offsets,
                             uint8_t *inside, uint8_t *solid, double *areas);
SLP_API void slp_level_portals(const slp_level *level, int64_t *cells, double *ends,
                               int64_t *doors);
/// The visible sets with the doors as they stand, as rows of a sparse matrix. `columns` may be
/// NULL.
SLP_API int slp_level_sets(slp_level *level, int mirrored, int64_t *offsets, int64_t *columns);
SLP_API int slp_level_set_door(slp_level *level, const char *name, int open);
SLP_API int slp_level_set_range(slp_level *level, double range);
SLP_API int slp_level_set_mirror_depth(slp_level *level, uint32_t depth);

// --- questions; points are rows of 2 doubles

SLP_API int slp_level_locate(slp_level *level, const double *points, size_t count, int64_t *cells);
SLP_API int slp_level_can_see(slp_level *level, const double *eyes, const double *points,
                              size_t count, unsigned threads, uint8_t *sees);
SLP_API int slp_level_cell_sees(slp_level *level, const int64_t *from, const int64_t *to,
                                size_t count, uint8_t *sees);
/// A byte for each cell and eye.
SLP_API int slp_level_look(slp_level *level, const double *eyes, size_t count, double heading,
                           double fov, const char *method, int mirrored, unsigned threads,
                           uint8_t *cells);
/// Rows of measures of sl_region_measures, corners, mirrored_area, parts, and 1 where the region
/// meets the border of the map. Polygons are kept where asked for; arcs become chords within
/// `tolerance`.
SLP_API int slp_level_isovists(slp_level *level, const double *eyes, size_t count,
                               const double *headings, const double *fovs, unsigned threads,
                               int keep, double tolerance, double *measures);
/// The number of polygons kept. Where `eyes` is not NULL: of each its eye, reflections, points.
SLP_API size_t slp_level_polygons(const slp_level *level, int64_t *eyes, int64_t *depths,
                                  int64_t *counts);
SLP_API void slp_level_polygon_points(const slp_level *level, double *points);

/// What is seen from a line or an area, points as rows of x, y: from some point, or from all. Its
/// loops are kept as polygons without reflections.
/// One point with a radius over 0 is a disc.
SLP_API int slp_level_set_region(slp_level *level, const double *points, size_t count, int is_area,
                                 double radius, int from_all, double *area);
SLP_API int slp_level_set_sees(slp_level *level, const double *points, size_t count, int is_area,
                               double radius, int from_all, const double *places,
                               size_t place_count, uint8_t *sees);
/// What of things a path sees: each is a line, or a convex area, of the points up to its end. A row
/// is its size, what of that is seen, the lengths of the path that see some of it and all of it,
/// and how far along the path it is seen first, or NAN.
SLP_API int slp_level_exposure(slp_level *level, const double *path, size_t path_count,
                               const double *points, const int64_t *ends, size_t count, int is_area,
                               double *rows);
/// Whether some place within reach of from[i] may see some place within reach of to[i].
SLP_API int slp_level_sees_within(slp_level *level, const double *from, double from_radius,
                                  const double *to, double to_radius, size_t count, int on_foot,
                                  uint8_t *sees);

/// The shortest way, which is kept. `loss`: of doors that are shut; NAN: they block. Without a way
/// the length is INFINITY. `radius`: of the walker.
SLP_API int slp_level_path(slp_level *level, const double *from, const double *to, double loss,
                           double radius, double *length);
/// Copies its points, unless `points` is NULL. Returns how many there are.
SLP_API size_t slp_level_path_points(const slp_level *level, double *points);
/// How far each cell is, and its nearest point, or NAN.
SLP_API int slp_level_distances(slp_level *level, const double *from, double loss, double limit,
                                double *distances, double *nearest);
/// How far places are, and where the way to each turns last, or NAN.
SLP_API int slp_level_distances_to(slp_level *level, const double *from, double loss, double limit,
                                   const double *places, size_t count, double *distances,
                                   double *roots);

/// As sl_vga_options. `parts` are bits of sl_vga_part; 0 for the grid alone.
typedef struct slp_vga {
    double step, range, metric_radius, angular_radius;
    uint64_t seed;
    uint32_t parts, radius, threads;
    uint32_t turned; ///< with one-way glass: who sees a point, in place of what it sees
    uint32_t roots;  ///< as sl_vga_estimate, with `seed`; 0: measures are exact
} slp_vga;
/// Measures a grid and keeps the result. `from`: points from which steps are counted, if any.
SLP_API int slp_level_vga(slp_level *level, const slp_vga *options, const double *seeds,
                          size_t seed_count, const double *from, size_t from_count);
/// The number of points kept. `measures`: rows of sl_vga_measures; `depths`: -1 for none; `parts`:
/// the parts that no sightline joins, from 1 on, left as they are where there is one; `intervals`:
/// of estimated mean depths. Each may be NULL.
SLP_API size_t slp_level_vga_copy(const slp_level *level, double *points, double *measures,
                                  int64_t *depths, int64_t *parts, double *intervals);

// --- axial lines and segments: lines.c

enum { SLP_LINES_ALL, SLP_LINES_SUBSETS, SLP_LINES_FEWEST };
/// Finds the axial lines of what is inside, measures them, and keeps both. A radius of 0: none.
SLP_API int slp_level_axial(slp_level *level, int kept, uint32_t radius, unsigned threads);
/// Measures the walls as a network of lines, cut where they cross. A radius of 0: none. `weights`:
/// by wall, or NULL; pieces of a wall share its weight by length. `unlinks`: x, y of crossings.
SLP_API int slp_plan_segments(slp_plan *plan, double metric_radius, double angular_radius,
                              const double *weights, const double *unlinks, size_t unlink_count,
                              unsigned threads);
/// The number of lines kept, and their ends and measures, which may be NULL.
SLP_API size_t slp_lines_copy(const void *handle, double *lines, double *values);

/// Explains a pair of cells and keeps the answer. Numbers: seen, verdict, distance, complete,
/// effects that decide, misses, seen by mirror, reflections.
SLP_API int slp_level_explain(slp_level *level, int64_t from, int64_t to, uint32_t misses,
                              int64_t numbers[8], double lines[8]);
/// A sequence of the answer, -1 for the one that is seen, or a miss: its portals and the cells
/// behind them, and the ends that decide as rows of x, y. The return is the number of portals.
SLP_API size_t slp_level_sequence(const slp_level *level, int which, int64_t *portals,
                                  int64_t *cells, double *ends, size_t *end_count);
SLP_API const char *slp_level_reason(const slp_level *level, int which);

// --- viewpoints: placement.c

/// Reads a table of viewpoints, of the file `name` where `text` is NULL, and keeps what they see.
/// Rows that do not say it have this field of view and range. `signs`: all rows are signs.
SLP_API int slp_level_cover(slp_level *level, const char *name, const char *text, size_t size,
                            double fov, double range, int signs);
/// Keeps the parts of a path that none of the viewpoints kept sees.
SLP_API int slp_level_cover_path(slp_level *level, const double *points, size_t count);
/// How many parts are kept, and rows of them, which may be NULL: from, to, both ends.
SLP_API size_t slp_level_unseen(const slp_level *level, double *rows);

/// Where viewpoints may stand: at `places`; at points of a kind, "corners", "walls" or "grid", of a
/// step; anywhere where both are NULL.
typedef struct slp_place {
    const char *from;
    const double *places;
    size_t count;
    double step, time_limit; ///< seconds; 0: no limit
} slp_place;
/// Finds the fewest viewpoints that see all that is inside, and keeps these and what they see.
SLP_API int slp_level_place(slp_level *level, const slp_place *options);
/// Of the placement kept: lower, upper, rounds, slivers, witnesses. `points` of witnesses may be
/// NULL.
SLP_API void slp_level_placed(const slp_level *level, int64_t numbers[5], double *unseen,
                              double *points);
/// What is proven of the placement kept, in a sentence or two.
SLP_API const char *slp_level_place_proof(slp_level *level);
/// Of the coverage kept: viewpoints, blind spots, pieces that are inside, their corners.
SLP_API void slp_level_cover_counts(const slp_level *level, int64_t counts[4]);
/// The name of a viewpoint; NULL for none.
SLP_API const char *slp_level_cover_name(const slp_level *level, size_t number);
/// Areas that 0, 1, 2, 3 or more see. Rows of viewpoints: x, y, heading, fov, range, nearest,
/// height, tilt, letters, sign, cost, seen, alone, spare. Rows of blind spots: area, x, y, x0, y0,
/// x1, y1.
SLP_API void slp_level_cover_copy(const slp_level *level, double areas[4], double *viewpoints,
                                  double *spots);
/// Of each piece: its first corner, how many see it, its blind spot or -1.
SLP_API void slp_level_cover_pieces(const slp_level *level, int64_t *offsets, int64_t *counts,
                                    int64_t *spots, double *corners);

// --- worlds; walls by their numbers

SLP_API slp_world *slp_world_new(void);
SLP_API void slp_world_free(slp_world *world);
/// Makes the world of a plan's map. `box`: its bounds x0, y0, x1, y1; NULL for those of the map.
/// `rows`: which visible sets it keeps, of sl_world_rows. `open`: by open sight.
SLP_API int slp_world_begin(slp_world *world, const slp_plan *plan, const double *box, int rows,
                            int open);
/// Adds `count` segments, rows of 4 doubles, of one kind: "wall", "door", "oneway", "seam",
/// "mirror". `stops`: what walls stop, as bits of SL_STOPS_SIGHT ...
SLP_API int slp_world_add(slp_world *world, const char *kind, const char *name, int open, int stops,
                          int one_sided, const double *segments, size_t count, int64_t *numbers);
SLP_API int slp_world_add_solid(slp_world *world, const double *corners, size_t count,
                                int64_t *numbers);
SLP_API int slp_world_remove(slp_world *world, const int64_t *numbers, size_t count);
SLP_API int slp_world_move(slp_world *world, int64_t number, const double *segment);
SLP_API int slp_world_set_open(slp_world *world, int64_t number, int open);
SLP_API int slp_world_commit(slp_world *world);
SLP_API void slp_world_discard(slp_world *world);
/// Makes visible sets exact for a time. *left: how many are not yet.
SLP_API int slp_world_settle(slp_world *world, double milliseconds, int64_t *left);
/// Copies the walls as they are into a plan.
SLP_API int slp_world_plan(slp_world *world, slp_plan *plan);
SLP_API int slp_world_can_see(slp_world *world, const double *eyes, const double *points,
                              size_t count, uint8_t *sees);
/// By visible sets: whether the cell of a place may see that of another one.
SLP_API int slp_world_may_see(slp_world *world, const double *eyes, const double *points,
                              size_t count, uint8_t *sees);
/// Finds what an eye sees; *corners: of its polygon, with arcs as chords within `tolerance`.
SLP_API int slp_world_region(slp_world *world, const double *eye, double heading, double fov,
                             double tolerance, int64_t *corners);
SLP_API void slp_world_region_points(const slp_world *world, double tolerance, double *points,
                                     size_t count);

// --- explored areas; a shape is the corners of its loops, and by loop how many there are up to it

SLP_API slp_explored *slp_explored_new(void);
SLP_API void slp_explored_free(slp_explored *explored);
SLP_API int slp_explored_begin(slp_explored *explored, double resolution);
SLP_API int slp_explored_read(slp_explored *explored, const char *name, const char *text,
                              size_t length);
SLP_API int slp_explored_add(slp_explored *explored, const double *corners, const int64_t *ends,
                             size_t count);
/// Loops and corners of the area.
SLP_API int slp_explored_counts(slp_explored *explored, int64_t counts[2]);
SLP_API int slp_explored_copy(slp_explored *explored, int64_t *ends, double *corners);
SLP_API int slp_explored_holds(slp_explored *explored, const double *points, size_t count,
                               uint8_t *holds);
/// Makes the text; *length: its bytes. slp_explored_text copies them.
SLP_API int slp_explored_write(slp_explored *explored, int64_t *length);
SLP_API void slp_explored_text(const slp_explored *explored, char *text);

#endif
