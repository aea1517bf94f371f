#!/usr/bin/env bash
# The command as a user meets it: exit codes, one-line errors, files whole or not there.
#
#   command_test.sh PLUME
#
# Each check says what it expects; the last line counts them.
set -uo pipefail
plume=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
passed=0 failed=0

ok() { # description, command...
  local what=$1
  shift
  if "$@" >out.txt 2>err.txt; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $what (exit $?): $*"
    cat err.txt
  fi
}

# The command must fail with that exit code, print exactly one line on standard error that contains
# each of the words, and leave no file behind.
refused() { # description, exit code, words separated by |, command...
  local what=$1 code=$2 words=$3 before after status word
  shift 3
  before=$(ls -A)
  "$@" >out.txt 2>err.txt
  status=$?
  after=$(ls -A)
  local problem=""
  [ $status -eq "$code" ] || problem="exit $status instead of $code"
  [ "$(wc -l <err.txt)" -eq 1 ] || problem+=" not one line"
  while read -r word; do
    grep -qF -- "$word" err.txt || problem+=" no '$word'"
  done < <(tr '|' '\n' <<<"$words")
  [ "$before" = "$after" ] || problem+=" left behind: $(comm -13 <(echo "$before") <(echo "$after") | tr '\n' ' ')"
  if [ -z "$problem" ]; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $what: $problem: $*"
    cat err.txt
  fi
}

json() { # a python expression over the parsed file `j`
  python3 -c "import json,sys; j=json.load(open('$1')); sys.exit(0 if ($2) else 1)"
}

touch out.txt err.txt
ok "a mesh is made" "$plume" generate box-tetrahedra --size 6 -o box.vtu --quiet
ok "a grid is made" "$plume" generate blunt-body --size 12 -o body.vts --quiet
ok "a mixed mesh is made" "$plume" generate box-mixed --size 4 -o mixed.vtu --quiet
ok "a picture is made" "$plume" render box.vtu -o a.png --size 80x60 --stats a.json --quiet
ok "quiet is quiet" test ! -s err.txt
ok "the picture is a PNG" grep -q PNG a.png
ok "the statistics hold what they should" json a.json \
  "j['rays']==4800 and 0<j['rays_hit']<=4800 and j['lost_rays']==0 and j['cells_visited']>0 and set(j['ms'])=={'read','build','render','write','wait'} and j['peak_memory_bytes']>1e6 and 32<j['bytes_per_cell']<60 and j['field']=='radius' and j['plan']"
for mode in volume mip minip average integral optical-depth depth cells; do
  ok "mode $mode" "$plume" render body.vts --mode $mode -o $mode.png --size 40x30 --quiet
done
for integrator in closed-form table table2 midpoint reference; do
  ok "integrator $integrator" "$plume" render body.vts --integrator $integrator -o i.png --size 40x30 --quiet
done
ok "the plan says what a table costs" sh -c \
  "'$plume' render body.vts --integrator table -o i.png --size 40x30 --verbose 2>&1 |
   grep -q 'table: 8.4 MB, built in .* ms, error .* at most and .* RMS'"
for order in 1 2 3; do
  ok "order $order" "$plume" render mixed.vtu --order $order -o o$order.png --size 40x30 --stats o.json --quiet
  ok "order $order is in the statistics" json o.json "j['order']==$order"
done
ok "the order is in the plan" json o.json "any('order 3: cubic' in line for line in j['plan'])"
ok "the adaptive order" "$plume" render mixed.vtu --order adaptive -o o4.png --size 40x30 --quiet
for tolerance in 1e-2 1e-4 0; do
  ok "tolerance $tolerance" "$plume" render mixed.vtu --tolerance $tolerance -o t.png --size 40x30 --stats t.json --quiet
  ok "tolerance $tolerance is in the plan" json t.json "j['plan'][0].startswith('tolerance')"
done
ok "an order that is given stays" "$plume" render mixed.vtu --tolerance 1e-4 --order 1 -o t.png --size 40x30 --stats t.json --quiet
ok "and is said" json t.json "j['order']==1"
ok "an integrator that is given, too" "$plume" render mixed.vtu --tolerance 1e-4 --integrator midpoint -o t.png --size 40x30 --stats t.json
cp err.txt said.txt
ok "and that it does not keep to the tolerance" grep -q "does not keep to --tolerance 0.0001: its error" said.txt
ok "and by how much" json t.json "not j['tolerance']['kept'] and j['tolerance']['error_estimate']>1e-4==j['tolerance']['asked']"
ok "what keeps to it is said to" "$plume" render mixed.vtu --tolerance 1e-2 --order adaptive -o t.png --size 40x30 --stats t.json --verbose
ok "with the error of what was forced" json t.json "j['tolerance']['kept'] and 0<j['tolerance']['error_estimate']<=1e-2 and any('forced: the order, at an error of' in l for l in j['plan'])"
ok "an orbit to a tolerance" "$plume" render body.vts --orbit 12 --tolerance 1e-2 -o orbit_%d.png --size 40x30 --stats t.json --quiet
ok "keeps its plan" json t.json "sum(any('as for an earlier picture' in l for l in f['plan']) for f in j['frames'])>=6 and all(f['tolerance']['kept'] for f in j['frames'])"
refused "a tolerance that is none" 2 "tolerance" "$plume" render mixed.vtu --tolerance -1 -o x.png
ok "an EXR with channels" "$plume" render mixed.vtu -o a.exr --size 40x30 --quiet \
  --channels depth,optical_depth,cell_id,cell_count
