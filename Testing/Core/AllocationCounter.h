// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace neuralmesh::testing
{
/// How often `operator new`, which this executable replaces, has been called so far.
std::size_t allocationCount();
}
