/// What is inside of a map that has no start: what a disc of the width of an entrance cannot enter
/// from outside.
///
/// Walls and channels (channels.h) cut the free ground into triangles. The widest disc that gets
/// from outside to a triangle is known as a spanning tree is made (Kruskal 1956): sides join
/// triangles, the widest first, and what is joined to the outside by a side of width w has the
/// *access* w. Behind an entrance all is of one access, up to the next narrower door:
///
///     +------------+-----+
///     |    1.2      0.8  |       a house: access 1.2 behind the entrance, 0.8 behind the inner
///     |            +-----+       door, 0 in the cores of walls, and the outside has no limit
///     +---   ------+
///
/// With a width W, triangles of access W or less, joined, are *parts*. A part counts as inside if a
/// disc of W/2 fits in it, so that cores of walls do not. If it has an opening, it must be roomier
/// than the opening: else it is a niche or an alley. In cores of thick walls such a disc fits, too.
/// So a closed part beside parts with openings must be short if it is narrower than W.
///
/// W is what the map says, or 1.2 m if its unit is known, or by the doors that a drawing shows.
/// Else it is found. Every *pocket* (triangles of one access that are roomier than it) tells of an
/// opening, and W is the largest below the greatest step in their widths. What is inside then must
/// have a third of the sides of walls that can be reached at all. If it has less, the map is no
/// building, and nothing is found.
///
/// A pocket with a somewhat wider opening may be a hall whose rooms are inside. So may what all
/// openings of a part lead to, as a corridor with an open end. This is a doubt: then such rooms do
/// not count, unless the map says W. In plans that are drawn (sl_map.entrance_may_be_wide), such an
/// opening is tried as W first, and counts if it leaves no doubt.
///
/// Where a part that is inside ends at a channel, the map gets a seam. So no cell lies on both
/// sides. Time O(n log n), and what channels take.
#include "sightline/space.h"
#include "sightline/support.h"
#include "space/clearance.h"
#include "space/kd_tree.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "map/scan.h"
#include "map/source.h"
#include "map/unit.h"

#include <stdlib.h>
#include <string.h>

#define NONE    UINT32_MAX
#define NOWHERE ((sl_point){NAN, NAN})

/// Usual entrances, in metres, and the share of their width that doors have.
#define ENTRANCE 1.2
#define DOORS    0.7
/// Openings up to so many times W are doubtful. A width that is found is that of a narrow door.
#define DOUBT       2.5
#define DOUBT_FOUND 3.5
/// Slits are narrower than this share of the map, and no entrances.
#define SLIT 1000
/// Entrances of a plan are wider than this share of it.
#define DOORS_IN_PLAN 100
/// How much roomier than its opening a part or pocket is.
#define ROOMIER (4.0 / 3)
/// How much less roomy than other places cores of walls are.
#define CORE 16
/// How much less roomy than niches outdoors rooms are.
#define ROOMY 4
/// How long, by the square root of their area, the walls around a core are: 4 around a square, 4.5
/// around a rectangle that is 2.6 times as long as wide, 6.4 around one of 8 times.
#define CORE_AT_JAMB  4.5
#define CORE_ANYWHERE 6.4

/// Triangles that belong together.
typedef struct group {
    uint32_t first, count; ///< in `order`
    double access;         ///< the largest of its triangles
    double area, reached;  ///< `reached`: the length of walls around it
    sl_point place;        ///< far from walls
    double clearance;      ///< there
    bool inside;
} group;

/// The points between which an opening is.
typedef struct opening {
    uint32_t from, to;
} opening;

typedef struct finder {
    sl_context *context;
    sl_map *map;
    double weld;
    sl_box bounds;
    sl_box border; ///< of the space: farther out where the map ends at a window
    double doubt;  ///< openings up to this width are doubtful; 0: by the width of entrances
    sli_channels channels;
    sli_clearance clearance;
    uint32_t *triangle; ///< by half-edge; NONE outside of the box
    uint32_t *half;     ///< by triangle: one of its half-edges
    uint32_t count;
    double *access; ///< by triangle
    uint32_t *parent, *following;
    uint32_t *group_of, *order;
    SL_ARRAY(group) groups;
    SL_ARRAY(opening) openings; ///< the doubtful ones
    sl_interior found;
} finder;

static const sli_triangulation *triangles(const finder *f) {
    return &f->channels.triangles;
}

static sl_point start_of(const finder *f, uint32_t half) {
    return triangles(f)->points.items[triangles(f)->halves.items[half].from];
}

static uint32_t label_of(const finder *f, uint32_t half) {
    return f->channels.label[half / 2];
}

static double side_length(const finder *f, uint32_t half) {
    const sl_point a = start_of(f, half), b = start_of(f, half ^ 1);
    return sli_length(b.x - a.x, b.y - a.y);
}

/// How wide doubtful openings are.
static double doubtful_up_to(const finder *f, double width) {
    if (f->found.by == SL_ENTRANCE_WIDE) return fmax(width, f->doubt);
    return (f->found.by == SL_ENTRANCE_FOUND ? DOUBT_FOUND : DOUBT) * width;
}

