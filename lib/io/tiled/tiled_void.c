/// Squares of Tiled's maps that have no tile at all: around rooms that are drawn floor by floor
/// they are what nobody enters, and in a platformer they are the air. The file does not say which,
/// so they are open; where floor leads to them it is told, and `--layers void` makes them solid.
///
/// In a map without a start, those that lie at its edge are solid where walls part them from floor,
/// at nine of ten places at least: else they would be taken for a room. Squares without a tile
/// among rooms have no say in this. The sea about an island is like them: squares that have nothing
/// but a tile of a layer that is named for water and covers half of the map.
///
/// Where starts stand on squares without a tile, and none on floor, they are open.
#include "geometry/orient.h"
#include "io/tiled/tiled.h"

#include <math.h>
#include <string.h>

/// What is looked at: maps of more squares are left alone.
enum { MOST = 1 << 24, PAIRS = 4096 };

/// Where floor is drawn as areas, few of its squares end at squares without a tile: in a platformer
/// most do.
enum { FLOOR_PER_END = 4 };

typedef struct field {
    sli_tiled_reader *reader;
    sli_tiled_range range; ///< of all tiles
    bool pictures;         ///< there is a layer that is a picture
    size_t columns, rows;
    size_t drawn;  ///< squares of floor that have nothing but tiles of pictures
    char *squares; ///< ' ' without a tile, '.' with one, '+' of these under a door, '~' of water
                   ///< alone, ',' of pictures alone while layers are read, '#' solid; of those at
                   ///< the edge 'v' without a tile, 'w' of water; NULL while the range is looked
                   ///< for
} field;

bool sli_tiled_only_void(const char *layers) {
    bool any = false, only = true;
    for (sli_word word; layers && sli_layers_next(&layers, &word); any = true)
        only &= sli_word_is(word, "void");
    return any && only;
}

static void take_gids(field *f, const sli_tiled_range *at, const uint32_t *gids,
                      sli_game_kind kind) {
    bool water = kind == SLI_GAME_WATER;
    const size_t width = (size_t)(at->right - at->left);
    const size_t all = width * (size_t)(at->bottom - at->top);
    size_t count = 0;
    for (size_t i = 0; i < all && water; i++) count += (gids[i] & SLI_TILED_TILE) != 0;
    water &= 2 * count >= all;
    for (int64_t y = at->top; y < at->bottom; y++)
        for (int64_t x = at->left; x < at->right; x++) {
            const size_t i = (size_t)(y - at->top) * width + (size_t)(x - at->left);
            if (!(gids[i] & SLI_TILED_TILE)) continue;
            char *to =
                &f->squares[(size_t)(y - f->range.top) * f->columns + (size_t)(x - f->range.left)];
            if (kind == SLI_GAME_DRAWN)
                *to = *to == ' ' || *to == ',' ? ',' : '.';
            else
                *to = !water ? '.' : *to == ' ' ? '~' : *to;
        }
}

static void widen(sli_tiled_range *all, const sli_tiled_range *more) {
    if (all->left == all->right) *all = *more;
    if (more->left < all->left) all->left = more->left;
    if (more->top < all->top) all->top = more->top;
    if (more->right > all->right) all->right = more->right;
    if (more->bottom > all->bottom) all->bottom = more->bottom;
}

/// A layer's tiles, or those of a chunk.
static sl_status look_at_block(field *f, const sli_json *layer, const sli_json *holder,
                               sl_point offset) {
    const sli_json size[] = {sli_json_member(holder, "width"), sli_json_member(holder, "height")};
    const sli_json data = sli_json_member(holder, "data");
    const sli_json x = sli_json_member(holder, "x"), y = sli_json_member(holder, "y");
    int64_t columns, rows, column = 0, row = 0;
    SL_TRY(sli_json_whole(&size[0], 1, MOST, &columns));
    SL_TRY(sli_json_whole(&size[1], 1, MOST, &rows));
    if (holder != layer) {
        SL_TRY(sli_json_whole(&x, INT32_MIN, INT32_MAX, &column));
        SL_TRY(sli_json_whole(&y, INT32_MIN, INT32_MAX, &row));
    }
    column += (int64_t)offset.x;
    row += (int64_t)offset.y;
    const sli_tiled_range at = {column, row, column + columns, row + rows};
    if (!f->squares) {
        widen(&f->range, &at);
        return SL_OK;
    }
    uint32_t *gids;
    SL_TRY(sli_tiled_read_data(layer, &data, (size_t)(columns * rows), &gids));
    take_gids(f, &at, gids, sli_game_kind_of(sli_json_text_of(layer, "name")));
    sl_free(f->reader->context, gids);
    return SL_OK;
}

