/// What a hand does at the viewer, and a frame that shows it.
#ifndef SL_TEST_HAND_H
#define SL_TEST_HAND_H

#include "viewer_app.h"

/// Lets a step pass, and draws what comes of it.
static inline void show(app_state *app) {
    app_tick(app, 0);
    script_frame(app);
}

static inline void press(app_state *app, const char *key) {
    viewer_press(app, key);
    show(app);
}

/// Presses and releases the left button, on a page.
static inline void click(app_state *app, sl_point page) {
    input_move(app, page);
    input_press(app, BUTTON_LEFT, page);
    input_release(app, page);
    show(app);
}

static inline void click_at(app_state *app, sl_point at) {
    click(app, viewer_on_page(app, at));
}

/// Moves it between two places of the map with the left button down.
static inline void drag(app_state *app, sl_point from, sl_point to) {
    const sl_point a = viewer_on_page(app, from), b = viewer_on_page(app, to);
    input_move(app, a);
    input_press(app, BUTTON_LEFT, a);
    input_move(app, b);
    script_frame(app);
    input_release(app, b);
    show(app);
}

#endif
