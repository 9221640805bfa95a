#include "panes.h"

static bool dual_shown(const sl_app *app) {
    return app->mode == SL_MODE_LEARN && sl_lesson_subject(&app->lesson)->sequence;
}

static bool first_person_shown(const sl_app *app) {
    return app->first_person;
}

static bool account_shown(const sl_app *app) {
    return app->accounts;
}

static bool effects_shown(const sl_app *app) {
    return app->effects && app->mode != SL_MODE_LEARN && app->document.baked &&
           sl_plan_make(&app->document.map).effects;
}

static double effects_lines(const sl_app *app) {
    return 4.5 + 1.5 * __builtin_popcount(sl_plan_make(&app->document.map).effects);
}

static const sl_pane_below panes[SL_PANES_BELOW] = {
    [SL_PANE_DUAL] = {dual_shown, sl_pane_dual, NULL},
    [SL_PANE_FIRST_PERSON] = {first_person_shown, sl_pane_first_person, NULL},
    [SL_PANE_ACCOUNT] = {account_shown, sl_pane_account, NULL},
    [SL_PANE_EFFECTS] = {effects_shown, sl_pane_effects, effects_lines},
};

const sl_pane_below *sl_panes_below(void) {
    return panes;
}
