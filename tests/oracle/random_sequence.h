/// Random portal sequences, most of them nearly or exactly degenerate: what stabbing finds hard.
/// The same seed gives the same sequences on every machine.
#ifndef SL_TESTS_RANDOM_SEQUENCE_H
#define SL_TESTS_RANDOM_SEQUENCE_H

#include "oracle/oracle.h"
#include "sightline/support.h"

/// The most portals in a random sequence.
#define RANDOM_PORTALS 16

typedef struct random_portals {
    oracle_portal items[RANDOM_PORTALS];
    size_t count;
} random_portals;

typedef enum random_kind {
    RANDOM_STAIRS,           ///< axial, as a search finds them: each beyond the ones before
    RANDOM_GRID,             ///< any direction, on a tiny grid
    RANDOM_LARGE_GRID,       ///< integers of up to 52 bits
    RANDOM_FEW_POINTS,       ///< all ends out of a few points
    RANDOM_COLLINEAR,        ///< most ends on one line
    RANDOM_GRAZING_INTEGERS, ///< ends on one line, or one unit beside it
    RANDOM_GRAZING,          ///< ends on one line, as rounded, or some last units beside it
    RANDOM_CORRIDOR,         ///< a million times longer than wide
    RANDOM_DOORS,            ///< doors of 1e-9 in halls of 1e6
    RANDOM_KINDS
} random_kind;

const char *random_kind_name(random_kind kind);

/// A sequence of one of the kinds, plain.
void random_sequence(sl_random *random, random_kind kind, random_portals *out);

/// Turned, mirrored, scaled by a power of two or shifted far away, at random; the first three are
/// exact.
void random_placing(sl_random *random, random_portals *portals);

/// One random change: an end moved by last units, put on the line through two others, or at another
/// end; a portal dropped, doubled or moved to another place in the sequence.
void random_mutation(sl_random *random, random_portals *portals);

/// The smallest box around all ends.
sl_box oracle_bounds(const oracle_portal *portals, size_t count);

#endif
