// The runtime's lines of sight and steps past boxes, against brute force in integers and against
// the library's query. Maps have doors and glass, and are axial, or turned by an angle that leaves
// coordinates integers. Boxes touch walls, doors, corners, the points and each other.
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime_maps.h"

#include "oracle/random_effects.h"

#include "sightline/bake.h"

enum {
    MAPS = 40,
    BOXES = 12,
    DOORS = 3,
    STATES = 4,
    LINES = 400,
    ROOM = 4096,
    GRID = 12,
    CELLS_MOST = 512
};

typedef struct trial {
    sl_context *context;
    sl_random random;
    bool turned;
    baked_file file;
    sl_query *query;
    unsigned char shut[DOORS];
    sl_moving_box boxes[BOXES];
    sl_runtime_box list[BOXES];
    sl_runtime_boxes placed;
    uint32_t *memory, *scratch;
    size_t sees[2], steps[2], hidden, stopped, same, wide[2], moves[3];
} trial;

// --- brute force: the part of a line that is in a box, from one number to another

/// A fraction with a denominator above 0.
typedef struct fraction {
    int64_t over, under;
} fraction;

static fraction fraction_of(double over, double under) {
    const int64_t a = (int64_t)over, b = (int64_t)under;
    return b < 0 ? (fraction){-a, -b} : (fraction){a, b};
}

static int compare(fraction a, fraction b) {
    const int64_t left = a.over * b.under, right = b.over * a.under;
    return (left > right) - (left < right);
}

/// Narrows a part of the way from p to q to where it is from `low` to `high`. False for none, also
/// not an end if `strictly`.
static bool narrow(double p, double q, double low, double high, bool strictly, fraction part[2]) {
    if (p == q) return strictly ? low < p && p < high : low <= p && p <= high;
    const fraction at[2] = {fraction_of(low - p, q - p), fraction_of(high - p, q - p)};
    const fraction from = at[q < p], to = at[q > p];
    if (compare(from, part[0]) > 0) part[0] = from;
    if (compare(to, part[1]) < 0) part[1] = to;
    return true;
}

static bool touches_box(sl_point p, sl_point q, sl_box b) {
    fraction part[2] = {{0, 1}, {1, 1}};
    return narrow(p.x, q.x, b.min.x, b.max.x, false, part) &&
           narrow(p.y, q.y, b.min.y, b.max.y, false, part) && compare(part[0], part[1]) <= 0;
}

/// Whether a line crosses an upright box without width.
static bool crosses_flat(sl_point p, sl_point q, sl_box b) {
    const double wide = q.x - p.x, at = wide * p.y + (q.y - p.y) * (b.min.x - p.x);
    const double low = fmin(wide * b.min.y, wide * b.max.y),
                 high = fmax(wide * b.min.y, wide * b.max.y);
    return fmin(p.x, q.x) < b.min.x && b.min.x < fmax(p.x, q.x) && low < at && at < high;
}

static bool crosses_box(sl_point p, sl_point q, sl_box b) {
    fraction part[2] = {{0, 1}, {1, 1}};
    if (b.min.x == b.max.x) return crosses_flat(p, q, b);
    if (b.min.y == b.max.y)
        return crosses_flat((sl_point){p.y, p.x}, (sl_point){q.y, q.x},
                            (sl_box){{b.min.y, b.min.x}, {b.max.y, b.max.x}});
    return narrow(p.x, q.x, b.min.x, b.max.x, true, part) &&
           narrow(p.y, q.y, b.min.y, b.max.y, true, part) && compare(part[0], part[1]) < 0;
}

/// 1 for a point in a box, 0 on its border, -1 outside.
static int place(sl_point p, sl_box b) {
    if (p.x < b.min.x || p.x > b.max.x || p.y < b.min.y || p.y > b.max.y) return -1;
    return b.min.x < p.x && p.x < b.max.x && b.min.y < p.y && p.y < b.max.y;
}

static bool is_hidden_by(sl_point p, sl_point q, sl_box b) {
    return crosses_box(p, q, b) && (place(p, b) < 1 || place(q, b) < 0) &&
           (place(q, b) < 1 || place(p, b) < 0);
}

