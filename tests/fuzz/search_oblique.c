// Random maps of oblique walls, each cut by the BSP: the space must be sound, and no sightline that
// the walls leave free be lost. In maps of a few steps of doubles a wall may be left out of a cell,
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

static bool fails(search *s, const sl_map *map, bool sane) {
    const sl_bsp_options options = sl_bsp_options_default();
    sl_space space = {0};
    sl_visibility seen = {0};
    sl_status status = sl_subdivide_bsp(s->context, map, &options, &space);
    if (status == SL_OK) status = sl_space_check(s->context, &space);
    bool lost = false;
    if (status == SL_OK && sane) {
        size_t count;
        const sl_see_method *sweep = sl_see_methods(&count);
        while (sweep->stabs) sweep++;
        const sl_see_options see = sl_see_options_default();
        status = sweep->see(s->context, &space, &see, &seen);
        lost = status == SL_OK && loses(s, map, &space, &seen);
    }
    if (status == SL_BAD_INPUT && !sane &&
        strstr(sl_context_message(s->context), "a wall inside")) {
        s->left_out++;
        status = SL_OK;
    }
    if (status != SL_OK) printf("# %s\n", sl_context_message(s->context));
    sl_visibility_destroy(s->context, &seen);
    sl_space_destroy(s->context, &space);
    return lost || status != SL_OK;
}

static bool try_map(search *s, uint64_t seed) {
    sl_map map = {0};
    const oblique_grid grid = (oblique_grid)(seed % OBLIQUE_GRIDS);
    if (oblique_random_map(s->context, seed, grid, 24, &map) != SL_OK) abort();
    s->random.state = seed;
    const bool failed = fails(s, &map, grid < OBLIQUE_SANE);
    if (failed) {
        printf("# seed %llu\nsightline 1\n", (unsigned long long)seed);
        for (size_t i = 0; i < map.wall_count; i++)
            printf("wall %.17g %.17g %.17g %.17g\n", map.walls[i].a.x, map.walls[i].a.y,
                   map.walls[i].b.x, map.walls[i].b.y);
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
