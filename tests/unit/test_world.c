/// Worlds against spaces that are made anew: after random edits of random maps, what points see and
/// what regions they have is the same, and the mesh passes the check of the whole graph.
/// SIGHTLINE_SEEDS in the environment: how many maps (30 by default), SIGHTLINE_EDITS: how many
/// commits each (40). The long run, 10^5 commits over 100 maps, takes some minutes:
///     SIGHTLINE_SEEDS=100 SIGHTLINE_EDITS=1000 test_world
#include "mirror_rays.h"
#include "polygon_same.h"
#include "space/subdivide.h"
#include "testing.h"

#include "sightline/effects.h"

#include <math.h>

enum { FRAME = 4, SIZE = 12, QUESTIONS = 12, WALLS_MOST = 60, MIRROR_LINE = 1000000 };

/// How the places of a map are chosen.
typedef enum shape { SHAPE_GRID, SHAPE_OBLIQUE, SHAPE_TURNED, SHAPE_FREE, SHAPE_FAR, SHAPES } shape;

typedef struct trial {
    sl_context *context;
    uint64_t seed;
    shape shape;
    sl_world_rows rows;
    sl_random random;
    sl_world *world;
    sl_map map;     ///< of the world, now
    sl_space fresh; ///< made anew from it
    sl_query *query;
    sl_map raw; ///< with its doors, where these bend no walls; else without any
    sl_space raw_space;
    sl_query *raw_query;
    sl_region here, there;
    bool effects; ///< doors, one-way glass, mirrors, walls that do not stop sight
    sl_segment frame[FRAME];
    uint64_t refused; ///< edits
} trial;

static uint64_t below(trial *t, uint64_t bound) {
    return sl_random_below(&t->random, bound);
}

static sl_point placed(const trial *t, double x, double y) {
    const double c = 0.9547608, s = 0.2973748; // 17.3 degrees, nearly
    if (t->shape == SHAPE_TURNED) return (sl_point){c * x - s * y, s * x + c * y};
    if (t->shape == SHAPE_FAR) return (sl_point){1e9 + x / 1024, -3e9 + y / 1024};
    return (sl_point){x, y};
}

/// A place within the frame, mostly on a grid.
static sl_point random_place(trial *t) {
    if (t->shape == SHAPE_FREE)
        return placed(t, 1 + (SIZE - 2) * sl_random_unit(&t->random),
                      1 + (SIZE - 2) * sl_random_unit(&t->random));
    return placed(t, 1 + (double)below(t, SIZE - 1), 1 + (double)below(t, SIZE - 1));
}

static sl_segment random_wall(trial *t) {
    for (;;) {
        sl_segment at = {random_place(t), random_place(t)};
        if (t->shape == SHAPE_GRID || t->shape == SHAPE_TURNED || t->shape == SHAPE_FAR) {
            const double x = 1 + (double)below(t, SIZE - 1), y = 1 + (double)below(t, SIZE - 1);
            const double to = 1 + (double)below(t, SIZE - 1);
            at.a = placed(t, x, y);
            at.b = below(t, 2) ? placed(t, to, y) : placed(t, x, to);
        }
        if (below(t, 3)) { // mostly short
            const sl_point d = {at.b.x - at.a.x, at.b.y - at.a.y};
            if (t->shape == SHAPE_FREE) at.b = (sl_point){at.a.x + d.x / 5, at.a.y + d.y / 5};
        }
        if (!testing_same_point(at.a, at.b)) return at;
    }
}

static void start(trial *t) {
    sl_map map = {0};
    for (int i = 0; i < FRAME; i++) {
        const sl_point corner[5] = {placed(t, 0, 0), placed(t, SIZE, 0), placed(t, SIZE, SIZE),
                                    placed(t, 0, SIZE), placed(t, 0, 0)};
        t->frame[i] = (sl_segment){corner[i], corner[i + 1]};
        assert_ok(t->context, sl_map_add_wall(t->context, &map, corner[i], corner[i + 1], 0));
    }
    for (uint64_t i = below(t, 20); i--;) {
        const sl_segment at = random_wall(t);
        assert_ok(t->context, sl_map_add_wall(t->context, &map, at.a, at.b, 0));
    }
    sl_world_options options = sl_world_options_default();
    options.rows = t->rows;
    assert_ok(t->context, sl_world_create(t->context, &map, &options, &t->world));
    sl_map_destroy(t->context, &map);
}

