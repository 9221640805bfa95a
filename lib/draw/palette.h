/// The colours of a picture, light and dark.
#ifndef SL_DRAW_PALETTE_H
#define SL_DRAW_PALETTE_H

#include <stdbool.h>

typedef struct sl_colour {
    double red, green, blue; ///< sRGB, 0 to 1
} sl_colour;

/// Neighbouring cells get different tones where that many suffice.
#define SL_TONES 4

typedef struct sl_palette {
    sl_colour page, ground, hatch;   ///< paper, what is outside, the lines over it
    sl_colour floor[SL_TONES];       ///< cells
    sl_colour seen[SL_TONES];        ///< cells that the chosen cell sees
    sl_colour source, source_edge;   ///< the chosen cell
    sl_colour doubtful;              ///< cells that only rounding shows or hides
    sl_colour wall, outline, portal; ///< lines
    sl_colour tree, start, path, door, glass, object;
    sl_colour mirrored;   ///< what is seen by mirror
    sl_colour ink, faint; ///< text
    bool dark;
} sl_palette;

sl_palette sl_palette_make(bool dark);

/// A colour between two, in sRGB: `share` 0 gives a, 1 gives b.
sl_colour sl_colour_mix(sl_colour a, sl_colour b, double share);

/// The heat map's ramp, `value` from 0 to 1. Its lightness changes evenly and one way only, so that
/// the order holds for every eye and in grey print.
sl_colour sl_palette_ramp(bool dark, double value);

#endif
