/// Ways out of files and by tour, cut into frames; each frame is culled and drawn by each method.
#include "studies/walk_run.h"

#include "inputs/inputs.h"
#include "sightline/support.h"
#include "sightline/walk.h"
#include "studies/isovist.h"

#include <math.h>
#include <string.h>

enum { WALK_COLUMNS = 640, TOUR_STEPS_ACROSS = 500 };

typedef struct walk_canvas {
    const sl_hierarchy *hierarchy;
    uint64_t *drawn; ///< by wall, the frame in which it was drawn last
    uint64_t frame;
    float nearness[WALK_COLUMNS]; ///< one over the depth; 0 for nothing
    uint32_t wall[WALK_COLUMNS];
} walk_canvas;

// --- the way

enum { MOST_FRAMES = 10000000 };

static sl_status add_point(sl_context *context, walk_way *way, sl_point point) {
    SL_TRY(SL_ARRAY_ROOM(context, way, 1));
    way->items[way->count++] = point;
    return SL_OK;
}

// --- from a file

static bool is_gap(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == ',';
}

static sl_status read_line(sl_context *context, const char *path, unsigned number, const char *line,
                           size_t length, const sl_space *space, walk_way *way) {
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
    SL_TRY(input_check_place(context, path, number, space, point));
    return add_point(context, way, point);
}

sl_status way_read(sl_context *context, const char *path, const sl_space *space, walk_way *way) {
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
static sl_status go_to(sl_context *context, const tour *t, uint32_t cell, walk_way *way) {
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
    return add_point(context, way, sl_space_middle(t->space, cell));
}

static double length_from(const walk_way *way, size_t first) {
    double length = 0;
    for (size_t i = first; i < way->count; i++)
        length +=
            hypot(way->items[i].x - way->items[i - 1].x, way->items[i].y - way->items[i - 1].y);
    return length;
}

double way_length(const walk_way *way) {
    return length_from(way, 1);
}

/// The longer side of the box around the cells in the queue. It is not that of the map's bounds,
/// which one wall far away would make large.
static double size_of_walk(const tour *t, uint32_t count) {
    sl_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < count; i++) {
        const sl_cell *cell = &t->space->cells[t->queue[i]];
        for (uint32_t k = 0; k < cell->vertex_count; k++) {
            const sl_point at = t->space->vertices[cell->first_vertex + k];
            box.min = (sl_point){fmin(box.min.x, at.x), fmin(box.min.y, at.y)};
            box.max = (sl_point){fmax(box.max.x, at.x), fmax(box.max.y, at.y)};
        }
    }
    return fmax(box.max.x - box.min.x, box.max.y - box.min.y);
}

static sl_status lay_tour(sl_context *context, tour *t, sl_point start, uint64_t seed, double steps,
                          double *step, walk_way *way) {
    sl_random random = {seed};
    uint32_t cell = sl_space_locate(t->space, start);
    uint32_t count = search(t, cell);
    if (!(*step > 0)) *step = size_of_walk(t, count) / TOUR_STEPS_ACROSS;
    const double length = *step * steps;
    double laid = 0;
    SL_TRY(add_point(context, way, start));
    for (; laid < length; count = search(t, cell)) {
        const size_t before = way->count;
        SL_TRY(sl_check_cancelled(context));
        if (count < 2)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "no other cell can be walked to from %.17g,%.17g: give a --path, or "
                           "another --start",
                           start.x, start.y);
        cell = t->queue[1 + sl_random_below(&random, count - 1)];
        SL_TRY(go_to(context, t, cell, way));
        laid += length_from(way, before);
    }
    // Cut off what is too long.
    double over = laid - length;
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

