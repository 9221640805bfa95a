/// GeoJSON (RFC 7946) walked from its root, and its coordinates laid in a plane.
///
/// Geometries of lines give a line, rings of polygons their outlines, points a line of one point.
/// Heights are passed over, and so are features without a geometry.
///
/// Coordinates are longitude and latitude by the RFC. But many plans are in metres, and older files
/// name a coordinate system ("crs", The GeoJSON Format Specification, 2008). So they are degrees if
/// all are within 180 and 90, with four decimals or more: three are 100 m. Files of IMDF are always
/// in degrees. Degrees are laid in a plane about the middle of the file (sightline/earth.h).
#include "io/geojson/geojson.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "sightline/io.h"

#include <math.h>
#include <string.h>

/// Collections of geometries may hold collections; deeper ones are refused.
enum { DEEPEST = 32 };

// --- the walk

static sl_status read_point(sli_geo *geo, const sli_json *at) {
    sl_point point;
    size_t count;
    SL_TRY(sli_json_array(at, &count));
    if (count < 2) return sli_json_fail(at, "expected two coordinates");
    const sli_json x = sli_json_item(at, 0), y = sli_json_item(at, 1);
    SL_TRY(sli_json_number(&x, &point.x));
    SL_TRY(sli_json_number(&y, &point.y));
    sli_keep_finest(&geo->finest, sli_shortest_unit(point.x));
    sli_keep_finest(&geo->finest, sli_shortest_unit(point.y));
    SL_TRY(SL_ARRAY_ROOM(geo->context, &geo->points, 1));
    geo->points.items[geo->points.count++] = point;
    return SL_OK;
}

static sl_status begin_line(sli_geo *geo, bool ring) {
    SL_TRY(SL_ARRAY_ROOM(geo->context, &geo->lines, 1));
    geo->lines.items[geo->lines.count++] = (sli_geo_line){.first = geo->points.count, .ring = ring};
    geo->features.items[geo->features.count - 1].count++;
    return SL_OK;
}

/// Some files leave the last point of a polygon out, which is the first one again.
static sl_status close_ring(sli_geo *geo) {
    sli_geo_line *line = &geo->lines.items[geo->lines.count - 1];
    if (line->count < 3) return SL_OK;
    const sl_point first = geo->points.items[line->first];
    const sl_point last = geo->points.items[line->first + line->count - 1];
    if (first.x == last.x && first.y == last.y) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(geo->context, &geo->points, 1));
    geo->points.items[geo->points.count++] = first;
    line->count++;
    return SL_OK;
}

/// `depth`: how many arrays the points are in.
static sl_status read_points(sli_geo *geo, const sli_json *at, int depth, bool ring) {
    size_t count;
    if (depth <= 1) SL_TRY(begin_line(geo, ring));
    if (!depth) {
        geo->lines.items[geo->lines.count - 1].count = 1;
        return read_point(geo, at);
    }
    SL_TRY(sli_json_array(at, &count));
    if (depth == 1 && count == 1) return sli_json_fail(at, "expected two points or more");
    if (depth == 1) geo->lines.items[geo->lines.count - 1].count = count;
    for (size_t i = 0; i < count; i++) {
        const sli_json item = sli_json_item(at, i);
        SL_TRY(depth == 1 ? read_point(geo, &item) : read_points(geo, &item, depth - 1, ring));
    }
    return depth == 1 && ring ? close_ring(geo) : SL_OK;
}

static sl_status read_object(sli_geo *geo, const sli_json *object, int level);

static sl_status read_each(sli_geo *geo, const sli_json *list, int level) {
    size_t count;
    SL_TRY(sli_json_array(list, &count));
    for (size_t i = 0; i < count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(geo->context));
        const sli_json item = sli_json_item(list, i);
        SL_TRY(read_object(geo, &item, level + 1));
    }
    return SL_OK;
}

static sl_status begin_feature(sli_geo *geo, const sli_json *feature) {
    SL_TRY(SL_ARRAY_ROOM(geo->context, &geo->features, 1));
    geo->features.items[geo->features.count++] = (sli_geo_feature){
        .feature = feature ? feature->value : NULL,
        .properties = feature ? sli_json_member(feature, "properties").value : NULL,
        .layer = "",
        .by_file = geo->by_file,
        .first = geo->lines.count};
    return SL_OK;
}

static sl_status read_geometry(sli_geo *geo, const sli_json *object, const sli_json *type) {
    static const struct {
        const char *name;
        int depth; ///< of its points; below 0: it is passed over
        bool ring;
    } kinds[] = {{"LineString", 1, false}, {"MultiLineString", 2, false},
                 {"Polygon", 2, true},     {"MultiPolygon", 3, true},
                 {"Point", 0, false},      {"MultiPoint", -1, false}};
    const sli_json points = sli_json_member(object, "coordinates");
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (strcmp(json_string_value(type->value), kinds[i].name) != 0) continue;
        if (kinds[i].depth < 0) return SL_OK;
        if (!geo->features.count) SL_TRY(begin_feature(geo, NULL));
        return read_points(geo, &points, kinds[i].depth, kinds[i].ring);
    }
    return sli_json_fail(type, "expected a kind of GeoJSON, as \"FeatureCollection\"");
}

