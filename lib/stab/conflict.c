/// Conflicts: the few portal ends that prove that no line stabs a sequence.
///
/// A line with all left ends at its left and all right ends at its right exists exactly if the
/// convex hulls of the two sets do not overlap. So a proof that there is none is a place where the
/// hulls meet: two edges that cross, or a corner of one hull in a triangle of the other (Radon's
/// theorem). That is four ends, or fewer where ends coincide. Cost: the product of the numbers of
/// hull corners.
#include "stab/funnel.h"

#include "geometry/orient.h"
#include "sightline/stab.h"

#include <stdlib.h>
#include <string.h>

/// An end, with the place that it has.
typedef struct end {
    sl_point at;
    sl_stab_end end;
} end;

/// A convex polygon, counter-clockwise, each corner once; two ends for a segment, one for a point.
typedef struct hull {
    end *ends;
    size_t count;
} hull;

static int compare_ends(const void *left, const void *right) {
    const end *a = left, *b = right;
    if (a->at.x != b->at.x) return a->at.x < b->at.x ? -1 : 1;
    if (a->at.y != b->at.y) return a->at.y < b->at.y ? -1 : 1;
    return (a->end.portal > b->end.portal) - (a->end.portal < b->end.portal);
}

/// Adds to a chain that turns left only.
static void add_to_chain(hull *h, size_t chain, end e) {
    while (h->count >= chain + 2 &&
           sli_orient(h->ends[h->count - 2].at, h->ends[h->count - 1].at, e.at) <= 0)
        h->count--;
    h->ends[h->count++] = e;
}

/// The hull of one side's ends (Andrew's monotone chain). `sorted` is scratch of `count` ends,
/// `out` has room for twice as many.
static void make_hull(const sl_portal_ends *portals, size_t count, bool left, end *sorted,
                      hull *out) {
    for (size_t i = 0; i < count; i++)
        sorted[i] = (end){left ? portals[i].left : portals[i].right, {(uint32_t)i, left}};
    qsort(sorted, count, sizeof *sorted, compare_ends);
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (!kept || !sli_same_point(sorted[kept - 1].at, sorted[i].at)) sorted[kept++] = sorted[i];
    out->count = 0;
    for (size_t i = 0; i < kept; i++) add_to_chain(out, 0, sorted[i]);
    const size_t upper = out->count - 1;
    for (size_t i = kept - 1; i-- > 0;) add_to_chain(out, upper, sorted[i]);
    if (out->count > 1) out->count--; // the first again
}

static bool within(double a, double b, double value) {
    return a < b ? a <= value && value <= b : b <= value && value <= a;
}

/// Whether segments cross in inner points of both.
static bool cross_properly(sl_point a, sl_point b, sl_point c, sl_point d) {
    return sli_orient(a, b, c) * sli_orient(a, b, d) < 0 &&
           sli_orient(c, d, a) * sli_orient(c, d, b) < 0;
}

static bool on_segment(sl_point a, sl_point b, sl_point p) {
    return sli_orient(a, b, p) == 0 && within(a.x, b.x, p.x) && within(a.y, b.y, p.y);
}

static bool touch(sl_point a, sl_point b, sl_point c, sl_point d) {
    return cross_properly(a, b, c, d) || on_segment(a, b, c) || on_segment(a, b, d) ||
           on_segment(c, d, a) || on_segment(c, d, b);
}

/// Whether a triangle, counter-clockwise, holds a point, in its inside or (not strict) on its edge.
static bool in_triangle(sl_point a, sl_point b, sl_point c, sl_point p, bool inside) {
    const int least = inside ? 1 : 0;
    return sli_orient(a, b, p) >= least && sli_orient(b, c, p) >= least &&
           sli_orient(c, a, p) >= least;
}

/// A set of ends that may be a conflict.
typedef struct suspects {
    const end *ends[4];
    size_t count;
} suspects;

/// Two edges that meet. `properly`: in inner points of both.
static bool find_edges(const hull *a, const hull *b, bool properly, suspects *out) {
    for (size_t i = 0; i < a->count; i++)
        for (size_t j = 0; j < b->count; j++) {
            const end *p = &a->ends[i], *q = &a->ends[(i + 1) % a->count];
            const end *r = &b->ends[j], *s = &b->ends[(j + 1) % b->count];
            const bool meet = properly ? cross_properly(p->at, q->at, r->at, s->at)
                                       : touch(p->at, q->at, r->at, s->at);
            if (!meet) continue;
            *out = (suspects){{p, q, r, s}, 4};
            return true;
        }
    return false;
}

