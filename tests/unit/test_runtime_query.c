// The runtime's eye against the library's query: which cells an eye sees past shut doors, one-way
// glass and a view range. Many eyes are on corners, on portals, on walls and on their lines.
//   test_runtime_query [EYES]    so many eyes on each map instead of 600
#include "runtime_maps.h"

#include "geometry/crossing.h"
#include "sightline/bake.h"
#include "sightline/support.h"
#include "sightline/view.h"

#include <math.h>

static uint64_t eyes = 600;

typedef struct trial {
    sl_context *context;
    const baked_file *f;
    sl_query *query;
    sl_query *open_sight; ///< lines that touch nothing
    sl_random random;
    uint32_t *scratch, *cells;
    uint64_t *seen;
    unsigned char *shut;
    bool *said;
    double range; ///< 0: the map's own
    size_t asked;
} trial;

static trial trial_of(sl_context *context, const baked_file *f) {
    const sl_runtime *r = &f->runtime;
    trial t = {.context = context, .f = f, .random = {31}};
    static const sl_visibility open = {.sight = SL_OPEN};
    assert_ok(context, sl_query_create(context, &f->baked, &t.query));
    assert_ok(context,
              sl_query_over(context, &f->baked.space, &f->baked.map, &open, &t.open_sight));
    t.scratch = malloc(sl_runtime_scratch_count(r) * sizeof *t.scratch);
    t.cells = malloc(r->cell_count * sizeof *t.cells);
    t.seen = malloc(sl_eye_words(&f->baked.space) * sizeof *t.seen);
    t.shut = calloc(r->door_count + 1, 1);
    t.said = malloc(r->cell_count * sizeof *t.said);
    assert_true(t.scratch && t.cells && t.seen && t.shut && t.said);
    return t;
}

static void trial_end(trial *t) {
    sl_query_destroy(t->context, t->query);
    sl_query_destroy(t->context, t->open_sight);
    free(t->scratch);
    free(t->cells);
    free(t->seen);
    free(t->shut);
    free(t->said);
}

static void compare(trial *t, const sl_view *view) {
    const sl_runtime *r = &t->f->runtime;
    const sl_point eye = view->eye;
    const sl_runtime_view same = {eye.x,
                                  eye.y,
                                  view->full,
                                  {view->right.x - eye.x, view->right.y - eye.y},
                                  {view->left.x - eye.x, view->left.y - eye.y}};
    assert_ok(t->context, sl_query_look(t->context, t->query, view, NULL, t->seen, NULL));
    const uint32_t count =
        sl_runtime_look_past(r, &same, t->shut, t->range, t->scratch, t->cells, r->cell_count);
    memset(t->said, 0, r->cell_count * sizeof *t->said);
    for (uint32_t i = 0; i < count; i++) t->said[t->cells[i]] = true;
    t->asked++;
    for (uint32_t i = 0; i < r->cell_count; i++)
        if (t->said[i] != sl_eye_sees(t->seen, i))
            fail_msg("%s: (%.17g, %.17g)%s: cell %u is %s", t->f->name, eye.x, eye.y,
                     view->full ? "" : " with a cone", i, t->said[i] ? "added" : "missed");
}

static void look_from(trial *t, sl_point eye) {
    const sl_box *b = &t->f->baked.space.bounds;
    const double reach = fmin(b->max.x - b->min.x, b->max.y - b->min.y);
    sl_view view = sl_view_all_round(eye);
    if (sl_query_locate(t->query, eye) == SL_NO_CELL || reach < 1e-100) return;
    compare(t, &view);
    view = (sl_view){eye, false, runtime_border(&t->random, eye, reach),
                     runtime_border(&t->random, eye, reach)};
    if (!testing_same_point(view.left, eye) && !testing_same_point(view.right, eye))
        compare(t, &view);
}

