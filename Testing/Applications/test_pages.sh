#!/usr/bin/env bash
# test_pages.sh COMMAND CASE: what the manual page and the completions that are built with the command
# promise. They are made from the command line itself; here they are held against the help.
source "$(dirname "$0")/command_testing.sh"
share=$(dirname "$neuralmesh")/../share

# The subcommands, by the help.
subcommands()
{
  "$neuralmesh" --help | sed -n '/^Subcommands:/,$s/^  \([a-z]\+\).*/\1/p'
}

# The options of a subcommand, by its help.
options()
{
  "$neuralmesh" "$1" --help | sed -nE '/^Options:/,/^$/s/^  (-[a-z],)?(--[a-z-]+).*/\2/p'
}

# The parameters of --set, by the help.
parameters()
{
  "$neuralmesh" reconstruct --help | sed -nE '/^Parameters of learning/,/^$/s/^  ([A-Z][A-Za-z]+).*/\1/p'
}

# Promise: the manual has every subcommand, every option of each and every parameter of learning.
test_manual_is_complete()
{
  local subcommand option parameter
  man -l -E ascii "$share/man/man1/neuralmesh.1" > manual
  grep -q "^NeuralMesh $("$neuralmesh" --version) " manual || fail "another version"
  [ "$(subcommands | wc -l)" -ge 3 ] || fail "no subcommands in the help"
  for subcommand in $(subcommands); do
    sed -n "/^   neuralmesh $subcommand/,/^ \{0,3\}[a-zS]/p" manual > section
    [ "$(options "$subcommand" | wc -l)" -ge 2 ] || fail "no options in the help of $subcommand"
    for option in $(options "$subcommand"); do
      grep -qE "^       (-., )?$option( |\$)" section || fail "$subcommand $option is not there"
    done
  done
  [ "$(parameters | wc -l)" -ge 40 ] || fail "no parameters in the help"
  for parameter in $(parameters); do
    grep -qE "^       $parameter( |\$)" manual || fail "$parameter is not there"
  done
}

# Promise: nothing in it is wrong for man.
test_manual_has_no_warnings()
{
  man --warnings=w -E UTF-8 -l -Tutf8 -Z "$share/man/man1/neuralmesh.1" 2> warnings > /dev/null
  [ ! -s warnings ] || { cat warnings; fail "man warns"; }
}

# after WORD...: what bash offers for the last word, and with which options of compopt.
after()
{
  COMP_WORDS=(neuralmesh "$@") COMP_CWORD=$# offered=
  compopt() { offered="-o $2 "; }
  _neuralmesh
  offered+=${COMPREPLY[*]}
}

# offers EXPECTED WORD...
offers()
{
  local expected=$1
  shift
  after "$@"
  [ "$offered" = "$expected" ] || fail "after $*: '$offered', not '$expected'"
}

# Promise: subcommands, options, values that are words, names of parameters and files are completed.
test_bash_completion()
{
  local subcommand
  source "$share/bash-completion/completions/neuralmesh"
  [ "$(complete -p neuralmesh)" = "complete -F _neuralmesh neuralmesh" ] || fail "it is not used"
  for subcommand in $(subcommands); do
    offers "$subcommand" "${subcommand:0:3}"
    offers "-h $(options "$subcommand" | paste -sd ' ')" "$subcommand" -
  done
  offers "-o default " info ""
  offers "-o default " reconstruct scan.p
  offers "-o default " reconstruct --initial ""
  offers "" reconstruct --vertices 1
  offers "basic noise normal" reconstruct --method ""
  offers "noise normal" reconstruct scan.ply --method = n
  offers "exact list" reconstruct --order =
  offers "normal" reconstruct --jump n
  offers "-o nospace WinnerRate=" reconstruct --set Winn
  offers "occupied_space tetrahedron" reconstruct --set Start =
  offers "tetrahedron" reconstruct --set Start = t
  offers "-o default " reconstruct --set WinnerRate = 0
  after reconstruct --set ""
  [ "$offered" = "-o nospace $(parameters | sed 's/$/=/' | paste -sd ' ')" ] ||
    fail "other parameters: $offered"
}

# Promise: the same in fish.
test_fish_completion()
{
  local subcommand
  export HOME=$PWD
  # offers_fish EXPECTED LINE: the words only, not what they are.
  offers_fish()
  {
    fish -c "source $share/fish/vendor_completions.d/neuralmesh.fish; complete -C '$2'" |
      cut -f 1 | sort | paste -sd ' ' > offered
    [ "$(cat offered)" = "$1" ] || fail "after $2: '$(cat offered)', not '$1'"
  }
  touch cloud.ply
  offers_fish "$(subcommands | sort | paste -sd ' ')" "neuralmesh "
  for subcommand in $(subcommands); do
    offers_fish "$(options "$subcommand" | sort | paste -sd ' ')" "neuralmesh $subcommand --"
  done
  offers_fish "cloud.ply" "neuralmesh info cl"
  offers_fish "cloud.ply" "neuralmesh reconstruct --initial cl"
  offers_fish "basic noise normal" "neuralmesh reconstruct --method "
  offers_fish "auto" "neuralmesh reconstruct --vertices "
  offers_fish "" "neuralmesh reconstruct --seed "
  offers_fish "Start=occupied_space" "neuralmesh reconstruct --set Start=oc"
}

"test_$2"
