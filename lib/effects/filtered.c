/// The space as sight finds it for the time being: the portals of shut doors become walls, and
/// directed portals that one-way glass blocks are left out.
///
/// Glass may be a wall on its dark side alone:
///
///      dark side | lit side        The cell at the left keeps no directed portal there, and has
///      the
///                |                 wall in its place. The cell at the right keeps its directed
///         wall   |  -> portal      portal. The wall runs with the dark side at its left.
///
/// Then all that goes from cell to cell sees one way, also after a mirror has turned it round.
#include "effects/filtered.h"

#include "effects/effects.h"
#include "geometry/orient.h"
#include "space/walled.h"

#include <string.h>

typedef struct maker {
    const sl_space *from;
    uint32_t eye_cell;
    const sli_filtered_space *filtered;
    uint32_t *portals; ///< new numbers; UINT32_MAX for walls
    bool *barred;      ///< directed portals that are left out, walls' ones among them
    uint32_t *dark; ///< by portal: the directed portal that glass alone bars; UINT32_MAX for none
    uint32_t dark_count;
    sl_space *out;
} maker;

/// Going from its a to its b, glass is seen through from its right to its left. A straight line
/// that crosses it comes from the side that the eye is on; an eye on its line is where its cell is.
static bool is_blocked(const maker *m, const sl_segment *glass) {
    const int side = sli_orient(glass->a, glass->b, *m->filtered->eye);
    if (side || m->eye_cell == SL_NO_CELL) return side > 0;
    const sl_cell *cell = &m->from->cells[m->eye_cell];
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (sli_orient(glass->a, glass->b, m->from->vertices[cell->first_vertex + i]) > 0)
            return true;
    return false;
}

static bool is_shut(const maker *m, uint32_t portal) {
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(m->from, portal, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_seam *seam = &m->from->seams[on[i].seam];
        if (seam->kind == SL_SEAM_DOOR && m->filtered->shut && m->filtered->shut[seam->number])
            return true;
        if (seam->kind == SL_SEAM_ONEWAY && m->filtered->eye && is_blocked(m, &seam->at))
            return true;
    }
    return false;
}

/// What of the space goes on as it is. `to` is the address of a T *, written as bytes: a T * is no
/// void * to the compiler.
static sl_status copy(sl_context *context, void *to, const void *from, size_t count, size_t size,
                      size_t more) {
    if (!from) return SL_OK;
    void *block = sl_alloc_array(context, count + more, size);
    if (!block) return SL_NO_MEMORY;
    if (count) memcpy(block, from, count * size);
    memcpy(to, &block, sizeof block);
    return SL_OK;
}

#define COPY(items, count, more)                                                                   \
    SL_TRY(copy(context, &s->items, f->items, f->count, sizeof *s->items, (more)))

static sl_status copy_space(sl_context *context, maker *m, size_t walls) {
    const sl_space *f = m->from;
    sl_space *s = m->out;
    *s = *f;
    s->nodes = NULL, s->cells = NULL, s->vertices = NULL, s->portals = NULL, s->directed = NULL;
    s->walls = NULL, s->neighbour = NULL, s->seams = NULL, s->seam_portals = NULL;
    s->grid.first = s->grid.cells = NULL;
    s->passages = NULL, s->passage_count = 0;
    COPY(nodes, node_count, 0);
    COPY(cells, cell_count, 0);
    COPY(vertices, vertex_count, 0);
    COPY(portals, portal_count, 0);
    COPY(directed, directed_count, 0);
    COPY(walls, wall_count, walls);
    COPY(neighbour, vertex_count, 0);
    COPY(grid.first, grid.columns * (size_t)f->grid.rows + 1, 0);
    COPY(grid.cells, grid.entry_count, 0);
    COPY(seams, seam_count, 0);
    COPY(seam_portals, seam_portal_count, 0);
    return SL_OK;
}

