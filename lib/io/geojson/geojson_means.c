/// What the features of GeoJSON are.
///
/// No standard says where a file has its layers. So several properties are asked, those of the
/// formats that are common first: IMDF (Apple's Indoor Mapping Data Format), our own exports,
/// drawings that were converted (GDAL), OpenStreetMap's indoor tagging.
#include "io/geojson/geojson.h"
#include "io/parts/names.h"

#include <string.h>
#include <strings.h>

json_t *sli_geo_property(const sli_geo_feature *feature, const char *key) {
    json_t *value = json_object_get(feature->properties, key);
    if (!value) value = json_object_get(json_object_get(feature->properties, "tags"), key);
    return value && !json_is_null(value) ? value : NULL;
}

const char *sli_geo_text(const sli_geo_feature *feature, const char *key) {
    const json_t *value = sli_geo_property(feature, key);
    return json_is_string(value) ? json_string_value(value) : "";
}

// --- meanings

/// By one word among others: "building_footprint", "accessible path".
static sli_geo_meaning by_words(const char *name) {
    static const char *const buildings[] = {"building", "house", "gebäude", "bâtiment", "edificio"};
    static const char *const ways[] = {"street", "road",  "footpath",  "walkway", "sidewalk",
                                       "path",   "trail", "crosswalk", "route"};
    sli_geo_meaning means = SLI_GEO_UNSAID;
    for (sli_name_word word; sli_word_next(&name, &word);) {
        if (sli_word_in(&word, ways, sizeof ways / sizeof *ways)) return SLI_GEO_WAY;
        if (sli_word_in(&word, buildings, sizeof buildings / sizeof *buildings))
            means = SLI_GEO_WALL;
    }
    return means;
}

bool sli_geo_says_building(const char *word) {
    return by_words(word) == SLI_GEO_WALL;
}

static sli_geo_meaning meaning_of(const char *word) {
    static const struct {
        const char *word;
        sli_geo_meaning means;
    } known[] = {
        {"unit", SLI_GEO_WALL},         {"room", SLI_GEO_WALL},
        {"corridor", SLI_GEO_WALL},     {"building", SLI_GEO_WALL},
        {"column", SLI_GEO_WALL},       {"pillar", SLI_GEO_WALL},
        {"fence", SLI_GEO_WALL},        {"hedge", SLI_GEO_WALL},
        {"city_wall", SLI_GEO_WALL},    {"retaining_wall", SLI_GEO_WALL},
        {"opening", SLI_GEO_DOOR},      {"entrance", SLI_GEO_DOOR},
        {"mirror", SLI_GEO_MIRROR},     {"oneway", SLI_GEO_ONEWAY},
        {"start", SLI_GEO_START},       {"area", SLI_GEO_NO_WALL},
        {"level", SLI_GEO_NO_WALL},     {"venue", SLI_GEO_NO_WALL},
        {"footprint", SLI_GEO_NO_WALL}, {"address", SLI_GEO_NO_WALL},
        {"amenity", SLI_GEO_NO_WALL},   {"anchor", SLI_GEO_NO_WALL},
        {"occupant", SLI_GEO_NO_WALL},  {"section", SLI_GEO_NO_WALL},
        {"geofence", SLI_GEO_NO_WALL},  {"relationship", SLI_GEO_NO_WALL},
        {"detail", SLI_GEO_NO_WALL},    {"fixture", SLI_GEO_NO_WALL},
        {"kiosk", SLI_GEO_NO_WALL},     {"furniture", SLI_GEO_NO_WALL},
        {"cell", SLI_GEO_NO_WALL},      {"portal", SLI_GEO_NO_WALL},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcasecmp(word, known[i].word) == 0) return known[i].means;
    if (sli_says_solid(word)) return SLI_GEO_WALL;
    return sli_says_door(word) ? SLI_GEO_DOOR : by_words(word);
}

/// A tag of OpenStreetMap whose value says only what kind: "building": "yes".
static bool has_tag(const sli_geo_feature *feature, const char *key) {
    const char *text = sli_geo_text(feature, key);
    return *text && strcmp(text, "no") != 0;
}

static bool is_point(const sli_geo *geo, const sli_geo_feature *feature) {
    return feature->count == 1 && geo->lines.items[feature->first].count == 1;
}

/// Units of IMDF that no walls stand about; and fixtures that are walls.
static sli_geo_meaning by_category(const sli_geo_feature *feature) {
    const char *category = sli_geo_text(feature, "category");
    if (strcasecmp(feature->layer, "unit") == 0 &&
        (strcmp(category, "unenclosedarea") == 0 || strcmp(category, "opentobelow") == 0))
        return SLI_GEO_NO_WALL;
    if (strcasecmp(feature->layer, "fixture") == 0 &&
        (strcmp(category, "wall") == 0 || strcmp(category, "obstruction") == 0))
        return SLI_GEO_WALL;
    return feature->means;
}

