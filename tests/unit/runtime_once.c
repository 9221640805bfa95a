/// The runtime header's implementation, compiled once for the unit tests. A test that sets one of
/// its limits compiles its own.
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"
