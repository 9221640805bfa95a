// What a setting of a query costs, with the next region: a door, a box that blocks, the range.
//   bench_changes KIND:N[:DEGREES] ...    generated maps, turned: city:1000 city:1000:17
// CSV: map, walls, cells, microseconds for the first region, and for a change with the region after
// it: a door, a box, the range; then for the region alone, and its edges. Times are the
// processor's, the least of some rounds. 100 doors stand across portals that are chosen by chance.
// The eye is the one of 100 that sees the most edges.
#include "bench.h"

#include "sightline/query.h"
#include "sightline/support.h"

#include <math.h>

enum { DOORS = 100, ROUNDS = 20, EYES = 100 };

static sl_point random_inside(const sl_space *space, sl_random *random) {
    for (int tries = 0; tries < 100000; tries++) {
        const uint32_t cell = (uint32_t)sl_random_below(random, space->cell_count);
        if (space->cells[cell].inside && !space->cells[cell].solid)
            return sl_space_middle(space, cell);
    }
    bench_fail("the map has no inside");
}

/// The map with doors in some portals of its space, and the space of that.
static void make_space(sl_context *context, const char *what, sl_map *map, sl_space *space) {
    sl_random random = {5};
    sl_map plain = {0};
    bench_read_map(context, what, NULL, &plain);
    bench_must(context, sl_subdivision_for(&plain)->subdivide(context, &plain, NULL, space));
    bench_read_map(context, what, NULL, map);
    for (int i = 0; i < DOORS; i++) {
        char name[16];
        const sl_portal *p = &space->portals[sl_random_below(&random, space->portal_count)];
        snprintf(name, sizeof name, "d%d", i);
        bench_must(context,
                   sl_map_add_door(context, map, name, (sl_segment){p->left, p->right}, true, 0));
    }
    sl_space_destroy(context, space);
    sl_map_destroy(context, &plain);
    bench_must(context, sl_map_clean(context, map, NULL, NULL));
    bench_must(context, sl_subdivision_for(map)->subdivide(context, map, NULL, space));
}

typedef struct bench {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
    sl_random random;
    sl_view view;
    sl_region region;
} bench;

// --- the changes

typedef void change(bench *b, int round);

static void change_door(bench *b, int round) {
    char name[16];
    snprintf(name, sizeof name, "d%d", round % DOORS);
    bench_must(b->context, sl_query_set_door(b->context, b->query, name, false));
}

static void change_box(bench *b, int round) {
    const double half = 0.1 + 0.01 * round;
    const sl_point at = b->view.eye;
    const sl_moving_box box = {{{at.x + half, at.y + half}, {at.x + 2 * half, at.y + 2 * half}},
                               true};
    bench_must(b->context, sl_query_set_boxes(b->context, b->query, &box, 1));
}

static void change_range(bench *b, int round) {
    bench_must(b->context, sl_query_set_range(b->context, b->query, 5 + round));
}

static void change_nothing(bench *b, int round) {
    (void)b;
    (void)round;
}

static double measure(bench *b, change *to) {
    double least = INFINITY;
    for (int round = 0; round < ROUNDS; round++) {
        const double start = bench_seconds();
        to(b, round);
        bench_must(b->context, sl_query_region(b->context, b->query, &b->view, &b->region));
        least = fmin(least, bench_seconds() - start);
    }
    return 1e6 * least;
}

/// Chooses the view. The query for that goes, so that the first region is not yet made.
static void choose_view(bench *b) {
    size_t most = 0;
    bench_must(b->context, sl_query_over(b->context, &b->space, &b->map, NULL, &b->query));
    for (int i = 0; i < EYES; i++) {
        const sl_view view = sl_view_all_round(random_inside(&b->space, &b->random));
        bench_must(b->context, sl_query_region(b->context, b->query, &view, &b->region));
        if (b->region.count <= most) continue;
        most = b->region.count;
        b->view = view;
    }
    sl_query_destroy(b->context, b->query);
}

static void print_row(const char *what) {
    bench b = {.context = sl_context_create(NULL), .random = {9}};
    if (!b.context) bench_fail("out of memory");
    make_space(b.context, what, &b.map, &b.space);
    choose_view(&b);
    bench_must(b.context, sl_query_over(b.context, &b.space, &b.map, NULL, &b.query));
    const double start = bench_seconds();
    bench_must(b.context, sl_query_region(b.context, b.query, &b.view, &b.region));
    const double first = 1e6 * (bench_seconds() - start);
    const size_t edges = b.region.count;
    const double door = measure(&b, change_door), none = measure(&b, change_nothing);
    const double range = measure(&b, change_range);
    bench_must(b.context, sl_query_set_range(b.context, b.query, 0));
    const double box = measure(&b, change_box);
    printf("%s,%u,%u,%.0f,%.1f,%.1f,%.1f,%.1f,%zu\n", what, b.space.wall_count, b.space.cell_count,
           first, door, box, range, none, edges);
    sl_region_destroy(b.context, &b.region);
    sl_query_destroy(b.context, b.query);
    sl_space_destroy(b.context, &b.space);
    sl_map_destroy(b.context, &b.map);
    sl_context_destroy(b.context);
}

int main(int argc, char **argv) {
    if (argc < 2) bench_fail("usage: bench_changes KIND:N[:DEGREES] ...");
    puts("map,walls,cells,first_us,door_us,box_us,range_us,region_us,edges");
    for (int i = 1; i < argc; i++) print_row(argv[i]);
    return 0;
}
