// Placement: gaps that chosen places leave are closed, where what sees them is hard to find; and
// what is chosen for them makes others redundant.
#include "testing.h"

#include "analysis/placement/placer.h"

typedef struct outline {
    const sl_point *corners;
    size_t count;
} outline;

/// A plan, and a placer for it.
typedef struct plan {
    testing_memory memory; ///< first: hooks get this alone
    bool over;             ///< cancelled
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
    sl_placement out;
    sl_place_options options;
    sli_placer placer;
} plan;

/// A point after quarter turns.
static sl_point turned(sl_point p, int quarters) {
    for (; quarters; quarters--) p = (sl_point){-p.y, p.x};
    return p;
}

static bool is_over(void *user) {
    return ((const plan *)user)->over;
}

static void begin(plan *p, const outline *outlines, size_t count, int quarters) {
    *p = (plan){.options = sl_place_options_default(), .out.count = UINT32_MAX};
    const sl_hooks hooks = {.user = &p->memory, .resize = testing_resize, .cancelled = is_over};
    p->context = sl_context_create(&hooks);
    assert_non_null(p->context);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < outlines[i].count; k++)
            assert_ok(p->context,
                      sl_map_add_wall(
                          p->context, &p->map, turned(outlines[i].corners[k], quarters),
                          turned(outlines[i].corners[(k + 1) % outlines[i].count], quarters), 0));
    testing_subdivide(p->context, &p->map, &p->space);
    assert_ok(p->context, sl_query_over(p->context, &p->space, &p->map, NULL, &p->query));
    p->placer = (sli_placer){
        .context = p->context, .query = p->query, .options = &p->options, .out = &p->out};
    assert_ok(p->context, sli_ground_make(p->context, &p->space, &p->map, &p->placer.ground));
}

static void end(plan *p) {
    sli_placer_destroy(&p->placer);
    sl_query_destroy(p->context, p->query);
    sl_space_destroy(p->context, &p->space);
    sl_map_destroy(p->context, &p->map);
    sl_context_destroy(p->context);
    assert_int_equal(p->memory.live, 0);
}

static void choose(plan *p, sl_point at) {
    uint32_t number;
    assert_ok(p->context, sli_add_candidate(&p->placer, at, &number));
    assert_int_not_equal(number, UINT32_MAX);
    assert_ok(p->context, sli_choose(&p->placer, number));
}

static size_t count_gaps(plan *p) {
    sli_placer *placer = &p->placer;
    const sli_look *looks[64];
    assert_in_range(placer->chosen.count, 1, 64);
    for (size_t i = 0; i < placer->chosen.count; i++) looks[i] = sli_chosen_look(placer, i);
    assert_ok(p->context,
              sli_gaps_find(p->context, &placer->ground, looks, (uint32_t)placer->chosen.count,
                            &placer->chosen_bounds, 0, &placer->gaps));
    return placer->gaps.count;
}

/// The apex of a gap is a corner of a closed room, too. Who stands there looks into the hall, or
/// into the room: by turns of the plan, each of them.
///
///      +---------+-----------+
///      |  eye .  |           |
///      |        .|  room     |      The window of the eye leads past the corner a. What is below
///      |         a-----------+      the room is beyond it.
///      |           .         |
///      |   beyond     .      |
///      +---------------------+
static void apex_between_rooms(void **state) {
    (void)state;
    static const sl_point hall[] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    static const sl_point room[] = {{4, 4}, {10, 4}, {10, 10}, {4, 10}};
    const outline outlines[] = {{hall, 4}, {room, 4}};
    for (int quarters = 0; quarters < 4; quarters++) {
        plan p;
        bool more = true, closed;
        begin(&p, outlines, 2, quarters);
        choose(&p, turned((sl_point){1, 9}, quarters));
        assert_int_not_equal(count_gaps(&p), 0);
        while (more && count_gaps(&p))
            assert_ok(p.context, sli_choose_for_gaps(&p.placer, &more, &closed));
        assert_int_equal(count_gaps(&p), 0);
        end(&p);
    }
}

/// Places that others make redundant are dropped, but not all that see the same.
static void redundant_places(void **state) {
    (void)state;
    static const sl_point hall[] = {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};
    static const sl_point eyes[] = {{1, 9}, {9, 1}, {2, 2}, {3, 3}};
    const outline outlines[] = {{hall, 6}};
    plan p;
    bool dropped;
    begin(&p, outlines, 1, 0);
    assert_ok(p.context, sli_add_first_witnesses(&p.placer));
    for (int i = 0; i < 4; i++) choose(&p, eyes[i]);
    assert_ok(p.context, sli_drop_redundant(&p.placer, &dropped));
    assert_true(dropped);
    assert_int_equal(p.placer.chosen.count, 1);
    assert_int_equal(count_gaps(&p), 0);
    assert_ok(p.context, sli_drop_redundant(&p.placer, &dropped));
    assert_false(dropped);
    assert_int_equal(p.placer.chosen.count, 1);
    end(&p);
}

/// A large map has many gaps: what is done for them ends when it is cancelled.
static void gaps_are_cancelled(void **state) {
    (void)state;
    static const sl_point hall[] = {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};
    const outline outlines[] = {{hall, 6}};
    plan p;
    begin(&p, outlines, 1, 0);
    choose(&p, (sl_point){1, 9});
    assert_int_not_equal(count_gaps(&p), 0);
    p.over = true;
    assert_int_equal(sli_add_in_line(&p.placer), SL_CANCELLED);
    p.over = false;
    assert_ok(p.context, sli_add_in_line(&p.placer));
    end(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(apex_between_rooms),
        cmocka_unit_test(redundant_places),
        cmocka_unit_test(gaps_are_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
