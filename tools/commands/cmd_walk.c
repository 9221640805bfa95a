/// `sightline walk`: culling frame by frame without visible sets (Bittner and Havran 2002).
#include "arguments/help.h"
#include "arguments/names.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "inputs/pipeline.h"
#include "reports/fields.h"
#include "reports/report.h"
#include "sightline/draw.h"
#include "sightline/support.h"
#include "studies/places.h"
#include "studies/walk_run.h"
#include "system/built.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// The results of a walk: how it was made, and its means.
typedef struct walk_row {
    walk_choice choice;
    double speed; ///< relative
    size_t steps;
    double means[FIGURES];
} walk_row;

typedef SL_ARRAY(walk_row) walk_rows;

/// A chart of a figure over the speed: a line for each of some methods (bits, in the order of the
/// table; no more than a chart has colours) with one test.
typedef struct walk_chart {
    const char *title;
    walk_figure figure;
    unsigned methods;
} walk_chart;

// --- the report

/// The share of node visibility tests that a walk saves beside the classical method with the same
/// test, the same speed and the same way; 0 where there is no such row, or none to save.
static double saving(const walk_rows *rows, size_t row) {
    const walk_row *r = &rows->items[row];
    const sl_walk_method *classical = sl_walk_methods(&(size_t){0});
    for (size_t i = 0; i < rows->count && r->choice.method; i++) {
        const walk_row *c = &rows->items[i];
        if (c->choice.method == classical && c->speed == r->speed &&
            c->choice.options.test == r->choice.options.test && c->means[FIGURE_TESTS] > 0)
            return 1 - r->means[FIGURE_TESTS] / c->means[FIGURE_TESTS];
    }
    return 0;
}

/// Prints the rows.
static void walk_print(const walk_rows *rows) {
    printf("%-20s %-9s %6s %6s %6s %6s %6s %6s %6s %8s %8s %8s\n", "method", "test", "tests",
           "saved", "cone", "prop.", "skip", "cells", "walls", "see \xc2\xb5s", "draw \xc2\xb5s",
           "frame \xc2\xb5s");
    for (size_t i = 0; i < rows->count; i++) {
        const walk_row *r = &rows->items[i];
        const double *m = r->means;
        printf("%-20s %-9s ", walk_choice_name(&r->choice), walk_choice_test(&r->choice));
        if (r->choice.method)
            printf("%6.1f %5.1f%% %6.1f %6.2f %6.1f", m[FIGURE_TESTS], 100 * saving(rows, i),
                   m[FIGURE_FRUSTUM_TESTS], m[FIGURE_PROPAGATED],
                   m[FIGURE_SKIPPED] + m[FIGURE_BOUNDED]);
        else
            printf("%6s %6s %6s %6s %6s", "-", "-", "-", "-", "-");
        printf(" %6.1f %6.1f %7.2f %7.2f %7.2f\n", m[FIGURE_CELLS], m[FIGURE_WALLS],
               1e6 * m[FIGURE_VISIBILITY], 1e6 * m[FIGURE_DRAWING], 1e6 * m[FIGURE_FRAME]);
    }
}

// --- CSV

static size_t list_choice(const walk_row *row, table_field fields[FIELDS_MOST]) {
    fields[0] = field_text("method", walk_choice_name(&row->choice));
    fields[1] = field_text("test", walk_choice_test(&row->choice));
    return 2;
}

/// Adds the figures behind the first `count` fields.
static size_t add_figures(const double *figures, size_t count, table_field fields[FIELDS_MOST]) {
    for (int f = 0; f < FIGURES; f++)
        fields[count++] = field_real(walk_figure_name((walk_figure)f), figures[f]);
    return count;
}

