/// Viewpoints for Python: what given ones see together, and where they must stand.
///
/// Tables come as text, whatever Python has them in, so that one reader checks all of them.
#include "facade.h"

#include <string.h>

void slp_level_forget_viewpoints(slp_level *level) {
    sl_context *context = level->base.context;
    sl_coverage_destroy(context, &level->coverage);
    sl_path_parts_destroy(context, &level->unseen);
    sl_cameras_destroy(context, &level->cameras);
    sl_placement_destroy(context, &level->placement);
}

/// The viewpoints of the level's table. The caller frees them.
static sl_status list_viewpoints(slp_level *level, sl_viewpoint **out) {
    const size_t count = level->cameras.count;
    *out = sl_alloc_array(level->base.context, count, sizeof **out);
    if (!*out) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) (*out)[i] = level->cameras.items[i].view;
    return SL_OK;
}

/// What they see.
static sl_status cover(slp_level *level) {
    sl_context *context = level->base.context;
    sl_viewpoint *viewpoints;
    SL_TRY(list_viewpoints(level, &viewpoints));
    const sl_status status = sl_coverage_make(context, level->queries.items[0], viewpoints,
                                              level->cameras.count, &level->coverage);
    sl_free(context, viewpoints);
    return status;
}

int slp_level_cover(slp_level *level, const char *name, const char *text, size_t size, double fov,
                    double range, int signs) {
    const sl_viewpoint like = {.fov = fov, .range = range, .sign = signs};
    sl_context *context = level->base.context;
    slp_level_forget_viewpoints(level);
    SL_TRY(text ? sl_cameras_parse(context, name, text, size, &like, &level->cameras)
                : sl_cameras_read(context, name, &like, &level->cameras));
    return cover(level);
}

int slp_level_cover_path(slp_level *level, const double *points, size_t count) {
    sl_context *context = level->base.context;
    sl_viewpoint *viewpoints = NULL;
    sl_point *path = sl_alloc_array(context, count, sizeof *path);
    sl_status status = path ? list_viewpoints(level, &viewpoints) : SL_NO_MEMORY;
    for (size_t i = 0; path && i < count; i++)
        path[i] = (sl_point){points[2 * i], points[2 * i + 1]};
    sl_path_parts_destroy(context, &level->unseen);
    if (status == SL_OK)
        status = sl_coverage_of_path(context, level->queries.items[0], &level->coverage, viewpoints,
                                     path, count, &level->unseen);
    sl_free(context, viewpoints);
    sl_free(context, path);
    return status;
}

size_t slp_level_unseen(const slp_level *level, double *rows) {
    for (size_t i = 0; rows && i < level->unseen.count; i++) {
        const sl_path_part *part = &level->unseen.parts[i];
        const double row[6] = {part->from,    part->to,    part->start.x,
                               part->start.y, part->end.x, part->end.y};
        memcpy(rows + 6 * i, row, sizeof row);
    }
    return level->unseen.count;
}

// --- placement

/// The places to choose from: those given, or points of a kind. None: anywhere.
static sl_status find_places(slp_level *level, const slp_place *given, sl_point **out,
                             uint32_t *count) {
    static const struct {
        const char *name;
        sl_place_from from;
    } kinds[] = {{"corners", SL_PLACE_CORNERS}, {"walls", SL_PLACE_WALLS}, {"grid", SL_PLACE_GRID}};
    sl_context *context = level->base.context;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (given->from && strcmp(given->from, kinds[i].name) == 0)
            return sl_place_points(context, level->queries.items[0], kinds[i].from, given->step,
                                   out, count);
    if (!given->places) return SL_OK;
    *out = sl_alloc_array(context, given->count, sizeof **out);
    if (!*out) return SL_NO_MEMORY;
    for (size_t i = 0; i < given->count; i++)
        (*out)[i] = (sl_point){given->places[2 * i], given->places[2 * i + 1]};
    *count = (uint32_t)given->count;
    return SL_OK;
}

/// Keeps what there is when the time is over.
static sl_status place(slp_level *level, double seconds, const sl_place_options *options) {
    slp_base *base = &level->base;
    base->until = seconds > 0 ? sl_seconds() + seconds : 0;
    const sl_status status =
        sl_place(base->context, level->queries.items[0], options, &level->placement);
    base->until = 0;
    level->placed_late = status == SL_CANCELLED;
    if (status != SL_CANCELLED || atomic_load(&base->cancelled)) return status;
    if (level->placement.count) return SL_OK;
    return sl_fail(base->context, SL_CANCELLED,
                   "no set of viewpoints was found in time: give a longer time_limit");
}

/// The viewpoints are laid over the inside anew: whatever went wrong before, they see it all.
static sl_status check_placed(const slp_level *level) {
    const double *areas = level->coverage.overlay.areas;
    const double unseen = areas[0] - (level->cameras.count ? areas[1] : 0);
    if (unseen <= level->coverage.negligible + level->placement.unseen_area) return SL_OK;
    return sl_fail(level->base.context, SL_UNSUPPORTED,
                   "no viewpoints were found that see everything: %.6g of %.6g is unseen", unseen,
                   areas[0]);
}

