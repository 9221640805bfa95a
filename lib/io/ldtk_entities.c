/// Entities of LDtk's levels: starts and doors, and walls that are drawn as boxes by hand.
#include "io/ldtk.h"

#include <math.h>
#include <stdlib.h>
#include <strings.h>

/// Two numbers of an array, where it is there.
static sl_status read_pair(const sli_json *pair, sl_point *out) {
    if (!pair->value) return SL_OK;
    const sli_json x = sli_json_item(pair, 0), y = sli_json_item(pair, 1);
    SL_TRY(sli_json_number(&x, &out->x));
    return sli_json_number(&y, &out->y);
}

/// The heading, if the field names one: clockwise degrees, or a direction on the screen.
static void find_heading(const char *field, const sli_json *value, double *heading) {
    static const char *const fields[] = {"angle", "rotation", "heading", "facing", "direction"};
    static const struct {
        const char *name;
        double heading;
    } words[] = {{"right", 0},  {"east", 0},   {"up", 90},    {"north", 90},
                 {"left", 180}, {"west", 180}, {"down", 270}, {"south", 270}};
    bool known = false;
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        known |= strcasecmp(field, fields[i]) == 0;
    const char *text = json_string_value(value->value);
    if (!known) return;
    if (json_is_number(value->value)) *heading = sli_heading_of(json_number_value(value->value));
    for (size_t i = 0; text && i < sizeof words / sizeof *words; i++)
        if (strcasecmp(text, words[i].name) == 0) *heading = words[i].heading;
}

/// What a field `lockedWith` names is a key: the door is shut. No value, no lock.
static bool names_key(const char *field, const sli_json *value) {
    const char *text = json_string_value(value->value);
    return strcasecmp(field, "lockedWith") == 0 &&
           ((text && *text) || json_object_size(value->value) || json_array_size(value->value));
}

/// `own` becomes the text of the field "name", if there is one.
static void read_fields(const sli_json *entity, sli_says *says, double *heading, const char **own) {
    const sli_json fields = sli_json_member(entity, "fieldInstances");
    for (size_t i = 0; i < json_array_size(fields.value); i++) {
        const sli_json field = sli_json_item(&fields, i);
        const sli_json value = sli_json_member(&field, "__value");
        const char *name = sli_json_text_of(&field, "__identifier");
        const char *text = json_string_value(value.value);
        if (json_is_boolean(value.value)) sli_says_add(says, name, json_is_true(value.value));
        if (text) sli_says_add_text(says, name, text);
        if (names_key(name, &value)) sli_says_add(says, "locked", true);
        if (text && *text && strcasecmp(name, "name") == 0) *own = text;
        find_heading(name, &value, heading);
    }
}

/// The number of that index in a member; 0 without one.
static double number_in(const sli_json *entity, const char *key, size_t index) {
    const sli_json pair = sli_json_member(entity, key), number = sli_json_item(&pair, index);
    return sli_json_number_or_0(&number);
}

/// An entity's box. Its pivot is at its place "px". What is wrong with it loses nobody's file: it
/// counts as 0.
static sl_box box_of_entity(const sli_json *entity, sl_point corner) {
    const sli_json width = sli_json_member(entity, "width");
    const sli_json height = sli_json_member(entity, "height");
    const sl_point size = {sli_json_number_or_0(&width), sli_json_number_or_0(&height)};
    const sl_point at = {
        corner.x + number_in(entity, "px", 0) - number_in(entity, "__pivot", 0) * size.x,
        corner.y + number_in(entity, "px", 1) - number_in(entity, "__pivot", 1) * size.y};
    return (sl_box){at, {at.x + size.x, at.y + size.y}};
}

/// Keeps the middle of an entity that is neither a start nor a door.
static sl_status keep_other(sli_ldtk *reader, const sl_box *box, double step) {
    SL_TRY(SL_ARRAY_ROOM(reader->context, &reader->others, 1));
    reader->others.items[reader->others.count++] = (sli_ldtk_other){
        .middle = {(box->min.x + box->max.x) / 2, (box->min.y + box->max.y) / 2},
        .small = box->max.x - box->min.x <= 2 * step && box->max.y - box->min.y <= 2 * step};
    return SL_OK;
}

/// Whether an entity of this name may be a wall beside no firmer one: "PearlWall", but no torch on
/// a wall.
static bool says_likely_wall(const char *name) {
    return sli_game_kind_of(name) == SLI_GAME_LIKELY && sli_mentions_solid(name) &&
           !sli_game_says_other(name);
}

