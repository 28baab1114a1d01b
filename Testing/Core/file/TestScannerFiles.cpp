// SPDX-License-Identifier: BSD-3-Clause
#include "file/JoinedViews.h"
#include "file/Lzf.h"

#include "cloud/OrientationHints.h"
#include "FileBytes.h"
#include "FileFolder.h"

namespace neuralmesh::testing
{
namespace
{
/// Three points with a normal, a colour, a ring and two echoes; red is such that the float of the
/// colour is no number.
struct PcdSample
{
  static std::string header(const std::string& encoding, const std::string& viewpoint)
  {
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
           "FIELDS x y z _ normal_x normal_y normal_z rgb ring echo\n"
           "SIZE 4 4 4 3 4 4 4 4 2 1\nTYPE F F F U F F F F U I\nCOUNT 1 1 1 1 1 1 1 1 1 2\n"
           "WIDTH 3\nHEIGHT 1\n" +
      viewpoint + "POINTS 3\nDATA " + encoding + "\n";
  }
  static std::vector<std::string> record(int i)
  {
    return { bytesOf(float(i)), bytesOf(2.5f), bytesOf(-1.f), "???", bytesOf(0.f), bytesOf(0.f),
      bytesOf(1.f), bytesOf(std::uint32_t(0xffc81000) + std::uint32_t(i)),
      bytesOf(std::uint16_t(40000 + i)), bytesOf(std::int8_t(-i)) + bytesOf(std::int8_t(7)) };
  }
  static std::string binary()
  {
    std::string bytes;
    for (int i = 0; i < 3; ++i)
    {
      for (const std::string& field : record(i))
      {
        bytes += field;
      }
    }
    return bytes;
  }
  /// Field by field, all of them literal runs.
  static std::string compressed()
  {
    std::string plain, packed;
    for (std::size_t field = 0; field < record(0).size(); ++field)
    {
      for (int i = 0; i < 3; ++i)
      {
        plain += record(i)[field];
      }
    }
    for (std::size_t place = 0; place < plain.size(); place += 32)
    {
      const std::string run = plain.substr(place, 32);
      packed += char(run.size() - 1) + run;
    }
    return bytesOf(std::uint32_t(packed.size())) + bytesOf(std::uint32_t(plain.size())) + packed;
  }
};

/// A grid of `columns` times one, with a matrix that turns x to y and moves by (10, 20, 30).
std::string ptxScan(int columns, const std::string& points)
{
  return std::to_string(columns) +
    "\n1\n10 20 30\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n" + points;
}

using ScannerFiles = FileFolder;
}

// Promise: binary and compressed .pcd have the same points, with all that goes with them: normals, colours
// whatever their bits, and further fields by their names; what only fills is passed over.
TEST_F(ScannerFiles, PcdKeepsWhatItsFieldsSay)
{
  for (const bool isCompressed : { false, true })
  {
    const std::string viewpoint = "VIEWPOINT 1 2 3 1 0 0 0\n";
    const FileContents contents = contentsOf("a.pcd",
      isCompressed ? PcdSample::header("binary_compressed", viewpoint) + PcdSample::compressed()
                   : PcdSample::header("binary", viewpoint) + PcdSample::binary());
    EXPECT_EQ(contents.floats, (std::vector<float>{ 0, 2.5, -1, 1, 2.5, -1, 2, 2.5, -1 }));
    EXPECT_TRUE(contents.doubles.empty());
    ASSERT_EQ(contents.normals.size(), 3u);
    EXPECT_EQ(contents.normals[2], Eigen::Vector3f(0.f, 0.f, 1.f));
    ASSERT_EQ(contents.colors.size(), 3u);
    EXPECT_EQ(contents.colors[1], (std::array<std::uint8_t, 3>{ 0xc8, 0x10, 1 }));
    ASSERT_EQ(contents.arrays.size(), 2u);
    EXPECT_EQ(contents.arrays[0].name, "ring");
    EXPECT_EQ(contents.arrays[0].values, (std::vector<double>{ 40000, 40001, 40002 }));
    EXPECT_EQ(contents.arrays[1].components, 2u);
    EXPECT_EQ(contents.arrays[1].values, (std::vector<double>{ 0, 7, -1, 7, -2, 7 }));
    ASSERT_EQ(contents.viewpoints.size(), 1u);
    EXPECT_EQ(contents.viewpoints[0], Eigen::Vector3d(1., 2., 3.));
  }
}

// Promise: so has .pcd of text, where a colour is the number of its bytes, or the float with these
// bytes; doubles keep their digits, and what is nan is a point.
TEST_F(ScannerFiles, PcdOfText)
{
  const std::string head = "VERSION .7\nFIELDS x y z rgb\nSIZE 8 8 8 4\nTYPE F F F ";
  const std::string tail = "\nWIDTH 1\nHEIGHT 2\nPOINTS 2\nDATA ascii\n";
  const FileContents whole =
    contentsOf("a.pcd", head + "U" + tail + "5400000.125 +1 2 66051\nnan nan nan 0\n");
  EXPECT_EQ(whole.doubles[0], 5400000.125);
  EXPECT_TRUE(std::isnan(whole.doubles[3]));
  EXPECT_EQ(whole.colors[0], (std::array<std::uint8_t, 3>{ 1, 2, 3 }));
  // 2.3418052e-38 has the bytes 0x00ff0000.
  const FileContents real =
    contentsOf("b.pcd", head + "F" + tail + "0 1 2 2.3418052e-38\n1 1 1 0\n");
  EXPECT_EQ(real.colors[0], (std::array<std::uint8_t, 3>{ 255, 0, 0 }));
}

// Promise: the place that programs write which know none is no viewpoint, and points are not moved by
// any.
TEST_F(ScannerFiles, PcdWithoutAViewpoint)
{
  for (const char* viewpoint : { "", "VIEWPOINT 0 0 0 1 0 0 0\n", "VIEWPOINT nan 0 0 1 0 0 0\n" })
  {
    const FileContents contents =
      contentsOf("a.pcd", PcdSample::header("binary", viewpoint) + PcdSample::binary());
    EXPECT_TRUE(contents.viewpoints.empty()) << viewpoint;
  }
  // One that is turned at the origin tells that the sensor was there.
  const FileContents turned = contentsOf(
    "a.pcd", PcdSample::header("binary", "VIEWPOINT 0 0 0 0 1 0 0\n") + PcdSample::binary());
  ASSERT_EQ(turned.viewpoints.size(), 1u);
  EXPECT_EQ(turned.floats[1], 2.5f);
}

// Promise: a grid of rows and columns shows where its camera was, which saw all its points, whatever VIEWPOINT says.
TEST_F(ScannerFiles, PcdThatIsADepthImage)
{
  std::string lines;
  for (int i = 0; i < 16 * 16; ++i)
  {
    const double x = (i % 16 - 8) / 16., y = (i / 16 - 8) / 16., depth = 2. + x * y * y;
    lines += i == 40 ? "nan nan nan\n"
                     : std::to_string(depth * x + 5.) + " " + std::to_string(depth * y - 2.) + " " +
        std::to_string(depth + 1.) + "\n";
  }
  const auto contentsOfSize = [&](const std::string& size, const std::string& viewpoint)
  {
    return contentsOf("a.pcd",
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n" + size + viewpoint + "POINTS 256\nDATA ascii\n" +
        lines);
  };
  const std::string none = "VIEWPOINT 0 0 0 1 0 0 0\n", other = "VIEWPOINT 1 2 3 1 0 0 0\n";
  for (const std::string& told : { none, other })
  {
    const FileContents image = contentsOfSize("WIDTH 16\nHEIGHT 16\n", told);
    ASSERT_EQ(image.viewpoints.size(), 1u);
    EXPECT_LT((image.viewpoints[0] - Eigen::Vector3d(5., -2., 1.)).norm(), 0.01);
    EXPECT_EQ(image.views, std::vector<std::uint32_t>(256, 0));
  }
  EXPECT_TRUE(contentsOfSize("WIDTH 256\nHEIGHT 1\n", none).viewpoints.empty());
  EXPECT_EQ(contentsOfSize("WIDTH 256\nHEIGHT 1\n", other).viewpoints.size(), 1u);
}

// Promise: LZF's runs and copies come out, copies of what they write themselves, too; what refers to
// before the beginning, or is not as long as told, is an error.
TEST(Lzf, RunsAndCopies)
{
  const std::string packed = std::string("\2abc\x20\2\xe0\5", 8) + std::string(1, '\0');
  EXPECT_EQ(decompressLzf(packed, 20), "abcabc" + std::string(14, 'c'));
  EXPECT_THROW(decompressLzf(packed, 19), std::runtime_error);
  EXPECT_THROW(decompressLzf(packed, 21), std::runtime_error);
  EXPECT_THROW(decompressLzf(packed.substr(0, 8), 20), std::runtime_error);
  EXPECT_THROW(decompressLzf(std::string_view("\x20\1", 2), 3), std::runtime_error);
  EXPECT_THROW(decompressLzf("", std::size_t(1) << 60), std::runtime_error);
}

// Promise: the scans of a .ptx lie where their matrices take them, each with its scanner and what it
// measured; what did not come back is left out and counted, and colours may be in one scan only.
TEST_F(ScannerFiles, PtxPutsScansTogether)
{
  const FileContents contents = contentsOf("a.ptx",
    ptxScan(3, "1 0 0 0.5\n0 0 0 0.5\n0 2 0 0.25\n") +
      "1\n2\n7 8 9\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
      "1.5 2.5 3.5 1 10 20 30\n0 0 0 0 0 0 0\n");
  EXPECT_EQ(contents.doubles, (std::vector<double>{ 10, 21, 30, 8, 20, 30, 1.5, 2.5, 3.5 }));
  EXPECT_EQ(contents.missingReturns, 2u);
  ASSERT_EQ(contents.arrays.size(), 1u);
  EXPECT_EQ(contents.arrays[0].name, "Intensity");
  EXPECT_EQ(contents.arrays[0].values, (std::vector<double>{ 0.5, 0.25, 1 }));
  EXPECT_EQ(contents.views, (std::vector<std::uint32_t>{ 0, 0, 1 }));
  ASSERT_EQ(contents.viewpoints.size(), 2u);
  EXPECT_EQ(contents.viewpoints[0], Eigen::Vector3d(10., 20., 30.));
  // The matrix changes nothing: points lie where the place of the scanner is told.
  EXPECT_EQ(contents.viewpoints[1], Eigen::Vector3d(7., 8., 9.));
  ASSERT_EQ(contents.colors.size(), 3u);
  EXPECT_EQ(contents.colors[0], (std::array<std::uint8_t, 3>{}));
  EXPECT_EQ(contents.colors[2], (std::array<std::uint8_t, 3>{ 10, 20, 30 }));
}

// Promise: all points of a single scan were seen from its scanner.
TEST_F(ScannerFiles, PtxOfOneScan)
{
  const FileContents contents = contentsOf("a.ptx", ptxScan(1, "1 0 0 0.5\n"));
  EXPECT_EQ(contents.viewpoints.size(), 1u);
  EXPECT_EQ(contents.views, std::vector<std::uint32_t>{ 0 });
  EXPECT_TRUE(contents.colors.empty());
}

// Promise: each form of .pwn has the same points and normals.
TEST_F(ScannerFiles, PwnInEveryForm)
{
  for (const char* text : { "2\n1 2 3\n4 5 6\n0 0 1\n0 1 0\n", "2\n1 2 3 0 0 1\n4 5 6 0 1 0\n",
         "# a comment\n\n1 2 3 0 0 1\n4 5 6 0 1 0" })
  {
    const FileContents contents = contentsOf("a.pwn", text);
    EXPECT_EQ(contents.doubles, (std::vector<double>{ 1, 2, 3, 4, 5, 6 })) << text;
    ASSERT_EQ(contents.normals.size(), 2u) << text;
    EXPECT_EQ(contents.normals[1], Eigen::Vector3f(0.f, 1.f, 0.f));
  }
}

// Promise: points of several files keep their viewpoints apart; a file that knows none says so of its
// points; and where one does not tell which of its own is whose, none is told apart.
TEST(JoinedViews, KeepFilesApart)
{
  constexpr std::uint32_t none = OrientationHints::NoView;
  const Eigen::Vector3d a(1, 0, 0), b(2, 0, 0), c(3, 0, 0);
  const std::vector<FileViews> parts{ { 2, { a }, {} }, { 1, {}, {} },
    { 3, { b, c }, { 1, 0, 5 } } };
  const FileViews joined = joinedViews(parts);
  EXPECT_EQ(joined.points, 6u);
  EXPECT_EQ(joined.viewpoints, (std::vector<Eigen::Vector3d>{ a, b, c }));
  EXPECT_EQ(joined.views, (std::vector<std::uint32_t>{ 0, 0, none, 2, 1, none }));

  const std::vector<FileViews> untold{ { 2, { a }, {} }, { 3, { b, c }, {} } };
  EXPECT_EQ(joinedViews(untold).viewpoints.size(), 3u);
  EXPECT_TRUE(joinedViews(untold).views.empty());
  const std::vector<FileViews> nothing{ { 2, {}, {} }, { 3, {}, {} } };
  EXPECT_TRUE(joinedViews(nothing).views.empty());
}

// Promise: the mark that some programs begin text with is no part of the first point.
TEST_F(ScannerFiles, TextWithAMarkOfItsEncoding)
{
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(contentsOf("a.xyz", mark + "1 2 3\n4 5 6\n").doubles,
    (std::vector<double>{ 1, 2, 3, 4, 5, 6 }));
}

// Promise: for files that Python reads there is the command; for others there is none.
TEST_F(ScannerFiles, ConversionsAreTold)
{
  for (const char* name : { "a.las", "a.LAZ", "it's.e57" })
  {
    const std::string message = refusal(name, "LASF");
    EXPECT_NE(message.find("neuralmesh[lidar]"), std::string::npos) << message;
    EXPECT_NE(message.find("python3 -c"), std::string::npos) << message;
  }
  EXPECT_NE(conversionOf("it's.e57").find("'it'\\''s.e57'"), std::string::npos);
  EXPECT_NE(refusal("a.npy", "x").find("numpy.load('"), std::string::npos);
  EXPECT_NE(refusal("a.xyz.gz", "x").find("unpack it first"), std::string::npos);
  EXPECT_EQ(conversionOf("a.ply"), "");
  EXPECT_NE(refusal("a.doc", "0 0 0\n").find("unknown extension"), std::string::npos);
  EXPECT_TRUE(canReadFile("a.PCD"));
  EXPECT_FALSE(canReadFile("a.las"));
}
}
