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

static const sl_pane_below panes[SL_PANES_BELOW] = {
    [SL_PANE_DUAL] = {dual_shown, sl_pane_dual},
    [SL_PANE_FIRST_PERSON] = {first_person_shown, sl_pane_first_person},
    [SL_PANE_ACCOUNT] = {account_shown, sl_pane_account},
};

const sl_pane_below *sl_panes_below(void) {
    return panes;
}
