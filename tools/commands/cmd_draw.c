/// `sightline draw`: a picture of a baked file.
#include "arguments/options.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "sightline/draw.h"
#include "sightline/support.h"
#include "system/built.h"

#include <stdio.h>
#include <string.h>

typedef struct layer {
    const char *name, *what;
    sl_layer bit;
} layer;

static const layer layers[] = {
    {"cells", "the cells and their outlines", SL_LAYER_CELLS},
    {"portals", "the portals between them", SL_LAYER_PORTALS},
    {"walls", "the walls", SL_LAYER_WALLS},
    {"pvs", "what the chosen cell sees, or how much each does", SL_LAYER_PVS},
    {"stab-tree", "the chosen cell's stab tree, from portal to portal", SL_LAYER_STAB_TREE},
    {"starts", "starts with their heading, and paths", SL_LAYER_STARTS},
    {"legend", "what the colours mean, and the counts", SL_LAYER_LEGEND},
    {"numbers", "the numbers of cells and portals, where they have room", SL_LAYER_NUMBERS},
};
enum { LAYER_COUNT = sizeof layers / sizeof *layers };
static const name_table layer_names = {"layer", layers, sizeof *layers, LAYER_COUNT, NULL};

typedef struct draw_plan {
    const char *input, *output, *cell, *at_text;
    sl_point at;
    unsigned layers; ///< numbers of the table above, as bits
    const char *layers_given;
    bool stab_tree;
    sl_draw_options drawing;
} draw_plan;

static sl_status make_plan(sl_context *context, draw_plan *plan) {
    if (!plan->output)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "-o is missing: name the picture, ending in .png, .svg or .pdf");
    if (plan->cell && plan->at_text)
        return sl_fail(context, SL_BAD_ARGUMENT, "--cell and --at both choose a cell; give one");
    if (plan->layers_given) plan->drawing.layers = 0;
    for (unsigned i = 0; i < LAYER_COUNT; i++)
        if (plan->layers >> i & 1) plan->drawing.layers |= (unsigned)layers[i].bit;
    if (plan->stab_tree) plan->drawing.layers |= SL_LAYER_STAB_TREE;
    return SL_OK;
}

/// Chooses a cell by number, by a point, or by the map's first start. "none": an overview.
static sl_status choose_cell(sl_context *context, const draw_plan *plan, const sl_baked *baked,
                             uint32_t *cell) {
    const sl_space *space = &baked->space;
    *cell = SL_NO_CELL;
    if (plan->cell && strcmp(plan->cell, "none") != 0) {
        uint64_t number = 0;
        SL_TRY(read_count(context, "--cell", plan->cell, space->cell_count - 1, &number));
        *cell = (uint32_t)number;
    } else if (plan->at_text) {
        SL_TRY(input_locate(context, "--at", plan->at_text, space, plan->at, cell));
    } else if (!plan->cell) {
        const size_t start = input_next_start(&baked->map, space, 0);
        if (start < baked->map.start_count)
            *cell = sl_space_locate(space, baked->map.starts[start].at);
    }
    return SL_OK;
}

static sl_status check_stab_tree(sl_context *context, const char *path, const sl_baked *baked,
                                 const sl_draw_options *options) {
    const sl_stab_trees *trees = &baked->visibility.trees;
    const uint32_t cell = options->cell;
    if (!(options->layers & SL_LAYER_STAB_TREE)) return SL_OK;
    if (!trees->cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: holds no stab trees; bake the map with --stab-trees", path);
    if (cell == SL_NO_CELL)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the stab tree is that of one cell; choose it by --cell or --at");
    if (trees->offsets[cell] == trees->offsets[cell + 1])
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: the stab tree of cell %u was left out; bake the map with more "
                       "--tree-memory",
                       path, (unsigned)cell);
    return SL_OK;
}

static sl_status draw(sl_context *context, draw_plan *plan, const sl_baked *baked) {
    SL_TRY(choose_cell(context, plan, baked, &plan->drawing.cell));
    SL_TRY(check_stab_tree(context, plan->input, baked, &plan->drawing));
    return built_pictures()->file(context, baked, &plan->drawing, plan->output);
}

static void print_layers(void) {
    const unsigned usual = built_draw_options().layers;
    puts("\nlayers (* without --layers):");
    for (size_t i = 0; i < LAYER_COUNT; i++)
        printf("  %-10s%c %s\n", layers[i].name, usual & (unsigned)layers[i].bit ? '*' : ' ',
               layers[i].what);
}

sl_status cmd_draw(command_console *console, int argc, char **argv) {
    draw_plan plan = {.drawing = built_draw_options()};
    const option_table picture = picture_option_table(&plan.drawing, "output", true);
    const option_spec options[] = {
        {"output", 'o', "PICTURE", "the picture: .png, .svg or .pdf", .text = &plan.output,
         .check = CHECK_PICTURE},
        {"cell", 0, "N", "show what this cell sees; 'none': how much each cell sees",
         .text = &plan.cell},
        {"at", 0, "X,Y", "show what the cell at a point sees (default: at the map's first start)",
         .point = &plan.at, .text = &plan.at_text},
        {"layers", 0, "LAYER,...", "what to draw (see '--help all')", .choices = &plan.layers,
         .names = layer_names, .given = &plan.layers_given},
        {"stab-tree", 0, NULL, "draw the stab tree of the chosen cell too",
         .flag = &plan.stab_tree},
        {.group = &picture},
    };
    const command_usage usage = {
        .name = "draw",
        .synopsis = "FILE.slv -o PICTURE [options]",
        .operands = {"FILE.slv"},
        .what = "Draws a baked file: its cells, portals and walls, and what one cell sees.",
        .tables = print_layers,
        .examples = "  sightline draw office.slv -o office.png\n"
                    "  sightline draw office.slv --at 3.5,2 --layers walls,pvs,legend -o seen.svg",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, &plan));
    sl_baked baked = {0};
    SL_TRY(input_read_baked(console->context, plan.input, &baked));
    const sl_status status = draw(console->context, &plan, &baked);
    sl_baked_destroy(console->context, &baked);
    return status;
}
