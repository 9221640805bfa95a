/// Cleaning: the walls of a map become a planar set (see sl_map_clean).
///
/// 1. Walls are sorted into uprights, levels and oblique ones; walls of no length are dropped.
/// 2. Uprights and levels in one line that overlap or touch are joined where the ground beside them
///    is the same; copies are dropped, and walls inside of solid ground.
/// 3. With nothing oblique, a sweep cuts walls where they cross or touch. Else the walls, together
///    with all else that the map holds, become one planar graph (clean_oblique.c). So they do where
///    ends of axial walls miss each other by no more than the tolerance.
///
/// The sweep goes over the uprights by x, and keeps the set of levels that are there at x:
///
///         |           |            at an upright, the levels between its two ends are
///     ----+-----------+---         looked up in order: each is cut at x, and the upright
///         |     ------+            at the height of the level
///         |           |
///     ----+-----------|------      no coordinate is computed: a cut takes the x of one
///                     |            wall and the y of the other
///
/// After step 2 there is at most one level of each height at x, or two that meet there, of which
/// the second counts. So the set is one bit for each height, with a tree of bits above it to find
/// the next one. Time O((n + k) log n) for k cuts.
#include "geometry/length.h"
#include "geometry/orient.h"
#include "map/ground.h"
#include "map/planar.h"
#include "map/source.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

/// An axial wall: an upright one at x from y to y, or a level one at y from x to x.
typedef struct piece {
    double at, low, high;
    uint32_t line;
    uint32_t ground; ///< as of a wall from low to high; SLI_GROUND_KEPT for a mirror's
    bool cut;
} piece;

typedef SL_ARRAY(piece) pieces;
typedef SL_ARRAY(sl_wall) oblique_walls;

static int compare(double a, double b) {
    return (a > b) - (a < b);
}

/// Line 0 stands for none and comes last. So the first of several equal walls has the line to keep.
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
    int order = sli_compare_points(a->a, b->a);
    if (!order) order = sli_compare_points(a->b, b->b);
    return order ? order : compare_lines(a->line, b->line);
}

/// Replaces -0 by 0, which is the same place in other bytes.
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
    pieces upright_parts, level_parts; ///< the uprights and levels after the cuts
} cleaning;

/// Puts a wall, its ends in order, among those of its direction.
static sl_status sort_in(cleaning *work, sl_wall wall) {
    wall.a = plain(wall.a);
    wall.b = plain(wall.b);
    const int order = sli_compare_points(wall.a, wall.b);
    if (order == 0) {
        work->account.zero_length++;
        return SL_OK;
    }
    if (order > 0) wall = (sl_wall){wall.b, wall.a, wall.line, sli_ground_turned(wall.ground)};
    if (wall.a.x == wall.b.x)
        return add_piece(work->context, &work->uprights,
                         (piece){wall.a.x, wall.a.y, wall.b.y, wall.line, wall.ground, false});
    if (wall.a.y == wall.b.y)
        return add_piece(work->context, &work->levels,
                         (piece){wall.a.y, wall.a.x, wall.b.x, wall.line, wall.ground, false});
    SL_TRY(SL_ARRAY_ROOM(work->context, &work->others, 1));
    work->others.items[work->others.count++] = wall;
    return SL_OK;
}

/// Sorts all walls; a mirror is a wall too.
static sl_status sort_out(cleaning *work, const sl_map *map) {
    for (size_t i = 0; i < map->wall_count; i++) SL_TRY(sort_in(work, map->walls[i]));
    for (size_t i = 0; i < map->mirror_count; i++) {
        const sl_glass *mirror = &map->mirrors[i];
        SL_TRY(sort_in(
            work, (sl_wall){mirror->segment.a, mirror->segment.b, mirror->line, SLI_GROUND_KEPT}));
    }
    return SL_OK;
}

static bool same_sides(uint32_t a, uint32_t b) {
    return ((a ^ b) & ~(uint32_t)SLI_GROUND_KEPT) == 0;
}

