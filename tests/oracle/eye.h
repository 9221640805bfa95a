/// What an eye sees, by brute force in integers of any size. Open sight is taken from the walls
/// alone: a ray in each of the directions that matter, cut at the first wall. Closed sight, which
/// takes rays that only touch, goes over portals along each ray that touches something. Slow; lack
/// of memory aborts.
#ifndef SL_TESTS_EYE_H
#define SL_TESTS_EYE_H

#include "sightline/space.h"
#include "sightline/view.h"

typedef struct oracle_eye oracle_eye;

/// For an eye within the bounds. `borders`: the points by which the views to be asked for are
/// given.
oracle_eye *oracle_eye_create(const sl_space *space, sl_point eye, const sl_point *borders,
                              size_t border_count);
void oracle_eye_destroy(oracle_eye *o);

/// The cells that are seen within a view of that eye: cell_count entries, set.
void oracle_eye_sees(const oracle_eye *o, const sl_view *view, bool *closed, bool *open);

#endif
