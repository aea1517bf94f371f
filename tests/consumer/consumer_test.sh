#!/usr/bin/env bash
# Installs the build, moves what was installed somewhere else, and builds and runs programs against
# it: by CMake and by pkg-config, each component without what it does not need.
#
#   consumer_test.sh SOURCE BUILD
set -euo pipefail
source_dir=$1 build_dir=$2
work=$build_dir/consumer_test
rm -rf "$work"
mkdir -p "$work"
cd "$work"

fail() {
  echo "consumer_test: $*" >&2
  exit 1
}
expect() { # what is run must print a line that matches: PATTERN COMMAND...
  local pattern=$1 output
  shift
  output=$("$@") || fail "$* failed: $output"
  grep -qE "$pattern" <<<"$output" || fail "$* printed $output, not $pattern"
}

cmake --install "$build_dir" --prefix "$work/first" >install.log
mv first moved
prefix=$work/moved
! grep -rIlE "$source_dir|$build_dir" moved || fail "places of the build are named above"
[ -z "$(find moved -name '*-inl.h')" ] || fail "internal headers are installed"
expect '0\.1\.0' moved/bin/plume --version

project() { # NAME [further options]: configures, builds
  local name=$1
  shift
  cmake -G Ninja -S "$source_dir/tests/consumer/$name" -B "$name" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$prefix" -DEXAMPLES="$source_dir/examples" "$@" >"$name.log" 2>&1 &&
    cmake --build "$name" >>"$name.log" 2>&1 || { cat "$name.log" >&2; fail "$name does not build"; }
}
without() { printf -- '-DCMAKE_DISABLE_FIND_PACKAGE_%s=ON ' "$@"; }

cxx_says='integral of the pressure along the diagonal: 5\.77350'
project core $(without VTK PNG OpenEXR)
expect "$cxx_says" core/my_solver
project c $(without VTK PNG OpenEXR TBB embree hwy fmt)
expect "$cxx_says" c/my_program
nm -D --defined-only "$(find moved -name libplume_c.so)" >exported
grep -q ' T plume_render$' exported || fail "libplume_c.so does not export plume_render"
! grep -v ' plume_' exported || fail "libplume_c.so exports more than its C functions: see above"

mkdir io
headers=$(cd moved/include && find plume -name '*.h' | LC_ALL=C sort)
sed 's/.*/#include "&"/' <<<"$headers" >io/forward.cpp
tac io/forward.cpp >io/backward.cpp
project io
moved/bin/plume generate box-mixed --size 4 -o box.vtu
expect '^208 cells, [1-9][0-9]* of 76800 rays hit$' io/my_viewer box.vtu picture.png
[ -s picture.png ] || fail "no picture"

with_vtk=$(find moved -name plume-vtk.pc)  # where the build has it
if [ -n "$with_vtk" ]; then
  project vtk
  moved/bin/plume generate box-tetrahedra --size 4 -o tetrahedra.vtu
  vtk/my_pipeline tetrahedra.vtu radius vtk.png
  [ -s vtk.png ] || fail "no picture by VTK's pipeline"
fi

cmake -S "$source_dir/tests/consumer/refused" -B refused -DCMAKE_PREFIX_PATH="$prefix" \
  >refused.log 2>&1 || { cat refused.log >&2; fail "refused"; }
expect 'version 0.2: 0, considered 0\.1\.0' cat refused.log
expect 'without C: (0|FALSE): .*io needs what was not found: the language C' cat refused.log
expect 'unknown: (0|FALSE): .*There is no component telepathy: core, io, c, vtk' cat refused.log
expect 'optional: (1|TRUE), core (1|TRUE), io (0|FALSE)' cat refused.log

export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name plume.pc)")
c++ -std=c++20 "$source_dir/examples/embed.cpp" $(pkg-config --cflags --libs plume) -o by_pkg_config
expect "$cxx_says" ./by_pkg_config
c++ -std=c++20 "$source_dir/examples/file_to_picture.cpp" $(pkg-config --cflags --libs plume-io) \
  -o viewer_by_pkg_config
expect '^208 cells' ./viewer_by_pkg_config box.vtu picture.png
if [ -n "$with_vtk" ]; then
  c++ -std=c++20 "$source_dir/examples/vtk_pipeline.cpp" $(pkg-config --cflags --libs plume-vtk) \
    $(pkg-config --libs plume-vtk | grep -o -- '-lvtkIOXML-[0-9.]*' | sed 's/XML/Image/') -o pipeline_by_pkg_config
  ./pipeline_by_pkg_config tetrahedra.vtu radius by_pkg_config.png
  cmp vtk.png by_pkg_config.png || fail "pkg-config's picture is another"
fi
cc "$source_dir/examples/embed.c" $(pkg-config --cflags --libs plume-c) \
  -Wl,-rpath,"$(pkg-config --variable=libdir plume-c)" -o c_by_pkg_config
expect "$cxx_says" ./c_by_pkg_config

# The Python package, where it was built: PYTHON is set then.
if [ -n "${PYTHON:-}" ]; then
  PYTHONPATH=$(dirname "$(dirname "$(find "$prefix" -path '*/plume/__init__.py')")")
  export PYTHONPATH
  expect "$cxx_says" "$PYTHON" "$source_dir/examples/embed.py"
fi
echo "all consumers were built and ran"
