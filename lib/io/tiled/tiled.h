/// The parts of the reader of Tiled maps: notations, lattices, tilesets, shapes.
#ifndef SL_TILED_H
#define SL_TILED_H

#include "io/parts/document.h"
#include "io/parts/game_names.h"
#include "io/parts/layers.h"
#include "io/parts/shapes.h"
#include "io/parts/things.h"

// --- XML in the shape of JSON, so that one reader reads both

/// Reads a document whose root element has this name ("map", "tileset"). Numbers stay text, a
/// polygon's points too; every object knows its line. SL_BAD_INPUT with the line where it is no
/// such document. sli_json_close is the caller's.
sl_status sli_tiled_from_xml(sl_context *context, const char *name, const char *root,
                             const char *text, size_t size, sli_json_file *file);

// --- the tiles of a layer, in all the ways that they are written

/// A tile's number in a layer has these bits for how it is turned; the rest is the tile.
#define SLI_TILED_ACROSS   0x80000000u ///< mirrored left to right, after the next two
#define SLI_TILED_DOWN     0x40000000u ///< mirrored top to bottom
#define SLI_TILED_DIAGONAL 0x20000000u ///< x and y exchanged
#define SLI_TILED_TILE     0x0fffffffu
/// In hexagonal maps this bit is a turn by 120 degrees, and the one of x and y a turn by 60.
#define SLI_TILED_HEXAGON_120 0x10000000u

/// Reads `count` numbers: an array, or text by the layer's "encoding" (csv, base64) and
/// "compression" (none, zlib, gzip, zstd). sl_free(*gids) is the caller's. SL_BAD_INPUT where there
/// are more or fewer, or the text is damaged.
sl_status sli_tiled_read_data(const sli_json *layer, const sli_json *data, size_t count,
                              uint32_t **gids);

// --- how tiles lie on the screen, and the plan where diamonds are squares. Both have y down

typedef enum sli_tiled_orientation {
    SLI_TILED_ORTHOGONAL,
    SLI_TILED_ISOMETRIC,
    SLI_TILED_STAGGERED,
    SLI_TILED_HEXAGONAL,
} sli_tiled_orientation;

typedef struct sli_tiled_lattice {
    sli_tiled_orientation orientation;
    sl_point tile;                ///< the size of the box of a tile, pixels
    sl_point step;                ///< the size of a square of the plan; 1 x 1 for hexagons
    bool stagger_x, stagger_even; ///< columns (else rows) are moved: the even ones, else the odd
    double side, slope;           ///< the length of a hexagon's straight sides, and of its points
    double left;                  ///< the plan's origin on the screen
    double height;                ///< the screen's y that is 0 in the map
} sli_tiled_lattice;

/// Reads the head of a map: its orientation, its size, that of its tiles.
sl_status sli_tiled_read_lattice(const sli_json *map, sli_tiled_lattice *lattice);

/// Whether the plan is another than the screen: tiles are diamonds.
bool sli_tiled_has_plan(const sli_tiled_lattice *lattice);
/// From the screen to the plan, and back.
sli_affine sli_tiled_to_plan(const sli_tiled_lattice *lattice);
sli_affine sli_tiled_to_screen(const sli_tiled_lattice *lattice);

/// The upper left corner of a tile's box on the screen.
sl_point sli_tiled_tile_at(const sli_tiled_lattice *lattice, int64_t column, int64_t row);

/// From the numbers of a tile to those of its square in the plan.
void sli_tiled_square_of(const sli_tiled_lattice *lattice, int64_t *column, int64_t *row);

/// Tiles or squares from `left` and `top` to before `right` and `bottom`.
typedef struct sli_tiled_range {
    int64_t left, top, right, bottom;
} sli_tiled_range;
/// The squares of the plan that a block of tiles lies in; a staggered block fills about half of it.
void sli_tiled_plan_range(const sli_tiled_lattice *lattice, const sli_tiled_range *tiles,
                          sli_tiled_range *squares);

/// Moves walls, doors and starts from the plan to the screen, both with y up. SL_BAD_INPUT where a
/// coordinate is not usable then.
sl_status sli_tiled_project(const sli_json *json, const sli_tiled_lattice *lattice, sl_map *map);

/// Adds the sides between solid and open hexagons as walls with their ground. The grid's places are
/// numbers of columns and rows; `offset` is the layer's, pixels.
sl_status sli_tiled_add_hexagons(sl_context *context, const sli_tiled_lattice *lattice,
                                 sl_point offset, const sli_grid *grid, sl_map *map);
