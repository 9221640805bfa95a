/// The picture of what an eye sees: a heading, the plan with the cells that each method keeps, the
/// eye with its cone, boxes that move, and a key with the methods' counts.
#include "draw/marks.h"
#include "draw/page.h"
#include "sight/cone.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

// --- boxes that move

/// Fills and strokes the path as a box.
static void ink(cairo_t *cairo, const sl_palette *palette, bool blocks, bool seen, double width) {
    const sl_colour c = blocks ? palette->wall : palette->object;
    const double dashes[2] = {2.5 * width, 2 * width};
    sl_set_colour(cairo, palette->page);
    cairo_fill_preserve(cairo);
    sli_set_faded(cairo, c, blocks ? 0.6 : 0.25);
    cairo_fill_preserve(cairo);
    sli_set_faded(cairo, c, 1);
    cairo_set_line_width(cairo, width);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_MITER);
    if (!seen) cairo_set_dash(cairo, dashes, 2, 0);
    cairo_stroke(cairo);
    cairo_set_dash(cairo, NULL, 0, 0);
}

/// What is seen directly, lighter than the rest.
static void draw_lit(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                     const sl_drawn_region *region) {
    if (region->count < 3) return;
    sl_path_polygon(cairo, frame, region->points, region->count);
    const sl_colour light = palette->page;
    sli_set_faded(cairo, light, 0.6);
    cairo_fill(cairo);
}

/// Those that block are full, those that are hidden dashed.
static void draw_boxes(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                       const sl_drawn_box *boxes, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const sl_box b = boxes[i].box;
        const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        sl_path_polygon(cairo, frame, corners, 4);
        ink(cairo, palette, boxes[i].blocks, boxes[i].seen, 2 * frame->unit);
    }
}

/// The key of these marks in one line, from a place on the page. Returns the height, 0 without
/// boxes. Draws only with `paint`.
static double draw_boxes_key(cairo_t *cairo, const sl_palette *palette, size_t count, sl_point at,
                             double size, bool paint) {
    static const struct {
        const char *text;
        bool blocks, seen;
    } entries[] = {{"object, seen", false, true},
                   {"hidden", false, false},
                   {"blocks sight", true, true},
                   {"blocks sight, hidden", true, false}};
    if (!count) return 0;
    const double top = at.y + 0.22 * size;
    double x = at.x;
    for (size_t i = 0; i < sizeof entries / sizeof *entries && paint; i++) {
        cairo_rectangle(cairo, x, top, 2 * size, 1.15 * size);
        ink(cairo, palette, entries[i].blocks, entries[i].seen, 0.12 * size);
        sl_text_font(cairo, size, false);
        sl_text_show(cairo, palette->ink, x + 2.55 * size, at.y + 1.16 * size, entries[i].text);
        x += 4.45 * size + sl_text_width(cairo, entries[i].text);
    }
    return 1.95 * size;
}

enum { KEY_TEXT = 256 };

typedef struct eye_picture {
    sl_scene scene;
    const sl_view *view;
    const sl_eye_layer *layers;
    size_t layer_count;
    const sl_drawn_region *parts;
    size_t part_count, direct_count; ///< those seen directly come first
    uint32_t counts[SL_EYE_LAYERS_MOST];
    double shares[SL_EYE_LAYERS_MOST]; ///< of the area shown
} eye_picture;

// --- what is shown

/// Layers take steps of the ramp, which goes by lightness: the loosest is the palest.
static uint8_t paint_of_layer(const eye_picture *p, size_t layer) {
    const double share = p->layer_count > 1 ? (double)layer / (double)(p->layer_count - 1) : 1;
    return (uint8_t)(SLI_PAINT_HEAT + (unsigned)((0.08 + 0.92 * share) * (SLI_HEAT_STEPS - 1)));
}

static sl_status paint_cells(sl_context *context, eye_picture *p) {
    const sl_space *space = &p->scene.baked->space;
    uint8_t *paint = sl_alloc_array(context, space->cell_count, sizeof *paint);
    if (!paint) return SL_NO_MEMORY;
    double whole = 0;
    sli_scene_get_paint(&p->scene, paint);
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        if (!sli_scene_shows(&p->scene, cell)) continue;
        const double area = sl_space_area(space, cell);
        whole += area;
        for (size_t i = 0; i < p->layer_count; i++) {
            if (!sl_bits_has(p->layers[i].cells, cell)) continue;
            paint[cell] = paint_of_layer(p, i);
            p->counts[i]++;
            p->shares[i] += area;
        }
    }
    for (size_t i = 0; i < p->layer_count && whole > 0; i++) p->shares[i] /= whole;
    sli_scene_set_paint(&p->scene, paint);
    sl_free(context, paint);
    return SL_OK;
}

// --- the eye

/// Degrees counter-clockwise from +x.
static double heading_to(sl_point from, sl_point to) {
    return atan2(to.y - from.y, to.x - from.x) * (360 / SLI_FULL_TURN);
}

