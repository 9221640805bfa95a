/// Tiled's notations. XML files become trees in the shape of the JSON files (what both call the
/// same things is in the TMX and JSON pages of Tiled's manual). Tiles of a layer are numbers in an
/// array, in comma-separated text, or in base64, which may be packed by zlib, gzip or zstd.
#include "io/tiled/tiled.h"

#include "io/parts/base64.h"
#include "io/parts/document.h"
#include "map/scan.h"

#include <zlib.h>
#include <zstd.h>

// --- XML in the shape of JSON

/// An element that is an item of one of its parent's arrays, and what its "type" is there.
typedef struct item_kind {
    const char *element, *array, *type;
} item_kind;

static const item_kind item_kinds[] = {
    {"layer", "layers", "tilelayer"},
    {"objectgroup", "layers", "objectgroup"},
    {"imagelayer", "layers", "imagelayer"},
    {"group", "layers", "group"},
    {"tileset", "tilesets", NULL},
    {"tile", "tiles", NULL},
    {"object", "objects", NULL},
    {"property", "properties", NULL},
    {"terrain", "terrains", NULL},
    {"wangset", "wangsets", NULL},
    {"wangcolor", "colors", NULL},
    {"wangtile", "wangtiles", NULL},
};
#define ITEM_KIND_COUNT (sizeof item_kinds / sizeof *item_kinds)

/// Elements that hold items and are no objects in JSON.
typedef struct holder {
    const char *element, *item;
} holder;

static const holder holders[] = {
    {"properties", "property"}, {"terraintypes", "terrain"}, {"wangsets", "wangset"}};
#define HOLDER_COUNT (sizeof holders / sizeof *holders)

static const char *const shapes[] = {"ellipse", "point", "text", "capsule"};
#define SHAPE_COUNT (sizeof shapes / sizeof *shapes)

/// Each of the functions below returns false, or NULL, for lack of memory alone.
static bool set(json_t *object, const char *key, json_t *value) {
    return json_object_set_new(object, key, value) == 0;
}

/// Text that libxml2 gave, as a value; frees it.
static json_t *take_text(char *text) {
    json_t *value = text ? json_string(text) : NULL;
    sli_xml_free(text);
    return value;
}

static json_t *content_of(const xmlNode *node) {
    return take_text(sli_xml_content(node));
}

/// An object of the element's attributes.
static json_t *attributes_of(const xmlNode *node) {
    json_t *object = json_object();
    bool good = object && set(object, SLI_JSON_LINE, json_integer(sli_xml_line(node)));
    for (const xmlAttr *each = node->properties; good && each; each = each->next) {
        const char *key = (const char *)each->name;
        good = set(object, key, take_text(sli_xml_attribute(node, key)));
    }
    if (good) return object;
    json_decref(object);
    return NULL;
}

/// Appends to an array of the object, made if it is not there.
static bool append(json_t *object, const char *key, json_t *value) {
    json_t *array = json_object_get(object, key);
    if (!array && set(object, key, json_array())) array = json_object_get(object, key);
    if (array) return json_array_append_new(array, value) == 0;
    json_decref(value);
    return false;
}

/// The number of a <tile> of a layer; 0 where it has none, as Tiled reads it.
static json_t *gid_of(const xmlNode *tile) {
    char *text = sli_xml_attribute(tile, "gid");
    if (text) return take_text(text);
    return json_integer(0);
}

/// The tiles of a <data> or <chunk>: text, or an array of the numbers of its <tile> elements.
static json_t *tiles_of(const xmlNode *data) {
    json_t *array = NULL;
    for (const xmlNode *child = data->children; child; child = child->next) {
        if (!sli_xml_is(child, "tile")) continue;
        if (!array && !(array = json_array())) return NULL;
        if (json_array_append_new(array, gid_of(child)) == 0) continue;
        json_decref(array);
        return NULL;
    }
    return array ? array : content_of(data);
}

static bool add_chunk(json_t *layer, const xmlNode *chunk) {
    json_t *object = attributes_of(chunk);
    if (object && set(object, "data", tiles_of(chunk))) return append(layer, "chunks", object);
    json_decref(object);
    return false;
}

/// <data>: how it is written is said of the layer in JSON.
static bool add_data(json_t *layer, const xmlNode *data) {
    static const char *const keys[] = {"encoding", "compression"};
    for (size_t i = 0; i < 2; i++) {
        char *text = sli_xml_attribute(data, keys[i]);
        if (text && !set(layer, keys[i], take_text(text))) return false;
    }
    bool chunks = false;
    for (const xmlNode *child = data->children; child; child = child->next) {
        if (!sli_xml_is(child, "chunk")) continue;
        chunks = true;
        if (!add_chunk(layer, child)) return false;
    }
    return chunks || set(layer, "data", tiles_of(data));
}

