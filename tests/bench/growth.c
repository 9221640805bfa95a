// How time, memory and file size grow with a map of which a cell inside always sees about as much:
// cities, towers, mazes of 1,000 to 1,000,000 walls. Each size in a process of its own.
//   bench_growth FOLDER [KIND[:DEG|=DEG] ...]   CSV on stdout, charts into FOLDER; default: these
// three kinds. city:5 is turned by 5 degrees in doubles, city=5 so that walls in line stay so to
// the last bit; both become a mesh. CSV: machine, kind, walls, cells, pairs, seconds of each stage,
// bytes of memory at most until the file is written, by one thread, and of the file; then for each
// kind the exponents of all that, fitted over the maps from 10,000 walls on. Seconds are the
// processor's, but for cell to cell on one thread and on two beside each other (*_wall_s), which
// mean something on an idle machine only. shards_s is cell to cell in four shards and the joining
// of what they find, longest_s one machine's part of it: the longest shard and the joining. Their
// set must be that of one run.
#include "bench.h"

#include "sightline/draw.h"
#include "sightline/generate.h"
#include "sightline/io.h"
#include "sightline/sightline.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { SIZES = 7, MOST_KINDS = 6, FITTED_FROM = 10000, SHARDS = 4 };

static const uint64_t sizes[SIZES] = {1000, 3162, 10000, 31623, 100000, 316228, 1000000};

/// What is measured of a map; the columns of the CSV from "cells" on.
enum {
    CELLS,
    PAIRS,
    READ_SECONDS,
    CLEAN_SECONDS,
    SUBDIVIDE_SECONDS,
    CHECK_SECONDS,
    SEE_SECONDS,
    WRITE_SECONDS,
    LOAD_SECONDS,
    SHARDS_SECONDS,
    LONGEST_SECONDS,
    ONE_WALL_SECONDS,
    TWO_WALL_SECONDS,
    MEMORY_BYTES,
    FILE_BYTES,
    MEASURES
};

static const char *const names[MEASURES] = {"cells",
                                            "pairs",
                                            "read_s",
                                            "clean_s",
                                            "subdivide_s",
                                            "check_s",
                                            "see_s",
                                            "write_s",
                                            "load_s",
                                            "shards_s",
                                            "longest_s",
                                            "one_thread_wall_s",
                                            "two_threads_wall_s",
                                            "memory_bytes",
                                            "file_bytes"};

typedef struct growth {
    const char *kind; ///< as it is asked for
    const sl_map_kind *made;
    double turned;
    bool in_line;
    double walls[SIZES], of[SIZES][MEASURES], exponents[MEASURES];
} growth;

static double time_of(clockid_t clock) {
    struct timespec time;
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/// Seconds of the processor since *last, which is set to now.
static double lap(double *last) {
    const double before = *last;
    *last = time_of(CLOCK_PROCESS_CPUTIME_ID);
    return *last - before;
}

/// "city", "city:5" or "city=5"
static void read_kind(const char *text, growth *g) {
    const size_t length = strcspn(text, ":=");
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    g->kind = text;
    g->turned = text[length] ? strtod(text + length + 1, NULL) : 0;
    g->in_line = text[length] == '=';
    for (size_t i = 0; i < count; i++)
        if (strlen(kinds[i].name) == length && memcmp(kinds[i].name, text, length) == 0)
            g->made = &kinds[i];
    if (g->made) return;
    fprintf(stderr, "bench_growth: there is no kind of map '%s'\n", text);
    exit(2);
}

static const sl_see_method *sweep(void) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, "sweep") == 0) return &methods[i];
    exit(1);
}

// --- one map, in a process of its own

