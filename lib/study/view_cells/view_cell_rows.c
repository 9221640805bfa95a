/// Exact sets of view cells, and rows of them for use (Mattausch et al. 2006, section 5.2).
///
/// The borders of view cells become seams of the map. Then no cell of the space lies in two view
/// cells, and a view cell sees what its cells see, by any method of cell-to-cell visibility.
///
/// Rows are compressed along the hierarchy: what two siblings both see is stored once, above them.
/// A lookup (bake/view_rows.c) unites the rows on the way from a view cell to the root:
///
///               {b}
///             /     \          the left view cell sees a and b, the right one b, c and d
///          {a}      {c d}
///
/// Cost: O(rows x words).
#include "bake/view_rows.h"
#include "cell_to_cell/pvs_rows.h"
#include "map/scan.h"
#include "sightline/support.h"
#include "study/view_cells/view_cell_tree.h"

#include <string.h>

// --- making rows

sl_status sl_view_add_seams(sl_context *context, const sl_view_tree *tree,
                            const uint32_t *view_cells, const sl_space *objects, sl_map *map) {
    sl_segment *borders;
    size_t count;
    SL_TRY(sl_view_borders(context, tree, view_cells, &borders, &count));
    sl_status status = SL_OK;
    for (size_t i = 0; i < count && status == SL_OK; i++)
        status = sli_map_add_border(context, map, borders[i]);
    sl_free(context, borders);
    for (uint32_t i = 0; objects && i < objects->portal_count && status == SL_OK; i++) {
        const sl_segment portal = {objects->portals[i].right, objects->portals[i].left};
        status = sli_map_add_border(context, map, portal);
    }
    return status == SL_OK ? sl_map_clean(context, map, NULL, NULL) : status;
}

typedef struct maker {
    const sl_space *space;
    const sl_view_tree *tree;
    const sl_view_hierarchy *hierarchy;
    uint32_t cells;      ///< view cells
    uint32_t *cut;       ///< by elementary cell: its view cell
    uint32_t *numbers;   ///< by view cell: its number in the hierarchy
    uint32_t *node_of;   ///< by number in the hierarchy: its node
    sl_view_sets sets;   ///< by node
    sli_row_bytes bytes; ///< of the rows
    sl_view_rows *out;
} maker;

static sl_status find_cut(sl_context *context, maker *m) {
    const uint32_t count = m->hierarchy->cell_count;
    m->cut = sl_alloc_array(context, count, sizeof *m->cut);
    m->numbers = sl_alloc_array(context, m->cells, sizeof *m->numbers);
    m->node_of = sl_alloc_array(context, 2 * (size_t)count, sizeof *m->node_of);
    if (!m->cut || !m->numbers || !m->node_of) return SL_NO_MEMORY;
    return sl_view_cut(context, m->hierarchy, m->cells, m->cut, m->numbers);
}

static sl_status deal_cells(sl_context *context, maker *m) {
    const sl_space *space = m->space;
    m->out->view_cells = sl_alloc_array(context, space->cell_count, sizeof *m->out->view_cells);
    if (!m->out->view_cells) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const uint32_t leaf = sli_view_cell_leaf(m->tree, space, i);
        const bool in = space->cells[i].inside && leaf < m->tree->cell_count;
        m->out->view_cells[i] = in ? m->cut[leaf] : SL_NO_VIEW_CELL;
    }
    return SL_OK;
}

