/// Cameras that are not exported: the question before they are lost, and what waits for its answer.
#include "hand.h"

#include "dialogs/map_file.h"
#include "dialogs/question.h"
#include "plan/cameras.h"

#include <stdio.h>
#include <unistd.h>

static app_state *start(const char *map) {
    app_state *app = viewer_start(true);
    viewer_open(app, map);
    script_frame(app);
    press(app, "8");
    return app;
}

/// With one camera that no file has.
static app_state *start_with_camera(void) {
    app_state *app = start(MAPS "/office.map");
    click_at(app, (sl_point){30, 20});
    assert_int_equal(cameras_unsaved(&app->view), 1);
    return app;
}

static void assert_asks(const app_state *app, const char *text) {
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_QUESTION);
    assert_non_null(strstr(question_text(&app->desk), text));
}

/// In the file browser: the path of a file in the folder of the tests is typed over the suggested
/// one.
static void type_path(app_state *app, const char *name) {
    char path[256];
    assert_non_null(getcwd(path, sizeof path - strlen(name) - 2));
    strcat(strcat(path, "/"), name);
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_BROWSER);
    input_text(app, path);
    viewer_press(app, "Return");
    app_settle(app);
    script_frame(app);
}

/// Once they are exported, what waited goes on. A browser that is left gives it up.
static void asked_before_lost(void **state) {
    (void)state;
    app_state *app = start_with_camera();
    press(app, "Ctrl+Q");
    assert_asks(app, "1 camera is not exported.");
    viewer_answer(app, "Escape");
    assert_false(app->desk.quit);
    press(app, "Ctrl+Q");
    viewer_answer(app, "E");
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_BROWSER);
    press(app, "Escape");
    assert_int_equal(app->desk.file.pending, PENDING_NONE);
    press(app, "Ctrl+Q");
    viewer_answer(app, "E");
    type_path(app, "kept.csv");
    assert_true(app->desk.quit);
    app->desk.quit = false;
    assert_int_equal(remove("kept.csv"), 0);
    // They are as the file has them: a new map takes them without a question.
    viewer_press(app, "Ctrl+N");
    app_settle(app);
    assert_int_equal(app->view.cameras->table.count, 0);
    script_frame(app);
    click_at(app, (sl_point){30, 20});
    assert_int_equal(app->view.cameras->table.count, 1);
    press(app, "Ctrl+Q");
    viewer_answer(app, "D");
    assert_true(app->desk.quit);
    viewer_end(app);
}

/// Both events come in one frame.
static void asked_in_the_frame_of_the_click(void **state) {
    (void)state;
    app_state *app = start(MAPS "/office.map");
    const sl_point page = viewer_on_page(app, (sl_point){30, 20});
    input_press(app, BUTTON_LEFT, page);
    input_release(app, page);
    viewer_press(app, "Ctrl+Q");
    assert_false(app->desk.quit);
    assert_asks(app, "1 camera is not exported.");
    viewer_end(app);
}

/// A map with changes: it is saved first, then the cameras are exported.
static void asked_after_the_map(void **state) {
    (void)state;
    viewer_write("room.map", "sightline 1\nwalls 0 0 12 0 12 8 0 8 0 0\n");
    app_state *app = start("room.map");
    press(app, "F3");
    drag(app, (sl_point){6, 2}, (sl_point){6, 6});
    assert_true(map_file_changed(&app->desk));
    press(app, "8");
    click_at(app, (sl_point){3, 3});
    press(app, "Ctrl+Q");
    assert_asks(app, "room.map has changes");
    viewer_press(app, "S");
    app_settle(app);
    script_frame(app);
    assert_false(map_file_changed(&app->desk));
    assert_asks(app, "1 camera is not exported.");
    assert_false(app->desk.quit);
    viewer_answer(app, "E");
    type_path(app, "kept.csv");
    assert_true(app->desk.quit);
    viewer_end(app);
    assert_int_equal(remove("kept.csv"), 0);
    assert_int_equal(remove("room.map"), 0);
}

/// Nothing is lost where the table cannot be written: into no folder, or while events are random.
static void export_fails(void **state) {
    (void)state;
    app_state *app = start_with_camera();
    press(app, "Ctrl+Q");
    viewer_answer(app, "E");
    type_path(app, "nowhere/kept.csv");
    press(app, "Escape");
    assert_false(app->desk.quit);
    assert_int_equal(app->desk.file.pending, PENDING_NONE);
    app->desk.file.locked = true;
    press(app, "Ctrl+Q");
    viewer_answer(app, "E");
    type_path(app, "kept.csv");
    assert_int_not_equal(access("kept.csv", F_OK), 0);
    assert_false(app->desk.quit);
    assert_int_equal(app->desk.file.pending, PENDING_NONE);
    assert_int_equal(cameras_unsaved(&app->view), 1);
    viewer_end(app);
}

/// The same file with other options keeps the cameras, and does not ask.
static void read_again(void **state) {
    (void)state;
    viewer_write("house.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='200' height='100'>"
                              "<g id='walls'><path d='M0 0 H200 V100 H0 Z' stroke='black'/></g>"
                              "</svg>");
    app_state *app = start("house.svg");
    click_at(app, (sl_point){50, 50});
    document_source source = {0};
    assert_ok(app->context, document_source_copy(app->context, &app->document.source, &source));
    source.again = true;
    map_file_start(&app->desk, &source);
    app_settle(app);
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_NONE);
    assert_int_equal(app->view.cameras->table.count, 1);
    document_source_destroy(app->context, &source);
    viewer_end(app);
    assert_int_equal(remove("house.svg"), 0);
}

/// A script opens files without a question.
static void script_opens(void **state) {
    (void)state;
    app_state *app = start_with_camera();
    viewer_write("other.txt", "open " MAPS "/oblique/comb.map\nexpect comb.map - Sightline\n");
    assert_ok(app->context, script_run(app, "other.txt", NULL, NULL));
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_NONE);
    viewer_end(app);
    assert_int_equal(remove("other.txt"), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(asked_before_lost),   cmocka_unit_test(asked_in_the_frame_of_the_click),
        cmocka_unit_test(asked_after_the_map), cmocka_unit_test(export_fails),
        cmocka_unit_test(read_again),          cmocka_unit_test(script_opens)};
    return cmocka_run_group_tests(tests, viewer_enter_folder, viewer_leave_folder);
}