ok "a view that begins with a minus" "$plume" render box.vtu --view -x -o v.png --size 20x20 --quiet
printf 'solid plate\nfacet normal 0 0 1\nouter loop\nvertex -1 -1 0.5\nvertex 2 -1 0.5\nvertex 0.5 3 0.5\nendloop\nendfacet\nendsolid plate\n' >plate.stl
ok "an opaque surface" "$plume" render box.vtu --surface plate.stl:0.8,0.2,0.1 -o s.png --size 40x30 --stats s.json --quiet
ok "it is in the plan" json s.json "any('opaque surfaces: 1 triangles' in line for line in j['plan']) and j['lost_rays']==0"
ok "a side of a grid" "$plume" render body.vts --wall kmin --wall jmax:1,0,0 -o s.png --size 40x30 --quiet
refused "a side of no grid" 1 "--wall 'kmin'|no curvilinear or rectilinear grid|--surface" "$plume" render box.vtu --wall kmin -o x.png --quiet
refused "a side that no grid has" 1 "--wall 'top'|imin|kmax" "$plume" render body.vts --wall top -o x.png --quiet
refused "a surface's colour that is none" 1 "--surface 'plate.stl:2,0,0'|0 to 1" "$plume" render box.vtu --surface plate.stl:2,0,0 -o x.png --quiet
refused "a surface that is not there" 1 "none.stl" "$plume" render box.vtu --surface none.stl -o x.png --quiet
# Other meshes in the same picture.
ok "three meshes" "$plume" render box.vtu --field radius --with mixed.vtu --with body.vts:pressure -o w.png --size 40x30 --stats w.json --quiet
ok "all are in the statistics" json w.json "[(o['mesh'],o['field']) for o in j['with']]==[('mixed.vtu','radius'),('body.vts','pressure')] and j['lost_rays']==0 and j['rays_overlapping']>0"
ok "and in the plan" json w.json "any('rays: one by one through 3 meshes' in line for line in j['plan'])"
ok "the first of two in one place hides the other" "$plume" render box.vtu --with mixed.vtu --overlap first -o w.png --size 40x30 --stats w.json --quiet
ok "and is said to" json w.json "any('the first of two is seen alone' in line for line in j['plan'])"
refused "meshes that overlap" 1 "mesh 'box.vtu' and mesh 'mixed.vtu' overlap|pixel|--overlap add" "$plume" render box.vtu --with mixed.vtu --overlap refuse -o x.png --size 20x20 --quiet
refused "a field that the other has not" 1 "body.vts: no field 'radius'|pressure" "$plume" render box.vtu --field radius --with body.vts -o x.png --quiet
refused "a field that neither has" 1 "box.vtu: no field 'none'" "$plume" render box.vtu --field none --with body.vts:pressure -o x.png --quiet
refused "another mesh that is not there" 1 "none.vtu" "$plume" render box.vtu --with none.vtu:radius -o x.png --quiet
refused "a tolerance of several" 1 "several meshes|tolerance" "$plume" render box.vtu --with mixed.vtu --tolerance 1e-3 -o x.png --quiet
ok "a component" "$plume" render body.vts --field velocity:0 -o f.png --size 20x20 --stats f.json --quiet
ok "the component is named" json f.json "j['field']=='velocity:0'"
ok "a magnitude" "$plume" render body.vts --field velocity:magnitude -o f.png --size 20x20 --stats f.json --quiet
ok "the magnitude is named" json f.json "j['field']=='velocity:magnitude'"
ok "cell data" "$plume" render box.vtu --field cell_radius -o f.png --size 20x20 --stats f.json --quiet
ok "the association is named" json f.json "j['field_association']=='cell'"
ok "cell data is constant in each cell" json f.json "j['cell_data']=='constant'"
ok "averaged cell data" "$plume" render box.vtu --field cell_radius --cell-data averaged --order 3 -o f.png --size 20x20 --stats f.json
cp err.txt said.txt
ok "that it is averaged is said" grep -q "cell data averaged to points" said.txt
ok "and written" json f.json "j['field_association']=='cell' and j['cell_data']=='averaged' and any('averaged to the points' in line for line in j['plan'])"
ok "a camera" "$plume" render box.vtu --camera 0.5,0.5,5,0.5,0.5,0.5,0,1,0 -o c.png --size 20x20 --quiet
ok "a camera inside" "$plume" render box.vtu --camera 0.5,0.5,0.5,1,0.6,0.7 --view-angle 80 -o c.png \
  --size 20x20 --stats c.json --quiet
ok "all rays of a camera inside hit" json c.json "j['rays_hit']==400 and j['lost_rays']==0"
ok "a preset" "$plume" render box.vtu --tf viridis -o p.png --size 20x20 --quiet
ok "info" "$plume" info mixed.vtu
ok "info as JSON" sh -c "'$plume' info mixed.vtu --json > info.json"
ok "info holds what it should" json info.json \
  "len(j['cells_by_type'])==4 and sum(j['cells_by_type'].values())==j['cells'] and j['components']==1 and j['problems']==[] and j['bounds']['high']==[1,1,1] and j['boundary_faces']>0 and j['memory_bytes']>0 and j['fields'][0]['range'][0]==0"

