/// What is seen in mirrors: from the eye's image, straight through each piece of a mirror that was
/// seen, into the room in front of it. The map stays where it is; the image and the rays that bound
/// the piece are reflected (effects/mirrors.h).
#include "sightline/mirrored.h"

#include "effects/mirrors.h"
#include "eye_to_cell/region_parts.h"

#include <math.h>

typedef struct maker {
    sl_context *context;
    const sl_room_mirrors *mirrors;
    uint32_t depth;
    double range;
    sl_mirrored_region *out;
} maker;

/// A part whose mirrors are still to be looked into.
typedef struct parent {
    uint32_t number, depth;
    const struct sl_region_memory *memory;
    sl_mirror_frame frame;
    bool rounded;
} parent;

static sl_segment mirror_at(const maker *m, const sl_reflected_view *reflected) {
    return m->mirrors->map->mirrors[reflected->mirror].segment;
}

/// A reflected view as its mirror shows it: what was its left ray is its right one.
static sl_reflected_view fold(const maker *m, const sl_reflected_view *seen,
                              const sl_eye_place *eye, bool *rounded) {
    const sl_segment mirror = mirror_at(m, seen);
    const sl_fine right = sl_fold(mirror, &(sl_fine){seen->left.at, seen->left.rest}, rounded);
    const sl_fine left = sl_fold(mirror, &(sl_fine){seen->right.at, seen->right.rest}, rounded);
    return (sl_reflected_view){seen->side, seen->mirror, sl_eye_ray_fine(eye, &right),
                               sl_eye_ray_fine(eye, &left)};
}

/// How many reflected views, from one on, join into one of a single mirror.
static size_t run_of(const struct sl_region_memory *m, size_t from) {
    size_t i = from + 1;
    while (i < m->reflected_views.count &&
           m->reflected_views.items[i].mirror == m->reflected_views.items[from].mirror &&
           sl_eye_turn(&m->eye, &m->reflected_views.items[i - 1].left,
                       &m->reflected_views.items[i].right) == 0)
        i++;
    return i - from;
}

static double larger(double a, double b) {
    return fmax(fabs(a), fabs(b));
}

/// What the offsets of a fine eye may err by, as sl_eye_place has it: each by 2^-104 of the largest
/// coordinate, times as much as that and to spare.
static double slack_of(const sl_outline *outline, const sl_view *view) {
    const sl_box *b = &outline->space->bounds;
    const sl_point points[3] = {view->eye, view->right, view->left};
    double most = fmax(larger(b->min.x, b->max.x), larger(b->min.y, b->max.y));
    for (int i = 0; i < 3; i++) most = fmax(most, larger(points[i].x, points[i].y));
    return 0x1p-98 * most * most;
}

static bool has_rest(const sl_eye_ray *ray) {
    return ray->rest.x != 0 || ray->rest.y != 0;
}

/// Makes the polygon of what `count` reflected views show, which are folded, from left to right.
static sl_status look_in(maker *m, sl_region *region, const sl_reflected_view *reflected_views,
                         size_t count) {
    sl_context *context = m->context;
    const sl_outline *outline = m->mirrors->outline;
    const sl_reflected_view *rightmost = &reflected_views[count - 1],
                            *leftmost = &reflected_views[0];
    const sl_segment mirror = mirror_at(m, rightmost);
    const sl_region_edge radial = {SL_NO_WALL, SL_EDGE_CONE, false};
    const sl_region_edge near = {outline->sides[leftmost->side].neighbour - SL_SIDE_WALL,
                                 SL_EDGE_MIRROR, false};
    SL_TRY(sl_region_add_on_mirror(context, region, &rightmost->right, mirror.a, mirror.b, radial));
    for (size_t i = count; i-- > 0;)
        SL_TRY(sl_region_look_in(context, outline, region, &reflected_views[i]));
    SL_TRY(sl_region_add_on_mirror(context, region, &leftmost->left, mirror.a, mirror.b, near));
    if (region->count < 3) region->count = 0;
    return region->count && region->range > 0 ? sl_region_cut_mirrored(context, region) : SL_OK;
}

/// Where the points of a part are in mirrored space.
static sl_status place_image(maker *m, const sl_mirror_frame *frame, sl_mirror_part *part) {
    bool rounded;
    part->image = sl_alloc_array(m->context, part->region.count, sizeof *part->image);
    if (!part->image) return SL_NO_MEMORY;
    for (size_t i = 0; i < part->region.count; i++)
        part->image[i] = sl_mirror_frame_place(frame, part->region.points[i], &rounded);
    return SL_OK;
}

