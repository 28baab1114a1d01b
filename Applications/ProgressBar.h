// SPDX-License-Identifier: BSD-3-Clause
#ifndef ProgressBar_h
#define ProgressBar_h

#include "vtkCommand.h"

#include <chrono>

/**
 * Shows the progress of a filter on stderr: a bar, the rate and the time that remains. Shows
 * nothing if stderr is no terminal.
 */
class ProgressBar : public vtkCommand
{
public:
  static ProgressBar* New() { return new ProgressBar; }
  vtkTypeMacro(ProgressBar, vtkCommand)

  /** The number of vertices that the whole run is to give, for the rate. */
  void SetNumberOfVertices(long long count) { this->NumberOfVertices = count; }

  void Execute(vtkObject* caller, unsigned long event, void* callData) override;

  /** Takes the bar off the terminal. */
  void Clear();

private:
  ProgressBar();

  bool OnTerminal;
  bool Shown = false;
  long long NumberOfVertices = 0;
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

#endif
