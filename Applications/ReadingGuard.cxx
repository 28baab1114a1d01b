// SPDX-License-Identifier: BSD-3-Clause
#include "ReadingGuard.h"

#include <array>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

namespace
{
// The last but one is sent when the time is up.
constexpr std::array CaughtSignals{ SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPROF, SIGABRT };

constexpr std::uintmax_t MegaByte = 1 << 20;
constexpr std::uintmax_t MemoryForAnyFile = 1024 * MegaByte, MemoryForAByte = 100;
constexpr std::uintmax_t SecondsForAnyFile = 10, SecondsForAMegaByte = 10;

// For the handler, and to put everything back.
struct
{
  std::string Message;
  int Stderr = -1;
  std::array<struct sigaction, CaughtSignals.size()> Actions;
  stack_t Stack;
  rlimit Memory;
} Saved;

// A stack that has overflowed is no place for a handler.
std::array<char, 1 << 16> HandlerStack;

extern "C" void EndWithMessage(int)
{
  [[maybe_unused]] const ssize_t written =
    write(Saved.Stderr, Saved.Message.data(), Saved.Message.size());
  _exit(1);
}

void CatchSignals()
{
  stack_t stack{};
  stack.ss_sp = HandlerStack.data();
  stack.ss_size = HandlerStack.size();
  sigaltstack(&stack, &Saved.Stack);
  struct sigaction action = {};
  action.sa_handler = EndWithMessage;
  action.sa_flags = SA_ONSTACK;
  for (std::size_t i = 0; i < CaughtSignals.size(); ++i)
  {
    sigaction(CaughtSignals[i], &action, &Saved.Actions[i]);
  }
}

void HideStderr()
{
  Saved.Stderr = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

/** Beyond what is in use; no limit where the system does not tell that. */
void LimitMemory(std::uintmax_t bytes)
{
  getrlimit(RLIMIT_AS, &Saved.Memory);
  rlim_t pages = 0;
  if (std::ifstream("/proc/self/statm") >> pages)
  {
    rlimit limit = Saved.Memory;
    limit.rlim_cur =
      std::min<rlim_t>(limit.rlim_cur, pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + bytes);
    setrlimit(RLIMIT_AS, &limit);
  }
}

/** Of computing; 0 for any number. */
void LimitSeconds(std::uintmax_t seconds)
{
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  setitimer(ITIMER_PROF, &timer, nullptr);
}
}

ReadingGuard::ReadingGuard(const std::string& path)
{
  Saved.Message = "neuralmesh: " + Message(path) + "\n";
  std::error_code error;
  const std::uintmax_t found = std::filesystem::file_size(path, error);
  const std::uintmax_t size = error ? 0 : found;
  HideStderr();
  CatchSignals();
  LimitMemory(MemoryForAnyFile + MemoryForAByte * size);
  LimitSeconds(SecondsForAnyFile + SecondsForAMegaByte * (size / MegaByte));
}

ReadingGuard::~ReadingGuard()
{
  LimitSeconds(0);
  setrlimit(RLIMIT_AS, &Saved.Memory);
  for (std::size_t i = 0; i < CaughtSignals.size(); ++i)
  {
    sigaction(CaughtSignals[i], &Saved.Actions[i], nullptr);
  }
  sigaltstack(&Saved.Stack, nullptr);
  dup2(Saved.Stderr, STDERR_FILENO);
  close(Saved.Stderr);
}

std::string ReadingGuard::Message(const std::string& path)
{
  return path + ": damaged, or not what its extension says: it cannot be read to its end";
}
