/// What is checked of the rows when a file is opened: of cells, view cells, doors and mirrors.

/// A number of a checked row in LEB128: seven bits in a byte, low bits first, the high bit set in
/// all bytes but the last.
static uint32_t slrt_number(const unsigned char **next) {
    uint32_t number = *(*next)++;
    if (number & 0x80) {
        unsigned shift = 0;
        uint32_t byte;
        number &= 0x7f;
        do {
            shift += 7;
            byte = *(*next)++;
            number |= (byte & 0x7f) << shift;
        } while (byte & 0x80);
    }
    return number;
}

/// Skips a number of an unchecked row. False if the row ends within it, or it has more than 32
/// bits.
static bool slrt_pass_number(const unsigned char **next, const unsigned char *stop) {
    int i;
    for (i = 0; i < 5 && *next < stop; i++) {
        const unsigned char byte = *(*next)++;
        if (!(byte & 0x80)) return i < 4 || byte < 16;
    }
    return false;
}

/// The parts of the cells that a run reaches into, as bits.
static uint64_t slrt_parts_of(const sl_runtime *rt, uint64_t first, uint64_t end) {
    return (UINT64_C(2) << ((end - 1) >> rt->part_shift)) -
           (UINT64_C(1) << (first >> rt->part_shift));
}

/// A row: runs of cells, ascending, with gaps between them. The row of a cell has the cell itself.
/// A row may be empty. It reaches into the parts that are told of it.
static bool slrt_row_is_sound(const sl_runtime *rt, uint32_t cell, bool of_cell) {
    const unsigned char *next = rt->row_bytes + slrt_u64(rt->row_offsets + (size_t)cell * 8);
    const unsigned char *stop = rt->row_bytes + slrt_u64(rt->row_offsets + (size_t)cell * 8 + 8);
    const bool empty = next == stop;
    uint64_t end = 0, parts = 0;
    bool has_own = false;
    while (next < stop) {
        const unsigned char *at = next;
        uint64_t first;
        uint32_t skip, length;
        if (!slrt_pass_number(&next, stop) || !slrt_pass_number(&next, stop)) return false;
        skip = slrt_number(&at);
        length = slrt_number(&at);
        if ((!skip && end) || !length) return false;
        first = end + skip;
        end = first + length;
        if (end > rt->cell_count) return false;
        if (rt->row_parts) parts |= slrt_parts_of(rt, first, end);
        has_own = has_own || (cell >= first && cell < end);
    }
    if (rt->row_parts && parts != slrt_u64(rt->row_parts + (size_t)cell * 8)) return false;
    return has_own || empty || !of_cell;
}

static bool slrt_rows_are_sound(const sl_runtime *rt, uint64_t byte_count, bool of_cells) {
    uint64_t before = 0;
    uint32_t i;
    if (slrt_u64(rt->row_offsets) != 0) return false;
    for (i = 0; i < rt->cell_count; i++) {
        const uint64_t end = slrt_u64(rt->row_offsets + (size_t)i * 8 + 8);
        if (end < before || end > byte_count || (end != byte_count && i + 1 == rt->cell_count))
            return false;
        before = end;
        if (!slrt_row_is_sound(rt, i, of_cells)) return false;
    }
    return true;
}

/// Which parts of the cells each row reaches into, if the file tells. There are 64 parts at most.
static bool slrt_take_parts(sl_runtime *rt, const slrt_section *parts) {
    if (!parts->items || !rt->row_offsets) return true;
    rt->row_parts = parts->items;
    while ((rt->cell_count - 1) >> rt->part_shift > 63) rt->part_shift++;
    return parts->count == rt->cell_count;
}

/// The rows of view cells, to be read like rows of cells.
static sl_runtime slrt_view_rows(const sl_runtime *rt) {
    sl_runtime rows = *rt;
    rows.row_offsets = rt->view_offsets;
    rows.row_bytes = rt->view_bytes;
    rows.row_parts = NULL;
    return rows;
}

/// A node's parent comes after it, so every way up ends.
static bool slrt_view_nodes_are_sound(const sl_runtime *rt) {
    uint32_t i;
    for (i = 0; i < rt->cell_count; i++) {
        const uint32_t view = slrt_u32(rt->views + (size_t)i * 4);
        if (view != SL_RUNTIME_NO_CELL && view >= rt->view_cell_count) return false;
    }
    for (i = 0; i < rt->view_node_count; i++) {
        const uint32_t parent = slrt_u32(rt->view_parents + (size_t)i * 4);
        if (parent != SL_RUNTIME_NO_CELL && (parent <= i || parent >= rt->view_node_count))
            return false;
    }
    return true;
}

