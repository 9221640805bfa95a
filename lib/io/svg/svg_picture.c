/// Pictures in a drawing. A plan is often a picture in an SVG file, alone or with a few marks over
/// it. Then the picture is read as a PNG file would be. Where more is drawn, the drawing is read,
/// and a note says how to read the picture.
#include "geometry/length.h"
#include "io/image/image.h"
#include "io/parts/base64.h"
#include "io/parts/document.h"
#include "io/parts/names.h"
#include "io/svg/svg.h"

#include <math.h>
#include <string.h>

typedef sli_svg svg;
typedef sli_svg_place place;

/// Up to so many shapes are marks over a picture, if all are boxes, or have up to a quarter of its
/// area.
enum { MOST_MARKS = 4, LEAST_PART = 4 };

void sli_svg_keep_picture(svg *s, xmlNode *node, const place *at) {
    double width = 0, height = 0;
    sli_svg_look look;
    place own = *at;
    bool seen = true;
    if (sli_svg_has_percent(node, "width") || sli_svg_has_percent(node, "height")) {
        width = at->view.max.x, height = at->view.max.y;
    } else if (sli_svg_length(s, node, "width", &width) != SL_OK ||
               sli_svg_length(s, node, "height", &height) != SL_OK) {
        return;
    }
    sli_svg_look_read(&s->style, node, &look);
    const bool hidden = sli_word_is(look.values[SLI_SVG_DISPLAY], "none") || at->paint.hidden;
    const sl_status status = sli_svg_move(s, node, &look, &own, &seen);
    sli_svg_look_free(&look);
    if (status != SL_OK || !seen || hidden) return;
    const sli_affine *affine = &own.affine;
    const double area = width * height * fabs(affine->xx * affine->yy - affine->xy * affine->yx);
    if (!(area > s->picture)) return;
    s->picture = area;
    s->picture_node = node;
}

/// The first picture that a pattern holds or uses; NULL for none.
static const xmlNode *pattern_picture(const svg *s, const xmlNode *node, bool within) {
    for (; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE) continue;
        const bool inner = within || sli_xml_is(node, "pattern");
        if (inner && sli_xml_is(node, "image")) return node;
        if (inner && sli_xml_is(node, "use")) {
            char *link = sli_xml_attribute(node, "href");
            const xmlNode *used = link && *link == '#' ? sli_svg_find(&s->ids, link + 1) : NULL;
            sli_xml_free(link);
            if (used && sli_xml_is(used, "image")) return used;
        }
        const xmlNode *found = pattern_picture(s, node->children, inner);
        if (found) return found;
    }
    return NULL;
}

/// The picture that may be the plan: the largest that is seen, else one that a pattern holds; NULL
/// for none.
static const xmlNode *find_picture(const svg *s) {
    if (s->picture_node) return s->picture_node;
    return pattern_picture(s, xmlDocGetRootElement(s->document), false);
}

bool sli_svg_picture_asked(const svg *s) {
    const size_t length = strlen(SLI_LAYERS_PICTURE);
    const char *layers = s->options->layers;
    return layers && strncmp(layers, SLI_LAYERS_PICTURE, length) == 0 &&
           (layers[length] == '\0' || layers[length] == ',');
}

/// The area of the page and of all that is drawn.
static double area_of_drawing(const svg *s) {
    const sl_map *map = s->pen.map;
    const sl_box page = map->source.page, box = sl_map_bounds(map);
    const double paper = (page.max.x - page.min.x) * (page.max.y - page.min.y);
    const double drawn = (box.max.x - box.min.x) * (box.max.y - box.min.y);
    return map->wall_count ? fmax(paper, drawn) : paper;
}

bool sli_svg_is_picture(const svg *s) {
    const sl_map *map = s->pen.map;
    const sl_box box = sl_map_bounds(map);
    if (sli_contents_said(&s->contents) || s->contents.roles || !find_picture(s)) return false;
    if (!s->shapes) return s->picture_node;
    const bool boxes = map->wall_count <= 4 * s->shapes;
    const double drawn = (box.max.x - box.min.x) * (box.max.y - box.min.y);
    if (!s->picture_node) return boxes && s->shapes == 1;
    return s->shapes <= MOST_MARKS && 2 * s->picture >= area_of_drawing(s) &&
           (boxes || LEAST_PART * drawn <= s->picture);
}

