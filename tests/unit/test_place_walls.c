// Walls to scan against points close together along all walls, each asked of sl_query_sees, angles
// and distances; and against all subsets of the places.
#include "place_scene.h"

/// Between points along walls; how far they are off the wall; and how far beside a point the same
/// must hold, else it is not decided.
#define STEP   0.004
#define OFF    1e-9
#define BESIDE 1e-6

typedef struct samples {
    SL_ARRAY(uint32_t) seers; ///< by point, a bit for each place that scans it
    SL_ARRAY(uint32_t) more;  ///< the same of points between those where it changes
    double length;            ///< of all walls
} samples;

/// Whether a place scans a point just off a side of a wall; from that side, as glass lets others
/// see it.
static bool scans(scene *s, const sl_viewpoint *p, const sl_wall *wall, double side, sl_point at,
                  bool *near) {
    bool is_seen;
    if (sl_orient(wall->a, wall->b, p->at) * side < 0) return false;
    const sl_point way = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
    const double x = at.x - p->at.x, y = at.y - p->at.y, distance = hypot(x, y);
    const double sine = fabs(way.x * y - way.y * x) / (hypot(way.x, way.y) * distance);
    const double off = fabs(remainder(atan2(y, x) - p->heading * DEGREE, 360 * DEGREE));
    const double least = s->area.scan_angle * DEGREE, angle = asin(fmin(1, sine));
    double range = p->range;
    if (s->area.scan_range > 0)
        range = range > 0 ? fmin(range, s->area.scan_range) : s->area.scan_range;
    *near |= fabs(distance - range) < BESIDE || fabs(distance - p->nearest) < BESIDE ||
             fabs(angle - least) < BESIDE || sine < BESIDE;
    *near |= p->fov < 360 && fabs(off - p->fov * DEGREE / 2) < BESIDE;
    assert_ok(s->context, sl_query_sees(s->context, s->query, p->at, at, &is_seen));
    return is_seen && distance >= p->nearest && (!(range > 0) || distance <= range) &&
           angle >= least && (p->fov >= 360 || off <= p->fov * DEGREE / 2);
}

/// A point of a side of a wall. False where this is not inside, or what scans it is not decided.
static bool look(scene *s, const sl_wall *wall, double share, double side, uint32_t *seers) {
    const sl_point way = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
    const double length = hypot(way.x, way.y);
    uint32_t sets[3] = {0};
    bool near = false;
    for (int k = 0; k < 3; k++) {
        const double at = share + (k - 1) * BESIDE / length;
        const sl_point p = {wall->a.x + at * way.x - side * OFF * way.y,
                            wall->a.y + at * way.y + side * OFF * way.x};
        if (!sl_space_is_inside(&s->space, p)) return false;
        for (int i = 0; i < PLACES; i++)
            sets[k] |= (uint32_t)scans(s, &s->places[i], wall, side, p, &near) << i;
    }
    *seers = sets[1];
    return !near && sets[0] == sets[1] && sets[1] == sets[2];
}

/// More points between two that other places scan, up to close to each other.
static void look_between(scene *s, const sl_wall *wall, double side, const double share[2],
                         const uint32_t seers[2], samples *all) {
    const double middle = (share[0] + share[1]) / 2;
    uint32_t more;
    if (seers[0] == seers[1] || share[1] - share[0] < BESIDE) return;
    if (!look(s, wall, middle, side, &more)) return;
    assert_ok(s->context, SL_ARRAY_ROOM(s->context, &all->more, 1));
    all->more.items[all->more.count++] = more;
    look_between(s, wall, side, (double[]){share[0], middle}, (uint32_t[]){seers[0], more}, all);
    look_between(s, wall, side, (double[]){middle, share[1]}, (uint32_t[]){more, seers[1]}, all);
}

