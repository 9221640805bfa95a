// What mending promises: of the gaps and leaks listed, those are left that need a decision.
#include "map/scan.h"
#include "map_files.h"
#include "map_same.h"
#include "sightline/generate.h"
#include "testing.h"

#include <math.h>

/// Scales and moves a map of walls and starts.
static void place(sl_map *map, double scale, double x, double y) {
    for (size_t i = 0; i < map->wall_count; i++) {
        sl_wall *wall = &map->walls[i];
        wall->a = (sl_point){scale * wall->a.x + x, scale * wall->a.y + y};
        wall->b = (sl_point){scale * wall->b.x + x, scale * wall->b.y + y};
    }
    for (size_t i = 0; i < map->start_count; i++)
        map->starts[i].at =
            (sl_point){scale * map->starts[i].at.x + x, scale * map->starts[i].at.y + y};
    assert_int_equal(map->object_count + map->path_count, 0);
}

static double share(sl_random *random) {
    return (double)(sl_random_next(random) >> 11) * 0x1p-53;
}

/// Every end of a wall somewhere else, up to `most` away in x and in y. Marks of solid ground do
/// not fit such walls.
static void jitter(sl_map *map, double most, uint64_t seed) {
    sl_random random = {seed};
    for (size_t i = 0; i < map->wall_count; i++) {
        map->walls[i].ground = 0;
        sl_point *const ends[2] = {&map->walls[i].a, &map->walls[i].b};
        for (int k = 0; k < 2; k++) {
            ends[k]->x += most * (2 * share(&random) - 1);
            ends[k]->y += most * (2 * share(&random) - 1);
        }
    }
}

static sl_point turned(sl_point p, double degrees) {
    const double angle = degrees * 3.14159265358979323846 / 180, c = cos(angle), s = sin(angle);
    return (sl_point){c * p.x - s * p.y, s * p.x + c * p.y};
}

static void turn(sl_map *map, double degrees) {
    for (size_t i = 0; i < map->wall_count; i++) {
        map->walls[i].a = turned(map->walls[i].a, degrees);
        map->walls[i].b = turned(map->walls[i].b, degrees);
    }
    for (size_t i = 0; i < map->start_count; i++)
        map->starts[i].at = turned(map->starts[i].at, degrees);
    sl_glass *const glass[] = {map->mirrors, map->oneways, map->seams};
    const size_t counts[] = {map->mirror_count, map->oneway_count, map->seam_count};
    for (int kind = 0; kind < 3; kind++)
        for (size_t i = 0; i < counts[kind]; i++)
            glass[kind][i].segment = (sl_segment){turned(glass[kind][i].segment.a, degrees),
                                                  turned(glass[kind][i].segment.b, degrees)};
    for (size_t i = 0; i < map->door_count; i++)
        map->doors[i].segment = (sl_segment){turned(map->doors[i].segment.a, degrees),
                                             turned(map->doors[i].segment.b, degrees)};
}

static void find(sl_context *context, const sl_map *map, double gap, const sl_clean_options *clean,
                 sl_faults *faults) {
    const sl_faults_options options = {.gap = gap, .clean = clean};
    sl_map copy = {0};
    sl_space space = {0};
    assert_ok(context, sl_map_copy(context, map, &copy));
    assert_ok(context, sl_map_clean(context, &copy, clean, NULL));
    assert_ok(context, sl_subdivision_for(&copy)->subdivide(context, &copy, NULL, &space));
    assert_ok(context, sl_find_faults(context, map, &space, &options, faults));
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &copy);
}

static uint32_t staying(const sl_faults *faults, sl_fault_kind kind) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < faults->count; i++)
        count += faults->items[i].kind == kind && faults->items[i].stays;
    return count;
}

typedef struct tally {
    size_t maps, gaps, closed, leaks, leaks_closed;
} tally;

static tally all;

