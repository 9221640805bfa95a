/// What layers of drawings are taken for: as guessed, as the user says, and the texts on them.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/io.h"

#include <math.h>

#define HEAD "0\nSECTION\n2\nENTITIES\n"
#define TAIL "0\nENDSEC\n0\nEOF\n"
#define LINE(layer, x0, y0, x1, y1)                                                                \
    "0\nLINE\n8\n" layer "\n10\n" #x0 "\n20\n" #y0 "\n11\n" #x1 "\n21\n" #y1 "\n"
#define ROOM(layer)                                                                                \
    LINE(layer, 0, 0, 0, 8)                                                                        \
    LINE(layer, 0, 8, 10, 8) LINE(layer, 10, 8, 10, 0) LINE(layer, 10, 0, 0, 0)
#define ROOM_WALLS "wall 0 0 0 8\nwall 0 8 10 8\nwall 10 8 10 0\nwall 10 0 0 0\n"

static const char named[] = HEAD ROOM("A-WALL") LINE("A-GLAZ", 4, 0, 4, 8) LINE("FURN", 2, 2, 3, 2)
    LINE("XX", 6, 2, 7, 2) TAIL;
static const char unnamed[] = HEAD ROOM("a") LINE("b", 4, 0, 4, 8) LINE("c", 2, 2, 3, 2) TAIL;

static void assert_dxf(const char *text, const char *layers, const char *expected) {
    sl_import_options options = sl_import_options_default();
    options.layers = layers;
    assert_walls_of(sli_map_read_dxf, &options, text, strlen(text), expected);
}

static void roles_of_named_layers(void **state) {
    (void)state;
    assert_dxf(named, NULL, ROOM_WALLS "wall 4 0 4 8 stops steps,sound\n");
    // Another role for one layer; the others stay as guessed.
    assert_dxf(named, "A-GLAZ=wall", ROOM_WALLS "wall 4 0 4 8\n");
    assert_dxf(named, "a-glaz=IGNORE", ROOM_WALLS);
    assert_dxf(named, "A-GLAZ=ignore,xx=wall", ROOM_WALLS "wall 6 2 7 2\n");
    assert_dxf(named, "A-GLAZ=ignore,XX", ROOM_WALLS "wall 6 2 7 2\n"); // a wall
    assert_dxf(named, "A-GLAZ=ignore,FURN=furniture", ROOM_WALLS "wall 2 2 3 2 stops steps\n");
    assert_dxf(named, "A-GLAZ=door", ROOM_WALLS);
    // The last word on a layer counts.
    assert_dxf(named, "A-GLAZ=wall,A-GLAZ=ignore", ROOM_WALLS);
}

static void roles_of_unnamed_layers(void **state) {
    (void)state;
    assert_dxf(unnamed, "b=ignore", ROOM_WALLS "wall 2 2 3 2\n");
    assert_dxf(unnamed, "a=wall", ROOM_WALLS "wall 4 0 4 8\nwall 2 2 3 2\n");
    assert_dxf(unnamed, "b=window", ROOM_WALLS "wall 2 2 3 2\nwall 4 0 4 8 stops steps,sound\n");
}

/// What is said of a drawing.
static void assert_noted(const char *text, const char *layers, const char *expected, bool said) {
    char notes[4096];
    import_noted_dxf(text, layers, notes);
    if (said != (strstr(notes, expected) != NULL)) fail_msg("noted: %s", notes);
}

