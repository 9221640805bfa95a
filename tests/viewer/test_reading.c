// The dialog of how a drawing is read, beside the plan: roles of layers, the scale, what is inside,
// openings that are closed, and what is kept of all that for the file.
#include "viewer_app.h"

#include "dialogs/import_dialog.h"
#include "dialogs/question.h"
#include "document/drawings.h"

#include <math.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define LINE(layer, x0, y0, x1, y1)                                                                \
    "0\nLINE\n8\n" layer "\n10\n" #x0 "\n20\n" #y0 "\n11\n" #x1 "\n21\n" #y1 "\n"

/// Two rooms with a gap of 1 between them, and one of 1.5 to the outside, where a wall stands.
static const char house[] =
    "0\nSECTION\n2\nENTITIES\n" LINE("A-WALL", 0, 0, 4, 0) LINE("A-WALL", 5.5, 0, 12, 0)
        LINE("A-WALL", 12, 0, 12, 8) LINE("A-WALL", 12, 8, 0, 8) LINE("A-WALL", 0, 8, 0, 0)
            LINE("A-WALL", 6, 0, 6, 3) LINE("A-WALL", 6, 4, 6, 8) LINE("A-WALL", 13, -2, 14, -2)
                LINE("A-GLAZ", 9, 1, 9, 3) LINE("HEDGE", 2, 5, 4, 5) "0\nENDSEC\n0\nEOF\n";

typedef struct scene {
    char folder[40], path[64];
    app_state *app;
} scene;

static scene open_house(void) {
    scene s = {.folder = "/tmp/sightline-reading-XXXXXX"};
    assert_non_null(mkdtemp(s.folder));
    snprintf(s.path, sizeof s.path, "%s/house.dxf", s.folder);
    viewer_write(s.path, house);
    s.app = viewer_start(true);
    s.app->ui.width = 1024;
    s.app->ui.height = 768;
    viewer_open(s.app, s.path);
    script_frame(s.app);
    return s;
}

static void close_house(scene *s) {
    viewer_end(s->app);
    assert_int_equal(remove(s->path), 0);
    assert_int_equal(rmdir(s->folder), 0);
}

static void frame(app_state *app) {
    for (int i = 0; i < 3; i++) {
        app_tick(app, 0);
        script_frame(app);
    }
}

static void press(app_state *app, const char *key) {
    viewer_press(app, key);
    frame(app);
}

static void type(app_state *app, const char *text) {
    input_text(app, text);
    frame(app);
}

static void click_page(app_state *app, sl_point page) {
    input_move(app, page);
    input_press(app, BUTTON_LEFT, page);
    input_release(app, page);
    frame(app);
}

static void click_map(app_state *app, sl_point at) {
    click_page(app, viewer_on_page(app, at));
}

/// Presses a widget of the dialog: the `number`-th button that was drawn, by its id.
static void click_button(app_state *app, const char *label) {
    click_page(app, box_middle(viewer_spot(app, label)));
}

static size_t marks(const app_state *app) {
    import_mark mark;
    size_t count = 0;
    while (import_mark_at(&app->desk, count, &mark)) count++;
    return count;
}

/// Letters filter, the plan follows each role at once, and Escape puts all back.
static void roles_show_at_once(void **state) {
    (void)state;
    scene s = open_house();
    app_state *app = s.app;
    viewer_keep_spots(app);
    const uint32_t walls = app->document.baked->space.wall_count;
    press(app, "Ctrl+I");
    assert_true(import_is_beside(&app->desk));
    assert_string_equal(app->desk.dialog.title, "How to read house.dxf");
    type(app, "hed");
    click_button(app, "Wall");
    assert_int_equal(app->document.baked->space.wall_count, walls + 1);
    assert_string_equal(app->document.source.options.layers, "HEDGE=wall");
    // The button that was clicked has no focus: what is typed goes on in the filter.
    type(app, "ge w");
    press(app, "Space");
    assert_int_equal(app->desk.dialog.focus[0], IMPORT_TYPES_INTO);
    assert_int_equal(app->document.baked->space.wall_count, walls + 1);
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_IMPORT);
    press(app, "Escape");
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_NONE);
    assert_int_equal(app->document.baked->space.wall_count, walls);
    assert_null(app->document.source.options.layers);
    // Furniture stops no sight, and all that are listed change together.
    press(app, "Ctrl+I");
    type(app, "e");
    click_button(app, "For all layers that are listed");
    click_button(app, "Furniture");
    assert_string_equal(app->document.source.options.layers, "HEDGE=furniture");
    press(app, "Return");
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_NONE);
    assert_int_equal(sl_map_partial_walls(&app->document.map), 2);
    viewer_drop_spots(app);
    close_house(&s);
}

