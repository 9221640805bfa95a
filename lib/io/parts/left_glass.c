/// Windows as thin lines in the gaps of outer walls:
///
///     -------+               +-------
///            |===============|
///            |===============|
///     -------+               +-------
///
/// Two lines or more lead from jamb to jamb. A jamb is the short end of a wall's outline, or the
/// end of a wall that is drawn by one thick line. No wall closes the gap. It has a free view on one
/// side, and a wall on the other: doors and lintels between rooms have walls on both. All such
/// lines are glass.
#include "io/parts/left_out.h"

#include <stdlib.h>
#include <string.h>

/// More lines are not looked at; so much work goes into lines near others, and into views from
/// gaps.
enum { MOST_LINES = 100000, MOST_NEAR = 1 << 25, MOST_VIEWS = 200000000 };
/// How thick walls are at most, and how wide gaps are, in metres and as shares of the drawing.
static const double THICK = 0.7, LEAST = 0.25, MOST = 8;
static const double THICK_SHARE = 1.0 / 25, LEAST_SHARE = 1.0 / 100, MOST_SHARE = 1.0 / 3;
/// How far a pane may end before its jamb, and behind it, as shares of its length.
static const double SHORT = 0.02, BEYOND = 0.15;
/// How much of the longer one of two lines is beside the other in one gap.
static const double SIDE = 0.8;

// --- the search

sl_status sli_left_out_make(sli_left_out *left, bool *fits) {
    const size_t count = left->map->wall_count;
    size_t walls = 0;
    *fits = false;
    for (size_t i = 0; i < count; i++) {
        walls += sl_bits_has(left->walls, i);
        left->widest = fmax(left->widest, left->pens[i]);
    }
    if (!walls || count > MOST_LINES) return SL_OK;
    sl_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = 0; i < count; i++)
        if (sl_bits_has(left->walls, i))
            box = sli_box_with(sli_box_with(box, left->map->walls[i].a), left->map->walls[i].b);
    left->size = fmax(box.max.x - box.min.x, box.max.y - box.min.y);
    left->off = left->size / 5000;
    if (!(left->size > 4 * left->metre && left->size < 400 * left->metre)) left->metre = 0;
    left->glass = sl_alloc_array(left->context, sl_bits_words(count), sizeof *left->glass);
    if (!left->glass) return SL_NO_MEMORY;
    *fits = true;
    return sli_wall_index_create(left->context, left->map, &left->index);
}

void sli_left_out_destroy(sli_left_out *left) {
    sli_wall_index_destroy(left->context, &left->index);
    sl_free(left->context, left->glass);
    left->glass = NULL;
}

/// Puts the lines near a line into left->index.near, and counts them.
static sl_status find_near(sli_left_out *left, sl_point a, sl_point b, double reach) {
    SL_TRY(sli_walls_near(left->context, &left->index, (sl_segment){a, b}, reach));
    left->near += left->index.near.count;
    return SL_OK;
}

// --- jambs

/// A line from jamb to jamb.
typedef struct pane {
    uint32_t gap; ///< the first line of its gap
    uint32_t line, jambs[2];
} pane;

/// An end of a line, with the direction that it goes there.
typedef struct line_end {
    sl_point at, along;
    double slack;  ///< how far it may end before a jamb
    double beyond; ///< and behind it
} line_end;

static sl_point direction(sl_point a, sl_point b) {
    const double length = sli_length(b.x - a.x, b.y - a.y);
    return (sl_point){(b.x - a.x) / length, (b.y - a.y) / length};
}

/// Whether a wall lies across the end of a line that goes in the direction `u`, as the end of a
/// wall's outline does. The line may end a little before it, or in the wall.
static bool is_across(const sli_left_out *left, const sl_wall *wall, const line_end *e) {
    const sl_point a = {wall->a.x - e->at.x, wall->a.y - e->at.y};
    const sl_point b = {wall->b.x - e->at.x, wall->b.y - e->at.y};
    const double s = sli_cross(e->along, a), t = sli_cross(e->along, b);
    const double ahead = (sli_dot(e->along, a) + sli_dot(e->along, b)) / 2;
    return fabs(sli_dot(direction(wall->a, wall->b), e->along)) <= SLI_LEFT_OUT_TURN &&
           sli_wall_length(wall) <= sli_left_out_scaled(left, THICK, THICK_SHARE) &&
           fmin(s, t) <= left->off && fmax(s, t) >= -left->off && ahead <= e->slack &&
           ahead >= -e->beyond;
}

