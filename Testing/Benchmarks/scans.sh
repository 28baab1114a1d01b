#!/usr/bin/env bash
# Prints the battery of scans: what is to be reached on each, what is reached, and whether it is met.
#
#   scans.sh [--seeds 1,2,3,4,5] [--data FOLDER] [--before COMMAND] [--picture FILE] [--list] [ROW...]
#
# ROW is a row, a cloud or a pattern of either; `--list` names them. The worst of the seeds counts; 20,000
# vertices, or a fifth of the points where that is less; no parameter touched. Figures: measure.py in scans/.
# Clouds are made or come from Debian packages, but for those of the same names in FOLDER (NEURALMESH_SCANS):
# CLOUD.ply, CLOUD_reference.ply, CLOUD.npz with `view` and `eyes`. What is to be had from neither is "not here".
# The row `fit` is held against what the command of an earlier build reaches, over the seeds 1 to 10.
# --picture draws the meshes of the first seed from two sides, back faces in red.
# What was measured with the same build is not measured again: a run that is broken off goes on where it was.
# NEURALMESH names a command to use in place of that of this tree. Exit status 1: a row misses its goal.
# Some hours for all.
set -euo pipefail
data=${NEURALMESH_SCANS:+$(realpath "$NEURALMESH_SCANS")}
command=${NEURALMESH:+$(realpath "$NEURALMESH")}
options=() rows=() picture='' seed=1
while [ $# -gt 0 ]; do
  case $1 in
    --data) data=$(realpath "$2") && shift ;;
    --seeds) options+=(--seeds "$2") && seed=${2%%,*} && shift ;;
    --before) options+=(--before "$(realpath "$2")") && shift ;;
    --picture) picture=$(realpath "$2") && shift ;;
    --list) options+=(--list) ;;
    -*) echo "$0: unknown option $1" >&2 && exit 2 ;;
    *) rows+=("$1") ;;
  esac
  shift
done
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libcgal-demo glmark2-data "${screen_packages[@]}" >&2
if [ -z "$command" ]; then
  build build neuralmesh >&2
  command=build/bin/neuralmesh
fi
scans=Testing/Benchmarks/scans work=build/scans
export PYTHONPATH=Testing/Support:$scans PYTHONDONTWRITEBYTECODE=1
status=0
/usr/bin/python3 "$scans/table.py" "$command" "$work" --data "$data" "${options[@]}" "${rows[@]}" || status=$?
if [ -n "$picture" ] && [ "$status" -le 1 ]; then
  meshes=()
  while read -r _ name; do
    [ ! -e "$work/${name}_seed_$seed.ply" ] || meshes+=("$work/${name}_seed_$seed.ply")
  done < <(/usr/bin/python3 "$scans/table.py" "$command" "$work" --list "${rows[@]}")
  Testing/Support/with_screen.sh /usr/bin/python3 "$scans/pictures.py" "$picture" "${meshes[@]}"
fi
exit "$status"
