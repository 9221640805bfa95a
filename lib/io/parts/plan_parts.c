/// What is no wall, in a plan whose layers do not say so.
///
/// Most plans draw a wall by its two faces. All walls of a plan have a few thicknesses, so these
/// stand out among the distances between lines side by side, each taken as often as the lines are
/// long. Lines at such a distance are faces. Where there are many, a plan can be told from what
/// else is on the sheet:
///
///     +-------------------+  +--+     - a line across two faces or more is an axis, a dimension or
///     | +---------------+ |  |* |       a wire: a wall does not go through a wall
///     | |    o    []    | |  |# |     - pieces without faces beside the plan are legends, scales,
///  ---|-|---------------|-|  +--+       north arrows, dimensions
///     | +------+  +-----+ |           - small pieces without faces that touch nothing are
///     furniture
///     +--------+  +-------+             and symbols; but not a column, one small closed shape
///
/// A frame is a rectangle about all else that touches nothing of it, with a plan in it. Frames may
/// be double, and have the title in a corner.
///
/// All is measured along the longest wall, so that plans may be turned. What cannot be told is
/// kept.
#include "io/parts/plan_parts.h"

#include "geometry/length.h"
#include "io/parts/plan_net.h"
#include "io/parts/plan_tiles.h"

#include <math.h>
#include <string.h>

enum {
    LEAST_FACES = 16, ///< fewer lines say nothing
    BINS = 512,       ///< of distances
    MOST_THICKNESSES = 4,
    MOST_FRAMES = 256,     ///< rectangles that are looked at
    LEAST_OF_THICKNESS = 6 ///< pairs
};

/// Of a piece, by its first wall.
typedef struct piece_look {
    double faces, all; ///< lengths
    double sides[4];   ///< of what lies on the sides of its box
    sl_box rest;       ///< about what does not
    size_t *into;      ///< what its walls are counted for as they are dropped; NULL: it stays
    bool many;         ///< of several items
} piece_look;

typedef struct finder {
    sl_context *context;
    double metre;     ///< 0 where the plan is too large or too small for it
    sl_map turned;    ///< the walls that are left, along the longest one
    uint32_t *number; ///< of each in the map
    sli_plan_net net;
    sl_bits *faces; ///< of walls
    sl_bits *even;  ///< has a line on both sides at one distance: hatching, steps, tiles
    double thick[MOST_THICKNESSES];
    size_t thick_count;
    bool paired; ///< walls are drawn by their faces
    piece_look *looks;
    sl_box plan; ///< about the pieces with faces
    sli_plan_parts *out;
} finder;

static double wall_length(const sl_map *map, size_t wall) {
    const sl_wall *w = &map->walls[wall];
    return sli_length(w->b.x - w->a.x, w->b.y - w->a.y);
}

// --- the walls that are left, along the longest one

static sl_point turned(sl_point p, sl_point by) {
    return (sl_point){p.x * by.x + p.y * by.y, p.y * by.x - p.x * by.y};
}

/// Copies the walls that are not gone.
static void take_walls(finder *f, const sl_map *map) {
    double longest = 0;
    sl_point by = {1, 0};
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i];
        const double length = wall_length(map, i);
        if (!(length > longest)) continue;
        longest = length;
        by = (sl_point){(wall->b.x - wall->a.x) / length, (wall->b.y - wall->a.y) / length};
    }
    if (fabs(by.x) < 1e-9 || fabs(by.y) < 1e-9) by = (sl_point){1, 0};
    f->turned.wall_count = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        if (sl_bits_has(f->out->gone, i)) continue;
        f->number[f->turned.wall_count] = (uint32_t)i;
        sl_wall *wall = &f->turned.walls[f->turned.wall_count++];
        *wall = map->walls[i];
        wall->a = turned(wall->a, by);
        wall->b = turned(wall->b, by);
    }
}

