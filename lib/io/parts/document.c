/// Documents through jansson and libxml2. Both libraries check the notation; this file turns their
/// errors into ours, with file and line, and gives values by name and kind. No entity is followed
/// and no other file is opened.
#include "io/parts/document.h"

#include "io/parts/limits.h"
#include "map/scan.h"
#include "sightline/support.h"

#include <libxml/parser.h>
#include <limits.h>
#include <math.h>
#include <string.h>

// --- JSON

sl_status sli_json_open(sl_context *context, const char *name, const char *text, size_t size,
                        sli_json_file *file) {
    const char *begin = sli_skip_mark(text, size);
    json_error_t error;
    json_t *root = json_loadb(begin ? begin : "", size - (size_t)(begin - text), 0, &error);
    if (!root) {
        if (json_error_code(&error) == json_error_out_of_memory) return sl_fail_memory(context);
        const sli_word what = {error.text, strlen(error.text)};
        char shown[JSON_ERROR_TEXT_LENGTH];
        snprintf(shown, sizeof shown, "%.*s", (int)what.length, what.at);
        for (char *at = shown; *at; at++)
            if ((unsigned char)*at < 0x20 || *at == 0x7f) *at = '?';
        const unsigned line = error.line > 0 ? (unsigned)error.line : 0;
        return sl_fail_at(context, name, line, "column %d: no JSON: %s", error.column, shown);
    }
    *file = (sli_json_file){.context = context, .name = name, .root = root};
    return SL_OK;
}

void sli_json_close(sli_json_file *file) {
    json_decref(file->root);
    *file = (sli_json_file){0};
}

static json_t *present(json_t *value) {
    return value && json_is_null(value) ? NULL : value;
}

sli_json sli_json_root(const sli_json_file *file) {
    return (sli_json){.file = file, .value = file->root};
}

sli_json sli_json_member(const sli_json *parent, const char *key) {
    return (sli_json){.file = parent->file,
                      .value = present(json_object_get(parent->value, key)),
                      .parent = parent,
                      .key = key};
}

sli_json sli_json_item(const sli_json *parent, size_t index) {
    return (sli_json){.file = parent->file,
                      .value = present(json_array_get(parent->value, index)),
                      .parent = parent,
                      .index = index};
}

/// The way from the root, from its end: each step is put before what is there.
static const char *way_to(const sli_json *at, char *buffer, size_t size) {
    size_t begin = size - 1;
    buffer[begin] = '\0';
    for (; at->parent; at = at->parent) {
        char step[64];
        if (at->key)
            snprintf(step, sizeof step, "%s%.48s", at->parent->parent ? "." : "", at->key);
        else
            snprintf(step, sizeof step, "[%zu]", at->index);
        const size_t length = strlen(step);
        if (length + 3 > begin) {
            begin -= 3;
            memcpy(buffer + begin, "...", 3);
            break;
        }
        begin -= length;
        memcpy(buffer + begin, step, length);
    }
    return buffer + begin;
}

unsigned sli_json_line(const sli_json *at) {
    for (; at; at = at->parent) {
        const json_t *line = json_object_get(at->value, SLI_JSON_LINE);
        if (line) return (unsigned)json_integer_value(line);
    }
    return 0;
}

