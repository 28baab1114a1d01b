// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// What a warning of a mesh is about. Each topic is a heading of Documentation/Guide/Failures.md, which
/// names the causes and the cures.
enum class WarningTopic
{
  PointsCoincide,
  UnmeasuredPoints,
  PartIsMissing,
  MeshIsCoarse,
  PointsAreUnexplained,
  NoSurface,
  OpenWherePointsAre,
  StaysOpen,
  SurfaceWithoutPoints,
  GapIsSpanned,
  FallsIntoPieces,
  TrianglesIntersect,
  BetweenLayers,
  Folds,
  ViewsLieApart,
  Slivers,
  InsideOut,
  NarrowHandles,
  NarrowNecks,
  FinerThanNoise,
  GrowthStopped,
  MeshIsUnfinished,
  FinerThanData,
  FitTakenBack,
  SideIsUnknown,
  NoErrorBars,
  ErrorBarsTooShort,
  OtherNumberOfVertices,
  NumberNotFound,
  FirstMesh,
  SurfaceIsUnsound
};

/// The anchor of its heading, such as part-is-missing.
std::string_view tagOf(WarningTopic topic);

/// The text of a warning, which ends with its tag in brackets.
std::string taggedWarning(WarningTopic topic, std::string_view text);

/// Whether such a text is about the topic.
bool isAbout(std::string_view warning, WarningTopic topic);

/// The warnings of a mesh. No warning comes in without its tag.
class WarningList
{
public:
  void add(WarningTopic topic, std::string_view text)
  {
    texts_.push_back(taggedWarning(topic, text));
  }

  std::vector<std::string> take() { return std::move(texts_); }

private:
  std::vector<std::string> texts_;
};
}
