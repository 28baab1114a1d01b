// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace neuralmesh
{
/// How many threads can run at the same time in this process: its affinity mask and the CPU quota of its control group
/// count, as they are set for jobs of a cluster and for containers. At least 1.
unsigned availableProcessors();
}
