#!/usr/bin/env bash
# test_command.sh COMMAND CASE: what `neuralmesh reconstruct` promises to those who type it.
source "$(dirname "$0")/command_testing.sh"

# Promise: the asked number of vertices, said on stdout; nothing on stderr where that is no
# terminal.
test_reconstructs()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 500
  grep -q '^element vertex 500$' <(head -c 600 mesh.ply | tr '\r' '\n') || fail "not 500 vertices"
  grep -Eq '^vertices +500$' out || fail "the summary does not say 500"
  grep -q 'ended by: vertices' out || fail "the summary does not say why it ended"
  [ ! -s err ] || { cat err; fail "there is something on stderr"; }
}

# Promise: each output format is written, by its extension in any case.
test_formats_out()
{
  local extension
  for extension in vtp ply obj stl PLY glb off vtk; do
    expect 0 "$neuralmesh" reconstruct cloud.xyz "mesh.$extension" --vertices 100
    [ -s "mesh.$extension" ] || fail "no mesh.$extension"
  done
  [ "$(grep -c '^v ' mesh.obj)" -eq 100 ] || fail "the .obj has not 100 vertices"
}

# Promise: same input and seed, same bytes; another seed, other bytes.
test_same_bytes()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz a.ply --vertices 400 --seed 3
  expect 0 "$neuralmesh" reconstruct cloud.xyz b.ply --vertices 400 --seed 3
  expect 0 "$neuralmesh" reconstruct cloud.xyz c.ply --vertices 400 --seed 4
  cmp a.ply b.ply || fail "the same seed gave other bytes"
  ! cmp -s a.ply c.ply || fail "another seed gave the same bytes"
}

# Promise: methods, presets and single parameters have an effect.
test_parameters()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz default.ply --vertices 400
  expect 0 "$neuralmesh" reconstruct cloud.xyz basic.ply --vertices 400 --method basic
  expect 0 "$neuralmesh" reconstruct cloud.xyz thesis.ply --vertices 400 --preset thesis
  expect 0 "$neuralmesh" reconstruct cloud.xyz list.ply --vertices 400 --order list \
    --set ListVertices=100
  expect 0 "$neuralmesh" reconstruct cloud.xyz set.ply --vertices 400 \
    --set WinnerRate=0.2 --set EdgeFlips=0
  local other
  for other in basic thesis list set; do
    ! cmp -s default.ply "$other.ply" || fail "$other changed nothing"
  done
  expect 0 "$neuralmesh" reconstruct cloud.xyz few.ply --set MaximumIterations=5000
  grep -q 'samples    5000, ended by: iterations' out || fail "the iterations were not limited"
}

# Promise: exit status 2 and a message for wrong use, and nothing is written.
test_wrong_use()
{
  expect 2 "$neuralmesh" reconstruct cloud.xyz ./cloud.xyz mesh.ply
  grep -q '^neuralmesh: INPUT: ./cloud.xyz is given twice$' err || { cat err; fail "it counts twice"; }
  local arguments
  while read -r arguments; do
    # shellcheck disable=SC2086
    expect 2 "$neuralmesh" $arguments
    [ -s err ] || fail "no message for: $arguments"
    [ ! -e mesh.ply ] || fail "something was written for: $arguments"
  done <<'CASES'
nonsense
reconstruct
reconstruct cloud.xyz
reconstruct cloud.xyz mesh.ply mesh.doc
reconstruct cloud.xyz again.xyz mesh.ply --in-place
reconstruct cloud.xyz again.xyz mesh.ply --raw float
reconstruct cloud.xyz mesh.ply --vertices 3
reconstruct cloud.xyz mesh.ply --vertices many
reconstruct cloud.xyz mesh.ply --seed -1
reconstruct cloud.xyz mesh.ply --method guess
reconstruct cloud.xyz mesh.ply --preset guess
reconstruct cloud.xyz mesh.ply --set WinnerRate
reconstruct cloud.xyz mesh.ply --set =1
reconstruct cloud.xyz mesh.ply --set WinnerRate=2
reconstruct cloud.xyz mesh.ply --set WinnerRate=x
reconstruct cloud.xyz mesh.ply --set NoiseWindow=10.5
reconstruct cloud.xyz mesh.ply --set Nothing=1
reconstruct cloud.xyz mesh.ply --set EdgeFlips=2
reconstruct cloud.xyz mesh.ply --set EdgeFlips=yes
reconstruct cloud.xyz mesh.ply --time-limit -1
reconstruct cloud.xyz mesh.ply --shift automatic
reconstruct cloud.xyz mesh.ply --shift 1,2
reconstruct cloud.xyz mesh.ply --shift 1,2,3,4
reconstruct cloud.xyz mesh.ply --shift 1,nan,3
reconstruct cloud.xyz mesh.ply --time-limit nan
reconstruct cloud.xyz mesh.ply --checkpoint run --checkpoint-interval nan
CASES
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --set MaximumIterations=9223372036854775808
  grep -q 'must be an integer from 0 to 9223372036854775807$' err || { cat err; fail "another range"; }
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 100 \
    --set MaximumIterations=9223372036854775807
  [ ! -s err ] || { cat err; fail "the largest count is not taken"; }
}

