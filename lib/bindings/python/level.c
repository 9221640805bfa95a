/// Levels for Python: bakes, their cells and portals, and the settings of their queries.
#include "facade.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- making and letting go

slp_level *slp_level_new(void) {
    slp_level *level = calloc(1, sizeof *level);
    if (!level) return NULL;
    if (slp_base_begin(&level->base)) return level;
    free(level);
    return NULL;
}

void slp_level_forget(slp_level *level) {
    sl_context *context = level->base.context;
    for (size_t i = 0; level->polygons && i < level->eye_count; i++) {
        slp_polygons *of = &level->polygons[i];
        for (size_t k = 0; k < of->list.count; k++) sl_free(context, of->list.items[k].points);
        sl_free(context, of->list.items);
    }
    sl_free(context, level->polygons);
    level->polygons = NULL;
    level->eye_count = 0;
    sl_vga_grid_destroy(context, &level->grid);
    sl_free(context, level->measures);
    level->measures = NULL;
    sl_free(context, level->intervals);
    level->intervals = NULL;
    sl_free(context, level->depths);
    level->depths = NULL;
    sl_free(context, level->parts);
    level->parts = NULL;
    level->part_count = 0;
    sl_effect_explanation_destroy(context, &level->explanation);
    sl_route_destroy(context, &level->route);
}

void slp_level_free(slp_level *level) {
    if (!level) return;
    sl_context *context = level->base.context;
    slp_level_forget(level);
    slp_level_forget_viewpoints(level);
    for (size_t i = 0; i < level->queries.count; i++)
        sl_query_destroy(context, level->queries.items[i]);
    sl_free(context, level->queries.items);
    sl_free(context, level->shut);
    sl_baked_destroy(context, &level->baked);
    slp_base_end(&level->base);
    free(level);
}

/// A query with the level's settings.
static sl_status make_query(slp_level *level, sl_query **out) {
    sl_context *context = level->base.context;
    sl_query *query;
    SL_TRY(sl_query_create(context, &level->baked, &query));
    sl_status status = sl_query_set_range(context, query, level->range);
    if (status == SL_OK) status = sl_query_set_mirror_depth(context, query, level->mirror_depth);
    // By number: parts of one door may stand differently at first.
    for (size_t i = 0; i < level->baked.map.door_count; i++)
        sl_query_set_door_at(context, query, i, !level->shut[i]);
    if (status == SL_OK)
        *out = query;
    else
        sl_query_destroy(context, query);
    return status;
}

sl_status slp_level_queries(slp_level *level, unsigned threads) {
    while (level->queries.count < threads) {
        SL_TRY(SL_ARRAY_ROOM(level->base.context, &level->queries, 1));
        SL_TRY(make_query(level, &level->queries.items[level->queries.count]));
        level->queries.count++;
    }
    return SL_OK;
}

/// After the baked file is there.
static sl_status begin_queries(slp_level *level) {
    const sl_map *map = &level->baked.map;
    level->range = map->range;
    level->mirror_depth = 1;
    level->shut = sl_alloc_array(level->base.context, map->door_count, sizeof *level->shut);
    if (!level->shut) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->door_count; i++) level->shut[i] = !map->doors[i].open;
    return slp_level_queries(level, 1);
}

static sl_status choose_method(slp_level *level, const char *name, sl_bake_options *options) {
    if (!name) return SL_OK;
    options->method = sl_see_method_named(name);
    if (options->method) return SL_OK;
    return sl_fail(level->base.context, SL_BAD_ARGUMENT, "there is no method '%.40s'", name);
}

static sl_status choose_subdivision(slp_level *level, const char *name, sl_bake_options *options) {
    size_t count;
    const sl_subdivision *all = sl_subdivisions(&count);
    if (!name) return SL_OK;
    for (size_t i = 0; i < count; i++)
        if (strcmp(all[i].name, name) == 0) options->subdivision = &all[i];
    if (options->subdivision) return SL_OK;
    return sl_fail(level->base.context, SL_BAD_ARGUMENT, "there is no subdivision '%.40s'", name);
}

