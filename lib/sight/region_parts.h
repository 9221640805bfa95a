/// What the parts of making a visible region share: rays from the eye, pieces seen between two
/// rays, and the polygon as it grows. region.c expands, region_polygon.c writes and cuts the
/// polygon, mirrored.c does the same for eyes in mirrors, sees.c casts single rays.
#ifndef SL_REGION_PARTS_H
#define SL_REGION_PARTS_H

#include "geometry/orient.h"
#include "sightline/region.h"
#include "sightline/support.h"
#include "space/index.h"

/// A ray from the eye through a point other than it: a corner of the space, or a cone's border.
typedef struct sli_eye_ray {
    sl_point at, offset; ///< the point, and the point less the eye: each coordinate rounded once
    sl_point rest;       ///< of the point, as that of sli_fine; 0 unless the eye is fine
} sli_eye_ray;

/// Where rays start. `fine`: the eye is an image in mirrors, and it or a ray's point has a rest.
typedef struct sli_eye_place {
    sli_fine point;
    bool fine;
    double slack; ///< of a fine eye: the error of a x b for two offsets, beyond what
                  ///< sli_turn_filter allows for
} sli_eye_place;

/// The rest of a room that waits: from the start of `side` to the ray `left`.
typedef struct sli_region_frame {
    uint32_t side;
    uint32_t entry; ///< the portal that the room is seen through, as a side of it; plus
                    ///< SLI_REGION_LIMITED if the way to the room passes a limited wall
    sli_eye_ray left;
} sli_region_frame;

/// The part of a side, no portal, that is seen: up to the ray `left`.
typedef struct sli_region_piece {
    uint32_t neighbour; ///< as that of sl_side, or the seam of a limited wall; SLI_PIECE_FAR: all
                        ///< of it is out of range
    sl_point a, b;      ///< the side
    sli_eye_ray left;
    bool to_end; ///< the side's own end lies on `left` and is seen; else `left` meets it within
} sli_region_piece;

#define SLI_PIECE_FAR UINT32_MAX

#define SLI_REGION_LIMITED UINT32_C(0x80000000)

/// The part of a mirror, on one side of a room, that is seen between two rays.
typedef struct sli_reflected_view {
    uint32_t side, mirror;
    sli_eye_ray right, left;
} sli_reflected_view;

typedef struct sli_region_corner {
    sl_point point, offset;
    sl_region_edge edge;
} sli_region_corner;

/// The lower envelope of the sides of boxes about an eye (past_boxes.h).
typedef struct sli_box_envelope {
    const sl_moving_box *boxes;
    SL_ARRAY(uint32_t) arcs; ///< the memory of `count` arcs, counter-clockwise from +x
    size_t count;
} sli_box_envelope;

struct sli_region_memory {
    sli_eye_place eye;
    const struct sli_room_mirrors *mirrors; ///< reflected views are taken of these; NULL for none
    SL_ARRAY(sli_reflected_view) reflected_views; ///< counter-clockwise
    sli_box_envelope envelope;                    ///< of the boxes; empty for none
    SL_ARRAY(sli_region_frame) frames;
    SL_ARRAY(uint32_t) fan; ///< the sides seen from the eye's rooms, counter-clockwise
    double limit;           ///< see sli_eye_limit
    bool open;              ///< the fan does not go all round: it ends at walls
    uint32_t right, left;   ///< where it is open: the walls at the eye that it starts and ends at
    bool pending;           ///< `piece` is started, but its end is not added yet
    sli_region_piece piece;
    uint32_t first;                    ///< what the first piece lies on
    size_t room;                       ///< of points, offsets and edges
    SL_ARRAY(sli_region_corner) whole; ///< the region before its range was cut
};

/// For a fine eye, as the two functions below. The offset is good to little more than one rounding.
sli_eye_ray sli_eye_ray_fine(const sli_eye_place *eye, const sli_fine *at);
int sli_eye_turn_fine(const sli_eye_place *eye, const sli_eye_ray *a, const sli_eye_ray *b);

static inline sli_eye_place sli_eye_place_at(sl_point eye) {
    return (sli_eye_place){.point.at = eye};
}

static inline sli_eye_ray sli_eye_ray_through(const sli_eye_place *eye, sl_point at) {
    if (eye->fine) return sli_eye_ray_fine(eye, &(sli_fine){.at = at});
    return (sli_eye_ray){.at = at, .offset = {at.x - eye->point.at.x, at.y - eye->point.at.y}};
}

/// Which side of the ray a the ray b is on: 1 left, -1 right, 0 in line. Exact.
static inline int sli_eye_turn(const sli_eye_place *eye, const sli_eye_ray *a,
                               const sli_eye_ray *b) {
    if (eye->fine) return sli_eye_turn_fine(eye, a, b);
    const int sign = sli_turn_filter(a->offset, b->offset);
    if (sign) return sign;
    if (a->at.x == b->at.x && a->at.y == b->at.y) return 0;
    return sli_orient(eye->point.at, a->at, b->at);
}

/// Whether an eye sees through a side. One-way glass is a wall from both sides where it is dark for
/// the eye, and else open from both. For an eye on its line the eye's cell decides.
bool sli_region_leads_on(const sl_outline *outline, uint32_t side, uint32_t eye_cell, sl_point eye);

/// The seam of the limited wall that a side is on; SL_NO_SEAM for none.
static inline uint32_t sli_region_limit(const sl_outline *outline, uint32_t side) {
    return outline->limited ? outline->limited[side] : SL_NO_SEAM;
}

/// The other side of a portal, or of glass.
uint32_t sli_region_across(const sl_outline *outline, uint32_t side);

