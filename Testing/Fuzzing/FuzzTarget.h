// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// What a fuzzer calls: does with the bytes what somebody might, and aborts where a promise is
/// broken. Returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace neuralmesh::testing
{
/// Inputs to begin with, and to change.
std::vector<std::vector<std::uint8_t>> fuzzSeeds();
}
