/// What actions do, by topic, and the table that names them.
#include "app/actions.h"

#include "app/action_parts.h"
#include "app/layout.h"
#include "app/pictures.h"
#include "app/sheet.h"
#include "app/turn.h"
#include "dialogs/browser.h"
#include "dialogs/map_file.h"
#include "dialogs/opening.h"
#include "dialogs/question.h"
#include "dialogs/storeys.h"
#include "document/export.h"
#include "lessons/quiz.h"
#include "lessons/why.h"
#include "panes/modes.h"
#include "plan/cameras.h"
#include "plan/compare.h"
#include "plan/edit.h"
#include "plan/effects.h"
#include "plan/heat.h"
#include "plan/table.h"
#include "plan/view.h"
#include "plan/view_cells.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- modes

static void set_mode(app_state *app, view_mode mode) {
    view_set_mode(&app->view, mode);
    app->view.held = 0;
    app->learn.lesson.plays = false;
    quiz_forget(&app->learn);
    if (mode == MODE_QUIZ) quiz_ask(&app->learn);
    ui_say(&app->ui, false, "%s", mode_table()[mode].hint);
    app_tick(app, 0);
}

#define MODE(name, value)                                                                          \
    DO(name, set_mode(app, value))                                                                 \
    IS(name, app->view.mode == (value))
MODE(explore, MODE_EXPLORE)
MODE(learn, MODE_LEARN)
MODE(draw, MODE_DRAW)
MODE(quiz, MODE_QUIZ)
MODE(cameras, MODE_CAMERAS)
MODE(plan, MODE_PLAN)

// --- layers

#define TOGGLE(NAME, ...)                                                                          \
    static void toggle_##NAME(app_state *app) {                                                    \
        layers_toggle(&app->view, LAYER_##NAME);                                                   \
    }                                                                                              \
    static bool is_##NAME(const app_state *app) {                                                  \
        return (app->view.show & SHOW_##NAME) != 0;                                                \
    }
LAYERS(TOGGLE)

#define SWITCH(name, field)                                                                        \
    DO(name, app->field = !app->field)                                                             \
    IS(name, app->field)
SWITCH(first_person, ui.first_person)
IS(looks_beside, app->ui.first_person && app->ui.looks_beside)

static void looks_beside(app_state *app) {
    app->ui.looks_beside = !is_looks_beside(app);
    app->ui.first_person = true;
}
SWITCH(account, ui.accounts)
SWITCH(effects, ui.effects)
SWITCH(side_panel, ui.side_panel)
SWITCH(dark, ui.dark)
SWITCH(fullscreen, ui.fullscreen)

/// A legend that is folded opens; else it is switched.
static void legend(app_state *app) {
    ui_state *ui = &app->ui;
    if (!ui->legend_folded) ui->legend = !ui->legend;
    ui->legend_over = ui->legend;
}

IS(legend, app->ui.legend)

static void present(app_state *app) {
    app->ui.presents = !app->ui.presents;
    app->ui.legend_over = false;
}

IS(present, app->ui.presents)

static void help(app_state *app) {
    if (app->ui.help)
        ui_shut_help(&app->ui);
    else
        ui_open_help(&app->ui);
}

IS(help, app->ui.help)
SWITCH(fly, view.eye.flies)
DO(range, range_toggle(&app->view))
IS(range, app->document.map.range > 0)

static void split_less(app_state *app) {
    if (app->view.split_depth > 1) app->view.split_depth--;
}

static void split_more(app_state *app) {
    if (app->view.split_depth < 64) app->view.split_depth++;
}

/// From the whole tree the first step down is that of its deepest nodes.
static void tree_less(app_state *app) {
    const uint32_t deepest = app->view.tree ? sl_scene_tree_depth(app->view.tree) : 64;
    if (app->view.tree_depth > deepest) app->view.tree_depth = deepest;
    if (app->view.tree_depth > 0) app->view.tree_depth--;
}

static void tree_more(app_state *app) {
    if (app->view.tree_depth < 64) app->view.tree_depth++;
}

