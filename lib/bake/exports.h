/// The exports that the table lists.
#ifndef SL_EXPORTS_H
#define SL_EXPORTS_H

#include "sightline/bake.h"

sl_status sl_export_json(sl_context *context, const sl_baked *baked, const char *path);

#endif
