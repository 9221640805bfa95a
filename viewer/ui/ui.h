/// The widgets: text, rows, buttons, sliders. Each registers its place, so that a click finds it.
#ifndef VIEWER_UI_H
#define VIEWER_UI_H

#include "sightline/draw.h"
#include "sightline/geometry.h"
#include "sightline/support.h"
#include "ui/text_field.h"

#include <cairo.h>
#include <stdbool.h>

typedef enum hit_kind {
    HIT_NONE,
    HIT_PANEL,  ///< swallows; value: of ui_panels
    HIT_ACTION, ///< value: of the table of actions
    HIT_METHOD, ///< value: of the culling methods
    HIT_PLAN,   ///< value: which of the plans, from 0
    HIT_DUAL,
    HIT_TIME,    ///< the time line
    HIT_SLIDER,  ///< value: of the table of sliders
    HIT_VALUE,   ///< the value of a slider that can be typed; value: likewise
    HIT_DIALOG,  ///< value: the number of a widget, and 256 times (a row of it + 1)
    HIT_FIELD,   ///< a text field; value: chosen by its owner
    HIT_SCROLL,  ///< value: of ui_scrolls
    HIT_BAR,     ///< the bar beside a scroll area; value: likewise
    HIT_EDGE,    ///< a border that can be dragged; value: of ui_edges
    HIT_SUBJECT, ///< value: of the lesson's subjects
    HIT_END,     ///< value: a portal end of the lesson
    HIT_CAMERA,  ///< value: a camera of the table
    HIT_SPOT,    ///< value: a blind spot
    HIT_HEAD,    ///< value: a column of the table
    HIT_ROW,     ///< value: a row of it
    HIT_MEASURE, ///< value: a measure of the tool at hand
} hit_kind;

typedef struct hit_area {
    hit_kind kind;
    int value;
    sl_box box;  ///< on the page, min at the upper left
    sl_box clip; ///< the part of the page where it is shown
} hit_area;

enum { HITS_MOST = 512, SPOTS_MOST = 512, UI_TIP_TEXT = 320 };

/// PANEL_SHEET: all beside a sheet over all, which shuts it.
enum ui_panels { PANEL_PLAIN, PANEL_SHEET, PANEL_STATUS };

/// Areas that scroll. Each keeps its place from frame to frame.
enum ui_scrolls {
    SCROLL_SIDE,
    SCROLL_HELP,
    SCROLL_LIST,
    SCROLL_EFFECTS,
    SCROLL_TIME,
    SCROLL_PROGRAM,
    SCROLL_DIALOG,
    SCROLL_TABLE,
    SCROLLS
};

/// Borders between panels.
enum ui_edges { EDGE_SIDE, EDGE_BELOW, EDGES };

typedef struct ui_scroll {
    double at;           ///< pixels of the contents above the area
    double room, length; ///< of the area and of its contents, as drawn last
} ui_scroll;

/// The widget that keys act on: the `copy`-th one of that kind and value in a frame, from 0.
typedef struct ui_focus {
    hit_kind kind;
    int value, copy;
} ui_focus;

/// A text that was drawn, and the panel that it belongs to.
typedef struct text_spot {
    sl_box box, area;
    char text[48];
} text_spot;

/// An action, as buttons, rows and the help show it.
typedef struct ui_action {
    const char *name;  ///< for scripts: "fit"
    const char *key;   ///< "F", "Ctrl+Z", "Left"; NULL for none
    const char *label; ///< on its button
    const char *help;
    bool on;   ///< it is a switch, and is switched on
    bool held; ///< it lasts while its key is down
} ui_action;

/// A slider of the panel.
typedef struct ui_slider_row {
    const char *label, *help;
    bool shown, typed; ///< its value can be typed
    double share;      ///< where it stands, 0 to 1
    char text[32];     ///< its value
} ui_slider_row;

enum { ACTIONS_MOST = 160, SLIDERS_MOST = 16 };