static void views_merge(app_state *app) {
    const uint32_t shown = view_layer_shown(app->view.views);
    if (shown > 1) view_layer_go(&app->view, shown - 1);
}

DO(views_split, view_layer_go(&app->view, view_layer_shown(app->view.views) + 1))
DO(views_largest, view_layer_mark_next(&app->view))
// --- view

/// Shows what lies beside the part of the map that is shown, an eighth of the plan further.
static void pan(app_state *app, int x, int y) {
    const sl_box plan = app_layout(app).plan[0];
    view_pan(&app->view, -box_width(plan) / 8 * x, -box_height(plan) / 8 * y);
}

DO(pan_left, pan(app, -1, 0))
DO(pan_right, pan(app, 1, 0))
DO(pan_up, pan(app, 0, -1))
DO(pan_down, pan(app, 0, 1))

DO(fit, app->view.fitted = true)
DO(zoom_in, view_zoom(&app->view, 1.25, (sl_point){0, 0}))
DO(zoom_out, view_zoom(&app->view, 1 / 1.25, (sl_point){0, 0}))

/// Goes to the next size of text, or back.
static void text_step(app_state *app, bool larger) {
    static const double sizes[] = {0.75, 1, 1.25, 1.5, 2, 2.5, 3};
    const double now = app->ui.text_scale;
    enum { COUNT_OF_SIZES = sizeof sizes / sizeof *sizes };
    for (int i = 0; i < COUNT_OF_SIZES; i++) {
        const double size = sizes[larger ? i : COUNT_OF_SIZES - 1 - i];
        if (larger ? size <= now + 1e-9 : size >= now - 1e-9) continue;
        app->ui.text_scale = size;
        return;
    }
}

DO(text_larger, text_step(app, true))
DO(text_smaller, text_step(app, false))

static void narrower(app_state *app) {
    app->view.eye.fov =
        fmax(app->view.eye.fov > 5 ? app->view.eye.fov - 5 : app->view.eye.fov - 1, 1);
}

static void wider(app_state *app) {
    app->view.eye.fov =
        fmin(app->view.eye.fov < 5 ? app->view.eye.fov + 1 : app->view.eye.fov + 5, 360);
}

DO(all_round, app->view.eye.fov = app->view.eye.fov >= 360 ? 90 : 360)
DO(home, walk_home(&app->view))

// --- methods

static void method_next(app_state *app) {
    size_t count;
    sl_eye_methods(&count);
    app->view.method = (app->view.method + 1) % count;
}

static void other_next(app_state *app) {
    size_t count;
    sl_eye_methods(&count);
    app->view.other = (app->view.other + 1) % count;
}

static void compare(app_state *app) {
    static const char *const words[] = {"one method", "two methods side by side",
                                        "what the looser one adds, in orange"};
    app->view.compare = (comparison)((app->view.compare + 1) % 3);
    ui_say(&app->ui, false, "%s", words[app->view.compare]);
}

IS(compare, app->view.compare != COMPARE_OFF)

// --- the lesson

DO(step_next, lesson_go(&app->learn.lesson, &app->document, app->learn.lesson.at + 1))

static void step_back(app_state *app) {
    if (app->learn.lesson.at)
        lesson_go(&app->learn.lesson, &app->document, app->learn.lesson.at - 1);
}

DO(step_first, lesson_go(&app->learn.lesson, &app->document, 0))
DO(step_last, lesson_go(&app->learn.lesson, &app->document, SIZE_MAX))
SWITCH(play_steps, learn.lesson.plays)

/// Goes to the next step of a kind, or says that there is none.
static void seek(app_state *app, bool rejects, bool back) {
    const subject_row *subject = lesson_subject(&app->learn.lesson);
    const char *name = rejects ? subject->rejected : subject->found;
    app->learn.lesson.plays = false;
    if (lesson_seek(&app->learn.lesson, &app->document, rejects, back)) return;
    if (name)
        ui_say(&app->ui, false, "no %s step \"%s\"", back ? "earlier" : "later", name);
    else
        ui_say(&app->ui, false, "this subject has no such steps");
}

