#include "bake_report.h"
#include "base/base.h"
#include "commands.h"
#include "effects.h"
#include "inputs.h"
#include "options.h"
#include "solvers.h"

#include <string.h>

enum { MAX_THREADS = 4096, MAX_SOLVERS = 16 };

/// The options as they are given.
typedef struct bake_texts {
    const char *output, *subdivide, *method, *solver, *sight, *threads, *tree_memory, *slice,
        *start, *without, *kd_obscured, *kd_rules;
    bool stab_trees, inside, check, json;
} bake_texts;

/// The options as they are meant.
typedef struct bake_plan {
    const char *input, *output, *slice, *start;
    const sl_see_method *method;
    const char *subdivide;
    unsigned without; // bits of sl_effect_table()
    sl_subdivide_options subdivide_options;
    sl_see_options see;
    bool check, json;
    bool named_by_map; // no -o was given
} bake_plan;

typedef struct subdivider {
    const char *name, *what;
} subdivider;

static const subdivider subdividers[] = {
    {"kd", "kd-tree on the walls' own lines; walls must be axial"},
};
static const sl_name_table subdivider_names = {"subdivision", subdividers, sizeof *subdividers, 1};

static const char *const kd_rules[] = {"spanning", "obscured", "cleaving", "median"};
enum { SPANNING = 1, OBSCURED = 2, CLEAVING = 4, MEDIAN = 8, ALL_RULES = 15 };
static const sl_name_table kd_rule_names = {"rule", kd_rules, sizeof *kd_rules, 4};

// --- reading the options

static sl_status plan_subdivision(sl_context *context, const bake_texts *texts, bake_plan *plan) {
    size_t subdivide = 0;
    unsigned rules = ALL_RULES;
    SL_TRY(
        sl_option_choice(context, "--subdivide", texts->subdivide, &subdivider_names, &subdivide));
    SL_TRY(sl_option_choices(context, "--kd-rules", texts->kd_rules, &kd_rule_names, &rules));
    sl_subdivide_options *options = &plan->subdivide_options;
    *options = sl_subdivide_options_default();
    SL_TRY(sl_option_number(context, "--kd-obscured", texts->kd_obscured, &options->obscured));
    if (options->obscured < 0 || options->obscured > 1)
        return sl_fail(context, SL_BAD_ARGUMENT, "--kd-obscured %s: a share from 0 to 1 is needed",
                       texts->kd_obscured);
    if (texts->kd_obscured && !(rules & OBSCURED))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--kd-obscured needs the rule 'obscured', which --kd-rules leaves out");
    if (texts->kd_rules) {
        options->spanning = rules & SPANNING;
        if (!(rules & OBSCURED)) options->obscured = 0;
        options->cleaving = rules & CLEAVING;
        options->median = rules & MEDIAN;
    }
    plan->subdivide = subdividers[subdivide].name;
    return SL_OK;
}

/// The solver by name, or the first.
static sl_status plan_solver(sl_context *context, const char *text, bake_plan *plan) {
    if (text && !plan->method->stabs)
        return sl_fail(context, SL_BAD_ARGUMENT, "--solver: the method '%s' uses none",
                       plan->method->name);
    if (!plan->method->stabs) return SL_OK;
    sl_solver solvers[MAX_SOLVERS]; // copies, for the table of names
    sl_name_table names = {"solver", solvers, sizeof *solvers, 0};
    while (names.count < MAX_SOLVERS && sl_solver_at(names.count)) {
        solvers[names.count] = *sl_solver_at(names.count);
        names.count++;
    }
    size_t chosen = 0;
    SL_TRY(sl_option_choice(context, "--solver", text, &names, &chosen));
    plan->see.solver = sl_solver_at(chosen);
    return SL_OK;
}

static sl_status plan_seeing(sl_context *context, const bake_texts *texts, bake_plan *plan) {
    size_t method = 0, sight = SL_CLOSED, count;
    uint64_t threads = 0, tree_bytes = (uint64_t)256 << 20;
    const sl_see_method *methods = sl_see_methods(&count);
    const sl_name_table method_names = {"method", methods, sizeof *methods, count};
    const sl_name_table sight_names = sl_sight_table();
    SL_TRY(sl_option_choice(context, "--method", texts->method, &method_names, &method));
    SL_TRY(sl_option_choice(context, "--sight", texts->sight, &sight_names, &sight));
    SL_TRY(sl_option_count(context, "--threads", texts->threads, MAX_THREADS, &threads));
    SL_TRY(sl_option_size(context, "--tree-memory", texts->tree_memory, &tree_bytes));
    if (texts->tree_memory && !texts->stab_trees)
        return sl_fail(context, SL_BAD_ARGUMENT, "--tree-memory needs --stab-trees");
    plan->method = &methods[method];
    plan->see = sl_see_options_default();
    plan->see.sight = (sl_sight)sight;
    plan->see.threads = (unsigned)threads;
    plan->see.trees = texts->stab_trees;
    plan->see.tree_bytes = tree_bytes;
    plan->see.inside_only = texts->inside;
    return plan_solver(context, texts->solver, plan);
}

