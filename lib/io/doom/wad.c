/// Reading the directory of a WAD, finding its maps, and writing a copy with some lumps changed.
#include "io/doom/wad.h"

#include "sightline/support.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

// --- reading

enum { HEADER_BYTES = 12, ENTRY_BYTES = 16 };

bool sli_wad_known(const void *bytes, size_t size) {
    return size >= 4 && (memcmp(bytes, "IWAD", 4) == 0 || memcmp(bytes, "PWAD", 4) == 0);
}

sl_status sli_wad_open(sl_context *context, const char *name, const void *bytes, size_t size,
                       sli_wad *wad) {
    if (!sli_wad_known(bytes, size))
        return sl_fail_at(context, name, 0, "no WAD: expected 'IWAD' or 'PWAD' at its start");
    if (size < HEADER_BYTES)
        return sl_fail_at(context, name, 0, "the WAD's header is cut off: %zu bytes of %d", size,
                          HEADER_BYTES);
    const uint32_t count = sli_wad_u32((const unsigned char *)bytes + 4);
    const uint32_t directory = sli_wad_u32((const unsigned char *)bytes + 8);
    if (directory > size || count > (size - directory) / ENTRY_BYTES)
        return sl_fail_at(context, name, 0,
                          "the directory of %lu lumps at byte %lu does not lie in the file's %zu "
                          "bytes: the WAD is cut off or damaged",
                          (unsigned long)count, (unsigned long)directory, size);
    *wad = (sli_wad){
        .name = name, .bytes = bytes, .size = size, .directory = directory, .lump_count = count};
    return SL_OK;
}

static const unsigned char *entry_of(const sli_wad *wad, uint32_t index) {
    return wad->bytes + wad->directory + (size_t)index * ENTRY_BYTES;
}

