// SPDX-License-Identifier: BSD-3-Clause
#include "ManifoldCheck.h"
#include "Mesh.h"

#include <gtest/gtest.h>