/// Ways of OpenStreetMap, by which people go, and areas; none of them is a wall. NULL for none.
static const char *way_of(const sli_geo_feature *feature) {
    static const char *const keys[] = {"highway", "railway",  "waterway", "aeroway", "route",
                                       "power",   "cycleway", "landuse",  "natural", "leisure"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (has_tag(feature, keys[i])) return keys[i];
    return NULL;
}

static void find_meaning(const sli_geo *geo, sli_geo_feature *feature) {
    static const char *const keys[] = {"feature_type", "kind", "layer", "Layer",
                                       "indoor",       "type", "class"};
    const json_t *own = json_object_get(feature->feature, "feature_type");
    const char *tag = has_tag(feature, "barrier")                              ? "barrier"
                      : has_tag(feature, "building")                           ? "building"
                      : is_point(geo, feature) && has_tag(feature, "door")     ? "door"
                      : is_point(geo, feature) && has_tag(feature, "entrance") ? "entrance"
                                                                               : "";
    if (json_is_string(own)) feature->layer = json_string_value(own);
    feature->means = meaning_of(feature->layer);
    for (size_t i = 0; i < sizeof keys / sizeof *keys && !feature->means; i++) {
        const char *word = sli_geo_text(feature, keys[i]);
        if (!*feature->layer) feature->layer = word;
        feature->means = meaning_of(word);
        if (feature->means) feature->layer = word;
    }
    if (!feature->means && strcmp(tag, "barrier") == 0) {
        feature->layer = sli_geo_text(feature, tag);
        feature->means = meaning_of(feature->layer);
    } else if (!feature->means && *tag) {
        feature->layer = tag;
        feature->means = meaning_of(tag);
    }
    if (!feature->means && *feature->by_file) {
        feature->layer = feature->by_file;
        feature->means = meaning_of(feature->by_file);
    }
    feature->means = by_category(feature);
    const char *way = way_of(feature);
    if (way && (!feature->means || feature->means == SLI_GEO_NO_WALL)) {
        feature->layer = way;
        feature->means = SLI_GEO_WAY;
    }
}

/// Rooms of other kinds than "room", by the last word: "men_toilet", "stairs", but no
/// "office_desk".
static bool is_other_room(const char *name) {
    static const char *const rooms[] = {"toilet",    "toilets", "restroom", "washroom", "bathroom",
                                        "elevator",  "lift",    "stair",    "stairs",   "staircase",
                                        "stairwell", "hall",    "lobby",    "hallway",  "classroom",
                                        "kitchen",   "office",  "shaft"};
    bool last = false;
    for (sli_name_word word; sli_word_next(&name, &word);)
        last = sli_word_in(&word, rooms, sizeof rooms / sizeof *rooms);
    return last;
}

/// Where outlines of rooms are the walls, and none are drawn by themselves, those of other rooms
/// are walls, too.
static void take_other_rooms(const sli_geo *geo) {
    bool rooms = false;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *feature = &geo->features.items[i];
        if (sli_says_solid(feature->layer)) return;
        rooms |= strcasecmp(feature->layer, "room") == 0;
    }
    for (size_t i = 0; rooms && i < geo->features.count; i++) {
        sli_geo_feature *feature = &geo->features.items[i];
        if (!feature->means && is_other_room(feature->layer)) feature->means = SLI_GEO_WALL;
    }
}

sl_status sli_geo_find_meanings(sli_geo *geo) {
    for (size_t i = 0; i < geo->features.count; i++) {
        sli_geo_feature *feature = &geo->features.items[i];
        find_meaning(geo, feature);
        if (!json_is_number(sli_geo_property(feature, "ordinal"))) continue;
        SL_TRY(SL_ARRAY_ROOM(geo->context, &geo->levels, 1));
        geo->levels.items[geo->levels.count++] = i;
    }
    take_other_rooms(geo);
    return sli_geo_find_halls(geo);
}

sli_geo_meaning sli_geo_means_walls(const sli_geo *geo) {
    sli_geo_meaning walls = SLI_GEO_NO_WALL;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        if (!f->count || geo->lines.items[f->first].count < 2) continue;
        if (f->means == SLI_GEO_WALL) return SLI_GEO_WALL;
        if (f->means == SLI_GEO_UNSAID) walls = SLI_GEO_UNSAID;
    }
    return walls;
}
