// Pictures of drawing programs: what is solid on a dark page, and lettering.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/io.h"

enum { SIDE = 200 };

/// A picture that is painted by rectangles.
typedef struct painting {
    char bytes[SIDE * SIDE + 32];
    size_t header;
    char notes[4096];
    sl_map map;
    sl_context *context;
} painting;

static void begin(painting *p, int grey) {
    *p = (painting){0};
    p->header = (size_t)snprintf(p->bytes, 32, "P5 %d %d 255\n", SIDE, SIDE);
    memset(p->bytes + p->header, grey, (size_t)SIDE * SIDE);
}

static void paint(painting *p, int x, int y, int width, int height, int grey) {
    for (int v = y; v < y + height; v++)
        memset(p->bytes + p->header + (size_t)v * SIDE + x, grey, (size_t)width);
}

static void frame(painting *p, int x, int y, int width, int height, int thick, int grey) {
    paint(p, x, y, width, thick, grey);
    paint(p, x, y + height - thick, width, thick, grey);
    paint(p, x, y, thick, height, grey);
    paint(p, x + width - thick, y, thick, height, grey);
}

/// Reads it and compares the number of walls.
static void assert_read(painting *p, const char *layers, double threshold, size_t walls) {
    const sl_hooks hooks = {.user = p->notes, .note = import_keep_notes};
    sl_import_options options = sl_import_options_default();
    options.layers = layers;
    options.threshold = threshold;
    p->notes[0] = '\0';
    p->context = sl_context_create(&hooks);
    assert_non_null(p->context);
    assert_ok(p->context, sli_map_read_image(p->context, "f", p->bytes,
                                             p->header + (size_t)SIDE * SIDE, &options, &p->map));
    if (p->map.wall_count != walls)
        fail_msg("%zu walls, not %zu: %s", p->map.wall_count, walls, p->notes);
    sl_map_destroy(p->context, &p->map);
    sl_context_destroy(p->context);
}

static void assert_note(const painting *p, const char *note, bool is) {
    if ((strstr(p->notes, note) != NULL) != is)
        fail_msg("'%s' is%s in '%s'", note, is ? " not" : "", p->notes);
}

/// A wall about the picture, its inner edge in many greys, as drawing programs make them.
static void soft_frame(painting *p) {
    frame(p, 5, 5, 190, 190, 4, 0);
    for (int i = 9; i < 190; i++) paint(p, i, 9, 1, 1, 150 + i / 2);
}

/// Three letters: an L, a T and an I.
static void letter(painting *p, int x, int y) {
    paint(p, x, y, 1, 7, 0);
    paint(p, x, y + 6, 4, 1, 0);
    paint(p, x + 6, y, 5, 1, 0);
    paint(p, x + 8, y, 1, 7, 0);
    paint(p, x + 13, y, 1, 7, 0);
}

/// Light lines on a dark page with a grid that is hardly lighter, up to the edge.
static void test_faint_grid(void **state) {
    (void)state;
    painting p;
    begin(&p, 18);
    for (int i = 0; i < SIDE; i += 4) {
        paint(&p, i, 0, 2, SIDE, 40);
        paint(&p, 0, i, SIDE, 2, 40);
    }
    frame(&p, 30, 30, 140, 140, 2, 200);
    assert_read(&p, NULL, 0, 8);
    assert_note(&p, "light on a dark ground", true);
}

/// A name in letters as large as a room is a small part of what is light.
static void test_large_letter(void **state) {
    (void)state;
    painting p;
    begin(&p, 0);
    for (int i = 0; i < 4; i++) frame(&p, 10, 10 + 45 * i, 180, 40, 2, 255);
    paint(&p, 90, 65, 8, 8, 255);
    assert_read(&p, NULL, 0, 36);
    assert_note(&p, "light on a dark ground", true);
}

