// Where the sweep's time cannot go below: what its row operations and its predicates alone would
// take, beside what it takes.
//   bench_sweep_floor MAP [Z]         a map file, and the height of its slice
//   bench_sweep_floor FILE.wad LEVEL  a level of a WAD
// CSV, a line a figure: machine, map, sight, what, value, unit.
#include "bench.h"

#include "cell_to_cell/sweep/sweep.h"
#include "geometry/orient.h"
#include "sightline/sightline.h"

#include <stdio.h>
#include <sys/utsname.h>
#include <time.h>

enum { ROUNDS = 7 };

/// One row operation of the sweep: a row gains words low .. high - 1 of a set.
typedef struct event {
    uint32_t row, low, high;
} event;

typedef struct floors {
    SL_ARRAY(event) events;
    uint64_t cells;     ///< seen from all corners: each once a corner and half of its fan
    uint64_t intervals; ///< in which they are seen
    uint64_t pieces;    ///< of cells that the search looks at
    uint64_t words;     ///< of all events
} floors;

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

// --- what the sweep does

/// The words that a half of the line can have any in.
static void span(const sli_visible *visible, uint32_t *low, uint32_t *high) {
    *low = UINT32_MAX;
    *high = 0;
    for (size_t i = 0; i < visible->cells.count; i++) {
        const uint32_t word = visible->cells.items[i].cell / 64;
        if (word < *low) *low = word;
        if (word >= *high) *high = word + 1;
    }
}

/// Each cell that comes into sight of one half gains what the other half sees: at most, as words
/// go, all that it comes to see.
static sl_status add_events(sl_context *context, const sli_visible *of, const sli_visible *other,
                            floors *f) {
    uint32_t low, high;
    span(other, &low, &high);
    SL_TRY(SL_ARRAY_ROOM(context, &f->events, of->cells.count));
    for (size_t i = 0; i < of->cells.count && low < high; i++) {
        f->events.items[f->events.count++] = (event){of->cells.items[i].cell, low, high};
        f->words += high - low;
    }
    return SL_OK;
}

static void count_cells(const sli_visible *visible, sli_word_set *set, floors *f) {
    f->intervals += visible->cells.count;
    for (size_t i = 0; i < visible->cells.count; i++) {
        const uint32_t cell = visible->cells.items[i].cell;
        f->cells += !sl_bits_has(set->bits, cell);
        sli_word_set_add(set, cell);
    }
    sli_word_set_clear(set);
}

static sl_status sweep_all(sl_context *context, const sli_fans *fans, sli_sweeper *s, floors *f) {
    sli_word_set set;
    SL_TRY(sli_word_set_create(context, fans->cell_count, &set));
    sl_status status = SL_OK;
    for (size_t i = 0; i < fans->fans.count && status == SL_OK; i++) {
        status = sli_sweep_fan(context, s, &fans->fans.items[i]);
        count_cells(&s->back, &set, f);
        count_cells(&s->middle, &set, f);
        count_cells(&s->ahead, &set, f);
        if (status == SL_OK) status = add_events(context, &s->back, &s->ahead, f);
        if (status == SL_OK) status = add_events(context, &s->ahead, &s->back, f);
    }
    f->pieces = s->finder.pieces;
    sli_word_set_destroy(context, &set);
    return status;
}

// --- the floors, each the least of some rounds, in milliseconds

static double time_fans(sl_context *context, const sl_space *space, const sl_see_options *options) {
    double least = 1e300;
    for (int round = 0; round < ROUNDS; round++) {
        sli_fans fans = {0};
        const double start = now();
        bench_must(context, sli_fans_find(context, space, options, SLI_FANS_MUTUAL, &fans));
        const double took = now() - start;
        sli_fans_destroy(context, &fans);
        if (took < least) least = took;
    }
    return least;
}

static double time_sweep(sl_context *context, const sl_space *space, sl_see_options options,
                         sl_row_storage rows) {
    options.rows = rows;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    double least = 1e300;
    for (size_t m = 0; m < count; m++) {
        for (int round = 0; round < ROUNDS && strcmp(methods[m].name, "sweep") == 0; round++) {
            sl_visibility seen;
            const double start = now();
            bench_must(context, methods[m].see(context, space, &options, &seen));
            const double took = now() - start;
            sl_visibility_destroy(context, &seen);
            if (took < least) least = took;
        }
    }
    return least;
}

static double time_rows(sli_bit_rows *rows, const floors *f, const sl_bits *set) {
    double least = 1e300;
    for (int round = 0; round < ROUNDS; round++) {
        const double start = now();
        for (size_t i = 0; i < f->events.count; i++) {
            const event *e = &f->events.items[i];
            sl_bits *restrict row = sli_bit_rows_dense(rows, e->row);
            for (uint32_t word = e->low; word < e->high; word++) row[word] |= set[word];
        }
        const double took = now() - start;
        if (took < least) least = took;
    }
    return least;
}

