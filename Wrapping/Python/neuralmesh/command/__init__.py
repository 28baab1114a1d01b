# SPDX-License-Identifier: BSD-3-Clause
"""The command neuralmesh without VTK's C++ classes: what the program of the same name does, by the engine."""

from .line import main

__all__ = ["main"]
