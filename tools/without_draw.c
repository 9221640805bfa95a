// A build without sightline_draw: pictures are refused before any work is done for them.
#include "built.h"
#include "commands.h"
#include "sightline/draw.h"
#include "sightline/support.h"

sl_status built_need_pictures(sl_context *context) {
    return sl_fail(context, SL_UNSUPPORTED, "this build has no pictures (SIGHTLINE_DRAW is off)");
}

sl_status cmd_draw(command_console *console, int argc, char **argv) {
    (void)argc, (void)argv;
    return built_need_pictures(console->context);
}

sl_draw_options sl_draw_options_default(void) {
    return (sl_draw_options){.width = SL_DRAW_WIDTH_MIN};
}

sl_status sl_draw_file(sl_context *context, const sl_baked *baked, const sl_draw_options *options,
                       const char *path) {
    (void)baked, (void)options, (void)path;
    return built_need_pictures(context);
}

sl_status sl_draw_explanation(sl_context *context, const sl_baked *baked,
                              const sl_explanation *explanation, const sl_draw_options *options,
                              const char *path) {
    (void)baked, (void)explanation, (void)options, (void)path;
    return built_need_pictures(context);
}

sl_status sl_draw_eye(sl_context *context, const sl_baked *baked, const sl_view *view,
                      const sl_eye_layer *layers, size_t layer_count, const sl_drawn_region *parts,
                      size_t part_count, const sl_draw_options *options, const char *path) {
    (void)baked, (void)view, (void)layers, (void)layer_count, (void)parts, (void)part_count;
    (void)options, (void)path;
    return built_need_pictures(context);
}

sl_status sl_draw_regions_file(sl_context *context, const sl_baked *baked,
                               const sl_drawn_region *regions, size_t count, const char *caption,
                               const sl_draw_options *options, const char *path) {
    (void)baked, (void)regions, (void)count, (void)caption, (void)options, (void)path;
    return built_need_pictures(context);
}

sl_status sl_draw_field_file(sl_context *context, const sl_baked *baked, const sl_field *field,
                             const sl_draw_options *options, const char *path) {
    (void)baked, (void)field, (void)options, (void)path;
    return built_need_pictures(context);
}

sl_status sl_draw_lines_file(sl_context *context, const sl_baked *baked,
                             const sl_drawn_lines *lines, const sl_draw_options *options,
                             const char *path) {
    (void)baked, (void)lines, (void)options, (void)path;
    return built_need_pictures(context);
}

sl_status sl_draw_patches_file(sl_context *context, const sl_baked *baked,
                               const sl_patches *patches, const char *caption,
                               const sl_draw_options *options, const char *path) {
    (void)baked, (void)patches, (void)caption, (void)options, (void)path;
    return built_need_pictures(context);
}

sl_status sl_draw_chart_file(sl_context *context, const sl_chart *chart, const char *path) {
    (void)chart, (void)path;
    return built_need_pictures(context);
}
