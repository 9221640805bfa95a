/// Depth from chosen points, and measures of a graph whose points are linked (stairs, lifts).
///
/// Linked points are one place, as merged points of depthmapX are: who comes to one of them has
/// come to all, at the same depth, and goes on from each. The place counts once. Steps of sight
/// follow from that alone: the graph is contracted, and searched as any other (graph_measures.c).
///
///      floor 1    o--o--A        A and B are linked.      o--o--AB--o--o
///      floor 2          B--o--o                           steps: 0 1  2  3  4
///
/// Paths cannot be contracted, as they turn where their points are. They are found by a plain
/// search (Dijkstra 1959) that keeps the rules of graph_paths.c: lengths in squares and single
/// precision, ties to the lower number, turns at points beside walls. Paths also go on from each
/// linked point. A link itself has no length, and the direction before it is forgotten, as in
/// depthmapX (vgametric.cpp, vgaangular.cpp of its salalib).
///
/// Cost: O(pairs that see each other, from points beside walls) for each start. Invariant: lengths
/// leave the heap in ascending order.
#include "analysis/visibility_graph/graph_measures.h"
#include "analysis/visibility_graph/path_heap.h"
#include "base/bits.h"
#include "geometry/length.h"

#include <math.h>
#include <string.h>

#define RIGHT_ANGLE 1.5707963267948966

// --- places: points that are linked

/// By point: the next point of its place, in a ring.
typedef struct places {
    uint32_t *next;
} places;

static bool is_linked(const places *l, uint32_t point) {
    return l->next[point] != point;
}

static bool is_same_place(const places *l, uint32_t a, uint32_t b) {
    for (uint32_t p = l->next[a]; p != a; p = l->next[p])
        if (p == b) return true;
    return a == b;
}

static sl_status find_places(sl_context *context, uint32_t count, const sl_vga_link *links,
                             size_t link_count, places *out) {
    for (size_t i = 0; i < link_count; i++)
        if (links[i].a >= count || links[i].b >= count || links[i].a == links[i].b)
            return sl_fail(context, SL_BAD_ARGUMENT, "a link joins two points of the grid");
    out->next = sl_alloc_array(context, count, sizeof *out->next);
    if (!out->next) return SL_NO_MEMORY;
    for (uint32_t p = 0; p < count; p++) out->next[p] = p;
    for (size_t i = 0; i < link_count; i++) {
        const uint32_t a = links[i].a, b = links[i].b, after = out->next[a];
        if (is_same_place(out, a, b)) continue;
        out->next[a] = out->next[b]; // two rings become one
        out->next[b] = after;
    }
    return SL_OK;
}

// --- one search

typedef sli_vga_entry entry; ///< of points

typedef struct walker {
    const sli_vga_job *job;
    const places *joined;
    float *length;   ///< by point: of its path, in squares, or its turn; INFINITY: none
    float *turn;     ///< by point: along its shortest path, in right angles
    sl_bits *done;   ///< points whose paths are final
    sl_bits *second; ///< points of a place that has been counted already
    sli_vga_heap heap;
} walker;

static sl_status push_reached(sl_context *context, walker *w, float key, uint32_t point,
                              uint32_t before) {
    return sli_vga_heap_push(context, &w->heap, (entry){key, point, point, before, SLI_VGA_NONE});
}

static sl_point square_of(const walker *w, uint32_t point) {
    const sl_vga_grid *grid = w->job->grid;
    return (sl_point){grid->squares[point] / grid->rows, grid->squares[point] % grid->rows};
}

/// The turn of the path before, at, to, in right angles.
static float turn_at(const walker *w, uint32_t before, uint32_t at, uint32_t to) {
    if (before == SLI_VGA_NONE) return 0;
    const sl_point p = square_of(w, before), q = square_of(w, at), r = square_of(w, to);
    const double ax = r.x - q.x, ay = r.y - q.y, bx = q.x - p.x, by = q.y - p.y;
    const double cosine = (ax * bx + ay * by) / sqrt((ax * ax + ay * ay) * (bx * bx + by * by));
    return (float)(acos(fmin(fmax(cosine, -1), 1)) / RIGHT_ANGLE);
}

static bool leads_on(const walker *w, uint32_t point) {
    return sl_bits_has(w->job->turning, point) || is_linked(w->joined, point);
}