# Promise: exit status 2, and nothing is written or removed, where a file that is written is that of
# another option, too, by whatever path.
test_same_file()
{
  local arguments
  cp cloud.xyz cloud.ply
  echo kept > curve.csv
  echo 0 0 9 > views.xyz
  ln -s . here
  ln -s cloud.ply link.ply
  while read -r arguments; do
    # shellcheck disable=SC2086
    expect 2 "$neuralmesh" reconstruct $arguments --vertices 100
    grep -Eq '^neuralmesh: (OUTPUT|--[a-z]+): .* is the file of (INPUT|OUTPUT|--[a-z]+), too$' err ||
      { cat err; fail "another message for: $arguments"; }
    [ ! -e mesh.ply ] || fail "something was written for: $arguments"
  done << 'CASES'
cloud.xyz mesh.ply --checkpoint mesh.ply
cloud.xyz mesh.ply --checkpoint ./mesh.ply
cloud.xyz mesh.ply --checkpoint here/mesh.ply
cloud.xyz mesh.ply --statistics curve.csv --checkpoint curve.csv
cloud.ply link.ply
cloud.ply ./cloud.ply
cloud.xyz mesh.ply --initial mesh.ply
cloud.xyz mesh.ply --checkpoint cloud.xyz
cloud.xyz mesh.ply --views views.xyz --checkpoint views.xyz
CASES
  cmp cloud.xyz cloud.ply || fail "the input was changed"
  [ "$(cat curve.csv)" = kept ] || fail "the table was changed"
}

# Promise: switches are words or numbers, whole numbers may be written as powers, and as many parameters
# as one likes are set by --set, each by one of its own, as the help tells.
test_assignments()
{
  local word
  for word in off false 0; do
    expect 0 "$neuralmesh" reconstruct cloud.xyz $word.ply --vertices 200 --set EdgeFlips=$word
    cmp off.ply $word.ply || fail "$word is not off"
  done
  for word in on true 1; do
    expect 0 "$neuralmesh" reconstruct cloud.xyz $word.ply --vertices 200 --set EdgeFlips=$word \
      --set NoiseWindow=1e3
    cmp on.ply $word.ply || fail "$word is not on"
  done
  ! cmp -s on.ply off.ply || fail "EdgeFlips has no effect"
  expect 0 "$neuralmesh" reconstruct --help
  grep -q -- '^  --set NAME=VALUE  ' out || { cat out; fail "the help tells otherwise"; }
  grep -Eq '^  MaximumPoints +0 +0 to 4294967295 ' out || { cat out; fail "a range is rounded"; }
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --set WinnerRate=0.1 EdgeFlips=on
}

# says_unknown NAME SUGGESTIONS: what is said in one line of a parameter that does not exist.
says_unknown()
{
  local message="neuralmesh: --set: there is no parameter $1; "
  message+="$2'neuralmesh reconstruct --help' lists them all"
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --set "$1=0.1"
  [ "$(cat err)" = "$message" ] || { cat err; fail "another message about $1"; }
  [ ! -s out ] && [ ! -e mesh.ply ] || fail "something was written for $1"
}

# Promise: a mistyped parameter is answered in one line, with those of like names, if there are any, and
# the place where all of them are told.
test_mistyped()
{
  says_unknown WinerRate 'did you mean WinnerRate? '
  says_unknown winner_rate 'did you mean WinnerRate? '
  says_unknown Strat 'did you mean Start? '
  says_unknown EastVertices 'did you mean ListVertices or EarlyVertices? '
  says_unknown xyzzy ''
  local long
  long=$(printf 'x%.0s' {1..100000})
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --set "$long=1"
  [ "$(wc -c < err)" -lt 500 ] || fail "the message about a long name is long"
}

