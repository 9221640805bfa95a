/// Top-down subdivision of view space (Mattausch et al. 2006, section 4.2).
///
/// View space is one part at first. A priority queue holds the parts, each with the split that its
/// method has chosen. The part at the front is split, its segments (or pieces, pieces.h) are dealt
/// to the halves, and the halves are queued, until there are as many parts as asked for.
///
/// A split depends on its part alone. So where pieces make splits dear, the parts at the front are
/// split ahead by all threads; the tree is the same for any number of threads.
///
/// Cost: with segments, O(segments of the part) a split, so about O(s log n) for s segments and n
/// parts where splits are even.
#include "study/view_cells/divide.h"

#include "sightline/support.h"

#include <math.h>
#include <string.h>

// --- what pieces see

static void add_extent(sli_view_divider *d, sli_view_part *part, sl_point middle, uint32_t object,
                       const sli_view_extent *from) {
    sli_view_extent *extent = &d->extents[object];
    if (extent->low[0] == INFINITY) {
        d->seen.items[d->seen.count++] = object;
        part->seen += sli_view_render_object(&d->render, object, middle);
    }
    sli_view_extent_join(extent, from);
}

void sli_view_find_piece_extents(sli_view_divider *d, sli_view_part *part) {
    const sli_view_rooms *rooms = &d->pieces->rooms;
    const sl_point middle = sli_view_part_middle(part);
    d->seen.count = 0;
    part->seen = 0;
    for (size_t i = 0; i < part->pieces.count; i++) {
        const sli_view_piece *piece = &d->pieces->items.items[part->pieces.items[i]];
        const uint32_t room = piece->room, own = rooms->object[room];
        if (own != SLI_NO_OBJECT) add_extent(d, part, middle, own, &piece->box);
        for (uint32_t k = rooms->first_side[room]; k < rooms->first_side[room + 1]; k++)
            if (rooms->sides[k].room == SLI_NO_ROOM)
                add_extent(d, part, middle, rooms->sides[k].object, &piece->box);
        for (int q = 0; q < SLI_VIEW_QUADRANTS; q++) {
            d->pieces->work.weighed += piece->directed[q].objects.count;
            for (size_t k = 0; k < piece->directed[q].objects.count; k++) {
                const sli_view_sight *sight = &piece->directed[q].objects.items[k];
                add_extent(d, part, middle, sight->object, &sight->from);
            }
        }
    }
}

static sl_status add_piece(sl_context *context, sli_view_part *part, uint32_t number) {
    SL_TRY(SL_ARRAY_ROOM(context, &part->pieces, 1));
    part->pieces.items[part->pieces.count++] = number;
    return SL_OK;
}

/// The sides of a split that a piece lies on: 1 below, 2 above, 3 both.
static int sides_of_piece(const sli_view_pieces *pieces, uint32_t number,
                          const sli_view_split *split) {
    const sli_view_extent *box = &pieces->items.items[number].box;
    if (box->high[split->axis] <= split->position) return 1;
    return box->low[split->axis] >= split->position ? 2 : 3;
}

/// Finds the halves of the pieces that lie on both sides of a part's split, once the part's own
/// halves are there.
static sl_status halve_pieces(sl_context *context, const sli_view_pieces *pieces,
                              sli_view_searcher *searcher, const sli_view_part *part,
                              sli_view_part_halves *cut) {
    const sli_view_split *split = &part->split;
    for (size_t i = 0; i < part->pieces.count; i++) {
        const uint32_t number = part->pieces.items[i];
        if (sides_of_piece(pieces, number, split) != 3) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &cut->pieces, 1));
        sli_view_halves *halves = &cut->pieces.items[cut->pieces.count++];
        *halves = (sli_view_halves){0};
        // What is seen from a half without viewpoints is never used.
        SL_TRY(sli_view_pieces_halve(context, pieces, searcher, number, split->axis,
                                     split->position, cut->below.mass > 0, cut->above.mass > 0,
                                     halves));
    }
    return SL_OK;
}

