// The transform of a map: places of a file with y down are places of the map, and come back.
#include "runtime_maps.h"

#include "io/io_formats.h"
#include "sightline/io.h"

typedef sl_status reader(sl_context *context, const char *name, const char *text, size_t size,
                         const sl_import_options *options, sl_map *map);

#define UVTT                                                                                       \
    "{\"resolution\": {\"map_origin\": {\"x\": 2, \"y\": 1}, \"map_size\": {\"x\": 4, \"y\": 9}}," \
    "\"line_of_sight\": [[{\"x\": 3, \"y\": 2}, {\"x\": 5, \"y\": 2.5}]]}"
#define FOUNDRY "{\"walls\": [{\"c\": [3, 2, 5, 2.5]}, {\"c\": [0, 0, 0, 70]}]}"
#define FOUNDRY_4                                                                                  \
    "{\"flags\": {\"sightline\": {\"pixels\": 4, \"y0\": 16}}, \"walls\": [{\"c\": [3, 2, 5, "     \
    "2.5]}]}"
#define SVG                                                                                        \
    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-2 -1 10 30'><path d='M 3 2 L 5 "            \
    "2.5'/></svg>"
#define DXF                                                                                        \
    "0\nSECTION\n2\nHEADER\n9\n$"                                                                  \
    "INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nw\n"                         \
    "10\n3\n20\n2\n11\n5\n21\n2.5\n0\nENDSEC\n0\nEOF\n"
#define TMJ                                                                                        \
    "{\"orientation\": \"orthogonal\", \"width\": 4, \"height\": 3, \"tilewidth\": 32, "           \
    "\"tileheight\": 16, \"infinite\": false, \"tilesets\": [], \"layers\": [{\"type\": "          \
    "\"objectgroup\", \"name\": \"walls\", \"objects\": [{\"x\": 3, \"y\": 2, \"polyline\": "      \
    "[{\"x\": 0, \"y\": 0}, {\"x\": 2, \"y\": 0.5}]}]}]}"

static sl_runtime_transform of(sl_transform t) {
    return (sl_runtime_transform){t.origin.x, t.origin.y, t.scale, t.y_down};
}

