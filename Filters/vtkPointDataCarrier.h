// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointDataCarrier
 * @brief   the point data of a cloud, carried over to the mesh that was made of it
 *
 * Internal to the module. CarryPointData of vtkNeuralMesh describes which arrays arrive, and how.
 */

#ifndef vtkPointDataCarrier_h
#define vtkPointDataCarrier_h

#include "cloud/CloudPlaces.h"

#include "vtkType.h"

#include <cstdint>
#include <vector>

class vtkAbstractArray;
class vtkDataArray;
class vtkPointCloudCollector;
class vtkPointData;
class vtkPointSet;

class vtkPointDataCarrier
{
public:
  /** An array, in the point data of each leaf. */
  struct Array
  {
    std::vector<vtkAbstractArray*> OfLeaf;
    bool AreScalars; ///< the active ones
  };

  /** Finds the arrays that all leaves of the collector have; it must outlive the carrier. */
  explicit vtkPointDataCarrier(const vtkPointCloudCollector& collector);

  bool HasArrays() const { return !this->Arrays.empty(); }
  const std::vector<Array>& GetArrays() const { return this->Arrays; }

  /**
   * Adds the arrays to the point data of the mesh at whose vertices the places are. The cloud must
   * know the origins of its points. Returns false, with some of the arrays only, if it is ended
   * early.
   */
  bool Carry(const neuralmesh::CloudPlaces& places, vtkPointData* output,
    const neuralmesh::Executor& executor, const neuralmesh::Progress& progress) const;

private:
  /** A tuple of an array, that of a point. */
  struct Tuple
  {
    vtkAbstractArray* Array;
    vtkIdType Id;
  };

  void FindArray(vtkPointData* first, vtkAbstractArray* array);
  Tuple TupleOf(const Array& array, std::size_t point) const;
  void Fit(const Array& array, const neuralmesh::CloudPlaces& places,
    const neuralmesh::Executor& executor, vtkDataArray* result) const;
  void Vote(
    const Array& array, const neuralmesh::CloudPlaces& places, vtkAbstractArray* result) const;

  const vtkPointCloudCollector& Collector;
  std::vector<Array> Arrays;
};

#endif
