// Which layers of DXF and SVG drawings become walls, windows and doors.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"

#include <math.h>

#define HEAD "0\nSECTION\n2\nENTITIES\n"
#define TAIL "0\nENDSEC\n0\nEOF\n"
#define LINE(layer, x0, y0, x1, y1)                                                                \
    "0\nLINE\n8\n" layer "\n10\n" #x0 "\n20\n" #y0 "\n11\n" #x1 "\n21\n" #y1 "\n"
#define ARC(layer, x, y, r, from, to)                                                              \
    "0\nARC\n8\n" layer "\n10\n" #x "\n20\n" #y "\n40\n" #r "\n50\n" #from "\n51\n" #to "\n"
#define INSERT(layer, block, x, y) "0\nINSERT\n8\n" layer "\n2\n" block "\n10\n" #x "\n20\n" #y "\n"
/// A room of 10 by 8 with a gap from (2,0) to (3,0).
#define ROOM(layer)                                                                                \
    LINE(layer, 2, 0, 0, 0)                                                                        \
    LINE(layer, 0, 0, 0, 8)                                                                        \
    LINE(layer, 0, 8, 10, 8) LINE(layer, 10, 8, 10, 0) LINE(layer, 10, 0, 3, 0)
#define ROOM_WALLS "wall 2 0 0 0\nwall 0 0 0 8\nwall 0 8 10 8\nwall 10 8 10 0\nwall 10 0 3 0\n"
/// A door in its gap: its leaf stands at the left.
#define SWING(layer) LINE(layer, 2, 0, 2, 1) ARC(layer, 2, 0, 1, 0, 90)

static void assert_map(import_reader *read, const char *text, const char *layers, bool doors,
                       const char *expected) {
    sl_import_options options = sl_import_options_default();
    options.layers = layers;
    options.doors = doors;
    assert_walls_of(read, &options, text, strlen(text), expected);
}

static void assert_dxf(const char *entities, const char *expected) {
    char text[8192];
    assert_true((size_t)snprintf(text, sizeof text, HEAD "%s" TAIL, entities) < sizeof text);
    assert_map(sli_map_read_dxf, text, NULL, false, expected);
}

#define WINDOW(x0, y0, x1, y1)     "wall " #x0 " " #y0 " " #x1 " " #y1 " stops steps,sound\n"
#define DOOR(name, x0, y0, x1, y1) "door " name " " #x0 " " #y0 " " #x1 " " #y1 " open\n"

/// The layers of a plan in one language: wall, door, window, furniture, text, hatch.
static void assert_language(const char *const layers[6]) {
    static const char form[] =
        HEAD ROOM("#0") SWING("#1") LINE("#2", 10, 3, 10, 5) LINE("#3", 4, 4, 5, 4)
            LINE("#4", 0, -1, 10, -1) LINE("#5", 0, 0, 1, 1) LINE("x", 7, 7, 9, 7) TAIL;
    char drawing[4096], *end = drawing;
    for (const char *at = form; *at; at++) {
        if (*at == '#')
            end = stpcpy(end, layers[*++at - '0']);
        else
            *end++ = *at;
    }
    *end = 0;
    assert_map(sli_map_read_dxf, drawing, NULL, false, ROOM_WALLS WINDOW(10, 3, 10, 5));
    assert_map(sli_map_read_dxf, drawing, NULL, true,
               ROOM_WALLS WINDOW(10, 3, 10, 5) DOOR("door1", 2, 0, 3, 0));
    assert_map(sli_map_read_dxf, drawing, layers[3], false, "wall 4 4 5 4\n");
}

static void test_languages(void **state) {
    (void)state;
    static const char *const languages[][6] = {
        {"A-WALL", "A-DOOR", "A-GLAZ", "A-FURN", "A-ANNO-DIMS", "A-WALL-PATT"},
        {"Wände", "Türen", "Fenster", "Möbel", "Bemaßung", "Schraffur"},
        {"murs", "portes", "fenêtres", "mobilier", "cotes", "hachures"},
        {"MURATURA", "PORTE", "INFISSI", "ARREDI", "QUOTE", "RETINI"},
        {"Muros", "Puertas", "Ventanas", "Muebles", "Cotas", "Sombreado"},
        {"Стены", "Двери", "Окна", "Мебель", "Размеры", "Штриховка"},
        {"墙", "门", "窗", "家具", "标注", "填充"},
        {"\\U+58C1", "ドア", "窓", "家具", "寸法", "ハッチ"},
        {"벽", "문", "창문", "가구", "치수", "해치"}};
    for (size_t i = 0; i < sizeof languages / sizeof *languages; i++) assert_language(languages[i]);
}

/// Where no name says anything, all is walls; a choice that leaves no room is none.
static void test_no_choice(void **state) {
    (void)state;
    assert_dxf(ROOM("1") LINE("2", 4, 4, 5, 4), ROOM_WALLS "wall 4 4 5 4\n");
    assert_dxf(LINE("WALL", 0, 0, 1, 0) LINE("FURN", 0, 0, 0, 1) LINE("0", 0, 1, 1, 1),
               "wall 0 0 1 0\nwall 0 0 0 1\nwall 0 1 1 1\n");
    // Layers that are named as something else are passed over all the same.
    assert_dxf(ROOM("1") LINE("FURNITURE", 4, 4, 5, 4), ROOM_WALLS);
    // All is on one layer whose name is misleading.
    assert_dxf(ROOM("SITE"), ROOM_WALLS);
}

