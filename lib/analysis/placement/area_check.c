/// What chosen places leave unseen: their shapes are laid over the area, and each piece that too
/// few of them cover is looked at.
///
/// 1. Places that are not chosen see the middle of the piece, or points near its corners: that
/// which
///    the fewest see is a new witness.
/// 2. If there was none in any piece: a place whose shape has a part of the piece gives a witness
/// in
///    that part. The shape is cut to the piece, which is convex.
/// 3. If there was none again, nobody else sees anything of what is left: it is blind.
#include "analysis/placement/blind_spots.h"
#include "analysis/placement/place_area.h"
#include "space/index.h"

#include <math.h>
#include <stdlib.h>

/// Witnesses added at once, at most; more where more than UNSEEN_PER_WITNESS times as many pieces
/// are unseen.
enum { WITNESSES_MOST = 300, UNSEEN_PER_WITNESS = 2 };
/// How far a witness is from a corner of its piece, as a share of the way to the middle.
#define CORNER_STEP 0x1p-6
/// Pieces up to this wide, on average, are rounding: a share of the largest coordinate, some times
/// that of an overlay.
#define THIN 0x1p-44

typedef struct unseen {
    uint32_t piece;
    double area;
} unseen;

typedef struct checker {
    sli_area *a;
    const uint8_t *chosen;
    sl_overlay overlay;
    bool *blind; ///< by piece
    SL_ARRAY(unseen) unseen;
    SL_ARRAY(sl_point) cut, spare; ///< scratch
    uint32_t added;
} checker;

static sl_status lay(checker *c) {
    sli_area *a = c->a;
    sl_shape *shapes = sl_alloc_array(a->context, (size_t)a->task->place_count + 1, sizeof *shapes);
    if (!shapes) return SL_NO_MEMORY;
    size_t count = 0;
    shapes[count++] = sli_view_shape(&a->shapes, 0);
    for (uint32_t i = 0; i < a->task->place_count; i++)
        if (c->chosen[i]) shapes[count++] = sli_view_shape(&a->shapes, i + 1);
    const sl_status status = sl_overlay_make(a->context, &a->target, shapes, count, &c->overlay);
    sl_free(a->context, shapes);
    return status;
}

static int compare_unseen(const void *left, const void *right) {
    const unseen *a = left, *b = right;
    if (a->area != b->area) return a->area > b->area ? -1 : 1;
    return a->piece < b->piece ? -1 : 1;
}

static const sl_point *corners_of(const sl_overlay *overlay, uint32_t piece, uint32_t *count) {
    const sl_cell *cell = &overlay->pieces.cells[piece];
    *count = cell->vertex_count;
    return &overlay->pieces.vertices[cell->first_vertex];
}

/// The area up to which a piece is rounding.
static double rounding_of(const sl_overlay *overlay, uint32_t piece) {
    const sl_box box = sli_box_of_cell(&overlay->pieces, piece), *all = &overlay->pieces.bounds;
    const double largest =
        fmax(fmax(fabs(all->min.x), fabs(all->max.x)), fmax(fabs(all->min.y), fabs(all->max.y)));
    return THIN * largest * (box.max.x - box.min.x + box.max.y - box.min.y);
}

/// Whether fewer than `cover` shapes cover a piece of the area.
static bool is_uncovered(const sl_overlay *overlay, uint32_t piece, uint32_t cover) {
    return overlay->pieces.cells[piece].inside && overlay->counts[piece] < cover;
}

bool sli_area_is_covered(const sl_overlay *overlay) {
    for (uint32_t i = 0; i < overlay->pieces.cell_count; i++)
        if (is_uncovered(overlay, i, 1) &&
            sl_space_area(&overlay->pieces, i) > rounding_of(overlay, i))
            return false;
    return true;
}

/// The pieces that too few places cover, the largest first, but for those that are rounding.
static sl_status list_unseen(checker *c) {
    const sl_space *pieces = &c->overlay.pieces;
    double rounding = 0;
    for (uint32_t i = 0; i < pieces->cell_count; i++) {
        if (!is_uncovered(&c->overlay, i, c->a->cover)) continue;
        const double area = sl_space_area(pieces, i);
        if (area <= rounding_of(&c->overlay, i)) {
            rounding += area;
            continue;
        }
        SL_TRY(SL_ARRAY_ROOM(c->a->context, &c->unseen, 1));
        c->unseen.items[c->unseen.count++] = (unseen){i, area};
    }
    if (c->unseen.count)
        qsort(c->unseen.items, c->unseen.count, sizeof *c->unseen.items, compare_unseen);
    c->a->out->rounding = rounding;
    return SL_OK;
}