/// A click says what is inside. The opening that leaks is marked, and walled up.
static void leaks_are_closed(void **state) {
    (void)state;
    scene s = open_house();
    app_state *app = s.app;
    import_mark mark;
    viewer_keep_spots(app);
    press(app, "Ctrl+I");
    assert_int_equal(marks(app), 0);
    click_button(app, "Here is inside");
    click_map(app, (sl_point){3, 2});
    assert_int_equal(app->document.map.start_count, 1);
    assert_int_equal(marks(app), 1);
    assert_true(import_mark_at(&app->desk, 0, &mark));
    assert_int_equal(mark.kind, MARK_CHOSEN);
    assert_true(fabs(mark.length - 1.5) < 1e-12);
    const double all = app->document.area;
    // A click on its row shows which one it is, and closes nothing.
    click_button(app, "1.5 at 4, 0");
    click_button(app, "1.5 at 4, 0");
    assert_true(import_mark_at(&app->desk, 0, &mark));
    assert_int_equal(mark.kind, MARK_CHOSEN);
    assert_true(app->document.area == all);
    click_button(app, "Close it");
    assert_true(import_mark_at(&app->desk, 0, &mark));
    assert_int_equal(mark.kind, MARK_CLOSED);
    assert_int_equal(marks(app), 1);
    assert_true(app->document.area < all && fabs(app->document.area - 96) < 1e-9);
    click_button(app, "Open again");
    assert_true(fabs(app->document.area - all) < 1e-9);
    press(app, "Escape");
    assert_int_equal(app->document.map.start_count, 0);
    viewer_drop_spots(app);
    close_house(&s);
}

/// "This line is 6.5 m": two clicks on ends of walls, and all that was said before is in metres.
static void line_is_measured(void **state) {
    (void)state;
    scene s = open_house();
    app_state *app = s.app;
    viewer_keep_spots(app);
    press(app, "Ctrl+I");
    click_button(app, "Here is inside");
    click_map(app, (sl_point){3, 2});
    click_button(app, "Close it");
    click_button(app, "Measure a line");
    click_map(app, (sl_point){5.51, 0.01});
    click_map(app, (sl_point){11.99, 0});
    type(app, "13,0");
    press(app, "Return");
    assert_string_equal(app->document.source.options.unit, "2=m");
    assert_string_equal(app->document.map.unit, "m");
    const sl_box b = sl_map_bounds(&app->document.map);
    assert_true(b.max.x == 28 && b.max.y == 16);
    const sl_point start = app->document.map.starts[0].at;
    assert_true(fabs(start.x - 6) < 0.1 && fabs(start.y - 4) < 0.1);
    assert_int_equal(marks(app), 1);
    assert_true(fabs(app->document.area - 4 * 96) < 1e-9);
    // All of the plan is in view, and the eye in it.
    app_tick(app, 0);
    script_frame(app);
    const sl_box pane = app_layout(app).plan[0];
    const sl_frame shown = camera_frame(&app->view.camera, pane, 1);
    const sl_point low = sl_frame_point(&shown, b.min), high = sl_frame_point(&shown, b.max);
    assert_true(fmin(low.x, high.x) >= pane.min.x && fmax(low.x, high.x) <= pane.max.x);
    assert_true(fmin(low.y, high.y) >= pane.min.y && fmax(low.y, high.y) <= pane.max.y);
    assert_true(fabs(app->view.eye.at.x - 6) < 0.1 && fabs(app->view.eye.at.y - 4) < 0.1);
    // A second one, in feet, is of the file's unit too.
    click_button(app, "Measure a line");
    click_map(app, (sl_point){0, 0});
    click_map(app, (sl_point){0, 16});
    press(app, "Ctrl+A");
    type(app, "80 ft");
    click_button(app, "Set");
    assert_string_equal(app->document.source.options.unit, "10=ft");
    // What is no length is said, and changes nothing.
    click_button(app, "Measure a line");
    click_map(app, (sl_point){0, 0});
    click_map(app, (sl_point){0, 80});
    press(app, "Ctrl+A");
    type(app, "wide");
    press(app, "Return");
    assert_non_null(strstr(app->desk.dialog.problem, "a length is needed"));
    assert_string_equal(app->document.source.options.unit, "10=ft");
    viewer_drop_spots(app);
    close_house(&s);
}

