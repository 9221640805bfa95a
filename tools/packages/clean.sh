#!/bin/sh
# Uses the files of a release in clean systems: sh tools/packages/clean.sh FOLDER [PART...]
#
# FOLDER is one that tools/release.sh has filled, or 'tools/package.sh deb' for the part debian. Without a PART, all parts
# that are in it. Each part has a Debian 12 of its own, with the packages that its documents name and no others, and no
# network while it is used. The first run makes the system that all begin with (debootstrap, a few minutes) in
# ~/.cache/sightline. It must be root on Linux, with debootstrap: 'sh tools/setup.sh --release' installs that.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
suite=bookworm
fail() {
    echo "clean: $1" >&2
    exit "${2:-1}"
}
case ${1:-} in
-h | --help) sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 0 ;;
'' | -*) fail "usage: sh tools/packages/clean.sh FOLDER [PART...]" 2 ;;
esac
[ -d "$1" ] || fail "there is no folder $1" 2
folder=$(cd "$1" && pwd)
shift
all="source command windows amalgamation npm foundry wheel sdist qgis debian"

# What a user of a part has, beside what each Debian has.
packages() {
    case $1 in
    source) echo gcc libc6-dev cmake make pkg-config ;;
    command) ;;
    windows) echo wine wine64 python3 ;;
    amalgamation) echo gcc libc6-dev ;;
    npm) echo nodejs npm ;;
    foundry) echo nodejs python3 ;;
    wheel) echo python3-pip python3-numpy ;;
    sdist) echo python3-pip python3-numpy python3-setuptools python3-wheel gcc libc6-dev cmake make pkg-config zlib1g-dev \
        libjansson-dev libpng-dev libxml2-dev libyaml-dev libzstd-dev ;;
    qgis) echo qgis python3-qgis qgis-providers python3-pip ;;
    debian) # the packages themselves, from where the system has them
        echo gcc libc6-dev pkg-config
        find "$folder" -maxdepth 1 -name '*.deb' ! -name '*-dbgsym_*' -printf '/files/%f\n'
        ;;
    *) fail "there is no part '$1': $all" 2 ;;
    esac
}
# The file by which a part is known in FOLDER.
has() {
    case $1 in
    source) set -- "$(find "$folder" -maxdepth 1 -name 'sightline-*.tar.gz' ! -name 'sightline-*-*')" ;;
    command) set -- "$folder"/sightline-*-linux-*.tar.gz ;;
    npm) set -- "$folder"/sightline-*.tgz ;;
    wheel) set -- "$folder"/sightline-*.whl ;;
    sdist) set -- "$folder"/sightline-*-python.tar.gz ;;
    debian) set -- "$folder"/sightline_*.deb ;;
    *) set -- "$folder"/sightline-*-"$1"* ;;
    esac
    [ -e "$1" ]
}
for part in "$@"; do
    packages "$part" >/dev/null
    has "$part" || fail "$folder has no files of '$part'" 2
done

[ "$(id -u)" -eq 0 ] || fail "it must be root, to make systems" 77
command -v debootstrap >/dev/null || fail "debootstrap is missing" 77
base=${XDG_CACHE_HOME:-$HOME/.cache}/sightline/$suite
if [ ! -e "$base.made" ]; then
    rm -rf "$base"
    mkdir -p "$base"
    debootstrap --variant=minbase $suite "$base" >"$base.log" 2>&1 || fail "debootstrap fails: $base.log"
    touch "$base.made"
fi

scratch=$(mktemp -d)
system=$scratch/system
# look: $at, in seconds, and $worked, seconds of the processor that all so far has taken.
look() {
    at=$(date +%s)
    times >"$scratch/times"
    worked=$(sed -n '2s/[ms]/ /gp' "$scratch/times" | awk '{ print int(60 * ($1 + $3) + $2 + $4) }')
}
leave() {
    umount "$system/proc" 2>/dev/null || true
    umount "$system" 2>/dev/null || true
    rm -rf "$scratch"/layer "$scratch"/work
}
trap 'leave; rm -rf "$scratch"' EXIT
trap 'exit 130' HUP INT TERM

status=0
[ $# -gt 0 ] || for part in $all; do if has "$part"; then set -- "$@" "$part"; fi; done
for part in "$@"; do
    mkdir -p "$scratch/layer" "$scratch/work" "$system"
    mount -t overlay overlay -o "lowerdir=$base,upperdir=$scratch/layer,workdir=$scratch/work" "$system"
    mount -t proc proc "$system/proc"
    cp /etc/resolv.conf "$system/etc/"
    mkdir "$system/files" "$system/empty"
    cp -R "$folder/." "$system/files/"
    cp "$here/use.sh" "$system/"
    look
    before=$at before_worked=$worked
    # shellcheck disable=SC2046
    {
        chroot "$system" apt-get -qq update
        [ -z "$(packages "$part")" ] || chroot "$system" env DEBIAN_FRONTEND=noninteractive \
            apt-get -qq -y install --no-install-recommends $(packages "$part")
    } >"$scratch/log" 2>&1 || { tail -n 20 "$scratch/log" >&2; fail "$part: its packages cannot be installed"; }
    look
    installed=$at installed_worked=$worked
    if unshare --net chroot "$system" env -i PATH=/usr/bin:/bin HOME=/root sh -c "cd /empty && sh /use.sh $part /files" \
        >"$scratch/log" 2>&1; then
        look
        echo "clean: $part works: $((installed - before)) s for Debian's packages, $((at - installed)) s for it;" \
            "of the processor: $((installed_worked - before_worked)) s, $((worked - installed_worked)) s"
    else
        tail -n 30 "$scratch/log" >&2
        echo "clean: $part does not work" >&2
        status=1
    fi
    leave
done
exit $status