ok "a regular grid is made" "$plume" generate box-rectilinear --jitter 0 --size 8 -o regular.vti --quiet
ok "a rectilinear grid is made" "$plume" generate box-rectilinear --size 8 -o uneven.vtr --quiet
for grid in regular.vti uneven.vtr; do
  ok "$grid is told of" sh -c "'$plume' info $grid --json > info.json"
  ok "$grid is a rectilinear grid" json info.json \
    "j['form']=='rectilinear grid' and j['dimensions']==[9,9,9] and j['points']==729 and j['cells']==512 and j['boundary_faces']==384 and j['components']==1 and j['problems']==[] and j['memory_bytes']<5*729 and j['bounds']['high']==[1,1,1]"
  for mode in volume mip minip average integral optical-depth depth cells; do
    ok "$grid, mode $mode" "$plume" render $grid --mode $mode -o $mode.png --size 40x30 --stats g.json --quiet
    ok "no ray is lost in $grid, mode $mode" json g.json "j['rays_hit']>0 and j['lost_rays']==0"
  done
done
refused "an uneven grid as an image" 1 "x.vti|write .vtr" "$plume" generate box-rectilinear --size 8 -o x.vti
refused "a mesh of tetrahedra as a grid" 1 "x.vtr|write .vtu" "$plume" generate box-tetrahedra --size 2 -o x.vtr
{
  printf '# vtk DataFile Version 3.0\nt\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 2 3 2\n'
  printf 'X_COORDINATES 2 float\n0 1\nY_COORDINATES 3 float\n0 2 1\nZ_COORDINATES 2 float\n0 1\n'
  printf 'POINT_DATA 12\nSCALARS s float\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8 9 10 11 12\n'
} >unordered.vtk
refused "coordinates out of order" 1 "unordered.vtk|y coordinate 2 is 1 after 2|sort" "$plume" render unordered.vtk -o y.png

for name in $("$plume" generate --help | awk '/Make a mesh:/ {on = 1; next} /^Options/ {on = 0} on && NF {print $1}'); do
  ok "generate $name" "$plume" generate "$name" --size 6 -o "$name.vtu" --quiet
  for view in +x iso; do
    ok "render $name along $view" "$plume" render "$name.vtu" --view $view -o g.png --size 64x48 --stats g.json --quiet
    ok "no ray is lost in $name along $view" json g.json "j['rays_hit']>0 and j['lost_rays']==0 and j['cells_visited']>0"
  done
done

for threads in 1 2 3; do
  "$plume" render box.vtu -o t$threads.png --bits 16 --size 70x50 --threads $threads --quiet
done
ok "the same picture for any number of threads" cmp t1.png t2.png
ok "and for more of them" cmp t1.png t3.png

# Isosurfaces, intervals, light and clip planes.
ok "an isosurface and two intervals" "$plume" render body.vts --field pressure -o s.png --size 40x30 --stats s.json \
  --iso 1.5:0.5:1,0.9,0.8 --interval 2,3 --interval 5,6:0.3:1,0,0 --light head --light 1,-1,0:0.5 \
  --material 0.3,0.6,0.1,20
cp err.txt said.txt
ok "they are counted and planned" json s.json \
  "j['isosurfaces_crossed']>0 and j['interval_visits']>0 and j['lost_rays']==0 and any(l.startswith('intervals: [2, 3] [5, 6]') for l in j['plan']) and any(l.startswith('isosurfaces: 1.5') for l in j['plan']) and any(l.startswith('light: 2') for l in j['plan'])"
ok "they cost nothing where there are none" json a.json \
  "j['isosurfaces_crossed']==0 and not any(l.startswith(('intervals','isosurfaces','light','clip')) for l in j['plan'])"
for mesh in box.vtu body.vts mixed.vtu uneven.vtr; do
  ok "channels of the first hit in $mesh" "$plume" render $mesh --no-volume --iso 0.5:0.5 --interval 0.6,0.7 \
    --light head --order 3 --channels depth,normal,cell_id,isovalue -o hit.exr --size 40x30 --quiet
  ok "$mesh cut open" "$plume" render $mesh --clip 0.5,0.5,0.5,1,0,0 --clip 0,0.5,0,0,-1,0 --interval 0.3,0.7 \
    -o cut.png --size 40x30 --stats cut.json --quiet
  ok "no ray is lost in $mesh cut open" json cut.json "j['lost_rays']==0 and any(l.startswith('clip planes: 2') for l in j['plan'])"
done
ok "a negative isovalue" "$plume" render box.vtu --iso -0.25 -o s.png --size 20x20
cp err.txt said.txt
ok "outside of the range is said" grep -q -- "--iso -0.25 is outside of 'radius'" said.txt
ok "the paper's tables" "$plume" render box.vtu --interval 0.2,0.4 --interval-way table -o s.png --size 20x20 --quiet
ok "the linear form" "$plume" render box.vtu --interval 0.2,0.4 --interval-form linear -o s.png --size 20x20 --quiet
ok "light on averaged cell data" "$plume" render box.vtu --field cell_radius --cell-data averaged --iso 0.4 --light head \
  -o s.png --size 20x20 --quiet
refused "light on cell data" 1 "box.vtu|cell_radius|--cell-data averaged" "$plume" render box.vtu --field cell_radius \
  --iso 0.4 --light head -o x.png