/// Whether a place on the screen lies in a hexagon or on its border.
bool sli_tiled_in_hexagon(const sli_tiled_lattice *lattice, int64_t column, int64_t row,
                          sl_point at);

// --- tilesets, as far as they say what is solid

/// What a layer, a tile or an object says of itself.
typedef enum sli_tiled_word { SLI_TILED_UNSAID, SLI_TILED_OPEN, SLI_TILED_SOLID } sli_tiled_word;

/// By a property whose name is a word for solid, or for the contrary, and whose value is true or
/// false; or that is a type, with a word for solid as its value; else by the class (member
/// `class_key`, or "class"), where that is such a word.
sli_tiled_word sli_tiled_word_of(const sli_json *thing, const char *class_key);
/// The name of an object; where it has none, the text of its property "name", or "".
const char *sli_tiled_name_of(const sli_json *object);

/// A walk over the properties of a layer, a tile or an object: newer files have a list, the older
/// ones an object of names and values.
typedef struct sli_tiled_properties {
    sli_json all;
    size_t next;
    void *at;
} sli_tiled_properties;

/// The thing must outlive the walk.
sli_tiled_properties sli_tiled_properties_of(const sli_json *thing);
/// False at the end. The name is NULL for a property without one.
bool sli_tiled_next_property(sli_tiled_properties *walk, const char **name, sli_json *value);

bool sli_tiled_looks_like_xml(const sl_bytes *bytes);

/// A tile that says something of itself, or has shapes to collide with.
typedef struct sli_tiled_tile {
    uint32_t id;
    uint32_t order; ///< among those of the file
    sli_tiled_word word;
    bool terrain;   ///< it is drawn by a terrain that is solid by its name
    bool named;     ///< so is the picture that it has of its own
    sli_says says;  ///< by its class and its properties
    json_t *shapes; ///< an array of objects; NULL for none
    uint32_t item;  ///< of the first shape's name in the map; 0 before the tile is drawn
    uint64_t drawn; ///< the shapes that are drawn for each such tile,
    uint64_t walls; ///< and their walls
} sli_tiled_tile;

typedef struct sli_tiled_set {
    uint32_t first;                 ///< the number of its first tile in the layers
    double width, height;           ///< of its tiles, pixels
    double x, y;                    ///< how far its tiles are drawn from their place
    sl_point diamond;               ///< the tiles' shapes are drawn in this one; 0 for in pixels
    sli_tiled_word word;            ///< of all tiles that say nothing
    bool named;                     ///< its name, or its picture's, is one for what is solid
    bool inside;                    ///< its name is that of a dungeon
    const char *source;             ///< that file as the map calls it; NULL for none
    SL_ARRAY(sli_tiled_tile) tiles; ///< by id, ascending
    sli_json_file file;             ///< where it is in a file of its own
    char *path;                     ///< that file; NULL for none
    const char *missing;            ///< that file as the map calls it, where it cannot be read
} sli_tiled_set;

/// Adds a tile that says something. Of several with one id the first says what it says.
sl_status sli_tiled_add_tile(sl_context *context, sli_tiled_set *set, sli_tiled_tile tile);
/// Whether a tile is drawn by terrains that are solid by their names.
bool sli_tiled_has_terrain(const sli_json *set, const sli_json *tile);
/// Adds the tiles that are drawn by such colours of Wang sets.
sl_status sli_tiled_read_wang_sets(const sli_json *json, sli_tiled_set *set);

typedef struct sli_tiled_sets {
    SL_ARRAY(sli_tiled_set) sets; ///< by first number, ascending
    size_t missing;
} sli_tiled_sets;

/// Reads the map's tilesets, those in files beside it too. A file that cannot be read is no
/// failure: its set is marked. The map's tree must outlive the sets.
sl_status sli_tiled_read_sets(const sli_json *map, sli_tiled_sets *sets);
void sli_tiled_destroy_sets(sl_context *context, sli_tiled_sets *sets);

/// The set of a tile, by its number without the bits of turning; NULL where no set has it.
const sli_tiled_set *sli_tiled_find_set(const sli_tiled_sets *sets, uint32_t gid);
/// What the tile says, or NULL for nothing.
sli_tiled_tile *sli_tiled_find_tile(const sli_tiled_set *set, uint32_t gid);

// --- objects as walls: rectangles, ellipses, polygons, polylines

