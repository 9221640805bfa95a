/// Figures for lessons: a subdivision in the making. It is shown as the splits of a kd-tree, or as
/// the triangles and cells of a mesh.
#include "draw/draw_lesson.h"
#include "draw/marks.h"
#include "sightline/support.h"

static void fill(cairo_t *cairo, const sl_frame *frame, const sl_point *corners, size_t count,
                 sl_colour c, double opacity) {
    sl_path_polygon(cairo, frame, corners, count);
    sli_set_faded(cairo, c, opacity);
    cairo_fill(cairo);
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
        sli_pen_stroke(cairo, sl_palette_ramp(palette->dark, 1 - 0.75 * share),
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
    sli_pen_stroke(cairo, palette->portal, 1.2 * frame->unit);
    fill_box(cairo, frame, now->below, palette->glass, 0.22);
    fill_box(cairo, frame, now->above, palette->source, 0.30);
    sl_path_segment(cairo, frame, now->along.a, now->along.b);
    sli_pen_stroke(cairo, palette->start, 4 * frame->unit);
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
    cairo_arc(cairo, at.x, at.y, radius * frame->unit, 0, SLI_FULL_TURN);
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
    sli_pen_stroke(cairo, palette->portal, 1.2 * frame->unit);
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
    sli_pen_stroke(cairo, palette->start, 6 * frame->unit);
}

void sli_draw_mesh_triangles(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                             const sli_mesh_steps *steps) {
    draw_sides(cairo, palette, frame, &steps->triangles);
    add_fresh(cairo, frame, steps, false);
    sli_pen_stroke(cairo, palette->glass, 2.6 * frame->unit);
    add_fresh(cairo, frame, steps, true);
    sli_pen_stroke(cairo, palette->start, 6 * frame->unit);
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
    sli_pen_stroke(cairo, palette->faint, 0.9 * frame->unit);
    cairo_set_dash(cairo, NULL, 0, 0);
    for (size_t i = 0; i < place && i < steps->sides.count; i++)
        if (steps->sides.items[i].stuck != SLI_OUTSIDE)
            add_edge(cairo, frame, t, steps->sides.items[i].half / 2);
    sli_pen_stroke(cairo, palette->portal, 1.6 * frame->unit);
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
    sli_pen_stroke(cairo, palette->start, 4 * frame->unit);
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
    sli_pen_stroke(cairo, palette->mirrored, 3.4 * frame->unit);
    draw_disc(cairo, frame, corner[1], 6.5);
    sl_set_colour(cairo, palette->mirrored);
    cairo_fill(cairo);
}
