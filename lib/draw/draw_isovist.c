/// Pictures of what is seen from places: regions over the plan, heat maps of their measures, and
/// patches coloured by cost.
///
/// Colours have a scale: a ramp with numbers below. The numbers of its two ends come first, then
/// round ones between them. A number that would touch another one is left out. Values beyond the
/// ends have the colours of the ends, and a tip marks that there are some:
///
///     <||||||||||||||||||||||||>  area
///     <= 0       200       >= 400
#include "draw/chart.h"
#include "draw/marks.h"
#include "draw/page.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

enum { RAMP_STEPS = 64 };

/// The largest end of a scale.
#define LARGEST 1e300

/// What a picture shows: regions, or else a field, or else patches.
typedef struct picture {
    sl_scene scene;
    const sl_drawn_region *regions;
    size_t region_count;
    const sl_field *field;
    const sl_patches *patches;
    const sl_drawn_lines *lines;
    const char *caption, *scale, *unit; ///< `scale`: what the colours tell, in `unit` (or NULL)
    const double *values;               ///< of the field or the patches
    size_t value_count;
    double least, most; ///< the ends of the scale
    bool under, over;   ///< some values are beyond them
    bool diverging;     ///< from losses over 0 to gains
} picture;

/// The colour of a place on the scale, 0 to 1.
static sl_colour ramp_colour(const picture *p, double place) {
    const bool dark = p->scene.palette.dark;
    if (p->lines) place = 0.2 + 0.8 * place; // thin lines in the page's colour would be lost
    return p->diverging ? sl_palette_changes(dark, place) : sl_palette_ramp(dark, place);
}

/// Values that differ by less than this share of themselves are equal but for rounding.
static const double ROUNDING = 1e-12;

/// The scale's ends are those of the values where `least` and `most` are equal.
static void find_range(picture *p, double least, double most) {
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < p->value_count; i++) {
        if (isnan(p->values[i])) continue;
        low = fmin(low, p->values[i]);
        high = fmax(high, p->values[i]);
    }
    if (low < high && high - low <= ROUNDING * fmax(fabs(low), fabs(high))) high = low;
    p->least = least < most ? least : low;
    p->most = least < most ? most : high;
    p->under = low < p->least;
    p->over = high > p->most;
}

static bool has_undefined(const picture *p) {
    for (size_t i = 0; i < p->value_count; i++)
        if (isnan(p->values[i])) return true;
    return false;
}

static double share_of(const picture *p, double value) {
    if (!(p->most > p->least)) return 0;
    return fmin(fmax((value - p->least) / (p->most - p->least), 0), 1);
}

static int step_of(const picture *p, double value) {
    return (int)fmin(share_of(p, value) * RAMP_STEPS, RAMP_STEPS - 1);
}

static void add_square(cairo_t *cairo, const sl_frame *frame, const sl_box *bounds,
                       const sl_field *f, size_t i) {
    const double x = f->corner.x + f->step * (double)(i % f->columns);
    const double y = f->corner.y + f->step * (double)(i / f->columns);
    const sl_point low = {fmax(x, bounds->min.x), fmax(y, bounds->min.y)};
    const sl_point high = {fmin(x + f->step, bounds->max.x), fmin(y + f->step, bounds->max.y)};
    const sl_point corners[4] = {low, {high.x, low.y}, high, {low.x, high.y}};
    if (low.x < high.x && low.y < high.y) sl_path_polygon(cairo, frame, corners, 4);
}

static void add_patch(cairo_t *cairo, const sl_frame *frame, const sl_patches *patches, size_t i) {
    const uint32_t first = patches->first[i];
    sl_path_polygon(cairo, frame, patches->points + first, patches->first[i + 1] - first);
}

/// The squares that are no part of the scale.
static void draw_grey(cairo_t *cairo, const picture *p, const sl_frame *frame) {
    const sl_palette *palette = &p->scene.palette;
    for (size_t i = 0; p->field && p->field->grey && i < p->value_count; i++)
        if (p->field->grey[i]) add_square(cairo, frame, &p->scene.baked->space.bounds, p->field, i);
    sl_set_colour(cairo, sl_colour_mix(palette->page, palette->ink, 0.18));
    cairo_fill_preserve(cairo);
    cairo_set_line_width(cairo, 0.6);
    cairo_stroke(cairo);
}