/// The page and its widgets: what a frame is drawn with, panels, messages. A frame starts without
/// hits.
typedef struct ui_state {
    cairo_t *cairo;
    sl_palette palette;
    double text; ///< size of plain text, pixels
    sl_point pointer;
    hit_area over; ///< under the pointer, in the frame before
    hit_area hits[HITS_MOST];
    int hit_count;

    int width, height;               ///< of the window, pixels
    int window_width, window_height; ///< the same, without fullscreen: what is remembered
    double text_scale;               ///< chosen by the user
    double density;                  ///< of the screen: pixels where a common one has 1
    bool dark;
    bool steady; ///< under a script: no clock shows, nothing is remembered
    bool fullscreen;
    bool presents; ///< for a projector: large text, strong lines, no panel at the right
    bool legend;   ///< over the plan, where there is no panel
    bool legend_over, legend_folded; ///< in a presentation: over the map too; a button now
    bool side_panel, first_person, accounts, effects, program, table, help; ///< panels shown
    bool looks_beside; ///< the first person stands beside the plan, not below it
    char message[512]; ///< the last thing to say
    bool message_is_error, message_is_working;
    double message_seconds; ///< for which it has been there
    double frame_seconds;   ///< smoothed; shown in the corner unless steady

    double edges[EDGES]; ///< sizes of panels that were dragged: side, plain texts; below, a share
                         ///< of the window; 0: the usual ones
    sl_box area, clip;   ///< the panel that is drawn, and what of it is shown
    ui_scroll scrolls[SCROLLS];
    int scrolling; ///< the scroll area that is drawn; -1: none
    ui_focus focus;
    int copies;               ///< of the focused widget met in this frame
    bool reveal;              ///< scroll to the focused widget
    text_field *field;        ///< that typing goes to; NULL: none
    const text_field *number; ///< where it is this one, it types the value of `typed_slider`
    int typed_slider;
    bool field_mutes;  ///< the key that opened it is not typed into it
    text_field filter; ///< of the help
    hit_area hovered;  ///< what a tooltip would be about, and for how long the pointer rests there
    double hover_seconds;
    bool hover_is_focus;
    int bar_rows, time_lines, time_rows; ///< of buttons; of the lesson's sentence and its buttons

    ui_action actions[ACTIONS_MOST]; ///< these two: filled in by the app for each frame
    ui_slider_row sliders[SLIDERS_MOST];
    int action_count, slider_count;

    text_spot *spots; ///< NULL: texts are not kept
    int spot_count;
} ui_state;

/// The factor by which lines and marks are larger than at a desk.
static inline double ui_strength(const ui_state *ui) {
    return ui->presents ? 1.7 : 1;
}
/// The factor by which lines and marks are larger than usual. It does not follow the text.
static inline double ui_scale(const ui_state *ui) {
    return ui->density * ui_strength(ui);
}
/// The size of plain text, pixels.
static inline double ui_text_size(const ui_state *ui) {
    const double most = ui->text_scale > 3 ? ui->text_scale : 3;
    const double larger = 1.6 * ui->text_scale < most ? 1.6 * ui->text_scale : most;
    return 13 * ui->density * (ui->presents ? larger : ui->text_scale);
}

/// Whether there is a panel at the right: in a presentation the plan has the window to itself, but
/// for what was opened since.
static inline bool ui_has_panel(const ui_state *ui) {
    return ui->side_panel && !ui->presents;
}

/// Opens the help, with nothing searched for, and shuts it.
void ui_open_help(ui_state *ui);
void ui_shut_help(ui_state *ui);

/// Writes a name as words: '_' becomes a space.
void ui_spaces(char *text);

/// The number of an action; -1 for an unknown name.
int ui_action_find(const ui_state *ui, const char *name);

/// Begins a frame: no hits, no clip.
void ui_begin(ui_state *ui);

/// Shows a message in the status line.
void ui_say(ui_state *ui, bool error, const char *format, ...) SL_PRINTF(3, 4);

/// Shows the message of a failure; nothing for SL_OK, and where one was told to stop.
void ui_report(ui_state *ui, const sl_context *context, sl_status status);

/// The same for work that goes on: its end is to say something else.
void ui_say_working(ui_state *ui, const char *format, ...) SL_PRINTF(2, 3);

/// A place that a click finds. It is cut to what is shown of the area.
void ui_hit(ui_state *ui, hit_kind kind, int value, sl_box box);
/// The same, and marks it where it has the focus. For widgets that are drawn elsewhere.
void ui_hit_focus(ui_state *ui, hit_kind kind, int value, sl_box box);
/// Whether the widget that was registered last has the focus; and its mark.
bool ui_has_focus(const ui_state *ui);
void ui_mark_focus(ui_state *ui, sl_box box);
/// The topmost thing at a place; kind HIT_NONE for nothing.
hit_area ui_find(const ui_state *ui, sl_point at);

bool box_has(sl_box box, sl_point at);
static inline double box_width(sl_box box) {
    return box.max.x - box.min.x;
}
static inline double box_height(sl_box box) {
    return box.max.y - box.min.y;
}