/// How far a layer is moved, in whole squares, with its group's move.
static sl_point move_of(const field *f, const sli_json *layer, sl_point outer) {
    const sli_json x = sli_json_member(layer, "offsetx"), y = sli_json_member(layer, "offsety");
    const sli_tiled_lattice *lattice = &f->reader->lattice;
    if (lattice->orientation != SLI_TILED_ORTHOGONAL) return outer;
    const double right = rint(sli_json_number_or_0(&x) / lattice->tile.x);
    const double down = rint(sli_json_number_or_0(&y) / lattice->tile.y);
    if (!(fabs(right) < MOST && fabs(down) < MOST)) return outer;
    return (sl_point){outer.x + right, outer.y + down};
}

static sl_status look_at_layers(field *f, const sli_json *parent, sl_point outer) {
    const sli_json layers = sli_json_member(parent, "layers");
    for (size_t i = 0; i < json_array_size(layers.value); i++) {
        const sli_json layer = sli_json_item(&layers, i);
        const sli_json chunks = sli_json_member(&layer, "chunks");
        const sli_json data = sli_json_member(&layer, "data");
        const char *type = sli_json_text_of(&layer, "type");
        const sl_point offset = move_of(f, &layer, outer);
        f->pictures |= strcmp(type, "imagelayer") == 0;
        if (strcmp(type, "group") == 0) SL_TRY(look_at_layers(f, &layer, offset));
        if (strcmp(type, "tilelayer") != 0) continue;
        for (size_t k = 0; k < json_array_size(chunks.value); k++) {
            const sli_json chunk = sli_json_item(&chunks, k);
            SL_TRY(look_at_block(f, &layer, &chunk, offset));
        }
        if (!chunks.value && data.value) SL_TRY(look_at_block(f, &layer, &layer, offset));
        SL_TRY(sl_check_cancelled(f->reader->context));
    }
    return SL_OK;
}

/// Puts in what is solid.
static void take_solid(field *f) {
    const sli_tiles *tiles = &f->reader->tiles;
    for (size_t i = 0; i < tiles->blocks.count; i++) {
        const sli_tile_block *block = &tiles->blocks.items[i];
        const double left = rint(block->corner.x / block->step.x) - (double)f->range.left;
        const double top = rint(block->corner.y / block->step.y) - (double)f->range.top;
        for (size_t k = 0; k < block->columns * block->rows; k++) {
            const double x = left + (double)(k % block->columns);
            const double y = top + (double)(k / block->columns);
            if (block->squares[k] != '#') continue;
            if (x >= 0 && y >= 0 && x < (double)f->columns && y < (double)f->rows)
                f->squares[(size_t)y * f->columns + (size_t)x] = '#';
        }
    }
}

static sl_point middle_of(const field *f, size_t i) {
    const sl_point step = f->reader->lattice.step;
    const double x = (double)f->range.left + (double)(i % f->columns) + 0.5;
    const double y = (double)f->range.top + (double)(i / f->columns) + 0.5;
    return sli_affine_apply(f->reader->pen.affine, (sl_point){x * step.x, y * step.y});
}

/// The squares of the field that a box of the map reaches into.
static sli_tiled_range squares_of(const field *f, const sl_box *box) {
    const sl_point step = f->reader->lattice.step;
    const double columns = (double)f->columns, rows = (double)f->rows;
    const double left = floor(box->min.x / step.x) - (double)f->range.left;
    const double right = ceil(box->max.x / step.x) - (double)f->range.left;
    const double top = floor((f->reader->top - box->max.y) / step.y) - (double)f->range.top;
    const double bottom = ceil((f->reader->top - box->min.y) / step.y) - (double)f->range.top;
    return (sli_tiled_range){.left = (int64_t)fmin(fmax(left, 0), columns),
                             .top = (int64_t)fmin(fmax(top, 0), rows),
                             .right = (int64_t)fmin(fmax(right, 0), columns),
                             .bottom = (int64_t)fmin(fmax(bottom, 0), rows)};
}

