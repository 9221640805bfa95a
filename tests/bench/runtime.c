// What a game pays for a question to the runtime, beside a matrix of bits that it could keep
// itself.
//   bench_runtime MAP [Z]             a map file, and the height of its slice or its level
//   bench_runtime KIND:N[:DEGREES]    a generated map, turned: office:20, office:20:17
//   bench_runtime FILE.slv            a baked file, an older program's too
// CSV: machine, map, cells, what was asked, bytes that it reads, nanoseconds, times the first's.
#include "bench.h"

#include "baked_bytes.h"
#include "sightline/sightline.h"
#include "sightline/support.h"

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

#include <math.h>
#include <sys/utsname.h>

// --- what is asked

/// The baked file's bytes, for free().
static char *bake(sl_context *context, const char *name, const char *slice, size_t *size) {
    sl_baked baked;
    bench_bake(context, name, slice, &baked);
    char *bytes = baked_bytes(context, &baked, size);
    sl_baked_destroy(context, &baked);
    return bytes;
}

// --- the questions: each asks for element i of the lists and adds the answer up

enum { DEPTH = 2 }; // reflections
enum {
    ASKED = 1 << 14,
    LOOKS = 1 << 10,
    ROUNDS = 15,
    POINTS = 1 << 12,
    WAYS = 1 << 6,
    NODES = 1 << 15
};

typedef struct bench {
    sl_runtime runtime;
    const char *bytes;
    size_t size;
    uint32_t from[ASKED], to[ASKED], seen[ASKED]; ///< cells; seen: one of the row of from
    uint32_t longest;                             ///< the cell of the longest row
    double x[ASKED], y[ASKED], angle[ASKED];
    unsigned char *matrix, *bits;
    size_t stride;
    uint32_t *scratch, *cells; ///< scratch: for DEPTH reflections
    double *points;            ///< POINTS pairs
    uint32_t *way_scratch;     ///< for NODES nodes
} bench;

typedef uint32_t question(const bench *b, uint32_t i);

static uint32_t ask_matrix(const bench *b, uint32_t i) {
    const uint32_t to = b->to[i];
    return b->matrix[b->from[i] * b->stride + to / 8] >> to % 8 & 1;
}

static uint32_t ask_can_see(const bench *b, uint32_t i) {
    return sl_runtime_can_see(&b->runtime, b->from[i], b->to[i]);
}

static uint32_t ask_can_see_seen(const bench *b, uint32_t i) {
    return sl_runtime_can_see(&b->runtime, b->from[i], b->seen[i]);
}

/// From the cell that sees the most pieces of the map: what a row costs at the worst.
static uint32_t ask_can_see_longest(const bench *b, uint32_t i) {
    return sl_runtime_can_see(&b->runtime, b->longest, b->to[i]);
}

static uint32_t ask_locate(const bench *b, uint32_t i) {
    return sl_runtime_locate(&b->runtime, b->x[i], b->y[i]);
}

/// The eye moves on a little.
static uint32_t ask_locate_near(const bench *b, uint32_t i) {
    return sl_runtime_locate(&b->runtime, b->x[i >> 6] + 1e-4 * (i & 63), b->y[i >> 6]);
}

static uint32_t ask_row(const bench *b, uint32_t i) {
    uint32_t sum = 0;
    sl_runtime_run run = sl_runtime_row(&b->runtime, b->from[i]);
    while (sl_runtime_next(&run))
        for (uint32_t cell = run.first; cell < run.end; cell++) sum += cell;
    return sum;
}

static uint32_t ask_row_of_matrix(const bench *b, uint32_t i) {
    uint32_t sum = 0;
    const unsigned char *row = b->matrix + b->from[i] * b->stride;
    for (uint32_t cell = 0; cell < b->runtime.cell_count; cell++)
        if (row[cell / 8] >> cell % 8 & 1) sum += cell;
    return sum;
}

static uint32_t ask_row_count(const bench *b, uint32_t i) {
    return sl_runtime_row_count(&b->runtime, b->from[i]);
}

static uint32_t ask_row_bits(const bench *b, uint32_t i) {
    sl_runtime_row_bits(&b->runtime, b->from[i], b->bits);
    return b->bits[0];
}

