#!/bin/sh
# Runs each fuzzer for SECONDS, one a core at once: tests/fuzz/run.sh SECONDS [BUILD [FUZZER...]]
# BUILD is the folder of a build with -DSIGHTLINE_FUZZERS=ON (default: build/fuzz; made if it is not
# there). Seeds come from maps/ and tests/fuzz/seeds by the ending of the name, and from what earlier
# runs have learnt (tests/fuzz/corpus, see keep.sh); what a fuzzer learns stays in
# BUILD/fuzz/NAME/corpus, what it finds in BUILD/fuzz/NAME/findings.
# Exit status: 0 without findings, 1 with, 2 where it cannot run.
set -eu

usage() {
    echo "usage: tests/fuzz/run.sh SECONDS [BUILD [FUZZER...]]" >&2
    exit 2
}

[ $# -ge 1 ] || usage
case $1 in '' | *[!0-9]*) usage ;; esac
seconds=$1
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${2:-$root/build/fuzz}
shift
[ $# -eq 0 ] || shift
targets=${*:-fuzzers}

if [ ! -f "$build/CMakeCache.txt" ]; then
    CC=clang cmake -S "$root" -B "$build" -G Ninja -DSIGHTLINE_FUZZERS=ON >&2 || exit 2
fi
cmake --build "$build" --target $targets >&2 || exit 2

# The ending of the files that a fuzzer starts from: its name, where nothing else is said.
seeds_of() {
    case $1 in
    fuzz_map_text | fuzz_mesh | fuzz_slv | fuzz_runtime | fuzz_write) echo map ;;
    fuzz_map_plan) echo txt ;;
    fuzz_unigrafix) echo ug ;;
    fuzz_agp) echo pol ;;
    fuzz_image) echo pgm ;;
    fuzz_geojson_lines) echo geojson ;;
    fuzz_number_table | fuzz_cameras) echo csv ;;
    fuzz_ros) echo yaml ;;
    fuzz_uvtt) echo dd2vtt ;;
    *) echo "${1#fuzz_}" ;;
    esac
}

# run_one NAME: 0 where nothing is found
run_one() {
    name=$1
    work=$build/fuzz/$name
    mkdir -p "$work/corpus" "$work/findings" "$work/seeds"
    ending=$(seeds_of "$name")
    # A baked file is longer than the map that it was made from.
    length=4096
    baked=no
    case $name in fuzz_slv | fuzz_runtime) baked=yes length=12288 ;; esac
    for seed in "$root"/maps/*."$ending" "$root"/tests/fuzz/seeds/*."$ending"; do
        [ ! -f "$seed" ] || cp "$seed" "$work/seeds/"
    done
    [ $baked = no ] || cp "$root"/tests/old_files/*.slv "$work/seeds/"
    kept=$root/tests/fuzz/corpus/$name.tar.gz
    [ ! -f "$kept" ] || tar -xzf "$kept" -C "$work/seeds"
    dictionary=$root/tests/fuzz/${name#fuzz_}.dict
    [ $baked = no ] || dictionary=$root/tests/fuzz/map_text.dict
    set -- -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=$length \
        -print_final_stats=1 -artifact_prefix="$work/findings/"
    [ ! -f "$dictionary" ] || set -- "$@" -dict="$dictionary"
    if "$build/tests/fuzz/$name" "$@" "$work/corpus" "$work/seeds" >"$work/log" 2>&1; then
        runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$work/log")
        echo "$name: nothing found in $runs runs"
        return 0
    fi
    echo "$name: FINDING, see $work/log and $work/findings" >&2
    tail -n 20 "$work/log" >&2
    return 1
}

[ $# -gt 0 ] || set -- $(cd "$root/tests/fuzz" && ls fuzz_*.c | sed 's/\.c$//')
cores=$(getconf _NPROCESSORS_ONLN)
status=0
while [ $# -gt 0 ]; do
    running=
    for _ in $(seq "$cores"); do
        [ $# -gt 0 ] || break
        run_one "$1" &
        running="$running $!"
        shift
    done
    for process in $running; do wait "$process" || status=1; done
done
exit $status
