/// What is checked of the walls that do not stop all when a file is opened.

static bool slrt_passage_is_sound(const sl_runtime *rt, const unsigned char *at) {
    const uint32_t stops = slrt_u32(at + 12);
    return slrt_u32(at) < rt->cell_count && slrt_u32(at + 8) < rt->cell_count &&
           (slrt_u32(at + 4) & INT32_MAX) < rt->wall_count && stops && stops < SL_RUNTIME_STOPS_ALL;
}

/// Whether some seam limits sight, in a file for sight.
static bool slrt_has_limits(const sl_runtime *rt) {
    uint32_t i;
    if (!rt->stops || !(rt->channel & SL_RUNTIME_STOPS_SIGHT)) return false;
    for (i = 0; i < rt->seam_count; i++)
        if (slrt_u32(rt->stops + (size_t)i * 4) & SL_RUNTIME_STOPS_LIMITED) return true;
    return false;
}

/// Passages go by cell, so that they can be searched.
static bool slrt_take_stops(sl_runtime *rt, const slrt_section *found) {
    uint32_t i;
    rt->stops = found[SLRT_STOP].items;
    rt->passages = found[SLRT_PASS].items;
    rt->passage_count = 0;
    rt->channel = SL_RUNTIME_STOPS_SIGHT;
    if (found[SLRT_CHAN].items) {
        rt->channel = found[SLRT_CHAN].count == 1 ? slrt_u32(found[SLRT_CHAN].items) : 0;
        if (!rt->channel || rt->channel > SL_RUNTIME_STOPS_ALL) return false;
    }
    if (rt->stops && found[SLRT_STOP].count != rt->seam_count) return false;
    rt->has_limits = slrt_has_limits(rt);
    if (!rt->passages) return true;
    if (!rt->walls || found[SLRT_PASS].count > UINT32_MAX) return false;
    rt->passage_count = (uint32_t)found[SLRT_PASS].count;
    for (i = 0; i < rt->passage_count; i++) {
        const unsigned char *at = rt->passages + (size_t)i * SLRT_PASSAGE_BYTES;
        if (!slrt_passage_is_sound(rt, at)) return false;
        if (i && slrt_u32(at) < slrt_u32(at - SLRT_PASSAGE_BYTES)) return false;
    }
    return true;
}