static sl_status try_length(sl_context *context, walker *w, entry at, uint32_t to) {
    const sl_point a = square_of(w, at.at), b = square_of(w, to);
    const double dx = a.x - b.x, dy = a.y - b.y, step = sqrt(dx * dx + dy * dy);
    const float old = w->length[to];
    if (at.key + step >= old) return SL_OK;
    w->length[to] = at.key + (float)step;
    w->turn[to] = w->turn[at.at] + turn_at(w, at.before, at.at, to);
    if (w->length[to] == old || !leads_on(w, to)) return SL_OK;
    return push_reached(context, w, w->length[to], to, at.at);
}

static sl_status try_turn(sl_context *context, walker *w, entry at, uint32_t to) {
    if (at.key >= w->length[to]) return SL_OK;
    const float turn = at.key + turn_at(w, at.before, at.at, to);
    if (turn >= w->length[to]) return SL_OK;
    w->length[to] = turn;
    if (turn > 0 && !leads_on(w, to)) return SL_OK;
    return push_reached(context, w, turn, to, at.at);
}

typedef sl_status try_way(sl_context *context, walker *w, entry at, uint32_t to);

static sl_status expand(sl_context *context, walker *w, try_way *try, entry at) {
    sl_bits_add(w->done, at.at);
    for (sl_vga_run run = sl_vga_row(w->job->graph, at.at); sl_vga_next(&run);)
        for (uint32_t to = run.first; to < run.stop; to++)
            if (!sl_bits_has(w->done, to)) SL_TRY(try(context, w, at, to));
    return SL_OK;
}

/// Who comes to a point of a place goes on from all of them.
static sl_status expand_place(sl_context *context, walker *w, try_way *try, entry at) {
    const uint32_t point = at.at;
    for (uint32_t p = w->joined->next[point]; p != point; p = w->joined->next[p]) {
        w->length[p] = at.key;
        w->turn[p] = w->turn[point];
        sl_bits_add(w->done, p);
        sl_bits_add(w->second, p);
    }
    SL_TRY(expand(context, w, try, at));
    for (uint32_t p = w->joined->next[point]; p != point; p = w->joined->next[p])
        SL_TRY(expand(context, w, try, (entry){at.key, p, p, SLI_VGA_NONE, SLI_VGA_NONE}));
    return SL_OK;
}

/// From the nearest of some points to all others. `most`: no farther; 0 for no limit.
static sl_status search(sl_context *context, walker *w, try_way *try, const uint32_t *from,
                        size_t from_count, double most) {
    const sl_vga_graph *graph = w->job->graph;
    w->heap.count = 0;
    memset(w->done, 0, sl_bits_words(graph->count) * sizeof *w->done);
    memset(w->second, 0, sl_bits_words(graph->count) * sizeof *w->second);
    for (uint32_t p = 0; p < graph->count; p++) w->length[p] = w->turn[p] = INFINITY;
    for (size_t i = 0; i < from_count; i++) {
        w->length[from[i]] = w->turn[from[i]] = 0;
        SL_TRY(push_reached(context, w, 0, from[i], SLI_VGA_NONE));
    }
    while (w->heap.count) {
        const entry e = sli_vga_heap_pop(&w->heap);
        if (most > 0 && e.key > most) break;
        if (e.key > w->length[e.at] || sl_bits_has(w->done, e.at)) continue;
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(expand_place(context, w, try, e));
    }
    return SL_OK;
}

// --- memory

static void walker_end(sl_context *context, walker *w) {
    sl_free(context, w->length);
    sl_free(context, w->turn);
    sl_free(context, w->done);
    sl_free(context, w->second);
    sl_free(context, w->heap.items);
}

static sl_status walker_begin(sl_context *context, const sli_vga_job *job, const places *joined,
                              walker *out) {
    const size_t words = sl_bits_words(job->graph->count);
    *out = (walker){.job = job, .joined = joined};
    out->length = sl_alloc_array(context, job->graph->count, sizeof *out->length);
    out->turn = sl_alloc_array(context, job->graph->count, sizeof *out->turn);
    out->done = sl_alloc_array(context, words, sizeof *out->done);
    out->second = sl_alloc_array(context, words, sizeof *out->second);
    if (out->length && out->turn && out->done && out->second) return SL_OK;
    walker_end(context, out);
    return SL_NO_MEMORY;
}

// --- depth from chosen points

typedef struct step_search {
    const places *joined;
    sl_bits *unseen;
    uint32_t *queue; ///< in ascending depth
    size_t tail;
    sl_vga_depths *depths;
} step_search;

