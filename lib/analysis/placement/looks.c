/// Looks: the fronts and windows of visible regions.
#include "analysis/placement/looks.h"

#include "analysis/placement/place_ground.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/support.h"

double sli_look_angle(sl_point d) {
    const double share = d.x / (fabs(d.x) + fabs(d.y));
    return d.y < 0 ? 3 + share : 1 - share;
}

static bool is_wall(const sl_region_edge *edge) {
    return edge->kind == SL_EDGE_WALL || edge->kind == SL_EDGE_BORDER;
}

/// The line of the wall, or of the map's border, that an edge is on.
static sl_segment line_of(const sl_space *space, const sl_region *r, size_t i) {
    if (r->edges[i].wall < space->wall_count)
        return (sl_segment){space->walls[r->edges[i].wall].a, space->walls[r->edges[i].wall].b};
    const sl_box *b = &space->bounds;
    const sl_point p = r->points[i], q = r->points[(i + 1) % r->count];
    if (p.x == q.x && (p.x == b->min.x || p.x == b->max.x))
        return (sl_segment){{p.x, b->min.y}, {p.x, b->max.y}};
    return (sl_segment){{b->min.x, p.y}, {b->max.x, p.y}};
}

/// Whether the corner between edges i and i + 1, both on walls, is on both. Else a window between
/// them was too short for doubles. A shut door may end within a wall.
static bool joins(const sl_space *space, const sl_region *r, size_t i) {
    const size_t next = (i + 1) % r->count;
    const sl_segment a = line_of(space, r, i), b = line_of(space, r, next);
    return sli_segment_holds(&a, r->points[next]) && sli_segment_holds(&b, r->points[next]);
}

typedef struct builder {
    const sl_space *space;
    const sl_region *region;
    sli_look *look;
} builder;

static size_t around(const builder *b, size_t i) {
    return i % b->region->count;
}

/// The corner whose ray point i is on: the point itself, or the apex of the window beside it.
static bool ray_of(const builder *b, size_t i, bool back, sl_point *out) {
    const sl_region *r = b->region;
    i = around(b, i);
    const size_t near = back ? around(b, i + r->count - 1) : around(b, i + 1);
    const size_t edge = back ? near : i;
    if (!r->edges[i].exact && (is_wall(&r->edges[edge]) || !r->edges[near].exact)) return false;
    *out = r->points[r->edges[i].exact ? i : near];
    return true;
}

static bool add_front(const builder *b, size_t i) {
    sli_front *f = &b->look->fronts[b->look->front_count];
    f->wall = line_of(b->space, b->region, i);
    const sl_point eye = b->look->eye;
    // The wall at the eye is seen edge-on.
    if (sli_orient(f->wall.a, f->wall.b, eye) == 0) return true;
    if (!ray_of(b, i, true, &f->right) || !ray_of(b, i + 1, false, &f->left)) return false;
    if (sli_same_point(f->right, eye) || sli_same_point(f->left, eye)) return false;
    if (is_wall(&b->region->edges[around(b, i + 1)]) && !joins(b->space, b->region, i))
        return false;
    b->look->front_count++;
    return true;
}

static bool add_window(const builder *b, size_t i) {
    const sl_region *r = b->region;
    const size_t next = around(b, i + 1), before = around(b, i + r->count - 1);
    const sl_point p = r->offsets[i], q = r->offsets[next];
    const bool outward = sli_dot(p, p) < sli_dot(q, q);
    const size_t near = outward ? i : next, far = outward ? next : i,
                 wall = outward ? next : before;
    if (!r->edges[near].exact || !is_wall(&r->edges[wall])) return false;
    if (r->edges[far].exact) b->look->general = false;
    b->look->windows[b->look->window_count++] =
        (sli_window){r->points[near], line_of(b->space, r, wall), r->points[far], outward ? 1 : -1};
    return true;
}

static void turn_round(sli_front *fronts, uint32_t count) {
    for (uint32_t i = 0; i < count / 2; i++) {
        const sli_front last = fronts[count - 1 - i];
        fronts[count - 1 - i] = fronts[i];
        fronts[i] = last;
    }
}

