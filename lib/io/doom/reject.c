/// Doom's REJECT from visible sets of cells, in two steps. First, the sectors that each cell
/// reaches into. A line through the cell says the sectors at both its sides, a line along its
/// border one of them, and the nearest line to the right of its middle the sector around the
/// middle. Second, the pairs of sectors: a pair is hidden where no cell of the one sees a cell of
/// the other.
///
/// Nothing that is seen may be hidden. So a cell counts for every sector that it reaches into, and
/// a sector of which nothing is known sees everything. Sides are decided by exact predicates.
#include "base/base.h"
#include "io/doom/wad.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/support.h"
#include "space/index.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the sectors of a cell

/// What is looked at for one cell.
typedef struct cell_view {
    const sl_point *corners;
    uint32_t count;
    sl_box box;
    sl_point middle;
} cell_view;

typedef struct finder {
    sl_context *context;
    const sli_doom_level *level;
    sl_box all;               ///< around all lines
    double reach;             ///< how far a ray goes at first
    sli_box_tree tree;        ///< of the lines
    sli_box_list nearby;      ///< lines, of the current question
    SL_ARRAY(uint32_t) found; ///< of all cells so far
    size_t begin;             ///< of the current cell
} finder;

static cell_view view_of(const sl_space *space, uint32_t cell) {
    cell_view view = {.corners = space->vertices + space->cells[cell].first_vertex,
                      .count = space->cells[cell].vertex_count};
    view.box = (sl_box){view.corners[0], view.corners[0]};
    for (uint32_t i = 0; i < view.count; i++) {
        const sl_point corner = view.corners[i];
        view.box = sli_box_with(view.box, corner);
        view.middle.x += corner.x / view.count;
        view.middle.y += corner.y / view.count;
    }
    return view;
}

static sl_status add_sector(finder *find, uint32_t sector) {
    if (sector == SLI_NO_SECTOR) return SL_OK;
    for (size_t i = find->begin; i < find->found.count; i++)
        if (find->found.items[i] == sector) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(find->context, &find->found, 1));
    find->found.items[find->found.count++] = sector;
    return SL_OK;
}

/// Whether an edge of the cell, to the left of which the cell lies, has all of the line at its
/// right or on it: then the line does not pass through the interior.
static bool is_parted_by_an_edge(const cell_view *view, const sli_doom_line *line) {
    for (uint32_t i = 0; i < view->count; i++) {
        const sl_point a = view->corners[i], b = view->corners[(i + 1) % view->count];
        if (sli_orient(a, b, line->from) <= 0 && sli_orient(a, b, line->to) <= 0) return true;
    }
    return false;
}

/// Whether the line, which holds both points, has a piece of positive length between them.
static bool overlaps(const sli_doom_line *line, sl_point a, sl_point b) {
    const bool by_x = fabs(line->to.x - line->from.x) >= fabs(line->to.y - line->from.y);
    const double c = by_x ? line->from.x : line->from.y, d = by_x ? line->to.x : line->to.y;
    const double e = by_x ? a.x : a.y, f = by_x ? b.x : b.y;
    return fmin(c, d) < fmax(e, f) && fmin(e, f) < fmax(c, d);
}

/// Adds the sectors that a line says are within the cell.
static sl_status ask_line(finder *find, const cell_view *view, const sli_doom_line *line) {
    bool at_left = false, at_right = false, runs_along = false;
    int before = sli_orient(line->from, line->to, view->corners[view->count - 1]);
    for (uint32_t i = 0; i < view->count; i++) {
        const int side = sli_orient(line->from, line->to, view->corners[i]);
        at_left |= side > 0;
        at_right |= side < 0;
        if (side == 0 && before == 0)
            runs_along |=
                overlaps(line, view->corners[i], view->corners[i ? i - 1 : view->count - 1]);
        before = side;
    }
    const bool passes = at_left && at_right && !is_parted_by_an_edge(view, line);
    if (!passes && !runs_along) return SL_OK;
    if (at_left) SL_TRY(add_sector(find, line->left));
    return at_right ? add_sector(find, line->right) : SL_OK;
}

