#!/usr/bin/env bash
# Installs what is missing, builds, and makes meshes of three real scans that come with Debian
# packages. Meshes and pictures go to demo/.
set -euo pipefail
cd "$(dirname "$0")"
source Utilities/build.sh

# The icons of ParaView, which comes without what draws them: Qt 5 on Debian 12, Qt 6 on Debian 13.
icons=()
case $(. /etc/os-release && echo "${VERSION_ID:-}") in
  12) icons=(libqt5svg5) ;;
  13) icons=(qt6-svg-plugins) ;;
esac
install_packages "${build_packages[@]}" libcgal-demo glmark2-data "${screen_packages[@]}" "${icons[@]}"
build build all

mkdir -p demo
if [ ! -e demo/kitten.xyz ] || [ ! -e demo/building.ply ]; then
  tar -xzf /usr/share/doc/libcgal-dev/data.tar.gz -C demo --strip-components=2 \
    data/points_3/kitten.xyz data/points_3/building.ply
fi

# show NAME POINTS VERTICES VIEW...: reconstructs, measures and draws.
show()
{
  local name=$1 points=$2 vertices=$3
  shift 3
  echo
  echo "$name: $points"
  build/bin/neuralmesh reconstruct "$points" "demo/$name-mesh.ply" --vertices "$vertices"
  xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" /usr/bin/python3 Applications/Demo/show.py \
    "$points" "demo/$name-mesh.ply" "demo/$name.png" "$@"
}

show kitten demo/kitten.xyz 2000 --up y --azimuth 200
show bunny /usr/share/glmark2/models/bunny.obj 5000 --up y --azimuth 30
# A scene: open, in pieces, and much sparser here than there.
echo
echo "The next scan has gaps and parts with few points: warnings tell where its mesh is a guess."
show building demo/building.ply 20000 --up z --azimuth 30
