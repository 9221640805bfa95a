// What an edit of a world costs (sightline/world.h).
//   bench_world [--rows none|now|later] KIND:N[:DEGREES] ...    generated maps: city:4 city:4:17.3
// CSV: map, which visible sets are kept, walls, cells, milliseconds to make the world; microseconds
// to remove a wall chosen by chance or to add it again, with all sets that are kept "now" exact,
// and then to answer whether an eye beside it sees a place and what region it has, median and 95th
// percentile; to move a wall by a step with a region asked near it; and to remove all walls one by
// one, on average (of at most 3,000). City:4 has about 1,000 walls, city:12 10,000, city:38
// 100,000, city:122 1,000,000.
//   bench_world --often COUNT KIND:N ...    memory and speed after many edits
// CSV, a line for each power of ten up to COUNT: so many walls were removed or added again, KB that
// the world then has, and microseconds of an edit since the line before. All sets are exact.
#include "bench.h"

#include "sightline/query.h"
#include "sightline/support.h"
#include "sightline/world.h"

#include <string.h>

enum { EDITS = 1000, STEPS = 200, REMOVED_MOST = 3000, SETTLE_MS = 100 };

typedef struct bench {
    sl_context *context;
    sl_world *world;
    sl_random random;
    sl_region region;
    double times[2 * EDITS];
} bench;

static double share_of(bench *b, size_t count, double share) {
    qsort(b->times, count, sizeof *b->times, sl_compare_numbers);
    return 1e6 * b->times[(size_t)((double)(count - 1) * share)];
}

static uint32_t random_wall(bench *b, sl_segment *at) {
    for (;;) {
        const uint32_t wall = (uint32_t)sl_random_below(&b->random, sl_world_wall_count(b->world));
        if (sl_world_wall(b->world, wall, at)) return wall;
    }
}

/// Asks what an eye beside a wall sees.
static void ask(bench *b, sl_segment at) {
    const double x = at.b.x - at.a.x, y = at.b.y - at.a.y;
    const sl_point eye = {(at.a.x + at.b.x) / 2 - y / 7, (at.a.y + at.b.y) / 2 + x / 7};
    const sl_point place = {eye.x + 2 * y / 7, eye.y - 2 * x / 7};
    const sl_view view = sl_view_all_round(eye);
    sl_query *query = sl_world_query(b->world);
    bool sees;
    bench_must(b->context, sl_query_sees(b->context, query, eye, place, &sees));
    bench_must(b->context, sl_query_region(b->context, query, &view, &b->region));
}

static void time_commit(bench *b, sl_segment wall, size_t at) {
    const double start = bench_seconds();
    bench_must(b->context, sl_world_commit(b->context, b->world, NULL));
    ask(b, wall);
    b->times[at] = bench_seconds() - start;
    bench_must(b->context, sl_world_settle(b->context, b->world, SETTLE_MS, NULL));
}

static void change_walls(bench *b) {
    for (size_t i = 0; i < EDITS; i++) {
        sl_segment at;
        uint32_t wall = random_wall(b, &at);
        bench_must(b->context, sl_world_remove(b->context, b->world, wall));
        time_commit(b, at, 2 * i);
        bench_must(b->context, sl_world_add_wall(b->context, b->world, at, &wall));
        time_commit(b, at, 2 * i + 1);
    }
}

/// A wall that is dragged, and the region of an eye beside it.
static void drag_wall(bench *b) {
    sl_segment at;
    const uint32_t wall = random_wall(b, &at);
    const double size = (at.b.x - at.a.x) + (at.b.y - at.a.y);
    for (size_t i = 0; i < STEPS; i++) {
        const double start = bench_seconds(), step = size / 37 * (i % 20 < 10 ? 1 : -1);
        at = (sl_segment){{at.a.x + step, at.a.y + step / 3}, {at.b.x + step, at.b.y + step / 3}};
        const sl_view view = sl_view_all_round((sl_point){at.a.x + size / 7, at.a.y + size / 5});
        bench_must(b->context, sl_world_move(b->context, b->world, wall, at));
        bench_must(b->context, sl_world_commit(b->context, b->world, NULL));
        bench_must(b->context,
                   sl_query_region(b->context, sl_world_query(b->world), &view, &b->region));
        bench_must(b->context, sl_world_settle(b->context, b->world, 1, NULL));
        b->times[i] = bench_seconds() - start;
    }
}

/// An allocator that counts bytes.
static void *counting_resize(void *user, void *block, size_t bytes) {
    size_t *total = user, *old = block ? (size_t *)block - 2 : NULL;
    if (old) *total -= *old;
    if (!bytes) {
        free(old);
        return NULL;
    }
    size_t *fresh = realloc(old, bytes + 2 * sizeof *fresh);
    if (!fresh) bench_fail("out of memory");
    *fresh = bytes;
    *total += bytes;
    return fresh + 2;
}