refused "an isovalue that is none" 1 "--iso|high|VALUE" "$plume" render box.vtu --iso high -o x.png
refused "an isosurface with too many parts" 1 "--iso|1:1:1,1,1:2|VALUE" "$plume" render box.vtu --iso 1:1:1,1,1:2 -o x.png
refused "an opacity above 1" 1 "--iso '0.5:2'|opacity 2|0 to 1" "$plume" render box.vtu --iso 0.5:2 -o x.png
refused "a colour above 1" 1 "--interval '0,1:1:0,0,9'|9|0 to 1" "$plume" render box.vtu --interval 0,1:1:0,0,9 -o x.png
refused "an interval of one number" 1 "--interval '0.5'|LOW,HIGH" "$plume" render box.vtu --interval 0.5 -o x.png
refused "an interval of no width" 1 "[0.5, 0.5]|isosurface" "$plume" render box.vtu --interval 0.5,0.5 -o x.png
refused "an interval from high to low" 1 "[0.5, 0.2]|[0.2, 0.5]" "$plume" render box.vtu --interval 0.5,0.2 -o x.png
refused "an interval in another" 1 "[0.1, 0.2]|nested in [0, 0.5]" "$plume" render box.vtu --interval 0,0.5 --interval 0.1,0.2 -o x.png
refused "light by the paper's tables" 1 "from tables have no light" "$plume" render box.vtu --quiet --interval 0,0.5 --interval-way table \
  --light head -o x.png
refused "intervals that overlap" 1 "[0, 0.5]|[0.4, 0.6]|overlap" "$plume" render box.vtu --interval 0,0.5 --interval 0.4,0.6 -o x.png
refused "the same isovalue twice" 1 "two isosurfaces at 0.5" "$plume" render box.vtu --iso 0.5 --iso 0.5 -o x.png
refused "nothing to see" 1 "--no-volume|--iso" "$plume" render box.vtu --no-volume -o x.png
refused "nothing to light" 1 "--light|--iso" "$plume" render box.vtu --light head -o x.png
refused "no light on a material" 1 "--material|--light" "$plume" render box.vtu --iso 0.5 --material 1,1,1,1 -o x.png
refused "a material of three numbers" 1 "--material|1,1,1" "$plume" render box.vtu --iso 0.5 --light head --material 1,1,1 -o x.png
refused "a light from nowhere" 1 "--light '0,0,0'|direction" "$plume" render box.vtu --iso 0.5 --light 0,0,0 -o x.png
refused "a light that is none" 1 "--light 'lamp'|head" "$plume" render box.vtu --iso 0.5 --light lamp -o x.png
refused "a clip plane without a normal" 1 "--clip '0,0,0,0,0,0'|normal" "$plume" render box.vtu --clip 0,0,0,0,0,0 -o x.png
ok "a clip box" "$plume" render box.vtu --clip-box 0.2,0.2,0.2,0.8,0.7,0.6 -o s.png --size 20x20 --stats s.json --quiet
ok "is six planes" json s.json "any(l.startswith('clip planes: 6') for l in j['plan'])"
refused "a clip box inside out" 1 "--clip-box|0.8 to 0.2" "$plume" render box.vtu --clip-box 0.8,0,0,0.2,1,1 -o x.png
refused "a clip plane of three numbers" 1 "--clip '0,0,0'|6" "$plume" render box.vtu --clip 0,0,0 -o x.png
refused "the first hit of a volume" 1 "isovalue|isosurfaces" "$plume" render box.vtu --channels isovalue -o x.exr

# Series: steps in time, from a list or by a pattern, and orbits.
ok "a series is made" "$plume" generate vortex-street --steps 6 --size 16 -o street.pvd --quiet
ok "and as numbered files" "$plume" generate vortex-street --steps 11 --size 8 -o street_%d.vtu --quiet
ok "info counts the steps" sh -c "'$plume' info street.pvd --json > info.json"
ok "and says their times" json info.json "len(j['times'])==6 and j['times'][0]==0 and abs(j['times'][3]-2.5)<1e-12 and j['step']==5"
ok "info of one step" sh -c "'$plume' info 'street_%d.vtu' --time 2 --json > info.json"
ok "is of that one" json info.json "j['step']==2 and j['times']==[None]*11"
one="--tf good.json --tf-range -3,3 --unit-distance 1 --size 40x30"
printf '[{"Name":"mine","ColorSpace":"RGB","RGBPoints":[0,0,0,1,6,1,0,0],"Points":[0,0,0.5,0,6,1,0.5,0]}]' >good.json
ok "all steps" "$plume" render street.pvd --time all $one -o all_%02d.png --stats all.json
cp err.txt said.txt
ok "that the mesh stays is said" grep -q "6 pictures of 6 time steps in .* the mesh stayed 5 times" said.txt
ok "a record for each" json all.json \
  "[f['output'] for f in j['frames']]==['all_%02d.png'%i for i in range(6)] and [f['step'] for f in j['frames']]==list(range(6)) and [f['mesh_stayed'] for f in j['frames']]==[False]+5*[True] and abs(j['frames'][3]['time']-2.5)<1e-12 and all(f['lost_rays']==0 and set(f['ms'])=={'read','build','render','write','wait'} for f in j['frames'])"
for step in 0 3 5; do
  ok "step $step alone" "$plume" render street.pvd --time-step $step $one -o alone.png --quiet
  ok "is the same picture as in the series" cmp alone.png all_0$step.png