// --- access

static sl_status number_triangles(finder *f) {
    const sli_half_edge *halves = triangles(f)->halves.items;
    const size_t count = triangles(f)->halves.count;
    f->triangle = sl_alloc_array(f->context, count, sizeof *f->triangle);
    f->half = sl_alloc_array(f->context, count / 3 + 1, sizeof *f->half);
    if (!f->triangle || !f->half) return SL_NO_MEMORY;
    memset(f->triangle, 0xff, count * sizeof *f->triangle);
    for (uint32_t i = 0; i < count; i++) {
        if (sli_half_is_outside(triangles(f), i) || f->triangle[i] != NONE) continue;
        f->half[f->count] = i;
        uint32_t half = i;
        for (int k = 0; k < 3; k++, half = halves[half].next) f->triangle[half] = f->count;
        f->count++;
    }
    const size_t all = (size_t)f->count + 1;
    f->access = sl_alloc_array(f->context, all, sizeof *f->access);
    f->parent = sl_alloc_array(f->context, all, sizeof *f->parent);
    f->following = sl_alloc_array(f->context, all, sizeof *f->following);
    f->group_of = sl_alloc_array(f->context, all, sizeof *f->group_of);
    f->order = sl_alloc_array(f->context, all, sizeof *f->order);
    return f->access && f->parent && f->following && f->group_of && f->order ? SL_OK : SL_NO_MEMORY;
}

/// Joins the sets of two triangles. The outside, which has the last number, stays a root. Sets are
/// also rings of `following`.
static void join(finder *f, uint32_t a, uint32_t b, double width) {
    uint32_t into = sl_root_of(f->parent, a), other = sl_root_of(f->parent, b);
    if (into == other) return;
    if (other == f->count) {
        other = into;
        into = f->count;
    }
    if (into == f->count) {
        uint32_t each = other;
        do f->access[each] = width;
        while ((each = f->following[each]) != other);
    }
    f->parent[other] = into;
    const uint32_t after = f->following[into];
    f->following[into] = f->following[other];
    f->following[other] = after;
}

/// Joins across one side; beyond the box is outside.
static void join_across(finder *f, uint32_t edge, double width) {
    const uint32_t a = f->triangle[2 * edge], b = f->triangle[2 * edge + 1];
    join(f, a == NONE ? f->count : a, b == NONE ? f->count : b, width);
}

/// An edge, by the width of its channel.
typedef struct width_of_edge {
    double width;
    uint32_t edge;
} width_of_edge;

static int compare_widths(const void *left, const void *right) {
    const width_of_edge *a = left, *b = right;
    if (a->width != b->width) return a->width > b->width ? -1 : 1;
    return (a->edge > b->edge) - (a->edge < b->edge);
}

static sl_status find_access(finder *f) {
    const size_t edges = triangles(f)->halves.count / 2;
    width_of_edge *sorted = sl_alloc_array(f->context, edges, sizeof *sorted);
    size_t count = 0;
    if (!sorted) return SL_NO_MEMORY;
    for (uint32_t i = 0; i <= f->count; i++) {
        f->parent[i] = f->following[i] = i;
        f->access[i] = 0;
    }
    for (uint32_t i = 0; i < edges; i++) {
        const uint32_t label = f->channels.label[i];
        if (label == SLI_FREE)
            join_across(f, i, INFINITY);
        else if (label != SLI_WALL)
            sorted[count++] = (width_of_edge){f->channels.items.items[label].width, i};
    }
    if (count) qsort(sorted, count, sizeof *sorted, compare_widths);
    for (size_t i = 0; i < count; i++) join_across(f, sorted[i].edge, sorted[i].width);
    sl_free(f->context, sorted);
    return SL_OK;
}

// --- groups

/// Which triangles make groups: those of an access from `least` to `most`; of one access, or of
/// any.
typedef struct choice {
    double least, most;
    bool same;
} choice;

static bool chosen(const finder *f, const choice *c, uint32_t triangle) {
    return f->access[triangle] >= c->least && f->access[triangle] <= c->most;
}

static double area_of(const finder *f, uint32_t half) {
    const sli_half_edge *halves = triangles(f)->halves.items;
    const sl_point a = start_of(f, half), b = start_of(f, half ^ 1);
    const sl_point c = start_of(f, halves[halves[half].next].next);
    return sli_cross((sl_point){b.x - a.x, b.y - a.y}, (sl_point){c.x - a.x, c.y - a.y}) / 2;
}