static void sample_side(scene *s, const sl_wall *wall, double side, samples *all) {
    const double length = hypot(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
    double before = -1;
    for (double at = STEP / 2; at < length; at += STEP) {
        uint32_t seers;
        const double share = at / length;
        if (!look(s, wall, share, side, &seers)) continue;
        if (before > 0)
            look_between(s, wall, side, (double[]){before, share},
                         (uint32_t[]){all->seers.items[all->seers.count - 1], seers}, all);
        before = share;
        assert_ok(s->context, SL_ARRAY_ROOM(s->context, &all->seers, 1));
        all->seers.items[all->seers.count++] = seers;
    }
}

/// One-way glass is a wall to its left alone; such walls come after those of the map.
static samples sample_walls(scene *s) {
    samples all = {0};
    const sl_space *space;
    assert_ok(s->context, sl_query_space(s->context, s->query, &space, NULL));
    for (uint32_t w = 0; w < space->wall_count; w++) {
        if (w < s->space.wall_count) sample_side(s, &space->walls[w], -1, &all);
        sample_side(s, &space->walls[w], 1, &all);
    }
    all.length = (double)all.seers.count * STEP;
    return all;
}

static void samples_destroy(scene *s, samples *all) {
    sl_free(s->context, all->seers.items);
    sl_free(s->context, all->more.items);
}

/// Whether a set scans each point as often as asked, or as all places do.
static bool does(const scene *s, const samples *all, uint32_t set) {
    const uint32_t cover = s->area.cover ? s->area.cover : 1;
    for (size_t i = 0; i < all->seers.count + all->more.count; i++) {
        const uint32_t seers =
            i < all->seers.count ? all->seers.items[i] : all->more.items[i - all->seers.count];
        const uint32_t most = bits_in(seers);
        if (bits_in(seers & set) < (most < cover ? most : cover)) return false;
    }
    return true;
}

static double seen_by(const samples *all, uint32_t set) {
    size_t count = 0;
    for (size_t i = 0; i < all->seers.count; i++) count += (all->seers.items[i] & set) != 0;
    return (double)count * STEP;
}

static const sl_viewpoint kinds[] = {{.fov = 360},
                                     {.fov = 130},
                                     {.fov = 360, .range = 5},
                                     {.fov = 360, .nearest = 1.5},
                                     {.fov = 200, .range = 6, .nearest = 0.5}};

/// `k` is the number of the scene.
static void begin_scan(scene *s, unsigned k, sl_viewpoint like) {
    sl_random random = {k};
    begin(s, k % 2 ? TURNED : PLAN, 700 + k, like);
    for (int i = 1; i < PLACES; i += 2) s->places[i].at = draw(s, &random);
    s->area.scan_angle = k % 3 ? 10 + 5 * (k % 7) : 0;
    s->area.scan_range = k % 3 == 1 ? 0 : 4 + k % 5;
}

static void test_fewest(void **state) {
    (void)state;
    for (unsigned k = 0; k < 10; k++) {
        scene s;
        begin_scan(&s, k, kinds[k / 2]);
        if (k % 4 == 1) s.area.costs = s.costs;
        if (k % 5 == 2) s.area.cover = 2;
        samples all = sample_walls(&s);
        sl_area_placement placed = place(&s);
        assert_int_equal(placed.lower, placed.upper);
        assert_true(does(&s, &all, set_of(&placed)));
        for (uint32_t set = 0; set < 1u << PLACES; set++)
            if (cost_of(&s, set) < placed.lower) assert_false(does(&s, &all, set));
        if (k % 2 == 0) assert_true(fabs(placed.area - 64) < 1e-9);
        assert_true(fabs(placed.area - all.length) < 0.01 * all.length);
        if (!s.area.cover) assert_true(fabs(placed.seen - seen_by(&all, ~0u)) < 0.01 * all.length);
        assert_true(fabs(placed.seen + placed.blind_area - placed.area) < 1e-9);
        double blind = 0;
        for (uint32_t i = 0; i < placed.blind_count; i++) blind += placed.blind[i].area;
        assert_true(fabs(blind - placed.blind_area) < 1e-9);
        samples_destroy(&s, &all);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

static void test_most(void **state) {
    (void)state;
    for (unsigned k = 0; k < 4; k++) {
        scene s;
        begin_scan(&s, 20 + k, kinds[k]);
        s.area.count = 1 + k % 3;
        samples all = sample_walls(&s);
        sl_area_placement placed = place(&s);
        const double off = 0.01 * all.length;
        assert_int_equal(placed.count, s.area.count);
        assert_true(fabs(placed.seen - seen_by(&all, set_of(&placed))) < off);
        for (uint32_t set = 0; set < 1u << PLACES; set++)
            if (bits_in(set) == s.area.count)
                assert_true(seen_by(&all, set) < placed.seen_most + off);
        samples_destroy(&s, &all);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

/// Walls in a zone alone; its outline runs along walls and crosses others. A thin wall has two
/// sides.
static void test_zone(void **state) {
    (void)state;
    const sl_point corners[] = {{5, 0}, {12, 0}, {12, 7}, {5, 7}};
    const size_t count = 4;
    const sl_shape zone = {corners, &count, 1};
    scene s;
    begin(&s, PLAN, 9, (sl_viewpoint){.fov = 360});
    s.area.see = &zone;
    s.area.scan_angle = 5;
    sl_area_placement placed = place(&s);
    // The lower wall, the right one, the solid's right side and the pillar, the wall to y = 7.
    assert_true(fabs(placed.area - (7 + 7 + 2 + 10 + 4)) < 1e-9);
    sl_area_placement_destroy(s.context, &placed);
    end(&s);
}

/// A range that touches a wall in one point, or misses it by less than rounding, sees nothing of it
/// for sure; far from the origin, too. (Places at random are drawn from a room near it.)
static void test_touching(void **state) {
    (void)state;
    for (int k = 0; k < 4; k++) {
        char plan[200];
        const double far = k % 2 ? 1e6 : 20;
        snprintf(plan, sizeof plan, "open 0 0 1 0 1 1 0 1\nopen %.17g 0 %.17g 0 %.17g 8 %.17g 8\n",
                 far, far + 8, far + 8, far);
        scene s;
        begin(&s, plan, 1, (sl_viewpoint){.fov = 360});
        for (int i = 0; i < PLACES; i++) s.places[i].at = (sl_point){far + 4, 2};
        s.area.scan_range = k < 2 ? 2 : 2 + 1e-15;
        s.area.scan_angle = 1;
        sl_area_placement placed = {0};
        const sl_status status = sl_place_area_cover(s.context, s.query, &s.area, NULL, &placed);
        if (status != SL_OK)
            assert_non_null(strstr(sl_context_message(s.context), "none of the 10 places"));
        else
            assert_true(placed.seen < 1e-5);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

static void test_refusals(void **state) {
    (void)state;
    const sl_point corners[] = {{0.5, 0.5}, {1, 0.5}, {1, 1}};
    const size_t count = 3;
    const sl_shape zone = {corners, &count, 1};
    scene s;
    begin(&s, PLAN, 5, (sl_viewpoint){.fov = 360});
    s.area.scan_angle = 90;
    assert_refused(&s, "0 to less than 90 degrees");
    s.area.scan_angle = 0;
    s.area.scan_range = -1;
    assert_refused(&s, "0 or more");
    s.area.scan_range = 1e-3;
    assert_refused(&s, "sees any wall so");
    s.area.see = &zone;
    assert_refused(&s, "no wall is to be seen");
    end(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fewest),   cmocka_unit_test(test_most),
        cmocka_unit_test(test_zone),     cmocka_unit_test(test_touching),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
