/// Between boxes first, then between corners and sides: the nearest points of two convex polygons
/// that have none in common are a corner of one and a place on a side of the other, the farthest
/// are corners of both.
#include "cell_to_cell/cells_apart.h"

#include "cell_to_cell/pvs_maker.h"

#include <math.h>

/// What rounding may do, in parts of the size of both cells together: differences, products and
/// roots are each rounded by 2^-53 of themselves.
#define ERROR 0x1p-45

/// And what the length of sightlines is known to, in parts of the range, doubled.
#define RANGE_ERROR 0x1p-39

typedef struct polygon {
    const sl_point *corners;
    uint32_t count;
    sl_box box;
} polygon;

static polygon polygon_of(const sl_space *space, uint32_t cell) {
    const sl_cell *c = &space->cells[cell];
    polygon p = {.corners = space->vertices + c->first_vertex, .count = c->vertex_count};
    p.box = (sl_box){p.corners[0], p.corners[0]};
    for (uint32_t i = 1; i < p.count; i++) {
        p.box.min.x = fmin(p.box.min.x, p.corners[i].x);
        p.box.min.y = fmin(p.box.min.y, p.corners[i].y);
        p.box.max.x = fmax(p.box.max.x, p.corners[i].x);
        p.box.max.y = fmax(p.box.max.y, p.corners[i].y);
    }
    return p;
}

static double distance_to_side(sl_point p, sl_point a, sl_point b) {
    const double length = hypot(b.x - a.x, b.y - a.y);
    const double ux = (b.x - a.x) / length, uy = (b.y - a.y) / length;
    const double along = ux * (p.x - a.x) + uy * (p.y - a.y);
    if (along <= 0) return hypot(p.x - a.x, p.y - a.y);
    if (along >= length) return hypot(p.x - b.x, p.y - b.y);
    return fabs(ux * (p.y - a.y) - uy * (p.x - a.x));
}

/// From the corners of one to the sides of the other.
static double nearest(const polygon *p, const polygon *q) {
    double least = INFINITY;
    for (uint32_t i = 0; i < p->count; i++)
        for (uint32_t k = 0; k < q->count; k++)
            least = fmin(least, distance_to_side(p->corners[i], q->corners[k],
                                                 q->corners[(k + 1) % q->count]));
    return least;
}

static double farthest(const polygon *p, const polygon *q) {
    double most = 0;
    for (uint32_t i = 0; i < p->count; i++)
        for (uint32_t k = 0; k < q->count; k++)
            most = fmax(
                most, hypot(p->corners[i].x - q->corners[k].x, p->corners[i].y - q->corners[k].y));
    return most;
}

/// Rounded, to the safe side: what is told of all is so.
static sl_apart cells_apart(const sl_space *space, uint32_t a, uint32_t b, double range) {
    const polygon p = polygon_of(space, a), q = polygon_of(space, b);
    const double width = fmax(p.box.max.x, q.box.max.x) - fmin(p.box.min.x, q.box.min.x);
    const double height = fmax(p.box.max.y, q.box.max.y) - fmin(p.box.min.y, q.box.min.y);
    const double size = hypot(width, height), error = size * ERROR;
    if (size + error <= range) return SL_ALL_WITHIN;
    const double neighbour = range * (1 + RANGE_ERROR) + error;
    const double x = fmax(p.box.min.x, q.box.min.x) - fmin(p.box.max.x, q.box.max.x);
    const double y = fmax(p.box.min.y, q.box.min.y) - fmin(p.box.max.y, q.box.max.y);
    if (hypot(fmax(x, 0), fmax(y, 0)) > neighbour) return SL_NONE_WITHIN;
    if (farthest(&p, &q) + error <= range) return SL_ALL_WITHIN;
    return fmin(nearest(&p, &q), nearest(&q, &p)) > neighbour ? SL_NONE_WITHIN : SL_SOME_WITHIN;
}

static sl_status make_rows(sl_context *context, const sl_space *space, const sl_pvs *pvs,
                           double range, sl_apart most, sl_pvs_maker *maker, sl_pvs *out) {
    SL_TRY(sl_pvs_maker_create(context, pvs->cell_count, pvs->cell_count, maker));
    for (uint32_t cell = 0; cell < pvs->cell_count; cell++) {
        for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
            for (uint32_t i = run.first; i < run.end; i++)
                if (i == cell || cells_apart(space, cell, i, range) <= most)
                    sl_word_set_add(&maker->row, i);
        SL_TRY(sl_pvs_maker_end_row(context, maker));
        SL_TRY(sl_check_cancelled(context));
    }
    return sl_pvs_maker_finish(context, maker, out);
}

sl_status sl_pvs_within(sl_context *context, const sl_space *space, const sl_pvs *pvs, double range,
                        sl_apart most, sl_pvs *out) {
    sl_pvs_maker maker = {0};
    const sl_status status = make_rows(context, space, pvs, range, most, &maker, out);
    sl_pvs_maker_destroy(context, &maker);
    return status;
}
