/// Visibility sampling (Mattausch et al. 2006, section 4.1), and the sets that samples give.
///
/// From a random point a line is followed both ways, room by room, to the walls at its ends. The
/// maximal free segment between sees its objects; the walk is decided by exact predicates. A room
/// is convex: the line leaves it where the boundary, counter-clockwise, comes from not left of the
/// line to left of it.
///
/// A view cell sees what the segments that pass it see. Each segment sinks down the tree of view
/// cells, cut at each split that it crosses, and adds its objects to the leaves that it reaches.
///
/// Each unit of samples has random numbers of its own, and units are joined in order. So the result
/// is the same for any number of threads. Cost: O(rooms on the line) a sample; O(leaves passed x
/// objects) a segment for the sets.
#include "base/size.h"
#include "geometry/orient.h"
#include "sightline/support.h"
#include "study/view_cells/view_cell_tree.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

// --- segments

enum { SAMPLES_A_UNIT = 4096 };

/// The result of one unit of samples.
typedef struct batch {
    SL_ARRAY(sl_segment) segments;
    SL_ARRAY(uint32_t) counts; ///< of objects, by segment
    SL_ARRAY(uint32_t) objects;
    uint64_t empty, unseeing, lost;
} batch;

typedef struct sampler {
    const sl_outline *outline;
    const sl_view_sampling *options;
    batch *batches;
} sampler;

/// One end of a line: where it hits, and what.
typedef struct line_end {
    sl_point at;
    uint32_t wall; ///< UINT32_MAX: the map's border
} line_end;

sl_view_sampling sl_view_sampling_default(void) {
    return (sl_view_sampling){.samples = 200000, .seed = 1};
}

void sl_view_segments_destroy(sl_context *context, sl_view_segments *segments) {
    sl_free(context, segments->items);
    sl_free(context, segments->first);
    sl_free(context, segments->objects);
    *segments = (sl_view_segments){0};
}

/// Where the directed line through p and q meets the side from a (not left of it) to b (left).
static sl_point meet(sl_point p, sl_point q, sl_point a, sl_point b) {
    const double dx = q.x - p.x, dy = q.y - p.y;
    const double from = dx * (a.y - p.y) - dy * (a.x - p.x);
    const double to = dx * (b.y - p.y) - dy * (b.x - p.x);
    const double t = to != from ? from / (from - to) : 0;
    const sl_point at = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    return (sl_point){fmin(fmax(at.x, fmin(a.x, b.x)), fmax(a.x, b.x)),
                      fmin(fmax(at.y, fmin(a.y, b.y)), fmax(a.y, b.y))};
}

/// Follows the directed line through p and q, from a side of a room on. A line leaves a convex room
/// where the boundary, counter-clockwise, comes from not left of it to left of it. False where
/// there is no such side: the line only touches the room.
static bool follow(const sl_outline *outline, uint32_t side, sl_point p, sl_point q,
                   line_end *out) {
    for (uint32_t rooms = 0; rooms <= outline->room_count; rooms++) {
        const uint32_t first = side;
        bool left = sli_orient(p, q, outline->sides[side].start) > 0;
        while (true) {
            const sl_side *s = &outline->sides[side];
            const sl_point end = outline->sides[s->next].start;
            const bool then = sli_orient(p, q, end) > 0;
            if (!left && then) break;
            left = then;
            side = s->next;
            if (side == first) return false;
        }
        const sl_side *s = &outline->sides[side];
        if (!sl_side_is_portal(s)) {
            out->at = meet(p, q, s->start, outline->sides[s->next].start);
            out->wall = s->neighbour >= SL_SIDE_BORDER ? UINT32_MAX : s->neighbour - SL_SIDE_WALL;
            return true;
        }
        side = s->neighbour;
    }
    return false;
}

/// Adds the cells that the directed line through p and q passes from a cell on, without it.
static sl_status pass_cells(sl_context *context, const sl_space *space, uint32_t cell, sl_point p,
                            sl_point q, batch *b) {
    for (uint32_t passed = 0; passed <= space->cell_count; passed++) {
        const sl_directed_portal *portal = space->directed + space->cells[cell].first_directed;
        const sl_directed_portal *end = portal + space->cells[cell].directed_count;
        while (portal < end &&
               (sli_orient(p, q, portal->right) > 0 || sli_orient(p, q, portal->left) <= 0))
            portal++;
        if (portal == end) return SL_OK;
        cell = portal->cell;
        SL_TRY(SL_ARRAY_ROOM(context, &b->objects, 1));
        b->objects.items[b->objects.count++] = cell;
    }
    return SL_OK;
}

