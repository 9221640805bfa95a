/// Sheets of paper: the scale is that of the paper, for turned plans too; what does not fit is
/// refused with what does; letters stay text; layers have names.
#include "test_draw_map.h"

#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct sheet_bench {
    draw_bench *draw;
    sl_baked plain, turned;
} sheet_bench;

/// A room of 40 x 30 with a wall in it, turned about a point far from the origin.
static void make_room(sl_context *context, double degrees, const char *unit, sl_baked *out) {
    static const double walls[][4] = {
        {0, 0, 40, 0}, {40, 0, 40, 30}, {40, 30, 0, 30}, {0, 30, 0, 0}, {20, 0, 20, 12}};
    const double angle = degrees * 3.14159265358979323846 / 180, c = cos(angle), s = sin(angle);
    sl_bake_options options = sl_bake_options_default();
    sl_bake_account account = {0};
    sl_map map = {0};
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++) {
        const double *w = walls[i];
        const sl_point a = {700 + c * w[0] - s * w[1], s * w[0] + c * w[1]};
        const sl_point b = {700 + c * w[2] - s * w[3], s * w[2] + c * w[3]};
        assert_ok(context, sl_map_add_wall(context, &map, a, b, 0));
    }
    snprintf(map.unit, sizeof map.unit, "%s", unit);
    assert_ok(context, sl_bake_space(context, &map, &options, out, &account));
    sl_map_destroy(context, &map);
}

static int set_up(void **state) {
    sheet_bench *b = calloc(1, sizeof *b);
    b->draw = draw_bench_make();
    if (!b->draw) return -1;
    b->draw->map = draw_map_make(b->draw->context, DRAW_PLAIN);
    make_room(b->draw->context, 0, "m", &b->plain);
    make_room(b->draw->context, 17.3, "m", &b->turned);
    *state = b;
    return 0;
}

static int tear_down(void **state) {
    sheet_bench *b = *state;
    sl_baked_destroy(b->draw->context, &b->plain);
    sl_baked_destroy(b->draw->context, &b->turned);
    *state = b->draw;
    free(b);
    return draw_bench_end(state);
}

static sl_draw_options sheet_options(const char *paper, const char *scale) {
    sl_draw_options options = sl_draw_options_default();
    options.title = "Room & <hall>";
    options.sheet = (sl_sheet){.paper = paper,
                               .scale = scale,
                               .note = "Gr\xc3\xb6\xc3\x9f"
                                       "e"};
    return options;
}

/// The text of a sheet; the caller frees it.
static sl_bytes draw_text(sheet_bench *b, const sl_baked *baked, const sl_draw_options *options,
                          const char *name) {
    sl_context *context = b->draw->context;
    const char *path = draw_path(b->draw, name);
    sl_bytes file;
    assert_ok(context, sl_draw_file(context, baked, options, path));
    assert_ok(context, sl_file_read(context, path, &file));
    unlink(path);
    return file;
}

/// The largest distance between two corners of the paths in a group of an SVG.
static double diameter_of(const char *svg, const char *group) {
    char begin[64];
    double x[4096], y[4096], most = 0;
    size_t count = 0;
    snprintf(begin, sizeof begin, "<g id=\"%s\"", group);
    const char *at = strstr(svg, begin);
    assert_non_null(at);
    const char *end = strstr(at, "</g>\n</g>");
    assert_non_null(end);
    for (; at < end; at++)
        if ((at[0] == 'M' || at[0] == 'L') && at[1] == ' ' && count < 4096)
            if (sscanf(at + 2, "%lf %lf", &x[count], &y[count]) == 2) count++;
    assert_true(count > 4 && count < 4096);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < i; k++) most = fmax(most, hypot(x[i] - x[k], y[i] - y[k]));
    return most;
}