// --- maps and boxes

static double below(trial *t, uint64_t bound) {
    return (double)sl_random_below(&t->random, bound);
}

static sl_point turn(const trial *t, sl_point p) {
    return t->turned ? (sl_point){4 * p.x - 3 * p.y, 3 * p.x + 4 * p.y} : p;
}

static void turn_segment(const trial *t, sl_segment *s) {
    *s = (sl_segment){turn(t, s->a), turn(t, s->b)};
}

static void start(trial *t) {
    sl_map map = {0};
    const sl_bake_options options = sl_bake_options_default();
    random_effects_map(t->context, &t->random, SL_EFFECT_DOOR | SL_EFFECT_ONEWAY, GRID, &map);
    for (size_t i = 0; i < map.wall_count; i++) {
        map.walls[i].a = turn(t, map.walls[i].a);
        map.walls[i].b = turn(t, map.walls[i].b);
    }
    for (size_t i = 0; i < map.door_count; i++) {
        turn_segment(t, &map.doors[i].segment);
        for (size_t k = 0; k < map.doors[i].part_count; k++)
            turn_segment(t, &map.doors[i].parts[k]);
    }
    for (size_t i = 0; i < map.oneway_count; i++) turn_segment(t, &map.oneways[i].segment);
    t->file = (baked_file){.name = "random"};
    assert_ok(t->context, sl_bake(t->context, &map, &options, &t->file.baked, NULL));
    t->file.bytes = baked_bytes(t->context, &t->file.baked, &t->file.size);
    baked_file_open(&t->file);
    const sl_runtime *r = &t->file.runtime;
    assert_ok(t->context, sl_query_create(t->context, &t->file.baked, &t->query));
    t->memory = malloc(sl_runtime_boxes_count(r, BOXES, ROOM) * sizeof *t->memory);
    assert_non_null(t->memory);
    sl_runtime_boxes_start(&t->placed, r, t->list, BOXES, ROOM, t->memory);
    t->scratch = malloc(sl_runtime_boxes_scratch_count(&t->placed) * sizeof *t->scratch);
    assert_non_null(t->scratch);
}

static void finish(trial *t) {
    sl_query_destroy(t->context, t->query);
    baked_file_destroy(t->context, &t->file);
    free(t->memory);
    free(t->scratch);
}

/// Anywhere, or on the lines of the map's grid.
static sl_point some_place(trial *t) {
    const double size = RANDOM_EFFECTS_SIZE * GRID, step = below(t, 2) != 0 ? GRID : GRID / 4;
    const sl_point grid = {step * below(t, (uint64_t)(size / step) + 1),
                           step * below(t, (uint64_t)(size / step) + 1)};
    if (below(t, 2) != 0) return turn(t, grid);
    const sl_runtime *r = &t->file.runtime;
    return (sl_point){r->min_x + below(t, (uint64_t)(r->max_x - r->min_x) + 1),
                      r->min_y + below(t, (uint64_t)(r->max_y - r->min_y) + 1)};
}

/// A corner of a box, a place on a side of one, or any other.
static sl_point some_point(trial *t) {
    const sl_box b = t->boxes[sl_random_below(&t->random, BOXES)].box;
    const sl_point at = {floor(b.min.x + below(t, 5) / 4 * (b.max.x - b.min.x)),
                         floor(b.min.y + below(t, 5) / 4 * (b.max.y - b.min.y))};
    return below(t, 3) != 0 ? some_place(t) : at;
}

static void set_state(trial *t) {
    for (uint32_t i = 0; i < t->file.runtime.door_count; i++) {
        t->shut[i] = (unsigned char)sl_random_below(&t->random, 2);
        sl_query_set_door_at(t->context, t->query, i, !t->shut[i]);
    }
    for (uint32_t i = 0; i < BOXES; i++) {
        const sl_point p = some_place(t);
        const double most = t->turned ? 60 : 30;
        const sl_box b = {p, {p.x + below(t, 4) / 3 * most, p.y + floor(below(t, 4) / 3 * most)}};
        t->boxes[i] = (sl_moving_box){b, sl_random_below(&t->random, 2)};
        const sl_runtime_box to = {b.min.x, b.min.y, b.max.x, b.max.y, t->boxes[i].blocks};
        assert_true(sl_runtime_boxes_move(&t->placed, i, &to));
    }
    assert_ok(t->context, sl_query_set_boxes(t->context, t->query, t->boxes, BOXES));
}

