/// The area that was explored: the union of what was seen, for fog that stays.
///
///     sl_explored *explored;
///     sl_explored_create(context, 0, &explored);
///     sl_explored_add_region(context, explored, &region); // each time that the eye has moved
///     sl_explored_area(context, explored, &shape);        // polygons with holes, to be drawn
///     sl_explored_write(context, explored, &bytes);       // into a saved game
#ifndef SIGHTLINE_EXPLORED_H
#define SIGHTLINE_EXPLORED_H

#include "sightline/overlay.h"
#include "sightline/region.h"

#ifdef __cplusplus
extern "C" {
#endif

/// An area that grows.
typedef struct sl_explored sl_explored;

/// An empty area. `resolution` 0: the area is exact, up to the rounding of places that
/// sl_overlay_make states, once for each union. Its outline may then get as many corners as all
/// regions have. Else all corners are rounded to multiples of `resolution`: each is moved once, by
/// up to 0.71 times that, and the outline has no detail below it, however much is added.
/// SL_BAD_ARGUMENT for a resolution below 0 or not finite.
SL_API sl_status sl_explored_create(sl_context *context, double resolution, sl_explored **out);
SL_API void sl_explored_destroy(sl_context *context, sl_explored *explored); ///< NULL is allowed

/// Adds what an eye sees. Arcs of a range become chords that lie within `resolution` of them, or
/// within a thousandth of the range if that is less or 0. Regions wait, and are united with the
/// area when there are as many corners of theirs as of the area. So many additions cost
/// O(n log n log n) in all, for n corners. On failure the area stays as it was.
SL_API sl_status sl_explored_add_region(sl_context *context, sl_explored *explored,
                                        const sl_region *region);
/// Adds any shape. As sl_explored_add_region; SL_BAD_ARGUMENT for coordinates that a map may not
/// have.
SL_API sl_status sl_explored_add(sl_context *context, sl_explored *explored, const sl_shape *shape);

/// The area: simple loops that meet in single points only, outer ones counter-clockwise and holes
/// clockwise. Valid until the next call with the same `explored`.
SL_API sl_status sl_explored_area(sl_context *context, sl_explored *explored, sl_shape *out);

/// Whether a point is in the area, or on its border. Exact for the area's corners as they are.
/// Time: the corners.
SL_API sl_status sl_explored_holds(sl_context *context, sl_explored *explored, sl_point point,
                                   bool *out);

/// The area as text, each number such that it reads back to the same double:
///
///     sightline-explored 1
///     resolution 0.5
///     loop 4
///     0 0
///     ...
SL_API sl_status sl_explored_write(sl_context *context, sl_explored *explored, sl_bytes *out);
/// Reads such a text. `name` is that of the file, for messages. SL_BAD_INPUT, with the line, for
/// what is none.
SL_API sl_status sl_explored_read(sl_context *context, const char *name, const char *text,
                                  size_t length, sl_explored **out);

#ifdef __cplusplus
}
#endif

#endif