static double width_of(const sl_view *view) {
    const double width =
        fmod(heading_to(view->eye, view->left) - heading_to(view->eye, view->right), 360);
    return width < 0 ? width + 360 : width;
}

/// The cone up to the border of the frame.
static void draw_cone(cairo_t *cairo, const eye_picture *p, const sl_frame *frame) {
    if (p->view->full) return;
    const sl_palette *palette = &p->scene.palette;
    const sl_point eye = sl_frame_point(frame, p->view->eye);
    const double reach = 2 * hypot(frame->width, frame->height);
    const double right = heading_to(p->view->eye, p->view->right) * (SLI_FULL_TURN / 360);
    const double left = right + width_of(p->view) * (SLI_FULL_TURN / 360);
    cairo_save(cairo);
    cairo_rectangle(cairo, frame->left, frame->top, frame->width, frame->height);
    cairo_clip(cairo);
    cairo_move_to(cairo, eye.x, eye.y);
    cairo_arc_negative(cairo, eye.x, eye.y, reach, -right, -left); // on the page y runs down
    cairo_close_path(cairo);
    sli_set_faded(cairo, palette->start, 0.06);
    cairo_fill_preserve(cairo);
    cairo_set_line_width(cairo, 1.6 * frame->unit);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_BEVEL);
    sl_set_colour(cairo, palette->start);
    cairo_stroke(cairo);
    cairo_restore(cairo);
}

static void draw_disc(cairo_t *cairo, const sl_palette *palette, sl_point at, double radius) {
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, at.x, at.y, radius, 0, SLI_FULL_TURN);
    cairo_set_line_width(cairo, 0.6 * radius);
    sl_set_colour(cairo, palette->page);
    cairo_stroke_preserve(cairo);
    sl_set_colour(cairo, palette->start);
    cairo_fill(cairo);
}

static void draw_eye_mark(cairo_t *cairo, const eye_picture *p, const sl_frame *frame) {
    sl_point at;
    if (sl_frame_holds(frame, p->view->eye, &at))
        draw_disc(cairo, &p->scene.palette, at, 6 * frame->unit);
}

// --- words

static void write_title(const eye_picture *p, char text[KEY_TEXT]) {
    char x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
    sl_number_write(p->view->eye.x, x);
    sl_number_write(p->view->eye.y, y);
    snprintf(text, KEY_TEXT, "What is seen from %s,%s", x, y);
}

static void write_subtitle(const eye_picture *p, char text[KEY_TEXT]) {
    const char *sight = p->scene.baked->visibility.sight == SL_OPEN ? "open" : "closed";
    char cone[96] = "all round";
    if (!p->view->full) {
        const double width = width_of(p->view);
        double middle = fmod(heading_to(p->view->eye, p->view->right) + width / 2 + 360, 360);
        middle = round(10 * middle) / 10;
        snprintf(cone, sizeof cone, "looking %g\xc2\xb0, a cone of %g\xc2\xb0",
                 middle < 360 ? middle : 0, round(10 * width) / 10);
    }
    if (p->scene.chosen)
        snprintf(text, KEY_TEXT, "%s  \xc2\xb7  cell %u  \xc2\xb7  %s sight", cone,
                 (unsigned)p->scene.options.cell, sight);
    else
        snprintf(text, KEY_TEXT, "%s  \xc2\xb7  outside the map", cone);
}

// --- the key

static void draw_swatch(cairo_t *cairo, const eye_picture *p, size_t entry, double left,
                        double middle, double size) {
    const double height = 1.15 * size, width = 2 * size;
    if (entry == p->layer_count) {
        draw_disc(cairo, &p->scene.palette, (sl_point){left + width / 2, middle}, 0.4 * size);
        return;
    }
    cairo_rectangle(cairo, left, middle - height / 2, width, height);
    sl_set_colour(cairo, sli_scene_colour(&p->scene, paint_of_layer(p, entry)));
    cairo_fill_preserve(cairo);
    sli_pen_stroke(cairo, p->scene.palette.outline, 0.06 * size);
}

/// "exact: 12 cells, 1.8 % of the area", the last entry for the eye.
static void write_entry(const eye_picture *p, size_t entry, char text[KEY_TEXT]) {
    if (entry == p->layer_count) {
        const bool pale = p->direct_count;
        snprintf(text, KEY_TEXT, "the eye%s%s%s", p->view->full ? "" : " and its cone",
                 pale ? "; pale: what it sees" : "",
                 pale && p->scene.options.box_count ? " past objects" : "");
        return;
    }
    char name[64], cells[SL_COUNT_TEXT], share[SL_COUNT_TEXT];
    snprintf(name, sizeof name, "%s", p->layers[entry].name);
    for (char *at = name; *at; at++)
        if (*at == '_') *at = ' ';
    sl_text_count(p->counts[entry], "cell", cells);
    sl_text_percent(p->shares[entry], share);
    snprintf(text, KEY_TEXT, "%s: %s, %s", name, cells, share);
}

