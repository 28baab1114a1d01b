// SPDX-License-Identifier: BSD-3-Clause
#ifndef FishCompletion_h
#define FishCompletion_h

#include <iosfwd>

namespace CLI
{
class App;
}

/** Writes a script that fish reads when neuralmesh is to be completed for the first time. */
void WriteFishCompletion(const CLI::App& application, std::ostream& script);

#endif