/// Takes a triangle, and its neighbours that belong to the same group, into it.
static sl_status take_triangle(finder *f, const choice *c, uint32_t triangle, uint32_t number) {
    group *g = &f->groups.items[number];
    uint32_t half = f->half[triangle];
    double clearance;
    sl_point place;
    g->access = fmax(g->access, f->access[triangle]);
    g->area += area_of(f, half);
    SL_TRY(sli_clearance_of(&f->clearance, half, g->clearance, &place, &clearance));
    if (clearance > g->clearance && sli_box_holds(&f->bounds, place)) {
        g->clearance = clearance;
        g->place = place;
    }
    for (int i = 0; i < 3; i++, half = triangles(f)->halves.items[half].next) {
        const uint32_t other = f->triangle[half ^ 1];
        if (label_of(f, half) == SLI_WALL) {
            g->reached += side_length(f, half);
            continue;
        }
        if (other == NONE || f->group_of[other] != NONE || !chosen(f, c, other) ||
            (c->same && f->access[other] != f->access[triangle]))
            continue;
        f->group_of[other] = number;
        f->order[g->first + g->count++] = other;
    }
    return SL_OK;
}

static sl_status gather(finder *f, choice c) {
    uint32_t end = 0;
    f->groups.count = 0;
    for (uint32_t i = 0; i < f->count; i++) f->group_of[i] = NONE;
    for (uint32_t i = 0; i < f->count; i++) {
        if (f->group_of[i] != NONE || !chosen(f, &c, i)) continue;
        const uint32_t number = (uint32_t)f->groups.count;
        SL_TRY(SL_ARRAY_ROOM(f->context, &f->groups, 1));
        f->groups.items[f->groups.count++] =
            (group){.first = end, .count = 1, .access = 0, .clearance = -1};
        f->group_of[i] = number;
        f->order[end] = i;
        for (; end < f->groups.items[number].first + f->groups.items[number].count; end++)
            SL_TRY(take_triangle(f, &c, f->order[end], number));
        SL_TRY(sl_check_cancelled(f->context));
    }
    return SL_OK;
}

/// Whether a disc fits in a group.
static sl_status fits(finder *f, group *g, double width, bool *out) {
    *out = 2 * g->clearance >= width;
    for (uint32_t i = 0; i < g->count && !*out; i++) {
        const uint32_t half = f->half[f->order[g->first + i]];
        SL_TRY(sli_clearance_reaches(&f->clearance, half, width / 2, &g->place, out));
        if (*out) g->clearance = width / 2;
    }
    return SL_OK;
}

// --- the width

/// Sorts out channels by the exact width: their rounded ones then agree with it.
static void settle_widths(finder *f, double width) {
    for (size_t i = 0; i < f->channels.items.count; i++) {
        sli_channel *each = &f->channels.items.items[i];
        const bool stops = sli_channel_stops(each, width);
        if (stops && each->width > width) each->width = width;
        if (!stops && each->width <= width) each->width = nextafter(width, INFINITY);
    }
}

/// Drops widths of slits, where there are others: walls that were meant to meet.
static size_t drop_slits(double *widths, size_t count, double slit) {
    size_t wide = 0;
    for (size_t i = 0; i < count; i++) wide += widths[i] > slit;
    if (!wide) return count;
    wide = 0;
    for (size_t i = 0; i < count; i++)
        if (widths[i] > slit) widths[wide++] = widths[i];
    return wide;
}

/// The number before the greatest step, by ratio; up to `most`.
static double before_step(double *numbers, size_t count, double most) {
    double best = 0, step = 1;
    if (count) qsort(numbers, count, sizeof *numbers, sl_compare_numbers);
    for (size_t i = 0; i < count; i++) {
        const double own = (i + 1 < count ? numbers[i + 1] : most) / numbers[i];
        if (own < step) continue;
        step = own;
        best = numbers[i];
    }
    return best;
}

/// Finds the width of entrances by pockets; 0 for none. Pockets that are small against the map do
/// not count.
static sl_status find_width(finder *f, double most, double *out) {
    const double width = f->bounds.max.x - f->bounds.min.x,
                 height = f->bounds.max.y - f->bounds.min.y;
    SL_TRY(gather(f, (choice){.least = 0x1p-1000, .most = most, .same = true}));
    double *widths = sl_alloc_array(f->context, f->groups.count, sizeof *widths);
    size_t count = 0;
    sl_status status = widths ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < f->groups.count && status == SL_OK; i++) {
        group *g = &f->groups.items[i];
        bool roomier = false;
        if (g->area < width * height / 200) continue;
        status = fits(f, g, ROOMIER * g->access, &roomier);
        if (roomier) widths[count++] = g->access;
    }
    const double slit = fmax(width, height) / SLIT;
    count = drop_slits(widths, status == SL_OK ? count : 0, slit);
    const double best = status == SL_OK ? before_step(widths, count, most) : 0;
    // Where there are only slits, all of them are entrances: many are no wider than rounding.
    double widest = best > 0 ? fmax(best, fmin(slit, most)) : 0;
    // Both faces of a door frame are openings.
    for (size_t i = 0; i < f->groups.count; i++)
        if (f->groups.items[i].access <= 1.01 * best)
            widest = fmax(widest, f->groups.items[i].access);
    *out = sli_rounded_up(widest);
    sl_free(f->context, widths);
    return status;
}

// --- parts that are inside

