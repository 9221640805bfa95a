// check_reject MAP.wad --map NAME --slv FILE.slv --reject OURS.wad [--aimed]
//
// Holds the REJECT that a map has in MAP.wad against the one in OURS.wad, pair of sectors by pair.
// A pair that the first hides and the second does not is wrong where a sightline is found that
// joins the two sectors and meets no wall of the map, exactly decided apart from the library: it is
// aimed from cell to cell of FILE.slv, from which OURS.wad was made. Right are those that both
// hide. Ambiguous is a pair of which each two cells that see each other have one that counts for
// two sectors, as lines of the map disagree. Undecided is the rest.
//
// Prints a line of CSV with its heading, all pairs unordered and of different sectors; with --aimed
// behind it a sightline for each pair found wrong. Exit status: 0,
// or 2 for wrong arguments or files.
#include "oracle/sectors.h"

#include "io/doom/wad.h"
#include "sightline/io.h"
#include "sightline/sightline.h"
#include "sightline/support.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct check {
    sl_context *context;
    const char *map_path, *map_name, *slv_path, *ours_path;
    bool aimed;
    sl_random random;
    sl_map map;
    blockers *walls;
    sl_baked baked;
    sli_cell_sectors cells;
    sl_bytes map_bytes, ours_bytes;
    sli_doom_level level;
    sector_finder *sectors;
    sli_lump theirs, ours;
    size_t their_hidden, our_hidden, right, wrong, ambiguous, undecided;
} check;

/// Cells of two sectors that see each other.
typedef struct cell_pair {
    uint32_t a, b;
} cell_pair;

static void must(const check *run, sl_status status) {
    if (status == SL_OK) return;
    fprintf(stderr, "check_reject: %s\n", sl_context_message(run->context));
    exit(2);
}

// --- sightlines

static sl_point random_in_cell(check *run, uint32_t number) {
    const sl_cell *cell = &run->baked.space.cells[number];
    const sl_point *v = run->baked.space.vertices + cell->first_vertex;
    const size_t i = 1 + (size_t)sl_random_below(&run->random, cell->vertex_count - 2);
    double s = sl_random_unit(&run->random), t = sl_random_unit(&run->random);
    if (s + t > 1) s = 1 - s, t = 1 - t;
    return (sl_point){v[0].x + s * (v[i].x - v[0].x) + t * (v[i + 1].x - v[0].x),
                      v[0].y + s * (v[i].y - v[0].y) + t * (v[i + 1].y - v[0].y)};
}

static bool joins(check *run, sl_segment s, uint32_t a, uint32_t b) {
    return blockers_free(run->walls, s) && sectors_at(run->sectors, s.a) == a &&
           sectors_at(run->sectors, s.b) == b;
}

/// A line through the portals between two cells, from cell to cell.
static bool aim(check *run, cell_pair cells, sl_segment *out) {
    sl_explain_options options = sl_explain_options_default();
    options.sight = SL_OPEN;
    options.solver = sl_funnel();
    options.most_tests = 3000000;
    options.most_misses = 0;
    sl_explanation told = {0};
    must(run, sl_explain(run->context, &run->baked.space, &options, cells.a, cells.b, &told));
    *out = told.shown;
    const bool seen = told.seen;
    sl_explanation_destroy(run->context, &told);
    return seen;
}

/// Tries the cells of a pair of sectors, drawing points first, then with a line through the portals
/// and others beside it.
static bool find_sightline(check *run, const cell_pair *cells, size_t count, uint32_t a, uint32_t b,
                           sl_segment *out) {
    enum { DRAWN = 40, AIMED = 12, SHIFTED = 40 };
    for (size_t k = 0; k < DRAWN * count; k++) {
        const cell_pair *c = &cells[k % count];
        *out = (sl_segment){random_in_cell(run, c->a), random_in_cell(run, c->b)};
        if (joins(run, *out, a, b)) return true;
    }
    for (size_t k = 0; k < count && k < AIMED; k++) {
        sl_segment line;
        if (!aim(run, cells[k * count / (count < AIMED ? count : AIMED)], &line)) continue;
        for (int i = 0; i < SHIFTED; i++) {
            // Along itself only: across, a narrow sightline leaves no room.
            const double s = i ? sl_random_unit(&run->random) * 0.9 : 0;
            const double t = i ? sl_random_unit(&run->random) * 0.9 : 0;
            const double dx = line.b.x - line.a.x, dy = line.b.y - line.a.y;
            *out = (sl_segment){{line.a.x + s * dx, line.a.y + s * dy},
                                {line.b.x - t * dx, line.b.y - t * dy}};
            if (joins(run, *out, a, b)) return true;
        }
    }
    return false;
}