// --- one line

static void complain(const trial *t, sl_point p, sl_point q, const char *what) {
    for (int i = 0; i < BOXES; i++) {
        const sl_box b = t->boxes[i].box;
        if (t->boxes[i].blocks)
            print_message("box %d: %g,%g %g,%g\n", i, b.min.x, b.min.y, b.max.x, b.max.y);
    }
    fail_msg("%s%g,%g to %g,%g: %s", t->turned ? "turned, " : "", p.x, p.y, q.x, q.y, what);
}

static void try_sight(trial *t, sl_point p, sl_point q) {
    const sl_runtime *r = &t->file.runtime;
    const double range = sl_random_below(&t->random, 4) ? 0 : 1 + below(t, 100);
    const bool past_walls = sl_runtime_sees(r, p.x, p.y, q.x, q.y, t->shut, range, t->scratch);
    const bool sees =
        sl_runtime_sees_past_boxes(&t->placed, p.x, p.y, q.x, q.y, t->shut, range, t->scratch);
    bool is_hidden = false, is_touched = false, by_query;
    for (int i = 0; i < BOXES; i++) {
        const sl_box b = t->boxes[i].box;
        if (!t->boxes[i].blocks) continue;
        is_hidden |= is_hidden_by(p, q, b);
        is_touched |=
            touches_box(p, q, b) && (!is_hidden_by(p, q, b) || !place(p, b) || !place(q, b));
    }
    if (sees != (past_walls && !is_hidden)) complain(t, p, q, sees ? "added" : "missed");
    t->sees[sees]++;
    t->hidden += past_walls && is_hidden;
    if (range > 0 || is_touched) return;
    assert_ok(t->context, sl_query_sees(t->context, t->query, p, q, &by_query));
    if (by_query != sees) complain(t, p, q, "not as the query says");
    t->same++;
}

/// Whether a box reaches inside the bounds. One that only touches them from outside is in no cell.
static bool is_there(const trial *t, sl_box b) {
    const sl_runtime *r = &t->file.runtime;
    return b.min.x < r->max_x && b.max.x > r->min_x && b.min.y < r->max_y && b.max.y > r->min_y;
}

static void try_step(trial *t, sl_point p, sl_point q) {
    const sl_runtime *r = &t->file.runtime;
    const uint32_t except = (uint32_t)sl_random_below(&t->random, BOXES + 1);
    const bool past_walls = sl_runtime_can_walk(r, p.x, p.y, q.x, q.y, t->shut);
    const bool walks =
        sl_runtime_can_walk_past_boxes(&t->placed, p.x, p.y, q.x, q.y, t->shut, except);
    bool is_stopped = false;
    for (uint32_t i = 0; i < BOXES; i++)
        is_stopped |= t->boxes[i].blocks && i != except && is_there(t, t->boxes[i].box) &&
                      touches_box(p, q, t->boxes[i].box);
    if (walks != (past_walls && !is_stopped)) complain(t, p, q, walks ? "a step added" : "no step");
    if (walks != sl_runtime_can_walk_past_boxes(&t->placed, q.x, q.y, p.x, p.y, t->shut, except))
        complain(t, p, q, "a step one way");
    t->steps[walks]++;
    t->stopped += past_walls && is_stopped;
}