/// Takes a point with all of its place.
static void take(step_search *s, uint32_t point, double depth) {
    uint32_t p = point;
    do {
        if (sl_bits_has(s->unseen, p)) {
            sl_bits_flip(s->unseen, p);
            s->depths[p].visual_step_depth = depth;
            s->queue[s->tail++] = p;
        }
        p = s->joined->next[p];
    } while (p != point);
}

static sl_status find_steps(sl_context *context, const sl_vga_graph *graph, const places *joined,
                            const uint32_t *from, size_t from_count, sl_vga_depths *out) {
    step_search s = {.joined = joined, .depths = out};
    s.queue = sl_alloc_array(context, graph->count, sizeof *s.queue);
    s.unseen = sl_alloc_array(context, sl_bits_words(graph->count), sizeof *s.unseen);
    sl_status status = s.queue && s.unseen ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        for (uint32_t p = 0; p < graph->count; p++) sl_bits_add(s.unseen, p);
        for (size_t i = 0; i < from_count; i++) take(&s, from[i], 0);
    }
    for (size_t head = 0; status == SL_OK && head < s.tail; head++) {
        const double depth = out[s.queue[head]].visual_step_depth + 1;
        if (head % 256 == 0) status = sl_check_cancelled(context);
        for (sl_vga_run run = sl_vga_row(graph, s.queue[head]); sl_vga_next(&run);)
            for (size_t w = run.first / 64; w * 64 < run.stop; w++) {
                sl_bits rest = s.unseen[w] & sli_bits_run(w, run.first, run.stop);
                for (; rest; rest &= rest - 1)
                    take(&s, (uint32_t)(w * 64) + (uint32_t)__builtin_ctzll(rest), depth);
            }
    }
    sl_free(context, s.queue);
    sl_free(context, s.unseen);
    return status;
}

static sl_status find_paths(sl_context *context, const sli_vga_job *job, const places *joined,
                            const uint32_t *from, size_t from_count, sl_vga_depths *out) {
    const double step = job->grid->step;
    walker w;
    SL_TRY(walker_begin(context, job, joined, &w));
    sl_status status = SL_OK;
    if (job->options->parts & SL_VGA_METRIC) {
        status = search(context, &w, try_length, from, from_count, 0);
        for (uint32_t p = 0; p < job->graph->count; p++) {
            double straight = INFINITY;
            for (size_t i = 0; i < from_count; i++) {
                const sl_point a = square_of(&w, from[i]), b = square_of(&w, p);
                straight = fmin(straight, step * sli_length(a.x - b.x, a.y - b.y));
            }
            out[p].metric_straight_line_distance = straight;
            if (w.length[p] == INFINITY) continue;
            out[p].metric_step_shortest_path_length = w.length[p] * step;
            out[p].metric_step_shortest_path_angle = w.turn[p];
        }
    }
    if (status == SL_OK && job->options->parts & SL_VGA_ANGULAR) {
        status = search(context, &w, try_turn, from, from_count, 0);
        for (uint32_t p = 0; p < job->graph->count; p++)
            if (w.length[p] != INFINITY) out[p].angular_step_depth = w.length[p];
    }
    walker_end(context, &w);
    return status;
}

#define NONE(name, group, unit, meaning) NAN,
static const sl_vga_depths no_depths = {SL_DEPTH_MEASURES(NONE)};

sl_status sl_vga_depth(sl_context *context, const sl_outline *outline, const sl_vga_grid *grid,
                       const sl_vga_graph *graph, const sl_vga_link *links, size_t link_count,
                       unsigned parts, const uint32_t *from, size_t from_count,
                       sl_vga_depths *depths) {
    const sl_vga_options options = {.parts = parts};
    sl_bits *turning = NULL;
    places joined = {0};
    for (uint32_t p = 0; p < graph->count; p++) depths[p] = no_depths;
    sl_status status = find_places(context, graph->count, links, link_count, &joined);
    if (status == SL_OK && parts & SL_VGA_GLOBAL)
        status = find_steps(context, graph, &joined, from, from_count, depths);
    if (status == SL_OK && parts & (SL_VGA_METRIC | SL_VGA_ANGULAR)) {
        status = sli_vga_find_turning(context, outline, grid, &turning);
        const sli_vga_job job = {
            .grid = grid, .graph = graph, .options = &options, .turning = turning};
        if (status == SL_OK) status = find_paths(context, &job, &joined, from, from_count, depths);
    }
    sl_free(context, turning);
    sl_free(context, joined.next);
    return status;
}