/// Where a part of what is light is thick, it may be rooms in rock; where most of it is, it is.
static void test_dark_page_in_doubt(void **state) {
    (void)state;
    painting p;
    begin(&p, 0);
    frame(&p, 10, 10, 180, 180, 3, 255);
    paint(&p, 90, 60, 20, 40, 255);
    assert_read(&p, NULL, 0, 4 + 12);
    assert_note(&p,
                "f: the page is dark and solid, and what is light on it is mostly thin: if it "
                "is the walls: --layers light\n",
                true);
    // What is dark in light ground is no lettering then.
    for (int i = 13; i < 187; i++) paint(&p, i, 13, 1, 1, 150 + i / 2);
    letter(&p, 93, 90);
    assert_read(&p, NULL, 0, 4 + 12 + 6 + 8 + 4);
    assert_note(&p, "the page is dark", true);
    assert_read(&p, "light", 0, 12 + 6 + 8 + 4);
    assert_note(&p, "the page is dark", false);
    begin(&p, 0);
    paint(&p, 20, 20, 60, 60, 255);
    paint(&p, 80, 40, 50, 4, 255);
    paint(&p, 130, 20, 40, 60, 255);
    assert_read(&p, NULL, 0, 4 + 12);
    assert_note(&p, "the page is dark", false);
}

/// Rooms that are dark, too, are open with the threshold that is told.
static void test_two_dark_tones(void **state) {
    (void)state;
    painting p;
    begin(&p, 18);
    paint(&p, 20, 20, 80, 160, 44);
    paint(&p, 102, 20, 80, 160, 44);
    paint(&p, 140, 100, 20, 20, 255);
    assert_read(&p, NULL, 0, 4 + 4);
    assert_note(&p,
                "f: two dark tones are solid (lightness about 0.07 and 0.17): if the lighter "
                "one is open ground: --threshold 0.88\n",
                true);
    assert_read(&p, NULL, 0.88, 4 + 8);
    assert_note(&p, "two dark tones", false);
}

static void test_lettering(void **state) {
    (void)state;
    painting p;
    begin(&p, 255);
    soft_frame(&p);
    for (int i = 0; i < 6; i++) letter(&p, 60, 40 + 20 * i);
    // A point, and a number behind a space. Columns: beside a word, alone, and a row of
    // them that are as near to each other as letters are.
    paint(&p, 76, 46, 1, 1, 0);
    paint(&p, 78, 60, 1, 7, 0);
    paint(&p, 78, 80, 6, 6, 0);
    paint(&p, 120, 60, 6, 6, 0);
    for (int i = 0; i < 5; i++) paint(&p, 20 + 9 * i, 170, 6, 6, 0);
    assert_read(&p, NULL, 0, 8 + 7 * 4);
    assert_note(&p,
                "f: 20 small pieces in rows are left out as lettering; --layers dark takes "
                "them too\n",
                true);
    assert_note(&p, "f: 7 small pieces of up to 6 x 6 pixels touch nothing", true);
    assert_read(&p, "dark", 0, 8 + 7 * 4 + 2 * 4 + 6 * (6 + 8 + 4));
    assert_note(&p, "left out as lettering", false);
    assert_read(&p, "large", 0, 8);
    // Without soft edges it is a mask, and each of its pixels counts.
    begin(&p, 255);
    frame(&p, 5, 5, 190, 190, 4, 0);
    letter(&p, 60, 40);
    assert_read(&p, NULL, 0, 8 + 6 + 8 + 4);
}

/// The same words run up the picture.
static void test_lettering_upright(void **state) {
    (void)state;
    painting p, turned;
    begin(&p, 255);
    soft_frame(&p);
    for (int i = 0; i < 6; i++) letter(&p, 60, 40 + 20 * i);
    turned = p;
    for (size_t y = 0; y < SIDE; y++)
        for (size_t x = 0; x < SIDE; x++)
            turned.bytes[p.header + y * SIDE + x] = p.bytes[p.header + x * SIDE + y];
    assert_read(&turned, NULL, 0, 8);
    assert_note(&turned, "f: 18 small pieces in rows are left out as lettering", true);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_faint_grid),         cmocka_unit_test(test_large_letter),
        cmocka_unit_test(test_dark_page_in_doubt), cmocka_unit_test(test_two_dark_tones),
        cmocka_unit_test(test_lettering),          cmocka_unit_test(test_lettering_upright),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
