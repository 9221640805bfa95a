// The one file of the game that compiles the runtime.
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include <sightline_runtime.h>