/// Whether a wall that is drawn by a line of its own width begins at an end, in line.
static bool is_in_line(const sli_left_out *left, uint32_t number, const line_end *e) {
    const sl_wall *wall = &left->map->walls[number];
    const sl_point end = e->at, u = e->along;
    const double off = e->slack + left->pens[number];
    const bool back = sli_length(wall->b.x - end.x, wall->b.y - end.y) <
                      sli_length(wall->a.x - end.x, wall->a.y - end.y);
    const sl_point from = back ? wall->b : wall->a, to = back ? wall->a : wall->b;
    const sl_point w = direction(from, to), away = {from.x - end.x, from.y - end.y};
    return left->pens[number] > 0 && sli_dot(w, u) > 0 &&
           fabs(sli_cross(w, u)) <= SLI_LEFT_OUT_TURN && fabs(sli_dot(away, u)) <= off &&
           fabs(sli_cross(away, u)) <= off;
}

/// The jamb where a line ends.
static sl_status find_jamb(sli_left_out *left, const line_end *e, uint32_t *jamb) {
    const double reach = fmax(e->slack, e->beyond) + left->widest;
    *jamb = UINT32_MAX;
    SL_TRY(find_near(left, e->at, e->at, reach));
    for (size_t k = 0; k < left->index.near.count; k++) {
        const uint32_t i = left->index.near.items[k];
        const sl_wall *wall = &left->map->walls[i];
        if (!sl_bits_has(left->walls, i) || !(sli_wall_length(wall) > 0) || i >= *jamb) continue;
        if (is_across(left, wall, e) || is_in_line(left, i, e)) *jamb = i;
    }
    return SL_OK;
}

/// Finds the lines from jamb to jamb.
static sl_status find_panes(sli_left_out *left, pane *panes, size_t *count) {
    for (uint32_t i = 0; i < (uint32_t)left->map->wall_count && left->near <= MOST_NEAR; i++) {
        const sl_wall *wall = &left->map->walls[i];
        const double length = sli_wall_length(wall);
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(left->context));
        if (!left->kinds[i] || length < sli_left_out_scaled(left, LEAST, LEAST_SHARE) ||
            length > sli_left_out_scaled(left, MOST, MOST_SHARE))
            continue;
        const sl_point u = direction(wall->a, wall->b);
        line_end end = {wall->b, u, left->off + SHORT * length, BEYOND * length};
        uint32_t a, b;
        SL_TRY(find_jamb(left, &end, &b));
        if (b == UINT32_MAX) continue;
        end.at = wall->a;
        end.along = (sl_point){-u.x, -u.y};
        SL_TRY(find_jamb(left, &end, &a));
        if (a == UINT32_MAX || a == b) continue;
        panes[(*count)++] = (pane){i, i, {a, b}};
    }
    return SL_OK;
}

static int compare_panes(const void *left, const void *right) {
    const pane *a = left, *b = right;
    if (a->gap != b->gap) return a->gap < b->gap ? -1 : 1;
    return (a->line > b->line) - (a->line < b->line);
}

/// Puts lines side by side into one gap: `gaps` are disjoint sets of lines.
static sl_status join_panes(sli_left_out *left, pane *panes, size_t count, uint32_t *gaps) {
    const double thick = sli_left_out_scaled(left, THICK, THICK_SHARE);
    for (uint32_t i = 0; i < (uint32_t)left->map->wall_count; i++) gaps[i] = UINT32_MAX;
    for (size_t i = 0; i < count; i++) gaps[panes[i].line] = panes[i].line;
    for (size_t i = 0; i < count && left->near <= MOST_NEAR; i++) {
        const uint32_t line = panes[i].line;
        const sl_wall *wall = &left->map->walls[line];
        SL_TRY(find_near(left, wall->a, wall->b, thick));
        for (size_t k = 0; k < left->index.near.count; k++) {
            const uint32_t j = left->index.near.items[k];
            const sl_wall *other = &left->map->walls[j];
            double away = 0;
            if (gaps[j] == UINT32_MAX ||
                sli_left_out_along(wall, other, &away) <
                    SIDE * fmax(sli_wall_length(wall), sli_wall_length(other)))
                continue;
            const uint32_t a = sl_root_of(gaps, line), b = sl_root_of(gaps, j);
            if (fabs(away) <= thick) gaps[a > b ? a : b] = a > b ? b : a;
        }
    }
    for (size_t i = 0; i < count; i++) panes[i].gap = sl_root_of(gaps, panes[i].line);
    return SL_OK;
}