static uint32_t ask_look(const bench *b, uint32_t i) {
    const sl_runtime_view view = sl_runtime_view_all_round(b->x[i], b->y[i]);
    return sl_runtime_look(&b->runtime, &view, b->scratch, b->cells, b->runtime.cell_count);
}

static uint32_t ask_look_60(const bench *b, uint32_t i) {
    const sl_runtime_view view = sl_runtime_view_toward(b->x[i], b->y[i], cos(b->angle[i]),
                                                        sin(b->angle[i]), 0.57735026918962584);
    return sl_runtime_look(&b->runtime, &view, b->scratch, b->cells, b->runtime.cell_count);
}

static uint32_t ask_look_mirrored(const bench *b, uint32_t i) {
    const sl_runtime_view view = sl_runtime_view_all_round(b->x[i], b->y[i]);
    uint32_t direct;
    return sl_runtime_look_mirrored(&b->runtime, &view, NULL, 0, b->scratch, b->cells,
                                    b->runtime.cell_count, &direct);
}

/// From places of few bits, as those of floats.
static uint32_t ask_look_into_mirrors(const bench *b, uint32_t i) {
    const sl_runtime_view view = sl_runtime_view_all_round((float)b->x[i], (float)b->y[i]);
    uint32_t direct;
    bool rounded;
    return sl_runtime_look_into_mirrors(&b->runtime, &view, NULL, 0, DEPTH, b->scratch, b->cells,
                                        b->runtime.cell_count, &direct, &rounded);
}

/// From one place to any other, and to one in a cell that the eye sees.
static uint32_t ask_sees(const bench *b, uint32_t i) {
    const uint32_t to = (i + ASKED / 2) % ASKED;
    return sl_runtime_sees(&b->runtime, b->x[i], b->y[i], b->x[to], b->y[to], NULL, 0, b->scratch);
}

static uint32_t ask_sees_near(const bench *b, uint32_t i) {
    const sl_runtime_cell c = sl_runtime_get_cell(&b->runtime, b->seen[i]);
    double ax, ay, bx, by;
    sl_runtime_get_vertex(&b->runtime, c.first_vertex, &ax, &ay);
    sl_runtime_get_vertex(&b->runtime, c.first_vertex + c.vertex_count / 2, &bx, &by);
    return sl_runtime_sees(&b->runtime, b->x[i], b->y[i], (ax + bx) / 2, (ay + by) / 2, NULL, 0,
                           b->scratch);
}

/// A step of a 400th of the map, as that of a thing that moves.
static uint32_t ask_can_walk(const bench *b, uint32_t i) {
    const double step = (b->runtime.max_x - b->runtime.min_x) / 400;
    return sl_runtime_can_walk(&b->runtime, b->x[i], b->y[i], b->x[i] + step * cos(b->angle[i]),
                               b->y[i] + step * sin(b->angle[i]), NULL);
}

/// The same step by a disc of half its length, which slides.
static uint32_t ask_walk(const bench *b, uint32_t i) {
    const double step = (b->runtime.max_x - b->runtime.min_x) / 400;
    const sl_runtime_walker walker = {step / 2, NULL, NULL, SL_RUNTIME_NO_BOX};
    double x, y;
    return sl_runtime_walk(&b->runtime, &walker, b->x[i], b->y[i],
                           b->x[i] + step * cos(b->angle[i]), b->y[i] + step * sin(b->angle[i]),
                           b->scratch, &x, &y);
}

/// From one place to any other. The sum counts points; none where there are too few nodes.
static uint32_t ask_way(const bench *b, uint32_t i) {
    const uint32_t to = (i + ASKED / 2) % ASKED;
    sl_runtime_way way;
    sl_runtime_find_way(&b->runtime, b->x[i], b->y[i], b->x[to], b->y[to], NULL, b->way_scratch,
                        NODES, b->points, POINTS, &way);
    return way.count;
}

/// To a place that is a tenth of the map away.
static uint32_t ask_way_near(const bench *b, uint32_t i) {
    const double step = (b->runtime.max_x - b->runtime.min_x) / 10;
    sl_runtime_way way;
    sl_runtime_find_way(&b->runtime, b->x[i], b->y[i], b->x[i] + step * cos(b->angle[i]),
                        b->y[i] + step * sin(b->angle[i]), NULL, b->way_scratch, NODES, b->points,
                        POINTS, &way);
    return way.count;
}

