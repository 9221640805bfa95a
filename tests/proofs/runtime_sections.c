// The header and the table of sections of a hostile file: no byte behind the file is read, and
// every section that is found lies within it. A header alone with its checksum; files of up to two
// sections and 8 bytes more, as a longer one repeats the same steps.
//
// unwind 25
#include "proof.h"

#define SLRT_BIG_ENDIAN // numbers byte by byte
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

enum { MOST = SLRT_HEADER_BYTES + 2 * SLRT_ENTRY_BYTES + 8 };

void sections_lie_in_the_file(void) {
    const size_t size = nondet_ulong();
    ASSUME(size >= SLRT_HEADER_BYTES && size <= MOST);
    ANY_BYTES(bytes, MOST, size);
    // What slrt_check_header leaves open once it is passed.
    ASSUME(slrt_u32(bytes + 24) <= (size - SLRT_HEADER_BYTES) / SLRT_ENTRY_BYTES);
    slrt_section found[SLRT_TAGS] = {{0}};
    slrt_find_sections(bytes, size, found);
    const int tag = nondet_int();
    ASSUME(tag >= 0 && tag < SLRT_TAGS && found[tag].items);
    const uint64_t offset = (uint64_t)(found[tag].items - bytes);
    PROVE(offset <= size && found[tag].count <= size - offset);
}
