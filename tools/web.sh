#!/bin/sh
# The npm package and the site, in a folder: sh tools/web.sh --build DIR
# gives DIR/package (the package `sightline`) and, where viewer/web is there, DIR/site.
# --package DIR stops after the package. --handouts DIR writes the course as PDF, for paper of A4 and of Letter size.
# --site DIR --base ADDRESS writes the site as it is published at ADDRESS: with a sitemap, a picture for links, a page for
# missing addresses, and a worker that keeps the site for use without a network. DIR works at any path.
# --teachers adds teachers/solutions.html, the answers of all exercises, and teachers/gift.html, questions for Moodle. No page
# leads there.
# --glpk adds a page of GLPK's answers to the site. It loads GLPK's sources by apt-get, and the page falls under the GPL 3.
# Without a folder it serves the site of build/web, which it builds first.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
folder=$root/build/web
serve=yes
site=yes
handouts=
publish=
base=
glpk=
teachers=
usage='usage: sh tools/web.sh [--build DIR | --package DIR | --handouts DIR | --site DIR --base ADDRESS] [--teachers] [--glpk]'
while [ $# -gt 0 ]; do
    case $1 in
    --build | --package)
        [ $# -gt 1 ] || { echo "web: $1 needs a folder" >&2; exit 2; }
        [ "$1" = --build ] || site=no
        folder=$2
        serve=no
        shift
        ;;
    --handouts)
        [ $# -gt 1 ] || { echo "web: $1 needs a folder" >&2; exit 2; }
        mkdir -p "$2"
        handouts=$(cd "$2" && pwd)
        serve=no
        shift
        ;;
    --site)
        [ $# -gt 1 ] || { echo "web: $1 needs a folder" >&2; exit 2; }
        publish=$2
        serve=no
        shift
        ;;
    --base)
        [ $# -gt 1 ] || { echo "web: $1 needs the address of the site" >&2; exit 2; }
        base=$2
        shift
        ;;
    --glpk) glpk=yes ;;
    --teachers) teachers=yes ;;
    -h | --help)
        sed -n '2,10s/^# //p' "$0"
        echo "$usage"
        exit 0
        ;;
    *)
        echo "web: unknown: $1; $usage" >&2
        exit 2
        ;;
    esac
    shift
done
if [ -n "$publish" ] && [ -z "$base" ]; then
    echo "web: --site needs --base, the address of the site" >&2
    exit 2
fi
if [ -n "$base" ] && [ -z "$publish" ]; then
    echo "web: --base needs --site" >&2
    exit 2
fi

# Says what is missing, with status 77: no fault of the sources.
cannot() {
    echo "web: $1; 'sh tools/setup.sh --web' installs it" >&2
    exit 77
}
for program in clang wasm-ld cmake ninja node; do
    command -v $program >/dev/null || cannot "$program is missing"
done
[ -z "$publish" ] || node "$root/viewer/web/publish.mjs" --to "$publish" --base "$base" # refuses before the build
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
echo '#include <stdio.h>' >"$folder/try.c"
clang --target=wasm32-wasi -c -o "$folder/try.o" "$folder/try.c" 2>/dev/null || {
    rm -f "$folder/try.c"
    cannot "wasi-libc is missing"
}
rm -f "$folder/try.c" "$folder/try.o"

# ---- GLPK ----
# Debian's sources, by lists of their own folder: nothing of this machine changes.
load_glpk() {
    lists=/etc/apt/sources.list.d/debian.sources
    command -v apt-get >/dev/null && [ -f $lists ] || return 1
    mkdir -p "$1/apt/lists/partial" "$1/apt/archives/partial" "$1/apt/sources"
    sed 's/^Types:.*/Types: deb-src/' $lists >"$1/apt/sources/debian.sources"
    set -- "$1" -oDir::State::lists="$1/apt/lists" -oDir::Cache="$1/apt" -oDir::Etc::sourcelist=/dev/null \
        -oDir::Etc::sourceparts="$1/apt/sources" -oAPT::Sandbox::User=root
    (cd "$1" && shift && apt-get -q "$@" update && apt-get -q "$@" --download-only source glpk) >"$1/apt.log" 2>&1 || return 1
    mkdir -p "$1/sources"
    tar -xzf "$1"/glpk_*.orig.tar.gz -C "$1/sources" --strip-components=1
}
if [ -n "$glpk" ]; then
    glpk=$folder/glpk
    mkdir -p "$glpk"
    [ -f "$glpk/sources/COPYING" ] || load_glpk "$glpk" || {
        echo "web: the sources of GLPK are not to be had: apt-get and Debian's lists are needed" >&2
        exit 77
    }
fi

# ---- The package ----
cmake -S "$root" -B "$folder/wasm" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-DNDEBUG \
    -DCMAKE_TOOLCHAIN_FILE="$root/lib/cmake/wasi.cmake" -DSIGHTLINE_WASM=ON \
    -DSIGHTLINE_GLPK_SOURCES="${glpk:+$glpk/sources}" \
    ${CMAKE_C_COMPILER_LAUNCHER:+-DCMAKE_C_COMPILER_LAUNCHER="$CMAKE_C_COMPILER_LAUNCHER"} >/dev/null
cmake --build "$folder/wasm" -j2 >"$folder/build.log" 2>&1 || {
    tail -n 20 "$folder/build.log" >&2
    echo "web: the package does not build" >&2
    exit 1
}
rm -rf "$folder/package"
cp -R "$folder/wasm/package" "$folder/package"
# Comments on lines of their own, indents and empty lines stay behind: pages load less, and the .d.ts
# files document the calls.
for file in "$folder"/package/*.js; do
    sed -e '/^ *\/\*\*.*\*\/$/d' -e '/^ *\/\*\*/,/\*\/$/d' -e '/^ *\/\//d' -e 's/^ *//' -e '/^$/d' "$file" >"$folder/stripped.js"
    mv "$folder/stripped.js" "$file"
done
echo "web: $folder/package"

# ---- The site ----
if [ $site = yes ] && [ -f "$root/viewer/web/build.mjs" ]; then
    if [ -n "$glpk" ]; then
        mkdir -p "$glpk/page"
        cp "$folder/wasm/glpk/glpk.wasm" "$glpk/sources/COPYING" "$glpk/page/"
        cp "$glpk"/glpk_*.orig.tar.gz "$glpk/page/glpk-source.tar.gz"
    fi
    node "$root/viewer/web/build.mjs" --package "$folder/package" --out "$folder/site" ${glpk:+--glpk "$glpk/page"} ${teachers:+--teachers}
    echo "web: $folder/site"
fi
if [ -n "$handouts" ]; then
    [ -d "$folder/site" ] || { echo "web: there is no site to print" >&2; exit 1; }
    node "$root/viewer/web/handouts.mjs" --site "$folder/site" --out "$handouts"
fi

if [ -n "$publish" ]; then
    [ -d "$folder/site" ] || { echo "web: there is no site to publish" >&2; exit 1; }
    node "$root/viewer/web/publish.mjs" --from "$folder/site" --to "$publish" --base "$base"
    echo "web: $publish"
fi

if [ $serve = yes ]; then
    [ -d "$folder/site" ] || { echo "web: there is no site to serve" >&2; exit 1; }
    echo "web: http://127.0.0.1:${PORT:-8000}/"
    exec python3 -m http.server --bind 127.0.0.1 --directory "$folder/site" "${PORT:-8000}"
fi
