// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceInput
 * @brief   an input that is a surface, as samples with its point data, and as triangles to start from
 *
 * Internal to the module.
 */

#ifndef vtkSurfaceInput_h
#define vtkSurfaceInput_h

#include "mesh/SurfaceSamples.h"
#include "mesh/TriangleMesh.h"

#include "vtkNew.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class vtkDataObject;
class vtkMultiBlockDataSet;
class vtkPolyData;

class vtkSurfaceInput
{
public:
  /**
   * The surface is a vtkPolyData, or a composite dataset of them. Throws std::runtime_error, with the
   * reason, if it is no surface.
   */
  vtkSurfaceInput(vtkDataObject* data, std::size_t samples, std::uint64_t seed);

  /**
   * A block for each vtkPolyData, of points with normals and the point data: reals and colours are
   * interpolated, anything else is that of the corner that counts most.
   */
  vtkMultiBlockDataSet* GetSamples() const { return this->Samples; }
  /** An oriented 2-manifold, in double precision. */
  vtkPolyData* GetSurface() const { return this->Surface; }
  /** What must be known of the input, a sentence each. */
  const std::vector<std::string>& GetWarnings() const { return this->Warnings; }

private:
  struct Leaf
  {
    vtkPolyData* Data;
    std::size_t FirstPoint;
    std::size_t FirstTriangle;
  };

  void Collect(vtkDataObject* data);
  void FillSamples(const neuralmesh::SurfaceSamples& samples);

  neuralmesh::TriangleMesh Triangles;
  std::vector<Leaf> Leaves;
  vtkNew<vtkMultiBlockDataSet> Samples;
  vtkNew<vtkPolyData> Surface;
  std::vector<std::string> Warnings;
};

#endif
