#!/usr/bin/env bash
# Who may include whom (docs/architecture.md). Prints each include that breaks the order; exits 1 if
# there is one. With --self-test, sees to it that a broken house is noticed.
set -euo pipefail

check() { # the root of a source tree
  local root=$1 bad=0 folder allowed
  while read -r folder allowed; do
    [ -d "$root/$folder" ] || continue
    # Our own headers are named by folder; anything of ours that is not allowed is an offence, as is
    # a relative path that leaves the folder.
    if grep -rnE '#include +["<](plume/|\.\./)' "$root/$folder" --include='*.h' --include='*.cpp' |
      grep -vE "#include +[\"<]plume/($folder|$allowed)/"; then
      bad=1
    fi
    if [ "$folder" != io ] && [ "$folder" != vtk ] && grep -rnE '#include +["<](vtk[A-Z]|OpenEXR/|png\.h)' "$root/$folder" \
      --include='*.h' --include='*.cpp'; then
      bad=1
    fi
  done <<'ORDER'
mesh mesh
preint preint
traverse mesh
lib mesh|traverse|preint
io lib|mesh
vtk lib|mesh|io
capi lib
python lib
datasets mesh
ORDER
  return $bad
}

if [ "${1:-}" = --self-test ]; then
  house=$(mktemp -d)
  trap 'rm -rf "$house"' EXIT
  mkdir "$house"/{mesh,preint,lib,io,capi,python,vtk}
  echo '#include "plume/mesh/mesh.h"' >"$house/lib/a.h"
  echo '#include <vtkCell.h>' >"$house/io/a.cpp"
  echo '#include <vtkCell.h>' >"$house/vtk/a.cpp"
  check "$house" >/dev/null || { echo "a sound house was refused" >&2; exit 1; }
  for offence in 'mesh #include "plume/lib/a.h"' 'preint #include <plume/mesh/mesh.h>' \
    'lib #include <vtkCell.h>' 'mesh #include "../lib/a.h"' 'io #include "plume/traverse/ray.h"' \
    'capi #include "plume/mesh/mesh.h"' 'python #include "plume/io/read_mesh.h"' \
    'vtk #include "plume/traverse/ray.h"' 'io #include "plume/vtk/volume_mapper.h"'; do
    folder=${offence%% *}
    echo "${offence#* }" >"$house/$folder/b.h"
    if check "$house" >/dev/null; then
      echo "not noticed: $offence" >&2
      exit 1
    fi
    rm "$house/$folder/b.h"
  done
  exit 0
fi
check "$1"
