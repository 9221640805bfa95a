#include "commands.h"
#include "inputs.h"
#include "names.h"
#include "outputs.h"
#include "pipeline.h"
#include "sightline/draw.h"
#include "sightline/support.h"
#include "walk_run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/// A walk that was made: what it was made with, and its means.
typedef struct sl_walk_row {
    sl_walk_choice choice;
    double speed; ///< relative
    size_t steps;
    double means[SL_FIGURES];
} sl_walk_row;

typedef SL_ARRAY(sl_walk_row) sl_walk_rows;

/// A chart of a figure over the speed: a line for each of some methods (bits, in the order of the
/// table; no more than a chart has colours) with one test.
typedef struct sl_walk_chart {
    const char *title;
    sl_walk_figure figure;
    unsigned methods;
} sl_walk_chart;

// --- the report

/// The share of node visibility tests that a walk saves beside the classical method with the same
/// test, the same speed and the same way; 0 where there is no such row, or none to save.
static double saving(const sl_walk_rows *rows, size_t row) {
    const sl_walk_row *r = &rows->items[row];
    const sl_walk_method *classical = sl_walk_methods(&(size_t){0});
    for (size_t i = 0; i < rows->count && r->choice.method; i++) {
        const sl_walk_row *c = &rows->items[i];
        if (c->choice.method == classical && c->speed == r->speed &&
            c->choice.options.test == r->choice.options.test && c->means[SL_FIGURE_TESTS] > 0)
            return 1 - r->means[SL_FIGURE_TESTS] / c->means[SL_FIGURE_TESTS];
    }
    return 0;
}

/// Prints the rows.
static void sl_walk_print(const sl_walk_rows *rows) {
    printf("%-20s %-9s %6s %6s %6s %6s %6s %6s %6s %8s %8s %8s\n", "method", "test", "tests",
           "saved", "cone", "prop.", "skip", "cells", "walls", "see \xc2\xb5s", "draw \xc2\xb5s",
           "frame \xc2\xb5s");
    for (size_t i = 0; i < rows->count; i++) {
        const sl_walk_row *r = &rows->items[i];
        const double *m = r->means;
        printf("%-20s %-9s ", sl_walk_choice_name(&r->choice), sl_walk_choice_test(&r->choice));
        if (r->choice.method)
            printf("%6.1f %5.1f%% %6.1f %6.2f %6.1f", m[SL_FIGURE_TESTS], 100 * saving(rows, i),
                   m[SL_FIGURE_FRUSTUM_TESTS], m[SL_FIGURE_PROPAGATED],
                   m[SL_FIGURE_SKIPPED] + m[SL_FIGURE_BOUNDED]);
        else
            printf("%6s %6s %6s %6s %6s", "-", "-", "-", "-", "-");
        printf(" %6.1f %6.1f %7.2f %7.2f %7.2f\n", m[SL_FIGURE_CELLS], m[SL_FIGURE_WALLS],
               1e6 * m[SL_FIGURE_VISIBILITY], 1e6 * m[SL_FIGURE_DRAWING], 1e6 * m[SL_FIGURE_FRAME]);
    }
}

// --- CSV

static void put_number(FILE *out, double value, char end) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    fprintf(out, "%s%c", text, end);
}

static void put_choice(FILE *out, const sl_walk_row *r) {
    fprintf(out, "%s,%s,", sl_walk_choice_name(&r->choice), sl_walk_choice_test(&r->choice));
}

static void put_figures(FILE *out, const double figures[SL_FIGURES]) {
    for (int f = 0; f < SL_FIGURES; f++)
        put_number(out, figures[f], f + 1 < SL_FIGURES ? ',' : '\n');
}

static void put_figure_names(FILE *out) {
    for (int f = 0; f < SL_FIGURES; f++)
        fprintf(out, "%s%c", sl_walk_figure_name((sl_walk_figure)f),
                f + 1 < SL_FIGURES ? ',' : '\n');
}

