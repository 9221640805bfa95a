/// The lesson of the subdivision: the splits in the order in which they are made, by the kd-tree's
/// rules or by the BSP's cost.
#include "app.h"
#include "draw/sight.h"

#include <stdio.h>

static sl_status record(sl_context *context, sl_lesson *lesson, const sl_document *document,
                        uint32_t source) {
    (void)context;
    (void)source;
    lesson->split_count = document->splits.node_count;
    return SL_OK;
}

static size_t length(const sl_lesson *lesson) {
    return lesson->split_count;
}

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

static const char *const *code(const sl_lesson *lesson, const sl_document *document, size_t *count,
                               size_t *lit) {
    const bool is_bsp = document->baked->space.beyond != NULL;
    (void)lesson;
    *lit = 5; // every step is a split
    *count = is_bsp ? sizeof bsp_code / sizeof *bsp_code : sizeof kd_code / sizeof *kd_code;
    return is_bsp ? bsp_code : kd_code;
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

static void say(const sl_lesson *lesson, const sl_document *document, char text[SL_SENTENCE]) {
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

static void below(sl_app *app, const sl_frame *frame) {
    sl_draw_split(app->ui.cairo, &app->ui.palette, &app->document.splits, frame,
                  (uint32_t)app->lesson.at);
}

const sl_subject sl_lesson_subdivision = {
    .title = "Subdivision",
    .record = record,
    .length = length,
    .sentence = say,
    .code = code,
    .below = below,
};