/// Those of a thing that is a thousandth of the map wide.
static uint32_t ask_box_cells(const bench *b, uint32_t i) {
    const double half = (b->runtime.max_x - b->runtime.min_x) / 2000;
    return sl_runtime_box_cells(&b->runtime, b->x[i] - half, b->y[i] - half, b->x[i] + half,
                                b->y[i] + half, b->cells, b->runtime.cell_count);
}

static uint32_t ask_polygon(const bench *b, uint32_t i) {
    const sl_runtime_view view = sl_runtime_view_all_round(b->x[i], b->y[i]);
    return sl_runtime_visible_polygon(&b->runtime, &view, NULL, 0, b->scratch, b->points, POINTS);
}

static uint32_t ask_polygon_60(const bench *b, uint32_t i) {
    const sl_runtime_view view = sl_runtime_view_toward(b->x[i], b->y[i], cos(b->angle[i]),
                                                        sin(b->angle[i]), 0.57735026918962584);
    return sl_runtime_visible_polygon(&b->runtime, &view, NULL, 0, b->scratch, b->points, POINTS);
}

static uint32_t ask_open(const bench *b, uint32_t i) {
    sl_runtime runtime;
    (void)i;
    return (uint32_t)sl_runtime_open(b->bytes, b->size, &runtime);
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time); // other programs do not count
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

/// What a call takes: the least of all rounds.
static double measure(const bench *b, question *ask, uint32_t count, uint64_t *sum) {
    double least = INFINITY;
    for (int round = 0; round < ROUNDS; round++) {
        *sum = 0;
        const double start = now();
        for (uint32_t i = 0; i < count; i++) *sum += ask(b, i);
        const double took = now() - start;
        if (took < least) least = took;
    }
    return least / count;
}

// --- the lists

static void *room(size_t bytes) {
    void *block = calloc(bytes ? bytes : 1, 1);
    if (!block) bench_fail("out of memory");
    return block;
}

/// Somewhere inside, each place as likely.
static void choose_places(bench *b) {
    const sl_runtime *r = &b->runtime;
    sl_random random = {7};
    for (uint32_t i = 0; i < ASKED;) {
        b->x[i] = r->min_x + sl_random_unit(&random) * (r->max_x - r->min_x);
        b->y[i] = r->min_y + sl_random_unit(&random) * (r->max_y - r->min_y);
        b->angle[i] = 6.2831853 * sl_random_unit(&random);
        b->from[i] = sl_runtime_locate(r, b->x[i], b->y[i]);
        if (!sl_runtime_is_inside(r, b->from[i])) continue;
        b->to[i] = (uint32_t)sl_random_below(&random, r->cell_count);
        const sl_runtime_view view = sl_runtime_view_all_round(b->x[i], b->y[i]);
        const uint32_t seen = sl_runtime_look(r, &view, b->scratch, b->cells, r->cell_count);
        b->seen[i++] = b->cells[sl_random_below(&random, seen)];
    }
}

static size_t row_bytes(const sl_runtime *r, uint32_t cell) {
    const sl_runtime_run run = sl_runtime_row(r, cell);
    return (size_t)(run.stop - run.next);
}

static void prepare(bench *b) {
    const sl_runtime *r = &b->runtime;
    b->stride = ((size_t)r->cell_count + 7) / 8;
    b->matrix = room(b->stride * r->cell_count);
    b->bits = room(b->stride);
    b->scratch = room(sl_runtime_mirrored_scratch_count(r, DEPTH) * sizeof *b->scratch);
    b->cells = room(r->cell_count * sizeof *b->cells);
    b->points = room(2 * POINTS * sizeof *b->points);
    b->way_scratch = room(sl_runtime_way_scratch_count(r, NODES) * sizeof *b->way_scratch);
    for (uint32_t i = 0; i < r->cell_count; i++) {
        sl_runtime_row_bits(r, i, b->matrix + i * b->stride);
        if (row_bytes(r, i) > row_bytes(r, b->longest)) b->longest = i;
    }
    choose_places(b);
}

