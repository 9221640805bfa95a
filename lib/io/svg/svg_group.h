/// Which group of an SVG drawing an element belongs to, by what it is called.
#ifndef SL_SVG_GROUP_H
#define SL_SVG_GROUP_H

#include "io/parts/contents.h"

#include <libxml/tree.h>

/// The attributes by which an element is on a layer; the last two are names that any may have.
extern const char *const sli_svg_layer_names[4];

/// `*group` is that of the element about this one. It becomes the element's own if its layer,
/// label, id or class says what it is; also if the element has a layer, or is a g with a name, and
/// the one about it says nothing.
sl_status sli_svg_find_group(sli_contents *contents, xmlNode *node, uint32_t *group);

#endif
