// SPDX-License-Identifier: BSD-3-Clause
#include "base/AtomicFile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
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

/// Names of temporary files are a beginning, which tells the machine, the number of the process, and
/// an end.
std::string beginOfTemporary(const fs::path& path)
{
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  std::string result(".");
  return result.append(path.stem().string()).append(".").append(host.data()).append(".");
}

std::string endOfTemporary(const fs::path& path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

bool isRunning(pid_t process) { return kill(process, 0) == 0 || errno != ESRCH; }

/// Removes the temporary files of processes that were killed while they wrote this file.
void removeLeftovers(const fs::path& path)
{
  const std::string begin = beginOfTemporary(path), end = endOfTemporary(path);
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folderOf(path), ignored))
  {
    const std::string name = entry.path().filename().string();
    if (name.size() <= begin.size() + end.size() || !name.starts_with(begin) ||
      !name.ends_with(end))
    {
      continue;
    }
    const std::string process = name.substr(begin.size(), name.size() - begin.size() - end.size());
    const bool isNumber = process.find_first_not_of("0123456789") == std::string::npos;
    if (isNumber && process.size() < 10 && !isRunning(std::stoi(process)))
    {
      fs::remove(entry.path(), ignored);
    }
  }
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

void writeAtomicFile(const std::string& path, const std::function<void(const std::string&)>& write)
{
  requireWritablePlace(path);
  const fs::path target(path);
  removeLeftovers(target);
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

void removeAtomicFile(const std::string& path)
{
  std::error_code ignored;
  if (fs::remove(path, ignored))
  {
    removeLeftovers(path);
  }
}
}
