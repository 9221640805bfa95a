/// The lesson of multipass: quadrant by quadrant of directions, the cells in the order in which
/// they are done, and what depends on what.
#include "lessons/learn.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <stdio.h>

static sl_status record(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source) {
    const sl_space *space = &document->baked->space;
    sli_sectors sectors;
    (void)source;
    SL_TRY(sli_sectors_create(context, space, PASSES, &sectors));
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < PASSES && status == SL_OK; i++)
        status = sli_pass_create(context, space, false, sli_sectors_get(&sectors, i),
                                 &lesson->passes[i]);
    sli_sectors_destroy(context, &sectors);
    if (status == SL_OK) lesson->pass_cells = space->cell_count;
    return status;
}

static size_t length(const lesson_state *lesson) {
    return (size_t)PASSES * lesson->pass_cells;
}

static const sli_pass *pass_of(const lesson_state *lesson) {
    return &lesson->passes[lesson->at / lesson->pass_cells];
}

/// How many cells of the pass come before the step.
static uint32_t place_of(const lesson_state *lesson) {
    return (uint32_t)(lesson->at % lesson->pass_cells);
}

/// How many cells are on a cycle with this one, itself included; 1 for no cycle.
static uint32_t on_cycle(const sli_pass *pass, uint32_t cell) {
    const uint32_t component = pass->order.component[cell];
    return pass->order.starts[component + 1] - pass->order.starts[component];
}

static void say(const lesson_state *lesson, const document_state *document, char text[SENTENCE]) {
    static const char *const towards[PASSES] = {"Right and up", "Left and up", "Left and down",
                                                "Right and down"};
    (void)document;
    const sli_pass *pass = pass_of(lesson);
    const uint32_t cell = pass->order.nodes[place_of(lesson)];
    const uint32_t faces = pass->first[cell + 1] - pass->first[cell];
    const uint32_t cycle = on_cycle(pass, cell);
    const int length =
        snprintf(text, SENTENCE, "%s, %u of %u: ", towards[lesson->at / lesson->pass_cells],
                 place_of(lesson) + 1, lesson->pass_cells);
    text += length;
    const size_t room = SENTENCE - (size_t)length;
    if (cycle > 1)
        snprintf(text, room,
                 "cell %u is on a cycle with %u more: they are each other's candidates.", cell,
                 cycle - 1);
    else if (faces)
        snprintf(text, room,
                 "cell %u has the sets of the cells behind its %u face%s for candidates.", cell,
                 faces, faces == 1 ? "" : "s");
    else
        snprintf(text, room, "no sightline leaves cell %u that way; it sees itself.", cell);
}

static const char *const lines[] = {
    "for each quadrant of directions:",
    "    for each cell that depends on none, and then",
    "            on none but those that are done:",
    "        its set = the cell itself",
    "        for each face that sightlines leave by:",
    "            candidates = the set of the cell behind it",
    "            its set += those seen through the face",
    "what a cell sees = its sets of all quadrants",
};

static const char *const *code(const lesson_state *lesson, const document_state *document,
                               size_t *count, size_t *lit) {
    (void)document;
    const sli_pass *pass = pass_of(lesson);
    const uint32_t cell = pass->order.nodes[place_of(lesson)];
    *lit = pass->first[cell] < pass->first[cell + 1] ? 5 : 3;
    *count = sizeof lines / sizeof *lines;
    return lines;
}

static void account(const lesson_state *lesson, char text[SENTENCE]) {
    const sli_pass *pass = pass_of(lesson);
    snprintf(text, SENTENCE,
             "%u of %u cells done in this quadrant; %u dependences, %u levels of cells that can be "
             "done at the same time.",
             place_of(lesson), lesson->pass_cells, pass->face_count, pass->order.level_count);
}

/// Draws the cells that are done, the present one, and those behind its faces.
static void below(learn_state *learn, const sl_frame *frame) {
    const sl_space *space = &learn->document->baked->space;
    const sl_palette *palette = &learn->ui->palette;
    const sli_pass *pass = pass_of(&learn->lesson);
    const uint32_t place = place_of(&learn->lesson), cell = pass->order.nodes[place];
    for (uint32_t i = 0; i < place; i++)
        sl_draw_cell(learn->ui->cairo, space, frame, pass->order.nodes[i], palette->glass, 0.18,
                     frame->unit);
    for (uint32_t face = pass->first[cell]; face < pass->first[cell + 1]; face++)
        sl_draw_cell(learn->ui->cairo, space, frame, pass->to[face], palette->source, 0.45,
                     2 * frame->unit);
    sl_draw_cell(learn->ui->cairo, space, frame, cell, palette->source_edge, 0.55, 2 * frame->unit);
}

/// From a cell through the middle of each of its faces to the cell behind.
static void draw_dependences(learn_state *learn, const sl_frame *frame, uint32_t cell,
                             sl_colour colour, double width) {
    const sl_space *space = &learn->document->baked->space;
    const sli_pass *pass = pass_of(&learn->lesson);
    const sl_cell *c = &space->cells[cell];
    const sl_point from = sl_space_middle(space, cell);
    for (uint32_t i = c->first_directed; i < c->first_directed + c->directed_count; i++) {
        if (pass->faces[i] == SLI_NO_FACE) continue;
        const sl_directed_portal *directed = &space->directed[i];
        const sl_point through = {(directed->left.x + directed->right.x) / 2,
                                  (directed->left.y + directed->right.y) / 2};
        sl_draw_line(learn->ui->cairo, frame, from, through, colour, width);
        sl_draw_line(learn->ui->cairo, frame, through, sl_space_middle(space, directed->cell),
                     colour, width);
    }
}

static void above(learn_state *learn, const sl_frame *frame) {
    const sl_palette *palette = &learn->ui->palette;
    const sli_pass *pass = pass_of(&learn->lesson);
    const uint32_t place = place_of(&learn->lesson);
    for (uint32_t i = 0; i < pass->order.count; i++)
        draw_dependences(learn, frame, pass->order.nodes[i],
                         i < place ? palette->glass : palette->faint, 0.8 * frame->unit);
    draw_dependences(learn, frame, pass->order.nodes[place], palette->start, 2.5 * frame->unit);
}

static uint32_t cell_of(const lesson_state *lesson, size_t step) {
    const sli_pass *pass = &lesson->passes[step / lesson->pass_cells];
    return pass->order.nodes[step % lesson->pass_cells];
}

/// A cell on a cycle.
static bool finds(const lesson_state *lesson, size_t step) {
    return on_cycle(&lesson->passes[step / lesson->pass_cells], cell_of(lesson, step)) > 1;
}

const subject_row lesson_pass = {
    .title = "Multipass",
    .record = record,
    .length = length,
    .sentence = say,
    .code = code,
    .account = account,
    .cell = cell_of,
    .finds = finds,
    .found = "Cycle",
    .below = below,
    .above = above,
};
