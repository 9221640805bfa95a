/// Any map file that can be read, by one call.
#ifndef SIGHTLINE_IMPORT_H
#define SIGHTLINE_IMPORT_H

#include "sightline/map.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Start from sl_import_options_default().
typedef struct sl_import_options {
    bool has_slice; ///< whether `slice` is given: readers of 3D models need it
    double slice;   ///< height of the cut, in the model's unit
    /// Which of the maps of a file that holds several, by name; NULL for the only or first one.
    const char *map;
    /// The layers to take, by name, with commas between; NULL for the format's own choice.
    const char *layers;
    double tolerance; ///< how far a curve may be from its walls, in the map's unit; 0: the usual
    double threshold; ///< images: darkness from which a pixel is solid, 0 .. 1; 0: the usual
    bool doors;       ///< take doors as doors; off: as what they are when the map begins
} sl_import_options;

SL_API sl_import_options sl_import_options_default(void);

/// A format: its name, what its files' names end with (space-separated), what it is, how to read
/// it.
typedef struct sl_map_format {
    const char *name, *endings, *what;
    sl_status (*read)(sl_context *context, const char *name, const char *text, size_t size,
                      const sl_import_options *options, sl_map *map);
} sl_map_format;

/// All formats; the first is the map text.
SL_API const sl_map_format *sl_map_formats(size_t *count);

/// Reads a map file, by the ending of its name; a file with an unknown ending is read as the map
/// text. The map must be empty; on failure it stays so. SL_BAD_INPUT with file and line on a broken
/// file.
SL_API sl_status sl_map_read(sl_context *context, const char *path,
                             const sl_import_options *options, sl_map *map);

/// Cuts a UniGrafix model at a height: every face that crosses the plane gives walls. Faces in the
/// plane give none; comments that surround the model are kept as notes. What was taken is noted.
SL_API sl_status sl_map_read_unigrafix(sl_context *context, const char *name, const char *text,
                                       size_t size, const sl_import_options *options, sl_map *map);

#ifdef __cplusplus
}
#endif

#endif
