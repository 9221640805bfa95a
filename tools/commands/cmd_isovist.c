/// `sightline isovist`: visible regions of many points, their measures, heat maps.
#include "arguments/help.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/pipeline.h"
#include "inputs/within.h"
#include "reports/heat_map.h"
#include "reports/json_print.h"
#include "sightline/draw.h"
#include "sightline/support.h"
#include "studies/cover_report.h"
#include "studies/exposure.h"
#include "studies/eye_run.h"
#include "studies/isovist.h"
#include "studies/isovist_set.h"
#include "studies/isovist_union.h"
#include "studies/isovist_walk.h"
#include "studies/places.h"
#include "system/built.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct isovist_plan {
    const char *input, *path, *points, *see, *output, *picture;
    const char *frames, *chart; ///< of a walk along a path
    map_pipeline pipeline;
    door_choice doors;
    within_plan within;
    option_list at;
    set_choice set;
    eye_place like; ///< the heading and cone of eyes that say nothing of it
    double grid, step, range;
    uint32_t squares, mirror_depth;
    const char *look_given, *squares_given, *range_given, *measure_given;
    size_t measure;
    sl_point scale; ///< from x to y
    const char *scale_given;
    unsigned threads;
    bool together;
    table_part part;
    sl_draw_options drawing;
} isovist_plan;

/// The space, and what its eyes see.
typedef struct isovist_work {
    sl_baked baked;
    sl_query *query;
    isovist_scene scene;
    eye_places eyes;
    isovist_result *isovists; ///< NULL with --union
    seen_parts parts;         ///< of all eyes, once they are gathered
    sl_overlay together;      ///< with --union
    isovist_set set;          ///< of a line or an area
    exposed_things things;    ///< that the line sees
} isovist_work;

// --- the options

static sl_status make_plan(sl_context *context, isovist_plan *p) {
    const bool grid = p->grid > 0 || p->squares_given;
    const int sets = set_choices(&p->set);
    const int ways =
        (p->at.count > 0) + (p->grid > 0) + !!p->squares_given + !!p->path + !!p->points + sets;
    if (ways > 1)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "where to look from: give one of --at, --grid, --squares, --path, --points, "
                       "--from-line, --from-area, --along");
    if (sets && (p->together || p->look_given || p->like.fov < 360))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--union, --look and --fov are not for lines and areas (--from-line, "
                       "--from-area, --along)");
    if (p->part.text && (sets || p->together || p->picture || p->frames || p->chart))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--shard is for a table of viewpoints: no --picture, --frames, --chart, "
                       "--union, lines or areas");
    if (p->see && !p->set.along && !p->set.line)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--see is for a path: give --along or --from-line");
    if (p->see && p->output && name_ends_with(p->output, ".geojson"))
        return sl_fail(context, SL_BAD_ARGUMENT, "--see makes a table: name it .csv");
    if (p->output && name_ends_with(p->output, ".dxf") && (sets || p->together))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "-o %s: a drawing has the regions of single viewpoints; --union, lines and "
                       "areas make .csv or .geojson",
                       p->output);
    if (p->step > 0 && !p->path)
        return sl_fail(context, SL_BAD_ARGUMENT, "--step is for --path, which is not given");
    if ((p->frames || p->chart) && p->together)
        return sl_fail(context, SL_BAD_ARGUMENT, "--union goes without --frames and --chart");
    if (p->frames) SL_TRY(built_need_pictures(context));
    if (p->measure_given && !(p->picture && grid) && !p->chart)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--measure is for the --picture of a grid, and for --chart");
    if (p->scale_given && !(p->picture && grid))
        return sl_fail(context, SL_BAD_ARGUMENT, "--scale is for the --picture of a grid");
    if (p->scale_given && !(p->scale.x < p->scale.y))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--scale %.9g,%.9g: expected the smaller number first, as 0,500", p->scale.x,
                       p->scale.y);
    if (p->within.path && !grid)
        return sl_fail(context, SL_BAD_ARGUMENT, "--within is for a grid (--grid, --squares)");
    if (p->together && grid)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--union is for single viewpoints (--at, --path, --points), not for a grid");
    SL_TRY(within_check(context, &p->within));
    return pipeline_plan(context, p->input, &p->pipeline);
}

