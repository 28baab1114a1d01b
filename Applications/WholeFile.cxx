// SPDX-License-Identifier: BSD-3-Clause
#include "WholeFile.h"

#include "FileExtension.h"

#include <array>
#include <cerrno>
#include <csignal>
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

/** What the names of all temporary files for a target begin with, on this machine. */
std::string TemporaryPrefix(const std::filesystem::path& target)
{
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  std::string prefix = ".";
  prefix.append(target.stem().string()).append(".").append(host.data()).append(".");
  return prefix;
}

bool IsRunning(pid_t process) { return kill(process, 0) == 0 || errno != ESRCH; }

/** Removes the temporary files of processes that were killed while they wrote this target. */
void RemoveLeftovers(const std::filesystem::path& target)
{
  const std::string prefix = TemporaryPrefix(target);
  const std::string extension = FileExtension(target.string());
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(FolderOf(target), ignored))
  {
    const std::string name = entry.path().filename().string();
    if (name.size() <= prefix.size() + extension.size() || !name.starts_with(prefix) ||
      !name.ends_with(extension))
    {
      continue;
    }
    const std::string process =
      name.substr(prefix.size(), name.size() - prefix.size() - extension.size());
    const bool isNumber = process.find_first_not_of("0123456789") == std::string::npos;
    if (isNumber && process.size() < 10 && !IsRunning(std::stoi(process)))
    {
      std::filesystem::remove(entry.path(), ignored);
    }
  }
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
  RemoveLeftovers(target);
  const std::filesystem::path temporary =
    FolderOf(target) / (TemporaryPrefix(target) + std::to_string(getpid()) + FileExtension(path));
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
