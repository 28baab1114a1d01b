#!/usr/bin/env bash
# Makes a Debian package, in packages/.
#
#   Utilities/make_packages.sh                 with what is installed here
#   Utilities/make_packages.sh SUITE WORLD     in a Debian of its own: SUITE is bookworm or trixie, WORLD is
#                                              paraview (neuralmesh-paraview) or plain (neuralmesh-vtk); root,
#                                              and 3 GB in build-SUITE-WORLD, which the next run uses again
#   Utilities/make_packages.sh all             these four
#
# Each package is looked through by lintian, which is to find nothing.
set -euo pipefail

repository=$(cd "$(dirname "$0")/.." && pwd)
source "$repository/Utilities/build.sh"

make_package_here()
{
  install_packages "${build_packages[@]}" "${package_packages[@]}" lintian
  # For the 3D views of galleries.
  command -v npm > /dev/null || install_packages npm
  build build-package all
  (cd build-package && cpack -B "$repository/packages")
  rm -rf packages/_CPack_Packages
  local package
  package=$(ls -t packages/*.deb | head -n 1)
  lintian --allow-root --fail-on error,warning "$package"
  echo "lintian: nothing in $(basename "$package")"
}

# make_package_on SUITE WORLD
make_package_on()
{
  local debian=$repository/build-$1-$2
  [ -d "$debian" ] || make_debian "$1" "$debian"
  enter_debian "$debian"
  copy_sources "$debian"
  rm -rf "$debian/neuralmesh/packages"
  in_debian "$debian" "$2" bash /neuralmesh/Utilities/make_packages.sh
  leave_debian "$debian"
  mkdir -p packages
  cp "$debian"/neuralmesh/packages/*.deb packages/
}

cd "$repository"
if [ $# -eq 0 ]; then
  make_package_here
else
  source Utilities/debian.sh
  in_own_namespace "$0" "$@"
  if [ "$*" = all ]; then
    for suite in "${suites[@]}"; do
      make_package_on "$suite" paraview
      make_package_on "$suite" plain
    done
  else
    require_suite_and_world "$0" "$1" "${2:-}"
    make_package_on "$1" "$2"
  fi
fi
ls -l packages