/// Finds the dark sides of glass. Glass that is dark from both sides is shut.
static void find_dark(maker *m) {
    const sl_space *f = m->from;
    for (uint32_t i = 0; i < f->portal_count; i++) m->dark[i] = UINT32_MAX;
    for (uint32_t i = 0; i < f->cell_count; i++)
        for (uint32_t k = f->cells[i].first_directed;
             k < f->cells[i].first_directed + f->cells[i].directed_count; k++) {
            const uint32_t portal = f->directed[k].portal;
            if (m->portals[portal] == UINT32_MAX || !sli_portal_is_blocked(f, i, k)) continue;
            if (m->dark[portal] != UINT32_MAX) m->portals[portal] = UINT32_MAX;
            m->dark[portal] = k;
        }
    for (uint32_t i = 0; i < f->portal_count; i++) {
        if (m->portals[i] == UINT32_MAX) m->dark[i] = UINT32_MAX;
        m->dark_count += m->dark[i] != UINT32_MAX;
    }
}

static sl_status make(sl_context *context, maker *m) {
    const sl_space *f = m->from;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < f->portal_count; i++) m->portals[i] = is_shut(m, i) ? UINT32_MAX : 0;
    if (m->dark) find_dark(m);
    for (uint32_t i = 0; i < f->portal_count; i++)
        if (m->portals[i] != UINT32_MAX) m->portals[i] = kept++;
    for (uint32_t i = 0; i < f->cell_count; i++)
        for (uint32_t k = f->cells[i].first_directed;
             k < f->cells[i].first_directed + f->cells[i].directed_count; k++) {
            const uint32_t portal = f->directed[k].portal;
            m->barred[k] = m->portals[portal] == UINT32_MAX ||
                           (m->filtered->one_way && sli_portal_is_blocked(f, i, k));
        }
    SL_TRY(copy_space(context, m, (size_t)f->portal_count - kept + m->dark_count));
    return sli_walled_make(context, &(sli_walled){.from = f,
                                                  .out = m->out,
                                                  .portals = m->portals,
                                                  .barred = m->barred,
                                                  .dark = m->dark_count ? m->dark : NULL});
}

sl_status sli_filtered_space_make(sl_context *context, const sl_space *space,
                                  const sli_filtered_space *filtered, uint32_t *portals,
                                  sl_space *out) {
    sl_space made = {0};
    maker m = {.from = space, .filtered = filtered, .portals = portals, .out = &made};
    if (filtered->eye) m.eye_cell = sl_space_locate(space, *filtered->eye);
    uint32_t *own = NULL;
    if (!portals) m.portals = own = sl_alloc_array(context, space->portal_count, sizeof *own);
    m.barred = sl_alloc_array(context, space->directed_count, sizeof *m.barred);
    const bool darkens = filtered->one_way && filtered->dark_walls;
    if (darkens) m.dark = sl_alloc_array(context, space->portal_count, sizeof *m.dark);
    const bool room = m.portals && m.barred && (m.dark || !darkens);
    const sl_status status = room ? make(context, &m) : SL_NO_MEMORY;
    sl_free(context, own);
    sl_free(context, m.dark);
    sl_free(context, m.barred);
    if (status == SL_OK)
        *out = made;
    else
        sl_space_destroy(context, &made);
    return status;
}

// --- one-way glass

bool sli_portal_is_blocked(const sl_space *space, uint32_t cell, uint32_t directed) {
    const uint32_t portal = space->directed[directed].portal;
    const bool forward = space->portals[portal].cell[0] == cell;
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(space, portal, &count);
    for (size_t i = 0; i < count; i++)
        if (space->seams[on[i].seam].kind == SL_SEAM_ONEWAY && on[i].forward != forward)
            return true;
    return false;
}

sl_status sli_oneway_filtered(sl_context *context, const sl_space *space, const sl_plan *plan,
                              sl_space *made, const sl_space **through) {
    const sli_filtered_space filtered = {.one_way = true};
    const bool called_for = plan && plan->effects & SL_EFFECT_ONEWAY;
    if (called_for) SL_TRY(sli_filtered_space_make(context, space, &filtered, NULL, made));
    *through = called_for ? made : space;
    return SL_OK;
}
