// check_regions FILE.slv [--count N] [--seed S]
//
// Holds visible regions against a sweep of a ray that shares nothing with the library's own way:
// all ends of walls are sorted by direction about the eye, by exact signs; between two directions
// that follow each other the nearest wall is one and the same, and is looked for among all walls
// that stand there.
//
// Prints a line of CSV with its heading: regions compared, the largest difference of their areas as
// a share of the larger one, and how many differ by more than 1e-9. Exit status: 0 none does, 1
// some do (the first few are named on stderr), 2 wrong arguments or files.
#include "oracle/blockers.h"
#include "sight/region.h"
#include "space/outline.h"

#include "sightline/sightline.h"
#include "sightline/support.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct event {
    sl_point at;
    uint32_t segment;
    int half; // of the plane about the eye: 0 for the upper one
    bool starts;
} event;

typedef struct sweep {
    sl_segment *segments; // the walls and the bounds
    uint32_t count;
    event *events;
    uint32_t *active, *place; // those that the ray meets, and where each is among them
    uint32_t active_count;
    sl_point eye;
} sweep;

static const sweep *sorting; // for qsort

static void *must_have(void *block) {
    if (!block) abort();
    return block;
}

static int half_of(sl_point eye, sl_point p) {
    return p.y > eye.y || (p.y == eye.y && p.x > eye.x) ? 0 : 1;
}

static int compare_events(const void *left, const void *right) {
    const event *a = left, *b = right;
    if (a->half != b->half) return a->half - b->half;
    return -blockers_turn(sorting->eye, a->at, b->at);
}

// --- the walls that the ray meets

static void enter(sweep *s, uint32_t segment) {
    if (s->place[segment] != UINT32_MAX) return;
    s->place[segment] = s->active_count;
    s->active[s->active_count++] = segment;
}

static void leave(sweep *s, uint32_t segment) {
    const uint32_t place = s->place[segment];
    if (place == UINT32_MAX) return;
    s->active[place] = s->active[--s->active_count];
    s->place[s->active[place]] = place;
    s->place[segment] = UINT32_MAX;
}

// How far along a direction a segment's line is, in lengths of the direction.
static double reach(const sweep *s, uint32_t segment, sl_point d) {
    const sl_point a = s->segments[segment].a, b = s->segments[segment].b;
    const double ex = b.x - a.x, ey = b.y - a.y;
    return ((a.x - s->eye.x) * ey - (a.y - s->eye.y) * ex) / (d.x * ey - d.y * ex);
}

static sl_point direction(const sweep *s, sl_point at) {
    const double dx = at.x - s->eye.x, dy = at.y - s->eye.y, length = hypot(dx, dy);
    return (sl_point){dx / length, dy / length};
}

static double area_between(const sweep *s, sl_point from, sl_point to) {
    const sl_point u = direction(s, from), v = direction(s, to);
    const sl_point middle = {u.x + v.x, u.y + v.y};
    uint32_t nearest = UINT32_MAX;
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < s->active_count; i++) {
        const double t = reach(s, s->active[i], middle);
        if (t > 0 && t < least) {
            least = t;
            nearest = s->active[i];
        }
    }
    if (nearest == UINT32_MAX) return 0;
    const double area = (u.x * v.y - u.y * v.x) * reach(s, nearest, u) * reach(s, nearest, v) / 2;
    return isfinite(area) ? area : 0;
}

static uint32_t list_events(sweep *s) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        const sl_point a = s->segments[i].a, b = s->segments[i].b;
        const int turn = blockers_turn(s->eye, a, b);
        if (turn == 0) continue; // seen edge-on
        const sl_point first = turn > 0 ? a : b, last = turn > 0 ? b : a;
        s->events[count++] = (event){first, i, half_of(s->eye, first), true};
        s->events[count++] = (event){last, i, half_of(s->eye, last), false};
    }
    sorting = s;
    qsort(s->events, count, sizeof *s->events, compare_events);
    return count;
}

