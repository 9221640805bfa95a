// What many moving boxes cost in a frame: all boxes move, then all eyes ask which boxes they see,
// or for their region past the boxes.
//   bench_boxes KIND:N[:DEGREES]    a generated map, turned: office:20, office:20:17
//   bench_boxes MAP [LEVEL]         a map file; the level of a WAD, the height of a slice
// CSV: map, cells, boxes, eyes, what is asked, milliseconds a frame for the boxes' new places and
// for the eyes, share of the boxes that an eye sees, points of its region. Times are the
// processor's, the least of some frames.
#include "bench.h"

#include "baked_bytes.h"
#include "sightline/bake.h"
#include "sightline/support.h"

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

#include <math.h>

enum { BOXES = 1000, EYES = 100, FRAMES = 5 };

static void *room(size_t count, size_t size) {
    void *block = calloc(count ? count : 1, size);
    if (!block) bench_fail("out of memory");
    return block;
}

// --- what moves: boxes and eyes, on the way through the inside

typedef struct frame {
    sl_moving_box boxes[BOXES];
    sl_point eyes[EYES];
} frame;

static sl_point place(const sl_space *space, sl_random *random) {
    const sl_box b = space->bounds;
    for (int tries = 0; tries < 100000; tries++) {
        const sl_point p = {b.min.x + sl_random_unit(random) * (b.max.x - b.min.x),
                            b.min.y + sl_random_unit(random) * (b.max.y - b.min.y)};
        const uint32_t cell = sl_space_locate(space, p);
        if (cell != SL_NO_CELL && space->cells[cell].inside && !space->cells[cell].solid) return p;
    }
    bench_fail("the map has no inside");
}

/// Half the width of a box: as a person in a room.
static double half_width(const sl_space *space) {
    const sl_box b = space->bounds;
    return 0.2 * sqrt((b.max.x - b.min.x) * (b.max.y - b.min.y) / space->cell_count);
}

static frame *choose(const sl_space *space, bool blocks) {
    frame *frames = room(FRAMES, sizeof *frames);
    sl_random random = {7};
    const double half = half_width(space);
    for (size_t i = 0; i < BOXES; i++) {
        const sl_point at = place(space, &random);
        const double turn = 6.2831853 * sl_random_unit(&random);
        for (int f = 0; f < FRAMES; f++) {
            const sl_point p = {at.x + 0.2 * half * f * cos(turn),
                                at.y + 0.2 * half * f * sin(turn)};
            frames[f].boxes[i] = (sl_moving_box){
                .box = {{p.x - half, p.y - half}, {p.x + half, p.y + half}}, .blocks = blocks};
        }
    }
    for (size_t i = 0; i < EYES; i++)
        for (int f = 0; f < FRAMES; f++) frames[f].eyes[i] = place(space, &random);
    return frames;
}

// --- what is asked

enum { ROOM = 64 * BOXES, POINTS = 1 << 14 };

typedef struct bench {
    sl_context *context;
    const char *name;
    sl_baked baked;
    sl_query *query;
    bool seen[BOXES];
    char *bytes;
    sl_runtime runtime;
    sl_runtime_boxes placed;
    sl_runtime_box list[BOXES];
    uint32_t *memory, *scratch;
    unsigned char said[BOXES];
    sl_region region;
    double points[2 * POINTS];
} bench;

/// The times of one frame, and how many boxes the eyes saw, or points their regions had.
typedef struct cost {
    double place, look;
    size_t seen, points;
} cost;

typedef cost question(bench *b, const frame *f, size_t boxes, size_t eyes);

static cost ask_query(bench *b, const frame *f, size_t boxes, size_t eyes) {
    cost c = {0};
    const double start = bench_seconds();
    bench_must(b->context, sl_query_set_boxes(b->context, b->query, f->boxes, boxes));
    // The boxes are placed when the first question needs them.
    sl_view view = sl_view_all_round(b->baked.space.bounds.min);
    view.eye.x -= 1;
    bench_must(b->context, sl_query_boxes_seen(b->context, b->query, &view, b->seen, NULL));
    const double placed = bench_seconds();
    for (size_t i = 0; i < eyes; i++) {
        view = sl_view_all_round(f->eyes[i]);
        bench_must(b->context, sl_query_boxes_seen(b->context, b->query, &view, b->seen, NULL));
        for (size_t k = 0; k < boxes; k++) c.seen += b->seen[k];
    }
    c.place = 1e3 * (placed - start);
    c.look = 1e3 * (bench_seconds() - placed);
    return c;
}

static cost ask_region(bench *b, const frame *f, size_t boxes, size_t eyes) {
    cost c = {0};
    const double start = bench_seconds();
    bench_must(b->context, sl_query_set_boxes(b->context, b->query, f->boxes, boxes));
    const double placed = bench_seconds();
    for (size_t i = 0; i < eyes; i++) {
        const sl_view view = sl_view_all_round(f->eyes[i]);
        bench_must(b->context, sl_query_region(b->context, b->query, &view, &b->region));
        c.points += b->region.count;
    }
    c.place = 1e3 * (placed - start);
    c.look = 1e3 * (bench_seconds() - placed);
    return c;
}

