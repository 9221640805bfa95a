#include "bake/exports.h"

const sl_export_format *sl_export_formats(size_t *count) {
    static const sl_export_format formats[] = {
        {.name = "json",
         .what = "everything: walls, cells, portals, visible sets",
         .write = sl_export_json},
        {.name = "csv", .what = "a line for each ordered pair seen", .write = sl_export_csv},
        {.name = "png",
         .what = "the matrix of pairs as a picture, black where row sees column",
         .write = sl_export_png},
        {.name = "c", .what = "a C header with the matrix, a bit a pair", .write = sl_export_c},
        {.name = "reject",
         .what = "a copy of a Doom WAD with the map's REJECT made anew; needs --wad and --map",
         .takes_wad = true,
         .write = sl_export_reject},
    };
    *count = sizeof formats / sizeof *formats;
    return formats;
}