/// Tries a line, and others beside it.
static bool try_shifted(check *run, sl_segment line, uint32_t a, uint32_t b, sl_segment *out) {
    const double dx = line.b.x - line.a.x, dy = line.b.y - line.a.y, length = hypot(dx, dy);
    *out = line;
    if (joins(run, *out, a, b)) return true;
    for (double by = 1e-6; by < 11; by *= 10)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double x = -sign * by * dy / length, y = sign * by * dx / length;
            *out = (sl_segment){{line.a.x + x, line.a.y + y}, {line.b.x + x, line.b.y + y}};
            if (joins(run, *out, a, b)) return true;
        }
    return false;
}

// --- pairs of sectors

static bool reaches(const check *run, uint32_t cell, uint32_t sector) {
    for (uint32_t i = run->cells.first[cell]; i < run->cells.first[cell + 1]; i++)
        if (run->cells.sectors[i] == sector) return true;
    return false;
}

/// Some of the pairs of cells of two sectors that see each other.
static size_t gather_cells(check *run, uint32_t a, uint32_t b, cell_pair *out, size_t most) {
    size_t count = 0, met = 0;
    for (uint32_t i = 0; i < run->baked.space.cell_count; i++) {
        if (!reaches(run, i, a)) continue;
        for (sl_pvs_run r = sl_pvs_begin(&run->baked.visibility.pvs, i); sl_pvs_next(&r);)
            for (uint32_t k = r.first; k < r.end; k++) {
                if (!reaches(run, k, b)) continue;
                // Each met so far with the same chance.
                const size_t at =
                    met++ < most ? count++ : (size_t)sl_random_below(&run->random, met);
                if (at < most) out[at] = (cell_pair){i, k};
            }
    }
    return count;
}

static bool is_in_one_sector(const check *run, uint32_t cell) {
    return run->cells.first[cell + 1] - run->cells.first[cell] == 1;
}

typedef enum verdict { WRONG, AMBIGUOUS, UNDECIDED } verdict;

static verdict judge_cells(check *run, cell_pair cells, uint32_t a, uint32_t b, sl_segment *out) {
    sl_segment line;
    if (!is_in_one_sector(run, cells.a) || !is_in_one_sector(run, cells.b)) return AMBIGUOUS;
    if (!aim(run, cells, &line)) return UNDECIDED;
    return try_shifted(run, line, a, b, out) ? WRONG : UNDECIDED;
}

/// Goes through all pairs of cells of two sectors, and all that their own lines tell.
static verdict judge(check *run, uint32_t a, uint32_t b, sl_segment *out) {
    verdict all = AMBIGUOUS;
    for (uint32_t i = 0; i < run->baked.space.cell_count; i++) {
        if (!reaches(run, i, a)) continue;
        for (sl_pvs_run r = sl_pvs_begin(&run->baked.visibility.pvs, i); sl_pvs_next(&r);)
            for (uint32_t k = r.first; k < r.end; k++) {
                if (!reaches(run, k, b)) continue;
                const verdict one = judge_cells(run, (cell_pair){i, k}, a, b, out);
                if (one == WRONG) return WRONG;
                if (one == UNDECIDED) all = UNDECIDED;
            }
    }
    return all;
}

static void do_pair(check *run, uint32_t a, uint32_t b) {
    enum { MOST = 48 };
    const size_t count = run->level.sector_count;
    const bool theirs =
        sectors_rejected(&run->theirs, count, a, b) || sectors_rejected(&run->theirs, count, b, a);
    const bool ours = sectors_rejected(&run->ours, count, a, b);
    run->their_hidden += theirs;
    run->our_hidden += ours;
    if (!theirs) return;
    if (ours) {
        run->right++;
        return;
    }
    cell_pair cells[MOST];
    const size_t found = gather_cells(run, a, b, cells, MOST);
    sl_segment line;
    const verdict told =
        find_sightline(run, cells, found, a, b, &line) ? WRONG : judge(run, a, b, &line);
    run->wrong += told == WRONG;
    run->ambiguous += told == AMBIGUOUS;
    run->undecided += told == UNDECIDED;
    if (run->aimed && told == WRONG)
        printf("sectors %lu %lu: %.17g,%.17g sees %.17g,%.17g\n", (unsigned long)a,
               (unsigned long)b, line.a.x, line.a.y, line.b.x, line.b.y);
}

