/// Each line through two corners is walked, by integers and fractions of them.
#include "oracle/two_boxes.h"

#include "oracle/must.h"

#include <stdint.h>
#include <stdlib.h>

__extension__ typedef __int128 wide;

/// The point (x / w, y / w), w > 0.
typedef struct corner {
    int64_t x, y, w;
} corner;

/// A place along a line: num / den of any unit, den > 0.
typedef struct place {
    wide num, den;
} place;

/// The points a x + b y + c = 0; left of it the sum is above 0.
typedef struct line {
    int64_t a, b, c;
} line;

/// What of a line lies in a box: from `first` to `last`.
typedef struct part {
    bool any;
    place first, last;
} part;

/// What the line meets: at one place, or along it, from `at` to `end`.
typedef struct event {
    place at, end;
    bool along, left, right; ///< a wall along it; walls lead off to that side
} event;

typedef struct walk {
    const sl_segment *walls;
    size_t count;
    line at;
    event *events;
    size_t event_count;
    place *places;
    size_t place_count;
    part from, to;
    bool has_left, has_right; ///< the map lies on that side, too
} walk;

static int sign(wide value) {
    return (value > 0) - (value < 0);
}

static corner corner_of(sl_point p) {
    return (corner){(int64_t)p.x, (int64_t)p.y, 1};
}

static int compare(place a, place b) {
    return sign(a.num * b.den - b.num * a.den);
}

static int side(line l, corner p) {
    return sign((wide)l.a * p.x + (wide)l.b * p.y + (wide)l.c * p.w);
}

/// Along the line's direction, which is (b, -a).
static place along(line l, corner p) {
    return (place){(wide)l.b * p.x - (wide)l.a * p.y, p.w};
}

/// From p to q: left of it the sum is above 0.
static line through(corner p, corner q) {
    return (line){p.y * q.w - p.w * q.y, p.w * q.x - p.x * q.w, p.x * q.y - p.y * q.x};
}

/// Where two lines meet that are not parallel.
static corner meet(line k, line l) {
    corner p = {k.b * l.c - k.c * l.b, k.c * l.a - k.a * l.c, k.a * l.b - k.b * l.a};
    int64_t common = p.w, rest = p.x;
    // Numbers stay small: a corner where a wall crosses a side has the wall's length below.
    for (int i = 0; i < 2; i++) {
        while (rest) {
            const int64_t next = common % rest;
            common = rest;
            rest = next;
        }
        rest = p.y;
    }
    if ((common < 0) != (p.w < 0)) common = -common;
    return (corner){p.x / common, p.y / common, p.w / common};
}

static void box_corners(sl_box box, corner c[5]) {
    c[0] = corner_of(box.min);
    c[1] = corner_of((sl_point){box.max.x, box.min.y});
    c[2] = corner_of(box.max);
    c[3] = corner_of((sl_point){box.min.x, box.max.y});
    c[4] = c[0];
}

static void extend(part *p, place at) {
    if (!p->any || compare(at, p->first) < 0) p->first = at;
    if (!p->any || compare(at, p->last) > 0) p->last = at;
    p->any = true;
}

static part part_in(line l, sl_box box) {
    corner c[5];
    part p = {false, {0, 1}, {0, 1}};
    box_corners(box, c);
    for (int k = 0; k < 4; k++) {
        const int a = side(l, c[k]), b = side(l, c[k + 1]);
        if (!a) extend(&p, along(l, c[k]));
        if (a * b < 0) extend(&p, along(l, meet(through(c[k], c[k + 1]), l)));
    }
    return p;
}

static bool holds(const part *p, place at) {
    return p->any && compare(p->first, at) <= 0 && compare(at, p->last) <= 0;
}

static int by_place(const void *a, const void *b) {
    return compare(*(const place *)a, *(const place *)b);
}

static void gather(walk *w) {
    w->event_count = w->place_count = 0;
    for (size_t i = 0; i < w->count; i++) {
        const corner a = corner_of(w->walls[i].a), b = corner_of(w->walls[i].b);
        const int of_a = side(w->at, a), of_b = side(w->at, b);
        event e = {
            .along = !of_a && !of_b, .left = of_a > 0 || of_b > 0, .right = of_a < 0 || of_b < 0};
        if (of_a * of_b > 0) continue;
        e.at = along(w->at, of_a ? of_b ? meet(through(a, b), w->at) : b : a);
        e.end = along(w->at, of_b ? of_a ? meet(through(a, b), w->at) : a : b);
        if (compare(e.end, e.at) < 0) {
            const place end = e.end;
            e.end = e.at;
            e.at = end;
        }
        w->events[w->event_count++] = e;
        w->places[w->place_count++] = e.at;
        w->places[w->place_count++] = e.end;
    }
    const part *parts[2] = {&w->from, &w->to};
    for (int i = 0; i < 2; i++) {
        w->places[w->place_count++] = parts[i]->first;
        w->places[w->place_count++] = parts[i]->last;
    }
    qsort(w->places, w->place_count, sizeof *w->places, by_place);
}

