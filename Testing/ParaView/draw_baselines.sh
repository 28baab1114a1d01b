#!/usr/bin/env bash
# Draws the baselines anew, by the test that compares with them. Look at them before they are committed.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" "${test_packages[@]}"
build build all -DNEURALMESH_BUILD_TESTING=ON
rm -f build/Testing/ParaView/window/*.png
# It may fail: the baseline is that of before.
ctest --test-dir build -R '^ParaView\.window$' || true
cp build/Testing/ParaView/window/mesh.png Testing/ParaView/Baselines/window.png
