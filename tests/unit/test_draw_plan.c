/// What is drawn where: pixels of pictures read back.
#include "sightline/draw.h"

#include "test_draw_map.h"

#include "draw/draw_plan.h"
#include "map/scan.h"

#include <cairo.h>
#include <math.h>
#include <unistd.h>

/// Without a title and a legend the map stands inside margins of 40 on a page 1000 wide: 23 pixels
/// for a unit, the upper border 40 below the page's.
enum { WIDTH = 1000, MARGIN = 40, UNIT = 23, HIGH = 30 };

typedef struct picture {
    cairo_surface_t *surface;
    int width, height;
} picture;

static picture draw(const draw_map *map, sl_draw_options options) {
    sl_context *context = testing_context(NULL);
    char directory[32], path[48];
    draw_directory(directory);
    snprintf(path, sizeof path, "%s/a.png", directory);
    assert_ok(context, sl_draw_file(context, &map->baked, &options, path));
    cairo_surface_t *surface = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    unlink(path);
    assert_int_equal(rmdir(directory), 0); // nothing else was left there
    sl_context_destroy(context);
    return (picture){surface, cairo_image_surface_get_width(surface),
                     cairo_image_surface_get_height(surface)};
}

static sl_draw_options options_for(unsigned layers, uint32_t cell, bool dark) {
    sl_draw_options options = sl_draw_options_default();
    options.layers = layers;
    options.cell = cell;
    options.width = WIDTH;
    options.dark = dark;
    return options;
}

static sl_colour pixel_at(const picture *p, int x, int y) {
    assert_true(x >= 0 && x < p->width && y >= 0 && y < p->height);
    uint32_t value;
    memcpy(&value,
           cairo_image_surface_get_data(p->surface) +
               (size_t)y * (size_t)cairo_image_surface_get_stride(p->surface) + 4 * (size_t)x,
           sizeof value);
    return (sl_colour){(value >> 16 & 255) / 255.0, (value >> 8 & 255) / 255.0,
                       (value & 255) / 255.0};
}

/// The pixel at a place of the map.
static sl_colour colour_at(const picture *p, double x, double y) {
    return pixel_at(p, (int)floor(MARGIN + UNIT * x), (int)floor(MARGIN + UNIT * (HIGH - y)));
}

static bool same(sl_colour a, sl_colour b) {
    const double rounding = 1.6 / 255;
    return fabs(a.red - b.red) < rounding && fabs(a.green - b.green) < rounding &&
           fabs(a.blue - b.blue) < rounding;
}

static bool one_of(sl_colour colour, const sl_colour *tones) {
    for (int i = 0; i < SL_TONES; i++)
        if (same(colour, tones[i])) return true;
    return false;
}

