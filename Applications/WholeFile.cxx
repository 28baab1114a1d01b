// SPDX-License-Identifier: BSD-3-Clause
#include "WholeFile.h"

#include "FileExtension.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <unistd.h>

void WriteWholeFile(const std::string& path, const std::function<void(const std::string&)>& write)
{
  const std::filesystem::path target(path);
  std::string name = ".";
  name += target.stem().string() + "." + std::to_string(getpid()) + FileExtension(path);
  const std::filesystem::path temporary = target.parent_path() / name;
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
  file << text;
  file.close();
  if (!file)
  {
    throw std::runtime_error("not all of it could be written; is the disk full?");
  }
}
