/// The picture of an explanation: why one cell sees another or does not. It has a heading, the
/// plan with its marks (draw_explain_plan.c), a key, and a caption.
#include "draw/draw_explain.h"

#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

#define CAPTION_TEXT 512
#define LINE_HEIGHT  1.5
#define TALLEST      1.1 ///< of the plan, in its width: the caption should not be far

// --- what is shown

/// Paints the cells that the sequence leads through and the cell looked at.
static sl_status paint_cells(sl_context *context, sli_explained *pic) {
    sl_scene *scene = &pic->scene;
    const sl_space *space = &scene->baked->space;
    uint8_t *paint = sl_alloc_array(context, space->cell_count, sizeof *paint);
    if (!paint) return SL_NO_MEMORY;
    sli_scene_get_paint(scene, paint);
    const uint32_t inner = pic->sequence ? pic->sequence->directed_count - 1 : 0;
    for (uint32_t i = 0; i < inner; i++) {
        uint8_t *p = &paint[space->directed[pic->sequence->directed[i]].cell];
        if (*p >= SLI_PAINT_FLOOR && *p < SLI_PAINT_SEEN) *p += SLI_PAINT_SEEN - SLI_PAINT_FLOOR;
    }
    if (pic->explanation->from != pic->explanation->to)
        paint[pic->explanation->to] = SLI_PAINT_DOUBTFUL;
    sli_scene_set_paint(scene, paint);
    sl_free(context, paint);
    return SL_OK;
}

static void choose_colours(sli_explained *pic) {
    sl_palette *palette = &pic->scene.palette;
    pic->left = palette->glass;
    pic->right = palette->start;
    pic->target = palette->door;
    palette->doubtful = sl_colour_mix(palette->door, palette->page, 0.62);
    for (int i = 0; i < SL_TONES; i++)
        palette->seen[i] = sl_colour_mix(palette->floor[i], palette->seen[i], 0.45);
}

static void include(sl_box *box, sl_point p) {
    box->min.x = fmin(box->min.x, p.x);
    box->min.y = fmin(box->min.y, p.y);
    box->max.x = fmax(box->max.x, p.x);
    box->max.y = fmax(box->max.y, p.y);
}

static void include_cell(sl_box *box, const sl_space *space, uint32_t cell) {
    const sl_cell *c = &space->cells[cell];
    for (uint32_t i = 0; i < c->vertex_count; i++)
        include(box, space->vertices[c->first_vertex + i]);
}

/// Widens low .. high to `wanted`, but keeps it within the bounds.
static void widen(double *low, double *high, double wanted, double least, double most) {
    const double length = fmin(wanted, most - least), middle = *low + (*high - *low) / 2;
    if (length <= *high - *low) return;
    *low = fmin(fmax(middle - length / 2, least), most - length);
    *high = fmin(*low + length, most);
}

/// Chooses the part of the map: both cells, all portals and some room. If that is most of the map,
/// all of it.
static void choose_frame(sli_explained *pic) {
    const sl_space *space = &pic->scene.baked->space;
    const sl_box bounds = space->bounds;
    const double whole_x = bounds.max.x - bounds.min.x, whole_y = bounds.max.y - bounds.min.y;
    const sl_cell *from = &space->cells[pic->explanation->from];
    sl_box box = {space->vertices[from->first_vertex], space->vertices[from->first_vertex]};
    include_cell(&box, space, pic->explanation->from);
    include_cell(&box, space, pic->explanation->to);
    for (uint32_t i = 0; pic->sequence && i < pic->sequence->directed_count; i++) {
        include(&box, space->directed[pic->sequence->directed[i]].left);
        include(&box, space->directed[pic->sequence->directed[i]].right);
    }
    const sl_bent_sightline *bent = &pic->explanation->bent;
    for (uint32_t i = 0; bent->bends && i < bent->mirrors + 2; i++) include(&box, bent->bends[i]);
    const double wide = box.max.x - box.min.x, high = box.max.y - box.min.y;
    const double margin = 0.12 * fmax(wide, high);
    const double wanted_x = fmax(wide + 2 * margin, 0.95 * (high + 2 * margin));
    const double wanted_y = fmax(high + 2 * margin, 0.45 * wanted_x);
    widen(&box.min.x, &box.max.x, wanted_x, bounds.min.x, bounds.max.x);
    widen(&box.min.y, &box.max.y, wanted_y, bounds.min.y, bounds.max.y);
    const double share = (box.max.x - box.min.x) / whole_x * ((box.max.y - box.min.y) / whole_y);
    pic->part = share < 0.65;
    pic->frame = pic->part ? box : bounds;
}

// --- words

