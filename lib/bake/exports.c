#include "bake/exports.h"

const sl_export_format *sl_export_formats(size_t *count) {
    static const sl_export_format formats[] = {
        {.name = "json",
         .what = "everything: walls, cells, portals, visible sets",
         .write = sl_export_json},
    };
    *count = sizeof formats / sizeof *formats;
    return formats;
}