/// Puts in the squares whose middles lie in solid objects, and those of tiles with solid shapes.
static sl_status take_closed(field *f) {
    const sli_tiled_reader *reader = f->reader;
    for (size_t i = 0; i < reader->closed.count; i++) {
        const sli_tiled_closed *closed = &reader->closed.items[i];
        const sli_tiled_range all = squares_of(f, &closed->box);
        SL_TRY(sl_check_cancelled(reader->context));
        if (!closed->solid) continue;
        for (int64_t y = all.top; y < all.bottom; y++)
            for (int64_t x = all.left; x < all.right; x++) {
                const size_t at = (size_t)y * f->columns + (size_t)x;
                if (closed->of_tile || sli_tiled_is_in(reader, closed, middle_of(f, at)))
                    f->squares[at] = '#';
            }
    }
    return SL_OK;
}

/// Marks the floor under doors.
static void take_doors(field *f) {
    const sli_tiled_reader *reader = f->reader;
    for (size_t i = 0; i < reader->things.items.count; i++) {
        const sli_thing *thing = &reader->things.items.items[i];
        sl_point at;
        const sl_box box = sli_tiled_box_of_thing(reader, thing, &at);
        const sli_tiled_range all = squares_of(f, &box);
        if (thing->kind != SLI_THING_DOOR) continue;
        for (int64_t row = all.top; row < all.bottom; row++)
            for (int64_t column = all.left; column < all.right; column++) {
                const size_t k = (size_t)row * f->columns + (size_t)column;
                if (f->squares[k] == '.' && sli_box_holds(&box, middle_of(f, k)))
                    f->squares[k] = '+';
            }
    }
}

static bool overlaps(double a, double b, double c, double d) {
    return fmax(a, b) >= fmin(c, d) && fmax(c, d) >= fmin(a, b);
}

/// Whether a wall of an object lies between the middles of two squares, or on one of them.
static bool is_between(const sl_map *map, sl_point a, sl_point b) {
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i];
        const sl_point c = wall->a, d = wall->b;
        if (overlaps(a.x, b.x, c.x, d.x) && overlaps(a.y, b.y, c.y, d.y) &&
            sli_orient(a, b, c) * sli_orient(a, b, d) <= 0 &&
            sli_orient(c, d, a) * sli_orient(c, d, b) <= 0)
            return true;
    }
    return false;
}

/// The places where squares of two sets lie side by side, and those of them where no wall of an
/// object lies between, and no door on the floor. So many places are looked at and no more.
typedef struct border {
    size_t all, open;
} border;

static border find_border(const field *f, const char *floor, const char *empty) {
    border found = {0};
    for (size_t i = 0; i < f->columns * f->rows && found.all < PAIRS; i++) {
        const bool ends = (i + 1) % f->columns == 0;
        const size_t beside[] = {ends ? i : i + 1, i + f->columns};
        for (int k = 0; k < 2; k++) {
            const size_t j = beside[k];
            if (j >= f->columns * f->rows) continue;
            const char one = f->squares[i], other = f->squares[j];
            const bool meets = (strchr(floor, one) && strchr(empty, other)) ||
                               (strchr(floor, other) && strchr(empty, one));
            const bool door = one == '+' || other == '+';
            if (!meets) continue;
            found.all++;
            found.open +=
                !door && !is_between(f->reader->pen.map, middle_of(f, i), middle_of(f, j));
        }
    }
    return found;
}

static bool is_void(char square) {
    return square == ' ' || square == '~';
}

static void mark(char *square) {
    *square = *square == ' ' ? 'v' : 'w';
}

