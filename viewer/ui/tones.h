/// What colours mean in the plan: one table for the plan, the legend and the tables of the panel.
#ifndef VIEWER_TONES_H
#define VIEWER_TONES_H

#include "sightline/draw.h"

#include <cairo.h>
#include <stdbool.h>

/// How an area of a tone is filled.
typedef enum tone_pattern {
    PATTERN_SOLID,
    PATTERN_DOTS,
    PATTERN_RISING,
    PATTERN_FALLING,
    PATTERN_CROSS,
    PATTERN_LEVEL,
    PATTERNS,
} tone_pattern;

/// What is shown together: tones of one group can lie side by side.
typedef enum tone_group {
    GROUP_CULLING,
    GROUP_SET,
    GROUP_REGION,
    GROUP_NODES,
    GROUP_WATCH,
    GROUP_PAIR,
    GROUPS,
} tone_group;

typedef enum tone {
    TONE_KEPT,                    ///< by the chosen culling method
    TONE_LOOSER,                  ///< four of them: by looser methods alone
    TONE_ADDED = TONE_LOOSER + 4, ///< by the looser one of two methods
    TONE_KEPT_MIRRORED,
    TONE_SET, ///< the visible set of a cell
    TONE_SET_MIRRORED,
    TONE_REGION,
    TONE_REGION_MIRRORED,
    TONE_NODE_OUT, ///< of a walk without visible sets
    TONE_NODE_INVISIBLE,
    TONE_NODE_PROPAGATED,
    TONE_NODE_VISIBLE,
    TONE_NODE_PARTIAL,
    TONE_WATCH_SEES,
    TONE_WATCH_MUTUAL,
    TONE_WATCH_SEEN,
    TONE_FROM, ///< the two cells of a question
    TONE_TO,
    TONES,
} tone;

typedef struct tone_row {
    const char *label;
    tone_group group;
    tone_pattern pattern;
    unsigned light, dark; ///< colours on the two grounds, 0xrrggbb
    double dash;          ///< of its line, in units of line widths; 0: not dashed
} tone_row;

/// TONES of them.
const tone_row *tone_table(void);

sl_colour tone_colour(bool dark, tone which);

/// Fills the path with a tone. `unit` is the unit of lines, `origin` a place of the page where the
/// pattern is anchored, so that it moves with the map.
void tone_fill(cairo_t *cairo, bool dark, tone which, double unit, sl_point origin);

/// Strokes the path as a line that stands out from every tone: it has a rim in the colour of the
/// page.
void tone_line(cairo_t *cairo, const sl_palette *palette, tone which, double width);

/// The line of a colour of one's own, likewise; dash as in tone_row.
void tone_cased(cairo_t *cairo, const sl_palette *palette, sl_colour colour, double width,
                double dash);

#endif
