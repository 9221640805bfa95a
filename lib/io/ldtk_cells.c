/// What the values of LDtk's cells mean by their names, and tiles by the enums of their tileset.
///
/// Firm words (wall, solid, collision) decide, if a layer has any: its other values are open, but
/// for rock and the like. Without such words all values are solid but those that one passes
/// (ladder, door), and water stops steps. Grass, sand and floors are the ground: it is open in a
/// map seen from above and solid in a platformer, which is found out once all cells and starts are
/// read.
#include "io/ldtk.h"

static bool is_firm(sli_game_kind kind, const char *name) {
    return kind == SLI_GAME_SOLID || (kind == SLI_GAME_LIKELY && sli_mentions_solid(name));
}

bool sli_ldtk_any_solid(const sli_json *values) {
    for (size_t i = 0; i < json_array_size(values->value); i++) {
        const sli_json value = sli_json_item(values, i);
        const char *name = sli_json_text_of(&value, "identifier");
        if (is_firm(sli_game_kind_of(name), name)) return true;
    }
    return false;
}

/// One passes through a thin platform, and stands on it.
static bool says_through(const char *name) {
    for (sli_name_word word; sli_word_next(&name, &word);)
        if (strstr(word.text, "through")) return true;
    return false;
}

static bool says_ceiling(const char *name) {
    for (sli_name_word word; sli_word_next(&name, &word);)
        if (strcmp(word.text, "ceiling") == 0) return true;
    return false;
}

bool sli_ldtk_any_ceiling(const sli_json *values) {
    for (size_t i = 0; i < json_array_size(values->value); i++) {
        const sli_json value = sli_json_item(values, i);
        if (says_ceiling(sli_json_text_of(&value, "identifier"))) return true;
    }
    return false;
}

bool sli_ldtk_any_platform(const sli_json *values) {
    static const char *const words[] = {"platform", "ladder", "slope"};
    for (size_t i = 0; i < json_array_size(values->value); i++) {
        const sli_json value = sli_json_item(values, i);
        const char *name = sli_json_text_of(&value, "identifier");
        for (sli_name_word word; sli_word_next(&name, &word);)
            if (sli_word_in(&word, words, sizeof words / sizeof *words)) return true;
    }
    return false;
}

bool sli_ldtk_only_walkable(const sli_json *values) {
    bool any = false;
    for (size_t i = 0; i < json_array_size(values->value); i++) {
        const sli_json value = sli_json_item(values, i);
        const char *name = sli_json_text_of(&value, "identifier");
        if (!sli_says_walkable(name) || says_through(name)) return false;
        any = true;
    }
    return any;
}

/// The square of a value of this name in a layer, where no numbers are asked for.
static char square_of(const sli_ldtk_layer *layer, const char *name) {
    const sli_game_kind kind = sli_game_kind_of(name);
    if (kind == SLI_GAME_WATER) return '~';
    if (says_ceiling(name)) return '#';
    if (layer->ceiling && kind == SLI_GAME_GROUND) return SLI_LDTK_GROUND;
    if (kind >= SLI_GAME_STANDS &&
        !(layer->by_name && kind == SLI_GAME_LIKELY && !is_firm(kind, name)))
        return layer->by_name && kind == SLI_GAME_STANDS ? SLI_LDTK_STANDS : '#';
    if (kind == SLI_GAME_PASS || kind == SLI_GAME_DRAWN) return '.';
    if (layer->by_name)
        return kind == SLI_GAME_GROUND || kind == SLI_GAME_FLOOR ? SLI_LDTK_BESIDE : '.';
    if (layer->kind == SLI_GAME_WATER) return '~';
    if (kind == SLI_GAME_UNSAID || layer->kind == SLI_GAME_SOLID) return '#';
    return SLI_LDTK_GROUND;
}

