/// A viewpoint as checks of placements see it: an eye (proof_sight.h), its cone, its range and its
/// dead zone. All borders are straight, so that corners are decided exactly:
///
///        ___                 A polygon within the circle stands for a range, and one around the
///      /     \  range        circle for a dead zone: what is between counts as not seen.
///     |  (o)  |
///      \ ___ /
#ifndef SLI_PROOF_VIEW_H
#define SLI_PROOF_VIEW_H

#include "analysis/placement/proof_corners.h"
#include "sightline/query.h"
#include "sightline/viewpoint.h"

/// A convex polygon around an eye, counter-clockwise. Without corners, there is none.
typedef struct sli_ring {
    sl_point *corners;
    uint32_t count;
    double shift;        ///< angle of the first corner from +x, in steps from one to the next
    double inner, outer; ///< distances from the eye between which all its edges are
} sli_ring;

/// How much a viewpoint is to see.
typedef enum sli_view_share {
    SLI_VIEW_BARE,  ///< no polygons: its range and its dead zone are to be asked of
                    ///< sli_proof_view_reaches() or sli_proof_view_holds()
    SLI_VIEW_WHOLE, ///< all but up to 2e-6 of its range and its dead zone
    SLI_VIEW_LESS,  ///< surely no more than up to 0.9999 of the range, and from 1.0002 of the dead
                    ///< zone; surely up to 0.9995, and from 1.0006
} sli_view_share;

typedef struct sli_proof_view {
    const sli_eye *eye;
    sl_view cone;
    bool wide; ///< the cone is over half a turn
    sli_ring reach, dead;
    sl_box box; ///< holds all that is seen
    double range, nearest;
} sli_proof_view;

/// `eye` and `eye_box` are of its place, and stay there. SL_UNSUPPORTED where a circle is too small
/// for its coordinates. On failure it is empty.
sl_status sli_proof_view_make(sl_context *context, const sl_query *query,
                              const sl_viewpoint *viewpoint, const sli_eye *eye, sl_box eye_box,
                              sli_view_share share, sli_proof_view *out);
void sli_proof_view_destroy(sl_context *context, sli_proof_view *view);

/// Whether a point is within the true range and out of the dead zone: borders included, or
/// `strictly`.
bool sli_proof_view_reaches(const sli_proof_view *view, sl_point at, bool strictly);
/// The same, for a point that the eye sees, and whether it is within the cone.
bool sli_proof_view_holds(const sli_proof_view *view, sl_point at, bool strictly);
/// Whether it sees all around a place. False where that is doubtful.
bool sli_proof_view_sees_around(const sli_proof_scene *scene, const sli_proof_view *view,
                                const sli_meet *p);
/// Whether it sees the beginning of a sector at a place.
bool sli_proof_view_sees_sector(const sli_proof_scene *scene, const sli_proof_view *view,
                                const sli_meet *p, const sli_direction *sector);
/// Adds directions of lines through a place at which its region ends.
sl_status sli_proof_view_add_directions(sl_context *context, const sli_proof_scene *scene,
                                        const sli_proof_view *view, const sli_meet *p,
                                        sli_directions *out);
/// Adds the parts of lines on which its region ends. `number`: of the view.
sl_status sli_proof_view_add_parts(sl_context *context, const sli_proof_scene *scene,
                                   const sli_proof_view *view, uint32_t number,
                                   sli_ray_parts *parts);

#endif
