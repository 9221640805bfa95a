#include "draw/plan.h"

#include "draw/faults.h"
#include "draw/marks.h"
#include "effects/mirrors.h"
#include "sightline/support.h"
#include "space/ray.h"

#include <math.h>

/// What every layer draws with.
typedef struct plan {
    cairo_t *cairo;
    const sl_scene *scene;
    const sl_space *space;
    const sl_map *map;
    const sl_frame *frame;
    const sl_palette *palette;
    sl_pens pens;
} plan;

static void add_cell(const plan *p, uint32_t cell) {
    const sl_cell *c = &p->space->cells[cell];
    sl_path_polygon(p->cairo, p->frame, p->space->vertices + c->first_vertex, c->vertex_count);
}

/// What is not shown: all of the bounds, hatched like cut masonry; cells are painted over it.
static void draw_ground(const plan *p) {
    const uint32_t *begin = p->scene->paint_begin;
    if (begin[SL_PAINT_NONE + 1] == begin[SL_PAINT_NONE]) return;
    const sl_box guard = sl_frame_guard(p->frame);
    const sl_point low = sl_frame_point(p->frame, p->space->bounds.min);
    const sl_point high = sl_frame_point(p->frame, p->space->bounds.max);
    const sl_box box = {{fmax(low.x, guard.min.x), fmax(high.y, guard.min.y)},
                        {fmin(high.x, guard.max.x), fmin(low.y, guard.max.y)}};
    if (!(box.min.x < box.max.x && box.min.y < box.max.y)) return;
    sl_set_colour(p->cairo, p->palette->ground);
    cairo_rectangle(p->cairo, box.min.x, box.min.y, box.max.x - box.min.x, box.max.y - box.min.y);
    cairo_fill(p->cairo);
    sl_mark_hatch(p->cairo, p->palette, box, 9 * p->frame->unit, low.x + low.y);
}

/// Cells of one colour make one path. Its thin stroke closes the seams that smoothed edges leave
/// between neighbours.
static void draw_cells(const plan *p) {
    for (unsigned paint = SL_PAINT_NONE + 1; paint < SL_PAINT_COUNT; paint++) {
        const uint32_t first = p->scene->paint_begin[paint], end = p->scene->paint_begin[paint + 1];
        if (first == end) continue;
        for (uint32_t i = first; i < end; i++) add_cell(p, p->scene->order[i]);
        sl_set_colour(p->cairo, sl_scene_colour(p->scene, paint));
        cairo_fill_preserve(p->cairo);
        cairo_set_line_width(p->cairo, 0.6);
        cairo_set_line_join(p->cairo, CAIRO_LINE_JOIN_MITER);
        cairo_stroke(p->cairo);
    }
}

static void draw_outlines(const plan *p) {
    for (unsigned paint = SL_PAINT_NONE + 1; paint < SL_PAINT_COUNT; paint++)
        for (uint32_t i = p->scene->paint_begin[paint]; i < p->scene->paint_begin[paint + 1]; i++)
            add_cell(p, p->scene->order[i]);
    sl_pen_outline(p->cairo, p->palette, &p->pens);
}

static void draw_portals(const plan *p) {
    for (uint32_t i = 0; i < p->space->portal_count; i++) {
        const sl_portal *portal = &p->space->portals[i];
        if (sl_scene_shows(p->scene, portal->cell[0]))
            sl_path_segment(p->cairo, p->frame, portal->left, portal->right);
    }
    sl_pen_portal(p->cairo, p->palette, &p->pens);
}

static void draw_source_edge(const plan *p) {
    if (!p->scene->chosen) return;
    add_cell(p, p->scene->options.cell);
    sl_pen_source_edge(p->cairo, p->palette, &p->pens);
}

