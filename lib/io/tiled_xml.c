// What Tiled's two notations call the same things: the TMX and the JSON pages of its manual.
#include "io/tiled_xml.h"

#include "io/xml.h"
#include "map/scan.h"

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
};
#define ITEM_KIND_COUNT (sizeof item_kinds / sizeof *item_kinds)

static const char *const shapes[] = {"ellipse", "point", "text", "capsule"};
#define SHAPE_COUNT (sizeof shapes / sizeof *shapes)

/// Each of the functions below returns false, or NULL, for lack of memory alone.
static bool set(json_t *object, const char *key, json_t *value) {
    return json_object_set_new(object, key, value) == 0;
}

/// Text that libxml2 gave, as a value; frees it.
static json_t *take_text(char *text) {
    json_t *value = text ? json_string(text) : NULL;
    sl_xml_free(text);
    return value;
}

static json_t *content_of(const xmlNode *node) {
    return take_text(sl_xml_content(node));
}

/// An object of the element's attributes.
static json_t *attributes_of(const xmlNode *node) {
    json_t *object = json_object();
    bool good = object && set(object, SL_JSON_LINE, json_integer(sl_xml_line(node)));
    for (const xmlAttr *each = node->properties; good && each; each = each->next) {
        const char *key = (const char *)each->name;
        good = set(object, key, take_text(sl_xml_attribute(node, key)));
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
    char *text = sl_xml_attribute(tile, "gid");
    if (text) return take_text(text);
    return json_integer(0);
}

/// The tiles of a <data> or <chunk>: text, or an array of the numbers of its <tile> elements.
static json_t *tiles_of(const xmlNode *data) {
    json_t *array = NULL;
    for (const xmlNode *child = data->children; child; child = child->next) {
        if (!sl_xml_is(child, "tile")) continue;
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
        char *text = sl_xml_attribute(data, keys[i]);
        if (text && !set(layer, keys[i], take_text(text))) return false;
    }
    bool chunks = false;
    for (const xmlNode *child = data->children; child; child = child->next) {
        if (!sl_xml_is(child, "chunk")) continue;
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
    if (good && sl_xml_is(node, "property") && !json_object_get(object, "value"))
        good = set(object, "value", content_of(node));
    if (good) return append(parent, kind->array, object);
    json_decref(object);
    return false;
}

static bool add_child(json_t *parent, const xmlNode *node) {
    const bool in_tile = sl_xml_is(node->parent, "tile");
    if (in_tile && sl_xml_is(node, "objectgroup")) return set(parent, "objectgroup", convert(node));
    if (sl_xml_is(node, "data")) return add_data(parent, node);
    if (sl_xml_is(node, "tileoffset")) return set(parent, "tileoffset", convert(node));
    if (sl_xml_is(node, "polygon") || sl_xml_is(node, "polyline")) {
        char *points = sl_xml_attribute(node, "points");
        return set(parent, (const char *)node->name, points ? take_text(points) : json_string(""));
    }
    if (sl_xml_is(node, "properties")) {
        for (const xmlNode *child = node->children; child; child = child->next)
            if (sl_xml_is(child, "property") && !add_child(parent, child)) return false;
        return true;
    }
    for (size_t i = 0; i < SHAPE_COUNT; i++)
        if (sl_xml_is(node, shapes[i])) return set(parent, shapes[i], json_true());
    for (size_t i = 0; i < ITEM_KIND_COUNT; i++)
        if (sl_xml_is(node, item_kinds[i].element)) return add_item(parent, &item_kinds[i], node);
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

sl_status sl_tiled_from_xml(sl_context *context, const char *name, const char *root,
                            const char *text, size_t size, sl_json_file *file) {
    xmlDoc *document;
    SL_TRY(sl_xml_read(context, name, text, size, &document));
    const xmlNode *first = xmlDocGetRootElement(document);
    sl_status status = SL_OK;
    if (!sl_xml_is(first, root)) {
        const char *found = (const char *)first->name;
        status = sl_fail_at(context, name, sl_xml_line(first), "expected <%s>, found <%s>", root,
                            sl_show((sl_word){found, strlen(found)}).text);
    } else {
        json_t *tree = convert(first);
        if (tree)
            *file = (sl_json_file){
                .context = context, .name = name, .root = tree, .numbers_as_text = true};
        else
            status = sl_fail_memory(context);
    }
    xmlFreeDoc(document);
    return status;
}
