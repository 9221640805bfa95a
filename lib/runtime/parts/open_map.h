/// What is checked of the map's things when a file is opened: doors, starts, objects, paths,
/// mirrors.

/// As bits, which no fast-math option changes.
static bool slrt_is_finite(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return (bits >> 52 & 0x7ff) != 0x7ff;
}

/// The items of a section: at most INT32_MAX, each of them, if it is `named`, begins with a name
/// that is not empty, in the section of names; then come `numbers` coordinates.
static bool slrt_items_are_sound(const slrt_section *found, int tag, uint32_t item_bytes,
                                 bool named, int numbers) {
    const unsigned char *item = found[tag].items;
    const uint64_t count = found[tag].count, names = found[SLRT_MAPN].count;
    uint64_t i;
    for (i = 0; i < count; i++, item += item_bytes) {
        if (named && (!slrt_u32(item + 4) || slrt_u32(item) > names ||
                      slrt_u32(item + 4) > names - slrt_u32(item)))
            return false;
        if (!slrt_usable(item + (named ? 8 : 0), numbers)) return false;
    }
    return count <= INT32_MAX;
}

static bool slrt_take_map_info(sl_runtime *rt, const slrt_section *section) {
    const unsigned char *info = section->items;
    double scale;
    if (section->count != 1 || !slrt_usable(info + 8, 3) || slrt_u64(info + 32) > 1) return false;
    rt->range = slrt_f64(info);
    rt->transform.origin_x = slrt_f64(info + 8);
    rt->transform.origin_y = slrt_f64(info + 16);
    rt->transform.scale = scale = slrt_f64(info + 24);
    rt->transform.y_down = slrt_u64(info + 32) != 0;
    return slrt_is_finite(rt->range) && rt->range >= 0 && (scale == 0 || scale >= 1e-150);
}

/// The map's things in a file that has them in sections.
static bool slrt_take_things(sl_runtime *rt, const slrt_section *found) {
    uint32_t i;
    if (!slrt_take_map_info(rt, &found[SLRT_MAPI]) || found[SLRT_DOOR].count < rt->door_count ||
        !slrt_items_are_sound(found, SLRT_DOOR, SLRT_DOOR_BYTES, true, 0) ||
        !slrt_items_are_sound(found, SLRT_STRT, SLRT_START_BYTES, false, 2) ||
        !slrt_items_are_sound(found, SLRT_OBJE, SLRT_OBJECT_BYTES, true, 4) ||
        !slrt_items_are_sound(found, SLRT_PATH, SLRT_PATH_BYTES, true, 0) ||
        !slrt_items_are_sound(found, SLRT_PAPO, SLRT_VERTEX_BYTES, false, 2) ||
        !slrt_items_are_sound(found, SLRT_MIRR, SLRT_MIRROR_BYTES, false, 4))
        return false;
    rt->names = found[SLRT_MAPN].items;
    rt->doors = found[SLRT_DOOR].items;
    rt->door_count = (uint32_t)found[SLRT_DOOR].count;
    rt->starts = found[SLRT_STRT].items;
    rt->start_count = (uint32_t)found[SLRT_STRT].count;
    rt->objects = found[SLRT_OBJE].items;
    rt->object_count = (uint32_t)found[SLRT_OBJE].count;
    rt->paths = found[SLRT_PATH].items;
    rt->path_count = (uint32_t)found[SLRT_PATH].count;
    rt->path_points = found[SLRT_PAPO].items;
    rt->mirror_lines = found[SLRT_MIRR].items;
    rt->mirror_count = (uint32_t)found[SLRT_MIRR].count;
    if (rt->mirror_count) rt->mirrors = SL_RUNTIME_MIRRORS_NOT_BAKED;
    for (i = 0; i < rt->start_count; i++)
        if (!slrt_is_finite(slrt_f64(rt->starts + (size_t)i * SLRT_START_BYTES + 16))) return false;
    for (i = 0; i < rt->path_count; i++) {
        const unsigned char *path = rt->paths + (size_t)i * SLRT_PATH_BYTES;
        if ((uint64_t)slrt_u32(path + 8) + slrt_u32(path + 12) > found[SLRT_PAPO].count)
            return false;
    }
    return true;
}

/// What the map holds beside walls. Files before 2.0 have it as text alone.
static sl_runtime_status slrt_take_map(sl_runtime *rt, const slrt_section *found) {
    if (!found[SLRT_MAPI].items)
#ifdef SL_RUNTIME_WITHOUT_OLD_FILES
        return SL_RUNTIME_OLD;
#else
        return slrt_take_text(rt, &found[SLRT_MAPT]) ? SL_RUNTIME_OK : SL_RUNTIME_TEXT;
#endif
    return slrt_take_things(rt, found) ? SL_RUNTIME_OK : SL_RUNTIME_TEXT;
}
