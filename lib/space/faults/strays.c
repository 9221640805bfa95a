/// Strays: coordinates far away from the rest of the map, such as a slip of a digit or a drawing's
/// forgotten block.
///
///     |<- rest ->|<------------- far: 20 times the rest ------------->|
///      ..:.:.:.:.                                                      .
///
/// In x and in y, the points are sorted. The rest begins as the middle half of them, and grows to
/// the next point as long as that is no farther than 20 times its size. What remains outside is
/// stray, unless it is more than a quarter of all points. So no bounds are needed, which a stray
/// would make large. Time O(n log n).
#include "sightline/faults.h"

#include "geometry/length.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

enum { FAR = 20 };

/// A point of a thing of the map.
typedef struct place {
    sl_point at;
    uint32_t thing, line;
} place;

typedef struct place_list {
    sl_context *context;
    SL_ARRAY(place) places;
    uint32_t things;
} place_list;

static sl_status add_places(place_list *list, const sl_point *points, size_t count, uint32_t line) {
    SL_TRY(SL_ARRAY_ROOM(list->context, &list->places, count));
    for (size_t i = 0; i < count; i++)
        list->places.items[list->places.count++] = (place){points[i], list->things, line};
    list->things++;
    return SL_OK;
}

static sl_status add_glass(place_list *list, const sl_glass *glass, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const sl_point ends[2] = {glass[i].segment.a, glass[i].segment.b};
        SL_TRY(add_places(list, ends, 2, glass[i].line));
    }
    return SL_OK;
}

/// All that sl_map_bounds looks at; walls first, so that their things have their numbers.
static sl_status list_places(place_list *list, const sl_map *map) {
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_point ends[2] = {map->walls[i].a, map->walls[i].b};
        SL_TRY(add_places(list, ends, 2, map->walls[i].line));
    }
    for (size_t i = 0; i < map->door_count; i++) {
        const sl_point ends[2] = {map->doors[i].segment.a, map->doors[i].segment.b};
        SL_TRY(add_places(list, ends, 2, map->doors[i].line));
    }
    SL_TRY(add_glass(list, map->mirrors, map->mirror_count));
    SL_TRY(add_glass(list, map->oneways, map->oneway_count));
    SL_TRY(add_glass(list, map->seams, map->seam_count));
    for (size_t i = 0; i < map->start_count; i++)
        SL_TRY(add_places(list, &map->starts[i].at, 1, map->starts[i].line));
    for (size_t i = 0; i < map->path_count; i++)
        SL_TRY(add_places(list, map->paths[i].points, map->paths[i].count, map->paths[i].line));
    for (size_t i = 0; i < map->object_count; i++) {
        const sl_point corners[2] = {map->objects[i].box.min, map->objects[i].box.max};
        SL_TRY(add_places(list, corners, 2, map->objects[i].line));
    }
    for (size_t i = 0; i < map->cell_count; i++)
        SL_TRY(add_places(list, map->corners + map->cells[i].first, map->cells[i].count,
                          map->cells[i].line));
    return SL_OK;
}

// --- the rest

/// Sorted coordinates, and which of them are of the rest.
typedef struct axis {
    double *values;
    size_t low, high; ///< inclusive
} axis;

static double size_of(const axis *a) {
    return a->values[a->high] - a->values[a->low];
}

/// Takes in what is near. Returns whether there was any.
static bool grow(axis *a, size_t count, double near) {
    const size_t low = a->low, high = a->high;
    while (a->low > 0 && a->values[a->low] - a->values[a->low - 1] <= near) a->low--;
    while (a->high + 1 < count && a->values[a->high + 1] - a->values[a->high] <= near) a->high++;
    return a->low < low || a->high > high;
}

/// The box of the rest, if that is not all at one place.
static sl_status find_rest(const place_list *list, sl_box *rest) {
    const size_t count = list->places.count;
    double *values = sl_alloc_array(list->context, 2 * count, sizeof *values);
    if (!values) return SL_NO_MEMORY;
    axis x = {values, count / 4, count - 1 - count / 4};
    axis y = {values + count, count / 4, count - 1 - count / 4};
    for (size_t i = 0; i < count; i++) {
        x.values[i] = list->places.items[i].at.x;
        y.values[i] = list->places.items[i].at.y;
    }
    qsort(x.values, count, sizeof *values, sl_compare_numbers);
    qsort(y.values, count, sizeof *values, sl_compare_numbers);
    bool grows = true;
    while (grows) {
        const double near = FAR * fmax(size_of(&x), size_of(&y));
        const bool in_x = grow(&x, count, near), in_y = grow(&y, count, near);
        grows = in_x || in_y;
    }
    *rest = (sl_box){{x.values[x.low], y.values[y.low]}, {x.values[x.high], y.values[y.high]}};
    sl_free(list->context, values);
    return SL_OK;
}

/// How far a point is from a box; 0 within it.
static double away(const sl_box *box, sl_point p) {
    return sli_length(fmax(fmax(box->min.x - p.x, p.x - box->max.x), 0),
                      fmax(fmax(box->min.y - p.y, p.y - box->max.y), 0));
}

/// Adds the things with a point outside of the rest, once each, by their farthest point.
static sl_status add_strays(const place_list *list, const sl_map *map, sl_strays *out) {
    SL_ARRAY(sl_stray) strays = {0};
    sl_status status = SL_OK;
    uint32_t last = UINT32_MAX;
    for (size_t i = 0; i < list->places.count && status == SL_OK; i++) {
        const place *p = &list->places.items[i];
        const double distance = away(&out->rest, p->at);
        if (!(distance > 0)) continue;
        if (p->thing != last) status = SL_ARRAY_ROOM(list->context, &strays, 1);
        if (status != SL_OK) break;
        if (p->thing != last) strays.items[strays.count++] = (sl_stray){.line = p->line};
        sl_stray *stray = &strays.items[strays.count - 1];
        stray->wall = p->thing < map->wall_count ? p->thing : UINT32_MAX;
        if (distance > stray->distance) {
            stray->distance = distance;
            stray->at = p->at;
        }
        last = p->thing;
    }
    if (status == SL_OK) {
        out->items = strays.items;
        out->count = (uint32_t)strays.count;
    } else {
        sl_free(list->context, strays.items);
    }
    return status;
}

static size_t count_outside(const place_list *list, const sl_box *rest) {
    size_t count = 0;
    for (size_t i = 0; i < list->places.count; i++)
        count += away(rest, list->places.items[i].at) > 0;
    return count;
}

sl_status sl_find_strays(sl_context *context, const sl_map *map, sl_strays *out) {
    place_list list = {.context = context};
    sl_strays found = {0};
    sl_status status = list_places(&list, map);
    if (status == SL_OK && list.places.count) status = find_rest(&list, &found.rest);
    const bool any = found.rest.max.x > found.rest.min.x || found.rest.max.y > found.rest.min.y;
    if (status == SL_OK && any && count_outside(&list, &found.rest) <= list.places.count / 4)
        status = add_strays(&list, map, &found);
    sl_free(context, list.places.items);
    if (status == SL_OK) *out = found;
    return status;
}

void sl_strays_destroy(sl_context *context, sl_strays *strays) {
    sl_free(context, strays->items);
    *strays = (sl_strays){0};
}
