// SPDX-License-Identifier: BSD-3-Clause
#include "FileFolder.h"

#include <vector>

namespace neuralmesh::testing
{
namespace
{
using PointText = FileFolder;

const std::vector<double> TwoPoints{ 1.25, 2.5, 3.75, -4, 5.5, 6 };

// Promise: names of columns tell which are x, y and z, wherever these stand, in the words that programs
// have for them, and whatever sets them apart.
TEST_F(PointText, NamesTellTheColumns)
{
  const std::vector<std::string> texts{
    "x,y,z\n1.25,2.5,3.75\n-4,5.5,6\n",
    "z,y,x\n3.75,2.5,1.25\n6,5.5,-4\n",
    "id,x,y,z\n7,1.25,2.5,3.75\n8,-4,5.5,6\n",
    "r,g,b,x,y,z\n1,2,3,1.25,2.5,3.75\n4,5,6,-4,5.5,6\n",
    "\"x\";\"y\";\"z\"\n1.25;2.5;3.75\n-4;5.5;6\n",
    "\"y\",\"x\",\"z\"\n\"2.5\",\"1.25\",\"3.75\"\n5.5,-4,6\n",
    "Intensity Z Y X\n9 3.75 2.5 1.25\n9 6 5.5 -4\n",
    "//Z Y X R G B\n3.75 2.5 1.25 1 2 3\n6 5.5 -4 1 2 3\n",
    "# z y x\n3.75 2.5 1.25\n6 5.5 -4\n",
    "//X,Z,Y\n1.25,3.75,2.5\n-4,6,5.5\n",
    "Area,Points:2,Points:1,Points:0\n1,3.75,2.5,1.25\n1,6,5.5,-4\n",
    "\"Points_2\"\t\"Points_1\"\t\"Points_0\"\n3.75\t2.5\t1.25\n6\t5.5\t-4\n",
    "Name;Z [m];Y [m];X (m)\nThe wall, left;3.75;2.5;1.25\n;6;5.5;-4\n",
    "name,z,y,x\n\"wall, left\",3.75,2.5,1.25\n\"a \"\"b\"\"\",6,5.5,-4\n",
    "a scan of a wall\nz y x\nm m m\n3.75 2.5 1.25\n6 5.5 -4\n",
    "Wall\nunits: mm\nStation 7\n2\nz y x\n3.75 2.5 1.25\n6 5.5 -4\n",
    "empty,z,y,x,empty\n,3.75,2.5,1.25,\n,6,5.5,-4,\n",
    "z;y;x\n3.75 2.5 1.25\n6 5.5 -4\n",
    "2\nz y x\n3.75 2.5 1.25 // a comment\n6 5.5 -4\n",
  };
  for (const std::string& text : texts)
  {
    const FileContents contents = contentsOf("a.csv", text);
    EXPECT_EQ(contents.doubles, TwoPoints) << text;
    EXPECT_EQ(contents.remark, "") << text;
    EXPECT_TRUE(contents.normals.empty()) << text;
  }
}

// Promise: names of normals tell these; where a line has none, it tells nothing.
TEST_F(PointText, NamesTellTheNormals)
{
  for (const char* names : { "nx ny nz x y z", "Normals:0,Normals:1,Normals:2,X,Y,Z",
         "\"NX\";\"NY\";\"NZ\";\"X\";\"Y\";\"Z\"", "//Normal_x Normal_y Normal_z X Y Z" })
  {
    const FileContents contents =
      contentsOf("a.asc", std::string(names) + "\n0 0 1 1.25 2.5 3.75\n- 1 0 -4 5.5 6\n");
    EXPECT_EQ(contents.doubles, TwoPoints) << names;
    ASSERT_EQ(contents.normals.size(), 2u) << names;
    EXPECT_EQ(contents.normals[0], Eigen::Vector3f(0, 0, 1)) << names;
    EXPECT_EQ(contents.normals[1], Eigen::Vector3f(0, 0, 0)) << names;
  }
}

// Promise: without names, or with others, the coordinates come first, and of the others there is a
// remark; a comment that speaks of x, y and z names nothing, unless there are as many columns.
TEST_F(PointText, CoordinatesComeFirst)
{
  const std::string points = "1.25 2.5 3.75 9 9\n-4 5.5 6 9 9\n";
  for (const char* begin :
    { "", "2\n", "# z y x of the wall, in metres\n", "// z y x\n", "Wall\nunits: mm\n" })
  {
    const FileContents contents = contentsOf("a.txt", begin + points);
    EXPECT_EQ(contents.doubles, TwoPoints) << begin;
    EXPECT_EQ(contents.remark, "") << begin;
  }
  for (const char* names : { "Easting Northing Height Red Green\n", "x y w u v\n" })
  {
    const FileContents contents = contentsOf("a.txt", names + points);
    EXPECT_EQ(contents.doubles, TwoPoints) << names;
    EXPECT_NE(contents.remark.find("no columns are named x, y and z"), std::string::npos) << names;
  }
}

// Promise: more values than names are refused, as nothing tells which of them has no name; fewer are
// none the worse, if the coordinates are there.
TEST_F(PointText, ValuesWithoutNames)
{
  EXPECT_NE(
    refusal("a.csv", "x,y,z\n1,0.5,0.5,0.5\n").find("4 values, but 3 names"), std::string::npos);
  EXPECT_NE(
    refusal("a.csv", "x,y,z\n1,25,2,5,3,75\n").find("6 values, but 3 names"), std::string::npos);
  EXPECT_NE(
    refusal("a.csv", "id,x,y,z\n1,,2,3\n").find("line 2: this is not a point"), std::string::npos);
  EXPECT_EQ(contentsOf("a.csv", "x,y,z,id\n1.25,2.5,3.75\n-4,5.5,6,\n").doubles, TwoPoints);
}

// Promise: text of other systems, which would be read as other points or as none, is refused with a cure,
// and a count of points that is too high is told with the one that is right.
TEST_F(PointText, RefusalsSayWhatToDo)
{
  const std::string wide("\xFF\xFE"
                         "1\0 \0"
                         "2\0 \0"
                         "3\0\n\0",
    14);
  EXPECT_NE(refusal("a.csv", wide).find("save it as text in UTF-8"), std::string::npos);
  EXPECT_NE(refusal("a.csv", "1 2 3\r4 5 6\r").find("save it with LF"), std::string::npos);
  EXPECT_EQ(contentsOf("a.csv", "\r\n1.25 2.5 3.75\r \n-4 5.5 6\r\r\n").doubles, TwoPoints);
  const std::string fewer = refusal("a.pts", "3\n1 2 3\n4 5 6\n");
  EXPECT_NE(fewer.find("3 are announced, and 2 are there"), std::string::npos) << fewer;
  EXPECT_NE(refusal("a.pts", "1000000\n1 2 3\n").find("1000000 are announced"), std::string::npos);
}

// Promise: decimal commas are read as such where something else sets numbers apart.
TEST_F(PointText, DecimalCommas)
{
  for (const char* text :
    { "1,25;2,50;3,75\n-4;5,5;6\n", "1,25 2,5 3,75\n-4 5,5 6\n", "1,25\t2,5\t3,75\n-4\t5,5\t6\r\n",
      "1,25; 2,5; 3,75; 1,2,3\n-4; 5,5; 6; 1,2,3\n", "z;y;x\n3,75;2,5;1,25\n6;5,5;-4\n",
      "\"1,25\";\"2,5\";\"3,75\"\n-4;5,5;6\n", "x,y,z\n\"1,25\",\"2,5\",\"3,75\"\n-4,\"5,5\",6\n",
      "X Y Z\n1,25e0 2,5 3,75\n-4 5,5 6\n", "-4 5,5 6\n1,25 2,5 3,75" })
  {
    const FileContents contents = contentsOf("a.txt", text);
    const bool isTurned = std::string_view(text).starts_with('-');
    EXPECT_EQ(
      contents.doubles, isTurned ? (std::vector<double>{ -4, 5.5, 6, 1.25, 2.5, 3.75 }) : TwoPoints)
      << text;
  }
}

// Promise: commas between numbers stay what they were, with blanks beside them or words behind them.
TEST_F(PointText, CommasBetweenNumbers)
{
  for (const char* text : { "1.25,2.5,3.75\n-4,5.5,6\n", "1.25, 2.5,3.75\n-4, 5.5,6\n",
         "1.25,2.5,3.75 100,200\n-4,5.5,6 100,200\n", "1.25 2.5 3.75 100,200,255\n-4 5.5 6 1,2,3\n",
         "1.25,2.5,3.75;1\n-4,5.5,6;0\n" })
  {
    EXPECT_EQ(contentsOf("a.csv", text).doubles, TwoPoints) << text;
  }
  const std::vector<double> integers{ 1, 2, 3, 10, 0, 5 };
  EXPECT_EQ(contentsOf("a.csv", "1,2,3\n10,0,5\n").doubles, integers);
}

// Promise: what may be meant in two ways is refused, with the line, and never read as one of them.
TEST_F(PointText, UnclearCommasAreRefused)
{
  for (const char* text : { "1.234,5 2.345,6 3.456,7\n", "1,234.5 2,345.6 3,456.7\n",
         "1,234,567.5 2,345,678.5 3,456,789\n", "1,05,2,50,3,75\n", "1,25 2.5 3,75\n",
         "1.234,5;2;3\n" })
  {
    const std::string message = refusal("a.txt", "# a scan\n" + std::string(text));
    EXPECT_NE(message.find("line 2: its commas may be in numbers"), std::string::npos)
      << text << message;
  }
  const std::string message = refusal("a.txt", "1,25 2,5 3,75\n1.25 2.5 3.75\n");
  EXPECT_NE(message.find("line 2: its commas may be in numbers"), std::string::npos) << message;
  EXPECT_NE(refusal("a.txt", "1,25 2,5\n").find("line 1: this is not a point"), std::string::npos);
}

// Promise: a line that a file ends in is told with names of columns as without.
TEST_F(PointText, EndsInTheMiddle)
{
  for (const char* text : { "z,y,x,id\n1,2,3,4\n5,6,7", "1,5 2 3 4\n1,5 2 3", "z;y;x\n1;2;3\n1;2" })
  {
    EXPECT_NE(refusal("a.csv", text).find("line "), std::string::npos) << text;
  }
  EXPECT_EQ(contentsOf("a.csv", "z,y,x\n1,2,3\n5,6,7").size(), 2u);
}
}
}
