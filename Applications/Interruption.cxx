// SPDX-License-Identifier: BSD-3-Clause
#include "Interruption.h"

#include "vtkAlgorithm.h"

#include <csignal>

namespace
{
volatile std::sig_atomic_t InterruptingSignal = 0;

extern "C" void Interrupt(int signal) { InterruptingSignal = signal; }

constexpr int Signals[] = { SIGINT, SIGTERM,
#ifdef SIGHUP
  SIGHUP
#endif
};
}

Interruption::Interruption()
{
  InterruptingSignal = 0;
  for (const int signal : Signals)
  {
    // What runs under nohup goes on when its terminal is closed, also at this moment.
    auto* const before = std::signal(signal, signal == SIGINT ? Interrupt : SIG_IGN);
    this->Before.emplace_back(signal, before);
    if (signal != SIGINT && before != SIG_IGN)
    {
      std::signal(signal, Interrupt);
    }
  }
}

Interruption::~Interruption()
{
  for (const auto& [signal, before] : this->Before)
  {
    std::signal(signal, before);
  }
}

int Interruption::GetExitStatus() const
{
  constexpr int StatusOfSignals = 128;
  return StatusOfSignals + (InterruptingSignal ? InterruptingSignal : SIGINT);
}

void Interruption::Execute(vtkObject* caller, unsigned long, void*)
{
  auto* filter = vtkAlgorithm::SafeDownCast(caller);
  if (InterruptingSignal && filter)
  {
    filter->SetAbortExecute(1);
  }
}
