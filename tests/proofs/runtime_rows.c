// Rows of visible sets and of view cells in a hostile file: the check reads no byte
// behind the rows, and what it lets pass is read by the calls without leaving them either. Rows of
// up to 5 bytes, of up to 2 cells.
//
// unwind 7
#include "proof.h"

#define SLRT_BIG_ENDIAN // numbers byte by byte
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

enum { MOST = 5, CELLS = 2 };

void a_number_is_passed_within_its_row(void) {
    const size_t size = nondet_ulong();
    ASSUME(size <= MOST);
    ANY_BYTES(bytes, MOST, size);
    const unsigned char *next = bytes, *at = bytes;
    if (!slrt_pass_number(&next, bytes + size)) return;
    PROVE(next > bytes && next <= bytes + size);
    slrt_number(&at);
    PROVE(at == next);
}

/// A file of rows alone.
static sl_runtime any_file(const unsigned char *rows, const unsigned char *offsets) {
    sl_runtime rt = {0};
    rt.cell_count = CELLS;
    rt.row_bytes = rows;
    rt.row_offsets = offsets;
    return rt;
}

void rows_are_checked_and_read(void) {
    const size_t size = nondet_ulong();
    ASSUME(size <= MOST);
    ANY_BYTES(rows, MOST, size);
    ANY_BYTES(offsets, (CELLS + 1) * 8, (CELLS + 1) * 8);
    const sl_runtime rt = any_file(rows, offsets);
    if (!slrt_rows_are_sound(&rt, size, nondet_bool())) return;
    const uint32_t cell = nondet_uint();
    ASSUME(cell < CELLS);
    sl_runtime_run run = sl_runtime_row(&rt, cell);
    uint32_t end = 0;
    while (sl_runtime_next(&run)) {
        PROVE(run.first < run.end && run.end <= rt.cell_count && run.first >= end);
        end = run.end;
    }
}
