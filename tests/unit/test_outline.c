/// The outline's rooms on random maps: convex, without a corner that no wall ends at, covering the
/// bounds once; and the room of a point.
#include "space/outline.h"
#include "testing.h"

#include "geometry/orient.h"
#include "oracle/random_map.h"
#include "sightline/generate.h"
#include "space/subdivide.h"

#include <math.h>

static bool is_wall_end_or_bounds_corner(const sl_space *space, sl_point p) {
    const sl_box *b = &space->bounds;
    if ((p.x == b->min.x || p.x == b->max.x) && (p.y == b->min.y || p.y == b->max.y)) return true;
    for (uint32_t i = 0; i < space->wall_count; i++)
        if (testing_same_point(space->walls[i].a, p) || testing_same_point(space->walls[i].b, p))
            return true;
    return false;
}

/// Twice the area of a room; fails where it is not convex.
static double check_room(const sl_outline *o, uint32_t room, uint64_t seed) {
    const sl_point origin = o->sides[o->first[room]].start;
    double twice = 0;
    for (uint32_t i = o->first[room]; i < o->first[room + 1]; i++) {
        const sl_side *s = &o->sides[i], *next = &o->sides[s->next];
        const sl_point a = s->start, b = next->start, c = o->sides[next->next].start;
        if (s->next != (i + 1 < o->first[room + 1] ? i + 1 : o->first[room]))
            fail_msg("seed %llu: side %u is not followed by the next", (unsigned long long)seed, i);
        if (testing_same_point(a, b) || sli_orient(a, b, c) < 0)
            fail_msg("seed %llu: room %u is not convex", (unsigned long long)seed, room);
        if (!is_wall_end_or_bounds_corner(o->space, a))
            fail_msg("seed %llu: a corner of room %u at %g %g is no wall's end",
                     (unsigned long long)seed, room, a.x, a.y);
        if (sl_side_is_portal(s)) {
            const sl_side *other = &o->sides[s->neighbour];
            assert_int_equal(other->neighbour, i);
            assert_true(testing_same_point(other->start, b) &&
                        testing_same_point(o->sides[other->next].start, a));
        }
        twice += (a.x - origin.x) * (b.y - origin.y) - (a.y - origin.y) * (b.x - origin.x);
    }
    return twice;
}

static void check_point(const sl_outline *o, sl_point point, uint64_t seed) {
    const uint32_t room = sl_outline_room(o, sl_space_locate(o->space, point), point);
    assert_true(room < o->room_count);
    for (uint32_t i = o->first[room]; i < o->first[room + 1]; i++)
        if (sli_orient(o->sides[i].start, o->sides[o->sides[i].next].start, point) < 0)
            fail_msg("seed %llu: %.17g %.17g is not in room %u", (unsigned long long)seed, point.x,
                     point.y, room);
}

static void check_outline(const sl_outline *o, uint64_t seed) {
    const sl_space *space = o->space;
    const sl_box *b = &space->bounds;
    const double width = b->max.x - b->min.x, height = b->max.y - b->min.y;
    double twice = 0;
    for (uint32_t room = 0; room < o->room_count; room++) twice += check_room(o, room, seed);
    assert_true(fabs(twice / 2 - width * height) <= 1e-9 * width * height);
    sl_random random = {seed};
    for (int i = 0; i < 20; i++)
        check_point(o,
                    (sl_point){b->min.x + sl_random_unit(&random) * width,
                               b->min.y + sl_random_unit(&random) * height},
                    seed);
    for (uint32_t i = 0; i < space->vertex_count; i++) check_point(o, space->vertices[i], seed);
}

static void rooms_of_random_maps(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= 150; seed++) {
        sl_map map = {0};
        sl_space space = {0};
        sl_outline outline = {0};
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &map));
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        if (map.wall_count) {
            const sl_subdivide_options options = sl_subdivide_options_default();
            assert_ok(context, sli_subdivide_kd(context, &map, &options, &space));
            assert_ok(context, sli_outline_make(context, &space, &outline));
            check_outline(&outline, seed);
        }
        sli_outline_destroy(context, &outline);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

/// The cells of a mesh are its rooms.
static void rooms_of_turned_maps(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t kind_count;
    const sl_map_kind *kinds = sl_map_kinds(&kind_count);
    for (size_t n = 0; n < 2 * kind_count; n++) {
        const size_t k = n / 2;
        sl_map map = {0};
        sl_space space = {0};
        sl_outline outline = {0};
        sl_generate_options how = sl_generate_options_default();
        how.walls = 300;
        how.turned = 17;
        how.in_line = n % 2;
        assert_ok(context, sl_generate(context, &kinds[k], &how, &map));
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        assert_ok(context, sli_subdivide_mesh(context, &map, &space));
        assert_ok(context, sli_outline_make(context, &space, &outline));
        assert_int_equal(outline.room_count, space.cell_count);
        check_outline(&outline, k);
        sli_outline_destroy(context, &outline);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rooms_of_random_maps),
        cmocka_unit_test(rooms_of_turned_maps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