/// Deals the pieces of a part to its halves; those on both sides are cut.
static sl_status deal_pieces(sli_view_divider *d, const sli_view_part *part,
                             sli_view_part_halves *cut) {
    size_t next = 0;
    for (size_t i = 0; i < part->pieces.count; i++) {
        const uint32_t number = part->pieces.items[i];
        const int sides = sides_of_piece(d->pieces, number, &part->split);
        uint32_t above = number;
        if (sides == 3)
            SL_TRY(sli_view_pieces_cut(d->pieces, number, &cut->pieces.items[next++], &above));
        if (sides & 1) SL_TRY(add_piece(d->context, &cut->below, number));
        if (sides & 2) SL_TRY(add_piece(d->context, &cut->above, above));
    }
    return SL_OK;
}

/// The sets of all leaves with mass, from what their pieces see.
static sl_status make_sets(const sli_view_divider *d, sl_view_sets *sets) {
    SL_TRY(sli_view_sets_create(d->context, d->with_mass, d->render.object_count, sets));
    uint32_t leaf = 0;
    for (size_t i = 0; i < d->parts.count; i++) {
        const sli_view_part *part = &d->parts.items[i];
        if (!(part->mass > 0)) continue;
        sl_bits *row = sli_view_set(sets, leaf++);
        for (size_t k = 0; k < part->pieces.count; k++)
            sli_view_piece_add_to(d->pieces, &d->pieces->items.items[part->pieces.items[k]], row);
    }
    return SL_OK;
}

// --- parts

sl_view_subdivision sl_view_subdivision_default(void) {
    return (sl_view_subdivision){.cells = 2000,
                                 .least_gain = 1e-7,
                                 .patience = 100,
                                 .cost_weight = 0.01,
                                 .weighed = 100000,
                                 .visible_share = 0.02,
                                 .deepest = 14,
                                 .seed = 1};
}

int sli_view_longer_axis(const sli_view_part *part) {
    return part->box.max.y - part->box.min.y > part->box.max.x - part->box.min.x;
}

bool sli_view_split_middle(const sli_view_part *part, int axis, sli_view_split *out) {
    const double low = sli_along(part->box.min, axis), high = sli_along(part->box.max, axis);
    const double middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) return false;
    *out = (sli_view_split){.axis = axis, .position = middle};
    return true;
}

void sli_view_find_seen(sli_view_divider *d, sli_view_part *part) {
    if (d->pieces) {
        sli_view_find_piece_extents(d, part);
        sli_view_forget_extents(d);
        return;
    }
    const sl_point middle = sli_view_part_middle(part);
    const size_t step = sli_view_step(d, part);
    d->seen.count = 0;
    part->seen = 0;
    for (size_t i = 0; i < part->segments.count; i += step) {
        const uint64_t *first = &d->segments->first[part->segments.items[i]];
        for (uint64_t k = first[0]; k < first[1]; k++) {
            const uint32_t object = d->segments->objects[k];
            if (d->sides[object]) continue;
            d->sides[object] = 1;
            d->seen.items[d->seen.count++] = object;
            part->seen += sli_view_render_object(&d->render, object, middle);
        }
    }
    for (size_t i = 0; i < d->seen.count; i++) d->sides[d->seen.items[i]] = 0;
}

// --- beginning

static sl_status make_scratch(sli_view_divider *d) {
    const size_t objects = d->render.object_count;
    d->extents = sl_alloc_array(d->context, objects, sizeof *d->extents);
    if (!d->extents) return SL_NO_MEMORY;
    for (size_t i = 0; i < objects; i++) d->extents[i] = sli_view_no_extent();
    d->sides = sl_alloc_array(d->context, objects, 1);
    if (!d->sides) return SL_NO_MEMORY;
    return SL_ARRAY_ROOM(d->context, &d->seen, objects);
}

