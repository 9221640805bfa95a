/// The table of sliders in the panel.
#ifndef VIEWER_SLIDERS_H
#define VIEWER_SLIDERS_H

#include "app/app.h"

enum { SLIDER_TEXT = sizeof((ui_slider_row *)0)->text };

typedef struct slider_row {
    const char *label;
    bool (*shown)(const app_state *app);
    double (*share)(const app_state *app);                      ///< where it stands, 0 to 1
    void (*text)(const app_state *app, char text[SLIDER_TEXT]); ///< its value
    void (*set)(app_state *app, double share);
    /// Called when the pointer takes hold of it and when it lets go; NULL: nothing.
    void (*begin)(view_state *view);
    void (*end)(view_state *view);
    const char *help;
    /// Sets a value that was typed; false for one that it cannot have. NULL: it is not typed.
    bool (*type)(app_state *app, double value);
} slider_row;

const slider_row *slider_table(size_t *count);

/// Has the value of a slider typed, or that of the next one that is shown (-1).
void slider_type(app_state *app, int number);
/// Takes over what was typed; false, with a message, where that is no value of it.
bool slider_typed(app_state *app);

/// Has the page show the sliders as they are now.
void sliders_show(app_state *app);

#endif
