/// The choice of a subdivision, where the splits of a kd-tree lie, and how a mesh comes about.
#include "testing.h"

#include "geometry/orient.h"
#include "sightline/import.h"
#include "sightline/support.h"
#include "space/kd_tree.h"
#include "space/mesh.h"

#include <math.h>
#include <string.h>

static double area_of(sl_box box) {
    return (box.max.x - box.min.x) * (box.max.y - box.min.y);
}

static bool near(double a, double b) {
    return fabs(a - b) <= 1e-9 * fmax(1, fmax(fabs(a), fabs(b)));
}

static void walls_choose_the_subdivision(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){0, 0}, (sl_point){4, 0}, 0));
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){4, 0}, (sl_point){4, 3}, 0));
    assert_true(sl_map_is_axial(&map));
    assert_string_equal(sl_subdivision_for(&map)->name, "kd");
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){4, 3}, (sl_point){0, 0}, 0));
    assert_false(sl_map_is_axial(&map));
    assert_string_equal(sl_subdivision_for(&map)->name, "mesh");
    size_t count;
    const sl_subdivision *all = sl_subdivisions(&count);
    assert_true(count >= 2);
    sl_space space;
    assert_int_equal(all[0].subdivide(context, &map, NULL, &space), SL_BAD_INPUT);
    assert_ok(context, all[1].subdivide(context, &map, NULL, &space));
    assert_true(space.cell_count > 1);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// A cleaned map of the repository, and its space by a subdivision; NULL: as the map calls for.
static void read_space(sl_context *context, const char *path, const char *subdivision, sl_map *map,
                       sl_space *space) {
    char full[4096];
    size_t count, i = 0;
    const sl_subdivision *all = sl_subdivisions(&count);
    *map = (sl_map){0};
    snprintf(full, sizeof full, "%s/maps/%s", SIGHTLINE_SOURCE_DIR, path);
    assert_ok(context, sl_map_read(context, full, NULL, map));
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
    while (subdivision && strcmp(all[i].name, subdivision) != 0) i++;
    const sl_subdivision *use = subdivision ? &all[i] : sl_subdivision_for(map);
    assert_ok(context, use->subdivide(context, map, NULL, space));
}

/// The sides of splits that are cells fill the bounds, and each split lies between its sides.
static void check_splits(const sl_space *space, const sli_split *splits) {
    double cells = 0;
    for (uint32_t n = 0; n < space->node_count; n++) {
        const sl_node *node = &space->nodes[n];
        const sli_split *s = &splits[n];
        assert_true(s->depth < space->tree_depth);
        assert_true(area_of(s->below) > 0 && area_of(s->above) > 0);
        assert_true(memcmp(&s->along.a, &s->above.min, sizeof s->along.a) == 0);
        assert_true(memcmp(&s->along.b, &s->below.max, sizeof s->along.b) == 0);
        if (node->below < 0) cells += area_of(s->below);
        if (node->above < 0) cells += area_of(s->above);
        if (node->below >= 0) assert_int_equal(splits[node->below].depth, s->depth + 1);
        if (node->above >= 0) assert_int_equal(splits[node->above].depth, s->depth + 1);
    }
    assert_true(near(cells, area_of(space->bounds)));
}

