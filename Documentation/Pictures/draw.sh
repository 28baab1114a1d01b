#!/usr/bin/env bash
# Draws the pictures of the documentation anew, or those that are named: draw.sh [NAME...].
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" glmark2-data libcgal-demo "${screen_packages[@]}"
build build all
PYTHONPATH=build/lib/python3/dist-packages:Testing/Support xvfb-run -a \
  /usr/bin/python3 Documentation/Pictures/draw.py Documentation/Pictures "$@"
