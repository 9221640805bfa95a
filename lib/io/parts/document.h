/// JSON and XML documents as importers read them: every value says where in the file it stands.
#ifndef SL_DOCUMENT_H
#define SL_DOCUMENT_H

#include "sightline/context.h"
#include "sightline/support.h"

#include <jansson.h>
#include <libxml/tree.h>

// --- JSON: a value knows its way from the root, so that a message can say what is wrong where

/// The member that holds an object's line in the file where the tree was made of another notation.
#define SLI_JSON_LINE "#line"

typedef struct sli_json_file {
    sl_context *context;
    const char *name;
    json_t *root;
    bool numbers_as_text; ///< the tree is made of a notation that has text only: "12" is a number
} sli_json_file;

/// A value and where it stands. It points to the place it was found from, which must outlive it.
typedef struct sli_json {
    const sli_json_file *file;
    json_t *value; ///< NULL for none, or null
    const struct sli_json *parent;
    const char *key; ///< NULL for an item of an array
    size_t index;
} sli_json;

/// Reads a text; SL_BAD_INPUT with line and column where it is not JSON. sli_json_close is the
/// caller's.
sl_status sli_json_open(sl_context *context, const char *name, const char *text, size_t size,
                        sli_json_file *file);
/// Does nothing to one that is zeroed.
void sli_json_close(sli_json_file *file);

sli_json sli_json_root(const sli_json_file *file);
/// The member of an object, none where there is no such member or `parent` is no object.
sli_json sli_json_member(const sli_json *parent, const char *key);
sli_json sli_json_item(const sli_json *parent, size_t index);

/// SL_BAD_INPUT: "FILE: levels[2].pxWid: ", led by the line where it is known, then the message.
sl_status sli_json_fail(const sli_json *at, const char *format, ...) SL_PRINTF(2, 3);

/// The line of the nearest object about the value that has one; 0 for none.
unsigned sli_json_line(const sli_json *at);

/// Each gives the value, or fails where it is not there or not of this kind.
sl_status sli_json_array(const sli_json *at, size_t *count);
sl_status sli_json_object(const sli_json *at);
/// A coordinate: of a magnitude up to SL_COORDINATE_MAX; one too small to be used is 0.
sl_status sli_json_number(const sli_json *at, double *number);
/// A whole number from low to high, written with a point or without.
sl_status sli_json_whole(const sli_json *at, int64_t low, int64_t high, int64_t *number);
/// The text lives as long as the file.
sl_status sli_json_text(const sli_json *at, const char **text);
/// The text of a member; "" where there is none.
const char *sli_json_text_of(const sli_json *parent, const char *key);

/// As sli_json_number and sli_json_whole, but `*number` stays as it is where there is no value.
sl_status sli_json_number_if(const sli_json *at, double *number);
sl_status sli_json_whole_if(const sli_json *at, int64_t low, int64_t high, int64_t *number);
/// The number, 0 for what is none: for what only says how to write the file again.
double sli_json_number_or_0(const sli_json *at);
/// True for true, and for a number other than 0; false for no value. `*said`, where not NULL, tells
/// whether the value is of such a kind at all.
bool sli_json_true(const sli_json *at, bool *said);

// --- XML through libxml2, asked by names without their namespaces

/// Reads a document that is all there and has a root element. No other file is looked at, and
/// entities are not followed; a document of more than 10 MB must not declare any. SL_BAD_INPUT with
/// the line. To be freed by xmlFreeDoc.
sl_status sli_xml_read(sl_context *context, const char *name, const char *text, size_t size,
                       xmlDoc **out);

bool sli_xml_is(const xmlNode *node, const char *name);

/// The attribute's value, whatever its namespace; NULL where there is none. To be given back to
/// sli_xml_free, which takes NULL.
char *sli_xml_attribute(const xmlNode *node, const char *name);
/// The text that stands in an element, without that of elements in it; NULL for lack of memory. To
/// be given back to sli_xml_free.
char *sli_xml_content(const xmlNode *node);
void sli_xml_free(char *text);

uint32_t sli_xml_line(const xmlNode *node);

#endif
