/// Which starts of a Doom map to believe, and where players arrive by teleporters.
///
/// Regions of the map (regions.h) are what is joined by steps. A teleporter is a line that leads to
/// the destinations which stand in sectors of its tag, and nowhere else. So a start reaches its own
/// region, those that teleporters in it lead to, and so on. A start that reaches less than a tenth
/// of what another one does is named and left out. A destination in a region that no start is in is
/// a start, too, where players come to it: without it, what lies behind would not be inside. Time
/// O(n log n) for n lines, and linear in them for each destination.
#include "io/doom/wad.h"
#include "io/parts/regions.h"

#include "geometry/orient.h"
#include "sightline/support.h"

#include <string.h>

/// From the region of a teleporter to that of a destination.
typedef struct way {
    uint32_t from, to;
    const sl_start *at;
} way;

typedef struct reach {
    sl_context *context;
    const sli_doom_level *level;
    sli_regions regions;
    SL_ARRAY(way) ways;
    bool *reached; ///< by region
} reach;

/// Lines that take players to another place (Doom's, and Boom's that make no sound). Monsters alone
/// go by others.
static bool is_teleporter(const sli_doom_line *line) {
    static const unsigned char specials[] = {39, 97, 174, 195, 207, 208, 209, 210};
    return line->tag && line->special > 0 && line->special < 256 &&
           memchr(specials, line->special, sizeof specials) != NULL;
}

/// The sector at a place: that of the first line straight above it, on the side that faces it.
static uint32_t sector_at(const sli_doom_level *level, sl_point p) {
    const sli_doom_line *best = NULL;
    for (size_t i = 0; i < level->line_count; i++) {
        const sli_doom_line *line = &level->lines[i];
        const sl_point a = line->from.x < line->to.x ? line->from : line->to;
        const sl_point b = line->from.x < line->to.x ? line->to : line->from;
        if (!(a.x <= p.x && p.x < b.x) || sli_orient(a, b, p) > 0) continue;
        // Of two lines above the place that do not cross, the lower one has an end below the other.
        if (best) {
            const bool turned = best->from.x > best->to.x;
            const sl_point c = turned ? best->to : best->from, d = turned ? best->from : best->to;
            const bool lower = c.x <= a.x
                                   ? sli_orient(c, d, a) < 0 ||
                                         (sli_orient(c, d, a) == 0 && sli_orient(c, d, b) < 0)
                                   : sli_orient(a, b, c) > 0 ||
                                         (sli_orient(a, b, c) == 0 && sli_orient(a, b, d) > 0);
            if (!lower) continue;
        }
        best = line;
    }
    if (!best) return SLI_NO_SECTOR;
    return best->from.x < best->to.x ? best->right : best->left; // below it
}

static sl_status find_ways(reach *r) {
    const sli_doom_level *level = r->level;
    for (size_t k = 0; k < level->start_count; k++) {
        const sli_doom_start *arrival = &level->starts[k];
        if (arrival->kind != SLI_DOOM_ARRIVAL) continue;
        const uint32_t sector = sector_at(level, arrival->start.at);
        const uint32_t to = sli_regions_at(&r->regions, arrival->start.at);
        if (sector == SLI_NO_SECTOR || to == SL_NO_CELL) continue;
        for (size_t i = 0; i < level->line_count; i++) {
            const sli_doom_line *line = &level->lines[i];
            if (!is_teleporter(line) || line->tag != level->sectors[sector].tag) continue;
            const sl_point middle = {line->from.x / 2 + line->to.x / 2,
                                     line->from.y / 2 + line->to.y / 2};
            const uint32_t from = sli_regions_at(&r->regions, middle);
            if (from == SL_NO_CELL || from == to) continue;
            SL_TRY(SL_ARRAY_ROOM(r->context, &r->ways, 1));
            r->ways.items[r->ways.count++] = (way){from, to, &arrival->start};
        }
    }
    return SL_OK;
}

