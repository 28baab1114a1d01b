// SPDX-License-Identifier: BSD-3-Clause
#include "file/WriteMesh.h"

#include "FileFolder.h"

#include <cmath>
#include <limits>

namespace neuralmesh::testing
{
namespace
{
using MeshFiles = FileFolder;

void expectSamePoints(const FileContents& one, const FileContents& other, double tolerance)
{
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    EXPECT_LE((one.points()[i] - other.points()[i]).cwiseAbs().maxCoeff(), tolerance) << i;
  }
}
}

// Promise: what is written is read back, in each format with what that holds: all digits or those of
// floats, triangles, normals, colours; and no other file stays behind.
TEST_F(MeshFiles, ComeBackAsWritten)
{
  const FileContents mesh = tetrahedronContents();
  struct Format
  {
    std::string name;
    double tolerance;
    bool hasTriangles, hasNormals, hasColors;
  };
  for (const auto& [name, tolerance, hasTriangles, hasNormals, hasColors] :
    { Format{ "a.ply", 1e-6, true, true, true }, { "a.OBJ", 0., true, true, false },
      { "a.off", 0., true, false, true }, { "a.stl", 1e-6, true, false, false },
      { "a.xyz", 0., false, false, false } })
  {
    SCOPED_TRACE(name);
    EXPECT_TRUE(writeMesh(pathOf(name), mesh).isZero(0.));
    const FileContents read = readFile(pathOf(name));
    EXPECT_EQ(read.triangles.size(), hasTriangles ? mesh.triangles.size() : 0u);
    if (name != "a.stl") // in the order of its triangles
    {
      expectSamePoints(read, mesh, tolerance);
      EXPECT_EQ(read.triangles, hasTriangles ? mesh.triangles : decltype(mesh.triangles)());
    }
    EXPECT_EQ(read.size(), mesh.size());
    EXPECT_EQ(read.normals, hasNormals ? mesh.normals : decltype(mesh.normals)());
    EXPECT_EQ(read.colors, hasColors ? mesh.colors : decltype(mesh.colors)());
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 5);
}

// Promise: a mesh that floats cannot hold keeps its digits where the format has them, is refused where
// it has not, leaving what was there; with a shift each format takes it, notes it, and has it undone.
TEST_F(MeshFiles, FarFromTheOrigin)
{
  FileContents mesh = tetrahedronContents();
  mesh.move({ 500000., 5400000., 0. });
  for (const char* name : { "a.ply", "a.obj", "a.off", "a.xyz" })
  {
    writeMesh(pathOf(name), mesh);
    expectSamePoints(readFile(pathOf(name)), mesh, 0.);
  }
  for (const char* name : { "a.stl", "a.glb" })
  {
    std::ofstream(pathOf(name)) << "what was there";
    EXPECT_THROW(writeMesh(pathOf(name), mesh), std::runtime_error);
    EXPECT_EQ(bytesOfFile(name), "what was there");
  }
  WritingOptions options;
  options.isShiftAutomatic = true;
  for (const char* name : { "a.ply", "a.obj", "a.off", "a.xyz", "a.stl", "a.glb" })
  {
    SCOPED_TRACE(name);
    EXPECT_EQ(writeMesh(pathOf(name), mesh, options), Eigen::Vector3d(500000., 5400000., 0.));
    EXPECT_NE(bytesOfFile(name).find("shift"), std::string::npos);
    if (std::string(name) == "a.glb")
    {
      continue; // is not read
    }
    const FileContents read = readFile(pathOf(name));
    EXPECT_EQ(read.size(), 4u);
    ASSERT_TRUE(read.shift);
    EXPECT_EQ((*read.shift)[1], 5400000.);
    EXPECT_GT(read.points()[0][1], 5400000.);
  }
  EXPECT_NE(bytesOfFile("a.ply").find("property float x"), std::string::npos);
  // Nothing to gain, so nothing is shifted.
  EXPECT_TRUE(writeMesh(pathOf("near.ply"), tetrahedronContents(), options).isZero(0.));
}

