# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m neuralmesh.lab NAME...|all"""

import sys

from .command import main

sys.exit(main())
