#!/bin/sh
# Installs what Sightline needs and this machine has not: sh tools/setup.sh [--ci] [--web] [--release] [--qgis] [--firefox]
# It looks at what is really there, asks the system's package manager for the rest, and does nothing
# when all is there.
#   --ci        what the checks of .ci/run and all tests need: clang, its sanitizers and tools, ccache,
#               doxygen, Xvfb and xdotool, MPI, node, npm, Chromium, aspell, groff, pdftotext, abidw, jq,
#               LuaJIT, Mono, pygame, LÖVE, Tiled, Python packages; on Debian also compilers and
#               emulators for two other machines
#   --web       what tools/web.sh needs: clang, lld, wasi-libc, compiler-rt for WebAssembly, binaryen, node
#   --release   what tools/release.sh needs beside that: npm, pip, wheel, numpy, patchelf, and on Debian
#               MinGW, Wine and debootstrap
#   --qgis      QGIS, which is large, for the test of its plugin
#   --firefox   Firefox, in which the tests of the pages can run, too
#
# Tried on Debian. Fedora, Arch and macOS are written from their package lists and untried.
set -eu

ci=no
web=no
release=no
qgis=no
firefox=no
for argument in "$@"; do
    case $argument in
    --ci) ci=yes ;;
    --web) web=yes ;;
    --release) web=yes release=yes ;;
    --qgis) qgis=yes ;;
    --firefox) firefox=yes ;;
    -h | --help) sed -n '2,13s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) echo "setup: unknown argument $argument (there are --ci, --web, --release, --qgis and --firefox)" >&2; exit 2 ;;
    esac
done

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# ---- What is there ----

has() { command -v "$1" >/dev/null 2>&1; }

compiler() { for c in cc gcc clang; do has $c && echo $c && return; done; return 1; }
cxx_compiler() { for c in c++ g++ clang++; do has $c && echo $c && return; done; return 1; }

# A C program that includes a header and links a library.
links() { # header library
    c=$(compiler) || return 1
    printf '#include <stddef.h>\n#include <stdio.h>\n#include <%s>\nint main(void) { return 0; }\n' \
        "$1" >"$scratch/try.c"
    set -- "-l$2"
    [ ! -d /opt/homebrew/lib ] || set -- -I/opt/homebrew/include -L/opt/homebrew/lib "$@"
    "$c" -o "$scratch/try" "$scratch/try.c" "$@" 2>/dev/null
}

module() { has pkg-config && pkg-config --exists "$1"; }

cmake_is_new_enough() {
    has cmake || return 1
    version=$(cmake --version | sed -n '1s/[^0-9]*\([0-9]*\)\.\([0-9]*\).*/\1 \2/p')
    [ "${version% *}" -gt 3 ] || { [ "${version% *}" -eq 3 ] && [ "${version#* }" -ge 20 ]; }
}

font() {
    for folder in /usr/share/fonts /usr/local/share/fonts "$HOME/.fonts" "$HOME/.local/share/fonts" \
        /Library/Fonts "$HOME/Library/Fonts"; do
        [ -d "$folder" ] && [ -n "$(find "$folder" -name 'DejaVuSans.ttf' 2>/dev/null | head -n 1)" ] &&
            return
    done
    return 1
}

# The system's Python, which has the system's packages.
python_has() {
    python=/usr/bin/python3
    [ -x $python ] || python=python3
    $python -c "import $1" 2>/dev/null
}

clang_sanitizes() {
    has clang || return 1
    echo 'int main(void) { return 0; }' >"$scratch/try.c"
    clang -fsanitize=address,undefined -o "$scratch/try" "$scratch/try.c" 2>/dev/null
}

wasm_compiles() {
    has clang && has wasm-ld || return 1
    printf '#include <stdio.h>\nint main(void) { long double x = 1; return puts("") * (int)(x * x); }\n' \
        >"$scratch/try.c"
    clang --target=wasm32-wasi -o "$scratch/try.wasm" "$scratch/try.c" 2>/dev/null
}

