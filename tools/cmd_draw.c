#include "commands.h"
#include "inputs.h"
#include "options.h"
#include "outputs.h"
#include "sightline/draw.h"
#include "sightline/support.h"

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
};
enum { LAYER_COUNT = sizeof layers / sizeof *layers };
static const sl_name_table layer_names = {"layer", layers, sizeof *layers, LAYER_COUNT};

/// The options as they are given.
typedef struct draw_texts {
    const char *input, *output, *cell, *at, *layers, *width, *title;
    bool stab_tree, dark;
} draw_texts;

static sl_status choose_layers(sl_context *context, const draw_texts *texts,
                               sl_draw_options *options) {
    unsigned chosen = 0;
    SL_TRY(sl_option_choices(context, "--layers", texts->layers, &layer_names, &chosen));
    if (texts->layers) {
        options->layers = 0;
        for (unsigned i = 0; i < LAYER_COUNT; i++)
            if (chosen >> i & 1) options->layers |= (unsigned)layers[i].bit;
    }
    if (texts->stab_tree) options->layers |= SL_LAYER_STAB_TREE;
    return SL_OK;
}

static sl_status read_options(sl_context *context, const draw_texts *texts,
                              sl_draw_options *options) {
    if (!texts->output)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "-o is missing: name the picture, ending in .png, .svg or .pdf");
    SL_TRY(sl_picture_check(context, texts->input, "-o", texts->output));
    if (texts->cell && texts->at)
        return sl_fail(context, SL_BAD_ARGUMENT, "--cell and --at both choose a cell; give one");
    SL_TRY(sl_picture_plan(context, texts->width, texts->title, texts->dark, options));
    return choose_layers(context, texts, options);
}

/// By number, by a point, or by the map's first start; "none" for an overview.
static sl_status choose_cell(sl_context *context, const draw_texts *texts, const sl_baked *baked,
                             uint32_t *cell) {
    const sl_space *space = &baked->space;
    *cell = SL_NO_CELL;
    if (texts->cell && strcmp(texts->cell, "none") != 0) {
        uint64_t number = 0;
        SL_TRY(sl_option_count(context, "--cell", texts->cell, space->cell_count - 1, &number));
        *cell = (uint32_t)number;
    } else if (texts->at) {
        sl_point at = {0};
        SL_TRY(sl_option_point(context, "--at", texts->at, &at));
        *cell = sl_space_locate(space, at);
        if (*cell == SL_NO_CELL)
            return sl_input_fail_outside(context, "--at", texts->at, space->bounds);
    } else if (!texts->cell && baked->map.start_count) {
        *cell = sl_space_locate(space, baked->map.starts[0].at);
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

static sl_status draw(sl_context *context, const draw_texts *texts, const sl_baked *baked,
                      sl_draw_options *options) {
    SL_TRY(choose_cell(context, texts, baked, &options->cell));
    SL_TRY(check_stab_tree(context, texts->input, baked, options));
    return sl_draw_file(context, baked, options, texts->output);
}

static void print_layers(void) {
    const unsigned usual = sl_draw_options_default().layers;
    puts("\nlayers (* without --layers):");
    for (size_t i = 0; i < LAYER_COUNT; i++)
        printf("  %-10s%c %s\n", layers[i].name, usual & (unsigned)layers[i].bit ? '*' : ' ',
               layers[i].what);
}

sl_status sl_cmd_draw(sl_console *console, int argc, char **argv) {
    draw_texts t = {0};
    const sl_option_spec options[] = {
        {"output", 'o', "PICTURE", NULL, &t.output,
         "where to draw: .png, .svg or .pdf, by the ending"},
        {"cell", 0, "N", NULL, &t.cell,
         "choose a cell by its number; none for an overview:\nhow much each cell sees"},
        {"at", 0, "X,Y", NULL, &t.at,
         "choose the cell at a point; with neither, the cell\nof the map's first start, if any"},
        {"layers", 0, "LAYER,...", NULL, &t.layers, "what to draw"},
        {"stab-tree", 0, NULL, &t.stab_tree, NULL, "draw the chosen cell's stab tree too"},
        {"width", 0, "PX", NULL, &t.width, "of the picture, 64 to 20000 pixels or points"},
        {"dark", 0, NULL, &t.dark, NULL, "light on dark"},
        {"title", 0, "TEXT", NULL, &t.title, "a line over the picture"},
    };
    const sl_command_usage usage = {
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
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &t.input, &helped));
    if (helped) return SL_OK;
    sl_draw_options drawing;
    SL_TRY(read_options(console->context, &t, &drawing));
    sl_baked baked = {0};
    SL_TRY(sl_input_read_baked(console->context, t.input, &baked));
    const sl_status status = draw(console->context, &t, &baked, &drawing);
    sl_baked_destroy(console->context, &baked);
    return status;
}