/// "maps/office.map" gives "office.slv"; the name belongs to the caller.
static sl_status name_output(sl_context *context, const char *input, char **name) {
    const char *slash = strrchr(input, '/');
    const char *base = slash ? slash + 1 : input;
    const char *dot = strrchr(base, '.');
    const size_t length = dot && dot > base ? (size_t)(dot - base) : strlen(base);
    *name = sl_alloc(context, length + sizeof ".slv");
    if (!*name) return SL_NO_MEMORY;
    memcpy(*name, base, length);
    memcpy(*name + length, ".slv", sizeof ".slv");
    return SL_OK;
}

static sl_status make_plan(sl_context *context, const bake_texts *texts, bake_plan *plan) {
    if (texts->output && !sl_input_ends_with(texts->output, ".slv"))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "-o %s: the name of a baked file ends in .slv, by which it is known",
                       texts->output);
    const sl_name_table effects = sl_effect_table();
    SL_TRY(sl_option_choices(context, "--without", texts->without, &effects, &plan->without));
    SL_TRY(plan_subdivision(context, texts, plan));
    SL_TRY(plan_seeing(context, texts, plan));
    plan->output = texts->output;
    plan->slice = texts->slice;
    plan->start = texts->start;
    plan->json = texts->json;
#ifdef NDEBUG
    plan->check = texts->check;
#else
    plan->check = true;
#endif
    return SL_OK;
}

// --- the work

/// Seconds since *last, which is set to now.
static double lap(double *last) {
    const double before = *last;
    *last = sl_now();
    return *last - before;
}

/// What a baked file keeps of the map: all but the walls, which the space has.
static void keep_rest_of_map(sl_context *context, sl_map *map, sl_baked *baked) {
    sl_free(context, map->walls);
    map->walls = NULL;
    map->wall_count = map->wall_room = 0;
    baked->map = *map;
    *map = (sl_map){0};
}

static sl_status add_start(sl_context *context, const bake_plan *plan, sl_map *map) {
    if (!plan->start) return SL_OK;
    sl_point at = {0};
    SL_TRY(sl_option_point(context, "--start", plan->start, &at));
    const sl_box b = sl_map_bounds(map);
    if (at.x < b.min.x || at.x > b.max.x || at.y < b.min.y || at.y > b.max.y)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--start %s: outside the map; sightline info %s tells its bounds",
                       plan->start, plan->input);
    return sl_map_add_start(context, map, at, 0, 0);
}

static sl_status read_and_clean(sl_context *context, const bake_plan *plan, sl_map *map,
                                sl_bake_report *report) {
    SL_TRY(sl_input_read_map(context, plan->input, plan->slice, map));
    SL_TRY(add_start(context, plan, map));
    sl_effects_leave_out(context, map, plan->without);
    SL_TRY(sl_effects_check(context, map, plan->method->name));
    return sl_map_clean(context, map, &report->cleaning);
}

static sl_status subdivide(sl_context *context, const bake_plan *plan, sl_map *map,
                           sl_bake_report *report, sl_space *space, double *time) {
    SL_TRY(sl_subdivide_kd(context, map, &plan->subdivide_options, space));
    report->seconds.subdivide = lap(time);
    if (plan->check) SL_TRY(sl_space_check(context, space));
    report->seconds.check = lap(time);
    report->checked = plan->check;
    return SL_OK;
}

static sl_status bake(sl_context *context, const bake_plan *plan, sl_map *map, sl_baked *baked,
                      sl_bake_report *report) {
    double time = sl_now();
    SL_TRY(read_and_clean(context, plan, map, report));
    report->seconds.read = lap(&time);
    SL_TRY(subdivide(context, plan, map, report, &baked->space, &time));
    keep_rest_of_map(context, map, baked);
    SL_TRY(plan->method->see(context, &baked->space, &plan->see, &baked->visibility));
    report->seconds.cell_to_cell = lap(&time);
    snprintf(baked->method, sizeof baked->method, "%s", plan->method->name);
    if (plan->see.solver)
        snprintf(baked->solver, sizeof baked->solver, "%s", plan->see.solver->name);
    if (plan->named_by_map) sl_note(context, "writing %s, as no -o is given", plan->output);
    SL_TRY(sl_baked_write(context, baked, plan->output));
    report->seconds.write = lap(&time);
    return SL_OK;
}

