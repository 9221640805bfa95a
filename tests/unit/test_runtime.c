// The runtime for games answers as the library does: on every map, for all pairs of cells and for
// points wherever they can fall.
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#define SLRT_WINDOW 32 // cells are noted many times
#include "runtime_maps.h"

#include "geometry/orient.h"
#include "map/scan.h"
#include "oracle/random_oblique.h"
#include "sightline/support.h"

#include <math.h>

static void same_cell(const baked_file *f, double x, double y) {
    const uint32_t is = sl_space_locate(&f->baked.space, (sl_point){x, y});
    const uint32_t said = sl_runtime_locate(&f->runtime, x, y);
    if (said != is) fail_msg("%s: (%.17g, %.17g) is in %u, not in %u", f->name, x, y, is, said);
}

/// A point, and those a step of rounding away from it.
static void same_cells_about(const baked_file *f, sl_point at) {
    for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++)
            same_cell(f, i ? nextafter(at.x, i * INFINITY) : at.x,
                      j ? nextafter(at.y, j * INFINITY) : at.y);
}

static void points_are_in_the_same_cells(const baked_file *f) {
    const sl_space *s = &f->baked.space;
    const sl_box *b = &s->bounds;
    sl_random random = {3};
    for (uint32_t i = 0; i < s->vertex_count; i++) same_cells_about(f, s->vertices[i]);
    for (uint32_t i = 0; i < s->portal_count; i++) {
        const sl_portal *p = &s->portals[i];
        same_cells_about(
            f, (sl_point){p->left.x / 2 + p->right.x / 2, p->left.y / 2 + p->right.y / 2});
    }
    for (int i = 0; i < 4000; i++) {
        // A tenth of the width beyond the bounds on every side, too.
        const double x = 1.2 * sl_random_unit(&random) - 0.1,
                     y = 1.2 * sl_random_unit(&random) - 0.1;
        same_cell(f, b->min.x + x * (b->max.x - b->min.x), b->min.y + y * (b->max.y - b->min.y));
    }
    for (uint32_t i = 0; i < s->node_count; i++) {
        const double across = s->nodes[i].position, along = sl_random_unit(&random);
        if (s->nodes[i].axis)
            same_cells_about(f, (sl_point){b->min.x + along * (b->max.x - b->min.x), across});
        else
            same_cells_about(f, (sl_point){across, b->min.y + along * (b->max.y - b->min.y)});
    }
    const double odd[] = {NAN, INFINITY, -INFINITY, 1e308, -1e308, 0, -0.0, 5e-324};
    const size_t odds = sizeof odd / sizeof *odd;
    for (size_t i = 0; i < odds * odds; i++) same_cell(f, odd[i / odds], odd[i % odds]);
    for (size_t i = 0; i < odds; i++) {
        same_cell(f, odd[i], b->min.y / 2 + b->max.y / 2);
        same_cell(f, b->min.x / 2 + b->max.x / 2, odd[i]);
    }
}

static void same_box(const baked_file *f, sl_box box) {
    const uint32_t count = f->baked.space.cell_count;
    uint64_t *is = calloc(sl_eye_words(&f->baked.space), sizeof *is);
    uint32_t *said = calloc(count, sizeof *said);
    assert_true(is && said);
    sl_cells_of_box(&f->baked.space, box, is);
    const uint32_t found =
        sl_runtime_box_cells(&f->runtime, box.min.x, box.min.y, box.max.x, box.max.y, said, count);
    uint32_t at = 0;
    for (uint32_t c = 0; c < count; c++) {
        if (!sl_eye_sees(is, c)) continue;
        if (at == found || said[at++] != c)
            fail_msg("%s: box %.17g %.17g %.17g %.17g: cell %u is not told", f->name, box.min.x,
                     box.min.y, box.max.x, box.max.y, c);
    }
    assert_int_equal(at, found);
    const uint32_t first = said[0];
    said[0] = said[count - 1] = UINT32_MAX;
    assert_int_equal(sl_runtime_box_cells(&f->runtime, box.min.x, box.min.y, box.max.x, box.max.y,
                                          said, count > 1),
                     found);
    if (count > 1) assert_int_equal(said[0], found ? first : UINT32_MAX);
    if (count > 2) assert_int_equal(said[count - 1], UINT32_MAX);
    free(is);
    free(said);
}

