// SPDX-License-Identifier: BSD-3-Clause
#include "file/ReadFile.h"

#include "base/OneLine.h"
#include "file/FileExtension.h"
#include "file/ObjFile.h"
#include "file/OffFile.h"
#include "file/PcdFile.h"
#include "file/PlyFile.h"
#include "file/PointText.h"
#include "file/PtxFile.h"
#include "file/PwnFile.h"
#include "file/StlFile.h"

#include <map>
#include <new>
#include <stdexcept>

namespace neuralmesh
{
namespace
{
using Decode = FileContents (*)(const std::string&);

const std::map<std::string, Decode>& decoders()
{
  static const std::map<std::string, Decode> all{ { ".ply", readPly }, { ".stl", readStl },
    { ".obj", readObj }, { ".off", readOff }, { ".pcd", readPcd }, { ".pwn", readPwn },
    { ".ptx", readPtx }, { ".xyz", readPointText }, { ".pts", readPointText },
    { ".txt", readPointText }, { ".csv", readPointText }, { ".asc", readPointText } };
  return all;
}

void requireRegularFile(const std::string& path)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
  {
    throw std::runtime_error(path + ": there is no such file");
  }
  if (!std::filesystem::is_regular_file(status))
  {
    throw std::runtime_error(path + ": this is " +
      (std::filesystem::is_directory(status) ? "a folder" : "no regular file"));
  }
}

/// What a shell takes for one word.
std::string shellWord(const std::string& path)
{
  std::string word = "'";
  for (const char c : path)
  {
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return word + "'";
}
}

FileContents readFile(const std::string& path)
{
  requireRegularFile(path);
  const auto decode = decoders().find(fileExtension(path));
  if (decode == decoders().end())
  {
    const std::string conversion = conversionOf(path);
    throw std::runtime_error(path + ": " +
      (conversion.empty() ? "unknown extension; readable are .ply .stl .obj .off .pcd .pwn .ptx "
                            ".xyz .pts .txt .csv .asc"
                          : conversion));
  }
  try
  {
    FileContents contents = decode->second(path);
    if (contents.shift && !contents.shift->isZero(0.))
    {
      contents.move(*contents.shift);
    }
    return contents;
  }
  catch (const std::bad_alloc&)
  {
    throw std::runtime_error(path + ": there is too little memory for it");
  }
  catch (const std::length_error&)
  {
    throw std::runtime_error(path + ": there is too little memory for it");
  }
  catch (const std::runtime_error& error)
  {
    const std::string message = error.what();
    throw std::runtime_error(message.starts_with(path) ? message : path + ": " + oneLine(message));
  }
}

bool canReadFile(const std::string& path) { return decoders().contains(fileExtension(path)); }

std::string conversionOf(const std::string& path)
{
  const std::string extension = fileExtension(path);
  std::string stem = path;
  stem.resize(stem.size() - std::min(extension.size(), stem.size()));
  const std::string install = " files are read by Python; pip install 'neuralmesh[lidar]', then ";
  if (extension == ".las" || extension == ".laz")
  {
    return extension + install +
      "python3 -c \"import sys, laspy, numpy; "
      "numpy.savetxt(sys.argv[2], laspy.read(sys.argv[1]).xyz, '%.6f')\" " +
      shellWord(path) + " " + shellWord(stem + ".xyz");
  }
  if (extension == ".e57")
  {
    // A file for each scan, and one of the places of the scanner, as --views takes them.
    return extension + install +
      "python3 -c \"import sys, pye57, numpy; e = pye57.E57(sys.argv[1]); "
      "n = range(e.scan_count); "
      "numpy.savetxt(sys.argv[2] + '-views.xyz', [e.scan_position(i)[0] for i in n], '%.6f'); "
      "[numpy.savetxt(f'{sys.argv[2]}-{i}.xyz', numpy.stack([s['cartesian' + a] for a in 'XYZ'], "
      "1), '%.6f') for i in n for s in [e.read_scan(i, ignore_missing_fields=True)]]\" " +
      shellWord(path) + " " + shellWord(stem);
  }
  if (extension == ".gz" || extension == ".bz2" || extension == ".xz" || extension == ".zip" ||
    extension == ".7z")
  {
    return "unpack it first: " + extension + " files are packed";
  }
  if (extension == ".npy")
  {
    return extension + " files are read by Python: neuralmesh.reconstruct(numpy.load(" +
      shellWord(path) + ")); or save text by numpy.savetxt";
  }
  return "";
}
}
