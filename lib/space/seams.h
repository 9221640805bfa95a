/// Seams while a space is made: cut into parts, so that two parts are equal or do not overlap.
#ifndef SL_SEAMS_H
#define SL_SEAMS_H

#include "sightline/space.h"
#include "space/kd_tree.h"

/// A seam, as a part of it knows it.
typedef struct sli_seam_mark {
    uint32_t seam;
    bool along; ///< it runs from the part's a to its b
} sli_seam_mark;

/// A segment with the same seams along all of it: marks[first .. first + count). a comes before b,
/// by x, then y.
typedef struct sli_seam_part {
    sl_point a, b;
    size_t first, count;
} sli_seam_part;

/// Two parts in one line share an end at most. All ends of parts are ends of seams.
typedef struct sli_seam_parts {
    SL_ARRAY(sli_seam_part) parts; ///< by a, then b
    SL_ARRAY(sli_seam_mark) marks;
} sli_seam_parts;

/// Gives the space the seams of a map, without those of no length. With `axial`, SL_BAD_INPUT names
/// the first that is not axial.
sl_status sli_seams_of_map(sl_context *context, const sl_map *map, bool axial, sl_space *space);

/// Cuts the space's seams. `out` is zeroed; destroy it also on failure.
sl_status sli_seams_part(sl_context *context, const sl_space *space, sli_seam_parts *out);
void sli_seam_parts_destroy(sl_context *context, sli_seam_parts *parts);

/// Walls and axial parts together, sorted by line. A wall comes before a part that starts with it.
sl_status sli_seam_lines(sl_context *context, const sli_piece *walls, size_t wall_count,
                         const sli_seam_parts *parts, sli_piece **out);

/// Lists the portals on seams, where all is axial.
sl_status sli_seams_tag_axial(sl_context *context, const sli_seam_parts *parts, sl_space *space);

/// Checks that seams and the portals on them are in range, in order and within the bounds; with
/// `axial`, that seams are axial. SL_BAD_INPUT.
sl_status sli_seams_check(sl_context *context, const sl_space *space, bool axial);

/// Whether two portals lie on the same seams.
bool sli_seams_same(const sl_space *space, uint32_t portal, uint32_t other);

#endif
