/// Maps and exports of other programs: the library sightline_io.
///
///     sl_context *context = sl_context_create(NULL);
///     sl_status status = sl_io_use(context);
///     if (status == SL_OK) status = sl_map_read(context, "plan.dxf", NULL, &map);
#ifndef SIGHTLINE_IO_H
#define SIGHTLINE_IO_H

#include "sightline/bake.h"
#include "sightline/import.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Adds all formats of this header to those that the context reads and writes. SL_NO_MEMORY.
SL_API sl_status sl_io_use(sl_context *context);

// --- exports, as sl_export_format has them

/// "png": one bit a pixel: row a, column b is black where cell a sees cell b. SL_UNSUPPORTED for
/// more cells than such a picture can have.
SL_API sl_status sl_export_png(sl_context *context, const sl_baked *baked,
                               const sl_export_options *options, const char *path);

/// "reject": a copy of options->wad in which the REJECT of options->map says which sectors never
/// see each other: those of which no cells do. Nothing is hidden that a sightline joins: a cell
/// counts for each sector that it reaches into. SL_BAD_INPUT where the map's walls are not those of
/// the baked file; SL_BAD_ARGUMENT where that was baked by a method that may miss something, or
/// with doors. sightline/reject.h has the way for whole WADs.
SL_API sl_status sl_export_reject(sl_context *context, const sl_baked *baked,
                                  const sl_export_options *options, const char *path);

/// The endings of all formats below, with spaces between.
#define SL_IO_ENDINGS                                                                              \
    ".ug .dxf .svg .png .pgm .pbm .yaml .yml .tmx .json .tmj .ldtk .ldtkl .dd2vtt .uvtt .df2vtt "  \
    ".wad"

// --- readers of maps, as sl_map_format has them. `name` is what messages call the file. The map
// --- must be empty, and stays so on failure: SL_BAD_INPUT for a broken file, with "NAME: " or
// --- "NAME:LINE: " first. Walls without length are left out. A file without walls is read; a bake
// --- of it fails.

/// Cuts a UniGrafix model at a height: every face that crosses the plane gives walls. Faces in the
/// plane give none; comments that surround the model are kept as notes. What was taken is noted.
SL_API sl_status sl_map_read_unigrafix(sl_context *context, const char *name, const char *text,
                                       size_t size, const sl_import_options *options, sl_map *map);

/// Between which heights a UniGrafix model lies, for sl_import_options.slice.
SL_API sl_status sl_map_heights_unigrafix(sl_context *context, const char *name, const char *text,
                                          size_t size, double *lowest, double *highest);

/// The lines, polylines with bulges, arcs, circles, ellipses and plain splines (degree up to 3, no
/// weights) of an ASCII DXF drawing, in blocks as inserted, on layers that are on and not frozen or
/// on those asked for. Layers named "sightline-..." hold doors, solid ground and so on
/// (lib/io/FORMATS.md). What was taken is noted. SL_BAD_ARGUMENT where a unit is asked for and
/// there is none of that name, or the drawing does not name its own.
SL_API sl_status sl_map_read_dxf(sl_context *context, const char *name, const char *text,
                                 size_t size, const sl_import_options *options, sl_map *map);

/// A layer of a drawing.
typedef struct sl_drawing_layer {
    char *name;
    size_t entities; ///< on it, those of blocks as often as they are inserted
    bool on;         ///< and not frozen: taken unless layers are asked for
} sl_drawing_layer;

/// The layers of a drawing's table; behind them up to 256 that only entities name. Zeroed: empty.
typedef struct sl_drawing_layers {
    sl_drawing_layer *items;
    size_t count;
} sl_drawing_layers;

/// Lists the layers of a DXF drawing; `out` is empty, and stays so on failure. SL_BAD_INPUT where
/// sl_map_read_dxf() fails too.
SL_API sl_status sl_drawing_layers_dxf(sl_context *context, const char *name, const char *text,
                                       size_t size, sl_drawing_layers *out);
SL_API void sl_drawing_layers_destroy(sl_context *context,
                                      sl_drawing_layers *layers); ///< zeroes it

/// The outlines of an SVG drawing's shapes, in its user units, y turned up. Layers are groups by id
/// or label, also those named "sightline-...". What was taken is noted.
SL_API sl_status sl_map_read_svg(sl_context *context, const char *name, const char *text,
                                 size_t size, const sl_import_options *options, sl_map *map);

/// A picture (PNG, PGM, PBM): pixels are unit squares, dark ones solid (threshold: the usual is
/// 0.5), the lower left one's corner at the origin. What was taken is noted.
SL_API sl_status sl_map_read_image(sl_context *context, const char *name, const char *text,
                                   size_t size, const sl_import_options *options, sl_map *map);

/// A map.yaml of ROS with its picture, found from the folder of `name`. Unit: metres.
SL_API sl_status sl_map_read_ros(sl_context *context, const char *name, const char *text,
                                 size_t size, const sl_import_options *options, sl_map *map);

/// A map of Tiled, as XML (.tmx) or JSON (.tmj): orthogonal, isometric, staggered or hexagonal,
/// fixed or without bounds, with its tilesets, those in files beside it too. Solid is what the
/// layers asked for hold; else what the layers, tiles and objects themselves say
/// (lib/io/FORMATS.md). Objects named as starts or doors are taken as such; a door runs from solid
/// square to solid square. Unit: pixels, as Tiled draws the map. What was taken is noted.
/// SL_BAD_ARGUMENT where options->layers or options->start_names has a name that the map has not.
SL_API sl_status sl_map_read_tmx(sl_context *context, const char *name, const char *text,
                                 size_t size, const sl_import_options *options, sl_map *map);
