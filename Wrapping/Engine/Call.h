// SPDX-License-Identifier: BSD-3-Clause
// How Python hears of a run while that does not hold its lock.
#pragma once

#include "base/Progress.h"
#include "base/ProgressThrottle.h"

#include <nanobind/nanobind.h>

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

  bool report(double fraction);
  Progress part(double begin, double end);
  /// Calls something else of Python, with the lock held; what that raises ends the run, too.
  template <typename Use>
  void with(const Use& use);

  bool goesOn() const { return goesOn_; }
  /// Raises what was raised, with the lock held.
  void rethrow();

private:
  void tell(double fraction);

  nanobind::object function_;
  ProgressThrottle throttle_;
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
