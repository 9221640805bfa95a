/// Exports of a baked file that need no other library: JSON, CSV and C source. Each is printed
/// piece by piece, so that a large map needs no tree in memory.
#include "base/base.h"
#include "sightline/bake.h"
#include "sightline/json_write.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <string.h>

// --- JSON: one object

typedef struct printer {
    sl_context *context;
    FILE *stream;
    sl_json_writer json;
} printer;

/// What stands before item i; false where there is none, or the stream takes no more.
static bool begin_item(const printer *out, uint32_t i, uint32_t count) {
    if (i >= count || ferror(out->stream)) return false;
    fputs(i ? ",\n" : "\n", out->stream);
    return true;
}

static void print_point(printer *out, sl_point p) {
    sl_json_put_list(&out->json);
    sl_json_put_real(&out->json, p.x);
    sl_json_put_real(&out->json, p.y);
    sl_json_put_end(&out->json, ']');
}

static void print_segment(printer *out, sl_point a, sl_point b) {
    sl_json_put_list(&out->json);
    sl_json_put_real(&out->json, a.x);
    sl_json_put_real(&out->json, a.y);
    sl_json_put_real(&out->json, b.x);
    sl_json_put_real(&out->json, b.y);
    sl_json_put_end(&out->json, ']');
}

static void print_cell(printer *out, const sl_space *space, uint32_t number) {
    const sl_cell *cell = &space->cells[number];
    sl_json_put_object(&out->json);
    sl_json_put_key(&out->json, "id");
    sl_json_put_integer(&out->json, number);
    sl_json_put_key(&out->json, "polygon");
    sl_json_put_list(&out->json);
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        print_point(out, space->vertices[cell->first_vertex + i]);
    sl_json_put_end(&out->json, ']');
    sl_json_put_key(&out->json, "inside");
    sl_json_put_flag(&out->json, cell->inside);
    if (cell->solid) {
        sl_json_put_key(&out->json, "solid");
        sl_json_put_flag(&out->json, true);
    }
    sl_json_put_end(&out->json, '}');
}

/// Solid ground, as the polygons of its cells.
static void print_solids(printer *out, const sl_space *space) {
    bool any = false;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *cell = &space->cells[i];
        if (!cell->solid) continue;
        fputs(any ? ",\n" : ",\n\"solids\": [\n", out->stream);
        any = true;
        sl_json_put_list(&out->json);
        for (uint32_t k = 0; k < cell->vertex_count; k++)
            print_point(out, space->vertices[cell->first_vertex + k]);
        sl_json_put_end(&out->json, ']');
    }
    if (any) fputs("]", out->stream);
}

static void print_portal(printer *out, const sl_portal *portal) {
    sl_json_put_object(&out->json);
    sl_json_put_key(&out->json, "cells");
    sl_json_put_list(&out->json);
    sl_json_put_integer(&out->json, portal->cell[0]);
    sl_json_put_integer(&out->json, portal->cell[1]);
    sl_json_put_end(&out->json, ']');
    sl_json_put_key(&out->json, "segment");
    print_segment(out, portal->left, portal->right);
    sl_json_put_end(&out->json, '}');
}

static void print_row(printer *out, const sl_pvs *pvs, uint32_t cell) {
    sl_json_put_list(&out->json);
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++) sl_json_put_integer(&out->json, i);
    sl_json_put_end(&out->json, ']');
}

static sl_status print_space(printer *out, const sl_space *space) {
    const sl_box *b = &space->bounds;
    fputs(",\n\"bounds\": ", out->stream);
    print_segment(out, b->min, b->max);
    fputs(",\n\"walls\": [", out->stream);
    for (uint32_t i = 0; begin_item(out, i, space->wall_count); i++)
        print_segment(out, space->walls[i].a, space->walls[i].b);
    SL_TRY(sl_check_cancelled(out->context));
    fputs("]", out->stream);
    print_solids(out, space);
    fputs(",\n\"cells\": [", out->stream);
    for (uint32_t i = 0; begin_item(out, i, space->cell_count); i++) print_cell(out, space, i);
    SL_TRY(sl_check_cancelled(out->context));
    fputs("],\n\"portals\": [", out->stream);
    for (uint32_t i = 0; begin_item(out, i, space->portal_count); i++)
        print_portal(out, &space->portals[i]);
    fputs("]", out->stream);
    return sl_check_cancelled(out->context);
}

