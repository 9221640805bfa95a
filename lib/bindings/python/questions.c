/// Questions of Python to a level, many at once. Points are shared out between threads in bundles,
/// and each thread has a query of its own.
#include "facade.h"
#include "sightline/import.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Values are copied as they lie in their structures: a double for each row of the table.
enum { REGION_COLUMNS = sizeof(sl_region_measures) / sizeof(double) };
enum { VGA_COLUMNS = sizeof(sl_vga_measures) / sizeof(double) };
/// Beside those of the region: corners, mirrored_area, parts, whether it meets the border.
enum { ISOVIST_COLUMNS = REGION_COLUMNS + 4 };

// --- names

static size_t put_name(char *text, size_t room, size_t length, const char *name) {
    for (; *name; name++, length++)
        if (length + 1 < room) text[length] = *name;
    if (length + 1 < room) text[length] = '\n';
    return length + 1;
}

/// Adds what the table says of the measures that one structure holds, by which part they are
/// computed, and whether they can be estimated, with tabs between.
static size_t put_measures(char *text, size_t room, size_t length, sl_analysis analysis,
                           sl_measure_of of) {
    size_t count;
    const sl_measure *all = sl_measures(analysis, &count);
    for (size_t i = 0; i < count; i++) {
        char unit[SL_UNIT_TEXT], line[512];
        const unsigned part = of == SL_OF_GRAPH ? 1u << all[i].group : 0;
        if (all[i].of != of) continue;
        sl_measure_say_unit(&all[i], "unit", unit);
        snprintf(line, sizeof line, "%s\t%s\t%s\t%s\t%u\t%d", all[i].name,
                 sl_measure_group_name(all[i].group), unit, all[i].meaning, part,
                 sl_vga_is_estimated(&all[i]));
        length = put_name(text, room, length, line);
    }
    return length;
}

size_t slp_names(const void *handle, const char *list, char *text, size_t room) {
    sl_context *context = ((const slp_base *)handle)->context;
    size_t n = 0, count = 0;
    if (strcmp(list, "map_formats") == 0) {
        const sl_map_format *all = sl_map_formats(context, &count);
        for (size_t i = 0; i < count; i++) n = put_name(text, room, n, all[i].name);
    } else if (strcmp(list, "methods") == 0) {
        const sl_see_method *all = sl_see_methods(&count);
        for (size_t i = 0; i < count; i++) n = put_name(text, room, n, all[i].name);
    } else if (strcmp(list, "eye_methods") == 0) {
        const sl_eye_method *all = sl_eye_methods(&count);
        for (size_t i = 0; i < count; i++) n = put_name(text, room, n, all[i].name);
    } else if (strcmp(list, "subdivisions") == 0) {
        const sl_subdivision *all = sl_subdivisions(&count);
        for (size_t i = 0; i < count; i++) n = put_name(text, room, n, all[i].name);
    } else if (strcmp(list, "exports") == 0) {
        const sl_export_format *all = sl_export_formats(context, &count);
        for (size_t i = 0; i < count; i++)
            if (!(all[i].takes & SL_EXPORT_TAKES_WAD)) n = put_name(text, room, n, all[i].name);
    } else if (strcmp(list, "measures") == 0) {
        n = put_measures(text, room, n, SL_ISOVIST, SL_OF_REGION);
        n = put_measures(text, room, n, SL_VGA, SL_OF_GRAPH);
    } else if (strcmp(list, "axial_measures") == 0) {
        const sl_measure *all = sl_measures(SL_AXIAL, &count);
        for (size_t i = 0; i < count; i++) n = put_name(text, room, n, all[i].name);
    } else if (strcmp(list, "segment_measures") == 0) {
        const sl_measure *all = sl_measures(SL_SEGMENTS, &count);
        for (size_t i = 0; i < count; i++) n = put_name(text, room, n, all[i].name);
    }
    if (room) text[n < room ? n : room - 1] = '\0';
    return n;
}

// --- many points, shared out

/// A question about point i, asked of a thread's query.
typedef struct asking {
    slp_level *level;
    atomic_size_t next_query;
    size_t count, bundle;
    sl_status (*ask)(sl_context *context, const struct asking *a, sl_query *query, void *scratch,
                     size_t i);
    const double *eyes, *points, *headings, *fovs;
    double heading, fov, tolerance;
    const sl_eye_method *method;
    bool mirrored, keep;
    uint8_t *bytes;
    double *measures;
    const sl_space *space; ///< that regions name the walls of
} asking;

