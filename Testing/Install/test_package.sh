#!/usr/bin/env bash
# Whether cpack makes the Debian package that it should: test_package.sh BUILD SCRATCH VERSION WORLD,
# where WORLD is paraview or vtk. Utilities/test_packages.sh installs packages.
set -euo pipefail
build=$1 scratch=$2 version=$3 world=$4
name=neuralmesh-$world
revision=1~deb$(. /etc/os-release && echo "$VERSION_ID")
package=$scratch/${name}_$version-${revision}_$(dpkg --print-architecture).deb
root=$scratch/root

fail()
{
  echo "FAILED: $*"
  exit 1
}

# has FIELD TEXT: whether the text is a whole entry in a field of the package.
has()
{
  dpkg-deb -f "$package" "$1" | tr ',' '\n' | sed 's/^ *//' | grep -qE "^$2( |\$)" ||
    fail "$1 is '$(dpkg-deb -f "$package" "$1")', without $2"
}

# has_files PATH...: below /usr.
has_files()
{
  local path
  for path in "$@"; do
    [ -e "$root/usr/$path" ] || fail "no /usr/$path"
  done
}

rm -rf "$scratch"
mkdir -p "$scratch"
# Packed in haste.
(cd "$build" && cpack -B "$scratch" -D CPACK_DEBIAN_COMPRESSION_TYPE=zstd) > "$scratch/cpack.txt" 2>&1 ||
  { cat "$scratch/cpack.txt"; fail "no package"; }
dpkg-deb -x "$package" "$root"
dpkg-deb -e "$package" "$scratch/control"

# Promise: only one of the packages is there at a time, and it brings the libraries and the Python
# packages that it needs.
[ "$(dpkg-deb -f "$package" Package Version | sort)" = "$(printf 'Package: %s\nVersion: %s' \
  "$name" "$version-$revision")" ] || fail "another name or version"
has Provides 'neuralmesh \(= [0-9.]+\)'
has Conflicts neuralmesh
has Depends 'libc6'
has Depends 'python3 \(<< 3\.[0-9]+\)'
has Depends python3-numpy
has Recommends xvfb
if [ "$world" = paraview ]; then
  has Depends 'paraview \(>= 5.*'
  has Depends python3-paraview
  has Suggests paraview-dev
  has_files bin/plugins/NeuralMesh.so lib/neuralmesh/neuralmesh.plugins.xml
else
  has Depends 'libvtk9\.[0-9]+(t64)?'
  has Depends python3-vtk9
  has Suggests libvtk9-dev
fi

# Promise: all is there, where Debian looks for it, and works.
has_files bin/neuralmesh lib/libvtkFiltersNeuralMesh.so include/NeuralMesh/vtkNeuralMesh.h \
  lib/cmake/NeuralMesh/NeuralMeshConfig.cmake lib/python3/dist-packages/neuralmesh/__init__.py \
  lib/python3/dist-packages/neuralmesh/lab/step-times \
  share/man/man1/neuralmesh.1.gz share/bash-completion/completions/neuralmesh \
  share/fish/vendor_completions.d/neuralmesh.fish "share/doc/$name/copyright" \
  "share/doc/$name/changelog.gz" \
  "share/doc/$name/changelog.Debian.gz" share/doc/NeuralMesh/README.md
[ "$("$root/usr/bin/neuralmesh" --version)" = "$version" ] || fail "another version of the command"
[ "$(readelf -S "$root/usr/bin/neuralmesh" | grep -c debug)" -eq 0 ] || fail "it is not stripped"

# Promise: nothing belongs elsewhere, and nothing names the folder of the build or that of the sources.
[ -z "$(find "$root" -mindepth 1 -maxdepth 1 ! -name usr)" ] || fail "there is more than /usr"
! grep -rlF "$(realpath "$build")" "$root" || fail "these name the folder of the build"
sources=$(realpath "$(dirname "$0")/../..")
# Not where it is the end of another path, as "/neuralmesh/" may be.
! grep -rlE "(^|[^[:alnum:]_.-])$sources/" "$root" || fail "these name the folder of the sources"

# Promise: what Python compiles when the package is installed goes when it is removed.
grep -q "py3compile -p $name" "$scratch/control/postinst" || fail "nothing is compiled"
grep -q "py3clean -p $name" "$scratch/control/prerm" || fail "what was compiled stays"
