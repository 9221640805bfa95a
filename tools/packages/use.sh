#!/bin/sh
# Uses one part of a release as whoever downloads it: sh use.sh PART FILES, in an empty folder.
# FILES is a folder with the part's files as they are offered. The status is not 0 where the part does not work.
# tools/release.sh runs it for each part that it has made, tools/packages/clean.sh in a system that has nothing else.
set -eu
part=$1
files=$(cd "$2" && pwd)

# file PATTERN: the one file of this name.
file() {
    # shellcheck disable=SC2086
    set -- "$files"/$1
    if [ $# -ne 1 ] || [ ! -f "$1" ]; then
        echo "use: not one file, but: $*" >&2
        exit 1
    fi
    echo "$1"
}

# sources: the name of their archive, the one without a second hyphen.
sources() {
    basename "$(find "$files" -maxdepth 1 -name 'sightline-*.tar.gz' ! -name 'sightline-*-*')"
}

# unpacked PATTERN: the name of the folder in an archive, which is unpacked here.
unpacked() {
    archive=$(file "$1")
    case $archive in
    *.zip) python3 -m zipfile -e "$archive" . ;;
    *) tar -xzf "$archive" ;;
    esac
    ls
}

# bakes WORD...: a command of these words, from an empty folder to a baked file.
bakes() {
    "$@" --version | tr -d '\r' | grep -qx "sightline [0-9.]*"
    "$@" generate office --quiet -o office.map
    "$@" bake office.map --check --quiet -o office.slv
    "$@" info office.slv --json | grep -q '"cells": [1-9]'
}

# readme_program FOLDER: the program of the README of these sources, as it stands there.
readme_program() {
    # shellcheck disable=SC2016
    sed -n '/^```c$/,/^```$/{/^```/d;p}' "$1/README.md"
}

# prints FOLDER PROGRAM: the program prints what that README says.
prints() {
    (cd "$1" && [ "$("$2")" = "$(sed -n '/^```text$/{n;p;q}' README.md)" ])
}

# python_sees [STATEMENT]: the Python package answers.
python_sees() {
    /usr/bin/python3 -c "
import sightline
room = sightline.Plan.from_segments([[0, 0, 4, 0], [4, 0, 4, 4], [4, 4, 0, 4], [0, 4, 0, 0]])
assert room.bake().can_see((1, 1), (3, 3))
assert sightline.__version__ in '''$(ls "$files")'''
${1:-}"
}

case $part in
command)
    folder=$(unpacked 'sightline-*-linux-*.tar.gz')
    if command -v readelf >/dev/null && readelf -d "$folder/sightline" | grep NEEDED; then exit 1; fi # it is static
    bakes env -i "$PWD/$folder/sightline"
    ;;
windows)
    folder=$(unpacked 'sightline-*-windows-*.zip')
    export WINEPREFIX="$PWD/wine" WINEDEBUG=-all
    bakes wine "$folder/sightline.exe"
    wineserver --wait # which writes in the folder until then
    ;;
source) # the core alone, which needs a C compiler and CMake; used by pkg-config and by find_package
    folder=$(unpacked "$(sources)")
    off=$(for each in ANALYSIS IO STUDY GLPK DRAW TOOLS VIEWER PYTHON TESTS; do echo "-DSIGHTLINE_$each=OFF"; done)
    # shellcheck disable=SC2086
    cmake -S "$folder" -B build -DCMAKE_BUILD_TYPE=Release $off
    cmake --build build -j2
    cmake --install build --prefix "$PWD/installed"
    readme_program "$folder" >program.c
    PKG_CONFIG_PATH=$(dirname "$(find "$PWD/installed" -name sightline.pc)")
    export PKG_CONFIG_PATH
    # shellcheck disable=SC2046
    cc program.c -o by_pkg_config $(pkg-config --static --cflags --libs sightline)
    prints "$folder" "$PWD/by_pkg_config"
    mkdir project
    cat >project/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.20)
project(program C)
find_package(sightline REQUIRED)
add_executable(program ../program.c)
target_link_libraries(program PRIVATE sightline::sightline)
END
    cmake -S project -B by_cmake -DCMAKE_PREFIX_PATH="$PWD/installed"
    cmake --build by_cmake
    prints "$folder" "$PWD/by_cmake/program"
    ;;