static sl_status print_baked(printer *out, const sl_baked *baked) {
    const sl_visibility *visibility = &baked->visibility;
    fprintf(out->stream, "{\"format\": \"sightline\", \"version\": 1, \"sight\": \"%s\"",
            visibility->sight == SL_CLOSED ? "closed" : "open");
    if (sl_partial_begun(&baked->partial)) fputs(", \"finished\": false", out->stream);
    SL_TRY(print_space(out, &baked->space));
    fputs(",\n\"pvs\": [", out->stream);
    for (uint32_t i = 0; begin_item(out, i, visibility->pvs.cell_count); i++) {
        print_row(out, &visibility->pvs, i);
        SL_TRY(sl_check_cancelled(out->context));
    }
    fputs("]}\n", out->stream);
    return SL_OK;
}

sl_status sl_export_json(sl_context *context, const sl_baked *baked,
                         const sl_export_options *options, const char *path) {
    (void)options;
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    printer out = {context, output.stream, sl_json_writer_to(output.stream, 0)};
    return sl_output_close(context, &output, print_baked(&out, baked));
}

// --- CSV: a line for each ordered pair of cells of which the first sees the second

static sl_status print_pairs(sl_context *context, const sl_pvs *pvs, FILE *stream) {
    fputs("from,to\n", stream);
    for (uint32_t cell = 0; cell < pvs->cell_count && !ferror(stream); cell++) {
        SL_TRY(sl_check_cancelled(context));
        for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
            for (uint32_t i = run.first; i < run.end; i++)
                fprintf(stream, "%" PRIu32 ",%" PRIu32 "\n", cell, i);
        sl_report(context, "export", "cells", cell + 1, pvs->cell_count);
    }
    return SL_OK;
}

sl_status sl_export_csv(sl_context *context, const sl_baked *baked,
                        const sl_export_options *options, const char *path) {
    (void)options;
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output,
                           print_pairs(context, &baked->visibility.pvs, output.stream));
}

// --- C source: the matrix of visible sets, a bit a pair, for programs that want to read no file

/// The bits of a row, lowest first in each byte.
static void fill_row(const sl_pvs *pvs, uint32_t cell, uint8_t *row, size_t bytes) {
    memset(row, 0, bytes);
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++) row[i / 8] |= (uint8_t)(1u << i % 8);
}

static sl_status print_rows(sl_context *context, const sl_pvs *pvs, uint8_t *row, size_t bytes,
                            FILE *stream) {
    fprintf(stream,
            "/* Which cells see which, by Sightline. */\n"
            "#ifndef VISIBLE_H\n#define VISIBLE_H\n\n"
            "#define VISIBLE_CELLS %" PRIu32 "\n\n"
            "/* Cell b is seen from cell a where this is not 0. */\n"
            "#define VISIBLE(a, b) (visible[a][(b) / 8] >> (b) %% 8 & 1)\n\n"
            "static const unsigned char visible[%" PRIu32 "][%zu] = {\n",
            pvs->cell_count, pvs->cell_count, bytes);
    for (uint32_t cell = 0; cell < pvs->cell_count && !ferror(stream); cell++) {
        SL_TRY(sl_check_cancelled(context));
        fill_row(pvs, cell, row, bytes);
        fputs("    {", stream);
        for (size_t i = 0; i < bytes; i++) fprintf(stream, i ? ",%u" : "%u", row[i]);
        fputs("},\n", stream);
        sl_report(context, "export", "cells", cell + 1, pvs->cell_count);
    }
    fputs("};\n\n#endif\n", stream);
    return SL_OK;
}

sl_status sl_export_c(sl_context *context, const sl_baked *baked, const sl_export_options *options,
                      const char *path) {
    (void)options;
    const sl_pvs *pvs = &baked->visibility.pvs;
    const size_t bytes = ((size_t)pvs->cell_count + 7) / 8;
    uint8_t *row = sl_alloc_array(context, bytes, 1);
    if (!row) return SL_NO_MEMORY;
    sl_output output;
    sl_status status = sl_output_open(context, path, &output);
    if (status == SL_OK)
        status =
            sl_output_close(context, &output, print_rows(context, pvs, row, bytes, output.stream));
    sl_free(context, row);
    return status;
}

// --- the table

static const sl_export_format formats[] = {
    {.name = "json",
     .what = "everything: walls, cells, portals, visible sets",
     .write = sl_export_json},
    {.name = "csv", .what = "a line for each ordered pair seen", .write = sl_export_csv},
    {.name = "c", .what = "a C header with the matrix, a bit a pair", .write = sl_export_c},
};
enum { FORMAT_COUNT = sizeof formats / sizeof *formats };

const sl_export_format *sl_export_formats(const sl_context *context, size_t *count) {
    return sli_table_items(&context->export_formats, formats, FORMAT_COUNT, count);
}

sl_status sl_export_formats_add(sl_context *context, const sl_export_format *more, size_t count) {
    return sli_table_add(context, &context->export_formats, sizeof *formats, formats, FORMAT_COUNT,
                         more, count);
}
