#include "draw/scene.h"

#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// What is worked with while a scene is made.
typedef struct maker {
    const sl_baked *baked;
    uint8_t *paint;      ///< by cell
    double *area_before; ///< of cells shown, up to each cell; the last entry is all of it
} maker;

/// The middle of a cell's corners.
static sl_point cell_middle(const sl_space *space, uint32_t cell) {
    const sl_cell *c = &space->cells[cell];
    sl_point sum = {0, 0};
    // Relative to a corner, so that neither far places nor huge ones lose the middle.
    const sl_point *corners = space->vertices + c->first_vertex, base = corners[0];
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        sum.x += (corners[i].x - base.x) / c->vertex_count;
        sum.y += (corners[i].y - base.y) / c->vertex_count;
    }
    return (sl_point){base.x + sum.x, base.y + sum.y};
}

sl_colour sl_scene_colour(const sl_scene *scene, unsigned paint) {
    const sl_palette *palette = &scene->palette;
    if (paint >= SL_PAINT_HEAT)
        return sl_palette_ramp(palette->dark,
                               (double)(paint - SL_PAINT_HEAT) / (SL_HEAT_STEPS - 1));
    if (paint == SL_PAINT_SOURCE) return palette->source;
    if (paint == SL_PAINT_DOUBTFUL) return palette->doubtful;
    if (paint >= SL_PAINT_SEEN) return palette->seen[paint - SL_PAINT_SEEN];
    if (paint >= SL_PAINT_FLOOR) return palette->floor[paint - SL_PAINT_FLOOR];
    return palette->ground;
}

bool sl_scene_shows(const sl_scene *scene, uint32_t cell) {
    return sl_baked_counts(scene->baked, cell) != scene->outside;
}

/// Whether a table of rows goes with the space.
static bool has_rows(const sl_pvs *pvs, const sl_space *space) {
    return pvs->cell_count == space->cell_count && pvs->offsets;
}

static void find_population(maker *m, sl_scene *scene) {
    const sl_space *space = &m->baked->space;
    scene->outside = scene->chosen && !sl_baked_counts(m->baked, scene->options.cell);
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const bool shown = sl_scene_shows(scene, cell);
        scene->population += shown;
        m->area_before[cell + 1] = m->area_before[cell] + (shown ? sl_space_area(space, cell) : 0);
    }
    for (uint32_t i = 0; i < space->portal_count; i++)
        scene->portals += sl_scene_shows(scene, space->portals[i].cell[0]);
    if (scene->population)
        scene->cell_size = sqrt(m->area_before[space->cell_count] / scene->population);
}

/// The smallest tone that no neighbour with a lower number has; where all are taken, one by number.
static void choose_tones(maker *m, const sl_scene *scene) {
    const sl_space *space = &m->baked->space;
    const bool plain = !(scene->options.layers & SL_LAYER_CELLS);
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const sl_cell *c = &space->cells[cell];
        if (!sl_scene_shows(scene, cell)) continue;
        unsigned taken = 0, tone = 0;
        for (uint32_t i = 0; i < c->directed_count && !plain; i++) {
            const uint32_t next = space->directed[c->first_directed + i].cell;
            if (next < cell && m->paint[next] != SL_PAINT_NONE)
                taken |= 1u << (m->paint[next] - SL_PAINT_FLOOR);
        }
        while (tone < SL_TONES && taken >> tone & 1) tone++;
        m->paint[cell] = (uint8_t)(SL_PAINT_FLOOR + (tone < SL_TONES ? tone : cell % SL_TONES));
    }
}

static void paint_seen(maker *m, sl_scene *scene) {
    const sl_visibility *visibility = &m->baked->visibility;
    const uint32_t source = scene->options.cell;
    double area = 0;
    for (sl_pvs_run r = sl_pvs_begin(&visibility->pvs, source); sl_pvs_next(&r);) {
        area += m->area_before[r.end] - m->area_before[r.first];
        for (uint32_t cell = r.first; cell < r.end; cell++) {
            const unsigned tone = m->paint[cell] ? m->paint[cell] - SL_PAINT_FLOOR : 0;
            m->paint[cell] = (uint8_t)(SL_PAINT_SEEN + tone);
            scene->seen++;
        }
    }
    const double whole = m->area_before[m->baked->space.cell_count];
    scene->seen_share = whole > 0 ? area / whole : 0;
    if (!has_rows(&visibility->doubtful, &m->baked->space)) return;
    for (sl_pvs_run r = sl_pvs_begin(&visibility->doubtful, source); sl_pvs_next(&r);)
        for (uint32_t cell = r.first; cell < r.end; cell++) {
            m->paint[cell] = SL_PAINT_DOUBTFUL;
            scene->doubtful++;
        }
}

/// Each counted cell by the share of the area that it sees, from the least share to the most.
static sl_status paint_heat(sl_context *context, maker *m, sl_scene *scene) {
    const sl_space *space = &m->baked->space;
    const double whole = m->area_before[space->cell_count];
    double *shares = sl_alloc_array(context, space->cell_count, sizeof *shares);
    if (!shares) return SL_NO_MEMORY;
    scene->least = 1;
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        if (!sl_scene_shows(scene, cell)) continue;
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
        if (!sl_scene_shows(scene, cell)) continue;
        const double value = range > 0 ? (shares[cell] - scene->least) / range : 0;
        const double step = fmin(fmax(value, 0), 1) * (SL_HEAT_STEPS - 1) + 0.5;
        m->paint[cell] = (uint8_t)(SL_PAINT_HEAT + (unsigned)step);
    }
    sl_free(context, shares);
    return SL_OK;
}

