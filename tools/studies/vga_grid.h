/// The points of `sightline vga`: which belong to its grid, which are chosen, and which are linked.
#ifndef VGA_GRID_H
#define VGA_GRID_H

#include "inputs/pipeline.h"
#include "inputs/within.h"
#include "sightline/space.h"
#include "sightline/vga.h"

/// What the options say.
typedef struct vga_grid_plan {
    double step;
    option_list at;
    const char *points; ///< a table: only the points nearest to these
    within_plan within; ///< only points within outlines
    bool border;        ///< only points at the border of the grid
    const char *links;  ///< a table of linked points
} vga_grid_plan;

option_table vga_grid_option_table(vga_grid_plan *plan);

/// Fills the grid and drops the points that are not asked for. `pipeline`: how `within` is read,
/// and where the map is from.
sl_status vga_grid_choose(sl_context *context, const vga_grid_plan *plan,
                          const map_pipeline *pipeline, const sl_map *map,
                          const sl_outline *outline, sl_vga_grid *grid);

/// The points of the grid that an option's places stand for. `from` has an entry for each.
sl_status vga_grid_find(sl_context *context, const sl_vga_grid *grid, const char *option,
                        const option_list *places, uint32_t *from);

/// Links of the grid, from a table of x, y of one point and x, y of the other. The caller frees
/// them (sl_free).
sl_status vga_grid_read_links(sl_context *context, const char *path, const sl_vga_grid *grid,
                              sl_vga_link **links, size_t *count);

#endif
