// SPDX-License-Identifier: BSD-3-Clause
#ifndef OneLine_h
#define OneLine_h

#include <string>

/**
 * Text from a file or from VTK, fit to be a part of a message of one line: line ends and runs of
 * blanks become one blank, what a terminal cannot show a question mark; long text is cut.
 */
std::string OneLine(const std::string& text);

#endif