/// Boxes anywhere, of all sizes, and such that end at corners of cells, or a step of rounding off.
static void boxes_are_in_the_same_cells(const baked_file *f) {
    const sl_space *s = &f->baked.space;
    const double width = s->bounds.max.x - s->bounds.min.x;
    sl_random random = {5};
    for (int i = 0; i < 400; i++) {
        const sl_point v = s->vertices[sl_random_below(&random, s->vertex_count)];
        const double size = ldexp(width, -(int)sl_random_below(&random, 12));
        const double x = v.x + (double)(sl_random_below(&random, 3)) * size / 2 - size / 2;
        const double y = v.y + (double)(sl_random_below(&random, 3)) * size / 2 - size / 2;
        const bool step = sl_random_below(&random, 2);
        const double from = step ? nextafter(x, INFINITY) : x;
        same_box(f,
                 (sl_box){{from, y}, {fmax(from, x + size), y + size * sl_random_unit(&random)}});
    }
    same_box(f, s->bounds);
    same_box(f, (sl_box){s->bounds.max, s->bounds.max});
    uint32_t none;
    assert_int_equal(sl_runtime_box_cells(&f->runtime, 1, 0, 0, 1, &none, 1), 0);
    assert_int_equal(sl_runtime_box_cells(&f->runtime, NAN, 0, 1, 1, &none, 1), 0);
}

static void every_box_is_in_the_same_cells(void **state) {
    (void)state;
    baked_file_each(boxes_are_in_the_same_cells);
}

static void every_point_is_in_the_same_cell(void **state) {
    (void)state;
    baked_file_each(points_are_in_the_same_cells);
}

/// Places on walls as doubles have them, and a few steps beside.
static void points_by_walls_are_in_the_same_cells(const baked_file *f, uint64_t points) {
    const sl_space *s = &f->baked.space;
    sl_random random = {7};
    for (uint64_t i = 0; i < points; i++) {
        const sl_wall *w = &s->walls[sl_random_below(&random, s->wall_count)];
        const double along = sl_random_unit(&random);
        double x = w->a.x + along * (w->b.x - w->a.x), y = w->a.y + along * (w->b.y - w->a.y);
        for (uint64_t k = sl_random_below(&random, 4); k > 0; k--) {
            x = nextafter(x, sl_random_below(&random, 2) ? INFINITY : -INFINITY);
            y = nextafter(y, sl_random_below(&random, 2) ? INFINITY : -INFINITY);
        }
        same_cell(f, x, y);
    }
}

static void every_point_by_an_oblique_wall_is_in_the_same_cell(void **state) {
    (void)state;
    const uint64_t maps = testing_seeds(200);
    uint64_t over = 0;
    for (uint64_t seed = 1; seed <= maps; seed++) {
        sl_context *context = testing_context(NULL);
        baked_file f = {.name = "random", .baked = {.method = "dfs", .solver = "funnel"}};
        sl_map *map = &f.baked.map;
        assert_ok(context,
                  oblique_random_map(context, seed, (oblique_grid)(seed % OBLIQUE_GRIDS), 12, map));
        if (sl_map_clean(context, map, NULL, NULL) == SL_OK && map->wall_count) {
            baked_file_make(context, &f, false);
            points_by_walls_are_in_the_same_cells(&f, 400);
            over += f.runtime.grid_cells != NULL;
        }
        baked_file_destroy(context, &f);
        sl_context_destroy(context);
    }
    assert_true(over > maps / 2);
}

// --- turned maps, near and far

static bool holds(const sl_space *s, uint32_t cell, sl_point p) {
    const sl_cell *c = &s->cells[cell];
    const sl_point *v = s->vertices + c->first_vertex;
    uint32_t k = 0;
    while (k < c->vertex_count && sli_orient(v[k], v[(k + 1) % c->vertex_count], p) >= 0) k++;
    return k == c->vertex_count;
}

/// The first cell that holds a point, of all that are inside; else of all that are not solid; else
/// of all.
static uint32_t first_that_holds(const sl_space *s, sl_point p) {
    uint32_t inside = SL_NO_CELL, open = SL_NO_CELL, any = SL_NO_CELL;
    for (uint32_t i = s->cell_count; i-- > 0;) {
        if (!holds(s, i, p)) continue;
        any = i;
        if (!s->cells[i].solid) open = i;
        if (s->cells[i].inside) inside = i;
    }
    return inside != SL_NO_CELL ? inside : open != SL_NO_CELL ? open : any;
}

