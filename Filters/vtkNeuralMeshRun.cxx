// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshRun.h"

#include "base/AvailableProcessors.h"

#include "vtkAlgorithm.h"

#include <algorithm>
#include <cstdlib>

unsigned vtkNeuralMeshThreads(int wanted)
{
  if (wanted > 0)
  {
    return static_cast<unsigned>(wanted);
  }
  const unsigned available = neuralmesh::availableProcessors();
  const char* const text = std::getenv("VTK_SMP_MAX_THREADS");
  const int most = text ? std::atoi(text) : 0;
  return most > 0 ? std::min(available, static_cast<unsigned>(most)) : available;
}

void vtkNeuralMeshProgress::EnterPart(double begin, double end)
{
  this->Begin = begin;
  this->End = end;
}

bool vtkNeuralMeshProgress::Report(double fraction)
{
  const double done = this->Begin + fraction * (this->End - this->Begin);
  if (this->Throttle.isDue(done))
  {
    this->Filter->UpdateProgress(done);
  }
  // Not CheckAbort(): it would have the executive throw away the mesh learnt so far.
  return !this->Filter->GetAbortExecute();
}

neuralmesh::Progress vtkNeuralMeshProgress::GetPart(double begin, double end)
{
  return [this, begin, end](double fraction)
  { return this->Report(begin + fraction * (end - begin)); };
}

void vtkNeuralMeshProgress::Abort() { this->Filter->SetAbortExecute(1); }

double vtkNeuralMeshProgress::GetSeconds() const
{
  return std::chrono::duration<double>(Clock::now() - this->Start).count();
}
