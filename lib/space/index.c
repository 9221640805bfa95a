/// Three indexes, each for one question.
///
/// Boxes in a tree: which of many boxes meet a box, or are near a point? A packed R-tree (Kamel &
/// Faloutsos 1993, On packing R-trees). The boxes are sorted along the Z-order curve, which keeps
/// neighbours together. It goes by the ranks of their middles, in x and in y: so one box far away,
/// or many in one spot, do no harm. Then each level has one box around every 8 of the level below:
///
///     level 1        [--------- 0 .. 7 ---------][--------- 8 .. 15 ...
///     level 0        [0][1][2][3][4][5][6][7]     [8][9] ...
///
/// Walls in a tree: which walls are within a reach of a point or segment? The tree has their boxes.
/// An oblique wall fills little of its box, so walls whose line passes at a distance are left out.
///
/// Cells in a grid: which cell of a mesh holds a point? Each cell is entered row by row. The sides
/// of the cell give the columns that it spans in a row:
///
///     row 2   . . [A] [A] . .          a bucket may hold a cell too many, never one too few:
///     row 1   . [A] [A] [A] . .        places are rounded, so rows and columns are taken wider
///     row 0   . . [A] . . .            by a millionth of a bucket, far more than rounding
///
/// Buckets are as long as cells are on average, in x and in y, and there are four for each cell.
/// Then half of all places lie in a bucket with one or two cells. Many long oblique cells would
/// need too many entries; their grid gets fewer buckets.
#include "space/index.h"
#include "base/base.h"

#include "base/size.h"
#include "geometry/length.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- boxes in a tree

enum { FAN = 8 };

sl_box sli_box_around(sl_point a, sl_point b) {
    return (sl_box){{sli_lesser(a.x, b.x), sli_lesser(a.y, b.y)},
                    {sli_greater(a.x, b.x), sli_greater(a.y, b.y)}};
}

static sl_box joined(sl_box a, sl_box b) {
    return (sl_box){{sli_lesser(a.min.x, b.min.x), sli_lesser(a.min.y, b.min.y)},
                    {sli_greater(a.max.x, b.max.x), sli_greater(a.max.y, b.max.y)}};
}

sl_box sli_box_with(sl_box box, sl_point point) {
    return joined(box, (sl_box){point, point});
}

sl_box sli_box_of_cell(const sl_space *space, uint32_t cell) {
    const sl_point *corners = space->vertices + space->cells[cell].first_vertex;
    sl_box box = {corners[0], corners[0]};
    for (uint32_t i = 1; i < space->cells[cell].vertex_count; i++)
        box = sli_box_with(box, corners[i]);
    return box;
}

// --- the order

typedef struct place {
    double at;
    uint64_t key;
    uint32_t item;
} place;

/// Puts a 0 before each of the 32 bits of a value.
static uint64_t spread_bits(uint64_t value) {
    value = (value | value << 16) & 0x0000ffff0000ffff;
    value = (value | value << 8) & 0x00ff00ff00ff00ff;
    value = (value | value << 4) & 0x0f0f0f0f0f0f0f0f;
    value = (value | value << 2) & 0x3333333333333333;
    return (value | value << 1) & 0x5555555555555555;
}

static int compare_places(const void *left, const void *right) {
    const place *a = left, *b = right;
    return (a->at > b->at) - (a->at < b->at);
}

static int compare_keys(const void *left, const void *right) {
    const place *a = left, *b = right;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return (a->item > b->item) - (a->item < b->item);
}

/// The middle of a side; 0 for one without ends.
static double middle(double low, double high) {
    const double at = low / 2 + high / 2;
    return at == at ? at : 0;
}

/// Enters the ranks of the places into every other bit of their keys. Equal places have one rank.
static void add_ranks(place *places, size_t count, int axis) {
    uint64_t rank = 0;
    qsort(places, count, sizeof *places, compare_places);
    for (size_t i = 0; i < count; i++) {
        rank += i && places[i].at != places[i - 1].at;
        places[i].key |= spread_bits(rank) << axis;
    }
}