static size_t list_row(const void *of, size_t number, table_field fields[FIELDS_MOST]) {
    const walk_rows *rows = of;
    const walk_row *r = &rows->items[number];
    size_t count = list_choice(r, fields);
    fields[count++] = field_real("p_vp", r->choice.options.p_vp);
    fields[count++] = field_real("p_skip", r->choice.options.p_skip);
    fields[count++] = field_real("speed", r->speed);
    fields[count++] = field_count("steps", r->steps);
    fields[count++] = field_real("saved", saving(rows, number));
    return add_figures(r->means, count, fields);
}

/// All figures of all rows as CSV.
static sl_status walk_write_rows(sl_context *context, const walk_rows *rows, const char *path) {
    return fields_write_csv(context, &(field_rows){list_row, rows, rows->count}, path);
}

/// Frames of all rows, row by row.
typedef struct walk_frames {
    const walk_rows *rows;
    const eye_places *eyes;
    double *const *frames; ///< by row
} walk_frames;

static size_t list_frame(const void *of, size_t number, table_field fields[FIELDS_MOST]) {
    const walk_frames *all = of;
    const size_t row = number / all->eyes->list.count, frame = number % all->eyes->list.count;
    const eye_place *eye = &all->eyes->list.items[frame];
    size_t count = list_choice(&all->rows->items[row], fields);
    fields[count++] = field_count("frame", frame);
    fields[count++] = field_real("x", eye->at.x);
    fields[count++] = field_real("y", eye->at.y);
    fields[count++] = field_real("heading", eye->heading);
    return add_figures(all->frames[row] + frame * FIGURES, count, fields);
}

// --- charts

#define FRAME_LABEL "visibility and drawing, a frame"

enum { MOST_MARKS = 64, MOST_SERIES = SL_CHART_COLOURS };

typedef struct lines {
    sl_chart_mark marks[MOST_SERIES][MOST_MARKS];
    sl_chart_series series[MOST_SERIES];
    size_t count;
} lines;

/// Adds a mark to the line of a name, which is begun where it is new.
static void add_mark(lines *l, const char *name, double x, double y) {
    size_t i = 0;
    while (i < l->count && strcmp(l->series[i].name, name) != 0) i++;
    if (i == MOST_SERIES) return;
    if (i == l->count)
        l->series[l->count++] = (sl_chart_series){
            .name = name, .style = SL_CHART_LINE, .colour = (unsigned)i, .marks = l->marks[i]};
    sl_chart_series *s = &l->series[i];
    if (s->mark_count < MOST_MARKS) l->marks[i][s->mark_count++] = (sl_chart_mark){.x = x, .y = y};
}

static sl_status draw(sl_context *context, const lines *l, const char *title, sl_chart_axis x,
                      sl_chart_axis y, const char *path) {
    const sl_chart chart = {.title = title,
                            .x = x,
                            .y = y,
                            .series = l->series,
                            .series_count = l->count,
                            .width = built_draw_options().width};
    return built_pictures()->chart(context, &chart, path);
}

static sl_status walk_draw_speeds(sl_context *context, const walk_rows *rows,
                                  const walk_chart *chart, const char *test, const char *path) {
    lines *l = sl_alloc_array(context, 1, sizeof *l);
    if (!l) return SL_NO_MEMORY;
    const sl_walk_method *methods = sl_walk_methods(&(size_t){0});
    for (size_t i = 0; i < rows->count; i++) {
        const walk_row *r = &rows->items[i];
        const sl_walk_method *method = r->choice.method;
        if (method && chart->methods >> (method - methods) & 1 &&
            strcmp(r->choice.options.test->name, test) == 0)
            add_mark(l, method->name, r->speed, r->means[chart->figure]);
    }
    const char *label = chart->figure == FIGURE_TESTS        ? "node visibility tests a frame"
                        : chart->figure == FIGURE_VISIBILITY ? "visibility, a frame"
                                                             : FRAME_LABEL;
    const sl_chart_axis y = {.label = label, .seconds = chart->figure >= FIGURE_VISIBILITY};
    const sl_chart_axis x = {.label = "relative speed", .scale = SL_CHART_LOG};
    const sl_status status = draw(context, l, chart->title, x, y, path);
    sl_free(context, l);
    return status;
}

