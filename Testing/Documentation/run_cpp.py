#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program of all blocks of C++, in a folder with what they take as given:
run_cpp.py ROOT BUILD PROGRAM"""

import pathlib
import subprocess
import sys

import givens
from repository_copy import repository_copy


def main():
    root, build, program = (pathlib.Path(path).resolve() for path in sys.argv[1:])
    with repository_copy(root) as folder:
        givens.make_files(folder, build, "")
        process = subprocess.run([program], cwd=folder, capture_output=True, text=True)
    print(process.stdout + process.stderr)
    # Errors of VTK are told on stderr, and end nothing.
    return 1 if process.returncode or "ERROR:" in process.stderr else 0


if __name__ == "__main__":
    sys.exit(main())
