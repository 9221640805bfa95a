/// Seams while a space is made: cut into parts, so that where they overlap they do so wholly.
#ifndef SL_SEAMS_H
#define SL_SEAMS_H

#include "sightline/space.h"
#include "space/kd_tree.h"

/// A seam that a part is of.
typedef struct sl_seam_mark {
    uint32_t seam;
    bool along; ///< it runs from the part's a to its b
} sl_seam_mark;

/// A segment, from the lower x, then y, on which the same seams lie all along: marks[first ..
/// first + count).
typedef struct sl_seam_part {
    sl_point a, b;
    size_t first, count;
} sl_seam_part;

/// No two parts that are in line share more than an end. All ends are seams' ends.
typedef struct sl_seam_parts {
    SL_ARRAY(sl_seam_part) parts; ///< by a, then b
    SL_ARRAY(sl_seam_mark) marks;
} sl_seam_parts;

/// Gives the space the seams of a map, those of no length left out. SL_BAD_INPUT names the first
/// that is not axial, where `axial` asks for it.
sl_status sl_seams_of_map(sl_context *context, const sl_map *map, bool axial, sl_space *space);

/// Cuts the space's seams. `out` is zeroed, and to be destroyed whatever comes.
sl_status sl_seams_part(sl_context *context, const sl_space *space, sl_seam_parts *out);
void sl_seam_parts_destroy(sl_context *context, sl_seam_parts *parts);

/// Walls and axial parts together, sorted by line. A wall comes before a part that starts there.
sl_status sl_seam_lines(sl_context *context, const sl_piece *walls, size_t wall_count,
                        const sl_seam_parts *parts, sl_piece **out);

/// Gives the space the portals on its seams, where all is axial.
sl_status sl_seams_tag_axial(sl_context *context, const sl_seam_parts *parts, sl_space *space);

/// Checks the numbers of a space's seams and of the portals on them: in range, in order, within the
/// bounds, axial where `axial` asks for it. SL_BAD_INPUT.
sl_status sl_seams_check(sl_context *context, const sl_space *space, bool axial);

/// Whether two portals lie on the same seams.
bool sl_seams_same(const sl_space *space, uint32_t portal, uint32_t other);

#endif
