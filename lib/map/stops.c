/// Walls that do not stop all: windows, fences, curtains. In a map they are seams that know what
/// they stop. So they cut cells, and cleaning cuts them where they meet others; a place where
/// several lie on each other stops what any of them stops.
#include "geometry/orient.h"
#include "map/ground.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>

static const char *const names[] = {"sight", "steps", "sound", "limited"};
enum { NAMES = sizeof names / sizeof *names };

void sl_stops_write(uint32_t stops, char text[SL_STOPS_TEXT]) {
    int length = 0;
    text[0] = '\0';
    for (int i = 0; i < NAMES; i++)
        if (stops >> i & 1)
            length += snprintf(text + length, (size_t)(SL_STOPS_TEXT - length), "%s%s",
                               length ? "," : "", names[i]);
}

bool sl_stops_read(const char *text, size_t length, uint32_t *out) {
    const char *const end = text + length;
    uint32_t stops = 0;
    for (const char *at = text;; at++) {
        const char *comma = at < end ? memchr(at, ',', (size_t)(end - at)) : NULL;
        const size_t size = (size_t)((comma ? comma : end) - at);
        int i = 0;
        while (i < NAMES && (strlen(names[i]) != size || memcmp(names[i], at, size) != 0)) i++;
        if (i == NAMES || stops >> i & 1) return false;
        stops |= 1u << i;
        if (!comma) break;
        at = comma;
    }
    if (stops & SL_STOPS_LIMITED && stops & SL_STOPS_SIGHT) return false;
    *out = stops;
    return true;
}

sl_status sl_map_walls_stop(sl_context *context, sl_map *map, size_t first, uint32_t stops) {
    if (!stops || stops & ~(uint32_t)(SL_STOPS_ALL | SL_STOPS_LIMITED) ||
        (stops & SL_STOPS_SIGHT && stops & SL_STOPS_LIMITED))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a wall stops sight or limits it, stops steps, sound or several of these");
    if (stops == SL_STOPS_ALL) return SL_OK;
    for (size_t i = first; i < map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i];
        if (sli_same_point(wall->a, wall->b)) continue;
        SL_TRY(sl_map_add_seam(context, map, (sl_segment){wall->a, wall->b}, wall->line));
        sl_glass *seam = &map->seams[map->seam_count - 1];
        seam->stops = (uint8_t)stops;
        seam->ground = wall->ground & SLI_GROUND_SIDES;
    }
    if (first < map->wall_count) map->wall_count = first;
    return SL_OK;
}

sl_status sl_map_settle_stops(sl_context *context, sl_map *map, size_t *left_out) {
    const uint32_t channel = sl_map_channel(map);
    size_t kept = 0, gone = 0;
    sl_status status = SL_OK;
    for (size_t i = 0; i < map->seam_count; i++) {
        const sl_glass seam = map->seams[i];
        const bool wall = seam.stops & channel && status == SL_OK;
        if (wall) status = sl_map_add_wall(context, map, seam.segment.a, seam.segment.b, seam.line);
        if (wall && status == SL_OK) map->walls[map->wall_count - 1].ground = seam.ground;
        gone += seam.stops && !(seam.stops & channel);
        if (!seam.stops || status != SL_OK) map->seams[kept++] = seam;
    }
    map->seam_count = kept;
    if (left_out) *left_out = gone;
    return status;
}

size_t sl_map_partial_walls(const sl_map *map) {
    size_t count = 0;
    for (size_t i = 0; i < map->seam_count; i++) count += map->seams[i].stops != 0;
    return count;
}

size_t sl_map_limited_walls(const sl_map *map) {
    size_t count = 0;
    if (!(sl_map_channel(map) & SL_STOPS_SIGHT)) return 0;
    for (size_t i = 0; i < map->seam_count; i++)
        count += (map->seams[i].stops & SL_STOPS_LIMITED) != 0;
    return count;
}

bool sl_map_steps_differ(const sl_map *map) {
    if (sl_map_channel(map) != SL_STOPS_SIGHT) return false; // asked for, for all
    for (size_t i = 0; i < map->seam_count; i++) {
        const uint32_t stops = map->seams[i].stops;
        if (!(stops & SL_STOPS_SIGHT) != !(stops & SL_STOPS_STEPS)) return true;
    }
    return false;
}
