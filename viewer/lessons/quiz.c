/// The question, the answer and its reason, as words and as marks over the plan.
#include "lessons/quiz.h"

#include "plan/layers.h"
#include "sightline/draw.h"
#include "sightline/stab.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

/// The limit of the search that explains a hidden pair: it can visit all that is seen.
#define TESTS_MOST 200000

void quiz_forget(learn_state *learn) {
    learn->quiz.asked = learn->quiz.answered = learn->quiz.judged = false;
    sl_explanation_destroy(learn->context, &learn->quiz.explanation);
}

/// Whether the sightline by mirror is looked for. Past one-way glass it depends on the way there.
static bool explains_mirrors(const view_state *view, const sl_explanation *e) {
    const sl_map *map = &view->document->baked->map;
    return e->verdict == SL_HIDDEN && e->complete && map->mirror_count && !map->oneway_count;
}

/// The explained line is bent by mirrors.
bool quiz_is_bent(const quiz_state *q) {
    return q->answered && q->explanation.bent.bends && q->explanation.bent.verdict != SL_HIDDEN;
}

void quiz_explain(learn_state *learn, uint32_t from, uint32_t to) {
    quiz_forget(learn);
    const document_state *d = learn->document;
    if (!d->baked || !learn->view->present.query || from >= d->baked->space.cell_count ||
        to >= d->baked->space.cell_count)
        return;
    sl_explain_options options = sl_explain_options_default();
    options.solver = sl_funnel();
    options.most_tests = TESTS_MOST;
    learn->quiz.from = from;
    learn->quiz.to = to;
    learn->quiz.asked = true;
    learn->quiz.subject = learn->lesson.subject;
    learn->quiz.step = learn->lesson.at;
    sl_explanation *e = &learn->quiz.explanation;
    sl_status status = present_space(learn->context, &learn->view->present);
    const sl_space *space = learn->view->present.space;
    if (status == SL_OK) status = sl_explain(learn->context, space, &options, from, to, e);
    if (status == SL_OK && explains_mirrors(learn->view, e))
        status = sl_explain_by_mirror(learn->context, space, &d->baked->map, &options,
                                      d->mirror_depth, e);
    learn->quiz.answered = status == SL_OK;
    learn->quiz.version = learn->view->present.version;
    view_check(learn->view, status);
}

void quiz_follow_lesson(learn_state *learn) {
    const quiz_state *q = &learn->quiz;
    const lesson_state *lesson = &learn->lesson;
    if (learn->view->mode != MODE_LEARN || !q->answered) return;
    if (lesson->at != q->step || lesson->subject != q->subject || lesson->plays) quiz_forget(learn);
}

/// Chooses a pair that is not too easy: a few portals apart, and as often seen as not where
/// possible.
void quiz_ask(learn_state *learn) {
    const document_state *d = learn->document;
    quiz_forget(learn);
    if (!d->baked || !document_has_rows(d) || d->counted < 2) return;
    const sl_space *space = &d->baked->space;
    if (!learn->ui->steady && !learn->quiz.seeded) {
        learn->quiz.random ^= (uint64_t)time(NULL) * 0x9e3779b97f4a7c15u;
        learn->quiz.seeded = true;
    }
    sl_random random = {learn->quiz.random};
    const bool wanted = sl_random_next(&random) & 1;
    uint32_t from = 0, to = 0;
    for (int attempt = 0; attempt < 4000; attempt++) {
        from = (uint32_t)sl_random_below(&random, space->cell_count);
        to = (uint32_t)sl_random_below(&random, space->cell_count);
        if (from == to || !sl_baked_counts(d->baked, from) || !sl_baked_counts(d->baked, to))
            continue;
        bool neighbours = false;
        for (uint32_t i = 0; i < space->cells[from].directed_count; i++)
            neighbours |= space->directed[space->cells[from].first_directed + i].cell == to;
        if (neighbours && attempt < 3000) continue;
        if (present_sees(learn->context, &learn->view->present, from, to) == wanted ||
            attempt > 2000)
            break;
    }
    learn->quiz.random = random.state;
    learn->quiz.from = from;
    learn->quiz.to = to;
    learn->quiz.asked = from != to;
}

void quiz_answer(learn_state *learn, bool seen) {
    quiz_state *q = &learn->quiz;
    if (!q->asked || q->answered) return;
    const bool is_seen = present_sees(learn->context, &learn->view->present, q->from, q->to);
    quiz_explain(learn, q->from, q->to);
    q->right = is_seen == seen;
    q->said = seen;
    q->judged = true;
    q->asked_count++;
    q->right_count += q->right;
}

static const sl_sequence *sequence_of(const sl_explanation *e) {
    return e->verdict != SL_HIDDEN ? &e->sequence : e->miss_count ? &e->misses[0].sequence : NULL;
}

/// Effects can decide otherwise than the portals that the line passes.
static const char *words_of_effects(const learn_state *learn) {
    const sl_explanation *e = &learn->quiz.explanation;
    const document_state *d = learn->document;
    const sl_visibility *v = &d->baked->visibility;
    if (!document_has_rows(d) || !sl_plan_make(&d->map).effects || !e->complete) return "";
    if (quiz_is_bent(&learn->quiz))
        return e->bent.rounded ? " It is seen by mirror: the purple line (its places are rounded)."
                               : " It is seen by mirror: the purple line.";
    if (v->mirrored.cell_count && sl_pvs_sees(&v->mirrored, e->from, e->to))
        return " It is seen by mirror.";
    const bool sees = present_sees(learn->context, &learn->view->present, e->from, e->to);
    if (!e->seen && !sees && present_has_shut(&learn->view->present) &&
        sl_pvs_sees(&v->pvs, e->from, e->to))
        return " With all doors open it would be seen.";
    if (e->seen && !sees) return " But glass is dark that way, or it is out of the view's range.";
    return !e->seen && sees ? " From elsewhere in its cell glass lets it through." : "";
}

