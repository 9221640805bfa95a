/// SVG (W3C, SVG 1.1): the outline of every line, polyline, polygon, rect, circle, ellipse and path
/// is walls, through the transforms of its groups. Shapes that are not seen and those of other
/// layers are left out; what is faulty is passed over and counted. A use draws another element once
/// more, so depth and work are bounded. Groups whose names begin with "sightline-" hold doors,
/// solid ground and so on (layers.h).
#include "io/svg/svg.h"
#include "base/base.h"
#include "geometry/length.h"
#include "io/io_formats.h"
#include "io/parts/contents.h"
#include "io/parts/document.h"
#include "io/parts/names.h"
#include "io/parts/plan_unit.h"
#include "io/svg/svg_group.h"
#include "io/svg/svg_path.h"
#include "map/scan.h"
#include "map/source.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <math.h>

typedef sli_svg svg;
typedef sli_svg_place place;

static sl_status draw_or_pass(svg *s, xmlNode *node, place at);

// --- attributes

static bool attribute_is(xmlNode *node, const char *name, const char *value) {
    char *text = sli_xml_attribute(node, name);
    const bool same = text && strcmp(text, value) == 0;
    sli_xml_free(text);
    return same;
}

static bool names_layer(const char *list, const char *name) {
    return name && sli_layers_have(list, name);
}

/// Whether the element's layer, label or id is among the layers asked for.
static bool is_layer(const svg *s, xmlNode *node) {
    bool is = false;
    for (size_t i = 0; i < 4 && !is; i++) {
        char *name = sli_xml_attribute(node, sli_svg_layer_names[i]);
        is = names_layer(s->options->layers, name);
        sli_xml_free(name);
    }
    return is;
}

// --- layers that are asked for and not there

/// Looks for an element of a name, and lists the names of all groups, the label before the id, and
/// the layers of shapes.
static bool has_layer(xmlNode *parent, sli_word wanted, sli_name_list *there) {
    bool found = false;
    for (xmlNode *node = parent->children; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE) continue;
        bool shown = false;
        for (size_t i = 0; i < 4; i++) {
            char *name = sli_xml_attribute(node, sli_svg_layer_names[i]);
            found |= name && sli_word_is(wanted, name);
            if (name && !shown && (i < 2 || sli_xml_is(node, "g"))) {
                sli_name_list_add(there, (sli_word){name, strlen(name)});
                shown = true;
            }
            sli_xml_free(name);
        }
        found |= has_layer(node, wanted, there);
    }
    return found;
}

/// The layers that options name, as walls or with their roles.
static const char *asked_layers(const svg *s) {
    return s->contents.roles ? s->contents.roles : s->options->layers;
}

/// The picture is asked for by this name, where no layer has it.
static const sli_word picture_name = {SLI_LAYERS_PICTURE, sizeof SLI_LAYERS_PICTURE - 1};

static sl_status check_layers(const svg *s, xmlNode *root) {
    const char *list = asked_layers(s);
    sli_meaning means;
    for (sli_word wanted; list && sli_roles_next(&list, &wanted, &means);) {
        sli_name_list there = {.full = false};
        if (!has_layer(root, wanted, &there) && !sli_look_may_be(wanted))
            return sli_fail_layer(s->context, s->pen.name, wanted, "drawing", &there);
    }
    return SL_OK;
}

/// Layers that may be looks are looked for once all is drawn.
static sl_status check_looks(const svg *s, xmlNode *root) {
    const char *list = asked_layers(s);
    sli_meaning means;
    for (sli_word wanted; list && sli_roles_next(&list, &wanted, &means);) {
        sli_name_list there = {.full = false};
        bool found = has_layer(root, wanted, &there);
        for (size_t i = 0; i < s->contents.looks.items.count; i++) {
            const char *name = s->contents.looks.items.items[i].name;
            found |= sli_word_is(wanted, name);
            sli_name_list_add(&there, (sli_word){name, strlen(name)});
        }
        if (!found) return sli_fail_layer(s->context, s->pen.name, wanted, "drawing", &there);
    }
    return SL_OK;
}

// --- shapes of layers that say what they hold

