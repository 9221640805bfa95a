/// What drawings have beside walls, found by its shape: the swings of doors, and lines that stand
/// side by side at one distance (hatching, steps).
#ifndef SL_SYMBOLS_H
#define SL_SYMBOLS_H

#include "io/parts/meaning.h"
#include "sightline/map.h"
#include "sightline/support.h"

/// A door that is drawn open: the leaf goes from the hinge to the tip, the arc on to the latch.
typedef struct sli_swing {
    sl_point hinge, tip, latch;
    double radius;
} sli_swing;

/// Zeroed, it is empty.
typedef struct sli_symbols {
    sl_bits *gone; ///< by wall: it is a part of a symbol
    SL_ARRAY(sli_swing) swings;
    SL_ARRAY(sli_swing) unsure; ///< the latch may be the tip
    size_t doors;               ///< swings, those among them too of which the latch is not clear
    size_t leaves;              ///< walls of them
    size_t lines;               ///< walls of hatching
} sli_symbols;

/// `means` has the meaning of each wall's layer. Hatching is looked for among walls that mean
/// `hatching`; SLI_MEANINGS for nowhere. Swings are looked for among those that mean a door, and
/// without `doors_only` nothing, a wall or a window. `metre` is a metre in the map's unit, 0 for
/// unknown.
sl_status sli_symbols_find(sl_context *context, const sl_map *map, const unsigned char *means,
                           sli_meaning hatching, bool doors_only, double metre, sli_symbols *out);
void sli_symbols_destroy(sl_context *context, sli_symbols *symbols);

// --- points, found by where they are

/// Points by the squares of a grid that they lie in. Zeroed, it is empty.
typedef struct sli_near {
    const sl_point *points;
    double cell;
    size_t *heads, *next;
    size_t mask;
} sli_near;

/// The points must outlive it. `reach` is over 0: how far from a place points are looked for.
sl_status sli_near_make(sl_context *context, const sl_point *points, size_t count, double reach,
                        sli_near *out);
void sli_near_destroy(sl_context *context, sli_near *near);

/// Hands each point within reach of a place to `take`, and some that are farther away; of a crowd
/// some hundred and no more, so that the time is not that of all pairs.
void sli_near_each(const sli_near *near, sl_point at, void *user,
                   void (*take)(void *user, size_t point));

#endif
