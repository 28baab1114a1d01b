// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PointFile.h"

#include "FileBytes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// The points (i, -i, i / 2) for i from 0 on.
template <typename Number>
std::string rawPoints(std::uint32_t count, bool isBigEndian = false)
{
  std::string bytes;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    bytes += bytesOf(Number(i), isBigEndian) + bytesOf(-Number(i), isBigEndian) +
      bytesOf(Number(i) / 2, isBigEndian);
  }
  return bytes;
}

std::string plyHeader(std::uint64_t count,
  const std::string& properties = "property float x\nproperty "
                                  "float y\nproperty float z\n",
  const std::string& format = "binary_little_endian")
{
  return "ply\nformat " + format + " 1.0\ncomment of no use\nelement vertex " +
    std::to_string(count) + "\n" + properties + "end_header\n";
}

/// As VTK writes it, in short.
std::string vtp(const std::string& data, std::uint64_t count,
  const std::string& file = R"(type="PolyData" byte_order="LittleEndian" header_type="UInt64")",
  const std::string& array =
    R"(type="Float32" NumberOfComponents="3" format="appended" offset="0")",
  const std::string& encoding = "raw")
{
  return "<?xml version=\"1.0\"?>\n<VTKFile " + file + ">\n<PolyData>\n<Piece NumberOfPoints=\"" +
    std::to_string(count) + "\">\n<PointData>\n</PointData>\n<Points>\n<DataArray " + array +
    "/>\n</Points>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"" + encoding + "\">\n_" + data +
    "\n</AppendedData>\n</VTKFile>\n";
}

class PointFiles : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->folder_ = std::filesystem::temp_directory_path() /
      ("neuralmesh-files-" +
        std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(this->folder_);
  }
  void TearDown() override { std::filesystem::remove_all(this->folder_); }

  std::string write(const std::string& name, const std::string& bytes) const
  {
    const std::string path = this->folder_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  std::filesystem::path folder_;
};

std::vector<PointFile::Point> drawn(
  const PointFile& file, std::uint64_t wanted, std::uint64_t seed = 1)
{
  std::vector<PointFile::Point> points;
  EXPECT_TRUE(file.draw(
    wanted, seed, [&](const PointFile::Point& point) { points.push_back(point); }, goOn));
  return points;
}

/// Whether these are the points of rawPoints(), in their order.
void expectAll(const std::vector<PointFile::Point>& points, std::size_t count)
{
  ASSERT_EQ(points.size(), count);
  for (std::size_t i = 0; i < count; ++i)
  {
    EXPECT_EQ(points[i].position, Eigen::Vector3d(double(i), -double(i), double(i) / 2));
  }
}

/// The message with which a file is refused; empty if it is not.
std::string refusal(const std::string& path)
{
  try
  {
    const PointFile file(path);
    return "";
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
}
}

// Every layout that is named is read: all points, in the order of the file, if no fewer are wanted.
TEST_F(PointFiles, ReadsEveryLayout)
{
  const std::string doubles = "property double x\nproperty double y\nproperty double z\n";
  expectAll(drawn(PointFile(write("a.ply", plyHeader(9) + rawPoints<float>(9))), 9), 9);
  expectAll(drawn(PointFile(write("b.PLY", plyHeader(9, doubles) + rawPoints<double>(9))), 99), 9);
  expectAll(drawn(PointFile(write("c.ply",
                    plyHeader(9, doubles, "binary_big_endian") + rawPoints<double>(9, true))),
              9),
    9);
  expectAll(drawn(PointFile(write("d.raw", rawPoints<float>(9)), false, 0), 9), 9);
  expectAll(drawn(PointFile(write("e", "five!" + rawPoints<double>(9)), true, 5), 9), 9);
  expectAll(
    drawn(PointFile(write("f.vtp", vtp(bytesOf(std::uint64_t(108)) + rawPoints<float>(9), 9))), 9),
    9);
  // An offset, the smaller size field, big-endian doubles.
  expectAll(
    drawn(
      PointFile(write("g.vtp",
        vtp("xx" + bytesOf(std::uint32_t(216), true) + rawPoints<double>(9, true), 9,
          R"(type="PolyData" byte_order="BigEndian")",
          R"(type="Float64" Name="Points" NumberOfComponents="3" format="appended" offset="2")"))),
      9),
    9);
  expectAll(drawn(PointFile(write("h.ply", plyHeader(0))), 9), 0);
}