/// The room's diagonal is 50 m. A point is 1/72 inch.
static void lengths_on_paper_are_to_scale(void **state) {
    sheet_bench *b = *state;
    static const struct {
        const char *paper, *scale;
        double ratio;
    } sheets[] = {{"A3", "1:200", 200}, {"a0", "1:100", 100}, {"A4", "1:333", 333}};
    for (int turned = 0; turned < 2; turned++)
        for (size_t i = 0; i < sizeof sheets / sizeof *sheets; i++) {
            const sl_draw_options options = sheet_options(sheets[i].paper, sheets[i].scale);
            sl_bytes svg = draw_text(b, turned ? &b->turned : &b->plain, &options, "a.svg");
            const double expected = 50 * 1000 / sheets[i].ratio / 25.4 * 72;
            // cairo writes six decimals, of coordinates that are whole 256ths of a point.
            assert_true(fabs(diameter_of(svg.data, "walls") - expected) < 0.01);
            assert_non_null(strstr(svg.data, sheets[i].scale));
            sl_free(b->draw->context, svg.data);
        }
}

/// Millimetres of the map are no millimetres of the paper.
static void the_unit_of_the_map_counts(void **state) {
    sheet_bench *b = *state;
    sl_baked mm = {0};
    make_room(b->draw->context, 0, "mm", &mm);
    const sl_draw_options options = sheet_options("A4", "1:1");
    sl_bytes svg = draw_text(b, &mm, &options, "a.svg");
    assert_true(fabs(diameter_of(svg.data, "walls") - 50 / 25.4 * 72) < 0.01);
    sl_free(b->draw->context, svg.data);
    sl_baked_destroy(b->draw->context, &mm);
}

static void letters_stay_text_and_layers_have_names(void **state) {
    sheet_bench *b = *state;
    const sl_draw_options options = sheet_options("A3", NULL);
    static const char *const has[] = {">Room &amp; &lt;hall></text>",
                                      (">Gr\xc3\xb6\xc3\x9f"
                                       "e</text>"),
                                      ">1:200</text>",
                                      ">on A3</text>",
                                      ">20 m</text>",
                                      "<g id=\"ground\" ",
                                      "<g id=\"portals\" ",
                                      "<g id=\"walls\" ",
                                      "<g id=\"legend\" ",
                                      "<g id=\"title-block\" ",
                                      "<g id=\"text\" ",
                                      "inkscape:label=\"walls\"",
                                      "pt\" height=\""};
    static const char *const has_not[] = {"<use ", "glyph", "<page", "surface"};
    sl_bytes svg = draw_text(b, &b->plain, &options, "a.svg");
    for (size_t i = 0; i < sizeof has / sizeof *has; i++)
        if (!strstr(svg.data, has[i])) fail_msg("%s is not there", has[i]);
    for (size_t i = 0; i < sizeof has_not / sizeof *has_not; i++)
        if (strstr(svg.data, has_not[i])) fail_msg("%s is there", has_not[i]);
    sl_free(b->draw->context, svg.data);
}

/// A PDF has one page, its layers are optional content groups, and its table says where each object
/// begins.
static void a_pdf_has_layers(void **state) {
    sheet_bench *b = *state;
    const sl_draw_options options = sheet_options("A3", NULL);
    static const char *const names[] = {"paper", "ground", "portals", "walls", "legend"};
    sl_bytes pdf = draw_text(b, &b->turned, &options, "a.pdf");
    const char *end = pdf.data + pdf.size, *last = NULL;
    size_t pages = 0, found[5] = {0};
    for (const char *at = pdf.data; at < end; at++) {
        const size_t rest = (size_t)(end - at);
        pages += rest > 12 && memcmp(at, "/Type /Page ", 12) == 0;
        if (rest > 10 && memcmp(at, "startxref\n", 10) == 0) last = at;
        for (int i = 0; i < 5; i++) {
            char group[64];
            const int length = snprintf(group, sizeof group, "/Type /OCG /Name (%s)", names[i]);
            found[i] += rest > (size_t)length && memcmp(at, group, (size_t)length) == 0;
        }
    }
    assert_int_equal(pages, 1);
    for (int i = 0; i < 5; i++) assert_int_equal(found[i], 1);
    assert_non_null(last);
    char *entry = NULL;
    const char *table = pdf.data + strtoul(last + 10, NULL, 10);
    assert_true(table > pdf.data && table < last && memcmp(table, "xref\n0 ", 7) == 0);
    const size_t count = strtoul(table + 7, &entry, 10);
    assert_true(count > 10 && entry + 1 + 20 * count < end);
    for (size_t i = 1; i < count; i++) {
        const char *object = entry + 1 + 20 * i;
        if (object[17] != 'n') continue;
        char begin[32];
        const int length = snprintf(begin, sizeof begin, "%zu 0 obj\n", i);
        assert_memory_equal(pdf.data + strtoul(object, NULL, 10), begin, (size_t)length);
    }
    sl_free(b->draw->context, pdf.data);
}

