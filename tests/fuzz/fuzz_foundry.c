// Foundry's walls, with doors and without: whatever is read is written as map text and read back
// the same.
#include "fuzz.h"
#include "io/io_formats.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_tabletop(data, size, sli_map_read_foundry);
    return 0;
}
