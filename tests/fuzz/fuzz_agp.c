// AGPLIB: whatever is read is written as map text and read back the same.
#include "fuzz.h"
#include "io/io_formats.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    fuzz_read(context, data, size, sli_map_read_agp, NULL, NULL);
    sl_context_destroy(context);
    return 0;
}
