/// Which parts are inside by a width, and which openings leave a doubt (begin with entrances.c).
#include "space/entrances.h"

#include "map/unit.h"

#include <math.h>

/// Openings up to so many times W are doubtful, where W was not found.
#define DOUBT 2.5
/// How long, by the square root of their area, the walls around a core are: 4 around a square, 4.5
/// around a rectangle that is 2.6 times as long as wide, 6.4 around one of 8 times.
#define CORE_AT_JAMB  4.5
#define CORE_ANYWHERE 6.4

double sli_parts_doubtful_up_to(const sli_entrances *f, double width) {
    if (f->found.by == SL_ENTRANCE_WIDE) return fmax(width, f->doubt);
    return (f->found.by == SL_ENTRANCE_FOUND ? SLI_DOUBT_FOUND : DOUBT) * width;
}

// --- parts that are inside

/// Whether a side of a group is the jamb of an opening: both of its ends are in `ends`.
static bool has_jamb(const sli_entrances *f, const sli_access_group *g, const sl_bits *ends) {
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = sli_entrances_triangles(f)->halves.items[half].next)
            if (sli_entrances_label(f, half) == SLI_WALL &&
                sl_bits_has(ends, sli_entrances_triangles(f)->halves.items[half].from) &&
                sl_bits_has(ends, sli_half_end(sli_entrances_triangles(f), half)))
                return true;
    }
    return false;
}

/// Leaves out cores of walls so thick that half a disc fits: they are narrower than W, and long.
static sl_status drop_cores(sli_entrances *f, double width) {
    const sli_half_edge *halves = sli_entrances_triangles(f)->halves.items;
    sl_bits *ends = sl_alloc_array(
        f->context, sl_bits_words(sli_entrances_triangles(f)->points.count), sizeof *ends);
    sl_status status = ends ? SL_OK : SL_NO_MEMORY;
    for (uint32_t half = 0; half < sli_entrances_triangles(f)->halves.count && ends; half++) {
        const uint32_t label = sli_entrances_label(f, half), own = f->triangle[half];
        if (label == SLI_WALL || label == SLI_FREE || own == SLI_NO_TRIANGLE ||
            f->access[own] == 0 || f->channels.items.items[label].width > width)
            continue;
        sl_bits_add(ends, halves[half].from);
        sl_bits_add(ends, halves[half ^ 1].from);
    }
    for (size_t i = 0; i < f->openings.count && ends; i++) {
        sl_bits_add(ends, f->openings.items[i].from);
        sl_bits_add(ends, f->openings.items[i].to);
    }
    for (size_t i = 0; i < f->groups.count && status == SL_OK; i++) {
        sli_access_group *g = &f->groups.items[i];
        if (!g->inside || g->access > 0 || g->reached < CORE_AT_JAMB * sqrt(g->area)) continue;
        if (g->reached < CORE_ANYWHERE * sqrt(g->area) && !has_jamb(f, g, ends)) continue;
        status = sli_access_fits(f, g, width, &g->inside);
    }
    sl_free(f->context, ends);
    return status;
}

sl_status sli_parts_choose(sli_entrances *f, double width) {
    const bool ground = sli_entrances_say_ground(f->map);
    bool opened = f->found.doubtful_width > 0;
    SL_TRY(sli_access_gather(f, (sli_access_choice){.least = 0, .most = width}));
    for (size_t i = 0; i < f->groups.count; i++) {
        sli_access_group *g = &f->groups.items[i];
        double wanted = fmax(width / 2, SLI_ROOMIER * g->access);
        if (ground && g->access == 0) wanted = 0;
        SL_TRY(sli_access_fits(f, g, wanted, &g->inside));
        opened |= g->inside && g->access > 0;
    }
    return opened && !ground ? drop_cores(f, width) : SL_OK;
}

// --- doubts

/// Finds the half-edge by which a pocket is entered.
static uint32_t opening_of(const sli_entrances *f, const sli_access_group *g) {
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = sli_entrances_triangles(f)->halves.items[half].next) {
            const uint32_t label = sli_entrances_label(f, half), other = f->triangle[half ^ 1];
            if (label != SLI_WALL && label != SLI_FREE &&
                f->channels.items.items[label].width == g->access &&
                (other == SLI_NO_TRIANGLE || f->access[other] > g->access))
                return half;
        }
    }
    return SLI_NO_TRIANGLE;
}

