/// XML documents through libxml2: read from memory, with its errors as ours, and asked by names
/// without their namespaces.
#ifndef SL_IMPORT_XML_H
#define SL_IMPORT_XML_H

#include "sightline/context.h"

#include <libxml/tree.h>

/// Reads a document that is all there and has a root element. No other file is looked at, and
/// entities are not followed; a document of more than 10 MB must not declare any. SL_BAD_INPUT with
/// the line. To be freed by xmlFreeDoc.
sl_status sl_xml_read(sl_context *context, const char *name, const char *text, size_t size,
                      xmlDoc **out);

bool sl_xml_is(const xmlNode *node, const char *name);

/// The attribute's value, whatever its namespace; NULL where there is none. To be given back to
/// sl_xml_free, which takes NULL.
char *sl_xml_attribute(const xmlNode *node, const char *name);
/// The text that stands in an element, without that of elements in it; NULL for lack of memory. To
/// be given back to sl_xml_free.
char *sl_xml_content(const xmlNode *node);
void sl_xml_free(char *text);

uint32_t sl_xml_line(const xmlNode *node);

#endif
