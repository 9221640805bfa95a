/// The runtime header against brute force in 128-bit floats: random eyes and targets in ten maps,
/// with doors open and shut, glass, boxes that block, walls that do not stop all, and one
/// reflection in mirrors. Steps go by the same lines.
///
/// A target is seen if the segment from the eye crosses no wall, no mirror, no shut door, no dark
/// glass and no box that blocks. All of these are asked, one by one, with numbers of 113 bits.
/// Random points are on no line through two ends of walls, so nothing is touched; where a number is
/// too small to have a sure sign, the test says so and fails.
///
///     test_runtime_brute           a few eyes
///     test_runtime_brute --all     1,000 eyes and 200 targets in each map
#include "unit/runtime_maps.h"

#ifndef __SIZEOF_FLOAT128__
int main(void) {
    puts("skipped: this compiler has no 128-bit floats");
    return 0;
}
#else

__extension__ typedef __float128 wide;

enum { TARGETS = 200, BOXES = 12, MOST_POINTS = 4096, MOST_PARTS = 512 };

static int eyes = 25;

typedef struct place {
    wide x, y;
} place;

typedef struct scene {
    sl_context *context;
    baked_file file;
    unsigned char *shut;
    uint32_t *scratch, *boxes_scratch, *cells;
    sl_runtime_box list[BOXES];
    sl_runtime_boxes boxes;
    uint32_t *memory;
    double *points, *past_boxes, *mirrored;
    sl_runtime_mirror_part parts[MOST_PARTS];
    uint32_t part_count;
    long asked, seen, seen_past, by_mirror, walked;
} scene;

// --- brute force

static int sign(wide number) {
    const wide sure = 1e-24; // of numbers up to 10^4: 113 bits leave 10^-30 of them
    if (number > sure) return 1;
    if (number < -sure) return -1;
    fail_msg("a sign is not sure: choose other random places");
    return 0;
}

/// On which side of the line from a to b a point is.
static int side(place a, place b, place p) {
    return sign((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x));
}

static place at(sl_point p) {
    return (place){p.x, p.y};
}

static bool crosses(sl_segment s, place p, place q) {
    const place a = at(s.a), b = at(s.b);
    return side(a, b, p) != side(a, b, q) && side(p, q, a) != side(p, q, b);
}

static bool is_in(const sl_runtime_box *box, place p) {
    return box->min_x < p.x && p.x < box->max_x && box->min_y < p.y && p.y < box->max_y;
}

/// Whether the segment passes the inside of a box, unless it never leaves it.
static bool is_hidden_by(const sl_runtime_box *box, place p, place q) {
    const sl_point corners[4] = {{box->min_x, box->min_y},
                                 {box->max_x, box->min_y},
                                 {box->max_x, box->max_y},
                                 {box->min_x, box->max_y}};
    if (!box->blocks || (is_in(box, p) && is_in(box, q))) return false;
    if (is_in(box, p) || is_in(box, q)) return true;
    for (int i = 0; i < 4; i++)
        if (crosses((sl_segment){corners[i], corners[(i + 1) % 4]}, p, q)) return true;
    return false;
}

/// Whether sight, or a step, passes the map's walls, mirrors, doors and glass.
static bool passes(const scene *s, uint32_t stops, place p, place q) {
    const sl_map *map = &s->file.baked.map;
    int limited = 0;
    for (size_t i = 0; i < map->wall_count; i++)
        if (crosses((sl_segment){map->walls[i].a, map->walls[i].b}, p, q)) return false;
    for (size_t i = 0; i < map->seam_count; i++)
        if (map->seams[i].stops & stops && crosses(map->seams[i].segment, p, q)) return false;
    for (size_t i = 0; i < map->seam_count && stops == SL_STOPS_SIGHT; i++)
        limited += map->seams[i].stops & SL_STOPS_LIMITED && crosses(map->seams[i].segment, p, q);
    if (limited > 1) return false;
    for (size_t i = 0; i < map->mirror_count; i++)
        if (crosses(map->mirrors[i].segment, p, q)) return false;
    for (size_t i = 0; i < map->door_count; i++)
        if (s->shut[i] && crosses(map->doors[i].segment, p, q)) return false;
    for (size_t i = 0; i < map->oneway_count; i++) {
        const sl_segment glass = map->oneways[i].segment;
        if (crosses(glass, p, q) &&
            (stops == SL_STOPS_STEPS || side(at(glass.a), at(glass.b), p) > 0))
            return false;
    }
    return true;
}

