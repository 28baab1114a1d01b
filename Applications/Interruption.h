// SPDX-License-Identifier: BSD-3-Clause
#ifndef Interruption_h
#define Interruption_h

#include "vtkCommand.h"

/**
 * As long as there is one, Ctrl-C does not end the process: it aborts the filter whose progress is
 * observed, and what that filter gives can still be written. For one at a time.
 */
class Interruption : public vtkCommand
{
public:
  static Interruption* New() { return new Interruption; }
  vtkTypeMacro(Interruption, vtkCommand)

  void Execute(vtkObject* caller, unsigned long event, void* callData) override;

protected:
  Interruption();
  ~Interruption() override;

private:
  void (*Before)(int);
};

#endif