/// Marks what can be reached from a pocket through sides of an access up to `most`: 1 in `marks`.
static sl_status mark_around(sli_entrances *f, const sli_access_group *g, double most,
                             uint8_t *marks) {
    SL_ARRAY(uint32_t) stack = {0};
    sl_status status = SL_OK;
    const uint32_t first = f->order[g->first];
    if (!marks[first]) status = SL_ARRAY_ROOM(f->context, &stack, 1);
    if (!marks[first] && status == SL_OK) stack.items[stack.count++] = first;
    marks[first] = 1;
    while (stack.count && status == SL_OK) {
        uint32_t half = f->half[stack.items[--stack.count]];
        for (int i = 0; i < 3; i++, half = sli_entrances_triangles(f)->halves.items[half].next) {
            const uint32_t other = f->triangle[half ^ 1];
            if (sli_entrances_label(f, half) == SLI_WALL || other == SLI_NO_TRIANGLE ||
                marks[other] || f->access[other] > most)
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

/// Where somebody comes to who leaves a part: the triangle with the largest access.
/// SLI_NO_TRIANGLE: outside.
static uint32_t way_out_of(const sli_entrances *f, const sli_access_group *g) {
    uint32_t best = SLI_NO_TRIANGLE;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = sli_entrances_triangles(f)->halves.items[half].next) {
            const uint32_t other = f->triangle[half ^ 1];
            if (sli_entrances_label(f, half) == SLI_WALL ||
                (other != SLI_NO_TRIANGLE && f->group_of[other] != SLI_NO_TRIANGLE))
                continue;
            if (other == SLI_NO_TRIANGLE) return SLI_NO_TRIANGLE;
            if (best == SLI_NO_TRIANGLE || f->access[other] > f->access[best]) best = other;
        }
    }
    return best;
}

sl_status sli_parts_find_halls(sli_entrances *f, double width, uint8_t *halls) {
    SL_TRY(sli_parts_choose(f, width));
    for (size_t i = 0; i < f->groups.count; i++) {
        const sli_access_group *g = &f->groups.items[i];
        const uint32_t out = g->inside && g->access > 0 ? way_out_of(f, g) : SLI_NO_TRIANGLE;
        if (out != SLI_NO_TRIANGLE && f->access[out] <= sli_parts_doubtful_up_to(f, width))
            halls[out] = 1;
    }
    return SL_OK;
}

static bool has_hall(const sli_entrances *f, const sli_access_group *g, const uint8_t *halls) {
    for (uint32_t i = 0; i < g->count; i++)
        if (halls[f->order[g->first + i]]) return true;
    return false;
}

sl_status sli_parts_find_doubts(sli_entrances *f, double width, const uint8_t *halls,
                                uint8_t *marks) {
    const double most = sli_parts_doubtful_up_to(f, width);
    double largest = 0;
    SL_TRY(sli_access_gather(f, (sli_access_choice){nextafter(width, INFINITY), most, true}));
    for (size_t i = 0; i < f->groups.count; i++) {
        sli_access_group *g = &f->groups.items[i];
        bool roomier;
        SL_TRY(sli_access_fits(f, g, SLI_ROOMIER * g->access, &roomier));
        if (!roomier && !has_hall(f, g, halls)) continue;
        SL_TRY(mark_around(f, g, most, marks));
        const uint32_t half = opening_of(f, g);
        if (half == SLI_NO_TRIANGLE) continue;
        SL_TRY(SL_ARRAY_ROOM(f->context, &f->openings, 1));
        f->openings.items[f->openings.count++] =
            (sli_doubtful_opening){sli_entrances_triangles(f)->halves.items[half].from,
                                   sli_half_end(sli_entrances_triangles(f), half)};
        if (g->area <= largest) continue;
        largest = g->area;
        f->found.doubtful_width = sli_rounded_up(g->access);
        f->found.doubtful = f->channels.items.items[sli_entrances_label(f, half)].at;
        f->found.roomiest = g->place;
    }
    return SL_OK;
}

/// Joins the walls of a group, by their ends, in `parent`.
static void join_walls(sli_entrances *f, const sli_access_group *g, uint32_t *parent) {
    const sli_half_edge *halves = sli_entrances_triangles(f)->halves.items;
    uint32_t last = SLI_NO_TRIANGLE;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = halves[half].next) {
            if (sli_entrances_label(f, half) != SLI_WALL) continue;
            const uint32_t own = sl_root_of(parent, halves[half].from);
            if (last != SLI_NO_TRIANGLE) parent[own] = sl_root_of(parent, last);
            last = halves[half].from;
        }
    }
}

/// Makes sets of points on walls, in `parent`: those of one building are in one. Walls that touch
/// are in one building, and those that the core of a wall lies between.
static void join_buildings(sli_entrances *f, uint32_t *parent) {
    const sli_half_edge *halves = sli_entrances_triangles(f)->halves.items;
    for (uint32_t i = 0; i < sli_entrances_triangles(f)->points.count; i++) parent[i] = i;
    for (uint32_t half = 0; half < sli_entrances_triangles(f)->halves.count; half += 2)
        if (sli_entrances_label(f, half) == SLI_WALL)
            parent[sl_root_of(parent, halves[half].from)] =
                sl_root_of(parent, halves[half ^ 1].from);
    for (size_t i = 0; i < f->groups.count; i++)
        if (f->groups.items[i].access == 0 && !f->groups.items[i].inside)
            join_walls(f, &f->groups.items[i], parent);
}

static void mark_walls(sli_entrances *f, const sli_access_group *g, bool *doubtful,
                       uint32_t *parent) {
    const sli_half_edge *halves = sli_entrances_triangles(f)->halves.items;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = halves[half].next)
            if (sli_entrances_label(f, half) == SLI_WALL)
                doubtful[sl_root_of(parent, halves[half].from)] = true;
    }
}

static bool has_wall_of(sli_entrances *f, const sli_access_group *g, const bool *doubtful,
                        uint32_t *parent) {
    const sli_half_edge *halves = sli_entrances_triangles(f)->halves.items;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t half = f->half[f->order[g->first + i]];
        for (int k = 0; k < 3; k++, half = halves[half].next)
            if (sli_entrances_label(f, half) == SLI_WALL &&
                doubtful[sl_root_of(parent, halves[half].from)])
                return true;
    }
    return false;
}

sl_status sli_parts_drop_doubtful(sli_entrances *f, const uint8_t *marks) {
    const size_t points = sli_entrances_triangles(f)->points.count;
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
            sli_access_group *g = &f->groups.items[i];
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
