// SPDX-License-Identifier: BSD-3-Clause
#include "ThreadPool.h"

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
    pthread_sigmask(SIG_BLOCK, &signals, &this->before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &this->before_, nullptr); }
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
  const unsigned wanted = threadCount > 0 ? threadCount : std::thread::hardware_concurrency();
  const SignalsBlocked signalsBlocked;
  try
  {
    this->workers_.reserve(wanted);
    for (unsigned i = 1; i < wanted; ++i)
    {
      this->workers_.emplace_back([this] { this->work(); });
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
    const std::lock_guard lock(this->mutex_);
    this->isClosing_ = true;
  }
  this->begun_.notify_all();
  for (std::thread& worker : this->workers_)
  {
    worker.join();
  }
}

void ThreadPool::run(std::size_t count, Part part, const void* context) const
{
  if (count < 2 || this->workers_.empty() || this->isAtWork_.test_and_set())
  {
    runHere(count, part, context);
    return;
  }
  std::unique_lock lock(this->mutex_);
  this->job_ = { part, context, count, 0, 0, nullptr };
  this->begun_.notify_all();
  this->takeParts(lock);
  this->ended_.wait(lock, [this] { return this->job_.running == 0; });
  const std::exception_ptr error = std::exchange(this->job_, {}).error;
  lock.unlock();
  this->isAtWork_.clear();
  if (error)
  {
    std::rethrow_exception(error);
  }
}

void ThreadPool::work()
{
  std::unique_lock lock(this->mutex_);
  for (;;)
  {
    this->begun_.wait(
      lock, [this] { return this->isClosing_ || this->job_.next < this->job_.count; });
    if (this->isClosing_)
    {
      return;
    }
    this->takeParts(lock);
  }
}

/// Runs parts as long as there are any that no thread has taken.
void ThreadPool::takeParts(std::unique_lock<std::mutex>& lock) const
{
  Job& job = this->job_;
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
    this->ended_.notify_all();
  }
}
}