static void past_boxes(void **state) {
    (void)state;
    static trial t;
    t = (trial){.context = testing_context(NULL)};
    for (uint64_t seed = 1; seed <= testing_seeds(MAPS); seed++) {
        t.random = (sl_random){seed};
        t.turned = seed % 2 == 0;
        start(&t);
        for (int i = 0; i < STATES * LINES; i++) {
            if (i % LINES == 0) set_state(&t);
            const sl_point p = some_point(&t), q = some_point(&t);
            try_sight(&t, p, q);
            try_step(&t, p, q);
            try_step(&t, p, (sl_point){p.x + below(&t, 9) - 4, p.y + below(&t, 9) - 4});
        }
        finish(&t);
    }
    print_message(
        "%zu of %zu seen, %zu hidden, %zu asked of the query; %zu of %zu steps, %zu stopped\n",
        t.sees[1], t.sees[0] + t.sees[1], t.hidden, t.same, t.steps[1], t.steps[0] + t.steps[1],
        t.stopped);
    assert_true(t.sees[1] > 500 && t.hidden > 500 && t.same > 500);
    assert_true(t.steps[1] > 500 && t.stopped > 500);
    sl_context_destroy(t.context);
}

/// Where no walls are, one may walk along the border of the map. All walls and boxes are asked
/// there.
static void along_the_border(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(
        context, "wall 0 5 4 5\nwall 10 2 10 3\nwall 5 0 6 0\nwall 2 10 3 10\nwall 8 2 8 3\n");
    const sl_runtime *r = &f.runtime;
    const sl_runtime_box box = {8.5, -1, 9, 1, true};
    sl_runtime_box list[1];
    sl_runtime_boxes boxes;
    uint32_t memory[256];
    assert_true(sl_runtime_boxes_count(r, 1, 8) <= 256);
    sl_runtime_boxes_start(&boxes, r, list, 1, 8, memory);
    assert_true(sl_runtime_locate(r, 7, 0) != sl_runtime_locate(r, 9, 0));
    assert_true(sl_runtime_can_walk_past_boxes(&boxes, 7, 0, 9.5, 0, NULL, SL_RUNTIME_NO_BOX));
    assert_true(sl_runtime_boxes_move(&boxes, 0, &box));
    assert_true(sl_runtime_can_walk(r, 7, 0, 9.5, 0, NULL));
    assert_false(sl_runtime_can_walk_past_boxes(&boxes, 7, 0, 9.5, 0, NULL, SL_RUNTIME_NO_BOX));
    assert_true(sl_runtime_can_walk_past_boxes(&boxes, 7, 0, 9.5, 0, NULL, 0));
    assert_true(sl_runtime_can_walk_past_boxes(&boxes, 7, 0, 8, 0, NULL, SL_RUNTIME_NO_BOX));
    assert_false(sl_runtime_can_walk(r, 7, 0, 6, 0, NULL));
    assert_false(sl_runtime_can_walk(r, 7, 0, 10.5, 0, NULL));
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

// --- discs, against the distances to all walls

/// What stops a disc: walls, glass, shut doors, the sides of boxes, the border.
typedef struct obstacles {
    sl_segment at[512];
    size_t count;
    double size; ///< the sum that margins are shares of, without the radius
} obstacles;

static void add_sides(obstacles *o, sl_box b) {
    const sl_point c[5] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}, b.min};
    for (int i = 0; i < 4; i++) o->at[o->count++] = (sl_segment){c[i], c[i + 1]};
}

static void find_obstacles(const baked_file *f, const unsigned char *shut, obstacles *o) {
    const sl_space *s = &f->baked.space;
    const sl_box b = s->bounds;
    o->count = 0;
    o->size = fmax(fabs(b.min.x), fabs(b.max.x)) + fmax(fabs(b.min.y), fabs(b.max.y));
    assert_true(s->wall_count + s->seam_count + 4 * BOXES + 4 < 512);
    for (uint32_t i = 0; i < s->wall_count; i++)
        o->at[o->count++] = (sl_segment){s->walls[i].a, s->walls[i].b};
    for (uint32_t i = 0; i < s->seam_count; i++) {
        const sl_seam *seam = &s->seams[i];
        if (seam->kind == SL_SEAM_ONEWAY || (seam->kind == SL_SEAM_DOOR && shut[seam->number]))
            o->at[o->count++] = seam->at;
    }
    add_sides(o, b);
}

static long double from_point(sl_point p, sl_segment s) {
    const long double x = (long double)s.b.x - s.a.x, y = (long double)s.b.y - s.a.y;
    const long double px = (long double)p.x - s.a.x, py = (long double)p.y - s.a.y;
    const long double square = x * x + y * y;
    const long double at = square > 0 ? fminl(fmaxl((px * x + py * y) / square, 0), 1) : 0;
    return hypotl(px - at * x, py - at * y);
}

