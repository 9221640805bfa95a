// Drawings whose corners miss each other by their last digit are closed; honest gaps stay.
#include "testing.h"

#include "io/io_formats.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <math.h>

typedef sl_status import_reader(sl_context *context, const char *name, const char *text,
                                size_t size, const sl_import_options *options, sl_map *map);

/// Follows portals, and marks the cells that a cell is joined with.
static double spread(const sl_space *space, uint32_t cell, bool *seen) {
    double area = sl_space_area(space, cell);
    seen[cell] = true;
    const sl_cell *c = &space->cells[cell];
    for (uint32_t i = 0; i < c->directed_count; i++) {
        const uint32_t next = space->directed[c->first_directed + i].cell;
        if (!seen[next]) area += spread(space, next, seen);
    }
    return area;
}

/// What a map is cut into: the parts that no portal joins, those that the border does not reach,
/// and the area of these.
typedef struct outcome {
    sl_clean_account account;
    size_t parts, closed;
    double area;
    bool axial;
} outcome;

/// `weld` as in sl_clean_options. The map is left empty.
static outcome look(sl_context *context, sl_map *map, double weld) {
    outcome out = {0};
    sl_space space;
    // Room about the map, for what leads out.
    const sl_point low = {-100, -100}, high = {200, 200};
    assert_ok(context, sl_map_add_wall(context, map, low, (sl_point){low.x + 1, low.y}, 0));
    assert_ok(context, sl_map_add_wall(context, map, high, (sl_point){high.x - 1, high.y}, 0));
    assert_ok(context, sl_map_clean(context, map, &(sl_clean_options){.weld = weld}, &out.account));
    assert_true(map->precision == 0);
    out.axial = sl_map_is_axial(map);
    map->start_count = 0; // inside is then what the border does not reach
    assert_ok(context, sl_subdivision_for(map)->subdivide(context, map, NULL, &space));
    bool *seen = calloc(space.cell_count, sizeof *seen);
    assert_non_null(seen);
    for (uint32_t c = 0; c < space.cell_count; c++) {
        if (seen[c]) continue;
        const double area = spread(&space, c, seen);
        out.parts++;
        if (!space.cells[c].inside) continue;
        if (space.inside_count == space.cell_count) break; // no cell is
        out.closed++;
        out.area += area;
    }
    free(seen);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, map);
    return out;
}

static outcome look_at(import_reader *read, const char *text, double weld) {
    sl_context *context = testing_context(NULL);
    const sl_import_options options = sl_import_options_default();
    sl_map map = {0};
    assert_ok(context, read(context, "f", text, strlen(text), &options, &map));
    const outcome out = look(context, &map, weld);
    sl_context_destroy(context);
    return out;
}

/// A drawing is closed by default, and open without welding.
static void check_closed(import_reader *read, const char *text, double area) {
    const outcome closed = look_at(read, text, -1), open = look_at(read, text, 0);
    assert_int_equal(closed.closed, 1);
    if (!(fabs(closed.area - area) < 1e-3 * area)) fail_msg("area %g, not %g", closed.area, area);
    assert_true(closed.account.largest_move > 0);
    assert_int_equal(open.closed, 0);
    assert_true(open.account.largest_move == 0);
}

static void check_open(import_reader *read, const char *text) {
    const outcome out = look_at(read, text, -1);
    assert_int_equal(out.closed, 0);
    assert_true(out.account.largest_move == 0);
}

// --- a line as each format has it

/// Appends a line to the text; `first` where it is the first one.
typedef void write_line(char *text, bool first, const double at[4], int decimals);

static void write_dxf(char *text, bool first, const double at[4], int decimals) {
    (void)first;
    sprintf(text + strlen(text), "0\nLINE\n8\nw\n10\n%.*f\n20\n%.*f\n11\n%.*f\n21\n%.*f\n",
            decimals, at[0], decimals, at[1], decimals, at[2], decimals, at[3]);
}

static void write_svg(char *text, bool first, const double at[4], int decimals) {
    (void)first;
    sprintf(text + strlen(text), "<path d=\"M %.*f %.*f L %.*f,%.*f\"/>\n", decimals, at[0],
            decimals, at[1], decimals, at[2], decimals, at[3]);
}

static void write_uvtt(char *text, bool first, const double at[4], int decimals) {
    sprintf(text + strlen(text), "%s[{\"x\":%.*f,\"y\":%.*f},{\"x\":%.*f,\"y\":%.*f}]",
            first ? "" : ",", decimals, at[0], decimals, at[1], decimals, at[2], decimals, at[3]);
}

static void write_foundry(char *text, bool first, const double at[4], int decimals) {
    sprintf(text + strlen(text), "%s{\"c\":[%.*f,%.*f,%.*f,%.*f]}", first ? "" : ",", decimals,
            at[0], decimals, at[1], decimals, at[2], decimals, at[3]);
}

