// The one public header serves C++ too.
#include <sightline/sightline.h>

#include <cstdio>

int main() {
    sl_context *context = sl_context_create(nullptr);
    if (!context) return 1;
    sl_map map = sl_map();
    sl_status status = sl_map_parse(context, "none", "wall", 4, nullptr, &map);
    std::printf("%s: %s\n", sl_status_name(status), sl_context_message(context));
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return status == SL_BAD_INPUT ? 0 : 1;
}
