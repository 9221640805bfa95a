/// Starts and doors that the files of games name, and where they stand among the map's squares.
#ifndef SL_THINGS_H
#define SL_THINGS_H

#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "sightline/import.h"

typedef enum sli_thing_kind { SLI_THING_NONE, SLI_THING_START, SLI_THING_DOOR } sli_thing_kind;

/// What the texts of an object say. The name is the text that says so, for a door its own name; it
/// belongs to the texts.
typedef struct sli_says {
    sli_thing_kind kind;
    sli_door_state state;
    const char *name;
    int rank; ///< how firmly the state is said: 0 by the name, 1 by a property, 2 by one named
              ///< "open"
    const char *unclear; ///< a property of the state whose value is not understood, or NULL
} sli_says;

/// What a name and a class say by the usual words; either may be NULL.
sli_says sli_says_of(const char *name, const char *class_name);

/// Takes in a property that is true or false: "door" says that it is one, or none; "open" decides
/// its state, else "closed", "shut" and "locked" do.
void sli_says_add(sli_says *says, const char *property, bool value);
/// Takes in a property that is a text: "state" is "closed".
void sli_says_add_text(sli_says *says, const char *property, const char *value);

/// A start or a door. Places are in pixels, y down, as the files have them.
typedef struct sli_thing {
    sli_thing_kind kind;
    char *name;
    sl_point middle;
    sl_point u, v;  ///< its corners are middle ± u ± v; v is 0 for a line, both for a point
    bool is_line;   ///< a door along u, as it is drawn
    bool goes_on;   ///< a door that is one with the door before it
    bool is_wall;   ///< a door that is a wall where it has no place
    bool of_tiles;  ///< a door of squares: the picture of one that an object may stand for too
    bool open;      ///< a door, when the map begins
    double heading; ///< of a start, as sl_start has it
    uint32_t line;
    bool inside;       ///< within some grid
    bool solid;        ///< its middle is on solid ground
    bool buried;       ///< a door: solid ground of some grid is on both of its sides,
    bool in_ground;    ///< and it would run into solid ground
    bool moved;        ///< a start that stood on the edge of a solid square
    const char *doubt; ///< a start that is not believed: why; else NULL
    bool placed;       ///< a door whose segment is found, in the map's coordinates
    bool cut;          ///< and which opened solid squares
    bool again;        ///< a door of squares that is an object's door too
    sl_segment at;     ///< of a door
} sli_thing;

/// A rectangle of door squares that is growing: squares of a block of tiles, and its first row.
typedef struct sli_door_run {
    const char *name;
    sli_door_state state;
    size_t left, right, top, bottom;
    size_t root; ///< the run above that it is a part of, or its own number
} sli_door_run;

#define SLI_NAMES_SHOWN 10

/// A text of names, each once: 'Player', 'spawn'.
typedef struct sli_name_text {
    char text[256];
    size_t count;
} sli_name_text;

/// All of a file. Set the first four, zero the rest.
typedef struct sli_things {
    sl_context *context;
    const char *file; ///< its name, for messages
    const sl_import_options *options;
    double top;       ///< the file's y that is 0 in the map, once the grids are made
    sli_affine shown; ///< for messages: from places to those of the file; zero: they are the same
    SL_ARRAY(sli_thing) items;
    SL_ARRAY(sli_door_run) runs; ///< of the block at hand
    char *seen[SLI_NAMES_SHOWN]; ///< names of objects, each once, for the message
    size_t seen_count;
    sli_name_text left;    ///< objects that are neither starts nor doors nor walls
    sli_name_text doubt;   ///< those of them whose names have the word "door"
    sli_name_text unclear; ///< properties of doors that are not understood
    size_t grids;
    size_t shapes; ///< the map's first walls, which are not of squares
    size_t casts;  ///< walls that rays from doors were held against
} sli_things;

void sli_things_destroy(sli_things *things);

/// Where a thing is in the map.
sl_point sli_thing_place(const sli_things *things, size_t number);

/// The heading of a start: `clockwise` degrees from +x, on a screen with y down.
double sli_heading_of(double clockwise);

/// What an object is, by its name and its class. With options->start_names only these are starts.
/// Remembers the names. `says` holds what they say by the usual words.
sl_status sli_things_ask(sli_things *things, const char *name, const char *class_name,
                         sli_says *says);

/// Takes the name of an object that is left out into the notes; "" for none.
void sli_things_leave(sli_things *things, const char *name);

/// Adds a start or a door by its name; the thing's own name is not read. SL_OK where its
/// coordinates are not usable: it is outside the map.
sl_status sli_things_add(sli_things *things, const char *name, sli_thing thing);

/// Adds a square of a block of tiles that is a door, row after row. The name must live until the
/// block ends. Neighbours of one name become one door.
sl_status sli_things_add_square(sli_things *things, const sli_says *says, size_t column,
                                size_t row);
sl_status sli_things_end_block(sli_things *things, sl_point corner, sl_point step);

/// Finds the passages of doors in a grid of squares, and opens the solid squares that a door
/// stands on where a passage leads through them. Marks starts on solid ground. To be called for
/// each grid, before its walls are made. Squares of doors become '+' or 'o'.
sl_status sli_things_place(sli_things *things, sli_grid *grid);

/// Adds starts and doors to the map, once it has its walls, and reports what was taken and left
/// out. SL_BAD_ARGUMENT where a name of options->start_names is that of no object.
sl_status sli_things_finish(sli_things *things, sl_map *map);

#endif
