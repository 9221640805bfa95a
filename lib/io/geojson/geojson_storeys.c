/// Storeys of GeoJSON that no usual property names. Their rooms lie on each other, as those of one
/// storey never do: so a property that tells them apart is one of storeys.
///
/// - One that is named for storeys, in some language: a third of all outlines lie on outlines of
///   another value. The middle of one lies in the other.
/// - Any other, of small whole numbers or of names such as EG and OG: half of all outlines lie on
///   others so, each in the other, as rooms above rooms do. A zone about its rooms lies so on one
///   of them alone. Each value has three outlines at least.
///
/// Where outlines lie on each other so, and nothing tells them apart, a note says it. Time
/// O(outlines * those that lie on one).
#include "io/geojson/geojson.h"
#include "io/parts/names.h"
#include "space/index.h"

#include <math.h>
#include <string.h>

/// An outline, and what tells its storey.
typedef struct outline {
    const sli_geo_line *line;
    const sli_geo_feature *feature;
    sl_point middle; ///< within it
    uint32_t value;  ///< number of its value; 0 for none
} outline;

enum { MOST_KEYS = 64, MOST_VALUES = 50, MOST_LOOKS = 2000, LEAST_EACH = 3 };

typedef struct storeys {
    const sli_geo *geo;
    SL_ARRAY(outline) outlines;
    sl_box *boxes;
    sli_box_tree tree;
    sli_box_list found;
    char values[MOST_VALUES][SLI_GEO_LEVEL_TEXT];
    size_t outlines_of[MOST_VALUES]; ///< of each value
    size_t value_count;
} storeys;

/// How outlines lie on others.
typedef struct overlap {
    size_t looked, on_other; ///< on outlines of another value
    size_t each_on_other;    ///< each in the other
    size_t each_on_any;      ///< the same, whatever the values, but not one within the other
} overlap;

// --- outlines

/// Where the line at this height enters an outline, from the left, and leaves it again.
static bool find_middle(const sli_geo *geo, const sli_geo_line *line, double y, sl_point *out) {
    const sl_point *p = geo->points.items + line->first;
    double first = INFINITY, second = INFINITY;
    for (size_t i = 1; i < line->count; i++) {
        if ((p[i - 1].y <= y) == (p[i].y <= y)) continue;
        const double x =
            p[i - 1].x + (y - p[i - 1].y) / (p[i].y - p[i - 1].y) * (p[i].x - p[i - 1].x);
        if (x < first)
            second = first, first = x;
        else if (x < second)
            second = x;
    }
    *out = (sl_point){(first + second) / 2, y};
    return isfinite(second);
}

static bool holds(const sli_geo *geo, const sli_geo_line *line, sl_point at) {
    const sl_point *p = geo->points.items + line->first;
    bool in = false;
    for (size_t i = 1; i < line->count; i++)
        if ((p[i - 1].y <= at.y) != (p[i].y <= at.y) &&
            at.x < p[i - 1].x + (at.y - p[i - 1].y) / (p[i].y - p[i - 1].y) * (p[i].x - p[i - 1].x))
            in = !in;
    return in;
}

static sl_box box_of(const sli_geo *geo, const sli_geo_line *line) {
    sl_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = 0; i < line->count; i++) {
        const sl_point p = geo->points.items[line->first + i];
        box.min = (sl_point){fmin(box.min.x, p.x), fmin(box.min.y, p.y)};
        box.max = (sl_point){fmax(box.max.x, p.x), fmax(box.max.y, p.y)};
    }
    return box;
}

/// The first outline of each feature that means this; of those that are taken alone, where asked.
static sl_status list_outlines(storeys *all, sli_geo_meaning means, bool taken) {
    const sli_geo *geo = all->geo;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        const sli_geo_line *line = geo->lines.items + f->first;
        if (f->means != means || !f->count || !line->ring || line->count < 4) continue;
        if (taken && !f->taken) continue;
        const sl_box box = box_of(geo, line);
        outline own = {.line = line, .feature = f};
        if (!find_middle(geo, line, (box.min.y + box.max.y) / 2, &own.middle)) continue;
        SL_TRY(SL_ARRAY_ROOM(geo->context, &all->outlines, 1));
        all->outlines.items[all->outlines.count++] = own;
    }
    all->boxes = sl_alloc_array(geo->context, all->outlines.count, sizeof *all->boxes);
    if (!all->boxes) return SL_NO_MEMORY;
    for (size_t i = 0; i < all->outlines.count; i++)
        all->boxes[i] = box_of(geo, all->outlines.items[i].line);
    return sli_box_tree_create(geo->context, all->boxes, all->outlines.count, &all->tree);
}

