#!/usr/bin/env bash
# Tries Debian packages, each in a Debian of its own that has nothing else, the one that it was made for:
# installs it, uses all that is in it, and removes it. Root, some minutes, 4 GB for the time that it takes.
#
#   Utilities/test_packages.sh FOLDER [PACKAGE.deb...]     default: all of packages/
#
# FOLDER must not be there before, and is not afterwards.
set -euo pipefail

repository=$(cd "$(dirname "$0")/.." && pwd)
source "$repository/Utilities/build.sh"
source "$repository/Utilities/debian.sh"
in_own_namespace "$0" "$@"

if [ $# -eq 0 ] || [ -e "$1" ]; then
  echo "$0: needs the name of a new folder" >&2
  exit 2
fi
debian=$(realpath -m "$1")
shift
[ $# -gt 0 ] || set -- "$repository"/packages/*.deb

# Nothing of the host may be removed with it.
remove_debian()
{
  cd /
  leave_debian "$debian"
  rm -rf --one-file-system "$debian" "$debian.new"
}
trap remove_debian EXIT

for package in "$@"; do
  number=$(dpkg-deb -f "$package" Version | sed 's/.*~deb//')
  make_debian "${suites[number - 12]}" "$debian" > /dev/null
  enter_debian "$debian"
  cp -r "$repository/Testing/Install" "$debian/root/try"
  cp "$package" "$debian/root/try/"
  in_debian "$debian" plain bash "/root/try/try_package.sh" "/root/try/$(basename "$package")"
  remove_debian
done