/// Marks the squares without a tile, or of water, that are at the edge, and those that join them.
static sl_status mark_edge(field *f, size_t *marked) {
    const size_t count = f->columns * f->rows;
    size_t *stack = sl_alloc_array(f->reader->context, count, sizeof *stack), top = 0;
    if (!stack) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const size_t x = i % f->columns, y = i / f->columns;
        const bool edge = !x || !y || x + 1 == f->columns || y + 1 == f->rows;
        if (!edge || !is_void(f->squares[i])) continue;
        mark(&f->squares[i]);
        stack[top++] = i;
    }
    for (*marked = top; top;) {
        const size_t i = stack[--top], x = i % f->columns, y = i / f->columns;
        const size_t beside[] = {x ? i - 1 : i, x + 1 < f->columns ? i + 1 : i,
                                 y ? i - f->columns : i, y + 1 < f->rows ? i + f->columns : i};
        for (int k = 0; k < 4; k++) {
            if (!is_void(f->squares[beside[k]])) continue;
            mark(&f->squares[beside[k]]);
            stack[top++] = beside[k];
            ++*marked;
        }
    }
    sl_free(f->reader->context, stack);
    return SL_OK;
}

static bool has_start(const sli_tiled_reader *reader) {
    for (size_t i = 0; i < reader->things.items.count; i++)
        if (reader->things.items.items[i].kind == SLI_THING_START) return true;
    return false;
}

/// Whether starts stand on squares without a tile, and none on a floor.
static bool start_on_void(const field *f) {
    const sli_tiled_reader *reader = f->reader;
    const sl_point step = reader->lattice.step;
    size_t on_void = 0, on_floor = 0;
    for (size_t i = 0; i < reader->things.items.count; i++) {
        const sli_thing *thing = &reader->things.items.items[i];
        sl_point at;
        (void)sli_tiled_box_of_thing(reader, thing, &at);
        const double x = floor(at.x / step.x) - (double)f->range.left;
        const double y = floor((reader->top - at.y) / step.y) - (double)f->range.top;
        if (thing->kind != SLI_THING_START) continue;
        if (!(x >= 0 && y >= 0 && x < (double)f->columns && y < (double)f->rows)) continue;
        const char square = f->squares[(size_t)y * f->columns + (size_t)x];
        on_void += square == ' ';
        on_floor += square == '.' || square == '+';
    }
    return on_void && !on_floor;
}

/// Makes the squares of these marks solid.
static sl_status fill(field *f, const char *marks) {
    const sl_point step = f->reader->lattice.step;
    const sl_point corner = {(double)f->range.left * step.x, (double)f->range.top * step.y};
    char *squares;
    SL_TRY(sli_tiles_add(f->reader->context, &f->reader->tiles, f->reader->map->file->name, corner,
                         step, f->columns, f->rows, &squares));
    for (size_t i = 0; i < f->columns * f->rows; i++)
        if (strchr(marks, f->squares[i])) squares[i] = '#';
    return SL_OK;
}

enum { OPEN_TEXT = 800 };

/// A command that keeps squares without a tile open: with the layers that are solid.
static const char *write_open(const field *f, char text[OPEN_TEXT]) {
    char names[400];
    sli_tiled_list_taken(f->reader, names, sizeof names);
    snprintf(text, OPEN_TEXT,
             *names ? "sightline check '%.300s' --layers '%s' -o map.png"
                    : "draw a tile of floor there",
             f->reader->map->file->name, names);
    return text;
}

/// What walls part from floor, but for a place or two, and lies at the edge is no room: who draws
/// them means that one does not get there.
static sl_status fill_edge(field *f, bool *filled) {
    size_t marked;
    char open[64] = "", keep[OPEN_TEXT];
    SL_TRY(mark_edge(f, &marked));
    const border found = find_border(f, ".+", "vw");
    *filled = marked && 10 * found.open <= found.all && found.all < PAIRS;
    for (size_t i = 0; i < f->columns * f->rows && !*filled; i++)
        f->squares[i] = f->squares[i] == 'v' ? ' ' : f->squares[i] == 'w' ? '~' : f->squares[i];
    if (!*filled) return SL_OK;
    if (found.open)
        snprintf(open, sizeof open, " at all but %zu of %zu places", found.open, found.all);
    sl_note(f->reader->context,
            "%s: %zu squares at its edge have no tile, or nothing but water, and walls part them "
            "from floor%s: they are taken as solid; if one walks there: %s",
            f->reader->map->file->name, marked, open, write_open(f, keep));
    return fill(f, "vw");
}