static void destroy(storeys *all) {
    sli_box_tree_destroy(all->geo->context, &all->tree);
    sl_free(all->geo->context, all->found.items);
    sl_free(all->geo->context, all->outlines.items);
    sl_free(all->geo->context, all->boxes);
}

static bool is_within(const sl_box *a, const sl_box *b) {
    return a->min.x >= b->min.x && a->min.y >= b->min.y && a->max.x <= b->max.x &&
           a->max.y <= b->max.y;
}

static void look_at(const storeys *all, size_t number, overlap *out) {
    const outline *own = &all->outlines.items[number];
    bool other = false, each_other = false, each_any = false;
    for (size_t i = 0; i < all->found.count; i++) {
        const size_t at = all->found.items[i];
        const outline *to = &all->outlines.items[at];
        if (to == own || !holds(all->geo, to->line, own->middle)) continue;
        const bool each = holds(all->geo, own->line, to->middle);
        const bool differs = own->value && to->value && own->value != to->value;
        other |= differs;
        each_other |= each && differs;
        each_any |= each && !is_within(&all->boxes[number], &all->boxes[at]) &&
                    !is_within(&all->boxes[at], &all->boxes[number]);
    }
    out->looked++;
    out->on_other += other;
    out->each_on_other += each_other;
    out->each_on_any += each_any;
}

/// Looks at some of the outlines, spread over all.
static sl_status find_overlap(storeys *all, overlap *out) {
    const size_t step = 1 + all->outlines.count / MOST_LOOKS;
    *out = (overlap){0};
    for (size_t i = 0; i < all->outlines.count; i += step) {
        const sl_point middle = all->outlines.items[i].middle;
        const sl_box at = {middle, middle};
        SL_TRY(sl_check_cancelled(all->geo->context));
        SL_TRY(sli_box_tree_find(all->geo->context, &all->tree, &at, &all->found));
        look_at(all, i, out);
    }
    return SL_OK;
}

// --- properties

#define COUNT(list) (sizeof(list) / sizeof *(list))

/// "floor", "levelId", "Etage", "номер этажа": all words, one for storeys at least.
static bool is_named_for_storeys(const char *name) {
    static const char *const words[] = {
        "level",     "floor",    "storey",     "story",    "lvl",      "etage",  "étage",  "Étage",
        "stockwerk", "geschoss", "stock",      "piso",     "planta",   "nivel",  "niveau", "piano",
        "livello",   "andar",    "etaj",       "kat",      "kerros",   "våning", "vaning", "etasje",
        "plan",      "emelet",   "verdieping", "bouwlaag", "piętro",   "pietro", "patro",  "patró",
        "podlaží",   "podlazi",  "poschodie",  "sprat",    "όροφος",   "этаж",   "Этаж",   "этажа",
        "поверх",    "階",       "階数",       "フロア",   "层",       "楼层",   "樓層",   "层数",
        "层号",      "층",       "طابق",       "nível",    "pavimento"};
    static const char *const neutral[] = {"id",     "number", "num",   "nr",  "no",
                                          "name",   "code",   "index", "idx", "номер",
                                          "numero", "nummer", "номера"};
    bool said = false;
    for (sli_name_word word; sli_word_next(&name, &word);) {
        const bool storey = sli_word_in(&word, words, COUNT(words));
        if (!storey && !sli_word_in(&word, neutral, COUNT(neutral))) return false;
        said |= storey;
    }
    return said;
}

/// "EG", "1. OG", "B1", "2F", "ground": names of storeys that are no numbers.
static bool is_storey(const char *value) {
    static const char *const words[] = {
        "eg",     "og",    "ug",    "dg",     "kg",        "f",      "b",     "l",
        "g",      "rdc",   "pb",    "ground", "first",     "second", "third", "basement",
        "cellar", "attic", "upper", "lower",  "mezzanine", "floor",  "level", "erdgeschoss"};
    bool said = false;
    for (sli_name_word word; sli_word_next(&value, &word); said = true)
        if (!sli_word_in(&word, words, COUNT(words))) return false;
    return said;
}

static bool may_be_storey(const json_t *value) {
    const double number = json_number_value(value);
    if (json_is_number(value)) return floor(number) == number && fabs(number) <= MOST_VALUES;
    return json_is_string(value) && is_storey(json_string_value(value));
}