sl_status way_tour(sl_context *context, const sl_space *space, sl_point start, uint64_t seed,
                   double steps, double *step, walk_way *way) {
    tour t = {.space = space};
    t.came_by = sl_alloc_array(context, space->cell_count, sizeof *t.came_by);
    t.came_from = sl_alloc_array(context, space->cell_count, sizeof *t.came_from);
    t.queue = sl_alloc_array(context, space->cell_count, sizeof *t.queue);
    sl_status status = SL_NO_MEMORY;
    if (t.came_by && t.came_from && t.queue)
        status = lay_tour(context, &t, start, seed, steps, step, way);
    sl_free(context, t.came_by);
    sl_free(context, t.came_from);
    sl_free(context, t.queue);
    return status;
}

// --- frames

/// A place that moves along a way.
typedef struct walker {
    const walk_way *way;
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

sl_status way_frames(sl_context *context, const walk_way *way, double step, double ahead,
                     double fov, eye_places *eyes) {
    const double steps = way_length(way) / step;
    if (!(steps <= MOST_FRAMES))
        return sl_fail(context, SL_BAD_ARGUMENT, "%.0f steps: at most %d can be", steps,
                       MOST_FRAMES);
    walker eye = {.way = way}, seen = {.way = way};
    double look = 0;
    sl_point toward = advance(&seen, ahead);
    // The last step may come out a little short of the end by rounding.
    for (size_t i = 0; i < (size_t)(steps + 1e-6); i++) {
        const sl_point at = advance(&eye, i ? step : 0);
        toward = i ? advance(&seen, step) : toward;
        if (at.x != toward.x || at.y != toward.y)
            look = atan2(toward.y - at.y, toward.x - at.x) * (180 / acos(-1));
        SL_TRY(eyes_add(context, eyes, (eye_place){at, look, fov, 0}));
    }
    return SL_OK;
}

// --- drawing walls

static sl_status walk_canvas_create(sl_context *context, const sl_hierarchy *hierarchy,
                                    walk_canvas **out) {
    walk_canvas *c = sl_alloc_array(context, 1, sizeof *c);
    uint64_t *drawn = sl_alloc_array(context, hierarchy->space->wall_count, sizeof *drawn);
    if (!c || !drawn) {
        sl_free(context, c);
        sl_free(context, drawn);
        return SL_NO_MEMORY;
    }
    c->hierarchy = hierarchy;
    c->drawn = drawn;
    *out = c;
    return SL_OK;
}

static void walk_canvas_destroy(sl_context *context, walk_canvas *canvas) {
    if (canvas) sl_free(context, canvas->drawn);
    sl_free(context, canvas);
}

/// A part of the view: where it looks, how wide it is, and its columns.
typedef struct camera {
    sl_point at, ahead, left; ///< unit vectors but for `at`
    double half_width;        ///< tangent of half its angle
    int first, count;
} camera;

/// A wall's columns, nearer than what is there already. One over the depth is linear across.
static void draw_wall(walk_canvas *c, const camera *cam, uint32_t number) {
    const sl_wall *w = &c->hierarchy->space->walls[number];
    double depth[2], across[2];
    for (int i = 0; i < 2; i++) {
        const sl_point p = i ? w->b : w->a, d = {p.x - cam->at.x, p.y - cam->at.y};
        depth[i] = d.x * cam->ahead.x + d.y * cam->ahead.y;
        across[i] = -(d.x * cam->left.x + d.y * cam->left.y);
    }
    const double least = 1e-6 * (fabs(depth[0]) + fabs(depth[1]));
    if (depth[0] <= least && depth[1] <= least) return;
    for (int i = 0; i < 2; i++) {
        if (depth[i] > least) continue;
        const double share = (least - depth[i]) / (depth[1 - i] - depth[i]);
        across[i] += share * (across[1 - i] - across[i]);
        depth[i] = least;
    }
    const double scale = cam->count / (2 * cam->half_width);
    double x0 = (across[0] / depth[0] + cam->half_width) * scale;
    double x1 = (across[1] / depth[1] + cam->half_width) * scale;
    double near0 = 1 / depth[0], near1 = 1 / depth[1];
    if (x0 > x1) {
        const double x = x0, near = near0;
        x0 = x1, near0 = near1;
        x1 = x, near1 = near;
    }
    if (!(x1 > 0 && x0 < cam->count)) return;
    const int from = x0 > 0 ? (int)x0 : 0, to = x1 < cam->count ? (int)x1 : cam->count - 1;
    const double slope = x1 > x0 ? (near1 - near0) / (x1 - x0) : 0;
    for (int x = from; x <= to; x++) {
        const float near = (float)(near0 + slope * (x + 0.5 - x0));
        if (near <= c->nearness[cam->first + x]) continue;
        c->nearness[cam->first + x] = near;
        c->wall[cam->first + x] = number;
    }
}

static void draw_cell(walk_canvas *c, const camera *cameras, int camera_count, uint32_t cell,
                      uint32_t *walls) {
    const sl_hierarchy *h = c->hierarchy;
    for (uint32_t i = h->first_wall[cell]; i < h->first_wall[cell + 1]; i++) {
        const uint32_t wall = h->walls[i];
        if (c->drawn[wall] == c->frame) continue;
        c->drawn[wall] = c->frame;
        for (int k = 0; k < camera_count; k++) draw_wall(c, &cameras[k], wall);
        (*walls)++;
    }
}

/// Draws the walls of a set of cells, each once; returns how many walls that were. A view of more
/// than 120 degrees is drawn in several parts side by side.
static uint32_t walk_draw(walk_canvas *c, const eye_place *eye, const uint64_t *cells) {
    const double degree = acos(-1) / 180;
    const int parts = eye->fov > 240 ? 4 : eye->fov > 120 ? 2 : 1;
    const double width = eye->fov / parts;
    camera cameras[4];
    for (int i = 0; i < parts; i++) {
        const double look = (eye->heading + eye->fov / 2 - width * (i + 0.5)) * degree;
        cameras[i] = (camera){.at = eye->at,
                              .ahead = {cos(look), sin(look)},
                              .left = {-sin(look), cos(look)},
                              .half_width = tan(fmax(width, 0.01) / 2 * degree),
                              .first = WALK_COLUMNS / parts * i,
                              .count = WALK_COLUMNS / parts};
    }
    uint32_t walls = 0;
    c->frame++;
    memset(c->nearness, 0, sizeof c->nearness);
    for (size_t word = 0; word * 64 < c->hierarchy->space->cell_count; word++)
        for (uint64_t bits = cells[word]; bits; bits &= bits - 1)
            draw_cell(c, cameras, parts, (uint32_t)(word * 64) + (uint32_t)__builtin_ctzll(bits),
                      &walls);
    return walls;
}

// --- walking

static const char *const names[FIGURES] = {
    "tests",        "frustum_tests", "opened", "propagations", "propagated", "skipped", "bounded",
    "cheap",        "visited",       "out",    "invisible",    "partial",    "visible", "occluders",
    "orientations", "cells",         "walls",  "visibility_s", "drawing_s",  "frame_s",
};

const char *walk_figure_name(walk_figure figure) {
    return names[figure];
}

const char *walk_choice_name(const walk_choice *choice) {
    return choice->method ? choice->method->name : choice->baked->name;
}

const char *walk_choice_test(const walk_choice *choice) {
    return choice->method ? choice->options.test->name : "baked";
}

/// What one walk needs.
typedef struct running {
    const walk_scene *scene;
    const walk_choice *choice;
    sl_walk *walk;
    sl_query *query;
    uint64_t *cells;
    walk_canvas *canvas;
} running;

static sl_status start(sl_context *context, running *r) {
    const sl_space *space = &r->scene->baked->space;
    if (r->choice->method)
        return sl_walk_create(context, r->scene->hierarchy, r->choice->method, &r->choice->options,
                              &r->walk);
    r->cells = sl_alloc_array(context, sl_eye_words(space), sizeof *r->cells);
    if (!r->cells) return SL_NO_MEMORY;
    SL_TRY(sl_query_create(context, r->scene->baked, &r->query));
    return sl_query_set_mirror_depth(context, r->query, 0);
}

static void stop(sl_context *context, running *r) {
    sl_walk_destroy(context, r->walk);
    sl_query_destroy(context, r->query);
    sl_free(context, r->cells);
    r->walk = NULL;
    r->query = NULL;
    r->cells = NULL;
}

static void put_counts(const sl_walk_frame *f, double *out) {
    const double values[] = {
        f->tests,     f->frustum_tests, f->opened,  f->propagations, f->propagated,
        f->skipped,   f->bounded,       f->cheap,   f->visited,      f->out,
        f->invisible, f->partial,       f->visible, f->occluders,    (double)f->orientations};
    for (int i = 0; i <= FIGURE_ORIENTATIONS; i++) out[i] = values[i];
}

static uint32_t count_cells(const uint64_t *cells, size_t words) {
    uint32_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint32_t)__builtin_popcountll(cells[i]);
    return count;
}