/// A corner of `b` in a triangle of `a`. `inside`: not on its edge.
static bool find_corner(const hull *a, const hull *b, bool inside, suspects *out) {
    for (size_t i = 2; i < a->count; i++)
        for (size_t j = 0; j < b->count; j++) {
            const end *p = &a->ends[0], *q = &a->ends[i - 1], *r = &a->ends[i];
            if (!in_triangle(p->at, q->at, r->at, b->ends[j].at, inside)) continue;
            *out = (suspects){{p, q, r, &b->ends[j]}, 4};
            return true;
        }
    return false;
}

/// Whether some line keeps all ends but one at their sides or on it: if any does, one through two
/// of them does.
static bool has_weak_line(const end *ends, size_t count, size_t but) {
    bool any_pair = false;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++) {
            if (i == but || j == but || sli_same_point(ends[i].at, ends[j].at)) continue;
            any_pair = true;
            bool holds = true;
            for (size_t k = 0; k < count && holds; k++) {
                if (k == but) continue;
                const int side = sli_orient(ends[i].at, ends[j].at, ends[k].at);
                holds = ends[k].end.left ? side >= 0 : side <= 0;
            }
            if (holds) return true;
        }
    return !any_pair;
}

/// Strikes out what a conflict without weak lines can spare.
static size_t thin_out_weak(end *ends, size_t count) {
    for (size_t i = 0; i < count;) {
        if (has_weak_line(ends, count, i))
            i++;
        else
            memmove(&ends[i], &ends[i + 1], (--count - i) * sizeof *ends);
    }
    return count;
}

/// Strikes out what a place where hulls touch can spare: the corner of a triangle away from it, an
/// edge's end, where fewer ends meet already.
static size_t thin_out_strict(end *ends, size_t count) {
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++) {
            if (!ends[i].end.left || ends[j].end.left) continue;
            if (sli_same_point(ends[i].at, ends[j].at)) {
                const end pair[2] = {ends[i], ends[j]};
                memcpy(ends, pair, sizeof pair);
                return 2;
            }
        }
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++)
            for (size_t k = j + 1; k < count; k++) {
                if (i == j || i == k || ends[i].end.left == ends[j].end.left ||
                    ends[j].end.left != ends[k].end.left ||
                    !on_segment(ends[j].at, ends[k].at, ends[i].at))
                    continue;
                const end three[3] = {ends[i], ends[j], ends[k]};
                memcpy(ends, three, sizeof three);
                return 3;
            }
    return count;
}

static size_t find_among(const hull *left, const hull *right, bool strict, end *ends) {
    suspects s;
    if (find_edges(left, right, !strict, &s) || find_corner(left, right, !strict, &s) ||
        find_corner(right, left, !strict, &s)) {
        for (size_t i = 0; i < s.count; i++) ends[i] = *s.ends[i];
        return strict ? thin_out_strict(ends, s.count) : thin_out_weak(ends, s.count);
    }
    // The hulls overlap, but corners of one lie on the other's edges or diagonals.
    memcpy(ends, left->ends, left->count * sizeof *ends);
    memcpy(ends + left->count, right->ends, right->count * sizeof *ends);
    return thin_out_weak(ends, left->count + right->count);
}

sl_status sli_conflict_find(sl_context *context, const sl_portal_ends *portals, size_t count,
                            bool strict, sl_stab_end ends[SL_CONFLICT_MOST], uint32_t *found) {
    end *memory = sl_alloc_array(context, 7 * count, sizeof *memory);
    if (!memory) return SL_NO_MEMORY;
    hull left = {memory + count, 0}, right = {memory + 3 * count, 0};
    end *chosen = memory + 5 * count;
    make_hull(portals, count, true, memory, &left);
    make_hull(portals, count, false, memory, &right);
    const size_t number = find_among(&left, &right, strict, chosen);
    *found = 0;
    for (size_t i = 0; i < number && i < SL_CONFLICT_MOST; i++) ends[(*found)++] = chosen[i].end;
    sl_free(context, memory);
    return SL_OK;
}

// --- names

const char *sl_guarantee_name(sl_guarantee guarantee) {
    switch (guarantee) {
    case SL_EXACT:
        return "exact";
    case SL_CONSERVATIVE:
        return "conservative";
    case SL_AGGRESSIVE:
        return "aggressive";
    case SL_ROUNDED:
        return "rounded";
    }
    return "unknown";
}
