/// Writing DXF: entities of release 12, which all programs read: LINE, POLYLINE, POINT. Each kind
/// of thing has a layer (layers.h). An entity has no name, so names stand in the names of layers:
/// "sightline-door-open-NAME", "sightline-path-NAME". A start is a POINT, its heading the angle of
/// the point's axis (group 50). The last entity is followed by a comment with the sum of all
/// digits, by which the reader sees that nobody has edited the numbers. y is as in the map.
#include "io/dxf/dxf.h"
#include "io/io_formats.h"
#include "io/parts/layers.h"
#include "map/unit.h"
#include "sightline/io.h"

#include <stdlib.h>

typedef struct dxf_writer {
    FILE *stream;
    const sl_map *map;
    uint64_t sum;
} dxf_writer;

// --- entities

static void put_layer(const dxf_writer *writer, const sli_layer_item *item) {
    fputs(sli_layer_name(item->layer), writer->stream);
    if (item->layer == SLI_LAYER_DOOR)
        fprintf(writer->stream, "-%s-%s", item->open ? "open" : "shut", item->name);
    else if (item->name)
        fprintf(writer->stream, "-%s", item->name);
    putc('\n', writer->stream);
}

static void put_place(dxf_writer *writer, int code, sl_point at) {
    fprintf(writer->stream, "%d\n", code);
    sli_put_number(writer->stream, at.x, &writer->sum);
    fprintf(writer->stream, "\n%d\n", code + 10);
    sli_put_number(writer->stream, at.y, &writer->sum);
    putc('\n', writer->stream);
}

static void begin_entity(const dxf_writer *writer, const char *kind, const sli_layer_item *item) {
    fprintf(writer->stream, "0\n%s\n8\n", kind);
    put_layer(writer, item);
}

static void write_entity(dxf_writer *writer, const sli_layer_item *item) {
    const sl_point *p = item->points;
    if (item->count == 1) {
        char heading[SL_NUMBER_TEXT];
        sl_number_write(item->heading + 0.0, heading);
        begin_entity(writer, "POINT", item);
        put_place(writer, 10, *p);
        fprintf(writer->stream, "50\n%s\n", heading);
        return;
    }
    if (item->count == 2) {
        begin_entity(writer, "LINE", item);
        put_place(writer, 10, p[0]);
        put_place(writer, 11, p[1]);
        return;
    }
    begin_entity(writer, "POLYLINE", item);
    fprintf(writer->stream, "66\n1\n10\n0\n20\n0\n30\n0\n70\n%d\n", item->closed ? 1 : 0);
    for (size_t i = 0; i < item->count; i++) {
        begin_entity(writer, "VERTEX", item);
        put_place(writer, 10, p[i]);
    }
    begin_entity(writer, "SEQEND", item);
}

static void begin_layer(void *user, sli_layer layer) {
    (void)user, (void)layer;
}

static void end_layer(void *user) {
    (void)user;
}

static void write_item(void *user, const sli_layer_item *item) {
    if (item->layer != SLI_LAYER_CELL) write_entity(user, item);
}

// --- the table of layers

/// A layer whose name has the name of a thing in it.
typedef struct named_layer {
    sli_layer layer;
    bool open;
    const char *name;
} named_layer;

static int compare_layers(const void *left, const void *right) {
    const named_layer *a = left, *b = right;
    if (a->layer != b->layer) return a->layer < b->layer ? -1 : 1;
    if (a->open != b->open) return a->open < b->open ? -1 : 1;
    return strcmp(a->name, b->name);
}

static void write_layer(const dxf_writer *writer, const named_layer *layer) {
    static const int colours[SLI_LAYER_COUNT] = {
        [SLI_LAYER_WALL] = 7,       [SLI_LAYER_SOLID] = 8,  [SLI_LAYER_OPEN] = 9,
        [SLI_LAYER_WALL_SOLID] = 8, [SLI_LAYER_DOOR] = 30,  [SLI_LAYER_MIRROR] = 5,
        [SLI_LAYER_MIRROR_ONE] = 5, [SLI_LAYER_ONEWAY] = 4, [SLI_LAYER_SEAM] = 9,
        [SLI_LAYER_START] = 1,      [SLI_LAYER_PATH] = 6,   [SLI_LAYER_OBJECT] = 3,
    };
    const sli_layer_item item = {.layer = layer->layer, .name = layer->name, .open = layer->open};
    fputs("0\nLAYER\n2\n", writer->stream);
    put_layer(writer, &item);
    const int colour = colours[layer->layer] ? colours[layer->layer] : 9;
    fprintf(writer->stream, "70\n0\n62\n%d\n6\nCONTINUOUS\n", colour);
}

