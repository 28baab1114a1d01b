#!/usr/bin/env bash
# Fuzzes the engine and the readers with libFuzzer, with the address and undefined-behaviour
# sanitizers and assertions, so many seconds each, one after the other:
#
#   Testing/Fuzzing/run.sh SECONDS [Engine|Readers]
#
# Prints at the end of each how much CPU time the campaign took, the processes that read files among it.
# What was found lies in build-fuzzing/found; a file of it is run again by
# `build-fuzzing/bin/NeuralMeshFuzzEngineLong FILE`. The inputs that are worth while are kept in
# build-fuzzing/corpus for the next campaign.
set -euo pipefail
seconds=${1:?usage: $0 SECONDS [Engine|Readers]}
targets=(${2:-Engine Readers})
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libgtest-dev clang libclang-rt-dev
folder=build-fuzzing
configure_preset fuzzing

for target in "${targets[@]}"; do
  cmake --build --preset fuzzing --target "NeuralMeshFuzz${target}Long" "NeuralMeshFuzz${target}Shortly"
  corpus=$folder/corpus/$target found=$folder/found/$target
  mkdir -p "$corpus" "$found"
  "$folder/bin/NeuralMeshFuzz${target}Shortly" --write "$corpus"
  TIMEFORMAT="$target: %U CPU seconds in the program, %S in the system"
  time "$folder/bin/NeuralMeshFuzz${target}Long" -max_total_time="$seconds" -max_len=4096 -timeout=60 \
    -rss_limit_mb=4096 -seed=1 -print_final_stats=1 -artifact_prefix="$found/" "$corpus" 2>&1 |
    tee "$folder/$target.log" | grep -E '^#[0-9]+.*(NEW|DONE|pulse)|stat::|SUMMARY|broken' | tail -n 20
done
