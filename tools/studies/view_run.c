/// Sampling, subdivision, merging and cutting in turn, with what each costs.
#include "studies/view_run.h"

#include "sightline/stab.h"
#include "sightline/support.h"
#include "system/built.h"

/// A picture over the map's bounds: the lighter a pixel, the likelier is a viewpoint there.
static sl_status places_by_picture(sl_context *context, const char *path, view_run *run) {
    sl_bytes bytes;
    sl_image image = {0};
    const built_io *io;
    SL_TRY(sl_file_read(context, path, &bytes));
    sl_status status = built_need_io(context, path, &io);
    if (status == SL_OK) status = io->image_read(context, path, bytes.data, bytes.size, &image);
    sl_free(context, bytes.data);
    SL_TRY(status);
    const size_t count = image.width * image.height;
    double *values = sl_alloc_array(context, count, sizeof *values);
    status = values ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < count && values; i++) {
        const size_t row = image.height - 1 - i / image.width;
        values[row * image.width + i % image.width] = image.pixels[i] / 255.0;
    }
    if (status == SL_OK)
        status = sl_view_places_density(context, &run->baked.space, values, (uint32_t)image.width,
                                        (uint32_t)image.height, &run->places);
    sl_free(context, values);
    io->image_destroy(context, &image);
    return status;
}

static sl_status find_places(sl_context *context, const view_run_options *options, view_run *run) {
    const sl_space *space = &run->baked.space;
    if (options->density) return places_by_picture(context, options->density, run);
    if (options->paths)
        return sl_view_places_paths(context, &run->baked.map, space, options->step, &run->places);
    return sl_view_places_inside(context, space, &run->places);
}

/// The visible sets of the elementary cells. An exact method has found them already.
static sl_status find_sets(sl_context *context, const view_run_options *options, view_run *run,
                           sl_view_sets *sets) {
    if (options->method->exact) {
        *sets = run->found.sets;
        run->found.sets = (sl_view_sets){0};
        return SL_OK;
    }
    if (!options->exact)
        return sl_view_sets_sample(context, &run->scene, &run->tree, &run->segments,
                                   options->sampling.threads, sets);
    sl_see_options seeing = sl_see_options_default();
    seeing.threads = options->sampling.threads;
    seeing.inside_only = true;
    const sl_see_method *method = sl_see_method_for(&run->baked.map, &seeing);
    return sl_view_sets_exact(context, &run->baked.map, &run->scene, &run->tree, method, &seeing,
                              sets);
}

static sl_status join(sl_context *context, const view_run_options *options, view_run *run) {
    sl_view_sets sets = {0};
    SL_TRY(find_sets(context, options, run, &sets));
    const sl_status status = sl_view_hierarchy_make(context, &run->scene, &run->tree, &sets,
                                                    options->method->merges, &run->hierarchy);
    sl_view_sets_destroy(context, &sets);
    return status;
}

/// Evaluates with other lines than those that made the cells.
static sl_status evaluate(sl_context *context, const view_run_options *options, view_run *run) {
    if (!options->evaluation) return SL_OK;
    sl_view_sampling sampling = options->sampling;
    sampling.samples = options->evaluation;
    sampling.seed = ~sampling.seed;
    sl_view_segments segments = {0};
    sl_view_sets sets = {0};
    SL_TRY(sl_view_sample(context, run->outline, &sampling, &segments));
    sl_status status =
        sl_view_sets_sample(context, &run->scene, &run->tree, &segments, sampling.threads, &sets);
    if (status == SL_OK)
        status = sl_view_evaluate(context, &run->scene, &run->tree, &run->hierarchy, &sets,
                                  &run->evaluated);
    sl_view_sets_destroy(context, &sets);
    sl_view_segments_destroy(context, &segments);
    return status;
}

static sl_status cut(sl_context *context, const view_run_options *options, view_run *run) {
    const sl_view_hierarchy *h = view_run_told(run);
    if (options->budget == BUDGET_CELLS)
        run->cell_count = options->cells < h->cell_count ? (uint32_t)options->cells : h->cell_count;
    else if (options->budget == BUDGET_BYTES)
        SL_TRY(sl_view_cut_by_bytes(context, h, options->bytes, &run->cell_count));
    else
        SL_TRY(sl_view_cut_by_cost(context, h, options->tolerance, &run->cell_count));
    run->view_cells = sl_alloc_array(context, h->cell_count, sizeof *run->view_cells);
    run->numbers = sl_alloc_array(context, run->cell_count, sizeof *run->numbers);
    if (!run->view_cells || !run->numbers) return SL_NO_MEMORY;
    return sl_view_cut(context, h, run->cell_count, run->view_cells, run->numbers);
}

