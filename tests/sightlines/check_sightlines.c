// check_sightlines MAP [--map NAME] [--slice Z] --slv FILE.slv [--count N] [--seed S] [--apart M]
// check_sightlines MAP.wad --map NAME --reject OUT.wad [--count N] [--seed S]
//
// Draws sightlines that meet no wall of the input map, and looks for those that are lost: whose
// ends lie in cells of which one does not see the other, or in sectors that the REJECT of OUT.wad
// says are never seen from each other. Walls are the map's as read, not as cleaned; what a
// sightline meets is decided apart from the library, exactly. Cleaning may move walls by rounding:
// a sightline that comes as near to a wall as cleaning moved one (--apart M; by default as cleaning
// the map with its defaults says) is not lost, it is counted as `near`.
//
// Prints one line of CSV with its heading. Exit status: 0 nothing lost, 1 something lost (the first
// few are told on stderr), 2 wrong arguments or files.
#include "oracle/sectors.h"

#include "sightline/io.h"
#include "sightline/sightline.h"
#include "sightline/support.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct check {
    sl_context *context;
    const char *map_path, *slv_path, *reject_path;
    sl_import_options import;
    uint64_t count;
    sl_random random;

    sl_map map;
    blockers *walls;
    double longest; ///< of a sightline: beyond the map

    sl_baked baked;
    sl_bytes map_bytes, reject_bytes;
    sli_doom_level level;
    sector_finder *sectors;
    sli_lump reject;
    bool *lost_sectors; ///< pairs found lost, count x count

    double apart; ///< sightlines no farther than this from a wall are let go
    uint64_t drawn, free, checked, lost, near, lost_pairs;
} check;

static void must(const check *run, sl_status status) {
    if (status == SL_OK) return;
    fprintf(stderr, "check_sightlines: %s\n", sl_context_message(run->context));
    exit(2);
}

static double unit(check *run) {
    return sl_random_unit(&run->random);
}

// --- drawing

static sl_point random_in_box(check *run) {
    const sl_box box = sl_map_bounds(&run->map);
    return (sl_point){box.min.x + unit(run) * (box.max.x - box.min.x),
                      box.min.y + unit(run) * (box.max.y - box.min.y)};
}

/// In a random triangle of a random cell, so that small cells have their share.
static sl_point random_in_cell(check *run) {
    const sl_space *space = &run->baked.space;
    const sl_cell *cell = &space->cells[sl_random_below(&run->random, space->cell_count)];
    const sl_point *corners = space->vertices + cell->first_vertex;
    const size_t i = 1 + (size_t)sl_random_below(&run->random, cell->vertex_count - 2);
    double u = unit(run), v = unit(run);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return (sl_point){
        corners[0].x + u * (corners[i].x - corners[0].x) + v * (corners[i + 1].x - corners[0].x),
        corners[0].y + u * (corners[i].y - corners[0].y) + v * (corners[i + 1].y - corners[0].y)};
}

/// Beside a random wall: near one of its ends half of the times.
static sl_point random_at_wall(check *run) {
    const sl_wall *wall = &run->map.walls[sl_random_below(&run->random, run->map.wall_count)];
    const double share = unit(run) < 0.5 ? (unit(run) < 0.5 ? 0 : 1) : unit(run);
    const double off = run->longest * exp2(-8 - 30 * unit(run));
    return (sl_point){wall->a.x + share * (wall->b.x - wall->a.x) + off * (2 * unit(run) - 1),
                      wall->a.y + share * (wall->b.y - wall->a.y) + off * (2 * unit(run) - 1)};
}

static sl_point random_point(check *run) {
    const double which = unit(run);
    if (which < 0.4 && run->baked.space.cell_count) return random_in_cell(run);
    return which < 0.7 ? random_in_box(run) : random_at_wall(run);
}

/// From a point in any direction, or close by the end of a wall, as far as some share of the way to
/// the first wall: most of the times nearly all of it.
static sl_segment random_sightline(check *run) {
    sl_segment s = {.a = random_point(run)};
    double dx, dy;
    if (unit(run) < 0.5) {
        const double angle = 2 * acos(-1) * unit(run);
        dx = cos(angle);
        dy = sin(angle);
    } else {
        const sl_point at = random_at_wall(run);
        dx = at.x - s.a.x;
        dy = at.y - s.a.y;
    }
    const double length = hypot(dx, dy);
    if (!(length > 0)) return (sl_segment){s.a, s.a};
    const double scale = run->longest / length;
    s.b = (sl_point){s.a.x + dx * scale, s.a.y + dy * scale};
    size_t wall;
    const double reach = blockers_reach(run->walls, s, &wall);
    const double share = reach * (unit(run) < 0.6 ? 1 - exp2(-4 - 20 * unit(run)) : unit(run));
    s.b = (sl_point){s.a.x + dx * scale * share, s.a.y + dy * scale * share};
    return s;
}

// --- checking

