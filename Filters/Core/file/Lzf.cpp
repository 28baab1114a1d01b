// SPDX-License-Identifier: BSD-3-Clause
#include "file/Lzf.h"

#include <stdexcept>

namespace neuralmesh
{
namespace
{
/// A copy has at most so many bytes, and takes three.
constexpr std::size_t LongestCopy = 264;
/// Smaller first bytes begin a literal run.
constexpr std::size_t FirstCopy = 32;

[[noreturn]] void throwDamagedData()
{
  throw std::runtime_error("damaged: its compressed data does not hold what the header says");
}

class LzfBytes
{
public:
  explicit LzfBytes(std::string_view bytes)
    : bytes_(bytes)
  {
  }
  bool empty() const { return place_ == bytes_.size(); }
  std::size_t next() { return static_cast<unsigned char>(take(1).front()); }
  std::string_view take(std::size_t count)
  {
    if (count > bytes_.size() - place_)
    {
      throwDamagedData();
    }
    place_ += count;
    return bytes_.substr(place_ - count, count);
  }

private:
  std::string_view bytes_;
  std::size_t place_ = 0;
};
}

std::string decompressLzf(std::string_view bytes, std::size_t size)
{
  if (size / LongestCopy > bytes.size())
  {
    throwDamagedData();
  }
  std::string result;
  result.reserve(size);
  for (LzfBytes input(bytes); !input.empty();)
  {
    const std::size_t control = input.next();
    if (control < FirstCopy)
    {
      result += input.take(control + 1);
    }
    else
    {
      std::size_t length = control / FirstCopy;
      length += length == 7 ? input.next() : 0;
      const std::size_t back = (control % FirstCopy) * 256 + input.next() + 1;
      if (back > result.size())
      {
        throwDamagedData();
      }
      // It may run into what it writes.
      for (std::size_t i = 0; i < length + 2; ++i)
      {
        result += result[result.size() - back];
      }
    }
    if (result.size() > size)
    {
      throwDamagedData();
    }
  }
  if (result.size() != size)
  {
    throwDamagedData();
  }
  return result;
}
}
