/// Viewpoints for checks (proof_view.h).
#include "analysis/placement/proof_view.h"

#include "analysis/placement/view_shapes.h"
#include "geometry/crossing.h"
#include "geometry/orient.h"

#include <math.h>

/// Corners of the polygons: a chord is up to 1.2e-6 and 3.1e-4 of the radius off its arc.
enum { RING_WHOLE = 2048, RING_LESS = 128 };
/// A bound on what rounding does to a distance, as a share of it.
#define ROUNDING 1e-9
/// A polygon is nearer to its eye than its circle, or farther away, by this share.
#define MARGIN            4e-9
#define LESS_MARGIN_REACH 1.9e-4
#define LESS_MARGIN_DEAD  2.5e-4

// --- polygons

/// Corners at a distance from a point, by angle from +x; `shift`: the first one's, in steps. They
/// turn left, or the circle is too small.
static sl_status make_ring(sl_context *context, sl_point at, double radius, uint32_t count,
                           double shift, sli_ring *out) {
    const double turn = 8 * atan(1) / count;
    out->corners = sl_alloc_array(context, count, sizeof *out->corners);
    if (!out->corners) return SL_NO_MEMORY;
    out->count = count;
    out->shift = shift;
    out->inner = radius * cos(turn / 2) * (1 - MARGIN);
    out->outer = radius * (1 + MARGIN);
    for (uint32_t i = 0; i < count; i++)
        out->corners[i] = (sl_point){at.x + radius * cos((i + shift) * turn),
                                     at.y + radius * sin((i + shift) * turn)};
    for (uint32_t i = 0; i < count; i++) {
        const sl_point a = out->corners[i], b = out->corners[(i + 1) % count],
                       c = out->corners[(i + 2) % count];
        if (sli_orient(a, b, c) <= 0 || sli_orient(a, b, at) <= 0 ||
            fabs(hypot(a.x - at.x, a.y - at.y) / radius - 1) > ROUNDING)
            return sl_fail(context, SL_UNSUPPORTED,
                           "a circle of radius %.9g about (%.9g, %.9g) is too small for a proof: "
                           "the coordinates there have too few digits",
                           radius, at.x, at.y);
    }
    return SL_OK;
}

static const sl_point axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

/// Circles about places on a grid often touch in one point, on an axis. There the polygons have no
/// margin, so that nothing is left between them: a range has its corner,
static void meet_range(const sli_proof_view *v, sl_point at, sli_ring *ring) {
    for (uint32_t k = 0; k < 4; k++) {
        const sl_point p = {at.x + v->range * axes[k].x, at.y + v->range * axes[k].y};
        if (sli_distance_compare(at, p, v->range) <= 0) ring->corners[k * ring->count / 4] = p;
    }
}

/// and a dead zone its edge.
static void meet_dead_zone(const sli_proof_view *v, sl_point at, sli_ring *ring) {
    for (uint32_t k = 0; k < 4; k++) {
        const sl_point p = {at.x + v->nearest * axes[k].x, at.y + v->nearest * axes[k].y};
        const uint32_t next = k * ring->count / 4;
        sl_point *ends[] = {&ring->corners[next], &ring->corners[(next ? next : ring->count) - 1]};
        if (sli_distance_compare(at, p, v->nearest) < 0) continue;
        for (int e = 0; e < 2; e++) {
            if (k % 2)
                ends[e]->y = p.y;
            else
                ends[e]->x = p.x;
        }
    }
}

