/// Blind spots: the pieces of an overlay that are blind, joined across portals and outlines, but
/// not across walls.
#include "analysis/placement/blind_spots.h"

#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

/// The number of the shape of walls.
#define WALLS 0

/// A spot and its number before the spots are sorted.
typedef struct numbered {
    sl_blind_spot spot;
    uint32_t number;
} numbered;

typedef struct joiner {
    sl_context *context;
    const sl_overlay *overlay;
    const bool *blind; ///< by piece
    uint32_t *parent, *spots;
    double *largest; ///< by root: the area of its largest piece
    SL_ARRAY(numbered) found;
} joiner;

sl_point sli_piece_middle(const sl_space *pieces, uint32_t piece) {
    const sl_cell *cell = &pieces->cells[piece];
    sl_point sum = {0, 0};
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        sum.x += pieces->vertices[cell->first_vertex + i].x / cell->vertex_count;
        sum.y += pieces->vertices[cell->first_vertex + i].y / cell->vertex_count;
    }
    return sum;
}

static void add_piece(const sl_space *pieces, uint32_t piece, double *largest,
                      sl_blind_spot *spot) {
    const sl_cell *cell = &pieces->cells[piece];
    const double area = sl_space_area(pieces, piece);
    spot->area += area;
    if (area > *largest) {
        *largest = area;
        spot->at = sli_piece_middle(pieces, piece);
    }
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point at = pieces->vertices[cell->first_vertex + i];
        sl_box *const b = &spot->bounds;
        b->min = (sl_point){fmin(b->min.x, at.x), fmin(b->min.y, at.y)};
        b->max = (sl_point){fmax(b->max.x, at.x), fmax(b->max.y, at.y)};
    }
}

/// Joins two pieces, to the one of the smaller number.
static void join(const joiner *j, uint32_t a, uint32_t b) {
    if (!j->blind[a] || !j->blind[b]) return;
    a = sl_root_of(j->parent, a);
    b = sl_root_of(j->parent, b);
    j->parent[a > b ? a : b] = a > b ? b : a;
}

/// Joins the blind pieces on both sides of portals, and of outlines that no wall is on. `left`, by
/// wall, is scratch.
static void join_pieces(const joiner *j, uint32_t *left) {
    const sl_space *pieces = &j->overlay->pieces;
    for (uint32_t w = 0; w < pieces->wall_count; w++) left[w] = UINT32_MAX;
    for (uint32_t c = 0; c < pieces->cell_count; c++) j->parent[c] = c;
    for (uint32_t c = 0; c < pieces->cell_count; c++) {
        const sl_cell *cell = &pieces->cells[c];
        for (uint32_t i = 0; i < cell->directed_count; i++)
            join(j, c, pieces->directed[cell->first_directed + i].cell);
        for (uint32_t i = 0; i < cell->vertex_count; i++) {
            const uint32_t side = pieces->neighbour[cell->first_vertex + i];
            if (side >= SL_NEIGHBOUR_BORDER) continue;
            const uint32_t wall = side & ~SL_NEIGHBOUR_RIGHT;
            if (pieces->walls[wall].line == WALLS) continue;
            if (left[wall] != UINT32_MAX) join(j, c, left[wall]);
            left[wall] = c; // the first of its two sides that is met
        }
    }
}

static int compare_spots(const void *left, const void *right) {
    const numbered *a = left, *b = right;
    if (a->spot.area != b->spot.area) return a->spot.area > b->spot.area ? -1 : 1;
    return a->number < b->number ? -1 : 1;
}

/// Sorts spots by size, and leaves out those that are rounding.
static sl_status sort_spots(joiner *j, double negligible, sl_blind_spot *out, uint32_t *count) {
    uint32_t *place = sl_alloc_array(j->context, j->found.count + 1, sizeof *place);
    if (!place) return SL_NO_MEMORY;
    if (j->found.count)
        qsort(j->found.items, j->found.count, sizeof *j->found.items, compare_spots);
    *count = 0;
    for (size_t i = 0; i < j->found.count; i++) {
        const bool counts = j->found.items[i].spot.area > negligible;
        place[j->found.items[i].number] = counts ? *count : UINT32_MAX;
        if (counts) out[(*count)++] = j->found.items[i].spot;
    }
    for (uint32_t c = 0; c < j->overlay->pieces.cell_count; c++)
        if (j->spots[c] != UINT32_MAX) j->spots[c] = place[j->spots[c]];
    sl_free(j->context, place);
    return SL_OK;
}

/// Sums the pieces up, by their roots; spots[] has the number of each one's spot.
static sl_status gather(joiner *j) {
    const sl_space *pieces = &j->overlay->pieces;
    for (uint32_t c = 0; c < pieces->cell_count; c++) {
        j->spots[c] = UINT32_MAX;
        if (!j->blind[c]) continue;
        const uint32_t root = sl_root_of(j->parent, c);
        if (root == c) {
            SL_TRY(SL_ARRAY_ROOM(j->context, &j->found, 1));
            const uint32_t number = (uint32_t)j->found.count;
            j->found.items[j->found.count++] =
                (numbered){{.bounds = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}}}, number};
            j->spots[c] = number;
        }
        j->spots[c] = j->spots[root]; // the root has the smallest number
        add_piece(pieces, c, &j->largest[root], &j->found.items[j->spots[c]].spot);
    }
    return SL_OK;
}

sl_status sli_blind_spots_find(sl_context *context, const sl_overlay *overlay, const bool *blind,
                               double negligible, uint32_t **spots, sl_blind_spot **found,
                               uint32_t *count) {
    const size_t pieces = (size_t)overlay->pieces.cell_count + 1;
    joiner j = {.context = context, .overlay = overlay, .blind = blind};
    uint32_t *left = sl_alloc_array(context, (size_t)overlay->pieces.wall_count + 1, sizeof *left);
    j.parent = sl_alloc_array(context, pieces, sizeof *j.parent);
    j.largest = sl_alloc_array(context, pieces, sizeof *j.largest);
    j.spots = *spots = sl_alloc_array(context, pieces, sizeof *j.spots);
    sl_status status = left && j.parent && j.largest && j.spots ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        join_pieces(&j, left);
        status = gather(&j);
    }
    if (status == SL_OK) {
        *found = sl_alloc_array(context, j.found.count + 1, sizeof **found);
        status = *found ? sort_spots(&j, negligible, *found, count) : SL_NO_MEMORY;
    }
    sl_free(context, left);
    sl_free(context, j.parent);
    sl_free(context, j.largest);
    sl_free(context, j.found.items);
    return status;
}
