/// The eyes of `sightline isovist` (points, a grid, a path, a table from a file), the measures of
/// the regions that they see, and the files of both.
#ifndef ISOVIST_H
#define ISOVIST_H

#include "arguments/names.h"
#include "sightline/json.h"
#include "sightline/query.h"
#include "sightline/support.h"
#include "sightline/viewpoint.h"
#include "studies/table_part.h"

/// A place to look from, with its heading and view cone in degrees, and how far it sees.
typedef struct eye_place {
    sl_point at;
    double heading, fov;
    double range; ///< 0 for no limit
} eye_place;

typedef struct eye_places {
    SL_ARRAY(eye_place) list;
    sl_cameras table; ///< that they were read from; else empty
    // Of a grid: its squares, and by eye the square that it is in the middle of.
    sl_point corner;
    double step;
    size_t columns, rows;
    SL_ARRAY(size_t) squares;
} eye_places;

void eyes_destroy(sl_context *context, eye_places *eyes);

sl_status eyes_add(sl_context *context, eye_places *eyes, eye_place eye);

/// A grid of squares over the whole map: the middles of those that lie inside. `like` has the
/// heading and the view cone.
sl_status eyes_add_grid(sl_context *context, const sl_space *space, double step, eye_place like,
                        eye_places *eyes);

/// Drops the eyes of a grid that are not within outlines.
void eyes_keep_within(const sl_map *outlines, eye_places *eyes);

/// The points of a path. Where `step` is not 0: points every `step` along it instead.
sl_status eyes_add_path(sl_context *context, const sl_path *path, double step, eye_place like,
                        eye_places *eyes);

/// The viewpoints of a table (sl_cameras_read()). SL_BAD_INPUT with FILE:LINE on points outside the
/// map, too.
sl_status eyes_read_table(sl_context *context, const char *path, const sl_space *space,
                          eye_place like, eye_places *eyes);

typedef struct isovist_result {
    sl_region_measures measures;
    size_t corners;       ///< of walls that are seen
    double mirrored_area; ///< 0 where the map has no mirrors, as `parts`
    size_t parts;         ///< of what is seen by mirror
    bool meets_border;    ///< it ends where the map ends (sl_region_meets_border)
} isovist_result;

/// Adds all measures of a region as properties.
void isovist_put_measures(sl_geojson_writer *out, const sl_region_measures *measures);

/// The view of an eye.
sl_view eye_view(const sl_space *space, const eye_place *eye);

/// What is asked. The outline of the query is made, and its mirrors where they count.
typedef struct isovist_scene {
    const sl_space *space; ///< as the query's settings make it
    sl_query *query;
    bool mirrored;    ///< with what is seen by mirror
    double range;     ///< of all eyes, which may have less; 0 for no limit
    sl_earth earth;   ///< where the map lies (sl_map.earth)
    const char *unit; ///< of lengths (sl_map.unit)
} isovist_scene;

/// The visible region of an eye, with the parts that are seen by mirror.
sl_status isovist_look(sl_context *context, const isovist_scene *scene, const eye_place *eye,
                       sl_mirrored_region *out);

/// The number of viewpoints in the part of each viewpoint: where cells join theirs, through doors
/// that are open.
sl_status isovist_part_sizes(sl_context *context, sl_query *query, const eye_places *eyes,
                             uint32_t *sizes);

/// Fills out[i] for each eye of a part; NULL: for all. Reports stage "isovist".
sl_status isovist_run(sl_context *context, const isovist_scene *scene, const eye_places *eyes,
                      const table_part *part, unsigned threads, isovist_result *out);

/// Writes the table to a file, "-" for stdout. A map with mirrors adds columns for them. A name
/// that ends in .geojson: the regions as GeoJSON, with the columns as properties; in .dxf: the
/// regions alone, as outlines. Of a part of the table its rows are written.
sl_status isovist_write(sl_context *context, const isovist_scene *scene, const eye_places *eyes,
                        const isovist_result *isovists, const table_part *part, const char *path);

#endif
