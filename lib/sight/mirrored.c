/// What is seen in mirrors.
///
/// The map stays where it is and the eye is reflected. What the eye sees in a mirror is what its
/// mirror image sees straight through the mirror, into the room in front of it:
///
///       \    eye    /
///        \         /         The image of the eye lies behind the mirror. The reflected view
///     ===[ mirror ]===       is what the image sees between two rays, from the mirror on.
///          \     /
///           image
///
/// The expansion of the visible region (region.c) takes a reflected view of each piece of a mirror
/// that it sees. Views of one mirror that join make one part. From each part's image the same is
/// done again, up to the depth that was asked for.
///
/// Images and rays are kept as sums of two doubles (effects/mirrors.h), so behind axial mirrors all
/// is exact. Cost: an expansion for each part; parts may grow as a power of the mirrors.
#include "sight/region.h"
#include "sightline/region.h"

#include "effects/mirrors.h"
#include "geometry/orient.h"
#include "sight/region_parts.h"
#include "sightline/support.h"

#include <math.h>

// --- where rooms end at mirrors

typedef struct finder {
    sl_context *context;
    const sl_outline *outline;
    const sl_map *map;
    SL_ARRAY(sli_room_mirror) pieces;
} finder;

/// Adds a piece without what earlier pieces of the same side, from number `at` on, cover.
static sl_status add_new(finder *f, size_t at, sli_room_mirror piece) {
    const sl_point from = piece.right, to = piece.left;
    for (; at < f->pieces.count; at++) {
        const sli_room_mirror have = f->pieces.items[at];
        const double right = sli_mirror_along(from, to, have.right);
        const double left = sli_mirror_along(from, to, have.left);
        if (left <= sli_mirror_along(from, to, from) || right >= sli_mirror_along(from, to, to))
            continue;
        if (right > sli_mirror_along(from, to, from))
            SL_TRY(add_new(f, at + 1, (sli_room_mirror){from, have.right, piece.mirror}));
        if (left < sli_mirror_along(from, to, to))
            SL_TRY(add_new(f, at + 1, (sli_room_mirror){have.left, to, piece.mirror}));
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(f->context, &f->pieces, 1));
    f->pieces.items[f->pieces.count++] = piece;
    return SL_OK;
}

/// Adds the mirrors on a side that is a wall.
static sl_status add_side(finder *f, const sl_side *side) {
    const sl_wall *wall = &f->outline->space->walls[side->neighbour - SL_SIDE_WALL];
    const size_t first = f->pieces.count;
    for (uint32_t i = 0; i < f->map->mirror_count; i++) {
        const sl_glass *mirror = &f->map->mirrors[i];
        const sl_segment *at = &mirror->segment;
        sli_room_mirror piece = {.mirror = i};
        if (sli_orient(wall->a, wall->b, at->a) != 0 || sli_orient(wall->a, wall->b, at->b) != 0 ||
            !sli_mirror_covers(mirror, side->start, f->outline->sides[side->next].start,
                               &piece.right, &piece.left))
            continue;
        SL_TRY(add_new(f, first, piece));
    }
    return SL_OK;
}

static sl_status find(finder *f, uint32_t *first) {
    for (uint32_t i = 0; i < f->outline->side_count; i++) {
        const sl_side *side = &f->outline->sides[i];
        first[i] = (uint32_t)f->pieces.count;
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(f->context));
        if (side->neighbour >= SL_SIDE_WALL && side->neighbour < SL_SIDE_BORDER)
            SL_TRY(add_side(f, side));
    }
    first[f->outline->side_count] = (uint32_t)f->pieces.count;
    return SL_OK;
}

sl_status sli_room_mirrors_make(sl_context *context, const sl_outline *outline, const sl_map *map,
                                sli_room_mirrors *out) {
    finder f = {.context = context, .outline = outline, .map = map};
    uint32_t *first = sl_alloc_array(context, (size_t)outline->side_count + 1, sizeof *first);
    const sl_status status = first ? find(&f, first) : SL_NO_MEMORY;
    if (status == SL_OK) {
        *out = (sli_room_mirrors){outline, map, first, f.pieces.items};
        return SL_OK;
    }
    sl_free(context, f.pieces.items);
    sl_free(context, first);
    return status;
}

void sli_room_mirrors_destroy(sl_context *context, sli_room_mirrors *mirrors) {
    sl_free(context, mirrors->first);
    sl_free(context, mirrors->pieces);
    *mirrors = (sli_room_mirrors){0};
}

// --- the parts of a mirrored region

typedef struct maker {
    sl_context *context;
    const sli_room_mirrors *mirrors;
    uint32_t depth;
    double range;
    sl_mirrored_region *out;
} maker;

/// A part whose mirrors are next.
typedef struct parent {
    uint32_t number, depth;
    const struct sli_region_memory *memory;
    sli_mirror_frame frame;
    bool rounded;
} parent;