/// Boxes that may be walls are none beside firmer ones: a note names them.
static void drop_walls(sli_ldtk *reader) {
    if (reader->walls.count) sli_things_leave(&reader->things, reader->mark);
    reader->entities += reader->walls.count;
    reader->walls.count = reader->marks = 0;
    reader->wall_sized = reader->walls_likely = false;
    *reader->mark = '\0';
}

/// Keeps the box of an entity that is named for a wall.
static sl_status keep_wall(sli_ldtk *reader, const char *name, const sl_box *box, double step) {
    const sl_point size = {box->max.x - box->min.x, box->max.y - box->min.y};
    const bool likely = says_likely_wall(name) && !sli_game_says_stops(name);
    if (!(size.x > 0 && size.y > 0)) return SL_OK;
    if (reader->walls_likely && !likely) drop_walls(reader);
    if (!reader->walls.count) reader->walls_likely = likely;
    if (likely && !reader->walls_likely) {
        sli_things_leave(&reader->things, name);
        return SL_OK;
    }
    if (!*reader->mark) snprintf(reader->mark, sizeof reader->mark, "%s", name);
    reader->marks += strncmp(reader->mark, name, sizeof reader->mark - 1) == 0;
    SL_TRY(SL_ARRAY_ROOM(reader->context, &reader->walls, 1));
    reader->walls.items[reader->walls.count++] = *box;
    reader->wall_step = step;
    reader->wall_sized |= size.x > step || size.y > step;
    reader->entities--;
    return SL_OK;
}

/// Adds an entity that is a start or a door; keeps the place of any other.
static sl_status read_entity(sli_ldtk *reader, const sli_json *entity, sl_point corner, double step,
                             sli_ldtk_walls walls) {
    const char *name = sli_json_text_of(entity, "__identifier");
    sli_says says = sli_says_of(name, NULL);
    const char *own = name;
    double heading = 0;
    read_fields(entity, &says, &heading, &own);
    if (says.kind == SLI_THING_DOOR && own != name) says.name = own;
    SL_TRY(sli_things_ask(&reader->things, name, NULL, &says));
    const sl_box box = box_of_entity(entity, corner);
    sli_word numbers;
    const bool stops = walls == SLI_LDTK_ASKED
                           ? sli_layers_ask(reader->options->layers, name, &numbers)
                           : sli_game_says_stops(name);
    const bool named = walls == SLI_LDTK_NAMED &&
                       (sli_game_kind_of(name) == SLI_GAME_SOLID || says_likely_wall(name));
    reader->walls_named |= !says.kind && named && !stops;
    if (!says.kind && (named || stops)) return keep_wall(reader, name, &box, step);
    if (!says.kind) {
        sli_things_leave(&reader->things, name);
        return keep_other(reader, &box, step);
    }
    const sli_json px = sli_json_member(entity, "px"), pivot = sli_json_member(entity, "__pivot");
    const sli_json width = sli_json_member(entity, "width");
    const sli_json height = sli_json_member(entity, "height");
    sl_point at = {0}, part = {0}, size = {step, step};
    if (!px.value) return sli_json_fail(&px, "expected two numbers, found nothing");
    SL_TRY(read_pair(&px, &at));
    SL_TRY(read_pair(&pivot, &part));
    SL_TRY(sli_json_number_if(&width, &size.x));
    SL_TRY(sli_json_number_if(&height, &size.y));
    reader->entities--;
    const sli_thing thing = {.kind = says.kind,
                             .middle = {corner.x + at.x + (0.5 - part.x) * size.x,
                                        corner.y + at.y + (0.5 - part.y) * size.y},
                             .u = {size.x / 2, 0},
                             .v = {0, size.y / 2},
                             .open = says.state != SLI_DOOR_SHUT,
                             .heading = heading};
    return sli_things_add(&reader->things, says.name, thing);
}

sl_status sli_ldtk_read_entities(sli_ldtk *reader, const sli_json *layer, sli_ldtk_place at,
                                 sli_ldtk_walls walls) {
    const sli_json entities = sli_json_member(layer, "entityInstances");
    const sli_json x = sli_json_member(layer, "__pxTotalOffsetX");
    const sli_json y = sli_json_member(layer, "__pxTotalOffsetY");
    const sli_json size = sli_json_member(layer, "__gridSize");
    const size_t count = json_array_size(entities.value);
    sl_point corner = {0};
    int64_t step = 0;
    if (!count) return SL_OK;
    SL_TRY(sli_json_number_if(&x, &corner.x));
    SL_TRY(sli_json_number_if(&y, &corner.y));
    SL_TRY(sli_json_whole_if(&size, 1, SLI_LDTK_MOST_PIXELS, &step));
    corner = (sl_point){at.x + corner.x, at.y + corner.y};
    reader->entities += count;
    for (size_t i = 0; i < count; i++) {
        const sli_json entity = sli_json_item(&entities, i);
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(reader->context));
        SL_TRY(read_entity(reader, &entity, corner, (double)step, walls));
    }
    return SL_OK;
}