done
ok "the last by default" "$plume" render street.pvd $one -o alone.png --quiet
ok "is the last" cmp alone.png all_05.png
ok "its step and time are in the picture" grep -qa "plume:step" alone.png
ok "steps without reading ahead" "$plume" render street.pvd --time 1:5:2 --no-read-ahead $one -o some_%d.png --quiet --stats some.json
ok "are the same" cmp some_1.png all_03.png
ok "are those that were asked for" json some.json "[f['step'] for f in j['frames']]==[1,3,5]"
ok "two series side by side, and a mesh that stays" "$plume" render street.pvd --time 3: --with street.pvd:velocity --with box.vtu:radius --size 20x20 -o side_%d.png --stats side.json
ok "all three in each picture" json side.json "len(j['frames'])==3 and all([o['mesh'] for o in f['with']]==['street.pvd','box.vtu'] and f['lost_rays']==0 for f in j['frames'])"
refused "a series beside fewer steps" 1 "--with 'street.pvd:vorticity'|6 time steps beside the 1 of box.vtu" "$plume" render box.vtu --with street.pvd:vorticity -o x.png --quiet
ok "an open range" "$plume" render street.pvd --time 4: $one -o open_%d.png --quiet --stats some.json
ok "goes to the end" json some.json "[f['step'] for f in j['frames']]==[4,5]"
ok "files by a pattern, by number" "$plume" render 'street_*.vtu' --time all --size 20x20 -o p_%02d.png --stats p.json
cp err.txt said.txt
ok "are in their order" grep -q "p_10.png: step 10 (street_10.vtu)" said.txt
ok "colours are fitted to the whole range" grep -q "colours and opacity are fitted to the range of all steps" said.txt
ok "and stay in it" sh -c "! grep -q 'shows all' said.txt"
ok "a printf-like pattern" "$plume" render street_%d.vtu --time 9:10 --size 20x20 -o q_%02d.png --quiet --stats q.json
ok "finds the same" json q.json "[f['field_range'] for f in j['frames']]==[f['field_range'] for f in json.load(open('p.json'))['frames'][9:]]"
ok "a component's range is not in the headers" "$plume" render street.pvd --field velocity:1 --time all --size 20x20 -o c_%d.png
cp err.txt said.txt
ok "so colours are fitted to the first" grep -q "fitted to the first step shown" said.txt
ok "a magnitude's is" sh -c "'$plume' render street.pvd --field velocity:magnitude --time all --size 20x20 -o c_%d.png 2>&1 | grep -q 'range of all steps'"
for mode in integral depth cells; do
  ok "mode $mode of a series" "$plume" render street.pvd --field velocity --mode $mode --time all --size 20x20 -o c_%d.png --stats c.json --quiet
  ok "mode $mode keeps its shades" json c.json "all(f['gray_range']==j['frames'][0]['gray_range'] for f in j['frames'])"
done
ok "shades that are given" "$plume" render street.pvd --mode integral --gray-range -5,5 --size 20x20 -o c.png --stats c.json --quiet
ok "are taken" json c.json "j['gray_range']==[-5,5]"
ok "an orbit" "$plume" render box.vtu --orbit 4 --parallel --view -y --zoom 0.8 --size 20x20 -o o_%d.png --stats o.json --quiet
ok "is a whole turn" json o.json "[f['turn'] for f in j['frames']]==[0,90,180,270] and all(0<f['rays_hit']<400 for f in j['frames'])"
ok "its first picture's number is 0" test -s o_0.png
ok "an orbit over time" "$plume" render street.pvd --time all --orbit 12 --elevation 20 --size 20x20 -o o_%02d.png --stats o.json --quiet
ok "spreads the steps" json o.json "[f['step'] for f in j['frames']]==[i//2 for i in range(12)] and j['frames'][11]['turn']==330"
ok "averaged cells in a series" "$plume" render 'street_*.vtu' --time 0:2 --iso 0.5 --light head --size 20x20 -o l_%d.png --quiet
cp box.vtu series_0.vtu
cp mixed.vtu series_1.vtu
ok "a mesh that changes" "$plume" render 'series_?.vtu' --time all --size 20x20 -o m_%d.png --stats m.json
ok "is made anew" json m.json "[f['mesh_stayed'] for f in j['frames']]==[False,False] and j['frames'][0]['cells']!=j['frames'][1]['cells']"
rm -f alone.png some_* m_* c_* o_* p_* q_* l_*
refused "a pattern that matches nothing" 1 "wake_*.vtu|no file matches" "$plume" render 'wake_*.vtu' -o x.png
refused "a numbered pattern that matches nothing" 1 "wake_%03d.vtu|no file matches" "$plume" render wake_%03d.vtu -o x.png
refused "one name for several pictures" 1 "x.png|6 frames|%d" "$plume" render street.pvd --time all -o x.png
refused "one name for an orbit" 1 "x.png|9 frames|%d" "$plume" render box.vtu --orbit 9 -o x.png
refused "two numbers in a name" 1 "x_%d_%d.png|one %d" "$plume" render street.pvd --time all -o x_%d_%d.png
refused "a step that is not there" 1 "street.pvd|no time step 6|0 to 5" "$plume" render street.pvd --time 6 -o x.png
refused "a range beyond the end" 1 "street.pvd|no time step 9|0 to 5" "$plume" render street.pvd --time 2:9 -o x_%d.png
refused "a step that is none" 1 "--time 'noon'|FIRST:LAST" "$plume" render street.pvd --time noon -o x.png
refused "a negative step" 1 "--time '-1'|FIRST:LAST" "$plume" render street.pvd --time=-1 -o x.png
refused "a stride of nothing" 1 "--time '0:5:0'" "$plume" render street.pvd --time 0:5:0 -o x_%d.png
refused "a range from behind" 1 "--time '4:2'|first" "$plume" render street.pvd --time 4:2 -o x_%d.png
refused "an orbit too short for its steps" 1 "--orbit 5|6 time steps" "$plume" render street.pvd --time all --orbit 5 -o x_%d.png
refused "shades of a picture with colours" 1 "--gray-range|volume|--tf-range" "$plume" render street.pvd --gray-range 0,1 -o x.png
refused "shades from high to low" 1 "--gray-range '2,1'|below" "$plume" render street.pvd --mode depth --gray-range 2,1 -o x.png
refused "steps of what does not change" 1 "--steps 3|box-tetrahedra|does not change" "$plume" generate box-tetrahedra --steps 3 -o x.pvd
refused "steps under one name" 1 "x.vts|3 steps|.pvd" "$plume" generate vortex-street --steps 3 -o x.vts

