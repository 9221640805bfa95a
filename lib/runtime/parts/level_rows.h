/// Rows: which cells see which, with doors as they stand, by mirror, and from view cells.

SL_RUNTIME_API sl_runtime_run sl_runtime_row(const sl_runtime *runtime, uint32_t cell) {
    sl_runtime_run run;
    run.first = run.end = 0;
    run.next = run.stop = NULL;
    if (cell < runtime->cell_count) {
        const bool own = runtime->row_offsets != NULL;
        const unsigned char *offsets = own ? runtime->row_offsets : runtime->view_offsets;
        const unsigned char *bytes = own ? runtime->row_bytes : runtime->view_bytes;
        const uint32_t row = own ? cell : slrt_u32(runtime->views + (size_t)cell * 4);
        if (row == SL_RUNTIME_NO_CELL) return run;
        run.next = bytes + slrt_u64(offsets + (size_t)row * 8);
        run.stop = bytes + slrt_u64(offsets + (size_t)row * 8 + 8);
    }
    return run;
}

SL_RUNTIME_API bool sl_runtime_next(sl_runtime_run *run) {
    if (run->next == run->stop) return false;
    run->first = run->end + slrt_number(&run->next);
    run->end = run->first + slrt_number(&run->next);
    return true;
}

/// Whether the row of a cell reaches into the part of the cells that another one is in. Most rows
/// do not, and are not read.
static bool slrt_may_see(const sl_runtime *rt, uint32_t from, uint32_t to) {
    if (!rt->row_parts) return true;
    return from < rt->cell_count && to < rt->cell_count &&
           (slrt_u64(rt->row_parts + (size_t)from * 8) >> (to >> rt->part_shift) & 1) != 0;
}

SL_RUNTIME_API bool sl_runtime_can_see(const sl_runtime *runtime, uint32_t from, uint32_t to) {
    sl_runtime_run run;
    if (!slrt_may_see(runtime, from, to)) return false;
    run = sl_runtime_row(runtime, from);
    while (sl_runtime_next(&run))
        if (to < run.end) return to >= run.first;
    return false;
}

/// Reads the alternatives of a pair. Whether one of them has no shut door.
static bool slrt_is_open(const unsigned char **next, const unsigned char *shut) {
    uint32_t alternatives = slrt_number(next);
    bool any = false;
    for (; alternatives; alternatives--) {
        uint32_t doors = slrt_number(next), door = UINT32_MAX;
        bool open = true;
        for (; doors; doors--) {
            door += 1 + slrt_number(next);
            open = open && !shut[door];
        }
        any = any || open;
    }
    return any;
}

/// The pairs of a cell that depend on doors, by the second cell, ascending.
typedef struct slrt_door_pairs {
    const unsigned char *next, *stop;
    uint32_t cell; ///< of the last pair that was read
    bool open;     ///< whether that pair is seen
} slrt_door_pairs;

static slrt_door_pairs slrt_door_pairs_of(const sl_runtime *rt, uint32_t from) {
    slrt_door_pairs pairs;
    pairs.next = pairs.stop = NULL;
    pairs.cell = UINT32_MAX;
    pairs.open = true;
    if (rt->door_offsets) {
        pairs.next = rt->door_bytes + slrt_u64(rt->door_offsets + (size_t)from * 8);
        pairs.stop = rt->door_bytes + slrt_u64(rt->door_offsets + (size_t)from * 8 + 8);
    }
    return pairs;
}

/// Whether a pair of the row is seen. The second cell never goes down from one call to the next.
static bool slrt_pair_is_open(slrt_door_pairs *pairs, uint32_t to, const unsigned char *shut) {
    while ((pairs->cell == UINT32_MAX || pairs->cell < to) && pairs->next != pairs->stop) {
        pairs->cell += 1 + slrt_number(&pairs->next);
        pairs->open = slrt_is_open(&pairs->next, shut);
    }
    return pairs->cell != to || pairs->open;
}

SL_RUNTIME_API bool sl_runtime_can_see_past(const sl_runtime *runtime, uint32_t from, uint32_t to,
                                            const unsigned char *shut) {
    slrt_door_pairs pairs;
    if (!sl_runtime_can_see(runtime, from, to)) return false;
    if (!shut) return true;
    pairs = slrt_door_pairs_of(runtime, from);
    return slrt_pair_is_open(&pairs, to, shut);
}

SL_RUNTIME_API bool sl_runtime_has_row(const sl_runtime *runtime, uint32_t cell) {
    const sl_runtime_run run = sl_runtime_row(runtime, cell);
    return run.next != run.stop;
}

SL_RUNTIME_API bool sl_runtime_is_inside(const sl_runtime *runtime, uint32_t cell) {
    return cell < runtime->cell_count &&
           slrt_u32(runtime->cells + (size_t)cell * SLRT_CELL_BYTES + 16) != 0;
}

SL_RUNTIME_API bool sl_runtime_is_solid(const sl_runtime *runtime, uint32_t cell) {
    return cell < runtime->cell_count &&
           slrt_u32(runtime->cells + (size_t)cell * SLRT_CELL_BYTES + 20) != 0;
}

SL_RUNTIME_API uint32_t sl_runtime_row_count(const sl_runtime *runtime, uint32_t cell) {
    sl_runtime_run run = sl_runtime_row(runtime, cell);
    uint32_t count = 0;
    while (sl_runtime_next(&run)) count += run.end - run.first;
    return count;
}

