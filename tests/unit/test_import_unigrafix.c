// UniGrafix: what is cut, what is kept, what is refused and where.
#include "testing.h"

#include "io/io_formats.h"
#include "map/scan.h"
#include "map_same.h"
#include "sightline/io.h"

#include <math.h>

static sl_status cut(sl_context *context, const char *text, double slice, sl_map *map) {
    const sl_import_options options = {.has_slice = true, .slice = slice};
    return sli_map_read_unigrafix(context, "m.ug", text, strlen(text), &options, map);
}

static void assert_cut(sl_context *context, const char *model, double slice, const char *expected) {
    sl_map map = {0};
    assert_ok(context, cut(context, model, slice, &map));
    char *text = map_walls_text(&map);
    assert_string_equal(text + strlen("sightline 1\n"), expected);
    free(text);
    sl_map_destroy(context, &map);
}

// A box from 0 0 0 to 2 3 4, walls only.
#define BOX                                                                                        \
    "v a 0 0 0;v b 2 0 0;v c 2 3 0;v d 0 3 0;v A 0 0 4;v B 2 0 4;v C 2 3 4;v D 0 3 4;\n"           \
    "f s (a b B A) red ;\nf e (b c C B);\nf n (c d D C) red 1;\nf (d a A D);\n"
#define BOX_CUT "wall 0 0 2 0\nwall 2 0 2 3\nwall 0 3 2 3\nwall 0 0 0 3\n"

static void test_cut(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    assert_cut(context, BOX, 1, BOX_CUT);
    // Faces run counter-clockwise seen from outside: the box is solid.
    sl_map box = {0};
    assert_ok(context, cut(context, BOX, 1, &box));
    char *solid = map_text(&box);
    assert_string_equal(solid, "sightline 1\nsolid 0 0 2 0 2 3 0 3\n");
    free(solid);
    sl_map_destroy(context, &box);
    double lowest = 9, highest = 9;
    assert_ok(context,
              sli_map_heights_unigrafix(context, "m.ug", BOX, strlen(BOX), &lowest, &highest));
    assert_true(lowest == 0 && highest == 4);
    assert_int_equal(sli_map_heights_unigrafix(context, "m.ug", "", 0, &lowest, &highest),
                     SL_BAD_INPUT);
    // A vertex in the plane counts as above it: the top edge is cut, the bottom edge is not.
    assert_cut(context, BOX, 4, BOX_CUT);
    assert_cut(context, BOX, 0, "");
    // Floor and ceiling give nothing.
    assert_cut(context, BOX "f f (a b c d);f g (D C B A);", 4, BOX_CUT);
    // Where ends agree the cut is exact, whatever the height.
    assert_cut(context, "v a 0.1 0.7 0;v b 0.1 5 0;v c 0.1 6 3;v d 0.1 0.7 3;f f (a b c d);", 0.3,
               "wall 0.1 0.7 0.1 5.1\n");
    // A slanted face is cut at the height's share of its edges.
    assert_cut(context, "v a 0 0 0;v b 4 0 0;v c 4 8 8;v d 0 8 8;f f (a b c d);", 2,
               "wall 0 2 4 2\n");
    // Vertices after their faces.
    assert_cut(context, "f f (a b c);v a 0 0 0;v b 4 0 0;v c 2 0 2;", 1, "wall 1 0 3 0\n");
    sl_context_destroy(context);
}

