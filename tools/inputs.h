/// Reading what commands are given: map files and baked files, and which doors are shut.
#ifndef INPUTS_H
#define INPUTS_H

#include "sightline/bake.h"
#include "sightline/import.h"

/// Whether the name ends with `ending`, in either case of letters: ".slv".
bool sl_input_ends_with(const char *path, const char *ending);

/// A file's name without its folders and its ending: "maps/office.map" gives "office", as a place
/// in the path and a length.
const char *sl_input_base_name(const char *path, size_t *length);

/// The options of reading a map, as they are given.
typedef struct sl_input_texts {
    const char *map, *slice, *layers, *tolerance, *unit, *threshold, *weld;
    bool doors, sectors;
    bool cells; ///< the file's own cells are asked for
} sl_input_texts;

/// Those options, for a command's table of options.
#define SL_INPUT_OPTIONS(texts)                                                                    \
    {"map", 0, "NAME", NULL, &(texts).map, "which map of a file that holds several"},              \
        {"slice", 0, "Z", NULL, &(texts).slice, "cut a 3D model at this height"},                  \
        {"layers",        0,                                                                       \
         "LAYER,...",     NULL,                                                                    \
         &(texts).layers, "the layers of a drawing or tile map to take"},                          \
        {"tolerance", 0, "T", NULL, &(texts).tolerance, "how far curves may be from their walls"}, \
        {"unit",        0,                                                                         \
         "UNIT",        NULL,                                                                      \
         &(texts).unit, "of a drawing, turned into this: mm cm m km in ft yd"},                    \
        {"weld",                                                                                   \
         0,                                                                                        \
         "T",                                                                                      \
         NULL,                                                                                     \
         &(texts).weld,                                                                            \
         "join wall ends up to this far apart, in map units;\n0: none (default: on oblique maps, " \
         "2^-46 of the\nlargest coordinate)"},                                                     \
        {"threshold",                                                                              \
         0,                                                                                        \
         "T",                                                                                      \
         NULL,                                                                                     \
         &(texts).threshold,                                                                       \
         "darkness from which a pixel is solid, up to 1"},                                         \
        {"sectors",                                                                                \
         0,                                                                                        \
         NULL,                                                                                     \
         &(texts).sectors,                                                                         \
         NULL,                                                                                     \
         "cut cells between the sectors of a Doom map too: for\na REJECT that hides more"},        \
    {                                                                                              \
        "doors", 0, NULL, &(texts).doors, NULL,                                                    \
            "take doors as doors; without it as what they are\nwhen the map begins"                \
    }

/// Reads a map file. A baked file is refused.
sl_status sl_input_read_map(sl_context *context, const char *path, const sl_input_texts *texts,
                            sl_map *map);

/// Cleans a map as --weld asks for. `account` may be NULL.
sl_status sl_input_clean(sl_context *context, const sl_input_texts *texts, sl_map *map,
                         sl_clean_account *account);

/// Reads a baked file. A map file, which is known by its ending, is refused with how to bake it.
sl_status sl_input_read_baked(sl_context *context, const char *path, sl_baked *baked);

/// SL_BAD_ARGUMENT where one of these options is given with a baked file.
sl_status sl_input_refuse_texts(sl_context *context, const char *path, const sl_input_texts *texts);

/// Before the work is done: SL_BAD_ARGUMENT where what `option` names to be written is no name, or
/// the input `path` itself, which it would replace; SL_IO where nothing can be written there. A
/// NULL output is none.
sl_status sl_output_check(sl_context *context, const char *path, const char *option,
                          const char *output);

/// Likewise for what is to be a baked file, which is known by its ending.
sl_status sl_output_check_baked(sl_context *context, const char *path, const char *option,
                                const char *output);

/// Reads a map file, or what map a baked file was made from.
sl_status sl_input_read_either(sl_context *context, const char *path, const sl_input_texts *texts,
                               sl_map *map);

/// Prints the formats of maps that can be read.
void sl_input_print_formats(void);

/// SL_BAD_ARGUMENT: the point that an option or operand gives lies outside the map's bounds.
sl_status sl_input_fail_outside(sl_context *context, const char *name, const char *text,
                                sl_box bounds);

/// Shuts the doors of a baked file that --shut names: "a,b", or "none"; without it (NULL) those
/// that the map says are shut. The map's doors are then as that says, for pictures. SL_BAD_ARGUMENT
/// for a name that is no door's.
sl_status sl_doors_shut(sl_context *context, const char *text, sl_baked *baked);

#endif