static void draw_walls(const plan *p) {
    sl_point a, b;
    for (uint32_t i = 0; i < p->space->wall_count; i++)
        sl_path_segment(p->cairo, p->frame, p->space->walls[i].a, p->space->walls[i].b);
    sl_pen_wall(p->cairo, p->palette, &p->pens);
    for (size_t i = 0; i < p->map->door_count; i++) {
        const sl_door *door = &p->map->doors[i];
        if (sl_frame_segment(p->frame, door->segment.a, door->segment.b, &a, &b))
            sl_mark_door(p->cairo, p->palette, &p->pens, a, b, door->open);
    }
    for (size_t i = 0; i < p->map->mirror_count; i++)
        if (sl_frame_segment(p->frame, p->map->mirrors[i].segment.a, p->map->mirrors[i].segment.b,
                             &a, &b))
            sl_mark_mirror(p->cairo, p->palette, &p->pens, a, b);
    for (size_t i = 0; i < p->map->oneway_count; i++)
        if (sl_frame_segment(p->frame, p->map->oneways[i].segment.a, p->map->oneways[i].segment.b,
                             &a, &b))
            sl_mark_oneway(p->cairo, p->palette, &p->pens, a, b);
}

/// Where a stroke of the stab tree begins or ends: a portal or a mirror, in the cell that the
/// stroke is in.
typedef struct joint {
    sl_directed_portal ends; ///< as crossed on the way out of the cell
    sl_point place;          ///< on it
} joint;

/// Reflected sequences keep to one side of portals: what comes back does not hide what went.
static sl_point place_on(const sl_directed_portal *ends, double share) {
    return (sl_point){ends->left.x + share * (ends->right.x - ends->left.x),
                      ends->left.y + share * (ends->right.y - ends->left.y)};
}

static joint joint_at(const plan *p, const sl_stroke *stroke, uint32_t directed, bool entered) {
    if (directed >= SL_STAB_MIRROR) {
        sl_mirror_side side = {0};
        sl_mirror_side_of(p->space, p->map, stroke->cell, directed - SL_STAB_MIRROR, &side);
        const sl_directed_portal ends = {.left = side.left, .right = side.right};
        return (joint){ends, place_on(&ends, 0.5)};
    }
    const sl_directed_portal *at = &p->space->directed[directed];
    const sl_point place = place_on(at, stroke->mirrored ? 0.3 : 0.5);
    if (entered) return (joint){{.left = at->right, .right = at->left}, place};
    return (joint){*at, place};
}

/// Where a stroke that crosses a portal at right angles may bend: into the cell from its place on
/// the portal, along the portal's normal. Both such points and both places lie in the convex cell,
/// and so does the curve between them.
static sl_point bend(const sl_space *space, uint32_t cell, const joint *at, double reach) {
    const sl_point left = at->ends.left, right = at->ends.right, place = at->place;
    const double along_x = left.x - right.x, along_y = left.y - right.y;
    const double width = hypot(along_x, along_y);
    const sl_point inwards = {-along_y / width, along_x / width};
    const double length = fmin(reach, 0.9 * sl_ray_length(space, cell, place, inwards));
    return (sl_point){place.x + inwards.x * length, place.y + inwards.y * length};
}

static void add_stroke(const plan *p, const sl_stroke *stroke) {
    const joint to = joint_at(p, stroke, stroke->to, false);
    joint from = {.place = p->scene->eye};
    if (stroke->from != UINT32_MAX) from = joint_at(p, stroke, stroke->from, true);
    const sl_point start = from.place, end = to.place;
    const double reach = 0.4 * hypot(end.x - start.x, end.y - start.y);
    const sl_point leaving =
        stroke->from == UINT32_MAX ? start : bend(p->space, stroke->cell, &from, reach);
    const sl_point controls[4] = {start, leaving, bend(p->space, stroke->cell, &to, reach), end};
    sl_path_curve(p->cairo, p->frame, controls);
}

/// Where the stroke crosses its portal or meets its mirror.
static void add_dot(const plan *p, const sl_stroke *stroke) {
    const double radius = 0.75 * sl_tree_width(&p->pens, stroke->depth - 1);
    sl_point place;
    if (!sl_frame_holds(p->frame, joint_at(p, stroke, stroke->to, false).place, &place)) return;
    cairo_new_sub_path(p->cairo);
    cairo_arc(p->cairo, place.x, place.y, radius, 0, 6.283185307179586);
}

