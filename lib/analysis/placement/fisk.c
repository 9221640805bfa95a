/// Fisk's proof of the art gallery theorem, as an algorithm (art_gallery.h).
///
///     c-------b        An ear is a corner b, with neighbours a and c, whose triangle a b c lies in
///      \     /|        the polygon and holds no other corner. Each polygon with more than three
///       \   / |        corners has two (Meisters 1975). Take one off, and go on with the rest:
///     ---\ /  |        that gives a triangulation.
///         a---+
///
/// Colour the last triangle, and put the ears back in reverse order. The tip of an ear touches two
/// corners that have a colour already, so one colour is left for it. Each triangle then has a
/// corner of each colour, and the corners of one colour see all triangles. The smallest of the
/// three classes has at most n/3 corners.
///
/// A corner in the closed triangle, a b c, makes b no ear. So no corner lies on a cut, what is left
/// is simple, and corners on straight lines do no harm: one of them is never a tip while it is
/// flat. Only corners that are not convex can be in a triangle first, so only those are asked.
#include "sightline/art_gallery.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>

typedef struct cutter {
    const sl_point *points;
    uint32_t *before, *after; ///< by corner: its neighbours, counter-clockwise, in what is left
    uint32_t *bent;           ///< corners that were not convex at first
    uint32_t bent_count, count;
} cutter;

// --- the polygon

static bool spans_meet(double a, double b, double c, double d) {
    return sli_greater(a, b) >= sli_lesser(c, d) && sli_greater(c, d) >= sli_lesser(a, b);
}

/// Whether two closed segments have a point in common.
static bool sides_meet(sl_point a, sl_point b, sl_point c, sl_point d) {
    return spans_meet(a.x, b.x, c.x, d.x) && spans_meet(a.y, b.y, c.y, d.y) &&
           sl_orient(a, b, c) * sl_orient(a, b, d) <= 0 &&
           sl_orient(c, d, a) * sl_orient(c, d, b) <= 0;
}

/// Whether two sides that follow each other have more than their corner in common.
static bool folds_back(sl_point a, sl_point b, sl_point c) {
    if (sli_same_point(a, b) || sli_same_point(b, c)) return true;
    if (sl_orient(a, b, c) != 0) return false;
    return (a.x < b.x) == (c.x < b.x) && (a.x > b.x) == (c.x > b.x) && (a.y < b.y) == (c.y < b.y) &&
           (a.y > b.y) == (c.y > b.y);
}

static sl_status check_sides(sl_context *context, const sl_point *p, uint32_t n) {
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t next = (i + 1) % n;
        bool meets = folds_back(p[i], p[next], p[(i + 2) % n]);
        uint32_t other = next;
        for (uint32_t j = i + 2; j < n && !meets; j++) {
            if ((j + 1) % n == i) continue;
            meets = sides_meet(p[i], p[next], p[j], p[(j + 1) % n]);
            other = j;
        }
        if (meets)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "the polygon meets itself: its sides from corner %u and corner %u do",
                           i + 1, other + 1);
        SL_TRY(sl_check_cancelled(context));
    }
    return SL_OK;
}

static sl_status check(sl_context *context, const sl_shape *polygon) {
    if (polygon->count > 1)
        return sl_fail(context, SL_UNSUPPORTED,
                       "Fisk's proof needs a polygon without holes: this one has %zu border lines",
                       polygon->count);
    const size_t n = polygon->count ? polygon->ends[0] : 0;
    if (n < 3 || n > UINT32_MAX / 4)
        return sl_fail(context, SL_BAD_ARGUMENT, "a polygon has three corners or more, not %zu", n);
    for (size_t i = 0; i < n; i++)
        if (!isfinite(polygon->points[i].x) || !isfinite(polygon->points[i].y))
            return sl_fail(context, SL_BAD_ARGUMENT, "corner %zu must be finite", i + 1);
    return check_sides(context, polygon->points, (uint32_t)n);
}

/// Whether the border runs counter-clockwise: it turns left at its lowest corner, the first from
/// the left.
static bool runs_left(const sl_point *p, uint32_t n) {
    uint32_t low = 0;
    for (uint32_t i = 1; i < n; i++)
        if (p[i].y < p[low].y || (p[i].y == p[low].y && p[i].x < p[low].x)) low = i;
    return sl_orient(p[(low + n - 1) % n], p[low], p[(low + 1) % n]) > 0;
}

// --- ears

static int turn(const cutter *c, uint32_t corner) {
    return sl_orient(c->points[c->before[corner]], c->points[corner], c->points[c->after[corner]]);
}

