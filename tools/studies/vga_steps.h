/// The plan of `sightline vga` by steps, where some walls stop steps and not sight, or sight and
/// not steps: a low wall, a table, a curtain.
#ifndef VGA_STEPS_H
#define VGA_STEPS_H

#include "inputs/inputs.h"
#include "sightline/query.h"
#include "sightline/vga.h"

/// Zeroed, it is empty. `outline` is NULL where steps go as sight does.
typedef struct vga_steps {
    sl_baked baked;
    sl_query *query;
    const sl_outline *outline;
    sl_vga_graph graph;
} vga_steps;

/// Makes the space of steps of a map that was read as one of sight, if both differ. `doors` as for
/// the other space.
sl_status vga_steps_make(sl_context *context, const sl_baked *sight, const door_choice *doors,
                         vga_steps *out);
void vga_steps_destroy(sl_context *context, vga_steps *steps);

/// Joins the points between which one steps straight. With `sights`: that see each other, too.
sl_status vga_steps_connect(sl_context *context, const vga_steps *steps, const sl_vga_grid *grid,
                            const sl_vga_graph *sights, unsigned threads, sl_vga_graph *out);

#endif
