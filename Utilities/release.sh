#!/usr/bin/env bash
# Releases the version that stands in the project() call of CMakeLists.txt.
#
#   Utilities/release.sh                        checks all, makes the packages of both Debians and both
#                                               VTKs, the wheels and the source distribution in packages/,
#                                               and the tag; root, for Debians of their own
#   Utilities/release.sh --check [BUILD [PACKAGE...]]
#                                               only tells whether the version agrees: in the files, in
#                                               what was built in BUILD, and in packages
set -euo pipefail
cd "$(dirname "$0")/.."
version=$(sed -nE 's/^project\(NeuralMesh VERSION ([0-9]+\.[0-9]+\.[0-9]+) .*/\1/p' CMakeLists.txt)
disagree=0
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail()
{
  echo "$0: $*" >&2
  exit 1
}

# agrees PLACE FOUND [WANTED]: prints it, and remembers if it is another one than the version.
agrees()
{
  printf '%-43s %s\n' "$1" "${2:-none}"
  [ "$2" = "${3:-$version}" ] || { echo "  is not ${3:-$version}"; disagree=1; }
}

# The newest section of the changelog that has a number, with its date.
newest_section()
{
  sed -nE 's/^## \[([0-9.]+)\] - [0-9]{4}-[0-9]{2}-[0-9]{2}$/\1/p' CHANGELOG.md | head -n 1
}

plugin_version()
{
  PV_PLUGIN_CONFIG_FILE=$(realpath "$1")/lib/neuralmesh/neuralmesh.plugins.xml pvpython /dev/stdin << 'END'
from paraview.modules.vtkRemotingCore import vtkPVPluginsInformation, vtkPVPluginTracker
import paraview.simple
plugins = vtkPVPluginsInformation()
plugins.CopyFromObject(vtkPVPluginTracker.GetInstance())
for i in range(plugins.GetNumberOfPlugins()):
    if plugins.GetPluginName(i) == "NeuralMesh":
        print(plugins.GetPluginVersion(i))
END
}

check_files()
{
  agrees CMakeLists.txt "$version"
  agrees CHANGELOG.md "$(newest_section)"
  local page=Documentation/Guide/Start.md
  agrees "$page, find_package" \
    "$(sed -nE 's/^find_package\(NeuralMesh ([0-9.]+) .*/\1/p' "$page")" "${version%.*}"
}

# check_build BUILD
check_build()
{
  local build=$1
  agrees "the command" "$("$build/bin/neuralmesh" --version)"
  agrees "its manual" \
    "$(sed -nE 's/^\.TH .*"NeuralMesh ([0-9.]+)".*/\1/p' "$build/share/man/man1/neuralmesh.1")"
  if [ -d "$build/lib/python3" ]; then
    agrees "the Python package" "$(PYTHONPATH=$build/lib/python3/dist-packages /usr/bin/python3 \
      -c 'import neuralmesh; print(neuralmesh.__version__)')"
  fi
  if [ -d "$build/lib/neuralmesh" ]; then
    agrees "the ParaView plugin" "$(plugin_version "$build")"
  fi
}

# Of a .deb, a wheel or a source distribution, by its content: version_in PACKAGE.
version_in()
{
  case $1 in
    *.deb) dpkg-deb -f "$1" Version | sed 's/-[^-]*$//' ;;
    *.whl) python3 -m zipfile -e "$1" "$scratch" && cat "$scratch"/neuralmesh-*.dist-info/METADATA ;;
    *.tar.gz) tar -xzOf "$1" --wildcards '*/PKG-INFO' ;;
  esac | sed -nE 's/^Version: //; /^[0-9][0-9.]*$/{p;q}'
}

# check [BUILD [PACKAGE...]]
check()
{
  local package
  check_files
  [ $# -eq 0 ] || check_build "$1"
  for package in "${@:2}"; do
    rm -rf "$scratch"/*
    agrees "$(basename "$package")" "$(version_in "$package")"
  done
  [ "$disagree" -eq 0 ] || fail "the version does not agree"
}

if [ "${1:-}" = --check ]; then
  check "${@:2}"
  exit
fi
[ $# -eq 0 ] || fail "there is no $1"
[ -z "$(git status --porcelain)" ] || fail "there are changes that are not committed"
[ -z "$(git tag --list "v$version")" ] || fail "there is a tag v$version already"
[ -z "$(sed '1,/^## \[Unreleased\]/d; /^## /,$d' CHANGELOG.md | tr -d '[:space:]')" ] ||
  fail "CHANGELOG.md has changes that are not released"
rm -rf packages
bash Utilities/make_packages.sh
rm -rf packages
bash Utilities/make_packages.sh all
bash Utilities/make_wheels.sh all
check build-package packages/*.deb packages/*.whl packages/*.tar.gz
git tag --annotate "v$version" --message "NeuralMesh $version"
echo "Tagged v$version; packages are in packages/"