/// The layer of a group, by its id or its label.
static sli_layer layer_of_group(xmlNode *node) {
    char *id = sli_xml_attribute(node, "id"), *label = sli_xml_attribute(node, "label");
    sli_layer layer = label ? sli_layer_of((sli_word){label, strlen(label)}, NULL) : SLI_LAYER_NONE;
    if (!layer && id) layer = sli_layer_of((sli_word){id, strlen(id)}, NULL);
    sli_xml_free(id);
    sli_xml_free(label);
    return layer;
}

/// An attribute that is a number, if it is there.
static sl_status read_own_number(svg *s, xmlNode *node, const char *name, bool *found,
                                 double *value) {
    char *data = sli_xml_attribute(node, name);
    if (!data) return SL_OK;
    sli_svg_text text = sli_svg_text_of(data, name);
    sl_status status = sli_svg_number(&s->pen, &text, value);
    if (status == SL_OK && text.at < text.end) status = sli_svg_fail(&s->pen, &text, "the end");
    *found = status == SL_OK;
    sli_xml_free(data);
    return status;
}

/// A start is the middle of a circle.
static sl_status read_start(svg *s, xmlNode *node, sl_point *at, double *heading) {
    bool found;
    SL_TRY(sli_svg_length(s, node, "cx", &at->x));
    SL_TRY(sli_svg_length(s, node, "cy", &at->y));
    SL_TRY(read_own_number(s, node, "data-heading", &found, heading));
    const sli_affine down = {.xx = 1, .yy = -1};
    *heading = sli_heading_through(sli_affine_after(s->pen.affine, down), *heading);
    *at = sli_affine_apply(s->pen.affine, *at);
    return SL_OK;
}

/// Draws a shape into a map of its own; the lines become what the layer says.
static sl_status draw_in_layer(svg *s, xmlNode *node, sli_svg_shape kind, sli_layer layer) {
    sl_map drawn = {0}, *map = s->pen.map;
    sl_point start = {0, 0};
    sli_layer_item item = {.layer = layer, .points = &start};
    const size_t walls = s->pen.walls;
    const bool is_start =
        layer == SLI_LAYER_START && (kind == SLI_SVG_CIRCLE || kind == SLI_SVG_ELLIPSE);
    sl_status status = SL_OK;
    s->pen.map = &drawn;
    if (is_start) status = read_start(s, node, &start, &item.heading);
    if (layer != SLI_LAYER_START) status = sli_svg_draw(s, node, kind);
    s->pen.map = map;
    if (layer != SLI_LAYER_WALL) s->pen.walls = walls;
    char *name = sli_xml_attribute(node, "data-name");
    item.name = name;
    item.open = !attribute_is(node, "data-open", "false");
    item.count = is_start;
    s->other += layer == SLI_LAYER_START && !is_start;
    if (status == SL_OK)
        status = sli_layer_take(s->context, s->pen.name, map, &item, &drawn,
                                s->pen.item ? s->pen.item : s->pen.line);
    sli_xml_free(name);
    sl_map_destroy(s->context, &drawn);
    return status;
}

// --- groups

static const sli_fault bad_box = {"drawing within the drawing whose viewBox is wrong",
                                  "drawings within the drawing whose viewBoxes are wrong"};
static const sli_fault outside = {"use of another file", "uses of other files"};
static const sli_fault not_there = {"use of an element that is not there",
                                    "uses of elements that are not there"};
static const sli_fault too_far = {"shape with a coordinate out of range",
                                  "shapes with coordinates out of range"};

static sl_status draw_children(svg *s, xmlNode *node, place at) {
    for (xmlNode *child = node->children; child; child = child->next)
        if (child->type == XML_ELEMENT_NODE) SL_TRY(draw_or_pass(s, child, at));
    return SL_OK;
}

/// The box of a drawing, as its attribute viewBox or its size has it; no box where `box[2]` is 0.
static sl_status read_view_box(svg *s, xmlNode *node, double box[4]) {
    memset(box, 0, 4 * sizeof *box);
    char *data = sli_xml_attribute(node, "viewBox");
    if (!data) return SL_OK;
    sli_svg_text text = sli_svg_text_of(data, "viewBox");
    sl_status status = SL_OK;
    for (int i = 0; i < 4 && status == SL_OK; i++) status = sli_svg_number(&s->pen, &text, &box[i]);
    if (status == SL_OK && !(box[2] > 0 && box[3] > 0))
        status = sl_fail_at(s->context, s->pen.name, s->pen.line,
                            "viewBox: its width and height must be positive");
    if (status != SL_OK) s->fault = &bad_box; // of a drawing within the drawing
    sli_xml_free(data);
    return status;
}

