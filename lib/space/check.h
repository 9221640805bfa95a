/// What the checks of kd-trees and of meshes share.
#ifndef SL_SPACE_CHECK_H
#define SL_SPACE_CHECK_H

#include "base/base.h"
#include "sightline/space.h"

/// The check of a space that knows its sides, of which counts and bounds are checked.
sl_status sl_check_mesh(sl_context *context, const sl_space *space);

/// The check of an exit against its portal. `exits_found`, by portal: 1 for the exit of cell[0], 2
/// for that of cell[1]; each may be there once.
sl_status sl_check_exit(sl_context *context, const sl_space *space, uint32_t cell,
                        const sl_exit *exit, uint8_t *exits_found);

#endif
