// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// The bytes of a binary glTF 2.0 (.glb): a mesh of triangles, or points where there are none, with
/// unit normals and colours if there are. Coordinates are floats and stay as they are: glTF takes y for
/// up, of which a scan tells nothing. Colours are taken for sRGB and written as glTF has them, linear, of
/// 16 bits. A normal without a direction is (0, 0, 1). The material is matt, and seen from both
/// sides. A shift is `asset.extras.shift`. Throws std::runtime_error, without the name of a file, if a
/// coordinate is not finite as a float, or it would be larger than 4 GiB.
std::string glbOf(const FileContents& contents);
}
