#include "import/wad_write.h"

#include "base/file.h"

#include <string.h>

enum { HEADER_BYTES = 12, ENTRY_BYTES = 16 };

typedef struct wad_edit {
    sl_context *context;
    const sl_wad *wad;
    uint32_t index; ///< of the lump, or of the one that it comes before
    bool is_new;
    const char *name;
    const sl_lump *lump;
} wad_edit;

static const unsigned char *entry_of(const sl_wad *wad, uint32_t index) {
    return wad->bytes + wad->directory + (size_t)index * ENTRY_BYTES;
}

static void put_u32(unsigned char *at, uint32_t value) {
    for (int i = 0; i < 4; i++) at[i] = (unsigned char)(value >> 8 * i);
}

static bool ranges_meet(size_t a, size_t a_size, size_t b, size_t b_size) {
    return a_size && b_size && a < b + b_size && b < a + a_size;
}

/// Whether the lump may be written over where it is: nothing else has these bytes.
static bool fits_in_place(const wad_edit *edit) {
    const sl_wad *wad = edit->wad;
    const unsigned char *own = entry_of(wad, edit->index);
    const size_t offset = sl_wad_u32(own), size = sl_wad_u32(own + 4);
    if (size != edit->lump->size || offset > wad->size || size > wad->size - offset) return false;
    if (ranges_meet(offset, size, 0, HEADER_BYTES)) return false;
    if (ranges_meet(offset, size, wad->directory, (size_t)wad->lump_count * ENTRY_BYTES))
        return false;
    for (uint32_t i = 0; i < wad->lump_count; i++) {
        const unsigned char *other = entry_of(wad, i);
        if (i != edit->index && ranges_meet(offset, size, sl_wad_u32(other), sl_wad_u32(other + 4)))
            return false;
    }
    return true;
}

/// A stream that takes no more is left to its error flag, which the commit asks.
static void put(FILE *stream, const void *bytes, size_t size) {
    if (size) fwrite(bytes, 1, size, stream);
}

static void write_in_place(const wad_edit *edit, FILE *stream) {
    const sl_wad *wad = edit->wad;
    const size_t offset = sl_wad_u32(entry_of(wad, edit->index));
    put(stream, wad->bytes, edit->lump->size ? offset : wad->size);
    if (!edit->lump->size) return;
    put(stream, edit->lump->bytes, edit->lump->size);
    put(stream, wad->bytes + offset + edit->lump->size, wad->size - offset - edit->lump->size);
}

static void write_directory(const wad_edit *edit, uint32_t offset, FILE *stream) {
    const sl_wad *wad = edit->wad;
    unsigned char entry[ENTRY_BYTES] = {0};
    put_u32(entry, offset);
    put_u32(entry + 4, (uint32_t)edit->lump->size);
    memcpy(entry + 8, edit->name, strlen(edit->name));
    put(stream, entry_of(wad, 0), (size_t)edit->index * ENTRY_BYTES);
    put(stream, entry, sizeof entry);
    const uint32_t next = edit->index + !edit->is_new;
    put(stream, entry_of(wad, next), (size_t)(wad->lump_count - next) * ENTRY_BYTES);
}

/// All that was there but a directory at the end, the new bytes, the new directory.
static sl_status write_behind(const wad_edit *edit, FILE *stream) {
    const sl_wad *wad = edit->wad;
    const size_t directory_bytes = (size_t)wad->lump_count * ENTRY_BYTES;
    const bool is_last =
        wad->directory >= HEADER_BYTES && wad->directory + directory_bytes == wad->size;
    const size_t kept = is_last ? wad->directory : wad->size;
    if (edit->lump->size > UINT32_MAX || kept > UINT32_MAX - edit->lump->size ||
        wad->lump_count == UINT32_MAX)
        return sl_fail(edit->context, SL_UNSUPPORTED, "%s: no WAD can be larger than 4 GiB",
                       wad->name);
    unsigned char header[HEADER_BYTES];
    memcpy(header, wad->bytes, 4);
    put_u32(header + 4, wad->lump_count + edit->is_new);
    put_u32(header + 8, (uint32_t)(kept + edit->lump->size));
    put(stream, header, sizeof header);
    put(stream, wad->bytes + HEADER_BYTES, kept - HEADER_BYTES);
    put(stream, edit->lump->bytes, edit->lump->size);
    write_directory(edit, (uint32_t)kept, stream);
    return SL_OK;
}

sl_status sl_wad_write_with(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                            const char *lump_name, const sl_lump *lump, const char *path) {
    wad_edit edit = {.context = context, .wad = wad, .name = lump_name, .lump = lump};
    edit.index = sl_wad_find_lump(wad, map, lump_name);
    edit.is_new = edit.index == wad->lump_count;
    if (edit.is_new) edit.index = sl_wad_find_lump(wad, map, "BLOCKMAP");
    if (edit.index == wad->lump_count) edit.index = map->end;
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    sl_status status = SL_OK;
    if (!edit.is_new && fits_in_place(&edit))
        write_in_place(&edit, output.stream);
    else
        status = write_behind(&edit, output.stream);
    return sl_output_close(context, &output, status);
}
