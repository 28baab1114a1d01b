#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the blocks of shell and Python of a page, one after the other: run_blocks.py ROOT BUILD PAGE

They run in a copy of the repository, with BUILD as `build`, that has what pages take as given: see
givens.py. Blocks of Python share their variables. Blocks of shell are one session: what one of them
exports, and the folder that it goes to, are there for the next. Nothing else leads to what was built, so
that commands work as they are printed. Prints what it runs, and which blocks it leaves out, as what they need
is not there.
"""

import doctest
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import traceback

import givens
from markdown_pages import Page
from repository_copy import repository_copy

SET_BY_PAGES = {"PYTHONPATH", "PV_PLUGIN_CONFIG_FILE"}
SAME = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


class Failure(Exception):
    pass


def shell_environment(folder, build):
    """That of somebody who has come to the folder, and has set nothing for NeuralMesh yet."""
    # A process that belongs to MPI has variables that are not for another one.
    environment = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("OMPI_", "PMIX_")) and name not in SET_BY_PAGES
    }
    programs = os.environ["PATH"].split(os.pathsep)
    programs = [path for path in programs if pathlib.Path(path).resolve() != build / "bin"]
    environment["PATH"] = os.pathsep.join(programs)
    environment["PWD"] = str(folder)
    environment["OMPI_ALLOW_RUN_AS_ROOT"] = environment["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1"
    environment["OMPI_MCA_rmaps_base_oversubscribe"] = "1"
    return environment


def run_shell(text, environment):
    """Runs it in the folder PWD of the environment, which becomes what the block leaves to the next."""
    with tempfile.NamedTemporaryFile() as left:
        process = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", f'{text}\nenv -0 > "$1"', "bash", left.name],
            cwd=environment["PWD"],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        if process.returncode != 0:
            raise Failure(f"exit status {process.returncode}\n{process.stdout}")
        variables = os.fsdecode(left.read()).split("\0")[:-1]
    environment.clear()
    environment.update(variable.split("=", 1) for variable in variables)
    return process.stdout


def check_output(wanted, printed):
    if not doctest.OutputChecker().check_output(wanted, printed, SAME):
        raise Failure(f"printed was\n{printed}")


def save(path, text):
    """Writes a file that is not there yet: no page changes a file of the repository."""
    path.parent.mkdir(exist_ok=True)
    with open(path, "x", encoding="utf-8") as file:
        file.write(text)


def is_missing(package):
    return package is not None and importlib.util.find_spec(package) is None


def play(page, folder, build):
    environment = shell_environment(folder, build)
    variables = givens.variables()
    printed = ""
    for block in page.blocks:
        print(f"{page.name}:{block.line}: {block.language} {' '.join(block.words)}", flush=True)
        if is_missing(block.value("needs")):
            print(f"left out: there is no {block.value('needs')}")
            continue
        try:
            if block.is_saved:
                save(folder / block.value("file"), block.text)
            elif block.words == ["output"]:
                check_output(block.text, printed)
            elif block.language == "sh" and block.is_run:
                printed = run_shell(block.text, environment)
            elif block.language == "python" and block.is_run:
                # Lines of a traceback are those of the page.
                code = "\n" * block.line + block.text
                exec(compile(code, str(page.path), "exec"), variables)
        except Failure as failure:
            return f"{page.name}:{block.line}: {failure}"
        except Exception:  # of the block
            return f"{page.name}:{block.line}: {traceback.format_exc()}"
    return ""


def main():
    root, build = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
    page = Page(root / sys.argv[3], sys.argv[3])
    with repository_copy(root) as folder:
        givens.make_files(folder, build, page.name)
        os.chdir(folder)
        problem = play(page, folder, build)
        os.chdir(root)
    print(problem or "all well")
    if page.needs_paraview:
        # Views that are left to the end of the process end it with an error of X.
        from paraview import simple

        for view in simple.GetViews():
            simple.Delete(view)
    return 1 if problem else 0


if __name__ == "__main__":
    sys.exit(main())
