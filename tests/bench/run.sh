#!/usr/bin/env bash
# The benchmarks whose figures the documents show, one after the other: tests/bench/run.sh FOLDER [PART...]
# Each part writes FOLDER/PART.txt, the commands with what they print, and its charts beside it. A part whose files or
# programs are not there is skipped, and says so. All parts take about 40 minutes on two cores without other work. The
# parts `counts` and `long` run only if they are named. From the environment:
#   BUILD   a build, with its target `benchmarks` (default: build/release)
#   DATA    the folder of soda-hall-floor5.ug and gallery.dxf (default: ../shared/data)
#   WADS    the folder of freedoom1.wad and freedoom2.wad (default: /usr/share/games/doom)
#   WEB     what `tools/web.sh --build` wrote (default: build/web)
#   PYTHON  a Python with numpy, shapely and scipy (default: python3)
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tests/bench/run.sh FOLDER [PART...]" >&2; exit 2; }
mkdir -p "$1"
out=$(cd "$1" && pwd)
shift
wanted=("$@")
cd "$(dirname "$0")/../.."
build=${BUILD:-build/release} data=${DATA:-../shared/data} wads=${WADS:-/usr/share/games/doom} web=${WEB:-build/web}
# Its path: a part of this script is called python.
python=$(type -P "${PYTHON:-python3}") || { echo "run.sh: there is no ${PYTHON:-python3}" >&2; exit 2; }
build=$(cd "$build" && pwd)
PATH=$build/tools:$build/tests/bench:$build/tests/sightlines:$build/viewer:$PATH
soda=$data/soda-hall-floor5.ug gallery=$data/gallery.dxf
doom1=$wads/freedoom1.wad doom2=$wads/freedoom2.wad
hall_cells=("$soda" slice=1040 start=1398,1630)
hall=("$soda" --slice 1040 --start 1398,1630)
TIMEFORMAT='seconds: %R by the clock, %U + %S of the processor'

methods() {
    bench_methods "$soda" 1040
    sightline compare "${hall[@]}" -o "$out/methods"
    sightline compare "${hall[@]}" --eye
    sightline compare maps/grazing.map -o "$out/grazing"
}

levels() {
    local level wad
    bench_methods "$doom2" MAP12 dfs funnel
    glbsp -q -xp -xr -v5 "$doom1" -o "$out/gl1.wad" >/dev/null
    glbsp -q -xp -xr -v5 "$doom2" -o "$out/gl2.wad" >/dev/null
    { set +x; } 2>/dev/null
    for level in E{1,2,3,4}M{1,2,3,4,5,6,7,8,9} MAP{0{1,2,3,4,5,6,7,8,9},{1,2}{0,1,2,3,4,5,6,7,8,9},3{0,1,2}}; do
        case $level in E*) wad=$out/gl1.wad ;; *) wad=$out/gl2.wad ;; esac
        for level in "$level:given" "$level"; do bench_methods "$wad" "$level" sweep | sed "1d;s/^/$level,/"; done
    done >"$out/levels.csv"
    # Of all levels, and of those that glVIS ends on, too.
    awk -F, '{ of = ($1 ~ /given/ ? "glbsp" : "mesh") "," $5; cells[of] += $4; pairs[of] += $8
        if ($1 ~ /MAP12/) map12[of] = $9; else seconds[of] += $9 }
        END { print "cells_of,sight,cells,pairs,seconds_67,seconds_map12"
        for (of in cells) print of "," cells[of] "," pairs[of] "," seconds[of] "," map12[of] }' "$out/levels.csv"
}

reject() {
    "$python" -B tests/bench/reject.py "$build/tools/sightline" "$build/tests/sightlines/check_reject" \
        "$build/tests/sightlines/check_sightlines" --time -o "$out/reject" --wads "$wads"
}

growth() {
    bench_growth "$out" city tower maze city:5 city=5
}

cities() {
    local walls method
    for walls in 10000 100000 1000000; do
        sightline generate city --walls $walls --turned 17.3 -o "$out/city.map"
        sightline bake "$out/city.map" -o "$out/city.slv" --inside --threads 1 --json
    done
    sightline generate city --walls 100000 -o "$out/city.map"
    for method in sweep multipass dfs prune; do
        sightline bake "$out/city.map" -o "$out/city.slv" --threads 1 --method $method --json
    done
    for walls in 10000 31623; do
        sightline generate city --walls $walls -o "$out/city.map"
        sightline bake "$out/city.map" -o "$out/city.slv" --threads 1 --method flood --json
    done
}

