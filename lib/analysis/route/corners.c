/// Corners to turn around, parts that are joined, and cells at a point.
///
/// A corner is what ways turn around: the end of a wall, as it is met from one side. Where several
/// walls meet in a point, they part what is around it, and each part has a corner of its own:
///
///       A | B        the portals (dots) around the point are joined cell by cell: those of A and
///     ....+....      C in one row, those of B and D in another one. No way leads from one row to
///       C | D        the other here.
///
/// A door that is passed at a loss parts what is around its ends, as a wall does: its two sides
/// are reached at different costs, so they have corners of their own.
///
/// A row that closes to a ring has no wall at its point: there is nothing to turn around. So a row
/// of n portals may be a corner if they are joined n - 1 times. It is none if its cells take half a
/// turn or less together, as in the corner of a room: no shortest way turns there.
#include "analysis/route/route.h"

#include "geometry/length.h"
#include "geometry/orient.h"

#include <string.h>

/// The lower number stands for both.
static void join(uint32_t *parents, uint32_t a, uint32_t b) {
    a = sl_root_of(parents, a);
    b = sl_root_of(parents, b);
    if (a < b)
        parents[b] = a;
    else
        parents[a] = b;
}

/// The number of a portal's end among all ends: on the side of the cell that the directed portal
/// leaves, or on the side beyond it.
static uint32_t end_of(const sl_route_finder *f, const sl_directed_portal *d, int side,
                       bool beyond) {
    const sl_portal *portal = &f->space->portals[d->portal];
    const sl_point at = side == SLI_ROUTE_LEFT ? d->left : d->right;
    const uint32_t end = 2 * d->portal + !sli_same_point(at, portal->left);
    const bool second = !sli_same_point(d->left, portal->left);
    return sli_route_loss(f, d->portal) > 0 && second != beyond ? end + 2 * f->space->portal_count
                                                                : end;
}

static uint32_t end_count(const sl_route_finder *f) {
    return (f->losses ? 4 : 2) * f->space->portal_count;
}

/// Whether two portals of a cell, one after the other, meet in a point.
static bool meet(const sl_directed_portal *d, const sl_directed_portal *next) {
    return d != next && sli_same_point(d->left, next->right);
}

static void join_ends(sl_route_finder *f) {
    const sl_space *s = f->space;
    for (uint32_t i = 0; i < end_count(f); i++) f->ends[i] = i;
    for (uint32_t c = 0; c < s->cell_count; c++) {
        const sl_directed_portal *first = s->directed + s->cells[c].first_directed;
        const uint32_t count = s->cells[c].directed_count;
        for (uint32_t i = 0; i < count; i++) {
            const sl_directed_portal *next = &first[i + 1 < count ? i + 1 : 0];
            join(f->part_of, c, first[i].cell);
            if (meet(&first[i], next))
                join(f->ends, end_of(f, &first[i], SLI_ROUTE_LEFT, false),
                     end_of(f, next, SLI_ROUTE_RIGHT, false));
        }
    }
}

/// counts[e]: for the end that stands for a row, the portals of the row less how often they are
/// joined. One-way glass is in one cell only; a row with it is never taken for a ring.
static void count_rows(sl_route_finder *f) {
    const sl_space *s = f->space;
    memset(f->counts, 0, end_count(f) * sizeof *f->counts);
    for (uint32_t e = 0; e < end_count(f); e++) f->counts[sl_root_of(f->ends, e)]++;
    for (uint32_t c = 0; c < s->cell_count; c++) {
        const sl_directed_portal *first = s->directed + s->cells[c].first_directed;
        const uint32_t count = s->cells[c].directed_count;
        for (uint32_t i = 0; i < count; i++)
            if (meet(&first[i], &first[i + 1 < count ? i + 1 : 0]))
                f->counts[sl_root_of(f->ends, end_of(f, &first[i], SLI_ROUTE_LEFT, false))]--;
    }
}

static bool is_on(sl_point a, sl_point b, sl_point p) {
    return p.x >= sli_lesser(a.x, b.x) && p.x <= sli_greater(a.x, b.x) &&
           p.y >= sli_lesser(a.y, b.y) && p.y <= sli_greater(a.y, b.y) && sli_orient(a, b, p) == 0;
}

/// The corner of a cell that its boundary leads to from one end of a directed portal, away from the
/// portal.
static sl_point corner_after(const sl_space *s, const sl_cell *cell, const sl_directed_portal *d,
                             int side) {
    const sl_point *corners = s->vertices + cell->first_vertex;
    const uint32_t n = cell->vertex_count;
    for (uint32_t k = 0; k < n; k++) {
        const sl_point a = corners[k], b = corners[(k + 1) % n];
        if (!is_on(a, b, d->right) || !is_on(a, b, d->left)) continue;
        if (side == SLI_ROUTE_LEFT) return sli_same_point(d->left, b) ? corners[(k + 2) % n] : b;
        return sli_same_point(d->right, a) ? corners[(k + n - 1) % n] : a;
    }
    return (sl_point){NAN, NAN};
}

/// The cells of a row, counter-clockwise: they take more than half a turn if one of the portals, or
/// the wall behind the last one, lies that far from the wall before the first one.
typedef struct row_span {
    sl_point wall; ///< the other end of that wall; NAN: it is not known
    bool is_wide;
} row_span;

static bool is_over_half(sl_point at, sl_point wall, sl_point p) {
    const int turn = sli_orient(at, wall, p);
    return turn ? turn < 0 : is_on(at, wall, p) || is_on(at, p, wall);
}

