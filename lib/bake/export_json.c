/// Export as one JSON object, printed piece by piece so that a large map needs no tree in memory.
#include "bake/exports.h"
#include "base/file.h"

#include <jansson.h>

/// Prints a value with what stands before it, and frees it. False where there was no memory.
static bool print(FILE *stream, const char *before, json_t *value) {
    fputs(before, stream);
    const bool printed =
        value &&
        json_dumpf(value, stream, JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(17)) == 0;
    json_decref(value);
    return printed || ferror(stream);
}

static const char *separator(uint64_t i) {
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

static bool print_space(const sl_space *space, FILE *stream) {
    const sl_box *b = &space->bounds;
    bool good = print(stream, ",\n\"bounds\": ", segment_json(b->min, b->max));
    fputs(",\n\"walls\": [", stream);
    for (uint32_t i = 0; i < space->wall_count && good; i++)
        good = print(stream, separator(i), segment_json(space->walls[i].a, space->walls[i].b));
    fputs("],\n\"cells\": [", stream);
    for (uint32_t i = 0; i < space->cell_count && good; i++)
        good = print(stream, separator(i), cell_json(space, i));
    fputs("],\n\"portals\": [", stream);
    for (uint32_t i = 0; i < space->portal_count && good; i++) {
        const sl_portal *p = &space->portals[i];
        good = print(stream, separator(i),
                     json_pack("{s[II]so}", "cells", (json_int_t)p->cell[0], (json_int_t)p->cell[1],
                               "segment", segment_json(p->left, p->right)));
    }
    fputs("]", stream);
    return good;
}

static bool print_baked(const sl_baked *baked, FILE *stream) {
    const sl_visibility *visibility = &baked->visibility;
    fprintf(stream, "{\"format\": \"sightline\", \"version\": 1, \"sight\": \"%s\"",
            visibility->sight == SL_CLOSED ? "closed" : "open");
    bool good = print_space(&baked->space, stream);
    fputs(",\n\"pvs\": [", stream);
    for (uint32_t i = 0; i < visibility->pvs.cell_count && good; i++)
        good = print(stream, separator(i), row_json(&visibility->pvs, i));
    fputs("]}\n", stream);
    return good;
}

sl_status sl_export_json(sl_context *context, const sl_baked *baked, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    const bool printed = print_baked(baked, output.stream);
    return sl_output_close(context, &output, printed ? SL_OK : sl_fail_memory(context));
}
