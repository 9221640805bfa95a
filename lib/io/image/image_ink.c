/// What is solid in a picture: the dark pixels, unless it shows thin light lines on a dark ground,
/// or light ones on a transparent ground.
///
/// Thin is what has no large square in it. Walls are thin, and rooms are not: so dark rock with
/// light rooms in it stays rock. The two classes, dark and light, are those of Otsu 1979, "A
/// threshold selection method from gray-level histograms".
#include "io/image/image.h"

#include <math.h>
#include <string.h>

typedef size_t histogram[256];

/// By how much a line differs from the ground, at least.
enum { VISIBLE = 32 };

/// A share of the range of values, in hundredths.
static double rounded(double value) {
    return fmax(0.01, round(value / 255 * 100) / 100);
}

static size_t pixels_of(const sl_image *image) {
    return image->width * image->height;
}

/// The side of the largest square that is thin: 2 pixels, or one `share`th of the picture's shorter
/// side.
static size_t thin_side(const sl_image *image, size_t share) {
    const size_t shorter = image->width < image->height ? image->width : image->height;
    return shorter / share > 2 ? shorter / share : 2;
}

/// The value of a pixel: how dark it is, or how light.
static unsigned value_of(const sl_image *image, bool light, size_t i) {
    return light ? image->pixels[i] : 255u - image->pixels[i];
}

/// The largest square whose pixels are all of one class, and how many pixels are the last corners
/// of squares above a side.
typedef struct squares {
    size_t largest, above;
} squares;

/// Squares of pixels with values of `least` to `most`. `row[x]` is the side of the largest one
/// whose last corner is x.
static squares find_squares(const unsigned char *values, size_t stride, const sl_image *image,
                            unsigned least, unsigned most, size_t limit, size_t *row) {
    squares out = {0};
    memset(row, 0, (image->width + 1) * sizeof *row);
    for (size_t y = 0; y < image->height; y++) {
        size_t corner = 0; // above and before
        for (size_t x = 0; x < image->width; x++) {
            const unsigned value = values[(y * image->width + x) * stride];
            const size_t above = row[x + 1];
            size_t side = 0;
            if (value >= least && value <= most) {
                side = above < row[x] ? above : row[x];
                side = 1 + (corner < side ? corner : side);
            }
            corner = above;
            row[x + 1] = side;
            if (side > out.largest) out.largest = side;
            out.above += side > limit;
        }
    }
    return out;
}

/// The last value of the lower of the two classes that differ most; 255 where there is one value.
static unsigned split(const histogram count, size_t all) {
    double sum = 0, below = 0, sum_below = 0, best = 0;
    unsigned at = 255;
    for (unsigned i = 0; i < 256; i++) sum += (double)i * (double)count[i];
    for (unsigned i = 0; i < 255; i++) {
        below += (double)count[i];
        sum_below += (double)i * (double)count[i];
        const double above = (double)all - below;
        if (below == 0 || above == 0) continue;
        const double apart = sum_below / below - (sum - sum_below) / above;
        if (below * above * apart * apart <= best) continue;
        best = below * above * apart * apart;
        at = i;
    }
    return at;
}

bool sli_image_is_opaque(const unsigned char *alpha, const sl_image *image, size_t *row) {
    const size_t all = pixels_of(image);
    size_t opaque = 0, light = 0;
    for (size_t i = 0; i < all; i++) {
        if (alpha[2 * i + 1] < 128) continue;
        opaque++;
        light += alpha[2 * i] >= 128;
    }
    if (!opaque || 2 * opaque > all || 2 * light < opaque) return false;
    const size_t limit = thin_side(image, 16);
    return find_squares(alpha + 1, 2, image, 128, 255, limit, row).largest <= limit;
}

/// How much of the picture's edge has values up to `dark`.
static double dark_edge(const sl_image *image, unsigned dark) {
    size_t edge = 0, is_dark = 0;
    for (size_t y = 0; y < image->height; y++) {
        const bool whole = y == 0 || y + 1 == image->height || image->width == 1;
        for (size_t x = 0; x < image->width; x += whole ? 1 : image->width - 1) {
            edge++;
            is_dark += image->pixels[y * image->width + x] <= dark;
        }
    }
    return (double)is_dark / (double)edge;
}

/// Whether what is lighter than `dark` is thin lines on a dark ground, but for a fiftieth: names in
/// large letters, symbols, legends.
static bool are_light_lines(const sl_image *image, const histogram count, unsigned dark,
                            size_t *row) {
    const size_t all = pixels_of(image), limit = thin_side(image, 32);
    size_t light = 0;
    for (unsigned i = dark + 1; i < 256; i++) light += count[i];
    if (light == 0 || 3 * light > all || dark_edge(image, dark) < 0.8) return false;
    const squares lines = find_squares(image->pixels, 1, image, dark + 1, 255, limit, row);
    if (50 * lines.above > light) return false;
    const size_t side = lines.largest < limit ? lines.largest : limit;
    return find_squares(image->pixels, 1, image, 0, dark, 0, row).largest >= 6 * side;
}

