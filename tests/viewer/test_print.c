// Sheets of paper from the viewer: asked for by keys, to scale, with what the mode or tool shows;
// and what is said where the plan has no unit or does not fit.
#include "hand.h"

#include "app/sheet.h"
#include "app/sheet_parts.h"
#include "dialogs/question.h"
#include "document/drawings.h"
#include "plan/cameras.h"
#include "plan/compare.h"
#include "plan/from_line.h"
#include "plan/heat.h"
#include "plan/line_map.h"
#include "plan/room_map.h"
#include "plan/route.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// A hall of 12 by 8 m with two walls in it, turned by 17.3 degrees.
static const char plan[] = "sightline 1\nunit m\n"
                           "wall 0 0 11.457 3.568\nwall 11.457 3.568 9.078 11.206\n"
                           "wall 9.078 11.206 -2.379 7.638\nwall -2.379 7.638 0 0\n"
                           "wall 5.729 1.784 4.539 5.603\n"
                           "wall 0.485 8.53 1.97 3.757\nstart 3 4 0\n";

typedef struct scene {
    char folder[40], map[64], sheet[64];
    app_state *app;
} scene;

static scene open_plan(const char *text) {
    scene s = {.folder = "/tmp/sightline-sheet-XXXXXX"};
    assert_non_null(mkdtemp(s.folder));
    snprintf(s.map, sizeof s.map, "%s/hall.map", s.folder);
    snprintf(s.sheet, sizeof s.sheet, "%s/hall.svg", s.folder);
    viewer_write(s.map, text);
    s.app = viewer_start(true);
    viewer_open(s.app, s.map);
    script_frame(s.app);
    return s;
}

static void close_plan(scene *s) {
    viewer_end(s->app);
    assert_int_equal(remove(s->map), 0);
    assert_int_equal(rmdir(s->folder), 0);
}

/// Prints by keys on the paper and at the scale of these letters; what the sheet has as text.
static char *print(const scene *s, const char *paper, const char *scale) {
    press(s->app, "Ctrl+Shift+P");
    assert_int_equal(dialog_open_now(&s->app->desk.dialog), DIALOG_QUESTION);
    press(s->app, paper);
    assert_int_equal(dialog_open_now(&s->app->desk.dialog), DIALOG_QUESTION);
    press(s->app, scale);
    assert_int_equal(dialog_open_now(&s->app->desk.dialog), DIALOG_BROWSER);
    press(s->app, "Ctrl+U");
    input_text(s->app, s->sheet);
    press(s->app, "Return");
    assert_int_equal(dialog_open_now(&s->app->desk.dialog), DIALOG_NONE);
    sl_bytes bytes = {0};
    if (sl_file_read(s->app->context, s->sheet, &bytes) != SL_OK) return NULL;
    assert_int_equal(remove(s->sheet), 0);
    return bytes.data;
}

/// A length of the sheet, as its first element has it.
static double points_of(const char *sheet, const char *name) {
    const char *at = strstr(sheet, name);
    char *end;
    assert_non_null(at);
    const double points = strtod(at + strlen(name), &end);
    assert_memory_equal(end, "pt\"", 3);
    return points;
}

static void assert_prints(const scene *s, const char *const *texts) {
    char *sheet = print(s, "3", "1");
    assert_non_null(sheet);
    const double wide = points_of(sheet, " width=\""), high = points_of(sheet, " height=\"");
    assert_true(fabs(wide - 420 * 72 / 25.4) < 0.1 && fabs(high - 297 * 72 / 25.4) < 0.1);
    assert_non_null(strstr(sheet, "1:100"));
    for (; *texts; texts++)
        if (!strstr(sheet, *texts)) fail_msg("'%s' is not on the sheet", *texts);
    sl_free(s->app->context, sheet);
}

