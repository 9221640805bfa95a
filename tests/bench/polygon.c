// The runtime's visible polygon beside the library's visible region: time and equality, over random
// eyes in cells that are inside. Of eight eyes one is on a corner, on a portal or in line with
// corners; those are compared, not timed.
//   bench_polygon FILE.slv [EYES]    a million eyes by default
// CSV: machine, file, cells, eyes compared, those whose polygons differ, points of a polygon,
// nanoseconds of the library and of the runtime, their ratio. Each batch of eyes is timed three
// times by both, in turn, and the least counts. Exits with 1 if polygons differ.
#include "bench.h"
#include "effects/filtered.h"
#include "sight/region.h"
#include "space/outline.h"

#include "polygon_same.h"

#include "sightline/sightline.h"
#include "sightline/support.h"

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/utsname.h>

enum { BATCH = 1000, ROUNDS = 3, ROOM = 1 << 13, EYES = 1000000 };

typedef struct bench {
    sl_context *context;
    sl_baked baked;
    sl_runtime runtime;
    unsigned char *shut;
    uint32_t *scratch;
    sl_space walled; ///< with walls in the shut doors
    sl_outline outline;
    sl_region region;
    double range;
    sl_random random;
    sl_point eyes[BATCH];
    sl_point points[ROOM];
    uint64_t compared, differ, point_count;
    double library, header; ///< seconds
    uint64_t timed;
} bench;

// --- eyes

static sl_point any_point(bench *b) {
    const sl_box *box = &b->baked.space.bounds;
    return (sl_point){box->min.x + sl_random_unit(&b->random) * (box->max.x - box->min.x),
                      box->min.y + sl_random_unit(&b->random) * (box->max.y - box->min.y)};
}

static sl_point special_point(bench *b) {
    const sl_space *s = &b->baked.space;
    const sl_point v = s->vertices[sl_random_below(&b->random, s->vertex_count)];
    const sl_point w = s->vertices[sl_random_below(&b->random, s->vertex_count)];
    const uint64_t kind = sl_random_below(&b->random, 3);
    if (kind == 0 || !s->portal_count) return v;
    if (kind == 1) return (sl_point){v.x, w.y};
    const sl_portal *p = &s->portals[sl_random_below(&b->random, s->portal_count)];
    const double part = (double)sl_random_below(&b->random, 5) / 4;
    return (sl_point){p->left.x + part * (p->right.x - p->left.x),
                      p->left.y + part * (p->right.y - p->left.y)};
}

static void fill_eyes(bench *b, bool special) {
    const sl_space *s = &b->baked.space;
    for (int i = 0; i < BATCH;) {
        b->eyes[i] = special ? special_point(b) : any_point(b);
        const uint32_t cell = sl_space_locate(s, b->eyes[i]);
        i += cell != SL_NO_CELL && !s->cells[cell].solid &&
             (s->cells[cell].inside || !s->inside_count);
    }
}

// --- one eye

static void ask_library(bench *b, sl_point eye) {
    const sl_view view = sl_view_all_round(eye);
    bench_must(b->context, sli_region_make(b->context, &b->outline, &view, b->range, &b->region));
}

static uint32_t ask_header(bench *b, sl_point eye) {
    const sl_runtime_view view = sl_runtime_view_all_round(eye.x, eye.y);
    return sl_runtime_visible_polygon(&b->runtime, &view, b->shut, 0, b->scratch, &b->points[0].x,
                                      ROOM);
}

static bool same(bench *b, sl_point eye) {
    const sl_runtime *r = &b->runtime;
    const double size = fmax(r->max_x - r->min_x, r->max_y - r->min_y);
    const double error = polygon_error(&b->baked.space.bounds);
    ask_library(b, eye);
    const uint32_t count = ask_header(b, eye);
    const sl_region *is = &b->region;
    if (count > ROOM) bench_fail("a polygon has too many points for this benchmark");
    b->point_count += count;
    if (!count || is->count < 3) return !count && fabs(sl_region_area(is)) <= error * size;
    const double area = polygon_area(eye, b->points, count);
    return fabs(area - sl_region_area(is)) <= 8 * error * size &&
           polygon_farthest(b->points, count, is->points, is->count) <= 4 * error &&
           polygon_farthest(is->points, is->count, b->points, count) <= 4 * error;
}

