/// The parts of the reader of LDtk: layers, and what the values of cells mean.
#ifndef SL_LDTK_H
#define SL_LDTK_H

#include "io/parts/document.h"
#include "io/parts/game_names.h"
#include "io/parts/shapes.h"
#include "io/parts/things.h"
#include "sightline/import.h"

/// What a cell is, as the characters of sli_tile_block; ground, and rock and the like beside walls,
/// are decided once all is read; so are the cells of a layer that has one value, without a name.
/// Ground beside values named for walls is open, if there are such walls. A value that is open is
/// told from an empty cell till then.
enum {
    SLI_LDTK_GROUND = 'g',
    SLI_LDTK_BESIDE = 'w',
    SLI_LDTK_STANDS = 's',
    SLI_LDTK_BARE = 'b',
    SLI_LDTK_PASS = ','
};

/// What the values of a layer mean, or the tiles of its tileset.
typedef struct sli_ldtk_layer {
    sli_game_kind kind; ///< by its name; SOLID where it is asked for
    bool by_name;       ///< some value is named for what is solid: the others are not, but for rock
    bool ceiling; ///< some value is named for a ceiling: what is named for ground may be solid
    bool only_walkable; ///< all values are named for where one walks: empty cells are solid
    sli_word numbers;   ///< of the values that are asked for; of no length for all
} sli_ldtk_layer;

/// What a value stands for.
typedef struct sli_ldtk_cell {
    char square;
    sli_says says; ///< whether it is a door
    bool bare;     ///< it is solid for want of a name
} sli_ldtk_cell;

/// What is told: the values by what became of them.
typedef struct sli_ldtk_told {
    sli_name_list solid, stands, water, ground, beside, open;
    char numbers[60]; ///< of those that are solid, as --layers has them: "1+3"
    char others[60];  ///< of the others
    bool named;       ///< some value has a name
    bool floor;       ///< ground is named for a floor or a room,
    bool earth;       ///< or otherwise: grass, sand, ground
} sli_ldtk_told;

bool sli_ldtk_any_solid(const sli_json *values);
/// Whether some value is named for a ceiling, as in a map that is seen from the side.
bool sli_ldtk_any_ceiling(const sli_json *values);
/// Whether some value is named for what only a map that is seen from the side has.
bool sli_ldtk_any_platform(const sli_json *values);
/// Whether all values of a layer are named for where one walks, so that one does not elsewhere.
bool sli_ldtk_only_walkable(const sli_json *values);
/// What a value other than 0 means; `values` are its layer's definitions.
sli_ldtk_cell sli_ldtk_meaning(const sli_json *values, const sli_ldtk_layer *layer, int64_t value,
                               sli_ldtk_told *told);

/// The squares that tiles of a tileset make by its enums (Wall, Water ...), and by the text that it
/// has for single tiles; 0 for a tile that says nothing. `tiles` has the definition of the tileset.
char sli_ldtk_tile(const sli_json *tileset, int64_t tile);

/// A level's place in its world, in pixels, y down.
typedef struct sli_ldtk_place {
    double x, y;
} sli_ldtk_place;

/// A layer of tiles in levels that have no cells, by its name.
typedef struct sli_ldtk_drawn {
    char name[80];
    json_t *layer;      ///< of the first level that has it, kept
    sli_ldtk_place at;  ///< that level's
    char asked[80];     ///< where it is full: its tiles but the most frequent one, ":1+3-5"
    sli_game_kind kind; ///< by its name
    bool unsure;        ///< it is full, and no tile covers three fifths of it, or the others are
                        ///< not at its edge
} sli_ldtk_drawn;

/// An entity that is neither a start nor a door.
typedef struct sli_ldtk_other {
    sl_point middle;
    bool small; ///< about as large as a cell or two: it stands where it is
} sli_ldtk_other;

/// What is taken of tiles where nothing says what is solid, by where starts and entities stand.
typedef enum sli_ldtk_guess {
    SLI_LDTK_NO_GUESS,
    SLI_LDTK_GUESS_TILES, ///< they stand where the only layer has no tiles
    SLI_LDTK_GUESS_EMPTY, ///< they stand on its tiles
} sli_ldtk_guess;

/// A file that is read.
typedef struct sli_ldtk {
    sl_context *context;
    const char *name;
    const sl_import_options *options;
    sli_json root;
    sli_json project; ///< has the definitions
    sli_tiles tiles;
    sli_things things;
    SL_ARRAY(sli_ldtk_other) others;
    SL_ARRAY(sl_box) walls; ///< of entities that are named for walls
    bool walls_likely;      ///< their names hold other words, too: they go if any does not
    bool wall_sized;        ///< one of these is larger than a cell
    bool walls_named;       ///< one has a name that only lets expect that it stops
    double wall_step;       ///< the size of the cells of their layer
    char mark[80];          ///< the name of the first one
    size_t marks;           ///< of this name: left out, as they are one cell large, here and there
    SL_ARRAY(sl_box) pages; ///< of the levels taken, from the world's origin, y down
    double bottom;   ///< the largest y of the levels taken, in pixels from the world's origin
    int64_t depth;   ///< of the levels taken
    char taken[160]; ///< the first level that is taken, as the account shows it
    sli_ldtk_told told;
    char asked[80];                 ///< a layer with values that chooses, for the message
    SL_ARRAY(sli_ldtk_drawn) drawn; ///< layers of tiles
    SL_ARRAY(size_t) shown_layer;   ///< for each block of `shown`: its number in `drawn`
    sli_tiles shown;                ///< their squares: '#' a tile that `asked` takes, '+' any other
    sli_ldtk_guess guess;
    size_t guessed;           ///< by a guess: the number of the layer
    size_t stood, stood_of;   ///< so many of all starts and small entities say so; 0 for its look
    bool void_is_solid;       ///< squares without any tile are, as asked or by a guess
    sli_name_list tile_names; ///< all of them
    bool side_view;           ///< values are named for platforms, ladders, slopes
    bool empty_cells;         ///< a level has layers of cells, which are empty: its tiles count
    size_t levels, other_levels, other_depths;
    size_t layers, tile_layers, other_layers, entities;
} sli_ldtk;