/// Makes nodes of the joints above the cut. Parents come after their children.
static sl_status hang_nodes(sl_context *context, maker *m, bool compressed) {
    const uint32_t count = m->hierarchy->cell_count, below = count - m->cells;
    sl_view_rows *rows = m->out;
    rows->view_cell_count = m->cells;
    rows->node_count = compressed ? 2 * m->cells - 1 : m->cells;
    if (rows->node_count > m->space->cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%u rows of view cells, but the space has %u cells only", rows->node_count,
                       m->space->cell_count);
    rows->parents = sl_alloc_array(context, rows->node_count, sizeof *rows->parents);
    if (!rows->parents) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < rows->node_count; i++) rows->parents[i] = SL_NO_VIEW_CELL;
    for (uint32_t v = 0; v < m->cells; v++) m->node_of[m->numbers[v]] = v;
    for (uint32_t i = 0; compressed && i + 1 < m->cells; i++) {
        m->node_of[count + below + i] = m->cells + i;
        for (int k = 0; k < 2; k++)
            rows->parents[m->node_of[m->hierarchy->joints[below + i].parts[k]]] = m->cells + i;
    }
    return SL_OK;
}

/// Moves what both children have to their parent.
static void pull_up(maker *m) {
    const uint32_t below = m->hierarchy->cell_count - m->cells;
    for (uint32_t node = m->cells; node < m->out->node_count; node++) {
        const uint32_t *parts = m->hierarchy->joints[below + node - m->cells].parts;
        sl_bits *up = sli_view_set(&m->sets, node);
        sl_bits *a = sli_view_set(&m->sets, m->node_of[parts[0]]);
        sl_bits *b = sli_view_set(&m->sets, m->node_of[parts[1]]);
        for (size_t i = 0; i < m->sets.words; i++) {
            up[i] = a[i] & b[i];
            a[i] &= ~up[i];
            b[i] &= ~up[i];
        }
    }
}

static sl_status encode(sl_context *context, maker *m) {
    const uint32_t cells = m->space->cell_count;
    sl_pvs *rows = &m->out->rows;
    rows->offsets = sl_alloc_array(context, (size_t)cells + 1, sizeof *rows->offsets);
    if (!rows->offsets) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < cells; i++) {
        if (i < m->out->node_count)
            SL_TRY(sli_row_append(context, &m->bytes, sli_view_set(&m->sets, i), cells));
        rows->offsets[i + 1] = m->bytes.count;
    }
    // Never NULL, also where no view cell sees any.
    SL_TRY(SL_ARRAY_ROOM(context, &m->bytes, 1));
    rows->bytes = m->bytes.items;
    rows->cell_count = cells;
    m->bytes.items = NULL;
    return SL_OK;
}

static sl_status make(sl_context *context, maker *m, const sl_pvs *pvs, bool compressed) {
    SL_TRY(find_cut(context, m));
    SL_TRY(deal_cells(context, m));
    SL_TRY(hang_nodes(context, m, compressed));
    SL_TRY(sli_view_sets_create(context, m->out->node_count, m->space->cell_count, &m->sets));
    for (uint32_t i = 0; i < m->space->cell_count; i++)
        if (m->out->view_cells[i] != SL_NO_VIEW_CELL)
            sli_row_add_to(pvs, i, sli_view_set(&m->sets, m->out->view_cells[i]));
    pull_up(m);
    return encode(context, m);
}

sl_status sl_view_rows_make(sl_context *context, const sl_space *space, const sl_pvs *pvs,
                            const sl_view_tree *tree, const sl_view_hierarchy *hierarchy,
                            uint32_t cells, bool compressed, sl_view_rows *out) {
    sl_view_rows rows = {0};
    maker m = {.space = space, .tree = tree, .hierarchy = hierarchy, .cells = cells, .out = &rows};
    if (pvs->cell_count != space->cell_count || !cells || cells > hierarchy->cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the visible sets or the number of view cells are of something else");
    const sl_status status = make(context, &m, pvs, compressed);
    sl_free(context, m.cut);
    sl_free(context, m.numbers);
    sl_free(context, m.node_of);
    sl_free(context, m.bytes.items);
    sl_view_sets_destroy(context, &m.sets);
    if (status == SL_OK)
        *out = rows;
    else
        sl_view_rows_destroy(context, &rows);
    return status;
}

// --- cost

/// The cell of the scene's space that each cell with seams lies in.
static sl_status find_homes(sl_context *context, const sl_space *home, const sl_space *space,
                            uint32_t **out) {
    uint32_t *homes = sl_alloc_array(context, space->cell_count, sizeof *homes);
    if (!homes) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->cell_count; i++) homes[i] = sli_view_cell_home(home, space, i);
    *out = homes;
    return SL_OK;
}