/// A line to the right of a point, at its height.
typedef struct hit {
    sl_point low, high; ///< its ends
    double x;           ///< where it is met, rounded
    uint32_t sector;    ///< at this side
} hit;

/// Whether a ray at the height of both lines meets one line before the other. Where the two places
/// are too close for rounded numbers, the ends decide: each line has one end at the ray or below
/// it, and one above. Lines that meet in a point are ordered as they are just above it. Of lines
/// that lie on each other, such as walls back to back, the one with a sector at this side comes
/// first.
static bool is_before(const hit *a, const hit *b, double point_x) {
    const double close = 1e-9 * (fabs(a->x) + fabs(point_x));
    if (fabs(a->x - b->x) > close) return a->x < b->x;
    int side = a->low.y >= b->low.y ? sli_orient(b->low, b->high, a->low)
                                    : -sli_orient(a->low, a->high, b->low);
    if (side == 0)
        side = a->high.y <= b->high.y ? sli_orient(b->low, b->high, a->high)
                                      : -sli_orient(a->low, a->high, b->high);
    return side ? side > 0 : b->sector == SLI_NO_SECTOR;
}

/// The line that a ray to the right meets first, of the lines nearby; at HUGE_VAL for none.
static hit meet_first(const finder *find, sl_point point) {
    hit nearest = {.x = HUGE_VAL, .sector = SLI_NO_SECTOR};
    for (size_t i = 0; i < find->nearby.count; i++) {
        const sli_doom_line *line = &find->level->lines[find->nearby.items[i]];
        if (line->moves || (line->from.y <= point.y) == (line->to.y <= point.y)) continue;
        const bool up = line->from.y <= point.y;
        hit met = {up ? line->from : line->to, up ? line->to : line->from, 0,
                   up ? line->left : line->right};
        if (sli_orient(met.low, met.high, point) <= 0) continue;
        const double slope = (met.high.x - met.low.x) / (met.high.y - met.low.y);
        met.x = met.low.x + (point.y - met.low.y) * slope;
        if (nearest.x == HUGE_VAL || is_before(&met, &nearest, point.x)) nearest = met;
    }
    return nearest;
}

/// The sector that the nearest line to the right of a point says that the point is in. Lines within
/// reach are nearby already. Lines out of reach are met beyond it. So a line that is met in the
/// nearer half of the reach is the nearest: no two places are too close there, since a reach is far
/// longer than what is too close.
static sl_status find_left_of_nearest(finder *find, sl_point point, uint32_t *sector) {
    hit nearest = meet_first(find, point);
    for (double reach = find->reach;
         reach > 0 && point.x + reach < find->all.max.x && nearest.x >= point.x + reach / 2;) {
        reach *= 4;
        const sl_box ray = {point, {point.x + reach, point.y}};
        SL_TRY(sli_box_tree_find(find->context, &find->tree, &ray, &find->nearby));
        nearest = meet_first(find, point);
    }
    *sector = nearest.sector;
    return SL_OK;
}

static sl_status find_cell(finder *find, const sl_space *space, uint32_t cell) {
    const cell_view view = view_of(space, cell);
    find->begin = find->found.count;
    sl_box box = view.box; // with the first reach of the ray from the middle
    box.max.x = sli_greater(box.max.x, view.middle.x + find->reach);
    SL_TRY(sli_box_tree_find(find->context, &find->tree, &box, &find->nearby));
    for (size_t i = 0; i < find->nearby.count; i++) {
        const sli_doom_line *line = &find->level->lines[find->nearby.items[i]];
        if (sli_lesser(line->from.x, line->to.x) <= view.box.max.x)
            SL_TRY(ask_line(find, &view, line));
    }
    uint32_t sector;
    SL_TRY(find_left_of_nearest(find, view.middle, &sector));
    SL_TRY(add_sector(find, sector));
    if (find->found.count > UINT32_MAX)
        return sl_fail(find->context, SL_UNSUPPORTED,
                       "more cells with sectors than can be counted");
    const size_t count = find->found.count - find->begin;
    if (count > 1)
        qsort(find->found.items + find->begin, count, sizeof(uint32_t), sli_compare_whole);
    return SL_OK;
}

