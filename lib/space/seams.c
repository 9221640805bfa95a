/// Seams: doors, one-way glass and plain seams cut cells, but are seen through.
///
/// Seams of one map may overlap. They are cut where another one in the same line ends, so that each
/// part has the same seams all along:
///
///     seam 0     o-------------------o
///     seam 1              o---------------------o
///     parts      o---0----o---0,1----o----1-----o
///
/// The kd-tree takes the parts as if they were walls, so no cell runs over one. A portal then lies
/// on one part or on none, and the part tells its seams. `forward` says which way the portal
/// crosses the seam: from its right to its left, going from a to b.
#include "space/seams.h"

#include "geometry/orient.h"
#include "map/source.h"
#include "space/index.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the seams of a map

static sl_status add_seam(sl_context *context, const sl_map *map, bool axial, sl_segment at,
                          uint32_t line, sl_seam seam, sl_space *space) {
    const bool upright = at.a.x == at.b.x, level = at.a.y == at.b.y;
    if (upright && level) return SL_OK;
    static const char *const names[] = {"seam", "door", "one-way glass", "limited wall"};
    if (axial && !upright && !level)
        return sli_map_fail(context, map, SL_BAD_INPUT, line,
                            "the %s from %.17g %.17g to %.17g %.17g is neither horizontal nor "
                            "vertical, which the kd-tree needs: make it axial or leave it out",
                            names[seam.kind], at.a.x, at.a.y, at.b.x, at.b.y);
    seam.at = at;
    space->seams[space->seam_count++] = seam;
    return SL_OK;
}

static sl_status add_door(sl_context *context, const sl_map *map, bool axial, uint32_t number,
                          sl_space *space) {
    const sl_door *door = &map->doors[number];
    const sl_seam seam = {.kind = SL_SEAM_DOOR, .number = number};
    for (size_t i = 0; i < door->part_count; i++)
        SL_TRY(add_seam(context, map, axial, door->parts[i], door->line, seam, space));
    return door->parts ? SL_OK
                       : add_seam(context, map, axial, door->segment, door->line, seam, space);
}

static uint32_t kind_of(const sl_map *map, size_t seam) {
    const bool limits =
        sl_map_channel(map) & SL_STOPS_SIGHT && map->seams[seam].stops & SL_STOPS_LIMITED;
    return limits ? SL_SEAM_LIMITED : SL_SEAM_PLAIN;
}

sl_status sli_seams_of_map(sl_context *context, const sl_map *map, bool axial, sl_space *space) {
    size_t count = map->door_count + map->oneway_count + map->seam_count;
    for (size_t i = 0; i < map->door_count; i++) count += map->doors[i].part_count;
    if (!count) return SL_OK;
    if (count > INT32_MAX) return sl_fail_memory(context);
    space->seams = sl_alloc_array(context, count, sizeof *space->seams);
    if (!space->seams) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->door_count; i++)
        SL_TRY(add_door(context, map, axial, (uint32_t)i, space));
    for (size_t i = 0; i < map->oneway_count; i++)
        SL_TRY(add_seam(context, map, axial, map->oneways[i].segment, map->oneways[i].line,
                        (sl_seam){.kind = SL_SEAM_ONEWAY, .number = (uint32_t)i}, space));
    for (size_t i = 0; i < map->seam_count; i++)
        SL_TRY(add_seam(context, map, axial, map->seams[i].segment, map->seams[i].line,
                        (sl_seam){.kind = kind_of(map, i), .number = (uint32_t)i}, space));
    return SL_OK;
}

// --- parts

/// A seam, or a part of it, with its ends in order.
typedef struct stretch {
    sl_point a, b;
    sli_seam_mark mark;
} stretch;

static int compare_stretches(const void *left, const void *right) {
    const stretch *s = left, *t = right;
    const int a = sli_compare_points(s->a, t->a), b = sli_compare_points(s->b, t->b);
    if (a || b) return a ? a : b;
    return (s->mark.seam > t->mark.seam) - (s->mark.seam < t->mark.seam);
}

