// Random maps of oblique walls, half of them with seams, each made a mesh: the space must be
// sound, no sightline that the walls leave free be lost, and the sweep see what the depth-first
// search does, closed and open. In maps of a few steps of doubles a wall may be left out of a cell,
// as space.h tells; these are counted: search_oblique [--seed N] [--count N] [--sightlines N]
// [--quiet]. A map that fails is printed as map text.
#include "oracle/random_oblique.h"
#include "sightline/sightline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct search {
    sl_context *context;
    sl_random random;
    uint64_t sightlines, free_count, left_out;
} search;

static bool loses(search *s, const sl_map *map, const sl_space *space, const sl_visibility *seen) {
    for (uint64_t i = 0; i < s->sightlines; i++) {
        const sl_point p = oblique_random_point(&s->random, map, space->bounds);
        const sl_point q = oblique_random_point(&s->random, map, space->bounds);
        const uint32_t a = sl_space_locate(space, p), b = sl_space_locate(space, q);
        if (a == SL_NO_CELL || b == SL_NO_CELL || !oblique_is_free(map, p, q)) continue;
        s->free_count++;
        if (sl_pvs_sees(&seen->pvs, a, b)) continue;
        printf("# lost: %.17g %.17g sees %.17g %.17g, but not cells %u %u\n", p.x, p.y, q.x, q.y, a,
               b);
        return true;
    }
    return false;
}

static const sl_see_method *method(const char *name) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, name) == 0) return &methods[i];
    abort();
}

static sl_status see(search *s, const sl_space *space, const char *name, sl_sight sight,
                     sl_visibility *out) {
    const sl_see_method *by = method(name);
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    if (by->stabs) options.solver = sl_funnel();
    return by->see(s->context, space, &options, out);
}

/// Whether the sweep's pairs are not those of the depth-first search.
static bool differs(const sl_space *space, const sl_visibility *sweep, const sl_visibility *dfs) {
    for (uint32_t a = 0; a < space->cell_count; a++)
        for (uint32_t b = 0; b < space->cell_count; b++) {
            const bool seen = sl_pvs_sees(&sweep->pvs, a, b);
            if (seen == sl_pvs_sees(&dfs->pvs, a, b)) continue;
            printf("# cell %u %s cell %u by the sweep alone\n", a, seen ? "sees" : "does not see",
                   b);
            return true;
        }
    return false;
}

/// By both methods; `free_ones`: no free sightline may be lost either.
static sl_status compare(search *s, const sl_map *map, const sl_space *space, sl_sight sight,
                         bool free_ones, bool *wrong) {
    sl_visibility sweep = {0}, dfs = {0};
    sl_status status = see(s, space, "sweep", sight, &sweep);
    if (status == SL_OK) status = see(s, space, "dfs", sight, &dfs);
    if (status == SL_OK) *wrong = differs(space, &sweep, &dfs);
    if (status == SL_OK && free_ones && !*wrong) *wrong = loses(s, map, space, &sweep);
    sl_visibility_destroy(s->context, &sweep);
    sl_visibility_destroy(s->context, &dfs);
    return status;
}

static bool fails(search *s, const sl_map *map, bool sane) {
    sl_space space = {0};
    sl_status status = sl_subdivide_mesh(s->context, map, &space);
    if (status == SL_OK) status = sl_space_check(s->context, &space);
    bool wrong = false;
    if (status == SL_OK) status = compare(s, map, &space, SL_CLOSED, sane, &wrong);
    if (status == SL_OK && !wrong) status = compare(s, map, &space, SL_OPEN, false, &wrong);
    if (status == SL_BAD_INPUT && !sane &&
        strstr(sl_context_message(s->context), "a wall inside")) {
        s->left_out++;
        status = SL_OK;
    }
    if (status != SL_OK) printf("# %s\n", sl_context_message(s->context));
    sl_space_destroy(s->context, &space);
    return wrong || status != SL_OK;
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
    const bool failed = fails(s, &map, grid < OBLIQUE_SANE);
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
        printf(
            "%llu maps, %llu free sightlines: %llu failures; in %llu of tiny steps a wall is left "
            "out\n",
            (unsigned long long)count, (unsigned long long)s.free_count, (unsigned long long)found,
            (unsigned long long)s.left_out);
    sl_context_destroy(s.context);
    return found != 0;
}