static void what_is_shown(void **state) {
    (void)state;
    scene s = open_plan(plan);
    app_state *app = s.app;
    press(app, "9");
    assert_prints(&s, (const char *const[]){"hall.map", "seen from the viewpoint", "viewpoint",
                                            "Isovist of 3, 4: area ", " m\xc2\xb2, ", NULL});
    press(app, "1");
    char measure[64];
    heat_say_measure(&app->view, measure);
    assert_prints(&s, (const char *const[]){measure, NULL});
    // What is seen is an outline over the heat map, and so its swatch is a line that one sees.
    sheet_parts parts = {0};
    sl_draw_options drawn = sl_draw_options_default();
    assert_ok(app->context, sheet_parts_fill(&app->view, true, &parts));
    sheet_parts_apply(&parts, &drawn);
    assert_string_equal(drawn.parts[0].name, "seen from the viewpoint");
    assert_true(drawn.parts[0].line_count > 2 && !drawn.parts[0].area.count);
    sheet_parts_destroy(app->context, &parts);
    press(app, "1");
    press(app, "Ctrl+5");
    *line_map_choice(&app->view) = sl_measure_find(SL_AXIAL, "line_length");
    press(app, "Ctrl+5");
    assert_prints(&s, (const char *const[]){"line length", NULL});
    press(app, "8");
    camera_add(&app->view, (sl_point){3, 4});
    camera_rename(&app->view, "Gate & lift");
    app_tick(app, 0);
    char sees[96];
    snprintf(sees, sizeof sees,
             ">Gate &amp; lift: at 3, 4, sees %.4g m\xc2\xb2, %.4g m\xc2\xb2 alone<",
             app->view.cameras->coverage.seen[0], app->view.cameras->coverage.seen[0]);
    const sl_coverage *seen = &app->view.cameras->coverage;
    char blind[64];
    assert_true(seen->blind_count > 0);
    snprintf(blind, sizeof blind, ">Blind spots: 1: %.4g m\xc2\xb2 at ", seen->blind[0].area);
    char classes[96];
    snprintf(classes, sizeof classes, ">Not seen: %.4g m\xc2\xb2; seen by 1: %.4g m\xc2\xb2.<",
             sl_coverage_class_area(seen, 0), sl_coverage_class_area(seen, 1));
    assert_prints(&s, (const char *const[]){">Gate &amp; lift<", sees, classes, blind, NULL});
    assert_non_null(strstr(app->ui.message, "printed at 1:100 on A3 to "));
    close_plan(&s);
}

/// Below the plan stand as many rows as are promised, however long they are.
static void all_rows_are_there(void **state) {
    (void)state;
    scene s = open_plan("sightline 1\nunit m\nwalls 600000 500000 600012 500000 600012 500008 "
                        "600000 500008 600000 500000\nstart 600003 500004 0\n");
    app_state *app = s.app;
    press(app, "8");
    for (int i = 0; i < 42; i++) {
        char name[CAMERA_NAME];
        snprintf(name, sizeof name, "the long name of camera no. %02d", i + 1);
        camera_add(&app->view, (sl_point){600003, 500004});
        *camera_chosen(&app->view) = (sl_viewpoint){.at = {600003 + 0.0123456789 * i, 500004.123},
                                                    .heading = 123.4,
                                                    .fov = 61.25,
                                                    .range = 7.125};
        camera_rename(&app->view, name);
    }
    app_tick(app, 0);
    snprintf(app->view.cameras->proof, PROOF_TEXT, "%0*d", PROOF_TEXT - 1, 0);
    sheet_parts parts = {0};
    assert_ok(app->context, sheet_parts_fill(&app->view, false, &parts));
    assert_true(parts.words.count > 6000);
    assert_int_equal(strlen(parts.words.items), parts.words.count);
    assert_non_null(strstr(parts.words.items, "camera no. 40: at "));
    assert_non_null(strstr(parts.words.items, "And 2 more, which the exported table has."));
    sheet_parts_destroy(app->context, &parts);
    close_plan(&s);
}