/// The viewpoint that stands for a view cell: the middle of its largest cell.
static sl_point eye_of(const sl_space *space, const sl_view_rows *rows, uint32_t view_cell) {
    double most = 0;
    sl_point eye = {0, 0};
    for (uint32_t i = 0; i < space->cell_count; i++) {
        if (rows->view_cells[i] != view_cell || sl_space_area(space, i) <= most) continue;
        most = sl_space_area(space, i);
        eye = sl_space_middle(space, i);
    }
    return eye;
}

typedef struct coster {
    sli_view_render render;
    uint32_t *homes, *cut, *numbers;
    sl_bits *seen, *homes_seen;
} coster;

static sl_status add_costs(sl_context *context, coster *c, const sl_space *space,
                           const sl_view_rows *rows, const sl_view_hierarchy *hierarchy,
                           double *cost) {
    const size_t words = sl_bits_words(space->cell_count);
    const size_t home_words = sl_bits_words(c->render.object_count);
    *cost = 0;
    for (uint32_t v = 0; v < rows->view_cell_count; v++) {
        SL_TRY(sl_check_cancelled(context));
        memset(c->seen, 0, words * sizeof *c->seen);
        memset(c->homes_seen, 0, home_words * sizeof *c->homes_seen);
        sli_view_rows_add_to(rows, v, c->seen);
        for (uint32_t i = 0; i < space->cell_count; i++)
            if (sl_bits_has(c->seen, i) && c->homes[i] != SL_NO_CELL)
                sl_bits_add(c->homes_seen, c->homes[i]);
        const sl_point eye = c->render.even ? (sl_point){0, 0} : eye_of(space, rows, v);
        *cost += hierarchy->mass[c->numbers[v]] *
                 sli_view_render_set(&c->render, c->homes_seen, home_words, eye);
    }
    return SL_OK;
}

sl_status sl_view_rows_cost(sl_context *context, const sl_view_scene *scene, const sl_space *space,
                            const sl_view_rows *rows, const sl_view_hierarchy *hierarchy,
                            uint32_t cells, double *cost) {
    if (scene->objects != SL_VIEW_CELLS)
        return sl_fail(context, SL_BAD_ARGUMENT, "exact costs are in cells, not in walls");
    coster c = {0};
    double sum = 0;
    SL_TRY(sli_view_render_make(context, scene, &c.render));
    c.cut = sl_alloc_array(context, hierarchy->cell_count, sizeof *c.cut);
    c.numbers = sl_alloc_array(context, cells, sizeof *c.numbers);
    c.seen = sl_alloc_array(context, sl_bits_words(space->cell_count), sizeof *c.seen);
    c.homes_seen =
        sl_alloc_array(context, sl_bits_words(c.render.object_count), sizeof *c.homes_seen);
    sl_status status = c.cut && c.numbers && c.seen && c.homes_seen ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = find_homes(context, scene->space, space, &c.homes);
    if (status == SL_OK) status = sl_view_cut(context, hierarchy, cells, c.cut, c.numbers);
    if (status == SL_OK) status = add_costs(context, &c, space, rows, hierarchy, &sum);
    sli_view_render_destroy(context, &c.render);
    sl_free(context, c.homes);
    sl_free(context, c.cut);
    sl_free(context, c.numbers);
    sl_free(context, c.seen);
    sl_free(context, c.homes_seen);
    if (status == SL_OK) *cost = sum;
    return status;
}

// --- exact sets of elementary view cells

