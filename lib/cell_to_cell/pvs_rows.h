/// Making potentially visible sets (PVS) row by row.
#ifndef SL_PVS_ROWS_H
#define SL_PVS_ROWS_H

#include "cell_to_cell/rows.h"
#include "sightline/cell_to_cell.h"
#include "sightline/support.h"

/// Bytes of one or more encoded rows, growing.
typedef SL_ARRAY(uint8_t) sli_row_bytes;

/// Appends the encoding of a set of `count` possible members.
sl_status sli_row_append(sl_context *context, sli_row_bytes *bytes, const sl_bits *set,
                         uint32_t count);

/// As sli_row_append, of the members themselves, ascending; some may come several times.
sl_status sli_row_append_list(sl_context *context, sli_row_bytes *bytes, const uint32_t *cells,
                              size_t count);

/// As sli_row_append, of a set of which only some words are there: words[i] is the set's word
/// index[i], ascending, or its word i where `index` is NULL.
sl_status sli_row_append_words(sl_context *context, sli_row_bytes *bytes, const sl_bits *words,
                               const uint32_t *index, size_t count);

/// Sets the bits of a row's members.
void sli_row_add_to(const sl_pvs *pvs, uint32_t cell, sl_bits *set);

/// Likewise, without the members that are hidden while doors are shut (`shut` by door of the map;
/// NULL: all are open).
void sli_row_add_open_to(const sl_pvs *pvs, const sl_door_sets *doors, uint32_t cell,
                         const bool *shut, sl_bits *set);

/// Joins rows[0 .. count) into one PVS and frees them, also on failure.
sl_status sli_pvs_join(sl_context *context, sli_row_bytes *rows, uint32_t count, sl_pvs *out);

/// The rows that hold each cell, ascending: those of cell c are members[starts[c] ..
/// starts[c + 1]).
typedef struct sli_columns {
    uint64_t *starts;
    uint32_t *members;
} sli_columns;

/// Of rows of `count` possible members. `out` is zeroed, and to be destroyed also on failure.
sl_status sli_columns_gather(sl_context *context, const sl_pvs *rows, uint32_t count,
                             sli_columns *out);
void sli_columns_destroy(sl_context *context, sli_columns *columns);

/// The pairs (b, a) of all (a, b). Time and memory grow with the number of pairs.
sl_status sli_pvs_transpose(sl_context *context, const sl_pvs *pvs, sl_pvs *out);

/// Makes the result of a method from what it saw for sure and what it saw unless rounding erred (no
/// pairs for exact ones). `mutual`: a pair found in either direction holds in both. Sets the PVS,
/// the doubtful pairs and the counts of both.
sl_status sli_visibility_finish(sl_context *context, const sl_pvs *sure, const sl_pvs *doubtful,
                                bool mutual, sl_visibility *out);

uint64_t sli_pvs_pairs(const sl_pvs *pvs); ///< of all rows

/// The parts of the cells that each row reaches into, as bits. A part has 2^s cells, with the least
/// s for which there are at most 64 parts. `out` has room for as many as there are cells.
void sli_pvs_parts(const sl_pvs *pvs, uint64_t *out);

/// Checks rows from an untrusted file: in range, in order, ending where they should. SL_BAD_INPUT.
sl_status sli_pvs_check(sl_context *context, const sl_pvs *pvs);

// --- sets of doors

void sli_door_sets_destroy(sl_context *context, sl_door_sets *sets); ///< and zeroes it

/// Whether a pair that is seen with all doors open is seen while some are shut: `shut` by door of
/// the map. Time: the length of the row.
bool sli_door_sets_open(const sl_door_sets *sets, uint32_t from, uint32_t to, const bool *shut);

/// Checks rows from an untrusted file: in range, in order, ending where they should. SL_BAD_INPUT.
sl_status sli_door_sets_check(sl_context *context, const sl_door_sets *sets, size_t door_count);

// --- a PVS in the making

typedef struct sli_pvs_maker {
    sli_word_set row; ///< being made
    uint32_t count, made;
    uint64_t pairs; ///< of the rows made
    uint64_t *offsets;
    sli_row_bytes bytes;
    SL_ARRAY(sl_bits) words;   ///< scratch: those of the row that have any
    SL_ARRAY(uint32_t) places; ///< scratch: where they are
} sli_pvs_maker;

/// For so many rows of `members` possible members. To be destroyed also on failure.
sl_status sli_pvs_maker_create(sl_context *context, uint32_t members, uint32_t rows,
                               sli_pvs_maker *maker);
void sli_pvs_maker_destroy(sl_context *context, sli_pvs_maker *maker);

/// Adds to the row being made the members of another one.
void sli_pvs_maker_add(sli_pvs_maker *maker, const sl_pvs *pvs, uint32_t cell);

/// Makes of what was added the next row, and starts an empty one.
sl_status sli_pvs_maker_end_row(sl_context *context, sli_pvs_maker *maker);

/// The PVS, when all rows are made. The maker is then only to be destroyed.
sl_status sli_pvs_maker_finish(sl_context *context, sli_pvs_maker *maker, sl_pvs *out);

/// Adds to a set the members of a row.
void sli_word_set_add_row(sli_word_set *set, const sl_pvs *pvs, uint32_t cell);

/// Adds to a set the members of a row that another set has too.
void sli_word_set_add_common(sli_word_set *set, const sl_pvs *pvs, uint32_t cell,
                             const sli_word_set *other);

#endif
