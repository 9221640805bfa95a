#include "commands.h"
#include "eye_run.h"
#include "isovist.h"
#include "outputs.h"
#include "pipeline.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// The options as they are given.
typedef struct isovist_texts {
    sl_pipeline_texts pipeline;
    sl_option_list at;
    const char *input, *at_text, *grid, *cells, *path, *step, *csv, *look, *fov, *range, *threads;
    const char *output, *picture, *measure, *width, *title, *mirror_depth;
    bool dark;
} isovist_texts;

/// The options as they are meant.
typedef struct isovist_plan {
    const isovist_texts *texts;
    sl_pipeline pipeline;
    sl_eye like; ///< the heading and cone of eyes that say nothing of it
    double grid, step, range;
    uint64_t mirror_depth;
    bool range_given;
    size_t measure;
    unsigned threads;
    sl_draw_options drawing;
} isovist_plan;

/// What is worked with.
typedef struct isovist_work {
    sl_baked baked;
    sl_outline outline;
    sl_room_mirrors mirrors;
    sl_isovist_scene scene;
    sl_eyes eyes;
    sl_isovist *isovists;
} isovist_work;

// --- the options

static sl_status read_length(sl_context *context, const char *option, const char *text,
                             double *value) {
    SL_TRY(sl_option_number(context, option, text, value));
    if (text && !(*value > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a number over 0 is needed", option, text);
    return SL_OK;
}

static sl_status plan_eyes(sl_context *context, const isovist_texts *t, isovist_plan *plan) {
    const int ways = (t->at.count > 0) + !!t->grid + !!t->cells + !!t->path + !!t->csv;
    if (ways > 1)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "where to look from: give one of --at, --grid, --cells, --path, --csv");
    if (t->step && !t->path)
        return sl_fail(context, SL_BAD_ARGUMENT, "--step is for --path, which is not given");
    if (t->picture && (t->path || t->csv))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--picture is for points (--at, starts) and grids (--grid, --cells)");
    if (t->measure && !(t->picture && (t->grid || t->cells)))
        return sl_fail(context, SL_BAD_ARGUMENT, "--measure is for the --picture of a grid");
    plan->like.fov = 360;
    SL_TRY(sl_option_number(context, "--look", t->look, &plan->like.look));
    SL_TRY(sl_option_number(context, "--fov", t->fov, &plan->like.fov));
    if (!(plan->like.fov >= 0 && plan->like.fov <= 360))
        return sl_fail(context, SL_BAD_ARGUMENT, "--fov %s: 0 to 360 degrees are needed", t->fov);
    SL_TRY(read_length(context, "--grid", t->grid, &plan->grid));
    SL_TRY(read_length(context, "--step", t->step, &plan->step));
    SL_TRY(read_length(context, "--range", t->range, &plan->range));
    plan->mirror_depth = 1;
    SL_TRY(sl_option_count(context, "--mirror-depth", t->mirror_depth, 16, &plan->mirror_depth));
    plan->range_given = t->range != NULL;
    return SL_OK;
}

static sl_status plan_drawing(sl_context *context, const isovist_texts *t, isovist_plan *plan) {
    const sl_name_table measures = sl_isovist_measures();
    SL_TRY(sl_option_choice(context, "--measure", t->measure, &measures, &plan->measure));
    SL_TRY(sl_picture_plan(context, t->width, t->title, t->dark, &plan->drawing));
    return sl_picture_check(context, t->input, "--picture", t->picture);
}

static sl_status make_plan(sl_context *context, const isovist_texts *t, isovist_plan *plan) {
    uint64_t threads = 0;
    plan->texts = t;
    SL_TRY(plan_eyes(context, t, plan));
    SL_TRY(plan_drawing(context, t, plan));
    SL_TRY(sl_option_count(context, "--threads", t->threads, 1024, &threads));
    plan->threads = (unsigned)threads;
    SL_TRY(sl_output_check(context, t->input, "-o", t->output));
    return sl_pipeline_plan(context, t->input, &t->pipeline, &plan->pipeline);
}

// --- the work

static sl_status check_effects(sl_context *context, sl_map *map) {
    return sl_effects_check(context, map, "isovist", SL_EFFECT_RANGE | SL_EFFECT_MIRROR);
}

static sl_status read_space(sl_context *context, const isovist_plan *plan, sl_baked *baked) {
    const isovist_texts *t = plan->texts;
    if (sl_input_ends_with(t->input, ".slv")) {
        SL_TRY(sl_input_refuse_texts(context, t->input, &t->pipeline.input));
        SL_TRY(sl_input_read_baked(context, t->input, baked));
        return check_effects(context, &baked->map);
    }
    SL_TRY(sl_pipeline_read_clean(context, &plan->pipeline, &baked->map, NULL));
    SL_TRY(check_effects(context, &baked->map));
    SL_TRY(sl_pipeline_subdivide(context, &plan->pipeline, &baked->map, &baked->space));
    return sl_pipeline_check(context, &plan->pipeline, &baked->space);
}

static sl_status add_points(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    for (size_t i = 0; i < plan->texts->at.count; i++) {
        const char *text = plan->texts->at.items[i];
        sl_eye eye = plan->like;
        SL_TRY(sl_option_point(context, "--at", text, &eye.at));
        if (sl_space_locate(&w->baked.space, eye.at) == SL_NO_CELL)
            return sl_input_fail_outside(context, "--at", text, w->baked.space.bounds);
        SL_TRY(sl_eyes_add(context, &w->eyes, eye));
    }
    return SL_OK;
}

static sl_status add_path(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    const char *name = plan->texts->path;
    const sl_map *map = &w->baked.map;
    for (size_t i = 0; i < map->path_count; i++)
        if (strcmp(map->paths[i].name, name) == 0)
            return sl_eyes_add_path(context, &map->paths[i], plan->step, plan->like, &w->eyes);
    const sl_name_table paths = {"path", map->paths, sizeof *map->paths, map->path_count};
    char names[SL_NAME_LIST];
    sl_name_list(&paths, names);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--path %s: the map has no path of that name; its paths: %s", name, names);
}

/// Without a word on where to look from: from the map's starts, with their headings.
static sl_status add_starts(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    const sl_map *map = &w->baked.map;
    if (!map->start_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the map has no start to look from: give one of --at, --grid, --cells, "
                       "--path, --csv");
    for (size_t i = 0; i < map->start_count; i++) {
        const double look = plan->texts->look ? plan->like.look : map->starts[i].heading;
        SL_TRY(sl_eyes_add(context, &w->eyes, (sl_eye){map->starts[i].at, look, plan->like.fov}));
    }
    return SL_OK;
}

static sl_status gather_eyes(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    const isovist_texts *t = plan->texts;
    const sl_space *space = &w->baked.space;
    if (t->at.count) return add_points(context, plan, w);
    if (t->path) return add_path(context, plan, w);
    if (t->csv) return sl_eyes_read_csv(context, t->csv, space, plan->like, &w->eyes);
    if (!t->grid && !t->cells) return add_starts(context, plan, w);
    double step = plan->grid;
    if (t->cells) {
        uint64_t across = 1;
        SL_TRY(sl_option_count(context, "--cells", t->cells, 8192, &across));
        if (!across) return sl_fail(context, SL_BAD_ARGUMENT, "--cells 0: at least 1 is needed");
        const sl_box *b = &space->bounds;
        step = fmax(b->max.x - b->min.x, b->max.y - b->min.y) / (double)across;
    }
    return sl_eyes_add_grid(context, space, step, plan->like, &w->eyes);
}

static sl_status draw_grid(sl_context *context, const isovist_plan *plan, const isovist_work *w) {
    const sl_eyes *eyes = &w->eyes;
    const size_t count = eyes->columns * eyes->rows;
    double *values = sl_alloc_array(context, count, sizeof *values);
    if (!values) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) values[i] = NAN;
    for (size_t i = 0; i < eyes->list.count; i++)
        values[eyes->squares.items[i]] = sl_isovist_value(&w->isovists[i], plan->measure);
    const sl_name_table measures = sl_isovist_measures();
    const sl_field field = {.name = sl_name_table_at(&measures, plan->measure),
                            .corner = eyes->corner,
                            .step = eyes->step,
                            .columns = eyes->columns,
                            .rows = eyes->rows,
                            .values = values};
    const sl_status status =
        sl_draw_field_file(context, &w->baked, &field, &plan->drawing, plan->texts->picture);
    sl_free(context, values);
    return status;
}

