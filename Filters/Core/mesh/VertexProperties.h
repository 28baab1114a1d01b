// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Ring.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace neuralmesh
{
/// What a vertex that comes out of a split gets of a property.
enum class OnSplit
{
  Copy, ///< the value of the vertex that was split
  Begin ///< the value with which all vertices begin
};

/// Names a property of the vertices of a mesh, and of the copies of that mesh.
template <typename T>
struct VertexProperty
{
  std::size_t column = 0;
};

/// Values that belong to the vertices of a mesh and follow all its operations: a split, a
/// renumbering, a copy. What a split does to a property is told once, where it is added. Values are
/// std::uint8_t, float or double; another type is one more in columns_.
class VertexProperties
{
public:
  /// A property that all vertices below `indexEnd` begin with.
  template <typename T>
  VertexProperty<T> add(std::size_t indexEnd, T first, OnSplit onSplit)
  {
    static_assert(
      std::is_same_v<T, std::uint8_t> || std::is_same_v<T, float> || std::is_same_v<T, double>,
      "values of vertices are std::uint8_t, float or double; see columns_");
    // In place: of a column that is moved there, GCC 14 at -O3 takes another kind for uninitialized.
    auto& column = std::get<Column<T>>(columns_.emplace_back(std::in_place_type<Column<T>>));
    column.values.assign(indexEnd, first);
    column.first = first;
    column.onSplit = onSplit;
    return { columns_.size() - 1 };
  }

  /// By the index of the vertex; those of erased vertices mean nothing.
  template <typename T>
  std::span<T> values(VertexProperty<T> property)
  {
    return std::get<Column<T>>(columns_[property.column]).values;
  }
  template <typename T>
  std::span<const T> values(VertexProperty<T> property) const
  {
    return std::get<Column<T>>(columns_[property.column]).values;
  }

  /// For all vertices below `indexEnd`.
  void resize(std::size_t indexEnd)
  {
    forEachColumn([=](auto& column) { column.values.resize(indexEnd, column.first); });
  }

  /// `added` came out of a split of `split`. There must be room for it.
  void split(VertexIndex split, VertexIndex added)
  {
    forEachColumn(
      [=](auto& column) {
        column.values[added] =
          column.onSplit == OnSplit::Copy ? column.values[split] : column.first;
      });
  }

  /// Memory for `count` indices: up to there no operation allocates.
  void reserve(std::size_t count)
  {
    forEachColumn([=](auto& column) { column.values.reserve(count); });
  }

  /// As Mesh::renumber().
  void renumber(std::span<const VertexIndex> permutation, const Executor& executor)
  {
    constexpr std::size_t VerticesPerRange = 16384;
    forEachColumn(
      [&](auto& column)
      {
        std::remove_reference_t<decltype(column.values)> values(permutation.size());
        executor.forEachRange(permutation.size(), VerticesPerRange,
          [&](std::size_t begin, std::size_t end)
          {
            for (std::size_t i = begin; i < end; ++i)
            {
              values[i] = column.values[permutation[i]];
            }
          });
        column.values = std::move(values);
      });
  }

  /// Writes the values of all vertices below `indexEnd`, or reads those of the same properties.
  template <typename Archive>
  void exchange(Archive& archive, std::size_t indexEnd)
  {
    forEachColumn(
      [&](auto& column)
      {
        archive(column.values);
        archive.require(column.values.size() == indexEnd);
      });
  }

private:
  template <typename T>
  struct Column
  {
    std::vector<T> values;
    T first{};
    OnSplit onSplit = OnSplit::Copy;
  };

  template <typename Use>
  void forEachColumn(Use use)
  {
    for (auto& column : columns_)
    {
      std::visit(use, column);
    }
  }

  std::vector<std::variant<Column<std::uint8_t>, Column<float>, Column<double>>> columns_;
};
}
