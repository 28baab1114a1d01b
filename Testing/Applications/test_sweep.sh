#!/usr/bin/env bash
# Promise: every combination of method, order, jump and topology that the command offers gives an
# oriented manifold, and the others are refused with words: test_sweep.sh COMMAND PYTHON
set -euo pipefail
here=$(dirname "$(realpath "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
PYTHONPATH="$here/../Support" "$2" -c "
import clouds
clouds.write_ply('$folder/torus.ply', clouds.torus(5000))"
"$2" "$here/sweep.py" --vertices 400 "$1" "$folder/torus.ply"