# Promise: an option that does not exist is answered with those of like names, behind the message that there
# is without; a subcommand that does not exist, or none, with the short help and those of like names.
test_mistyped_options()
{
  local message='The following argument was not expected: '
  local more='Run with --help for more information.'
  local mistyped meant
  while read -r mistyped meant; do
    expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply "$mistyped" 500
    printf '%s%s\n%s: did you mean %s?\n%s\n' "$message" "$mistyped" "$mistyped" "$meant" "$more" > wanted
    cmp err wanted || { cat err; fail "another message about $mistyped"; }
  done <<'CASES'
--vertexes --vertices
--vertex --vertices
--sead --seed
--Quite --quiet
CASES
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertexes=500 --xyzzy
  grep -qx -e '--vertexes: did you mean --vertices?' err || { cat err; fail "no option is meant"; }
  grep -q 'xyzzy:' err && fail "an option is like --xyzzy"
  [ ! -s out ] && [ ! -e mesh.ply ] || fail "something was written"

  "$neuralmesh" --help > help
  for mistyped in recontruct cloud.xyz; do
    expect 2 "$neuralmesh" $mistyped mesh.ply
    [[ "$(head -n 1 err)" = "no such subcommand: "* ]] || { cat err; fail "another message"; }
    tail -n "$(wc -l < help)" err | cmp - help || fail "there is no help for $mistyped"
    mv err "$mistyped.err"
  done
  grep -qx 'recontruct: did you mean reconstruct?' recontruct.err || fail "no subcommand is meant"
  ! grep -q 'did you mean' cloud.xyz.err || fail "a subcommand is like cloud.xyz"
}

# Promise: the command alone prints its help, the same as --help does, with status 0.
test_help()
{
  expect 0 "$neuralmesh" --help
  grep -q '^Subcommands:' out || fail "the help does not name the subcommands"
  mv out help
  expect 0 "$neuralmesh"
  cmp out help || fail "the command alone prints something else than its help"
  [ ! -s err ] || { cat err; fail "there is something on stderr"; }
  expect 0 "$neuralmesh" reconstruct --help
  grep -q WinnerRate out || fail "the help does not name the parameters"
  expect 0 "$neuralmesh" --version
}

# Promise: the help tells default and range of each parameter that has an option, as they are in the list.
test_defaults()
{
  expect 0 "$neuralmesh" reconstruct --help
  /usr/bin/python3 - "$(dirname "$0")/../../Filters/Parameters.json" <<'PYTHON' || fail "another help"
import json, re, sys
help = open("out").read()
entries = [e for group in json.load(open(sys.argv[1]))["groups"] for e in group["parameters"]]
# A tolerance that is given is above 0.
numbers = [e for e in entries if e.get("command") and "range" in e and e["name"] != "Tolerance"]
assert len(numbers) >= 6, numbers
for entry in numbers:
    option = re.search(r"^  " + entry["command"] + r"\b.*\n?.*", help, re.MULTILINE)[0]
    low, high = entry["range"]
    ends = f"from {low} on" if high is None else f"{low} to {high}"
    assert re.search(rf"\b{ends}\b", option), option
    default = entry["default"]
    assert f"(default {default})" in option or entry["command"] == "--ensemble" and f", {default} is usual" in option
PYTHON
}

# Promise: --quiet prints nothing.
test_quiet()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 200 --quiet
  [ ! -s out ] && [ ! -s err ] || fail "it was not quiet"
}

# Promise: on a terminal there is a bar with rate and remaining time. Skipped where no terminal can be
# made, as in a chroot without /dev/pts.
test_progress_on_terminal()
{
  if ! script -qec true /dev/null > reason 2>&1 && grep -q pseudo-terminal reason; then
    echo "skipped: $(cat reason)"
    exit 77
  fi
  script -qec "$neuralmesh reconstruct cloud.xyz mesh.ply --vertices 500" typescript > /dev/null
  grep -q 'vertices/s' typescript || fail "no rate"
  grep -q 's left' typescript || fail "no remaining time"
}

# Promise: --time-limit ends with status 0 and the mesh learnt so far.
test_time_limit()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 100000000 --time-limit 0.1
  grep -q 'ended by: time limit' out || fail "it was not ended by the time limit"
  [ -s mesh.ply ] || fail "there is no mesh"
}

# Promise: Ctrl-C ends the refinement beyond what there is to learn; the mesh so far is written whole.
test_ctrl_c_while_refining()
{
  expect 130 interrupted 50 "$neuralmesh" reconstruct cloud.xyz mesh.ply \
    --vertices 100000000
  grep -q 'ended by: cancelled' out || fail "the summary does not say why it ended"
  local vertices
  vertices=$(sed -n 's/^vertices *//p' out)
  [ "$vertices" -gt "$(wc -l < cloud.xyz)" ] || fail "nothing was refined"
  expect 0 "$neuralmesh" reconstruct mesh.ply again.ply --vertices 10
  grep -Eq "^points +$vertices " out || fail "the mesh is not whole"
}

