// SPDX-License-Identifier: BSD-3-Clause
#include "AllocationCounter.h"
#include "base/Random.h"
#include "learn/ActivityList.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace neuralmesh::testing
{
namespace
{
/// The same as the list, in the plainest way.
class PlainSequence
{
public:
  std::size_t size() const { return this->vertices_.size(); }
  VertexIndex at(std::size_t position) const { return this->vertices_[position]; }
  std::size_t position(VertexIndex v) const
  {
    return std::size_t(
      std::find(this->vertices_.begin(), this->vertices_.end(), v) - this->vertices_.begin());
  }
  void insert(VertexIndex v, std::size_t position)
  {
    this->vertices_.insert(this->vertices_.begin() + std::ptrdiff_t(position), v);
  }
  void erase(VertexIndex v) { std::erase(this->vertices_, v); }
  void jump(VertexIndex v, std::size_t distance)
  {
    const std::size_t position = std::min(this->position(v) + distance, this->size() - 1);
    this->erase(v);
    this->insert(v, position);
  }
  void renumber(const std::vector<VertexIndex>& newIndex)
  {
    for (VertexIndex& v : this->vertices_)
    {
      v = newIndex[v];
    }
  }
  const std::vector<VertexIndex>& all() const { return this->vertices_; }

private:
  std::vector<VertexIndex> vertices_;
};

std::vector<VertexIndex> allOf(const ActivityList& list)
{
  std::vector<VertexIndex> result;
  for (std::size_t position = 0; position < list.size(); ++position)
  {
    result.push_back(list.at(position));
  }
  return result;
}

void fill(ActivityList& list, VertexIndex count)
{
  for (VertexIndex v = 0; v < count; ++v)
  {
    list.insert(v, list.size());
  }
}
}

// A vertex jumps by the distance, and no farther than to the top; the others keep their order.
TEST(ActivityList, JumpEndsAtTheTop)
{
  ActivityList list;
  fill(list, 6);
  list.jump(1, 2);
  EXPECT_EQ(allOf(list), (std::vector<VertexIndex>{ 0, 2, 3, 1, 4, 5 }));
  list.jump(3, 3);
  EXPECT_EQ(allOf(list), (std::vector<VertexIndex>{ 0, 2, 1, 4, 5, 3 }));
  list.jump(4, 100);
  EXPECT_EQ(allOf(list), (std::vector<VertexIndex>{ 0, 2, 1, 5, 3, 4 }));
  list.jump(4, 1);
  list.jump(0, 0);
  EXPECT_EQ(allOf(list), (std::vector<VertexIndex>{ 0, 2, 1, 5, 3, 4 }));
}

// Whatever is done, the list is what a plain sequence is, while it grows over several levels of the
// tree, and shrinks again to nothing.
TEST(ActivityList, AgreesWithPlainSequence)
{
  constexpr int Operations = 150'000;
  constexpr VertexIndex Most = 20'000;
  ActivityList list;
  PlainSequence plain;
  Random random(7);
  std::vector<VertexIndex> unused(Most);
  std::iota(unused.rbegin(), unused.rend(), VertexIndex(0));
  const auto anyVertex = [&] { return plain.at(random.below(std::uint32_t(plain.size()))); };

  for (int i = 0; i < Operations; ++i)
  {
    // First it mostly grows, in the end it mostly shrinks.
    const std::uint32_t insertions = i < Operations / 2 ? 45 : 5;
    const std::uint32_t kind = random.below(100);
    if ((kind < insertions && !unused.empty()) || plain.size() == 0)
    {
      // Often at one place, which splits leaf after leaf there.
      const auto end = std::uint32_t(plain.size() + 1);
      const std::size_t position = random.below(3) == 0 ? end / 2 : random.below(end);
      list.insert(unused.back(), position);
      plain.insert(unused.back(), position);
      unused.pop_back();
    }
    else if (kind < 50)
    {
      const VertexIndex v = random.below(2) == 0 ? plain.at(plain.size() / 3) : anyVertex();
      list.erase(v);
      plain.erase(v);
      unused.push_back(v);
    }
    else
    {
      const VertexIndex v = anyVertex();
      const std::size_t distance =
        random.below(2) == 0 ? plain.size() / 3 : random.below(std::uint32_t(plain.size() + 2));
      list.jump(v, distance);
      plain.jump(v, distance);
    }

    ASSERT_EQ(list.size(), plain.size()) << "operation " << i;
    if (plain.size() > 0)
    {
      ASSERT_EQ(list.at(0), plain.at(0)) << "operation " << i;
      ASSERT_EQ(list.at(list.size() - 1), plain.at(plain.size() - 1)) << "operation " << i;
      const std::size_t position = random.below(std::uint32_t(plain.size()));
      ASSERT_EQ(list.at(position), plain.at(position)) << "operation " << i;
      ASSERT_EQ(list.position(plain.at(position)), position) << "operation " << i;
    }
    if (i % 5000 == 0)
    {
      ASSERT_EQ(allOf(list), plain.all()) << "operation " << i;
    }
    if (i == Operations / 2)
    {
      EXPECT_GT(plain.size(), 10'000u);
    }
  }
  while (list.size() > 0)
  {
    list.erase(list.at(list.size() / 2));
  }
  list.insert(3, 0);
  EXPECT_EQ(allOf(list), (std::vector<VertexIndex>{ 3 }));
}

// Vertices keep their places when they are called otherwise.
TEST(ActivityList, RenumberKeepsTheOrder)
{
  constexpr VertexIndex Count = 10'000;
  ActivityList list;
  PlainSequence plain;
  Random random(3);
  for (VertexIndex v = 0; v < Count; ++v)
  {
    const std::size_t position = random.below(v + 1);
    list.insert(v, position);
    plain.insert(v, position);
  }
  for (VertexIndex v = 0; v < Count; v += 2)
  {
    list.erase(v);
    plain.erase(v);
  }
  std::vector<VertexIndex> newIndex(Count, NoVertex);
  for (VertexIndex v = 1; v < Count; v += 2)
  {
    newIndex[v] = (Count - 1 - v) / 2;
  }
  list.renumber(newIndex);
  plain.renumber(newIndex);
  EXPECT_EQ(allOf(list), plain.all());
  for (VertexIndex v = 0; v < Count / 2; v += 11)
  {
    EXPECT_EQ(list.position(v), plain.position(v));
  }
}

// With memory for so many vertices, jumps, insertions and erasures allocate nothing.
TEST(ActivityList, AllocatesNothing)
{
  constexpr VertexIndex Count = 30'000;
  ActivityList list;
  list.reserve(Count);
  fill(list, Count);
  Random random(5);
  const std::size_t before = allocationCount();
  for (int i = 0; i < 300'000; ++i)
  {
    list.jump(random.below(Count), list.size() / 3);
    if (i % 10 == 0)
    {
      const VertexIndex v = list.at(0);
      list.erase(v);
      list.insert(v, random.below(Count));
    }
  }
  EXPECT_EQ(allocationCount() - before, 0u);
}
}