typedef struct parter {
    sl_context *context;
    stretch *seams;
    size_t count;
    sli_box_tree tree;   ///< of the seams
    sli_box_list nearby; ///< those near the current seam
    SL_ARRAY(stretch) parts;
    SL_ARRAY(sl_point) cuts; ///< of the current seam
} parter;

static sl_status add_cut(parter *p, const stretch *seam, sl_point at) {
    if (sli_compare_points(at, seam->a) <= 0 || sli_compare_points(at, seam->b) >= 0) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->cuts, 1));
    p->cuts.items[p->cuts.count++] = at;
    return SL_OK;
}

static int compare_cuts(const void *left, const void *right) {
    return sli_compare_points(*(const sl_point *)left, *(const sl_point *)right);
}

static sl_status add_part(parter *p, const stretch *seam, sl_point a, sl_point b) {
    if (sli_compare_points(a, b) == 0) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->parts, 1));
    p->parts.items[p->parts.count++] = (stretch){a, b, seam->mark};
    return SL_OK;
}

/// Cuts a seam where others in one line with it end.
static sl_status part_seam(parter *p, const stretch *seam) {
    const sl_box box = sli_box_around(seam->a, seam->b);
    p->cuts.count = 0;
    SL_TRY(sli_box_tree_find(p->context, &p->tree, &box, &p->nearby));
    for (size_t i = 0; i < p->nearby.count; i++) {
        const stretch *other = &p->seams[p->nearby.items[i]];
        if (sli_orient(seam->a, seam->b, other->a) != 0 ||
            sli_orient(seam->a, seam->b, other->b) != 0)
            continue;
        SL_TRY(add_cut(p, seam, other->a));
        SL_TRY(add_cut(p, seam, other->b));
    }
    if (p->cuts.count) qsort(p->cuts.items, p->cuts.count, sizeof(sl_point), compare_cuts);
    sl_point from = seam->a;
    for (size_t i = 0; i < p->cuts.count; i++) {
        SL_TRY(add_part(p, seam, from, p->cuts.items[i]));
        from = p->cuts.items[i];
    }
    return add_part(p, seam, from, seam->b);
}

/// Joins the parts that are the same segment.
static sl_status group_parts(const parter *p, sli_seam_parts *out) {
    SL_TRY(SL_ARRAY_ROOM(p->context, &out->parts, p->parts.count));
    SL_TRY(SL_ARRAY_ROOM(p->context, &out->marks, p->parts.count));
    for (size_t i = 0; i < p->parts.count; i++) {
        const stretch *part = &p->parts.items[i];
        sli_seam_part *last = out->parts.count ? &out->parts.items[out->parts.count - 1] : NULL;
        if (!last || sli_compare_points(last->a, part->a) || sli_compare_points(last->b, part->b)) {
            last = &out->parts.items[out->parts.count++];
            *last = (sli_seam_part){part->a, part->b, .first = out->marks.count};
        }
        out->marks.items[out->marks.count++] = part->mark;
        last->count++;
    }
    return SL_OK;
}

static sl_status make_tree(parter *p) {
    sl_box *boxes = sl_alloc_array(p->context, p->count, sizeof *boxes);
    if (!boxes) return SL_NO_MEMORY;
    for (size_t i = 0; i < p->count; i++) boxes[i] = sli_box_around(p->seams[i].a, p->seams[i].b);
    const sl_status status = sli_box_tree_create(p->context, boxes, p->count, &p->tree);
    sl_free(p->context, boxes);
    return status;
}

static sl_status part_all(parter *p, const sl_space *space, sli_seam_parts *out) {
    p->count = space->seam_count;
    p->seams = sl_alloc_array(p->context, p->count, sizeof *p->seams);
    if (!p->seams) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->seam_count; i++) {
        const sl_segment at = space->seams[i].at;
        const bool along = sli_compare_points(at.a, at.b) < 0;
        p->seams[i] = (stretch){along ? at.a : at.b, along ? at.b : at.a, {i, along}};
    }
    SL_TRY(make_tree(p));
    for (size_t i = 0; i < p->count; i++) {
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(p->context));
        SL_TRY(part_seam(p, &p->seams[i]));
    }
    if (p->parts.count) qsort(p->parts.items, p->parts.count, sizeof(stretch), compare_stretches);
    return group_parts(p, out);
}