# Promise: Ctrl-C ends the learning; the mesh learnt so far is written whole, the statistics, too;
# the exit status is 130.
test_ctrl_c()
{
  expect 130 interrupted 50 "$neuralmesh" reconstruct cloud.xyz mesh.ply \
    --vertices 100000000 --set FitRounds=0 --statistics curve.csv
  grep -q 'ended by: cancelled' out || fail "the summary does not say why it ended"
  local vertices
  vertices=$(sed -n 's/^vertices *//p' out)
  [ "$vertices" -gt 4 ] || fail "nothing was learnt"
  head -c 600 mesh.ply | tr '\r' '\n' | grep -aq "^element vertex $vertices\$" || fail "another mesh"
  expect 0 "$neuralmesh" reconstruct mesh.ply again.ply --vertices 10
  grep -Eq "^points +$vertices " out || fail "the mesh is not whole"
  tail -n 1 curve.csv | grep -q ",$vertices," || fail "the statistics do not end with the mesh"
  [ "$(find . -name '.*.ply' | wc -l)" -eq 0 ] || fail "a temporary file was left"
}

# Promise: what ends jobs of a cluster does the same as Ctrl-C, and the status tells which signal it was; the checkpoint
# is that of the end. Under nohup, a closed terminal ends nothing.
test_signals()
{
  local signal
  for signal in TERM HUP; do
    expect $((128 + $(kill -l $signal))) interrupted 50 "$neuralmesh" reconstruct cloud.xyz mesh.ply \
      --vertices 100000000 --set FitRounds=0 --checkpoint state --checkpoint-interval 1000
    grep -q 'ended by: cancelled' out || fail "the summary does not say why it ended"
    grep -q '^checkpoint state: the same command' out || fail "there is no checkpoint"
    expect 0 "$neuralmesh" info mesh.ply
    rm mesh.ply state
  done
  signal=HUP
  expect 0 interrupted 30 nohup "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 20000
}

# Promise: where the standard output or a file cannot grow, the status is 1, with words, and no half mesh stays.
test_full_disk()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 300 --quiet
  local arguments
  for arguments in "info mesh.ply" "info --json mesh.ply" "compare mesh.ply mesh.ply" "--help" \
    "reconstruct cloud.xyz again.ply --vertices 300" "explain cloud.xyz mesh.ply points.vtp" \
    "tune cloud.xyz --vertices 300"; do
    # shellcheck disable=SC2016,SC2086
    expect 1 bash -c '"$@" > /dev/full' bash "$neuralmesh" $arguments
    grep -q '^neuralmesh: the standard output cannot be written' err || { cat err; fail "no words"; }
  done
  # shellcheck disable=SC2016
  expect 1 bash -c 'ulimit -f 8; "$@" 2> words' bash "$neuralmesh" reconstruct cloud.xyz large.ply \
    --vertices 3000 --quiet
  grep -q '^neuralmesh: large.ply: ' words || { cat words; fail "no words of the file"; }
  [ "$(find . -name '*large*' | wc -l)" -eq 0 ] || fail "a half file stays"
}

# Promise: where the memory is too small for a run, the message tells how much it takes, and so does a dry run.
test_memory()
{
  make_cloud 100000
  local limit
  for limit in $(seq 90000 10000 900000); do
    # shellcheck disable=SC2016
    bash -c 'ulimit -v "$1"; shift; "$@"' bash "$limit" "$neuralmesh" reconstruct cloud.xyz mesh.ply --threads 1 \
      --vertices 50000 --quiet > out 2> err && fail "no limit was too small for the run alone"
    if grep -Eq 'not enough memory: the run takes about [0-9]+ MB' err; then
      break
    fi
  done
  [ ! -e mesh.ply ] || fail "a mesh was written"
  # shellcheck disable=SC2016
  expect 0 bash -c 'ulimit -v "$1"; shift; "$@"' bash "$limit" "$neuralmesh" reconstruct cloud.xyz mesh.ply \
    --threads 1 --vertices 50000 --dry-run
  grep -Eq '^memory +about [0-9]+ MB$' out || fail "the dry run does not tell"
}

# Promise: the statistics are a table with a line of names, and end with the result.
test_statistics()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 500 --statistics curve.csv \
    --set Start=tetrahedron
  head -n 1 curve.csv | grep -q '^"Iteration","Vertices","Seconds"' || fail "no line of names"
  [ "$(wc -l < curve.csv)" -gt 20 ] || fail "there are few lines"
  tail -n 1 curve.csv | grep -Eq '^[0-9]+,500,[0-9.e-]+,' || fail "the last line is not the result"
  expect 1 "$neuralmesh" reconstruct cloud.xyz other.ply --statistics curve.txt
  grep -q 'curve.txt' err || fail "the message does not name the file"
  [ ! -e other.ply ] || fail "a mesh was written"
}

