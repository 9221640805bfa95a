/// Integration of a root, from the number of places that steps lead to and the sum of the steps: of
/// points of a grid and of axial lines alike, by the formulas of depthmapX (its pafmath.h).
#ifndef SL_INTEGRATION_H
#define SL_INTEGRATION_H

#include <math.h>

typedef struct sli_integration {
    double hh, pvalue, tekl; ///< NAN where not defined
} sli_integration;

/// Hillier and Hanson's relative asymmetry of the root of a diamond.
static inline double sli_diamond_value(double n) {
    return 2 * (n * (log2((n + 2) / 3) - 1) + 1) / ((n - 1) * (n - 2));
}

/// Likewise of a pyramid.
static inline double sli_pyramid_value(double n) {
    return 2 * (n - log2(n) - 1) / ((n - 1) * (n - 2));
}

/// `nodes` counts the root too. Where no place is deeper than a step, nothing is defined: the
/// asymmetry is 0. Where the steps to the places are one more than these, Teklenburg's divisor is
/// log(1): depthmapX writes its mark for no value there, in axialintegration.cpp and
/// vgavisualglobal.cpp.
static inline sli_integration sli_integration_of(double nodes, double total) {
    sli_integration out = {NAN, NAN, NAN};
    const double mean = total / (nodes - 1);
    if (!(nodes > 2 && mean > 1)) return out;
    const double asymmetry = 2 * (mean - 1) / (nodes - 2);
    out.hh = sli_diamond_value(nodes) / asymmetry;
    out.pvalue = sli_pyramid_value(nodes) / asymmetry;
    if (total > nodes) out.tekl = log(0.5 * (nodes - 2)) / log(total - nodes + 1);
    return out;
}

#endif
