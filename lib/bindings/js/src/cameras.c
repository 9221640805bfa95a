/// Cameras for JavaScript: cameras.js asks, analysis/placement/ answers: which of given places and
/// headings see an area. Results stay until the next call.
#include "bindings/js/src/coverage.h"
#include "sightline/place_area.h"

#include <string.h>

struct sli_answers {
    sli_covered covered;
    sl_area_placement placed;
    sl_point *points; ///< those that were listed last
    char proof[512];
};

static sl_context *context(void) {
    return sli_module.context;
}

static struct sli_answers *answers_of(sli_floor *f) {
    if (!f->answers) f->answers = sl_alloc_array(context(), 1, sizeof *f->answers);
    return f->answers;
}

sli_covered *sli_covered_of(sli_floor *f) {
    struct sli_answers *a = answers_of(f);
    return a ? &a->covered : NULL;
}

void sli_answers_destroy(struct sli_answers *a) {
    if (!a) return;
    sli_covered_forget(&a->covered);
    sl_area_placement_destroy(context(), &a->placed);
    sl_free(context(), a->points);
    sl_free(context(), a);
}

/// Lists points of a sl_place_from. integers: how many, and where they lie.
SLI_EXPORT(int, floor_points, sli_floor *f, int from, double step) {
    struct sli_answers *a = answers_of(f);
    uint32_t count = 0;
    if (a) sl_free(context(), a->points);
    if (a) a->points = NULL;
    sli_done(a ? sl_place_points(context(), f->query, (sl_place_from)from, step, &a->points, &count)
               : SL_NO_MEMORY);
    sli_module.integers[0] = count;
    sli_module.integers[1] = a ? (uint32_t)(uintptr_t)a->points : 0;
    return (int)sli_module.status;
}

/// Keeps what there is when it is stopped.
static sl_status choose(sli_floor *f, sl_place_area *task, bool *stopped) {
    struct sli_answers *a = answers_of(f);
    if (!a || !task->places) return SL_NO_MEMORY;
    sl_area_placement_destroy(context(), &a->placed);
    sl_status status = sl_place_area_cover(context(), f->query, task, NULL, &a->placed);
    *stopped = status == SL_CANCELLED && a->placed.count;
    if (*stopped) status = SL_OK;
    if (status == SL_OK)
        sl_area_placement_say(task, &a->placed, 1, *stopped, a->proof, sizeof a->proof);
    return status;
}

/// Chooses among rows of places, of which the first `fixed` are taken in any case: such that
/// `cover` of them see each point, or `most` places that see as much as so many can. integers:
/// lower, upper, how many are chosen, where these and the proof lie, whether it was stopped.
/// numbers: areas to be seen, seen, that so many see at most, and that nobody sees.
SLI_EXPORT(int, floor_choose, sli_floor *f, const double *given, uint32_t count, uint32_t fixed,
           uint32_t cover, uint32_t most, int network) {
    sl_viewpoint *places = sli_viewpoints(given, count);
    uint32_t *taken = sl_alloc_array(context(), (size_t)fixed + 1, sizeof *taken);
    for (uint32_t i = 0; taken && i < fixed; i++) taken[i] = i;
    sl_place_area task = {.places = taken ? places : NULL,
                          .place_count = count,
                          .fixed = taken,
                          .fixed_count = fixed,
                          .cover = cover,
                          .count = most,
                          .network = network != 0};
    bool stopped = false;
    if (sli_done(choose(f, &task, &stopped))) {
        const sl_area_placement *p = &f->answers->placed;
        const uint32_t all[6] = {(uint32_t)p->lower,
                                 (uint32_t)p->upper,
                                 p->count,
                                 (uint32_t)(uintptr_t)p->chosen,
                                 (uint32_t)(uintptr_t)f->answers->proof,
                                 stopped};
        const double areas[4] = {p->area, p->seen, p->seen_most, p->blind_area};
        memcpy(sli_module.integers, all, sizeof all);
        memcpy(sli_module.numbers, areas, sizeof areas);
    }
    sl_free(context(), taken);
    sl_free(context(), places);
    return (int)sli_module.status;
}