// --- the work

static sl_status add_points(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    for (size_t i = 0; i < plan->at.count; i++) {
        const char *text = plan->at.items[i];
        eye_place eye = plan->like;
        SL_TRY(read_point(context, "--at", text, &eye.at));
        SL_TRY(input_locate(context, "--at", text, &w->baked.space, eye.at, NULL));
        SL_TRY(eyes_add(context, &w->eyes, eye));
    }
    return SL_OK;
}

/// Says how many points of a path see nothing.
static void note_solid(sl_context *context, const char *name, const isovist_work *w) {
    const sl_space *space = &w->baked.space;
    size_t solid = 0;
    for (size_t i = 0; i < w->eyes.list.count; i++) {
        const uint32_t cell = sl_space_locate(space, w->eyes.list.items[i].at);
        solid += cell != SL_NO_CELL && space->cells[cell].solid;
    }
    if (solid)
        sl_note(context, "--path %s: %zu of %zu points are in solid ground and see nothing", name,
                solid, w->eyes.list.count);
}

static sl_status note_path(sl_context *context, const sl_path *path, const isovist_work *w) {
    char what[128];
    snprintf(what, sizeof what, "--path %s", path->name);
    places_note_outside(context, what, &w->baked.space, w->eyes.list.items, w->eyes.list.count);
    return places_note_path(context, what, &w->baked, path->points, path->count);
}

/// The points of a table.
static sl_status add_table(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    const sl_space *space = &w->baked.space;
    char what[256];
    SL_TRY(eyes_read_table(context, plan->points, space, plan->like, &w->eyes));
    snprintf(what, sizeof what, "--points %s", plan->points);
    places_note_outside(context, what, space, w->eyes.list.items, w->eyes.list.count);
    return SL_OK;
}

static sl_status add_path(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    const char *name = plan->path;
    const sl_map *map = &w->baked.map;
    for (size_t i = 0; i < map->path_count; i++)
        if (strcmp(map->paths[i].name, name) == 0) {
            SL_TRY(eyes_add_path(context, &map->paths[i], plan->step, plan->like, &w->eyes));
            note_solid(context, name, w);
            return note_path(context, &map->paths[i], w);
        }
    const name_table paths = {"path", map->paths, sizeof *map->paths, map->path_count, NULL};
    char names[NAME_LIST];
    name_list(&paths, names);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--path %s: the map has no path of that name; its paths: %s", name, names);
}

/// The default viewpoints: the map's starts with their headings, but for those in solid ground.
static sl_status add_starts(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    const sl_map *map = &w->baked.map;
    if (!map->start_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the map has no start to look from: give one of --at, --grid, --squares, "
                       "--path, --points");
    const sl_space *space = &w->baked.space;
    for (size_t i = input_next_start(map, space, 0); i < map->start_count;
         i = input_next_start(map, space, i + 1)) {
        const double look = plan->look_given ? plan->like.heading : map->starts[i].heading;
        SL_TRY(
            eyes_add(context, &w->eyes, (eye_place){map->starts[i].at, look, plan->like.fov, 0}));
    }
    if (w->eyes.list.count) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "the map's starts are on the border of solid ground: give one of --at, --grid, "
                   "--squares, --path, --points");
}

static sl_status gather_eyes(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    const sl_space *space = &w->baked.space;
    if (plan->at.count) return add_points(context, plan, w);
    if (plan->path) return add_path(context, plan, w);
    if (plan->points) return add_table(context, plan, w);
    if (!(plan->grid > 0) && !plan->squares_given) return add_starts(context, plan, w);
    double step = plan->grid;
    if (plan->squares_given) {
        const sl_box *b = &space->bounds;
        step = fmax(b->max.x - b->min.x, b->max.y - b->min.y) / (double)plan->squares;
    }
    const sl_status laid = eyes_add_grid(context, space, step, plan->like, &w->eyes);
    SL_TRY(pipeline_name_stray(context, plan->input, &w->baked.map, space, laid));
    if (!plan->within.path) return SL_OK;
    sl_map outlines = {0};
    SL_TRY(within_read(context, &plan->within, &plan->pipeline.input, &outlines));
    eyes_keep_within(&outlines, &w->eyes);
    sl_map_destroy(context, &outlines);
    return w->eyes.list.count ? SL_OK : within_fail(context, &plan->within);
}

