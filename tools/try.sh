#!/bin/sh
# From a fresh clone to a picture: sets up, builds, bakes a map and draws it: sh tools/try.sh [MAP]
set -eu
cd "$(dirname "$0")/.."

map=${1:-maps/office.map}
name=$(basename "$map")
name=${name%.*}
sightline=build/release/tools/sightline

# What a step says matters only where it fails.
quietly() {
    if ! "$@" >build/try.log 2>&1; then
        cat build/try.log >&2
        exit 1
    fi
}

sh tools/setup.sh
mkdir -p build out
echo "building the release in build/release: this takes some minutes ..."
quietly cmake --preset release
quietly cmake --build --preset release --target sightline_command

"$sightline" bake "$map" -o "out/$name.slv" --json >"out/$name.json"
"$sightline" draw "out/$name.slv" -o "out/$name.png"

python3 - "out/$name.json" <<'END'
import json, sys
bake = json.load(open(sys.argv[1]))
print(f"""
{bake["map"]}: {bake["cells"]} cells joined by {bake["portals"]} portals.
On average a cell sees {bake["mean_pvs_share_of_cells"]:.1%} of {bake["mean_pvs_over"]}.
Worked out in {sum(bake["seconds"].values()):.2f} seconds.
""")
END
cat <<END
The picture is $PWD/out/$name.png

Next: sh tools/try.sh maps/maze.map    another map of maps/, or one of yours
      $sightline --help
END