static sl_segment mirror_at(const maker *m, const sli_reflected_view *reflected) {
    return m->mirrors->map->mirrors[reflected->mirror].segment;
}

/// Reflects a view in its mirror: its left ray becomes its right one.
static sli_reflected_view fold(const maker *m, const sli_reflected_view *seen,
                               const sli_eye_place *eye, bool *rounded) {
    const sl_segment mirror = mirror_at(m, seen);
    const sli_fine right = sli_fold(mirror, &(sli_fine){seen->left.at, seen->left.rest}, rounded);
    const sli_fine left = sli_fold(mirror, &(sli_fine){seen->right.at, seen->right.rest}, rounded);
    return (sli_reflected_view){seen->side, seen->mirror, sli_eye_ray_fine(eye, &right),
                                sli_eye_ray_fine(eye, &left)};
}

/// How many reflected views from this one on join: of one mirror, and each where the last ended.
static size_t run_of(const struct sli_region_memory *m, size_t from) {
    size_t i = from + 1;
    while (i < m->reflected_views.count &&
           m->reflected_views.items[i].mirror == m->reflected_views.items[from].mirror &&
           sli_eye_turn(&m->eye, &m->reflected_views.items[i - 1].left,
                        &m->reflected_views.items[i].right) == 0)
        i++;
    return i - from;
}

static double larger(double a, double b) {
    return fmax(fabs(a), fabs(b));
}

/// The error bound of a fine eye (sli_eye_place): each offset errs by 2^-104 of the largest
/// coordinate, times the largest coordinate, with room to spare.
static double slack_of(const sl_outline *outline, const sl_view *view) {
    const sl_box *b = &outline->space->bounds;
    const sl_point points[3] = {view->eye, view->right, view->left};
    double most = fmax(larger(b->min.x, b->max.x), larger(b->min.y, b->max.y));
    for (int i = 0; i < 3; i++) most = fmax(most, larger(points[i].x, points[i].y));
    return 0x1p-98 * most * most;
}

static bool has_rest(const sli_eye_ray *ray) {
    return ray->rest.x != 0 || ray->rest.y != 0;
}

/// Makes the polygon that `count` folded reflected views show, from left to right.
static sl_status make_polygon(maker *m, sl_region *region,
                              const sli_reflected_view *reflected_views, size_t count) {
    sl_context *context = m->context;
    const sl_outline *outline = m->mirrors->outline;
    const sli_reflected_view *rightmost = &reflected_views[count - 1],
                             *leftmost = &reflected_views[0];
    const sl_segment mirror = mirror_at(m, rightmost);
    const sl_region_edge radial = {SL_NO_WALL, SL_EDGE_CONE, false};
    const sl_region_edge near = {outline->sides[leftmost->side].neighbour - SL_SIDE_WALL,
                                 SL_EDGE_MIRROR, false};
    SL_TRY(
        sli_region_add_on_mirror(context, region, &rightmost->right, mirror.a, mirror.b, radial));
    for (size_t i = count; i-- > 0;)
        SL_TRY(sli_region_look_in(context, outline, region, &reflected_views[i]));
    SL_TRY(sli_region_add_on_mirror(context, region, &leftmost->left, mirror.a, mirror.b, near));
    if (region->count < 3) region->count = 0;
    return region->count && region->range > 0 ? sli_region_cut_mirrored(context, region) : SL_OK;
}

/// Where the points of a part are in mirrored space.
static sl_status place_image(maker *m, const sli_mirror_frame *frame, sl_mirror_part *part) {
    bool rounded;
    part->image = sl_alloc_array(m->context, part->region.count, sizeof *part->image);
    if (!part->image) return SL_NO_MEMORY;
    for (size_t i = 0; i < part->region.count; i++)
        part->image[i] = sli_mirror_frame_place(frame, part->region.points[i], &rounded);
    return SL_OK;
}

static sl_status expand_all(maker *m, const parent *from);

/// Adds the part, unless nothing of it is in range, and then the parts that are seen in it.
static sl_status keep(maker *m, const parent *from, sl_mirror_part *part) {
    sl_mirrored_region *out = m->out;
    const sl_segment mirror = m->mirrors->map->mirrors[part->mirror].segment;
    const parent here = {(uint32_t)out->part_count, part->depth, part->region.memory,
                         sli_mirror_frame_reflect(&from->frame, mirror), part->rounded};
    if (!part->region.count) return SL_OK;
    SL_TRY(place_image(m, &here.frame, part));
    SL_TRY(sl_reserve(m->context, &out->parts, &out->part_room, out->part_count + 1,
                      sizeof *out->parts));
    out->parts[out->part_count++] = *part;
    *part = (sl_mirror_part){0};
    SL_TRY(expand_all(m, &here));
    sli_region_settle(m->context, &out->parts[here.number].region);
    return SL_OK;
}