static sl_status draw_grid(sl_context *context, const isovist_plan *plan, const isovist_work *w) {
    const eye_places *eyes = &w->eyes;
    const size_t count = eyes->columns * eyes->rows;
    const sl_measure *measure = &sl_measures(SL_ISOVIST, &(size_t){0})[plan->measure];
    double *field_values = sl_alloc_array(context, count, sizeof *field_values);
    double *values = sl_alloc_array(context, eyes->list.count, sizeof *values);
    uint32_t *sizes = sl_alloc_array(context, eyes->list.count, sizeof *sizes);
    sl_status status = field_values && values && sizes ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = isovist_part_sizes(context, w->query, eyes, sizes);
    for (size_t i = 0; i < count && status == SL_OK; i++) field_values[i] = NAN;
    for (size_t i = 0; i < eyes->list.count && status == SL_OK; i++)
        field_values[eyes->squares.items[i]] = values[i] =
            sl_measure_value(measure, &w->isovists[i].measures);
    char unit[SL_UNIT_TEXT];
    sl_measure_say_unit(measure, w->baked.map.unit, unit);
    const heat_map heat = {.input = plan->input,
                           .map = plan->pipeline.input.import.map,
                           .measure = measure->name,
                           .drawing = &plan->drawing,
                           .path = plan->picture};
    sl_field field = {.unit = *unit ? unit : NULL,
                      .corner = eyes->corner,
                      .step = eyes->step,
                      .columns = eyes->columns,
                      .rows = eyes->rows,
                      .values = field_values,
                      .least = plan->scale.x,
                      .most = plan->scale.y};
    if (status == SL_OK) {
        heat_map_scale(context, plan->scale_given != NULL, values, sizes,
                       (uint32_t)eyes->list.count, &field.least, &field.most);
        status = heat_map_draw(context, &w->baked, &heat, &field);
    }
    sl_free(context, field_values);
    sl_free(context, values);
    sl_free(context, sizes);
    return status;
}

static sl_status gather_parts(sl_context *context, isovist_work *w) {
    sl_mirrored_region region = {0};
    sl_status status = SL_OK;
    for (size_t i = 0; i < w->eyes.list.count && status == SL_OK; i++) {
        status = sl_check_cancelled(context);
        if (status == SL_OK)
            status = isovist_look(context, &w->scene, &w->eyes.list.items[i], &region);
        if (status == SL_OK)
            status = seen_parts_add(context, &w->baked.space, &region, true, &w->parts);
    }
    sl_mirrored_region_destroy(context, &region);
    return status;
}

/// A viewpoint outside would count what is no part of the plan.
static sl_status need_inside(sl_context *context, const isovist_work *w) {
    const sl_space *space = &w->baked.space;
    for (size_t i = 0; i < w->eyes.list.count; i++) {
        const sl_point at = w->eyes.list.items[i].at;
        const uint32_t cell = sl_space_locate(space, at);
        if (cell != SL_NO_CELL && !space->cells[cell].inside && !space->cells[cell].solid)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "--union counts what is inside, and the viewpoint %.9g,%.9g is outside; "
                           "--start %.9g,%.9g takes all that it reaches as inside",
                           at.x, at.y, at.x, at.y);
    }
    if (space->inside_count) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "--union: nothing of the map is inside");
}

static sl_status join_regions(sl_context *context, isovist_work *w) {
    SL_TRY(need_inside(context, w));
    SL_TRY(gather_parts(context, w));
    return isovist_union_make(context, &w->baked.space, &w->parts, &w->together);
}