/// What each tool draws over the plan has its key, its names and its figures.
static void what_tools_show(void **state) {
    (void)state;
    scene s = open_plan(plan);
    app_state *app = s.app;
    char text[64];
    press(app, "9");
    press(app, "Ctrl+4");
    from_line_begin(&app->view, (sl_point){1, 2});
    from_line_move(&app->view, (sl_point){2, 2});
    app->view.drag.kind = DRAG_NONE;
    app_tick(app, 0);
    snprintf(text, sizeof text, ">seen from some point of the line: %.4g m\xc2\xb2<",
             from_line_seen(&app->view)->seen[SL_SEEN_FROM_SOME].area);
    assert_prints(&s,
                  (const char *const[]){text, ">seen from all of its points: ", ">line<", NULL});
    press(app, "Ctrl+3");
    route_click(&app->view, (sl_point){3, 4});
    route_click(&app->view, (sl_point){8, 6});
    snprintf(text, sizeof text, ">shortest way: %.4g m<", app->view.route->route.length);
    assert_prints(&s, (const char *const[]){text, NULL});
    press(app, "Ctrl+8");
    app_tick(app, 0);
    const room_map *rooms = room_map_shown(&app->view);
    room_map_rename(&app->view, 0, "Hall & stage");
    snprintf(text, sizeof text, "Hall &amp; stage (%.4g m\xc2\xb2), ", room_map_area(rooms, 0));
    assert_prints(&s, (const char *const[]){">Hall &amp; stage<", text, ">viewpoint<", NULL});
    press(app, "1"); // with a heat map the names stay
    heat_say_measure(&app->view, text);
    assert_prints(&s, (const char *const[]){">Hall &amp; stage<", text, NULL});
    room_map_rename(&app->view, 0, "");
    press(app, "1");
    compare_open(&app->view, MAPS "/gallery.map");
    press(app, "Ctrl+7");
    app_tick(app, 0);
    assert_prints(&s,
                  (const char *const[]){">walls of this plan alone<",
                                        ">walls of the other plan alone<", "gallery.map.<", NULL});
    close_plan(&s);
}

/// What does not fit leaves no file and says which scale does; and one can turn back.
static void what_does_not_fit(void **state) {
    (void)state;
    scene s = open_plan(plan);
    press(s.app, "Ctrl+Shift+P");
    press(s.app, "4");
    press(s.app, "5");
    assert_int_equal(dialog_open_now(&s.app->desk.dialog), DIALOG_QUESTION); // and no name yet
    assert_non_null(strstr(question_text(&s.app->desk), "too large for A4; 1:100 fits"));
    press(s.app, "Escape");
    assert_int_equal(dialog_open_now(&s.app->desk.dialog), DIALOG_NONE);
    char *sheet = print(&s, "4", "L");
    assert_non_null(sheet);
    assert_non_null(strstr(sheet, "1:100"));
    assert_non_null(strstr(s.app->ui.message, "printed at 1:100 on A4 to "));
    sl_free(s.app->context, sheet);
    press(s.app, "Ctrl+Shift+P");
    press(s.app, "Escape");
    assert_int_equal(dialog_open_now(&s.app->desk.dialog), DIALOG_NONE);
    press(s.app, "Ctrl+Shift+P");
    press(s.app, "0");
    press(s.app, "Escape");
    assert_int_equal(dialog_open_now(&s.app->desk.dialog), DIALOG_NONE);
    close_plan(&s);
}

/// A letter that answers comes as text, too: it is not typed into the name that is asked for next.
static void letters_are_no_name(void **state) {
    (void)state;
    scene s = open_plan(plan);
    char sheet[64];
    snprintf(sheet, sizeof sheet, "%s/hall-A3.pdf", s.folder);
    assert_int_equal(chdir(s.folder), 0);
    static const char *const keys[] = {"Ctrl+Shift+P", "3", "1"};
    for (int i = 0; i < 3; i++) {
        input_key(s.app, keys[i], true);
        if (i) input_text(s.app, keys[i]);
        input_key(s.app, keys[i], false);
        app_tick(s.app, 0);
        script_frame(s.app);
    }
    press(s.app, "Return");
    assert_int_equal(dialog_open_now(&s.app->desk.dialog), DIALOG_NONE);
    assert_int_equal(remove(sheet), 0);
    close_plan(&s);
}