/// Fits a box into a place, in the middle and not stretched, unless the element says that it is.
static void fit_box(const double box[4], xmlNode *node, sl_box into, place *at) {
    const double width = into.max.x - into.min.x, height = into.max.y - into.min.y;
    char *ratio = sli_xml_attribute(node, "preserveAspectRatio");
    const bool stretched = ratio && strncmp(ratio, "none", 4) == 0;
    const bool boxed = box[2] > 0;
    sli_xml_free(ratio);
    const double fit = boxed ? fmin(width / box[2], height / box[3]) : 1;
    const double xx = boxed && stretched ? width / box[2] : fit;
    const double yy = boxed && stretched ? height / box[3] : fit;
    sli_affine inner = {
        .xx = xx, .x0 = into.min.x - xx * box[0], .yy = yy, .y0 = into.min.y - yy * box[1]};
    if (boxed) {
        inner.x0 += (width - xx * box[2]) / 2;
        inner.y0 += (height - yy * box[3]) / 2;
    }
    at->affine = sli_affine_after(at->affine, inner);
    at->view = (sl_box){{0, 0}, boxed ? (sl_point){box[2], box[3]} : (sl_point){width, height}};
}

/// A length of an element that stays as it is where the element has none, or a share.
static sl_status read_side(svg *s, xmlNode *node, const char *name, double *value) {
    return sli_svg_has_percent(node, name) ? SL_OK : sli_svg_length(s, node, name, value);
}

/// A drawing within the drawing.
static sl_status enter_drawing(svg *s, xmlNode *node, place *at) {
    double x = 0, y = 0, box[4];
    SL_TRY(read_view_box(s, node, box));
    double width = box[2], height = box[3];
    SL_TRY(sli_svg_length(s, node, "x", &x));
    SL_TRY(sli_svg_length(s, node, "y", &y));
    SL_TRY(read_side(s, node, "width", &width));
    SL_TRY(read_side(s, node, "height", &height));
    fit_box(box, node, (sl_box){{x, y}, {x + width, y + height}}, at);
    return SL_OK;
}

/// A symbol is as large as its use says, or else as it says itself, or else as all of the drawing.
static sl_status enter_symbol(svg *s, xmlNode *use, xmlNode *symbol, place *at) {
    double box[4];
    SL_TRY(sli_svg_find_group(&s->contents, symbol, &at->group));
    SL_TRY(read_view_box(s, symbol, box));
    if (!(box[2] > 0)) return SL_OK;
    double width = at->view.max.x > 0 ? at->view.max.x : box[2];
    double height = at->view.max.y > 0 ? at->view.max.y : box[3];
    SL_TRY(read_side(s, symbol, "width", &width));
    SL_TRY(read_side(s, symbol, "height", &height));
    SL_TRY(read_side(s, use, "width", &width));
    SL_TRY(read_side(s, use, "height", &height));
    fit_box(box, symbol, (sl_box){{0, 0}, {width, height}}, at);
    return SL_OK;
}

static sl_status draw_use(svg *s, xmlNode *node, place at) {
    double x = 0, y = 0;
    SL_TRY(sli_svg_length(s, node, "x", &x));
    SL_TRY(sli_svg_length(s, node, "y", &y));
    char *link = sli_xml_attribute(node, "href");
    const bool here = link && *link == '#';
    xmlNode *used = here ? sli_svg_find(&s->ids, link + 1) : NULL;
    const sli_fault *fault = link && !here ? &outside : &not_there;
    sli_xml_free(link);
    if (!used) return sli_svg_fault(s, fault);
    at.affine = sli_affine_after(at.affine, (sli_affine){.xx = 1, .x0 = x, .yy = 1, .y0 = y});
    at.depth++;
    if (!sli_xml_is(used, "symbol")) return draw_or_pass(s, used, at);
    SL_TRY(enter_symbol(s, node, used, &at));
    return draw_children(s, used, at);
}

static sl_status draw_group(svg *s, xmlNode *node, place at) {
    if (sli_xml_is(node, "use")) return draw_use(s, node, at);
    at.depth++;
    if (sli_xml_is(node, "svg")) SL_TRY(enter_drawing(s, node, &at));
    return draw_children(s, node, at);
}