static sl_status copy_share(sl_context *context, const sl_view_places *places,
                            sli_view_share *share) {
    const uint32_t points = places->first[places->count];
    SL_TRY(SL_ARRAY_ROOM(context, &share->points, points));
    SL_TRY(SL_ARRAY_ROOM(context, &share->ends, places->count));
    SL_TRY(SL_ARRAY_ROOM(context, &share->mass, places->count));
    memcpy(share->points.items, places->points, points * sizeof *share->points.items);
    share->points.count = points;
    double all = 0;
    for (uint32_t i = 0; i < places->count; i++) all += places->mass[i];
    for (uint32_t i = 0; i < places->count; i++) {
        share->ends.items[share->ends.count++] = places->first[i + 1];
        share->mass.items[share->mass.count++] = places->mass[i] / all;
    }
    return SL_OK;
}

/// The part that is all of view space.
static sl_status make_first(sli_view_divider *d, sli_view_part *part) {
    const sl_box *b = &d->scene->space->bounds;
    const sl_point corners[4] = {b->min, {b->max.x, b->min.y}, b->max, {b->min.x, b->max.y}};
    *part = (sli_view_part){.box = *b, .is_box = true, .mass = 1, .parent = -1};
    SL_TRY(SL_ARRAY_ROOM(d->context, &part->corners, 4));
    SL_TRY(SL_ARRAY_ROOM(d->context, &part->edges, 4));
    for (int i = 0; i < 4; i++) {
        part->corners.items[part->corners.count++] = corners[i];
        part->edges.items[part->edges.count++] = UINT32_MAX;
    }
    const uint32_t count = d->segments ? d->segments->count : 0;
    SL_TRY(SL_ARRAY_ROOM(d->context, &part->segments, count));
    for (uint32_t i = 0; i < count; i++) part->segments.items[part->segments.count++] = i;
    const uint32_t pieces = d->pieces ? (uint32_t)d->pieces->items.count : 0;
    SL_TRY(SL_ARRAY_ROOM(d->context, &part->pieces, pieces));
    for (uint32_t i = 0; i < pieces; i++) part->pieces.items[part->pieces.count++] = i;
    return copy_share(d->context, d->scene->places, &part->share);
}

/// Queues a part, if it is to be split at all.
static sl_status enqueue(sli_view_divider *d, sli_view_choose choose, uint32_t number) {
    sli_view_part *part = &d->parts.items[number];
    if (!(part->mass > 0)) return SL_OK;
    double priority = 0;
    bool splits = false;
    SL_TRY(choose(d, part, &priority, &splits));
    if (!splits) return SL_OK;
    return sli_view_queue_push(d->context, &d->queue,
                               (sli_view_entry){.key = priority, .a = number});
}

// --- splitting

/// The sides of the part's split that a segment is on: 1 below, 2 above, 3 both. It is on a side
/// where it has more than a point there. Along the split it is above.
static int sides_of(const sli_view_part *part, const sl_segment *s) {
    const sli_view_split *split = &part->split;
    double from = sli_view_side(split, s->a), to = sli_view_side(split, s->b);
    if (from >= 0 && to >= 0) return 2;
    if (from <= 0 && to <= 0) return 1;
    const sl_segment inner = sli_view_part_clip(part, s);
    from = sli_view_side(split, inner.a);
    to = sli_view_side(split, inner.b);
    const bool below = from < 0 || to < 0;
    const bool above = from > 0 || to > 0 || (from >= 0 && to >= 0);
    return (below ? 1 : 0) | (above ? 2 : 0);
}

static sl_status deal_segments(sli_view_divider *d, const sli_view_part *part, sli_view_part *below,
                               sli_view_part *above) {
    for (size_t i = 0; i < part->segments.count; i++) {
        const uint32_t number = part->segments.items[i];
        const int sides = sides_of(part, &d->segments->items[number]);
        if (sides & 1) {
            SL_TRY(SL_ARRAY_ROOM(d->context, &below->segments, 1));
            below->segments.items[below->segments.count++] = number;
        }
        if (sides & 2) {
            SL_TRY(SL_ARRAY_ROOM(d->context, &above->segments, 1));
            above->segments.items[above->segments.count++] = number;
        }
    }
    return SL_OK;
}