/// If cells have no rows, each view cell has all that it sees in one row, its own cells among it.
static bool slrt_stands_for_cells(const sl_runtime *rt) {
    uint32_t i;
    for (i = 0; i < rt->view_node_count; i++)
        if (slrt_u32(rt->view_parents + (size_t)i * 4) != SL_RUNTIME_NO_CELL) return false;
    for (i = 0; i < rt->cell_count; i++)
        if (slrt_u32(rt->views + (size_t)i * 4) != SL_RUNTIME_NO_CELL &&
            !sl_runtime_can_see(rt, i, i))
            return false;
    return true;
}

/// View cells, if the file has any.
static bool slrt_open_views(const slrt_section *found, sl_runtime *rt) {
    sl_runtime rows;
    int tag;
    if (!found[SLRT_VCIN].items) return true;
    for (tag = SLRT_VCIN; tag <= SLRT_VCRB; tag++)
        if (!found[tag].items) return false;
    if (found[SLRT_VCIN].count != 1) return false;
    rt->view_cell_count = slrt_u32(found[SLRT_VCIN].items);
    rt->view_node_count = slrt_u32(found[SLRT_VCIN].items + 4);
    if (found[SLRT_VCEL].count != rt->cell_count || found[SLRT_VCPA].count != rt->view_node_count ||
        found[SLRT_VCRO].count != (uint64_t)rt->cell_count + 1 ||
        rt->view_cell_count > rt->view_node_count || rt->view_node_count > rt->cell_count)
        return false;
    rt->views = found[SLRT_VCEL].items;
    rt->view_parents = found[SLRT_VCPA].items;
    rt->view_offsets = found[SLRT_VCRO].items;
    rt->view_bytes = found[SLRT_VCRB].items;
    rows = slrt_view_rows(rt);
    return slrt_view_nodes_are_sound(rt) &&
           slrt_rows_are_sound(&rows, found[SLRT_VCRB].count, false) &&
           (rt->row_offsets || slrt_stands_for_cells(rt));
}

/// An alternative of a pair: doors in ascending order.
static bool slrt_doors_are_sound(const sl_runtime *rt, const unsigned char **next,
                                 const unsigned char *stop) {
    const unsigned char *at = *next;
    uint64_t door = 0;
    uint32_t count, i;
    if (!slrt_pass_number(next, stop)) return false;
    count = slrt_number(&at);
    for (i = 0; i < count; i++) {
        if (!slrt_pass_number(next, stop)) return false;
        door += slrt_number(&at) + (uint64_t)(i > 0);
        if (door >= rt->door_count) return false;
    }
    return count > 0;
}

static bool slrt_door_row_is_sound(const sl_runtime *rt, uint32_t row) {
    const unsigned char *next = rt->door_bytes + slrt_u64(rt->door_offsets + (size_t)row * 8);
    const unsigned char *stop = rt->door_bytes + slrt_u64(rt->door_offsets + (size_t)row * 8 + 8);
    uint64_t cell = 0;
    bool first = true;
    for (; next < stop; first = false) {
        const unsigned char *at = next;
        uint32_t count, i;
        if (!slrt_pass_number(&next, stop) || !slrt_pass_number(&next, stop)) return false;
        cell += slrt_number(&at) + (uint64_t)!first;
        count = slrt_number(&at);
        if (cell >= rt->cell_count || !count) return false;
        for (i = 0; i < count; i++)
            if (!slrt_doors_are_sound(rt, &next, stop)) return false;
    }
    return true;
}

