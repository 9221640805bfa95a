/// The sight of a set of points: what its files share.
#ifndef SL_SET_SIGHT_INTERNAL_H
#define SL_SET_SIGHT_INTERNAL_H

#include "analysis/set_sight/beams.h"
#include "sightline/set_sight.h"

/// A side at a place that sight does not pass, and the way from the place along it. `leftward`: it
/// stops sight that comes from the left of this way and crosses to its right; else the other.
typedef struct sli_block {
    sl_point along;
    bool from_left;
} sli_block;

/// What is around a place: the rooms that it is in or on, by the side that starts there, or is
/// there, or any; and the sides there that stop sight.
typedef struct sli_spot {
    sl_point at;
    SL_ARRAY(uint32_t) rooms;
    SL_ARRAY(sli_block) blocks;
} sli_spot;

/// Parts of a region: loops, and of which shape each is.
typedef struct sli_parts {
    SL_ARRAY(sl_point) points;
    SL_ARRAY(size_t) ends;   ///< by loop, as sl_shape has them
    size_t open;             ///< the first point of the loop that grows
    sli_ray last;            ///< where it ends
    const sl_segment *chord; ///< beyond it nothing is added now; NULL: all is
    uint64_t cones;
} sli_parts;

/// A circle is as many chords.
enum { SLI_RANGE_SECTORS = 64 };

struct sl_set_sight {
    sl_query *query;
    double range;  ///< 0: none
    double within; ///< as far as walks go: the range, or 0 for all, as for complete visibility
    sl_point directions[SLI_RANGE_SECTORS]; ///< of the ends of a circle's chords
    sli_beam_rooms rooms;
    sl_set_kind kind;
    sl_point *points;
    size_t count;
    sli_walk walk;
    sli_spot spot, corner;
    SL_ARRAY(sli_beam) seen; ///< what an eye sees of a segment
    SL_ARRAY(sli_ray) cuts;
    SL_ARRAY(sl_point) ends; ///< of walls, on the set
    sl_bits *touched;        ///< cells
    uint32_t *stops;         ///< sides that stop sight forwards or backwards
    uint32_t stop_count;
};

/// The segments of a set; a polygon has one for each corner.
static inline size_t sli_segment_count(const struct sl_set_sight *s) {
    return s->kind == SL_SET_AREA ? s->count : s->count - 1;
}

static inline sl_segment sli_segment(const struct sl_set_sight *s, size_t i) {
    return (sl_segment){s->points[i], s->points[i + 1 < s->count ? i + 1 : 0]};
}

/// Finds what is around a place, on both sides of walls, but in no solid ground.
sl_status sli_spot_find(sl_context *context, struct sl_set_sight *s, sl_point at, sli_spot *out);

/// From where on a segment a spot is seen that is not in line with it, as beams from the spot
/// (s->seen); those that are thinner than rounding are left out. Exact: from some piece that is in
/// range, and from the whole segment, of which some is in range.
sl_status sli_reach(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                    sl_segment segment, bool *some, bool *whole);

/// Adds the cones of all corners behind which points of a segment see.
sl_status sli_add_cones(sl_context *context, struct sl_set_sight *s, sl_segment segment,
                        sli_parts *parts);

/// Adds what is seen from a spot. `towards`, which may be NULL: what is seen from next to it, on
/// the way to this point.
sl_status sli_add_eye(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                      const sl_point *towards, sli_parts *parts);

/// Adds what is seen within a beam from a spot, and before a chord across it, if that is not NULL.
/// `beam` NULL: all around.
sl_status sli_add_beam(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                       const sli_beam *beam, const sl_segment *chord, sli_parts *parts);

// --- within a range (range.c)

void sli_range_directions(sl_point out[SLI_RANGE_SECTORS]);

/// How far eyes on a segment may stand apart, and how far from the crossing of a wall.
double sli_range_step(double range);
double sli_range_beside(double range);

/// Adds the circle about a place.
sl_status sli_add_circle(sl_context *context, const struct sl_set_sight *s, sl_point at,
                         sli_parts *parts);

/// As sli_add_eye() and for one cone, within the range.
sl_status sli_add_eye_in_range(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                               sli_parts *parts);
sl_status sli_add_cone_in_range(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                                sl_segment segment, const sli_beam *beam, sli_parts *parts);

/// Whether some of a side, from its right end to its left one as the eye sees it, is in range of
/// the eye within a beam that meets all of it. Exact. Always without a range.
bool sli_is_in_range(const struct sl_set_sight *s, sl_point eye, const sli_beam *beam,
                     sl_segment side);

/// Ends the last loop. Loops without an area are dropped.
sl_status sli_parts_close(sl_context *context, sli_parts *parts);
void sli_parts_destroy(sl_context *context, sli_parts *parts);

#endif
