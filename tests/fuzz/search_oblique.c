// Random maps of oblique walls, half of them with seams, cleaned and made a mesh: the cells must
// tile the bounds, all exact methods see the same, closed and open, places be located as by asking
// all cells, and no sightline be lost that is free: of the clean walls, or farther than cleaning
// moves them from those as read. One in three is cleaned without a tolerance, which may be refused
// where walls are a few steps of doubles apart: search_oblique [--seed N] [--count N]
// [--sightlines N] [--quiet]. A map that fails is printed as map text.
#include "oracle/apart.h"
#include "oracle/random_oblique.h"
#include "oracle/tiling.h"
#include "sightline/sightline.h"
#include "space/subdivide.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct search {
    sl_context *context;
    sl_random random;
    uint64_t sightlines, free_count, refused;
} search;

/// A map in the making: as read, as cut, and how far walls were moved between.
typedef struct trial {
    const sl_map *read;
    sl_map map;
    double move;
    sl_space space;
} trial;

static bool is_free(const trial *t, sl_point p, sl_point q) {
    for (size_t i = 0; i < t->read->wall_count; i++) {
        const sl_segment wall = {t->read->walls[i].a, t->read->walls[i].b};
        if (!oracle_are_apart((sl_segment){p, q}, wall, t->move)) return false;
    }
    return true;
}

static bool loses(search *s, const trial *t, const sl_visibility *seen) {
    for (uint64_t i = 0; i < s->sightlines; i++) {
        const sl_point p = oblique_random_point(&s->random, &t->map, t->space.bounds);
        const sl_point q = oblique_random_point(&s->random, &t->map, t->space.bounds);
        const uint32_t a = sl_space_locate(&t->space, p), b = sl_space_locate(&t->space, q);
        if (a == SL_NO_CELL || b == SL_NO_CELL) continue;
        if (a != oracle_locate(&t->space, p)) {
            printf("# %a %a is not in cell %u\n", p.x, p.y, a);
            return true;
        }
        const bool is_clean = oblique_is_free(&t->map, p, q), as_read = is_free(t, p, q);
        s->free_count += as_read;
        if (!is_clean && !as_read) continue;
        if (is_clean && sl_pvs_sees(&seen->pvs, a, b)) continue;
        printf("# lost: %.17g %.17g sees %.17g %.17g, but not cells %u %u\n", p.x, p.y, q.x, q.y, a,
               b);
        return true;
    }
    return false;
}

static sl_status see(search *s, const sl_space *space, const sl_see_method *by, sl_sight sight,
                     sl_visibility *out) {
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    if (by->stabs) options.solver = sl_funnel();
    return by->see(s->context, space, &options, out);
}

/// Whether pairs are not those of the sweep.
static bool differs(const sl_space *space, const char *name, const sl_visibility *sweep,
                    const sl_visibility *other) {
    for (uint32_t a = 0; a < space->cell_count; a++)
        for (uint32_t b = 0; b < space->cell_count; b++) {
            const bool seen = sl_pvs_sees(&sweep->pvs, a, b);
            if (seen == sl_pvs_sees(&other->pvs, a, b)) continue;
            printf("# cell %u %s cell %u by the sweep, not by %s\n", a,
                   seen ? "sees" : "does not see", b, name);
            return true;
        }
    return false;
}

/// By all exact methods.
static sl_status compare(search *s, const trial *t, sl_sight sight, bool *wrong) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count), *sweep = methods;
    while (strcmp(sweep->name, "sweep") != 0) sweep++;
    sl_visibility swept = {0};
    sl_status status = see(s, &t->space, sweep, sight, &swept);
    for (size_t i = 0; i < count && status == SL_OK && !*wrong; i++) {
        if (!methods[i].stabs) continue;
        sl_visibility seen = {0};
        status = see(s, &t->space, &methods[i], sight, &seen);
        if (status == SL_OK) *wrong = differs(&t->space, methods[i].name, &swept, &seen);
        sl_visibility_destroy(s->context, &seen);
    }
    if (status == SL_OK && sight == SL_CLOSED && !*wrong) *wrong = loses(s, t, &swept);
    sl_visibility_destroy(s->context, &swept);
    return status;
}