/// A layer of walls and windows has the walls where its lines are longer than what is named for
/// walls alone; else the windows.
static void walls_and_windows(void **state) {
    (void)state;
#define POST       LINE("柱", 0, 0, 0, .1) LINE("柱", 0, .1, .1, .1) LINE("柱", .1, .1, .1, 0)
#define POST_WALLS "wall 0 0 0 0.1\nwall 0 0.1 0.1 0.1\nwall 0.1 0.1 0.1 0\n"
#define GLAZED     " stops steps,sound\n"
    static const char plan[] = HEAD POST ROOM("9_壁__窓") LINE("x", 4, 4, 5, 4) TAIL;
    assert_dxf(plan, NULL, POST_WALLS ROOM_WALLS);
    assert_noted(plan, NULL,
                 "f: 9_壁__窓: named for walls and for windows: taken for walls, as its lines are "
                 "longer than those of layers named for walls alone; --layers '9_壁__窓=window' "
                 "takes it for windows",
                 true);
    assert_dxf(plan, "9_壁__窓=window",
               POST_WALLS "wall 0 0 0 8" GLAZED "wall 0 8 10 8" GLAZED "wall 10 8 10 0" GLAZED
                          "wall 10 0 0 0" GLAZED);
    assert_noted(plan, "9_壁__窓=window", "named for walls and", false);
    // Also where nothing is left out.
    assert_noted(HEAD POST ROOM("9_壁__窓") TAIL, NULL, "named for walls and for windows", true);
    // With walls beside it, it has the windows, or the doors.
    static const char few[] = HEAD ROOM("WALL") LINE("Wall Windows", 4, 0, 4, 8) TAIL;
    assert_dxf(few, NULL, ROOM_WALLS "wall 4 0 4 8" GLAZED);
    assert_noted(few, NULL,
                 "taken for windows, as its lines are shorter than those of layers named for walls "
                 "alone; --layers 'Wall Windows=wall' takes it for walls",
                 true);
    assert_dxf(few, "Wall Windows=wall", ROOM_WALLS "wall 4 0 4 8\n");
    assert_dxf(HEAD ROOM("WALL") LINE("wall door", 4, 0, 4, 1) TAIL, NULL, ROOM_WALLS);
    // A wall of glass is one thing.
    assert_dxf(HEAD ROOM("COLUMN") LINE("Curtain wall", 0, -5, 99, -5) TAIL, NULL,
               ROOM_WALLS "wall 0 -5 99 -5" GLAZED);
}

/// Too many layers that may be walls: the command has those with the longest lines.
static void many_layers(void **state) {
    (void)state;
#define LONG_NAME(n)   n "_of_the_first_floor_of_the_northern_house"
#define SHORT_LINES(n) LINE(LONG_NAME(n), 2, 2, 2, 2.5)
    static const char text[] =
        HEAD ROOM("A-WALL") LINE("Rooms_1", -9, 0, -9, 90) LINE("Outline 2", -9, 0, 90, 0)
            SHORT_LINES("a") SHORT_LINES("b") SHORT_LINES("c") SHORT_LINES("d") SHORT_LINES("e")
                SHORT_LINES("f") SHORT_LINES("g") SHORT_LINES("h") TAIL;
    assert_noted(text, NULL, "as in: --layers 'A-WALL,Outline 2,Rooms_1'", true);
}

static void unknown_layer(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    sl_import_options options = sl_import_options_default();
    static const char text[] =
        "0\nSECTION\n2\nTABLES\n0\nLAYER\n2\nA-GLAZ\n70\n1\n0\nENDSEC\n" HEAD ROOM("A-WALL")
            LINE("A-GLAZ", 4, 0, 4, 8) TAIL;
    options.layers = "A-GLAZ=wall"; // frozen, but asked for
    assert_ok(context, sli_map_read_dxf(context, "f", text, strlen(text), &options, &map));
    assert_int_equal(map.wall_count, 5);
    sl_map_destroy(context, &map);
    options.layers = "A-GLAZ=wall,nobody=ignore";
    assert_int_equal(sli_map_read_dxf(context, "f", text, strlen(text), &options, &map),
                     SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(context), "there is no layer 'nobody'"));
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static void assert_role(const sl_drawing_layers *layers, const char *name, const char *role) {
    for (size_t i = 0; i < layers->count; i++)
        if (strcmp(layers->items[i].name, name) == 0) {
            assert_string_equal(layers->items[i].taken_for, role);
            return;
        }
    fail_msg("no layer %s", name);
}

