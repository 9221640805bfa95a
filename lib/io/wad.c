#include "io/wad.h"

#include <string.h>
#include <strings.h>

enum { HEADER_BYTES = 12, ENTRY_BYTES = 16 };

bool sl_wad_known(const void *bytes, size_t size) {
    return size >= 4 && (memcmp(bytes, "IWAD", 4) == 0 || memcmp(bytes, "PWAD", 4) == 0);
}

sl_status sl_wad_open(sl_context *context, const char *name, const void *bytes, size_t size,
                      sl_wad *wad) {
    if (!sl_wad_known(bytes, size))
        return sl_fail_at(context, name, 0, "no WAD: expected 'IWAD' or 'PWAD' at its start");
    if (size < HEADER_BYTES)
        return sl_fail_at(context, name, 0, "the WAD's header is cut off: %zu bytes of %d", size,
                          HEADER_BYTES);
    const uint32_t count = sl_wad_u32((const unsigned char *)bytes + 4);
    const uint32_t directory = sl_wad_u32((const unsigned char *)bytes + 8);
    if (directory > size || count > (size - directory) / ENTRY_BYTES)
        return sl_fail_at(context, name, 0,
                          "the directory of %lu lumps at byte %lu does not lie in the file's %zu "
                          "bytes: the WAD is cut off or damaged",
                          (unsigned long)count, (unsigned long)directory, size);
    *wad = (sl_wad){
        .name = name, .bytes = bytes, .size = size, .directory = directory, .lump_count = count};
    return SL_OK;
}

static const unsigned char *entry_of(const sl_wad *wad, uint32_t index) {
    return wad->bytes + wad->directory + (size_t)index * ENTRY_BYTES;
}

void sl_wad_lump_name(const sl_wad *wad, uint32_t index, char name[SL_LUMP_NAME]) {
    const unsigned char *text = entry_of(wad, index) + 8;
    memset(name, 0, SL_LUMP_NAME);
    for (int i = 0; i < SL_LUMP_NAME - 1 && text[i]; i++) {
        const unsigned char c = text[i];
        name[i] = (char)(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    }
}

sl_status sl_wad_lump(sl_context *context, const sl_wad *wad, uint32_t index, sl_lump *lump) {
    const uint32_t offset = sl_wad_u32(entry_of(wad, index));
    const uint32_t size = sl_wad_u32(entry_of(wad, index) + 4);
    char name[SL_LUMP_NAME];
    sl_wad_lump_name(wad, index, name);
    if (size && (offset > wad->size || size > wad->size - offset))
        return sl_fail_at(context, wad->name, 0,
                          "lump %lu, %s: its %lu bytes at byte %lu do not lie in the file's %zu "
                          "bytes: the WAD is cut off or damaged",
                          (unsigned long)index, name, (unsigned long)size, (unsigned long)offset,
                          wad->size);
    *lump = (sl_lump){.bytes = wad->bytes + (size ? offset : 0), .size = size};
    return SL_OK;
}

// --- maps

static bool is_one_of(const char *name, const char *const *names, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (strcmp(name, names[i]) == 0) return true;
    return false;
}

/// Whether a map in lumps of records may have a lump of this name.
static bool is_record_lump(const char *name) {
    static const char *const names[] = {
        "THINGS", "LINEDEFS", "SIDEDEFS", "VERTEXES", "SEGS",  "SSECTORS", "NODES",  "SECTORS",
        "REJECT", "BLOCKMAP", "BEHAVIOR", "SCRIPTS",  "LEAFS", "LIGHTS",   "MACROS",
    };
    return is_one_of(name, names, sizeof names / sizeof *names);
}

/// A name that a map may have: any readable one that could not be a lump within a map.
static bool is_map_name(const char *name) {
    for (const char *at = name; *at; at++)
        if (*at <= ' ' || *at >= 0x7f || *at == '#') return false;
    return name[0] && !is_record_lump(name) && strcmp(name, "TEXTMAP") != 0;
}

bool sl_wad_next_map(const sl_wad *wad, uint32_t *at, sl_wad_map *map) {
    for (uint32_t i = *at; i + 1 < wad->lump_count; i++) {
        char name[SL_LUMP_NAME], next[SL_LUMP_NAME];
        sl_wad_lump_name(wad, i, name);
        sl_wad_lump_name(wad, i + 1, next);
        const bool is_text = strcmp(next, "TEXTMAP") == 0;
        if (!is_map_name(name) || !(is_text || is_record_lump(next))) continue;
        uint32_t end = i + 2;
        for (; end < wad->lump_count; end++) {
            sl_wad_lump_name(wad, end, next);
            if (is_text ? strcmp(next, "ENDMAP") == 0 : !is_record_lump(next)) break;
        }
        *map = (sl_wad_map){.header = i, .end = end, .is_text = is_text};
        memcpy(map->name, name, sizeof name);
        *at = end;
        return true;
    }
    return false;
}

sl_status sl_wad_find_map(sl_context *context, const sl_wad *wad, const char *name,
                          sl_wad_map *map) {
    bool found = false;
    sl_wad_map next;
    for (uint32_t at = 0; sl_wad_next_map(wad, &at, &next);) {
        if (name ? strcasecmp(next.name, name) != 0 : found) continue;
        *map = next;
        found = true;
    }
    if (found) return SL_OK;
    if (!name) return sl_fail_at(context, wad->name, 0, "holds no map");
    return sl_fail_at(context, wad->name, 0, "there is no map '%.64s' for --map", name);
}

uint32_t sl_wad_find_lump(const sl_wad *wad, const sl_wad_map *map, const char *name) {
    for (uint32_t i = map->header + 1; i < map->end; i++) {
        char own[SL_LUMP_NAME];
        sl_wad_lump_name(wad, i, own);
        if (strcmp(own, name) == 0) return i;
    }
    return wad->lump_count;
}
