/// The formats of sightline_io: what stands in the tables of maps and exports (io.c). Programs
/// reach them by name (sl_map_formats, sl_export_formats).
#ifndef SL_FORMATS_H
#define SL_FORMATS_H

#include "sightline/io.h"

// --- exports, as sl_export_format has them

/// "png": one bit a pixel: row a, column b is black where cell a sees cell b. SL_UNSUPPORTED for
/// more cells than such a picture can have.
sl_status sli_export_png(sl_context *context, const sl_baked *baked,
                         const sl_export_options *options, const char *path);

/// "reject": a copy of options->wad in which the REJECT of options->map says which sectors never
/// see each other: those of which no cells do. Nothing is hidden that a sightline joins: a cell
/// counts for each sector that it reaches into. SL_BAD_INPUT where the map's walls are not those of
/// the baked file; SL_BAD_ARGUMENT where that was baked by a method that may miss something, or
/// with doors. sl_reject_wad() does whole WADs.
sl_status sli_export_reject(sl_context *context, const sl_baked *baked,
                            const sl_export_options *options, const char *path);

// --- readers of maps, as sl_map_format has them. `name` is what messages call the file. The map
// --- must be empty, and stays so on failure: SL_BAD_INPUT for a broken file, with "NAME: " or
// --- "NAME:LINE: " first. Walls without length are left out. A file without walls is read; a bake
// --- of it fails.

/// Cuts a UniGrafix model at a height: every face that crosses the plane gives walls. Faces in the
/// plane give none; comments that surround the model are kept as notes. What was taken is noted.
sl_status sli_map_read_unigrafix(sl_context *context, const char *name, const char *text,
                                 size_t size, const sl_import_options *options, sl_map *map);

/// Between which heights a UniGrafix model lies, for sl_import_options.slice.
sl_status sli_map_heights_unigrafix(sl_context *context, const char *name, const char *text,
                                    size_t size, double *lowest, double *highest);

/// A polygon of AGPLIB: open ground, its holes solid. Coordinates are the quotients of doubles.
/// What was taken is noted. SL_BAD_INPUT for a polygon that crosses itself, as sl_map_add_open.
sl_status sli_map_read_agp(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map);

/// The lines, polylines with bulges, arcs, circles, ellipses and plain splines (degree up to 3, no
/// weights) of a DXF drawing, text or binary, in blocks as inserted, on layers that are on and not
/// frozen and mean walls, windows or doors (parts/contents.h), or on those asked for. Layers named
/// "sightline-..." hold doors, solid ground and so on (lib/io/FORMATS.md). What was taken is noted.
/// SL_BAD_ARGUMENT where a unit is asked for and there is none of that name, or the drawing does
/// not name its own.
sl_status sli_map_read_dxf(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map);

/// The outlines of an SVG drawing's shapes, in its user units, y turned up. Layers are groups by id
/// or label, taken by what they mean or as asked for; also those named "sightline-...". Shapes that
/// are not seen are left out. A drawing that is a picture is read as that. What was taken is noted.
sl_status sli_map_read_svg(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map);

/// A picture (PNG, PGM, PBM): pixels are unit squares, the lower left one's corner at the origin.
/// Solid are dark ones, or light or opaque ones where they are lines on a dark or transparent
/// ground (options->layers: dark, light, opaque; large), from a threshold, usually 0.5. What was
/// taken is noted.
sl_status sli_map_read_image(sl_context *context, const char *name, const char *text, size_t size,
                             const sl_import_options *options, sl_map *map);

/// A map.yaml of ROS with its picture, found from the folder of `name`. Unit: metres.
sl_status sli_map_read_ros(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map);

/// A map of Tiled, as XML (.tmx) or JSON (.tmj): orthogonal, isometric, staggered or hexagonal,
/// fixed or without bounds, with its tilesets, those in files beside it too. Solid is what the
/// layers asked for hold; else what the layers, tiles and objects themselves say
/// (lib/io/FORMATS.md). Objects named as starts or doors are taken as such; a door runs from solid
/// square to solid square. Unit: pixels, as Tiled draws the map. What was taken is noted.
/// SL_BAD_ARGUMENT where options->layers or options->start_names has a name that the map has not.
sl_status sli_map_read_tmx(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map);
/// As sli_map_read_tmx, from JSON.
sl_status sli_map_read_tmj(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map);

/// Lists the layers of tiles and objects of a map of Tiled into an empty list. *unsaid is set where
/// nothing in the map says what is solid.
sl_status sli_map_layers_tmx(sl_context *context, const char *name, const char *text, size_t size,
                             sl_map_list *list, bool *unsaid);
/// As sli_map_layers_tmx, from JSON.
sl_status sli_map_layers_tmj(sl_context *context, const char *name, const char *text, size_t size,
                             sl_map_list *list, bool *unsaid);

