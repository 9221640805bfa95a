/// Single rays (oracle/mirror_ray.h) beside mirrored regions.
#ifndef SL_TESTS_MIRROR_RAYS_H
#define SL_TESTS_MIRROR_RAYS_H

#include "oracle/mirror_ray.h"
#include "sightline/region.h"

#include <math.h>

static inline double mirror_rays_cross(sl_point a, sl_point b, sl_point p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// How far a point is inside a cell, under 0 where it is outside.
static inline double mirror_rays_depth_in(const sl_space *space, uint32_t cell, sl_point p) {
    const sl_cell *c = &space->cells[cell];
    const sl_point *v = space->vertices + c->first_vertex;
    double least = INFINITY;
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        const sl_point a = v[i], b = v[(i + 1) % c->vertex_count];
        least = fmin(least, mirror_rays_cross(a, b, p) / hypot(b.x - a.x, b.y - a.y));
    }
    return least;
}

/// Whether a region holds a point that is not on its border: some edge has it between itself and
/// the eye, or the eye's image.
static inline bool mirror_rays_holds(const sl_region *region, sl_point p) {
    const sl_point o = {0, 0}, at = {p.x - region->view.eye.x, p.y - region->view.eye.y};
    for (size_t i = 0; i < region->count; i++) {
        const sl_point a = region->offsets[i], b = region->offsets[(i + 1) % region->count];
        const bool arc = region->edges[i].kind == SL_EDGE_ARC; // up to half a circle
        const bool ahead = a.x * at.x + a.y * at.y > 0 || b.x * at.x + b.y * at.y > 0 ||
                           (arc && a.x * b.x + a.y * b.y < 0);
        if (!ahead || mirror_rays_cross(o, a, at) < 0 || mirror_rays_cross(o, at, b) < 0) continue;
        if (arc ? hypot(at.x, at.y) <= region->range
                : mirror_rays_cross(o, a, b) > 0 && mirror_rays_cross(a, b, at) >= 0)
            return true;
    }
    return false;
}

/// Whether a part was come to by the mirrors of a ray's first legs.
static inline bool mirror_rays_has_chain(const sl_mirrored_region *region, uint32_t part,
                                         const oracle_ray *ray, uint32_t leg) {
    for (; leg > 0 && part != SL_NO_PART; leg--, part = region->parts[part].parent)
        if (region->parts[part].mirror != ray->legs[leg].mirror) return false;
    return leg == 0 && part == SL_NO_PART;
}

/// Whether a place of a ray's leg is shown by the mirrors that led to it.
static inline bool mirror_rays_show(const sl_mirrored_region *region, const oracle_ray *ray,
                                    uint32_t leg, sl_point p) {
    if (leg == 0) return mirror_rays_holds(&region->direct, p);
    for (uint32_t i = 0; i < region->part_count; i++)
        if (mirror_rays_has_chain(region, i, ray, leg) &&
            mirror_rays_holds(&region->parts[i].region, p))
            return true;
    return false;
}

/// Whether a leg has more than single points in a box, and crosses a side of it.
static inline bool mirror_rays_meet_box(const oracle_leg *leg, sl_box box) {
    double from = 0, to = 1;
    const double at[2] = {leg->from.x, leg->from.y}, low[2] = {box.min.x, box.min.y};
    const double step[2] = {leg->to.x - leg->from.x, leg->to.y - leg->from.y};
    const double high[2] = {box.max.x, box.max.y};
    for (int i = 0; i < 2; i++) {
        const double a = (low[i] - at[i]) / step[i], b = (high[i] - at[i]) / step[i];
        from = fmax(from, fmin(a, b));
        to = fmin(to, fmax(a, b));
    }
    return from + 1e-6 < to && (from > 0 || to < 1);
}

/// An edge of a part where a wall is shown to be and no ray by the same mirrors ends; SIZE_MAX for
/// none. `size` is that of the map; *checked counts edges.
static inline size_t mirror_rays_wrong_edge(const sl_map *map, sl_point eye,
                                            const sl_mirrored_region *region, uint32_t number,
                                            double size, size_t *checked) {
    const sl_mirror_part *part = &region->parts[number];
    const sl_region *r = &part->region;
    for (size_t i = 0; i < r->count; i++) {
        const size_t next = (i + 1) % r->count;
        if (r->edges[i].kind != SL_EDGE_WALL) continue;
        const sl_point image = {(part->image[i].x + part->image[next].x) / 2,
                                (part->image[i].y + part->image[next].y) / 2};
        const sl_point place = {(r->points[i].x + r->points[next].x) / 2,
                                (r->points[i].y + r->points[next].y) / 2};
        const oracle_ray ray =
            oracle_ray_of(map, eye, (sl_point){image.x - eye.x, image.y - eye.y}, part->depth);
        // Of a wall that is seen all but edge-on the ray may end anywhere.
        const double aside = fabs(mirror_rays_cross(eye, image, part->image[i])) /
                             hypot(image.x - eye.x, image.y - eye.y);
        if (ray.margin < 1e-7 * size || aside < 1e-6 * size) continue;
        ++*checked;
        const sl_point to = ray.count ? ray.legs[ray.count - 1].to : eye;
        if (ray.count != part->depth + 1 ||
            !mirror_rays_has_chain(region, number, &ray, part->depth) ||
            hypot(to.x - place.x, to.y - place.y) > 1e-7 * size)
            return i;
    }
    return SIZE_MAX;
}

#endif
