#include "geometry/orient.h"
#include "map/planar.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// An axial wall, told apart from the axis: upright at x from y to y, or level at y from x to x.
typedef struct piece {
    double at, low, high;
    uint32_t line;
    bool cut;
} piece;

typedef SL_ARRAY(piece) pieces;
typedef SL_ARRAY(sl_wall) oblique_walls;

static int compare(double a, double b) {
    return (a > b) - (a < b);
}

/// Line 0 stands for none and comes last, so that the first of several that are else equal has
/// the line to keep.
static int compare_lines(uint32_t a, uint32_t b) {
    return (a - 1 > b - 1) - (a - 1 < b - 1);
}

static uint32_t lower_line(uint32_t a, uint32_t b) {
    return compare_lines(a, b) <= 0 ? a : b;
}

static int compare_pieces(const void *left, const void *right) {
    const piece *a = left, *b = right;
    int order = compare(a->at, b->at);
    if (!order) order = compare(a->low, b->low);
    if (!order) order = compare(a->high, b->high);
    return order ? order : compare_lines(a->line, b->line);
}

static int compare_walls(const void *left, const void *right) {
    const sl_wall *a = left, *b = right;
    int order = sl_compare_points(a->a, b->a);
    if (!order) order = sl_compare_points(a->b, b->b);
    return order ? order : compare_lines(a->line, b->line);
}

/// One zero: -0 is as good a place as 0, but differs in its bytes.
static sl_point plain(sl_point point) {
    return (sl_point){point.x == 0 ? 0 : point.x, point.y == 0 ? 0 : point.y};
}

static sl_status add_piece(sl_context *context, pieces *list, piece added) {
    SL_TRY(SL_ARRAY_ROOM(context, list, 1));
    list->items[list->count++] = added;
    return SL_OK;
}

/// The work of cleaning one map.
typedef struct cleaning {
    sl_context *context;
    sl_clean_account account;
    pieces uprights, levels;
    oblique_walls others;
    pieces upright_parts, level_parts; ///< what is left of the uprights and levels after the cuts
} cleaning;

/// Tells the walls apart by direction, their ends in order.
static sl_status sort_in(cleaning *work, sl_wall wall) {
    wall.a = plain(wall.a);
    wall.b = plain(wall.b);
    const int order = sl_compare_points(wall.a, wall.b);
    if (order == 0) {
        work->account.zero_length++;
        return SL_OK;
    }
    if (order > 0) wall = (sl_wall){.a = wall.b, .b = wall.a, .line = wall.line};
    if (wall.a.x == wall.b.x)
        return add_piece(work->context, &work->uprights,
                         (piece){wall.a.x, wall.a.y, wall.b.y, wall.line, false});
    if (wall.a.y == wall.b.y)
        return add_piece(work->context, &work->levels,
                         (piece){wall.a.y, wall.a.x, wall.b.x, wall.line, false});
    SL_TRY(SL_ARRAY_ROOM(work->context, &work->others, 1));
    work->others.items[work->others.count++] = wall;
    return SL_OK;
}

/// Mirrors are walls as well.
static sl_status sort_out(cleaning *work, const sl_map *map) {
    for (size_t i = 0; i < map->wall_count; i++) SL_TRY(sort_in(work, map->walls[i]));
    for (size_t i = 0; i < map->mirror_count; i++) {
        const sl_glass *mirror = &map->mirrors[i];
        SL_TRY(
            sort_in(work, (sl_wall){mirror->segment.a, mirror->segment.b, .line = mirror->line}));
    }
    return SL_OK;
}

/// Sorts pieces by place and joins those that overlap or touch.
static void merge(pieces *list, sl_clean_account *account) {
    if (list->count == 0) return;
    qsort(list->items, list->count, sizeof *list->items, compare_pieces);
    size_t kept = 0;
    piece previous = list->items[0];
    for (size_t i = 1; i < list->count; i++) {
        const piece next = list->items[i];
        piece *last = &list->items[kept];
        if (next.at != last->at || next.low > last->high) {
            list->items[++kept] = next;
        } else {
            const bool same = next.low == previous.low && next.high == previous.high;
            if (same)
                account->duplicate++;
            else
                account->merged++;
            if (next.high > last->high) last->high = next.high;
            last->line = lower_line(last->line, next.line);
        }
        previous = next;
    }
    list->count = kept + 1;
}

