/// Rays within a cell.
#ifndef SL_RAY_H
#define SL_RAY_H

#include "sightline/space.h"

#include <math.h>

/// The length of a ray from a point of the cell to where it leaves the cell, as a multiple of
/// `direction`. Rounded.
static inline double sl_ray_length(const sl_space *space, uint32_t cell, sl_point from,
                                   sl_point direction) {
    const sl_cell *c = &space->cells[cell];
    const sl_point *corners = space->vertices + c->first_vertex;
    double length = INFINITY;
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        const sl_point a = corners[i], b = corners[(i + 1) % c->vertex_count];
        const double nx = b.y - a.y, ny = a.x - b.x; // outwards, corners being counter-clockwise
        const double ahead = nx * direction.x + ny * direction.y;
        const double room = nx * (a.x - from.x) + ny * (a.y - from.y);
        if (ahead > 0) length = fmin(length, fmax(room / ahead, 0));
    }
    return length;
}

#endif