/// What a thread has: a query, and memory for what it finds.
typedef struct asker {
    sl_query *query;
    uint64_t *cells;
    sl_mirrored_region region;
} asker;

static void end_asker(sl_context *context, void *job, void *state) {
    asker *w = state;
    (void)job;
    sl_mirrored_region_destroy(context, &w->region);
    sl_free(context, w->cells);
    sl_free(context, w);
}

static sl_status begin_asker(sl_context *context, void *job, void **state) {
    asking *a = job;
    asker *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    w->query = a->level->queries.items[atomic_fetch_add(&a->next_query, 1)];
    w->cells = sl_alloc_array(context, sl_eye_words(&a->level->baked.space), sizeof *w->cells);
    if (!w->cells) {
        end_asker(context, job, w);
        return SL_NO_MEMORY;
    }
    *state = w;
    return SL_OK;
}

static sl_status ask_bundle(sl_context *context, void *job, void *state, size_t bundle) {
    const asking *a = job;
    asker *w = state;
    const size_t first = bundle * a->bundle;
    for (size_t i = first; i < a->count && i < first + a->bundle; i++)
        SL_TRY(a->ask(context, a, w->query, w, i));
    return SL_OK;
}

static sl_status ask_all(asking *a, unsigned threads) {
    const size_t bundles = (a->count + a->bundle - 1) / a->bundle;
    const sl_work work = {.job = a, .begin = begin_asker, .unit = ask_bundle, .end = end_asker};
    if (threads == 0) threads = sl_core_count();
    if (threads > bundles) threads = bundles ? (unsigned)bundles : 1;
    SL_TRY(slp_level_queries(a->level, threads));
    return sl_work_run(a->level->base.context, &work, bundles, threads);
}

static sl_point point_at(const double *points, size_t i) {
    return (sl_point){points[2 * i], points[2 * i + 1]};
}

// --- points and cells

int slp_level_locate(slp_level *level, const double *points, size_t count, int64_t *cells) {
    for (size_t i = 0; i < count; i++) {
        const uint32_t cell = sl_space_locate(&level->baked.space, point_at(points, i));
        cells[i] = cell == SL_NO_CELL ? -1 : (int64_t)cell;
    }
    return SL_OK;
}

static sl_status ask_point(sl_context *context, const asking *a, sl_query *query, void *scratch,
                           size_t i) {
    bool sees;
    (void)scratch;
    SL_TRY(sl_query_sees(context, query, point_at(a->eyes, i), point_at(a->points, i), &sees));
    a->bytes[i] = sees;
    return SL_OK;
}

int slp_level_can_see(slp_level *level, const double *eyes, const double *points, size_t count,
                      unsigned threads, uint8_t *sees) {
    asking a = {.level = level, .count = count, .bundle = 256, .ask = ask_point};
    a.eyes = eyes;
    a.points = points;
    a.bytes = sees;
    return ask_all(&a, threads);
}

int slp_level_cell_sees(slp_level *level, const int64_t *from, const int64_t *to, size_t count,
                        uint8_t *sees) {
    sl_context *context = level->base.context;
    const int64_t cells = level->baked.space.cell_count;
    if (!level->has_sets)
        return sl_fail(context, SL_BAD_ARGUMENT, "there are no visible sets: bake the plan");
    for (size_t i = 0; i < count; i++) {
        bool seen;
        if (from[i] < 0 || from[i] >= cells || to[i] < 0 || to[i] >= cells)
            return sl_fail(context, SL_BAD_ARGUMENT, "there is no cell %lld; cells are 0 to %lld",
                           (long long)(from[i] < 0 || from[i] >= cells ? from[i] : to[i]),
                           (long long)cells - 1);
        SL_TRY(sl_query_can_see(context, level->queries.items[0], (uint32_t)from[i],
                                (uint32_t)to[i], &seen));
        sees[i] = seen;
    }
    return SL_OK;
}

