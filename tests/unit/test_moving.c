/// Boxes that move, against brute force on spaces that are subdivided anew with the boxes in them,
/// on random maps; and by hand where they touch, overlap, hold the eye or have no area.
/// SIGHTLINE_SEEDS in the environment: how many maps (16 by default).
#include "sight/cone.h"
#include "sight/moving.h"
#include "sight/region.h"
#include "space/subdivide.h"
#include "testing.h"

#include "oracle/eye.h"
#include "oracle/isovist.h"
#include "oracle/random_map.h"

#include <math.h>

enum { EYES = 3, VIEWS = 2, BOXES = 4, CELLS_MOST = 64 };

typedef struct trial {
    sl_context *context;
    uint64_t seed;
    sl_random random;
    sl_map map;
    sl_space space;
    sl_visibility baked;
    sl_moving_box boxes[BOXES];
    size_t count;
    sli_moving *moving;
    sl_space fresh; ///< subdivided anew; cells end where those of `space` and the boxes do
    size_t cells_seen, cells_asked, boxes_seen, boxes_asked;
} trial;

static uint64_t below(trial *t, uint64_t bound) {
    return sl_random_below(&t->random, bound);
}

// --- spaces

static double random_coordinate(trial *t, double low, double high) {
    // On the map's own lines, on halves between them, or a little out of bounds.
    const double share = ((double)below(t, 37) - 2) / 32;
    const sl_point at = t->space.vertices[below(t, t->space.vertex_count)];
    if (below(t, 2)) return low + (high - low) * share;
    return below(t, 2) && at.x >= low && at.x <= high ? at.x : at.y;
}

static sl_box random_box(trial *t) {
    const sl_box b = t->space.bounds;
    const double x0 = random_coordinate(t, b.min.x, b.max.x);
    const double y0 = random_coordinate(t, b.min.y, b.max.y);
    double x1 = random_coordinate(t, b.min.x, b.max.x);
    double y1 = random_coordinate(t, b.min.y, b.max.y);
    const uint64_t flat = below(t, 12);
    if (flat < 2) x1 = x0;
    if (flat == 1 || flat == 2) y1 = y0;
    return (sl_box){{fmin(x0, x1), fmin(y0, y1)}, {fmax(x0, x1), fmax(y0, y1)}};
}

static sl_box clip(sl_box box, sl_box bounds) {
    return (sl_box){{fmax(box.min.x, bounds.min.x), fmax(box.min.y, bounds.min.y)},
                    {fmin(box.max.x, bounds.max.x), fmin(box.max.y, bounds.max.y)}};
}

