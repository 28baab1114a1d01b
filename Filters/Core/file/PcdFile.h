// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// Reads a .pcd of the Point Cloud Library: text, binary, or compressed. Points stay where the file has
/// them: its VIEWPOINT tells where the sensor was, in their coordinates, and moves nothing. That of
/// `0 0 0 1 0 0 0` is what programs write which know none: it tells nothing. The rows and columns of a
/// depth image show where its camera was, see cameraOf(): that counts more. Fields normal_x, normal_y and
/// normal_z are normals, rgb or rgba is the colour; others are arrays of their name.
/// Throws std::runtime_error, with the name of the file, if it is none, damaged, or ends early.
FileContents readPcd(const std::string& path);
}
