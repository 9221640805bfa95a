/// Many boxes in the runtime, and in a query that cuts no cells, against a query that cuts the
/// space along the boxes and makes walls of those that block. Boxes touch walls, doors, corners,
/// the eye and each other.
#include "runtime_maps.h"

#include "geometry/crossing.h"
#include "sightline/bake.h"
#include "sightline/support.h"

#include <math.h>

enum { SIZE = 12, MAPS = 80, DOORS = 4, BOXES = 24, EYES = 8, CELLS_MOST = 1024, ROOM = 4096 };

typedef struct trial {
    sl_context *context;
    sl_random random;
    baked_file file;
    sl_query *query, *plain; ///< the plain one cuts no cells if no box blocks
    unsigned char shut[DOORS];
    sl_moving_box boxes[BOXES + 1]; ///< the last one is outside, and has the query cut cells
    bool block;
    sl_runtime_box list[BOXES];
    sl_runtime_boxes placed;
    uint32_t memory[CELLS_MOST + BOXES + 4 * ROOM + 1], scratch[7 * CELLS_MOST + 2 * BOXES];
    bool on_grid, apart; ///< boxes and eyes on a grid; no two boxes overlap
    size_t seen, touched, hidden, asked, cells, more_cells;
} trial;

static double below(trial *t, uint64_t bound) {
    return (double)sl_random_below(&t->random, bound);
}

// --- boxes

static double coordinate(trial *t, double low, double high) {
    if (t->on_grid) return floor(low) + floor(below(t, (uint64_t)(4 * (high - low)) + 1)) / 4;
    return low + sl_random_unit(&t->random) * (high - low);
}

static bool overlap(const sl_box *a, const sl_box *b) {
    return a->min.x < b->max.x && b->min.x < a->max.x && a->min.y < b->max.y && b->min.y < a->max.y;
}

static sl_box random_box(trial *t) {
    const sl_runtime *r = &t->file.runtime;
    const double most = t->on_grid ? 3 : (r->max_x - r->min_x) / 5;
    const double x = coordinate(t, r->min_x - 1, r->max_x),
                 y = coordinate(t, r->min_y - 1, r->max_y);
    const double width = coordinate(t, 0, most), height = coordinate(t, 0, most);
    return (sl_box){{x, y}, {x + width, y + height}};
}

static bool is_free(const trial *t, size_t i) {
    for (size_t k = 0; k < i; k++)
        if (overlap(&t->boxes[i].box, &t->boxes[k].box)) return false;
    return true;
}

static void move_boxes(trial *t, bool block) {
    for (uint32_t i = 0; i < BOXES; i++) {
        int tries = 0;
        do t->boxes[i].box = random_box(t);
        while (t->apart && !is_free(t, i) && tries++ < 100);
        if (tries > 100) t->boxes[i].box = (sl_box){{-99 - i, -99}, {-99 - i, -99}};
        t->boxes[i].blocks = block && sl_random_below(&t->random, 2);
        const sl_box *b = &t->boxes[i].box;
        const sl_runtime_box to = {b->min.x, b->min.y, b->max.x, b->max.y, t->boxes[i].blocks};
        assert_true(sl_runtime_boxes_move(&t->placed, i, &to));
    }
    t->block = block;
    t->boxes[BOXES] = (sl_moving_box){{{-999, -999}, {-998, -998}}, true};
    assert_ok(t->context, sl_query_set_boxes(t->context, t->query, t->boxes, BOXES + 1));
    assert_ok(t->context, sl_query_set_boxes(t->context, t->plain, t->boxes, BOXES));
}

// --- one eye

static sl_runtime_view runtime_view(const sl_view *view) {
    return (sl_runtime_view){view->eye.x,
                             view->eye.y,
                             view->full,
                             {view->right.x - view->eye.x, view->right.y - view->eye.y},
                             {view->left.x - view->eye.x, view->left.y - view->eye.y}};
}