/// The time of a frame over p_skip, a line for each test.
static sl_status walk_draw_chances(sl_context *context, const walk_rows *rows, const char *title,
                                   const char *path) {
    lines *l = sl_alloc_array(context, 1, sizeof *l);
    if (!l) return SL_NO_MEMORY;
    for (size_t i = 0; i < rows->count; i++) {
        const walk_row *r = &rows->items[i];
        add_mark(l, r->choice.options.test->name, r->choice.options.p_skip, r->means[FIGURE_FRAME]);
    }
    const sl_chart_axis x = {.label = "p_skip"};
    const sl_chart_axis y = {.label = FRAME_LABEL, .seconds = true};
    const sl_status status = draw(context, l, title, x, y, path);
    sl_free(context, l);
    return status;
}

// --- the command

typedef struct walk_plan {
    const char *input, *path, *table, *frames, *output;
    door_choice doors;
    map_pipeline pipeline;
    uint64_t steps; ///< of a whole path at speed 1
    double step;    ///< 0: by the number of steps
    double speed, fov, ahead;
    unsigned methods, tests; ///< bits of the library's tables
    sl_walk_options options;
    double wall_cost; ///< nanoseconds; 0: as measured
    unsigned repeat;
    const char *steps_given, *step_given;
} walk_plan;

/// The space, the way through it, and the results.
typedef struct walk_work {
    sl_baked baked;
    sl_hierarchy hierarchy;
    walk_way way;
    double step; ///< at speed 1
    walk_rows rows;
} walk_work;

enum { MOST_REPEATS = 1000 };

static name_table walk_method_table(void) {
    size_t count;
    const sl_walk_method *methods = sl_walk_methods(&count);
    return (name_table){"method", methods, sizeof *methods, count, NULL};
}

static name_table test_table(void) {
    size_t count;
    const sl_node_test *tests = sl_node_tests(&count);
    return (name_table){"test", tests, sizeof *tests, count, NULL};
}

// --- the options

static sl_status make_plan(sl_context *context, walk_plan *plan) {
    if (!plan->methods || !plan->tests)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s none: at least one is needed",
                       plan->methods ? "test" : "method");
    if (plan->steps_given && plan->step_given)
        return sl_fail(context, SL_BAD_ARGUMENT, "give either --steps or --step");
    return pipeline_plan(context, plan->input, &plan->pipeline);
}

// --- the work

static sl_status fail_path(sl_context *context, const sl_map *map, const char *name) {
    const name_table paths = {"path", map->paths, sizeof *map->paths, map->path_count, NULL};
    char names[NAME_LIST];
    name_list(&paths, names);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--path %s: the map has no path of that name, and there is no such file; the "
                   "map's paths: %s",
                   name, names);
}

/// Takes the path of the map that has the name, or the path of a file. Default: a tour from the
/// map's start.
static sl_status lay_way(sl_context *context, const walk_plan *plan, walk_work *w) {
    const char *name = plan->path;
    const sl_map *map = &w->baked.map;
    const sl_space *space = &w->baked.space;
    for (size_t i = 0; name && i < map->path_count; i++) {
        const sl_path *p = &map->paths[i];
        if (strcmp(p->name, name) != 0) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &w->way, p->count));
        memcpy(w->way.items, p->points, p->count * sizeof *p->points);
        w->way.count = p->count;
    }
    if (name && !w->way.count) {
        if (sl_path_look(name) == SL_PATH_NOTHING) return fail_path(context, map, name);
        SL_TRY(way_read(context, name, space, &w->way));
    }
    if (name) {
        const double length = way_length(&w->way);
        if (w->way.count < 2 || !(length > 0))
            return sl_fail(context, SL_BAD_ARGUMENT, "--path %s: a path of no length", name);
        w->step = plan->step > 0 ? plan->step : length / (double)plan->steps;
        char what[128];
        snprintf(what, sizeof what, "--path %s", name);
        return places_note_path(context, what, &w->baked, w->way.items, w->way.count);
    }
    if (!map->start_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the map has no start for a tour: give a --path or a --start");
    const size_t first = input_next_start(map, space, 0);
    const sl_point start = map->starts[first < map->start_count ? first : 0].at;
    w->step = plan->step;
    return way_tour(context, space, start, plan->options.seed, (double)plan->steps, &w->step,
                    &w->way);
}