// --- edits

static uint32_t count_walls(const trial *t) {
    uint32_t count = 0;
    sl_segment at;
    for (uint32_t i = 0; i < sl_world_wall_count(t->world); i++)
        count += sl_world_wall(t->world, i, &at);
    return count;
}

/// A wall that stands and is none of the frame; false where there is none.
static bool random_number(trial *t, uint32_t *wall) {
    sl_segment at;
    const uint32_t count = sl_world_wall_count(t->world);
    for (int tries = 0; tries < 50 && count > FRAME; tries++) {
        *wall = FRAME + (uint32_t)below(t, count - FRAME);
        if (sl_world_wall(t->world, *wall, &at)) return true;
    }
    return false;
}

/// Adds a wall of any kind.
static void add(trial *t) {
    static const uint32_t stops[] = {0,
                                     SL_STOPS_STEPS | SL_STOPS_LIMITED,
                                     SL_STOPS_SIGHT,
                                     SL_STOPS_ALL,
                                     SL_STOPS_LIMITED,
                                     SL_STOPS_LIMITED};
    const sl_segment at = random_wall(t);
    uint32_t wall;
    switch (t->effects ? below(t, 7) : 6) {
    case 0:
    case 1:
        assert_ok(t->context,
                  sl_world_add_door(t->context, t->world, "door", at, below(t, 2) == 0, &wall));
        break;
    case 2:
        assert_ok(t->context, sl_world_add_oneway(t->context, t->world, at, &wall));
        break;
    case 3:
        assert_ok(t->context,
                  sl_world_add_partial(t->context, t->world, at, stops[below(t, 6)], &wall));
        break;
    case 4:
        assert_ok(t->context, sl_world_add_mirror(t->context, t->world, at,
                                                  t->shape == SHAPE_GRID && below(t, 2), &wall));
        break;
    default:
        assert_ok(t->context, sl_world_add_wall(t->context, t->world, at, &wall));
    }
}

/// Opens or shuts a door.
static void toggle(trial *t) {
    uint32_t wall;
    if (!random_number(t, &wall)) return;
    const bool door = sl_world_kind_of(t->world, wall) == SL_WORLD_DOOR;
    const bool open = !sl_world_is_open(t->world, wall);
    const sl_status status = sl_world_set_open(t->context, t->world, wall, open);
    if (!door) assert_int_equal(status, SL_BAD_ARGUMENT);
}

static void edit(trial *t) {
    const bool full = count_walls(t) > WALLS_MOST;
    for (uint64_t i = 1 + (below(t, 4) ? 0 : below(t, 4)); i--;) {
        uint32_t wall;
        const uint64_t what = below(t, 5);
        if (what < 2 && !full) {
            add(t);
        } else if (t->effects && below(t, 2)) {
            toggle(t);
        } else if (random_number(t, &wall)) {
            // One that is removed twice is refused, and no more than that.
            const sl_status status =
                what < 4 ? sl_world_remove(t->context, t->world, wall)
                         : sl_world_move(t->context, t->world, wall, random_wall(t));
            if (status != SL_OK) assert_int_equal(status, SL_BAD_ARGUMENT);
        }
    }
    // What is refused leaves the world as it was.
    const sl_status status = sl_world_commit(t->context, t->world, NULL);
    if (status != SL_UNSUPPORTED) assert_ok(t->context, status);
    t->refused += status != SL_OK;
}

// --- the comparison

static void forget(trial *t) {
    sl_query_destroy(t->context, t->query);
    sl_space_destroy(t->context, &t->fresh);
    sl_map_destroy(t->context, &t->map);
    sl_query_destroy(t->context, t->raw_query);
    sl_space_destroy(t->context, &t->raw_space);
    sl_map_destroy(t->context, &t->raw);
    t->query = t->raw_query = NULL;
}

