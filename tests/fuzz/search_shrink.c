// Shrinking: whatever can be left out or made plainer without losing the fault is, as long as there
// is something.
#include "search.h"

#include "sightline/map.h"

#include <math.h>

/// Whether the solver still says so of the sequence as a whole.
static bool has_fault(const search *s, const search_fault *fault, const random_portals *portals) {
    search_trial trial;
    if (portals->count < 2 || !search_ask(s, portals, 0, &trial)) return false;
    const size_t last = trial.portals.count - 1;
    const search_answer *answer = &trial.answers[fault->solver];
    return trial.portals.count == portals->count && answer->status == SL_OK &&
           answer->count == trial.portals.count && answer->verdicts[last] == fault->said &&
           trial.truth[last] == fault->is && search_miss(&trial) >= fault->miss;
}

static bool is_usable(const oracle_portal *p) {
    return (p->left.x != p->right.x || p->left.y != p->right.y) &&
           sl_coordinate_usable(p->left.x) && sl_coordinate_usable(p->left.y) &&
           sl_coordinate_usable(p->right.x) && sl_coordinate_usable(p->right.y);
}

static bool try_instead(const search *s, const search_fault *fault, random_portals *portals,
                        const random_portals *other) {
    for (size_t i = 0; i < other->count; i++)
        if (!is_usable(&other->items[i])) return false;
    if (!has_fault(s, fault, other)) return false;
    *portals = *other;
    return true;
}

static bool drop_one(const search *s, const search_fault *fault, random_portals *portals) {
    for (size_t at = 0; at < portals->count; at++) {
        random_portals fewer = {.count = 0};
        for (size_t i = 0; i < portals->count; i++)
            if (i != at) fewer.items[fewer.count++] = portals->items[i];
        if (try_instead(s, fault, portals, &fewer)) return true;
    }
    return false;
}

static double *coordinate(random_portals *portals, size_t number) {
    oracle_portal *p = &portals->items[number / 4];
    double *const all[] = {&p->left.x, &p->left.y, &p->right.x, &p->right.y};
    return all[number % 4];
}

/// A value to that many significant bits.
static double rounded(double value, int bits) {
    int exponent;
    const double fraction = frexp(value, &exponent);
    return ldexp(nearbyint(ldexp(fraction, bits)), exponent - bits);
}

/// Rounds one coordinate to the fewest bits that keep the fault.
static bool round_one(const search *s, const search_fault *fault, random_portals *portals) {
    bool any = false;
    for (size_t number = 0; number < 4 * portals->count; number++) {
        const double value = *coordinate(portals, number);
        for (int bits = 0; bits < 52; bits++) {
            random_portals plainer = *portals;
            const double plain = bits ? rounded(value, bits) : 0;
            if (plain == value) break;
            *coordinate(&plainer, number) = plain;
            if (!try_instead(s, fault, portals, &plainer)) continue;
            any = true;
            break;
        }
    }
    return any;
}

/// Moves the first end to the origin.
static bool move_to_origin(const search *s, const search_fault *fault, random_portals *portals) {
    const sl_point by = portals->items[0].left;
    if (by.x == 0 && by.y == 0) return false;
    random_portals moved = *portals;
    for (size_t number = 0; number < 4 * portals->count; number++)
        *coordinate(&moved, number) -= number % 2 ? by.y : by.x;
    return try_instead(s, fault, portals, &moved);
}

/// Brings the sequence to about unit size, by a power of two.
static bool scale_to_one(const search *s, const search_fault *fault, random_portals *portals) {
    double largest = 0;
    for (size_t number = 0; number < 4 * portals->count; number++)
        largest = fmax(largest, fabs(*coordinate(portals, number)));
    int exponent;
    (void)frexp(largest, &exponent);
    if (exponent == 1) return false;
    random_portals scaled = *portals;
    for (size_t number = 0; number < 4 * portals->count; number++)
        *coordinate(&scaled, number) = ldexp(*coordinate(portals, number), 1 - exponent);
    return try_instead(s, fault, portals, &scaled);
}

void search_shrink(const search *s, const search_fault *fault, random_portals *portals) {
    bool any = true;
    for (int round = 0; any && round < 100; round++) {
        any = drop_one(s, fault, portals);
        any = move_to_origin(s, fault, portals) || any;
        any = scale_to_one(s, fault, portals) || any;
        any = round_one(s, fault, portals) || any;
    }
}