static sl_status make_eyes(sl_context *context, const walk_plan *plan, const walk_work *w,
                           double speed, eye_places *eyes) {
    SL_TRY(way_frames(context, &w->way, w->step * speed, w->step * plan->ahead, plan->fov, eyes));
    if (!eyes->list.count)
        return sl_fail(context, SL_BAD_ARGUMENT, "the way is shorter than a step of %g",
                       w->step * speed);
    return SL_OK;
}

/// Adds a row for a choice. `frames` is filled where it is not NULL.
static sl_status add_row(command_console *console, const walk_plan *plan, walk_work *w,
                         const walk_choice *choice, double speed, const eye_places *eyes,
                         double **frames) {
    sl_context *context = console->context;
    const walk_scene scene = {&w->baked, &w->hierarchy, 1e-9 * plan->wall_cost, plan->repeat};
    walk_row row = {.choice = *choice, .speed = speed, .steps = eyes->list.count};
    SL_TRY(SL_ARRAY_ROOM(context, &w->rows, 1));
    if (frames) {
        *frames = sl_alloc_array(context, row.steps * FIGURES, sizeof **frames);
        if (!*frames) return SL_NO_MEMORY;
    }
    SL_TRY(walk_run(console, &scene, choice, eyes, row.means, frames ? *frames : NULL));
    w->rows.items[w->rows.count++] = row;
    return SL_OK;
}

enum { MOST_CHOICES = 64 };

/// The methods with the tests asked for, and culling by baked visible sets where there are any.
static size_t gather_choices(const walk_plan *plan, const walk_work *w,
                             walk_choice choices[MOST_CHOICES]) {
    size_t count = 0, method_count, test_count, eye_count;
    const sl_walk_method *methods = sl_walk_methods(&method_count);
    const sl_node_test *tests = sl_node_tests(&test_count);
    const sl_eye_method *eyes = sl_eye_methods(&eye_count);
    for (size_t t = 0; t < test_count; t++)
        for (size_t m = 0; m < method_count; m++) {
            if (!(plan->methods >> m & 1) || !(plan->tests >> t & 1)) continue;
            choices[count] = (walk_choice){.method = &methods[m], .options = plan->options};
            choices[count++].options.test = &tests[t];
        }
    for (size_t i = 0; i < eye_count && w->baked.visibility.pvs.cell_count; i++)
        choices[count++] = (walk_choice){.baked = &eyes[i]};
    return count;
}

/// One walk at the given speed: the table, and the files.
static sl_status walk_once(command_console *console, const walk_plan *plan, walk_work *w) {
    sl_context *context = console->context;
    walk_choice choices[MOST_CHOICES];
    double *frames[MOST_CHOICES] = {0};
    const size_t count = gather_choices(plan, w, choices);
    eye_places eyes = {0};
    sl_status status = make_eyes(context, plan, w, plan->speed, &eyes);
    for (size_t i = 0; i < count && status == SL_OK; i++)
        status = add_row(console, plan, w, &choices[i], plan->speed, &eyes, &frames[i]);
    progress_line_clear(&console->line);
    if (status == SL_OK && plan->table) status = walk_write_rows(context, &w->rows, plan->table);
    if (status == SL_OK && plan->frames)
        status = fields_write_csv(context,
                                  &(field_rows){list_frame, &(walk_frames){&w->rows, &eyes, frames},
                                                w->rows.count * eyes.list.count},
                                  plan->frames);
    if (status == SL_OK) {
        printf("%zu steps of %g, %zu nodes, %zu walls, view cone of %g degrees; means a frame\n",
               eyes.list.count, w->step * plan->speed, (size_t)w->hierarchy.node_count,
               (size_t)w->baked.space.wall_count, plan->fov);
        ground_print(&w->baked.space);
        walk_print(&w->rows);
    }
    for (size_t i = 0; i < count; i++) sl_free(context, frames[i]);
    eyes_destroy(context, &eyes);
    return status;
}