static bool is_group(xmlNode *node) {
    return sli_xml_is(node, "g") || sli_xml_is(node, "a") || sli_xml_is(node, "svg") ||
           sli_xml_is(node, "switch") || sli_xml_is(node, "use");
}

/// Keeps a text for names of rooms. Its place is its own, or that of the first part that has one.
static sl_status keep_text(svg *s, xmlNode *node, place at) {
    sl_point from = {0, 0};
    sli_svg_look look;
    bool seen = true;
    sli_svg_look_read(&s->style, node, &look);
    seen = !sli_word_is(look.values[SLI_SVG_DISPLAY], "none");
    sl_status status = sli_svg_move(s, node, &look, &at, &seen);
    sli_svg_look_free(&look);
    xmlNode *placed = node;
    for (xmlNode *part = node->children; part && !xmlHasProp(placed, BAD_CAST "x");
         part = part->next)
        if (sli_xml_is(part, "tspan")) placed = part;
    if (status == SL_OK) status = sli_svg_length(s, placed, "x", &from.x);
    if (status == SL_OK) status = sli_svg_length(s, placed, "y", &from.y);
    if (status != SL_OK || !seen) return status;
    xmlChar *text = xmlNodeGetContent(placed);
    if (!text) return SL_NO_MEMORY;
    status = sli_source_add_text(s->context, &s->pen.map->source, (char *)text,
                                 strlen((char *)text), sli_affine_apply(at.affine, from), 0);
    xmlFree(text);
    return status;
}

/// Text, pictures and what is drawn only where it is used give no walls; the former are counted.
static void pass_over(svg *s, xmlNode *node, const place *at) {
    if (sli_xml_is(node, "image")) sli_svg_keep_picture(s, node, at);
    s->other +=
        sli_xml_is(node, "text") || sli_xml_is(node, "image") || sli_xml_is(node, "foreignObject");
}

/// Takes away the walls from `first` on if all of them lie outside of the clip.
static void hide_outside(svg *s, const sl_box *clip, size_t first) {
    sl_map *map = s->pen.map;
    const bool empty = clip->min.x > clip->max.x || clip->min.y > clip->max.y;
    for (size_t i = first; i < map->wall_count && !empty; i++) {
        const sl_point a = map->walls[i].a, b = map->walls[i].b;
        if (fmax(a.x, b.x) >= clip->min.x && fmin(a.x, b.x) <= clip->max.x &&
            fmax(a.y, b.y) >= clip->min.y && fmin(a.y, b.y) <= clip->max.y)
            return;
    }
    if (first == map->wall_count) return;
    s->pen.walls -= map->wall_count - first;
    map->wall_count = first;
    s->shapes--;
    s->hidden++;
}

/// Draws a shape, as far as it is seen, and tells whose it is.
static sl_status draw_in_group(svg *s, xmlNode *node, sli_svg_shape kind, const place *at) {
    const size_t first = s->pen.map->wall_count;
    const bool asks = sli_contents_asks(&s->contents);
    if (asks) sli_contents_begin(&s->contents, &s->pen);
    const sl_status status = sli_svg_draw(s, node, kind);
    hide_outside(s, &at->clip, first);
    // The bad tail of a path is passed over; what is drawn belongs to the group.
    if (asks) SL_TRY(sli_svg_end_shape(s, &at->clip, first, at->group));
    return status;
}

static sl_status draw_placed(svg *s, xmlNode *node, sli_svg_shape kind, place at) {
    at.taken |= s->options->layers && is_layer(s, node);
    if (sli_contents_asks(&s->contents)) SL_TRY(sli_svg_group_of(s, node, kind, &at.group));
    if (kind == SLI_SVG_NO_SHAPE) {
        const sli_layer own = layer_of_group(node);
        if (own) at.layer = own;
        return draw_group(s, node, at);
    }
    SL_TRY(sli_svg_find_look(s, kind, &at));
    if (!at.taken) return SL_OK;
    // Layers of our own say what they hold, however it is painted.
    if (at.layer ? at.paint.hidden : !sli_svg_is_seen(at.paint, !s->style.paint_unread)) {
        s->hidden++;
        return SL_OK;
    }
    if (!at.layer) SL_TRY(sli_svg_keep_stroke(s, &at));
    s->pen.affine = at.affine;
    s->pen.item = s->by_number ? (uint32_t)(uintptr_t)node->_private : 0;
    if (at.layer) return draw_in_layer(s, node, kind, at.layer);
    return draw_in_group(s, node, kind, &at);
}

