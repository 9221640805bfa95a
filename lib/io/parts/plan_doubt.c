/// Looks at a drawing as a net of lines. Ends that meet are one corner; an end that meets the side
/// of a line divides it, and so does a crossing. Lines that are joined are a piece.
///
/// Of a net with E lines, V corners and C pieces, E - V + C lines may be taken away before it falls
/// into trees: where that is 0 nothing is enclosed (Euler).
#include "io/parts/plan_doubt.h"

#include "geometry/length.h"
#include "space/index.h"

#include <math.h>

/// What is looked at: so many walls, and so many that are near others.
enum { MOST_WALLS = 100000, MOST_NEAR = 1 << 23 };

typedef struct net {
    sl_context *context;
    const sl_map *map;
    double metre, tolerance, size;
    sl_box bounds;
    sli_wall_index index;
    uint32_t *piece;  ///< by wall: another wall of the same piece, or itself
    uint32_t *corner; ///< by end, two a wall: another end of the same corner, or itself
    sl_box *boxes;    ///< by wall, of the first of each piece
    uint32_t *counts; ///< likewise: walls
    sl_bits *paired;  ///< by wall: another one runs beside it, as the sides of a wall do
    size_t ends_on_sides, crossings;
    size_t near; ///< walls that were near others; beyond MOST_NEAR nothing more is looked at
} net;

static uint32_t first_of(uint32_t *sets, uint32_t at) {
    while (sets[at] != at) at = sets[at] = sets[sets[at]];
    return at;
}

static void join(uint32_t *sets, uint32_t a, uint32_t b) {
    a = first_of(sets, a);
    b = first_of(sets, b);
    sets[a < b ? b : a] = a < b ? a : b;
}

static sl_point minus(sl_point a, sl_point b) {
    return (sl_point){a.x - b.x, a.y - b.y};
}

static double cross(sl_point u, sl_point v) {
    return u.x * v.y - u.y * v.x;
}

static double dot(sl_point u, sl_point v) {
    return u.x * v.x + u.y * v.y;
}

static double length(sl_point u) {
    return sli_length(u.x, u.y);
}

static sl_point end_of(const net *n, uint32_t end) {
    const sl_wall *wall = &n->map->walls[end / 2];
    return end % 2 ? wall->b : wall->a;
}

/// Finds the walls near a segment; none, once there were too many.
static sl_status find_near(net *n, sl_segment at, double reach) {
    n->index.near.count = 0;
    if (n->near > MOST_NEAR) return SL_OK;
    SL_TRY(sli_walls_near(n->context, &n->index, at, reach));
    n->near += n->index.near.count;
    return SL_OK;
}

// --- what meets

/// Joins an end with the ends and the sides of the walls near it. `sides` alone: all ends are
/// joined, and one end of each corner stands for it.
static sl_status look_at_end(net *n, uint32_t end, bool sides) {
    const sl_point at = end_of(n, end);
    SL_TRY(find_near(n, (sl_segment){at, at}, n->tolerance));
    for (size_t k = 0; k < n->index.near.count; k++) {
        const uint32_t other = n->index.near.items[k];
        const sl_wall *wall = &n->map->walls[other];
        const sl_point along = minus(wall->b, wall->a), from = minus(at, wall->a);
        const double far = length(along), way = dot(from, along) / far;
        if (other == end / 2) continue;
        if (length(from) <= n->tolerance || length(minus(at, wall->b)) <= n->tolerance) {
            join(n->piece, end / 2, other);
            join(n->corner, end, 2 * other + (length(from) > n->tolerance));
        } else if (sides && way > 0 && way < far &&
                   fabs(cross(along, from)) / far <= n->tolerance) {
            join(n->piece, end / 2, other);
            n->ends_on_sides++;
        }
    }
    return SL_OK;
}

