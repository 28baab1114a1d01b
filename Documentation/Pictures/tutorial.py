# SPDX-License-Identifier: BSD-3-Clause
"""Plays Documentation/Guide/ParaView.md in pvpython: tutorial.py FOLDER

Runs its blocks of Python one after the other, and saves each picture that a block leads to as it is
on the screen then. A block with file=NAME behind its fence is written to that file.
"""

import os
import pathlib
import re
import sys

from paraview import simple

PAGE = pathlib.Path(__file__).parents[1] / "Guide" / "ParaView.md"
SIZE = [640, 480]


def steps():
    """Blocks of code as (language or file, text), and pictures as ("picture", name), as they come."""
    text = PAGE.read_text(encoding="utf-8")
    blocks = r"```(\w+)(?: file=(\S+))?\n(.*?)```|!\[[^]]*\]\(\.\./Pictures/(\w+\.png)\)"
    for match in re.finditer(blocks, text, re.DOTALL):
        language, file, code, picture = match.groups()
        yield (file or language, code) if language else ("picture", picture)


def play(folder):
    namespace = {}
    for kind, text in steps():
        if "." in kind:
            (folder / kind).write_text(text, encoding="utf-8")
        elif kind == "python":
            exec(compile(text, PAGE.name, "exec"), namespace)
        # The window of ParaView itself is for window.py.
        elif kind == "picture" and text != "tutorial_window.png":
            save_picture(folder / text)


def save_picture(path):
    view = simple.GetActiveView()
    view.ViewSize = SIZE
    view.OrientationAxesVisibility = 0
    simple.SaveScreenshot(str(path), view, ImageResolution=SIZE, CompressionLevel=9,
                          OverrideColorPalette="WhiteBackground")


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    os.chdir(folder)
    play(folder)
    # Views that are left to the end of the process end it with an error of X.
    for view in simple.GetViews():
        simple.Delete(view)


if __name__ == "__main__":
    main()