static inline sl_point box_middle(sl_box box) {
    return (sl_point){(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2};
}

// --- shapes and text

void ui_fill(ui_state *ui, sl_box box, sl_colour colour);
/// With rounded corners.
void ui_fill_round(ui_state *ui, sl_box box, double radius, sl_colour colour);
/// A line inside the border of a box.
void ui_outline(ui_state *ui, sl_box box, double width, sl_colour colour);
void ui_line(ui_state *ui, double x0, double y0, double x1, double y1, sl_colour colour);

/// Draws text from the left end of its base line; returns its width. `size` in units of plain text.
double ui_text(ui_state *ui, double x, double y, double size, bool bold, sl_colour colour,
               const char *text);
/// The same, ending at x.
void ui_text_right(ui_state *ui, double x, double y, double size, sl_colour colour,
                   const char *text);
/// The same from the left end, no wider than `width`: set smaller, down to two thirds, then cut.
void ui_text_within(ui_state *ui, double x, double y, double width, double size, sl_colour colour,
                    const char *text);
double ui_text_width(ui_state *ui, double size, bool bold, const char *text);
/// Breaks text into lines of a width, each `size * 1.4` plain texts high; returns the base line
/// below.
double ui_paragraph(ui_state *ui, double x, double y, double width, double size, sl_colour colour,
                    const char *text);
/// The same in bold or not; and its height alone.
double ui_lines(ui_state *ui, double x, double y, double width, double size, bool bold,
                sl_colour colour, const char *text);
double ui_lines_height(ui_state *ui, double width, double size, bool bold, const char *text);

/// A text that does not fit its panel, or lies on another one; NULL: all texts fit. Only where
/// `spots` are kept.
const char *ui_misfit(const ui_state *ui, char text[160]);

// --- areas

/// Fills a panel, and begins its area: texts belong into it, and nothing is shown beside it. Every
/// begin needs its ui_end_area.
void ui_begin_area(ui_state *ui, sl_box box);
void ui_end_area(ui_state *ui);

/// Begins an area that scrolls, by the wheel or its bar; `number` is of ui_scrolls. Returns where
/// its contents begin. They may be `box` wide but for ui_bar_width at the right.
double ui_begin_scroll(ui_state *ui, int number, sl_box box);
/// Ends it; its contents reached to `bottom`.
void ui_end_scroll(ui_state *ui, sl_box box, double bottom);
double ui_bar_width(const ui_state *ui);
/// Scrolls by pixels, within its contents.
void ui_scroll_by(ui_scroll *scroll, double by);
/// The scroll area at a place; -1: none.
int ui_scroll_at(const ui_state *ui, sl_point at);

/// A sheet over all, of that size or as large as the window allows, with its title. Its contents
/// begin at `top`. A click beside it finds PANEL_SHEET. Keys move among its widgets
/// alone. Ends with ui_end_area.
sl_box ui_begin_sheet(ui_state *ui, double width, double height, const char *title, double *top);

// --- widgets

/// A button with the number of its action; `on` draws it pressed. Returns its right edge.
double ui_button(ui_state *ui, double x, double y, double height, const char *label, bool on,
                 int action);
double ui_button_width(ui_state *ui, const char *label);
/// A row with a check box, a label, and the key at the right. The label may take several lines.
/// Returns the lower edge.
double ui_check(ui_state *ui, sl_box row, const char *label, const char *key, bool on, int action);
/// A slider with its value from 0 to 1.
void ui_slider(ui_state *ui, sl_box track, double value, hit_kind kind, int number);
/// Its value for a place over its box.
double ui_slider_at(const ui_state *ui, sl_box box, sl_point at);
/// Whether what is typed is the value of a slider.
static inline bool ui_types_value(const ui_state *ui) {
    return ui->field && ui->field == ui->number;
}

/// A text field with its cursor, where typing goes to it; `empty` stands there before (NULL:
/// nothing). A click places the cursor. The caller finds the clicks.
void ui_text_field(ui_state *ui, sl_box box, text_field *field, const char *empty, bool typed);

/// A border that can be dragged: marked under the pointer and where it has the focus.
void ui_edge(ui_state *ui, int number, sl_box box);

// --- focus and tooltips

/// Moves on to the next widget, or back.
void ui_focus_move(ui_state *ui, bool back);
/// The focused widget of the last frame; kind HIT_NONE: none.
hit_area ui_focused(const ui_state *ui);

/// Lets time pass for the tooltip.
void ui_tick(ui_state *ui, double seconds);
/// What a tooltip is about now; kind HIT_NONE: none is shown.
hit_area ui_tip_of(const ui_state *ui);
/// Draws a tooltip beside a box.
void ui_tip(ui_state *ui, sl_box beside, const char *text);

#endif
