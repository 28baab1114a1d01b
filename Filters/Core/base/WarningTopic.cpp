// SPDX-License-Identifier: BSD-3-Clause
#include "base/WarningTopic.h"

#include <array>
#include <cstddef>

namespace neuralmesh
{
namespace
{
/// In the order of the topics.
constexpr std::array WarningTags{ std::string_view("points-coincide"),
  std::string_view("unmeasured-points"), std::string_view("part-is-missing"),
  std::string_view("mesh-is-coarse"), std::string_view("points-are-unexplained"),
  std::string_view("no-surface"), std::string_view("open-where-points-are"),
  std::string_view("stays-open"), std::string_view("surface-without-points"),
  std::string_view("gap-is-spanned"), std::string_view("falls-into-pieces"),
  std::string_view("triangles-intersect"), std::string_view("between-layers"),
  std::string_view("folds"), std::string_view("views-lie-apart"), std::string_view("slivers"),
  std::string_view("inside-out"), std::string_view("narrow-handles"),
  std::string_view("narrow-necks"), std::string_view("finer-than-noise"),
  std::string_view("growth-stopped"), std::string_view("mesh-is-unfinished"),
  std::string_view("finer-than-data"), std::string_view("fit-taken-back"),
  std::string_view("side-is-unknown"), std::string_view("no-error-bars"),
  std::string_view("error-bars-too-short"), std::string_view("other-number-of-vertices"),
  std::string_view("number-not-found"), std::string_view("first-mesh"),
  std::string_view("surface-is-unsound") };
static_assert(WarningTags.size() == std::size_t(WarningTopic::SurfaceIsUnsound) + 1);
}

std::string_view tagOf(WarningTopic topic) { return WarningTags[std::size_t(topic)]; }

std::string taggedWarning(WarningTopic topic, std::string_view text)
{
  return std::string(text) + " [" + std::string(tagOf(topic)) + "]";
}

bool isAbout(std::string_view warning, WarningTopic topic)
{
  return warning.ends_with(taggedWarning(topic, ""));
}
}
