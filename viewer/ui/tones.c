/// What colours mean in the plan.
///
/// One layer fills the plan, the others are lines over it: two fills on each other would give a
/// third colour that no legend names. Within a layer two meanings differ by more than their hue:
/// one of them at most is solid, the others are dots, stripes or a grid. So they are told apart
/// without colour too. Each tone has a contrast of 3:1 at least to every ground that it can lie on,
/// as WCAG 2.1 asks of graphics (1.4.11), also for eyes without red or green cones. A line has a
/// rim in the page's colour, so it stands out from any fill. tests/viewer/test_tones.c checks this.
///
/// A pattern is a small tile that cairo repeats. It costs about what a plain fill costs.
#include "ui/tones.h"

#include <math.h>

static const tone_row rows[TONES] = {
    [TONE_KEPT] = {"kept", GROUP_CULLING, PATTERN_SOLID, 0x3a80c4, 0x4d8cbf, 3},
    [TONE_LOOSER] = {"kept by looser methods", GROUP_CULLING, PATTERN_DOTS, 0x3576b5, 0x7fb8ea, 3},
    [TONE_LOOSER + 1] = {"", GROUP_CULLING, PATTERN_RISING, 0x3576b5, 0x7fb8ea, 3},
    [TONE_LOOSER + 2] = {"", GROUP_CULLING, PATTERN_FALLING, 0x3576b5, 0x7fb8ea, 3},
    [TONE_LOOSER + 3] = {"", GROUP_CULLING, PATTERN_CROSS, 0x3576b5, 0x7fb8ea, 3},
    [TONE_ADDED] = {"added by the looser method", GROUP_CULLING, PATTERN_CROSS, 0xb35900, 0xffa95c,
                    3},
    [TONE_KEPT_MIRRORED] = {"kept, by mirror alone", GROUP_CULLING, PATTERN_LEVEL, 0xb0508a,
                            0xe58fc0, 3},
    [TONE_SET] = {"seen from the eye's cell", GROUP_SET, PATTERN_SOLID, 0x1f8378, 0x339688, 6},
    [TONE_SET_MIRRORED] = {"seen from it by mirror", GROUP_SET, PATTERN_LEVEL, 0xb0508a, 0xe58fc0,
                           6},
    [TONE_REGION] = {"visible region", GROUP_REGION, PATTERN_SOLID, 0xb86a00, 0xb7821a, 0},
    [TONE_REGION_MIRRORED] = {"visible in mirrors", GROUP_REGION, PATTERN_LEVEL, 0xb0508a, 0xe58fc0,
                              0},
    [TONE_NODE_OUT] = {"outside the view cone", GROUP_NODES, PATTERN_DOTS, 0x3f7f40, 0x7fbf80, 2},
    [TONE_NODE_INVISIBLE] = {"invisible", GROUP_NODES, PATTERN_CROSS, 0x21407f, 0x8fa8e8, 2},
    [TONE_NODE_PROPAGATED] = {"invisible by propagation", GROUP_NODES, PATTERN_RISING, 0x2d78ac,
                              0x6cc0ee, 2},
    [TONE_NODE_VISIBLE] = {"visible", GROUP_NODES, PATTERN_SOLID, 0x9e7500, 0x9e872d, 2},
    [TONE_NODE_PARTIAL] = {"partially visible", GROUP_NODES, PATTERN_LEVEL, 0x8a6600, 0xe0c040, 2},
    [TONE_WATCH_SEES] = {"the eye's cell sees them", GROUP_WATCH, PATTERN_RISING, 0x0072b2,
                         0x6cc0ee, 4},
    [TONE_WATCH_MUTUAL] = {"both see each other", GROUP_WATCH, PATTERN_SOLID, 0x00825c, 0x2c9777,
                           4},
    [TONE_WATCH_SEEN] = {"they see the eye's cell", GROUP_WATCH, PATTERN_FALLING, 0xa8487d,
                         0xe58fc0, 4},
    [TONE_FROM] = {"from", GROUP_PAIR, PATTERN_SOLID, 0xb86a00, 0xb7821a, 0},
    [TONE_TO] = {"to", GROUP_PAIR, PATTERN_CROSS, 0xa8487d, 0xe58fc0, 0},
};

const tone_row *tone_table(void) {
    return rows;
}

sl_colour tone_colour(bool dark, tone which) {
    const unsigned hex = dark ? rows[which].dark : rows[which].light;
    return (sl_colour){(hex >> 16 & 255) / 255.0, (hex >> 8 & 255) / 255.0, (hex & 255) / 255.0};
}