/// All figures of all rows as CSV.
static sl_status sl_walk_write_rows(sl_context *context, const sl_walk_rows *rows,
                                    const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    fputs("method,test,p_vp,p_skip,speed,steps,saved,", output.stream);
    put_figure_names(output.stream);
    for (size_t i = 0; i < rows->count; i++) {
        const sl_walk_row *r = &rows->items[i];
        put_choice(output.stream, r);
        put_number(output.stream, r->choice.options.p_vp, ',');
        put_number(output.stream, r->choice.options.p_skip, ',');
        put_number(output.stream, r->speed, ',');
        fprintf(output.stream, "%zu,", r->steps);
        put_number(output.stream, saving(rows, i), ',');
        put_figures(output.stream, r->means);
    }
    return sl_output_close(context, &output, SL_OK);
}

/// Frames as CSV: `frames[i]` has those of row i, or is NULL.
static sl_status sl_walk_write_frames(sl_context *context, const sl_walk_rows *rows,
                                      const sl_eyes *eyes, double *const *frames,
                                      const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    fputs("method,test,frame,x,y,look,", output.stream);
    put_figure_names(output.stream);
    for (size_t i = 0; i < rows->count; i++) {
        if (!frames[i]) continue;
        for (size_t k = 0; k < eyes->list.count; k++) {
            const sl_eye *eye = &eyes->list.items[k];
            put_choice(output.stream, &rows->items[i]);
            fprintf(output.stream, "%zu,", k);
            put_number(output.stream, eye->at.x, ',');
            put_number(output.stream, eye->at.y, ',');
            put_number(output.stream, eye->look, ',');
            put_figures(output.stream, frames[i] + k * SL_FIGURES);
        }
    }
    return sl_output_close(context, &output, SL_OK);
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
                            .width = sl_draw_options_default().width};
    return sl_draw_chart_file(context, &chart, path);
}

static sl_status sl_walk_draw_speeds(sl_context *context, const sl_walk_rows *rows,
                                     const sl_walk_chart *chart, const char *test,
                                     const char *path) {
    lines *l = sl_alloc_array(context, 1, sizeof *l);
    if (!l) return SL_NO_MEMORY;
    const sl_walk_method *methods = sl_walk_methods(&(size_t){0});
    for (size_t i = 0; i < rows->count; i++) {
        const sl_walk_row *r = &rows->items[i];
        const sl_walk_method *method = r->choice.method;
        if (method && chart->methods >> (method - methods) & 1 &&
            strcmp(r->choice.options.test->name, test) == 0)
            add_mark(l, method->name, r->speed, r->means[chart->figure]);
    }
    const char *label = chart->figure == SL_FIGURE_TESTS        ? "node visibility tests a frame"
                        : chart->figure == SL_FIGURE_VISIBILITY ? "visibility, a frame"
                                                                : FRAME_LABEL;
    const sl_chart_axis y = {.label = label, .seconds = chart->figure >= SL_FIGURE_VISIBILITY};
    const sl_chart_axis x = {.label = "relative speed", .scale = SL_CHART_LOG};
    const sl_status status = draw(context, l, chart->title, x, y, path);
    sl_free(context, l);
    return status;
}

/// The time of a frame over p_skip, a line for each test.
static sl_status sl_walk_draw_chances(sl_context *context, const sl_walk_rows *rows,
                                      const char *title, const char *path) {
    lines *l = sl_alloc_array(context, 1, sizeof *l);
    if (!l) return SL_NO_MEMORY;
    for (size_t i = 0; i < rows->count; i++) {
        const sl_walk_row *r = &rows->items[i];
        add_mark(l, r->choice.options.test->name, r->choice.options.p_skip,
                 r->means[SL_FIGURE_FRAME]);
    }
    const sl_chart_axis x = {.label = "p_skip"};
    const sl_chart_axis y = {.label = FRAME_LABEL, .seconds = true};
    const sl_status status = draw(context, l, title, x, y, path);
    sl_free(context, l);
    return status;
}

// --- the command

/// The options as they are given.
typedef struct walk_texts {
    sl_pipeline_texts pipeline;
    const char *input, *path, *steps, *step, *speed, *fov, *ahead, *methods, *tests, *occluders;
    const char *cheap, *p_vp, *p_skip, *seed, *repeat, *wall_cost, *csv, *frames, *output, *shut;
} walk_texts;

