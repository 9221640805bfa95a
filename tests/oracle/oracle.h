/// Cell-to-cell visibility by brute force in exact arithmetic: what every solver and method is
/// measured against. Shares nothing with the library's predicates, solvers and searches; slow, for
/// small maps. Lack of memory aborts.
#ifndef SL_TESTS_ORACLE_H
#define SL_TESTS_ORACLE_H

#include "sightline/space.h"
#include "sightline/stab.h"

/// A portal by its ends as crossed.
typedef struct oracle_portal {
    sl_point left, right;
} oracle_portal;

/// A sequence of portals, pushed and popped at its end, with every line through it that matters.
typedef struct oracle_sequence oracle_sequence;

/// `points`: all coordinates that will come, so that one power of two makes integers of them.
oracle_sequence *oracle_sequence_create(const sl_point *points, size_t count);
void oracle_sequence_destroy(oracle_sequence *sequence);
/// Whether some direction would cross the sequence and then this portal strictly forwards.
bool oracle_sequence_forwards(oracle_sequence *sequence, oracle_portal portal);
/// Appends a portal, for which oracle_sequence_forwards must hold. Exact.
sl_stab_verdict oracle_sequence_push(oracle_sequence *sequence, oracle_portal portal);
void oracle_sequence_pop(oracle_sequence *sequence);

/// The verdict on a whole sequence; SL_HIDDEN where no direction crosses it strictly forwards.
sl_stab_verdict oracle_stab(const oracle_portal *portals, size_t count);

/// Who sees whom, by every portal sequence there is. Each matrix has cell_count * cell_count
/// entries, row after row, from first to second; both start zeroed. False where more than `limit`
/// portals would be pushed.
bool oracle_by_sequences(const sl_space *space, uint64_t limit, bool *closed, bool *open);

/// Open sight without portals: one line out of every family of lines that pass the corners of cells
/// and the ends of walls on the same sides, cut at the walls it crosses. Knows cells by their
/// corners alone. `walls` may be as raw as a map's. False, with a reason, where coordinates are not
/// small multiples (up to 256) of one power of two or a wall passes through a cell.
bool oracle_by_lines(const sl_space *space, const sl_wall *walls, size_t wall_count, bool *open,
                     const char **reason);

#endif