/// A drawing without a unit: the one that is typed is that of the drawing, also once it is changed.
static void unit_is_typed(void **state) {
    (void)state;
    static const char *const units[] = {"m", "ft"};
    scene s = open_house();
    app_state *app = s.app;
    const sl_box b = sl_map_bounds(&app->document.map);
    for (int i = 0; i < 2; i++) {
        press(app, "Ctrl+I");
        for (int k = 0; k < 8; k++) press(app, "Tab");
        press(app, "Ctrl+A");
        type(app, units[i]);
        press(app, "Return");
        assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_NONE);
        assert_string_equal(app->document.map.unit, units[i]);
        assert_true(box_width(sl_map_bounds(&app->document.map)) == box_width(b));
    }
    close_house(&s);
}

static bool has_focus(const app_state *app, const char *label) {
    const dialog_state *d = &app->desk.dialog;
    for (int i = 0; i < d->item_count; i++) {
        if (d->items[i].id != d->focus[d->depth - 1]) continue;
        for (int j = 0; j < app->ui.spot_count; j++)
            if (strcmp(app->ui.spots[j].text, label) == 0 &&
                box_has(d->items[i].box, box_middle(app->ui.spots[j].box)))
                return true;
    }
    return false;
}

/// Presses Tab until the widget with this label has the focus, which Return then presses.
static void tab_to(app_state *app, const char *label) {
    for (int tabs = 0; tabs < 40 && !has_focus(app, label); tabs++) press(app, "Tab");
    assert_true(has_focus(app, label));
}

/// Moves the cursor to a place of the map, by arrows alone.
static void arrows_to(app_state *app, sl_point at) {
    const sl_point page = viewer_on_page(app, at);
    for (int i = 0; i < 2000 && fabs(app->ui.pointer.x - page.x) > 0.5; i++)
        press(app, app->ui.pointer.x < page.x ? "Shift+Right" : "Shift+Left");
    for (int i = 0; i < 2000 && fabs(app->ui.pointer.y - page.y) > 0.5; i++)
        press(app, app->ui.pointer.y < page.y ? "Shift+Down" : "Shift+Up");
    assert_true(hypot(app->ui.pointer.x - page.x, app->ui.pointer.y - page.y) < 1);
}

/// Without a pointer: while a click in the plan is waited for, arrows and Return are for the plan.
static void keys_click_in_the_plan(void **state) {
    (void)state;
    scene s = open_house();
    app_state *app = s.app;
    viewer_keep_spots(app);
    press(app, "Ctrl+I");
    tab_to(app, "Here is inside");
    press(app, "Return");
    assert_int_equal(app->ui.focus.kind, HIT_PLAN); // the cursor is shown
    arrows_to(app, (sl_point){3, 2});
    press(app, "Return");
    assert_int_equal(app->document.map.start_count, 1);
    const sl_point start = app->document.map.starts[0].at;
    assert_true(hypot(start.x - 3, start.y - 2) < 0.1);
    assert_int_equal(app->ui.focus.kind, HIT_NONE);
    press(app, "Shift+Tab"); // Tab goes on from where it was
    assert_true(has_focus(app, "Measure a line"));
    press(app, "Return");
    arrows_to(app, (sl_point){5.5, 0});
    press(app, "Return");
    arrows_to(app, (sl_point){12, 0});
    press(app, "Return");
    type(app, "13 m");
    press(app, "Return");
    assert_string_equal(app->document.source.options.unit, "2=m");
    press(app, "Tab");
    assert_true(has_focus(app, "Here is inside"));
    // Tab leaves the plan, and comes back to it. Escape ends the waiting, and not the dialog.
    tab_to(app, "Measure a line");
    press(app, "Return");
    press(app, "Tab");
    assert_int_equal(app->ui.focus.kind, HIT_NONE);
    press(app, "Shift+Tab");
    assert_int_equal(app->ui.focus.kind, HIT_PLAN);
    press(app, "Escape");
    assert_int_equal(app->ui.focus.kind, HIT_NONE);
    assert_true(viewer_says(app, "Measure a line"));
    assert_true(import_is_beside(&app->desk));
    press(app, "Escape");
    assert_false(import_is_beside(&app->desk));
    viewer_drop_spots(app);
    close_house(&s);
}

