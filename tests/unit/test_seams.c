/// Seams: cells do not run over them, portals know them, walls win, and files keep them.
#include "testing.h"

#include "oracle/random_oblique.h"
#include "sightline/support.h"
#include "space/subdivide.h"

#include <math.h>

enum { SIZE = 8, MAPS = 2000 };

static void add_seam(sl_context *context, sl_map *map, int kind, sl_segment at) {
    char name[16];
    snprintf(name, sizeof name, "door%zu", map->door_count);
    if (kind == SL_SEAM_DOOR)
        assert_ok(context, sl_map_add_door(context, map, name, at, true, 0));
    else if (kind == SL_SEAM_ONEWAY)
        assert_ok(context, sl_map_add_oneway(context, map, at, 0));
    else
        assert_ok(context, sl_map_add_seam(context, map, at, 0));
}

static double draw_place(sl_random *random) {
    return (double)sl_random_below(random, SIZE + 1);
}

static sl_segment draw_segment(sl_random *random, bool axial) {
    for (;;) {
        const sl_point a = {draw_place(random), draw_place(random)};
        sl_point b = {draw_place(random), draw_place(random)};
        if (axial && sl_random_below(random, 2))
            b.x = a.x;
        else if (axial)
            b.y = a.y;
        if (a.x != b.x || a.y != b.y) return (sl_segment){a, b};
    }
}

static void draw_map(sl_context *context, sl_random *random, bool axial, sl_map *map) {
    const sl_point corners[5] = {{0, 0}, {SIZE, 0}, {SIZE, SIZE}, {0, SIZE}, {0, 0}};
    for (int i = 0; i < 4; i++)
        assert_ok(context, sl_map_add_wall(context, map, corners[i], corners[i + 1], 0));
    for (uint32_t i = (uint32_t)sl_random_below(random, 6); i > 0; i--) {
        const sl_segment at = draw_segment(random, axial);
        assert_ok(context, sl_map_add_wall(context, map, at.a, at.b, 0));
    }
    for (uint32_t i = 1 + (uint32_t)sl_random_below(random, 7); i > 0; i--)
        add_seam(context, map, (int)sl_random_below(random, 3), draw_segment(random, axial));
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
}

