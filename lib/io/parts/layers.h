/// Layers of drawings by the name of what they hold: the way in which SVG, DXF and Tiled files hold
/// all of a map. Also where y is 0 in files with y down, and whether a file's numbers are exact.
#ifndef SL_LAYERS_H
#define SL_LAYERS_H

#include "io/parts/shapes.h"
#include "map/scan.h"

/// What a layer holds: shapes of the map text's statements. NONE for all other layers.
typedef enum sli_layer {
    SLI_LAYER_NONE,
    SLI_LAYER_WALL,
    SLI_LAYER_SOLID,      ///< closed outlines of solid ground
    SLI_LAYER_OPEN,       ///< closed outlines of open ground, cut out of solid ground
    SLI_LAYER_WALL_SOLID, ///< walls with solid ground at their left
    SLI_LAYER_DOOR,
    SLI_LAYER_MIRROR,
    SLI_LAYER_MIRROR_ONE, ///< reflects on its left only
    SLI_LAYER_ONEWAY,     ///< seen through from its right to its left
    SLI_LAYER_SEAM,
    SLI_LAYER_START,
    SLI_LAYER_PATH,
    SLI_LAYER_OBJECT, ///< closed outlines of boxes
    SLI_LAYER_CELL,   ///< closed outlines
    SLI_LAYER_WRONG,  ///< it says what walls stop, in words that nobody knows
    /// Walls that do not stop all, outlines of ground with such, and such walls with solid ground
    /// at their left: the first of the layers, by what they stop, from SL_STOPS_SIGHT on.
    SLI_LAYER_PARTIAL,
    SLI_LAYER_PARTIAL_SOLID = SLI_LAYER_PARTIAL + SL_STOPS_ALL - 1,
    SLI_LAYER_PARTIAL_WALL_SOLID = SLI_LAYER_PARTIAL_SOLID + SL_STOPS_ALL - 1,
    SLI_LAYER_COUNT = SLI_LAYER_PARTIAL_WALL_SOLID + SL_STOPS_ALL - 1,
} sli_layer;

/// What walls of such a layer stop; 0 for other layers.
static inline uint32_t sli_layer_stops(sli_layer layer) {
    if (layer < SLI_LAYER_PARTIAL) return 0;
    return (uint32_t)(layer - SLI_LAYER_PARTIAL) % (SL_STOPS_ALL - 1) + 1;
}

/// "sightline-wall" and so on.
const char *sli_layer_name(sli_layer layer);

/// What a layer of this name holds. Small letters and capitals are the same. `*rest`, where not
/// NULL, gets what stands behind the name and a '-': "open-front" of "sightline-door-open-front".
/// Where it is NULL the name must be all.
sli_layer sli_layer_of(sli_word name, sli_word *rest);

/// A shape of a layer. Left and right are as in the map, which has y up.
typedef struct sli_layer_item {
    sli_layer layer;
    const char *name; ///< of a door, a path or an object; NULL for none
    bool open;        ///< a door
    double heading;   ///< a start
    const sl_point *points;
    size_t count; ///< of points: 1 of a start, at least 2 of all else
    bool closed;  ///< the last point is joined to the first
} sli_layer_item;

// --- reading

/// Adds a shape to the map: `drawn` is what a pen drew of it, in the map's places; `points` and
/// `count` of the item are not read, but of a start. SL_BAD_INPUT, with the file's name and the
/// line, where an outline is not closed or crosses itself.
sl_status sli_layer_take(sl_context *context, const char *file, sl_map *map,
                         const sli_layer_item *item, const sl_map *drawn, uint32_t line);

/// A heading after a transform between drawings that both have y up; the same number where the
/// transform does not turn.
double sli_heading_through(sli_affine affine, double heading);

/// Notes how many things the map has by its layers; nothing where it has walls only.
void sli_layers_note(sl_context *context, const char *file, const sl_map *map);

// --- writing

/// Who takes the shapes, layer after layer. Layers without shapes are not begun.
typedef struct sli_layer_sink {
    void *user;
    void (*begin)(void *user, sli_layer layer);
    void (*item)(void *user, const sli_layer_item *item);
    void (*end)(void *user);
} sli_layer_sink;

/// Gives all of a map to a sink. Notes the paths and objects that have no length.
sl_status sli_layers_write(sl_context *context, const sl_map *map, const sli_layer_sink *sink);

/// The file's y that is 0 in the map, for writing: y of the file is this less y of the map. The
/// map's own where it has one; else the upper edge of its page, rounded up; else 0. It is taken
/// only if all y read back to the same doubles, as they always do with 0.
double sli_choose_top(const sl_map *map);
/// y of the file.
double sli_turned_y(double top, double y);

/// The map's page; else its bounds, in whole numbers. Never empty.
sl_box sli_page_of(const sl_map *map);

/// Writes a number to a stream, and adds it to the sum of its digits.
void sli_put_number(FILE *stream, double value, uint64_t *sum);

/// SL_UNSUPPORTED, naming the line, where a name has a character that XML files cannot have.
sl_status sli_check_xml_names(sl_context *context, const sl_map *map);

/// Writes a text as the value of an XML attribute.
void sli_put_escaped(FILE *stream, const char *text);

/// Writes the mark of a file whose numbers have this sum.
void sli_write_mark(const sl_map *map, uint64_t sum, char text[SLI_MARK_TEXT]);

#endif
