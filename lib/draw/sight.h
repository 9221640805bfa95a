/// What is drawn over the plan while one looks: sets of cells, the visible region, the cone, a stab
/// tree as it grows, a portal sequence with its lines. Files and windows share it.
#ifndef SL_DRAW_SIGHT_H
#define SL_DRAW_SIGHT_H

#include "draw/canvas.h"
#include "draw/palette.h"
#include "sightline/region.h"
#include "sightline/space.h"
#include "sightline/stab.h"

/// Fills the cells of a set (bit c % 64 of word c / 64) that are not in `without` (NULL: none).
void sl_draw_cell_set(cairo_t *cairo, const sl_space *space, const sl_frame *frame,
                      const uint64_t *cells, const uint64_t *without, sl_colour colour,
                      double opacity);

/// Outlines one cell, and fills it where `opacity` is not 0.
void sl_draw_cell(cairo_t *cairo, const sl_space *space, const sl_frame *frame, uint32_t cell,
                  sl_colour colour, double opacity, double width);

void sl_draw_region(cairo_t *cairo, const sl_frame *frame, const sl_region *region,
                    sl_colour colour);

/// A cone about a heading in degrees, `fov` degrees wide, to `reach` on the page; a disc's outline
/// where it is all round.
void sl_draw_cone(cairo_t *cairo, const sl_frame *frame, sl_point eye, double heading, double fov,
                  double reach, sl_colour colour);

/// An eye with its heading.
void sl_draw_eye_mark(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                      sl_point eye, double heading, double radius);

/// Portals of a sequence: left ends as discs, right ends as squares, in the palette's colours for
/// glass and start.
void sl_draw_portal_ends(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                         const sl_portal_ends *portals, uint32_t count, bool last_stops);

/// A straight line over the frame.
void sl_draw_line(cairo_t *cairo, const sl_frame *frame, sl_point a, sl_point b, sl_colour colour,
                  double width);

#endif
