#!/bin/sh
# All files of a release, and SHA256SUMS, in a folder: sh tools/release.sh [--clean] FOLDER [PART...]
#
# source   the archive of the commit that is checked out; all else is built from it, unpacked
# command  the command for Linux, static, with its manual pages, completion and licence
# windows  the command for Windows of 64 bits, static, with its licence
# amalgamation  the core library as sightline.c and sightline.h, for programs that compile it with their own sources
# npm      the npm package
# foundry  the module for Foundry Virtual Tabletop, with the npm package in it
# qgis     the plugin for QGIS, which needs the Python package
# python   the Python package: its sources in one file, and a wheel that has the libraries it needs. An index such as PyPI
#          asks for the name sightline-VERSION.tar.gz for the first, which here is that of the archive
#
# 'sh tools/setup.sh --release' installs what they need. Without a PART, all. Each is tried in an empty folder before it is
# put into FOLDER; with --clean, also in a Debian of its own that has nothing else (tools/packages/clean.sh), as root. The
# same commit gives the same bytes with the same compilers. The static commands read map text, ASCII plans and baked files
# alone. The wheel is for Linux with the glibc that its name says, or newer.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
usage='usage: sh tools/release.sh [--clean] FOLDER [source | command | windows | amalgamation | npm | foundry | qgis | python]...'
fail() {
    echo "release: $1" >&2
    exit "${2:-1}"
}
clean=
if [ "${1:-}" = --clean ]; then
    clean=yes
    shift
fi
case ${1:-} in
-h | --help)
    sed -n '2,18s/^# \{0,1\}//p' "$0"
    exit 0
    ;;
'' | -*) fail "$usage" 2 ;;
esac
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
for part in "$@"; do
    case $part in source | command | windows | amalgamation | npm | foundry | qgis | python) ;; *) fail "there is no part '$part'; $usage" 2 ;; esac
done
parts=" ${*:-source command windows amalgamation npm foundry qgis python} "
[ -e "$root/.git" ] || fail "a clone is needed: the archive is that of a commit" 2
[ -z "$(git -C "$root" status --porcelain)" ] || fail "commit or drop the changes first" 2

version=$(sed -n 's/^#define SL_VERSION_M[AI][JN]OR \([0-9]*\).*/\1/p;s/^#define SL_VERSION_PATCH \([0-9]*\).*/\1/p' \
    "$root/lib/include/sightline/version.h" | paste -sd.)
tag=$(git -C "$root" tag --points-at HEAD | head -n 1)
case $tag in
'' | "v$version" | "$version") ;;
*) fail "the tag is $tag, the version $version: lib/include/sightline/version.h" 2 ;;
esac
name=sightline-$version
SOURCE_DATE_EPOCH=$(git -C "$root" log -1 --format=%ct)
export SOURCE_DATE_EPOCH
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'exit 130' HUP INT TERM

# What a step says matters only where it fails.
quietly() {
    "$@" >"$scratch/log" 2>&1 || {
        tail -n 30 "$scratch/log" >&2
        fail "it fails: $*"
    }
}

# pack NAME FOLDER [BASE]: the archive of a folder of $scratch, or BASE, whatever its times, owners and order are.
pack() {
    tar -C "${3:-$scratch}" --format=ustar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 \
        --numeric-owner --mode=u=rwX,go=rX -cf "$scratch/$1.tar" "$2"
    gzip -9n "$scratch/$1.tar"
}

# zip_folder FOLDER FILE: the same, as a zip file.
zip_folder() {
    find "$1" -type f | LC_ALL=C sort | quietly python3 -c "
import sys, zipfile
with zipfile.ZipFile(sys.argv[1], 'w') as archive:
    for name in sys.stdin.read().splitlines():
        archive.writestr(zipfile.ZipInfo(name), open(name, 'rb').read(), zipfile.ZIP_DEFLATED)" "$2"
}

# offer FILE: it becomes a file of the release.
offer() {
    cp "$1" "$folder/"
    made="${made:-} $(basename "$1")"
    echo "release: $folder/$(basename "$1")"
}

# keep PART FILE: the same, once it works.
files=$scratch/files
mkdir "$files"
keep() {
    mkdir "$scratch/empty"
    mv "$2" "$files/"
    (cd "$scratch/empty" && quietly sh "$sources/tools/packages/use.sh" "$1" "$files")
    rm -r "$scratch/empty"
    offer "$files/$(basename "$2")"
}

# ---- source ----
git -C "$root" archive --prefix="$name/" HEAD | tar -x -C "$scratch"
sources=$scratch/$name
[ -f "$sources/CMakeLists.txt" ] && [ -f "$sources/LICENSE" ] || fail "the archive lacks the sources"
pack "$name" "$name"
mv "$scratch/$name.tar.gz" "$files/"

