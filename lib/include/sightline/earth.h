/// Maps that lie on the earth: longitude and latitude, and the plane of a map in metres.
#ifndef SIGHTLINE_EARTH_H
#define SIGHTLINE_EARTH_H

#include "sightline/geometry.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Where the point 0, 0 of a map lies on the earth (WGS 84), in degrees. The map is in metres, its
/// x goes east and its y north. Zeroed, it is not known: the map is a plane of its own; or its
/// coordinates are those of a system that the user has named.
typedef struct sl_earth {
    bool known;
    /// The EPSG code of the coordinate system that x and y are in, as 2056 for the Swiss one; 0:
    /// not named, or known. It is written into GeoJSON and never computed with.
    uint32_t epsg;
    double longitude; ///< -180 .. 180
    double latitude;  ///< -90 .. 90
} sl_earth;

/// Reads the name of a coordinate system: "EPSG:2056". False for any other text.
SL_API bool sl_earth_read_epsg(const char *text, size_t length, uint32_t *epsg);

/// The place in the map of a longitude (x) and a latitude (y), by the transverse Mercator
/// projection about the origin's meridian, at scale 1. Angles are right. A length at a place x
/// metres east or west of the origin is too long by a factor of sl_earth_stretch(x). Any longitude
/// is taken modulo 360. Source: Karney, Transverse Mercator with an accuracy of a few nanometers,
/// 2011, equations 7 to 12, 35 and 36, up to the fourth power of n: right within 1e-6 m up to 1000
/// km from the meridian.
SL_API sl_point sl_earth_to_map(const sl_earth *earth, sl_point degrees);

/// The longitude (x, -180 .. 180) and the latitude (y) of a place in the map. It turns
/// sl_earth_to_map() back within 1e-10 degrees, up to 1000 km from the origin's meridian.
SL_API sl_point sl_earth_of_map(const sl_earth *earth, sl_point at);

/// By how much lengths are too long at x metres east or west of the origin: 1 + x^2 / (2 R^2).
SL_API double sl_earth_stretch(double x);

#ifdef __cplusplus
}
#endif

#endif