static void draw_tree(const plan *p) {
    const sl_stroke *strokes = p->scene->strokes;
    for (size_t first = 0, end; first < p->scene->stroke_count; first = end) {
        const uint32_t depth = strokes[first].depth;
        const bool mirrored = strokes[first].mirrored;
        const sl_colour colour = mirrored ? p->palette->mirrored : p->palette->tree;
        for (end = first; end < p->scene->stroke_count && strokes[end].depth == depth &&
                          strokes[end].mirrored == mirrored;
             end++)
            add_stroke(p, &strokes[end]);
        sl_pen_tree(p->cairo, colour, &p->pens, depth - 1);
        for (size_t i = first; i < end; i++) add_dot(p, &strokes[i]);
        sl_pen_tree_dots(p->cairo, colour, depth - 1);
    }
}

static void draw_objects(const plan *p) {
    for (size_t i = 0; i < p->map->object_count; i++) {
        const sl_box box = p->map->objects[i].box;
        const sl_point corners[4] = {
            box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
        sl_path_polygon(p->cairo, p->frame, corners, 4);
    }
    sl_pen_object(p->cairo, p->palette, &p->pens);
}

static void draw_starts(const plan *p) {
    draw_objects(p);
    for (size_t i = 0; i < p->map->path_count; i++) {
        const sl_path *path = &p->map->paths[i];
        for (size_t k = 1; k < path->count; k++)
            sl_path_segment(p->cairo, p->frame, path->points[k - 1], path->points[k]);
    }
    sl_pen_path(p->cairo, p->palette, &p->pens);
    for (size_t i = 0; i < p->map->start_count; i++) {
        sl_point place;
        if (sl_frame_holds(p->frame, p->map->starts[i].at, &place))
            sl_mark_start(p->cairo, p->palette, place, p->map->starts[i].heading, p->pens.mark);
    }
}

static void draw_fault_marks(const plan *p) {
    if (p->scene->options.faults)
        sl_draw_faults(p->cairo, p->palette, &p->pens, p->frame, p->scene->options.faults);
}

typedef struct step {
    unsigned layers; ///< any of them calls for it; 0: always
    void (*draw)(const plan *p);
} step;

static const step steps[] = {
    {0, draw_ground},
    {0, draw_cells},
    {SL_LAYER_CELLS, draw_outlines},
    {0, draw_source_edge},
    {SL_LAYER_PORTALS, draw_portals},
    {SL_LAYER_STAB_TREE, draw_tree},
    {SL_LAYER_WALLS, draw_walls},
    {SL_LAYER_STARTS, draw_starts},
    {0, draw_fault_marks},
};
enum { STEPS = sizeof steps / sizeof *steps, WALLS_STEP = STEPS - 3 };

static sl_status draw_steps(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                            const sl_frame *frame, int first) {
    const plan p = {.cairo = cairo,
                    .scene = scene,
                    .space = &scene->baked->space,
                    .map = &scene->baked->map,
                    .frame = frame,
                    .palette = &scene->palette,
                    .pens = sl_pens_for(scene, frame)};
    for (int i = first; i < STEPS; i++) {
        SL_TRY(sl_check_cancelled(context));
        if (!steps[i].layers || scene->options.layers & steps[i].layers) steps[i].draw(&p);
    }
    return SL_OK;
}

sl_status sl_draw_onto(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                       const sl_frame *frame) {
    return draw_steps(context, cairo, scene, frame, 0);
}

sl_status sl_draw_walls_onto(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                             const sl_frame *frame) {
    return draw_steps(context, cairo, scene, frame, WALLS_STEP);
}

void sl_draw_tree_onto(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame) {
    const plan p = {.cairo = cairo,
                    .scene = scene,
                    .space = &scene->baked->space,
                    .map = &scene->baked->map,
                    .frame = frame,
                    .palette = &scene->palette,
                    .pens = sl_pens_for(scene, frame)};
    draw_tree(&p);
}
