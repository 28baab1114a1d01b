// SPDX-License-Identifier: BSD-3-Clause
#ifndef FileExtension_h
#define FileExtension_h

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

/** The extension of a path with its dot, in lower case. */
inline std::string FileExtension(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

#endif