static void drop_duplicates(oblique_walls *list, sl_clean_account *account) {
    if (list->count == 0) return;
    qsort(list->items, list->count, sizeof *list->items, compare_walls);
    size_t kept = 0;
    for (size_t i = 1; i < list->count; i++) {
        const sl_wall *last = &list->items[kept], *next = &list->items[i];
        if (sl_compare_points(last->a, next->a) == 0 && sl_compare_points(last->b, next->b) == 0)
            account->duplicate++;
        else
            list->items[++kept] = *next;
    }
    list->count = kept + 1;
}

/// A set of small numbers that finds its next member fast: a bit each, and above every 64 of them
/// a bit that says whether any is set.
typedef struct ranks {
    sl_bits *bits[11]; ///< 64 to the 11th power exceeds any count
    size_t words[11];
    int floors;
} ranks;

#define NONE SIZE_MAX

static sl_status create_ranks(sl_context *context, size_t count, ranks *set) {
    *set = (ranks){0};
    size_t total = 0;
    do {
        count = sl_bits_words(count);
        set->words[set->floors++] = count;
        total += count;
    } while (count > 1);
    set->bits[0] = sl_alloc_array(context, total, sizeof(sl_bits));
    if (!set->bits[0]) return SL_NO_MEMORY;
    for (int i = 1; i < set->floors; i++) set->bits[i] = set->bits[i - 1] + set->words[i - 1];
    return SL_OK;
}

static void add_rank(ranks *set, size_t rank) {
    for (int i = 0; i < set->floors; i++, rank /= 64) sl_bits_add(set->bits[i], rank);
}

static void remove_rank(ranks *set, size_t rank) {
    for (int i = 0; i < set->floors; i++, rank /= 64) {
        sl_bits *word = &set->bits[i][rank / 64];
        *word &= ~((sl_bits)1 << rank % 64);
        if (*word) break;
    }
}

static size_t lowest(sl_bits word) {
    return (size_t)__builtin_ctzll(word);
}

/// The first member that is not below `from`; NONE where there is none.
static size_t next_rank(const ranks *set, size_t from) {
    for (int i = 0; i < set->floors; i++) {
        if (from / 64 >= set->words[i]) return NONE;
        const sl_bits word = set->bits[i][from / 64] >> from % 64;
        if (word) {
            from += lowest(word);
            while (i--) from = from * 64 + lowest(set->bits[i][from]);
            return from;
        }
        from = from / 64 + 1;
    }
    return NONE;
}

/// Where a level wall comes in or goes out as the sweep passes.
typedef struct event {
    double at;
    size_t level;
} event;

static int compare_events(const void *left, const void *right) {
    const event *a = left, *b = right;
    const int order = compare(a->at, b->at);
    return order ? order : (a->level > b->level) - (a->level < b->level);
}

/// The sweep over x. On a rank (one y) at most one level wall is active: merged walls are apart.
typedef struct sweeper {
    event *ins, *outs; ///< the levels by where they begin, and by where they end
    size_t in, out;    ///< how many of each are passed
    size_t *rank;      ///< of each level
    double *height;    ///< of each rank, ascending
    size_t *here;      ///< on each rank the active level
    size_t rank_count;
    ranks active;
} sweeper;

static sl_status create_sweep(const cleaning *work, sweeper *sweep) {
    const pieces *levels = &work->levels;
    sweep->ins = sl_alloc_array(work->context, levels->count, sizeof *sweep->ins);
    sweep->outs = sl_alloc_array(work->context, levels->count, sizeof *sweep->outs);
    sweep->rank = sl_alloc_array(work->context, levels->count, sizeof *sweep->rank);
    sweep->height = sl_alloc_array(work->context, levels->count, sizeof *sweep->height);
    sweep->here = sl_alloc_array(work->context, levels->count, sizeof *sweep->here);
    if (!sweep->ins || !sweep->outs || !sweep->rank || !sweep->height || !sweep->here)
        return SL_NO_MEMORY;
    for (size_t i = 0; i < levels->count; i++) {
        const piece *level = &levels->items[i];
        if (i == 0 || level->at != levels->items[i - 1].at)
            sweep->height[sweep->rank_count++] = level->at;
        sweep->rank[i] = sweep->rank_count - 1;
        sweep->ins[i] = (event){level->low, i};
        sweep->outs[i] = (event){level->high, i};
    }
    qsort(sweep->ins, levels->count, sizeof *sweep->ins, compare_events);
    qsort(sweep->outs, levels->count, sizeof *sweep->outs, compare_events);
    return create_ranks(work->context, sweep->rank_count, &sweep->active);
}

