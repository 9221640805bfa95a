/// The file: its header, its checksum and its sections. Layout as in lib/bake/slv.h.

enum {
    SLRT_HEADER_BYTES = 32,
    SLRT_ENTRY_BYTES = 24, ///< of the table of sections
    SLRT_NODE_BYTES = 24,
    SLRT_CELL_BYTES = 24,
    SLRT_VERTEX_BYTES = 16,
    SLRT_PORTAL_BYTES = 40,
    SLRT_DIRECTED_BYTES = 40,
    SLRT_DOOR_BYTES = 12,
    SLRT_START_BYTES = 24,
    SLRT_OBJECT_BYTES = 40,
    SLRT_PATH_BYTES = 16,
    SLRT_MIRROR_BYTES = 40,
    SLRT_PASSAGE_BYTES = 16
};

enum slrt_tag {
    SLRT_INFO,
    SLRT_NODE,
    SLRT_CELL,
    SLRT_VERT,
    SLRT_PORT,
    SLRT_PORTAL,
    SLRT_PVSO,
    SLRT_PVSB,
    SLRT_PART,
    SLRT_VCIN,
    SLRT_VCEL,
    SLRT_VCPA,
    SLRT_VCRO,
    SLRT_VCRB,
    SLRT_SEAM,
    SLRT_DORO,
    SLRT_DORB,
    SLRT_BEYO,
    SLRT_SEPO,
    SLRT_MAPT,
    SLRT_MIRO,
    SLRT_MIRB,
    SLRT_MDOO,
    SLRT_MDOB,
    SLRT_WALL,
    SLRT_MAPI, ///< of files since 2.0, as those up to MIRR: what the map holds, in items
    SLRT_MAPN,
    SLRT_DOOR,
    SLRT_STRT,
    SLRT_OBJE,
    SLRT_PATH,
    SLRT_PAPO,
    SLRT_MIRR,
    SLRT_STOP, ///< with CHAN and PASS: what walls stop that do not stop all
    SLRT_CHAN,
    SLRT_PASS,
    SLRT_PVSP,
    SLRT_NODG,
    SLRT_NODS,
    SLRT_GRIO, ///< of version 2, as what follows
    SLRT_GRIC,
    SLRT_TAGS
};

typedef struct slrt_section {
    const unsigned char *items; ///< NULL if the file has none
    uint64_t count;
} slrt_section;

static uint32_t slrt_crc_on(const uint32_t *table, uint32_t sum, const unsigned char *at,
                            size_t count) {
    size_t i;
    for (i = 0; i < count; i++) sum = table[(sum ^ at[i]) & 255] ^ sum >> 8;
    return sum;
}

/// CRC-32 of the file, as in zlib. The four bytes of the checksum itself count as 0.
static uint32_t slrt_checksum(const unsigned char *bytes, size_t size) {
    static const unsigned char zeros[4] = {0, 0, 0, 0};
    uint32_t table[256], sum = UINT32_MAX, i;
    for (i = 0; i < 256; i++) {
        uint32_t value = i;
        int bit;
        for (bit = 0; bit < 8; bit++) value = value >> 1 ^ (value & 1 ? 0xedb88320u : 0);
        table[i] = value;
    }
    sum = slrt_crc_on(table, sum, bytes, SLRT_HEADER_BYTES - 4);
    sum = slrt_crc_on(table, sum, zeros, 4);
    sum = slrt_crc_on(table, sum, bytes + SLRT_HEADER_BYTES, size - SLRT_HEADER_BYTES);
    return ~sum;
}

static sl_runtime_status slrt_check_header(const unsigned char *bytes, size_t size) {
    static const unsigned char magic[8] = {0x89, 'S', 'L', 'V', '\r', '\n', 0x1a, '\n'};
    if (!bytes || size < 8 || memcmp(bytes, magic, 8) != 0) return SL_RUNTIME_NOT_BAKED;
    if (size < SLRT_HEADER_BYTES) return SL_RUNTIME_SIZE;
    if (slrt_u32(bytes + 12) != 0x01020304u) return SL_RUNTIME_BYTE_ORDER;
    if (slrt_u32(bytes + 8) != 1 && slrt_u32(bytes + 8) != 2) return SL_RUNTIME_VERSION;
    if (slrt_u64(bytes + 16) != size) return SL_RUNTIME_SIZE;
    if (slrt_checksum(bytes, size) != slrt_u32(bytes + 28)) return SL_RUNTIME_CHECKSUM;
    if (slrt_u32(bytes + 24) > (size - SLRT_HEADER_BYTES) / SLRT_ENTRY_BYTES)
        return SL_RUNTIME_SECTION;
    return SL_RUNTIME_OK;
}