/// As sl_map_read_tmx, from JSON.
SL_API sl_status sl_map_read_tmj(sl_context *context, const char *name, const char *text,
                                 size_t size, const sl_import_options *options, sl_map *map);

/// Lists the layers of tiles and objects of a map of Tiled into an empty list. *unsaid is set where
/// nothing in the map says what is solid.
SL_API sl_status sl_map_layers_tmx(sl_context *context, const char *name, const char *text,
                                   size_t size, sl_map_list *list, bool *unsaid);
/// As sl_map_layers_tmx, from JSON.
SL_API sl_status sl_map_layers_tmj(sl_context *context, const char *name, const char *text,
                                   size_t size, sl_map_list *list, bool *unsaid);

/// A level of an LDtk project, one in a file of its own too, or all levels of a world ("all", or
/// the world's name): the cells of its IntGrid layers, and entities named as starts or doors. Unit:
/// pixels. What was taken is noted. SL_BAD_ARGUMENT as sl_map_read_tmx.
SL_API sl_status sl_map_read_ldtk(sl_context *context, const char *name, const char *text,
                                  size_t size, const sl_import_options *options, sl_map *map);
/// Lists the levels of an LDtk project into an empty list.
SL_API sl_status sl_map_list_ldtk(sl_context *context, const char *name, const char *text,
                                  size_t size, sl_map_list *list);

/// A Universal VTT file: walls and portals. Unit: squares of its grid. What was taken is noted.
SL_API sl_status sl_map_read_uvtt(sl_context *context, const char *name, const char *text,
                                  size_t size, const sl_import_options *options, sl_map *map);

/// The walls of a scene of Foundry VTT: what stops sight, doors, one-way walls. Friendly tokens are
/// starts, or those of options->start_names. Unit: pixels. What was taken is noted.
SL_API sl_status sl_map_read_foundry(sl_context *context, const char *name, const char *text,
                                     size_t size, const sl_import_options *options, sl_map *map);

/// The map in our own JSON export, version 1 or 2: walls, solid ground, doors, mirrors, one-way
/// glass, seams, starts, paths, objects, range. SL_BAD_INPUT, naming the place, for other versions.
SL_API sl_status sl_map_read_export(sl_context *context, const char *name, const char *text,
                                    size_t size, const sl_import_options *options, sl_map *map);

/// Drawn lines of GeoJSON, as walls: lines, and outlines of polygons. It is no map, so sl_map_read
/// does not read it. Coordinates are taken as they are, in a plane.
SL_API sl_status sl_lines_read_geojson(sl_context *context, const char *name, const char *text,
                                       size_t size, sl_map *map);

/// Reads a map of a Doom WAD: lumps of Doom's or Hexen's records, or a TEXTMAP (UDMF). Lines with
/// one side are walls; those with two are seen through, and so are doors, shut ones too: what a
/// player may open hides nothing. With options->doors each line between a door sector (one whose
/// ceiling meets the floor when the map begins, or that a door special of a line moves) and another
/// is a door, named "sector_" and its number, open where there is room under the ceiling. The
/// starts of players 1 to 4 are kept, else those of a deathmatch. What was taken is noted. Messages
/// name the lump, and the line in a TEXTMAP.
SL_API sl_status sl_map_read_wad(sl_context *context, const char *name, const char *text,
                                 size_t size, const sl_import_options *options, sl_map *map);
/// Its maps, each name once, in the order of the directory.
SL_API sl_status sl_map_list_wad(sl_context *context, const char *name, const char *text,
                                 size_t size, sl_map_list *list);

// --- writers of maps, as sl_map_format has them; sl_map_write() in sightline/import.h calls them.
// --- Numbers read back to the same doubles, y too: each writer finds a place where turning y
// --- rounds nothing. Notes say what another program may do to the file; sl_map_write() notes what
// --- the format has no place for. SL_NO_MEMORY, SL_CANCELLED; SL_UNSUPPORTED for a name with
// --- U+FFFE or U+FFFF in the formats of XML.

/// Writes a DXF drawing of release 12. Layers named "sightline-..." say what is what.
SL_API sl_status sl_map_print_dxf(sl_context *context, const sl_map *map, FILE *stream);

/// Writes an SVG drawing. Layers as in DXF drawings.
SL_API sl_status sl_map_print_svg(sl_context *context, const sl_map *map, FILE *stream);

/// Writes an orthogonal map of Tiled, of object layers. Layers as in DXF drawings.
SL_API sl_status sl_map_print_tmx(sl_context *context, const sl_map *map, FILE *stream);

/// Writes a Universal VTT file: walls and portals; a map unit is a square of its grid.
SL_API sl_status sl_map_print_uvtt(sl_context *context, const sl_map *map, FILE *stream);

/// Writes a scene of Foundry VTT; a unit of the map is a power of two pixels.
SL_API sl_status sl_map_print_foundry(sl_context *context, const sl_map *map, FILE *stream);

// --- pictures by their pixels

/// Rows from the top down, a byte a pixel: 0 black, 255 white. Zeroed, there is none.
typedef struct sl_image {
    size_t width, height;
    unsigned char *pixels;
} sl_image;

/// PNG, or portable grey map or bit map (P1, P2, P4, P5); the first bytes say which. What is
/// transparent is white. SL_BAD_INPUT, naming the file, for all else.
SL_API sl_status sl_image_read(sl_context *context, const char *name, const char *bytes,
                               size_t size, sl_image *out);
/// Frees the pixels, and zeroes it.
SL_API void sl_image_destroy(sl_context *context, sl_image *image);

#ifdef __cplusplus
}
#endif

#endif
