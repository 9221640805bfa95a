/// Drawing into a context of one's own: frames, scenes, the dual plane, and page files.
#include "draw/marks.h"
#include "sightline/draw.h"

#include "test_draw_map.h"

#include <cairo.h>
#include <math.h>
#include <unistd.h>

/// Ten pixels for a unit of the map, which is 40 x 30.
enum { WIDTH = 400, HEIGHT = 300 };

typedef struct canvas {
    sl_context *context;
    draw_map map;
    cairo_surface_t *surface;
    cairo_t *cairo;
    sl_frame frame;
    sl_palette palette;
} canvas;

static int set_up(void **state) {
    canvas *c = calloc(1, sizeof *c);
    if (!c) return -1;
    c->context = testing_context(NULL);
    c->map = draw_map_make(c->context, DRAW_PLAIN);
    c->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
    c->cairo = cairo_create(c->surface);
    c->frame = sl_frame_fit(c->map.baked.space.bounds, 0, 0, WIDTH, HEIGHT, 1);
    c->palette = sl_palette_make(false);
    *state = c;
    return 0;
}

static int tear_down(void **state) {
    canvas *c = *state;
    const cairo_status_t status = cairo_status(c->cairo);
    cairo_destroy(c->cairo);
    cairo_surface_destroy(c->surface);
    sl_baked_destroy(c->context, &c->map.baked);
    sl_context_destroy(c->context);
    free(c);
    return status != CAIRO_STATUS_SUCCESS;
}

static bool has_colour(const canvas *c, double x, double y, sl_colour colour) {
    const sl_point at = sl_frame_point(&c->frame, (sl_point){x, y});
    uint32_t value;
    cairo_surface_flush(c->surface);
    memcpy(&value,
           cairo_image_surface_get_data(c->surface) +
               (size_t)at.y * (size_t)cairo_image_surface_get_stride(c->surface) + 4 * (size_t)at.x,
           sizeof value);
    const double wanted[3] = {colour.red, colour.green, colour.blue};
    for (int i = 0; i < 3; i++)
        if (fabs((value >> (16 - 8 * i) & 255) / 255.0 - wanted[i]) > 1.6 / 255) return false;
    return true;
}

static void frames_keep_far_places_finite(void **state) {
    const canvas *c = *state;
    sl_point place;
    assert_true(c->frame.scale == 10);
    assert_true(sl_frame_holds(&c->frame, (sl_point){40, 30}, &place));
    assert_true(place.x == WIDTH && place.y == 0);
    assert_false(sl_frame_holds(&c->frame, (sl_point){4000, 3000}, NULL));
    place = sl_frame_point(&c->frame, (sl_point){1e150, -1e150});
    assert_true(isfinite(place.x) && isfinite(place.y));
}

static void layers_are_drawn_one_by_one(void **state) {
    canvas *c = *state;
    sl_scene *scene = NULL;
    sl_draw_options options = sl_draw_options_default();
    options.cell = c->map.cells[LEFT_BELOW];
    assert_ok(c->context, sl_scene_create(c->context, &c->map.baked, &options, NULL, &scene));
    assert_ok(c->context, sl_draw_plan(c->context, c->cairo, scene, 0, &c->frame));
    assert_true(has_colour(c, 12, 5, c->palette.source));
    assert_false(has_colour(c, 12, 20, c->palette.wall));
    assert_ok(c->context, sl_draw_walls(c->context, c->cairo, scene, &c->frame));
    assert_true(has_colour(c, 12, 20, c->palette.wall));
    sl_scene_destroy(c->context, scene);
    sl_scene_destroy(c->context, NULL);
}

/// The trees that are given stand in the place of the baked ones.
static void trees_may_be_others(void **state) {
    canvas *c = *state;
    sl_scene *scene = NULL;
    const sl_stab_trees none = {0};
    sl_draw_options options = sl_draw_options_default();
    options.layers |= SL_LAYER_STAB_TREE;
    options.cell = c->map.cells[LEFT_BELOW];
    assert_ok(c->context, sl_scene_create(c->context, &c->map.baked, &options, NULL, &scene));
    assert_int_equal(sl_scene_tree_depth(scene), 1);
    sl_draw_tree(c->cairo, scene, (sl_point){5, 5}, 1, &c->frame);
    sl_scene_destroy(c->context, scene);
    assert_ok(c->context, sl_scene_create(c->context, &c->map.baked, &options, &none, &scene));
    assert_int_equal(sl_scene_tree_depth(scene), 0);
    sl_scene_destroy(c->context, scene);
}