/// Whether a wall leads off at a place to the left or right.
static bool parts_at(const walk *w, place at, bool left) {
    for (size_t i = 0; i < w->event_count; i++)
        if (!compare(w->events[i].at, at) && !w->events[i].along &&
            (left ? w->events[i].left : w->events[i].right))
            return true;
    return false;
}

static bool covered(const walk *w, place from, place to) {
    for (size_t i = 0; i < w->event_count; i++)
        if (w->events[i].along && compare(w->events[i].at, from) <= 0 &&
            compare(to, w->events[i].end) <= 0)
            return true;
    return false;
}

/// Whether the line sees, in its direction.
static bool sees_along(walk *w) {
    bool left = false, right = false;
    gather(w);
    for (size_t i = 0; i < w->place_count; i++) {
        const place at = w->places[i];
        const bool starts = holds(&w->from, at);
        if (i && !compare(w->places[i - 1], at)) continue;
        if ((starts || left || right) && holds(&w->to, at)) return true;
        left = w->has_left && (starts || (left && !parts_at(w, at, true)));
        right = w->has_right && (starts || (right && !parts_at(w, at, false)));
        for (size_t k = i + 1; k < w->place_count; k++)
            if (compare(w->places[k], at)) {
                const bool free = !covered(w, at, w->places[k]) && (left || right);
                // All between two places is in the box, or nothing is.
                const bool looks = starts && holds(&w->from, w->places[k]);
                left = w->has_left && (left || free || looks);
                right = w->has_right && (right || free || looks);
                break;
            }
    }
    return false;
}

static size_t corners_of(const sl_segment *walls, size_t count, const sl_box boxes[2],
                         corner *corners) {
    size_t found = 0;
    for (int i = 0; i < 2; i++) {
        corner c[5];
        box_corners(boxes[i], c);
        for (int k = 0; k < 4; k++) {
            corners[found++] = c[k];
            for (size_t m = 0; m < count; m++) {
                const corner a = corner_of(walls[m].a), b = corner_of(walls[m].b);
                const line wall = through(a, b), edge = through(c[k], c[k + 1]);
                if (side(edge, a) * side(edge, b) < 0 &&
                    side(wall, c[k]) * side(wall, c[k + 1]) < 0)
                    corners[found++] = meet(wall, edge);
            }
        }
    }
    for (size_t m = 0; m < 2 * count; m++)
        corners[found++] = corner_of(m % 2 ? walls[m / 2].b : walls[m / 2].a);
    return found;
}

static bool same(corner p, corner q) {
    return (wide)p.x * q.w == (wide)q.x * p.w && (wide)p.y * q.w == (wide)q.y * p.w;
}

static void find_map(walk *w, sl_box map) {
    corner c[5];
    box_corners(map, c);
    w->has_left = w->has_right = false;
    for (int k = 0; k < 4; k++) {
        w->has_left |= side(w->at, c[k]) > 0;
        w->has_right |= side(w->at, c[k]) < 0;
    }
}

bool two_boxes_see(const sl_segment *walls, size_t count, sl_box map, sl_box from, sl_box to) {
    const sl_box boxes[2] = {from, to};
    corner *corners = must(malloc((8 + 10 * count) * sizeof *corners));
    walk w = {.walls = walls, .count = count};
    const size_t found = corners_of(walls, count, boxes, corners);
    bool seen = from.min.x <= to.max.x && to.min.x <= from.max.x && from.min.y <= to.max.y &&
                to.min.y <= from.max.y;
    w.events = must(malloc((count + 1) * sizeof *w.events));
    w.places = must(malloc((2 * count + 4) * sizeof *w.places));
    for (size_t i = 0; i < found && !seen; i++)
        for (size_t k = 0; k < found && !seen; k++) {
            if (same(corners[i], corners[k])) continue;
            w.at = through(corners[i], corners[k]);
            find_map(&w, map);
            w.from = part_in(w.at, from);
            w.to = part_in(w.at, to);
            seen = w.from.any && w.to.any && sees_along(&w);
        }
    free(corners);
    free(w.events);
    free(w.places);
    return seen;
}
