#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests but for nightly ones, or, where
# NEURALMESH_TEST_LABELS is set, those whose label matches it. Options go to ctest.
set -euo pipefail
cd "$(dirname "$0")"
source Utilities/build.sh

labels=${NEURALMESH_TEST_LABELS:-fast|full}
packages=("${build_packages[@]}" "${test_packages[@]}")
[[ $labels != *nightly* ]] || packages+=("${night_packages[@]}")
install_packages "${packages[@]}"
fetch_nanobind build
build build all -DNEURALMESH_BUILD_TESTING=ON -DNEURALMESH_WARNINGS_AS_ERRORS="${CI:+ON}" \
  ${engine_options[@]+"${engine_options[@]}"}
# One more at a time than there are cores: some wait for something else.
ctest --test-dir build -j $(($(nproc) + 1)) -L "$labels" \
  --output-on-failure --no-tests=error "$@"
