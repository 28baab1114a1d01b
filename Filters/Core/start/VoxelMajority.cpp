// SPDX-License-Identifier: BSD-3-Clause
#include "start/VoxelMajority.h"

#include <algorithm>
#include <array>

namespace neuralmesh
{
namespace
{
constexpr std::size_t LeastVoxelsOfPiece = 8;
constexpr std::size_t LeastPartOfLargestPiece = 1000;

using Voxels = std::vector<std::uint8_t>;

/// The voxel to add to the square of `corner` and its neighbours by the two strides, if two of the
/// square touch by an edge alone; else the number of voxels.
std::size_t missingVoxel(const VoxelVotes& votes, const Voxels& inside, std::size_t corner,
  std::size_t strideA, std::size_t strideB)
{
  const std::size_t a = corner + strideA, b = corner + strideB, across = a + strideB;
  const bool onDiagonal = inside[corner] != 0 && inside[across] != 0 && !inside[a] && !inside[b];
  const bool offDiagonal = !inside[corner] && !inside[across] && inside[a] != 0 && inside[b] != 0;
  if (!onDiagonal && !offDiagonal)
  {
    return inside.size();
  }
  const std::size_t low = onDiagonal ? std::min(a, b) : corner;
  const std::size_t high = onDiagonal ? std::max(a, b) : across;
  return votes.votes[high] > votes.votes[low] ? high : low;
}

/// Pieces of voxels of a kind, connected by their sides.
class Pieces
{
public:
  Pieces(const VoxelGrid& grid, const Voxels& inside, std::uint8_t kind)
    : grid_(grid)
    , inside_(inside)
    , kind_(kind)
    , pieceOf_(grid.size(), NoPiece)
  {
    forEachVoxel(grid,
      [&](std::size_t index, std::size_t, std::size_t, std::size_t)
      {
        if (isNew(index))
        {
          flood(index);
        }
      });
  }

  struct Piece
  {
    std::size_t size = 0;
    bool isAtBorder = false; ///< whether it has voxels in the outermost layer
  };
  const std::vector<Piece>& pieces() const { return pieces_; }

  /// Gives the voxels of the pieces that `condition` holds for the other kind.
  template <typename Condition>
  void turn(Voxels& inside, Condition condition) const
  {
    for (std::size_t i = 0; i < inside.size(); ++i)
    {
      if (pieceOf_[i] != NoPiece && condition(pieces_[pieceOf_[i]]))
      {
        inside[i] = 1 - kind_;
      }
    }
  }

private:
  static constexpr std::uint32_t NoPiece = 0xffffffffu;

  bool isNew(std::size_t voxel) const
  {
    return inside_[voxel] == kind_ && pieceOf_[voxel] == NoPiece;
  }

  void flood(std::size_t first)
  {
    const auto number = std::uint32_t(pieces_.size());
    Piece& piece = pieces_.emplace_back();
    const auto strides = grid_.strides();
    std::vector<std::size_t> open{ first };
    pieceOf_[first] = number;
    const auto visit = [&](std::size_t voxel)
    {
      if (isNew(voxel))
      {
        pieceOf_[voxel] = number;
        open.push_back(voxel);
      }
    };
    while (!open.empty())
    {
      const std::size_t voxel = open.back();
      open.pop_back();
      ++piece.size;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const std::size_t place = voxel / strides[axis] % grid_.counts[axis];
        const bool isFirst = place == 0, isLast = place + 1 == grid_.counts[axis];
        piece.isAtBorder = piece.isAtBorder || isFirst || isLast;
        if (!isFirst)
        {
          visit(voxel - strides[axis]);
        }
        if (!isLast)
        {
          visit(voxel + strides[axis]);
        }
      }
    }
  }

  const VoxelGrid& grid_;
  const Voxels& inside_;
  std::uint8_t kind_;
  std::vector<std::uint32_t> pieceOf_;
  std::vector<Piece> pieces_;
};
}

Voxels majority(const VoxelVotes& votes)
{
  Voxels inside(votes.votes.size());
  std::transform(votes.votes.begin(), votes.votes.end(), inside.begin(),
    [&](std::uint8_t count) { return std::uint8_t(2u * count > votes.voters); });
  return inside;
}

void fillContacts(const VoxelVotes& votes, Voxels& inside)
{
  const auto strides = votes.grid.strides();
  const auto& counts = votes.grid.counts;
  bool isDone = false;
  while (!isDone)
  {
    isDone = true;
    forEachVoxel(votes.grid,
      [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
      {
        const std::array<bool, 3> isLast{ x + 1 == counts[0], y + 1 == counts[1],
          z + 1 == counts[2] };
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const std::size_t other = (axis + 1) % 3;
          if (isLast[axis] || isLast[other])
          {
            continue;
          }
          const std::size_t missing =
            missingVoxel(votes, inside, index, strides[axis], strides[other]);
          if (missing < inside.size())
          {
            inside[missing] = 1;
            isDone = false;
          }
        }
      });
  }
}

void dropSmallPieces(const VoxelGrid& grid, Voxels& inside)
{
  const Pieces pieces(grid, inside, 1);
  std::size_t largest = 0;
  for (const Pieces::Piece& piece : pieces.pieces())
  {
    largest = std::max(largest, piece.size);
  }
  const std::size_t least = std::max(LeastVoxelsOfPiece, largest / LeastPartOfLargestPiece);
  pieces.turn(inside, [&](const Pieces::Piece& piece) { return piece.size < least; });
}

void fillHollows(const VoxelGrid& grid, Voxels& inside)
{
  const Pieces pieces(grid, inside, 0);
  pieces.turn(inside, [](const Pieces::Piece& piece) { return !piece.isAtBorder; });
}

Voxels averageSolid(const VoxelVotes& votes)
{
  Voxels inside = majority(votes);
  fillContacts(votes, inside);
  // Whole pieces come and go, so that no new contacts by an edge arise.
  dropSmallPieces(votes.grid, inside);
  fillHollows(votes.grid, inside);
  return inside;
}

double agreement(const VoxelVotes& votes, const Voxels& inside)
{
  double rightly = 0., all = 0.;
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    rightly += inside[i] != 0 ? votes.votes[i] : 0.;
    all += inside[i] != 0 ? votes.voters : votes.votes[i];
  }
  return all > 0. ? rightly / all : 0.;
}

VoteField voteField(const VoxelVotes& votes, const Voxels& inside)
{
  const unsigned enough = votes.voters / 2 + 1;
  VoteField field;
  field.level = float(enough) - 0.5f;
  field.values.resize(inside.size());
  std::transform(votes.votes.begin(), votes.votes.end(), inside.begin(), field.values.begin(),
    [&](unsigned count, std::uint8_t isInside)
    { return float(isInside != 0 ? std::max(count, enough) : std::min(count, enough - 1)); });
  return field;
}
}
