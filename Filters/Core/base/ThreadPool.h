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
  /// Parts that are run.
  struct Job
  {
    Part part = nullptr;
    const void* context = nullptr;
    std::exception_ptr error;
  };

  /// Parts that one thread takes first, and the others once they have none of their own: neighbours of
  /// neighbours, and the same ones whenever work is cut in the same way. So a thread finds most of what
  /// it reads where it wrote it. From the cache of another core it would come as slowly as from memory.
  struct alignas(128) Share
  {
    std::atomic<std::size_t> next{ 0 }; ///< that no thread has taken
    std::size_t end = 0;
  };

  void work(unsigned thread, unsigned threads);
  void takeParts(const Job& job, std::size_t thread) const;

  mutable std::atomic_flag isAtWork_;
  mutable std::vector<Share> shares_;             ///< of the threads
  mutable std::atomic<std::size_t> running_{ 0 }; ///< threads at the job
  mutable std::atomic<std::size_t> begunJobs_{ 0 };
  mutable std::mutex mutex_; ///< of all below
  mutable std::condition_variable begun_;
  mutable std::condition_variable ended_;
  mutable Job job_;
  mutable std::size_t sleeping_ = 0; ///< threads that wait to be told of a job
  bool isClosing_ = false;
  std::vector<std::thread> workers_;
};
}