/// Looks at the ends of a cell's portals, for the walls before their rows or for what is behind.
static void span_rows(const sl_route_finder *f, const sl_cell *cell, bool find_walls,
                      row_span *spans) {
    const sl_directed_portal *first = f->space->directed + cell->first_directed;
    const uint32_t n = cell->directed_count;
    for (uint32_t i = 0; i < n; i++)
        for (int side = 0; side < 2; side++) {
            const sl_directed_portal *d = &first[i];
            const bool is_left = side == SLI_ROUTE_LEFT;
            const bool at_wall =
                is_left ? !meet(d, &first[(i + 1) % n]) : !meet(&first[(i + n - 1) % n], d);
            const sl_point at = is_left ? d->left : d->right, far = is_left ? d->right : d->left;
            row_span *span = &spans[sl_root_of(f->ends, end_of(f, d, side, false))];
            if (find_walls && is_left && at_wall)
                span->wall = corner_after(f->space, cell, d, side);
            if (find_walls) continue;
            span->is_wide |= isnan(span->wall.x) || sli_route_loss(f, d->portal) > 0 ||
                             is_over_half(at, span->wall, far);
            if (!is_left && at_wall && !span->is_wide) {
                const sl_point last = corner_after(f->space, cell, d, side);
                span->is_wide = isnan(last.x) || is_over_half(at, span->wall, last);
            }
        }
}

/// counts[e] becomes 0 for rows of half a turn or less. One-way glass is in one cell only, so what
/// is on both sides of it is not known here.
static sl_status drop_flat_rows(sl_context *context, sl_route_finder *f) {
    if (f->has_glass) return SL_OK;
    row_span *spans = sl_alloc_array(context, end_count(f), sizeof *spans);
    if (!spans) return SL_NO_MEMORY;
    for (uint32_t e = 0; e < end_count(f); e++) spans[e].wall = (sl_point){NAN, NAN};
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t c = 0; c < f->space->cell_count; c++)
            span_rows(f, &f->space->cells[c], pass == 0, spans);
    for (uint32_t e = 0; e < end_count(f); e++)
        if (!spans[e].is_wide) f->counts[e] = 0;
    sl_free(context, spans);
    return SL_OK;
}

sl_status sli_route_corners(sl_context *context, sl_route_finder *f) {
    const sl_space *s = f->space;
    for (uint32_t c = 0; c < s->cell_count; c++) f->part_of[c] = c;
    join_ends(f);
    count_rows(f);
    SL_TRY(drop_flat_rows(context, f));
    for (uint32_t c = 0; c < s->cell_count; c++) {
        f->part_of[c] = sl_root_of(f->part_of, c);
        const sl_cell *cell = &s->cells[c];
        for (uint32_t d = cell->first_directed; d < cell->first_directed + cell->directed_count;
             d++)
            for (int side = 0; side < 2; side++) {
                const uint32_t row = sl_root_of(f->ends, end_of(f, &s->directed[d], side, true));
                f->corner_of[2 * (size_t)d + (size_t)side] = f->counts[row] ? row : SLI_ROUTE_NONE;
            }
    }
    return SL_OK;
}

uint32_t sli_route_stand(sl_route_finder *f, sl_point point, uint32_t first, uint32_t *marks) {
    const sl_space *s = f->space;
    uint32_t count = 0;
    marks[first] = f->stamp;
    f->list[count++] = first;
    for (uint32_t i = 0; i < count; i++) {
        const sl_cell *cell = &s->cells[f->list[i]];
        for (uint32_t k = 0; k < cell->directed_count; k++) {
            const sl_directed_portal *d = &s->directed[cell->first_directed + k];
            if (marks[d->cell] == f->stamp || sli_route_loss(f, d->portal) > 0 ||
                !is_on(d->left, d->right, point))
                continue;
            marks[d->cell] = f->stamp;
            f->list[count++] = d->cell;
        }
    }
    return count;
}

sl_point sli_route_nearest(sl_route_finder *f, sl_point to) {
    const sl_space *s = f->space;
    uint32_t count = 0, best_cell = 0;
    sl_point best = {0};
    double least = INFINITY;
    for (uint32_t c = 0; c < s->cell_count; c++)
        if (f->at_start[c] == f->stamp) f->list[count++] = c;
    for (uint32_t i = 0; i < count; i++) {
        const sl_cell *cell = &s->cells[f->list[i]];
        const sl_point *corners = s->vertices + cell->first_vertex;
        for (uint32_t k = 0; k < cell->vertex_count; k++) {
            const sl_point at =
                sli_nearest_on(corners[k], corners[k + 1 < cell->vertex_count ? k + 1 : 0], to);
            const double away = sli_length(at.x - to.x, at.y - to.y);
            if (!(away < least)) continue;
            least = away;
            best = at;
            best_cell = f->list[i];
        }
        for (uint32_t k = 0; k < cell->directed_count; k++) {
            const uint32_t next = s->directed[cell->first_directed + k].cell;
            if (f->at_start[next] == f->stamp) continue;
            f->at_start[next] = f->stamp;
            f->list[count++] = next;
        }
    }
    const sl_point middle = sl_space_middle(s, best_cell);
    const sl_point in = {best.x + (middle.x - best.x) / 1000, best.y + (middle.y - best.y) / 1000};
    const uint32_t found = sl_space_locate(s, in);
    return found != SL_NO_CELL && f->at_start[found] == f->stamp ? in : middle;
}
