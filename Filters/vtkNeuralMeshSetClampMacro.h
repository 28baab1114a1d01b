// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkNeuralMeshSetClampMacro_h
#define vtkNeuralMeshSetClampMacro_h

#include "vtkSetGet.h"

#include <algorithm>
#include <cmath>

/**
 * Defines Set##name(), Get##name##MinValue() and Get##name##MaxValue() as vtkSetClampMacro() does,
 * but for a warning that names the property and its range when a value is out of range. NaN, which
 * no bound holds back, leaves the property as it is.
 */
#define vtkNeuralMeshSetClampMacro(name, type, min, max)                                           \
  virtual void Set##name(type value)                                                               \
  {                                                                                                \
    const bool isNumber = !std::isnan(static_cast<double>(value));                                 \
    const type clamped = isNumber ? std::clamp<type>(value, min, max) : this->name;                \
    if (!isNumber || clamped != value)                                                             \
    {                                                                                              \
      vtkWarningMacro(<< #name " must be from " << (min) << " to " << (max) << ": not " << value   \
                      << " but " << clamped << " is used.");                                       \
    }                                                                                              \
    if (this->name != clamped)                                                                     \
    {                                                                                              \
      this->name = clamped;                                                                        \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual type Get##name##MinValue() { return min; }                                               \
  virtual type Get##name##MaxValue() { return max; }

/**
 * The same where 0 is a value, too, and stands for something else than what is in the range; tells so by
 * Get##name##TakesZero().
 */
#define vtkNeuralMeshSetClampOrZeroMacro(name, type, min, max)                                     \
  virtual void Set##name(type value)                                                               \
  {                                                                                                \
    const type clamped = value == 0 ? 0 : std::clamp<type>(value, min, max);                       \
    if (clamped != value)                                                                          \
    {                                                                                              \
      vtkWarningMacro(<< #name " must be from " << (min) << " to " << (max) << ", or 0: not "      \
                      << value << " but " << clamped << " is used.");                              \
    }                                                                                              \
    if (this->name != clamped)                                                                     \
    {                                                                                              \
      this->name = clamped;                                                                        \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual type Get##name##MinValue() { return min; }                                               \
  virtual type Get##name##MaxValue() { return max; }                                               \
  virtual bool Get##name##TakesZero() { return true; }

#endif
