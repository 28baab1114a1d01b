// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PointFile.h"

#include "base/Random.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cerrno>
#include <stdexcept>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace neuralmesh
{
namespace
{
constexpr std::uint64_t PointFileStream = 0x66696c65;
constexpr std::uint64_t SharesBetweenReports = 4096;

/// Points that are not farther apart than so many bytes are read together with what is between them,
/// in pieces of that size: this takes less time than to read each by itself.
constexpr std::uint64_t FarApart = 1 << 15;
constexpr std::uint64_t PieceSize = 1 << 20;

/// Calls `read`; errors then begin with the name of the file.
template <typename Read>
auto naming(const std::string& path, const Read& read)
{
  try
  {
    return read();
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(path + ": " + error.what());
  }
}

/// The number in `size` bytes, at most 8.
std::uint64_t numberIn(const unsigned char* bytes, std::uint64_t size, bool isBigEndian)
{
  std::uint64_t number = 0;
  for (std::uint64_t i = 0; i < size; ++i)
  {
    number = number << 8 | bytes[isBigEndian ? i : size - 1 - i];
  }
  return number;
}

/// A random point of share `i` of `shares` equal ones of `count` points.
std::uint64_t pointOfShare(
  std::uint64_t i, std::uint64_t shares, std::uint64_t count, Random& random)
{
  __extension__ using Wide = unsigned __int128;
  const std::uint64_t place = i << 32 | random.next() >> 32; // in 2^-32 shares
  return std::uint64_t(Wide(place) * count / shares >> 32);
}

bool hasExtension(const std::string& path, std::string_view extension)
{
  return path.size() >= extension.size() &&
    std::equal(extension.begin(), extension.end(), path.end() - std::ptrdiff_t(extension.size()),
      [](char wanted, char found)
      { return wanted == std::tolower(static_cast<unsigned char>(found)); });
}
}

// --- The file ------------------------------------------------------------------------------------

PointFile::Source::Source(const std::string& path)
  // A pipe is not to be waited for.
  : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))
{
  struct stat status = {};
  const char* wrong = nullptr;
  if (file_ < 0 || fstat(file_, &status) != 0)
  {
    wrong = errno == ENOENT ? "there is no such file" : "cannot be opened for reading";
  }
  else if (!S_ISREG(status.st_mode))
  {
    wrong = S_ISDIR(status.st_mode) ? "this is a folder" : "this is no regular file";
  }
  if (wrong)
  {
    if (file_ >= 0)
    {
      ::close(file_);
    }
    throw std::runtime_error(path + ": " + wrong);
  }
  size_ = std::uint64_t(status.st_size);
}

PointFile::Source::~Source() { ::close(file_); }

void PointFile::Source::read(std::uint64_t offset, void* bytes, std::size_t size) const
{
  auto* to = static_cast<unsigned char*>(bytes);
  while (size > 0)
  {
    const ssize_t count = ::pread(file_, to, size, off_t(offset));
    if (count < 0 && errno == EINTR)
    {
      continue;
    }
    if (count <= 0)
    {
      throw std::runtime_error(
        count == 0 ? "it has become shorter while it was read" : "it cannot be read to its end");
    }
    to += count;
    offset += std::uint64_t(count);
    size -= std::size_t(count);
  }
}

/// What is to be read ahead: more than usual, or nothing. Advice may be ignored.
void PointFile::Source::expect(bool isSequential) const
{
  posix_fadvise(file_, 0, 0, isSequential ? POSIX_FADV_SEQUENTIAL : POSIX_FADV_RANDOM);
}