static sl_status make_rings(sl_context *context, sl_point at, sli_view_share share,
                            sli_proof_view *out) {
    const bool whole = share == SLI_VIEW_WHOLE;
    const uint32_t count = whole ? RING_WHOLE : RING_LESS;
    const double reach = out->range * (1 - (whole ? MARGIN : LESS_MARGIN_REACH)),
                 dead = out->nearest * (1 + (whole ? MARGIN : LESS_MARGIN_DEAD)) /
                        cos(4 * atan(1) / count);
    if (out->range > 0) SL_TRY(make_ring(context, at, reach, count, 0, &out->reach));
    if (out->nearest > 0) SL_TRY(make_ring(context, at, dead, count, 0.5, &out->dead));
    if (out->range > 0 && whole) meet_range(out, at, &out->reach);
    if (out->nearest > 0 && whole) meet_dead_zone(out, at, &out->dead);
    for (uint32_t i = 0; i < out->reach.count; i++) {
        const sli_meet corner = sli_meet_point(out->reach.corners[i]);
        if (!i) out->box = (sl_box){at, at};
        sli_box_widen(&out->box, &corner);
    }
    return SL_OK;
}

sl_status sli_proof_view_make(sl_context *context, const sl_query *query, const sl_viewpoint *v,
                              const sli_eye *eye, sl_box eye_box, sli_view_share share,
                              sli_proof_view *out) {
    *out = (sli_proof_view){.eye = eye,
                            .cone = v->fov >= 360 ? sl_view_all_round(v->at)
                                                  : sl_query_view(query, v->at, v->heading, v->fov),
                            .box = eye_box,
                            .range = sli_view_range(query, v),
                            .nearest = v->nearest};
    out->wide = !out->cone.full && sli_orient(v->at, out->cone.right, out->cone.left) < 0;
    const sl_status status =
        share == SLI_VIEW_BARE ? SL_OK : make_rings(context, v->at, share, out);
    if (status != SL_OK) {
        sli_proof_view_destroy(context, out);
        return status;
    }
    out->box = (sl_box){{fmax(out->box.min.x, eye_box.min.x), fmax(out->box.min.y, eye_box.min.y)},
                        {fmin(out->box.max.x, eye_box.max.x), fmin(out->box.max.y, eye_box.max.y)}};
    return SL_OK;
}

void sli_proof_view_destroy(sl_context *context, sli_proof_view *view) {
    sl_free(context, view->reach.corners);
    sl_free(context, view->dead.corners);
    *view = (sli_proof_view){0};
}

/// Where a place is surely: 1 within a polygon, -1 without, 0 not sure.
static int place_in_ring(const sli_ring *ring, sl_point eye, const sli_meet *p) {
    const double distance = hypot(p->at.x - eye.x, p->at.y - eye.y);
    const double error = 2 * p->error + ROUNDING * distance;
    if (distance + error < ring->inner) return 1;
    return distance - error > ring->outer ? -1 : 0;
}

// --- what it sees

bool sli_proof_view_reaches(const sli_proof_view *v, sl_point at, bool strictly) {
    const sl_point eye = v->eye->at;
    if (v->range > 0 && sli_distance_compare(eye, at, v->range) >= !strictly) return false;
    return !(v->nearest > 0 && sli_distance_compare(eye, at, v->nearest) <= -!strictly);
}

bool sli_proof_view_holds(const sli_proof_view *v, sl_point at, bool strictly) {
    const sl_point eye = v->eye->at;
    if (!sli_proof_view_reaches(v, at, strictly)) return false;
    if (v->cone.full) return true;
    const int right = sli_orient(eye, v->cone.right, at), left = -sli_orient(eye, v->cone.left, at);
    const bool one = right >= strictly, two = left >= strictly;
    return v->wide ? one || two : one && two;
}

bool sli_proof_view_sees_around(const sli_proof_scene *scene, const sli_proof_view *v,
                                const sli_meet *p) {
    const sl_point eye = v->eye->at;
    if (!sli_box_may_hold(&v->box, p)) return false;
    if (v->reach.count && place_in_ring(&v->reach, eye, p) <= 0) return false;
    if (v->dead.count && place_in_ring(&v->dead, eye, p) >= 0) return false;
    if (!v->cone.full) {
        const bool one = sli_meet_side(p, eye, v->cone.right) > 0,
                   two = sli_meet_side(p, eye, v->cone.left) < 0;
        if (v->wide ? !one && !two : !one || !two) return false;
    }
    return sli_eye_sees_around(scene, v->eye, p);
}

