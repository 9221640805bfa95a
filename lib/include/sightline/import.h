/// Any map file that can be read, by one call.
///
/// A context by itself reads map texts and ASCII plans. sl_io_use() of sightline/io.h adds the
/// formats of other programs.
#ifndef SIGHTLINE_IMPORT_H
#define SIGHTLINE_IMPORT_H

#include "sightline/map.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Start from sl_import_options_default().
typedef struct sl_import_options {
    bool has_slice; ///< whether `slice` is given: readers of 3D models need it
    double slice;   ///< height of the cut, in the model's unit
    /// Which of the maps of a file that holds several, by name; NULL for the only one (a reader
    /// that is called by itself takes the first).
    const char *map;
    /// The layers to take, by name, with commas between; NULL for the format's own choice. "*" for
    /// all visible layers of a drawing (DXF, SVG), "large" or "large,A,B" for a drawing without
    /// small closed pieces that touch nothing, "picture" for the picture in a drawing (SVG).
    /// "A=door,B=window" takes layers of a drawing for a wall, door, window, furniture (it stops
    /// steps, and not sight) or ignores them ("=ignore"); the others stay as they are guessed.
    const char *layers;
    /// The names of objects that are starts, with commas between; "" or "none" for no starts; NULL
    /// for the usual names (player, spawn, start ...). Letters and capitals are the same.
    const char *start_names;
    double tolerance; ///< how far a curve may be from its walls, in the map's unit; 0: the usual
    /// Coordinates are to be in this unit: mm, cm, m, km, in, ft or yd; NULL: in the file's own.
    /// "mm=m": the file is in mm, whatever it says, and is to be in m. "0.0254=m": a unit of the
    /// file, of any format but one in degrees, is 0.0254 m long.
    const char *unit;
    double entrance;  ///< how wide openings to the outside are at most (sl_map.entrance); 0: as
                      ///< the file says
    double threshold; ///< images: darkness from which a pixel is solid, 0 .. 1; 0: the usual
    /// Take the doors of a game that opens them at a touch (Doom) as doors. Off: they are seen
    /// through. Those of other formats are doors in any case.
    bool doors;
    /// Make seams of the lines between different sectors (Doom), so that each cell is in one
    /// sector.
    bool sectors;
    /// Coordinates are plain units: no longitude and latitude (GeoJSON).
    bool planar;
    /// Coordinates are longitude and latitude, however few their decimals are (GeoJSON).
    bool degrees;
    /// Take all lines as drawn, whatever they stand for: doors cut no walls. Where there are no
    /// lines, outlines of polygons are taken (GeoJSON).
    bool lines;
    /// Take the cells that the file brings along, for the subdivision "given". Map texts give
    /// theirs without being asked.
    bool cells;
    /// Drawings: all visible layers, whatever their names mean, unless `layers` names some.
    bool all_layers;
    /// Keep only what lies in `crop`, a box in the map's places (sl_map_crop).
    bool has_crop;
    sl_box crop;
    /// The coordinate system of the map's x and y: "EPSG:2056" (sl_earth.epsg); NULL: as the file
    /// says. Refused where the map is read from longitudes and latitudes.
    const char *crs;
    /// Drawings: no note doubts their size. sl_map_parse() sets it where `unit` gives a length.
    bool sized;
} sl_import_options;

/// The usual options: each format's own choice.
SL_API sl_import_options sl_import_options_default(void);

/// Names of maps, in the order of their file. Zeroed, it is empty.
typedef struct sl_map_list {
    char **names;
    size_t count, room;
} sl_map_list;

SL_API void sl_map_list_destroy(sl_context *context, sl_map_list *list); ///< and zeroes it
/// Adds a copy of a name of `length` bytes.
SL_API sl_status sl_map_list_add(sl_context *context, sl_map_list *list, const char *name,
                                 size_t length);

/// Which options a format takes; the others are refused.
typedef enum sl_import_takes {
    SL_TAKES_SLICE = 1,
    SL_TAKES_LAYERS = 2,
    SL_TAKES_TOLERANCE = 4,
    SL_TAKES_THRESHOLD = 8,
    SL_TAKES_DOORS = 16,
    SL_TAKES_CELLS = 32,
    SL_TAKES_UNIT = 64,
    SL_TAKES_SECTORS = 128,
    SL_TAKES_STARTS = 256,
    SL_TAKES_DEGREES = 512, ///< planar, degrees and lines
    SL_TAKES_PLANS = 1024,  ///< a file may hold several plans on one sheet
} sl_import_takes;