amalgamation) # with the README of the sources beside it
    mkdir sources two
    tar -xzf "$(file "$(sources)")" -C sources --strip-components=1
    tar -xzf "$(file 'sightline-*-amalgamation.tar.gz')" -C two --strip-components=1
    readme_program sources | sed 's|<sightline/sightline.h>|"sightline.h"|' >two/program.c
    cc -O1 two/program.c two/sightline.c -pthread -lm -o program
    prints sources "$PWD/program"
    ;;
npm)
    echo '{"type": "module"}' >package.json
    npm install --offline --no-audit --no-fund "$(file 'sightline-*.tgz')"
    cat >program.js <<'END'
import { bake } from 'sightline/bake'
import { Level } from 'sightline'
const slv = await bake({ walls: [[0, 0, 4, 0], [4, 0, 4, 4], [4, 4, 0, 4], [0, 4, 0, 0]] })
if (!(await Level.open(slv)).canSee([1, 1], [3, 3])) process.exit(1)
END
    node program.js
    ;;
foundry)
    folder=$(unpacked 'sightline-*-foundry.zip')
    cat >program.mjs <<END
import { Watch } from './$folder/scripts/watch.mjs'
import { Level } from './$folder/scripts/package/sightline.js'
import { bake } from './$folder/scripts/package/bake.js'
const watch = await Watch.of([{ c: [1, 0, 1, 2] }], { x: 0, y: 0, width: 2, height: 3 }, { Level, bake })
if (watch.sees({ x: 0.5, y: 1 }, { x: 1.5, y: 1 })) process.exit(1)
END
    node program.mjs
    ;;
qgis) # it lists the algorithms; with a wheel beside it, one makes a layer
    mkdir plugins home
    chmod 700 home
    export HOME="$PWD/home" XDG_RUNTIME_DIR="$PWD/home" QT_QPA_PLATFORM=offscreen QGIS_PLUGINPATH="$PWD/plugins"
    python3 -m zipfile -e "$(file 'sightline-*-qgis.zip')" plugins
    process=$(command -v qgis_process.bin || command -v qgis_process)
    "$process" plugins enable sightline_qgis
    "$process" list 2>/dev/null | grep -q 'sightline:isovists'
    wheel=$(find "$files" -maxdepth 1 -name 'sightline-*.whl')
    if [ "$wheel" ]; then
        PIP_BREAK_SYSTEM_PACKAGES=1 /usr/bin/python3 -m pip install --user --no-index "$wheel"
        cat >walls.geojson <<'END'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}}, "features": [
{"type": "Feature", "properties": {}, "geometry":
{"type": "LineString", "coordinates": [[0, 0], [4, 0], [4, 3], [2, 3], [2, 6], [0, 6], [0, 0]]}}]}
END
        "$process" run sightline:visibilitygraph --WALLS=walls.geojson --GRID=1 --OUTPUT=graph.geojson
        [ "$(grep -c '"Polygon"' graph.geojson)" -eq 9 ] # the points of the grid inside, none on a wall
    fi
    ;;
debian) # the packages are installed
    bakes sightline
    sightline-view --version
    readme_program /usr/share/doc/sightline >program.c
    # shellcheck disable=SC2046
    cc program.c -o program $(pkg-config --cflags --libs sightline)
    prints /usr/share/doc/sightline "$PWD/program"
    python_sees
    ;;
wheel | sdist)
    python=/usr/bin/python3 # which has the system's numpy
    if [ "$part" = wheel ]; then
        wheel=$(file 'sightline-*.whl')
        $python -m pip install --no-index --no-deps --target installed "$wheel"
        if command -v objdump >/dev/null; then # the name says the newest glibc that a symbol asks for
            newest=$(find installed -name '*.so*' -exec objdump -T {} + | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -n 1)
            case $wheel in
            *-manylinux_"$(echo "${newest#GLIBC_}" | tr . _)"_*) ;;
            *) echo "use: a symbol asks for $newest: $wheel" >&2; exit 1 ;;
            esac
        fi
    else
        $python -m pip install --no-index --no-deps --no-build-isolation --target installed "$(file 'sightline-*-python.tar.gz')"
    fi
    export PYTHONPATH="$PWD/installed"
    python_sees 'assert room.bake().explorer().page'
    ;;
*)
    echo "use: there is no part '$part'" >&2
    exit 2
    ;;
esac
