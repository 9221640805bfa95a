// The runtime's lines of sight and steps past boxes, against brute force in integers and against
// the library's query.
#include "runtime_trial.h"

// --- brute force: the part of a line that is in a box, from one number to another

/// A fraction with a denominator above 0.
typedef struct fraction {
    int64_t over, under;
} fraction;

static fraction fraction_of(double over, double under) {
    const int64_t a = (int64_t)over, b = (int64_t)under;
    return b < 0 ? (fraction){-a, -b} : (fraction){a, b};
}

static int compare(fraction a, fraction b) {
    const int64_t left = a.over * b.under, right = b.over * a.under;
    return (left > right) - (left < right);
}

/// Narrows a part of the way from p to q to where it is from `low` to `high`. False for none, also
/// not an end if `strictly`.
static bool narrow(double p, double q, double low, double high, bool strictly, fraction part[2]) {
    if (p == q) return strictly ? low < p && p < high : low <= p && p <= high;
    const fraction at[2] = {fraction_of(low - p, q - p), fraction_of(high - p, q - p)};
    const fraction from = at[q < p], to = at[q > p];
    if (compare(from, part[0]) > 0) part[0] = from;
    if (compare(to, part[1]) < 0) part[1] = to;
    return true;
}

static bool touches_box(sl_point p, sl_point q, sl_box b) {
    fraction part[2] = {{0, 1}, {1, 1}};
    return narrow(p.x, q.x, b.min.x, b.max.x, false, part) &&
           narrow(p.y, q.y, b.min.y, b.max.y, false, part) && compare(part[0], part[1]) <= 0;
}

/// Whether a line crosses an upright box without width.
static bool crosses_flat(sl_point p, sl_point q, sl_box b) {
    const double wide = q.x - p.x, at = wide * p.y + (q.y - p.y) * (b.min.x - p.x);
    const double low = fmin(wide * b.min.y, wide * b.max.y),
                 high = fmax(wide * b.min.y, wide * b.max.y);
    return fmin(p.x, q.x) < b.min.x && b.min.x < fmax(p.x, q.x) && low < at && at < high;
}

static bool crosses_box(sl_point p, sl_point q, sl_box b) {
    fraction part[2] = {{0, 1}, {1, 1}};
    if (b.min.x == b.max.x) return crosses_flat(p, q, b);
    if (b.min.y == b.max.y)
        return crosses_flat((sl_point){p.y, p.x}, (sl_point){q.y, q.x},
                            (sl_box){{b.min.y, b.min.x}, {b.max.y, b.max.x}});
    return narrow(p.x, q.x, b.min.x, b.max.x, true, part) &&
           narrow(p.y, q.y, b.min.y, b.max.y, true, part) && compare(part[0], part[1]) < 0;
}

static bool is_hidden_by(sl_point p, sl_point q, sl_box b) {
    return crosses_box(p, q, b) && (place(p, b) < 1 || place(q, b) < 0) &&
           (place(q, b) < 1 || place(p, b) < 0);
}

// --- one line

static void try_sight(trial *t, sl_point p, sl_point q) {
    const sl_runtime *r = &t->file.runtime;
    const double range = sl_random_below(&t->random, 4) ? 0 : 1 + below(t, 100);
    const bool past_walls = sl_runtime_sees(r, p.x, p.y, q.x, q.y, t->shut, range, t->scratch);
    const bool sees =
        sl_runtime_sees_past_boxes(&t->placed, p.x, p.y, q.x, q.y, t->shut, range, t->scratch);
    bool is_hidden = false, is_touched = false, by_query;
    for (int i = 0; i < BOXES; i++) {
        const sl_box b = t->boxes[i].box;
        if (!t->boxes[i].blocks) continue;
        is_hidden |= is_hidden_by(p, q, b);
        is_touched |=
            touches_box(p, q, b) && (!is_hidden_by(p, q, b) || !place(p, b) || !place(q, b));
    }
    if (sees != (past_walls && !is_hidden)) complain(t, p, q, sees ? "added" : "missed");
    t->sees[sees]++;
    t->hidden += past_walls && is_hidden;
    if (range > 0 || is_touched) return;
    assert_ok(t->context, sl_query_sees(t->context, t->query, p, q, &by_query));
    if (by_query != sees) complain(t, p, q, "not as the query says");
    t->same++;
}

static void try_step(trial *t, sl_point p, sl_point q) {
    const sl_runtime *r = &t->file.runtime;
    const uint32_t except = (uint32_t)sl_random_below(&t->random, BOXES + 1);
    const bool past_walls = sl_runtime_can_walk(r, p.x, p.y, q.x, q.y, t->shut);
    const bool walks =
        sl_runtime_can_walk_past_boxes(&t->placed, p.x, p.y, q.x, q.y, t->shut, except);
    bool is_stopped = false;
    for (uint32_t i = 0; i < BOXES; i++)
        is_stopped |= t->boxes[i].blocks && i != except && is_there(t, t->boxes[i].box) &&
                      touches_box(p, q, t->boxes[i].box);
    if (walks != (past_walls && !is_stopped)) complain(t, p, q, walks ? "a step added" : "no step");
    if (walks != sl_runtime_can_walk_past_boxes(&t->placed, q.x, q.y, p.x, p.y, t->shut, except))
        complain(t, p, q, "a step one way");
    t->steps[walks]++;
    t->stopped += past_walls && is_stopped;
}

