/// What the looks of a drawing's shapes tell: which layer a shape belongs to, and lines that are as
/// wide as walls.
#include "io/parts/document.h"
#include "io/parts/names.h"
#include "io/svg/svg.h"
#include "io/svg/svg_colour.h"
#include "io/svg/svg_group.h"

#include <math.h>

typedef sli_svg svg;
typedef sli_svg_place place;

// --- groups and looks

static size_t count_shapes(const xmlNode *node) {
    size_t count = 0;
    for (const xmlNode *child = node->children; child; child = child->next) {
        if (child->type != XML_ELEMENT_NODE) continue;
        count += (sli_svg_shape_of(child) != SLI_SVG_NO_SHAPE) + count_shapes(child);
    }
    return count;
}

sl_status sli_svg_group_of(svg *s, xmlNode *node, sli_svg_shape kind, uint32_t *group) {
    const uint32_t outer = *group;
    SL_TRY(sli_svg_find_group(&s->contents, node, group));
    const sli_meaning means = sli_contents_means(&s->contents, *group);
    if (*group == outer || kind != SLI_SVG_NO_SHAPE || means == SLI_MEANS_NOTHING ||
        means == SLI_MEANS_WALL)
        return SL_OK;
    const size_t inside = count_shapes(node), rest = s->all_shapes - inside;
    if ((rest <= 2 && inside >= 8) || rest <= s->all_shapes / 50) *group = outer;
    return SL_OK;
}

sl_status sli_svg_find_look(svg *s, sli_svg_shape kind, place *at) {
    // A line that is drawn has no inside, though by default it is "filled".
    if (kind == SLI_SVG_LINE && at->paint.stroke && !at->paint.clear_stroke && !at->paint.thin)
        at->paint.no_fill = true;
    const sli_affine *affine = &at->affine;
    const double scale = sqrt(fabs(affine->xx * affine->yy - affine->xy * affine->yx));
    const sli_ink ink = sli_svg_ink(&at->paint, scale);
    sli_contents *contents = &s->contents;
    if (s->style.paint_unread || at->layer) return SL_OK;
    SL_TRY(sli_looks_find(s->context, &contents->looks, &ink, &contents->look));
    if (s->options->layers)
        at->taken |=
            sli_layers_have(s->options->layers, contents->looks.items.items[contents->look].name);
    return SL_OK;
}

// --- wide lines

sl_status sli_svg_keep_stroke(svg *s, const place *at) {
    const sli_affine *affine = &at->affine;
    const double scale = sqrt(fabs(affine->xx * affine->yy - affine->xy * affine->yx));
    if (!at->paint.no_fill || !at->paint.stroke || !(at->paint.width > 0)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->strokes, 1));
    s->strokes.items[s->strokes.count++] = at->paint.width * scale;
    return SL_OK;
}

void sli_svg_note_strokes(const svg *s) {
    const sl_box box = sl_map_bounds(s->pen.map);
    const double size = fmax(box.max.x - box.min.x, box.max.y - box.min.y);
    double widest = 0;
    size_t wide = 0;
    for (size_t i = 0; i < s->strokes.count; i++) {
        if (!(s->strokes.items[i] > size / 80)) continue;
        wide++;
        widest = fmax(widest, s->strokes.items[i]);
    }
    if (wide && s->pen.map->wall_count)
        sl_note(s->context,
                "%s: %zu shape%s drawn by lines up to %g wide: walls run along their middle; for "
                "walls of that width, make outlines of the lines (in Inkscape: Stroke to Path)",
                s->pen.name, wide, wide == 1 ? " is" : "s are", widest);
}

// --- lengths

bool sli_svg_has_percent(xmlNode *node, const char *name) {
    char *text = sli_xml_attribute(node, name);
    const bool percent = text && strchr(text, '%');
    sli_xml_free(text);
    return percent;
}
