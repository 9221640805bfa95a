// SVG: faulty parts are passed over, shapes that nobody sees are no walls, and transforms of CSS
// count.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/io.h"

#define SVG(body) "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 20 10'>\n" body "</svg>"
#define GOOD      "<line x1='0' y1='0' x2='4' y2='0' stroke='black'/>\n"
#define WALL      "wall 0 10 4 10\n"

/// y is turned up: the box's lower edge, at y 10, is at 0.
static void assert_noted(const char *text, const char *expected, const char *note) {
    assert_noted_of(sli_map_read_svg, NULL, text, strlen(text), expected, note);
}

static void assert_walls(const char *text, const char *expected) {
    assert_noted(text, expected, "");
}

// --- faults

/// A faulty element on line 3, between two good ones.
#define PASSED(element, walls, note)                                                               \
    assert_noted(SVG(GOOD element "\n" GOOD), WALL walls WALL,                                     \
                 "f: passed over 1 faulty part: 1 " note)

static void test_faults(void **state) {
    (void)state;
    PASSED("<rect width='100%' height='100%'/>", "", "size in percent of a window (line 3)");
    PASSED("<line x1='1' x2='50%'/>", "", "size in percent of a window (line 3)");
    PASSED("<use href='other.svg#a'/>", "", "use of another file (line 3)");
    PASSED("<use xmlns:x='http://www.w3.org/1999/xlink' x:href='other.svg#a'/>", "",
           "use of another file (line 3)");
    PASSED("<use href='#none'/>", "", "use of an element that is not there (line 3)");
    PASSED("<use/>", "", "use of an element that is not there (line 3)");
    PASSED("<line x1='one'/>", "", "length that is no number (line 3)");
    PASSED("<line x2='1e999' y2='1'/>", "", "length that is no number (line 3)");
    PASSED("<line x2='1em'/>", "", "length whose unit is not known here (line 3)");
    PASSED("<line x2='1e200' y2='1'/>", "", "shape with a coordinate out of range (line 3)");
    PASSED("<svg viewBox='0 0 0 1'><line x2='1'/></svg>", "",
           "drawing within the drawing whose viewBox is wrong (line 3)");
    // All the same on one line: the number of each, and the first one.
    assert_noted(SVG(GOOD "<use href='a.svg'/>\n<use href='b.svg#b'/><rect width='9%'/>"), WALL,
                 "f: passed over 3 faulty parts: 2 uses of other files (the first in line 3), "
                 "1 size in percent of a window (line 4)");
}

/// The bad tail of a path or a list: all before it is drawn.
static void test_tails(void **state) {
    (void)state;
#define PATH(data, walls) PASSED("<path d='" data "'/>", walls, "path that is wrong: drawn up to")
    PATH("M1 1L2 1L3", "wall 1 9 2 9\n");
    PATH("M1 1 2 1 x 5 5", "wall 1 9 2 9\n");
    PATH("M1 1L2 1k2", "wall 1 9 2 9\n");
    PATH("M1 1L2 1z2", "wall 1 9 2 9\nwall 2 9 1 9\n");
    PATH("M1 1L2 1A1 1 0 2 0 3 3L9 9", "wall 1 9 2 9\n");
    PATH("L1 1", "");
    PASSED("<polyline points='1 1 2 1 3'/>", "wall 1 9 2 9\n", "list of points that is wrong");
    PASSED("<polygon points='1 1 2 1 2 2 a'/>", "wall 1 9 2 9\nwall 2 9 2 8\nwall 2 8 1 9\n",
           "list of points that is wrong");
    // No data at all draws nothing, and nothing is wrong with it.
    assert_walls(SVG("<path/><path d=''/><polyline points=''/>" GOOD), WALL);
}

static void test_bad_transforms(void **state) {
    (void)state;
#define LINE "<line x1='1' y1='1' x2='2' y2='1' "
    // Viewers leave out what is wrong. What they know and this reader does not, moves somewhere.
    PASSED(LINE "transform='turn(3)'/>", "wall 1 9 2 9\n",
           "transform that is wrong: drawn without");
    PASSED(LINE "transform='scale 3'/>", "wall 1 9 2 9\n", "transform that is wrong");
    PASSED(LINE "transform='scale(1 2 3)'/>", "wall 1 9 2 9\n", "transform that is wrong");
    PASSED(LINE "transform='rotate(1 2)'/>", "wall 1 9 2 9\n", "transform that is wrong");
    PASSED(LINE "style='transform: rotate(3em)'/>", "wall 1 9 2 9\n", "transform that is wrong");
    PASSED(LINE "style='transform:rotate3d(1,0,0,9deg)'/>", "",
           "transform of a kind not known here");
    PASSED(LINE "style='transform:translate(calc(1px + 2%))'/>", "",
           "transform of a kind not known");
    PASSED(LINE "style='transform:translate(2em)'/>", "", "transform of a kind not known");
    PASSED(LINE "style='rotate:90deg'/>", "", "transform of a kind not known");
    PASSED("<g transform='x()'>" LINE "/></g>", "wall 1 9 2 9\n", "transform that is wrong");
}