/// One frame. A time in `out` stays where it is less than the new one.
static sl_status do_frame(sl_context *context, running *r, const eye_place *eye, bool first,
                          double *out) {
    const sl_space *space = &r->scene->baked->space;
    const sl_view view = eye_view(space, eye);
    const uint64_t *cells = r->cells;
    const double began = sl_seconds();
    if (r->walk) {
        sl_walk_frame frame;
        SL_TRY(sl_walk_step(context, r->walk, &view, &frame));
        cells = sl_walk_cells(r->walk);
        put_counts(&frame, out);
    } else {
        sl_eye_account account;
        SL_TRY(sl_query_look(context, r->query, &view, r->choice->baked, r->cells, &account));
        out[FIGURE_ORIENTATIONS] = (double)account.orientations;
    }
    const double seen = sl_seconds();
    out[FIGURE_WALLS] = walk_draw(r->canvas, eye, cells);
    const double drawn = sl_seconds();
    out[FIGURE_CELLS] = count_cells(cells, sl_eye_words(space));
    out[FIGURE_VISIBILITY] = first ? seen - began : fmin(out[FIGURE_VISIBILITY], seen - began);
    out[FIGURE_DRAWING] = first ? drawn - seen : fmin(out[FIGURE_DRAWING], drawn - seen);
    if (r->scene->wall_seconds > 0)
        out[FIGURE_DRAWING] = r->scene->wall_seconds * out[FIGURE_WALLS];
    out[FIGURE_FRAME] = out[FIGURE_VISIBILITY] + out[FIGURE_DRAWING];
    return SL_OK;
}

