/// What is seen along one ray: each cell once, so that any order does.
#include "cell_to_cell/reach_bound.h"

void sl_rays_destroy(sl_context *context, sl_rays *rays) {
    sl_free(context, rays->starts.items);
    sl_free(context, rays->cells.items);
    *rays = (sl_rays){0};
}

/// A ray, and what is known of its moment.
typedef struct ray {
    sl_bound along;
    const sl_reach *known; ///< NULL for nothing
    uint32_t turn;         ///< of `known`
    uint32_t first;        ///< of its cells
} ray;

/// Whether a cell is seen at the ray's moment without it, and so all that lies beyond.
static bool is_known(const sl_reacher *r, const ray *of, uint32_t cell) {
    if (!of->known) return false;
    const sl_reached *all = of->known->cells.items;
    const int8_t level = of->along.level;
    uint32_t i = r->last[cell];
    if (i >= of->known->cells.count || all[i].cell != cell) return false;
    for (; i != UINT32_MAX; i = all[i].other) {
        const sl_reached *c = &all[i];
        if ((c->enter < of->turn || (c->enter == of->turn && c->low.level <= level)) &&
            (c->leave > of->turn || (c->leave == of->turn && c->high.level >= level)))
            return true;
    }
    return false;
}

static sl_status arrive(sl_context *context, sl_reacher *r, const ray *of, sl_rays *rays,
                        uint32_t cell) {
    if (cell == SL_NO_CELL) return SL_OK;
    const uint32_t on_ray = r->on_rays[cell];
    if (on_ray >= of->first && on_ray < rays->cells.count && rays->cells.items[on_ray] == cell)
        return SL_OK;
    if (is_known(r, of, cell)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &rays->cells, 1));
    r->on_rays[cell] = (uint32_t)rays->cells.count;
    rays->cells.items[rays->cells.count++] = cell;
    return ++r->pieces % 4096 ? SL_OK : sl_check_cancelled(context);
}

static bool is_along(const sl_reacher *r, const ray *of, uint32_t end) {
    return sl_ends_turn(r, of->along.end, end) == 0 && sl_bound_has(r, of->along, end);
}

/// Whether the ray crosses a directed portal on a line with the point.
static bool lies_along(const sl_reacher *r, const ray *of, const sl_walk_portal *e) {
    const uint32_t far = sl_same_point(sl_end_of(r, e->left), r->from) ? e->right : e->left;
    return is_along(r, of, far) && sl_level_along(r, e) == of->along.level;
}

/// Whether the ray crosses a directed portal of its first cell, of which the point is a corner.
static bool first_crosses(const sl_reacher *r, const ray *of, const sl_walk_portal *e) {
    const int facing = sl_ends_turn(r, e->right, e->left);
    if (facing <= 0) return facing == 0 && lies_along(r, of, e);
    return is_along(r, of, of->along.level == SL_CLOCKWISE ? e->right : e->left);
}

static bool crosses(const sl_reacher *r, const ray *of, const sl_walk_portal *e) {
    const int to_left = sl_ends_turn(r, of->along.end, e->left);
    if (to_left < 0) return false;
    const int to_right = sl_ends_turn(r, of->along.end, e->right);
    if (to_right > 0) return false;
    if (to_left > 0 && to_right < 0) return true;
    const int facing = sl_ends_turn(r, e->right, e->left);
    if (facing <= 0) return facing == 0 && lies_along(r, of, e);
    return sl_bound_has(r, of->along, to_left == 0 ? e->left : e->right);
}

sl_status sl_rays_add(sl_context *context, sl_reacher *r, sl_fan_edge edge, const sl_reach *known,
                      uint32_t turn, sl_rays *rays) {
    const sl_fans *fans = r->fans;
    const ray of = {.along = {.end = edge.end, .level = edge.last ? SL_COUNTER : SL_CLOCKWISE},
                    .known = known,
                    .turn = turn,
                    .first = (uint32_t)rays->cells.count};
    SL_TRY(SL_ARRAY_ROOM(context, &rays->starts, 2));
    if (!rays->starts.count) rays->starts.items[rays->starts.count++] = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &rays->cells, 1));
    r->on_rays[edge.cell] = of.first;
    rays->cells.items[rays->cells.count++] = edge.cell;
    for (uint32_t i = of.first; i < rays->cells.count; i++) {
        const uint32_t cell = rays->cells.items[i];
        for (uint32_t k = fans->first_directed[cell]; k < fans->first_directed[cell + 1]; k++) {
            const sl_walk_portal *e = &fans->directed[k];
            if (i == of.first ? first_crosses(r, &of, e) : crosses(r, &of, e))
                SL_TRY(arrive(context, r, &of, rays, e->cell));
        }
    }
    rays->starts.items[rays->starts.count++] = (uint32_t)rays->cells.count;
    return SL_OK;
}