static double cross(sl_point a, sl_point b, sl_point p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Coordinates are small multiples of a quarter: the arithmetic is exact.
static bool is_on(sl_point a, sl_point b, sl_point p) {
    return cross(a, b, p) == 0 && (p.x - a.x) * (p.x - b.x) + (p.y - a.y) * (p.y - b.y) <= 0;
}

static bool is_walled(const sl_space *space, sl_point p) {
    for (uint32_t i = 0; i < space->wall_count; i++)
        if (is_on(space->walls[i].a, space->walls[i].b, p)) return true;
    return false;
}

/// What the space tells of the seams at a point of a portal must be what lies there.
static void check_portal(const sl_space *space, uint32_t number, sl_point p) {
    const sl_portal *portal = &space->portals[number];
    size_t count, found = 0;
    const sl_seam_portal *told = sl_space_seams_of(space, number, &count);
    for (uint32_t i = 0; i < space->seam_count; i++) {
        const sl_segment at = space->seams[i].at;
        if (!is_on(at.a, at.b, p)) continue;
        assert_true(found < count);
        assert_int_equal(told[found].seam, i);
        const uint32_t neighbour = portal->cell[1];
        const sl_cell *cell = &space->cells[neighbour];
        double side = 0;
        for (uint32_t k = 0; k < cell->vertex_count; k++)
            side += cross(at.a, at.b, space->vertices[cell->first_vertex + k]);
        assert_int_equal(told[found].forward, side > 0);
        found++;
    }
    assert_int_equal(found, count);
}

static void check_portals(const sl_space *space) {
    for (uint32_t i = 0; i < space->portal_count; i++) {
        const sl_point l = space->portals[i].left, r = space->portals[i].right;
        const double length = fabs(l.x - r.x) + fabs(l.y - r.y);
        for (double at = 0.25; at < length; at += 0.5)
            check_portal(
                space, i,
                (sl_point){l.x + (r.x - l.x) / length * at, l.y + (r.y - l.y) / length * at});
    }
}

/// No piece of a seam is inside a cell: each is on a portal, on a wall, or on the border.
static void check_seams(const sl_space *space) {
    for (uint32_t i = 0; i < space->seam_count; i++) {
        const sl_point a = space->seams[i].at.a, b = space->seams[i].at.b;
        const double length = fabs(a.x - b.x) + fabs(a.y - b.y);
        for (double at = 0.25; at < length; at += 0.5) {
            const sl_point p = {a.x + (b.x - a.x) / length * at, a.y + (b.y - a.y) / length * at};
            bool covered =
                is_walled(space, p) || p.x == 0 || p.y == 0 || p.x == SIZE || p.y == SIZE;
            for (uint32_t k = 0; k < space->portal_count && !covered; k++)
                covered = is_on(space->portals[k].left, space->portals[k].right, p);
            assert_true(covered);
        }
    }
}

static void axial_seams(void **state) {
    (void)state;
    sl_random random = {9};
    for (int i = 0; i < MAPS; i++) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        draw_map(context, &random, true, &map);
        const sl_subdivide_options kd = sl_subdivide_options_default();
        for (int which = 0; which < 2; which++) {
            sl_space space = {0};
            if (which)
                assert_ok(context, sli_subdivide_mesh(context, &map, &space));
            else
                assert_ok(context, sli_subdivide_kd(context, &map, &kd, &space));
            assert_ok(context, sl_space_check(context, &space));
            if (!which) check_portals(&space);
            check_seams(&space);
            sl_space_destroy(context, &space);
        }
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

static bool same_ends(sl_point a, sl_point b, sl_point p, sl_point q) {
    return (testing_same_point(a, p) && testing_same_point(b, q)) ||
           (testing_same_point(a, q) && testing_same_point(b, p));
}

/// Each part of a seam is one portal, or one wall, or on the border.
static void check_parts(const sl_space *space) {
    const sl_box *b = &space->bounds;
    for (uint32_t i = 0; i < space->seam_count; i++) {
        const sl_segment at = space->seams[i].at;
        uint32_t portals = 0, walls = 0;
        for (uint32_t k = 0; k < space->seam_portal_count; k++) {
            if (space->seam_portals[k].seam != i) continue;
            const sl_portal *p = &space->portals[space->seam_portals[k].portal];
            assert_true(same_ends(at.a, at.b, p->left, p->right));
            assert_int_equal(space->seam_portals[k].forward, testing_same_point(p->left, at.a));
            portals++;
        }
        for (uint32_t k = 0; k < space->wall_count; k++)
            walls += same_ends(at.a, at.b, space->walls[k].a, space->walls[k].b);
        const bool on_border = (at.a.x == at.b.x && (at.a.x == b->min.x || at.a.x == b->max.x)) ||
                               (at.a.y == at.b.y && (at.a.y == b->min.y || at.a.y == b->max.y));
        assert_int_equal(portals + walls, on_border && !walls ? 0 : 1);
    }
}

static void oblique_seams(void **state) {
    (void)state;
    sl_random random = {10};
    for (int i = 0; i < MAPS; i++) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        sl_space space = {0};
        draw_map(context, &random, false, &map);
        assert_ok(context, sli_subdivide_mesh(context, &map, &space));
        assert_ok(context, sl_space_check(context, &space));
        check_parts(&space);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// Seams that cross walls, and each other far out, where their crossing is rounded.
static void seams_cross_walls(void **state) {
    (void)state;
    const char *const texts[] = {
        "wall -385 -87 226 807\nwall 12 440 687 -283\ndoor c -504 -689 686 686\n",
        "wall -1429 -1477 -163 911\nwall -718 -165 45 749\nseam -608 674 809 -464\n",
        "wall -258 -103 -89 1079\nwall -381 -165 135 -8\noneway 434 377 -890 283\n",
        // And along portals.
        "wall -870 -578 371 -188\nwall -192 -805 237 -379\ndoor a -860 384 822 -522\n"
        "wall -930 243 -192 -805\nwall -849 -158 -762 -958\n",
        // Rounding does not tell on which side of the first seam the wall's line ends.
        "wall -6112.532291908161 9.681701803967338e-09 0.20824478413557296 -6.146394399213277\n"
        "seam -11212888958542.9 11274621841.232483 0.20824478413557296 -6.146394399213277\n"
        "seam 0.20824478413557296 -6.146394399213277 4.2592984694778124e-11 390703513526.3247\n",
    };
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        sl_map map = {0};
        sl_space space;
        testing_space(context, texts[i], &map, &space);
        assert_ok(context, sl_space_check(context, &space));
        check_parts(&space);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    const uint64_t seeds = testing_seeds(600);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_map map = {0};
        sl_space space;
        sl_random random = {seed};
        assert_ok(context, oblique_random_map(context, seed, OBLIQUE_DOOM, 6, &map));
        for (int kind = 0; kind < 3; kind++) {
            double at[4];
            for (int k = 0; k < 4; k++) at[k] = oblique_coordinate(&random, OBLIQUE_DOOM);
            if (at[0] != at[2] || at[1] != at[3])
                add_seam(context, &map, kind, (sl_segment){{at[0], at[1]}, {at[2], at[3]}});
        }
        assert_ok(context, sli_subdivide_mesh(context, &map, &space));
        assert_ok(context, sl_space_check(context, &space));
        check_parts(&space);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

static void a_door_between_rooms_is_one_portal(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    testing_space(context,
                  "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n"
                  "door front 10 2 10 8\noneway 10 5 10 6\n",
                  &map, &space);
    assert_int_equal(space.cell_count, 2);
    assert_int_equal(space.portal_count, 2);
    assert_int_equal(space.seam_portal_count, 3);
    size_t count;
    const sl_seam_portal *upper = sl_space_seams_of(&space, 1, &count);
    assert_int_equal(count, 2);
    assert_int_equal(space.seams[upper[0].seam].kind, SL_SEAM_DOOR);
    assert_int_equal(space.seams[upper[1].seam].kind, SL_SEAM_ONEWAY);
    // Going up, the glass is seen through from its right, at the higher x, to its left.
    assert_int_equal(upper[1].forward, 0);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void the_kd_tree_names_an_oblique_door(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    const sl_subdivide_options options = sl_subdivide_options_default();
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){0, 0}, (sl_point){4, 0}, 1));
    assert_ok(context, sl_map_add_door(context, &map, "a", (sl_segment){{0, 0}, {3, 3}}, true, 7));
    assert_int_equal(sli_subdivide_kd(context, &map, &options, &space), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), "the map:7: the door from 0 0 to 3 3"));
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void wrong_seams_are_found(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_subdivide_options kd = sl_subdivide_options_default();
    for (int fault = 0; fault < 12; fault++) {
        sl_map map = {0};
        sl_space space;
        testing_space(context,
                      "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n"
                      "door front 10 4 10 6\nseam 3 0 3 10\n",
                      &map, &space);
        if (fault % 2) {
            sl_space_destroy(context, &space);
            assert_ok(context, sli_subdivide_mesh(context, &map, &space));
        } else {
            sl_space_destroy(context, &space);
            assert_ok(context, sli_subdivide_kd(context, &map, &kd, &space));
        }
        assert_ok(context, sl_space_check(context, &space));
        switch (fault / 2) {
        case 0:
            space.seams[0].kind = SL_SEAM_LIMITED + 1;
            break;
        case 1:
            space.seams[1].at = (sl_segment){{5, 1}, {5, 9}}; // inside a cell
            break;
        case 2:
            space.seam_portals[0].forward ^= 1;
            break;
        case 3:
            space.seam_portals[1].seam ^= 1;
            break;
        case 4:
            space.seam_portals[1].portal = space.portal_count;
            break;
        default:
            space.seams[0].at.b.y = NAN;
        }
        assert_int_equal(sl_space_check(context, &space), SL_BAD_INPUT);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axial_seams),
        cmocka_unit_test(oblique_seams),
        cmocka_unit_test(seams_cross_walls),
        cmocka_unit_test(a_door_between_rooms_is_one_portal),
        cmocka_unit_test(the_kd_tree_names_an_oblique_door),
        cmocka_unit_test(wrong_seams_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
