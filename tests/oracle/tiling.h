/// The proof that the cells of a mesh tile its bounds, by rationals and nothing of the library's
/// own. Quadratic; lack of memory aborts.
#ifndef SL_TESTS_TILING_H
#define SL_TESTS_TILING_H

#include "oracle/planar_graph.h"
#include "sightline/space.h"

/// Whether cells are convex, overlap nowhere and have the area of the bounds together; each corner
/// is the end of a wall or seam, or a corner of the bounds; both sides of each portal have its
/// ends; each wall is a side of one cell at either side, and no portal runs along it. The first
/// fault found is put into `why`.
bool oracle_is_tiling(const sl_space *space, char why[ORACLE_WHY]);

/// The cell of the lowest number that holds a point, of those that are inside if any is, else of
/// those that are not solid if any is not; SL_NO_CELL for none.
uint32_t oracle_locate(const sl_space *space, sl_point point);

#endif
