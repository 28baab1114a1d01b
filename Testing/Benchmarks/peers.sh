#!/usr/bin/env bash
# Prints our meshes beside those of Open3D, PyMeshLab, PoissonRecon and CGAL on easy and hard clouds: the tables and
# the pictures of Documentation/Research/Peers.md. What is not to be had is left out, with a word.
#
#   peers.sh [CLOUD...]
#
# The clouds are those of Peers/settings.py, the pictures are drawn where none is named. The others come from PyPI
# into a virtual environment, PYTHON (python3) with 3.9 to 3.13; CGAL comes from Debian. All is in build/peers; what
# is there from the same programs is not made again, so that a run that is broken off goes on where it was.
# NEURALMESH names a command to use in place of that of this tree.
# Half an hour of CPU time, and ten minutes for compiling PoissonRecon.
set -euo pipefail
command=${NEURALMESH:+$(realpath "$NEURALMESH")}
cd "$(dirname "$0")/../.."
source Utilities/build.sh

# What Open3D loads, and what PoissonRecon is compiled with.
install_packages "${build_packages[@]}" libcgal-demo glmark2-data python3-matplotlib "${screen_packages[@]}" \
  python3-venv libusb-1.0-0 libgomp1 zlib1g-dev libpng-dev libjpeg-dev >&2
(install_packages libcgal-dev >&2) || echo "CGAL cannot be installed" >&2
if [ -z "$command" ]; then
  build build neuralmesh >&2
  command=build/bin/neuralmesh
fi
peers=Testing/Benchmarks/Peers tools=$PWD/build/peers
mkdir -p "$tools"
if [ ! -e "$tools/requirements.txt" ] || ! cmp -s "$peers/requirements.txt" "$tools/requirements.txt"; then
  "${PYTHON:-python3}" -m venv "$tools/venv"
  if "$tools/venv/bin/pip" install -q -r "$peers/requirements.txt" >&2; then
    cp "$peers/requirements.txt" "$tools/"
  else
    rm -rf "$tools/venv"
    echo "what is on PyPI cannot be installed" >&2
  fi
fi
[ "$tools/CgalSurface" -nt "$peers/CgalSurface.cpp" ] ||
  g++ -O3 -DNDEBUG -std=c++17 -I/usr/include/eigen3 -DCGAL_EIGEN3_ENABLED "$peers/CgalSurface.cpp" \
    -o "$tools/CgalSurface" -lgmp -lmpfr ||
  echo "CGAL's surfaces cannot be built" >&2
pictures=()
[ $# -gt 0 ] || pictures=(--chart Documentation/Pictures/peers.png --meshes Documentation/Pictures/peers_meshes.png)
export PYTHONPATH=Testing/Support:Testing/Benchmarks/scans PYTHONDONTWRITEBYTECODE=1
Testing/Support/with_screen.sh /usr/bin/python3 "$peers/compare.py" "$command" "$tools" "$tools/work" \
  "${pictures[@]}" "$@"