/// A map of a world of Tiled (options->map, the name of its file; else the first), as
/// sli_map_read_tmx reads it. SL_BAD_INPUT where the world names none.
sl_status sli_map_read_world(sl_context *context, const char *name, const char *text, size_t size,
                             const sl_import_options *options, sl_map *map);
/// Its maps, by the names of their files.
sl_status sli_map_list_world(sl_context *context, const char *name, const char *text, size_t size,
                             sl_map_list *list);

/// A level of an LDtk project, one in a file of its own too, or all levels of a world ("all", or
/// the world's name): the cells of its IntGrid layers, and entities named as starts or doors. Unit:
/// pixels. What was taken is noted. SL_BAD_ARGUMENT as sli_map_read_tmx.
sl_status sli_map_read_ldtk(sl_context *context, const char *name, const char *text, size_t size,
                            const sl_import_options *options, sl_map *map);
/// Lists the levels of an LDtk project into an empty list.
sl_status sli_map_list_ldtk(sl_context *context, const char *name, const char *text, size_t size,
                            sl_map_list *list);

/// A Universal VTT file: walls, portals as doors, and the edge where they leave it open. Unit:
/// squares of its grid. What was taken is noted.
sl_status sli_map_read_uvtt(sl_context *context, const char *name, const char *text, size_t size,
                            const sl_import_options *options, sl_map *map);

/// The walls of a scene of Foundry VTT (options->map; else the first): what stops sight, doors,
/// one-way walls, and the edge where they leave it open. Friendly tokens are starts, or those of
/// options->start_names. Unit: pixels. What was taken is noted.
sl_status sli_map_read_foundry(sl_context *context, const char *name, const char *text, size_t size,
                               const sl_import_options *options, sl_map *map);
/// Its scenes that have walls: one, or those of an adventure or a database.
sl_status sli_map_list_foundry(sl_context *context, const char *name, const char *text, size_t size,
                               sl_map_list *list);

/// The map in our own JSON export, version 1 or 2: walls, solid ground, doors, mirrors, one-way
/// glass, seams, starts, paths, objects, range. SL_BAD_INPUT, naming the place, for other versions.
sl_status sli_map_read_export(sl_context *context, const char *name, const char *text, size_t size,
                              const sl_import_options *options, sl_map *map);

/// GeoJSON (RFC 7946): outlines of rooms and walls, openings cut out of them; or all lines as drawn
/// (options->lines). Longitude and latitude are laid in a plane in metres (sl_map.earth). Levels
/// are maps, by name; options->map NULL: all of them. What was taken is noted. SL_BAD_ARGUMENT
/// where options->layers has a name that the file has not.
sl_status sli_map_read_geojson(sl_context *context, const char *name, const char *text, size_t size,
                               const sl_import_options *options, sl_map *map);
/// Its levels, lowest first; none where features have none.
sl_status sli_map_list_geojson(sl_context *context, const char *name, const char *text, size_t size,
                               sl_map_list *list);

/// Reads a map of a Doom WAD: lumps of Doom's or Hexen's records, or a TEXTMAP (UDMF). Lines with
/// one side are walls; those with two are seen through, and so are doors, shut ones too: what a
/// player may open hides nothing. With options->doors each line between a door sector (one whose
/// ceiling meets the floor when the map begins, or that a door special of a line moves) and another
/// is a door, named "sector_" and its number, open where there is room under the ceiling. The
/// starts of players 1 to 4 are kept, else those of a deathmatch. What was taken is noted. Messages
/// name the lump, and the line in a TEXTMAP.
sl_status sli_map_read_wad(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map);
/// Its maps, each name once, in the order of the directory.
sl_status sli_map_list_wad(sl_context *context, const char *name, const char *text, size_t size,
                           sl_map_list *list);

// --- writers of maps, as sl_map_format has them; sl_map_write() calls them.
// --- Numbers read back to the same doubles, y too: each writer finds a place where turning y
// --- rounds nothing. Notes say what another program may do to the file; sl_map_write() notes what
// --- the format has no place for. SL_NO_MEMORY, SL_CANCELLED; SL_UNSUPPORTED for a name with
// --- U+FFFE or U+FFFF in the formats of XML.

/// Writes a DXF drawing of release 12. Layers named "sightline-..." say what is what.
sl_status sli_map_print_dxf(sl_context *context, const sl_map *map, FILE *stream);

/// Writes an SVG drawing. Layers as in DXF drawings.
sl_status sli_map_print_svg(sl_context *context, const sl_map *map, FILE *stream);

/// Writes an orthogonal map of Tiled, of object layers. Layers as in DXF drawings.
sl_status sli_map_print_tmx(sl_context *context, const sl_map *map, FILE *stream);

/// Writes a Universal VTT file: walls and portals; a map unit is a square of its grid.
sl_status sli_map_print_uvtt(sl_context *context, const sl_map *map, FILE *stream);

/// Writes a scene of Foundry VTT; a unit of the map is a power of two pixels.
sl_status sli_map_print_foundry(sl_context *context, const sl_map *map, FILE *stream);

#endif
