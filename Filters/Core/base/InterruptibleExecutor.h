// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"

#include <chrono>
#include <exception>
#include <functional>
#include <thread>
#include <utility>

namespace neuralmesh
{
/// Thrown by an InterruptibleExecutor.
class Interrupted final : public std::exception
{
public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// Lets another executor run the parts, and asks between them whether to go on, every 50 milliseconds and on its own
/// thread alone. If the answer is no, it throws Interrupted, once; what runs afterwards runs to its end. Whoever catches
/// that drops or restores what the parts were writing. Both must outlive it.
class InterruptibleExecutor final : public Executor
{
public:
  InterruptibleExecutor(const Executor& executor, std::function<bool()> goesOn)
    : executor_(executor)
    , goesOn_(std::move(goesOn))
  {
  }

  unsigned threadCount() const override { return executor_.threadCount(); }
  const Executor& uninterrupted() const override { return executor_.uninterrupted(); }

protected:
  void run(std::size_t count, Part part, const void* context) const override
  {
    executor_.forEachPart(count,
      [&](std::size_t i)
      {
        ask();
        part(context, i);
      });
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds Interval{ 50 };

  void ask() const
  {
    if (std::this_thread::get_id() != thread_ || isInterrupted_ || Clock::now() < asked_ + Interval)
    {
      return;
    }
    isInterrupted_ = !goesOn_();
    asked_ = Clock::now();
    if (isInterrupted_)
    {
      throw Interrupted();
    }
  }

  const Executor& executor_;
  std::function<bool()> goesOn_;
  // Of this thread alone.
  const std::thread::id thread_ = std::this_thread::get_id();
  mutable bool isInterrupted_ = false;
  mutable Clock::time_point asked_ = Clock::now();
};

/// What `body()` returns, or an empty value if it was interrupted.
template <typename Body>
auto unlessInterrupted(const Body& body) -> decltype(body())
{
  try
  {
    return body();
  }
  catch (const Interrupted&)
  {
    return {};
  }
}
}