static json_t *convert(const xmlNode *node);

static bool add_item(json_t *parent, const item_kind *kind, const xmlNode *node) {
    json_t *object = convert(node);
    if (!object) return false;
    bool good = !kind->type || set(object, "type", json_string(kind->type));
    // A property's longer text is its content.
    if (good && sli_xml_is(node, "property") && !json_object_get(object, "value"))
        good = set(object, "value", content_of(node));
    if (good) return append(parent, kind->array, object);
    json_decref(object);
    return false;
}

static bool add_child(json_t *parent, const xmlNode *node);

/// Adds the items of an element that only holds them.
static bool add_held(json_t *parent, const holder *of, const xmlNode *node) {
    for (const xmlNode *child = node->children; child; child = child->next)
        if (sli_xml_is(child, of->item) && !add_child(parent, child)) return false;
    return true;
}

static bool add_child(json_t *parent, const xmlNode *node) {
    const bool in_tile = sli_xml_is(node->parent, "tile");
    if (in_tile && sli_xml_is(node, "objectgroup"))
        return set(parent, "objectgroup", convert(node));
    if (sli_xml_is(node, "data")) return add_data(parent, node);
    if (sli_xml_is(node, "image")) {
        char *source = sli_xml_attribute(node, "source");
        return !source || set(parent, "image", take_text(source));
    }
    if (sli_xml_is(node, "tileoffset") || sli_xml_is(node, "grid"))
        return set(parent, (const char *)node->name, convert(node));
    if (sli_xml_is(node, "polygon") || sli_xml_is(node, "polyline")) {
        char *points = sli_xml_attribute(node, "points");
        return set(parent, (const char *)node->name, points ? take_text(points) : json_string(""));
    }
    for (size_t i = 0; i < HOLDER_COUNT; i++)
        if (sli_xml_is(node, holders[i].element)) return add_held(parent, &holders[i], node);
    for (size_t i = 0; i < SHAPE_COUNT; i++)
        if (sli_xml_is(node, shapes[i])) return set(parent, shapes[i], json_true());
    for (size_t i = 0; i < ITEM_KIND_COUNT; i++)
        if (sli_xml_is(node, item_kinds[i].element)) return add_item(parent, &item_kinds[i], node);
    return true;
}

/// An element with all that is in it.
static json_t *convert(const xmlNode *node) {
    json_t *object = attributes_of(node);
    for (const xmlNode *child = node->children; object && child; child = child->next) {
        if (child->type != XML_ELEMENT_NODE || add_child(object, child)) continue;
        json_decref(object);
        object = NULL;
    }
    return object;
}

sl_status sli_tiled_from_xml(sl_context *context, const char *name, const char *root,
                             const char *text, size_t size, sli_json_file *file) {
    xmlDoc *document;
    SL_TRY(sli_xml_read(context, name, text, size, &document));
    const xmlNode *first = xmlDocGetRootElement(document);
    sl_status status = SL_OK;
    if (!sli_xml_is(first, root)) {
        const char *found = (const char *)first->name;
        status = sl_fail_at(context, name, sli_xml_line(first), "expected <%s>, found <%s>", root,
                            sli_show((sli_word){found, strlen(found)}).text);
    } else {
        json_t *tree = convert(first);
        if (tree)
            *file = (sli_json_file){
                .context = context, .name = name, .root = tree, .numbers_as_text = true};
        else
            status = sl_fail_memory(context);
    }
    xmlFreeDoc(document);
    return status;
}

// --- tiles

/// No codec makes more than this many bytes of one: a layer that would need it gets no memory.
#define MOST_EXPANSION 65536

typedef struct bytes {
    unsigned char *at;
    size_t size;
} bytes;

