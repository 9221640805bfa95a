/// The plan of a baked map. A scene is computed once: the paint of each cell, the counts, the
/// strokes of the stab tree. Its layers are then drawn through any number of frames, in files and
/// in windows.
///
/// Cells of one paint make one path, so that a plan needs few calls of cairo. Strokes that several
/// sequences share are drawn once, at their least depth. A stroke bends so that it crosses portals
/// at right angles. It stays in its cell, which is convex.
#include "draw/draw_plan.h"
#include "draw/live.h"
#include "draw/marks.h"
#include "effects/mirrors.h"
#include "sightline/support.h"
#include "space/index.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the scene

/// Scratch while a scene is made.
typedef struct maker {
    const sl_baked *baked;
    const sl_stab_trees *trees;
    uint8_t *paint;      ///< by cell
    double *area_before; ///< of cells shown, up to each cell; the last entry is all of it
} maker;

sl_colour sli_scene_colour(const sl_scene *scene, unsigned paint) {
    const sl_palette *palette = &scene->palette;
    if (paint >= SLI_PAINT_HEAT)
        return sl_palette_ramp(palette->dark,
                               (double)(paint - SLI_PAINT_HEAT) / (SLI_HEAT_STEPS - 1));
    if (paint == SLI_PAINT_SOURCE) return palette->source;
    if (paint == SLI_PAINT_DOUBTFUL) return palette->doubtful;
    if (paint >= SLI_PAINT_SEEN) return palette->seen[paint - SLI_PAINT_SEEN];
    if (paint >= SLI_PAINT_FLOOR) return palette->floor[paint - SLI_PAINT_FLOOR];
    if (paint == SLI_PAINT_SOLID) return palette->solid;
    return palette->ground;
}

uint32_t sl_scene_tree_depth(const sl_scene *scene) {
    return scene->tree_depth;
}

bool sli_scene_shows(const sl_scene *scene, uint32_t cell) {
    return !scene->baked->space.cells[cell].solid &&
           sl_baked_counts(scene->baked, cell) != scene->outside;
}

/// Whether a cell is shown although it is outside. It is so where the map has no starts, since then
/// the cells outside count too.
static bool is_hatched(const sl_scene *scene, uint32_t cell) {
    return !scene->outside && !scene->baked->space.cells[cell].inside &&
           sli_scene_shows(scene, cell);
}

/// Whether a table of rows belongs to the space.
static bool has_rows(const sl_pvs *pvs, const sl_space *space) {
    return pvs->cell_count == space->cell_count && pvs->offsets;
}

static void find_population(maker *m, sl_scene *scene) {
    const sl_space *space = &m->baked->space;
    scene->outside = scene->chosen && !space->cells[scene->options.cell].solid &&
                     !sl_baked_counts(m->baked, scene->options.cell);
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const bool shown = sli_scene_shows(scene, cell);
        scene->population += shown;
        scene->solid += space->cells[cell].solid;
        scene->hatched += is_hatched(scene, cell);
        m->area_before[cell + 1] = m->area_before[cell] + (shown ? sl_space_area(space, cell) : 0);
    }
    for (uint32_t i = 0; i < space->portal_count; i++)
        scene->portals += sli_scene_shows(scene, space->portals[i].cell[0]);
    if (scene->population)
        scene->cell_size = sqrt(m->area_before[space->cell_count] / scene->population);
}

/// Gives each cell the first tone that no neighbour with a lower number has; if all are taken, one
/// by its number.
static void choose_tones(maker *m, const sl_scene *scene) {
    const sl_space *space = &m->baked->space;
    const bool plain = !(scene->options.layers & SL_LAYER_CELLS);
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const sl_cell *c = &space->cells[cell];
        if (c->solid) m->paint[cell] = SLI_PAINT_SOLID;
        if (!sli_scene_shows(scene, cell)) continue;
        unsigned taken = 0, tone = 0;
        for (uint32_t i = 0; i < c->directed_count && !plain; i++) {
            const uint32_t next = space->directed[c->first_directed + i].cell;
            if (next < cell && m->paint[next] != SLI_PAINT_NONE)
                taken |= 1u << (m->paint[next] - SLI_PAINT_FLOOR);
        }
        while (tone < SL_TONES && taken >> tone & 1) tone++;
        m->paint[cell] = (uint8_t)(SLI_PAINT_FLOOR + (tone < SL_TONES ? tone : cell % SL_TONES));
    }
}

