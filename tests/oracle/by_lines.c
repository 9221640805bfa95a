// Open sight, straight from the definition: two cells see each other iff a line with room around it
// runs from one to the other without meeting a wall.
//
// Call corners of cells and ends of walls critical points. Two lines that pass every critical point
// on the same sides cross the same walls and cells in the same order (where walls cross each other,
// the cells between them have a corner). Lines through critical points
// are no more than borders between such families, so open sight is decided by one line out of each
// family that has room. These are found by direction: as a line turns, the order in which parallel
// lines sweep the critical points changes only where the direction is that of two of them. So
// between two neighbouring such directions one will do, and for it one line between every two
// neighbouring critical points.
//
// All of it in 64-bit integers: with coordinates up to B = 256, directions are up to 4 B, sides up
// to 32 B^2, places up to 512 B^4 over 64 B^2, and comparing two places takes less than 2^15 B^6 =
// 2^63.
#include "oracle/dyadic.h"
#include "oracle/must.h"
#include "oracle/oracle.h"

#include <stdlib.h>
#include <string.h>

enum { COORDINATE_LIMIT = 256 };

typedef struct grid_point {
    int64_t x, y;
} grid_point;

/// A place along a line: num / den, den > 0.
typedef struct place {
    int64_t num, den;
} place;

typedef struct job {
    const sl_space *space;
    size_t wall_count;
    grid_point *corners;   ///< as space.vertices
    grid_point *wall_ends; ///< two a wall
    grid_point *points;    ///< all critical points, each once
    size_t point_count;
    grid_point *directions;
    size_t direction_count;
    int64_t *sweep;           ///< where the sweep meets each critical point
    place *hits;              ///< where the line meets walls
    uint32_t *crossed, *gaps; ///< the cells that the line crosses, and behind how many walls
    bool *open;
} job;

static int64_t cross(grid_point u, grid_point v) {
    return u.x * v.y - u.y * v.x;
}

static int64_t dot(grid_point u, grid_point v) {
    return u.x * v.x + u.y * v.y;
}

static int compare_points(const void *a, const void *b) {
    const grid_point *p = a, *q = b;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    return (p->y > q->y) - (p->y < q->y);
}

/// Directions lie in the half turn from straight down (included) to straight up (not).
static int compare_directions(const void *a, const void *b) {
    int64_t turn = cross(*(const grid_point *)a, *(const grid_point *)b);
    return (turn < 0) - (turn > 0);
}

static int compare_numbers(const void *a, const void *b) {
    int64_t p = *(const int64_t *)a, q = *(const int64_t *)b;
    return (p > q) - (p < q);
}

static int compare_places(const void *a, const void *b) {
    const place *p = a, *q = b;
    int64_t left = p->num * q->den, right = q->num * p->den;
    return (left > right) - (left < right);
}

/// Sorts, and keeps one of equal items; how many stay.
static size_t unique(void *items, size_t count, size_t size,
                     int (*compare)(const void *, const void *)) {
    char *at = items;
    size_t kept = 0;
    qsort(items, count, size, compare);
    for (size_t i = 0; i < count; i++) {
        if (kept && compare(at + (kept - 1) * size, at + i * size) == 0) continue;
        if (kept != i) memcpy(at + kept * size, at + i * size, size);
        kept++;
    }
    return kept;
}

static bool to_grid(double value, int exponent, int64_t *out) {
    dyadic d = dyadic_of(value);
    *out = 0;
    if (d.odd == 0) return true;
    for (; d.exponent > exponent && llabs(d.odd) <= COORDINATE_LIMIT; d.exponent--) d.odd *= 2;
    *out = d.odd;
    return llabs(d.odd) <= COORDINATE_LIMIT;
}

/// The smallest exponent among the coordinates of cells and walls.
static int common_exponent(const sl_space *space, const sl_wall *walls, size_t wall_count) {
    bool any = false;
    int exponent = 0;
    size_t corners = space->vertex_count;
    for (size_t i = 0; i < 2 * (corners + 2 * wall_count); i++) {
        size_t k = i / 2;
        sl_point p = k < corners         ? space->vertices[k]
                     : (k - corners) % 2 ? walls[(k - corners) / 2].b
                                         : walls[(k - corners) / 2].a;
        dyadic d = dyadic_of(i % 2 ? p.y : p.x);
        if (d.odd && (!any || d.exponent < exponent)) exponent = d.exponent;
        any = any || d.odd;
    }
    return exponent;
}

static bool take_points(job *j, const sl_wall *walls) {
    int exponent = common_exponent(j->space, walls, j->wall_count);
    size_t corners = j->space->vertex_count;
    bool small = true;
    for (size_t i = 0; small && i < corners; i++) {
        small = to_grid(j->space->vertices[i].x, exponent, &j->corners[i].x) &&
                to_grid(j->space->vertices[i].y, exponent, &j->corners[i].y);
    }
    for (size_t i = 0; small && i < 2 * j->wall_count; i++) {
        sl_point end = i % 2 ? walls[i / 2].b : walls[i / 2].a;
        small = to_grid(end.x, exponent, &j->wall_ends[i].x) &&
                to_grid(end.y, exponent, &j->wall_ends[i].y);
    }
    if (!small) return false;
    memcpy(j->points, j->corners, corners * sizeof *j->points);
    memcpy(j->points + corners, j->wall_ends, 2 * j->wall_count * sizeof *j->points);
    j->point_count =
        unique(j->points, corners + 2 * j->wall_count, sizeof *j->points, compare_points);
    return true;
}

