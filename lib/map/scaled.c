/// A map in another unit: all its places and lengths times a factor. Every coordinate is rounded
/// once, so equal coordinates stay equal, and axial walls axial.
#include "map/unit.h"

#include "sightline/support.h"

#include <stdio.h>
#include <string.h>

bool sli_unit_is_measured(const char *text, double *factor, const char **sign) {
    const char *equals = text ? strchr(text, '=') : NULL;
    if (!equals || !sl_number_read(text, (size_t)(equals - text), factor)) return false;
    *sign = equals + 1;
    return true;
}

/// False where a coordinate is not one that a map may have.
static bool scale_points(sl_point *points, size_t count, size_t stride, double factor) {
    bool good = true;
    for (size_t i = 0; i < count; i++) {
        sl_point *p = (sl_point *)((char *)points + i * stride);
        *p = (sl_point){p->x * factor, p->y * factor};
        good &= sl_coordinate_usable(p->x) && sl_coordinate_usable(p->y);
    }
    return good;
}

static bool scale_glass(sl_glass *glass, size_t count, double factor) {
    bool good = true;
    for (size_t i = 0; i < count; i++)
        good &= scale_points(&glass[i].segment.a, 2, sizeof(sl_point), factor);
    return good;
}

static bool scale_all(sl_map *map, double factor) {
    const size_t one = sizeof(sl_point);
    sl_map_source *source = &map->source;
    bool good = scale_glass(map->mirrors, map->mirror_count, factor);
    good &= scale_glass(map->oneways, map->oneway_count, factor);
    good &= scale_glass(map->seams, map->seam_count, factor);
    good &= scale_points(map->corners, map->corner_count, one, factor);
    for (size_t i = 0; i < map->wall_count; i++)
        good &= scale_points(&map->walls[i].a, 2, one, factor);
    for (size_t i = 0; i < map->door_count; i++) {
        sl_door *door = &map->doors[i];
        good &= scale_points(&door->segment.a, 2, one, factor);
        if (door->parts) good &= scale_points(&door->parts->a, 2 * door->part_count, one, factor);
    }
    for (size_t i = 0; i < map->start_count; i++)
        good &= scale_points(&map->starts[i].at, 1, one, factor);
    for (size_t i = 0; i < map->path_count; i++)
        good &= scale_points(map->paths[i].points, map->paths[i].count, one, factor);
    for (size_t i = 0; i < map->object_count; i++)
        good &= scale_points(&map->objects[i].box.min, 2, one, factor);
    for (size_t i = 0; i < source->text_count; i++) {
        scale_points(&source->texts[i].at, 1, one, factor);
        source->texts[i].height *= factor;
    }
    scale_points(&source->page.min, 2, one, factor);
    scale_points(&source->transform.origin, 1, one, factor);
    source->transform.scale /= factor;
    source->pixels /= factor;
    return good;
}

sl_status sli_map_measure(sl_context *context, sl_map *map, double factor, const char *sign,
                          const char *said) {
    if (!(factor > 0) || !sl_coordinate_usable(factor) || !(sli_unit_metres(sign) > 0))
        return sl_fail(
            context, SL_BAD_ARGUMENT,
            "--unit %s: expected how long a unit of the file is, as 0.0254=m, in mm, cm, m, "
            "km, in, ft or yd",
            said);
    if (map->earth.known)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--unit %s: the map is in degrees, which says how long they are", said);
    if (!scale_all(map, factor))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--unit %s: coordinates get too large or too small", said);
    map->snap *= factor;
    map->precision *= factor;
    map->range *= factor;
    map->entrance *= factor;
    map->source.drawing_unit = sli_unit_number(sign);
    snprintf(map->unit, sizeof map->unit, "%s", sign);
    return SL_OK;
}