static void unknown_cells_are_refused(void **state) {
    canvas *c = *state;
    sl_scene *scene = NULL;
    sl_draw_options options = sl_draw_options_default();
    options.cell = 5;
    assert_int_equal(sl_scene_create(c->context, &c->map.baked, &options, NULL, &scene),
                     SL_BAD_ARGUMENT);
    assert_null(scene);
}

static void places_of_the_dual_plane_are_lines(void **state) {
    (void)state;
    const sl_dual square = {.corners = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, .corner_count = 4};
    const sl_conflict none = {0};
    const sl_dual_frame frame =
        sl_dual_frame_fit(&square, &square, NULL, &none, 10, 20, 200, 100, 1);
    const sl_dual_line middle = sl_dual_frame_line(&frame, (sl_point){110, 70});
    assert_true(fabs(middle.slope) < 1e-12 && fabs(middle.height) < 1e-12);
    const sl_dual_line corner = sl_dual_frame_line(&frame, (sl_point){10, 120});
    assert_true(corner.slope < -1 && corner.height < -1);
}

static void texts_grow_with_their_size(void **state) {
    const canvas *c = *state;
    sl_text_font(c->cairo, 10, false);
    const double small = sl_text_width(c->cairo, "Visible region");
    sl_text_font(c->cairo, 30, false);
    const double large = sl_text_width(c->cairo, "Visible region");
    assert_true(small > 40 && fabs(large - 3 * small) < 0.02 * large);
    sl_text_font(c->cairo, 10, true);
    assert_true(sl_text_width(c->cairo, "Visible region") > small);
    assert_true(sl_text_width(c->cairo, "") == 0);
    // Hundreds of other texts later it is as wide as before.
    for (int i = 0; i < 5000; i++) {
        char text[16];
        snprintf(text, sizeof text, "%d", i);
        assert_true(sl_text_width(c->cairo, text) > 0);
    }
    sl_text_font(c->cairo, 10, false);
    assert_true(sl_text_width(c->cairo, "Visible region") == small);
}

static void texts_break_into_lines(void **state) {
    const canvas *c = *state;
    static const char words[] = "The eye's cell sees it, the eye does not.";
    sl_text_font(c->cairo, 12, false);
    const double wide = sl_text_width(c->cairo, words);
    assert_int_equal(sl_text_lines(c->cairo, 1.01 * wide, words), 1);
    assert_int_equal(sl_text_lines(c->cairo, 0.7 * wide, words), 2);
    assert_int_equal(sl_text_lines(c->cairo, 1.01 * wide, "a\nb"), 2);
    assert_true(sl_text_lines(c->cairo, wide / 8, "a_word_that_is_far_wider_than_that") > 2);
    assert_int_equal(sl_text_lines(c->cairo, wide, ""), 0);
    assert_int_equal(sl_text_show_lines(c->cairo, c->palette.ink, 0, 12, 0.7 * wide, 16, words), 2);
}

/// The columns of the surface that are not blank, from the first to one past the last.
static void find_ink(const canvas *c, int *first, int *end) {
    cairo_surface_flush(c->surface);
    const unsigned char *data = cairo_image_surface_get_data(c->surface);
    const size_t stride = (size_t)cairo_image_surface_get_stride(c->surface);
    *first = WIDTH;
    *end = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            uint32_t value;
            memcpy(&value, data + (size_t)y * stride + 4 * (size_t)x, sizeof value);
            if (!(value & 0xffffff)) continue;
            if (x < *first) *first = x;
            if (x >= *end) *end = x + 1;
        }
}

/// A text that has too little room is cut, and what is drawn keeps within its width.
static void texts_keep_within_their_width(void **state) {
    const canvas *c = *state;
    int first, end;
    sl_text_show_within(c->cairo, c->palette.page, 100, 50, 80, 20, false,
                        "far too many words for such a place");
    find_ink(c, &first, &end);
    assert_true(first >= 99 && first < 110 && end > 140 && end <= 181);
}

