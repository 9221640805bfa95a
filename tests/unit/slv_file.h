/// A baked file taken apart and put together again, for tests that change it on purpose.
#ifndef SL_SLV_FILE_H
#define SL_SLV_FILE_H

#include "testing.h"

#include "bake/slv.h"

#include <zlib.h>

/// A number as it lies in the file.
static inline uint32_t slv_u32(uint32_t value) {
    sli_slv_order("PVSO", sizeof value, &value, 1);
    return value;
}

static inline double slv_f64(double value) {
    sli_slv_order("VERT", sizeof value, &value, 1);
    return value;
}

static inline sli_slv_header slv_header(const char *bytes) {
    sli_slv_header header;
    memcpy(&header, bytes, sizeof header);
    sli_slv_order_header(&header);
    return header;
}

static inline void slv_set_header(char *bytes, sli_slv_header header) {
    sli_slv_order_header(&header);
    memcpy(bytes, &header, sizeof header);
}

/// What an entry of the table says.
static inline sli_slv_section slv_section(const char *entry) {
    sli_slv_section section;
    memcpy(&section, entry, sizeof section);
    sli_slv_order_entry(&section);
    return section;
}

static inline void slv_set_section(char *entry, sli_slv_section section) {
    sli_slv_order_entry(&section);
    memcpy(entry, &section, sizeof section);
}

/// Makes the checksum right.
static inline void slv_seal(char *bytes, size_t size) {
    sli_slv_header header = slv_header(bytes);
    header.checksum = 0;
    slv_set_header(bytes, header);
    header.checksum = (uint32_t)crc32(0, (const Bytef *)bytes, (uInt)size);
    slv_set_header(bytes, header);
}

/// The entry of a section in the table; NULL for none.
static inline char *slv_entry(char *bytes, const char *tag) {
    const uint32_t count = slv_header(bytes).section_count;
    for (uint32_t i = 0; i < count; i++) {
        char *entry = bytes + sizeof(sli_slv_header) + i * sizeof(sli_slv_section);
        if (memcmp(entry, tag, 4) == 0) return entry;
    }
    return NULL;
}

/// Where a section's items lie.
static inline char *slv_items(char *bytes, const char *tag) {
    const char *entry = slv_entry(bytes, tag);
    assert_non_null(entry);
    return bytes + slv_section(entry).offset;
}

/// The file with one section more, behind the others; for free(). `size` becomes its size.
static inline char *slv_with(const char *bytes, size_t *size, const char *tag, const void *items,
                             uint32_t item_bytes, uint64_t count) {
    sli_slv_header header = slv_header(bytes);
    const size_t table = sizeof header + header.section_count * sizeof(sli_slv_section);
    const size_t longer = sizeof(sli_slv_section), content = (item_bytes * count + 7) / 8 * 8;
    char *out = calloc(1, *size + longer + content);
    assert_non_null(out);
    memcpy(out, bytes, table);
    memcpy(out + table + longer, bytes + table, *size - table);
    for (uint32_t i = 0; i < header.section_count; i++) {
        char *entry = out + sizeof header + i * sizeof(sli_slv_section);
        sli_slv_section s = slv_section(entry);
        s.offset += longer;
        slv_set_section(entry, s);
    }
    sli_slv_section s = {.item_bytes = item_bytes, .offset = *size + longer, .count = count};
    memcpy(s.tag, tag, sizeof s.tag);
    slv_set_section(out + table, s);
    if (count) memcpy(out + s.offset, items, item_bytes * count);
    sli_slv_order(tag, item_bytes, out + s.offset, count);
    *size += longer + content;
    header.section_count++;
    header.file_bytes = *size;
    slv_set_header(out, header);
    slv_seal(out, *size);
    return out;
}

#endif
