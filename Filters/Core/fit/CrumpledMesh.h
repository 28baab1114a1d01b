// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Makes a mesh smooth that is crumpled (see Crumples.h), as it was learnt with edges much shorter than the noise. A
/// closed one stays as it is if the noise is about as wide as the body: smoothing would shrink that, and points all over
/// a space have no surface. No vertex may be erased.
void smoothCrumpledMesh(Mesh& mesh, const PointCloud& cloud, const Executor& executor);
}
