// What a visible region costs, whole: location, region and polygon; and whether two points see each
// other. Each query once, over a shuffled set of random eyes in cells that are inside.
//   bench_region MAP [Z]   CSV: machine, map, walls, cells, rooms of the outline, queries,
//                          nanoseconds a region, of them for the location, points of a region,
//                          portals passed, nanoseconds for two points, and the share that see each
//                          other
#include "bench.h"
#include "space/outline.h"

#include "sight/region.h"
#include "sightline/sightline.h"
#include "sightline/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/utsname.h>

enum { QUERIES = 20000 };

static void fill_eyes(const sl_space *space, sl_point *eyes) {
    sl_random random = {7};
    const sl_box *b = &space->bounds;
    for (int i = 0; i < QUERIES;) {
        eyes[i] = (sl_point){b->min.x + sl_random_unit(&random) * (b->max.x - b->min.x),
                             b->min.y + sl_random_unit(&random) * (b->max.y - b->min.y)};
        const uint32_t cell = sl_space_locate(space, eyes[i]);
        i += cell != SL_NO_CELL && space->cells[cell].inside;
    }
}

static void measure(sl_context *context, const char *path, const sl_space *space) {
    static sl_point eyes[QUERIES];
    sl_outline outline = {0};
    sl_region region = {0};
    bench_must(context, sli_outline_make(context, space, &outline));
    fill_eyes(space, eyes);
    double start = bench_seconds();
    uint64_t sum = 0;
    for (int i = 0; i < QUERIES; i++) sum += sl_space_locate(space, eyes[i]);
    const double locate = bench_seconds() - start;
    uint64_t points = 0, passed = 0;
    start = bench_seconds();
    for (int i = 0; i < QUERIES; i++) {
        const sl_view view = sl_view_all_round(eyes[i]);
        bench_must(context, sli_region_make(context, &outline, &view, 0, &region));
        points += region.count;
        passed += region.portals_passed;
    }
    const double whole = bench_seconds() - start;
    int seen = 0;
    start = bench_seconds();
    for (int i = 0; i < QUERIES; i++) {
        bool sees = false;
        bench_must(context,
                   sli_sees(context, &outline, eyes[i], eyes[(i + 1) % QUERIES], SL_CLOSED, &sees));
        seen += sees;
    }
    const double pairs = bench_seconds() - start;
    struct utsname machine;
    uname(&machine);
    puts("machine,map,walls,cells,rooms,queries,ns_a_query,ns_to_locate,points,portals,"
         "ns_two_points,share_seen");
    printf("%s %s,%s,%u,%u,%u,%d,%.0f,%.0f,%.1f,%.1f,%.0f,%.3f\n", machine.sysname, machine.machine,
           path, space->wall_count, space->cell_count, outline.room_count, QUERIES,
           1e9 * whole / QUERIES, sum ? 1e9 * locate / QUERIES : 0, (double)points / QUERIES,
           (double)passed / QUERIES, 1e9 * pairs / QUERIES, (double)seen / QUERIES);
    sl_region_destroy(context, &region);
    sli_outline_destroy(context, &outline);
}

int main(int argc, char **argv) {
    if (argc < 2) {
        fputs("usage: bench_region MAP [Z]\n", stderr);
        return 2;
    }
    sl_space space = {0};
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    bench_read_space(context, argv[1], argc > 2 ? argv[2] : NULL, &space);
    if (!space.inside_count) {
        fprintf(stderr, "bench_region: %s: nothing in it is inside\n", argv[1]);
        return 1;
    }
    measure(context, argv[1], &space);
    sl_space_destroy(context, &space);
    sl_context_destroy(context);
    return 0;
}