# What was finished stays; what was not is not there.
cut() { # words separated by |, command: fails in step 1, after the picture of step 0
  local words=$1 word
  shift
  rm -f k_*.png
  if "$@" --size 20x20 -o k_%d.png --stats k.json --quiet >out.txt 2>err.txt; then return 1; fi
  for word in $(tr '|' ' ' <<<"$words"); do grep -qF -- "$word" err.txt || return 1; done
  [ "$(wc -l <err.txt)" -eq 1 ] && [ -s k_0.png ] && [ ! -e k_1.png ] && [ ! -e k.json ] && ! ls -A | grep -q '^\.plume'
}
legacy_step() { printf '# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\nSCALARS %s float\nLOOKUP_TABLE default\n1 2 3 4\n' "$2" >"$1"; }
legacy_step s_1.vtk heat
legacy_step s_2.vtk cold
ok "a step without the field" cut "step|1|(s_2.vtk)|'heat'|cold" "$plume" render 's_*.vtk' --time all
ok "a step without the field that was asked for" cut "s_2.vtk|heat" "$plume" render 's_*.vtk' --time all --field heat
head -c 150 s_1.vtk >s_2.vtk
ok "a step that is cut off" cut "s_2.vtk" "$plume" render 's_%d.vtk' --time all
rm -f street_0004.vts
ok "a list's file that is missing" sh -c "! '$plume' render street.pvd --field velocity:0 --time all --size 20x20 -o k_%d.png --quiet 2>err2.txt"
ok "is named with its step" grep -q "street.pvd: step 4 (time 3.3.*street_0004.vts: no such file" err2.txt
ok "what comes before it stays" test -s k_3.png -a ! -e k_4.png
rm -f k_*.png err2.txt

refused "no arguments" 2 "subcommand" "$plume"
refused "an unknown option" 2 "--colour" "$plume" render box.vtu --colour red
refused "an unknown mode" 2 "mode" "$plume" render box.vtu --mode xray
refused "an unknown kind of cell data" 2 "--cell-data|smooth|constant|averaged" "$plume" render box.vtu --cell-data smooth
refused "an unknown order" 2 "--order|cubic|1,2,3" "$plume" render box.vtu --order cubic
refused "a missing file" 1 "gone.vtu" "$plume" render gone.vtu -o x.png
refused "an unknown field" 1 "box.vtu|pressure|linear|radius|waves" "$plume" render box.vtu --field pressure -o x.png
refused "an unknown component" 1 "velocity|7|0 to 2" "$plume" render body.vts --field velocity:7 -o x.png
refused "a size of zero" 1 "0x5" "$plume" render box.vtu --size 0x5 -o x.png
refused "a size that is none" 1 "big" "$plume" render box.vtu --size big -o x.png
refused "an unknown kind of picture" 1 "x.gif" "$plume" render box.vtu -o x.gif
refused "a folder that is not there" 1 "nowhere" "$plume" render box.vtu -o nowhere/x.png
refused "a place nobody can write to" 1 "/proc/x.png" "$plume" render box.vtu -o /proc/x.png
refused "statistics that cannot be written" 1 "/proc/x.json" "$plume" render box.vtu -o x.png --stats /proc/x.json
refused "the output is checked before the mesh is read" 1 "nowhere" "$plume" render gone.vtu -o nowhere/x.png
refused "an unknown view" 1 "+q|iso" "$plume" render box.vtu --view +q -o x.png
refused "a camera with two numbers" 1 "--camera|1,2" "$plume" render box.vtu --camera 1,2 -o x.png
refused "a camera at its focal point" 1 "focal point" "$plume" render box.vtu --camera 1,1,1,1,1,1 -o x.png
refused "an unknown transfer function" 1 "mauve|viridis" "$plume" render box.vtu --tf mauve -o x.png
refused "an unknown mesh to generate" 1 "torus|box-tetrahedra" "$plume" generate torus -o x.vtu
refused "an unknown kind of mesh file" 1 "x.abc" "$plume" generate box-tetrahedra -o x.abc

