/// One view, asked of every culling method: the cells that each keeps, the visible region, and the
/// same past objects that the bake does not know. Also the regions as polygons, for pictures.
#ifndef EYE_RUN_H
#define EYE_RUN_H

#include "arguments/options.h"
#include "reports/json_print.h"
#include "sightline/draw.h"
#include "sightline/json.h"
#include "sightline/query.h"
#include "sightline/view.h"

/// The answer of one method.
typedef struct eye_result {
    uint64_t *cells; ///< sl_eye_words() words
    uint32_t count;  ///< of cells
    double share;    ///< of the area of the cells on the eye's side (see eye_run)
    sl_eye_account account;
    double seconds;     ///< a query; 0 where it was not timed
    uint64_t *mirrored; ///< the cells seen by mirror; NULL where the method or the map knows none
    uint32_t mirrored_count;
    double mirrored_share;
    uint64_t rounded; ///< images that were rounded
} eye_result;

/// Shares are of the area of the cells that count (sl_baked_counts). If the eye's cell does not
/// count, they are of the other cells.
typedef struct eye_run {
    const sl_baked *baked; ///< the caller's
    sl_view view;
    uint32_t cell;       ///< the eye's
    eye_result *results; ///< one a method of sl_eye_methods()
    size_t result_count;
    sl_region region;            ///< the exact visible region
    double region_share;         ///< of the same area
    double region_seconds;       ///< as above
    bool has_mirrors;            ///< the map; else the rest is empty
    uint32_t mirror_depth;       ///< reflections at most
    sl_mirrored_region mirrored; ///< the region with what is seen by mirror
} eye_run;

/// A distance for sl_view_cone: as large as anything in the map.
double eye_reach(const sl_space *space);

/// The eye must be within the bounds, and the query over `baked`. `mirror_depth` is that of the
/// query. `timed`: repeats each question until its time is known.
sl_status eye_run_make(sl_context *context, const sl_baked *baked, sl_query *query,
                       const sl_view *view, uint32_t mirror_depth, bool timed, eye_run *out);
void eye_run_destroy(sl_context *context, eye_run *run);

typedef struct eye_object {
    const char *text; ///< as it was given
    uint32_t cells;   ///< that it lies in or touches
    bool possible;    ///< one of them is in the visible set of the eye's cell
    bool in_exact;    ///< one of them is seen, by exact culling without objects
} eye_object;

/// Zeroed: none.
typedef struct eye_objects {
    size_t count;
    sl_moving_box *boxes;
    eye_object *objects;
    bool *seen;          ///< by object
    bool *mirrored;      ///< by object: whether it is seen by mirror
    uint64_t *cells;     ///< seen past those that block
    uint32_t cell_count; ///< of them
    double share;        ///< of the area, as in eye_run
    sl_region region;    ///< past those that block
    double region_share;
    bool has_mirrors;         ///< the map; else the rest of this is empty
    uint64_t *mirrored_cells; ///< seen by mirror past those that block
    uint32_t mirrored_count;  ///< of them
    double mirrored_share;
    sl_mirrored_region mirrored_region;
    double seconds; ///< to put the boxes in and find the region; 0 where it was not timed
} eye_objects;

/// Reads X0,Y0,X1,Y1 or the name of the map's object, each with ',block' behind it or not.
sl_status eye_objects_read(sl_context *context, const option_list *texts, const sl_map *map,
                           eye_objects *out);
/// Finds out which objects the view sees, and what it sees past them.
sl_status eye_objects_run(sl_context *context, sl_query *query, const eye_run *run, bool timed,
                          eye_objects *objects);
void eye_objects_print(const eye_objects *objects);
/// Adds "objects_seen" and "past_objects"; nothing where there are no objects.
void eye_objects_add_json(json_fields *fields, const sl_baked *baked, const eye_objects *objects);
void eye_objects_destroy(sl_context *context, eye_objects *objects);

/// Adds the direct region (if `direct`) and all parts that are seen by mirror. Arcs become chords.
/// After a failure, seen_parts_destroy frees what was added.
typedef struct seen_parts {
    sl_drawn_region *items;
    size_t count, capacity;
} seen_parts;

sl_status seen_parts_add(sl_context *context, const sl_space *space,
                         const sl_mirrored_region *region, bool direct, seen_parts *parts);
/// Adds one region that is seen directly.
sl_status seen_parts_add_region(sl_context *context, const sl_space *space, const sl_region *region,
                                seen_parts *parts);
/// Puts what is seen by mirror as features of kind "mirrored". `parts` are those of the region, in
/// its order.
void seen_parts_put_mirrored(sl_geojson_writer *out, const sl_mirrored_region *region,
                             const sl_drawn_region *parts);
void seen_parts_destroy(sl_context *context, seen_parts *parts);

#endif