static void past_boxes(void **state) {
    (void)state;
    static trial t;
    t = (trial){.context = testing_context(NULL)};
    for (uint64_t seed = 1; seed <= testing_seeds(MAPS); seed++) {
        t.random = (sl_random){seed};
        t.turned = seed % 2 == 0;
        start(&t);
        for (int i = 0; i < STATES * LINES; i++) {
            if (i % LINES == 0) set_state(&t);
            const sl_point p = some_point(&t), q = some_point(&t);
            try_sight(&t, p, q);
            try_step(&t, p, q);
            try_step(&t, p, (sl_point){p.x + below(&t, 9) - 4, p.y + below(&t, 9) - 4});
        }
        finish(&t);
    }
    print_message(
        "%zu of %zu seen, %zu hidden, %zu asked of the query; %zu of %zu steps, %zu stopped\n",
        t.sees[1], t.sees[0] + t.sees[1], t.hidden, t.same, t.steps[1], t.steps[0] + t.steps[1],
        t.stopped);
    assert_true(t.sees[1] > 500 && t.hidden > 500 && t.same > 500);
    assert_true(t.steps[1] > 500 && t.stopped > 500);
    sl_context_destroy(t.context);
}

/// Where no walls are, one may walk along the border of the map. All walls and boxes are asked
/// there.
static void along_the_border(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(
        context, "wall 0 5 4 5\nwall 10 2 10 3\nwall 5 0 6 0\nwall 2 10 3 10\nwall 8 2 8 3\n");
    const sl_runtime *r = &f.runtime;
    const sl_runtime_box box = {8.5, -1, 9, 1, true};
    sl_runtime_box list[1];
    sl_runtime_boxes boxes;
    uint32_t memory[256];
    assert_true(sl_runtime_boxes_count(r, 1, 8) <= 256);
    sl_runtime_boxes_start(&boxes, r, list, 1, 8, memory);
    assert_true(sl_runtime_locate(r, 7, 0) != sl_runtime_locate(r, 9, 0));
    assert_true(sl_runtime_can_walk_past_boxes(&boxes, 7, 0, 9.5, 0, NULL, SL_RUNTIME_NO_BOX));
    assert_true(sl_runtime_boxes_move(&boxes, 0, &box));
    assert_true(sl_runtime_can_walk(r, 7, 0, 9.5, 0, NULL));
    assert_false(sl_runtime_can_walk_past_boxes(&boxes, 7, 0, 9.5, 0, NULL, SL_RUNTIME_NO_BOX));
    assert_true(sl_runtime_can_walk_past_boxes(&boxes, 7, 0, 9.5, 0, NULL, 0));
    assert_true(sl_runtime_can_walk_past_boxes(&boxes, 7, 0, 8, 0, NULL, SL_RUNTIME_NO_BOX));
    assert_false(sl_runtime_can_walk(r, 7, 0, 6, 0, NULL));
    assert_false(sl_runtime_can_walk(r, 7, 0, 10.5, 0, NULL));
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// Places that are no integers, also far from the origin.
static void past_boxes_of_turned_maps(void **state) {
    (void)state;
    static const char *const names[] = {"office", "pillars", "oblique/chapel"};
    sl_context *context = testing_context(NULL);
    size_t seen = 0, asked = 0;
    for (int n = 0; n < 6; n++) {
        static trial t;
        t = (trial){.context = context, .random = {(uint64_t)n}};
        t.file = baked_file_turned(context, names[n % 3], 17.3, n < 3 ? 0 : 1e9);
        ask_of(&t);
        const sl_runtime *r = &t.file.runtime;
        const double wide = (r->max_x - r->min_x) / 8;
        for (int i = 0; i < 1000; i++) {
            sl_point p[2];
            bool by_query;
            for (int k = 0; k < 2; k++)
                p[k] = (sl_point){r->min_x + sl_random_unit(&t.random) * (r->max_x - r->min_x),
                                  r->min_y + sl_random_unit(&t.random) * (r->max_y - r->min_y)};
            const uint32_t box = (uint32_t)i % BOXES;
            const double x = p[0].x + wide * (sl_random_unit(&t.random) - 0.3),
                         y = p[0].y + wide * (sl_random_unit(&t.random) - 0.3);
            const double width = wide * sl_random_unit(&t.random) / 2;
            t.boxes[box] = (sl_moving_box){{{x, y}, {x + width, y + width}}, true};
            const sl_runtime_box to = {x, y, x + width, y + width, true};
            assert_true(sl_runtime_boxes_move(&t.placed, box, &to));
            assert_ok(context, sl_query_set_boxes(context, t.query, t.boxes,
                                                  i < BOXES ? (size_t)i + 1 : BOXES));
            assert_ok(context, sl_query_sees(context, t.query, p[0], p[1], &by_query));
            const bool sees = sl_runtime_sees_past_boxes(&t.placed, p[0].x, p[0].y, p[1].x, p[1].y,
                                                         NULL, 0, t.scratch);
            if (sees != by_query) complain(&t, p[0], p[1], "not as the query says");
            seen += sees;
            asked++;
        }
        finish(&t);
    }
    assert_true(seen > asked / 50 && seen < asked);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(along_the_border),
        cmocka_unit_test(past_boxes),
        cmocka_unit_test(past_boxes_of_turned_maps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
