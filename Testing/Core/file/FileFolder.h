// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/ReadFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace neuralmesh::testing
{
/// A test with a folder of its own, which is gone afterwards.
class FileFolder : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
      ("neuralmesh-" + std::string(test->test_suite_name()) + "-" + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string pathOf(const std::string& name) const { return (folder_ / name).string(); }

  FileContents contentsOf(const std::string& name, const std::string& bytes) const
  {
    std::ofstream(pathOf(name), std::ios::binary) << bytes;
    return readFile(pathOf(name));
  }

  std::string bytesOfFile(const std::string& name) const
  {
    std::ostringstream bytes;
    bytes << std::ifstream(pathOf(name), std::ios::binary).rdbuf();
    return bytes.str();
  }

  /// The message with which a file is refused; empty if it is not.
  std::string refusal(const std::string& name, const std::string& bytes) const
  {
    try
    {
      contentsOf(name, bytes);
      return "";
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_TRUE(std::string(error.what()).starts_with(pathOf(name))) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return error.what();
    }
  }

  std::filesystem::path folder_;
};

/// A tetrahedron with normals and colours, far enough from the origin that its digits are seen.
inline FileContents tetrahedronContents()
{
  FileContents contents;
  for (const Eigen::Vector3d& point :
    { Eigen::Vector3d(0.1, 0.2, 0.3), { 1.1, 0.2, 0.3 }, { 0.1, 2.2, 0.3 }, { 0.1, 0.2, 3.3 } })
  {
    contents.addPoint(point);
    contents.normals.emplace_back(point.normalized().cast<float>());
    contents.colors.push_back({ std::uint8_t(10 * contents.size()), 0, 255 });
  }
  contents.triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  return contents;
}
}
