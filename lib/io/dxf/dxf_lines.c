/// Lines and outlines as DXF, on layers of the caller's: results to lay over a drawing.
#include "io/dxf/dxf.h"
#include "map/unit.h"

#include <string.h>

static void put_place(FILE *stream, int code, sl_point at) {
    uint64_t sum = 0; // of no use here: maps alone are told from edited ones
    fprintf(stream, "%d\n", code);
    sli_put_number(stream, at.x, &sum);
    fprintf(stream, "\n%d\n", code + 10);
    sli_put_number(stream, at.y, &sum);
    putc('\n', stream);
}

static void put_line(FILE *stream, const sl_polyline *line) {
    if (line->count == 2 && !line->closed) {
        fprintf(stream, "0\nLINE\n8\n%s\n", line->layer);
        put_place(stream, 10, line->points[0]);
        put_place(stream, 11, line->points[1]);
        return;
    }
    fprintf(stream, "0\nPOLYLINE\n8\n%s\n66\n1\n10\n0\n20\n0\n30\n0\n70\n%d\n", line->layer,
            line->closed ? 1 : 0);
    for (size_t i = 0; i < line->count; i++) {
        fprintf(stream, "0\nVERTEX\n8\n%s\n", line->layer);
        put_place(stream, 10, line->points[i]);
    }
    fprintf(stream, "0\nSEQEND\n8\n%s\n", line->layer);
}

/// Whether the layer of a line is that of one before it.
static bool has_layer(const sl_polyline *lines, size_t line) {
    for (size_t i = 0; i < line; i++)
        if (i == line - 1 || lines[i].layer != lines[i + 1].layer)
            if (strcmp(lines[i].layer, lines[line].layer) == 0) return true;
    return false;
}

static sl_status put_lines(sl_context *context, const sl_polyline *lines, size_t count,
                           const char *unit, FILE *stream) {
    int layers = 0;
    sli_dxf_put_head(stream, sli_unit_number(unit));
    for (size_t i = 0; i < count; i++)
        if ((!i || lines[i].layer != lines[i - 1].layer) && !has_layer(lines, i))
            sli_dxf_put_layer(stream, lines[i].layer, 1 + layers++ % 6);
    sli_dxf_put_middle(stream);
    for (size_t i = 0; i < count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        put_line(stream, &lines[i]);
    }
    sli_dxf_put_end(stream);
    return SL_OK;
}

sl_status sl_polylines_write_dxf(sl_context *context, const sl_polyline *lines, size_t count,
                                 const char *unit, const char *path) {
    sl_output output;
    for (size_t i = 0; i < count; i++)
        if (!sli_name_usable(lines[i].layer, strlen(lines[i].layer)) || lines[i].count < 2)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "a line of a drawing has a layer, and two points or more");
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output, put_lines(context, lines, count, unit, output.stream));
}
