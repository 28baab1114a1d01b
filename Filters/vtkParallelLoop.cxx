// SPDX-License-Identifier: BSD-3-Clause
#include "vtkParallelLoop.h"

#include "vtkSMPTools.h"

void vtkParallelLoop::Run(std::size_t count, const std::function<void(std::size_t)>& body)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        body(static_cast<std::size_t>(i));
      }
    });
}

int vtkParallelLoop::GetNumberOfThreads() { return vtkSMPTools::GetEstimatedNumberOfThreads(); }
