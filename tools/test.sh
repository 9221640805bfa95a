#!/bin/sh
# Sets up, builds and runs the tests: sh tools/test.sh [PRESET]...
# Presets are those of CMakePresets.json: release (where none is given), debug, asan, tsan, fma.
set -eu
cd "$(dirname "$0")/.."

sh tools/setup.sh
for preset in "${@:-release}"; do
    cmake --preset "$preset"
    cmake --build --preset "$preset"
    ctest --preset "$preset" --parallel "$(getconf _NPROCESSORS_ONLN)"
done
