/// `sightline explain`: why a cell does or does not see another.
#include "arguments/names.h"
#include "arguments/options.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "reports/explain_text.h"
#include "sightline/draw.h"
#include "sightline/support.h"
#include "system/built.h"

#include <string.h>

typedef struct explain_plan {
    const char *operands[3], *output;
    door_choice doors;
    sl_explain_options options;
    const char *sight_given; ///< else sight is as the file was baked
    uint32_t mirror_depth;
    sl_draw_options drawing;
    bool json;
} explain_plan;

enum { FILE_OPERAND, FROM_OPERAND, TO_OPERAND };

/// A cell by its number or by a point in it.
static sl_status choose_cell(sl_context *context, const char *name, const char *text,
                             const sl_space *space, uint32_t *cell) {
    if (!strchr(text, ',')) {
        uint64_t number = 0;
        if (read_count(context, name, text, space->cell_count - 1, &number) != SL_OK)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "%s %s: a cell from 0 to %u, or a point X,Y, is needed", name, text,
                           (unsigned)space->cell_count - 1);
        *cell = (uint32_t)number;
        if (!space->cells[*cell].solid) return SL_OK;
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s %s: the cell is solid ground; choose a cell in a room", name, text);
    }
    sl_point at = {0};
    SL_TRY(read_point(context, name, text, &at));
    return input_locate(context, name, text, space, at, cell);
}

/// Draws the pair as it is; where effects hide it, the line that they stop.
static sl_status draw(sl_context *context, const explain_plan *plan, const sl_explained *a) {
    const sl_explanation *e = a->e.direct.without ? &a->e.without : &a->e.now;
    return built_pictures()->explanation(context, a->baked, e, &plan->drawing, plan->output);
}

static sl_status tell(command_console *console, const explain_plan *plan, const sl_explained *a) {
    sl_context *context = console->context;
    const sl_status drawn = plan->output ? draw(context, plan, a) : SL_OK;
    progress_line_clear(&console->line);
    SL_TRY(drawn);
    // A write that fails shows when the program checks its stdout at the end.
    if (plan->json) return sl_explained_json(context, a, stdout);
    bool *scratch = sl_alloc_array(context, a->baked->map.door_count, sizeof *scratch);
    if (!scratch) return SL_NO_MEMORY;
    explanation_print(a, scratch);
    sl_free(context, scratch);
    return SL_OK;
}

static sl_status explain(command_console *console, const explain_plan *plan, sl_baked *baked,
                         bool *shut, sl_explained *a) {
    sl_context *context = console->context;
    const sl_space *space = &baked->space;
    sl_explain_options options = plan->options;
    uint32_t from, to;
    if (!plan->sight_given) options.sight = baked->visibility.sight;
    SL_TRY(choose_cell(context, "A", plan->operands[FROM_OPERAND], space, &from));
    SL_TRY(choose_cell(context, "B", plan->operands[TO_OPERAND], space, &to));
    SL_TRY(doors_read(context, &plan->doors, &baked->map, shut));
    for (size_t i = 0; i < baked->map.door_count; i++) baked->map.doors[i].open = !shut[i];
    const sl_explain_state state = {shut, plan->mirror_depth};
    SL_TRY(sl_explain_effects(context, space, &baked->map, &state, &options, from, to, &a->e));
    return tell(console, plan, a);
}

sl_status cmd_explain(command_console *console, int argc, char **argv) {
    explain_plan plan = {.options = sl_explain_options_default(),
                         .mirror_depth = 1,
                         .drawing = built_draw_options()};
    const option_table picture = picture_option_table(&plan.drawing, "output", false);
    const option_table doors = door_option_table(&plan.doors);
    const option_spec options[] = {
        {"output", 'o', "PICTURE", "draw the answer: .png, .svg or .pdf", .text = &plan.output,
         .check = CHECK_PICTURE},
        {.group = &doors},
        {"json", 0, NULL, "print the answer as one JSON object", .flag = &plan.json},
        {"misses", 0, "N", "number of sequences to show that come far but fail (default 3)",
         .count32 = &plan.options.most_misses},
        {"tests", 0, "N", "stop after N stabbing tests, and print what is known",
         .count = &plan.options.most_tests},
        {"sight", 0, "closed|open",
         "whether lines that only touch wall ends count: closed: yes; open: no (default: as baked)",
         .sight = &plan.options.sight, .given = &plan.sight_given},
        {"mirror-depth", 0, "N", "largest number of reflections, up to 16 (default 1)",
         .count32 = &plan.mirror_depth, .most = 16},
        {.group = &picture},
    };
    const command_usage usage = {
        .name = "explain",
        .synopsis = "FILE.slv A B [options]",
        .operands = {"FILE.slv", "A", "B"},
        .what =
            "Explains why cell A sees cell B: a line and the portals that it passes. Or why not: "
            "what stops the sequences of portals that come farthest. The answer is exact, by "
            "whatever solver the file was baked. If a door, one-way glass or the view range "
            "decides, the answer names it. A and B are numbers of cells or points X,Y (after "
            "'--' if X is negative).",
        .examples = "  sightline explain office.slv 12 40\n"
                    "  sightline explain office.slv 53,20 3.5,2 -o why.png",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, plan.operands, &helped));
    if (helped) return SL_OK;
    sl_baked baked = {0};
    SL_TRY(input_read_baked(console->context, plan.operands[FILE_OPERAND], &baked));
    bool *shut = sl_alloc_array(console->context, baked.map.door_count, sizeof *shut);
    sl_explained a = {.baked = &baked, .shut = shut};
    const sl_status status = shut ? explain(console, &plan, &baked, shut, &a) : SL_NO_MEMORY;
    sl_effect_explanation_destroy(console->context, &a.e);
    sl_free(console->context, shut);
    sl_baked_destroy(console->context, &baked);
    return status;
}
