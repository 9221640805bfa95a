/// The areas add up to that of the bounds, and no two cells overlap: in rationals.
#include "oracle/tiling.h"

#include "oracle/blockers.h"
#include "oracle/shared.h"

#include <gmp.h>
#include <math.h>
#include <stdlib.h>

static int compare_points(const void *left, const void *right) {
    const sl_point *a = left, *b = right;
    return is_before(*b, *a) - is_before(*a, *b);
}

static const sl_point *corners_of(const sl_space *s, uint32_t cell) {
    return s->vertices + s->cells[cell].first_vertex;
}

static sl_segment side_of(const sl_space *s, uint32_t cell, uint32_t side) {
    const sl_point *corners = corners_of(s, cell);
    return (sl_segment){corners[side],
                        corners[side + 1 < s->cells[cell].vertex_count ? side + 1 : 0]};
}

// --- cells

/// Different corners, none of them at the right of a side.
static bool is_convex(const sl_space *s, uint32_t cell) {
    const uint32_t count = s->cells[cell].vertex_count;
    const sl_point *corners = corners_of(s, cell);
    for (uint32_t i = 0; i < count; i++) {
        const sl_segment side = side_of(s, cell, i);
        for (uint32_t k = 0; k < count; k++) {
            if (i != k && same(corners[i], corners[k])) return false;
            if (blockers_turn(side.a, side.b, corners[k]) < 0) return false;
        }
    }
    return count >= 3;
}

/// Adds the area of a cell, twice.
static void add_area(const sl_space *s, uint32_t cell, mpq_t sum) {
    mpq_t v[4];
    for (int i = 0; i < 4; i++) mpq_init(v[i]);
    for (uint32_t i = 0; i < s->cells[cell].vertex_count; i++) {
        const sl_segment side = side_of(s, cell, i);
        const double values[4] = {side.a.x, side.b.y, side.a.y, side.b.x};
        for (int k = 0; k < 4; k++) mpq_set_d(v[k], values[k]);
        mpq_mul(v[0], v[0], v[1]);
        mpq_mul(v[2], v[2], v[3]);
        mpq_add(sum, sum, v[0]);
        mpq_sub(sum, sum, v[2]);
    }
    for (int i = 0; i < 4; i++) mpq_clear(v[i]);
}

static bool has_area_of_bounds(const sl_space *s) {
    mpq_t sum, width, height, least;
    mpq_inits(sum, width, height, least, NULL);
    for (uint32_t i = 0; i < s->cell_count; i++) add_area(s, i, sum);
    mpq_set_d(width, s->bounds.max.x);
    mpq_set_d(least, s->bounds.min.x);
    mpq_sub(width, width, least);
    mpq_set_d(height, s->bounds.max.y);
    mpq_set_d(least, s->bounds.min.y);
    mpq_sub(height, height, least);
    mpq_mul(width, width, height);
    mpq_add(width, width, width);
    const bool equal = mpq_equal(sum, width);
    mpq_clears(sum, width, height, least, NULL);
    return equal;
}

static sl_box box_of(const sl_space *s, uint32_t cell) {
    const sl_point *corners = corners_of(s, cell);
    sl_box box = {corners[0], corners[0]};
    for (uint32_t i = 1; i < s->cells[cell].vertex_count; i++) {
        box.min.x = fmin(box.min.x, corners[i].x);
        box.min.y = fmin(box.min.y, corners[i].y);
        box.max.x = fmax(box.max.x, corners[i].x);
        box.max.y = fmax(box.max.y, corners[i].y);
    }
    return box;
}

/// Whether a side of the first cell has all of the other at its right.
static bool parts(const sl_space *s, uint32_t cell, uint32_t other) {
    const sl_point *corners = corners_of(s, other);
    for (uint32_t i = 0; i < s->cells[cell].vertex_count; i++) {
        const sl_segment side = side_of(s, cell, i);
        uint32_t k = 0;
        while (k < s->cells[other].vertex_count && blockers_turn(side.a, side.b, corners[k]) <= 0)
            k++;
        if (k == s->cells[other].vertex_count) return true;
    }
    return false;
}

typedef struct boxed {
    sl_box box;
    uint32_t cell;
} boxed;

