#include "walk_path.h"

#include "sightline/support.h"

#include <math.h>
#include <string.h>

enum { MOST_FRAMES = 10000000 };

static sl_status add_point(sl_context *context, sl_way *way, sl_point point) {
    SL_TRY(SL_ARRAY_ROOM(context, way, 1));
    way->items[way->count++] = point;
    return SL_OK;
}

// --- from a file

static bool is_gap(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == ',';
}

static sl_status read_line(sl_context *context, const char *path, unsigned number, const char *line,
                           size_t length, const sl_space *space, sl_way *way) {
    const char *comment = memchr(line, '#', length);
    if (comment) length = (size_t)(comment - line);
    double values[2] = {0};
    int count = 0;
    for (size_t at = 0;;) {
        while (at < length && is_gap(line[at])) at++;
        if (at == length) break;
        size_t end = at;
        while (end < length && !is_gap(line[end])) end++;
        if (count == 2 || !sl_number_read(line + at, end - at, &values[count]) ||
            !isfinite(values[count]))
            return sl_fail_at(context, path, number, "two finite numbers are needed: x y");
        count++;
        at = end;
    }
    if (!count) return SL_OK;
    if (count < 2) return sl_fail_at(context, path, number, "two finite numbers are needed: x y");
    const sl_point point = {values[0], values[1]};
    if (sl_space_locate(space, point) == SL_NO_CELL)
        return sl_fail_at(context, path, number, "the point lies outside the map");
    return add_point(context, way, point);
}

sl_status sl_way_read(sl_context *context, const char *path, const sl_space *space, sl_way *way) {
    sl_bytes text;
    SL_TRY(sl_file_read(context, path, &text));
    sl_status status = SL_OK;
    unsigned number = 0;
    for (size_t at = 0; at < text.size && status == SL_OK;) {
        const char *line = text.data + at, *end = memchr(line, '\n', text.size - at);
        const size_t length = end ? (size_t)(end - line) : text.size - at;
        at += length + 1;
        status = read_line(context, path, ++number, line, length, space, way);
    }
    sl_free(context, text.data);
    if (status == SL_OK && way->count < 2)
        status = sl_fail_at(context, path, 0, "a path needs two points at least");
    return status;
}

// --- a tour

/// What a tour is made with.
typedef struct tour {
    const sl_space *space;
    uint32_t *came_by; ///< by cell: the directed portal by which the search left the cell before it
    uint32_t *came_from, *queue;
} tour;

/// Searches breadth first from a cell; returns how many cells are in the queue, itself first.
static uint32_t search(tour *t, uint32_t from) {
    const sl_space *space = t->space;
    memset(t->came_from, 0xff, space->cell_count * sizeof *t->came_from);
    uint32_t count = 0;
    t->came_from[from] = from;
    t->queue[count++] = from;
    for (uint32_t i = 0; i < count; i++) {
        const sl_cell *cell = &space->cells[t->queue[i]];
        for (uint32_t e = cell->first_directed; e < cell->first_directed + cell->directed_count;
             e++) {
            const uint32_t next = space->directed[e].cell;
            if (t->came_from[next] != UINT32_MAX || !space->cells[next].inside) continue;
            t->came_from[next] = t->queue[i];
            t->came_by[next] = e;
            t->queue[count++] = next;
        }
    }
    return count;
}

/// Adds the middles of the portals on the way to a cell, in order.
static sl_status go_to(sl_context *context, const tour *t, uint32_t cell, sl_way *way) {
    const size_t first = way->count;
    for (uint32_t c = cell; t->came_from[c] != c; c = t->came_from[c]) {
        const sl_directed_portal *e = &t->space->directed[t->came_by[c]];
        SL_TRY(add_point(context, way,
                         (sl_point){(e->left.x + e->right.x) / 2, (e->left.y + e->right.y) / 2}));
    }
    for (size_t i = first, k = way->count; i + 1 < k; i++) {
        const sl_point swapped = way->items[i];
        way->items[i] = way->items[--k];
        way->items[k] = swapped;
    }
    const sl_cell *c = &t->space->cells[cell];
    sl_point middle = {0, 0};
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        middle.x += t->space->vertices[c->first_vertex + i].x / c->vertex_count;
        middle.y += t->space->vertices[c->first_vertex + i].y / c->vertex_count;
    }
    return add_point(context, way, middle);
}

