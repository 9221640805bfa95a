/// Outlines for checks (proof_outline.h).
#include "analysis/placement/proof_outline.h"

#include "geometry/orient.h"

#include <math.h>

typedef struct edge {
    sl_point a, b;
    size_t loop, at;
} edge;

/// Steps to the next edge that is more than a point; from a zeroed one to the first.
static bool next_edge(const sl_shape *o, edge *e) {
    for (; o && e->loop < o->count; e->loop++) {
        const size_t first = e->loop ? o->ends[e->loop - 1] : 0;
        while (e->at < o->ends[e->loop]) {
            e->a = o->points[e->at++];
            e->b = o->points[e->at < o->ends[e->loop] ? e->at : first];
            if (!sli_same_point(e->a, e->b)) return true;
        }
    }
    return false;
}

static bool is_above(const sli_proof_scene *scene, const sli_meet *p, sl_point at,
                     const sli_direction *sector) {
    const double width = scene->bounds.max.x - scene->bounds.min.x;
    return sli_sector_is_left(at, (sl_point){at.x + fmax(width, fabs(at.x)), at.y}, p, sector);
}

bool sli_outline_has_sector(const sli_proof_scene *scene, const sl_shape *outline,
                            const sli_meet *p, const sli_direction *sector) {
    int winding = 0;
    for (edge e = {0}; next_edge(outline, &e);) {
        const bool over_a = is_above(scene, p, e.a, sector),
                   over_b = is_above(scene, p, e.b, sector);
        if (over_a == over_b) continue;
        const bool left = sli_sector_is_left(e.a, e.b, p, sector);
        if (over_a && left) winding++;
        if (over_b && !left) winding--;
    }
    return !outline || winding != 0;
}

bool sli_outline_holds(const sli_proof_scene *scene, const sl_shape *outline, sl_point at) {
    const sli_direction any[] = {{scene->bounds.min, scene->bounds.max},
                                 {scene->bounds.max, scene->bounds.min}};
    const sli_meet p = sli_meet_point(at);
    for (edge e = {0}; next_edge(outline, &e);) {
        const sl_box box = {{fmin(e.a.x, e.b.x), fmin(e.a.y, e.b.y)},
                            {fmax(e.a.x, e.b.x), fmax(e.a.y, e.b.y)}};
        if (sli_box_holds(&box, at) && !sli_orient(e.a, e.b, at)) return false;
    }
    return sli_outline_has_sector(scene, outline, &p, any);
}

sl_status sli_outline_add_parts(sl_context *context, const sl_shape *outline, uint32_t group,
                                sli_ray_parts *parts) {
    for (edge e = {0}; next_edge(outline, &e);)
        SL_TRY(sli_ray_add(context, sli_ray_between(e.a, e.b, group--, SLI_PART_EDGE), parts));
    return SL_OK;
}

sl_status sli_outline_add_directions(sl_context *context, const sl_shape *outline,
                                     const sli_meet *p, sli_directions *out) {
    for (edge e = {0}; next_edge(outline, &e);)
        if (!sli_meet_side(p, e.a, e.b)) SL_TRY(sli_directions_add(context, e.a, e.b, out));
    return SL_OK;
}
