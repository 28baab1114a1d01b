// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshPLYReader
 * @brief   a .ply with all digits of its coordinates, if it is whole
 *
 * vtkNeuralMeshPLYReader is vtkPLYReader, but for what that does not see: coordinates that are no
 * floats, and that a file ends early. Large coordinates (UTM, say) written as doubles come out as they
 * are, where vtkPLYReader rounds them to float, which is to half a metre there.
 *
 * @par File
 * Text or binary of either byte order. It is an error, which nothing comes out of, if the file cannot
 * be opened, is no .ply, has vertices without x, y or z, or ends before all is there that its header
 * announces: in text as a line for each element, in binary as bytes. (A text that is cut within the
 * last number of its last line cannot be told from a whole one.)
 *
 * @par Output
 * vtkPolyData as of vtkPLYReader; the points are of double precision if a coordinate is of the type
 * double, int or uint, else of single precision. Of a mesh with textures by face, points of double
 * precision are not doubled at seams. A file that vtkNeuralMeshWriter has shifted gives the points
 * where they lay before, in double precision.
 *
 * @sa vtkNeuralMeshWriter vtkNeuralMeshFileSampler vtkPLYReader
 */

#ifndef vtkNeuralMeshPLYReader_h
#define vtkNeuralMeshPLYReader_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshBuiltWith.h"
#include "vtkPolyDataAlgorithm.h"

#include <string>

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshPLYReader : public vtkPolyDataAlgorithm
{
public:
  static vtkNeuralMeshPLYReader* New();
  vtkTypeMacro(vtkNeuralMeshPLYReader, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file. Default none (an empty name, for which null may be given, too), which is an error.
   */
  void SetFileName(VTK_FILEPATH const char* name);
  VTK_FILEPATH const char* GetFileName() const { return this->FileName.c_str(); }
  ///@}

protected:
  vtkNeuralMeshPLYReader();
  ~vtkNeuralMeshPLYReader() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMeshPLYReader(const vtkNeuralMeshPLYReader&) = delete;
  void operator=(const vtkNeuralMeshPLYReader&) = delete;

  std::string FileName;
};

#endif
