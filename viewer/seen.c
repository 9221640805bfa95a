/// What the eye sees now, by every culling method. What it sees in mirrors grows with each
/// reflection, so a frame takes only what it has time for.
#include "seen.h"

#include "edit.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

static void free_sets(sl_context *context, seen_state *seen) {
    for (int i = 0; i < SEEN_MOST; i++) {
        if (seen->methods[i].cells) sl_free(context, seen->methods[i].cells);
        if (seen->methods[i].mirrored) sl_free(context, seen->methods[i].mirrored);
        seen->methods[i] = (seen_method){0};
    }
    sl_free(context, seen->objects);
    sl_free(context, seen->objects_mirrored);
    seen->objects = seen->objects_mirrored = NULL;
    seen->object_count = 0;
    if (seen->pvs) sl_free(context, seen->pvs);
    if (seen->mirrored) sl_free(context, seen->mirrored);
    seen->pvs = seen->mirrored = NULL;
}

void seen_destroy(sl_context *context, seen_state *seen) {
    free_sets(context, seen);
    sl_region_destroy(context, &seen->region);
    seen_forget_mirrors(context, seen);
    if (seen->hurried) sl_context_destroy(seen->hurried);
    *seen = (seen_state){0};
}

static sl_status make_sets(sl_context *context, seen_state *seen, const document_state *document) {
    const sl_space *space = &document->baked->space;
    size_t count;
    sl_eye_methods(&count);
    free_sets(context, seen);
    const size_t words = sl_eye_words(space);
    seen->pvs = sl_alloc_array(context, words, sizeof *seen->pvs);
    seen->mirrored = sl_alloc_array(context, words, sizeof *seen->mirrored);
    seen->objects = sl_alloc_array(context, document->object_count, sizeof *seen->objects);
    seen->objects_mirrored =
        sl_alloc_array(context, document->object_count, sizeof *seen->objects_mirrored);
    if (!seen->pvs || !seen->mirrored || !seen->objects || !seen->objects_mirrored)
        return SL_NO_MEMORY;
    seen->object_count = document->object_count;
    for (size_t i = 0; i < count && i < SEEN_MOST; i++) {
        seen->methods[i].cells = sl_alloc_array(context, words, sizeof *seen->pvs);
        seen->methods[i].mirrored = sl_alloc_array(context, words, sizeof *seen->pvs);
        if (!seen->methods[i].cells || !seen->methods[i].mirrored) return SL_NO_MEMORY;
    }
    return SL_OK;
}

static void sum_up(const document_state *document, const uint64_t *cells, uint32_t *count,
                   double *area) {
    *count = 0;
    *area = 0;
    for (uint32_t cell = 0; cell < document->baked->space.cell_count; cell++) {
        if (!sl_bits_has(cells, cell)) continue;
        ++*count;
        *area += document->areas[cell];
    }
}

static double distance_to_cell(const sl_space *space, uint32_t number, sl_point at) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *corners = space->vertices + cell->first_vertex;
    double nearest = INFINITY;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        nearest =
            fmin(nearest, edit_distance(at, corners[i], corners[(i + 1) % cell->vertex_count]));
    return nearest;
}

/// Drops cells that are out of range as a whole: methods that know no range keep them.
static void keep_in_range(const seen_state *seen, const sl_space *space, uint64_t *cells) {
    if (!(seen->range > 0)) return;
    for (uint32_t cell = 0; cell < space->cell_count; cell++)
        if (sl_bits_has(cells, cell) && cell != seen->cell &&
            distance_to_cell(space, cell, seen->view.eye) > seen->range * (1 + 1e-12))
            cells[cell / 64] &= ~((sl_bits)1 << cell % 64);
}

static void look(sl_context *context, const seen_state *seen, seen_method *m,
                 const sl_eye_method *method, const document_state *document, sl_eye_search *search,
                 const sl_view *view) {
    const double before = sl_seconds();
    m->known = method->cull(context, search, view, m->cells, &m->account) == SL_OK;
    const double seconds = sl_seconds() - before;
    m->seconds = m->seconds > 0 ? 0.9 * m->seconds + 0.1 * seconds : seconds;
    if (!m->known) memset(m->cells, 0, sl_eye_words(&document->baked->space) * sizeof *m->cells);
    keep_in_range(seen, &document->baked->space, m->cells);
    sum_up(document, m->cells, &m->count, &m->area);
}