/// Mirrors are walls, the first ones of the map, so that their pieces have their lines.
static void add_walls_of_mirrors(trial *t) {
    sl_map *map = &t->map;
    for (uint32_t i = 0; i < map->mirror_count; i++) {
        const sl_segment at = map->mirrors[i].segment;
        assert_ok(t->context, sl_map_add_wall(t->context, map, at.a, at.b, MIRROR_LINE + i));
        const sl_wall last = map->walls[map->wall_count - 1];
        map->walls[map->wall_count - 1] = map->walls[i];
        map->walls[i] = last;
    }
}

/// Makes walls of those that stop sight. Of the others those that limit it stay.
static void settle_stops(trial *t) {
    sl_map *map = &t->map, all = {0};
    assert_ok(t->context, sl_map_copy(t->context, map, &all));
    assert_ok(t->context, sl_map_settle_stops(t->context, map, NULL));
    for (size_t i = 0; i < all.seam_count; i++) {
        if (!(all.seams[i].stops & SL_STOPS_LIMITED)) continue;
        assert_ok(t->context, sl_map_add_seam(t->context, map, all.seams[i].segment, 0));
        map->seams[map->seam_count - 1].stops = SL_STOPS_LIMITED;
    }
    sl_map_destroy(t->context, &all);
}

/// Drops the seams that do not limit sight.
static void keep_limited(sl_map *map) {
    size_t kept = 0;
    for (size_t i = 0; i < map->seam_count; i++)
        if (map->seams[i].stops & SL_STOPS_LIMITED) map->seams[kept++] = map->seams[i];
    map->seam_count = kept;
}

/// Puts mirrors on the pieces that their walls have become.
static void bend_mirrors(trial *t) {
    t->map.mirror_count = 0;
    for (uint32_t i = 0; i < t->fresh.wall_count; i++) {
        const sl_wall *w = &t->fresh.walls[i];
        if (w->line < MIRROR_LINE) continue;
        assert_ok(t->context,
                  sl_map_add_mirror(t->context, &t->map, (sl_segment){w->a, w->b}, w->line));
    }
}

static void refresh(trial *t) {
    forget(t);
    assert_ok(t->context, sl_world_copy_map(t->context, t->world, NULL, &t->map));
    settle_stops(t);
    add_walls_of_mirrors(t);
    // What is not there for sight bends oblique walls that cross it, where a mesh is made of it.
    if (t->map.door_count && (t->shape == SHAPE_GRID || t->shape == SHAPE_FAR)) {
        assert_ok(t->context, sl_map_copy(t->context, &t->map, &t->raw));
        assert_ok(t->context, sli_subdivide_mesh(t->context, &t->raw, &t->raw_space));
        assert_ok(t->context,
                  sl_query_over(t->context, &t->raw_space, &t->raw, NULL, &t->raw_query));
    }
    assert_ok(t->context, sl_effects_settle_doors(t->context, &t->map));
    keep_limited(&t->map);
    assert_ok(t->context, sli_subdivide_mesh(t->context, &t->map, &t->fresh));
    if (t->shape != SHAPE_GRID) bend_mirrors(t);
    assert_ok(t->context, sl_query_over(t->context, &t->fresh, &t->map, NULL, &t->query));
}

static void check_mesh(trial *t) {
    sl_space space = {0};
    assert_ok(t->context, sl_world_copy_space(t->context, t->world, NULL, &space));
    assert_ok(t->context, sl_space_check(t->context, &space));
    assert_int_equal(space.cell_count, sl_world_cell_count(t->world));
    if (space.wall_count != t->fresh.wall_count)
        fail_msg("seed %llu: %u pieces of walls, made anew %u", (unsigned long long)t->seed,
                 space.wall_count, t->fresh.wall_count);
    sl_space_destroy(t->context, &space);
}

