#include "commands.h"
#include "explain_report.h"
#include "inputs.h"
#include "options.h"
#include "pictures.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <string.h>

/// The operands and options as they are given.
typedef struct explain_texts {
    const char *operands[3], *output, *width, *sight, *misses, *tests, *mirror_depth;
    bool dark, json;
} explain_texts;

enum { FILE_OPERAND, FROM_OPERAND, TO_OPERAND };

/// A cell by its number or by a point in it.
static sl_status choose_cell(sl_context *context, const char *name, const char *text,
                             const sl_space *space, uint32_t *cell) {
    if (!strchr(text, ',')) {
        uint64_t number = 0;
        if (sl_option_count(context, name, text, space->cell_count - 1, &number) != SL_OK)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "%s %s: a cell from 0 to %u, or a point X,Y, is needed", name, text,
                           (unsigned)space->cell_count - 1);
        *cell = (uint32_t)number;
        return SL_OK;
    }
    sl_point at = {0};
    SL_TRY(sl_option_point(context, name, text, &at));
    *cell = sl_space_locate(space, at);
    return *cell == SL_NO_CELL ? sl_input_fail_outside(context, name, text, space->bounds) : SL_OK;
}

static sl_status read_options(sl_context *context, const explain_texts *texts,
                              const sl_baked *baked, sl_explain_options *options) {
    const sl_name_table sights = sl_sight_table();
    *options = sl_explain_options_default();
    size_t sight = baked->visibility.sight;
    uint64_t misses = options->most_misses;
    SL_TRY(sl_option_choice(context, "--sight", texts->sight, &sights, &sight));
    SL_TRY(sl_option_count(context, "--misses", texts->misses, UINT32_MAX, &misses));
    SL_TRY(sl_option_count(context, "--tests", texts->tests, UINT64_MAX, &options->most_tests));
    options->sight = (sl_sight)sight;
    options->most_misses = (uint32_t)misses;
    return SL_OK;
}

static sl_status explain(sl_console *console, const explain_texts *texts, const sl_baked *baked,
                         const sl_draw_options *drawing) {
    sl_context *context = console->context;
    const sl_space *space = &baked->space;
    sl_explain_options options;
    uint32_t from, to;
    SL_TRY(read_options(context, texts, baked, &options));
    SL_TRY(choose_cell(context, "A", texts->operands[FROM_OPERAND], space, &from));
    SL_TRY(choose_cell(context, "B", texts->operands[TO_OPERAND], space, &to));
    sl_explanation explanation;
    uint64_t depth = 1;
    SL_TRY(sl_option_count(context, "--mirror-depth", texts->mirror_depth, 16, &depth));
    SL_TRY(sl_explain(context, space, &options, from, to, &explanation));
    sl_status status = SL_OK;
    if (baked->map.mirror_count)
        status = sl_explain_by_mirror(context, space, &baked->map, &options, (uint32_t)depth,
                                      &explanation);
    if (status == SL_OK && texts->output)
        status = sl_draw_explanation(context, baked, &explanation, drawing, texts->output);
    sl_progress_line_clear(&console->line);
    if (status == SL_OK && texts->json)
        status = sl_explanation_print_json(context, baked, &explanation);
    else if (status == SL_OK)
        sl_explanation_print(baked, &explanation);
    sl_explanation_destroy(context, &explanation);
    return status;
}

sl_status sl_cmd_explain(sl_console *console, int argc, char **argv) {
    explain_texts t = {0};
    const sl_option_spec options[] = {
        {"sight", 0, "closed|open", NULL, &t.sight,
         "whether lines count that touch portal ends;\nwithout it, as the file was baked"},
        {"misses", 0, "N", NULL, &t.misses,
         "of a hidden pair, how many sequences to tell of\nthat came far; 3 without it"},
        {"tests", 0, "N", NULL, &t.tests, "give up after N stabbing tests, and tell what is known"},
        {"mirror-depth", 0, "N", NULL, &t.mirror_depth,
         "how often mirrors reflect a sightline, 0 to 16;\n1 without it"},
        {"output", 'o', "PICTURE", NULL, &t.output,
         "draw it too: .png, .svg or .pdf, by the ending"},
        {"width", 0, "PX", NULL, &t.width, "of the picture, 64 to 20000 pixels or points"},
        {"dark", 0, NULL, &t.dark, NULL, "the picture light on dark"},
        {"json", 0, NULL, &t.json, NULL, "print JSON"},
    };
    const sl_command_usage usage = {
        .name = "explain",
        .synopsis = "FILE.slv A B [options]",
        .operands = {"FILE.slv", "A", "B"},
        .what = "Tells why cell A does or does not see cell B: a line and the portals that it "
                "passes, or\nwhat stops the sequences of portals that come farthest. Exact, "
                "whatever the file's solver.\nA and B are numbers of cells, or points X,Y in them "
                "(after -- where X is negative).",
        .examples = "  sightline explain office.slv 12 40\n"
                    "  sightline explain office.slv 53,20 3.5,2 -o why.png",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, t.operands, &helped));
    if (helped) return SL_OK;
    const char *input = t.operands[FILE_OPERAND];
    sl_draw_options drawing;
    SL_TRY(sl_picture_plan(console->context, t.width, NULL, t.dark, &drawing));
    SL_TRY(sl_picture_check(console->context, input, "-o", t.output));
    sl_baked baked = {0};
    SL_TRY(sl_input_read_baked(console->context, input, &baked));
    sl_status status = sl_effects_check(console->context, &baked.map, "explain", SL_EFFECT_MIRROR);
    if (status == SL_OK) status = explain(console, &t, &baked, &drawing);
    sl_baked_destroy(console->context, &baked);
    return status;
}