static long double turn_to(sl_point a, sl_point b, sl_point c) {
    return ((long double)b.x - a.x) * ((long double)c.y - a.y) -
           ((long double)b.y - a.y) * ((long double)c.x - a.x);
}

static long double from_way(sl_segment way, sl_segment s) {
    if (turn_to(way.a, way.b, s.a) * turn_to(way.a, way.b, s.b) < 0 &&
        turn_to(s.a, s.b, way.a) * turn_to(s.a, s.b, way.b) < 0)
        return 0;
    return fminl(fminl(from_point(way.a, s), from_point(way.b, s)),
                 fminl(from_point(s.a, way), from_point(s.b, way)));
}

static long double clearance(const obstacles *o, sl_point p, sl_point q) {
    long double least = INFINITY;
    for (size_t i = 0; i < o->count; i++)
        least = fminl(least, from_way((sl_segment){p, q}, o->at[i]));
    return least;
}

/// The part of the map that a cell is in, with the doors as they are.
static uint32_t part_of(const trial *t, uint32_t cell) {
    const sl_space *s = &t->file.baked.space;
    uint32_t parts[CELLS_MOST];
    bool changed = true;
    for (uint32_t i = 0; i < s->cell_count; i++) parts[i] = i;
    while (changed) {
        changed = false;
        for (uint32_t i = 0; i < s->portal_count; i++) {
            const uint32_t a = s->portals[i].cell[0], b = s->portals[i].cell[1];
            size_t count;
            const sl_seam_portal *on = sl_space_seams_of(s, i, &count);
            bool stops = parts[a] == parts[b];
            for (size_t k = 0; k < count; k++) {
                const sl_seam *seam = &s->seams[on[k].seam];
                stops |= seam->kind == SL_SEAM_ONEWAY ||
                         (seam->kind == SL_SEAM_DOOR && t->shut[seam->number]);
            }
            if (stops) continue;
            parts[a] = parts[b] = parts[a] < parts[b] ? parts[a] : parts[b];
            changed = true;
        }
    }
    return parts[cell];
}

static bool is_in_some_box(const trial *t, sl_point p, uint32_t own) {
    for (uint32_t i = 0; i < BOXES; i++)
        if (t->boxes[i].blocks && i != own && place(p, t->boxes[i].box) >= 0) return true;
    return false;
}

static void try_way(trial *t, const obstacles *o, const sl_runtime_walker *w, sl_point p,
                    sl_point q) {
    const sl_runtime *r = &t->file.runtime;
    const bool can = sl_runtime_can_walk_wide(r, w, p.x, p.y, q.x, q.y, t->scratch);
    t->wide[can]++;
    if (!(w->radius > 0)) {
        const bool straight = w->boxes ? sl_runtime_can_walk_past_boxes(w->boxes, p.x, p.y, q.x,
                                                                        q.y, t->shut, w->own_box)
                                       : sl_runtime_can_walk(r, p.x, p.y, q.x, q.y, t->shut);
        if (can != straight) complain(t, p, q, "a point is not as a disc of radius 0");
        return;
    }
    const long double least = clearance(o, p, q);
    if (can && !(least >= w->radius)) complain(t, p, q, "a disc comes too near");
    if (!can && least >= w->radius + 6e-14L * (o->size + w->radius) &&
        sl_runtime_locate(r, p.x, p.y) != SL_RUNTIME_NO_CELL &&
        !(w->boxes && is_in_some_box(t, p, w->own_box)))
        complain(t, p, q, "a disc stays that could walk");
}

