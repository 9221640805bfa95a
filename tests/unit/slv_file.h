/// A baked file taken apart and put together again, for tests that change it on purpose.
#ifndef SL_SLV_FILE_H
#define SL_SLV_FILE_H

#include "testing.h"

#include "bake/slv.h"

#include <zlib.h>

/// Makes the checksum right.
static inline void slv_seal(char *bytes, size_t size) {
    sli_slv_header header;
    memcpy(&header, bytes, sizeof header);
    header.checksum = 0;
    memcpy(bytes, &header, sizeof header);
    header.checksum = (uint32_t)crc32(0, (const Bytef *)bytes, (uInt)size);
    memcpy(bytes, &header, sizeof header);
}

/// The entry of a section in the table, for memcpy; NULL for none.
static inline char *slv_entry(char *bytes, const char *tag) {
    sli_slv_header header;
    memcpy(&header, bytes, sizeof header);
    for (uint32_t i = 0; i < header.section_count; i++) {
        char *entry = bytes + sizeof header + i * sizeof(sli_slv_section);
        if (memcmp(entry, tag, 4) == 0) return entry;
    }
    return NULL;
}

/// Where a section's items lie.
static inline char *slv_items(char *bytes, const char *tag) {
    const char *entry = slv_entry(bytes, tag);
    assert_non_null(entry);
    sli_slv_section s;
    memcpy(&s, entry, sizeof s);
    return bytes + s.offset;
}

/// The file with one section more, behind the others; for free(). `size` becomes its size.
static inline char *slv_with(const char *bytes, size_t *size, const char *tag, const void *items,
                             uint32_t item_bytes, uint64_t count) {
    sli_slv_header header;
    memcpy(&header, bytes, sizeof header);
    const size_t table = sizeof header + header.section_count * sizeof(sli_slv_section);
    const size_t longer = sizeof(sli_slv_section), content = (item_bytes * count + 7) / 8 * 8;
    char *out = calloc(1, *size + longer + content);
    assert_non_null(out);
    memcpy(out, bytes, table);
    memcpy(out + table + longer, bytes + table, *size - table);
    for (uint32_t i = 0; i < header.section_count; i++) {
        sli_slv_section s;
        memcpy(&s, out + sizeof header + i * sizeof s, sizeof s);
        s.offset += longer;
        memcpy(out + sizeof header + i * sizeof s, &s, sizeof s);
    }
    sli_slv_section s = {.item_bytes = item_bytes, .offset = *size + longer, .count = count};
    memcpy(s.tag, tag, sizeof s.tag);
    memcpy(out + table, &s, sizeof s);
    if (count) memcpy(out + s.offset, items, item_bytes * count);
    *size += longer + content;
    header.section_count++;
    header.file_bytes = *size;
    memcpy(out, &header, sizeof header);
    slv_seal(out, *size);
    return out;
}

#endif