# ---- command, windows: both static, without optional readers ----
# build_command FOLDER CMAKE-OPTION...: the command, in $sources/build/FOLDER.
build_command() {
    build=$sources/build/$1
    shift
    # A warning stops a release.
    quietly cmake -S "$sources" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DSIGHTLINE_WERROR=ON -DBUILD_SHARED_LIBS=OFF -DSIGHTLINE_GLPK=OFF -DSIGHTLINE_DRAW=OFF \
        -DSIGHTLINE_IO=OFF -DSIGHTLINE_VIEWER=OFF -DSIGHTLINE_PYTHON=OFF -DSIGHTLINE_TESTS=OFF -DSIGHTLINE_INSTALL=OFF "$@"
    quietly cmake --build "$build" -j2 --target sightline_command
}
case $parts in *" command "*)
    build_command release -DCMAKE_EXE_LINKER_FLAGS="-static -Wl,--build-id=none"
    quietly cmake --build "$build" -j2 --target sightline_manual
    bin=$name-linux-$(uname -m)
    mkdir -p "$scratch/$bin/man"
    strip -o "$scratch/$bin/sightline" "$build/tools/sightline"
    cp "$build"/tools/manual/*.1 "$scratch/$bin/man/"
    cp -R "$sources/LICENSE" "$sources/tools/completion" "$scratch/$bin/"
    pack "$bin" "$bin"
    keep command "$scratch/$bin.tar.gz"
    ;;
esac
case $parts in *" windows "*)
    cross=x86_64-w64-mingw32
    command -v $cross-gcc >/dev/null || fail "$cross-gcc is missing" 77
    command -v wine >/dev/null || fail "wine is missing" 77
    build_command windows -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_SYSTEM_PROCESSOR=x86_64 -DCMAKE_C_COMPILER=$cross-gcc \
        -DCMAKE_EXE_LINKER_FLAGS="-static -Wl,--no-insert-timestamp"
    bin=$name-windows-x86_64
    mkdir "$scratch/$bin"
    $cross-strip -o "$scratch/$bin/sightline.exe" "$build/tools/sightline.exe"
    cp "$sources/LICENSE" "$scratch/$bin/"
    (cd "$scratch" && zip_folder "$bin" "$bin.zip")
    if $cross-objdump -p "$scratch/$bin/sightline.exe" | sed -n 's/.*DLL Name: //p' |
        grep -viE '^(kernel32|msvcrt|advapi32|user32|shell32|ws2_32)\.dll$|^api-ms-win-'; then
        fail "the command for Windows needs libraries that Windows has not"
    fi
    keep windows "$scratch/$bin.zip"
    ;;
esac

# ---- amalgamation ----
case $parts in *" amalgamation "*)
    mkdir "$scratch/$name-amalgamation"
    cp "$sources/LICENSE" "$scratch/$name-amalgamation/"
    quietly python3 -B "$sources/tools/packages/amalgamation/amalgamate.py" "$scratch/$name-amalgamation"
    pack "$name-amalgamation" "$name-amalgamation"
    keep amalgamation "$scratch/$name-amalgamation.tar.gz"
    ;;
esac

# ---- npm, foundry, python ----
case $parts in *" npm "* | *" foundry "* | *" python "*)
    command -v npm >/dev/null || fail "npm is missing" 77
    quietly sh "$sources/tools/web.sh" --package "$scratch/web"
    ;;
esac
case $parts in *" npm "*)
    (cd "$scratch/web/package" && quietly npm pack --offline --pack-destination "$scratch")
    keep npm "$scratch/$name.tgz"
    ;;
esac

case $parts in *" foundry "*)
    mkdir "$scratch/sightline"
    (
        cd "$scratch/sightline" &&
            cp -R "$sources/lib/bindings/foundry/." "$sources/LICENSE" . &&
            cp -R "$scratch/web/package" scripts/ && chmod -R u=rwX,go=rX .
    )
    (cd "$scratch" && zip_folder sightline "$name-foundry.zip")
    keep foundry "$scratch/$name-foundry.zip"
    ;;
esac

# ---- python: the wheel is built from the file of the sources alone ----
case $parts in *" python "*)
    python=/usr/bin/python3 # which has what the set-up installs
    command -v patchelf >/dev/null || fail "patchelf is missing" 77
    mkdir "$sources/lib/bindings/python/sightline/npm" # what Level.explorer() puts into a page
    (cd "$scratch/web/package" && cp sightline.js arguments.js host.js level.wasm "$sources/lib/bindings/python/sightline/npm/")
    (cd "$sources/lib/bindings/python" && quietly $python setup.py --quiet sdist --dist-dir "$scratch/sdist")
    mkdir "$scratch/python" "$scratch/wheel"
    tar -xzf "$scratch/sdist/$name.tar.gz" -C "$scratch/python"
    pack "$name-python" "$name" "$scratch/python"
    (cd "$scratch/python" &&
        quietly $python -m pip wheel --no-index --no-deps --no-build-isolation -w "$scratch/wheel" "../$name-python.tar.gz")
    wheel=$($python "$sources/tools/packages/python/standalone.py" "$scratch"/wheel/*.whl "$scratch")
    offer "$scratch/$name-python.tar.gz" # of which the wheel was built
    keep wheel "$wheel"
    ;;
esac

# ---- qgis: it is tried with the wheel, where there is one ----
case $parts in *" qgis "*)
    cp -R "$sources/lib/bindings/qgis" "$scratch/sightline_qgis"
    cp "$sources/LICENSE" "$scratch/sightline_qgis/"
    (cd "$scratch" && zip_folder sightline_qgis "$name-qgis.zip")
    quietly python3 -m compileall -q "$scratch/sightline_qgis"
    if command -v qgis_process >/dev/null; then
        keep qgis "$scratch/$name-qgis.zip"
    else
        echo "release: QGIS is not installed: the plugin was not tried in it" >&2
        offer "$scratch/$name-qgis.zip"
    fi
    ;;
esac

# ---- the archive of the sources: last, since what it gives has now been built ----
case $parts in *" source "*) offer "$files/$name.tar.gz" ;; esac
# shellcheck disable=SC2086
(cd "$folder" && sha256sum $made >SHA256SUMS && sha256sum -c --quiet SHA256SUMS)
echo "release: $folder/SHA256SUMS"
if [ "$clean" ]; then sh "$root/tools/packages/clean.sh" "$folder"; fi
