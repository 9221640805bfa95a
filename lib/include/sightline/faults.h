/// Faults of a map, or what looks like one: leaks to the outside, gaps between walls, overlaps,
/// crossings, thin cells, rooms that no start reaches, and what lies far away from the rest.
#ifndef SIGHTLINE_FAULTS_H
#define SIGHTLINE_FAULTS_H

#include "sightline/space.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What may be wrong with a map.
typedef enum sl_fault_kind {
    SL_FAULT_LEAK,        ///< an opening through which a start leads to the map's border
    SL_FAULT_GAP,         ///< the end of a wall is near another wall, with nothing between
    SL_FAULT_OVERLAP,     ///< two walls share a piece
    SL_FAULT_CROSSING,    ///< two walls cross; this may be intended
    SL_FAULT_THIN,        ///< a cell is thinner than the limit
    SL_FAULT_UNREACHABLE, ///< no way leads from a start to these cells
    SL_FAULT_KINDS,
} sl_fault_kind;

/// "leak", "gap", "overlap", "crossing", "thin", "unreachable".
SL_API const char *sl_fault_name(sl_fault_kind kind);

/// One fault, and where it is.
typedef struct sl_fault {
    sl_fault_kind kind;
    /// Leak: the opening, from end to end. Gap: from the wall's end to the other wall. Overlap: the
    /// shared piece. Crossing: its point, twice. Thin cell: from a corner to the opposite edge.
    /// Unreachable room: the middle of its largest cell, twice.
    sl_segment at;
    /// Leak, gap: its width. Overlap: the length of the piece.
    /// Crossing: 0. Thin cell: its width. Unreachable room: its area.
    double size;
    /// Gap, overlap, crossing: the map's walls. Leak: those at its two ends. UINT32_MAX for none,
    /// as at a mirror.
    uint32_t walls[2];
    uint32_t cell;  ///< the thin cell, the room's largest, one at the leak; else SL_NO_CELL
    uint32_t cells; ///< the number of cells of the room; else 0
    bool stays;     ///< a gap or leak that sl_map_mend leaves: it needs a decision
    /// The way of a leak: points[first_point .. first_point + point_count), from the start through
    /// the middle of the leak to the border. It goes through no wall.
    uint32_t first_point, point_count;
} sl_fault;

/// Zeroed, it is empty. Faults are sorted by kind. Leaks, gaps and thin cells have the narrowest
/// first; overlaps and rooms the largest.
typedef struct sl_faults {
    sl_fault *items;
    sl_point *points;
    uint32_t count, point_count;
    uint32_t counts[SL_FAULT_KINDS];
    bool has_starts; ///< without a start, leaks and unreachable rooms are not looked for
    /// Gaps of the map as read that are no faults, as cleaning joins ends up to `weld` apart.
    uint32_t welded;
    double weld;
    uint32_t leaks_left; ///< leaks that sl_map_mend leaves, some of them perhaps at other places
} sl_faults;

SL_API void sl_faults_destroy(sl_context *context, sl_faults *faults); ///< and zeroes it

/// Zeroed: the usual.
typedef struct sl_faults_options {
    double gap;                    ///< the largest width of a gap; 0 for sl_usual_gap
    double thin;                   ///< cells below this width are thin; 0 for the same
    const sl_clean_options *clean; ///< how the map was cleaned: what it welds is no gap, overlap or
                                   ///< crossing; NULL for the default
} sl_faults_options;

/// The width below which an opening is hardly meant: 1/1000 of the map's diagonal; at most 1/8 of
/// the median length of walls, rounded down to a power of two. So large maps keep their doorways.
SL_API double sl_usual_gap(const sl_map *map);

/// Finds all faults. `map` is as read, not cleaned, so that walls keep their lines; `space` was
/// made from it. Gaps and leaks are those of the clean map, overlaps and crossings those of the map
/// as read. Whether walls touch, cross or overlap is exact; widths are rounded. Reports stage
/// "check". Time about O(n log n) for maps whose walls are short against the map, wherever they
/// lie.
///
/// Where more than two walls share a piece or cross at one place, not all pairs are listed, but
/// each wall with one that it shares most with, or with the first that crosses there.
///
/// The leaks of a room with a start are openings that would part it from the outside if all of them
/// were closed: each is the narrowest place of a way out. Holes in walls along the border are leaks
/// as well, wherever the start leads to them. The first start of a room counts.
SL_API sl_status sl_find_faults(sl_context *context, const sl_map *map, const sl_space *space,
                                const sl_faults_options *options, sl_faults *out);

/// A wall, or another thing of a map, that lies far away from the rest of it.
typedef struct sl_stray {
    sl_point at;     ///< the point of it that is farthest away
    double distance; ///< from there to the rest
    uint32_t line;   ///< its line; 0 for none
    uint32_t wall;   ///< UINT32_MAX for what is no wall
} sl_stray;

/// Zeroed, it is empty.
typedef struct sl_strays {
    sl_stray *items; ///< walls first, in the order of the map
    uint32_t count;
    sl_box rest; ///< the box around all that is not stray
} sl_strays;