// --- what is seen

static void assert_seen(bool seen, const char *body) {
    char text[2048];
    snprintf(text, sizeof text, SVG("%s"), body);
    assert_walls(text, seen ? WALL : "");
}

#define SHAPE(looks) "<line x2='4' " looks "/>"

static void test_paint(void **state) {
    (void)state;
    assert_seen(true, SHAPE(""));
    assert_seen(true, SHAPE("fill='none' stroke='red'"));
    assert_seen(true, SHAPE("fill='white'"));
    assert_seen(false, SHAPE("fill='none'"));
    assert_seen(false, SHAPE("fill='none' stroke='none'"));
    assert_seen(false, SHAPE("style='fill:none;stroke:transparent'"));
    assert_seen(false, SHAPE("style='fill:rgba(1, 2, 3, 0); stroke:#11223300'"));
    assert_seen(true, SHAPE("style='fill:rgba(1, 2, 3, 0.1)'"));
    assert_seen(false, SHAPE("fill='none' stroke='red' stroke-opacity='0'"));
    assert_seen(false, SHAPE("fill='none' stroke='red' stroke-width='0'"));
    assert_seen(false, SHAPE("fill-opacity='0.0'"));
    assert_seen(true, SHAPE("fill-opacity='0' stroke='red'"));
    assert_seen(false, SHAPE("opacity='0' stroke='red'"));
    assert_seen(false, SHAPE("style='opacity:0%'"));
    assert_seen(true, SHAPE("opacity='.04'"));
    assert_seen(false, SHAPE("opacity='.01'"));
    assert_seen(false, SHAPE("fill='none' stroke='red' stroke-opacity='3%'"));
    // What the groups about it say, but for what it says itself.
    assert_seen(false, "<g fill='none'>" SHAPE("") "</g>");
    assert_seen(true, "<g fill='none'>" SHAPE("fill='red'") "</g>");
    assert_seen(true, "<g fill='none' stroke='red'>" SHAPE("stroke='inherit'") "</g>");
    assert_seen(false, "<g fill='none' stroke='red'>" SHAPE("stroke='none'") "</g>");
    assert_seen(false, "<g opacity='0'>" SHAPE("opacity='1'") "</g>");
    assert_seen(true, "<svg fill='none' stroke='black'>" SHAPE("") "</svg>");
    // Sheets.
    assert_seen(false, "<style>.a,.b{fill:none}</style>" SHAPE("class='c b'"));
    assert_seen(true, "<style>.a{fill:none} g .a{stroke:red}</style><g>" SHAPE("class='a'") "</g>");
    assert_seen(false,
                "<style>.a{fill:none} p .a{stroke:red}</style><g>" SHAPE("class='a'") "</g>");
    // Who knows what sheets say that are not read? A hand on the drawing does not begin with it.
    assert_seen(true, "<style>g > line{stroke:red}</style>" SHAPE("fill='none'"));
    assert_seen(true, "<style>@media screen{line{stroke:red}}</style>" SHAPE("fill='none'"));
    assert_seen(false, "<style>line:hover{stroke:red}</style>" SHAPE("fill='none'"));
    // Sheets of fonts and colours for dark screens say nothing of it.
    assert_seen(true, "<style>@import url(more.css);</style>" SHAPE("fill='none'"));
    assert_seen(false, "<style>@import url(https://fonts.example.org/css2?family=A:wght@400;700);"
                       ".a{fill:none}</style>" SHAPE("class='a'"));
    assert_seen(false, "<style>@import 'font;.css';</style>" SHAPE("fill='none'"));
    assert_seen(false, "<style>@media (prefers-color-scheme: dark){line{stroke:red}}</style>" SHAPE(
                           "fill='none'"));
    const char *const sheet =
        "<?xml-stylesheet href='a.css'?>\n<svg viewBox='0 0 20 10'>" SHAPE("fill='none'") "</svg>";
    assert_walls(sheet, WALL);
    // The paint of the root counts, too.
    assert_walls("<svg viewBox='0 0 20 10' fill='none'>" SHAPE("") "</svg>", "");
    assert_walls("<svg viewBox='0 0 20 10' fill='none' stroke='red'>" SHAPE("") "</svg>", WALL);
    // Layers of our own are what they say.
    assert_seen(true, "<g id='sightline-wall' fill='none'>" SHAPE("") "</g>");
    assert_seen(false, "<g id='sightline-wall' visibility='hidden'>" SHAPE("") "</g>");
}