/// Walks from p toward q. Gives where it comes to.
static sl_point try_walk(trial *t, const obstacles *o, const sl_runtime_walker *w, sl_point p,
                         sl_point q) {
    const sl_runtime *r = &t->file.runtime;
    const bool can = sl_runtime_can_walk_wide(r, w, p.x, p.y, q.x, q.y, t->scratch);
    sl_point at;
    const bool arrives = sl_runtime_walk(r, w, p.x, p.y, q.x, q.y, t->scratch, &at.x, &at.y);
    const long double before = clearance(o, p, p), after = clearance(o, at, at);
    if (can && !arrives) complain(t, p, q, "it stops on a free way");
    if (arrives && !testing_same_point(at, q)) complain(t, p, q, "it is somewhere else");
    if (w->radius > 0 && !(after >= fminl(before, w->radius)))
        complain(t, p, q, "it is nearer than its radius");
    if (hypot(at.x - p.x, at.y - p.y) > hypot(q.x - p.x, q.y - p.y) + 1e-12 * o->size)
        complain(t, p, q, "it goes too far");
    if (!testing_same_point(p, at)) {
        const uint32_t from = sl_runtime_locate(r, p.x, p.y), to = sl_runtime_locate(r, at.x, at.y);
        if (part_of(t, from) != part_of(t, to)) complain(t, p, q, "it passes a wall");
        if (w->boxes && is_in_some_box(t, at, w->own_box)) complain(t, p, q, "it is in a box");
    }
    t->moves[arrives ? 2 : !testing_same_point(p, at)]++;
    return at;
}

static void discs(void **state) {
    (void)state;
    static trial t;
    static obstacles o;
    t = (trial){.context = testing_context(NULL)};
    for (uint64_t seed = 1; seed <= testing_seeds(MAPS); seed++) {
        t.random = (sl_random){seed};
        t.turned = seed % 2 == 0;
        start(&t);
        for (int state_of = 0; state_of < STATES; state_of++) {
            set_state(&t);
            const bool boxes = state_of % 2;
            const uint32_t own = (uint32_t)sl_random_below(&t.random, 2 * BOXES);
            const sl_runtime_walker w = {state_of ? below(&t, 60) / 8 : 0, t.shut,
                                         boxes ? &t.placed : NULL, own};
            find_obstacles(&t.file, t.shut, &o);
            for (uint32_t i = 0; i < BOXES && boxes; i++)
                if (t.boxes[i].blocks && i != own && is_there(&t, t.boxes[i].box))
                    add_sides(&o, t.boxes[i].box);
            for (int i = 0; i < LINES / 8; i++) {
                sl_point at = some_point(&t);
                try_way(&t, &o, &w, at, some_point(&t));
                for (int k = 0; k < 8; k++) {
                    const double reach = below(&t, 40);
                    const sl_point to = {at.x + reach * (sl_random_unit(&t.random) - 0.5),
                                         at.y + reach * (sl_random_unit(&t.random) - 0.5)};
                    try_way(&t, &o, &w, at, to);
                    at = try_walk(&t, &o, &w, at, to);
                }
            }
        }
        finish(&t);
    }
    print_message("%zu of %zu ways are wide; %zu discs stay, %zu stop, %zu arrive\n", t.wide[1],
                  t.wide[0] + t.wide[1], t.moves[0], t.moves[1], t.moves[2]);
    assert_true(t.wide[0] > 500 && t.wide[1] > 500);
    assert_true(t.moves[0] > 100 && t.moves[1] > 500 && t.moves[2] > 500);
    sl_context_destroy(t.context);
}

static sl_point walked(const baked_file *f, double radius, sl_point from, sl_point to) {
    uint32_t *scratch = malloc(sl_runtime_scratch_count(&f->runtime) * sizeof *scratch);
    const sl_runtime_walker w = {radius, NULL, NULL, SL_RUNTIME_NO_BOX};
    sl_point at;
    assert_non_null(scratch);
    sl_runtime_walk(&f->runtime, &w, from.x, from.y, to.x, to.y, scratch, &at.x, &at.y);
    free(scratch);
    return at;
}

static void comes_to(const baked_file *f, double radius, sl_point from, sl_point to, double x,
                     double y) {
    const sl_point at = walked(f, radius, from, to);
    if (hypot(at.x - x, at.y - y) > 1e-11)
        fail_msg("%g,%g to %g,%g: %.17g,%.17g, not %g,%g", from.x, from.y, to.x, to.y, at.x, at.y,
                 x, y);
}