static bool passes_map(const scene *s, place p, place q) {
    return passes(s, SL_STOPS_SIGHT, p, q);
}

static bool passes_boxes(const scene *s, place p, place q) {
    for (int i = 0; i < BOXES; i++)
        if (is_hidden_by(&s->list[i], p, q)) return false;
    return true;
}

static bool stands_in_box(const scene *s, place p) {
    for (int i = 0; i < BOXES; i++)
        if (s->list[i].blocks && is_in(&s->list[i], p)) return true;
    return false;
}

/// Whether an eye sees a target in a mirror, with one reflection: the image of the eye sees it
/// through the mirror, and nothing hides the two parts of the line.
static bool passes_mirror(const scene *s, const sl_glass *mirror, place p, place q) {
    const place a = at(mirror->segment.a), b = at(mirror->segment.b);
    const wide x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
    const wide off = (x * (p.y - a.y) - y * (p.x - a.x)) / square;
    const place image = {p.x + 2 * y * off, p.y - 2 * x * off};
    if (side(a, b, p) != side(a, b, q) || (mirror->one_sided && side(a, b, p) < 0)) return false;
    if (side(image, q, a) == side(image, q, b)) return false;
    const wide from = x * (image.y - a.y) - y * (image.x - a.x);
    const wide to = x * (q.y - a.y) - y * (q.x - a.x), share = from / (from - to);
    const place hit = {image.x + share * (q.x - image.x), image.y + share * (q.y - image.y)};
    // The mirror itself, and a wall under it, do not count: up to a little before it.
    const wide little = 1e-13;
    const place from_eye = {hit.x + little * (p.x - hit.x), hit.y + little * (p.y - hit.y)};
    const place to_target = {hit.x + little * (q.x - hit.x), hit.y + little * (q.y - hit.y)};
    return passes_map(s, p, from_eye) && passes_map(s, to_target, q);
}

/// Whether a point is in a polygon, by the edges that a ray to its right crosses; -1 where it is
/// nearer to an edge than corners are rounded.
static int is_in_polygon(const double *points, uint32_t count, place q) {
    bool inside = false;
    for (uint32_t i = 0, k = count - 1; i < count; k = i++) {
        const wide ax = (wide)points[2 * k] - q.x, ay = (wide)points[2 * k + 1] - q.y;
        const wide bx = (wide)points[2 * i] - q.x, by = (wide)points[2 * i + 1] - q.y;
        const wide turn = ax * by - ay * bx, length = (bx - ax) * (bx - ax) + (by - ay) * (by - ay);
        if (turn * turn <= 1e-18 * length) return -1;
        if ((ay > 0) != (by > 0) && (turn > 0) == (by > ay)) inside = !inside;
    }
    return inside;
}

// --- the questions

/// A random place, of doubles.
static place random_place(sl_random *random, const sl_runtime *rt) {
    const double x = rt->min_x + (rt->max_x - rt->min_x) * sl_random_unit(random);
    const double y = rt->min_y + (rt->max_y - rt->min_y) * sl_random_unit(random);
    return (place){x, y};
}

static void move_boxes(scene *s, sl_random *random) {
    const sl_runtime *rt = &s->file.runtime;
    const double size = (rt->max_x - rt->min_x) / 12;
    for (uint32_t i = 0; i < BOXES; i++) {
        const place corner = random_place(random, rt);
        const double x = (double)corner.x, y = (double)corner.y;
        const sl_runtime_box box = {x, y, x + size * sl_random_unit(random),
                                    y + size * sl_random_unit(random), i % 4 != 0};
        assert_true(sl_runtime_boxes_move(&s->boxes, i, &box));
    }
}

static bool lists(const uint32_t *cells, uint32_t count, uint32_t cell) {
    for (uint32_t i = 0; i < count; i++)
        if (cells[i] == cell) return true;
    return false;
}

/// What an eye is asked for once.
typedef struct answer {
    double x, y;
    uint32_t cells, points, past_boxes;
} answer;

