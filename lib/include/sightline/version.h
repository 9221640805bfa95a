/// The version of the library (Semantic Versioning). CMake reads its own version from here.
#ifndef SIGHTLINE_VERSION_H
#define SIGHTLINE_VERSION_H

#include "sightline/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The version of these headers, in numbers: for `#if`.
#define SL_VERSION_MAJOR 2 ///< goes up with changes that programs must follow
#define SL_VERSION_MINOR 0 ///< goes up with additions
#define SL_VERSION_PATCH 0 ///< goes up with corrections alone

#define SL_VERSION_TEXT(major, minor, patch) #major "." #minor "." #patch ///< helps SL_VERSION
#define SL_VERSION_OF(major, minor, patch)   SL_VERSION_TEXT(major, minor, patch) ///< likewise
/// The version of these headers as text: "2.0.0".
#define SL_VERSION SL_VERSION_OF(SL_VERSION_MAJOR, SL_VERSION_MINOR, SL_VERSION_PATCH)

/// The version of the library that the program runs with, as text. A shared library may be newer
/// than the headers that the program was compiled with (SL_VERSION).
SL_API const char *sl_version(void);

#ifdef __cplusplus
}
#endif

#endif