/// Squares or patches of one colour make one path. A thin stroke covers the seams between them.
static sl_status draw_values(sl_context *context, cairo_t *cairo, const picture *p,
                             const sl_frame *frame) {
    sli_layer_begin(cairo, "values");
    draw_grey(cairo, p, frame);
    for (int step = 0; step < RAMP_STEPS; step++) {
        SL_TRY(sl_check_cancelled(context));
        for (size_t i = 0; i < p->value_count; i++) {
            if (isnan(p->values[i]) || step_of(p, p->values[i]) != step) continue;
            if (p->field)
                add_square(cairo, frame, &p->scene.baked->space.bounds, p->field, i);
            else
                add_patch(cairo, frame, p->patches, i);
        }
        sl_set_colour(cairo, ramp_colour(p, (step + 0.5) / RAMP_STEPS));
        cairo_fill_preserve(cairo);
        cairo_set_line_width(cairo, 0.6);
        cairo_stroke(cairo);
    }
    return SL_OK;
}

/// Draws over the squares where they reach over walls: into cells that are not inside and hold the
/// middle of none.
static sl_status draw_beside_squares(sl_context *context, cairo_t *cairo, const picture *p,
                                     const sl_frame *frame) {
    const sl_field *f = p->field;
    const sl_space *space = &p->scene.baked->space;
    bool *kept = sl_alloc_array(context, space->cell_count + 1, sizeof *kept);
    if (!kept) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->cell_count; i++) kept[i] = space->cells[i].inside;
    for (size_t i = 0; i < p->value_count; i++) {
        if (isnan(p->values[i]) && !(f->grey && f->grey[i])) continue;
        const sl_point middle = {f->corner.x + f->step * ((double)(i % f->columns) + 0.5),
                                 f->corner.y + f->step * ((double)(i / f->columns) + 0.5)};
        const uint32_t cell = sl_space_locate(space, middle);
        if (cell != SL_NO_CELL) kept[cell] = true;
    }
    sli_draw_beside(cairo, &p->scene, frame, kept);
    sl_free(context, kept);
    return SL_OK;
}

static void draw_lines(cairo_t *cairo, const picture *p, const sl_frame *frame) {
    for (size_t i = 0; i < p->patches->line_count; i++) {
        const sl_point a = sl_frame_point(frame, p->patches->lines[i].a);
        const sl_point b = sl_frame_point(frame, p->patches->lines[i].b);
        cairo_move_to(cairo, a.x, a.y);
        cairo_line_to(cairo, b.x, b.y);
    }
    sli_pen_stroke(cairo, p->scene.palette.page, 0.8 * frame->unit);
}

/// From low to high values, each a little wider than the last. Lines without a value lie below.
static sl_status draw_valued_lines(sl_context *context, cairo_t *cairo, const picture *p,
                                   const sl_frame *frame) {
    sli_layer_begin(cairo, "lines");
    for (size_t i = 0; i < p->value_count; i++)
        if (isnan(p->values[i]))
            sl_path_segment(cairo, frame, p->lines->lines[i].a, p->lines->lines[i].b);
    sli_pen_stroke(cairo, p->scene.palette.faint, frame->unit);
    for (int step = 0; step < RAMP_STEPS; step++) {
        SL_TRY(sl_check_cancelled(context));
        for (size_t i = 0; i < p->value_count; i++) {
            if (isnan(p->values[i]) || step_of(p, p->values[i]) != step) continue;
            sl_path_segment(cairo, frame, p->lines->lines[i].a, p->lines->lines[i].b);
        }
        sl_set_colour(cairo, ramp_colour(p, (step + 0.5) / RAMP_STEPS));
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
        cairo_set_line_width(cairo, (1.5 + 2.0 * step / RAMP_STEPS) * frame->unit);
        cairo_stroke(cairo);
    }
    return SL_OK;
}