# Promise: --initial starts from the triangles of a file; a bad one is an error that names it, and
# nothing is written.
test_initial()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz small.ply --vertices 300
  local extension
  for extension in ply vtp obj stl; do
    expect 0 "$neuralmesh" reconstruct cloud.xyz "small.$extension" --vertices 300
    expect 0 "$neuralmesh" reconstruct cloud.xyz large.ply --initial "small.$extension" \
      --vertices 400
    grep -Eq '^vertices +400$' out || fail "not 400 vertices from .$extension"
    [ "$(sed -n 's/^samples *\([0-9]*\),.*/\1/p' out)" -lt 30000 ] || fail "it started anew"
  done
  expect 0 "$neuralmesh" info large.ply
  expect 0 "$neuralmesh" reconstruct cloud.xyz same.ply --initial small.ply --vertices 300
  grep -q '^samples    0, ended by: vertices' out || fail "a mesh of all vertices was learnt"
  expect 0 "$neuralmesh" reconstruct cloud.xyz other.ply --initial small.ply --vertices 20000 \
    --dry-run
  [ ! -e other.ply ] || fail "a dry run wrote a mesh"

  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n' > bad.obj
  expect 1 "$neuralmesh" reconstruct cloud.xyz other.ply --initial bad.obj --vertices 300
  grep -q 'bad.obj.*edge 0-1 has 3 triangles' err || { cat err; fail "the message is another"; }
  [ "$(wc -l < err)" -eq 1 ] || fail "the message is not one line"
  expect 1 "$neuralmesh" reconstruct cloud.xyz other.ply --initial missing.ply --vertices 300
  grep -q 'missing.ply' err || fail "the message does not name the missing file"
  expect 1 "$neuralmesh" reconstruct cloud.xyz other.ply --initial cloud.xyz --vertices 300
  grep -q 'cloud.xyz: no mesh' err || fail "a file of points was taken as a mesh"
  [ ! -e other.ply ] || fail "a mesh was written"
}

# Promise: --features, --uncertainty, --jump, --topology and --ensemble have an effect, or say why they cannot.
test_variants()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz plain.vtp --vertices 400
  expect 0 "$neuralmesh" reconstruct cloud.xyz features.vtp --vertices 400 --features
  grep -aq 'Name="FeatureStrength"' features.vtp || fail "there is no feature strength"
  ! grep -aq 'Name="FeatureStrength"' plain.vtp || fail "there is feature strength unasked"
  expect 2 "$neuralmesh" reconstruct cloud.xyz features.ply --vertices 400 --features
  grep -q 'vtp' err || fail "the message does not name the format that keeps feature strength"

  # Error bars are those of the fit: nothing is lost where they cannot be had.
  expect 0 "$neuralmesh" reconstruct cloud.xyz bars.vtp --vertices 400 --uncertainty
  grep -aq 'type="Float32" Name="Uncertainty"' bars.vtp || fail "there are no error bars"
  ! grep -aq 'Name="Uncertainty"' plain.vtp || fail "there are error bars unasked"
  cp bars.vtp before.vtp
  expect 2 "$neuralmesh" reconstruct cloud.xyz bars.vtp --vertices 400 --uncertainty --set FitRounds=0
  grep -q 'Error bars need the fit' err || fail "the message does not say what error bars need"
  cmp -s bars.vtp before.vtp || fail "what was there is lost"
  expect 2 "$neuralmesh" reconstruct cloud.xyz bars.ply --vertices 400 --uncertainty
  grep -q 'vtp' err || fail "the message does not name the format that keeps error bars"

  local jump
  for jump in constant normal area volume weighted constant=0.1; do
    expect 0 "$neuralmesh" reconstruct cloud.xyz "$jump.ply" --vertices 400 --order list \
      --set ListVertices=100 --jump "$jump"
    [ "$jump" = constant ] || ! cmp -s constant.ply "$jump.ply" || fail "--jump $jump changed nothing"
  done
  expect 2 "$neuralmesh" reconstruct cloud.xyz other.ply --jump area
  grep -q 'with the order list' err || fail "the message does not tell what goes together"
  expect 2 "$neuralmesh" reconstruct cloud.xyz other.ply --method normal --topology on
  grep -q 'noise_filtering and basic' err || fail "the message does not tell what goes together"
  [ ! -e other.ply ] || fail "a mesh was written"

  # A torus of radii 1 and 0.4.
  awk 'BEGIN { for (i = 0; i < 40000; ++i) { v = 6.2831853 * i / 40000; u = 2.39996 * i;
    r = 1 + 0.4 * cos(v); printf "%.9f %.9f %.9f\n", r * cos(u), r * sin(u), 0.4 * sin(v) } }' \
    > torus.xyz
  local way
  for way in '--topology on --set Start=tetrahedron' '--ensemble 5 --set VerticesPerMember=1500'; do
    # shellcheck disable=SC2086
    expect 0 "$neuralmesh" reconstruct torus.xyz torus.ply --vertices 2000 $way
    expect 0 "$neuralmesh" info torus.ply
    grep -Eq '^ +genus +1( |$)' out || { cat out; fail "$way gave another genus than 1"; }
  done
  expect 0 "$neuralmesh" reconstruct torus.xyz torus.ply --vertices 2000 --set Start=tetrahedron
  expect 0 "$neuralmesh" info torus.ply
  grep -Eq '^ +genus +0( |$)' out || fail "there is a handle without topology learning"
}