// Other properties, elements before the vertices and whatever follows do no harm; colours are told.
TEST_F(PointFiles, FindsPointsAmongOtherData)
{
  std::string header = "ply\r\nformat binary_little_endian 1.0\r\nelement camera 2\r\n"
                       "property short a\r\nproperty double b\r\nelement vertex 3\r\n"
                       "property uchar red\r\nproperty uchar green\r\nproperty uchar blue\r\n"
                       "property float z\r\nproperty int16 label\r\nproperty float x\r\n"
                       "property float y\r\nelement face 1\r\n"
                       "property list uchar int vertex_indices\r\nend_header\r\n";
  header += std::string(20, 'c');
  for (int i = 0; i < 3; ++i)
  {
    header += std::string{ char(10 + i), char(20 + i), char(30 + i) } + bytesOf(float(i) + .5f) +
      "ll" + bytesOf(float(i)) + bytesOf(float(-i));
  }
  const PointFile file(write("a.ply", header + "faces"));
  ASSERT_TRUE(file.layout().color);
  const auto points = drawn(file, 3);
  ASSERT_EQ(points.size(), 3u);
  for (int i = 0; i < 3; ++i)
  {
    const PointFile::Point& point = points[std::size_t(i)];
    EXPECT_EQ(point.position, Eigen::Vector3d(i, -i, i + .5));
    EXPECT_EQ(point.color,
      (std::array<std::uint8_t, 3>{
        std::uint8_t(10 + i), std::uint8_t(20 + i), std::uint8_t(30 + i) }));
  }
}

// Points are drawn in the order of the file, one of each share, all equally often over many seeds;
// the same seed draws the same, another one others.
TEST_F(PointFiles, DrawsEvenly)
{
  constexpr std::uint32_t count = 1000, wanted = 300, seeds = 2000;
  const PointFile file(write("a.raw", rawPoints<float>(count)), false, 0);
  std::vector<double> times(count, 0.);
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
  {
    const auto points = drawn(file, wanted, seed);
    ASSERT_EQ(points.size(), wanted);
    for (std::size_t i = 0; i < wanted; ++i)
    {
      const double index = points[i].position[0];
      EXPECT_GE(index, std::floor(double(i) * count / wanted));
      EXPECT_LT(index, std::ceil(double(i + 1) * count / wanted));
      ++times[std::size_t(index)];
    }
  }
  const double expected = double(seeds) * wanted / count;
  for (const double found : times)
  {
    EXPECT_NEAR(found, expected, 6. * std::sqrt(expected));
  }
  const auto first = drawn(file, wanted, 1), again = drawn(file, wanted, 1);
  const auto other = drawn(file, wanted, 2);
  const auto isSame = [](const PointFile::Point& a, const PointFile::Point& b)
  { return a.position == b.position; };
  EXPECT_TRUE(std::equal(first.begin(), first.end(), again.begin(), isSame));
  EXPECT_FALSE(std::equal(first.begin(), first.end(), other.begin(), isSame));
}

// Where few points of a large file are drawn, only they are read, and they are right as well.
TEST_F(PointFiles, DrawsFewOfMany)
{
  const PointFile file(write("a.raw", rawPoints<float>(400000)), false, 0);
  for (const PointFile::Point& point : drawn(file, 20))
  {
    EXPECT_EQ(point.position[1], -point.position[0]);
    EXPECT_EQ(point.position[2], point.position[0] / 2);
  }
  // In pieces of a megabyte, too.
  double last = -1.;
  for (const PointFile::Point& point : drawn(file, 100000))
  {
    EXPECT_GT(point.position[0], last);
    EXPECT_EQ(point.position[1], -point.position[0]);
    last = point.position[0];
  }
}