sl_status sli_seams_part(sl_context *context, const sl_space *space, sli_seam_parts *out) {
    parter p = {.context = context};
    const sl_status status = part_all(&p, space, out);
    sl_free(context, p.seams);
    sl_free(context, p.parts.items);
    sl_free(context, p.cuts.items);
    sli_box_tree_destroy(context, &p.tree);
    sl_free(context, p.nearby.items);
    return status;
}

void sli_seam_parts_destroy(sl_context *context, sli_seam_parts *parts) {
    sl_free(context, parts->parts.items);
    sl_free(context, parts->marks.items);
    *parts = (sli_seam_parts){0};
}

// --- along the axes

static int compare_pieces(const void *left, const void *right) {
    const sli_piece *a = left, *b = right;
    if (a->axis != b->axis) return a->axis - b->axis;
    if (a->at != b->at) return a->at < b->at ? -1 : 1;
    if (a->lo != b->lo) return a->lo < b->lo ? -1 : 1;
    return (a->seam > b->seam) - (a->seam < b->seam);
}

sl_status sli_seam_lines(sl_context *context, const sli_piece *walls, size_t wall_count,
                         const sli_seam_parts *parts, sli_piece **out) {
    const size_t count = wall_count + parts->parts.count;
    sli_piece *pieces = sl_alloc_array(context, count, sizeof *pieces);
    if (!pieces) return SL_NO_MEMORY;
    if (wall_count) memcpy(pieces, walls, wall_count * sizeof *pieces);
    for (size_t i = 0; i < parts->parts.count; i++) {
        const sli_seam_part *part = &parts->parts.items[i];
        const bool upright = part->a.x == part->b.x;
        pieces[wall_count + i] = (sli_piece){.at = upright ? part->a.x : part->a.y,
                                             .lo = upright ? part->a.y : part->a.x,
                                             .hi = upright ? part->b.y : part->b.x,
                                             .axis = upright ? 0 : 1,
                                             .seam = (uint32_t)i + 1};
    }
    qsort(pieces, count, sizeof *pieces, compare_pieces);
    *out = pieces;
    return SL_OK;
}

// --- portals on seams

/// Whether a portal, from its left end to its right one, runs as a part does, from a to b.
static bool goes_along(const sli_seam_part *part, const sl_portal *portal) {
    return (part->b.x > part->a.x) == (portal->left.x < portal->right.x) &&
           (part->b.y > part->a.y) == (portal->left.y < portal->right.y);
}

/// `on`: by portal, 1 + the part that it lies on; 0 for none.
static sl_status tag(sl_context *context, const sli_seam_parts *parts, const uint32_t *on,
                     sl_space *space) {
    size_t count = 0;
    for (uint32_t i = 0; i < space->portal_count; i++)
        if (on[i]) count += parts->parts.items[on[i] - 1].count;
    if (count > UINT32_MAX) return sl_fail_memory(context);
    if (!count) return SL_OK;
    space->seam_portals = sl_alloc_array(context, count, sizeof *space->seam_portals);
    if (!space->seam_portals) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->portal_count; i++) {
        if (!on[i]) continue;
        const sli_seam_part *part = &parts->parts.items[on[i] - 1];
        const bool along = goes_along(part, &space->portals[i]);
        for (size_t k = 0; k < part->count; k++) {
            const sli_seam_mark mark = parts->marks.items[part->first + k];
            space->seam_portals[space->seam_portal_count++] =
                (sl_seam_portal){i, mark.seam, mark.along == along};
        }
    }
    return SL_OK;
}

