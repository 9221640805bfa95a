/// Colours, pens and marks.
///
/// The hues are those of Okabe & Ito, "Color Universal Design" (2008): orange, sky blue, bluish
/// green, yellow, blue, vermilion, reddish purple. They differ under every common colour blindness.
/// Soft tones are the same hues mixed with the ground. The ramp of the heat map goes evenly through
/// the lightness of Oklab. Lines, marks and text have a contrast of 3:1 at least to the page and to
/// cells, text 4.5:1 to the page (WCAG 2.1), also for eyes without red or green cones: some hues
/// are darker for that.
#include "draw/marks.h"

#include <math.h>
#include <stddef.h>

// --- colours

static sl_colour rgb(unsigned hex) {
    return (sl_colour){(hex >> 16 & 255) / 255.0, (hex >> 8 & 255) / 255.0, (hex & 255) / 255.0};
}

sl_colour sl_colour_mix(sl_colour a, sl_colour b, double share) {
    return (sl_colour){a.red + (b.red - a.red) * share, a.green + (b.green - a.green) * share,
                       a.blue + (b.blue - a.blue) * share};
}

enum {
    SKY = 0x56b4e9,
    BLUE = 0x0072b2,
    PURPLE = 0xcc79a7,
};

static sl_palette light(void) {
    return (sl_palette){
        .page = rgb(0xfbf9f4),
        .ground = rgb(0xf0ece3),
        .hatch = rgb(0xdcd5c7),
        .solid = rgb(0x6b665e),
        .floor = {rgb(0xffffff), rgb(0xf8f6f1), rgb(0xf3f3ee), rgb(0xfbf8ef)},
        .source = rgb(0xf0b63f),
        .source_edge = rgb(0xb26a00),
        .doubtful = rgb(0xf3ea6b),
        .wall = rgb(0x1d222b),
        .outline = rgb(0xc9c4b8),
        .portal = rgb(0x00845f),
        .tree = rgb(0x00233f),
        .start = rgb(0xc45200),
        .path = rgb(0x5b4a8a),
        .door = rgb(0xa8487d),
        .glass = rgb(BLUE),
        .object = rgb(0x7a6a53),
        .mirrored = rgb(0xb8558c),
        .ink = rgb(0x252a33),
        .faint = rgb(0x646971),
    };
}

