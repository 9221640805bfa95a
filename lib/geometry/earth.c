/// Longitude and latitude, laid in a plane: the transverse Mercator projection of the ellipsoid.
///
/// The ellipsoid is first laid on a sphere so that angles stay (the conformal latitude). The sphere
/// is rolled into a cylinder that touches it along the origin's meridian. A short series in n, the
/// third flattening, then makes lengths along that meridian right:
///
///     zeta  = zeta' + sum of alpha[j] sin(2 j zeta')      where zeta = xi + i eta (north, east)
///     zeta' = zeta  - sum of beta[j]  sin(2 j zeta)
///
/// Karney 2011 (arXiv:1002.1417), equations 35 and 36. Terms beyond n^4 are below 1e-7 m.
#include "sightline/earth.h"

#include <math.h>

#define DEGREE (3.14159265358979323846 / 180)

// WGS 84: the equator's radius, the flattening; what follows from them.
#define RADIUS     6378137.0
#define FLATTENING (1 / 298.257223563)
#define N          (FLATTENING / (2 - FLATTENING))
#define N2         (N * N)
#define N3         (N2 * N)
#define N4         (N2 * N2)
#define RECTIFYING (RADIUS / (1 + N) * (1 + N2 / 4 + N4 / 64))

enum { TERMS = 4 };

static const double alpha[TERMS] = {
    N / 2 - 2 * N2 / 3 + 5 * N3 / 16 + 41 * N4 / 180,
    13 * N2 / 48 - 3 * N3 / 5 + 557 * N4 / 1440,
    61 * N3 / 240 - 103 * N4 / 140,
    49561 * N4 / 161280,
};
static const double beta[TERMS] = {
    N / 2 - 2 * N2 / 3 + 37 * N3 / 96 - N4 / 360,
    N2 / 48 + N3 / 15 - 437 * N4 / 1440,
    17 * N3 / 480 - 37 * N4 / 840,
    4397 * N4 / 161280,
};

/// x: eta, y: xi.
static sl_point add_series(const double terms[TERMS], double sign, sl_point at) {
    sl_point sum = at;
    for (int j = 0; j < TERMS; j++) {
        const double k = 2 * (j + 1);
        sum.y += sign * terms[j] * sin(k * at.y) * cosh(k * at.x);
        sum.x += sign * terms[j] * cos(k * at.y) * sinh(k * at.x);
    }
    return sum;
}

static double eccentricity(void) {
    return sqrt(FLATTENING * (2 - FLATTENING));
}

/// Longitude and latitude in radians, from the meridian and from the equator; in radii.
static sl_point project(double longitude, double latitude) {
    const double e = eccentricity(), s = sin(latitude);
    const double t = sinh(atanh(s) - e * atanh(e * s)); // tangent of the conformal latitude
    const double c = cos(longitude);
    return add_series(alpha, 1, (sl_point){asinh(sin(longitude) / hypot(t, c)), atan2(t, c)});
}

sl_point sl_earth_to_map(const sl_earth *earth, sl_point degrees) {
    const double east = remainder(degrees.x - earth->longitude, 360);
    const sl_point at = project(east * DEGREE, degrees.y * DEGREE);
    const double north = at.y - project(0, earth->latitude * DEGREE).y;
    return (sl_point){RECTIFYING * at.x, RECTIFYING * north};
}

sl_point sl_earth_of_map(const sl_earth *earth, sl_point at) {
    const double e = eccentricity();
    const sl_point there = {at.x / RECTIFYING,
                            at.y / RECTIFYING + project(0, earth->latitude * DEGREE).y};
    const sl_point z = add_series(beta, -1, there);
    const double longitude = atan2(sinh(z.x), cos(z.y));
    const double conformal = asinh(sin(z.y) / hypot(sinh(z.x), cos(z.y)));
    // Each round is right to e^2 = 1/149 of the error before it.
    double latitude = atan(sinh(conformal));
    for (int i = 0; i < 8; i++) latitude = atan(sinh(conformal + e * atanh(e * sin(latitude))));
    return (sl_point){remainder(earth->longitude + longitude / DEGREE, 360), latitude / DEGREE};
}

double sl_earth_stretch(double x) {
    const double part = x / RADIUS;
    return 1 + part * part / 2;
}

bool sl_earth_read_epsg(const char *text, size_t length, uint32_t *epsg) {
    static const char lead[] = "EPSG:";
    enum { LEAD = sizeof lead - 1, DIGITS_MOST = 9 };
    uint32_t code = 0;
    if (length <= LEAD || length > LEAD + DIGITS_MOST) return false;
    for (size_t i = 0; i < LEAD; i++)
        if (text[i] != lead[i] && text[i] != (lead[i] | 32)) return false;
    for (size_t i = LEAD; i < length; i++) {
        if (text[i] < '0' || text[i] > '9') return false;
        code = 10 * code + (uint32_t)(text[i] - '0');
    }
    if (code) *epsg = code;
    return code > 0;
}