/// The text of an embedded PNG picture, in base64. Any other one is refused, with what to do.
static sl_status find_data(const svg *s, const xmlNode *node, const char *link, const char **data) {
    static const char head[] = "data:image/png", mark[] = ";base64,";
    const char *found =
        link && strncmp(link, head, sizeof head - 1) == 0 ? strstr(link, mark) : NULL;
    const char *what = s->shapes ? "a picture, and few shapes (--layers '*' takes these)"
                                 : "a picture and no walls";
    if (!found)
        return sl_fail_at(s->context, s->pen.name, sli_xml_line(node),
                          "the drawing has %s: if the plan is in it, save it as a PNG file, and "
                          "read that",
                          what);
    *data = found + sizeof mark - 1;
    return SL_OK;
}

/// Reads a picture from its text in base64.
static sl_status read_data(svg *s, unsigned line, const char *data,
                           const sl_import_options *options) {
    const size_t room = strlen(data) / 4 + 1;
    unsigned char *bytes = sl_alloc_array(s->context, room, 3);
    size_t size, wrong;
    if (!bytes) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    if (!sli_base64_decode(data, bytes, &size, &wrong))
        status = sl_fail_at(s->context, s->pen.name, line, "the picture's base64 text is damaged");
    sl_map_destroy(s->context, s->pen.map);
    if (status == SL_OK)
        status = sli_image_read_map(s->context, s->pen.name, (char *)bytes, size, options,
                                    SLI_LAYERS_PICTURE ",", s->pen.map);
    sl_free(s->context, bytes);
    return status;
}

static void note_picture_read(const svg *s, const xmlNode *node) {
    char over[40] = "";
    if (s->shapes)
        snprintf(over, sizeof over, ", with %zu shape%s", s->shapes, s->shapes == 1 ? "" : "s");
    sl_note(s->context,
            "%s:%u: the plan is in a picture%s: it is read, and places are its pixels (--layers "
            "'*' takes what is drawn)",
            s->pen.name, (unsigned)sli_xml_line(node), over);
}

sl_status sli_svg_read_picture(svg *s) {
    const bool asked = sli_svg_picture_asked(s);
    const xmlNode *node = find_picture(s);
    sl_import_options options = *s->options;
    if (!node)
        return sl_fail(s->context, SL_BAD_ARGUMENT, "%s: --layers %s: the drawing has no picture",
                       s->pen.name, SLI_LAYERS_PICTURE);
    options.layers = asked ? s->options->layers + strlen(SLI_LAYERS_PICTURE) : NULL;
    if (options.layers) options.layers = *options.layers ? options.layers + 1 : NULL;
    char *link = sli_xml_attribute(node, "href");
    const char *data = NULL;
    sl_status status = find_data(s, node, link, &data);
    if (status == SL_OK && !asked) note_picture_read(s, node);
    if (status == SL_OK) status = read_data(s, sli_xml_line(node), data, &options);
    sli_xml_free(link);
    return status;
}

/// What to do about a picture that is not read.
static void say_next(const xmlNode *node, char *text, size_t size) {
    char *link = sli_xml_attribute(node, "href");
    if (link && strncmp(link, "data:image/png", 14) == 0)
        snprintf(text, size, "--layers " SLI_LAYERS_PICTURE " reads it");
    else if (link && strncmp(link, "data:", 5) == 0)
        snprintf(text, size, "save it as a PNG file, and read that");
    else
        snprintf(text, size, "read its own file, as PNG");
    sli_xml_free(link);
}

void sli_svg_note_picture(const svg *s) {
    const sl_box box = s->pen.map->wall_count ? sl_map_bounds(s->pen.map) : s->pen.map->source.page;
    const double area = (box.max.x - box.min.x) * (box.max.y - box.min.y);
    const xmlNode *node = find_picture(s);
    char next[64];
    if (!node) return;
    say_next(node, next, sizeof next);
    if (!s->picture_node)
        sl_note(s->context,
                "%s:%u: a picture fills shapes as a pattern, and is not read: if the plan is in "
                "it: %s",
                s->pen.name, (unsigned)sli_xml_line(node), next);
    else if (s->picture * 4 >= area)
        sl_note(s->context,
                "%s:%u: a picture is as large as %.0f %% of the drawing, and is not read: if the "
                "plan is in it: %s",
                s->pen.name, (unsigned)sli_xml_line(node), area > 0 ? 100 * s->picture / area : 100,
                next);
}