// Points that are not finite are drawn as they are.
TEST_F(PointFiles, KeepsPointsThatAreNotFinite)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const PointFile file(
    write("a.raw", bytesOf(nan) + bytesOf(1.f) + bytesOf(2.f) + rawPoints<float>(1)), false, 0);
  const auto points = drawn(file, 2);
  EXPECT_TRUE(std::isnan(points[0].position[0]));
  EXPECT_TRUE(points[1].position.allFinite());
}

// Whatever a header claims or a file lacks is an error that names the file and tells why.
TEST_F(PointFiles, RefusesHostileFiles)
{
  const std::string whole = plyHeader(9) + rawPoints<float>(9);
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string good = bytesOf(std::uint64_t(108)) + rawPoints<float>(9);
  const std::string array = R"(type="Float32" NumberOfComponents="3" format="appended" offset=)";
  const std::string file = R"(type="PolyData" header_type="UInt64")";
  const std::vector<std::array<std::string, 3>> cases{
    { "short.ply", whole.substr(0, whole.size() - 1), "ends before" },
    { "more.ply", plyHeader(10) + rawPoints<float>(9), "ends before" },
    { "overflow.ply", plyHeader(1537228672809129302u) + rawPoints<float>(9), "ends before" },
    { "huge.ply", plyHeader(18446744073709551615u) + rawPoints<float>(9), "ends before" },
    { "beyond.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999999999999\n" + xyz +
        "end_header\n",
      "no number" },
    { "before.ply",
      "ply\nformat binary_little_endian 1.0\nelement a 9999999999999999999\nproperty double "
      "b\nelement vertex 1\n" +
        xyz + "end_header\n",
      "more bytes" },
    { "negative.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex -1\n" + xyz + "end_header\n",
      "no number" },
    { "text.ply", plyHeader(1, xyz, "ascii") + "0 0 0\n", "text" },
    { "formatless.ply", "ply\nelement vertex 1\n" + xyz + "end_header\n" + rawPoints<float>(1),
      "no format" },
    { "list.ply", plyHeader(9, "property list uchar int a\n" + xyz) + rawPoints<float>(99),
      "lists" },
    { "list_before.ply",
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uchar int i\n"
      "element vertex 1\n" +
        xyz + "end_header\n",
      "lists" },
    { "flat.ply", plyHeader(9, "property float x\nproperty float y\n") + whole, "no z" },
    { "mixed.ply", plyHeader(1, "property float x\nproperty double y\nproperty float z\n") + whole,
      "not all" },
    { "int.ply", plyHeader(1, "property int x\nproperty int y\nproperty int z\n") + whole,
      "not all" },
    { "type.ply", plyHeader(1, "property half x\n") + whole, "no type" },
    { "name.ply", plyHeader(1, "property float\n") + whole, "no name" },
    { "endless.ply", "ply\n" + std::string(2 * LongestHeader, 'c'), "does not end" },
    { "other.ply", "no ply", "no .ply" },
    { "none.ply", "ply\nformat binary_little_endian 1.0\nelement face 0\nend_header\n",
      "no vertices" },
    { "empty.ply", "", "nothing in it" },
    { "empty.vtp", "", "no raw" },
    { "short.vtp", vtp(good.substr(0, 100), 9).substr(0, 400), "ends before" },
    { "size.vtp", vtp(bytesOf(std::uint64_t(109)) + rawPoints<float>(9), 9), "as many points" },
    { "offset.vtp", vtp(good, 9, file, array + "\"18446744073709551615\""), "more bytes" },
    { "far.vtp", vtp(good, 9, file, array + "\"1000\""), "ends before" },
    { "word.vtp", vtp(good, 9, file, array + "\"x\""), "no number" },
    { "nothing.vtp",
      vtp(good, 9, file, R"(type="Float32" NumberOfComponents="3" format="appended")"),
      "no number" },
    { "base64.vtp", vtp(good, 9, file, array + "\"0\"", "base64"), "encoded" },
    { "compressed.vtp", vtp(good, 9, file + R"( compressor="vtkZLibDataCompressor")"),
      "compressed" },
    { "grid.vtp", vtp(good, 9, R"(type="UnstructuredGrid")"), "no PolyData" },
    { "int.vtp",
      vtp(good, 9, file, R"(type="Int32" NumberOfComponents="3" format="appended" offset="0")"),
      "three floats" },
    { "inline.vtp", vtp(good, 9, file, R"(type="Float32" NumberOfComponents="3" format="ascii")"),
      "not appended" },
    { "broken.vtp", "<VTKFile type=PolyData>", "no XML" },
    { "open.vtp", "<VTKFile type=\"PolyData", "no XML" },
    { "cut.vtp", "<VTKFile", "no PolyData" },
    { "bare.vtp", "<AppendedData encoding=\"raw\">_", "no points" },
    { "unknown.xyz", "0 0 0\n", "only .ply" },
  };
  for (const auto& [name, bytes, why] : cases)
  {
    SCOPED_TRACE(name);
    const std::string path = write(name, bytes);
    const std::string message = refusal(path);
    EXPECT_TRUE(message.starts_with(path + ": ")) << message;
    EXPECT_NE(message.find(why), std::string::npos) << message;
  }
  EXPECT_NE(refusal(this->folder_).find("folder"), std::string::npos);
  EXPECT_NE(refusal(this->folder_ / "missing.ply").find("no such file"), std::string::npos);
  EXPECT_NE(refusal("/dev/zero").find("no regular file"), std::string::npos);
  EXPECT_THROW(PointFile(write("a.raw", "12345"), false, 0), std::runtime_error);
  EXPECT_THROW(PointFile(write("a.raw", "12345"), false, 6), std::runtime_error);
}