/// A level's squares are open. They have the size of its cells, so that levels side by side join.
static sl_status add_open(sli_ldtk *reader, const sl_box *page) {
    const sl_point size = {page->max.x - page->min.x, page->max.y - page->min.y};
    const double step = reader->wall_step;
    const bool fits = step > 0 && fmod(size.x, step) == 0 && fmod(size.y, step) == 0;
    const double columns = fits ? size.x / step : 1, rows = fits ? size.y / step : 1;
    char *squares;
    SL_TRY(sli_tiles_check(reader->context, &reader->tiles, reader->name, 0, "a level",
                           (uint64_t)columns, (uint64_t)rows));
    return sli_tiles_add(reader->context, &reader->tiles, reader->name, page->min,
                         (sl_point){size.x / columns, size.y / rows}, (size_t)columns, (size_t)rows,
                         &squares);
}

/// Whether a box is in a level, or partly so.
static bool is_in_level(const sli_ldtk *reader, const sl_box *box) {
    for (size_t i = 0; i < reader->pages.count; i++) {
        const sl_box *page = &reader->pages.items[i];
        if (box->min.x < page->max.x && box->max.x > page->min.x && box->min.y < page->max.y &&
            box->max.y > page->min.y)
            return true;
    }
    return false;
}

static int compare_boxes(const void *left, const void *right) {
    const sl_box *a = left, *b = right;
    if (a->min.y != b->min.y) return a->min.y < b->min.y ? -1 : 1;
    return (a->min.x > b->min.x) - (a->min.x < b->min.x);
}

/// Whether a box begins at a place.
static bool begins_at(const sli_ldtk *reader, double x, double y) {
    const sl_box at = {.min = {x, y}};
    return bsearch(&at, reader->walls.items, reader->walls.count, sizeof at, compare_boxes) != NULL;
}

/// Whether there are many boxes and most of them lie side by side, as walls do. Sorts them.
static bool lie_in_rows(sli_ldtk *reader) {
    enum { LEAST = 8 };
    const size_t count = reader->walls.count;
    size_t beside = 0;
    if (count < LEAST) return false;
    qsort(reader->walls.items, count, sizeof *reader->walls.items, compare_boxes);
    for (size_t i = 0; i < count; i++) {
        const sl_box *own = &reader->walls.items[i];
        const double width = own->max.x - own->min.x, height = own->max.y - own->min.y;
        beside += begins_at(reader, own->max.x, own->min.y) ||
                  begins_at(reader, own->min.x - width, own->min.y) ||
                  begins_at(reader, own->min.x, own->max.y) ||
                  begins_at(reader, own->min.x, own->min.y - height);
    }
    return 2 * beside > count;
}

/// Fewer walls that are one cell large are blocks to be pushed, or the like.
enum { LEAST_MARKS = 8 };

sl_status sli_ldtk_settle_walls(sli_ldtk *reader) {
    const bool asked = reader->options->layers != NULL;
    const bool others = reader->layers || reader->tile_layers || reader->void_is_solid;
    size_t kept = 0;
    for (size_t i = 0; i < reader->walls.count; i++)
        if (is_in_level(reader, &reader->walls.items[i]))
            reader->walls.items[kept++] = reader->walls.items[i];
    reader->entities += reader->walls.count - kept;
    reader->walls.count = kept;
    // Walls that are all one cell large, here and there, are marks, of which a field may say more.
    const bool marks = !asked && !reader->wall_sized && !(!others && lie_in_rows(reader));
    if (!marks || others || reader->marks < LEAST_MARKS) reader->marks = 0;
    if (marks || (!asked && others && reader->walls_named)) {
        reader->entities += reader->walls.count;
        reader->walls.count = 0;
    }
    for (size_t i = 0; !others && reader->walls.count && i < reader->pages.count; i++)
        SL_TRY(add_open(reader, &reader->pages.items[i]));
    return SL_OK;
}

sl_status sli_ldtk_add_walls(const sli_ldtk *reader, sl_map *map) {
    for (size_t i = 0; i < reader->walls.count; i++) {
        const sl_box *box = &reader->walls.items[i];
        const double low = reader->bottom - box->max.y, high = reader->bottom - box->min.y;
        const sl_point corners[] = {
            {box->min.x, low}, {box->max.x, low}, {box->max.x, high}, {box->min.x, high}};
        SL_TRY(sl_map_add_solid(reader->context, map, corners, 4, 0));
    }
    return SL_OK;
}