printf '[{"ColorSpace":"RGB","RGBPoints":[0,0,0,1,-1,1,0,0],"Points":[0,0,0.5,0,1,1,0.5,0]}]' >unsorted.json
refused "unsorted colours" 1 "unsorted.json" "$plume" render box.vtu --tf unsorted.json -o x.png
printf '[{"ColorSpace":"RGB","RGBPoints":[0,0,0,1,1,1,0,0],"Points":[0,-0.5,0.5,0,1,1,0.5,0]}]' >negative.json
refused "negative opacity" 1 "negative.json|-0.5" "$plume" render box.vtu --tf negative.json -o x.png
printf '[{"Name":"mine","ColorSpace":"RGB","RGBPoints":[0,0,0,1,6,1,0,0],"Points":[0,0,0.5,0,6,1,0.5,0]}]' >good.json
ok "ParaView's JSON" "$plume" render box.vtu --tf good.json -o x.png --size 20x20 --quiet
rm -f x.png

head -c 700 box.vtu >short.vtu
refused "a truncated file" 1 "short.vtu" "$plume" render short.vtu -o x.png
printf 'nonsense' >nonsense.vtu
refused "a file of something else" 1 "nonsense.vtu" "$plume" render nonsense.vtu -o x.png
: >empty.vtk
refused "an empty file" 1 "empty.vtk" "$plume" render empty.vtk -o x.png

# Written in binary, for VTK's readers of text know no nan.
legacy() { # name, points, cells, cell type, scalars
  python3 - "$@" <<'PYTHON'
import struct, sys
name, points, cells, kind, scalars = sys.argv[1:]
doubles = lambda text: b''.join(struct.pack('>d', float(x)) for x in text.split())
ints = lambda text: b''.join(struct.pack('>i', int(x)) for x in text.split())
with open(name, 'wb') as f:
    f.write(b'# vtk DataFile Version 3.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n')
    f.write(doubles(points) + b'\nCELLS 1 %d\n' % len(cells.split()) + ints(cells))
    f.write(b'\nCELL_TYPES 1\n' + ints(kind))
    f.write(b'\nPOINT_DATA 4\nSCALARS s double\nLOOKUP_TABLE default\n' + doubles(scalars) + b'\n')
PYTHON
}
points="0 0 0 1 0 0 0 1 0 0 0 1"
legacy nanpoint.vtk "0 0 0 1 0 0 0 nan 0 0 0 1" "4 0 1 2 3" 10 "1 2 3 4"
refused "a point that is not finite" 1 "nanpoint.vtk|point 2|nan" "$plume" render nanpoint.vtk -o x.png
legacy badid.vtk "$points" "4 0 1 2 9" 10 "1 2 3 4"
refused "an id out of range" 1 "badid.vtk|cell 0|point 9" "$plume" render badid.vtk -o x.png
legacy surface.vtk "$points" "3 0 1 2" 5 "1 2 3 4"
refused "no volume cells" 1 "surface.vtk|volume" "$plume" render surface.vtk -o x.png
legacy nanvalue.vtk "$points" "4 0 1 2 3" 10 "1 2 3 nan"
ok "a value that is not a number" "$plume" render nanvalue.vtk -o n.png --size 20x20 --stats n.json
cp err.txt said.txt
ok "it is said" grep -q "NaN" said.txt
ok "and counted" json n.json "j['values_not_finite']==1 and j['lost_rays']==0"

# Points and surfaces become tetrahedra, where the build has the engines.
printf 'x,y,z,T\n0,0,0,1\n1,0,0,2\n0,1,0,3\n0,0,1,4\n' >four.csv
"$plume" tetrahedralize four.csv -o four.vtu --engine tetgen >out.txt 2>err.txt && tetgen=1 || tetgen=0
"$plume" tetrahedralize four.csv -o four.vtu --engine cgal >out.txt 2>err.txt && cgal=1 || cgal=0
rm -f four.vtu
cloud() { # name, expression of (i, random) for x, y, z
  python3 -c "
import math, random
random.seed(3)
r = random.random
print('x,y,z,T')
for i in range(3000):
  x, y, z = $2
  print('%r,%r,%r,%r' % (x, y, z, math.sin(3 * x) + y * z))" >"$1.csv"
}
cloud uniform "r(), r(), r()"
cloud sphere "(lambda a, z: (math.cos(a) * math.sqrt(1 - z * z), math.sin(a) * math.sqrt(1 - z * z), z))(6.2831853 * r(), 2 * r() - 1)"
cloud lattice "i % 15, i // 15 % 15, i // 225"
cloud clustered "(lambda s: (i % 5 + s * r(), s * r(), s * r()))(math.exp(-12 * r()))"
if [ $tetgen = 1 ]; then engines="tetgen"; else
  echo "SKIPPED: the build has no TetGen (PLUME_WITH_TETGEN)"
  engines=""
  refused "a build without TetGen" 1 "four.csv|no TetGen|-DPLUME_WITH_TETGEN=ON|libtet1.5-dev" \
    "$plume" tetrahedralize four.csv -o x.vtu --engine tetgen
fi
if [ $cgal = 1 ]; then engines="$engines cgal"; else
  echo "SKIPPED: the build has no CGAL (PLUME_WITH_CGAL)"
  refused "a build without CGAL" 1 "four.csv|no CGAL|-DPLUME_WITH_CGAL=ON|libcgal-dev" \
    "$plume" tetrahedralize four.csv -o x.vtu --engine cgal
fi
for engine in $engines; do
  for name in uniform sphere lattice clustered; do
    ok "$name points by $engine" "$plume" tetrahedralize $name.csv -o cloud.vtu --engine $engine --quiet
    ok "$name points by $engine are seen" "$plume" render cloud.vtu -o g.png --size 160x120 --stats g.json --quiet
    ok "no ray is lost in $name points by $engine" json g.json "j['rays_hit']>0 and j['lost_rays']==0 and j['cells']>3000 and j['field']=='T' and not any('inside out' in f or 'zero volume' in f for f in j['findings'])"
  done
