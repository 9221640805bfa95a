// What exists to compare and to teach: a generated map.
#include <sightline/generate.h>

#include <stdio.h>

int main(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    sl_generate_options options = sl_generate_options_default();
    sl_map map = {0};
    sl_status status = sl_generate(context, &kinds[0], &options, &map);
    printf("%s: %s, %zu walls\n", sl_status_name(status), kinds[0].name, map.wall_count);
    const bool good = status == SL_OK && map.wall_count > 0;
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return good ? 0 : 1;
}
