#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md and docs/tutorial.md anew, by the commands of these pages.
#
#   gallery.sh BUILD
#
# Needs the meshes of datasets/CATALOGUE.md.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
for page in gallery tutorial; do
  KEEP_PICTURES="$source_dir/docs/$page" "$source_dir/tests/documentation.sh" \
    "$source_dir" "$(cd "$1" && pwd)" "$source_dir/docs/$page.md"
done
