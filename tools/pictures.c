#include "pictures.h"

#include "base/base.h"
#include "inputs.h"
#include "options.h"

sl_status sl_picture_plan(sl_context *context, const char *width, const char *title, bool dark,
                          sl_draw_options *out) {
    *out = sl_draw_options_default();
    out->dark = dark;
    out->title = title;
    SL_TRY(sl_option_number(context, "--width", width, &out->width));
    if (out->width >= SL_DRAW_WIDTH_MIN && out->width <= SL_DRAW_WIDTH_MAX) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "--width %s: a number from %d to %d is needed", width,
                   SL_DRAW_WIDTH_MIN, SL_DRAW_WIDTH_MAX);
}

sl_status sl_picture_check_name(sl_context *context, const char *option, const char *path) {
    if (!path || sl_input_ends_with(path, ".png") || sl_input_ends_with(path, ".svg") ||
        sl_input_ends_with(path, ".pdf"))
        return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: end the name in .png, .svg or .pdf", option,
                   path);
}