static void draw_eye(cairo_t *cairo, const picture *p, const sl_frame *frame, sl_point eye) {
    const sl_point at = sl_frame_point(frame, eye);
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, at.x, at.y, 5 * frame->unit, 0, SLI_FULL_TURN);
    sl_set_colour(cairo, p->scene.palette.start);
    cairo_fill_preserve(cairo);
    sli_pen_stroke(cairo, p->scene.palette.page, 1.2 * frame->unit);
}

static sl_status draw_plan(sl_context *context, cairo_t *cairo, const void *what,
                           const sl_frame *frame) {
    const picture *p = what;
    if (p->lines && p->lines->alone) return draw_valued_lines(context, cairo, p, frame);
    SL_TRY(sl_draw_plan(context, cairo, &p->scene, p->scene.options.layers, frame));
    if (p->lines) return draw_valued_lines(context, cairo, p, frame);
    SL_TRY(draw_values(context, cairo, p, frame));
    if (p->patches) draw_lines(cairo, p, frame);
    if (p->field) SL_TRY(draw_beside_squares(context, cairo, p, frame));
    if (p->patches) sli_draw_solid(cairo, &p->scene, frame); // they may reach into it
    if (p->region_count) sli_layer_begin(cairo, "isovists");
    for (size_t i = 0; i < p->region_count; i++)
        sli_draw_seen(cairo, &p->scene.palette, frame, &p->regions[i]);
    SL_TRY(sl_draw_walls(context, cairo, &p->scene, frame));
    for (size_t i = 0; i < p->region_count; i++) draw_eye(cairo, p, frame, p->regions[i].eye);
    return SL_OK;
}

// --- the scale

/// A number under the ramp.
typedef struct scale_label {
    char text[SL_COUNT_TEXT + 8];
    double share;       ///< its place along the ramp, 0 to 1
    double left, right; ///< of its text, on the page
} scale_label;

/// The most labels: the two ends, and round numbers between them.
enum { LABELS_MOST = 10 };

/// The value with four digits, or more where the scale is short; large numbers in groups.
static void write_value(double value, double span, char text[SL_COUNT_TEXT]) {
    char plain[SL_NUMBER_TEXT], whole[SL_COUNT_TEXT];
    const double more = value != 0 && span > 0 ? ceil(log10(fabs(value) / span)) + 3 : 0;
    const int length = snprintf(plain, sizeof plain, "%.*g", (int)fmin(fmax(more, 4), 15), value);
    double rounded = value;
    sl_number_read(plain, (size_t)length, &rounded);
    if (fabs(rounded) < 1e12 && rounded == trunc(rounded)) {
        sl_text_count((uint64_t)fabs(rounded), "", whole);
        snprintf(text, SL_COUNT_TEXT, "%s%.*s", rounded < 0 ? "-" : "", SL_COUNT_TEXT - 2, whole);
    } else {
        sl_number_write(rounded, text);
    }
}

/// Adds the label if it keeps its distance from the others.
static void add_label(cairo_t *cairo, const sli_page *g, double width, scale_label label,
                      scale_label *labels, size_t *count) {
    const double wide = sl_text_width(cairo, label.text), space = 0.6 * g->text;
    const double last = g->margin + g->inner - wide;
    label.left = fmax(fmin(g->margin + label.share * width - wide / 2, last), g->margin);
    label.right = label.left + wide;
    for (size_t i = 0; i < *count; i++)
        if (label.left < labels[i].right + space && labels[i].left < label.right + space) return;
    if (*count < LABELS_MOST) labels[(*count)++] = label;
}