static answer ask_eye(scene *s, place eye) {
    const sl_runtime *rt = &s->file.runtime;
    answer a = {.x = (double)eye.x, .y = (double)eye.y};
    const sl_runtime_view view = sl_runtime_view_all_round(a.x, a.y);
    a.cells = sl_runtime_look_past(rt, &view, s->shut, 0, s->scratch, s->cells, rt->cell_count);
    a.points =
        sl_runtime_visible_polygon(rt, &view, s->shut, 0, s->scratch, s->points, MOST_POINTS);
    a.past_boxes = sl_runtime_visible_polygon_past_boxes(
        &s->boxes, &view, s->shut, 0, s->boxes_scratch, s->past_boxes, MOST_POINTS);
    const uint32_t all =
        sl_runtime_visible_polygon_mirrored(rt, &view, s->shut, 0, 1, s->scratch, s->parts,
                                            MOST_PARTS, &s->part_count, s->mirrored, MOST_POINTS);
    assert_true(a.points > 2 && a.points <= MOST_POINTS && a.past_boxes <= MOST_POINTS);
    assert_true(all <= MOST_POINTS && s->part_count <= MOST_PARTS);
    return a;
}

/// Whether a target is in what a mirror shows, or what is seen directly (UINT32_MAX); -1 for near
/// the border.
static int shows(const scene *s, uint32_t mirror, place q) {
    int found = 0;
    for (uint32_t i = 0; i < s->part_count; i++) {
        const sl_runtime_mirror_part *part = &s->parts[i];
        if (part->depth == 0 ? mirror != UINT32_MAX : part->mirror != mirror) continue;
        const int in = is_in_polygon(s->mirrored + 2 * (size_t)part->first, part->count, q);
        if (in < 0) return -1;
        found |= in;
    }
    return found;
}

static void ask_mirrors(scene *s, const answer *a, place eye, place q) {
    const sl_map *map = &s->file.baked.map;
    for (uint32_t i = 0; i < map->mirror_count; i++) {
        const bool truth = passes_mirror(s, &map->mirrors[i], eye, q);
        const int found = shows(s, i, q);
        s->by_mirror += truth;
        if (found >= 0 && found != truth)
            fail_msg("%s: from %.17g %.17g to %.17g %.17g by mirror %u: brute force %d, polygon %d",
                     s->file.name, a->x, a->y, (double)q.x, (double)q.y, (unsigned)i, truth, found);
    }
}

/// A step from a place that is not in a box: other boxes stop it, and where it ends.
static void ask_steps(scene *s, place p, place q) {
    const double x0 = (double)p.x, y0 = (double)p.y, x1 = (double)q.x, y1 = (double)q.y;
    const bool truth = passes(s, SL_STOPS_STEPS, p, q);
    const bool past =
        truth && passes_boxes(s, p, q) && !stands_in_box(s, p) && !stands_in_box(s, q);
    const bool walks = sl_runtime_can_walk(&s->file.runtime, x0, y0, x1, y1, s->shut);
    const bool walks_past =
        sl_runtime_can_walk_past_boxes(&s->boxes, x0, y0, x1, y1, s->shut, SL_RUNTIME_NO_BOX);
    s->walked += truth;
    if (walks != truth || walks_past != past)
        fail_msg(
            "%s: a step from %.17g %.17g to %.17g %.17g: brute force %d, %d past boxes; %d, %d",
            s->file.name, x0, y0, x1, y1, truth, past, walks, walks_past);
}

static void ask(scene *s, sl_random *random, place eye) {
    const sl_runtime *rt = &s->file.runtime;
    const answer a = ask_eye(s, eye);
    for (int i = 0; i < TARGETS; i++) {
        const place q = random_place(random, rt);
        const double x = (double)q.x, y = (double)q.y;
        const bool truth = passes_map(s, eye, q), past = truth && passes_boxes(s, eye, q);
        const bool sees = sl_runtime_sees(rt, a.x, a.y, x, y, s->shut, 0, s->scratch);
        const bool sees_past =
            sl_runtime_sees_past_boxes(&s->boxes, a.x, a.y, x, y, s->shut, 0, s->boxes_scratch);
        const int inside = is_in_polygon(s->points, a.points, q);
        const int direct = shows(s, UINT32_MAX, q);
        const int inside_past = is_in_polygon(s->past_boxes, a.past_boxes, q);
        s->asked++;
        s->seen += truth;
        s->seen_past += past;
        if (sees != truth || sees_past != past || (inside >= 0 && inside != truth) ||
            (direct >= 0 && direct != truth) || (inside_past >= 0 && inside_past != past))
            fail_msg(
                "%s: from %.17g %.17g to %.17g %.17g: brute force %d, sees %d, polygon %d, %d; "
                "past boxes %d, sees %d, polygon %d",
                s->file.name, a.x, a.y, x, y, truth, sees, inside, direct, past, sees_past,
                inside_past);
        ask_mirrors(s, &a, eye, q);
        ask_steps(s, eye, q);
        if (!truth) continue;
        assert_true(lists(s->cells, a.cells, sl_runtime_locate(rt, x, y)));
        assert_true(sl_runtime_sees_within(rt, a.x, a.y, 0.01, x, y, 0.01, s->shut, 0, s->scratch));
    }
}

