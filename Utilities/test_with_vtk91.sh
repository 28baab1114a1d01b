#!/usr/bin/env bash
# Runs all tests against Debian's plain VTK 9.1, which cannot be installed beside ParaView's: in a
# Debian 12 of its own, made by debootstrap. Root, about 3 GB and, the first time, some minutes.
#
#   Utilities/test_with_vtk91.sh [FOLDER] [CTEST-OPTION...]
#
# FOLDER holds that Debian (default: build-vtk91); the next run uses it again and builds what has
# changed. The archive is the one that apt uses here, or MIRROR.
set -euo pipefail

# What is mounted goes with the name space, however this ends.
if [ -z "${IN_OWN_NAMESPACE:-}" ]; then
  [ "$(id -u)" -eq 0 ] || { echo "$0: needs root, for debootstrap and chroot" >&2; exit 2; }
  IN_OWN_NAMESPACE=1 exec unshare --mount --propagation private bash "$0" "$@"
fi

repository=$(cd "$(dirname "$0")/.." && pwd)
if [[ "${1:-}" =~ ^(-|$) ]]; then
  debian=$repository/build-vtk91
else
  debian=$(realpath -m "$1")
  shift
fi
cd "$repository"
source Utilities/build.sh

# Makes the Debian at once or not at all.
make_debian()
{
  install_packages debootstrap
  local mirror
  mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' \
    'Codename: bookworm' 'Component: main' 'Created-By: Packages' | head -n 1)}
  rm -rf --one-file-system "$debian.new"
  debootstrap --variant=minbase bookworm "$debian.new" "${mirror:-http://deb.debian.org/debian}"
  mv "$debian.new" "$debian"
}

# Proxies, and what else apt needs on this machine to reach its archives.
configure_network()
{
  apt-config dump | grep -E '^Acquire::(Check|http|https|Retries)' \
    > "$debian/etc/apt/apt.conf.d/99host" || true
  cp -L /etc/resolv.conf /etc/hosts "$debian/etc/"
}

# The files of the working tree, not those that git ignores. The build in there stays.
copy_sources()
{
  mkdir -p "$debian/neuralmesh"
  find "$debian/neuralmesh" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
  git ls-files -z --cached --others --exclude-standard |
    tar --create --null --files-from - --ignore-failed-read |
    tar --extract --directory "$debian/neuralmesh"
}

[ -d "$debian" ] || make_debian
configure_network
copy_sources
mount -t proc proc "$debian/proc"
mount --rbind /dev "$debian/dev"
CI=true NEURALMESH_VTK=plain PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 TMPDIR=/tmp \
  chroot "$debian" bash /neuralmesh/test.sh "$@"