/// Both ends, then round numbers.
static size_t place_labels(cairo_t *cairo, const picture *p, const sli_page *g, double width,
                           scale_label labels[LABELS_MOST]) {
    const double span = p->most - p->least;
    size_t count = 0;
    char number[SL_COUNT_TEXT];
    for (int end = 0; end < (span > 0 ? 2 : 1); end++) {
        scale_label label = {.share = end};
        write_value(end ? p->most : p->least, span, number);
        const char *beyond = end && p->over     ? "\xe2\x89\xa5 "
                             : !end && p->under ? "\xe2\x89\xa4 "
                                                : "";
        snprintf(label.text, sizeof label.text, "%s%s", beyond, number);
        add_label(cairo, g, width, label, labels, &count);
    }
    if (!(span > 1e-300 && span < 1e300)) return count;
    static const sl_chart_axis linear = {.scale = SL_CHART_LINEAR};
    const sli_axis axis = {.what = &linear, .low = p->least, .high = p->most, .to = 1};
    sli_tick ticks[SLI_TICKS_MOST];
    const size_t tick_count = sli_axis_ticks(&axis, ticks);
    for (size_t i = 0; i < tick_count; i++) {
        scale_label label = {.share = sli_axis_place(&axis, ticks[i].value)};
        write_value(ticks[i].value, span, label.text);
        add_label(cairo, g, width, label, labels, &count);
    }
    return count;
}

/// The ramp. A tip at an end shows that some values are beyond it.
static void draw_ramp(cairo_t *cairo, const picture *p, const sli_page *g, double width,
                      double high) {
    const double right = g->margin + width, tip = fmin(0.6 * high, 0.7 * g->margin);
    for (int i = 0; i < RAMP_STEPS; i++) {
        cairo_rectangle(cairo, g->margin + width * i / RAMP_STEPS, g->key,
                        width / RAMP_STEPS + (i + 1 < RAMP_STEPS ? 0.5 : 0), high);
        if (i == 0 && p->under) {
            cairo_move_to(cairo, g->margin, g->key);
            cairo_line_to(cairo, g->margin - tip, g->key + high / 2);
            cairo_line_to(cairo, g->margin, g->key + high);
        } else if (i + 1 == RAMP_STEPS && p->over) {
            cairo_move_to(cairo, right, g->key);
            cairo_line_to(cairo, right + tip, g->key + high / 2);
            cairo_line_to(cairo, right, g->key + high);
        }
        sl_set_colour(cairo, ramp_colour(p, (i + 0.5) / RAMP_STEPS));
        cairo_fill(cairo);
    }
}

/// The ramp with numbers under it, and what they are: beside the ramp, or below where there is no
/// room. Returns its height.
static double draw_scale(cairo_t *cairo, const picture *p, const sli_page *g, bool paint) {
    const double width = fmin(30 * g->text, g->inner), high = 1.2 * g->text;
    const sl_colour ink = p->scene.palette.ink;
    char name[128];
    snprintf(name, sizeof name, "%s%s%s%s", p->scale, p->unit ? ", " : "", p->unit ? p->unit : "",
             p->lines && has_undefined(p) ? " (grey: not defined)"
             : p->field && p->field->grey ? " (grey: other parts)"
                                          : "");
    sl_text_font(cairo, g->text, false);
    const bool beside = width + 1.6 * g->text + sl_text_width(cairo, name) <= g->inner;
    const double height = (beside ? 3.2 : 4.8) * g->text;
    if (!paint || !(p->least <= p->most)) return height;
    draw_ramp(cairo, p, g, width, high);
    sl_text_font(cairo, g->text, false);
    scale_label labels[LABELS_MOST];
    const size_t count = place_labels(cairo, p, g, width, labels);
    for (size_t i = 0; i < count; i++) {
        const double x = g->margin + labels[i].share * width;
        cairo_move_to(cairo, x, g->key + high);
        cairo_line_to(cairo, x, g->key + high + 0.35 * g->text);
        sli_pen_stroke(cairo, ink, 0.09 * g->text);
        sl_text_show(cairo, ink, labels[i].left, g->key + high + 1.5 * g->text, labels[i].text);
    }
    if (beside)
        sl_text_show(cairo, ink, g->margin + width + 1.6 * g->text, g->key + 0.95 * g->text, name);
    else
        sl_text_show_within(cairo, ink, g->margin, g->key + high + 3.1 * g->text, g->inner, g->text,
                            false, name);
    return height;
}

// --- the page