static sl_status add_objects(sl_context *context, const sampler *s, uint32_t cell, sl_point p,
                             sl_point q, const line_end ends[2], batch *b) {
    const size_t before = b->objects.count;
    SL_TRY(SL_ARRAY_ROOM(context, &b->objects, 2));
    if (s->options->objects == SL_VIEW_WALLS) {
        for (int i = 0; i < 2; i++)
            if (ends[i].wall != UINT32_MAX) b->objects.items[b->objects.count++] = ends[i].wall;
    } else {
        b->objects.items[b->objects.count++] = cell;
        SL_TRY(pass_cells(context, s->outline->space, cell, p, q, b));
        SL_TRY(pass_cells(context, s->outline->space, cell, q, p, b));
    }
    SL_TRY(SL_ARRAY_ROOM(context, &b->counts, 1));
    b->counts.items[b->counts.count++] = (uint32_t)(b->objects.count - before);
    return SL_OK;
}

static sl_status add_sample(sl_context *context, const sampler *s, sl_random *random, batch *b) {
    const sl_outline *outline = s->outline;
    const sl_box *box = &outline->space->bounds;
    const double width = box->max.x - box->min.x, height = box->max.y - box->min.y;
    const sl_point p = {box->min.x + width * sl_random_unit(random),
                        box->min.y + height * sl_random_unit(random)};
    const double angle = 6.283185307179586 * sl_random_unit(random);
    const double reach = fmax(width, height);
    const sl_point q = {p.x + reach * cos(angle), p.y + reach * sin(angle)};
    const uint32_t cell = sl_space_locate(outline->space, p);
    if (cell == SL_NO_CELL || !outline->space->cells[cell].inside) {
        b->empty++;
        return SL_OK;
    }
    const uint32_t side = outline->first[sl_outline_room(outline, cell, p)];
    line_end ends[2];
    // Backwards it is the same line, by the same two points.
    if (!follow(outline, side, q, p, &ends[0]) || !follow(outline, side, p, q, &ends[1]) ||
        (ends[0].at.x == ends[1].at.x && ends[0].at.y == ends[1].at.y)) {
        b->lost++;
        return SL_OK;
    }
    if (ends[0].wall == UINT32_MAX && ends[1].wall == UINT32_MAX) {
        b->unseeing++;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &b->segments, 1));
    b->segments.items[b->segments.count++] = (sl_segment){ends[0].at, ends[1].at};
    return add_objects(context, s, cell, p, q, ends, b);
}

static sl_status sample_unit(sl_context *context, void *job, void *state, size_t unit) {
    (void)state;
    const sampler *s = job;
    const uint64_t first = (uint64_t)unit * SAMPLES_A_UNIT;
    const uint64_t left = s->options->samples - first;
    // Every unit has random numbers of its own, so it does not matter which thread takes it.
    sl_random random = {s->options->seed};
    random.state = sl_random_next(&random) ^ (uint64_t)unit * 0xd1342543de82ef95u;
    for (uint64_t i = 0; i < left && i < SAMPLES_A_UNIT; i++)
        SL_TRY(add_sample(context, s, &random, &s->batches[unit]));
    return SL_OK;
}

/// The place of a segment's middle on a Morton curve (Morton 1966): near places mostly have near
/// numbers.
static uint32_t place_of(const sl_box *box, const sl_segment *s) {
    const double x = (s->a.x / 2 + s->b.x / 2 - box->min.x) / (box->max.x - box->min.x);
    const double y = (s->a.y / 2 + s->b.y / 2 - box->min.y) / (box->max.y - box->min.y);
    const uint32_t across = (uint32_t)(fmin(fmax(x, 0), 1) * 65535);
    const uint32_t up = (uint32_t)(fmin(fmax(y, 0), 1) * 65535);
    uint32_t place = 0;
    for (int bit = 0; bit < 16; bit++)
        place |= (across >> bit & 1) << 2 * bit | (up >> bit & 1) << (2 * bit + 1);
    return place;
}

typedef struct placed {
    uint32_t place, number;
} placed;

