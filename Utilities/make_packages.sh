#!/usr/bin/env bash
# Makes a Debian package, in packages/.
#
#   Utilities/make_packages.sh [paraview]      neuralmesh-paraview, with what is installed here
#   Utilities/make_packages.sh plain [FOLDER]  neuralmesh-vtk, in a Debian 12 of its own, as the two
#                                              VTKs exclude each other: root, and 2 GB in FOLDER
#                                              (default: build-vtk91), which the next run uses again
set -euo pipefail

repository=$(cd "$(dirname "$0")/.." && pwd)
source "$repository/Utilities/build.sh"

make_package_here()
{
  install_packages "${build_packages[@]}" "${package_packages[@]}"
  # For the 3D views of galleries.
  command -v npm > /dev/null || install_packages npm
  build build-package all
  (cd build-package && cpack -B "$repository/packages")
  rm -rf packages/_CPack_Packages
}

# make_plain_package FOLDER
make_plain_package()
{
  [ -d "$1" ] || make_debian "$1"
  enter_debian "$1"
  copy_sources "$1"
  rm -rf "$1/neuralmesh/packages"
  in_debian "$1" bash /neuralmesh/Utilities/make_packages.sh here
  mkdir -p packages
  cp "$1"/neuralmesh/packages/*.deb packages/
}

case "${1:-paraview}" in
  paraview | here)
    cd "$repository"
    make_package_here
    ;;
  plain)
    source "$repository/Utilities/debian.sh"
    in_own_namespace "$0" "$@"
    debian=$(realpath -m "${2:-$repository/build-vtk91}")
    cd "$repository"
    make_plain_package "$debian"
    ;;
  *)
    echo "$0: $1 is none of paraview and plain" >&2
    exit 2
    ;;
esac
ls -l packages
