#!/usr/bin/env bash
# Runs every command of a page's ```sh blocks as written, in order, in a directory of its own.
#
#   documentation.sh SOURCE BUILD PAGE
#
# `./dev test` is not run again: it is what runs this. Blocks that name $PLUME_DATASETS, or a variable that
# such a block sets, are skipped, loudly, where there is no such directory, and blocks that turn an option
# PLUME_WITH_... on where the build has it off: it is not for a test to change its licence. Pictures that
# the page shows from a folder of its own name are to be among those that its commands make; KEEP_PICTURES
# names a directory to copy them to.
set -euo pipefail
source_dir=$1 build_dir=$2 page=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
ln -s "$build_dir" build
printf '#!/bin/sh\n[ "$1" = test ] || exec "%s/dev" "$@"\n' "$source_dir" >dev
chmod +x dev
export PLUME_DATASETS=${PLUME_DATASETS:-$source_dir/../shared/datasets}

awk '/^```sh$/ {inside = 1; n++; next} /^```/ {inside = 0} inside {print > ("block" n)}' "$page"
ran=0 skipped=0
datasets='PLUME_DATASETS' # and the variables that are made of it
for block in $(ls block* | sort -V); do
  if grep -qE "\\$\\{?($datasets)\b" "$block" && [ ! -d "$PLUME_DATASETS" ]; then
    echo "SKIPPED: no directory $PLUME_DATASETS (set PLUME_DATASETS) for:"
    cat "$block"
    datasets+=$(sed -nE 's/^([a-z_]+)=.*/|\1/p' "$block" | tr -d '\n')
    skipped=1
    continue
  fi
  missing=""
  for option in $(grep -o 'PLUME_WITH_[A-Z]*' "$block" | sort -u); do
    grep -q "^$option:BOOL=ON" build/CMakeCache.txt || missing+=" $option"
  done
  if grep -q 'plume chart .*\.\(png\|svg\)' "$block" && ! command -v gnuplot >/dev/null; then
    echo "SKIPPED: gnuplot is not installed (Debian: gnuplot-nox) for:"
    cat "$block"
    skipped=1
    continue
  fi
  if [ -n "$missing" ]; then
    echo "SKIPPED: the build is without$missing for:"
    cat "$block"
    skipped=1
    continue
  fi
  echo "--- $(cat "$block")"
  # A page's variables hold from block to block, as in a reader's shell.
  { cat variables 2>/dev/null || true; cat "$block"; } >with_variables
  bash -euo pipefail with_variables
  grep -E '^[a-z_]+=' "$block" >>variables || true
  ran=$((ran + 1))
done
[ $ran -gt 0 ] || { echo "no commands found in $page" >&2; exit 1; }
shopt -s nullglob
for picture in *.png; do
  [ -s "$picture" ] || { echo "$picture is empty" >&2; exit 1; }
done
shown=$(grep -o "]($(basename "$page" .md)/[^)]*\.png)" "$page" | sed 's/.*\///; s/)$//' || true)
for picture in $shown; do
  if [ -s "$picture" ]; then
    [ -z "${KEEP_PICTURES:-}" ] || cp "$picture" "$KEEP_PICTURES/"
  elif [ $skipped = 0 ]; then
    echo "$page shows $picture, which its commands do not make" >&2
    exit 1
  fi
done
