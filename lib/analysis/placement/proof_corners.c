/// Corners of arrangements for checks (proof_corners.h).
#include "analysis/placement/proof_corners.h"

#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

// --- boxes

bool sli_box_may_hold(const sl_box *box, const sli_meet *p) {
    return !(p->at.x + p->error < box->min.x) && !(p->at.x - p->error > box->max.x) &&
           !(p->at.y + p->error < box->min.y) && !(p->at.y - p->error > box->max.y);
}

// --- parts of lines

sl_status sli_ray_add(sl_context *context, sli_ray_part part, sli_ray_parts *parts) {
    SL_TRY(SL_ARRAY_ROOM(context, parts, 1));
    part.box = (sl_box){part.from, part.from};
    sli_box_widen(&part.box, &part.to);
    parts->items[parts->count++] = part;
    return SL_OK;
}

sli_ray_part sli_ray_between(sl_point a, sl_point b, uint32_t group, sli_part_kind kind) {
    return (sli_ray_part){.line = {a, b},
                          .from = a,
                          .to = sli_meet_point(b),
                          .group = group,
                          .wall = SLI_NO_WALL,
                          .kind = kind};
}

bool sli_ray_of_eye(const sli_proof_scene *scene, const sli_eye *e, uint32_t ray, uint32_t group,
                    sli_ray_part *out) {
    const sli_proof_ray *r = &e->rays[ray];
    const sl_segment line = {e->at, r->to};
    if (!r->window) return false;
    *out = (sli_ray_part){.line = line,
                          .from = r->to,
                          .to = sli_meet_lines(line, scene->walls[r->end]),
                          .group = group,
                          .wall = r->end};
    return true;
}

sl_status sli_ray_add_eye(sl_context *context, const sli_proof_scene *scene, const sli_eye *e,
                          uint32_t group, sli_ray_parts *parts) {
    sli_ray_part part;
    for (uint32_t i = 0; i < e->ray_count; i++)
        if (sli_ray_of_eye(scene, e, i, group, &part)) SL_TRY(sli_ray_add(context, part, parts));
    return SL_OK;
}

static int compare_rays(const void *left, const void *right) {
    const sli_ray_part *a = left, *b = right;
    if (a->box.min.x != b->box.min.x) return a->box.min.x < b->box.min.x ? -1 : 1;
    return (a->group > b->group) - (a->group < b->group);
}

/// By the left border of their boxes.
static void sort_rays(sli_ray_parts *parts) {
    if (parts->count) qsort(parts->items, parts->count, sizeof *parts->items, compare_rays);
}

/// Whether the lines of a place meet in a corner of walls.
static bool is_wall_corner(const sli_proof_scene *scene, const sli_meet *p) {
    uint32_t low = 0, high = scene->corner_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (scene->corners[middle].at.x < p->at.x - p->error)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < scene->corner_count; low++) {
        const sl_point at = scene->corners[low].at;
        if (at.x > p->at.x + p->error) return false;
        if (!sli_orient(p->s.a, p->s.b, at) && !sli_orient(p->t.a, p->t.b, at)) return true;
    }
    return false;
}

/// Whether a part lies on one side of another one's line.
static bool is_beside(const sli_ray_part *part, const sl_segment *line) {
    return sli_orient(line->a, line->b, part->from) * sli_meet_side(&part->to, line->a, line->b) >
           0;
}

static bool need_no_crossing(const sli_ray_part *r, const sli_ray_part *s) {
    if (r->group == s->group) return true;
    if (r->kind == SLI_PART_WALL) return s->kind != SLI_PART_EDGE;
    if (s->kind == SLI_PART_WALL) return r->kind != SLI_PART_EDGE;
    return r->kind == SLI_PART_BORDER && s->kind == SLI_PART_BORDER;
}

bool sli_rays_cross(const sli_proof_scene *scene, const sli_ray_part *r, const sli_ray_part *s,
                    sli_meet *p) {
    if (s->box.min.y > r->box.max.y || s->box.max.y < r->box.min.y || need_no_crossing(r, s) ||
        !sli_turn(r->line.a, r->line.b, s->line.a, s->line.b))
        return false;
    *p = sli_meet_lines(r->line, s->line);
    return sli_box_may_hold(&r->box, p) && sli_box_may_hold(&s->box, p) &&
           !is_beside(r, &s->line) && !is_beside(s, &r->line) && !is_wall_corner(scene, p);
}

sl_status sli_rays_visit(sl_context *context, const sli_proof_scene *scene, sli_ray_parts *parts,
                         sli_corner_visit visit, void *data) {
    sli_meet p;
    sort_rays(parts);
    for (size_t i = 0; i < parts->count; i++) {
        const sli_ray_part *r = &parts->items[i];
        SL_TRY(sl_check_cancelled(context));
        if (r->wall != SLI_NO_WALL && !is_wall_corner(scene, &r->to))
            SL_TRY(visit(data, &r->to, r->wall, r->group));
        for (size_t k = i + 1; k < parts->count; k++) {
            const sli_ray_part *s = &parts->items[k];
            if (s->box.min.x > r->box.max.x) break;
            if (sli_rays_cross(scene, r, s, &p)) SL_TRY(visit(data, &p, SLI_NO_WALL, r->group));
        }
    }
    return SL_OK;
}

bool sli_cell_has_meet(const sl_space *space, uint32_t cell, const sl_box *box, const sli_meet *p) {
    const sl_cell *k = &space->cells[cell];
    const sl_point *corners = space->vertices + k->first_vertex;
    if (!k->inside || !sli_box_may_hold(box, p)) return false;
    for (uint32_t i = 0; i < k->vertex_count; i++)
        if (sli_meet_side(p, corners[i], corners[(i + 1) % k->vertex_count]) < 0) return false;
    return true;
}

