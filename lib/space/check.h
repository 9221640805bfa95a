/// What the checks of kd-trees and of meshes share.
#ifndef SL_SPACE_CHECK_H
#define SL_SPACE_CHECK_H

#include "sightline/space.h"
#include "sightline/support.h"

/// The check of a space that knows its sides, of which counts and bounds are checked.
sl_status sl_check_mesh(sl_context *context, const sl_space *space);

/// The check of a directed portal against its portal. `directed_found`, by portal: 1 for the
/// directed portal of cell[0], 2 for that of cell[1]; each may be there once.
sl_status sl_check_directed(sl_context *context, const sl_space *space, uint32_t cell,
                            const sl_directed_portal *directed, uint8_t *directed_found);

#endif