/// The panel leaves the plan in sight: one can fit it and read the notes without leaving the panel.
static void plan_is_looked_at(void **state) {
    (void)state;
    scene s = open_house();
    app_state *app = s.app;
    viewer_keep_spots(app);
    press(app, "Ctrl+I");
    const plan_camera fits = app->view.camera;
    view_pan(&app->view, 200, 100);
    press(app, "Ctrl+0");
    assert_true(app->view.camera.middle.x == fits.middle.x && app->view.camera.scale == fits.scale);
    view_pan(&app->view, 200, 100);
    frame(app);
    click_button(app, "Fit");
    assert_true(app->view.camera.middle.x == fits.middle.x);
    assert_true(import_is_beside(&app->desk));
    press(app, "Ctrl+J");
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_QUESTION);
    press(app, "Return");
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_IMPORT);
    // Other actions stay shut out.
    press(app, "Ctrl+5");
    assert_int_equal(app->view.tool, TOOL_ISOVIST);
    viewer_drop_spots(app);
    close_house(&s);
}

/// A hall with a court in it that nothing leads to, and an entrance as wide as a door of 2 m.
static const char court[] = "0\nSECTION\n2\nENTITIES\n" LINE("A", 9, 0, 9, 9) LINE("A", 9, 9, 0, 9)
    LINE("A", 0, 9, 0, 0) LINE("A", 0, 0, 7, 0) LINE("A", 3, 3, 6, 3) LINE("A", 6, 3, 6, 6)
        LINE("A", 6, 6, 3, 6) LINE("A", 3, 6, 3, 3) "0\nENDSEC\n0\nEOF\n";

