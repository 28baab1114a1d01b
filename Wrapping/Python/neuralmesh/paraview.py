# SPDX-License-Identifier: BSD-3-Clause
"""The command neuralmesh paraview: where the plugin for ParaView is, and how ParaView loads it."""

from __future__ import annotations

import argparse
import os
import shlex
import site
import sys
from typing import Sequence

from ._build import VTK_VERSION

_PLUGIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "paraview_plugin.py")
_COMPILED = """\
This package belongs to the compiled plugin, NeuralMesh.so: the Debian package has it, and ParaView loads
it by itself. See Documentation/Guide/ParaView.md for others.
"""
_PYTHON = """\
The plugin for ParaView is this file:

    {plugin}

It works in a ParaView whose Python is {version}, as that of this package. In ParaView: Tools > Manage
Plugins > Load New, choose the file, and check Auto Load to have it from then on. In pvpython and pvbatch:

    from paraview.simple import *
    LoadPlugin({plugin!r}, ns=globals())

This needs no settings. A script that imports neuralmesh itself finds it by

    PYTHONPATH={folder} pvpython script.py
"""
# inspect.getargspec is gone from Python 3.11, and ParaView 5.11 calls it for each plugin in Python.
_OLD_PARAVIEW = """
ParaView 5.11 with Python 3.11 needs these lines in usercustomize.py, in the folder {site}:

    import inspect
    inspect.getargspec = inspect.getfullargspec
"""


def main(arguments: Sequence[str]) -> int:
    """Run the command with its arguments; the exit status."""
    parser = argparse.ArgumentParser(
        prog="neuralmesh paraview", description="Tells how ParaView gets the filters."
    )
    parser.add_argument(
        "--path", action="store_true", help="print the path of the plugin's file, and nothing else"
    )
    options = parser.parse_args(list(arguments))
    if VTK_VERSION:
        print(_COMPILED, end="", file=sys.stderr if options.path else sys.stdout)
        return 1 if options.path else 0
    if options.path:
        print(_PLUGIN)
        return 0
    version = "{}.{}".format(*sys.version_info)
    folder = shlex.quote(os.path.dirname(os.path.dirname(_PLUGIN)))
    print(_PYTHON.format(plugin=_PLUGIN, version=version, folder=folder), end="")
    if sys.version_info[:2] == (3, 11):
        print(_OLD_PARAVIEW.format(site=site.getusersitepackages()), end="")
    return 0
