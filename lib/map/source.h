/// What readers note of a map's file (sl_map_source), and how messages name its lines.
#ifndef SL_MAP_SOURCE_H
#define SL_MAP_SOURCE_H

#include "sightline/map.h"

/// Adds a line to the notes.
sl_status sli_map_add_note(sl_context *context, sl_map *map, const char *text);

/// Adds the file's own name for a line. Lines come in ascending order. A line with several names
/// keeps the first, and says that there are others. Control characters become '?', and long names
/// are cut.
sl_status sli_map_add_label(sl_context *context, sl_map *map, uint32_t line, const char *text);

/// Fails, and says which line of the map is at fault: "FILE:12: layer WALLS, handle 1F: what is
/// wrong", or "FILE: linedef 117: what is wrong".
sl_status sli_map_fail(sl_context *context, const sl_map *map, sl_status status, uint32_t line,
                       const char *format, ...) SL_PRINTF(5, 6);

/// Adds a comment, as sl_comment says; lines go up.
sl_status sli_map_add_comment(sl_context *context, sl_map *map, const char *text, size_t length,
                              uint32_t line, bool behind);

/// Adds the first line of a text of the drawing (sl_map_source.texts) that has more than blanks;
/// nothing where there is none, and where it lies beyond the coordinates of a map.
sl_status sli_source_add_text(sl_context *context, sl_map_source *source, const char *text,
                              size_t length, sl_point at, double height);

/// The transform of a file with y down, whose y `top` is 0 in the map.
static inline sl_transform sli_y_down(double top, double scale) {
    return (sl_transform){.origin = {0, top}, .scale = scale, .y_down = true};
}

/// What messages call the map.
static inline const char *sli_map_name(const sl_map *map) {
    return map->source.name ? map->source.name : "the map";
}

void sli_source_destroy(sl_context *context, sl_map_source *source); ///< and zeroes it

/// A deep copy. On failure `to` holds a part, to be destroyed.
sl_status sli_source_copy(sl_context *context, const sl_map_source *from, sl_map_source *to);

#endif