void quiz_question(const learn_state *learn, char *text, size_t room) {
    const quiz_state *q = &learn->quiz;
    if (q->asked)
        snprintf(text, room, "Can the orange cell %u see the purple cell %u?", q->from, q->to);
    else
        snprintf(text, room, "Space asks about two cells. The visibility must be there first.");
}

/// Whether the answer is right, and what was wrong with it.
static const char *judgement(const learn_state *learn) {
    const quiz_state *q = &learn->quiz;
    if (!q->judged) return "";
    if (q->right) return "Right. ";
    return q->said ? "Wrong: you said that it is seen, but no line gets there. "
                   : "Wrong: you said that it is not seen, but a line gets there. ";
}

static void write_words(const learn_state *learn, char *text, size_t room) {
    const sl_explanation *e = &learn->quiz.explanation;
    const sl_space *space = learn->view->present.space;
    const sl_sequence *sequence = sequence_of(e);
    if (e->from == e->to)
        snprintf(text, room, "A cell sees itself: it is convex, and no wall is inside it.");
    else if (e->verdict == SL_STABBED)
        snprintf(text, room,
                 "Seen: the line passes %u portal%s, left ends at its left and right ends at its "
                 "right.",
                 e->sequence.directed_count, e->sequence.directed_count == 1 ? "" : "s");
    else if (e->verdict == SL_GRAZING)
        snprintf(text, room, "Only grazed: the line touches portal ends, for %s.",
                 sl_sequence_reason(space, sequence));
    else if (!e->complete)
        snprintf(text, room, "Not found seen after %llu tests.", (unsigned long long)e->tests);
    else if (!sequence)
        snprintf(text, room, "Not seen: %s.",
                 present_has_shut(&learn->view->present) ? "no open way leads from one to the other"
                                                         : "no portals lead from one to the other");
    else if (e->misses[0].turns)
        snprintf(text, room,
                 "Not seen. The sequence that comes nearest would have to turn back at its last "
                 "portal, and no straight line does.");
    else
        snprintf(text, room,
                 "Not seen. The sequence that comes nearest stops at its last portal: a line would "
                 "have to keep the large left ends (discs) at its left and the large right ends "
                 "(squares) at its right, but %s.",
                 sl_sequence_reason(space, sequence));
}

void quiz_words(const learn_state *learn, char *text, size_t room) {
    const int judged = snprintf(text, room, "%s", judgement(learn));
    write_words(learn, text + judged, room - (size_t)judged);
    const size_t used = strlen(text);
    snprintf(text + used, room - used, "%s", words_of_effects(learn));
}

// --- drawing

void quiz_draw_below(learn_state *learn, const sl_frame *frame) {
    const quiz_state *q = &learn->quiz;
    if (!q->asked) return;
    // In other modes the colours of what is kept stay.
    if (learn->view->mode == MODE_QUIZ) {
        layers_draw_cell(learn->view, frame, q->from, TONE_FROM);
        layers_draw_cell(learn->view, frame, q->to, TONE_TO);
        return;
    }
    const sl_space *space = &learn->document->baked->space;
    sl_draw_cell(learn->ui->cairo, space, frame, q->from, tone_colour(learn->ui->dark, TONE_FROM),
                 0.15, 2 * frame->unit);
    sl_draw_cell(learn->ui->cairo, space, frame, q->to, tone_colour(learn->ui->dark, TONE_TO), 0.15,
                 3 * frame->unit);
}

void quiz_draw_above(learn_state *learn, const sl_frame *frame) {
    const quiz_state *q = &learn->quiz;
    if (!q->asked || !q->answered) return;
    sl_portal_ends ends[SL_DUAL_PORTALS_MOST] = {0};
    const sl_sequence *sequence = sequence_of(&q->explanation);
    const sl_directed_portal *directed = learn->view->present.space->directed;
    uint32_t count = 0;
    for (; sequence && count < sequence->directed_count && count < SL_DUAL_PORTALS_MOST; count++) {
        const sl_directed_portal *step = &directed[sequence->directed[count]];
        ends[count] = (sl_portal_ends){step->left, step->right};
    }
    const bool seen = q->explanation.verdict != SL_HIDDEN;
    sl_draw_portal_ends(learn->ui->cairo, &learn->ui->palette, frame, ends, count, !seen);
    if (!seen && sequence && sequence->directed_count <= SL_DUAL_PORTALS_MOST) {
        sl_conflict conflict = {.verdict = SL_HIDDEN,
                                .turns = q->explanation.misses[0].turns,
                                .end_count = sequence->end_count};
        memcpy(conflict.ends, sequence->ends, sizeof conflict.ends);
        sl_draw_conflict(learn->ui->cairo, &learn->ui->palette, frame, ends, &conflict);
    }
    if (quiz_is_bent(q)) {
        const sl_bent_sightline *bent = &q->explanation.bent;
        for (uint32_t i = 0; i <= bent->mirrors; i++)
            sl_draw_line(learn->ui->cairo, frame, bent->bends[i], bent->bends[i + 1],
                         learn->ui->palette.mirrored, 3 * frame->unit);
    }
    if (seen)
        sl_draw_line(learn->ui->cairo, frame, q->explanation.shown.a, q->explanation.shown.b,
                     learn->ui->palette.ink, 2.2 * frame->unit);
}
