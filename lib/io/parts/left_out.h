/// Lines of a drawing that are left out and stand as windows and walls do: glass in the gaps of
/// outer walls (left_glass.c), and lines that part rooms (left_walls.c). What counts is where lines
/// end, not their names and looks.
#ifndef SL_LEFT_OUT_H
#define SL_LEFT_OUT_H

#include "geometry/length.h"
#include "sightline/map.h"
#include "sightline/support.h"
#include "space/index.h"

/// What is looked at, and what is found. Set the first ones, zero the rest.
typedef struct sli_left_out {
    sl_context *context;
    const sl_map *map;
    sl_bits *walls;        ///< those that are taken; the glass that is found is added
    const uint32_t *kinds; ///< by wall: of those that are left out, their layer or look, from 1 on;
                           ///< 0 for others
    const double *pens;    ///< by wall: half the width of its line
    double metre;          ///< in the map's unit, 0 for unknown
    bool thin;             ///< what is left out is drawn by lighter lines than walls are
    const sl_segment *doors; ///< across each opening that is drawn as a door
    size_t door_count;
    // found
    sl_bits *glass; ///< by wall
    size_t gaps;    ///< with glass
    // of the search
    sli_wall_index index;
    double size;   ///< the longer side of the walls that are taken
    double off;    ///< how far apart lines may be that meet
    double widest; ///< of the pens
    size_t near;   ///< lines that were near others, of the search for glass
} sli_left_out;

/// Makes the index, and measures. Destroy it also on failure. `*fits`: there are walls, and not too
/// many lines to look at.
sl_status sli_left_out_make(sli_left_out *left, bool *fits);
void sli_left_out_destroy(sli_left_out *left);

/// Finds glass: two lines or more side by side, from the end of a wall to the end of another one in
/// line with it, with nothing in front of one side. Time O(n log n), and walls x gaps. None where
/// very many lines are near each other.
sl_status sli_left_out_glass(sli_left_out *left);
/// Counts the lines of a kind that are walls by where they are, if much of it is: else 0. Time
/// O(n log n) where few lines are near each other.
sl_status sli_left_out_walls(sli_left_out *left, uint32_t kind, size_t *count);

/// Puts the lines that come near to a point into left->index.near. A few others may be among them.
static inline sl_status sli_left_out_near(sli_left_out *left, sl_point at) {
    return sli_walls_near(left->context, &left->index, (sl_segment){at, at},
                          left->off + left->widest);
}

/// A length in metres, or where these are not known, as a share of the drawing.
static inline double sli_left_out_scaled(const sli_left_out *left, double metres, double share) {
    return left->metre > 0 ? metres * left->metre : share * left->size;
}

static inline double sli_wall_length(const sl_wall *wall) {
    return sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
}

/// How far lines may be from being parallel or upright to each other: a sine.
#define SLI_LEFT_OUT_TURN 0.05

/// How far a line runs along another one that is parallel, and how far that is at its left.
static inline double sli_left_out_along(const sl_wall *line, const sl_wall *other, double *left) {
    const sl_point u = {line->b.x - line->a.x, line->b.y - line->a.y};
    const sl_point v = {other->b.x - other->a.x, other->b.y - other->a.y};
    const double a = sli_wall_length(line), b = sli_wall_length(other);
    if (!(b > 0) || fabs(sli_cross(u, v)) > SLI_LEFT_OUT_TURN * a * b) return 0;
    const sl_point from = {other->a.x - line->a.x, other->a.y - line->a.y};
    const sl_point to = {other->b.x - line->a.x, other->b.y - line->a.y};
    const double s = sli_dot(u, from) / a, t = sli_dot(u, to) / a;
    *left = (sli_cross(u, from) + sli_cross(u, to)) / (2 * a);
    return fmax(0, fmin(a, fmax(s, t)) - fmax(0, fmin(s, t)));
}

#endif