/// Whether two walls stand side by side as the two faces of a wall: parallel, at a distance from
/// `least` to `most`, along half of the shorter one.
static bool is_pair(const sl_wall *wall, const sl_wall *other, double least, double most) {
    const sl_point u = minus(wall->b, wall->a), v = minus(other->b, other->a);
    const double a = length(u), b = length(v);
    if (fabs(cross(u, v)) > 0.02 * a * b) return false;
    const double away = fabs(cross(u, minus(other->a, wall->a))) / a;
    const double s = dot(u, minus(other->a, wall->a)) / a, t = dot(u, minus(other->b, wall->a)) / a;
    const double both = fmin(a, fmax(s, t)) - fmax(0, fmin(s, t));
    return away >= least && away <= most && both >= 0.5 * fmin(a, b);
}

static bool is_crossing(const sl_wall *p, const sl_wall *q) {
    const sl_point u = minus(p->b, p->a), v = minus(q->b, q->a);
    const double a = cross(u, minus(q->a, p->a)), b = cross(u, minus(q->b, p->a));
    const double c = cross(v, minus(p->a, q->a)), d = cross(v, minus(p->b, q->a));
    return ((a > 0 && b < 0) || (a < 0 && b > 0)) && ((c > 0 && d < 0) || (c < 0 && d > 0));
}

/// Pairs, and crossings with walls behind it in the list.
static sl_status look_beside(net *n, uint32_t i) {
    const sl_wall *wall = &n->map->walls[i];
    const double most = n->metre > 0 ? 0.6 * n->metre : 0, least = 0.05 * n->metre;
    SL_TRY(find_near(n, (sl_segment){wall->a, wall->b}, most));
    for (size_t k = 0; k < n->index.near.count; k++) {
        const uint32_t j = n->index.near.items[k];
        const sl_wall *other = &n->map->walls[j];
        if (j == i) continue;
        if (most > 0 && is_pair(wall, other, least, most)) sl_bits_add(n->paired, i);
        if (j > i && is_crossing(wall, other)) {
            join(n->piece, i, j);
            n->crossings++;
        }
    }
    return SL_OK;
}

static sl_status join_all(net *n) {
    const uint32_t count = (uint32_t)n->map->wall_count;
    for (uint32_t i = 0; i < count; i++) n->piece[i] = i;
    for (uint32_t i = 0; i < 2 * count; i++) n->corner[i] = i;
    for (uint32_t end = 0; end < 2 * count; end++) {
        if (end % 1024 == 0) SL_TRY(sl_check_cancelled(n->context));
        SL_TRY(look_at_end(n, end, false));
    }
    for (uint32_t end = 0; end < 2 * count; end++)
        if (first_of(n->corner, end) == end) SL_TRY(look_at_end(n, end, true));
    for (uint32_t i = 0; i < count; i++) SL_TRY(look_beside(n, i));
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t first = first_of(n->piece, i);
        const sl_wall *wall = &n->map->walls[i];
        if (!n->counts[first]++) n->boxes[first] = sli_box_around(wall->a, wall->a);
        n->boxes[first] = sli_box_with(sli_box_with(n->boxes[first], wall->a), wall->b);
    }
    return SL_OK;
}

// --- what is told

static double width(sl_box box) {
    return box.max.x - box.min.x;
}

static double height(sl_box box) {
    return box.max.y - box.min.y;
}

/// Small pieces, but for those that are long or have the sides of walls.
static sl_status count_small(net *n, sli_plan_look *out) {
    const uint32_t count = (uint32_t)n->map->wall_count;
    sl_bits *walls = sl_alloc_array(n->context, sl_bits_words(count), sizeof *walls);
    if (!walls) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        if (sl_bits_has(n->paired, i)) sl_bits_add(walls, first_of(n->piece, i));
    for (uint32_t i = 0; i < count; i++) {
        const double w = width(n->boxes[i]), h = height(n->boxes[i]);
        if (first_of(n->piece, i) != i || sl_bits_has(walls, i)) continue;
        if (fmax(w, h) > n->size / 12 || fmax(w, h) > 3 * fmin(w, h)) continue;
        out->pieces++;
        out->small += n->counts[i];
    }
    sl_free(n->context, walls);
    return SL_OK;
}