typedef enum sli_tiled_kind {
    SLI_TILED_RECTANGLE,
    SLI_TILED_ELLIPSE,
    SLI_TILED_POLYGON,
    SLI_TILED_POLYLINE,
    SLI_TILED_PICTURE, ///< a tile as an object: a rectangle that stands on its place
    SLI_TILED_OTHER,   ///< a point, a text, a capsule, an instance of a template
} sli_tiled_kind;

typedef struct sli_tiled_shape {
    sli_tiled_kind kind;
    double x, y, width, height; ///< pixels, y down
    double rotation;            ///< degrees, clockwise on the screen, about x, y
    sli_affine turn;            ///< by that; in a plan, what the screen's turn is there
    uint32_t gid;               ///< of a picture
    uint32_t line;              ///< 0 where there is none
    sli_json points;            ///< of a polygon or polyline, from x, y
} sli_tiled_shape;

/// Reads what an object is; `object` must outlive the shape.
sl_status sli_tiled_read_shape(const sli_json *object, sli_tiled_shape *shape);

/// The walls that drawing the shape gives, without those of no length. With a tolerance an ellipse
/// counts as 4.
uint64_t sli_tiled_shape_walls(const sli_pen *pen, const sli_tiled_shape *shape);

/// Draws the outline. The pen's affine leads from the object's layer to the map.
sl_status sli_tiled_draw_shape(sli_pen *pen, const sli_tiled_shape *shape);

// --- starts and doors

/// What an object or a tile says by its name, its class (member `class_key`, or "class"), and its
/// properties.
sli_says sli_tiled_says_of(const sli_json *thing, const char *class_key);

typedef struct sli_tiled_template sli_tiled_template;
/// Zero it to start.
typedef struct sli_tiled_templates {
    sli_tiled_template *items;
    size_t count, capacity;
} sli_tiled_templates;

void sli_tiled_destroy_templates(sl_context *context, sli_tiled_templates *templates);

/// An instance of a template with all that the template says; `file` has no root for an object that
/// is no instance. sli_json_close is the caller's, on failure too. A template that cannot be read
/// is noted, and the instance stands for itself.
sl_status sli_tiled_instance(sli_tiled_templates *templates, const sli_tiled_sets *sets,
                             const sli_json *object, sli_json_file *file);

/// Adds an object that is a start or a door; `place` leads from its layer to the file's places, and
/// it would be a wall else if `is_wall`.
sl_status sli_tiled_take_thing(sli_things *things, const sli_says *says,
                               const sli_tiled_shape *shape, sli_affine place, bool is_wall);

// --- reading a map: what its parts share

/// How it is found out what is solid, the firmest first. Each is a reading of all layers.
typedef enum sli_tiled_by {
    SLI_TILED_BY_WORD,    ///< layers, tiles and objects say it
    SLI_TILED_BY_BESIDE,  ///< tiles of layers below and above the player, where nothing else does
    SLI_TILED_BY_NAME,    ///< names of layers let expect it: trees, platforms
    SLI_TILED_BY_TERRAIN, ///< tiles' terrains
    SLI_TILED_BY_SET,     ///< names of tilesets and pictures
    SLI_TILED_BY_BARE,    ///< objects with a shape, and without a name, type or property
    SLI_TILED_BY_GUESS,   ///< the look of one layer
} sli_tiled_by;

/// A layer of tiles or objects as the first reading found it.
typedef struct sli_tiled_seen {
    const char *name;
    json_t *layer;       ///< in the map's tree
    bool objects, moves; ///< moves: by a parallax of its own
    bool taken;          ///< something of it is solid
    size_t beside;       ///< solid tiles that are not taken, as the player goes over or under them
    sli_game_kind kind;  ///< by its name, else by that of its group
    uint64_t count, squares;
    size_t solid;      ///< of its tiles: those that say that they are solid
    bool tiles_decide; ///< as sli_tiled_place has it,
    size_t said;       ///< and these
    size_t denied;
} sli_tiled_seen;

/// A closed object that is solid: a number of walls of the pen's map.
typedef struct sli_tiled_closed {
    size_t first, count;
    sl_box box;
    sli_tiled_kind kind;
    bool of_tile; ///< the shape of a tile
    bool solid;   ///< its inside is solid ground
} sli_tiled_closed;

