# Sourced by demo.sh and test.sh: installs what is missing and builds. Debian 12 or 13, root or sudo.

# For what is drawn where there is no screen.
screen_packages=(xvfb xauth libgl1-mesa-dri)

is_installed()
{
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# NEURALMESH_VTK says which VTK to install: ParaView's, or with `plain` or `clang` Debian's own, which
# excludes the other. Unless it says so, apt does not remove what other programs are built with.
kept_vtk=
if [ -z "${NEURALMESH_VTK:-}" ] && { is_installed libvtk9-dev || is_installed python3-vtk9; }; then
  NEURALMESH_VTK=plain
  kept_vtk="Debian's VTK is kept. NEURALMESH_VTK=paraview replaces it, for the plugin of ParaView"
fi
if [[ "${NEURALMESH_VTK:-paraview}" =~ ^(plain|clang)$ ]]; then
  vtk_packages=(libvtk9-dev python3-vtk9 libpython3-dev libeigen3-dev)
else
  vtk_packages=(paraview-dev python3-paraview libpython3-dev libopenmpi-dev openmpi-bin)
fi
# For the Debian package; for pip, manual pages and completions, which tests try.
package_packages=(dpkg-dev file)
# For the laboratory: what it draws with, and the models of its experiments.
laboratory_packages=(python3-matplotlib libcgal-demo glmark2-data)
test_packages=(libgtest-dev doxygen "${laboratory_packages[@]}" "${screen_packages[@]}"
  "${package_packages[@]}" python3-pip python3-venv man-db fish)
# For the nightly tests: the 3D views of galleries. npm brings four hundred packages, and may have come in
# another way than by that of Debian.
night_packages=(chromium chromium-driver python3-selenium)
command -v npm > /dev/null || night_packages+=(npm)
compiler=g++
if [ "${NEURALMESH_VTK:-}" = clang ]; then
  compiler=clang
  export CC=clang CXX=clang++
fi
build_packages=("$compiler" cmake ninja-build "${vtk_packages[@]}" libcli11-dev
  nlohmann-json3-dev python3-numpy)

# Installs those of the given Debian packages that are missing.
install_packages()
{
  local missing=() package
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  [ "${#missing[@]}" -gt 0 ] || return 0
  echo "Installing: ${missing[*]}"
  local as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  "${as_root[@]}" apt-get update -qq
  # Another apt may run, as automatic updates do on a new machine.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -o DPkg::Lock::Timeout=600 install -y -qq --no-install-recommends "${missing[@]}"
}

# Fetches nanobind from PyPI, if it is reached, and tells CMake of it: fetch_nanobind FOLDER. Without it the
# engine for Python is not built, and its tests are not there.
fetch_nanobind()
{
  local tools=$PWD/$1-tools
  [ -d "$tools/nanobind" ] ||
    PIP_ROOT_USER_ACTION=ignore /usr/bin/python3 -m pip install --quiet --retries 1 --target "$tools" 'nanobind>=2.9,<4' ||
    { echo "PyPI is not reached: what pip installs is not built, nor tested"; return 0; }
  engine_options=(-DNEURALMESH_BUILD_ENGINE=ON "-Dnanobind_DIR=$tools/nanobind/cmake")
}
engine_options=()

# Configures if there is need: configure FOLDER [CMAKE-OPTION...]. Some sources at a time are compiled,
# in half of the time; presets agree, so that a folder is not built twice.
configure()
{
  local folder=$1
  shift
  # Where all is built anew, larger units take less time.
  [ -z "${CI:-}" ] || set -- -DCMAKE_UNITY_BUILD_BATCH_SIZE=24 "$@"
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON "$@" \
    > "$folder.log" 2>&1 || { cat "$folder.log"; return 1; }
  # What is left out, and why.
  grep '^-- Galleries' "$folder.log" || true
  rm -f "$folder.log"
  [ -z "$kept_vtk" ] || echo "$kept_vtk"
}

# Configures if there is need, by a preset: configure_preset NAME.
configure_preset()
{
  local log
  log=$(cmake --preset "$1" 2>&1) || { echo "$log"; return 1; }
}

# Configures if there is need, and builds: build FOLDER TARGET [CMAKE-OPTION...].
build()
{
  local folder=$1 target=$2
  shift 2
  configure "$folder" "$@"
  cmake --build "$folder" --target "$target"
}
