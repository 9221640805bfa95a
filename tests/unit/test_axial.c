/// The all-line map: turning or mirroring a plan turns or mirrors its lines, and strips narrower
/// than any tolerance have lines too. Subsets: those that the rules give one by one.
#include "space/outline.h"
#include "testing.h"

#include "analysis/axial/touch.h"
#include "geometry/length.h"
#include "oracle/random_map.h"
#include "sightline/axial.h"
#include "sightline/generate.h"

#include <math.h>

typedef struct change {
    const char *name;
    bool swaps; ///< x and y, first of all
    double x, y;
} change;

static const change changes[] = {
    {"a quarter turn", true, -1, 1},  {"a half turn", false, -1, -1},
    {"a quarter back", true, 1, -1},  {"mirroring in x", false, -1, 1},
    {"mirroring in y", false, 1, -1}, {"x and y swapped", true, 1, 1},
};

enum { CHANGES = sizeof changes / sizeof *changes };

static sl_point apply(const change *c, sl_point p) {
    if (c->swaps) p = (sl_point){p.y, p.x};
    return (sl_point){p.x * c->x, p.y * c->y};
}

static sl_point undo(const change *c, sl_point p) {
    p = (sl_point){p.x * c->x, p.y * c->y};
    return c->swaps ? (sl_point){p.y, p.x} : p;
}

static void find_lines(sl_context *context, const sl_map *map, unsigned threads,
                       sl_axial_lines *lines) {
    sl_space space = {0};
    sl_outline outline = {0};
    assert_ok(context, sl_subdivision_for(map)->subdivide(context, map, NULL, &space));
    assert_ok(context, sli_outline_make(context, &space, &outline));
    assert_ok(context, sl_axial_all_lines(context, &outline, threads, lines));
    sli_outline_destroy(context, &outline);
    sl_space_destroy(context, &space);
}

// --- sets of lines

/// Ends in millionths: those on walls are rounded. The lesser end comes first.
typedef struct line_key {
    int64_t at[4];
} line_key;

static int compare_keys(const void *left, const void *right) {
    const line_key *a = left, *b = right;
    for (int k = 0; k < 4; k++)
        if (a->at[k] != b->at[k]) return a->at[k] < b->at[k] ? -1 : 1;
    return 0;
}

static line_key key_of(const change *back, const sl_segment *line) {
    const sl_point a = back ? undo(back, line->a) : line->a;
    const sl_point b = back ? undo(back, line->b) : line->b;
    const line_key one = {{llround(a.x * 1e6 + 0.3), llround(a.y * 1e6 + 0.3),
                           llround(b.x * 1e6 + 0.3), llround(b.y * 1e6 + 0.3)}};
    const line_key other = {{one.at[2], one.at[3], one.at[0], one.at[1]}};
    return compare_keys(&one, &other) <= 0 ? one : other;
}

/// Sorted.
static line_key *keys_of(const change *back, const sl_segment *lines, uint32_t count) {
    line_key *keys = calloc((size_t)count + 1, sizeof *keys);
    assert_non_null(keys);
    for (uint32_t i = 0; i < count; i++) keys[i] = key_of(back, &lines[i]);
    qsort(keys, count, sizeof *keys, compare_keys);
    return keys;
}

static void check_same(const char *what, const change *c, uint64_t seed, const sl_segment *before,
                       uint32_t count, const sl_segment *after, uint32_t after_count) {
    line_key *left = keys_of(NULL, before, count), *right = keys_of(c, after, after_count);
    uint32_t i = 0;
    while (i < count && i < after_count && compare_keys(&left[i], &right[i]) == 0) i++;
    if (i < count || i < after_count) {
        const line_key *at = i < count ? &left[i] : &right[i];
        fail_msg("seed %llu: %u %s, but %u after %s; first at %g %g %g %g",
                 (unsigned long long)seed, count, what, after_count, c->name,
                 (double)at->at[0] / 1e6, (double)at->at[1] / 1e6, (double)at->at[2] / 1e6,
                 (double)at->at[3] / 1e6);
    }
    free(left);
    free(right);
}

/// The lines of a map beside those of the map turned and mirrored. The map becomes another.
static uint32_t check_map(sl_context *context, sl_map *map, uint64_t seed) {
    sl_axial_lines lines = {0};
    for (uint32_t w = 0; w < map->wall_count; w++) map->walls[w].ground = 0; // it has sides
    find_lines(context, map, 1, &lines);
    for (size_t k = 0; k < CHANGES; k++) {
        const change *c = &changes[k];
        sl_axial_lines changed = {0};
        for (uint32_t w = 0; w < map->wall_count; w++) {
            map->walls[w].a = apply(c, map->walls[w].a);
            map->walls[w].b = apply(c, map->walls[w].b);
        }
        find_lines(context, map, 2, &changed);
        check_same("lines", c, seed, lines.lines, lines.count, changed.lines, changed.count);
        check_same("probes", c, seed, lines.probes, lines.probe_count, changed.probes,
                   changed.probe_count);
        for (uint32_t w = 0; w < map->wall_count; w++) {
            map->walls[w].a = undo(c, map->walls[w].a);
            map->walls[w].b = undo(c, map->walls[w].b);
        }
        sl_axial_lines_destroy(context, &changed);
    }
    const uint32_t count = lines.count;
    sl_axial_lines_destroy(context, &lines);
    return count;
}