/// Gathers the fan about the eye, given the cell that it is located in.
sl_status sli_region_gather_fan(sl_context *context, const sl_outline *outline, sl_region *region);

/// The limit of sli_turn_filter_within for any two rays to corners or to the cone's borders: one
/// for all, from the largest possible products. Closer calls go to the exact predicate.
static inline double sli_eye_limit(const sl_space *space, const sl_view *view) {
    const sl_box *b = &space->bounds;
    const sl_point eye = view->eye;
    sl_point reach = {fmax(eye.x - b->min.x, b->max.x - eye.x),
                      fmax(eye.y - b->min.y, b->max.y - eye.y)};
    if (!view->full) {
        reach.x = fmax(reach.x, fmax(fabs(view->right.x - eye.x), fabs(view->left.x - eye.x)));
        reach.y = fmax(reach.y, fmax(fabs(view->right.y - eye.y), fabs(view->left.y - eye.y)));
    }
    return sli_turn_limit(reach, reach);
}

/// The offset of the ray through a point.
static inline sl_point sli_eye_offset(const sli_eye_place *eye, sl_point at) {
    if (eye->fine) return sli_eye_ray_fine(eye, &(sli_fine){.at = at}).offset;
    return (sl_point){at.x - eye->point.at.x, at.y - eye->point.at.y};
}

/// As sli_eye_turn for the ray through a point.
int sli_eye_turn_close(const sli_eye_place *eye, const sli_eye_ray *ray, sl_point at);

/// The same, given the point's offset and the limit of the view. Of most corners a walk around a
/// room needs no more, so no ray is made for them.
static inline int sli_eye_turn_to(const sli_eye_place *eye, const sli_eye_ray *ray, sl_point at,
                                  sl_point offset, double limit) {
    const int sign = sli_turn_filter_within(ray->offset, offset, limit);
    if (sign || (!eye->fine && sli_same_point(ray->at, at))) return sign;
    return sli_eye_turn_close(eye, ray, at);
}

/// The side of the fan that a ray meets, one end of each side counted: just counter-clockwise of
/// the ray (`onward`) or just clockwise of it. UINT32_MAX for none.
uint32_t sli_region_find_side(const sl_outline *outline, const sl_region *region,
                              const sli_eye_ray *ray, bool onward);

/// Finds the side by which a ray leaves a room that it enters through `entry`: the first side
/// around the room that ends to the left of the ray. *within says whether the ray passes within the
/// entry (else through its right end), and is set to whether it passes within that side (else
/// through its start). False where there is none, which happens only in a loose space.
static inline bool sli_region_find_first(const sl_outline *o, const sli_eye_place *eye,
                                         double limit, uint32_t entry, const sli_eye_ray *ray,
                                         uint32_t *at, bool *within) {
    const sl_side *sides = o->sides;
    for (uint32_t i = sides[entry].next; i != entry;) {
        const uint32_t next = sides[i].next;
        const sl_point end = sides[next].start;
        const int turn = sli_eye_turn_to(eye, ray, end, sli_eye_offset(eye, end), limit);
        if (turn > 0) {
            *at = i;
            return true;
        }
        *within = turn < 0;
        i = next;
    }
    return false;
}

/// Starts the next piece, counter-clockwise, at the ray `right` or, where that is NULL, at the
/// start of the side from a to b. The caller fills in the rest of the piece, which is then pending.
sl_status sli_region_start_piece(sl_context *context, sl_region *region, uint32_t neighbour,
                                 const sli_eye_ray *a, const sli_eye_ray *b,
                                 const sli_eye_ray *right);
/// Adds the eye as a point, with the kind of the edge that starts there.
sl_status sli_region_add_eye(sl_context *context, sl_region *region, sl_edge_kind kind);
/// Ends the pending piece with an edge along the border to the eye, which is the next point or was
/// the first.
sl_status sli_region_end_at_eye(sl_context *context, sl_region *region);
/// Ends the polygon.
sl_status sli_region_close(sl_context *context, sl_region *region);

/// The point, less the eye, where a ray meets the line through a and b; the caller knows that it
/// does. Good to a few units in the last place of each coordinate.
sl_point sli_region_meet(sl_point eye, const sli_eye_ray *ray, sl_point a, sl_point b);

/// Cuts the region to its range.
sl_status sli_region_cut_range(sl_context *context, sl_region *region);

/// Checks the arguments of sli_region_make.
sl_status sli_region_check_view(sl_context *context, const sl_view *view, double range);
/// Empties a region and makes its memory ready for a view.
sl_status sli_region_start(sl_context *context, const sl_outline *outline, const sl_view *view,
                           double range, sl_region *region);
/// Makes the region of a view after sli_region_start, and takes reflected views on the way.
sl_status sli_region_spread(sl_context *context, const sl_outline *outline, sl_region *region);
/// Adds what a reflected view shows: a cone into the room through a piece of one of its sides, from
/// an eye (the image) behind that side.
sl_status sli_region_look_in(sl_context *context, const sl_outline *outline, sl_region *region,
                             const sli_reflected_view *reflected);
/// Adds the point where a ray meets the mirror from a to b, with the edge that starts there. A
/// pending piece ends with an edge along the ray to that point.
sl_status sli_region_add_on_mirror(sl_context *context, sl_region *region, const sli_eye_ray *ray,
                                   sl_point a, sl_point b, sl_region_edge edge);
/// Cuts the region of a part to its range. Its last edge lies along the mirror.
sl_status sli_region_cut_mirrored(sl_context *context, sl_region *region);
/// Frees what a region needs while it is made, and keeps the region.
void sli_region_settle(sl_context *context, sl_region *region);

#endif
