#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The pages of Markdown in the repository, their blocks of code, headings and links.

The first word behind the fence of a block is its language; others say what becomes of it in the tests:

    ```sh                 run, in the order of the page
    ```sh norun=REASON    not run, for one of REASONS
    ```python file=NAME   saved under this name, for the blocks that follow
    ```sh needs=NAME      run where there is this package of Python, one of PACKAGES
    ```text output        what the block of shell before it prints; ... stands for anything

Run as a script with the root of the repository: prints the pages that have blocks to run, and whether
they need ParaView.
"""

import collections
import dataclasses
import functools
import pathlib
import re
import sys

from repository_copy import repository_files

REASONS = {
    "root": "installs something, or is for root alone",
    "build": "builds or tests the whole repository",
    "long": "measures or tests for minutes",
    "window": "opens a window, or waits for somebody",
    "cluster": "needs machines or files that are not here",
}
RUN = {"sh", "python"}
LANGUAGES = {*RUN, "cpp", "cmake", "json", "diff", "text"}
# Packages that not every Python has, and the test that runs the blocks that need them.
PACKAGES = {
    "pyvista": "Testing/Python/test_pyvista.py",
    "mpi4py": "Testing/Documentation/run_blocks.py",
}
# Run by a test that knows what stands on the page.
ELSEWHERE = {
    "Documentation/Guide/ParaView.md": "ParaView.tutorial",
}


@dataclasses.dataclass
class Block:
    line: int
    language: str
    words: list
    text: str

    def value(self, name):
        """What stands behind NAME= in the words; None if it is not there."""
        return next((word[len(name) + 1:] for word in self.words if word.startswith(name + "=")), None)

    @property
    def is_saved(self):
        return self.value("file") is not None

    @property
    def is_run(self):
        return self.language in RUN and not self.is_saved and self.value("norun") is None


@dataclasses.dataclass
class Page:
    path: pathlib.Path
    name: str  # relative to the root

    @functools.cached_property
    def lines(self):
        return self.path.read_text(encoding="utf-8").splitlines()

    @functools.cached_property
    def parts(self):
        """Blocks, and lines of prose with their numbers, as they come."""
        parts, fence = [], None
        for number, line in enumerate(self.lines, 1):
            if line.startswith("```"):
                if fence is None:
                    language, *words = line[3:].split() or [""]
                    fence = Block(number, language, words, "")
                else:
                    parts.append(fence)
                    fence = None
            elif fence is not None:
                fence.text += line + "\n"
            else:
                parts.append((number, line))
        return parts

    @property
    def blocks(self):
        return [part for part in self.parts if isinstance(part, Block)]

    @property
    def prose(self):
        return [part for part in self.parts if not isinstance(part, Block)]

    @functools.cached_property
    def anchors(self):
        """The anchors of the headings, as GitHub makes them."""
        seen, anchors = collections.Counter(), set()
        for _, line in self.prose:
            heading = re.match(r"#+ +(.*?) *#*$", line)
            if heading:
                text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading[1]).lower()
                anchor = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
                anchors.add(f"{anchor}-{seen[anchor]}" if seen[anchor] else anchor)
                seen[anchor] += 1
        return anchors

    @property
    def links(self):
        """The targets of links and pictures, which may go over the end of a line."""
        text = re.sub(r"`[^`]*`", "", "\n".join(line for _, line in self.prose))
        return [target.split()[0] for target in re.findall(r"\]\(([^)]+)\)", text)]

    @property
    def pictures(self):
        return re.findall(r"!\[[^]]+\]\(([^)]+)\)", "\n".join(line for _, line in self.prose))

    @property
    def needs_paraview(self):
        return any("paraview.simple" in block.text for block in self.blocks if block.language == "python")


def pages(root):
    """Those of the repository: Markdown that a user keeps beside it is none of ours."""
    root = pathlib.Path(root)
    return [Page(root / path, path.as_posix()) for path in repository_files(root)
            if path.suffix == ".md" and re.match("[A-Z].*/|[^/]*$", path.as_posix())]


def main():
    for page in pages(sys.argv[1]):
        if any(block.is_run for block in page.blocks) and page.name not in ELSEWHERE:
            print(page.name, "pvpython" if page.needs_paraview else "python3")


if __name__ == "__main__":
    main()
