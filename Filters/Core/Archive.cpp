// SPDX-License-Identifier: BSD-3-Clause
#include "Archive.h"

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
  this->exchange(number);
  this->require(number <= (this->unread_ + (this->end_ - this->place_)) / leastBytes);
  return std::size_t(number);
}

void Archive::exchange(std::string& text)
{
  text.resize(this->count(text.size(), 1));
  this->bytes(std::as_writable_bytes(std::span(text)));
}

void Archive::bytes(std::span<std::byte> values)
{
  while (!values.empty())
  {
    if (this->place_ == this->end_)
    {
      this->turn();
    }
    const std::size_t size = std::min(values.size(), this->end_ - this->place_);
    std::byte* const place = this->buffer_.data() + this->place_;
    if (this->isReading())
    {
      std::memcpy(values.data(), place, size);
    }
    else
    {
      std::memcpy(place, values.data(), size);
    }
    this->place_ += size;
    values = values.subspan(size);
  }
}

void Archive::turn()
{
  if (this->isReading())
  {
    this->require(this->unread_ > 0);
    this->end_ = std::size_t(std::min<std::uint64_t>(this->unread_, BufferSize));
    this->unread_ -= this->end_;
    this->source_(std::span(this->buffer_).first(this->end_));
  }
  else
  {
    const auto written = std::span<const std::byte>(this->buffer_).first(this->place_);
    this->checksum_.add(written);
    if (this->sink_)
    {
      this->sink_(written);
    }
  }
  this->place_ = 0;
}

void Archive::finish()
{
  if (this->isReading())
  {
    this->require(this->unread_ == 0 && this->place_ == this->end_);
  }
  else
  {
    this->turn();
  }
}
}