/// The number of a value from 1 on; 0 where there are too many.
static uint32_t number_of(storeys *all, const char *text) {
    for (size_t i = 0; i < all->value_count; i++)
        if (strcmp(all->values[i], text) == 0) return (uint32_t)i + 1;
    if (all->value_count == MOST_VALUES) return 0;
    all->outlines_of[all->value_count] = 0;
    snprintf(all->values[all->value_count], SLI_GEO_LEVEL_TEXT, "%s", text);
    return (uint32_t)++all->value_count;
}

/// Gives all outlines their values of a property. False where it tells no storeys apart: it has one
/// value, or too many, or is missing at more than a fourth of the outlines.
static bool take_values(storeys *all, const char *key, bool named) {
    size_t with = 0;
    all->value_count = 0;
    for (size_t i = 0; i < all->outlines.count; i++) {
        outline *own = &all->outlines.items[i];
        const json_t *value = sli_geo_property(own->feature, key);
        char text[SLI_GEO_LEVEL_TEXT];
        own->value = 0;
        sli_geo_value(value, text);
        if (!*text) continue;
        if (!named && !may_be_storey(value)) return false;
        own->value = number_of(all, text);
        if (!own->value) return false;
        all->outlines_of[own->value - 1]++;
        with++;
    }
    for (size_t i = 0; i < all->value_count && !named; i++)
        if (all->outlines_of[i] < LEAST_EACH) return false;
    return all->value_count > 1 && 4 * with >= 3 * all->outlines.count;
}

typedef struct key_list {
    const char *keys[MOST_KEYS];
    size_t count;
} key_list;

static void add_key(key_list *keys, const char *key) {
    for (size_t i = 0; i < keys->count; i++)
        if (strcmp(keys->keys[i], key) == 0) return;
    if (keys->count < MOST_KEYS) keys->keys[keys->count++] = key;
}

static key_list list_keys(const storeys *all) {
    const size_t step = 1 + all->outlines.count / MOST_LOOKS;
    key_list keys = {.count = 0};
    for (size_t i = 0; i < all->outlines.count; i += step) {
        const char *key;
        json_t *value;
        json_object_foreach(all->outlines.items[i].feature->properties, key, value)
            add_key(&keys, key);
    }
    return keys;
}

static sl_status try_keys(storeys *all, const key_list *keys, bool named, const char **key) {
    for (size_t i = 0; i < keys->count && !*key; i++) {
        overlap on;
        if (is_named_for_storeys(keys->keys[i]) != named) continue;
        if (!take_values(all, keys->keys[i], named)) continue;
        SL_TRY(find_overlap(all, &on));
        if (on.on_other > 1 &&
            (named ? 3 * on.on_other >= on.looked : 2 * on.each_on_other >= on.looked))
            *key = keys->keys[i];
    }
    return SL_OK;
}

/// Whether the usual properties name levels of walls.
static sl_status has_levels(sli_geo *geo, bool *has) {
    sl_map_list list = {0};
    const sl_status status = sli_geo_levels(geo, &list);
    *has = list.count > 0;
    sl_map_list_destroy(geo->context, &list);
    return status;
}

sl_status sli_geo_find_storeys(sli_geo *geo) {
    storeys all = {.geo = geo};
    bool has;
    if (geo->options->lines) return SL_OK;
    SL_TRY(has_levels(geo, &has));
    if (has) return SL_OK;
    sl_status status = list_outlines(&all, sli_geo_means_walls(geo), false);
    const key_list keys = list_keys(&all);
    const char *key = NULL;
    if (status == SL_OK) status = try_keys(&all, &keys, true, &key);
    if (status == SL_OK) status = try_keys(&all, &keys, false, &key);
    destroy(&all);
    geo->level_key = key;
    return status;
}

// --- doubt

/// Fewer outlines may be drawn twice by chance.
enum { LEAST_OUTLINES = 6 };

sl_status sli_geo_note_storeys(const sli_geo *geo) {
    storeys all = {.geo = geo};
    overlap on = {0};
    if (geo->options->map || geo->options->layers) return SL_OK;
    sl_status status = list_outlines(&all, SLI_GEO_WALL, true);
    if (status == SL_OK) status = find_overlap(&all, &on);
    destroy(&all);
    SL_TRY(status);
    if (on.looked < LEAST_OUTLINES || 3 * on.each_on_any < on.looked) return SL_OK;
    sl_note(geo->context,
            "%s: %.0f %% of its outlines lie on others, as rooms of several storeys do, and no "
            "property tells them apart: give each feature its \"level\", then: sightline check "
            "'%.300s' --map 0 -o map.png",
            geo->name, 100.0 * (double)on.each_on_any / (double)on.looked, geo->name);
    return SL_OK;
}
