/// Clips (the command XCLIP): a polygon of which an INSERT shows the inside alone.
///
/// It is in the section OBJECTS. The INSERT names its dictionary by a handle, that one names
/// another under ACAD_FILTER, and that one a SPATIAL_FILTER under SPATIAL. The polygon is in places
/// of its own: two matrices lead to it, from the block to where the INSERT was when the clip was
/// made, and from there to the polygon. Each is 3 rows of 4 numbers; the drawing has the inverse of
/// the first.
#include "io/dxf/dxf.h"
#include "io/parts/limits.h"

#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

static const sli_fault inverted = {"clip whose inside is hidden: all of the block is drawn",
                                   "clips whose inside is hidden: all of the blocks is drawn"};
static const sli_fault wrong_clip = {"clip that is not complete: all of the block is drawn",
                                     "clips that are not complete: all of the blocks is drawn"};

// --- handles

static int compare_objects(const void *left, const void *right) {
    const sli_dxf_object *a = left, *b = right;
    if (a->handle.length != b->handle.length) return a->handle.length < b->handle.length ? -1 : 1;
    return memcmp(a->handle.at, b->handle.at, a->handle.length);
}

sl_status sli_dxf_find_clips(sli_dxf *dxf) {
    bool any = false;
    for (size_t i = dxf->objects.begin; i < dxf->objects.end;) {
        const sli_dxf_range object = sli_dxf_entity(dxf, i, dxf->objects.end);
        const sli_word kind = sli_dxf_at(dxf, i)->value;
        const bool filter = sli_word_is(kind, "SPATIAL_FILTER");
        any |= filter;
        if (filter || sli_word_is(kind, "DICTIONARY")) {
            SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->filters, 1));
            dxf->filters.items[dxf->filters.count++] =
                (sli_dxf_object){sli_dxf_text(dxf, object, 5), i};
        }
        i = object.end;
    }
    if (!any) dxf->filters.count = 0;
    if (any)
        qsort(dxf->filters.items, dxf->filters.count, sizeof *dxf->filters.items, compare_objects);
    return SL_OK;
}

/// The object of a handle; an empty range for none.
static sli_dxf_range object_of(const sli_dxf *dxf, sli_word handle) {
    const sli_dxf_object wanted = {.handle = handle};
    const sli_dxf_object *found = dxf->filters.count
                                      ? bsearch(&wanted, dxf->filters.items, dxf->filters.count,
                                                sizeof *dxf->filters.items, compare_objects)
                                      : NULL;
    if (!found) return (sli_dxf_range){0, 0};
    return sli_dxf_entity(dxf, found->begin, dxf->objects.end);
}

/// Dictionaries of entities are short; others are not searched to their end.
enum { MOST_SEARCHED = 256, MOST_CORNERS = 1024 };

/// The object that stands behind a pair of this group and value.
static sli_dxf_range object_behind(const sli_dxf *dxf, sli_dxf_range within, int code,
                                   const char *value) {
    for (size_t i = within.begin; i + 1 < within.end && i - within.begin < MOST_SEARCHED; i++)
        if (sli_dxf_at(dxf, i)->code == code && sli_word_is(sli_dxf_at(dxf, i)->value, value))
            return object_of(dxf, sli_dxf_at(dxf, i + 1)->value);
    return (sli_dxf_range){0, 0};
}

static sli_dxf_range filter_of(const sli_dxf *dxf, sli_dxf_range insert) {
    const sli_dxf_range own = object_behind(dxf, insert, 102, "{ACAD_XDICTIONARY");
    return object_behind(dxf, object_behind(dxf, own, 3, "ACAD_FILTER"), 3, "SPATIAL");
}

// --- the polygon

/// The part of a matrix that is in the plane.
static sli_affine flat(const double m[12]) {
    return (sli_affine){.xx = m[0], .xy = m[1], .x0 = m[3], .yx = m[4], .yy = m[5], .y0 = m[7]};
}

