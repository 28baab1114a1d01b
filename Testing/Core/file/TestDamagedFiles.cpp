// SPDX-License-Identifier: BSD-3-Clause
#include "file/WriteMesh.h"

#include "FileBytes.h"
#include "FileFolder.h"

#include <algorithm>

namespace neuralmesh::testing
{
namespace
{
struct Sample
{
  std::string name;
  std::string bytes;
  bool tellsItsEnd = true; ///< else one that ends between two lines is a shorter file
};

std::string pcdHeader(const std::string& encoding, const std::string& points)
{
  return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + points +
    "\nHEIGHT 1\nVIEWPOINT 0 0 1 1 0 0 0\nPOINTS " + points + "\nDATA " + encoding + "\n";
}

std::vector<Sample> samples()
{
  std::string floats, lines, stl = "solid\n", ply, compressed;
  for (int i = 0; i < 30; ++i)
  {
    const std::string number = std::to_string(1000 + i);
    floats += bytesOf(float(i));
    lines += number + " 0.25 0.125\n";
    stl += "facet normal 0 0 1\nouter loop\nvertex " + number + " 0 0\nvertex " + number +
      " 1 0\nvertex " + number + " 0 1\nendloop\nendfacet\n";
    ply += "3 0 1 2\n";
  }
  for (std::size_t place = 0; place < floats.size(); place += 30)
  {
    compressed += '\x1d' + floats.substr(place, 30);
  }
  const std::string packed =
    bytesOf(std::uint32_t(compressed.size())) + bytesOf(std::uint32_t(floats.size())) + compressed;
  const std::string scan =
    "30\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n" + lines;
  const FileContents mesh = tetrahedronContents();
  return { { "binary.ply", meshBytesOf(".ply", mesh) },
    { "text.ply",
      "ply\nformat ascii 1.0\nelement vertex 30\nproperty double x\nproperty double y\n"
      "property double z\nelement face 30\nproperty list uchar int vertex_indices\nend_header\n" +
        lines + ply },
    { "binary.stl", meshBytesOf(".stl", mesh) }, { "text.stl", stl + "endsolid\n" },
    { "text.off", meshBytesOf(".off", mesh) }, { "ascii.pcd", pcdHeader("ascii", "30") + lines },
    { "binary.pcd", pcdHeader("binary", "10") + floats },
    { "compressed.pcd", pcdHeader("binary_compressed", "10") + packed },
    { "count.pwn", "30\n" + lines + lines }, { "count.pts", "30\n" + lines },
    { "scans.ptx", scan + scan, false }, { "text.obj", meshBytesOf(".obj", mesh), false },
    { "text.xyz", lines, false } };
}

/// Where a text may end without a sign: within its last number, and behind it.
std::size_t placeOfLastNumber(const std::string& bytes)
{
  const std::size_t end = bytes.find_last_not_of("\r\n");
  return bytes.find_last_of(" \n", end) + 2;
}

void expectSound(const FileContents& contents)
{
  const std::size_t points = contents.size();
  for (const auto& triangle : contents.triangles)
  {
    EXPECT_LT(*std::max_element(triangle.begin(), triangle.end()), points);
  }
  EXPECT_TRUE(contents.normals.empty() || contents.normals.size() == points);
  EXPECT_TRUE(contents.colors.empty() || contents.colors.size() == points);
  EXPECT_TRUE(contents.views.empty() || contents.views.size() == points);
  for (const NumberArray& array : contents.arrays)
  {
    EXPECT_EQ(array.values.size(), array.components * points);
  }
}

using DamagedFiles = FileFolder;
}

// Promise: a file that ends at any tenth byte is refused with its name; where a format does not tell its
// end it may be a shorter file, which is sound.
TEST_F(DamagedFiles, EveryCut)
{
  for (const auto& [name, bytes, tellsItsEnd] : samples())
  {
    SCOPED_TRACE(name);
    const FileContents whole = contentsOf(name, bytes);
    EXPECT_GT(whole.size(), 0u);
    const bool isBinary = bytes.find('\0') != std::string::npos;
    const std::size_t needed = isBinary ? bytes.size() : placeOfLastNumber(bytes);
    for (std::size_t size = 1; size < needed; size += 10)
    {
      const std::string message = refusal(name, bytes.substr(0, size));
      if (tellsItsEnd)
      {
        ASSERT_NE(message, "") << size << " of " << bytes.size() << " bytes";
      }
      else if (message.empty())
      {
        const FileContents shorter = readFile(pathOf(name));
        expectSound(shorter);
        ASSERT_LE(shorter.size(), whole.size());
      }
    }
  }
}

// Promise: some wrong bytes are an error with the name of the file, or what comes out is sound.
TEST_F(DamagedFiles, WrongBytes)
{
  std::uint64_t state = 1;
  const auto random = [&state](std::size_t below)
  {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return std::size_t((state >> 33) % below);
  };
  for (const Sample& sample : samples())
  {
    SCOPED_TRACE(sample.name);
    for (int i = 0; i < 60; ++i)
    {
      std::string bytes = sample.bytes;
      for (std::size_t k = random(4) + 1; k > 0; --k)
      {
        bytes[random(bytes.size())] = char(random(256));
      }
      if (refusal(sample.name, bytes).empty())
      {
        expectSound(readFile(pathOf(sample.name)));
      }
    }
  }
}

// Promise: what a header claims and the file cannot hold is an error, and takes no memory: each of
// these would be more than any machine has, or never end.
TEST_F(DamagedFiles, HeadersThatClaimTooMuch)
{
  const std::string many = "4000000000000000000", stlTitle(80, '\0');
  const std::string pcd = "FIELDS x y z f\nSIZE 4 4 4 4\nTYPE F F F F\n";
  const std::string ptx =
    "\n1 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 4\n";
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
         { "a.ply",
           "ply\nformat binary_little_endian 1.0\nelement vertex " + many +
             "\nproperty float x\nproperty float y\nproperty float z\nend_header\nabcdefghijkl" },
         { "b.ply",
           "ply\nformat ascii 1.0\nelement vertex " + many +
             "\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n" },
         { "c.ply",
           "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
           "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n"
           "0 0 0\n4000000000 0 0 0\n" },
         { "a.stl", stlTitle + "\xff\xff\xff\xff" + std::string(50, '\0') },
         { "a.off", "OFF\n" + many + " 0 0\n0 0 0\n" },
         { "b.off", "OFF\n1 1 0\n0 0 0\n" + many + " 0 0 0\n" }, { "a.pwn", many + "\n0 0 0\n" },
         { "a.pts", many + "\n0 0 0\n" }, { "a.ptx", many + "\n" + many + ptx },
         { "b.ptx", "1000000000\n1000000000" + ptx },
         { "a.pcd", pcd + "WIDTH " + many + "\nHEIGHT 1\nDATA ascii\n0 0 0 0\n" },
         { "b.pcd", pcd + "WIDTH " + many + "\nHEIGHT 1\nDATA binary\n0123456789abcdef" },
         { "c.pcd", pcd + "COUNT 1 1 1 " + many + "\nWIDTH 1\nHEIGHT 1\nDATA ascii\n0 0 0 0\n" },
         { "d.pcd", pcd + "COUNT 1 1 1 1000000000\nWIDTH 1\nHEIGHT 1\nDATA binary\n0123456789ab" },
         { "e.pcd",
           pcd + "WIDTH 100000000\nHEIGHT 1\nDATA binary_compressed\n" + bytesOf(std::uint32_t(3)) +
             bytesOf(std::uint32_t(1600000000)) + std::string("\1ab") },
         { "f.pcd", pcd + "WIDTH " + many + "\nHEIGHT " + many + "\nDATA ascii\n" },
         { "g.pcd",
           "FIELDS x y z _\nSIZE 4 4 4 0\nTYPE F F F F\nCOUNT 1 1 1 " + many +
             "\nWIDTH 1\nHEIGHT 1\nDATA binary\n0123456789ab" } })
  {
    EXPECT_NE(refusal(name, bytes), "") << name;
  }
}

