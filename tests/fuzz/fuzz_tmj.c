// Tiled as JSON, by what it says itself, by layers and by starts asked for: whatever is read is
// written as map text and read back the same.
#include "fuzz.h"
#include "io/io_formats.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_tiled(data, size, sli_map_read_tmj);
    return 0;
}
