/// An SVG drawing while it is read: its shapes (svg_shapes.c) with their numbers and paths
/// (svg_path.c), through transforms (svg_transform.c), as far as they are seen (svg_style.c,
/// svg_place.c), but for hatching (svg_hatching.c) and what lies beside the page (svg_page.c).
/// svg.c goes through the elements and makes a map of them, or svg_picture.c of a picture in it.
#ifndef SL_SVG_H
#define SL_SVG_H

#include "io/parts/bad_parts.h"
#include "io/parts/contents.h"
#include "io/parts/layers.h"
#include "io/parts/shapes.h"
#include "io/svg/svg_count.h"
#include "io/svg/svg_style.h"

/// A line that may be a piece of hatching.
typedef struct sli_svg_hatch {
    sl_box clip;
    sl_point along; ///< of length 1, to the right
    size_t run;     ///< of the contents
    uint32_t group; ///< its own
} sli_svg_hatch;

typedef struct sli_svg {
    sl_context *context;
    const sl_import_options *options;
    xmlDoc *document;
    sli_svg_style style;
    sli_svg_ids ids;
    sli_pen pen;
    sli_contents contents;
    sl_drawing_layers *list; ///< asked for in place of the map; NULL
    size_t work, shapes, hidden, other;
    sli_faults faults;        ///< passed over
    const sli_fault *fault;   ///< of the last failure; NULL where it is of the whole file
    SL_ARRAY(sl_box) clips;   ///< boxes of clips that were used, in their own places
    SL_ARRAY(double) strokes; ///< widths of lines that are not filled, in the map
    SL_ARRAY(sli_svg_hatch) hatches;
    size_t all_shapes;           ///< of the file, seen or not
    double picture;              ///< the area of the largest picture, in the map
    const xmlNode *picture_node; ///< NULL for none that is seen
    char *mark;                  ///< the sum of the digits that the file's writer knew
    bool by_number;              ///< walls have the number of their shape in place of its line
} sli_svg;

/// Where an element stands, and what it has of the elements about it.
typedef struct sli_svg_place {
    sli_affine affine;
    sl_box view; ///< what shares in percent are of; without a size: not known
    sl_box clip; ///< in the map: what lies outside of it is not seen
    sli_svg_paint paint;
    bool taken; ///< on a layer that is asked for
    sli_layer layer;
    uint32_t group; ///< that it belongs to by name
    unsigned depth;
} sli_svg_place;

/// SL_BAD_INPUT: the element being drawn is faulty, and is passed over.
sl_status sli_svg_fault(sli_svg *s, const sli_fault *kind);

/// A length: a number with a unit, in user units. It stays as it is where the attribute is not
/// there. SL_BAD_INPUT, as sli_svg_fault, and with a message, where it is not known here.
sl_status sli_svg_length(sli_svg *s, xmlNode *node, const char *name, double *value);

typedef enum sli_svg_shape {
    SLI_SVG_LINE,
    SLI_SVG_POLYLINE,
    SLI_SVG_POLYGON,
    SLI_SVG_RECT,
    SLI_SVG_CIRCLE,
    SLI_SVG_ELLIPSE,
    SLI_SVG_PATH,
    SLI_SVG_NO_SHAPE,
} sli_svg_shape;

sli_svg_shape sli_svg_shape_of(const xmlNode *node);
/// Draws the outline of a shape with the pen.
sl_status sli_svg_draw(sli_svg *s, xmlNode *node, sli_svg_shape kind);

/// Adds an element's own transform to that of its place. `*seen` becomes false where it has one
/// that is not known here: then nobody knows where the element is.
sl_status sli_svg_move(sli_svg *s, xmlNode *node, const sli_svg_look *look, sli_svg_place *at,
                       bool *seen);
/// Makes the clip of a place smaller by an element's own.
sl_status sli_svg_clip(sli_svg *s, const sli_svg_look *look, sli_svg_place *at);
/// All of the plane.
sl_box sli_svg_no_clip(void);

/// Ends a shape of the contents, whose walls are those from `first` on: of its group, or of
/// hatching if it may be a piece of that. sli_svg_settle_hatching() decides, once all shapes are
/// drawn.
sl_status sli_svg_end_shape(sli_svg *s, const sl_box *clip, size_t first, uint32_t group);
void sli_svg_settle_hatching(sli_svg *s);
/// Passes over what lies beside the page, and its frame, once all shapes are drawn.
sl_status sli_svg_settle_page(sli_svg *s);

// --- svg_looks.c

/// Whether a length is a share of a window, that a map has not.
bool sli_svg_has_percent(xmlNode *node, const char *name);
/// `*group` is that of the element about this one; it becomes the one that the element belongs to
/// by its name. A group that holds all shapes, but for two or one in fifty, says nothing of them
/// unless it is one of walls: "axes_1", "Section A".
sl_status sli_svg_group_of(sli_svg *s, xmlNode *node, sli_svg_shape kind, uint32_t *group);
/// Tells how a shape looks, where styles are known. It may be asked for by that.
sl_status sli_svg_find_look(sli_svg *s, sli_svg_shape kind, sli_svg_place *at);
/// Keeps the width of a line that is drawn by its stroke alone.
sl_status sli_svg_keep_stroke(sli_svg *s, const sli_svg_place *at);
/// Walls run along the middle of lines: notes wide ones, which may be meant as walls of that width.
void sli_svg_note_strokes(const sli_svg *s);
// --- svg_picture.c

/// Keeps the largest picture: a plan may be in it.
void sli_svg_keep_picture(sli_svg *s, xmlNode *node, const sli_svg_place *at);
/// Whether the options ask for the picture: "picture", perhaps with what of it is solid behind.
bool sli_svg_picture_asked(const sli_svg *s);
/// Whether the plan is in a picture: nothing else is drawn, or a few boxes or small marks.
bool sli_svg_is_picture(const sli_svg *s);
/// Makes the map of the picture. SL_BAD_INPUT where it is not embedded as PNG.
sl_status sli_svg_read_picture(sli_svg *s);
/// Notes a picture as large as a quarter of the drawing: what it shows is not read.
void sli_svg_note_picture(const sli_svg *s);

#endif