/// Closed parts are told, and left out by a click; a scale that changes what is inside says so.
static void inside_is_told(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-court-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/court.dxf", folder);
    viewer_write(path, court);
    app_state *app = viewer_start(true);
    app->ui.width = 1024;
    app->ui.height = 768;
    viewer_open(app, path);
    viewer_keep_spots(app);
    press(app, "9");
    press(app, "Ctrl+I");
    assert_true(import_is_beside(&app->desk));
    const double all = app->document.inside_area;
    assert_true(fabs(all - 81) < 1e-9);
    assert_true(viewer_says(app, "1 closed part, the largest of 9 at 4.5, 4.5"));
    click_button(app, "Here is inside");
    click_map(app, (sl_point){1.5, 1.5});
    assert_false(viewer_says(app, "closed part"));
    // An eye in what is outside now goes into the inside; another one stays.
    app->view.eye.at = (sl_point){4.5, 4.5};
    click_button(app, "Here is inside");
    click_map(app, (sl_point){2, 1.5});
    assert_true(fabs(app->view.eye.at.x - 2) < 0.1 && fabs(app->view.eye.at.y - 1.5) < 0.1);
    click_button(app, "Here is inside");
    click_map(app, (sl_point){8, 8});
    assert_true(fabs(app->view.eye.at.x - 2) < 0.1);
    // A long message stands beside the panel, and is not covered by it.
    ui_say(&app->ui, true, "%s",
           "a message that is so long that it takes several lines of the "
           "window, which the panel of the dialog would cover on the right, so that nobody could "
           "read to its "
           "end, where the next step stands");
    frame(app);
    for (int i = 0; i < app->ui.spot_count; i++)
        if (strstr(app->ui.spots[i].text, "a message that is so long"))
            assert_true(app->ui.spots[i].box.max.x <= app_layout(app).side.min.x);
    assert_true(viewer_says(app, "a message that is so long"));
    click_button(app, "Cancel");
    press(app, "Ctrl+I");
    click_button(app, "Measure a line");
    click_map(app, (sl_point){0, 9});
    click_map(app, (sl_point){9, 9});
    type(app, "90 m"); // the opening is 20 m wide now, and no door
    press(app, "Return");
    assert_string_equal(app->document.source.options.unit, "10=m");
    assert_true(fabs(app->document.inside_area - 100 * all) > 1);
    assert_true(viewer_says(app, "The scale changes what is inside: "));
    viewer_drop_spots(app);
    viewer_end(app);
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

/// A choice that cannot be read is told in the dialog, and the plan stays.
static void wrong_choices(void **state) {
    (void)state;
    scene s = open_house();
    app_state *app = s.app;
    const uint32_t walls = app->document.baked->space.wall_count;
    press(app, "Ctrl+I");
    for (int i = 0; i < 8; i++) press(app, "Tab");
    type(app, "ells");
    frame(app);
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_IMPORT);
    assert_non_null(strstr(app->desk.dialog.problem, "there is no unit 'ells'"));
    // All of a long one is there, in lines that stand on nothing else.
    viewer_keep_spots(app);
    type(app, " of the old town of Bern");
    frame(app);
    char misfit[160];
    double high = 0;
    for (int i = 0; i < app->ui.spot_count; i++)
        if (strncmp(app->ui.spots[i].text, app->desk.dialog.problem, 40) == 0)
            high = box_height(app->ui.spots[i].box);
    assert_true(high > 2 * app->ui.text);
    assert_null(ui_misfit(&app->ui, misfit));
    viewer_drop_spots(app);
    assert_int_equal(app->document.baked->space.wall_count, walls);
    // It is not left with a choice that was refused, as if the plan had it.
    press(app, "Return");
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_IMPORT);
    assert_non_null(strstr(app->desk.dialog.problem, "there is no unit 'ells"));
    press(app, "Ctrl+A");
    type(app, "2=m");
    press(app, "Return");
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_NONE);
    close_house(&s);
}

/// What is chosen for a file is there again, and other files keep theirs.
static void choices_are_kept(void **state) {
    (void)state;
    scene s = open_house();
    sl_context *context = s.app->context;
    char config[] = "/tmp/sightline-config-XXXXXX", kept[160], folder[96], other[96];
    assert_non_null(mkdtemp(config));
    assert_int_equal(setenv("XDG_CONFIG_HOME", config, 1), 0);
    snprintf(other, sizeof other, "%s/other.svg", s.folder);
    viewer_write(other, "");
    sl_status status;
    document_source source = {.path = s.path,
                              .options = sl_import_options_default(),
                              .has_start = true,
                              .start = {0.1, -3}};
    document_source second = {.path = other, .options = sl_import_options_default()};
    assert_false(drawing_recall(context, &second, &status));
    source.options.layers = "A b=wall,HEDGE=ignore";
    source.options.unit = "0.3=m";
    source.options.entrance = 1.5;
    assert_ok(context,
              document_source_close(context, &source, (sl_segment){{0.1, 0.2}, {1e-17, 4}}));
    drawing_remember(context, &source);
    drawing_remember(context, &second);
    document_source found = {0};
    const document_source plain = {.path = s.path, .options = sl_import_options_default()};
    assert_ok(context, document_source_copy(context, &plain, &found));
    assert_true(drawing_recall(context, &found, &status));
    assert_ok(context, status);
    assert_true(document_source_same(&source, &found));
    document_source_destroy(context, &found);
    // Said once more, it takes the place of what was said before.
    sl_free(context, source.closed);
    source.closed = NULL;
    source.closed_count = 0;
    source.options.layers = NULL;
    drawing_remember(context, &source);
    assert_ok(context, document_source_copy(context, &plain, &found));
    assert_true(drawing_recall(context, &found, &status));
    assert_true(document_source_same(&source, &found));
    document_source_destroy(context, &found);
    assert_true(drawing_recall(context, &second, &status));
    assert_int_equal(remove(other), 0);
    snprintf(folder, sizeof folder, "%s/sightline", config);
    snprintf(kept, sizeof kept, "%s/drawings", folder);
    assert_int_equal(remove(kept), 0);
    assert_int_equal(rmdir(folder), 0);
    assert_int_equal(rmdir(config), 0);
    close_house(&s);
}

