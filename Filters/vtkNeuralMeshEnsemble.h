// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshEnsemble
 * @brief   triangle mesh of a wanted size and the right topology, by an ensemble of meshes
 *
 * vtkNeuralMeshEnsemble is vtkNeuralMesh with a start of its own: instead of what Start says, a mesh
 * that already has the shape and the handles of the cloud. For closed shapes with handles, and
 * wherever a single run leaves bridges or twists. It takes a few times as long, on one thread; the
 * members are learnt beside each other, on NumberOfThreads. Algorithm 5 of the thesis:
 *
 * 1. Population: NumberOfMembers coarse meshes are learnt, from seeds derived from Seed, by the
 *    noise-filtering variant with exact counters.
 * 2. Averaging: each is turned into voxels of one grid, and each voxel stays that more than half of
 *    them hold. Triangles to which no point of the cloud is closest are phantoms, which cover a
 *    handle or an opening, and where a line of voxels meets nothing else it is empty. Voxels that
 *    touch by an edge alone are joined, pieces of less than 8 voxels or a thousandth of the largest
 *    piece are dropped, hollows are filled. The surface of what is left, simplified to a quarter of
 *    NumberOfVertices, is the average mesh: a closed, oriented manifold.
 * 3. Refinement: from the average mesh vtkNeuralMesh goes on, with all properties that it has, to
 *    NumberOfVertices.
 *
 * A member may have twists and bridges, and be inside out: as long as most of the others have none
 * at that place, the average has none. Documentation/Ensembles.md tells how far that gets.
 *
 * @par Input
 * As that of vtkNeuralMesh, but without a first mesh: there is one input port. The shape should be
 * closed; holes in the scan of some edges of the average mesh do no harm.
 *
 * @par Output
 * Port 0 and 1 as of vtkNeuralMesh; iterations and learning curve are those of the refinement.
 * Port 2, a vtkPolyData with triangles: the average mesh, in units of the input, of
 * OutputPointsPrecision. Port 3, a vtkImageData in units and coordinates of the input: the point
 * data `Votes` (float) is the fraction of the members that hold a voxel, whose centre the point is.
 *
 * The same input and seed give the same bytes on any number of threads, unless TimeLimit is met or
 * somebody aborts.
 *
 * @par Errors and warnings
 * As of vtkNeuralMesh. Open and flat clouds have no inside, and their members agree on little: on
 * less than four fifths of all that they and the average hold gives a warning, for then the topology
 * is left to chance; less than half gives another one, and the refinement starts as Start says:
 * port 2 is then empty. Connecting a first mesh is an error.
 *
 * @par Time limit and abort
 * TimeLimit holds for the three steps together; averaging, half a second or so, is not cut. Abort is
 * as with vtkNeuralMesh, within 0.2 s unless GridResolution or VerticesPerMember is large. If either comes before the average, the output is the first member as far
 * as it has come, port 2 is empty, and all votes are 0; later it is the average mesh as far as it is
 * refined. Progress is told from the thread that executes the filter alone, and the progress text
 * names the step.
 *
 * @par What it does not do
 * Open shapes: their members are skins of two sides, whose votes say nothing. See vtkNeuralMesh
 * with TopologyLearning. Handles and gaps narrower than a voxel may close; GridResolution and
 * VerticesPerMember make them wider. Hollows inside a shape are filled.
 *
 * @par Sources
 * I. Ivrissimtzis, Y. Lee, S. Lee, W.-K. Jeong, H.-P. Seidel, Neural mesh ensembles, 3DPVT 2004;
 * chapter 10 of the thesis. The voxels: E.-A. Karabassi, G. Papaioannou, T. Theoharis, A fast
 * depth-buffer-based voxelization algorithm, Journal of Graphics Tools 4(4), 1999. Phantoms, the
 * views along diagonals and the patience of the members are ours.
 *
 * @sa vtkNeuralMesh vtkFlyingEdges3D
 */

#ifndef vtkNeuralMeshEnsemble_h
#define vtkNeuralMeshEnsemble_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMesh.h"

class vtkImageData;
class vtkMultiProcessController;

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshEnsemble : public vtkNeuralMesh
{
public:
  static vtkNeuralMeshEnsemble* New();
  vtkTypeMacro(vtkNeuralMeshEnsemble, vtkNeuralMesh)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of members. More get the topology right more surely; the time of the population is
   * in proportion. Odd is best: of an even number, half of the votes are not enough.
   * Default 9, range 1 to 255.
   */
  vtkNeuralMeshSetClampMacro(NumberOfMembers, int, 1, 255);
  vtkGetMacro(NumberOfMembers, int);
  ///@}

  ///@{
  /**
   * The number of vertices of a member. More resolve narrower gaps and handles; the time of the
   * population is in proportion. A cloud of less than 10 points for each gives members that are
   * smaller accordingly, but of 50 vertices at least. Default 5000, range 50 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(VerticesPerMember, int, 50, 1000000);
  vtkGetMacro(VerticesPerMember, int);
  ///@}

  ///@{
  /**
   * C_vs of the members: the number of samples between two vertex splits, four times as many until
   * there are 1000 vertices. The time of the population is in proportion. The thesis has its
   * members expand aggressively, with a small C_vs; what they cover then, they often cover alike.
   * Default 50, range 1 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(MemberSamplesPerAddition, int, 1, 1000000);
  vtkGetMacro(MemberSamplesPerAddition, int);
  ///@}

  ///@{
  /**
   * C_ec of the members: the number of samples per vertex in which a vertex must win so as not to
   * be removed. Default 10, range 0.01 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(MemberRemovalPatience, double, 0.01, 1e6);
  vtkGetMacro(MemberRemovalPatience, double);
  ///@}

  ///@{
  /**
   * The number of voxels along the longest side of what most members hold; they are cubes. More
   * resolve narrower gaps and handles, as far as the members do; time and memory grow with the third
   * power: about 20 bytes for a voxel, and one for each member. Default 64, range 4 to 256.
   */
  vtkNeuralMeshSetClampMacro(GridResolution, int, 4, 256);
  vtkGetMacro(GridResolution, int);
  ///@}

  /**
   * Output port 2, see above.
   */
  vtkPolyData* GetAverageMesh();
  /**
   * Output port 3, see above.
   */
  vtkImageData* GetVotes();

protected:
  vtkNeuralMeshEnsemble();
  ~vtkNeuralMeshEnsemble() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void PrepareRun(vtkNeuralMeshRun& run, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /** The processes that share the members, by whose call all of them run; null for this one alone. */
  virtual vtkMultiProcessController* GetMemberController() { return nullptr; }

private:
  vtkNeuralMeshEnsemble(const vtkNeuralMeshEnsemble&) = delete;
  void operator=(const vtkNeuralMeshEnsemble&) = delete;

  int NumberOfMembers;
  int VerticesPerMember;
  int MemberSamplesPerAddition;
  double MemberRemovalPatience;
  int GridResolution;
};

#endif
