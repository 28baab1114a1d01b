// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace neuralmesh
{
/// The extension of a path with its dot, in small letters.
inline std::string fileExtension(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}
}
