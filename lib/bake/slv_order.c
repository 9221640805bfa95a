/// The order of bytes in a baked file: little endian on every machine. Where the machine's own
/// order is another one, numbers are turned round on the way to the file and back. Elsewhere
/// nothing is done.
#include "bake/slv.h"

#include <string.h>

/// The widths of the fields of an item, one digit each. Sections that are not here have items of
/// one number, or of bytes.
static const struct {
    char tag[5];
    const char *widths;
} layouts[] = {
    {"INFO", "88884444444444888"}, // and two names
    {"NODE", "84444"},
    {"CELL", "444444"},
    {"VERT", "88"},
    {"PORT", "448888"},
    {"EXIT", "448888"},
    {"WALL", "8888"},
    {"SEAM", "888844"},
    {"SEPO", "444"},
    {"PASS", "4444"},
    {"TREN", "444"},
    {"VCIN", "44"},
    {"NODG", "44"},
    {"PART", "4444"},
    {"PAEF", "4444"},
    {"MAPI", "88888"},
    {"DOOR", "444"},
    {"STRT", "888"},
    {"OBJE", "448888"},
    {"PATH", "4444"},
    {"PAPO", "88"},
    {"MIRR", "88888"},
};

bool sli_slv_is_native(void) {
    const uint32_t order = SLI_SLV_BYTE_ORDER;
    unsigned char first;
    memcpy(&first, &order, 1);
    return first == 0x04;
}

static void turn_round(unsigned char *bytes, size_t count) {
    for (size_t i = 0; i < count / 2; i++) {
        const unsigned char byte = bytes[i];
        bytes[i] = bytes[count - 1 - i];
        bytes[count - 1 - i] = byte;
    }
}

static void turn_fields(unsigned char *bytes, const char *widths) {
    for (; *widths; widths++) {
        turn_round(bytes, (size_t)(*widths - '0'));
        bytes += *widths - '0';
    }
}

void sli_slv_order(const char *tag, uint32_t item_bytes, void *items, uint64_t count) {
    if (sli_slv_is_native() || item_bytes == 1) return;
    const char *widths = item_bytes == 4 ? "4" : "8";
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++)
        if (memcmp(tag, layouts[i].tag, 4) == 0) widths = layouts[i].widths;
    unsigned char *at = items;
    for (uint64_t i = 0; i < count; i++, at += item_bytes) turn_fields(at, widths);
}

void sli_slv_order_header(sli_slv_header *header) {
    if (!sli_slv_is_native()) turn_fields((unsigned char *)header + sizeof header->magic, "44844");
}

void sli_slv_order_entry(sli_slv_section *entry) {
    if (!sli_slv_is_native()) turn_fields((unsigned char *)entry + sizeof entry->tag, "488");
}