/// Joins sorted pieces of one run: in one line, each overlaps or touches one before it.
static sl_status join_run(sl_context *context, const piece *run, size_t count, pieces *out,
                          sl_clean_account *account) {
    piece whole = run[0];
    bool plain_ground = true, overlap = false;
    for (size_t i = 1; i < count; i++) {
        const bool same = run[i].low == run[i - 1].low && run[i].high == run[i - 1].high;
        *(same ? &account->duplicate : &account->merged) += 1;
        overlap |= run[i].low < whole.high;
        if (run[i].high > whole.high) whole.high = run[i].high;
        whole.line = lower_line(whole.line, run[i].line);
        plain_ground &= same_sides(run[i].ground, whole.ground);
        whole.ground |= run[i].ground & SLI_GROUND_KEPT;
    }
    if (plain_ground && !(overlap && sli_ground_begins(whole.ground)))
        return sli_ground_hides_wall(whole.ground) ? SL_OK : add_piece(context, out, whole);
    // The next piece to end, or to begin, ends the part that begins at `low`.
    const size_t first = out->count;
    SL_ARRAY(piece) active = {0};
    sl_status status = SL_OK;
    double low = run[0].low;
    for (size_t next = 0; status == SL_OK && low < whole.high;) {
        for (; next < count && run[next].low <= low && status == SL_OK; next++) {
            status = SL_ARRAY_ROOM(context, &active, 1);
            if (status == SL_OK) active.items[active.count++] = run[next];
        }
        piece part = {
            .at = whole.at, .low = low, .high = next < count ? run[next].low : whole.high};
        size_t kept = 0;
        for (size_t i = 0; i < active.count && status == SL_OK; i++) {
            const piece *p = &active.items[i];
            if (p->high <= low) continue;
            part.high = fmin(part.high, p->high);
            part.ground = sli_ground_joined(part.ground, p->ground);
            part.line = kept ? lower_line(part.line, p->line) : p->line;
            active.items[kept++] = *p;
        }
        active.count = kept;
        low = part.high;
        piece *last = out->count > first ? &out->items[out->count - 1] : NULL;
        if (sli_ground_hides_wall(part.ground)) continue;
        if (last && same_sides(last->ground, part.ground) && last->high == part.low) {
            last->high = part.high;
            last->ground |= part.ground & SLI_GROUND_KEPT;
            last->line = lower_line(last->line, part.line);
        } else if (status == SL_OK)
            status = add_piece(context, out, part);
    }
    sl_free(context, active.items);
    const size_t more = out->count > first ? out->count - first - 1 : 0;
    account->merged -= more < account->merged ? more : account->merged;
    return status;
}

/// Sorts pieces by place and joins those that overlap or touch.
static sl_status merge(sl_context *context, pieces *list, sl_clean_account *account) {
    if (list->count == 0) return SL_OK;
    qsort(list->items, list->count, sizeof *list->items, compare_pieces);
    pieces joined = {0};
    sl_status status = SL_OK;
    for (size_t first = 0, end; status == SL_OK && first < list->count; first = end) {
        double high = list->items[first].high;
        for (end = first + 1; end < list->count && list->items[end].at == list->items[first].at &&
                              list->items[end].low <= high;
             end++)
            high = fmax(high, list->items[end].high);
        status = join_run(context, list->items + first, end - first, &joined, account);
    }
    sl_free(context, list->items);
    *list = joined;
    return status;
}

static void drop_duplicates(oblique_walls *list, sl_clean_account *account) {
    if (list->count == 0) return;
    qsort(list->items, list->count, sizeof *list->items, compare_walls);
    size_t kept = 0;
    for (size_t i = 1; i < list->count; i++) {
        const sl_wall *last = &list->items[kept], *next = &list->items[i];
        if (sli_compare_points(last->a, next->a) == 0 &&
            sli_compare_points(last->b, next->b) == 0) {
            account->duplicate++;
            list->items[kept].ground = sli_ground_joined(last->ground, next->ground);
        } else
            list->items[++kept] = *next;
    }
    list->count = kept + 1;
}

/// A set of small numbers that finds its next member fast. Each number has a bit. Above every 64
/// bits stands one that says whether any of them is set.
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

/// The x where a level comes in or goes out.
typedef struct event {
    double at;
    size_t level;
} event;

static int compare_events(const void *left, const void *right) {
    const event *a = left, *b = right;
    const int order = compare(a->at, b->at);
    return order ? order : (a->level > b->level) - (a->level < b->level);
}

