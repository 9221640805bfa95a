// What a shortest way costs. Random pairs of points inside, each asked once.
//   bench_route MAP [Z [R [PAIRS [SUBDIVISION]]]]
// CSV: machine, map, walls, cells, milliseconds to make the finder, ways, ways found, microseconds
// a way and their median, search nodes and corners of a way, and the mean length. Z: the slice of a
// 3D model, or -. R: the walker's radius, or 0; pairs without room for it do not count. PAIRS: a
// file with the pairs, x,y,x,y a line; all of them must be in free ground; or -. SUBDIVISION: kd or
// mesh, in place of the usual one.
#include "bench.h"

#include "sightline/path.h"
#include "sightline/support.h"

#include <sys/utsname.h>

enum { WAYS = 500 };

static sl_point random_inside(sl_random *random, const sl_space *space) {
    const sl_box *b = &space->bounds;
    while (true) {
        const sl_point at = {b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                             b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
        if (sl_space_is_inside(space, at)) return at;
    }
}

static void measure(sl_context *context, const char *name, const sl_space *space, sl_query *query,
                    double radius, FILE *pairs) {
    sl_route_finder *finder;
    sl_route route = {0};
    sl_random random = {7};
    uint64_t nodes = 0, corners = 0, found = 0;
    double length = 0, took = 0, times[WAYS];
    int ways = 0;
    const double start = bench_seconds();
    bench_must(context, sl_route_finder_create(context, query, &finder));
    if (radius > 0) bench_must(context, sl_route_finder_set_radius(context, finder, radius));
    const double made = bench_seconds() - start;
    while (ways < WAYS) {
        sl_point from = {0, 0}, to = {0, 0};
        if (pairs && fscanf(pairs, "%lf,%lf,%lf,%lf", &from.x, &from.y, &to.x, &to.y) != 4) break;
        if (!pairs) {
            from = random_inside(&random, space);
            to = random_inside(&random, space);
        }
        const double began = bench_seconds();
        const sl_status status = sl_route_find(context, finder, from, to, &route);
        times[ways] = bench_seconds() - began;
        if (radius > 0 && status == SL_BAD_ARGUMENT) continue; // no room
        bench_must(context, status);
        took += times[ways++];
        nodes += route.nodes;
        found += route.found;
        if (route.found) corners += route.count - 2;
        length += route.length;
    }
    if (!ways) bench_fail("no pairs");
    qsort(times, (size_t)ways, sizeof *times, sl_compare_numbers);
    struct utsname machine;
    uname(&machine);
    puts("machine,map,walls,cells,ms_to_make,ways,found,us_a_way,us_median,nodes,corners,length");
    printf("%s %s,%s,%u,%u,%.1f,%d,%llu,%.1f,%.1f,%.1f,%.1f,%.6g\n", machine.sysname,
           machine.machine, name, space->wall_count, space->cell_count, 1e3 * made, ways,
           (unsigned long long)found, 1e6 * took / ways, 1e6 * times[ways / 2],
           (double)nodes / ways, (double)corners / ways, found ? length / (double)found : 0);
    sl_route_destroy(context, &route);
    sl_route_finder_destroy(context, finder);
}

static const sl_subdivision *subdivision_of(const sl_map *map, const char *name) {
    size_t count;
    const sl_subdivision *all = sl_subdivisions(&count);
    if (!name) return sl_subdivision_for(map);
    for (size_t i = 0; i < count; i++)
        if (strcmp(all[i].name, name) == 0) return &all[i];
    bench_fail("no such subdivision");
}

int main(int argc, char **argv) {
    if (argc < 2) bench_fail("usage: bench_route MAP [Z [R [PAIRS [SUBDIVISION]]]]");
    sl_map map = {0};
    sl_space space = {0};
    sl_query *query;
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    bench_read_map(context, argv[1], argc > 2 && strcmp(argv[2], "-") != 0 ? argv[2] : NULL, &map);
    bench_must(
        context,
        subdivision_of(&map, argc > 5 ? argv[5] : NULL)->subdivide(context, &map, NULL, &space));
    if (!space.inside_count) bench_fail("nothing in the map is inside");
    bench_must(context, sl_query_over(context, &space, &map, NULL, &query));
    const bool has_pairs = argc > 4 && strcmp(argv[4], "-") != 0;
    FILE *pairs = has_pairs ? fopen(argv[4], "r") : NULL;
    if (has_pairs && !pairs) bench_fail("no file of pairs");
    measure(context, argv[1], &space, query, argc > 3 ? strtod(argv[3], NULL) : 0, pairs);
    if (pairs) fclose(pairs);
    sl_query_destroy(context, query);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}
