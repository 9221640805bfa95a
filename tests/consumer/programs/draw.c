// The pictures that need cairo: a name with an unknown ending is refused.
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
    return status == SL_BAD_ARGUMENT ? 0 : 1;
}
