#!/bin/sh
# Builds the package and tests it by node: run.sh FOLDER COMMAND ANSWERS
# FOLDER gets the package; COMMAND is the native `sightline`, ANSWERS tests/bindings/answers.c.
# Status 77, with what is missing, where a tool is missing.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
sh "$here/../../../../tools/web.sh" --package "$1"
SIGHTLINE_PACKAGE=$1/package SIGHTLINE_COMMAND=$2 SIGHTLINE_ANSWERS=$3 exec node --test "$here"/*.test.js
