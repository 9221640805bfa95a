#include "io/tiled_data.h"

#include "map/scan.h"

#include <zlib.h>
#include <zstd.h>

/// No codec makes more than this many bytes of one: a layer that would need it gets no memory.
#define MOST_EXPANSION 65536

typedef struct bytes {
    unsigned char *at;
    size_t size;
} bytes;

static sl_status read_array(const sl_json *data, size_t count, uint32_t *gids) {
    for (size_t i = 0; i < count; i++) {
        if (i % 65536 == 0) SL_TRY(sl_check_cancelled(data->file->context));
        const sl_json item = sl_json_item(data, i);
        int64_t gid;
        SL_TRY(sl_json_whole(&item, 0, UINT32_MAX, &gid));
        gids[i] = (uint32_t)gid;
    }
    return SL_OK;
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Whole numbers with commas between; blanks anywhere about them.
static sl_status read_csv(const sl_json *data, const char *text, size_t count, uint32_t *gids) {
    size_t found = 0;
    for (const char *at = text;; at++) {
        while (is_blank(*at)) at++;
        // Some writers end the list with a comma.
        if (!*at && found == count) return SL_OK;
        uint64_t value = 0;
        const char *first = at;
        for (; *at >= '0' && *at <= '9' && value <= UINT32_MAX; at++)
            value = 10 * value + (uint64_t)(*at - '0');
        if (at == first || value > UINT32_MAX)
            return sl_json_fail(data, "tile %zu of %zu: expected a whole number, found '%s'",
                                found + 1, count,
                                sl_show((sl_word){first, strcspn(first, ", \t\r\n")}).text);
        if (found == count) return sl_json_fail(data, "more than the layer's %zu tiles", count);
        gids[found++] = (uint32_t)value;
        while (is_blank(*at)) at++;
        if (!*at) break;
        if (*at != ',')
            return sl_json_fail(data, "tile %zu of %zu: expected ',', found '%s'", found, count,
                                sl_show((sl_word){at, strcspn(at, ", \t\r\n")}).text);
    }
    if (found == count) return SL_OK;
    return sl_json_fail(data, "%zu tiles, the layer has %zu", found, count);
}

/// The six bits of a character of base64 (RFC 4648), or -1.
static int six_bits(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// `out->at` has room for all; blanks between the characters are passed over.
static sl_status decode_base64(const sl_json *data, const char *text, bytes *out) {
    uint32_t bits = 0, pads = 0;
    size_t characters = 0;
    for (const char *at = text; *at; at++) {
        if (is_blank(*at)) continue;
        const int value = six_bits(*at);
        pads += *at == '=';
        if ((value < 0 && *at != '=') || (value >= 0 && pads))
            return sl_json_fail(data, "character %zu is not base64", (size_t)(at - text) + 1);
        bits = bits << 6 | (value < 0 ? 0u : (uint32_t)value);
        if (++characters % 4) continue;
        for (int shift = 16; shift >= 0; shift -= 8)
            out->at[out->size++] = (unsigned char)(bits >> shift);
        bits = 0;
    }
    if (characters % 4 || pads > 2 || (pads && !out->size))
        return sl_json_fail(data, "the base64 text is cut off");
    out->size -= pads;
    return SL_OK;
}

static sl_status fail_size(const sl_json *data, size_t count) {
    return sl_json_fail(data, "the data is not that of the layer's %zu tiles, of 4 bytes each",
                        count);
}

static void *resize_for_zlib(void *context, uInt count, uInt size) {
    return sl_alloc_array(context, count, size);
}

static void free_for_zlib(void *context, void *block) {
    sl_free(context, block);
}

/// zlib and gzip, told apart by their first bytes.
static sl_status inflate_all(const sl_json *data, bytes packed, bytes *out) {
    sl_context *context = data->file->context;
    z_stream stream = {.zalloc = resize_for_zlib,
                       .zfree = free_for_zlib,
                       .opaque = context,
                       .next_in = packed.at,
                       .avail_in = (uInt)packed.size,
                       .next_out = out->at,
                       .avail_out = (uInt)out->size};
    if (inflateInit2(&stream, 15 + 32) != Z_OK) return sl_fail_memory(context);
    const int result = inflate(&stream, Z_FINISH);
    const bool all = result == Z_STREAM_END && stream.avail_out == 0;
    const bool more = result == Z_BUF_ERROR && stream.avail_out == 0;
    const bool less = result == Z_STREAM_END;
    char why[64];
    snprintf(why, sizeof why, "%s", stream.msg ? stream.msg : "it is cut off");
    inflateEnd(&stream);
    if (all) return SL_OK;
    if (result == Z_MEM_ERROR) return sl_fail_memory(context);
    if (more || less) return fail_size(data, out->size / 4);
    return sl_json_fail(data, "the compressed data is damaged: %s", why);
}

static sl_status unpack_zstd(const sl_json *data, bytes packed, bytes *out) {
    const size_t got = ZSTD_decompress(out->at, out->size, packed.at, packed.size);
    if (!ZSTD_isError(got)) return got == out->size ? SL_OK : fail_size(data, out->size / 4);
    const char *why = ZSTD_getErrorName(got);
    if (strstr(why, "too small")) return fail_size(data, out->size / 4);
    return sl_json_fail(data, "the compressed data is damaged: %s", why);
}

static sl_status unpack(const sl_json *data, const char *compression, bytes packed, bytes *out) {
    if (!*compression) {
        if (packed.size != out->size) return fail_size(data, out->size / 4);
        memcpy(out->at, packed.at, packed.size);
        return SL_OK;
    }
    if (strcmp(compression, "zstd") == 0) return unpack_zstd(data, packed, out);
    return inflate_all(data, packed, out);
}

/// Tiled writes the numbers' lowest byte first, on all machines.
static void put_together(const unsigned char *from, size_t count, uint32_t *gids) {
    for (size_t i = 0; i < count; i++, from += 4)
        gids[i] =
            from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24;
}

static sl_status read_base64(const sl_json *data, const char *compression, const char *text,
                             size_t count, uint32_t *gids) {
    sl_context *context = data->file->context;
    const size_t length = strlen(text), size = 4 * count;
    if (length > UINT32_MAX) return sl_json_fail(data, "more than 2^32 characters");
    bytes packed = {.at = sl_alloc_array(context, length / 4 + 1, 3)};
    bytes plain = {.at = sl_alloc_array(context, count, 4), .size = size};
    sl_status status = packed.at && plain.at ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = decode_base64(data, text, &packed);
    if (status == SL_OK) status = unpack(data, compression, packed, &plain);
    if (status == SL_OK) put_together(plain.at, count, gids);
    sl_free(context, packed.at);
    sl_free(context, plain.at);
    return status;
}

/// How the layer's text is written; refused by name where that is not known.
static sl_status find_codec(const sl_json *layer, bool *base64, const char **compression) {
    static const char *const known[] = {"", "zlib", "gzip", "zstd"};
    const sl_json encoding = sl_json_member(layer, "encoding");
    const sl_json packing = sl_json_member(layer, "compression");
    const char *name = "csv";
    *compression = "";
    if (encoding.value) SL_TRY(sl_json_text(&encoding, &name));
    if (packing.value) SL_TRY(sl_json_text(&packing, compression));
    *base64 = strcmp(name, "base64") == 0;
    if (!*base64 && strcmp(name, "csv") != 0)
        return sl_json_fail(&encoding, "'%s' is unknown; csv and base64 are taken",
                            sl_show((sl_word){name, strlen(name)}).text);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(*compression, known[i]) == 0) return SL_OK;
    return sl_json_fail(&packing, "'%s' is unknown; zlib, gzip and zstd are taken",
                        sl_show((sl_word){*compression, strlen(*compression)}).text);
}

static sl_status read_text(const sl_json *layer, const sl_json *data, size_t count,
                           uint32_t *gids) {
    const char *text, *compression;
    bool base64;
    SL_TRY(find_codec(layer, &base64, &compression));
    SL_TRY(sl_json_text(data, &text));
    if (base64) return read_base64(data, compression, text, count, gids);
    return read_csv(data, text, count, gids);
}

sl_status sl_tiled_read_data(const sl_json *layer, const sl_json *data, size_t count,
                             uint32_t **gids) {
    const bool array = json_is_array(data->value);
    if (array && json_array_size(data->value) != count)
        return sl_json_fail(data, "%zu tiles, the layer has %zu", json_array_size(data->value),
                            count);
    const size_t length = json_string_length(data->value);
    if (!array && length < count / (MOST_EXPANSION / 4)) return fail_size(data, count);
    uint32_t *read = sl_alloc_array(data->file->context, count, sizeof *read);
    if (!read) return SL_NO_MEMORY;
    const sl_status status =
        array ? read_array(data, count, read) : read_text(layer, data, count, read);
    if (status == SL_OK)
        *gids = read;
    else
        sl_free(data->file->context, read);
    return status;
}
