/// The area that was explored. New shapes wait as loops of one list. They are laid over the area,
/// and the outline of the union becomes the area (overlay.c), when they have as many corners as it
/// has, or when somebody asks. So each corner is united a logarithmic number of times.
///
/// The loops that wait are one shape: what loops go around several times counts once.
#include "sightline/explored.h"

#include "geometry/orient.h"
#include "sightline/map.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

enum { LEAST_WAITING = 256, LOOPS_MOST = INT32_MAX };

/// Loops that grow.
typedef struct loops {
    SL_ARRAY(sl_point) points;
    SL_ARRAY(size_t) ends;
} loops;

struct sl_explored {
    double resolution;
    sl_shape area; ///< an overlay's, or empty
    loops waiting;
};

sl_status sl_explored_create(sl_context *context, double resolution, sl_explored **out) {
    if (!(resolution >= 0) || isinf(resolution))
        return sl_fail(context, SL_BAD_ARGUMENT, "the resolution must be 0 or more, and finite");
    sl_explored *e = sl_alloc_array(context, 1, sizeof *e);
    if (!e) return SL_NO_MEMORY;
    e->resolution = resolution;
    *out = e;
    return SL_OK;
}

void sl_explored_destroy(sl_context *context, sl_explored *e) {
    if (!e) return;
    sl_shape_destroy(context, &e->area);
    sl_free(context, e->waiting.points.items);
    sl_free(context, e->waiting.ends.items);
    sl_free(context, e);
}

static sl_shape shape_of(const loops *l) {
    return (sl_shape){l->points.items, l->ends.items, l->ends.count};
}

static size_t corners_of(const sl_shape *shape) {
    return shape->count ? shape->ends[shape->count - 1] : 0;
}

static double rounded(double value, double resolution) {
    return resolution > 0 ? nearbyint(value / resolution) * resolution : value;
}

/// Ends the loop of the points behind the last one; without area there is none.
static sl_status end_loop(sl_context *context, loops *l) {
    const size_t first = l->ends.count ? l->ends.items[l->ends.count - 1] : 0;
    if (l->points.count < first + 3) {
        l->points.count = first;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &l->ends, 1));
    l->ends.items[l->ends.count++] = l->points.count;
    return SL_OK;
}

static sl_status add_point(sl_context *context, loops *l, sl_point at, double resolution) {
    const size_t first = l->ends.count ? l->ends.items[l->ends.count - 1] : 0;
    at = (sl_point){rounded(at.x, resolution), rounded(at.y, resolution)};
    if (l->points.count > first && sli_same_point(l->points.items[l->points.count - 1], at))
        return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &l->points, 1));
    l->points.items[l->points.count++] = at;
    return SL_OK;
}

static sl_status add_loops(sl_context *context, loops *l, const sl_shape *shape,
                           double resolution) {
    for (size_t i = 0, at = 0; i < shape->count; i++) {
        for (; at < shape->ends[i]; at++)
            SL_TRY(add_point(context, l, shape->points[at], resolution));
        SL_TRY(end_loop(context, l));
    }
    return SL_OK;
}

// --- the union

static sl_status unite_shapes(sl_context *context, const sl_shape *shapes, size_t count,
                              sl_shape *out) {
    sl_overlay overlay = {0};
    SL_TRY(sl_overlay_make(context, NULL, shapes, count, &overlay));
    const sl_status status = sl_overlay_outline(context, &overlay, 1, out);
    sl_overlay_destroy(context, &overlay);
    return status;
}

static bool is_rounded(const sl_shape *shape, double resolution) {
    for (size_t i = 0; i < corners_of(shape); i++) {
        const sl_point p = shape->points[i];
        if (p.x != rounded(p.x, resolution) || p.y != rounded(p.y, resolution)) return false;
    }
    return true;
}

/// Rounds the corners that crossings made. Rounding may make others cross; these are rounded in
/// turn, and most often there are none.
static sl_status round_corners(sl_context *context, double resolution, sl_shape *area) {
    enum { ROUNDS = 8 };
    for (int round = 0; round < ROUNDS && !is_rounded(area, resolution); round++) {
        loops l = {0};
        sl_shape united = {0};
        sl_status status = add_loops(context, &l, area, resolution);
        const sl_shape shape = shape_of(&l);
        if (status == SL_OK) status = unite_shapes(context, &shape, 1, &united);
        sl_free(context, l.points.items);
        sl_free(context, l.ends.items);
        SL_TRY(status);
        sl_shape_destroy(context, area);
        *area = united;
    }
    return SL_OK;
}

