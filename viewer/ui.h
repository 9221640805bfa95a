/// The widgets: text, rows, buttons, sliders. Each registers its place, so that a click finds it.
#ifndef VIEWER_UI_H
#define VIEWER_UI_H

#include "sightline/canvas.h"
#include "sightline/geometry.h"

#include <cairo.h>
#include <stdbool.h>

typedef enum hit_kind {
    HIT_NONE,
    HIT_PANEL,  ///< swallows
    HIT_ACTION, ///< value: of the table of actions
    HIT_METHOD, ///< value: of the culling methods
    HIT_PLAN,   ///< value: which of the plans, from 0
    HIT_DUAL,
    HIT_TIME,   ///< the time line
    HIT_SLIDER, ///< value: of the table of sliders
    HIT_DIALOG, ///< value: the number of a widget, and 256 times (a row of it + 1)
} hit_kind;

typedef struct hit_area {
    hit_kind kind;
    int value;
    sl_box box; ///< on the page, min at the upper left
} hit_area;

enum { HITS_MOST = 256 };

/// The page and its widgets: what a frame is drawn with, panels, messages. A frame starts without
/// hits.
typedef struct ui_state {
    cairo_t *cairo;
    sl_palette palette;
    double text; ///< size of plain text, pixels
    sl_point pointer;
    hit_area hits[HITS_MOST];
    int hit_count;

    int width, height; ///< of the window, pixels
    double text_scale; ///< chosen by the user
    double density;    ///< of the screen: pixels where a common one has 1
    bool dark;
    bool side_panel, first_person, accounts, effects, help; ///< panels shown
    char message[512];                                      ///< the last thing to say
    bool message_is_error, message_is_working;
    double frame_seconds; ///< smoothed; shown in the corner unless steady
} ui_state;

/// The factor by which lines and marks are larger than usual.
static inline double ui_scale(const ui_state *ui) {
    return ui->text_scale * ui->density;
}
/// The size of plain text, pixels.
static inline double ui_text_size(const ui_state *ui) {
    return 13 * ui_scale(ui);
}

/// Shows a message in the status line.
void ui_say(ui_state *ui, bool error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/// The same for work that goes on: its end is to say something else.
void ui_say_working(ui_state *ui, const char *format, ...) __attribute__((format(printf, 2, 3)));

void ui_hit(ui_state *ui, hit_kind kind, int value, sl_box box);
/// The topmost thing at a place; kind HIT_NONE for nothing.
hit_area ui_find(const ui_state *ui, sl_point at);

bool box_has(sl_box box, sl_point at);
static inline double box_width(sl_box box) {
    return box.max.x - box.min.x;
}
static inline double box_height(sl_box box) {
    return box.max.y - box.min.y;
}

void ui_fill(ui_state *ui, sl_box box, sl_colour colour);
/// With rounded corners.
void ui_fill_round(ui_state *ui, sl_box box, double radius, sl_colour colour);
void ui_line(ui_state *ui, double x0, double y0, double x1, double y1, sl_colour colour);

/// Draws text from the left end of its base line; returns its width. `size` in units of plain text.
double ui_text(ui_state *ui, double x, double y, double size, bool bold, sl_colour colour,
               const char *text);
/// The same, ending at x.
void ui_text_right(ui_state *ui, double x, double y, double size, sl_colour colour,
                   const char *text);
double ui_text_width(ui_state *ui, double size, bool bold, const char *text);
/// Breaks text into lines of a width, each `size * 1.4` plain texts high; returns the base line
/// below.
double ui_paragraph(ui_state *ui, double x, double y, double width, double size, sl_colour colour,
                    const char *text);

/// A button with the number of its action; `on` draws it pressed. Returns its right edge.
double ui_button(ui_state *ui, double x, double y, double height, const char *label, bool on,
                 int action);
/// A row with a check box, a label, and the key at the right.
void ui_check(ui_state *ui, sl_box row, const char *label, const char *key, bool on, int action);
/// A slider with its value from 0 to 1.
void ui_slider(ui_state *ui, sl_box track, double value, hit_kind kind, int number);

#endif
