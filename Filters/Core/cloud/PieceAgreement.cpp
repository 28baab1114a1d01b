// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PieceAgreement.h"

#include "base/UnitVector.h"
#include "cloud/VertexGrid.h"
#include "mesh/BoxTree.h"
#include "mesh/FacingBoundaries.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr double WidestGap = 0.5; ///< in roots of the area of the larger piece
constexpr float WidthsOfGap = 2.f;
/// Of the mean of what the vertices at a gap say, from -2 to 2.
constexpr double LeastAgreement = 0.5;
constexpr float EdgesPerCellOfPieces = 2.f;
/// Where pieces are closer, they may overlap: the way from one to the other tells nothing.
constexpr float EdgesOfOverlap = 3.f;

class Agreement
{
public:
  Agreement(const Mesh& mesh, std::span<const Piece> pieces, std::span<Side> sides,
    std::span<const double> ground)
    : mesh_(mesh)
    , pieces_(pieces)
    , sides_(sides)
    , ground_(ground)
    , isTurnedIfLargest_(pieces.size())
    , pieceOf_(mesh.indexEnd())
    , groupOf_(pieces.size())
    , groups_(pieces.size())
  {
    Box box;
    for (std::size_t piece = 0; piece < pieces.size(); ++piece)
    {
      groupOf_[piece] = piece;
      groups_[piece].push_back(piece);
      if (!sides[piece].isKnown())
      {
        isTurnedIfLargest_[piece] = std::exchange(sides[piece].isTurned, false);
      }
      for (const VertexIndex v : pieces[piece].vertices)
      {
        pieceOf_[v] = piece;
        box.extend(mesh.position(v));
      }
    }
    const float meanEdge = float(mesh.meanEdge());
    squaredOverlap_ = EdgesOfOverlap * EdgesOfOverlap * meanEdge * meanEdge;
    grid_.reset(box.low, box.high, EdgesPerCellOfPieces * meanEdge, mesh.indexEnd());
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      grid_.insert(v, mesh.position(v));
    }
  }

  void run()
  {
    // Each round joins every group to another one that is near, so that there are few.
    while (joinNearest())
    {
    }
    for (const std::vector<std::size_t>& group : groups_)
    {
      if (!group.empty() && !sides_[group.front()].isKnown())
      {
        const std::size_t largest = *std::max_element(group.begin(), group.end(),
          [&](std::size_t a, std::size_t b) { return pieces_[a].area < pieces_[b].area; });
        turnIf(sides_[largest].isTurned != isTurnedIfLargest_[largest], group);
      }
    }
  }