/// A point of a piece: the middle, then close to each corner.
static sl_point point_in(const checker *c, uint32_t piece, uint32_t number) {
    uint32_t count;
    const sl_point *corners = corners_of(&c->overlay, piece, &count);
    const sl_point middle = sli_piece_middle(&c->overlay.pieces, piece);
    if (!number) return middle;
    const sl_point corner = corners[number - 1];
    return (sl_point){corner.x + CORNER_STEP * (middle.x - corner.x),
                      corner.y + CORNER_STEP * (middle.y - corner.y)};
}

/// Whether a->row is that of a witness: others than the chosen places could see it. `sure`: not if
/// it is between the chords and the arc of a range.
static bool is_witness(const checker *c, bool sure) {
    for (size_t i = 0; sure && i < c->a->row.count; i++)
        if (c->a->row.items[i] & SLI_WIDE) return false;
    return sli_area_asks(c->a, c->chosen);
}

static bool is_enough(const checker *c) {
    return c->added >= WITNESSES_MOST && c->added >= c->unseen.count / UNSEEN_PER_WITNESS;
}

static sl_status add_witness(checker *c, sl_point at) {
    c->added++;
    return sli_area_add_row(c->a, at);
}

/// Adds that point of a piece which the fewest places see.
static sl_status try_piece(checker *c, uint32_t piece) {
    const uint32_t points = c->overlay.pieces.cells[piece].vertex_count + 1;
    uint32_t best = UINT32_MAX;
    size_t fewest = SIZE_MAX;
    for (uint32_t k = 0; k < 2 * points; k++) {
        if (k == points && best != UINT32_MAX) break;
        SL_TRY(sli_area_look(c->a, point_in(c, piece, k % points)));
        if (c->a->row.count >= fewest || !is_witness(c, k < points)) continue;
        fewest = c->a->row.count;
        best = k % points;
    }
    if (best == UINT32_MAX) return SL_OK;
    const sl_point at = point_in(c, piece, best);
    SL_TRY(sli_area_look(c->a, at));
    return add_witness(c, at);
}

static sl_status try_pieces(checker *c) {
    for (size_t i = 0; i < c->unseen.count && !is_enough(c); i++) {
        SL_TRY(sl_check_cancelled(c->a->context));
        SL_TRY(try_piece(c, c->unseen.items[i].piece));
    }
    return SL_OK;
}

// --- others that see a part of a piece

/// Cuts the loop in c->cut to the left side of a line; the same of a loop that crosses itself.
static sl_status cut_by(checker *c, sl_point from, sl_point to) {
    const size_t count = c->cut.count;
    c->spare.count = 0;
    SL_TRY(SL_ARRAY_ROOM(c->a->context, &c->spare, 2 * count));
    const sl_point way = {to.x - from.x, to.y - from.y};
    for (size_t i = 0; i < count; i++) {
        const sl_point p = c->cut.items[i], q = c->cut.items[i + 1 < count ? i + 1 : 0];
        const double s = way.x * (p.y - from.y) - way.y * (p.x - from.x);
        const double t = way.x * (q.y - from.y) - way.y * (q.x - from.x);
        if (s >= 0) c->spare.items[c->spare.count++] = p;
        if ((s >= 0) == (t >= 0)) continue;
        const double share = s / (s - t);
        c->spare.items[c->spare.count++] =
            (sl_point){p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)};
    }
    c->cut.count = 0;
    SL_TRY(SL_ARRAY_ROOM(c->a->context, &c->cut, c->spare.count));
    for (size_t i = 0; i < c->spare.count; i++) c->cut.items[c->cut.count++] = c->spare.items[i];
    return SL_OK;
}

/// The area that a shape and a piece have in common, rounded.
static sl_status common_area(checker *c, const sl_shape *shape, uint32_t piece, double *area) {
    uint32_t count;
    const sl_point *corners = corners_of(&c->overlay, piece, &count);
    size_t first = 0;
    *area = 0;
    for (size_t l = 0; l < shape->count; first = shape->ends[l++]) {
        c->cut.count = 0;
        SL_TRY(SL_ARRAY_ROOM(c->a->context, &c->cut, shape->ends[l] - first));
        for (size_t i = first; i < shape->ends[l]; i++)
            c->cut.items[c->cut.count++] = shape->points[i];
        for (uint32_t i = 0; i < count && c->cut.count; i++)
            SL_TRY(cut_by(c, corners[i], corners[i + 1 < count ? i + 1 : 0]));
        for (size_t i = 1; i + 1 < c->cut.count; i++) {
            const sl_point o = c->cut.items[0], p = c->cut.items[i], q = c->cut.items[i + 1];
            *area += ((p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x)) / 2;
        }
    }
    return SL_OK;
}

