/// What the eye sees now, by every culling method. What it sees in mirrors grows with each
/// reflection, so a frame takes only what it has time for.
#include "plan/seen.h"

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

static void forget_mirrors(sl_context *context, seen_state *seen) {
    sl_mirrored_region_destroy(context, &seen->in_mirrors);
    sl_mirrored_region_destroy(context, &seen->deeper);
    seen->mirrored_area = 0;
    seen->depth = 0;
}

void seen_destroy(sl_context *context, seen_state *seen) {
    free_sets(context, seen);
    sl_region_destroy(context, &seen->region);
    forget_mirrors(context, seen);
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

static void look_by_method(sl_context *context, seen_method *m, const sl_eye_method *method,
                           const document_state *document, sl_query *query, const sl_view *view) {
    const double before = sl_seconds();
    m->known = sl_query_look(context, query, view, method, m->cells, &m->account) == SL_OK;
    const double seconds = sl_seconds() - before;
    m->seconds = m->seconds > 0 ? 0.9 * m->seconds + 0.1 * seconds : seconds;
    if (!m->known) memset(m->cells, 0, sl_eye_words(&document->baked->space) * sizeof *m->cells);
    sl_query_drop_far(query, view->eye, m->cells);
    sum_up(document, m->cells, &m->count, &m->area);
}

static bool have_common(const uint64_t *a, const uint64_t *b, size_t words) {
    for (size_t w = 0; w < words; w++)
        if (a[w] & b[w]) return true;
    return false;
}

/// Objects in visible cells count as seen.
static sl_status guess_objects(sl_context *context, seen_state *seen,
                               const document_state *document, const uint64_t *visible) {
    const sl_space *space = &document->baked->space;
    uint64_t *cells = sl_alloc_array(context, sl_eye_words(space), sizeof *cells);
    if (!cells) return SL_NO_MEMORY;
    for (size_t i = 0; i < seen->object_count; i++) {
        sl_cells_of_box(space, document->map.objects[i].box, cells);
        seen->objects[i] = have_common(cells, visible, sl_eye_words(space));
    }
    sl_free(context, cells);
    return SL_OK;
}

/// Finds the objects that are seen, or guesses if they cannot be put into the space.
static sl_status look_at_objects(sl_context *context, seen_state *seen,
                                 const document_state *document, const present_state *present) {
    size_t count;
    sl_eye_methods(&count);
    const seen_method *exact = &seen->methods[count - 1];
    if (!seen->object_count || !exact->known) return SL_OK;
    sl_status status = SL_UNSUPPORTED;
    if (!present->still)
        status = sl_query_boxes_seen(context, present->query, &seen->view, seen->objects, NULL);
    return status == SL_UNSUPPORTED ? guess_objects(context, seen, document, exact->cells) : status;
}

static sl_status take_row(sl_context *context, const seen_state *seen, const present_state *present,
                          bool mirrored, uint64_t *row) {
    memset(row, 0, sl_eye_words(sl_query_asked(present->query)) * sizeof *row);
    if (seen->cell == SL_NO_CELL || !present->has_rows) return SL_OK;
    return sl_query_row(context, present->query, seen->cell, mirrored, row);
}

static sl_status take_rows(sl_context *context, seen_state *seen, const document_state *document,
                           const present_state *present) {
    const sl_space *space = &document->baked->space;
    seen->cell = sl_query_locate(present->query, seen->view.eye);
    if (seen->cell != SL_NO_CELL && space->cells[seen->cell].solid) seen->cell = SL_NO_CELL;
    SL_TRY(take_row(context, seen, present, false, seen->pvs));
    SL_TRY(take_row(context, seen, present, true, seen->mirrored));
    sum_up(document, seen->pvs, &seen->pvs_count, &seen->pvs_area);
    return SL_OK;
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

static void allow_seconds(seen_state *seen, double seconds) {
    seen->until = seen->patient ? INFINITY : sl_seconds() + seconds;
}

/// The context of work that ends in time.
static sl_status make_hurried(seen_state *seen) {
    const sl_hooks hooks = {.user = seen, .cancelled = is_late};
    if (!seen->hurried) seen->hurried = sl_context_create(&hooks);
    return seen->hurried ? SL_OK : SL_NO_MEMORY;
}

/// Finds the objects that are seen by mirror. Only what blocks sight is looked for.
static sl_status look_at_objects_by_mirror(seen_state *seen, const document_state *document,
                                           const present_state *present) {
    const size_t size = seen->object_count * sizeof *seen->objects_mirrored;
    if (!size) return SL_OK;
    memset(seen->objects_mirrored, 0, size);
    if (!present->parents || !document->mirror_depth) return SL_OK;
    allow_seconds(seen, CELLS_SECONDS);
    const sl_status status = sl_query_boxes_seen(seen->hurried, present->query, &seen->view, NULL,
                                                 seen->objects_mirrored);
    return status == SL_CANCELLED ? SL_OK : status;
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
        allow_seconds(seen, CELLS_SECONDS);
        if (methods[i].mirrored)
            status = sl_query_look_mirrored(seen->hurried, present->query, &seen->view, &methods[i],
                                            m->mirrored, NULL);
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
static sl_status make_parts(sl_context *context, seen_state *seen, uint32_t most, sl_query *query) {
    SL_TRY(make_hurried(seen));
    seen->depth = 0;
    allow_seconds(seen, PARTS_SECONDS);
    for (uint32_t depth = seen->patient ? most : 1; depth <= most && most; depth++) {
        const sl_status status =
            sl_query_mirrored_region_to(seen->hurried, query, &seen->view, depth, &seen->deeper);
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

/// Sets what each method sees by mirror, and the parts of the region. If that takes too long, the
/// cells are those of the bake, and the parts have fewer reflections.
static sl_status look_into_mirrors(sl_context *context, seen_state *seen,
                                   const document_state *document, const present_state *present) {
    if (!document->baked->map.mirror_count) {
        forget_mirrors(context, seen);
        return SL_OK;
    }
    SL_TRY(make_hurried(seen));
    SL_TRY(look_by_methods(seen, document, present));
    SL_TRY(look_at_objects_by_mirror(seen, document, present));
    return make_parts(context, seen, document->mirror_depth, present->query);
}

// --- the whole

bool seen_same_view(const sl_view *a, const sl_view *b) {
    return a->eye.x == b->eye.x && a->eye.y == b->eye.y && a->full == b->full &&
           (a->full || (a->left.x == b->left.x && a->left.y == b->left.y &&
                        a->right.x == b->right.x && a->right.y == b->right.y));
}

/// Finds the region, and for how long that takes.
static sl_status find_region(sl_context *context, seen_state *seen, sl_query *query) {
    const double before = sl_seconds();
    const sl_status status = sl_query_region(context, query, &seen->view, &seen->region);
    const double seconds = sl_seconds() - before;
    seen->region_seconds =
        seen->region_seconds > 0 ? 0.9 * seen->region_seconds + 0.1 * seconds : seconds;
    seen->region_area = sl_region_area(&seen->region);
    return status;
}

sl_status seen_update_region(sl_context *context, seen_state *seen, const document_state *document,
                             sl_query *query, const sl_view *view) {
    if (seen->valid && seen_same_view(&seen->view, view)) return SL_OK;
    forget_mirrors(context, seen);
    SL_TRY(make_sets(context, seen, document));
    seen->view = *view;
    seen->valid = true;
    seen->cell = SL_NO_CELL;
    seen->pvs_count = 0;
    seen->pvs_area = 0;
    SL_TRY(find_region(context, seen, query));
    return document->map.mirror_count ? make_parts(context, seen, document->mirror_depth, query)
                                      : SL_OK;
}

sl_status seen_update(sl_context *context, seen_state *seen, const document_state *document,
                      const present_state *present, const sl_view *view) {
    const double range = document->map.range;
    if (!document->baked || !present->query) {
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
    SL_TRY(take_rows(context, seen, document, present));
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    for (size_t i = 0; i < count && i < SEEN_MOST; i++)
        look_by_method(context, &seen->methods[i], &methods[i], document, present->query, view);
    SL_TRY(look_at_objects(context, seen, document, present));
    SL_TRY(find_region(context, seen, present->query));
    return look_into_mirrors(context, seen, document, present);
}
