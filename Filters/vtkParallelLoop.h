// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkParallelLoop
 * @brief   a loop whose rounds run at the same time, by vtkSMPTools
 *
 * Internal to the module. In a file of its own, as VTK 9.1's vtkSMPTools.h is not valid in C++20.
 */

#ifndef vtkParallelLoop_h
#define vtkParallelLoop_h

#include <cstddef>
#include <functional>

class vtkParallelLoop
{
public:
  /** Calls `body` with 0 ... count - 1; returns when all calls have. They must not throw. */
  static void Run(std::size_t count, const std::function<void(std::size_t)>& body);

  /** The number of calls that run at the same time, about. */
  static int GetNumberOfThreads();
};

#endif