static sl_status add_node(sli_view_divider *d, const sli_view_part *part) {
    const sli_view_split *split = &part->split;
    if (d->nodes.count == INT32_MAX - 1) return sl_fail_memory(d->context);
    SL_TRY(SL_ARRAY_ROOM(d->context, &d->nodes, 1));
    sl_view_node node = {.position = split->position, .axis = split->axis};
    if (split->axis == 2) {
        SL_TRY(SL_ARRAY_ROOM(d->context, &d->lines, 1));
        node.line = (int32_t)d->lines.count;
        node.position = 0;
        d->lines.items[d->lines.count++] = split->line;
    }
    if (part->parent >= 0) {
        sl_view_node *parent = &d->nodes.items[part->parent];
        *(part->above ? &parent->above : &parent->below) = (int32_t)d->nodes.count;
    }
    d->nodes.items[d->nodes.count++] = node;
    return SL_OK;
}

static void set_new_edges(sli_view_part *part, uint32_t node) {
    for (size_t i = 0; i < part->edges.count; i++)
        if (part->edges.items[i] == SLI_VIEW_EDGE_NEW) part->edges.items[i] = node;
}

/// Splits a part. The half below takes its number.
static sl_status split(sli_view_divider *d, sli_view_choose choose, uint32_t number) {
    SL_TRY(SL_ARRAY_ROOM(d->context, &d->parts, 1));
    sli_view_part *part = &d->parts.items[number];
    sli_view_part_halves *cut = part->cut;
    const uint32_t node = (uint32_t)d->nodes.count;
    set_new_edges(&cut->below, node);
    set_new_edges(&cut->above, node);
    cut->below.parent = cut->above.parent = (int32_t)node;
    cut->above.above = true;
    if (d->segments) SL_TRY(deal_segments(d, part, &cut->below, &cut->above));
    if (d->pieces) SL_TRY(deal_pieces(d, part, cut));
    SL_TRY(add_node(d, part));
    const sli_view_part below = cut->below, above = cut->above;
    cut->below = cut->above = (sli_view_part){0};
    sli_view_part_destroy(d->context, part);
    *part = below;
    d->parts.items[d->parts.count++] = above;
    d->with_mass += (uint32_t)(below.mass > 0) + (above.mass > 0) - 1;
    SL_TRY(enqueue(d, choose, number));
    return enqueue(d, choose, (uint32_t)d->parts.count - 1);
}

// --- ahead

/// Parts at the front of the queue that are split ahead, for each thread. Most of them are needed
/// later.
enum { AHEAD_A_THREAD = 16 };

/// Parts that are to be cut.
typedef struct ahead {
    sli_view_divider *divider;
    sli_view_numbers parts;
} ahead;

static sl_status begin_cutting(sl_context *context, void *job, void **state) {
    sli_view_pieces *pieces = ((ahead *)job)->divider->pieces;
    sli_view_searcher *searcher = NULL;
    if (pieces) SL_TRY(sli_view_searcher_take(context, pieces, &searcher));
    *state = searcher;
    return SL_OK;
}

static void end_cutting(sl_context *context, void *job, void *state) {
    (void)context;
    if (state) sli_view_searcher_give(((ahead *)job)->divider->pieces, state);
}

static sl_status cut_part(sl_context *context, void *job, void *state, size_t unit) {
    const ahead *a = job;
    sli_view_divider *d = a->divider;
    sli_view_part *part = &d->parts.items[a->parts.items[unit]];
    part->cut = sl_alloc_array(context, 1, sizeof *part->cut);
    if (!part->cut) return SL_NO_MEMORY;
    SL_TRY(sli_view_part_cut(context, part, &part->split, SLI_VIEW_EDGE_NEW, &part->cut->below,
                             &part->cut->above));
    if (!d->pieces) return SL_OK;
    return halve_pieces(context, d->pieces, state, part, part->cut);
}