typedef struct sli_tiled_reader {
    sl_context *context;
    const sl_import_options *options;
    const sli_json *map;
    sli_tiled_lattice lattice;
    double top;          ///< the plan's y that is 0 for the pen, which has y up
    sli_affine to_plan;  ///< from the screen
    sl_point offset;     ///< staggered and hexagonal: of the layers with tiles
    sli_tiled_range all; ///< and their tiles
    sli_tiled_sets sets;
    sli_tiles tiles;
    sli_pen pen;
    SL_ARRAY(sli_tiled_seen) seen; ///< in the order of the file
    size_t at_layer;               ///< the one at hand
    sli_tiled_by by;
    sli_game_kind best;               ///< by name: of the layers taken
    size_t guess_layer;               ///< by a guess: the layer,
    bool guess_only;                  ///< which is the only one that is not full
    uint32_t guessed;                 ///< the tile that is taken as solid (0: empty squares)
    bool guessed_all;                 ///< or all tiles are but that one
    bool bare;                        ///< the layer at hand has objects that say nothing
    bool void_is_solid;               ///< as the options ask
    bool walls_are_pictures;          ///< of layers that are named for what stops
    bool borders;                     ///< tiles say what is solid, so objects named for borders do
    const char *believed_not;         ///< the first layer whose tiles say too much
    const char *guess_why;            ///< NULL where nothing can be guessed
    uint64_t tile_shapes, tile_walls; ///< that the layers' tiles draw
    size_t solid_layers, solid_tiles, shapes, objects; ///< taken
    size_t empty_layers;                               ///< that would be solid
    size_t other_layers, other_objects, other_shapes;  ///< left out
    size_t unknown_tiles;                              ///< of tilesets that cannot be read
    size_t lost_tiles;                                 ///< the same, in solid layers too
    size_t lost_shapes;                                ///< of tiles as objects, not orthogonal
    size_t doors_left_out;                             ///< tiles that are doors and hexagons
    size_t beside_tiles;               ///< solid ones of layers below and above the player
    SL_ARRAY(sli_tiled_closed) closed; ///< objects and shapes of tiles that stop all
    size_t closed_objects;             ///< of these: objects
    size_t solid_closed;               ///< of these: whose insides are solid ground
    sli_things things;
    const json_t *start_layer; ///< a layer of chunks that is a start,
    size_t start_tiles;        ///< the tiles of the chunk that it was put into,
    size_t start_at;           ///< and its number among the things
    sli_tiled_templates templates;
} sli_tiled_reader;

/// A layer's place, and what is said of it, its groups included.
typedef struct sli_tiled_place {
    sl_point offset; ///< pixels, y down
    sli_tiled_word word;
    sli_game_kind kind; ///< by its name
    bool moves;         ///< against what is behind it: by a parallax
    bool tiles_decide;  ///< what its tiles say goes over its name
    size_t said;        ///< so many tiles of a layer named for walls say that they are solid; 0
                        ///< where none do, or no tile is silent
    size_t denied;      ///< and so many that they are open
    bool others;        ///< its objects are enemies, items, triggers
    bool beside;        ///< it is drawn below or above the player
    const char *doors;  ///< the name of a layer of tiles that is named for doors; else NULL
    sli_word gids;      ///< the tiles that are asked for; of no length for all
    bool asked;
    uint32_t stops; ///< what walls of its objects stop; 0 where nothing is said
} sli_tiled_place;

/// What a tile's set says of it; both may be NULL.
sli_tiled_word sli_tiled_word_of_tile(const sli_tiled_set *set, const sli_tiled_tile *tile);

/// Gives the next shape of the pen a number and a name. Shapes of tilesets stand in other files
/// than the map, so that a line of its own would say nothing.
sl_status sli_tiled_name_shape(sli_tiled_reader *reader, const char *label);

/// Whether a layer of tiles is a start.
bool sli_tiled_is_start_layer(const sli_json *layer);

/// Reads the tiles of a layer: solid squares, doors, shapes of tiles; of one that is open only that
/// it is a start.
sl_status sli_tiled_read_tile_layer(sli_tiled_reader *reader, const sli_json *layer,
                                    const sli_tiled_place *at);

/// Draws the collision shapes of the tile that an object shows, where it has some and is no enemy
/// or item by its name; in orthogonal maps. `layer` leads from its layer to the plan.
sl_status sli_tiled_draw_picture(sli_tiled_reader *reader, const sli_json *object,
                                 const sli_tiled_shape *shape, sli_affine layer);

/// Makes walls of all solid tiles that were read, in the plan.
sl_status sli_tiled_add_tile_walls(sli_tiled_reader *reader);