/// What the command line does between reading a map and baking it.
static sl_status prepare(slp_level *level, const slp_bake *given, const sl_bake_options *options,
                         sl_map *map) {
    sl_context *context = level->base.context;
    if (options->subdivision && !options->subdivision->takes_cells) sl_map_drop_cells(context, map);
    if (!isnan(given->start_x)) {
        const sl_box b = sl_map_bounds(map);
        const sl_point at = {given->start_x, given->start_y};
        if (!(at.x >= b.min.x && at.x <= b.max.x && at.y >= b.min.y && at.y <= b.max.y))
            return sl_fail(context, SL_BAD_ARGUMENT, "the start %.17g, %.17g is outside the map",
                           at.x, at.y);
        SL_TRY(sl_map_add_start(context, map, at, 0, 0));
    }
    sl_effects_leave_out(context, map, given->without);
    return SL_OK;
}

int slp_level_bake(slp_level *level, const slp_plan *plan, const slp_bake *given) {
    sl_context *context = level->base.context;
    sl_bake_options options = sl_bake_options_default();
    sl_map map = {0};
    SL_TRY(choose_method(level, given->method, &options));
    SL_TRY(choose_subdivision(level, given->subdivision, &options));
    if (!isnan(given->weld)) options.clean.weld = given->weld;
    options.see.sight = given->open_sight ? SL_OPEN : SL_CLOSED;
    options.see.inside_only = given->inside_only;
    options.see.threads = given->threads;
    options.mirror_depth = given->mirror_depth;
    options.door_limit = given->door_limit;
    SL_TRY(sl_map_copy(context, &plan->map, &map));
    sl_bake_account account;
    sl_status status = prepare(level, given, &options, &map);
    if (status == SL_OK)
        status = (given->sets ? sl_bake(context, &map, &options, &level->baked, &account)
                              : sl_bake_space(context, &map, &options, &level->baked, &account));
    sl_map_destroy(context, &map);
    level->has_sets = given->sets;
    return status == SL_OK ? begin_queries(level) : status;
}

int slp_level_open(slp_level *level, const char *path) {
    SL_TRY(sl_baked_read(level->base.context, path, &level->baked));
    level->has_sets = true;
    return begin_queries(level);
}

int slp_level_write(slp_level *level, const char *path) {
    return sl_baked_write(level->base.context, &level->baked, path);
}

int slp_level_export(slp_level *level, const char *path, const char *name) {
    size_t count;
    const sl_export_format *formats = sl_export_formats(level->base.context, &count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(formats[i].name, name) == 0)
            return formats[i].write(level->base.context, &level->baked, &(sl_export_options){0},
                                    path);
    return sl_fail(level->base.context, SL_BAD_ARGUMENT, "there is no export '%.40s'", name);
}

// --- what it holds

const char *slp_level_inside(slp_level *level) {
    static const char *const next[] = {
        [SL_INSIDE_SURE] = "; for another width, set plan.entrance",
        [SL_INSIDE_LEAKS] = "",
        [SL_INSIDE_SMALL] = ": add a start with plan.add_start((x, y))",
        [SL_INSIDE_FEW] = ": add a start with plan.add_start((x, y))",
        [SL_INSIDE_NONE] = "",
        [SL_INSIDE_OPENING] = ": plan.add_start((x, y)), or plan.entrance",
    };
    const sl_baked *baked = &level->baked;
    sl_context *context = level->base.context;
    sl_inside doubt;
    sl_status status = sl_say_inside(context, &baked->map, &baked->space, level->inside);
    if (status == SL_OK) status = sl_doubt_inside(context, &baked->map, &baked->space, &doubt);
    if (status != SL_OK) return NULL;
    const bool plain = doubt == SL_INSIDE_SURE && baked->map.interior.by == SL_ENTRANCE_UNIT;
    if (plain || !level->inside[0]) return "";
    const size_t used = strlen(level->inside);
    snprintf(level->inside + used, sizeof level->inside - used, "%s", next[doubt]);
    return level->inside;
}

const char *slp_level_word(const slp_level *level, const char *what) {
    const sl_baked *baked = &level->baked;
    if (strcmp(what, "method") == 0) return baked->method;
    if (strcmp(what, "solver") == 0) return baked->solver;
    if (strcmp(what, "sight") == 0) return baked->visibility.sight == SL_OPEN ? "open" : "closed";
    return sl_guarantee_name(baked->visibility.guarantee);
}

void slp_level_counts(const slp_level *level, uint64_t counts[8]) {
    const sl_space *s = &level->baked.space;
    const uint64_t all[8] = {s->cell_count, s->vertex_count, s->portal_count, s->wall_count,
                             s->seam_count, s->inside_count, s->loose,        level->has_sets};
    memcpy(counts, all, sizeof all);
}