DO(found_next, seek(app, false, false))
DO(found_back, seek(app, false, true))
DO(rejected_next, seek(app, true, false))

static void set_speed(app_state *app, int by) {
    lesson_state *lesson = &app->learn.lesson;
    lesson_set_speed(lesson, lesson->speed + by);
    ui_say(&app->ui, false, "%g steps a second", ldexp(2, lesson->speed));
}

DO(slower, set_speed(app, -1))
DO(faster, set_speed(app, 1))
SWITCH(program, ui.program)

static void choose_end(app_state *app, bool back) {
    lesson_state *lesson = &app->learn.lesson;
    char name[48] = "the line";
    if (!lesson->end_count) {
        ui_say(&app->ui, false, "this step has no portals to choose from");
        return;
    }
    lesson_choose(lesson, back);
    const uint32_t chosen = lesson_chosen(lesson);
    if (chosen != CHOSEN_NONE && chosen != CHOSEN_LINE) lesson_name_end(chosen, name);
    if (chosen == CHOSEN_NONE)
        ui_say(&app->ui, false, "nothing is chosen: Left and Right step");
    else
        ui_say(&app->ui, false, "%s: the arrows move it, Ctrl+Z takes that back", name);
}

DO(choose_next, choose_end(app, false))
DO(choose_back, choose_end(app, true))

static void reset_ends(app_state *app) {
    lesson_reset(&app->learn.lesson, &app->document);
    ui_say(&app->ui, false, "the portal ends and the line are where they were");
}

static void why_step(app_state *app) {
    why_pair pair;
    if (!why_take(&app->learn, &pair)) return;
    set_mode(app, MODE_LEARN);
    why_show(&app->learn, &pair);
}

/// From elsewhere it begins with the subdivision: F2 begins with the search.
static void subject(app_state *app) {
    lesson_state *lesson = &app->learn.lesson;
    if (app->view.mode == MODE_LEARN) {
        lesson_next_subject(app->context, lesson, &app->document);
        app_tick(app, 0);
        return;
    }
    lesson_set_subject(app->context, lesson, subject_find(&lesson_subdivision));
    set_mode(app, MODE_LEARN);
}

// --- walls

static void travel(app_state *app, bool redo) {
    sl_status status = SL_OK;
    bool bake = false;
    if (edit_cancel(&app->view)) return;
    if (!history_undo(app->context, &app->document.history, &app->document.map, redo, &bake,
                      &status)) {
        ui_say(&app->ui, false,
               redo ? "nothing to redo in this map" : "nothing to undo in this map");
        return;
    }
    view_check(&app->view, status);
    ui_say(&app->ui, false, redo ? "redone" : "undone");
    app->view.edit.chosen = UINT32_MAX;
    if (bake)
        view_after_edit(&app->view);
    else
        view_after_touch(&app->view);
}

/// Cameras have an undo of their own. False in other modes.
static bool travel_cameras(app_state *app, bool redo) {
    if (app->view.mode != MODE_CAMERAS) return false;
    if (camera_undo(&app->view, redo))
        ui_say(&app->ui, false, redo ? "redone" : "undone");
    else
        ui_say(&app->ui, false,
               redo ? "no change of the cameras to redo" : "no change of the cameras to undo");
    return true;
}

static void undo(app_state *app) {
    const bool learns = app->view.mode == MODE_LEARN;
    if (travel_cameras(app, false)) return;
    if (learns && lesson_undo(&app->learn.lesson))
        ui_say(&app->ui, false, "undone in the lesson");
    else
        travel(app, false);
}

static void redo(app_state *app) {
    if (!travel_cameras(app, true)) travel(app, true);
}

DO(delete_chosen, edit_delete(&app->view))

static void draw_doors(app_state *app) {
    app->view.edit.draws_doors = !app->view.edit.draws_doors;
    ui_say(&app->ui, false, "%s",
           app->view.edit.draws_doors ? "drag along a wall, or across a gap: a new door"
                                      : "drag on free ground: a new wall");
}

