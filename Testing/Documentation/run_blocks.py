#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the blocks of shell and Python of a page, one after the other: run_blocks.py ROOT BUILD PAGE

They run in a folder that looks like that of the repository, with BUILD as `build`, and has what pages
take as given: see givens.py. Blocks of Python share their variables. Prints what it runs.
"""

import doctest
import os
import pathlib
import subprocess
import sys
import tempfile
import traceback

import givens
from markdown_pages import Page

SAME = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


class Failure(Exception):
    pass


def shell_environment(build):
    # A process that belongs to MPI has variables that are not for another one.
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_"))
    }
    environment["PATH"] = f"{build / 'bin'}:{os.environ['PATH']}"
    environment["OMPI_ALLOW_RUN_AS_ROOT"] = environment["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1"
    environment["OMPI_MCA_rmaps_base_oversubscribe"] = "1"
    return environment


def run_shell(text, folder, environment):
    process = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", text],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    if process.returncode != 0:
        raise Failure(f"exit status {process.returncode}\n{process.stdout}")
    return process.stdout


def check_output(wanted, printed):
    if not doctest.OutputChecker().check_output(wanted, printed, SAME):
        raise Failure(f"printed was\n{printed}")


def save(path, text):
    """Writes a file that is not there yet: never through a link into the repository."""
    path.parent.mkdir(exist_ok=True)
    with open(path, "x", encoding="utf-8") as file:
        file.write(text)


def play(page, folder, build):
    environment = shell_environment(build)
    variables = givens.variables()
    printed = ""
    for block in page.blocks:
        print(f"{page.name}:{block.line}: {block.language} {' '.join(block.words)}", flush=True)
        try:
            if block.is_saved:
                save(folder / block.value("file"), block.text)
            elif block.words == ["output"]:
                check_output(block.text, printed)
            elif block.language == "sh" and block.is_run:
                printed = run_shell(block.text, folder, environment)
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
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        givens.make_files(folder, root, build, page.name)
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