static double area_by_sweep(sweep *s) {
    const uint32_t count = list_events(s);
    double area = 0;
    s->active_count = 0;
    for (uint32_t i = 0; i < s->count; i++) s->place[i] = UINT32_MAX;
    // Twice around: the first time tells what the ray meets to begin with.
    for (int round = 0; round < 2; round++)
        for (uint32_t i = 0; i < count;) {
            uint32_t end = i;
            while (end < count && compare_events(&s->events[i], &s->events[end]) == 0) end++;
            for (uint32_t k = i; k < end; k++)
                if (!s->events[k].starts) leave(s, s->events[k].segment);
            for (uint32_t k = i; k < end; k++)
                if (s->events[k].starts) enter(s, s->events[k].segment);
            const sl_point next = s->events[end < count ? end : 0].at;
            if (round) area += area_between(s, s->events[i].at, next);
            i = end;
        }
    return area;
}

// --- the comparison

typedef struct check {
    sl_context *context;
    sl_baked baked;
    sl_outline outline;
    sl_region region;
    sweep sweep;
    sl_random random;
    uint64_t count, wrong;
    double worst;
} check;

static void must(const check *c, sl_status status) {
    if (status == SL_OK) return;
    fprintf(stderr, "check_regions: %s\n", sl_context_message(c->context));
    exit(2);
}

static void prepare(check *c) {
    const sl_space *space = &c->baked.space;
    sweep *s = &c->sweep;
    s->count = space->wall_count + 4;
    s->segments = must_have(malloc(s->count * sizeof *s->segments));
    s->events = must_have(malloc(2 * (size_t)s->count * sizeof *s->events));
    s->active = must_have(malloc(s->count * sizeof *s->active));
    s->place = must_have(malloc(s->count * sizeof *s->place));
    for (uint32_t i = 0; i < space->wall_count; i++)
        s->segments[i] = (sl_segment){space->walls[i].a, space->walls[i].b};
    const sl_box b = space->bounds;
    const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
    for (int i = 0; i < 4; i++)
        s->segments[space->wall_count + (uint32_t)i] =
            (sl_segment){corners[i], corners[(i + 1) % 4]};
}

static void compare(check *c) {
    const sl_box b = c->baked.space.bounds;
    const sl_point eye = {b.min.x + sl_random_unit(&c->random) * (b.max.x - b.min.x),
                          b.min.y + sl_random_unit(&c->random) * (b.max.y - b.min.y)};
    const sl_view view = sl_view_all_round(eye);
    must(c, sli_region_make(c->context, &c->outline, &view, 0, &c->region));
    c->sweep.eye = eye;
    const double area = sl_region_area(&c->region), due = area_by_sweep(&c->sweep);
    const double off = fabs(area - due) / fmax(area, due);
    if (!(off <= c->worst)) c->worst = off;
    if (off <= 1e-9) return;
    if (c->wrong++ < 5)
        fprintf(stderr, "from %.17g,%.17g: area %.17g, by the sweep %.17g\n", eye.x, eye.y, area,
                due);
}

int main(int argc, char **argv) {
    check c = {.count = 1000, .random = {1}};
    const struct option options[] = {
        {"count", required_argument, NULL, 'n'}, {"seed", required_argument, NULL, 's'}, {0}};
    for (int option; (option = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        if (option == 'n')
            c.count = strtoull(optarg, NULL, 10);
        else if (option == 's')
            c.random.state = strtoull(optarg, NULL, 10);
        else
            return 2;
    }
    if (optind + 1 != argc || !(c.context = sl_context_create(NULL))) {
        fputs("check_regions FILE.slv [--count N] [--seed S]\n", stderr);
        return 2;
    }
    must(&c, sl_baked_read(c.context, argv[optind], &c.baked));
    must(&c, sli_outline_make(c.context, &c.baked.space, &c.outline));
    prepare(&c);
    for (uint64_t i = 0; i < c.count; i++) compare(&c);
    printf("file,regions,worst,wrong\n%s,%llu,%.3g,%llu\n", argv[optind],
           (unsigned long long)c.count, c.worst, (unsigned long long)c.wrong);
    free(c.sweep.segments);
    free(c.sweep.events);
    free(c.sweep.active);
    free(c.sweep.place);
    sl_region_destroy(c.context, &c.region);
    sli_outline_destroy(c.context, &c.outline);
    sl_baked_destroy(c.context, &c.baked);
    sl_context_destroy(c.context);
    return c.wrong ? 1 : 0;
}
