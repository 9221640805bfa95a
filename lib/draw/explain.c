/// The page of an explanation: a heading, the plan with what is told, a key, and a caption.
#include "draw/explain.h"

#include "draw/page.h"
#include "draw/text.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define CAPTION_TEXT 512
#define LINE_HEIGHT  1.5
#define TALLEST      1.1 ///< of the plan, in its width: the caption should not be far

// --- what is shown

/// Paints the cells that the sequence leads through and the cell looked at.
static sl_status paint_cells(sl_context *context, sl_told *told) {
    sl_scene *scene = &told->scene;
    const sl_space *space = &scene->baked->space;
    uint8_t *paint = sl_alloc_array(context, space->cell_count, sizeof *paint);
    if (!paint) return SL_NO_MEMORY;
    sl_scene_get_paint(scene, paint);
    const uint32_t inner = told->sequence ? told->sequence->directed_count - 1 : 0;
    for (uint32_t i = 0; i < inner; i++) {
        uint8_t *p = &paint[space->directed[told->sequence->directed[i]].cell];
        if (*p >= SL_PAINT_FLOOR && *p < SL_PAINT_SEEN) *p += SL_PAINT_SEEN - SL_PAINT_FLOOR;
    }
    if (told->explanation->from != told->explanation->to)
        paint[told->explanation->to] = SL_PAINT_DOUBTFUL;
    sl_scene_set_paint(scene, paint);
    sl_free(context, paint);
    return SL_OK;
}

