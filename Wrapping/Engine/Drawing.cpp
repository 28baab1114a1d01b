// SPDX-License-Identifier: BSD-3-Clause
#include "Drawing.h"

#include "Arrays.h"

#include "base/PhaseTimes.h"
#include "cloud/PointFile.h"

#include <algorithm>
#include <stdexcept>

namespace nb = nanobind;

namespace neuralmesh::binding
{
namespace
{
struct Drawn
{
  std::vector<float> floats; ///< coordinates, as the file has them
  std::vector<double> doubles;
  std::vector<std::uint8_t> colors;
  std::vector<float> normals;
};
}

nb::object drawPoints(
  const std::string& path, const RawFile& raw, std::uint64_t wanted, std::uint64_t seed, Call& call)
{
  PhaseTimes times;
  times.enter(Phase::Drawing);
  Drawn drawn;
  PointLayout layout;
  bool isDone = false;
  try
  {
    const nb::gil_scoped_release unlocked;
    const PointFile file =
      raw.numbers.empty() ? PointFile(path) : PointFile(path, raw.numbers == "double", raw.skip);
    layout = file.layout();
    const auto count = std::size_t(std::min(wanted, layout.count));
    layout.isDouble ? drawn.doubles.reserve(3 * count) : drawn.floats.reserve(3 * count);
    isDone = file.draw(
      wanted, seed,
      [&](const PointFile::Point& point)
      {
        for (const double coordinate : point.position)
        {
          layout.isDouble ? drawn.doubles.push_back(coordinate)
                          : drawn.floats.push_back(float(coordinate));
        }
        if (layout.color)
        {
          drawn.colors.insert(drawn.colors.end(), point.color.begin(), point.color.end());
        }
        if (layout.normal)
        {
          for (const double coordinate : point.normal)
          {
            drawn.normals.push_back(float(coordinate));
          }
        }
      },
      call.part(0., 1.));
  }
  catch (const std::runtime_error& error)
  {
    throw std::invalid_argument(error.what());
  }
  times.leave();
  if (!isDone)
  {
    return nb::none();
  }
  nb::dict result;
  result["points"] =
    layout.isDouble ? arrayOf(std::move(drawn.doubles), 3) : arrayOf(std::move(drawn.floats), 3);
  if (layout.color)
  {
    result["RGB"] = arrayOf(std::move(drawn.colors), 3);
  }
  if (layout.normal)
  {
    result["normals"] = arrayOf(std::move(drawn.normals), 3);
  }
  result["file_points"] = layout.count;
  result["seconds"] = times.seconds(Phase::Drawing);
  return result;
}
}
