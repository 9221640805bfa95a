#include "sectors.h"

#include <math.h>
#include <stdlib.h>

struct sectors {
    const sl_doom_level *level;
    blockers *lines;
    double reach; ///< farther than the map is wide
};

sectors *sectors_create(const sl_doom_level *level) {
    sectors *map = calloc(1, sizeof *map);
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

void sectors_destroy(sectors *map) {
    blockers_destroy(map->lines);
    free(map);
}

uint32_t sectors_at(sectors *map, sl_point point) {
    static const double ways[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    uint32_t sector = SL_NO_SECTOR;
    for (int i = 0; i < 4; i++) {
        const sl_point far = {point.x + ways[i][0] * map->reach, point.y + ways[i][1] * map->reach};
        size_t wall;
        blockers_reach(map->lines, (sl_segment){point, far}, &wall);
        if (wall == SIZE_MAX) return SL_NO_SECTOR;
        const sl_doom_line *line = &map->level->lines[wall];
        const int turn = blockers_turn(line->from, line->to, point);
        const uint32_t found = turn == 0 ? SL_NO_SECTOR : turn > 0 ? line->left : line->right;
        if (found == SL_NO_SECTOR || (i > 0 && found != sector)) return SL_NO_SECTOR;
        sector = found;
    }
    return sector;
}
