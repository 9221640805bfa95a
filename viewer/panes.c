#include "panes.h"

static bool dual_shown(const app_state *app) {
    return app->tool.mode == MODE_LEARN && lesson_subject(&app->tool.lesson)->sequence;
}

static bool first_person_shown(const app_state *app) {
    return app->ui.first_person;
}

static bool account_shown(const app_state *app) {
    return app->ui.accounts;
}

static bool effects_shown(const app_state *app) {
    return app->ui.effects && app->tool.mode != MODE_LEARN && app->document.baked &&
           sl_plan_make(&app->document.map).effects;
}

static double effects_lines(const app_state *app) {
    return 4.5 + 1.5 * __builtin_popcount(sl_plan_make(&app->document.map).effects);
}

static const pane_below panes[PANES_BELOW] = {
    [PANE_DUAL] = {dual_shown, pane_dual, NULL},
    [PANE_FIRST_PERSON] = {first_person_shown, pane_first_person, NULL},
    [PANE_ACCOUNT] = {account_shown, pane_account, NULL},
    [PANE_EFFECTS] = {effects_shown, pane_effects, effects_lines},
};

const pane_below *panes_below(void) {
    return panes;
}