static sl_status look_into_all(maker *m, const parent *from);

/// Adds the part, unless nothing of it is in range, and those that are seen in it.
static sl_status keep(maker *m, const parent *from, sl_mirror_part *part) {
    sl_mirrored_region *out = m->out;
    const sl_segment mirror = m->mirrors->map->mirrors[part->mirror].segment;
    const parent here = {(uint32_t)out->part_count, part->depth, part->region.memory,
                         sl_mirror_frame_reflect(&from->frame, mirror), part->rounded};
    if (!part->region.count) return SL_OK;
    SL_TRY(place_image(m, &here.frame, part));
    SL_TRY(sl_reserve(m->context, &out->parts, &out->part_room, out->part_count + 1,
                      sizeof *out->parts));
    out->parts[out->part_count++] = *part;
    *part = (sl_mirror_part){0};
    SL_TRY(look_into_all(m, &here));
    sl_region_settle(m->context, &out->parts[here.number].region);
    return SL_OK;
}

static void drop(sl_context *context, sl_mirror_part *part) {
    sl_region_destroy(context, &part->region);
    sl_free(context, part->image);
}

/// Looks into a mirror through reflected views of it that lie side by side.
static sl_status look_into(maker *m, const parent *from, const sl_reflected_view *seen,
                           sl_reflected_view *folded, size_t count) {
    const sl_outline *outline = m->mirrors->outline;
    sl_mirror_part part = {.mirror = seen->mirror,
                           .parent = from->number,
                           .depth = from->depth + 1,
                           .rounded = from->rounded};
    sl_eye_place eye = {.point =
                            sl_fold(mirror_at(m, seen), &from->memory->eye.point, &part.rounded)};
    eye.fine = eye.point.rest.x != 0 || eye.point.rest.y != 0;
    for (size_t i = 0; i < count; i++) {
        folded[i] = fold(m, &seen[i], &eye, &part.rounded);
        eye.fine = eye.fine || has_rest(&folded[i].right) || has_rest(&folded[i].left);
    }
    const sl_view view = {
        .eye = eye.point.at, .left = folded[0].left.at, .right = folded[count - 1].right.at};
    eye.slack = slack_of(outline, &view);
    SL_TRY(sl_region_start(m->context, outline, &view, m->range, &part.region));
    part.region.cell = m->out->direct.cell;
    part.region.memory->eye = eye;
    part.region.memory->limit += eye.fine ? eye.slack : 0;
    part.region.memory->mirrors = part.depth < m->depth ? m->mirrors : NULL;
    sl_status status = look_in(m, &part.region, folded, count);
    if (status == SL_OK) status = keep(m, from, &part);
    drop(m->context, &part);
    return status;
}

static sl_status look_into_all(maker *m, const parent *from) {
    const struct sl_region_memory *memory = from->memory;
    SL_TRY(sl_check_cancelled(m->context));
    if (!memory->reflected_views.count) return SL_OK;
    sl_reflected_view *folded =
        sl_alloc_array(m->context, memory->reflected_views.count, sizeof *folded);
    if (!folded) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (size_t i = 0, run; i < memory->reflected_views.count && status == SL_OK; i += run) {
        run = run_of(memory, i);
        status = look_into(m, from, &memory->reflected_views.items[i], folded, run);
    }
    sl_free(m->context, folded);
    return status;
}

static void empty(sl_context *context, sl_mirrored_region *region) {
    for (size_t i = 0; i < region->part_count; i++) drop(context, &region->parts[i]);
    region->part_count = 0;
}

sl_status sl_mirrored_region_make(sl_context *context, const sl_room_mirrors *mirrors,
                                  const sl_view *view, double range, uint32_t depth,
                                  sl_mirrored_region *out) {
    maker m = {context, mirrors, depth, range, out};
    sl_region *direct = &out->direct;
    empty(context, out);
    direct->count = 0;
    SL_TRY(sl_region_check_view(context, view, range));
    SL_TRY(sl_region_start(context, mirrors->outline, view, range, direct));
    direct->cell = sl_space_locate(mirrors->outline->space, view->eye);
    direct->memory->mirrors = depth ? mirrors : NULL;
    sl_status status = sl_region_spread(context, mirrors->outline, direct);
    const parent all = {SL_NO_PART, 0, direct->memory, sl_mirror_frame_of_map(), false};
    if (status == SL_OK && depth) status = look_into_all(&m, &all);
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

double sl_mirrored_area(const sl_mirrored_region *region) {
    double sum = 0;
    for (size_t i = 0; i < region->part_count; i++) sum += sl_region_area(&region->parts[i].region);
    return sum;
}