/// The options as they are meant.
typedef struct walk_plan {
    const walk_texts *texts;
    sl_pipeline pipeline;
    uint64_t steps; ///< of a whole path at speed 1
    double step;    ///< 0: by the number of steps
    double speed, fov, ahead;
    unsigned methods, tests; ///< bits of the library's tables
    sl_walk_options options;
    double wall_cost; ///< nanoseconds; 0: as measured
    unsigned repeat;
} walk_plan;

/// What is worked with.
typedef struct walk_work {
    sl_baked baked;
    sl_hierarchy hierarchy;
    sl_way way;
    double step; ///< at speed 1
    sl_walk_rows rows;
} walk_work;

enum { TOUR_STEPS_ACROSS = 500, MOST_REPEATS = 1000 };

static sl_name_table method_table(void) {
    size_t count;
    const sl_walk_method *methods = sl_walk_methods(&count);
    return (sl_name_table){"method", methods, sizeof *methods, count};
}

static sl_name_table test_table(void) {
    size_t count;
    const sl_node_test *tests = sl_node_tests(&count);
    return (sl_name_table){"test", tests, sizeof *tests, count};
}

// --- the options

static sl_status read_positive(sl_context *context, const char *option, const char *text,
                               double *value) {
    SL_TRY(sl_option_number(context, option, text, value));
    if (text && !(*value > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a number over 0 is needed", option, text);
    return SL_OK;
}

static sl_status read_chance(sl_context *context, const char *option, const char *text,
                             double *value) {
    SL_TRY(sl_option_number(context, option, text, value));
    if (text && !(*value >= 0 && *value <= 1))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a number from 0 to 1 is needed", option,
                       text);
    return SL_OK;
}

static sl_status plan_methods(sl_context *context, const walk_texts *t, walk_plan *plan) {
    const sl_name_table methods = method_table(), tests = test_table();
    uint64_t occluders = plan->options.occluders, cheap = plan->options.cheap;
    plan->methods = (1u << methods.count) - 1;
    plan->tests = (1u << tests.count) - 1;
    SL_TRY(sl_option_choices(context, "--method", t->methods, &methods, &plan->methods));
    SL_TRY(sl_option_choices(context, "--test", t->tests, &tests, &plan->tests));
    if (!plan->methods || !plan->tests)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s none: at least one is needed",
                       plan->methods ? "test" : "method");
    SL_TRY(
        sl_option_count(context, "--occluders", t->occluders, SL_WALK_OCCLUDERS_MOST, &occluders));
    SL_TRY(sl_option_count(context, "--cheap", t->cheap, UINT32_MAX, &cheap));
    SL_TRY(read_chance(context, "--p-vp", t->p_vp, &plan->options.p_vp));
    SL_TRY(read_chance(context, "--p-skip", t->p_skip, &plan->options.p_skip));
    plan->options.occluders = (uint32_t)occluders;
    plan->options.cheap = (uint32_t)cheap;
    return sl_option_count(context, "--seed", t->seed, UINT64_MAX, &plan->options.seed);
}