/// The portals on seams, by portal, so that they can be searched. There are as many doors as seams
/// name, or more.
static bool slrt_take_seams(sl_runtime *rt, const slrt_section *found) {
    const uint64_t count = found[SLRT_SEPO].items ? found[SLRT_SEPO].count : 0;
    uint64_t i;
    uint32_t before = 0;
    rt->seams = found[SLRT_SEAM].items;
    rt->seam_portals = found[SLRT_SEPO].items;
    if (found[SLRT_SEAM].count > UINT32_MAX) return false;
    if (rt->seams) rt->seam_count = (uint32_t)found[SLRT_SEAM].count;
    if (count > UINT32_MAX || (count && !rt->seams)) return false;
    for (i = 0; i < rt->seam_count; i++) {
        const unsigned char *seam = rt->seams + i * 40;
        const uint32_t number = slrt_u32(seam + 36);
        if (!slrt_usable(seam, 4)) return false;
        if (slrt_u32(seam + 32) != 1) continue;
        if (number >= INT32_MAX) return false;
        if (number >= rt->door_count) rt->door_count = number + 1;
    }
    rt->seam_portal_count = (uint32_t)count;
    for (i = 0; i < count; i++) {
        const unsigned char *on = rt->seam_portals + i * 12;
        const uint32_t portal = slrt_u32(on);
        if (portal < before || portal >= rt->portal_count) return false;
        if (slrt_u32(on + 4) >= found[SLRT_SEAM].count) return false;
        before = portal;
        rt->has_glass =
            rt->has_glass || slrt_u32(rt->seams + slrt_u32(on + 4) * (size_t)40 + 32) == 2;
    }
    return true;
}

static bool slrt_take_walls(sl_runtime *rt, const slrt_section *found) {
    uint32_t i;
    rt->walls = found[SLRT_WALL].items;
    if (found[SLRT_WALL].count > UINT32_MAX) return false;
    rt->wall_count = (uint32_t)found[SLRT_WALL].count;
    for (i = 0; i < rt->wall_count; i++)
        if (!slrt_usable(rt->walls + (size_t)i * 32, 4)) return false;
    return true;
}

/// The rows of door sets of `rt`, whose doors are counted.
static bool slrt_door_rows_are_sound(const sl_runtime *rt, const slrt_section *offsets,
                                     const slrt_section *bytes) {
    uint64_t i, before = 0;
    if (!rt->door_offsets && !rt->door_bytes) return true;
    if (!rt->door_offsets || !rt->door_bytes || offsets->count != (uint64_t)rt->cell_count + 1)
        return false;
    for (i = 0; i <= rt->cell_count; i++) {
        const uint64_t end = slrt_u64(rt->door_offsets + i * 8);
        if (end < before || end > bytes->count || (!i && end)) return false;
        before = end;
    }
    for (i = 0; i < rt->cell_count; i++)
        if (!slrt_door_row_is_sound(rt, (uint32_t)i)) return false;
    return true;
}

/// The doors are known.
static bool slrt_take_doors(sl_runtime *rt, const slrt_section *found) {
    rt->door_offsets = found[SLRT_DORO].items;
    rt->door_bytes = found[SLRT_DORB].items;
    return slrt_door_rows_are_sound(rt, &found[SLRT_DORO], &found[SLRT_DORB]);
}

/// What is seen by mirror, to be read like what is seen directly.
static sl_runtime slrt_mirrored(const sl_runtime *rt) {
    sl_runtime rows = *rt;
    rows.row_offsets = rt->mirror_offsets;
    rows.row_bytes = rt->mirror_bytes;
    rows.row_parts = NULL;
    rows.door_offsets = rt->mirror_door_offsets;
    rows.door_bytes = rt->mirror_door_bytes;
    return rows;
}

/// Rows of what is seen by mirror, if the file has any.
static bool slrt_take_mirrors(sl_runtime *rt, const slrt_section *found) {
    sl_runtime rows;
    rt->mirror_offsets = found[SLRT_MIRO].items;
    rt->mirror_bytes = found[SLRT_MIRB].items;
    rt->mirror_door_offsets = found[SLRT_MDOO].items;
    rt->mirror_door_bytes = found[SLRT_MDOB].items;
    if (!rt->mirror_offsets)
        return !rt->mirror_bytes && !rt->mirror_door_offsets && !rt->mirror_door_bytes;
    if (!rt->mirror_bytes || found[SLRT_MIRO].count != (uint64_t)rt->cell_count + 1) return false;
    rt->mirrors = SL_RUNTIME_MIRRORS_BAKED;
    rows = slrt_mirrored(rt);
    return slrt_rows_are_sound(&rows, found[SLRT_MIRB].count, false) &&
           slrt_door_rows_are_sound(&rows, &found[SLRT_MDOO], &found[SLRT_MDOB]);
}