// --- the maps

static void start(scene *s) {
    const sl_runtime *rt = &s->file.runtime;
    const uint32_t pairs = 64 * BOXES;
    s->shut = calloc(rt->door_count + 1, 1);
    s->scratch = malloc(sl_runtime_scratch_count(rt) * sizeof *s->scratch);
    s->cells = malloc(rt->cell_count * sizeof *s->cells);
    s->points = malloc(2 * MOST_POINTS * sizeof *s->points);
    s->past_boxes = malloc(2 * MOST_POINTS * sizeof *s->past_boxes);
    s->mirrored = malloc(2 * MOST_POINTS * sizeof *s->mirrored);
    s->memory = malloc(sl_runtime_boxes_count(rt, BOXES, pairs) * sizeof *s->memory);
    sl_runtime_boxes_start(&s->boxes, rt, s->list, BOXES, pairs, s->memory);
    s->boxes_scratch = malloc(sl_runtime_boxes_scratch_count(&s->boxes) * sizeof(uint32_t));
}

static void stop(scene *s) {
    free(s->shut);
    free(s->scratch);
    free(s->cells);
    free(s->points);
    free(s->past_boxes);
    free(s->mirrored);
    free(s->memory);
    free(s->boxes_scratch);
    baked_file_destroy(s->context, &s->file);
    sl_context_destroy(s->context);
}

static void ask_map(const char *name, double degrees) {
    scene s = {.context = testing_context(NULL)};
    char path[1024];
    snprintf(path, sizeof path, "%s/maps/%s.map", SIGHTLINE_SOURCE_DIR, name);
    s.file = degrees != 0 ? baked_file_turned(s.context, name, degrees, 0)
                          : baked_file_of(s.context, path);
    start(&s);
    sl_random random = {11};
    for (int done = 0; done < eyes;) {
        const place eye = random_place(&random, &s.file.runtime);
        const uint32_t cell = sl_runtime_locate(&s.file.runtime, (double)eye.x, (double)eye.y);
        if (sl_runtime_is_solid(&s.file.runtime, cell)) continue;
        for (uint32_t i = 0; i < s.file.runtime.door_count; i++)
            s.shut[i] = sl_random_below(&random, 2);
        move_boxes(&s, &random);
        ask(&s, &random, eye);
        done++;
    }
    print_message(
        "%s, turned by %g: %ld questions, %ld seen, %ld past boxes, %ld by mirrors, %ld steps\n",
        name, degrees, s.asked, s.seen, s.seen_past, s.by_mirror, s.walked);
    assert_true(s.seen > s.asked / 500);
    stop(&s);
}

static void brute_force_agrees(void **state) {
    (void)state;
    ask_map("office", 0);
    ask_map("effects/doors", 0);
    ask_map("effects/mirrors", 0);
    ask_map("effects/oneway", 0);
    ask_map("effects/stops", 0);
    ask_map("effects/limited", 0);
    ask_map("oblique/chapel", 0);
    ask_map("office", 17.3);
    ask_map("effects/stops", 17.3);
    ask_map("effects/limited", 17.3);
    ask_map("gallery", 17.3);
    ask_map("courtyard", 17.3);
}

/// The four cases of lib/runtime/closed-sight.svg, which random points do not meet.
static void ends_of_walls(void **state) {
    static const struct {
        const char *walls;
        bool seen;
    } cases[] = {{"wall 4 0 4 2\n", true},
                 {"wall 4 0 4 2\nwall 6 2 6 4\n", true},
                 {"wall 3 2 5 2\n", true},
                 {"wall 4 0 4 2\nwall 4 2 4 4\n", false}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[128];
        snprintf(text, sizeof text, "walls 0 0 8 0 8 4 0 4 0 0\n%s", cases[i].walls);
        scene s = {.context = testing_context(NULL)};
        s.file = baked_file_of_text(s.context, text);
        start(&s);
        assert_int_equal(sl_runtime_sees(&s.file.runtime, 1, 2, 7, 2, NULL, 0, s.scratch),
                         cases[i].seen);
        stop(&s);
    }
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(brute_force_agrees),
                                       cmocka_unit_test(ends_of_walls)};
    if (argc == 2 && strcmp(argv[1], "--all") == 0) eyes = 1000;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#endif
