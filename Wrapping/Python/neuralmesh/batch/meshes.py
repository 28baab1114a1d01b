# SPDX-License-Identifier: BSD-3-Clause
"""Files of points and of meshes, by the C++ classes of VTK or by the engine alone, as this package was
built.
"""

from typing import TYPE_CHECKING

from .._build import VTK_VERSION

# Type checkers take the names for those of one module.
if TYPE_CHECKING or not VTK_VERSION:
    from .engine_meshes import *
else:
    from .wrapped_meshes import *