/// Whether the map says what is solid: then what walls enclose is inside, however narrow.
static bool says_ground(const sl_map *map) {
    bool any = false;
    for (size_t i = 0; i < map->wall_count; i++) any |= map->walls[i].ground != 0;
    return any;
}

/// Whether each wall says what is solid and what is open: then all that is open is inside.
static bool knows_ground(const sl_map *map) {
    const uint32_t left = SL_SOLID_LEFT | SL_OPEN_RIGHT, right = SL_SOLID_RIGHT | SL_OPEN_LEFT;
    bool all = true;
    for (size_t i = 0; i < map->wall_count; i++) {
        const uint32_t ground = map->walls[i].ground;
        all &= (ground & left) == left || (ground & right) == right;
    }
    return all;
}

/// Whether a side of a group is the jamb of an opening: both of its ends are in `ends`.
static bool has_jamb(const finder *f, const group *g, const sl_bits *ends) {
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = triangles(f)->halves.items[half].next)
            if (label_of(f, half) == SLI_WALL &&
                sl_bits_has(ends, triangles(f)->halves.items[half].from) &&
                sl_bits_has(ends, sli_half_end(triangles(f), half)))
                return true;
    }
    return false;
}

/// Leaves out cores of walls so thick that half a disc fits: they are narrower than W, and long.
static sl_status drop_cores(finder *f, double width) {
    const sli_half_edge *halves = triangles(f)->halves.items;
    sl_bits *ends =
        sl_alloc_array(f->context, sl_bits_words(triangles(f)->points.count), sizeof *ends);
    sl_status status = ends ? SL_OK : SL_NO_MEMORY;
    for (uint32_t half = 0; half < triangles(f)->halves.count && ends; half++) {
        const uint32_t label = label_of(f, half), own = f->triangle[half];
        if (label == SLI_WALL || label == SLI_FREE || own == NONE || f->access[own] == 0 ||
            f->channels.items.items[label].width > width)
            continue;
        sl_bits_add(ends, halves[half].from);
        sl_bits_add(ends, halves[half ^ 1].from);
    }
    for (size_t i = 0; i < f->openings.count && ends; i++) {
        sl_bits_add(ends, f->openings.items[i].from);
        sl_bits_add(ends, f->openings.items[i].to);
    }
    for (size_t i = 0; i < f->groups.count && status == SL_OK; i++) {
        group *g = &f->groups.items[i];
        if (!g->inside || g->access > 0 || g->reached < CORE_AT_JAMB * sqrt(g->area)) continue;
        if (g->reached < CORE_ANYWHERE * sqrt(g->area) && !has_jamb(f, g, ends)) continue;
        status = fits(f, g, width, &g->inside);
    }
    sl_free(f->context, ends);
    return status;
}

static sl_status choose_parts(finder *f, double width) {
    const bool ground = says_ground(f->map);
    bool opened = f->found.doubtful_width > 0;
    SL_TRY(gather(f, (choice){.least = 0, .most = width}));
    for (size_t i = 0; i < f->groups.count; i++) {
        group *g = &f->groups.items[i];
        double wanted = fmax(width / 2, ROOMIER * g->access);
        if (ground && g->access == 0) wanted = 0;
        SL_TRY(fits(f, g, wanted, &g->inside));
        opened |= g->inside && g->access > 0;
    }
    return opened && !ground ? drop_cores(f, width) : SL_OK;
}

// --- doubts

/// Finds the half-edge by which a pocket is entered.
static uint32_t opening_of(const finder *f, const group *g) {
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = triangles(f)->halves.items[half].next) {
            const uint32_t label = label_of(f, half), other = f->triangle[half ^ 1];
            if (label != SLI_WALL && label != SLI_FREE &&
                f->channels.items.items[label].width == g->access &&
                (other == NONE || f->access[other] > g->access))
                return half;
        }
    }
    return NONE;
}

/// Marks what can be reached from a pocket through sides of an access up to `most`: 1 in `marks`.
static sl_status mark_around(finder *f, const group *g, double most, uint8_t *marks) {
    SL_ARRAY(uint32_t) stack = {0};
    sl_status status = SL_OK;
    const uint32_t first = f->order[g->first];
    if (!marks[first]) status = SL_ARRAY_ROOM(f->context, &stack, 1);
    if (!marks[first] && status == SL_OK) stack.items[stack.count++] = first;
    marks[first] = 1;
    while (stack.count && status == SL_OK) {
        uint32_t half = f->half[stack.items[--stack.count]];
        for (int i = 0; i < 3; i++, half = triangles(f)->halves.items[half].next) {
            const uint32_t other = f->triangle[half ^ 1];
            if (label_of(f, half) == SLI_WALL || other == NONE || marks[other] ||
                f->access[other] > most)
                continue;
            status = SL_ARRAY_ROOM(f->context, &stack, 1);
            if (status != SL_OK) break;
            marks[other] = 1;
            stack.items[stack.count++] = other;
        }
    }
    sl_free(f->context, stack.items);
    return status;
}