// --- tests

static const sl_map_kind *kind_named(const char *name) {
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    for (size_t i = 0; i < count; i++)
        if (!strcmp(kinds[i].name, name)) return &kinds[i];
    fail_msg("there is no kind %s", name);
    return NULL;
}

static void turned_offices_have_turned_lines(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    uint32_t count = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(8); seed++) {
        sl_map map = {0};
        sl_generate_options options = sl_generate_options_default();
        options.seed = seed;
        options.walls = 150;
        assert_ok(context, sl_generate(context, kind_named("office"), &options, &map));
        map.start_count = 0;
        count += check_map(context, &map, seed);
        sl_map_destroy(context, &map);
    }
    assert_true(count > 1000);
    sl_context_destroy(context);
}

/// Walls on whole numbers: many in line, with gaps, and some that end in the open.
static void turned_random_maps_have_turned_lines(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    uint32_t count = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(100); seed++) {
        sl_map map = {0};
        assert_ok(context, oracle_random_map(context, seed, ORACLE_GRID_INTEGER, &map));
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        map.start_count = 0;
        if (map.wall_count) count += check_map(context, &map, seed);
        sl_map_destroy(context, &map);
    }
    assert_true(count > 1000);
    sl_context_destroy(context);
}

static void check_count(sl_context *context, const char *text, uint32_t count) {
    sl_map map = {0};
    sl_axial_lines lines = {0};
    assert_ok(context, sl_map_parse(context, "room.map", text, strlen(text), NULL, &map));
    find_lines(context, &map, 1, &lines);
    if (lines.count != count) fail_msg("%u lines, not %u, of %s", lines.count, count, text);
    sl_axial_lines_destroy(context, &lines);
    sl_map_destroy(context, &map);
}

// --- subsets, one by one

typedef struct ranked {
    double length;
    uint32_t covers, line;
} ranked;

static int compare_ranks(const void *left, const void *right) {
    const ranked *a = left, *b = right;
    if (a->length != b->length) return a->length > b->length ? -1 : 1;
    if (a->covers != b->covers) return a->covers > b->covers ? -1 : 1;
    return (a->line > b->line) - (a->line < b->line);
}

static bool crosses(const sl_segment *line, const sl_segment *probe) {
    return sli_orient(probe->a, probe->b, line->a) * sli_orient(probe->a, probe->b, line->b) < 0 &&
           sli_touch(line, probe);
}

/// Whether every probe that one line crosses is crossed by the other.
static bool covers_all(const sl_axial_lines *all, const sl_segment *other, const sl_segment *line) {
    for (uint32_t k = 0; k < all->probe_count; k++)
        if (crosses(line, &all->probes[k]) && !crosses(other, &all->probes[k])) return false;
    return true;
}

/// The number of parts of some lines; parts[i]: of line i.
static uint32_t find_parts(const sl_axial_lines *all, const bool *kept, uint32_t *parts) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < all->count; i++) parts[i] = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        if (!kept[i] || parts[i]) continue;
        parts[i] = ++count;
        for (bool grew = true; grew;) {
            grew = false;
            for (uint32_t a = 0; a < all->count; a++)
                for (uint32_t b = 0; b < all->count && parts[a] == count; b++)
                    if (kept[b] && !parts[b] && sli_touch(&all->lines[a], &all->lines[b])) {
                        parts[b] = count;
                        grew = true;
                    }
        }
    }
    return count;
}

/// The lines that stay, by the two rules of the header and nothing else.
static void keep_by_rules(const sl_axial_lines *all, bool *kept) {
    ranked *order = calloc((size_t)all->count + 1, sizeof *order);
    uint32_t *parts = calloc((size_t)all->count + 1, sizeof *parts);
    assert_true(order && parts);
    for (uint32_t i = 0; i < all->count; i++) {
        const sl_segment *s = &all->lines[i];
        order[i] = (ranked){sli_length(s->b.x - s->a.x, s->b.y - s->a.y), 0, i};
        for (uint32_t k = 0; k < all->probe_count; k++)
            order[i].covers += crosses(s, &all->probes[k]);
    }
    qsort(order, all->count, sizeof *order, compare_ranks);
    for (uint32_t r = 0; r < all->count; r++) {
        const sl_segment *line = &all->lines[order[r].line];
        bool goes = false;
        for (uint32_t k = 0; k < r && !goes; k++) {
            const sl_segment *other = &all->lines[order[k].line];
            goes = kept[order[k].line] && sli_touch(line, other) && covers_all(all, other, line);
        }
        kept[order[r].line] = !goes;
    }
    for (uint32_t r = 0; r < all->count; r++) {
        const uint32_t line = order[r].line;
        uint32_t before = 0;
        if (kept[line] || find_parts(all, kept, parts) < 2) continue;
        for (uint32_t i = 0; i < all->count && !kept[line]; i++) {
            if (!parts[i] || !sli_touch(&all->lines[line], &all->lines[i])) continue;
            kept[line] = before && parts[i] != before;
            before = parts[i];
        }
    }
    free(order);
    free(parts);
}