static void destroy_sweep(sl_context *context, sweeper *sweep) {
    sl_free(context, sweep->ins);
    sl_free(context, sweep->outs);
    sl_free(context, sweep->rank);
    sl_free(context, sweep->height);
    sl_free(context, sweep->here);
    sl_free(context, sweep->active.bits[0]);
}

/// Moves on to x: all that begin up to there come in, all that end before go out, in their order.
static void advance(sweeper *sweep, size_t count, double x) {
    for (;;) {
        const bool in = sweep->in < count && sweep->ins[sweep->in].at <= x;
        const bool out = sweep->out < count && sweep->outs[sweep->out].at < x;
        if (!in && !out) return;
        if (in && !(out && sweep->outs[sweep->out].at < sweep->ins[sweep->in].at)) {
            const size_t level = sweep->ins[sweep->in++].level;
            sweep->here[sweep->rank[level]] = level;
            add_rank(&sweep->active, sweep->rank[level]);
        } else {
            remove_rank(&sweep->active, sweep->rank[sweep->outs[sweep->out++].level]);
        }
    }
}

/// The first rank whose height is not below y.
static size_t first_rank(const sweeper *sweep, double y) {
    size_t low = 0, high = sweep->rank_count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sweep->height[middle] < y)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// Cuts off what lies below `at`, if that is inside the piece.
static sl_status cut(cleaning *work, piece *whole, double at, pieces *parts) {
    if (at <= whole->low || at >= whole->high) return SL_OK;
    piece part = *whole;
    part.high = at;
    SL_TRY(add_piece(work->context, parts, part));
    whole->low = at;
    if (!whole->cut) work->account.split++;
    whole->cut = true;
    return SL_OK;
}

/// Cuts an upright wall and the active levels where they meet.
static sl_status meet(cleaning *work, sweeper *sweep, piece *upright) {
    size_t rank = next_rank(&sweep->active, first_rank(sweep, upright->low));
    while (rank != NONE && sweep->height[rank] <= upright->high) {
        SL_TRY(cut(work, upright, sweep->height[rank], &work->upright_parts));
        piece *level = &work->levels.items[sweep->here[rank]];
        SL_TRY(cut(work, level, upright->at, &work->level_parts));
        rank = next_rank(&sweep->active, rank + 1);
    }
    return add_piece(work->context, &work->upright_parts, *upright);
}

static sl_status sweep_over(cleaning *work, sweeper *sweep) {
    SL_TRY(create_sweep(work, sweep));
    for (size_t i = 0; i < work->uprights.count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(work->context));
        advance(sweep, work->levels.count, work->uprights.items[i].at);
        SL_TRY(meet(work, sweep, &work->uprights.items[i]));
    }
    for (size_t i = 0; i < work->levels.count; i++)
        SL_TRY(add_piece(work->context, &work->level_parts, work->levels.items[i]));
    return SL_OK;
}

/// Puts the result in the place of the map's walls.
static sl_status hand_over(cleaning *work, sl_map *map) {
    pieces *uprights = &work->upright_parts, *levels = &work->level_parts;
    const size_t count = uprights->count + levels->count + work->others.count;
    sl_wall *walls = sl_alloc_array(work->context, count, sizeof *walls);
    if (!walls) return SL_NO_MEMORY;
    // The sweep leaves the uprights in order.
    if (levels->count) qsort(levels->items, levels->count, sizeof(piece), compare_pieces);
    sl_wall *next = walls;
    for (size_t i = 0; i < uprights->count; i++) {
        const piece *part = &uprights->items[i];
        *next++ = (sl_wall){{part->at, part->low}, {part->at, part->high}, part->line};
    }
    for (size_t i = 0; i < levels->count; i++) {
        const piece *part = &levels->items[i];
        *next++ = (sl_wall){{part->low, part->at}, {part->high, part->at}, part->line};
    }
    for (size_t i = 0; i < work->others.count; i++) *next++ = work->others.items[i];
    sl_free(work->context, map->walls);
    map->walls = walls;
    map->wall_count = map->wall_room = work->account.after = count;
    return SL_OK;
}

/// Where all is axial and ends are where they are: no coordinate is computed.
static sl_status clean_axial(cleaning *work, sl_map *map) {
    sweeper sweep = {0};
    const sl_status status = sweep_over(work, &sweep);
    destroy_sweep(work->context, &sweep);
    SL_TRY(status);
    return hand_over(work, map);
}

