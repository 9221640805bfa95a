/// Tiled's tilesets, as far as they say what is solid.
#ifndef SL_IMPORT_TILED_SET_H
#define SL_IMPORT_TILED_SET_H

#include "io/json.h"

/// What a layer, a tile or an object says of itself.
typedef enum sl_tiled_word { SL_TILED_UNSAID, SL_TILED_OPEN, SL_TILED_SOLID } sl_tiled_word;

/// By a property whose name is a word for solid (solid.h) and whose value is true or false; else by
/// the class (member `class_key`, or "class"), where that is such a word.
sl_tiled_word sl_tiled_word_of(const sl_json *thing, const char *class_key);

/// A tile that says something of itself, or has shapes to collide with.
typedef struct sl_tiled_tile {
    uint32_t id;
    sl_tiled_word word;
    json_t *shapes; ///< an array of objects; NULL for none
} sl_tiled_tile;

typedef struct sl_tiled_set {
    uint32_t first;                ///< the number of its first tile in the layers
    double width, height;          ///< of its tiles, pixels
    double x, y;                   ///< how far its tiles are drawn from their place
    sl_tiled_word word;            ///< of all tiles that say nothing
    SL_ARRAY(sl_tiled_tile) tiles; ///< by id, ascending
    sl_json_file file;             ///< where it is in a file of its own
    char *path;                    ///< that file; NULL for none
    const char *missing;           ///< that file as the map calls it, where it cannot be read
} sl_tiled_set;

typedef struct sl_tiled_sets {
    SL_ARRAY(sl_tiled_set) sets; ///< by first number, ascending
    size_t missing;
} sl_tiled_sets;

/// Reads the map's tilesets, those in files beside it too. A file that cannot be read is no
/// failure: its set is marked. The map's tree must outlive the sets.
sl_status sl_tiled_read_sets(const sl_json *map, sl_tiled_sets *sets);
void sl_tiled_destroy_sets(sl_context *context, sl_tiled_sets *sets);

/// The set of a tile, by its number without the bits of turning; NULL where no set has it.
const sl_tiled_set *sl_tiled_find_set(const sl_tiled_sets *sets, uint32_t gid);
/// What the tile says, or NULL for nothing.
const sl_tiled_tile *sl_tiled_find_tile(const sl_tiled_set *set, uint32_t gid);

#endif