// --- the study: over speeds and chances

/// The charts over speed. First the paper's methods A to D, as in its figures 8 to 10. Then A and B
/// beside the methods that go beyond the paper.
enum { IN_PAPER = 0x0f, BEYOND = 0xf3 };
static const walk_chart charts[] = {
    {"Node visibility tests over the speed of the walk", FIGURE_TESTS, IN_PAPER},
    {"Time for visibility over the speed of the walk", FIGURE_VISIBILITY, IN_PAPER},
    {"Time of a frame over the speed of the walk", FIGURE_FRAME, IN_PAPER},
    {"Beyond the paper: node visibility tests", FIGURE_TESTS, BEYOND},
    {"Beyond the paper: time of a frame", FIGURE_FRAME, BEYOND},
};
enum { CHARTS = sizeof charts / sizeof *charts };

/// The charts in that order, then the other files.
static const char *const study_files[] = {"tests.png",        "visibility.png",    "frames.png",
                                          "beyond_tests.png", "beyond_frames.png", "chances.png",
                                          "speeds.csv",       "chances.csv",       NULL};

static sl_status run_speeds(command_console *console, const walk_plan *plan, walk_work *w) {
    static const double speeds[] = {0.25, 0.5, 1, 2, 4, 8};
    walk_choice choices[MOST_CHOICES];
    const size_t count = gather_choices(plan, w, choices);
    sl_status status = SL_OK;
    for (size_t s = 0; s < sizeof speeds / sizeof *speeds && status == SL_OK; s++) {
        eye_places eyes = {0};
        status = make_eyes(console->context, plan, w, speeds[s], &eyes);
        for (size_t i = 0; i < count && status == SL_OK; i++)
            status = add_row(console, plan, w, &choices[i], speeds[s], &eyes, NULL);
        eyes_destroy(console->context, &eyes);
    }
    return status;
}

/// Each method that skips tests at random, at chances of 0, 0.1, ... 0.9.
static sl_status run_chances(command_console *console, const walk_plan *plan, walk_work *w) {
    sl_context *context = console->context;
    size_t method_count, test_count;
    const sl_walk_method *methods = sl_walk_methods(&method_count);
    const sl_node_test *tests = sl_node_tests(&test_count);
    eye_places eyes = {0};
    sl_status status = make_eyes(context, plan, w, plan->speed, &eyes);
    for (size_t m = 0; m < method_count; m++) {
        if (strcmp(methods[m].name, "skipping") != 0) continue;
        for (size_t t = 0; t < test_count; t++)
            for (int tenths = 0; tenths < 10 && status == SL_OK; tenths++) {
                if (!(plan->tests >> t & 1)) continue;
                walk_choice choice = {.method = &methods[m], .options = plan->options};
                choice.options.test = &tests[t];
                choice.options.p_skip = tenths / 10.;
                status = add_row(console, plan, w, &choice, plan->speed, &eyes, NULL);
            }
    }
    eyes_destroy(context, &eyes);
    return status;
}