/// A corner, a place on a side, a place where buckets meet, or any.
static sl_point some_place(const sl_space *s, sl_random *random) {
    const sl_cell *c = &s->cells[sl_random_below(random, s->cell_count)];
    const sl_point *v = s->vertices + c->first_vertex;
    const uint32_t k = (uint32_t)sl_random_below(random, c->vertex_count);
    const sl_point a = v[k], b = v[(k + 1) % c->vertex_count], low = s->bounds.min;
    const double width = s->bounds.max.x - low.x, height = s->bounds.max.y - low.y;
    const double along = sl_random_below(random, 2) ? 0.5 : sl_random_unit(random);
    const double column = (double)sl_random_below(random, s->grid.columns + 1);
    const double row = (double)sl_random_below(random, s->grid.rows + 1);
    switch (sl_random_below(random, 4)) {
    case 0:
        return a;
    case 1:
        return (sl_point){a.x + along * (b.x - a.x), a.y + along * (b.y - a.y)};
    case 2:
        return (sl_point){low.x + width * (column / s->grid.columns),
                          low.y + height * (row / s->grid.rows)};
    default:
        return (sl_point){low.x + width * sl_random_unit(random),
                          low.y + height * sl_random_unit(random)};
    }
}

static void places_are_in_the_same_cells(const baked_file *f, uint64_t count) {
    const sl_space *s = &f->baked.space;
    sl_random random = {9};
    assert_non_null(f->runtime.grid_cells);
    for (uint64_t i = 0; i < count; i++) {
        sl_point p = some_place(s, &random);
        for (uint64_t k = sl_random_below(&random, 3); k > 0; k--) {
            p.x = nextafter(p.x, sl_random_below(&random, 2) ? INFINITY : -INFINITY);
            p.y = nextafter(p.y, sl_random_below(&random, 2) ? INFINITY : -INFINITY);
        }
        same_cell(f, p.x, p.y);
        const bool within = p.x >= s->bounds.min.x && p.x <= s->bounds.max.x &&
                            p.y >= s->bounds.min.y && p.y <= s->bounds.max.y;
        if (i % 16 == 0 && within) assert_int_equal(sl_space_locate(s, p), first_that_holds(s, p));
    }
}