static sl_status plan_way(sl_context *context, const walk_texts *t, walk_plan *plan) {
    if (t->steps && t->step)
        return sl_fail(context, SL_BAD_ARGUMENT, "give either --steps or --step");
    SL_TRY(sl_option_count(context, "--steps", t->steps, 1000000, &plan->steps));
    if (!plan->steps) return sl_fail(context, SL_BAD_ARGUMENT, "--steps 0: at least 1 is needed");
    SL_TRY(read_positive(context, "--step", t->step, &plan->step));
    SL_TRY(read_positive(context, "--speed", t->speed, &plan->speed));
    SL_TRY(sl_option_number(context, "--ahead", t->ahead, &plan->ahead));
    SL_TRY(sl_option_number(context, "--fov", t->fov, &plan->fov));
    if (!(plan->ahead >= 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "--ahead %s: steps, 0 or more, are needed",
                       t->ahead);
    if (!(plan->fov > 0 && plan->fov <= 360))
        return sl_fail(context, SL_BAD_ARGUMENT, "--fov %s: over 0 to 360 degrees are needed",
                       t->fov);
    return SL_OK;
}

static sl_status make_plan(sl_context *context, const walk_texts *t, walk_plan *plan) {
    uint64_t repeat = 3;
    *plan = (walk_plan){.texts = t,
                        .steps = 980,
                        .speed = 1,
                        .fov = 60,
                        .ahead = 10,
                        .options = sl_walk_options_default()};
    SL_TRY(plan_methods(context, t, plan));
    SL_TRY(plan_way(context, t, plan));
    SL_TRY(read_positive(context, "--wall-cost", t->wall_cost, &plan->wall_cost));
    SL_TRY(sl_option_count(context, "--repeat", t->repeat, MOST_REPEATS, &repeat));
    if (!repeat) return sl_fail(context, SL_BAD_ARGUMENT, "--repeat 0: at least 1 is needed");
    plan->repeat = (unsigned)repeat;
    SL_TRY(sl_output_check(context, t->input, "--csv", t->csv));
    SL_TRY(sl_output_check(context, t->input, "--frames", t->frames));
    return sl_pipeline_plan(context, t->input, &t->pipeline, &plan->pipeline);
}

// --- the work

static sl_status read_space(sl_context *context, const walk_plan *plan, sl_baked *baked) {
    const walk_texts *t = plan->texts;
    if (sl_input_ends_with(t->input, ".slv")) {
        SL_TRY(sl_input_refuse_texts(context, t->input, &t->pipeline.input));
        SL_TRY(sl_input_read_baked(context, t->input, baked));
        SL_TRY(sl_effects_check(context, &baked->map, "walk", SL_EFFECT_DOOR));
        return sl_doors_shut(context, t->shut, baked);
    }
    SL_TRY(sl_pipeline_read_clean(context, &plan->pipeline, &baked->map, NULL));
    SL_TRY(sl_effects_check(context, &baked->map, "walk", SL_EFFECT_DOOR));
    SL_TRY(sl_pipeline_subdivide(context, &plan->pipeline, &baked->map, &baked->space));
    SL_TRY(sl_pipeline_check(context, &plan->pipeline, &baked->space));
    return sl_doors_shut(context, t->shut, baked);
}

static sl_status fail_path(sl_context *context, const sl_map *map, const char *name) {
    const sl_name_table paths = {"path", map->paths, sizeof *map->paths, map->path_count};
    char names[SL_NAME_LIST];
    sl_name_list(&paths, names);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--path %s: the map has no path of that name, and there is no such file; the "
                   "map's paths: %s",
                   name, names);
}

/// A path of the map by its name, or else of a file; without either a tour from the map's start.
static sl_status lay_way(sl_context *context, const walk_plan *plan, walk_work *w) {
    const char *name = plan->texts->path;
    const sl_map *map = &w->baked.map;
    const sl_space *space = &w->baked.space;
    const sl_box *b = &space->bounds;
    const double size = fmax(b->max.x - b->min.x, b->max.y - b->min.y);
    for (size_t i = 0; name && i < map->path_count; i++) {
        const sl_path *p = &map->paths[i];
        if (strcmp(p->name, name) != 0) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &w->way, p->count));
        memcpy(w->way.items, p->points, p->count * sizeof *p->points);
        w->way.count = p->count;
    }
    if (name && !w->way.count) {
        if (access(name, F_OK) != 0) return fail_path(context, map, name);
        SL_TRY(sl_way_read(context, name, space, &w->way));
    }
    if (name) {
        const double length = sl_way_length(&w->way);
        if (w->way.count < 2 || !(length > 0))
            return sl_fail(context, SL_BAD_ARGUMENT, "--path %s: a path of no length", name);
        w->step = plan->step > 0 ? plan->step : length / (double)plan->steps;
        return SL_OK;
    }
    if (!map->start_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the map has no start for a tour: give a --path or a --start");
    const sl_point start = map->starts[0].at;
    w->step = plan->step > 0 ? plan->step : size / TOUR_STEPS_ACROSS;
    return sl_way_tour(context, space, start, plan->options.seed, w->step * (double)plan->steps,
                       &w->way);
}

static sl_status make_eyes(sl_context *context, const walk_plan *plan, const walk_work *w,
                           double speed, sl_eyes *eyes) {
    SL_TRY(
        sl_way_frames(context, &w->way, w->step * speed, w->step * plan->ahead, plan->fov, eyes));
    if (!eyes->list.count)
        return sl_fail(context, SL_BAD_ARGUMENT, "the way is shorter than a step of %g",
                       w->step * speed);
    return SL_OK;
}