static void subsets_are_those_of_the_rules(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    uint32_t gone = 0, stay = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(40); seed++) {
        sl_map map = {0};
        sl_axial_lines all = {0}, fewer = {0};
        assert_ok(context, oracle_random_map(context, seed, ORACLE_GRID_INTEGER, &map));
        for (size_t w = 0; w < map.wall_count && seed % 2; w++) { // turned by 17.3 degrees
            const double c = cos(17.3 * acos(-1) / 180), s = sin(17.3 * acos(-1) / 180);
            sl_point *ends[2] = {&map.walls[w].a, &map.walls[w].b};
            for (int e = 0; e < 2; e++)
                *ends[e] =
                    (sl_point){c * ends[e]->x - s * ends[e]->y, s * ends[e]->x + c * ends[e]->y};
        }
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        map.start_count = 0;
        find_lines(context, &map, 1, &all);
        find_lines(context, &map, 1, &fewer);
        assert_ok(context, sl_axial_fewest(context, &fewer, false));
        bool *kept = calloc((size_t)all.count + 1, sizeof *kept);
        assert_non_null(kept);
        keep_by_rules(&all, kept);
        uint32_t next = 0;
        for (uint32_t i = 0; i < all.count; i++) {
            gone += !kept[i];
            if (!kept[i]) continue;
            assert_true(next < fewer.count);
            assert_memory_equal(&fewer.lines[next++], &all.lines[i], sizeof all.lines[i]);
        }
        assert_int_equal(next, fewer.count);
        stay += next;
        free(kept);
        sl_axial_lines_destroy(context, &all);
        sl_axial_lines_destroy(context, &fewer);
        sl_map_destroy(context, &map);
    }
    assert_true(gone > 100 && stay > 100);
    sl_context_destroy(context);
}

/// A room has its walls and its two diagonals, however narrow it is.
static void narrow_rooms_have_lines(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    check_count(context, "sightline 1\nwalls 0 0 10 0 10 6 0 6 0 0\n", 6);
    check_count(context, "sightline 1\nwalls 0 0 10 0 10 1e-6 0 1e-6 0 0\n", 6);
    check_count(context, "sightline 1\nwalls 0 0 10 0 10 1e-150 0 1e-150 0 0\n", 6);
    check_count(context, "sightline 1\nwalls 0 0 10 1 10 1.000000000001 0 1e-12 0 0\n", 6);
    // Two rooms with a narrow gap between, which is outside: nothing is in the gap.
    check_count(context,
                "sightline 1\nwalls 0 0 10 0 10 6 0 6 0 0\n"
                "walls 0 7 10 7 10 13 0 13 0 7\n",
                12);
    check_count(context,
                "sightline 1\nwalls 0 0 10 0 10 6 0 6 0 0\n"
                "walls 0 6.0000001 10 6.0000001 10 13 0 13 0 6.0000001\n",
                12);
    sl_context_destroy(context);
}

/// Of three lines in a row each end has one line alone two steps away: Teklenburg's divisor is
/// log(1).
static void a_divisor_of_log_1_gives_no_value(void **state) {
    (void)state;
    static const sl_segment lines[] = {{{0, 0}, {4, 0}}, {{4, 0}, {4, 4}}, {{4, 4}, {8, 4}}};
    sl_context *context = testing_context(NULL);
    const sl_axial_options options = {0};
    sl_line_graph graph = {0};
    sl_axial_measures m[3];
    assert_ok(context, sl_line_graph_make(context, lines, 3, &graph));
    assert_ok(context, sl_axial_measure(context, lines, &graph, &options, m));
    for (size_t i = 0; i < 3; i++) {
        const double *values = (const double *)&m[i];
        for (size_t k = 0; k < sizeof m[i] / sizeof *values; k++) assert_false(isinf(values[k]));
        assert_true(isnan(m[i].integration_tekl));
        assert_int_equal(isnan(m[i].integration_hh), i == 1);
    }
    sl_line_graph_destroy(context, &graph);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turned_offices_have_turned_lines),
        cmocka_unit_test(turned_random_maps_have_turned_lines),
        cmocka_unit_test(subsets_are_those_of_the_rules),
        cmocka_unit_test(narrow_rooms_have_lines),
        cmocka_unit_test(a_divisor_of_log_1_gives_no_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