PointFile::PointFile(const std::string& path)
  : path_(path)
  , source_(path)
{
  naming(path,
    [&]
    {
      const bool isPly = hasExtension(path, ".ply");
      if (!isPly && !hasExtension(path, ".vtp"))
      {
        throw std::runtime_error(
          "only .ply, .vtp and raw coordinates can be sampled in place: read other "
          "files as a whole");
      }
      std::string beginning(std::min<std::uint64_t>(source_.size(), LongestHeader), '\0');
      source_.read(0, beginning.data(), beginning.size());
      layout_ = isPly ? layoutOfPly(beginning) : layoutOfVtp(beginning);
      requireWhole();
    });
}

PointFile::PointFile(const std::string& path, bool isDouble, std::uint64_t skip)
  : path_(path)
  , source_(path)
  , layout_(naming(path, [&] { return layoutOfRaw(source_.size(), isDouble, skip); }))
{
}

/// That all points lie in the file, and as many as its own number tells.
void PointFile::requireWhole() const
{
  const PointLayout& layout = layout_;
  std::uint64_t bytes = 0, end = 0;
  if (__builtin_mul_overflow(layout.count, layout.stride, &bytes) ||
    __builtin_add_overflow(layout.offset, bytes, &end) || end > source_.size())
  {
    throw std::runtime_error("damaged: it ends before its last point");
  }
  if (layout.sizeField > 0 && layout.count > 0)
  {
    std::array<unsigned char, 8> number{};
    source_.read(layout.offset - layout.sizeField, number.data(), layout.sizeField);
    if (numberIn(number.data(), layout.sizeField, layout.isBigEndian) != bytes)
    {
      throw std::runtime_error("damaged: it does not have as many points as it says");
    }
  }
}

// --- Drawing -------------------------------------------------------------------------------------

PointFile::Point PointFile::decode(const unsigned char* record) const
{
  const PointLayout& layout = layout_;
  Point point{};
  point.position = numbersAt(record, layout.coordinates);
  if (layout.color)
  {
    std::copy_n(record + *layout.color, 3, point.color.begin());
  }
  if (layout.normal)
  {
    point.normal = numbersAt(record, *layout.normal);
  }
  return point;
}

/// Three numbers of the type of the coordinates.
Eigen::Vector3d PointFile::numbersAt(
  const unsigned char* record, const std::array<std::uint64_t, 3>& places) const
{
  Eigen::Vector3d numbers;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::uint64_t bits =
      numberIn(record + places[axis], layout_.coordinateSize(), layout_.isBigEndian);
    numbers[Eigen::Index(axis)] = layout_.isDouble
      ? std::bit_cast<double>(bits)
      : double(std::bit_cast<float>(std::uint32_t(bits)));
  }
  return numbers;
}

bool PointFile::draw(std::uint64_t wanted, std::uint64_t seed,
  const std::function<void(const Point&)>& take, const Progress& progress) const
{
  const std::uint64_t offset = layout_.offset, stride = layout_.stride;
  const std::uint64_t count = layout_.count;
  const std::uint64_t shares = std::min(wanted, count);
  if (shares == 0)
  {
    return true;
  }
  const std::uint64_t end = offset + count * stride;
  const bool areFarApart = count / shares > FarApart / stride;
  source_.expect(!areFarApart);
  std::vector<unsigned char> piece(areFarApart ? stride : std::max(stride, PieceSize));
  std::uint64_t pieceBegin = 0, pieceEnd = 0;
  Random random(seed, PointFileStream);
  for (std::uint64_t i = 0; i < shares; ++i)
  {
    if (i % SharesBetweenReports == 0 && !progress(double(i) / double(shares)))
    {
      return false;
    }
    const std::uint64_t index = shares == count ? i : pointOfShare(i, shares, count, random);
    const std::uint64_t place = offset + index * stride;
    if (place + stride > pieceEnd)
    {
      pieceBegin = place;
      pieceEnd = place + std::min<std::uint64_t>(piece.size(), end - place);
      naming(path_, [&] { source_.read(pieceBegin, piece.data(), pieceEnd - pieceBegin); });
    }
    take(decode(piece.data() + (place - pieceBegin)));
  }
  return true;
}
}