/// What is found out from what stands where.
typedef struct sli_ldtk_settled {
    bool ground_solid, unsure; ///< unsure: nothing tells what ground is
    bool beside_solid;         ///< ground is, though values are named for walls: there are none
    double bare;               ///< the share of empty cells, where ground is open
    bool bare_solid;           ///< these are solid, as they lie about a floor
    bool stands_open;          ///< what is named for stone and the like is a floor
    bool bare_open;            ///< so is a value without a name, in some layer
} sli_ldtk_settled;

/// Decides what ground is, and puts '#' or '.' in its place: where starts stand on it or on what is
/// empty; else it is open where two or more other entities stand on it, twice as many as on what is
/// empty; else it is the solid ground of a platformer if most squares around it are empty or values
/// are named for platforms, and open if hardly any are. Where starts stand on a floor, and it ends
/// at empty cells nearly everywhere, these are solid. Rock and the like beside walls is a floor
/// where starts stand on it and not on open cells; else where three or more other entities do,
/// twice as many as on open cells. The only value of a layer, if it has no name, is a floor where
/// all starts stand on it, and not at its end: empty cells are solid then.
void sli_ldtk_settle_ground(sli_ldtk *reader, sli_ldtk_settled *out);

/// Coordinates of levels and sizes of cells are up to this many pixels.
#define SLI_LDTK_MOST_PIXELS 1000000000

/// The squares of a layer of a level.
typedef struct sli_ldtk_frame {
    int64_t columns, rows, step;
    sl_point corner;
} sli_ldtk_frame;

sl_status sli_ldtk_read_frame(const sli_json *layer, sli_ldtk_place at, sli_ldtk_frame *out);
/// Where a tile of a list lies; false where that is no square of the layer.
bool sli_ldtk_find_square(const sli_json *tile, const sli_ldtk_frame *of, size_t *at);
/// Whether a layer has tiles, by hand or by rules.
bool sli_ldtk_has_tiles(const sli_json *layer);

/// Reads the layers of a level: those with cells, tiles and entities.
sl_status sli_ldtk_read_layers(sli_ldtk *reader, const sli_json *layers, sli_ldtk_place at);

// --- tiles of which nothing is said (ldtk_drawn.c)

/// Remembers a layer of tiles for messages, and its squares for a guess or for void.
sl_status sli_ldtk_keep_drawn(sli_ldtk *reader, const sli_json *layer, sli_ldtk_place at);
/// Where nothing says what is solid: takes the tiles of the only layer, or the squares without a
/// tile, if starts and entities tell. Takes these squares where they are asked for.
sl_status sli_ldtk_settle_drawn(sli_ldtk *reader);
void sli_ldtk_destroy_drawn(sli_ldtk *reader);
enum { SLI_LDTK_EXAMPLE = 900 };
/// "; to take ...: sightline check ...": a command that takes what is likely to be solid; or why
/// there is none.
sl_status sli_ldtk_show_example(const sli_ldtk *reader, char text[SLI_LDTK_EXAMPLE]);

/// Tells how much of the open ground of a level lies about a building, and how it is left out
/// (ldtk_outside.c).
void sli_ldtk_note_outside(const sli_ldtk *reader);

/// Which entities are walls.
typedef enum sli_ldtk_walls {
    SLI_LDTK_STOPPING, ///< beside cells: those whose names say that they stop a player
    SLI_LDTK_NAMED,    ///< without cells: those that are named for walls, too
    SLI_LDTK_ASKED,    ///< those that are asked for by name
} sli_ldtk_walls;

/// Reads the entities of a layer: starts, doors, the places of others, the boxes of walls.
sl_status sli_ldtk_read_entities(sli_ldtk *reader, const sli_json *layer, sli_ldtk_place at,
                                 sli_ldtk_walls walls);
/// Drops boxes of walls beside all levels, and all boxes where all of them are marks, or a layer
/// says what is solid and not all of them do, unless they are asked for. To be called when all
/// levels are read.
sl_status sli_ldtk_settle_walls(sli_ldtk *reader);
/// Adds what is left of them to the map as solid ground.
sl_status sli_ldtk_add_walls(const sli_ldtk *reader, sl_map *map);

#endif
