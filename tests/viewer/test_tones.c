/// Contrasts of the colours of the plan, in both themes, as common eyes see them and as eyes
/// without red or without green cones do.
#include "ui/tones.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

/// Machado, Oliveira and Fernandes, "A Physiologically-based Model for Simulation of Color Vision
/// Deficiency" (2009), severity 1: matrices for linear light.
static const struct eye {
    const char *name;
    double of[3][3];
} eyes[] = {
    {"common", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {"protan",
     {{0.152286, 1.052583, -0.204868},
      {0.114503, 0.786281, 0.099216},
      {-0.003882, -0.048116, 1.051998}}},
    {"deutan",
     {{0.367322, 0.860646, -0.227968},
      {0.280085, 0.672501, 0.047413},
      {-0.011820, 0.042940, 0.968881}}},
};
enum { EYES = sizeof eyes / sizeof *eyes };

static double linear(double value) {
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

/// The relative luminance of WCAG 2.1.
static double luminance(const struct eye *eye, sl_colour colour) {
    static const double weights[3] = {0.2126, 0.7152, 0.0722};
    const double light[3] = {linear(colour.red), linear(colour.green), linear(colour.blue)};
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double seen = 0;
        for (int k = 0; k < 3; k++) seen += eye->of[i][k] * light[k];
        sum += weights[i] * fmin(fmax(seen, 0), 1);
    }
    return sum;
}

static double contrast(const struct eye *eye, sl_colour a, sl_colour b) {
    const double x = luminance(eye, a) + 0.05, y = luminance(eye, b) + 0.05;
    return fmax(x, y) / fmin(x, y);
}

/// The same whatever order, at its known ends.
static void contrasts_are_those_of_wcag(void **state) {
    (void)state;
    const sl_colour black = {0, 0, 0}, white = {1, 1, 1}, grey = {0.5, 0.5, 0.5};
    for (int i = 0; i < EYES; i++) {
        assert_true(fabs(contrast(&eyes[i], black, white) - 21) < 0.01);
        assert_true(contrast(&eyes[i], white, white) == 1);
        assert_true(contrast(&eyes[i], grey, white) == contrast(&eyes[i], white, grey));
    }
    // Red is darker without red cones; green and red come close without green ones.
    const sl_colour red = {1, 0, 0};
    assert_true(luminance(&eyes[1], red) < 0.6 * luminance(&eyes[0], red));
}

static void expect(const struct eye *eye, bool dark, const char *what, sl_colour a,
                   const char *over, sl_colour b, double least) {
    const double found = contrast(eye, a, b);
    if (found < least)
        fail_msg("%s on %s, %s theme, %s eye: %.2f, at least %g is needed", what, over,
                 dark ? "dark" : "light", eye->name, found, least);
}

/// What cells, the page and the space round the map look like.
typedef struct grounds {
    sl_colour colours[SL_TONES + 2];
} grounds;

static grounds grounds_of(const sl_palette *p) {
    grounds g;
    for (int i = 0; i < SL_TONES; i++) g.colours[i] = p->floor[i];
    g.colours[SL_TONES] = p->page;
    g.colours[SL_TONES + 1] = p->ground;
    return g;
}

static void lines_and_marks_stand_out(void **state) {
    (void)state;
    for (int dark = 0; dark < 2; dark++) {
        const sl_palette p = sl_palette_make(dark);
        const grounds g = grounds_of(&p);
        const struct {
            const char *name;
            sl_colour colour;
        } lines[] = {{"wall", p.wall},   {"portal", p.portal},     {"tree", p.tree},
                     {"start", p.start}, {"path", p.path},         {"door", p.door},
                     {"glass", p.glass}, {"object", p.object},     {"source_edge", p.source_edge},
                     {"solid", p.solid}, {"mirrored", p.mirrored}, {"ink", p.ink},
                     {"faint", p.faint}};
        for (int i = 0; i < EYES; i++)
            for (size_t k = 0; k < sizeof lines / sizeof *lines; k++)
                for (int j = 0; j < SL_TONES + 2; j++)
                    expect(&eyes[i], dark, lines[k].name, lines[k].colour, "a ground", g.colours[j],
                           3);
        expect(&eyes[0], dark, "ink", p.ink, "page", p.page, 4.5);
        expect(&eyes[0], dark, "faint", p.faint, "page", p.page, 4.5);
        expect(&eyes[0], dark, "glass", p.glass, "page", p.page, 4.5);
    }
}

static void tones_stand_out_from_the_ground(void **state) {
    (void)state;
    for (int dark = 0; dark < 2; dark++) {
        const sl_palette p = sl_palette_make(dark);
        const grounds g = grounds_of(&p);
        for (int i = 0; i < EYES; i++)
            for (int k = 0; k < TONES; k++)
                for (int j = 0; j < SL_TONES + 2; j++)
                    expect(&eyes[i], dark, tone_table()[k].label, tone_colour(dark, (tone)k),
                           "a ground", g.colours[j], 3);
    }
}

/// Side by side, two meanings of a layer differ by their patterns, not by their hues alone.
static void tones_of_a_group_differ_by_pattern(void **state) {
    (void)state;
    const tone_row *rows = tone_table();
    for (int a = 0; a < TONES; a++)
        for (int b = 0; b < a; b++) {
            if (rows[a].group != rows[b].group || rows[a].pattern != rows[b].pattern) continue;
            // A comparison has what is added in place of what looser methods keep.
            const bool apart = (a == TONE_ADDED && b >= TONE_LOOSER && b < TONE_ADDED);
            if (!apart) fail_msg("'%s' and '%s' have one pattern", rows[a].label, rows[b].label);
        }
    for (int a = 0; a < TONES; a++)
        assert_true((int)rows[a].group < GROUPS && (int)rows[a].pattern < PATTERNS);
}

/// A line over a fill, or over the heat map, is told by itself or by its rim.
static void expect_line(const struct eye *eye, bool dark, const sl_palette *p, const char *what,
                        sl_colour line, sl_colour fill) {
    const double rim = fmin(contrast(eye, line, p->page), contrast(eye, p->page, fill));
    if (fmax(contrast(eye, line, fill), rim) < 3)
        fail_msg("the line '%s' over a fill, %s theme, %s eye: %.2f", what, dark ? "dark" : "light",
                 eye->name, fmax(contrast(eye, line, fill), rim));
}

static void lines_stand_out_from_fills(void **state) {
    (void)state;
    for (int dark = 0; dark < 2; dark++) {
        const sl_palette p = sl_palette_make(dark);
        for (int i = 0; i < EYES; i++)
            for (int k = 0; k < TONES; k++) {
                const sl_colour line = tone_colour(dark, (tone)k);
                for (int j = 0; j < TONES; j++)
                    expect_line(&eyes[i], dark, &p, tone_table()[k].label, line,
                                tone_colour(dark, (tone)j));
            }
        for (int i = 0; i < EYES; i++)
            for (int step = 0; step <= 20; step++)
                expect_line(&eyes[i], dark, &p, "border of a view cell", p.wall,
                            sl_palette_ramp(dark, step / 20.0));
    }
}

/// Walls and the stab tree lie on fills without a rim.
static void walls_stand_out_from_solid_fills(void **state) {
    (void)state;
    for (int dark = 0; dark < 2; dark++) {
        const sl_palette p = sl_palette_make(dark);
        for (int i = 0; i < EYES; i++)
            for (int k = 0; k < TONES; k++) {
                const tone_row *row = &tone_table()[k];
                const sl_colour fill = tone_colour(dark, (tone)k);
                if (row->pattern != PATTERN_SOLID) continue;
                expect(&eyes[i], dark, "a wall", p.wall, row->label, fill, 3);
                expect(&eyes[i], dark, "the stab tree", p.tree, row->label, fill, 3);
                expect_line(&eyes[i], dark, &p, "a portal", p.portal, fill);
            }
    }
}

/// The order of the heat map holds for every eye.
static void the_heat_map_has_one_direction(void **state) {
    (void)state;
    for (int dark = 0; dark < 2; dark++)
        for (int i = 0; i < EYES; i++)
            for (int step = 1; step <= 20; step++) {
                const double before = luminance(&eyes[i], sl_palette_ramp(dark, (step - 1) / 20.0));
                const double now = luminance(&eyes[i], sl_palette_ramp(dark, step / 20.0));
                assert_true(dark ? now > before : now < before);
            }
}

/// Patterns cover enough of an area to be seen, and leave enough to be told from each other.
static void patterns_are_drawn(void **state) {
    (void)state;
    double shares[PATTERNS] = {0};
    for (int k = 0; k < TONES; k++) {
        cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 64, 64);
        cairo_t *cairo = cairo_create(surface);
        cairo_set_source_rgb(cairo, 1, 1, 1);
        cairo_paint(cairo);
        cairo_rectangle(cairo, 0, 0, 64, 64);
        tone_fill(cairo, false, (tone)k, 1, (sl_point){3, 5});
        assert_int_equal(cairo_status(cairo), CAIRO_STATUS_SUCCESS);
        cairo_destroy(cairo);
        cairo_surface_flush(surface);
        const unsigned char *data = cairo_image_surface_get_data(surface);
        const double white = 255, full = 255 * tone_colour(false, (tone)k).red;
        double sum = 0;
        for (int y = 0; y < 64; y++)
            for (int x = 0; x < 64; x++)
                sum += data[y * cairo_image_surface_get_stride(surface) + 4 * x + 2];
        shares[tone_table()[k].pattern] = (white - sum / 64 / 64) / (white - full);
        cairo_surface_destroy(surface);
    }
    assert_true(shares[PATTERN_SOLID] > 0.99);
    for (int pattern = PATTERN_DOTS; pattern < PATTERNS; pattern++)
        assert_true(shares[pattern] > 0.2 && shares[pattern] < 0.75);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contrasts_are_those_of_wcag),
        cmocka_unit_test(lines_and_marks_stand_out),
        cmocka_unit_test(tones_stand_out_from_the_ground),
        cmocka_unit_test(tones_of_a_group_differ_by_pattern),
        cmocka_unit_test(lines_stand_out_from_fills),
        cmocka_unit_test(walls_stand_out_from_solid_fills),
        cmocka_unit_test(the_heat_map_has_one_direction),
        cmocka_unit_test(patterns_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