static void paint_seen(maker *m, sl_scene *scene) {
    const sl_visibility *visibility = &m->baked->visibility;
    const uint32_t source = scene->options.cell;
    double area = 0;
    for (sl_pvs_run r = sl_pvs_begin(&visibility->pvs, source); sl_pvs_next(&r);) {
        area += m->area_before[r.end] - m->area_before[r.first];
        for (uint32_t cell = r.first; cell < r.end; cell++) {
            const unsigned tone =
                m->paint[cell] >= SLI_PAINT_FLOOR ? m->paint[cell] - SLI_PAINT_FLOOR : 0;
            m->paint[cell] = (uint8_t)(SLI_PAINT_SEEN + tone);
            if (sli_scene_shows(scene, cell))
                scene->seen++;
            else
                scene->seen_beyond++;
        }
    }
    const double whole = m->area_before[m->baked->space.cell_count];
    scene->seen_share = whole > 0 ? area / whole : 0;
    if (!has_rows(&visibility->doubtful, &m->baked->space)) return;
    for (sl_pvs_run r = sl_pvs_begin(&visibility->doubtful, source); sl_pvs_next(&r);)
        for (uint32_t cell = r.first; cell < r.end; cell++) {
            m->paint[cell] = SLI_PAINT_DOUBTFUL;
            scene->doubtful++;
        }
}

/// Paints each cell by the share of the area that it sees, from the smallest share to the largest.
static sl_status paint_heat(sl_context *context, maker *m, sl_scene *scene) {
    const sl_space *space = &m->baked->space;
    const double whole = m->area_before[space->cell_count];
    double *shares = sl_alloc_array(context, space->cell_count, sizeof *shares);
    if (!shares) return SL_NO_MEMORY;
    scene->least = 1;
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        if (!sli_scene_shows(scene, cell)) continue;
        for (sl_pvs_run r = sl_pvs_begin(&m->baked->visibility.pvs, cell); sl_pvs_next(&r);)
            shares[cell] += (m->area_before[r.end] - m->area_before[r.first]) / whole;
        scene->least = fmin(scene->least, shares[cell]);
        scene->most = fmax(scene->most, shares[cell]);
        scene->mean += shares[cell] * (m->area_before[cell + 1] - m->area_before[cell]) / whole;
    }
    // Where all see the same there is nothing to tell apart but from nothing.
    if (scene->most - scene->least < 1e-6) scene->least = 0;
    const double range = scene->most - scene->least;
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        if (!sli_scene_shows(scene, cell)) continue;
        const double value = range > 0 ? (shares[cell] - scene->least) / range : 0;
        const double step = fmin(fmax(value, 0), 1) * (SLI_HEAT_STEPS - 1) + 0.5;
        m->paint[cell] = (uint8_t)(SLI_PAINT_HEAT + (unsigned)step);
    }
    sl_free(context, shares);
    return SL_OK;
}

void sli_scene_get_paint(const sl_scene *scene, uint8_t *paint) {
    for (unsigned p = 0; p < SLI_PAINT_COUNT; p++)
        for (uint32_t i = scene->paint_begin[p]; i < scene->paint_begin[p + 1]; i++)
            paint[scene->order[i]] = (uint8_t)p;
}