static void test_blocks(void **state) {
    (void)state;
#define BLOCK(name, body) "0\nBLOCK\n2\n" name "\n10\n0\n20\n0\n" body "0\nENDBLK\n"
    static const char text[] =
        "0\nSECTION\n2\nBLOCKS\n" BLOCK("Chair-3", LINE("0", 0, 0, 1, 0) LINE("x", 0, 0, 0, 1))
            BLOCK("UNIT", INSERT("0", "chair-3", 1, 1) LINE("0", 5, 0, 5, 1))
                BLOCK("wall unit", LINE("0", 0, 0, 1, 1)) "0\nENDSEC\n" HEAD ROOM("0")
                    INSERT("0", "CHAIR-3", 4, 4) INSERT("0", "UNIT", 1, 1)
                        INSERT("FURN", "wall unit", 3, 3) TAIL;
    assert_map(sli_map_read_dxf, text, NULL, false, ROOM_WALLS "wall 6 1 6 2\n");
}

/// A block with more fields for texts that are shown than lines is a tag, unless its layer says
/// otherwise.
static void test_tags(void **state) {
    (void)state;
#define FIELD  "0\nATTDEF\n8\n0\n10\n0\n20\n0\n40\n1\n1\nx\n2\nx\n"
#define HIDDEN "0\nATTDEF\n8\n0\n10\n0\n20\n0\n40\n1\n1\nx\n2\nx\n70\n1\n"
#define TAG_BLOCKS                                                                                 \
    "0\nSECTION\n2\nBLOCKS\n" BLOCK("b7",                                                          \
                                    FIELD FIELD FIELD LINE("0", 0, 0, 1, 0) LINE("0", 0, 0, 0, 1)) \
        BLOCK("c7", FIELD LINE("0", 0, 0, 1, 1) LINE("0", 0, 1, 1, 0)) BLOCK(                      \
            "d7", FIELD HIDDEN HIDDEN LINE("0", 0, 0, 1, 0) LINE("0", 0, 0, 0, 1)) "0\nENDSEC\n"
    static const char tag[] = TAG_BLOCKS HEAD ROOM("0") INSERT("1", "b7", 4, 4) TAIL;
    static const char few[] = TAG_BLOCKS HEAD ROOM("0") INSERT("1", "c7", 4, 4) TAIL;
    static const char wall[] = TAG_BLOCKS HEAD ROOM("wall") INSERT("wall", "b7", 4, 4) TAIL;
    static const char part[] = TAG_BLOCKS HEAD ROOM("0") INSERT("1", "d7", 4, 4) TAIL;
    assert_map(sli_map_read_dxf, part, NULL, false, ROOM_WALLS "wall 4 4 5 4\nwall 4 4 4 5\n");
    assert_map(sli_map_read_dxf, tag, NULL, false, ROOM_WALLS);
    assert_map(sli_map_read_dxf, few, NULL, false, ROOM_WALLS "wall 4 4 5 5\nwall 4 5 5 4\n");
    assert_map(sli_map_read_dxf, wall, NULL, false, ROOM_WALLS "wall 4 4 5 4\nwall 4 4 4 5\n");
}