/// A place that is on no line through two corners.
static sl_point free_point(trial *t) {
    return placed(t, 0.1 + (SIZE - 0.2) * sl_random_unit(&t->random),
                  0.1 + (SIZE - 0.2) * sl_random_unit(&t->random));
}

static sl_point random_point(trial *t) {
    return below(t, 3) == 0 ? random_place(t) : free_point(t);
}

static bool is_on(sl_segment w, sl_point eye) {
    return sl_orient(w.a, w.b, eye) == 0 && eye.x >= fmin(w.a.x, w.b.x) &&
           eye.x <= fmax(w.a.x, w.b.x) && eye.y >= fmin(w.a.y, w.b.y) &&
           eye.y <= fmax(w.a.y, w.b.y);
}

static bool has_corner(const trial *t, sl_point eye) {
    for (uint32_t i = 0; i < t->fresh.wall_count; i++)
        if (testing_same_point(eye, t->fresh.walls[i].a) ||
            testing_same_point(eye, t->fresh.walls[i].b))
            return true;
    return false;
}

/// Whether what an eye sees depends on the numbers of cells: it is within a wall, or where two meet
/// (view.h), or on glass or a door.
static bool has_sides(const trial *t, sl_point eye) {
    uint32_t ends = 0;
    for (size_t i = 0; i < t->raw.door_count; i++)
        if (is_on(t->raw.doors[i].segment, eye)) return true;
    for (uint32_t i = 0; i < t->fresh.seam_count; i++)
        if (is_on(t->fresh.seams[i].at, eye)) return true;
    for (uint32_t i = 0; i < t->fresh.wall_count; i++) {
        const sl_wall *w = &t->fresh.walls[i];
        if (!is_on((sl_segment){w->a, w->b}, eye)) continue;
        if (!testing_same_point(eye, w->a) && !testing_same_point(eye, w->b)) return true;
        ends++;
    }
    return ends > 1;
}

static sl_point random_eye(trial *t) {
    sl_point eye;
    do eye = random_point(t);
    while (has_sides(t, eye));
    return eye;
}

static void compare_sees(trial *t, sl_point eye, sl_point point) {
    bool here, there;
    assert_ok(t->context, sl_query_sees(t->context, sl_world_query(t->world), eye, point, &here));
    assert_ok(t->context, sl_query_sees(t->context, t->query, eye, point, &there));
    if (here != there)
        fail_msg("seed %llu: %.17g %.17g sees %.17g %.17g: %d, made anew %d",
                 (unsigned long long)t->seed, eye.x, eye.y, point.x, point.y, here, there);
    if (!t->raw_query) return;
    assert_ok(t->context, sl_query_sees(t->context, t->raw_query, eye, point, &there));
    if (here != there)
        fail_msg("seed %llu: %.17g %.17g sees %.17g %.17g: %d, with doors %d",
                 (unsigned long long)t->seed, eye.x, eye.y, point.x, point.y, here, there);
}

/// The corners of a region, those that repeat the one before left out.
static size_t corners_of(const sl_region *region, size_t *out) {
    size_t count = 0;
    for (size_t i = 0; i < region->count; i++) {
        const sl_point next = region->points[i + 1 < region->count ? i + 1 : 0];
        if (!testing_same_point(region->points[i], next)) out[count++] = i;
    }
    return count;
}

static bool is_same_corner(const trial *t, size_t here, size_t there) {
    const double error = polygon_error(&t->fresh.bounds);
    const sl_point a = t->here.points[here], b = t->there.points[there];
    return fabs(a.x - b.x) <= error && fabs(a.y - b.y) <= error &&
           t->here.edges[here].kind == t->there.edges[there].kind;
}

/// A limited wall that rounding has bent is one seam in a world, and one for each piece where it is
/// made anew. So corners in line differ, and spikes without width between such walls.
static bool have_same_area(const trial *t) {
    return fabs(sl_region_area(&t->here) - sl_region_area(&t->there)) <=
           8 * SIZE * polygon_error(&t->fresh.bounds);
}