void sli_scene_set_paint(sl_scene *scene, const uint8_t *paint) {
    const uint32_t count = scene->baked->space.cell_count;
    uint32_t at[SLI_PAINT_COUNT];
    memset(scene->paint_begin, 0, sizeof scene->paint_begin);
    for (uint32_t cell = 0; cell < count; cell++) scene->paint_begin[paint[cell] + 1]++;
    for (unsigned p = 0; p < SLI_PAINT_COUNT; p++) {
        scene->paint_begin[p + 1] += scene->paint_begin[p];
        at[p] = scene->paint_begin[p];
    }
    for (uint32_t cell = 0; cell < count; cell++) scene->order[at[paint[cell]]++] = cell;
}

static int by_depth(const void *a, const void *b) {
    const sli_stroke *x = a, *y = b;
    if (x->depth != y->depth) return x->depth < y->depth ? 1 : -1;
    if (x->mirrored != y->mirrored) return x->mirrored ? -1 : 1;
    if (x->from != y->from) return x->from < y->from ? -1 : 1;
    if (x->to != y->to) return x->to < y->to ? -1 : 1;
    return x->cell < y->cell ? -1 : x->cell > y->cell;
}

static int by_place(const void *a, const void *b) {
    const sli_stroke *x = a, *y = b;
    if (x->from != y->from) return x->from < y->from ? -1 : 1;
    if (x->to != y->to) return x->to < y->to ? -1 : 1;
    if (x->mirrored != y->mirrored) return x->mirrored ? 1 : -1;
    if (x->cell != y->cell) return x->cell < y->cell ? -1 : 1;
    return x->depth < y->depth ? -1 : x->depth > y->depth;
}

static bool is_same_stroke(const sli_stroke *x, const sli_stroke *y) {
    return x->from == y->from && x->to == y->to && x->mirrored == y->mirrored && x->cell == y->cell;
}

/// Finds the stroke to each node. The root has one too, which is dropped later: its children read
/// its depth.
static void find_strokes(const sl_stab_node *nodes, size_t count, sl_scene *scene) {
    sli_stroke *strokes = scene->strokes;
    strokes[0] = (sli_stroke){.from = UINT32_MAX, .to = UINT32_MAX};
    for (size_t i = 1; i < count; i++) {
        const sl_stab_node *from = &nodes[nodes[i].parent];
        const sli_stroke *parent = &strokes[nodes[i].parent];
        strokes[i] = (sli_stroke){.from = parent->to,
                                  .to = nodes[i].directed,
                                  .depth = parent->depth + 1,
                                  .cell = from->cell,
                                  .mirrored = parent->mirrored || sl_stab_is_mirror(from)};
        scene->mirrored_nodes += strokes[i].mirrored || sl_stab_is_mirror(&nodes[i]);
        if (strokes[i].depth > scene->tree_depth) scene->tree_depth = strokes[i].depth;
    }
}

static sl_status make_strokes(sl_context *context, const sl_stab_trees *trees, sl_scene *scene) {
    const uint32_t source = scene->options.cell;
    if (trees->cell_count != scene->baked->space.cell_count || !trees->offsets) return SL_OK;
    const sl_stab_node *nodes = trees->nodes + trees->offsets[source];
    const size_t count = (size_t)(trees->offsets[source + 1] - trees->offsets[source]);
    if (count == 0) return SL_OK;
    scene->tree_nodes = count;
    sli_stroke *strokes = scene->strokes = sl_alloc_array(context, count, sizeof *strokes);
    if (!strokes) return SL_NO_MEMORY;
    find_strokes(nodes, count, scene);
    qsort(strokes, count, sizeof *strokes, by_place);
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        const bool again = kept && is_same_stroke(&strokes[kept - 1], &strokes[i]);
        if (!again && strokes[i].to != UINT32_MAX) strokes[kept++] = strokes[i];
    }
    qsort(strokes, kept, sizeof *strokes, by_depth);
    scene->stroke_count = kept;
    return SL_OK;
}

static sl_point find_eye(const sl_baked *baked, uint32_t cell) {
    for (size_t i = 0; i < baked->map.start_count; i++)
        if (sl_space_locate(&baked->space, baked->map.starts[i].at) == cell)
            return baked->map.starts[i].at;
    return sl_space_middle(&baked->space, cell);
}

