// SPDX-License-Identifier: BSD-3-Clause
#ifndef ManPage_h
#define ManPage_h

#include <iosfwd>

namespace CLI
{
class App;
}

/** Writes neuralmesh(1): all subcommands, their options and what stands below them in the help. */
void WriteManPage(const CLI::App& application, std::ostream& page);

#endif
