/// Export as C source: the matrix of visible sets, a bit a pair, for programs that want to read no
/// file.
#include "bake/exports.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <string.h>

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
