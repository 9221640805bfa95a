/// What is wrong with a map, or looks so: leaks to the outside, gaps between walls, overlaps,
/// crossings, thin cells, rooms that nothing leads to.
#ifndef SIGHTLINE_FAULTS_H
#define SIGHTLINE_FAULTS_H

#include "sightline/space.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What may be wrong with a map.
typedef enum sl_fault_kind {
    SL_FAULT_LEAK,        ///< a way from a start to the map's border
    SL_FAULT_GAP,         ///< a wall's end near another wall, and nothing between
    SL_FAULT_OVERLAP,     ///< two walls share a piece
    SL_FAULT_CROSSING,    ///< two walls cross; no mistake where walls are drawn so
    SL_FAULT_THIN,        ///< a cell thinner than asked for
    SL_FAULT_UNREACHABLE, ///< cells that no way leads to from any start
    SL_FAULT_KINDS,
} sl_fault_kind;

/// "leak", "gap", "overlap", "crossing", "thin", "unreachable".
SL_API const char *sl_fault_name(sl_fault_kind kind);

/// One fault, and where it is.
typedef struct sl_fault {
    sl_fault_kind kind;
    /// A leak's narrowest portal; the gap from the wall's end to the other wall; the piece that two
    /// walls share; where they cross (both points the same); a thin cell's corner and the edge
    /// opposite; for an unreachable room its largest cell's middle (both points the same).
    sl_segment at;
    /// The narrowest portal's width, the gap's, the shared piece's length, 0, the cell's width, the
    /// room's area.
    double size;
    uint32_t walls[2]; ///< of the map's walls, for gaps, overlaps and crossings; else UINT32_MAX
    uint32_t cell;     ///< the thin one, the room's largest, the leak's last; else SL_NO_CELL
    uint32_t cells;    ///< how many the room has, or the leak passes; else 0
    /// A leak's way: points[first_point .. first_point + point_count), from the start on, through
    /// the middles of portals, to the border.
    uint32_t first_point, point_count;
} sl_fault;

/// Zeroed, it is empty. Faults are ordered by kind; leaks, gaps and thin cells the narrowest first,
/// overlaps and rooms the largest first.
typedef struct sl_faults {
    sl_fault *items;
    sl_point *points;
    uint32_t count, point_count;
    uint32_t counts[SL_FAULT_KINDS];
    bool has_starts; ///< without a start leaks cannot be told, nor what is unreachable
} sl_faults;

SL_API void sl_faults_destroy(sl_context *context, sl_faults *faults); ///< and zeroes it

/// Zeroed: the usual.
typedef struct sl_faults_options {
    double gap;  ///< gaps up to this width are told; 0 for a thousandth of the map's diagonal
    double thin; ///< cells thinner than this are told; 0 for the same
} sl_faults_options;

/// Finds all faults. `map` is as it was read, not cleaned, so that walls keep their lines; `space`
/// was made from it. Whether walls touch, cross or overlap is exact; widths are rounded. A leak is
/// told once a start: the way that keeps widest. Stage "check". Time about O(n log n) for maps
/// whose walls are short against the map.
SL_API sl_status sl_find_faults(sl_context *context, const sl_map *map, const sl_space *space,
                                const sl_faults_options *options, sl_faults *out);

/// What sl_map_snap did.
typedef struct sl_snap_account {
    size_t moved;    ///< wall ends that were moved
    double farthest; ///< how far at most
    size_t vanished; ///< walls left without length, and dropped
} sl_snap_account;

/// Closes gaps up to `gap` wide: wall ends so near to each other become one point (the one that
/// most walls have, else the first), and then an end so near to a wall is put onto it: where both
/// are axial along their own lines, and else at the nearest point, rounded. An end that touches a
/// wall already is left alone. In neither step
/// does an end move farther than `gap`. Walls only; cells of the map's own, which no longer go with
/// them, are dropped.
SL_API sl_status sl_map_snap(sl_context *context, sl_map *map, double gap,
                             sl_snap_account *account);

#ifdef __cplusplus
}
#endif

#endif