/// 1 + the number of the part that a portal lies on; 0 for none.
static uint32_t part_of(const sli_piece *pieces, size_t count, const sl_portal *portal) {
    const bool upright = portal->left.x == portal->right.x;
    const double at = upright ? portal->left.x : portal->left.y;
    const double one = upright ? portal->left.y : portal->left.x;
    const double other = upright ? portal->right.y : portal->right.x;
    const size_t i =
        sli_wall_lines_find(pieces, count, upright ? 0 : 1, at, one < other ? one : other);
    if (i == count || pieces[i].axis != (upright ? 0 : 1) || pieces[i].at != at ||
        pieces[i].lo >= fmax(one, other))
        return 0;
    return pieces[i].seam;
}

sl_status sli_seams_tag_axial(sl_context *context, const sli_seam_parts *parts, sl_space *space) {
    sli_piece *pieces = NULL;
    SL_TRY(sli_seam_lines(context, NULL, 0, parts, &pieces));
    uint32_t *on = sl_alloc_array(context, space->portal_count, sizeof *on);
    sl_status status = on ? SL_OK : SL_NO_MEMORY;
    for (uint32_t i = 0; on && i < space->portal_count; i++)
        on[i] = part_of(pieces, parts->parts.count, &space->portals[i]);
    if (status == SL_OK) status = tag(context, parts, on, space);
    sl_free(context, pieces);
    sl_free(context, on);
    return status;
}

const sl_seam_portal *sl_space_seams_of(const sl_space *space, uint32_t portal, size_t *count) {
    size_t first = 0, end = space->seam_portal_count;
    while (first < end) {
        const size_t middle = first + (end - first) / 2;
        if (space->seam_portals[middle].portal < portal)
            first = middle + 1;
        else
            end = middle;
    }
    for (end = first; end < space->seam_portal_count && space->seam_portals[end].portal == portal;)
        end++;
    *count = end - first;
    return *count ? space->seam_portals + first : NULL;
}

sl_status sli_refuse_limited(sl_context *context, const sl_space *space, const char *who,
                             const char *or_else) {
    for (uint32_t i = 0; i < space->seam_count; i++)
        if (space->seams[i].kind == SL_SEAM_LIMITED)
            return sl_fail(context, SL_UNSUPPORTED,
                           "the map has walls that limit sight, which %s does not count: let them "
                           "stop 'sight' in place of 'limited', or nothing of it%s",
                           who, or_else);
    return SL_OK;
}

bool sli_seams_same(const sl_space *space, uint32_t portal, uint32_t other) {
    size_t count, other_count;
    const sl_seam_portal *a = sl_space_seams_of(space, portal, &count);
    const sl_seam_portal *b = sl_space_seams_of(space, other, &other_count);
    if (count != other_count) return false;
    for (size_t i = 0; i < count; i++)
        if (a[i].seam != b[i].seam) return false;
    return true;
}

// --- checks

static bool is_within(const sl_box *b, sl_point p) {
    return sl_coordinate_usable(p.x) && sl_coordinate_usable(p.y) && sli_box_holds(b, p);
}

sl_status sli_seams_check(sl_context *context, const sl_space *space, bool axial) {
    for (uint32_t i = 0; i < space->seam_count; i++) {
        const sl_seam *seam = &space->seams[i];
        const bool upright = seam->at.a.x == seam->at.b.x, level = seam->at.a.y == seam->at.b.y;
        if (!is_within(&space->bounds, seam->at.a) || !is_within(&space->bounds, seam->at.b))
            return sl_fail(context, SL_BAD_INPUT, "seam %u leaves the bounds", i);
        if ((upright && level) || (axial && !upright && !level) || seam->kind > SL_SEAM_LIMITED)
            return sl_fail(context, SL_BAD_INPUT, "seam %u is none", i);
    }
    for (uint32_t i = 0; i < space->seam_portal_count; i++) {
        const sl_seam_portal *at = &space->seam_portals[i], *last = i ? at - 1 : NULL;
        const bool ordered = !last || last->portal < at->portal ||
                             (last->portal == at->portal && last->seam < at->seam);
        if (!ordered || at->portal >= space->portal_count || at->seam >= space->seam_count ||
            at->forward > 1)
            return sl_fail(context, SL_BAD_INPUT, "the portals on seams are out of range or order");
    }
    return SL_OK;
}
