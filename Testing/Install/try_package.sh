#!/usr/bin/env bash
# Installs a package in a bare Debian, uses all that is in it, and removes it; as root, as
# Utilities/test_packages.sh does it: try_package.sh PACKAGE.deb
set -euo pipefail
package=$1
here=$(cd "$(dirname "$0")" && pwd)
name=$(dpkg-deb -f "$package" Package)
version=$(dpkg-deb -f "$package" Version | sed 's/-[^-]*$//')
cd "$(mktemp -d)"

fail()
{
  echo "FAILED: $name: $*"
  exit 1
}

# install PACKAGE...: these and what they depend on, no more.
install()
{
  apt-get install -y -qq --no-install-recommends "$@" > apt.txt 2>&1 ||
    { cat apt.txt; fail "cannot install $*"; }
}

# The packages in a field of the package.
field()
{
  dpkg-deb -f "$package" "$1" | tr -d ','
}

apt-get update -qq
install man-db
install "$package"
awk 'BEGIN { srand(1); for (i = 0; i < 20000; ++i) { a = 6.2832 * rand(); b = 6.2832 * rand()
  print (3 + cos(b)) * cos(a), (3 + cos(b)) * sin(a), sin(b) + 0.02 * rand() } }' > torus.xyz

# Promise: the command works, and its manual is there.
[ "$(neuralmesh --version)" = "$version" ] || fail "another version of the command"
neuralmesh reconstruct torus.xyz torus.ply --vertices 1000
neuralmesh info torus.ply > info.txt
cat info.txt
grep -Eq '^ +vertices +1000$' info.txt || fail "another number of vertices"
grep -Eq '^ +genus +1$' info.txt || fail "another shape"
man -w neuralmesh
man neuralmesh | grep -q -- --vertices || fail "no manual"

# Promise: so does the Python package, and no Python writes beside it what would stay.
/usr/bin/python3 - "$version" << 'END'
import sys, numpy, neuralmesh
assert neuralmesh.__version__ == sys.argv[1], neuralmesh.__version__
mesh = neuralmesh.reconstruct(numpy.loadtxt("torus.xyz"), vertices=300)
assert mesh.GetNumberOfPoints() == 300
print("Python     ", neuralmesh.__file__)
END

# Promise: ParaView has the plugin without being told of it.
if [ "$name" = neuralmesh-paraview ]; then
  cat > plugin.py << 'END'
from paraview.simple import *
scan = NeuralMeshScan(Input=Sphere(), NumberOfPoints=1000)
mesh = NeuralMesh(Input=scan, NumberOfVertices=50)
mesh.UpdatePipeline()
assert mesh.GetDataInformation().GetNumberOfPoints() == 50
print("ParaView   ", GetParaViewVersion())
END
  pvpython plugin.py
fi

# Promise: galleries have pictures with the packages that are recommended.
read -ra recommended < <(field Recommends)
install "${recommended[@]}"
echo '{"scans": ["torus.xyz"], "matrix": {"vertices": 300}}' > jobs.json
/usr/bin/python3 -m neuralmesh batch jobs.json
[ -n "$(find jobs-results -name '*.png')" ] || fail "a gallery without pictures"

# Promise: a program in C++ can be built with the packages that are suggested.
read -ra suggested < <(field Suggests)
install "${suggested[@]}"
cmake -S "$here/Consumer" -B consumer -Dwanted_version="$version" > cmake.txt 2>&1 ||
  { cat cmake.txt; fail "find_package does not find it"; }
cmake --build consumer > cmake.txt 2>&1 || { cat cmake.txt; fail "a program cannot be built"; }
[ "$(consumer/consumer)" = "100 vertices" ] || fail "another answer of the program"

# Promise: so can the laboratory be used.
/usr/bin/python3 -m neuralmesh.lab cube steps --quick > lab.txt 2>&1 ||
  { cat lab.txt; fail "no laboratory"; }

# Promise: nothing is left of it, but for what man keeps of any manual that was read.
apt-get purge -y -qq "$name" > apt.txt 2>&1 || { cat apt.txt; fail "cannot be removed"; }
rm -rf "$PWD" "$package"
left=$(find / -xdev \( -path "$here" -o -path /var/cache/man \) -prune -o -iname '*neuralmesh*' -print)
[ -z "$left" ] || fail "this is left: $left"
[ ! -e /usr/bin/plugins ] || fail "/usr/bin/plugins is left"
echo "$name $version: all well"
