/// Charts: axes and their numbers, labels that keep apart, and the files.
#include "sightline/draw.h"

#include "test_draw_map.h"

#include "draw/chart.h"
#include "sightline/support.h"

#include <cairo.h>
#include <math.h>
#include <unistd.h>

#define MICRO "\xc2\xb5"

// --- axes

static sli_axis axis_of(const sl_chart_axis *what, double least, double most) {
    sli_axis axis = sli_axis_fit(what, least, most);
    axis.from = 100;
    axis.to = 600;
    return axis;
}

static void values_stand_in_order_within_the_frame(void **state) {
    (void)state;
    static const double values[] = {-1e300, -2e9, -50, -1, -0.5, 0,
                                    1e-300, 0.75, 1,   3,  1e12, 1e300};
    enum { COUNT = sizeof values / sizeof *values };
    for (int scale = SL_CHART_LINEAR; scale <= SL_CHART_SYMLOG; scale++) {
        const sl_chart_axis what = {.scale = (sl_chart_scale)scale};
        const int start = scale == SL_CHART_LOG ? 6 : 0;
        for (int first = start; first < COUNT; first++)
            for (int last = first; last < COUNT; last++) {
                const sli_axis axis = axis_of(&what, values[first], values[last]);
                double before = 100;
                for (int i = first; i <= last; i++) {
                    const double place = sli_axis_place(&axis, values[i]);
                    // Both ends stay free; far apart, neighbours may fall together.
                    assert_true(place > 110 && place < 590);
                    assert_true(place >= before);
                    before = place;
                }
                const bool tiny = scale == SL_CHART_SYMLOG && fabs(values[last]) < 0.1;
                if (last > first && !tiny)
                    assert_true(before - sli_axis_place(&axis, values[first]) > 1e-3);
            }
    }
}

static void a_balanced_axis_has_zero_in_the_middle(void **state) {
    (void)state;
    for (int scale = SL_CHART_LINEAR; scale <= SL_CHART_SYMLOG; scale += 2) {
        const sl_chart_axis what = {.scale = (sl_chart_scale)scale, .over = "o", .under = "u"};
        static const double ends[][2] = {{0, 0}, {0, 40}, {-7, 3}, {-1e6, -5}};
        for (int i = 0; i < 4; i++) {
            const sli_axis axis = axis_of(&what, ends[i][0], ends[i][1]);
            assert_true(sli_axis_place(&axis, 0) == 350);
            assert_true(fabs(sli_axis_place(&axis, 3) + sli_axis_place(&axis, -3) - 700) < 1e-9);
        }
    }
}

/// The texts of the ticks, with blanks between.
static void write_ticks(const sl_chart_axis *what, double least, double most, char *text,
                        size_t room) {
    sli_tick ticks[SLI_TICKS_MOST];
    const sli_axis axis = axis_of(what, least, most);
    const size_t count = sli_axis_ticks(&axis, ticks);
    assert_true(count >= (what->scale == SL_CHART_SYMLOG ? 1 : 2) && count <= SLI_TICKS_MOST);
    text[0] = '\0';
    for (size_t i = 0; i < count; i++) {
        const double place = sli_axis_place(&axis, ticks[i].value);
        assert_true(place >= 100 && place <= 600);
        if (i) assert_true(ticks[i].value > ticks[i - 1].value);
        assert_int_equal(ticks[i].minor, ticks[i].text[0] == '\0');
        const size_t used = strlen(text);
        if (!ticks[i].minor)
            snprintf(text + used, room - used, "%s%s", used ? "|" : "", ticks[i].text);
    }
}