static cost move_in_runtime(bench *b, const frame *f, size_t boxes) {
    cost c = {0};
    if (b->placed.count != boxes)
        sl_runtime_boxes_start(&b->placed, &b->runtime, b->list, (uint32_t)boxes, ROOM, b->memory);
    const double start = bench_seconds();
    for (uint32_t i = 0; i < boxes; i++) {
        const sl_box at = f->boxes[i].box;
        const sl_runtime_box to = {at.min.x, at.min.y, at.max.x, at.max.y, f->boxes[i].blocks};
        if (!sl_runtime_boxes_move(&b->placed, i, &to))
            bench_fail("there is no room for the boxes");
    }
    c.place = 1e3 * (bench_seconds() - start);
    return c;
}

static cost ask_runtime(bench *b, const frame *f, size_t boxes, size_t eyes) {
    cost c = move_in_runtime(b, f, boxes);
    const double moved = bench_seconds();
    for (size_t i = 0; i < eyes; i++) {
        const sl_runtime_view view = sl_runtime_view_all_round(f->eyes[i].x, f->eyes[i].y);
        c.seen += sl_runtime_boxes_seen(&b->placed, &view, NULL, 0, b->scratch, b->said);
    }
    c.look = 1e3 * (bench_seconds() - moved);
    return c;
}

static cost ask_polygon(bench *b, const frame *f, size_t boxes, size_t eyes) {
    cost c = move_in_runtime(b, f, boxes);
    const double moved = bench_seconds();
    for (size_t i = 0; i < eyes; i++) {
        const sl_runtime_view view = sl_runtime_view_all_round(f->eyes[i].x, f->eyes[i].y);
        c.points += sl_runtime_visible_polygon_past_boxes(&b->placed, &view, NULL, 0, b->scratch,
                                                          b->points, POINTS);
    }
    c.look = 1e3 * (bench_seconds() - moved);
    return c;
}

static void open_runtime(bench *b) {
    size_t size;
    b->bytes = baked_bytes(b->context, &b->baked, &size);
    if (sl_runtime_open(b->bytes, size, &b->runtime) != SL_RUNTIME_OK)
        bench_fail("the bake is damaged");
    b->memory = room(sl_runtime_boxes_count(&b->runtime, BOXES, ROOM), sizeof *b->memory);
    sl_runtime_boxes_start(&b->placed, &b->runtime, b->list, BOXES, ROOM, b->memory);
    b->scratch = room(sl_runtime_boxes_scratch_count(&b->placed), sizeof *b->scratch);
}

static void print_row(bench *b, const char *what, question *ask, bool blocks, size_t boxes,
                      size_t eyes) {
    frame *frames = choose(&b->baked.space, blocks);
    cost least = {INFINITY, INFINITY, 0, 0};
    for (int f = 0; f < FRAMES; f++) {
        const cost c = ask(b, &frames[f], boxes, eyes);
        least.place = fmin(least.place, c.place);
        least.look = fmin(least.look, c.look);
        least.seen = c.seen;
        least.points = c.points;
    }
    printf("%s,%u,%zu,%zu,%s,%.3f,%.3f,%.4f,%.1f\n", b->name, b->baked.space.cell_count, boxes,
           eyes, what, least.place, least.look, (double)least.seen / (double)(boxes * eyes),
           (double)least.points / (double)eyes);
    free(frames);
}

int main(int argc, char **argv) {
    static const struct {
        const char *what;
        question *ask;
        bool blocks;
    } table[] = {
        {"query: which are seen", ask_query, false},
        {"query: which are seen past each other", ask_query, true},
        {"runtime: which are seen", ask_runtime, false},
        {"runtime: which are seen past each other", ask_runtime, true},
        {"query: region past them", ask_region, true},
        {"runtime: polygon past them", ask_polygon, true},
    };
    if (argc < 2) bench_fail("usage: bench_boxes KIND:N[:DEGREES] | MAP [LEVEL]");
    bench *b = room(1, sizeof *b);
    b->context = sl_context_create(NULL);
    b->name = argv[argc > 2 ? 2 : 1];
    if (!b->context) bench_fail("out of memory");
    bench_bake(b->context, argv[1], argc > 2 ? argv[2] : NULL, &b->baked);
    bench_must(b->context, sl_query_create(b->context, &b->baked, &b->query));
    open_runtime(b);
    puts("map,cells,boxes,eyes,asked,place_ms,look_ms,share_seen,points");
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        for (size_t boxes = 10; boxes <= BOXES; boxes *= 10)
            for (size_t eyes = 1; eyes <= EYES; eyes *= 10)
                print_row(b, table[i].what, table[i].ask, table[i].blocks, boxes, eyes);
    sl_query_destroy(b->context, b->query);
    sl_region_destroy(b->context, &b->region);
    free(b->memory);
    free(b->scratch);
    free(b->bytes);
    sl_baked_destroy(b->context, &b->baked);
    sl_context_destroy(b->context);
    free(b);
    return 0;
}