static sl_status ask_cells(sl_context *context, const asking *a, sl_query *query, void *scratch,
                           size_t i) {
    asker *w = scratch;
    const uint32_t count = a->level->baked.space.cell_count;
    const sl_view view = sl_query_view(query, point_at(a->eyes, i), a->heading, a->fov);
    SL_TRY((a->mirrored ? sl_query_look_mirrored : sl_query_look)(context, query, &view, a->method,
                                                                  w->cells, NULL));
    for (uint32_t c = 0; c < count; c++) a->bytes[i * count + c] = sl_eye_sees(w->cells, c);
    return SL_OK;
}

int slp_level_look(slp_level *level, const double *eyes, size_t count, double heading, double fov,
                   const char *method, int mirrored, unsigned threads, uint8_t *cells) {
    asking a = {.level = level, .count = count, .bundle = 16, .ask = ask_cells};
    size_t methods;
    const sl_eye_method *all = sl_eye_methods(&methods);
    if (!level->has_sets)
        return sl_fail(level->base.context, SL_BAD_ARGUMENT,
                       "there are no visible sets: bake the plan");
    for (size_t i = 0; method && i < methods; i++)
        if (strcmp(all[i].name, method) == 0) a.method = &all[i];
    if (method && !a.method)
        return sl_fail(level->base.context, SL_BAD_ARGUMENT, "there is no method '%.40s'", method);
    a.eyes = eyes;
    a.heading = heading;
    a.fov = fov;
    a.mirrored = mirrored != 0;
    a.bytes = cells;
    return ask_all(&a, threads);
}

// --- visible regions

static sl_status keep_polygon(sl_context *context, slp_polygons *out, const sl_region *region,
                              uint32_t depth, double tolerance) {
    const size_t count = sl_region_flatten(region, tolerance, NULL, 0);
    if (!count && depth) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &out->list, 1));
    slp_polygon *polygon = &out->list.items[out->list.count];
    *polygon = (slp_polygon){.depth = depth, .count = count};
    polygon->points = sl_alloc_array(context, count, sizeof *polygon->points);
    if (!polygon->points) return SL_NO_MEMORY;
    out->list.count++;
    sl_region_flatten(region, tolerance, polygon->points, count);
    return SL_OK;
}

static sl_status ask_region(sl_context *context, const asking *a, sl_query *query, void *scratch,
                            size_t i) {
    sl_mirrored_region *region = &((asker *)scratch)->region;
    const sl_view view = sl_query_view(query, point_at(a->eyes, i), a->headings[i], a->fovs[i]);
    SL_TRY(sl_query_mirrored_region(context, query, &view, region));
    const sl_region_measures measures = sl_region_measure(&region->direct);
    double *row = a->measures + i * ISOVIST_COLUMNS;
    memcpy(row, &measures, sizeof measures);
    row[REGION_COLUMNS] = (double)sl_region_corners(&region->direct, a->space, NULL, 0);
    row[REGION_COLUMNS + 1] = region->part_count ? sl_mirrored_area(region) : 0;
    row[REGION_COLUMNS + 2] = (double)region->part_count;
    row[REGION_COLUMNS + 3] = sl_region_meets_border(&region->direct);
    if (!a->keep) return SL_OK;
    slp_polygons *out = &a->level->polygons[i];
    SL_TRY(keep_polygon(context, out, &region->direct, 0, a->tolerance));
    for (size_t k = 0; k < region->part_count; k++)
        SL_TRY(keep_polygon(context, out, &region->parts[k].region, region->parts[k].depth,
                            a->tolerance));
    return SL_OK;
}

int slp_level_isovists(slp_level *level, const double *eyes, size_t count, const double *headings,
                       const double *fovs, unsigned threads, int keep, double tolerance,
                       double *measures) {
    asking a = {.level = level, .count = count, .bundle = 16, .ask = ask_region};
    slp_level_forget(level);
    a.eyes = eyes;
    a.headings = headings;
    a.fovs = fovs;
    a.keep = keep != 0;
    a.tolerance = tolerance;
    a.measures = measures;
    if (keep) {
        level->polygons = sl_alloc_array(level->base.context, count, sizeof *level->polygons);
        if (!level->polygons) return SL_NO_MEMORY;
        level->eye_count = count;
    }
    SL_TRY(slp_level_queries(level, 1));
    SL_TRY(sl_query_space(level->base.context, level->queries.items[0], &a.space, NULL));
    return ask_all(&a, threads);
}