static void tell_lost(check *run, sl_segment s, const char *what, uint32_t a, uint32_t b) {
    if (run->lost++ >= 5) return;
    fprintf(stderr, "lost: %.17g,%.17g sees %.17g,%.17g, but not %s %lu %lu\n", s.a.x, s.a.y, s.b.x,
            s.b.y, what, (unsigned long)a, (unsigned long)b);
}

static double distance_to_point(sl_segment s, sl_point p) {
    const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, length = hypot(dx, dy);
    const double px = p.x - s.a.x, py = p.y - s.a.y;
    const double along = length > 0 ? (px * dx + py * dy) / length : 0;
    if (!(along > 0)) return hypot(px, py);
    if (along >= length) return hypot(p.x - s.b.x, p.y - s.b.y);
    return fabs(dx * py - dy * px) / length;
}

/// Whether a sightline that meets no wall comes as near to one as cleaning may have moved it, or as
/// what the distance itself is rounded by.
static bool is_near(const check *run, sl_segment s) {
    const sl_box box = sl_map_bounds(&run->map);
    const double size =
        fmax(fmax(fabs(box.min.x), fabs(box.min.y)), fmax(fabs(box.max.x), fabs(box.max.y)));
    const double least = run->apart + (run->apart > 0 ? 0x1p-51 * size : 0);
    for (size_t i = 0; least > 0 && i < run->map.wall_count; i++) {
        const sl_segment w = {run->map.walls[i].a, run->map.walls[i].b};
        if (distance_to_point(w, s.a) <= least || distance_to_point(w, s.b) <= least ||
            distance_to_point(s, w.a) <= least || distance_to_point(s, w.b) <= least)
            return true;
    }
    return false;
}

static void check_cells(check *run, sl_segment s) {
    const sl_baked *baked = &run->baked;
    const uint32_t a = sl_space_locate(&baked->space, s.a);
    // Outside the space, and where the bake did not look, nothing is said.
    if (a == SL_NO_CELL) return;
    const uint32_t b = sl_space_locate(&baked->space, s.b);
    if (b == SL_NO_CELL) return;
    if (!sl_pvs_count(&baked->visibility.pvs, a) || !sl_pvs_count(&baked->visibility.pvs, b))
        return;
    run->checked++;
    if (sl_pvs_sees(&baked->visibility.pvs, a, b) && sl_pvs_sees(&baked->visibility.pvs, b, a))
        return;
    if (is_near(run, s))
        run->near++;
    else
        tell_lost(run, s, "cells", a, b);
}

static void check_sectors(check *run, sl_segment s) {
    const uint32_t a = sectors_at(run->sectors, s.a), b = sectors_at(run->sectors, s.b);
    const size_t count = run->level.sector_count;
    if (a == SLI_NO_SECTOR || b == SLI_NO_SECTOR) return;
    run->checked++;
    if (!sectors_rejected(&run->reject, count, a, b) &&
        !sectors_rejected(&run->reject, count, b, a))
        return;
    tell_lost(run, s, "sectors", a, b);
    bool *lost = &run->lost_sectors[(a < b ? a : b) * count + (a < b ? b : a)];
    run->lost_pairs += !*lost;
    *lost = true;
}

static void check_all(check *run) {
    // A map of closed rooms is entered by every second point or so; one without room by none.
    const uint64_t most = 100 * run->count;
    while (run->checked < run->count && run->drawn < most) {
        run->drawn++;
        const sl_segment s = random_sightline(run);
        if (!blockers_free(run->walls, s)) continue;
        run->free++;
        if (run->slv_path)
            check_cells(run, s);
        else
            check_sectors(run, s);
    }
}

// --- files

static void read_walls(check *run) {
    must(run, sl_map_read(run->context, run->map_path, &run->import, &run->map));
    if (run->map.wall_count == 0) {
        fprintf(stderr, "check_sightlines: %s: no walls\n", run->map_path);
        exit(2);
    }
    sl_segment *segments = calloc(run->map.wall_count, sizeof *segments);
    if (!segments) abort();
    for (size_t i = 0; i < run->map.wall_count; i++)
        segments[i] = (sl_segment){run->map.walls[i].a, run->map.walls[i].b};
    run->walls = blockers_create(segments, run->map.wall_count);
    free(segments);
    const sl_box box = sl_map_bounds(&run->map);
    run->longest = 2 * hypot(box.max.x - box.min.x, box.max.y - box.min.y);
}

/// How far cleaning moves walls.
static void find_apart(check *run) {
    sl_map map = {0};
    sl_clean_account account = {0};
    must(run, sl_map_copy(run->context, &run->map, &map));
    must(run, sl_map_clean(run->context, &map, NULL, &account));
    run->apart = account.largest_move;
    sl_map_destroy(run->context, &map);
}

