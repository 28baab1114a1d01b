// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace neuralmesh
{
/// Text from a file or from a library, fit to be a part of a message of one line: line ends and runs of
/// blanks become one blank, what a terminal cannot show a question mark; text of more than `most` characters is cut.
std::string oneLine(std::string_view text, std::size_t most = 300);
}