static void every_place_of_a_turned_map_is_in_the_same_cell(void **state) {
    (void)state;
    static const char *const names[] = {"office", "gallery", "oblique/chapel", "oblique/rotunda",
                                        "oblique/star"};
    static const struct {
        double degrees, offset;
    } turns[] = {{17.3, 0}, {17.3, 1e6}, {44.9, -1e12}, {0.001, 0x1p40}};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < 20; i++) {
        baked_file f =
            baked_file_turned(context, names[i / 4], turns[i % 4].degrees, turns[i % 4].offset);
        places_are_in_the_same_cells(&f, testing_seeds(50000));
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

// --- on the border of solid ground

/// Places on corners and sides of cells: the cell found is solid only if all that hold the place
/// are, and an eye there sees.
static void places_beside_solid_ground(const baked_file *f, uint32_t counts[2]) {
    const sl_space *s = &f->baked.space;
    uint32_t *scratch = malloc(sl_runtime_scratch_count(&f->runtime) * sizeof *scratch);
    sl_random random = {5};
    assert_non_null(scratch);
    for (int i = 0; i < 4000; i++) {
        const sl_cell *c = &s->cells[sl_random_below(&random, s->cell_count)];
        const sl_point *v = s->vertices + c->first_vertex;
        const uint32_t k = (uint32_t)sl_random_below(&random, c->vertex_count);
        const sl_point a = v[k], b = v[(k + 1) % c->vertex_count];
        const double part = (double)sl_random_below(&random, 5) / 4;
        const sl_point p = {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
        const uint32_t is = sl_space_locate(s, p);
        if (is == SL_NO_CELL) continue;
        same_cell(f, p.x, p.y);
        bool any_solid = false, all_solid = true;
        for (uint32_t cell = 0; cell < s->cell_count; cell++)
            if (holds(s, cell, p)) {
                any_solid = any_solid || s->cells[cell].solid;
                all_solid = all_solid && s->cells[cell].solid;
            }
        const sl_runtime_view view = sl_runtime_view_all_round(p.x, p.y);
        assert_true(holds(s, is, p));
        assert_int_equal(s->cells[is].solid, all_solid);
        assert_int_equal(sl_runtime_look(&f->runtime, &view, scratch, NULL, 0) > 0, !all_solid);
        const uint32_t corners =
            sl_runtime_visible_polygon(&f->runtime, &view, NULL, 0, scratch, NULL, 0);
        assert_int_equal(corners > 0, !all_solid);
        counts[all_solid] += any_solid;
    }
    free(scratch);
}

static void an_eye_that_leans_against_rock_sees(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    // A room with a tile of rock, and rock around it.
    static const char *const rooms[] = {
        "solid 0 0 8 0 8 8 0 8\nopen 1 1 7 1 7 7 1 7\nsolid 3 3 4 3 4 4 3 4\n",
        "solid 0 0 8 0 8 8 0 8\nopen 1 1 7 1 7 6 6 7 1 7\nsolid 3 3 5 3 4 4\n"};
    for (int i = 0; i < 2; i++) {
        baked_file f = baked_file_of_text(context, rooms[i]);
        uint32_t counts[2] = {0, 0};
        places_beside_solid_ground(&f, counts);
        assert_true(counts[0] > 500 && counts[1] > 100);
        baked_file_destroy(context, &f);
    }
    // Beside a tile: the cell over and right of the place counts first, then left and over.
    baked_file f = baked_file_of_text(context, rooms[0]);
    const sl_point corners[] = {{3, 3}, {4, 3}, {3, 4}, {4, 4}};
    const double beside[][2] = {{-0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}};
    for (int i = 0; i < 4; i++) {
        const sl_point near = {corners[i].x + beside[i][0], corners[i].y + beside[i][1]};
        assert_int_equal(sl_runtime_locate(&f.runtime, corners[i].x, corners[i].y),
                         sl_space_locate(&f.baked.space, near));
    }
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void rows_are_the_same(const baked_file *f) {
    const sl_runtime *r = &f->runtime;
    const sl_pvs *pvs = &f->baked.visibility.pvs;
    unsigned char *bits = malloc(r->cell_count / 8 + 1);
    assert_non_null(bits);
    assert_int_equal(r->cell_count, pvs->cell_count);
    for (uint32_t from = 0; from < r->cell_count; from++) {
        sl_runtime_row_bits(r, from, bits);
        for (uint32_t to = 0; to < r->cell_count; to++) {
            const bool sees = sl_pvs_sees(pvs, from, to);
            assert_int_equal(sl_runtime_can_see(r, from, to), sees);
            assert_int_equal(bits[to / 8] >> to % 8 & 1, sees);
        }
        assert_int_equal(sl_runtime_row_count(r, from), sl_pvs_count(pvs, from));
        assert_int_equal(sl_runtime_has_row(r, from), sl_pvs_count(pvs, from) > 0);
        sl_runtime_run run = sl_runtime_row(r, from);
        for (sl_pvs_run is = sl_pvs_begin(pvs, from); sl_pvs_next(&is);) {
            assert_true(sl_runtime_next(&run));
            assert_int_equal(run.first, is.first);
            assert_int_equal(run.end, is.end);
        }
        assert_false(sl_runtime_next(&run));
        assert_false(sl_runtime_next(&run));
    }
    free(bits);
}

static void every_pair_is_seen_the_same(void **state) {
    (void)state;
    baked_file_each(rows_are_the_same);
}

static void what_is_no_cell_sees_nothing(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 5\n");
    const uint32_t none[] = {f.runtime.cell_count, SL_RUNTIME_NO_CELL, 0x80000000};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        assert_false(sl_runtime_can_see(&f.runtime, none[i], 0));
        assert_false(sl_runtime_can_see(&f.runtime, 0, none[i]));
        assert_false(sl_runtime_can_see(&f.runtime, none[i], none[i]));
        assert_false(sl_runtime_has_row(&f.runtime, none[i]));
        assert_false(sl_runtime_is_inside(&f.runtime, none[i]));
        assert_int_equal(sl_runtime_row_count(&f.runtime, none[i]), 0);
        unsigned char bits = 0xff;
        assert_true(f.runtime.cell_count <= 8);
        sl_runtime_row_bits(&f.runtime, none[i], &bits);
        assert_int_equal(bits, 0);
    }
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void the_space_is_the_same(const baked_file *f) {
    const sl_runtime *r = &f->runtime;
    const sl_space *s = &f->baked.space;
    assert_int_equal(r->portal_count, s->portal_count);
    assert_int_equal(r->directed_count, s->directed_count);
    assert_int_equal(r->vertex_count, s->vertex_count);
    assert_int_equal(r->node_count, s->node_count);
    assert_int_equal(r->grid_columns, s->grid.columns);
    assert_int_equal(r->grid_rows, s->grid.rows);
    assert_true(r->min_x == s->bounds.min.x && r->max_x == s->bounds.max.x);
    assert_true(r->min_y == s->bounds.min.y && r->max_y == s->bounds.max.y);
    for (uint32_t i = 0; i < r->cell_count; i++) {
        const sl_runtime_cell cell = sl_runtime_get_cell(r, i);
        assert_int_equal(cell.first_vertex, s->cells[i].first_vertex);
        assert_int_equal(cell.vertex_count, s->cells[i].vertex_count);
        assert_int_equal(cell.first_directed, s->cells[i].first_directed);
        assert_int_equal(cell.directed_count, s->cells[i].directed_count);
        assert_int_equal(sl_runtime_is_inside(r, i), s->cells[i].inside);
    }
    for (uint32_t i = 0; i < r->directed_count; i++) {
        const sl_runtime_directed_portal directed = sl_runtime_get_directed_portal(r, i);
        const sl_directed_portal *is = &s->directed[i];
        assert_int_equal(directed.portal, is->portal);
        assert_int_equal(directed.cell, is->cell);
        assert_true(directed.left[0] == is->left.x && directed.left[1] == is->left.y);
        assert_true(directed.right[0] == is->right.x && directed.right[1] == is->right.y);
    }
    for (uint32_t i = 0; i < r->vertex_count; i++) {
        double x, y;
        sl_runtime_get_vertex(r, i, &x, &y);
        assert_true(x == s->vertices[i].x && y == s->vertices[i].y);
    }
}

static void cells_directed_and_corners_are_the_same(void **state) {
    (void)state;
    baked_file_each(the_space_is_the_same);
}

static void cells_not_looked_from_have_no_row(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = {.name = "inside", .baked = {.method = "dfs", .solver = "funnel"}};
    const char *text = "sightline 1\nwalls 0 0 4 0 4 2 2 2 2 4 0 4 0 0\n";
    assert_ok(context, sli_map_read_text(context, "inside", text, strlen(text), &f.baked.map));
    baked_file_make(context, &f, true);
    assert_true(f.baked.space.inside_count >= 1 &&
                f.baked.space.inside_count < f.runtime.cell_count);
    for (uint32_t i = 0; i < f.runtime.cell_count; i++)
        assert_int_equal(sl_runtime_has_row(&f.runtime, i), sl_runtime_is_inside(&f.runtime, i));
    rows_are_the_same(&f);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void any_alignment_will_do(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of(context, SIGHTLINE_SOURCE_DIR "/maps/grazing.map");
    char *moved = malloc(f.size + 8), *bytes = f.bytes;
    assert_non_null(moved);
    for (size_t i = 0; i < 8; i++) {
        f.bytes = memcpy(moved + i, bytes, f.size);
        baked_file_open(&f);
        rows_are_the_same(&f);
        the_space_is_the_same(&f);
        points_are_in_the_same_cells(&f);
    }
    f.bytes = bytes;
    free(moved);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_point_is_in_the_same_cell),
        cmocka_unit_test(every_box_is_in_the_same_cells),
        cmocka_unit_test(every_point_by_an_oblique_wall_is_in_the_same_cell),
        cmocka_unit_test(every_place_of_a_turned_map_is_in_the_same_cell),
        cmocka_unit_test(an_eye_that_leans_against_rock_sees),
        cmocka_unit_test(every_pair_is_seen_the_same),
        cmocka_unit_test(what_is_no_cell_sees_nothing),
        cmocka_unit_test(cells_directed_and_corners_are_the_same),
        cmocka_unit_test(cells_not_looked_from_have_no_row),
        cmocka_unit_test(any_alignment_will_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
