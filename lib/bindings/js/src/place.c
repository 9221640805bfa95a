/// Viewpoints for JavaScript: place.js asks, analysis/placement/ answers: what given viewpoints see
/// together, and where the fewest must stand. Results stay until the next call.
#include "sightline/place.h"
#include "bindings/js/src/floor.h"
#include "sightline/coverage.h"

#include <string.h>

/// What one viewpoint and one blind spot give to JavaScript.
enum { GIVEN = 6, SEEN = 3, SPOT = 7 };

// place.js reads them where they lie.
_Static_assert(sizeof(sl_viewpoint) == 7 * sizeof(double), "viewpoints as place.js knows them");

struct sli_answers {
    sl_coverage coverage;
    sl_placement placement;
    uint32_t *pieces; ///< by piece that is inside: its corners, how many see it, its blind spot
    double *corners;
    double *rows; ///< of viewpoints, then of blind spots
    bool stopped;
    char proof[256];
};

static sl_context *context(void) {
    return sli_module.context;
}

static void forget_coverage(struct sli_answers *a) {
    sl_free(context(), a->pieces);
    sl_free(context(), a->corners);
    sl_free(context(), a->rows);
    a->pieces = NULL, a->corners = NULL, a->rows = NULL;
    sl_coverage_destroy(context(), &a->coverage);
}

void sli_answers_destroy(struct sli_answers *a) {
    if (!a) return;
    forget_coverage(a);
    sl_placement_destroy(context(), &a->placement);
    sl_free(context(), a);
}

static sl_status make_answers(sli_floor *f) {
    if (!f->answers) f->answers = sl_alloc_array(context(), 1, sizeof *f->answers);
    return f->answers ? SL_OK : SL_NO_MEMORY;
}

// --- coverage

/// Copies the pieces that are inside.
static sl_status put_pieces(struct sli_answers *a, uint32_t *count, uint32_t *corners) {
    const sl_overlay *overlay = &a->coverage.overlay;
    const sl_space *s = &overlay->pieces;
    a->pieces = sl_alloc_array(context(), 3 * (size_t)s->cell_count + 1, sizeof *a->pieces);
    a->corners = sl_alloc_array(context(), 2 * (size_t)s->vertex_count + 1, sizeof *a->corners);
    if (!a->pieces || !a->corners) return SL_NO_MEMORY;
    for (uint32_t c = 0; c < s->cell_count; c++) {
        const sl_cell *cell = &s->cells[c];
        if (!cell->inside) continue;
        const uint32_t row[3] = {cell->vertex_count, overlay->counts[c], a->coverage.spots[c]};
        memcpy(a->pieces + 3 * (size_t)(*count)++, row, sizeof row);
        for (uint32_t i = 0; i < cell->vertex_count; i++, ++*corners) {
            a->corners[2 * *corners] = s->vertices[cell->first_vertex + i].x;
            a->corners[2 * *corners + 1] = s->vertices[cell->first_vertex + i].y;
        }
    }
    return SL_OK;
}

static sl_status put_rows(struct sli_answers *a) {
    const sl_coverage *c = &a->coverage;
    const size_t size = SEEN * c->count + SPOT * (size_t)c->blind_count + 1;
    a->rows = sl_alloc_array(context(), size, sizeof *a->rows);
    if (!a->rows) return SL_NO_MEMORY;
    double *to = a->rows;
    for (size_t i = 0; i < c->count; i++, to += SEEN)
        to[0] = c->seen[i], to[1] = c->alone[i], to[2] = sl_coverage_is_spare(c, i);
    for (uint32_t i = 0; i < c->blind_count; i++, to += SPOT) {
        const sl_blind_spot *s = &c->blind[i];
        const double row[SPOT] = {s->area,         s->at.x,         s->at.y,        s->bounds.min.x,
                                  s->bounds.min.y, s->bounds.max.x, s->bounds.max.y};
        memcpy(to, row, sizeof row);
    }
    return SL_OK;
}

/// numbers: what exactly 0, 1, 2 and what 3 or more see. What is negligible is rounding.
static void put_areas(const sl_coverage *c) {
    const sl_overlay *overlay = &c->overlay;
    for (size_t k = 0; k < 4; k++) {
        double area = k <= overlay->shape_count ? overlay->areas[k] : 0;
        if (k < 3 && k < overlay->shape_count) area -= overlay->areas[k + 1];
        sli_module.numbers[k] = area > c->negligible ? area : 0;
    }
}

static sl_status cover(sli_floor *f, const sl_viewpoint *viewpoints, size_t count) {
    SL_TRY(make_answers(f));
    struct sli_answers *a = f->answers;
    forget_coverage(a);
    SL_TRY(sl_coverage_make(context(), f->query, viewpoints, count, &a->coverage));
    uint32_t pieces = 0, corners = 0;
    SL_TRY(put_pieces(a, &pieces, &corners));
    SL_TRY(put_rows(a));
    const uint32_t all[6] = {pieces,
                             corners,
                             a->coverage.blind_count,
                             (uint32_t)(uintptr_t)a->pieces,
                             (uint32_t)(uintptr_t)a->corners,
                             (uint32_t)(uintptr_t)a->rows};
    memcpy(sli_module.integers, all, sizeof all);
    put_areas(&a->coverage);
    return SL_OK;
}

/// Rows of viewpoints: x, y, heading, fov, range, nearest. integers: pieces, their corners, blind
/// spots, and where pieces, corners and rows lie.
SLI_EXPORT(int, floor_cover, sli_floor *f, const double *given, size_t count) {
    sl_viewpoint *viewpoints = sl_alloc_array(context(), count + 1, sizeof *viewpoints);
    for (size_t i = 0; viewpoints && i < count; i++, given += GIVEN)
        viewpoints[i] = (sl_viewpoint){.at = {given[0], given[1]},
                                       .heading = given[2],
                                       .fov = given[3],
                                       .range = given[4],
                                       .nearest = given[5]};
    sli_done(viewpoints ? cover(f, viewpoints, count) : SL_NO_MEMORY);
    sl_free(context(), viewpoints);
    return (int)sli_module.status;
}

// --- placement

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
