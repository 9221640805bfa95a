/// The hues are those of Okabe & Ito, "Color Universal Design" (2008), told apart under every
/// common colour blindness: orange, sky blue, bluish green, yellow, blue, vermilion, reddish
/// purple. Soft tones are the same hues mixed with the ground.
#include "draw/palette.h"

#include <math.h>
#include <stddef.h>

static sl_colour rgb(unsigned hex) {
    return (sl_colour){(hex >> 16 & 255) / 255.0, (hex >> 8 & 255) / 255.0, (hex & 255) / 255.0};
}

sl_colour sl_colour_mix(sl_colour a, sl_colour b, double share) {
    return (sl_colour){a.red + (b.red - a.red) * share, a.green + (b.green - a.green) * share,
                       a.blue + (b.blue - a.blue) * share};
}

enum {
    SKY = 0x56b4e9,
    GREEN = 0x009e73,
    BLUE = 0x0072b2,
    VERMILION = 0xd55e00,
    PURPLE = 0xcc79a7,
};

static sl_palette light(void) {
    return (sl_palette){
        .page = rgb(0xfbf9f4),
        .ground = rgb(0xf0ece3),
        .hatch = rgb(0xdcd5c7),
        .floor = {rgb(0xffffff), rgb(0xf8f6f1), rgb(0xf3f3ee), rgb(0xfbf8ef)},
        .source = rgb(0xf0b63f),
        .source_edge = rgb(0xb26a00),
        .doubtful = rgb(0xf3ea6b),
        .wall = rgb(0x1d222b),
        .outline = rgb(0xc9c4b8),
        .portal = rgb(GREEN),
        .tree = rgb(0x004f86),
        .start = rgb(VERMILION),
        .path = rgb(0x5b4a8a),
        .door = rgb(0xa8487d),
        .glass = rgb(BLUE),
        .object = rgb(0x7a6a53),
        .mirrored = rgb(0xb8558c),
        .ink = rgb(0x252a33),
        .faint = rgb(0x70757d),
    };
}

static sl_palette dark(void) {
    return (sl_palette){
        .page = rgb(0x12151a),
        .ground = rgb(0x181c22),
        .hatch = rgb(0x272d36),
        .floor = {rgb(0x2b313b), rgb(0x303742), rgb(0x272d36), rgb(0x333943)},
        .source = rgb(0xcf9013),
        .source_edge = rgb(0xffcf70),
        .doubtful = rgb(0xa39a2e),
        .wall = rgb(0xf3efe6),
        .outline = rgb(0x49515e),
        .portal = rgb(0x3ccfa4),
        .tree = rgb(0xffd9ec),
        .start = rgb(0xff7a1f),
        .path = rgb(0xb9a6f2),
        .door = rgb(PURPLE),
        .glass = rgb(SKY),
        .object = rgb(0xc9b896),
        .mirrored = rgb(0xe58fc0),
        .ink = rgb(0xece9e2),
        .faint = rgb(0x9aa1ab),
        .dark = true,
    };
}

sl_palette sl_palette_make(bool is_dark) {
    sl_palette palette = is_dark ? dark() : light();
    const double strength = is_dark ? 0.58 : 0.62;
    for (int i = 0; i < SL_TONES; i++)
        palette.seen[i] = sl_colour_mix(palette.floor[i], rgb(SKY), strength - 0.04 * i);
    return palette;
}

/// sRGB from linear light, kept in range.
static double encode(double linear) {
    const double value =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
    return fmin(fmax(value, 0), 1);
}

/// From Oklab's lightness, chroma and hue in degrees (Ottosson, "A perceptual color space for image
/// processing", 2020).
static sl_colour from_oklch(double lightness, double chroma, double hue) {
    const double radians = hue * (3.14159265358979323846 / 180);
    const double a = chroma * cos(radians), b = chroma * sin(radians);
    const double l = pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    return (sl_colour){encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                       encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                       encode(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

sl_colour sl_palette_ramp(bool is_dark, double value) {
    // Lightness, chroma, hue: from pale yellow to deep blue on paper, from violet to light green in
    // the dark; each end stays away from the walls' colour.
    static const double stops[2][4][3] = {
        {{0.965, 0.045, 100}, {0.815, 0.100, 165}, {0.665, 0.115, 225}, {0.515, 0.130, 262}},
        {{0.300, 0.090, 300}, {0.465, 0.105, 258}, {0.630, 0.110, 195}, {0.795, 0.165, 140}},
    };
    const double at = fmin(fmax(value, 0), 1) * 3;
    const int i = at >= 2 ? 2 : at >= 1 ? 1 : 0;
    const double *from = stops[is_dark][i], *to = stops[is_dark][i + 1], share = at - i;
    return from_oklch(from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share,
                      from[2] + (to[2] - from[2]) * share);
}
