/// GeoJSON: a writer of features, and the export of a baked file by it.
///
/// A feature is a geometry and its properties. Rings of polygons are closed, outer rings go
/// counter-clockwise, and holes clockwise (RFC 7946, 3.1.6). Coordinates are those of the map's
/// plane, so a collection names no coordinate reference system.
#include "sightline/geojson.h"

#include "bake/export.h"
#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>

// --- the writer

sl_geojson_writer sl_geojson_begin(FILE *stream) {
    fputs("{\"type\": \"FeatureCollection\", \"features\": [", stream);
    return (sl_geojson_writer){.json = sl_json_writer_to(stream, 0), .stream = stream};
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

void sl_geojson_add_count(sl_geojson_writer *out, const char *key, uint64_t count) {
    sl_json_put_key(&out->json, key);
    sl_json_put_integer(&out->json, (int64_t)count);
}

void sl_geojson_add_flag(sl_geojson_writer *out, const char *key, bool flag) {
    sl_json_put_key(&out->json, key);
    sl_json_put_flag(&out->json, flag);
}

void sl_geojson_add_text(sl_geojson_writer *out, const char *key, const char *text) {
    sl_json_put_key(&out->json, key);
    sl_json_put_text(&out->json, text);
}

// --- the export of a baked file

static void put_cell(sl_geojson_writer *out, const sl_baked *baked, uint32_t number) {
    const sl_space *space = &baked->space;
    const sl_cell *cell = &space->cells[number];
    sl_geojson_put_polygon(out, "cell", space->vertices + cell->first_vertex, cell->vertex_count);
    sl_geojson_add_count(out, "id", number);
    sl_geojson_add_flag(out, "inside", cell->inside);
    sl_geojson_add_flag(out, "solid", cell->solid);
    sl_geojson_add_count(out, "sees", sl_pvs_count(&baked->visibility.pvs, number));
    sl_geojson_end_feature(out);
}

static void put_portal(sl_geojson_writer *out, const sl_baked *baked, uint32_t number) {
    const sl_portal *portal = &baked->space.portals[number];
    const sl_door *door = sli_portal_door(baked, number);
    const char *oneway = sli_glass_name(sli_portal_glass(&baked->space, number));
    sl_geojson_put_line(out, "portal", portal->left, portal->right);
    sl_json_put_key(&out->json, "cells");
    sl_json_put_list(&out->json);
    sl_json_put_integer(&out->json, portal->cell[0]);
    sl_json_put_integer(&out->json, portal->cell[1]);
    sl_json_put_end(&out->json, ']');
    if (door) sl_geojson_add_text(out, "door", door->name);
    if (oneway) sl_geojson_add_text(out, "oneway", oneway);
    sl_geojson_end_feature(out);
}

static void put_doors(sl_geojson_writer *out, const sl_baked *baked) {
    for (uint32_t i = 0; i < baked->space.seam_count; i++) {
        const sl_seam *seam = &baked->space.seams[i];
        if (seam->kind != SL_SEAM_DOOR) continue;
        const sl_door *door = &baked->map.doors[seam->number];
        sl_geojson_put_line(out, "door", seam->at.a, seam->at.b);
        sl_geojson_add_text(out, "name", door->name);
        sl_geojson_add_flag(out, "open", door->open);
        sl_geojson_end_feature(out);
    }
}

static void put_glass(sl_geojson_writer *out, const char *kind, const sl_glass *glass,
                      size_t count) {
    for (size_t i = 0; i < count; i++) {
        sl_geojson_put_line(out, kind, glass[i].segment.a, glass[i].segment.b);
        sl_geojson_end_feature(out);
    }
}

static void put_starts(sl_geojson_writer *out, const sl_map *map) {
    for (size_t i = 0; i < map->start_count; i++) {
        sl_geojson_put_point(out, "start", map->starts[i].at);
        sl_geojson_add_real(out, "heading", map->starts[i].heading);
        sl_geojson_end_feature(out);
    }
}

static sl_status put_all(sl_context *context, const sl_baked *baked, FILE *stream) {
    const sl_space *space = &baked->space;
    const sl_map *map = &baked->map;
    sl_geojson_writer out = sl_geojson_begin(stream);
    for (uint32_t i = 0; i < space->cell_count && !ferror(stream); i++) put_cell(&out, baked, i);
    SL_TRY(sl_check_cancelled(context));
    for (uint32_t i = 0; i < space->portal_count && !ferror(stream); i++)
        put_portal(&out, baked, i);
    SL_TRY(sl_check_cancelled(context));
    for (uint32_t i = 0; i < space->wall_count && !ferror(stream); i++) {
        sl_geojson_put_line(&out, "wall", space->walls[i].a, space->walls[i].b);
        sl_geojson_end_feature(&out);
    }
    put_doors(&out, baked);
    put_glass(&out, "mirror", map->mirrors, map->mirror_count);
    put_glass(&out, "oneway", map->oneways, map->oneway_count);
    put_starts(&out, map);
    sl_geojson_end(&out);
    return sl_check_cancelled(context);
}

sl_status sli_export_geojson(sl_context *context, const sl_baked *baked,
                             const sl_export_options *options, const char *path) {
    (void)options;
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output, put_all(context, baked, output.stream));
}