// --- files

static void read_reject(check *run, const char *path, sl_bytes *bytes, sli_lump *out) {
    sli_wad wad;
    sli_wad_map map;
    must(run, sl_file_read(run->context, path, bytes));
    must(run, sli_wad_open(run->context, path, bytes->data, bytes->size, &wad));
    must(run, sli_wad_find_map(run->context, &wad, run->map_name, &map));
    if (!run->level.sectors) must(run, sli_doom_read(run->context, &wad, &map, &run->level));
    const uint32_t lump = sli_wad_find_lump(&wad, &map, "REJECT");
    if (lump == wad.lump_count) {
        fprintf(stderr, "check_reject: %s: no REJECT\n", path);
        exit(2);
    }
    must(run, sli_wad_lump(run->context, &wad, lump, out));
}

static void read_all(check *run) {
    const sl_import_options options = {.map = run->map_name};
    must(run, sl_map_read(run->context, run->map_path, &options, &run->map));
    sl_segment *segments = calloc(run->map.wall_count + 1, sizeof *segments);
    if (!segments) abort();
    for (size_t i = 0; i < run->map.wall_count; i++)
        segments[i] = (sl_segment){run->map.walls[i].a, run->map.walls[i].b};
    run->walls = blockers_create(segments, run->map.wall_count);
    free(segments);
    read_reject(run, run->map_path, &run->map_bytes, &run->theirs);
    read_reject(run, run->ours_path, &run->ours_bytes, &run->ours);
    must(run, sl_baked_read(run->context, run->slv_path, &run->baked));
    must(run, sli_cell_sectors_find(run->context, &run->baked.space, &run->level, &run->cells));
    run->sectors = sector_finder_create(&run->level);
}

static void usage(void) {
    fputs("usage: check_reject MAP.wad --map NAME --slv FILE.slv --reject OURS.wad [--aimed]\n",
          stderr);
    exit(2);
}

static void read_arguments(check *run, int argc, char **argv) {
    static const struct option options[] = {{"map", 1, NULL, 'm'},
                                            {"slv", 1, NULL, 's'},
                                            {"reject", 1, NULL, 'r'},
                                            {"aimed", 0, NULL, 'a'},
                                            {NULL, 0, NULL, 0}};
    for (int code; (code = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        if (code == 'm') run->map_name = optarg;
        if (code == 's') run->slv_path = optarg;
        if (code == 'r') run->ours_path = optarg;
        if (code == 'a') run->aimed = true;
        if (code == '?') usage();
    }
    if (optind + 1 != argc || !run->map_name || !run->slv_path || !run->ours_path) usage();
    run->map_path = argv[optind];
}

int main(int argc, char **argv) {
    check run = {0};
    run.context = sl_context_create(NULL);
    if (!run.context || sl_io_use(run.context) != SL_OK) abort();
    read_arguments(&run, argc, argv);
    read_all(&run);
    const uint32_t count = (uint32_t)run.level.sector_count;
    for (uint32_t a = 0; a < count; a++)
        for (uint32_t b = a + 1; b < count; b++) do_pair(&run, a, b);
    puts("sectors,hidden,theirs,right,wrong,ambiguous,undecided");
    printf("%lu,%zu,%zu,%zu,%zu,%zu,%zu\n", (unsigned long)count, run.our_hidden, run.their_hidden,
           run.right, run.wrong, run.ambiguous, run.undecided);
    sector_finder_destroy(run.sectors);
    blockers_destroy(run.walls);
    sli_cell_sectors_destroy(run.context, &run.cells);
    sl_free(run.context, run.map_bytes.data);
    sl_free(run.context, run.ours_bytes.data);
    sli_doom_level_destroy(run.context, &run.level);
    sl_baked_destroy(run.context, &run.baked);
    sl_map_destroy(run.context, &run.map);
    sl_context_destroy(run.context);
    return 0;
}
