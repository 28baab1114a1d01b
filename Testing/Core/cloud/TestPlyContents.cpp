// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PlyContents.h"

#include "FileBytes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace neuralmesh::testing
{
namespace
{
std::string header(const std::string& format, const std::string& type, const std::string& more = "")
{
  return "ply\nformat " + format + " 1.0\n" + more + "element vertex 2\nproperty " + type +
    " x\nproperty uchar red\nproperty " + type + " y\nproperty " + type +
    " z\nelement face 2\nproperty list uchar int vertex_indices\nproperty uchar kind\nend_header\n";
}

/// The vertices (5400000.125, -1, 0.5), (3, 4, 5), a triangle and a pair.
template <typename Number>
std::string binary(bool isBigEndian)
{
  std::string bytes;
  for (const auto& point : { std::array<Number, 3>{ Number(5400000.125), Number(-1), Number(0.5) },
         std::array<Number, 3>{ Number(3), Number(4), Number(5) } })
  {
    bytes += bytesOf(point[0], isBigEndian) + "r" + bytesOf(point[1], isBigEndian) +
      bytesOf(point[2], isBigEndian);
  }
  bytes += '\3';
  for (const std::int32_t corner : { 0, 1, 0 })
  {
    bytes += bytesOf(corner, isBigEndian);
  }
  return bytes + "k\2" + bytesOf(std::int32_t(1), isBigEndian) +
    bytesOf(std::int32_t(0), isBigEndian) + "k";
}

const std::string Text = "5400000.125 1 -1 0.5\n3 1 4 5\n3 0 1 0 1\n2 1 0 1\n";
const std::vector<double> Coordinates{ 5400000.125, -1., 0.5, 3., 4., 5. };

class PlyFiles : public ::testing::Test
{
protected:
  void SetUp() override
  {
    path_ = std::filesystem::temp_directory_path() /
      ("neuralmesh-" +
        std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".ply");
  }
  void TearDown() override { std::filesystem::remove(path_); }

  PlyContents contentsOf(const std::string& bytes) const
  {
    std::ofstream(path_, std::ios::binary) << bytes;
    return readPlyContents(path_);
  }

  /// The message with which a file is refused; empty if it is not.
  std::string refusal(const std::string& bytes) const
  {
    try
    {
      contentsOf(bytes);
      return "";
    }
    catch (const std::runtime_error& error)
    {
      return error.what();
    }
  }

  std::filesystem::path path_;
};
}

// Promise: doubles come out to the last bit, from text and from both orders of bytes, whatever stands
// between and behind them.
TEST_F(PlyFiles, DoublesKeepTheirDigits)
{
  const std::string little = "binary_little_endian", big = "binary_big_endian";
  EXPECT_EQ(contentsOf(header("ascii", "double") + Text).coordinates, Coordinates);
  EXPECT_EQ(contentsOf(header(little, "double") + binary<double>(false)).coordinates, Coordinates);
  EXPECT_EQ(contentsOf(header(big, "float64") + binary<double>(true)).coordinates, Coordinates);
}

// Promise: so do whole numbers that are too large for floats; what floats hold is left to them.
TEST_F(PlyFiles, OnlyWhatFloatsCannotHoldComesOut)
{
  const std::vector<double> whole{ 5400000., -1., 0., 3., 4., 5. };
  EXPECT_EQ(
    contentsOf(header("binary_big_endian", "int") + binary<std::int32_t>(true)).coordinates, whole);
  for (const char* type : { "float", "short" })
  {
    EXPECT_TRUE(contentsOf(header("ascii", type) + Text).coordinates.empty()) << type;
  }
  const std::string floats = header("binary_little_endian", "float") + binary<float>(false);
  EXPECT_TRUE(contentsOf(floats).coordinates.empty());
}

// Promise: floats come out where a binary file has nothing but x, y, z in this order; all else is left to other readers.
TEST_F(PlyFiles, FloatsAloneComeOut)
{
  const auto file = [](const std::string& format, const std::string& axes, const std::string& more)
  {
    std::string bytes = "ply\nformat " + format + " 1.0\nelement vertex 2\n";
    for (const char axis : axes)
    {
      bytes += std::string("property float ") + axis + "\n";
    }
    bytes += more + "end_header\n";
    for (const float number : { 1.f, -2.f, 0.5f, 3.f, 4.f, 5.f })
    {
      bytes += bytesOf(number, format == "binary_big_endian");
    }
    return bytes;
  };
  const std::string little = "binary_little_endian", whole = file(little, "xyz", "");
  EXPECT_EQ(contentsOf(whole).floats, (std::vector<float>{ 1.f, -2.f, 0.5f, 3.f, 4.f, 5.f }));
  EXPECT_TRUE(contentsOf(file(little, "zyx", "")).floats.empty());
  EXPECT_TRUE(contentsOf(file("binary_big_endian", "xyz", "")).floats.empty());
  EXPECT_TRUE(
    contentsOf(file(little, "xyz", "element face 0\nproperty list uchar int vertex_indices\n"))
      .floats.empty());
  EXPECT_NE(
    refusal(file(little, "xyzw", "")).find("ends before its last vertex"), std::string::npos);
  EXPECT_NE(refusal(whole.substr(0, whole.size() - 1)).find("ends before its last vertex"),
    std::string::npos);
}

// Promise: numbers of text may have a sign, an exponent, or be not finite; words are no coordinates.
TEST_F(PlyFiles, NumbersOfText)
{
  const auto text = [](const std::string& line)
  { return header("ascii", "double") + line + "\n3 1 4 5\n3 0 1 0 1\n2 1 0 1\n"; };
  const auto coordinates = contentsOf(text(" +1e2\t0 nan -inf more\r")).coordinates;
  ASSERT_EQ(coordinates.size(), 6u);
  EXPECT_EQ(coordinates[0], 100.);
  EXPECT_TRUE(std::isnan(coordinates[1]));
  EXPECT_EQ(coordinates[2], -HUGE_VAL);
  EXPECT_NE(refusal(text("1 0 two 3")).find("'two' is no coordinate"), std::string::npos);
}

// Promise: a file that ends anywhere before its last byte, or the last word of a text, is refused.
TEST_F(PlyFiles, EveryCutIsRefused)
{
  const std::string little = header("binary_little_endian", "float") + binary<float>(false);
  const std::string big = header("binary_big_endian", "double") + binary<double>(true);
  const std::string text = header("ascii", "float") + Text;
  for (const std::string& whole : { little, big, text })
  {
    EXPECT_EQ(refusal(whole), "");
    const std::size_t needed = whole.size() - (whole == text ? 1 : 0);
    for (std::size_t size = 0; size < needed; ++size)
    {
      ASSERT_NE(refusal(whole.substr(0, size)), "") << size << " of " << needed << " bytes";
    }
  }
  EXPECT_NE(refusal(little.substr(0, little.size() - 1)).find("ends before its last face"),
    std::string::npos);
  EXPECT_NE(
    refusal(text.substr(0, text.size() - 3)).find("ends before its last face"), std::string::npos);
}

// Promise: a header that claims what no file has, or that makes no sense, is an error in words.
TEST_F(PlyFiles, DamagedOnesAreRefused)
{
  const std::string xyz = "property double x\nproperty double y\nproperty double z\n";
  const std::string begin = "ply\nformat binary_little_endian 1.0\n", end = "end_header\n";
  const std::string faces = "element face 1\nproperty list char int vertex_indices\n";
  for (const auto& [bytes, words] :
    { std::pair{ begin + "element vertex 4000000000\n" + xyz + end, "ends before its last vertex" },
      { begin + "element vertex 18446744073709551615\n" + xyz + end,
        "ends before its last vertex" },
      { begin + "element a 9999999999999999999\nproperty double b\nelement vertex 0\n" + xyz + end,
        "more bytes than any file" },
      { begin + "element vertex 0\n" + xyz + faces + end + "\xff", "ends before its last face" },
      { begin + "element vertex 0\nproperty double x\nproperty double z\n" + end, "have no y" },
      { begin + faces + end + '\0', "no vertices" },
      { begin + "element face 0\nproperty list float int i\n" + end, "no whole number" },
      { "ply\nformat utf8 1.0\nelement vertex 0\n" + xyz + end, "no format utf8" },
      { std::string("ply\nformat ascii 1.0\nelement vertex 2\n") + xyz + end + "1 2 3\n\n1 2 3\n",
        "line of vertex 1 is too short" } })
  {
    EXPECT_NE(refusal(bytes).find(words), std::string::npos)
      << refusal(bytes) << " is not " << words;
  }
}

// Promise: a shift that is noted comes out to the last bit, in plain digits where there are few;
// comments that only look like one do not.
TEST_F(PlyFiles, ShiftIsNoted)
{
  EXPECT_EQ(commentOfShift({ 500000., -5400000., 0.125 }), "shift 500000 -5400000 0.125");
  const Eigen::Vector3d shift(0.1, -1. / 3., 1e20);
  const std::string comment = "comment first\ncomment " + commentOfShift(shift) + "\n";
  EXPECT_EQ(contentsOf(header("ascii", "float", comment) + Text).shift, shift);
  for (const char* other : { "", "comment shift 1 2\n", "comment shift 1 2 nan\n",
         "comment shift 1 2 3 4\n", "comment no shift 1 2 3\n", "obj_info shift 1 2 3\n" })
  {
    EXPECT_FALSE(contentsOf(header("ascii", "float", other) + Text).shift) << other;
  }
}

// Promise: with doubles for floats, everything else in a file stays.
TEST_F(PlyFiles, DoublesTakeThePlaceOfFloats)
{
  const std::string begin = "ply\nformat binary_little_endian 1.0\ncomment property float x y\n"
                            "element vertex 2\n";
  const std::string more = "property float nx\nelement face 0\nproperty uchar i\nend_header\n";
  std::string before = begin + "property float x\nproperty float y\nproperty float z\n" + more;
  std::string after = begin + "property double x\nproperty double y\nproperty double z\n" + more;
  for (std::size_t i = 0; i < 6; i += 3)
  {
    before += "xxxxyyyyzzzznorm";
    after +=
      bytesOf(Coordinates[i]) + bytesOf(Coordinates[i + 1]) + bytesOf(Coordinates[i + 2]) + "norm";
  }
  EXPECT_EQ(withDoubles(before + "behind", Coordinates), after + "behind");
  EXPECT_EQ(contentsOf(after).coordinates, Coordinates);
}
}