static sl_status make_net(finder *f, const sl_map *map) {
    sli_plan_net_destroy(&f->net);
    take_walls(f, map);
    const sl_box bounds = sl_map_bounds(&f->turned);
    const double size = fmax(sli_box_width(bounds), sli_box_height(bounds));
    if (!(size > 4 * f->metre && size < 400 * f->metre)) f->metre = 0;
    const double least = f->metre > 0 ? 0.05 * f->metre : size / 1000;
    const double most = f->metre > 0 ? 0.6 * f->metre : size / 25;
    return sli_plan_net_make(f->context, &f->turned, least, most, 0, &f->net);
}

// --- faces of walls

/// How far a wall is at the left of another one.
static double at_left(const sl_wall *wall, const sl_wall *other) {
    const sl_point u = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
    const sl_point v = {other->a.x / 2 + other->b.x / 2 - wall->a.x,
                        other->a.y / 2 + other->b.y / 2 - wall->a.y};
    return sli_cross(u, v) / sli_length(u.x, u.y);
}

static void keep_nearest(double sides[2], double left) {
    double *side = &sides[left > 0];
    if (*side == 0 || fabs(left) < *side) *side = fabs(left);
}

/// Marks lines that have lines of much their length at one distance on both sides.
static sl_status find_even(finder *f) {
    const sl_wall *walls = f->turned.walls;
    const size_t count = f->turned.wall_count;
    double(*sides)[2] = sl_alloc_array(f->context, count, sizeof *sides);
    if (!sides) return SL_NO_MEMORY;
    for (size_t i = 0; i < f->net.pairs.count; i++) {
        const sli_plan_pair *pair = &f->net.pairs.items[i];
        const double a = wall_length(&f->turned, pair->wall);
        const double b = wall_length(&f->turned, pair->other);
        if (a > 1.25 * b || b > 1.25 * a) continue;
        keep_nearest(sides[pair->wall], at_left(&walls[pair->wall], &walls[pair->other]));
        keep_nearest(sides[pair->other], at_left(&walls[pair->other], &walls[pair->wall]));
    }
    for (size_t i = 0; i < count; i++)
        if (sides[i][0] > 0 && fabs(sides[i][0] - sides[i][1]) <= 0.05 * sides[i][0])
            sl_bits_add(f->even, i);
    sl_free(f->context, sides);
    return SL_OK;
}

/// Whether a pair may be the faces of a wall: far longer than thick.
static bool may_be_wall(const finder *f, const sli_plan_pair *pair) {
    return pair->along >= 2 * pair->away && !sl_bits_has(f->even, pair->wall) &&
           !sl_bits_has(f->even, pair->other);
}

static bool is_thickness(const finder *f, double away) {
    for (size_t i = 0; i < f->thick_count; i++)
        if (fabs(away - f->thick[i]) <= 0.04 * f->thick[i]) return true;
    return false;
}

/// Pairs at much the same distance.
typedef struct bin {
    double along, weighed; ///< their lengths, and the sum of these by the distance
    size_t count;
} bin;

/// What stands at a bin and next to it, up to 2 % away.
static bin around(const finder *f, const bin *bins, int at) {
    const int reach = (int)(0.02 * (BINS - 1) / log(f->net.most / f->net.least)) + 1;
    bin sum = {0};
    for (int i = at - reach; i <= at + reach; i++) {
        if (i < 0 || i >= BINS) continue;
        sum.along += bins[i].along;
        sum.weighed += bins[i].weighed;
        sum.count += bins[i].count;
    }
    return sum;
}

/// The distances that stand out, the commonest first.
static sl_status find_thicknesses(finder *f) {
    bin *bins = sl_alloc_array(f->context, BINS, sizeof *bins);
    if (!bins) return SL_NO_MEMORY;
    const double step = log(f->net.most / f->net.least) / (BINS - 1);
    double first = 0;
    for (size_t i = 0; i < f->net.pairs.count; i++) {
        const sli_plan_pair *pair = &f->net.pairs.items[i];
        if (!may_be_wall(f, pair)) continue;
        bin *own = &bins[(size_t)(log(pair->away / f->net.least) / step)];
        // Many walls count, not long ones: frames are long.
        const double along = fmin(pair->along, f->net.size / 10);
        own->along += along;
        own->weighed += along * pair->away;
        own->count++;
    }
    while (f->thick_count < MOST_THICKNESSES) {
        bin best = {0};
        for (int i = 0; i < BINS; i++) {
            const bin sum = around(f, bins, i);
            if (sum.count < LEAST_OF_THICKNESS || sum.along <= best.along) continue;
            if (!is_thickness(f, sum.weighed / sum.along)) best = sum;
        }
        if (!best.count || best.along < 0.3 * first) break;
        first = fmax(first, best.along);
        f->thick[f->thick_count++] = best.weighed / best.along;
    }
    sl_free(f->context, bins);
    return SL_OK;
}