/// The numbers of the boxes, sorted along the curve by the ranks of their middles.
static sl_status sort_items(sl_context *context, const sl_box *boxes, size_t count,
                            uint32_t *items) {
    place *places = sl_alloc_array(context, count, sizeof *places);
    if (!places) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        places[i] = (place){middle(boxes[i].min.x, boxes[i].max.x), 0, (uint32_t)i};
    add_ranks(places, count, 0);
    for (size_t i = 0; i < count; i++) {
        const sl_box *box = &boxes[places[i].item];
        places[i].at = middle(box->min.y, box->max.y);
    }
    add_ranks(places, count, 1);
    qsort(places, count, sizeof *places, compare_keys);
    for (size_t i = 0; i < count; i++) items[i] = places[i].item;
    sl_free(context, places);
    return SL_OK;
}

// --- the tree

/// Counts the boxes of each level; the last has one.
static void lay_out(sli_box_tree *tree, size_t count) {
    while (true) {
        tree->first[tree->levels + 1] = tree->first[tree->levels] + count;
        tree->levels++;
        if (count == 1) return;
        count = (count + FAN - 1) / FAN;
    }
}

static void fill_level(sli_box_tree *tree, uint32_t level) {
    const sl_box *below = tree->boxes + tree->first[level - 1];
    const size_t count = tree->first[level] - tree->first[level - 1];
    for (size_t i = 0; i < count; i++) {
        sl_box *box = &tree->boxes[tree->first[level] + i / FAN];
        *box = i % FAN ? joined(*box, below[i]) : below[i];
    }
}

sl_status sli_box_tree_create(sl_context *context, const sl_box *boxes, size_t count,
                              sli_box_tree *out) {
    *out = (sli_box_tree){0};
    if (!count) return SL_OK;
    lay_out(out, count);
    out->items = sl_alloc_array(context, count, sizeof *out->items);
    out->boxes = sl_alloc_array(context, out->first[out->levels], sizeof *out->boxes);
    if (!out->items || !out->boxes) return SL_NO_MEMORY;
    SL_TRY(sort_items(context, boxes, count, out->items));
    for (size_t i = 0; i < count; i++) out->boxes[i] = boxes[out->items[i]];
    for (uint32_t level = 1; level < out->levels; level++) fill_level(out, level);
    return SL_OK;
}

void sli_box_tree_destroy(sl_context *context, sli_box_tree *tree) {
    sl_free(context, tree->items);
    sl_free(context, tree->boxes);
    *tree = (sli_box_tree){0};
}

// --- finding

static bool boxes_meet(const sl_box *a, const sl_box *b) {
    // Without branches, which would be hard to predict.
    return (a->min.x <= b->max.x) & (a->max.x >= b->min.x) & (a->min.y <= b->max.y) &
           (a->max.y >= b->min.y);
}

/// Most lists are short, and some are long.
static void sort_found(uint32_t *items, size_t count) {
    enum { SHORT = 24 };
    if (count > SHORT) qsort(items, count, sizeof *items, sli_compare_whole);
    for (size_t i = 1; i < count && count <= SHORT; i++) {
        const uint32_t item = items[i];
        size_t at = i;
        for (; at && items[at - 1] > item; at--) items[at] = items[at - 1];
        items[at] = item;
    }
}

/// Looks at the boxes of a level from `begin` on: those below one box of the next level.
static sl_status find_below(sl_context *context, const sli_box_tree *tree, uint32_t level,
                            size_t begin, const sl_box *box, sli_box_list *found) {
    const size_t first = tree->first[level], count = tree->first[level + 1] - first;
    const size_t end = count - begin < FAN ? count : begin + FAN;
    if (level == 0) SL_TRY(SL_ARRAY_ROOM(context, found, FAN));
    for (size_t i = begin; i < end; i++) {
        if (!boxes_meet(&tree->boxes[first + i], box)) continue;
        if (level)
            SL_TRY(find_below(context, tree, level - 1, i * FAN, box, found));
        else
            found->items[found->count++] = tree->items[i];
    }
    return SL_OK;
}