static void tell(sli_ldtk_told *told, char square, const char *name, int64_t value) {
    sli_name_list *list = square == '#'               ? &told->solid
                          : square == SLI_LDTK_STANDS ? &told->stands
                          : square == '~'             ? &told->water
                          : square == SLI_LDTK_GROUND ? &told->ground
                          : square == SLI_LDTK_BESIDE ? &told->beside
                                                      : &told->open;
    const bool floor = sli_game_kind_of(name) == SLI_GAME_FLOOR;
    told->floor |= square == SLI_LDTK_GROUND && floor;
    told->earth |= square == SLI_LDTK_GROUND && !floor;
    char text[80];
    snprintf(text, sizeof text, "%s%s%lld%s", sli_show((sli_word){name, strlen(name)}).text,
             *name ? " (" : "", (long long)value, *name ? ")" : "");
    told->named |= *name != '\0';
    char wanted[90];
    snprintf(wanted, sizeof wanted, "%s,", text);
    const char *there = strstr(list->text, text);
    const bool known = there && (there == list->text || there[-1] == ' ') &&
                       (!there[strlen(text)] || strncmp(there, wanted, strlen(wanted)) == 0);
    if (known) return;
    sli_name_list_add(list, (sli_word){text, strlen(text)});
    char *numbers = square == '#' ? told->numbers : told->others;
    const size_t used = strlen(numbers);
    // A number that does not fit is left out.
    const int length = snprintf(text, sizeof text, "%s%lld", used ? "+" : "", (long long)value);
    if (used + (size_t)length < sizeof told->numbers)
        memcpy(numbers + used, text, (size_t)length + 1);
}

sli_ldtk_cell sli_ldtk_meaning(const sli_json *values, const sli_ldtk_layer *layer, int64_t value,
                               sli_ldtk_told *told) {
    const char *name = "";
    for (size_t i = 0; i < json_array_size(values->value); i++) {
        const sli_json item = sli_json_item(values, i), number = sli_json_member(&item, "value");
        if (!json_is_integer(number.value) || json_integer_value(number.value) != value) continue;
        name = sli_json_text_of(&item, "identifier");
        break;
    }
    sli_ldtk_cell cell = {.square = square_of(layer, name), .says = sli_says_of(name, NULL)};
    cell.bare =
        cell.square == '#' && !*name && !layer->numbers.length && layer->kind != SLI_GAME_SOLID;
    if (!value) name = "empty";
    if (!value) cell.square = layer->only_walkable ? '#' : '.';
    if (layer->numbers.length)
        cell.square = sli_numbers_have(layer->numbers, (uint64_t)value) ? '#' : '.';
    // A door is solid until a passage is found for it.
    else if (cell.says.kind == SLI_THING_DOOR && !layer->by_name)
        cell.square = '#';
    tell(told, cell.square, name, value);
    return cell;
}

// --- tiles

static char square_of_name(const char *name) {
    const sli_game_kind kind = sli_game_kind_of(name);
    return kind == SLI_GAME_WATER ? '~' : is_firm(kind, name) ? '#' : 0;
}

static bool has_number(const sli_json *list, int64_t number) {
    for (size_t i = 0; i < json_array_size(list->value); i++)
        if (json_integer_value(json_array_get(list->value, i)) == number) return true;
    return false;
}

/// The text of a tile: a list of words, or JSON: {"solid": true}.
static char square_of_text(const char *text) {
    if (strstr(text, "false")) return 0;
    return sli_mentions_solid(text) ? '#' : 0;
}

char sli_ldtk_tile(const sli_json *tileset, int64_t tile) {
    const sli_json tags = sli_json_member(tileset, "enumTags");
    const sli_json texts = sli_json_member(tileset, "customData");
    char square = 0;
    for (size_t i = 0; i < json_array_size(tags.value) && square != '#'; i++) {
        const sli_json tag = sli_json_item(&tags, i), ids = sli_json_member(&tag, "tileIds");
        const char own = square_of_name(sli_json_text_of(&tag, "enumValueId"));
        if (own && has_number(&ids, tile)) square = own;
    }
    for (size_t i = 0; i < json_array_size(texts.value) && !square; i++) {
        const sli_json text = sli_json_item(&texts, i), id = sli_json_member(&text, "tileId");
        if (json_is_integer(id.value) && json_integer_value(id.value) == tile)
            square = square_of_text(sli_json_text_of(&text, "data"));
    }
    return square;
}