// --- gaps

static sl_point middle(const sl_wall *wall) {
    return (sl_point){wall->a.x / 2 + wall->b.x / 2, wall->a.y / 2 + wall->b.y / 2};
}

/// How many lines of a gap are side by side, up to three: the same one twice is one.
static size_t count_apart(sli_left_out *left, const pane *panes, size_t count) {
    size_t apart = 0;
    for (size_t i = 0, k; i < count && apart < 3; i++) {
        const sl_point at = middle(&left->map->walls[panes[i].line]);
        for (k = 0; k < i; k++) {
            const sl_wall *other = &left->map->walls[panes[k].line];
            if (sli_away_from(other->a, other->b, at) <= left->off) break;
        }
        apart += k == i;
        left->near += k;
    }
    return apart;
}

/// Whether a jamb is the end of a wall, not a side of a column: a line leads away from the gap that
/// is longer than the jamb.
static sl_status find_body(sli_left_out *left, uint32_t jamb, const sl_wall *line, bool *has) {
    const sl_wall *across = &left->map->walls[jamb];
    const sl_point at = middle(line), from = middle(across);
    const sl_point u = {from.x - at.x, from.y - at.y};
    *has |= fabs(sli_dot(direction(across->a, across->b), direction(line->a, line->b))) > 0.5;
    for (int end = 0; end < 2 && !*has; end++) {
        const sl_point corner = end ? across->b : across->a;
        SL_TRY(find_near(left, corner, corner, left->off + left->widest));
        for (size_t k = 0; k < left->index.near.count; k++) {
            const sl_wall *wall = &left->map->walls[left->index.near.items[k]];
            const double length = sli_wall_length(wall);
            if (!sl_bits_has(left->walls, left->index.near.items[k])) continue;
            const bool back = sli_length(wall->b.x - corner.x, wall->b.y - corner.y) <= left->off;
            if (!back && sli_length(wall->a.x - corner.x, wall->a.y - corner.y) > left->off)
                continue;
            const sl_point w = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
            *has |= length >= 1.5 * sli_wall_length(across) &&
                    (back ? -1 : 1) * sli_dot(w, u) >= 0.9 * length * sli_length(u.x, u.y);
        }
    }
    return SL_OK;
}

/// Whether a wall runs along a line of a gap, as near as the gap is deep: then it is no gap.
static sl_status find_wall_along(sli_left_out *left, const pane *p, bool *has) {
    const sl_wall *line = &left->map->walls[p->line];
    double deep = left->off, along = 0;
    for (int i = 0; i < 2; i++) {
        const sl_wall *jamb = &left->map->walls[p->jambs[i]];
        const double in_line =
            fabs(sli_dot(direction(jamb->a, jamb->b), direction(line->a, line->b)));
        deep = fmax(deep, in_line > 0.5 ? 2 * left->pens[p->jambs[i]] : sli_wall_length(jamb));
    }
    SL_TRY(find_near(left, line->a, line->b, deep));
    for (size_t k = 0; k < left->index.near.count; k++) {
        const uint32_t i = left->index.near.items[k];
        double away = 0;
        if (!sl_bits_has(left->walls, i)) continue;
        const double both = sli_left_out_along(line, &left->map->walls[i], &away);
        if (fabs(away) <= deep) along += both;
    }
    *has |= 2 * along > sli_wall_length(line);
    return SL_OK;
}

