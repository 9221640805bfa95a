/// Writing SVG: a group for each layer (layers.h), which Inkscape takes for layers too. A shape is
/// an element on a line of its own. What a drawing has no words for stands in attributes:
///
///     data-name, data-open, data-heading   of a door, a path, an object, a start
///     data-sightline-y0                    of the root: the drawing's y that is 0 in the map
///     data-sightline-range, -snap          of the root: the map's view range, the snap of its
///     cells data-sightline-digits                of the last element: the sum of all digits, by
///     which the
///                                          reader sees that nobody has edited the numbers
#include "io/io_formats.h"
#include "io/parts/layers.h"
#include "sightline/io.h"

#include <math.h>

typedef struct svg_writer {
    FILE *stream;
    double top;
    double thin; ///< the width of a line
    uint64_t sum;
} svg_writer;

static void put(svg_writer *writer, const char *lead, double value) {
    fputs(lead, writer->stream);
    sli_put_number(writer->stream, value, &writer->sum);
}

/// A number that is no place of the map.
static void put_other(const svg_writer *writer, const char *key, double value) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value + 0.0, text);
    fprintf(writer->stream, " %s=\"%s\"", key, text);
}

static void begin_layer(void *user, sli_layer layer) {
    static const char *const styles[SLI_LAYER_COUNT] = {
        [SLI_LAYER_WALL] = "stroke=\"#000000\" fill=\"none\"",
        [SLI_LAYER_SOLID] = "stroke=\"#000000\" fill=\"#808080\" fill-opacity=\"0.5\"",
        [SLI_LAYER_OPEN] = "stroke=\"#000000\" fill=\"none\"",
        [SLI_LAYER_WALL_SOLID] = "stroke=\"#505050\" fill=\"none\"",
        [SLI_LAYER_DOOR] = "stroke=\"#b06000\" fill=\"none\"",
        [SLI_LAYER_MIRROR] = "stroke=\"#0060c0\" fill=\"none\"",
        [SLI_LAYER_MIRROR_ONE] = "stroke=\"#0060c0\" fill=\"none\"",
        [SLI_LAYER_ONEWAY] = "stroke=\"#00a0a0\" fill=\"none\"",
        [SLI_LAYER_SEAM] = "stroke=\"#a0a0a0\" fill=\"none\"",
        [SLI_LAYER_START] = "stroke=\"none\" fill=\"#c00000\"",
        [SLI_LAYER_PATH] = "stroke=\"#c000c0\" fill=\"none\"",
        [SLI_LAYER_OBJECT] = "stroke=\"#008000\" fill=\"none\"",
        [SLI_LAYER_CELL] = "stroke=\"#d0d0d0\" fill=\"none\"",
    };
    const svg_writer *writer = user;
    const char *name = sli_layer_name(layer);
    fprintf(writer->stream, "<g id=\"%s\" inkscape:groupmode=\"layer\" inkscape:label=\"%s\" %s",
            name, name, styles[layer] ? styles[layer] : "stroke=\"#606060\" fill=\"none\"");
    put_other(writer, "stroke-width", writer->thin);
    fputs(">\n", writer->stream);
}

static void end_layer(void *user) {
    const svg_writer *writer = user;
    fputs("</g>\n", writer->stream);
}

static void put_names(const svg_writer *writer, const sli_layer_item *item) {
    if (item->name) {
        fputs(" data-name=\"", writer->stream);
        sli_put_escaped(writer->stream, item->name);
        fputs("\"", writer->stream);
    }
    if (item->layer == SLI_LAYER_DOOR)
        fprintf(writer->stream, " data-open=\"%s\"", item->open ? "true" : "false");
    if (item->layer == SLI_LAYER_START) put_other(writer, "data-heading", item->heading);
    fputs("/>\n", writer->stream);
}

static void write_item(void *user, const sli_layer_item *item) {
    svg_writer *writer = user;
    const sl_point *p = item->points;
    if (item->count == 1) {
        put(writer, "<circle cx=\"", p->x);
        put(writer, "\" cy=\"", sli_turned_y(writer->top, p->y));
        fputs("\"", writer->stream);
        put_other(writer, "r", 2 * writer->thin);
    } else if (item->count == 2 && !item->closed) {
        put(writer, "<line x1=\"", p[0].x);
        put(writer, "\" y1=\"", sli_turned_y(writer->top, p[0].y));
        put(writer, "\" x2=\"", p[1].x);
        put(writer, "\" y2=\"", sli_turned_y(writer->top, p[1].y));
        fputs("\"", writer->stream);
    } else {
        fprintf(writer->stream, "<%s points=\"", item->closed ? "polygon" : "polyline");
        for (size_t i = 0; i < item->count; i++) {
            put(writer, i ? " " : "", p[i].x);
            put(writer, ",", sli_turned_y(writer->top, p[i].y));
        }
        fputs("\"", writer->stream);
    }
    put_names(writer, item);
}

/// The longer side of the picture, in pixels of a viewer. The reader takes the viewBox alone.
#define SHOWN 1000

static void write_head(const svg_writer *writer, const sl_map *map) {
    const sl_box page = sli_page_of(map);
    const double box[4] = {page.min.x, writer->top - page.max.y, page.max.x - page.min.x,
                           page.max.y - page.min.y};
    char texts[4][SL_NUMBER_TEXT];
    for (int i = 0; i < 4; i++) sl_number_write(box[i] + 0.0, texts[i]);
    fprintf(writer->stream,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\" "
            "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
            "viewBox=\"%s %s %s %s\"",
            texts[0], texts[1], texts[2], texts[3]);
    const double scale = SHOWN / fmax(box[2], box[3]);
    put_other(writer, "width", fmax(rint(box[2] * scale), 1));
    put_other(writer, "height", fmax(rint(box[3] * scale), 1));
    put_other(writer, "data-sightline-y0", writer->top);
    if (map->range > 0) put_other(writer, "data-sightline-range", map->range);
    if (map->snap > 0) put_other(writer, "data-sightline-snap", map->snap);
    fputs(">\n", writer->stream);
}

sl_status sli_map_print_svg(sl_context *context, const sl_map *map, FILE *stream) {
    const sl_box page = sli_page_of(map);
    svg_writer writer = {.stream = stream,
                         .top = sli_choose_top(map),
                         .thin = hypot(page.max.x - page.min.x, page.max.y - page.min.y) / 500};
    const sli_layer_sink sink = {&writer, begin_layer, write_item, end_layer};
    char mark[SLI_MARK_TEXT];
    SL_TRY(sli_check_xml_names(context, map));
    write_head(&writer, map);
    SL_TRY(sli_layers_write(context, map, &sink));
    sli_write_mark(map, writer.sum, mark);
    fprintf(stream, "<metadata data-sightline-digits=\"%s\"/>\n</svg>\n", mark);
    return SL_OK;
}