/// The edges near a place that is between the two circles of a ring, *count of them; it is left of
/// the others.
static uint32_t edges_near(const sli_ring *ring, sl_point eye, const sli_meet *p, uint32_t *count) {
    *count = ring->count;
    if (!(p->error < ROUNDING * ring->inner)) return 0;
    const double turn = 8 * atan(1) / ring->count;
    const double at = atan2(p->at.y - eye.y, p->at.x - eye.x) / turn - ring->shift;
    *count = 5;
    return (uint32_t)(floor(at) + 2 * ring->count - 2) % ring->count;
}

static bool ring_has_sector(const sli_ring *ring, sl_point eye, const sli_meet *p,
                            const sli_direction *sector) {
    const int place = place_in_ring(ring, eye, p);
    if (place) return place > 0;
    uint32_t count;
    const uint32_t first = edges_near(ring, eye, p, &count);
    for (uint32_t i = first; i < first + count; i++)
        if (!sli_sector_is_left(ring->corners[i % ring->count],
                                ring->corners[(i + 1) % ring->count], p, sector))
            return false;
    return true;
}

bool sli_proof_view_sees_sector(const sli_proof_scene *scene, const sli_proof_view *v,
                                const sli_meet *p, const sli_direction *sector) {
    const sl_point eye = v->eye->at;
    if (!sli_box_may_hold(&v->box, p)) return false;
    if (v->reach.count && !ring_has_sector(&v->reach, eye, p, sector)) return false;
    if (v->dead.count && ring_has_sector(&v->dead, eye, p, sector)) return false;
    if (!v->cone.full) {
        const bool one = sli_sector_is_left(eye, v->cone.right, p, sector),
                   two = !sli_sector_is_left(eye, v->cone.left, p, sector);
        if (v->wide ? !one && !two : !one || !two) return false;
    }
    return sli_eye_sees_sector(scene, v->eye, p, sector);
}

// --- where its region ends

static sl_status add_ring_directions(sl_context *context, const sli_ring *ring, sl_point eye,
                                     const sli_meet *p, sli_directions *out) {
    if (!ring->count || place_in_ring(ring, eye, p)) return SL_OK;
    uint32_t count;
    const uint32_t first = edges_near(ring, eye, p, &count);
    for (uint32_t i = first; i < first + count; i++) {
        const sl_point a = ring->corners[i % ring->count], b = ring->corners[(i + 1) % ring->count];
        if (!sli_meet_side(p, a, b)) SL_TRY(sli_directions_add(context, a, b, out));
    }
    return SL_OK;
}

sl_status sli_proof_view_add_directions(sl_context *context, const sli_proof_scene *scene,
                                        const sli_proof_view *v, const sli_meet *p,
                                        sli_directions *out) {
    const sl_point eye = v->eye->at;
    if (!sli_box_may_hold(&v->box, p)) return SL_OK;
    SL_TRY(sli_directions_add_eye(context, scene, v->eye, p, out));
    if (!v->cone.full && !sli_meet_side(p, eye, v->cone.right))
        SL_TRY(sli_directions_add(context, eye, v->cone.right, out));
    if (!v->cone.full && !sli_meet_side(p, eye, v->cone.left))
        SL_TRY(sli_directions_add(context, eye, v->cone.left, out));
    SL_TRY(add_ring_directions(context, &v->reach, eye, p, out));
    return add_ring_directions(context, &v->dead, eye, p, out);
}