/// Adds a row for a choice. `frames` is filled where it is not NULL.
static sl_status add_row(sl_console *console, const walk_plan *plan, walk_work *w,
                         const sl_walk_choice *choice, double speed, const sl_eyes *eyes,
                         double **frames) {
    sl_context *context = console->context;
    const sl_walk_scene scene = {&w->baked, &w->hierarchy, 1e-9 * plan->wall_cost, plan->repeat};
    sl_walk_row row = {.choice = *choice, .speed = speed, .steps = eyes->list.count};
    SL_TRY(SL_ARRAY_ROOM(context, &w->rows, 1));
    if (frames) {
        *frames = sl_alloc_array(context, row.steps * SL_FIGURES, sizeof **frames);
        if (!*frames) return SL_NO_MEMORY;
    }
    SL_TRY(sl_walk_run(console, &scene, choice, eyes, row.means, frames ? *frames : NULL));
    w->rows.items[w->rows.count++] = row;
    return SL_OK;
}

enum { MOST_CHOICES = 64 };

/// The methods with the tests asked for, and culling by baked visible sets where there are any.
static size_t gather_choices(const walk_plan *plan, const walk_work *w,
                             sl_walk_choice choices[MOST_CHOICES]) {
    size_t count = 0, method_count, test_count, eye_count;
    const sl_walk_method *methods = sl_walk_methods(&method_count);
    const sl_node_test *tests = sl_node_tests(&test_count);
    const sl_eye_method *eyes = sl_eye_methods(&eye_count);
    for (size_t t = 0; t < test_count; t++)
        for (size_t m = 0; m < method_count; m++) {
            if (!(plan->methods >> m & 1) || !(plan->tests >> t & 1)) continue;
            choices[count] = (sl_walk_choice){.method = &methods[m], .options = plan->options};
            choices[count++].options.test = &tests[t];
        }
    for (size_t i = 0; i < eye_count && w->baked.visibility.pvs.cell_count; i++)
        choices[count++] = (sl_walk_choice){.baked = &eyes[i]};
    return count;
}

/// The walk at the speed asked for: the table, and the files of it.
static sl_status walk_once(sl_console *console, const walk_plan *plan, walk_work *w) {
    sl_context *context = console->context;
    sl_walk_choice choices[MOST_CHOICES];
    double *frames[MOST_CHOICES] = {0};
    const size_t count = gather_choices(plan, w, choices);
    sl_eyes eyes = {0};
    sl_status status = make_eyes(context, plan, w, plan->speed, &eyes);
    for (size_t i = 0; i < count && status == SL_OK; i++)
        status = add_row(console, plan, w, &choices[i], plan->speed, &eyes, &frames[i]);
    sl_progress_line_clear(&console->line);
    if (status == SL_OK && plan->texts->csv)
        status = sl_walk_write_rows(context, &w->rows, plan->texts->csv);
    if (status == SL_OK && plan->texts->frames)
        status = sl_walk_write_frames(context, &w->rows, &eyes, frames, plan->texts->frames);
    if (status == SL_OK) {
        printf("%zu steps of %g, %zu nodes, %zu walls, view cone of %g degrees; means a frame\n",
               eyes.list.count, w->step * plan->speed, (size_t)w->hierarchy.node_count,
               (size_t)w->baked.space.wall_count, plan->fov);
        sl_walk_print(&w->rows);
    }
    for (size_t i = 0; i < count; i++) sl_free(context, frames[i]);
    sl_eyes_destroy(context, &eyes);
    return status;
}

// --- the study: over speeds and chances

/// The charts over speed: the paper's methods, A to D, by its Figures 8 to 10; then A and B beside
/// those beyond it.
enum { IN_PAPER = 0x0f, BEYOND = 0xf3 };
static const sl_walk_chart charts[] = {
    {"Node visibility tests over the speed of the walk", SL_FIGURE_TESTS, IN_PAPER},
    {"Time for visibility over the speed of the walk", SL_FIGURE_VISIBILITY, IN_PAPER},
    {"Time of a frame over the speed of the walk", SL_FIGURE_FRAME, IN_PAPER},
    {"Beyond the paper: node visibility tests", SL_FIGURE_TESTS, BEYOND},
    {"Beyond the paper: time of a frame", SL_FIGURE_FRAME, BEYOND},
};
enum { CHARTS = sizeof charts / sizeof *charts };

