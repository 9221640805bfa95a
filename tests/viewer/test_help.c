/// The help: no key is broken within a word.
#include "hand.h"

#include <string.h>

static const char *longest_key(void) {
    const char *longest = "";
    for (int i = 0; i < action_count(); i++) {
        const char *key = action_at(i)->key;
        if (key && strlen(key) > strlen(longest)) longest = key;
    }
    return longest;
}

static void keys_stand_on_one_line(void **state) {
    (void)state;
    static const struct {
        int width, height;
        double scale;
    } windows[] = {{1280, 800, 1}, {1000, 400, 1}, {800, 600, 1}, {1920, 1080, 1.5}};
    app_state *app = viewer_start(true);
    viewer_open(app, MAPS "/office.map");
    for (size_t w = 0; w < sizeof windows / sizeof *windows; w++) {
        app->ui.width = windows[w].width;
        app->ui.height = windows[w].height;
        app->ui.text_scale = windows[w].scale;
        script_frame(app);
        press(app, "?");
        viewer_keep_spots(app);
        input_text(app, longest_key());
        app_tick(app, 0);
        script_frame(app);
        const sl_box box = viewer_spot(app, longest_key());
        assert_true(box.max.y - box.min.y < 1.4 * app->ui.text);
        viewer_drop_spots(app);
        press(app, "Escape");
    }
    viewer_end(app);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(keys_stand_on_one_line)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