// --- oblique walls: all of the map's segments become one planar graph

/// All segments of a map in one list: walls first, then what else stands in it.
typedef struct segment_list {
    SL_ARRAY(sl_segment) items;
    size_t mirrors, oneways, seams, doors, cells; ///< the first of each; walls before them
} segment_list;

static sl_status add_segment(sl_context *context, segment_list *list, sl_point a, sl_point b) {
    SL_TRY(SL_ARRAY_ROOM(context, &list->items, 1));
    list->items.items[list->items.count++] = (sl_segment){a, b};
    return SL_OK;
}

static sl_status add_glass(sl_context *context, segment_list *list, const sl_glass *glass,
                           size_t count) {
    for (size_t i = 0; i < count; i++)
        SL_TRY(add_segment(context, list, glass[i].segment.a, glass[i].segment.b));
    return SL_OK;
}

static sl_status list_segments(const cleaning *work, const sl_map *map, segment_list *list) {
    sl_context *context = work->context;
    for (size_t i = 0; i < work->uprights.count; i++) {
        const piece *at = &work->uprights.items[i];
        SL_TRY(
            add_segment(context, list, (sl_point){at->at, at->low}, (sl_point){at->at, at->high}));
    }
    for (size_t i = 0; i < work->levels.count; i++) {
        const piece *at = &work->levels.items[i];
        SL_TRY(
            add_segment(context, list, (sl_point){at->low, at->at}, (sl_point){at->high, at->at}));
    }
    for (size_t i = 0; i < work->others.count; i++)
        SL_TRY(add_segment(context, list, work->others.items[i].a, work->others.items[i].b));
    list->mirrors = list->items.count;
    SL_TRY(add_glass(context, list, map->mirrors, map->mirror_count));
    list->oneways = list->items.count;
    SL_TRY(add_glass(context, list, map->oneways, map->oneway_count));
    list->seams = list->items.count;
    SL_TRY(add_glass(context, list, map->seams, map->seam_count));
    list->doors = list->items.count;
    for (size_t i = 0; i < map->door_count; i++)
        SL_TRY(add_segment(context, list, map->doors[i].segment.a, map->doors[i].segment.b));
    list->cells = list->items.count;
    for (size_t i = 0; i < map->cell_count; i++) {
        const sl_map_cell *cell = &map->cells[i];
        const sl_point *corners = map->corners + cell->first;
        for (size_t k = 0; k < cell->count; k++)
            SL_TRY(add_segment(context, list, corners[k], corners[(k + 1) % cell->count]));
    }
    return SL_OK;
}

static uint32_t line_of(const cleaning *work, size_t segment) {
    const size_t uprights = work->uprights.count, levels = work->levels.count;
    if (segment < uprights) return work->uprights.items[segment].line;
    if (segment < uprights + levels) return work->levels.items[segment - uprights].line;
    return work->others.items[segment - uprights - levels].line;
}

/// What a map is given in the place of its own, made ready so that nothing can fail halfway.
typedef struct replacement {
    sl_wall *walls;
    sl_glass *mirrors, *oneways, *seams;
    sl_segment **doors; ///< by door: its parts
    sl_point *corners;  ///< of cells
    size_t wall_count;
} replacement;

/// Makes a wall of each edge that is part of one.
static sl_status make_walls(cleaning *work, const segment_list *list, const sl_planar *graph,
                            replacement *out) {
    uint32_t *lines = sl_alloc_array(work->context, graph->edge_count, sizeof *lines);
    bool *walled = sl_alloc_array(work->context, graph->edge_count, sizeof *walled);
    out->walls = sl_alloc_array(work->context, graph->edge_count, sizeof *out->walls);
    const bool done = lines && walled && out->walls;
    for (size_t i = 0; i < list->mirrors && done; i++) {
        const size_t parts = graph->first[i + 1] - graph->first[i];
        work->account.split += parts > 1;
        work->account.zero_length += parts == 0;
        for (size_t k = graph->first[i]; k < graph->first[i + 1]; k++) {
            const size_t edge = graph->links[k] / 2;
            const uint32_t line = line_of(work, i);
            lines[edge] = walled[edge] ? lower_line(lines[edge], line) : line;
            work->account.merged += walled[edge];
            walled[edge] = true;
        }
    }
    for (size_t i = 0; i < graph->edge_count && done; i++)
        if (walled[i])
            out->walls[out->wall_count++] = (sl_wall){graph->points[graph->edges[i].a],
                                                      graph->points[graph->edges[i].b], lines[i]};
    if (out->wall_count) qsort(out->walls, out->wall_count, sizeof *out->walls, compare_walls);
    sl_free(work->context, lines);
    sl_free(work->context, walled);
    return done ? SL_OK : SL_NO_MEMORY;
}