static int compare_boxed(const void *left, const void *right) {
    const boxed *a = left, *b = right;
    return (a->box.min.x > b->box.min.x) - (a->box.min.x < b->box.min.x);
}

/// Of two convex polygons without a common inside, a side of one parts them.
static bool overlap_nowhere(const sl_space *s, char *why) {
    boxed *sorted = must(calloc(s->cell_count, sizeof *sorted));
    bool apart = true;
    for (uint32_t i = 0; i < s->cell_count; i++) sorted[i] = (boxed){box_of(s, i), i};
    qsort(sorted, s->cell_count, sizeof *sorted, compare_boxed);
    for (uint32_t i = 0; i < s->cell_count && apart; i++)
        for (uint32_t k = i + 1; k < s->cell_count && apart; k++) {
            const boxed *a = &sorted[i], *b = &sorted[k];
            if (b->box.min.x >= a->box.max.x) break;
            if (a->box.max.y <= b->box.min.y || b->box.max.y <= a->box.min.y ||
                parts(s, a->cell, b->cell) || parts(s, b->cell, a->cell))
                continue;
            apart = fault(why, "cells %u and %u overlap", a->cell, b->cell);
        }
    free(sorted);
    return apart;
}

static bool is_within(const sl_box *b, sl_point p) {
    return p.x >= b->min.x && p.x <= b->max.x && p.y >= b->min.y && p.y <= b->max.y;
}

/// Every corner is an end or a corner of the bounds.
static bool have_known_corners(const sl_space *s, char *why) {
    const sl_box *b = &s->bounds;
    size_t count = 0;
    sl_point *ends = must(calloc(2 * ((size_t)s->wall_count + s->seam_count) + 4, sizeof *ends));
    for (uint32_t i = 0; i < s->wall_count; i++) {
        ends[count++] = s->walls[i].a;
        ends[count++] = s->walls[i].b;
    }
    for (uint32_t i = 0; i < s->seam_count; i++) {
        ends[count++] = s->seams[i].at.a;
        ends[count++] = s->seams[i].at.b;
    }
    ends[count++] = b->min;
    ends[count++] = b->max;
    ends[count++] = (sl_point){b->min.x, b->max.y};
    ends[count++] = (sl_point){b->max.x, b->min.y};
    qsort(ends, count, sizeof *ends, compare_points);
    bool known = true;
    for (uint32_t i = 0; i < s->vertex_count && known; i++)
        known = (is_within(b, s->vertices[i]) &&
                 bsearch(&s->vertices[i], ends, count, sizeof *ends, compare_points)) ||
                fault(why, "corner %a %a ends no wall", s->vertices[i].x, s->vertices[i].y);
    free(ends);
    return known;
}

// --- sides

/// Whether a cell has a directed portal as a side.
static bool has_side(const sl_space *s, uint32_t cell, const sl_directed_portal *directed) {
    for (uint32_t i = 0; i < s->cells[cell].vertex_count; i++) {
        const sl_segment side = side_of(s, cell, i);
        if (same(side.a, directed->right) && same(side.b, directed->left) &&
            s->neighbour[s->cells[cell].first_vertex + i] == SL_NEIGHBOUR_PORTAL)
            return true;
    }
    return false;
}

static bool check_portal(const sl_space *s, uint32_t number, char *why) {
    const sl_portal *p = &s->portals[number];
    for (int k = 0; k < 2; k++) {
        const uint32_t cell = p->cell[k];
        const sl_directed_portal wanted = {number, p->cell[!k], k ? p->right : p->left,
                                           k ? p->left : p->right};
        uint32_t found = 0;
        for (uint32_t i = 0; i < s->cells[cell].directed_count; i++) {
            const sl_directed_portal *directed = &s->directed[s->cells[cell].first_directed + i];
            found += directed->portal == number && directed->cell == wanted.cell &&
                     same(directed->left, wanted.left) && same(directed->right, wanted.right);
        }
        if (found != 1 || !has_side(s, cell, &wanted))
            return fault(why, "portal %u is not on cell %u", number, cell);
    }
    for (uint32_t i = 0; i < s->wall_count; i++) {
        const sl_wall *w = &s->walls[i];
        if ((same(w->a, p->left) && same(w->b, p->right)) ||
            (same(w->b, p->left) && same(w->a, p->right)))
            return fault(why, "portal %u runs along wall %u", number, i);
    }
    return true;
}

