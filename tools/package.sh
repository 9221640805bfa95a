#!/bin/sh
# Builds packages: sh tools/package.sh [deb | tarball] [FOLDER]
#
# deb      Debian packages (default), by dpkg-buildpackage from a copy of the sources, of a clone or a release archive.
#          They need debhelper, dh-python and doxygen. lintian, where it is installed, must have no error and no warning
# tarball  an archive of what 'cmake --install' puts down; it can be unpacked anywhere
#
# Packages are written to FOLDER (default: build/packages). tools/packages/ has the recipes, those for
# Homebrew, vcpkg and Conan too, which are written but untried.
set -eu
cd "$(dirname "$0")/.."

kind=${1:-deb}
folder=${2:-build/packages}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
version=$(sed -n 's/^#define SL_VERSION_M[AI][JN]OR \([0-9]*\).*/\1/p;s/^#define SL_VERSION_PATCH \([0-9]*\).*/\1/p' \
    lib/include/sightline/version.h | paste -sd.)

case $kind in
deb)
    for each in dpkg-buildpackage dh dh_python3 doxygen; do
        command -v $each >/dev/null || {
            echo "package: $each is missing; as root: apt-get install debhelper dh-python doxygen lintian" >&2
            exit 1
        }
    done
    copy=$folder/sightline-$version
    rm -rf "$copy"
    mkdir "$copy"
    if [ -e .git ]; then
        git ls-files -z
    else # a release archive
        find . \( -path ./build -o -path ./out -o -path "./${copy#"$PWD"/}" \) -prune -o ! -type d -print0
    fi | tar -c --null -T - | tar -x -C "$copy"
    mv "$copy/tools/packages/debian" "$copy/debian"
    (cd "$copy" && DEB_BUILD_PROFILES=nocheck dpkg-buildpackage -us -uc -b)
    rm -rf "$copy"
    if command -v lintian >/dev/null; then
        lintian --fail-on error,warning "$folder/sightline_${version}_"*.changes
    else
        echo "package: lintian is missing: the packages were not checked" >&2
    fi
    ;;
tarball)
    cmake --preset release -B build/archive -DSIGHTLINE_TESTS=OFF
    cmake --build build/archive
    cpack --config build/archive/CPackConfig.cmake -B "$folder"
    rm -rf "$folder/_CPack_Packages"
    ;;
*)
    echo "package: there is no kind '$kind'; choose deb or tarball" >&2
    exit 2
    ;;
esac
ls -l "$folder"
