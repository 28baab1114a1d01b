# SPDX-License-Identifier: BSD-3-Clause
"""What the functions work by: the C++ classes of the VTK that this package was built with, or the engine
alone.
"""

from ._build import VTK_VERSION

if VTK_VERSION:
    from ._wrapped import *
else:
    from .engine.world import *