/// "2 viewpoints see 52 m² of 60 m² (87 %)"
static void say_union(const isovist_work *w, char *text, size_t size) {
    const double *areas = w->together.areas;
    const char *name = w->baked.map.unit, *space = *name ? " " : "",
               *square = *name ? "\xc2\xb2" : "";
    snprintf(text, size, "%zu viewpoint%s %.6g%s%s%s of %.6g%s%s%s inside (%.3g %%)",
             w->together.shape_count, w->together.shape_count == 1 ? " sees" : "s see", areas[1],
             space, name, square, areas[0], space, name, square, 100 * areas[1] / areas[0]);
}

static void write_caption(const isovist_work *w, char *text, size_t size) {
    const isovist_result *isovist = &w->isovists[0];
    const sl_region_measures *m = &isovist->measures;
    const char *name = w->baked.map.unit, *space = *name ? " " : "",
               *square = *name ? "\xc2\xb2" : "";
    char unit[32], mirrored[64] = "";
    snprintf(unit, sizeof unit, "%s%s", space, name);
    if (w->scene.mirrored)
        snprintf(mirrored, sizeof mirrored, "  \xc2\xb7  by mirror %.6g%s%s",
                 isovist->mirrored_area, unit, square);
    snprintf(text, size,
             "area %.6g%s%s%s  \xc2\xb7  perimeter %.6g%s  \xc2\xb7  occlusivity %.6g%s  \xc2\xb7  "
             "drift %.4g%s at %.4g\xc2\xb0",
             m->area, unit, square, mirrored, m->perimeter, unit, m->occlusivity, unit,
             m->drift_magnitude, unit, m->drift_angle);
}

/// The viewpoints as cameras, under the names of their table.
static sl_status list_cameras(sl_context *context, const isovist_plan *plan, const isovist_work *w,
                              sl_cameras *out) {
    for (size_t i = 0; i < w->eyes.list.count; i++) {
        const eye_place *eye = &w->eyes.list.items[i];
        const double range = plan->range > 0 && eye->range > 0 ? fmin(plan->range, eye->range)
                                                               : fmax(plan->range, eye->range);
        const sl_camera camera = {
            .view = {.at = eye->at, .heading = eye->heading, .fov = eye->fov, .range = range},
            .name = i < w->eyes.table.count ? w->eyes.table.items[i].name : NULL};
        SL_TRY(sl_cameras_add(context, out, &camera));
    }
    return SL_OK;
}

/// Draws what they see together, as `cover` does: classes, viewpoints, blind spots and the key.
static sl_status draw_union(sl_context *context, const isovist_plan *plan, const isovist_work *w) {
    char caption[256];
    sl_cameras cameras = {0};
    sl_coverage coverage = {0};
    sl_viewpoint *viewpoints = NULL;
    // What was asked last has left its own range.
    sl_status status = sl_query_set_range(context, w->query, plan->range);
    if (status == SL_OK) status = list_cameras(context, plan, w, &cameras);
    if (status == SL_OK) status = cover_viewpoints(context, &cameras, &viewpoints);
    if (status == SL_OK)
        status = sl_coverage_make(context, w->query, viewpoints, cameras.count, &coverage);
    const cover_report report = {
        plan->input, plan->pipeline.input.import.map, &w->baked, &cameras, &coverage, NULL};
    if (status == SL_OK) {
        cover_sentence(&report, caption, sizeof caption);
        status = cover_draw(context, &report, NULL, caption, &plan->drawing, plan->picture);
    }
    sl_coverage_destroy(context, &coverage);
    sl_free(context, viewpoints);
    sl_cameras_destroy(context, &cameras);
    return status;
}

static sl_status draw_points(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    char caption[256];
    if (plan->together) return draw_union(context, plan, w);
    write_caption(w, caption, sizeof caption);
    SL_TRY(gather_parts(context, w));
    return built_pictures()->regions(context, &w->baked, w->parts.items, w->parts.count,
                                     w->eyes.list.count == 1 ? caption : NULL, &plan->drawing,
                                     plan->picture);
}

