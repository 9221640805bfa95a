#!/bin/sh
# Walking with coherence on two scenes: the tables, and the charts of Bittner & Havran 2002 (Figures
# 8 to 11). walk.md says what they show.
#
#   walk.sh SIGHTLINE SODA_HALL.ug FREEDOOM.wad OUT
set -eu
[ $# -eq 4 ] || { echo "usage: walk.sh SIGHTLINE SODA_HALL.ug FREEDOOM.wad OUT" >&2; exit 2; }
sightline=$1 soda=$2 wad=$3 out=$4
mkdir -p "$out"

"$sightline" bake "$soda" --slice 1040 --start 1398,1630 -o "$out/soda.slv" --quiet
"$sightline" bake "$wad" --map E1M2 -o "$out/doom.slv" --quiet
for scene in soda doom; do
    echo "== $scene"
    "$sightline" walk "$out/$scene.slv" --repeat 5 --table "$out/$scene.csv" --quiet
    for occluders in 8 16 32 64 1024; do
        echo "== $scene, $occluders occluders"
        "$sightline" walk "$out/$scene.slv" --method classical,updating --occluders $occluders --quiet |
            sed -n '/^method/,$p'
    done
    "$sightline" walk "$out/$scene.slv" -o "$out/$scene" --quiet
    # As on a machine on which drawing a wall takes longer.
    "$sightline" walk "$out/$scene.slv" -o "$out/$scene-250ns" --wall-cost 250 --quiet
done