/// Writes what the picture teaches.
static void write_caption(const sli_explained *pic, char text[CAPTION_TEXT]) {
    const sl_explanation *e = pic->explanation;
    const sl_space *space = &pic->scene.baked->space;
    const sl_sequence *sequence = pic->sequence;
    const uint32_t count = sequence ? sequence->directed_count : 0;
    if (e->from == e->to) {
        snprintf(text, CAPTION_TEXT, "A cell sees itself: it is convex, and no wall is inside it.");
    } else if (e->distance == SL_NO_WAY) {
        snprintf(text, CAPTION_TEXT, "No portals lead from one cell to the other.");
    } else if (!sequence) {
        snprintf(text, CAPTION_TEXT, "No portal sequence that leads there has a sightline.");
    } else if (e->verdict == SL_STABBED) {
        snprintf(text, CAPTION_TEXT,
                 "The line passes %s, left ends at its left and right ends at its right.%s",
                 count == 1 ? "the portal that the cells share" : "every portal",
                 e->complete && count > 1 ? " No sightline there crosses fewer portals." : "");
    } else if (e->verdict == SL_GRAZING) {
        snprintf(text, CAPTION_TEXT,
                 "The line only grazes: it touches the large ends, and no line passes strictly "
                 "between them, for %s.",
                 sl_sequence_reason(space, sequence));
    } else if (pic->miss->turns) {
        char second[32] = "";
        if (sequence->end_count > 4)
            snprintf(second, sizeof second, " and portal %u", sequence->ends[2].portal + 1);
        snprintf(text, CAPTION_TEXT,
                 "Of all sequences that have a sightline this one comes nearest. It stops before "
                 "the crossed badge: that portal turns back, and no straight line crosses it and "
                 "portal %u%s all forwards.",
                 sequence->ends[0].portal + 1, second);
    } else {
        snprintf(text, CAPTION_TEXT,
                 "Of all sequences that have a sightline this one comes nearest. It stops before "
                 "the crossed badge: a line would have to keep the large left ends at its left and "
                 "the large right ends at its right, but %s.",
                 sl_sequence_reason(space, sequence));
    }
}

/// The title that was asked for, else one that is written into `text`.
static const char *title_of(const sli_explained *pic, char text[CAPTION_TEXT]) {
    const sl_explanation *e = pic->explanation;
    if (pic->scene.options.title) return pic->scene.options.title;
    if (e->from == e->to)
        snprintf(text, CAPTION_TEXT, "Why cell %u sees itself", e->from);
    else if (!e->complete && e->verdict == SL_HIDDEN)
        snprintf(text, CAPTION_TEXT, "Whether cell %u sees cell %u is not known", e->from, e->to);
    else
        snprintf(text, CAPTION_TEXT, "Why cell %u %s cell %u%s", e->from,
                 e->seen ? "sees" : "does not see", e->to,
                 e->bent.bends && !e->seen ? " but by mirror" : "");
    return text;
}

/// "closed sight · 5 portals · part of the map"
static void write_subtitle(const sli_explained *pic, char text[CAPTION_TEXT]) {
    const sl_explanation *e = pic->explanation;
    char portals[SL_COUNT_TEXT] = "", missing[SL_COUNT_TEXT + 40] = "";
    if (pic->sequence && !pic->miss)
        sl_text_count(pic->sequence->directed_count, "portal", portals);
    if (pic->miss) {
        sl_text_count(pic->miss->missing, "portal", portals);
        snprintf(missing, sizeof missing, "the nearest sequence is %s short", portals);
    }
    snprintf(text, CAPTION_TEXT, "%s sight%s%s%s%s", e->sight == SL_OPEN ? "open" : "closed",
             e->verdict == SL_GRAZING ? "  \xc2\xb7  only grazing" : "",
             portals[0] ? "  \xc2\xb7  " : "", pic->miss ? missing : portals,
             pic->part ? "  \xc2\xb7  part of the map" : "");
}

/// Breaks a text into lines of a width. Returns the height; draws only with `paint`.
static double set_lines(cairo_t *cairo, sl_colour colour, double left, double top, double width,
                        double size, const char *text, bool paint) {
    sl_text_font(cairo, size, false);
    const unsigned lines = paint ? sl_text_show_lines(cairo, colour, left, top + 1.1 * size, width,
                                                      LINE_HEIGHT * size, text)
                                 : sl_text_lines(cairo, width, text);
    return LINE_HEIGHT * size * lines;
}

// --- the key

static bool has_swatch(const sli_explained *pic, sli_swatch what) {
    if (what == SLI_BENT) return pic->explanation->bent.bends != NULL;
    if (!pic->sequence) return false;
    if (what == SLI_STOP || what == SLI_WAY) return pic->miss != NULL;
    return what != SLI_SIGHTLINE || pic->miss == NULL;
}