/// The sides of a box within the bounds, those of positive length.
static unsigned sides_within(const trial *t, sl_box box, sl_segment sides[4]) {
    const sl_box b = clip(box, t->space.bounds);
    if (b.min.x > b.max.x || b.min.y > b.max.y) return 0;
    const sl_point c[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
    // Clipped sides are the border's, but where they are the box's own.
    const bool own[4] = {box.min.y == b.min.y, box.max.x == b.max.x, box.max.y == b.max.y,
                         box.min.x == b.min.x};
    unsigned count = 0;
    for (int i = 0; i < 4; i++) {
        const sl_segment side = {c[i], c[(i + 1) % 4]};
        if (own[i] && (side.a.x != side.b.x || side.a.y != side.b.y)) sides[count++] = side;
    }
    return count;
}

/// The map with the boxes' sides as walls, or as seams where they do not block; `without` blocks
/// not. Seams run along all portals of the space, so that no cell reaches over one of its cells.
static void subdivide_anew(trial *t, size_t without, sl_space *out) {
    sl_context *context = t->context;
    sl_map map = {0};
    for (uint32_t i = 0; i < t->space.wall_count; i++)
        assert_ok(context,
                  sl_map_add_wall(context, &map, t->space.walls[i].a, t->space.walls[i].b, 0));
    // The bounds stay, whatever the walls are.
    for (size_t i = 0; i < t->count; i++) {
        sl_segment sides[4];
        const unsigned count = sides_within(t, t->boxes[i].box, sides);
        for (unsigned k = 0; k < count; k++)
            if (t->boxes[i].blocks && i != without)
                assert_ok(context, sl_map_add_wall(context, &map, sides[k].a, sides[k].b, 0));
            else
                assert_ok(context, sl_map_add_seam(context, &map, sides[k], 0));
    }
    for (uint32_t i = 0; i < t->space.portal_count; i++)
        assert_ok(context,
                  sl_map_add_seam(context, &map,
                                  (sl_segment){t->space.portals[i].left, t->space.portals[i].right},
                                  0));
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    const sl_subdivide_options options = sl_subdivide_options_default();
    assert_ok(context, sli_subdivide_kd(context, &map, &options, out));
    testing_take_inside(&t->space, out);
    sl_map_destroy(context, &map);
}

static sl_box box_of(const sl_space *space, uint32_t cell) {
    const sl_point *v = space->vertices + space->cells[cell].first_vertex;
    return (sl_box){v[0], v[2]};
}

static bool within(sl_box inner, sl_box outer) {
    return inner.min.x >= outer.min.x && inner.min.y >= outer.min.y && inner.max.x <= outer.max.x &&
           inner.max.y <= outer.max.y;
}

static bool touch(sl_box a, sl_box b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

static bool holds(sl_box box, sl_point p) {
    return touch(box, (sl_box){p, p});
}

// --- what is said, and what is so

static void complain(const trial *t, const sl_view *view, const char *what, size_t number,
                     bool said) {
    for (uint32_t i = 0; i < t->space.wall_count; i++) {
        const sl_wall *w = &t->space.walls[i];
        print_error("wall %.17g %.17g %.17g %.17g\n", w->a.x, w->a.y, w->b.x, w->b.y);
    }
    for (size_t i = 0; i < t->count; i++) {
        const sl_box b = t->boxes[i].box;
        print_error("box %.17g %.17g %.17g %.17g%s\n", b.min.x, b.min.y, b.max.x, b.max.y,
                    t->boxes[i].blocks ? " block" : "");
    }
    print_error("eye %.17g,%.17g", view->eye.x, view->eye.y);
    if (!view->full)
        print_error(" right %.17g,%.17g left %.17g,%.17g", view->right.x, view->right.y,
                    view->left.x, view->left.y);
    fail_msg("\nseed %llu, %s sight: %s %zu is said to be %s", (unsigned long long)t->seed,
             t->baked.sight == SL_OPEN ? "open" : "closed", what, number, said ? "seen" : "hidden");
}

/// What brute force sees in a space: by its cells.
static void ask_oracle(const trial *t, const sl_space *space, const sl_view *view, bool *sees) {
    const sl_point borders[2] = {view->right, view->left};
    bool *closed = calloc(space->cell_count, sizeof *closed);
    bool *open = calloc(space->cell_count, sizeof *open);
    assert_true(closed && open);
    oracle_eye *oracle = oracle_eye_create(space, view->eye, borders, view->full ? 0 : 2);
    oracle_eye_sees(oracle, view, closed, open);
    oracle_eye_destroy(oracle);
    memcpy(sees, t->baked.sight == SL_OPEN ? open : closed, space->cell_count * sizeof *sees);
    free(closed);
    free(open);
}

/// Whether the oracle can tell of a box: it has an inside, and nothing that blocks touches it.
static bool can_judge(const trial *t, size_t number) {
    const sl_box b = clip(t->boxes[number].box, t->space.bounds);
    if (!(b.min.x < b.max.x && b.min.y < b.max.y)) return false;
    for (size_t i = 0; i < t->count; i++)
        if (i != number && t->boxes[i].blocks && touch(t->boxes[i].box, t->boxes[number].box))
            return false;
    return true;
}

/// Whether a box is seen: whether the eye, or something that it sees when the box does not block,
/// is inside.
static void judge_box(trial *t, const sl_view *view, size_t number, bool said) {
    sl_space through = {0};
    bool sees[CELLS_MOST];
    subdivide_anew(t, number, &through);
    if (through.cell_count <= CELLS_MOST) {
        ask_oracle(t, &through, view, sees);
        bool expected = holds(t->boxes[number].box, view->eye);
        for (uint32_t c = 0; c < through.cell_count; c++)
            expected |= sees[c] && within(box_of(&through, c), t->boxes[number].box);
        if (said != expected) complain(t, view, "box", number, said);
        t->boxes_seen += expected;
        t->boxes_asked++;
    }
    sl_space_destroy(t->context, &through);
}

/// `cut`: a space with the boxes, the cells of which are parts of the space's.
static void compare_cells(trial *t, const sl_space *cut, const sl_view *view,
                          const uint64_t *cells) {
    bool sees[4 * CELLS_MOST], expected[CELLS_MOST] = {false};
    assert_true(cut->cell_count <= 4 * CELLS_MOST);
    ask_oracle(t, cut, view, sees);
    for (uint32_t f = 0; f < cut->cell_count; f++)
        for (uint32_t c = 0; c < t->space.cell_count; c++)
            expected[c] |= sees[f] && within(box_of(cut, f), box_of(&t->space, c));
    for (uint32_t c = 0; c < t->space.cell_count; c++) {
        if (sl_eye_sees(cells, c) != expected[c]) complain(t, view, "cell", c, !expected[c]);
        t->cells_seen += expected[c];
        t->cells_asked++;
    }
}

static void compare_region(trial *t, const sl_view *view) {
    const sl_outline *outline;
    sl_region region = {0};
    const oracle_isovist isovist = oracle_isovist_of(&t->fresh, view);
    assert_ok(t->context, sli_moving_outline(t->context, t->moving, &outline));
    assert_ok(t->context, sli_region_make(t->context, outline, view, 0, &region));
    const double area = sl_region_area(&region);
    if (!(fabs(area - isovist.area) <= 1e-9 * isovist.area)) {
        print_error("area %.17g, not %.17g\n", area, isovist.area);
        complain(t, view, "area", 0, true);
    }
    sl_region_destroy(t->context, &region);
}

static sl_point random_eye(trial *t) {
    const sl_box b = t->space.bounds, box = t->boxes[below(t, t->count)].box;
    const double x = (double)below(t, 33) / 32, y = (double)below(t, 33) / 32;
    sl_point p = {b.min.x + (b.max.x - b.min.x) * x, b.min.y + (b.max.y - b.min.y) * y};
    const uint64_t kind = below(t, 5);
    if (kind == 0) p = t->space.vertices[below(t, t->space.vertex_count)];
    if (kind == 1)
        p = (sl_point){below(t, 2) ? box.min.x : box.max.x, below(t, 2) ? box.min.y : box.max.y};
    if (kind == 2) p = (sl_point){(box.min.x + box.max.x) / 2, below(t, 2) ? box.min.y : box.max.y};
    return p;
}

static sl_view random_view(trial *t, sl_point eye, bool full) {
    sl_view view = sl_view_all_round(eye);
    while (!full && view.full) {
        const sl_view cone = {eye, false, t->space.vertices[below(t, t->space.vertex_count)],
                              t->space.vertices[below(t, t->space.vertex_count)]};
        if (sli_view_usable(&cone)) view = cone;
    }
    return view;
}

/// Whether what closed sight sees from here is a matter of how the space is cut, since cells count
/// that a line passes at the eye itself: whether the eye is on a border of its cell.
static bool is_on_border(const trial *t, sl_point eye) {
    const sl_box box = box_of(&t->fresh, sl_space_locate(&t->fresh, eye));
    return eye.x == box.min.x || eye.y == box.min.y || eye.x == box.max.x || eye.y == box.max.y;
}

static void try_eye(trial *t) {
    sl_point eye;
    do eye = random_eye(t);
    while (sl_space_locate(&t->space, eye) == SL_NO_CELL);
    const bool by_cut = t->baked.sight == SL_CLOSED && is_on_border(t, eye);
    const sl_space *cut = by_cut ? sli_moving_space(t->moving, NULL) : &t->fresh;
    for (int i = 0; i < VIEWS; i++) {
        const sl_view view = random_view(t, eye, i == 0);
        uint64_t cells[CELLS_MOST / 64 + 1];
        bool seen[BOXES];
        sl_eye_account account;
        assert_ok(t->context, sli_moving_look(t->context, t->moving, &view, cells, seen, &account));
        compare_cells(t, cut, &view, cells);
        if (i == 0) compare_region(t, &view);
        for (size_t k = 0; k < t->count && i == 0 && !by_cut; k++)
            if (can_judge(t, k)) judge_box(t, &view, k, seen[k]);
    }
}

// --- random maps

static void bake(trial *t, sl_sight sight) {
    size_t count;
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.threads = 1;
    options.sight = sight;
    assert_ok(t->context, sl_see_methods(&count)->see(t->context, &t->space, &options, &t->baked));
}

static void try_boxes(trial *t) {
    t->count = 1 + below(t, BOXES);
    for (size_t i = 0; i < t->count; i++)
        t->boxes[i] = (sl_moving_box){random_box(t), below(t, 3) > 0};
    if (t->count > 1 && below(t, 4) == 0) t->boxes[1].box = t->boxes[0].box;
    assert_ok(t->context, sli_moving_set_boxes(t->context, t->moving, t->boxes, t->count));
    assert_ok(t->context, sl_space_check(t->context, sli_moving_space(t->moving, NULL)));
    subdivide_anew(t, SIZE_MAX, &t->fresh);
    if (t->fresh.cell_count <= CELLS_MOST)
        for (int i = 0; i < EYES; i++) try_eye(t);
    sl_space_destroy(t->context, &t->fresh);
}

static void try_map(trial *t, sl_sight sight) {
    const oracle_grid grid = (oracle_grid)(t->seed % 3);
    assert_ok(t->context, oracle_random_map(t->context, t->seed, grid, &t->map));
    assert_ok(t->context, sl_map_clean(t->context, &t->map, NULL, NULL));
    const sl_subdivide_options options = sl_subdivide_options_default();
    t->random = (sl_random){t->seed ^ 0xb0e5};
    if (t->map.wall_count)
        assert_ok(t->context, sli_subdivide_kd(t->context, &t->map, &options, &t->space));
    if (t->space.cell_count && t->space.cell_count <= CELLS_MOST) {
        bake(t, sight);
        assert_ok(t->context, sli_moving_create(t->context, &t->space, &t->baked, &t->moving));
        for (int i = 0; i < 2; i++) try_boxes(t); // placed, and placed anew
        sli_moving_destroy(t->context, t->moving);
    }
    sl_visibility_destroy(t->context, &t->baked);
    sl_space_destroy(t->context, &t->space);
    sl_map_destroy(t->context, &t->map);
}

static void random_maps(sl_sight sight) {
    const uint64_t seeds = testing_seeds(16);
    trial t = {.context = testing_context(NULL)};
    for (t.seed = 1; t.seed <= seeds; t.seed++) try_map(&t, sight);
    print_message("%zu of %zu cells, %zu of %zu boxes seen\n", t.cells_seen, t.cells_asked,
                  t.boxes_seen, t.boxes_asked);
    assert_true(t.cells_seen > 0 && t.cells_seen < t.cells_asked);
    assert_true(t.boxes_seen > 0 && t.boxes_seen < t.boxes_asked);
    sl_context_destroy(t.context);
}

static void closed_sight(void **state) {
    (void)state;
    random_maps(SL_CLOSED);
}

static void open_sight(void **state) {
    (void)state;
    random_maps(SL_OPEN);
}

// --- by hand

typedef struct room {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_visibility bare;
    sli_moving *moving;
} room;

static void enter(room *r, const char *statements) {
    *r = (room){.context = testing_context(NULL), .bare = {.sight = SL_CLOSED}};
    testing_space(r->context, statements, &r->map, &r->space);
    assert_ok(r->context, sli_moving_create(r->context, &r->space, &r->bare, &r->moving));
}

static void leave(room *r) {
    sli_moving_destroy(r->context, r->moving);
    sl_space_destroy(r->context, &r->space);
    sl_map_destroy(r->context, &r->map);
    sl_context_destroy(r->context);
}

/// The boxes seen, as digits of their numbers from 1 on.
static int look(room *r, sl_point eye, const sl_moving_box *boxes, size_t count) {
    const sl_view view = sl_view_all_round(eye);
    uint64_t cells[16];
    bool seen[8];
    sl_eye_account account;
    assert_ok(r->context, sli_moving_set_boxes(r->context, r->moving, boxes, count));
    assert_ok(r->context, sl_space_check(r->context, sli_moving_space(r->moving, NULL)));
    assert_ok(r->context, sli_moving_look(r->context, r->moving, &view, cells, seen, &account));
    int digits = 0;
    for (size_t i = 0; i < count; i++)
        if (seen[i]) digits = 10 * digits + (int)i + 1;
    return digits;
}

static const char two_rooms[] = "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n";

static void one_hides_another(void **state) {
    (void)state;
    room r;
    enter(&r, two_rooms);
    const sl_point eye = {2, 5};
    const sl_moving_box small = {{{14, 4}, {15, 6}}, true}, wide = {{{11, 3}, {12, 7}}, true};
    const sl_moving_box glass = {wide.box, false}, corner = {{{14, 0}, {15, 1}}, true};
    assert_int_equal(look(&r, eye, (sl_moving_box[]){small}, 1), 1);
    assert_int_equal(look(&r, eye, (sl_moving_box[]){small, wide}, 2), 2);
    assert_int_equal(look(&r, eye, (sl_moving_box[]){small, glass}, 2), 12);
    assert_int_equal(look(&r, eye, (sl_moving_box[]){corner}, 1), 0);
    // Shut in by a box that fills the doorway and no more, touching its ends.
    const sl_moving_box plug = {{{10, 4}, {10, 6}}, true}, behind = {{{10, 4}, {11, 6}}, false};
    assert_int_equal(look(&r, eye, (sl_moving_box[]){plug, small}, 2), 1);
    assert_int_equal(look(&r, eye, (sl_moving_box[]){behind, small}, 2), 12);
    assert_int_equal(look(&r, eye, NULL, 0), 0);
    leave(&r);
}

static void boxes_without_area(void **state) {
    (void)state;
    room r;
    enter(&r, two_rooms);
    const sl_point eye = {2, 5};
    const sl_moving_box points[] = {
        {{{15, 5}, {15, 5}}, true}, {{{15, 1}, {15, 1}}, false}, {{{2, 5}, {2, 5}}, true}};
    assert_int_equal(look(&r, eye, points, 3), 13);
    // At just the range a point is seen with closed sight alone.
    sli_moving_set_range(r.moving, 13);
    assert_int_equal(look(&r, eye, points, 3), 13);
    r.bare.sight = SL_OPEN;
    assert_int_equal(look(&r, eye, points, 3), 3);
    sli_moving_set_range(r.moving, 13.5);
    assert_int_equal(look(&r, eye, points, 3), 13);
    sli_moving_set_range(r.moving, 0);
    r.bare.sight = SL_CLOSED;
    // A line seen edge-on is touched by closed sight, and hides nothing.
    const sl_moving_box across = {{{12, 4}, {12, 6}}, true}, along = {{{12, 5}, {14, 5}}, true};
    const sl_moving_box far = {{{16, 4.5}, {17, 5.5}}, true};
    assert_int_equal(look(&r, eye, (sl_moving_box[]){across, far}, 2), 1);
    assert_int_equal(look(&r, eye, (sl_moving_box[]){along, far}, 2), 12);
    r.bare.sight = SL_OPEN;
    assert_int_equal(look(&r, eye, (sl_moving_box[]){along, far}, 2), 2);
    assert_int_equal(look(&r, (sl_point){2, 5.5}, (sl_moving_box[]){along, far}, 2), 12);
    // On a wall there is nothing to be seen of it, nor out of bounds.
    const sl_moving_box walled = {{{10, 1}, {10, 3}}, true}, outside = {{{21, 4}, {22, 6}}, true};
    assert_int_equal(look(&r, eye, (sl_moving_box[]){walled, outside}, 2), 0);
    leave(&r);
}

static void from_within_a_box(void **state) {
    (void)state;
    room r;
    enter(&r, two_rooms);
    const sl_moving_box around = {{{1, 4}, {3, 6}}, true}, inner = {{{2.5, 4}, {3, 5}}, true};
    const sl_moving_box other = {{{5, 4}, {6, 6}}, true};
    assert_int_equal(look(&r, (sl_point){2, 5}, (sl_moving_box[]){around, inner, other}, 3), 12);
    const sl_outline *outline;
    sl_region region = {0};
    const sl_view view = sl_view_all_round((sl_point){2, 5});
    assert_ok(r.context, sli_moving_outline(r.context, r.moving, &outline));
    assert_ok(r.context, sli_region_make(r.context, outline, &view, 0, &region));
    assert_true(fabs(sl_region_area(&region) - 3.5) < 1e-12);
    sl_region_destroy(r.context, &region);
    leave(&r);
}

static void cells_that_a_box_lies_in(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space = {0};
    uint64_t cells[4];
    testing_space(context, "walls 0 0 8 0 8 8 0 8 0 0\nwall 4 0 4 8\n", &map, &space);
    assert_int_equal(space.cell_count, 2);
    const uint32_t left = sl_space_locate(&space, (sl_point){1, 1});
    sl_cells_of_box(&space, (sl_box){{1, 1}, {2, 2}}, cells);
    assert_int_equal(cells[0], 1 << left);
    sl_cells_of_box(&space, (sl_box){{1, 1}, {4, 2}}, cells); // touches the other
    assert_int_equal(cells[0], 3);
    sl_cells_of_box(&space, (sl_box){{1, 1}, {nextafter(4, 0), 2}}, cells);
    assert_int_equal(cells[0], 1 << left);
    sl_cells_of_box(&space, (sl_box){{9, 1}, {9, 1}}, cells);
    assert_int_equal(cells[0], 0);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    // An oblique wall, touched by a corner and missed by a last bit.
    sl_map oblique = {0};
    const sl_point c[5] = {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}};
    for (int i = 0; i < 4; i++)
        assert_ok(context, sl_map_add_wall(context, &oblique, c[i], c[i + 1], 0));
    assert_ok(context, sl_map_add_wall(context, &oblique, c[0], c[2], 0));
    assert_ok(context, sl_map_clean(context, &oblique, NULL, NULL));
    assert_ok(context, sli_subdivide_mesh(context, &oblique, &space));
    assert_int_equal(space.cell_count, 2);
    const uint32_t under = sl_space_locate(&space, (sl_point){7, 1});
    sl_cells_of_box(&space, (sl_box){{3, 1}, {4, 3}}, cells);
    assert_int_equal(cells[0], 3);
    sl_cells_of_box(&space, (sl_box){{nextafter(3, 4), 1}, {4, 3}}, cells);
    assert_int_equal(cells[0], 1 << under);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &oblique);
    sl_context_destroy(context);
}

