/// What lengths are in, and how long that is.
#include "map/unit.h"

#include <math.h>
#include <string.h>

const sli_unit sli_units[SLI_UNITS] = {
    {"unknown", "", false, 0},
    {"inches", "in", true, 0.0254},
    {"feet", "ft", true, 0.3048},
    {"miles", "mi", false, 1609.344},
    {"millimetres", "mm", true, 1e-3},
    {"centimetres", "cm", true, 1e-2},
    {"metres", "m", true, 1},
    {"kilometres", "km", true, 1e3},
    {"microinches", "\xc2\xb5in", false, 2.54e-8},
    {"mils", "mil", false, 2.54e-5},
    {"yards", "yd", true, 0.9144},
    {"angstroms", "\xc3\x85", false, 1e-10},
    {"nanometres", "nm", false, 1e-9},
    {"microns", "\xc2\xb5m", false, 1e-6},
    {"decimetres", "dm", false, 0.1},
};

int sli_unit_number(const char *sign) {
    int number = SLI_UNITS - 1;
    while (number > 0 && strcmp(sli_units[number].sign, sign) != 0) number--;
    return number;
}

double sli_unit_metres(const char *sign) {
    return sli_units[sli_unit_number(sign)].metres;
}

double sli_rounded_up(double value) {
    double power = 1;
    if (!(value > 0)) return 0;
    while (value * power < 100 && power < 1e20) power *= 10;
    while (value * power >= 1000 && power > 1e-20) power /= 10;
    const double digits = ceil(value * power * (1 - 1e-9));
    return power >= 1 ? digits / power : digits * round(1 / power);
}
