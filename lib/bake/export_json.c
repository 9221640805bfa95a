/// Export as one JSON object, printed piece by piece so that a large map needs no tree in memory.
#include "bake/exports.h"
#include "sightline/support.h"

#include <jansson.h>

typedef struct printer {
    sl_context *context;
    FILE *stream;
} printer;

/// Prints a value with what stands before it, and frees it.
static sl_status print(const printer *out, const char *before, json_t *value) {
    const size_t flags = JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(17);
    sl_status status = sl_check_cancelled(out->context);
    fputs(before, out->stream);
    const bool printed = value && json_dumpf(value, out->stream, flags) == 0;
    json_decref(value);
    // A stream that takes no more is left to its error flag, which the commit asks.
    if (status == SL_OK && !printed && !ferror(out->stream)) status = sl_fail_memory(out->context);
    return status;
}

/// Whether there is an item to print, and a stream to take it.
static bool goes_on(const printer *out, uint32_t i, uint32_t count) {
    return i < count && !ferror(out->stream);
}

static const char *separator(uint32_t i) {
    return i ? ",\n" : "\n";
}

static json_t *segment_json(sl_point a, sl_point b) {
    return json_pack("[ffff]", a.x, a.y, b.x, b.y);
}

static json_t *cell_json(const sl_space *space, uint32_t number) {
    const sl_cell *cell = &space->cells[number];
    json_t *polygon = json_array();
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point *p = &space->vertices[cell->first_vertex + i];
        if (json_array_append_new(polygon, json_pack("[ff]", p->x, p->y)) != 0) {
            json_decref(polygon);
            return NULL;
        }
    }
    return json_pack("{sIso}", "id", (json_int_t)number, "polygon", polygon);
}

static json_t *portal_json(const sl_portal *portal) {
    return json_pack("{s[II]so}", "cells", (json_int_t)portal->cell[0], (json_int_t)portal->cell[1],
                     "segment", segment_json(portal->left, portal->right));
}

static json_t *row_json(const sl_pvs *pvs, uint32_t cell) {
    json_t *row = json_array();
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++)
            if (json_array_append_new(row, json_integer(i)) != 0) {
                json_decref(row);
                return NULL;
            }
    return row;
}

static sl_status print_space(const printer *out, const sl_space *space) {
    const sl_box *b = &space->bounds;
    SL_TRY(print(out, ",\n\"bounds\": ", segment_json(b->min, b->max)));
    fputs(",\n\"walls\": [", out->stream);
    for (uint32_t i = 0; goes_on(out, i, space->wall_count); i++)
        SL_TRY(print(out, separator(i), segment_json(space->walls[i].a, space->walls[i].b)));
    fputs("],\n\"cells\": [", out->stream);
    for (uint32_t i = 0; goes_on(out, i, space->cell_count); i++)
        SL_TRY(print(out, separator(i), cell_json(space, i)));
    fputs("],\n\"portals\": [", out->stream);
    for (uint32_t i = 0; goes_on(out, i, space->portal_count); i++)
        SL_TRY(print(out, separator(i), portal_json(&space->portals[i])));
    fputs("]", out->stream);
    return SL_OK;
}

static sl_status print_baked(const printer *out, const sl_baked *baked) {
    const sl_visibility *visibility = &baked->visibility;
    fprintf(out->stream, "{\"format\": \"sightline\", \"version\": 1, \"sight\": \"%s\"",
            visibility->sight == SL_CLOSED ? "closed" : "open");
    if (sl_partial_begun(&baked->partial)) fputs(", \"finished\": false", out->stream);
    SL_TRY(print_space(out, &baked->space));
    fputs(",\n\"pvs\": [", out->stream);
    for (uint32_t i = 0; goes_on(out, i, visibility->pvs.cell_count); i++)
        SL_TRY(print(out, separator(i), row_json(&visibility->pvs, i)));
    fputs("]}\n", out->stream);
    return SL_OK;
}

sl_status sl_export_json(sl_context *context, const sl_baked *baked,
                         const sl_export_options *options, const char *path) {
    (void)options;
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    const printer out = {context, output.stream};
    return sl_output_close(context, &output, print_baked(&out, baked));
}
