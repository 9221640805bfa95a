/// Figures for lessons. One shows a subdivision in the making: the splits of a kd-tree, or the
/// triangles and cells of a mesh. The other shows the dual plane of a portal sequence: each line of
/// the map is a point there, each portal end a half-plane, and the lines through all portals are a
/// convex polygon.
#include "draw/lesson.h"
#include "draw/marks.h"
#include "sightline/support.h"

#include <math.h>

#define FULL_TURN 6.283185307179586

static void fill(cairo_t *cairo, const sl_frame *frame, const sl_point *corners, size_t count,
                 sl_colour c, double opacity) {
    sl_path_polygon(cairo, frame, corners, count);
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, opacity);
    cairo_fill(cairo);
}

/// Strokes the path.
static void stroke(cairo_t *cairo, sl_colour colour, double width) {
    sl_set_colour(cairo, colour);
    cairo_set_line_width(cairo, width);
    cairo_stroke(cairo);
}

// --- a kd-tree

void sli_draw_splits(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                     const sli_split *splits, uint32_t count, uint32_t depth) {
    uint32_t deepest = 0;
    for (uint32_t i = 0; i < count; i++)
        if (splits[i].depth >= deepest) deepest = splits[i].depth + 1;
    if (depth < deepest) deepest = depth;
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    for (uint32_t level = deepest; level-- > 0;) {
        const double share = deepest > 1 ? (double)level / (deepest - 1) : 0;
        for (uint32_t i = 0; i < count; i++)
            if (splits[i].depth == level)
                sl_path_segment(cairo, frame, splits[i].along.a, splits[i].along.b);
        stroke(cairo, sl_palette_ramp(palette->dark, 1 - 0.75 * share),
               (3.2 - 2.2 * share) * frame->unit);
    }
}

static void fill_box(cairo_t *cairo, const sl_frame *frame, sl_box b, sl_colour colour,
                     double opacity) {
    const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
    fill(cairo, frame, corners, 4, colour, opacity);
}

void sli_draw_split(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                    const sli_split *splits, uint32_t node) {
    const sli_split *now = &splits[node];
    for (uint32_t i = 0; i < node; i++)
        sl_path_segment(cairo, frame, splits[i].along.a, splits[i].along.b);
    stroke(cairo, palette->portal, 1.2 * frame->unit);
    fill_box(cairo, frame, now->below, palette->glass, 0.22);
    fill_box(cairo, frame, now->above, palette->source, 0.30);
    sl_path_segment(cairo, frame, now->along.a, now->along.b);
    stroke(cairo, palette->start, 4 * frame->unit);
}

// --- a mesh

static sl_point start_of(const sli_triangulation *t, uint32_t half) {
    return t->points.items[t->halves.items[half].from];
}

static void add_edge(cairo_t *cairo, const sl_frame *frame, const sli_triangulation *t,
                     size_t edge) {
    const uint32_t half = (uint32_t)(2 * edge);
    sl_path_segment(cairo, frame, start_of(t, half), start_of(t, half + 1));
}

static void draw_disc(cairo_t *cairo, const sl_frame *frame, sl_point point, double radius) {
    sl_point at;
    if (!sl_frame_holds(frame, point, &at)) return;
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, at.x, at.y, radius * frame->unit, 0, FULL_TURN);
}

void sli_draw_mesh_points(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                          const sli_mesh_steps *steps) {
    const sli_triangulation *t = &steps->triangles;
    for (size_t i = 0; i < t->points.count; i++) draw_disc(cairo, frame, t->points.items[i], 3.5);
    sl_set_colour(cairo, palette->start);
    cairo_fill(cairo);
}

static void draw_sides(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                       const sli_triangulation *t) {
    for (size_t i = 0; i < t->halves.count / 2; i++) add_edge(cairo, frame, t, i);
    stroke(cairo, palette->portal, 1.2 * frame->unit);
}

/// Adds sides that the points alone do not have: with `lines` walls and seams, else the others.
static void add_fresh(cairo_t *cairo, const sl_frame *frame, const sli_mesh_steps *steps,
                      bool lines) {
    const sli_triangulation *t = &steps->triangles;
    for (size_t i = 0; i < t->halves.count / 2; i++)
        if (steps->fresh[i] && (t->labels[i] != 0) == lines) add_edge(cairo, frame, t, i);
}

void sli_draw_mesh_delaunay(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                            const sli_mesh_steps *steps) {
    draw_sides(cairo, palette, frame, &steps->delaunay);
    add_fresh(cairo, frame, steps, true);
    stroke(cairo, palette->start, 6 * frame->unit);
}

void sli_draw_mesh_triangles(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                             const sli_mesh_steps *steps) {
    draw_sides(cairo, palette, frame, &steps->triangles);
    add_fresh(cairo, frame, steps, false);
    stroke(cairo, palette->glass, 2.6 * frame->unit);
    add_fresh(cairo, frame, steps, true);
    stroke(cairo, palette->start, 6 * frame->unit);
}