static bool have_common(const uint64_t *a, const uint64_t *b, size_t words) {
    for (size_t w = 0; w < words; w++)
        if (a[w] & b[w]) return true;
    return false;
}

/// Finds the objects that are seen. Runs the exact method again if some of them block sight. If
/// they cannot be put into the space, objects in visible cells count as seen.
static sl_status look_at_objects(sl_context *context, seen_state *seen,
                                 const document_state *document, const present_state *present) {
    const size_t words = sl_eye_words(&document->baked->space);
    size_t count;
    sl_eye_methods(&count);
    seen_method *exact = &seen->methods[count - 1];
    if (!seen->object_count || !exact->known) return SL_OK;
    uint64_t *cells = sl_alloc_array(context, words, sizeof *cells);
    if (!cells) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    sl_eye_account account;
    for (size_t i = 0; !present->moving && i < seen->object_count; i++) {
        sl_cells_of_box(present->space, document->map.objects[i].box, cells);
        seen->objects[i] = have_common(cells, exact->cells, words);
    }
    if (present->moving)
        status =
            sl_moving_look(context, present->moving, &seen->view, cells, seen->objects, &account);
    if (present->moving && present->parents && status == SL_OK) {
        memcpy(exact->cells, cells, words * sizeof *cells);
        exact->account = account;
        sum_up(document, exact->cells, &exact->count, &exact->area);
    }
    sl_free(context, cells);
    return status;
}

static void take_pvs(seen_state *seen, const document_state *document, const present_state *present,
                     sl_point eye) {
    const sl_space *space = &document->baked->space;
    memset(seen->pvs, 0, sl_eye_words(space) * sizeof *seen->pvs);
    memset(seen->mirrored, 0, sl_eye_words(space) * sizeof *seen->mirrored);
    seen->cell = sl_space_locate(space, eye);
    if (seen->cell != SL_NO_CELL && space->cells[seen->cell].solid) seen->cell = SL_NO_CELL;
    if (seen->cell != SL_NO_CELL) present_add_row(present, document, seen->cell, seen->pvs);
    if (seen->cell != SL_NO_CELL)
        present_add_mirrored(present, document, seen->cell, seen->mirrored);
    sum_up(document, seen->pvs, &seen->pvs_count, &seen->pvs_area);
}

bool seen_same_view(const sl_view *a, const sl_view *b) {
    return a->eye.x == b->eye.x && a->eye.y == b->eye.y && a->full == b->full &&
           (a->full || (a->left.x == b->left.x && a->left.y == b->left.y &&
                        a->right.x == b->right.x && a->right.y == b->right.y));
}

sl_status seen_update(sl_context *context, seen_state *seen, const document_state *document,
                      const present_state *present, const sl_view *view) {
    const double range = document->map.range;
    if (!document->baked || !present->search) {
        seen->valid = false;
        return SL_OK;
    }
    if (seen->version != present->version || !seen->pvs) {
        seen->valid = false;
        SL_TRY(make_sets(context, seen, document));
    }
    if (seen->valid && seen->range == range && seen_same_view(&seen->view, view)) return SL_OK;
    seen->version = present->version;
    seen->view = *view;
    seen->range = range;
    seen->valid = true;
    take_pvs(seen, document, present, view->eye);
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    sl_eye_search_set_range(present->search, range);
    if (present->moving) sl_moving_set_range(present->moving, range);
    for (size_t i = 0; i < count && i < SEEN_MOST; i++)
        look(context, seen, &seen->methods[i], &methods[i], document, present->search, view);
    SL_TRY(look_at_objects(context, seen, document, present));
    const double before = sl_seconds();
    const sl_status status = sl_region_make(context, present->outline, view, range, &seen->region);
    const double seconds = sl_seconds() - before;
    seen->region_seconds =
        seen->region_seconds > 0 ? 0.9 * seen->region_seconds + 0.1 * seconds : seconds;
    seen->region_area = sl_region_area(&seen->region);
    SL_TRY(status);
    return seen_look_into_mirrors(context, seen, document, present);
}

// --- mirrors

/// The seconds of a frame for cells, and for the parts of the region.
#define CELLS_SECONDS 0.003
#define PARTS_SECONDS 0.005