static void print_trial(const trial *t) {
    for (int i = 0; i < BOXES; i++) {
        const sl_box b = t->boxes[i].box;
        print_message("box %d: %.17g,%.17g %.17g,%.17g%s\n", i, b.min.x, b.min.y, b.max.x, b.max.y,
                      t->boxes[i].blocks ? " blocks" : "");
    }
    for (size_t i = 0; i < t->file.baked.map.door_count; i++) {
        const sl_door *d = &t->file.baked.map.doors[i];
        print_message("door %g,%g %g,%g%s\n", d->segment.a.x, d->segment.a.y, d->segment.b.x,
                      d->segment.b.y, t->shut[d->name[0] - 'a'] ? " shut" : "");
    }
    for (size_t i = 0; i < t->file.baked.map.oneway_count; i++) {
        const sl_segment s = t->file.baked.map.oneways[i].segment;
        print_message("glass %g,%g %g,%g\n", s.a.x, s.a.y, s.b.x, s.b.y);
    }
    for (size_t i = 0; i < t->file.baked.space.wall_count; i++) {
        const sl_wall *w = &t->file.baked.space.walls[i];
        print_message("wall %g,%g %g,%g\n", w->a.x, w->a.y, w->b.x, w->b.y);
    }
}

/// Whether a box touches a flat one that blocks, or glass. To the library it is then seen through
/// these, as it has a side in the same place.
static bool touches_flat(const trial *t, const sl_box *b) {
    for (size_t i = 0; i < t->file.baked.map.oneway_count; i++) {
        const sl_segment s = t->file.baked.map.oneways[i].segment;
        if (fmin(s.a.x, s.b.x) <= b->max.x && b->min.x <= fmax(s.a.x, s.b.x) &&
            fmin(s.a.y, s.b.y) <= b->max.y && b->min.y <= fmax(s.a.y, s.b.y))
            return true;
    }
    for (int i = 0; i < BOXES; i++) {
        const sl_box *a = &t->boxes[i].box;
        if (t->boxes[i].blocks && (a->min.x == a->max.x || a->min.y == a->max.y) &&
            a->min.x <= b->max.x && b->min.x <= a->max.x && a->min.y <= b->max.y &&
            b->min.y <= a->max.y)
            return true;
    }
    return false;
}

static bool is_flat(const sl_box *box) {
    return box->min.x == box->max.x || box->min.y == box->max.y;
}

static bool is_in_line_with_glass(const trial *t, sl_point eye) {
    const sl_map *map = &t->file.baked.map;
    for (size_t i = 0; i < map->oneway_count; i++) {
        const sl_segment s = map->oneways[i].segment;
        if (s.a.x == s.b.x ? eye.x == s.a.x : eye.y == s.a.y) return true;
    }
    return false;
}

static void compare_boxes(trial *t, const sl_view *view, const unsigned char *said) {
    bool seen[BOXES + 1], plain[BOXES];
    assert_ok(t->context, sl_query_boxes_seen(t->context, t->query, view, seen, NULL));
    assert_ok(t->context, sl_query_boxes_seen(t->context, t->plain, view, plain, NULL));
    for (uint32_t i = 0; i < BOXES; i++) {
        t->asked++;
        t->seen += seen[i];
        // A flat box in a shut door is covered for the query, which makes a wall of the door.
        const bool may_differ = t->block || is_in_line_with_glass(t, view->eye) ||
                                (said[i] && is_flat(&t->boxes[i].box));
        if (plain[i] != said[i] && !may_differ) {
            print_trial(t);
            fail_msg("%s: eye %.17g,%.17g: box %u: the query says %d, the runtime %d", t->file.name,
                     view->eye.x, view->eye.y, i, plain[i], said[i]);
        }
        if (seen[i] == said[i] || (said[i] && !t->apart)) continue;
        if (!said[i] && t->on_grid && touches_flat(t, &t->boxes[i].box)) continue;
        // On the grid single lines pass between corners, and end at boxes that they only touch. The
        // library, which cuts cells along boxes, does not count all of these.
        if (said[i] && t->on_grid) {
            t->touched++;
            continue;
        }
        print_trial(t);
        fail_msg("%s: eye %.17g,%.17g%s: box %u is %s", t->file.name, view->eye.x, view->eye.y,
                 view->full ? "" : " with a cone", i, seen[i] ? "missed" : "added");
    }
}

static void compare_cells(trial *t, const sl_view *view, const uint32_t *cells, uint32_t count) {
    uint32_t bare[CELLS_MOST];
    uint64_t seen[CELLS_MOST / 64];
    bool said[CELLS_MOST] = {false}, sees[CELLS_MOST] = {false};
    const sl_runtime_view v = runtime_view(view);
    const sl_runtime *r = &t->file.runtime;
    const uint32_t bare_count =
        sl_runtime_look_past(r, &v, t->shut, 0, t->scratch, bare, CELLS_MOST);
    assert_ok(t->context, sl_query_look(t->context, t->query, view, NULL, seen, NULL));
    for (uint32_t i = 0; i < bare_count; i++) sees[bare[i]] = true;
    for (uint32_t i = 0; i < count; i++) said[cells[i]] = true;
    for (uint32_t c = 0; c < r->cell_count; c++) {
        assert_true(sees[c] || !said[c]);
        if (sl_eye_sees(seen, c) && !said[c]) {
            print_trial(t);
            fail_msg("eye %.17g,%.17g: cell %u is missed", view->eye.x, view->eye.y, c);
        }
        t->cells += sl_eye_sees(seen, c);
        t->more_cells += said[c] && !sl_eye_sees(seen, c);
        t->hidden += sees[c] && !said[c];
    }
}