/// Where somebody comes to who leaves a part: the triangle with the largest access. NONE: outside.
static uint32_t way_out_of(const finder *f, const group *g) {
    uint32_t best = NONE;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = triangles(f)->halves.items[half].next) {
            const uint32_t other = f->triangle[half ^ 1];
            if (label_of(f, half) == SLI_WALL || (other != NONE && f->group_of[other] != NONE))
                continue;
            if (other == NONE) return NONE;
            if (best == NONE || f->access[other] > f->access[best]) best = other;
        }
    }
    return best;
}

/// Finds halls: what all ways out of a part lead to, with an opening somewhat wider than the width.
/// A corridor with an open end is one, though it is no wider than its opening. 1 in `halls`, by
/// triangle.
static sl_status find_halls(finder *f, double width, uint8_t *halls) {
    SL_TRY(choose_parts(f, width));
    for (size_t i = 0; i < f->groups.count; i++) {
        const group *g = &f->groups.items[i];
        const uint32_t out = g->inside && g->access > 0 ? way_out_of(f, g) : NONE;
        if (out != NONE && f->access[out] <= doubtful_up_to(f, width)) halls[out] = 1;
    }
    return SL_OK;
}

static bool has_hall(const finder *f, const group *g, const uint8_t *halls) {
    for (uint32_t i = 0; i < g->count; i++)
        if (halls[f->order[g->first + i]]) return true;
    return false;
}

/// Looks for halls, and for pockets with an opening somewhat wider than the width. `marks` gets all
/// that is about them.
static sl_status find_doubts(finder *f, double width, const uint8_t *halls, uint8_t *marks) {
    const double most = doubtful_up_to(f, width);
    double largest = 0;
    SL_TRY(gather(f, (choice){nextafter(width, INFINITY), most, true}));
    for (size_t i = 0; i < f->groups.count; i++) {
        group *g = &f->groups.items[i];
        bool roomier;
        SL_TRY(fits(f, g, ROOMIER * g->access, &roomier));
        if (!roomier && !has_hall(f, g, halls)) continue;
        SL_TRY(mark_around(f, g, most, marks));
        const uint32_t half = opening_of(f, g);
        if (half == NONE) continue;
        SL_TRY(SL_ARRAY_ROOM(f->context, &f->openings, 1));
        f->openings.items[f->openings.count++] =
            (opening){triangles(f)->halves.items[half].from, sli_half_end(triangles(f), half)};
        if (g->area <= largest) continue;
        largest = g->area;
        f->found.doubtful_width = sli_rounded_up(g->access);
        f->found.doubtful = f->channels.items.items[label_of(f, half)].at;
        f->found.roomiest = g->place;
    }
    return SL_OK;
}

/// Joins the walls of a group, by their ends, in `parent`.
static void join_walls(finder *f, const group *g, uint32_t *parent) {
    const sli_half_edge *halves = triangles(f)->halves.items;
    uint32_t last = NONE;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = halves[half].next) {
            if (label_of(f, half) != SLI_WALL) continue;
            const uint32_t own = sl_root_of(parent, halves[half].from);
            if (last != NONE) parent[own] = sl_root_of(parent, last);
            last = halves[half].from;
        }
    }
}

/// Makes sets of points on walls, in `parent`: those of one building are in one. Walls that touch
/// are in one building, and those that the core of a wall lies between.
static void join_buildings(finder *f, uint32_t *parent) {
    const sli_half_edge *halves = triangles(f)->halves.items;
    for (uint32_t i = 0; i < triangles(f)->points.count; i++) parent[i] = i;
    for (uint32_t half = 0; half < triangles(f)->halves.count; half += 2)
        if (label_of(f, half) == SLI_WALL)
            parent[sl_root_of(parent, halves[half].from)] =
                sl_root_of(parent, halves[half ^ 1].from);
    for (size_t i = 0; i < f->groups.count; i++)
        if (f->groups.items[i].access == 0 && !f->groups.items[i].inside)
            join_walls(f, &f->groups.items[i], parent);
}

static void mark_walls(finder *f, const group *g, bool *doubtful, uint32_t *parent) {
    const sli_half_edge *halves = triangles(f)->halves.items;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = halves[half].next)
            if (label_of(f, half) == SLI_WALL)
                doubtful[sl_root_of(parent, halves[half].from)] = true;
    }
}

static bool has_wall_of(finder *f, const group *g, const bool *doubtful, uint32_t *parent) {
    const sli_half_edge *halves = triangles(f)->halves.items;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = halves[half].next)
            if (label_of(f, half) == SLI_WALL && doubtful[sl_root_of(parent, halves[half].from)])
                return true;
    }
    return false;
}

