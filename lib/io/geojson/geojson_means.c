/// What the features of GeoJSON are, and on which levels.
///
/// No standard says where a file has its layers. So several properties are asked, those of the
/// formats that are common first: IMDF (Apple's Indoor Mapping Data Format), our own exports,
/// drawings that were converted (GDAL), OpenStreetMap's indoor tagging.
#include "io/geojson/geojson.h"
#include "io/parts/names.h"

#include <math.h>
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

// --- levels

/// The ordinal of a level of IMDF by its id; NAN for none.
static double ordinal_of(const sli_geo *geo, const char *id) {
    for (size_t i = 0; i < geo->levels.count; i++) {
        const sli_geo_feature *level = &geo->features.items[geo->levels.items[i]];
        const json_t *own = json_object_get(level->feature, "id");
        if (json_is_string(own) && strcmp(json_string_value(own), id) == 0)
            return json_number_value(sli_geo_property(level, "ordinal"));
    }
    return NAN;
}

enum { LEVEL_TEXT = 64 };

/// What a feature says of its levels: "0", "0;1", "-1-2" (OpenStreetMap); "" for nothing.
static void level_text(const sli_geo *geo, const sli_geo_feature *feature, char text[LEVEL_TEXT]) {
    const char *id = sli_geo_text(feature, "level_id"), *said = sli_geo_text(feature, "level");
    const json_t *level = sli_geo_property(feature, "level");
    const json_t *own = strcasecmp(feature->layer, "level") == 0
                            ? sli_geo_property(feature, "ordinal") // of a level itself
                            : NULL;
    const double ordinal = *id                     ? ordinal_of(geo, id)
                           : json_is_number(level) ? json_number_value(level)
                           : json_is_number(own)   ? json_number_value(own)
                                                   : NAN;
    char number[SL_NUMBER_TEXT];
    if (isfinite(ordinal)) {
        sl_number_write(ordinal, number);
        snprintf(text, LEVEL_TEXT, "%s", number);
    } else {
        snprintf(text, LEVEL_TEXT, "%s", *id ? id : said);
    }
}

/// Calls for each level of a text. A range counts where both ends are whole numbers.
static sl_status each_level(const char *text,
                            sl_status (*call)(void *user, const char *name, size_t length),
                            void *user) {
    enum { RANGE_MOST = 200 };
    while (*text) {
        const size_t length = strcspn(text, ";,");
        const char *dash = memchr(text + 1, '-', length > 1 ? length - 1 : 0);
        double low = 0, high = 0;
        const bool range = dash && sl_number_read(text, (size_t)(dash - text), &low) &&
                           sl_number_read(dash + 1, (size_t)(text + length - dash - 1), &high) &&
                           floor(low) == low && high >= low && high - low < RANGE_MOST;
        for (double at = low; range && at <= high; at++) {
            char name[SL_NUMBER_TEXT];
            sl_number_write(at, name);
            SL_TRY(call(user, name, strlen(name)));
        }
        size_t blanks = 0, end = length;
        while (blanks < end && text[blanks] == ' ') blanks++;
        while (end > blanks && text[end - 1] == ' ') end--;
        if (!range && end > blanks) SL_TRY(call(user, text + blanks, end - blanks));
        text += length + (text[length] != '\0');
    }
    return SL_OK;
}

typedef struct level_search {
    const char *level;
    bool found;
} level_search;

static sl_status compare_level(void *user, const char *name, size_t length) {
    level_search *search = user;
    search->found |= strlen(search->level) == length && memcmp(search->level, name, length) == 0;
    return SL_OK;
}

bool sli_geo_on_level(const sli_geo *geo, const sli_geo_feature *feature, const char *level) {
    char text[LEVEL_TEXT];
    level_text(geo, feature, text);
    level_search search = {.level = level, .found = !*text};
    (void)each_level(text, compare_level, &search);
    return search.found;
}

enum { LEVELS_MOST = 1000 };

typedef struct level_list {
    sl_context *context;
    const char *name; ///< of the file
    sl_map_list *list;
} level_list;

/// Whether a level is lower than another: numbers before names.
static bool is_lower(const char *a, const char *b) {
    double x, y;
    const bool has_x = sl_number_read(a, strlen(a), &x), has_y = sl_number_read(b, strlen(b), &y);
    return has_x && has_y ? x < y : has_x != has_y ? has_x : strcmp(a, b) < 0;
}

static sl_status add_level(void *user, const char *name, size_t length) {
    level_list *to = user;
    sl_map_list *list = to->list;
    for (size_t i = 0; i < list->count; i++)
        if (strlen(list->names[i]) == length && memcmp(list->names[i], name, length) == 0)
            return SL_OK;
    if (list->count == LEVELS_MOST)
        return sl_fail(to->context, SL_BAD_INPUT, "%s: more than %d levels", to->name, LEVELS_MOST);
    SL_TRY(sl_map_list_add(to->context, list, name, length));
    for (size_t i = list->count - 1; i > 0 && is_lower(list->names[i], list->names[i - 1]); i--) {
        char *lower = list->names[i];
        list->names[i] = list->names[i - 1];
        list->names[i - 1] = lower;
    }
    return SL_OK;
}

sl_status sli_geo_levels(sli_geo *geo, sl_map_list *list) {
    level_list to = {geo->context, geo->name, list};
    char text[LEVEL_TEXT];
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *feature = &geo->features.items[i];
        if (feature->means != SLI_GEO_WALL && feature->means != SLI_GEO_DOOR) continue;
        // What OpenStreetMap says of some buildings divides no town into maps.
        if (strcasecmp(feature->layer, "building") == 0 && !*sli_geo_text(feature, "level_id"))
            continue;
        level_text(geo, feature, text);
        SL_TRY(each_level(text, add_level, &to));
    }
    return SL_OK;
}