private:
  /// From a group that is unknown to another one.
  struct Gap
  {
    std::size_t piece;
    std::size_t other;
    float squaredWidth;
    bool agrees; ///< whether the two pieces do as they are
  };
  struct Contact
  {
    VertexIndex vertex;
    VertexIndex other;
    float squaredDistance;
  };

  bool joinNearest()
  {
    std::vector<Gap> gaps;
    for (const std::vector<std::size_t>& group : groups_)
    {
      if (!group.empty() && !sides_[group.front()].isKnown())
      {
        findGap(group, gaps);
      }
    }
    std::stable_sort(gaps.begin(), gaps.end(),
      [](const Gap& a, const Gap& b) { return a.squaredWidth < b.squaredWidth; });
    bool hasJoined = false;
    for (const Gap& gap : gaps)
    {
      hasJoined = join(gap) || hasJoined;
    }
    return hasJoined;
  }

  /// The narrowest gap around a group that says something.
  void findGap(const std::vector<std::size_t>& group, std::vector<Gap>& gaps)
  {
    forEachVertex(group, [&](VertexIndex v) { grid_.erase(v, mesh_.position(v)); });
    std::map<std::pair<std::size_t, std::size_t>, std::vector<Contact>> contacts;
    forEachVertex(group,
      [&](VertexIndex v)
      {
        const VertexIndex other =
          mesh_.isBoundary(v) ? grid_.closest(mesh_.position(v), mesh_.positions()) : NoVertex;
        if (other != NoVertex)
        {
          contacts[{ pieceOf_[v], pieceOf_[other] }].push_back(
            { v, other, squaredNorm(mesh_.position(v) - mesh_.position(other)) });
        }
      });
    forEachVertex(group, [&](VertexIndex v) { grid_.insert(v, mesh_.position(v)); });
    std::optional<Gap> narrowest;
    for (const auto& [ends, ofGap] : contacts)
    {
      const std::optional<Gap> gap = gapOf(ends.first, ends.second, ofGap);
      if (gap && mayTell(*gap) && (!narrowest || gap->squaredWidth < narrowest->squaredWidth))
      {
        narrowest = gap;
      }
    }
    if (narrowest)
    {
      gaps.push_back(*narrowest);
    }
  }

  /// Whether the side of the other group, if known, decides for this one. A smaller group does so if its side is more
  /// than a guess and leaves the ground below.
  bool mayTell(const Gap& gap) const
  {
    const std::vector<std::size_t>& from = groups_[groupOf_[gap.piece]];
    const std::vector<std::size_t>& to = groups_[groupOf_[gap.other]];
    return !sides_[gap.other].isKnown() || areaOf(to) >= areaOf(from) ||
      (!sides_[gap.other].isGuess && !turnsGround(gap, from));
  }

  /// Whether a known group would have the ground of one look down.
  bool turnsGround(const Gap& gap, const std::vector<std::size_t>& group) const
  {
    if (ground_.empty())
    {
      return false;
    }
    double up = 0.;
    for (const std::size_t piece : group)
    {
      up += sides_[piece].isTurned ? -ground_[piece] : ground_[piece];
    }
    return (isTurnedBy(gap) ? -up : up) <= -LeastGround * areaOf(group);
  }

  double areaOf(const std::vector<std::size_t>& group) const
  {
    double sum = 0.;
    for (const std::size_t piece : group)
    {
      sum += pieces_[piece].area;
    }
    return sum;
  }

  bool isTurnedBy(const Gap& gap) const
  {
    return (sides_[gap.piece].isTurned != sides_[gap.other].isTurned) == gap.agrees;
  }

  std::optional<Gap> gapOf(
    std::size_t piece, std::size_t other, const std::vector<Contact>& contacts) const
  {
    const float width = std::min_element(contacts.begin(), contacts.end(),
      [](const Contact& a, const Contact& b) {
        return a.squaredDistance < b.squaredDistance;
      })->squaredDistance;
    const double area = std::max(pieces_[piece].area, pieces_[other].area);
    const bool isLarger = pieces_[other].area >= pieces_[piece].area;
    double agreement = 0., count = 0.;
    for (const Contact& contact : contacts)
    {
      if (contact.squaredDistance <= WidthsOfGap * WidthsOfGap * width)
      {
        // The underside of what stands over an opening of a table looks to it.
        const bool tells = (isLarger || mesh_.isBoundary(contact.other)) && !leadsBack(contact);
        agreement += tells ? agreementAt(contact) : 0.;
        ++count;
      }
    }
    return double(width) <= WidestGap * WidestGap * area &&
        std::abs(agreement) >= LeastAgreement * count
      ? std::optional(Gap{ piece, other, width, agreement > 0. })
      : std::nullopt;
  }

  /// Whether the way between the two leads over one of the pieces, as from the outline of a table to what stands on it.
  bool leadsBack(const Contact& contact) const
  {
    const auto [v, other, squaredDistance] = contact;
    return squaredDistance > squaredOverlap_ &&
      (!leadsOff(mesh_, v, mesh_.position(other)) ||
        (mesh_.isBoundary(other) && !leadsOff(mesh_, other, mesh_.position(v))));
  }

  double agreementAt(const Contact& contact) const
  {
    const auto normalAt = [this](VertexIndex v) { return unit(mesh_.normal(v)); };
    const auto boundaryAt = [this](VertexIndex v)
    {
      return mesh_.isBoundary(v)
        ? unit(mesh_.position(mesh_.ring(v).back()) - mesh_.position(mesh_.ring(v).front()))
        : Vector4();
    };
    return double(dot(normalAt(contact.vertex), normalAt(contact.other)) -
      dot(boundaryAt(contact.vertex), boundaryAt(contact.other)));
  }

  /// False if the two have been joined, or are both known, in the meantime.
  bool join(const Gap& gap)
  {
    std::size_t from = groupOf_[gap.piece], to = groupOf_[gap.other];
    if (from == to || sides_[gap.piece].isKnown() || !mayTell(gap))
    {
      return false;
    }
    turnIf(isTurnedBy(gap), groups_[from]);
    if (sides_[gap.other].isKnown())
    {
      for (const std::size_t piece : groups_[from])
      {
        sides_[piece].evidence = SideEvidence::Neighbors;
        sides_[piece].isGuess = sides_[gap.other].isGuess;
      }
    }
    if (groups_[from].size() > groups_[to].size())
    {
      std::swap(from, to);
    }
    for (const std::size_t piece : groups_[from])
    {
      groupOf_[piece] = to;
      groups_[to].push_back(piece);
    }
    groups_[from].clear();
    return true;
  }

  void turnIf(bool areTurned, const std::vector<std::size_t>& group)
  {
    for (const std::size_t piece : group)
    {
      sides_[piece].isTurned = sides_[piece].isTurned != areTurned;
    }
  }

  template <typename Use>
  void forEachVertex(const std::vector<std::size_t>& group, Use use) const
  {
    for (const std::size_t piece : group)
    {
      std::for_each(pieces_[piece].vertices.begin(), pieces_[piece].vertices.end(), use);
    }
  }

  const Mesh& mesh_;
  std::span<const Piece> pieces_;
  std::span<Side> sides_;
  std::span<const double> ground_;      ///< of the pieces as they are, or empty
  std::vector<bool> isTurnedIfLargest_; ///< of its group, if nothing decides for that
  float squaredOverlap_ = 0.f;
  VertexGrid grid_; ///< of all vertices
  std::vector<std::size_t> pieceOf_;
  std::vector<std::size_t> groupOf_;
  std::vector<std::vector<std::size_t>> groups_; ///< of pieces
};
}

void makePiecesAgree(const Mesh& mesh, std::span<const Piece> pieces, std::span<Side> sides,
  std::span<const double> ground)
{
  const bool areKnown =
    std::all_of(sides.begin(), sides.end(), [](const Side& side) { return side.isKnown(); });
  if (pieces.size() > 1 && !areKnown)
  {
    Agreement(mesh, pieces, sides, ground).run();
  }
}
}
