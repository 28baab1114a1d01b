#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Follows the recipe of Documentation/Developers/Extending.md: run_recipe.py ROOT COMPILER OPTION...

The blocks of diff are applied to a copy of the engine, what follows from the list of parameters is written,
the files of the page are added, and all of it is compiled. The tests among them must pass.
"""

import pathlib
import subprocess
import sys

from markdown_pages import Page
from repository_copy import repository_copy

PAGE = pathlib.PurePath("Documentation", "Developers", "Extending.md")


def run(command, **options):
    process = subprocess.run(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options
    )
    print(process.stdout, flush=True)
    if process.returncode:
        sys.exit(f"{command[0]}: status {process.returncode}")


def check_places(folder, files):
    """A new parameter stands in the list, in its use, in its test and on the page alone."""
    text = (folder / "Filters" / "Parameters.json").read_text(encoding="utf-8")
    tested = [pathlib.Path(name).stem.removeprefix("Test") for name in files]
    (parameter,) = (name for name in tested if f'"name": "{name}", "type"' in text)
    found = {
        path.name for path in folder.rglob("*")
        if path.is_file() and parameter.lower().encode() in path.read_bytes().lower()
    }
    wanted = {
        "Parameters.json", "WinGain.cpp", "ParallelLearner.cpp", f"Test{parameter}.cpp", PAGE.name
    }
    if found != wanted:
        sys.exit(f"{parameter} stands in {', '.join(sorted(found))}")


def main():
    options = ["-std=c++20", "-O1", '-DNEURALMESH_VERSION="recipe"']
    compile_command = [*sys.argv[2:], *options, "-I", "Filters/Core", "-I", "build/Filters/Core"]
    with repository_copy(sys.argv[1]) as folder:
        core = folder / "Filters" / "Core"
        blocks = Page(folder / PAGE, str(PAGE)).blocks
        patches = [block.text for block in blocks if block.language == "diff"]
        files = {block.value("file"): block.text for block in blocks if block.is_saved}
        run(["patch", "-p1"], input="".join(patches), cwd=folder)
        for name, text in files.items():
            (core / name).write_text(text, encoding="utf-8")
        check_places(folder, files)
        run([sys.executable, "CMake/Parameters/generate.py", ".", "build"], cwd=folder)
        rooms = []
        # A room in one go, as in the build: most of the time goes into the headers.
        for room in sorted({path.parent for path in core.rglob("*.cpp")}):
            names = sorted(path.name for path in room.glob("*.cpp"))
            rooms.append(room / "All.cpp")
            rooms[-1].write_text("".join(f'#include "{name}"\n' for name in names), encoding="utf-8")
        libraries = ["-lgtest", "-lgtest_main", "-lpthread"]
        run([*compile_command, *map(str, rooms), *libraries, "-o", "test"], cwd=folder)
        run([f"{folder}/test"])


if __name__ == "__main__":
    main()
