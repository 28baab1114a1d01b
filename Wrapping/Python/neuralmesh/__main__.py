# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m neuralmesh: the command; where C++ classes of VTK are, a program has all of it but batch."""

import sys

from ._build import VTK_VERSION

if VTK_VERSION:
    from .batch.command import main
else:
    from .command import main

if __name__ == "__main__":
    sys.exit(main())
