// DXF: each entity, blocks, layers, the plane they lie in, and what is refused where.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/io.h"

#include <math.h>

#define HEAD "0\nSECTION\n2\nENTITIES\n"
#define TAIL "0\nENDSEC\n0\nEOF\n"

static void assert_walls(const char *entities, const char *expected) {
    char text[4096];
    snprintf(text, sizeof text, HEAD "%s" TAIL, entities);
    assert_walls_of(sli_map_read_dxf, NULL, text, strlen(text), expected);
}

static void assert_refused(const char *text, const char *message) {
    assert_refused_of(sli_map_read_dxf, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

#define LINE(x0, y0, x1, y1)                                                                       \
    "0\nLINE\n8\nw\n10\n" #x0 "\n20\n" #y0 "\n30\n7\n11\n" #x1 "\n21\n" #y1 "\n31\n-7\n"

static void test_lines(void **state) {
    (void)state;
    assert_walls(LINE(0, 0, 4, 3), "wall 0 0 4 3\n");
    assert_walls(LINE(0, 0, 4, 3) LINE(1.5, -2e1, .5, 0), "wall 0 0 4 3\nwall 1.5 -20 0.5 0\n");
    // As release 10 has them in space.
    assert_walls("0\n3DLINE\n8\nw\n10\n0\n20\n0\n30\n1\n11\n4\n21\n3\n31\n2\n", "wall 0 0 4 3\n");
    // Upright in space, so a point in the plan.
    assert_walls(LINE(2, 2, 2, 2), "");
    // Other kinds, and blanks and CR LF, are nothing to stumble over.
    assert_walls("0\r\nTEXT\r\n 10 \r\n 1 \r\n" LINE(0, 0, 1, 0), "wall 0 0 1 0\n");
}

static void test_polylines(void **state) {
    (void)state;
#define CORNERS "10\n0\n20\n0\n10\n4\n20\n0\n10\n4\n20\n2\n"
    assert_walls("0\nLWPOLYLINE\n90\n3\n70\n0\n" CORNERS, "wall 0 0 4 0\nwall 4 0 4 2\n");
    assert_walls("0\nLWPOLYLINE\n90\n3\n70\n1\n" CORNERS,
                 "wall 0 0 4 0\nwall 4 0 4 2\nwall 4 2 0 0\n");
#define VERTEX(x, y) "0\nVERTEX\n10\n" #x "\n20\n" #y "\n"
    assert_walls("0\nPOLYLINE\n70\n1\n" VERTEX(0, 0) VERTEX(2, 0)
                     VERTEX(2, 2) "0\nSEQEND\n" LINE(5, 5, 6, 6),
                 "wall 0 0 2 0\nwall 2 0 2 2\nwall 2 2 0 0\nwall 5 5 6 6\n");
    // A mesh is no line.
    assert_walls("0\nPOLYLINE\n70\n16\n" VERTEX(0, 0) VERTEX(2, 0) "0\nSEQEND\n", "");
}

/// Every wall end within `slack` of a circle, the walls going round by `sweep` in all.
static void assert_round(const char *entities, double tolerance, sl_point centre, double radius,
                         double sweep) {
    char text[4096];
    snprintf(text, sizeof text, HEAD "%s" TAIL, entities);
    sl_context *context = testing_context(NULL);
    sl_import_options options = sl_import_options_default();
    options.tolerance = tolerance;
    sl_map map = {0};
    assert_ok(context, sli_map_read_dxf(context, "f", text, strlen(text), &options, &map));
    double turned = 0;
    for (size_t i = 0; i < map.wall_count; i++) {
        const sl_point a = map.walls[i].a, b = map.walls[i].b;
        const sl_point u = {a.x - centre.x, a.y - centre.y}, v = {b.x - centre.x, b.y - centre.y};
        assert_true(fabs(hypot(u.x, u.y) - radius) < 1e-12 * radius);
        const double middle = hypot((u.x + v.x) / 2, (u.y + v.y) / 2);
        assert_true(radius - middle <= (tolerance > 0 ? tolerance : 0.00501 * radius));
        if (i) assert_true(map.walls[i - 1].b.x == a.x && map.walls[i - 1].b.y == a.y);
        turned += atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y);
    }
    assert_true(fabs(turned - sweep) < 1e-9);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_curves(void **state) {
    (void)state;
    const double turn = 2 * acos(-1);
    const sl_point centre = {3, 4};
    const char *const circle = "0\nCIRCLE\n10\n3\n20\n4\n40\n2\n";
    assert_round(circle, 0, centre, 2, turn);
    assert_round(circle, 0.5, centre, 2, turn);
    assert_round(circle, 1e-5, centre, 2, turn);
    assert_round(circle, 100, centre, 2, turn);
    assert_round("0\nARC\n10\n3\n20\n4\n40\n2\n50\n300\n51\n30\n", 0, centre, 2, turn / 4);
    // A closed polyline of two half circles, then one whose arcs turn the other way.
    assert_round("0\nLWPOLYLINE\n70\n1\n10\n1\n20\n4\n42\n1\n10\n5\n20\n4\n42\n1\n", 0, centre, 2,
                 turn);
    assert_round("0\nLWPOLYLINE\n70\n1\n10\n1\n20\n4\n42\n-1\n10\n5\n20\n4\n42\n-1\n", 0, centre, 2,
                 -turn);
    // A quarter turn from (5,4) to (3,6): bulge tan(90 / 4).
    assert_round("0\nLWPOLYLINE\n10\n5\n20\n4\n42\n0.41421356237309503\n10\n3\n20\n6\n", 0, centre,
                 2, turn / 4);
    // Seen from below, x is mirrored: the arc then turns clockwise.
    assert_round("0\nARC\n10\n-3\n20\n4\n40\n2\n50\n0\n51\n90\n230\n-1\n", 0, centre, 2, -turn / 4);
    assert_walls("0\nCIRCLE\n10\n3\n20\n4\n40\n2\n210\n1\n220\n0\n230\n0\n", "");
    assert_round("0\nELLIPSE\n10\n3\n20\n4\n11\n0\n21\n2\n40\n1\n41\n0\n42\n1.5707963267948966\n",
                 0, centre, 2, turn / 4);
}

static void test_blocks(void **state) {
    (void)state;
#define BLOCK(name, x, y, body) "0\nBLOCK\n2\n" name "\n10\n" #x "\n20\n" #y "\n" body "0\nENDBLK\n"
    static const char text[] = "0\nSECTION\n2\nBLOCKS\n" BLOCK("b", 1, 0, LINE(1, 0, 2, 0)) BLOCK(
        "A", 0, 0,
        "0\nINSERT\n2\nB\n10\n5\n20\n0\n50\n90\n") "0\nENDSEC\n" HEAD
                                                   // As is; mirrored and stretched; in two columns
                                                   // and rows; a block in a block.
                                                   "0\nINSERT\n2\nb\n10\n7\n20\n8\n"
                                                   "0\nINSERT\n2\nb\n10\n0\n20\n0\n41\n-3\n42\n1\n"
                                                   "0\nINSERT\n2\nb\n70\n2\n71\n2\n44\n10\n45\n20\n"
                                                   "0\nINSERT\n2\na\n10\n100\n20\n0\n" TAIL;
    assert_walls_of(sli_map_read_dxf, NULL, text, sizeof text - 1,
                    "wall 7 8 8 8\nwall 0 0 -3 0\n"
                    "wall 0 0 1 0\nwall 10 0 11 0\nwall 0 20 1 20\nwall 10 20 11 20\n"
                    "wall 105 0 105 1\n");
}

static void test_layers(void **state) {
    (void)state;
#define LAYER(name, colour, flags) "0\nLAYER\n2\n" name "\n70\n" #flags "\n62\n" #colour "\n"
#define ON(layer, x)               "0\nLINE\n8\n" layer "\n10\n" #x "\n20\n0\n11\n" #x "\n21\n1\n"
    static const char text[] = "0\nSECTION\n2\nTABLES\n" LAYER("walls", 7, 0) LAYER("off", -7, 0)
        LAYER("frozen", 7,
              1) "0\nENDSEC\n"
                 "0\nSECTION\n2\nBLOCKS\n" BLOCK("b", 0, 0, ON("0", 8)) "0\nENDSEC\n" HEAD ON(
                     "Walls", 1) ON("off", 2) ON("frozen", 3)
                     ON("0", 4) "0\nINSERT\n2\nb\n8\noff\n0\nLINE\n67\n1\n10\n9\n20\n9\n" TAIL;
    assert_walls_of(sli_map_read_dxf, NULL, text, sizeof text - 1, "wall 1 0 1 1\nwall 4 0 4 1\n");
    sl_import_options options = sl_import_options_default();
    options.layers = "OFF, frozen";
    assert_walls_of(sli_map_read_dxf, &options, text, sizeof text - 1,
                    "wall 2 0 2 1\nwall 3 0 3 1\nwall 8 0 8 1\n");
    options.layers = "walls,doors";
    assert_refused_of(sli_map_read_dxf, &options, text, sizeof text - 1, SL_BAD_ARGUMENT,
                      "f: there is no layer 'doors' in the drawing; it has walls, off, frozen");
}

/// A text of several lines, as some programs write it: the lines behind the first are passed over,
/// numbers too. None of them may shift what is a group code, and what its value: a wall would be
/// gone.
static void test_text_of_lines(void **state) {
    (void)state;
    static const char *const lines[] = {
        "Kitchen",          "Kitchen\nA: 4.57\n",  "Office\n101", "Office\n101\n102",
        "Office\n1",        "Office\n3\n1\n0",     "Office\n0",   "Office\n1\n\n4.5\nm\n",
        "Office\n-3\n8\nA", "Office\n1\n\n\n\n\n2"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char text[600];
        snprintf(text, sizeof text, HEAD "0\nTEXT\n8\n0\n1\n%s\n40\n1\n" ON("0", 1) ON("0", 2) TAIL,
                 lines[i]);
        assert_walls_of(sli_map_read_dxf, NULL, text, strlen(text), "wall 1 0 1 1\nwall 2 0 2 1\n");
    }
    // What is no text has one line, and a text ends somewhere
    assert_refused(HEAD "0\nCIRCLE\n8\n0\n1\nKitchen\nA: 4.57\n40\n1\n" ON("0", 1) TAIL,
                   "f:11: expected a group code (a whole number), found 'A: 4.57'");
    char text[600] = HEAD "0\nTEXT\n1\nKitchen\n";
    for (int i = 0; i < 65; i++) strcat(text, "a\n");
    strcat(text, ON("0", 1) TAIL);
    assert_refused(text, "f:8: the text has more lines");
}

static void test_refused(void **state) {
    (void)state;
    assert_refused("", "f: the drawing ends without an EOF");
    assert_refused(HEAD "0\nENDSEC\n", "f:6: the drawing ends without an EOF");
    assert_refused("walls\n0 0 1 1\n",
                   "f:1: expected a group code (a whole number), found 'walls'");
    assert_refused(HEAD "0", "f:5: the file ends where the value of group 0 should be");
    assert_refused("0\nENTITIES\n0\nEOF\n", "f:2: expected a SECTION, found 'ENTITIES'");
    assert_refused("0\nSECTION\n2\nHEADER\n" TAIL, "f: the drawing has no section ENTITIES");
    assert_refused("0\nSECTION\n2\nENTITIES\n0\nEOF\n", "f:4: section 'ENTITIES' has no ENDSEC");
    assert_refused("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n1.5\n0\nENDSEC\n" HEAD TAIL,
                   "f:8: expected a whole number");
    assert_refused("0\nSECTION\n2\nBLOCKS\n" BLOCK(
                       "b", 0, 0, "0\nINSERT\n2\nb\n") "0\nENDSEC\n" HEAD "0\nINSERT\n2\nb\n" TAIL,
                   "f:14: block 'b' is inserted in itself");
    assert_refused("0\nSECTION\n2\nBLOCKS\n" BLOCK(
                       "b", 0, 0, "") "0\nENDSEC\n" HEAD
                                      "0\nINSERT\n2\nb\n70\n30000\n71\n30000\n" TAIL,
                   "f: the drawing's blocks insert one another: 900000001 entities, more than");
    assert_refused("0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nb\n0\nENDSEC\n" HEAD TAIL,
                   "f:10: block 'b' has no ENDBLK");
    assert_refused("AC1027....", "f: a DWG drawing");
    assert_refused("AC2.10....", "f: a DWG drawing");
}

#define IN(unit) "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n" #unit "\n0\nENDSEC\n"

static void test_units(void **state) {
    (void)state;
    sl_import_options options = sl_import_options_default();
    const char *const feet = IN(2) HEAD LINE(0, 10, 100, 0) TAIL;
    options.unit = "m";
    assert_walls_of(sli_map_read_dxf, &options, feet, strlen(feet), "wall 0 3.048 30.48 0\n");
    options.unit = "ft";
    assert_walls_of(sli_map_read_dxf, &options, feet, strlen(feet), "wall 0 10 100 0\n");
    assert_unit_of(sli_map_read_dxf, &options, feet, "ft");
    options.unit = "mm";
    assert_unit_of(sli_map_read_dxf, &options, feet, "mm");
    assert_unit_of(sli_map_read_dxf, NULL, feet, "ft");
    assert_unit_of(sli_map_read_dxf, NULL, IN(13) HEAD LINE(0, 10, 100, 0) TAIL, "\xc2\xb5m");
    assert_unit_of(sli_map_read_dxf, NULL, IN(0) HEAD LINE(0, 10, 100, 0) TAIL, "");
    assert_unit_of(sli_map_read_dxf, NULL, IN(99) HEAD LINE(0, 10, 100, 0) TAIL, "");
    assert_unit_of(sli_map_read_dxf, NULL, HEAD LINE(0, 10, 100, 0) TAIL, "");
    options.unit = "mi";
    assert_refused_of(sli_map_read_dxf, &options, feet, strlen(feet), SL_BAD_ARGUMENT,
                      "there is no unit 'mi'; choose from mm, cm, m, km, in, ft, yd");
    options.unit = "ell";
    assert_refused_of(sli_map_read_dxf, &options, feet, strlen(feet), SL_BAD_ARGUMENT,
                      "there is no unit 'ell'; choose from mm, cm, m, km, in, ft, yd");
    options.unit = "m";
    const char *const untold = HEAD LINE(0, 10, 100, 0) TAIL;
    assert_refused_of(sli_map_read_dxf, &options, untold, strlen(untold), SL_BAD_ARGUMENT,
                      "f: the drawing's own unit is unknown, so it cannot be turned into metres");
    const char *const strange = IN(99) HEAD LINE(0, 10, 100, 0) TAIL;
    assert_refused_of(sli_map_read_dxf, &options, strange, strlen(strange), SL_BAD_ARGUMENT,
                      "f: the drawing's own unit is unusual, so it cannot be turned into metres");
}

/// A drawing that is a picture has no walls to read.
static void test_picture_alone(void **state) {
    (void)state;
#define PICTURE "0\nIMAGE\n8\nw\n10\n0\n20\n0\n"
    assert_refused(HEAD "0\nTEXT\n10\n1\n20\n1\n1\nx\n" PICTURE TAIL,
                   "f:14: the drawing has a picture (IMAGE) and no walls: if the plan is in it, "
                   "save it as a PNG file, and read that");
    assert_walls(PICTURE LINE(0, 0, 4, 3), "wall 0 0 4 3\n");
    assert_walls("", "");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines),         cmocka_unit_test(test_polylines),
        cmocka_unit_test(test_curves),        cmocka_unit_test(test_blocks),
        cmocka_unit_test(test_layers),        cmocka_unit_test(test_text_of_lines),
        cmocka_unit_test(test_units),         cmocka_unit_test(test_refused),
        cmocka_unit_test(test_picture_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
