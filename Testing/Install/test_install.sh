#!/usr/bin/env bash
# Whether what `cmake --install` makes can be used, wherever it is moved:
# test_install.sh BUILD SCRATCH PYTHON VERSION CASE
set -euo pipefail
build=$1 scratch=$2 python=$3 version=$4 case=$5
here=$(cd "$(dirname "$0")" && pwd)
prefix=$scratch/moved/prefix
# Nothing may come from the build, nor by a path that is set.
unset LD_LIBRARY_PATH

fail()
{
  echo "FAILED: $*"
  exit 1
}

# uses_prefix FILE: whether it finds our library in the prefix. Cases run beside each other: no file is
# shared.
uses_prefix()
{
  local libraries
  libraries=$(ldd "$1")
  grep -q "libvtkFiltersNeuralMesh.* => $(realpath "$prefix")/" <<< "$libraries" ||
    { echo "$libraries"; fail "$1 does not find its library in the prefix"; }
  ! grep -q "not found" <<< "$libraries" || { echo "$libraries"; fail "$1 lacks a library"; }
}

# Promise: the tree is installed, has its documentation and nothing that only the build needed, and no
# text in it names a folder of the build.
case_install()
{
  rm -rf "$scratch"
  mkdir -p "$scratch/moved"
  cmake --install "$build" --prefix "$scratch/first" > "$scratch/install.txt"
  mv "$scratch/first" "$prefix"
  local file
  for file in README.md LICENSE CHANGELOG.md Documentation/Research/Theory.md; do
    [ -s "$prefix/share/doc/NeuralMesh/$file" ] || fail "no $file"
  done
  [ -z "$(find "$prefix" -name '*CS.a')" ] || fail "the static library of the wrapping is there"
  # In programs, debugging information may.
  ! grep -rIlF "$(realpath "$build")" "$prefix" || fail "these name the folder of the build"
}

# Promise: find_package(NeuralMesh) gives a target that is enough to build with and to run.
case_cxx()
{
  cmake -S "$here/Consumer" -B "$scratch/consumer" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$prefix" -Dwanted_version="$version" ${VTK_DIR:+-DVTK_DIR="$VTK_DIR"}
  cmake --build "$scratch/consumer"
  uses_prefix "$scratch/consumer/consumer"
  [ "$("$scratch/consumer/consumer")" = "100 vertices" ] || fail "another answer"
}

# Promise: find_package(NeuralMesh) works in the build folder, too, without an installation.
case_build_folder()
{
  local own=$scratch/build_folder
  rm -rf "$own"
  cmake -S "$here/Consumer" -B "$own" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$build" -Dwanted_version="$version" ${VTK_DIR:+-DVTK_DIR="$VTK_DIR"}
  cmake --build "$own"
  [ "$("$own/consumer")" = "100 vertices" ] || fail "another answer"
}

# Promise: what a program's own find_package(VTK) has set stays.
case_own_vtk()
{
  local own=$scratch/own_vtk
  rm -rf "$own"
  mkdir -p "$own"
  cat > "$own/CMakeLists.txt" << 'END'
cmake_minimum_required(VERSION 3.25)
project(Own LANGUAGES C CXX)
find_package(NeuralMesh REQUIRED)
set(VTK_LIBRARIES VTK::FiltersSources)
find_package(NeuralMesh REQUIRED)
if (NOT VTK_LIBRARIES STREQUAL "VTK::FiltersSources" OR NOT TARGET NeuralMesh::FiltersNeuralMesh)
  message(FATAL_ERROR "VTK_LIBRARIES is ${VTK_LIBRARIES}")
endif ()
END
  cmake -S "$own" -B "$own/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
    ${VTK_DIR:+-DVTK_DIR="$VTK_DIR"}
}

# Promise: another minor version is refused.
case_other_version()
{
  ! cmake -S "$here/Consumer" -B "$scratch/other" -G Ninja \
    -DCMAKE_PREFIX_PATH="$prefix" -Dwanted_version=99.0 > "$scratch/other.txt" 2>&1 ||
    fail "version 99.0 was found"
  grep -q "compatible" "$scratch/other.txt" || { cat "$scratch/other.txt"; fail "another reason"; }
}

