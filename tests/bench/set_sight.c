// What sight from a line costs. Random lines between points inside, up to a length.
//   bench_set_sight MAP LENGTH [Z]    CSV: machine, map, walls, length, seen from some or all,
//                                     milliseconds to make the sight, and a region, cones and
//                                     corners of parts of a region, its corners, microseconds to
//                                     ask for a point, and the time of one eye's region
#include "bench.h"

#include "sightline/set_sight.h"
#include "sightline/support.h"

#include <math.h>
#include <sys/utsname.h>

enum { LINES = 10, POINTS = 1000 };

typedef struct sums {
    double make, region, point, eye;
    uint64_t cones, parts, corners;
} sums;

static sl_point random_inside(sl_random *random, const sl_box *b, const sl_space *space) {
    while (true) {
        const sl_point at = {b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                             b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
        if (sl_space_is_inside(space, at)) return at;
    }
}

static void measure_line(sl_context *context, const sl_space *space, sl_query *query,
                         const sl_point line[2], sl_set_seen seen, sl_random *random, sums *of) {
    sl_set_sight *sight;
    sl_set_region region = {0};
    sl_region one = {0};
    const sl_view view = sl_view_all_round(line[0]);
    double start = bench_seconds();
    bench_must(context, sl_query_region(context, query, &view, &one));
    of->eye += bench_seconds() - start;
    start = bench_seconds();
    bench_must(context, sl_set_sight_create(context, query, line, 2, SL_SET_LINE, &sight));
    of->make += bench_seconds() - start;
    start = bench_seconds();
    bench_must(context, sl_set_sight_region(context, sight, seen, &region));
    of->region += bench_seconds() - start;
    of->cones += region.cones;
    of->parts += region.corners;
    of->corners += region.shape.count ? region.shape.ends[region.shape.count - 1] : 0;
    start = bench_seconds();
    for (int i = 0; i < POINTS; i++) {
        bool sees;
        const sl_point at = random_inside(random, &space->bounds, space);
        bench_must(context, sl_set_sight_sees(context, sight, seen, at, &sees));
    }
    of->point += bench_seconds() - start;
    sl_region_destroy(context, &one);
    sl_set_region_destroy(context, &region);
    sl_set_sight_destroy(context, sight);
}

static void measure(sl_context *context, const char *name, const sl_space *space, sl_query *query,
                    double length) {
    struct utsname machine;
    uname(&machine);
    puts("machine,map,walls,length,seen,ms_to_make,ms_region,cones,parts,corners,us_point,us_eye");
    bench_must(context, sl_query_prepare(context, query));
    for (int seen = 0; seen < 2; seen++) {
        sl_random random = {7};
        sums of = {0};
        for (int i = 0; i < LINES; i++) {
            const sl_point a = random_inside(&random, &space->bounds, space);
            const sl_box *b = &space->bounds;
            const sl_box near = {{fmax(b->min.x, a.x - length), fmax(b->min.y, a.y - length)},
                                 {fmin(b->max.x, a.x + length), fmin(b->max.y, a.y + length)}};
            const sl_point line[2] = {a, random_inside(&random, &near, space)};
            measure_line(context, space, query, line, (sl_set_seen)seen, &random, &of);
        }
        printf("%s %s,%s,%u,%g,%s,%.2f,%.2f,%.1f,%.0f,%.1f,%.2f,%.1f\n", machine.sysname,
               machine.machine, name, space->wall_count, length, seen ? "all" : "some",
               1e3 * of.make / LINES, 1e3 * of.region / LINES, (double)of.cones / LINES,
               (double)of.parts / LINES, (double)of.corners / LINES,
               1e6 * of.point / LINES / POINTS, 1e6 * of.eye / LINES);
    }
}

int main(int argc, char **argv) {
    if (argc < 3) bench_fail("usage: bench_set_sight MAP LENGTH [Z]");
    sl_map map = {0};
    sl_space space = {0};
    sl_query *query;
    double length = 0;
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    if (!sl_number_read(argv[2], strlen(argv[2]), &length) || !(length > 0))
        bench_fail("LENGTH must be over 0");
    bench_read_map(context, argv[1], argc > 3 ? argv[3] : NULL, &map);
    bench_must(context, sl_subdivision_for(&map)->subdivide(context, &map, NULL, &space));
    if (!space.inside_count) bench_fail("nothing in the map is inside");
    bench_must(context, sl_query_over(context, &space, &map, NULL, &query));
    measure(context, argv[1], &space, query, length);
    sl_query_destroy(context, query);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}
