/// What is to be seen, for checks of placements: all that loops go around (overlay.h). NULL: there
/// are no loops, and all is to be seen.
#ifndef SLI_PROOF_OUTLINE_H
#define SLI_PROOF_OUTLINE_H

#include "analysis/placement/proof_corners.h"
#include "sightline/overlay.h"

/// Whether it has the beginning of a sector at a place. Exact.
bool sli_outline_has_sector(const sli_proof_scene *scene, const sl_shape *outline,
                            const sli_meet *p, const sli_direction *sector);
/// Whether it has all around a point. Exact.
bool sli_outline_holds(const sli_proof_scene *scene, const sl_shape *outline, sl_point at);
/// Adds its edges; the group of each is one lower than that of the one before, from `group` down.
sl_status sli_outline_add_parts(sl_context *context, const sl_shape *outline, uint32_t group,
                                sli_ray_parts *parts);
/// Adds directions of those edges whose lines pass a place.
sl_status sli_outline_add_directions(sl_context *context, const sl_shape *outline,
                                     const sli_meet *p, sli_directions *out);

#endif