is_there() {
    case $1 in
    c) compiler >/dev/null ;;
    c++) cxx_compiler >/dev/null ;;
    cmake) cmake_is_new_enough ;;
    ninja) has ninja ;;
    pkg-config) has pkg-config ;;
    python3) has python3 ;;
    glpk) links glpk.h glpk ;;
    gmp) links gmp.h gmp ;;
    zlib) links zlib.h z ;;
    cairo | cmocka | jansson) module "$1" ;;
    pango) module pangocairo ;;
    libpng) module libpng ;;
    libxml2) module libxml-2.0 ;;
    libyaml) module yaml-0.1 ;;
    zstd) module libzstd ;;
    sdl2) module sdl2 ;;
    mpi) has mpirun && has mpicc ;;
    xvfb) has Xvfb ;;
    xdotool) has xdotool ;;
    aspell) has aspell && aspell dump dicts | grep -q '^en' ;;
    groff) has groff ;;
    poppler) has pdftotext ;;
    abidw) has abidw ;;
    x11) module x11 ;;
    font) font ;;
    clang | clang-format | clang-tidy | ccache | doxygen | llvm-symbolizer | luajit | node | npm | patchelf | tiled | debootstrap | jq | love) has "$1" ;;
    mono) has mono && has mcs ;;
    qgis) has qgis_process && /usr/bin/python3 -c 'import qgis' 2>/dev/null ;;
    chromium) has chromium || has chromium-browser ;;
    firefox) has firefox-esr || has firefox ;;
    clang-sanitizers) clang_sanitizes ;;
    numpy | scipy | pandas | geopandas | matplotlib | nbconvert | ipykernel | pygame | wheel) python_has "$1" ;;
    pip) python_has pip ;;
    wasm) wasm_compiles ;;
    aarch64) has aarch64-linux-gnu-gcc && has qemu-aarch64 ;;
    windows) has x86_64-w64-mingw32-gcc && has wine ;;
    binaryen) has wasm-opt ;;
    ezdxf) python_has ezdxf ;;
    jsonschema) python3 -c 'import jsonschema' 2>/dev/null ;;
    esac
}

# ---- What it is called here ----

package() { # system thing
    case $1:$2 in
    apt:c) echo gcc libc6-dev ;;
    apt:c++) echo g++ ;;
    apt:ninja) echo ninja-build ;;
    apt:glpk) echo libglpk-dev ;;
    apt:gmp) echo libgmp-dev ;;
    apt:cairo) echo libcairo2-dev ;;
    apt:pango) echo libpango1.0-dev ;;
    apt:cmocka) echo libcmocka-dev ;;
    apt:jansson) echo libjansson-dev ;;
    apt:zlib) echo zlib1g-dev ;;
    apt:zstd) echo libzstd-dev ;;
    apt:sdl2) echo libsdl2-dev ;;
    apt:mpi) echo libopenmpi-dev openmpi-bin ;;
    apt:x11) echo libx11-dev ;;
    apt:libpng | apt:libxml2 | apt:libyaml) echo "$2-dev" ;;
    apt:font) echo fonts-dejavu-core ;;
    apt:mono) echo mono-mcs mono-runtime ;;
    apt:firefox) echo firefox-esr ;;
    apt:qgis) echo qgis python3-qgis qgis-providers ;;
    apt:clang-sanitizers) echo libclang-rt-dev ;;
    apt:aarch64) echo gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user ;;
    apt:debootstrap) echo debootstrap debian-archive-keyring ;;
    apt:windows) echo gcc-mingw-w64-x86-64 wine wine64 ;;
    apt:wasm) echo lld wasi-libc libclang-rt-dev-wasm32 ;;
    apt:aspell | dnf:aspell | pacman:aspell) echo aspell aspell-en ;;
    apt:abidw) echo abigail-tools ;;
    apt:poppler | dnf:poppler) echo poppler-utils ;;
    apt:jsonschema | dnf:jsonschema) echo python3-jsonschema ;;
    apt:numpy | apt:scipy | apt:pandas | apt:geopandas | apt:matplotlib) echo "python3-$2" ;;
    apt:nbconvert | apt:ipykernel | apt:pygame | apt:wheel | apt:pip | apt:ezdxf) echo "python3-$2" ;;
    apt:node | dnf:node | pacman:node) echo nodejs ;;
    *:llvm-symbolizer) echo llvm ;;

    dnf:c) echo gcc ;;
    dnf:c++) echo gcc-c++ ;;
    dnf:ninja) echo ninja-build ;;
    dnf:pkg-config) echo pkgconf-pkg-config ;;
    dnf:font) echo dejavu-sans-fonts ;;
    dnf:clang-format | dnf:clang-tidy) echo clang-tools-extra ;;
    dnf:clang-sanitizers) echo compiler-rt libasan libubsan libtsan ;;
    dnf:wasm) echo lld wasi-libc-static compiler-rt-wasm32 ;;
    dnf:glpk | dnf:gmp | dnf:cairo | dnf:pango | dnf:jansson | dnf:zlib) echo "$2-devel" ;;
    dnf:zstd) echo libzstd-devel ;;
    dnf:sdl2) echo SDL2-devel ;;
    dnf:mpi) echo openmpi-devel ;;
    dnf:xvfb) echo xorg-x11-server-Xvfb ;;
    dnf:x11) echo libX11-devel ;;
    dnf:abidw | pacman:abidw | brew:abidw) echo libabigail ;;
    dnf:libpng | dnf:libxml2 | dnf:libyaml) echo "$2-devel" ;;
    dnf:cmocka) echo libcmocka-devel ;;

    dnf:numpy | dnf:scipy | dnf:pandas | dnf:geopandas | dnf:matplotlib) echo "python3-$2" ;;
    dnf:nbconvert | dnf:ipykernel | dnf:pygame | dnf:wheel | dnf:pip | dnf:ezdxf) echo "python3-$2" ;;

    pacman:numpy | pacman:scipy | pacman:pandas | pacman:matplotlib) echo "python-$2" ;;
    pacman:geopandas | pacman:nbconvert | pacman:ipykernel | pacman:pygame | pacman:wheel | pacman:pip | pacman:ezdxf) echo "python-$2" ;;
    pacman:c | pacman:c++) echo gcc ;;
    pacman:pkg-config) echo pkgconf ;;
    pacman:python3) echo python ;;
    pacman:jsonschema | brew:jsonschema) echo python-jsonschema ;;
    pacman:font) echo ttf-dejavu ;;
    pacman:clang-format | pacman:clang-tidy) echo clang ;;
    pacman:wasm) echo lld wasi-libc wasi-compiler-rt ;;
    pacman:xvfb) echo xorg-server-xvfb ;;
    pacman:x11) echo libx11 ;;
    pacman:clang-sanitizers) echo compiler-rt ;;

    brew:c | brew:c++) echo gcc ;;
    brew:pkg-config) echo pkgconf ;;
    brew:python3) echo python ;;
    brew:font) echo --cask font-dejavu ;;
    brew:clang | brew:clang-sanitizers | brew:clang-tidy) echo llvm ;;
    brew:wasm) echo lld wasi-libc wasi-runtimes ;;
    brew:xvfb) echo --cask xquartz ;;
    brew:chromium | brew:firefox | brew:love) echo --cask "$2" ;;
    brew:npm) echo node ;;

    pacman:mpi | brew:mpi) echo openmpi ;;
    brew:x11) echo libx11 ;;

    *) echo "$2" ;;
    esac
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif has sudo; then
        sudo "$@"
    else
        echo "setup: this needs root, and there is no sudo; as root: $*" >&2
        exit 1
    fi
}

