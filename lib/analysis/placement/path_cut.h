/// The parts of a path where something holds.
#ifndef SLI_PATH_CUT_H
#define SLI_PATH_CUT_H

#include "sightline/overlay.h"
#include "sightline/path_parts.h"
#include "sightline/support.h"

/// What is asked of a path. Zero the rest.
typedef struct sli_path_cut {
    sl_context *context;
    const sl_space *space; ///< that the path must be in
    /// Cuts a segment of the path wherever the answer may change, and maybe elsewhere.
    sl_status (*cut)(struct sli_path_cut *cut, sl_point p, sl_point q);
    /// Whether it holds at a place.
    sl_status (*holds)(struct sli_path_cut *cut, sl_point at, bool *out);
    void *of;
    SL_ARRAY(double) cuts; ///< of the segment at hand, 0 to 1
    SL_ARRAY(sl_path_part) parts;
    double piece;       ///< length of the piece that is asked
    double done, least; ///< length of the segments before; of parts
} sli_path_cut;

/// The parts of a path where it holds. SL_BAD_ARGUMENT for a point outside the bounds, and for less
/// than 2 points.
sl_status sli_path_parts(sli_path_cut *cut, const sl_point *path, size_t count, sl_path_parts *out);
/// Cuts the segment pq where the outline of a shape crosses it, and where it touches it.
sl_status sli_cut_by_shape(sli_path_cut *cut, sl_point p, sl_point q, const sl_shape *shape);
/// Where it crosses a circle.
sl_status sli_cut_by_circle(sli_path_cut *cut, sl_point p, sl_point q, sl_point middle,
                            double radius);

#endif