/// The parts that mirrors, glass or seams have become.
static sl_status make_glass(sl_context *context, const sl_planar *graph, size_t first,
                            const sl_glass *glass, size_t count, sl_glass **out) {
    size_t next = 0;
    *out = sl_alloc_array(context, graph->first[first + count] - graph->first[first], sizeof **out);
    if (!*out) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        for (size_t k = graph->first[first + i]; k < graph->first[first + i + 1]; k++) {
            (*out)[next] = glass[i];
            (*out)[next++].segment = sl_planar_at(graph, graph->links[k]);
        }
    return SL_OK;
}

static sl_status make_doors(sl_context *context, const sl_planar *graph, size_t first, size_t count,
                            sl_segment ***out) {
    *out = sl_alloc_array(context, count, sizeof **out);
    if (!*out) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const size_t links = graph->first[first + i], parts = graph->first[first + i + 1] - links;
        (*out)[i] = sl_alloc_array(context, parts, sizeof ***out);
        if (!(*out)[i]) return SL_NO_MEMORY;
        for (size_t k = 0; k < parts; k++)
            (*out)[i][k] = sl_planar_at(graph, graph->links[links + k]);
    }
    return SL_OK;
}

static sl_status make_replacement(cleaning *work, const segment_list *list, const sl_planar *graph,
                                  const sl_map *map, replacement *out) {
    sl_context *context = work->context;
    SL_TRY(make_walls(work, list, graph, out));
    SL_TRY(
        make_glass(context, graph, list->mirrors, map->mirrors, map->mirror_count, &out->mirrors));
    SL_TRY(
        make_glass(context, graph, list->oneways, map->oneways, map->oneway_count, &out->oneways));
    SL_TRY(make_glass(context, graph, list->seams, map->seams, map->seam_count, &out->seams));
    SL_TRY(make_doors(context, graph, list->doors, map->door_count, &out->doors));
    const size_t sides = graph->first[list->items.count] - graph->first[list->cells];
    out->corners = sl_alloc_array(context, sides, sizeof *out->corners);
    return out->corners ? SL_OK : SL_NO_MEMORY;
}

static void replace_glass(sl_context *context, sl_glass **glass, size_t *count, size_t *room,
                          sl_glass **with, size_t with_count) {
    sl_free(context, *glass);
    *glass = *with;
    *with = NULL;
    *count = *room = with_count;
}

/// A door keeps its name and number, whatever it is cut into.
static void replace_door(sl_context *context, sl_door *door, sl_segment **parts, size_t count) {
    sl_free(context, door->parts);
    door->parts = NULL;
    door->part_count = 0;
    door->segment.b = count ? (*parts)[count - 1].b : door->segment.a;
    if (count) door->segment.a = (*parts)[0].a;
    if (count < 2) return;
    door->parts = *parts;
    door->part_count = count;
    *parts = NULL;
}

/// The corners of cells are where the edges start that their sides have become.
static void replace_cells(sl_context *context, const sl_planar *graph, size_t first, sl_map *map,
                          sl_point **corners) {
    size_t cells = 0, count = 0;
    for (size_t i = 0; i < map->cell_count; i++) {
        sl_map_cell cell = map->cells[i];
        const size_t *sides = graph->first + first + cell.first;
        cell.first = count;
        for (size_t k = sides[0]; k < sides[cell.count]; k++)
            (*corners)[count++] = sl_planar_at(graph, graph->links[k]).a;
        cell.count = (uint32_t)(count - cell.first);
        if (cell.count < 3)
            count = cell.first;
        else
            map->cells[cells++] = cell;
    }
    sl_free(context, map->corners);
    map->corners = *corners;
    *corners = NULL;
    map->corner_count = map->corner_room = count;
    map->cell_count = cells;
}

