// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/InterruptibleExecutor.h"

#include <cstddef>

namespace neuralmesh::testing
{
/// Is interrupted before one part.
class ExecutorToInterrupt final : public Executor
{
public:
  explicit ExecutorToInterrupt(std::size_t part)
    : last_(part)
  {
  }
  unsigned threadCount() const override { return 1; }
  const Executor& uninterrupted() const override { return Executor::sequential(); }
  std::size_t partCount() const { return count_; }

protected:
  void run(std::size_t count, Part part, const void* context) const override
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      if (count_++ == last_)
      {
        throw Interrupted();
      }
      part(context, i);
    }
  }

private:
  std::size_t last_;
  mutable std::size_t count_ = 0;
};
}