/// Names come from files: they may be in any script, or not be UTF-8 at all.
static void texts_may_be_of_any_bytes(void **state) {
    const canvas *c = *state;
    static const char *const texts[] = {"\xd0\x9a\xd0\xb0\xd1\x80\xd1\x82\xd0\xb0",
                                        "\xe5\x9c\xb0\xe5\x9b\xb3", "\xd9\x85\xd9\x83",
                                        "\xff\xfe caf\xe9", "tab\there\nline"};
    sl_text_font(c->cairo, 14, false);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        assert_true(sl_text_width(c->cairo, texts[i]) > 0);
        sl_text_show(c->cairo, c->palette.ink, 10, 100, texts[i]);
        assert_true(sl_text_lines(c->cairo, 50, texts[i]) > 0);
    }
    assert_int_equal(cairo_status(c->cairo), CAIRO_STATUS_SUCCESS);
}

/// Left ends at both sides of right ones: the segments between them cross at (20, 5).
static const sl_portal_ends crossed[2] = {{{15, 5}, {20, 2}}, {{25, 5}, {20, 8}}};

static void conflicts_are_marked_at_their_ends(void **state) {
    canvas *c = *state;
    const sl_conflict conflict = {.verdict = SL_HIDDEN,
                                  .end_count = 4,
                                  .ends = {{0, true}, {1, true}, {0, false}, {1, false}}};
    const sl_conflict half = {.verdict = SL_HIDDEN, .end_count = 1, .ends = {{0, true}}};
    sl_draw_conflict(c->cairo, &c->palette, &c->frame, crossed, &half);
    assert_true(has_colour(c, 15, 5, c->palette.glass));
    assert_false(has_colour(c, 25, 5, c->palette.glass));
    assert_false(has_colour(c, 20, 2, c->palette.start));
    sl_draw_conflict(c->cairo, &c->palette, &c->frame, crossed, &conflict);
    assert_true(has_colour(c, 25, 5, c->palette.glass));
    assert_true(has_colour(c, 20, 2, c->palette.start));
    assert_true(has_colour(c, 20, 8, c->palette.start));
    assert_true(has_colour(c, 22, 5, c->palette.glass)); // between the left ends
    assert_true(has_colour(c, 20, 4, c->palette.start)); // between the right ones, drawn last
    assert_true(has_colour(c, 15.7, 5, c->palette.ink)); // the rim
}

static void portals_that_turn_get_arrows(void **state) {
    canvas *c = *state;
    const sl_portal_ends turned[2] = {{{10, 10}, {10, 4}}, {{30, 4}, {30, 10}}};
    sl_conflict conflict;
    assert_ok(c->context, sl_conflict_find(c->context, turned, 2, &conflict));
    assert_true(conflict.turns && conflict.verdict == SL_HIDDEN);
    sl_draw_conflict(c->cairo, &c->palette, &c->frame, turned, &conflict);
    // To the right through the first, to the left through the second.
    assert_true(has_colour(c, 11, 7, c->palette.ink) && has_colour(c, 29, 7, c->palette.ink));
    assert_true(has_colour(c, 10, 10, c->palette.glass) && has_colour(c, 30, 10, c->palette.start));
}

static void contradictions_lie_in_the_frame(void **state) {
    canvas *c = *state;
    sl_random random = {5};
    for (int i = 0; i < 300; i++) {
        sl_portal_ends ends[3];
        sl_dual dual, before;
        sl_conflict conflict;
        for (int k = 0; k < 3; k++) {
            const double x = 10 * k + (double)sl_random_below(&random, 5);
            const double y = (double)sl_random_below(&random, 12);
            ends[k] = (sl_portal_ends){{x, y + 1 + (double)sl_random_below(&random, 4)}, {x, y}};
        }
        sl_dual_make(ends, 3, 3, &dual);
        sl_dual_make(ends, 3, 2, &before);
        assert_ok(c->context, sl_conflict_find(c->context, ends, 3, &conflict));
        const sl_dual_frame f =
            sl_dual_frame_fit(&dual, &before, ends, &conflict, 10, 20, 200, 100, 1);
        for (uint32_t k = 0; k < conflict.end_count; k++) {
            const sl_portal_ends *at = &ends[conflict.ends[k].portal];
            const sl_point p = sl_dual_point(&dual, conflict.ends[k].left ? at->left : at->right);
            const sl_dual_line on = {dual.best.slope, p.y - dual.best.slope * p.x};
            const sl_point place = sl_dual_frame_point(&f, on);
            assert_true(place.x > 10 && place.x < 210 && place.y > 20 && place.y < 120);
            const sl_dual_line back = sl_dual_frame_line(&f, place);
            assert_true(fabs(back.slope - on.slope) < 1e-9 && fabs(back.height - on.height) < 1e-9);
        }
    }
}

