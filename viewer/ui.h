/// The few widgets: text, rows, buttons, sliders; and where they are, so that a click finds them.
#ifndef VIEWER_UI_H
#define VIEWER_UI_H

#include "sightline/canvas.h"
#include "sightline/geometry.h"

#include <cairo.h>
#include <stdbool.h>

typedef enum sl_hit_kind {
    SL_HIT_NONE,
    SL_HIT_PANEL,  ///< swallows
    SL_HIT_ACTION, ///< value: of the table of actions
    SL_HIT_METHOD, ///< value: of the culling methods
    SL_HIT_PLAN,   ///< value: which of the plans, from 0
    SL_HIT_DUAL,
    SL_HIT_TIME,   ///< the time line
    SL_HIT_SLIDER, ///< value: of the table of sliders
    SL_HIT_MAP,    ///< value: row of the list that is open
} sl_hit_kind;

typedef struct sl_hit {
    sl_hit_kind kind;
    int value;
    sl_box box; ///< on the page, min at the upper left
} sl_hit;

enum { SL_HITS_MOST = 256 };

/// What a frame is drawn with. Zeroed hits to start a frame.
typedef struct sl_ui {
    cairo_t *cairo;
    sl_palette palette;
    double text; ///< size of plain text, pixels
    sl_point pointer;
    sl_hit hits[SL_HITS_MOST];
    int hit_count;
} sl_ui;

void sl_ui_hit(sl_ui *ui, sl_hit_kind kind, int value, sl_box box);
/// What is at a place, the topmost; kind SL_HIT_NONE for nothing.
sl_hit sl_ui_find(const sl_ui *ui, sl_point at);

bool sl_box_has(sl_box box, sl_point at);
static inline double sl_box_width(sl_box box) {
    return box.max.x - box.min.x;
}
static inline double sl_box_height(sl_box box) {
    return box.max.y - box.min.y;
}

void sl_ui_fill(sl_ui *ui, sl_box box, sl_colour colour);
/// With rounded corners.
void sl_ui_fill_round(sl_ui *ui, sl_box box, double radius, sl_colour colour);
void sl_ui_line(sl_ui *ui, double x0, double y0, double x1, double y1, sl_colour colour);

/// From its left end on the base line; returns its width. `size` in units of plain text.
double sl_ui_text(sl_ui *ui, double x, double y, double size, bool bold, sl_colour colour,
                  const char *text);
/// Ends at x.
void sl_ui_text_right(sl_ui *ui, double x, double y, double size, sl_colour colour,
                      const char *text);
double sl_ui_text_width(sl_ui *ui, double size, bool bold, const char *text);
/// Broken into lines of a width, each `size * 1.4` plain texts high; returns the base line below.
double sl_ui_paragraph(sl_ui *ui, double x, double y, double width, double size, sl_colour colour,
                       const char *text);

/// A button with its action's number; `on` shows it pressed. Returns its right edge.
double sl_ui_button(sl_ui *ui, double x, double y, double height, const char *label, bool on,
                    int action);
/// A row with a box to check, a label and the key at the right.
void sl_ui_check(sl_ui *ui, sl_box row, const char *label, const char *key, bool on, int action);
/// A slider with its value from 0 to 1.
void sl_ui_slider(sl_ui *ui, sl_box track, double value, sl_hit_kind kind, int number);

#endif