/// Fronts in the order of their angles: what is behind the greatest step comes first.
static void sort_angles(sli_look *look) {
    uint32_t first = 0;
    for (uint32_t i = 0; i < look->front_count; i++) {
        const sl_point r = look->fronts[i].right;
        look->angles[i] = sli_look_angle((sl_point){r.x - look->eye.x, r.y - look->eye.y});
        if (look->angles[i] < look->angles[first]) first = i;
    }
    turn_round(look->fronts, first);
    turn_round(look->fronts + first, look->front_count - first);
    turn_round(look->fronts, look->front_count);
    for (uint32_t i = 0; i < look->front_count; i++) {
        const sl_point r = look->fronts[i].right;
        look->angles[i] = sli_look_angle((sl_point){r.x - look->eye.x, r.y - look->eye.y});
        if (i && look->angles[i] < look->angles[i - 1]) look->angles[i] = look->angles[i - 1];
    }
}

static bool build(builder *b) {
    const sl_region *r = b->region;
    sli_look *look = b->look;
    look->area = sl_region_area(r);
    look->bounds = (sl_box){r->points[0], r->points[0]};
    look->general = true;
    for (size_t i = 0; i < r->count; i++) {
        const sl_point p = r->points[i];
        look->bounds.min.x = sli_lesser(look->bounds.min.x, p.x);
        look->bounds.min.y = sli_lesser(look->bounds.min.y, p.y);
        look->bounds.max.x = sli_greater(look->bounds.max.x, p.x);
        look->bounds.max.y = sli_greater(look->bounds.max.y, p.y);
        const bool wall = is_wall(&r->edges[i]);
        if (!wall && r->edges[i].kind != SL_EDGE_OCCLUDING) return false;
        if (!(wall ? add_front(b, i) : add_window(b, i))) return false;
    }
    sort_angles(look);
    return true;
}

sl_status sli_look_make(sl_context *context, sl_query *query, sl_region *memory, sl_point eye,
                        sli_look *out, bool *clean) {
    const sl_view view = sl_view_all_round(eye);
    const sl_space *space;
    *out = (sli_look){.eye = eye};
    *clean = false;
    SL_TRY(sl_query_region(context, query, &view, memory));
    SL_TRY(sl_query_space(context, query, &space, NULL));
    if (!memory->count) return SL_OK;
    size_t walls = 0;
    for (size_t i = 0; i < memory->count; i++) walls += is_wall(&memory->edges[i]);
    out->fronts = sl_alloc_array(context, walls, sizeof *out->fronts);
    out->windows = sl_alloc_array(context, memory->count - walls, sizeof *out->windows);
    out->angles = sl_alloc_array(context, walls, sizeof *out->angles);
    const bool room = out->fronts && out->windows && out->angles;
    if (room) *clean = build(&(builder){space, memory, out});
    if (!*clean) sli_look_destroy(context, out);
    return room ? SL_OK : SL_NO_MEMORY;
}

/// Whether a point is between the rays of a front and not behind its wall.
static bool front_holds(sl_point eye, const sli_front *f, sl_point p) {
    return sli_orient(eye, f->right, p) >= 0 && sli_orient(eye, p, f->left) >= 0 &&
           sli_orient(f->wall.a, f->wall.b, p) * sli_orient(f->wall.a, f->wall.b, eye) >= 0;
}

bool sli_look_holds(const sli_look *look, sl_point p) {
    const uint32_t count = look->front_count;
    const sl_point eye = look->eye, d = {p.x - eye.x, p.y - eye.y};
    if (!count) return false;
    if (d.x == 0 && d.y == 0) return true;
    const double angle = sli_look_angle(d);
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (look->angles[middle] <= angle)
            low = middle + 1;
        else
            high = middle;
    }
    // Angles are rounded: the front before and the one behind come into question, too. A region
    // without windows is asked for the lower bound, and has few fronts: all of them.
    const uint32_t most = look->window_count && count > 4 ? 4 : count;
    for (uint32_t i = 0; i < most; i++)
        if (front_holds(eye, &look->fronts[(low + 2 * count - 3 + i) % count], p)) return true;
    return false;
}

void sli_look_destroy(sl_context *context, sli_look *look) {
    sl_free(context, look->fronts);
    sl_free(context, look->windows);
    sl_free(context, look->angles);
    *look = (sli_look){0};
}