/// A building is inside as a whole or not at all: parts do not count that a doubtful pocket leads
/// to, or that belong to a building with a doubtful opening or with such a part.
static sl_status drop_doubtful(finder *f, const uint8_t *marks) {
    const size_t points = triangles(f)->points.count;
    if (!(f->found.doubtful_width > 0)) return SL_OK;
    uint32_t *parent = sl_alloc_array(f->context, points, sizeof *parent);
    bool *doubtful = sl_alloc_array(f->context, points, sizeof *doubtful);
    if (parent && doubtful) {
        join_buildings(f, parent);
        for (size_t i = 0; i < f->openings.count; i++) {
            doubtful[sl_root_of(parent, f->openings.items[i].from)] = true;
            doubtful[sl_root_of(parent, f->openings.items[i].to)] = true;
        }
        for (size_t i = 0; i < f->groups.count; i++) {
            group *g = &f->groups.items[i];
            if (!g->inside || !marks[f->order[g->first]] || g->access == 0) continue;
            g->inside = false;
            mark_walls(f, g, doubtful, parent);
        }
        for (size_t i = 0; i < f->groups.count; i++)
            if (has_wall_of(f, &f->groups.items[i], doubtful, parent))
                f->groups.items[i].inside = false;
    }
    const bool done = parent && doubtful;
    sl_free(f->context, parent);
    sl_free(f->context, doubtful);
    return done ? SL_OK : SL_NO_MEMORY;
}

// --- what the map gets

static bool is_inside(const finder *f, uint32_t triangle) {
    return triangle != NONE && f->group_of[triangle] != NONE &&
           f->groups.items[f->group_of[triangle]].inside;
}

/// Whether what is inside has a third of the sides of walls that can be reached or are inside.
/// `opened`: only parts with openings count.
static bool is_building(const finder *f, bool opened) {
    double all = 0, inside = 0;
    for (uint32_t half = 0; half < triangles(f)->halves.count; half++) {
        const uint32_t own = f->triangle[half];
        if (own == NONE || label_of(f, half) != SLI_WALL) continue;
        const bool counts = is_inside(f, own) && (!opened || f->access[own] > 0);
        if (counts || f->access[own] > 0) all += side_length(f, half);
        if (counts) inside += side_length(f, half);
    }
    return inside > 0 && inside >= all / 3;
}

/// Whether a segment lies on the border of the space: no cell is beyond it.
static bool on_border(const finder *f, sl_segment at) {
    const sl_box *b = &f->border;
    return (at.a.x == at.b.x && (at.a.x == b->min.x || at.a.x == b->max.x)) ||
           (at.a.y == at.b.y && (at.a.y == b->min.y || at.a.y == b->max.y));
}

/// Adds a seam, or marks the one that is there.
static sl_status add_seam(finder *f, sl_segment at) {
    sl_map *map = f->map;
    if (sli_same_point(at.a, at.b) || on_border(f, at)) return SL_OK;
    for (size_t i = 0; i < map->seam_count; i++) {
        sl_glass *seam = &map->seams[i];
        const sl_segment own = seam->segment;
        if ((sli_same_point(own.a, at.a) && sli_same_point(own.b, at.b)) ||
            (sli_same_point(own.a, at.b) && sli_same_point(own.b, at.a))) {
            seam->entrance = true;
            return SL_OK;
        }
    }
    SL_TRY(sli_map_add_border(f->context, map, at));
    map->seams[map->seam_count - 1].entrance = true;
    return SL_OK;
}

/// Closes what is inside by seams. In an axial map an oblique one becomes two axial ones. Their
/// corner lies on the circle over the channel, on the side that is not inside; so no wall is
/// between.
static sl_status add_seams(finder *f, bool axial) {
    for (uint32_t half = 0; half < triangles(f)->halves.count; half += 2) {
        const uint32_t label = label_of(f, half);
        if (label == SLI_WALL ||
            is_inside(f, f->triangle[half]) == is_inside(f, f->triangle[half ^ 1]))
            continue;
        f->found.entrances++;
        const sl_point a = start_of(f, half), b = start_of(f, half ^ 1);
        if (!axial) {
            SL_TRY(add_seam(f, (sl_segment){a, b}));
            continue;
        }
        const bool left = is_inside(f, f->triangle[half]);
        const bool turns_left = sli_orient(a, b, (sl_point){a.x, b.y}) > 0;
        const sl_point corner = left == turns_left ? (sl_point){b.x, a.y} : (sl_point){a.x, b.y};
        SL_TRY(add_seam(f, (sl_segment){a, corner}));
        SL_TRY(add_seam(f, (sl_segment){corner, b}));
    }
    return SL_OK;
}

static int compare_groups(const void *left, const void *right) {
    const group *a = left, *b = right;
    if (a->clearance != b->clearance) return a->clearance > b->clearance ? -1 : 1;
    return sli_compare_points(a->place, b->place);
}

/// Gives the map a place in each part, the roomiest first.
static sl_status add_places(finder *f) {
    sl_interior *found = &f->found;
    size_t count = 0;
    found->building = is_building(f, false);
    for (size_t i = 0; i < f->groups.count; i++)
        if (f->groups.items[i].inside) f->groups.items[count++] = f->groups.items[i];
    if (!count) return SL_OK;
    found->places = sl_alloc_array(f->context, count, sizeof *found->places);
    if (!found->places) return SL_NO_MEMORY;
    qsort(f->groups.items, count, sizeof *f->groups.items, compare_groups);
    for (size_t i = 0; i < count; i++) found->places[i] = f->groups.items[i].place;
    found->roomiest = found->places[0];
    found->place_count = count;
    return SL_OK;
}