/// Whether a layer of walls that do not stop all may hold something.
static bool has_layer(const sl_map *map, sli_layer layer) {
    for (size_t i = 0; i < map->seam_count; i++)
        if (map->seams[i].stops && map->seams[i].stops == sli_layer_stops(layer)) return true;
    return false;
}

/// All layers without names, whether something is on them or not; each of the others once.
static sl_status write_layers(sl_context *context, const dxf_writer *writer) {
    const sl_map *map = writer->map;
    const size_t most = map->door_count + map->path_count + map->object_count;
    named_layer *layers = sl_alloc_array(context, most, sizeof *layers);
    if (!layers) return SL_NO_MEMORY;
    size_t count = 0;
    for (size_t i = 0; i < map->door_count; i++)
        layers[count++] = (named_layer){SLI_LAYER_DOOR, map->doors[i].open, map->doors[i].name};
    for (size_t i = 0; i < map->path_count; i++)
        layers[count++] = (named_layer){SLI_LAYER_PATH, false, map->paths[i].name};
    for (size_t i = 0; i < map->object_count; i++)
        layers[count++] = (named_layer){SLI_LAYER_OBJECT, false, map->objects[i].name};
    for (int i = SLI_LAYER_PARTIAL; i < SLI_LAYER_COUNT; i++)
        if (has_layer(map, (sli_layer)i))
            write_layer(writer, &(named_layer){.layer = (sli_layer)i});
    if (count) qsort(layers, count, sizeof *layers, compare_layers);
    for (int i = SLI_LAYER_WALL; i < SLI_LAYER_CELL; i++)
        if (i != SLI_LAYER_DOOR && i != SLI_LAYER_PATH && i != SLI_LAYER_OBJECT)
            write_layer(writer, &(named_layer){.layer = (sli_layer)i});
    for (size_t i = 0; i < count; i++)
        if (!i || compare_layers(&layers[i - 1], &layers[i]) != 0) write_layer(writer, &layers[i]);
    sl_free(context, layers);
    return SL_OK;
}

void sli_dxf_put_head(FILE *stream, int unit) {
    fputs("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n", stream);
    if (unit) fprintf(stream, "9\n$INSUNITS\n70\n%d\n", unit);
    fputs("0\nENDSEC\n0\nSECTION\n2\nTABLES\n"
          "0\nTABLE\n2\nLTYPE\n70\n1\n0\nLTYPE\n2\nCONTINUOUS\n70\n0\n3\nSolid line\n"
          "72\n65\n73\n0\n40\n0\n0\nENDTAB\n"
          "0\nTABLE\n2\nLAYER\n70\n1\n",
          stream);
}

void sli_dxf_put_layer(FILE *stream, const char *name, int colour) {
    fprintf(stream, "0\nLAYER\n2\n%s\n70\n0\n62\n%d\n6\nCONTINUOUS\n", name, colour);
}

void sli_dxf_put_middle(FILE *stream) {
    fputs("0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n", stream);
}

void sli_dxf_put_end(FILE *stream) {
    fputs("0\nENDSEC\n0\nEOF\n", stream);
}

sl_status sli_map_print_dxf(sl_context *context, const sl_map *map, FILE *stream) {
    dxf_writer writer = {.stream = stream, .map = map};
    const sli_layer_sink sink = {&writer, begin_layer, write_item, end_layer};
    char mark[SLI_MARK_TEXT];
    sli_dxf_put_head(stream, sli_unit_number(map->unit));
    SL_TRY(write_layers(context, &writer));
    sli_dxf_put_middle(stream);
    SL_TRY(sli_layers_write(context, map, &sink));
    sli_write_mark(map, writer.sum, mark);
    fprintf(stream, "999\nsightline-digits %s\n", mark);
    sli_dxf_put_end(stream);
    return SL_OK;
}