/// What sight goes by: shut doors are walls of the space by now.
static sl_status make_scene(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    SL_TRY(sl_query_set_range(context, w->query, plan->range));
    SL_TRY(sl_query_set_mirror_depth(context, w->query, plan->mirror_depth));
    w->scene = (isovist_scene){.query = w->query,
                               .earth = w->baked.map.earth,
                               .unit = w->baked.map.unit,
                               .mirrored = w->baked.map.mirror_count && !plan->together,
                               .range = plan->range};
    SL_TRY(sl_query_space(context, w->query, &w->scene.space, NULL));
    if (w->baked.map.mirror_count && plan->together)
        sl_note(context, "mirrors are walls here: --union counts what is seen directly");
    return sl_query_prepare(context, w->query);
}

/// A grid is all that is inside.
static sl_status note_inside(sl_context *context, const isovist_plan *plan, const isovist_work *w) {
    const sl_map *map = &w->baked.map;
    const sl_space *space = &w->baked.space;
    if (!(plan->grid > 0) && !plan->squares_given)
        return pipeline_note_inside(context, &plan->pipeline, map, space);
    return pipeline_need_inside(context, &plan->pipeline, map, space, "");
}

/// Says how many viewpoints see as far as the map goes: their measures would be others in a larger
/// map.
static void note_border(sl_context *context, const isovist_work *w) {
    const size_t count = w->eyes.list.count;
    size_t open = 0, first = 0;
    for (size_t i = count; i-- > 0;)
        if (w->isovists[i].meets_border) {
            open++;
            first = i;
        }
    if (!open) return;
    const sl_point at = w->eyes.list.items[first].at;
    sl_note(context,
            "%zu of %zu viewpoints see%s the border of the map where no wall is, the first from "
            "%.12g,%.12g: regions end there. To see farther, draw a seam around all that counts",
            open, count, open == 1 ? "s" : "", at.x, at.y);
}

static sl_status measure(sl_context *context, const isovist_plan *plan, isovist_work *w) {
    w->isovists = sl_alloc_array(context, w->eyes.list.count, sizeof *w->isovists);
    if (!w->isovists) return SL_NO_MEMORY;
    SL_TRY(isovist_run(context, &w->scene, &w->eyes, &plan->part, plan->threads, w->isovists));
    note_border(context, w);
    return SL_OK;
}

/// What is seen from a line or an area, from some point of it and from all.
static sl_status work_set(command_console *console, const isovist_plan *plan, isovist_work *w) {
    sl_context *context = console->context;
    isovist_set *set = &w->set;
    char caption[160];
    SL_TRY(sl_query_set_range(context, w->query, plan->range));
    SL_TRY(isovist_set_make(context, &plan->set, &w->baked, w->query, set));
    isovist_set_say(set, w->baked.map.unit, caption, sizeof caption);
    const sl_drawn_set drawn = {set->points, set->count, set->kind == SL_SET_AREA,
                                set->regions[SL_SEEN_FROM_SOME].shape,
                                set->regions[SL_SEEN_FROM_ALL].shape};
    if (plan->picture)
        SL_TRY(built_pictures()->set(context, &w->baked, &drawn, caption, &plan->drawing,
                                     plan->picture));
    if (plan->see) {
        SL_TRY(exposure_make(context, plan->see, &plan->pipeline.input, &w->baked, w->query,
                             set->points, set->count, &w->things));
        progress_line_clear(&console->line);
        SL_TRY(exposure_write(context, &w->things, plan->output ? plan->output : "-"));
        exposure_say(&w->things, caption, sizeof caption);
        sl_note(context, "%s", caption);
        return SL_OK;
    }
    progress_line_clear(&console->line);
    SL_TRY(isovist_set_write(context, set, &w->baked.map.earth, plan->output ? plan->output : "-"));
    sl_note(context, "%s", caption);
    return SL_OK;
}

