/// What the tests of view cells share: a few maps with all that is made of them.
#ifndef VIEW_CELLS_MAPS_H
#define VIEW_CELLS_MAPS_H

#include "space/outline.h"
#include "testing.h"

#include "map/scan.h"
#include "sightline/view_cells.h"
#include "space/subdivide.h"

#include <math.h>

/// Two rooms with a door, a closet that no start leads to, and a pillar.
#define TWO_ROOMS                                                                                  \
    "walls 0 0 20 0 20 12 0 12 0 0\nwalls 10 0 10 5\nwalls 10 7 10 12\n"                           \
    "walls 14 8 16 8 16 10 14 10 14 8\nwalls 0 9 3 9 3 12\nstart 2 2 0\n"

/// The same with oblique walls, and open to the east.
#define OBLIQUE_ROOMS                                                                              \
    "walls 20 12 0 12 0 0 20 0\nwalls 10 0 9 5\nwalls 11 7 10 12\n"                                \
    "walls 14 8 16 9 15 11 14 8\nwalls 0 9 3 12\nstart 2 2 0\n"

/// The first turned by 17.3 degrees: what is in line there is so but for rounding.
#define TURNED_ROOMS                                                                               \
    "wall 0 0 19.095215990055948 5.94749748155572\n"                                               \
    "wall 19.095215990055948 5.94749748155572 15.526717501122516 17.404627075589289\n"             \
    "wall 15.526717501122516 17.404627075589289 -3.5684984889334324 11.457129594033569\n"          \
    "wall -3.5684984889334324 11.457129594033569 0 0\n"                                            \
    "wall 9.547607995027974 2.97374874077786 8.0607336246390435 7.747552738291847\n"               \
    "wall 7.4659838764834721 9.6570743372974412 5.9791095060945416 14.430878334811428\n"           \
    "wall 10.987652200416877 11.801334633111384 12.897173799422472 12.396084381266956\n"           \
    "wall 12.897173799422472 12.396084381266956 12.3024240512669 14.305605980272549\n"             \
    "wall 12.3024240512669 14.305605980272549 10.392902452261303 13.710856232116978\n"             \
    "wall 10.392902452261303 13.710856232116978 10.987652200416877 11.801334633111384\n"           \
    "wall -2.6763738667000743 8.5928471955251773 0.18790853180831801 9.4849718177585345\n"         \
    "wall 0.18790853180831801 9.4849718177585345 -0.70421609042504008 12.349254216266928\n"        \
    "start 1.3147718508500228 2.5042713471611671 0\n"

/// All of them; those after the first are oblique.
enum { ROOMS = 3 };
static inline const char *rooms_map(int number) {
    static const char *const maps[ROOMS] = {TWO_ROOMS, OBLIQUE_ROOMS, TURNED_ROOMS};
    return maps[number];
}

typedef struct view_world {
    sl_map map;
    sl_space space;
    sl_outline outline;
    sl_view_places places;
    sl_view_scene scene;
    sl_view_segments segments;
} view_world;

static inline void make_world(sl_context *context, const char *statements, bool oblique,
                              sl_view_objects objects, uint64_t samples, view_world *w) {
    *w = (view_world){0};
    char text[2048];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(context, sli_map_read_text(context, "test", text, strlen(text), &w->map));
    assert_ok(context, sl_map_clean(context, &w->map, NULL, NULL));
    const sl_subdivide_options kd = sl_subdivide_options_default();
    assert_ok(context, oblique ? sli_subdivide_mesh(context, &w->map, &w->space)
                               : sli_subdivide_kd(context, &w->map, &kd, &w->space));
    assert_ok(context, sli_outline_make(context, &w->space, &w->outline));
    assert_ok(context, sl_view_places_inside(context, &w->space, &w->places));
    w->scene = (sl_view_scene){&w->space, objects, sl_render_cost_default(), &w->places};
    sl_view_sampling sampling = sl_view_sampling_default();
    sampling.objects = objects;
    sampling.samples = samples;
    assert_ok(context, sl_view_sample(context, &w->outline, &sampling, &w->segments));
}

static inline void drop_world(sl_context *context, view_world *w) {
    sl_view_segments_destroy(context, &w->segments);
    sl_view_places_destroy(context, &w->places);
    sli_outline_destroy(context, &w->outline);
    sl_space_destroy(context, &w->space);
    sl_map_destroy(context, &w->map);
}

static inline const sl_view_method *view_method(const char *name) {
    size_t count;
    const sl_view_method *methods = sl_view_methods(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, name) == 0) return &methods[i];
    fail_msg("there is no method %s", name);
    return NULL;
}

static inline double cross_of(sl_point a, sl_point b, sl_point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// How much of a segment is inside a convex polygon, as a share; negative by as much as it misses.
static inline double share_inside(const sl_segment *s, const sl_point *corners, uint32_t count) {
    double t0 = 0, t1 = 1;
    for (uint32_t i = 0; i < count; i++) {
        const sl_point a = corners[i], b = corners[(i + 1) % count];
        const double from = cross_of(a, b, s->a), to = cross_of(a, b, s->b);
        if (from < 0 && to < 0) return fmax(from, to);
        if (from < 0) t0 = fmax(t0, from / (from - to));
        if (to < 0) t1 = fmin(t1, from / (from - to));
    }
    return t1 - t0;
}

static inline bool set_has(const sl_view_sets *sets, uint32_t row, uint32_t object) {
    return sets->bits[row * sets->words + object / 64] >> (object % 64) & 1;
}

#endif
