#!/bin/sh
# Makes the pictures of viewer/README.md anew, without a display: sh viewer/tour.sh [SIGHTLINE-VIEW]
set -eu
cd "$(dirname "$0")/.."

view=${1:-build/release/viewer/sightline-view}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

again() { # count, a line of two words: it so many times
    for i in $(seq "$1"); do echo "$2 $3"; done
}

shoot() { # map picture, the script on stdin
    { echo "size 900 600"; echo "text 0.92"; cat; } >"$scratch/script.txt"
    case $1 in /*) map=$1 ;; *) map=maps/$1 ;; esac
    "$view" "$map" --script "$scratch/script.txt" --screenshot "viewer/tour/$2.png"
    echo "viewer/tour/$2.png"
}

cat >"$scratch/house.svg" <<'END'
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 420">
<g id="walls" fill="none" stroke="#000"><path d="M220 400H20V20H620V400H270 M320 20V180 M320 230V400 M20 220H130 M180 220H320"/></g>
<g id="windows" stroke="#000"><path d="M620 100V200 M20 280V360"/></g>
<g id="kitchen" stroke="#000" fill="none"><path d="M40 40H300V90H40Z"/></g>
<g id="terrace" stroke="#000"><path d="M340 415H600"/></g>
<text x="60" y="150">Kitchen</text><text x="60" y="320">Hall</text><text x="420" y="200">Living</text></svg>
END
shoot "$scratch/house.svg" reading <<END
key Ctrl+I
type kit
key Tab
$(again 4 key Space)
key Shift+Tab
key Ctrl+U
click 566 373
click 110 370
move 300 300
END
shoot "$scratch/house.svg" rooms <<'END'
key Ctrl+8
key Ctrl+2
key Ctrl+L
click 200 230
move 5 5
END
shoot office.map plan <<'END'
key 9
key Ctrl+2
key Ctrl+3
click 60 130
click 500 420
move 300 300
END
shoot office.map axial <<'END'
key 9
key Ctrl+5
key Ctrl+L
action table_right
action table_right
key Ctrl+PageDown
key Ctrl+PageDown
END
sed 's/^wall 20 0 20 6.5$/wall 22 0 22 6.5/; /^wall 44 0 44 6.5$/d' maps/office.map >"$scratch/later.map"
shoot office.map compare <<END
key 9
key Ctrl+7
key Ctrl+U
type $scratch/later.map
key Return
key R
key 1
END
shoot office.map explore <<'END'
eye 53 20 160 90
key B
END
shoot office.map difference <<'END'
eye 53 20 160 90
key X
key X
END
shoot office.map nodes <<'END'
eye 53 20 160 60
key M
key R
key Q
action side_panel
END
shoot office.map view-cells <<'END'
eye 53 20 160 90
key M
key R
key P
key J
key F5
drag 818 536 761 536
key F6
END
shoot office.map heat <<'END'
eye 53 20 160 90
key M
key R
key P
key J
key 1
move 300 280
END
shoot office.map account <<'END'
eye 53 20 160 90
key L
END
shoot oblique/comb.map cameras <<'END'
key 8
key Space
END
shoot oblique/comb.map fisk <<'END'
key F2
key U
key U
key U
key U
key End
END
shoot oblique/rotunda.map oblique <<'END'
key B
END
shoot oblique/chapel.map oblique-subdivision <<END
key F2
key U
$(again 20 key Right)
END
shoot office.map search <<END
eye 53 20 160
key F2
$(again 4 key Right)
END
shoot office.map hidden <<END
eye 53 20 160
key F2
$(again 6 key Right)
END
shoot office.map pass <<END
key F2
key U
key U
$(again 30 key Right)
END
shoot effects/doors.map effects <<END
eye 5 5 0 90
key F2
$(again 3 key U)
$(again 3 key Right)
key N
END
shoot maze.map subdivision <<END
key F2
key U
$(again 6 key Right)
END
shoot effects/mirrors.map mirror <<'END'
key F8
drag 471 200 437 200
drag 437 76 400 76
move 400 76
END
shoot office.map object <<'END'
eye 53 20 160 360
drag 491 152 448 282
click 448 282
END
shoot effects/oneway.map watch <<'END'
eye 5 5 0 60
key M
key Y
END
shoot office.map draw <<'END'
eye 53 20 160 90
key F3
drag 180 215 180 262
key X
drag 180 228 180 246
move 700 590
END
shoot office.map quiz <<'END'
key F4
key N
key Space
key N
END
shoot pillars.map first-person <<'END'
eye 4 4 40 80
key T
key I
END
