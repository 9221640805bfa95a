/// Reads the input of commands: map files, baked files, and the names of doors to shut.
#ifndef INPUTS_H
#define INPUTS_H

#include "arguments/options.h"
#include "sightline/bake.h"
#include "sightline/import.h"
#include "sightline/support.h"

/// A file's name without folders and ending: "maps/office.map" gives "office". The result is a
/// place in the path, and a length.
const char *input_base_name(const char *path, size_t *length);

/// How a map is read, and how its walls are cleaned.
typedef struct input_options {
    sl_import_options import;
    sl_clean_options clean;
    sl_limits limits;  ///< of reading; 0: the usual ones
    const char *given; ///< the name of an option that is given; NULL for none
} input_options;

input_options input_options_default(void);

/// The command-line options that fill it.
option_table input_option_table(input_options *input);

/// Whether a file is a baked one, by its name or its first bytes. Pipes have no names that say so.
bool input_is_baked(const char *path, const sl_bytes *bytes);
/// Whether the name is that of a drawing: what may hold more than the walls of one plan.
bool input_is_drawing(const sl_context *context, const char *path);
/// Whether the name is that of a game's map: of layers, among which walls are chosen, and doors.
bool input_is_game(const sl_context *context, const char *path);

/// Reads a map file. A baked file is refused.
sl_status input_read_map(sl_context *context, const char *path, const input_options *input,
                         sl_map *map);

/// Cleans a map as --weld asks for. `account` may be NULL.
sl_status input_clean(sl_context *context, const input_options *input, sl_map *map,
                      sl_clean_account *account);

/// Reads a baked file. Refuses a map file, which it knows by its ending, and says how to bake it.
sl_status input_read_baked(sl_context *context, const char *path, sl_baked *baked);

/// SL_BAD_ARGUMENT where one of these options is given together with a baked file.
sl_status input_refuse_options(sl_context *context, const char *path, const input_options *input);

/// Makes all walls of a map stop all, where its lines count and not what they stop.
sl_status input_take_lines(sl_context *context, sl_map *map);

/// Reads a map file, or the map that a baked file was made from.
sl_status input_read_either(sl_context *context, const char *path, const input_options *input,
                            sl_map *map);

/// Notes that a map has walls that limit sight, and where these count.
void input_note_limited(sl_context *context, const sl_map *map);

/// The same as input_read_baked() from memory; `path` is for messages.
sl_status input_parse_baked(sl_context *context, const char *path, const sl_bytes *bytes,
                            sl_baked *baked);

/// The same as input_read_either() from memory; `path` is for messages, and for its ending.
sl_status input_parse_either(sl_context *context, const char *path, const sl_bytes *bytes,
                             const input_options *input, sl_map *map);

/// Prints the formats of maps that can be read.
void input_print_formats(void);

enum { INPUT_NEAREST_TEXT = 96 };

/// "; the nearest place inside: 1.5,2", with the digits that it needs to be inside, or nothing
/// where nothing is inside.
const char *input_say_nearest(const sl_space *space, sl_point at, char text[INPUT_NEAREST_TEXT]);

/// Finds the cell of a place to look from, which an option or operand gives. SL_BAD_ARGUMENT where
/// it lies outside the map's bounds or in solid ground. `cell` may be NULL: a viewpoint, which is
/// noted where it is not inside. Messages name the nearest place inside.
sl_status input_locate(sl_context *context, const char *name, const char *text,
                       const sl_space *space, sl_point at, uint32_t *cell);

/// SL_BAD_INPUT with FILE:LINE where a point of a file lies outside the map's bounds or in solid
/// ground.
sl_status input_check_place(sl_context *context, const char *path, unsigned line,
                            const sl_space *space, sl_point at);

/// The map's first start from the given one on that is in no solid ground; start_count for none.
size_t input_next_start(const sl_map *map, const sl_space *space, size_t from);

/// Which doors are shut: the arguments of --shut and --open. Zeroed: as the map says.
typedef struct door_choice {
    const char *shut, *open;
    const char *shut_option; ///< what messages call --shut; NULL: so
} door_choice;

/// --shut and --open
option_table door_option_table(door_choice *doors);

/// By door of the map, whether it is shut. SL_BAD_ARGUMENT for a name that no door has.
sl_status doors_read(sl_context *context, const door_choice *doors, const sl_map *map, bool *shut);

/// Shuts doors of a baked file. Sets the state of the map's doors too, for pictures.
sl_status doors_shut(sl_context *context, const door_choice *doors, sl_baked *baked);

#endif
