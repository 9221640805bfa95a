/// Portals on seams, and what walls stop that do not stop all.

/// The first of items whose first number, by which they ascend, is not below `number`.
static uint32_t slrt_first_item(const unsigned char *items, uint32_t count, size_t item_bytes,
                                uint32_t number) {
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (slrt_u32(items + middle * item_bytes) < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// The first entry of a portal among the portals on seams, or where it would be.
static uint32_t slrt_first_seam(const sl_runtime *rt, uint32_t portal) {
    return slrt_first_item(rt->seam_portals, rt->seam_portal_count, 12, portal);
}

/// What a seam stops; 0 for most.
static uint32_t slrt_seam_stops(const sl_runtime *rt, uint32_t seam) {
    return rt->stops ? slrt_u32(rt->stops + (size_t)seam * 4) &
                           (SL_RUNTIME_STOPS_ALL | SL_RUNTIME_STOPS_LIMITED)
                     : 0;
}

/// The first passage of a cell, or where it would be.
static uint32_t slrt_first_passage(const sl_runtime *rt, uint32_t cell) {
    return slrt_first_item(rt->passages, rt->passage_count, SLRT_PASSAGE_BYTES, cell);
}

/// The next passage of a cell that steps take, from a number on; passage_count for none.
static uint32_t slrt_next_way(const sl_runtime *rt, uint32_t cell, uint32_t from) {
    for (; from < rt->passage_count; from++) {
        const unsigned char *at = rt->passages + (size_t)from * SLRT_PASSAGE_BYTES;
        if (slrt_u32(at) != cell) break;
        if (!(slrt_u32(at + 12) & SL_RUNTIME_STOPS_STEPS)) return from;
    }
    return rt->passage_count;
}

/// The right (0) or left (1) end of a passage as its cell crosses it: two numbers of the file.
static const unsigned char *slrt_passage_end(const sl_runtime *rt, uint32_t passage, int left) {
    const uint32_t wall = slrt_u32(rt->passages + (size_t)passage * SLRT_PASSAGE_BYTES + 4);
    const unsigned char *ends = rt->walls + (size_t)(wall & INT32_MAX) * 32;
    return (wall > INT32_MAX) == (left != 0) ? ends
                                             : ends + 16; // the cell is at its right, or left
}

static void slrt_read_passage(const sl_runtime *rt, uint32_t passage, double *right, double *left) {
    const unsigned char *ends[2];
    int i;
    ends[0] = slrt_passage_end(rt, passage, 0);
    ends[1] = slrt_passage_end(rt, passage, 1);
    for (i = 0; i < 2; i++) {
        right[i] = slrt_f64(ends[0] + 8 * i);
        left[i] = slrt_f64(ends[1] + 8 * i);
    }
}

/// Whether steps pass a wall beside a cell.
static bool slrt_has_way(const sl_runtime *rt, uint32_t cell) {
    return slrt_next_way(rt, cell, slrt_first_passage(rt, cell)) < rt->passage_count;
}

/// Whether a wall stops steps. Time: the passages.
static bool slrt_wall_stops_steps(const sl_runtime *rt, uint32_t wall) {
    uint32_t i;
    for (i = 0; i < rt->passage_count; i++) {
        const unsigned char *at = rt->passages + (size_t)i * SLRT_PASSAGE_BYTES;
        if (slrt_u32(at + 4) == wall) return (slrt_u32(at + 12) & SL_RUNTIME_STOPS_STEPS) != 0;
    }
    return true;
}

SL_RUNTIME_API uint32_t sl_runtime_portal_stops(const sl_runtime *runtime, uint32_t portal) {
    uint32_t i, stops = 0;
    if (!runtime->stops) return 0;
    for (i = slrt_first_seam(runtime, portal); i < runtime->seam_portal_count; i++) {
        const unsigned char *on = runtime->seam_portals + (size_t)i * 12;
        if (slrt_u32(on) != portal) break;
        stops |= slrt_seam_stops(runtime, slrt_u32(on + 4));
    }
    return stops;
}

/// Whether a directed portal is on a limited wall, in a file for sight.
static bool slrt_is_limited(const sl_runtime *rt, uint32_t directed) {
    uint32_t portal;
    if (!rt->has_limits) return false;
    portal = slrt_u32(rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES);
    return (sl_runtime_portal_stops(rt, portal) & SL_RUNTIME_STOPS_LIMITED) != 0;
}

SL_RUNTIME_API uint32_t sl_runtime_passages(const sl_runtime *runtime, uint32_t cell,
                                            sl_runtime_passage *passages, uint32_t room) {
    uint32_t i = slrt_first_passage(runtime, cell), count = 0;
    for (; i < runtime->passage_count; i++, count++) {
        const unsigned char *at = runtime->passages + (size_t)i * SLRT_PASSAGE_BYTES;
        if (slrt_u32(at) != cell) break;
        if (count >= room) continue;
        passages[count].cell = slrt_u32(at + 8);
        passages[count].stops = slrt_u32(at + 12);
        slrt_read_passage(runtime, i, passages[count].right, passages[count].left);
    }
    return count;
}
