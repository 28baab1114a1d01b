// SPDX-License-Identifier: BSD-3-Clause
#include "run/Ensemble.h"

#include "base/Random.h"
#include "cloud/MeshBuilder.h"
#include "run/PhantomTriangles.h"
#include "run/Stages.h"
#include "start/DepthBufferVoxelizer.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
constexpr std::uint64_t SamplesPerRound = 5000;
/// The stream of random numbers that the seeds of the members come from.
constexpr std::uint64_t SeedStream = 10;
constexpr std::size_t LeastVerticesOfMembers = 50;
constexpr std::size_t BoxSize = 6; ///< numbers

Parameters memberParameters(const PointCloud& cloud, const EnsembleParameters& parameters)
{
  // A closed mesh has two triangles a vertex.
  const std::size_t most =
    std::max(LeastVerticesOfMembers, cloud.points().size() / (2 * PointsPerTriangle));
  Parameters result;
  result.numberOfVertices = std::min(parameters.verticesPerMember, most);
  result.samplesPerAddition = parameters.memberSamplesPerAddition;
  result.removalPatience = parameters.memberRemovalPatience;
  return result;
}
}

Ensemble::Member::Member(const PointCloud& cloud, const Parameters& parameters)
  : learner(cloud, parameters)
  , rules(cloud, parameters)
{
}

Ensemble::Ensemble(
  const PointCloud& cloud, const EnsembleParameters& parameters, EnsembleShare share)
  : cloud_(cloud)
  , parameters_(parameters)
  , share_(share)
  , memberParameters_(memberParameters(cloud, parameters))
{
  Random seeds(parameters.seed, SeedStream);
  for (unsigned i = 0; i < parameters.numberOfMembers; ++i)
  {
    Parameters ofMember = memberParameters_;
    ofMember.seed = seeds.next();
    if (i % share.count == share.index)
    {
      members_.push_back(std::make_unique<Member>(cloud, ofMember));
    }
  }
}

// --- Population ----------------------------------------------------------------------------------

void Ensemble::learn(std::size_t index)
{
  Member& member = *members_[index];
  if (member.isLearnt)
  {
    return;
  }
  const Progress keep = [&member](double done)
  {
    member.progress = done;
    return true;
  };
  member.isLearnt = neuralmesh::learn(member.learner, member.rules, memberParameters_,
                      SamplesPerRound, keep) != StopReason::None;
}

bool Ensemble::isLearnt() const
{
  return std::all_of(
    members_.begin(), members_.end(), [](const auto& member) { return member->isLearnt; });
}

double Ensemble::progress() const
{
  double sum = 0.;
  for (const auto& member : members_)
  {
    sum += member->isLearnt ? 1. : member->progress;
  }
  return members_.empty() ? 1. : sum / double(size());
}

const Mesh& Ensemble::renumberedMesh(std::size_t member)
{
  members_[member]->learner.compact();
  return mesh(member);
}

double Ensemble::expectedSamples() const
{
  const Parameters& parameters = memberParameters_;
  const auto vertices = double(parameters.numberOfVertices);
  const double early = std::min(vertices, double(parameters.earlyVertices));
  return double(size()) * parameters.samplesPerAddition *
    (vertices + early * (parameters.earlyPatience - 1.));
}

// --- Averaging -----------------------------------------------------------------------------------

void Ensemble::findPhantoms(std::size_t index)
{
  Member& member = *members_[index];
  const Mesh& mesh = renumberedMesh(index);
  member.isPhantom = neuralmesh::findPhantoms(cloud_, mesh, member.learner.grid());
  member.triangles = trianglesOf(mesh, cloud_);
}

std::size_t Ensemble::gridCount(unsigned resolution)
{
  // From centre to centre, and a layer at either side that is outside.
  return std::size_t(resolution) + 1 + 2;
}

std::vector<double> Ensemble::boxes() const
{
  std::vector<double> result(BoxSize * parameters_.numberOfMembers, 0.);
  for (std::size_t i = 0; i < members_.size(); ++i)
  {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : members_[i]->triangles.points)
    {
      box.extend(point);
    }
    double* const place = &result[BoxSize * (share_.index + i * share_.count)];
    std::copy_n(box.min().data(), 3, place);
    std::copy_n(box.max().data(), 3, place + 3);
  }
  return result;
}

void Ensemble::makeGrid(const std::vector<double>& boxes)
{
  // What more than half of the members can hold at all.
  const std::size_t others = parameters_.numberOfMembers / 2;
  Eigen::Vector3d low, high;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    std::vector<double> lows, highs;
    for (std::size_t place = 0; place < boxes.size(); place += BoxSize)
    {
      lows.push_back(boxes[place + std::size_t(axis)]);
      highs.push_back(boxes[place + 3 + std::size_t(axis)]);
    }
    std::sort(lows.begin(), lows.end());
    std::sort(highs.rbegin(), highs.rend());
    low[axis] = lows[others];
    high[axis] = highs[others];
  }
  // There may be no room that more than half of them share.
  const double longest = (high - low).maxCoeff();
  grid_.width = (longest > 0. ? longest : cloud_.unit()) / parameters_.gridResolution;
  const std::size_t count = gridCount(parameters_.gridResolution);
  grid_.counts = { count, count, count };
  grid_.first = 0.5 * (low + high - Eigen::Vector3d::Constant(grid_.width * double(count - 1)));
}

void Ensemble::voxelize(std::size_t index)
{
  Member& member = *members_[index];
  member.voxels = neuralmesh::voxelize(member.triangles, grid_, member.isPhantom);
}

VoxelVotes Ensemble::votes() const
{
  VoxelVotes result{ grid_, parameters_.numberOfMembers,
    std::vector<std::uint8_t>(grid_.size(), 0) };
  for (const auto& member : members_)
  {
    std::transform(member->voxels.begin(), member->voxels.end(), result.votes.begin(),
      result.votes.begin(), std::plus<std::uint8_t>());
  }
  return result;
}
}