/// What a format has a place for, beside walls. sl_map_write() reports what it leaves out.
typedef enum sl_map_keeps {
    SL_KEEPS_DOORS = 1, ///< with their names, and whether they are open
    SL_KEEPS_SOLID = 2, ///< solid ground; else its outlines are written as walls
    SL_KEEPS_MIRRORS = 4,
    SL_KEEPS_ONEWAYS = 8,
    SL_KEEPS_SEAMS = 16,
    SL_KEEPS_RANGE = 32,
    SL_KEEPS_STARTS = 64,
    SL_KEEPS_PATHS = 128,
    SL_KEEPS_OBJECTS = 256,
    SL_KEEPS_CELLS = 512, ///< cells of the map's own, and their snap
    SL_KEEPS_NOTES = 1024,
    SL_KEEPS_COMMENTS = 2048,
    SL_KEEPS_UNIT = 4096,     ///< what a map's lengths are in
    SL_KEEPS_ENTRANCE = 8192, ///< how wide entrances are
    SL_KEEPS_STOPS = 16384,   ///< what walls stop; else those that do not stop what the map is
                              ///< for are left out (sl_map.channel)
    SL_KEEPS_LIMITED = 32768, ///< which walls limit sight; else these are open to it
    SL_KEEPS_EARTH = 65536,   ///< where the map lies on the earth
    SL_KEEPS_ALL = 131071,
} sl_map_keeps;

/// A format: its name, what its files' names end with (space-separated), what it is, how to read
/// it. `text` is bytes where the format is binary; a 0 stands behind it.
typedef struct sl_map_format {
    const char *name, *endings, *what;
    sl_status (*read)(sl_context *context, const char *name, const char *text, size_t size,
                      const sl_import_options *options, sl_map *map);
    unsigned takes; ///< bits of sl_import_takes
    /// Lists the maps of a file into an empty list; NULL for a format of one map a file.
    sl_status (*list)(sl_context *context, const char *name, const char *text, size_t size,
                      sl_map_list *list);
    /// Between which heights a 3D model lies; NULL for a format of plans.
    sl_status (*heights)(sl_context *context, const char *name, const char *text, size_t size,
                         double *lowest, double *highest);
    /// Lists the layers that options->layers may name into an empty list. *unsaid is set where the
    /// file does not say which of them are solid: the reader then guesses, or refuses. NULL for a
    /// format that does not list its layers.
    sl_status (*layers)(sl_context *context, const char *name, const char *text, size_t size,
                        sl_map_list *list, bool *unsaid);
    /// Whether the bytes look like this format's: asked where the ending does not tell. NULL:
    /// never.
    bool (*knows)(const char *text, size_t size);
    /// Writes a map; NULL for a format that is only read. What `keeps` does not name is left out.
    sl_status (*write)(sl_context *context, const sl_map *map, FILE *stream);
    unsigned keeps; ///< bits of sl_map_keeps
} sl_map_format;

/// The formats that the context knows; the first is the map text.
/// The table stays until formats are next added.
SL_API const sl_map_format *sl_map_formats(const sl_context *context, size_t *count);

/// Adds formats, which are copied; one whose name is there already is passed over.
SL_API sl_status sl_map_formats_add(sl_context *context, const sl_map_format *more, size_t count);

/// Reads a map file, by the ending of its name; where several formats have that ending, or none,
/// by its first bytes; else as the map text; "-" is stdin. The map must be empty; on failure it
/// stays so.
/// SL_BAD_INPUT with file and line on a broken file. SL_BAD_ARGUMENT, with names to choose from,
/// where the file holds several maps and options->map names none of them (letters and capitals
/// are the same), and where the format takes no such option.
SL_API sl_status sl_map_read(sl_context *context, const char *path,
                             const sl_import_options *options, sl_map *map);

/// The same from memory. The text or bytes are only read; a 0 stands behind them. `path` is for
/// messages, for its ending, and for files beside it.
SL_API sl_status sl_map_parse(sl_context *context, const char *path, const char *text, size_t size,
                              const sl_import_options *options, sl_map *map);

/// What there is to choose before a file is read. Zeroed, it is empty.
typedef struct sl_map_choice {
    const sl_map_format *format; ///< by which sl_map_read reads it
    sl_map_list maps;            ///< none for a format of one map a file
    double lowest, highest;      ///< of a 3D model; equal for all else
    sl_map_list layers;          ///< none where the format does not list them
    bool layers_unsaid;          ///< the file does not say which layers are solid
} sl_map_choice;

/// Fails as sl_map_read does where the file is broken; `out` then stays as it was.
SL_API sl_status sl_map_choice_read(sl_context *context, const char *path, sl_map_choice *out);
SL_API sl_status sl_map_choice_parse(sl_context *context, const char *path, const char *text,
                                     size_t size, sl_map_choice *out);         ///< as sl_map_parse
SL_API void sl_map_choice_destroy(sl_context *context, sl_map_choice *choice); ///< and zeroes it

// --- writing

/// The format to write a file in: by its name, or where that is NULL by the ending of `path`; for
/// "-", a pipe or a device the map text. SL_BAD_ARGUMENT, with the names or endings to choose from,
/// where no format that can be written fits, or several do. `option` is what messages begin with:
/// "-o plan.xyz: ...".
SL_API sl_status sl_map_format_to_write(sl_context *context, const char *option, const char *path,
                                        const char *name, const sl_map_format **out);

/// Writes a map to a file in this format, NULL for the map text; "-" is stdout. The target is
/// replaced only after all is written and read back. Notes, in a sentence each, what the format has
/// no place for. Coordinates read back to the same doubles.
SL_API sl_status sl_map_write(sl_context *context, const sl_map *map, const sl_map_format *format,
                              const char *path);

#ifdef __cplusplus
}
#endif

#endif