static void compare_regions(trial *t, sl_point eye) {
    const sl_view view = sl_view_all_round(eye);
    assert_ok(t->context, sl_query_region(t->context, sl_world_query(t->world), &view, &t->here));
    assert_ok(t->context, sl_query_region(t->context, t->query, &view, &t->there));
    size_t *here = calloc(t->here.count + t->there.count + 1, sizeof *here);
    assert_non_null(here);
    size_t *there = here + t->here.count;
    const size_t count = corners_of(&t->here, here), other = corners_of(&t->there, there);
    bool same = count == other && !count;
    // They may start at different corners.
    for (size_t first = 0; first < other && count == other && !same; first++) {
        same = true;
        for (size_t i = 0; i < count && same; i++)
            same = is_same_corner(t, here[i], there[(first + i) % count]);
    }
    free(here);
    if (!same && t->map.seam_count) same = have_same_area(t);
    if (!same)
        fail_msg("seed %llu: the region of %.17g %.17g has %zu corners, made anew %zu",
                 (unsigned long long)t->seed, eye.x, eye.y, t->here.count, t->there.count);
}

/// Whether a point is in a cell and not on its border.
static bool is_within(const sl_space *space, uint32_t number, sl_point at) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *corners = space->vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (sl_orient(corners[i], corners[(i + 1) % cell->vertex_count], at) <= 0) return false;
    return true;
}

/// The cells that an eye sees, as places: the middle of each cell seen in one space lies in a cell
/// that is seen in the other, if the eye sees the place. (A sightline that grazes walls on both
/// sides leads to no cell, so the eye is where there is none.)
static void compare_looks(trial *t, sl_point eye) {
    sl_query *one = sl_world_query(t->world);
    const sl_space *space = sl_query_asked(one);
    const sl_view view = sl_view_all_round(eye);
    uint64_t *cells = calloc(sl_eye_words(space) + 1, sizeof *cells);
    assert_non_null(cells);
    assert_ok(t->context, sl_query_look(t->context, one, &view, NULL, cells, NULL));
    for (uint32_t c = 0; c < t->fresh.cell_count; c++) {
        const sl_point at = sl_space_middle(&t->fresh, c);
        const uint32_t cell = sl_query_locate(one, at);
        bool sees;
        assert_int_not_equal(cell, SL_NO_CELL);
        assert_ok(t->context, sl_query_sees(t->context, t->query, eye, at, &sees));
        if (sees && is_within(space, cell, at) && !sl_eye_sees(cells, cell))
            fail_msg("seed %llu: cell %u is not seen", (unsigned long long)t->seed, cell);
    }
    free(cells);
}

/// The visible sets against those of the default method, over the same cells. `exact`: they must be
/// the same, else they must not miss any.
static void compare_rows(trial *t, bool exact) {
    const sl_visibility *kept = sl_world_visibility(t->world);
    const uint32_t count = sl_query_asked(sl_world_query(t->world))->cell_count;
    sl_see_options options = sl_see_options_default();
    const sl_plan plan = {.effects = SL_EFFECT_ONEWAY};
    options.threads = 1;
    if (t->map.oneway_count || t->map.seam_count) options.plan = &plan;
    uint32_t *numbers = calloc(count, sizeof *numbers);
    sl_space space = {0};
    sl_visibility seen = {0};
    assert_non_null(numbers);
    assert_ok(t->context, sl_world_copy_space(t->context, t->world, numbers, &space));
    assert_ok(t->context, testing_method("sweep")->see(t->context, &space, &options, &seen));
    assert_int_equal(kept->pvs.cell_count, count);
    for (uint32_t a = 0; a < count; a++)
        for (uint32_t b = 0; b < count && numbers[a] != SL_NO_CELL; b++) {
            if (numbers[b] == SL_NO_CELL) continue;
            const bool there = sl_pvs_sees(&seen.pvs, numbers[a], numbers[b]);
            const bool here = sl_pvs_sees(&kept->pvs, a, b);
            if (exact ? here != there : there && !here)
                fail_msg("seed %llu: cell %u sees cell %u: %d, made anew %d",
                         (unsigned long long)t->seed, a, b, here, there);
        }
    sl_visibility_destroy(t->context, &seen);
    sl_space_destroy(t->context, &space);
    free(numbers);
}