static bool on_border(const sl_box *b, sl_point p, sl_point q) {
    return (p.x == q.x && (p.x == b->min.x || p.x == b->max.x)) ||
           (p.y == q.y && (p.y == b->min.y || p.y == b->max.y));
}

/// Whether what is beyond a side fits its place; counts the sides of walls, left and right.
static bool check_side(const sl_space *s, uint32_t cell, uint32_t number, uint32_t *passed,
                       uint32_t *sides, char *why) {
    const uint32_t what = s->neighbour[s->cells[cell].first_vertex + number];
    const sl_segment side = side_of(s, cell, number);
    if (what == SL_NEIGHBOUR_PORTAL) {
        const sl_directed_portal *directed =
            &s->directed[s->cells[cell].first_directed + (*passed)++];
        return (*passed <= s->cells[cell].directed_count && same(directed->right, side.a) &&
                same(directed->left, side.b)) ||
               fault(why, "side %u of cell %u is not its portal", number, cell);
    }
    if (what == SL_NEIGHBOUR_BORDER)
        return on_border(&s->bounds, side.a, side.b) ||
               fault(why, "side %u of cell %u is no border", number, cell);
    const bool right = what & SL_NEIGHBOUR_RIGHT;
    const uint32_t wall = what & ~SL_NEIGHBOUR_RIGHT;
    if (wall >= s->wall_count) return fault(why, "cell %u knows no such wall", cell);
    sides[2 * wall + right]++;
    return (same(side.a, right ? s->walls[wall].b : s->walls[wall].a) &&
            same(side.b, right ? s->walls[wall].a : s->walls[wall].b)) ||
           fault(why, "side %u of cell %u is not wall %u", number, cell, wall);
}

static bool check_sides(const sl_space *s, char *why) {
    uint32_t *sides = must(calloc(2 * (size_t)s->wall_count + 1, sizeof *sides));
    bool sound = true;
    for (uint32_t i = 0; i < s->cell_count && sound; i++) {
        uint32_t directed = 0;
        for (uint32_t k = 0; k < s->cells[i].vertex_count && sound; k++)
            sound = check_side(s, i, k, &directed, sides, why);
        if (sound && directed != s->cells[i].directed_count)
            sound = fault(why, "cell %u has too many portals", i);
    }
    for (uint32_t i = 0; i < s->wall_count && sound; i++) {
        const uint32_t left = sides[2 * i], right = sides[2 * i + 1];
        const bool border = on_border(&s->bounds, s->walls[i].a, s->walls[i].b);
        if (border ? left + right != 1 : left != 1 || right != 1)
            sound = fault(why, "wall %u is a side of %u and %u cells", i, left, right);
    }
    free(sides);
    for (uint32_t i = 0; i < s->portal_count && sound; i++) sound = check_portal(s, i, why);
    return sound;
}

bool oracle_is_tiling(const sl_space *space, char why[ORACLE_WHY]) {
    for (uint32_t i = 0; i < space->cell_count; i++)
        if (!is_convex(space, i)) return fault(why, "cell %u is not convex", i);
    if (!has_area_of_bounds(space)) return fault(why, "the cells have not the area of the bounds");
    return overlap_nowhere(space, why) && have_known_corners(space, why) && check_sides(space, why);
}

uint32_t oracle_locate(const sl_space *space, sl_point point) {
    uint32_t open = SL_NO_CELL, solid = SL_NO_CELL;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        uint32_t k = 0;
        for (; k < space->cells[i].vertex_count; k++) {
            const sl_segment side = side_of(space, i, k);
            if (blockers_turn(side.a, side.b, point) < 0) break;
        }
        if (k < space->cells[i].vertex_count) continue;
        if (space->cells[i].inside) return i;
        if (!space->cells[i].solid && open == SL_NO_CELL) open = i;
        if (solid == SL_NO_CELL) solid = i;
    }
    return open != SL_NO_CELL ? open : solid;
}