parts() {
    "$python" -B tests/bench/parts.py "$build/tools/sightline" --walls 10000,100000,1000000 --rounds 2 --wad "$doom2" --map MAP12
}

floor() {
    sightline generate city --walls 100000 -o "$out/city.map"
    bench_sweep_floor "$soda" 1040
    bench_sweep_floor "$doom2" MAP12
    bench_sweep_floor "$out/city.map"
}

games() {
    bench_runtime office:24
    bench_runtime "$soda" 1040
    sightline generate city --walls 7500 --turned 17 -o "$out/city.map"
    bench_runtime "$out/city.map"
    bench_doors
    bench_boxes office:20
    bench_boxes office:20:17
    bench_boxes "$doom2" MAP12
    bench_boxes "$soda" 1040
}

changes() {
    bench_changes city:{4,12,39} city:{4,12,39}:17.3
}

worlds() {
    bench_world --rows none city:{4,12,38} city:{4,12,38}:17.3
    bench_world --rows now city:{4,12,38} city:{4,12,38}:17.3
    bench_world --often 100000 city:2
}

polygons() {
    local level
    sightline bake maps/office.map -o "$out/office.slv" --quiet
    sightline bake "$soda" --slice 1040 -o "$out/soda.slv" --quiet
    sightline bake "$doom1" --map E1M1 -o "$out/e1m1.slv" --quiet
    sightline bake maps/oblique/chapel.map -o "$out/chapel.slv" --quiet
    sightline generate office --size 20 --turned 17 -o "$out/office.map"
    sightline bake "$out/office.map" -o "$out/turned.slv" --quiet
    for level in office soda e1m1 chapel turned; do bench_polygon "$out/$level.slv"; done
}

effects() {
    "$python" -B tests/bench/effects.py "$build/tools/sightline" --size 12 --repeat 3
    bench_mirrors maps/effects/chambers.map "$out/mirror-depth.png"
}

vga() {
    local part step
    bench_vga "$gallery" 0.1
    bench_vga "$gallery" 0.04
    for part in depths local through metric; do bench_vga "$gallery" 0.03 0 $part; done
    sightline generate pillars --size 8 -o "$out/p8.map"
    sightline generate pillars --size 9 -o "$out/p9.map"
    sightline generate pillars --size 20 -o "$out/p20.map"
    for step in 3.6 1.2 0.6 0.36; do bench_vga "$out/p8.map" $step 0 depths; done
    bench_vga "$out/p9.map" 0.2646 0 depths
    bench_vga "$out/p20.map" 0.286 0 graph 8
    for part in visual metric angular; do
        time sightline vga "$gallery" --grid 0.04 --at 3,6 --measures $part --threads 1 -o "$out/vga.csv"
    done
    time sightline isovist "$gallery" --grid 0.0114 -o "$out/isovist.csv"
}

regions() {
    local open size kind
    for open in 10 40 70 100; do sightline generate tunnels --open $open -o "$out/tunnels-$open.map"; done
    sightline regions "$out/tunnels-10.map" --also "$out/tunnels-40.map" --also "$out/tunnels-70.map" \
        --also "$out/tunnels-100.map" --grid 2,4,8,16,32 --threads 1 -o "$out"
    for open in 10 100; do
        sightline generate tunnels --size 4 --open $open -o "$out/tunnels.map"
        sightline regions "$out/tunnels.map" --groups 7300 --points 512 --grid 8,32 --threads 1
    done
    for kind in maze office city pillars; do
        sightline generate $kind --walls 5000 -o "$out/$kind.map"
        sightline regions "$out/$kind.map" --grid 2,8,32 --threads 1
    done
    sightline generate city --walls 600 --turned 17 -o "$out/city.map"
    bench_sectors "$out/city.map"
}

view_cells() {
    local method
    sightline generate city --walls 3000 -o "$out/city.map"
    bench_view_cells times "${hall_cells[@]}" cells=50000 evaluate=10000
    bench_view_cells times "$doom2" map=MAP01 cells=50000 evaluate=10000
    bench_view_cells times "$out/city.map" cells=50000 evaluate=10000
    bench_view_work 32000
    for method in av-m hybrid; do
        time sightline viewcells "${hall[@]}" --method $method --elementary 5000 --threads 1 --json
    done
}

walk() {
    tests/bench/walk.sh "$build/tools/sightline" "$soda" "$doom1" "$out/walk"
    sightline walk "$out/walk/doom.slv" --test tree --repeat 15
}