/// The marks with their meaning, in lines as they fit. Returns the height.
static double draw_key(cairo_t *cairo, const sli_explained *pic, double left, double top,
                       double width, double size, bool paint) {
    static const char *const words[SLI_SWATCHES] = {
        [SLI_LEFT_END] = "left end",       [SLI_RIGHT_END] = "right end",
        [SLI_CROSSED] = "portal crossed",  [SLI_STOP] = "portal that stops",
        [SLI_SIGHTLINE] = "sightline",     [SLI_WAY] = "way of the sequence",
        [SLI_BENT] = "sightline by mirror"};
    double x = left, y = top;
    bool any = false;
    sl_text_font(cairo, size, false);
    for (sli_swatch what = 0; what < SLI_SWATCHES; what++) {
        if (!has_swatch(pic, what)) continue;
        const double mark = what == SLI_LEFT_END || what == SLI_RIGHT_END ? 1 : 2;
        const double wide = (mark + 0.55) * size + sl_text_width(cairo, words[what]);
        if (any && x + wide > left + width) {
            x = left;
            y += 1.95 * size;
        }
        if (paint) {
            sli_explained_swatch(cairo, pic, what, x - (2 - mark) / 2 * size, y + 0.8 * size, size);
            sl_text_font(cairo, size, false);
            sl_text_show(cairo, pic->scene.palette.ink, x + (mark + 0.55) * size, y + 1.16 * size,
                         words[what]);
        }
        x += wide + 1.7 * size;
        any = true;
    }
    return any ? y + 1.95 * size - top : 0;
}

// --- the page

static void set_page(cairo_t *cairo, const void *what, sli_page *page, bool paint) {
    const sli_explained *pic = what;
    const sl_palette *palette = &pic->scene.palette;
    char title[CAPTION_TEXT], text[CAPTION_TEXT];
    write_subtitle(pic, text);
    const double top = sli_page_heading(cairo, page, palette, title_of(pic, title), text, paint);
    if (!paint) sli_page_place_plan(page, pic->frame, top, TALLEST);
    double y = page->key;
    y += draw_key(cairo, pic, page->margin, y, page->inner, page->text, paint);
    y += sli_draw_ground_key(cairo, &pic->scene, (sl_point){page->margin, y}, page->text, paint);
    write_caption(pic, text);
    y += 0.4 * page->text;
    y += set_lines(cairo, palette->ink, page->margin, y, page->inner, 1.05 * page->text, text,
                   paint);
    page->height = ceil(y + 0.7 * page->margin);
}

/// If only a part of the map is shown, a thin line marks its end.
static void draw_frame(cairo_t *cairo, const sli_explained *pic, const sl_frame *frame) {
    if (!pic->part) return;
    cairo_rectangle(cairo, frame->left, frame->top, frame->width, frame->height);
    sli_pen_stroke(cairo, pic->scene.palette.faint, frame->unit);
}

static sl_status draw_plan(sl_context *context, cairo_t *cairo, const void *what,
                           const sl_frame *frame) {
    const sli_explained *pic = what;
    SL_TRY(sli_explained_over_plan(context, cairo, pic, frame));
    draw_frame(cairo, pic, frame);
    return SL_OK;
}

static sl_status draw_file(sl_context *context, sli_explained *pic, const sli_paper_kind *kind,
                           const char *path) {
    char title[CAPTION_TEXT];
    SL_TRY(paint_cells(context, pic));
    choose_colours(pic);
    choose_frame(pic);
    const sli_page_parts parts = {.set = set_page,
                                  .draw_plan = draw_plan,
                                  .what = pic,
                                  .ground = pic->scene.palette.page,
                                  .title = title_of(pic, title)};
    return sli_page_write(context, &parts, pic->scene.options.width, kind, path);
}

sl_status sl_draw_explanation(sl_context *context, const sl_baked *baked,
                              const sl_explanation *explanation, const sl_draw_options *options,
                              const char *path) {
    const sli_paper_kind *kind;
    SL_TRY(sli_paper_kind_of(context, path, &kind));
    SL_TRY(sli_page_check_width(context, options->width));
    sl_draw_options plain = *options;
    plain.layers = SL_LAYER_CELLS | SL_LAYER_PORTALS | SL_LAYER_WALLS;
    plain.cell = explanation->from;
    sli_explained pic = {.explanation = explanation};
    if (explanation->sequence.directed_count) pic.sequence = &explanation->sequence;
    if (explanation->miss_count) {
        pic.miss = &explanation->misses[0];
        pic.sequence = &pic.miss->sequence;
    }
    SL_TRY(sli_scene_make(context, baked, &plain, NULL, &pic.scene));
    const sl_status status = draw_file(context, &pic, kind, path);
    sli_scene_clear(context, &pic.scene);
    return status;
}