/// A choice that is refused does not shut the drawing out the next time.
static void refused_is_not_kept(void **state) {
    (void)state;
    scene s = open_house();
    app_state *app = s.app;
    char config[] = "/tmp/sightline-config-XXXXXX", kept[160], folder[96];
    const struct timespec nap = {.tv_nsec = 2000000};
    sl_status status;
    assert_non_null(mkdtemp(config));
    assert_int_equal(setenv("XDG_CONFIG_HOME", config, 1), 0);
    app->ui.steady = false;
    press(app, "Ctrl+I");
    for (int i = 0; i < 8; i++) press(app, "Tab");
    input_text(app, "ells");
    viewer_press(app, "Return"); // before the plan has followed
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_NONE);
    for (int i = 0; i < 5000 && !dialog_open_now(&app->desk.dialog); i++) {
        nanosleep(&nap, NULL);
        app_tick(app, 0.002);
    }
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_QUESTION); // it is told
    document_source found = {0};
    const document_source plain = {.path = s.path, .options = sl_import_options_default()};
    assert_ok(app->context, document_source_copy(app->context, &plain, &found));
    assert_true(drawing_recall(app->context, &found, &status));
    assert_null(found.options.unit);
    document_source_destroy(app->context, &found);
    app->ui.steady = true;
    snprintf(folder, sizeof folder, "%s/sightline", config);
    snprintf(kept, sizeof kept, "%s/drawings", folder);
    assert_int_equal(remove(kept), 0);
    close_house(&s);
    assert_int_equal(rmdir(folder), 0);
    assert_int_equal(rmdir(config), 0);
}

/// A building asks which of its storeys is shown, and once more by a key; what is wrong in it is
/// told, and the plan stays.
static void storeys_are_chosen(void **state) {
    (void)state;
    scene s = open_house();
    app_state *app = s.app;
    char building[96], broken[96];
    snprintf(building, sizeof building, "%s/house.storeys", s.folder);
    snprintf(broken, sizeof broken, "%s/broken.storeys", s.folder);
    viewer_write(building, "storeys 1\nstorey ground house.dxf\nstorey first " MAPS
                           "/office.map\nlink stair ground 3,3 first 53,20\n");
    viewer_write(broken, "storeys 1\nstorey ground house.dxf\nladder\n");
    press(app, "Ctrl+Shift+B");
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_NONE);
    viewer_open(app, building);
    frame(app);
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_IMPORT);
    assert_false(import_is_beside(&app->desk));
    press(app, "Down");
    press(app, "Return");
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_NONE);
    assert_string_equal(app->document.source.path, MAPS "/office.map");
    assert_null(app->document.source.options.map);
    // The storey that is open is chosen at first.
    press(app, "Ctrl+Shift+B");
    press(app, "Return");
    assert_string_equal(app->document.source.path, MAPS "/office.map");
    press(app, "Ctrl+Shift+B");
    press(app, "Up");
    press(app, "Return");
    assert_string_equal(app->document.source.path, s.path);
    viewer_open(app, broken);
    frame(app);
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_QUESTION);
    assert_non_null(strstr(question_text(&app->desk), "broken.storeys:3"));
    press(app, "Return");
    assert_string_equal(app->document.source.path, s.path);
    // A plan that is opened by itself is of no building.
    viewer_open(app, s.path);
    assert_null(app->desk.file.building);
    assert_int_equal(remove(building), 0);
    assert_int_equal(remove(broken), 0);
    close_house(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roles_show_at_once), cmocka_unit_test(leaks_are_closed),
        cmocka_unit_test(plan_is_looked_at),  cmocka_unit_test(inside_is_told),
        cmocka_unit_test(line_is_measured),   cmocka_unit_test(keys_click_in_the_plan),
        cmocka_unit_test(wrong_choices),      cmocka_unit_test(choices_are_kept),
        cmocka_unit_test(storeys_are_chosen), cmocka_unit_test(refused_is_not_kept),
        cmocka_unit_test(unit_is_typed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