// --- measures of paths with links

typedef struct path_job {
    sli_vga_job all;
    places places;
} path_job;

static sl_status begin_depth_worker(sl_context *context, void *all, void **state) {
    const path_job *j = all;
    walker *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    const sl_status status = walker_begin(context, &j->all, &j->places, w);
    if (status == SL_OK)
        *state = w;
    else
        sl_free(context, w);
    return status;
}

static void end_depth_worker(sl_context *context, void *all, void *state) {
    (void)all;
    walker_end(context, state);
    sl_free(context, state);
}

static sl_status measure_metric(sl_context *context, walker *w, uint32_t from,
                                sl_vga_measures *out) {
    const double step = w->job->grid->step, most = w->job->options->metric_radius / step;
    double length = 0, turn = 0, straight = 0, nodes = 0;
    SL_TRY(search(context, w, try_length, &from, 1, most));
    for (uint32_t p = 0; p < w->job->graph->count; p++) {
        if (w->length[p] == INFINITY || sl_bits_has(w->second, p)) continue;
        if (most > 0 && w->length[p] > most) continue;
        const sl_point a = square_of(w, from), b = square_of(w, p);
        length += w->length[p] * step;
        turn += w->turn[p];
        straight += step * sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
        nodes++;
    }
    out->metric_mean_shortest_path_distance = length / nodes;
    out->metric_mean_shortest_path_angle = turn / nodes;
    out->metric_mean_straight_line_distance = straight / nodes;
    out->metric_node_count = nodes;
    return SL_OK;
}

static sl_status measure_angular(sl_context *context, walker *w, uint32_t from,
                                 sl_vga_measures *out) {
    const double most = w->job->options->angular_radius;
    double turn = 0, nodes = 0;
    SL_TRY(search(context, w, try_turn, &from, 1, most));
    for (uint32_t p = 0; p < w->job->graph->count; p++) {
        if (w->length[p] == INFINITY || sl_bits_has(w->second, p)) continue;
        if (most > 0 && w->length[p] > most) continue;
        turn += w->length[p];
        nodes++;
    }
    out->angular_mean_depth = turn / nodes;
    out->angular_total_depth = turn;
    out->angular_node_count = nodes;
    return SL_OK;
}

static sl_status measure_point(sl_context *context, void *all, void *state, size_t point) {
    const sli_vga_job *j = &((const path_job *)all)->all;
    sl_vga_measures *out = &j->measures[point];
    if (j->options->parts & SL_VGA_METRIC)
        SL_TRY(measure_metric(context, state, (uint32_t)point, out));
    if (j->options->parts & SL_VGA_ANGULAR)
        SL_TRY(measure_angular(context, state, (uint32_t)point, out));
    return SL_OK;
}

static sl_status measure_paths(sl_context *context, path_job *job) {
    const sl_work work = {.job = job,
                          .begin = begin_depth_worker,
                          .unit = measure_point,
                          .end = end_depth_worker,
                          .stage = "paths",
                          .units = "points"};
    return sl_work_run(context, &work, job->all.graph->count, job->all.options->threads);
}

// --- steps of sight with links

/// The graph of places: each is its lowest point, and sees what one of its points sees.
typedef struct contracted {
    sl_vga_grid grid;
    sl_vga_graph graph;
    const sl_vga_graph *whole; ///< of points
    const places *joined;
    uint32_t *place;  ///< by point
    uint32_t *lowest; ///< by place
    sl_vga_measures *measures;
} contracted;

static void contracted_destroy(sl_context *context, contracted *c) {
    sl_vga_grid_destroy(context, &c->grid);
    sl_vga_graph_destroy(context, &c->graph);
    sl_free(context, c->place);
    sl_free(context, c->lowest);
    sl_free(context, c->measures);
}

static sl_status number_places(sl_context *context, const sl_vga_grid *grid, const places *joined,
                               contracted *c) {
    c->place = sl_alloc_array(context, grid->count, sizeof *c->place);
    c->grid = *grid;
    c->grid.count = 0;
    c->grid.points = sl_alloc_array(context, grid->count, sizeof *c->grid.points);
    c->grid.squares = sl_alloc_array(context, grid->count, sizeof *c->grid.squares);
    c->lowest = sl_alloc_array(context, grid->count, sizeof *c->lowest);
    if (!c->place || !c->grid.points || !c->grid.squares || !c->lowest) return SL_NO_MEMORY;
    for (uint32_t p = 0; p < grid->count; p++) {
        uint32_t lowest = p;
        for (uint32_t q = joined->next[p]; q != p; q = joined->next[q])
            if (q < lowest) lowest = q;
        if (lowest < p) {
            c->place[p] = c->place[lowest];
            continue;
        }
        c->place[p] = c->grid.count;
        c->lowest[c->grid.count] = p;
        c->grid.points[c->grid.count] = grid->points[p];
        c->grid.squares[c->grid.count++] = grid->squares[p];
    }
    return SL_OK;
}

