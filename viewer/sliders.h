/// The sliders of the panel: one table.
#ifndef VIEWER_SLIDERS_H
#define VIEWER_SLIDERS_H

#include "app.h"

enum { SL_SLIDER_TEXT = 32 };

typedef struct sl_slider {
    const char *label;
    bool (*shown)(const sl_app *app);
    double (*share)(const sl_app *app);                         ///< where it stands, 0 to 1
    void (*text)(const sl_app *app, char text[SL_SLIDER_TEXT]); ///< its value
    void (*set)(sl_app *app, double share);
    /// When the pointer takes hold of it, and when it lets go; NULL for nothing.
    void (*begin)(sl_app *app);
    void (*end)(sl_app *app);
} sl_slider;

const sl_slider *sl_sliders(size_t *count);

#endif