static sl_status fill(sl_context *context, maker *m, sl_scene *scene) {
    const sl_draw_options *options = &scene->options;
    find_population(m, scene);
    choose_tones(m, scene);
    if (options->layers & SL_LAYER_PVS && has_rows(&m->baked->visibility.pvs, &m->baked->space)) {
        scene->shows_seen = scene->chosen;
        scene->heat = !scene->chosen && scene->population > 0;
    }
    if (scene->shows_seen) paint_seen(m, scene);
    if (scene->heat) {
        // Green would be lost among the ramp's colours.
        scene->palette.portal = sl_colour_mix(scene->palette.wall, scene->palette.page, 0.2);
        SL_TRY(paint_heat(context, m, scene));
    }
    if (scene->chosen) {
        m->paint[options->cell] = SLI_PAINT_SOURCE;
        scene->eye = find_eye(m->baked, options->cell);
    }
    sli_scene_set_paint(scene, m->paint);
    if (scene->chosen && options->layers & SL_LAYER_STAB_TREE)
        SL_TRY(make_strokes(context, m->trees, scene));
    return SL_OK;
}

sl_status sli_scene_make(sl_context *context, const sl_baked *baked, const sl_draw_options *options,
                         const sl_stab_trees *trees, sl_scene *out) {
    const size_t count = baked->space.cell_count;
    sl_scene scene = {.baked = baked,
                      .options = *options,
                      .palette = sl_palette_make(options->dark),
                      .chosen = options->cell != SL_NO_CELL};
    maker m = {.baked = baked,
               .trees = trees ? trees : &baked->visibility.trees,
               .paint = sl_alloc_array(context, count, sizeof *m.paint),
               .area_before = sl_alloc_array(context, count + 1, sizeof *m.area_before)};
    scene.order = sl_alloc_array(context, count, sizeof *scene.order);
    sl_status status = SL_NO_MEMORY;
    if (m.paint && m.area_before && scene.order) status = fill(context, &m, &scene);
    sl_free(context, m.paint);
    sl_free(context, m.area_before);
    if (status == SL_OK)
        *out = scene;
    else
        sli_scene_clear(context, &scene);
    return status;
}

void sli_scene_clear(sl_context *context, sl_scene *scene) {
    sl_free(context, scene->order);
    sl_free(context, scene->strokes);
    memset(scene, 0, sizeof *scene);
}

sl_status sli_scene_check_cell(sl_context *context, const sl_baked *baked, uint32_t cell) {
    if (cell == SL_NO_CELL) return SL_OK;
    if (cell >= baked->space.cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "cell %u: the map has %u cells", cell,
                       baked->space.cell_count);
    if (baked->space.cells[cell].solid)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "cell %u is solid ground, from where nobody looks: choose a cell in a room",
                       cell);
    return SL_OK;
}

sl_status sl_scene_create(sl_context *context, const sl_baked *baked,
                          const sl_draw_options *options, const sl_stab_trees *trees,
                          sl_scene **out) {
    SL_TRY(sli_scene_check_cell(context, baked, options->cell));
    sl_scene *scene = sl_alloc_array(context, 1, sizeof *scene);
    if (!scene) return SL_NO_MEMORY;
    const sl_status status = sli_scene_make(context, baked, options, trees, scene);
    if (status == SL_OK)
        *out = scene;
    else
        sl_free(context, scene);
    return status;
}

void sl_scene_destroy(sl_context *context, sl_scene *scene) {
    if (!scene) return;
    sli_scene_clear(context, scene);
    sl_free(context, scene);
}

// --- the layers

/// What every layer needs.
typedef struct plan {
    sl_context *context; ///< asked whether to go on; NULL: goes on
    cairo_t *cairo;
    const sl_scene *scene;
    const sl_space *space;
    const sl_map *map;
    const sl_frame *frame;
    const sl_palette *palette;
    sli_pens pens;
} plan;

