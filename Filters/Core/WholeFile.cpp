// SPDX-License-Identifier: BSD-3-Clause
#include "WholeFile.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace neuralmesh
{
namespace
{
namespace fs = std::filesystem;

fs::path folderOf(const fs::path& path)
{
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Names of temporary files are a beginning, the number of the process, and an end.
std::string beginOfTemporary(const fs::path& path)
{
  std::string result(".");
  return result += path.stem().string() += ".";
}

std::string endOfTemporary(const fs::path& path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

bool isTemporaryOf(const fs::path& path, const std::string& name)
{
  const std::string begin = beginOfTemporary(path), end = endOfTemporary(path);
  return name.size() > begin.size() + end.size() && name.starts_with(begin) &&
    name.ends_with(end) &&
    std::all_of(name.begin() + std::ptrdiff_t(begin.size()),
      name.end() - std::ptrdiff_t(end.size()),
      [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Waits until a file, or the names in a folder, are on the disk. Some file systems cannot tell.
bool sync(const fs::path& path)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool isDone = file >= 0 && (fsync(file) == 0 || errno == EINVAL || errno == ENOSYS);
  if (file >= 0)
  {
    close(file);
  }
  return isDone;
}
}

void requireWritablePlace(const std::string& path)
{
  std::error_code error;
  if (fs::is_directory(path, error))
  {
    throw std::runtime_error(path + ": cannot be written: this is a folder");
  }
  const fs::path folder = folderOf(path);
  if (!fs::is_directory(folder, error))
  {
    throw std::runtime_error(path + ": cannot be written: there is no such folder");
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0)
  {
    throw std::runtime_error(path + ": cannot be written: the folder takes no files");
  }
}

void writeWholeFile(const std::string& path, const std::function<void(const std::string&)>& write)
{
  requireWritablePlace(path);
  const fs::path target(path);
  const fs::path temporary = folderOf(target) /
    (beginOfTemporary(target) + std::to_string(getpid()) + endOfTemporary(target));
  try
  {
    write(temporary.string());
    if (!sync(temporary))
    {
      throw std::runtime_error("it does not get onto the disk");
    }
    fs::rename(temporary, target);
    sync(folderOf(target)); // if that cannot be, it is there all the same
  }
  catch (const std::exception& error)
  {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw std::runtime_error(path + ": cannot be written: " + error.what());
  }
}

void writeText(const std::string& text, const std::string& path)
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

void removeWholeFile(const std::string& path)
{
  std::error_code ignored;
  if (!fs::remove(path, ignored))
  {
    return;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folderOf(path), ignored))
  {
    if (isTemporaryOf(path, entry.path().filename().string()))
    {
      fs::remove(entry.path(), ignored);
    }
  }
}
}
