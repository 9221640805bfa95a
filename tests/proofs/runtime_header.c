// The header of a hostile file: no byte behind the file is read, and what passes has room for its
// table of sections. Files of up to 33 bytes.
//
// unwind 257
#include "proof.h"

#define SLRT_BIG_ENDIAN // numbers byte by byte
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

enum { MOST = 33 };

void a_header_is_read_within_the_file(void) {
    const size_t size = nondet_ulong();
    ASSUME(size <= MOST);
    ANY_BYTES(bytes, MOST, size);
    if (slrt_check_header(bytes, size) != SL_RUNTIME_OK) return;
    PROVE(size >= SLRT_HEADER_BYTES);
    PROVE(slrt_u32(bytes + 24) <= (size - SLRT_HEADER_BYTES) / SLRT_ENTRY_BYTES);
}
