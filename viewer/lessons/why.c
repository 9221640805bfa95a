/// From an explanation to the step of the search that decides.
///
/// A cell that is seen is entered for the first time by one step. For a hidden one, the explanation
/// has the sequence that comes nearest. Its portals but the last have a sightline, so the search
/// tries the last one too: that step is found by the places of the portal ends.
#include "lessons/why.h"

#include "sightline/support.h"

static why_pair pair_of(const learn_state *learn) {
    const sl_explanation *e = &learn->quiz.explanation;
    why_pair w = {.from = e->from, .to = e->to, .seen = e->verdict != SL_HIDDEN};
    const sl_sequence *sequence = e->miss_count ? &e->misses[0].sequence : NULL;
    if (w.seen || !sequence || sequence->directed_count > SL_DUAL_PORTALS_MOST) return w;
    for (; w.count < sequence->directed_count; w.count++) {
        const sl_directed_portal *at =
            &learn->view->present.space->directed[sequence->directed[w.count]];
        w.ends[w.count] = (sl_portal_ends){at->left, at->right};
    }
    return w;
}

static bool is_same(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

static bool is_sequence(const lesson_state *lesson, const sl_space *space, size_t step,
                        const why_pair *w) {
    uint32_t directed[SL_DUAL_PORTALS_MOST];
    if (!w->count || lesson->steps.steps[step].depth != w->count) return false;
    sl_steps_sequence(&lesson->steps, step, directed, SL_DUAL_PORTALS_MOST);
    for (uint32_t i = 0; i < w->count; i++) {
        const sl_directed_portal *at = &space->directed[directed[i]];
        if (!is_same(at->left, w->ends[i].left) || !is_same(at->right, w->ends[i].right))
            return false;
    }
    return true;
}

/// The step that decides; SIZE_MAX where the record does not reach it.
static size_t find_step(const lesson_state *lesson, const sl_space *space, const why_pair *w) {
    for (size_t i = 0; i < lesson->steps.count; i++) {
        const sl_step *s = &lesson->steps.steps[i];
        const bool rejected = s->kind == SL_STEP_HIDDEN || s->kind == SL_STEP_BACKWARDS;
        if (w->seen && s->kind == SL_STEP_ENTER && s->cell == w->to) return i;
        if (!w->seen && rejected && is_sequence(lesson, space, i, w)) return i;
        // Only grazed with open sight: the search passes over it.
        if (w->seen && rejected && s->grazing && s->cell == w->to) return i;
    }
    return SIZE_MAX;
}

bool why_take(learn_state *learn, why_pair *pair) {
    if (!learn->quiz.answered || !learn->document->baked) {
        ui_say(learn->ui, false, "a right click on a cell asks why it is seen or not");
        return false;
    }
    *pair = pair_of(learn);
    if (view_eye_cell(learn->view) != pair->from)
        learn->view->eye.at = sl_space_middle(&learn->document->baked->space, pair->from);
    lesson_set_subject(learn->context, &learn->lesson, subject_find(&lesson_search));
    return true;
}

void why_show(learn_state *learn, const why_pair *pair) {
    lesson_state *lesson = &learn->lesson;
    if (!lesson_shows(lesson, learn->document)) return;
    const size_t step = find_step(lesson, &learn->document->baked->space, pair);
    if (step == SIZE_MAX) {
        ui_say(learn->ui, false, "no step of the search decides on cell %u", pair->to);
        return;
    }
    lesson_go(lesson, learn->document, step);
    ui_say(learn->ui, false, "step %zu decides on cell %u", step + 1, pair->to);
}