static void boxes_fill_the_bounds(void **state) {
    (void)state;
    const char *const paths[] = {"office.map", "spiral.map", "grazing.map"};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        sl_map map;
        sl_space space;
        sli_split *splits;
        read_space(context, paths[i], NULL, &map, &space);
        assert_ok(context, sli_splits_make(context, &space, &splits));
        check_splits(&space, splits);
        sl_free(context, splits);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

static void walls_cover_splits(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    sli_split *splits;
    // The one split is x = 2, of which a wall covers a quarter.
    testing_space(context, "walls 0 0 4 0 4 4 0 4 0 0\nwall 2 1 2 2\n", &map, &space);
    assert_ok(context, sli_splits_make(context, &space, &splits));
    assert_int_equal(space.node_count, 1);
    assert_true(sli_splits_covered(splits, &space, 0) == 0.25);
    assert_true(splits->along.a.x == 2 && splits->along.b.x == 2);
    assert_true(splits->along.a.y == 0 && splits->along.b.y == 4);
    sl_free(context, splits);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

// --- a mesh

static sl_point start_of(const sli_mesh_steps *steps, uint32_t half) {
    return steps->triangles.points.items[steps->triangles.halves.items[half].from];
}

static bool is_portal(const sl_space *space, sl_point a, sl_point b) {
    for (uint32_t i = 0; i < space->portal_count; i++) {
        const sl_portal *p = &space->portals[i];
        if ((p->left.x == a.x && p->left.y == a.y && p->right.x == b.x && p->right.y == b.y) ||
            (p->left.x == b.x && p->left.y == b.y && p->right.x == a.x && p->right.y == a.y))
            return true;
    }
    return false;
}

/// Corners of the cell at the left of a half-edge, of which none turns right.
static uint32_t count_corners(const sli_mesh_steps *steps, size_t place, uint32_t half) {
    uint32_t count = 0, at = half;
    do {
        const uint32_t next = sli_mesh_steps_next(steps, place, at);
        const uint32_t after = sli_mesh_steps_next(steps, place, next);
        assert_true(
            sli_orient(start_of(steps, at), start_of(steps, next), start_of(steps, after)) >= 0);
        at = next;
        count++;
    } while (at != half);
    return count;
}

/// Sides are tried the longest first; one that stays is a portal, and its corner is not convex
/// without it; one that is taken out leaves a convex cell.
static void check_sides(const sl_space *space, const sli_mesh_steps *steps) {
    double last = INFINITY;
    for (size_t i = 0; i < steps->sides.count; i++) {
        const sli_mesh_side *side = &steps->sides.items[i];
        const sl_point a = start_of(steps, side->half), b = start_of(steps, side->half ^ 1);
        const double length = hypot(b.x - a.x, b.y - a.y);
        assert_true(length <= last);
        last = length;
        if (side->stuck == SLI_OUTSIDE) {
            const uint32_t next = sli_mesh_steps_next(steps, i, side->half);
            const uint32_t both =
                count_corners(steps, i, side->half) + count_corners(steps, i, side->half ^ 1);
            assert_int_equal(count_corners(steps, i + 1, next), both - 2);
            assert_int_equal(steps->taken[side->half / 2], i);
            continue;
        }
        sl_point corner[3];
        sli_mesh_steps_corner(steps, i, corner);
        assert_true(sli_orient(corner[0], corner[1], corner[2]) <= 0);
        assert_true((corner[1].x == a.x && corner[1].y == a.y) ||
                    (corner[1].x == b.x && corner[1].y == b.y));
        assert_int_equal(steps->taken[side->half / 2], SLI_MESH_STAYS);
        assert_true(is_portal(space, a, b));
    }
}

/// At last the cells are those of the space.
static void check_cells(const sl_space *space, const sli_mesh_steps *steps) {
    const size_t halves = steps->triangles.halves.count;
    uint32_t cells = 0, corners = 0;
    bool *known = calloc(halves, sizeof *known);
    assert_non_null(known);
    for (uint32_t half = 0; half < halves; half++) {
        if (known[half] || sli_half_is_outside(&steps->triangles, half) ||
            steps->taken[half / 2] != SLI_MESH_STAYS)
            continue;
        corners += count_corners(steps, steps->sides.count, half);
        cells++;
        for (uint32_t at = half; !known[at];
             at = sli_mesh_steps_next(steps, steps->sides.count, at))
            known[at] = true;
    }
    free(known);
    assert_int_equal(cells, space->cell_count);
    assert_int_equal(corners, space->vertex_count);
}

/// Both triangulations have the same points and as many edges, and new ones for those that are
/// gone.
static void check_fresh(const sli_mesh_steps *steps) {
    const sli_triangulation *t = &steps->triangles, *before = &steps->delaunay;
    assert_int_equal(t->points.count, before->points.count);
    assert_int_equal(t->halves.count, before->halves.count);
    for (size_t i = 0; i < t->halves.count / 2; i++) {
        const uint32_t a = t->halves.items[2 * i].from, b = t->halves.items[2 * i + 1].from;
        bool found = false;
        for (size_t k = 0; k < before->halves.count && !found; k++)
            found = before->halves.items[k].from == a && before->halves.items[k ^ 1].from == b;
        assert_int_equal(steps->fresh[i], !found);
    }
}

static void steps_lead_to_the_mesh(void **state) {
    (void)state;
    const char *const paths[] = {"oblique/rotunda.map", "oblique/chapel.map", "oblique/star.map",
                                 "effects/doors.map",   "effects/oneway.map", "office.map"};
    sl_context *context = testing_context(NULL);
    size_t fresh = 0;
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        sl_map map;
        sl_space space;
        sli_mesh_steps steps;
        read_space(context, paths[i], "mesh", &map, &space);
        assert_ok(context, sli_mesh_steps_record(context, &space, &steps));
        check_sides(&space, &steps);
        check_cells(&space, &steps);
        check_fresh(&steps);
        for (size_t k = 0; k < steps.triangles.halves.count / 2; k++) fresh += steps.fresh[k];
        sli_mesh_steps_destroy(context, &steps);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    assert_true(fresh > 0);
    sl_context_destroy(context);
}

static void steps_come_to_an_end_without_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    sl_space space;
    testing_space(context, "walls 0 0 4 0 4 4 1 5 0 0\nwall 2 1 2.5 2\nseam 0 0 2 1\n", &map,
                  &space);
    const long live = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long i = 1; status != SL_OK; i++) {
        sli_mesh_steps steps = {0};
        memory.fail_at = memory.calls + i;
        status = sli_mesh_steps_record(context, &space, &steps);
        memory.fail_at = 0;
        assert_true(status == SL_OK ? i > 10 : status == SL_NO_MEMORY && i < 1000);
        sli_mesh_steps_destroy(context, &steps);
        assert_int_equal(memory.live, live);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walls_choose_the_subdivision),
        cmocka_unit_test(boxes_fill_the_bounds),
        cmocka_unit_test(walls_cover_splits),
        cmocka_unit_test(steps_lead_to_the_mesh),
        cmocka_unit_test(steps_come_to_an_end_without_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
