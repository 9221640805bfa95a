#!/bin/sh
# Tests of the playground: sh viewer/web/test/run.sh WHAT FOLDER [PROGRAM [PYTHON]]
#   formats     what needs no browser, in node
#   playground  the built site, with the course, in Chromium and Firefox, as far as they are installed
#   quick       the page alone, in one browser, without axe-core
#   course      the course, so too
#   effects     the rows of the playground in tools/EFFECTS.md, by the built site in node
#   glpk        the page of GLPK's answers, in Chromium
#   frame       no test: a table of what a step of a drag takes, in Chromium, in node and natively
# FOLDER is for the built site and for tools; PROGRAM is the native `sightline`.
# BROWSERS=chromium chooses one. SHOTS=DIR keeps pictures of the page. SITE=DIR takes a built site.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
what=$1
folder=$2
[ -z "${3:-}" ] || export SIGHTLINE="$3"
skip() {
    echo "playground: skipped, $1" >&2
    exit 77
}
command -v node >/dev/null || skip "node is missing"
[ "$(node -p 'parseInt(process.versions.node)')" -ge 18 ] || skip "node is older than 18"
[ "$what" != formats ] || exec node --test "$here/formats.test.mjs" "$here/tones.test.mjs"

[ "$what" = effects ] || command -v chromium >/dev/null || command -v firefox-esr >/dev/null || command -v firefox >/dev/null ||
    skip "there is neither Chromium nor Firefox"
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
export TOOLS="$folder/tools"
if [ "$what" != effects ] && [ ! -d "$TOOLS/node_modules/axe-core" ]; then
    command -v npm >/dev/null || skip "npm is missing"
    mkdir -p "$TOOLS"
    (cd "$TOOLS" && npm install --silent --no-save --prefix . playwright-core@1.56.1 axe-core@4) >/dev/null 2>&1 ||
        skip "npm could not install playwright-core and axe-core"
fi
more=
[ "$what" != glpk ] || more=--glpk
if [ -z "${SITE:-}" ]; then
    sh "$here/../../../tools/web.sh" --build "$folder" --teachers $more >"$folder/build.log" 2>&1 || {
        status=$?
        tail -n 20 "$folder/build.log" >&2
        exit $status
    }
    SITE=$folder/site
fi
export SITE
if [ "$what" = glpk ]; then
    node "$here/../build.mjs" --package "$folder/package" --out "$folder/plain"
    export PLAIN="$folder/plain"
    exec node --test "$here/glpk.test.mjs"
fi
[ "$what" != effects ] ||
    exec "${4:-python3}" -B "$here/../../../tests/command/test_effects.py" "$SIGHTLINE" --site "$SITE" --only
if [ "$what" = frame ]; then
    command -v chromium >/dev/null || skip "Chromium is missing"
    [ -n "${SIGHTLINE:-}" ] || { echo "playground: frame needs the native program" >&2; exit 2; }
    exec node "$here/frame.mjs"
fi
page="playground language publish" course="course labs teaching lecture questions"
case $what in
quick) files=$page ;;
course) files=$course ;;
*) files="$page $course" ;;
esac
if [ "$what" = quick ] || [ "$what" = course ]; then
    if command -v chromium >/dev/null; then BROWSERS=chromium; else BROWSERS=firefox; fi
    export BROWSERS QUICK=1
fi
set --
for file in $files; do set -- "$@" "$here/$file.test.mjs"; done
exec node --test --test-concurrency=2 "$@"