/// Fills the cell at the left of a half-edge.
static sl_status fill_cell(sl_context *context, cairo_t *cairo, const sl_frame *frame,
                           const sli_mesh_steps *steps, size_t place, uint32_t half,
                           sl_colour colour, double opacity) {
    SL_ARRAY(sl_point) corners = {0};
    uint32_t at = half;
    do {
        const sl_status status = SL_ARRAY_ROOM(context, &corners, 1);
        if (status != SL_OK) {
            sl_free(context, corners.items);
            return status;
        }
        corners.items[corners.count++] = start_of(&steps->triangles, at);
        at = sli_mesh_steps_next(steps, place, at);
    } while (at != half);
    fill(cairo, frame, corners.items, corners.count, colour, opacity);
    sl_free(context, corners.items);
    return SL_OK;
}

/// Draws the sides before the one at `place` is tried: those that stay, and those still to be
/// tried.
static void draw_cells(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                       const sli_mesh_steps *steps, size_t place) {
    const sli_triangulation *t = &steps->triangles;
    static const double dashes[2] = {1.5, 2.5};
    for (size_t i = place; i < steps->sides.count; i++)
        add_edge(cairo, frame, t, steps->sides.items[i].half / 2);
    cairo_set_dash(cairo, dashes, 2, 0);
    stroke(cairo, palette->faint, 0.9 * frame->unit);
    cairo_set_dash(cairo, NULL, 0, 0);
    for (size_t i = 0; i < place && i < steps->sides.count; i++)
        if (steps->sides.items[i].stuck != SLI_OUTSIDE)
            add_edge(cairo, frame, t, steps->sides.items[i].half / 2);
    stroke(cairo, palette->portal, 1.6 * frame->unit);
}

sl_status sli_draw_mesh_side(sl_context *context, cairo_t *cairo, const sl_palette *palette,
                             const sl_frame *frame, const sli_mesh_steps *steps, size_t place) {
    if (place >= steps->sides.count) {
        draw_cells(cairo, palette, frame, steps, place);
        return SL_OK;
    }
    const sli_mesh_side *side = &steps->sides.items[place];
    const bool stays = side->stuck != SLI_OUTSIDE;
    const double dashes[2] = {8 * frame->unit, 6 * frame->unit};
    SL_TRY(fill_cell(context, cairo, frame, steps, place, side->half, palette->glass, 0.22));
    SL_TRY(fill_cell(context, cairo, frame, steps, place, side->half ^ 1,
                     stays ? palette->source : palette->glass, stays ? 0.30 : 0.22));
    draw_cells(cairo, palette, frame, steps, place);
    add_edge(cairo, frame, &steps->triangles, side->half / 2);
    if (!stays) cairo_set_dash(cairo, dashes, 2, 0);
    stroke(cairo, palette->start, 4 * frame->unit);
    cairo_set_dash(cairo, NULL, 0, 0);
    return SL_OK;
}

void sli_draw_mesh_corner(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                          const sli_mesh_steps *steps, size_t place) {
    sl_point corner[3];
    if (place >= steps->sides.count || steps->sides.items[place].stuck == SLI_OUTSIDE) return;
    sli_mesh_steps_corner(steps, place, corner);
    sl_path_segment(cairo, frame, corner[0], corner[1]);
    sl_path_segment(cairo, frame, corner[1], corner[2]);
    stroke(cairo, palette->mirrored, 3.4 * frame->unit);
    draw_disc(cairo, frame, corner[1], 6.5);
    sl_set_colour(cairo, palette->mirrored);
    cairo_fill(cairo);
}

// --- the dual plane

sl_dual_frame sl_dual_frame_fit(const sl_dual *before, double left, double top, double width,
                                double height, double unit) {
    sl_dual_line low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < before->corner_count; i++) {
        low.slope = fmin(low.slope, before->corners[i].slope);
        low.height = fmin(low.height, before->corners[i].height);
        high.slope = fmax(high.slope, before->corners[i].slope);
        high.height = fmax(high.height, before->corners[i].height);
    }
    if (!before->corner_count) {
        low = (sl_dual_line){-1, -1};
        high = (sl_dual_line){1, 1};
    }
    // Steep lines would make all others small.
    low.slope = fmax(low.slope, fmin(-2.5, high.slope - 0.5));
    high.slope = fmin(high.slope, fmax(2.5, low.slope + 0.5));
    low.height = fmax(low.height, fmin(-2.5, high.height - 0.5));
    high.height = fmin(high.height, fmax(2.5, low.height + 0.5));
    const double wide = 0.35 * fmax(high.slope - low.slope, 1e-6);
    const double tall = 0.35 * fmax(high.height - low.height, 1e-6);
    return (sl_dual_frame){.left = left,
                           .top = top,
                           .width = width,
                           .height = height,
                           .unit = unit,
                           .low = {low.slope - wide, low.height - tall},
                           .high = {high.slope + wide, high.height + tall}};
}

