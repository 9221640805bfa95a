#!/bin/sh
# Sets up, builds and runs the tests: sh tools/test.sh [PRESET]...
# Presets are those of CMakePresets.json: release (where none is given), debug, asan, tsan, fma.
# Tests with the label `long` are left out: ctest --preset release -L long.
set -eu
cd "$(dirname "$0")/.."

# Which tests could not run, and why, in one line.
tell_skipped() {
    awk '/^[0-9]+\/[0-9]+ Testing: / { name = $3 }
         /^([a-z]+: )?skipped[:,] / {
             sub(/^([a-z]+: )?skipped[:,] /, "")
             if (!told[$0, name]++) tests[$0] = tests[$0] (tests[$0] ? ", " : "") name
         }
         END {
             for (why in tests) line = line (line ? "; " : "") tests[why] " (" why ")"
             print "skipped: " (line ? line : "nothing")
             print "left out: the long tests; ctest --preset " preset " -L long runs them"
         }' preset="$1" "build/$1/Testing/Temporary/LastTest.log"
}

sh tools/setup.sh
for preset in "${@:-release}"; do
    cmake --preset "$preset"
    cmake --build --preset "$preset"
    ctest --preset "$preset" --parallel "$(getconf _NPROCESSORS_ONLN)" --label-exclude long
    tell_skipped "$preset"
done