size_t slp_level_polygons(const slp_level *level, int64_t *eyes, int64_t *depths, int64_t *counts) {
    size_t n = 0;
    for (size_t i = 0; i < level->eye_count; i++)
        for (size_t k = 0; k < level->polygons[i].list.count; k++, n++) {
            if (!eyes) continue;
            eyes[n] = (int64_t)i;
            depths[n] = level->polygons[i].list.items[k].depth;
            counts[n] = (int64_t)level->polygons[i].list.items[k].count;
        }
    return n;
}

void slp_level_polygon_points(const slp_level *level, double *points) {
    for (size_t i = 0; i < level->eye_count; i++)
        for (size_t k = 0; k < level->polygons[i].list.count; k++) {
            const slp_polygon *polygon = &level->polygons[i].list.items[k];
            for (size_t j = 0; j < polygon->count; j++) {
                *points++ = polygon->points[j].x;
                *points++ = polygon->points[j].y;
            }
        }
}

// --- visibility graph analysis

static sl_point *copy_points(sl_context *context, const double *points, size_t count) {
    sl_point *copy = sl_alloc_array(context, count, sizeof *copy);
    for (size_t i = 0; copy && i < count; i++) copy[i] = point_at(points, i);
    return copy;
}

static sl_status check_area(slp_level *level, double step) {
    const sl_space *space = &level->baked.space;
    double area = 0;
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside) area += sl_space_area(space, c);
    const double points = area / step / step;
    if (!(step > 0) || points <= SL_VGA_POINTS_MOST) return SL_OK;
    return sl_fail(level->base.context, SL_BAD_ARGUMENT,
                   "a grid of step %.9g has about %.3g points, and a graph has up to %u: choose a "
                   "larger step",
                   step, points, SL_VGA_POINTS_MOST);
}

/// Steps from the grid points that are nearest to some points.
static sl_status find_depths(slp_level *level, const sl_vga_graph *graph, const double *from,
                             size_t count) {
    sl_context *context = level->base.context;
    const sl_vga_grid *grid = &level->grid;
    uint32_t *numbers = sl_alloc_array(context, count, sizeof *numbers);
    level->depths = sl_alloc_array(context, grid->count, sizeof *level->depths);
    sl_status status = numbers && level->depths ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        const double x = round(from[2 * i] / grid->step) - (double)grid->left;
        const double y = round(from[2 * i + 1] / grid->step) - (double)grid->bottom;
        uint32_t p = 0;
        while (p < grid->count &&
               (grid->squares[p] / grid->rows != x || grid->squares[p] % grid->rows != y))
            p++;
        numbers[i] = p;
        if (p == grid->count)
            status = sl_fail(context, SL_BAD_ARGUMENT, "the grid has no point at %.9g, %.9g",
                             from[2 * i], from[2 * i + 1]);
    }
    if (status == SL_OK) status = sl_vga_step_depth(context, graph, numbers, count, level->depths);
    sl_free(context, numbers);
    return status;
}

/// Refuses a graph that does not fit, before it is made.
static sl_status check_graph(slp_level *level, const sl_outline *outline, const slp_vga *given) {
    sl_context *context = level->base.context;
    uint64_t bytes;
    SL_TRY(sl_vga_graph_bytes(context, outline, &level->grid, given->range, &bytes));
    if (bytes <= sl_machine_memory() / 2) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "a grid of step %.9g has %u points, whose graph needs about %.3g GiB, more than "
                   "half of this machine's memory: choose a larger step",
                   given->step, level->grid.count, (double)bytes / 1073741824.0);
}

/// Refuses measures that do not fit, before they are begun.
static sl_status check_measures(sl_context *context, const sl_outline *outline,
                                const sl_vga_grid *grid, const sl_vga_graph *graph,
                                const sl_vga_options *options) {
    uint64_t bytes;
    SL_TRY(sl_vga_measure_bytes(context, outline, grid, graph, options, &bytes));
    if (bytes <= sl_machine_memory() / 2) return SL_OK;
    return sl_fail(
        context, SL_BAD_ARGUMENT,
        "the measures of a grid of step %.9g need up to %.3g GiB, more than half of this "
        "machine's memory: choose a larger step, fewer measures or fewer threads",
        grid->step, (double)bytes / 1073741824.0);
}

