// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshReader
 * @brief   points or a mesh from a file of a scanner: .pcd, .ptx, .pwn, .off, text
 *
 * vtkNeuralMeshReader reads what VTK has no reader for, in the format that the extension of FileName
 * tells, in small letters or capitals: .pcd (text, binary, compressed), .ptx, .pwn, .off, and points as
 * text (.xyz .pts .txt .csv .asc). It also knows .ply, .obj and .stl, with all digits.
 *
 * @par Output
 * vtkPolyData: points of single or double precision, as the file has them; normals; colours as the
 * scalars `RGB`; further numbers of the points as arrays of their names, `Intensity` of a .ptx; polygons
 * as triangles. Where a .ptx or a .pcd tells where the scanner stood, the field data `Viewpoints` has the
 * places: vtkNeuralMesh turns surfaces by them. The point array `View` has the number of each point's, of
 * a .ptx, and of a .pcd whose rows and columns are those of a depth image: they show where its camera was,
 * whatever its VIEWPOINT says. The scans of a .ptx lie where their matrices take them; points at 0 0 0
 * are directions from which nothing came back: they are left out, and counted in the field data
 * `MissingReturns`. A file that was written with a shift gives the points where they lay before.
 *
 * It is an error, which nothing comes out of and whose message names the file, if there is no FileName,
 * its extension is another one, or the file cannot be read, is damaged, or ends early. For .las, .laz
 * and .e57 the message has a command that makes text of them.
 *
 * @sa vtkNeuralMesh vtkNeuralMeshPLYReader vtkNeuralMeshWriter
 */

#ifndef vtkNeuralMeshReader_h
#define vtkNeuralMeshReader_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshBuiltWith.h"
#include "vtkPolyDataAlgorithm.h"

#include <string>

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshReader : public vtkPolyDataAlgorithm
{
public:
  static vtkNeuralMeshReader* New();
  vtkTypeMacro(vtkNeuralMeshReader, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file. Default none (an empty name, for which null may be given, too), which is an error.
   */
  void SetFileName(VTK_FILEPATH const char* name);
  VTK_FILEPATH const char* GetFileName() const { return this->FileName.c_str(); }
  ///@}

  /** Whether files of this extension are read. */
  static bool CanReadFile(VTK_FILEPATH const char* name);

  /**
   * What to do with a file that is not read, by its extension, in one line: for .las, .laz and .e57 a
   * command that makes text of it, for .npy a call of Python, and that a packed file is unpacked first.
   * Else an empty text.
   */
  static std::string GetConversion(VTK_FILEPATH const char* name);

protected:
  vtkNeuralMeshReader();
  ~vtkNeuralMeshReader() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMeshReader(const vtkNeuralMeshReader&) = delete;
  void operator=(const vtkNeuralMeshReader&) = delete;

  std::string FileName;
};

#endif