static sl_status draw_element(svg *s, xmlNode *node, place at) {
    s->pen.line = sli_xml_line(node);
    s->work++;
    if (s->work % 1024 == 0) SL_TRY(sl_check_cancelled(s->context));
    const sli_svg_shape kind = sli_svg_shape_of(node);
    if (kind == SLI_SVG_NO_SHAPE && !is_group(node)) {
        pass_over(s, node, &at);
        return sli_xml_is(node, "text") ? keep_text(s, node, at) : SL_OK;
    }
    sli_svg_look look;
    sli_svg_look_read(&s->style, node, &look);
    bool seen = !sli_word_is(look.values[SLI_SVG_DISPLAY], "none");
    sl_status status = SL_OK;
    s->hidden += !seen;
    at.paint = sli_svg_paint_in(at.paint, &look);
    if (seen) status = sli_svg_move(s, node, &look, &at, &seen);
    if (seen && status == SL_OK) status = sli_svg_clip(s, &look, &at);
    sli_svg_look_free(&look);
    return seen && status == SL_OK ? draw_placed(s, node, kind, at) : status;
}

/// Draws an element, as far as it is not faulty.
static sl_status draw_or_pass(svg *s, xmlNode *node, place at) {
    s->fault = NULL;
    s->pen.too_far = false;
    const size_t shapes = s->shapes;
    const sl_status status = draw_element(s, node, at);
    const sli_fault *fault = s->pen.too_far ? &too_far : s->fault;
    if (status != SL_BAD_INPUT || !fault) return status;
    sli_faults_add(&s->faults, fault, sli_xml_line(node));
    s->shapes = shapes;
    s->fault = NULL;
    s->pen.too_far = false;
    return SL_OK;
}

// --- names for walls

/// The name of a layer about an element: the nearest group's label, else its id.
static char *layer_of(const xmlNode *node) {
    for (node = node->parent; node && node->type == XML_ELEMENT_NODE; node = node->parent) {
        if (!sli_xml_is(node, "g")) continue;
        char *label = sli_xml_attribute(node, "label");
        if (!label) label = sli_xml_attribute(node, "id");
        if (label) return label;
    }
    return NULL;
}

/// "rect, id rect5, layer walls"
static sl_status name_shape(svg *s, const xmlNode *node, uint32_t number) {
    char *id = sli_xml_attribute(node, "id"), *layer = layer_of(node);
    char label[SL_LINE_TEXT] = "";
    size_t used = 0;
    if (s->by_number && sli_xml_line(node))
        used = (size_t)snprintf(label, sizeof label, "line %u, ", (unsigned)sli_xml_line(node));
    snprintf(label + used, sizeof label - used, "%s%s%s%s%s", (const char *)node->name,
             id ? ", id " : "", id ? sli_show((sli_word){id, strlen(id)}).text : "",
             layer ? ", layer " : "", layer ? sli_show((sli_word){layer, strlen(layer)}).text : "");
    sli_xml_free(id);
    sli_xml_free(layer);
    return sli_map_add_label(s->context, s->pen.map, s->by_number ? number : sli_xml_line(node),
                             label);
}

/// Numbers the shapes from 1, in the order of the file. Tells whether each has a line of its own.
static void number_shapes(xmlNode *node, uint32_t *count, uint32_t *line, bool *own_lines) {
    for (; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE) continue;
        if (sli_svg_shape_of(node) != SLI_SVG_NO_SHAPE) {
            *own_lines &= sli_xml_line(node) > *line;
            *line = sli_xml_line(node);
            node->_private = (void *)(uintptr_t)++ * count;
        }
        number_shapes(node->children, count, line, own_lines);
    }
}

static sl_status name_shapes(svg *s, const xmlNode *node) {
    for (; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE) continue;
        if (node->_private) SL_TRY(name_shape(s, node, (uint32_t)(uintptr_t)node->_private));
        SL_TRY(name_shapes(s, node->children));
    }
    return SL_OK;
}