# Promise: the last lines tell how good the mesh is.
test_report()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 500
  tail -n 4 out > report
  grep -Eq '^residual   [0-9.e-]+ from held-out points to the mesh, noise about [0-9.e-]+, 0 % too' \
    report || { cat out; fail "no residual"; }
  grep -Eq '^shape      1 piece, no handles, no boundaries, (no|[0-9]+) folded edges?, no intersecting triangles$' report ||
    { cat out; fail "no shape"; }
  grep -Eq '^quality    0[.][0-9]+ of the triangles .*, [0-9]+ % of the vertices regular$' report ||
    { cat out; fail "no quality"; }
}

# 3000 points of a sphere, red above and blue below, and a thousand of another beside it, of weight 0.
make_colored()
{
  awk 'BEGIN { print "ply\nformat ascii 1.0\nelement vertex 3000\nproperty float x"
    print "property float y\nproperty float z\nproperty uchar red\nproperty uchar green"
    print "property uchar blue\nend_header"
    for (i = 0; i < 3000; ++i) { z = 1 - (2 * i + 1) / 3000; r = sqrt(1 - z * z)
    printf "%.9f %.9f %.9f %s\n", r * cos(2.39996 * i), r * sin(2.39996 * i), z,
    (z > 0 ? "255 0 0" : "0 0 255") } }' > colored.ply
  awk 'BEGIN { print "# vtk DataFile Version 3.0\ncloud\nASCII\nDATASET POLYDATA"
    print "POINTS 4000 float"
    for (i = 0; i < 4000; ++i) { j = i % 3000; z = 1 - (2 * j + 1) / 3000; r = sqrt(1 - z * z)
    print r * cos(2.39996 * j) + (i < 3000 ? 0 : 9), r * sin(2.39996 * j), z }
    print "POINT_DATA 4000\nSCALARS Confidence float 1\nLOOKUP_TABLE default"
    for (i = 0; i < 4000; ++i) print (i < 3000 ? 2 : 0) }' > weighted.vtk
}

# Promise: colours and arrays arrive on the mesh; the weights of points count.
test_point_data()
{
  make_colored
  expect 0 "$neuralmesh" reconstruct colored.ply mesh.ply --vertices 300
  head -c 600 mesh.ply | tr '\r' '\n' | grep -aq '^property uchar red$' || fail "no colours"
  expect 0 "$neuralmesh" reconstruct mesh.ply again.ply --vertices 100
  head -c 600 again.ply | tr '\r' '\n' | grep -aq '^property uchar red$' || fail "colours got lost"
  expect 0 "$neuralmesh" reconstruct colored.ply mesh.vtp --vertices 300
  grep -aq 'Name="RGB"' mesh.vtp || fail "no colours in the .vtp"
  expect 0 "$neuralmesh" reconstruct cloud.xyz plain.ply --vertices 300
  ! head -c 600 plain.ply | tr '\r' '\n' | grep -aq 'red' || fail "colours from nowhere"

  expect 0 "$neuralmesh" reconstruct weighted.vtk all.ply --vertices 300
  ! grep -q '^shape      1 piece,' out || fail "there is nothing beside the sphere"
  expect 0 "$neuralmesh" reconstruct weighted.vtk mesh.ply --vertices 300 --weights Confidence
  grep -q '^shape      1 piece,' out || { cat out; fail "points without weight have a mesh"; }
  expect 1 "$neuralmesh" reconstruct weighted.vtk other.ply --vertices 300 --weights Trust
  grep -q 'weighted.vtk: .*called Trust' err || { cat err; fail "the message is another"; }
  [ ! -e other.ply ] || fail "a mesh was written"
}

