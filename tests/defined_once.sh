#!/usr/bin/env bash
# Whether the build with sanitizers, which is made more seldom, is given each definition once: one
# that is given twice is an error there. Prints what is given twice; exits 1 if anything is.
set -euo pipefail

source=$1 # the source tree
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$source" && cmake --preset sanitize -B "$work/build") >"$work/log" 2>&1 || {
  cat "$work/log" >&2
  exit 1
}
python3 - "$work/build/compile_commands.json" <<'CHECK'
import json
import sys

twice, seen = set(), set()
for entry in json.load(open(sys.argv[1])):
    names = [word[2:].split("=")[0] for word in entry["command"].split() if word.startswith("-D")]
    seen |= set(names)
    twice |= {(entry["file"], name) for name in names if names.count(name) > 1}
for file, name in sorted(twice):
    print(f"{file}: {name} is defined twice")
if "HWY_DISABLED_TARGETS" not in seen:
    sys.exit("no instruction set is left out: is this the build that it should be about?")
sys.exit(bool(twice))
CHECK