static void set_page(cairo_t *cairo, const void *what, sli_page *page, bool paint) {
    const picture *p = what;
    const sl_palette *palette = &p->scene.palette;
    const double top = sli_page_heading(cairo, page, palette, p->scene.options.title, NULL, paint);
    if (!paint) sli_page_place_plan(page, p->scene.baked->space.bounds, top, SLI_PAGE_TALLEST);
    double y = page->key;
    if (p->scale) y += draw_scale(cairo, p, page, paint);
    y += sli_draw_seen_key(cairo, palette, p->regions, p->region_count, (sl_point){page->margin, y},
                           page->inner, page->text, paint);
    y += sli_draw_ground_key(cairo, &p->scene, (sl_point){page->margin, y}, page->text, paint);
    y += sli_page_caption(cairo, page, palette, y, p->caption, paint);
    page->height = ceil(y + 0.7 * page->margin);
}

static sl_status draw_picture(sl_context *context, const sl_baked *baked,
                              const sl_draw_options *options, picture *p, sli_page_target *target) {
    const unsigned layers = SL_LAYER_WALLS | (p->scale ? 0 : (unsigned)SL_LAYER_STARTS);
    const sli_page_parts parts = {.set = set_page, .draw_plan = draw_plan, .what = p};
    return sli_page_draw_map(context, baked, options, layers, &p->scene, parts, target);
}

sl_status sl_draw_regions_file(sl_context *context, const sl_baked *baked,
                               const sl_drawn_region *regions, size_t count, const char *caption,
                               const sl_draw_options *options, const char *path) {
    picture p = {.regions = regions, .region_count = count, .caption = caption};
    return draw_picture(context, baked, options, &p, &(sli_page_target){.path = path});
}

static sl_status draw_field(sl_context *context, const sl_baked *baked, const sl_field *field,
                            const sl_draw_options *options, sli_page_target *target) {
    if (!(fabs(field->least) <= LARGEST && fabs(field->most) <= LARGEST &&
          field->least <= field->most))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a scale from %g to %g: expected two ascending numbers of at most %g",
                       field->least, field->most, LARGEST);
    picture p = {.field = field,
                 .scale = field->name,
                 .unit = field->unit,
                 .values = field->values,
                 .value_count = field->columns * field->rows};
    find_range(&p, field->least, field->most);
    p.diverging = field->diverging;
    if (p.diverging && p.least <= p.most) {
        p.most = fmax(fabs(p.least), fabs(p.most));
        if (p.most == 0) p.most = 1; // nothing changes
        p.least = -p.most;
    }
    return draw_picture(context, baked, options, &p, target);
}

sl_status sli_draw_picture(sl_context *context, const sl_baked *baked, const sl_field *field,
                           const sl_drawn_lines *lines, const sl_draw_options *options,
                           sli_page_target *target) {
    if (field) return draw_field(context, baked, field, options, target);
    picture p = {0};
    if (lines)
        p = (picture){.lines = lines,
                      .scale = lines->name,
                      .values = lines->values,
                      .value_count = lines->count};
    if (lines) find_range(&p, 0, 0);
    return draw_picture(context, baked, options, &p, target);
}

sl_status sl_draw_field_file(sl_context *context, const sl_baked *baked, const sl_field *field,
                             const sl_draw_options *options, const char *path) {
    return draw_field(context, baked, field, options, &(sli_page_target){.path = path});
}

sl_status sl_draw_lines_file(sl_context *context, const sl_baked *baked,
                             const sl_drawn_lines *lines, const sl_draw_options *options,
                             const char *path) {
    return sli_draw_picture(context, baked, NULL, lines, options, &(sli_page_target){.path = path});
}

sl_status sl_draw_patches_file(sl_context *context, const sl_baked *baked,
                               const sl_patches *patches, const char *caption,
                               const sl_draw_options *options, const char *path) {
    picture p = {.patches = patches,
                 .caption = caption,
                 .scale = patches->name,
                 .values = patches->values,
                 .value_count = patches->count};
    find_range(&p, 0, 0);
    return draw_picture(context, baked, options, &p, &(sli_page_target){.path = path});
}