IS(draw_doors, app->view.edit.draws_doors)

// --- doors

DO(nearest_door, door_toggle_nearest(&app->view))

// --- the quiz

DO(answer_yes, quiz_answer(&app->learn, true))
DO(answer_no, quiz_answer(&app->learn, false))
DO(next_question, quiz_ask(&app->learn))

// --- recording

static void record(app_state *app) {
    path_recorder *r = &app->recorder;
    r->plays = false;
    r->waited = 0;
    if (!r->records) r->frames.count = 0;
    r->records = !r->records;
    ui_say(&app->ui, false, r->records ? "recording the eye's way" : "recorded");
}

IS(record, app->recorder.records)

/// Without a recording the map's first path is walked.
static void play(app_state *app) {
    path_recorder *r = &app->recorder;
    r->records = false;
    if (!r->frames.count && app->document.baked && app->document.baked->map.path_count)
        view_check(&app->view, record_path(app->context, r, &app->document.baked->map.paths[0],
                                           walk_speed(&app->document)));
    if (!r->frames.count) {
        ui_say(&app->ui, false, "nothing was recorded, and the map has no path");
        return;
    }
    r->plays = !r->plays;
    r->next = 0;
    r->waited = 0;
}

IS(play, app->recorder.plays)

void wish_for(desk_state *desk, path_wish wish, const char *path) {
    desk->wish = wish;
    snprintf(desk->wish_path, sizeof desk->wish_path, "%s", path);
}

static void take_frames(desk_state *desk, const char *path) {
    wish_for(desk, WISH_FRAMES, path);
}

static void export_frames(app_state *app) {
    const size_t count = (app->recorder.frames.count + SERIES_STEP - 1) / SERIES_STEP;
    char name[TITLE_TEXT];
    if (!count) {
        ui_say(&app->ui, false, "no way was recorded: record one, or play the map's path");
        return;
    }
    ui_say(&app->ui, false, "%zu picture%s of %d x %d pixels, in a new folder", count,
           count == 1 ? "" : "s", app->ui.width, app->ui.height);
    map_file_name_output(&app->desk, "-frames", name);
    browser_save(&app->desk, BROWSE_FRAMES, name, take_frames);
}

DO(print, sheet_ask(app))

static void take_picture(desk_state *desk, const char *path) {
    wish_for(desk, WISH_PICTURE, path);
}

static void ask_for_picture(app_state *app, const char *ending) {
    char name[TITLE_TEXT];
    map_file_name_output(&app->desk, ending, name);
    if (app->document.baked) browser_save(&app->desk, BROWSE_PICTURES, name, take_picture);
}

// --- files

DO(file_menu, menu_open(&app->desk))
DO(file_new, map_file_new(&app->desk))
DO(file_open, files_browse(&app->desk))
DO(file_import, files_import_again(&app->desk))
DO(file_storeys, storeys_choose(&app->desk))
DO(file_save, map_file_save(&app->desk))
DO(file_save_as, map_file_save_as(&app->desk))

static void file_notes(app_state *app) {
    const char *notes = app->document.notes;
    question_tell(&app->desk, "What was read",
                  *notes ? notes : "The reader of this file has no notes.");
}

IS(doors, app->document.source.options.doors)

static void doors(app_state *app) {
    sl_import_options options = app->document.source.options;
    if (!(app->document.source.takes & SL_TAKES_DOORS)) {
        ui_say(&app->ui, false, "this map's format has no doors to be taken otherwise");
        return;
    }
    options.doors = !options.doors;
    files_open_again(&app->desk, &options);
}

static void cut_by(app_state *app, double share) {
    const document_source *source = &app->document.source;
    sl_import_options options = source->options;
    const double by = share * (source->highest - source->lowest);
    options.slice = fmin(fmax(options.slice + by, source->lowest), source->highest);
    if (options.slice != source->options.slice) files_open_again(&app->desk, &options);
}

