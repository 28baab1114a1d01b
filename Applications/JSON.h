// SPDX-License-Identifier: BSD-3-Clause
#ifndef JSON_h
#define JSON_h

/**
 * @file
 * nlohmann/json.hpp, of VTK or of the system. Headers of VTK after 9.3 include VTK's own copy, which
 * has the include guards of the other one and its namespace renamed by a macro: a source can have only one.
 */

#include "vtkAbstractArray.h"

#ifdef VTK_NLOHMANN_JSON
#include VTK_NLOHMANN_JSON(json.hpp)
#else
#include <nlohmann/json.hpp>
#endif

#endif