/// Adds a row to bits.
static void slrt_unpack(const sl_runtime *rows, uint32_t row, unsigned char *bits) {
    sl_runtime_run run = sl_runtime_row(rows, row);
    uint32_t i;
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++) bits[i / 8] |= (unsigned char)(1 << i % 8);
}

SL_RUNTIME_API void sl_runtime_row_bits(const sl_runtime *runtime, uint32_t cell,
                                        unsigned char *bits) {
    memset(bits, 0, ((size_t)runtime->cell_count + 7) / 8);
    slrt_unpack(runtime, cell, bits);
}

/// Adds the row of a cell. Returns how many cells are new.
static uint32_t slrt_add_row(const sl_runtime *rt, uint32_t from, const unsigned char *shut,
                             unsigned char *bits) {
    sl_runtime_run run = sl_runtime_row(rt, from);
    slrt_door_pairs pairs;
    uint32_t added = 0, i;
    if (run.next == run.stop) return 0;
    pairs = slrt_door_pairs_of(rt, from);
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++) {
            if (bits[i / 8] >> i % 8 & 1) continue;
            if (shut && !slrt_pair_is_open(&pairs, i, shut)) continue;
            bits[i / 8] |= (unsigned char)(1 << i % 8);
            added++;
        }
    return added;
}

SL_RUNTIME_API uint32_t sl_runtime_seen_from(const sl_runtime *runtime, const uint32_t *cells,
                                             uint32_t count, const unsigned char *shut,
                                             unsigned char *bits) {
    uint32_t i, seen = 0;
    memset(bits, 0, ((size_t)runtime->cell_count + 7) / 8);
    for (i = 0; i < count; i++) seen += slrt_add_row(runtime, cells[i], shut, bits);
    return seen;
}

// --- what is seen by mirror

SL_RUNTIME_API sl_runtime_run sl_runtime_mirrored_row(const sl_runtime *runtime, uint32_t cell) {
    const sl_runtime rows = slrt_mirrored(runtime);
    return sl_runtime_row(&rows, rows.row_offsets ? cell : SL_RUNTIME_NO_CELL);
}

SL_RUNTIME_API bool sl_runtime_can_see_mirrored(const sl_runtime *runtime, uint32_t from,
                                                uint32_t to, const unsigned char *shut) {
    sl_runtime rows;
    if (runtime->mirrors == SL_RUNTIME_MIRRORS_NOT_BAKED)
        return from < runtime->cell_count && to < runtime->cell_count;
    if (sl_runtime_can_see_past(runtime, from, to, shut)) return true;
    if (!runtime->mirrors) return false;
    rows = slrt_mirrored(runtime);
    return sl_runtime_can_see_past(&rows, from, to, shut);
}

SL_RUNTIME_API uint32_t sl_runtime_seen_from_mirrored(const sl_runtime *runtime,
                                                      const uint32_t *cells, uint32_t count,
                                                      const unsigned char *shut,
                                                      unsigned char *bits) {
    const sl_runtime rows = slrt_mirrored(runtime);
    uint32_t i, seen = 0;
    memset(bits, 0, ((size_t)runtime->cell_count + 7) / 8);
    if (runtime->mirrors == SL_RUNTIME_MIRRORS_NOT_BAKED && count) {
        for (i = 0; i < runtime->cell_count; i++) bits[i / 8] |= (unsigned char)(1 << i % 8);
        return runtime->cell_count;
    }
    for (i = 0; i < count; i++) {
        seen += slrt_add_row(runtime, cells[i], shut, bits);
        if (rows.row_offsets) seen += slrt_add_row(&rows, cells[i], shut, bits);
    }
    return seen;
}

// --- view cells

SL_RUNTIME_API uint32_t sl_runtime_view_cell(const sl_runtime *runtime, uint32_t cell) {
    if (!runtime->view_cell_count || cell >= runtime->cell_count) return SL_RUNTIME_NO_CELL;
    return slrt_u32(runtime->views + (size_t)cell * 4);
}

SL_RUNTIME_API bool sl_runtime_view_can_see(const sl_runtime *runtime, uint32_t view_cell,
                                            uint32_t to) {
    uint32_t node = view_cell < runtime->view_cell_count ? view_cell : SL_RUNTIME_NO_CELL;
    const sl_runtime rows = slrt_view_rows(runtime);
    while (node != SL_RUNTIME_NO_CELL) {
        if (sl_runtime_can_see(&rows, node, to)) return true;
        node = slrt_u32(runtime->view_parents + (size_t)node * 4);
    }
    return false;
}

SL_RUNTIME_API void sl_runtime_view_bits(const sl_runtime *runtime, uint32_t view_cell,
                                         unsigned char *bits) {
    uint32_t node = view_cell < runtime->view_cell_count ? view_cell : SL_RUNTIME_NO_CELL;
    const sl_runtime rows = slrt_view_rows(runtime);
    memset(bits, 0, ((size_t)runtime->cell_count + 7) / 8);
    while (node != SL_RUNTIME_NO_CELL) {
        slrt_unpack(&rows, node, bits);
        node = slrt_u32(runtime->view_parents + (size_t)node * 4);
    }
}