static sl_status read_array(const sli_json *data, size_t count, uint32_t *gids) {
    for (size_t i = 0; i < count; i++) {
        if (i % 65536 == 0) SL_TRY(sl_check_cancelled(data->file->context));
        const sli_json item = sli_json_item(data, i);
        int64_t gid;
        SL_TRY(sli_json_whole(&item, 0, UINT32_MAX, &gid));
        gids[i] = (uint32_t)gid;
    }
    return SL_OK;
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Whole numbers with commas between; blanks anywhere about them.
static sl_status read_csv(const sli_json *data, const char *text, size_t count, uint32_t *gids) {
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
            return sli_json_fail(data, "tile %zu of %zu: expected a whole number, found '%s'",
                                 found + 1, count,
                                 sli_show((sli_word){first, strcspn(first, ", \t\r\n")}).text);
        if (found == count) return sli_json_fail(data, "more than the layer's %zu tiles", count);
        gids[found++] = (uint32_t)value;
        while (is_blank(*at)) at++;
        if (!*at) break;
        if (*at != ',')
            return sli_json_fail(data, "tile %zu of %zu: expected ',', found '%s'", found, count,
                                 sli_show((sli_word){at, strcspn(at, ", \t\r\n")}).text);
    }
    if (found == count) return SL_OK;
    return sli_json_fail(data, "%zu tiles, the layer has %zu", found, count);
}

/// `out->at` has room for all.
static sl_status decode_base64(const sli_json *data, const char *text, bytes *out) {
    size_t wrong;
    if (sli_base64_decode(text, out->at, &out->size, &wrong)) return SL_OK;
    if (wrong) return sli_json_fail(data, "character %zu is not base64", wrong);
    return sli_json_fail(data, "the base64 text is cut off");
}

static sl_status fail_size(const sli_json *data, size_t count) {
    return sli_json_fail(data, "the data is not that of the layer's %zu tiles, of 4 bytes each",
                         count);
}

static void *resize_for_zlib(void *context, uInt count, uInt size) {
    return sl_alloc_array(context, count, size);
}

static void free_for_zlib(void *context, void *block) {
    sl_free(context, block);
}

/// zlib and gzip. Their first bytes say which one it is.
static sl_status inflate_all(const sli_json *data, bytes packed, bytes *out) {
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
    return sli_json_fail(data, "the compressed data is damaged: %s", why);
}

static sl_status unpack_zstd(const sli_json *data, bytes packed, bytes *out) {
    const size_t got = ZSTD_decompress(out->at, out->size, packed.at, packed.size);
    if (!ZSTD_isError(got)) return got == out->size ? SL_OK : fail_size(data, out->size / 4);
    const char *why = ZSTD_getErrorName(got);
    if (strstr(why, "too small")) return fail_size(data, out->size / 4);
    return sli_json_fail(data, "the compressed data is damaged: %s", why);
}

static sl_status unpack(const sli_json *data, const char *compression, bytes packed, bytes *out) {
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

static sl_status read_base64(const sli_json *data, const char *compression, const char *text,
                             size_t count, uint32_t *gids) {
    sl_context *context = data->file->context;
    const size_t length = strlen(text), size = 4 * count;
    if (length > UINT32_MAX) return sli_json_fail(data, "more than 2^32 characters");
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
static sl_status find_codec(const sli_json *layer, bool *base64, const char **compression) {
    static const char *const known[] = {"", "zlib", "gzip", "zstd"};
    const sli_json encoding = sli_json_member(layer, "encoding");
    const sli_json packing = sli_json_member(layer, "compression");
    const char *name = "csv";
    *compression = "";
    if (encoding.value) SL_TRY(sli_json_text(&encoding, &name));
    if (packing.value) SL_TRY(sli_json_text(&packing, compression));
    *base64 = strcmp(name, "base64") == 0;
    if (!*base64 && strcmp(name, "csv") != 0)
        return sli_json_fail(&encoding, "'%s' is unknown; csv and base64 are taken",
                             sli_show((sli_word){name, strlen(name)}).text);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(*compression, known[i]) == 0) return SL_OK;
    return sli_json_fail(&packing, "'%s' is unknown; zlib, gzip and zstd are taken",
                         sli_show((sli_word){*compression, strlen(*compression)}).text);
}

static sl_status read_text(const sli_json *layer, const sli_json *data, size_t count,
                           uint32_t *gids) {
    const char *text, *compression;
    bool base64;
    SL_TRY(find_codec(layer, &base64, &compression));
    SL_TRY(sli_json_text(data, &text));
    if (base64) return read_base64(data, compression, text, count, gids);
    return read_csv(data, text, count, gids);
}

sl_status sli_tiled_read_data(const sli_json *layer, const sli_json *data, size_t count,
                              uint32_t **gids) {
    const bool array = json_is_array(data->value);
    if (array && json_array_size(data->value) != count)
        return sli_json_fail(data, "%zu tiles, the layer has %zu", json_array_size(data->value),
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