/// Tries the largest piece of what a shape and a piece have in common.
static sl_status try_common(checker *c, const sl_shape *shape, uint32_t piece, bool *added) {
    uint32_t count;
    sl_shape within = {.count = 1};
    within.points = corners_of(&c->overlay, piece, &count);
    const size_t end = count;
    within.ends = &end;
    sl_overlay common = {0};
    SL_TRY(sl_overlay_make(c->a->context, &within, shape, 1, &common));
    double largest = 0;
    uint32_t best = UINT32_MAX;
    for (uint32_t i = 0; i < common.pieces.cell_count; i++) {
        if (!common.pieces.cells[i].inside || !common.counts[i]) continue;
        const double area = sl_space_area(&common.pieces, i);
        if (area > largest) {
            largest = area;
            best = i;
        }
    }
    sl_status status = SL_OK;
    if (best != UINT32_MAX) {
        const sl_point at = sli_piece_middle(&common.pieces, best);
        status = sli_area_look(c->a, at);
        *added = status == SL_OK && is_witness(c, false);
        if (*added) status = add_witness(c, at);
    }
    sl_overlay_destroy(c->a->context, &common);
    return status;
}

static bool boxes_meet(const sl_box *a, const sl_box *b) {
    return a->min.x < b->max.x && b->min.x < a->max.x && a->min.y < b->max.y && b->min.y < a->max.y;
}

/// Looks for a place that sees a part of a piece.
static sl_status search_piece(checker *c, uint32_t piece) {
    const sl_box box = sli_box_of_cell(&c->overlay.pieces, piece);
    bool added = false;
    for (uint32_t i = 0; i < c->a->task->place_count && !added; i++) {
        if (c->chosen[i] || !boxes_meet(&box, &c->a->boxes[i])) continue;
        const sl_shape shape = sli_view_shape(&c->a->shapes, i + 1);
        double area;
        SL_TRY(common_area(c, &shape, piece, &area));
        if (area > rounding_of(&c->overlay, piece)) SL_TRY(try_common(c, &shape, piece, &added));
    }
    return SL_OK;
}

static sl_status search_pieces(checker *c) {
    for (size_t i = 0; i < c->unseen.count && !is_enough(c); i++) {
        SL_TRY(sl_check_cancelled(c->a->context));
        SL_TRY(search_piece(c, c->unseen.items[i].piece));
    }
    return SL_OK;
}

/// What is seen, and what is blind.
static sl_status conclude(checker *c) {
    sli_area *a = c->a;
    uint32_t *spots = NULL;
    sl_area_placement *out = a->out;
    sl_free(a->context, out->blind);
    out->blind = NULL;
    out->blind_count = 0;
    out->blind_area = 0;
    c->blind = sl_alloc_array(a->context, (size_t)c->overlay.pieces.cell_count + 1, sizeof(bool));
    if (!c->blind) return SL_NO_MEMORY;
    for (size_t i = 0; i < c->unseen.count; i++) c->blind[c->unseen.items[i].piece] = true;
    for (size_t i = 0; i < c->unseen.count; i++) out->blind_area += c->unseen.items[i].area;
    const sl_status status = sli_blind_spots_find(a->context, &c->overlay, c->blind, 0, &spots,
                                                  &out->blind, &out->blind_count);
    sl_free(a->context, spots);
    out->seen = out->area - out->blind_area;
    return status;
}

sl_status sli_area_check(sli_area *a, const uint8_t *chosen, uint32_t *added) {
    *added = 0;
    // All pieces of walls and lines are rows.
    if (sli_area_scans(a) || sli_area_has_only_lines(a)) return SL_OK;
    checker c = {.a = a, .chosen = chosen};
    sl_status status = lay(&c);
    if (status == SL_OK) status = list_unseen(&c);
    if (status == SL_OK) status = try_pieces(&c);
    if (status == SL_OK && !c.added) status = search_pieces(&c);
    if (status == SL_OK && !c.added) status = conclude(&c);
    *added = c.added;
    sl_overlay_destroy(a->context, &c.overlay);
    sl_free(a->context, c.blind);
    sl_free(a->context, c.unseen.items);
    sl_free(a->context, c.cut.items);
    sl_free(a->context, c.spare.items);
    return status;
}
