#!/usr/bin/env bash
# The example with a window makes a picture of what it is given. Needs a display.
#
#   vtk_window_test.sh PLUME VTK_WINDOW
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$1" generate box-tetrahedra --size 8 -o box.vtu
"$2" box.vtu radius picture.png
[ -s picture.png ] || { echo "no picture" >&2; exit 1; }
# Not all of one colour: that would be some 300 bytes.
[ "$(stat -c %s picture.png)" -gt 5000 ] || { echo "the picture is empty" >&2; exit 1; }
