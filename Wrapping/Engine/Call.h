// SPDX-License-Identifier: BSD-3-Clause
// How Python hears of a run while that does not hold its lock.
#pragma once

#include "base/Progress.h"

#include <nanobind/nanobind.h>

#include <chrono>
#include <optional>

namespace neuralmesh::binding
{
/// Tells a Python function how much of a run is done, and asks for signals (Ctrl-C), on the thread that
/// began the run. The run ends if the function returns False or raises. To be made with Python's lock
/// held, and used without.
class Call
{
public:
  /// Without a function, None, signals alone are asked for.
  explicit Call(nanobind::object function)
    : function_(std::move(function))
  {
  }

  /// Steps of a hundredth, and what comes 50 ms later, are told.
  bool report(double fraction);
  Progress part(double begin, double end);
  /// Calls something else of Python, with the lock held; what that raises ends the run, too.
  template <typename Use>
  void with(const Use& use);

  bool goesOn() const { return goesOn_; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// Raises what was raised, with the lock held.
  void rethrow();

private:
  using Clock = std::chrono::steady_clock;

  void tell(double fraction);

  nanobind::object function_;
  double reported_ = -1.;
  Clock::time_point start_ = Clock::now();
  Clock::time_point reportTime_ = Clock::now();
  bool goesOn_ = true;
  std::optional<nanobind::python_error> error_;
};

template <typename Use>
void Call::with(const Use& use)
{
  const nanobind::gil_scoped_acquire lock;
  if (error_)
  {
    return;
  }
  try
  {
    use();
  }
  catch (nanobind::python_error& error)
  {
    error_.emplace(std::move(error));
    goesOn_ = false;
  }
}
}
