// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshWriter
 * @brief   writes a mesh to a file, completely or not at all, with all digits of its coordinates
 *
 * vtkNeuralMeshWriter writes a vtkPolyData in the format of the extension of FileName: .vtp, .ply, .obj,
 * .stl, .glb, .off or .vtk (legacy, binary). A .vtp and a .vtk keep all data. A .ply and a .glb keep
 * normals, and the active scalars if they are colours (unsigned char, 3 or 4 components). An .off keeps
 * the colours, an .obj the normals. The writer writes another file in the same folder, checks it and
 * renames it. If anything fails, the old file stays.
 *
 * @par .glb
 * Binary glTF 2.0. Coordinates do not change, although y is up in glTF. Normals are of length 1.
 * The writer reads colours as sRGB and makes them linear, of 16 bits. The material is matt, and seen from both
 * sides. Values that are not finite are an error.
 *
 * @par Digits
 * Far from the origin floats are far apart: by 0.5 at 5400000. Floats cannot resolve a mesh of double
 * precision if an edge has less than a hundred of their steps at the largest coordinate. (The length of
 * an edge is estimated as the diagonal of the bounding box over the root of the number of vertices,
 * without a hundredth of the points at each end of each axis.) Such a mesh is written as a .ply of
 * doubles; other .ply files are of floats. The formats .vtp, .vtk, .obj and .off have all digits. An
 * .stl or a .glb has floats only: it is an error, and nothing is written.
 *
 * @par Shift
 * Shift, or the one that AutomaticShift chooses, is subtracted from the coordinates and stored in the
 * file: in the field data `Shift` of a .vtp or .vtk, a line `comment shift X Y Z` in the header of a
 * .ply, a line `# shift X Y Z` at the end of an .obj or the beginning of an .off, the title of an .stl,
 * `asset.extras.shift` of a .glb. The coordinates of the file plus the shift are the true ones.
 * vtkNeuralMeshPLYReader, vtkNeuralMeshReader and UndoShift() add it.
 * The input does not change. If it already has the field data `Shift`, the sum of both is stored.
 *
 * It is an error if the input has no points, if FileName is empty, has another extension or cannot be
 * written, or if Shift is not finite.
 *
 * @sa vtkNeuralMesh vtkNeuralMeshPLYReader
 */

#ifndef vtkNeuralMeshWriter_h
#define vtkNeuralMeshWriter_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshBuiltWith.h"
#include "vtkWriter.h"

#include <string>

class vtkPointSet;
class vtkPolyData;

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshWriter : public vtkWriter
{
public:
  static vtkNeuralMeshWriter* New();
  vtkTypeMacro(vtkNeuralMeshWriter, vtkWriter)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file. Default none (an empty name, for which null may be given, too), which is an error.
   */
  void SetFileName(VTK_FILEPATH const char* name);
  VTK_FILEPATH const char* GetFileName() const { return this->FileName.c_str(); }
  ///@}

  /** Whether files of this extension, in small letters or capitals, are written. */
  static bool CanWriteFile(VTK_FILEPATH const char* name);

  ///@{
  /**
   * Vector that is subtracted from the coordinates, in units of the input. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Shift, double);
  vtkGetVector3Macro(Shift, double);
  ///@}

  ///@{
  /**
   * Whether the writer chooses the shift and ignores Shift. If floats cannot resolve the mesh, the
   * shift is its middle, rounded to a power of ten of at least its diagonal; otherwise zero.
   * Default off.
   */
  vtkSetMacro(AutomaticShift, vtkTypeBool);
  vtkGetMacro(AutomaticShift, vtkTypeBool);
  vtkBooleanMacro(AutomaticShift, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The shift that is stored in the file written last; (0, 0, 0) for none.
   */
  vtkGetVector3Macro(StoredShift, double);
  ///@}

  /**
   * Whether FileName can hold the digits of a mesh of this number of vertices at these points, with
   * the shift of this writer. If not, there is an error. Call it before the mesh is made.
   */
  bool CheckCoordinates(vtkPointSet* points, vtkIdType numberOfVertices);

  /**
   * Adds the shift of a file, or of the field data `Shift`, to points that a reader of VTK has read
   * from it. Removes that field data. The points get double precision. Without a shift nothing
   * changes.
   */
  static void UndoShift(VTK_FILEPATH const char* fileName, vtkPointSet* points);

protected:
  vtkNeuralMeshWriter();
  ~vtkNeuralMeshWriter() override;

  /** Writes the file, or says in an error why not. */
  void WriteData() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkNeuralMeshWriter(const vtkNeuralMeshWriter&) = delete;
  void operator=(const vtkNeuralMeshWriter&) = delete;

  /** Throws std::runtime_error. */
  void WriteMesh(vtkPolyData* mesh);

  std::string FileName;
  double Shift[3] = { 0.0, 0.0, 0.0 };
  vtkTypeBool AutomaticShift = 0;
  double StoredShift[3] = { 0.0, 0.0, 0.0 };
};

#endif