/// On failure the area stays, and what waits goes on waiting.
static sl_status unite(sl_context *context, sl_explored *e) {
    if (!e->waiting.ends.count) return SL_OK;
    const sl_shape both[2] = {e->area, shape_of(&e->waiting)};
    sl_shape united = {0};
    SL_TRY(unite_shapes(context, both, 2, &united));
    const sl_status status = round_corners(context, e->resolution, &united);
    if (status != SL_OK) {
        sl_shape_destroy(context, &united);
        return status;
    }
    sl_shape_destroy(context, &e->area);
    e->area = united;
    e->waiting.points.count = e->waiting.ends.count = 0;
    return SL_OK;
}

// --- adding

static sl_status check_points(sl_context *context, const sl_shape *shape) {
    for (size_t i = 0; i < corners_of(shape); i++)
        if (!sl_coordinate_usable(shape->points[i].x) || !sl_coordinate_usable(shape->points[i].y))
            return sl_fail(context, SL_BAD_ARGUMENT, "corner %zu of the shape is no place of a map",
                           i);
    return SL_OK;
}

sl_status sl_explored_add(sl_context *context, sl_explored *e, const sl_shape *shape) {
    const size_t points = e->waiting.points.count, ends = e->waiting.ends.count;
    SL_TRY(check_points(context, shape));
    sl_status status = add_loops(context, &e->waiting, shape, e->resolution);
    const size_t enough = LEAST_WAITING + corners_of(&e->area);
    if (status == SL_OK && e->waiting.points.count >= enough) status = unite(context, e);
    if (status != SL_OK) {
        e->waiting.points.count = points;
        e->waiting.ends.count = ends;
    }
    return status;
}

sl_status sl_explored_add_region(sl_context *context, sl_explored *e, const sl_region *region) {
    const double fine = region->range / 1000;
    const double tolerance = e->resolution > 0 && e->resolution < fine ? e->resolution : fine;
    const size_t count = sl_region_flatten(region, tolerance, NULL, 0);
    if (!count) return SL_OK;
    sl_point *points = sl_alloc_array(context, count, sizeof *points);
    if (!points) return SL_NO_MEMORY;
    sl_region_flatten(region, tolerance, points, count);
    const sl_shape shape = {points, &count, 1};
    const sl_status status = sl_explored_add(context, e, &shape);
    sl_free(context, points);
    return status;
}

// --- asking

sl_status sl_explored_area(sl_context *context, sl_explored *e, sl_shape *out) {
    SL_TRY(unite(context, e));
    *out = e->area;
    return SL_OK;
}

/// How a side counts for a ray to the right; *on is set where the point is on it.
static int crosses(sl_point a, sl_point b, sl_point p, bool *on) {
    const int side = sli_orient(a, b, p);
    *on |= side == 0 && fmin(a.x, b.x) <= p.x && p.x <= fmax(a.x, b.x) && fmin(a.y, b.y) <= p.y &&
           p.y <= fmax(a.y, b.y);
    if (a.y <= p.y && b.y > p.y) return side > 0;
    if (b.y <= p.y && a.y > p.y) return -(side < 0);
    return 0;
}

sl_status sl_explored_holds(sl_context *context, sl_explored *e, sl_point point, bool *out) {
    SL_TRY(unite(context, e));
    int winding = 0;
    bool on = false;
    for (size_t i = 0, first = 0; i < e->area.count; first = e->area.ends[i++])
        for (size_t k = first; k < e->area.ends[i]; k++)
            winding += crosses(e->area.points[k],
                               e->area.points[k + 1 < e->area.ends[i] ? k + 1 : first], point, &on);
    *out = on || winding != 0;
    return SL_OK;
}

// --- text

typedef SL_ARRAY(char) growing_text;

static sl_status add_text(sl_context *context, growing_text *t, const char *what) {
    const size_t length = strlen(what);
    SL_TRY(SL_ARRAY_ROOM(context, t, length + 1));
    memcpy(t->items + t->count, what, length + 1);
    t->count += length;
    return SL_OK;
}

static sl_status add_number(sl_context *context, growing_text *t, double value,
                            const char *behind) {
    char number[SL_NUMBER_TEXT];
    sl_number_write(value, number);
    SL_TRY(add_text(context, t, number));
    return add_text(context, t, behind);
}