sl_status sli_box_tree_find(sl_context *context, const sli_box_tree *tree, const sl_box *box,
                            sli_box_list *found) {
    found->count = 0;
    if (!tree->levels) return SL_OK;
    SL_TRY(find_below(context, tree, tree->levels - 1, 0, box, found));
    sort_found(found->items, found->count);
    return SL_OK;
}

/// What goes down the levels of a search for near boxes.
typedef struct near_search {
    const sli_box_tree *tree;
    sl_point point;
    const double *most;
    void (*look)(void *user, uint32_t item);
    void *user;
    size_t looked;
} near_search;

/// Less a rounding, so that no box is passed over that is as near as `most`. INFINITY for boxes
/// that are farther along an axis.
static double least_distance(const sl_box *box, sl_point p, double most) {
    const double x = sli_greater(sli_greater(box->min.x - p.x, p.x - box->max.x), 0);
    const double y = sli_greater(sli_greater(box->min.y - p.y, p.y - box->max.y), 0);
    if (sli_greater(x, y) * (1 - 0x1p-39) > most) return INFINITY;
    return x > 0 || y > 0 ? sli_length(x, y) * (1 - 0x1p-40) : 0;
}

static void near_below(near_search *s, uint32_t level, size_t begin) {
    const size_t first = s->tree->first[level], count = s->tree->first[level + 1] - first;
    const size_t here = count - begin < FAN ? count - begin : FAN;
    const double most = *s->most;
    double distance[FAN];
    size_t near[FAN], left = 0;
    for (size_t i = 0; i < here; i++) {
        distance[i] = least_distance(&s->tree->boxes[first + begin + i], s->point, most);
        if (distance[i] <= most) near[left++] = i;
    }
    s->looked += here;
    while (left) {
        size_t at = 0;
        for (size_t i = 1; i < left; i++)
            if (distance[near[i]] < distance[near[at]]) at = i;
        const size_t nearest = near[at];
        if (!(distance[nearest] <= *s->most)) return;
        for (left--; at < left; at++) near[at] = near[at + 1];
        if (level)
            near_below(s, level - 1, (begin + nearest) * FAN);
        else
            s->look(s->user, s->tree->items[begin + nearest]);
    }
}

size_t sli_box_tree_near(const sli_box_tree *tree, sl_point point, const double *most,
                         void (*look)(void *user, uint32_t item), void *user) {
    near_search s = {tree, point, most, look, user, 0};
    if (tree->levels) near_below(&s, tree->levels - 1, 0);
    return s.looked;
}

// --- walls in a tree

sl_status sli_wall_index_create(sl_context *context, const sl_map *map, sli_wall_index *out) {
    *out = (sli_wall_index){.walls = map->walls};
    sl_box *boxes = sl_alloc_array(context, map->wall_count, sizeof *boxes);
    if (!boxes) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->wall_count; i++)
        boxes[i] = sli_box_around(map->walls[i].a, map->walls[i].b);
    const sl_status status = sli_box_tree_create(context, boxes, map->wall_count, &out->tree);
    sl_free(context, boxes);
    return status;
}

void sli_wall_index_destroy(sl_context *context, sli_wall_index *index) {
    sli_box_tree_destroy(context, &index->tree);
    sl_free(context, index->near.items);
    *index = (sli_wall_index){0};
}