static sl_status run_all(sl_context *context, running *r, const eye_places *eyes, double *frames) {
    const size_t count = eyes->list.count;
    for (unsigned k = 0; k < r->scene->repeat; k++) {
        SL_TRY(start(context, r));
        for (size_t i = 0; i < count; i++) {
            if (i % 1024 == 0) SL_TRY(sl_check_cancelled(context));
            SL_TRY(do_frame(context, r, &eyes->list.items[i], k == 0, frames + i * FIGURES));
        }
        stop(context, r);
        sl_report(context, "walk", "walks", k + 1, r->scene->repeat);
    }
    return SL_OK;
}

sl_status walk_run(command_console *console, const walk_scene *scene, const walk_choice *choice,
                   const eye_places *eyes, double means[FIGURES], double *frames) {
    sl_context *context = console->context;
    const size_t count = eyes->list.count;
    running r = {.scene = scene, .choice = choice};
    double *own = frames ? NULL : sl_alloc_array(context, count * FIGURES, sizeof *own);
    if (!frames && !own) return SL_NO_MEMORY;
    double *all = frames ? frames : own;
    sl_status status = walk_canvas_create(context, scene->hierarchy, &r.canvas);
    if (status == SL_OK) status = run_all(context, &r, eyes, all);
    stop(context, &r);
    walk_canvas_destroy(context, r.canvas);
    for (int f = 0; f < FIGURES && status == SL_OK; f++) {
        double sum = 0;
        for (size_t i = 0; i < count; i++) sum += all[i * FIGURES + (size_t)f];
        means[f] = sum / (double)count;
    }
    sl_free(context, own);
    return status;
}
