/// The multipass method (Laine 2005, algorithm 1): quadrant by quadrant, view cells in an order in
/// which those behind come first; a face's refine set is the directed visible set of the one view
/// cell behind it. At the boundary of the compound nothing is known: all objects are in it.
#include "from_region/methods.h"

#include <string.h>

/// A view cell in a quadrant.
typedef struct visit {
    uint32_t view_cell;
    int quadrant;
} visit;

typedef struct passes {
    visit *visits; ///< by level
    size_t *after;
    sl_bits *directed; ///< by quadrant, then view cell
} passes;

static sl_bits *directed_of(const sl_from_region_work *work, int quadrant, uint32_t view_cell) {
    const passes *p = work->own;
    return p->directed +
           ((size_t)quadrant * work->scene->counts.view_cells + view_cell) * work->scene->words;
}

static sl_status visit_unit(sl_context *context, sl_from_region_work *work,
                            sl_from_region_thread *thread, size_t unit) {
    const sl_regions *scene = work->scene;
    const passes *p = work->own;
    const visit v = p->visits[unit];
    sl_bits *row = directed_of(work, v.quadrant, v.view_cell);
    memset(thread->set, 0, scene->words * sizeof *thread->set);
    for (uint32_t f = scene->first_face[v.view_cell]; f < scene->first_face[v.view_cell + 1]; f++) {
        const uint32_t behind = scene->faces.items[f].to;
        if (!sl_face_faces(scene, f, v.quadrant)) continue;
        const sl_bits *refine =
            behind == SL_NO_VIEW_CELL ? work->all : directed_of(work, v.quadrant, behind);
        sl_row_or(thread->set, refine, scene->words);
        SL_TRY(sl_from_region_look(context, work, thread, f, v.quadrant, refine, row));
    }
    sl_row_or(row, sl_regions_inside(scene, v.view_cell), scene->words);
    thread->candidates += sl_row_count(thread->set, scene->words);
    thread->relations += sl_row_count(row, scene->words);
    pthread_mutex_lock(&work->lock);
    sl_row_or(work->seen + v.view_cell * scene->words, row, scene->words);
    pthread_mutex_unlock(&work->lock);
    return SL_OK;
}

/// Lists all view cells of all quadrants by level; each is a component of its own.
static sl_status list_visits(sl_context *context, const sl_regions *scene, passes *p) {
    uint32_t levels = 0;
    for (int q = 0; q < SL_QUADRANTS; q++)
        if (scene->passes[q].view_cells.level_count > levels)
            levels = scene->passes[q].view_cells.level_count;
    size_t *starts = sl_alloc_array(context, (size_t)levels + 1, sizeof *starts);
    if (!starts) return SL_NO_MEMORY;
    for (int q = 0; q < SL_QUADRANTS; q++) {
        const sl_order *order = &scene->passes[q].view_cells;
        for (uint32_t k = 0; k < order->component_count; k++) starts[order->level[k] + 1]++;
    }
    for (uint32_t level = 0; level < levels; level++) {
        starts[level + 1] += starts[level];
        for (size_t i = starts[level]; i < starts[level + 1]; i++) p->after[i] = starts[level];
    }
    for (int q = 0; q < SL_QUADRANTS; q++) {
        const sl_order *order = &scene->passes[q].view_cells;
        for (uint32_t k = 0; k < order->component_count; k++)
            p->visits[starts[order->level[k]]++] = (visit){order->nodes[order->starts[k]], q};
    }
    sl_free(context, starts);
    return SL_OK;
}

sl_status sl_from_region_multipass(sl_context *context, sl_from_region_work *work) {
    const sl_regions *scene = work->scene;
    const size_t count = (size_t)SL_QUADRANTS * scene->counts.view_cells;
    passes p = {.visits = sl_alloc_array(context, count, sizeof *p.visits),
                .after = sl_alloc_array(context, count, sizeof *p.after),
                .directed = sl_alloc_array(context, count, scene->words * sizeof *p.directed)};
    sl_status status = p.visits && p.after && p.directed ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = list_visits(context, scene, &p);
    work->own = &p;
    work->unit = visit_unit;
    if (status == SL_OK) status = sl_from_region_run(context, work, count, p.after);
    sl_free(context, p.visits);
    sl_free(context, p.after);
    sl_free(context, p.directed);
    return status;
}
