#!/usr/bin/env bash
# Runs a command on a screen that nobody sees: with_screen.sh COMMAND...
# The server itself takes a screen that is free, so that any number of tests may do so at the same
# time; xvfb-run looks for one first, and two may find the same.
set -euo pipefail

coproc server { exec Xvfb -displayfd 1 -screen 0 1280x1024x24 -noreset -nolisten tcp 2> /dev/null; }
# After its end the shell forgets the number.
number=${server_PID:-}
trap 'kill "$number" 2> /dev/null || true' EXIT
read -r screen <&"${server[0]:-}" || { echo "$0: Xvfb does not start" >&2; exit 1; }
DISPLAY=:$screen "$@"