/// Whether the lines of a gap are glass by what they are and where they end: between columns, two
/// lines may be the faces of a wall.
static sl_status may_be_glass(sli_left_out *left, const pane *panes, size_t count, bool *may) {
    const sl_wall *line = &left->map->walls[panes[0].line];
    const size_t apart = count_apart(left, panes, count);
    bool body = apart > 2 || left->thin, closed = false;
    *may = false;
    if (apart < 2) return SL_OK;
    for (size_t i = 0; i < 2 * count && !body && left->near <= MOST_NEAR; i++)
        SL_TRY(find_body(left, panes[i / 2].jambs[i % 2], line, &body));
    for (size_t i = 0; i < count && !closed && left->near <= MOST_NEAR; i++)
        SL_TRY(find_wall_along(left, &panes[i], &closed));
    *may = body && !closed && left->near <= MOST_NEAR;
    return SL_OK;
}

/// Whether a ray from a point, of direction `u`, meets a wall.
static bool meets(const sli_left_out *left, sl_point from, sl_point u) {
    for (size_t i = 0; i < left->map->wall_count; i++) {
        const sl_wall *wall = &left->map->walls[i];
        if (!sl_bits_has(left->walls, i)) continue;
        const sl_point a = {wall->a.x - from.x, wall->a.y - from.y};
        const sl_point b = {wall->b.x - from.x, wall->b.y - from.y};
        const double s = sli_cross(u, a), t = sli_cross(u, b);
        if ((s < 0) == (t < 0)) continue;
        if ((sli_dot(u, a) * t - sli_dot(u, b) * s) / (t - s) > 0) return true;
    }
    return false;
}

/// Whether the view from a gap is free to one side, and ends at a wall on the other.
static bool is_outer(const sli_left_out *left, const sl_wall *line) {
    const sl_point at = middle(line), u = direction(line->a, line->b);
    const double lean = 0.35;
    bool free[2];
    for (int i = 0; i < 2; i++) {
        const double sign = i ? -1 : 1;
        const sl_point out = {-sign * u.y, sign * u.x};
        free[i] = !meets(left, at, out);
        for (int k = -1; free[i] && k <= 1; k += 2)
            free[i] = !meets(left, at, (sl_point){out.x + k * lean * u.x, out.y + k * lean * u.y});
    }
    return free[0] != free[1];
}

/// Whether a door is drawn in a gap.
static bool has_door(const sli_left_out *left, const sl_wall *line) {
    const sl_point at = middle(line);
    const double reach = 0.6 * sli_wall_length(line);
    for (size_t i = 0; i < left->door_count; i++) {
        const sl_point a = left->doors[i].a, b = left->doors[i].b;
        if (sli_length(a.x / 2 + b.x / 2 - at.x, a.y / 2 + b.y / 2 - at.y) <= reach) return true;
    }
    return false;
}

sl_status sli_left_out_glass(sli_left_out *left) {
    const size_t lines = left->map->wall_count;
    pane *panes = sl_alloc_array(left->context, lines, sizeof *panes);
    uint32_t *gaps = sl_alloc_array(left->context, lines, sizeof *gaps);
    size_t count = 0, views = 0;
    sl_status status = panes && gaps ? find_panes(left, panes, &count) : SL_NO_MEMORY;
    if (status == SL_OK) status = join_panes(left, panes, count, gaps);
    if (status == SL_OK && count) qsort(panes, count, sizeof *panes, compare_panes);
    for (size_t i = 0, end; status == SL_OK && i < count && left->near <= MOST_NEAR; i = end) {
        const sl_wall *line = &left->map->walls[panes[i].line];
        for (end = i + 1; end < count && panes[end].gap == panes[i].gap;) end++;
        bool may;
        status = may_be_glass(left, panes + i, end - i, &may);
        if (status != SL_OK || !may || has_door(left, line)) continue;
        views += lines;
        if (views > MOST_VIEWS) break;
        if (!is_outer(left, line)) continue;
        left->gaps++;
        for (size_t k = i; k < end; k++) sl_bits_add(left->glass, panes[k].line);
    }
    if (left->near > MOST_NEAR) {
        left->gaps = 0;
        memset(left->glass, 0, sl_bits_words(lines) * sizeof *left->glass);
    }
    for (size_t i = 0; status == SL_OK && i < lines; i++)
        if (sl_bits_has(left->glass, i)) sl_bits_add(left->walls, i);
    sl_free(left->context, panes);
    sl_free(left->context, gaps);
    return status;
}
