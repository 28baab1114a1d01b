// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshStream
 * @brief   a mesh that is learnt while points arrive, from a scanner, say
 *
 * vtkNeuralMeshStream is a source of the mesh that AddPoints() and Learn() have made so far. The two
 * are called as often as anybody likes, in any order; the output is that of the moment of the
 * update, and the stream goes on afterwards.
 *
 * @par Memory
 * Samples are drawn from a reservoir of ReservoirSize points: each point that has come is in it with
 * the same chance (Vitter's Algorithm R), however many come. A point of it takes 24 bytes, and about
 * a hundred more while Learn() takes new points in; this is the bound, with that of the mesh.
 *
 * @par How the mesh follows
 * Learn() takes in what has come since the last one, which takes time in proportion to the
 * reservoir: so add points in large pieces. Where points come that the mesh does not reach (2 % of
 * the space that the reservoir occupies), or twice as many as it was begun with, it is begun anew
 * from that space: nothing else tells handles, pieces and openings. Else it goes on. It grows up to
 * NumberOfVertices (half as many as points in the reservoir, at most), with about 60 samples a vertex;
 * then vertices wander, the laziest to where the mesh is busiest.
 *
 * @par Output
 * vtkPolyData with triangles, an oriented 2-manifold as vtkNeuralMesh makes it, in double precision;
 * empty as long as there are fewer than 100 points, or nothing was learnt. With FinishOutput it is
 * fitted to the reservoir, and has exactly NumberOfVertices vertices if it had grown to all. Point
 * data: `Normals`, `Activity`. Field data, one value each: `NumberOfVertices`, `Iterations`, `Points`
 * (that came and are finite), `DroppedPoints`, `Beginnings`; and with FinishOutput `Residual`, `Noise`,
 * `OutlierShare`, `Components`, `Genus`, `BoundaryLoops`, as vtkNeuralMesh has them.
 *
 * The same calls in the same order, apart from LearnForSeconds(), give the same bytes; what is looked
 * at in between does not matter.
 *
 * @par Parameters
 * Those of vtkNeuralMeshAlgorithm, as they are at the first Learn() after the construction or
 * Reset(). Variant must be NOISE_FILTERING, Order EXACT, TopologyLearning and ComputeFeatureStrength
 * off, or Learn() is an error. CurvatureDensity does not count.
 *
 * A property out of its range is clamped, with a warning.
 *
 * @par Abort
 * SetAbortExecute(1), from an observer of ProgressEvent, say, ends Learn() or the update; the flag is
 * cleared when it has been obeyed.
 *
 * @par What it does not do
 * Points are not registered, weighted or taken back, and carry no data. See
 * Documentation/Streaming.md.
 *
 * @par Source
 * J. S. Vitter, Random sampling with a reservoir, ACM Transactions on Mathematical Software 11, 1985.
 *
 * @sa vtkNeuralMesh vtkNeuralMeshFileSampler
 */

#ifndef vtkNeuralMeshStream_h
#define vtkNeuralMeshStream_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshAlgorithm.h"

#include <memory>

class vtkPointSet;
class vtkPoints;
namespace neuralmesh
{
class StreamingReconstruction;
}

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshStream : public vtkNeuralMeshAlgorithm
{
public:
  static vtkNeuralMeshStream* New();
  vtkTypeMacro(vtkNeuralMeshStream, vtkNeuralMeshAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many vertices the mesh shall have. Default 20000, at least 4, at most 1000000000.
   */
  vtkNeuralMeshSetClampMacro(NumberOfVertices, vtkIdType, 4, 1000000000);
  vtkGetMacro(NumberOfVertices, vtkIdType);
  ///@}

  ///@{
  /**
   * Seed of the random numbers. Default 1, at least 0.
   */
  vtkNeuralMeshSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * How many points are kept to draw samples from. More than 50 per vertex hardly change the mesh.
   * Default 500000, range 100 to 4294967295.
   */
  vtkNeuralMeshSetClampMacro(ReservoirSize, vtkIdType, 100, VTK_UNSIGNED_INT_MAX);
  vtkGetMacro(ReservoirSize, vtkIdType);
  ///@}

  ///@{
  /**
   * Whether the output is fitted, as in vtkNeuralMesh: that takes about as long as learning it, each
   * time. Off is for looking on. Default on.
   */
  vtkSetMacro(FinishOutput, vtkTypeBool);
  vtkGetMacro(FinishOutput, vtkTypeBool);
  vtkBooleanMacro(FinishOutput, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Adds points; they count from the next Learn() on. Those that are not finite are dropped. Ghost
   * points are left out.
   */
  void AddPoints(vtkPoints* points);
  void AddPoints(vtkPointSet* points);
  ///@}

  /**
   * Learns so many samples. Returns how many they were: fewer if that was aborted, none as long as
   * there are too few points for a mesh.
   */
  vtkIdType Learn(vtkIdType samples);

  /**
   * Learns for about so long, and takes in new points first, however long that takes. Returns as
   * Learn(). The mesh then depends on the machine.
   */
  vtkIdType LearnForSeconds(double seconds);

  /**
   * Forgets all points and the mesh.
   */
  void Reset();

  ///@{
  /**
   * What there is now: points that came and are finite, those that are not, samples learnt, vertices
   * of the mesh, and how often it was begun.
   */
  vtkIdType GetNumberOfAddedPoints() const;
  vtkIdType GetNumberOfDroppedPoints() const;
  vtkIdType GetNumberOfLearntSamples() const;
  vtkIdType GetNumberOfLearntVertices() const;
  vtkIdType GetNumberOfBeginnings() const;
  ///@}

protected:
  vtkNeuralMeshStream();
  ~vtkNeuralMeshStream() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMeshStream(const vtkNeuralMeshStream&) = delete;
  void operator=(const vtkNeuralMeshStream&) = delete;

  /** Takes the parameters, if it is the first time. False, with an error, if they cannot be used. */
  bool Prepare();

  vtkIdType NumberOfVertices = 20000;
  int Seed = 1;
  vtkIdType ReservoirSize = 500000;
  vtkTypeBool FinishOutput = 1;
  std::unique_ptr<neuralmesh::StreamingReconstruction> Stream;
};

#endif
