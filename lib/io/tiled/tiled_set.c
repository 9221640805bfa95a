/// Tiled's tilesets, as far as they say what is solid, and its objects as walls.
#include "io/tiled/tiled.h"

#include "io/parts/names.h"
#include "map/scan.h"

#include <stdlib.h>
#include <strings.h>

// --- tilesets

/// The names of properties whose text is a type: `type`, and `area_type`.
static bool is_type(const char *name) {
    static const char *const names[] = {"type", "kind", "class", "category", "tag", "name"};
    sli_name_word last = {.length = 0};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcasecmp(name, names[i]) == 0) return true;
    for (sli_name_word word; sli_word_next(&name, &word);) last = word;
    return strcmp(last.text, "type") == 0;
}

/// Whether the value is true or false, written as such, as a number or as a word.
static bool truth_of(const sli_json *value, bool *truth) {
    const char *text = json_string_value(value->value);
    bool said;
    if (text && sli_game_truth(text, truth)) return true;
    *truth = sli_json_true(value, &said);
    return said;
}

/// What a property says of what has it.
static sli_tiled_word word_of_property(const char *name, const sli_json *value) {
    const char *text = json_string_value(value->value);
    bool truth;
    if (!name) return SLI_TILED_UNSAID;
    if (text && is_type(name) && sli_says_solid(text)) return SLI_TILED_SOLID;
    // The libraries of physics call a body that never moves static.
    if (text && strcasecmp(name, "bodyType") == 0 && strcasecmp(text, "static") == 0)
        return SLI_TILED_SOLID;
    const bool contrary = sli_says_walkable(name);
    if (!contrary && !sli_says_solid(name)) return SLI_TILED_UNSAID;
    if (!truth_of(value, &truth)) return SLI_TILED_UNSAID;
    return truth != contrary ? SLI_TILED_SOLID : SLI_TILED_OPEN;
}

sli_tiled_properties sli_tiled_properties_of(const sli_json *thing) {
    const sli_json all = sli_json_member(thing, "properties");
    return (sli_tiled_properties){.all = all, .at = json_object_iter(all.value)};
}

bool sli_tiled_next_property(sli_tiled_properties *walk, const char **name, sli_json *value) {
    const sli_json *all = &walk->all;
    *value = (sli_json){.file = all->file};
    if (walk->next < json_array_size(all->value)) {
        const json_t *item = json_array_get(all->value, walk->next++);
        *name = json_string_value(json_object_get(item, "name"));
        value->value = json_object_get(item, "value");
        return true;
    }
    if (!walk->at) return false;
    *name = json_object_iter_key(walk->at);
    value->value = json_object_iter_value(walk->at);
    walk->at = json_object_iter_next(all->value, walk->at);
    return true;
}

const char *sli_tiled_name_of(const sli_json *object) {
    const char *own = sli_json_text_of(object, "name"), *name;
    sli_tiled_properties at = sli_tiled_properties_of(object);
    for (sli_json value; !*own && sli_tiled_next_property(&at, &name, &value);)
        if (name && strcasecmp(name, "name") == 0 && json_is_string(value.value))
            own = json_string_value(value.value);
    return own;
}

sli_tiled_word sli_tiled_word_of(const sli_json *thing, const char *class_key) {
    sli_tiled_properties at = sli_tiled_properties_of(thing);
    sli_tiled_word word = SLI_TILED_UNSAID, by_name = SLI_TILED_UNSAID;
    const char *name;
    for (sli_json value; word == SLI_TILED_UNSAID && sli_tiled_next_property(&at, &name, &value);) {
        const bool names = name && strcasecmp(name, "name") == 0;
        *(names ? &by_name : &word) = word_of_property(name, &value);
    }
    if (word == SLI_TILED_UNSAID) word = by_name; // what says it outright goes before a name
    if (word != SLI_TILED_UNSAID) return word;
    return sli_says_solid(sli_json_text_of(thing, class_key)) ||
                   sli_says_solid(sli_json_text_of(thing, "class"))
               ? SLI_TILED_SOLID
               : SLI_TILED_UNSAID;
}

sl_status sli_tiled_add_tile(sl_context *context, sli_tiled_set *set, sli_tiled_tile tile) {
    if (tile.word == SLI_TILED_UNSAID && !tile.says.kind && !tile.shapes && !tile.terrain &&
        !tile.named)
        return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &set->tiles, 1));
    tile.order = (uint32_t)set->tiles.count;
    set->tiles.items[set->tiles.count++] = tile;
    return SL_OK;
}

