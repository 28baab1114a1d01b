// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>

namespace neuralmesh
{
/// A file that is read line by line, or whole; errors name it.
class InputFile
{
public:
  /// Throws std::runtime_error if it cannot be opened.
  explicit InputFile(const std::string& path);

  std::uint64_t size() const { return size_; }
  /// The next line, without its end; false if there is none. Throws std::runtime_error where the disk
  /// fails.
  bool nextLine();
  /// As nextLine(), but without lines that are empty or begin with `#`.
  bool nextFilledLine();
  const std::string& line() const { return line_; }
  /// Whether the file ended before the line did.
  bool isLastWithoutEnd() const { return file_.eof(); }
  /// All bytes that have not been read yet.
  std::string rest();

  /// An error that names the file.
  std::runtime_error error(const std::string& what) const;
  /// One that names the line, too.
  std::runtime_error errorInLine(const std::string& what) const;

private:
  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::string line_;
  std::uint64_t lineNumber_ = 0;
};
}