/// The charts, in that order; then the others.
static const char *const study_files[] = {"tests.png",        "visibility.png",    "frames.png",
                                          "beyond_tests.png", "beyond_frames.png", "chances.png",
                                          "speeds.csv",       "chances.csv",       NULL};

static sl_status run_speeds(sl_console *console, const walk_plan *plan, walk_work *w) {
    static const double speeds[] = {0.25, 0.5, 1, 2, 4, 8};
    sl_walk_choice choices[MOST_CHOICES];
    const size_t count = gather_choices(plan, w, choices);
    sl_status status = SL_OK;
    for (size_t s = 0; s < sizeof speeds / sizeof *speeds && status == SL_OK; s++) {
        sl_eyes eyes = {0};
        status = make_eyes(console->context, plan, w, speeds[s], &eyes);
        for (size_t i = 0; i < count && status == SL_OK; i++)
            status = add_row(console, plan, w, &choices[i], speeds[s], &eyes, NULL);
        sl_eyes_destroy(console->context, &eyes);
    }
    return status;
}

/// Each method that skips by the chance that is given, at each tenth of it.
static sl_status run_chances(sl_console *console, const walk_plan *plan, walk_work *w) {
    sl_context *context = console->context;
    size_t method_count, test_count;
    const sl_walk_method *methods = sl_walk_methods(&method_count);
    const sl_node_test *tests = sl_node_tests(&test_count);
    sl_eyes eyes = {0};
    sl_status status = make_eyes(context, plan, w, plan->speed, &eyes);
    for (size_t m = 0; m < method_count; m++) {
        if (strcmp(methods[m].name, "skipping") != 0) continue;
        for (size_t t = 0; t < test_count; t++)
            for (int tenths = 0; tenths < 10 && status == SL_OK; tenths++) {
                if (!(plan->tests >> t & 1)) continue;
                sl_walk_choice choice = {.method = &methods[m], .options = plan->options};
                choice.options.test = &tests[t];
                choice.options.p_skip = tenths / 10.;
                status = add_row(console, plan, w, &choice, plan->speed, &eyes, NULL);
            }
    }
    sl_eyes_destroy(context, &eyes);
    return status;
}

static sl_status write_study(sl_context *context, const walk_plan *plan, const walk_work *w,
                             const walk_work *chances, int file, const char *path) {
    size_t t = 0;
    while (!(plan->tests >> t & 1)) t++;
    const char *test = sl_node_tests(&(size_t){0})[t].name;
    if (file < CHARTS) return sl_walk_draw_speeds(context, &w->rows, &charts[file], test, path);
    if (file > CHARTS)
        return sl_walk_write_rows(context, file == CHARTS + 1 ? &w->rows : &chances->rows, path);
    return sl_walk_draw_chances(context, &chances->rows,
                                "Time of a frame over the chance to skip a test", path);
}

static sl_status study(sl_console *console, const walk_plan *plan, walk_work *w) {
    sl_context *context = console->context;
    sl_folder folder;
    walk_work chances = *w;
    chances.rows = (sl_walk_rows){0};
    SL_TRY(sl_folder_open(context, plan->texts->output, study_files, &folder));
    sl_status status = run_speeds(console, plan, w);
    if (status == SL_OK) status = run_chances(console, plan, &chances);
    for (int i = 0; study_files[i] && status == SL_OK; i++) {
        char *path = sl_folder_file(context, &folder, study_files[i]);
        status = path ? write_study(context, plan, w, &chances, i, path) : SL_NO_MEMORY;
        sl_free(context, path);
    }
    sl_free(context, chances.rows.items);
    sl_progress_line_clear(&console->line);
    return sl_folder_close(context, &folder, status);
}

static sl_status work(sl_console *console, const walk_plan *plan, walk_work *w) {
    SL_TRY(read_space(console->context, plan, &w->baked));
    SL_TRY(sl_hierarchy_make(console->context, &w->baked.space, &w->hierarchy));
    SL_TRY(lay_way(console->context, plan, w));
    return plan->texts->output ? study(console, plan, w) : walk_once(console, plan, w);
}