void sli_wad_lump_name(const sli_wad *wad, uint32_t index, char name[SLI_LUMP_NAME]) {
    const unsigned char *text = entry_of(wad, index) + 8;
    memset(name, 0, SLI_LUMP_NAME);
    for (int i = 0; i < SLI_LUMP_NAME - 1 && text[i]; i++) {
        const unsigned char c = text[i];
        name[i] = (char)(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    }
}

sl_status sli_wad_lump(sl_context *context, const sli_wad *wad, uint32_t index, sli_lump *lump) {
    const uint32_t offset = sli_wad_u32(entry_of(wad, index));
    const uint32_t size = sli_wad_u32(entry_of(wad, index) + 4);
    char name[SLI_LUMP_NAME];
    sli_wad_lump_name(wad, index, name);
    if (size && (offset > wad->size || size > wad->size - offset))
        return sl_fail_at(context, wad->name, 0,
                          "lump %lu, %s: its %lu bytes at byte %lu do not lie in the file's %zu "
                          "bytes: the WAD is cut off or damaged",
                          (unsigned long)index, name, (unsigned long)size, (unsigned long)offset,
                          wad->size);
    *lump = (sli_lump){.bytes = wad->bytes + (size ? offset : 0), .size = size};
    return SL_OK;
}

// --- maps

/// Whether a map in lumps of records may have a lump of this name, which sli_wad_lump_name made.
/// Names end in zeros, so all of their bytes are compared at once.
static bool is_record_lump(const char name[SLI_LUMP_NAME]) {
    static const char names[][SLI_LUMP_NAME] = {
        "THINGS", "LINEDEFS", "SIDEDEFS", "VERTEXES", "SEGS",  "SSECTORS", "NODES",  "SECTORS",
        "REJECT", "BLOCKMAP", "BEHAVIOR", "SCRIPTS",  "LEAFS", "LIGHTS",   "MACROS",
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (memcmp(name, names[i], SLI_LUMP_NAME - 1) == 0) return true;
    return false;
}

/// A lump of scripts. Libraries of scripts keep them behind names of their own, without a map.
static bool is_script(const char name[SLI_LUMP_NAME]) {
    return strcmp(name, "BEHAVIOR") == 0 || strcmp(name, "SCRIPTS") == 0;
}

/// A name that a map may have: any readable one that could not be a lump within a map.
static bool is_map_name(const char name[SLI_LUMP_NAME]) {
    for (const char *at = name; *at; at++)
        if (*at <= ' ' || *at >= 0x7f || *at == '#') return false;
    return name[0] && !is_record_lump(name) && strcmp(name, "TEXTMAP") != 0;
}

bool sli_wad_next_map(const sli_wad *wad, uint32_t *at, sli_wad_map *map) {
    char name[SLI_LUMP_NAME], next[SLI_LUMP_NAME];
    if (*at < wad->lump_count) sli_wad_lump_name(wad, *at, next);
    for (uint32_t i = *at; i + 1 < wad->lump_count; i++) {
        memcpy(name, next, sizeof name);
        sli_wad_lump_name(wad, i + 1, next);
        const bool is_text = strcmp(next, "TEXTMAP") == 0;
        if (!is_map_name(name) || !(is_text || is_record_lump(next))) continue;
        bool is_map = is_text || !is_script(next);
        uint32_t end = i + 2;
        for (; end < wad->lump_count; end++) {
            sli_wad_lump_name(wad, end, next);
            if (is_text ? strcmp(next, "ENDMAP") == 0 : !is_record_lump(next)) break;
            is_map |= !is_script(next);
        }
        if (!is_map) {
            i = end - 1; // `next` is the name of the lump at `end`
            continue;
        }
        *map = (sli_wad_map){.header = i, .end = end, .is_text = is_text};
        memcpy(map->name, name, sizeof name);
        *at = end;
        return true;
    }
    return false;
}

sl_status sli_wad_find_map(sl_context *context, const sli_wad *wad, const char *name,
                           sli_wad_map *map) {
    bool found = false;
    sli_wad_map next;
    for (uint32_t at = 0; sli_wad_next_map(wad, &at, &next);) {
        if (name ? strcasecmp(next.name, name) != 0 : found) continue;
        *map = next;
        found = true;
    }
    if (found) return SL_OK;
    if (!name) return sl_fail_at(context, wad->name, 0, "holds no map");
    return sl_fail_at(context, wad->name, 0, "there is no map '%.64s' for --map", name);
}

uint32_t sli_wad_find_lump(const sli_wad *wad, const sli_wad_map *map, const char *name) {
    for (uint32_t i = map->header + 1; i < map->end; i++) {
        char own[SLI_LUMP_NAME];
        sli_wad_lump_name(wad, i, own);
        if (strcmp(own, name) == 0) return i;
    }
    return wad->lump_count;
}

// --- writing

/// A lump with other bytes.
typedef struct change {
    const char *name;
    sli_lump lump;
    uint32_t index; ///< of the lump, or of the one that it comes before
    bool is_new;
    bool in_place;   ///< written over what is there
    uint32_t offset; ///< of its bytes in the copy
} change;

typedef struct wad_copy {
    sl_context *context;
    const sli_wad *wad;
    change *changes; ///< by index, and as they were given
    size_t count;
    size_t kept; ///< bytes of the WAD before the new ones: all but a directory at the end
    size_t end;  ///< of the new ones
    uint32_t lump_count;
} wad_copy;

static void put_u32(unsigned char *at, uint32_t value) {
    for (int i = 0; i < 4; i++) at[i] = (unsigned char)(value >> 8 * i);
}

static bool ranges_meet(size_t a, size_t a_size, size_t b, size_t b_size) {
    return a_size && b_size && a < b + b_size && b < a + a_size;
}

/// Whether the lump may be written over where it is: nothing else has these bytes.
static bool fits_in_place(const sli_wad *wad, const change *to) {
    if (to->is_new) return false;
    const unsigned char *own = entry_of(wad, to->index);
    const size_t offset = sli_wad_u32(own), size = sli_wad_u32(own + 4);
    if (size != to->lump.size || offset > wad->size || size > wad->size - offset) return false;
    if (ranges_meet(offset, size, 0, HEADER_BYTES)) return false;
    if (ranges_meet(offset, size, wad->directory, (size_t)wad->lump_count * ENTRY_BYTES))
        return false;
    for (uint32_t i = 0; i < wad->lump_count; i++) {
        const unsigned char *other = entry_of(wad, i);
        if (i != to->index && ranges_meet(offset, size, sli_wad_u32(other), sli_wad_u32(other + 4)))
            return false;
    }
    return true;
}

static change make_change(const sli_wad *wad, const sli_wad_edit *edit) {
    change to = {.name = edit->name, .lump = edit->lump};
    to.index = sli_wad_find_lump(wad, &edit->map, edit->name);
    to.is_new = to.index == wad->lump_count;
    if (to.is_new) to.index = sli_wad_find_lump(wad, &edit->map, "BLOCKMAP");
    if (to.index == wad->lump_count) to.index = edit->map.end;
    to.in_place = fits_in_place(wad, &to);
    return to;
}

static int compare_indices(const void *left, const void *right) {
    const change *a = left, *b = right;
    return (a->index > b->index) - (a->index < b->index);
}

static int compare_offsets(const void *left, const void *right) {
    const change *a = left, *b = right;
    return (a->offset > b->offset) - (a->offset < b->offset);
}

/// Says where all bytes go.
static sl_status lay_out(wad_copy *copy) {
    const sli_wad *wad = copy->wad;
    const size_t directory_bytes = (size_t)wad->lump_count * ENTRY_BYTES;
    const bool is_last =
        wad->directory >= HEADER_BYTES && wad->directory + directory_bytes == wad->size;
    uint64_t end = copy->kept = is_last ? wad->directory : wad->size, lumps = wad->lump_count;
    for (size_t i = 0; i < copy->count; i++) {
        change *to = &copy->changes[i];
        to->offset = to->in_place ? sli_wad_u32(entry_of(wad, to->index)) : (uint32_t)end;
        if (!to->in_place) end += to->lump.size;
        lumps += to->is_new;
        if (end > UINT32_MAX || lumps > UINT32_MAX)
            return sl_fail(copy->context, SL_UNSUPPORTED, "%s: no WAD can be larger than 4 GiB",
                           wad->name);
    }
    copy->end = (size_t)end;
    copy->lump_count = (uint32_t)lumps;
    return SL_OK;
}

/// A stream that takes no more is left to its error flag, which the commit asks.
static void put(FILE *stream, const void *bytes, size_t size) {
    if (size) fwrite(bytes, 1, size, stream);
}

/// The WAD's own bytes from one place to another, with what changes in place.
static sl_status put_kept(wad_copy *copy, size_t from, size_t to, FILE *stream) {
    change *changes = sl_alloc_array(copy->context, copy->count, sizeof *changes);
    if (!changes) return SL_NO_MEMORY;
    memcpy(changes, copy->changes, copy->count * sizeof *changes);
    qsort(changes, copy->count, sizeof *changes, compare_offsets);
    for (size_t i = 0; i < copy->count; i++) {
        if (!changes[i].in_place || !changes[i].lump.size) continue;
        put(stream, copy->wad->bytes + from, changes[i].offset - from);
        put(stream, changes[i].lump.bytes, changes[i].lump.size);
        from = changes[i].offset + changes[i].lump.size;
    }
    put(stream, copy->wad->bytes + from, to - from);
    sl_free(copy->context, changes);
    return SL_OK;
}

static void put_directory(const wad_copy *copy, FILE *stream) {
    uint32_t next = 0;
    for (size_t i = 0; i < copy->count; i++) {
        const change *to = &copy->changes[i];
        unsigned char entry[ENTRY_BYTES] = {0};
        put_u32(entry, to->offset);
        put_u32(entry + 4, (uint32_t)to->lump.size);
        memcpy(entry + 8, to->name, strlen(to->name));
        put(stream, entry_of(copy->wad, next), (size_t)(to->index - next) * ENTRY_BYTES);
        put(stream, entry, sizeof entry);
        next = to->index + !to->is_new;
    }
    put(stream, entry_of(copy->wad, next), (size_t)(copy->wad->lump_count - next) * ENTRY_BYTES);
}

/// All that was there but a directory at the end, the new bytes, the new directory.
static sl_status write_behind(wad_copy *copy, FILE *stream) {
    unsigned char header[HEADER_BYTES];
    memcpy(header, copy->wad->bytes, 4);
    put_u32(header + 4, copy->lump_count);
    put_u32(header + 8, (uint32_t)copy->end);
    put(stream, header, sizeof header);
    SL_TRY(put_kept(copy, HEADER_BYTES, copy->kept, stream));
    for (size_t i = 0; i < copy->count; i++)
        if (!copy->changes[i].in_place)
            put(stream, copy->changes[i].lump.bytes, copy->changes[i].lump.size);
    put_directory(copy, stream);
    return SL_OK;
}

static sl_status write_copy(wad_copy *copy, const char *path) {
    SL_TRY(lay_out(copy));
    sl_output output;
    SL_TRY(sl_output_open(copy->context, path, &output));
    bool in_place = true;
    for (size_t i = 0; i < copy->count; i++) in_place &= copy->changes[i].in_place;
    const sl_status status = in_place ? put_kept(copy, 0, copy->wad->size, output.stream)
                                      : write_behind(copy, output.stream);
    return sl_output_close(copy->context, &output, status);
}

sl_status sli_wad_write(sl_context *context, const sli_wad *wad, const sli_wad_edit *edits,
                        size_t count, const char *path) {
    wad_copy copy = {.context = context, .wad = wad, .count = count};
    copy.changes = sl_alloc_array(context, count, sizeof *copy.changes);
    if (!copy.changes) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) copy.changes[i] = make_change(wad, &edits[i]);
    // No two have one index: lumps of one map differ, and what is new in one stands within it.
    qsort(copy.changes, count, sizeof *copy.changes, compare_indices);
    const sl_status status = write_copy(&copy, path);
    sl_free(context, copy.changes);
    return status;
}
