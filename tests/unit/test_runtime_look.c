// Eye-to-cell of the runtime against an oracle: what one eye sees is told by its lines through the
// ends of portals and along the cone's borders, each followed by itself through the cells.
#include "runtime_maps.h"
#include "sight/cone.h"

#include "geometry/orient.h"
#include "sightline/support.h"
#include "sightline/view.h"

#include <math.h>

typedef struct trial {
    const baked_file *f;
    uint32_t *scratch, *cells, *stack;
    bool *reached, *is_seen, *is_own, *said;
    size_t lines_left; ///< what the oracle may still follow on this map
} trial;

/// Whether the closed ray from an eye through another point leaves by a directed portal.
static bool leaves_by(sl_point eye, sl_point through, const sl_directed_portal *directed) {
    const int facing = sli_orient(directed->right, directed->left, eye);
    const int right = sli_orient(eye, through, directed->right),
              left = sli_orient(eye, through, directed->left);
    if (facing < 0 || right > 0 || left < 0) return false;
    if (facing > 0) return true;
    // In line with it: on it, or looking along it.
    const sl_view ray = {.eye = eye, .left = through, .right = through};
    const sl_view to_left = {.eye = eye, .left = directed->left, .right = directed->left};
    return testing_same_point(eye, directed->left) || testing_same_point(eye, directed->right) ||
           !sli_view_holds(&to_left, directed->right) || sli_view_holds(&ray, directed->right);
}

enum { CROSSED_LEFT = 1, CROSSED_RIGHT = 2, CROSSED_BOTH = 3, STATES = 4 };

/// To which side a ray in line with a directed portal crosses it; 0 if it is not in line.
static unsigned crossing_along(sl_point eye, sl_point through, const sl_directed_portal *directed) {
    const sl_point right = directed->right, left = directed->left;
    if (sli_orient(eye, through, right) || sli_orient(eye, through, left)) return 0;
    const double ray = through.x != eye.x ? through.x - eye.x : through.y - eye.y;
    const double portal = through.x != eye.x ? left.x - right.x : left.y - right.y;
    return (ray > 0) == (portal > 0) ? CROSSED_RIGHT : CROSSED_LEFT;
}

/// Whether a line from the eye that touches a cell enters it or runs along its border: it crosses
/// no side at the eye from within.
static bool enters(const sl_space *s, const sl_cell *c, sl_point eye, sl_point through) {
    const sl_point *v = s->vertices + c->first_vertex;
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        const sl_point a = v[i], b = v[(i + 1) % c->vertex_count];
        if (sli_orient(a, b, eye) == 0 && sli_orient(a, b, through) < 0) return false;
    }
    return true;
}

/// Adds what one line sees within the row of one of the eye's cells. A line that runs along portals
/// crosses them all to its left, or all to its right: then a line beside it passes them strictly.
static void follow(trial *t, sl_point eye, uint32_t from, sl_point through) {
    const sl_space *s = &t->f->baked.space;
    memset(t->reached, 0, STATES * s->cell_count * sizeof *t->reached);
    uint32_t count = 0;
    t->reached[STATES * from] = true;
    t->stack[count++] = STATES * from;
    while (count) {
        const uint32_t state = t->stack[--count];
        const sl_cell *c = &s->cells[state / STATES];
        if (enters(s, c, eye, through)) t->is_seen[c - s->cells] = true;
        for (uint32_t i = 0; i < c->directed_count; i++) {
            const sl_directed_portal *directed = &s->directed[c->first_directed + i];
            if (!sl_runtime_can_see(&t->f->runtime, from, directed->cell) ||
                !leaves_by(eye, through, directed))
                continue;
            const unsigned sides = state % STATES | crossing_along(eye, through, directed);
            const uint32_t next = STATES * directed->cell + sides;
            if (sides == CROSSED_BOTH || t->reached[next]) continue;
            t->reached[next] = true;
            t->stack[count++] = next;
        }
    }
}

static bool touches(sl_point eye, const sl_directed_portal *directed) {
    const sl_point a = directed->left, b = directed->right;
    return sli_orient(a, b, eye) == 0 && fmin(a.x, b.x) <= eye.x && eye.x <= fmax(a.x, b.x) &&
           fmin(a.y, b.y) <= eye.y && eye.y <= fmax(a.y, b.y);
}