install_packages() { # system package...
    system=$1
    shift
    case $system in
    apt)
        as_root apt-get -qq update >/dev/null || echo "setup: could not refresh the package lists; going on" >&2
        as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y \
            -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 \
            install --no-install-recommends "$@" >/dev/null
        ;;
    dnf) as_root dnf -y install "$@" ;;
    pacman) as_root pacman -S --needed --noconfirm "$@" ;;
    brew)
        for each in "$@"; do
            case $each in
            --cask) cask=--cask ;;
            *) brew install ${cask:-} "$each"; cask= ;;
            esac
        done
        ;;
    esac
}

# ---- What to do ----

things="c c++ cmake ninja pkg-config python3 zlib jansson libpng libxml2 libyaml zstd glpk cairo pango sdl2 font cmocka gmp"
[ $ci = yes ] && things="$things clang clang-sanitizers llvm-symbolizer clang-format clang-tidy ccache doxygen xvfb xdotool x11 mpi node npm chromium jsonschema aspell groff poppler ezdxf abidw numpy scipy pandas geopandas matplotlib nbconvert ipykernel wheel pip luajit mono pygame love tiled jq"
[ $ci = yes ] && has apt-get && things="$things aarch64 windows" # tests/everywhere
[ $web = yes ] && things="$things clang wasm binaryen node"
[ $release = yes ] && things="$things npm pip wheel numpy patchelf"
[ $release = yes ] && has apt-get && things="$things windows debootstrap"
[ $qgis = yes ] && things="$things qgis"
[ $firefox = yes ] && things="$things firefox"

missing=
for thing in $things; do is_there "$thing" || missing="$missing $thing"; done
if [ -z "$missing" ]; then
    echo "setup: everything is here"
    exit 0
fi
echo "setup: missing:$missing"

system=
for manager in apt-get:apt dnf:dnf pacman:pacman brew:brew; do
    if has "${manager%:*}"; then system=${manager#*:}; break; fi
done
if [ -z "$system" ]; then
    echo "setup: this system's package manager is none of apt, dnf, pacman, brew. Please install:" >&2
    echo "  a C and a C++ compiler (gcc or clang), cmake 3.20 or newer, ninja, pkg-config, python3," >&2
    echo "  zlib, jansson, libpng, libxml2, libyaml, zstd, GLPK, cairo, Pango, SDL2, cmocka, GMP (each with its headers), the DejaVu fonts" >&2
    exit 1
fi

packages=
for thing in $missing; do packages="$packages $(package $system "$thing")"; done
echo "setup: installing by $system:$packages"
# Split into words on purpose.
# shellcheck disable=SC2086
install_packages $system $packages

still=
for thing in $missing; do is_there "$thing" || still="$still $thing"; done
if [ -n "$still" ]; then
    echo "setup: installed, but still not usable:$still" >&2
    exit 1
fi
echo "setup: done"
