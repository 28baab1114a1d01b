#!/usr/bin/env bash
# test_bad_files.sh COMMAND CASE: what `neuralmesh reconstruct` does with files that are not as they
# should be. A run that takes long is stuck, which is a failure.
source "$(dirname "$0")/command_testing.sh"

readable=(ply vtp vtk vtu obj stl xyz pts txt csv)
writable=(vtp ply obj stl)

# reconstruct INPUT OUTPUT: with a limit of time, and few vertices.
reconstruct() { timeout 30 "$neuralmesh" reconstruct "$1" "$2" --vertices 100; }

# refused INPUT: status 1, one line that names the file, nothing written.
refused()
{
  expect 1 reconstruct "$1" mesh.ply
  is_one_line_about "$1"
  [ ! -e mesh.ply ] || fail "something was written for $1"
  nothing_left_behind
}

is_one_line_about()
{
  [ "$(wc -l < err)" -eq 1 ] || { cat err; fail "not one line about $1"; }
  grep -q "^neuralmesh: $1" err || { cat err; fail "the message does not name $1"; }
}

nothing_left_behind()
{
  [ -z "$(find . -name '.*mesh*')" ] || { find .; fail "a temporary file was left behind"; }
}

# Promise: what is not there, no file, of another kind or not to be read is refused in one line.
test_no_file()
{
  local extension
  for extension in "${readable[@]}"; do
    refused "missing.$extension"
    ln -s nowhere "dangling.$extension"
    refused "dangling.$extension"
    mkdir "folder.$extension"
    refused "folder.$extension"
    mkfifo "pipe.$extension"
    refused "pipe.$extension"
    ln -s /dev/zero "device.$extension"
    refused "device.$extension"
    # Opening succeeds, even for root; reading fails.
    ln -s /proc/self/mem "unreadable.$extension"
    refused "unreadable.$extension"
  done
  cp cloud.xyz cloud.unknown
  refused cloud.unknown
  cp cloud.xyz cloud
  refused cloud
}

# Promise: so are empty files, garbage, and text where a format has another form.
test_no_points()
{
  local extension
  for extension in "${readable[@]}"; do
    : > "empty.$extension"
    refused "empty.$extension"
    seq 5000 | gzip --no-name > "garbage.$extension"
    refused "garbage.$extension"
    printf 'this is not\na point\n' > "text.$extension"
    refused "text.$extension"
  done
  printf '0 0 0\n1 0 0\n0 x 0\n' > broken.xyz
  refused broken.xyz
  grep -q 'line 3' err || fail "the line is not named"
  head -c 1000000 /dev/zero | tr '\0' x > long.xyz
  refused long.xyz
  [ "$(wc -c < err)" -lt 1000 ] || fail "the message is as long as the file"
}

# Promise: formats that say how much they hold are refused if they end too soon, wherever that is.
test_truncated()
{
  local extension size part
  for extension in ply vtp stl; do
    expect 0 reconstruct cloud.xyz "whole.$extension"
    size=$(stat -c %s "whole.$extension")
    for part in 1 5 20 40 60 80 95; do
      head -c "$((size * part / 100))" "whole.$extension" > "part.$extension"
      refused "part.$extension"
    done
  done
}

# Promise: clouds without any extent, or without a number, are refused; two points are enough.
test_few_points()
{
  echo '1 2 3' > one.xyz
  refused one.xyz
  printf '1 2 3\n%.0s' {1..100} > equal.xyz
  refused equal.xyz
  printf 'nan inf -inf\n%.0s' {1..100} > nan.xyz
  refused nan.xyz
  printf '1 2 3\n2 3 4\n' > two.xyz
  expect 0 reconstruct two.xyz mesh.obj
  grep -q '^neuralmesh: warning: 100 vertices from 2 points' err || fail "there was no warning"
  [ "$(grep -c '^v ' mesh.obj)" -eq 100 ] || fail "not 100 vertices"
  printf 'nan 0 0\n' | cat - cloud.xyz > some.xyz
  expect 0 reconstruct some.xyz mesh.obj
  grep -q '(1 dropped)' out || fail "the dropped point was not counted"
}

# Promise: a mesh with cells and attributes is a cloud as any other.
test_cells_and_attributes()
{
  local extension
  for extension in "${writable[@]}"; do
    expect 0 reconstruct cloud.xyz "first.$extension"
    expect 0 reconstruct "first.$extension" "second.$extension"
    [ ! -s err ] || { cat err; fail "there is something on stderr"; }
  done
}

# Promise: a file that vanishes, ends or begins while it is read gives a mesh or one line.
test_gone_while_reading()
{
  local extension status
  cp cloud.xyz whole.xyz
  expect 0 reconstruct cloud.xyz whole.ply
  expect 0 reconstruct cloud.xyz whole.vtp
  for extension in xyz ply vtp; do
    while :; do
      cp "whole.$extension" "input.$extension"
      head -c 2000 "whole.$extension" > "input.$extension"
      rm "input.$extension"
    done &
    for _ in $(seq 25); do
      status=0
      reconstruct "input.$extension" mesh.obj > out 2> err || status=$?
      case $status in
        0) [ "$(grep -c '^v ' mesh.obj)" -eq 100 ] || fail "not 100 vertices" ;;
        1) is_one_line_about "input.$extension" ;;
        *) cat err; fail "status $status" ;;
      esac
    done
    kill $!
    wait $! || true
  done
}

# Promise: where nothing can be written one line says so, before anything is learnt if that can be
# told, and nothing stays behind.
test_unwritable()
{
  local extension output
  mkdir closed
  chmod 555 closed
  for extension in "${writable[@]}"; do
    mkdir "taken.$extension"
    # Not even root makes files in /proc.
    for output in "nowhere/mesh.$extension" "taken.$extension" "/proc/mesh.$extension" \
      "cloud.xyz/mesh.$extension"; do
      expect 1 reconstruct cloud.xyz "$output"
      is_one_line_about "$output"
      nothing_left_behind
    done
    [ "$(id -u)" -eq 0 ] || expect 1 reconstruct cloud.xyz "closed/mesh.$extension"
  done
  expect 1 timeout 10 "$neuralmesh" reconstruct cloud.xyz nowhere/mesh.ply --vertices 100000000
  expect 1 reconstruct cloud.xyz mesh.unknown
  is_one_line_about mesh.unknown
  expect 1 reconstruct cloud.xyz mesh
  is_one_line_about mesh
}

# Promise: if writing fails, what was there stays, and nothing else is left behind.
test_disk_full()
{
  local extension
  for extension in "${writable[@]}"; do
    echo "what was there" > "mesh.$extension"
    (
      ulimit -f 16 # blocks of 1 KiB: too few for the mesh
      trap '' XFSZ
      expect 1 "$neuralmesh" reconstruct cloud.xyz "mesh.$extension" --vertices 2000
    ) || fail "a failed write of .$extension was not noticed"
    is_one_line_about "mesh.$extension"
    [ "$(cat "mesh.$extension")" = "what was there" ] || fail "the old .$extension is gone"
    nothing_left_behind
  done
}

make_cloud
"test_$2"