python() {
    local map
    sightline generate city --walls 1000 -o "$out/city.map"
    for map in maps/office.map "$out/city.map"; do
        PYTHONPATH=$build/lib/bindings/python "$python" -B lib/bindings/python/bench/bench.py "$build/tools/sightline" "$map"
    done
}

wasm() {
    node lib/bindings/js/bench.js --chromium "$web/package" "$build/tools/sightline" "$build/tests/bindings/binding_answers"
}

frame() {
    SITE=$(cd "$web/site" && pwd) sh viewer/web/test/run.sh frame "$web" "$build/tools/sightline"
}

viewer() {
    local round
    for round in 1 2 3; do
        sightline-view "${hall[@]}" --bench --frames 100
        sightline-view "$doom1" --map E1M1 --bench --frames 100
        sightline-view "$doom2" --map MAP12 --bench --frames 100
    done
}

# No times: other programs may run beside it.
counts() {
    local cells exact
    sightline generate city --walls 3000 -o "$out/city.map"
    bench_view_cells curves "${hall_cells[@]}" chart="$out/view_cells_curves.png"
    bench_view_cells curves "$doom2" map=MAP01
    bench_view_cells curves "$out/city.map"
    bench_view_cells samples "${hall_cells[@]}"
    bench_view_cells histogram "${hall_cells[@]}" cells=2000
    bench_view_cells histogram "$out/city.map" cells=3000
    bench_view_cells walls "${hall_cells[@]}" turn=30 cells=2000 samples=500000
    for cells in 50 200; do
        for exact in "--samples 1500000 --evaluate 0" "--samples 1500000 --exact" "--method hybrid"; do
            sightline viewcells "${hall[@]}" --objects cells --elementary 1000 $exact --cells $cells --slv "$out/views.slv" --json
        done
    done
    "$python" -B tests/bench/effects.py "$build/tools/sightline" --mirrors
    "$python" -B tests/bench/reject.py "$build/tools/sightline" "$build/tests/sightlines/check_reject" \
        "$build/tests/sightlines/check_sightlines" --count 20000 -o "$out/reject" --wads "$wads"
}

# Minutes each.
long() {
    sightline generate city --walls 100000 -o "$out/city.map"
    sightline bake "$out/city.map" -o "$out/city.slv" --threads 1 --method flood --json
    sightline generate tunnels --size 16 --open 10 -o "$out/tunnels.map"
    sightline regions "$out/tunnels.map" --groups 29200 --points 256 --pixels 16 --grid 32 --threads 1
    sightline generate city --walls 10000000 -o "$out/city.map"
    time sightline bake "$out/city.map" -o "$out/city.slv" --inside --threads 2 --json
}

for part in "${wanted[@]}"; do
    declare -F "$part" >/dev/null || { echo "run.sh: there is no part $part" >&2; exit 2; }
done
failed=0

# run NAME NEEDED...: a part, if it is wanted and if the files and programs that it needs are there.
run() {
    local name=$1 needed from=$SECONDS status=0
    shift
    [ ${#wanted[@]} -eq 0 ] || [[ " ${wanted[*]} " == *" $name "* ]] || return 0
    for needed; do
        [ -e "$needed" ] || command -v "$needed" >/dev/null || {
            echo "$name: skipped, $needed is not there"
            return 0
        }
    done
    set +e
    (set -ex; "$name") >"$out/$name.txt" 2>&1
    status=$?
    set -e
    [ $status -eq 0 ] || { failed=1; echo "$name: failed, see $out/$name.txt"; }
    echo "$name: $((SECONDS - from)) s"
}

run methods "$soda"
run levels glbsp "$doom1" "$doom2"
run reject "$doom1" "$doom2"
run growth
run cities
run parts "$doom2"
run floor "$soda" "$doom2"
run games "$soda" "$doom2"
run changes
run worlds
run polygons "$soda" "$doom1"
run effects
run vga "$gallery"
run regions
run view_cells "$soda" "$doom2"
run walk "$soda" "$doom1"
if "$python" -c 'import numpy, scipy, shapely' 2>/dev/null; then run python; else
    echo "python: skipped, $python has no numpy, scipy or shapely"
fi
run wasm node chromium "$web/package"
run frame node chromium "$web/site"
run viewer "$soda" "$doom1" "$doom2"
[ ${#wanted[@]} -eq 0 ] || {
    run counts "$soda" "$doom1" "$doom2"
    run long
}
exit $failed