sl_status sli_json_fail(const sli_json *at, const char *format, ...) {
    char what[512], way[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    const char *steps = way_to(at, way, sizeof way);
    return sl_fail_at(at->file->context, at->file->name, sli_json_line(at), "%s%s%s", steps,
                      *steps ? ": " : "", what);
}

static sl_status fail_kind(const sli_json *at, const char *expected) {
    static const char *const kinds[] = {"an object",     "an array", "text", "a whole number",
                                        "a real number", "true",     "false"};
    if (!at->value) return sli_json_fail(at, "expected %s, found nothing", expected);
    if (json_is_string(at->value)) {
        const char *text = json_string_value(at->value);
        return sli_json_fail(at, "expected %s, found '%s'", expected,
                             sli_show((sli_word){text, strlen(text)}).text);
    }
    if (json_is_number(at->value))
        return sli_json_fail(at, "expected %s, found %g", expected, json_number_value(at->value));
    return sli_json_fail(at, "expected %s, found %s", expected, kinds[json_typeof(at->value)]);
}

sl_status sli_json_array(const sli_json *at, size_t *count) {
    if (!json_is_array(at->value)) return fail_kind(at, "an array");
    *count = json_array_size(at->value);
    return SL_OK;
}

sl_status sli_json_object(const sli_json *at) {
    return json_is_object(at->value) ? SL_OK : fail_kind(at, "an object");
}

/// The number that a value is, or that its text says where that is the notation.
static bool number_of(const sli_json *at, double *number) {
    if (json_is_number(at->value)) {
        *number = json_number_value(at->value);
        return true;
    }
    if (!at->file->numbers_as_text || !json_is_string(at->value)) return false;
    return sl_number_read(json_string_value(at->value), json_string_length(at->value), number);
}

sl_status sli_json_number(const sli_json *at, double *number) {
    double value;
    if (!number_of(at, &value)) return fail_kind(at, "a number");
    value = sli_coordinate(value);
    if (!sl_coordinate_usable(value))
        return sli_json_fail(at, "%g is out of range: expected a magnitude up to %g", value,
                             SL_COORDINATE_MAX);
    *number = value;
    return SL_OK;
}

/// "3 is out of range: expected 1 or 2"
static sl_status fail_whole(const sli_json *at, const char *found, int64_t low, int64_t high) {
    const long long least = low, most = high;
    char expected[80] = "no number";
    if (high == low)
        snprintf(expected, sizeof expected, "%lld", least);
    else if (high > low)
        snprintf(expected, sizeof expected, "%s%lld %s %lld",
                 high - 1 == low ? "" : "a whole number from ", least,
                 high - 1 == low ? "or" : "to", most);
    return sli_json_fail(at, "%s is out of range: expected %s", found, expected);
}

sl_status sli_json_whole(const sli_json *at, int64_t low, int64_t high, int64_t *number) {
    double value;
    char found[32];
    if (json_is_integer(at->value)) {
        const int64_t whole = json_integer_value(at->value);
        if (whole >= low && whole <= high) {
            *number = whole;
            return SL_OK;
        }
        snprintf(found, sizeof found, "%lld", (long long)whole);
        return fail_whole(at, found, low, high);
    }
    if (!number_of(at, &value) || value != floor(value)) return fail_kind(at, "a whole number");
    if (!(value >= (double)low && value <= (double)high)) {
        snprintf(found, sizeof found, "%g", value);
        return fail_whole(at, found, low, high);
    }
    *number = (int64_t)value;
    return SL_OK;
}

sl_status sli_json_text(const sli_json *at, const char **text) {
    if (!json_is_string(at->value)) return fail_kind(at, "text");
    *text = json_string_value(at->value);
    return SL_OK;
}

const char *sli_json_text_of(const sli_json *parent, const char *key) {
    const char *text = json_string_value(sli_json_member(parent, key).value);
    return text ? text : "";
}

double sli_json_number_or_0(const sli_json *at) {
    double number = 0;
    const char *text = at->file->numbers_as_text ? json_string_value(at->value) : NULL;
    if (text && !sl_number_read(text, strlen(text), &number)) number = 0;
    if (json_is_number(at->value)) number = json_number_value(at->value);
    return sl_coordinate_usable(number) ? number : 0;
}

sl_status sli_json_number_if(const sli_json *at, double *number) {
    return at->value ? sli_json_number(at, number) : SL_OK;
}

sl_status sli_json_whole_if(const sli_json *at, int64_t low, int64_t high, int64_t *number) {
    return at->value ? sli_json_whole(at, low, high, number) : SL_OK;
}

bool sli_json_true(const sli_json *at, bool *said) {
    const char *text = json_string_value(at->value);
    double number = 0;
    bool is_said = true, is_true = json_is_true(at->value);
    if (text && (strcmp(text, "true") == 0 || strcmp(text, "false") == 0))
        is_true = *text == 't';
    else if (number_of(at, &number))
        is_true = number != 0;
    else
        is_said = json_is_boolean(at->value);
    if (said) *said = is_said;
    return is_true;
}

// --- XML

/// The longest text that libxml2 takes by default.
#define LONGEST_TEXT 10000000

/// libxml2's message as one line that is safe to show.
static sl_status fail_xml(sl_context *context, const char *name, const xmlError *error) {
    char message[256] = "not well formed";
    if (error && error->message) {
        size_t length = strcspn(error->message, "\n");
        if (length >= sizeof message) length = sizeof message - 1;
        memcpy(message, error->message, length);
        message[length] = '\0';
        for (char *at = message; *at; at++)
            if ((unsigned char)*at < 0x20 || (unsigned char)*at >= 0x7f) *at = '?';
    }
    return sl_fail_at(context, name, error && error->line > 0 ? (unsigned)error->line : 0,
                      "XML: %s", message);
}

/// In a document whose texts may be of any length, entities could be nested to any length too.
static void refuse_entity(void *user, const xmlChar *name, int type, const xmlChar *public_id,
                          const xmlChar *system_id, xmlChar *content) {
    (void)name, (void)type, (void)public_id, (void)system_id, (void)content;
    xmlParserCtxt *parser = user;
    parser->_private = parser;
    xmlStopParser(parser);
}

/// Whether the parser gave up on elements within elements, which it counts for itself.
static bool is_too_deep(const xmlError *error) {
    return error && error->message && strstr(error->message, "Excessive depth");
}

static sl_status read_xml(sl_context *context, const char *name, const char *text, size_t size,
                          bool huge, xmlDoc **out, bool *deep) {
    xmlParserCtxt *parser = xmlNewParserCtxt();
    if (!parser) return sl_fail_memory(context);
    int options = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_NOCDATA |
                  XML_PARSE_BIG_LINES;
    if (huge) {
        options |= XML_PARSE_HUGE;
        parser->sax->entityDecl = refuse_entity;
    }
    xmlDoc *document = xmlCtxtReadMemory(parser, text, (int)size, NULL, NULL, options);
    const xmlError *error = xmlCtxtGetLastError(parser);
    sl_status status = SL_OK;
    *deep = is_too_deep(error);
    if (parser->_private)
        status = sl_fail_at(context, name, 0, "XML: it declares entities");
    else if (!document || !xmlDocGetRootElement(document))
        status = fail_xml(context, name, error);
    if (status != SL_OK) {
        xmlFreeDoc(document);
        document = NULL;
    }
    xmlFreeParserCtxt(parser);
    *out = document;
    return status;
}

/// More levels of elements than a parser takes, and more than --max-depth may allow.
enum { PARSED_DEPTH = 2048 };

sl_status sli_xml_read(sl_context *context, const char *name, const char *text, size_t size,
                       xmlDoc **out) {
    bool deep;
    if (size == 0 || size > INT_MAX)
        return sl_fail_at(context, name, 0, size ? "too large for XML" : "the file is empty");
    const bool huge = size > LONGEST_TEXT;
    sl_status status = read_xml(context, name, text, size, huge, out, &deep);
    if (deep && !huge) status = read_xml(context, name, text, size, true, out, &deep);
    if (deep)
        SL_TRY(sli_limit_check(context, name, 0, SLI_LIMIT_DEPTH, PARSED_DEPTH,
                               "elements within elements"));
    return status;
}

bool sli_xml_is(const xmlNode *node, const char *name) {
    return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

/// Entities of the document's own are not followed: a few of them can stand for any length.
static char *plain_text(const xmlNode *node) {
    xmlChar *text = NULL;
    for (; node; node = node->next)
        if (node->type == XML_TEXT_NODE) text = xmlStrcat(text, node->content);
    return (char *)(text ? text : xmlStrdup((const xmlChar *)""));
}

char *sli_xml_attribute(const xmlNode *node, const char *name) {
    for (const xmlAttr *each = node->properties; each; each = each->next)
        if (strcmp((const char *)each->name, name) == 0) return plain_text(each->children);
    return NULL;
}

char *sli_xml_content(const xmlNode *node) {
    return plain_text(node->children);
}

void sli_xml_free(char *text) {
    xmlFree(text);
}

uint32_t sli_xml_line(const xmlNode *node) {
    const long line = xmlGetLineNo(node);
    return line > 0 ? (uint32_t)line : 0;
}