static void add_cell(const plan *p, uint32_t cell) {
    const sl_cell *c = &p->space->cells[cell];
    sl_path_polygon(p->cairo, p->frame, p->space->vertices + c->first_vertex, c->vertex_count);
}

/// Fills the map's bounds with `ground` (NULL: not), and hatches them like cut masonry.
static void hatch_bounds(const plan *p, const sl_colour *ground, const sl_palette *palette) {
    const sl_box guard = sli_frame_guard(p->frame);
    const sl_point low = sl_frame_point(p->frame, p->space->bounds.min);
    const sl_point high = sl_frame_point(p->frame, p->space->bounds.max);
    const sl_box box = {{fmax(low.x, guard.min.x), fmax(high.y, guard.min.y)},
                        {fmin(high.x, guard.max.x), fmin(low.y, guard.max.y)}};
    if (!(box.min.x < box.max.x && box.min.y < box.max.y)) return;
    if (ground) {
        sl_set_colour(p->cairo, *ground);
        cairo_rectangle(p->cairo, box.min.x, box.min.y, box.max.x - box.min.x,
                        box.max.y - box.min.y);
        cairo_fill(p->cairo);
    }
    sli_mark_hatch(p->cairo, palette, box, 9 * p->frame->unit, low.x + low.y);
}

/// What is not shown. Cells are painted over it.
static void draw_ground(const plan *p) {
    const uint32_t *begin = p->scene->paint_begin;
    if (begin[SLI_PAINT_NONE + 1] > begin[SLI_PAINT_NONE])
        hatch_bounds(p, &p->palette->ground, p->palette);
}

/// cairo needs far more than twice the time for a path of twice the length. A path of a large map
/// is drawn in parts of this many cells or segments.
enum { PART = 1000 };

/// Whether drawing is to end: asked after each part.
static bool is_stopped(const plan *p) {
    return p->context && sl_check_cancelled(p->context) != SL_OK;
}

static void fill_paint(const plan *p, unsigned paint) {
    sl_set_colour(p->cairo, sli_scene_colour(p->scene, paint));
    cairo_fill_preserve(p->cairo);
    cairo_set_line_width(p->cairo, 0.6);
    cairo_set_line_join(p->cairo, CAIRO_LINE_JOIN_MITER);
    cairo_stroke(p->cairo);
}

/// Cells of one colour make one path. A thin stroke covers the seams that smoothed edges leave
/// between them.
static void draw_paint(const plan *p, unsigned paint) {
    const uint32_t first = p->scene->paint_begin[paint], end = p->scene->paint_begin[paint + 1];
    for (uint32_t i = first; i < end; i++) {
        add_cell(p, p->scene->order[i]);
        const bool full = (i - first) % PART == PART - 1;
        if (full || i + 1 == end) fill_paint(p, paint);
        if (full && is_stopped(p)) return;
    }
}

/// Hatches the cells outside that are shown, so that they are told apart from those inside.
static void draw_outside(const plan *p) {
    sl_palette palette = *p->palette;
    if (!p->scene->hatched) return;
    cairo_save(p->cairo);
    for (uint32_t cell = 0; cell < p->space->cell_count; cell++)
        if (is_hatched(p->scene, cell)) add_cell(p, cell);
    cairo_clip(p->cairo);
    palette.hatch = palette.outline;
    hatch_bounds(p, NULL, &palette);
    cairo_restore(p->cairo);
}

static void draw_cells(const plan *p) {
    for (unsigned paint = SLI_PAINT_NONE + 1; paint < SLI_PAINT_COUNT; paint++)
        draw_paint(p, paint);
    draw_outside(p);
}

static void draw_outlines(const plan *p) {
    const uint32_t first = p->scene->paint_begin[SLI_PAINT_SOLID + 1];
    for (uint32_t i = first; i < p->scene->paint_begin[SLI_PAINT_COUNT]; i++) {
        add_cell(p, p->scene->order[i]);
        if ((i - first) % PART != PART - 1) continue;
        sli_pen_outline(p->cairo, p->palette, &p->pens);
        if (is_stopped(p)) return;
    }
    sli_pen_outline(p->cairo, p->palette, &p->pens);
}