static void print_tables(void) {
    size_t count;
    const sl_walk_method *methods = sl_walk_methods(&count);
    puts("\nmethods, as Bittner & Havran 2002 have them, and beyond:");
    for (size_t i = 0; i < count; i++) printf("  %-12s%s\n", methods[i].name, methods[i].what);
    const sl_node_test *tests = sl_node_tests(&count);
    puts("\ntests:");
    for (size_t i = 0; i < count; i++) printf("  %-12s%s\n", tests[i].name, tests[i].what);
    puts("\nThe table: node visibility tests a frame, what share the method saves of them, tests "
         "against\nthe view cone, states taken from neighbours, tests skipped, cells and walls "
         "drawn, and the\ntimes to find the cells, to draw their walls (into a row of 640 pixels "
         "with a depth buffer),\nand both. Of a baked file culling by its visible sets follows.");
}

sl_status sl_cmd_walk(sl_console *console, int argc, char **argv) {
    walk_texts t = {0};
    const sl_option_spec options[] = {
        {"path", 0, "P.txt|NAME", NULL, &t.path,
         "a path of the map by its name, or a file with a line\n'x y' a point; without it a tour "
         "from the map's start"},
        {"shut", 0, "NAME,...", NULL, &t.shut,
         "doors that are shut, the others being open; 'none':\nall open; without it as the map "
         "says"},
        {"steps", 0, "N", NULL, &t.steps, "frames of the whole way at speed 1; 980 without it"},
        {"step", 0, "LENGTH", NULL, &t.step, "instead: how far a frame goes at speed 1"},
        {"speed", 0, "S", NULL, &t.speed, "relative speed; 1 without it"},
        {"fov", 0, "DEGREES", NULL, &t.fov, "width of the view cone; 60 without it"},
        {"ahead", 0, "STEPS", NULL, &t.ahead,
         "the eye looks at the point of the way so many steps\non; 10 without it"},
        {"method", 0, "NAME,...", NULL, &t.methods, "these methods; all without it"},
        {"test", 0, "NAME,...", NULL, &t.tests, "these node visibility tests; all without it"},
        {"occluders", 0, "N", NULL, &t.occluders, "chosen for each frame; 16 without it"},
        {"cheap", 0, "WALLS", NULL, &t.cheap, "draw a node of no more walls without a test"},
        {"p-vp", 0, "P", NULL, &t.p_vp, "the chance to try propagation; 0.5 without it"},
        {"p-skip", 0, "P", NULL, &t.p_skip, "the chance to skip a test; 0.5 without it"},
        {"seed", 0, "N", NULL, &t.seed, "of chances and tours; 1 without it"},
        {"repeat", 0, "N", NULL, &t.repeat, "walk so often; times are the least. 3 without it"},
        {"wall-cost", 0, "NS", NULL, &t.wall_cost,
         "count so many nanoseconds for drawing a wall instead\nof what it takes here"},
        {"csv", 0, "FILE.csv", NULL, &t.csv, "all figures of the table"},
        {"frames", 0, "FILE.csv", NULL, &t.frames, "all figures of each frame"},
        {"output", 'o', "DIR", NULL, &t.output,
         "instead of one walk: speeds from 0.25 to 8 and chances\nfrom 0 to 0.9, as tables and "
         "charts"},
        SL_PIPELINE_OPTIONS(t.pipeline),
    };
    const sl_command_usage usage = {
        .name = "walk",
        .synopsis = "MAP|FILE.slv [--path P.txt|NAME] [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Walks a path and culls frame by frame, without visible sets: down the hierarchy, "
                "each node\nagainst a few large occluders, with what the frame before tells. "
                "Counts and times what each\nmethod does. No method misses anything that is seen.",
        .tables = print_tables,
        .examples = "  sightline walk office.map\n"
                    "  sightline walk office.slv --path tour.txt --speed 2 --frames frames.csv\n"
                    "  sightline walk office.map --test tree -o study",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &t.input, &helped));
    if (helped) return SL_OK;
    walk_plan plan;
    SL_TRY(make_plan(console->context, &t, &plan));
    walk_work w = {0};
    const sl_status status = work(console, &plan, &w);
    sl_free(console->context, w.rows.items);
    sl_free(console->context, w.way.items);
    sl_hierarchy_destroy(console->context, &w.hierarchy);
    sl_baked_destroy(console->context, &w.baked);
    return status;
}
