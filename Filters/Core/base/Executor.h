// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace neuralmesh
{
/// Who runs the parts of a computation that may run at the same time: given to the engine by its
/// caller. How work is cut into parts depends on the work alone, and each part writes only what is
/// its own: so what comes out is the same to the bit, whoever runs the parts, and on however many
/// threads.
class Executor
{
public:
  Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  virtual ~Executor() = default;

  /// Runs all parts on the thread that asks for it.
  static const Executor& sequential();

  /// At most so many parts run at the same time.
  virtual unsigned threadCount() const = 0;

  /// The same without an interruption between parts, for what must not throw.
  virtual const Executor& uninterrupted() const { return *this; }

  /// Calls `body(part)` for the parts 0 ... count - 1, in any order; returns when all are done.
  /// What a part throws is thrown here, once all that have begun are done. Allocates nothing.
  template <typename Body>
  void forEachPart(std::size_t count, const Body& body) const
  {
    run(
      count,
      [](const void* context, std::size_t part) { (*static_cast<const Body*>(context))(part); },
      &body);
  }

  /// Calls `body(begin, end)` for ranges of at most `grain` that make up 0 ... count.
  template <typename Body>
  void forEachRange(std::size_t count, std::size_t grain, const Body& body) const
  {
    forEachPart((count + grain - 1) / grain,
      [&](std::size_t part) { body(part * grain, std::min(count, (part + 1) * grain)); });
  }

  /// The sum of `term(i)` for 0 ... count - 1, in ranges of `grain`, always in the same order.
  template <typename Term>
  double sum(std::size_t count, std::size_t grain, const Term& term) const
  {
    std::vector<double> parts((count + grain - 1) / grain);
    forEachRange(count, grain,
      [&](std::size_t begin, std::size_t end)
      {
        double sum = 0.;
        for (std::size_t i = begin; i < end; ++i)
        {
          sum += double(term(i));
        }
        parts[begin / grain] = sum;
      });
    return std::accumulate(parts.begin(), parts.end(), 0.);
  }

protected:
  using Part = void (*)(const void* context, std::size_t part);
  virtual void run(std::size_t count, Part part, const void* context) const = 0;
};
}