static void write_map(const growth *g, uint64_t walls, const char *path) {
    sl_context *context = sl_context_create(NULL);
    sl_map map = {0};
    sl_generate_options options = sl_generate_options_default();
    options.walls = walls;
    options.turned = g->turned;
    options.in_line = g->in_line;
    bench_must(context, sl_generate(context, g->made, &options, &map));
    bench_must(context, sl_map_write(context, &map, NULL, path));
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void make_space(sl_context *context, const char *path, sl_baked *baked, double *walls,
                       double *of) {
    double time = time_of(CLOCK_PROCESS_CPUTIME_ID);
    bench_must(context, sl_io_use(context));
    bench_must(context, sl_map_read(context, path, NULL, &baked->map));
    of[READ_SECONDS] = lap(&time);
    *walls = (double)baked->map.wall_count;
    bench_must(context, sl_map_clean(context, &baked->map, NULL, NULL));
    of[CLEAN_SECONDS] = lap(&time);
    const sl_subdivision *way = sl_subdivision_for(&baked->map);
    bench_must(context, way->subdivide(context, &baked->map, NULL, &baked->space));
    of[SUBDIVIDE_SECONDS] = lap(&time);
    bench_must(context, sl_space_check(context, &baked->space));
    of[CHECK_SECONDS] = lap(&time);
    of[CELLS] = baked->space.inside_count;
}

/// Seconds by the clock on the wall.
static double see(sl_context *context, const sl_space *space, unsigned threads,
                  sl_visibility *seen) {
    sl_see_options options = sl_see_options_default();
    options.threads = threads;
    options.inside_only = true;
    const double start = time_of(CLOCK_MONOTONIC);
    bench_must(context, sweep()->see(context, space, &options, seen));
    return time_of(CLOCK_MONOTONIC) - start;
}

/// In four shards, as four machines would, and joined.
static void see_in_shards(sl_context *context, const sl_space *space, const sl_visibility *whole,
                          double *of) {
    sl_see_options options = sl_see_options_default();
    options.threads = 1;
    options.inside_only = true;
    sl_partial all = {0};
    sl_visibility seen;
    double longest = 0, sum = 0, time = time_of(CLOCK_PROCESS_CPUTIME_ID);
    options.shard_count = SHARDS;
    for (options.shard = 1; options.shard <= SHARDS; options.shard++) {
        sl_partial part = {0};
        bench_must(context, sweep()->run(context, space, &options, &part));
        const double took = lap(&time);
        sum += took;
        if (took > longest) longest = took;
        if (sl_partial_begun(&all))
            bench_must(context, sl_partial_merge(context, &all, &part));
        else {
            all = part;
            part = (sl_partial){0};
        }
        sl_partial_destroy(context, &part);
        of[LONGEST_SECONDS] += lap(&time);
    }
    bench_must(context, sweep()->finish(context, space, &options, &all, &seen));
    of[LONGEST_SECONDS] += lap(&time);
    of[SHARDS_SECONDS] = sum + of[LONGEST_SECONDS];
    of[LONGEST_SECONDS] += longest;
    const uint64_t bytes = whole->pvs.offsets[space->cell_count];
    if (seen.pvs.offsets[space->cell_count] != bytes ||
        memcmp(seen.pvs.bytes, whole->pvs.bytes, bytes) != 0)
        bench_must(NULL, SL_BAD_INPUT);
    sl_visibility_destroy(context, &seen);
    sl_partial_destroy(context, &all);
}

static void measure(const char *map_path, const char *path, double *walls, double *of) {
    sl_context *context = sl_context_create(NULL);
    sl_baked baked = {.method = "sweep"}, loaded = {0};
    make_space(context, map_path, &baked, walls, of);
    double time = time_of(CLOCK_PROCESS_CPUTIME_ID);
    of[ONE_WALL_SECONDS] = see(context, &baked.space, 1, &baked.visibility);
    of[SEE_SECONDS] = lap(&time);
    of[PAIRS] = (double)baked.visibility.account.pairs;
    bench_must(context, sl_baked_write(context, &baked, path));
    of[WRITE_SECONDS] = lap(&time);
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    of[MEMORY_BYTES] = (double)usage.ru_maxrss * 1024;
    sl_visibility two;
    of[TWO_WALL_SECONDS] = see(context, &baked.space, 2, &two);
    sl_visibility_destroy(context, &two);
    struct stat file;
    see_in_shards(context, &baked.space, &baked.visibility, of);
    of[FILE_BYTES] = stat(path, &file) == 0 ? (double)file.st_size : 0;
    sl_baked_destroy(context, &baked);
    lap(&time);
    bench_must(context, sl_baked_read(context, path, &loaded));
    of[LOAD_SECONDS] = lap(&time);
    sl_baked_destroy(context, &loaded);
    sl_context_destroy(context);
}

/// Runs in a process of its own, so that memory counts from nothing.
static void measure_apart(const char *folder, growth *g, int size) {
    char map_path[4096], path[4096];
    snprintf(map_path, sizeof map_path, "%s/growth.map", folder);
    snprintf(path, sizeof path, "%s/growth.slv", folder);
    double told[MEASURES + 1] = {0};
    int ends[2], status;
    for (int measures = 0; measures < 2; measures++) {
        if (pipe(ends) != 0) bench_must(NULL, SL_IO);
        const pid_t child = fork();
        if (child == 0) {
            if (measures)
                measure(map_path, path, told, told + 1);
            else
                write_map(g, sizes[size], map_path);
            _exit(write(ends[1], told, sizeof told) == (ssize_t)sizeof told ? 0 : 1);
        }
        close(ends[1]);
        const bool got = read(ends[0], told, sizeof told) == (ssize_t)sizeof told;
        close(ends[0]);
        if (child < 0 || waitpid(child, &status, 0) != child || status != 0 || !got)
            bench_must(NULL, SL_IO);
    }
    g->walls[size] = told[0];
    memcpy(g->of[size], told + 1, sizeof g->of[size]);
    remove(map_path);
    remove(path);
}

// --- what it comes to

/// Of a power of the number of walls, by least squares of logarithms.
static double fit(const growth *g, int measure) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int i = 0; i < SIZES; i++) {
        if (sizes[i] < FITTED_FROM) continue;
        const double u = log(g->walls[i]), v = log(g->of[i][measure]);
        n++;
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

static void print_row(const char *machine, const growth *g, int size) {
    printf("%s,%s,%.0f", machine, g->kind, g->walls[size]);
    for (int m = 0; m < MEASURES; m++) printf(",%.9g", g->of[size][m]);
    putchar('\n');
    fflush(stdout);
}

static void print_exponents(const char *machine, growth *g) {
    printf("%s,%s,exponent", machine, g->kind);
    for (int m = 0; m < MEASURES; m++) printf(",%.3f", g->exponents[m] = fit(g, m));
    putchar('\n');
    fflush(stdout);
}

// --- charts

typedef struct line {
    sl_chart_mark marks[SIZES];
    char name[96];
} line;

static void fill_line(const growth *g, int measure, const char *name, line *l,
                      sl_chart_series *series, unsigned colour) {
    snprintf(l->name, sizeof l->name, "%s: n^%.2f", name, g->exponents[measure]);
    for (int i = 0; i < SIZES; i++)
        l->marks[i] = (sl_chart_mark){.x = g->walls[i], .y = g->of[i][measure]};
    *series = (sl_chart_series){.name = l->name,
                                .style = SL_CHART_LINE,
                                .colour = colour,
                                .marks = l->marks,
                                .mark_count = SIZES};
}

static void draw(const char *title, const char *subtitle, const sl_chart_axis *y,
                 const sl_chart_series *series, size_t count, const char *folder,
                 const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    const sl_chart chart = {
        .title = title,
        .subtitle = subtitle,
        .notes = "n^: the power of the number of walls that it grows with, from 10,000 walls on",
        .x = {.label = "walls", .scale = SL_CHART_LOG},
        .y = *y,
        .series = series,
        .series_count = count,
        .width = sl_draw_options_default().width};
    sl_context *context = sl_context_create(NULL);
    bench_must(context, sl_draw_chart_file(context, &chart, path));
    sl_context_destroy(context);
}

static void draw_times(const growth *g, const char *folder) {
    static const int stages[6] = {SEE_SECONDS,   SUBDIVIDE_SECONDS, CHECK_SECONDS,
                                  CLEAN_SECONDS, WRITE_SECONDS,     LOAD_SECONDS};
    static const char *const called[6] = {"cell to cell", "subdivide", "check",
                                          "clean",        "write",     "read the file back"};
    line lines[6];
    sl_chart_series series[6];
    char title[128], subtitle[160], name[64];
    for (int i = 0; i < 6; i++)
        fill_line(g, stages[i], called[i], &lines[i], &series[i], (unsigned)i);
    snprintf(title, sizeof title, "%s: time against walls", g->kind);
    snprintf(subtitle, sizeof subtitle,
             "a cell sees %.0f cells in the smallest, %.0f in the "
             "largest; one thread",
             g->of[0][PAIRS] / g->of[0][CELLS], g->of[SIZES - 1][PAIRS] / g->of[SIZES - 1][CELLS]);
    snprintf(name, sizeof name, "growth-%s", g->kind);
    const sl_chart_axis y = {
        .label = "processor time of a stage", .scale = SL_CHART_LOG, .seconds = true};
    draw(title, subtitle, &y, series, 6, folder, name);
}

static void draw_bytes(const growth *all, size_t count, const char *folder) {
    line lines[SL_CHART_COLOURS];
    sl_chart_series series[SL_CHART_COLOURS];
    size_t used = 0;
    for (size_t i = 0; i < count && used + 2 <= SL_CHART_COLOURS; i++) {
        char name[64];
        for (int file = 0; file < 2; file++, used++) {
            snprintf(name, sizeof name, "%s, %s", all[i].kind, file ? "file" : "memory");
            fill_line(&all[i], file ? FILE_BYTES : MEMORY_BYTES, name, &lines[used], &series[used],
                      (unsigned)used);
            for (int k = 0; k < SIZES; k++) lines[used].marks[k].y /= 1 << 20;
        }
    }
    const sl_chart_axis y = {.label = "MiB", .scale = SL_CHART_LOG};
    draw("Memory and file size against walls", "the most memory of the whole process", &y, series,
         used, folder, "growth-bytes");
}

int main(int argc, char **argv) {
    static const char *const usual[] = {"city", "tower", "maze"};
    static growth all[MOST_KINDS];
    if (argc < 2 || argc > 2 + MOST_KINDS) {
        fputs("usage: bench_growth FOLDER [KIND[:DEG|=DEG] ...]\n", stderr);
        return 2;
    }
    const size_t count = argc > 2 ? (size_t)argc - 2 : 3;
    struct utsname name;
    char machine[128];
    uname(&name);
    snprintf(machine, sizeof machine, "%.40s %.40s", name.sysname, name.machine);
    printf("machine,kind,walls");
    for (int m = 0; m < MEASURES; m++) printf(",%s", names[m]);
    putchar('\n');
    fflush(stdout);
    for (size_t i = 0; i < count; i++) {
        growth *g = &all[i];
        read_kind(argc > 2 ? argv[2 + i] : usual[i], g);
        for (int size = 0; size < SIZES; size++) {
            measure_apart(argv[1], g, size);
            print_row(machine, g, size);
        }
        print_exponents(machine, g);
    }
    for (size_t i = 0; i < count; i++) draw_times(&all[i], argv[1]);
    draw_bytes(all, count, argv[1]);
    return 0;
}
