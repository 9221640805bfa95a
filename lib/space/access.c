/// How wide a disc gets to each triangle from outside, by a spanning tree (begin with entrances.c),
/// and groups of triangles by that.
#include "space/entrances.h"

#include "geometry/orient.h"
#include "space/kd_tree.h"

#include <stdlib.h>
#include <string.h>

// --- access

sl_status sli_access_number(sli_entrances *f) {
    const sli_half_edge *halves = sli_entrances_triangles(f)->halves.items;
    const size_t count = sli_entrances_triangles(f)->halves.count;
    f->triangle = sl_alloc_array(f->context, count, sizeof *f->triangle);
    f->half = sl_alloc_array(f->context, count / 3 + 1, sizeof *f->half);
    if (!f->triangle || !f->half) return SL_NO_MEMORY;
    memset(f->triangle, 0xff, count * sizeof *f->triangle);
    for (uint32_t i = 0; i < count; i++) {
        if (sli_half_is_outside(sli_entrances_triangles(f), i) || f->triangle[i] != SLI_NO_TRIANGLE)
            continue;
        f->half[f->count] = i;
        uint32_t half = i;
        for (int k = 0; k < 3; k++, half = halves[half].next) f->triangle[half] = f->count;
        f->count++;
    }
    const size_t all = (size_t)f->count + 1;
    f->access = sl_alloc_array(f->context, all, sizeof *f->access);
    f->closed = sl_alloc_array(f->context, all, sizeof *f->closed);
    f->parent = sl_alloc_array(f->context, all, sizeof *f->parent);
    f->following = sl_alloc_array(f->context, all, sizeof *f->following);
    f->group_of = sl_alloc_array(f->context, all, sizeof *f->group_of);
    f->order = sl_alloc_array(f->context, all, sizeof *f->order);
    const bool room =
        f->access && f->closed && f->parent && f->following && f->group_of && f->order;
    return room ? SL_OK : SL_NO_MEMORY;
}

/// Joins the sets of two triangles. The outside, which has the last number, stays a root. Sets are
/// also rings of `following`.
static void join(sli_entrances *f, uint32_t a, uint32_t b, double width) {
    uint32_t into = sl_root_of(f->parent, a), other = sl_root_of(f->parent, b);
    if (into == other) return;
    if (other == f->count) {
        other = into;
        into = f->count;
    }
    if (into == f->count) {
        uint32_t each = other;
        do f->access[each] = width;
        while ((each = f->following[each]) != other);
    }
    f->parent[other] = into;
    const uint32_t after = f->following[into];
    f->following[into] = f->following[other];
    f->following[other] = after;
}

/// Joins across one side; beyond the box is outside.
static void join_across(sli_entrances *f, uint32_t edge, double width) {
    const uint32_t a = f->triangle[2 * edge], b = f->triangle[2 * edge + 1];
    join(f, a == SLI_NO_TRIANGLE ? f->count : a, b == SLI_NO_TRIANGLE ? f->count : b, width);
}

/// An edge, by the width of its channel.
typedef struct width_of_edge {
    double width;
    uint32_t edge;
} width_of_edge;

static int compare_widths(const void *left, const void *right) {
    const width_of_edge *a = left, *b = right;
    if (a->width != b->width) return a->width > b->width ? -1 : 1;
    return (a->edge > b->edge) - (a->edge < b->edge);
}

sl_status sli_access_find(sli_entrances *f) {
    const size_t edges = sli_entrances_triangles(f)->halves.count / 2;
    width_of_edge *sorted = sl_alloc_array(f->context, edges, sizeof *sorted);
    size_t count = 0;
    if (!sorted) return SL_NO_MEMORY;
    for (uint32_t i = 0; i <= f->count; i++) {
        f->parent[i] = f->following[i] = i;
        f->access[i] = 0;
    }
    for (uint32_t i = 0; i < edges; i++) {
        const uint32_t label = f->channels.label[i];
        if (label == SLI_FREE)
            join_across(f, i, INFINITY);
        else if (label != SLI_WALL)
            sorted[count++] = (width_of_edge){f->channels.items.items[label].width, i};
    }
    if (count) qsort(sorted, count, sizeof *sorted, compare_widths);
    for (size_t i = 0; i < count; i++) join_across(f, sorted[i].edge, sorted[i].width);
    sl_free(f->context, sorted);
    return SL_OK;
}