double sl_way_length(const sl_way *way) {
    double length = 0;
    for (size_t i = 1; i < way->count; i++)
        length +=
            hypot(way->items[i].x - way->items[i - 1].x, way->items[i].y - way->items[i - 1].y);
    return length;
}

static sl_status lay_tour(sl_context *context, tour *t, sl_point start, uint64_t seed,
                          double length, sl_way *way) {
    sl_random random = {seed};
    uint32_t cell = sl_space_locate(t->space, start);
    SL_TRY(add_point(context, way, start));
    while (sl_way_length(way) < length) {
        SL_TRY(sl_check_cancelled(context));
        const uint32_t count = search(t, cell);
        if (count < 2)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "no other cell can be walked to from %.17g,%.17g: give a --path, or "
                           "another --start",
                           start.x, start.y);
        cell = t->queue[1 + sl_random_below(&random, count - 1)];
        SL_TRY(go_to(context, t, cell, way));
    }
    // What is too long of it is taken off.
    double over = sl_way_length(way) - length;
    sl_point *last = &way->items[way->count - 1];
    while (way->count > 2 && hypot(last->x - last[-1].x, last->y - last[-1].y) < over) {
        over -= hypot(last->x - last[-1].x, last->y - last[-1].y);
        way->count--;
        last--;
    }
    const double whole = hypot(last->x - last[-1].x, last->y - last[-1].y);
    const double share = whole > over ? 1 - over / whole : 1;
    last->x = last[-1].x + share * (last->x - last[-1].x);
    last->y = last[-1].y + share * (last->y - last[-1].y);
    return SL_OK;
}

sl_status sl_way_tour(sl_context *context, const sl_space *space, sl_point start, uint64_t seed,
                      double length, sl_way *way) {
    tour t = {.space = space};
    t.came_by = sl_alloc_array(context, space->cell_count, sizeof *t.came_by);
    t.came_from = sl_alloc_array(context, space->cell_count, sizeof *t.came_from);
    t.queue = sl_alloc_array(context, space->cell_count, sizeof *t.queue);
    sl_status status = SL_NO_MEMORY;
    if (t.came_by && t.came_from && t.queue)
        status = lay_tour(context, &t, start, seed, length, way);
    sl_free(context, t.came_by);
    sl_free(context, t.came_from);
    sl_free(context, t.queue);
    return status;
}

// --- frames

/// A place that moves along a way.
typedef struct walker {
    const sl_way *way;
    size_t leg;   ///< from point leg to the next
    double along; ///< what of the leg is done
} walker;

static sl_point advance(walker *w, double distance) {
    const sl_point *p = w->way->items;
    w->along += distance;
    for (;; w->leg++) {
        const sl_point from = p[w->leg], to = p[w->leg + 1];
        const double length = hypot(to.x - from.x, to.y - from.y);
        if (w->along < length)
            return (sl_point){from.x + w->along / length * (to.x - from.x),
                              from.y + w->along / length * (to.y - from.y)};
        if (w->leg + 2 == w->way->count) return to;
        w->along -= length;
    }
}

sl_status sl_way_frames(sl_context *context, const sl_way *way, double step, double ahead,
                        double fov, sl_eyes *eyes) {
    const double steps = sl_way_length(way) / step;
    if (!(steps <= MOST_FRAMES))
        return sl_fail(context, SL_BAD_ARGUMENT, "%.0f steps: at most %d can be", steps,
                       MOST_FRAMES);
    walker eye = {.way = way}, seen = {.way = way};
    double look = 0;
    sl_point at = advance(&eye, 0), toward = advance(&seen, ahead);
    // The last step may come out a little short of the end by rounding.
    for (size_t i = 0; i < (size_t)(steps + 1e-6); i++) {
        at = advance(&eye, i ? step : 0);
        toward = i ? advance(&seen, step) : toward;
        if (at.x != toward.x || at.y != toward.y)
            look = atan2(toward.y - at.y, toward.x - at.x) * (180 / acos(-1));
        SL_TRY(sl_eyes_add(context, eyes, (sl_eye){at, look, fov}));
    }
    return SL_OK;
}