static sl_status make(search *s, trial *t, double weld) {
    sl_clean_account account = {0};
    const sl_clean_options options = {.weld = weld};
    sl_status status = sl_map_copy(s->context, t->read, &t->map);
    if (status == SL_OK) status = sl_map_clean(s->context, &t->map, &options, &account);
    t->move = account.largest_move;
    if (status == SL_OK && t->map.wall_count)
        status = sli_subdivide_mesh(s->context, &t->map, &t->space);
    return status;
}

static bool fails(search *s, const sl_map *map, double weld) {
    trial t = {.read = map};
    char why[ORACLE_WHY];
    bool wrong = false;
    sl_status status = make(s, &t, weld);
    const bool refused = status == SL_UNSUPPORTED && weld == 0;
    s->refused += refused;
    if (status == SL_OK && t.map.wall_count) {
        status = sl_space_check(s->context, &t.space);
        wrong = !oracle_is_tiling(&t.space, why);
        if (wrong) printf("# %s\n", why);
        if (status == SL_OK && !wrong) status = compare(s, &t, SL_CLOSED, &wrong);
        if (status == SL_OK && !wrong) status = compare(s, &t, SL_OPEN, &wrong);
    }
    if (status != SL_OK && !refused) printf("# %s\n", sl_context_message(s->context));
    sl_space_destroy(s->context, &t.space);
    sl_map_destroy(s->context, &t.map);
    return wrong || (status != SL_OK && !refused);
}

static void add_seams(search *s, uint64_t seed, oblique_grid grid, sl_map *map) {
    sl_random random = {seed};
    for (int i = 0; i < 3; i++) {
        double at[4];
        for (int k = 0; k < 4; k++) at[k] = oblique_coordinate(&random, grid);
        const sl_segment seam = {{at[0], at[1]}, {at[2], at[3]}};
        if (sl_map_add_seam(s->context, map, seam, 0) != SL_OK) abort();
    }
}

static bool try_map(search *s, uint64_t seed) {
    sl_map map = {0};
    const oblique_grid grid = (oblique_grid)(seed % OBLIQUE_GRIDS);
    if (oblique_random_map(s->context, seed, grid, 24, &map) != SL_OK) abort();
    if (seed / OBLIQUE_GRIDS % 2) add_seams(s, seed, grid, &map);
    s->random.state = seed;
    const bool failed = fails(s, &map, seed / OBLIQUE_GRIDS % 3 ? -1 : 0);
    if (failed) {
        printf("# seed %llu\nsightline 1\n", (unsigned long long)seed);
        for (size_t i = 0; i < map.wall_count; i++)
            printf("wall %.17g %.17g %.17g %.17g\n", map.walls[i].a.x, map.walls[i].a.y,
                   map.walls[i].b.x, map.walls[i].b.y);
        for (size_t i = 0; i < map.seam_count; i++)
            printf("seam %.17g %.17g %.17g %.17g\n", map.seams[i].segment.a.x,
                   map.seams[i].segment.a.y, map.seams[i].segment.b.x, map.seams[i].segment.b.y);
    }
    sl_map_destroy(s->context, &map);
    return failed;
}

int main(int argc, char **argv) {
    uint64_t first = 1, count = 1000;
    search s = {.sightlines = 200};
    bool quiet = false;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--quiet") == 0) {
            quiet = true;
        } else if (i + 1 < argc && strcmp(argv[i], "--seed") == 0) {
            first = strtoull(argv[++i], NULL, 10);
        } else if (i + 1 < argc && strcmp(argv[i], "--count") == 0) {
            count = strtoull(argv[++i], NULL, 10);
        } else if (i + 1 < argc && strcmp(argv[i], "--sightlines") == 0) {
            s.sightlines = strtoull(argv[++i], NULL, 10);
        } else {
            fputs("usage: search_oblique [--seed N] [--count N] [--sightlines N] [--quiet]\n",
                  stderr);
            return 2;
        }
    }
    s.context = sl_context_create(NULL);
    if (!s.context) return 1;
    uint64_t found = 0;
    for (uint64_t seed = first; seed < first + count; seed++) found += try_map(&s, seed);
    if (!quiet)
        printf("%llu maps, %llu free sightlines: %llu failures; %llu refused without a tolerance\n",
               (unsigned long long)count, (unsigned long long)s.free_count,
               (unsigned long long)found, (unsigned long long)s.refused);
    sl_context_destroy(s.context);
    return found != 0;
}