/// Adds what is seen from one of the eye's cells, and then from those that portals at the eye join
/// with it.
static void look_from_cell(trial *t, const sl_view *view, uint32_t cell) {
    const sl_space *s = &t->f->baked.space;
    const sl_cell *c = &s->cells[cell];
    t->is_own[cell] = true;
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        const sl_point corner = s->vertices[c->first_vertex + i];
        if (!testing_same_point(corner, view->eye) && sli_view_holds(view, corner))
            t->is_seen[cell] = true;
    }
    for (uint32_t i = 0; i < 2 * s->portal_count; i++) {
        const sl_point end = i % 2 ? s->portals[i / 2].left : s->portals[i / 2].right;
        if (!testing_same_point(end, view->eye) && sli_view_holds(view, end))
            follow(t, view->eye, cell, end);
    }
    if (!view->full) {
        follow(t, view->eye, cell, view->right);
        follow(t, view->eye, cell, view->left);
    }
    t->lines_left -= t->lines_left < 2 * s->portal_count ? t->lines_left : 2 * s->portal_count;
    for (uint32_t i = c->first_directed; i < c->first_directed + c->directed_count; i++)
        if (!t->is_own[s->directed[i].cell] && touches(view->eye, &s->directed[i]))
            look_from_cell(t, view, s->directed[i].cell);
}

static void ask_oracle(trial *t, const sl_view *view, uint32_t cell) {
    memset(t->is_seen, 0, t->f->baked.space.cell_count * sizeof *t->is_seen);
    memset(t->is_own, 0, t->f->baked.space.cell_count * sizeof *t->is_own);
    look_from_cell(t, view, cell);
}

static void compare(trial *t, const sl_view *view) {
    const sl_runtime *r = &t->f->runtime;
    const sl_point eye = view->eye;
    // Directions may have any length but a very small one.
    const double up = r->max_x - r->min_x < 1 ? 0x1p300 : 1;
    const sl_runtime_view same_view = {eye.x,
                                       eye.y,
                                       view->full,
                                       {up * (view->right.x - eye.x), up * (view->right.y - eye.y)},
                                       {up * (view->left.x - eye.x), up * (view->left.y - eye.y)}};
    const uint32_t cell = sl_runtime_locate(r, eye.x, eye.y);
    const uint32_t count = sl_runtime_look(r, &same_view, t->scratch, t->cells, r->cell_count);
    if (t->f->baked.space.cells[cell].solid) {
        assert_int_equal(count, 0);
        return;
    }
    assert_true(count <= r->cell_count);
    memset(t->said, 0, r->cell_count * sizeof *t->said);
    for (uint32_t i = 0; i < count; i++) {
        assert_false(t->said[t->cells[i]]);
        t->said[t->cells[i]] = true;
    }
    ask_oracle(t, view, cell);
    if (t->is_seen[cell]) assert_int_equal(t->cells[0], cell);
    // The oracle knows neither ranges nor glass; test_runtime_query does. Nor does it know limited
    // walls; test_runtime_limited does.
    const bool less = r->range > 0 || t->f->baked.map.oneway_count || r->has_limits;
    for (uint32_t i = 0; i < r->cell_count; i++) {
        if (t->said[i] != t->is_seen[i] && (t->said[i] || !less))
            fail_msg("%s: (%.17g, %.17g)%s: cell %u is %s", t->f->name, eye.x, eye.y,
                     view->full ? "" : " with a cone", i, t->is_seen[i] ? "missed" : "added");
    }
}

static void look_from(trial *t, sl_random *random, sl_point eye) {
    const sl_box *b = &t->f->baked.space.bounds;
    const double reach = b->max.x / 2 - b->min.x / 2;
    if (sl_space_locate(&t->f->baked.space, eye) == SL_NO_CELL || !t->lines_left) return;
    sl_view view = sl_view_all_round(eye);
    compare(t, &view);
    view = (sl_view){.eye = eye,
                     .right = runtime_border(random, eye, reach),
                     .left = runtime_border(random, eye, reach)};
    if (!testing_same_point(view.right, eye) && !testing_same_point(view.left, eye))
        compare(t, &view);
}

static void looks_are_exact(const baked_file *f) {
    const sl_space *s = &f->baked.space;
    const uint32_t n = s->cell_count;
    sl_random random = {11};
    trial t = {.f = f, .lines_left = 100000};
    t.scratch = malloc(sl_runtime_scratch_count(&f->runtime) * sizeof *t.scratch);
    t.cells = calloc(n, sizeof *t.cells);
    t.stack = calloc(n, STATES * sizeof *t.stack);
    t.reached = calloc(n, STATES * sizeof *t.reached);
    t.is_seen = calloc(n, sizeof *t.is_seen);
    t.is_own = calloc(n, sizeof *t.is_own);
    t.said = calloc(n, sizeof *t.said);
    assert_true(t.scratch && t.cells && t.stack && t.reached && t.is_seen && t.is_own && t.said);
    for (int i = 0; i < 300 && t.lines_left; i++) {
        const sl_point *corner = &s->vertices[sl_random_below(&random, s->vertex_count)];
        const sl_point *other = &s->vertices[sl_random_below(&random, s->vertex_count)];
        look_from(&t, &random, *corner);
        // On the lines of walls and portals, and near and anywhere between corners.
        look_from(&t, &random, (sl_point){corner->x, other->y});
        if (other->y != 0)
            look_from(&t, &random, (sl_point){corner->x, nextafter(other->y, INFINITY)});
        look_from(&t, &random, runtime_between(*corner, *other, sl_random_unit(&random)));
        if (!s->portal_count) continue;
        const sl_portal *p = &s->portals[sl_random_below(&random, s->portal_count)];
        look_from(&t, &random, runtime_between(p->left, p->right, sl_random_unit(&random)));
    }
    free(t.scratch);
    free(t.cells);
    free(t.stack);
    free(t.reached);
    free(t.is_seen);
    free(t.is_own);
    free(t.said);
}

