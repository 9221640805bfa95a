/// Export as CSV: a line for each ordered pair of cells of which the first sees the second.
#include "bake/exports.h"
#include "sightline/support.h"

#include <inttypes.h>

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
