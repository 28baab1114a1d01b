#!/usr/bin/env bash
# Whether all C++ is formatted as .clang-format says, cppcheck finds nothing in the core, the filters
# and the command, clang-tidy finds nothing in what has changed there, and check_words.sh finds nothing in pages
# and texts.
#
#   Utilities/check_style.sh [--all | COMMIT]
#
# clang-tidy takes minutes, so it looks at the sources that have changed since COMMIT, by default since
# three and a half hours before the newest commit, and at those that include a changed header first, and
# without its static analyzer; with --all at every source, with that.
set -euo pipefail
cd "$(dirname "$0")/.."
source Utilities/build.sh

install_packages "${build_packages[@]}" clang-format clang-tidy cppcheck git
bash Utilities/check_words.sh
folder=build-style
# Headers that follow from the list of parameters read as if they were written.
written=$folder/parameters
/usr/bin/python3 -B CMake/Parameters/generate.py . "$written" > /dev/null
{ git ls-files '*.h' '*.cpp' '*.cxx'; find "$written" -name '*.h'; } | xargs clang-format --dry-run --Werror
echo "clang-format: all well"

# Of style there is clang-tidy to judge.
git ls-files 'Filters/*.cpp' 'Filters/*.cxx' 'Applications/*.cxx' |
  cppcheck --enable=warning,performance,portability --std=c++20 --language=c++ --quiet \
    -U VTK_NLOHMANN_JSON -I Filters/Core -I Filters -I Applications \
    -I "$written/Filters/Core" -I "$written/Filters" \
    --error-exitcode=1 -j "$(nproc)" --file-list=-
echo "cppcheck: all well"

# changed_since COMMIT PATTERN...: the files that are there now and differ from it.
changed_since()
{
  git diff --name-only --diff-filter=d "$1" -- "${@:2}"
}

# The sources for clang-tidy, one in a line.
wanted_sources()
{
  local commit=${1:-} header
  if [ -z "$commit" ]; then
    commit=$(git rev-list -1 --before="$(($(git log -1 --format=%ct) - 12600))" HEAD)
  fi
  # A clone without history does not know what has changed.
  if [ "$commit" = --all ] || [ -z "$commit" ]; then
    git ls-files 'Filters/*.cpp' 'Filters/*.cxx' 'Applications/*.cxx'
    return
  fi
  changed_since "$commit" 'Filters/*.cpp' 'Filters/*.cxx' 'Applications/*.cxx'
  while read -r header; do
    # The first one that includes it shows it to clang-tidy.
    { git grep -lE "^#include \"([A-Za-z]+/)?$(basename "$header" .in)\"" -- \
      'Filters/*.cpp' 'Filters/*.cxx' 'Applications/*.cxx' || true; } | sed -n 1p
  done < <(changed_since "$commit" 'Filters/*.h' 'Filters/*.h.in' 'Applications/*.h')
}

# A dozen sources at a time: a fifth of the time, as most of it goes into the headers they include.
# They are copied into one, as the analyzer leaves included ones out.
configure "$folder" -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
wanted_sources "${1:-}" | sort -u > "$folder/wanted.txt"
find "$folder"/Filters "$folder"/Applications -path '*/Unity/*.cxx' -exec \
  perl -i -pe '
    BEGIN { open(W, "'"$folder"'/wanted.txt"); chomp(@w = <W>); %wanted = map { $_ => 1 } @w; }
    s{^#include "'"$PWD"'/(.*\.c(pp|xx))"$}{open(F, $1); $wanted{$1} ? join("", <F>) : ""}e' {} +

# Those that have something in them, but for what CMake writes.
grep -o '"file": "[^"]*"' "$folder/compile_commands.json" | cut -d '"' -f 4 |
  while read -r file; do
    case $file in
      "$PWD/$folder"/Filters/*/Unity/* | "$PWD/$folder"/Applications/*/Unity/*)
        ! grep -q '^#include' "$file" || echo "$file" ;;
      "$PWD"/Filters/* | "$PWD"/Applications/*)
        ! grep -qxF "${file#"$PWD/"}" "$folder/wanted.txt" || echo "$file" ;;
    esac
  done > "$folder/files.txt"
checks=-clang-analyzer-*
[ "${1:-}" != --all ] || checks=
xargs -r -P "$(nproc)" -n 1 clang-tidy -p "$folder" --config-file=.clang-tidy --quiet \
  --checks="$checks" --warnings-as-errors='*' < "$folder/files.txt" 2> /dev/null
echo "clang-tidy: all well in $(wc -l < "$folder/wanted.txt") sources"
