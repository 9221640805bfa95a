/// Opening a file.

/// Each door that a seam is of has a name, each start three numbers, and a range one above 0.
static bool slrt_take_text(sl_runtime *rt, const slrt_section *found) {
    slrt_text text, line;
    uint32_t doors = 0;
    rt->range = 0;
    rt->text = found[SLRT_MAPT].items ? found[SLRT_MAPT].items : (const unsigned char *)"";
    rt->text_bytes = (size_t)found[SLRT_MAPT].count;
    text.at = rt->text;
    text.end = rt->text + rt->text_bytes;
    while (slrt_take_line(&text, &line)) {
        const slrt_text first = slrt_take_word(&line);
        sl_runtime_viewpoint start;
        if (slrt_word_is(&first, "start") && !slrt_read_start(line, &start)) return false;
        if (slrt_word_is(&first, "range") &&
            (!slrt_take_number(&line, false, &rt->range) || !(rt->range > 0)))
            return false;
        if (slrt_word_is(&first, "door")) {
            const slrt_text name = slrt_take_word(&line);
            if (name.at == name.end || name.end - name.at > INT32_MAX) return false;
            doors++;
        }
        if (slrt_word_is(&first, "mirror") && !rt->mirrors)
            rt->mirrors = SL_RUNTIME_MIRRORS_NOT_BAKED;
    }
    return doors >= rt->door_count;
}

SL_RUNTIME_API sl_runtime_status sl_runtime_open(const void *bytes, size_t size, sl_runtime *out) {
    const unsigned char *file = (const unsigned char *)bytes;
    slrt_section found[SLRT_TAGS];
    sl_runtime rt;
    sl_runtime_status status = slrt_check_header(file, size);
    if (status != SL_RUNTIME_OK) return status;
    memset(found, 0, sizeof found);
    status = slrt_find_sections(file, size, found);
    if (status == SL_RUNTIME_OK) status = slrt_check_sizes(found, &rt);
    if (status != SL_RUNTIME_OK) return status;
    if (!slrt_take_location(&rt, found, slrt_u32(file + 8)) || !slrt_cells_are_sound(&rt))
        return SL_RUNTIME_SPACE;
    if (!slrt_take_seams(&rt, found) || !slrt_take_walls(&rt, found)) return SL_RUNTIME_SPACE;
    if (!slrt_take_doors(&rt, found) || !slrt_take_mirrors(&rt, found)) return SL_RUNTIME_ROW;
    if (!slrt_take_text(&rt, found)) return SL_RUNTIME_TEXT;
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
        return "damaged: a door, a start or the range of the map text";
    }
    return "unknown status";
}