static const struct format {
    import_reader *read;
    write_line *write;
    const char *head, *tail;
} formats[] = {
    {sli_map_read_dxf, write_dxf, "0\nSECTION\n2\nENTITIES\n", "0\nENDSEC\n0\nEOF\n"},
    {sli_map_read_svg, write_svg, "<svg>\n", "</svg>\n"},
    // Without a width it has no edge.
    {sli_map_read_uvtt, write_uvtt,
     "{\"format\":0.3,\"resolution\":{\"map_size\":{\"x\":0,\"y\":64}},\"line_of_sight\":[", "]}"},
    {sli_map_read_foundry, write_foundry, "[", "]"},
};
enum { FORMATS = sizeof formats / sizeof *formats };

/// A drawing of lines, in the format. The text must be freed.
static char *drawing_of(const struct format *format, const double (*lines)[4], size_t count,
                        int decimals) {
    char *text = calloc(count + 4, 512);
    assert_non_null(text);
    strcpy(text, format->head);
    for (size_t i = 0; i < count; i++) format->write(text, i == 0, lines[i], decimals);
    strcat(text, format->tail);
    return text;
}

static void check_lines(const double (*lines)[4], size_t count, int decimals, double area) {
    for (int f = 0; f < FORMATS; f++) {
        char *text = drawing_of(&formats[f], lines, count, decimals);
        if (area > 0)
            check_closed(formats[f].read, text, area);
        else
            check_open(formats[f].read, text);
        free(text);
    }
}

// --- tests

/// Each corner is written twice, and misses by one unit, along and across.
static void test_corners(void **state) {
    (void)state;
    const double axial[][4] = {{0, 0, 12.3457, 0},
                               {12.3456, 0.0001, 12.3456, 8.7654},
                               {12.3457, 8.7655, -0.0001, 8.7655},
                               {0, 8.7654, 0, 0.0001}};
    check_lines(axial, 4, 4, 12.3457 * 8.7655);
    const double oblique[][4] = {{0.01, 2, 12.34, 0.57},
                                 {12.35, 0.56, 14.71, 9.13},
                                 {14.7, 9.14, 1.23, 11.01},
                                 {1.24, 11, 0, 1.99}};
    check_lines(oblique, 4, 2, 116.35);
}

/// An end that misses the wall that it should be on.
static void test_junctions(void **state) {
    (void)state;
    const double lines[][4] = {
        {0, 0, 9.125, 0}, {9.125, 0.001, 9.125, 7.251}, {0, 7.25, 9.125, 7.25},
        {0, 0, 0, 7.249}, {4.5, 0.001, 4.5, 7.249},
    };
    for (int f = 0; f < FORMATS; f++) {
        char *text = drawing_of(&formats[f], lines, 5, 3);
        assert_int_equal(look_at(formats[f].read, text, -1).closed, 2);
        assert_int_equal(look_at(formats[f].read, text, 0).closed, 0);
        free(text);
    }
}

/// A slit 50 units wide is one.
static void test_slits(void **state) {
    (void)state;
    const double axial[][4] = {
        {0, 0, 12.3457, 0}, {12.3457, 0.005, 12.3457, 8}, {12.3457, 8, 0, 8}, {0, 8, 0, 0}};
    check_lines(axial, 4, 4, 0);
    const double oblique[][4] = {{0, 0, 12.3457, 1.2345},
                                 {12.3507, 1.2345, 14, 8.2},
                                 {14, 8.2, 1, 9.3141},
                                 {1, 9.3141, 0, 0}};
    check_lines(oblique, 4, 4, 0);
}

/// Nothing misses: all stays axial, as without welding.
static void test_axial(void **state) {
    (void)state;
    const double lines[][4] = {{0, 0, 12.3457, 0},
                               {12.3457, 0, 12.3457, 8.7655},
                               {12.3457, 8.7655, 0, 8.7655},
                               {0, 8.7655, 0, 0},
                               {5.4321, -1, 5.4321, 8.7655}};
    for (int f = 0; f < FORMATS; f++) {
        char *text = drawing_of(&formats[f], lines, 5, 4);
        outcome with = look_at(formats[f].read, text, -1);
        const outcome without = look_at(formats[f].read, text, 0);
        assert_true(with.axial && with.closed == 2 && with.account.tolerance > 0);
        with.account.tolerance = 0;
        assert_memory_equal(&with.account, &without.account, sizeof with.account);
        free(text);
    }
}

static double precision_of(import_reader *read, const char *text) {
    sl_context *context = testing_context(NULL);
    const sl_import_options options = sl_import_options_default();
    sl_map map = {0}, copy = {0};
    assert_ok(context, read(context, "f", text, strlen(text), &options, &map));
    assert_ok(context, sl_map_copy(context, &map, &copy));
    const double precision = map.precision;
    assert_true(copy.precision == precision);
    sl_map_destroy(context, &map);
    sl_map_destroy(context, &copy);
    sl_context_destroy(context);
    return precision;
}