/// The number of parts that a frame has time to draw.
enum { PARTS_MOST = 100 };

static bool is_late(void *user) {
    const seen_state *seen = user;
    return sl_seconds() > seen->until;
}

static void give(seen_state *seen, double seconds) {
    seen->until = seen->patient ? INFINITY : sl_seconds() + seconds;
}

void seen_forget_mirrors(sl_context *context, seen_state *seen) {
    sl_mirrored_region_destroy(context, &seen->in_mirrors);
    sl_mirrored_region_destroy(context, &seen->deeper);
    seen->mirrored_area = 0;
    seen->depth = 0;
}

/// What a method sees by mirror. The last one, which is exact, also looks past objects.
static sl_status look_by_method(seen_state *seen, const document_state *document,
                                const present_state *present, const sl_eye_method *method,
                                bool is_last, uint64_t *cells) {
    sl_eye_account account;
    if (seen->object_count)
        memset(seen->objects_mirrored, 0, seen->object_count * sizeof *seen->objects_mirrored);
    if (is_last && present->parents && document->mirror_depth)
        return sl_moving_look_mirrored(seen->hurried, present->moving, &seen->view, cells,
                                       seen->objects_mirrored, &account);
    return method->mirrored(seen->hurried, present->search, &seen->view, cells, &account);
}

/// Methods are in order from loose to exact. If one has no time, the result of the one before is
/// used.
static sl_status look_by_methods(seen_state *seen, const document_state *document,
                                 const present_state *present) {
    const size_t words = sl_eye_words(&document->baked->space);
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const uint64_t *known = seen->mirrored;
    for (size_t i = 0; i < count && i < SEEN_MOST; i++) {
        seen_method *m = &seen->methods[i];
        sl_status status = SL_CANCELLED;
        give(seen, CELLS_SECONDS);
        if (methods[i].mirrored)
            status =
                look_by_method(seen, document, present, &methods[i], i + 1 == count, m->mirrored);
        if (status == SL_NO_MEMORY) return status;
        if (status != SL_OK) memcpy(m->mirrored, known, words * sizeof *known);
        known = m->mirrored;
        m->mirrored_count = 0;
        for (size_t w = 0; w < words; w++)
            m->mirrored_count += (uint32_t)__builtin_popcountll(m->mirrored[w] & ~m->cells[w]);
    }
    return SL_OK;
}

/// Adds reflections as long as there is time.
static sl_status make_parts(sl_context *context, seen_state *seen, const document_state *document,
                            const present_state *present) {
    const uint32_t most = document->mirror_depth;
    seen->depth = 0;
    give(seen, PARTS_SECONDS);
    for (uint32_t depth = seen->patient ? most : 1; depth <= most && most; depth++) {
        const sl_status status = sl_mirrored_region_make(
            seen->hurried, &present->mirrors, &seen->view, seen->range, depth, &seen->deeper);
        if (status == SL_CANCELLED) break;
        if (status != SL_OK)
            return sl_fail(context, status, "%s", sl_context_message(seen->hurried));
        if (!seen->patient && depth > 1 && seen->deeper.part_count > PARTS_MOST) break;
        const sl_mirrored_region made = seen->deeper;
        seen->deeper = seen->in_mirrors;
        seen->in_mirrors = made;
        seen->depth = depth;
    }
    if (!seen->depth) sl_mirrored_region_destroy(context, &seen->in_mirrors);
    seen->mirrored_area = sl_mirrored_area(&seen->in_mirrors);
    return SL_OK;
}

sl_status seen_look_into_mirrors(sl_context *context, seen_state *seen,
                                 const document_state *document, const present_state *present) {
    if (!document->baked->map.mirror_count) {
        seen_forget_mirrors(context, seen);
        return SL_OK;
    }
    if (!seen->hurried) {
        const sl_hooks hooks = {.user = seen, .cancelled = is_late};
        seen->hurried = sl_context_create(&hooks);
        if (!seen->hurried) return SL_NO_MEMORY;
    }
    SL_TRY(look_by_methods(seen, document, present));
    if (present->mirrors.outline) return make_parts(context, seen, document, present);
    seen_forget_mirrors(context, seen);
    return SL_OK;
}
