#!/usr/bin/env bash
# The whole tool, on tiny meshes: each peer is in the table, and the file is what plume chart reads.
#
#   peers_test.sh PLUME PLUME_PEERS
set -euo pipefail
plume=$1 peers=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() {
  echo "FAILED: $*"
  exit 1
}

under=()
families=6
if command -v xvfb-run >/dev/null && command -v xauth >/dev/null; then
  under=(xvfb-run -a)
  families=7
else
  echo "xvfb or xauth is not installed: VTK's projected tetrahedra are NOT tested" >&2
fi

"$plume" generate box-tetrahedra --size 4 -o box.vtu --quiet
"${under[@]}" "$peers" box.vtu --size 16 --rounds 1 --quick --seven-knots -o box.csv >table.txt 2>err.txt
[ "$(head -n 1 box.csv)" = "method,family,milliseconds,max_error,rms_error" ] || fail "header: $(head -n 1 box.csv)"
awk -F, 'NF != 5 { exit 1 }' box.csv || fail "a line has not five fields"
if [ $families -eq 7 ] && grep -q "PROJECTED TETRAHEDRA ARE SKIPPED" err.txt; then fail "$(cat err.txt)"; fi
found=$(tail -n +2 box.csv | cut -d, -f2 | sort -u | wc -l)
[ "$found" -ge $families ] || fail "$found families instead of $families: $(cut -d, -f2 box.csv | sort -u)"
awk -F, 'NR == 2 && ($1 != "closed form" || $2 != "plume" || $4 > 1e-5) { exit 1 }' box.csv || fail "$(sed -n 2p box.csv)"
grep -q "VTK ray cast" table.txt || fail "no table"

# Cells that are none: said in the method.
"$plume" generate box-mixed --size 3 -o mixed.vtu --quiet
"$peers" mixed.vtu --size 8 --rounds 1 --quick --only ray-cast,embree -o mixed.csv >/dev/null
grep -q "linear (cut into tetrahedra),VTK ray cast" mixed.csv || fail "not said: $(cat mixed.csv)"

# One line, and no file.
if "$peers" nothing.vtu -o no.csv 2>err.txt; then fail "a missing file is no error"; fi
[ "$(wc -l <err.txt)" -eq 1 ] && [ ! -e no.csv ] || fail "$(cat err.txt)"
