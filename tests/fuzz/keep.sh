#!/bin/sh
# Keeps what fuzzers have learnt for later runs: tests/fuzz/keep.sh [BUILD [FUZZER...]]
# After run.sh. The smallest inputs that together reach what BUILD/fuzz/NAME/corpus and the kept ones
# reach (libFuzzer's -merge=1) go to tests/fuzz/corpus/NAME.tar.gz; the smallest first, and no more
# than KEEP bytes (default: 40000) before they are packed. Only inputs of this project may be there.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
build=${1:-$root/build/fuzz}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- $(cd "$root/tests/fuzz" && ls fuzz_*.c | sed 's/\.c$//')
keep=${KEEP:-40000}

for name in "$@"; do
    work=$build/fuzz/$name
    [ -d "$work/corpus" ] || continue
    rm -rf "$work/least" "$work/kept"
    mkdir -p "$work/least" "$work/kept" "$root/tests/fuzz/corpus"
    archive=$root/tests/fuzz/corpus/$name.tar.gz
    [ ! -f "$archive" ] || tar -xzf "$archive" -C "$work/corpus"
    length=4096
    case $name in fuzz_slv | fuzz_runtime) length=12288 ;; esac
    "$build/tests/fuzz/$name" -merge=1 -max_len=$length "$work/least" "$work/corpus" \
        >"$work/merge.log" 2>&1
    total=0
    for file in $(ls -rS "$work/least"); do
        total=$((total + $(wc -c <"$work/least/$file")))
        [ $total -le "$keep" ] || break
        cp "$work/least/$file" "$work/kept/"
    done
    tar -C "$work/kept" --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=644 \
        -cf - . | gzip -9n >"$archive"
    echo "$name: $(ls "$work/kept" | wc -l) of $(ls "$work/least" | wc -l) inputs," \
        "$(wc -c <"$archive") bytes"
done