/// Whether a segment lies farther than `reach` on one side of the line through another one. Not
/// where rounding might have decided it.
static bool passes(sl_point a, sl_point b, sl_point p, sl_point q, double reach) {
    const sl_point d = {b.x - a.x, b.y - a.y};
    const double from_p = d.x * (p.y - a.y) - d.y * (p.x - a.x);
    const double from_q = d.x * (q.y - a.y) - d.y * (q.x - a.x);
    const double size = fabs(a.x) + fabs(a.y) + fabs(p.x) + fabs(p.y) + fabs(q.x) + fabs(q.y);
    const double limit = (reach + 0x1p-40 * (size + reach)) * (fabs(d.x) + fabs(d.y));
    return (from_p > limit && from_q > limit) || (from_p < -limit && from_q < -limit);
}

sl_status sli_walls_near(sl_context *context, sli_wall_index *index, sl_segment at, double reach) {
    sli_box_list *near = &index->near;
    sl_box box = sli_box_around(at.a, at.b);
    const double most =
        fmax(fmax(fabs(box.min.x), fabs(box.max.x)), fmax(fabs(box.min.y), fabs(box.max.y)));
    const double wider = reach > 0 ? reach + 0x1p-50 * (most + reach) : 0;
    box.min = (sl_point){box.min.x - wider, box.min.y - wider};
    box.max = (sl_point){box.max.x + wider, box.max.y + wider};
    near->count = 0;
    if (!index->tree.levels) return SL_OK;
    SL_TRY(find_below(context, &index->tree, index->tree.levels - 1, 0, &box, near));
    size_t kept = 0;
    for (size_t i = 0; i < near->count; i++) {
        const sl_wall *wall = &index->walls[near->items[i]];
        if (!passes(wall->a, wall->b, at.a, at.b, reach) &&
            !passes(at.a, at.b, wall->a, wall->b, reach))
            near->items[kept++] = near->items[i];
    }
    near->count = kept;
    return SL_OK;
}

// --- cells in a grid

enum { MOST_STEPS = 1 << 16, BUCKETS_PER_CELL = 4, ENTRIES_PER_CELL = 32 };
static const double CELL_SLACK = 1e-6; ///< a share of a bucket

/// Columns from low to high; none where low > high.
typedef struct span {
    double low, high;
} span;

typedef struct filler {
    const sl_space *space;
    sl_cell_grid *grid;
    double width, height; ///< of the bounds
    double slack;         ///< a share of a bucket
    span *rows;           ///< by row: the columns of the current cell
    uint32_t *counts;     ///< by bucket: entries so far
    uint64_t total;       ///< the sum of all counts
} filler;

/// A corner in units of buckets.
static sl_point in_buckets(const filler *f, sl_point p) {
    const sl_box *b = &f->space->bounds;
    return (sl_point){(p.x - b->min.x) / f->width * f->grid->columns,
                      (p.y - b->min.y) / f->height * f->grid->rows};
}

static uint32_t clamp(double step, uint32_t count) {
    return step < 0 ? 0 : step < count ? (uint32_t)step : count - 1;
}

/// Widens the rows that a side passes through.
static void add_side(const filler *f, sl_point p, sl_point q) {
    const uint32_t rows = f->grid->rows;
    if (p.y > q.y) {
        const sl_point swap = p;
        p = q;
        q = swap;
    }
    const uint32_t first = clamp(p.y - f->slack, rows), last = clamp(q.y + f->slack, rows);
    for (uint32_t row = first; row <= last; row++) {
        const double low = sli_greater(p.y, row - f->slack),
                     high = sli_lesser(q.y, row + 1 + f->slack);
        const double rise = q.y - p.y;
        double a = p.x, b = q.x;
        if (rise > 0 && first != last) {
            a = p.x + (q.x - p.x) * sli_lesser(1, sli_greater(0, (low - p.y) / rise));
            b = p.x + (q.x - p.x) * sli_lesser(1, sli_greater(0, (high - p.y) / rise));
        }
        f->rows[row].low = sli_lesser(f->rows[row].low, sli_lesser(a, b));
        f->rows[row].high = sli_greater(f->rows[row].high, sli_greater(a, b));
    }
}