static json_t *shapes_of(const sli_json *tile) {
    const sli_json group = sli_json_member(tile, "objectgroup");
    const sli_json objects = sli_json_member(&group, "objects");
    return json_array_size(objects.value) ? objects.value : NULL;
}

static int compare_tiles(const void *left, const void *right) {
    const sli_tiled_tile *a = left, *b = right;
    return (a->id > b->id) - (a->id < b->id);
}

static int compare_order(const void *left, const void *right) {
    const sli_tiled_tile *a = left, *b = right;
    const int order = compare_tiles(left, right);
    return order ? order : (a->order > b->order) - (a->order < b->order);
}

/// Whether the picture of a tile or a tileset is named for what is solid: "wall_2.png".
static bool shows_walls(const sli_json *thing) {
    const char *file = sl_path_name(sli_json_text_of(thing, "image"));
    char name[80];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(file, "."), file);
    return sli_game_kind_of(name) == SLI_GAME_SOLID;
}

static sl_status read_tile(const sli_json *set_json, const sli_json *tile, int64_t id,
                           sli_tiled_set *set) {
    return sli_tiled_add_tile(set_json->file->context, set,
                              (sli_tiled_tile){.id = (uint32_t)id,
                                               .word = sli_tiled_word_of(tile, "type"),
                                               .says = sli_tiled_says_of(tile, "type"),
                                               .terrain = sli_tiled_has_terrain(set_json, tile),
                                               .named = shows_walls(tile),
                                               .shapes = shapes_of(tile)});
}

/// The number that the key of an old file's tile is.
static bool id_of(const char *key, int64_t *id) {
    char *end;
    *id = strtoll(key, &end, 10);
    return end > key && !*end && *id >= 0 && *id <= UINT32_MAX;
}

/// JSON files before Tiled 1.2 have tiles by their numbers, and their properties apart.
static sl_status read_old_tiles(const sli_json *json, const sli_json *tiles, sli_tiled_set *set) {
    const sli_json all = sli_json_member(json, "tileproperties");
    const char *key;
    json_t *value;
    int64_t id;
    json_object_foreach(tiles->value, key, value) {
        const sli_json tile = {.file = json->file, .value = value, .parent = tiles, .key = key};
        if (json_is_object(value) && id_of(key, &id)) SL_TRY(read_tile(json, &tile, id, set));
    }
    json_object_foreach(all.value, key, value) {
        if (!json_is_object(value) || !id_of(key, &id)) continue;
        json_t *of = json_object();
        const sli_json tile = {.file = json->file, .value = of, .parent = &all, .key = key};
        const bool good = of && json_object_set(of, "properties", value) == 0;
        const sl_status status =
            good ? read_tile(json, &tile, id, set) : sl_fail_memory(json->file->context);
        json_decref(of);
        SL_TRY(status);
    }
    return SL_OK;
}

/// Sorts the tiles by their ids, and makes one of those with the same.
static void merge_tiles(sli_tiled_set *set) {
    size_t kept = 0;
    if (!set->tiles.count) return;
    qsort(set->tiles.items, set->tiles.count, sizeof *set->tiles.items, compare_order);
    for (size_t i = 0; i < set->tiles.count; i++) {
        const sli_tiled_tile next = set->tiles.items[i];
        sli_tiled_tile *last = kept ? &set->tiles.items[kept - 1] : NULL;
        if (!last || last->id != next.id) {
            set->tiles.items[kept++] = next;
            continue;
        }
        if (last->word == SLI_TILED_UNSAID) last->word = next.word;
        if (!last->says.kind) last->says = next.says;
        if (!last->shapes) last->shapes = next.shapes;
        last->terrain |= next.terrain;
        last->named |= next.named;
    }
    set->tiles.count = kept;
}