/// Finds the sections that the runtime knows, and skips others.
static sl_runtime_status slrt_find_sections(const unsigned char *bytes, size_t size,
                                            slrt_section *found) {
    static const struct {
        char tag[5];
        unsigned char item_bytes;
    } known[SLRT_TAGS] = {{"INFO", 128},
                          {"NODE", SLRT_NODE_BYTES},
                          {"CELL", SLRT_CELL_BYTES},
                          {"VERT", SLRT_VERTEX_BYTES},
                          {"PORT", SLRT_PORTAL_BYTES},
                          {"EXIT", SLRT_DIRECTED_BYTES},
                          {"PVSO", 8},
                          {"PVSB", 1},
                          {"PART", 16},
                          {"VCIN", 8},
                          {"VCEL", 4},
                          {"VCPA", 4},
                          {"VCRO", 8},
                          {"VCRB", 1},
                          {"SEAM", 40},
                          {"DORO", 8},
                          {"DORB", 1},
                          {"BEYO", 4},
                          {"SEPO", 12},
                          {"MAPT", 1},
                          {"MIRO", 8},
                          {"MIRB", 1},
                          {"MDOO", 8},
                          {"MDOB", 1},
                          {"WALL", 32},
                          {"MAPI", 40},
                          {"MAPN", 1},
                          {"DOOR", SLRT_DOOR_BYTES},
                          {"STRT", SLRT_START_BYTES},
                          {"OBJE", SLRT_OBJECT_BYTES},
                          {"PATH", SLRT_PATH_BYTES},
                          {"PAPO", SLRT_VERTEX_BYTES},
                          {"MIRR", SLRT_MIRROR_BYTES},
                          {"STOP", 4},
                          {"CHAN", 4},
                          {"PASS", SLRT_PASSAGE_BYTES},
                          {"PVSP", 8},
                          {"NODG", 8},
                          {"NODS", 4},
                          {"GRIO", 4},
                          {"GRIC", 4}};
    const uint32_t count = slrt_u32(bytes + 24);
    uint32_t i;
    const int tags = slrt_u32(bytes + 8) == 1 ? SLRT_GRIO : SLRT_TAGS;
    int tag;
    for (i = 0; i < count; i++) {
        const unsigned char *entry =
            bytes + SLRT_HEADER_BYTES + (size_t)i * (size_t)SLRT_ENTRY_BYTES;
        const uint64_t offset = slrt_u64(entry + 8), items = slrt_u64(entry + 16);
        for (tag = 0; tag < tags && memcmp(entry, known[tag].tag, 4) != 0;) tag++;
        if (tag == tags) continue;
        if (found[tag].items || slrt_u32(entry + 4) != known[tag].item_bytes || offset > size ||
            items > (size - offset) / known[tag].item_bytes)
            return SL_RUNTIME_SECTION;
        found[tag].items = bytes + offset;
        found[tag].count = items;
    }
    if (found[SLRT_PART].items && found[SLRT_PART].count != 1) return SL_RUNTIME_SECTION;
    if (found[SLRT_PART].items && slrt_u32(found[SLRT_PART].items + 4)) return SL_RUNTIME_SHARD;
    if (found[SLRT_VCIN].items && !found[SLRT_PVSO].items && !found[SLRT_PVSB].items)
        found[SLRT_PVSO].count = found[SLRT_CELL].count + 1; // rows are the view cells'
    else if (!found[SLRT_PVSO].items || !found[SLRT_PVSB].items)
        return SL_RUNTIME_SECTION;
    for (tag = 0; tag < SLRT_PVSO; tag++)
        if (!found[tag].items) return SL_RUNTIME_SECTION;
    return SL_RUNTIME_OK;
}
