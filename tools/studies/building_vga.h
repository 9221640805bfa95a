/// A visibility graph of a building: the graphs of its storeys, joined by links.
///
/// Which points see each other is found on each storey, in its own coordinates, so it is exact. A
/// link makes one place of two points, as `vga --links` does. Steps and what follows from them go
/// through the building; all other measures are those of the storey.
#ifndef BUILDING_VGA_H
#define BUILDING_VGA_H

#include "inputs/building.h"
#include "studies/vga_run.h"

/// Zeroed, nothing.
typedef struct building_vga {
    sl_building building;
    vga_work *storeys;  ///< by storey; measures are those of the building
    vga_work all;       ///< of all points, storey by storey: the table, the graph and the links
    uint32_t *first;    ///< by storey: its first point; and one more
    const char **names; ///< by point: its storey
} building_vga;

/// From the plans to the measures. SL_BAD_ARGUMENT for what a building does not have; SL_BAD_INPUT
/// with file and line for a link without a point of the grid. The caller destroys `b` after a
/// failure, too.
sl_status building_vga_compute(sl_context *context, vga_plan *plan, building_vga *b);
void building_vga_destroy(sl_context *context, building_vga *b);

/// The storey that --storey names for a picture; NULL is the first one.
sl_status building_vga_storey(sl_context *context, const building_vga *b, const char *name,
                              const vga_work **out);

#endif