/// Whether what is at the edge may be filled. A room may be small against the map, but not against
/// its walls: a platformer's tiles that are not solid are few.
static bool may_fill(const field *f, size_t empty, size_t floor, size_t solid) {
    const sli_tiled_reader *reader = f->reader;
    const bool rooms = 10 * floor >= empty + floor || (floor && 4 * floor >= solid);
    return empty && rooms && !reader->options->layers && !reader->by && !has_start(reader);
}

/// What is drawn is floor, too, as in maps whose floor is called background.
static void take_pictures(field *f) {
    for (size_t i = 0; i < f->columns * f->rows; i++) {
        if (f->squares[i] != ',') continue;
        f->squares[i] = '.';
        f->drawn++;
    }
}

/// Whether no floor is told of: objects or platforms are all that is solid, seen from the side, and
/// what lies behind them is a picture.
static bool is_side_view(const field *f, size_t empty, size_t floor) {
    const sli_tiled_by by = f->reader->by;
    const size_t drawn = f->drawn < floor ? f->drawn : floor;
    return by == SLI_TILED_BY_BARE ||
           (by == SLI_TILED_BY_NAME && 10 * (floor - drawn) < empty + floor);
}

static sl_status settle(field *f, const char *layers) {
    size_t empty = 0, floor = 0, water = 0, solid = 0;
    bool filled = false;
    char keep[OPEN_TEXT];
    take_pictures(f);
    take_solid(f);
    SL_TRY(take_closed(f));
    take_doors(f);
    for (size_t i = 0; i < f->columns * f->rows; i++) {
        empty += f->squares[i] == ' ';
        floor += f->squares[i] == '.' || f->squares[i] == '+';
        water += f->squares[i] == '~';
        solid += f->squares[i] == '#';
    }
    if (f->reader->void_is_solid) return fill(f, " ");
    if (f->pictures || f->reader->guessed_all) return SL_OK;
    if (may_fill(f, empty + water, floor, solid)) SL_TRY(fill_edge(f, &filled));
    if (filled) return SL_OK;
    // In a platformer a little is drawn in much air.
    floor += water;
    const border ends = find_border(f, ".+~", " ");
    if (!empty || 10 * floor < empty + floor || !ends.open || start_on_void(f)) return SL_OK;
    const bool one = empty == 1;
    if (solid && !layers && !f->reader->by && ends.all < PAIRS &&
        FLOOR_PER_END * ends.open <= floor) {
        sl_note(f->reader->context,
                "%s: %zu square%s no tile, and %s taken as solid, as floor is drawn elsewhere; "
                "if one walks there: %s",
                f->reader->map->file->name, empty, one ? " has" : "s have", one ? "is" : "are",
                write_open(f, keep));
        return fill(f, " ");
    }
    if (is_side_view(f, empty, floor)) return SL_OK;
    sl_note(f->reader->context,
            "%s: %zu square%s no tile and %s open, and floor leads to %s with no wall "
            "between: --layers '%s%svoid' takes %s as solid",
            f->reader->map->file->name, empty, one ? " has" : "s have", one ? "is" : "are",
            one ? "it" : "them", layers ? layers : "", layers ? "," : "", one ? "it" : "them");
    return SL_OK;
}

sl_status sli_tiled_settle_void(sli_tiled_reader *reader) {
    field f = {.reader = reader};
    const sli_tiled_orientation kind = reader->lattice.orientation;
    if (kind != SLI_TILED_ORTHOGONAL && kind != SLI_TILED_ISOMETRIC) return SL_OK;
    sl_status status = look_at_layers(&f, reader->map, (sl_point){0});
    const int64_t columns = f.range.right - f.range.left, rows = f.range.bottom - f.range.top;
    if (status != SL_OK || !columns || columns > MOST / rows)
        return status == SL_BAD_INPUT ? SL_OK : status;
    f.columns = (size_t)columns;
    f.rows = (size_t)rows;
    f.squares = sl_alloc_array(reader->context, f.columns, f.rows);
    if (!f.squares) return SL_NO_MEMORY;
    memset(f.squares, ' ', f.columns * f.rows);
    status = look_at_layers(&f, reader->map, (sl_point){0});
    if (status == SL_OK) status = settle(&f, reader->options->layers);
    sl_free(reader->context, f.squares);
    // A layer that is damaged says nothing; it is no fault where it is not read for its walls.
    return status == SL_BAD_INPUT && !reader->void_is_solid ? SL_OK : status;
}
