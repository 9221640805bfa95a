/// Procedural maps: seeded, and the same bytes on every machine.
#ifndef SIGHTLINE_GENERATE_H
#define SIGHTLINE_GENERATE_H

#include "sightline/map.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    SL_GENERATE_WALLS_LEAST = 100,     ///< to ask for
    SL_GENERATE_WALLS_MOST = 10000000, ///< to ask for, and that a size may give
};

/// Start from sl_generate_options_default().
typedef struct sl_generate_options {
    uint64_t seed;
    uint64_t size;  ///< what the kind says of its size; 0 for its usual
    uint64_t walls; ///< about so many instead, in the order of SL_GENERATE_WALLS_*; 0: not asked
    double open;    ///< tunnels: the share that is open in percent, 0 .. 100; negative: the usual
    double turned;  ///< the plan turned by this angle, degrees counter-clockwise
    bool in_line;   ///< walls in line stay in line to the last bit when the plan is turned
} sl_generate_options;

/// The usual options, as told at each field.
SL_API sl_generate_options sl_generate_options_default(void);

struct sli_plot;

/// A kind of map. What a cell of it sees does not grow with the map: streets, corridors and tunnels
/// are broken, halls have pillars.
typedef struct sl_map_kind {
    const char *name, *what;
    const char *size_is; ///< what its size counts, plural
    uint64_t usual_size;
    bool takes_open; ///< whether it knows the option `open`; else that is refused
    bool is_square;  ///< a size of n gives n x n units, else n
    uint32_t units;  ///< units of a size of 1
    uint32_t least;  ///< the fewest columns and rows of units that it can be laid out in
    sl_status (*lay)(struct sli_plot *plot);
} sl_map_kind;

/// All kinds.
SL_API const sl_map_kind *sl_map_kinds(size_t *count);

/// Fills an empty map; on failure it stays empty. The walls are clean: no two of them cross or
/// overlap, they touch at ends alone. Coordinates are whole numbers, a door is 1 wide; all walls
/// are axial unless the plan is turned. From every room a way leads to a start: in tunnels of which
/// few are open that takes many starts. Pillars and tunnels are solid inside what they enclose, so
/// that cells within are reached from nowhere. How the map was made is kept with it as a note.
///
/// A plan is turned about its middle, in doubles, each step rounded, as most programs do: walls
/// that were in line are so but for rounding. With `in_line` it is turned about the origin, and
/// coordinates are multiples of 2^-16, computed without rounding: what was parallel, or in line,
/// still is, to the last bit. (The angle is then off by at most 2^-17 radians, lengths by as
/// little.) In both, walls that met still meet.
///
/// Asked for a number of walls, the map has about that many: within a tenth from 2000 on.
/// SL_BAD_ARGUMENT for options out of range, with the range. Stage "generate".
SL_API sl_status sl_generate(sl_context *context, const sl_map_kind *kind,
                             const sl_generate_options *options, sl_map *map);

#ifdef __cplusplus
}
#endif

#endif
