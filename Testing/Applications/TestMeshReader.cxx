// SPDX-License-Identifier: BSD-3-Clause
#include "FileTest.h"
#include "MeshReader.h"

#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{
using MeshReader = FileTest;

const std::string FlatCorner = "facet normal 0 0 1\nouter loop\n";

// Promise: triangles of .stl that meet share their points.
TEST_F(MeshReader, MergesCornersOfSTL)
{
  const auto mesh = ReadMesh(this->WriteText("a.stl",
    "solid\n" + FlatCorner + "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n" +
      FlatCorner + "vertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"));
  EXPECT_EQ(mesh->GetNumberOfPoints(), 4);
  EXPECT_EQ(mesh->GetNumberOfPolys(), 2);
}

// Promise: an .obj does not fall to pieces where its texture has seams.
TEST_F(MeshReader, MergesSeamsOfOBJ)
{
  const auto mesh = ReadMesh(this->WriteText("a.obj",
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
    "f 1/1 2/2 3/3\nf 2/4 4/1 3/2\n"));
  EXPECT_EQ(mesh->GetNumberOfPoints(), 4);
  EXPECT_EQ(mesh->GetNumberOfPolys(), 2);
}

// Promise: points without triangles and files of points are no meshes.
TEST_F(MeshReader, WantsTriangles)
{
  EXPECT_THROW(
    ReadMesh(this->WriteText("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")), std::runtime_error);
  EXPECT_THROW(ReadMesh(this->WriteText("a.xyz", "0 0 0\n1 0 0\n0 1 0\n")), std::runtime_error);
  EXPECT_THROW(ReadMesh(this->Path("missing.ply")), std::runtime_error);
}
}
