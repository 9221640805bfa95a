/// What the lesson says: pseudo-code and sentences.
#include "lesson.h"

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

static const char *const kd_code[] = {
    "subdivide(box):",
    "    if no wall is inside box: it is a cell",
    "    lines = those that hold a wall inside",
    "    keep walls that span, then well covered lines,",
    "        then those that cut the fewest walls",
    "    split at the one nearest to the median",
    "    subdivide(below), subdivide(above)",
};

static const char *const bsp_code[] = {
    "subdivide(cell):",
    "    if no wall is inside cell: it is done",
    "    for the lines of walls inside:",
    "        cost = walls that it cuts + imbalance",
    "            - share of it that walls cover",
    "    split along the cheapest; where its wall goes on,",
    "        split the cells there too",
    "    subdivide(right of it), subdivide(left of it)",
};

const char *const *sl_lesson_code(const sl_lesson *lesson, const sl_document *document,
                                  size_t *count) {
    static const struct {
        const char *const *lines;
        size_t count;
    } search = {search_code, sizeof search_code / sizeof *search_code},
      kd = {kd_code, sizeof kd_code / sizeof *kd_code},
      bsp = {bsp_code, sizeof bsp_code / sizeof *bsp_code};
    const bool is_bsp = document->baked && document->baked->space.beyond;
    const bool is_search = lesson->subject == SL_SUBJECT_SEARCH;
    *count = is_search ? search.count : is_bsp ? bsp.count : kd.count;
    return is_search ? search.lines : is_bsp ? bsp.lines : kd.lines;
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

static void name_line(const sl_space *space, const sl_node *node, char text[160]) {
    if (node->axis == 2) {
        const sl_segment *line = &space->lines[node->line];
        snprintf(text, 160, "from %.6g, %.6g to %.6g, %.6g", line->a.x, line->a.y, line->b.x,
                 line->b.y);
    } else {
        snprintf(text, 160, "%s = %.6g", node->axis == 0 ? "x" : "y", node->position);
    }
}

static void say_subdivision(const sl_lesson *lesson, const sl_document *document,
                            char text[SL_SENTENCE]) {
    const sl_space *space = &document->baked->space;
    const uint32_t at = (uint32_t)lesson->at;
    const sl_node *node = &space->nodes[at];
    const sl_splits *splits = &document->splits;
    const bool shown = splits->first[at] < splits->first[at + 1];
    const uint32_t depth = shown ? splits->splits.items[splits->first[at]].depth : 0;
    char line[160];
    name_line(space, node, line);
    snprintf(text, SL_SENTENCE,
             "Split %u of %u, %u deep: the line %s, of which walls cover %.0f %% here; %s.", at + 1,
             space->node_count, depth + 1, line, 100 * sl_splits_covered(splits, space, at),
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
        say_subdivision(lesson, document, text);
}
