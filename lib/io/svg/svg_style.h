/// What the attributes, the style and the style sheets of a drawing say of an element: whether it
/// is seen, and its transform.
#ifndef SL_SVG_STYLE_H
#define SL_SVG_STYLE_H

#include "map/scan.h"
#include "sightline/support.h"

#include <libxml/tree.h>

/// A rule of a sheet, for one of its selectors. All point into the sheet.
typedef struct sli_svg_rule {
    sli_word key; ///< the first part of its last compound: only elements that have it may fit
    sli_word selector, body;
    uint64_t weight; ///< the larger one counts
} sli_svg_rule;

typedef struct sli_svg_style {
    SL_ARRAY(char *) sheets;
    SL_ARRAY(sli_svg_rule) rules; ///< sorted by their keys
    size_t same_key;              ///< the most rules of one key
    size_t unread;                ///< rules that hide or move, whose selectors are not known here
    bool paint_unread;            ///< what is filled and drawn may be said where it is not read
} sli_svg_style;

/// Reads the style elements of a document. sli_svg_style_destroy is the caller's, in any case.
sl_status sli_svg_style_read(sl_context *context, const xmlNode *root, sli_svg_style *style);
void sli_svg_style_destroy(sl_context *context, sli_svg_style *style);

typedef enum sli_svg_property {
    SLI_SVG_DISPLAY,
    SLI_SVG_VISIBILITY,
    SLI_SVG_OPACITY,
    SLI_SVG_FILL,
    SLI_SVG_STROKE,
    SLI_SVG_FILL_OPACITY,
    SLI_SVG_STROKE_OPACITY,
    SLI_SVG_STROKE_WIDTH,
    SLI_SVG_CLIP_PATH,
    SLI_SVG_TRANSFORM,
    SLI_SVG_TRANSFORM_ORIGIN,
    SLI_SVG_TRANSFORM_BOX,
    SLI_SVG_ROTATE, ///< this one and the next two move an element as a transform does
    SLI_SVG_SCALE,
    SLI_SVG_TRANSLATE,
    SLI_SVG_PROPERTIES,
} sli_svg_property;

/// What is declared about one element: values, of no length where there is none.
typedef struct sli_svg_look {
    sli_word values[SLI_SVG_PROPERTIES];
    char *held[SLI_SVG_PROPERTIES + 1]; ///< the texts that values may point into
} sli_svg_look;

/// sli_svg_look_free is the caller's.
void sli_svg_look_read(const sli_svg_style *style, const xmlNode *node, sli_svg_look *look);
void sli_svg_look_free(sli_svg_look *look);

/// Whether an element, with all that is in it, has display:none itself.
bool sli_svg_hides(const sli_svg_style *style, const xmlNode *node);

/// What elements have of those about them.
typedef struct sli_svg_paint {
    bool hidden, clear;              ///< visibility; an opacity of 0
    bool no_fill, clear_fill;        ///< fill:none; an opacity of 0
    bool stroke, clear_stroke, thin; ///< some stroke; an opacity of 0; a width of 0
    double width;                    ///< of the stroke, in the units of its place; 0: unsaid
    uint32_t fill, line;             ///< colours, as sli_svg_colour() gives them
    double opacity;                  ///< of all; then the two's own
    double fill_opacity, line_opacity;
} sli_svg_paint;

/// What is painted where nothing is said: black insides.
#define SLI_SVG_PAINT ((sli_svg_paint){.opacity = 1, .fill_opacity = 1, .line_opacity = 1})

/// That of an element within one of `outer`.
sli_svg_paint sli_svg_paint_in(sli_svg_paint outer, const sli_svg_look *look);
/// Whether a shape's inside or its line is painted. `all` asks so; else, as where styles are not
/// all known, only whether something hides it.
bool sli_svg_is_seen(sli_svg_paint paint, bool all);

#endif