/// Whether some of an edge may be seen: not if in all cones of the eye that have it, it lies beyond
/// the wall there, or if it is out of the view's cone.
static bool edge_matters(const sli_proof_scene *scene, const sli_proof_view *v, sl_point a,
                         sl_point b) {
    const sli_eye *e = v->eye;
    const sli_meet p = sli_meet_point(a), q = sli_meet_point(b);
    if (!v->cone.full && !v->wide) {
        const sl_point right = v->cone.right, left = v->cone.left;
        if (sli_orient(e->at, right, a) < 0 && sli_orient(e->at, right, b) < 0) return false;
        if (sli_orient(e->at, left, a) > 0 && sli_orient(e->at, left, b) > 0) return false;
    }
    const uint32_t last = sli_eye_bearing(e, &q).ray;
    for (uint32_t ray = sli_eye_bearing(e, &p).ray;; ray = (ray + 1) % e->ray_count) {
        const int32_t wall = e->rays[ray].cone;
        if (wall == SLI_NO_WALL) return true;
        if (wall >= 0 &&
            (sli_eye_side(scene, e, wall, &p) > 0 || sli_eye_side(scene, e, wall, &q) > 0))
            return true;
        if (ray == last) return false;
    }
}

static sl_status add_ring_parts(sl_context *context, const sli_proof_scene *scene,
                                const sli_proof_view *v, const sli_ring *ring, uint32_t group,
                                sli_ray_parts *parts) {
    for (uint32_t i = 0; i < ring->count; i++) {
        const sl_point a = ring->corners[i], b = ring->corners[(i + 1) % ring->count];
        if (!edge_matters(scene, v, a, b)) continue;
        SL_TRY(sli_ray_add(context,
                           (sli_ray_part){.line = {a, b},
                                          .from = a,
                                          .to = sli_meet_point(b),
                                          .group = group,
                                          .wall = SLI_NO_WALL,
                                          .kind = SLI_PART_EDGE},
                           parts));
    }
    return SL_OK;
}

/// A border of the cone, from the eye to where sight ends.
static sl_status add_border(sl_context *context, const sli_proof_scene *scene, const sli_eye *e,
                            sl_point through, uint32_t group, sli_ray_parts *parts) {
    const sli_meet p = sli_meet_point(through);
    const sli_bearing b = sli_eye_bearing(e, &p);
    const int32_t wall = b.on ? e->rays[b.ray].end : e->rays[b.ray].cone;
    const sl_segment line = {e->at, through};
    if (wall < 0 || !sli_turn(line.a, line.b, scene->walls[wall].a, scene->walls[wall].b))
        return SL_OK;
    return sli_ray_add(context,
                       (sli_ray_part){.line = line,
                                      .from = e->at,
                                      .to = sli_meet_lines(line, scene->walls[wall]),
                                      .group = group,
                                      .wall = wall},
                       parts);
}

sl_status sli_proof_view_add_parts(sl_context *context, const sli_proof_scene *scene,
                                   const sli_proof_view *v, uint32_t number, sli_ray_parts *parts) {
    const sli_eye *e = v->eye;
    const uint32_t group = 3 * number;
    sli_ray_part part;
    for (uint32_t i = 0; i < e->ray_count; i++) {
        const sl_point to = e->rays[i].to;
        const sli_meet p = sli_meet_point(to);
        if (!sli_ray_of_eye(scene, e, i, group, &part)) continue;
        if (v->reach.count && place_in_ring(&v->reach, e->at, &p) < 0) continue;
        if (!v->cone.full) {
            const bool one = sli_orient(e->at, v->cone.right, to) >= 0,
                       two = sli_orient(e->at, v->cone.left, to) <= 0;
            if (v->wide ? !one && !two : !one || !two) continue;
        }
        SL_TRY(sli_ray_add(context, part, parts));
    }
    if (!v->cone.full) {
        SL_TRY(add_border(context, scene, e, v->cone.right, group, parts));
        SL_TRY(add_border(context, scene, e, v->cone.left, group, parts));
    }
    SL_TRY(add_ring_parts(context, scene, v, &v->reach, group + 1, parts));
    return add_ring_parts(context, scene, v, &v->dead, group + 2, parts);
}
