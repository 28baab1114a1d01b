#!/usr/bin/env bash
# Prints our meshes beside those of Open3D, CGAL and VTK's own filters: the tables and the picture of
# Documentation/Peers.md. What is not to be had is left out, with a word.
#
#   peers.sh [--rounds N] [CLOUD,REFERENCE,noisy|clean]...
#
# Half an hour.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libcgal-demo python3-matplotlib
for package in python3-open3d libcgal-dev; do
  (install_packages "$package") || echo "$package cannot be installed" >&2
done
build build neuralmesh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
g++ -O3 -DNDEBUG -std=c++17 -I/usr/include/eigen3 -DCGAL_EIGEN3_ENABLED \
  Testing/Benchmarks/Peers/CgalSurface.cpp -o "$folder/CgalSurface" -lgmp -lmpfr ||
  echo "CGAL's surfaces cannot be built" >&2
picture=Documentation/Pictures/peers.png
case " $* " in *,*) picture=- ;; esac # the picture is of our own clouds
/usr/bin/python3 Testing/Benchmarks/Peers/compare.py build/bin/neuralmesh "$folder" "$folder" \
  "$picture" "$@"
