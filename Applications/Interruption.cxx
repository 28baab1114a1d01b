// SPDX-License-Identifier: BSD-3-Clause
#include "Interruption.h"

#include "vtkAlgorithm.h"

#include <csignal>

namespace
{
volatile std::sig_atomic_t Interrupted = 0;

extern "C" void Interrupt(int) { Interrupted = 1; }
}

Interruption::Interruption()
{
  Interrupted = 0;
  this->Before = std::signal(SIGINT, Interrupt);
}

Interruption::~Interruption() { std::signal(SIGINT, this->Before); }

void Interruption::Execute(vtkObject* caller, unsigned long, void*)
{
  auto* filter = vtkAlgorithm::SafeDownCast(caller);
  if (Interrupted && filter)
  {
    filter->SetAbortExecute(1);
  }
}
