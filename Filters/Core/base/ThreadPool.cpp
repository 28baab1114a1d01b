// SPDX-License-Identifier: BSD-3-Clause
#include "base/ThreadPool.h"

#include "base/AvailableProcessors.h"

#include <algorithm>
#include <chrono>
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

/// Threads look out for what they wait for so long before they sleep: to be woken takes longer than most of what one
/// thread does by itself in between. Not where there are more of them than the machine runs at the same time.
constexpr std::chrono::microseconds LookOut(20);
constexpr int LooksAtOnce = 64;

/// Until `isThere()`, or for some time.
template <typename IsThere>
void lookFor(unsigned threads, const IsThere& isThere)
{
  static const unsigned AtOnce = availableProcessors();
  if (threads > AtOnce)
  {
    return;
  }
  const auto end = std::chrono::steady_clock::now() + LookOut;
  do
  {
    for (int look = 0; look < LooksAtOnce; ++look)
    {
      if (isThere())
      {
        return;
      }
#if defined(__x86_64__) || defined(__i386__)
      __builtin_ia32_pause();
#endif
    }
  } while (std::chrono::steady_clock::now() < end);
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
    shares_ = std::vector<Share>(wanted);
    workers_.reserve(wanted);
    for (unsigned i = 1; i < wanted; ++i)
    {
      workers_.emplace_back([this, i, wanted] { work(i, wanted); });
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
  const bool mustWake = [&]
  {
    const std::lock_guard lock(mutex_);
    job_ = { part, context, nullptr };
    for (std::size_t thread = 0; thread < threadCount(); ++thread)
    {
      shares_[thread].end = (thread + 1) * count / threadCount();
      shares_[thread].next = thread * count / threadCount();
    }
    running_ = 1;
    ++begunJobs_;
    return sleeping_ > 0;
  }();
  if (mustWake)
  {
    begun_.notify_all();
  }
  takeParts(job_, 0);
  --running_;
  lookFor(threadCount(), [this] { return running_ == 0; });
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return running_ == 0; });
  const std::exception_ptr error = std::exchange(job_, {}).error;
  lock.unlock();
  isAtWork_.clear();
  if (error)
  {
    std::rethrow_exception(error);
  }
}

/// On one of so many threads.
void ThreadPool::work(unsigned thread, unsigned threads)
{
  std::size_t seenJobs = 0;
  for (;;)
  {
    lookFor(threads, [&] { return begunJobs_ != seenJobs; });
    std::unique_lock lock(mutex_);
    ++sleeping_;
    begun_.wait(lock, [&] { return isClosing_ || begunJobs_ != seenJobs; });
    --sleeping_;
    if (isClosing_)
    {
      return;
    }
    seenJobs = begunJobs_;
    if (std::ranges::all_of(shares_, [](const Share& share) { return share.next >= share.end; }))
    {
      // It came too late.
      continue;
    }
    ++running_;
    lock.unlock();
    takeParts(job_, thread);
    lock.lock();
    if (--running_ == 0)
    {
      lock.unlock();
      ended_.notify_all();
    }
  }
}

/// Runs parts as long as there are any that no thread has taken: those of the thread's own share first.
void ThreadPool::takeParts(const Job& job, std::size_t thread) const
{
  const std::size_t threads = threadCount();
  for (std::size_t i = 0; i < threads; ++i)
  {
    Share& share = shares_[(thread + i) % threads];
    while (share.next < share.end)
    {
      const std::size_t taken = share.next++;
      if (taken >= share.end)
      {
        break;
      }
      try
      {
        job.part(job.context, taken);
      }
      catch (...)
      {
        const std::lock_guard lock(mutex_);
        if (!job_.error)
        {
          job_.error = std::current_exception();
        }
        for (Share& left : shares_)
        {
          left.next = left.end;
        }
      }
    }
  }
}
}
