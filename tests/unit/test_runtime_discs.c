// The runtime's discs that walk, against the distances to all walls.
#include "runtime_trial.h"

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
    if (sl_runtime_can_walk_wide(r, w, p.x, p.y, p.x, p.y, t->scratch) &&
        !sl_runtime_can_walk_wide(r, w, at.x, at.y, at.x, at.y, t->scratch))
        complain(t, p, q, "it rests where it may not stand");
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
            const double unit = state_of % 3 == 2 ? 1e-4 : 0.125; // small ones slide on for long
            const sl_runtime_walker w = {state_of ? unit * below(&t, 60) : 0, t.shut,
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
    // A small one goes on for long, and into a corner: beside both walls, and free to stand there.
    for (int i = 1; i < 100; i++) {
        const double radius = 1e-5 * i;
        uint32_t room[512];
        const sl_runtime_walker small = {radius, NULL, NULL, SL_RUNTIME_NO_BOX};
        const sl_point rest = walked(&f, radius, (sl_point){13 + 0.07 * i, 0.1}, (sl_point){7, -6});
        assert_true(rest.x >= radius + 10 && rest.y >= radius);
        assert_true(rest.x < radius + 10 + 2e-12 && rest.y < radius + 2e-12);
        assert_true(
            sl_runtime_can_walk_wide(&f.runtime, &small, rest.x, rest.y, rest.x, rest.y, room));
    }
    comes_to(&f, 0.5, (sl_point){30, 2}, (sl_point){12, 2}, 30, 2);
    comes_to(&f, 0.5, (sl_point){2, 2}, (sl_point){NAN, 2}, 2, 2);
    comes_to(&f, NAN, (sl_point){2, 2}, (sl_point){3, 2}, 3, 2);
    comes_to(&f, INFINITY, (sl_point){2, 2}, (sl_point){3, 2}, 2, 2);
    uint32_t scratch[512];
    const sl_runtime_walker w = {0.5, NULL, NULL, SL_RUNTIME_NO_BOX};
    assert_true(sl_runtime_scratch_count(&f.runtime) <= 512);
    assert_true(sl_runtime_can_walk_wide(&f.runtime, &w, 2, 2, 2, 2, scratch)); // it fits there
    assert_false(sl_runtime_can_walk_wide(&f.runtime, &w, 0.3, 2, 0.3, 2, scratch));
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
        cmocka_unit_test(discs_slide),
        cmocka_unit_test(discs_keep_off_for_long),
        cmocka_unit_test(discs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
