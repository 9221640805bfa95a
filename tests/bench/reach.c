// What it costs to ask whether two players may see each other within the next moments.
//   bench_reach MAP RADIUS DISTANCE [Z]    pairs of places inside, up to so far apart
// CSV: machine, map, walls, cells, radius, distance, kind, microseconds a question, how many are
// answered yes in percent, milliseconds to make the reach.
#include "bench.h"

#include "sightline/reach.h"
#include "sightline/support.h"

#include <math.h>
#include <sys/utsname.h>

enum { QUESTIONS = 20000 };

static sl_point random_inside(sl_random *random, const sl_box *b, const sl_space *space) {
    while (true) {
        const sl_point at = {b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                             b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
        if (sl_space_is_inside(space, at)) return at;
    }
}

static sl_box box_about(const sl_box *bounds, sl_point at, double far) {
    return (sl_box){{fmax(bounds->min.x, at.x - far), fmax(bounds->min.y, at.y - far)},
                    {fmin(bounds->max.x, at.x + far), fmin(bounds->max.y, at.y + far)}};
}

static void measure(sl_context *context, const char *name, sl_baked *baked, double radius,
                    double far) {
    static sl_point pairs[QUESTIONS][2];
    struct utsname machine;
    const sl_box *bounds = &baked->space.bounds;
    sl_random random = {1};
    sl_query *query;
    sl_reach *reach;
    uname(&machine);
    for (int i = 0; i < QUESTIONS; i++) {
        pairs[i][0] = random_inside(&random, bounds, &baked->space);
        const sl_box near = box_about(bounds, pairs[i][0], far);
        pairs[i][1] = random_inside(&random, &near, &baked->space);
    }
    bench_must(context, sl_query_over(context, &baked->space, &baked->map, NULL, &query));
    double start = bench_seconds();
    bench_must(context, sl_reach_create(context, query, &reach));
    const double made = bench_seconds() - start;
    for (int kind = SL_REACH_STRAIGHT; kind <= SL_REACH_ON_FOOT; kind++) {
        int yes = 0;
        start = bench_seconds();
        for (int i = 0; i < QUESTIONS; i++) {
            bool sees;
            bench_must(context,
                       sl_reach_sees_within(context, reach, pairs[i][0], radius, pairs[i][1],
                                            radius, (sl_reach_kind)kind, &sees));
            yes += sees;
        }
        const double each = (bench_seconds() - start) / QUESTIONS;
        printf("%s %s,%s,%u,%u,%g,%g,%s,%.2f,%.1f,%.1f\n", machine.sysname, machine.machine, name,
               baked->space.wall_count, baked->space.cell_count, radius, far,
               kind == SL_REACH_STRAIGHT ? "straight" : "on foot", 1e6 * each,
               100.0 * yes / QUESTIONS, 1e3 * made);
    }
    sl_reach_destroy(context, reach);
    sl_query_destroy(context, query);
}

int main(int argc, char **argv) {
    if (argc < 4) bench_fail("usage: bench_reach MAP RADIUS DISTANCE [Z]");
    sl_baked baked = {0};
    double radius = 0, far = 0;
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    if (!sl_number_read(argv[2], strlen(argv[2]), &radius) ||
        !sl_number_read(argv[3], strlen(argv[3]), &far) || !(radius >= 0 && far > 0))
        bench_fail("RADIUS must be 0 or more, DISTANCE over 0");
    bench_read_map(context, argv[1], argc > 4 ? argv[4] : NULL, &baked.map);
    bench_must(context,
               sl_subdivision_for(&baked.map)->subdivide(context, &baked.map, NULL, &baked.space));
    if (!baked.space.inside_count) bench_fail("nothing in the map is inside");
    puts("machine,map,walls,cells,radius,distance,kind,us_question,percent_yes,ms_to_make");
    measure(context, argv[1], &baked, radius, far);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
    return 0;
}
