/// On which levels the features of GeoJSON are, and which levels there are: each is a map.
#include "io/geojson/geojson.h"

#include <math.h>
#include <string.h>
#include <strings.h>

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

static void write_number(double number, char text[SLI_GEO_LEVEL_TEXT]) {
    char own[SL_NUMBER_TEXT];
    sl_number_write(number, own);
    snprintf(text, SLI_GEO_LEVEL_TEXT, "%s", own);
}

void sli_geo_value(const json_t *value, char text[SLI_GEO_LEVEL_TEXT]) {
    *text = '\0';
    if (json_is_number(value))
        write_number(json_number_value(value), text);
    else if (json_is_string(value))
        snprintf(text, SLI_GEO_LEVEL_TEXT, "%s", json_string_value(value));
}

/// What a feature says of its levels: "0", "0;1", "-1-2" (OpenStreetMap); "" for nothing.
static void level_text(const sli_geo *geo, const sli_geo_feature *feature,
                       char text[SLI_GEO_LEVEL_TEXT]) {
    if (geo->level_key) {
        sli_geo_value(sli_geo_property(feature, geo->level_key), text);
        return;
    }
    const char *id = sli_geo_text(feature, "level_id"), *said = sli_geo_text(feature, "level");
    const json_t *level = sli_geo_property(feature, "level");
    const json_t *own = strcasecmp(feature->layer, "level") == 0
                            ? sli_geo_property(feature, "ordinal") // of a level itself
                            : NULL;
    const double ordinal = *id                     ? ordinal_of(geo, id)
                           : json_is_number(level) ? json_number_value(level)
                           : json_is_number(own)   ? json_number_value(own)
                                                   : NAN;
    if (isfinite(ordinal)) {
        write_number(ordinal, text);
    } else {
        snprintf(text, SLI_GEO_LEVEL_TEXT, "%s", *id ? id : said);
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
    char text[SLI_GEO_LEVEL_TEXT];
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
    const sli_geo_meaning walls = geo->level_key ? sli_geo_means_walls(geo) : SLI_GEO_WALL;
    char text[SLI_GEO_LEVEL_TEXT];
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *feature = &geo->features.items[i];
        if (feature->means != walls && feature->means != SLI_GEO_DOOR) continue;
        // What OpenStreetMap says of some buildings divides no town into maps.
        if (strcasecmp(feature->layer, "building") == 0 && !*sli_geo_text(feature, "level_id"))
            continue;
        level_text(geo, feature, text);
        SL_TRY(each_level(text, add_level, &to));
    }
    return SL_OK;
}
