// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/ZeroedArray.h"
#include "cloud/PlaceOnMesh.h"
#include "fit/PlacesByRows.h"
#include "fit/SamplePoints.h"
#include "mesh/Mesh.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// Samples, their places on a mesh, and which of them count.
struct PlacedSamples
{
  SamplePoints points;
  std::span<const PlaceOnMesh> places;
  std::span<const std::uint8_t> isUsed;
  std::span<const float> weights; ///< empty: all weigh alike

  float weight(std::size_t sample) const { return weights.empty() ? 1.f : weights[sample]; }
};

/// The most that squared distances of so many samples with this variance about the surface add up to but for chance: by
/// two deviations of it.
double usualSquares(double count, double variance);

/// The samples that lie on a triangle: how many, and the sum of their squared distances to it.
struct SampleLoad
{
  double count = 0.;
  double squares = 0.;

  SampleLoad& operator+=(const SampleLoad& b)
  {
    count += b.count;
    squares += b.squares;
    return *this;
  }
  friend SampleLoad operator+(SampleLoad a, const SampleLoad& b) { return a += b; }

  /// How much larger the squares are than usualSquares().
  double excess(double variance) const;
};

/// Which samples lie on which triangle of a mesh: a triangle is named by its corners, in any order. Each
/// triangle with samples is in a list of its least corner, so that edges can be flipped. Who only asks may do so
/// on several threads. So may who changes triangles, each with a writer of its own, as long as no two change, or ask
/// for, triangles of the same least corner.
class TriangleSamples
{
public:
  TriangleSamples(const PlacedSamples& samples, std::size_t indexEnd,
    const Executor& executor = Executor::sequential());

  SampleLoad load(VertexIndex a, VertexIndex b, VertexIndex c) const;
  /// Adds the samples on a triangle to `found`.
  void collect(
    VertexIndex a, VertexIndex b, VertexIndex c, std::vector<std::uint32_t>& found) const;
  /// The same, and takes them from there.
  void take(VertexIndex a, VertexIndex b, VertexIndex c, std::vector<std::uint32_t>& found);
  /// So many are at work.
  void setWriters(std::size_t count) { stores_.resize(parts_.count() + count); }
  /// Puts a sample that was taken on a triangle.
  void put(std::uint32_t sample, VertexIndex a, VertexIndex b, VertexIndex c, float squaredDistance,
    std::size_t writer);

  Vector4 point(std::uint32_t sample) const { return samples_.points[sample]; }
  float weight(std::uint32_t sample) const { return samples_.weight(sample); }
  /// To the place at which it was found, wherever it was put.
  float squaredDistance(std::uint32_t sample) const
  {
    return samples_.places[sample].squaredDistance;
  }

  /// Of all samples in use.
  const SampleLoad& total() const { return total_; }

private:
  static constexpr std::uint32_t None = 0xffffffffu;
  /// An entry is known by the store in which it is, and its place there.
  static constexpr unsigned BitsOfPlace = 24;
  static constexpr std::uint32_t MostPlaces = std::uint32_t(1) << BitsOfPlace;

  /// A triangle that has, or had, samples.
  struct Entry
  {
    VertexIndex middle, most; ///< corners beside the least one
    std::uint32_t next;       ///< of the same least corner
    std::uint32_t first;      ///< of its samples
    std::uint32_t last;
    SampleLoad load;
  };

  /// Those of a part of the vertices lie in a piece of an array for all, as far as they have room there: arrays of
  /// their own would be too small to go back to the system. What a writer adds has no such piece.
  struct alignas(64) Store
  {
    Entry* piece = nullptr;
    std::size_t room = 0; ///< of it
    std::size_t count = 0;
    std::vector<Entry> others;

    const Entry& operator[](std::size_t place) const
    {
      return place < this->room ? this->piece[place] : this->others[place - this->room];
    }
    /// Returns its place.
    std::size_t add(const Entry& entry)
    {
      if (this->count < this->room)
      {
        this->piece[this->count] = entry;
      }
      else
      {
        this->others.push_back(entry);
      }
      return this->count++;
    }
  };

  const Entry* find(const Triangle& corners) const;
  Entry* find(const Triangle& corners)
  {
    return const_cast<Entry*>(std::as_const(*this).find(corners));
  }
  const Entry& entry(std::uint32_t number) const
  {
    return stores_[number >> BitsOfPlace][number % MostPlaces];
  }
  void putInto(
    std::size_t store, std::uint32_t sample, const Triangle& corners, float squaredDistance);

  PlacedSamples samples_;
  RowParts parts_;
  std::vector<std::uint32_t> entries_; ///< the first of each vertex
  ZeroedArray<Entry> pieces_;
  /// The triangles of each part of the vertices, by their least corner, and what each writer has added.
  std::vector<Store> stores_;
  std::unique_ptr<std::uint32_t[]> next_; ///< of each sample that is used, on the same triangle
  SampleLoad total_;
};
}