static sl_status read_tiles(const sli_json *json, sli_tiled_set *set) {
    const sli_json tiles = sli_json_member(json, "tiles");
    const bool old = !tiles.value || json_is_object(tiles.value);
    size_t count = 0;
    if (old) SL_TRY(read_old_tiles(json, &tiles, set));
    if (!old) SL_TRY(sli_json_array(&tiles, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json tile = sli_json_item(&tiles, i), id = sli_json_member(&tile, "id");
        int64_t number;
        SL_TRY(sli_json_object(&tile));
        SL_TRY(sli_json_whole(&id, 0, UINT32_MAX, &number));
        SL_TRY(read_tile(json, &tile, number, set));
    }
    SL_TRY(sli_tiled_read_wang_sets(json, set));
    merge_tiles(set);
    return SL_OK;
}

/// Shapes of isometric sets are drawn in a diamond that stands on the tile's lower left corner.
static sl_status read_grid(const sli_json *json, sli_tiled_set *set) {
    const sli_json grid = sli_json_member(json, "grid");
    if (strcmp(sli_json_text_of(&grid, "orientation"), "isometric") != 0) return SL_OK;
    const sli_json width = sli_json_member(&grid, "width");
    const sli_json height = sli_json_member(&grid, "height");
    int64_t columns, rows;
    SL_TRY(sli_json_whole(&width, 1, INT32_MAX, &columns));
    SL_TRY(sli_json_whole(&height, 1, INT32_MAX, &rows));
    set->diamond = (sl_point){(double)columns, (double)rows};
    return SL_OK;
}

/// All but the first tile's number.
static sl_status read_set(const sli_json *json, sli_tiled_set *set) {
    const sli_json width = sli_json_member(json, "tilewidth");
    const sli_json height = sli_json_member(json, "tileheight");
    const sli_json offset = sli_json_member(json, "tileoffset");
    const sli_json x = sli_json_member(&offset, "x"), y = sli_json_member(&offset, "y");
    SL_TRY(sli_json_object(json));
    SL_TRY(sli_json_number(&width, &set->width));
    SL_TRY(sli_json_number(&height, &set->height));
    SL_TRY(sli_json_number_if(&x, &set->x));
    SL_TRY(sli_json_number_if(&y, &set->y));
    SL_TRY(read_grid(json, set));
    const char *name = sli_json_text_of(json, "name");
    set->word = sli_tiled_word_of(json, "class");
    set->named = sli_game_kind_of(name) == SLI_GAME_SOLID || shows_walls(json);
    set->inside = sli_game_says_inside(name);
    return read_tiles(json, set);
}

bool sli_tiled_looks_like_xml(const sl_bytes *bytes) {
    const char *at = sli_skip_mark(bytes->data, bytes->size);
    return at[strspn(at, " \t\r\n")] == '<';
}

/// A tileset in a file of its own, XML or JSON whatever its ending says.
static sl_status read_separate(sl_context *context, const char *name, const char *source,
                               sli_tiled_set *set) {
    sl_bytes bytes;
    const sl_status found = sli_beside_read(context, name, source, &set->path, &bytes);
    if (found == SL_BAD_INPUT) set->missing = source;
    if (found != SL_OK) return set->missing ? SL_OK : found;
    sl_status status =
        sli_tiled_looks_like_xml(&bytes)
            ? sli_tiled_from_xml(context, set->path, "tileset", bytes.data, bytes.size, &set->file)
            : sli_json_open(context, set->path, bytes.data, bytes.size, &set->file);
    sl_free(context, bytes.data);
    SL_TRY(status);
    const sli_json root = sli_json_root(&set->file);
    return read_set(&root, set);
}

static sl_status read_one(const sli_json *item, sli_tiled_set *set) {
    const sli_json first = sli_json_member(item, "firstgid"),
                   source = sli_json_member(item, "source");
    int64_t number;
    SL_TRY(sli_json_object(item));
    SL_TRY(sli_json_whole(&first, 1, UINT32_MAX, &number));
    set->first = (uint32_t)number;
    if (!source.value) return read_set(item, set);
    const char *text;
    SL_TRY(sli_json_text(&source, &text));
    set->source = text;
    return read_separate(item->file->context, item->file->name, text, set);
}

static int compare_sets(const void *left, const void *right) {
    const sli_tiled_set *a = left, *b = right;
    return (a->first > b->first) - (a->first < b->first);
}

sl_status sli_tiled_read_sets(const sli_json *map, sli_tiled_sets *sets) {
    const sli_json list = sli_json_member(map, "tilesets");
    size_t count = 0;
    if (list.value) SL_TRY(sli_json_array(&list, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json item = sli_json_item(&list, i);
        SL_TRY(sl_check_cancelled(map->file->context));
        SL_TRY(SL_ARRAY_ROOM(map->file->context, &sets->sets, 1));
        // In the list at once: what it has when it fails is given back with the list.
        sli_tiled_set *set = &sets->sets.items[sets->sets.count++];
        *set = (sli_tiled_set){0};
        SL_TRY(read_one(&item, set));
        sets->missing += set->missing != NULL;
    }
    if (sets->sets.count)
        qsort(sets->sets.items, sets->sets.count, sizeof *sets->sets.items, compare_sets);
    return SL_OK;
}

void sli_tiled_destroy_sets(sl_context *context, sli_tiled_sets *sets) {
    for (size_t i = 0; i < sets->sets.count; i++) {
        sli_tiled_set *set = &sets->sets.items[i];
        sl_free(context, set->tiles.items);
        sli_json_close(&set->file);
        sl_free(context, set->path);
    }
    sl_free(context, sets->sets.items);
    *sets = (sli_tiled_sets){0};
}

const sli_tiled_set *sli_tiled_find_set(const sli_tiled_sets *sets, uint32_t gid) {
    size_t low = 0, high = gid == SLI_TILED_TILE ? 0 : sets->sets.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sets->sets.items[middle].first <= gid)
            low = middle + 1;
        else
            high = middle;
    }
    return low ? &sets->sets.items[low - 1] : NULL;
}

