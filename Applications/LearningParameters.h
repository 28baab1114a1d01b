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
  std::string Default;
  std::string Range;              ///< "0 to 1", "from 0 on", "exact or list"
  std::vector<std::string> Words; ///< for the values from 0 on; none for numbers
  /** Throws UsageError, with the range, for a text that is none of the values. */
  std::function<void(vtkNeuralMesh*, const std::string& text)> Set;
};

const std::vector<LearningParameter>& GetLearningParameters();

/** A wrong use of the command, for which it exits with status 2. */
struct UsageError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** Carries out an assignment NAME=VALUE. Throws UsageError, with the range or near names. */
void SetLearningParameter(vtkNeuralMesh* filter, const std::string& assignment);

/** What a parameter is set to in the beginning. */
const std::string& LearningDefault(const std::string& name);

/** A table of names, defaults and ranges. */
std::string DescribeLearningParameters();

#endif
