/// Orientation as most exact predicates have it, by sums of doubles: what a compiler that contracts
/// a multiply and an add breaks. (The library's is made of integers.) One text, compiled twice.
///
/// The six products of the determinant, each as two doubles, are added one after the other to a sum
/// that is kept as doubles that do not overlap, least first (Shewchuk 1997, Adaptive Precision
/// Floating-Point Arithmetic and Fast Robust Geometric Predicates, theorems 7, 10, 17, 18). Exact
/// as long as nothing overflows or underflows.
#ifndef SL_TESTS_EXPANSION_H
#define SL_TESTS_EXPANSION_H

#include "sightline/geometry.h"

#include <stdbool.h>

/// The sign of (b - a) x (c - a), compiled with -ffp-contract=off.
int orient_kept(sl_point a, sl_point b, sl_point c);

/// The same with -ffp-contract=fast, optimised, for a machine that has the instruction.
int orient_contracted(sl_point a, sl_point b, sl_point c);

/// Whether the compiler had that instruction to use, and this machine runs it.
bool orient_contracts(void);

/// What rounding takes from a - b, given the rounded difference.
static inline double difference_tail(double a, double b, double difference) {
    const double part = a - difference;
    return (a - (difference + part)) + (part - b);
}

/// Dekker's: a double as two of 26 bits each.
static inline void split_in_two(double a, double *high, double *low) {
    const double c = 0x1.0000002p27 * a;
    const double big = c - a;
    *high = c - big;
    *low = a - *high;
}

/// What rounding takes from a * b.
__attribute__((noinline)) static double product_tail(double a, double b) {
    double a_high, a_low, b_high, b_low;
    split_in_two(a, &a_high, &a_low);
    split_in_two(b, &b_high, &b_low);
    const double rest = ((a * b - a_high * b_high) - a_low * b_high) - a_high * b_low;
    return a_low * b_low - rest;
}

/// Adds to a sum of `count` doubles: it has one more then.
static inline void add_one(double *sum, int count, double term) {
    double rest = term;
    for (int i = 0; i < count; i++) {
        const double total = rest + sum[i], part = total - rest;
        sum[i] = (rest - (total - part)) + (sum[i] - part);
        rest = total;
    }
    sum[count] = rest;
}

/// Adds a * b - c * d, as four doubles. Contracted, the difference is no longer one of two rounded
/// products, so that what rounding took from them is added once too often.
static inline void add_products(double *sum, int count, double a, double b, double c, double d) {
    const double left = a * b, right = c * d, difference = left - right;
    add_one(sum, count, product_tail(a, b));
    add_one(sum, count + 1, -product_tail(c, d));
    add_one(sum, count + 2, difference_tail(left, right, difference));
    add_one(sum, count + 3, difference);
}

static inline int orient_by_expansion(sl_point a, sl_point b, sl_point c) {
    const double ux = a.x - c.x, uy = a.y - c.y, vx = b.x - c.x, vy = b.y - c.y;
    const double ux_tail = difference_tail(a.x, c.x, ux), uy_tail = difference_tail(a.y, c.y, uy);
    const double vx_tail = difference_tail(b.x, c.x, vx), vy_tail = difference_tail(b.y, c.y, vy);
    double sum[16];
    add_products(sum, 0, ux_tail, vy_tail, uy_tail, vx_tail);
    add_products(sum, 4, ux_tail, vy, uy_tail, vx);
    add_products(sum, 8, ux, vy_tail, uy, vx_tail);
    add_products(sum, 12, ux, vy, uy, vx);
    for (int i = 15; i >= 0; i--)
        if (sum[i] != 0) return sum[i] > 0 ? 1 : -1;
    return 0;
}

#endif
