/// The options of pictures, shared by the commands that draw.
#ifndef PICTURES_H
#define PICTURES_H

#include "sightline/draw.h"

/// Fills what all pictures have; `width` is what --width was given, or NULL. SL_BAD_ARGUMENT.
sl_status sl_picture_plan(sl_context *context, const char *width, const char *title, bool dark,
                          sl_draw_options *out);

/// As sl_output_check() of inputs.h, and SL_BAD_ARGUMENT where the name is that of no kind of
/// picture that can be written.
sl_status sl_picture_check(sl_context *context, const char *path, const char *option,
                           const char *output);

#endif
