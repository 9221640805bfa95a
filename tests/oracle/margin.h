/// How far a portal sequence is from being hidden, or from being stabbed: a second reference, which
/// shares nothing with the first (oracle.h) but integers of any size.
#ifndef SL_TESTS_MARGIN_H
#define SL_TESTS_MARGIN_H

#include "oracle/oracle.h"

typedef struct oracle_margin {
    sl_stab_verdict verdict; ///< exact
    /// The widest that a line can keep away from every end, on its proper side; below 0, by how
    /// much the ends must be moved for a line to pass. Rounded, but in its last bits only.
    double value;
} oracle_margin;

/// Portals in any order, at least one; which left end goes with which right end makes no
/// difference.
oracle_margin oracle_margin_of(const oracle_portal *portals, size_t count);

/// Whether some direction crosses all portals strictly forwards: what solvers ask of a sequence.
bool oracle_forwards(const oracle_portal *portals, size_t count);

#endif
