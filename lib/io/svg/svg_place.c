/// Where an element is, and what of it may be seen: its own transform and clip.
///
/// A clip cuts nothing here: it hides the shapes that lie outside of it altogether, as drawing
/// programs leave them behind when a plan is cut out of a larger one. For that its box is enough.
#include "io/parts/document.h"
#include "io/svg/svg.h"
#include "io/svg/svg_transform.h"

#include <math.h>

typedef sli_svg svg;
typedef sli_svg_place place;

static const sli_fault bad_transform = {"transform that is wrong: drawn without it",
                                        "transforms that are wrong: drawn without them"};
static const sli_fault other_transform = {"transform of a kind not known here: left out",
                                          "transforms of kinds not known here: left out"};

// --- shapes by themselves

/// Draws into an empty map, in the place's own coordinates; nothing else changes.
static sl_status draw_apart(svg *s, xmlNode *node, sli_affine affine, sl_map *drawn) {
    const sli_pen pen = s->pen;
    const sli_faults faults = s->faults;
    const size_t shapes = s->shapes;
    s->pen.map = drawn;
    s->pen.affine = affine;
    const sl_status status = sli_svg_draw(s, node, sli_svg_shape_of(node));
    s->pen = pen;
    s->faults = faults;
    s->fault = NULL;
    s->shapes = shapes;
    return status;
}

// --- transforms

static bool is_word(sli_word value, const char *a, const char *b) {
    return sli_word_is(value, a) || sli_word_is(value, b);
}

/// What shares of a transform and its origin are of. `*box` NULL: not known.
static sl_status find_box(svg *s, xmlNode *node, sli_word kind, const place *at, sl_box *room,
                          const sl_box **box) {
    *box = NULL;
    if (!is_word(kind, "fill-box", "content-box")) {
        const bool known = at->view.max.x > at->view.min.x && at->view.max.y > at->view.min.y;
        if (known && !is_word(kind, "stroke-box", "border-box")) *box = &at->view;
        return SL_OK;
    }
    if (sli_svg_shape_of(node) == SLI_SVG_NO_SHAPE) return SL_OK;
    sl_map drawn = {0};
    const sl_status status = draw_apart(s, node, SLI_AFFINE_NONE, &drawn);
    *room = sl_map_bounds(&drawn);
    if (drawn.wall_count) *box = room;
    sl_map_destroy(s->context, &drawn);
    return status == SL_BAD_INPUT ? SL_OK : status;
}

/// Whether a property other than transform moves the element.
static bool moves_otherwise(const sli_svg_look *look) {
    for (int i = SLI_SVG_ROTATE; i <= SLI_SVG_TRANSLATE; i++)
        if (look->values[i].length && !is_word(look->values[i], "none", "inherit")) return true;
    return false;
}

static sli_affine moved(double x, double y) {
    return (sli_affine){.xx = 1, .x0 = x, .yy = 1, .y0 = y};
}

sl_status sli_svg_move(svg *s, xmlNode *node, const sli_svg_look *look, place *at, bool *seen) {
    const sli_word transform = look->values[SLI_SVG_TRANSFORM];
    const sli_word origin = look->values[SLI_SVG_TRANSFORM_ORIGIN];
    const sli_word kind = look->values[SLI_SVG_TRANSFORM_BOX];
    const bool otherwise = moves_otherwise(look);
    if (!transform.length && !otherwise) return SL_OK;
    sl_box room;
    const sl_box *box;
    SL_TRY(find_box(s, node, kind, at, &room, &box));
    sli_affine own;
    sl_point centre = {0, 0};
    sli_svg_result result = sli_svg_transform(transform, box, &own), placed = SLI_SVG_READ;
    if (origin.length)
        placed = sli_svg_origin(origin, box, &centre);
    else if (box == &room)
        centre = room.min;
    else if (is_word(kind, "fill-box", "content-box") || is_word(kind, "stroke-box", "border-box"))
        placed = SLI_SVG_BEYOND;
    if (result == SLI_SVG_WRONG) {
        sli_faults_add(&s->faults, &bad_transform, s->pen.line);
        if (!otherwise) return SL_OK;
    }
    if (otherwise || result == SLI_SVG_BEYOND || placed != SLI_SVG_READ) {
        sli_faults_add(&s->faults, &other_transform, s->pen.line);
        *seen = false;
        return SL_OK;
    }
    if (centre.x != 0 || centre.y != 0)
        own = sli_affine_after(moved(centre.x, centre.y),
                               sli_affine_after(own, moved(-centre.x, -centre.y)));
    at->affine = sli_affine_after(at->affine, own);
    return SL_OK;
}

// --- clips

sl_box sli_svg_no_clip(void) {
    return (sl_box){{-INFINITY, -INFINITY}, {INFINITY, INFINITY}};
}