static sl_status work(command_console *console, isovist_plan *plan, isovist_work *w) {
    sl_context *context = console->context;
    SL_TRY(pipeline_read_space(
        context, &plan->pipeline, "isovist",
        SL_EFFECT_RANGE | SL_EFFECT_MIRROR | SL_EFFECT_DOOR | SL_EFFECT_ONEWAY, NULL, &w->baked));
    if (!name_ends_with(plan->input, ".slv")) SL_TRY(note_inside(context, plan, w));
    SL_TRY(doors_shut(context, &plan->doors, &w->baked));
    if (!plan->range_given) plan->range = w->baked.map.range;
    SL_TRY(sl_query_over(context, &w->baked.space, &w->baked.map, NULL, &w->query));
    if (set_choices(&plan->set)) return work_set(console, plan, w);
    SL_TRY(gather_eyes(context, plan, w));
    SL_TRY(make_scene(context, plan, w));
    SL_TRY(plan->together ? join_regions(context, w) : measure(context, plan, w));
    const isovist_walk walk = {&w->baked, &w->scene, &w->eyes, plan->step};
    if (plan->chart)
        SL_TRY(isovist_walk_chart(context, &walk, w->isovists, plan->measure, &plan->drawing,
                                  plan->chart));
    if (plan->frames) SL_TRY(isovist_walk_frames(context, &walk, &plan->drawing, plan->frames));
    if (plan->picture)
        SL_TRY(w->eyes.columns ? draw_grid(context, plan, w) : draw_points(context, plan, w));
    progress_line_clear(&console->line);
    if (plan->picture && !plan->output && w->eyes.columns) return SL_OK; // a long table
    const char *path = plan->output ? plan->output : "-";
    if (!plan->together)
        return isovist_write(context, &w->scene, &w->eyes, w->isovists, &plan->part, path);
    char text[256];
    say_union(w, text, sizeof text);
    SL_TRY(isovist_union_write(context, &w->together, &w->baked.map.earth, path));
    sl_note(context, "%s", text);
    return SL_OK;
}

static void print_tables(void) {
    help_measures(SL_ISOVIST);
}

