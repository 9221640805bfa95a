/// Writing JSON piece by piece, and GeoJSON feature by feature: no tree in memory, no library.
///
///     sl_json_writer json = sl_json_writer_to(stdout, 2);
///     sl_json_put_object(&json);
///     sl_json_put_key(&json, "cells");
///     sl_json_put_integer(&json, 42);
///     sl_json_put_end(&json, '}');
#ifndef SIGHTLINE_JSON_H
#define SIGHTLINE_JSON_H

#include "sightline/earth.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Commas, line ends and indentation are put where they belong. Start from sl_json_writer_to(), or
/// set `put`, `user` and `indent` and leave the rest zero.
typedef struct sl_json_writer {
    void (*put)(void *user, const char *text, size_t size);
    void *user;
    unsigned indent; ///< blanks for each depth; 0: one line without blanks
    unsigned depth;  ///< lists and objects that are open
    bool follows;    ///< an item stands before the next one
    bool keyed;      ///< the next value belongs to a key
    bool failed;     ///< a number was not finite, which JSON cannot say
} sl_json_writer;

/// A writer into a stream. Refused writes are left to the stream's error flag.
SL_API sl_json_writer sl_json_writer_to(FILE *stream, unsigned indent);

/// Opens an object: keys, each followed by its value, then sl_json_put_end with '}'.
SL_API void sl_json_put_object(sl_json_writer *json);
/// Opens a list: values, then sl_json_put_end with ']'.
SL_API void sl_json_put_list(sl_json_writer *json);
/// Closes the object ('}') or the list (']') that was opened last.
SL_API void sl_json_put_end(sl_json_writer *json, char bracket);
/// The name of an object's next value; UTF-8.
SL_API void sl_json_put_key(sl_json_writer *json, const char *key);

/// The value `null`.
SL_API void sl_json_put_null(sl_json_writer *json);
/// The value `true` or `false`.
SL_API void sl_json_put_flag(sl_json_writer *json, bool flag);
/// A whole number.
SL_API void sl_json_put_integer(sl_json_writer *json, int64_t number);
/// 17 digits, which read back to the same double; always with a point or an exponent.
SL_API void sl_json_put_real(sl_json_writer *json, double finite);
/// UTF-8, which sl_text_is_utf8() checks.
SL_API void sl_json_put_text(sl_json_writer *json, const char *text);
/// A value, or what a list or an object holds, that was written with indent 0.
SL_API void sl_json_put_written(sl_json_writer *json, const char *text, size_t size);

/// Whether a text is well-formed UTF-8 (RFC 3629).
SL_API bool sl_text_is_utf8(const char *text);

// --- GeoJSON (RFC 7946). Coordinates are longitude and latitude where the map lies on the earth.
// Else they are those of the map, in a plane, with y up; the collection then says "crs": null,
// which stands for no place on earth (The GeoJSON Format Specification, 2008, section 3).
//
//     sl_geojson_writer out = sl_geojson_begin(stream, &map->earth);
//     sl_geojson_put_polygon(&out, "room", corners, 4);
//     sl_geojson_add_text(&out, "name", "kitchen");
//     sl_geojson_end_feature(&out);
//     sl_geojson_end(&out);

/// Start from sl_geojson_begin().
typedef struct sl_geojson_writer {
    sl_json_writer json; ///< for the properties of the feature that is open
    FILE *stream;
    bool follows;   ///< a feature stands before the next one
    sl_earth earth; ///< where the coordinates' plane lies
} sl_geojson_writer;

/// Writes the member "crs", with a comma behind it: the coordinate system that was named, or null.
/// Nothing for a map that lies on the earth: it is in degrees. For writers of their own.
SL_API void sl_geojson_put_crs(FILE *stream, const sl_earth *earth);

/// Begins a collection of features of a map that lies there (sl_map.earth); NULL: in a plane of its
/// own. Refused writes are left to the stream's error flag.
SL_API sl_geojson_writer sl_geojson_begin(FILE *stream, const sl_earth *earth);
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
static inline void sl_geojson_add_count(sl_geojson_writer *out, const char *key, uint64_t count) {
    sl_json_put_key(&out->json, key);
    sl_json_put_integer(&out->json, (int64_t)count);
}
/// As sl_geojson_add_real, true or false.
static inline void sl_geojson_add_flag(sl_geojson_writer *out, const char *key, bool flag) {
    sl_json_put_key(&out->json, key);
    sl_json_put_flag(&out->json, flag);
}
/// As sl_geojson_add_real, a text in UTF-8.
static inline void sl_geojson_add_text(sl_geojson_writer *out, const char *key, const char *text) {
    sl_json_put_key(&out->json, key);
    sl_json_put_text(&out->json, text);
}

#ifdef __cplusplus
}
#endif

#endif
