// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "start/VoxelGrid.h"

#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// How many of the members of an ensemble hold each voxel.
struct VoxelVotes
{
  VoxelGrid grid;
  unsigned voters = 0;
  std::vector<std::uint8_t> votes;
};

/// The voxels that more than half of the voters hold: 1, the others 0.
std::vector<std::uint8_t> majority(const VoxelVotes& votes);

/// Adds voxels until no two touch by an edge alone, so that the surface between the inside and the
/// outside is a manifold: of the two voxels beside such an edge the one with more votes, of equal
/// ones the one with the lower index. What is outside in the outermost layer stays so if all of
/// that layer is.
void fillContacts(const VoxelVotes& votes, std::vector<std::uint8_t>& inside);

/// Takes away pieces, of voxels connected by their sides, of less than 8 voxels or less than a
/// thousandth of the largest one.
void dropSmallPieces(const VoxelGrid& grid, std::vector<std::uint8_t>& inside);

/// Adds the pieces of the outside that have no voxel in the outermost layer.
void fillHollows(const VoxelGrid& grid, std::vector<std::uint8_t>& inside);

/// A solid whose surface is a closed manifold: the majority with all of this done to it. None of
/// the outermost layer may be in the majority.
std::vector<std::uint8_t> averageSolid(const VoxelVotes& votes);

/// How far the voters agree with a solid: of all that they hold and of all that they should hold,
/// the part that they hold rightly; 0 to 1.
double agreement(const VoxelVotes& votes, const std::vector<std::uint8_t>& inside);

/// A number for each voxel, by which the surface of a solid is drawn between voxels: whole votes,
/// but enough of them inside and too few outside. What lies on the surface has `level`.
struct VoteField
{
  std::vector<float> values;
  float level = 0.f;
};
VoteField voteField(const VoxelVotes& votes, const std::vector<std::uint8_t>& inside);
}
