/// Viewpoints for JavaScript: place.js asks, analysis/placement/ answers: where the fewest must
/// stand. Results stay until the next call.
#include "sightline/place.h"
#include "bindings/js/src/coverage.h"

#include <string.h>

// place.js reads them where they lie.
_Static_assert(sizeof(sl_viewpoint) == 7 * sizeof(double), "viewpoints as place.js knows them");

struct sli_answers {
    sli_covered covered;
    sl_placement placement;
    bool stopped;
    char proof[256];
};

static sl_context *context(void) {
    return sli_module.context;
}

static sl_status make_answers(sli_floor *f) {
    if (!f->answers) f->answers = sl_alloc_array(context(), 1, sizeof *f->answers);
    return f->answers ? SL_OK : SL_NO_MEMORY;
}

sli_covered *sli_covered_of(sli_floor *f) {
    return make_answers(f) == SL_OK ? &f->answers->covered : NULL;
}

void sli_answers_destroy(struct sli_answers *a) {
    if (!a) return;
    sli_covered_forget(&a->covered);
    sl_placement_destroy(context(), &a->placement);
    sl_free(context(), a);
}

static sl_status choose(sli_floor *f, int from, double step, const sl_place_options *usual) {
    sl_place_options options = *usual;
    sl_point *places = NULL;
    if (from >= 0)
        SL_TRY(sl_place_points(context(), f->query, (sl_place_from)from, step, &places,
                               &options.place_count));
    options.places = places;
    const sl_status status = sl_place(context(), f->query, &options, &f->answers->placement);
    sl_free(context(), places);
    return status;
}

/// Finds the fewest viewpoints: from anywhere (-1), or of a sl_place_from. Stopped, it keeps what
/// there is. integers: lower, upper, witnesses, where the sl_viewpoints and the witnesses lie,
/// rounds, slivers, whether it was stopped. numbers: the area of slivers.
SLI_EXPORT(int, floor_place, sli_floor *f, int from, double step) {
    const sl_place_options options = sl_place_options_default();
    if (!sli_done(make_answers(f))) return (int)sli_module.status;
    sl_placement *p = &f->answers->placement;
    sl_placement_destroy(context(), p);
    sl_status status = choose(f, from, step, &options);
    const bool stopped = f->answers->stopped = status == SL_CANCELLED && p->count;
    if (stopped) status = SL_OK;
    const uint32_t all[8] = {(uint32_t)p->lower,
                             (uint32_t)p->upper,
                             p->witness_count,
                             (uint32_t)(uintptr_t)p->viewpoints,
                             (uint32_t)(uintptr_t)p->witnesses,
                             (uint32_t)p->rounds,
                             (uint32_t)p->slivers,
                             stopped};
    memcpy(sli_module.integers, all, sizeof all);
    sli_module.numbers[0] = p->unseen_area;
    sli_done(status);
    return (int)sli_module.status;
}

/// What is proven of the last placement, in a sentence or two.
SLI_EXPORT(const char *, floor_proof, sli_floor *f) {
    struct sli_answers *a = f->answers;
    sl_placement_say(&a->placement, "viewpoint", a->stopped, a->proof, sizeof a->proof);
    return a->proof;
}