// --- all of it

static sl_status make_channels(finder *f, double most) {
    SL_TRY(sli_channels_make(f->context, f->map, most, &f->channels));
    SL_TRY(sli_clearance_make(f->context, &f->channels, &f->clearance));
    SL_TRY(number_triangles(f));
    return find_access(f);
}

static void destroy(finder *f) {
    sli_clearance_destroy(&f->clearance);
    sli_channels_destroy(f->context, &f->channels);
    void *const arrays[] = {f->triangle, f->half,  f->access,       f->parent,        f->following,
                            f->group_of, f->order, f->groups.items, f->openings.items};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sl_free(f->context, arrays[i]);
}

/// Finds the parts that are inside by a width.
static sl_status find_parts(finder *f, double width) {
    uint8_t *marks = sl_alloc_array(f->context, 2 * (size_t)f->count, sizeof *marks);
    if (!marks) return SL_NO_MEMORY;
    uint8_t *halls = marks + f->count;
    settle_widths(f, width);
    sl_status status = find_access(f);
    if (status == SL_OK) status = find_halls(f, width, halls);
    if (status == SL_OK) status = find_doubts(f, width, halls, marks);
    if (status == SL_OK) status = choose_parts(f, width);
    if (status == SL_OK && f->found.by != SL_ENTRANCE_GIVEN) status = drop_doubtful(f, marks);
    sl_free(f->context, marks);
    return status;
}

/// Finds what is inside by openings up to `width`; 0 for a width that is to be found, up to `most`.
static sl_status find_by(finder *f, sl_entrance by, double width, double most, bool *found) {
    f->found = (sl_interior){.by = by, .width = width, .roomiest = NOWHERE};
    sl_status status = make_channels(f, width > 0 ? doubtful_up_to(f, width) : most);
    if (status == SL_OK && width == 0) status = find_width(f, most, &f->found.width);
    const bool any = f->found.width > 0;
    if (status == SL_OK && any) status = find_parts(f, f->found.width + f->weld);
    *found = false;
    const bool guess = by == SL_ENTRANCE_FOUND || by == SL_ENTRANCE_WIDE;
    if (status == SL_OK && any && (!guess || is_building(f, true)))
        for (size_t i = 0; i < f->groups.count; i++) *found |= f->groups.items[i].inside;
    *found |= status == SL_OK && f->found.doubtful_width > 0;
    return status;
}

static sl_status begin_search_of_entrances(finder *f, sl_context *context, sl_map *map) {
    *f = (finder){.context = context,
                  .map = map,
                  .bounds = sl_map_bounds(map),
                  .border = sli_space_bounds(map)};
    f->weld = sli_planar_tolerance(&f->bounds);
    return SL_OK;
}

/// Takes the place that is farthest from walls, of those with an access up to a width, if it is so
/// many times as far as the one so far.
static sl_status take_roomier(finder *f, double most, double times, double *clearance) {
    double least = times * *clearance;
    SL_TRY(gather(f, (choice){.least = 0, .most = most}));
    for (size_t i = 0; i < f->groups.count; i++) {
        if (f->groups.items[i].clearance <= least) continue;
        least = *clearance = f->groups.items[i].clearance;
        f->found.roomiest = f->groups.items[i].place;
    }
    return SL_OK;
}

/// Takes the largest part that is closed, of those that are roomy against a clearance.
static sl_status take_closed(finder *f, double *clearance) {
    const double least = *clearance / ROOMY;
    double area = 0;
    SL_TRY(gather(f, (choice){.least = 0, .most = 0}));
    for (size_t i = 0; i < f->groups.count; i++) {
        const group *g = &f->groups.items[i];
        if (g->clearance < least || g->area <= area) continue;
        area = g->area;
        *clearance = g->clearance;
        f->found.roomiest = g->place;
    }
    return SL_OK;
}

/// Finds a roomy place: in a closed part, else behind openings up to a width, as niches outdoors
/// are, too; anywhere, if only cores of walls have such.
static sl_status find_roomiest(finder *f, double most) {
    double clearance = 0;
    SL_TRY(take_roomier(f, most, 1, &clearance));
    SL_TRY(take_closed(f, &clearance));
    return take_roomier(f, INFINITY, CORE, &clearance);
}

