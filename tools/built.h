/// What a build may leave out. Where a part is off, one file without_PART.c stands in its place: it
/// refuses, by name, the commands and formats that need the part.
#ifndef BUILT_H
#define BUILT_H

#include "sightline/context.h"

/// Adds foreign formats to those that the context reads and writes, or formats that refuse.
sl_status built_use_formats(sl_context *context);

/// SL_UNSUPPORTED where the build has no pictures.
sl_status built_need_pictures(sl_context *context);

#endif