static sl_status gather_parts(sl_context *context, const isovist_work *w, sl_seen_parts *parts) {
    sl_mirrored_region region = {0};
    sl_status status = SL_OK;
    for (size_t i = 0; i < w->eyes.list.count && status == SL_OK; i++) {
        const sl_view view = sl_eye_view(&w->baked.space, &w->eyes.list.items[i]);
        status = sl_isovist_look(context, &w->scene, &view, &region);
        if (status == SL_OK)
            status = sl_seen_parts_add(context, &w->baked.space, &region, true, parts);
    }
    sl_mirrored_region_destroy(context, &region);
    return status;
}

static void write_caption(const isovist_work *w, char *text, size_t size) {
    const sl_isovist *isovist = &w->isovists[0];
    const sl_region_measures *m = &isovist->measures;
    char mirrored[64] = "";
    if (w->scene.mirrors)
        snprintf(mirrored, sizeof mirrored, "  \xc2\xb7  by mirror %.6g", isovist->mirrored_area);
    snprintf(text, size,
             "area %.6g%s  \xc2\xb7  perimeter %.6g  \xc2\xb7  occlusivity %.6g  \xc2\xb7  drift "
             "%.4g at %.4g\xc2\xb0",
             m->area, mirrored, m->perimeter, m->occlusivity, m->drift_magnitude, m->drift_angle);
}