static void test_even_odd(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    // A face with a window, then one like a comb; along x, then along y.
    const char *const window = "v a 0 0 0;v b 9 0 0;v c 9 0 9;v d 0 0 9;"
                               "v e 3 0 3;v f 6 0 3;v g 6 0 6;v h 3 0 6;"
                               "f w (a b c d) (e f g h) grey;";
    assert_cut(context, window, 4, "wall 0 0 3 0\nwall 6 0 9 0\n");
    assert_cut(context, window, 1, "wall 0 0 9 0\n");
    const char *const comb = "v a 1 0 0;v b 1 9 0;v c 1 9 9;v d 1 7 9;v e 1 6 2;v f 1 5 9;"
                             "v g 1 4 9;v h 1 3 2;v i 1 2 9;v j 1 0 9;f c (a b c d e f g h i j);";
    assert_cut(context, comb, 9, "wall 1 0 1 2\nwall 1 4 1 5\nwall 1 7 1 9\n");
    assert_cut(context, comb, 5.5, "wall 1 0 1 2.5\nwall 1 3.5 1 5.5\nwall 1 6.5 1 9\n");
    // The notches' ends are in the plane, and so above it.
    assert_cut(context, comb, 2, "wall 1 0 1 9\n");
    // A tip that just reaches the plane gives a point, and so no wall.
    assert_cut(context, "v a 0 0 0;v b 4 0 0;v c 2 0 2;f f (a b c);", 2, "");
    // Oblique, in the order along the cut.
    assert_cut(context,
               "v a 0 0 0;v b 4 4 0;v c 4 4 9;v d 3 3 9;v e 2 2 1;v f 1 1 9;v g 0 0 9;"
               "f f (a b c d e f g);",
               9, "wall 0 0 1 1\nwall 3 3 4 4\n");
    sl_context_destroy(context);
}

/// A comb whose cut runs along y, its x the same but for rounding: that must not sort it.
static void test_rounded_cut(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const double y[] = {0, 9, 9, 7, 6, 5, 4, 3, 2, 0},
                 z[] = {0, 0, 9.1, 9.2, 2, 9.3, 9.4, 2, 9.5, 9.6};
    char model[2000], *end = model;
    for (int i = 0; i < 10; i++)
        end += sprintf(end, "v p%d %.17g %.17g %.17g;", i, 0.3 + z[i] * 0.1, y[i], z[i]);
    sprintf(end, "f c (p0 p1 p2 p3 p4 p5 p6 p7 p8 p9);");
    bool rounded = false;
    for (double slice = 2.1; slice < 9; slice += 0.1) {
        sl_map map = {0};
        assert_ok(context, cut(context, model, slice, &map));
        assert_int_equal(map.wall_count, 3);
        for (int i = 0; i < 3; i++) {
            const sl_wall *wall = &map.walls[i];
            assert_true(wall->a.y < wall->b.y && (i == 0 || wall[-1].b.y < wall->a.y));
            rounded |= wall->a.x != wall->b.x;
        }
        sl_map_destroy(context, &map);
    }
    assert_true(rounded);
    sl_context_destroy(context);
}