/// Visible sets as the world has them, and after settling step by step.
static void settle(trial *t) {
    size_t left = 1;
    if (t->rows == SL_WORLD_NO_ROWS) return;
    // A commit that lacked memory for them alone has left none.
    if (!sl_world_visibility(t->world)->pvs.cell_count)
        while (left) assert_ok(t->context, sl_world_settle(t->context, t->world, 1, &left));
    left = 1;
    // Sets take limited walls as open.
    const sl_guarantee best = t->map.seam_count ? SL_CONSERVATIVE : SL_EXACT;
    const bool exact =
        t->rows == SL_WORLD_ROWS_NOW || sl_world_visibility(t->world)->guarantee == SL_EXACT;
    if (exact) assert_int_equal(sl_world_visibility(t->world)->guarantee, best);
    compare_rows(t, exact);
    if (exact || below(t, 2)) return;
    while (left) assert_ok(t->context, sl_world_settle(t->context, t->world, 0, &left));
    assert_int_equal(sl_world_visibility(t->world)->guarantee, best);
    compare_rows(t, true);
}

/// An eye on the outline looks inwards, once cells are marked.
static void compare_on_outline(trial *t) {
    const bool far = t->shape == SHAPE_FAR; // there, places are too coarse
    const double x = far ? 1 + (double)below(t, SIZE - 1) : SIZE * sl_random_unit(&t->random);
    const sl_point eye = placed(t, x, 0);
    assert_ok(t->context, sl_world_mark_inside(t->context, t->world));
    if (has_corner(t, eye)) return;
    // Turned places are rounded: some are beyond the wall.
    const sl_query *query = sl_world_query(t->world);
    const sl_cell *cell = &sl_query_asked(query)->cells[sl_query_locate(query, eye)];
    if (cell->inside || t->shape != SHAPE_TURNED) compare_regions(t, eye);
}

/// Whether a point is at the eye's side of a mirror.
static bool is_before(const sl_segment *mirror, sl_point eye, sl_point at) {
    return sl_orient(mirror->a, mirror->b, eye) == sl_orient(mirror->a, mirror->b, at);
}

/// How much is seen by mirror, whether places are, and that a look by mirror has their cells.
static void compare_mirrored(trial *t, sl_point eye) {
    const sl_view view = sl_view_all_round(eye);
    sl_query *query = sl_world_query(t->world);
    sl_mirrored_region here = {0}, there = {0};
    if (t->map.seam_count) { // by mirror, limited walls do not count
        assert_int_equal(sl_query_mirrored_region(t->context, query, &view, &here),
                         t->map.mirror_count ? SL_UNSUPPORTED : SL_OK);
        sl_mirrored_region_destroy(t->context, &here);
        return;
    }
    assert_ok(t->context, sl_query_mirrored_region(t->context, query, &view, &here));
    assert_ok(t->context, sl_query_mirrored_region(t->context, t->query, &view, &there));
    const double one = sl_mirrored_area(&here), other = sl_mirrored_area(&there);
    if (fabs(one - other) > 1e-9 * SIZE * SIZE)
        fail_msg("seed %llu: %.17g %.17g sees %.17g by mirror, made anew %.17g",
                 (unsigned long long)t->seed, eye.x, eye.y, one, other);
    uint64_t *cells = calloc(sl_eye_words(sl_query_asked(query)) + 1, sizeof *cells);
    assert_non_null(cells);
    assert_ok(t->context, sl_query_look_mirrored(t->context, query, &view, NULL, cells, NULL));
    for (int k = 0; k < QUESTIONS && there.part_count; k++) {
        const sl_point at = free_point(t);
        bool shown = false;
        for (size_t i = 0; i < there.part_count && !shown; i++)
            shown = mirror_rays_holds(&there.parts[i].region, at) &&
                    is_before(&t->map.mirrors[there.parts[i].mirror].segment, eye, at);
        if (shown && !sl_eye_sees(cells, sl_query_locate(query, at)))
            fail_msg("seed %llu: the cell of %.17g %.17g is not seen by mirror",
                     (unsigned long long)t->seed, at.x, at.y);
    }
    free(cells);
    sl_mirrored_region_destroy(t->context, &here);
    sl_mirrored_region_destroy(t->context, &there);
}

