// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Checksum.h"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace neuralmesh
{
class Archive;

template <typename T>
concept Archived = requires(T& value, Archive& archive)
{
  value.exchange(archive);
};

/// Values one behind the other, in the byte order of the machine: either all are written, or all are
/// read. Each class has one function `exchange(Archive&)` for both, so that the two cannot disagree;
/// reading changes the object, writing does not. What is read is not trusted: it must pass
/// require(), and memory is taken only for what is really there.
class Archive
{
public:
  using Sink = std::function<void(std::span<const std::byte>)>;
  using Source = std::function<void(std::span<std::byte>)>;

  /// What was read cannot be right.
  struct Error : std::runtime_error
  {
    Error()
      : std::runtime_error("it is damaged")
    {
    }
  };

  /// Writes; without a sink only the checksum is made.
  explicit Archive(Sink sink = {});
  /// Reads `size` bytes, with which the source fills what it is given.
  Archive(Source source, std::uint64_t size);

  bool isReading() const { return bool(source_); }

  /// Writes the values, or reads them.
  template <typename... Values>
  void operator()(Values&... values)
  {
    (exchange(values), ...);
  }

  /// Writes how many elements there are, or reads how many there shall be, of which each takes
  /// `leastBytes` here.
  std::size_t count(std::size_t own, std::size_t leastBytes);
  /// Throws Error if what was read does not fulfil a condition. What is written always does.
  void require(bool condition) const
  {
    if (isReading() && !condition)
    {
      throw Error();
    }
  }

  /// Writes what is left; or requires that all is read.
  void finish();
  /// Of what was written, once it is finished.
  std::uint64_t checksum() const { return checksum_.value(); }

private:
  template <typename T>
  void exchange(T& value)
  {
    if constexpr (Archived<T>)
    {
      value.exchange(*this);
    }
    else if constexpr (std::same_as<T, bool>)
    {
      auto number = std::uint8_t(value);
      bytes(std::as_writable_bytes(std::span(&number, 1)));
      require(number <= 1);
      value = number != 0;
    }
    else
    {
      static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
      bytes(std::as_writable_bytes(std::span(&value, 1)));
    }
  }

  template <typename T, typename Allocator>
  void exchange(std::vector<T, Allocator>& values)
  {
    const std::size_t size = count(values.size(), std::is_arithmetic_v<T> ? sizeof(T) : 1);
    if constexpr (std::is_arithmetic_v<T>)
    {
      values.resize(size);
      bytes(std::as_writable_bytes(std::span(values)));
    }
    else
    {
      values.resize(std::min(size, values.size()));
      for (std::size_t i = 0; i < size; ++i)
      {
        // One by one: if they are not there, reading ends before memory is taken for all.
        exchange(i < values.size() ? values[i] : values.emplace_back());
      }
    }
  }

  /// As many as there are.
  template <typename T>
  void exchange(std::span<T>& values)
  {
    static_assert(std::is_arithmetic_v<T>);
    bytes(std::as_writable_bytes(values));
  }

  void exchange(std::string& text);

  void bytes(std::span<std::byte> values);
  /// Writes the buffer out, or fills it anew.
  void exchangeBuffer();

  Sink sink_;
  Source source_;
  std::uint64_t unread_ = 0; ///< bytes that the source still has
  std::vector<std::byte> buffer_;
  std::size_t place_ = 0; ///< in the buffer
  std::size_t end_ = 0;   ///< of what may be written into the buffer, or read from it
  Checksum checksum_;
};
}