static sl_status read_object(sli_geo *geo, const sli_json *object, int level) {
    const char *name;
    if (level > DEEPEST) return sli_json_fail(object, "collections are nested too deep");
    SL_TRY(sli_json_object(object));
    const sli_json type = sli_json_member(object, "type");
    const sli_json geometry = sli_json_member(object, "geometry");
    const sli_json features = sli_json_member(object, "features");
    const sli_json parts = sli_json_member(object, "geometries");
    SL_TRY(sli_json_text(&type, &name));
    if (!strcmp(name, "FeatureCollection")) return read_each(geo, &features, level);
    if (!strcmp(name, "GeometryCollection")) return read_each(geo, &parts, level);
    if (strcmp(name, "Feature") != 0) return read_geometry(geo, object, &type);
    SL_TRY(begin_feature(geo, object));
    return geometry.value ? read_object(geo, &geometry, level + 1) : SL_OK;
}

/// A file without a type may hold collections under names, as layers: all are read. Else it is no
/// GeoJSON.
static sl_status read_named(sli_geo *geo, const sli_json *root) {
    const char *key;
    json_t *member;
    bool any = false;
    json_object_foreach(root->value, key, member) {
        const sli_json part = sli_json_member(root, key);
        if (strcmp(sli_json_text_of(&part, "type"), "FeatureCollection") != 0) continue;
        any = true;
        SL_TRY(read_object(geo, &part, 1));
    }
    return any ? SL_OK
               : sl_fail_at(geo->context, root->file->name, 1,
                            "no member 'type', as GeoJSON has it: \"FeatureCollection\", "
                            "\"Feature\" or a geometry; save the map as GeoJSON from the program "
                            "that made it");
}

/// Opens a file and walks it.
static sl_status walk(sli_geo *geo, const char *name, const char *text, size_t size) {
    sli_json_file *file = &geo->files[geo->file_count];
    SL_TRY(sli_json_open(geo->context, name, text, size, file));
    geo->file_count++;
    const sli_json root = sli_json_root(file);
    const bool typed = !json_is_object(root.value) || sli_json_member(&root, "type").value;
    return typed ? read_object(geo, &root, 0) : read_named(geo, &root);
}

/// The kinds of IMDF (Apple's Indoor Mapping Data Format) that belong to a plan. A set has a file
/// of each, whose name says what its features are where they do not.
static const char *const kinds[SLI_GEO_FILES] = {"unit", "opening", "level", "fixture"};

/// The ending of `unit.geojson`, or of `unit2.geojson`, the file of another storey: its other files
/// have the same. NULL for other files.
static const char *ending_of_set(const sli_geo *geo) {
    const char *name = sl_path_name(geo->name);
    const size_t length = strlen(kinds[0]);
    if (strncmp(name, kinds[0], length) != 0) return NULL;
    const size_t number = strspn(name + length, "0123456789");
    return strcmp(name + length + number, ".geojson") == 0 ? name + length : NULL;
}

/// Walks a file of the same set, if it is there.
static sl_status walk_beside(sli_geo *geo, size_t kind, const char *ending) {
    char *const name = geo->beside[kind], *from = NULL;
    snprintf(name, sizeof geo->beside[kind], "%s%.40s", kinds[kind], ending);
    char *path = sli_beside_path(geo->context, geo->name, (sli_word){name, strlen(name)});
    if (!path) return SL_NO_MEMORY;
    const bool there = sli_beside_is_there(path);
    sl_free(geo->context, path);
    if (!there) return SL_OK;
    sl_bytes bytes = {0};
    SL_TRY(sli_beside_read(geo->context, geo->name, name, &from, &bytes));
    geo->by_file = kinds[kind];
    const sl_status status = walk(geo, name, bytes.data, bytes.size);
    sl_free(geo->context, from);
    sl_free(geo->context, bytes.data);
    return status;
}

sl_status sli_geo_open(sli_geo *geo, const char *text, size_t size) {
    const char *ending = ending_of_set(geo);
    geo->by_file = ending ? kinds[0] : "";
    SL_TRY(walk(geo, geo->name, text, size));
    for (size_t i = 1; ending && i < SLI_GEO_FILES; i++) SL_TRY(walk_beside(geo, i, ending));
    for (size_t i = 0; i < geo->features.count; i++) {
        sli_geo_feature *feature = &geo->features.items[i];
        if (!json_is_object(feature->properties)) feature->properties = NULL;
    }
    return SL_OK;
}

void sli_geo_close(sli_geo *geo) {
    for (size_t i = 0; i < geo->file_count; i++) sli_json_close(&geo->files[i]);
    sl_free(geo->context, geo->features.items);
    sl_free(geo->context, geo->lines.items);
    sl_free(geo->context, geo->points.items);
    sl_free(geo->context, geo->levels.items);
}

// --- degrees

/// What the file itself says.
typedef enum said { SAYS_NOTHING, SAYS_DEGREES, SAYS_PLANE } said;

