// SPDX-License-Identifier: BSD-3-Clause
#include "start/VoxelMajority.h"

#include "base/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace neuralmesh::testing
{
namespace
{
using Voxels = std::vector<std::uint8_t>;

VoxelVotes makeVotes(std::array<std::size_t, 3> counts, unsigned voters)
{
  VoxelVotes votes;
  votes.grid.counts = counts;
  votes.voters = voters;
  votes.votes.assign(votes.grid.size(), 0);
  return votes;
}

std::size_t voteIndex(const VoxelGrid& grid, std::size_t x, std::size_t y, std::size_t z)
{
  return (z * grid.counts[1] + y) * grid.counts[0] + x;
}

/// Votes at random, but for the outermost layer, which nobody holds.
VoxelVotes makeRandomVotes(Random& random, unsigned voters, double density)
{
  VoxelVotes votes =
    makeVotes({ 4 + random.below(9), 4 + random.below(9), 4 + random.below(9) }, voters);
  const auto& counts = votes.grid.counts;
  forEachVoxel(votes.grid,
    [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
    {
      const std::array<std::size_t, 3> place{ x, y, z };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        if (place[axis] == 0 || place[axis] + 1 == counts[axis])
        {
          return;
        }
      }
      for (unsigned i = 0; i < voters; ++i)
      {
        votes.votes[index] += random.uniform() < density;
      }
    });
  return votes;
}

/// Sides between the inside and the outside that meet at an edge of the grid: two in a surface
/// without branches.
std::size_t branches(const VoxelGrid& grid, const Voxels& inside)
{
  std::size_t count = 0;
  const auto strides = grid.strides();
  forEachVoxel(grid,
    [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
    {
      const std::array<std::size_t, 3> place{ x, y, z };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const std::size_t other = (axis + 1) % 3;
        if (place[axis] + 1 < grid.counts[axis] && place[other] + 1 < grid.counts[other])
        {
          const std::array<std::size_t, 4> around{ index, index + strides[axis],
            index + strides[axis] + strides[other], index + strides[other] };
          unsigned sides = 0;
          for (unsigned i = 0; i < 4; ++i)
          {
            sides += inside[around[i]] != inside[around[(i + 1) % 4]];
          }
          count += sides > 2;
        }
      }
    });
  return count;
}

/// Number of pieces of a kind, by their sides, found by spreading the lowest index.
std::size_t pieces(const VoxelGrid& grid, const Voxels& inside, std::uint8_t kind)
{
  std::vector<std::size_t> label(inside.size());
  std::iota(label.begin(), label.end(), std::size_t(0));
  const auto strides = grid.strides();
  bool isDone = false;
  while (!isDone)
  {
    isDone = true;
    forEachVoxel(grid,
      [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
      {
        const std::array<std::size_t, 3> place{ x, y, z };
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const std::size_t next = index + strides[axis];
          if (place[axis] + 1 < grid.counts[axis] && inside[index] == kind &&
            inside[next] == kind && label[index] != label[next])
          {
            label[index] = label[next] = std::min(label[index], label[next]);
            isDone = false;
          }
        }
      });
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    count += inside[i] == kind && label[i] == i;
  }
  return count;
}

void fillBox(const VoxelGrid& grid, Voxels& inside, std::array<std::size_t, 3> from,
  std::array<std::size_t, 3> to, std::uint8_t kind)
{
  forEachVoxel(grid,
    [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
    {
      if (x >= from[0] && x < to[0] && y >= from[1] && y < to[1] && z >= from[2] && z < to[2])
      {
        inside[index] = kind;
      }
    });
}

std::size_t insideCount(const Voxels& inside)
{
  return std::accumulate(inside.begin(), inside.end(), std::size_t(0));
}
}

// More than half of the votes are needed: exactly half are not enough.
TEST(VoxelMajority, TiesAreOut)
{
  for (const unsigned voters : { 1u, 2u, 8u, 9u, 255u })
  {
    VoxelVotes votes = makeVotes({ voters + 1, 1, 1 }, voters);
    std::iota(votes.votes.begin(), votes.votes.end(), std::uint8_t(0));
    const Voxels inside = majority(votes);
    for (unsigned count = 0; count <= voters; ++count)
    {
      EXPECT_EQ(inside[count] != 0, count > voters / 2.) << count << " of " << voters;
    }
  }
}

// Of the two voxels beside an edge contact the one with more votes is filled, of equal ones the
// one with the lower index; nothing else changes.
TEST(VoxelMajority, ContactsAreFilled)
{
  for (const unsigned plane : { 0u, 1u, 2u })
  {
    for (const bool favorSecond : { false, true })
    {
      VoxelVotes votes = makeVotes({ 6, 6, 6 }, 9);
      const auto strides = votes.grid.strides();
      const std::size_t corner = voteIndex(votes.grid, 2, 2, 2);
      const std::size_t a = corner + strides[plane], b = corner + strides[(plane + 1) % 3];
      const std::size_t across = a + b - corner;
      Voxels inside(votes.grid.size(), 0);
      inside[corner] = inside[across] = 1;
      if (favorSecond)
      {
        votes.votes[std::max(a, b)] = 3;
      }
      fillContacts(votes, inside);
      EXPECT_EQ(insideCount(inside), 3u);
      EXPECT_EQ(inside[favorSecond ? std::max(a, b) : std::min(a, b)], 1u);
    }
  }
}

// Voxels that touch by a corner alone, or by nothing, stay apart.
TEST(VoxelMajority, OtherContactsStay)
{
  VoxelVotes votes = makeVotes({ 7, 7, 7 }, 9);
  Voxels inside(votes.grid.size(), 0);
  inside[voteIndex(votes.grid, 2, 2, 2)] = inside[voteIndex(votes.grid, 3, 3, 3)] = 1;
  inside[voteIndex(votes.grid, 5, 2, 2)] = 1;
  const Voxels before = inside;
  fillContacts(votes, inside);
  EXPECT_EQ(inside, before);
}

// Whatever the votes are, the surface of the solid has no branches, hollows or small pieces, and
// voxels of the majority are only lost with small pieces.
TEST(VoxelMajority, RandomVotesGiveManifolds)
{
  Random random(1);
  for (int run = 0; run < 300; ++run)
  {
    const unsigned voters = 1 + random.below(12);
    const VoxelVotes votes = makeRandomVotes(random, voters, 0.2 + 0.6 * random.uniform());
    const Voxels solid = averageSolid(votes);
    ASSERT_EQ(branches(votes.grid, solid), 0u);
    EXPECT_EQ(pieces(votes.grid, solid, 0), 1u);
    forEachVoxel(votes.grid,
      [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
      {
        const auto& counts = votes.grid.counts;
        const bool isOuter = x == 0 || y == 0 || z == 0 || x + 1 == counts[0] ||
          y + 1 == counts[1] || z + 1 == counts[2];
        EXPECT_FALSE(isOuter && solid[index] != 0);
      });
    Voxels all = majority(votes);
    fillContacts(votes, all);
    Voxels large = all;
    dropSmallPieces(votes.grid, large);
    for (std::size_t i = 0; i < solid.size(); ++i)
    {
      EXPECT_LE(large[i], solid[i]);
      EXPECT_LE(large[i], all[i]);
    }
  }
}

// Pieces of less than 8 voxels go, and so do those of less than a thousandth of the largest one.
TEST(VoxelMajority, SmallPiecesAreDropped)
{
  VoxelGrid grid;
  grid.counts = { 60, 30, 30 };
  Voxels inside(grid.size(), 0);
  fillBox(grid, inside, { 2, 2, 2 }, { 4, 4, 4 }, 1);     // 8
  fillBox(grid, inside, { 8, 2, 2 }, { 9, 2 + 7, 3 }, 1); // 7
  dropSmallPieces(grid, inside);
  EXPECT_EQ(insideCount(inside), 8u);

  fillBox(grid, inside, { 20, 2, 2 }, { 40, 28, 28 }, 1);  // 13520
  fillBox(grid, inside, { 8, 20, 2 }, { 9, 22, 9 }, 1);    // 14
  fillBox(grid, inside, { 14, 20, 2 }, { 15, 21, 15 }, 1); // 13
  dropSmallPieces(grid, inside);
  EXPECT_EQ(insideCount(inside), 13520u + 14u + 13u);
  fillBox(grid, inside, { 40, 2, 2 }, { 42, 28, 28 }, 1); // now 14872
  dropSmallPieces(grid, inside);
  EXPECT_EQ(insideCount(inside), 14872u + 14u);

  Voxels nothing(grid.size(), 0);
  dropSmallPieces(grid, nothing);
  EXPECT_EQ(insideCount(nothing), 0u);
}

// Hollows are filled, caves with a way out are not.
TEST(VoxelMajority, HollowsAreFilled)
{
  VoxelGrid grid;
  grid.counts = { 12, 12, 12 };
  Voxels inside(grid.size(), 0);
  fillBox(grid, inside, { 1, 1, 1 }, { 11, 11, 11 }, 1);
  Voxels full = inside;
  fillBox(grid, inside, { 3, 3, 3 }, { 6, 6, 6 }, 0);
  fillHollows(grid, inside);
  EXPECT_EQ(inside, full);
  fillBox(grid, inside, { 3, 3, 3 }, { 4, 4, 12 }, 0);
  const Voxels cave = inside;
  fillHollows(grid, inside);
  EXPECT_EQ(inside, cave);
}

// The field has the solid above its level and all else below; where the votes agree with that, it
// is the votes.
TEST(VoxelMajority, FieldFollowsTheSolid)
{
  Random random(2);
  for (const unsigned voters : { 1u, 4u, 9u })
  {
    const VoxelVotes votes = makeRandomVotes(random, voters, 0.5);
    const Voxels solid = averageSolid(votes);
    const Voxels most = majority(votes);
    const VoteField field = voteField(votes, solid);
    for (std::size_t i = 0; i < solid.size(); ++i)
    {
      EXPECT_EQ(field.values[i] > field.level, solid[i] != 0);
      EXPECT_NE(field.values[i], field.level);
      if (solid[i] == most[i])
      {
        EXPECT_EQ(field.values[i], float(votes.votes[i]));
      }
    }
  }
}

// Agreement is 1 for voters that all hold the solid, and falls with what they hold otherwise.
TEST(VoxelMajority, AgreementOfVoters)
{
  VoxelVotes votes = makeVotes({ 4, 1, 1 }, 3);
  EXPECT_EQ(agreement(votes, { 0, 0, 0, 0 }), 0.);
  votes.votes = { 0, 3, 3, 0 };
  EXPECT_EQ(agreement(votes, { 0, 1, 1, 0 }), 1.);
  votes.votes = { 1, 3, 2, 0 };
  EXPECT_DOUBLE_EQ(agreement(votes, { 0, 1, 1, 0 }), 5. / 7.);
}
}