SL_API void sl_strays_destroy(sl_context *context, sl_strays *strays); ///< and zeroes it

/// Finds what lies farther from the rest than 20 times the size of the rest, if that is at most a
/// quarter of the map's points. It is often a slip, and pictures show the rest as a dot. `map` is
/// as read. Time O(n log n).
SL_API sl_status sl_find_strays(sl_context *context, const sl_map *map, sl_strays *out);

/// Finds a tolerance for sl_map_clean that closes the gaps of rounding in a map and no others.
/// `map` is as read. *weld is 0 if there is none: no gaps, or no clear step between their widths
/// and what is meant. Time about that of sl_find_faults.
SL_API sl_status sl_suggest_weld(sl_context *context, const sl_map *map, double *weld);

/// Shares of the area of a space: 0 to 1, together 1.
typedef struct sl_ground_shares {
    double inside, outside, solid;
} sl_ground_shares;

/// The shares of a space's inside, outside and solid ground.
SL_API sl_ground_shares sl_space_ground(const sl_space *space);

/// How much of the area among the walls they enclose: the share that is inside, of all that is not
/// solid in the convex hull of the walls. It does not depend on how the plan is turned, but for
/// rounding. Solid ground beyond the hull counts as if it were outside there. The corners of the
/// hull are exact. Time O(n log n).
SL_API sl_status sl_space_enclosed(sl_context *context, const sl_space *space, double *share);

/// Whether it is in doubt what is inside.
typedef enum sl_inside {
    SL_INSIDE_SURE,
    SL_INSIDE_LEAKS, ///< a start leads to the border, where no wall is
    /// There is no start, and sl_space_enclosed is under a half, or nearly nothing is inside.
    SL_INSIDE_SMALL,
    /// Rooms that no start reaches have more area than those that one reaches, or starts reach
    /// nearly nothing. What lies around all rooms of a map with solid ground is none of them.
    SL_INSIDE_FEW,
    SL_INSIDE_NONE, ///< all is solid ground
    /// There is no start, and an opening is a little wider than entrances (sl_interior.doubtful):
    /// what is behind it is not inside.
    SL_INSIDE_OPENING,
} sl_inside;

/// Looks at the cells alone, in a time of about O(n): sl_find_faults finds the places. `space` was
/// made from `map`.
SL_API sl_status sl_doubt_inside(sl_context *context, const sl_map *map, const sl_space *space,
                                 sl_inside *out);

/// Room for what sl_say_inside writes.
#define SL_INSIDE_TEXT 320

/// Writes what is inside, for people, where that is not plain: what is in doubt, or which openings
/// count as entrances. A sentence without its capital and full stop; "" where walls or starts say
/// it. As sl_doubt_inside.
SL_API sl_status sl_say_inside(sl_context *context, const sl_map *map, const sl_space *space,
                               char text[SL_INSIDE_TEXT]);

/// Cells that portals join, through doors as they are, and not through what stops steps.
typedef struct sl_sealed_room {
    sl_point at; ///< the middle of its largest cell
    double area;
    double walls; ///< the length of its walls
    bool at_edge; ///< it lies along a twentieth of the map's bounds or touches three sides of them,
                  ///< as the rock or the sea around rooms does; a way out does not
} sl_sealed_room;

/// Rooms that no opening joins with the largest one.
typedef struct sl_sealed {
    uint32_t rooms;         ///< those that count, the largest too
    double share;           ///< of the sealed ones in the area inside: 0 to 1
    sl_sealed_room open;    ///< the largest room
    sl_sealed_room largest; ///< the largest of the sealed ones; an area of 0 for none
    sl_sealed_room within;  ///< the largest of all that are not at the edge; an area of 0 for none
} sl_sealed;

/// Counts the rooms inside that have no opening to the largest one. Thin ones, as the cores of
/// walls are, and very small ones do not count. In a drawing many of them are a sign that doors are
/// drawn shut, or that furniture is among the walls. `space` was made from `map`. Measures are
/// rounded. Time O(n).
SL_API sl_status sl_find_sealed(sl_context *context, const sl_map *map, const sl_space *space,
                                sl_sealed *out);

/// What sl_map_mend did.
typedef struct sl_mend_account {
    size_t moved;        ///< wall ends that moved
    double farthest;     ///< the largest move
    size_t vanished;     ///< walls of no length, which were dropped
    bool ground_dropped; ///< walls had marks of solid ground, which no longer fit
} sl_mend_account;

/// Closes gaps up to the width `gap`: cleans the map and snaps it by turns, until nothing moves. An
/// end snaps to a near end, or onto a near wall. What was closed stays closed. Of the
/// gaps that sl_find_faults lists by the same gap and options, those are left that have `stays`. No
/// leak is left near one without `stays`. The walls of the result are clean, but walls for mirrors
/// are not among them. If an end moves, no wall keeps its ground: rock may have lost its width.
/// `account` may be NULL. On failure the map is still usable, and may be mended in part.
SL_API sl_status sl_map_mend(sl_context *context, sl_map *map, double gap,
                             const sl_clean_options *clean, sl_mend_account *account);

#ifdef __cplusplus
}
#endif

#endif