static sl_status estimate(slp_level *level, const sl_vga_graph *graph, const slp_vga *given) {
    sl_context *context = level->base.context;
    sl_vga_estimate options = sl_vga_estimate_default();
    options.roots = given->roots;
    options.seed = given->seed;
    options.threads = given->threads;
    level->intervals = sl_alloc_array(context, level->grid.count, sizeof *level->intervals);
    if (!level->intervals) return SL_NO_MEMORY;
    return sl_vga_estimate_depths(context, &level->grid, graph, &options, level->measures,
                                  level->intervals);
}

static sl_status measure_grid(slp_level *level, const sl_outline *outline, sl_vga_steps *steps,
                              const slp_vga *given, const double *from, size_t from_count) {
    sl_context *context = level->base.context;
    sl_vga_graph graph = {0};
    sl_vga_options options = sl_vga_options_default();
    options.parts = given->roots ? SL_VGA_GLOBAL : given->parts; // for the bytes that it takes
    options.radius = given->radius;
    options.metric_radius = given->metric_radius;
    options.angular_radius = given->angular_radius;
    options.threads = given->threads;
    const uint32_t count = level->grid.count;
    SL_TRY(check_graph(level, outline, given));
    level->parts = sl_alloc_array(context, count, sizeof *level->parts);
    level->measures = sl_alloc_array(context, count, sizeof *level->measures);
    if (!level->parts || !level->measures) return SL_NO_MEMORY;
    sl_status status =
        sl_vga_graph_make(context, outline, &level->grid, given->range, given->threads, &graph);
    if (status == SL_OK && given->turned) status = sl_vga_graph_turn(context, &graph);
    if (status == SL_OK && given->parts)
        status = check_measures(context, outline, &level->grid, &graph, &options);
    if (status == SL_OK && given->roots)
        status = estimate(level, &graph, given);
    else if (status == SL_OK && given->parts)
        status = sl_vga_measure_walked(context, outline, &level->grid, &graph, steps, &options,
                                       level->measures);
    if (status == SL_OK && from_count) status = find_depths(level, &graph, from, from_count);
    if (status == SL_OK)
        status = sl_vga_parts(context, &graph, NULL, 0, level->parts, &level->part_count);
    sl_vga_graph_destroy(context, &graph);
    return status;
}

static sl_status fill_and_measure(slp_level *level, const sl_outline *outline, sl_vga_steps *steps,
                                  const slp_vga *given, const double *seeds, size_t seed_count,
                                  const double *from, size_t from_count) {
    sl_context *context = level->base.context;
    sl_point *places = copy_points(context, seeds, seed_count);
    if (!places) return SL_NO_MEMORY;
    sl_status status = seed_count ? SL_OK : check_area(level, given->step);
    if (status == SL_OK)
        status = sl_vga_grid_make(context, sl_vga_steps_outline(steps, outline), given->step,
                                  places, seed_count, &level->grid);
    if (status == SL_OK && !level->grid.count)
        status = sl_fail(context, SL_BAD_ARGUMENT,
                         "no point of a grid of step %.9g is inside the map", given->step);
    if (status == SL_OK && (given->parts || from_count))
        status = measure_grid(level, outline, steps, given, from, from_count);
    sl_free(context, places);
    return status;
}

int slp_level_vga(slp_level *level, const slp_vga *given, const double *seeds, size_t seed_count,
                  const double *from, size_t from_count) {
    sl_context *context = level->base.context;
    const sl_outline *outline;
    slp_level_forget(level);
    SL_TRY(sl_effects_check(context, &level->baked.map, "vga", ~(unsigned)SL_EFFECT_MIRROR,
                            "steps and paths lead straight to points, not to mirror images"));
    SL_TRY(slp_level_queries(level, 1));
    sl_query *query = level->queries.items[0];
    sl_vga_steps *steps = NULL;
    SL_TRY(sl_query_outline(context, query, &outline));
    SL_TRY(sl_vga_steps_create(context, &level->baked, query, NULL, &steps));
    const sl_status status =
        fill_and_measure(level, outline, steps, given, seeds, seed_count, from, from_count);
    sl_vga_steps_destroy(context, steps);
    return status;
}

