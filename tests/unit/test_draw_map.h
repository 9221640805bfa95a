/// What the tests of pictures share: a small map with visible sets made by hand.
///
/// Three corridors of 40 x 10, one over the other, none open to the next; a stub of wall cuts each
/// of the lower two into a left and a right cell. Starts make these inside; the third is outside.
#ifndef SL_TEST_DRAW_MAP_H
#define SL_TEST_DRAW_MAP_H

#include "testing.h"

#include "cell_to_cell/pvs_rows.h"
#include "sightline/draw.h"
#include "space/subdivide.h"

#include <dirent.h>
#include <unistd.h>

enum { LEFT_BELOW, RIGHT_BELOW, LEFT_MIDDLE, RIGHT_MIDDLE, OUTSIDE };

typedef struct draw_map {
    sl_baked baked;
    uint32_t cells[6]; ///< by the names above, or by a test's own
} draw_map;

/// The map moved and stretched: place (x, y) stands at (x0 + x * x_scale, y0 + y * y_scale).
typedef struct draw_place {
    double x0, y0, x_scale, y_scale;
} draw_place;

static inline sl_point draw_at(draw_place place, double x, double y) {
    return (sl_point){place.x0 + x * place.x_scale, place.y0 + y * place.y_scale};
}

static inline void draw_add_walls(sl_context *context, sl_map *map, draw_place place) {
    static const double walls[][4] = {
        {0, 0, 40, 0},   {40, 0, 40, 30}, {0, 30, 40, 30}, {0, 0, 0, 30},
        {0, 10, 40, 10}, {0, 20, 40, 20}, {20, 0, 20, 4},  {20, 10, 20, 14},
    };
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++)
        assert_ok(context, sl_map_add_wall(context, map, draw_at(place, walls[i][0], walls[i][1]),
                                           draw_at(place, walls[i][2], walls[i][3]), 0));
    assert_ok(context, sl_map_add_start(context, map, draw_at(place, 5, 5), 90, 0));
    assert_ok(context, sl_map_add_start(context, map, draw_at(place, 30, 15), 0, 0));
}

/// Cells below see each other, those in the middle only themselves, the one outside nothing.
static inline void draw_add_sets(sl_context *context, draw_map *map) {
    const uint32_t count = map->baked.space.cell_count;
    sli_row_bytes rows[5] = {0};
    assert_int_equal(count, 5);
    for (uint32_t i = LEFT_BELOW; i < OUTSIDE; i++) {
        sl_bits set[1] = {0};
        sl_bits_add(set, map->cells[i]);
        if (i <= RIGHT_BELOW) sl_bits_add(set, map->cells[RIGHT_BELOW - i]);
        assert_ok(context, sli_row_append(context, &rows[map->cells[i]], set, count));
    }
    assert_ok(context, sli_pvs_join(context, rows, count, &map->baked.visibility.pvs));
}

/// One stab tree of two nodes, from the left cell below through its portal to the right one.
static inline void draw_add_tree(sl_context *context, draw_map *map) {
    sl_space *space = &map->baked.space;
    const uint32_t source = map->cells[LEFT_BELOW];
    assert_int_equal(space->cells[source].directed_count, 1);
    sl_stab_trees trees = {.cell_count = space->cell_count};
    trees.offsets = sl_alloc_array(context, space->cell_count + 1, sizeof *trees.offsets);
    trees.nodes = sl_alloc_array(context, 2, sizeof *trees.nodes);
    assert_true(trees.offsets && trees.nodes);
    for (uint32_t i = source + 1; i <= space->cell_count; i++) trees.offsets[i] = 2;
    trees.nodes[0] = (sl_stab_node){0, source, UINT32_MAX};
    trees.nodes[1] =
        (sl_stab_node){0, map->cells[RIGHT_BELOW], space->cells[source].first_directed};
    map->baked.visibility.trees = trees;
}

static inline draw_map draw_map_make(sl_context *context, draw_place place) {
    draw_map map = {.baked = {.method = "made", .solver = "hand"}};
    sl_baked *baked = &map.baked;
    draw_add_walls(context, &baked->map, place);
    assert_ok(context, sl_map_clean(context, &baked->map, NULL, NULL));
    const sl_subdivide_options options = sl_subdivide_options_default();
    assert_ok(context, sli_subdivide_kd(context, &baked->map, &options, &baked->space));
    static const double middles[5][2] = {{10, 5}, {30, 5}, {10, 15}, {30, 15}, {20, 25}};
    for (int i = 0; i < 5; i++)
        map.cells[i] = sl_space_locate(&baked->space, draw_at(place, middles[i][0], middles[i][1]));
    draw_add_sets(context, &map);
    draw_add_tree(context, &map);
    return map;
}

#define DRAW_PLAIN ((draw_place){0, 0, 1, 1})

/// A directory of the test's own; its name is written into `directory`.
static inline void draw_directory(char directory[32]) {
    snprintf(directory, 32, "/tmp/sightline-draw-XXXXXX");
    assert_non_null(mkdtemp(directory));
}

/// What a test works with: a map, and a directory of its own for pictures.
typedef struct draw_bench {
    sl_context *context;
    draw_map map;
    char directory[32], path[64];
} draw_bench;

/// One with no map yet; NULL without memory.
static inline draw_bench *draw_bench_make(void) {
    draw_bench *b = calloc(1, sizeof *b);
    if (!b) return NULL;
    b->context = testing_context(NULL);
    draw_directory(b->directory);
    return b;
}

/// Fails where a test left a file.
static inline int draw_bench_end(void **state) {
    draw_bench *b = *state;
    const int left = rmdir(b->directory);
    sl_baked_destroy(b->context, &b->map.baked);
    sl_context_destroy(b->context);
    free(b);
    return left;
}

/// A file in its directory; good until the next call.
static inline const char *draw_path(draw_bench *b, const char *name) {
    snprintf(b->path, sizeof b->path, "%s/%s", b->directory, name);
    return b->path;
}

static inline int draw_files_in(const char *folder) {
    DIR *stream = opendir(folder);
    assert_non_null(stream);
    int count = -2; // . and ..
    while (readdir(stream)) count++;
    closedir(stream);
    return count;
}

/// fontconfig keeps what it has loaded behind offsets, where a leak checker does not find it.
__attribute__((visibility("default"))) const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
    return "leak:libfontconfig\n";
}

#endif