/// Finds the columns of a polygon in each row, from *out to *last.
static uint32_t reach(const filler *f, const sl_point *corners, uint32_t count, uint32_t *out) {
    const sl_cell_grid *g = f->grid;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (uint32_t i = 0; i < count; i++) {
        const double y = in_buckets(f, corners[i]).y;
        low = sli_lesser(low, y);
        high = sli_greater(high, y);
    }
    const uint32_t first = clamp(low - f->slack, g->rows), last = clamp(high + f->slack, g->rows);
    for (uint32_t row = first; row <= last; row++) f->rows[row] = (span){HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < count; i++)
        add_side(f, in_buckets(f, corners[i]), in_buckets(f, corners[i + 1 < count ? i + 1 : 0]));
    *out = last;
    return first;
}

/// Enters a cell into its buckets; without lists it is only counted.
static void enter(filler *f, uint32_t number, uint32_t *cells) {
    const sl_cell *cell = &f->space->cells[number];
    const sl_cell_grid *g = f->grid;
    uint32_t last;
    const uint32_t first =
        reach(f, f->space->vertices + cell->first_vertex, cell->vertex_count, &last);
    for (uint32_t row = first; row <= last; row++) {
        if (f->rows[row].low > f->rows[row].high) continue;
        const uint32_t from = clamp(f->rows[row].low - f->slack, g->columns);
        const uint32_t to = clamp(f->rows[row].high + f->slack, g->columns);
        for (uint32_t column = from; column <= to; column++) {
            const size_t bucket = (size_t)row * g->columns + column;
            if (cells) cells[g->first[bucket] + f->counts[bucket]] = number;
            f->counts[bucket]++;
        }
        f->total += to - from + 1;
    }
}

static sl_status fill_lists(sl_context *context, filler *f, uint64_t most) {
    const uint32_t cells = f->space->cell_count;
    sl_cell_grid *g = f->grid;
    const size_t buckets = (size_t)g->columns * g->rows;
    g->first = sl_alloc_array(context, buckets + 1, sizeof *g->first);
    f->rows = sl_alloc_array(context, g->rows, sizeof *f->rows);
    f->counts = sl_alloc_array(context, buckets, sizeof *f->counts);
    if (!g->first || !f->rows || !f->counts) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < cells && f->total <= most; i++) enter(f, i, NULL);
    if (f->total > most) return SL_OK;
    g->first[0] = 0;
    for (size_t i = 0; i < buckets; i++) g->first[i + 1] = g->first[i] + f->counts[i];
    g->entry_count = g->first[buckets];
    g->cells = sl_alloc_array(context, g->entry_count, sizeof *g->cells);
    if (!g->cells) return SL_NO_MEMORY;
    memset(f->counts, 0, buckets * sizeof *f->counts);
    for (uint32_t i = 0; i < cells; i++) enter(f, i, g->cells);
    return SL_OK;
}

/// Fills a grid whose columns and rows are set. Leaves `cells` NULL if it would have more than
/// `most` entries.
static sl_status fill(sl_context *context, const sl_space *space, double slack, uint64_t most,
                      sl_cell_grid *grid) {
    const sl_box *b = &space->bounds;
    filler f = {.space = space,
                .grid = grid,
                .width = b->max.x - b->min.x,
                .height = b->max.y - b->min.y,
                .slack = slack};
    const sl_status status = fill_lists(context, &f, most);
    sl_free(context, f.rows);
    sl_free(context, f.counts);
    return status;
}