void slp_level_cells(const slp_level *level, double *vertices, int64_t *offsets, uint8_t *inside,
                     uint8_t *solid, double *areas) {
    const sl_space *s = &level->baked.space;
    size_t n = 0;
    for (uint32_t c = 0; c < s->cell_count; c++) {
        const sl_cell *cell = &s->cells[c];
        offsets[c] = (int64_t)n;
        for (uint32_t i = 0; i < cell->vertex_count; i++, n++) {
            vertices[2 * n] = s->vertices[cell->first_vertex + i].x;
            vertices[2 * n + 1] = s->vertices[cell->first_vertex + i].y;
        }
        inside[c] = cell->inside != 0;
        solid[c] = cell->solid != 0;
        areas[c] = sl_space_area(s, c);
    }
    offsets[s->cell_count] = (int64_t)n;
}

void slp_level_portals(const slp_level *level, int64_t *cells, double *ends, int64_t *doors) {
    const sl_space *s = &level->baked.space;
    for (uint32_t p = 0; p < s->portal_count; p++) {
        const sl_portal *portal = &s->portals[p];
        cells[2 * p] = portal->cell[0];
        cells[2 * p + 1] = portal->cell[1];
        ends[4 * p] = portal->left.x;
        ends[4 * p + 1] = portal->left.y;
        ends[4 * p + 2] = portal->right.x;
        ends[4 * p + 3] = portal->right.y;
        doors[p] = -1;
    }
    for (uint32_t i = 0; i < s->seam_portal_count; i++) {
        const sl_seam *seam = &s->seams[s->seam_portals[i].seam];
        if (seam->kind == SL_SEAM_DOOR) doors[s->seam_portals[i].portal] = seam->number;
    }
}

/// Writes the rows of sets; `columns` may be NULL.
static void put_sets(const sl_pvs *pvs, uint32_t cells, int64_t *offsets, int64_t *columns) {
    int64_t n = 0;
    for (uint32_t c = 0; c < cells; c++) {
        offsets[c] = n;
        if (c >= pvs->cell_count) continue;
        for (sl_pvs_run run = sl_pvs_begin(pvs, c); sl_pvs_next(&run);)
            for (uint32_t to = run.first; to < run.end; to++, n++)
                if (columns) columns[n] = to;
    }
    offsets[cells] = n;
}

int slp_level_sets(slp_level *level, int mirrored, int64_t *offsets, int64_t *columns) {
    const sl_baked *baked = &level->baked;
    sl_context *context = level->base.context;
    bool any = false;
    if (!level->has_sets)
        return sl_fail(context, SL_BAD_ARGUMENT, "there are no visible sets: bake the plan");
    for (size_t i = 0; i < baked->map.door_count; i++) any |= level->shut[i];
    sl_space space = {0};
    sl_visibility shut = {0};
    const sl_visibility *v = any ? &shut : &baked->visibility;
    if (any) SL_TRY(sl_baked_shut(context, baked, level->shut, &space, &shut));
    put_sets(mirrored ? &v->mirrored : &v->pvs, baked->space.cell_count, offsets, columns);
    sl_space_destroy(context, &space);
    sl_visibility_destroy(context, &shut);
    return SL_OK;
}

// --- settings, of every query

int slp_level_set_door(slp_level *level, const char *name, int open) {
    const sl_map *map = &level->baked.map;
    for (size_t i = 0; i < level->queries.count; i++)
        SL_TRY(sl_query_set_door(level->base.context, level->queries.items[i], name, open != 0));
    for (size_t i = 0; i < map->door_count; i++)
        if (strcmp(map->doors[i].name, name) == 0) level->shut[i] = !open;
    return SL_OK;
}

int slp_level_set_range(slp_level *level, double range) {
    for (size_t i = 0; i < level->queries.count; i++)
        SL_TRY(sl_query_set_range(level->base.context, level->queries.items[i], range));
    level->range = range;
    return SL_OK;
}

int slp_level_set_mirror_depth(slp_level *level, uint32_t depth) {
    for (size_t i = 0; i < level->queries.count; i++)
        SL_TRY(sl_query_set_mirror_depth(level->base.context, level->queries.items[i], depth));
    level->mirror_depth = depth;
    return SL_OK;
}