/// Tries one way to know the width, up to `most` (what is doubtful, by SL_ENTRANCE_WIDE). *found:
/// there is an answer, and the map has it.
static sl_status try_by(sl_context *context, sl_map *map, sl_entrance by, double width, double most,
                        bool *found) {
    finder f;
    SL_TRY(begin_search_of_entrances(&f, context, map));
    f.doubt = most;
    const bool axial = sl_map_is_axial(map);
    sl_status status = find_by(&f, by, width, most, found);
    if (status == SL_OK && *found) status = add_seams(&f, axial);
    if (status == SL_OK && *found) status = add_places(&f);
    if (status == SL_OK && !*found) status = find_roomiest(&f, most);
    if (status == SL_OK && f.clearance.cut_short)
        sl_note(context,
                "%s: the search for rooms was cut short in gaps that are long and thin (triangles: "
                "%zu); if a room counts as outside, name a place in it by --start X,Y",
                sli_map_name(map), f.clearance.cut_short);
    destroy(&f);
    if (status == SL_OK && *found)
        map->interior = f.found;
    else
        sl_free(context, f.found.places);
    if (!*found) map->interior = (sl_interior){.roomiest = f.found.roomiest};
    return status;
}

/// Forgets what was found before.
static void forget(sl_context *context, sl_map *map) {
    size_t kept = 0;
    sl_free(context, map->interior.places);
    map->interior = (sl_interior){.roomiest = NOWHERE};
    for (size_t i = 0; i < map->seam_count; i++) {
        if (map->seams[i].entrance && !map->seams[i].stops) continue;
        map->seams[kept] = map->seams[i];
        map->seams[kept++].entrance = false;
    }
    map->seam_count = kept;
}

/// By doors that are drawn open: the width that is found counts if these can be entrances then.
static sl_status find_by_doors(sl_context *context, sl_map *map, double most, bool *found) {
    SL_TRY(try_by(context, map, SL_ENTRANCE_FOUND, 0, most, found));
    if (*found && map->interior.width >= DOORS * map->entrance) return SL_OK;
    forget(context, map);
    return try_by(context, map, SL_ENTRANCE_DOORS, map->entrance, 0, found);
}

/// Tries the doubtful opening as an entrance: a pair of doors, a garage, a hall. It counts if
/// nothing else is doubtful then, and a building is inside.
static sl_status widen(sl_context *context, sl_map *map, double narrow) {
    const sl_interior before = map->interior;
    const double most = DOUBT_FOUND * before.width;
    bool found = true;
    for (double width = 0; found && map->interior.doubtful_width > width;) {
        width = map->interior.doubtful_width;
        forget(context, map);
        SL_TRY(try_by(context, map, SL_ENTRANCE_WIDE, width, most, &found));
    }
    if (found && !(map->interior.doubtful_width > 0)) return SL_OK;
    forget(context, map);
    return try_by(context, map, before.by, before.by == SL_ENTRANCE_FOUND ? 0 : before.width,
                  narrow, &found);
}

static sl_status find(sl_context *context, sl_map *map) {
    const sl_box b = sl_map_bounds(map);
    const double shorter = fmin(b.max.x - b.min.x, b.max.y - b.min.y);
    const double longer = fmax(b.max.x - b.min.x, b.max.y - b.min.y);
    const double metres = sli_unit_metres(map->unit);
    const bool doors = map->entrance_by_doors;
    const double usual = doors ? map->entrance : metres > 0 ? ENTRANCE / metres : INFINITY;
    bool found = false;
    if (!(shorter > 0)) return SL_OK;
    if (map->entrance > 0 && !doors)
        return try_by(context, map, SL_ENTRANCE_GIVEN, map->entrance, 0, &found);
    if (usual < 0.6 * shorter && !knows_ground(map))
        SL_TRY(doors ? find_by_doors(context, map, shorter / 3, &found)
                     : try_by(context, map, SL_ENTRANCE_UNIT, usual, 0, &found));
    if (!found && !says_ground(map))
        SL_TRY(try_by(context, map, SL_ENTRANCE_FOUND, 0, shorter / 3, &found));
    if (!found || !map->entrance_may_be_wide) return SL_OK;
    // A width that is found among openings that are small against the plan is none of doors.
    const double least = map->interior.by == SL_ENTRANCE_FOUND ? longer / DOORS_IN_PLAN : 0;
    if (!(map->interior.doubtful_width > least)) return SL_OK;
    return widen(context, map, shorter / 3);
}

sl_status sl_map_find_inside(sl_context *context, sl_map *map, const sl_clean_options *clean,
                             sl_clean_account *account) {
    sl_clean_account again = {0};
    forget(context, map);
    if (map->start_count || !map->wall_count) return SL_OK;
    const size_t seams = map->seam_count;
    const sl_status status = find(context, map);
    if (status == SL_UNSUPPORTED) {
        forget(context, map);
        sl_note(context,
                "%s: its walls are too dense to look for rooms among them; name a place in a room "
                "by --start X,Y",
                sli_map_name(map));
        return SL_OK;
    }
    SL_TRY(status);
    if (map->seam_count == seams || (sl_map_is_axial(map) && !map->cell_count)) return SL_OK;
    // Walls go through the rounded ends of seams.
    SL_TRY(sl_map_clean(context, map, clean, &again));
    if (!account) return SL_OK;
    account->after = again.after;
    account->split += again.split;
    account->largest_move = fmax(account->largest_move, again.largest_move);
    return SL_OK;
}