static void read_sectors(check *run) {
    sli_wad wad;
    sli_wad_map map;
    must(run, sl_file_read(run->context, run->map_path, &run->map_bytes));
    must(run,
         sli_wad_open(run->context, run->map_path, run->map_bytes.data, run->map_bytes.size, &wad));
    must(run, sli_wad_find_map(run->context, &wad, run->import.map, &map));
    must(run, sli_doom_read(run->context, &wad, &map, &run->level));
    run->sectors = sector_finder_create(&run->level);
    run->lost_sectors = calloc(run->level.sector_count * run->level.sector_count + 1, 1);
    if (!run->lost_sectors) abort();

    must(run, sl_file_read(run->context, run->reject_path, &run->reject_bytes));
    must(run, sli_wad_open(run->context, run->reject_path, run->reject_bytes.data,
                           run->reject_bytes.size, &wad));
    must(run, sli_wad_find_map(run->context, &wad, run->import.map, &map));
    const uint32_t lump = sli_wad_find_lump(&wad, &map, "REJECT");
    if (lump == wad.lump_count) {
        fprintf(stderr, "check_sightlines: %s: no REJECT\n", run->reject_path);
        exit(2);
    }
    must(run, sli_wad_lump(run->context, &wad, lump, &run->reject));
}

/// Ordered pairs of different sectors that the REJECT hides.
static uint64_t count_hidden(const check *run) {
    const size_t count = run->level.sector_count;
    uint64_t hidden = 0;
    for (uint32_t a = 0; a < count; a++)
        for (uint32_t b = 0; b < count; b++)
            hidden += a != b && sectors_rejected(&run->reject, count, a, b);
    return hidden;
}

static void print_result(const check *run) {
    if (run->slv_path) {
        puts("walls,cells,drawn,free,checked,near,lost");
        printf("%zu,%lu,%llu,%llu,%llu,%llu,%llu\n", run->map.wall_count,
               (unsigned long)run->baked.space.cell_count, (unsigned long long)run->drawn,
               (unsigned long long)run->free, (unsigned long long)run->checked,
               (unsigned long long)run->near, (unsigned long long)run->lost);
        return;
    }
    puts("walls,sectors,hidden_pairs,drawn,free,checked,lost,lost_pairs");
    printf("%zu,%zu,%llu,%llu,%llu,%llu,%llu,%llu\n", run->map.wall_count, run->level.sector_count,
           (unsigned long long)count_hidden(run), (unsigned long long)run->drawn,
           (unsigned long long)run->free, (unsigned long long)run->checked,
           (unsigned long long)run->lost, (unsigned long long)run->lost_pairs);
}

static void usage(void) {
    fputs("usage: check_sightlines MAP [--map NAME] [--slice Z] --slv FILE.slv | --reject OUT.wad\n"
          "                        [--count N] [--seed S] [--apart M]\n",
          stderr);
    exit(2);
}

static void read_arguments(check *run, int argc, char **argv) {
    static const struct option options[] = {{"map", 1, NULL, 'm'},   {"slice", 1, NULL, 'z'},
                                            {"slv", 1, NULL, 's'},   {"reject", 1, NULL, 'r'},
                                            {"count", 1, NULL, 'n'}, {"seed", 1, NULL, 'i'},
                                            {"apart", 1, NULL, 'a'}, {NULL, 0, NULL, 0}};
    for (int code; (code = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        if (code == 'm') run->import.map = optarg;
        if (code == 'z') run->import.slice = strtod(optarg, NULL);
        if (code == 'z') run->import.has_slice = true;
        if (code == 's') run->slv_path = optarg;
        if (code == 'r') run->reject_path = optarg;
        if (code == 'n') run->count = strtoull(optarg, NULL, 10);
        if (code == 'a') run->apart = strtod(optarg, NULL);
        if (code == 'i') run->random.state = strtoull(optarg, NULL, 10);
        if (code == '?') usage();
    }
    if (optind + 1 != argc || !run->slv_path == !run->reject_path) usage();
    run->map_path = argv[optind];
}

int main(int argc, char **argv) {
    check run = {.count = 1000000, .apart = -1, .import = sl_import_options_default()};
    run.context = sl_context_create(NULL);
    if (!run.context || sl_io_use(run.context) != SL_OK) abort();
    read_arguments(&run, argc, argv);
    read_walls(&run);
    if (run.apart < 0) find_apart(&run);
    if (run.slv_path) {
        must(&run, sl_baked_read(run.context, run.slv_path, &run.baked));
    } else {
        read_sectors(&run);
    }
    check_all(&run);
    print_result(&run);
    if (run.sectors) sector_finder_destroy(run.sectors);
    blockers_destroy(run.walls);
    sl_free(run.context, run.map_bytes.data);
    sl_free(run.context, run.reject_bytes.data);
    free(run.lost_sectors);
    sli_doom_level_destroy(run.context, &run.level);
    sl_baked_destroy(run.context, &run.baked);
    sl_map_destroy(run.context, &run.map);
    sl_context_destroy(run.context);
    return run.lost ? 1 : run.checked ? 0 : 2;
}