static void test_visibility(void **state) {
    (void)state;
    assert_seen(false, "<g visibility='hidden'>" SHAPE("") "</g>");
    assert_seen(true, "<g visibility='hidden'><g>" SHAPE("visibility='visible'") "</g></g>");
    assert_seen(true, "<g style='visibility:hidden'>" SHAPE("style='visibility:visible'") "</g>");
    assert_seen(false, SHAPE("visibility='collapse'"));
    assert_seen(false,
                "<g display='none'>" SHAPE("style='display:inline;visibility:visible'") "</g>");
    assert_seen(false, "<g visibility='hidden'>" SHAPE("visibility='inherit'") "</g>");
    // What is only defined, and what is used under a hidden use.
    assert_seen(false, "<defs>" SHAPE("") "</defs><symbol>" SHAPE("") "</symbol>");
    assert_seen(false, "<mask>" SHAPE("") "</mask><pattern>" SHAPE("") "</pattern><marker>" SHAPE(
                           "") "</marker><clipPath>" SHAPE("") "</clipPath>");
    assert_seen(true, "<symbol id='s'>" SHAPE("") "</symbol><use href='#s'/>");
    assert_seen(false, "<symbol id='s'>" SHAPE("") "</symbol><use href='#s' visibility='hidden'/>");
    assert_seen(false, "<symbol id='s'>" SHAPE("fill='none'") "</symbol><use href='#s'/>");
    assert_seen(true,
                "<symbol id='s'>" SHAPE("fill='none'") "</symbol><use href='#s' stroke='red'/>");
    // No size.
    assert_seen(
        false,
        "<rect width='0' height='4'/><rect width='4'/><circle r='0'/><ellipse rx='3' ry='0'/>");
}

#define CLIP(parts) "<clipPath id='c'>" parts "</clipPath>"

static void test_clips(void **state) {
    (void)state;
    const char *const there = CLIP("<rect x='3' y='-1' width='2' height='2'/>");
    const char *const away = CLIP("<rect x='5' y='-1' width='2' height='2'/>");
    char text[512];
    for (int i = 0; i < 2; i++) {
        snprintf(text, sizeof text, "%s" SHAPE("clip-path='url(#c)'"), i ? there : away);
        assert_seen(i, text);
        snprintf(text, sizeof text, "%s<g style='clip-path: url(\"#c\")'>" SHAPE("") "</g>",
                 i ? there : away);
        assert_seen(i, text);
    }
    // The clip moves with what it clips, and by itself.
    assert_walls(SVG(CLIP("<rect x='5' width='2' height='2'/>")
                         SHAPE("clip-path='url(#c)' transform='translate(1 0)'")),
                 "");
    assert_seen(true,
                "<clipPath id='c' transform='translate(-3 0)'><rect x='5' width='2' height='2'/>"
                "</clipPath>" SHAPE("clip-path='url(#c)'"));
    assert_seen(true, CLIP("<rect x='5' width='2' height='2' transform='scale(0.5)'/>")
                          SHAPE("clip-path='url(#c)'"));
    assert_seen(false, "<defs><rect id='r' width='2' height='2'/></defs>" CLIP(
                           "<use href='#r' x='9'/>") SHAPE("clip-path='url(#c)'"));
    // Two clips of which none is away, but both together.
    assert_seen(false, "<clipPath id='d'><rect x='3' width='9' height='2'/></clipPath>"
                       "<g clip-path='url(#d)'>" CLIP("<rect width='2' height='2'/>")
                           SHAPE("clip-path='url(#c)'") "</g>");
    // A clip without shapes hides all; of one that is not known here nobody can say.
    assert_seen(false, CLIP("<title>none</title>") SHAPE("clip-path='url(#c)'"));
    assert_seen(true, CLIP("<text>A</text>") SHAPE("clip-path='url(#c)'"));
    assert_seen(true, "<clipPath id='c' clipPathUnits='objectBoundingBox'><rect x='9' width='1' "
                      "height='1'/></clipPath>" SHAPE("clip-path='url(#c)'"));
    assert_seen(true, CLIP("<rect x='9%' width='1' height='1'/>") SHAPE("clip-path='url(#c)'"));
    assert_seen(true, SHAPE("clip-path='url(#none)'"));
    assert_seen(true, SHAPE("id='c' clip-path='url(#c)'"));
    assert_seen(true, CLIP("<use href='#g'/>") "<g id='g'><use href='#l'/></g>" SHAPE(
                          "id='l' display='none'") SHAPE("clip-path='url(#c)'"));
}

