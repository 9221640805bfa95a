#include "walk_draw.h"

#include <math.h>
#include <string.h>

sl_status sl_walk_canvas_create(sl_context *context, const sl_hierarchy *hierarchy,
                                sl_walk_canvas **out) {
    sl_walk_canvas *c = sl_alloc_array(context, 1, sizeof *c);
    uint64_t *drawn = sl_alloc_array(context, hierarchy->space->wall_count, sizeof *drawn);
    if (!c || !drawn) {
        sl_free(context, c);
        sl_free(context, drawn);
        return SL_NO_MEMORY;
    }
    c->hierarchy = hierarchy;
    c->drawn = drawn;
    *out = c;
    return SL_OK;
}

void sl_walk_canvas_destroy(sl_context *context, sl_walk_canvas *canvas) {
    if (canvas) sl_free(context, canvas->drawn);
    sl_free(context, canvas);
}

/// A part of the view: where it looks, how wide it is, and its columns.
typedef struct camera {
    sl_point at, ahead, left; ///< unit vectors but for `at`
    double half_width;        ///< tangent of half its angle
    int first, count;
} camera;

/// A wall's columns, nearer than what is there already. One over the depth is linear across.
static void draw_wall(sl_walk_canvas *c, const camera *cam, uint32_t number) {
    const sl_wall *w = &c->hierarchy->space->walls[number];
    double depth[2], across[2];
    for (int i = 0; i < 2; i++) {
        const sl_point p = i ? w->b : w->a, d = {p.x - cam->at.x, p.y - cam->at.y};
        depth[i] = d.x * cam->ahead.x + d.y * cam->ahead.y;
        across[i] = -(d.x * cam->left.x + d.y * cam->left.y);
    }
    const double least = 1e-6 * (fabs(depth[0]) + fabs(depth[1]));
    if (depth[0] <= least && depth[1] <= least) return;
    for (int i = 0; i < 2; i++) {
        if (depth[i] > least) continue;
        const double share = (least - depth[i]) / (depth[1 - i] - depth[i]);
        across[i] += share * (across[1 - i] - across[i]);
        depth[i] = least;
    }
    const double scale = cam->count / (2 * cam->half_width);
    double x0 = (across[0] / depth[0] + cam->half_width) * scale;
    double x1 = (across[1] / depth[1] + cam->half_width) * scale;
    double near0 = 1 / depth[0], near1 = 1 / depth[1];
    if (x0 > x1) {
        const double x = x0, near = near0;
        x0 = x1, near0 = near1;
        x1 = x, near1 = near;
    }
    if (!(x1 > 0 && x0 < cam->count)) return;
    const int from = x0 > 0 ? (int)x0 : 0, to = x1 < cam->count ? (int)x1 : cam->count - 1;
    const double slope = x1 > x0 ? (near1 - near0) / (x1 - x0) : 0;
    for (int x = from; x <= to; x++) {
        const float near = (float)(near0 + slope * (x + 0.5 - x0));
        if (near <= c->nearness[cam->first + x]) continue;
        c->nearness[cam->first + x] = near;
        c->wall[cam->first + x] = number;
    }
}

static void draw_cell(sl_walk_canvas *c, const camera *cameras, int camera_count, uint32_t cell,
                      uint32_t *walls) {
    const sl_hierarchy *h = c->hierarchy;
    for (uint32_t i = h->first_wall[cell]; i < h->first_wall[cell + 1]; i++) {
        const uint32_t wall = h->walls[i];
        if (c->drawn[wall] == c->frame) continue;
        c->drawn[wall] = c->frame;
        for (int k = 0; k < camera_count; k++) draw_wall(c, &cameras[k], wall);
        (*walls)++;
    }
}

uint32_t sl_walk_draw(sl_walk_canvas *c, const sl_eye *eye, const uint64_t *cells) {
    const double degree = acos(-1) / 180;
    const int parts = eye->fov > 240 ? 4 : eye->fov > 120 ? 2 : 1;
    const double width = eye->fov / parts;
    camera cameras[4];
    for (int i = 0; i < parts; i++) {
        const double look = (eye->look + eye->fov / 2 - width * (i + 0.5)) * degree;
        cameras[i] = (camera){.at = eye->at,
                              .ahead = {cos(look), sin(look)},
                              .left = {-sin(look), cos(look)},
                              .half_width = tan(fmax(width, 0.01) / 2 * degree),
                              .first = SL_WALK_COLUMNS / parts * i,
                              .count = SL_WALK_COLUMNS / parts};
    }
    uint32_t walls = 0;
    c->frame++;
    memset(c->nearness, 0, sizeof c->nearness);
    for (size_t word = 0; word * 64 < c->hierarchy->space->cell_count; word++)
        for (uint64_t bits = cells[word]; bits; bits &= bits - 1)
            draw_cell(c, cameras, parts, (uint32_t)(word * 64) + (uint32_t)__builtin_ctzll(bits),
                      &walls);
    return walls;
}