static sl_point frame_point(const sl_dual_frame *f, sl_dual_line line) {
    const double x = (line.slope - f->low.slope) / (f->high.slope - f->low.slope);
    const double y = (line.height - f->low.height) / (f->high.height - f->low.height);
    return (sl_point){fmin(fmax(f->left + x * f->width, -1e5), 1e5),
                      fmin(fmax(f->top + (1 - y) * f->height, -1e5), 1e5)};
}

sl_dual_line sl_dual_frame_line(const sl_dual_frame *f, sl_point page) {
    const double x = (page.x - f->left) / f->width, y = 1 - (page.y - f->top) / f->height;
    return (sl_dual_line){f->low.slope + x * (f->high.slope - f->low.slope),
                          f->low.height + y * (f->high.height - f->low.height)};
}

/// The border of an end's half-plane, across the frame.
static void add_border(cairo_t *cairo, const sl_dual_frame *f, sl_point end) {
    const double a = f->low.slope, b = f->high.slope;
    const sl_point from = frame_point(f, (sl_dual_line){a, end.y - a * end.x});
    const sl_point to = frame_point(f, (sl_dual_line){b, end.y - b * end.x});
    cairo_move_to(cairo, from.x, from.y);
    cairo_line_to(cairo, to.x, to.y);
}

/// Short strokes on the forbidden side of an end.
static void add_teeth(cairo_t *cairo, const sl_dual_frame *f, sl_point end, bool left) {
    for (int i = 1; i < 14; i++) {
        const double a = f->low.slope + (f->high.slope - f->low.slope) * i / 14;
        const sl_point at = frame_point(f, (sl_dual_line){a, end.y - a * end.x});
        cairo_move_to(cairo, at.x, at.y);
        cairo_line_to(cairo, at.x + 3 * f->unit, at.y + (left ? -6 : 6) * f->unit);
    }
}

static void draw_borders(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                         const sl_dual *dual, const sl_portal_ends *portals, uint32_t count) {
    for (int side = 0; side < 2; side++) {
        const bool left = side == 0;
        const sl_colour colour = left ? palette->glass : palette->start;
        for (uint32_t i = 0; i < count; i++) {
            const sl_point end = sl_dual_point(dual, left ? portals[i].left : portals[i].right);
            const bool last = i + 1 == count;
            add_border(cairo, f, end);
            cairo_set_source_rgba(cairo, colour.red, colour.green, colour.blue, last ? 1 : 0.55);
            cairo_set_line_width(cairo, (last ? 2.2 : 1.1) * f->unit);
            cairo_stroke(cairo);
            if (!last) continue;
            add_teeth(cairo, f, end, left);
            cairo_set_line_width(cairo, 1.1 * f->unit);
            cairo_stroke(cairo);
        }
    }
}

static void draw_polygon(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                         const sl_dual *dual) {
    if (!dual->corner_count) return;
    cairo_new_path(cairo);
    for (uint32_t i = 0; i < dual->corner_count; i++) {
        const sl_point at = frame_point(f, dual->corners[i]);
        cairo_line_to(cairo, at.x, at.y);
    }
    cairo_close_path(cairo);
    const sl_colour c = palette->portal;
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, 0.3);
    cairo_fill_preserve(cairo);
    sl_set_colour(cairo, c);
    cairo_set_line_width(cairo, 1.6 * f->unit);
    cairo_stroke(cairo);
}

/// A bar at the optimum, as high as the line can move up and down.
static void draw_best(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                      const sl_dual *dual) {
    const double m = fmax(dual->margin, 0);
    const sl_point at = frame_point(f, dual->best);
    const sl_point over = frame_point(f, (sl_dual_line){dual->best.slope, dual->best.height + m});
    const sl_point under = frame_point(f, (sl_dual_line){dual->best.slope, dual->best.height - m});
    sl_set_colour(cairo, palette->ink);
    cairo_set_line_width(cairo, 1.2 * f->unit);
    cairo_move_to(cairo, over.x, over.y);
    cairo_line_to(cairo, under.x, under.y);
    cairo_move_to(cairo, at.x - 5 * f->unit, at.y);
    cairo_line_to(cairo, at.x + 5 * f->unit, at.y);
    cairo_stroke(cairo);
}

void sl_draw_dual(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                  const sl_dual *dual, const sl_portal_ends *portals, uint32_t count,
                  sl_dual_line chosen) {
    cairo_save(cairo);
    cairo_rectangle(cairo, f->left, f->top, f->width, f->height);
    cairo_clip(cairo);
    sl_set_colour(cairo, palette->floor[0]);
    cairo_paint(cairo);
    draw_polygon(cairo, palette, f, dual);
    draw_borders(cairo, palette, f, dual, portals, count);
    draw_best(cairo, palette, f, dual);
    const sl_point at = frame_point(f, chosen);
    cairo_arc(cairo, at.x, at.y, 5.5 * f->unit, 0, 6.283185307179586);
    sl_set_colour(cairo, palette->page);
    cairo_set_line_width(cairo, 3 * f->unit);
    cairo_stroke_preserve(cairo);
    sl_set_colour(cairo, palette->ink);
    cairo_fill(cairo);
    cairo_restore(cairo);
}