static void choose_colours(sl_told *told) {
    sl_palette *palette = &told->scene.palette;
    told->left = palette->glass;
    told->right = palette->start;
    told->target = palette->door;
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

/// Both cells and all portals, with something about them; all of the map where that is most of it.
static void choose_frame(sl_told *told) {
    const sl_space *space = &told->scene.baked->space;
    const sl_box bounds = space->bounds;
    const double whole_x = bounds.max.x - bounds.min.x, whole_y = bounds.max.y - bounds.min.y;
    const sl_cell *from = &space->cells[told->explanation->from];
    sl_box box = {space->vertices[from->first_vertex], space->vertices[from->first_vertex]};
    include_cell(&box, space, told->explanation->from);
    include_cell(&box, space, told->explanation->to);
    for (uint32_t i = 0; told->sequence && i < told->sequence->directed_count; i++) {
        include(&box, space->directed[told->sequence->directed[i]].left);
        include(&box, space->directed[told->sequence->directed[i]].right);
    }
    const sl_bent_sightline *bent = &told->explanation->bent;
    for (uint32_t i = 0; bent->bends && i < bent->mirrors + 2; i++) include(&box, bent->bends[i]);
    const double wide = box.max.x - box.min.x, high = box.max.y - box.min.y;
    const double margin = 0.12 * fmax(wide, high);
    const double wanted_x = fmax(wide + 2 * margin, 0.95 * (high + 2 * margin));
    const double wanted_y = fmax(high + 2 * margin, 0.45 * wanted_x);
    widen(&box.min.x, &box.max.x, wanted_x, bounds.min.x, bounds.max.x);
    widen(&box.min.y, &box.max.y, wanted_y, bounds.min.y, bounds.max.y);
    const double share = (box.max.x - box.min.x) / whole_x * ((box.max.y - box.min.y) / whole_y);
    told->part = share < 0.65;
    told->frame = told->part ? box : bounds;
}

// --- words

/// What is to be learned from the picture.
static void write_caption(const sl_told *told, char text[CAPTION_TEXT]) {
    const sl_explanation *e = told->explanation;
    const sl_space *space = &told->scene.baked->space;
    const sl_sequence *sequence = told->sequence;
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
    } else if (told->miss->turns) {
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

/// The one asked for, or one that is written into `text`.
static const char *title_of(const sl_told *told, char text[CAPTION_TEXT]) {
    const sl_explanation *e = told->explanation;
    if (told->scene.options.title) return told->scene.options.title;
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
static void write_subtitle(const sl_told *told, char text[CAPTION_TEXT]) {
    const sl_explanation *e = told->explanation;
    char portals[SL_COUNT_TEXT] = "", missing[SL_COUNT_TEXT + 40] = "";
    if (told->sequence && !told->miss)
        sl_text_count(told->sequence->directed_count, "portal", portals);
    if (told->miss) {
        sl_text_count(told->miss->missing, "portal", portals);
        snprintf(missing, sizeof missing, "the nearest sequence is %s short", portals);
    }
    snprintf(text, CAPTION_TEXT, "%s sight%s%s%s%s", e->sight == SL_OPEN ? "open" : "closed",
             e->verdict == SL_GRAZING ? "  \xc2\xb7  only grazing" : "",
             portals[0] ? "  \xc2\xb7  " : "", told->miss ? missing : portals,
             told->part ? "  \xc2\xb7  part of the map" : "");
}

/// Sets a text in lines that are no wider than `width`. Returns the height; without `paint` nothing
/// is drawn.
static double set_lines(cairo_t *cairo, sl_colour colour, double left, double top, double width,
                        double size, const char *text, bool paint) {
    char line[CAPTION_TEXT] = "";
    double y = top;
    sl_text_font(cairo, size, false);
    for (const char *word = text; *word;) {
        const size_t length = strcspn(word, " "), used = strlen(line);
        snprintf(line + used, sizeof line - used, "%s%.*s", used ? " " : "", (int)length, word);
        if (used && sl_text_width(cairo, line) > width) {
            line[used] = '\0';
            if (paint) sl_text_show(cairo, colour, left, y + 1.1 * size, line);
            y += LINE_HEIGHT * size;
            snprintf(line, sizeof line, "%.*s", (int)length, word);
        }
        word += length;
        word += strspn(word, " ");
    }
    if (paint) sl_text_show(cairo, colour, left, y + 1.1 * size, line);
    return y + LINE_HEIGHT * size - top;
}

// --- the key

typedef enum swatch { LEFT_END, RIGHT_END, CROSSED, STOP, SIGHTLINE, WAY, BENT, SWATCHES } swatch;

static bool has_swatch(const sl_told *told, swatch what) {
    if (what == BENT) return told->explanation->bent.bends != NULL;
    if (!told->sequence) return false;
    if (what == STOP || what == WAY) return told->miss != NULL;
    return what != SIGHTLINE || told->miss == NULL;
}

static void draw_swatch(cairo_t *cairo, const sl_told *told, swatch what, double left,
                        double middle, double size) {
    const double right = left + 2 * size, unit = size / 14;
    const sl_point at = {left + size, middle};
    if (what == LEFT_END || what == RIGHT_END) {
        sl_mark_end(cairo, told, at, what == LEFT_END, 0.42 * size);
        return;
    }
    cairo_move_to(cairo, left, middle);
    cairo_line_to(cairo, right, middle);
    if (what == SIGHTLINE) sl_pen_sightline(cairo, told, unit);
    if (what == WAY) sl_pen_way(cairo, told, unit);
    if (what == BENT) sl_pen_bent(cairo, told, unit);
    if (what == CROSSED) sl_pen_crossed(cairo, told, unit);
    if (what == STOP) sl_pen_stop(cairo, told, unit);
    if (what == CROSSED || what == STOP)
        sl_mark_badge(cairo, told, at, 0.6 * size, what == CROSSED ? 1 : 0);
}

/// A line of marks and what they mean, or lines where they do not fit. Returns the height.
static double draw_key(cairo_t *cairo, const sl_told *told, double left, double top, double width,
                       double size, bool paint) {
    static const char *const words[SWATCHES] = {
        [LEFT_END] = "left end",       [RIGHT_END] = "right end", [CROSSED] = "portal crossed",
        [STOP] = "portal that stops",  [SIGHTLINE] = "sightline", [WAY] = "way of the sequence",
        [BENT] = "sightline by mirror"};
    double x = left, y = top;
    bool any = false;
    sl_text_font(cairo, size, false);
    for (swatch what = 0; what < SWATCHES; what++) {
        if (!has_swatch(told, what)) continue;
        const double mark = what == LEFT_END || what == RIGHT_END ? 1 : 2;
        const double wide = (mark + 0.55) * size + sl_text_width(cairo, words[what]);
        if (any && x + wide > left + width) {
            x = left;
            y += 1.95 * size;
        }
        if (paint) {
            draw_swatch(cairo, told, what, x - (2 - mark) / 2 * size, y + 0.8 * size, size);
            sl_text_font(cairo, size, false);
            sl_text_show(cairo, told->scene.palette.ink, x + (mark + 0.55) * size, y + 1.16 * size,
                         words[what]);
        }
        x += wide + 1.7 * size;
        any = true;
    }
    return any ? y + 1.95 * size - top : 0;
}

// --- the page

static void set_page(cairo_t *cairo, const void *what, sl_page *page, bool paint) {
    const sl_told *told = what;
    const sl_palette *palette = &told->scene.palette;
    char title[CAPTION_TEXT], text[CAPTION_TEXT];
    write_subtitle(told, text);
    const double top = sl_page_heading(cairo, page, palette, title_of(told, title), text, paint);
    if (!paint) sl_page_place_plan(page, told->frame, top, TALLEST);
    double y = page->key;
    y += draw_key(cairo, told, page->margin, y, page->inner, page->text, paint);
    write_caption(told, text);
    y += 0.4 * page->text;
    y += set_lines(cairo, palette->ink, page->margin, y, page->inner, 1.05 * page->text, text,
                   paint);
    page->height = ceil(y + 0.7 * page->margin);
}

/// Where only a part of the map is shown a thin line says where it ends.
static void draw_frame(cairo_t *cairo, const sl_told *told, const sl_frame *frame) {
    if (!told->part) return;
    cairo_rectangle(cairo, frame->left, frame->top, frame->width, frame->height);
    sl_set_colour(cairo, told->scene.palette.faint);
    cairo_set_line_width(cairo, frame->unit);
    cairo_stroke(cairo);
}

static sl_status draw_plan(sl_context *context, cairo_t *cairo, const void *what,
                           const sl_frame *frame) {
    const sl_told *told = what;
    SL_TRY(sl_draw_told(context, cairo, told, frame));
    draw_frame(cairo, told, frame);
    return SL_OK;
}

static sl_status draw_told_file(sl_context *context, sl_told *told, const sl_paper_kind *kind,
                                const char *path) {
    char title[CAPTION_TEXT];
    SL_TRY(paint_cells(context, told));
    choose_colours(told);
    choose_frame(told);
    const sl_page_parts parts = {.set = set_page,
                                 .draw_plan = draw_plan,
                                 .what = told,
                                 .ground = told->scene.palette.page,
                                 .title = title_of(told, title)};
    return sl_page_write(context, &parts, told->scene.options.width, kind, path);
}

sl_status sl_draw_explanation(sl_context *context, const sl_baked *baked,
                              const sl_explanation *explanation, const sl_draw_options *options,
                              const char *path) {
    const sl_paper_kind *kind;
    SL_TRY(sl_paper_kind_of(context, path, &kind));
    SL_TRY(sl_page_check_width(context, options->width));
    sl_draw_options plain = *options;
    plain.layers = SL_LAYER_CELLS | SL_LAYER_PORTALS | SL_LAYER_WALLS;
    plain.cell = explanation->from;
    sl_told told = {.explanation = explanation};
    if (explanation->sequence.directed_count) told.sequence = &explanation->sequence;
    if (explanation->miss_count) {
        told.miss = &explanation->misses[0];
        told.sequence = &told.miss->sequence;
    }
    SL_TRY(sl_scene_make(context, baked, &plain, &told.scene));
    const sl_status status = draw_told_file(context, &told, kind, path);
    sl_scene_destroy(context, &told.scene);
    return status;
}