sl_status view_run_make(sl_context *context, const view_run_options *options, view_run *run) {
    const double start = sl_seconds();
    SL_TRY(sl_query_over(context, &run->baked.space, &run->baked.map, NULL, &run->query));
    SL_TRY(sl_query_outline(context, run->query, &run->outline));
    SL_TRY(find_places(context, options, run));
    run->scene = (sl_view_scene){&run->baked.space, options->sampling.objects, options->render,
                                 &run->places};
    if (!options->method->exact)
        SL_TRY(sl_view_sample(context, run->outline, &options->sampling, &run->segments));
    const double sampled = sl_seconds();
    SL_TRY(options->method->divide(context, &run->scene, &run->segments, &options->subdivision,
                                   &run->tree, &run->found));
    const double divided = sl_seconds();
    SL_TRY(join(context, options, run));
    const double joined = sl_seconds();
    SL_TRY(evaluate(context, options, run));
    run->seconds.sample = sampled - start;
    run->seconds.divide = divided - sampled;
    run->seconds.merge = joined - divided;
    run->seconds.evaluate = sl_seconds() - joined;
    return cut(context, options, run);
}

static sl_status make_rows(sl_context *context, bool by_views, view_run *run) {
    sl_baked *exact = &run->exact;
    const sl_view_hierarchy *h = view_run_told(run);
    sl_view_rows *rows = &exact->views;
    sl_view_rows plain = {0};
    const sl_pvs *pvs = &exact->visibility.pvs;
    run->cell_bytes = pvs->offsets[pvs->cell_count];
    SL_TRY(sl_view_rows_make(context, &exact->space, pvs, &run->tree, h, run->cell_count, false,
                             &plain));
    run->plain_bytes = plain.rows.offsets[plain.rows.cell_count];
    // Compress by rows for groups of view cells, unless there is no room for the groups.
    if (by_views || 2 * run->cell_count - 1 > exact->space.cell_count) {
        *rows = plain;
    } else {
        sl_view_rows_destroy(context, &plain);
        SL_TRY(sl_view_rows_make(context, &exact->space, pvs, &run->tree, h, run->cell_count, true,
                                 rows));
    }
    if (run->scene.objects != SL_VIEW_CELLS) return SL_OK;
    return sl_view_rows_cost(context, &run->scene, &exact->space, rows, h, run->cell_count,
                             &run->exact_cost);
}

/// Replaces the set of each cell by that of its view cell.
static sl_status forget_cells(sl_context *context, sl_baked *exact) {
    sl_visibility *v = &exact->visibility;
    sl_pvs expanded;
    SL_TRY(sl_view_rows_expand(context, &exact->views, &expanded, &v->account.pairs));
    sl_pvs_destroy(context, &v->pvs);
    sl_pvs_destroy(context, &v->doubtful);
    v->account.doubtful_pairs = 0;
    v->pvs = expanded;
    if (v->guarantee == SL_EXACT) v->guarantee = SL_CONSERVATIVE;
    exact->by_views = true;
    return SL_OK;
}

sl_status view_run_see(sl_context *context, const view_run_options *options,
                       const sl_see_method *method, bool by_views, view_run *run) {
    const double start = sl_seconds();
    sl_baked *exact = &run->exact;
    sl_see_options seeing = sl_see_options_default();
    seeing.threads = options->sampling.threads;
    seeing.inside_only = true;
    if (!method) method = sl_see_method_for(&run->baked.map, &seeing);
    if (method->stabs) seeing.solver = sl_funnel();
    // Sampling needs the map no longer. It moves to the baked file.
    exact->map = run->baked.map;
    run->baked.map = (sl_map){0};
    const sl_space *objects = run->scene.objects == SL_VIEW_CELLS ? &run->baked.space : NULL;
    SL_TRY(sl_view_add_seams(context, &run->tree, run->view_cells, objects, &exact->map));
    SL_TRY(sl_subdivision_for(&exact->map)->subdivide(context, &exact->map, NULL, &exact->space));
    SL_TRY(method->see(context, &exact->space, &seeing, &exact->visibility));
    snprintf(exact->method, sizeof exact->method, "%s", method->name);
    if (method->stabs) snprintf(exact->solver, sizeof exact->solver, "%s", seeing.solver->name);
    SL_TRY(make_rows(context, by_views, run));
    if (by_views) SL_TRY(forget_cells(context, exact));
    run->seconds.see = sl_seconds() - start;
    run->has_exact = true;
    return SL_OK;
}

void view_run_destroy(sl_context *context, view_run *run) {
    sl_view_hierarchy_destroy(context, &run->hierarchy);
    sl_view_hierarchy_destroy(context, &run->evaluated);
    sl_view_tree_destroy(context, &run->tree);
    sl_view_sets_destroy(context, &run->found.sets);
    sl_view_segments_destroy(context, &run->segments);
    sl_view_places_destroy(context, &run->places);
    sl_query_destroy(context, run->query);
    sl_baked_destroy(context, &run->baked);
    sl_baked_destroy(context, &run->exact);
    sl_free(context, run->view_cells);
    sl_free(context, run->numbers);
}

sl_status view_run_cost(sl_context *context, const sl_view_hierarchy *hierarchy, uint32_t cells,
                        double *cost, uint64_t *bytes) {
    double *costs = sl_alloc_array(context, hierarchy->cell_count, sizeof *costs);
    uint64_t *sizes = sl_alloc_array(context, hierarchy->cell_count, sizeof *sizes);
    if (costs && sizes) {
        sl_view_curve(hierarchy, costs, sizes);
        *cost = costs[cells - 1];
        *bytes = sizes[cells - 1];
    }
    const bool done = costs && sizes;
    sl_free(context, costs);
    sl_free(context, sizes);
    return done ? SL_OK : SL_NO_MEMORY;
}
