/// Coverage for JavaScript: what given viewpoints see together (coverage.js). Results stay until
/// the next call.
#include "bindings/js/src/coverage.h"

#include <string.h>

/// What one viewpoint and one blind spot give to JavaScript.
enum { GIVEN = 6, SEEN = 3, SPOT = 7 };

static sl_context *context(void) {
    return sli_module.context;
}

void sli_covered_forget(sli_covered *c) {
    sl_free(context(), c->pieces);
    sl_free(context(), c->corners);
    sl_free(context(), c->rows);
    c->pieces = NULL, c->corners = NULL, c->rows = NULL;
    sl_coverage_destroy(context(), &c->coverage);
}

/// Copies the pieces that are inside.
static sl_status put_pieces(sli_covered *a, uint32_t *count, uint32_t *corners) {
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

static sl_status put_rows(sli_covered *a) {
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
    sli_covered *a = sli_covered_of(f);
    if (!a) return SL_NO_MEMORY;
    sli_covered_forget(a);
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

sl_viewpoint *sli_viewpoints(const double *given, size_t count) {
    sl_viewpoint *viewpoints = sl_alloc_array(context(), count + 1, sizeof *viewpoints);
    for (size_t i = 0; viewpoints && i < count; i++, given += GIVEN)
        viewpoints[i] = (sl_viewpoint){.at = {given[0], given[1]},
                                       .heading = given[2],
                                       .fov = given[3],
                                       .range = given[4],
                                       .nearest = given[5]};
    return viewpoints;
}

/// Rows of viewpoints: x, y, heading, fov, range, nearest. integers: pieces, their corners, blind
/// spots, and where pieces, corners and rows lie.
SLI_EXPORT(int, floor_cover, sli_floor *f, const double *given, size_t count) {
    sl_viewpoint *viewpoints = sli_viewpoints(given, count);
    sli_done(viewpoints ? cover(f, viewpoints, count) : SL_NO_MEMORY);
    sl_free(context(), viewpoints);
    return (int)sli_module.status;
}