/// Lists the part that is split next and, where pieces are cut, those that come after it.
static sl_status list_ahead(sli_view_divider *d, unsigned threads, ahead *a) {
    size_t most = d->pieces && threads > 1 ? (size_t)AHEAD_A_THREAD * threads : 1;
    if (most > d->options->cells - d->with_mass) most = d->options->cells - d->with_mass;
    sli_view_queue looked_at = {0};
    sl_status status = SL_OK;
    while (status == SL_OK && d->queue.count && looked_at.count < most) {
        status = SL_ARRAY_ROOM(d->context, &looked_at, 1);
        if (status == SL_OK) status = SL_ARRAY_ROOM(d->context, &a->parts, 1);
        if (status != SL_OK) break;
        const sli_view_entry item = sli_view_queue_pop(&d->queue);
        looked_at.items[looked_at.count++] = item;
        if (!d->parts.items[item.a].cut) a->parts.items[a->parts.count++] = item.a;
    }
    while (status == SL_OK && looked_at.count)
        status = sli_view_queue_push(d->context, &d->queue, looked_at.items[--looked_at.count]);
    sl_free(d->context, looked_at.items);
    return status;
}

static sl_status cut_ahead(sli_view_divider *d) {
    const unsigned threads = d->options->threads ? d->options->threads : sl_core_count();
    ahead a = {.divider = d};
    sl_status status = list_ahead(d, threads, &a);
    const sl_work work = {.job = &a, .begin = begin_cutting, .unit = cut_part, .end = end_cutting};
    if (status == SL_OK) status = sl_work_run(d->context, &work, a.parts.count, threads);
    sl_free(d->context, a.parts.items);
    return status;
}

static sl_status divide(sli_view_divider *d, sli_view_choose choose, bool stops_early) {
    SL_TRY(make_scratch(d));
    SL_TRY(SL_ARRAY_ROOM(d->context, &d->parts, 1));
    d->parts.items[d->parts.count++] = (sli_view_part){0};
    SL_TRY(make_first(d, &d->parts.items[0]));
    d->with_mass = 1;
    sli_view_part *whole = &d->parts.items[0];
    if (d->segments || d->pieces) sli_view_find_seen(d, whole);
    const double first_cost = whole->seen;
    SL_TRY(enqueue(d, choose, 0));
    uint32_t without_gain = 0;
    while (d->queue.count && d->with_mass < d->options->cells) {
        SL_TRY(sl_check_cancelled(d->context));
        if (!d->parts.items[d->queue.items[0].a].cut) SL_TRY(cut_ahead(d));
        const uint32_t number = sli_view_queue_pop(&d->queue).a;
        const double gain = d->parts.items[number].split.gain;
        without_gain = gain < d->options->least_gain * first_cost ? without_gain + 1 : 0;
        if (stops_early && without_gain >= d->options->patience) break;
        SL_TRY(split(d, choose, number));
        sl_report(d->context, "divide", "view cells", d->with_mass, d->options->cells);
    }
    return SL_OK;
}

// --- ending

static sl_status make_leaf_arrays(sli_view_divider *d, sl_view_tree *tree) {
    size_t corners = 0;
    for (size_t i = 0; i < d->parts.count; i++) corners += d->parts.items[i].corners.count;
    if (corners > UINT32_MAX) return sl_fail_memory(d->context);
    tree->leaf_count = (uint32_t)d->parts.count;
    tree->cell_count = d->with_mass;
    tree->corners = sl_alloc_array(d->context, corners, sizeof *tree->corners);
    tree->edges = sl_alloc_array(d->context, corners, sizeof *tree->edges);
    tree->first = sl_alloc_array(d->context, tree->leaf_count + (size_t)1, sizeof *tree->first);
    tree->mass = sl_alloc_array(d->context, tree->leaf_count, sizeof *tree->mass);
    return tree->corners && tree->edges && tree->first && tree->mass ? SL_OK : SL_NO_MEMORY;
}