/// The first wall of each text goes from 3, 2 to 5, 2.5 in its file.
static void the_wall_comes_back(reader *read, const sl_import_options *options, const char *text,
                                sl_transform expected) {
    const sl_import_options usual = sl_import_options_default();
    sl_context *context = testing_context(NULL);
    sl_map map = {0}, copy = {0};
    assert_ok(context, read(context, "f", text, strlen(text), options ? options : &usual, &map));
    assert_ok(context, sl_map_copy(context, &map, &copy));
    const sl_transform t = copy.source.transform;
    if (t.origin.x != expected.origin.x || t.origin.y != expected.origin.y ||
        t.scale != expected.scale || t.y_down != expected.y_down)
        fail_msg("%.40s: origin %g, %g, scale %g, %d", text, t.origin.x, t.origin.y, t.scale,
                 t.y_down);
    const sl_runtime_transform transform = of(t);
    const sl_wall *wall = &map.walls[0];
    double points[] = {wall->a.x, wall->a.y, wall->b.x, wall->b.y};
    sl_runtime_from_map(&transform, points, 2);
    const double expected_points[] = {3, 2, 5, 2.5};
    for (int i = 0; i < 4; i++)
        if (fabs(points[i] - expected_points[i]) > (t.scale == 1000 ? 1e-15 : 0))
            fail_msg("%.40s: %.17g is not %g", text, points[i], expected_points[i]);
    sl_runtime_to_map(&transform, points, 2);
    assert_true(points[0] == wall->a.x && points[1] == wall->a.y);
    assert_true(points[2] == wall->b.x && points[3] == wall->b.y);
    sl_map_destroy(context, &copy);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void every_reader_says_how_y_goes(void **state) {
    (void)state;
    sl_import_options options = sl_import_options_default();
    the_wall_comes_back(sli_map_read_uvtt, NULL, UVTT, (sl_transform){{0, 10}, 1, true});
    the_wall_comes_back(sli_map_read_foundry, NULL, FOUNDRY, (sl_transform){{0, 70}, 1, true});
    the_wall_comes_back(sli_map_read_foundry, NULL, FOUNDRY_4, (sl_transform){{0, 16}, 4, true});
    the_wall_comes_back(sli_map_read_svg, NULL, SVG, (sl_transform){{0, 29}, 1, true});
    options.layers = "walls";
    the_wall_comes_back(sli_map_read_tmj, &options, TMJ, (sl_transform){{0, 48}, 1, true});
    options = sl_import_options_default();
    options.unit = "m";
    the_wall_comes_back(sli_map_read_dxf, &options, DXF, (sl_transform){{0, 0}, 1000, false});
}

/// The walls of a text are about a box of its file.
static void the_square_comes_back(reader *read, const char *text, sl_box expected) {
    const sl_import_options usual = sl_import_options_default();
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, read(context, "f", text, strlen(text), &usual, &map));
    const sl_runtime_transform transform = of(map.source.transform);
    const sl_box box = sl_map_bounds(&map);
    double corners[] = {box.min.x, box.max.y, box.max.x, box.min.y};
    sl_runtime_from_map(&transform, corners, 2);
    assert_true(corners[0] == expected.min.x && corners[1] == expected.min.y);
    assert_true(corners[2] == expected.max.x && corners[3] == expected.max.y);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void squares_come_back(void **state) {
    (void)state;
    the_square_comes_back(sli_map_read_image, "P2\n3 4\n1\n1 1 1\n1 0 1\n1 1 1\n1 1 1\n",
                          (sl_box){{1, 1}, {2, 2}});
    // One open square of a level. Where a level alone stands in its world does not count.
    the_square_comes_back(
        sli_map_read_ldtk,
        "{\"levels\": [{\"identifier\": \"A\", \"worldX\": 16, \"worldY\": 32, \"pxWid\": 24, "
        "\"pxHei\": 16, \"layerInstances\": [{\"__identifier\": \"I\", \"__type\": \"IntGrid\", "
        "\"__cWid\": 3, \"__cHei\": 2, \"__gridSize\": 8, \"intGridCsv\": [1, 0, 1, 1, 1, 1]}]}]}",
        (sl_box){{8, 0}, {16, 8}});
}

/// A file that says nothing has y up, and a plan has rows from the top.
static void whole_files_have_one(void **state) {
    (void)state;
    static const char *const paths[] = {"/maps/flat.map", "/maps/cellar.txt", "/maps/keep.tmx"};
    static const bool down[] = {false, true, true};
    static const double tops[] = {0, 15, 272}; // lines of the plan, 17 rows of 16 pixels
    const sl_import_options options = sl_import_options_default();
    sl_context *context = testing_context(NULL);
    sl_io_use(context);
    for (int i = 0; i < 3; i++) {
        char path[1024];
        sl_map map = {0};
        snprintf(path, sizeof path, "%s%s", SIGHTLINE_SOURCE_DIR, paths[i]);
        assert_ok(context, sl_map_read(context, path, &options, &map));
        const sl_transform t = map.source.transform;
        assert_true(t.scale == 1 && t.y_down == down[i]);
        assert_true(t.origin.x == 0 && t.origin.y == tops[i]);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

/// What a file keeps is what a game gets; an unknown one is that of the map.
static void a_file_keeps_it(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 9 0 9 9 0 9 0 0\n");
    sl_runtime_transform t;
    assert_false(sl_runtime_map_transform(&f.runtime, &t));
    assert_true(t.origin_x == 0 && t.origin_y == 0 && t.scale == 1 && !t.y_down);
    f.baked.map.source.transform = (sl_transform){{-3, 9}, 16, true};
    free(f.bytes);
    f.bytes = baked_bytes(context, &f.baked, &f.size);
    baked_file_open(&f);
    assert_true(sl_runtime_map_transform(&f.runtime, &t));
    assert_true(t.origin_x == -3 && t.origin_y == 9 && t.scale == 16 && t.y_down);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// Whole numbers and scales of powers of 2 come back to the bit, from anywhere to anywhere.
static void whole_numbers_are_exact(void **state) {
    (void)state;
    sl_random random = {12};
    for (int i = 0; i < 100000; i++) {
        const sl_runtime_transform t = {(double)sl_random_below(&random, 1 << 20) - (1 << 19),
                                        (double)sl_random_below(&random, 1 << 20) - (1 << 19),
                                        ldexp(1, (int)sl_random_below(&random, 24) - 8),
                                        sl_random_below(&random, 2)};
        const double is[2] = {(double)sl_random_below(&random, 1 << 20) - (1 << 19),
                              (double)sl_random_below(&random, 1 << 20) - (1 << 19)};
        double said[2] = {is[0], is[1]};
        sl_runtime_to_map(&t, said, 1);
        const long double y = (long double)is[1] / t.scale;
        assert_true(said[0] == t.origin_x + (long double)is[0] / t.scale);
        assert_true(said[1] == (t.y_down ? t.origin_y - y : t.origin_y + y));
        sl_runtime_from_map(&t, said, 1);
        assert_true(said[0] == is[0] && said[1] == is[1]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_reader_says_how_y_goes), cmocka_unit_test(squares_come_back),
        cmocka_unit_test(whole_files_have_one),         cmocka_unit_test(a_file_keeps_it),
        cmocka_unit_test(whole_numbers_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