/// Adds the places that a place sees.
static sl_status look_from_place(sl_context *context, void *job, void *state, uint32_t place,
                                 sl_bits *row) {
    const contracted *c = job;
    uint32_t p = c->lowest[place];
    (void)context;
    (void)state;
    do {
        for (sl_vga_run run = sl_vga_row(c->whole, p); sl_vga_next(&run);)
            for (uint32_t q = run.first; q < run.stop; q++) sl_bits_add(row, c->place[q]);
        p = c->joined->next[p];
    } while (p != c->lowest[place]);
    return SL_OK;
}

static sl_status contract(sl_context *context, const sl_vga_grid *grid, const sl_vga_graph *graph,
                          const places *joined, unsigned threads, contracted *c) {
    c->whole = graph;
    c->joined = joined;
    SL_TRY(number_places(context, grid, joined, c));
    c->measures = sl_alloc_array(context, c->grid.count, sizeof *c->measures);
    if (!c->measures) return SL_NO_MEMORY;
    const sli_vga_source source = {.count = c->grid.count,
                                   .points = c->grid.count,
                                   .directed = graph->directed,
                                   .job = c,
                                   .look = look_from_place};
    return sli_vga_graph_write(context, &source, threads, &c->graph);
}

static sl_status measure_steps(sl_context *context, const sl_outline *outline,
                               const sli_vga_job *job, const places *joined) {
    contracted c = {0};
    sl_vga_options options = *job->options;
    options.parts = SL_VGA_GLOBAL;
    sl_status status = contract(context, job->grid, job->graph, joined, options.threads, &c);
    if (status == SL_OK)
        status = sl_vga_measure(context, outline, &c.grid, &c.graph, &options, c.measures);
    for (uint32_t p = 0; p < job->graph->count && status == SL_OK; p++) {
        const sl_vga_measures *from = &c.measures[c.place[p]];
        sl_vga_measures *to = &job->measures[p];
        to->visual_node_count = from->visual_node_count;
        to->visual_mean_depth = from->visual_mean_depth;
        to->visual_entropy = from->visual_entropy;
        to->visual_relativised_entropy = from->visual_relativised_entropy;
        to->visual_integration_hh = from->visual_integration_hh;
        to->visual_integration_pvalue = from->visual_integration_pvalue;
        to->visual_integration_tekl = from->visual_integration_tekl;
    }
    contracted_destroy(context, &c);
    return status;
}

sl_status sl_vga_measure_linked(sl_context *context, const sl_outline *outline,
                                const sl_vga_grid *grid, const sl_vga_graph *graph,
                                const sl_vga_link *links, size_t link_count,
                                const sl_vga_options *options, sl_vga_measures *measures) {
    const unsigned steps = SL_VGA_GLOBAL, paths = SL_VGA_METRIC | SL_VGA_ANGULAR;
    if (!link_count) return sl_vga_measure(context, outline, grid, graph, options, measures);
    if (options->count)
        return sl_fail(context, SL_BAD_ARGUMENT, "with links, all points are measured");
    sl_vga_options plain = *options;
    plain.parts &= ~(steps | paths);
    path_job job = {
        .all = {.grid = grid, .graph = graph, .options = options, .measures = measures}};
    sl_bits *turning = NULL;
    sl_status status = find_places(context, graph->count, links, link_count, &job.places);
    if (status == SL_OK) status = sl_vga_measure(context, outline, grid, graph, &plain, measures);
    if (status == SL_OK && options->parts & steps)
        status = measure_steps(context, outline, &job.all, &job.places);
    if (status == SL_OK && options->parts & paths) {
        status = sli_vga_find_turning(context, outline, grid, &turning);
        job.all.turning = turning;
        if (status == SL_OK) status = measure_paths(context, &job);
    }
    sl_free(context, turning);
    sl_free(context, job.places.next);
    return status;
}