/// Whether the layers that are asked for are `void` alone: then all else is as without the option.
bool sli_tiled_only_void(const char *layers);
/// Makes the squares without any tile solid (reader->void_is_solid), or tells where floor leads to
/// them. To be called before the walls are made.
sl_status sli_tiled_settle_void(sli_tiled_reader *reader);

/// Reads all layers by reader->by, which tells what is solid; what was read before of tiles is
/// dropped.
sl_status sli_tiled_read_again(sli_tiled_reader *reader);

// --- objects (tiled_objects.c)

/// What walls of an object, a layer or a group stop, by its property `stops`, a text; else
/// *stops stays.
sl_status sli_tiled_read_stops(const sli_json *thing, uint32_t *stops);
/// What a layer holds by its name. Diamonds and hexagons are moved once all is read, so that such a
/// layer is one of the map's own. With --start-names the names of objects decide what is a start.
sli_layer sli_tiled_kind_of_layer(const sli_tiled_reader *reader, const sli_json *layer);
/// The objects of a layer: starts and doors, and walls where the layer is not said to be open.
sl_status sli_tiled_read_objects(sli_tiled_reader *reader, const sli_json *layer,
                                 const sli_tiled_place *at);

// --- closed objects (tiled_closed.c)

/// Remembers an object, or the shape of a tile, that is drawn as the map's walls from `first` on,
/// if it is closed.
sl_status sli_tiled_add_closed(sli_tiled_reader *reader, sli_tiled_kind kind, size_t first,
                               bool of_tile);
/// The place of a start or a door in the map, and its box.
sl_box sli_tiled_box_of_thing(const sli_tiled_reader *reader, const sli_thing *thing, sl_point *at);
/// Whether a place of the map lies in a closed object.
bool sli_tiled_is_in(const sli_tiled_reader *reader, const sli_tiled_closed *closed, sl_point at);
/// Makes the insides of closed objects solid ground, but of those that are outlines of rooms. To be
/// called when all starts are read, and before walls are added that no object draws.
sl_status sli_tiled_settle_closed(sli_tiled_reader *reader);

// --- doubts (tiled_beside.c)

/// Refuses a layer of more squares than the limit, before its tiles are unpacked: they may be
/// packed to a thousandth.
sl_status sli_tiled_check_squares(const sli_tiled_reader *reader, const sli_json *layer,
                                  int64_t columns, int64_t rows);

/// Whether layers of tiles named for walls are a picture beside layers that stop:
/// reader->walls_are_pictures; and whether objects named for borders count: reader->borders.
sl_status sli_tiled_look_beside(sli_tiled_reader *reader);
/// Whether the tiles of a layer that is named for walls decide which of them are solid:
/// own->tiles_decide, own->said, own->denied. To be asked where the name is all that says so. A
/// name for what `stops` a player holds for all tiles that do not say otherwise.
sl_status sli_tiled_ask_tiles(const sli_tiled_reader *reader, const sli_json *layer, bool stops,
                              sli_tiled_place *own);
/// Whether nearly all squares have tiles, and nearly all of these say that they are solid.
bool sli_tiled_all_solid(const sli_tiled_sets *sets, const uint32_t *gids, size_t count);

// --- where objects stand (tiled_stands.c)

typedef enum sli_tiled_stand {
    SLI_TILED_STAND_UNKNOWN,
    SLI_TILED_STAND_ON_TILES, ///< four of five small objects, of three at least
    SLI_TILED_STAND_ON_EMPTY, ///< the same, on squares without tiles
} sli_tiled_stand;

/// Whether an object is a rectangle, an ellipse or a polygon of which nothing is said.
bool sli_tiled_is_bare(const sli_json *object, const sli_tiled_shape *shape);
/// Whether these are at least four in a layer, and half of its objects.
bool sli_tiled_has_bare(const sli_json *layer);
/// Whether a layer of such objects is named for borders: they count beside shapes of tiles.
bool sli_tiled_is_border(const sli_json *layer);
/// Where the map's objects stand on a layer of tiles that covers all of it. *on_most: most stand on
/// this tile, of three at least; 0 is a square without one.
sli_tiled_stand sli_tiled_where_objects_stand(const sli_tiled_reader *reader, const uint32_t *gids,
                                              size_t columns, size_t rows, uint32_t most,
                                              bool *on_most);

// --- what is solid where nothing says it (tiled_meaning.c)

