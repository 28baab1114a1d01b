# Sourced by scripts that work in a Debian of their own, made by debootstrap; they stand in the root of the
# repository, have sourced build.sh and are root. The archive is the one that apt uses here, or MIRROR.

# The Debians, and what to build with in each: ParaView's VTK, plain VTK, or plain VTK by clang. The two
# VTKs exclude each other.
suites=(bookworm trixie)
worlds=(paraview plain clang)

# Whether these are two of them: require_suite_and_world SCRIPT SUITE WORLD.
require_suite_and_world()
{
  [[ " ${suites[*]} " == *" $2 "* && " ${worlds[*]} " == *" $3 "* ]] ||
    { echo "$1: $2 $3 is not one of ${suites[*]}, and one of ${worlds[*]}" >&2; exit 2; }
}

# Starts the script anew in a name space of its own, so that what is mounted goes with it however it
# ends: in_own_namespace "$0" "$@".
in_own_namespace()
{
  [ -z "${IN_OWN_NAMESPACE:-}" ] || return 0
  [ "$(id -u)" -eq 0 ] || { echo "$1: needs root, for debootstrap and chroot" >&2; exit 2; }
  IN_OWN_NAMESPACE=1 exec unshare --mount --propagation private bash "$@"
}

# Makes the Debian at once or not at all: make_debian SUITE FOLDER.
make_debian()
{
  install_packages debootstrap
  local mirror
  mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' \
    'Label: Debian' 'Component: main' 'Created-By: Packages' | head -n 1)}
  rm -rf --one-file-system "$2.new"
  debootstrap --variant=minbase "$1" "$2.new" "${mirror:-http://deb.debian.org/debian}"
  mv "$2.new" "$2"
}

# Gives it what it needs to run: enter_debian FOLDER. Proxies, and what else apt needs on this machine
# to reach its archives, are those of the host.
enter_debian()
{
  apt-config dump | grep -E '^Acquire::(Check|http|https|Retries)' \
    > "$1/etc/apt/apt.conf.d/99host" || true
  cp -L /etc/resolv.conf /etc/hosts "$1/etc/"
  # For npm and pip, where what is between this machine and its registry has a certificate of its own.
  mkdir -p "$1/etc/ssl/certs"
  cp -L /etc/ssl/certs/ca-certificates.crt "$1/etc/ssl/certs/host.crt" 2> /dev/null || true
  mount -t proc proc "$1/proc"
  mount -t sysfs -o ro sysfs "$1/sys"
  mount --rbind /dev "$1/dev"
}

leave_debian()
{
  umount --recursive "$1/proc" "$1/sys" "$1/dev" 2> /dev/null || true
}

# The files of the working tree, not those that git ignores, in /neuralmesh. Builds in there stay.
copy_sources()
{
  mkdir -p "$1/neuralmesh"
  find "$1/neuralmesh" -mindepth 1 -maxdepth 1 ! -name 'build*' -exec rm -rf {} +
  git ls-files -z --cached --others --exclude-standard |
    tar --create --null --files-from - --ignore-failed-read |
    tar --extract --directory "$1/neuralmesh"
}

# in_debian FOLDER WORLD COMMAND...: runs it there, and the tests that are wanted here.
in_debian()
{
  local debian=$1 world=$2
  shift 2
  local certificates=/etc/ssl/certs/host.crt
  # pip wants no file that is not there.
  [ -e "$debian$certificates" ] || certificates=
  env -i CI=true NEURALMESH_VTK="$world" \
    PIP_CERT="$certificates" NODE_EXTRA_CA_CERTS=/etc/ssl/certs/host.crt \
    NEURALMESH_TEST_LABELS="${NEURALMESH_TEST_LABELS:-}" \
    PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 TMPDIR=/tmp \
    DEBIAN_FRONTEND=noninteractive chroot "$debian" "$@"
}