static void drop(sl_context *context, sl_mirror_part *part) {
    sl_region_destroy(context, &part->region);
    sl_free(context, part->image);
}

/// Makes the part that reflected views of one mirror, side by side, show.
static sl_status expand_mirror(maker *m, const parent *from, const sli_reflected_view *seen,
                               sli_reflected_view *folded, size_t count) {
    const sl_outline *outline = m->mirrors->outline;
    sl_mirror_part part = {.mirror = seen->mirror,
                           .parent = from->number,
                           .depth = from->depth + 1,
                           .rounded = from->rounded};
    sli_eye_place eye = {.point =
                             sli_fold(mirror_at(m, seen), &from->memory->eye.point, &part.rounded)};
    eye.fine = eye.point.rest.x != 0 || eye.point.rest.y != 0;
    for (size_t i = 0; i < count; i++) {
        folded[i] = fold(m, &seen[i], &eye, &part.rounded);
        eye.fine = eye.fine || has_rest(&folded[i].right) || has_rest(&folded[i].left);
    }
    const sl_view view = {
        .eye = eye.point.at, .left = folded[0].left.at, .right = folded[count - 1].right.at};
    eye.slack = slack_of(outline, &view);
    SL_TRY(sli_region_start(m->context, outline, &view, m->range, &part.region));
    part.region.cell = m->out->direct.cell;
    part.region.memory->eye = eye;
    part.region.memory->limit += eye.fine ? eye.slack : 0;
    part.region.memory->mirrors = part.depth < m->depth ? m->mirrors : NULL;
    sl_status status = make_polygon(m, &part.region, folded, count);
    if (status == SL_OK) status = keep(m, from, &part);
    drop(m->context, &part);
    return status;
}

static sl_status expand_all(maker *m, const parent *from) {
    const struct sli_region_memory *memory = from->memory;
    SL_TRY(sl_check_cancelled(m->context));
    if (!memory->reflected_views.count) return SL_OK;
    sli_reflected_view *folded =
        sl_alloc_array(m->context, memory->reflected_views.count, sizeof *folded);
    if (!folded) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (size_t i = 0, run; i < memory->reflected_views.count && status == SL_OK; i += run) {
        run = run_of(memory, i);
        status = expand_mirror(m, from, &memory->reflected_views.items[i], folded, run);
    }
    sl_free(m->context, folded);
    return status;
}

static void empty(sl_context *context, sl_mirrored_region *region) {
    for (size_t i = 0; i < region->part_count; i++) drop(context, &region->parts[i]);
    region->part_count = 0;
}

sl_status sli_mirrored_region_make(sl_context *context, const sli_room_mirrors *mirrors,
                                   const sl_view *view, double range, uint32_t depth,
                                   sl_mirrored_region *out) {
    maker m = {context, mirrors, depth, range, out};
    sl_region *direct = &out->direct;
    empty(context, out);
    direct->count = 0;
    SL_TRY(sli_region_check_view(context, view, range));
    SL_TRY(sli_region_start(context, mirrors->outline, view, range, direct));
    direct->cell = sli_eye_cell(mirrors->outline->space, view->eye);
    direct->memory->mirrors = depth ? mirrors : NULL;
    sl_status status = sli_region_spread(context, mirrors->outline, direct);
    const parent all = {SL_NO_PART, 0, direct->memory, sli_mirror_frame_of_map(), false};
    if (status == SL_OK && depth) status = expand_all(&m, &all);
    if (status != SL_OK) {
        empty(context, out);
        direct->count = 0;
    }
    return status;
}

void sl_mirrored_region_destroy(sl_context *context, sl_mirrored_region *region) {
    empty(context, region);
    sl_free(context, region->parts);
    sl_region_destroy(context, &region->direct);
    *region = (sl_mirrored_region){0};
}

/// The frame of a part follows from those of its parents. There are as many as it has reflections.
static sli_mirror_frame frame_of(const sl_map *map, const sl_mirrored_region *region,
                                 uint32_t part) {
    if (part == SL_NO_PART) return sli_mirror_frame_of_map();
    const sl_mirror_part *p = &region->parts[part];
    const sli_mirror_frame before = frame_of(map, region, p->parent);
    return sli_mirror_frame_reflect(&before, map->mirrors[p->mirror].segment);
}

sl_point sl_mirror_part_place(const sl_map *map, const sl_mirrored_region *region, uint32_t part,
                              sl_point point) {
    const sli_mirror_frame frame = frame_of(map, region, part);
    bool rounded = false;
    return sli_mirror_frame_place(&frame, point, &rounded);
}

double sl_mirrored_area(const sl_mirrored_region *region) {
    double sum = 0;
    for (size_t i = 0; i < region->part_count; i++) sum += sl_region_area(&region->parts[i].region);
    return sum;
}
