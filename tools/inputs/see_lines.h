/// Lines of a plan by name: its doors and its paths, and the points of a table.
#ifndef SEE_LINES_H
#define SEE_LINES_H

#include "sightline/bake.h"
#include "sightline/support.h"

/// Zeroed, it is empty. A thing is one or more segments.
typedef struct see_lines {
    SL_ARRAY(sl_segment) segments; ///< of all things
    SL_ARRAY(size_t) ends;         ///< by thing: the number of segments up to its last one
    SL_ARRAY(char *) names;        ///< by thing
} see_lines;

/// Takes names of doors and paths out of `text`, a list with commas between. `rest` gets those that
/// objects have; the caller frees it (sl_free), also after a failure. A shut door is seen from one
/// side only, so both of its sides are lines. Refuses --see with a name that nothing has.
sl_status see_lines_take(sl_context *context, const char *text, const sl_baked *baked,
                         see_lines *out, char **rest);
/// Adds the path --path NAME: one of the map, or the points of a table.
sl_status see_lines_add_path(sl_context *context, const char *name, const sl_map *map,
                             see_lines *out);
/// Refuses lines that leave the map's bounds.
sl_status see_lines_check(sl_context *context, const sl_baked *baked, const see_lines *lines);
/// The thing of a segment.
size_t see_lines_of(const see_lines *lines, size_t segment);
void see_lines_destroy(sl_context *context, see_lines *lines); ///< and zeroes it

#endif
