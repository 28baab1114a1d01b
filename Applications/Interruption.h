// SPDX-License-Identifier: BSD-3-Clause
#ifndef Interruption_h
#define Interruption_h

#include "vtkCommand.h"

#include <utility>
#include <vector>

/**
 * As long as there is one, Ctrl-C does not end the process, nor does what asks it to end, as SIGTERM: it aborts the
 * filter whose progress is observed, and what that filter gives can still be written. For one at a time.
 */
class Interruption : public vtkCommand
{
public:
  static Interruption* New() { return new Interruption; }
  vtkTypeMacro(Interruption, vtkCommand)

  void Execute(vtkObject* caller, unsigned long event, void* callData) override;

  /** The exit status that shells give for what the signal has ended; that of Ctrl-C if there was none. */
  int GetExitStatus() const;

protected:
  Interruption();
  ~Interruption() override;

private:
  /** Signals, and what was done on them before. */
  std::vector<std::pair<int, void (*)(int)>> Before;
};

#endif