// Promise: a header that does not fit together is told what is wrong with it.
TEST_F(DamagedFiles, HeadersThatMakeNoSense)
{
  const std::string pcd = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\n";
  const auto tells = [this](const std::string& name, const std::string& bytes, const char* words)
  {
    const std::string message = refusal(name, bytes);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  tells("a.pcd", "this is no header\n", "no line of a .pcd");
  tells("a.pcd", pcd, "header does not end");
  tells("a.pcd", pcd + "POINTS 2\nDATA ascii\n0 0 0\n", "WIDTH times HEIGHT");
  tells("a.pcd", pcd + "DATA packed\n", "neither ascii");
  tells("a.pcd", pcd + "DATA ascii\n0 x 0\n", "no number for y");
  tells("a.pcd", pcd + "VIEWPOINT 1 2\nDATA ascii\n0 0 0\n", "VIEWPOINT");
  tells("a.pcd", "FIELDS x y\nSIZE 4 4\nTYPE F F\nWIDTH 1\nDATA ascii\n0 0\n", "no z");
  tells("a.pcd", "FIELDS x y z\nSIZE 4 4\nTYPE F F F\nWIDTH 1\nDATA ascii\n", "of each field");
  tells("a.pcd", "FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nWIDTH 1\nDATA ascii\n", "type and size");
  tells("a.ptx", "", "no scan");
  tells("a.ptx", "1\n1 1\n", "columns or rows");
  tells("a.ptx", "1\n1\n0 0\n", "header of a .ptx");
  tells("a.ptx", "1\n1\n0 0 nan\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3\n",
    "not finite");
  tells("a.pwn", "# nothing\n", "no points");
  tells("a.pwn", "2\n1 2 3\n4 5 6\n0 0 1\n", "last normal");
  tells("a.pwn", "1 2 3\n", "point with its normal");
  tells("a.off", "this is text\n", "no numbers of points");
  tells("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n", "not exist");
  tells("a.stl", "this is no solid\n", "no .stl");
  tells("a.stl", "solid\nendloop\n", "three corners");
  tells("a.obj", std::string("\1\2\3\n"), "no .obj");
}

// Promise: what is no file is told.
TEST_F(DamagedFiles, NoFiles)
{
  std::filesystem::create_directory(pathOf("folder.ply"));
  EXPECT_THROW(readFile(pathOf("folder.ply")), std::runtime_error);
  EXPECT_THROW(readFile(pathOf("missing.ply")), std::runtime_error);
  EXPECT_THROW(readFile("/dev/null"), std::runtime_error);
}
}
