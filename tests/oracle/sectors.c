/// A point is in the sector on its side of the first line in each of four directions, if all agree.
#include "oracle/sectors.h"

#include <math.h>
#include <stdlib.h>

struct sector_finder {
    const sli_doom_level *level;
    blockers *lines;
    double reach; ///< farther than the map is wide
};

sector_finder *sector_finder_create(const sli_doom_level *level) {
    sector_finder *map = calloc(1, sizeof *map);
    sl_segment *segments = calloc(level->line_count + 1, sizeof *segments);
    if (!map || !segments) abort();
    for (size_t i = 0; i < level->line_count; i++) {
        segments[i] = (sl_segment){level->lines[i].from, level->lines[i].to};
        map->reach = fmax(map->reach, fabs(segments[i].a.x) + fabs(segments[i].a.y));
        map->reach = fmax(map->reach, fabs(segments[i].b.x) + fabs(segments[i].b.y));
    }
    map->level = level;
    map->reach *= 4;
    map->lines = blockers_create(segments, level->line_count);
    free(segments);
    return map;
}

void sector_finder_destroy(sector_finder *map) {
    blockers_destroy(map->lines);
    free(map);
}

static bool same_point(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

/// The sector at the side of a line where the point is; of walls that lie back to back with the
/// same ends, that of the one which has a sector there.
static uint32_t facing_sector(const sector_finder *map, size_t line, sl_point point) {
    const sli_doom_line *lines = map->level->lines, *own = &lines[line];
    const int turn = blockers_turn(own->from, own->to, point);
    if (turn == 0) return SLI_NO_SECTOR;
    const uint32_t sector = turn > 0 ? own->left : own->right;
    if (sector != SLI_NO_SECTOR) return sector;
    for (size_t i = 0; i < map->level->line_count; i++)
        if (same_point(lines[i].from, own->to) && same_point(lines[i].to, own->from))
            return turn > 0 ? lines[i].right : lines[i].left;
    return SLI_NO_SECTOR;
}

uint32_t sectors_at(sector_finder *map, sl_point point) {
    static const double ways[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    uint32_t sector = SLI_NO_SECTOR;
    for (int i = 0; i < 4; i++) {
        const sl_point far = {point.x + ways[i][0] * map->reach, point.y + ways[i][1] * map->reach};
        size_t wall;
        blockers_reach(map->lines, (sl_segment){point, far}, &wall);
        if (wall == SIZE_MAX) return SLI_NO_SECTOR;
        const uint32_t found = facing_sector(map, wall, point);
        if (found == SLI_NO_SECTOR || (i > 0 && found != sector)) return SLI_NO_SECTOR;
        sector = found;
    }
    return sector;
}
