// SPDX-License-Identifier: BSD-3-Clause
#include "WholeFile.h"

#include "FileExtension.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <unistd.h>

namespace
{
std::filesystem::path FolderOf(const std::filesystem::path& path)
{
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}
}

void RequireWritablePlace(const std::string& path)
{
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
  {
    throw std::runtime_error(path + ": cannot be written: this is a folder");
  }
  const std::filesystem::path folder = FolderOf(path);
  if (!std::filesystem::is_directory(folder, error))
  {
    throw std::runtime_error(path + ": cannot be written: there is no such folder");
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0)
  {
    throw std::runtime_error(path + ": cannot be written: the folder takes no files");
  }
}

void WriteWholeFile(const std::string& path, const std::function<void(const std::string&)>& write)
{
  RequireWritablePlace(path);
  const std::filesystem::path target(path);
  std::string name = ".";
  name += target.stem().string() + "." + std::to_string(getpid()) + FileExtension(path);
  const std::filesystem::path temporary = FolderOf(target) / name;
  try
  {
    write(temporary.string());
    std::filesystem::rename(temporary, target);
  }
  catch (const std::exception& error)
  {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(path + ": cannot be written: " + error.what());
  }
}

void WriteText(const std::string& text, const std::string& path)
{
  std::ofstream file(path, std::ios::binary);
  if (!file)
  {
    throw std::runtime_error("no file can be made there");
  }
  file << text;
  file.close();
  if (!file)
  {
    throw std::runtime_error("not all of it could be written; is the disk full?");
  }
}