typedef struct exact {
    const sl_view_scene *scene;
    const sl_view_tree *tree;
    sl_map map; ///< walls and starts of the scene's, and borders of view cells as seams
    sl_space space;
    sl_visibility visibility;
    uint32_t *leaves, *homes; ///< by cell of `space`: where it lies
} exact;

static sl_status make_map(sl_context *context, const sl_map *map, exact *e) {
    sl_status status = sl_map_add_walls(context, &e->map, map->walls, map->wall_count);
    e->map.ground_guessed = map->ground_guessed;
    e->map.channel = map->channel;
    for (size_t i = 0; i < map->seam_count && status == SL_OK; i++) {
        const sl_glass *wall = &map->seams[i];
        if (!wall->stops) continue;
        status = sl_map_add_seam(context, &e->map, wall->segment, 0);
        if (status != SL_OK) break;
        e->map.seams[e->map.seam_count - 1].stops = wall->stops;
        e->map.seams[e->map.seam_count - 1].ground = wall->ground;
    }
    for (size_t i = 0; i < map->start_count && status == SL_OK; i++)
        status = sl_map_add_start(context, &e->map, map->starts[i].at, map->starts[i].heading, 0);
    SL_TRY(status);
    uint32_t *each = sl_alloc_array(context, e->tree->cell_count, sizeof *each);
    if (!each) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < e->tree->cell_count; i++) each[i] = i;
    status = sl_view_add_seams(context, e->tree, each, e->scene->space, &e->map);
    sl_free(context, each);
    return status;
}

static sl_status find_places(sl_context *context, exact *e) {
    const uint32_t count = e->space.cell_count;
    e->leaves = sl_alloc_array(context, count, sizeof *e->leaves);
    if (!e->leaves) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) e->leaves[i] = sli_view_cell_leaf(e->tree, &e->space, i);
    return find_homes(context, e->scene->space, &e->space, &e->homes);
}

static sl_status fill(sl_context *context, exact *e, sl_view_sets *sets) {
    const uint32_t count = e->space.cell_count;
    for (uint32_t i = 0; i < count; i++) {
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(context));
        if (!e->space.cells[i].inside || e->leaves[i] >= e->tree->cell_count) continue;
        sl_bits *set = sli_view_set(sets, e->leaves[i]);
        for (sl_pvs_run run = sl_pvs_begin(&e->visibility.pvs, i); sl_pvs_next(&run);)
            for (uint32_t c = run.first; c < run.end; c++)
                if (e->homes[c] != SL_NO_CELL) sl_bits_add(set, e->homes[c]);
    }
    return SL_OK;
}

sl_status sl_view_sets_exact(sl_context *context, const sl_map *map, const sl_view_scene *scene,
                             const sl_view_tree *tree, const sl_see_method *method,
                             const sl_see_options *options, sl_view_sets *out) {
    if (scene->objects != SL_VIEW_CELLS)
        return sl_fail(context, SL_BAD_ARGUMENT, "exact sets are of cells, not of walls");
    exact e = {.scene = scene, .tree = tree};
    sl_view_sets sets = {0};
    sl_status status = make_map(context, map, &e);
    if (status == SL_OK)
        status = sl_subdivision_for(&e.map)->subdivide(context, &e.map, NULL, &e.space);
    if (status == SL_OK) status = method->see(context, &e.space, options, &e.visibility);
    if (status == SL_OK) status = find_places(context, &e);
    if (status == SL_OK)
        status = sli_view_sets_create(context, tree->cell_count, scene->space->cell_count, &sets);
    if (status == SL_OK) status = fill(context, &e, &sets);
    sl_free(context, e.leaves);
    sl_free(context, e.homes);
    sl_visibility_destroy(context, &e.visibility);
    sl_space_destroy(context, &e.space);
    sl_map_destroy(context, &e.map);
    if (status == SL_OK)
        *out = sets;
    else
        sl_view_sets_destroy(context, &sets);
    return status;
}