# Promise: a file is sampled in place, the same points by the same seed; where all points are drawn,
# the mesh has the bytes of one from the file read whole. Raw coordinates are taken, too.
test_in_place()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz cloud.ply --vertices 3000 --set FitRounds=0
  expect 0 "$neuralmesh" reconstruct cloud.ply whole.ply --vertices 300
  expect 0 "$neuralmesh" reconstruct cloud.ply all.ply --vertices 300 --in-place
  grep -q '^points     3000 (3000 drawn, 0 of them dropped)$' out || { cat out; fail "not all"; }
  grep -Eq '^phases .*[(]drawing [0-9.]+, cloud ' out || { cat out; fail "no time of drawing"; }
  cmp whole.ply all.ply || fail "the file in place gave other bytes"
  expect 0 "$neuralmesh" reconstruct cloud.ply a.ply --vertices 300 --in-place \
    --set MaximumPoints=1500
  grep -q '^points     3000 (1500 drawn' out || { cat out; fail "not as many as wanted"; }
  expect 0 "$neuralmesh" reconstruct cloud.ply b.ply --vertices 300 --in-place \
    --set MaximumPoints=1500
  cmp a.ply b.ply || fail "the same seed drew other points"
  expect 0 "$neuralmesh" reconstruct cloud.ply c.ply --vertices 300 --in-place --dry-run
  [ ! -e c.ply ] || fail "a dry run wrote a mesh"

  # 3000 points of 12 bytes stand behind the header.
  local header
  header=$(LC_ALL=C awk '{ bytes += length($0) + 1 } /^end_header/ { print bytes; exit }' cloud.ply)
  tail -c +$((header + 1)) cloud.ply > behind_header
  head -c 36000 behind_header > cloud.raw
  expect 0 "$neuralmesh" reconstruct cloud.raw raw.ply --vertices 300 --raw float
  grep -q '^points     3000 ' out || { cat out; fail "not all raw points"; }
  { printf head; cat cloud.raw; } > behind.raw
  expect 0 "$neuralmesh" reconstruct behind.raw d.ply --vertices 300 --raw float --skip 4
  cmp raw.ply d.ply || fail "points behind other bytes gave another mesh"

  expect 2 "$neuralmesh" reconstruct cloud.ply e.ply --skip 4
  expect 1 "$neuralmesh" reconstruct cloud.xyz e.ply --in-place
  grep -q '^neuralmesh: cloud.xyz: only .ply' err || { cat err; fail "another message"; }
  head -c 20000 cloud.ply > short.ply
  expect 1 "$neuralmesh" reconstruct short.ply e.ply --in-place
  grep -q '^neuralmesh: short.ply: damaged: it ends' err || { cat err; fail "another message"; }
  expect 1 "$neuralmesh" reconstruct cloud.raw e.ply --raw double --skip 1
  [ "$(wc -l < err)" -eq 1 ] || { cat err; fail "the message is not one line"; }
  [ ! -e e.ply ] || fail "a mesh was written"
}

# header FILE: the first lines of a .ply.
header() { head -c 600 "$1" | tr '\r' '\n'; }

# no_flat_triangles FILE: all triangles of a mesh have an area.
no_flat_triangles()
{
  expect 0 "$neuralmesh" info "$1"
  grep -q ' 0 triangles without area' out || { cat out; fail "$1 has triangles without area"; }
}

# Promise: an object at UTM coordinates is read from a .ply of doubles as from text, whole or in place,
# and written with all digits; floats hold its mesh only with a shift, which is told, noted, and undone
# where the mesh is read. Without, an .stl is refused before anything is learnt. Where floats do,
# nothing changes.
test_digits()
{
  awk '{ printf "%.9f %.9f %.9f\n", $1 + 500000, $2 + 5400000, $3 + 100 }' cloud.xyz > utm.xyz
  /usr/bin/python3 - <<'PYTHON'
import struct
points = [tuple(map(float, line.split())) for line in open("utm.xyz")]
header = "ply\nformat binary_%s_endian 1.0\nelement vertex %d\n" + "".join(
    f"property double {axis}\n" for axis in "xyz") + "end_header\n"
for order, sign in (("little", "<"), ("big", ">")):
    with open(f"{order}.ply", "wb") as file:
        file.write((header % (order, len(points))).encode())
        file.writelines(struct.pack(sign + "3d", *point) for point in points)
PYTHON
  local cloud extension
  expect 0 "$neuralmesh" reconstruct utm.xyz mesh.ply --vertices 500
  grep -q '^shape      1 piece, no handles, no boundaries' out || { cat out; fail "another shape"; }
  header mesh.ply | grep -aq '^property double x$' || fail "the .ply has no doubles"
  no_flat_triangles mesh.ply
  for cloud in "little.ply" "big.ply" "little.ply --in-place"; do
    # shellcheck disable=SC2086
    expect 0 "$neuralmesh" reconstruct $cloud other.ply --vertices 500
    cmp mesh.ply other.ply || fail "$cloud gave another mesh"
  done

  expect 1 "$neuralmesh" reconstruct utm.xyz mesh.stl --vertices 100000000
  [ "$(wc -l < err)" -eq 1 ] || { cat err; fail "not one line"; }
  grep -q '^neuralmesh: mesh.stl: cannot be written: .stl has floats only.*--shift auto' err ||
    { cat err; fail "another message"; }
  [ ! -e mesh.stl ] || fail "a mesh was written"

  for extension in ply vtp obj stl; do
    expect 0 "$neuralmesh" reconstruct utm.xyz "shifted.$extension" --vertices 500 --shift auto
    grep -q "^shift      500000 5400000 100, to be added to the coordinates of shifted.$extension\$" out ||
      { cat out; fail "the shift is not told"; }
    no_flat_triangles "shifted.$extension"
    expect 0 "$neuralmesh" compare mesh.ply "shifted.$extension" --json --samples 1000
    json 'lines[0]["hausdorff"] < 1e-6'
  done
  header shifted.ply | grep -aq '^comment shift 500000 5400000 100$' || fail "the shift is not noted"
  header shifted.ply | grep -aq '^property float x$' || fail "the shifted .ply has doubles"
  expect 0 "$neuralmesh" reconstruct utm.xyz again.ply --vertices 500 --initial shifted.ply
  expect 0 "$neuralmesh" reconstruct utm.xyz by.ply --vertices 500 --shift -0.5,5.4e6,-100
  grep -q '^shift      -0.5 5400000 -100, ' out || { cat out; fail "another shift"; }

  expect 0 "$neuralmesh" reconstruct cloud.xyz plain.ply --vertices 500
  expect 0 "$neuralmesh" reconstruct cloud.xyz auto.ply --vertices 500 --shift auto
  grep -q '^shift      none$' out || { cat out; fail "a shift for nothing"; }
  header plain.ply | grep -aq '^property float x$' || fail "there are doubles for nothing"
  cmp plain.ply auto.ply || fail "another mesh"
}