// --- directions

sl_status sli_directions_add_cell(sl_context *context, const sl_space *space, uint32_t cell,
                                  const sli_meet *p, sli_directions *out) {
    const sl_cell *k = &space->cells[cell];
    const sl_point *corners = space->vertices + k->first_vertex;
    for (uint32_t i = 0; i < k->vertex_count; i++) {
        const sl_point a = corners[i], b = corners[(i + 1) % k->vertex_count];
        if (!sli_meet_side(p, a, b)) SL_TRY(sli_directions_add(context, a, b, out));
    }
    return SL_OK;
}

sl_status sli_directions_add(sl_context *context, sl_point a, sl_point b, sli_directions *out) {
    SL_TRY(SL_ARRAY_ROOM(context, out, 2));
    out->items[out->count++] = (sli_direction){a, b};
    out->items[out->count++] = (sli_direction){b, a};
    return SL_OK;
}

sl_status sli_directions_add_eye(sl_context *context, const sli_proof_scene *scene,
                                 const sli_eye *e, const sli_meet *p, sli_directions *out) {
    const sli_bearing b = sli_eye_bearing(e, p);
    if (b.here) {
        for (uint32_t i = 0; i < e->ray_count; i++)
            SL_TRY(sli_directions_add(context, e->at, e->rays[i].to, out));
        return SL_OK;
    }
    if (b.on) SL_TRY(sli_directions_add(context, e->at, e->rays[b.ray].to, out));
    const uint32_t rays[] = {b.ray, b.ray ? b.ray - 1 : e->ray_count - 1};
    for (int i = 0; i < (b.on ? 2 : 1); i++) {
        const int32_t wall = e->rays[rays[i]].cone;
        if (wall < 0 || sli_eye_side(scene, e, wall, p)) continue;
        SL_TRY(sli_directions_add(context, scene->walls[wall].a, scene->walls[wall].b, out));
    }
    return SL_OK;
}

static int compare_directions(const void *left, const void *right) {
    const sli_direction *a = left, *b = right;
    const int one = sli_compare_points(a->a, a->b), two = sli_compare_points(b->a, b->b);
    if (one != two) return one < two ? -1 : 1;
    return -sli_turn(a->a, a->b, b->a, b->b);
}

void sli_directions_sort(sli_directions *d) {
    size_t kept = 0;
    if (d->count) qsort(d->items, d->count, sizeof *d->items, compare_directions);
    for (size_t i = 0; i < d->count; i++)
        if (!kept || compare_directions(&d->items[kept - 1], &d->items[i]))
            d->items[kept++] = d->items[i];
    d->count = kept;
}

// --- sectors

/// On which side of a line through its corner a sector is: 1 left, -1 right. No line of the corner
/// is within the sector. So its first direction says it, or its last where the first is in line.
static int sector_side(sli_direction line, const sli_direction *sector) {
    const int first = sli_turn(line.a, line.b, sector[0].a, sector[0].b);
    if (first) return first;
    const int last = sli_turn(line.a, line.b, sector[1].a, sector[1].b);
    if (last) return last;
    return sli_compare_points(line.a, line.b) == sli_compare_points(sector[0].a, sector[0].b) ? 1
                                                                                              : -1;
}

bool sli_sector_is_left(sl_point a, sl_point b, const sli_meet *p, const sli_direction *sector) {
    const int side = sli_meet_side(p, a, b);
    return side ? side > 0 : sector_side((sli_direction){a, b}, sector) > 0;
}

bool sli_polygon_has_sector(const sl_point *corners, size_t count, const sli_meet *p,
                            const sli_direction *sector) {
    for (size_t i = 0; i < count; i++)
        if (!sli_sector_is_left(corners[i], corners[i + 1 < count ? i + 1 : 0], p, sector))
            return false;
    return true;
}

bool sli_eye_sees_sector(const sli_proof_scene *scene, const sli_eye *e, const sli_meet *p,
                         const sli_direction *sector) {
    const sli_bearing b = sli_eye_bearing(e, p);
    uint32_t ray = b.ray;
    const uint32_t last = e->ray_count - 1;
    if (b.here) {
        for (ray = 0; ray < e->ray_count; ray++) {
            const sli_direction from = {e->at, e->rays[ray].to},
                                to = {e->at, e->rays[ray == last ? 0 : ray + 1].to};
            if (sector_side(from, sector) > 0 && sector_side(to, sector) < 0) break;
        }
        return ray < e->ray_count && e->rays[ray].cone != SLI_SHUT;
    }
    if (b.on && sector_side((sli_direction){e->at, e->rays[ray].to}, sector) < 0)
        ray = ray ? ray - 1 : last;
    const int32_t wall = e->rays[ray].cone;
    if (wall < 0) return false;
    const int side = sli_eye_side(scene, e, wall, p);
    if (side) return side > 0;
    const sl_segment *w = &scene->walls[wall];
    return sector_side(*w, sector) * sli_orient(w->a, w->b, e->at) > 0;
}

bool sli_eye_sees_around(const sli_proof_scene *scene, const sli_eye *e, const sli_meet *p) {
    const sli_bearing b = sli_eye_bearing(e, p);
    if (b.on) return false;
    const int32_t wall = e->rays[b.ray].cone;
    return wall >= 0 && sli_eye_side(scene, e, wall, p) > 0;
}
