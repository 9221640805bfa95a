// ROS' map.yaml: what names a picture that is not there is refused, all else too.
#include "fuzz.h"
#include "io/io_formats.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    const sl_import_options options = sl_import_options_default();
    fuzz_read(context, data, size, sli_map_read_ros, &options, NULL);
    sl_context_destroy(context);
    return 0;
}
