// Random maps on which every exact method must see the same, and the others err their own way only:
// search_methods [--seed N] [--count N] [--quiet]. A map that fails is made smaller, wall by wall,
// and printed as map text. Spaces with oblique walls are tried between, printed by their seed.
#include "oracle/convex_space.h"
#include "oracle/must.h"
#include "oracle/oracle.h"
#include "oracle/random_map.h"
#include "sightline/sightline.h"
#include "space/subdivide.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PUSH_LIMIT = 30000, WHY_SIZE = 160 };

static void need(sl_context *context, sl_status status) {
    if (status == SL_OK) return;
    fprintf(stderr, "search_methods: %s\n", sl_context_message(context));
    exit(2);
}

// --- one space

static sl_visibility see(sl_context *context, const sl_space *space, const sl_see_method *method,
                         sl_sight sight) {
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.threads = 1 + space->cell_count % 3;
    options.solver = method->stabs ? sl_funnel() : NULL;
    sl_visibility seen;
    need(context, method->see(context, space, &options, &seen));
    return seen;
}

/// Whether a method says other than the truth where it promises not to; `why` tells of the pair.
static bool errs(const sl_visibility *seen, const char *name, const bool *truth,
                 char why[WHY_SIZE]) {
    const uint32_t n = seen->pvs.cell_count;
    for (uint32_t a = 0; a < n; a++)
        for (uint32_t b = 0; b < n; b++) {
            const bool said = sl_pvs_sees(&seen->pvs, a, b), is = truth[(size_t)a * n + b];
            if (said == is || (said && seen->guarantee == SL_CONSERVATIVE) ||
                (is && seen->guarantee == SL_AGGRESSIVE))
                continue;
            snprintf(why, WHY_SIZE, "%s, %s sight: cells %u and %u are %s", name,
                     seen->sight == SL_CLOSED ? "closed" : "open", a, b,
                     is ? "hidden, but see each other" : "seen, but hidden");
            return true;
        }
    return false;
}

static void take_truth(const sl_visibility *seen, bool *truth) {
    const uint32_t n = seen->pvs.cell_count;
    for (size_t i = 0; i < (size_t)n * n; i++)
        truth[i] = sl_pvs_sees(&seen->pvs, (uint32_t)(i / n), (uint32_t)(i % n));
}

/// Asks every method. Without the oracle's word the first method's counts.
static bool space_fails(sl_context *context, const sl_space *space, bool *truth[2], bool known,
                        char why[WHY_SIZE]) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    bool fails = false;
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++)
        for (size_t m = 0; m < count && !fails; m++) {
            sl_visibility seen = see(context, space, &methods[m], (sl_sight)sight);
            if (m == 0 && !known) take_truth(&seen, truth[sight]);
            fails = errs(&seen, methods[m].name, truth[sight], why);
            sl_visibility_destroy(context, &seen);
        }
    return fails;
}

static bool try_space(sl_context *context, const sl_space *space, bool ask_oracle,
                      char why[WHY_SIZE]) {
    const size_t pairs = (size_t)space->cell_count * space->cell_count;
    bool *truth[2] = {must(calloc(pairs, sizeof **truth)), must(calloc(pairs, sizeof **truth))};
    const bool known =
        ask_oracle && oracle_by_sequences(space, PUSH_LIMIT, truth[SL_CLOSED], truth[SL_OPEN]);
    const bool fails = space_fails(context, space, truth, known, why);
    free(truth[0]);
    free(truth[1]);
    return fails;
}

// --- maps

static bool map_fails(sl_context *context, const sl_map *map, char why[WHY_SIZE]) {
    sl_map clean = {0};
    for (size_t i = 0; i < map->wall_count; i++)
        need(context, sl_map_add_wall(context, &clean, map->walls[i].a, map->walls[i].b, 0));
    need(context, sl_map_clean(context, &clean, NULL, NULL));
    bool fails = false;
    if (clean.wall_count) {
        sl_space space;
        const sl_subdivide_options rules = sl_subdivide_options_default();
        need(context, sli_subdivide_kd(context, &clean, &rules, &space));
        fails = try_space(context, &space, false, why);
        sl_space_destroy(context, &space);
    }
    sl_map_destroy(context, &clean);
    return fails;
}

/// Leaves out walls as long as the map fails without them.
static void shrink(sl_context *context, sl_map *map, char why[WHY_SIZE]) {
    for (bool smaller = true; smaller;) {
        smaller = false;
        for (size_t i = 0; i < map->wall_count; i++) {
            const sl_wall wall = map->walls[i];
            map->walls[i] = map->walls[--map->wall_count];
            char now[WHY_SIZE];
            if (map_fails(context, map, now)) {
                memcpy(why, now, sizeof now);
                smaller = true;
                i--;
            } else {
                map->walls[map->wall_count++] = map->walls[i];
                map->walls[i] = wall;
            }
        }
    }
}

static bool try_map(sl_context *context, uint64_t seed) {
    char why[WHY_SIZE];
    sl_map map = {0};
    need(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &map));
    const bool fails = map_fails(context, &map, why);
    if (fails) {
        shrink(context, &map, why);
        printf("# seed %llu, %s\nsightline 1\n", (unsigned long long)seed, why);
        for (size_t i = 0; i < map.wall_count; i++)
            printf("wall %.17g %.17g %.17g %.17g\n", map.walls[i].a.x, map.walls[i].a.y,
                   map.walls[i].b.x, map.walls[i].b.y);
    }
    sl_map_destroy(context, &map);
    return fails;
}

static bool try_oblique(sl_context *context, uint64_t seed) {
    char why[WHY_SIZE];
    sl_space space;
    oracle_random_space(context, seed, &space);
    const bool fails = try_space(context, &space, true, why);
    if (fails) printf("# oblique space of seed %llu, %s\n", (unsigned long long)seed, why);
    sl_space_destroy(context, &space);
    return fails;
}

int main(int argc, char **argv) {
    uint64_t first = 1, count = 1000;
    bool quiet = false;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--quiet") == 0) {
            quiet = true;
        } else if (i + 1 < argc && strcmp(argv[i], "--seed") == 0) {
            first = strtoull(argv[++i], NULL, 10);
        } else if (i + 1 < argc && strcmp(argv[i], "--count") == 0) {
            count = strtoull(argv[++i], NULL, 10);
        } else {
            fputs("usage: search_methods [--seed N] [--count N] [--quiet]\n", stderr);
            return 2;
        }
    }
    sl_context *context = must(sl_context_create(NULL));
    uint64_t found = 0;
    for (uint64_t seed = first; seed < first + count; seed++)
        found += (uint64_t)try_map(context, seed) + (uint64_t)try_oblique(context, seed);
    if (!quiet)
        printf("%llu maps and as many oblique spaces: %llu failures\n", (unsigned long long)count,
               (unsigned long long)found);
    sl_context_destroy(context);
    return found != 0;
}