static void assert_precision(import_reader *read, const char *text, double expected) {
    const double precision = precision_of(read, text);
    if (!(fabs(precision - expected) <= 1e-12 * expected))
        fail_msg("%g is not %g: %s", precision, expected, text);
}

/// What map text cannot hold is no precision.
static void test_tiny(void **state) {
    (void)state;
    const sl_import_options options = sl_import_options_default();
    static const char text[] = "<svg><path d=\"M0,0L1.28001e-147,0\"/></svg>";
    sl_context *context = sl_context_create(NULL);
    sl_map map = {0};
    assert_ok(context, sli_map_read_svg(context, "tiny", text, sizeof text - 1, &options, &map));
    assert_int_equal(map.wall_count, 1);
    assert_true(map.precision == 0);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// The finest digit counts, in the map's unit.
static void test_precision(void **state) {
    (void)state;
    import_reader *const svg = sli_map_read_svg;
    assert_precision(svg, "<svg><path d='M0 0L20.50 1'/></svg>", 0.05);
    assert_precision(svg, "<svg><line x2='20' y2='12.5e-2'/></svg>", 0.005);
    assert_precision(svg, "<svg><polyline points='0,0 2000,3'/></svg>", 5);
    assert_precision(svg, "<svg><g transform='scale(10)'><path d='M0 0l2.125 1'/></g></svg>", 0.05);
    assert_precision(svg, "<svg><line x2='20.2500in'/></svg>", 5 * 0.0096);
    // On a coarse grid, and of nothing at all.
    assert_precision(svg, "<svg><path d='M0 0L20 1'/></svg>", 0);
    assert_precision(svg, "<svg></svg>", 0);
    // Digits of doubles count by the rounding of doubles.
    assert_precision(svg, "<svg><path d='M0 0L16.000000000000000001 1'/></svg>", 5 * 0x1p-47);
#define LINE(x) "0\nLINE\n10\n0\n20\n0\n11\n" x "\n21\n1\n"
#define DXF(blocks, entities)                                                                      \
    "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n" blocks        \
    "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" entities "0\nENDSEC\n0\nEOF\n"
    assert_precision(sli_map_read_dxf, DXF("", LINE(" 30.000 ")), 0.005);
    assert_precision(
        sli_map_read_dxf,
        DXF("0\nBLOCK\n2\nb\n" LINE("30.000") "0\nENDBLK\n", "0\nINSERT\n2\nb\n41\n4\n42\n4\n"),
        0.02);
    assert_precision(sli_map_read_foundry, "[{\"c\":[0,0,2000,0]},{\"c\":[0,0,7.25,1]}]", 0.05);
}

/// A short wall is not eaten: the tolerance stays below half of it.
static void test_short_walls(void **state) {
    (void)state;
    const double lines[][4] = {
        {0, 0, 20, 0}, {20, 0, 20, 9}, {20, 9, 0, 9}, {0, 9, 0, 0}, {4, 4, 4.003, 4}};
    for (int f = 0; f < FORMATS; f++) {
        char *text = drawing_of(&formats[f], lines, 5, 3);
        assert_true(look_at(formats[f].read, text, -1).account.largest_move == 0);
        free(text);
    }
}

/// An office whose every coordinate is off by up to a unit has the rooms that it had.
static void test_jittered(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map office = {0};
    assert_ok(context,
              sl_map_read(context, SIGHTLINE_SOURCE_DIR "/maps/office.map", NULL, &office));
    const size_t count = office.wall_count;
    double(*lines)[4] = calloc(count, sizeof *lines);
    assert_non_null(lines);
    sl_map copy = {0};
    assert_ok(context, sl_map_copy(context, &office, &copy));
    const outcome expected = look(context, &copy, -1);
    const uint64_t seeds = testing_seeds(8);
    for (uint64_t seed = 0; seed < seeds; seed++) {
        sl_random random = {seed};
        for (size_t i = 0; i < count; i++) {
            const sl_wall *wall = &office.walls[i];
            const double at[4] = {wall->a.x, wall->a.y, wall->b.x, wall->b.y};
            for (int k = 0; k < 4; k++)
                lines[i][k] = at[k] + 1e-6 * (2 * sl_random_unit(&random) - 1);
        }
        for (int f = 0; f < FORMATS; f++) {
            char *text = drawing_of(&formats[f], (const double(*)[4])lines, count, 6);
            const outcome out = look_at(formats[f].read, text, -1);
            assert_int_equal(out.parts, expected.parts);
            assert_int_equal(out.closed, expected.closed);
            assert_true(fabs(out.area - expected.area) < 1e-3);
            assert_true(out.account.largest_move < 5e-6);
            free(text);
        }
    }
    free(lines);
    sl_map_destroy(context, &office);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_corners),   cmocka_unit_test(test_junctions),
        cmocka_unit_test(test_slits),     cmocka_unit_test(test_axial),
        cmocka_unit_test(test_precision), cmocka_unit_test(test_short_walls),
        cmocka_unit_test(test_jittered),  cmocka_unit_test(test_tiny),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
