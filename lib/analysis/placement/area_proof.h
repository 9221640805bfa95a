/// What files and checks of proofs among given places share.
#ifndef SLI_AREA_PROOF_H
#define SLI_AREA_PROOF_H

#include "sightline/place_proof.h"

/// Refuses what proofs do not know: networks, the most that a number of places sees, walls to scan,
/// and effects of the map.
sl_status sli_area_proof_refuse(sl_context *context, sl_query *query, const sl_place_area *area);

#endif