static int compare_placed(const void *left, const void *right) {
    const placed *a = left, *b = right;
    if (a->place != b->place) return a->place < b->place ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

/// Sorts segments by place. Those of one region then lie together in memory, which makes later
/// passes over them several times faster.
static sl_status sort(sl_context *context, const sl_box *box, const sl_view_segments *from,
                      sl_view_segments *out) {
    placed *order = sl_alloc_array(context, from->count, sizeof *order);
    out->items = sl_alloc_array(context, from->count, sizeof *out->items);
    out->first = sl_alloc_array(context, (size_t)from->count + 1, sizeof *out->first);
    out->objects =
        sl_alloc_array(context, sli_size(from->first[from->count]), sizeof *out->objects);
    if (!order || !out->items || !out->first || !out->objects) {
        sl_free(context, order);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < from->count; i++)
        order[i] = (placed){place_of(box, &from->items[i]), i};
    if (from->count) qsort(order, from->count, sizeof *order, compare_placed);
    for (out->count = 0; out->count < from->count; out->count++) {
        const uint32_t number = order[out->count].number;
        uint64_t at = out->first[out->count];
        out->items[out->count] = from->items[number];
        for (uint64_t k = from->first[number]; k < from->first[number + 1]; k++)
            out->objects[at++] = from->objects[k];
        out->first[out->count + 1] = at;
    }
    sl_free(context, order);
    return SL_OK;
}

/// Joins the batches in order.
static sl_status join(sl_context *context, const batch *batches, size_t count,
                      sl_view_segments *out) {
    size_t segments = 0, objects = 0;
    for (size_t i = 0; i < count; i++) {
        segments += batches[i].segments.count;
        objects += batches[i].objects.count;
    }
    out->items = sl_alloc_array(context, segments, sizeof *out->items);
    out->first = sl_alloc_array(context, segments + 1, sizeof *out->first);
    out->objects = sl_alloc_array(context, objects, sizeof *out->objects);
    if (!out->items || !out->first || !out->objects) return SL_NO_MEMORY;
    uint64_t at = 0;
    for (size_t i = 0; i < count; i++) {
        const batch *b = &batches[i];
        out->empty += b->empty;
        out->unseeing += b->unseeing;
        out->lost += b->lost;
        if (!b->segments.count) continue;
        memcpy(out->items + out->count, b->segments.items, b->segments.count * sizeof *out->items);
        memcpy(out->objects + at, b->objects.items, b->objects.count * sizeof *out->objects);
        for (size_t k = 0; k < b->segments.count; k++) {
            at += b->counts.items[k];
            out->first[++out->count] = at;
        }
    }
    return SL_OK;
}

sl_status sl_view_sample(sl_context *context, const sl_outline *outline,
                         const sl_view_sampling *options, sl_view_segments *out) {
    if (options->samples > UINT32_MAX)
        return sl_fail(context, SL_BAD_ARGUMENT, "%llu samples: at most %u are possible",
                       (unsigned long long)options->samples, UINT32_MAX);
    const size_t units = (size_t)((options->samples + SAMPLES_A_UNIT - 1) / SAMPLES_A_UNIT);
    sampler s = {outline, options, sl_alloc_array(context, units, sizeof(batch))};
    if (!s.batches) return SL_NO_MEMORY;
    const sl_work work = {
        .job = &s, .unit = sample_unit, .stage = "sample", .units = "bundles of lines"};
    sl_view_segments joined = {0}, made = {.drawn = options->samples};
    sl_status status = sl_work_run(context, &work, units, options->threads);
    if (status == SL_OK) status = join(context, s.batches, units, &joined);
    if (status == SL_OK) status = sort(context, &outline->space->bounds, &joined, &made);
    made.empty = joined.empty;
    made.unseeing = joined.unseeing;
    made.lost = joined.lost;
    sl_view_segments_destroy(context, &joined);
    for (size_t i = 0; i < units; i++) {
        sl_free(context, s.batches[i].segments.items);
        sl_free(context, s.batches[i].counts.items);
        sl_free(context, s.batches[i].objects.items);
    }
    sl_free(context, s.batches);
    if (status == SL_OK)
        *out = made;
    else
        sl_view_segments_destroy(context, &made);
    return status;
}

// --- the sets of leaves, by segments

/// A part of a segment on its way down the tree.
typedef struct descent {
    int32_t at;
    double t0, t1;
} descent;

/// What each thread has for itself.
typedef struct gatherer {
    sl_view_sets sets;
    SL_ARRAY(descent) waiting;
} gatherer;

typedef struct gathering {
    const sl_view_tree *tree;
    const sl_view_segments *segments;
    uint32_t object_count;
    pthread_mutex_t lock;
    sl_view_sets sets; ///< joined from the threads', under the lock
} gathering;

enum { SEGMENTS_A_UNIT = 16384 };
/// The most bytes for sets where each thread has its own.
#define MOST_SET_BYTES (UINT64_C(1) << 30)

static sl_status begin_sample_worker(sl_context *context, void *job, void **state) {
    const gathering *g = job;
    gatherer *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    if (sli_view_sets_create(context, g->tree->cell_count, g->object_count, &me->sets) != SL_OK) {
        sl_free(context, me);
        return SL_NO_MEMORY;
    }
    *state = me;
    return SL_OK;
}

static void end_sample_worker(sl_context *context, void *job, void *state) {
    gathering *g = job;
    gatherer *me = state;
    pthread_mutex_lock(&g->lock);
    if (g->sets.bits) {
        const size_t words = g->sets.count * g->sets.words;
        for (size_t i = 0; i < words; i++) g->sets.bits[i] |= me->sets.bits[i];
    } else {
        g->sets = me->sets;
        me->sets = (sl_view_sets){0};
    }
    pthread_mutex_unlock(&g->lock);
    sl_view_sets_destroy(context, &me->sets);
    sl_free(context, me->waiting.items);
    sl_free(context, me);
}

static sl_status wait(sl_context *context, gatherer *me, int32_t at, double t0, double t1) {
    SL_TRY(SL_ARRAY_ROOM(context, &me->waiting, 1));
    me->waiting.items[me->waiting.count++] = (descent){at, t0, t1};
    return SL_OK;
}

static sl_status pass_node(sl_context *context, const gathering *g, gatherer *me, descent d,
                           const sl_segment *s) {
    const sl_view_node *node = &g->tree->nodes[d.at];
    const double a = sli_view_node_side(g->tree, node, s->a),
                 b = sli_view_node_side(g->tree, node, s->b);
    const double from = a + d.t0 * (b - a), to = a + d.t1 * (b - a);
    if (from < 0 && to < 0) return wait(context, me, node->below, d.t0, d.t1);
    if (from >= 0 && to >= 0) return wait(context, me, node->above, d.t0, d.t1);
    const double t = fmin(fmax(a / (a - b), d.t0), d.t1);
    // A segment that ends at the split has only a point on the other side.
    SL_TRY(from < 0 ? wait(context, me, node->below, d.t0, t)
                    : wait(context, me, node->below, t, d.t1));
    if (from < 0 && to == 0) return SL_OK;
    if (to < 0 && from == 0) return SL_OK;
    return from < 0 ? wait(context, me, node->above, t, d.t1)
                    : wait(context, me, node->above, d.t0, t);
}

static sl_status gather_unit(sl_context *context, void *job, void *state, size_t unit) {
    const gathering *g = job;
    gatherer *me = state;
    const sl_view_segments *segments = g->segments;
    const size_t first = unit * SEGMENTS_A_UNIT;
    for (size_t i = first; i < segments->count && i < first + SEGMENTS_A_UNIT; i++) {
        SL_TRY(wait(context, me, g->tree->root, 0, 1));
        while (me->waiting.count) {
            const descent d = me->waiting.items[--me->waiting.count];
            if (d.at >= 0) {
                SL_TRY(pass_node(context, g, me, d, &segments->items[i]));
                continue;
            }
            const uint32_t leaf = (uint32_t)~d.at;
            if (leaf >= g->tree->cell_count) continue;
            sl_bits *row = sli_view_set(&me->sets, leaf);
            for (uint64_t k = segments->first[i]; k < segments->first[i + 1]; k++)
                sl_bits_add(row, segments->objects[k]);
        }
    }
    return SL_OK;
}

sl_status sl_view_sets_sample(sl_context *context, const sl_view_scene *scene,
                              const sl_view_tree *tree, const sl_view_segments *segments,
                              unsigned threads, sl_view_sets *out) {
    const sl_space *space = scene->space;
    gathering g = {.tree = tree, .segments = segments};
    g.object_count = scene->objects == SL_VIEW_WALLS ? space->wall_count : space->cell_count;
    const uint64_t bytes = (uint64_t)tree->cell_count * sl_bits_words(g.object_count) * 8 + 1;
    if (!threads) threads = sl_core_count();
    if (threads > MOST_SET_BYTES / bytes) threads = (unsigned)(MOST_SET_BYTES / bytes);
    pthread_mutex_init(&g.lock, NULL);
    const sl_work work = {.job = &g,
                          .begin = begin_sample_worker,
                          .unit = gather_unit,
                          .end = end_sample_worker,
                          .stage = "see",
                          .units = "bundles of lines"};
    const size_t units = (segments->count + (size_t)SEGMENTS_A_UNIT) / SEGMENTS_A_UNIT;
    const sl_status status = sl_work_run(context, &work, units, threads ? threads : 1);
    pthread_mutex_destroy(&g.lock);
    if (status == SL_OK)
        *out = g.sets;
    else
        sl_view_sets_destroy(context, &g.sets);
    return status;
}
