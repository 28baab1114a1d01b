# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m neuralmesh batch: the commands that are Python."""

import sys

from .batch.command import main

sys.exit(main())