static sl_point point_within(sl_random *random, const sl_box *b) {
    return (sl_point){b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                      b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
}

static void set_doors(trial *t) {
    const sl_map *map = &t->f->baked.map;
    for (uint32_t i = 0; i < t->f->runtime.door_count; i++) t->shut[i] = 0;
    sl_query_set_doors(t->context, t->query, true);
    sl_query_set_doors(t->context, t->open_sight, true);
    if (map->mirror_count) return; // the library refuses shut doors there
    for (uint32_t i = 0; i < t->f->runtime.door_count; i++) {
        const bool open = sl_random_below(&t->random, 2);
        assert_ok(t->context, sl_query_set_door(t->context, t->query, map->doors[i].name, open));
        assert_ok(t->context,
                  sl_query_set_door(t->context, t->open_sight, map->doors[i].name, open));
        for (uint32_t k = 0; k < t->f->runtime.door_count; k++)
            if (strcmp(map->doors[k].name, map->doors[i].name) == 0) t->shut[k] = !open;
    }
}

/// A corner or a place on a wall, a portal, a seam or the line of one.
static sl_point special_point(trial *t) {
    const sl_space *s = &t->f->baked.space;
    const sl_point v = s->vertices[sl_random_below(&t->random, s->vertex_count)];
    const sl_point w = s->vertices[sl_random_below(&t->random, s->vertex_count)];
    const double part = (double)sl_random_below(&t->random, 5) / 4;
    switch (sl_random_below(&t->random, 4)) {
    case 0:
        return v;
    case 1:
        if (s->seam_count) {
            const sl_segment at = s->seams[sl_random_below(&t->random, s->seam_count)].at;
            return runtime_between(at.a, at.b, part);
        }
        return (sl_point){v.x, w.y};
    case 2:
        return (sl_point){v.x, w.y};
    default:
        if (!s->portal_count) return v;
        const sl_portal *p = &s->portals[sl_random_below(&t->random, s->portal_count)];
        return runtime_between(p->left, p->right, part);
    }
}

/// Eyes in the middle of cells in view see nothing that is not in the set.
static void look_from_within(trial *t, const unsigned char *shut, uint32_t count,
                             const unsigned char *bits) {
    const sl_runtime *r = &t->f->runtime;
    uint32_t *seen = malloc(r->cell_count * sizeof *seen);
    assert_non_null(seen);
    for (uint32_t i = 0; i < count && i < 20; i++) {
        const sl_runtime_cell c = sl_runtime_get_cell(r, t->cells[i]);
        sl_runtime_view view = sl_runtime_view_all_round(0, 0);
        for (uint32_t k = 0; k < c.vertex_count; k++) {
            double x, y;
            sl_runtime_get_vertex(r, c.first_vertex + k, &x, &y);
            view.x += x / c.vertex_count;
            view.y += y / c.vertex_count;
        }
        // Far from the origin, rounding may leave the cell.
        if (sl_runtime_locate(r, view.x, view.y) != t->cells[i]) continue;
        const uint32_t more =
            sl_runtime_look_past(r, &view, shut, 0, t->scratch, seen, r->cell_count);
        for (uint32_t k = 0; k < more; k++) assert_true(bits[seen[k] / 8] >> seen[k] % 8 & 1);
    }
    free(seen);
}

/// What the cells in view see, against the pairs one by one.
static void seen_from_is_the_union(trial *t, sl_point eye) {
    const sl_runtime *r = &t->f->runtime;
    const size_t bytes = (r->cell_count + 7) / 8;
    unsigned char *bits = malloc(bytes + 1);
    assert_non_null(bits);
    const sl_runtime_view view = sl_runtime_view_all_round(eye.x, eye.y);
    const unsigned char *shut = sl_random_below(&t->random, 4) ? t->shut : NULL;
    const uint32_t count =
        sl_runtime_look_past(r, &view, shut, 0, t->scratch, t->cells, r->cell_count);
    memset(bits, 0xa5, bytes + 1);
    uint32_t seen = sl_runtime_seen_from(r, t->cells, count, shut, bits);
    assert_int_equal(bits[bytes], 0xa5);
    for (uint32_t to = 0; to < r->cell_count; to++) {
        bool is = false;
        for (uint32_t i = 0; i < count && !is; i++)
            is = sl_runtime_can_see_past(r, t->cells[i], to, shut);
        if (is != (bits[to / 8] >> to % 8 & 1))
            fail_msg("%s: (%.17g, %.17g): cell %u is %s", t->f->name, eye.x, eye.y, to,
                     is ? "missed" : "added");
        seen -= is;
    }
    assert_int_equal(seen, 0);
    look_from_within(t, shut, count, bits);
    for (size_t i = r->cell_count; i < 8 * bytes; i++) assert_false(bits[i / 8] >> i % 8 & 1);
    const uint32_t none[2] = {r->cell_count, SL_RUNTIME_NO_CELL};
    assert_int_equal(sl_runtime_seen_from(r, none, 2, shut, bits), 0);
    free(bits);
}

static size_t asked, seen_points[2], walks[2], steps[2];

/// A point on special places or near the eye, where the range decides.
static sl_point other_point(trial *t, sl_point eye) {
    const sl_box *b = &t->f->baked.space.bounds;
    const double range = t->f->runtime.range > 0 ? t->f->runtime.range : 1;
    const sl_point at[] = {{eye.x + range, eye.y}, {eye.x, nextafter(eye.y + range, INFINITY)}};
    const uint64_t kind = sl_random_below(&t->random, 5);
    if (kind < 2) return at[kind];
    return kind == 2 ? point_within(&t->random, b) : special_point(t);
}

static bool is_within(double a, double b, double c, double d) {
    return fmax(a, b) >= fmin(c, d) && fmax(c, d) >= fmin(a, b);
}

static bool touches(sl_point p, sl_point q, sl_point a, sl_point b) {
    return is_within(p.x, q.x, a.x, b.x) && is_within(p.y, q.y, a.y, b.y) &&
           sl_orient(p, q, a) * sl_orient(p, q, b) <= 0 &&
           sl_orient(a, b, p) * sl_orient(a, b, q) <= 0;
}

static bool wall_stops_steps(const sl_space *s, uint32_t wall) {
    for (uint32_t i = 0; i < s->passage_count; i++)
        if (s->passages[i].wall == wall) return s->passages[i].stops & SL_STOPS_STEPS;
    return true;
}

/// A step against all walls that stop steps, glass and shut doors.
static bool may_walk(const trial *t, sl_point p, sl_point q) {
    const sl_space *s = &t->f->baked.space;
    const uint32_t from = sl_space_locate(s, p), to = sl_space_locate(s, q);
    if (from == SL_NO_CELL || to == SL_NO_CELL || s->cells[from].solid) return false;
    for (uint32_t i = 0; i < s->wall_count; i++)
        if (touches(p, q, s->walls[i].a, s->walls[i].b) && wall_stops_steps(s, i)) return false;
    for (uint32_t i = 0; i < s->seam_count; i++) {
        const sl_seam *seam = &s->seams[i];
        const bool stops = seam->kind == SL_SEAM_ONEWAY ||
                           (seam->kind == SL_SEAM_DOOR && t->shut[seam->number]) ||
                           ((seam->kind == SL_SEAM_PLAIN || seam->kind == SL_SEAM_LIMITED) &&
                            t->f->baked.map.seams[seam->number].stops & SL_STOPS_STEPS);
        if (stops && touches(p, q, seam->at.a, seam->at.b)) return false;
    }
    return true;
}

static void compare_steps(const trial *t, sl_point p, sl_point q) {
    const bool walk = sl_runtime_can_walk(&t->f->runtime, p.x, p.y, q.x, q.y, t->shut);
    if (walk != may_walk(t, p, q))
        fail_msg("%s: (%.17g, %.17g) to (%.17g, %.17g) is %s", t->f->name, p.x, p.y, q.x, q.y,
                 walk ? "no way" : "a way");
    steps[walk]++;
}

/// Two points against the library: sight, and steps by open sight, which touches nothing.
static void compare_points(trial *t, sl_point p, sl_point q) {
    const sl_runtime *r = &t->f->runtime;
    const bool sees = sl_runtime_sees(r, p.x, p.y, q.x, q.y, t->shut, 0, t->scratch);
    bool expected, is_free;
    assert_ok(t->context, sl_query_sees(t->context, t->query, p, q, &expected));
    if (expected != sees)
        fail_msg("%s: (%.17g, %.17g) to (%.17g, %.17g) is %s", t->f->name, p.x, p.y, q.x, q.y,
                 sees ? "added" : "missed");
    seen_points[sees]++;
    const bool walk = sl_runtime_can_walk(r, p.x, p.y, q.x, q.y, t->shut);
    assert_int_equal(sl_runtime_can_walk(r, q.x, q.y, p.x, p.y, t->shut), walk);
    assert_ok(t->context, sl_query_sees(t->context, t->open_sight, p, q, &is_free));
    // The range is of sight, not of steps, and so are some walls.
    if (r->range > 0 || sl_map_partial_walls(&t->f->baked.map)) return;
    // Glass is a wall to who walks.
    if (walk != is_free && (walk || !t->f->baked.map.oneway_count))
        fail_msg("%s: (%.17g, %.17g) to (%.17g, %.17g) is %s", t->f->name, p.x, p.y, q.x, q.y,
                 walk ? "no way" : "a way");
    walks[walk]++;
}

static void looks_are_the_same(const baked_file *f) {
    sl_context *context = testing_context(NULL);
    const sl_map *map = &f->baked.map;
    if (!(map->mirror_count && map->oneway_count)) { // that the library refuses
        trial t = trial_of(context, f);
        for (uint64_t i = 0; i < eyes; i++) {
            if (i % 50 == 0) set_doors(&t);
            if (i % 10 == 0)
                seen_from_is_the_union(&t, point_within(&t.random, &f->baked.space.bounds));
            const sl_point eye =
                i % 4 ? special_point(&t) : point_within(&t.random, &f->baked.space.bounds);
            for (int k = 0; k < 3; k++) {
                const sl_point other = other_point(&t, eye);
                compare_points(&t, eye, other);
                compare_steps(&t, eye, other);
                compare_steps(&t, eye, runtime_between(eye, other, 0.125)); // few cells
                compare_steps(&t, runtime_between(eye, other, 0.5),
                              runtime_between(eye, other, 0.25));
            }
            look_from(&t,
                      i % 4 ? special_point(&t) : point_within(&t.random, &f->baked.space.bounds));
        }
        asked += t.asked;
        trial_end(&t);
    }
    sl_context_destroy(context);
}

static void on_every_map(void **state) {
    (void)state;
    asked = 0;
    baked_file_each(looks_are_the_same);
    print_message("%zu views\n", asked);
    assert_true(asked > 1000);
    assert_true(seen_points[0] > 1000 && seen_points[1] > 1000);
    assert_true(walks[0] > 1000 && walks[1] > 1000);
    assert_true(steps[0] > 1000 && steps[1] > 1000);
}

static void on_turned_maps(void **state) {
    (void)state;
    static const char *const names[] = {"office", "gallery", "oblique/star"};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < 3; i++) {
        baked_file f = baked_file_turned(context, names[i], 17.3, 0);
        looks_are_the_same(&f);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

// --- random maps with doors and glass on a grid, where eyes meet many lines

enum { SIZE = 12, MAPS = 60, DOORS = 4, GLASS = 6 };

/// A place on the grid; turned by an angle that leaves coordinates whole, so lines stay lines.
static sl_point on_grid(sl_point p, bool oblique) {
    return oblique ? (sl_point){4 * p.x - 3 * p.y, 3 * p.x + 4 * p.y} : p;
}

static sl_segment random_segment(sl_random *random, bool oblique) {
    const bool upright = sl_random_below(random, 2), turned = sl_random_below(random, 2);
    const double at = (double)sl_random_below(random, SIZE + 1);
    const double from = (double)sl_random_below(random, SIZE);
    const double to = fmin(from + 1 + (double)sl_random_below(random, 4), SIZE);
    const sl_point a = upright ? (sl_point){at, from} : (sl_point){from, at};
    const sl_point b = upright ? (sl_point){at, to} : (sl_point){to, at};
    const sl_segment s = {on_grid(a, oblique), on_grid(b, oblique)};
    return turned ? (sl_segment){s.b, s.a} : s;
}

static void random_map(sl_context *context, sl_random *random, bool oblique, sl_map *map) {
    const sl_point c[5] = {{0, 0}, {SIZE, 0}, {SIZE, SIZE}, {0, SIZE}, {0, 0}};
    for (int i = 0; i < 4; i++)
        assert_ok(context, sl_map_add_wall(context, map, on_grid(c[i], oblique),
                                           on_grid(c[i + 1], oblique), 0));
    for (int i = 0; i < 10; i++) {
        const sl_segment at = random_segment(random, oblique);
        assert_ok(context, sl_map_add_wall(context, map, at.a, at.b, 0));
    }
    for (int i = 0; i < DOORS; i++) {
        const char name[2] = {(char)('a' + i), 0};
        assert_ok(context,
                  sl_map_add_door(context, map, name, random_segment(random, oblique), true, 0));
    }
    for (int i = 0; i < GLASS; i++)
        assert_ok(context, sl_map_add_oneway(context, map, random_segment(random, oblique), 0));
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
}

/// Baked as the program does it: rows know glass.
static baked_file bake(sl_context *context, sl_map *map) {
    const sl_bake_options options = sl_bake_options_default();
    baked_file f = {.name = "bake"};
    assert_ok(context, sl_bake(context, map, &options, &f.baked, NULL));
    f.bytes = baked_bytes(context, &f.baked, &f.size);
    baked_file_open(&f);
    return f;
}

static void try_random_maps(bool oblique) {
    sl_context *context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= testing_seeds(MAPS); seed++) {
        sl_random random = {seed};
        baked_file f = {.name = "random", .baked = {.method = "dfs", .solver = "funnel"}};
        random_map(context, &random, oblique, &f.baked.map);
        if (seed % 2)
            baked_file_make(context, &f, false);
        else
            f = bake(context, &f.baked.map);
        looks_are_the_same(&f);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

static void past_doors_and_glass(void **state) {
    (void)state;
    try_random_maps(false);
}

static void past_oblique_doors_and_glass(void **state) {
    (void)state;
    try_random_maps(true);
}

// --- by hand

static uint32_t cells_seen(const baked_file *f, double x, double y, double range) {
    uint32_t scratch[256], cells[32];
    const sl_runtime_view view = sl_runtime_view_all_round(x, y);
    assert_true(sl_runtime_scratch_count(&f->runtime) <= 256);
    return sl_runtime_look_past(&f->runtime, &view, NULL, range, scratch, cells, 32);
}

/// The first glass is seen through from the left room only, the second one from the middle only.
static void glass_is_dark_from_one_side(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(
        context, "walls 0 0 30 0 30 10 0 10 0 0\nwall 10 0 10 1\noneway 10 1 10 3\n"
                 "wall 10 3 10 8\noneway 10 9 10 8\nwall 10 9 10 10\nwall 20 0 20 1\n"
                 "wall 20 3 20 10\n");
    looks_are_the_same(&f);
    baked_file_destroy(context, &f);
    f = baked_file_of_text(context, "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\n"
                                    "oneway 10 4 10 6\nwall 10 6 10 10\n");
    assert_int_equal(f.runtime.cell_count, 2);
    assert_int_equal(cells_seen(&f, 5, 5, 0), 1);
    assert_int_equal(cells_seen(&f, 15, 5, 0), 2);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// An eye on glass sees along it, past the end of a wall, into a cell that the rows of its own
/// cells lack: from the cells below, nobody looks through the glass.
static void along_glass_the_rows_hide_nothing(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    static const char text[] = "sightline 1\nwalls 0 0 10 0 10 10 0 10 0 0\nwall 8 5 8 10\n"
                               "oneway 10 5 2 5\nstart 5 5 0\n";
    sl_map map = {0};
    assert_ok(context, sli_map_read_text(context, "text", text, strlen(text), &map));
    baked_file f = bake(context, &map);
    const sl_runtime *r = &f.runtime;
    const uint32_t behind = sl_runtime_locate(r, 9, 8), own = sl_runtime_locate(r, 6, 5);
    const sl_runtime_view view = sl_runtime_view_all_round(6, 5);
    const sl_runtime_box box = {8.5, 5, 9, 6, false};
    sl_runtime_box list[1];
    sl_runtime_boxes boxes;
    uint32_t memory[128], scratch[512], cells[16];
    unsigned char seen;
    assert_true(sl_runtime_boxes_count(r, 1, 8) <= 128 && r->cell_count <= 16);
    sl_runtime_boxes_start(&boxes, r, list, 1, 8, memory);
    assert_true(sl_runtime_boxes_move(&boxes, 0, &box));
    assert_true(sl_runtime_boxes_scratch_count(&boxes) <= 512);
    assert_false(sl_runtime_can_see(r, own, behind));
    const uint32_t count = sl_runtime_look(r, &view, scratch, cells, 16);
    bool found = false;
    for (uint32_t i = 0; i < count; i++) found |= cells[i] == behind;
    assert_true(found);
    assert_int_equal(sl_runtime_boxes_seen(&boxes, &view, NULL, 0, scratch, &seen), 1);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// A hall of many cells, more than are listed of a line that touches ends of walls, and a wall in
/// it near its end.
static void a_long_line_meets_a_wall_far_away(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char text[1000] = "walls 0 0 100 0 100 10 0 10 0 0\nwall 97 4 97 6\n";
    for (int x = 2; x < 96; x += 2) {
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "wall %d 0 %d 1\n", x, x);
    }
    baked_file f = baked_file_of_text(context, text);
    assert_true(f.runtime.cell_count > 40);
    assert_false(sl_runtime_can_walk(&f.runtime, 1, 5, 99, 5, NULL));
    assert_false(sl_runtime_can_walk(&f.runtime, 99, 5, 1, 5, NULL));
    assert_true(sl_runtime_can_walk(&f.runtime, 1, 8, 99, 8, NULL));
    uint32_t *scratch = malloc(sl_runtime_scratch_count(&f.runtime) * sizeof *scratch);
    assert_non_null(scratch);
    for (int touching = 0; touching < 2; touching++) {
        const double y = touching ? 1 : 5; // of 1, the ends of all walls
        memset(scratch, 0xff, sl_runtime_scratch_count(&f.runtime) * sizeof *scratch);
        assert_int_equal(sl_runtime_sees(&f.runtime, 1, y, 99, y, NULL, 0, scratch), touching);
        assert_int_equal(sl_runtime_sees(&f.runtime, 99, y, 1, y, NULL, 0, scratch), touching);
        assert_true(sl_runtime_sees(&f.runtime, 1, y, 97, y, NULL, 0, scratch));
        assert_false(sl_runtime_can_walk(&f.runtime, 1, y, 99, y, NULL));
    }
    free(scratch);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// The map's own range holds without a word, and a larger one changes nothing.
static void the_range_of_the_level_counts(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\n"
                                               "wall 10 6 10 10\nrange 4\n");
    assert_true(f.runtime.range == 4);
    assert_int_equal(cells_seen(&f, 5, 5, 0), 1);
    assert_int_equal(cells_seen(&f, 5, 5, 9), 1);
    assert_int_equal(cells_seen(&f, 7, 5, 0), 2);
    assert_int_equal(cells_seen(&f, 7, 5, 2), 1);
    baked_file_destroy(context, &f);
    f = baked_file_of_text(context, "walls 0 0 20 0 20 10 0 10 0 0\n");
    assert_true(f.runtime.range == 0);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(glass_is_dark_from_one_side),
        cmocka_unit_test(along_glass_the_rows_hide_nothing),
        cmocka_unit_test(a_long_line_meets_a_wall_far_away),
        cmocka_unit_test(the_range_of_the_level_counts),
        cmocka_unit_test(past_doors_and_glass),
        cmocka_unit_test(past_oblique_doors_and_glass),
        cmocka_unit_test(on_every_map),
        cmocka_unit_test(on_turned_maps),
    };
    if (argc == 2) eyes = strtoull(argv[1], NULL, 10);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
