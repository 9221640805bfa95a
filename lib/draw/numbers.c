/// The numbers of cells and portals, over the plan.
///
/// The number of a cell stands in its middle, if it fits between the cell's sides. A large size is
/// tried first, then a small one. The number of a portal has a "p" before it. It stands on the
/// portal, if the portal is longer than the text and no other number is there. So a number is never
/// read as that of a neighbour, and a plan of tiny cells has none. Zooming in brings them.
///
/// Time: cells and portals in the frame, times the numbers that found room.
#include "draw/marks.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

/// Sizes of text, in units of the frame.
static const double sizes[] = {11, 8.5};

enum { NUMBERS_MOST = 4096, NUMBER_TEXT = 16 };

typedef struct numbers {
    cairo_t *cairo;
    const sl_scene *scene;
    const sl_frame *frame;
    sl_box placed[NUMBERS_MOST];
    size_t count;
} numbers;

/// Whether a point of the page lies in the frame.
static bool on_page(const sl_frame *frame, sl_point at) {
    return at.x >= frame->left && at.x <= frame->left + frame->width && at.y >= frame->top &&
           at.y <= frame->top + frame->height;
}

/// Whether a box of the page lies in a cell. The cell is convex: its corners decide.
static bool fits_cell(const numbers *n, const sl_cell *cell, sl_box box) {
    const sl_point *corners = n->scene->baked->space.vertices + cell->first_vertex;
    const sl_point at[4] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point a = sl_frame_point(n->frame, corners[i]);
        const sl_point b =
            sl_frame_point(n->frame, corners[i + 1 < cell->vertex_count ? i + 1 : 0]);
        // On the page y runs down: the inside is at the other hand.
        for (int k = 0; k < 4; k++)
            if ((b.x - a.x) * (at[k].y - a.y) - (b.y - a.y) * (at[k].x - a.x) > 0) return false;
    }
    return true;
}

static bool is_free(const numbers *n, sl_box box) {
    for (size_t i = 0; i < n->count; i++) {
        const sl_box p = n->placed[i];
        if (box.min.x < p.max.x && p.min.x < box.max.x && box.min.y < p.max.y &&
            p.min.y < box.max.y)
            return false;
    }
    return n->count < NUMBERS_MOST;
}

/// The place of a text about a point, in the font that is set, with some room around it.
static sl_box box_about(const numbers *n, sl_point at, double size, const char *text) {
    const double wide = sl_text_width(n->cairo, text) / 2 + 0.2 * size, high = 0.6 * size;
    return (sl_box){{at.x - wide, at.y - high}, {at.x + wide, at.y + high}};
}

/// Draws on a rim in the paper's colour.
static void show(numbers *n, sl_box box, double size, sl_colour colour, const char *text) {
    const sl_colour page = n->scene->palette.page;
    const double x = box.min.x + 0.2 * size, y = (box.min.y + box.max.y) / 2 + 0.36 * size;
    cairo_move_to(n->cairo, x, y);
    cairo_text_path(n->cairo, text);
    sli_set_faded(n->cairo, page, 0.75);
    cairo_set_line_width(n->cairo, 0.28 * size);
    cairo_set_line_join(n->cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(n->cairo);
    sl_text_show(n->cairo, colour, x, y, text);
    n->placed[n->count++] = box;
}

static void draw_cell_number(numbers *n, uint32_t number) {
    const sl_space *space = &n->scene->baked->space;
    const sl_cell *cell = &space->cells[number];
    const sl_point at = sl_frame_point(n->frame, sl_space_middle(space, number));
    char text[NUMBER_TEXT];
    if (!sli_scene_shows(n->scene, number) || !on_page(n->frame, at)) return;
    snprintf(text, sizeof text, "%u", number);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const double size = sizes[i] * n->frame->unit;
        sl_text_font(n->cairo, size, false);
        const sl_box box = box_about(n, at, size, text);
        if (!fits_cell(n, cell, box) || !is_free(n, box)) continue;
        show(n, box, size, n->scene->palette.ink, text);
        return;
    }
}

static void draw_portal_number(numbers *n, uint32_t number) {
    const sl_portal *portal = &n->scene->baked->space.portals[number];
    const sl_point left = sl_frame_point(n->frame, portal->left);
    const sl_point right = sl_frame_point(n->frame, portal->right);
    const sl_point at = {(left.x + right.x) / 2, (left.y + right.y) / 2};
    const double size = sizes[1] * n->frame->unit;
    char text[NUMBER_TEXT];
    if (!sli_scene_shows(n->scene, portal->cell[0]) || !on_page(n->frame, at)) return;
    snprintf(text, sizeof text, "p%u", number);
    sl_text_font(n->cairo, size, false);
    const sl_box box = box_about(n, at, size, text);
    if (hypot(left.x - right.x, left.y - right.y) < 1.2 * (box.max.x - box.min.x)) return;
    if (!is_free(n, box)) return;
    show(n, box, size, sl_colour_mix(n->scene->palette.portal, n->scene->palette.ink, 0.35), text);
}

void sli_draw_numbers(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame) {
    numbers n = {.cairo = cairo, .scene = scene, .frame = frame};
    const sl_space *space = &scene->baked->space;
    for (uint32_t i = 0; i < space->cell_count; i++) draw_cell_number(&n, i);
    for (uint32_t i = 0; i < space->portal_count; i++) draw_portal_number(&n, i);
}
