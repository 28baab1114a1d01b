// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "cloud/PointLayout.h"

#include <Eigen/Core>

#include <functional>
#include <string>

namespace neuralmesh
{
/// Binary points in a file that may be larger than the memory: some are drawn from where they lie.
/// No more of the file is held than a megabyte. It is read, not mapped: a file that shrinks or a disk
/// that fails is an error then, and no signal.
class PointFile
{
public:
  /// A .ply or .vtp, by its extension, as layoutOfPly() and layoutOfVtp() have it. Throws
  /// std::runtime_error, with a message that names the file, if it is no regular file that can be
  /// read, is of another kind, damaged, or ends before its last point.
  explicit PointFile(const std::string& path);
  /// Any file, as layoutOfRaw() has it; little-endian.
  PointFile(const std::string& path, bool isDouble, std::uint64_t skip);

  const PointLayout& layout() const { return layout_; }

  struct Point
  {
    Eigen::Vector3d position;
    std::array<std::uint8_t, 3> color; ///< if the layout has one
    Eigen::Vector3d normal;            ///< if the layout has one
  };

  /// Draws `wanted` points (fewer than 2^32), in the order of the file: of that many equal shares of
  /// the file, one point each, at random; all points, if there are no more. So each point is as
  /// likely as any other, and the file is read once, from front to back. A point that is in two
  /// shares may be drawn for both. Where shares are large, only the points themselves are read.
  ///
  /// Returns false if it was ended by `progress`. Throws std::runtime_error, naming the file, if it
  /// cannot be read any more.
  bool draw(std::uint64_t wanted, std::uint64_t seed, const std::function<void(const Point&)>& take,
    const Progress& progress) const;

private:
  /// A regular file, open for reading.
  class Source
  {
  public:
    explicit Source(const std::string& path);
    ~Source();
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    std::uint64_t size() const { return size_; }
    /// Throws std::runtime_error if not all can be read.
    void read(std::uint64_t offset, void* bytes, std::size_t size) const;
    void expect(bool isSequential) const;

  private:
    int file_;
    std::uint64_t size_ = 0;
  };

  void requireWhole() const;
  Point decode(const unsigned char* record) const;
  Eigen::Vector3d numbersAt(
    const unsigned char* record, const std::array<std::uint64_t, 3>& places) const;

  std::string path_;
  Source source_;
  PointLayout layout_;
};
}
