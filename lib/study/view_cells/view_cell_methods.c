/// The methods of making view cells: the adaptive ones of the paper, and those that it compares
/// them with (Mattausch et al. 2006, section 6.3).
///
/// All divide view space from the top (divide.c). They differ in the split that a part gets and in
/// its place in the queue:
///
///   av-m, av-s   the split that gains most; parts by gain. av-m merges then.
///   hybrid       the same by exact sets of pieces (pieces.c) in place of samples.
///   kd-*         in the middle; breadth first, or until little is seen.
///   bsp          along the line of a wall, until no wall is inside (Teller 1992).
#include "study/view_cells/divide.h"

#include "geometry/orient.h"

#include <math.h>

/// Defines how a method by samples (`by` is segments) or by none (NULL) divides view space.
#define DIVIDE(name, by, choose, stops_early)                                                      \
    static sl_status name(sl_context *context, const sl_view_scene *scene,                         \
                          const sl_view_segments *segments, const sl_view_subdivision *options,    \
                          sl_view_tree *out, sl_view_found *found) {                               \
        (void)segments, (void)found;                                                               \
        return sli_view_divide(context, scene, by, NULL, options, choose, stops_early, out, NULL); \
    }

// --- adaptive

static sl_status find_best_split(sli_view_divider *d, sli_view_part *part, bool *splits) {
    *splits =
        part->seen > 0 && sli_view_split_middle(part, sli_view_longer_axis(part), &part->split);
    return *splits ? sli_view_choose_axes(d, part, &part->split) : SL_OK;
}

/// The split that gains most. A small weight on the part's own cost makes sure that parts are split
/// too where only several splits together pay.
static sl_status choose_adaptive(sli_view_divider *d, sli_view_part *part, double *priority,
                                 bool *splits) {
    sli_view_find_extents(d, part);
    const sl_status status = find_best_split(d, part, splits);
    sli_view_forget_extents(d);
    SL_TRY(status);
    if (*splits && d->options->wall_splits) SL_TRY(sli_view_choose_walls(d, part, &part->split));
    const double weight = d->options->cost_weight;
    *priority = (1 - weight) * part->split.gain + weight * part->mass * part->seen;
    return SL_OK;
}

DIVIDE(divide_adaptive, segments, choose_adaptive, true)

/// The same by exact sets. `found` is set only on success.
static sl_status divide_exactly(sl_context *context, const sl_view_scene *scene,
                                const sl_view_segments *segments,
                                const sl_view_subdivision *options, sl_view_tree *out,
                                sl_view_found *found) {
    (void)segments;
    if (options->wall_splits)
        return sl_fail(context, SL_UNSUPPORTED,
                       "the method 'hybrid' splits across the axes alone, not along walls' lines");
    sli_view_pieces pieces;
    sl_view_sets sets = {0};
    sl_status status =
        sli_view_pieces_create(context, scene, options->sight, options->threads, &pieces);
    if (status == SL_OK)
        status = sli_view_divide(context, scene, NULL, &pieces, options, choose_adaptive, true, out,
                                 found ? &sets : NULL);
    if (status == SL_OK && found) *found = (sl_view_found){sets, pieces.work};
    sli_view_pieces_destroy(&pieces);
    return status;
}

// --- kd-trees

/// The priority that splits parts in the order in which they are made.
static double next_in_line(sli_view_divider *d) {
    return -(double)d->made++;
}

static sl_status choose_cycling(sli_view_divider *d, sli_view_part *part, double *priority,
                                bool *splits) {
    *splits = sli_view_split_middle(part, part->depth % 2, &part->split);
    *priority = next_in_line(d);
    return SL_OK;
}

static sl_status choose_longest(sli_view_divider *d, sli_view_part *part, double *priority,
                                bool *splits) {
    *splits = sli_view_split_middle(part, sli_view_longer_axis(part), &part->split);
    *priority = next_in_line(d);
    return SL_OK;
}

static bool sees_enough(sli_view_divider *d, sli_view_part *part) {
    sli_view_find_seen(d, part);
    return part->seen > d->options->visible_share * d->all_seen;
}