static sl_status make_tree(finder *find) {
    const sli_doom_level *level = find->level;
    sl_box *boxes = sl_alloc_array(find->context, level->line_count, sizeof *boxes);
    if (!boxes) return SL_NO_MEMORY;
    for (size_t i = 0; i < level->line_count; i++)
        boxes[i] = sli_box_around(level->lines[i].from, level->lines[i].to);
    const sl_status status =
        sli_box_tree_create(find->context, boxes, level->line_count, &find->tree);
    sl_free(find->context, boxes);
    if (status == SL_OK && level->line_count) {
        const sli_box_tree *tree = &find->tree;
        const sl_box all = tree->boxes[tree->first[tree->levels - 1]];
        find->all = all;
        find->reach = (all.max.x - all.min.x) / 64 + 1e-6 * (fabs(all.min.x) + fabs(all.max.x));
    }
    return status;
}

sl_status sli_cell_sectors_find(sl_context *context, const sl_space *space,
                                const sli_doom_level *level, sli_cell_sectors *out) {
    finder find = {.context = context, .level = level};
    uint32_t *first = sl_alloc_array(context, (size_t)space->cell_count + 1, sizeof *first);
    if (!first) return SL_NO_MEMORY;
    sl_status status = make_tree(&find);
    for (uint32_t cell = 0; cell < space->cell_count && status == SL_OK; cell++) {
        if (cell % 256 == 0) sl_report(context, "sectors", "cells", cell, space->cell_count);
        status = sl_check_cancelled(context);
        if (status == SL_OK) status = find_cell(&find, space, cell);
        first[cell + 1] = (uint32_t)find.found.count;
    }
    sli_box_tree_destroy(context, &find.tree);
    sl_free(context, find.nearby.items);
    sli_cell_sectors made = {.first = first, .sectors = find.found.items};
    if (status == SL_OK)
        *out = made;
    else
        sli_cell_sectors_destroy(context, &made);
    return status;
}

void sli_cell_sectors_destroy(sl_context *context, sli_cell_sectors *sectors) {
    sl_free(context, sectors->first);
    sl_free(context, sectors->sectors);
    *sectors = (sli_cell_sectors){0};
}

// --- the table

typedef struct reject_maker {
    sl_context *context;
    const sl_space *space;
    const sl_pvs *pvs;
    sli_cell_sectors cells;
    size_t count;   ///< of sectors
    size_t words;   ///< of a row of sectors
    sl_bits *seen;  ///< a row for each sector
    size_t unknown; ///< sectors that no cell reaches into, or of which a cell was not looked at
} reject_maker;

static sl_bits *row_of(const reject_maker *make, size_t sector) {
    return make->seen + sector * make->words;
}

/// All sectors that cells seen from this one reach into. False if it sees none: then the bake did
/// not look from it.
static bool collect_seen(const reject_maker *make, uint32_t cell, sl_bits *row) {
    const sli_cell_sectors *cells = &make->cells;
    bool looked = false;
    memset(row, 0, make->words * sizeof *row);
    for (sl_pvs_run r = sl_pvs_begin(make->pvs, cell); sl_pvs_next(&r); looked = true)
        for (uint32_t i = cells->first[r.first]; i < cells->first[r.end]; i++)
            sl_bits_add(row, cells->sectors[i]);
    return looked;
}

static void see_all(const reject_maker *make, size_t sector) {
    memset(row_of(make, sector), 0xff, make->words * sizeof(sl_bits));
}

static sl_status spread_rows(reject_maker *make, sl_bits *row, bool *reached) {
    const sli_cell_sectors *cells = &make->cells;
    for (uint32_t cell = 0; cell < make->space->cell_count; cell++) {
        if (cell % 256 == 0) SL_TRY(sl_check_cancelled(make->context));
        if (cells->first[cell] == cells->first[cell + 1]) continue;
        const bool looked = collect_seen(make, cell, row);
        for (uint32_t i = cells->first[cell]; i < cells->first[cell + 1]; i++) {
            const uint32_t sector = cells->sectors[i];
            sl_bits *seen = row_of(make, sector);
            for (size_t w = 0; w < make->words; w++) seen[w] |= row[w];
            reached[sector] |= looked;
            // Nothing is known of what a cell sees that the bake did not look from.
            if (!looked) see_all(make, sector);
        }
    }
    for (size_t i = 0; i < make->count; i++) {
        make->unknown += !reached[i];
        if (!reached[i]) see_all(make, i);
    }
    return SL_OK;
}