static void test_swings(void **state) {
    (void)state;
    // On one layer with the walls; the other way round; half open.
    assert_dxf(ROOM("0") SWING("0"), ROOM_WALLS);
    assert_dxf(ROOM("0") LINE("0", 3, 1, 3, 0) ARC("0", 3, 0, 1, 90, 180), ROOM_WALLS);
    assert_dxf(ROOM("0") LINE("0", 2, 0, 2.8, 0.6) ARC("0", 2, 0, 1, 0, 36.87), ROOM_WALLS);
    // A leaf of four sides.
    assert_dxf(ROOM("0") "0\nLWPOLYLINE\n8\n0\n70\n1\n10\n2\n20\n0\n10\n2.1\n20\n0\n10\n2.1\n20"
                         "\n1\n10\n2\n20\n1\n" ARC("0", 2, 0, 1, 0, 90),
               ROOM_WALLS);
    // A round corner has no leaf, a tower no gap.
    sl_context *context = testing_context(NULL);
    const sl_import_options usual = sl_import_options_default();
    static const char *const rounds[] = {
        HEAD ROOM("0") ARC("0", 2, 0, 1, 0, 90) TAIL,
        HEAD LINE("0", 0, 0, 9, 0) LINE("0", 0, 0, 0, 9) ARC("0", 0, 0, 9, 0, 90)
            LINE("0", 0, 9, -9, 9) TAIL,
        HEAD ROOM("0") LINE("0", 2, 0, 2, 5) ARC("0", 2, 0, 1, 0, 90) TAIL,
        HEAD ROOM("0") "0\nCIRCLE\n8\n0\n10\n5\n20\n5\n40\n1\n" LINE("0", 5, 5, 6, 5) TAIL,
    };
    for (size_t i = 0; i < sizeof rounds / sizeof *rounds; i++) {
        sl_map map = {0};
        assert_ok(context,
                  sli_map_read_dxf(context, "f", rounds[i], strlen(rounds[i]), &usual, &map));
        size_t arcs = 0;
        for (size_t j = 0; j < map.wall_count; j++)
            arcs += map.walls[j].a.x != map.walls[j].b.x && map.walls[j].a.y != map.walls[j].b.y;
        assert_true(arcs >= 8);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

/// A plan turned by any angle, far away and in any unit gives the same doors.
static void test_turned_swings(void **state) {
    (void)state;
    static const double scales[] = {1e-3, 1, 1e3, 1e9};
    for (int turn = 0; turn < 360; turn += 17) {
        for (size_t i = 0; i < 4; i++) {
            const double s = scales[i], c = cos(turn * 0.017453292519943295) * s,
                         n = sin(turn * 0.017453292519943295) * s, far = i == 1 ? 1e6 : 0;
            const double corners[][4] = {{2, 0, 0, 0},   {0, 0, 0, 8},  {0, 8, 10, 8},
                                         {10, 8, 10, 0}, {10, 0, 3, 0}, {2, 0, 2, 1}};
            char text[4096] = HEAD;
            for (size_t j = 0; j < 6; j++) {
                const double *p = corners[j];
                sprintf(text + strlen(text),
                        "0\nLINE\n8\n0\n10\n%.17g\n20\n%.17g\n11\n%.17g\n21\n%.17g\n",
                        far + c * p[0] - n * p[1], n * p[0] + c * p[1], far + c * p[2] - n * p[3],
                        n * p[2] + c * p[3]);
            }
            sprintf(text + strlen(text),
                    "0\nARC\n8\n0\n10\n%.17g\n20\n%.17g\n40\n%.17g\n50\n%d\n51\n%d\n" TAIL,
                    far + 2 * c, 2 * n, s, turn, turn + 90);
            sl_context *context = testing_context(NULL);
            sl_import_options options = sl_import_options_default();
            options.doors = true;
            sl_map map = {0};
            assert_ok(context, sli_map_read_dxf(context, "f", text, strlen(text), &options, &map));
            assert_int_equal(map.wall_count, 5);
            assert_int_equal(map.door_count, 1);
            // It stands in the gap exactly.
            const sl_segment door = map.doors[0].segment;
            assert_true(door.a.x == map.walls[0].a.x && door.a.y == map.walls[0].a.y);
            assert_true(door.b.x == map.walls[4].b.x && door.b.y == map.walls[4].b.y);
            sl_map_destroy(context, &map);
            sl_context_destroy(context);
        }
    }
}

#define UNIT(number)  "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n" number "\n0\nENDSEC\n"
#define SECOND(layer) LINE(layer, 10, 3, 9, 3) ARC(layer, 10, 3, 1, 90, 180)

/// Doors that are drawn open say how wide entrances are, where the unit makes no doors of them.
static void test_width_of_doors(void **state) {
    (void)state;
    static const struct {
        const char *text, *unit;
        double width;
    } cases[] = {
        {HEAD ROOM("0") SWING("0") SECOND("0") TAIL, NULL, 1.42},
        {HEAD ROOM("0") SWING("0") TAIL, NULL, 0},
        {UNIT("6") HEAD ROOM("0") SWING("0") SECOND("0") TAIL, NULL, 0},
        {UNIT("1") HEAD ROOM("0") SWING("0") SECOND("0") TAIL, NULL, 1.42},
        {UNIT("1") HEAD ROOM("0") SWING("0") SECOND("0") TAIL, "m=m", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_context *context = testing_context(NULL);
        sl_import_options options = sl_import_options_default();
        options.unit = cases[i].unit;
        sl_map map = {0};
        assert_ok(context, sli_map_read_dxf(context, "f", cases[i].text, strlen(cases[i].text),
                                            &options, &map));
        assert_true(map.entrance == cases[i].width);
        assert_int_equal(map.entrance_by_doors, cases[i].width > 0);
        char *text = map_walls_text(&map);
        assert_int_equal(strstr(text, "entrance 1.42 doors\n") != NULL, cases[i].width > 0);
        free(text);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// Lines side by side are hatching only if they are many, even and close.
static void test_hatching(void **state) {
    (void)state;
    static const struct {
        int count;
        double step, uneven;
        bool stay;
    } cases[] = {{20, 0.04, 0, false},
                 {20, -0.04, 0, false},
                 {7, 0.04, 0, true},
                 {20, 0.8, 0, true},
                 {20, 0.04, 0.01, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[8192] = HEAD ROOM("0");
        for (int j = 0; j < cases[i].count; j++) {
            const double x = 5 + j * cases[i].step + j * j * cases[i].uneven;
            sprintf(text + strlen(text), "0\nLINE\n8\n0\n10\n%.3f\n20\n2\n11\n%.3f\n21\n3\n", x,
                    x + 1);
        }
        strcat(text, TAIL);
        sl_context *context = testing_context(NULL);
        const sl_import_options usual = sl_import_options_default();
        sl_map map = {0};
        assert_ok(context, sli_map_read_dxf(context, "f", text, strlen(text), &usual, &map));
        assert_int_equal(map.wall_count, 5 + (cases[i].stay ? cases[i].count : 0));
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// Layers that are asked for are walls, whatever they are called.
static void test_asked_for(void **state) {
    (void)state;
    static const char text[] =
        HEAD ROOM("A-WALL") LINE("A-GLAZ", 10, 3, 10, 5) SWING("A-DOOR") TAIL;
    assert_map(sli_map_read_dxf, text, "A-WALL,A-GLAZ", false, ROOM_WALLS "wall 10 3 10 5\n");
    assert_map(sli_map_read_dxf, text, "A-WALL,A-DOOR", true, ROOM_WALLS DOOR("door1", 2, 0, 3, 0));
    assert_map(sli_map_read_dxf, text, "A-DOOR", true, DOOR("door1", 2, 0, 3, 0));
    static const char named[] =
        HEAD ROOM("A-WALL") LINE("A-GLAZ", 10, 3, 10, 5) LINE("A-FURN", 4, 4, 5, 4) TAIL;
    assert_map(sli_map_read_dxf, named, "*", false, ROOM_WALLS "wall 10 3 10 5\nwall 4 4 5 4\n");
    // Doors that are drawn as lines or thin boxes.
    static const char boxes[] =
        HEAD ROOM("A-WALL") "0\nLWPOLYLINE\n8\nA-DOOR\n70\n1\n10\n2\n20\n-.5\n10\n3\n20\n-.5\n10\n3"
                            "\n20\n.5\n10\n2\n20\n.5\n" LINE("A-DOOR", 5, 5, 6, 6) TAIL;
    assert_map(sli_map_read_dxf, boxes, NULL, true,
               ROOM_WALLS DOOR("door1", 3, 0, 2, 0) DOOR("door2", 5, 5, 6, 6));
    assert_map(sli_map_read_dxf, boxes, NULL, false, ROOM_WALLS);
}

#define SVG(body)  "<svg viewBox='0 0 20 10'>\n" body "</svg>"
#define POLYLINE   "<polyline points='2,10 0,10 0,2 10,2 10,10 3,10'/>"
#define SHUT_WALLS "wall 2 0 0 0\nwall 0 0 0 8\nwall 0 8 10 8\nwall 10 8 10 0\nwall 10 0 3 0\n"

static void test_svg(void **state) {
    (void)state;
    static const char *const plans[] = {
        // Inkscape, Illustrator, and names of the shapes themselves; groups within groups; uses.
        SVG("<g xmlns:i='urn:i' i:label='Wände' id='layer1'>" POLYLINE
            "</g><g xmlns:i='urn:i' i:label='Türen'><path d='M2 10V9A1 1 0 0 1 3 10'/></g>"
            "<g id='layer3' xmlns:i='urn:i' i:label='Möbel'><rect x='4' y='4' width='1' "
            "height='1'/>"
            "</g>"),
        SVG("<g id='Walls_x5F_ext'>" POLYLINE
            "</g><g id='Doors'><line x1='2' y1='10' x2='2' y2='9'/>"
            "<path d='M2 9C2.5523 9 3 9.4477 3 10'/></g><g id='Text_1_'><path d='M0 0L5 5'/></g>"),
        SVG("<polyline class='outer wall' points='2,10 0,10 0,2 10,2 10,10 3,10'/>"
            "<path id='door-12' d='M2 10V9A1 1 0 0 1 3 10'/><circle class='chair' r='1'/>"),
        SVG("<g id='site plan'><g id='EG'><g id='murs'><g id='g7'>" POLYLINE
            "</g></g><g id='mobilier'><circle r='1'/></g></g><path d='M2 10V9A1 1 0 0 1 3 10'"
            " class='st0'/></g>"),
        SVG("<defs><symbol id='chair'><circle r='1'/></symbol></defs><g id='floor 1'>" POLYLINE
            "<use href='#chair' x='5' y='5'/><path d='M2 10V9A1 1 0 0 1 3 10'/></g>"),
    };
    for (size_t i = 0; i < sizeof plans / sizeof *plans; i++) {
        assert_map(sli_map_read_svg, plans[i], NULL, false, SHUT_WALLS);
        // The fourth has its swing on the site's layer.
        if (i != 3)
            assert_map(sli_map_read_svg, plans[i], NULL, true,
                       SHUT_WALLS DOOR("door1", 2, 0, 3, 0));
    }
}

static void test_svg_asked_for(void **state) {
    (void)state;
    static const char text[] = SVG("<g id='walls'>" POLYLINE "</g><g id='sofa'><line x2='1'/></g>");
    assert_map(sli_map_read_svg, text, NULL, false, SHUT_WALLS);
    assert_map(sli_map_read_svg, text, "*", false, SHUT_WALLS "wall 0 10 1 10\n");
    assert_map(sli_map_read_svg, text, "sofa", false, "wall 0 10 1 10\n");
}

/// Nine rooms in one layer, side by side in walls of two faces, with a bed in one.
static void test_one_layer(void **state) {
    (void)state;
    enum { PITCH = 43, SIDE = 40, BED = 6 };
    static const int bed[BED][4] = {{5, 5, 15, 5}, {15, 5, 15, 25}, {15, 25, 5, 25},
                                    {5, 25, 5, 5}, {5, 20, 15, 20}, {7, 21, 13, 24}};
    char text[16384] = HEAD, notes[4096], *end = text + strlen(text);
    const char *const form = "0\nLINE\n8\n0\n10\n%g\n20\n%g\n11\n%g\n21\n%g\n";
    for (int room = 0; room < 9; room++)
        for (int side = 0; side < 4; side++) {
            const int x = PITCH * (room % 3), y = PITCH * (room / 3), next = (side + 1) % 4;
            const int dx[] = {0, SIDE, SIDE, 0}, dy[] = {0, 0, SIDE, SIDE};
            end += sprintf(end, form, (x + dx[side]) / 10., (y + dy[side]) / 10.,
                           (x + dx[next]) / 10., (y + dy[next]) / 10.);
        }
    for (int i = 0; i < BED; i++)
        end +=
            sprintf(end, form, bed[i][0] / 10., bed[i][1] / 10., bed[i][2] / 10., bed[i][3] / 10.);
    strcpy(end, TAIL);
    char metres[16600];
    snprintf(metres, sizeof metres, "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n%s",
             text);
    assert_int_equal(import_noted_dxf(metres, NULL, notes), 36);
    assert_non_null(strstr(notes, "no walls by their shape: 6 lines that touch no wall (furniture, "
                                  "symbols) (--layers A,B chooses, --layers '*' takes all)"));
    assert_int_equal(import_noted_dxf(metres, "0", notes), 36);
    assert_non_null(strstr(notes, "no walls by their shape: 6 lines that touch no wall"));
    assert_int_equal(import_noted_dxf(metres, "*", notes), 36 + BED);
    assert_null(strstr(notes, "shape"));
}

static void test_walls_on_doors(void **state) {
    (void)state;
    char notes[4096];
    // Half of the layer's lines are short: they may be doors.
#define BESIDE_DOORS LINE("A-DOOR", 0, 4, 4, 4) LINE("A-DOOR", 6, 4, 6, 8)
#define SHORT(y0, y1)                                                                              \
    LINE("A-DOOR", 7, y0, 9, y0)                                                                   \
    LINE("A-DOOR", 9, y0, 9, y1) LINE("A-DOOR", 9, y1, 7, y1) LINE("A-DOOR", 7, y1, 7, y0)
    static const char text[] =
        UNIT("6") HEAD ROOM("A-WALL") SWING("A-DOOR") BESIDE_DOORS SHORT(2, 2.5) SHORT(5, 5.5) TAIL;
    assert_int_equal(import_noted_dxf(text, NULL, notes), 5);
    assert_non_null(strstr(notes, "A-DOOR: 2 lines on layers of doors are longer than doors"));
    assert_non_null(strstr(notes, "name all layers of walls: --layers 'A-WALL,A-DOOR'"));
    // The layers that are named lead to these walls, without the swing; all layers have it.
    assert_int_equal(import_noted_dxf(text, "A-WALL,A-DOOR", notes), 15);
    assert_non_null(strstr(notes, "walls from A-WALL, A-DOOR; 1 door is drawn open: gaps"));
    assert_true(import_noted_dxf(text, "*", notes) > 16);
    // A layer that has more long lines than others is one of walls.
    static const char most[] =
        UNIT("6") HEAD ROOM("A-WALL") SWING("A-DOOR") BESIDE_DOORS SHORT(2, 2.5) TAIL;
    assert_int_equal(import_noted_dxf(most, NULL, notes), 11);
    assert_non_null(strstr(notes, "A-DOOR: named as doors, but most of its lines are longer than "
                                  "doors (2): they are walls"));
    assert_non_null(strstr(notes, "1 door is drawn open: gaps"));
    assert_int_equal(import_noted_dxf(most, "A-DOOR=door", notes), 5);
    assert_null(strstr(notes, "named as doors"));
    // One long line is a gate, and no unit says how long doors are.
    static const char *const gates[] = {UNIT("6") HEAD ROOM("A-WALL") LINE("A-DOOR", 0, 4, 4, 4),
                                        HEAD ROOM("A-WALL") BESIDE_DOORS};
    for (int i = 0; i < 2; i++) {
        snprintf(notes, sizeof notes, "%s" TAIL, gates[i]);
        char gate[sizeof notes];
        strcpy(gate, notes);
        assert_int_equal(import_noted_dxf(gate, NULL, notes), 5);
        assert_null(strstr(notes, "named as doors"));
    }
    // The arc may be drawn as lines one by one; lines that turn back are none.
#define CHORDS(y)                                                                                  \
    LINE("A-DOOR", 3, 0, 2.86603, 0.5)                                                             \
    LINE("A-DOOR", 2.86603, 0.5, 2.5, 0.86603) LINE("A-DOOR", 2.5, 0.86603, 2, y)
    const char *const drawn = HEAD ROOM("A-WALL") LINE("A-DOOR", 2, 0, 2, 1) CHORDS(1) TAIL;
    assert_int_equal(import_noted_dxf(drawn, "A-WALL,A-DOOR", notes), 5);
    const char *const bent = HEAD ROOM("A-WALL") LINE("A-DOOR", 2, 0, 2, 1) CHORDS(3) TAIL;
    assert_int_equal(import_noted_dxf(bent, "A-WALL,A-DOOR", notes), 9);
    assert_int_equal(import_noted_dxf(HEAD ROOM("A-WALL") SWING("A-DOOR") TAIL, NULL, notes), 5);
    assert_null(strstr(notes, "longer"));
}

/// Where the layer of walls has little, outlines of rooms are walls.
static void test_outlines_of_rooms(void **state) {
    (void)state;
    char notes[4096];
    static const char text[] = HEAD ROOM("Rooms") LINE("WALLS", 2, 0, 2, 1)
        LINE("WALLS", 3, 0, 3, 1) LINE("WALLS", 5, 8, 5, 7) LINE("zone plan", 0, 1, 10, 1) TAIL;
    assert_int_equal(import_noted_dxf(text, NULL, notes), 8);
    assert_non_null(strstr(notes, "layers of rooms give walls, too"));
    assert_int_equal(import_noted_dxf(text, "Rooms=ignore", notes), 3);
    static const char whole[] = HEAD ROOM("WALLS") ROOM("Rooms") TAIL;
    assert_int_equal(import_noted_dxf(whole, NULL, notes), 5);
    assert_null(strstr(notes, "layers of rooms"));
}

/// Rooms without gaps are shut though doors are drawn at their walls. Leaves at the ends of walls
/// and doors in gaps are none of that.
static void test_shut_doors(void **state) {
    (void)state;
    static const double walls[][4] = {{0, 0, 9, 0}, {9, 0, 9, 9}, {9, 9, 0, 9}, {0, 9, 0, 0}},
                        doors[][2][4] = {{{3, 0, 3.4, 0.8}, {9, 5, 8.2, 5.4}},
                                         {{0, 0, 0.6, 0.6}, {9, 9, 8.4, 8.4}},
                                         {{3, 0, 3, 9}, {9, 5, 0, 5}}};
    for (int i = 0; i < 6; i++) {
        const double c = i % 2 ? cos(17.3 * 0.017453292519943295) : 1,
                     n = i % 2 ? sqrt(1 - c * c) : 0;
        char text[4096] = HEAD, notes[4096];
        for (int k = 0; k < 6; k++) {
            const double *p = k < 4 ? walls[k] : doors[i / 2][k - 4];
            sprintf(text + strlen(text),
                    "0\nLINE\n8\n%s\n10\n%.17g\n20\n%.17g\n11\n%.17g\n21\n%.17g\n",
                    k < 4 ? "WALL" : "DOOR", c * p[0] - n * p[1], n * p[0] + c * p[1],
                    c * p[2] - n * p[3], n * p[2] + c * p[3]);
        }
        strcat(text, TAIL);
        assert_int_equal(import_noted_dxf(text, NULL, notes), 4);
        assert_int_equal(strstr(notes, "2 lines on layers of doors stand at walls without a gap") !=
                             NULL,
                         i < 2);
    }
}

/// Doors that are drawn open show where the plan is, whatever the layer's name says; two are too
/// few, and so are those of a drawing whose other layers have doors, or are named as walls.
static void test_layers_of_doors(void **state) {
    (void)state;
#define BESIDE       LINE("house", 20, 0, 20, 8) LINE("house", 20, 8, 30, 8) LINE("house", 30, 8, 30, 0)
#define BESIDE_WALLS "wall 20 0 20 8\nwall 20 8 30 8\nwall 30 8 30 0\n"
#define DOOR_AT(x)   LINE("DETAILS", x, 0, x, 1) ARC("DETAILS", x, 0, 1, 0, 90)
    const char *const room = HEAD ROOM("DETAILS") BESIDE DOOR_AT(2) DOOR_AT(5) DOOR_AT(7) TAIL;
    assert_map(sli_map_read_dxf, room, NULL, false,
               "entrance 1.42 doors\n"
               "wall 2 0 0 0\nwall 0 0 0 8\nwall 0 8 10 8\nwall 10 8 10 0\nwall 10 0 8 0\n"
               "wall 7 0 6 0\nwall 5 0 3 0\n" BESIDE_WALLS);
    assert_map(sli_map_read_dxf, HEAD ROOM("DETAILS") BESIDE DOOR_AT(2) DOOR_AT(5) TAIL, NULL,
               false, BESIDE_WALLS);
    assert_map(sli_map_read_dxf,
               HEAD ROOM("DETAILS") BESIDE DOOR_AT(2) DOOR_AT(5) DOOR_AT(7) SWING("house") TAIL,
               NULL, false, BESIDE_WALLS);
    assert_map(sli_map_read_dxf,
               HEAD ROOM("DETAILS") DOOR_AT(2) DOOR_AT(5) DOOR_AT(7) LINE("WALL", 20, 0, 20, 8)
                   LINE("WALL", 20, 8, 30, 8) LINE("WALL", 30, 8, 30, 0) TAIL,
               NULL, false, BESIDE_WALLS);
}

/// A page, walls by thick black lines, furniture and a letter; no name says anything.
#define PAGE "<rect width='20' height='10' fill='#eee'/>"
#define HEAVY                                                                                      \
    "<g id='g12' stroke='black' stroke-width='.3' fill='none'><path d='M2 0H0V8H10V0H3'/>"         \
    "<path d='M10 0H18V8H10'/><path d='M5 8V5'/></g>"
#define LIGHT                                                                                      \
    "<g stroke='#999' stroke-width='.05' fill='none'><rect x='1' y='6' width='2' height='1'/>"     \
    "<rect x='6' y='6' width='2' height='1'/><path d='M11 1H17V2H11'/></g>"
#define LETTER "<path d='M7 3h.1v.1h.1v-.1h.1v.2h-.1v.1h-.1v-.1h-.1z'/>"
#define COLUMN "<rect x='14' y='4' width='.3' height='.3'/>"
#define HEAVY_WALLS                                                                                \
    "wall 2 10 0 10\nwall 0 10 0 2\nwall 0 2 10 2\nwall 10 2 10 10\nwall 10 10 3 10\n"             \
    "wall 10 10 18 10\nwall 18 10 18 2\nwall 18 2 10 2\nwall 5 2 5 5\n"

static void test_looks(void **state) {
    (void)state;
    static const char plan[] = SVG(PAGE HEAVY LIGHT LETTER);
    assert_map(sli_map_read_svg, plan, NULL, false, HEAVY_WALLS);
    assert_map(sli_map_read_svg, plan, "black line 0.3", false, HEAVY_WALLS);
    assert_map(sli_map_read_svg, SVG(PAGE HEAVY LIGHT COLUMN), NULL, false,
               HEAVY_WALLS "wall 14 6 14.3 6\nwall 14.3 6 14.3 5.7\nwall 14.3 5.7 14 5.7\n"
                           "wall 14 5.7 14 6\n");
    assert_noted_of(
        sli_map_read_svg, NULL, plan, strlen(plan), HEAVY_WALLS,
        "walls from black line 0.3: 3 shapes; passed over: #999999 line 0.05: 3 shapes");
    sl_import_options wrong = sl_import_options_default();
    wrong.layers = "black line 0.4";
    assert_refused_of(sli_map_read_svg, &wrong, plan, strlen(plan), SL_BAD_ARGUMENT,
                      "f: there is no layer 'black line 0.4' in the drawing; it has g12, #eeeeee "
                      "fill, black line 0.3");
    // light walls on a dark page
    assert_map(sli_map_read_svg,
               SVG("<rect width='20' height='10' fill='#111'/><g stroke='white' stroke-width='.3' "
                   "fill='none'><path d='M2 0H0V8H10V0H3'/><path d='M10 0H18V8H10'/><path "
                   "d='M5 8V5'/></g>" LIGHT "<path d='M7 3h.1v.1h.1v-.1h.1v.2h-.1v.1h-.1v-.1h-.1z' "
                   "fill='white'/>"),
               NULL, false, HEAVY_WALLS);
    // all alike: nothing is told
    assert_map(sli_map_read_svg, SVG("<g fill='none' stroke='#000'>" POLYLINE "</g>"), NULL, false,
               SHUT_WALLS);
    // a group that holds all says nothing of it
    assert_map(sli_map_read_svg, SVG("<g id='axes_1'>" PAGE HEAVY LIGHT LETTER "</g>"), NULL, false,
               HEAVY_WALLS);
}

/// Thick outer walls with gaps for doors, thinner inner walls; tables, that are closed, are none.
static void test_ring(void **state) {
    (void)state;
#define LINES(width, d) "<path fill='none' stroke='black' stroke-width='" width "' d='" d "'/>"
#define RING                                                                                       \
    LINES(".6", "M2 0H0V8H10")                                                                     \
    LINES(".6", "M3 0H18V3")                                                                       \
    LINES(".6", "M18 4V8H11") LIGHT LINES(".15", "M2 5h3v2h-3z") LINES(".15", "M12 5h3v2h-3z")
#define RING_WALLS                                                                                 \
    "wall 2 10 0 10\nwall 0 10 0 2\nwall 0 2 10 2\nwall 3 10 18 10\nwall 18 10 18 7\n"             \
    "wall 18 6 18 2\nwall 18 2 11 2\n"
#define TABLES                                                                                     \
    "wall 2 5 5 5\nwall 5 5 5 3\nwall 5 3 2 3\nwall 2 3 2 5\n"                                     \
    "wall 12 5 15 5\nwall 15 5 15 3\nwall 15 3 12 3\nwall 12 3 12 5\n"
    assert_map(sli_map_read_svg, SVG(RING), NULL, false, RING_WALLS);
#define ROOMS LINES(".15", "M0 4H7") LINES(".15", "M8 4H18") LINES(".15", "M9 0V4")
    assert_map(sli_map_read_svg, SVG(RING ROOMS), NULL, false,
               RING_WALLS TABLES "wall 0 6 7 6\nwall 8 6 18 6\nwall 9 10 9 6\n");
    // Turned, as many are walls.
    static const char turned[] = SVG("<g transform='rotate(17.3)'>" RING ROOMS "</g>");
    sl_context *context = sl_context_create(NULL);
    const sl_import_options usual = sl_import_options_default();
    sl_map map = {0};
    assert_ok(context, sli_map_read_svg(context, "f", turned, strlen(turned), &usual, &map));
    assert_int_equal(map.wall_count, 18);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Coloured rooms without lines: their outlines are walls, and lettering is none.
static void test_rooms(void **state) {
    (void)state;
#define ROOM_OF(x, colour) "<rect x='" #x "' y='1' width='4' height='4' fill='" colour "'/>" LETTER
    assert_map(sli_map_read_svg,
               SVG(ROOM_OF(0, "#fcc") ROOM_OF(4, "#cfc") ROOM_OF(8, "#ccf") ROOM_OF(12, "#ffc")),
               NULL, false,
               "wall 0 9 4 9\nwall 4 9 4 5\nwall 4 5 0 5\nwall 0 5 0 9\n"
               "wall 4 9 8 9\nwall 8 9 8 5\nwall 8 5 4 5\nwall 4 5 4 9\n"
               "wall 8 9 12 9\nwall 12 9 12 5\nwall 12 5 8 5\nwall 8 5 8 9\n"
               "wall 12 9 16 9\nwall 16 9 16 5\nwall 16 5 12 5\nwall 12 5 12 9\n");
}

/// Beside the nodes of a route graph, layers of edges have no walls; else they may have.
static void test_edges(void **state) {
    (void)state;
#define EDGE LINE("edge", 5, 4, 5, 9)
    assert_dxf(ROOM("room") EDGE, ROOM_WALLS "wall 5 4 5 9\n");
    assert_dxf(ROOM("room") EDGE LINE("node", 5, 4, 6, 4), ROOM_WALLS);
}

/// Three lines side by side that go out of their clip obliquely are hatching, with names that say
/// walls too.
static void test_clipped_hatching(void **state) {
    (void)state;
#define CLIP(d)     "<clipPath id='c'><path d='" d "'/></clipPath>"
#define CLIPPED(d)  "<g clip-path='url(#c)'>" d "</g>"
#define IN(box, d)  SVG(CLIP(box) "<g id='walls'>" POLYLINE CLIPPED(d) "</g>")
#define SMALL       "M2 2H8V8H2Z"
#define THREE       "<path d='M0 1L9 10'/><path d='M1 1L9 9'/><path d='M1 0L10 9'/>"
#define THREE_WALLS "wall 0 9 9 0\nwall 1 9 9 1\nwall 1 10 10 1\n"
    assert_map(sli_map_read_svg, IN(SMALL, THREE), NULL, false, SHUT_WALLS);
    assert_map(sli_map_read_svg, IN(SMALL, THREE), "*", false, SHUT_WALLS THREE_WALLS);
    // One line may be a wall, and so may lines that are not side by side
    assert_map(sli_map_read_svg, IN(SMALL, "<path d='M0 1L9 10'/>"), NULL, false,
               SHUT_WALLS "wall 0 9 9 0\n");
    assert_map(sli_map_read_svg,
               IN(SMALL, "<path d='M0 1L9 10'/><path d='M1 1L9 8'/><path d='M1 9L9 0'/>"), NULL,
               false, SHUT_WALLS "wall 0 9 9 0\nwall 1 9 9 2\nwall 1 1 9 10\n");
    // A clip as large as the plan is that of a page: it cuts walls at its edge
    assert_map(sli_map_read_svg, IN("M1 1H9V9H1Z", THREE), NULL, false, SHUT_WALLS THREE_WALLS);
    // What is level, within its clip, or short
    assert_map(sli_map_read_svg, IN(SMALL, "<path d='M0 5H9'/>"), NULL, false,
               SHUT_WALLS "wall 0 5 9 5\n");
    assert_map(sli_map_read_svg, IN(SMALL, "<path d='M3 3L7 7'/>"), NULL, false,
               SHUT_WALLS "wall 3 7 7 3\n");
    assert_map(sli_map_read_svg, IN(SMALL, "<path d='M7 7L9 9'/>"), NULL, false,
               SHUT_WALLS "wall 7 3 9 1\n");
}

static void test_memory(void **state) {
    (void)state;
    sl_import_options options = sl_import_options_default();
    options.doors = true;
    assert_memory_of(sli_map_read_dxf, &options,
                     HEAD ROOM("A-WALL") LINE("A-GLAZ", 10, 3, 10, 5) SWING("A-DOOR") TAIL);
    assert_memory_of(sli_map_read_svg, &options,
                     SVG("<g id='walls'>" POLYLINE "</g><path d='M2 10V9A1 1 0 0 1 3 10'/>"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_languages),
        cmocka_unit_test(test_no_choice),
        cmocka_unit_test(test_blocks),
        cmocka_unit_test(test_tags),
        cmocka_unit_test(test_swings),
        cmocka_unit_test(test_width_of_doors),
        cmocka_unit_test(test_shut_doors),
        cmocka_unit_test(test_hatching),
        cmocka_unit_test(test_turned_swings),
        cmocka_unit_test(test_asked_for),
        cmocka_unit_test(test_svg),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_svg_asked_for),
        cmocka_unit_test(test_one_layer),
        cmocka_unit_test(test_walls_on_doors),
        cmocka_unit_test(test_outlines_of_rooms),
        cmocka_unit_test(test_layers_of_doors),
        cmocka_unit_test(test_looks),
        cmocka_unit_test(test_ring),
        cmocka_unit_test(test_rooms),
        cmocka_unit_test(test_edges),
        cmocka_unit_test(test_clipped_hatching),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
