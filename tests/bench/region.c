// What a visible region costs, whole: location, region and polygon. On generated floors, each query
// once, over a shuffled set of random eyes that are not inside a wall.
//   bench_region      CSV: machine, corners, cells, queries, nanoseconds a query, of them for the
//                     location, points of a region, portals passed
#include "office_maps.h"

#include "sightline/sightline.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/utsname.h>
#include <time.h>

enum { QUERIES = 20000 };

static void must(sl_context *context, sl_status status) {
    if (status == SL_OK) return;
    fprintf(stderr, "bench_region: %s\n", sl_context_message(context));
    exit(1);
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

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

static void measure(sl_context *context, const char *machine, int crosses) {
    static sl_point eyes[QUERIES];
    sl_map map = {0};
    sl_space space = {0};
    sl_outline outline = {0};
    sl_region region = {0};
    const sl_subdivide_options rules = sl_subdivide_options_default();
    must(context, bench_office_map(context, crosses, 1, &map));
    must(context, sl_map_add_start(context, &map, (sl_point){0.5, 0.5}, 0, 0));
    const size_t corners = map.wall_count;
    must(context, sl_map_clean(context, &map, NULL));
    must(context, sl_subdivide_kd(context, &map, &rules, &space));
    must(context, sl_outline_make(context, &space, &outline));
    fill_eyes(&space, eyes);
    double start = now();
    uint64_t sum = 0;
    for (int i = 0; i < QUERIES; i++) sum += sl_space_locate(&space, eyes[i]);
    const double locate = now() - start;
    uint64_t points = 0, passed = 0;
    start = now();
    for (int i = 0; i < QUERIES; i++) {
        const sl_view view = sl_view_all_round(eyes[i]);
        must(context, sl_region_make(context, &outline, &view, 0, &region));
        points += region.count;
        passed += region.portals_passed;
    }
    const double whole = now() - start;
    printf("%s,%zu,%u,%d,%.0f,%.0f,%.1f,%.1f\n", machine, corners, space.cell_count, QUERIES,
           1e9 * whole / QUERIES, sum ? 1e9 * locate / QUERIES : 0, (double)points / QUERIES,
           (double)passed / QUERIES);
    sl_region_destroy(context, &region);
    sl_outline_destroy(context, &outline);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
}

int main(void) {
    static const int sizes[4] = {3, 11, 19, 25};
    struct utsname name;
    const char *machine = uname(&name) == 0 ? name.nodename : "?";
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    puts("machine,corners,cells,queries,ns_a_query,ns_to_locate,points,portals");
    for (int i = 0; i < 4; i++) measure(context, machine, sizes[i]);
    sl_context_destroy(context);
    return 0;
}
