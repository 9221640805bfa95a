// Formats of other programs: without sightline_io a context reads two, with it many more.
#include <sightline/io.h>

#include <stdio.h>

int main(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    size_t before, after;
    sl_map_formats(context, &before);
    sl_status status = sl_io_use(context);
    sl_map_formats(context, &after);
    printf("%s: %zu formats, then %zu\n", sl_status_name(status), before, after);
    sl_context_destroy(context);
    return status == SL_OK && before == 2 && after > 10 ? 0 : 1;
}