static sl_status find_seen(reject_maker *make) {
    const size_t count = make->count;
    make->words = sl_bits_words(count);
    if (count && make->words > SIZE_MAX / 64 / count) return sl_fail_memory(make->context);
    make->seen = sl_alloc_array(make->context, count * make->words, sizeof(sl_bits));
    sl_bits *row = sl_alloc_array(make->context, make->words, sizeof *row);
    bool *reached = sl_alloc_array(make->context, count, sizeof *reached);
    const sl_status status =
        make->seen && row && reached ? spread_rows(make, row, reached) : SL_NO_MEMORY;
    sl_free(make->context, row);
    sl_free(make->context, reached);
    return status;
}

/// The bit of an ordered pair in the lump.
static size_t bit_of(const reject_maker *make, size_t from, size_t to) {
    return from * make->count + to;
}

static void take_bit(unsigned char *bytes, size_t bit) {
    bytes[bit / 8] &= (unsigned char)~(1u << bit % 8);
}

/// Takes a pair from those that are hidden, both ways.
static void show(const reject_maker *make, size_t a, size_t b, sli_reject *out) {
    const size_t bit = bit_of(make, a, b);
    if (!(out->bytes[bit / 8] & 1u << bit % 8)) return;
    take_bit(out->bytes, bit);
    take_bit(out->bytes, bit_of(make, b, a));
    out->account.hidden -= a != b;
}

/// The lump: a bit for each ordered pair, set where it is hidden. Sight goes both ways: a pair of
/// which one sees the other is not hidden. Most pairs are hidden, so those that are not are taken
/// from all.
static sl_status make_lump(const reject_maker *make, sli_reject *out) {
    const size_t count = make->count, bits = count * count;
    out->size = (bits + 7) / 8;
    out->bytes = sl_alloc_array(make->context, out->size, 1);
    if (!out->bytes) return SL_NO_MEMORY;
    memset(out->bytes, 0xff, out->size);
    for (size_t bit = bits; bit < 8 * out->size; bit++) take_bit(out->bytes, bit);
    out->account.hidden = count ? (uint64_t)count * (count - 1) / 2 : 0;
    for (size_t a = 0; a < count; a++) {
        SL_TRY(sl_check_cancelled(make->context));
        show(make, a, a, out);
        for (size_t w = 0; w < make->words; w++)
            for (sl_bits seen = row_of(make, a)[w]; seen; seen &= seen - 1) {
                const size_t b = 64 * w + (size_t)__builtin_ctzll(seen);
                if (b < count) show(make, a, b, out);
            }
    }
    return SL_OK;
}

sl_status sli_reject_make(sl_context *context, const sl_space *space, const sl_pvs *pvs,
                          const sli_doom_level *level, sli_reject *out) {
    reject_maker make = {
        .context = context, .space = space, .pvs = pvs, .count = level->sector_count};
    sli_reject made = {.account = {.sectors = (uint32_t)make.count, .cells = space->cell_count}};
    sl_status status = sli_cell_sectors_find(context, space, level, &make.cells);
    if (status == SL_OK) status = find_seen(&make);
    if (status == SL_OK) status = make_lump(&make, &made);
    made.account.unknown = (uint32_t)make.unknown;
    sli_cell_sectors_destroy(context, &make.cells);
    sl_free(context, make.seen);
    if (status == SL_OK)
        *out = made;
    else
        sli_reject_destroy(context, &made);
    return status;
}

void sli_reject_destroy(sl_context *context, sli_reject *reject) {
    sl_free(context, reject->bytes);
    *reject = (sli_reject){0};
}