static sl_status draw_points(sl_context *context, const isovist_plan *plan, const isovist_work *w) {
    sl_seen_parts parts = {0};
    char caption[256];
    write_caption(w, caption, sizeof caption);
    sl_status status = gather_parts(context, w, &parts);
    if (status == SL_OK)
        status = sl_draw_regions_file(context, &w->baked, parts.items, parts.count,
                                      w->eyes.list.count == 1 ? caption : NULL, &plan->drawing,
                                      plan->texts->picture);
    sl_seen_parts_destroy(context, &parts);
    return status;
}

static sl_status work(sl_console *console, isovist_plan *plan, isovist_work *w) {
    sl_context *context = console->context;
    const isovist_texts *t = plan->texts;
    SL_TRY(read_space(context, plan, &w->baked));
    if (!plan->range_given) plan->range = w->baked.map.range;
    SL_TRY(gather_eyes(context, plan, w));
    SL_TRY(sl_outline_make(context, &w->baked.space, &w->outline));
    w->scene = (sl_isovist_scene){&w->outline, NULL, plan->range, (uint32_t)plan->mirror_depth};
    if (w->baked.map.mirror_count) {
        SL_TRY(sl_room_mirrors_make(context, &w->outline, &w->baked.map, &w->mirrors));
        w->scene.mirrors = &w->mirrors;
    }
    w->isovists = sl_alloc_array(context, w->eyes.list.count, sizeof *w->isovists);
    if (!w->isovists) return SL_NO_MEMORY;
    SL_TRY(sl_isovist_run(context, &w->scene, &w->eyes, plan->threads, w->isovists));
    if (t->picture)
        SL_TRY(w->eyes.columns ? draw_grid(context, plan, w) : draw_points(context, plan, w));
    sl_progress_line_clear(&console->line);
    if (t->picture && !t->output) return SL_OK;
    return sl_isovist_write(context, &w->scene, &w->eyes, w->isovists, t->output ? t->output : "-");
}