static void equations_are_those_of_half_planes(void **state) {
    (void)state;
    const sl_dual plain = {.along = {1, 0}, .scale = 1};
    char text[SLI_EQUATION_TEXT];
    sli_dual_equation(&plain, (sl_point){0.25, -2}, true, text);
    assert_string_equal(text, "b \xe2\x89\xa4 \xe2\x88\x92"
                              "2 \xe2\x88\x92 0.25 a");
    sli_dual_equation(&plain, (sl_point){-1.5, 3}, false, text);
    assert_string_equal(text, "b \xe2\x89\xa5 3 + 1.5 a");
    sli_dual_equation(&plain, (sl_point){1e-9, 1e-9}, true, text);
    assert_string_equal(text, "b \xe2\x89\xa4 0 \xe2\x88\x92 0 a");
}

/// How many pixels of the picture have a colour.
static int count_pixels(const canvas *c, sl_colour colour) {
    int count = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            count += has_colour(c, (x + 0.5) / 10, (HEIGHT - y - 0.5) / 10, colour);
    return count;
}

static void marks_of_the_dual_plane_are_drawn(void **state) {
    canvas *c = *state;
    sl_dual dual, before;
    sl_conflict conflict;
    sl_dual_make(crossed, 2, 2, &dual);
    sl_dual_make(crossed, 2, 1, &before);
    assert_ok(c->context, sl_conflict_find(c->context, crossed, 2, &conflict));
    assert_int_equal(conflict.verdict, SL_HIDDEN);
    const sl_dual_frame f =
        sl_dual_frame_fit(&dual, &before, crossed, &conflict, 0, 0, WIDTH, HEIGHT, 1);
    sl_draw_dual(c->cairo, &c->palette, &f, &dual, crossed, 2, dual.best, NULL);
    const int blue = count_pixels(c, c->palette.glass), ink = count_pixels(c, c->palette.ink);
    const sl_dual_marks marks = {.conflict = &conflict};
    sl_draw_dual(c->cairo, &c->palette, &f, &dual, crossed, 2, dual.best, &marks);
    assert_true(count_pixels(c, c->palette.glass) > blue + 100); // thick borders
    assert_true(count_pixels(c, c->palette.ink) > ink + 100);    // and a frame
}

static void draw_disc(void *user, cairo_t *cairo) {
    const sl_palette *palette = user;
    cairo_arc(cairo, 20, 20, 10, 0, 6.283185307179586);
    sl_set_colour(cairo, palette->start);
    cairo_fill(cairo);
}

static void draw_no_text(void *user, cairo_t *cairo) {
    (void)user;
    cairo_show_text(cairo, "\xff\xfe");
}

/// A page that fails leaves the file of before.
static void pages_become_files(void **state) {
    canvas *c = *state;
    char folder[32], path[64];
    draw_directory(folder);
    snprintf(path, sizeof path, "%s/a.png", folder);
    assert_ok(c->context,
              sl_draw_page_file(c->context, path, 40, 30, NULL, draw_disc, &c->palette));
    for (int again = 0; again < 2; again++) {
        cairo_surface_t *read = cairo_image_surface_create_from_png(path);
        assert_int_equal(cairo_image_surface_get_width(read), 40);
        assert_int_equal(cairo_image_surface_get_height(read), 30);
        cairo_surface_destroy(read);
        assert_int_equal(sl_draw_page_file(c->context, path, 50, 50, NULL, draw_no_text, NULL),
                         SL_BAD_ARGUMENT);
    }
    assert_int_equal(sl_draw_page_file(c->context, "a.gif", 40, 30, NULL, draw_disc, &c->palette),
                     SL_BAD_ARGUMENT);
    unlink(path);
    assert_int_equal(rmdir(folder), 0);
}

int main(void) {
#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        CASE(frames_keep_far_places_finite),
        CASE(layers_are_drawn_one_by_one),
        CASE(trees_may_be_others),
        CASE(unknown_cells_are_refused),
        CASE(places_of_the_dual_plane_are_lines),
        CASE(texts_grow_with_their_size),
        CASE(texts_break_into_lines),
        CASE(texts_keep_within_their_width),
        CASE(texts_may_be_of_any_bytes),
        CASE(conflicts_are_marked_at_their_ends),
        CASE(portals_that_turn_get_arrows),
        CASE(contradictions_lie_in_the_frame),
        CASE(equations_are_those_of_half_planes),
        CASE(marks_of_the_dual_plane_are_drawn),
        CASE(pages_become_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
