/// Maps and exports of other programs: the library sightline_io.
///
///     sl_context *context = sl_context_create(NULL);
///     sl_status status = sl_io_use(context);
///     if (status == SL_OK) status = sl_map_read(context, "plan.dxf", NULL, &map);
#ifndef SIGHTLINE_IO_H
#define SIGHTLINE_IO_H

#include "sightline/bake.h"
#include "sightline/import.h"
#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Adds all formats of maps and exports that lib/io/FORMATS.md tells of to those that the context
/// reads and writes (sl_map_formats, sl_export_formats). SL_NO_MEMORY.
SL_API sl_status sl_io_use(sl_context *context);

/// The endings of all their files, with spaces between.
#define SL_IO_ENDINGS                                                                              \
    ".ug .dxf .svg .png .pgm .pbm .ppm .yaml .yml .tmx .json .tmj .world .ldtk .ldtkl .dd2vtt "    \
    ".uvtt "                                                                                       \
    ".df2vtt .db .ldb .geojson .pol .wad"

// --- what there is in a drawing

/// A layer of a drawing. Of SVG: a group that is named, or a look ("black line 3").
typedef struct sl_drawing_layer {
    char *name;
    size_t entities; ///< on it, those of blocks as often as they are inserted; of SVG: shapes
    bool on;         ///< and not frozen: taken unless layers are asked for
    /// What it is taken for by its name, and by what is on it: "wall", "door", "window" or
    /// "ignore". Options may say otherwise (sl_import_options.layers).
    const char *taken_for;
} sl_drawing_layer;

/// The layers of a drawing's table; behind them up to 256 that only entities name. Zeroed: empty.
typedef struct sl_drawing_layers {
    sl_drawing_layer *items;
    size_t count;
} sl_drawing_layers;

/// Lists the layers of a DXF drawing; `out` is empty, and stays so on failure. SL_BAD_INPUT where
/// sl_map_read() fails too.
SL_API sl_status sl_drawing_layers_dxf(sl_context *context, const char *name, const char *text,
                                       size_t size, sl_drawing_layers *out);
/// The same for an SVG drawing. A shape is in one group, and in one look.
SL_API sl_status sl_drawing_layers_svg(sl_context *context, const char *name, const char *text,
                                       size_t size, sl_drawing_layers *out);
SL_API void sl_drawing_layers_destroy(sl_context *context,
                                      sl_drawing_layers *layers); ///< zeroes it

// --- lines and pictures

/// A line or outline of a drawing that is written.
typedef struct sl_polyline {
    const char *layer; ///< one word
    const sl_point *points;
    size_t count; ///< 2 or more
    bool closed;
} sl_polyline;

/// Writes lines as a DXF drawing of release 12, "-" for stdout: LINE for two points, else POLYLINE.
/// `unit` as sl_map.unit. Coordinates read back to the same doubles. SL_BAD_ARGUMENT for a layer
/// that is no word, and for fewer than two points; SL_IO; a failure leaves an older file as it was.
SL_API sl_status sl_polylines_write_dxf(sl_context *context, const sl_polyline *lines, size_t count,
                                        const char *unit, const char *path);

/// Drawn lines of GeoJSON, as walls: lines, whatever they stand for, or outlines of polygons where
/// there are no lines, as sl_map_read() reads them with sl_import_options.lines. Longitude and
/// latitude are laid in a plane in metres (sl_map.earth).
SL_API sl_status sl_lines_read_geojson(sl_context *context, const char *name, const char *text,
                                       size_t size, sl_map *map);

/// Rows from the top down, a byte a pixel: 0 black, 255 white. Zeroed, there is none.
typedef struct sl_image {
    size_t width, height;
    unsigned char *pixels;
} sl_image;

/// PNG, or portable bit, grey or colour map (P1 to P6); the first bytes say which. What is
/// transparent is white. SL_BAD_INPUT, naming the file, for all else.
SL_API sl_status sl_image_read(sl_context *context, const char *name, const char *bytes,
                               size_t size, sl_image *out);
/// Frees the pixels, and zeroes it.
SL_API void sl_image_destroy(sl_context *context, sl_image *image);

// --- Doom's REJECT: the table of sectors that never see each other

/// Start from sl_reject_options_default().
typedef struct sl_reject_options {
    /// Names of maps, in small letters or capitals; none: all maps of the WAD.
    const char *const *maps;
    size_t map_count;
    sl_sight sight;     ///< open: sightlines that only touch ends of walls do not count
    unsigned threads;   ///< 0: one a core; the result does not depend on it
    uint64_t row_bytes; ///< limit on memory for visible sets, of all maps at work together
} sl_reject_options;

/// The usual options: all maps, open sight.
SL_API sl_reject_options sl_reject_options_default(void);

/// What the REJECT of a map holds.
typedef struct sl_reject_account {
    char map[9];
    uint32_t sectors, cells;
    uint32_t unknown; ///< sectors without a cell that was looked from: nothing is hidden from them
    uint64_t hidden;  ///< unordered pairs of sectors
} sl_reject_account;

/// Of each map, in the order of the WAD or as they were asked for. Zeroed, it is empty.
typedef struct sl_reject_report {
    sl_reject_account *maps;
    size_t count;
} sl_reject_report;

SL_API void sl_reject_report_destroy(sl_context *context,
                                     sl_reject_report *report); ///< and zeroes it

/// Writes a copy of a WAD in which maps have a new REJECT; "-" for stdout. Each map is cut into
/// cells that lie in one sector each, and the sweep computes exactly which cells see each other;
/// doors are seen through. Hidden are pairs of sectors that no sightline past all walls joins. All
/// other lumps keep their bytes. The WAD is read once and written once, when all maps are done;
/// what fails, or is cancelled, leaves an older file as it was. SL_BAD_INPUT names the map;
/// SL_BAD_ARGUMENT where a map is asked for twice or there is none. Reports stage "reject", unit
/// "maps"; of a single map the stages of its bake. `report` must be empty; on failure it stays so.
SL_API sl_status sl_reject_wad(sl_context *context, const char *path,
                               const sl_reject_options *options, const char *output,
                               sl_reject_report *report);

#ifdef __cplusplus
}
#endif

#endif