/// Where an affine map takes a point from.
static sl_point before(sli_affine affine, sl_point to) {
    const double area = affine.xx * affine.yy - affine.xy * affine.yx;
    const double x = to.x - affine.x0, y = to.y - affine.y0;
    return (sl_point){(affine.yy * x - affine.xy * y) / area,
                      (affine.xx * y - affine.yx * x) / area};
}

/// Reads the corners and the 24 last numbers of group 40, the matrices.
static sl_status read_filter(sli_dxf *dxf, sli_dxf_range filter, sl_point *corners, size_t *count,
                             double numbers[24], size_t *seen) {
    for (size_t i = filter.begin; i < filter.end; i++) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
        if (pair->code == 40) {
            memmove(numbers, numbers + 1, 23 * sizeof *numbers);
            SL_TRY(sli_dxf_read_number(dxf, pair, &numbers[23]));
            ++*seen;
        } else if (pair->code == 10 && *count < MOST_CORNERS && i + 1 < filter.end) {
            SL_TRY(sli_dxf_read_number(dxf, pair, &corners[*count].x));
            SL_TRY(sli_dxf_read_number(dxf, pair + 1, &corners[*count].y));
            ++*count;
        } else if (pair->code == 10) {
            *seen = 0;
            return SL_OK;
        }
    }
    return SL_OK;
}

/// From two corners to the four of their box.
static void make_box(sl_point *corners, size_t *count) {
    if (*count != 2) return;
    const sl_point a = corners[0], b = corners[1];
    corners[1] = (sl_point){b.x, a.y};
    corners[2] = b;
    corners[3] = (sl_point){a.x, b.y};
    *count = 4;
}

sl_status sli_dxf_read_clip(sli_dxf *dxf, sli_dxf_range insert, sli_dxf_clip *clip) {
    const sli_dxf_range filter = filter_of(dxf, insert);
    const uint32_t line = sli_dxf_at(dxf, insert.begin)->line;
    int shows = 1;
    double numbers[24] = {0};
    size_t seen = 0;
    *clip = (sli_dxf_clip){0};
    if (filter.begin == filter.end) return SL_OK;
    bool good = sli_dxf_integer(dxf, filter, 71, &shows) == SL_OK;
    if (good && !shows) return SL_OK; // XCLIP OFF
    for (size_t i = filter.begin; i < filter.end; i++) {
        if (!sli_word_is(sli_dxf_at(dxf, i)->value, "{ACAD_XDICTIONARY")) continue;
        sli_faults_add(&dxf->faults, &inverted, line);
        return SL_OK;
    }
    sl_point *corners = sl_alloc_array(dxf->context, MOST_CORNERS + 4, sizeof *corners);
    if (!corners) return SL_NO_MEMORY;
    good &= read_filter(dxf, filter, corners, &clip->count, numbers, &seen) == SL_OK;
    const sli_affine to_block = flat(numbers), to_polygon = flat(numbers + 12);
    make_box(corners, &clip->count);
    good &= seen >= 24 && clip->count > 2;
    for (size_t i = 0; i < clip->count && good; i++) {
        corners[i] = sli_affine_apply(to_block, before(to_polygon, corners[i]));
        good = isfinite(corners[i].x) && isfinite(corners[i].y);
    }
    clip->corners = corners;
    if (good) return SL_OK;
    sli_faults_add(&dxf->faults, &wrong_clip, line);
    sl_free(dxf->context, corners);
    *clip = (sli_dxf_clip){0};
    return SL_OK;
}

// --- cutting