static void replace(cleaning *work, const segment_list *list, const sl_planar *graph,
                    replacement *with, sl_map *map) {
    sl_context *context = work->context;
    const size_t *first = graph->first;
    sl_free(context, map->walls);
    map->walls = with->walls;
    with->walls = NULL;
    map->wall_count = map->wall_room = work->account.after = with->wall_count;
    replace_glass(context, &map->mirrors, &map->mirror_count, &map->mirror_room, &with->mirrors,
                  first[list->oneways] - first[list->mirrors]);
    replace_glass(context, &map->oneways, &map->oneway_count, &map->oneway_room, &with->oneways,
                  first[list->seams] - first[list->oneways]);
    replace_glass(context, &map->seams, &map->seam_count, &map->seam_room, &with->seams,
                  first[list->doors] - first[list->seams]);
    for (size_t i = 0; i < map->door_count; i++)
        replace_door(context, &map->doors[i], &with->doors[i],
                     first[list->doors + i + 1] - first[list->doors + i]);
    if (map->cell_count) replace_cells(context, graph, list->cells, map, &with->corners);
    work->account.welded = graph->welded;
    work->account.crossings = graph->crossings;
    work->account.largest_move = graph->largest_move;
}

static sl_status take_graph(cleaning *work, const segment_list *list, const sl_planar *graph,
                            sl_map *map) {
    replacement with = {0};
    const sl_status status = make_replacement(work, list, graph, map, &with);
    if (status == SL_OK) replace(work, list, graph, &with, map);
    for (size_t i = 0; with.doors && i < map->door_count; i++)
        sl_free(work->context, with.doors[i]);
    sl_free(work->context, with.doors);
    sl_free(work->context, with.walls);
    sl_free(work->context, with.mirrors);
    sl_free(work->context, with.oneways);
    sl_free(work->context, with.seams);
    sl_free(work->context, with.corners);
    return status;
}

static sl_status clean_oblique(cleaning *work, sl_map *map, double weld) {
    const sl_box bounds = sl_map_bounds(map);
    const double own = weld < 0 ? sl_planar_tolerance(&bounds) : weld;
    segment_list list = {0};
    sl_planar graph = {0};
    sl_status status = list_segments(work, map, &list);
    if (status == SL_OK)
        status =
            sl_planar_make(work->context, map->source ? map->source : "the map", list.items.items,
                           list.items.count, fmax(own, 2 * map->snap), &graph);
    if (status == SL_OK) status = take_graph(work, &list, &graph, map);
    sl_planar_destroy(work->context, &graph);
    sl_free(work->context, list.items.items);
    return status;
}

static bool is_axial(sl_segment at) {
    return at.a.x == at.b.x || at.a.y == at.b.y;
}

bool sl_map_is_axial(const sl_map *map) {
    bool axial = sl_map_count_oblique(map) == 0;
    for (size_t i = 0; i < map->mirror_count; i++) axial &= is_axial(map->mirrors[i].segment);
    for (size_t i = 0; i < map->door_count; i++) axial &= is_axial(map->doors[i].segment);
    for (size_t i = 0; i < map->oneway_count; i++) axial &= is_axial(map->oneways[i].segment);
    for (size_t i = 0; i < map->seam_count; i++) axial &= is_axial(map->seams[i].segment);
    return axial;
}

static sl_status clean(cleaning *work, sl_map *map, double weld) {
    const bool axial = sl_map_is_axial(map) && !(weld > 0) && !map->cell_count;
    SL_TRY(sort_out(work, map));
    merge(&work->uprights, &work->account);
    merge(&work->levels, &work->account);
    drop_duplicates(&work->others, &work->account);
    return axial ? clean_axial(work, map) : clean_oblique(work, map, weld);
}

sl_clean_options sl_clean_options_default(void) {
    return (sl_clean_options){.weld = -1};
}

sl_status sl_map_clean(sl_context *context, sl_map *map, const sl_clean_options *options,
                       sl_clean_account *account) {
    cleaning work = {.context = context, .account.before = map->wall_count};
    const double weld = options ? options->weld : sl_clean_options_default().weld;
    if (!isfinite(weld) || weld > SL_COORDINATE_MAX)
        return sl_fail(context, SL_BAD_ARGUMENT, "the welding tolerance must be a number");
    const sl_status status = clean(&work, map, weld);
    sl_free(context, work.uprights.items);
    sl_free(context, work.levels.items);
    sl_free(context, work.others.items);
    sl_free(context, work.upright_parts.items);
    sl_free(context, work.level_parts.items);
    if (status == SL_OK && account) *account = work.account;
    return status;
}
