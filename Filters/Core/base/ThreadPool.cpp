// SPDX-License-Identifier: BSD-3-Clause
#include "base/ThreadPool.h"

#include "base/AvailableProcessors.h"

#include <csignal>
#include <new>
#include <system_error>
#include <utility>

namespace neuralmesh
{
namespace
{
void runHere(std::size_t count, void (*part)(const void*, std::size_t), const void* context)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    part(context, i);
  }
}

class SequentialExecutor final : public Executor
{
public:
  unsigned threadCount() const override { return 1; }

protected:
  void run(std::size_t count, Part part, const void* context) const override
  {
    runHere(count, part, context);
  }
};

/// While it lives, threads begin with all signals blocked but those of their own faults. What is
/// sent to the process is for the threads of the application: Python, for one, does not notice a
/// Ctrl-C that another thread has taken.
class SignalsBlocked
{
public:
  SignalsBlocked()
  {
    sigset_t signals;
    sigfillset(&signals);
    for (const int fault : { SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGSYS, SIGTRAP })
    {
      sigdelset(&signals, fault);
    }
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

private:
  sigset_t before_;
};
}

const Executor& Executor::sequential()
{
  static const SequentialExecutor executor;
  return executor;
}

ThreadPool::ThreadPool(unsigned threadCount)
{
  const unsigned wanted = threadCount > 0 ? threadCount : availableProcessors();
  const SignalsBlocked signalsBlocked;
  try
  {
    workers_.reserve(wanted);
    for (unsigned i = 1; i < wanted; ++i)
    {
      workers_.emplace_back([this] { work(); });
    }
  }
  catch (const std::system_error&)
  {
    // No more threads are to be had.
  }
  catch (const std::bad_alloc&)
  {
    // Nor memory for them.
  }
}

ThreadPool::~ThreadPool()
{
  {
    const std::lock_guard lock(mutex_);
    isClosing_ = true;
  }
  begun_.notify_all();
  for (std::thread& worker : workers_)
  {
    worker.join();
  }
}

void ThreadPool::run(std::size_t count, Part part, const void* context) const
{
  if (count < 2 || workers_.empty() || isAtWork_.test_and_set())
  {
    runHere(count, part, context);
    return;
  }
  std::unique_lock lock(mutex_);
  job_ = { part, context, count, 0, 0, nullptr };
  begun_.notify_all();
  takeParts(lock);
  ended_.wait(lock, [this] { return job_.running == 0; });
  const std::exception_ptr error = std::exchange(job_, {}).error;
  lock.unlock();
  isAtWork_.clear();
  if (error)
  {
    std::rethrow_exception(error);
  }
}

void ThreadPool::work()
{
  std::unique_lock lock(mutex_);
  for (;;)
  {
    begun_.wait(lock, [this] { return isClosing_ || job_.next < job_.count; });
    if (isClosing_)
    {
      return;
    }
    takeParts(lock);
  }
}

/// Runs parts as long as there are any that no thread has taken.
void ThreadPool::takeParts(std::unique_lock<std::mutex>& lock) const
{
  Job& job = job_;
  ++job.running;
  while (job.next < job.count)
  {
    const std::size_t taken = job.next++;
    const Part part = job.part;
    const void* const context = job.context;
    lock.unlock();
    std::exception_ptr error;
    try
    {
      part(context, taken);
    }
    catch (...)
    {
      error = std::current_exception();
    }
    lock.lock();
    if (error && !job.error)
    {
      job.error = error;
      job.next = job.count;
    }
  }
  if (--job.running == 0)
  {
    ended_.notify_all();
  }
}
}
