// SPDX-License-Identifier: BSD-3-Clause
#include "ProgressBar.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <unistd.h>

namespace
{
constexpr int Width = 30;
}

ProgressBar::ProgressBar()
  : OnTerminal(isatty(STDERR_FILENO) == 1)
{
}

void ProgressBar::Execute(vtkObject*, unsigned long event, void* callData)
{
  if (!this->OnTerminal || event != vtkCommand::ProgressEvent)
  {
    return;
  }
  const double done = std::clamp(*static_cast<double*>(callData), 0.0, 1.0);
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  if (done <= 0.0 || seconds <= 0.0)
  {
    return;
  }
  const auto filled = static_cast<std::size_t>(done * Width);
  const std::string bar = std::string(filled, '#') + std::string(Width - filled, '.');
  const double rate = done * static_cast<double>(this->NumberOfVertices) / seconds;
  std::fprintf(stderr, "\r[%s] %3.0f %%  %.0f vertices/s  %.1f s left \033[K", bar.c_str(),
    100.0 * done, rate, seconds * (1.0 - done) / done);
  std::fflush(stderr);
  this->Shown = true;
}

void ProgressBar::Clear()
{
  if (this->Shown)
  {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    this->Shown = false;
  }
}