static void guesses(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_drawing_layers layers = {0};
    assert_ok(context, sl_drawing_layers_dxf(context, "f", named, strlen(named), &layers));
    assert_role(&layers, "A-WALL", "wall");
    assert_role(&layers, "A-GLAZ", "window");
    assert_role(&layers, "FURN", "ignore");
    assert_role(&layers, "XX", "ignore");
    sl_drawing_layers_destroy(context, &layers);
    assert_ok(context, sl_drawing_layers_dxf(context, "f", unnamed, strlen(unnamed), &layers));
    assert_role(&layers, "a", "wall");
    assert_role(&layers, "b", "wall");
    sl_drawing_layers_destroy(context, &layers);
    static const char svg[] =
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'><g id='walls'>"
        "<path d='M0 0H90V90H0Z'/></g><g id='doors'><path d='M0 9H9'/></g><g id='x'>"
        "<path d='M20 20H30'/></g></svg>";
    assert_ok(context, sl_drawing_layers_svg(context, "f", svg, strlen(svg), &layers));
    assert_role(&layers, "walls", "wall");
    assert_role(&layers, "doors", "door");
    assert_role(&layers, "x", "ignore");
    sl_drawing_layers_destroy(context, &layers);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

/// Looks of an SVG drawing have roles as groups have.
static void roles_of_looks(void **state) {
    (void)state;
    static const char svg[] =
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'>"
        "<path fill='none' stroke='#000' stroke-width='3' d='M0 0H90V90H0Z'/>"
        "<path fill='none' stroke='#f00' stroke-width='1' d='M20 20H80V60'/></svg>";
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_drawing_layers layers = {0};
    assert_ok(context, sl_drawing_layers_svg(context, "f", svg, strlen(svg), &layers));
    assert_int_equal(layers.count, 2);
    for (size_t i = 0; i < 2; i++) {
        sl_map map = {0};
        char list[128];
        sl_import_options options = sl_import_options_default();
        snprintf(list, sizeof list, "%s=ignore,%s=wall", layers.items[i].name,
                 layers.items[!i].name);
        options.layers = list;
        const sl_status status = sli_map_read_svg(context, "f", svg, strlen(svg), &options, &map);
        assert_ok(context, status);
        // Two walls are too few to be a choice: all stays then.
        assert_int_equal(map.wall_count, strstr(layers.items[!i].name, "black") ? 4 : 6);
        sl_map_destroy(context, &map);
    }
    sl_drawing_layers_destroy(context, &layers);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static void texts(void **state) {
    (void)state;
    static const char dxf[] =
        HEAD ROOM("A-WALL") "0\nTEXT\n8\nNAMES\n10\n2\n20\n3\n40\n0.5\n1\nKitchen\n"
                            "0\nMTEXT\n8\nNAMES\n10\n5\n20\n3\n40\n0.25\n3\n{\\fArial|b0;Li\n1\n"
                            "ving\\~room}\\P12 m2\n0\nTEXT\n8\nNAMES\n10\nx\n20\n3\n1\nbad\n"
                            "0\nTEXT\n8\nNAMES\n67\n1\n10\n1\n20\n3\n1\npaper\n" TAIL;
    static const char svg[] =
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'>"
        "<path fill='none' stroke='#000' stroke-width='3' d='M0 0H90V90H0Z'/>"
        "<g transform='translate(10,20)'><text><tspan x='5' y='6'>Hall</tspan><tspan x='5' y='9'>"
        "2</tspan></text></g><text x='1' y='1' display='none'>no</text></svg>";
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    const sl_import_options options = sl_import_options_default();
    sl_map map = {0};
    assert_ok(context, sli_map_read_dxf(context, "f", dxf, strlen(dxf), &options, &map));
    assert_int_equal(map.source.text_count, 2);
    assert_string_equal(map.source.texts[0].text, "Kitchen");
    assert_true(map.source.texts[0].at.x == 2 && map.source.texts[0].at.y == 3);
    assert_true(map.source.texts[0].height == 0.5);
    assert_string_equal(map.source.texts[1].text, "Living room");
    sl_map_destroy(context, &map);
    assert_ok(context, sli_map_read_svg(context, "f", svg, strlen(svg), &options, &map));
    assert_int_equal(map.source.text_count, 1);
    assert_string_equal(map.source.texts[0].text, "Hall");
    assert_true(map.source.texts[0].at.x == 15 && map.source.texts[0].at.y == 100 - 26);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roles_of_named_layers), cmocka_unit_test(roles_of_unnamed_layers),
        cmocka_unit_test(unknown_layer),         cmocka_unit_test(guesses),
        cmocka_unit_test(roles_of_looks),        cmocka_unit_test(texts),
        cmocka_unit_test(walls_and_windows),     cmocka_unit_test(many_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