sli_tiled_tile *sli_tiled_find_tile(const sli_tiled_set *set, uint32_t gid) {
    const sli_tiled_tile key = {.id = gid - set->first};
    if (!set->tiles.count) return NULL;
    return bsearch(&key, set->tiles.items, set->tiles.count, sizeof key, compare_tiles);
}

// --- shapes

static const double full_turn = 6.28318530717958647692;

sl_status sli_tiled_read_shape(const sli_json *object, sli_tiled_shape *shape) {
    SL_TRY(sli_json_object(object));
    sli_tiled_shape read = {.kind = SLI_TILED_RECTANGLE};
    const struct {
        const char *key;
        double *to;
    } numbers[] = {
        {"x", &read.x},
        {"y", &read.y},
        {"width", &read.width},
        {"height", &read.height},
        {"rotation", &read.rotation},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const sli_json number = sli_json_member(object, numbers[i].key);
        SL_TRY(sli_json_number_if(&number, numbers[i].to));
    }
    read.turn = sli_affine_turn(read.rotation);
    const sli_json gid = sli_json_member(object, "gid"),
                   line = sli_json_member(object, SLI_JSON_LINE);
    int64_t whole = 0;
    SL_TRY(sli_json_whole_if(&gid, 0, UINT32_MAX, &whole));
    read.gid = (uint32_t)whole;
    read.line = (uint32_t)json_integer_value(line.value);
    if (read.gid) read.kind = SLI_TILED_PICTURE;
    static const struct {
        const char *key;
        sli_tiled_kind kind;
    } kinds[] = {
        {"ellipse", SLI_TILED_ELLIPSE},   {"polygon", SLI_TILED_POLYGON},
        {"polyline", SLI_TILED_POLYLINE}, {"point", SLI_TILED_OTHER},
        {"text", SLI_TILED_OTHER},        {"capsule", SLI_TILED_OTHER},
        {"template", SLI_TILED_OTHER},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const sli_json mark = sli_json_member(object, kinds[i].key);
        if (!mark.value || json_is_false(mark.value)) continue;
        read.kind = kinds[i].kind;
        read.points = mark;
    }
    *shape = read;
    return SL_OK;
}

/// A walk over a shape's points: an array of objects with x and y, or the text "x,y x,y".
typedef struct walk {
    const sli_json *points;
    size_t next;
    const char *at;
} walk;

static sl_status read_text_number(walk *steps, double *number) {
    const size_t length = strcspn(steps->at, ", \t\r\n");
    const sli_word word = {steps->at, length};
    const bool read = sl_number_read(word.at, word.length, number);
    *number = sli_coordinate(*number);
    if (!read || !sl_coordinate_usable(*number))
        return sli_json_fail(steps->points, "point %zu: expected x,y; found '%s'", steps->next + 1,
                             sli_show(word).text);
    steps->at += length;
    return SL_OK;
}