static sl_status write_study(sl_context *context, const walk_plan *plan, const walk_work *w,
                             const walk_work *chances, int file, const char *path) {
    size_t t = 0;
    while (!(plan->tests >> t & 1)) t++;
    const char *test = sl_node_tests(&(size_t){0})[t].name;
    if (file < CHARTS) return walk_draw_speeds(context, &w->rows, &charts[file], test, path);
    if (file > CHARTS)
        return walk_write_rows(context, file == CHARTS + 1 ? &w->rows : &chances->rows, path);
    return walk_draw_chances(context, &chances->rows,
                             "Time of a frame over the chance to skip a test", path);
}

static sl_status study(command_console *console, const walk_plan *plan, walk_work *w) {
    sl_context *context = console->context;
    output_folder folder;
    walk_work chances = *w;
    chances.rows = (walk_rows){0};
    SL_TRY(folder_open(context, plan->output, study_files, &folder));
    sl_status status = run_speeds(console, plan, w);
    if (status == SL_OK) status = run_chances(console, plan, &chances);
    for (int i = 0; study_files[i] && status == SL_OK; i++) {
        char *path = folder_file(context, &folder, study_files[i]);
        status = path ? write_study(context, plan, w, &chances, i, path) : SL_NO_MEMORY;
        sl_free(context, path);
    }
    sl_free(context, chances.rows.items);
    progress_line_clear(&console->line);
    return folder_close(context, &folder, status);
}

/// What a walk makes of effects. Its own methods know walls alone, and so keep more, never less.
static void note_effects(sl_context *context, const sl_map *map) {
    if (map->mirror_count)
        sl_note(context, "mirrors are walls here: a walk looks at what is seen directly");
    if (map->oneway_count)
        sl_note(context, "one-way glass is open both ways to the walk's own methods: they keep "
                         "what is dark, too");
    if (map->range > 0)
        sl_note(context, "the walk's own methods keep what is farther than the view range, too");
}

static sl_status work(command_console *console, const walk_plan *plan, walk_work *w) {
    const unsigned all = SL_EFFECT_DOOR | SL_EFFECT_MIRROR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE;
    SL_TRY(pipeline_read_space(console->context, &plan->pipeline, "walk", all, NULL, &w->baked));
    note_effects(console->context, &w->baked.map);
    if (!name_ends_with(plan->pipeline.path, ".slv"))
        SL_TRY(pipeline_note_inside(console->context, &plan->pipeline, &w->baked.map,
                                    &w->baked.space));
    SL_TRY(doors_shut(console->context, &plan->doors, &w->baked));
    SL_TRY(sl_hierarchy_make(console->context, &w->baked.space, &w->hierarchy));
    SL_TRY(lay_way(console->context, plan, w));
    return plan->output ? study(console, plan, w) : walk_once(console, plan, w);
}

static void print_tables(void) {
    size_t count;
    const sl_walk_method *methods = sl_walk_methods(&count);
    puts("\nmethods, as Bittner & Havran 2002 have them, and beyond:");
    for (size_t i = 0; i < count; i++) help_name(methods[i].name, 12, methods[i].what, NULL);
    const sl_node_test *tests = sl_node_tests(&count);
    puts("\ntests:");
    for (size_t i = 0; i < count; i++) help_name(tests[i].name, 12, tests[i].what, NULL);
    putchar('\n');
    help_wrap("The table shows for each frame: node visibility tests, the share of them that the "
              "method saves, tests against the view cone, states taken from neighbours, tests "
              "skipped, cells and walls drawn, the time to find the cells, the time to draw their "
              "walls (into a row of 640 pixels with a depth buffer), and the sum of both. For a "
              "baked file, culling by its visible sets follows.",
              0, 0);
}