static void draw_portals(const plan *p) {
    for (uint32_t i = 0; i < p->space->portal_count; i++) {
        const sl_portal *portal = &p->space->portals[i];
        if (sli_scene_shows(p->scene, portal->cell[0]))
            sl_path_segment(p->cairo, p->frame, portal->left, portal->right);
        if (i % PART != PART - 1) continue;
        sli_pen_portal(p->cairo, p->palette, &p->pens);
        if (is_stopped(p)) return;
    }
    sli_pen_portal(p->cairo, p->palette, &p->pens);
}

static void draw_source_edge(const plan *p) {
    if (!p->scene->chosen) return;
    add_cell(p, p->scene->options.cell);
    sli_pen_source_edge(p->cairo, p->palette, &p->pens);
}

/// Walls that the space does not have. A wall that stops all may lie on a part of one, and is drawn
/// over it.
static void draw_open_walls(const plan *p) {
    sl_point a, b;
    for (size_t i = 0; i < p->map->seam_count; i++) {
        const sl_glass *wall = &p->map->seams[i];
        if (!wall->stops || wall->stops & sl_map_channel(p->map)) continue;
        if (sli_frame_segment(p->frame, wall->segment.a, wall->segment.b, &a, &b))
            sli_mark_partial(p->cairo, p->palette, &p->pens, a, b,
                             sli_partial_of(p->map, wall->stops));
    }
}

static void draw_walls(const plan *p) {
    sl_point a, b;
    draw_open_walls(p);
    for (uint32_t i = 0; i < p->space->wall_count; i++) {
        sl_path_segment(p->cairo, p->frame, p->space->walls[i].a, p->space->walls[i].b);
        if (i % PART != PART - 1) continue;
        sli_pen_wall(p->cairo, p->palette, &p->pens);
        if (is_stopped(p)) return;
    }
    sli_pen_wall(p->cairo, p->palette, &p->pens);
    for (uint32_t i = 0; i < p->space->passage_count; i++) {
        const sl_wall *wall = &p->space->walls[p->space->passages[i].wall];
        if (sli_frame_segment(p->frame, wall->a, wall->b, &a, &b))
            sli_mark_partial(p->cairo, p->palette, &p->pens, a, b, SLI_PARTIAL_WALL);
    }
    for (size_t i = 0; i < p->map->door_count; i++) {
        const sl_door *door = &p->map->doors[i];
        if (sli_frame_segment(p->frame, door->segment.a, door->segment.b, &a, &b))
            sli_mark_door(p->cairo, p->palette, &p->pens, a, b, door->open);
    }
    for (size_t i = 0; i < p->map->mirror_count; i++)
        if (sli_frame_segment(p->frame, p->map->mirrors[i].segment.a, p->map->mirrors[i].segment.b,
                              &a, &b))
            sli_mark_mirror(p->cairo, p->palette, &p->pens, a, b);
    for (size_t i = 0; i < p->map->oneway_count; i++)
        if (sli_frame_segment(p->frame, p->map->oneways[i].segment.a, p->map->oneways[i].segment.b,
                              &a, &b))
            sli_mark_oneway(p->cairo, p->palette, &p->pens, a, b);
}

/// An end of a stroke of the stab tree: a portal or a mirror, in the cell of the stroke.
typedef struct joint {
    sl_directed_portal ends; ///< as crossed on the way out of the cell
    sl_point place;          ///< on it
} joint;

/// Reflected sequences cross portals off the middle, so that the way back does not hide the way
/// there.
static sl_point place_on(const sl_directed_portal *ends, double share) {
    return (sl_point){ends->left.x + share * (ends->right.x - ends->left.x),
                      ends->left.y + share * (ends->right.y - ends->left.y)};
}

