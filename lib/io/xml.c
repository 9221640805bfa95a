#include "io/xml.h"

#include "sightline/support.h"

#include <libxml/parser.h>
#include <limits.h>
#include <string.h>

/// The longest text that libxml2 takes where it is not told to take all.
#define LONGEST_TEXT 10000000

/// libxml2's message as one line that is safe to show.
static sl_status fail(sl_context *context, const char *name, const xmlError *error) {
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

sl_status sl_xml_read(sl_context *context, const char *name, const char *text, size_t size,
                      xmlDoc **out) {
    if (size == 0 || size > INT_MAX)
        return sl_fail_at(context, name, 0, size ? "too large for XML" : "the file is empty");
    xmlParserCtxt *parser = xmlNewParserCtxt();
    if (!parser) return sl_fail_memory(context);
    int options = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_NOCDATA |
                  XML_PARSE_BIG_LINES;
    if (size > LONGEST_TEXT) {
        options |= XML_PARSE_HUGE;
        parser->sax->entityDecl = refuse_entity;
    }
    xmlDoc *document = xmlCtxtReadMemory(parser, text, (int)size, NULL, NULL, options);
    sl_status status = SL_OK;
    if (parser->_private)
        status = sl_fail_at(context, name, 0, "XML: it declares entities");
    else if (!document || !xmlDocGetRootElement(document))
        status = fail(context, name, xmlCtxtGetLastError(parser));
    if (status != SL_OK) {
        xmlFreeDoc(document);
        document = NULL;
    }
    xmlFreeParserCtxt(parser);
    *out = document;
    return status;
}

bool sl_xml_is(const xmlNode *node, const char *name) {
    return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

/// Entities of the document's own are not followed: a few of them can stand for any length.
static char *plain_text(const xmlNode *node) {
    xmlChar *text = NULL;
    for (; node; node = node->next)
        if (node->type == XML_TEXT_NODE) text = xmlStrcat(text, node->content);
    return (char *)(text ? text : xmlStrdup((const xmlChar *)""));
}

char *sl_xml_attribute(const xmlNode *node, const char *name) {
    for (const xmlAttr *each = node->properties; each; each = each->next)
        if (strcmp((const char *)each->name, name) == 0) return plain_text(each->children);
    return NULL;
}

char *sl_xml_content(const xmlNode *node) {
    return plain_text(node->children);
}

void sl_xml_free(char *text) {
    xmlFree(text);
}

uint32_t sl_xml_line(const xmlNode *node) {
    const long line = xmlGetLineNo(node);
    return line > 0 ? (uint32_t)line : 0;
}