/// The entries in lines as the width allows. Returns the height; draws only with `paint`.
static double draw_key(cairo_t *cairo, const eye_picture *p, double left, double top, double width,
                       double size, bool paint) {
    sli_key key = sli_key_at((sl_point){left, top}, width, size);
    for (size_t i = 0; i <= p->layer_count; i++) {
        char text[KEY_TEXT];
        write_entry(p, i, text);
        const sl_point at = sli_key_entry(cairo, p->scene.palette.ink, &key, text, paint);
        if (paint) draw_swatch(cairo, p, i, at.x, at.y + 0.8 * size, size);
    }
    return sli_key_end(&key) - top;
}

// --- the page

static void set_page(cairo_t *cairo, const void *what, sli_page *page, bool paint) {
    const eye_picture *p = what;
    const sl_palette *palette = &p->scene.palette;
    const size_t box_count = p->scene.options.box_count;
    char title[KEY_TEXT], subtitle[KEY_TEXT];
    write_title(p, title);
    write_subtitle(p, subtitle);
    const char *own = p->scene.options.title;
    const double top = sli_page_heading(cairo, page, palette, own ? own : title, subtitle, paint);
    if (!paint) sli_page_place_plan(page, p->scene.baked->space.bounds, top, SLI_PAGE_TALLEST);
    double y = page->key;
    y += draw_key(cairo, p, page->margin, y, page->inner, page->text, paint);
    // The key of layers has what is seen directly.
    const size_t mirrored = p->part_count - p->direct_count;
    y += sli_draw_seen_key(cairo, palette, mirrored ? p->parts + p->direct_count : NULL, mirrored,
                           (sl_point){page->margin, y}, page->inner, page->text, paint);
    y += draw_boxes_key(cairo, palette, box_count, (sl_point){page->margin, y}, page->text, paint);
    y += sli_draw_ground_key(cairo, &p->scene, (sl_point){page->margin, y}, page->text, paint);
    page->height = ceil(y + 0.5 * page->margin);
}

static sl_status draw_plan(sl_context *context, cairo_t *cairo, const void *what,
                           const sl_frame *frame) {
    const eye_picture *p = what;
    const sl_draw_options *options = &p->scene.options;
    SL_TRY(sl_draw_plan(context, cairo, &p->scene, options->layers, frame));
    for (size_t i = 0; i < p->part_count; i++) {
        (p->parts[i].depth ? sli_draw_seen : draw_lit)(cairo, &p->scene.palette, frame,
                                                       &p->parts[i]);
    }
    if (p->part_count) SL_TRY(sl_draw_walls(context, cairo, &p->scene, frame));
    draw_boxes(cairo, &p->scene.palette, frame, options->boxes, options->box_count);
    draw_cone(cairo, p, frame);
    draw_eye_mark(cairo, p, frame);
    return SL_OK;
}

static sl_status draw_picture(sl_context *context, eye_picture *p, const sli_paper_kind *kind,
                              const char *path) {
    char title[KEY_TEXT];
    write_title(p, title);
    SL_TRY(paint_cells(context, p));
    const sli_page_parts parts = {.set = set_page,
                                  .draw_plan = draw_plan,
                                  .what = p,
                                  .ground = p->scene.palette.page,
                                  .title = title};
    return sli_page_write(context, &parts, p->scene.options.width, kind, path);
}

sl_status sl_draw_eye(sl_context *context, const sl_baked *baked, const sl_view *view,
                      const sl_eye_layer *layers, size_t layer_count, const sl_drawn_region *parts,
                      size_t part_count, const sl_draw_options *options, const char *path) {
    const sli_paper_kind *kind;
    SL_TRY(sli_paper_kind_of(context, path, &kind));
    if (layer_count > SL_EYE_LAYERS_MOST)
        return sl_fail(context, SL_BAD_ARGUMENT, "%zu layers: only %d have colours of their own",
                       layer_count, SL_EYE_LAYERS_MOST);
    if (!sli_view_usable(view))
        return sl_fail(context, SL_BAD_ARGUMENT, "the view to be drawn is none");
    SL_TRY(sli_page_check_width(context, options->width));
    sl_draw_options plain = *options;
    plain.layers = SL_LAYER_CELLS | SL_LAYER_PORTALS | SL_LAYER_WALLS;
    plain.cell = sl_space_locate(&baked->space, view->eye);
    if (plain.cell != SL_NO_CELL && baked->space.cells[plain.cell].solid) plain.cell = SL_NO_CELL;
    eye_picture p = {.view = view,
                     .layers = layers,
                     .layer_count = layer_count,
                     .parts = parts,
                     .part_count = part_count};
    while (p.direct_count < part_count && !parts[p.direct_count].depth) p.direct_count++;
    SL_TRY(sli_scene_make(context, baked, &plain, NULL, &p.scene));
    // Green would be lost among the ramp's colours.
    p.scene.palette.portal = sl_colour_mix(p.scene.palette.wall, p.scene.palette.page, 0.2);
    const sl_status status = draw_picture(context, &p, kind, path);
    sli_scene_clear(context, &p.scene);
    return status;
}