/// Only of a drawing Ctrl+I asks for the unit.
static void no_unit(void **state) {
    (void)state;
    scene s = open_plan("sightline 1\nwall 0 0 5 0\nwall 5 0 5 5\nwall 5 5 0 5\nwall 0 5 0 0\n");
    press(s.app, "Ctrl+Shift+P");
    assert_int_equal(dialog_open_now(&s.app->desk.dialog), DIALOG_NONE);
    assert_true(s.app->ui.message_is_error);
    assert_non_null(strstr(s.app->ui.message, "'unit m'"));
    assert_null(strstr(s.app->ui.message, "Ctrl+I"));
    close_plan(&s);
}

/// A line of map text can only stand in map text.
static void no_unit_by_kind_of_file(void **state) {
    (void)state;
    static const char *const files[][2] = {
        {"hall.txt", "save it as .map, then write 'unit m' in it"},
        {"hall.map", "write 'unit m' in the file"},
    };
    for (size_t i = 0; i < 2; i++) {
        char folder[] = "/tmp/sightline-unit-XXXXXX", path[64];
        assert_non_null(mkdtemp(folder));
        snprintf(path, sizeof path, "%s/%s", folder, files[i][0]);
        viewer_write(path,
                     i ? "sightline 1\nwalls 0 0 5 0 5 5 0 5 0 0\n" : "#####\n#...#\n#####\n");
        app_state *app = viewer_start(true);
        viewer_open(app, path);
        assert_string_equal(app->document.map.unit, "");
        press(app, "Ctrl+Shift+P");
        assert_non_null(strstr(app->ui.message, files[i][1]));
        viewer_end(app);
        assert_int_equal(remove(path), 0);
        assert_int_equal(rmdir(folder), 0);
    }
    assert_non_null(strstr(drawing_unit_hint("hall.slv"), "bake it"));
    assert_non_null(strstr(drawing_unit_hint("hall.dxf"), "Ctrl+I"));
    assert_non_null(strstr(drawing_unit_hint(NULL), "save it as .map"));
}

/// One blind spot is one, and so is one that the sheet has no room for.
static void blind_spots_in_words(void **state) {
    (void)state;
    static const struct {
        int teeth;
        const char *said;
    } halls[] = {{1, "Blind spot 1: "},
                 {2, "Blind spots: 1: "},
                 {41, " And 1 smaller one."},
                 {42, " And 2 smaller ones."}};
    for (size_t i = 0; i < sizeof halls / sizeof *halls; i++) {
        char text[4096] = "sightline 1\nunit m\n";
        size_t at = strlen(text);
        const int n = halls[i].teeth;
        at += (size_t)snprintf(text + at, sizeof text - at, "walls 0 0 %d 0 %d 2", 3 * n, 3 * n);
        for (int k = n; k-- > 0;) // from the hall one sees a part of each
            at += (size_t)snprintf(text + at, sizeof text - at, " %d 2 %d 9 %d 9 %d 2", 3 * k + 2,
                                   3 * k + 2, 3 * k + 1, 3 * k + 1);
        snprintf(text + at, sizeof text - at, " 0 2 0 0\nstart 0.2 1 0\n");
        scene s = open_plan(text);
        press(s.app, "8");
        click_at(s.app, (sl_point){0.2, 1});
        app_tick(s.app, 0);
        assert_int_equal(s.app->view.cameras->coverage.blind_count, n);
        sheet_parts parts = {0};
        assert_ok(s.app->context, sheet_parts_fill(&s.app->view, false, &parts));
        if (!strstr(parts.words.items, halls[i].said)) fail_msg("%s", parts.words.items);
        sheet_parts_destroy(s.app->context, &parts);
        close_plan(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_shown),           cmocka_unit_test(all_rows_are_there),
        cmocka_unit_test(what_tools_show),         cmocka_unit_test(what_does_not_fit),
        cmocka_unit_test(letters_are_no_name),     cmocka_unit_test(no_unit),
        cmocka_unit_test(no_unit_by_kind_of_file), cmocka_unit_test(blind_spots_in_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
