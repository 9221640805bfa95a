/// Rows of a visibility graph as runs. Points are numbered column by column, so what one point sees
/// of a column without walls is one run:
///
///      5 | 11   17       The first point of the middle column, 6, sees 0 to 3, 7 to 10 and 12 to
///      4 | 10   16       15: three runs of two numbers each. A number below 128 is one byte.
///      3 / 9  / 15
///      2   8    14       Neighbours see nearly the same, yet three of five runs differ by a
///      1   7    13       point at an end. So rows share nothing: that would save little, and
///      0   6    12       cost the search for what they share.
///
/// Memory: about 2.6 bytes a run. Runs of a row grow with the columns in sight, pairs with the
/// area.
#include "analysis/visibility_graph/graph_rows.h"
#include "base/base.h"
#include "base/bits.h"

#include <string.h>

enum { BUNDLE = 64 };

void sl_vga_graph_destroy(sl_context *context, sl_vga_graph *graph) {
    for (size_t b = 0; graph->rows && b < sl_bits_words(graph->count); b++)
        sl_free(context, graph->rows[b]);
    sl_free(context, graph->rows);
    sl_free(context, graph->first);
    *graph = (sl_vga_graph){0};
}

void sli_vga_add_row(const sl_vga_graph *graph, uint32_t point, sl_bits *row) {
    for (sl_vga_run run = sl_vga_row(graph, point); sl_vga_next(&run);)
        sli_bits_add_run(row, run.first, run.stop);
}

bool sl_vga_sees(const sl_vga_graph *graph, uint32_t point, uint32_t other) {
    sl_vga_run run = sl_vga_row(graph, point);
    while (sl_vga_next(&run))
        if (run.stop > other) return run.first <= other;
    return false;
}

uint64_t sli_vga_graph_size(const sl_vga_graph *graph) {
    uint64_t bytes =
        sl_bits_words(graph->count) * sizeof *graph->rows + graph->count * sizeof *graph->first;
    for (uint32_t p = BUNDLE - 1; p < graph->count + BUNDLE - 1; p += BUNDLE) { // the last of each
        const uint32_t last = p < graph->count ? p : graph->count - 1;
        sl_vga_run run = sl_vga_row(graph, last);
        while (sl_vga_next(&run)) {
        }
        bytes += (uint64_t)(run.next - graph->rows[last / BUNDLE]);
    }
    return bytes;
}

// --- writing

typedef struct writer {
    void *state; ///< of the source
    sl_bits *row;
    SL_ARRAY(uint8_t) bytes;
} writer;

typedef struct write_job {
    const sli_vga_source *source;
    sl_vga_graph *graph;
} write_job;

static void put_number(writer *w, size_t number) {
    for (; number > 127; number >>= 7) w->bytes.items[w->bytes.count++] = (uint8_t)(number | 128);
    w->bytes.items[w->bytes.count++] = (uint8_t)number;
}

static sl_status put_row(sl_context *context, writer *w, size_t count) {
    size_t before = 0;
    for (size_t first; (first = sli_bits_next(w->row, count, before, true)) < count;) {
        const size_t stop = sli_bits_next(w->row, count, first, false);
        SL_TRY(SL_ARRAY_ROOM(context, &w->bytes, 10));
        put_number(w, stop - first);
        put_number(w, first - before);
        before = stop;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &w->bytes, 1));
    w->bytes.items[w->bytes.count++] = 0;
    return SL_OK;
}

static void end_writer(sl_context *context, void *all, void *state) {
    const sli_vga_source *source = ((const write_job *)all)->source;
    writer *w = state;
    if (w->state) source->end(context, source->job, w->state);
    sl_free(context, w->row);
    sl_free(context, w->bytes.items);
    sl_free(context, w);
}

static sl_status begin_writer(sl_context *context, void *all, void **state) {
    const sli_vga_source *source = ((const write_job *)all)->source;
    writer *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    w->row = sl_alloc_array(context, sl_bits_words(source->points), sizeof *w->row);
    sl_status status = w->row ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK && source->begin) status = source->begin(context, source->job, &w->state);
    if (status == SL_OK)
        *state = w;
    else
        end_writer(context, all, w);
    return status;
}

static sl_status write_bundle(sl_context *context, void *all, void *state, size_t bundle) {
    const write_job *j = all;
    const sli_vga_source *source = j->source;
    const uint32_t count = source->count, first = (uint32_t)bundle * BUNDLE;
    writer *w = state;
    w->bytes.count = 0;
    for (uint32_t p = first; p < count && p < first + BUNDLE; p++) {
        memset(w->row, 0, sl_bits_words(source->points) * sizeof *w->row);
        SL_TRY(source->look(context, source->job, w->state, p, w->row));
        sl_bits_add(w->row, p);
        sl_bits_flip(w->row, p);
        if (w->bytes.count > UINT32_MAX / 2) return SL_NO_MEMORY;
        j->graph->first[p] = (uint32_t)w->bytes.count;
        SL_TRY(put_row(context, w, source->points));
    }
    j->graph->rows[bundle] = sl_alloc_array(context, w->bytes.count, 1);
    if (!j->graph->rows[bundle]) return SL_NO_MEMORY;
    memcpy(j->graph->rows[bundle], w->bytes.items, w->bytes.count);
    return SL_OK;
}

