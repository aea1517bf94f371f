#!/usr/bin/env bash
# plume chart as a user meets it: all four kinds of file, and clear refusals.
#
#   chart_test.sh PLUME
set -uo pipefail
plume=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export TMPDIR="$work/tmp"
mkdir tmp
bad=0

fail() {
  echo "FAILED: $*"
  bad=1
}
refused() { # words separated by |, arguments of plume chart...
  local words=$1 word status
  shift
  "$plume" chart "$@" >out.txt 2>err.txt
  status=$?
  [ $status -eq 1 ] || fail "exit $status instead of 1: plume chart $*"
  [ "$(wc -l <err.txt)" -eq 1 ] || fail "not one line: plume chart $*: $(cat err.txt)"
  while read -r word; do
    grep -qF -- "$word" err.txt || fail "no '$word' in: $(cat err.txt)"
  done < <(tr '|' '\n' <<<"$words")
  compgen -G 'x.*' >/dev/null && fail "left behind: $(ls x.*)"
}

"$plume" generate box-mixed --size 3 -o mixed.vtu --quiet
"$plume" generate box-tetrahedra --size 4 -o box.vtu --quiet
printf 'method,family,milliseconds,max_error,rms_error\n"theirs, slow",peer,1e6,0.05,0.01\n' >peers.csv
outputs=(-o a.csv -o a.json)
if command -v gnuplot >/dev/null; then
  outputs+=(-o a.png -o a.svg)
else
  echo "SKIPPED: no gnuplot (Debian: gnuplot-nox): pictures of charts are NOT tested"
fi
"$plume" chart mixed.vtu --quick --threads 1 --size 40x30 --also peers.csv "${outputs[@]}" >report.txt 2>err.txt ||
  fail "no chart: $(cat err.txt)"
grep -q 'timing them takes about' err.txt || fail "no estimate: $(cat err.txt)"
for words in 'the reference' 'order 2' 'tolerance 1e-3' 'dominated by' 'peer, milliseconds' 'no point'; do
  grep -q "$words" report.txt || fail "no '$words' in the report: $(cat report.txt)"
done
python3 - <<'PYTHON' || fail "the files do not hold what they should"
import csv, json
chart = json.load(open("a.json"))
ways = chart["ways"]
assert chart["cells"] > 0 and chart["size"] == [40, 30] and chart["threads"] > 0
reference = [w for w in ways if w["method"] == "the reference"]
assert len(reference) == 1 and reference[0]["max_error"] == 0 == reference[0]["rms_error"]
planned = [w for w in ways if "tolerance" in w]
assert sorted(w["tolerance"] for w in planned) == [1e-4, 1e-3, 1e-2]
assert all(w["max_error"] <= w["tolerance"] for w in planned)
assert all(w["milliseconds"] > 0 and w["rms_error"] <= w["max_error"] for w in ways)
assert any(w["dominated_by"] for w in ways) and chart["front"]
assert chart["peers"][0]["factors"][0]["factor"] > 1
rows = list(csv.DictReader(open("a.csv")))
assert [r["method"] for r in rows] == [w["method"] for w in ways] + ["theirs, slow"]
assert [float(r["milliseconds"]) for r in rows[:-1]] == [w["milliseconds"] for w in ways]
assert rows[-1]["family"] == "peer" and rows[-1]["dominated_by"]
PYTHON
if command -v gnuplot >/dev/null; then
  file_start=$(head -c 4 a.png | tail -c 3)
  [ "$file_start" = PNG ] || fail "a.png is no PNG"
  python3 -c 'import xml.dom.minidom as m; d = m.parse("a.svg"); t = "".join(n.firstChild.data for n in d.getElementsByTagName("tspan") + d.getElementsByTagName("text") if n.firstChild and n.firstChild.nodeType == 3); assert "mixed.vtu: error against time" in t and "theirs, slow" in t, t' ||
    fail "a.svg has not the text it should"
fi
# Another chart's points are a peer of their own.
"$plume" chart box.vtu --quick --threads 1 --size 20x15 --rounds 1 --also a.csv --quiet -o b.csv >out.txt 2>err.txt ||
  fail "no second chart: $(cat err.txt)"
[ ! -s out.txt ] && [ ! -s err.txt ] || fail "quiet is not quiet"
grep -q 'plume (a)' b.csv || fail "points of another chart are taken for ours"

refused "x.pdf|.png, .svg, .csv or .json" box.vtu -o x.pdf
refused "none/x.csv" box.vtu -o none/x.csv
refused "--also 'none.csv'" box.vtu -o x.csv --also none.csv
printf 'method,family\n' >short.csv
refused "short.csv, line 1|milliseconds" box.vtu -o x.csv --also short.csv
mkdir empty
PATH=$work/empty "$plume" chart box.vtu -o x.png 2>err.txt && fail "a picture without gnuplot"
grep -q 'gnuplot-nox' err.txt || fail "the missing package is not named: $(cat err.txt)"
mkdir broken
printf '#!/bin/sh\necho "no such terminal" >&2\nexit 1\n' >broken/gnuplot
chmod +x broken/gnuplot
PATH=$work/broken:$PATH "$plume" chart box.vtu --quick --threads 1 --size 8x6 --rounds 1 --quiet -o x.png 2>err.txt &&
  fail "a picture by a broken gnuplot"
grep -q 'x.png: gnuplot could not draw it: no such terminal' err.txt || fail "what gnuplot says is not said: $(cat err.txt)"
compgen -G 'x.*' >/dev/null && fail "left behind: $(ls x.*)"
[ -z "$(ls -A tmp)" ] || fail "left in the temporary directory: $(ls tmp)"
[ $bad -eq 0 ] && echo "all well"
exit $bad