/// Marks faces, and says whether walls are drawn by them.
static void find_faces(finder *f) {
    double faces = 0, all = 0;
    size_t count = 0;
    memset(f->faces, 0, sl_bits_words(f->turned.wall_count) * sizeof *f->faces);
    for (size_t i = 0; i < f->net.pairs.count; i++) {
        const sli_plan_pair *pair = &f->net.pairs.items[i];
        if (!may_be_wall(f, pair) || !is_thickness(f, pair->away)) continue;
        sl_bits_add(f->faces, pair->wall);
        sl_bits_add(f->faces, pair->other);
    }
    for (size_t i = 0; i < f->turned.wall_count; i++) {
        const double length = wall_length(&f->turned, i);
        const bool face = sl_bits_has(f->faces, i);
        count += face;
        if (face) faces += length;
        if (f->thick_count && length >= 2 * f->thick[0] && !sl_bits_has(f->even, i)) all += length;
    }
    f->paired = count >= LEAST_FACES && faces >= 0.25 * all;
}

// --- what is no wall

static bool is_gone(const finder *f, uint32_t wall) {
    return sl_bits_has(f->out->gone, f->number[wall]);
}

static void drop(finder *f, uint32_t wall, size_t *count) {
    sl_bits_add(f->out->gone, f->number[wall]);
    ++*count;
}

/// Drops the pieces that are to be.
static void drop_marked(finder *f) {
    for (uint32_t i = 0; i < f->turned.wall_count; i++) {
        size_t *into = f->looks[sl_root_of(f->net.piece, i)].into;
        if (into && !is_gone(f, i)) drop(f, i, into);
    }
}

/// Lines that are no faces, and cross two faces or more. Not those that run beside others for half
/// of their length: windows run through the columns of a wall.
static sl_status drop_across(finder *f) {
    const size_t count = f->turned.wall_count;
    uint32_t *crossed = sl_alloc_array(f->context, count, sizeof *crossed);
    double *along = sl_alloc_array(f->context, count, sizeof *along);
    for (size_t i = 0; crossed && along && i < f->net.crossings.count; i++) {
        const sli_plan_pair *at = &f->net.crossings.items[i];
        crossed[at->wall] += sl_bits_has(f->faces, at->other);
        crossed[at->other] += sl_bits_has(f->faces, at->wall);
    }
    for (size_t i = 0; crossed && along && i < f->net.pairs.count; i++) {
        along[f->net.pairs.items[i].wall] += f->net.pairs.items[i].along;
        along[f->net.pairs.items[i].other] += f->net.pairs.items[i].along;
    }
    for (uint32_t i = 0; crossed && along && i < count; i++)
        if (crossed[i] >= 2 && along[i] < 0.5 * wall_length(&f->turned, i) &&
            !sl_bits_has(f->faces, i) && !is_gone(f, i))
            drop(f, i, &f->out->across);
    const bool room = crossed && along;
    sl_free(f->context, crossed);
    sl_free(f->context, along);
    return room ? SL_OK : SL_NO_MEMORY;
}

// --- dimensions

/// The slash at the end of a dimension line: short and oblique, its middle on two lines or more.
static bool is_tick(const finder *f, uint32_t wall) {
    const sl_wall *w = &f->turned.walls[wall];
    const double length = wall_length(&f->turned, wall);
    const double most = f->metre > 0 ? 0.6 * f->metre : f->net.size / 50;
    return length <= most && !sl_bits_has(f->faces, wall) &&
           fmin(fabs(w->a.x - w->b.x), fabs(w->a.y - w->b.y)) >= 0.3 * length;
}

