/// Which parts of a path no viewpoint sees: as text, as a table, in JSON, and as lines of a
/// picture.
#ifndef COVER_PATH_H
#define COVER_PATH_H

#include "sightline/support.h"
#include "studies/cover_report.h"

/// Zeroed, it is empty.
typedef struct cover_path {
    sl_point *points; ///< of the path
    size_t count;
    sl_path_parts found;
    SL_ARRAY(sl_segment) unseen; ///< the parts, piece by piece
} cover_path;

/// Reads the path --path NAME, of the map or a table, and finds the parts. Notes walls across it.
sl_status cover_path_make(sl_context *context, const cover_report *report, sl_query *query,
                          const sl_viewpoint *viewpoints, const char *name, cover_path *out);
/// Finds the parts of the path whose points are there.
sl_status cover_path_find(sl_context *context, const cover_report *report, sl_query *query,
                          const sl_viewpoint *viewpoints, cover_path *path);
void cover_path_destroy(sl_context *context, cover_path *path);

/// A line for the path, and one for each of the longest parts.
void cover_path_print(const cover_report *report, const cover_path *path);
/// "path"
void cover_path_add_json(json_fields *fields, const cover_path *path);
/// Writes a table (.csv): a row a part.
sl_status cover_path_write(sl_context *context, const cover_path *path, const char *name);

#endif