static void compare(trial *t) {
    refresh(t);
    check_mesh(t);
    if (below(t, 4) == 0) settle(t);
    for (int i = 0; i < QUESTIONS; i++) {
        const sl_point eye = random_eye(t);
        compare_regions(t, eye);
        for (int k = 0; k < 4; k++) compare_sees(t, eye, random_point(t));
    }
    if (below(t, 4) == 0) compare_on_outline(t);
    if (t->shape == SHAPE_FAR) return; // there, places are too coarse
    compare_looks(t, free_point(t));
    if (t->effects) compare_mirrored(t, free_point(t));
}

static void end(trial *t) {
    forget(t);
    sl_region_destroy(t->context, &t->here);
    sl_region_destroy(t->context, &t->there);
    sl_world_destroy(t->context, t->world);
    sl_context_destroy(t->context);
}

static uint64_t edits(void) {
    const char *text = getenv("SIGHTLINE_EDITS");
    const uint64_t told = text ? strtoull(text, NULL, 10) : 0;
    return told ? told : 40;
}

static void test_random_edits(void **state) {
    (void)state;
    testing_memory memory = {0};
    for (uint64_t seed = 0; seed < testing_seeds(30); seed++) {
        trial t = {.context = testing_context(&memory),
                   .seed = seed,
                   .shape = (shape)(seed % SHAPES),
                   .rows = (sl_world_rows)(seed / SHAPES % 3),
                   .effects = seed / SHAPES / 3 % 2,
                   .random = {seed}};
        start(&t);
        compare(&t);
        for (uint64_t i = 0; i < edits(); i++) {
            edit(&t);
            compare(&t);
        }
        assert_true(t.refused <= edits() / 50);
        end(&t);
        assert_int_equal(memory.live, 0);
    }
}

/// New glass counts in rows that are taken from a copy: where many walls stand freely, searches
/// cost more than that.
static void test_glass_in_rows_of_a_copy(void **state) {
    (void)state;
    testing_memory memory = {0};
    for (uint64_t seed = 0; seed < 3; seed++) {
        trial t = {.context = testing_context(&memory),
                   .seed = seed,
                   .shape = SHAPE_FREE,
                   .rows = SL_WORLD_ROWS_NOW,
                   .random = {seed}};
        uint32_t wall;
        start(&t);
        for (int i = 0; i < 40; i++) {
            const sl_point from = random_point(&t);
            const sl_segment at = {from, {from.x + 0.1, from.y + sl_random_unit(&t.random) / 10}};
            assert_ok(t.context, sl_world_add_wall(t.context, t.world, at, &wall));
        }
        assert_ok(t.context, sl_world_commit(t.context, t.world, NULL));
        for (int i = 0; i < 5; i++) {
            const sl_segment at = {placed(&t, 1 + 2 * i, 1), placed(&t, 2 + 2 * i, SIZE - 1)};
            assert_ok(t.context, sl_world_add_oneway(t.context, t.world, at, &wall));
            assert_ok(t.context, sl_world_commit(t.context, t.world, NULL));
            refresh(&t);
            compare_rows(&t, true);
        }
        end(&t);
        assert_int_equal(memory.live, 0);
    }
}

// --- by hand