static sl_status next_text_point(walk *steps, sl_point *point, bool *any) {
    steps->at += strspn(steps->at, " \t\r\n");
    *any = *steps->at != '\0';
    if (!*any) return SL_OK;
    SL_TRY(read_text_number(steps, &point->x));
    steps->at += *steps->at == ',';
    SL_TRY(read_text_number(steps, &point->y));
    steps->next++;
    return SL_OK;
}

/// The next point; `*any` is false at the end.
static sl_status next_point(walk *steps, sl_point *point, bool *any) {
    if (steps->at) return next_text_point(steps, point, any);
    *any = steps->next < json_array_size(steps->points->value);
    if (!*any) return SL_OK;
    const sli_json item = sli_json_item(steps->points, steps->next++);
    SL_TRY(sli_json_object(&item));
    const sli_json x = sli_json_member(&item, "x"), y = sli_json_member(&item, "y");
    SL_TRY(sli_json_number(&x, &point->x));
    return sli_json_number(&y, &point->y);
}

static sl_status draw_points(sli_pen *pen, const sli_tiled_shape *shape) {
    walk steps = {.points = &shape->points};
    if (json_is_string(shape->points.value))
        steps.at = json_string_value(shape->points.value);
    else if (!json_is_array(shape->points.value))
        return sli_json_fail(&shape->points, "expected a list of points");
    const size_t least = shape->kind == SLI_TILED_POLYGON ? 3 : 2;
    sl_point first = {0};
    for (;;) {
        sl_point point;
        bool any;
        SL_TRY(next_point(&steps, &point, &any));
        if (!any) break;
        if (steps.next == 1)
            pen->at = first = point;
        else
            SL_TRY(sli_pen_line(pen, point));
    }
    if (steps.next < least)
        return sli_json_fail(&shape->points, "%zu points, at least %zu are needed", steps.next,
                             least);
    return shape->kind == SLI_TILED_POLYGON ? sli_pen_line(pen, first) : SL_OK;
}

/// The corners in the order of the box's sides; `top` is over the shape's place for a picture.
static sl_status draw_box(sli_pen *pen, double width, double top, double bottom) {
    const sl_point corners[] = {{width, top}, {width, bottom}, {0, bottom}, {0, top}};
    pen->at = corners[3];
    for (size_t i = 0; i < 4; i++) SL_TRY(sli_pen_line(pen, corners[i]));
    return SL_OK;
}

static sl_status draw_ellipse(sli_pen *pen, double width, double height) {
    const double a = width / 2, b = height / 2;
    pen->at = (sl_point){width, b};
    return sli_pen_arc(pen, (sl_point){a, b}, (sl_point){a, 0}, (sl_point){0, b}, full_turn,
                       pen->at);
}

uint64_t sli_tiled_shape_walls(const sli_pen *pen, const sli_tiled_shape *shape) {
    if (shape->kind == SLI_TILED_RECTANGLE) return 4;
    if (shape->kind == SLI_TILED_ELLIPSE) return pen->tolerance > 0 ? 4 : 32;
    if (shape->kind != SLI_TILED_POLYGON && shape->kind != SLI_TILED_POLYLINE) return 0;
    uint64_t points = json_array_size(shape->points.value);
    const char *text = json_string_value(shape->points.value);
    for (; text && *(text += strspn(text, " \t\r\n")); points++) text += strcspn(text, " \t\r\n");
    return points && shape->kind == SLI_TILED_POLYLINE ? points - 1 : points;
}

sl_status sli_tiled_draw_shape(sli_pen *pen, const sli_tiled_shape *shape) {
    const sli_affine outer = pen->affine;
    sli_affine turn = shape->turn;
    turn.x0 = shape->x;
    turn.y0 = shape->y;
    pen->affine = sli_affine_after(outer, turn);
    pen->line = shape->line;
    sl_status status = SL_OK;
    switch (shape->kind) {
    case SLI_TILED_RECTANGLE:
        status = draw_box(pen, shape->width, 0, shape->height);
        break;
    case SLI_TILED_PICTURE:
        status = draw_box(pen, shape->width, -shape->height, 0);
        break;
    case SLI_TILED_ELLIPSE:
        status = draw_ellipse(pen, shape->width, shape->height);
        break;
    case SLI_TILED_POLYGON:
    case SLI_TILED_POLYLINE:
        status = draw_points(pen, shape);
        break;
    case SLI_TILED_OTHER:
        break;
    }
    pen->affine = outer;
    return status;
}
