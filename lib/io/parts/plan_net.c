/// Walls are joined by sets (union by the smaller number). What is near is found by a tree of
/// boxes.
#include "io/parts/plan_net.h"

#include <math.h>

/// What is looked at: so many walls, and so many that are near others.
enum { MOST_WALLS = 100000, MOST_NEAR = 1 << 23 };

static void join(uint32_t *sets, uint32_t a, uint32_t b) {
    a = sl_root_of(sets, a);
    b = sl_root_of(sets, b);
    sets[a < b ? b : a] = a < b ? a : b;
}

static sl_point minus(sl_point a, sl_point b) {
    return (sl_point){a.x - b.x, a.y - b.y};
}

static double length(sl_point u) {
    return sli_length(u.x, u.y);
}

static sl_point end_of(const sli_plan_net *n, uint32_t end) {
    const sl_wall *wall = &n->map->walls[end / 2];
    return end % 2 ? wall->b : wall->a;
}

/// Finds the walls near a segment; none, once there were too many.
static sl_status find_near(sli_plan_net *n, sl_segment at, double reach) {
    n->index.near.count = 0;
    if (n->near > MOST_NEAR) return SL_OK;
    SL_TRY(sli_walls_near(n->context, &n->index, at, reach));
    n->near += n->index.near.count;
    return SL_OK;
}

// --- what meets

/// Joins an end with the ends and the sides of the walls near it. `sides` alone: all ends are
/// joined, and one end of each corner stands for it.
static sl_status look_at_end(sli_plan_net *n, uint32_t end, bool sides) {
    const sl_point at = end_of(n, end);
    SL_TRY(find_near(n, (sl_segment){at, at}, n->tolerance));
    for (size_t k = 0; k < n->index.near.count; k++) {
        const uint32_t other = n->index.near.items[k];
        const sl_wall *wall = &n->map->walls[other];
        const sl_point along = minus(wall->b, wall->a), from = minus(at, wall->a);
        const double far = length(along), way = sli_dot(from, along) / far;
        if (other == end / 2) continue;
        if (length(from) <= n->tolerance || length(minus(at, wall->b)) <= n->tolerance) {
            join(n->piece, end / 2, other);
            join(n->corner, end, 2 * other + (length(from) > n->tolerance));
        } else if (sides && way > 0 && way < far &&
                   fabs(sli_cross(along, from)) / far <= n->tolerance) {
            join(n->piece, end / 2, other);
            n->ends_on_sides++;
        }
    }
    return SL_OK;
}

/// How far two walls run along each other, side by side as the two faces of a wall; 0 where they
/// are not parallel, or along less than half of the shorter one. `*away`: how far apart.
static double beside(const sl_wall *wall, const sl_wall *other, double *away) {
    const sl_point u = minus(wall->b, wall->a), v = minus(other->b, other->a);
    const double a = length(u), b = length(v);
    if (fabs(sli_cross(u, v)) > 0.02 * a * b) return 0;
    *away = fabs(sli_cross(u, minus(other->a, wall->a))) / a;
    const double s = sli_dot(u, minus(other->a, wall->a)) / a;
    const double t = sli_dot(u, minus(other->b, wall->a)) / a;
    const double both = fmin(a, fmax(s, t)) - fmax(0, fmin(s, t));
    return both >= 0.5 * fmin(a, b) ? both : 0;
}

static bool is_crossing(const sl_wall *p, const sl_wall *q) {
    const sl_point u = minus(p->b, p->a), v = minus(q->b, q->a);
    const double a = sli_cross(u, minus(q->a, p->a)), b = sli_cross(u, minus(q->b, p->a));
    const double c = sli_cross(v, minus(p->a, q->a)), d = sli_cross(v, minus(p->b, q->a));
    return ((a > 0 && b < 0) || (a < 0 && b > 0)) && ((c > 0 && d < 0) || (c < 0 && d > 0));
}

/// Pairs and crossings with walls behind it in the list.
static sl_status look_beside(sli_plan_net *n, uint32_t i) {
    const sl_wall *wall = &n->map->walls[i];
    SL_TRY(find_near(n, (sl_segment){wall->a, wall->b}, n->most));
    for (size_t k = 0; k < n->index.near.count; k++) {
        const uint32_t j = n->index.near.items[k];
        const sl_wall *other = &n->map->walls[j];
        if (j <= i) continue;
        double away = 0;
        const double along = n->most > 0 ? beside(wall, other, &away) : 0;
        if (along > 0 && away >= n->least && away <= n->most) {
            SL_TRY(SL_ARRAY_ROOM(n->context, &n->pairs, 1));
            n->pairs.items[n->pairs.count++] = (sli_plan_pair){i, j, away, along};
        }
        if (!is_crossing(wall, other)) continue;
        join(n->piece, i, j);
        SL_TRY(SL_ARRAY_ROOM(n->context, &n->crossings, 1));
        n->crossings.items[n->crossings.count++] = (sli_plan_pair){.wall = i, .other = j};
    }
    return SL_OK;
}

static sl_status join_all(sli_plan_net *n) {
    const uint32_t count = (uint32_t)n->map->wall_count;
    for (uint32_t i = 0; i < count; i++) n->piece[i] = i;
    for (uint32_t i = 0; i < 2 * count; i++) n->corner[i] = i;
    for (uint32_t end = 0; end < 2 * count; end++) {
        if (end % 1024 == 0) SL_TRY(sl_check_cancelled(n->context));
        SL_TRY(look_at_end(n, end, false));
    }
    for (uint32_t end = 0; end < 2 * count; end++)
        if (sl_root_of(n->corner, end) == end) SL_TRY(look_at_end(n, end, true));
    for (uint32_t i = 0; i < count; i++) SL_TRY(look_beside(n, i));
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t first = sl_root_of(n->piece, i);
        const sl_wall *wall = &n->map->walls[i];
        if (!n->counts[first]++) n->boxes[first] = sli_box_around(wall->a, wall->a);
        n->boxes[first] = sli_box_with(sli_box_with(n->boxes[first], wall->a), wall->b);
    }
    return SL_OK;
}

sl_status sli_plan_net_make(sl_context *context, const sl_map *map, double least, double most,
                            double tolerance, sli_plan_net *out) {
    const size_t count = map->wall_count;
    *out = (sli_plan_net){.context = context, .map = map, .least = least, .most = most};
    if (!count || count > MOST_WALLS) return SL_OK;
    out->bounds = sl_map_bounds(map);
    out->size = fmax(sli_box_width(out->bounds), sli_box_height(out->bounds));
    out->tolerance = fmax(tolerance, out->size / 10000);
    out->piece = sl_alloc_array(context, count, sizeof *out->piece);
    out->corner = sl_alloc_array(context, 2 * count, sizeof *out->corner);
    out->boxes = sl_alloc_array(context, count, sizeof *out->boxes);
    out->counts = sl_alloc_array(context, count, sizeof *out->counts);
    if (!out->piece || !out->corner || !out->boxes || !out->counts) return SL_NO_MEMORY;
    SL_TRY(sli_wall_index_create(context, map, &out->index));
    SL_TRY(join_all(out));
    out->whole = out->near <= MOST_NEAR;
    return SL_OK;
}

void sli_plan_net_destroy(sli_plan_net *net) {
    sli_wall_index_destroy(net->context, &net->index);
    sl_free(net->context, net->piece);
    sl_free(net->context, net->corner);
    sl_free(net->context, net->boxes);
    sl_free(net->context, net->counts);
    sl_free(net->context, net->pairs.items);
    sl_free(net->context, net->crossings.items);
    *net = (sli_plan_net){0};
}