DO(cut_lower, cut_by(app, -0.02))
DO(cut_higher, cut_by(app, 0.02))
DO(save_png, ask_for_picture(app, ".png"))
DO(save_svg, ask_for_picture(app, ".svg"))
DO(save_pdf, ask_for_picture(app, ".pdf"))
DO(quit, map_file_quit(&app->desk))

static void escape(app_state *app) {
    if (app->ui.help)
        ui_shut_help(&app->ui);
    else if (map_file_stop(&app->desk))
        ui_say(&app->ui, false, "stopped; the map is not saved");
    else if (edit_cancel(&app->view) || plan_escape(app))
        ;
    else if (app->document.job) {
        document_cancel(app->context, &app->document);
        ui_say(&app->ui, false, "stopped; what is there stays");
    } else if (export_stop(&app->exports))
        ui_say(&app->ui, false, "stopped; the pictures that are written stay");
    else if (view_layer_stop(&app->view))
        ui_say(&app->ui, false, "stopped; F5 twice makes view cells again");
    else if (cameras_stop(&app->view))
        ui_say(&app->ui, false, "stopping: the best cameras so far stay");
    else if (heat_layer_stop(&app->view))
        ui_say(&app->ui, false, "stopped; 1 twice makes the heat map again");
    else if (app->view.mode == MODE_LEARN && app->learn.lesson.chosen_next)
        app->learn.lesson.chosen_next = 0;
    else if (app->recorder.plays)
        app->recorder.plays = false;
    else if (app->learn.quiz.asked || app->learn.quiz.answered)
        quiz_forget(&app->learn);
    else
        app->ui.presents = false;
}

#define HOLD(name, key, what, modes, bit)                                                          \
    { name, key, NULL, what, modes, bit, NULL, NULL }

