#include "pictures.h"

#include "built.h"
#include "inputs.h"
#include "options.h"
#include "sightline/support.h"

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

sl_status sl_picture_check(sl_context *context, const char *path, const char *option,
                           const char *output) {
    if (output) SL_TRY(sl_built_need_pictures(context));
    if (!output || sl_input_ends_with(output, ".png") || sl_input_ends_with(output, ".svg") ||
        sl_input_ends_with(output, ".pdf"))
        return sl_output_check(context, path, option, output);
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: end the name in .png, .svg or .pdf", option,
                   output);
}
