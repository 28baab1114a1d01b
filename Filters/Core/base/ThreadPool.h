// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace neuralmesh
{
/// Runs parts on threads of its own and on the one that asks for it. Whoever asks while it is at
/// work, a part among them, gets the parts run on the asking thread. Its threads take no signals
/// that are sent to the process.
class ThreadPool final : public Executor
{
public:
  /// 0 threads: availableProcessors(). Where the system gives fewer, it does with these.
  explicit ThreadPool(unsigned threadCount = 0);
  ~ThreadPool() override;

  unsigned threadCount() const override { return unsigned(workers_.size()) + 1; }

protected:
  void run(std::size_t count, Part part, const void* context) const override;

private:
  /// Parts that are run, and how far that is.
  struct Job
  {
    Part part = nullptr;
    const void* context = nullptr;
    std::size_t count = 0;
    std::size_t next = 0;    ///< that no thread has taken
    std::size_t running = 0; ///< threads at it
    std::exception_ptr error;
  };

  void work();
  void takeParts(std::unique_lock<std::mutex>& lock) const;

  mutable std::atomic_flag isAtWork_;
  mutable std::mutex mutex_; ///< of all below
  mutable std::condition_variable begun_;
  mutable std::condition_variable ended_;
  mutable Job job_;
  bool isClosing_ = false;
  std::vector<std::thread> workers_;
};
}