/// Leaves are numbered in the order in which they were made, those with mass first.
static void fill_leaves(sli_view_divider *d, sl_view_tree *tree) {
    uint32_t number = 0;
    for (int empty = 0; empty < 2; empty++)
        for (size_t i = 0; i < d->parts.count; i++) {
            const sli_view_part *part = &d->parts.items[i];
            if ((part->mass > 0) == (empty == 1)) continue;
            const uint32_t first = tree->first[number];
            memcpy(tree->corners + first, part->corners.items,
                   part->corners.count * sizeof *tree->corners);
            memcpy(tree->edges + first, part->edges.items, part->edges.count * sizeof *tree->edges);
            tree->mass[number] = part->mass;
            if (part->parent < 0)
                tree->root = ~(int32_t)number;
            else if (part->above)
                d->nodes.items[part->parent].above = ~(int32_t)number;
            else
                d->nodes.items[part->parent].below = ~(int32_t)number;
            tree->first[++number] = first + (uint32_t)part->corners.count;
        }
}

static sl_status make_tree(sli_view_divider *d, sl_view_tree *tree) {
    tree->bounds = d->scene->space->bounds;
    SL_TRY(make_leaf_arrays(d, tree));
    fill_leaves(d, tree);
    tree->node_count = (uint32_t)d->nodes.count;
    tree->line_count = (uint32_t)d->lines.count;
    tree->nodes = d->nodes.items;
    tree->lines = d->lines.items;
    d->nodes.items = NULL;
    d->lines.items = NULL;
    return SL_OK;
}

static void destroy(sli_view_divider *d) {
    for (size_t i = 0; i < d->parts.count; i++)
        sli_view_part_destroy(d->context, &d->parts.items[i]);
    sl_free(d->context, d->extents);
    sl_free(d->context, d->parts.items);
    sl_free(d->context, d->nodes.items);
    sl_free(d->context, d->lines.items);
    sl_free(d->context, d->queue.items);
    sl_free(d->context, d->sides);
    sl_free(d->context, d->seen.items);
    sl_free(d->context, d->starts.items);
    sl_free(d->context, d->ends.items);
    sl_free(d->context, d->positions.items);
    sl_free(d->context, d->clipped.items);
    sl_free(d->context, d->walls.items);
    sli_view_render_destroy(d->context, &d->render);
}

static sl_status check_options(sl_context *context, const sl_view_subdivision *o) {
    if (!o->cells || !o->patience || !o->weighed)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "view cells, patience and segments weighed: at least 1 is needed");
    if (!(o->cost_weight >= 0 && o->cost_weight <= 1) || !(o->least_gain >= 0) ||
        !(o->visible_share >= 0))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the cost's weight must be 0 to 1, the least gain and the visible share "
                       "not negative");
    return SL_OK;
}

sl_status sli_view_divide(sl_context *context, const sl_view_scene *scene,
                          const sl_view_segments *segments, sli_view_pieces *pieces,
                          const sl_view_subdivision *options, sli_view_choose choose,
                          bool stops_early, sl_view_tree *out, sl_view_sets *sets) {
    SL_TRY(check_options(context, options));
    sli_view_divider d = {.context = context,
                          .scene = scene,
                          .segments = segments,
                          .pieces = pieces,
                          .options = options,
                          .random = {options->seed}};
    SL_TRY(sli_view_render_make(context, scene, &d.render));
    for (uint32_t i = 0; i < d.render.object_count; i++) d.all_seen += d.render.fixed[i];
    sl_view_tree tree = {0};
    sl_status status = divide(&d, choose, stops_early);
    if (status == SL_OK) status = make_tree(&d, &tree);
    if (status == SL_OK && sets) status = make_sets(&d, sets);
    destroy(&d);
    if (status == SL_OK)
        *out = tree;
    else
        sl_view_tree_destroy(context, &tree);
    return status;
}
