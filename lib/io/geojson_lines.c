/// Drawn lines out of GeoJSON (RFC 7946): street centre lines as GIS export them, and the tables of
/// `sightline axial` and `sightline segments`.
///
/// The tree is walked from its root. Geometries of lines give a wall for each two points that
/// follow each other; rings of polygons are their outlines. Points are passed over, and so are
/// properties, heights, and features without a geometry. Coordinates are taken as they are, in a
/// plane.
#include "io/parts/document.h"
#include "sightline/io.h"

#include <string.h>

/// Collections of geometries may hold collections; deeper ones are refused.
enum { DEEPEST = 32 };

static sl_status read_point(const sli_json *at, sl_point *point) {
    size_t count;
    SL_TRY(sli_json_array(at, &count));
    if (count < 2) return sli_json_fail(at, "expected two coordinates");
    const sli_json x = sli_json_item(at, 0), y = sli_json_item(at, 1);
    SL_TRY(sli_json_number(&x, &point->x));
    return sli_json_number(&y, &point->y);
}

static sl_status read_line(const sli_json *line, sl_map *map) {
    size_t count;
    sl_point before = {0, 0}, point;
    SL_TRY(sli_json_array(line, &count));
    if (count == 1) return sli_json_fail(line, "expected two points or more");
    for (size_t i = 0; i < count; i++, before = point) {
        const sli_json at = sli_json_item(line, i);
        SL_TRY(read_point(&at, &point));
        if (!i || (point.x == before.x && point.y == before.y)) continue;
        SL_TRY(sl_map_add_wall(line->file->context, map, before, point, 0));
    }
    return SL_OK;
}

/// `depth`: how many arrays the lines are in.
static sl_status read_lines(const sli_json *lines, int depth, sl_map *map) {
    size_t count;
    if (!depth) return read_line(lines, map);
    SL_TRY(sli_json_array(lines, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json item = sli_json_item(lines, i);
        SL_TRY(read_lines(&item, depth - 1, map));
    }
    return SL_OK;
}

static sl_status read_object(const sli_json *object, int level, sl_map *map);

static sl_status read_each(const sli_json *list, int level, sl_map *map) {
    size_t count;
    SL_TRY(sli_json_array(list, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json item = sli_json_item(list, i);
        SL_TRY(read_object(&item, level + 1, map));
    }
    return SL_OK;
}

static sl_status read_object(const sli_json *object, int level, sl_map *map) {
    static const struct {
        const char *name;
        int depth; ///< of its lines; below 0: it has none
    } kinds[] = {{"LineString", 0},   {"MultiLineString", 1}, {"Polygon", 1},
                 {"MultiPolygon", 2}, {"Point", -1},          {"MultiPoint", -1}};
    const char *name;
    if (level > DEEPEST) return sli_json_fail(object, "collections are nested too deep");
    SL_TRY(sli_json_object(object));
    const sli_json type = sli_json_member(object, "type");
    const sli_json lines = sli_json_member(object, "coordinates");
    const sli_json geometry = sli_json_member(object, "geometry");
    const sli_json features = sli_json_member(object, "features");
    const sli_json parts = sli_json_member(object, "geometries");
    SL_TRY(sli_json_text(&type, &name));
    if (!strcmp(name, "FeatureCollection")) return read_each(&features, level, map);
    if (!strcmp(name, "GeometryCollection")) return read_each(&parts, level, map);
    if (!strcmp(name, "Feature"))
        return geometry.value ? read_object(&geometry, level + 1, map) : SL_OK;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (strcmp(name, kinds[i].name) != 0) continue;
        return kinds[i].depth < 0 ? SL_OK : read_lines(&lines, kinds[i].depth, map);
    }
    return sli_json_fail(&type, "expected a kind of GeoJSON, as \"FeatureCollection\"");
}

sl_status sl_lines_read_geojson(sl_context *context, const char *name, const char *text,
                                size_t size, sl_map *map) {
    sli_json_file file = {0};
    sl_map out = {0};
    SL_TRY(sli_json_open(context, name, text, size, &file));
    const sli_json root = sli_json_root(&file);
    const sl_status status = read_object(&root, 0, &out);
    sli_json_close(&file);
    if (status == SL_OK)
        *map = out;
    else
        sl_map_destroy(context, &out);
    return status;
}
