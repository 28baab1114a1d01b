// SPDX-License-Identifier: BSD-3-Clause
#ifndef LearningParameters_h
#define LearningParameters_h

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

class vtkNeuralMesh;

/**
 * A parameter of vtkNeuralMesh that the command line sets by its name. Names, ranges and defaults
 * are those of the filter's properties.
 */
struct LearningParameter
{
  std::string Name;
  std::string Description; ///< a few words
  double Minimum;
  double Maximum;
  double Default;
  bool Integral;
  std::vector<std::string> Words; ///< for the values from 0 on; none for numbers
  std::function<void(vtkNeuralMesh*, double)> Set;
};

const std::vector<LearningParameter>& GetLearningParameters();

/** A wrong use of the command, for which it exits with status 2. */
struct UsageError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** Carries out an assignment NAME=VALUE. Throws UsageError, with the range or near names. */
void SetLearningParameter(vtkNeuralMesh* filter, const std::string& assignment);

/** A table of names, defaults and ranges. */
std::string DescribeLearningParameters();

#endif
