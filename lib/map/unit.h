/// Units of length.
#ifndef SL_MAP_UNIT_H
#define SL_MAP_UNIT_H

#include "sightline/map.h"

/// A unit, in the order of $INSUNITS of a DXF drawing.
typedef struct sli_unit {
    const char *name, *sign; ///< the sign for it
    bool known;              ///< the sign asks for it
    double metres;           ///< its length; 0: unknown
} sli_unit;

enum { SLI_UNITS = 15 };
extern const sli_unit sli_units[SLI_UNITS];

/// The number of the unit with this sign; 0 where there is none.
int sli_unit_number(const char *sign);

/// The length of a unit (sl_map.unit) in metres; 0 where it is none that is known.
double sli_unit_metres(const char *unit);

/// A length with three digits, rounded up, so that people can type it; 0 where it is not above 0.
double sli_rounded_up(double value);

#endif