static void print_tables(void) {
    const sl_name_table measures = sl_isovist_measures();
    fputs("\nmeasures, for --measure:", stdout);
    for (size_t i = 0; i < measures.count; i++)
        printf("%s%s", i % 6 ? ", " : i ? ",\n  " : "\n  ", sl_name_table_at(&measures, i));
    putchar('\n');
}

sl_status sl_cmd_isovist(sl_console *console, int argc, char **argv) {
    isovist_texts t = {0};
    const sl_option_spec options[] = {
        {"at", 0, "X,Y", NULL, &t.at_text, "look from a point; may be given several times"},
        {"grid", 0, "STEP", NULL, &t.grid, "look from a grid over the map's inside"},
        {"cells", 0, "N", NULL, &t.cells, "likewise, N squares along the map's longer side"},
        {"path", 0, "NAME", NULL, &t.path, "look from the points of a path of the map"},
        {"step", 0, "STEP", NULL, &t.step, "look every STEP along the path instead"},
        {"csv", 0, "FILE", NULL, &t.csv,
         "look from a table: x, y, and maybe angle, field of\nview, in degrees"},
        {"look", 0, "DEGREES", NULL, &t.look, "heading, counter-clockwise from +x"},
        {"fov", 0, "DEGREES", NULL, &t.fov, "width of the view cone; 360 without it"},
        {"mirror-depth", 0, "N", NULL, &t.mirror_depth,
         "how often mirrors reflect a sightline, 0 to 16;\n1 without it"},
        {"range", 0, "R", NULL, &t.range, "see no farther; without it the map's range, if any"},
        {"output", 'o', "FILE.csv", NULL, &t.output,
         "where the table goes; without it to stdout,\nor nowhere where there is a --picture"},
        {"picture", 0, "PICTURE", NULL, &t.picture,
         "draw what the points see, or a heat map of the\ngrid: .png, .svg or .pdf, by the ending"},
        {"measure", 0, "NAME", NULL, &t.measure, "what the heat map shows; area without it"},
        {"width", 0, "PX", NULL, &t.width, "of the picture, 64 to 20000 pixels or points"},
        {"dark", 0, NULL, &t.dark, NULL, "light on dark"},
        {"title", 0, "TEXT", NULL, &t.title, "a line over the picture"},
        {"threads", 0, "N", NULL, &t.threads, "0, as without it: one a core"},
        SL_PIPELINE_OPTIONS(t.pipeline),
    };
    const sl_command_usage usage = {
        .name = "isovist",
        .synopsis = "MAP|FILE.slv [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Finds the region that is seen from each of many points, exactly, and prints its "
                "measures\nas CSV, under the names that depthmapX gives them. Without a word on "
                "where to look\nfrom, that is from the map's starts.",
        .tables = print_tables,
        .examples = "  sightline isovist office.map --at 53,20 --picture seen.png\n"
                    "  sightline isovist office.map --grid 0.5 --measure occlusivity --picture "
                    "heat.png -o all.csv",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .repeats = "at",
        .repeated = &t.at,
    };
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &t.input, &helped));
    if (helped) return SL_OK;
    isovist_plan plan = {0};
    SL_TRY(make_plan(console->context, &t, &plan));
    isovist_work w = {0};
    const sl_status status = work(console, &plan, &w);
    sl_free(console->context, w.isovists);
    sl_eyes_destroy(console->context, &w.eyes);
    sl_room_mirrors_destroy(console->context, &w.mirrors);
    sl_outline_destroy(console->context, &w.outline);
    sl_baked_destroy(console->context, &w.baked);
    return status;
}