// --- ground

/// The square of a block at a place, or 0 outside.
static char square_at(const sli_tile_block *block, sl_point at) {
    const double x = (at.x - block->corner.x) / block->step.x;
    const double y = (at.y - block->corner.y) / block->step.y;
    if (!(x >= 0 && y >= 0 && x < (double)block->columns && y < (double)block->rows)) return 0;
    return block->squares[(size_t)y * block->columns + (size_t)x];
}

/// How many stand on ground, and on what is empty.
typedef struct votes {
    size_t ground, beside, stands, empty;
} votes;

static bool is_open(char square) {
    return square == '.' || square == SLI_LDTK_PASS;
}

static void vote(votes *of, const sli_tile_block *block, sl_point at) {
    const char square = square_at(block, at);
    of->ground += square == SLI_LDTK_GROUND;
    of->beside += square == SLI_LDTK_BESIDE;
    of->stands += square == SLI_LDTK_STANDS;
    of->empty += is_open(square);
}

/// Puts what was found out into all squares.
static void settle(const sli_ldtk *reader, const sli_ldtk_settled *as) {
    for (size_t i = 0; i < reader->tiles.blocks.count; i++) {
        const sli_tile_block *block = &reader->tiles.blocks.items[i];
        const size_t count = block->columns * block->rows;
        const bool ground = memchr(block->squares, SLI_LDTK_GROUND, count) != NULL;
        for (size_t k = 0; k < count; k++) {
            char *square = &block->squares[k];
            if (*square == '.' && ground && as->bare_solid) *square = '#';
            if (*square == SLI_LDTK_GROUND) *square = as->ground_solid ? '#' : '.';
            if (*square == SLI_LDTK_BESIDE) *square = as->beside_solid ? '#' : '.';
            if (*square == SLI_LDTK_STANDS) *square = as->stands_open ? '.' : '#';
            if (*square == SLI_LDTK_PASS) *square = '.';
        }
    }
}

/// Whether one stands on a value without a name, with all cells around of the same value: in a
/// platformer a start may have sunk into the ground.
static bool is_on_bare(const sli_tile_block *block, sl_point at) {
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++)
            if (square_at(block, (sl_point){at.x + x * block->step.x, at.y + y * block->step.y}) !=
                SLI_LDTK_BARE)
                return false;
    return true;
}

/// Decides whether the value without a name that a block has is floor: empty cells are solid then.
static bool settle_bare(const sli_ldtk *reader, const sli_tile_block *block) {
    const size_t count = block->columns * block->rows;
    size_t on = 0, off = 0;
    if (!memchr(block->squares, SLI_LDTK_BARE, count)) return false;
    for (size_t i = 0; i < reader->things.items.count; i++) {
        const sli_thing *thing = &reader->things.items.items[i];
        if (thing->kind != SLI_THING_START || !square_at(block, thing->middle)) continue;
        if (is_on_bare(block, thing->middle))
            on++;
        else
            off++;
    }
    const bool open = on && !off;
    for (size_t i = 0; i < count; i++)
        block->squares[i] = (block->squares[i] == SLI_LDTK_BARE) != open ? '#' : '.';
    return open;
}

/// The places where ground, water and the like lie beside empty cells, and beside walls.
typedef struct ends {
    size_t empty, walls;
} ends;

static void add_ends(ends *all, char one, char other) {
    const bool floor = one == SLI_LDTK_GROUND || one == '~' || one == SLI_LDTK_PASS;
    all->empty += floor && other == '.';
    all->walls += floor && other == '#';
}