sl_status sli_cell_grid_reach(sl_context *context, const sl_space *space, const sl_point *corners,
                              uint32_t count, sli_bucket_list *out) {
    const sl_box *b = &space->bounds;
    sl_cell_grid grid = space->grid;
    span *rows = sl_alloc_array(context, grid.rows, sizeof *rows);
    if (!rows) return SL_NO_MEMORY;
    const filler f = {.space = space,
                      .grid = &grid,
                      .width = b->max.x - b->min.x,
                      .height = b->max.y - b->min.y,
                      .slack = CELL_SLACK,
                      .rows = rows};
    uint32_t last;
    sl_status status = SL_OK;
    for (uint32_t row = reach(&f, corners, count, &last); row <= last && status == SL_OK; row++) {
        if (rows[row].low > rows[row].high) continue;
        const uint32_t to = clamp(rows[row].high + f.slack, grid.columns);
        uint32_t column = clamp(rows[row].low - f.slack, grid.columns);
        status = SL_ARRAY_ROOM(context, out, to - column + 1);
        for (; column <= to && status == SL_OK; column++)
            out->items[out->count++] = row * grid.columns + column;
    }
    sl_free(context, rows);
    return status;
}

/// The ratio of the average width of cells to their average height, as shares of the bounds.
static double shape_of_cells(const sl_space *s) {
    const sl_box *b = &s->bounds;
    double wide = 0, high = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        const sl_point *v = s->vertices + s->cells[i].first_vertex;
        sl_point min = v[0], max = v[0];
        for (uint32_t k = 1; k < s->cells[i].vertex_count; k++) {
            min = (sl_point){sli_lesser(min.x, v[k].x), sli_lesser(min.y, v[k].y)};
            max = (sl_point){sli_greater(max.x, v[k].x), sli_greater(max.y, v[k].y)};
        }
        wide += (max.x - min.x) / (b->max.x - b->min.x);
        high += (max.y - min.y) / (b->max.y - b->min.y);
    }
    return wide / high;
}

static uint32_t steps(double share) {
    return share >= 1 ? (uint32_t)sli_lesser(share, MOST_STEPS) : 1;
}

sl_status sli_cell_grid_make(sl_context *context, sl_space *space) {
    sl_cell_grid *g = &space->grid;
    const double shape = shape_of_cells(space);
    const uint64_t most = (uint64_t)space->cell_count * ENTRIES_PER_CELL;
    double buckets = (double)space->cell_count * BUCKETS_PER_CELL;
    sl_status status = SL_OK;
    for (; status == SL_OK && !g->cells; buckets /= 4) {
        sli_cell_grid_destroy(context, g);
        g->columns = steps(sli_lesser(buckets, sqrt(buckets / shape)));
        g->rows = steps(buckets / g->columns);
        status = fill(context, space, CELL_SLACK, most < UINT32_MAX ? most : UINT32_MAX, g);
    }
    return status;
}

static bool is_in_bucket(const sl_cell_grid *g, size_t bucket, uint32_t cell) {
    for (uint32_t i = g->first[bucket]; i < sli_cell_grid_stop(g, bucket); i++)
        if (g->cells[i] == cell) return true;
    return false;
}

static sl_status compare(sl_context *context, const sl_cell_grid *grid, const sl_cell_grid *least) {
    if (!least->cells)
        return sl_fail(context, SL_BAD_INPUT, "the grid of buckets has too few entries");
    const size_t buckets = (size_t)grid->columns * grid->rows;
    for (size_t b = 0; b < buckets; b++)
        for (uint32_t i = least->first[b]; i < least->first[b + 1]; i++)
            if (!is_in_bucket(grid, b, least->cells[i]))
                return sl_fail(context, SL_BAD_INPUT,
                               "cell %u is not in a bucket that it reaches into", least->cells[i]);
    return SL_OK;
}

sl_status sli_cell_grid_check(sl_context *context, const sl_space *space) {
    sl_cell_grid least = {.columns = space->grid.columns, .rows = space->grid.rows};
    sl_status status = fill(context, space, CELL_SLACK / 2, space->grid.entry_count, &least);
    if (status == SL_OK) status = compare(context, &space->grid, &least);
    sli_cell_grid_destroy(context, &least);
    return status;
}

void sli_cell_grid_destroy(sl_context *context, sl_cell_grid *grid) {
    sl_free(context, grid->first);
    sl_free(context, grid->stop);
    sl_free(context, grid->cells);
    *grid = (sl_cell_grid){0};
}
