// The pictures that need cairo: a name with an unknown ending is refused, and
// a frame shows all of a map.
#include <sightline/draw.h>

#include <stdio.h>

int main(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    sl_baked baked = {0};
    sl_draw_options options = sl_draw_options_default();
    sl_status status = sl_draw_file(context, &baked, &options, "picture.doc");
    printf("%s: %s\n", sl_status_name(status), sl_context_message(context));
    sl_context_destroy(context);
    const sl_frame frame = sl_frame_fit((sl_box){{0, 0}, {4, 3}}, 0, 0, 800, 600, 1);
    if (frame.scale != 200) return 1;
    return status == SL_BAD_ARGUMENT ? 0 : 1;
}