/// The number of layers, tiles, shapes and objects that are solid so far.
static inline size_t sli_tiled_taken(const sli_tiled_reader *reader) {
    return reader->solid_layers + reader->solid_tiles + reader->shapes + reader->objects;
}
/// Refuses a map of rules for Tiled's automapping, which is no level, unless layers are asked for.
sl_status sli_tiled_check_rules(const sli_tiled_reader *reader);
/// Where nothing says what is solid: by names, terrains, sets, at last a guess. SL_BAD_INPUT, with
/// the layers and what to type, where none tells.
sl_status sli_tiled_find_meaning(sli_tiled_reader *reader);
/// SL_BAD_INPUT where a start stands on what was guessed to be solid.
sl_status sli_tiled_check_guess(const sli_tiled_reader *reader);
// --- the guess (tiled_guess.c)

/// Whether all that is drawn is one layer that is named for a floor, and has gaps.
bool sli_tiled_only_floor(const sli_tiled_reader *reader);
/// Chooses a layer and reads it: reader->guess_why is not NULL where it tells.
sl_status sli_tiled_begin_guess(sli_tiled_reader *reader);
/// Looks at the tiles of a block of the layer that is guessed from.
sl_status sli_tiled_guess(sli_tiled_reader *reader, const uint32_t *gids, size_t columns,
                          size_t rows);

// --- what to type (tiled_offer.c)

/// What to do about a layer whose name no command can have.
#define SLI_TILED_RENAME "give it a name in Tiled without commas, quotes and blanks at its ends"

/// Room for "+4294967295-4294967295": what does not fit is left out of a text of numbers.
enum { SLI_TILED_NUMBER_ROOM = 24 };

/// Layers for a message: 'Ground' (2500 tiles), 'Things' (3 objects).
typedef struct sli_tiled_layer_text {
    char text[400];
    size_t count, length;
} sli_tiled_layer_text;

void sli_tiled_add_layer(sli_tiled_layer_text *out, const sli_tiled_seen *layer);
/// The layers from which something is taken, or the others that have anything.
sli_tiled_layer_text sli_tiled_list_layers(const sli_tiled_reader *reader, bool taken);
/// Whether a layer's name can stand in a command: --layers has commas between names, and no blanks
/// at their ends.
bool sli_tiled_can_be_typed(const char *name);

/// How likely it is that a layer of which nothing is said is solid.
enum {
    SLI_TILED_NOT_SOLID,
    SLI_TILED_SCRAPS,
    SLI_TILED_RANK_FULL,
    SLI_TILED_PARTIAL,
    SLI_TILED_BESIDE_STARTS, ///< starts stand where it has no tiles
    SLI_TILED_NAMED,
};

/// How many starts stand on tiles of a layer, of these numbers if any are asked for, and how many
/// do not. In orthogonal and isometric maps.
sl_status sli_tiled_count_starts(const sli_tiled_reader *reader, const sli_tiled_seen *seen,
                                 sli_word numbers, size_t counts[2]);

typedef struct sli_tiled_example {
    const sli_tiled_seen *layer; ///< the first of those that are most likely solid
    int rank;
    size_t likely; ///< layers of tiles with gaps that may well be solid
} sli_tiled_example;

/// The layer to name in an example; NULL where none has anything. Layers that are taken may be left
/// out.
sl_status sli_tiled_find_example(const sli_tiled_reader *reader, bool taken_too,
                                 sli_tiled_example *out);
/// Where a layer is full, all of it would be solid: its tiles but the most frequent one, as
/// ":28+33-35"; "" where there are none, or the layer has squares without tiles. *mostly: that one
/// covers three fifths of it.
sl_status sli_tiled_choose_tiles(const sli_tiled_reader *reader, const sli_tiled_seen *seen,
                                 bool *mostly, char *text, size_t size);
/// "; to take ...: " and a command that takes the example; or why there is none.
sl_status sli_tiled_say_example(const sli_tiled_reader *reader, sli_tiled_example best, char *text,
                                size_t size);
/// SL_BAD_INPUT, with the layers and what to type.
sl_status sli_tiled_fail_unsaid(const sli_tiled_reader *reader, const char *why);
/// The same where nothing is a wall: a layer that is solid everywhere has no edge.
sl_status sli_tiled_fail_no_walls(const sli_tiled_reader *reader);

// --- what is told (tiled_told.c)

/// The names of the layers that something is taken of, as --layers has them; "" where one cannot be
/// typed.
void sli_tiled_list_taken(const sli_tiled_reader *reader, char *text, size_t size);
/// Tells what is solid and by what, and which layers are not.
sl_status sli_tiled_tell_meaning(const sli_tiled_reader *reader);

#endif