# Promise: another VTK than it was built with is refused by one clear sentence, when a program is configured
# and when one is compiled.
case_other_vtk()
{
  local fake=$scratch/other_vtk sentence="NeuralMesh was built with VTK .*, but .* build NeuralMesh with"
  rm -rf "$fake"
  mkdir -p "$fake/cmake" "$fake/include"
  echo 'set(VTK_VERSION 99.0.0)' > "$fake/cmake/vtk-config.cmake"
  ! cmake -S "$here/Consumer" -B "$fake/configured" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
    -Dwanted_version="$version" -DVTK_DIR="$fake/cmake" > "$fake/cmake.txt" 2>&1 ||
    fail "VTK 99.0 was taken"
  tr -s '\n ' ' ' < "$fake/cmake.txt" | grep -q "$sentence" ||
    { cat "$fake/cmake.txt"; fail "no sentence when it is configured"; }

  printf '#define VTK_%s_VERSION 99\n' MAJOR MINOR BUILD > "$fake/include/vtkVersionMacros.h"
  CXXFLAGS="-I$fake/include ${CXXFLAGS:-}" cmake -S "$here/Consumer" -B "$fake/compiled" -G Ninja \
    -DCMAKE_PREFIX_PATH="$prefix" -Dwanted_version="$version" ${VTK_DIR:+-DVTK_DIR="$VTK_DIR"}
  ! cmake --build "$fake/compiled" > "$fake/build.txt" 2>&1 || fail "VTK 99.0 was compiled with"
  grep -q "error: .*\"$sentence" "$fake/build.txt" ||
    { cat "$fake/build.txt"; fail "no sentence when it is compiled"; }
}

# Promise: a static library can be configured, and names no other of our targets to who links it.
case_static()
{
  local own=$scratch/static
  rm -rf "$own"
  cmake -S "$here/../.." -B "$own" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF \
    -DNEURALMESH_BUNDLE_VIEWER=OFF -DNEURALMESH_BUILD_APPLICATIONS=OFF ${VTK_DIR:+-DVTK_DIR="$VTK_DIR"}
  grep -q "add_library(NeuralMesh::FiltersNeuralMesh STATIC" "$own"/lib/cmake/NeuralMesh/NeuralMesh-targets.cmake ||
    fail "no static library"
  ! grep -E "NeuralMesh(Core|CompilerFlags)" "$own"/lib/cmake/NeuralMesh/NeuralMesh-targets.cmake ||
    fail "a target that is not installed"
}

# Promise: `import neuralmesh` works from the prefix.
case_python()
{
  export PYTHONPATH=$prefix/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}
  cd "$scratch"
  uses_prefix "$prefix/lib/python3/dist-packages/neuralmesh/vtkFiltersNeuralMesh.so"
  "$python" - "$(realpath "$prefix")" "$version" << 'END'
import math, os, sys
import neuralmesh
assert os.path.realpath(neuralmesh.__file__).startswith(sys.argv[1]), neuralmesh.__file__
assert neuralmesh.__version__ == sys.argv[2]
points = [(math.cos(i), math.sin(i), math.sin(0.1 * i)) for i in range(1000)]
assert neuralmesh.reconstruct(points, 100).GetNumberOfPoints() == 100
END
  [ "$("$python" -m neuralmesh --version)" = "$version" ] || fail "another version of the commands"
  local file
  for file in py.typed vtkFiltersNeuralMesh.pyi batch/page/index.html batch/page/viewer.js; do
    [ -e "$prefix/lib/python3/dist-packages/neuralmesh/$file" ] || fail "no $file"
  done
}

# Promise: the command works from the prefix.
case_command()
{
  uses_prefix "$prefix/bin/neuralmesh"
  [ "$("$prefix/bin/neuralmesh" --version)" = "$version" ] || fail "another version"
}

# Promise: ParaView loads the plugin from the prefix when it is told of its configuration.
case_paraview()
{
  uses_prefix "$prefix/lib/neuralmesh/NeuralMesh/NeuralMesh.so"
  cat > "$scratch/reconstruct.py" << 'END'
from paraview.simple import *
mesh = NeuralMesh(Input=NeuralMeshScan(Input=Sphere(), NumberOfPoints=1000), NumberOfVertices=50)
mesh.UpdatePipeline()
assert mesh.GetDataInformation().GetNumberOfPoints() == 50
END
  PV_PLUGIN_CONFIG_FILE=$prefix/lib/neuralmesh/neuralmesh.plugins.xml \
    pvpython "$scratch/reconstruct.py"
}

"case_$case"
