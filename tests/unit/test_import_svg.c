// SVG: each shape, transforms, paths with all commands, groups and layers, and what is refused.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/io.h"

#include <math.h>

#define SVG(body) "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 20 10'>\n" body "</svg>"

/// y is turned up: the box's lower edge, at y 10, is at 0.
static void assert_walls(const char *text, const char *expected) {
    assert_walls_of(sli_map_read_svg, NULL, text, strlen(text), expected);
}

static void assert_refused(const char *text, const char *message) {
    assert_refused_of(sli_map_read_svg, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

static void test_shapes(void **state) {
    (void)state;
    assert_walls(SVG("<line x1='1' y1='2' x2='3' y2='10'/>"), "wall 1 8 3 0\n");
    assert_walls(SVG("<line x1='1px' x2='1in' y1='1' y2='1'/>"), "wall 1 9 96 9\n");
    assert_walls(SVG("<polyline points='0,0 1,0,1 1'/>"), "wall 0 10 1 10\nwall 1 10 1 9\n");
    assert_walls(SVG("<polygon points='0 0 1 0 1 1'/>"),
                 "wall 0 10 1 10\nwall 1 10 1 9\nwall 1 9 0 10\n");
    assert_walls(SVG("<rect x='1' y='1' width='3' height='2'/>"),
                 "wall 1 9 4 9\nwall 4 9 4 7\nwall 4 7 1 7\nwall 1 7 1 9\n");
    assert_walls(SVG("<rect x='1' y='1' width='3'/>"), "");
    assert_walls("<svg height='4'><line x2='1'/></svg>", "wall 0 4 1 4\n");
    assert_walls("<svg height='100%'><line x2='1'/></svg>", "wall 0 0 1 0\n");
}

static void test_transforms(void **state) {
    (void)state;
#define SHIFTED(transform) SVG("<line transform='" transform "' x2='1'/>")
    assert_walls(SHIFTED("translate(3,4)"), "wall 3 6 4 6\n");
    assert_walls(SHIFTED("translate(3)"), "wall 3 10 4 10\n");
    assert_walls(SHIFTED("rotate(90)"), "wall 0 10 0 9\n");
    assert_walls(SHIFTED("rotate(90 1 0)"), "wall 1 11 1 10\n");
    assert_walls(SHIFTED("scale(2)translate(1 1)"), "wall 2 8 4 8\n");
    assert_walls(SHIFTED("matrix(1 2 3 4 5 6)"), "wall 5 4 6 2\n");
    assert_walls(SVG("<g transform='translate(1 0)'><g transform='scale(2 3)'>"
                     "<line x1='1' y1='1' x2='2' y2='1'/></g></g>"),
                 "wall 3 7 5 7\n");
    assert_walls(
        SVG("<svg x='2' y='2' width='4' height='4' viewBox='0 0 2 1'><line x2='1'/></svg>"),
        "wall 2 7 4 7\n");
    assert_walls(SVG("<defs><g id='a'><line x2='1'/></g></defs><use href='#a' x='5' y='5'/>"),
                 "wall 5 5 6 5\n");
}

static void test_paths(void **state) {
    (void)state;
#define PATH(data) SVG("<path d='" data "'/>")
    assert_walls(PATH("M0 0L1,0 1 1z"), "wall 0 10 1 10\nwall 1 10 1 9\nwall 1 9 0 10\n");
    assert_walls(PATH("m1-1.5.5.5h2v1H0V0"), "wall 1 11.5 1.5 11\nwall 1.5 11 3.5 11\n"
                                             "wall 3.5 11 3.5 10\nwall 3.5 10 0 10\n");
    // Numbers behind a move are lines; a closed subpath starts the next one.
    assert_walls(PATH("m1 1 1 0 0 1zl0 2"),
                 "wall 1 9 2 9\nwall 2 9 2 8\nwall 2 8 1 9\nwall 1 9 1 7\n");
    // Curves that are straight.
    assert_walls(PATH("M0 0C1 0 2 0 3 0S5 0 6 0"), "wall 0 10 3 10\nwall 3 10 6 10\n");
    assert_walls(PATH("M0 0A0 1 0 0 0 5 0"), "wall 0 10 5 10\n");
}

/// All wall ends on a circle about (5,5) in the drawing of radius 5, from one place to another.
static void assert_circle(const char *data, double sweep) {
    char text[512];
    snprintf(text, sizeof text, SVG("<path d='%s'/>"), data);
    sl_context *context = testing_context(NULL);
    const sl_import_options options = sl_import_options_default();
    sl_map map = {0};
    assert_ok(context, sli_map_read_svg(context, "f", text, strlen(text), &options, &map));
    double turned = 0;
    for (size_t i = 0; i < map.wall_count; i++) {
        const sl_point u = {map.walls[i].a.x - 5, map.walls[i].a.y - 5};
        const sl_point v = {map.walls[i].b.x - 5, map.walls[i].b.y - 5};
        assert_true(fabs(hypot(u.x, u.y) - 5) < 1e-12);
        turned += atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y);
    }
    if (fabs(turned - sweep) > 1e-9) fail_msg("%s turns by %g, not %g", data, turned, sweep);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_arcs(void **state) {
    (void)state;
    const double quarter = acos(0);
    // In the drawing y runs down: a positive sweep turns clockwise in the map.
    assert_circle("M10 5A5 5 0 0 1 5 10", -quarter);
    assert_circle("M10 5A5 5 0 1 0 5 10", 3 * quarter);
    assert_circle("M10 5A5 5 30 11 5 0", -3 * quarter);
    assert_circle("M10 5a5 5 0 00-5-5", quarter);
    assert_circle("M10 5A1 1 0 0 1 0 5", -2 * quarter);
    // Béziers: the ends are on the curve, the chords near it.
    sl_context *context = testing_context(NULL);
    sl_import_options options = sl_import_options_default();
    options.tolerance = 0.01;
    sl_map map = {0};
    const char *const text = PATH("M0 10Q5 0 10 10T20 10");
    assert_ok(context, sli_map_read_svg(context, "f", text, strlen(text), &options, &map));
    double highest = -9, lowest = 9;
    for (size_t i = 0; i < map.wall_count; i++) {
        const sl_point at = map.walls[i].b;
        const double t = fmod(at.x, 10) / 10, height = 2 * 10 * t * (1 - t);
        const double expected = at.x < 10 ? height : -height;
        assert_true(at.x == 20 || fabs(at.y - expected) < 1e-12);
        highest = fmax(highest, at.y);
        lowest = fmin(lowest, at.y);
    }
    assert_true(highest > 4.98 && highest <= 5 && lowest < -4.98 && lowest >= -5);
    assert_true(map.wall_count < 100);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_layers(void **state) {
    (void)state;
    static const char text[] =
        SVG("<g id='walls'><line x2='1'/><g display='none'><line x2='2'/></g></g>"
            "<g xmlns:i='urn:i' i:label='Furniture'><line x2='3'/></g><line x2='4'/>"
            "<line x2='5' style='stroke:red; display : none'/><text>no</text>");
    assert_walls(text, "wall 0 10 1 10\nwall 0 10 3 10\nwall 0 10 4 10\n");
    sl_import_options options = sl_import_options_default();
    options.layers = "Furniture";
    assert_walls_of(sli_map_read_svg, &options, text, sizeof text - 1, "wall 0 10 3 10\n");
    options.layers = " walls,";
    assert_walls_of(sli_map_read_svg, &options, text, sizeof text - 1, "wall 0 10 1 10\n");
    options.layers = "walls,x";
    assert_refused_of(sli_map_read_svg, &options, text, sizeof text - 1, SL_BAD_ARGUMENT,
                      "f: there is no layer 'x' in the drawing; it has walls, Furniture");
    // Shapes that say their layer themselves.
    static const char layers[] = SVG(
        "<g xmlns:q='urn:q'><line x2='1' q:layer='A-WALL'/><path d='M0 0h3v3' q:layer='A-WALL'/>"
        "<line x2='4' q:layer='A-FURN'/><line x2='5' data-layer='0'/></g>");
    assert_walls(layers, "wall 0 10 1 10\nwall 0 10 3 10\nwall 3 10 3 7\n");
    options.layers = "A-FURN,0";
    assert_walls_of(sli_map_read_svg, &options, layers, sizeof layers - 1,
                    "wall 0 10 4 10\nwall 0 10 5 10\n");
}

/// Whether a line within g.outer#o > g.inner is hidden by a sheet, and by what it says itself.
static void assert_hidden(bool hidden, const char *sheet, const char *line) {
    char text[1024];
    snprintf(text, sizeof text,
             SVG("<style>%s</style><g class='outer' id='o'><g class='a inner'>"
                 "<line class='no cls-1' id='l' %s x2='1'/></g></g>"),
             sheet, line);
    assert_walls(text, hidden ? "" : "wall 0 10 1 10\n");
}

static void test_style_sheets(void **state) {
    (void)state;
    assert_hidden(true, ".no { display: none }", "");
    assert_hidden(true, ".cls-2,.cls-1{fill:none;display:none}", "");
    assert_hidden(true, "line{visibility:hidden;}", "");
    assert_hidden(true, "#l { fill: red; visibility : hidden }", "");
    assert_hidden(true, "<![CDATA[ /* } */ line.no#l { display:none/**/; } ]]>", "");
    assert_hidden(true, "* {display:none}", "");
    assert_hidden(true, "#o .inner line {display:none}", "");
    assert_hidden(
        true, "@font-face { font-family: x } @media print { a { b: c } } .no{display:none}", "");
    assert_hidden(false, ".n, .nob, rect, #o .outer line, line g {display:none}", "");
    assert_hidden(false, ".no {stroke:none; display:inline; visibility:visible}", "");
    assert_hidden(true, ".no {stroke:none; fill:none}", "");
    assert_hidden(false, "@media print { .no { display: none } }", "");
    assert_hidden(false, ".no { -x-display: none; display: none-such }", "");
    assert_hidden(false, ".no { display: none", "style='display: inline'");
    assert_hidden(false, ".no", "");
    // One declaration counts: important, own, ids, classes, names, the later one; attributes last.
    assert_hidden(false, ".no{display:inline}", "display='none'");
    assert_hidden(true, ".no{display:none}", "display='inline'");
    assert_hidden(true, ".no{display:none !important}", "style='display:inline'");
    assert_hidden(false, ".no{display:none}", "style='display:none;display:inline'");
    assert_hidden(true, ".no{display:none} line{display:inline}", "");
    assert_hidden(true, "#l{display:none} g g line.no.cls-1{display:inline}", "");
    assert_hidden(false, ".no{display:none} .cls-1{display:inline}", "");
    assert_hidden(true, ".no{display:none} line{visibility:visible}", "");
    // Groups, and what is used.
    assert_walls(SVG("<style type='text/css'>.x{display:none}</style><g class='x'><line x2='1'/>"
                     "</g><defs><line id='d' x2='2'/></defs><use class='x' href='#d'/>"),
                 "");
    // Sheets of another language, and selectors that are not known, hide nothing.
    assert_walls(SVG("<style type='text/x'>line{display:none}</style><line x2='1'/>"),
                 "wall 0 10 1 10\n");
    assert_hidden(false, "g > line, line:first-child, [x2] {display:none}", "");
}

static void test_refused(void **state) {
    (void)state;
    assert_refused("", "f: the file is empty");
    assert_refused("<svg>", "f:1: XML: ");
    assert_refused("<svg>\n<line x1='1'</svg>", "f:2: XML: ");
    assert_refused("<html/>", "f:1: expected an svg element, found 'html'");
    assert_refused(SVG("<g id='a'><use href='#a'/></g>"),
                   "f:2: use: element 'a' holds a use of itself");
    assert_refused("<svg viewBox='0 0 0 1'/>", "f:1: viewBox: its width and height");
    // Uses of uses of uses: two to the thirtieth lines.
    char text[4096] = "<svg><line id='u0' x2='1'/>\n", *end = text + strlen(text);
    for (int i = 1; i <= 30; i++)
        end +=
            sprintf(end, "<g id='u%d'><use href='#u%d'/><use href='#u%d'/></g>\n", i, i - 1, i - 1);
    strcpy(end, "</svg>");
    assert_refused(text,
                   "f: the drawing's elements, as often as they are used: 8589934495 entities");
}

static void test_units(void **state) {
    (void)state;
#define SIZED(size) "<svg " size "><line x2='1'/></svg>"
    assert_unit_of(sli_map_read_svg, NULL, SIZED("width='20mm' viewBox='0 0 20 10'"), "mm");
    assert_unit_of(sli_map_read_svg, NULL, SIZED("width='20' viewBox='0 0 20 10'"), "px");
    assert_unit_of(sli_map_read_svg, NULL, SIZED("width='20cm' height='10cm'"), "px");
    assert_unit_of(sli_map_read_svg, NULL, SIZED(""), "px");
    // A user unit is another length here.
    assert_unit_of(sli_map_read_svg, NULL, SIZED("width='21mm' viewBox='0 0 20 10'"), "");
    assert_unit_of(sli_map_read_svg, NULL, SIZED("width='20%' viewBox='0 0 20 10'"), "");
    assert_unit_of(sli_map_read_svg, NULL, SIZED("width='20ell' viewBox='0 0 20 10'"), "");
    assert_unit_of(sli_map_read_svg, NULL, SIZED("viewBox='0 0 20 10'"), "");
    // A plan on a sheet of paper is no building of that size.
#define A4(path) "<svg width='297mm' viewBox='0 0 297 210'><path d='" path "'/></svg>"
    assert_unit_of(sli_map_read_svg, NULL, A4("M0 0h200v150h-100v9h-100z"), "");
    assert_unit_of(sli_map_read_svg, NULL, A4("M0 0h9000v7000h-4000v9h-5000z"), "mm");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_units),      cmocka_unit_test(test_shapes),
        cmocka_unit_test(test_transforms), cmocka_unit_test(test_paths),
        cmocka_unit_test(test_arcs),       cmocka_unit_test(test_layers),
        cmocka_unit_test(test_refused),    cmocka_unit_test(test_style_sheets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
