#include "seen_mirrors.h"

#include "clock.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

/// What a frame gives for cells, and for the parts of the region.
#define CELLS_SECONDS 0.003
#define PARTS_SECONDS 0.005

/// So many parts a frame has time to draw.
enum { PARTS_MOST = 100 };

static bool is_late(void *user) {
    const seen_state *seen = user;
    return clock_seconds() > seen->until;
}

static void give(seen_state *seen, double seconds) {
    seen->until = seen->patient ? INFINITY : clock_seconds() + seconds;
}

void seen_forget_mirrors(sl_context *context, seen_state *seen) {
    sl_mirrored_region_destroy(context, &seen->in_mirrors);
    sl_mirrored_region_destroy(context, &seen->deeper);
    seen->mirrored_area = 0;
    seen->depth = 0;
}

/// The methods stand from loose to exact: what one has no time for, the one before it knows.
static sl_status look(seen_state *seen, const document_state *document, sl_eye_search *search) {
    const size_t words = sl_eye_words(&document->baked->space);
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const uint64_t *known = seen->mirrored;
    for (size_t i = 0; i < count && i < SEEN_MOST; i++) {
        seen_method *m = &seen->methods[i];
        sl_eye_account account;
        sl_status status = SL_CANCELLED;
        give(seen, CELLS_SECONDS);
        if (methods[i].mirrored)
            status = methods[i].mirrored(seen->hurried, search, &seen->view, m->mirrored, &account);
        if (status == SL_NO_MEMORY) return status;
        if (status != SL_OK) memcpy(m->mirrored, known, words * sizeof *known);
        known = m->mirrored;
        m->mirrored_count = 0;
        for (size_t w = 0; w < words; w++)
            m->mirrored_count += (uint32_t)__builtin_popcountll(m->mirrored[w] & ~m->cells[w]);
    }
    return SL_OK;
}

/// One reflection more as long as there is time. Where there is one-way glass too there are no
/// parts: a region knows what is dark from the eye, and not from its images.
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
    SL_TRY(look(seen, document, present->search));
    if (!document->map.oneway_count && present->mirrors.outline)
        return make_parts(context, seen, document, present);
    seen_forget_mirrors(context, seen);
    return SL_OK;
}
