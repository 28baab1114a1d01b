// SPDX-License-Identifier: BSD-3-Clause
#ifndef BashCompletion_h
#define BashCompletion_h

#include <iosfwd>

namespace CLI
{
class App;
}

/** Writes a script that bash reads when neuralmesh is to be completed for the first time. */
void WriteBashCompletion(const CLI::App& application, std::ostream& script);

#endif