/// What `count` orientation tests of points of the map take; `sum` keeps them from being left out.
static double time_tests(const sli_fans *fans, uint64_t count, int64_t *sum) {
    const uint32_t directed = fans->first_directed[fans->cell_count];
    double least = 1e300;
    for (int round = 0; round < ROUNDS && directed; round++) {
        const double start = now();
        for (uint64_t i = 0, e = 0; i < count; i++, e = e + 1 < directed ? e + 1 : 0)
            *sum += sli_orient(fans->ends.items[fans->directed[e].left],
                               fans->ends.items[fans->directed[e].right], fans->ends.items[0]);
        const double took = now() - start;
        if (took < least) least = took;
    }
    return least;
}

/// Bytes a millisecond, of copying more than caches hold.
static double bandwidth(sl_context *context) {
    const size_t bytes = (size_t)128 << 20;
    char *from = sl_alloc_array(context, bytes, 1), *to = sl_alloc_array(context, bytes, 1);
    if (!from || !to) bench_must(context, SL_NO_MEMORY);
    double least = 1e300;
    for (int round = 0; round < ROUNDS; round++) {
        const double start = now();
        memcpy(to, from, bytes);
        const double took = now() - start;
        if (took < least) least = took;
        from[round]++;
    }
    sl_free(context, from);
    sl_free(context, to);
    return 2 * (double)bytes / least;
}

// --- the table

static void measure(sl_context *context, const sl_space *space, sl_sight sight, const char *lead) {
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.threads = 1;
    options.rows = SL_ROWS_DENSE;
    sli_fans fans = {0};
    sli_bit_rows rows;
    sli_sweeper sweeper;
    floors f = {0};
    int64_t sum = 0;
    bench_must(context, sli_fans_find(context, space, &options, SLI_FANS_MUTUAL, &fans));
    bench_must(context, sli_bit_rows_create(context, space->cell_count, &options, &rows));
    bench_must(context,
               sli_sweeper_create(context, &fans, sight == SL_CLOSED, &rows, NULL, &sweeper));
    bench_must(context, sweep_all(context, &fans, &sweeper, &f));
    const char *name = sight == SL_CLOSED ? "closed" : "open";
    const double events = (double)f.events.count, bytes = 16 * (double)f.words;
    const struct {
        const char *what, *unit;
        double value;
    } lines[] = {
        {"cells of the map", "", space->cell_count},
        {"fans", "", (double)fans.fans.count},
        {"pieces looked at", "", (double)f.pieces},
        {"intervals seen", "", (double)f.intervals},
        {"cells seen", "", (double)f.cells},
        {"row operations", "", events},
        {"words a row operation", "", events > 0 ? (double)f.words / events : 0},
        {"whole stage with whole rows", "ms", time_sweep(context, space, options, SL_ROWS_DENSE)},
        {"whole stage with sparse rows", "ms", time_sweep(context, space, options, SL_ROWS_SPARSE)},
        {"of it: finding the fans", "ms", time_fans(context, space, &options)},
        {"floor: row operations alone", "ms", time_rows(&sweeper.rows, &f, sweeper.behind.bits)},
        {"floor: their bytes through memory", "ms", bytes / bandwidth(context)},
        {"floor: two orientation tests a cell seen", "ms", time_tests(&fans, 2 * f.cells, &sum)},
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        printf("%s,%s,%s,%.4g,%s\n", lead, name, lines[i].what, lines[i].value, lines[i].unit);
    if (sum == INT64_MAX) puts("");
    sli_bit_rows_join(context, &rows, &sweeper.rows);
    sli_sweeper_destroy(context, &sweeper);
    sli_bit_rows_destroy(context, &rows);
    sli_fans_destroy(context, &fans);
    sl_free(context, f.events.items);
}

int main(int argc, char **argv) {
    if (argc < 2) {
        fputs("usage: bench_sweep_floor MAP [Z], or FILE.wad LEVEL\n", stderr);
        return 2;
    }
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    sl_space space = {0};
    bench_read_space(context, argv[1], argc > 2 ? argv[2] : NULL, &space);
    struct utsname name;
    char lead[256];
    uname(&name);
    const char *base = strrchr(argv[1], '/');
    snprintf(lead, sizeof lead, "%.40s %.40s,%.80s%s%.40s", name.sysname, name.machine,
             base ? base + 1 : argv[1], argc > 2 ? " " : "", argc > 2 ? argv[2] : "");
    puts("machine,map,sight,what,value,unit");
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++)
        measure(context, &space, (sl_sight)sight, lead);
    sl_space_destroy(context, &space);
    sl_context_destroy(context);
    return 0;
}