static double cross(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

static sl_point minus(sl_point a, sl_point b) {
    return (sl_point){a.x - b.x, a.y - b.y};
}

static sl_point between(sl_point a, sl_point b, double share) {
    if (share == 0 || share == 1) return share == 0 ? a : b;
    return (sl_point){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

static bool is_inside(const sl_point *p, size_t count, sl_point at) {
    bool inside = false;
    for (size_t i = 0, k = count - 1; i < count; k = i++)
        if ((p[i].y > at.y) != (p[k].y > at.y) &&
            at.x < p[i].x + (at.y - p[i].y) / (p[k].y - p[i].y) * (p[k].x - p[i].x))
            inside = !inside;
    return inside;
}

/// Where a wall crosses the polygon, as shares of its length, from 0 to 1, in order.
static size_t crossings(const sl_point *p, size_t count, const sl_wall *wall, double *shares) {
    const sl_point along = minus(wall->b, wall->a);
    size_t found = 0;
    shares[found++] = 0;
    for (size_t i = 0, k = count - 1; i < count; k = i++) {
        const sl_point side = minus(p[i], p[k]), to = minus(p[k], wall->a);
        const double area = cross(along, side);
        const double share = cross(to, side) / area, there = cross(to, along) / area;
        if (area != 0 && share > 0 && share < 1 && there >= 0 && there <= 1)
            shares[found++] = share;
    }
    shares[found++] = 1;
    qsort(shares, found, sizeof *shares, sl_compare_numbers);
    return found;
}

/// Keeps the pieces of a wall that are inside; neighbours as one.
static sl_status cut_wall(sli_dxf *dxf, const sl_point *p, size_t count, const sl_wall *wall,
                          double *shares, sl_map *kept) {
    const size_t found = crossings(p, count, wall, shares);
    for (size_t i = 0; i + 1 < found; i++) {
        const double from = shares[i];
        while (i + 1 < found &&
               is_inside(p, count, between(wall->a, wall->b, (shares[i] + shares[i + 1]) / 2)))
            i++;
        const sl_point a = between(wall->a, wall->b, from);
        const sl_point b = between(wall->a, wall->b, shares[i]);
        if (a.x == b.x && a.y == b.y) continue;
        SL_TRY(sli_limit_check(dxf->context, dxf->name, wall->line, SLI_LIMIT_WALLS,
                               kept->wall_count + 1, "the drawing gives"));
        SL_TRY(sl_map_add_wall(dxf->context, kept, a, b, wall->line));
        kept->walls[kept->wall_count - 1].ground = wall->ground;
    }
    return SL_OK;
}

sl_status sli_dxf_cut(sli_dxf *dxf, const sli_dxf_clip *clip, sli_affine affine, size_t first) {
    sl_map *map = dxf->pen.map, kept = {0};
    const size_t count = clip->count;
    if (!count || first == map->wall_count) return SL_OK;
    sl_point *p = sl_alloc_array(dxf->context, count, sizeof *p);
    double *shares = sl_alloc_array(dxf->context, count + 2, sizeof *shares);
    size_t *ends = sl_alloc_array(dxf->context, map->wall_count - first, sizeof *ends);
    sl_status status = p && shares && ends ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < count && status == SL_OK; i++)
        p[i] = sli_affine_apply(affine, clip->corners[i]);
    for (size_t i = first; i < map->wall_count && status == SL_OK; i++) {
        status = cut_wall(dxf, p, count, &map->walls[i], shares, &kept);
        ends[i - first] = first + kept.wall_count;
        if (status == SL_OK && i % 256 == 0) status = sl_check_cancelled(dxf->context);
    }
    if (status == SL_OK) {
        sli_contents_cut(&dxf->contents, first, ends);
        const size_t before_cut = map->wall_count - first, counted = dxf->pen.walls;
        dxf->pen.walls = counted + kept.wall_count - (counted < before_cut ? counted : before_cut);
        map->wall_count = first;
        status = sl_map_add_walls(dxf->context, map, kept.walls, kept.wall_count);
    }
    sl_map_destroy(dxf->context, &kept);
    sl_free(dxf->context, p);
    sl_free(dxf->context, shares);
    sl_free(dxf->context, ends);
    return status;
}