// --- transforms of CSS

static void assert_moved(const char *css, const char *expected) {
    char text[1024];
    snprintf(text, sizeof text,
             SVG("<line x1='1' y1='1' x2='3' y2='1' style='%s'/>"
                 "<style>#a{%s}</style><line id='a' x1='1' y1='1' x2='3' y2='1'/>"),
             css, css);
    char twice[256];
    snprintf(twice, sizeof twice, "%s%s", expected, expected);
    assert_walls(text, twice);
}

static void test_css_transforms(void **state) {
    (void)state;
    assert_moved("transform: translate(3px, 4px)", "wall 4 5 6 5\n");
    assert_moved("transform: translate(3px)", "wall 4 9 6 9\n");
    assert_moved("transform: translateX(1in)", "wall 97 9 99 9\n");
    assert_moved("transform: translateY(-2px)", "wall 1 11 3 11\n");
    assert_moved("transform: translate(50%, 10%)", "wall 11 8 13 8\n");
    assert_moved("transform: matrix(1, 2, 3, 4, 5, 6)", "wall 9 -2 11 -6\n");
    assert_moved("transform: scale(2) translate(1px, 1px)", "wall 4 6 8 6\n");
    assert_moved("transform: scale(2, 3)", "wall 2 7 6 7\n");
    assert_moved("transform: scaleX(200%) scaleY(3)", "wall 2 7 6 7\n");
    assert_moved("transform: rotate(90deg)", "wall -1 9 -1 7\n");
    assert_moved("transform: rotate(0.25turn)", "wall -1 9 -1 7\n");
    assert_moved("transform: rotate(100grad)", "wall -1 9 -1 7\n");
    assert_moved("transform: rotateZ(-90deg)", "wall 1 11 1 13\n");
    assert_moved("transform: rotate(1.5707963267948966rad)", "wall -1 9 -1 7\n");
    assert_moved("transform: skewX(0deg) skewY(0) skew(0, 0turn)", "wall 1 9 3 9\n");
    assert_moved("transform: none", "wall 1 9 3 9\n");
    assert_moved("transform: rotate(180deg); transform-origin: 2px 1px", "wall 3 9 1 9\n");
    assert_moved("transform: rotate(180deg); transform-origin: 50% 50%", "wall 19 1 17 1\n");
    assert_moved("transform: rotate(180deg); transform-origin: right top", "wall 39 11 37 11\n");
    assert_moved("transform: rotate(180deg); transform-origin: top right", "wall 39 11 37 11\n");
    assert_moved("transform: rotate(180deg); transform-origin: left", "wall -1 1 -3 1\n");
    assert_moved("transform: rotate(180deg); transform-box: fill-box; transform-origin: center",
                 "wall 3 9 1 9\n");
    assert_moved("transform: rotate(180deg); transform-box: fill-box", "wall 1 9 -1 9\n");
    assert_moved("transform: translateX(50%); transform-box: fill-box", "wall 2 9 4 9\n");
    // The style is before the attribute, and a group's is of all in it.
    assert_walls(SVG("<line x2='4' transform='scale(9)' style='transform:translate(1px,0)'/>"),
                 "wall 1 10 5 10\n");
    assert_walls(SVG("<line x2='4' transform='rotate(90)' transform-origin='4 0'/>"),
                 "wall 4 14 4 10\n");
    assert_walls(SVG("<g style='transform:translate(1px,2px)'><g style='transform:scale(2)'>" SHAPE(
                     "") "</g></g>"),
                 "wall 1 8 9 8\n");
    assert_noted(SVG("<g style='transform:scale(2);transform-box:fill-box'>" SHAPE("") "</g>"), "",
                 "transform of a kind not known here: left out");
}

