/// The two steps of the first half of a bake; between them a bake chooses its method. `account`
/// may be NULL.
#ifndef SL_CELLS_H
#define SL_CELLS_H

#include "sightline/bake.h"

/// Makes the walls planar, and finds what is inside.
sl_status sli_bake_clean(sl_context *context, sl_map *map, const sl_bake_options *options,
                         sl_bake_account *account);
/// Cuts a clean map into cells, and takes it over, as sl_bake does.
sl_status sli_bake_cut(sl_context *context, sl_map *map, const sl_bake_options *options,
                       sl_baked *out, sl_bake_account *account);

#endif
