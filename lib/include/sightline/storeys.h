/// Buildings: plans as storeys, and links between places of them, as stairs and lifts are. The
/// plans are files of their own, each in coordinates of its own. maps/FORMAT.md has the format.
///
///     storeys 1
///     storey ground plan0.dxf
///     storey first plan1.dxf
///     link stair ground 3,4 first 3,4 6.5
#ifndef SIGHTLINE_STOREYS_H
#define SIGHTLINE_STOREYS_H

#include "sightline/geometry.h"

#ifdef __cplusplus
extern "C" {
#endif

/// No storey (sl_building_find).
#define SL_NO_STOREY SIZE_MAX

/// A storey of a building.
typedef struct sl_storey {
    char *name;
    char *path;    ///< of its plan, as it can be opened
    uint32_t line; ///< of the building's file
} sl_storey;

/// Two places of which one leads to the other.
typedef struct sl_storey_link {
    char *name;
    size_t storeys[2];
    sl_point places[2]; ///< by end, in the coordinates of its storey
    double length;      ///< of the way between them, in the unit of the plans; 0 or more
    uint32_t line;
} sl_storey_link;

/// Zeroed, it is empty.
typedef struct sl_building {
    sl_storey *storeys;
    size_t storey_count, storey_room;
    sl_storey_link *links;
    size_t link_count, link_room;
} sl_building;

/// Reads a building. Plans are not opened; their paths are relative to the folder of `path`.
/// Names are words without : , " and \. SL_BAD_INPUT with file and line on anything unknown, a name
/// that is there already or is not there yet, a link from a place to itself, and a building without
/// a storey; SL_BAD_ARGUMENT for no such file; SL_IO, SL_NO_MEMORY. `out` is untouched on failure.
SL_API sl_status sl_building_read(sl_context *context, const char *path, sl_building *out);
/// The same from memory.
SL_API sl_status sl_building_parse(sl_context *context, const char *path, const char *text,
                                   size_t size, sl_building *out);
SL_API void sl_building_destroy(sl_context *context, sl_building *building); ///< and zeroes it

/// The number of a storey by its name, of `length` bytes; SL_NO_STOREY for none.
SL_API size_t sl_building_find(const sl_building *building, const char *name, size_t length);

#ifdef __cplusplus
}
#endif

#endif
