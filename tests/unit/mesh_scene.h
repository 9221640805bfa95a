/// A map as read, clean, and its mesh: made and proven in one go.
#ifndef SL_MESH_SCENE_H
#define SL_MESH_SCENE_H

#include "testing.h"

#include "map/scan.h"
#include "oracle/apart.h"
#include "oracle/planar_graph.h"
#include "oracle/random_oblique.h"
#include "oracle/tiling.h"
#include "space/subdivide.h"

#include <math.h>

typedef struct scene {
    sl_context *context;
    char name[64]; ///< for messages
    sl_map read, map;
    sl_clean_account account;
    sl_space space;
} scene;

/// Proves what of a scene has been made: the clean walls are planar, the cells tile the bounds, and
/// the walls are those of the map.
static inline void scene_prove(const scene *s) {
    char why[ORACLE_WHY];
    const size_t count = s->map.wall_count;
    sl_segment *walls = calloc(count + 1, sizeof *walls);
    assert_non_null(walls);
    assert_int_equal(s->space.wall_count, count);
    for (size_t i = 0; i < count; i++) {
        const sl_wall *is = &s->space.walls[i], *was = &s->map.walls[i];
        walls[i] = (sl_segment){was->a, was->b};
        if (memcmp(is, was, sizeof *is) != 0) fail_msg("%s: wall %zu is another one", s->name, i);
    }
    if (!oracle_is_planar(walls, count, why)) fail_msg("%s: %s", s->name, why);
    free(walls);
    assert_ok(s->context, sl_space_check(s->context, &s->space));
    if (!oracle_is_tiling(&s->space, why)) fail_msg("%s: %s", s->name, why);
}

/// Cleans a map that has been read, which has at least one wall then, and makes its mesh.
static inline bool scene_make(scene *s, double weld) {
    const sl_clean_options options = {.weld = weld};
    assert_ok(s->context, sl_map_copy(s->context, &s->read, &s->map));
    assert_ok(s->context, sl_map_clean(s->context, &s->map, &options, &s->account));
    if (!s->map.wall_count) return false;
    assert_ok(s->context, sli_subdivide_mesh(s->context, &s->map, &s->space));
    return true;
}

static inline scene scene_of_text(const char *statements) {
    scene s = {.context = testing_context(NULL), .name = "text"};
    const size_t length = strlen(statements) + 32;
    char *text = malloc(length);
    assert_non_null(text);
    snprintf(text, length, "sightline 1\n%s", statements);
    assert_ok(s.context, sli_map_read_text(s.context, "test", text, strlen(text), &s.read));
    free(text);
    assert_true(scene_make(&s, sl_clean_options_default().weld));
    scene_prove(&s);
    return s;
}

static inline void scene_end(scene *s) {
    sl_space_destroy(s->context, &s->space);
    sl_map_destroy(s->context, &s->map);
    sl_map_destroy(s->context, &s->read);
    sl_context_destroy(s->context);
}

/// By a method's name, in any space.
static inline sl_visibility scene_see(const scene *s, const sl_space *space, const char *name,
                                      sl_sight sight) {
    const sl_see_method *method = testing_method(name);
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.solver = method->stabs ? sl_funnel() : NULL;
    options.threads = 1;
    sl_visibility seen = {0};
    assert_ok(s->context, method->see(s->context, space, &options, &seen));
    return seen;
}

static inline bool scene_sees(const scene *s, const sl_visibility *seen, sl_point p, sl_point q) {
    return sl_pvs_sees(&seen->pvs, sl_space_locate(&s->space, p), sl_space_locate(&s->space, q));
}

/// Whether a sightline is farther than what cleaning has moved from every wall as read.
static inline bool scene_is_free(const scene *s, sl_point p, sl_point q) {
    for (size_t i = 0; i < s->read.wall_count; i++) {
        const sl_segment wall = {s->read.walls[i].a, s->read.walls[i].b};
        if (!oracle_are_apart((sl_segment){p, q}, wall, s->account.largest_move)) return false;
    }
    return true;
}

#endif