static void what_an_eye_sees_is_exact(void **state) {
    (void)state;
    baked_file_each(looks_are_exact);
}

static void what_an_eye_sees_of_a_turned_map_is_exact(void **state) {
    (void)state;
    static const char *const names[] = {"office", "gallery", "oblique/star"};
    sl_context *context = testing_context(NULL);
    for (int i = 0; i < 6; i++) {
        baked_file f = baked_file_turned(context, names[i / 2], 17.3, i % 2 ? 1e9 : 0);
        assert_non_null(f.runtime.grid_cells);
        looks_are_exact(&f);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

/// Two rooms, a door of 2 between them.
static const char *const two_rooms = "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\n"
                                     "wall 10 6 10 10\n";

static void an_odd_direction_looks_all_round(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, two_rooms);
    uint32_t scratch[64], cells[8];
    assert_true(sl_runtime_scratch_count(&f.runtime) <= 64);
    const sl_runtime_view round = sl_runtime_view_all_round(5, 5);
    const uint32_t all = sl_runtime_look(&f.runtime, &round, scratch, cells, 8);
    assert_int_equal(all, f.runtime.cell_count);
    // Away from the door, to be sure that a cone hides something.
    const sl_runtime_view away = sl_runtime_view_toward(5, 5, -1, 0, 1);
    const uint32_t fewer = sl_runtime_look(&f.runtime, &away, scratch, cells, 8);
    assert_true(fewer >= 1 && fewer < all);
    const double odd[] = {0, NAN, INFINITY, 1e200, 1e-200};
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        sl_runtime_view view = away;
        view.left[0] = odd[i];
        view.left[1] = 0;
        assert_int_equal(sl_runtime_look(&f.runtime, &view, scratch, cells, 8), all);
        view.left[0] = -1;
        view.right[0] = 0;
        view.right[1] = odd[i];
        assert_int_equal(sl_runtime_look(&f.runtime, &view, scratch, cells, 8), all);
    }
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void no_more_is_written_than_there_is_room(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, two_rooms);
    uint32_t scratch[64], cells[8];
    const sl_runtime_view view = sl_runtime_view_all_round(5, 5);
    for (uint32_t room = 0; room <= f.runtime.cell_count; room++) {
        for (uint32_t i = 0; i < 8; i++) cells[i] = 77;
        assert_int_equal(sl_runtime_look(&f.runtime, &view, scratch, room ? cells : NULL, room),
                         f.runtime.cell_count);
        for (uint32_t i = 0; i < 8; i++) assert_int_equal(cells[i] == 77, i >= room);
    }
    const double outside[][2] = {{-1, 5}, {NAN, 5}, {5, INFINITY}};
    for (size_t i = 0; i < 3; i++) {
        const sl_runtime_view none = sl_runtime_view_all_round(outside[i][0], outside[i][1]);
        assert_int_equal(sl_runtime_look(&f.runtime, &none, scratch, cells, 8), 0);
    }
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// An eye in solid ground sees nothing, by a kd-tree and by a mesh.
static void rock_has_no_view(void **state) {
    (void)state;
    static const char *const maps[] = {
        "walls 0 0 8 0 8 8 0 8 0 0\nsolid 3 3 5 3 5 5 3 5\nstart 1 1 0\n",
        "walls 0 0 8 0 8 8 0 8 0 0\nsolid 3 3 5 3 4 6\nstart 1 1 0\n"};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < 2; i++) {
        baked_file f = baked_file_of_text(context, maps[i]);
        uint32_t cells[16];
        uint32_t *scratch = malloc(sl_runtime_scratch_count(&f.runtime) * sizeof *scratch);
        assert_non_null(scratch);
        const sl_runtime_view rock = sl_runtime_view_all_round(4, 4);
        const sl_runtime_view room = sl_runtime_view_all_round(1, 1);
        assert_int_equal(sl_runtime_look(&f.runtime, &rock, scratch, cells, 16), 0);
        assert_true(sl_runtime_look(&f.runtime, &room, scratch, cells, 16) > 0);
        free(scratch);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_an_eye_sees_is_exact),
        cmocka_unit_test(what_an_eye_sees_of_a_turned_map_is_exact),
        cmocka_unit_test(an_odd_direction_looks_all_round),
        cmocka_unit_test(no_more_is_written_than_there_is_room),
        cmocka_unit_test(rock_has_no_view),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
