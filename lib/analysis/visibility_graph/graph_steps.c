/// Visibility graphs where walls stop steps and not sight, or sight and not steps: paths and agents
/// go by a second graph, of the points between which one steps straight.
#include "analysis/visibility_graph/graph_rows.h"
#include "base/bits.h"

#include <math.h>

struct sl_vga_steps {
    sl_baked baked;
    sl_query *query;
    const sl_outline *outline; ///< of the query
    sl_vga_graph graph;        ///< made when a path is first asked for
};

enum { BY_STEPS = SL_VGA_METRIC | SL_VGA_ANGULAR };

static sl_status make_query(sl_context *context, const sl_query *doors, sl_vga_steps *s) {
    SL_TRY(sl_query_over(context, &s->baked.space, &s->baked.map, NULL, &s->query));
    for (size_t i = 0; doors && i < s->baked.map.door_count; i++)
        sl_query_set_door_at(context, s->query, i, sl_query_door_is_open(doors, i));
    return sl_query_outline(context, s->query, &s->outline);
}

sl_status sl_vga_steps_create(sl_context *context, const sl_baked *sight, const sl_query *doors,
                              const sl_bake_options *options, sl_vga_steps **out) {
    if (!sl_map_steps_differ(&sight->map)) return SL_OK;
    sl_vga_steps *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    sl_status status = sl_bake_steps(context, sight, options, &s->baked);
    if (status == SL_OK) status = make_query(context, doors, s);
    if (status == SL_OK) {
        sl_note(context, "some walls stop steps and not sight, or sight and not steps: the grid, "
                         "paths and agents go by steps, other measures by sight");
        *out = s;
    } else
        sl_vga_steps_destroy(context, s);
    return status;
}

void sl_vga_steps_destroy(sl_context *context, sl_vga_steps *steps) {
    if (!steps) return;
    sl_vga_graph_destroy(context, &steps->graph);
    sl_query_destroy(context, steps->query);
    sl_baked_destroy(context, &steps->baked);
    sl_free(context, steps);
}

const sl_outline *sl_vga_steps_outline(const sl_vga_steps *steps, const sl_outline *sight) {
    return steps ? steps->outline : sight;
}

/// Adds the points that a point sees by two graphs: each pair of runs in common.
static sl_status look_by_both(sl_context *context, void *job, void *state, uint32_t point,
                              sl_bits *row) {
    const sl_vga_graph *const *graphs = job;
    (void)context;
    (void)state;
    sl_vga_run a = sl_vga_row(graphs[0], point), b = sl_vga_row(graphs[1], point);
    for (bool more = sl_vga_next(&a) && sl_vga_next(&b); more;) {
        const uint32_t first = a.first > b.first ? a.first : b.first;
        const uint32_t stop = a.stop < b.stop ? a.stop : b.stop;
        if (first < stop) sli_bits_add_run(row, first, stop);
        more = sl_vga_next(a.stop < b.stop ? &a : &b);
    }
    return SL_OK;
}

sl_status sl_vga_steps_connect(sl_context *context, const sl_vga_steps *steps,
                               const sl_vga_grid *grid, const sl_vga_graph *sights,
                               unsigned threads, sl_vga_graph *out) {
    sl_vga_graph stepped = {0};
    SL_TRY(sl_vga_graph_make(context, steps->outline, grid, 0, threads, &stepped));
    const sl_vga_graph *both[] = {&stepped, sights};
    const sli_vga_source source = {.count = grid->count,
                                   .points = grid->count,
                                   .directed = stepped.directed || sights->directed,
                                   .job = both,
                                   .look = look_by_both};
    const sl_status status = sli_vga_graph_write(context, &source, threads, out);
    sl_vga_graph_destroy(context, &stepped);
    return status;
}

/// The graph of steps, made at the first call.
static sl_status need_graph(sl_context *context, sl_vga_steps *steps, const sl_vga_grid *grid,
                            unsigned threads) {
    if (steps->graph.rows && steps->graph.count == grid->count) return SL_OK;
    sl_vga_graph_destroy(context, &steps->graph);
    return sl_vga_graph_make(context, steps->outline, grid, 0, threads, &steps->graph);
}

/// Fills in what was not asked for by sight: it is NAN there, as by steps all is that goes by
/// sight.
static void take_walked(size_t count, const double *walked, double *out) {
    for (size_t i = 0; i < count; i++)
        if (isnan(out[i])) out[i] = walked[i];
}