static void numbers_at_axes_read_well(void **state) {
    (void)state;
    static const struct {
        sl_chart_axis what;
        double least, most;
        const char *text;
    } cases[] = {
        {{.scale = SL_CHART_LOG, .seconds = true},
         2e-7,
         3,
         "100 ns|1 " MICRO "s|10 " MICRO "s|100 " MICRO "s|1 ms|10 ms|100 ms|1 s"},
        {{.scale = SL_CHART_LOG, .seconds = true}, 3e-4, 2e-3, "500 " MICRO "s|1 ms|2 ms"},
        {{.scale = SL_CHART_LOG, .seconds = true}, 25, 250, "50 s|100 s|200 s"},
        {{.scale = SL_CHART_LOG, .seconds = true}, 4e-10, 5e-9, "0.5 ns|1 ns|2 ns|5 ns"},
        {{.scale = SL_CHART_LOG}, 1e-30, 1e30, "1e-28|1e-21|1e-14|1e-7|1|1e7|1e14|1e21|1e28"},
        {{.scale = SL_CHART_SYMLOG, .over = "o", .under = "u", .zero = "exact"},
         -3,
         60,
         "100|50|20|10|5|2|1|exact|1|2|5|10|20|50|100"},
        {{.scale = SL_CHART_SYMLOG, .over = "o", .under = "u", .zero = "exact"},
         0,
         0,
         "10|5|2|1|exact|1|2|5|10"},
        {{.scale = SL_CHART_SYMLOG},
         -200,
         30000,
         "-100|-10|-1|0|1|10|100|1\xe2\x80\x89"
         "000|10\xe2\x80\x89"
         "000"},
        {{.scale = SL_CHART_LINEAR}, 0, 1, "0|0.2|0.4|0.6|0.8|1"},
        {{.scale = SL_CHART_LINEAR},
         -1500,
         2000,
         "-1\xe2\x80\x89"
         "000|0|1\xe2\x80\x89"
         "000|2\xe2\x80\x89"
         "000"},
        {{.scale = SL_CHART_LINEAR, .seconds = true}, 0, 0.03, "0|10 ms|20 ms|30 ms"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        write_ticks(&cases[i].what, cases[i].least, cases[i].most, text, sizeof text);
        assert_string_equal(text, cases[i].text);
    }
}

static void any_range_has_numbers(void **state) {
    (void)state;
    static const double magnitudes[] = {1e-300, 3e-8, 0.7, 1, 42, 6e5, 1e17, 1e300};
    for (int scale = SL_CHART_LINEAR; scale <= SL_CHART_SYMLOG; scale++)
        for (int i = 0; i < 8; i++)
            for (int k = i; k < 8; k++)
                for (int seconds = 0; seconds < 2; seconds++) {
                    const sl_chart_axis what = {.scale = (sl_chart_scale)scale, .seconds = seconds};
                    char text[SLI_TICKS_MOST * SL_COUNT_TEXT];
                    if (scale == SL_CHART_SYMLOG && magnitudes[k] < 1) continue; // only 0 is there
                    write_ticks(&what, magnitudes[i], magnitudes[k], text, sizeof text);
                    if (scale == SL_CHART_LOG) continue;
                    write_ticks(&what, -magnitudes[k], magnitudes[i], text, sizeof text);
                }
}

// --- labels

static const sl_box frame = {{0, 0}, {1000, 500}};

static bool apart(sl_box a, sl_box b) {
    return a.max.x <= b.min.x || b.max.x <= a.min.x || a.max.y <= b.min.y || b.max.y <= a.min.y;
}

/// By points along the line: another way than the library's.
static bool line_keeps_off(const sli_label *label, sl_box box) {
    for (int i = 0; i <= 400; i++) {
        const double t = i / 400.0;
        const double x = label->anchor.x + t * (label->knee.x - label->anchor.x);
        const double y = label->anchor.y + t * (label->knee.y - label->anchor.y);
        if (x > box.min.x && x < box.max.x && y > box.min.y && y < box.max.y) return false;
    }
    return true;
}

static void check_labels(const sli_label *labels, size_t count, const sli_label_room *room) {
    for (size_t i = 0; i < count; i++) {
        const sli_label *label = &labels[i];
        if (!label->placed) continue;
        const sl_box b = label->box, f = room->frame;
        assert_true(fabs(b.max.x - b.min.x - label->width) < 1e-9);
        assert_true(fabs(b.max.y - b.min.y - label->height) < 1e-9);
        assert_true(b.min.x >= f.min.x && b.max.x <= f.max.x && b.min.y >= f.min.y &&
                    b.max.y <= f.max.y);
        for (size_t k = 0; k < count; k++)
            if (k != i && labels[k].placed) {
                assert_true(apart(b, labels[k].box));
                assert_true(line_keeps_off(label, labels[k].box));
            }
        for (size_t k = 0; k < room->obstacle_count; k++)
            assert_true(apart(b, room->obstacles[k].box));
    }
}

enum { LABELS = 24 };

static int compare_anchors(const void *left, const void *right) {
    const double a = ((const sli_label *)left)->anchor.x, b = ((const sli_label *)right)->anchor.x;
    return (a > b) - (a < b);
}

/// Marks here and there, also in heaps; all within what a frame has room for.
static void labels_keep_apart(void **state) {
    (void)state;
    sl_random random = {5};
    for (int round = 0; round < 60; round++) {
        sli_label labels[LABELS] = {0};
        sli_obstacle obstacles[LABELS + 1];
        const size_t count = 1 + sl_random_below(&random, LABELS);
        const double spread = round % 3 == 0 ? 1 : round % 3 == 1 ? 0.1 : 0;
        for (size_t i = 0; i < count; i++) {
            labels[i].width = 40 + 60 * sl_random_unit(&random);
            labels[i].height = 20;
            labels[i].anchor =
                (sl_point){500 + 900 * spread * (sl_random_unit(&random) - 0.5),
                           round % 2 ? 250 : 250 + 400 * spread * (sl_random_unit(&random) - 0.5)};
        }
        qsort(labels, count, sizeof *labels, compare_anchors);
        for (size_t i = 0; i < count; i++) {
            const sl_point at = labels[i].anchor;
            obstacles[i] = (sli_obstacle){{{at.x - 6, at.y - 6}, {at.x + 6, at.y + 6}}, i, false};
        }
        obstacles[count] = (sli_obstacle){{{0, 249}, {1000, 251}}, SIZE_MAX, true};
        const sli_label_room room = {.frame = frame,
                                     .obstacles = obstacles,
                                     .obstacle_count = count + 1,
                                     .gap = 3,
                                     .clearance = 10};
        const bool all = sli_labels_place(labels, count, &room);
        size_t placed = 0;
        for (size_t i = 0; i < count; i++) placed += labels[i].placed;
        assert_int_equal(all, placed == count);
        check_labels(labels, count, &room);
        if (spread > 0.5 || count <= 8) assert_true(all);
    }
}

static void a_lone_label_stands_by_its_mark(void **state) {
    (void)state;
    static const sl_point anchors[] = {{500, 250}, {3, 250}, {997, 250}, {500, 3}, {997, 497}};
    for (int i = 0; i < 5; i++) {
        sli_label label = {.anchor = anchors[i], .width = 120, .height = 30};
        const sli_label_room room = {.frame = frame, .gap = 3, .clearance = 10};
        assert_true(sli_labels_place(&label, 1, &room));
        assert_true(hypot(label.knee.x - label.anchor.x, label.knee.y - label.anchor.y) < 40);
    }
}

static void without_room_labels_are_left_out(void **state) {
    (void)state;
    sli_label labels[LABELS];
    const sli_label_room room = {.frame = {{0, 0}, {150, 60}}, .gap = 3, .clearance = 10};
    for (int i = 0; i < LABELS; i++)
        labels[i] = (sli_label){.anchor = {75, 30}, .width = 60, .height = 15};
    labels[3].width = 200; // wider than all there is
    assert_false(sli_labels_place(labels, LABELS, &room));
    assert_true(labels[0].placed);
    assert_false(labels[3].placed);
    check_labels(labels, LABELS, &room);
}

// --- files

static int set_up(void **state) {
    draw_bench *b = draw_bench_make();
    if (!b) return -1;
    *state = b;
    return 0;
}

static const sl_chart_mark exact[] = {
    {.x = 4e-4, .label = "dfs with funnel", .note = "400 " MICRO "s"},
    {.x = 0.05, .label = "dfs with hybrid", .note = "50 ms", .x_whisker = {0.04, 0.07}},
    {.x = 0.3},
};
static const sl_chart_mark rounded[] = {
    {.x = 0.04, .y = 12, .label = "dfs with glpk", .y_band = {0, 30}, .y_whisker = {-4, 12}},
};
static const sl_chart_mark over[] = {{.x = 2e-5, .y = 400}, {.x = 1e-4, .y = 90}, {.x = 4e-4}};
static const sl_chart_mark under[] = {{.x = 5e-5, .y = -25}, {.x = 4e-4}};
static const sl_chart_series all_series[] = {
    {"exact", SL_CHART_MARKS, 0, exact, 3},
    {"rounded", SL_CHART_MARKS, 1, rounded, 1},
    {"a line", SL_CHART_LINE, 2, exact, 3},
    {"frontier", SL_CHART_FRONTIER_OVER, 0, over, 3},
    {"frontier", SL_CHART_FRONTIER_UNDER, 0, under, 2},
};

static sl_chart everything(void) {
    return (sl_chart){
        .title = "What \"r\xc3\xa8gles\" cost & <1>",
        .subtitle = "a subtitle",
        .notes = "first\nsecond",
        .band = "doubt",
        .x = {.label = "time", .scale = SL_CHART_LOG, .seconds = true},
        .y = {.label = "pairs",
              .scale = SL_CHART_SYMLOG,
              .zero = "exact",
              .over = "too many",
              .under = "too few"},
        .series = all_series,
        .series_count = 5,
        .width = 800,
    };
}

static const char *const kinds[] = {"a.png", "a.svg", "a.pdf"};
static const char *const magics[] = {"\x89PNG\r\n\x1a\n", "<?xml", "%PDF-"};

static void the_same_chart_gives_the_same_bytes(void **state) {
    draw_bench *b = *state;
    const sl_chart chart = everything();
    for (int i = 0; i < 3; i++) {
        const char *path = draw_path(b, kinds[i]);
        sl_bytes files[2];
        for (int k = 0; k < 2; k++) {
            assert_ok(b->context, sl_draw_chart_file(b->context, &chart, path));
            assert_ok(b->context, sl_file_read(b->context, path, &files[k]));
            cairo_surface_destroy(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
        }
        assert_true(files[0].size > 1000);
        assert_memory_equal(files[0].data, magics[i], strlen(magics[i]));
        assert_int_equal(files[0].size, files[1].size);
        assert_memory_equal(files[0].data, files[1].data, files[0].size);
        sl_free(b->context, files[0].data);
        sl_free(b->context, files[1].data);
        unlink(path);
    }
}

static cairo_surface_t *picture_of(draw_bench *b, const sl_chart *chart) {
    const char *path = draw_path(b, "a.png");
    assert_ok(b->context, sl_draw_chart_file(b->context, chart, path));
    cairo_surface_t *surface = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    unlink(path);
    return surface;
}

/// How many pixels of a picture have a colour, and their rows.
typedef struct found {
    long count;
    int first, last;
} found;

static found find_colour(cairo_surface_t *picture, uint32_t colour) {
    found f = {.first = INT32_MAX, .last = -1};
    const int stride = cairo_image_surface_get_stride(picture);
    for (int y = 0; y < cairo_image_surface_get_height(picture); y++) {
        const unsigned char *row =
            cairo_image_surface_get_data(picture) + (size_t)y * (size_t)stride;
        for (int x = 0; x < cairo_image_surface_get_width(picture); x++) {
            uint32_t pixel;
            memcpy(&pixel, row + 4 * x, 4);
            if ((pixel & 0xffffff) != colour) continue;
            f.count++;
            if (y < f.first) f.first = y;
            f.last = y;
        }
    }
    return f;
}

#define GREEN     0x00845f // series of colour 0
#define VERMILION 0xc45200 // of colour 1
#define SHADE     0xf0ece3 // what a frontier leaves out of reach

static void marks_have_their_colours(void **state) {
    draw_bench *b = *state;
    sl_chart chart = everything();
    for (size_t shown = 0; shown <= 2; shown++) {
        chart.series_count = shown;
        cairo_surface_t *picture = picture_of(b, &chart);
        assert_int_equal(find_colour(picture, GREEN).count > 100, shown >= 1);
        assert_int_equal(find_colour(picture, VERMILION).count > 50, shown >= 2);
        cairo_surface_destroy(picture);
    }
}

/// A band over the page: what the key shows, and nothing else, as bands lie in the frame.
static uint32_t band_on_page(sl_colour band) {
    uint32_t pixel;
    cairo_surface_t *dot = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1);
    cairo_t *cairo = cairo_create(dot);
    sl_set_colour(cairo, sl_palette_make(false).page);
    cairo_paint(cairo);
    cairo_set_source_rgba(cairo, band.red, band.green, band.blue, 0.3);
    cairo_paint(cairo);
    cairo_destroy(cairo);
    cairo_surface_flush(dot);
    memcpy(&pixel, cairo_image_surface_get_data(dot), sizeof pixel);
    cairo_surface_destroy(dot);
    return pixel & 0xffffff;
}

static void the_key_has_the_colour_of_the_bands(void **state) {
    draw_bench *b = *state;
    const sl_palette palette = sl_palette_make(false);
    const sl_colour colours[] = {palette.portal, palette.start};
    for (unsigned colour = 0; colour < 2; colour++) {
        sl_chart chart = everything();
        const sl_chart_series series = {"rounded", SL_CHART_MARKS, colour, rounded, 1};
        chart.series = &series;
        chart.series_count = 1;
        cairo_surface_t *picture = picture_of(b, &chart);
        assert_true(find_colour(picture, band_on_page(colours[colour])).count > 50);
        cairo_surface_destroy(picture);
    }
}

/// On its own side of 0 only, and all of what is left of the first mark.
static void a_frontier_shades_what_is_out_of_reach(void **state) {
    draw_bench *b = *state;
    sl_chart chart = everything();
    found sides[2];
    for (int i = 0; i < 2; i++) {
        chart.series_count = 1;
        chart.series = &all_series[3 + i];
        sl_chart_series nameless = all_series[3 + i];
        nameless.name = NULL; // the key has the shade too
        chart.series = &nameless;
        cairo_surface_t *picture = picture_of(b, &chart);
        sides[i] = find_colour(picture, SHADE);
        assert_true(sides[i].count > 5000);
        cairo_surface_destroy(picture);
    }
    assert_true(sides[0].last < sides[1].first);
    assert_true(sides[0].last - sides[0].first > 100);
    assert_true(sides[1].last - sides[1].first > 100);
    chart.series = all_series;
    chart.series_count = 3;
    cairo_surface_t *picture = picture_of(b, &chart);
    assert_int_equal(find_colour(picture, SHADE).count, 0);
    cairo_surface_destroy(picture);
}

static void the_frame_grows_with_the_labels(void **state) {
    draw_bench *b = *state;
    enum { MANY = 30 };
    sl_chart_mark marks[MANY];
    sl_chart_series series = {"many", SL_CHART_MARKS, 4, marks, 1};
    sl_chart chart = everything();
    chart.series = &series;
    chart.series_count = 1;
    for (int i = 0; i < MANY; i++)
        marks[i] = (sl_chart_mark){
            .x = 1 + 0.01 * i, .label = "a label of some length", .note = "and its note"};
    int heights[2];
    for (int i = 0; i < 2; i++) {
        series.mark_count = i ? MANY : 1;
        cairo_surface_t *picture = picture_of(b, &chart);
        heights[i] = cairo_image_surface_get_height(picture);
        cairo_surface_destroy(picture);
    }
    assert_true(heights[1] > heights[0]);
    assert_true(heights[1] < 2 * 800);
}

static void extremes_are_drawn(void **state) {
    draw_bench *b = *state;
    const sl_chart_mark far[] = {{.x = 1e-300, .y = -1e300, .label = ""},
                                 {.x = 1e300, .y = 1e300, .label = "far", .note = ""}};
    sl_chart_series series = {NULL, SL_CHART_MARKS, 5, far, 2};
    const double widths[] = {SL_DRAW_WIDTH_MIN, 400, SL_DRAW_WIDTH_MAX};
    for (int i = 0; i < 3; i++) {
        sl_chart chart = everything();
        chart.width = widths[i];
        chart.dark = i == 1;
        assert_ok(b->context, sl_draw_chart_file(b->context, &chart, draw_path(b, "a.svg")));
        chart.series = &series;
        chart.series_count = 1;
        for (int scale = SL_CHART_LINEAR; scale <= SL_CHART_SYMLOG; scale++) {
            chart.x.scale = (sl_chart_scale)scale;
            assert_ok(b->context, sl_draw_chart_file(b->context, &chart, draw_path(b, "a.svg")));
        }
        const sl_chart empty = {.width = widths[i]};
        assert_ok(b->context, sl_draw_chart_file(b->context, &empty, draw_path(b, "a.svg")));
        chart.series_count = 0;
        assert_ok(b->context, sl_draw_chart_file(b->context, &chart, draw_path(b, "a.svg")));
        unlink(b->path);
    }
}

/// Texts of any length and at any character's end, where the room ends too.
static void long_texts_are_cut_between_characters(void **state) {
    draw_bench *b = *state;
    static char text[3000];
    for (int shift = 0; shift < 2; shift++) {
        memset(text, 'x', sizeof text);
        for (size_t i = (size_t)shift; i + 2 < sizeof text; i += 2) memcpy(text + i, "\xc3\xa8", 2);
        text[sizeof text - 2 + shift] = '\0'; // behind a whole character
        const sl_chart_mark mark = {.x = 1, .label = text, .note = text};
        const sl_chart_series series = {text, SL_CHART_MARKS, 0, &mark, 1};
        const sl_chart chart = {.title = text,
                                .subtitle = text,
                                .notes = text,
                                .band = text,
                                .x = {.label = text, .scale = SL_CHART_LOG},
                                .y = {.label = text, .zero = text, .over = text, .under = text},
                                .series = &series,
                                .series_count = 1,
                                .width = 500};
        assert_ok(b->context, sl_draw_chart_file(b->context, &chart, draw_path(b, "a.svg")));
        unlink(b->path);
    }
}

static void expect_refusal(draw_bench *b, const sl_chart *chart, const char *name,
                           const char *message) {
    assert_int_equal(sl_draw_chart_file(b->context, chart, draw_path(b, name)), SL_BAD_ARGUMENT);
    if (!strstr(sl_context_message(b->context), message))
        fail_msg("\"%s\" is not in: %s", message, sl_context_message(b->context));
}

static void what_makes_no_sense_is_refused(void **state) {
    draw_bench *b = *state;
    const sl_chart good = everything();
    expect_refusal(b, &good, "a.gif", ".png, .svg or .pdf");
    sl_chart bad = good;
    bad.width = NAN;
    expect_refusal(b, &bad, "a.png", "width");
    bad.width = SL_DRAW_WIDTH_MAX + 1;
    expect_refusal(b, &bad, "a.png", "width");
    static const sl_chart_mark wrong[] = {
        {.x = NAN},
        {.x = INFINITY},
        {.x = 1, .y = -INFINITY},
        {.x = 1, .y = 2e300},
        {.x = 0},
        {.x = -1},
        {.x = 1, .x_whisker = {0, 1}},
        {.x = 1, .y_whisker = {0, NAN}},
        {.x = 1, .y_band = {-INFINITY, 0}},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const sl_chart_series series = {NULL, SL_CHART_FRONTIER_OVER, 0, &wrong[i], 1};
        bad = good;
        bad.series = &series;
        bad.series_count = 1;
        expect_refusal(b, &bad, "a.svg", "a chart's value is");
    }
    sl_chart_series series = all_series[0];
    series.colour = SL_CHART_COLOURS;
    bad.series = &series;
    expect_refusal(b, &bad, "a.svg", "colour 6");
    bad = good;
    bad.title = "\xff\xfe";
    for (int i = 0; i < 3; i++) expect_refusal(b, &bad, kinds[i], "UTF-8");
}

static void every_failing_allocation_is_reported(void **state) {
    draw_bench *b = *state;
    const sl_chart chart = everything();
    for (int i = 0; i < 3; i++) {
        const char *path = draw_path(b, kinds[i]);
        sl_status status = SL_NO_MEMORY;
        for (long fail_at = 1; status != SL_OK; fail_at++) {
            testing_memory memory = {0};
            sl_context *context = testing_context(&memory);
            memory.fail_at = memory.calls + fail_at;
            status = sl_draw_chart_file(context, &chart, path);
            if (status != SL_OK) {
                assert_int_equal(status, SL_NO_MEMORY);
                assert_int_equal(access(path, F_OK), -1);
            }
            assert_int_equal(memory.live, 1); // the context
            sl_context_destroy(context);
            assert_true(fail_at < 1000);
        }
        unlink(path);
    }
}

static void a_failure_leaves_nothing(void **state) {
    draw_bench *b = *state;
    const sl_chart chart = everything();
    const sl_hooks hooks = {.cancelled = testing_cancelled};
    sl_context *context = sl_context_create(&hooks);
    for (int i = 0; i < 3; i++) {
        char name[32];
        snprintf(name, sizeof name, "none/%s", kinds[i]);
        assert_int_equal(sl_draw_chart_file(b->context, &chart, draw_path(b, name)), SL_IO);
        assert_int_equal(sl_draw_chart_file(context, &chart, draw_path(b, kinds[i])), SL_CANCELLED);
    }
    sl_context_destroy(context);
}

#define WITH_BENCH(test) cmocka_unit_test_setup_teardown(test, set_up, draw_bench_end)

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_stand_in_order_within_the_frame),
        cmocka_unit_test(a_balanced_axis_has_zero_in_the_middle),
        cmocka_unit_test(numbers_at_axes_read_well),
        cmocka_unit_test(any_range_has_numbers),
        cmocka_unit_test(labels_keep_apart),
        cmocka_unit_test(a_lone_label_stands_by_its_mark),
        cmocka_unit_test(without_room_labels_are_left_out),
        WITH_BENCH(the_same_chart_gives_the_same_bytes),
        WITH_BENCH(marks_have_their_colours),
        WITH_BENCH(the_key_has_the_colour_of_the_bands),
        WITH_BENCH(a_frontier_shades_what_is_out_of_reach),
        WITH_BENCH(the_frame_grows_with_the_labels),
        WITH_BENCH(extremes_are_drawn),
        WITH_BENCH(long_texts_are_cut_between_characters),
        WITH_BENCH(what_makes_no_sense_is_refused),
        WITH_BENCH(every_failing_allocation_is_reported),
        WITH_BENCH(a_failure_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