size_t slp_level_vga_copy(const slp_level *level, double *points, double *measures, int64_t *depths,
                          int64_t *parts, double *intervals) {
    for (uint32_t p = 0; p < level->grid.count; p++) {
        if (points) {
            points[2 * p] = level->grid.points[p].x;
            points[2 * p + 1] = level->grid.points[p].y;
        }
        if (measures && level->measures)
            memcpy(&measures[p * (size_t)VGA_COLUMNS], &level->measures[p],
                   sizeof level->measures[p]);
        if (depths && level->depths)
            depths[p] = level->depths[p] == UINT32_MAX ? -1 : (int64_t)level->depths[p];
        if (parts && level->part_count > 1) parts[p] = level->parts[p] + 1;
        if (intervals && level->intervals) {
            intervals[2 * p] = level->intervals[p].least;
            intervals[2 * p + 1] = level->intervals[p].most;
        }
    }
    return level->grid.count;
}

// --- why

int slp_level_explain(slp_level *level, int64_t from, int64_t to, uint32_t misses,
                      int64_t numbers[8], double lines[8]) {
    sl_context *context = level->base.context;
    const sl_baked *baked = &level->baked;
    const int64_t cells = baked->space.cell_count;
    sl_explain_options options = sl_explain_options_default();
    const sl_explain_state state = {level->shut, level->mirror_depth};
    slp_level_forget(level);
    if (from < 0 || from >= cells || to < 0 || to >= cells)
        return sl_fail(context, SL_BAD_ARGUMENT, "there is no cell %lld; cells are 0 to %lld",
                       (long long)(from < 0 || from >= cells ? from : to), (long long)cells - 1);
    options.sight = baked->visibility.sight;
    options.most_misses = misses;
    SL_TRY(sl_explain_effects(context, &baked->space, &baked->map, &state, &options, (uint32_t)from,
                              (uint32_t)to, &level->explanation));
    const sl_effect_explanation *all = &level->explanation;
    const sl_explanation *e = &all->now;
    const int64_t found[8] = {all->direct.seen,
                              e->verdict,
                              e->distance == SL_NO_WAY ? -1 : (int64_t)e->distance,
                              all->complete,
                              all->direct.decides,
                              e->miss_count,
                              all->mirrored.seen,
                              e->bent.asked ? (int64_t)e->bent.mirrors : 0};
    memcpy(numbers, found, sizeof found);
    const double drawn[8] = {e->witness.a.x, e->witness.a.y, e->witness.b.x, e->witness.b.y,
                             e->shown.a.x,   e->shown.a.y,   e->shown.b.x,   e->shown.b.y};
    memcpy(lines, drawn, sizeof drawn);
    return SL_OK;
}

static const sl_sequence *sequence_of(const slp_level *level, int which) {
    const sl_explanation *e = &level->explanation.now;
    if (which < 0) return &e->sequence;
    return (uint32_t)which < e->miss_count ? &e->misses[which].sequence : NULL;
}

size_t slp_level_sequence(const slp_level *level, int which, int64_t *portals, int64_t *cells,
                          double *ends, size_t *end_count) {
    const sl_space *space = &level->baked.space;
    const sl_sequence *sequence = sequence_of(level, which);
    *end_count = 0;
    if (!sequence) return 0;
    for (uint32_t i = 0; portals && i < sequence->directed_count; i++) {
        portals[i] = space->directed[sequence->directed[i]].portal;
        cells[i] = space->directed[sequence->directed[i]].cell;
    }
    for (uint32_t i = 0; ends && i < sequence->end_count; i++) {
        const sl_point at = sl_sequence_end(space, sequence, sequence->ends[i]);
        ends[2 * i] = at.x;
        ends[2 * i + 1] = at.y;
    }
    *end_count = sequence->end_count;
    return sequence->directed_count;
}

const char *slp_level_reason(const slp_level *level, int which) {
    const sl_sequence *sequence = sequence_of(level, which);
    if (!sequence || !sequence->end_count) return NULL;
    if (which >= 0 && level->explanation.now.misses[which].turns)
        return "no one direction crosses these portals forwards";
    return sl_sequence_reason(&level->baked.space, sequence);
}
