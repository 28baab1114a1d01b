#!/usr/bin/env bash
# Draws the pictures of the page for ParaView anew, by doing what it says.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" glmark2-data imagemagick libqt5svg5 "${screen_packages[@]}"
build build all
export PV_PLUGIN_CONFIG_FILE=$PWD/build/lib/neuralmesh/neuralmesh.plugins.xml
pictures=$PWD/Documentation/Pictures
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython "$pictures/tutorial.py" "$folder"

# The window of ParaView: it is there once nothing changes any more.
xvfb-run -a -s "-screen 0 1280x800x24 -noreset" bash -s "$pictures" "$folder" <<'EOS'
  paraview --dr --script="$1/window.py" -qwindowgeometry 1280x800+0+0 &
  sleep 20
  import -window root "$2/tutorial_window.png"
  kill $!
EOS

# Few colours are enough, and make small files.
for picture in "$folder"/tutorial_*.png; do
  convert "$picture" +dither -colors 64 -define png:compression-level=9 "$pictures/${picture##*/}"
done