/// A room of 20 by 10, with a gap of 2 in a wall across it and a pillar.
static void discs_slide(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\n"
                                               "wall 10 6 10 10\nwalls 4 4 5 4 5 5 4 5 4 4\n");
    comes_to(&f, 0.5, (sl_point){2, 2}, (sl_point){7, 2}, 7, 2);
    comes_to(&f, 0.5, (sl_point){8, 2}, (sl_point){12, 3}, 9.5, 3);             // along the wall
    comes_to(&f, 0.5, (sl_point){8, 5}, (sl_point){12, 5}, 12, 5);              // through the gap
    comes_to(&f, 1.5, (sl_point){7, 5}, (sl_point){12, 5}, 10 - sqrt(1.25), 5); // too wide for it
    comes_to(&f, 0.5, (sl_point){2, 2}, (sl_point){-1, -3}, 0.5, 0.5);          // into a corner
    comes_to(&f, 0.5, (sl_point){4.5, 2}, (sl_point){4.5, 8}, 4.5, 3.5); // straight at the pillar
    comes_to(&f, 0, (sl_point){8, 2}, (sl_point){12, 3}, 10, 3);
    comes_to(&f, 0.5, (sl_point){10, 2}, (sl_point){12, 2}, 10, 2);   // on a wall
    comes_to(&f, 0.5, (sl_point){9.8, 2}, (sl_point){12, 2}, 9.8, 2); // nearer than it may
    comes_to(&f, 0.5, (sl_point){9.8, 2}, (sl_point){8, 2}, 8, 2);
    comes_to(&f, 0.5, (sl_point){9.8, 2}, (sl_point){9.8, 3}, 9.8, 3);
    comes_to(&f, 0.5, (sl_point){30, 2}, (sl_point){12, 2}, 30, 2);
    comes_to(&f, 0.5, (sl_point){2, 2}, (sl_point){NAN, 2}, 2, 2);
    comes_to(&f, NAN, (sl_point){2, 2}, (sl_point){3, 2}, 3, 2);
    comes_to(&f, INFINITY, (sl_point){2, 2}, (sl_point){3, 2}, 2, 2);
    // A point comes to where it sees to, however near a wall that is.
    const sl_point beside = {7, 1e-16}, to = walked(&f, 0, (sl_point){2, 2}, beside);
    assert_true(testing_same_point(to, beside));
    const sl_point far = walked(&f, 0.5, (sl_point){2, 8}, (sl_point){1e140, 8});
    assert_true(fabs(far.x - 9.5) < 1e-11 && fabs(far.y - 8) < 1e-11);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// A disc that is pushed along oblique walls for long comes no nearer by rounding, and goes on.
static void discs_keep_off_for_long(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const double offsets[] = {0, 1e9};
    for (int i = 0; i < 2; i++) {
        static obstacles o;
        baked_file f = baked_file_turned(context, "office", 17.3, offsets[i]);
        const sl_runtime *r = &f.runtime;
        sl_random random = {3};
        find_obstacles(&f, NULL, &o);
        for (int k = 0; k < 20; k++) {
            sl_point at, angle = {sl_random_unit(&random) - 0.5, sl_random_unit(&random) - 0.5};
            do {
                at.x = r->min_x + sl_random_unit(&random) * (r->max_x - r->min_x);
                at.y = r->min_y + sl_random_unit(&random) * (r->max_y - r->min_y);
            } while (clearance(&o, at, at) < 0.4);
            size_t moves = 0;
            for (int step = 0; step < 400; step++) {
                const double by = step % 100 < 50 ? 0.03 : -0.02;
                const sl_point to = {at.x + by * angle.x, at.y + 0.03 * angle.y};
                const sl_point next = walked(&f, 0.25, at, to);
                assert_true(clearance(&o, next, next) >= 0.25);
                moves += !testing_same_point(next, at);
                at = next;
            }
            assert_true(moves > 40);
        }
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(along_the_border),
        cmocka_unit_test(past_boxes),
        cmocka_unit_test(discs_slide),
        cmocka_unit_test(discs_keep_off_for_long),
        cmocka_unit_test(discs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
