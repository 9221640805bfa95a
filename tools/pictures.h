/// The options of pictures, shared by the commands that draw.
#ifndef PICTURES_H
#define PICTURES_H

#include "sightline/draw.h"

/// Fills what all pictures have; `width` is what --width was given, or NULL. SL_BAD_ARGUMENT.
sl_status sl_picture_plan(sl_context *context, const char *width, const char *title, bool dark,
                          sl_draw_options *out);

/// SL_BAD_ARGUMENT where an option names a picture of no kind that can be written; a NULL path is
/// no picture.
sl_status sl_picture_check_name(sl_context *context, const char *option, const char *path);

#endif
