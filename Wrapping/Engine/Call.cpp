// SPDX-License-Identifier: BSD-3-Clause
#include "Call.h"

namespace nb = nanobind;

namespace neuralmesh::binding
{
bool Call::report(double fraction)
{
  if (goesOn_ && throttle_.isDue(fraction))
  {
    with([&] { tell(fraction); });
  }
  return goesOn_;
}

/// Only what is false itself ends the run: most functions return None.
void Call::tell(double fraction)
{
  if (PyErr_CheckSignals() != 0)
  {
    throw nb::python_error();
  }
  if (!function_.is_none() && function_(fraction).is(nb::bool_(false)))
  {
    goesOn_ = false;
  }
}

Progress Call::part(double begin, double end)
{
  return [this, begin, end](double fraction) { return report(begin + fraction * (end - begin)); };
}

void Call::rethrow()
{
  if (error_)
  {
    nb::python_error error = std::move(*error_);
    error_.reset();
    throw error;
  }
}
}