static said what_crs_says(const sli_geo *geo, const char **crs) {
    static const char *const of_degrees[] = {"CRS84", "4326", "4258", "4269", "4979"};
    const json_t *member = json_object_get(geo->files[0].root, "crs");
    *crs = "";
    if (!member) return SAYS_NOTHING;
    const json_t *name = json_object_get(json_object_get(member, "properties"), "name");
    if (!json_is_string(name)) return SAYS_PLANE; // null: of no place on earth
    *crs = json_string_value(name);
    for (size_t i = 0; i < sizeof of_degrees / sizeof *of_degrees; i++) {
        const char *at = strstr(*crs, of_degrees[i]);
        if (at && !at[strlen(of_degrees[i])]) return SAYS_DEGREES;
    }
    return SAYS_PLANE;
}

static sl_box bounds_of(const sli_geo *geo) {
    sl_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = 0; i < geo->points.count; i++) {
        const sl_point p = geo->points.items[i];
        box.min = (sl_point){fmin(box.min.x, p.x), fmin(box.min.y, p.y)};
        box.max = (sl_point){fmax(box.max.x, p.x), fmax(box.max.y, p.y)};
    }
    return box;
}

/// Whether it is of a set of IMDF, which is in degrees however few decimals they have.
static bool is_indoor_mapping(const sli_geo *geo) {
    for (size_t i = 0; i < geo->features.count; i++)
        if (json_is_string(json_object_get(geo->features.items[i].feature, "feature_type")))
            return true;
    return false;
}

/// Sets *degrees, or fails where the options cannot be so.
static sl_status choose_degrees(const sli_geo *geo, sl_box box, bool *degrees) {
    const sl_import_options *options = geo->options;
    const char *crs;
    const said says = what_crs_says(geo, &crs);
    const bool within =
        box.min.x >= -180 && box.max.x <= 180 && box.min.y >= -90 && box.max.y <= 90;
    *degrees = false;
    if (options->degrees && !within)
        return sl_fail(geo->context, SL_BAD_ARGUMENT,
                       "--degrees: %s has coordinates beyond 180 and 90 degrees", geo->name);
    if (options->planar) return SL_OK;
    if (!options->degrees && says == SAYS_PLANE) {
        if (*crs)
            sl_note(geo->context, "%s: coordinates are of '%.60s': taken as plain units", geo->name,
                    crs);
        return SL_OK;
    }
    *degrees = within && (options->degrees || says == SAYS_DEGREES || geo->finest < 1.5e-4 ||
                          is_indoor_mapping(geo));
    if (within && !*degrees)
        sl_note(geo->context,
                "%s: coordinates have fewer than four decimals: taken as plain units, not as "
                "longitude and latitude; --degrees takes them so",
                geo->name);
    return SL_OK;
}

/// The middle, in steps of 1e-7 degrees. Files about longitude 180 may be in two parts.
static sl_earth middle_of(sli_geo *geo, sl_box box) {
    if (box.max.x - box.min.x > 180) {
        for (size_t i = 0; i < geo->points.count; i++)
            if (geo->points.items[i].x < 0) geo->points.items[i].x += 360;
        box = bounds_of(geo);
    }
    const double x = rint((box.min.x / 2 + box.max.x / 2) * 1e7) / 1e7;
    const double y = rint((box.min.y / 2 + box.max.y / 2) * 1e7) / 1e7;
    return (sl_earth){.known = true, .longitude = remainder(x, 360), .latitude = y};
}

/// Lengths that are wrong by more than this are no plan any more.
#define STRETCH_MOST 1.01

sl_status sli_geo_place(sli_geo *geo) {
    const sl_box box = bounds_of(geo);
    bool degrees;
    double stretch = 1;
    if (!geo->points.count) return SL_OK;
    SL_TRY(choose_degrees(geo, box, &degrees));
    if (!degrees) return SL_OK;
    const sl_earth earth = middle_of(geo, box);
    for (size_t i = 0; i < geo->points.count; i++) {
        const double east = remainder(geo->points.items[i].x - earth.longitude, 360);
        sl_point *at = &geo->points.items[i];
        *at = sl_earth_to_map(&earth, *at);
        stretch = fmax(stretch, fabs(east) < 45 ? sl_earth_stretch(at->x) : INFINITY);
    }
    if (!(stretch <= STRETCH_MOST))
        return sl_fail_at(geo->context, geo->name, 0,
                          "%.6g x %.6g degrees are too wide for a plan: lengths would be wrong by "
                          "more than 1%%; --planar takes coordinates as plain units",
                          box.max.x - box.min.x, box.max.y - box.min.y);
    geo->map->earth = earth;
    geo->finest *= 1e5; // a degree has 111 km
    strcpy(geo->map->unit, "m");
    sl_note(geo->context,
            "%s: longitude and latitude, laid in a plane about %.10g,%.10g; unit: m, lengths right "
            "within %.2g parts in a million; --planar takes coordinates as plain units",
            geo->name, earth.longitude, earth.latitude, fmax(0.01, (stretch - 1) * 1e6));
    return SL_OK;
}
