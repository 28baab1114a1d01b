// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkInnerAlgorithm
 * @brief   runs an algorithm within another one
 *
 * Internal to the module.
 */

#ifndef vtkInnerAlgorithm_h
#define vtkInnerAlgorithm_h

class vtkAlgorithm;

class vtkInnerAlgorithm
{
public:
  /**
   * Updates the algorithm. Throws std::runtime_error, with the first thing that it says to be wrong,
   * if it fails; nothing is printed.
   */
  static void Update(vtkAlgorithm* algorithm);
};

#endif