void sl_scene_get_paint(const sl_scene *scene, uint8_t *paint) {
    for (unsigned p = 0; p < SL_PAINT_COUNT; p++)
        for (uint32_t i = scene->paint_begin[p]; i < scene->paint_begin[p + 1]; i++)
            paint[scene->order[i]] = (uint8_t)p;
}

void sl_scene_set_paint(sl_scene *scene, const uint8_t *paint) {
    const uint32_t count = scene->baked->space.cell_count;
    uint32_t at[SL_PAINT_COUNT];
    memset(scene->paint_begin, 0, sizeof scene->paint_begin);
    for (uint32_t cell = 0; cell < count; cell++) scene->paint_begin[paint[cell] + 1]++;
    for (unsigned p = 0; p < SL_PAINT_COUNT; p++) {
        scene->paint_begin[p + 1] += scene->paint_begin[p];
        at[p] = scene->paint_begin[p];
    }
    for (uint32_t cell = 0; cell < count; cell++) scene->order[at[paint[cell]]++] = cell;
}

static int by_depth(const void *a, const void *b) {
    const sl_stroke *x = a, *y = b;
    if (x->depth != y->depth) return x->depth < y->depth ? 1 : -1;
    if (x->mirrored != y->mirrored) return x->mirrored ? -1 : 1;
    if (x->from != y->from) return x->from < y->from ? -1 : 1;
    if (x->to != y->to) return x->to < y->to ? -1 : 1;
    return x->cell < y->cell ? -1 : x->cell > y->cell;
}

static int by_place(const void *a, const void *b) {
    const sl_stroke *x = a, *y = b;
    if (x->from != y->from) return x->from < y->from ? -1 : 1;
    if (x->to != y->to) return x->to < y->to ? -1 : 1;
    if (x->mirrored != y->mirrored) return x->mirrored ? 1 : -1;
    if (x->cell != y->cell) return x->cell < y->cell ? -1 : 1;
    return x->depth < y->depth ? -1 : x->depth > y->depth;
}

static bool is_same_stroke(const sl_stroke *x, const sl_stroke *y) {
    return x->from == y->from && x->to == y->to && x->mirrored == y->mirrored && x->cell == y->cell;
}

/// The stroke to each node, the root's too, which is dropped later; its depth is where its children
/// look.
static void find_strokes(const sl_stab_node *nodes, size_t count, sl_scene *scene) {
    sl_stroke *strokes = scene->strokes;
    strokes[0] = (sl_stroke){.from = UINT32_MAX, .to = UINT32_MAX};
    for (size_t i = 1; i < count; i++) {
        const sl_stab_node *from = &nodes[nodes[i].parent];
        const sl_stroke *parent = &strokes[nodes[i].parent];
        strokes[i] = (sl_stroke){.from = parent->to,
                                 .to = nodes[i].directed,
                                 .depth = parent->depth + 1,
                                 .cell = from->cell,
                                 .mirrored = parent->mirrored || sl_stab_is_mirror(from)};
        scene->mirrored_nodes += strokes[i].mirrored || sl_stab_is_mirror(&nodes[i]);
        if (strokes[i].depth > scene->tree_depth) scene->tree_depth = strokes[i].depth;
    }
}

static sl_status make_strokes(sl_context *context, sl_scene *scene) {
    const sl_stab_trees *trees = &scene->baked->visibility.trees;
    const uint32_t source = scene->options.cell;
    if (trees->cell_count != scene->baked->space.cell_count || !trees->offsets) return SL_OK;
    const sl_stab_node *nodes = trees->nodes + trees->offsets[source];
    const size_t count = (size_t)(trees->offsets[source + 1] - trees->offsets[source]);
    if (count == 0) return SL_OK;
    scene->tree_nodes = count;
    sl_stroke *strokes = scene->strokes = sl_alloc_array(context, count, sizeof *strokes);
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
    return cell_middle(&baked->space, cell);
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
        m->paint[options->cell] = SL_PAINT_SOURCE;
        scene->eye = find_eye(m->baked, options->cell);
    }
    sl_scene_set_paint(scene, m->paint);
    if (scene->chosen && options->layers & SL_LAYER_STAB_TREE) SL_TRY(make_strokes(context, scene));
    return SL_OK;
}

sl_status sl_scene_make(sl_context *context, const sl_baked *baked, const sl_draw_options *options,
                        sl_scene *out) {
    const size_t count = baked->space.cell_count;
    sl_scene scene = {.baked = baked,
                      .options = *options,
                      .palette = sl_palette_make(options->dark),
                      .chosen = options->cell != SL_NO_CELL};
    maker m = {.baked = baked,
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
        sl_scene_destroy(context, &scene);
    return status;
}

void sl_scene_destroy(sl_context *context, sl_scene *scene) {
    sl_free(context, scene->order);
    sl_free(context, scene->strokes);
    memset(scene, 0, sizeof *scene);
}
