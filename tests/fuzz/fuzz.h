/// What the fuzzers share.
#ifndef SL_FUZZ_H
#define SL_FUZZ_H

#include "geometry/orient.h"
#include "map/scan.h"
#include "sightline/io.h"
#include "sightline/space.h"
#include "sightline/support.h"
#include "space/subdivide.h"
#include "unit/map_same.h"

#include <math.h>
#include <stdio.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/// Holds in every build: a finding is a program that ends here.
#define FUZZ_CHECK(condition)                                                                      \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

/// A number that some check may have forgotten.
static inline double odd_real(sl_random *random) {
    static const double reals[] = {0,      -0.0,  1,      -1,     1e150, 1.5e150, 3e150,
                                   -3e150, 1e200, 1e-150, 1e-300, NAN,   INFINITY};
    return reals[sl_random_below(random, sizeof reals / sizeof *reals)];
}

static inline uint32_t odd_count(sl_random *random) {
    static const uint32_t counts[] = {0, 1, 2, 3, 4, 0x7fffffff, 0x80000000, 0xffffffff};
    return counts[sl_random_below(random, sizeof counts / sizeof *counts)];
}

static inline sl_context *fuzz_context(void) {
    sl_context *context = sl_context_create(NULL);
    FUZZ_CHECK(context);
    return context;
}

/// A map written as text must read back as the same map. Gives that text, for free(). Text has
/// solid ground as polygons, so walls with marks may come in another order, and come back as the
/// same text.
static inline char *fuzz_round_trip(sl_context *context, const sl_map *map) {
    char *text = map_text(map);
    sl_map back = {0};
    FUZZ_CHECK(sli_map_read_text(context, "back", text, strlen(text), &back) == SL_OK);
    bool marked = false;
    for (size_t i = 0; i < map->wall_count; i++) marked |= map->walls[i].ground != 0;
    sl_map was = *map, is = back;
    if (marked) was.wall_count = is.wall_count = 0;
    FUZZ_CHECK(was.seam_count == is.seam_count);
    if (sl_map_partial_walls(map))
        was.seam_count = is.seam_count = 0; // these come by what they stop
    FUZZ_CHECK(map_same(&was, &is));
    char *again = map_text(&back);
    FUZZ_CHECK(same_text(text, again));
    free(again);
    sl_map_destroy(context, &back);
    return text;
}

/// What a reader refused: the status that bad input has, a message, and an empty map.
static inline void fuzz_refused(sl_context *context, sl_status status, const sl_map *map) {
    FUZZ_CHECK(status == SL_BAD_INPUT);
    FUZZ_CHECK(strncmp(sl_context_message(context), "input:", 6) == 0);
    FUZZ_CHECK(map_is_empty(map));
}

/// A map's own cells make a space that is in order, or are refused.
static inline void fuzz_cells(sl_context *context, const sl_map *map) {
    sl_space space = {0};
    const sl_status status = sli_subdivide_given(context, map, &space);
    if (status == SL_OK)
        FUZZ_CHECK(sl_space_check(context, &space) == SL_OK);
    else
        FUZZ_CHECK((status == SL_BAD_INPUT || status == SL_UNSUPPORTED) && !space.cells);
    sl_space_destroy(context, &space);
}

/// Whether a point is inside a cell, and not on its border.
static inline bool fuzz_is_inside(const sl_space *space, uint32_t number, sl_point point) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *corners = space->vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (sli_orient(corners[i], corners[(i + 1) % cell->vertex_count], point) <= 0) return false;
    return true;
}

/// A clean map makes spaces that are in order, or is refused for what it says of its ground. If it
/// is axial, the kd-tree and the mesh agree on what is solid.
static inline void fuzz_ground(sl_context *context, const sl_map *map) {
    sl_space kd = {0}, mesh = {0};
    if (!map->wall_count || map->wall_count > 200) return;
    const sl_status status = sli_subdivide_mesh(context, map, &mesh);
    FUZZ_CHECK(status == SL_OK || status == SL_BAD_INPUT);
    if (status == SL_OK) FUZZ_CHECK(sl_space_check(context, &mesh) == SL_OK);
    if (sl_map_is_axial(map)) {
        const sl_subdivide_options rules = sl_subdivide_options_default();
        FUZZ_CHECK(sli_subdivide_kd(context, map, &rules, &kd) == status);
        if (status == SL_OK) FUZZ_CHECK(sl_space_check(context, &kd) == SL_OK);
    }
    for (uint32_t i = 0; i < kd.cell_count && status == SL_OK; i++) {
        const sl_point a = kd.vertices[kd.cells[i].first_vertex];
        const sl_point b = kd.vertices[kd.cells[i].first_vertex + 2];
        const sl_point middle = {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
        const uint32_t cell = sl_space_locate(&mesh, middle);
        if (cell == SL_NO_CELL || !fuzz_is_inside(&kd, i, middle)) continue;
        if (fuzz_is_inside(&mesh, cell, middle))
            FUZZ_CHECK(mesh.cells[cell].solid == kd.cells[i].solid);
    }
    sl_space_destroy(context, &kd);
    sl_space_destroy(context, &mesh);
}

typedef sl_status fuzz_reader(sl_context *context, const char *name, const char *text, size_t size,
                              const sl_import_options *options, sl_map *map);

/// Reads a map: whatever is read is written as map text and read back the same. `argument` is what
/// the message names where the options do not fit the file; NULL where they always do.
static inline void fuzz_read(sl_context *context, const uint8_t *data, size_t size,
                             fuzz_reader *read, const sl_import_options *options,
                             const char *argument) {
    sl_map map = {0};
    const sl_status status = read(context, "input", (const char *)data, size, options, &map);
    if (status == SL_OK) {
        free(fuzz_round_trip(context, &map));
    } else if (argument && status == SL_BAD_ARGUMENT) {
        FUZZ_CHECK(strstr(sl_context_message(context), argument));
        FUZZ_CHECK(map_is_empty(&map));
    } else {
        fuzz_refused(context, status, &map);
    }
    sl_map_destroy(context, &map);
}

/// Reads Tiled, by what the file says itself, by layers and by starts asked for.
static inline void fuzz_tiled(const uint8_t *data, size_t size, fuzz_reader *read) {
    sl_context *context = fuzz_context();
    sl_import_options options = sl_import_options_default();
    const char *argument = NULL;
    if (size % 4 == 3) options.layers = "walls,Floor:1+3-9", argument = "layer";
    if (size % 4 == 2) options.start_names = "player", argument = "--start-names";
    options.doors = size % 2;
    fuzz_read(context, data, size, read, &options, argument);
    sl_context_destroy(context);
}

/// Reads a virtual table's map, with doors and without.
static inline void fuzz_tabletop(const uint8_t *data, size_t size, fuzz_reader *read) {
    sl_context *context = fuzz_context();
    sl_import_options options = sl_import_options_default();
    options.doors = size % 2;
    fuzz_read(context, data, size, read, &options, NULL);
    sl_context_destroy(context);
}

#endif
