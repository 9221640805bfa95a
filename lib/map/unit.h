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

/// Whether a text says how long a unit of a file is, as "0.0254=m" does.
bool sli_unit_is_measured(const char *text, double *factor, const char **sign);
/// Multiplies all places and lengths of a map by a factor, and gives it a unit. The map was read
/// just now: it is not clean, and its interior is not found. SL_BAD_ARGUMENT for a factor that is
/// not above 0, a unit that is not known, a map in degrees, and coordinates that a map cannot have;
/// `said` is the text that was given, for the message.
sl_status sli_map_measure(sl_context *context, sl_map *map, double factor, const char *sign,
                          const char *said);

/// A length with three digits, rounded up, so that people can type it; 0 where it is not above 0.
double sli_rounded_up(double value);

#endif