// --- groups

static bool chosen(const sli_entrances *f, const sli_access_choice *c, uint32_t triangle) {
    return f->access[triangle] >= c->least && f->access[triangle] <= c->most;
}

static double area_of(const sli_entrances *f, uint32_t half) {
    const sli_half_edge *halves = sli_entrances_triangles(f)->halves.items;
    const sl_point a = sli_entrances_start(f, half), b = sli_entrances_start(f, half ^ 1);
    const sl_point c = sli_entrances_start(f, halves[halves[half].next].next);
    return sli_cross((sl_point){b.x - a.x, b.y - a.y}, (sl_point){c.x - a.x, c.y - a.y}) / 2;
}

/// Takes a triangle, and its neighbours that belong to the same group, into it.
static sl_status take_triangle(sli_entrances *f, const sli_access_choice *c, uint32_t triangle,
                               uint32_t number) {
    sli_access_group *g = &f->groups.items[number];
    uint32_t half = f->half[triangle];
    double clearance;
    sl_point place;
    g->access = fmax(g->access, f->access[triangle]);
    g->area += area_of(f, half);
    SL_TRY(sli_clearance_of(&f->clearance, half, g->clearance, &place, &clearance));
    if (clearance > g->clearance && sli_box_holds(&f->bounds, place)) {
        g->clearance = clearance;
        g->place = place;
    }
    for (int i = 0; i < 3; i++, half = sli_entrances_triangles(f)->halves.items[half].next) {
        const uint32_t other = f->triangle[half ^ 1];
        if (sli_entrances_label(f, half) == SLI_WALL) {
            g->reached += sli_entrances_length(f, half);
            continue;
        }
        if (other == SLI_NO_TRIANGLE || f->group_of[other] != SLI_NO_TRIANGLE ||
            !chosen(f, c, other) || (c->same && f->access[other] != f->access[triangle]))
            continue;
        f->group_of[other] = number;
        f->order[g->first + g->count++] = other;
    }
    return SL_OK;
}

sl_status sli_access_gather(sli_entrances *f, sli_access_choice c) {
    uint32_t end = 0;
    f->groups.count = 0;
    for (uint32_t i = 0; i < f->count; i++) f->group_of[i] = SLI_NO_TRIANGLE;
    for (uint32_t i = 0; i < f->count; i++) {
        if (f->group_of[i] != SLI_NO_TRIANGLE || !chosen(f, &c, i)) continue;
        const uint32_t number = (uint32_t)f->groups.count;
        SL_TRY(SL_ARRAY_ROOM(f->context, &f->groups, 1));
        f->groups.items[f->groups.count++] =
            (sli_access_group){.first = end, .count = 1, .access = 0, .clearance = -1};
        f->group_of[i] = number;
        f->order[end] = i;
        for (; end < f->groups.items[number].first + f->groups.items[number].count; end++)
            SL_TRY(take_triangle(f, &c, f->order[end], number));
        SL_TRY(sl_check_cancelled(f->context));
    }
    return SL_OK;
}

/// Whether a triangle has a place of some clearance. What was looked for in vain is not looked for
/// again; but for searches that were cut short.
static sl_status reaches(sli_entrances *f, uint32_t triangle, double wanted, sl_point *place,
                         bool *out) {
    double *closed = &f->closed[triangle];
    const size_t cut_short = f->clearance.cut_short;
    *out = false;
    if (*closed > 0 && wanted >= *closed) return SL_OK;
    SL_TRY(sli_clearance_reaches(&f->clearance, f->half[triangle], wanted, place, out));
    if (!*out && f->clearance.cut_short == cut_short) *closed = wanted;
    return SL_OK;
}

sl_status sli_access_fits(sli_entrances *f, sli_access_group *g, double width, bool *out) {
    *out = 2 * g->clearance >= width;
    for (uint32_t i = 0; i < g->count && !*out; i++) {
        SL_TRY(reaches(f, f->order[g->first + i], width / 2, &g->place, out));
        if (*out) g->clearance = width / 2;
    }
    return SL_OK;
}
