// SPDX-License-Identifier: BSD-3-Clause
#include "base/Archive.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr std::size_t BufferSize = std::size_t(1) << 16;
}

Archive::Archive(Sink sink)
  : sink_(std::move(sink))
  , buffer_(BufferSize)
  , end_(BufferSize)
{
}

Archive::Archive(Source source, std::uint64_t size)
  : source_(std::move(source))
  , unread_(size)
  , buffer_(BufferSize)
{
}

std::size_t Archive::count(std::size_t own, std::size_t leastBytes)
{
  auto number = std::uint64_t(own);
  exchange(number);
  require(number <= (unread_ + (end_ - place_)) / leastBytes);
  return std::size_t(number);
}

void Archive::exchange(std::string& text)
{
  text.resize(count(text.size(), 1));
  bytes(std::as_writable_bytes(std::span(text)));
}

void Archive::bytes(std::span<std::byte> values)
{
  while (!values.empty())
  {
    if (place_ == end_)
    {
      exchangeBuffer();
    }
    const std::size_t size = std::min(values.size(), end_ - place_);
    std::byte* const place = buffer_.data() + place_;
    if (isReading())
    {
      std::memcpy(values.data(), place, size);
    }
    else
    {
      std::memcpy(place, values.data(), size);
    }
    place_ += size;
    values = values.subspan(size);
  }
}

void Archive::exchangeBuffer()
{
  if (isReading())
  {
    require(unread_ > 0);
    end_ = std::size_t(std::min<std::uint64_t>(unread_, BufferSize));
    unread_ -= end_;
    source_(std::span(buffer_).first(end_));
  }
  else
  {
    const auto written = std::span<const std::byte>(buffer_).first(place_);
    checksum_.add(written);
    if (sink_)
    {
      sink_(written);
    }
  }
  place_ = 0;
}

void Archive::finish()
{
  if (isReading())
  {
    require(unread_ == 0 && place_ == end_);
  }
  else
  {
    exchangeBuffer();
  }
}
}