/// Marks the regions that are reached from a place, beside those marked already.
static void follow(reach *r, sl_point from) {
    const uint32_t region = sli_regions_at(&r->regions, from);
    if (region == SL_NO_CELL) return;
    r->reached[region] = true;
    for (bool more = true; more;) {
        more = false;
        for (size_t i = 0; i < r->ways.count; i++) {
            const way *w = &r->ways.items[i];
            if (!r->reached[w->from] || r->reached[w->to]) continue;
            r->reached[w->to] = more = true;
        }
    }
}

static double area_from(reach *r, sl_point from) {
    double area = 0;
    memset(r->reached, 0, r->regions.count * sizeof *r->reached);
    follow(r, from);
    for (size_t i = 0; i < r->regions.count; i++)
        if (r->reached[i]) area += r->regions.items[i].area;
    return area;
}

/// Drops starts that reach little.
static void doubt(reach *r, const char *name, sl_map *map) {
    double most = 0;
    size_t kept = 0;
    for (size_t i = 0; i < map->start_count; i++)
        most = fmax(most, area_from(r, map->starts[i].at));
    for (size_t i = 0; i < map->start_count; i++) {
        const sl_point at = map->starts[i].at;
        if (!sli_reaches_little(area_from(r, at), most)) {
            map->starts[kept++] = map->starts[i];
            continue;
        }
        sl_note(r->context,
                "%s: map %s: left out: the start at %g,%g: it reaches less than a tenth of what "
                "others do; --start %g,%g takes it all the same",
                name, r->level->name, at.x, at.y, at.x, at.y);
    }
    map->start_count = kept;
}

/// Adds a start where players arrive in a region that none is in.
static sl_status arrive(reach *r, const char *name, bool brief, sl_map *map) {
    size_t added = 0;
    bool *has = sl_alloc_array(r->context, r->regions.count, sizeof *has);
    if (!has) return SL_NO_MEMORY;
    memset(r->reached, 0, r->regions.count * sizeof *r->reached);
    for (size_t i = 0; i < map->start_count; i++) {
        const uint32_t region = sli_regions_at(&r->regions, map->starts[i].at);
        if (region != SL_NO_CELL) has[region] = true;
        follow(r, map->starts[i].at);
    }
    sl_status status = SL_OK;
    for (size_t i = 0; i < r->ways.count && status == SL_OK; i++) {
        const way *w = &r->ways.items[i];
        if (!r->reached[w->from] || has[w->to]) continue;
        has[w->to] = true;
        added++;
        status = sl_map_add_start(r->context, map, w->at->at, w->at->heading, w->at->line);
    }
    sl_free(r->context, has);
    if (added && !brief)
        sl_note(r->context,
                "%s: map %s: by teleporters players reach %zu place%s apart from these; starts are "
                "there, too",
                name, r->level->name, added, added == 1 ? "" : "s");
    return status;
}

sl_status sli_doom_settle_starts(sl_context *context, const sli_doom_level *level, const char *name,
                                 bool brief, sl_map *map) {
    reach r = {.context = context, .level = level};
    bool any = map->start_count > 1;
    for (size_t i = 0; i < level->line_count; i++) any |= is_teleporter(&level->lines[i]);
    if (!any || !map->start_count || !map->wall_count) return SL_OK;
    sl_status status = sli_regions_make(context, map, NULL, 0, &r.regions);
    if (status == SL_OK) {
        r.reached = sl_alloc_array(context, r.regions.count, sizeof *r.reached);
        if (!r.reached) status = SL_NO_MEMORY;
    }
    if (status == SL_OK && !level->hexen_specials) status = find_ways(&r);
    if (status == SL_OK) doubt(&r, name, map);
    if (status == SL_OK) status = arrive(&r, name, brief, map);
    sli_regions_destroy(context, &r.regions);
    sl_free(context, r.ways.items);
    sl_free(context, r.reached);
    return status;
}