/// Mends the map, writes it and reads it, and holds what is left against what was promised.
static void hold_promise(sl_context *context, const sl_map *map, double gap,
                         const sl_clean_options *clean, const char *what) {
    sl_faults before = {0}, after = {0};
    sl_map mended = {0}, read = {0};
    find(context, map, gap, clean, &before);
    assert_ok(context, sl_map_copy(context, map, &mended));
    assert_ok(context, sl_map_mend(context, &mended, gap, clean, NULL));
    char *text = map_text(&mended);
    assert_ok(context, sli_map_read_text(context, "mended", text, strlen(text), &read));
    free(text);
    if (read.wall_count) find(context, &read, gap, clean, &after);
    for (int kind = SL_FAULT_LEAK; kind <= SL_FAULT_GAP && read.wall_count; kind++) {
        const uint32_t promised =
            kind == SL_FAULT_GAP ? staying(&before, SL_FAULT_GAP) : before.leaks_left;
        if (after.counts[kind] != promised || staying(&after, (sl_fault_kind)kind) != promised)
            fail_msg("%s: of %u %ss %u are to be left; %u are left, %u of them to stay", what,
                     before.counts[kind], sl_fault_name((sl_fault_kind)kind), promised,
                     after.counts[kind], staying(&after, (sl_fault_kind)kind));
        if (kind == SL_FAULT_GAP) all.gaps += before.counts[kind];
        if (kind == SL_FAULT_GAP) all.closed += before.counts[kind] - promised;
        if (kind == SL_FAULT_LEAK) all.leaks += before.counts[kind];
        if (kind == SL_FAULT_LEAK)
            all.leaks_closed += before.counts[kind] - staying(&before, SL_FAULT_LEAK);
    }
    all.maps++;
    sl_faults_destroy(context, &before);
    sl_faults_destroy(context, &after);
    sl_map_destroy(context, &mended);
    sl_map_destroy(context, &read);
}

static void generate(sl_context *context, const char *kind, uint64_t walls, uint64_t seed,
                     sl_map *map) {
    sl_generate_options options = sl_generate_options_default();
    options.seed = seed;
    options.walls = walls;
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(kinds[i].name, kind) == 0)
            assert_ok(context, sl_generate(context, &kinds[i], &options, map));
}

static void offices_and_cities(void **state) {
    (void)state;
    static const char *const kinds[] = {"office", "city", "maze"};
    sl_context *context = testing_context(NULL);
    all = (tally){0};
    for (uint64_t seed = 0; seed < testing_seeds(6); seed++) {
        for (int k = 0; k < 3; k++) {
            for (int way = 0; way < 8; way++) {
                sl_map map = {0};
                char what[80];
                generate(context, kinds[k], 150 << (seed % 4), seed, &map);
                const double most = sl_usual_gap(&map) * (way % 4 == 0   ? 1e-3
                                                          : way % 4 == 1 ? 0.3
                                                          : way % 4 == 2 ? 1
                                                                         : 3);
                jitter(&map, most, seed * 8 + (uint64_t)way);
                if (way >= 4) turn(&map, 17.3);
                if (seed % 6 == 4) place(&map, 1, 531577, 184242);
                if (seed % 6 == 5) place(&map, 1e-6, 0, 0);
                const sl_clean_options none = {.weld = 0}, usual = sl_clean_options_default();
                if (seed % 6 == 1) map.precision = most / 2;
                snprintf(what, sizeof what, "%s, seed %d, way %d", kinds[k], (int)seed, way);
                hold_promise(context, &map, sl_usual_gap(&map), seed % 3 == 2 ? &none : &usual,
                             what);
                sl_map_destroy(context, &map);
            }
        }
    }
    print_message("%zu maps, %zu of %zu gaps and %zu of %zu leaks closed\n", all.maps, all.closed,
                  all.gaps, all.leaks_closed, all.leaks);
    assert_true(all.closed > all.maps && all.leaks_closed > 0);
    sl_context_destroy(context);
}

static void map_file(const char *path) {
    for (int way = 0; way < 6; way++) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        map_files_read(context, path, &map);
        const double gap = sl_usual_gap(&map);
        if (way % 3) jitter(&map, way % 3 == 1 ? 0.2 * gap : gap, 5);
        if (way >= 3) turn(&map, 17.3);
        hold_promise(context, &map, gap, NULL, path);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

static void map_files(void **state) {
    (void)state;
    all = (tally){0};
    map_files_each(MAP_FILES_OWN, map_file);
    print_message("%zu maps, %zu of %zu gaps and %zu of %zu leaks closed\n", all.maps, all.closed,
                  all.gaps, all.leaks_closed, all.leaks);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(offices_and_cities),
        cmocka_unit_test(map_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
