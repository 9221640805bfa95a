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
} slider_row;

const slider_row *slider_table(size_t *count);

/// Has the page show the sliders as they are now.
void sliders_show(app_state *app);

#endif