/// What is measured, by whichever graph.
typedef struct work {
    const sl_vga_grid *grid;
    const sl_vga_link *links;
    size_t link_count;
    const sl_vga_options *options;
} work;

typedef sl_status measure_function(sl_context *context, const work *w, const sl_outline *outline,
                                   const sl_vga_graph *graph, unsigned parts,
                                   sl_vga_measures *measures);

static sl_status measure_plain(sl_context *context, const work *w, const sl_outline *outline,
                               const sl_vga_graph *graph, unsigned parts,
                               sl_vga_measures *measures) {
    sl_vga_options options = *w->options;
    options.parts = parts;
    return sl_vga_measure(context, outline, w->grid, graph, &options, measures);
}

static sl_status measure_linked(sl_context *context, const work *w, const sl_outline *outline,
                                const sl_vga_graph *graph, unsigned parts,
                                sl_vga_measures *measures) {
    sl_vga_options options = *w->options;
    options.parts = parts;
    return sl_vga_measure_linked(context, outline, w->grid, graph, w->links, w->link_count,
                                 &options, measures);
}

/// By sight, and then paths by steps.
static sl_status measure_both(sl_context *context, measure_function *measure, const work *w,
                              const sl_outline *outline, const sl_vga_graph *graph,
                              sl_vga_steps *steps, sl_vga_measures *measures) {
    const unsigned by_steps = steps ? w->options->parts & BY_STEPS : 0;
    const uint32_t count = w->grid->count;
    sl_vga_measures *walked = NULL;
    if (by_steps) {
        walked = sl_alloc_array(context, count, sizeof *walked);
        if (!walked) return SL_NO_MEMORY;
    }
    sl_status status = by_steps ? need_graph(context, steps, w->grid, w->options->threads) : SL_OK;
    for (int pass = 0; pass <= (by_steps > 0) && status == SL_OK; pass++)
        status = measure(context, w, pass ? steps->outline : outline, pass ? &steps->graph : graph,
                         pass ? by_steps : w->options->parts & ~by_steps, pass ? walked : measures);
    if (by_steps && status == SL_OK)
        take_walked(count * (sizeof *walked / sizeof(double)), (const double *)walked,
                    (double *)measures);
    sl_free(context, walked);
    return status;
}

sl_status sl_vga_measure_walked(sl_context *context, const sl_outline *outline,
                                const sl_vga_grid *grid, const sl_vga_graph *graph,
                                sl_vga_steps *steps, const sl_vga_options *options,
                                sl_vga_measures *measures) {
    const work w = {.grid = grid, .options = options};
    return measure_both(context, measure_plain, &w, outline, graph, steps, measures);
}

sl_status sl_vga_measure_walked_linked(sl_context *context, const sl_outline *outline,
                                       const sl_vga_grid *grid, const sl_vga_graph *graph,
                                       sl_vga_steps *steps, const sl_vga_link *links,
                                       size_t link_count, const sl_vga_options *options,
                                       sl_vga_measures *measures) {
    const work w = {grid, links, link_count, options};
    return measure_both(context, measure_linked, &w, outline, graph, steps, measures);
}

sl_status sl_vga_depth_walked(sl_context *context, const sl_outline *outline,
                              const sl_vga_grid *grid, const sl_vga_graph *graph,
                              sl_vga_steps *steps, const sl_vga_link *links, size_t link_count,
                              unsigned parts, const uint32_t *from, size_t from_count,
                              unsigned threads, sl_vga_depths *depths) {
    const unsigned by_steps = steps ? parts & BY_STEPS : 0;
    sl_vga_depths *walked = NULL;
    sl_status status = by_steps ? need_graph(context, steps, grid, threads) : SL_OK;
    if (by_steps && status == SL_OK) {
        walked = sl_alloc_array(context, grid->count, sizeof *walked);
        if (!walked) status = SL_NO_MEMORY;
    }
    for (int pass = 0; pass <= (by_steps > 0) && status == SL_OK; pass++)
        status = sl_vga_depth(context, pass ? steps->outline : outline, grid,
                              pass ? &steps->graph : graph, links, link_count,
                              pass ? by_steps : parts & ~by_steps, from, from_count,
                              pass ? walked : depths);
    if (by_steps && status == SL_OK)
        take_walked(grid->count * (sizeof *walked / sizeof(double)), (const double *)walked,
                    (double *)depths);
    sl_free(context, walked);
    return status;
}