// A header damaged anywhere is refused or read; nothing else happens.
TEST_F(PointFiles, SurvivesAnyDamage)
{
  const std::string data = bytesOf(std::uint64_t(108)) + rawPoints<float>(9);
  for (const auto& [name, whole] :
    { std::pair<std::string, std::string>{ "a.ply", plyHeader(9) + rawPoints<float>(9) },
      { "a.vtp", vtp(data, 9) } })
  {
    std::size_t refused = 0;
    for (std::size_t place = 0; place < whole.size(); ++place)
    {
      std::string damaged = whole;
      damaged[place] = std::string_view("\0\"<9\n", 5)[place % 5];
      const std::string path = write(name, damaged);
      if (!refusal(path).empty())
      {
        ++refused;
      }
      else
      {
        EXPECT_LE(drawn(PointFile(path), 20).size(), 20u);
      }
      refused += refusal(write(name, whole.substr(0, place))).empty() ? 0u : 1u;
    }
    EXPECT_GT(refused, whole.size() / 2);
  }
}

// A file that becomes shorter while it is drawn from is an error that names it.
TEST_F(PointFiles, SeesThatAFileShrinks)
{
  const std::string path = write("a.raw", rawPoints<float>(400000));
  for (const std::uint64_t wanted : { 20u, 100000u })
  {
    std::ofstream(path, std::ios::binary) << rawPoints<float>(400000);
    const PointFile file(path, false, 0);
    std::filesystem::resize_file(path, 2000000);
    try
    {
      file.draw(
        wanted, 1, [](const PointFile::Point&) {}, goOn);
      FAIL() << "no error";
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_EQ(error.what(), path + ": it has become shorter while it was read");
    }
  }
}

// Drawing can be ended.
TEST_F(PointFiles, CanBeEnded)
{
  const PointFile file(write("a.raw", rawPoints<float>(20000)), false, 0);
  std::size_t count = 0;
  const auto take = [&](const PointFile::Point&) { ++count; };
  EXPECT_FALSE(file.draw(20000, 1, take, [](double fraction) { return fraction < 0.3; }));
  EXPECT_GT(count, 0u);
  EXPECT_LT(count, 20000u);
}
}