/// Any angle and skew: the same as the attribute's, or as a matrix by hand.
static void test_oblique_transforms(void **state) {
    (void)state;
    static const char *const same[][2] = {
        {"transform='rotate(17.3)'", "style='transform:rotate(17.3deg)'"},
        {"transform='rotate(17.3 2 1)'",
         "style='transform:rotate(17.3deg);transform-origin:2px 1px'"},
        {"transform='skewX(20)'", "style='transform:skew(20deg)'"},
        {"transform='skewY(20)'", "style='transform:skew(0,20deg)'"},
    };
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        char text[2][512];
        sl_map maps[2] = {0};
        sl_context *context = testing_context(NULL);
        const sl_import_options options = sl_import_options_default();
        for (int k = 0; k < 2; k++) {
            snprintf(text[k], sizeof text[k], SVG("<line x1='1' y1='1' x2='3' y2='7' %s/>"),
                     same[i][k]);
            assert_ok(context,
                      sli_map_read_svg(context, "f", text[k], strlen(text[k]), &options, &maps[k]));
            assert_int_equal(maps[k].wall_count, 1);
        }
        assert_true(testing_same_point(maps[0].walls[0].a, maps[1].walls[0].a));
        assert_true(testing_same_point(maps[0].walls[0].b, maps[1].walls[0].b));
        assert_false(maps[0].walls[0].a.x == 1 && maps[0].walls[0].b.x == 3 &&
                     maps[0].walls[0].b.y == 3);
        for (int k = 0; k < 2; k++) sl_map_destroy(context, &maps[k]);
        sl_context_destroy(context);
    }
}

/// What lies beside the page is cut where the drawing is shown; but not where the plan goes on
/// there.
static void test_beside_the_page(void **state) {
    (void)state;
#define ROOM       "<path d='M1 1H9V9H1z' fill='none' stroke='black'/>\n"
#define ROOM_WALLS "wall 1 9 9 9\nwall 9 9 9 1\nwall 9 1 1 1\nwall 1 1 1 9\n"
#define SYMBOL     "<path d='M30 1h4v4h-4z' fill='none' stroke='black'/>\n"
#define BESIDE     "wall 30 9 34 9\nwall 34 9 34 5\nwall 34 5 30 5\nwall 30 5 30 9\n"
    assert_noted(SVG(ROOM ROOM SYMBOL), ROOM_WALLS ROOM_WALLS,
                 "passed over: hidden beside the page (other)");
    assert_walls(SVG(ROOM SYMBOL SYMBOL), ROOM_WALLS BESIDE BESIDE);
    assert_walls(SVG(ROOM ROOM SYMBOL "<path d='M9 5H30' stroke='black'/>"),
                 ROOM_WALLS ROOM_WALLS BESIDE "wall 9 5 30 5\n");
    sl_import_options all = sl_import_options_default();
    all.all_layers = true;
    static const char text[] = SVG(ROOM ROOM SYMBOL);
    assert_walls_of(sli_map_read_svg, &all, text, strlen(text), ROOM_WALLS ROOM_WALLS BESIDE);
}

static void test_memory(void **state) {
    (void)state;
    assert_memory_of(sli_map_read_svg, NULL,
                     SVG("<style>.a{fill:none}</style>" CLIP("<rect width='2' height='2'/>")
                             SHAPE("clip-path='url(#c)'") SHAPE(
                                 "style='transform:scale(2);transform-box:fill-box'") ROOM SYMBOL));
}

/// A drawing that is a picture, alone or with a mark, has no walls to read; a picture that nobody
/// sees is none.
static void test_picture_alone(void **state) {
    (void)state;
    static const char seen[] = SVG("<text>x</text><image width='20' height='10' href='p.png'/>");
    static const char hidden[] = SVG("<image display='none' width='20' height='10' href='p.png'/>");
    assert_refused_of(sli_map_read_svg, NULL, seen, strlen(seen), SL_BAD_INPUT,
                      "f:2: the drawing has a picture and no walls: if the plan is in it, save it "
                      "as a PNG file, and read that");
    assert_walls(hidden, "");
    static const char marked[] = SVG(GOOD "<image width='20' height='10' href='p.png'/>");
    assert_refused_of(sli_map_read_svg, NULL, marked, strlen(marked), SL_BAD_INPUT,
                      "f:3: the drawing has a picture, and few shapes (--layers '*' takes these): "
                      "if the plan is in it, save it as a PNG file, and read that");
    assert_walls(SVG(GOOD GOOD GOOD GOOD GOOD "<image width='20' height='10' href='p.png'/>"),
                 WALL WALL WALL WALL WALL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_picture_alone),
        cmocka_unit_test(test_faults),
        cmocka_unit_test(test_tails),
        cmocka_unit_test(test_bad_transforms),
        cmocka_unit_test(test_paint),
        cmocka_unit_test(test_visibility),
        cmocka_unit_test(test_clips),
        cmocka_unit_test(test_css_transforms),
        cmocka_unit_test(test_oblique_transforms),
        cmocka_unit_test(test_beside_the_page),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
