/// What the attributes, the style and the style sheets of a drawing hide.
#ifndef SL_SVG_STYLE_H
#define SL_SVG_STYLE_H

#include "map/scan.h"
#include "sightline/support.h"

#include <libxml/tree.h>

/// A rule of a sheet that may hide, for one of its selectors. Both point into the sheet.
typedef struct sli_svg_rule {
    sli_word selector, body;
    uint64_t weight; ///< the larger one counts
} sli_svg_rule;

typedef struct sli_svg_style {
    SL_ARRAY(char *) sheets;
    SL_ARRAY(sli_svg_rule) rules;
    size_t unread; ///< rules whose selectors are not known here
} sli_svg_style;

/// Reads the style elements of a document. sli_svg_style_destroy is the caller's, in any case.
sl_status sli_svg_style_read(sl_context *context, const xmlNode *root, sli_svg_style *style);
void sli_svg_style_destroy(sl_context *context, sli_svg_style *style);

/// Whether an element has display:none or visibility:hidden itself.
bool sli_svg_hides(const sli_svg_style *style, const xmlNode *node);

#endif
