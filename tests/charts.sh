#!/usr/bin/env bash
# Measures all charts of docs/choosing.md anew, on a machine that does nothing else, and the reports that go with
# them: DIRECTORY/NAME.png, .csv and .txt, and NAME-peers.txt of other renderers.
#
#   charts.sh DIRECTORY BUILD [NAME...]      NAME: fin-hexahedra fin-tetrahedra combustor box-10M (all of them)
#
# Other renderers are measured, too, on the same rays, where BUILD/bin/plume_peers is built. Needs the meshes of
# datasets/CATALOGUE.md, 8 GB of memory and 1 GB of temporary files (TMPDIR) for box-10M, and gnuplot. From the environment:
# PLUME_DATASETS; CHART_SIZE, pixels a side (512); CHART_ROUNDS, frames of each way (7); CHART_THREADS (1, whose time
# on the processor is taken); CHART_PEERS, further options for plume_peers, such as "--only embree"; CHART_CELLS, along an edge of the box (118: ten million tetrahedra).
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ $# -ge 2 ] || { sed -n '2,11s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
mkdir -p "$1"
directory=$(cd "$1" && pwd) bin=$(cd "$2" && pwd)/bin
shift 2
names=${*:-fin-hexahedra fin-tetrahedra combustor box-10M}
datasets=${PLUME_DATASETS:-$source_dir/../shared/datasets}
size=${CHART_SIZE:-512} rounds=${CHART_ROUNDS:-7} threads=${CHART_THREADS:-1}
# VTK's projected tetrahedra need a display.
on_a_screen=()
command -v xvfb-run >/dev/null && on_a_screen=(xvfb-run -a)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Seven points of a colour map, as one draws them by hand; in linear colours they make 100 knots. VTK looks knots up
# one by one, so that more would slow it down. Over a unit distance the points' optical depths are 0 1 0.2 2 0.5 4 3.
cat >"$work/seven.json" <<'JSON'
[{"Name": "seven knots", "ColorSpace": "RGB",
  "RGBPoints": [0, 0,0,1, 1, 0,0.5,1, 2, 0,1,0.3, 3, 0.6,1,0, 4, 1,0.7,0, 5, 1,0.2,0, 6, 0.8,0,0.4],
  "Points": [0,0,0.5,0, 1,0.632,0.5,0, 2,0.181,0.5,0, 3,0.865,0.5,0, 4,0.393,0.5,0, 5,0.982,0.5,0, 6,0.95,0.5,0]}]
JSON

# chart NAME MESH OPTIONS...: the options of plume render.
chart() {
  local name=$1 mesh=$2 also=()
  shift 2
  set -- "$@" --tf "$work/seven.json"
  echo "charts.sh: $name" >&2
  if [ -x "$bin/plume_peers" ]; then
    "${on_a_screen[@]}" "$bin/plume_peers" "$mesh" "$@" --size "$size" --threads "$threads" --rounds "$rounds" ${peers_options:-} ${CHART_PEERS:-} \
      -o "$work/peers.csv" >"$work/peers.txt"
    # Its own few of ours are measured better below.
    awk -F, '$2 != "plume"' "$work/peers.csv" >"$work/others.csv"
    also=(--also "$work/others.csv")
  else
    echo "charts.sh: no $bin/plume_peers: $name WITHOUT other renderers" >&2
  fi
  "$bin/plume" chart "$mesh" "$@" --size "${size}x$size" --threads "$threads" --rounds "$rounds" "${also[@]}" \
    -o "$work/$name.png" -o "$work/$name.csv" >"$work/$name.txt"
  mv "$work/$name".{png,csv,txt} "$directory"
  [ ! -e "$work/peers.txt" ] ||
    sed "s|$work/||g; s|$datasets/||g" "$work/peers.txt" >"$directory/$name-peers.txt"
}

for name in $names; do
  case $name in
    fin-hexahedra | fin-tetrahedra)
      mesh=$datasets/bluntfin/bluntfinxyz.bin solution=$datasets/bluntfin/bluntfinq.bin
      options=(--view -y --zoom 1.5 --tf-range 0.3,4 --unit-distance 16)
      if [ "$name" = fin-tetrahedra ]; then
        "$bin/plume_cut_grid" "$mesh" "$solution" "$work/blunt-fin-tetrahedra.vtu"
        mesh=$work/blunt-fin-tetrahedra.vtu
      else
        options+=(--solution "$solution")
      fi
      chart "$name" "$mesh" "${options[@]}"
      ;;
    combustor)
      chart "$name" "$datasets/combustor/combxyz.bin" --solution "$datasets/combustor/combq.bin" \
        --tf-range 0.2,0.71 --unit-distance 16
      ;;
    box-10M)
      "$bin/plume" generate box-tetrahedra --size "${CHART_CELLS:-118}" -o "$work/box.vtu" --quiet
      # VTK's Z sweep does not end its first frame of these in five minutes.
      peers_options="--quick --limit 30 --only ray-cast,projected,locator,embree,voxels" chart "$name" "$work/box.vtu" --tf-range 0,0.87 --unit-distance 1.2
      rm "$work/box.vtu"
      ;;
    *)
      echo "charts.sh: no chart '$name'" >&2
      exit 2
      ;;
  esac
done
