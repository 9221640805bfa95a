/// Reading what commands are given: map files and baked files.
#ifndef INPUTS_H
#define INPUTS_H

#include "sightline/bake.h"
#include "sightline/import.h"

/// Whether the name ends with `ending`, in either case of letters: ".slv".
bool sl_input_ends_with(const char *path, const char *ending);

/// A file's name without its folders and its ending: "maps/office.map" gives "office", as a place
/// in the path and a length.
const char *sl_input_base_name(const char *path, size_t *length);

/// Reads a map file. `slice` is the text of --slice, NULL where it is not given. A baked file is
/// refused.
sl_status sl_input_read_map(sl_context *context, const char *path, const char *slice, sl_map *map);

/// Reads a baked file. A map file, which is known by its ending, is refused with how to bake it.
sl_status sl_input_read_baked(sl_context *context, const char *path, sl_baked *baked);

/// SL_BAD_ARGUMENT where --slice is given with a baked file.
sl_status sl_input_refuse_slice(sl_context *context, const char *path, const char *slice);

/// SL_BAD_ARGUMENT where the output is no name, or the input itself, which it would replace.
sl_status sl_input_refuse_output(sl_context *context, const char *path, const char *output);

/// Reads a map file, or what map a baked file was made from.
sl_status sl_input_read_either(sl_context *context, const char *path, const char *slice,
                               sl_map *map);

/// Prints the formats of maps that can be read.
void sl_input_print_formats(void);

/// Whether each wall is parallel to an axis; counts those that are not.
size_t sl_input_count_oblique(const sl_wall *walls, size_t count);

/// SL_BAD_ARGUMENT: the point that an option or operand gives lies outside the map's bounds.
sl_status sl_input_fail_outside(sl_context *context, const char *name, const char *text,
                                sl_box bounds);

#endif
