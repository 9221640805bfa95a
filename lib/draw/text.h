/// Words and numbers on the page.
#ifndef SL_DRAW_TEXT_H
#define SL_DRAW_TEXT_H

#include "draw/palette.h"

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Sets the face and its size, with nothing fitted to pixels, so that pictures of any width and
/// kind are laid out alike.
void sl_text_font(cairo_t *cairo, double size, bool bold);

double sl_text_width(cairo_t *cairo, const char *text);

/// From its left end on the base line.
void sl_text_show(cairo_t *cairo, sl_colour colour, double x, double y, const char *text);

/// As sl_text_show, but no wider than `width`: set smaller, down to two thirds of `size`, then cut.
void sl_text_show_within(cairo_t *cairo, sl_colour colour, double x, double y, double width,
                         double size, bool bold, const char *text);

/// Copies text[0 .. length) as far as there is room, whole characters only.
void sl_text_copy(const char *text, size_t length, char *out, size_t room);

#define SL_COUNT_TEXT 64

/// A count with its thousands set apart, and what is counted: "1 204 cells", "1 cell".
void sl_text_count(uint64_t count, const char *unit, char text[SL_COUNT_TEXT]);

/// A share as a percentage: "23.4 %".
void sl_text_percent(double share, char text[SL_COUNT_TEXT]);

#endif