/// Whether ground ends at empty cells nearly everywhere: these lie beyond it.
static bool ends_at_empty(const sli_ldtk *reader) {
    ends all = {0};
    for (size_t i = 0; i < reader->tiles.blocks.count; i++) {
        const sli_tile_block *block = &reader->tiles.blocks.items[i];
        const size_t count = block->columns * block->rows;
        if (!memchr(block->squares, SLI_LDTK_GROUND, count)) continue;
        for (size_t k = 0; k < count; k++) {
            const char *at = &block->squares[k];
            if ((k + 1) % block->columns) {
                add_ends(&all, at[0], at[1]);
                add_ends(&all, at[1], at[0]);
            }
            if (k + block->columns < count) {
                add_ends(&all, at[0], at[block->columns]);
                add_ends(&all, at[block->columns], at[0]);
            }
        }
    }
    return all.empty && 4 * all.walls <= all.empty;
}

/// Whether ground beside values that are named for walls is solid: no cell is a wall, and starts
/// stand on empty cells and not on the ground.
static bool is_beside_solid(const sli_ldtk *reader) {
    votes starts = {0};
    bool ground = false;
    for (size_t i = 0; i < reader->tiles.blocks.count; i++) {
        const sli_tile_block *block = &reader->tiles.blocks.items[i];
        const size_t count = block->columns * block->rows;
        if (memchr(block->squares, '#', count)) return false;
        if (!memchr(block->squares, SLI_LDTK_BESIDE, count)) continue;
        ground = true;
        for (size_t k = 0; k < reader->things.items.count; k++)
            if (reader->things.items.items[k].kind == SLI_THING_START)
                vote(&starts, block, reader->things.items.items[k].middle);
    }
    return ground && starts.empty && !starts.beside;
}

void sli_ldtk_settle_ground(sli_ldtk *reader, sli_ldtk_settled *out) {
    size_t ground = 0, stands = 0, empty = 0, all = 0;
    votes starts = {0}, others = {0};
    for (size_t i = 0; i < reader->tiles.blocks.count; i++) {
        const sli_tile_block *block = &reader->tiles.blocks.items[i];
        const size_t count = block->columns * block->rows;
        if (!memchr(block->squares, SLI_LDTK_GROUND, count) &&
            !memchr(block->squares, SLI_LDTK_STANDS, count))
            continue;
        for (size_t k = 0; k < count; k++) {
            ground += block->squares[k] == SLI_LDTK_GROUND;
            stands += block->squares[k] == SLI_LDTK_STANDS;
            empty += is_open(block->squares[k]);
        }
        all += count;
        for (size_t k = 0; k < reader->things.items.count; k++)
            if (reader->things.items.items[k].kind == SLI_THING_START)
                vote(&starts, block, reader->things.items.items[k].middle);
        for (size_t k = 0; k < reader->others.count; k++)
            vote(&others, block, reader->others.items[k].middle);
    }
    *out = (sli_ldtk_settled){0};
    if (ground) {
        const bool told = starts.ground != starts.empty;
        const bool stood_on = others.ground >= 2 && others.ground >= 2 * others.empty;
        const bool air = 5 * empty >= 2 * all || (10 * empty > all && reader->side_view);
        out->ground_solid = told ? starts.empty > starts.ground : !stood_on && air;
        out->unsure = !told && !stood_on && !out->ground_solid && 10 * empty > all;
        out->bare = out->ground_solid ? 0 : (double)empty / (double)all;
        out->bare_solid = !out->ground_solid && starts.ground && !starts.empty &&
                          reader->told.floor && !reader->told.earth && ends_at_empty(reader);
    }
    out->beside_solid = is_beside_solid(reader);
    if (stands)
        out->stands_open = starts.stands || starts.empty
                               ? starts.stands > starts.empty
                               : others.stands >= 3 && others.stands >= 2 * others.empty;
    settle(reader, out);
    for (size_t i = 0; i < reader->tiles.blocks.count; i++)
        out->bare_open |= settle_bare(reader, &reader->tiles.blocks.items[i]);
}