/// Whether a line that is no face is far longer than a tick, and has the tick's middle on it.
static bool is_ticked(const finder *f, uint32_t wall, sl_point at, double tick) {
    const sl_wall *w = &f->turned.walls[wall];
    const double length = wall_length(&f->turned, wall), slack = 0.1 * tick;
    const sl_point u = {(w->b.x - w->a.x) / length, (w->b.y - w->a.y) / length};
    const sl_point v = {at.x - w->a.x, at.y - w->a.y};
    return length > 2 * tick && !sl_bits_has(f->faces, wall) && fabs(sli_cross(u, v)) <= slack &&
           sli_dot(u, v) >= -slack && sli_dot(u, v) <= length + slack;
}

/// Counts ticks by the lines that they are on, or drops the lines about the ticks of dimensions.
static sl_status look_at_ticks(finder *f, uint32_t *ticks, bool dropping) {
    for (uint32_t i = 0; i < f->turned.wall_count; i++) {
        if (!is_tick(f, i)) continue;
        const sl_wall *w = &f->turned.walls[i];
        const sl_point at = {w->a.x / 2 + w->b.x / 2, w->a.y / 2 + w->b.y / 2};
        const double length = wall_length(&f->turned, i);
        bool ends = false;
        uint32_t on = 0;
        SL_TRY(sli_walls_near(f->context, &f->net.index, (sl_segment){at, at}, 0.1 * length));
        for (size_t k = 0; k < f->net.index.near.count; k++) {
            const uint32_t j = f->net.index.near.items[k];
            if (j == i || !is_ticked(f, j, at, length)) continue;
            on++;
            ends |= ticks[j] >= 2;
        }
        if (on < 2 || (dropping && !ends)) continue;
        for (size_t k = 0; k < f->net.index.near.count; k++) {
            const uint32_t j = f->net.index.near.items[k];
            if (j == i || !is_ticked(f, j, at, length)) continue;
            if (!dropping)
                ticks[j]++;
            else if (!is_gone(f, j))
                drop(f, j, &f->out->dimensions);
        }
        if (dropping && !is_gone(f, i)) drop(f, i, &f->out->dimensions);
    }
    return SL_OK;
}

/// Dimension lines with two ticks or more, the ticks, and the lines that lead to them.
static sl_status drop_dimensions(finder *f) {
    uint32_t *ticks = sl_alloc_array(f->context, f->turned.wall_count, sizeof *ticks);
    if (!ticks) return SL_NO_MEMORY;
    sl_status status = look_at_ticks(f, ticks, false);
    if (status == SL_OK) status = look_at_ticks(f, ticks, true);
    sl_free(f->context, ticks);
    return status;
}

static double longer_side(sl_box box) {
    return fmax(sli_box_width(box), sli_box_height(box));
}

static double area_of(sl_box box) {
    return sli_box_width(box) * sli_box_height(box);
}

/// Whether a piece is drawn as walls: a third of it is faces.
static bool has_walls(const finder *f, uint32_t piece) {
    return f->looks[piece].faces >= 0.3 * f->looks[piece].all;
}

/// Adds a wall to what is known of its piece.
static void measure_wall(finder *f, uint32_t i) {
    const uint32_t piece = sl_root_of(f->net.piece, i);
    const sl_wall *wall = &f->turned.walls[i];
    const sl_box box = f->net.boxes[piece];
    const double length = wall_length(&f->turned, i), off = f->net.tolerance;
    piece_look *look = &f->looks[piece];
    look->all += length;
    if (sl_bits_has(f->faces, i)) look->faces += length;
    look->many |= wall->line != f->turned.walls[piece].line;
    if (fmax(fabs(wall->a.x - box.min.x), fabs(wall->b.x - box.min.x)) <= off)
        look->sides[0] += length;
    else if (fmax(fabs(wall->a.x - box.max.x), fabs(wall->b.x - box.max.x)) <= off)
        look->sides[1] += length;
    else if (fmax(fabs(wall->a.y - box.min.y), fabs(wall->b.y - box.min.y)) <= off)
        look->sides[2] += length;
    else if (fmax(fabs(wall->a.y - box.max.y), fabs(wall->b.y - box.max.y)) <= off)
        look->sides[3] += length;
    else
        look->rest = sli_box_with(sli_box_with(look->rest, wall->a), wall->b);
}