# Promise: names of columns decide which are the coordinates; names that tell nothing are warned of, in a
# line, and the mesh is that of the first three columns.
test_columns()
{
  awk 'BEGIN { print "id;z;y;x" } { print NR ";" $3 ";" $2 ";" $1 }' cloud.xyz | tr . , > named.csv
  awk 'BEGIN { print "east,north,height" } { print $1 "," $2 "," $3 }' cloud.xyz > other.csv
  local name
  for name in cloud.xyz named.csv other.csv; do
    expect 0 "$neuralmesh" reconstruct $name mesh.ply --vertices 200 --quiet
    mv mesh.ply "$name.ply"
    mv err "$name.err"
  done
  cmp cloud.xyz.ply named.csv.ply || fail "another mesh with named columns"
  cmp cloud.xyz.ply other.csv.ply || fail "another mesh with other names"
  [ ! -s named.csv.err ] || { cat named.csv.err; fail "names are warned of"; }
  [ "$(cat other.csv.err)" = "neuralmesh: warning: other.csv: no columns are named x, y and z; \
the program reads the first three. Name the columns of the coordinates x, y and z." ] ||
    { cat other.csv.err; fail "another warning"; }
}

# Promise: a dry run says what it will take, and writes nothing.
test_dry_run()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 100000 --dry-run
  local what
  for what in 'vertices +100000$' 'samples +about [0-9.]+ million$' 'memory +about [0-9]+ MB$' \
    'time +about [0-9.]+ s of processor time, [0-9.]+ (s|min) on this machine as it is now$'; do
    grep -Eq "^$what" out || fail "no line '$what'"
  done
  [ "$(sed -n 's/^memory *about \([0-9]*\) MB/\1/p' out)" -gt 50 ] || fail "too little memory"
  [ ! -e mesh.ply ] || fail "a mesh was written"
}

# Promise: of an open scan with noise and narrow gaps a dry run foretells the samples up to a factor of two and the
# processor time up to five, and warns of nothing that only its trials have.
test_dry_run_of_scan()
{
  /usr/bin/python3 - <<'PYTHON'
import numpy as np
random = np.random.default_rng(5)
plane = random.uniform(-1, 1, (60000, 2))
height = 0.1 * np.sin(5 * plane[:, 0]) + 0.03 * random.integers(0, 2, len(plane))
points = np.column_stack((plane, height))
np.savetxt("scan.xyz", points + random.normal(0, 0.005, points.shape), fmt="%.6f")
PYTHON
  expect 0 "$neuralmesh" reconstruct scan.xyz mesh.ply --dry-run
  [ ! -s err ] || { cat err; fail "a dry run warns"; }
  mv out foretold
  expect 0 "$neuralmesh" reconstruct scan.xyz mesh.ply
  /usr/bin/python3 - <<'PYTHON' || { cat foretold out; fail "a wrong estimate"; }
import re, sys
def number(pattern, name):
    return float(re.search(pattern, open(name).read(), re.MULTILINE)[1])
samples = 1e6 * number(r"^samples +about ([0-9.]+) million$", "foretold")
seconds = number(r"^time +about ([0-9.]+) s of processor time", "foretold")
within = lambda told, true, factor: true / factor < told < factor * true
sys.exit(not (within(samples, number(r"^samples +([0-9]+),", "out"), 2)
    and within(seconds, number(r"^phases +([0-9.]+) CPU s", "out"), 5)))
PYTHON
}

make_cloud
"test_$2"
