#!/usr/bin/env bash
# Tries the wheels of packages/ in fresh virtual environments, and prints a table.
#
#   Utilities/test_wheels.sh [WORLD...]        with the Python of this Debian; all worlds without an argument
#   Utilities/test_wheels.sh on SUITE          in a Debian of its own that has nothing but Python
#
# Worlds: none (NumPy alone), vtk (the newest), pyvista (with vtk), cvista (PyVista on the fork alone), old (VTK
# 9.2, Python 3.11), source (the source distribution, compiled by g++), paraview (that of Debian: pvpython,
# pvbatch, and the window, whose picture goes to packages/).
set -euo pipefail

repository=$(cd "$(dirname "$0")/.." && pwd)
source "$repository/Utilities/build.sh"
all_worlds=(none vtk pyvista cvista old source paraview)

# What pip installs beside the wheel: brings WORLD.
brings()
{
  case $1 in
    none | source | paraview) ;;
    vtk) echo vtk ;;
    pyvista) echo pyvista ;;
    cvista) echo pyvista cvista ;;
    old) echo 'vtk==9.2.*' 'numpy<2' ;;
  esac
}

# The tests of a world: tests_of WORLD.
tests_of()
{
  local tests=(wheel command files batch batch_recipe)
  case $1 in
    vtk | old)
      tests+=(checkpoint compare explain orientation parameters pipeline progress reconstruct stream)
      ;;
    pyvista) tests+=(reconstruct pyvista) ;;
    cvista) tests=(wheel command files pyvista) ;;
    paraview) tests=() ;;
  esac
  echo "${tests[@]}"
}

# try_paraview VENV: the plugin of the environment, in Debian's ParaView.
try_paraview()
{
  local venv=$1 script=$repository/Testing/ParaView/wheel_in_paraview.py picture
  install_packages paraview python3-paraview xvfb xauth libgl1-mesa-dri
  # ParaView 5.11 asks for a function that Python 3.11 has no more.
  mkdir "$venv/argspec"
  printf 'import inspect\n\nif not hasattr(inspect, "getargspec"):\n    inspect.getargspec = inspect.getfullargspec\n' \
    > "$venv/argspec/sitecustomize.py"
  export PYTHONPATH=$venv/argspec NEURALMESH_PLUGIN
  NEURALMESH_PLUGIN=$("$venv/bin/neuralmesh" paraview --path)
  local way status=0
  picture=$repository/packages/paraview-$(pvpython --version 2>&1 | grep -oE '[0-9.]+$').png
  for way in pvpython pvbatch 'paraview --script'; do
    local command=($way "$script")
    [ "$way" != 'paraview --script' ] ||
      command=(env "NEURALMESH_PICTURE=$picture" xvfb-run -a -s "-screen 0 1280x1024x24 -noreset"
        paraview "--script=$script")
    if timeout 300 "${command[@]}" > "$venv/paraview.log" 2>&1 && grep -q '^well' "$venv/paraview.log"; then
      printf '%-8s %-14s well   %s\n' paraview "${way%% *}" "$(pvpython --version 2>&1 | tail -n 1)"
    else
      printf '%-8s %-14s FAILED\n' paraview "${way%% *}"
      cat "$venv/paraview.log" >&2
      status=1
    fi
  done
  return $status
}

# try_world WORLD: prints a line for each test.
try_world()
{
  local world=$1 venv python test what status=0
  venv=$scratch/$world
  /usr/bin/python3 -m venv "$venv"
  python=$venv/bin/python
  what=$(ls packages/neuralmesh-*"$(tag)"*.whl)
  if [ "$world" = source ]; then
    install_packages g++ python3-dev
    what=$(ls packages/neuralmesh-*.tar.gz)
  fi
  # shellcheck disable=SC2046 # words
  "$python" -m pip install --quiet "$what" mypy $(brings "$world")
  [ "$world" != cvista ] || "$python" -m pip uninstall --quiet --yes vtk
  if [ "$world" = paraview ]; then
    (try_paraview "$venv") || status=1
  fi
  for test in $(tests_of "$world"); do
    if (cd "$venv" && NEURALMESH_WORLD=$world NEURALMESH_TEST_PYTHON=$python \
      PYTHONPATH=$repository/Testing/Python:$repository/Testing/Support \
      "$python" "$repository/Testing/Python/test_$test.py" > "$test.log" 2>&1); then
      printf '%-8s %-14s well   %s\n' "$world" "$test" "$(tail -n 1 "$venv/$test.log")"
    else
      printf '%-8s %-14s FAILED %s\n' "$world" "$test" "$(tail -n 1 "$venv/$test.log")"
      cat "$venv/$test.log" >&2
      status=1
    fi
  done
  rm -rf "$venv"
  return $status
}

# Of the wheel that this Python takes.
tag()
{
  /usr/bin/python3 -c 'import sys; print("cp311-cp311" if sys.version_info < (3, 12) else "cp312-abi3")'
}

try_here()
{
  local world failed=0
  # However this ends, no environment is left.
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  install_packages python3-venv
  for world in "${@:-${all_worlds[@]}}"; do
    # There is no such VTK for other versions of Python.
    if [ "$world" = old ] && [ "$(tag)" != cp311-cp311 ]; then
      printf '%-8s %s\n' old "not for this Python"
      continue
    fi
    try_world "$world" || failed=1
  done
  return $failed
}

cd "$repository"
if [ "${1:-}" = on ]; then
  source Utilities/debian.sh
  in_own_namespace "$0" "$@"
  require_suite_and_world "$0" "${2:-}" plain
  debian=$repository/build-$2-bare
  rm -rf --one-file-system "$debian"
  make_debian "$2" "$debian"
  enter_debian "$debian"
  copy_sources "$debian"
  cp -r packages "$debian/neuralmesh/"
  status=0
  in_debian "$debian" plain bash /neuralmesh/Utilities/test_wheels.sh "${@:3}" || status=1
  cp "$debian"/neuralmesh/packages/*.png packages/ 2> /dev/null || true
  leave_debian "$debian"
  rm -rf --one-file-system "$debian"
  exit $status
fi
try_here "$@"
