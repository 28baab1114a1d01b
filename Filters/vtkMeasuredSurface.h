// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeasuredSurface
 * @brief   one of the two surfaces of a comparison: its mesh, and the samples on it
 *
 * Internal to the module.
 */

#ifndef vtkMeasuredSurface_h
#define vtkMeasuredSurface_h

#include "base/Random.h"
#include "mesh/SurfaceSampler.h"
#include "mesh/TriangleMesh.h"

#include "vtkNew.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

class vtkPolyData;

class vtkMeasuredSurface
{
public:
  using Sample = neuralmesh::SurfaceSampler::Sample;

  /** Triangles with corners that are not finite are left out. */
  explicit vtkMeasuredSurface(vtkPolyData* data);

  /** Of the triangles, not of unused points. */
  Eigen::AlignedBox3d GetBox() const;

  /**
   * Makes `center` the origin and `unit` the unit. Only then is there an area to ask for: squares
   * of lengths neither overflow nor vanish.
   */
  void Transform(const Eigen::Vector3d& center, double unit);

  bool HasArea() const { return !this->Mesh.triangles.empty(); }

  void Draw(std::size_t count, neuralmesh::Random& random);

  /** The triangles, and as points the vertices, then the samples. */
  vtkNew<vtkPolyData> MakePolyData() const;

  const neuralmesh::TriangleMesh& GetMesh() const { return this->Mesh; }
  const std::vector<Sample>& GetSamples() const { return this->Samples; }

  /** Of a triangle of the mesh; its length is twice the area. */
  Eigen::Vector3d GetNormal(const std::array<std::uint32_t, 3>& triangle) const;

private:
  neuralmesh::TriangleMesh Mesh;
  std::vector<Sample> Samples;
};

#endif