static joint joint_at(const plan *p, const sli_stroke *stroke, uint32_t directed, bool entered) {
    if (directed >= SL_STAB_MIRROR) {
        sli_mirror_side side = {0};
        sli_mirror_side_of(p->space, p->map, stroke->cell, directed - SL_STAB_MIRROR, &side);
        const sl_directed_portal ends = {.left = side.left, .right = side.right};
        return (joint){ends, place_on(&ends, 0.5)};
    }
    const sl_directed_portal *at = &p->space->directed[directed];
    const sl_point place = place_on(at, stroke->mirrored ? 0.3 : 0.5);
    if (entered) return (joint){{.left = at->right, .right = at->left}, place};
    return (joint){*at, place};
}

/// The control point of a stroke that crosses a portal at right angles: from its place on the
/// portal into the cell, along the portal's normal. All four points lie in the convex cell, and so
/// does the curve.
static sl_point bend(const sl_space *space, uint32_t cell, const joint *at, double reach) {
    const sl_point left = at->ends.left, right = at->ends.right, place = at->place;
    const double along_x = left.x - right.x, along_y = left.y - right.y;
    const double width = hypot(along_x, along_y);
    const sl_point inwards = {-along_y / width, along_x / width};
    const double length = fmin(reach, 0.9 * sli_ray_length(space, cell, place, inwards));
    return (sl_point){place.x + inwards.x * length, place.y + inwards.y * length};
}

static void add_stroke(const plan *p, const sli_stroke *stroke) {
    const joint to = joint_at(p, stroke, stroke->to, false);
    joint from = {.place = p->scene->eye};
    if (stroke->from != UINT32_MAX) from = joint_at(p, stroke, stroke->from, true);
    const sl_point start = from.place, end = to.place;
    const double reach = 0.4 * hypot(end.x - start.x, end.y - start.y);
    const sl_point leaving =
        stroke->from == UINT32_MAX ? start : bend(p->space, stroke->cell, &from, reach);
    const sl_point controls[4] = {start, leaving, bend(p->space, stroke->cell, &to, reach), end};
    sli_path_curve(p->cairo, p->frame, controls);
}

/// A dot where the stroke crosses its portal or meets its mirror.
static void add_dot(const plan *p, const sli_stroke *stroke) {
    const double radius = 0.75 * sli_tree_width(&p->pens, stroke->depth - 1);
    sl_point place;
    if (!sl_frame_holds(p->frame, joint_at(p, stroke, stroke->to, false).place, &place)) return;
    cairo_new_sub_path(p->cairo);
    cairo_arc(p->cairo, place.x, place.y, radius, 0, SLI_FULL_TURN);
}

static void draw_tree(const plan *p) {
    const sli_stroke *strokes = p->scene->strokes;
    for (size_t first = 0, end; first < p->scene->stroke_count; first = end) {
        const uint32_t depth = strokes[first].depth;
        const bool mirrored = strokes[first].mirrored;
        const sl_colour colour = mirrored ? p->palette->mirrored : p->palette->tree;
        for (end = first; end < p->scene->stroke_count && strokes[end].depth == depth &&
                          strokes[end].mirrored == mirrored;
             end++)
            add_stroke(p, &strokes[end]);
        sli_pen_tree(p->cairo, colour, &p->pens, depth - 1);
        for (size_t i = first; i < end; i++) add_dot(p, &strokes[i]);
        sli_pen_tree_dots(p->cairo, colour, depth - 1);
    }
}