static sl_palette dark(void) {
    return (sl_palette){
        .page = rgb(0x12151a),
        .ground = rgb(0x181c22),
        .hatch = rgb(0x272d36),
        .solid = rgb(0x958c7c),
        .floor = {rgb(0x2b313b), rgb(0x303742), rgb(0x272d36), rgb(0x333943)},
        .source = rgb(0xcf9013),
        .source_edge = rgb(0xffcf70),
        .doubtful = rgb(0xa39a2e),
        .wall = rgb(0xffffff),
        .outline = rgb(0x49515e),
        .portal = rgb(0x3ccfa4),
        .tree = rgb(0xfffafd),
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

sl_colour sl_palette_changes(bool is_dark, double value) {
    static const sl_colour ends[2][3] = {
        {{0.130, 0.400, 0.675}, {0.930, 0.930, 0.930}, {0.700, 0.095, 0.170}},
        {{0.400, 0.690, 0.940}, {0.220, 0.230, 0.250}, {0.960, 0.520, 0.400}}};
    const double far = fabs(2 * value - 1);
    return sl_colour_mix(ends[is_dark][1], ends[is_dark][value < 0.5 ? 0 : 2], fmin(far, 1));
}

// --- pens and marks

sli_pens sli_pens_for(const sl_scene *scene, const sl_frame *frame) {
    const double unit = frame->unit, cell = scene->cell_size * frame->scale;
    // Where cells come out tiny the lines give way, or nothing but lines would be seen.
    const double least = fmin(unit, 0.11 * cell);
    const double wall = fmin(fmax(0.048 * cell, fmax(least, 0.3 * unit)), 3.6 * unit);
    return (sli_pens){
        .wall = wall,
        .portal = fmin(fmax(0.45 * wall, 0.6 * least), 1.4 * unit),
        .outline = fmin(0.25 * wall, 1.0 * unit),
        .tree = fmin(fmax(0.08 * cell, 1.3 * unit), 4.5 * unit),
        .mark = fmin(fmax(0.35 * cell, 9 * unit), 15 * unit),
    };
}

void sl_set_colour(cairo_t *cairo, sl_colour colour) {
    cairo_set_source_rgb(cairo, colour.red, colour.green, colour.blue);
}

void sli_set_faded(cairo_t *cairo, sl_colour colour, double opacity) {
    cairo_set_source_rgba(cairo, colour.red, colour.green, colour.blue, opacity);
}

void sli_pen_stroke(cairo_t *cairo, sl_colour colour, double width) {
    sl_set_colour(cairo, colour);
    cairo_set_line_width(cairo, width);
    cairo_stroke(cairo);
}

static void stroke(cairo_t *cairo, sl_colour colour, double width, cairo_line_cap_t cap) {
    cairo_set_line_cap(cairo, cap);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    sli_pen_stroke(cairo, colour, width);
}

static void stroke_dashed(cairo_t *cairo, sl_colour colour, double width, double on, double off,
                          cairo_line_cap_t cap) {
    const double dashes[2] = {on, off};
    cairo_set_dash(cairo, dashes, 2, 0);
    stroke(cairo, colour, width, cap);
    cairo_set_dash(cairo, NULL, 0, 0);
}

void sli_pen_wall(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens) {
    stroke(cairo, palette->wall, pens->wall, CAIRO_LINE_CAP_ROUND);
}

void sli_pen_portal(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens) {
    const double width = pens->portal;
    stroke_dashed(cairo, palette->portal, width, 3.2 * width, 2.6 * width, CAIRO_LINE_CAP_BUTT);
}

void sli_pen_outline(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens) {
    stroke(cairo, palette->outline, pens->outline, CAIRO_LINE_CAP_BUTT);
}

void sli_pen_source_edge(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens) {
    stroke(cairo, palette->source_edge, pens->wall * 0.8, CAIRO_LINE_CAP_BUTT);
}

void sli_pen_path(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens) {
    const double width = pens->mark * 0.24;
    cairo_path_t *path = cairo_copy_path(cairo);
    const sl_colour rim = palette->page;
    sli_set_faded(cairo, rim, 0.75);
    cairo_set_line_width(cairo, 1.7 * width);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_stroke(cairo);
    cairo_append_path(cairo, path);
    cairo_path_destroy(path);
    stroke_dashed(cairo, palette->path, width, 0, 1.9 * width, CAIRO_LINE_CAP_ROUND);
}

void sli_pen_object(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens) {
    const sl_colour c = palette->object;
    sli_set_faded(cairo, c, 0.25);
    cairo_fill_preserve(cairo);
    stroke(cairo, c, pens->portal, CAIRO_LINE_CAP_BUTT);
}

static void set_tree_colour(cairo_t *cairo, sl_colour c, uint32_t depth) {
    sli_set_faded(cairo, c, 0.15 + 0.8 * pow(0.84, depth));
}

double sli_tree_width(const sli_pens *pens, uint32_t depth) {
    return pens->tree * (0.3 + 0.7 * pow(0.84, depth));
}

void sli_pen_tree_dots(cairo_t *cairo, sl_colour colour, uint32_t depth) {
    set_tree_colour(cairo, colour, depth);
    cairo_fill(cairo);
}

void sli_pen_tree(cairo_t *cairo, sl_colour colour, const sli_pens *pens, uint32_t depth) {
    set_tree_colour(cairo, colour, depth);
    cairo_set_line_width(cairo, sli_tree_width(pens, depth));
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

void sli_path_portal_end(cairo_t *cairo, sl_point at, bool left, double radius) {
    cairo_new_sub_path(cairo);
    if (left)
        cairo_arc(cairo, at.x, at.y, radius, 0, SLI_FULL_TURN);
    else
        cairo_rectangle(cairo, at.x - 0.88 * radius, at.y - 0.88 * radius, 1.76 * radius,
                        1.76 * radius);
}

void sli_mark_hatch(cairo_t *cairo, const sl_palette *palette, sl_box box, double spacing,
                    double phase) {
    // The lines x + y = phase + k * spacing.
    const double first = box.min.x + box.min.y, last = box.max.x + box.max.y;
    for (double sum = first + spacing - fmod(first - phase, spacing); sum < last; sum += spacing) {
        const double from = fmax(box.min.x, sum - box.max.y);
        const double to = fmin(box.max.x, sum - box.min.y);
        cairo_move_to(cairo, from, sum - from);
        cairo_line_to(cairo, to, sum - to);
    }
    stroke(cairo, palette->hatch, spacing * 0.14, CAIRO_LINE_CAP_BUTT);
}

void sli_mark_start(cairo_t *cairo, const sl_palette *palette, sl_point at, double heading,
                    double size) {
    cairo_save(cairo);
    cairo_translate(cairo, at.x, at.y);
    cairo_rotate(cairo, -fmod(heading, 360) * (3.14159265358979323846 / 180));
    cairo_move_to(cairo, 1.05 * size, 0);
    cairo_line_to(cairo, -0.75 * size, 0.68 * size);
    cairo_line_to(cairo, -0.35 * size, 0);
    cairo_line_to(cairo, -0.75 * size, -0.68 * size);
    cairo_close_path(cairo);
    cairo_restore(cairo);
    // A rim in the paper's colour sets it off from whatever is below.
    sl_set_colour(cairo, palette->page);
    cairo_set_line_width(cairo, 0.42 * size);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke_preserve(cairo);
    sl_set_colour(cairo, palette->start);
    cairo_fill(cairo);
}

void sli_mark_door(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens, sl_point a,
                   sl_point b, bool open) {
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    stroke(cairo, palette->door, 1.5 * pens->wall, CAIRO_LINE_CAP_BUTT);
    if (!open) return;
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    stroke(cairo, palette->page, 0.7 * pens->wall, CAIRO_LINE_CAP_BUTT);
}

void sli_mark_partial(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens, sl_point a,
                      sl_point b, sli_partial what) {
    const bool is_wall = what == SLI_PARTIAL_WALL;
    const double dash[] = {(what == SLI_PARTIAL_LIMITED ? 6 : 3) * pens->wall, 3 * pens->wall,
                           pens->wall, 3 * pens->wall};
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    if (!is_wall) cairo_set_dash(cairo, dash, what == SLI_PARTIAL_LIMITED ? 4 : 1, 0);
    stroke(cairo, palette->wall, (is_wall ? 1.3 : 0.8) * pens->wall, CAIRO_LINE_CAP_BUTT);
    cairo_set_dash(cairo, NULL, 0, 0);
    if (!is_wall) return;
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    stroke(cairo, palette->page, 0.5 * pens->wall, CAIRO_LINE_CAP_BUTT);
}

void sli_mark_mirror(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens, sl_point a,
                     sl_point b) {
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    stroke(cairo, palette->wall, 1.5 * pens->wall, CAIRO_LINE_CAP_BUTT);
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    stroke(cairo, palette->seen[0], 0.8 * pens->wall, CAIRO_LINE_CAP_BUTT);
}

void sli_mark_oneway(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens, sl_point a,
                     sl_point b) {
    const double dx = b.x - a.x, dy = b.y - a.y, length = hypot(dx, dy);
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    if (length > 0) {
        // On the page y runs down, so that the left of (dx, dy) is (dy, -dx).
        const double size = pens->mark * 0.8, ux = dx / length, uy = dy / length;
        const sl_point foot = {(a.x + b.x) / 2, (a.y + b.y) / 2};
        const sl_point tip = {foot.x + uy * size, foot.y - ux * size};
        cairo_move_to(cairo, foot.x, foot.y);
        cairo_line_to(cairo, tip.x, tip.y);
        cairo_move_to(cairo, tip.x - (uy + ux) * size * 0.35, tip.y + (ux - uy) * size * 0.35);
        cairo_line_to(cairo, tip.x, tip.y);
        cairo_line_to(cairo, tip.x - (uy - ux) * size * 0.35, tip.y + (ux + uy) * size * 0.35);
    }
    stroke(cairo, palette->glass, 0.7 * pens->wall, CAIRO_LINE_CAP_BUTT);
}

// --- faults

/// Of Okabe & Ito, as the palette's, a kind each.
static sl_colour colour_of(sl_fault_kind kind) {
    static const unsigned hues[SL_FAULT_KINDS] = {
        [SL_FAULT_LEAK] = 0xd55e00,    [SL_FAULT_GAP] = 0x0072b2,
        [SL_FAULT_OVERLAP] = 0xcc79a7, [SL_FAULT_CROSSING] = 0x56b4e9,
        [SL_FAULT_THIN] = 0x009e73,    [SL_FAULT_UNREACHABLE] = 0xe69f00,
    };
    const unsigned hue = hues[kind];
    return (sl_colour){(hue >> 16 & 255) / 255.0, (hue >> 8 & 255) / 255.0, (hue & 255) / 255.0};
}

/// Strokes on a pale rim that sets the mark off from what is below.
static void stroke_rimmed(cairo_t *cairo, const sl_palette *palette, sl_fault_kind kind,
                          double width) {
    const sl_colour rim = palette->page;
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    sli_set_faded(cairo, rim, 0.8);
    cairo_set_line_width(cairo, 2 * width);
    cairo_stroke_preserve(cairo);
    sli_pen_stroke(cairo, colour_of(kind), width);
}

static void add_line(cairo_t *cairo, sl_point a, sl_point b) {
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
}

static void add_ring(cairo_t *cairo, sl_point at, double radius) {
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, at.x, at.y, radius, 0, SLI_FULL_TURN);
}

/// A square, or one on its corner.
static void add_square(cairo_t *cairo, sl_point at, double radius, bool turned) {
    const double flat = turned ? 0 : radius;
    cairo_move_to(cairo, at.x - radius, at.y - flat);
    cairo_line_to(cairo, at.x + flat, at.y - radius);
    cairo_line_to(cairo, at.x + radius, at.y + flat);
    cairo_line_to(cairo, at.x - flat, at.y + radius);
    cairo_close_path(cairo);
}

void sli_mark_fault(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens,
                    sl_fault_kind kind, sl_point a, sl_point b) {
    const double size = 0.6 * pens->mark, half = hypot(b.x - a.x, b.y - a.y) / 2;
    const sl_point middle = {(a.x + b.x) / 2, (a.y + b.y) / 2};
    switch (kind) {
    case SL_FAULT_LEAK:
        add_line(cairo, a, b);
        add_ring(cairo, middle, fmax(size, half + 0.3 * size));
        break;
    case SL_FAULT_GAP:
        add_line(cairo, a, b);
        add_ring(cairo, middle, fmax(size, half));
        break;
    case SL_FAULT_CROSSING:
        add_line(cairo, (sl_point){middle.x - size / 2, middle.y - size / 2},
                 (sl_point){middle.x + size / 2, middle.y + size / 2});
        add_line(cairo, (sl_point){middle.x - size / 2, middle.y + size / 2},
                 (sl_point){middle.x + size / 2, middle.y - size / 2});
        break;
    case SL_FAULT_THIN:
        add_square(cairo, middle, 0.8 * size, true);
        break;
    case SL_FAULT_UNREACHABLE:
        add_square(cairo, middle, 0.8 * size, false);
        break;
    default:
        add_line(cairo, a, b);
    }
    stroke_rimmed(cairo, palette, kind, kind == SL_FAULT_OVERLAP ? 0.4 * size : 0.2 * size);
}

static void draw_way(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens,
                     const sl_frame *frame, const sl_point *points, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) sl_path_segment(cairo, frame, points[i - 1], points[i]);
    stroke_rimmed(cairo, palette, SL_FAULT_LEAK, 0.22 * pens->mark);
}

void sli_draw_faults(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens,
                     const sl_frame *frame, const sl_faults *faults) {
    // The gravest first of all in the list, and so last of all on the page.
    for (uint32_t i = faults->count; i-- > 0;) {
        const sl_fault *fault = &faults->items[i];
        sl_point a, b;
        if (fault->kind == SL_FAULT_LEAK)
            draw_way(cairo, palette, pens, frame, faults->points + fault->first_point,
                     fault->point_count);
        if (sl_frame_holds(frame, fault->at.a, &a) && sl_frame_holds(frame, fault->at.b, &b))
            sli_mark_fault(cairo, palette, pens, fault->kind, a, b);
    }
}
