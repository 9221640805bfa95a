/// Writing GeoJSON feature by feature (RFC 7946 in form): no tree in memory.
///
/// Coordinates are those of the map, in a plane, with y up. They are not longitude and latitude.
///
///     sl_geojson_writer out = sl_geojson_begin(stream);
///     sl_geojson_put_polygon(&out, "room", corners, 4);
///     sl_json_put_key(&out.json, "name");
///     sl_json_put_text(&out.json, "kitchen");
///     sl_geojson_end_feature(&out);
///     sl_geojson_end(&out);
#ifndef SIGHTLINE_GEOJSON_H
#define SIGHTLINE_GEOJSON_H

#include "sightline/geometry.h"
#include "sightline/json_write.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Start from sl_geojson_begin().
typedef struct sl_geojson_writer {
    sl_json_writer json; ///< for the properties of the feature that is open
    FILE *stream;
    bool follows; ///< a feature stands before the next one
} sl_geojson_writer;

/// Begins a collection of features. Refused writes are left to the stream's error flag.
SL_API sl_geojson_writer sl_geojson_begin(FILE *stream);
/// Ends the collection.
SL_API void sl_geojson_end(sl_geojson_writer *out);

/// Each begins a feature: its geometry, and its first property, `kind`. The caller then puts keys
/// and values of more properties into `json`, and calls sl_geojson_end_feature().
SL_API void sl_geojson_put_point(sl_geojson_writer *out, const char *kind, sl_point at);
/// A line of two points.
SL_API void sl_geojson_put_line(sl_geojson_writer *out, const char *kind, sl_point a, sl_point b);
/// A polygon without holes; points go counter-clockwise, and the first is not repeated. Equal
/// points that follow each other count once. Fewer than 3 points: no geometry (null).
SL_API void sl_geojson_put_polygon(sl_geojson_writer *out, const char *kind, const sl_point *points,
                                   size_t count);
/// One shape: a Polygon, a MultiPolygon where it is in several parts, or null where it has none.
SL_API void sl_geojson_put_shape(sl_geojson_writer *out, const char *kind, const sl_shapes *shapes,
                                 uint32_t number);
/// Ends the feature.
SL_API void sl_geojson_end_feature(sl_geojson_writer *out);

/// Properties of the feature that is open. NAN stands for no value, and becomes null.
SL_API void sl_geojson_add_real(sl_geojson_writer *out, const char *key, double value);
/// As sl_geojson_add_real, a whole number.
SL_API void sl_geojson_add_count(sl_geojson_writer *out, const char *key, uint64_t count);
/// As sl_geojson_add_real, true or false.
SL_API void sl_geojson_add_flag(sl_geojson_writer *out, const char *key, bool flag);
/// As sl_geojson_add_real, a text in UTF-8.
SL_API void sl_geojson_add_text(sl_geojson_writer *out, const char *key, const char *text);

#ifdef __cplusplus
}
#endif

#endif