static bool is_ear(const cutter *c, uint32_t tip) {
    const uint32_t a = c->before[tip], b = c->after[tip];
    const sl_point p = c->points[a], q = c->points[tip], r = c->points[b];
    if (turn(c, tip) <= 0) return false;
    for (uint32_t i = 0; i < c->bent_count; i++) {
        const uint32_t other = c->bent[i];
        const sl_point at = c->points[other];
        if (other == a || other == b || other == tip) continue;
        if (sl_orient(p, q, at) >= 0 && sl_orient(q, r, at) >= 0 && sl_orient(r, p, at) >= 0)
            return false;
    }
    return true;
}

/// Forgets a corner that has become convex, or is cut away: it is in no triangle first.
static void forget_bent(cutter *c, uint32_t corner, bool cut) {
    if (!cut && turn(c, corner) <= 0) return;
    for (uint32_t i = 0; i < c->bent_count; i++)
        if (c->bent[i] == corner) c->bent[i--] = c->bent[--c->bent_count];
}

static sl_status cut_ears(sl_context *context, cutter *c, sl_fisk *out) {
    uint32_t tip = 0, tried = 0;
    for (uint32_t left = c->count; left > 3;) {
        if (!is_ear(c, tip)) {
            if (++tried > left) return sl_fail(context, SL_BAD_ARGUMENT, "the polygon has no ear");
            tip = c->after[tip];
            continue;
        }
        SL_TRY(sl_check_cancelled(context));
        const uint32_t a = c->before[tip], b = c->after[tip];
        out->ears[out->ear_count++] = (sl_ear){a, tip, b};
        c->after[a] = b;
        c->before[b] = a;
        forget_bent(c, tip, true);
        forget_bent(c, a, false);
        forget_bent(c, b, false);
        tip = c->after[b]; // not the neighbour: fewer triangles share a corner
        tried = 0;
        left--;
    }
    while (turn(c, tip) <= 0) tip = c->after[tip];
    out->ears[out->ear_count++] = (sl_ear){c->before[tip], tip, c->after[tip]};
    return SL_OK;
}

static sl_status triangulate(sl_context *context, const sl_point *points, sl_fisk *out) {
    const uint32_t n = out->corner_count;
    cutter c = {.points = points, .count = n};
    uint32_t *links = sl_alloc_array(context, 3 * (size_t)n, sizeof *links);
    if (!links) return SL_NO_MEMORY;
    c.before = links;
    c.after = links + n;
    c.bent = links + 2 * (size_t)n;
    const bool left = runs_left(points, n);
    for (uint32_t i = 0; i < n; i++) {
        (left ? c.after : c.before)[i] = (i + 1) % n;
        (left ? c.before : c.after)[i] = (i + n - 1) % n;
    }
    for (uint32_t i = 0; i < n; i++)
        if (turn(&c, i) <= 0) c.bent[c.bent_count++] = i;
    const sl_status status = cut_ears(context, &c, out);
    sl_free(context, links);
    return status;
}

// --- colours

static void colour(sl_fisk *out) {
    const sl_ear *last = &out->ears[out->ear_count - 1];
    out->colours[last->before] = 0;
    out->colours[last->tip] = 1;
    out->colours[last->after] = 2;
    for (uint32_t i = out->ear_count - 1; i-- > 0;) {
        const sl_ear *ear = &out->ears[i];
        out->colours[ear->tip] =
            (uint8_t)(3 - out->colours[ear->before] - out->colours[ear->after]);
    }
    for (uint32_t i = 0; i < out->corner_count; i++) out->sizes[out->colours[i]]++;
    for (uint8_t k = 1; k < 3; k++)
        if (out->sizes[k] < out->sizes[out->least]) out->least = k;
    for (uint32_t i = 0; i < out->corner_count; i++)
        if (out->colours[i] == out->least) out->guards[out->guard_count++] = i;
}

sl_status sl_fisk_colour(sl_context *context, const sl_shape *polygon, sl_fisk *out) {
    SL_TRY(check(context, polygon));
    sl_fisk made = {.corner_count = (uint32_t)polygon->ends[0]};
    made.ears = sl_alloc_array(context, made.corner_count, sizeof *made.ears);
    made.colours = sl_alloc_array(context, made.corner_count, sizeof *made.colours);
    made.guards = sl_alloc_array(context, made.corner_count, sizeof *made.guards);
    sl_status status = made.ears && made.colours && made.guards ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = triangulate(context, polygon->points, &made);
    if (status == SL_OK) colour(&made);
    if (status == SL_OK)
        *out = made;
    else
        sl_fisk_destroy(context, &made);
    return status;
}

void sl_fisk_destroy(sl_context *context, sl_fisk *fisk) {
    sl_free(context, fisk->ears);
    sl_free(context, fisk->colours);
    sl_free(context, fisk->guards);
    *fisk = (sl_fisk){0};
}