sl_status cmd_walk(command_console *console, int argc, char **argv) {
    const name_table walk_methods = walk_method_table(), tests = test_table();
    walk_plan plan = {.pipeline = pipeline_default(),
                      .steps = 980,
                      .speed = 1,
                      .fov = 60,
                      .ahead = 10,
                      .methods = (1u << walk_methods.count) - 1,
                      .tests = (1u << tests.count) - 1,
                      .repeat = 3,
                      .options = sl_walk_options_default()};
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table doors = door_option_table(&plan.doors);
    const option_spec options[] = {
        {"path", 0, "P.txt|NAME",
         "a path of the map, or a file with a line 'x y' for each point (default: a tour from the "
         "start)",
         .text = &plan.path, .is_input = true},
        {"method", 0, "NAME,...", "walk with these methods (default: all)",
         .choices = &plan.methods, .names = walk_methods},
        {"steps", 0, "N", "number of frames of the whole path at speed 1 (default 980)",
         .count = &plan.steps, .least = 1, .most = 1000000, .given = &plan.steps_given},
        {"speed", 0, "S", "relative speed (default 1)", .number = &plan.speed, .over_0 = true},
        {"fov", 0, "DEG", "width of the view cone (default 60)", .number = &plan.fov,
         .over_0 = true, .most = 360, .needs = "over 0 to 360 degrees are needed"},
        {"table", 0, "FILE.csv", "write all figures of the table", .text = &plan.table,
         .check = CHECK_TABLE},
        {"frames", 0, "FILE.csv", "write all figures of each frame", .text = &plan.frames,
         .check = CHECK_TABLE},
        {"output", 'o', "DIR",
         "a study: speeds 0.25 to 8 and probabilities 0 to 0.9, as tables and charts",
         .text = &plan.output},
        {.group = &doors},
        {"step", 0, "LENGTH", "length of a frame at speed 1, in place of --steps",
         .number = &plan.step, .over_0 = true, .given = &plan.step_given, .rare = true},
        {"ahead", 0, "STEPS", "the eye looks at the point this many steps ahead (default 10)",
         .number = &plan.ahead, .needs = "steps, 0 or more, are needed", .rare = true},
        {"test", 0, "NAME,...", "use these node visibility tests (default: all)",
         .choices = &plan.tests, .names = tests, .rare = true},
        {"occluders", 0, "N", "number of occluders in a frame (default 16)",
         .count32 = &plan.options.occluders, .most = SL_WALK_OCCLUDERS_MOST, .rare = true},
        {"cheap", 0, "WALLS", "draw nodes with up to this number of walls without a test",
         .count32 = &plan.options.cheap, .rare = true},
        {"p-vp", 0, "P", "probability of propagation (default 0.5)", .number = &plan.options.p_vp,
         .most = 1, .rare = true},
        {"p-skip", 0, "P", "probability of skipping a test (default 0.5)",
         .number = &plan.options.p_skip, .most = 1, .rare = true},
        {"seed", 0, "N", "seed of all random choices (default 1)", .count = &plan.options.seed,
         .rare = true},
        {"repeat", 0, "N", "number of walks; times are the least of them (default 3)",
         .count32 = &plan.repeat, .least = 1, .most = MOST_REPEATS, .rare = true},
        {"wall-cost", 0, "NS", "count NS nanoseconds for drawing a wall (default: measured)",
         .number = &plan.wall_cost, .over_0 = true, .rare = true},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "walk",
        .synopsis = "MAP|FILE.slv [--path P.txt|NAME] [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Walks along a path and culls frame by frame, without visible sets: down the "
                "hierarchy, each node against a few large occluders, with what is known from the "
                "frame before (Bittner and Havran 2002). No method misses anything that is seen.",
        .tables = print_tables,
        .examples = "  sightline walk office.map\n"
                    "  sightline walk office.slv --path tour.txt --speed 2 --frames frames.csv\n"
                    "  sightline walk office.map --test tree -o study",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, &plan));
    if (plan.output) SL_TRY(built_need_pictures(console->context));
    walk_work w = {0};
    const sl_status status = work(console, &plan, &w);
    sl_free(console->context, w.rows.items);
    sl_free(console->context, w.way.items);
    sl_hierarchy_destroy(console->context, &w.hierarchy);
    sl_baked_destroy(console->context, &w.baked);
    return status;
}