static void measure_pieces(finder *f) {
    const size_t count = f->turned.wall_count;
    const sl_box none = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = 0; i < count; i++) f->looks[i] = (piece_look){.rest = none};
    for (uint32_t i = 0; i < count; i++) measure_wall(f, i);
    f->plan = none;
    for (uint32_t i = 0; i < count; i++)
        if (sl_root_of(f->net.piece, i) == i && has_walls(f, i))
            f->plan = sli_box_with(sli_box_with(f->plan, f->net.boxes[i].min), f->net.boxes[i].max);
}

static bool is_beside(sl_box a, sl_box b) {
    return a.max.x < b.min.x || a.min.x > b.max.x || a.max.y < b.min.y || a.min.y > b.max.y;
}

/// One closed shape, or four lines.
static bool is_simple(const finder *f, uint32_t piece) {
    const uint32_t count = f->net.counts[piece];
    return (!f->looks[piece].many || count == 4) && count >= 3;
}

/// Whether a piece that touches nothing may be a wall: a column or an obstacle, a small room, or
/// thin as walls and windows are.
static bool may_stand(const finder *f, uint32_t piece, bool obstacles) {
    const sl_box box = f->net.boxes[piece];
    const double w = sli_box_width(box), h = sli_box_height(box);
    const double thin = fmin(w, h), wide = fmax(w, h);
    double thickest = 0;
    for (size_t i = 0; i < f->thick_count; i++) thickest = fmax(thickest, f->thick[i]);
    if (thin <= 1.2 * thickest && wide >= 3 * thin) return true;
    if (!is_simple(f, piece)) return false;
    return obstacles || wide <= 3 * thickest || (f->metre > 0 && thin >= f->metre);
}

/// A small piece without faces in the plan.
static bool is_loose(const finder *f, uint32_t piece) {
    const double plan = longer_side(f->plan), own = longer_side(f->net.boxes[piece]);
    return sl_root_of(f->net.piece, piece) == piece && !has_walls(f, piece) &&
           !is_beside(f->net.boxes[piece], f->plan) &&
           own <= (f->metre > 0 ? fmin(plan / 5, 3.5 * f->metre) : plan / 12);
}

/// Pieces without faces beside the plan, and small ones in it.
static void drop_pieces(finder *f) {
    size_t loose = 0, simple = 0;
    for (uint32_t i = 0; i < f->turned.wall_count; i++) {
        if (!is_loose(f, i)) continue;
        loose++;
        simple += is_simple(f, i);
    }
    // Where nearly all of them are plain boxes, that is how the plan draws obstacles.
    const bool obstacles = 5 * simple >= 4 * loose;
    for (uint32_t i = 0; i < f->turned.wall_count; i++) {
        if (sl_root_of(f->net.piece, i) != i || has_walls(f, i)) continue;
        const sl_box box = f->net.boxes[i];
        if (is_beside(box, f->plan)) {
            if (longer_side(box) < longer_side(f->plan) && area_of(box) <= area_of(f->plan))
                f->looks[i].into = &f->out->beside;
        } else if (is_loose(f, i) && !may_stand(f, i, obstacles)) {
            f->looks[i].into = &f->out->loose;
            f->out->pieces++;
        }
    }
    drop_marked(f);
}

// --- frames

/// A piece that covers the four sides of its box; what else it has lies in a part of it, as the
/// title of a sheet does.
static bool is_rectangle(const finder *f, uint32_t piece) {
    const piece_look *look = &f->looks[piece];
    const double w = sli_box_width(f->net.boxes[piece]), h = sli_box_height(f->net.boxes[piece]);
    const bool small = look->rest.min.x > look->rest.max.x || area_of(look->rest) <= w * h / 3;
    return w > 0 && h > 0 && small && look->sides[0] >= 0.95 * h && look->sides[1] >= 0.95 * h &&
           look->sides[2] >= 0.95 * w && look->sides[3] >= 0.95 * w;
}

