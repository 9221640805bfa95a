/// Whether a drawing whose layers say nothing looks like a plan: furniture and symbols, frames of
/// sheets, and drawings in which nothing is closed are told. Nothing is changed.
#ifndef SL_PLAN_DOUBT_H
#define SL_PLAN_DOUBT_H

#include "sightline/map.h"
#include "sightline/support.h"

/// What was found.
typedef struct sli_plan_look {
    size_t walls;
    size_t small; ///< walls in small pieces that touch nothing else and are no pieces of walls
    size_t small_closed; ///< walls of those of them that enclose something
    size_t pieces;       ///< small pieces
    size_t round;        ///< round pieces that touch nothing, and are larger than those
    size_t across;       ///< short walls that cross others
    size_t closed;       ///< how many ways round there are: 0 where nothing is enclosed
    bool crowded;        ///< too many walls, or crowds of them, to look at: all else is 0
    bool frame;          ///< a rectangle holds all else, at a distance, and touches nothing
    bool site;           ///< a ring of any shape does, and half of what is in it is empty
    sl_box others;       ///< what these hold, with some room; no width where they come near it
} sli_plan_look;

/// `metre` is a metre in the map's unit, 0 for unknown; `tolerance` how far apart ends may be that
/// meet. Time O(n log n) where few lines are near each other.
sl_status sli_plan_look_at(sl_context *context, const sl_map *map, double metre, double tolerance,
                           sli_plan_look *out);

/// Takes the small pieces that enclose something, and the round ones, out of the map's walls;
/// windows and doors that touch a piece belong to it, and stay. What was found is as in
/// sli_plan_look_at(); where the map is crowded, nothing is taken out.
sl_status sli_plan_keep_large(sl_context *context, sl_map *map, double metre, sli_plan_look *out);

/// Notes what is doubtful, with what to do. `layers` are those that the user asks for, NULL for
/// none. `alike`: all walls are of one layer and look, so that none can be chosen.
sl_status sli_plan_tell(sl_context *context, const char *file, const char *layers, bool alike,
                        const sl_map *map, double metre, double tolerance);

#endif