/// The sweep over x. A rank is one height (y). On each rank at most one level is active.
typedef struct sweeper {
    event *ins, *outs; ///< the levels by where they begin, and by where they end
    size_t in, out;    ///< the numbers of those that are passed
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

/// Moves on to x: levels that begin up to there come in, levels that end before it go out.
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
            const size_t level = sweep->outs[sweep->out++].level;
            // Another one, with other ground beside it, may have begun where this one ends.
            if (sweep->here[sweep->rank[level]] == level)
                remove_rank(&sweep->active, sweep->rank[level]);
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

/// Cuts off the part below `at`, where that is inside the piece.
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

/// The walls that pieces are, and the oblique ones behind them.
static sl_status list_walls(const cleaning *work, const pieces *uprights, const pieces *levels,
                            sl_wall **out, size_t *count) {
    *count = uprights->count + levels->count + work->others.count;
    sl_wall *next = *out = sl_alloc_array(work->context, *count, sizeof **out);
    if (!next) return SL_NO_MEMORY;
    for (size_t i = 0; i < uprights->count; i++) {
        const piece *p = &uprights->items[i];
        *next++ = (sl_wall){{p->at, p->low}, {p->at, p->high}, p->line, p->ground};
    }
    for (size_t i = 0; i < levels->count; i++) {
        const piece *p = &levels->items[i];
        *next++ = (sl_wall){{p->low, p->at}, {p->high, p->at}, p->line, p->ground};
    }
    for (size_t i = 0; i < work->others.count; i++) *next++ = work->others.items[i];
    return SL_OK;
}

static sl_status clean_axial(cleaning *work, sl_map *map) {
    pieces *uprights = &work->upright_parts, *levels = &work->level_parts;
    sl_wall *walls = NULL;
    size_t count = 0;
    sweeper sweep = {0};
    const sl_status status = sweep_over(work, &sweep);
    destroy_sweep(work->context, &sweep);
    SL_TRY(status);
    // The sweep leaves the uprights in order.
    if (levels->count) qsort(levels->items, levels->count, sizeof(piece), compare_pieces);
    SL_TRY(list_walls(work, uprights, levels, &walls, &count));
    for (size_t i = 0; i < count; i++) walls[i].ground &= ~(uint32_t)SLI_GROUND_KEPT;
    sl_free(work->context, map->walls);
    map->walls = walls;
    map->wall_count = map->wall_room = work->account.after = count;
    return SL_OK;
}

/// `idle` as in sli_clean_oblique.
static sl_status clean_oblique(cleaning *work, sl_map *map, double weld, bool *idle) {
    sl_wall *walls = NULL;
    size_t count = 0;
    SL_TRY(list_walls(work, &work->uprights, &work->levels, &walls, &count));
    const sl_status status =
        sli_clean_oblique(work->context, map, walls, count, weld, idle, &work->account);
    sl_free(work->context, walls);
    SL_TRY(status);
    if (!(idle && *idle) && map->wall_count)
        qsort(map->walls, map->wall_count, sizeof *map->walls, compare_walls);
    return SL_OK;
}

static bool is_axial(sl_segment at) {
    return at.a.x == at.b.x || at.a.y == at.b.y;
}

bool sl_map_is_axial(const sl_map *map) {
    bool axial = true;
    for (size_t i = 0; i < map->wall_count; i++)
        axial &= is_axial((sl_segment){map->walls[i].a, map->walls[i].b});
    for (size_t i = 0; i < map->mirror_count; i++) axial &= is_axial(map->mirrors[i].segment);
    for (size_t i = 0; i < map->door_count; i++) axial &= is_axial(map->doors[i].segment);
    for (size_t i = 0; i < map->oneway_count; i++) axial &= is_axial(map->oneways[i].segment);
    for (size_t i = 0; i < map->seam_count; i++) axial &= is_axial(map->seams[i].segment);
    return axial;
}

// --- the tolerance

static double shorter(double length, sl_segment at, double least) {
    const double own = sli_length(at.b.x - at.a.x, at.b.y - at.a.y);
    return own > least && own < length ? own : length;
}

/// The shortest wall, door or glass that is longer than `least`.
static double shortest(const sl_map *map, double least) {
    double length = HUGE_VAL;
    for (size_t i = 0; i < map->wall_count; i++)
        length = shorter(length, (sl_segment){map->walls[i].a, map->walls[i].b}, least);
    for (size_t i = 0; i < map->door_count; i++)
        length = shorter(length, map->doors[i].segment, least);
    const sl_glass *const glass[] = {map->mirrors, map->oneways, map->seams};
    const size_t counts[] = {map->mirror_count, map->oneway_count, map->seam_count};
    for (int kind = 0; kind < 3; kind++)
        for (size_t i = 0; i < counts[kind]; i++)
            length = shorter(length, glass[kind][i].segment, least);
    return length;
}

/// The map's precision, kept below what would close real gaps or eat real walls.
static double safe_precision(const sl_map *map, const sl_box *bounds) {
    if (!(map->precision > 0)) return 0;
    const double size = fmax(bounds->max.x - bounds->min.x, bounds->max.y - bounds->min.y);
    const double noise = fmin(map->precision, 1e-5 * size);
    return fmin(map->precision, fmin(1e-3 * size, shortest(map, noise) / 2));
}

// --- what has no length left

/// The things of one cleaning that are left out.
typedef struct leaving {
    sl_context *context;
    const sl_map *map;
    double tolerance;
    size_t count;
} leaving;

enum { MOST_NOTES = 5 };

/// Whether a thing is left out. A note names it and its line.
static bool leave_out(leaving *work, const char *what, const char *name, sl_segment at,
                      uint32_t line) {
    char place[SL_LINE_TEXT], apart[SL_NUMBER_TEXT];
    if (!sli_same_point(at.a, at.b)) return false;
    if (++work->count > MOST_NOTES) return true;
    const char *source = sli_map_name(work->map);
    sl_map_say_line(work->map, line, place);
    snprintf(apart, sizeof apart, "%.3g", work->tolerance);
    char why[192] = "its ends are one place; make it longer";
    if (work->tolerance > 0)
        snprintf(why, sizeof why,
                 "its ends became one place, as ends up to %s apart do; make it longer, or give a "
                 "smaller tolerance (--weld)",
                 apart);
    sl_note(work->context, "%s: %s%s%s%s%s is left out: %s", source, place, line ? ": " : "", what,
            name ? " " : "", name ? name : "", why);
    return true;
}

static void leave_out_glass(leaving *work, const char *what, sl_glass *glass, size_t *count) {
    size_t kept = 0;
    for (size_t i = 0; i < *count; i++) {
        // As with other walls, nothing is lost.
        if (glass[i].stops && sli_same_point(glass[i].segment.a, glass[i].segment.b)) continue;
        if (!leave_out(work, what, NULL, glass[i].segment, glass[i].line)) glass[kept++] = glass[i];
    }
    *count = kept;
}

/// Doors, glass and seams without length: neither the map text nor the subdivision has a place for
/// them.
static void leave_out_short(sl_context *context, sl_map *map, double tolerance) {
    leaving work = {.context = context, .map = map, .tolerance = tolerance};
    size_t kept = 0;
    for (size_t i = 0; i < map->door_count; i++) {
        sl_door *door = &map->doors[i];
        if (!leave_out(&work, "door", door->name, door->segment, door->line)) {
            map->doors[kept++] = *door;
            continue;
        }
        sl_free(context, door->name);
        sl_free(context, door->parts);
    }
    map->door_count = kept;
    leave_out_glass(&work, "mirror", map->mirrors, &map->mirror_count);
    leave_out_glass(&work, "one-way glass", map->oneways, &map->oneway_count);
    leave_out_glass(&work, "seam", map->seams, &map->seam_count);
    if (work.count > MOST_NOTES)
        sl_note(context,
                "%zu more doors, mirrors, one-way glass or seams without length are left out",
                work.count - MOST_NOTES);
}

/// An axial map stays axial unless ends really miss each other. The planar graph shows whether
/// anything would move.
static sl_status clean(cleaning *work, sl_map *map, double weld) {
    const sl_box bounds = sl_map_bounds(map);
    const bool axial = sl_map_is_axial(map) && !(weld > 0) && !map->cell_count;
    const double precision = weld < 0 ? safe_precision(map, &bounds) : 0;
    if (weld < 0) weld = axial ? precision : fmax(sli_planar_tolerance(&bounds), precision);
    work->account.tolerance = fmax(weld, 2 * map->snap);
    SL_TRY(sort_out(work, map));
    SL_TRY(merge(work->context, &work->uprights, &work->account));
    SL_TRY(merge(work->context, &work->levels, &work->account));
    drop_duplicates(&work->others, &work->account);
    if (!axial) return clean_oblique(work, map, weld, NULL);
    bool idle = true;
    if (weld > 0) SL_TRY(clean_oblique(work, map, weld, &idle));
    return idle ? clean_axial(work, map) : SL_OK;
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
    if (status != SL_OK) return status;
    leave_out_short(context, map, work.account.tolerance);
    map->precision = 0; // every place is settled
    if (account) *account = work.account;
    return SL_OK;
}