/// The shape that a part of a clip is, itself or by a use; NULL for anything else.
static xmlNode *shape_in_clip(const svg *s, xmlNode *node) {
    char *link = sli_xml_is(node, "use") ? sli_xml_attribute(node, "href") : NULL;
    if (link) node = *link == '#' ? sli_svg_find(&s->ids, link + 1) : NULL;
    sli_xml_free(link);
    return node && sli_svg_shape_of(node) != SLI_SVG_NO_SHAPE ? node : NULL;
}

static sl_status draw_clip_part(svg *s, xmlNode *part, place at, sl_map *drawn, bool *known) {
    xmlNode *shape = shape_in_clip(s, part);
    for (xmlNode *node = part; shape; node = shape) {
        sli_svg_look look;
        sli_svg_look_read(&s->style, node, &look);
        const sl_status status = sli_svg_move(s, node, &look, &at, known);
        sli_svg_look_free(&look);
        SL_TRY(status);
        double x = 0, y = 0;
        if (node != shape) {
            SL_TRY(sli_svg_length(s, node, "x", &x));
            SL_TRY(sli_svg_length(s, node, "y", &y));
        }
        at.affine = sli_affine_after(at.affine, moved(x, y));
        if (node == shape) return draw_apart(s, shape, at.affine, drawn);
    }
    *known &= sli_xml_is(part, "title") || sli_xml_is(part, "desc");
    return SL_OK;
}

/// The box of a clip in its own places: empty where it has no shapes, all of the plane where it has
/// anything else.
static sl_status find_clip(svg *s, xmlNode *clip, sl_box *out) {
    sl_map drawn = {0};
    const sli_faults faults = s->faults;
    const sli_pen pen = s->pen;
    place at = {.affine = SLI_AFFINE_NONE};
    char *units = sli_xml_attribute(clip, "clipPathUnits");
    bool known = !units || strcmp(units, "objectBoundingBox") != 0;
    sli_xml_free(units);
    sli_svg_look look;
    sli_svg_look_read(&s->style, clip, &look);
    sl_status status = sli_svg_move(s, clip, &look, &at, &known);
    sli_svg_look_free(&look);
    for (xmlNode *part = clip->children; part && known && status == SL_OK; part = part->next)
        if (part->type == XML_ELEMENT_NODE) status = draw_clip_part(s, part, at, &drawn, &known);
    const bool empty = drawn.wall_count == 0;
    *out = empty ? (sl_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}} : sl_map_bounds(&drawn);
    if (!known || status == SL_BAD_INPUT) *out = sli_svg_no_clip();
    sl_map_destroy(s->context, &drawn);
    s->pen = pen;
    s->faults = faults;
    s->fault = NULL;
    return status == SL_BAD_INPUT ? SL_OK : status;
}

/// The element that "url(#id)" names, if it is a clip; NULL else.
static xmlNode *named_clip(const svg *s, sli_word value) {
    if (value.length < 4 || memcmp(value.at, "url(", 4) != 0) return NULL;
    const char *end = value.at + value.length, *at = value.at;
    while (at < end && *at != '#') at++;
    if (at == end) return NULL;
    const char *stop = ++at;
    while (stop < end && !strchr("\"')", *stop)) stop++;
    char *id = sl_copy_text(s->context, at, (size_t)(stop - at));
    xmlNode *node = id ? sli_svg_find(&s->ids, id) : NULL;
    sl_free(s->context, id);
    return node && sli_xml_is(node, "clipPath") ? node : NULL;
}

/// The box of a box's corners in the map; false where they are not usable.
static bool box_in_map(sl_box box, sli_affine affine, sl_box *out) {
    for (int i = 0; i < 4; i++) {
        const sl_point corner = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y};
        const sl_point at = sli_affine_apply(affine, corner);
        if (!isfinite(at.x) || !isfinite(at.y)) return false;
        out->min = i ? (sl_point){fmin(out->min.x, at.x), fmin(out->min.y, at.y)} : at;
        out->max = i ? (sl_point){fmax(out->max.x, at.x), fmax(out->max.y, at.y)} : at;
    }
    return true;
}

sl_status sli_svg_clip(svg *s, const sli_svg_look *look, place *at) {
    xmlNode *clip = named_clip(s, look->values[SLI_SVG_CLIP_PATH]);
    if (!clip) return SL_OK;
    if (!clip->_private) {
        sl_box found;
        SL_TRY(find_clip(s, clip, &found));
        SL_TRY(SL_ARRAY_ROOM(s->context, &s->clips, 1));
        s->clips.items[s->clips.count++] = found;
        clip->_private = (void *)(uintptr_t)s->clips.count;
    }
    const sl_box own = s->clips.items[(uintptr_t)clip->_private - 1];
    sl_box box = own;
    if (own.min.x <= own.max.x && !box_in_map(own, at->affine, &box)) return SL_OK;
    at->clip.min = (sl_point){fmax(at->clip.min.x, box.min.x), fmax(at->clip.min.y, box.min.y)};
    at->clip.max = (sl_point){fmin(at->clip.max.x, box.max.x), fmin(at->clip.max.y, box.max.y)};
    return SL_OK;
}