static sl_status write_area(sl_context *context, const sl_explored *e, growing_text *t) {
    SL_TRY(add_text(context, t, "sightline-explored 1\nresolution "));
    SL_TRY(add_number(context, t, e->resolution, "\n"));
    for (size_t i = 0, at = 0; i < e->area.count; i++) {
        SL_TRY(add_text(context, t, "loop "));
        SL_TRY(add_number(context, t, (double)(e->area.ends[i] - at), "\n"));
        for (; at < e->area.ends[i]; at++) {
            SL_TRY(add_number(context, t, e->area.points[at].x, " "));
            SL_TRY(add_number(context, t, e->area.points[at].y, "\n"));
        }
    }
    return SL_OK;
}

sl_status sl_explored_write(sl_context *context, sl_explored *e, sl_bytes *out) {
    growing_text t = {0};
    SL_TRY(unite(context, e));
    const sl_status status = write_area(context, e, &t);
    if (status == SL_OK)
        *out = (sl_bytes){t.items, t.count};
    else
        sl_free(context, t.items);
    return status;
}

/// A text as it is read, line by line.
typedef struct reader {
    sl_context *context;
    const char *name, *at, *stop;
    unsigned line;
} reader;

static sl_status fail_line(const reader *r, const char *what) {
    return sl_fail_at(r->context, r->name, r->line, "%s", what);
}

/// The next line without its end; false behind the last one.
static bool next_line(reader *r, const char **line, size_t *length) {
    if (r->at == r->stop) return false;
    const char *end = memchr(r->at, '\n', (size_t)(r->stop - r->at));
    *line = r->at;
    *length = (size_t)((end ? end : r->stop) - r->at);
    r->at = end ? end + 1 : r->stop;
    r->line++;
    return true;
}

/// Reads "word number".
static bool read_word(const char *line, size_t length, const char *word, double *value) {
    const size_t begin = strlen(word);
    return length > begin && memcmp(line, word, begin) == 0 &&
           sl_number_read(line + begin, length - begin, value);
}

static sl_status read_point(reader *r, sl_point *out) {
    const char *line;
    size_t length;
    if (!next_line(r, &line, &length)) return fail_line(r, "the loop ends before its last point");
    const char *space = memchr(line, ' ', length);
    const size_t first = space ? (size_t)(space - line) : 0;
    if (!space || !sl_number_read(line, first, &out->x) ||
        !sl_number_read(space + 1, length - first - 1, &out->y) || !sl_coordinate_usable(out->x) ||
        !sl_coordinate_usable(out->y))
        return fail_line(r, "expected a point: two numbers");
    return SL_OK;
}

static sl_status read_loops(reader *r, loops *l) {
    const char *line;
    size_t length;
    while (next_line(r, &line, &length)) {
        double count;
        if (!read_word(line, length, "loop ", &count) || !(count >= 3) || count > LOOPS_MOST ||
            count != floor(count))
            return fail_line(r, "expected \"loop\" and how many points it has, 3 or more");
        for (double i = 0; i < count; i++) {
            sl_point at = {0, 0};
            SL_TRY(read_point(r, &at));
            SL_TRY(SL_ARRAY_ROOM(r->context, &l->points, 1));
            l->points.items[l->points.count++] = at;
        }
        SL_TRY(end_loop(r->context, l));
    }
    return SL_OK;
}

static sl_status read_area(reader *r, sl_explored *e) {
    const char *line;
    size_t length;
    if (!next_line(r, &line, &length) || length != 20 ||
        memcmp(line, "sightline-explored 1", 20) != 0)
        return fail_line(r, "expected \"sightline-explored 1\"");
    if (!next_line(r, &line, &length) || !read_word(line, length, "resolution ", &e->resolution) ||
        !(e->resolution >= 0) || isinf(e->resolution))
        return fail_line(r, "expected \"resolution\" and a number, 0 or more");
    SL_TRY(read_loops(r, &e->waiting));
    return unite(r->context, e);
}

sl_status sl_explored_read(sl_context *context, const char *name, const char *text, size_t length,
                           sl_explored **out) {
    reader r = {context, name, text, text + length, 0};
    sl_explored *e;
    SL_TRY(sl_explored_create(context, 0, &e));
    const sl_status status = read_area(&r, e);
    if (status == SL_OK)
        *out = e;
    else
        sl_explored_destroy(context, e);
    return status;
}
