// What not to do: the distance between the hulls of left and right ends, its sign as rounded.
#include "search.h"

#include "sightline/support.h"

#include <math.h>

typedef struct doubles {
    random_portals portals;
} doubles;

static sl_status create(sl_context *context, sl_box bounds, void **state) {
    (void)bounds;
    *state = sl_alloc_array(context, 1, sizeof(doubles));
    return *state ? SL_OK : SL_NO_MEMORY;
}

static void destroy(sl_context *context, void *state) {
    sl_free(context, state);
}

static double least(const doubles *d, sl_point normal) {
    double left = INFINITY, right = -INFINITY;
    for (size_t i = 0; i < d->portals.count; i++) {
        const oracle_portal *p = &d->portals.items[i];
        left = fmin(left, normal.x * p->left.x + normal.y * p->left.y);
        right = fmax(right, normal.x * p->right.x + normal.y * p->right.y);
    }
    return left - right;
}

static sl_point end_of(const doubles *d, size_t number) {
    return number % 2 ? d->portals.items[number / 2].right : d->portals.items[number / 2].left;
}

static sl_status push(sl_context *context, void *state, sl_point left, sl_point right,
                      sl_stab_verdict *verdict) {
    doubles *d = state;
    (void)context;
    d->portals.items[d->portals.count++] = (oracle_portal){left, right};
    double most = -INFINITY;
    for (size_t i = 0; i < 2 * d->portals.count; i++) {
        for (size_t k = 0; k < 2 * d->portals.count; k++) {
            const sl_point a = end_of(d, i), b = end_of(d, k);
            if (a.x == b.x && a.y == b.y) continue;
            most = fmax(most, least(d, (sl_point){a.y - b.y, b.x - a.x}));
            if (i % 2 == 0 && k % 2) most = fmax(most, least(d, (sl_point){a.x - b.x, a.y - b.y}));
        }
    }
    *verdict = most > 0 ? SL_STABBED : most < 0 ? SL_HIDDEN : SL_GRAZING;
    return SL_OK;
}

static void pop(void *state) {
    ((doubles *)state)->portals.count--;
}

const sl_solver *search_doubles(void) {
    static const sl_solver solver = {.name = "doubles",
                                     .what = "a distance in doubles",
                                     .guarantee = SL_EXACT,
                                     .create = create,
                                     .destroy = destroy,
                                     .push = push,
                                     .pop = pop};
    return &solver;
}