/// The commonest of the dark values.
static unsigned find_ground(const histogram count) {
    unsigned ground = 0;
    for (unsigned i = 1; i < 128; i++)
        if (count[i] > count[ground]) ground = i;
    return ground;
}

bool sli_image_is_light(const sl_image *image, size_t *row) {
    histogram count = {0};
    for (size_t i = 0; i < pixels_of(image); i++) count[image->pixels[i]]++;
    // The second split passes over a grid that is hardly lighter than the page. The first may part
    // the two from each other, where the lines are few.
    return are_light_lines(image, count, split(count, pixels_of(image)), row) ||
           are_light_lines(image, count, find_ground(count) + VISIBLE, row);
}

/// The commonest lightness from 0 to 127 that is not within `apart` of `other`.
static unsigned commonest_dark(const histogram count, unsigned other, unsigned apart) {
    unsigned commonest = 256;
    for (unsigned i = 0; i < 128; i++) {
        if (other < 256 && i < other + apart && other < i + apart) continue;
        if (commonest == 256 || count[i] > count[commonest]) commonest = i;
    }
    return commonest;
}

/// Lines on a page and rooms in rock are told apart by how thick most of what is light is. A second
/// dark ground has a tenth of the picture, as the first has.
sli_image_page sli_image_find_page(const sl_image *image, size_t *row) {
    enum { APART = 12 };
    const size_t all = pixels_of(image), limit = thin_side(image, 32);
    sli_image_page out = {.has_lines = false};
    histogram count = {0};
    for (size_t i = 0; i < all; i++) count[image->pixels[i]]++;
    const unsigned dark = split(count, all);
    if (dark == 255 || dark_edge(image, dark) < 0.8) return out;
    size_t light = 0;
    for (unsigned i = dark + 1; i < 256; i++) light += count[i];
    out.has_lines =
        3 * light <= all &&
        4 * find_squares(image->pixels, 1, image, dark + 1, 255, limit, row).above < light;
    const unsigned first = commonest_dark(count, 256, APART);
    const unsigned second = commonest_dark(count, first, APART);
    if (10 * count[first] < all || 10 * count[second] < all) return out;
    const unsigned darker = first < second ? first : second, lighter = first + second - darker;
    out.lightness = rounded(darker);
    out.second = rounded(lighter);
    out.threshold = 1 - rounded((darker + lighter) / 2.0);
    return out;
}

// --- the threshold

static bool touches_solid(const sl_image *image, bool light, size_t x, size_t y) {
    for (size_t v = y ? y - 1 : 0; v <= y + 1 && v < image->height; v++)
        for (size_t u = x ? x - 1 : 0; u <= x + 1 && u < image->width; u++)
            if (value_of(image, light, v * image->width + u) >= 128) return true;
    return false;
}

/// The share of the pixels that are neither ground nor of one of the eight commonest greys.
static double share_between(const histogram count, unsigned ground, size_t all) {
    histogram rest = {0};
    size_t between = 0;
    for (unsigned i = ground + VISIBLE / 2; i < 240; i++) between += rest[i] = count[i];
    for (int k = 0; k < 8; k++) {
        unsigned commonest = 0;
        for (unsigned i = 1; i < 256; i++)
            if (rest[i] > rest[commonest]) commonest = i;
        between -= rest[commonest];
        rest[commonest] = 0;
    }
    return (double)between / (double)all;
}

/// Counts what is fainter than the threshold and no soft edge of what is solid.
static void find_lost(const sl_image *image, bool light, unsigned ground, sli_image_levels *out) {
    double sum = 0;
    for (size_t y = 0; y < image->height; y++)
        for (size_t x = 0; x < image->width; x++) {
            const unsigned value = value_of(image, light, y * image->width + x);
            if (value < ground + VISIBLE || value >= 128) continue;
            if (touches_solid(image, light, x, y)) continue;
            out->lost++;
            sum += value;
        }
    if (!out->lost) return;
    sum /= (double)out->lost;
    out->lost_level = rounded(sum);
    out->lost_from = rounded((ground + sum) / 2);
}

sli_image_levels sli_image_find_levels(const sl_image *image, bool light, size_t *row) {
    const size_t all = pixels_of(image);
    sli_image_levels out = {.threshold = 0.5};
    histogram count = {0};
    size_t solid = 0;
    for (size_t i = 0; i < all; i++) count[value_of(image, light, i)]++;
    const unsigned ground = find_ground(count);
    for (unsigned i = 128; i < 256; i++) solid += count[i];
    out.between = share_between(count, ground, all);
    out.soft = out.between * (double)all >= (double)solid / 50;
    find_lost(image, light, ground, &out);
    if (out.lost <= 4 * solid) return out;
    const unsigned least = ground + VISIBLE;
    const size_t limit = thin_side(image, 16);
    const squares lines = light ? find_squares(image->pixels, 1, image, least, 255, limit, row)
                                : find_squares(image->pixels, 1, image, 0, 255 - least, limit, row);
    if (lines.above) return out;
    out.threshold = out.lost_from;
    out.faint = true;
    out.lost = 0;
    return out;
}