static sl_status choose_visible(sli_view_divider *d, sli_view_part *part, double *priority,
                                bool *splits) {
    if (!sees_enough(d, part)) return SL_OK;
    return choose_longest(d, part, priority, splits);
}

static sl_status choose_depth_first(sli_view_divider *d, sli_view_part *part, double *priority,
                                    bool *splits) {
    if (!sees_enough(d, part) || part->depth >= d->options->deepest) return SL_OK;
    SL_TRY(choose_longest(d, part, priority, splits));
    *priority = -*priority;
    return SL_OK;
}

DIVIDE(divide_cycling, NULL, choose_cycling, false)
DIVIDE(divide_longest, NULL, choose_longest, false)
DIVIDE(divide_visible, segments, choose_visible, false)
DIVIDE(divide_depth_first, segments, choose_depth_first, false)

// --- aligned with the walls

/// Walls weighed and lines tried for one split, at most.
enum { MOST_WEIGHED = 512, MOST_TRIED = 24 };

/// The cost of a line: walls cut, and sides uneven, as shares of all.
static double line_cost(const sli_view_divider *d, const sl_segment *line) {
    const size_t step = (d->walls.count + MOST_WEIGHED - 1) / MOST_WEIGHED;
    double cut = 0, left = 0, right = 0, all = 0;
    for (size_t i = 0; i < d->walls.count; i += step, all++) {
        const sl_wall *w = &d->scene->space->walls[d->walls.items[i]];
        const int a = sli_orient(line->a, line->b, w->a), b = sli_orient(line->a, line->b, w->b);
        cut += a * b < 0;
        left += a * b >= 0 && a + b > 0;
        right += a * b >= 0 && a + b < 0;
    }
    return (4 * cut + fabs(left - right)) / all;
}

/// Auto-partition (Teller 1992): the line of a wall within; a part without walls stays whole.
static sl_status choose_wall(sli_view_divider *d, sli_view_part *part, double *priority,
                             bool *splits) {
    SL_TRY(sli_view_walls_within(d, part, UINT32_MAX, &d->walls));
    const size_t count = d->walls.count;
    double least = INFINITY;
    for (size_t i = 0; i < count && i < MOST_TRIED; i++) {
        const size_t k = count <= MOST_TRIED ? i : i * count / MOST_TRIED;
        const sl_wall *w = &d->scene->space->walls[d->walls.items[k]];
        const sl_segment line = {w->a, w->b};
        const double cost = line_cost(d, &line);
        if (cost >= least) continue;
        least = cost;
        part->split = sli_view_split_along(w);
    }
    *splits = count > 0;
    *priority = next_in_line(d);
    return SL_OK;
}

DIVIDE(divide_by_walls, NULL, choose_wall, false)

static const sl_view_method methods[] = {
    {.name = "av-m",
     .what = "adaptive: the split that gains most first, then merging",
     .merges = true,
     .needs_segments = true,
     .divide = divide_adaptive},
    {.name = "av-s",
     .what = "adaptive, without merging",
     .needs_segments = true,
     .divide = divide_adaptive},
    {.name = "hybrid",
     .what = "adaptive and merged, by exact directed sets in place of samples (Laine 2005)",
     .merges = true,
     .exact = true,
     .divide = divide_exactly},
    {.name = "kd-casm",
     .what = "kd-tree, breadth first, in the middle across each axis in turn",
     .divide = divide_cycling},
    {.name = "kd-lasm",
     .what = "kd-tree, breadth first, in the middle across the longer axis",
     .divide = divide_longest},
    {.name = "kd-vt",
     .what = "likewise, until little is seen",
     .needs_segments = true,
     .divide = divide_visible},
    {.name = "kd-vt-df",
     .what = "likewise, depth first (KD-VT*)",
     .needs_segments = true,
     .divide = divide_depth_first},
    {.name = "bsp",
     .what = "along walls, until none is inside (Teller 1992)",
     .divide = divide_by_walls},
};

const sl_view_method *sl_view_methods(size_t *count) {
    *count = sizeof methods / sizeof *methods;
    return methods;
}