static bool is_beside_boxes(const trial *t, sl_point eye) {
    for (int i = 0; i < BOXES; i++) {
        const sl_box b = t->boxes[i].box;
        if (t->boxes[i].blocks && b.min.x <= eye.x && eye.x <= b.max.x && b.min.y <= eye.y &&
            eye.y <= b.max.y &&
            !(b.min.x < eye.x && eye.x < b.max.x && b.min.y < eye.y && eye.y < b.max.y))
            return true;
    }
    return false;
}

static void try_eye(trial *t) {
    const sl_runtime *r = &t->file.runtime;
    const sl_point eye = {coordinate(t, r->min_x, r->max_x), coordinate(t, r->min_y, r->max_y)};
    sl_view view = sl_view_all_round(eye);
    const sl_point right = {eye.x + 3, eye.y + 1}, left = {eye.x + 1, eye.y - 2};
    // Cones that are exact to subtract again: wide, and narrow.
    if (right.x - eye.x == 3 && right.y - eye.y == 1 && left.x - eye.x == 1 &&
        left.y - eye.y == -2) {
        const uint64_t kind = sl_random_below(&t->random, 3);
        if (kind == 1) view = (sl_view){eye, false, right, left};
        if (kind == 2) view = (sl_view){eye, false, left, right};
    }
    unsigned char said[BOXES], again[BOXES];
    uint32_t cells[CELLS_MOST];
    const sl_runtime_view v = runtime_view(&view);
    if (is_beside_boxes(t, eye)) return; // the library's eye is then within the box
    sl_runtime_boxes_seen(&t->placed, &v, t->shut, 0, t->scratch, said);
    const uint32_t count = sl_runtime_look_past_boxes(&t->placed, &v, t->shut, 0, t->scratch, again,
                                                      cells, CELLS_MOST);
    assert_memory_equal(said, again, sizeof said);
    compare_boxes(t, &view, said);
    compare_cells(t, &view, cells, count);
}

static void start(trial *t) {
    const sl_runtime *r = &t->file.runtime;
    assert_true(r->cell_count <= CELLS_MOST);
    assert_true(sl_runtime_boxes_count(r, BOXES, ROOM) <= sizeof t->memory / sizeof *t->memory);
    assert_ok(t->context, sl_query_create(t->context, &t->file.baked, &t->query));
    assert_ok(t->context, sl_query_create(t->context, &t->file.baked, &t->plain));
    sl_runtime_boxes_start(&t->placed, r, t->list, BOXES, ROOM, t->memory);
    assert_true(sl_runtime_boxes_scratch_count(&t->placed) <=
                sizeof t->scratch / sizeof *t->scratch);
}

static void finish(trial *t) {
    sl_query_destroy(t->context, t->query);
    sl_query_destroy(t->context, t->plain);
    baked_file_destroy(t->context, &t->file);
}

static void ask_all(trial *t, bool with_grid) {
    for (int block = 0; block < 2; block++)
        for (int i = 0; i < 4; i++) {
            t->on_grid = with_grid && i % 2;
            t->apart = !block || i < 2;
            move_boxes(t, block);
            for (int k = 0; k < EYES; k++) try_eye(t);
        }
}

static void print_counts(const trial *t) {
    print_message(
        "%zu of %zu boxes seen, %zu more touched; %zu cells seen, %zu more said, %zu hidden\n",
        t->seen, t->asked, t->touched, t->cells, t->more_cells, t->hidden);
    assert_true(t->seen > 0 && t->seen < t->asked && t->hidden > 0);
    assert_true(t->touched < t->asked / 1000 && t->more_cells < t->cells / 4);
}