sl_status cmd_isovist(command_console *console, int argc, char **argv) {
    isovist_plan plan = {.pipeline = pipeline_default(),
                         .like = {.fov = 360},
                         .mirror_depth = 1,
                         .drawing = built_draw_options()};
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table picture = picture_option_table(&plan.drawing, "picture frames chart", true);
    const option_table doors = door_option_table(&plan.doors);
    const option_table within = within_option_table(&plan.within, WITHIN_GRID);
    const option_spec options[] = {
        {"at", 0, "X,Y", "look from a point; may be given several times", .list = &plan.at},
        {"grid", 0, "STEP",
         "look from the middles of squares that are inside; squares begin at the lower left corner "
         "of the map's bounds (points at multiples of STEP: sightline vga --measures isovist)",
         .number = &plan.grid, .over_0 = true},
        {"output", 'o', "TABLE",
         "the table: .csv, .geojson with the regions, or .dxf with the regions alone (default: CSV "
         "to standard output)",
         .text = &plan.output, .check = CHECK_TABLE, .endings = ".geojson .dxf"},
        {"picture", 0, "PICTURE", "draw the regions, or a heat map of the grid: .png, .svg or .pdf",
         .text = &plan.picture, .check = CHECK_PICTURE},
        {"measure", 0, "NAME", "the measure of the heat map (default: area)",
         .choice = &plan.measure, .names = measure_table(SL_ISOVIST), .given = &plan.measure_given},
        {"scale", 0, "MIN,MAX",
         "the ends of the colour scale, to compare pictures (default: smallest and largest value "
         "in parts of the plan with at least a tenth of the points of the largest part)",
         .point = &plan.scale, .given = &plan.scale_given},
        {"union", 0, NULL,
         "the area that at least 1, 2, ... viewpoints see, in place of each one's measures; in a "
         ".geojson table the pieces of it",
         .flag = &plan.together},
        {"look", 0, "DEG", "heading in degrees, counter-clockwise from +x",
         .number = &plan.like.heading, .given = &plan.look_given},
        {"fov", 0, "DEG", "width of the view cone (default: 360)", .number = &plan.like.fov,
         .most = 360, .needs = "0 to 360 degrees are needed", .rare = true},
        {"range", 0, "R", "see no farther than R (default: the map's range)", .number = &plan.range,
         .over_0 = true, .given = &plan.range_given},
        {"squares", 0, "N", "look from a grid with N squares along the map's longer side",
         .count32 = &plan.squares, .least = 1, .most = 8192, .given = &plan.squares_given,
         .rare = true},
        {"path", 0, "NAME", "look from the points of a path of the map", .text = &plan.path,
         .rare = true},
        {"from-line", 0, "X,Y,X,Y,...",
         "what is seen from some point of a line, and from all of its points",
         .text = &plan.set.line, .rare = true},
        {"from-area", 0, "X,Y,X,Y,X,Y,...",
         "the same from a convex area, or from a disc, X,Y,R (chords up to 0.001 R within it)",
         .text = &plan.set.area, .rare = true},
        {"along", 0, "PATH", "the same along a path of the map, or along the points of a CSV table",
         .text = &plan.set.along, .is_input = true, .rare = true},
        {"see", 0, "THINGS",
         "with --along or --from-line: what of each thing is seen, and along how much of the way. "
         "Names of objects, doors and layers; 'objects', 'doors': all of them; a drawing of closed "
         "outlines, or a table of corners (.csv: name,x,y)",
         .text = &plan.see, .is_input = true, .rare = true},
        {"step", 0, "STEP", "with --path: look from a point every STEP along it",
         .number = &plan.step, .over_0 = true, .rare = true},
        {"frames", 0, "DIR",
         "with --path: draw what is seen from each point, as frames of a film, frame-00001.png and "
         "so on; a note says how ffmpeg joins them",
         .text = &plan.frames, .without = "path", .rare = true},
        {"chart", 0, "PICTURE",
         "with --path: draw the --measure over the length of the way: .png, .svg or .pdf",
         .text = &plan.chart, .check = CHECK_PICTURE, .without = "path", .rare = true},
        {"points", 0, "CSV",
         "look from the viewpoints of a table: x,y or x,y,heading,fov,range; its first line "
         "may name the columns (see sightline cover)",
         .text = &plan.points, .is_input = true, .rare = true},
        {"shard", 0, "K/N", "compute part K of N of the table (1 <= K <= N), for 'sightline merge'",
         .text = &plan.part.text, .rare = true},
        {"mirror-depth", 0, "N", "largest number of reflections, up to 16 (default 1)",
         .count32 = &plan.mirror_depth, .most = 16, .rare = true},
        {"threads", 0, "N", "number of threads (default: one per core)", .count32 = &plan.threads,
         .most = 1024, .rare = true},
        {.group = &within},
        {.group = &doors},
        {.group = &picture},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "isovist",
        .synopsis = "MAP|FILE.slv [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Computes the region that is visible from each of many points, exactly, and its "
                "measures under the names of depthmapX. Default viewpoints: the map's starts.",
        .tables = print_tables,
        .examples =
            "  sightline isovist office.map --from-line 8,8,50,8 --picture corridor.png\n"
            "  sightline isovist office.map --at 53,20 --picture seen.png\n"
            "  sightline isovist office.map --grid 0.5 --picture heat.png -o all.csv\n"
            "  sightline isovist office.map --grid 2 -o seen.geojson\n"
            "  sightline isovist office.map --points cameras.csv --union --picture seen.png",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, &plan));
    SL_TRY(table_part_plan(console->context, argc, argv, plan.output, &plan.part));
    isovist_work w = {0};
    const sl_status status = work(console, &plan, &w);
    sl_free(console->context, w.isovists);
    seen_parts_destroy(console->context, &w.parts);
    sl_overlay_destroy(console->context, &w.together);
    isovist_set_destroy(console->context, &w.set);
    exposure_destroy(console->context, &w.things);
    eyes_destroy(console->context, &w.eyes);
    sl_query_destroy(console->context, w.query);
    sl_baked_destroy(console->context, &w.baked);
    return status;
}