/// Walls have the line of their shape. Where several shapes stand on one line, walls have the
/// number of their shape.
static sl_status name_walls(svg *s, xmlNode *root) {
    uint32_t count = 0, line = 0;
    bool own_lines = true;
    number_shapes(root, &count, &line, &own_lines);
    s->all_shapes = count;
    s->by_number = s->pen.map->source.lines_are_items = !own_lines;
    return name_shapes(s, root);
}

// --- the whole

/// What a file of our own says of the whole map: the range, the snap, the sum of its digits.
static sl_status read_marks(svg *s, xmlNode *root) {
    sl_map *map = s->pen.map;
    bool range = false, snap = false;
    SL_TRY(read_own_number(s, root, "data-sightline-range", &range, &map->range));
    SL_TRY(read_own_number(s, root, "data-sightline-snap", &snap, &map->snap));
    if ((range && !(map->range > 0)) || (snap && !(map->snap > 0)))
        return sl_fail_at(s->context, s->pen.name, s->pen.line,
                          "data-sightline-%s: expected a number greater than 0",
                          range && !(map->range > 0) ? "range" : "snap");
    for (xmlNode *child = root->children; child && !s->mark; child = child->next)
        if (sli_xml_is(child, "metadata"))
            s->mark = sli_xml_attribute(child, "data-sightline-digits");
    return SL_OK;
}

/// A user unit is a pixel, unless the width is written in another unit and the box is as wide:
/// width="210mm" viewBox="0 0 210 297".
static void find_unit(svg *s, xmlNode *root, double box_width) {
    static const char *const units[] = {"px", "in", "cm", "mm", "pt", "pc"};
    char *text = sli_xml_attribute(root, "width"), *unit = s->pen.map->unit;
    const size_t length = text ? sli_number_length(text, strlen(text)) : 0;
    double width = 0;
    if (box_width == 0) strcpy(unit, units[0]);
    if (box_width != 0 && length && sl_number_read(text, length, &width) && width == box_width) {
        const sli_word rest = {text + length, strcspn(text + length, " \t\r\n")};
        if (!rest.length) strcpy(unit, units[0]);
        for (size_t i = 0; i < sizeof units / sizeof *units; i++)
            if (sli_word_is(rest, units[i])) strcpy(unit, units[i]);
    }
    sli_xml_free(text);
}