static void as_the_query_says(void **state) {
    (void)state;
    static trial t;
    t = (trial){.context = testing_context(NULL)};
    for (uint64_t seed = 1; seed <= testing_seeds(MAPS); seed++) {
        t.random = (sl_random){seed};
        t.file = (baked_file){.name = "random", .baked = {.method = "dfs", .solver = "funnel"}};
        sl_map *map = &t.file.baked.map;
        grid_rooms(t.context, &t.random, SIZE, 8, DOORS, map);
        if (seed % 2)
            assert_ok(t.context,
                      sl_map_add_oneway(t.context, map, grid_segment(&t.random, SIZE), 0));
        assert_ok(t.context, sl_map_clean(t.context, map, NULL, NULL));
        baked_file_make(t.context, &t.file, false);
        start(&t);
        for (int k = 0; k < DOORS; k++) {
            const char name[2] = {(char)('a' + k), 0};
            t.shut[k] = (unsigned char)sl_random_below(&t.random, 2);
            assert_ok(t.context, sl_query_set_door(t.context, t.query, name, !t.shut[k]));
            assert_ok(t.context, sl_query_set_door(t.context, t.plain, name, !t.shut[k]));
        }
        ask_all(&t, true);
        finish(&t);
    }
    print_counts(&t);
    sl_context_destroy(t.context);
}

static void in_turned_maps(void **state) {
    (void)state;
    static const char *const names[] = {"oblique/chapel", "oblique/star", "pillars", "grazing"};
    static trial t;
    t = (trial){.context = testing_context(NULL)};
    for (size_t i = 0; i < 4 * testing_seeds(5); i++) {
        t.random = (sl_random){i + 1};
        t.file = baked_file_turned(t.context, names[i % 4], 11 * (double)(i / 4), 100);
        start(&t);
        ask_all(&t, false);
        finish(&t);
    }
    print_counts(&t);
    sl_context_destroy(t.context);
}

// --- by hand

typedef struct scene {
    sl_context *context;
    baked_file file;
    sl_runtime_boxes boxes;
    sl_runtime_box list[3];
    uint32_t memory[256], scratch[256];
} scene;

static void set_up_text(scene *s, const char *text, uint32_t room) {
    *s = (scene){.context = testing_context(NULL)};
    s->file = baked_file_of_text(s->context, text);
    sl_runtime_boxes_start(&s->boxes, &s->file.runtime, s->list, 3, room, s->memory);
}

/// Two rooms, and a doorway between them from (10, 4) to (10, 6).
static void set_up(scene *s, uint32_t room) {
    set_up_text(s, "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n", room);
}

static void take_down(scene *s) {
    baked_file_destroy(s->context, &s->file);
    sl_context_destroy(s->context);
}

static bool move(scene *s, uint32_t box, double x0, double y0, double x1, double y1, bool blocks) {
    const sl_runtime_box to = {x0, y0, x1, y1, blocks};
    return sl_runtime_boxes_move(&s->boxes, box, &to);
}

/// Which of the boxes an eye sees, as a word of s and dots.
static const char *seen(scene *s, double x, double y, double range) {
    static char word[4];
    unsigned char said[3];
    const sl_runtime_view view = sl_runtime_view_all_round(x, y);
    const uint32_t count = sl_runtime_boxes_seen(&s->boxes, &view, NULL, range, s->scratch, said);
    assert_int_equal(count, said[0] + said[1] + said[2]);
    for (int i = 0; i < 3; i++) word[i] = said[i] ? 's' : '.';
    return word;
}

static void one_hides_another(void **state) {
    (void)state;
    scene s;
    set_up(&s, 20);
    assert_string_equal(seen(&s, 2, 5, 0), "..."); // nowhere yet
    assert_true(move(&s, 0, 15, 4, 16, 6, false));
    assert_true(move(&s, 1, 15, 0, 16, 1, false));
    assert_string_equal(seen(&s, 2, 5, 0), "s.."); // the other one is behind the wall
    assert_string_equal(seen(&s, 2, 5, 13), "s..");
    assert_string_equal(seen(&s, 2, 5, 12.9), "...");
    // In the doorway: hides it, but for a gap, and hides it with its whole width.
    assert_true(move(&s, 2, 9, 4.5, 11, 5.5, true));
    assert_string_equal(seen(&s, 2, 5, 0), "s.s");
    assert_true(move(&s, 2, 9, 4, 11, 6, true));
    assert_string_equal(seen(&s, 2, 5, 0), "..s");
    assert_true(move(&s, 2, 10, 4, 10, 6, true)); // a door that slid shut
    assert_string_equal(seen(&s, 2, 5, 0), "..s");
    assert_true(move(&s, 2, 9, 4, 11, 6, false));
    assert_string_equal(seen(&s, 2, 5, 0), "s.s");
    // The eye in it sees it alone; beside it, what is on its own side.
    assert_true(move(&s, 2, 1, 4, 3, 6, true));
    assert_string_equal(seen(&s, 2, 5, 0), "..s");
    assert_string_equal(seen(&s, 3, 5, 0), "s.s");
    assert_string_equal(seen(&s, 1, 5, 0), "..s");
    take_down(&s);
}