static void draw_objects(const plan *p) {
    for (size_t i = 0; i < p->map->object_count; i++) {
        const sl_box box = p->map->objects[i].box;
        const sl_point corners[4] = {
            box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
        sl_path_polygon(p->cairo, p->frame, corners, 4);
    }
    sli_pen_object(p->cairo, p->palette, &p->pens);
}

static void draw_starts(const plan *p) {
    draw_objects(p);
    for (size_t i = 0; i < p->map->path_count; i++) {
        const sl_path *path = &p->map->paths[i];
        for (size_t k = 1; k < path->count; k++)
            sl_path_segment(p->cairo, p->frame, path->points[k - 1], path->points[k]);
    }
    sli_pen_path(p->cairo, p->palette, &p->pens);
    for (size_t i = 0; i < p->map->start_count; i++) {
        sl_point place;
        if (sl_frame_holds(p->frame, p->map->starts[i].at, &place))
            sli_mark_start(p->cairo, p->palette, place, p->map->starts[i].heading, p->pens.mark);
    }
}

static void draw_fault_marks(const plan *p) {
    if (p->scene->options.faults)
        sli_draw_faults(p->cairo, p->palette, &p->pens, p->frame, p->scene->options.faults);
}

static void draw_numbers(const plan *p) {
    sli_draw_numbers(p->cairo, p->scene, p->frame);
}

typedef struct step {
    unsigned layers; ///< any of them calls for it; 0: always
    void (*draw)(const plan *p);
    const char *name; ///< of the layer in files that have layers
} step;

static const step steps[] = {
    {0, draw_ground, "ground"},
    {0, draw_cells, "cells"},
    {SL_LAYER_CELLS, draw_outlines, "outlines"},
    {0, draw_source_edge, "chosen-cell"},
    {SL_LAYER_PORTALS, draw_portals, "portals"},
    {SL_LAYER_STAB_TREE, draw_tree, "stab-tree"},
    {SL_LAYER_WALLS, draw_walls, "walls"},
    {SL_LAYER_STARTS, draw_starts, "starts"},
    {SL_LAYER_NUMBERS, draw_numbers, "numbers"},
    {0, draw_fault_marks, "faults"},
};
enum { STEPS = sizeof steps / sizeof *steps, WALLS_STEP = STEPS - 4 };

static plan plan_of(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame) {
    return (plan){.cairo = cairo,
                  .scene = scene,
                  .space = &scene->baked->space,
                  .map = &scene->baked->map,
                  .frame = frame,
                  .palette = &scene->palette,
                  .pens = sli_pens_for(scene, frame)};
}

static sl_status draw_steps(sl_context *context, const plan *p, unsigned layers, int first) {
    for (int i = first; i < STEPS; i++) {
        SL_TRY(sl_check_cancelled(context));
        if (steps[i].layers && !(layers & steps[i].layers)) continue;
        sli_layer_begin(p->cairo, steps[i].name);
        steps[i].draw(p);
    }
    return sl_check_cancelled(context);
}

sl_status sl_draw_plan(sl_context *context, cairo_t *cairo, const sl_scene *scene, unsigned layers,
                       const sl_frame *frame) {
    plan p = plan_of(cairo, scene, frame);
    p.context = context;
    return draw_steps(context, &p, layers, 0);
}

sl_status sl_draw_walls(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                        const sl_frame *frame) {
    plan p = plan_of(cairo, scene, frame);
    p.context = context;
    return draw_steps(context, &p, scene->options.layers, WALLS_STEP);
}

void sli_draw_solid(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame) {
    const plan p = plan_of(cairo, scene, frame);
    draw_paint(&p, SLI_PAINT_SOLID);
}

void sli_draw_beside(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame,
                     const bool *kept) {
    const plan p = plan_of(cairo, scene, frame);
    cairo_save(cairo);
    for (uint32_t cell = 0; cell < p.space->cell_count; cell++)
        if (!kept[cell]) add_cell(&p, cell);
    cairo_clip(cairo);
    draw_ground(&p);
    draw_cells(&p);
    cairo_restore(cairo);
}

void sl_draw_tree(cairo_t *cairo, const sl_scene *scene, sl_point from, uint32_t depth,
                  const sl_frame *frame) {
    sl_scene shown = *scene;
    shown.eye = from;
    // The deepest strokes stand first: those too deep are left out at the front.
    while (shown.stroke_count && shown.strokes->depth > depth) {
        shown.strokes++;
        shown.stroke_count--;
    }
    const plan p = plan_of(cairo, &shown, frame);
    draw_tree(&p);
}