int slp_level_place(slp_level *level, const slp_place *given) {
    sl_context *context = level->base.context;
    sl_place_options options = sl_place_options_default();
    sl_point *places = NULL;
    slp_level_forget_viewpoints(level);
    sl_status status = find_places(level, given, &places, &options.place_count);
    options.places = places;
    if (status == SL_OK) status = place(level, given->time_limit, &options);
    sl_free(context, places);
    for (uint32_t i = 0; status == SL_OK && i < level->placement.count; i++) {
        const sl_camera camera = {.view = level->placement.viewpoints[i], .cost = 1};
        status = sl_cameras_add(context, &level->cameras, &camera);
    }
    if (status == SL_OK) status = cover(level);
    return status == SL_OK ? check_placed(level) : status;
}

void slp_level_placed(const slp_level *level, int64_t numbers[5], double *unseen, double *points) {
    const sl_placement *p = &level->placement;
    const int64_t all[5] = {(int64_t)p->lower, (int64_t)p->upper, (int64_t)p->rounds,
                            (int64_t)p->slivers, p->witness_count};
    memcpy(numbers, all, sizeof all);
    *unseen = p->unseen_area;
    for (uint32_t i = 0; points && i < p->witness_count; i++) {
        points[2 * i] = p->witnesses[i].at.x;
        points[2 * i + 1] = p->witnesses[i].at.y;
    }
}

const char *slp_level_place_proof(slp_level *level) {
    sl_placement_say(&level->placement, "viewpoint", level->placed_late, level->proof,
                     sizeof level->proof);
    return level->proof;
}

// --- what is kept

void slp_level_cover_counts(const slp_level *level, int64_t counts[4]) {
    const sl_space *pieces = &level->coverage.overlay.pieces;
    counts[0] = (int64_t)level->cameras.count;
    counts[1] = level->coverage.blind_count;
    counts[2] = counts[3] = 0;
    for (uint32_t c = 0; c < pieces->cell_count; c++) {
        if (!pieces->cells[c].inside) continue;
        counts[2]++;
        counts[3] += pieces->cells[c].vertex_count;
    }
}

const char *slp_level_cover_name(const slp_level *level, size_t number) {
    return number < level->cameras.count ? level->cameras.items[number].name : NULL;
}

void slp_level_cover_copy(const slp_level *level, double areas[4], double *viewpoints,
                          double *spots) {
    const sl_coverage *coverage = &level->coverage;
    const sl_overlay *overlay = &coverage->overlay;
    // By class: exactly none, one and two, and three or more. What is negligible is rounding.
    for (size_t k = 0; k < 4; k++) {
        const bool has_more = k < 3 && k < overlay->shape_count;
        areas[k] = k <= overlay->shape_count ? overlay->areas[k] : 0;
        if (has_more) areas[k] -= overlay->areas[k + 1];
        if (areas[k] <= coverage->negligible) areas[k] = 0;
    }
    for (size_t i = 0; i < level->cameras.count; i++) {
        const sl_camera *camera = &level->cameras.items[i];
        const sl_viewpoint *v = &camera->view;
        const double row[14] = {v->at.x,
                                v->at.y,
                                v->heading,
                                v->fov,
                                v->range,
                                v->nearest,
                                camera->height,
                                camera->tilt,
                                camera->letters,
                                v->sign,
                                camera->cost,
                                coverage->seen[i],
                                coverage->alone[i],
                                sl_coverage_is_spare(coverage, i)};
        memcpy(viewpoints + 14 * i, row, sizeof row);
    }
    for (uint32_t i = 0; i < coverage->blind_count; i++) {
        const sl_blind_spot *s = &coverage->blind[i];
        const double row[7] = {s->area,         s->at.x,         s->at.y,        s->bounds.min.x,
                               s->bounds.min.y, s->bounds.max.x, s->bounds.max.y};
        memcpy(spots + 7 * (size_t)i, row, sizeof row);
    }
}

void slp_level_cover_pieces(const slp_level *level, int64_t *offsets, int64_t *counts,
                            int64_t *spots, double *corners) {
    const sl_overlay *overlay = &level->coverage.overlay;
    const sl_space *pieces = &overlay->pieces;
    size_t n = 0, piece = 0;
    for (uint32_t c = 0; c < pieces->cell_count; c++) {
        const sl_cell *cell = &pieces->cells[c];
        if (!cell->inside) continue;
        offsets[piece] = (int64_t)n;
        counts[piece] = overlay->counts[c];
        spots[piece] =
            level->coverage.spots[c] == UINT32_MAX ? -1 : (int64_t)level->coverage.spots[c];
        piece++;
        for (uint32_t i = 0; i < cell->vertex_count; i++, n++) {
            corners[2 * n] = pieces->vertices[cell->first_vertex + i].x;
            corners[2 * n + 1] = pieces->vertices[cell->first_vertex + i].y;
        }
    }
    offsets[piece] = (int64_t)n;
}