static void compare_batch(bench *b) {
    for (int i = 0; i < BATCH; i++, b->compared++) {
        if (same(b, b->eyes[i])) continue;
        if (!b->differ++)
            fprintf(stderr, "bench_polygon: the polygons of %.17g,%.17g differ\n", b->eyes[i].x,
                    b->eyes[i].y);
    }
}

static void time_batch(bench *b) {
    double library = INFINITY, header = INFINITY;
    for (int k = 0; k < ROUNDS; k++) {
        double start = bench_seconds();
        for (int i = 0; i < BATCH; i++) ask_library(b, b->eyes[i]);
        library = fmin(library, bench_seconds() - start);
        start = bench_seconds();
        for (int i = 0; i < BATCH; i++) ask_header(b, b->eyes[i]);
        header = fmin(header, bench_seconds() - start);
    }
    b->library += library;
    b->header += header;
    b->timed += BATCH;
}

// --- the whole

static void open_file(bench *b, const char *name) {
    size_t size;
    bench_must(b->context, sl_baked_read(b->context, name, &b->baked));
    const void *bytes = bench_read_file(name, &size);
    const sl_runtime_status status = sl_runtime_open(bytes, size, &b->runtime);
    if (status != SL_RUNTIME_OK) bench_fail(sl_runtime_status_text(status));
    if (b->runtime.loose) bench_fail("the file is loose: bake the map again");
    if (b->baked.map.oneway_count) bench_fail("the library's outline has no one-way glass");
    const uint32_t doors = b->runtime.door_count;
    bool *shut = calloc(doors + 1, sizeof *shut);
    b->shut = calloc(doors + 1, 1);
    b->scratch = malloc(sl_runtime_scratch_count(&b->runtime) * sizeof *b->scratch);
    if (!shut || !b->shut || !b->scratch) bench_fail("out of memory");
    for (uint32_t i = 0; i < doors; i++)
        b->shut[i] = shut[i] = !sl_runtime_door_open(&b->runtime, i);
    const sli_filtered_space filtered = {.shut = shut};
    bench_must(b->context,
               sli_filtered_space_make(b->context, &b->baked.space, &filtered, NULL, &b->walled));
    bench_must(b->context, sli_outline_make(b->context, &b->walled, &b->outline));
    b->range = b->baked.map.range;
    b->random = (sl_random){7};
    free(shut);
}

int main(int argc, char **argv) {
    static bench b;
    if (argc < 2 || argc > 3) {
        fputs("usage: bench_polygon FILE.slv [EYES]\n", stderr);
        return 2;
    }
    const uint64_t eyes = argc > 2 ? strtoull(argv[2], NULL, 10) : EYES;
    b.context = sl_context_create(NULL);
    if (!b.context) bench_fail("out of memory");
    open_file(&b, argv[1]);
    for (uint64_t i = 0; b.compared < eyes; i++) {
        fill_eyes(&b, i % 8 == 7);
        compare_batch(&b);
        if (i % 8 != 7) time_batch(&b);
    }
    struct utsname machine;
    uname(&machine);
    puts("machine,file,cells,eyes,differ,points,ns_library,ns_runtime,ratio");
    printf("%s %s,%s,%u,%llu,%llu,%.1f,%.0f,%.0f,%.2f\n", machine.sysname, machine.machine, argv[1],
           b.runtime.cell_count, (unsigned long long)b.compared, (unsigned long long)b.differ,
           (double)b.point_count / (double)b.compared, 1e9 * b.library / (double)b.timed,
           1e9 * b.header / (double)b.timed, b.header / b.library);
    return b.differ != 0;
}