/// Whether a rectangle has nothing beside its sides.
static bool is_plain(const finder *f, uint32_t piece) {
    return f->looks[piece].rest.min.x > f->looks[piece].rest.max.x;
}

/// Whether what a rectangle has beside its sides lies in a corner of it: titles do, and few of the
/// rooms in a house.
static bool has_title(const finder *f, uint32_t piece) {
    const sl_box box = f->net.boxes[piece], rest = f->looks[piece].rest;
    const double off = f->net.tolerance;
    return !is_plain(f, piece) &&
           (rest.min.x <= box.min.x + off || rest.max.x >= box.max.x - off) &&
           (rest.min.y <= box.min.y + off || rest.max.y >= box.max.y - off);
}

static bool is_within(sl_box inner, sl_box outer, double room) {
    return inner.min.x >= outer.min.x + room && inner.max.x <= outer.max.x - room &&
           inner.min.y >= outer.min.y + room && inner.max.y <= outer.max.y - room;
}

/// Whether a rectangle is the frame of a sheet: it holds a plan, with room about it. Where walls
/// are not drawn by their faces, it must hold all else, and a plan is a large piece. Only in a
/// frame with a title may the plan be a rectangle: else it may be the core of a hall.
static bool is_frame(const finder *f, uint32_t piece, const sl_bits *rectangles) {
    const sl_box box = f->net.boxes[piece];
    const double room = longer_side(box) / 50;
    sl_box plan = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    const bool titled = has_title(f, piece);
    bool large = false;
    for (uint32_t i = 0; i < f->turned.wall_count; i++) {
        if (sl_root_of(f->net.piece, i) != i) continue;
        const sl_box own = f->net.boxes[i];
        const bool near = !is_within(own, box, room);
        if (sl_bits_has(rectangles, i) && (near || !titled || is_plain(f, i) || has_title(f, i)))
            continue;
        if (f->paired ? near && is_within(own, box, 0) && has_walls(f, i) : near) return false;
        if (near || f->net.counts[i] < 8) continue;
        large |= sli_box_width(own) >= 0.4 * sli_box_width(box) &&
                 sli_box_height(own) >= 0.4 * sli_box_height(box);
        if (has_walls(f, i)) plan = sli_box_with(sli_box_with(plan, own.min), own.max);
    }
    return f->paired ? longer_side(plan) >= 0.2 * longer_side(box) : large;
}

/// Drops frames. A rectangle that is side by side with something else than a rectangle is a wall.
static sl_status drop_frames(finder *f) {
    const uint32_t count = (uint32_t)f->turned.wall_count;
    sl_bits *rectangles = sl_alloc_array(f->context, sl_bits_words(count), sizeof *rectangles);
    sl_bits *walls = sl_alloc_array(f->context, sl_bits_words(count), sizeof *walls);
    const bool room = rectangles && walls;
    for (uint32_t i = 0; room && i < count; i++)
        if (sl_root_of(f->net.piece, i) == i && f->net.counts[i] >= 4 && is_rectangle(f, i))
            sl_bits_add(rectangles, i);
    for (size_t i = 0; room && i < f->net.pairs.count; i++) {
        const uint32_t a = sl_root_of(f->net.piece, f->net.pairs.items[i].wall);
        const uint32_t b = sl_root_of(f->net.piece, f->net.pairs.items[i].other);
        if (a == b || f->net.pairs.items[i].along < 0.25 * f->net.size / 4) continue;
        const bool any = !f->paired;
        if (!sl_bits_has(rectangles, b) && (any || has_walls(f, b))) sl_bits_add(walls, a);
        if (!sl_bits_has(rectangles, a) && (any || has_walls(f, a))) sl_bits_add(walls, b);
    }
    size_t looked = 0;
    for (uint32_t i = 0; room && i < count && looked < MOST_FRAMES; i++) {
        if (!sl_bits_has(rectangles, i) || sl_bits_has(walls, i)) continue;
        if (longer_side(f->net.boxes[i]) < f->net.size / 20) continue;
        looked++;
        if (is_frame(f, i, rectangles)) f->looks[i].into = &f->out->frame;
    }
    drop_marked(f);
    sl_free(f->context, rectangles);
    sl_free(f->context, walls);
    return room ? SL_OK : SL_NO_MEMORY;
}

