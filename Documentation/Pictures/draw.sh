#!/usr/bin/env bash
# Draws the pictures of the documentation anew, or those that are named: draw.sh [NAME...].
# draw.sh --list says which there are, and what draws each.
set -euo pipefail
cd "$(dirname "$0")/../.."

declare -A pictures=(
  [draw.py]="leap errors hard_scans details growth noise topology normals ensemble first_mesh openings
    sides orders failure_missing failure_thin failure_finer"
  [draw_charts.py]="steps sweep_moves sweep_growth sweep_noise sweep_fit"
  [draw_house.py]="rooms"
  [draw_lines.py]="feature_lines"
  [draw_bars.py]="error_bars"
  [draw_levels.py]="levels"
  [draw_tutorial.sh]="tutorial_scan tutorial_mesh tutorial_window tutorial_colours
    tutorial_distances tutorial_step12 tutorial_step17 tutorial_step23"
  [draw_pyvista.sh]="pyvista_mesh pyvista_distance pyvista_left_out"
  [draw_laboratory.sh]="laboratory_smoothing_rate laboratory_smoothing_rate_meshes
    laboratory_sparse_meshes laboratory_cost laboratory_models laboratory_jumps"
  [../../Testing/Benchmarks/peers.sh]="peers peers_meshes"
  [../../Testing/Benchmarks/scans.sh]="battery"
  [../../Testing/Benchmarks/uncertainty.sh]="reliability"
)
if [ "${1:-}" = --list ]; then
  for maker in "${!pictures[@]}"; do
    printf "$maker %s\n" ${pictures[$maker]}
  done
  exit
fi

source Utilities/build.sh
install_packages "${build_packages[@]}" glmark2-data libcgal-demo python3-matplotlib \
  "${screen_packages[@]}"
build build all
folder=Documentation/Pictures
export PYTHONPATH=build/lib/python3/dist-packages:Testing/Support:$folder

# Those of a maker that are asked for.
wanted_of()
{
  local name
  for name in ${pictures[$1]}; do
    [[ -z "$wanted" || " $wanted " == *" $name "* ]] && echo "$name" || true
  done
}

wanted=$*
for maker in draw.py draw_charts.py draw_house.py; do
  names=$(wanted_of "$maker")
  [ -z "$names" ] || xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \
    /usr/bin/python3 "$folder/$maker" "$folder" $names
done
# In ParaView, which is told where the plugin is.
for maker in draw_lines.py draw_bars.py draw_levels.py; do
  [ -z "$(wanted_of $maker)" ] ||
    PV_PLUGIN_CONFIG_FILE=$PWD/build/lib/neuralmesh/neuralmesh.plugins.xml xvfb-run -a \
      -s "-screen 0 1280x1024x24 -noreset" pvpython "$folder/$maker" "$folder"
done
# They are steps of one tutorial, and drawn together.
[ -z "$(wanted_of draw_tutorial.sh)" ] || bash "$folder/draw_tutorial.sh"
[ -z "$(wanted_of draw_pyvista.sh)" ] || bash "$folder/draw_pyvista.sh"
# Half an hour each.
[ -z "$(wanted_of draw_laboratory.sh)" ] || bash "$folder/draw_laboratory.sh"
[ -z "$(wanted_of ../../Testing/Benchmarks/peers.sh)" ] || bash Testing/Benchmarks/peers.sh
# A mesh of each kind, with seed 1. NEURALMESH_SCANS has the scans that are not made here.
[ -z "$(wanted_of ../../Testing/Benchmarks/scans.sh)" ] ||
  bash Testing/Benchmarks/scans.sh --seeds 1 --picture "$folder/battery.png" scan_bunny_r01 \
    open_sphere_60 open_bunny_2 open_bunny_15 box_0.3 plate_n01 chair_n01 coupling density_100 islands \
    kinect room building b9_training spheres hippo2 || [ $? -eq 1 ] # Some miss their goals.
# Some minutes.
[ -z "$(wanted_of ../../Testing/Benchmarks/uncertainty.sh)" ] ||
  bash Testing/Benchmarks/uncertainty.sh --seeds 1,2,3 --picture "$folder/reliability.png" "sphere*" "torus*" "bunny*" "fandisk*" ||
  [ $? -eq 1 ] # Some may miss their goals.
