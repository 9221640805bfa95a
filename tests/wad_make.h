/// WADs made in memory: lumps are added one after the other, the directory goes behind them.
#ifndef SL_WAD_MAKE_H
#define SL_WAD_MAKE_H

#include <assert.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { WAD_LUMPS = 64, WAD_BYTES = 1 << 20 };

typedef struct wad_made {
    unsigned char *bytes;
    size_t size;
    struct {
        char name[9];
        size_t offset, size;
    } lumps[WAD_LUMPS];
    size_t lump_count;
} wad_made;

static inline void wad_u16(unsigned char *at, int value) {
    at[0] = (unsigned char)(value & 0xff);
    at[1] = (unsigned char)(value >> 8 & 0xff);
}

static inline void wad_u32(unsigned char *at, uint32_t value) {
    wad_u16(at, (int)(value & 0xffff));
    wad_u16(at + 2, (int)(value >> 16));
}

static inline void wad_begin(wad_made *wad) {
    memset(wad, 0, sizeof *wad);
    wad->bytes = calloc(WAD_BYTES, 1);
    assert(wad->bytes);
    memcpy(wad->bytes, "PWAD", 4);
    wad->size = 12;
}

static inline void wad_lump(wad_made *wad, const char *name, const void *bytes, size_t size) {
    assert(wad->lump_count < WAD_LUMPS && wad->size + size < WAD_BYTES && strlen(name) <= 8);
    strcpy(wad->lumps[wad->lump_count].name, name);
    wad->lumps[wad->lump_count].offset = wad->size;
    wad->lumps[wad->lump_count++].size = size;
    if (size) memcpy(wad->bytes + wad->size, bytes, size);
    wad->size += size;
}

static inline void wad_text(wad_made *wad, const char *name, const char *text) {
    wad_lump(wad, name, text, strlen(text));
}

/// Records of `count` 16-bit fields, each field of `rows` at its place in a record of `bytes`.
static inline void wad_records(wad_made *wad, const char *name, size_t bytes, size_t count,
                               const size_t *places, const int *rows, size_t row_count) {
    unsigned char *lump = calloc(row_count * bytes + 1, 1);
    assert(lump);
    for (size_t i = 0; i < row_count; i++)
        for (size_t k = 0; k < count; k++)
            wad_u16(lump + i * bytes + places[k], rows[i * count + k]);
    wad_lump(wad, name, lump, row_count * bytes);
    free(lump);
}

/// Writes the directory: the WAD is complete. free(wad->bytes) is the caller's.
static inline void wad_end(wad_made *wad) {
    wad_u32(wad->bytes + 4, (uint32_t)wad->lump_count);
    wad_u32(wad->bytes + 8, (uint32_t)wad->size);
    for (size_t i = 0; i < wad->lump_count; i++, wad->size += 16) {
        unsigned char *at = wad->bytes + wad->size;
        assert(wad->size + 16 <= WAD_BYTES);
        wad_u32(at, (uint32_t)wad->lumps[i].offset);
        wad_u32(at + 4, (uint32_t)wad->lumps[i].size);
        memcpy(at + 8, wad->lumps[i].name, strlen(wad->lumps[i].name));
    }
}

#define WAD_ROWS(rows) ((const int *)(rows)), sizeof(rows) / sizeof *(rows)

/// The lumps of a map of two rooms, 0 0 to 64 64 and 72 0 to 136 64, joined by a door sector of
/// width 8 between them: sectors 0 and 2 are the rooms, sector 1 is the door. `special` and `tag`
/// stand on the line from room 0 into the door. Nothing of it is written where `leave_out` is the
/// lump's name.
static inline void wad_two_rooms(wad_made *wad, const char *header, int special, int tag,
                                 int door_ceiling, const char *leave_out) {
    static const size_t vertex[] = {0, 2}, line[] = {0, 2, 4, 6, 8, 10, 12}, side[] = {28},
                        sector[] = {0, 2, 22, 24}, thing[] = {0, 2, 4, 6, 8};
    static const int vertices[][2] = {{0, 0},    {0, 64},  {64, 64}, {64, 40}, {72, 40}, {72, 64},
                                      {136, 64}, {136, 0}, {72, 0},  {72, 24}, {64, 24}, {64, 0}};
    const int none = 0xffff;
    const int lines[][7] = {
        {0, 1, 1, 0, 0, 0, none},       {1, 2, 1, 0, 0, 0, none},   {2, 3, 1, 0, 0, 0, none},
        {3, 4, 1, 0, 0, 1, none},       {4, 5, 1, 0, 0, 2, none},   {5, 6, 1, 0, 0, 2, none},
        {6, 7, 1, 0, 0, 2, none},       {7, 8, 1, 0, 0, 2, none},   {8, 9, 1, 0, 0, 2, none},
        {9, 10, 1, 0, 0, 1, none},      {10, 11, 1, 0, 0, 0, none}, {11, 0, 1, 0, 0, 0, none},
        {3, 10, 4, special, tag, 0, 1}, {9, 4, 4, 0, 0, 2, 1},
    };
    static const int sides[][1] = {{0}, {1}, {2}};
    const int sectors[][4] = {{0, 128, 0, 0}, {0, door_ceiling, 0, 7}, {0, 128, 0, 0}};
    static const int things[][5] = {{32, 32, 90, 1, 7}, {100, 32, 180, 3004, 7}};
    const char *const none_out = leave_out ? leave_out : "";
    wad_lump(wad, header, NULL, 0);
    if (strcmp(none_out, "THINGS") != 0) wad_records(wad, "THINGS", 10, 5, thing, WAD_ROWS(things));
    if (strcmp(none_out, "LINEDEFS") != 0)
        wad_records(wad, "LINEDEFS", 14, 7, line, WAD_ROWS(lines));
    if (strcmp(none_out, "SIDEDEFS") != 0)
        wad_records(wad, "SIDEDEFS", 30, 1, side, WAD_ROWS(sides));
    if (strcmp(none_out, "VERTEXES") != 0)
        wad_records(wad, "VERTEXES", 4, 2, vertex, WAD_ROWS(vertices));
    if (strcmp(none_out, "SECTORS") != 0)
        wad_records(wad, "SECTORS", 26, 4, sector, WAD_ROWS(sectors));
    wad_lump(wad, "REJECT", "\0\0", 2);
}

#endif