static void the_same_sheet_has_the_same_bytes(void **state) {
    sheet_bench *b = *state;
    const sl_draw_options options = sheet_options("A2", "1:200");
    for (int kind = 0; kind < 2; kind++) {
        sl_bytes files[2];
        for (int i = 0; i < 2; i++)
            files[i] = draw_text(b, &b->turned, &options, kind ? "a.pdf" : "a.svg");
        assert_int_equal(files[0].size, files[1].size);
        assert_memory_equal(files[0].data, files[1].data, files[0].size);
        for (int i = 0; i < 2; i++) sl_free(b->draw->context, files[i].data);
    }
}

static void north_is_drawn_where_it_is_known(void **state) {
    sheet_bench *b = *state;
    sl_draw_options options = sheet_options("A3", NULL);
    for (int known = 0; known < 3; known++) {
        options.sheet.north = (sl_point){known == 1 ? 3 : 0, known == 1 ? -4 : 0};
        b->plain.map.earth.known = known == 2;
        sl_bytes svg = draw_text(b, &b->plain, &options, "a.svg");
        assert_int_equal(strstr(svg.data, ">N</text>") != NULL, known > 0);
        sl_free(b->draw->context, svg.data);
    }
    b->plain.map.earth.known = false;
}

static void expect_refusal(sheet_bench *b, const sl_baked *baked, const char *paper,
                           const char *scale, const char *name, const char *message) {
    const sl_draw_options options = sheet_options(paper, scale);
    sl_context *context = b->draw->context;
    assert_int_equal(sl_draw_file(context, baked, &options, draw_path(b->draw, name)),
                     SL_BAD_ARGUMENT);
    if (!strstr(sl_context_message(context), message))
        fail_msg("\"%s\" is not in: %s", message, sl_context_message(context));
    assert_int_equal(draw_files_in(b->draw->directory), 0);
}

static void what_no_sheet_has_is_refused(void **state) {
    sheet_bench *b = *state;
    expect_refusal(b, &b->plain, "A4", "1:100", "a.pdf", "1:250 fits");
    expect_refusal(b, &b->turned, "A4", "1:100", "a.pdf", "1:250 fits");
    expect_refusal(b, &b->plain, "A3", "1:100", "a.svg", "400 mm x 300 mm at 1:100");
    expect_refusal(b, &b->plain, "A5", NULL, "a.pdf", "expected A0, A1, A2, A3 or A4");
    expect_refusal(b, &b->plain, "A3", NULL, "a.png", ".pdf or .svg");
    static const char *const scales[] = {"100", "1:0", "1:0.5", "1:-5", "1:nan", "1:", "", "2:1"};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++)
        expect_refusal(b, &b->plain, "A3", scales[i], "a.pdf", "expected 1:N");
    expect_refusal(b, &b->draw->map.baked, "A3", NULL, "a.pdf", "what its lengths are in");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_on_paper_are_to_scale),
        cmocka_unit_test(the_unit_of_the_map_counts),
        cmocka_unit_test(letters_stay_text_and_layers_have_names),
        cmocka_unit_test(a_pdf_has_layers),
        cmocka_unit_test(the_same_sheet_has_the_same_bytes),
        cmocka_unit_test(north_is_drawn_where_it_is_known),
        cmocka_unit_test(what_no_sheet_has_is_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