static void wrong_boxes(void **state) {
    (void)state;
    room r;
    enter(&r, two_rooms);
    const sl_moving_box good = {{{1, 1}, {2, 2}}, true};
    const sl_moving_box bad[] = {{{{2, 1}, {1, 2}}, true},
                                 {{{1, 1}, {2, (double)NAN}}, true},
                                 {{{1e-200, 1}, {2, 2}}, true},
                                 {{{1, 1}, {1e200, 2}}, true}};
    assert_int_equal(look(&r, (sl_point){5, 5}, &good, 1), 1);
    const uint32_t cells = sli_moving_space(r.moving, NULL)->cell_count;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(sli_moving_set_boxes(r.context, r.moving, &bad[i], 1), SL_BAD_ARGUMENT);
    assert_int_equal(sli_moving_space(r.moving, NULL)->cell_count, cells);
    leave(&r);
}

static void no_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    sl_space space = {0};
    const sl_visibility bare = {.sight = SL_CLOSED};
    const sl_moving_box boxes[] = {{{{1, 1}, {12, 5}}, true}, {{{3, 2}, {4, 11}}, false}};
    testing_space(context, two_rooms, &map, &space);
    const long before = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long fail = 1; status != SL_OK; fail++) {
        sli_moving *moving = NULL;
        memory.calls = 0;
        memory.fail_at = fail;
        status = sli_moving_create(context, &space, &bare, &moving);
        if (status == SL_OK) status = sli_moving_set_boxes(context, moving, boxes, 2);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        memory.fail_at = 0;
        sli_moving_destroy(context, moving);
        assert_int_equal(memory.live, before);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_hides_another), cmocka_unit_test(boxes_without_area),
        cmocka_unit_test(from_within_a_box), cmocka_unit_test(cells_that_a_box_lies_in),
        cmocka_unit_test(wrong_boxes),       cmocka_unit_test(no_memory),
        cmocka_unit_test(open_sight),        cmocka_unit_test(closed_sight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
