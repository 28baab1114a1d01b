# SPDX-License-Identifier: BSD-3-Clause
"""Runs a command with so many seconds of CPU time: launch.py SECONDS COMMAND...

The last line on stdout has its status, its CPU seconds and the most memory in kB. A process counts the memory of
the one that started it as its own, so that one must be small: nothing but this is imported here.
"""

import resource
import subprocess
import sys

seconds = int(sys.argv[1])
resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
status = subprocess.run(sys.argv[2:], stdout=subprocess.DEVNULL).returncode
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(status, used.ru_utime + used.ru_stime, used.ru_maxrss)