done
if [ -n "$engines" ]; then
  ok "points are rendered on the way" "$plume" render uniform.csv -o g.png --size 20x20 --stats g.json
  cp err.txt said.txt
  ok "which is said" grep -q "uniform.csv: 3000 points became [0-9]* tetrahedra (by " said.txt
  ok "with their values" json g.json "j['field']=='T' and j['lost_rays']==0 and j['points']==3000"
  ok "and told of" sh -c "'$plume' info four.csv --json > info.json"
  ok "as tetrahedra" json info.json "j['cells_by_type']=={'tetrahedron':1} and any('4 points became 1 tetrahedra' in p for p in j['problems'])"
  printf '0 0 0 1\n1 0 0 2\n0 1 0 3\n1 1 0 4\n2 1 0 5\n' >flat.xyz
  refused "points in a plane" 1 "flat.xyz|all 5 points are in the plane|point 4 (2, 1, 0)" "$plume" render flat.xyz -o x.png
  refused "points on a line" 1 "line.csv|on the line|point 4" sh -c "printf '0,0,0\n1,1,1\n2,2,2\n3,3,3\n4,4,4\n' >../line.csv; '$plume' render ../line.csv -o x.png; s=\$?; rm ../line.csv; exit \$s"
  refused "three points" 1 "3 points|point 2 (0, 1, 0)|four" sh -c "printf '0,0,0\n1,0,0\n0,1,0\n' >../three.csv; '$plume' info ../three.csv; s=\$?; rm ../three.csv; exit \$s"
fi
printf 'x,y,z,T\n0,0,0,1\n1,nan,0,2\n' >nan.csv
refused "a coordinate that is no number" 1 "nan.csv|line 3|column 2 (y)|nan" "$plume" render nan.csv -o x.png
printf 'x,y,z,T\n0,0,0,hot\n' >hot.csv
refused "a value that is none" 1 "hot.csv|line 2|column 4 (T)|'hot'" "$plume" tetrahedralize hot.csv -o x.vtu
refused "the output of tetrahedra is checked first" 1 "nowhere" "$plume" tetrahedralize gone.csv -o nowhere/x.vtu
refused "an unknown engine" 2 "--engine|qhull" "$plume" tetrahedralize four.csv -o x.vtu --engine qhull
refused "quality of points" 1 "four.csv|surfaces" "$plume" tetrahedralize four.csv -o x.vtu --quality 2
refused "tetrahedra of tetrahedra" 1 "box.vtu|volume cells already" "$plume" tetrahedralize box.vtu -o x.vtu

# A box, as triangles with corners of their own; without some of them; and two that cross.
stl() { # name, skipped triangles, offsets of boxes...
  python3 - "$@" <<'PYTHON'
import sys
name, skipped, offsets = sys.argv[1], int(sys.argv[2]), map(float, sys.argv[3:])
faces = [(0,2,1),(1,2,3),(4,5,6),(5,7,6),(0,1,4),(1,5,4),(2,6,3),(3,6,7),(0,4,2),(2,4,6),(1,3,5),(3,7,5)]
with open(name, 'w') as f:
    f.write('solid box\n')
    for o in offsets:
        for face in faces[skipped:]:
            f.write('facet normal 0 0 0\nouter loop\n')
            for c in face:
                f.write('vertex %g %g %g\n' % tuple(o + (c >> a & 1) for a in range(3)))
            f.write('endloop\nendfacet\n')
    f.write('endsolid box\n')
PYTHON
}
stl box.stl 0 0
stl open.stl 1 0
stl cross.stl 0 0 0.5
if [ $tetgen = 1 ]; then
  ok "a surface is filled" "$plume" tetrahedralize box.stl -o filled.vtu --quality 2,10 --max-volume 0.001
  cp err.txt said.txt
  ok "which is said" grep -q "box.stl: 12 triangles became [0-9]* tetrahedra (by TetGen)" said.txt
  ok "and told of" sh -c "'$plume' info filled.vtu --json > info.json"
  ok "as tetrahedra of a box" json info.json "j['cells']>1000 and j['components']==1 and j['problems']==[] and j['bounds']['high']==[1,1,1]"
  refused "an open surface" 1 "open.stl|not closed|3 edges|(0, 0, 0)" "$plume" tetrahedralize open.stl -o x.vtu
  refused "a surface that intersects itself" 1 "cross.stl|intersects itself|triangle|(1, 1, 1)" "$plume" tetrahedralize cross.stl -o x.vtu
  refused "CGAL for a surface" 1 "box.stl|--engine cgal|TetGen" "$plume" tetrahedralize box.stl -o x.vtu --engine cgal
  refused "a ratio out of range" 1 "box.stl|0.5|1 to 1000" "$plume" tetrahedralize box.stl -o x.vtu --quality 0.5
  ok "a surface's points alone" "$plume" tetrahedralize box.stl -o points.vtu --points --quiet
else
  refused "a surface without TetGen" 1 "box.stl|no TetGen|-DPLUME_WITH_TETGEN=ON" "$plume" tetrahedralize box.stl -o x.vtu
fi
refused "a surface to render" 1 "box.stl|12 triangles|plume tetrahedralize" "$plume" render box.stl -o x.png

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