static sl_status bake_and_report(sl_console *console, const bake_plan *plan) {
    sl_context *context = console->context;
    sl_map map = {0};
    sl_baked baked = {0};
    sl_bake_report report = {.input = plan->input,
                             .output = plan->output,
                             .subdivide = plan->subdivide,
                             .baked = &baked};
    sl_status status = bake(context, plan, &map, &baked, &report);
    sl_progress_line_clear(&console->line);
    if (status == SL_OK && plan->json)
        status = sl_bake_report_print_json(context, &report);
    else if (status == SL_OK && !console->quiet)
        status = sl_bake_report_print(context, &report);
    sl_baked_destroy(context, &baked);
    sl_map_destroy(context, &map);
    return status;
}

// --- help

static void print_tables(void) {
    puts("\nsubdivisions:");
    for (size_t i = 0; i < subdivider_names.count; i++)
        printf("  %-10s%s\n", subdividers[i].name, subdividers[i].what);
    printf("            (rules: spanning, obscured at a share of %g, cleaving, median)\n",
           sl_subdivide_options_default().obscured);
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    puts("\nmethods (the first is the default):");
    for (size_t i = 0; i < count; i++)
        printf("  %-10s%s; %s\n", methods[i].name, methods[i].what,
               methods[i].stabs ? "as exact as the solver"
                                : sl_guarantee_name(methods[i].guarantee));
    puts("\nsolvers (the first is the default):");
    for (size_t i = 0; sl_solver_at(i); i++)
        printf("  %-10s%s; %s\n", sl_solver_at(i)->name, sl_solver_at(i)->what,
               sl_guarantee_name(sl_solver_at(i)->guarantee));
    const sl_name_table effects = sl_effect_table();
    printf("\neffects, for --without: ");
    for (size_t i = 0; i < effects.count; i++)
        printf("%s%s", i ? ", " : "", sl_name_table_at(&effects, i));
    putchar('\n');
    sl_input_print_formats();
}

sl_status sl_cmd_bake(sl_console *console, int argc, char **argv) {
    bake_texts t = {0};
    const sl_option_spec options[] = {
        {"output", 'o', "FILE.slv", NULL, &t.output,
         "where to write; without it in the current folder,\nby the map's name"},
        {"subdivide", 0, "NAME", NULL, &t.subdivide, "how to cut the map into cells"},
        {"method", 0, "NAME", NULL, &t.method, "how to find what a cell sees"},
        {"solver", 0, "NAME", NULL, &t.solver, "what stabs portal sequences"},
        {"sight", 0, "closed|open", NULL, &t.sight,
         "closed (the default): lines that only touch\nwall ends count; open: they do not"},
        {"threads", 0, "N", NULL, &t.threads,
         "0, the default, for one a core;\nthe result is the same for any number"},
        {"stab-trees", 0, NULL, &t.stab_trees, NULL, "keep the trees of portal sequences"},
        {"tree-memory", 0, "SIZE", NULL, &t.tree_memory,
         "for them at most, as 64K, 256M (the default), 2G"},
        {"start", 0, "X,Y", NULL, &t.start,
         "a start beside the map's own: starts tell inside\nfrom outside"},
        {"inside", 0, NULL, &t.inside, NULL,
         "look from and at inside cells only: those that a\nstart leads to or that walls enclose"},
        {"slice", 0, "Z", NULL, &t.slice, "cut a 3D model at this height"},
        {"without", 0, "EFFECT,...", NULL, &t.without, "leave out what the map calls for"},
        {"kd-obscured", 0, "SHARE", NULL, &t.kd_obscured,
         "prefer lines of which walls cover this share, 0 to 1"},
        {"kd-rules", 0, "RULE,...", NULL, &t.kd_rules,
         "the rules kept, of spanning, obscured, cleaving,\nmedian (the default is all; none: "
         "none)"},
        {"check", 0, NULL, &t.check, NULL, "check the whole graph of cells and portals"},
        {"json", 0, NULL, &t.json, NULL, "print the statistics as one JSON object"},
    };
    const sl_command_usage usage = {
        .name = "bake",
        .synopsis = "MAP [-o FILE.slv] [options]",
        .operands = {"MAP"},
        .what = "Cuts a map into convex cells joined by portals, finds which cells can see which,\n"
                "and writes both into a file. The time for reading includes cleaning the walls.",
        .tables = print_tables,
        .examples = "  sightline bake office.map -o office.slv\n"
                    "  sightline bake tower.ug --slice 1040 --start 1400,1600 --inside --json",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bake_plan plan = {0};
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, &t, &plan));
    char *own_name = NULL;
    if (!plan.output) {
        SL_TRY(name_output(console->context, plan.input, &own_name));
        plan.output = own_name;
        plan.named_by_map = true;
    }
    const sl_status status = bake_and_report(console, &plan);
    sl_free(console->context, own_name);
    return status;
}
