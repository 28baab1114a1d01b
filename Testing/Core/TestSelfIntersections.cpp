// SPDX-License-Identifier: BSD-3-Clause
#include "IntersectionRepair.h"
#include "SelfIntersections.h"

#include "MeshBuilder.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"
#include "SurfaceReport.h"

#include <gtest/gtest.h>