// --- what is left

/// How much of what is left are no faces and no ends of walls, by its length: it may be wires,
/// counters, steps, or walls drawn by one line.
static void measure_rest(finder *f) {
    double rest = 0, all = 0;
    for (uint32_t i = 0; i < f->turned.wall_count; i++) {
        const double length = wall_length(&f->turned, i);
        if (is_gone(f, i)) continue;
        all += length;
        double thickest = 0;
        for (size_t k = 0; k < f->thick_count; k++) thickest = fmax(thickest, f->thick[k]);
        if (!sl_bits_has(f->faces, i) && length > 1.2 * thickest) rest += length;
    }
    f->out->rest = all > 0 ? rest / all : 0;
}

// --- all

/// The net of the walls that are left, and its faces. `first`: thicknesses are to be found.
static sl_status look(finder *f, const sl_map *map, bool first) {
    SL_TRY(make_net(f, map));
    if (!f->net.whole || !(f->net.most > 0)) return SL_OK;
    memset(f->even, 0, sl_bits_words(map->wall_count) * sizeof *f->even);
    SL_TRY(find_even(f));
    if (first) SL_TRY(find_thicknesses(f));
    find_faces(f);
    measure_pieces(f);
    return SL_OK;
}

/// Tiles of floors, by a net of all walls.
static sl_status drop_tiles(finder *f, const sl_map *map) {
    SL_TRY(make_net(f, map));
    sl_bits *tiles = sl_alloc_array(f->context, sl_bits_words(map->wall_count), sizeof *tiles);
    size_t count = 0;
    const sl_status status = tiles ? sli_plan_tiles_find(&f->net, tiles, &count) : SL_NO_MEMORY;
    for (uint32_t i = 0; status == SL_OK && count && i < map->wall_count; i++)
        if (sl_bits_has(tiles, i)) drop(f, i, &f->out->tiles);
    sl_free(f->context, tiles);
    return status;
}

static sl_status find_all(finder *f, const sl_map *map) {
    SL_TRY(drop_tiles(f, map));
    SL_TRY(look(f, map, true));
    if (!f->net.whole || !(f->net.most > 0)) return SL_OK;
    SL_TRY(drop_dimensions(f));
    if (f->out->dimensions) SL_TRY(look(f, map, false));
    SL_TRY(drop_frames(f));
    if (f->paired) SL_TRY(drop_across(f));
    if (f->out->across || f->out->frame) SL_TRY(look(f, map, false));
    if (f->paired && f->net.whole) drop_pieces(f);
    if (f->paired && f->net.whole) measure_rest(f);
    return SL_OK;
}

sl_status sli_plan_parts_find(sl_context *context, const sl_map *map, double metre,
                              sli_plan_parts *out) {
    const size_t count = map->wall_count;
    finder f = {.context = context, .metre = metre, .out = out};
    if (count < LEAST_FACES) return SL_OK;
    out->gone = sl_alloc_array(context, sl_bits_words(count), sizeof *out->gone);
    f.turned.walls = sl_alloc_array(context, count, sizeof *f.turned.walls);
    f.number = sl_alloc_array(context, count, sizeof *f.number);
    f.faces = sl_alloc_array(context, sl_bits_words(count), sizeof *f.faces);
    f.even = sl_alloc_array(context, sl_bits_words(count), sizeof *f.even);
    f.looks = sl_alloc_array(context, count, sizeof *f.looks);
    sl_status status = SL_NO_MEMORY;
    if (out->gone && f.turned.walls && f.number && f.faces && f.even && f.looks)
        status = find_all(&f, map);
    sli_plan_net_destroy(&f.net);
    sl_free(context, f.turned.walls);
    sl_free(context, f.number);
    sl_free(context, f.faces);
    sl_free(context, f.even);
    sl_free(context, f.looks);
    return status;
}

void sli_plan_parts_destroy(sl_context *context, sli_plan_parts *parts) {
    sl_free(context, parts->gone);
    *parts = (sli_plan_parts){0};
}
