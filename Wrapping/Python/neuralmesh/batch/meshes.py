# SPDX-License-Identifier: BSD-3-Clause
"""Files of points and of meshes, by the C++ classes of VTK or by the engine alone, as this package was
built.
"""

from .._build import VTK_VERSION

if VTK_VERSION:
    from .wrapped_meshes import *
else:
    from .engine_meshes import *
