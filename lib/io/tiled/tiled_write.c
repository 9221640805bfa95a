/// Writing Tiled maps, as XML (TMX): an orthogonal map of object layers, one for each kind of thing
/// (layers.h). Walls and doors are polylines, solid ground polygons, starts points. A door has its
/// name and a property "open", as any door of a Tiled map. Properties of the map say where y is 0,
/// if that is not its lower edge, the view range and the snap of its cells.
///
/// An object has a place, and points from there. The place is the first point where all points read
/// back exactly so, else 0,0.
#include "io/io_formats.h"
#include "io/parts/layers.h"
#include "sightline/io.h"

#include <math.h>

typedef struct tiled_writer {
    FILE *stream;
    double top;
    unsigned layers, objects; ///< written so far
} tiled_writer;

static void put(const tiled_writer *writer, const char *lead, double value) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value + 0.0, text);
    fprintf(writer->stream, "%s%s", lead, text);
}

static void begin_layer(void *user, sli_layer layer) {
    tiled_writer *writer = user;
    fprintf(writer->stream, " <objectgroup id=\"%u\" name=\"%s\">\n", ++writer->layers,
            sli_layer_name(layer));
}

static void end_layer(void *user) {
    const tiled_writer *writer = user;
    fputs(" </objectgroup>\n", writer->stream);
}

/// Whether the reader finds all points again from this place.
static bool can_stand_at(const tiled_writer *writer, const sli_layer_item *item, sl_point place) {
    const double y0 = writer->top - place.y;
    for (size_t i = 0; i < item->count; i++) {
        const sl_point p = item->points[i];
        const double x = p.x - place.x, y = sli_turned_y(writer->top, p.y) - place.y;
        if (x + place.x != p.x || y0 - y != p.y) return false;
    }
    return true;
}

static void write_points(const tiled_writer *writer, const sli_layer_item *item, sl_point place) {
    fprintf(writer->stream, "   <%s points=\"", item->closed ? "polygon" : "polyline");
    for (size_t i = 0; i < item->count; i++) {
        put(writer, i ? " " : "", item->points[i].x - place.x);
        put(writer, ",", sli_turned_y(writer->top, item->points[i].y) - place.y);
    }
    fputs("\"/>\n", writer->stream);
}

static void write_item(void *user, const sli_layer_item *item) {
    tiled_writer *writer = user;
    const bool is_start = item->layer == SLI_LAYER_START;
    const sl_point first = {item->points[0].x, sli_turned_y(writer->top, item->points[0].y)};
    const sl_point place = is_start || can_stand_at(writer, item, first) ? first : (sl_point){0, 0};
    fprintf(writer->stream, "  <object id=\"%u\"", ++writer->objects);
    if (item->name) {
        fputs(" name=\"", writer->stream);
        sli_put_escaped(writer->stream, item->name);
        putc('"', writer->stream);
    }
    if (is_start) fputs(" name=\"start\" type=\"start\"", writer->stream);
    if (item->layer == SLI_LAYER_DOOR) fputs(" type=\"door\"", writer->stream);
    put(writer, " x=\"", place.x);
    put(writer, "\" y=\"", place.y);
    if (is_start && item->heading != 0) put(writer, "\" rotation=\"", -item->heading);
    fputs("\">\n", writer->stream);
    if (item->layer == SLI_LAYER_DOOR)
        fprintf(writer->stream,
                "   <properties>\n"
                "    <property name=\"open\" type=\"bool\" value=\"%s\"/>\n"
                "   </properties>\n",
                item->open ? "true" : "false");
    if (is_start)
        fputs("   <point/>\n", writer->stream);
    else
        write_points(writer, item, place);
    fputs("  </object>\n", writer->stream);
}

/// A whole number of pixels, from 1 on.
static double pixels(double size) {
    return fmin(fmax(ceil(size), 1), INT32_MAX);
}

static void write_property(const tiled_writer *writer, const char *name, double value) {
    fprintf(writer->stream, "  <property name=\"%s\" type=\"float\"", name);
    put(writer, " value=\"", value);
    fputs("\"/>\n", writer->stream);
}

static void write_head(const tiled_writer *writer, const sl_map *map) {
    const sl_box page = sli_page_of(map);
    const double width = pixels(page.max.x), height = pixels(writer->top - page.min.y);
    double tile = 64;
    while (fmod(width, tile) != 0 || fmod(height, tile) != 0) tile /= 2;
    fprintf(writer->stream,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<map version=\"1.10\" orientation=\"orthogonal\" renderorder=\"right-down\" "
            "width=\"%.0f\" height=\"%.0f\" tilewidth=\"%.0f\" tileheight=\"%.0f\" "
            "infinite=\"0\">\n",
            width / tile, height / tile, tile, tile);
    if (writer->top == height && !(map->range > 0) && !(map->snap > 0)) return;
    fputs(" <properties>\n", writer->stream);
    if (map->range > 0) write_property(writer, "sightline-range", map->range);
    if (map->snap > 0) write_property(writer, "sightline-snap", map->snap);
    if (writer->top != height) write_property(writer, "sightline-y0", writer->top);
    fputs(" </properties>\n", writer->stream);
}

sl_status sli_map_print_tmx(sl_context *context, const sl_map *map, FILE *stream) {
    tiled_writer writer = {.stream = stream, .top = sli_choose_top(map)};
    const sli_layer_sink sink = {&writer, begin_layer, write_item, end_layer};
    SL_TRY(sli_check_xml_names(context, map));
    write_head(&writer, map);
    SL_TRY(sli_layers_write(context, map, &sink));
    fputs("</map>\n", stream);
    return SL_OK;
}
