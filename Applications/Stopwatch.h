// SPDX-License-Identifier: BSD-3-Clause
#ifndef Stopwatch_h
#define Stopwatch_h

#include <chrono>

class Stopwatch
{
public:
  /** Seconds since the last call. */
  double Lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - this->Last).count();
    this->Last = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point Last = std::chrono::steady_clock::now();
};

#endif