/// Whether a piece of four upright and level walls has all else in it, with room on all sides, and
/// something large among that.
static bool is_frame(net *n, uint32_t piece) {
    const sl_box box = n->boxes[piece];
    const double room = n->size / 50;
    bool large = false;
    if (n->counts[piece] != 4 || width(box) < width(n->bounds) || height(box) < height(n->bounds))
        return false;
    for (uint32_t i = 0; i < n->map->wall_count; i++) {
        const sl_wall *wall = &n->map->walls[i];
        const uint32_t first = first_of(n->piece, i);
        if (first == piece) {
            if (wall->a.x != wall->b.x && wall->a.y != wall->b.y) return false;
            continue;
        }
        const sl_box at = n->boxes[first];
        if (at.min.x < box.min.x + room || at.min.y < box.min.y + room ||
            at.max.x > box.max.x - room || at.max.y > box.max.y - room)
            return false;
        large |= n->counts[first] >= 8 && width(at) >= 0.4 * width(box) &&
                 height(at) >= 0.4 * height(box);
    }
    return large;
}

static sl_status find_all(net *n, sli_plan_look *out) {
    const uint32_t count = (uint32_t)n->map->wall_count;
    size_t corners = 0, pieces = 0;
    SL_TRY(join_all(n));
    if (n->near > MOST_NEAR) return SL_OK;
    for (uint32_t i = 0; i < 2 * count; i++) corners += first_of(n->corner, i) == i;
    for (uint32_t i = 0; i < count; i++) {
        if (first_of(n->piece, i) != i) continue;
        pieces++;
        out->frame |= is_frame(n, i);
    }
    const size_t lines = count + n->ends_on_sides + n->crossings + pieces;
    out->walls = count;
    out->closed = lines > corners ? lines - corners : 0;
    return count_small(n, out);
}

sl_status sli_plan_look_at(sl_context *context, const sl_map *map, double metre, double tolerance,
                           sli_plan_look *out) {
    const size_t count = map->wall_count;
    *out = (sli_plan_look){0};
    if (!count || count > MOST_WALLS) return SL_OK;
    net n = {.context = context, .map = map, .metre = metre, .bounds = sl_map_bounds(map)};
    n.size = fmax(width(n.bounds), height(n.bounds));
    n.tolerance = fmax(tolerance, n.size / 10000);
    n.piece = sl_alloc_array(context, count, sizeof *n.piece);
    n.corner = sl_alloc_array(context, 2 * count, sizeof *n.corner);
    n.boxes = sl_alloc_array(context, count, sizeof *n.boxes);
    n.counts = sl_alloc_array(context, count, sizeof *n.counts);
    n.paired = sl_alloc_array(context, sl_bits_words(count), sizeof *n.paired);
    sl_status status =
        n.piece && n.corner && n.boxes && n.counts && n.paired ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = sli_wall_index_create(context, map, &n.index);
    if (status == SL_OK) status = find_all(&n, out);
    sli_wall_index_destroy(context, &n.index);
    sl_free(context, n.piece);
    sl_free(context, n.corner);
    sl_free(context, n.boxes);
    sl_free(context, n.counts);
    sl_free(context, n.paired);
    return status;
}

sl_status sli_plan_tell(sl_context *context, const char *file, const sl_map *map, double metre,
                        double tolerance) {
    sli_plan_look look;
    SL_TRY(sli_plan_look_at(context, map, metre, tolerance, &look));
    if (look.walls >= 20 && look.pieces >= 3 && 2 * look.small >= look.walls)
        sl_note(context,
                "%s: %.0f %% of the lines are small pieces that touch nothing: furniture or "
                "symbols? sightline info %s lists the layers, --layers A,B takes those of walls",
                file, 100 * (double)look.small / (double)look.walls, file);
    if (look.frame)
        sl_note(context,
                "%s: a rectangle about all else touches nothing: if it is the frame of a sheet, "
                "what is inside is wrong: --layers A,B leaves it out",
                file);
    if (look.walls >= 10 && !look.closed)
        sl_note(context,
                "%s: its lines enclose nothing: if it is a plan, walls are missing: sightline info "
                "%s lists the layers, --layers '*' takes all",
                file, file);
    return SL_OK;
}