static void each_kind_of_cell_has_its_colour(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    for (int dark = 0; dark < 2; dark++) {
        const sl_palette palette = sl_palette_make(dark);
        const picture p =
            draw(&map, options_for(SL_LAYER_CELLS | SL_LAYER_PVS, map.cells[LEFT_BELOW], dark));
        assert_int_equal(p.width, WIDTH);
        assert_int_equal(p.height, 2 * MARGIN + UNIT * HIGH);
        assert_true(same(pixel_at(&p, 5, 5), palette.page));
        assert_true(same(colour_at(&p, 10, 7), palette.source));
        assert_true(one_of(colour_at(&p, 30, 7), palette.seen));
        assert_true(one_of(colour_at(&p, 10, 17), palette.floor));
        assert_true(one_of(colour_at(&p, 30, 17), palette.floor));
        int ground = 0, hatch = 0;
        for (int i = 0; i < 200; i++) {
            const sl_colour colour = colour_at(&p, 10 + 0.1 * i, 25);
            ground += same(colour, palette.ground);
            hatch += !same(colour, palette.ground);
        }
        assert_true(ground > 100 && hatch > 5);
        cairo_surface_destroy(p.surface);
    }
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

static void neighbours_have_different_tones(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    picture p = draw(&map, options_for(SL_LAYER_CELLS, SL_NO_CELL, false));
    assert_false(same(colour_at(&p, 10, 7), colour_at(&p, 30, 7)));
    cairo_surface_destroy(p.surface);
    p = draw(&map, options_for(SL_LAYER_PORTALS, SL_NO_CELL, false));
    assert_true(same(colour_at(&p, 10, 7), colour_at(&p, 30, 7)));
    cairo_surface_destroy(p.surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// How many of the pixels on a line of the map have a colour.
static int count_on(const picture *p, double x0, double y0, double x1, double y1,
                    sl_colour colour) {
    int count = 0;
    for (int i = 0; i <= 100; i++)
        count += same(colour_at(p, x0 + (x1 - x0) * i / 100, y0 + (y1 - y0) * i / 100), colour);
    return count;
}

/// Lets the tree go on: from the right cell's far wall, a mirror, back into the left one.
static void add_mirrored_nodes(sl_context *context, draw_map *map) {
    sl_space *space = &map->baked.space;
    sl_stab_trees *trees = &map->baked.visibility.trees;
    const uint32_t left = map->cells[LEFT_BELOW], right = map->cells[RIGHT_BELOW];
    assert_ok(context,
              sl_map_add_mirror(context, &map->baked.map, (sl_segment){{40, 2}, {40, 8}}, 0));
    sl_stab_node *nodes = sl_alloc_array(context, 4, sizeof *nodes);
    assert_non_null(nodes);
    memcpy(nodes, trees->nodes, 2 * sizeof *nodes);
    nodes[2] = (sl_stab_node){1, right, SL_STAB_MIRROR};
    nodes[3] = (sl_stab_node){2, left, space->cells[right].first_directed};
    sl_free(context, trees->nodes);
    trees->nodes = nodes;
    for (uint32_t i = left + 1; i <= space->cell_count; i++) trees->offsets[i] = 4;
}

/// How many pixels on a line across the tree, right of the portal, are more red than green.
static int count_reddish(const picture *p) {
    int count = 0;
    for (int i = 0; i <= 100; i++) {
        const sl_colour colour = colour_at(p, 22, 1 + 0.08 * i);
        count += colour.red - colour.green > 0.1;
    }
    return count;
}

static void what_a_mirror_sends_back_has_its_hue(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    const sl_draw_options options = options_for(SL_LAYER_STAB_TREE, map.cells[LEFT_BELOW], false);
    const picture direct = draw(&map, options);
    assert_int_equal(count_reddish(&direct), 0);
    add_mirrored_nodes(context, &map);
    const picture mirrored = draw(&map, options);
    assert_true(count_reddish(&mirrored) > 0);
    sl_scene scene;
    assert_ok(context, sli_scene_make(context, &map.baked, &options, NULL, &scene));
    assert_int_equal(scene.stroke_count, 3);
    assert_int_equal(scene.mirrored_nodes, 2);
    assert_true(scene.strokes[0].mirrored && !scene.strokes[1].mirrored);
    sli_scene_clear(context, &scene);
    cairo_surface_destroy(direct.surface);
    cairo_surface_destroy(mirrored.surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

static void layers_draw_their_lines(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    const sl_palette palette = sl_palette_make(false);
    picture p = draw(&map, options_for(SL_LAYER_WALLS, SL_NO_CELL, false));
    assert_int_equal(count_on(&p, 1, 10, 39, 10, palette.wall), 101);
    assert_int_equal(count_on(&p, 20, 0.5, 20, 3.5, palette.wall), 101);
    assert_int_equal(count_on(&p, 20, 5, 20, 9, palette.wall), 0);
    cairo_surface_destroy(p.surface);

    p = draw(&map, options_for(SL_LAYER_PORTALS, SL_NO_CELL, false));
    assert_int_equal(count_on(&p, 1, 10, 39, 10, palette.wall), 0);
    // Dashed: a part of the line, not all of it.
    const sl_colour floor = colour_at(&p, 10, 7);
    const int blank = count_on(&p, 20, 5, 20, 9, floor);
    assert_true(blank > 20 && blank < 80);
    assert_int_equal(count_on(&p, 20, 0.5, 20, 3.5, floor), 101);
    cairo_surface_destroy(p.surface);

    p = draw(&map, options_for(SL_LAYER_STARTS, SL_NO_CELL, false));
    assert_true(same(colour_at(&p, 5, 5.1), palette.start));
    assert_true(same(colour_at(&p, 30.1, 15), palette.start));
    // Heading up: its tip reaches farther up than to either side.
    assert_true(same(colour_at(&p, 5, 5.35), palette.start));
    assert_false(same(colour_at(&p, 5.35, 5), palette.start));
    assert_true(same(colour_at(&p, 30.35, 15), palette.start));
    cairo_surface_destroy(p.surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

static void stab_tree_runs_from_the_start_to_the_portal(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    const sl_palette palette = sl_palette_make(false);
    const uint32_t cell = map.cells[LEFT_BELOW];
    picture p = draw(&map, options_for(SL_LAYER_STAB_TREE, cell, false));
    // Nothing but the stroke crosses the middle between start and portal.
    int crossed = 0;
    for (int i = 0; i < 400; i++) crossed += !same(colour_at(&p, 12, 1 + 0.02 * i), palette.source);
    assert_true(crossed > 0 && crossed < 20);
    assert_false(same(colour_at(&p, 20, 7), palette.source_edge));
    cairo_surface_destroy(p.surface);
    p = draw(&map, options_for(SL_LAYER_STAB_TREE, map.cells[RIGHT_BELOW], false));
    assert_int_equal(count_on(&p, 30, 1, 30, 9, palette.source), 101); // a tree that was not kept
    cairo_surface_destroy(p.surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

static void heat_runs_over_the_whole_ramp(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    for (int dark = 0; dark < 2; dark++) {
        const picture p = draw(&map, options_for(SL_LAYER_PVS, SL_NO_CELL, dark));
        assert_true(same(colour_at(&p, 10, 7), sl_palette_ramp(dark, 1)));
        assert_true(same(colour_at(&p, 30, 7), sl_palette_ramp(dark, 1)));
        assert_true(same(colour_at(&p, 10, 17), sl_palette_ramp(dark, 0)));
        assert_true(same(colour_at(&p, 30, 17), sl_palette_ramp(dark, 0)));
        cairo_surface_destroy(p.surface);
    }
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

static void doubtful_cells_stand_out(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    sli_row_bytes rows[5] = {0};
    sl_bits set[1] = {0};
    sl_bits_add(set, map.cells[RIGHT_BELOW]);
    assert_ok(context, sli_row_append(context, &rows[map.cells[LEFT_BELOW]], set, 5));
    assert_ok(context, sli_pvs_join(context, rows, 5, &map.baked.visibility.doubtful));
    const sl_palette palette = sl_palette_make(false);
    const picture p = draw(&map, options_for(SL_LAYER_PVS, map.cells[LEFT_BELOW], false));
    assert_true(same(colour_at(&p, 10, 7), palette.source));
    assert_true(same(colour_at(&p, 30, 7), palette.doubtful));
    cairo_surface_destroy(p.surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// Counts and shares are of the cells on the chosen one's side, inside or outside.
static void counts_refer_to_the_right_cells(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    sl_scene scene;
    sl_draw_options options = options_for(SL_LAYER_PVS, map.cells[LEFT_BELOW], false);
    assert_ok(context, sli_scene_make(context, &map.baked, &options, NULL, &scene));
    assert_int_equal(scene.population, 4);
    assert_int_equal(scene.portals, 2);
    assert_int_equal(scene.seen, 2);
    assert_true(scene.seen_share == 0.5);
    assert_true(scene.eye.x == 5 && scene.eye.y == 5);
    sli_scene_clear(context, &scene);
    options.cell = map.cells[OUTSIDE];
    assert_ok(context, sli_scene_make(context, &map.baked, &options, NULL, &scene));
    assert_int_equal(scene.population, 1);
    assert_true(scene.outside && sli_scene_shows(&scene, map.cells[OUTSIDE]));
    assert_false(sli_scene_shows(&scene, map.cells[LEFT_BELOW]));
    assert_int_equal(scene.seen, 0);
    sli_scene_clear(context, &scene);
    options.cell = SL_NO_CELL;
    assert_ok(context, sli_scene_make(context, &map.baked, &options, NULL, &scene));
    assert_true(scene.heat && !scene.shows_seen);
    assert_true(scene.least == 0.25 && scene.most == 0.5 && scene.mean == 0.375);
    sli_scene_clear(context, &scene);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// A room of 40 x 30 with a block of rock in it, cut into several cells, and a niche in the rock
/// that nothing leads to.
static void bake_rock(sl_context *context, bool start, sl_baked *baked) {
    char text[512];
    snprintf(text, sizeof text,
             "sightline 1\nwalls 0 0 40 0 40 30 0 30 0 0\nsolid 10 10 30 10 30 20 10 20\n"
             "solid 14 20 18 20 18 24 14 24\nopen 22 14 26 14 26 16 22 16\n%s",
             start ? "start 5 5 0\n" : "");
    sl_map map = {0};
    assert_ok(context, sli_map_read_text(context, "rock", text, strlen(text), &map));
    assert_ok(context, sl_bake(context, &map, NULL, baked, NULL));
}

/// All of a block of rock has one colour: no borders of cells, no portals.
static void solid_ground_is_filled_as_a_whole(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = {0};
    bake_rock(context, true, &map.baked);
    const uint32_t left = sl_space_locate(&map.baked.space, (sl_point){11, 15});
    assert_int_not_equal(left, sl_space_locate(&map.baked.space, (sl_point){29, 15}));
    const unsigned layers =
        SL_LAYER_CELLS | SL_LAYER_PORTALS | SL_LAYER_PVS | SL_LAYER_WALLS | SL_LAYER_STARTS;
    const uint32_t eye = sl_space_locate(&map.baked.space, (sl_point){5, 5});
    for (int i = 0; i < 4; i++) {
        const sl_palette palette = sl_palette_make(i % 2);
        const picture p = draw(&map, options_for(layers, i < 2 ? eye : SL_NO_CELL, i % 2));
        assert_int_equal(count_on(&p, 11, 12, 29, 12, palette.solid), 101);
        assert_int_equal(count_on(&p, 16, 11, 16, 19, palette.solid), 101);
        assert_int_equal(count_on(&p, 11, 10, 29, 10, palette.wall), 101);
        assert_int_equal(count_on(&p, 14, 20.5, 14, 23.5, palette.wall), 101);
        assert_int_equal(count_on(&p, 1, 25, 39, 25, palette.solid), 0);
        // The niche is outside: hatched.
        const int ground = count_on(&p, 22.5, 15, 25.5, 15, palette.ground);
        assert_true(ground > 50 && ground < 101);
        cairo_surface_destroy(p.surface);
    }
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// Without a start, what is outside is shown too; it is hatched there.
static void outside_is_hatched_where_it_is_shown(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    static const char text[] = "sightline 1\nwalls 0 0 20 0 20 30 0 30 0 0\n"
                               "walls 40 0 40 30\nwall 20 0 40 0\n";
    sl_map read = {0};
    draw_map map = {0};
    assert_ok(context, sli_map_read_text(context, "half", text, strlen(text), &read));
    assert_ok(context, sl_bake(context, &read, NULL, &map.baked, NULL));
    for (int dark = 0; dark < 2; dark++) {
        const picture p = draw(&map, options_for(SL_LAYER_WALLS, SL_NO_CELL, dark));
        const sl_colour floor = sl_palette_make(dark).floor[0];
        assert_int_equal(count_on(&p, 1, 15, 19, 15, floor), 101);
        const int plain = count_on(&p, 21, 15, 39, 15, floor);
        assert_true(plain > 50 && plain < 98);
        cairo_surface_destroy(p.surface);
    }
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// Squares of a heat map that reach into rock are covered by it. Cells of rock are refused.
static void rock_is_over_heat_and_has_no_view(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = {0};
    bake_rock(context, false, &map.baked);
    double values[4] = {1, 2, 3, 4};
    const sl_field field = {.name = "area", .step = 20, .columns = 2, .rows = 2, .values = values};
    char directory[32], path[48];
    draw_directory(directory);
    snprintf(path, sizeof path, "%s/a.png", directory);
    sl_draw_options options = options_for(SL_LAYER_WALLS, SL_NO_CELL, false);
    assert_ok(context, sl_draw_field_file(context, &map.baked, &field, &options, path));
    cairo_surface_t *surface = cairo_image_surface_create_from_png(path);
    const picture p = {surface, cairo_image_surface_get_width(surface),
                       cairo_image_surface_get_height(surface)};
    assert_int_equal(count_on(&p, 11, 12, 29, 12, sl_palette_make(false).solid), 101);
    cairo_surface_destroy(surface);
    options.cell = sl_space_locate(&map.baked.space, (sl_point){11, 15});
    assert_int_equal(sl_draw_file(context, &map.baked, &options, path), SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(context), "is solid ground"));
    unlink(path);
    assert_int_equal(rmdir(directory), 0);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

static picture draw_field(const draw_map *map, const sl_field *field, double width) {
    sl_context *context = testing_context(NULL);
    char directory[32], path[48];
    draw_directory(directory);
    snprintf(path, sizeof path, "%s/a.png", directory);
    sl_draw_options options = options_for(SL_LAYER_WALLS, SL_NO_CELL, false);
    options.width = width;
    assert_ok(context, sl_draw_field_file(context, &map->baked, field, &options, path));
    cairo_surface_t *surface = cairo_image_surface_create_from_png(path);
    unlink(path);
    assert_int_equal(rmdir(directory), 0);
    sl_context_destroy(context);
    return (picture){surface, cairo_image_surface_get_width(surface),
                     cairo_image_surface_get_height(surface)};
}

/// In an L, the square at the inner corner reaches outside: it ends there, and the outside looks as
/// it does without the square.
static void squares_end_at_outer_walls(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    static const char text[] =
        "sightline 1\nwalls 0 0 40 0 40 10 20 10 20 30 0 30 0 0\nstart 5 5 0\n";
    sl_map read = {0};
    draw_map map = {0};
    assert_ok(context, sli_map_read_text(context, "l", text, strlen(text), &read));
    assert_ok(context, sl_bake(context, &read, NULL, &map.baked, NULL));
    double values[2][2] = {{1, 3}, {1, NAN}}; // the second one's middle is 19.5,9
    sl_field field = {.name = "area",
                      .corner = {3, 3.5},
                      .step = 11,
                      .columns = 2,
                      .rows = 1,
                      .least = 0,
                      .most = 3};
    picture drawn[2];
    for (int i = 0; i < 2; i++) {
        field.values = values[i];
        drawn[i] = draw_field(&map, &field, WIDTH);
    }
    const sl_colour high = sl_palette_ramp(false, 63.5 / 64);
    assert_int_equal(count_on(&drawn[0], 15, 12, 19, 12, high), 101);
    assert_int_equal(count_on(&drawn[0], 21, 8, 24, 8, high), 101);
    assert_int_equal(count_on(&drawn[0], 21, 12, 24, 12, high), 0);
    for (int i = 0; i < 100; i++) {
        const double x = 20.6 + 0.04 * i;
        assert_true(same(colour_at(&drawn[0], x, 12), colour_at(&drawn[1], x, 12)));
    }
    for (int i = 0; i < 2; i++) cairo_surface_destroy(drawn[i].surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// Two maps with different values are coloured alike on one scale. Values beyond it have the
/// colours of its ends.
static void a_scale_makes_heat_maps_comparable(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    // Squares of side 20 in two columns; 5,25 lies in the upper left one and so on.
    const double few[4] = {0, 10, 20, 30}, many[4] = {-100, 10, 20, 900};
    sl_field field = {.name = "area",
                      .step = 20,
                      .columns = 2,
                      .rows = 2,
                      .values = few,
                      .least = 10,
                      .most = 20};
    const sl_colour low = sl_palette_ramp(false, 0.5 / 64),
                    high = sl_palette_ramp(false, 63.5 / 64);
    const picture a = draw_field(&map, &field, WIDTH);
    field.values = many;
    const picture b = draw_field(&map, &field, WIDTH);
    assert_int_equal(a.height, b.height);
    static const struct {
        sl_point at;
        bool high;
    } places[] = {
        {{5.5, 5.5}, false}, {{24.5, 5.5}, false}, {{5.5, 24.5}, true}, {{24.5, 24.5}, true}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const sl_point at = places[i].at;
        const sl_colour wanted = places[i].high ? high : low;
        assert_int_equal(count_on(&a, at.x, at.y, at.x + 1, at.y, wanted), 101);
        assert_int_equal(count_on(&b, at.x, at.y, at.x + 1, at.y, wanted), 101);
    }
    // The tips reach beyond the ramp where values do.
    field.least = -100;
    field.most = 900;
    const picture c = draw_field(&map, &field, WIDTH);
    const int middle = a.height - 28 - 46 + 8;
    assert_true(same(pixel_at(&a, MARGIN - 3, middle), low));
    assert_true(same(pixel_at(&c, MARGIN - 3, middle), sl_palette_make(false).page));
    cairo_surface_destroy(a.surface);
    cairo_surface_destroy(b.surface);
    cairo_surface_destroy(c.surface);
    sl_draw_options options = options_for(SL_LAYER_WALLS, SL_NO_CELL, false);
    const double wrong[][2] = {{2, 1}, {NAN, 1}, {0, INFINITY}, {0, 1e301}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        field.least = wrong[i][0];
        field.most = wrong[i][1];
        assert_int_equal(sl_draw_field_file(context, &map.baked, &field, &options, "never.png"),
                         SL_BAD_ARGUMENT);
    }
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// The longest piece of a band of rows without a gap of some pixels.
/// Values that are equal but for rounding have one colour, and one number below the ramp.
static void equal_values_have_one_colour(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    const double noisy[4] = {1.1, nextafter(1.1, 2), nextafter(1.1, 1), 1.1},
                 equal[4] = {1.1, 1.1, 1.1, 1.1}, apart[4] = {1.1, 1.1000000001, 1.1, 1.1};
    sl_field field = {.name = "area", .step = 20, .columns = 2, .rows = 2, .values = equal};
    const picture a = draw_field(&map, &field, WIDTH);
    field.values = noisy;
    const picture b = draw_field(&map, &field, WIDTH);
    field.values = apart;
    const picture c = draw_field(&map, &field, WIDTH);
    size_t noise = 0, change = 0;
    for (int y = 0; y < a.height; y++)
        for (int x = 0; x < a.width; x++) {
            noise += !same(pixel_at(&a, x, y), pixel_at(&b, x, y));
            change += !same(pixel_at(&a, x, y), pixel_at(&c, x, y));
        }
    assert_int_equal(noise, 0);
    assert_true(change > 0);
    cairo_surface_destroy(a.surface);
    cairo_surface_destroy(b.surface);
    cairo_surface_destroy(c.surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// Lines without a value are grey, and the name of the scale says so.
static void grey_lines_are_explained(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    const sl_segment lines[3] = {{{1, 1}, {9, 1}}, {{1, 2}, {9, 2}}, {{1, 3}, {9, 3}}};
    const double values[2][3] = {{1, 2, 1}, {1, 2, NAN}};
    picture drawn[2];
    for (int i = 0; i < 2; i++) {
        const sl_drawn_lines all = {
            .name = "depth", .lines = lines, .values = values[i], .count = 3};
        char directory[32], path[48];
        draw_directory(directory);
        snprintf(path, sizeof path, "%s/a.png", directory);
        const sl_draw_options options = options_for(SL_LAYER_WALLS, SL_NO_CELL, false);
        assert_ok(context, sl_draw_lines_file(context, &map.baked, &all, &options, path));
        cairo_surface_t *surface = cairo_image_surface_create_from_png(path);
        unlink(path);
        assert_int_equal(rmdir(directory), 0);
        drawn[i] = (picture){surface, cairo_image_surface_get_width(surface),
                             cairo_image_surface_get_height(surface)};
    }
    assert_int_equal(drawn[0].height, drawn[1].height);
    // The ramp and its numbers are the same; the words beside it are more.
    size_t differ = 0;
    for (int y = drawn[0].height - 74; y < drawn[0].height; y++)
        for (int x = 0; x < drawn[0].width; x++)
            differ += !same(pixel_at(&drawn[0], x, y), pixel_at(&drawn[1], x, y));
    assert_true(differ > 50);
    cairo_surface_destroy(drawn[0].surface);
    cairo_surface_destroy(drawn[1].surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

static int longest_word(const picture *p, int top, int bottom, int gap) {
    const sl_colour page = sl_palette_make(false).page;
    int longest = 0, first = -1, last = -1;
    for (int x = 0; x < p->width; x++) {
        bool ink = false;
        for (int y = top; y < bottom && !ink; y++) ink = !same(pixel_at(p, x, y), page);
        if (!ink) continue;
        if (first < 0 || x - last > gap) first = x;
        last = x;
        if (last - first + 1 > longest) longest = last - first + 1;
    }
    return longest;
}

/// Found on a level of a game: "5.436e+04" stood over "7.837e+05".
static void numbers_of_a_scale_do_not_touch(void **state) {
    (void)state;
    static const double ends[][2] = {{54357.25, 2972123.5}, {0.000123, 0.000124}, {-3e7, 1e8},
                                     {1e14, 3e15},          {-1e-9, 1e9},         {7, 7},
                                     {1e-300, 1e300},       {1e15, 1e15 + 1}};
    static const int widths[] = {WIDTH, 200, 64};
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
        for (size_t k = 0; k < sizeof widths / sizeof *widths; k++) {
            const sl_field field = {
                .name = "area", .step = 20, .columns = 2, .rows = 1, .values = ends[i]};
            const picture p = draw_field(&map, &field, widths[k]);
            const double text = 16.5 * pow(widths[k] / 1200.0, 0.75);
            const int end = (int)(p.height - 0.028 * widths[k]);
            // The name stands beside the ramp, where it is wide enough.
            const int longest = longest_word(&p, (int)(end - 1.3 * text), (int)(end - 0.4 * text),
                                             (int)(0.35 * text));
            if (k == 0 && !(longest > 2 && longest < 11 * text))
                fail_msg("scale %zu: a word of %d pixels", i, longest);
            cairo_surface_destroy(p.surface);
        }
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// Wherever the map stands and however large it is, the same picture comes out.
static void place_and_size_do_not_matter(void **state) {
    (void)state;
    static const draw_place places[] = {
        {1099511627776, -1099511627776, 1, 1},
        {0, 0, 0x1p-480, 0x1p-480},
        {0, 0, 0x1p490, 0x1p490},
        {-0x1p495, 0x1p494, 0x1p490, 0x1p490},
    };
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    const unsigned layers = (unsigned)sl_draw_options_default().layers & ~(unsigned)SL_LAYER_LEGEND;
    const picture plain = draw(&map, options_for(layers | SL_LAYER_STAB_TREE, map.cells[0], false));
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        draw_map other = draw_map_make(context, places[i]);
        const picture p =
            draw(&other, options_for(layers | SL_LAYER_STAB_TREE, other.cells[0], false));
        assert_int_equal(p.height, plain.height);
        for (int y = 0; y < p.height; y += 3)
            for (int x = 0; x < p.width; x += 3)
                if (!same(pixel_at(&p, x, y), pixel_at(&plain, x, y)))
                    fail_msg("place %zu: pixel %d, %d differs", i, x, y);
        cairo_surface_destroy(p.surface);
        sl_baked_destroy(context, &other.baked);
    }
    cairo_surface_destroy(plain.surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// A map a million times longer than wide keeps its shape on a page of a bounded one.
static void thin_maps_are_not_stretched(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_palette palette = sl_palette_make(false);
    const draw_place flat = {0, 0, 1e6, 1}, tall = {0, 0, 1, 1e6};
    draw_map map = draw_map_make(context, flat);
    picture p = draw(&map, options_for(SL_LAYER_WALLS, SL_NO_CELL, false));
    assert_int_equal(p.height, 80 + (920 + 5) / 6);
    int drawn = 0;
    for (int y = 0; y < p.height; y++) drawn += !same(pixel_at(&p, 500, y), palette.page);
    assert_true(drawn >= 1 && drawn <= 3);
    assert_false(same(pixel_at(&p, 500, p.height / 2 - 1), palette.page));
    cairo_surface_destroy(p.surface);
    sl_baked_destroy(context, &map.baked);
    map = draw_map_make(context, tall);
    p = draw(&map, options_for(SL_LAYER_WALLS, SL_NO_CELL, false));
    assert_int_equal(p.height, 80 + 920 * 14 / 10);
    drawn = 0;
    for (int x = 0; x < p.width; x++) drawn += !same(pixel_at(&p, x, 100), palette.page);
    assert_true(drawn >= 1 && drawn <= 3);
    cairo_surface_destroy(p.surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// A frame, as a window has it, of a millionth of a cell or of a wall's surroundings.
static void a_view_zoomed_in_shows_what_is_there(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    const sl_palette palette = sl_palette_make(false);
    const sl_draw_options options = options_for(127, map.cells[LEFT_BELOW], false);
    sl_scene scene;
    assert_ok(context, sli_scene_make(context, &map.baked, &options, NULL, &scene));
    static const sl_point corners[] = {{10, 8}, {30, 8}, {10, 12}, {10, 10 - 0.5e-9}, {500, 500}};
    const sl_colour expected[] = {palette.source, {0, 0, 0}, {0, 0, 0}, palette.wall, palette.page};
    for (size_t i = 0; i < 5; i++) {
        picture p = {cairo_image_surface_create(CAIRO_FORMAT_RGB24, 100, 100), 100, 100};
        cairo_t *cairo = cairo_create(p.surface);
        cairo_set_source_rgb(cairo, palette.page.red, palette.page.green, palette.page.blue);
        cairo_paint(cairo);
        const sl_frame frame = {corners[i], 1e11, 0, 0, 100, 100, 1};
        assert_ok(context, sl_draw_plan(context, cairo, &scene, options.layers, &frame));
        assert_int_equal(cairo_status(cairo), CAIRO_STATUS_SUCCESS);
        cairo_destroy(cairo);
        cairo_surface_flush(p.surface);
        const sl_colour middle = pixel_at(&p, 50, 50);
        if (i == 1)
            assert_true(one_of(middle, palette.seen));
        else if (i == 2)
            assert_true(one_of(middle, palette.floor));
        else
            assert_true(same(middle, expected[i]));
        if (i != 3) assert_true(same(pixel_at(&p, 0, 0), pixel_at(&p, 99, 99)));
        cairo_surface_destroy(p.surface);
    }
    sli_scene_clear(context, &scene);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

/// How many pixels in a box of the map are nearer to ink than to any floor.
static int count_ink(const picture *p, double x0, double y0, double x1, double y1) {
    const sl_palette palette = sl_palette_make(false);
    int count = 0;
    for (int i = 0; i <= 60; i++)
        for (int k = 0; k <= 60; k++) {
            const sl_colour c = colour_at(p, x0 + (x1 - x0) * i / 60, y0 + (y1 - y0) * k / 60);
            count += fabs(c.green - palette.ink.green) < 0.3 && fabs(c.red - palette.ink.red) < 0.3;
        }
    return count;
}

static void numbers_stand_in_cells_that_have_room(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    draw_map map = draw_map_make(context, DRAW_PLAIN);
    sl_draw_options options = options_for(SL_LAYER_NUMBERS, SL_NO_CELL, false);
    const picture p = draw(&map, options);
    const picture none = draw(&map, options_for(SL_LAYER_CELLS, SL_NO_CELL, false));
    // In the middles of cells, and nowhere else in them.
    assert_true(count_ink(&p, 9, 4.5, 11, 5.5) > 10);
    assert_true(count_ink(&p, 29, 14.5, 31, 15.5) > 10);
    assert_int_equal(count_ink(&p, 1, 1, 8, 4), 0);
    assert_int_equal(count_ink(&none, 9, 4.5, 11, 5.5), 0);
    // Cells that come out tiny have none.
    cairo_surface_t *small = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 20, 15);
    cairo_t *cairo = cairo_create(small);
    sl_scene scene;
    assert_ok(context, sli_scene_make(context, &map.baked, &options, NULL, &scene));
    const sl_frame frame = sl_frame_fit(map.baked.space.bounds, 0, 0, 20, 15, 1);
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    sli_draw_numbers(cairo, &scene, &frame);
    cairo_surface_flush(small);
    const unsigned char *pixels = cairo_image_surface_get_data(small);
    for (int i = 0; i < 15 * cairo_image_surface_get_stride(small); i++)
        if (i % 4 != 3) assert_int_equal(pixels[i], 255);
    cairo_destroy(cairo);
    cairo_surface_destroy(small);
    sli_scene_clear(context, &scene);
    cairo_surface_destroy(p.surface);
    cairo_surface_destroy(none.surface);
    sl_baked_destroy(context, &map.baked);
    sl_context_destroy(context);
}

static void lightness_of_the_ramp_runs_one_way(void **state) {
    (void)state;
    for (int dark = 0; dark < 2; dark++) {
        double before = dark ? -1 : 2;
        for (int i = 0; i <= 100; i++) {
            const sl_colour c = sl_palette_ramp(dark, i / 100.0);
            const double luminance =
                0.2126 * pow(c.red, 2.2) + 0.7152 * pow(c.green, 2.2) + 0.0722 * pow(c.blue, 2.2);
            assert_true(dark ? luminance > before : luminance < before);
            before = luminance;
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_of_cell_has_its_colour),
        cmocka_unit_test(neighbours_have_different_tones),
        cmocka_unit_test(what_a_mirror_sends_back_has_its_hue),
        cmocka_unit_test(layers_draw_their_lines),
        cmocka_unit_test(stab_tree_runs_from_the_start_to_the_portal),
        cmocka_unit_test(heat_runs_over_the_whole_ramp),
        cmocka_unit_test(doubtful_cells_stand_out),
        cmocka_unit_test(counts_refer_to_the_right_cells),
        cmocka_unit_test(solid_ground_is_filled_as_a_whole),
        cmocka_unit_test(outside_is_hatched_where_it_is_shown),
        cmocka_unit_test(rock_is_over_heat_and_has_no_view),
        cmocka_unit_test(a_scale_makes_heat_maps_comparable),
        cmocka_unit_test(squares_end_at_outer_walls),
        cmocka_unit_test(equal_values_have_one_colour),
        cmocka_unit_test(grey_lines_are_explained),
        cmocka_unit_test(numbers_of_a_scale_do_not_touch),
        cmocka_unit_test(place_and_size_do_not_matter),
        cmocka_unit_test(thin_maps_are_not_stretched),
        cmocka_unit_test(a_view_zoomed_in_shows_what_is_there),
        cmocka_unit_test(numbers_stand_in_cells_that_have_room),
        cmocka_unit_test(lightness_of_the_ramp_runs_one_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
