#include "bake/exports.h"

const sl_export_format *sl_export_formats(size_t *count) {
    static const sl_export_format formats[] = {
        {.name = "json",
         .what = "everything: walls, cells, portals, visible sets",
         .write = sl_export_json},
        {.name = "reject",
         .what = "a copy of a Doom WAD with the map's REJECT made anew; needs --wad and --map",
         .takes_wad = true,
         .write = sl_export_reject},
    };
    *count = sizeof formats / sizeof *formats;
    return formats;
}
