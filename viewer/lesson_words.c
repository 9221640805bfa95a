/// What the lesson says: pseudo-code and sentences.
#include "lesson.h"

#include <math.h>
#include <stdio.h>

static const char *const search_code[] = {
    "search(cell, sequence):",
    "    cell is seen",
    "    for each portal out of cell:",
    "        if it goes back: pass it over",
    "        if no line stabs sequence + portal:",
    "            pass it over",
    "        search(cell behind, sequence + portal)",
    "    return",
};

static const char *const subdivide_code[] = {
    "subdivide(box):",
    "    if no wall is inside box: it is a cell",
    "    lines = those that hold a wall inside",
    "    keep walls that span, then well covered lines,",
    "        then those that cut the fewest walls",
    "    split at the one nearest to the median",
    "    subdivide(below), subdivide(above)",
};

const char *const *sl_lesson_code(const sl_lesson *lesson, size_t *count) {
    const bool search = lesson->subject == SL_SUBJECT_SEARCH;
    *count = search ? sizeof search_code / sizeof *search_code
                    : sizeof subdivide_code / sizeof *subdivide_code;
    return search ? search_code : subdivide_code;
}

size_t sl_lesson_code_line(const sl_lesson *lesson) {
    if (lesson->subject == SL_SUBJECT_SUBDIVISION) return 5;
    if (!lesson->steps.count) return 0;
    switch (lesson->steps.steps[lesson->at].kind) {
    case SL_STEP_ENTER:
        return lesson->at ? 6 : 1;
    case SL_STEP_BACKWARDS:
        return 3;
    case SL_STEP_HIDDEN:
        return 5;
    case SL_STEP_LEAVE:
        break;
    }
    return 7;
}

static void say_search(const sl_lesson *lesson, char text[SL_SENTENCE]) {
    const sl_step *s = &lesson->steps.steps[lesson->at];
    const uint32_t here = lesson->steps.steps[s->parent].cell;
    const char *plural = s->depth == 1 ? "" : "s";
    switch (s->kind) {
    case SL_STEP_ENTER:
        if (!lesson->at)
            snprintf(text, SL_SENTENCE, "The search starts in cell %u, which sees itself.",
                     s->cell);
        else
            snprintf(text, SL_SENTENCE, "A line %s the %u portal%s: enter cell %u, %s.",
                     s->grazing ? "only grazes" : "stabs", s->depth, plural, s->cell,
                     s->first ? "seen for the first time" : "already seen another way");
        return;
    case SL_STEP_BACKWARDS:
        snprintf(text, SL_SENTENCE,
                 "The portal from cell %u to cell %u goes back against the sequence: passed over.",
                 here, s->cell);
        return;
    case SL_STEP_HIDDEN:
        snprintf(text, SL_SENTENCE,
                 "No line stabs the %u portal%s to cell %u: its half-planes leave nothing.",
                 s->depth, plural, s->cell);
        return;
    case SL_STEP_LEAVE:
        if (s->depth)
            snprintf(text, SL_SENTENCE, "All portals of cell %u are tried: back one portal.",
                     s->cell);
        else
            snprintf(text, SL_SENTENCE, "All portals of cell %u are tried: it sees %u cells.",
                     s->cell, s->seen);
        return;
    }
}

/// The share of a split, within its box, that walls cover.
static double covered(const sl_space *space, const sl_node *node, sl_box box) {
    double sum = 0;
    const bool upright = node->axis == 0;
    const double low = upright ? box.min.y : box.min.x, high = upright ? box.max.y : box.max.x;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        const double place_a = upright ? w->a.x : w->a.y, place_b = upright ? w->b.x : w->b.y;
        if (place_a != node->position || place_b != node->position) continue;
        const double a = upright ? w->a.y : w->a.x, b = upright ? w->b.y : w->b.x;
        sum += fmax(0, fmin(fmax(a, b), high) - fmax(fmin(a, b), low));
    }
    return high > low ? sum / (high - low) : 0;
}

static void say_subdivision(const sl_lesson *lesson, const sl_space *space,
                            char text[SL_SENTENCE]) {
    const sl_node *node = &space->nodes[lesson->at];
    snprintf(text, SL_SENTENCE,
             "Split %zu of %u, %u deep: the line %s = %g, of which walls cover %.0f %% here; %s.",
             lesson->at + 1, space->node_count, lesson->depths[lesson->at] + 1,
             node->axis == 0 ? "x" : "y", node->position,
             100 * covered(space, node, lesson->boxes[lesson->at]),
             node->below < 0 && node->above < 0   ? "both sides are cells"
             : node->below < 0 || node->above < 0 ? "one side is a cell, the other goes on"
                                                  : "both sides go on");
}

void sl_lesson_sentence(const sl_lesson *lesson, const sl_document *document,
                        char text[SL_SENTENCE]) {
    text[0] = '\0';
    if (!sl_lesson_length(lesson) || lesson->version != document->version) return;
    if (lesson->subject == SL_SUBJECT_SEARCH)
        say_search(lesson, text);
    else
        say_subdivision(lesson, &document->baked->space, text);
}
