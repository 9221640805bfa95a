/// GeoJSON, feature by feature.
///
/// A feature is a geometry and its properties. Rings of polygons are closed, outer rings go
/// counter-clockwise, and holes clockwise (RFC 7946, 3.1.6). Places of a map on the earth are
/// turned back into degrees. Those of any other map are in its plane, and "crs": null says so, or
/// names the coordinate system that the user has named.
#include "sightline/json.h"

#include "geometry/orient.h"

#include <math.h>

void sl_geojson_put_crs(FILE *stream, const sl_earth *earth) {
    if (earth && earth->known) return;
    if (earth && earth->epsg)
        fprintf(stream,
                "\"crs\": {\"type\": \"name\", \"properties\": {\"name\": "
                "\"urn:ogc:def:crs:EPSG::%u\"}}, ",
                (unsigned)earth->epsg);
    else
        fputs("\"crs\": null, ", stream);
}

sl_geojson_writer sl_geojson_begin(FILE *stream, const sl_earth *earth) {
    const bool known = earth && earth->known;
    fputs("{\"type\": \"FeatureCollection\", ", stream);
    sl_geojson_put_crs(stream, earth);
    fputs("\"features\": [", stream);
    return (sl_geojson_writer){.json = sl_json_writer_to(stream, 0),
                               .stream = stream,
                               .earth = known ? *earth : (sl_earth){0}};
}

void sl_geojson_end(sl_geojson_writer *out) {
    fputs("]}\n", out->stream);
}

/// Begins a feature, up to its geometry.
static void begin_feature(sl_geojson_writer *out) {
    fputs(out->follows ? ",\n" : "\n", out->stream);
    out->follows = true;
    sl_json_put_object(&out->json);
    sl_json_put_key(&out->json, "type");
    sl_json_put_text(&out->json, "Feature");
    sl_json_put_key(&out->json, "geometry");
}

/// Begins the geometry, up to its coordinates.
static void begin_geometry(sl_geojson_writer *out, const char *geometry) {
    begin_feature(out);
    sl_json_put_object(&out->json);
    sl_json_put_key(&out->json, "type");
    sl_json_put_text(&out->json, geometry);
    sl_json_put_key(&out->json, "coordinates");
}

/// Begins the properties.
static void begin_properties(sl_geojson_writer *out, const char *kind) {
    sl_json_put_key(&out->json, "properties");
    sl_json_put_object(&out->json);
    sl_geojson_add_text(out, "kind", kind);
}

static void end_geometry(sl_geojson_writer *out, const char *kind) {
    sl_json_put_end(&out->json, '}');
    begin_properties(out, kind);
}

static void put_nothing(sl_geojson_writer *out, const char *kind) {
    begin_feature(out);
    sl_json_put_null(&out->json);
    begin_properties(out, kind);
}

void sl_geojson_end_feature(sl_geojson_writer *out) {
    sl_json_put_end(&out->json, '}');
    sl_json_put_end(&out->json, '}');
}

static void put_place(sl_geojson_writer *out, sl_point p) {
    if (out->earth.known) p = sl_earth_of_map(&out->earth, p);
    sl_json_put_list(&out->json);
    sl_json_put_real(&out->json, p.x);
    sl_json_put_real(&out->json, p.y);
    sl_json_put_end(&out->json, ']');
}

/// A ring ends at the point where it begins.
static void put_ring(sl_geojson_writer *out, const sl_point *points, size_t count) {
    sl_json_put_list(&out->json);
    for (size_t i = 0; i < count; i++)
        if (!sli_corner_repeats(points, count, i)) put_place(out, points[i]);
    size_t first = 0;
    while (first + 1 < count && sli_corner_repeats(points, count, first)) first++;
    put_place(out, points[first]);
    sl_json_put_end(&out->json, ']');
}

void sl_geojson_put_point(sl_geojson_writer *out, const char *kind, sl_point at) {
    begin_geometry(out, "Point");
    put_place(out, at);
    end_geometry(out, kind);
}

void sl_geojson_put_line(sl_geojson_writer *out, const char *kind, sl_point a, sl_point b) {
    begin_geometry(out, "LineString");
    sl_json_put_list(&out->json);
    put_place(out, a);
    put_place(out, b);
    sl_json_put_end(&out->json, ']');
    end_geometry(out, kind);
}

void sl_geojson_put_polygon(sl_geojson_writer *out, const char *kind, const sl_point *points,
                            size_t count) {
    if (sli_distinct_corners(points, count) < 3) {
        put_nothing(out, kind);
        return;
    }
    begin_geometry(out, "Polygon");
    sl_json_put_list(&out->json);
    put_ring(out, points, count);
    sl_json_put_end(&out->json, ']');
    end_geometry(out, kind);
}

static void put_rings(sl_geojson_writer *out, const sl_shapes *shapes, uint32_t polygon) {
    sl_json_put_list(&out->json);
    for (uint32_t i = shapes->polygons[polygon]; i < shapes->polygons[polygon + 1]; i++)
        put_ring(out, shapes->points + shapes->rings[i], shapes->rings[i + 1] - shapes->rings[i]);
    sl_json_put_end(&out->json, ']');
}

void sl_geojson_put_shape(sl_geojson_writer *out, const char *kind, const sl_shapes *shapes,
                          uint32_t number) {
    const uint32_t first = shapes->shapes[number], end = shapes->shapes[number + 1];
    if (first == end) {
        put_nothing(out, kind);
        return;
    }
    const bool several = end - first > 1;
    begin_geometry(out, several ? "MultiPolygon" : "Polygon");
    if (several) sl_json_put_list(&out->json);
    for (uint32_t i = first; i < end; i++) put_rings(out, shapes, i);
    if (several) sl_json_put_end(&out->json, ']');
    end_geometry(out, kind);
}

void sl_geojson_add_real(sl_geojson_writer *out, const char *key, double value) {
    sl_json_put_key(&out->json, key);
    if (isnan(value))
        sl_json_put_null(&out->json);
    else
        sl_json_put_real(&out->json, value);
}