static void nowhere_and_everywhere(void **state) {
    (void)state;
    scene s;
    set_up(&s, 2);
    assert_true(move(&s, 0, NAN, 1, 2, 2, true));
    assert_true(move(&s, 1, 3, 1, 2, 2, true));
    assert_true(move(&s, 2, -9, -9, -8, -8, true));
    assert_string_equal(seen(&s, 5, 5, 0), "...");
    // Too large to be anywhere, even about the eye: it neither is seen nor hides.
    assert_true(move(&s, 1, -1e200, -1e200, 1e200, 1e200, true));
    assert_true(move(&s, 2, 15, 4, 16, 6, false));
    assert_string_equal(seen(&s, 5, 5, 0), "..s");
    assert_true(move(&s, 2, -9, -9, -8, -8, true));
    assert_true(move(&s, 0, 9, 4, 11, 6, true)); // in both rooms
    assert_string_equal(seen(&s, 5, 5, 0), "s..");
    assert_false(move(&s, 1, 15, 4, 16, 6, true)); // no room: seen always, and hides nothing
    assert_false(move(&s, 2, 15, 7, 16, 8, true));
    assert_string_equal(seen(&s, 1, 1, 0), "sss");
    assert_string_equal(seen(&s, 21, 1, 0), "..."); // an eye outside sees nothing
    assert_true(move(&s, 0, 99, 99, 99, 99, true)); // and there is room again
    assert_true(move(&s, 1, 15, 1, 16, 2, true));
    assert_true(move(&s, 2, 15, 1, 16, 2, true));
    assert_string_equal(seen(&s, 1, 1, 0), "...");
    take_down(&s);
}

/// Against a wall from behind, on a portal, in a corner, at the border.
static void touching(void **state) {
    (void)state;
    scene s;
    set_up(&s, 20);
    assert_true(move(&s, 0, 10, 1, 11, 2, false)); // behind the wall, touching it
    assert_true(move(&s, 1, 10, 5, 10, 5, false)); // a point on the portal
    assert_true(move(&s, 2, 9, 0, 10, 1, false));  // in the corner before the wall
    assert_string_equal(seen(&s, 2, 2, 0), ".ss");
    assert_true(move(&s, 0, 10, 4, 10, 5, false)); // flat, on the portal
    assert_true(move(&s, 1, 10, 2, 10, 3, false)); // flat, in the wall
    assert_true(move(&s, 2, 20, 1, 21, 2, false)); // outside, touching the border
    assert_string_equal(seen(&s, 2, 2, 0), "s..");
    assert_string_equal(seen(&s, 18, 2, 0), "s..");
    take_down(&s);
}

/// The eye is in the corner of two walls, and looks along one of them. A box under that wall
/// touches it from behind; one beyond its end touches the line of sight. The library says the same.
static void behind_a_corner(void **state) {
    (void)state;
    scene s;
    sl_query *query;
    const sl_moving_box boxes[2] = {{{{5, 1}, {6, 2}}, false}, {{{9, 1}, {10, 2}}, false}};
    const sl_view view = sl_view_all_round((sl_point){4, 2});
    bool by_library[2];
    set_up_text(&s, "walls 0 0 20 0 20 10 0 10 0 0\nwalls 4 8 4 2 8 2\nwall 0 2 1 2\n", 20);
    for (uint32_t i = 0; i < 2; i++)
        assert_true(move(&s, i, boxes[i].box.min.x, boxes[i].box.min.y, boxes[i].box.max.x,
                         boxes[i].box.max.y, false));
    assert_string_equal(seen(&s, 4, 2, 0), ".s.");
    assert_ok(s.context, sl_query_create(s.context, &s.file.baked, &query));
    assert_ok(s.context, sl_query_set_boxes(s.context, query, boxes, 2));
    assert_ok(s.context, sl_query_boxes_seen(s.context, query, &view, by_library, NULL));
    assert_true(!by_library[0] && by_library[1]);
    sl_query_destroy(s.context, query);
    take_down(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_the_query_says), cmocka_unit_test(in_turned_maps),
        cmocka_unit_test(one_hides_another), cmocka_unit_test(nowhere_and_everywhere),
        cmocka_unit_test(touching),          cmocka_unit_test(behind_a_corner),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