// --- patterns

/// One tile. Lines reach over its sides, so that tiles join.
static void draw_tile(cairo_t *cairo, tone_pattern pattern, double n) {
    cairo_set_line_width(cairo, 0.22 * n);
    if (pattern == PATTERN_DOTS) {
        cairo_arc(cairo, 0.25 * n, 0.25 * n, 0.15 * n, 0, 6.283185307179586);
        cairo_new_sub_path(cairo);
        cairo_arc(cairo, 0.75 * n, 0.75 * n, 0.15 * n, 0, 6.283185307179586);
        cairo_fill(cairo);
        return;
    }
    for (int i = -1; i <= 1; i++) {
        if (pattern == PATTERN_RISING || pattern == PATTERN_CROSS) {
            cairo_move_to(cairo, (i - 0.5) * n, 1.5 * n);
            cairo_line_to(cairo, (i + 1.5) * n, -0.5 * n);
        }
        if (pattern == PATTERN_FALLING || pattern == PATTERN_CROSS) {
            cairo_move_to(cairo, (i - 0.5) * n, -0.5 * n);
            cairo_line_to(cairo, (i + 1.5) * n, 1.5 * n);
        }
    }
    if (pattern == PATTERN_LEVEL) {
        cairo_move_to(cairo, -n, 0.5 * n);
        cairo_line_to(cairo, 2 * n, 0.5 * n);
    }
    cairo_stroke(cairo);
}

/// Whole pixels, so that each tile looks like the one before.
static cairo_pattern_t *make_pattern(cairo_t *cairo, tone_pattern pattern, sl_colour colour,
                                     double unit, sl_point origin) {
    const int n = (int)fmax(round(8 * unit), 4);
    // Pixels for SVG too: cairo 1.16 leaks a part of each surface that is similar to an SVG one.
    cairo_surface_t *target = cairo_get_target(cairo);
    cairo_surface_t *tile =
        cairo_surface_get_type(target) == CAIRO_SURFACE_TYPE_SVG
            ? cairo_image_surface_create(CAIRO_FORMAT_ARGB32, n, n)
            : cairo_surface_create_similar(target, CAIRO_CONTENT_COLOR_ALPHA, n, n);
    cairo_t *c = cairo_create(tile);
    cairo_set_source_rgba(c, colour.red, colour.green, colour.blue, 0.16);
    cairo_paint(c);
    sl_set_colour(c, colour);
    draw_tile(c, pattern, n);
    cairo_destroy(c);
    cairo_pattern_t *made = cairo_pattern_create_for_surface(tile);
    cairo_surface_destroy(tile);
    cairo_matrix_t shift;
    cairo_matrix_init_translate(&shift, -round(fmod(origin.x, n)), -round(fmod(origin.y, n)));
    cairo_pattern_set_matrix(made, &shift);
    cairo_pattern_set_extend(made, CAIRO_EXTEND_REPEAT);
    cairo_pattern_set_filter(made, CAIRO_FILTER_NEAREST);
    return made;
}

void tone_fill(cairo_t *cairo, bool dark, tone which, double unit, sl_point origin) {
    const sl_colour colour = tone_colour(dark, which);
    if (rows[which].pattern == PATTERN_SOLID) {
        sl_set_colour(cairo, colour);
        cairo_fill(cairo);
        return;
    }
    cairo_pattern_t *pattern = make_pattern(cairo, rows[which].pattern, colour, unit, origin);
    cairo_set_source(cairo, pattern);
    cairo_fill(cairo);
    cairo_pattern_destroy(pattern);
}

// --- lines

void tone_cased(cairo_t *cairo, const sl_palette *palette, sl_colour colour, double width,
                double dash) {
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    sl_set_colour(cairo, palette->page);
    cairo_set_line_width(cairo, fmin(2.2 * width, 1.6 * width + 2));
    cairo_stroke_preserve(cairo);
    const double dashes[2] = {dash * width, 0.6 * dash * width};
    if (dash > 0) cairo_set_dash(cairo, dashes, 2, 0);
    sl_set_colour(cairo, colour);
    cairo_set_line_width(cairo, width);
    cairo_stroke(cairo);
    cairo_set_dash(cairo, NULL, 0, 0);
}

void tone_line(cairo_t *cairo, const sl_palette *palette, tone which, double width) {
    tone_cased(cairo, palette, tone_colour(palette->dark, which), width, rows[which].dash);
}