/// Two walls that nearly are one cross at a place that is rounded. A third one that ends there
/// crosses one of them beside it.
static void test_wall_ends_where_rounding_bent_others(void **state) {
    (void)state;
    trial t = {.context = testing_context(NULL), .shape = SHAPE_TURNED};
    const sl_segment third = {{5.1338151999999999, 3.6937704}, {5.43119, 2.7390095999999997}};
    const sl_segment walls[] = {
        {{7.3407115999999997, 3.3337591999999998}, {3.5216683999999998, 2.1442600000000001}},
        {{2.5669076, 1.8468852}, {8.2954723999999995, 3.6311339999999999}},
        {{5.43119, 2.7390095999999997}, {5.7285648000000002, 1.7842488000000001}}};
    sl_map map = {0};
    sl_world_options options = sl_world_options_default();
    uint32_t wall;
    options.bounds = (sl_box){{0, 0}, {9, 9}};
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++)
        assert_ok(t.context, sl_map_add_wall(t.context, &map, walls[i].a, walls[i].b, 0));
    assert_ok(t.context, sl_world_create(t.context, &map, &options, &t.world));
    assert_ok(t.context, sl_world_add_wall(t.context, t.world, third, &wall));
    assert_ok(t.context, sl_world_commit(t.context, t.world, NULL));
    refresh(&t);
    check_mesh(&t);
    assert_ok(t.context, sl_world_remove(t.context, t.world, 2));
    assert_ok(t.context, sl_world_commit(t.context, t.world, NULL));
    refresh(&t);
    check_mesh(&t);
    sl_map_destroy(t.context, &map);
    end(&t);
}

// --- memory

/// Edits that run out of memory at every call in turn leave the world as it was.
static void test_memory_may_fail_at_any_call(void **state) {
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        testing_memory memory = {0};
        trial t = {.context = testing_context(&memory),
                   .shape = (shape)i,
                   .rows = (sl_world_rows)(i % 3),
                   .effects = i % 2 == 0,
                   .random = {77 + (uint64_t)i}};
        start(&t);
        uint64_t failed = 0;
        for (long call = 1; call < 160; call++) {
            uint32_t wall;
            const uint32_t walls = count_walls(&t);
            const sl_segment at = random_wall(&t);
            assert_ok(t.context, sl_world_add_wall(t.context, t.world, at, &wall));
            if (random_number(&t, &wall))
                assert_ok(t.context, sl_world_remove(t.context, t.world, wall));
            memory.fail_at = memory.calls + 1 + call % 23;
            const sl_status status = sl_world_commit(t.context, t.world, NULL);
            memory.fail_at = 0;
            if (status != SL_OK) assert_int_equal(status, SL_NO_MEMORY);
            if (status != SL_OK) assert_int_equal(count_walls(&t), walls);
            failed += status != SL_OK;
            if (call % 8 == 0) compare(&t);
            if (call % 3 == 0) edit(&t);
        }
        assert_true(failed > 20);
        end(&t);
        assert_int_equal(memory.live, 0);
    }
}

/// An allocator that counts bytes.
static void *counting_resize(void *user, void *block, size_t bytes) {
    size_t *total = user;
    size_t *old = block ? (size_t *)block - 2 : NULL;
    if (old) *total -= *old;
    if (!bytes) {
        free(old);
        return NULL;
    }
    size_t *fresh = realloc(old, bytes + 2 * sizeof *fresh);
    assert_non_null(fresh);
    *fresh = bytes;
    *total += bytes;
    return fresh + 2;
}

static void edit_often(trial *t, int count) {
    for (int i = 0; i < count; i++) edit(t);
}

static void test_memory_stays(void **state) {
    (void)state;
    size_t bytes = 0;
    const sl_hooks hooks = {.user = &bytes, .resize = counting_resize};
    trial t = {.context = sl_context_create(&hooks),
               .shape = SHAPE_GRID,
               .rows = SL_WORLD_ROWS_NOW,
               .effects = true,
               .random = {5}};
    assert_non_null(t.context);
    start(&t);
    edit_often(&t, 1000);
    const size_t before = bytes;
    edit_often(&t, 5000);
    assert_true(bytes < before + before / 2);
    compare(&t);
    end(&t);
    assert_int_equal(bytes, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_wall_ends_where_rounding_bent_others),
        cmocka_unit_test(test_random_edits),
        cmocka_unit_test(test_glass_in_rows_of_a_copy),
        cmocka_unit_test(test_memory_may_fail_at_any_call),
        cmocka_unit_test(test_memory_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