// Promise: what cannot be written is an error that leaves no file.
TEST_F(MeshFiles, RefuseWhatIsNoMesh)
{
  FileContents corner = tetrahedronContents(), normals = tetrahedronContents(),
               infinite = tetrahedronContents();
  corner.triangles.push_back({ 0, 1, 4 });
  normals.normals.pop_back();
  infinite.doubles[4] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(writeMesh(pathOf("a.ply"), {}), std::runtime_error);
  EXPECT_THROW(writeMesh(pathOf("a.ply"), corner), std::runtime_error);
  EXPECT_THROW(writeMesh(pathOf("a.ply"), normals), std::runtime_error);
  EXPECT_THROW(writeMesh(pathOf("a.glb"), infinite), std::runtime_error);
  EXPECT_THROW(writeMesh(pathOf("a.doc"), tetrahedronContents()), std::runtime_error);
  EXPECT_THROW(writeMesh(pathOf("nowhere/a.ply"), tetrahedronContents()), std::runtime_error);
  WritingOptions options;
  options.shift[0] = std::nan("");
  EXPECT_THROW(writeMesh(pathOf("a.ply"), tetrahedronContents(), options), std::runtime_error);
  options.shift[0] = 1e100;
  EXPECT_THROW(writeMesh(pathOf("a.stl"), tetrahedronContents(), options), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

// Promise: .off is read with counts in either line, comments, colours of bytes or of parts, and normals;
// polygons are fans, pairs none.
TEST_F(MeshFiles, OffInItsForms)
{
  const FileContents plain = contentsOf("a.off",
    "# shift 1 0 0\nOFF # a comment\n\n5 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n\n5 5 5\n"
    "4 0 1 2 3\n2 0 1\n3 1 2 4 255 0 0\n");
  EXPECT_EQ(plain.size(), 5u);
  EXPECT_EQ(plain.doubles[0], 1.);
  EXPECT_EQ(plain.triangles,
    (std::vector<std::array<std::uint32_t, 3>>{ { 0, 1, 2 }, { 0, 2, 3 }, { 1, 2, 4 } }));
  const FileContents bytes = contentsOf("b.off", "COFF 1 0 0\n1 2 3 255 128 0 255\n");
  EXPECT_EQ(bytes.colors[0], (std::array<std::uint8_t, 3>{ 255, 128, 0 }));
  const FileContents parts = contentsOf("c.off", "STCNOFF\n1 0 0\n1 2 3 0 0 1 1.0 0.5 0.0 1 0 0\n");
  EXPECT_EQ(parts.colors[0], (std::array<std::uint8_t, 3>{ 255, 128, 0 }));
  EXPECT_EQ(parts.normals[0], Eigen::Vector3f(0.f, 0.f, 1.f));
  EXPECT_EQ(contentsOf("d.off", "1 0 0\n1 2 3\n").size(), 1u);
  EXPECT_NE(refusal("e.off", "4OFF\n1 0 0\n1 2 3 4\n").find("kind of .off"), std::string::npos);
  EXPECT_NE(refusal("f.off", "OFF BINARY\n").find("binary"), std::string::npos);
}

// Promise: .obj has polygons with or without normals and textures, backwards too, lines that go on, and
// colours; a corner that is not there is an error with its line.
TEST_F(MeshFiles, ObjInItsForms)
{
  const FileContents contents = contentsOf("a.obj",
    "# made by hand\nmtllib \xc3\xa4.mtl\nv 0 0 0 1 0 0.5\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\n"
    "v 0 1 0 1 0 0\nvt 0 0\nvn 0 0 1\nvn 0 1 0\nf 1/1/1 2//1 \\\n 3//2 -1/1/1 # a comment\n");
  EXPECT_EQ(
    contents.triangles, (std::vector<std::array<std::uint32_t, 3>>{ { 0, 1, 2 }, { 0, 2, 3 } }));
  EXPECT_EQ(contents.colors[0], (std::array<std::uint8_t, 3>{ 255, 0, 128 }));
  ASSERT_EQ(contents.normals.size(), 4u);
  EXPECT_EQ(contents.normals[2], Eigen::Vector3f(0.f, 1.f, 0.f));
  EXPECT_NE(refusal("b.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n").find("line 3"), std::string::npos);
  EXPECT_NE(refusal("c.obj", "v 0 0 0\nf 1 1 -2\n").find("not exist"), std::string::npos);
  EXPECT_NE(refusal("d.obj", "v 0 0\n").find("line 1"), std::string::npos);
}

// Promise: .stl of text is read as well, equal corners are one point, and a triangle without area by
// that is left out.
TEST_F(MeshFiles, StlMergesCorners)
{
  std::string text = "solid a b\n";
  for (const char* corners : { "0 0 0/1 0 0/0 1 0", "0 1 0/1 0 0/1 1 0.1", "-0 0 0/0 0 0/1 0 0" })
  {
    text += "facet normal 0 0 1\n outer loop\n";
    std::istringstream lines(corners);
    for (std::string line; std::getline(lines, line, '/');)
    {
      text += "  VERTEX " + line + "\n";
    }
    text += " endloop\nendfacet\n";
  }
  const FileContents contents = contentsOf("a.stl", text + "endsolid a b\n");
  EXPECT_EQ(contents.size(), 4u);
  EXPECT_EQ(
    contents.triangles, (std::vector<std::array<std::uint32_t, 3>>{ { 0, 1, 2 }, { 2, 1, 3 } }));
  EXPECT_EQ(contents.doubles[11], 0.1);
}

// Promise: a .ply of either order of bytes or text has the same mesh; further numbers are arrays,
// colours may be parts of one, and faces may stand before their points.
TEST_F(MeshFiles, PlyInItsForms)
{
  const FileContents contents = contentsOf("a.ply",
    "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\n"
    "element vertex 4\nproperty double x\nproperty double y\nproperty float intensity\n"
    "property double z\nproperty float red\nproperty float green\nproperty float blue\n"
    "end_header\n4 0 1 2 3\n0 0 0.5 0 1 0 0.5\n1 0 1 0 1 0 0.5\n1 1 1 0 1 0 0.5\n"
    "0 1 1 7.125 1 0 0.5\n");
  EXPECT_EQ(contents.doubles[11], 7.125);
  EXPECT_EQ(contents.triangles.size(), 2u);
  EXPECT_EQ(contents.colors[0], (std::array<std::uint8_t, 3>{ 255, 0, 128 }));
  ASSERT_EQ(contents.arrays.size(), 1u);
  EXPECT_EQ(contents.arrays[0].name, "intensity");
  EXPECT_EQ(contents.arrays[0].values[0], 0.5);
}

// Promise: normals of an .stl are those of its triangles, and its size is what its number of triangles
// says.
TEST_F(MeshFiles, StlIsWhole)
{
  writeMesh(pathOf("a.stl"), tetrahedronContents());
  EXPECT_EQ(bytesOfFile("a.stl").size(), 84u + 4 * 50);
}
}
