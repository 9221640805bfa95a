// The past beams that a search from a box leaves out: without them the same cells are reached. Few
// are remembered, so that other beams come to the same place.
//   test_runtime_beams [BOXES [SEED]]    so many boxes a map instead of 200
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#define SLRT_PAST_BEAMS 3
#include "runtime_maps.h"

#include "sightline/generate.h"

static uint64_t boxes = 200, seed = 11;

typedef struct reached {
    unsigned char *cells; ///< a byte a cell
    bool forgets;
    size_t beams;
} reached;

static bool note_beam(slrt_beams *b, uint32_t cell, const slrt_beam *beam) {
    reached *r = b->context;
    (void)beam;
    r->cells[cell] = 1;
    r->beams++;
    if (r->forgets) memset(b->past, 0xff, sizeof b->past);
    return false;
}

static bool reach(const sl_runtime *rt, const sl_runtime_box *box, uint32_t *scratch, reached *r) {
    slrt_origin o;
    memset(r->cells, 0, rt->cell_count);
    slrt_start_origin(&o, rt, NULL, 0, scratch);
    o.beams.meet = note_beam;
    o.beams.context = r;
    return !slrt_look_from_box(&o, box, 0);
}

/// A coordinate of a vertex, so that beams are lines, or any.
static double coordinate(sl_random *random, const sl_runtime *rt, int axis) {
    double at[2];
    if (sl_random_below(random, 4)) {
        const uint32_t vertex = (uint32_t)sl_random_below(random, rt->vertex_count);
        sl_runtime_get_vertex(rt, vertex, &at[0], &at[1]);
        return at[axis];
    }
    return axis ? rt->min_y + sl_random_unit(random) * (rt->max_y - rt->min_y)
                : rt->min_x + sl_random_unit(random) * (rt->max_x - rt->min_x);
}

static sl_runtime_box random_box(sl_random *random, const sl_runtime *rt) {
    const double x = coordinate(random, rt, 0), y = coordinate(random, rt, 1);
    const double wide = (double)sl_random_below(random, 3),
                 high = (double)sl_random_below(random, 3);
    return (sl_runtime_box){x - wide, y, x + wide, y + high, false};
}

static void compare(const sl_runtime *rt, const char *name) {
    uint32_t *scratch = malloc(sl_runtime_scratch_count(rt) * sizeof *scratch);
    reached with = {.cells = malloc(rt->cell_count)};
    reached without = {.cells = malloc(rt->cell_count), .forgets = true};
    sl_random random = {seed};
    size_t ended = 0, beams[2] = {0, 0};
    assert_true(scratch && with.cells && without.cells);
    for (uint64_t i = 0; i < boxes; i++) {
        const sl_runtime_box box = random_box(&random, rt);
        with.beams = without.beams = 0;
        if (!reach(rt, &box, scratch, &without) || !reach(rt, &box, scratch, &with)) continue;
        ended++;
        beams[0] += with.beams;
        beams[1] += without.beams;
        if (memcmp(with.cells, without.cells, rt->cell_count) != 0)
            fail_msg("%s: from %.17g,%.17g %.17g,%.17g other cells are reached", name, box.min_x,
                     box.min_y, box.max_x, box.max_y);
    }
    print_message("%s: %zu beams, %zu without past ones\n", name, beams[0], beams[1]);
    assert_true(2 * ended > boxes);
    assert_true(beams[0] <= beams[1]);
    free(scratch);
    free(with.cells);
    free(without.cells);
}

static void test_same_cells_are_reached(void **state) {
    (void)state;
    static const double turns[] = {0, 17.3};
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < 2 * count; i++) {
        const sl_map_kind *kind = &kinds[i / 2];
        baked_file f = {.name = kind->name, .baked = {.method = "dfs", .solver = "funnel"}};
        sl_generate_options options = sl_generate_options_default();
        options.walls = 200;
        options.turned = turns[i % 2];
        options.in_line = i % 2;
        assert_ok(context, sl_generate(context, kind, &options, &f.baked.map));
        baked_file_make(context, &f, false);
        compare(&f.runtime, kind->name);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

int main(int argc, char **argv) {
    if (argc > 1) boxes = strtoull(argv[1], NULL, 10);
    if (argc > 2) seed = strtoull(argv[2], NULL, 10);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_cells_are_reached)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
