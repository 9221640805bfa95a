// What walls that break cost in a game: rows that are settled again after each wall.
//   bench_state KIND:N WALLS LIMIT     city:5 300 16: so many of the walls, chosen by chance,
//   break;
//                                      up to LIMIT sets of doors are kept for a pair
// CSV, a line for each quarter of these walls as they break in turn: how many are broken by then,
// seconds of the bake, rows, KB of a state; rows unsettled by a wall (median), microseconds to
// break it (median), to settle the rows (median, 95 of 100, most), of a single call with 1,000
// portals (mean, 99.9 of 100, most), rows given up, and pairs at the end: exact, and as the baked
// rows have them.
#include "bench.h"

#include "baked_bytes.h"
#include "sightline/support.h"

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

enum { CALL = 1000 };

typedef struct bench {
    sl_context *context;
    sl_random random;
    sl_baked baked;
    sl_runtime runtime;
    sl_runtime_state state;
    size_t words;
    double bake_seconds;
    SL_ARRAY(double) calls; ///< microseconds of each, with as many portals as are asked for
} bench;

/// Turns walls into walls that break: each is swapped with one of the rest, chosen by chance.
static void break_walls(bench *b, const char *what, size_t count, sl_map *map) {
    sl_map whole = {0};
    bench_read_map(b->context, what, NULL, &whole);
    if (count >= whole.wall_count) count = whole.wall_count - 1; // a map has walls
    for (size_t i = 0; i < whole.wall_count; i++) {
        const size_t k = i + (size_t)sl_random_below(&b->random, whole.wall_count - i);
        const sl_wall wall = whole.walls[k];
        char name[32];
        whole.walls[k] = whole.walls[i];
        snprintf(name, sizeof name, "b%zu", i);
        if (i >= count) {
            bench_must(b->context, sl_map_add_wall(b->context, map, wall.a, wall.b, 0));
            continue;
        }
        bench_must(b->context,
                   sl_map_add_door(b->context, map, name, (sl_segment){wall.a, wall.b}, false, 0));
        map->doors[map->door_count - 1].kind = SL_DOOR_BREAKABLE;
    }
    sl_map_destroy(b->context, &whole);
}

static void bake(bench *b, const char *what, size_t walls, uint32_t limit) {
    sl_bake_options options = sl_bake_options_default();
    sl_map map = {0};
    size_t size;
    break_walls(b, what, walls, &map);
    options.door_limit = limit;
    options.see.threads = 1;
    const double start = bench_seconds();
    bench_must(b->context, sl_bake(b->context, &map, &options, &b->baked, NULL));
    b->bake_seconds = bench_seconds() - start;
    const char *bytes = baked_bytes(b->context, &b->baked, &size);
    if (sl_runtime_open(bytes, size, &b->runtime) != SL_RUNTIME_OK) bench_fail("not a baked file");
    b->words = sl_runtime_state_count(&b->runtime);
    uint32_t *memory = malloc(b->words * sizeof *memory);
    if (!memory) bench_fail("out of memory");
    sl_runtime_state_start(&b->state, &b->runtime, memory);
}

static void settle(bench *b) {
    for (uint32_t left = 1; left;) {
        const double start = bench_seconds();
        left = sl_runtime_settle(&b->state, CALL);
        bench_must(b->context, SL_ARRAY_ROOM(b->context, &b->calls, 1));
        b->calls.items[b->calls.count++] = 1e6 * (bench_seconds() - start);
    }
}

static double share(double *values, size_t count, size_t percent) {
    qsort(values, count, sizeof *values, sl_compare_numbers);
    return values[percent == 100 ? count - 1 : count * percent / 100];
}

/// Ordered pairs, by settled rows or by those of the bake.
static uint64_t pairs(const bench *b, bool settled, unsigned char *bits) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < b->runtime.cell_count; i++)
        sum += settled ? sl_runtime_state_row_bits(&b->state, i, bits)
                       : sl_runtime_seen_from(&b->runtime, &i, 1, b->state.shut, bits);
    return sum;
}

static void measure(bench *b, uint32_t first, uint32_t end) {
    const size_t count = end - first;
    double all = 0;
    b->calls.count = 0;
    double *rows = calloc(3 * count + 1, sizeof *rows), *set = rows + count, *took = set + count;
    unsigned char *bits = malloc(b->runtime.cell_count / 8 + 1);
    if (!rows || !bits) bench_fail("out of memory");
    for (size_t i = 0; i < count; i++) {
        const double start = bench_seconds();
        sl_runtime_state_set_door(&b->state, first + (uint32_t)i, false);
        const double between = bench_seconds();
        rows[i] = b->state.unsettled;
        settle(b);
        set[i] = 1e6 * (between - start);
        took[i] = 1e6 * (bench_seconds() - between);
    }
    const size_t calls = b->calls.count;
    for (size_t i = 0; i < calls; i++) all += b->calls.items[i];
    qsort(b->calls.items, calls, sizeof(double), sl_compare_numbers);
    printf("%u,%.3f,%u,%zu,%.0f,%.1f,%.0f,%.0f,%.0f,%.0f,%.0f,%.0f,%u,%llu,%llu\n", end,
           b->bake_seconds, b->runtime.cell_count, b->words * sizeof(uint32_t) / 1024,
           share(rows, count, 50), share(set, count, 50), share(took, count, 50),
           share(took, count, 95), share(took, count, 100), all / (double)calls,
           b->calls.items[(calls - 1) * 999 / 1000], b->calls.items[calls - 1], b->state.given_up,
           (unsigned long long)pairs(b, true, bits), (unsigned long long)pairs(b, false, bits));
    fflush(stdout);
    free(rows);
    free(bits);
}

int main(int argc, char **argv) {
    if (argc != 4) bench_fail("usage: bench_state KIND:N WALLS LIMIT");
    bench b = {.context = sl_context_create(NULL), .random = {3}};
    bake(&b, argv[1], strtoull(argv[2], NULL, 10), (uint32_t)strtoul(argv[3], NULL, 10));
    settle(&b);
    puts("broken,bake_seconds,rows,state_kb,unsettled,break_us,settle_us,settle_95_us,settle_most_"
         "us,call_us,call_999_us,call_most_us,given_up,pairs,baked_pairs");
    for (uint32_t i = 0; i < 4; i++)
        measure(&b, b.runtime.door_count * i / 4, b.runtime.door_count * (i + 1) / 4);
    sl_free(b.context, b.calls.items);
    sl_baked_destroy(b.context, &b.baked);
    sl_context_destroy(b.context);
    return 0;
}
