/// How much an SVG drawing gives, before it is drawn, and its elements by their ids.
#ifndef SL_SVG_COUNT_H
#define SL_SVG_COUNT_H

#include "io/svg/svg_style.h"
#include "sightline/import.h"

/// An element that uses may name, and what it gives.
typedef struct sli_svg_id {
    char *id;
    xmlNode *node;
    size_t place;                     ///< in the document
    uint64_t entities, walls, height; ///< with all that is in it and that it uses
    enum { SLI_SVG_UNKNOWN, SLI_SVG_COUNTING, SLI_SVG_KNOWN } state;
} sli_svg_id;

/// Sorted by id, then by place.
typedef struct sli_svg_ids {
    SL_ARRAY(sli_svg_id) items;
} sli_svg_ids;

/// Into zeroed ids; sli_svg_ids_destroy() is the caller's, in any case.
sl_status sli_svg_ids_read(sl_context *context, xmlNode *root, sli_svg_ids *ids);
void sli_svg_ids_destroy(sl_context *context, sli_svg_ids *ids);
/// The first element of an id; NULL for none.
xmlNode *sli_svg_find(const sli_svg_ids *ids, const char *id);

/// SL_BAD_INPUT where the drawing, with all that its uses repeat, gives more than the limits, or a
/// use holds itself.
sl_status sli_svg_check_amount(sl_context *context, const char *name,
                               const sl_import_options *options, xmlNode *root,
                               const sli_svg_style *style, sli_svg_ids *ids);

#endif