/// Two faces at one slanted edge, named in opposite orders, meet in the very same point.
static void test_shared_edges(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    const char *const model = "v a 0.1 0.2 0.3;v b 7.7 3.1 9.7;v p 0 9 0;v q 9 0 0;v P 0 9 9;"
                              "v Q 9 0 9;f f (a b P p);f g (b a q Q);";
    for (double slice = 0.4; slice < 8.9; slice += 0.1) {
        assert_ok(context, cut(context, model, slice, &map));
        assert_int_equal(map.wall_count, 2);
        const sl_wall *f = &map.walls[0], *g = &map.walls[1];
        assert_true(same_points(&f->a, &g->a, 1) || same_points(&f->a, &g->b, 1) ||
                    same_points(&f->b, &g->a, 1) || same_points(&f->b, &g->b, 1));
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

static void test_notes(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, cut(context,
                           "{\n  Copyright {me,you}@here  \n\n  1994. \n}\n{}{ }\n{ one line }"
                           "c_rgb red 1 0 0;{ between }\n" BOX "{last { and } least\n} \n",
                           1, &map));
    assert_string_equal(map.source.notes, "  Copyright {me,you}@here  \n\n  1994.\none line\n"
                                          "last { and } least\n");
    assert_int_equal(map.wall_count, 4);
    assert_int_equal(map.walls[0].line, 9);
    sl_map back = {0};
    char *text = map_text(&map);
    assert_ok(context, sli_map_read_text(context, "m.map", text, strlen(text), &back));
    char *again = map_text(&back);
    assert_string_equal(text, again);
    assert_int_equal(back.wall_count, 4);
    free(again);
    free(text);
    sl_map_destroy(context, &map);
    sl_map_destroy(context, &back);
    sl_context_destroy(context);
}

static void keep_message(void *user, const char *message) {
    snprintf(user, 500, "%s", message);
}

static void test_account(void **state) {
    (void)state;
    char message[500] = "";
    const sl_hooks hooks = {.user = message, .note = keep_message};
    sl_context *context = sl_context_create(&hooks);
    sl_map map = {0};
    assert_ok(context,
              cut(context, BOX "f t (A B C D);f b (a b c d);c_rgb x 1 1 1;i thing (a);", 4, &map));
    assert_string_equal(message, "m.ug: cut at z = 4: 4 of 6 faces give 4 walls; 1 faces in the "
                                 "plane left out; 1 statements of other kinds passed over");
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_slice(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_import_options options = sl_import_options_default();
    sl_map map = {0};
    assert_int_equal(sli_map_read_unigrafix(context, "m.ug", BOX, strlen(BOX), &options, &map),
                     SL_BAD_ARGUMENT);
    assert_string_equal(sl_context_message(context),
                        "m.ug: a 3D model: give --slice Z, the height of the cut: the model's z "
                        "goes from 0 to 4");
    assert_int_equal(cut(context, BOX, 4.5, &map), SL_BAD_ARGUMENT);
    assert_string_equal(sl_context_message(context),
                        "m.ug: --slice 4.5 misses the model: its z goes from 0 to 4");
    assert_int_equal(cut(context, BOX, NAN, &map), SL_BAD_ARGUMENT);
    assert_true(map_is_empty(&map));
    sl_context_destroy(context);
}

static void test_refusals(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const struct {
        const char *text, *where, *why;
    } cases[] = {
        {"", "m.ug: ", "no vertices"},
        {"\n{ a\n{ b }\n", "m.ug:2: ", "this comment's '{' has no '}'"},
        {BOX "f x (a b {\n c);", "m.ug:6: ", "this comment's '{' has no '}'"},
        {BOX "}", "m.ug:6: ", "'}' without a '{'"},
        {"v a 0 0 0\nv b 0 0 0;", "m.ug:2: ", "expected ';' in the statement of line 1, found 'v'"},
        {"v a 0 0 0\n", "m.ug:2: ", "expected ';' in the statement of line 1, found the end"},
        {"v a 0 0;", "m.ug:1: ", "expected x, y and z in the statement of line 1, found ';'"},
        {"v ;", "m.ug:1: ", "expected a vertex name"},
        {"v a 0 0 0 0;", "m.ug:1: ", "expected ';'"},
        {"v a 0 0 z;", "m.ug:1: ", "expected a finite decimal number, found 'z'"},
        {"v a 0 nan 0;", "m.ug:1: ", "found 'nan'"},
        {"v a 0 0\n1e160;", "m.ug:2: ", "'1e160' is out of range"},
        {"v a 0 0 0;\nv b 0 0 0;\nv a 1 1 1;",
         "m.ug:3: ", "vertex 'a' once more: it is defined on line 1"},
        {"c_rgb r 1 1 1\n", "m.ug:2: ", "expected ';' in the statement of line 1, found the end"},
        {"(a);", "m.ug:1: ", "expected a statement in the statement of line 1, found '('"},
        {BOX "f x (a b);", "m.ug:6: ", "at least 3 vertices, this one has 2"},
        {BOX "f x (a b c) ();", "m.ug:6: ", "at least 3 vertices, this one has 0"},
        {BOX "f x (a b\nq d);", "m.ug:7: ", "unknown vertex 'q'"},
        {BOX "f x (a b c;", "m.ug:6: ", "expected vertex names and ')'"},
        {BOX "f x a (a b c);", "m.ug:6: ", "expected '('"},
        {BOX "f x ;", "m.ug:6: ", "expected '('"},
        {BOX "f x (a b c) red\nv q 0 0 0;", "m.ug:7: ", "expected ';' in the statement of line 6"},
        {BOX "f x (a b c) red (a b c);", "m.ug:6: ", "expected ';'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_map map = {0};
        assert_int_equal(cut(context, cases[i].text, 1, &map), SL_BAD_INPUT);
        assert_true(map_is_empty(&map));
        const char *message = sl_context_message(context);
        if (strncmp(message, cases[i].where, strlen(cases[i].where)) != 0 ||
            !strstr(message, cases[i].why))
            fail_msg("expected '%s ... %s', got '%s'", cases[i].where, cases[i].why, message);
    }
    const char nul[] = "v a 0 0 0;\nv \0 0 0 0;";
    const sl_import_options options = {.has_slice = true};
    sl_map map = {0};
    assert_int_equal(sli_map_read_unigrafix(context, "m.ug", nul, sizeof nul - 1, &options, &map),
                     SL_BAD_INPUT);
    assert_string_equal(sl_context_message(context),
                        "m.ug:2: a NUL byte: expected plain text (ASCII or UTF-8)");
    sl_context_destroy(context);
}

/// Enough names to make the table grow many times; each must still be found.
static void test_many_vertices(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const int count = 30000;
    char *text = malloc((size_t)count * 80);
    assert_non_null(text);
    char *end = text;
    for (int i = 0; i < count; i++)
        end += sprintf(end, "v p%d %d %d 0;v q%d %d %d 2;", i, i, i % 2, i, i, i % 2);
    for (int i = 0; i + 1 < count; i += 2)
        end += sprintf(end, "f (p%d p%d q%d q%d);", i, i + 1, i + 1, i);
    sl_map map = {0};
    assert_ok(context, cut(context, text, 1, &map));
    assert_int_equal(map.wall_count, count / 2);
    for (int i = 0; i < count / 2; i++) {
        const sl_wall *wall = &map.walls[i];
        assert_true(wall->a.x == 2 * i && wall->a.y == 0 && wall->b.x == 2 * i + 1 &&
                    wall->b.y == 1);
    }
    sl_map_destroy(context, &map);
    free(text);
    sl_context_destroy(context);
}

static void test_soda_hall(void **state) {
    (void)state;
    const char *const path = SIGHTLINE_SOURCE_DIR "/../shared/data/soda-hall-floor5.ug";
    FILE *file = fopen(path, "r");
    if (!file) {
        print_message("skipped: %s is not here\n", path);
        skip();
    }
    fclose(file);
    sl_context *context = testing_context(NULL);
    assert_ok(context, sl_io_use(context));
    const sl_import_options options = {.has_slice = true, .slice = 1040};
    sl_map map = {0};
    assert_ok(context, sl_map_read(context, path, &options, &map));
    assert_int_equal(map.wall_count, 871);
    for (size_t i = 0; i < map.wall_count; i++) {
        const sl_wall *wall = &map.walls[i];
        assert_true((wall->a.x == wall->b.x) != (wall->a.y == wall->b.y));
    }
    assert_non_null(strstr(map.source.notes, "\"U.C. Berkeley Soda Hall WALKTHRU Model\""));
    assert_non_null(strstr(map.source.notes, "  {cf,funk,seth}@cs.princeton.edu "));
    assert_non_null(strstr(map.source.notes, "INCIDENTAL OR CONSEQUENTIAL DAMAGES."));
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cut),           cmocka_unit_test(test_even_odd),
        cmocka_unit_test(test_rounded_cut),   cmocka_unit_test(test_shared_edges),
        cmocka_unit_test(test_notes),         cmocka_unit_test(test_account),
        cmocka_unit_test(test_slice),         cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_many_vertices), cmocka_unit_test(test_soda_hall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