#define LAYER_ROW(NAME, name, key, label, help, modes, calls)                                      \
    {name, key, label, "layer: " help, modes, 0, toggle_##NAME, is_##NAME},

static const action_row first[] = {
    {"explore", "F1", "Explore", "explore: walk about", 0, 0, explore, is_explore},
    {"learn", "F2", "Learn", "learn: step by step", 0, 0, learn, is_learn},
    {"draw", "F3", "Draw", "draw: walls and doors by hand", 0, 0, draw, is_draw},
    {"quiz", "F4", "Quiz", "quiz: seen or not?", 0, 0, quiz, is_quiz},
    {"cameras", "8", "Cameras", "cameras: what they see, and the fewest", 0, 0, cameras,
     is_cameras},

    {"plan", "9", "Plan", "plan: measures of a floor plan", 0, 0, plan, is_plan},

    HOLD("forward", "W", "walk ahead", WALKS, HOLD_FORWARD),
    HOLD("forward_too", "Up", "walk ahead", WALKS, HOLD_FORWARD),
    HOLD("back", "S", "walk back", WALKS, HOLD_BACK),
    HOLD("back_too", "Down", "walk back", WALKS, HOLD_BACK),
    HOLD("left", "A", "step to the left", WALKS, HOLD_LEFT),
    HOLD("right", "D", "step to the right", WALKS, HOLD_RIGHT),
    HOLD("turn_left", "Left", "turn left", EXPLORE | DRAW | PLAN, HOLD_TURN_LEFT),
    HOLD("turn_right", "Right", "turn right", EXPLORE | DRAW | PLAN, HOLD_TURN_RIGHT),
    {"fly", "G", "Fly", "fly through walls, or walk", 0, 0, fly, is_fly},
    {"home", "H", "Home", "back to the map's start", 0, 0, home, NULL},
    {"narrower", ",", NULL, "narrower view cone", NOT_LEARN, 0, narrower, NULL},
    {"wider", ".", NULL, "wider view cone", NOT_LEARN, 0, wider, NULL},
    {"range", "Ctrl+R", "Range", "set a view range, or lift it", 0, 0, range, is_range},
    {"all_round", "/", NULL, "all round, or a cone", 0, 0, all_round, NULL},

    LAYERS(LAYER_ROW){"split_less", "[", NULL, "splits less deep", 0, 0, split_less, NULL},
    {"split_more", "]", NULL, "splits deeper", 0, 0, split_more, NULL},
    {"tree_less", "-", NULL, "stab tree: a portal shorter", NOT_LEARN, 0, tree_less, NULL},
    {"tree_more", "=", NULL, "stab tree: a portal longer", NOT_LEARN, 0, tree_more, NULL},
    {"views_merge", "Ctrl+Left", "Merge", "view cells: one fewer", NOT_LEARN, 0, views_merge, NULL},
    {"views_split", "Ctrl+Right", "Split", "view cells: one more", NOT_LEARN, 0, views_split, NULL},
    {"views_largest", "F6", "Largest cost", "view cells: the largest cost, then the next", 0, 0,
     views_largest, NULL},
    {"first_person", "I", "First person", "first-person pane", 0, 0, first_person, is_first_person},
    {"looks_beside", "Shift+I", "Beside", "first person beside the plan, or below it", 0, 0,
     looks_beside, is_looks_beside},
    {"account", "L", "What accuracy costs", "what accuracy costs, as a chart", 0, 0, account,
     is_account},
    {"effects", "F8", "What the map calls for", "what the map calls for", 0, 0, effects,
     is_effects},

    {"method", "E", "Method", "the next culling method", 0, 0, method_next, NULL},
    {"compare", "X", "Compare", "two methods: panes, difference", EXPLORE, 0, compare, is_compare},
    {"other", "Z", "Other", "the next method to compare with", EXPLORE, 0, other_next, NULL},

    {"step_next", "Right", "\xe2\x96\xb6", "learn: a step on", LEARN, 0, step_next, NULL},
    {"step_back", "Left", "\xe2\x97\x80", "learn: a step back", LEARN, 0, step_back, NULL},
    {"step_first", "Home", "|\xe2\x97\x80", "learn: to the first step", LEARN, 0, step_first, NULL},
    {"step_last", "End", "\xe2\x96\xb6|", "learn: to the last step", LEARN, 0, step_last, NULL},
    {"play_steps", "Space", "Play", "learn: play the steps", LEARN, 0, play_steps, is_play_steps},
    {"found_next", "Ctrl+Right", "Next", "learn: the next new cell", LEARN, 0, found_next, NULL},
    {"found_back", "Ctrl+Left", "Back", "learn: the new cell before", LEARN, 0, found_back, NULL},
    {"rejected_next", "R", "Rejection", "learn: the next rejection", LEARN, 0, rejected_next, NULL},
    {"slower", "-", "Slower", "learn: play slower", LEARN, 0, slower, NULL},
    {"faster", "=", "Faster", "learn: play faster", LEARN, 0, faster, NULL},
    {"choose_next", ".", NULL, "learn: choose the line, or a portal end", LEARN, 0, choose_next,
     NULL},
    {"choose_back", ",", NULL, "learn: the one before", LEARN, 0, choose_back, NULL},
    {"reset_ends", "Delete", "Reset", "learn: ends and line as they were", LEARN, 0, reset_ends,
     NULL},
    {"program", "Ctrl+L", "Linear program", "learn: the linear program", LEARN, 0, program,
     is_program},
    {"subject", "U", "Subject (U)", "learn: the subdivision, or the next subject", 0, 0, subject,
     NULL},
    {"why_step", "Ctrl+T", "Show the step", "why: the step of the search that decides", 0, 0,
     why_step, NULL},

    {"undo", "Ctrl+Z", "Undo", "undo a change by hand", 0, 0, undo, NULL},
    {"redo", "Ctrl+Y", "Redo", "redo it", 0, 0, redo, NULL},
    {"delete", "Delete", "Delete", "draw: delete the chosen wall or door", DRAW, 0, delete_chosen,
     NULL},
    {"draw_doors", "X", "Draw doors", "draw: new doors, or new walls", DRAW, 0, draw_doors,
     is_draw_doors},

    {"nearest_door", "N", "Door", "shut or open the nearest door (click: any door)",
     EXPLORE | LEARN | DRAW | PLAN, 0, nearest_door, NULL},

    {"answer_yes", "Y", "Yes, seen (Y)", "quiz: seen", QUIZ, 0, answer_yes, NULL},
    {"answer_no", "N", "No (N)", "quiz: not seen", QUIZ, 0, answer_no, NULL},
    {"next_question", "Space", "Next (Space)", "quiz: the next question", QUIZ, 0, next_question,
     NULL},

};

static const action_row last[] = {
    {"record", "F9", "Record", "record the eye's way", 0, 0, record, is_record},
    {"play", "F10", "Play", "play it, or the map's path", 0, 0, play, is_play},
    {"export_series", NULL, "Save the way", "save pictures of the way", 0, 0, export_frames, NULL},

    {"file", "Ctrl+M", "File", "all that has to do with files", 0, 0, file_menu, NULL},
    {"new", "Ctrl+N", "New", "a new map", 0, 0, file_new, NULL},
    {"open", "Ctrl+O", "Open", "open a file", 0, 0, file_open, NULL},
    {"open_too", "O", NULL, "open a file", 0, 0, file_open, NULL},
    {"import", "Ctrl+I", "Options", "open the same file with other options", 0, 0, file_import,
     NULL},
    {"storeys", "Ctrl+Shift+B", "Storeys", "open another storey of the same building", 0, 0,
     file_storeys, NULL},
    {"notes", "Ctrl+J", "Notes", "what the reader took of the file", 0, 0, file_notes, NULL},
    {"save", "Ctrl+S", "Save", "save the map", 0, 0, file_save, NULL},
    {"save_as", "Ctrl+Shift+S", "Save as", "save the map under a name", 0, 0, file_save_as, NULL},
    {"doors", "Ctrl+D", "Doors", "doors as doors, or as they begin", 0, 0, doors, is_doors},
    {"cut_lower", "Ctrl+Down", NULL, "3D model: cut it lower", 0, 0, cut_lower, NULL},
    {"cut_higher", "Ctrl+Up", NULL, "3D model: cut it higher", 0, 0, cut_higher, NULL},
    {"save_png", "Ctrl+E", "PNG", "save the plan as PNG", 0, 0, save_png, NULL},
    {"save_svg", "Ctrl+G", "SVG", "save the plan as SVG", 0, 0, save_svg, NULL},
    {"save_pdf", "Ctrl+P", "PDF", "save the plan as PDF", 0, 0, save_pdf, NULL},
    {"print", "Ctrl+Shift+P", "Print", "print the plan to scale on A4 to A0", 0, 0, print, NULL},
    {"fit", "F", "Fit", "show all of the map", 0, 0, fit, NULL},
    {"fit_too", "Ctrl+0", NULL, "show all of the map", 0, 0, fit, NULL},
    {"zoom_in", "PageUp", NULL, "zoom in", 0, 0, zoom_in, NULL},
    {"zoom_out", "PageDown", NULL, "zoom out", 0, 0, zoom_out, NULL},
    {"pan_left", "Shift+Left", NULL, "move the plan: what lies to the left", 0, 0, pan_left, NULL},
    {"pan_right", "Shift+Right", NULL, "what lies to the right", 0, 0, pan_right, NULL},
    {"pan_up", "Shift+Up", NULL, "what lies above", 0, 0, pan_up, NULL},
    {"pan_down", "Shift+Down", NULL, "what lies below", 0, 0, pan_down, NULL},
    {"dark", "T", "Dark", "light or dark", 0, 0, dark, is_dark},
    {"text_larger", "Ctrl+=", NULL, "larger text", 0, 0, text_larger, NULL},
    {"text_smaller", "Ctrl+-", NULL, "smaller text", 0, 0, text_smaller, NULL},
    {"side_panel", "Ctrl+B", "Panel", "the panel at the right", 0, 0, side_panel, is_side_panel},
    {"legend", "F7", "Legend", "the legend over the plan, where there is no panel", 0, 0, legend,
     is_legend},
    {"fullscreen", "F11", "Fullscreen", "fill the screen, or the window again", 0, 0, fullscreen,
     is_fullscreen},
    {"present", "F12", "Present", "for a projector: large text, strong tones, few panels", 0, 0,
     present, is_present},
    {"help", "?", "?", "this help", 0, 0, help, is_help},
    {"escape", "Escape", "Stop", "stop, close, end the presentation", 0, 0, escape, NULL},
    {"quit", "Ctrl+Q", NULL, "quit", 0, 0, quit, NULL},
};
/// The parts of the table, in the order of the help.
enum { PARTS = 3 };
static void list_parts(action_part parts[PARTS]) {
    parts[0] = (action_part){first, sizeof first / sizeof *first};
    parts[1] = actions_plan();
    parts[2] = (action_part){last, sizeof last / sizeof *last};
}

int action_count(void) {
    action_part parts[PARTS];
    int count = 0;
    list_parts(parts);
    for (int i = 0; i < PARTS; i++) count += parts[i].count;
    return count;
}

const action_row *action_at(int number) {
    action_part parts[PARTS];
    int part = 0;
    list_parts(parts);
    for (; number >= parts[part].count; part++) number -= parts[part].count;
    return &parts[part].rows[number];
}

bool action_looks(int number) {
    void (*const run)(app_state * app) = action_at(number)->run;
    return run == fit || run == file_notes;
}

int action_find(const char *name) {
    for (int i = 0; i < action_count(); i++)
        if (strcmp(action_at(i)->name, name) == 0) return i;
    return -1;
}

int action_of_key(const char *key, view_mode mode) {
    for (int i = 0; i < action_count(); i++) {
        const action_row *a = action_at(i);
        if (a->key && strcmp(a->key, key) == 0 && (!a->modes || a->modes & 1u << mode)) return i;
    }
    return -1;
}

void actions_show(app_state *app) {
    app->ui.action_count = action_count();
    for (int i = 0; i < app->ui.action_count && i < ACTIONS_MOST; i++) {
        const action_row *a = action_at(i);
        app->ui.actions[i] =
            (ui_action){a->name, a->key, a->label, a->help, a->on && a->on(app), a->hold != 0};
    }
}

/// Does what a path was chosen for in the file browser.
static void take_wish(app_state *app) {
    const path_wish wish = app->desk.wish;
    const char *path = app->desk.wish_path;
    sl_status status = SL_OK;
    app->desk.wish = WISH_NONE;
    if (app->desk.file.locked && wish != WISH_READ_TABLE && wish != WISH_COMPARE) {
        if (wish == WISH_WRITE_TABLE) map_file_exported(&app->desk, false);
        return;
    }
    if (wish == WISH_READ_TABLE)
        status = cameras_read(&app->view, path);
    else if (wish == WISH_WRITE_TABLE)
        status = cameras_write(&app->view, path);
    else if (wish == WISH_WRITE_VALUES)
        status = table_write(&app->view, path);
    else if (wish == WISH_COMPARE)
        compare_open(&app->view, path);
    else if (wish == WISH_PICTURE)
        status = save_picture(app, path);
    else if (wish == WISH_SHEET)
        status = sheet_save(app, path);
    else if (wish == WISH_FRAMES)
        status = save_series(app, path, SERIES_STEP);
    if (wish == WISH_WRITE_TABLE) map_file_exported(&app->desk, status == SL_OK);
    view_check(&app->view, status);
}

void actions_answered(app_state *app) {
    const char *chosen = app->desk.dialog.chosen;
    app->desk.dialog.chosen = NULL;
    if (chosen) action_run(app, action_find(chosen));
    take_wish(app);
}

void action_run(app_state *app, int action) {
    if (action < 0 || action >= action_count()) return;
    const action_row *a = action_at(action);
    app->desk.file.cameras = cameras_unsaved(&app->view); // one may have come in this frame
    if (a->run)
        a->run(app);
    else
        app->view.held |= a->hold;
}
