#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests, one for each core at a time, but for those of the
# night: those whose label matches NEURALMESH_TEST_LABELS, if that is set. Options go to ctest.
set -euo pipefail
cd "$(dirname "$0")"
source Utilities/build.sh

install_packages "${build_packages[@]}" "${test_packages[@]}"
build build all -DNEURALMESH_BUILD_TESTING=ON -DNEURALMESH_WARNINGS_AS_ERRORS="${CI:+ON}"
ctest --test-dir build -j "$(nproc)" -L "${NEURALMESH_TEST_LABELS:-fast|full}" \
  --output-on-failure --no-tests=error "$@"
