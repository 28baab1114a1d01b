// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointInputs_h
#define PointInputs_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPointSet;

/** What options say of the places that points were seen from. */
struct GivenViews
{
  int NumberOfViewpoints = 0; ///< 0: none are given, and those that files tell count
  std::string ArrayName;      ///< of the array that tells which; empty: none is named
};

/**
 * Reads files, as ReadPoints(), that are one cloud: the points one behind the other, with the point arrays
 * that all have, and doubles if one has. The viewpoints of all files are the field data `Viewpoints`, the
 * array `View` tells for each point which is its own, -1 where its file tells none
 * (neuralmesh::joinedViews()).
 *
 * Where viewpoints are given, those of files do not count. As many as there are files are one for each,
 * in order; an array that is named, or `View` where all files have one and no viewpoints of their own, stays
 * as it is. Otherwise no point is told apart. A single file with several scans is treated alike: as many
 * viewpoints as scans are one for each.
 *
 * Throws std::runtime_error, with a message that names the file.
 */
vtkSmartPointer<vtkPointSet> ReadInputs(
  const std::vector<std::string>& paths, const GivenViews& given);

#endif
