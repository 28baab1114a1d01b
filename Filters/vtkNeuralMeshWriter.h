// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshWriter
 * @brief   a mesh as a file, whole or not at all, with the digits that its coordinates need
 *
 * vtkNeuralMeshWriter writes a vtkPolyData in the format that the extension of FileName tells: .vtp,
 * .ply, .obj, .stl, .glb, .off or .vtk (legacy, binary). A .vtp and a .vtk keep all data. A .ply and a .glb
 * keep normals and the active scalars if they are colours (unsigned char, 3 or 4 components), an .off the
 * colours, an .obj the normals. The file is written under another name in the same folder,
 * looked over and then renamed: if anything goes wrong, what was there before stays.
 *
 * @par .glb
 * Binary glTF 2.0. Coordinates stay as they are, though glTF takes y for up: what is up in a mesh it
 * does not tell. Normals are of length 1; colours, taken for sRGB, are linear of 16 bits. The material is
 * matt, and seen from both sides. What is not finite is an error.
 *
 * @par Digits
 * Far from the origin floats are far apart: by 0.5 at 5400000. If points are of double precision, and
 * less than a hundred steps of floats go into an edge at the largest coordinate, floats do not hold
 * the mesh. (An edge is taken for the diagonal of the bounding box by the root of the number of
 * vertices; outliers of a hundredth at each end of each axis do not count.) Such a mesh is written as
 * a .ply of doubles, while others are of floats; .vtp, .vtk, .obj and .off have all digits anyway; as an
 * .stl or a .glb, which know floats only, it is refused: it is an error, and nothing is written.
 *
 * @par Shift
 * Shift, or one that AutomaticShift chooses, is taken off the coordinates that are written, and is
 * stored in the file: in the field data `Shift` of a .vtp or .vtk, a line `comment shift X Y Z` in the
 * header of a .ply, a line `# shift X Y Z` at the end of an .obj or the beginning of an .off, the title of
 * an .stl, `asset.extras.shift` of a .glb. Added to the coordinates of the file it gives the true ones,
 * which vtkNeuralMeshPLYReader, vtkNeuralMeshReader and UndoShift() do.
 * The input stays as it is. One that has the field data `Shift` already was shifted before: both are
 * stored as one.
 *
 * It is an error if the input has no points, FileName is empty, of another extension, or cannot be
 * written, for which the message names it, or if Shift is not finite.
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
   * What is taken off the coordinates, in units of the input. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Shift, double);
  vtkGetVector3Macro(Shift, double);
  ///@}

  ///@{
  /**
   * Whether the shift is chosen, and Shift does not count: where floats do not hold the mesh, the
   * middle of it, rounded to a power of ten that is not smaller than its diagonal, else none.
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
   * Whether FileName can hold the digits of a mesh of so many vertices where these points lie, by
   * the shift of this writer; if not, an error says so. To be asked before the mesh is there.
   */
  bool CheckCoordinates(vtkPointSet* points, vtkIdType numberOfVertices);

  /**
   * Moves points that a reader of VTK has read from a file to where they lay before the file was
   * written with a shift: adds what the file notes, or the field data `Shift`, which is then removed.
   * They become of double precision. Where there is no shift nothing is done.
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
