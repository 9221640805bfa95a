/// What files and checks of proofs among given places share.
#ifndef SLI_AREA_PROOF_H
#define SLI_AREA_PROOF_H

#include "analysis/placement/proof_corners.h"
#include "sightline/place_proof.h"

/// Refuses what proofs do not know: networks, the most that a number of places sees, walls to scan,
/// and effects of the map.
sl_status sli_area_proof_refuse(sl_context *context, sl_query *query, const sl_place_area *area);
/// *most: how many of `count` places see all of one sector at a point, close to it; of the sectors
/// between borders of views, that which most see. `which`: numbers of places (area_proof_sector.c).
sl_status sli_area_proof_sector(sl_context *context, sl_query *query, const sli_proof_scene *scene,
                                const sl_viewpoint *places, const uint32_t *which, uint32_t count,
                                sl_point at, uint32_t *most);

#endif
