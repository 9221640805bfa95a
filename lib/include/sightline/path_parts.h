/// Parts of a path: from where is something seen, or not seen?
#ifndef SIGHTLINE_PATH_PARTS_H
#define SIGHTLINE_PATH_PARTS_H

#include "sightline/context.h"
#include "sightline/geometry.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A part of a path.
typedef struct sl_path_part {
    double from, to;     ///< how far along the path, in map units
    sl_point start, end; ///< rounded
} sl_path_part;

/// Zeroed, it is empty.
typedef struct sl_path_parts {
    double length, total; ///< of the path, and of its parts
    sl_path_part *parts;  ///< in the order of the path; none meets the next
    size_t count;
} sl_path_parts;

SL_API void sl_path_parts_destroy(sl_context *context, sl_path_parts *parts); ///< and zeroes it

#ifdef __cplusplus
}
#endif

#endif