sl_status sli_vga_graph_write(sl_context *context, const sli_vga_source *source, unsigned threads,
                              sl_vga_graph *out) {
    const size_t bundles = sl_bits_words(source->count);
    sl_vga_graph graph = {.count = source->count, .directed = source->directed};
    write_job job = {source, &graph};
    const sl_work work = {.job = &job,
                          .begin = begin_writer,
                          .unit = write_bundle,
                          .end = end_writer,
                          .stage = source->stage,
                          .units = "bundles of points"};
    graph.rows = sl_alloc_array(context, bundles, sizeof *graph.rows);
    graph.first = sl_alloc_array(context, graph.count, sizeof *graph.first);
    sl_status status = graph.rows && graph.first ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = sl_work_run(context, &work, bundles, threads);
    if (status != SL_OK) {
        sl_vga_graph_destroy(context, &graph);
        return status;
    }
    for (uint32_t p = 0; p < graph.count; p++)
        for (sl_vga_run run = sl_vga_row(&graph, p); sl_vga_next(&run);)
            graph.edges += run.stop - run.first;
    *out = graph;
    return SL_OK;
}

// --- several graphs as one

typedef struct joining {
    const sl_vga_graph *graphs;
    const uint32_t *first; ///< by graph: its first point; and one more
} joining;

static sl_status look_joined(sl_context *context, void *job, void *state, uint32_t point,
                             sl_bits *row) {
    const joining *j = job;
    (void)state;
    size_t g = 0;
    while (j->first[g + 1] <= point) g++;
    for (sl_vga_run run = sl_vga_row(&j->graphs[g], point - j->first[g]); sl_vga_next(&run);)
        sli_bits_add_run(row, j->first[g] + run.first, j->first[g] + run.stop);
    return sl_check_cancelled(context);
}

sl_status sl_vga_graph_join(sl_context *context, const sl_vga_graph *graphs, size_t count,
                            sl_vga_graph *out) {
    uint32_t *first = sl_alloc_array(context, count + 1, sizeof *first);
    if (!first) return SL_NO_MEMORY;
    bool directed = false;
    for (size_t g = 0; g < count; g++) {
        first[g + 1] = first[g] + graphs[g].count;
        directed = directed || graphs[g].directed;
    }
    joining job = {graphs, first};
    const sli_vga_source source = {.count = first[count],
                                   .points = first[count],
                                   .directed = directed,
                                   .job = &job,
                                   .look = look_joined};
    const sl_status status = sli_vga_graph_write(context, &source, 1, out);
    sl_free(context, first);
    return status;
}

// --- turning a graph over

/// Rows of the turned graph are found in passes over the other, each for up to 64 MiB of bits.
enum { WORDS_A_PASS = 1 << 23 };

typedef struct turning {
    const sl_vga_graph *graph;
    sl_bits *rows;
    size_t words;
    uint32_t rows_a_pass, first, stop; ///< points whose rows are found
} turning;

/// Finds who sees the next points.
static void find_viewers(turning *t, uint32_t first) {
    const uint32_t left = t->graph->count - first;
    t->first = first;
    t->stop = first + (left < t->rows_a_pass ? left : t->rows_a_pass);
    memset(t->rows, 0, t->rows_a_pass * t->words * sizeof *t->rows);
    for (uint32_t p = 0; p < t->graph->count; p++)
        for (sl_vga_run run = sl_vga_row(t->graph, p); sl_vga_next(&run);) {
            const uint32_t from = run.first > t->first ? run.first : t->first;
            for (uint32_t q = from; q < run.stop && q < t->stop; q++)
                sl_bits_add(t->rows + (q - t->first) * t->words, p);
        }
}

/// Points come in order, as there is one thread.
static sl_status look_back(sl_context *context, void *job, void *state, uint32_t point,
                           sl_bits *row) {
    turning *t = job;
    (void)state;
    if (point == t->stop) find_viewers(t, point);
    memcpy(row, t->rows + (point - t->first) * t->words, t->words * sizeof *row);
    return sl_check_cancelled(context);
}

sl_status sl_vga_graph_turn(sl_context *context, sl_vga_graph *graph) {
    turning t = {.graph = graph, .words = sl_bits_words(graph->count)};
    const sli_vga_source source = {.count = graph->count,
                                   .points = graph->count,
                                   .directed = graph->directed,
                                   .job = &t,
                                   .look = look_back};
    const size_t rows = WORDS_A_PASS / (t.words + 1) + 1;
    sl_vga_graph turned = {0};
    t.rows_a_pass = rows < graph->count ? (uint32_t)rows : graph->count;
    t.rows = sl_alloc_array(context, t.rows_a_pass * t.words, sizeof *t.rows);
    if (!t.rows) return SL_NO_MEMORY;
    const sl_status status = sli_vga_graph_write(context, &source, 1, &turned);
    sl_free(context, t.rows);
    if (status != SL_OK) return status;
    sl_vga_graph_destroy(context, graph);
    *graph = turned;
    return SL_OK;
}