static void take_directions(job *j) {
    size_t n = j->point_count;
    j->directions = must(calloc(n * (n - 1) / 2 + 1, sizeof *j->directions));
    for (size_t i = 0; i < n; i++) {
        for (size_t k = i + 1; k < n; k++) {
            grid_point d = {j->points[k].x - j->points[i].x, j->points[k].y - j->points[i].y};
            if (d.x == 0) d.y = -1; // sorted: straight up, which is straight down
            j->directions[j->direction_count++] = d;
        }
    }
    j->direction_count =
        unique(j->directions, j->direction_count, sizeof *j->directions, compare_directions);
}

/// Where the line from side `from` of p to side `to` of q is met, along direction u.
static place meet(grid_point u, grid_point p, int64_t from, grid_point q, int64_t to) {
    place at = {dot(u, p) * to - dot(u, q) * from, to - from};
    if (at.den < 0) {
        at.num = -at.num;
        at.den = -at.den;
    }
    return at;
}

/// The piece of the line inside a cell; false where there is none.
static bool chord(const job *j, const sl_cell *cell, grid_point u, int64_t offset, place piece[2]) {
    size_t found = 0;
    for (uint32_t i = 0; i < cell->vertex_count && found < 2; i++) {
        grid_point p = j->corners[cell->first_vertex + i];
        grid_point q = j->corners[cell->first_vertex + (i + 1) % cell->vertex_count];
        int64_t from = 2 * cross(u, p) - offset, to = 2 * cross(u, q) - offset;
        if ((from < 0) != (to < 0)) piece[found++] = meet(u, p, from, q, to);
    }
    if (found == 2 && compare_places(&piece[0], &piece[1]) > 0) {
        place swap = piece[0];
        piece[0] = piece[1];
        piece[1] = swap;
    }
    return found == 2;
}

/// Follows the line of points P with 2 cross(u, P) = offset. False where a wall cuts a cell.
static bool follow(job *j, grid_point u, int64_t offset) {
    size_t hit_count = 0, cell_count = 0, n = j->space->cell_count;
    for (size_t i = 0; i < j->wall_count; i++) {
        grid_point p = j->wall_ends[2 * i], q = j->wall_ends[2 * i + 1];
        int64_t from = 2 * cross(u, p) - offset, to = 2 * cross(u, q) - offset;
        if ((from < 0) != (to < 0)) j->hits[hit_count++] = meet(u, p, from, q, to);
    }
    qsort(j->hits, hit_count, sizeof *j->hits, compare_places);
    for (uint32_t c = 0; c < n; c++) {
        place piece[2];
        if (!chord(j, &j->space->cells[c], u, offset, piece)) continue;
        uint32_t gap = 0;
        while (gap < hit_count && compare_places(&j->hits[gap], &piece[0]) <= 0) gap++;
        if (gap < hit_count && compare_places(&j->hits[gap], &piece[1]) < 0) return false;
        j->crossed[cell_count] = c;
        j->gaps[cell_count++] = gap;
    }
    for (size_t i = 0; i < cell_count; i++) {
        for (size_t k = 0; k < cell_count; k++) {
            if (j->gaps[i] == j->gaps[k]) j->open[j->crossed[i] * n + j->crossed[k]] = true;
        }
    }
    return true;
}

static bool follow_all(job *j) {
    bool sound = true;
    for (size_t i = 0; sound && i < j->direction_count; i++) {
        // The sum of two neighbours lies between them; behind the last comes the first, reversed.
        grid_point u = j->directions[i];
        bool last = i + 1 == j->direction_count;
        grid_point v = j->directions[last ? 0 : i + 1];
        u = (grid_point){last ? u.x - v.x : u.x + v.x, last ? u.y - v.y : u.y + v.y};
        for (size_t k = 0; k < j->point_count; k++) j->sweep[k] = cross(u, j->points[k]);
        qsort(j->sweep, j->point_count, sizeof *j->sweep, compare_numbers);
        for (size_t k = 0; sound && k + 1 < j->point_count; k++) {
            sound = follow(j, u, j->sweep[k] + j->sweep[k + 1]);
        }
    }
    return sound;
}

bool oracle_by_lines(const sl_space *space, const sl_wall *walls, size_t wall_count, bool *open,
                     const char **reason) {
    size_t points = space->vertex_count + 2 * wall_count;
    job j = {.space = space, .wall_count = wall_count, .open = open};
    j.corners = must(calloc(space->vertex_count + 1, sizeof *j.corners));
    j.wall_ends = must(calloc(2 * wall_count + 1, sizeof *j.wall_ends));
    j.points = must(calloc(points + 1, sizeof *j.points));
    j.sweep = must(calloc(points + 1, sizeof *j.sweep));
    j.hits = must(calloc(wall_count + 1, sizeof *j.hits));
    j.crossed = must(calloc(space->cell_count + 1, sizeof *j.crossed));
    j.gaps = must(calloc(space->cell_count + 1, sizeof *j.gaps));
    *reason = "";
    bool done = take_points(&j, walls);
    if (done) {
        take_directions(&j);
        done = follow_all(&j);
        if (!done) *reason = "a wall passes through a cell";
    } else {
        *reason = "coordinates are no small multiples of one power of two";
    }
    free(j.corners);
    free(j.wall_ends);
    free(j.points);
    free(j.directions);
    free(j.sweep);
    free(j.hits);
    free(j.crossed);
    free(j.gaps);
    return done;
}