/// Removes a wall and adds it again, over and over.
static void print_often(const char *what, size_t most) {
    size_t bytes = 0;
    const sl_hooks hooks = {.user = &bytes, .resize = counting_resize};
    bench b = {.context = sl_context_create(&hooks), .random = {3}};
    sl_map map = {0};
    if (!b.context) bench_fail("out of memory");
    bench_read_map(b.context, what, NULL, &map);
    bench_must(b.context, sl_map_clean(b.context, &map, NULL, NULL));
    const size_t before = bytes;
    sl_world_options options = sl_world_options_default();
    options.rows = SL_WORLD_ROWS_NOW;
    bench_must(b.context, sl_world_create(b.context, &map, &options, &b.world));
    size_t done = 0, told = 0;
    double start = bench_seconds();
    for (size_t next = 1000; next <= most; next *= 10) {
        for (; done < next; done += 2) {
            sl_segment at;
            uint32_t wall = random_wall(&b, &at);
            bench_must(b.context, sl_world_remove(b.context, b.world, wall));
            bench_must(b.context, sl_world_commit(b.context, b.world, NULL));
            bench_must(b.context, sl_world_add_wall(b.context, b.world, at, &wall));
            bench_must(b.context, sl_world_commit(b.context, b.world, NULL));
        }
        const double end = bench_seconds();
        printf("%s,%zu,%zu,%.1f\n", what, done, (bytes - before) / 1000,
               1e6 * (end - start) / (double)(done - told));
        fflush(stdout);
        start = end;
        told = done;
    }
    sl_world_destroy(b.context, b.world);
    sl_map_destroy(b.context, &map);
    sl_context_destroy(b.context);
}

/// Removes walls one by one; microseconds for one.
static double remove_all(bench *b) {
    const uint32_t count = sl_world_wall_count(b->world);
    const uint32_t most = count < REMOVED_MOST ? count : REMOVED_MOST;
    uint32_t removed = 0;
    const double start = bench_seconds();
    for (uint32_t i = 0; i < most; i++) {
        sl_segment at;
        if (!sl_world_wall(b->world, i, &at)) continue;
        bench_must(b->context, sl_world_remove(b->context, b->world, i));
        bench_must(b->context, sl_world_commit(b->context, b->world, NULL));
        bench_must(b->context, sl_world_settle(b->context, b->world, 1, NULL));
        removed++;
    }
    return 1e6 * (bench_seconds() - start) / removed;
}

static const char *const names[] = {"none", "now", "later"};

static void print_row(const char *what, const sl_map *map, sl_world_rows rows) {
    bench b = {.context = sl_context_create(NULL), .random = {3}};
    if (!b.context) bench_fail("out of memory");
    sl_world_options options = sl_world_options_default();
    options.rows = rows;
    const double start = bench_seconds();
    bench_must(b.context, sl_world_create(b.context, map, &options, &b.world));
    const double made = 1e3 * (bench_seconds() - start);
    const uint32_t cells = sl_world_cell_count(b.world);
    change_walls(&b);
    const double median = share_of(&b, 2 * EDITS, 0.5), high = share_of(&b, 2 * EDITS, 0.95);
    drag_wall(&b);
    const double drag = share_of(&b, STEPS, 0.5), slow_drag = share_of(&b, STEPS, 0.95);
    printf("%s,%s,%zu,%u,%.0f,%.1f,%.1f,%.1f,%.1f,%.1f\n", what, names[rows], map->wall_count,
           cells, made, median, high, drag, slow_drag, remove_all(&b));
    fflush(stdout);
    sl_region_destroy(b.context, &b.region);
    sl_world_destroy(b.context, b.world);
    sl_context_destroy(b.context);
}

/// `only`: which visible sets; NULL for all.
static void print_map(const char *what, const char *only) {
    sl_context *context = sl_context_create(NULL);
    sl_map map = {0};
    if (!context) bench_fail("out of memory");
    bench_read_map(context, what, NULL, &map);
    bench_must(context, sl_map_clean(context, &map, NULL, NULL));
    for (int rows = SL_WORLD_NO_ROWS; rows <= SL_WORLD_ROWS_LATER; rows++)
        if (!only || strcmp(only, names[rows]) == 0) print_row(what, &map, (sl_world_rows)rows);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(int argc, char **argv) {
    const bool often = argc > 3 && strcmp(argv[1], "--often") == 0;
    if (argc < 2)
        bench_fail("usage: bench_world [--often COUNT | --rows ROWS] KIND:N[:DEGREES] ...");
    if (often) {
        puts("map,edits,kb,edit_us");
        for (int i = 3; i < argc; i++) print_often(argv[i], strtoul(argv[2], NULL, 10));
        return 0;
    }
    puts("map,rows,walls,cells,make_ms,edit_us,edit_95_us,drag_us,drag_95_us,remove_us");
    const char *only = argc > 3 && strcmp(argv[1], "--rows") == 0 ? argv[2] : NULL;
    for (int i = only ? 3 : 1; i < argc; i++) print_map(argv[i], only);
    return 0;
}
