# SPDX-License-Identifier: BSD-3-Clause
"""What the functions work by: the C++ classes of the VTK that this package was built with, or the engine
alone.
"""

from typing import TYPE_CHECKING

from ._build import VTK_VERSION

# Type checkers take the names for those of one module.
if TYPE_CHECKING or not VTK_VERSION:
    from .engine.world import *
else:
    from ._wrapped import *
