/// Distances in rationals.
#ifndef SL_TESTS_APART_H
#define SL_TESTS_APART_H

#include "sightline/geometry.h"

#include <gmp.h>
#include <stdbool.h>

/// The distance of two points, or of a point and a segment, squared.
void oracle_square_between(mpq_t out, sl_point a, sl_point b);
void oracle_square_to_segment(mpq_t out, sl_segment s, sl_point v);

/// The sign of a squared distance less the square of another one.
int oracle_compare_to_square(const mpq_t square, double distance);

/// Whether two segments are farther than a distance from each other.
bool oracle_are_apart(sl_segment s, sl_segment t, double distance);

#endif