static void print_table(const bench *b, const char *name) {
    const sl_runtime *r = &b->runtime;
    const size_t matrix = b->stride * r->cell_count;
    const size_t rows = 8 * ((size_t)r->cell_count + 1) +
                        slrt_u64(r->row_offsets + 8 * (size_t)r->cell_count) +
                        (r->row_parts ? 8 * (size_t)r->cell_count : 0);
    const size_t buckets = (size_t)r->grid_columns * r->grid_rows;
    const size_t place = r->grid_cells ? 4 * (buckets + 1 + slrt_u32(r->grid_offsets + 4 * buckets))
                                       : (size_t)r->node_count * SLRT_NODE_BYTES +
                                             4 * (size_t)r->tree_columns * r->tree_rows;
    const struct {
        const char *what;
        question *ask;
        uint32_t count;
        size_t bytes;
    } table[] = {
        {"can see: matrix of bits", ask_matrix, ASKED, matrix},
        {"can see: any two cells", ask_can_see, ASKED, rows},
        {"can see: one in view", ask_can_see_seen, ASKED, rows},
        {"can see: from the longest row", ask_can_see_longest, ASKED, row_bytes(r, b->longest)},
        {"locate: anywhere", ask_locate, ASKED, place},
        {"locate: near the last", ask_locate_near, ASKED, place},
        {"iterate a row: matrix of bits", ask_row_of_matrix, LOOKS, matrix},
        {"iterate a row", ask_row, ASKED, rows},
        {"count a row", ask_row_count, ASKED, rows},
        {"unpack a row", ask_row_bits, ASKED, rows},
        {"look all round", ask_look, LOOKS, b->size},
        {"look in a cone of 60", ask_look_60, LOOKS, b->size},
        {"look, with rows of mirrors", ask_look_mirrored, LOOKS, b->size},
        {"look into mirrors", ask_look_into_mirrors, LOOKS, b->size},
        {"one place sees another", ask_sees, LOOKS, b->size},
        {"one place sees one in a cell in view", ask_sees_near, LOOKS, b->size},
        {"a step is free", ask_can_walk, LOOKS, b->size},
        {"a disc walks", ask_walk, LOOKS, b->size},
        {"the shortest way, anywhere", ask_way, WAYS, b->size},
        {"the shortest way, a tenth of the map", ask_way_near, WAYS, b->size},
        {"the cells of a box", ask_box_cells, LOOKS, b->size},
        {"visible polygon all round", ask_polygon, LOOKS, b->size},
        {"visible polygon in a cone of 60", ask_polygon_60, LOOKS, b->size},
        {"open the file", ask_open, 1, b->size},
    };
    struct utsname machine;
    uname(&machine);
    double first = 0;
    puts("machine,map,cells,asked,bytes,nanoseconds,times_the_first,mean_answer");
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        uint64_t sum;
        const double took = measure(b, table[i].ask, table[i].count, &sum);
        if (!i) first = took;
        printf("%s %s,%s,%u,%s,%zu,%.1f,%.1f,%.3g\n", machine.sysname, machine.machine, name,
               r->cell_count, table[i].what, table[i].bytes, took, took / first,
               (double)sum / table[i].count);
    }
}

int main(int argc, char **argv) {
    if (argc < 2) bench_fail("usage: bench_runtime MAP [Z] | KIND:N | FILE.slv");
    sl_context *context = sl_context_create(NULL);
    bench *b = room(sizeof *b);
    if (!context) bench_fail("out of memory");
    const size_t length = strlen(argv[1]);
    char *bytes = length > 4 && strcmp(argv[1] + length - 4, ".slv") == 0
                      ? bench_read_file(argv[1], &b->size)
                      : bake(context, argv[1], argc > 2 ? argv[2] : NULL, &b->size);
    b->bytes = bytes;
    const sl_runtime_status status = sl_runtime_open(bytes, b->size, &b->runtime);
    if (status != SL_RUNTIME_OK) bench_fail(sl_runtime_status_text(status));
    prepare(b);
    print_table(b, argv[1]);
    free(b->matrix);
    free(b->bits);
    free(b->scratch);
    free(b->cells);
    free(b->points);
    free(b->way_scratch);
    free(b);
    free(bytes);
    sl_context_destroy(context);
    return 0;
}
