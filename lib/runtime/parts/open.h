/// Opening a file.

SL_RUNTIME_API sl_runtime_status sl_runtime_open(const void *bytes, size_t size, sl_runtime *out) {
    const unsigned char *file = (const unsigned char *)bytes;
    slrt_section found[SLRT_TAGS];
    sl_runtime rt;
    sl_runtime_status status = slrt_check_header(file, size);
    if (status != SL_RUNTIME_OK) return status;
    memset(found, 0, sizeof found);
    memset(&rt, 0, sizeof rt);
    status = slrt_find_sections(file, size, found);
    if (status == SL_RUNTIME_OK) status = slrt_check_sizes(found, &rt);
    if (status != SL_RUNTIME_OK) return status;
    if (!slrt_take_location(&rt, found, slrt_u32(file + 8)) || !slrt_cells_are_sound(&rt))
        return SL_RUNTIME_SPACE;
    if (!slrt_take_seams(&rt, found) || !slrt_take_walls(&rt, found)) return SL_RUNTIME_SPACE;
    if (!slrt_take_stops(&rt, found)) return SL_RUNTIME_SPACE;
    status = slrt_take_map(&rt, found);
    if (status != SL_RUNTIME_OK) return status;
    if (!slrt_take_doors(&rt, found) || !slrt_take_mirrors(&rt, found)) return SL_RUNTIME_ROW;
    if (!slrt_take_parts(&rt, &found[SLRT_PVSP])) return SL_RUNTIME_ROW;
    if (rt.row_offsets && !slrt_rows_are_sound(&rt, found[SLRT_PVSB].count, true))
        return SL_RUNTIME_ROW;
    if (!slrt_open_views(found, &rt)) return SL_RUNTIME_ROW;
    *out = rt;
    return SL_RUNTIME_OK;
}

SL_RUNTIME_API const char *sl_runtime_status_text(sl_runtime_status status) {
    switch (status) {
    case SL_RUNTIME_OK:
        return "no fault";
    case SL_RUNTIME_NOT_BAKED:
        return "not a baked file (.slv)";
    case SL_RUNTIME_BYTE_ORDER:
        return "its byte order is not that of baked files: bake the map again";
    case SL_RUNTIME_VERSION:
        return "of another version of the baked format";
    case SL_RUNTIME_SIZE:
        return "cut short, or longer than it says";
    case SL_RUNTIME_CHECKSUM:
        return "damaged: the checksum does not match";
    case SL_RUNTIME_SECTION:
        return "damaged: a section is missing, there twice, or does not fit";
    case SL_RUNTIME_SPACE:
        return "damaged: a number of the bounds, tree, grid, cells or portals is out of range";
    case SL_RUNTIME_ROW:
        return "damaged: a row of the visible sets";
    case SL_RUNTIME_SHARD:
        return "one shard of a bake, not all of it: sightline merge puts shards together";
    case SL_RUNTIME_TEXT:
        return "damaged: a door, a start or another thing of the map";
    case SL_RUNTIME_OLD:
        return "made before 2.0, and this program leaves that out: bake the map again";
    }
    return "unknown status";
}