/// The map's unit is the drawing's own, y turned up: the lower edge of its box, where it has one,
/// is at y 0, unless the drawing says where y is 0.
static sl_status draw_root(svg *s, xmlNode *root) {
    double box[4], height = 0;
    bool told = false;
    s->pen.line = sli_xml_line(root);
    const bool picture =
        sli_svg_picture_asked(s) && !has_layer(root, picture_name, &(sli_name_list){.full = false});
    if (!picture) SL_TRY(check_layers(s, root));
    SL_TRY(read_view_box(s, root, box));
    if (box[2] > 0)
        height = box[1] + box[3];
    else if (!sli_svg_has_percent(root, "height") &&
             sli_svg_length(s, root, "height", &height) != SL_OK)
        sli_faults_add(&s->faults, s->fault, s->pen.line);
    SL_TRY(read_own_number(s, root, "data-sightline-y0", &told, &height));
    SL_TRY(read_marks(s, root));
    if (box[2] > 0)
        s->pen.map->source.page =
            (sl_box){{box[0], height - (box[1] + box[3])}, {box[0] + box[2], height - box[1]}};
    s->pen.map->source.transform = sli_y_down(height, 1);
    s->pen.map->source.pixels = 1;
    SL_TRY(name_walls(s, root));
    SL_TRY(sli_svg_style_read(s->context, root, &s->style));
    find_unit(s, root, box[2]);
    SL_TRY(sli_svg_ids_read(s->context, root, &s->ids));
    SL_TRY(sli_svg_check_amount(s->context, s->pen.name, s->options, root, &s->style, &s->ids));
    place at = {.affine = {.xx = 1, .yy = -1, .y0 = height},
                .view = {{0, 0}, {box[2], box[3]}},
                .clip = sli_svg_no_clip(),
                .taken = !s->options->layers};
    sli_svg_look look;
    sli_svg_look_read(&s->style, root, &look);
    at.paint = sli_svg_paint_in(SLI_SVG_PAINT, &look);
    sli_svg_look_free(&look);
    s->contents.has_looks = !s->style.paint_unread;
    SL_TRY(draw_children(s, root, at));
    sli_svg_settle_hatching(s);
    SL_TRY(sli_svg_settle_page(s));
    if (s->list) return sli_contents_list(&s->contents, s->pen.map, 0, s->list);
    if (picture || sli_svg_is_picture(s)) return sli_svg_read_picture(s);
    if (s->options->threshold > 0)
        return sl_fail(s->context, SL_BAD_ARGUMENT,
                       "--threshold: %s is read as an SVG drawing, which has no use for it; "
                       "--layers " SLI_LAYERS_PICTURE " reads the picture in a drawing",
                       s->pen.name);
    SL_TRY(check_looks(s, root));
    SL_TRY(sli_contents_choose(&s->contents, 0, &s->pen));
    s->shapes -= s->contents.left_out;
    s->pen.map->precision = sli_marked_precision(s->pen.map, s->pen.finest, s->mark, s->pen.sum);
    const sli_tally left[] = {
        {s->hidden, "shape or group that is not seen", "shapes or groups that are not seen"},
        {s->other, "text or picture", "texts and pictures"},
        {s->pen.points, "line of no length", "lines of no length"},
        {s->style.unread, "rule of a style sheet", "rules of style sheets"}};
    char without[SLI_TALLY_TEXT];
    sl_note(s->context, "%s: %zu shape%s %zu wall%s%s", s->pen.name, s->shapes,
            s->shapes == 1 ? " gives" : "s give", s->pen.walls, s->pen.walls == 1 ? "" : "s",
            sli_tally_write("; left out: ", left, 4, without));
    sli_faults_note(s->context, s->pen.name, &s->faults);
    sli_layers_note(s->context, s->pen.name, s->pen.map);
    sli_plan_unit_of_page(s->context, s->pen.name, s->pen.map, s->options->sized);
    sli_svg_note_strokes(s);
    sli_svg_note_picture(s);
    return SL_OK;
}

static sl_status draw_document(svg *s, const char *text, size_t size) {
    SL_TRY(sli_xml_read(s->context, s->pen.name, text, size, &s->document));
    xmlNode *root = xmlDocGetRootElement(s->document);
    if (sli_xml_is(root, "svg")) return draw_root(s, root);
    const sli_word found = {(const char *)root->name, strlen((const char *)root->name)};
    return sl_fail_at(s->context, s->pen.name, sli_xml_line(root),
                      "expected an svg element, found '%s'", sli_show(found).text);
}

/// Reads a drawing, or its layers alone.
static sl_status read_drawing(sl_context *context, const char *name, const char *text, size_t size,
                              const sl_import_options *options, sl_map *map,
                              sl_drawing_layers *list) {
    bool large;
    const sl_import_options own = sli_drawing_options(options, &large);
    sli_svg s = {.context = context,
                 .options = &own,
                 .contents = {.context = context,
                              .file = name,
                              .options = &own,
                              .large = large,
                              .roles = sli_drawing_roles(options)},
                 .list = list,
                 .pen = {.context = context, .name = name, .map = map, .tolerance = own.tolerance}};
    const sl_status status = draw_document(&s, text, size);
    sli_svg_style_destroy(context, &s.style);
    sli_svg_ids_destroy(context, &s.ids);
    sl_free(context, s.clips.items);
    sl_free(context, s.strokes.items);
    sl_free(context, s.hatches.items);
    sli_contents_destroy(&s.contents);
    sli_xml_free(s.mark);
    xmlFreeDoc(s.document);
    return status;
}

sl_status sli_map_read_svg(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    sl_map read = {0};
    const sl_status status = read_drawing(context, name, text, size, options, &read, NULL);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

sl_status sl_drawing_layers_svg(sl_context *context, const char *name, const char *text,
                                size_t size, sl_drawing_layers *out) {
    const sl_import_options options = sl_import_options_default();
    sl_drawing_layers read = {0};
    sl_map map = {0};
    const sl_status status = read_drawing(context, name, text, size, &options, &map, &read);
    sl_map_destroy(context, &map);
    if (status == SL_OK)
        *out = read;
    else
        sl_drawing_layers_destroy(context, &read);
    return status;
}
