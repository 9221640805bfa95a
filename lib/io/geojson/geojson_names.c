/// Names of rooms in GeoJSON: polygons that are walls and have a `name` (a text, or texts by their
/// languages, as IMDF has them), else a `ref` (a number on the door, in OpenStreetMap). They are
/// kept as the texts of a drawing are, at a place in the polygon.
#include "geometry/orient.h"
#include "io/geojson/geojson.h"
#include "map/source.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/// What holds rooms is none: its name is not that of the room at its middle.
static bool holds_rooms(const sli_geo_feature *feature) {
    static const char *const names[] = {"building",  "building:part", "level",   "venue",
                                        "footprint", "section",       "geofence"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcasecmp(feature->layer, names[i]) == 0) return true;
    return false;
}

/// The name of a room; NULL for none. English comes first of several languages, else the first.
static const char *name_of(const sli_geo_feature *feature) {
    const char *const keys[] = {"name", "ref"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        json_t *said = sli_geo_property(feature, keys[i]);
        const json_t *english = json_object_get(said, "en");
        void *const first = json_object_iter(said);
        const json_t *value = english ? english : first ? json_object_iter_value(first) : said;
        if (json_is_string(value) && *json_string_value(value)) return json_string_value(value);
    }
    return NULL;
}

/// The crossings of the line at a height with the rings of a feature, from left to right.
static size_t cross(const sli_geo *geo, const sli_geo_feature *feature, double y, double *at) {
    size_t count = 0;
    for (size_t k = 0; k < feature->count; k++) {
        const sli_geo_line line = geo->lines.items[feature->first + k];
        const sl_point *p = geo->points.items + line.first;
        for (size_t i = 1; i < line.count; i++)
            if ((p[i - 1].y > y) != (p[i].y > y))
                at[count++] =
                    p[i - 1].x + (y - p[i - 1].y) / (p[i].y - p[i - 1].y) * (p[i].x - p[i - 1].x);
    }
    qsort(at, count, sizeof *at, sl_compare_numbers);
    return count;
}

/// A place in a polygon: the middle of the widest part of it at one of a few heights. False for
/// none.
static sl_status find_place(const sli_geo *geo, const sli_geo_feature *feature, sl_point *place,
                            bool *found) {
    enum { HEIGHTS = 5 };
    sl_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    size_t sides = 0;
    double widest = 0;
    for (size_t k = 0; k < feature->count; k++) {
        const sli_geo_line line = geo->lines.items[feature->first + k];
        sides += line.count;
        for (size_t i = 0; i < line.count; i++) {
            const double y = geo->points.items[line.first + i].y;
            box.min.y = fmin(box.min.y, y);
            box.max.y = fmax(box.max.y, y);
        }
    }
    double *at = sl_alloc_array(geo->context, sides, sizeof *at);
    if (!at) return SL_NO_MEMORY;
    for (int i = 1; i <= HEIGHTS; i++) {
        const double y = box.min.y + (box.max.y - box.min.y) * i / (HEIGHTS + 1);
        const size_t count = cross(geo, feature, y, at);
        for (size_t k = 1; k < count; k += 2) {
            if (at[k] - at[k - 1] <= widest) continue;
            widest = at[k] - at[k - 1];
            *place = (sl_point){(at[k] + at[k - 1]) / 2, y};
        }
    }
    sl_free(geo->context, at);
    *found = widest > 0;
    return SL_OK;
}

sl_status sli_geo_add_names(sli_geo *geo) {
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *feature = &geo->features.items[i];
        const bool ring = feature->count && geo->lines.items[feature->first].ring;
        const char *name = name_of(feature);
        sl_point place;
        bool found;
        if (!feature->taken || feature->means != SLI_GEO_WALL || !ring || !name ||
            holds_rooms(feature))
            continue;
        SL_TRY(find_place(geo, feature, &place, &found));
        if (found)
            SL_TRY(
                sli_source_add_text(geo->context, &geo->map->source, name, strlen(name), place, 0));
    }
    return SL_OK;
}
