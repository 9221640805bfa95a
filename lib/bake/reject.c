#include "bake/reject.h"

#include "bake/cell_sectors.h"
#include "sightline/support.h"

#include <string.h>

typedef struct reject_maker {
    sl_context *context;
    const sl_space *space;
    const sl_pvs *pvs;
    sl_cell_sectors cells;
    size_t count;   ///< of sectors
    size_t words;   ///< of a row of sectors
    sl_bits *seen;  ///< a row for each sector
    size_t unknown; ///< sectors that no cell reaches into, or of which a cell was not looked at
} reject_maker;

static sl_bits *row_of(const reject_maker *make, size_t sector) {
    return make->seen + sector * make->words;
}

/// All sectors that cells seen from this one reach into.
static void collect_seen(const reject_maker *make, uint32_t cell, sl_bits *row) {
    const sl_cell_sectors *cells = &make->cells;
    memset(row, 0, make->words * sizeof *row);
    for (sl_pvs_run r = sl_pvs_begin(make->pvs, cell); sl_pvs_next(&r);)
        for (uint32_t i = cells->first[r.first]; i < cells->first[r.end]; i++)
            sl_bits_add(row, cells->sectors[i]);
}

static void see_all(const reject_maker *make, size_t sector) {
    memset(row_of(make, sector), 0xff, make->words * sizeof(sl_bits));
}

static sl_status spread_rows(reject_maker *make, sl_bits *row, bool *reached) {
    const sl_cell_sectors *cells = &make->cells;
    for (uint32_t cell = 0; cell < make->space->cell_count; cell++) {
        if (cell % 256 == 0) SL_TRY(sl_check_cancelled(make->context));
        if (cells->first[cell] == cells->first[cell + 1]) continue;
        const bool looked = sl_pvs_count(make->pvs, cell) > 0;
        collect_seen(make, cell, row);
        for (uint32_t i = cells->first[cell]; i < cells->first[cell + 1]; i++) {
            const uint32_t sector = cells->sectors[i];
            sl_bits *seen = row_of(make, sector);
            for (size_t w = 0; w < make->words; w++) seen[w] |= row[w];
            reached[sector] |= looked;
            // Nothing is known of what a cell sees that the bake did not look from.
            if (!looked) see_all(make, sector);
        }
    }
    for (size_t i = 0; i < make->count; i++) {
        make->unknown += !reached[i];
        if (!reached[i]) see_all(make, i);
    }
    return SL_OK;
}

static sl_status find_seen(reject_maker *make) {
    const size_t count = make->count;
    make->words = sl_bits_words(count);
    if (count && make->words > SIZE_MAX / 64 / count) return sl_fail_memory(make->context);
    make->seen = sl_alloc_array(make->context, count * make->words, sizeof(sl_bits));
    sl_bits *row = sl_alloc_array(make->context, make->words, sizeof *row);
    bool *reached = sl_alloc_array(make->context, count, sizeof *reached);
    const sl_status status =
        make->seen && row && reached ? spread_rows(make, row, reached) : SL_NO_MEMORY;
    sl_free(make->context, row);
    sl_free(make->context, reached);
    return status;
}

/// The lump: a bit for each ordered pair, set where it is hidden. Sight goes both ways: a pair of
/// which one sees the other is not hidden.
static sl_status make_lump(const reject_maker *make, sl_reject *out) {
    const size_t count = make->count;
    out->size = (count * count + 7) / 8;
    out->bytes = sl_alloc_array(make->context, out->size, 1);
    if (!out->bytes) return SL_NO_MEMORY;
    for (size_t a = 0; a < count; a++) {
        SL_TRY(sl_check_cancelled(make->context));
        for (size_t b = 0; b < count; b++) {
            if (a == b || sl_bits_has(row_of(make, a), b) || sl_bits_has(row_of(make, b), a))
                continue;
            const size_t bit = a * count + b;
            out->bytes[bit / 8] |= (unsigned char)(1u << bit % 8);
            out->account.hidden += a < b;
        }
    }
    return SL_OK;
}

sl_status sl_reject_make(sl_context *context, const sl_space *space, const sl_pvs *pvs,
                         const sl_doom_level *level, sl_reject *out) {
    reject_maker make = {
        .context = context, .space = space, .pvs = pvs, .count = level->sector_count};
    sl_reject made = {.account = {.sectors = (uint32_t)make.count, .cells = space->cell_count}};
    sl_status status = sl_cell_sectors_find(context, space, level, &make.cells);
    if (status == SL_OK) status = find_seen(&make);
    if (status == SL_OK) status = make_lump(&make, &made);
    made.account.unknown = (uint32_t)make.unknown;
    sl_cell_sectors_destroy(context, &make.cells);
    sl_free(context, make.seen);
    if (status == SL_OK)
        *out = made;
    else
        sl_reject_destroy(context, &made);
    return status;
}

void sl_reject_destroy(sl_context *context, sl_reject *reject) {
    sl_free(context, reject->bytes);
    *reject = (sl_reject){0};
}
